"""Where candidates begin when the baseline is far from the runs."""

from dataclasses import dataclass, field, replace
from types import SimpleNamespace

import numpy as np
import pytest

from rockref import Model
from rockref.discover import window_rules as rules
from rockref.discover.fit import families, search
from rockref.discover.fit.families import Family, same_windows
from rockref.discover.fit.least_squares import Point
from rockref.discover.fit.search import SHORT, Setup, nominal, windows
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.looking import far
from rockref.discover.looking.far import first_looks, first_steps, in_the_valley_of, kin, nominal_beside
from rockref.effects import catalogue
from rockref.effects.catalogue import parse
from tests.unit.discover.bowls import ALONE, Bowl, family
from tests.unit.discover.synthetic import experiment


def far_from(effect: str):
    """Setup and plain family at Table 3.1 of runs that another effect has bent."""
    truth = Model.table_3_1().replace(effects=(parse(effect),))
    e = experiment(truth, [{}, {"turned": True}], duration=1.2, noisy=True)
    setup = Setup(e, e.runs, Model.table_3_1(), end=1.2, workers=1)
    fit = setup.fit(windows(setup, SHORT))
    return setup, Family((), fit, fit.begin())


def test_first_look_ranks_a_turning_foot_first():
    setup, kept = far_from("spin_friction:radius=0.004")
    ids = ("clock_error", "adhesion", "spin_friction", "lingering_wire_pull")
    found = first_looks(setup, [catalogue.find(id) for id in ids], nominal_beside(setup, kept))
    assert [f.effects for f in found] == [(id,) for id in ids]
    best = min(found, key=lambda f: f.point.objective)
    assert best.effects == ("spin_friction",)
    assert best.point.objective < kept.point.objective


def test_first_step_ranks_a_friction_that_falls_with_speed_first():
    """It does so though the family that was kept is as far from the nominal baseline as a fit may bend."""
    setup, kept = far_from("stribeck_friction:ratio=2.0,velocity=0.01")
    kept.point.z[:] = 1.5
    ids = ("clock_error", "mass_eccentricity", "stribeck_friction", "inertia_deviation")
    found = first_steps(setup, [catalogue.find(id) for id in ids], nominal_beside(setup, kept))
    first, next = (f.point.objective for f in found[:2])
    assert found[0].effects == ("stribeck_friction",) and first < 0.95 * next


def test_nominal_keeps_the_effects_alone():
    setup, kept = far_from("spin_friction:radius=0.004")
    (family,) = first_looks(setup, [catalogue.find("mass_eccentricity")], nominal_beside(setup, kept))
    family.point.z[:] = 0.5
    z = nominal(family.fit.parameters, family.point.z)
    effects = np.array(["." in p.name for p in family.fit.parameters])
    assert np.all(z[effects] == 0.5) and np.all(z[~effects] == 0)


def test_kin_are_those_that_are_easily_taken_for_an_effect():
    """The declared confounder, who declares this one, and who shares the confounder; never the effect itself."""
    for id, effect in catalogue.EFFECTS.items():
        near = kin(id)
        assert effect.confounder in near and id not in near and len(near) == len(set(near))
    assert "clock_error" in kin("gyro_scale") and "rolling_resistance" in kin("cable_restraint")


@dataclass
class Stages:
    """The stages of a fit, each ending at a loss that is known beforehand; what was asked of which."""

    losses: dict[str, float]
    arrived: str = ""
    asked: list[tuple] = field(default_factory=list)

    def fitted(self, effects, z):
        count = np.full(3, 100.0)
        return SimpleNamespace(series=SimpleNamespace(count=count)), Point(
            z, None, self.losses[effects[-1]] * count / 2
        )

    def early(self, setup, effects, z, iterations):
        return self.fitted(effects, z)

    def baseline(self, setup, effects, z, iterations):
        self.asked.append(("begun once more", effects, tuple(z), iterations))
        return self.fitted(effects, z)

    def onward(self, setup, fit, point, iterations):
        self.asked.append(("on", iterations))
        return replace(point, z=point.z + 1)

    def late(self, setup, effects, z, iterations):
        self.asked.append(("late", effects, tuple(z), iterations))
        fit, point = self.fitted(effects, z)
        return fit, replace(point, loss=0.9 * fit.series.count / 2) if effects[-1] == self.arrived else point


@pytest.fixture
def stages(monkeypatch):
    """Stages that end at given losses; `arrived` : the effect whose last stage ends below the noise."""

    def put(losses, arrived=""):
        stages = Stages(losses, arrived)
        for stage in ("early", "baseline", "onward", "late"):
            monkeypatch.setattr(far, stage, getattr(stages, stage))
        return stages

    return put


def test_who_comes_nearest_on_the_short_windows_is_fitted_in_full(stages):
    """Five sets of effects with known losses; one is ahead, one is like it, and both are near their valleys."""
    asked = stages(
        {"adhesion": 0.98, "spin_friction": 0.99, "clock_error": 1.14, "gyro_scale": 2.2, "plate_tilt": 2.4}
    ).asked
    parameters = (Parameter("K_N", None, 1.0, 0.1), Parameter("gyro_drift.bias_x", None, 0.0, 1.0))
    kept = Family(
        ("gyro_drift",), SimpleNamespace(parameters=parameters), Point(np.array([0.7, 0.3]), None, np.ones(3))
    )
    ids = ("adhesion", "spin_friction", "clock_error", "gyro_scale", "plate_tilt")
    found = far.fitted_anew(ALONE, {("gyro_drift", id): np.array([0.5]) for id in ids}, kept, lambda line: None)
    assert [f.effects[-1] for f in found] == ["adhesion", "spin_friction"]
    # The baseline began at its nominal parameters, the effects where they were; from there it goes on.
    first = (
        ("on", search.FRESH[0] - far.LOOKS),
        ("late", ("gyro_drift", "adhesion"), (1.0, 1.3, 1.5), search.FRESH[1]),
    )
    assert tuple(asked[:2]) == first and len(asked) == 4


def test_who_is_far_from_any_valley_is_begun_once_more(stages):
    asked = stages({"adhesion": 1.4, "spin_friction": 1.9}).asked
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    begun = {("adhesion",): np.array([0.5]), ("spin_friction",): np.array([0.5])}
    far.fitted_anew(ALONE, begun, kept, lambda line: None)
    assert asked == [("begun once more", ("adhesion",), (0.5,), (search.FRESH[0] - far.LOOKS, search.FRESH[1]))]


def test_the_winner_is_fitted_in_full_wherever_it_stands(stages):
    stages({"adhesion": 1.0, "spin_friction": 1.5, "clock_error": 1.6})
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    begun = {(id,): np.zeros(1) for id in ("adhesion", "spin_friction", "clock_error")}
    found = far.fitted_anew(ALONE, begun, kept, lambda line: None, sure=("clock_error",))
    assert [f.effects for f in found] == [("adhesion",), ("clock_error",)]
    again = far.fitted_anew(ALONE, begun, kept, lambda line: None, sure=("adhesion",))
    assert [f.effects for f in again] == [("adhesion",)]


@pytest.mark.parametrize(
    "losses, fitted",
    [
        pytest.param((4.5, 4.7, 4.8, 5.0), 1, id="all the same and far off"),
        pytest.param((2.3, 3.6, 4.6, 5.2), 1, id="one is ahead"),
        pytest.param((2.3, 2.5, 4.6, 5.2), 2, id="two are ahead"),
        pytest.param((1.5, 1.52, 1.54, 1.56), 3, id="all the same and near"),
    ],
)
def test_where_no_look_leads_anywhere_one_is_fitted_in_full(stages, losses, fitted):
    ids = ("adhesion", "spin_friction", "clock_error", "gyro_scale")
    stages(dict(zip(ids, losses, strict=True)))
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    found = far.fitted_anew(ALONE, {(id,): np.zeros(1) for id in ids}, kept, lambda line: None)
    assert [f.effects for f in found] == [(id,) for id in ids[:fitted]]


@pytest.mark.parametrize(
    "arrived, in_full, in_valley",
    [
        pytest.param("adhesion", ["adhesion"], ["spin_friction", "clock_error", "plate_tilt"], id="the nearest"),
        pytest.param(
            "clock_error", ["adhesion", "spin_friction", "clock_error"], ["plate_tilt"], id="one that follows"
        ),
        pytest.param("plate_tilt", ["adhesion", "spin_friction", "clock_error", "plate_tilt"], [], id="the sure one"),
    ],
)
def test_once_one_is_at_the_noise_the_others_begin_where_it_ended(stages, monkeypatch, arrived, in_full, in_valley):
    ids = ("adhesion", "spin_friction", "clock_error", "plate_tilt")
    stages(dict(zip(ids, (1.03, 1.04, 1.05, 1.08), strict=True)), arrived)
    monkeypatch.setattr(families, "gain_between", lambda kept, family: 2 * rules.WELL_ABOVE_NOISE)
    begun = []

    def valley(setup, winner, others, kept):
        begun.append((winner.effects[-1], [other[-1] for other in others]))
        return []

    monkeypatch.setattr(far, "in_the_valley_of", valley)
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    sets = {(id,): np.zeros(1) for id in ids}
    found = far.fitted_anew(ALONE, sets, kept, lambda line: None, sure=("plate_tilt",))
    assert [f.effects[-1] for f in found] == in_full
    assert begun == [(arrived, in_valley)]


@pytest.mark.parametrize(
    "room, gain, structured, fitted",
    [
        pytest.param(1400.0, 1000.0, 0.1, 5, id="none arrives: the next get their turn"),
        pytest.param(1400.0, 1600.0, 0.1, 3, id="one is on its way"),
        pytest.param(100.0, 50.0, 0.0, 3, id="one has arrived"),
        pytest.param(1400.0, 1000.0, 0.5, 3, id="another effect is missing"),
    ],
)
def test_where_none_of_the_nearest_arrives_the_next_are_fitted_in_full(
    stages, monkeypatch, room, gain, structured, fitted
):
    ids = ("adhesion", "spin_friction", "clock_error", "gyro_scale", "plate_tilt")
    stages(dict(zip(ids, (1.03, 1.11, 1.13, 1.14, 1.15), strict=True)))
    monkeypatch.setattr(far, "room", lambda family: room)
    monkeypatch.setattr(far, "structured", lambda family: structured)
    monkeypatch.setattr(far, "gain_between", lambda kept, family: gain)
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    sets = {(id,): np.zeros(1) for id in ids}
    found = far.fitted_anew(ALONE, sets, kept, lambda line: None)
    assert [f.effects for f in found] == [(id,) for id in ids[:fitted]]
    assert len(far.fitted_anew(ALONE, sets, kept, lambda line: None, patient=False)) == 3
    # Who is sure is fitted with the first, and once.
    again = far.fitted_anew(ALONE, sets, kept, lambda line: None, sure=("gyro_scale",))
    assert sorted(f.effects[0] for f in again) == sorted({*ids[:fitted], "gyro_scale"})


def test_nobody_is_fitted_in_full_who_stands_above_what_is_given(stages):
    stages({"adhesion": 1.4, "spin_friction": 2.9, "clock_error": 3.0})
    kept = Family((), SimpleNamespace(parameters=()), Point(np.zeros(0), None, np.ones(3)))
    sets = {(id,): np.zeros(1) for id in ("adhesion", "spin_friction", "clock_error")}
    found = far.fitted_anew(ALONE, sets, kept, lambda line: None, most=2.0)
    assert [f.effects for f in found] == [("adhesion",)]
    assert far.fitted_anew(ALONE, sets, kept, lambda line: None, most=1.3) == []


@pytest.mark.parametrize("alone, second, fitted", [(1.3, True, 1), (1.1, True, 0), (1.1, False, 1)])
def test_a_second_effect_that_comes_no_nearer_than_the_first_alone_is_not_fitted_in_full(
    monkeypatch, alone, second, fitted
):
    """Nor does it matter for a first one, whose baseline may not be near anything."""
    effects = ("rolling_resistance",) if second else ()
    kept = family(effects, Bowl(np.array([0.0]), floor=alone), [0.0])
    drag = family((*effects, "quadratic_drag"), Bowl(np.array([0.0, 0.1]), floor=1.2), [0.0, 0.1])
    monkeypatch.setattr(far, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(far, "first_steps", lambda *a: [drag])
    monkeypatch.setattr(far, "first_looks", lambda *a: [drag])
    monkeypatch.setattr(far, "in_full", lambda setup, looked: looked)
    assert len(far.from_far(ALONE, (), kept, lambda line: None)) == fitted


def test_rivals_begun_where_the_winner_ended_are_compared_in_its_valley():
    setup, kept = far_from("quadratic_drag:c=0.8")
    wide = setup.fit(kept.fit.series, ("cable_restraint",))
    winner = Family(("cable_restraint",), wide, wide.run(wide.begin(), 3, np.random.default_rng(0)))
    found = {f.effects: f for f in in_the_valley_of(setup, winner, [("quadratic_drag",), ("gyro_scale",)], kept)}
    assert set(found) == {("quadratic_drag",), ("gyro_scale",)}
    assert all(same_windows(f, winner) for f in found.values())
    truth, scale = found[("quadratic_drag",)], found[("gyro_scale",)]
    assert truth.point.objective < min(winner.point.objective, scale.point.objective)


def test_the_first_of_both_lists_are_raced_and_of_each_name_the_better_start_counts(monkeypatch):
    """Six candidates, in one order by first steps and in the reverse one by first looks; the leader is last of both."""
    kept, ids = family((), Bowl(np.array([0.0]), floor=1.5), [0.0]), ("a", "b", "c", "d", "e", "f", "g", "h")
    bowls = {(way, id): Bowl(np.array([0.0, 0.1]), floor=1.2) for way in ("step", "look") for id in ids}
    bowls["look", "d"].floor = 1.0
    by_step = [family((id,), bowls["step", id], [0.0, 0.0]) for id in ids]
    by_look = [family((id,), bowls["look", id], [0.0, i]) for i, id in enumerate("cdefghab")]
    monkeypatch.setattr(far, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(far, "first_steps", lambda *a: by_step)
    monkeypatch.setattr(far, "first_looks", lambda *a: by_look)
    monkeypatch.setattr(far, "in_full", lambda setup, looked: looked)
    leader = by_step[7]
    lines: list[str] = []
    found = far.from_far(ALONE, (), kept, lines.append, [leader])
    assert {key for key, bowl in bowls.items() if bowl.iterations} == {
        *(("step", id) for id in "abcdh"),
        *(("look", id) for id in "cdefh"),
    }
    assert found[0].fit is bowls["look", "d"] and ("h",) in [f.effects for f in found]
    assert lines[0] == "  from nominal: nothing more 1.50"
    assert [line.split()[2] for line in lines[1:]] == ["a", "b", "c", "d", "h", "e", "f"]


@pytest.mark.parametrize(
    "effects, floor, raced",
    [(("x",), 3.0, True), (("x",), 1.5, False), ((), 3.0, False)],
    ids=["alike", "near", "first"],
)
def test_looks_beside_another_effect_that_tell_nobody_apart_are_halved_an_iteration_at_a_time(
    monkeypatch, effects, floor, raced
):
    """Who is last by its look, and the best by the first iteration, gets into the race; not so where looks are near."""
    kept, ids = family(effects, Bowl(np.array([0.0]), floor=9.0), [0.0]), "abcdefghijkl"
    bowls = {id: Bowl(np.array([0.0, 0.0]), floor=floor) for id in ids[:-1]}
    bowls["l"] = Bowl(np.array([0.0, -0.45]), floor=floor - 0.5)
    looks = [family((*effects, id), bowls[id], [0.0, 0.3 + 0.01 * i]) for i, id in enumerate(ids)]
    monkeypatch.setattr(far, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(far, "first_steps", lambda *a: [])
    monkeypatch.setattr(far, "first_looks", lambda *a: looks)
    monkeypatch.setattr(far, "in_full", lambda setup, looked: looked)
    lines: list[str] = []
    far.from_far(ALONE, (), kept, lines.append)
    assert ("l" in [line.split()[2] for line in lines]) == raced and len(lines) == 1 + far.LOOKED_AT
    before_the_race = far.LOOKS if raced else 0
    assert sum(bowl.iterations > before_the_race for bowl in bowls.values()) == far.LOOKED_AT
    assert (bowls["k"].iterations > 0) == raced


class Slow(Bowl):
    """A fit that falls after more iterations than a race has, and not before."""

    def run(self, point, iterations, rng, relative=0.0):
        self.iterations += iterations
        if iterations > far.LOOKS:
            return self.point(self.bottom, point.corrections)[0]
        return point


@pytest.mark.parametrize(
    "effects, alone, right, found",
    [
        ((), 1.4, 1.04, ["slow"]),  # all others stand at 1.38: nobody is nearer, so that all are taken further
        ((), 1.4, 1.37, ["slow"]),  # nor is anybody then: the best alone is fitted in full
        ((), 2.4, 1.04, ["a"]),  # so far off nothing is taken further
        (("gyro_scale",), 1.4, 1.04, ["a"]),  # nor beside another effect
    ],
    ids=["further", "in vain", "far off", "second"],
)
def test_where_no_candidate_comes_nearer_all_of_them_are_taken_further(monkeypatch, effects, alone, right, found):
    """Twice the iterations of a race, where the baseline is near; else no more than one is fitted in full."""
    kept = family(effects, Bowl(np.array([0.0]), floor=alone), [0.0])
    looks = [family((*effects, id), Bowl(np.zeros(2), floor=alone - 0.02), [0.0, 0.0]) for id in "abcdef"]
    slow = Slow(np.array([0.0, 0.2]), floor=right)
    looks.append(family((*effects, "slow"), slow, [0.0, 0.2 + np.sqrt(alone - right)]))
    monkeypatch.setattr(far, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(far, "first_steps", lambda *a: [])
    monkeypatch.setattr(far, "first_looks", lambda *a: looks)
    monkeypatch.setattr(far, "in_full", lambda setup, looked: looked)
    ended = far.from_far(ALONE, (), kept, lambda line: None)
    assert [f.effects[-1] for f in ended] == found


@pytest.mark.parametrize("effects", [(), ("compliant_support",)], ids=["asked", "sure"])
def test_a_plate_is_raced_wherever_its_tone_comes_nearer_and_the_best_of_its_masses_counts(monkeypatch, effects):
    """It needs no place among the looks, and is none of them; what led before is sure."""
    kept, asked = family((), Bowl(np.array([0.0]), floor=1.5), [0.0]), []
    bowl, looked = Bowl(np.array([0.0, 0.4]), floor=1.2), []
    plates = [family(("compliant_support",), bowl, [0.0, z]) for z in (0.0, -0.3, 0.4)]
    monkeypatch.setattr(far, "nominal_beside", lambda setup, kept: kept)
    monkeypatch.setattr(far, "first_steps", lambda *a: [])
    monkeypatch.setattr(far, "first_looks", lambda setup, kinds, plain: looked.extend(kinds) or [])
    monkeypatch.setattr(far, "at_its_tone", lambda setup, plain, as_far, sure: asked.append(sure) or plates)
    monkeypatch.setattr(far, "in_full", lambda setup, looked: looked)
    lines: list[str] = []
    kinds = [catalogue.find(id) for id in ("adhesion", "compliant_support")]
    leaders = [family(effects, bowl, [0.0, 0.0])] if effects else []
    (found,) = far.from_far(ALONE, kinds, kept, lines.append, leaders)
    assert asked == [bool(effects)] and [kind.id for kind in looked] == ["adhesion"]
    assert found.point.z == pytest.approx([0.0, 0.4]) and lines[1:] == ["  from nominal: compliant_support 1.20"]
