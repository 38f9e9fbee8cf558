"""A comparison with the shipped experiments points to what was put into them. They come from another simulator."""

import json

import pytest

from rockref import Model
from rockref.discover.compare.models import baseline_model, compare
from rockref.discover.compare.sentences import findings
from rockref.measure import load_experiment
from tests.shipped import ROOT

DATA = ROOT / "data/experiments"
ANSWERS = {a["name"]: a for a in json.loads((DATA / "answers.json").read_text(encoding="utf-8"))}


def spoken(name, models=None, names=None):
    """The findings of a comparison by kind, the last of each, and the comparison."""
    experiment = load_experiment(DATA / name)
    c = compare(experiment, models or [baseline_model(experiment)], names)
    return {f.kind: f for f in findings(c)}, c


def test_askew_gyroscope_shows_before_anything_has_happened():
    found, c = spoken("mystery-04")
    _, y, z = ANSWERS["mystery-04"]["sensor"]["misalign"]
    # Small angles: products of two of them (0.0015) are left out.
    assert abs(found["leak"].values["slope_transverse"]) == pytest.approx(abs(z), abs=0.0015)
    assert abs(found["leak"].values["slope_longitudinal"]) == pytest.approx(abs(y), abs=0.0015)
    # The main axis has nothing to do with it.
    assert c.rms(0, "before", "main") < 1.2 * c.noise(0)
    assert all(r.leaves_band.axis == "transverse" for r in c.results[0])


def test_rolling_resistance_is_missed_in_free_arcs_and_not_in_impacts():
    values = spoken("mystery-05")[0]["energy"].values
    assert values["free"]["model"] < 0.7 * values["free"]["measured"]
    assert values["impact"]["model"] == pytest.approx(values["impact"]["measured"], rel=0.1)


def test_scale_of_the_main_axis_is_read_off_in_spite_of_a_second_effect():
    factor = spoken("mystery-10")[0]["amplitude"].values["main"]
    # The cable's pull and the tilt of each run leave half a per cent.
    assert factor == pytest.approx(ANSWERS["mystery-10"]["sensor"]["scale"][0], abs=0.005)


def test_shifted_centre_of_mass_changes_side_with_the_block():
    values = spoken("mystery-03")[0]["to_second_impact"].values
    assert values["as_is"] < -0.1 and values["turned"] > 0.05


def test_four_points_have_no_clatter_and_eight_have_it():
    experiment = load_experiment(DATA / "mystery-09")
    c = compare(experiment, [Model.four_points(), Model.table_3_1()], ["four", "eight"])
    spoken_between = next(f.text for f in findings(c) if f.kind == "side_by_side" and f.values["stretch"] == "between")
    # A block that does not clatter is nearer in the mean than one that clatters out of step: that must be said.
    assert "four is closest" not in spoken_between or "no motion out of the plane" in spoken_between
    envelopes = [f.values for f in findings(c) if f.kind == "envelope"]
    assert envelopes[0]["transverse"]["width"] < 0.01
    assert envelopes[1]["transverse"]["width"] == pytest.approx(1.0, abs=0.5)
