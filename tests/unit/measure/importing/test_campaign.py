"""From a logger's files to an experiment folder: what is found in each layout, and what is proposed."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import InputError
from rockref.measure import load_experiment
from rockref.measure.importing import Choices, check_vacant, import_logs, write_campaign
from rockref.measure.importing.campaign import ImportedRun, hold_out, round_rate
from tests import foreign
from tests.refusal import refusal, refused
from tests.shipped import ROOT

SIDES = (54.0, 0.100, 0.688)


@pytest.fixture(scope="module")
def measured():
    """Three runs of a shipped experiment: two tilts, one of them turned."""
    experiment = load_experiment(ROOT / "data/experiments/mystery-05")
    return replace(experiment, runs=tuple(experiment.run(id) for id in ("01", "04", "06")))


@pytest.fixture(scope="module")
def imported(measured, tmp_path_factory):
    """The campaign of each layout."""
    place, made = tmp_path_factory.mktemp("logs"), {}
    for layout in foreign.LAYOUTS:
        paths = foreign.write_logs(measured, place / layout, layout)
        rate = 1000.0 if layout == "mpu_raw" else None  # its rows have no time
        made[layout] = import_logs(paths, Choices(*SIDES, rate=rate, bandwidth=300.0))
    return made


UNITS = {"xsens_dot": "deg_s", "dated": "deg_s", "arduino": "131 counts a deg/s", "mpu_raw": "65.5 counts a deg/s"}


@pytest.mark.parametrize("layout", foreign.LAYOUTS)
def test_units_rate_and_noise_of_each_layout(imported, layout):
    campaign = imported[layout]
    assert campaign.unit == UNITS.get(layout, "rad_s")
    assert campaign.rate == pytest.approx(1000.0, rel=1e-6)
    # 1200 samples give a standard deviation to 2 %; the step of the coarser chip adds 0.4 %.
    assert np.degrees(campaign.noise) == pytest.approx(0.05, rel=0.04)


@pytest.mark.parametrize("layout", foreign.LAYOUTS)
def test_axes_tilts_and_sides_of_each_layout(imported, layout):
    campaign = imported[layout]
    assert (campaign.axes.places, campaign.axes.signs) == ((1, 2, 0), (-1, -1, 1))
    # Only these logs have an accelerometer.
    assert campaign.axes.up_known == (layout in ("mt_manager", "xsens_dot", "arduino", "mpu_raw"))
    assert [run.turned for run in campaign.runs] == [False, False, True]
    # The wire's own scatter is 0.02 degrees; a scale of one part in a hundred would be 1e-3 rad.
    assert [run.tilt for run in campaign.runs] == pytest.approx([0.117, 0.098, 0.117], abs=1e-3)


def test_where_nothing_says_which_end_is_up_the_other_one_is_named_ready_to_type(imported):
    (notice,) = [n for n in imported["semicolons"].notices if n.code == "W-UP"]
    assert notice.cure == "If it points down, add --axes=-y,z,-x."


@pytest.mark.parametrize("layout", foreign.LAYOUTS)
def test_the_release_of_each_layout(imported, layout):
    for run in imported[layout].runs:
        # A sample of these records is 1 ms.
        assert run.release == pytest.approx(foreign.STANDING, abs=1e-3)
        assert run.standing == pytest.approx(foreign.STANDING, abs=0.05)


def test_the_folder_holds_the_records(imported, measured, tmp_path):
    """Rates come back as they were before the logger, but for the zero that is measured and digits that are cut."""
    experiment, _, left_out = write_campaign(imported["semicolons"], tmp_path / "block")
    assert not left_out and [n.code for n in experiment.notices] == []
    for new, old in zip(experiment.runs, measured.runs, strict=True):
        rows = min(len(new.t), len(old.t)) - 2
        late = round(1000 * (new.t[0] - old.t[0]))
        ours, theirs = new.crv[:rows], np.roll(old.crv, late, axis=0)[:rows]
        best = min(np.abs(np.roll(theirs, k, axis=0)[5:-5] - ours[5:-5]).max() for k in (-1, 0, 1))
        # 0.05 deg/s of noise over 1200 samples leave the zero to 0.0015; six digits of rad/s are 6e-5 deg/s.
        assert np.degrees(best) < 0.006


def test_a_run_without_a_swing_is_refused(measured, tmp_path):
    paths = foreign.write_logs(measured, tmp_path, "semicolons")
    lines = paths[0].read_text().splitlines()
    paths[0].write_text("\n".join(lines[:1000]) + "\n")
    with pytest.raises(InputError, match="E-NO-RELEASE]"):
        import_logs(paths, Choices(*SIDES))


def test_a_run_that_the_reader_refuses_is_left_out_and_said(measured, tmp_path):
    paths = foreign.write_logs(measured, tmp_path / "logs", "semicolons")
    lines = paths[1].read_text().splitlines()
    paths[1].write_text("\n".join(lines[:2500] + lines[2600:]) + "\n")
    _, campaign, left_out = write_campaign(import_logs(paths, Choices(*SIDES)), tmp_path / "block")
    assert [run.id for run in campaign.runs] == ["01", "03"]
    assert left_out[0].where == str(paths[1]) and "[E-GAP]" in left_out[0].cure
    assert not list(tmp_path.glob(".block*"))


def test_a_wrong_unit_in_the_names_is_refused(measured, tmp_path):
    paths = foreign.write_logs(measured, tmp_path, "dated")
    for path in paths:
        path.write_text(path.read_text().replace("°/s", "rad/s"))
    error = refused(import_logs, paths, Choices(*SIDES))
    assert error.code == "E-UNIT" and "deg_s" in error.cure


def test_what_is_stated_goes_before_what_is_measured(measured, tmp_path):
    paths = foreign.write_logs(measured, tmp_path, "dated")
    choices = Choices(*SIDES, tilt=0.1, tilts={"log06": 0.11}, turned=(), holdout=("02",), axes=("-y", "z", "-x"))
    campaign = import_logs(paths, choices)
    assert [run.tilt for run in campaign.runs] == [0.1, 0.1, 0.11]
    assert [run.use for run in campaign.runs] == ["fit", "holdout", "fit"]
    assert not any(run.turned for run in campaign.runs)
    assert campaign.axes.signs == (-1, 1, -1)
    assert "W-TILT-OFF" in {n.code for n in campaign.notices}


@pytest.mark.parametrize("words", [("x", "y"), ("x", "x", "z"), ("x", "y", "-z")])
def test_axes_that_no_chip_has_are_refused(words):
    from rockref.measure.importing.campaign import stated_axes

    with pytest.raises(InputError, match="E-AXES]"):
        stated_axes(words)


def run_of(tilt, turned=False):
    empty = np.zeros(0)
    return ImportedRun("", "", "fit", tilt, tilt, turned, empty, empty, 0.0, 1.0, 0.5, "", "")


def test_one_run_in_four_is_held_out():
    """A tilt between others first, then a repeat; no release loses its only run."""
    campaign = [run_of(0.117), run_of(0.117), run_of(0.117), run_of(0.098), run_of(0.108), run_of(0.117, True)]
    assert hold_out(campaign) == {2, 4}
    assert hold_out([run_of(0.1)]) == set()
    assert hold_out([run_of(0.1), run_of(0.1)]) == {1}


@pytest.mark.parametrize(
    "rate, nice", [(999.98, 1000.0), (100.03, 100.0), (416.4, 416.0), (52.0, 52.0), (812.3456, 812.0)]
)
def test_a_rate_is_said_as_a_data_sheet_says_it(rate, nice):
    assert round_rate(rate) == pytest.approx(nice)


def test_a_folder_is_written_beside_its_place_and_put_there_as_a_whole(imported, tmp_path):
    """Folders above it are made; who may read it is what the process says of any folder."""
    place, written = tmp_path / "campaigns" / "may" / "block", []
    write_campaign(imported["semicolons"], place, lambda experiment, beside: written.append((experiment.runs, beside)))
    ((runs, beside),) = written
    assert len(runs) == 3 and beside.parent == place.parent and beside.name.startswith(".block.")
    assert list(place.parent.iterdir()) == [place]
    assert place.stat().st_mode == place.parent.stat().st_mode


def test_of_a_folder_that_cannot_be_written_nothing_is_left(imported, tmp_path):
    def stop(experiment, beside):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_campaign(imported["semicolons"], tmp_path / "block", stop)
    assert list(tmp_path.iterdir()) == []


def test_only_a_folder_without_files_is_vacant(tmp_path):
    place = tmp_path / "block"
    check_vacant(place)
    place.mkdir()
    check_vacant(place)
    (place / "run01.csv").touch()
    for taken in (place, place / "run01.csv"):
        said = ("E-FOLDER", str(taken), "is there and not empty", "Name a new folder.")
        assert refusal(check_vacant, taken) == said
