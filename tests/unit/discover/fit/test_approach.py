"""Where a fit begins: the warp of the feet is found by looking, and an effect is moved with the tilts it is like."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover.fit import approach
from rockref.discover.fit.approach import (
    BEFORE,
    FINER,
    HEAVIER,
    TURNS,
    along_warp,
    approached,
    approached_beside,
    best_for_all,
    defects_together,
    heights_of,
    of_other_masses,
    pitching,
    placed,
    plainly_best,
    ringing_alike,
    same_release,
    shares_of,
    switches,
    turned_about_release,
)
from rockref.discover.fit.search import SHORT, Setup, windows
from rockref.discover.looking.presearch import release_fit
from rockref.discover.windows.series import STATES
from rockref.effects.catalogue import parse
from tests.unit.discover.synthetic import experiment

WARP = np.array([-1, 1, -1, 1])


def started(delta_long=None, effects=(), runs=({}, {"turned": True}), end=1.2):
    """A fit that begins at Table 3.1, of noisy runs of a block with these foot heights."""
    truth = Model.table_3_1()
    if delta_long is not None:
        truth = truth.replace(delta_long=tuple(delta_long))
    e = experiment(truth, list(runs), duration=end, noisy=True)
    setup = Setup(e, e.runs, Model.table_3_1(), end=end, workers=1)
    return setup.fit(windows(setup, SHORT), effects)


def heights(fit, z):
    return np.array([fit.parameters[i].value(z[i]) for i in heights_of([p.name for p in fit.parameters])])


def test_warp_of_the_feet_is_found():
    d = np.array(Model.table_3_1().parameters.delta_long)
    true = d * np.exp([0.0, 0.2, -0.1, 0.12])  # 24 um of warp away from the nominal one
    fit = started(true)
    nominal = placed(fit, np.zeros(len(fit.parameters)))
    found = approached(fit, nominal.z)
    # Half of the windows' misfit is gone before anything is fitted.
    assert found.objective < 0.5 * nominal.objective
    # Half the valley's depth is lost 5 um off its bottom, and it is looked at in steps of 1 um.
    assert WARP @ heights(fit, found.z) == pytest.approx(WARP @ true, abs=4e-6)


def test_place_is_never_worse_than_the_start():
    fit = started()
    for z in (np.zeros(len(fit.parameters)), np.random.default_rng(3).normal(size=len(fit.parameters))):
        assert approached(fit, z).objective <= placed(fit, z).objective


def test_moves_along_the_warp_change_it_by_what_is_asked_for():
    fit = started()
    z = np.zeros(len(fit.parameters))
    own = heights_of([p.name for p in fit.parameters])
    for asked, move in zip(FINER, along_warp(fit, own, FINER), strict=True):
        # Heights are exponential in z: to first order in 3 um of 50.
        assert WARP @ (heights(fit, z + move) - heights(fit, z)) == pytest.approx(asked, abs=0.05e-6)
        assert np.all(move[[i for i in range(len(z)) if i not in own]] == 0)


def test_eccentricity_moves_with_the_tilts_that_keep_the_release():
    fit = started(effects=("mass_eccentricity",), runs=({}, {"turned": True}))
    names = [p.name for p in fit.parameters]
    i, z = names.index("mass_eccentricity.y"), np.zeros(len(fit.parameters))
    first = np.flatnonzero(fit.series.first)
    upto = fit.series.length[first] - round(BEFORE * fit.series.rate)
    nothing = np.zeros((len(first), STATES))

    def changed(z_new):
        change = fit.residual(z_new, nothing, first, upto) - fit.residual(z, nothing, first, upto)
        return float(np.sqrt(np.mean(change**2)))

    alone = np.zeros(len(z))
    alone[i] = 0.5
    (move,) = (m for m in same_release(fit, i, z) if m[i] == 0.5)
    assert changed(z + move) < 0.1 * changed(z + alone)


def test_one_sided_effect_is_moved_to_its_side_only():
    fit = started(effects=("rolling_resistance", "mass_eccentricity"))
    by_name = {p.name: p for p in fit.parameters}
    assert np.all(shares_of(by_name["rolling_resistance.lever"]) > 0)
    assert np.any(shares_of(by_name["mass_eccentricity.x"]) < 0)


def test_a_ringing_plate_is_looked_for_at_every_tone():
    """A valley of 12 % of the compliance, wherever it lies between 115 and 35 Hz, holds a place that is looked at."""
    fit = started(effects=("compliant_support",))
    (compliance,) = (p for p in fit.parameters if p.name == "compliant_support.frequency")
    looked = shares_of(compliance)
    for bottom in np.linspace((60 / 115) ** 2, (60 / 35) ** 2, 200):
        assert np.min(np.abs(looked / bottom - 1)) < 0.06


def test_pitches_are_looked_for_about_the_tone_of_a_plate_that_yields():
    names = ["K_N", "compliant_support.frequency", "compliant_support.pitch"]
    assert len(pitching(names, np.zeros(3))) == 0
    places = np.array([0.3, 2.0, 0.1]) + pitching(names, np.array([0.3, 2.0, 0.1]))
    assert np.all(places[:, 0] == 0.3)
    assert sorted(set(places[:, 2].round(12))) == [0.0, 0.25, 0.5, 0.9, 1.4, 2.0]
    assert 0.5 not in pitching(names, np.array([0.3, 2.0, 0.5]))[:, 2] + 0.5
    # A pitch that yields makes the tone lower, so that the plate itself is stiffer than it seemed.
    assert places[:, 1].min() == pytest.approx(1.72) and places[:, 1].max() == pytest.approx(2.16)


def test_a_plate_of_another_mass_rings_alike_with_the_block_on_it():
    """The tone of both, the plate's spring under both masses, stays; the plate's own does not.

    Where a fit begins, a mass that was fitted is left as it is.
    """
    fit = started(effects=("compliant_support",))
    z = fit.begin().z
    assert len(ringing_alike(fit, z)) == 0
    names = [p.name for p in fit.parameters]
    soft, heavy = (names.index(f"compliant_support.{key}") for key in ("frequency", "mass"))
    z[soft] = 1.4
    assert [f.z[heavy] for f in of_other_masses(fit, placed(fit, z))] == list(HEAVIER)
    z[heavy] = 0.2
    assert of_other_masses(fit, placed(fit, z)) == []
    moves = ringing_alike(fit, z)
    assert np.all(np.delete(moves, [soft, heavy], axis=1) == 0) and set(moves[:, heavy] > 0) == {True, False}

    def tones(z):
        (plate,) = fit.models(z)[0][0].effects
        _, stiffness, _ = plate.bouncing()
        return stiffness / (plate.mass + 54.0), plate.frequency

    both, own = zip(*(tones(z + move) for move in moves), strict=True)
    np.testing.assert_allclose(both, tones(z)[0], rtol=1e-12)  # rounding alone
    assert min(own) < 0.98 * tones(z)[1] and max(own) > 1.05 * tones(z)[1]


def test_a_place_that_is_a_little_better_is_not_plainly_so(monkeypatch):
    fit = started()
    move = np.zeros((1, len(fit.parameters)))
    move[0, [p.name for p in fit.parameters].index("tilt_offset[0]")] = 0.1
    moved, point = placed(fit, np.zeros(len(fit.parameters))), placed(fit, -move[0])
    assert moved.objective < point.objective
    share = moved.objective / point.objective
    for plainly, wins in ((share * 1.001, True), (share * 0.999, False)):
        monkeypatch.setattr(approach, "PLAINLY", plainly)
        assert (plainly_best(fit, point, move).objective < point.objective) == wins


def test_switches_are_what_brings_an_effect_in():
    fit = started(effects=("stribeck_friction",))
    names = [p.name for p in fit.parameters]
    assert [names[i] for i in switches(names, heights_of(names))] == ["stribeck_friction.ratio"]


def test_first_look_leaves_the_baseline_but_for_warp_and_tilts():
    fit = started(effects=("rolling_resistance",))
    n = len(fit.parameters) - 1
    found = approached_beside(fit, np.zeros(n + 1), n)
    moved = {p.name.split("[")[0] for p, z in zip(fit.parameters, found.z, strict=True) if z}
    assert moved <= {f"delta_long_{i}" for i in (1, 2, 3, 4)} | {"tilt_offset", "rolling_resistance.lever"}


def test_four_points_have_no_warp():
    model = Model.four_points()
    e = experiment(model, [{}], duration=1.0, noisy=True)
    fit = Setup(e, e.runs, model, end=1.0, workers=1)
    series = windows(replace(fit, end=1.0), SHORT)
    plain = fit.fit(series)
    assert heights_of([p.name for p in plain.parameters]) == []
    assert approached(plain, np.zeros(len(plain.parameters))).objective > 0


def test_defects_of_half_their_size_are_found_from_the_typical_one():
    """All of a four-point block's heights and their distance are off by one factor; no small step leads there."""
    effect = "foot_defects:delta_long1=5e-6,delta_long2=2.1e-5,delta_long3=4.4e-5,delta_long4=2.9e-5,delta_diag=3e-3"
    model = Model.four_points()
    e = experiment(model.replace(effects=(parse(effect),)), [{}, {"turned": True}], duration=1.2, noisy=True)
    setup = Setup(e, e.runs, model, end=1.2, workers=1)
    fit = setup.fit(windows(setup, SHORT), ("foot_defects",))
    names = [p.name for p in fit.parameters]
    own = [*heights_of(names), names.index("foot_defects.delta_diag")]
    start = np.array([float("." in name) for name in names])
    start[[names.index(f"foot_defects.{ratio}_int") for ratio in ("mu", "beta")]] = 0.0
    moves = defects_together(own, start)
    assert np.all(moves[:, [i for i in range(len(names)) if i not in own]] == 0)
    found = best_for_all(fit, placed(fit, start), moves)
    np.testing.assert_allclose(found.z[own], 0.5, atol=0.04)  # the nearest of the factors is 0.51
    assert approached(fit, start).objective <= found.objective < 0.7 * placed(fit, start).objective


def test_a_gyroscope_is_turned_about_the_axis_that_no_release_shows():
    """Turned by 0.11 rad about X among others; the releases are met without it, and the windows say how much it is."""
    turn = {"x": 0.11, "y": 0.10, "z": -0.09}
    effect = "gyro_misalignment:" + ",".join(f"{axis}={value}" for axis, value in turn.items())
    truth = Model.table_3_1().replace(effects=(parse(effect),))
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    setup = Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=1)
    release, point = release_fit(setup, ("gyro_misalignment",))
    names = [p.name for p in release.parameters]
    x = names.index("gyro_misalignment.x")
    assert abs(release.parameters[x].value(point.z[x]) - turn["x"]) > 0.06
    moves = turned_about_release(release, point.z)
    # Not even the largest turn changes what the releases show by more than a tenth of the noise.
    nothing = np.zeros((release.series.B, STATES))
    before, after = (release.residual(z, nothing) for z in (point.z, point.z + moves[0]))
    assert np.sqrt(np.mean((after - before)[release.series.valid] ** 2)) < 0.1
    fit = setup.fit(windows(setup, SHORT, release.models(point.z)[0][0]), ("gyro_misalignment",))
    found = min((placed(fit, point.z + move) for move in moves), key=lambda p: p.objective)
    step = TURNS[1] - TURNS[0]
    assert abs(fit.parameters[x].value(found.z[x]) - turn["x"]) < step


def test_a_first_look_at_an_effect_leaves_those_before_it_where_they_are(monkeypatch):
    """Of two switches only that from the given parameter on is moved; there are no feet whose warp would follow."""
    names = ["K_N", "rolling_resistance.lever", "quadratic_drag.c"]
    fit = SimpleNamespace(parameters=[SimpleNamespace(name=name) for name in names])
    asked = []
    monkeypatch.setattr(approach, "placed", lambda fit, z: SimpleNamespace(z=z))
    monkeypatch.setattr(approach, "same_release", lambda fit, i, z: names[i])
    monkeypatch.setattr(approach, "best_for_all", lambda fit, point, moves: (asked.append(moves), point)[1])
    approached_beside(fit, np.zeros(3), 2)
    assert asked == ["quadratic_drag.c"]
    asked.clear()
    approached_beside(fit, np.zeros(3), 1)
    assert asked == ["rolling_resistance.lever", "quadratic_drag.c"]
