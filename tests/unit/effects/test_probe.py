"""The small problem on which a user's own effect is tried, and what is looked at there."""

from dataclasses import dataclass, fields, is_dataclass, replace

import numpy as np
import pytest

from rockref import InputError, Model
from rockref.effects.base import HOOKS, UNDO_HOOKS, Effect, Quantity
from rockref.effects.guard import AXES
from rockref.effects.probe import absent_arguments, probe, probe_absent, same, sample_problem
from rockref.model.integrator import evaluate_contact
from rockref.model.problem import as_arrays, stack
from tests.refusal import refused


def alike(a, b):
    """Whether two arguments of a hook are equal in every number."""
    if is_dataclass(a):
        return type(a) is type(b) and all(alike(getattr(a, f.name), getattr(b, f.name)) for f in fields(a))
    if isinstance(a, (tuple, dict)):
        inside = a.items() if isinstance(a, dict) else a
        other = b.items() if isinstance(b, dict) else b
        return type(a) is type(b) and len(a) == len(b) and all(map(alike, inside, other))
    return a is b or bool(np.array_equal(a, b))


def test_the_small_problem_is_the_sources_block_at_release_turning_a_little():
    model, found = Model.table_3_1(), sample_problem()
    wanted = model.problem(duration=1.0, output_rate=2000.0, step=1e-5)
    assert alike(found.block, wanted.block) and alike(found.points, wanted.points)
    assert alike(replace(found.start, W=wanted.start.W), wanted.start)
    # It turns about all axes, as slowly as a block that rocks.
    assert np.all(found.start.W > 0) and np.all(found.start.W < 0.5)
    assert (found.step, found.duration, found.output_rate, found.effects) == (1e-5, 1.0, 2000.0, ())


calls = []


@dataclass(frozen=True)
class Recorder(Effect):
    """An effect that changes nothing and keeps what its hooks were given."""

    def start(self, problem):
        calls.append(("start", (problem,)))
        return {"q": problem.start.x + 1.0}


def recording(name):
    """A hook that does as the law does, and keeps its arguments."""

    def hook(self, *arguments):
        calls.append((name, arguments))
        return getattr(Effect, name)(self, *arguments)

    return hook


for each in HOOKS | UNDO_HOOKS:
    if each != "start":
        setattr(Recorder, each, recording(each))


def arguments_of(problem):
    """What the hooks are to be given on a problem, at its release: by name."""
    s, points = problem.start, problem.points
    c = evaluate_contact(problem, s, s.x, s.Lambda, s.v, s.W, 0 * s.W, 0.0, ())
    m = {"q": s.x + 1.0}
    return {
        "start": (problem,), "points": (problem.block, points), "release": (problem.block, points, s),
        "plate_motion": (0.0, m), "normal_force": (points.K_N * c.k.xi, c.k, points, m),
        "friction_coefficient": (points.mu_0, points.mu, c.F_N, c.k, points, m), "point_wrench": (problem, c, m),
        "body_wrench": (problem, c, s.x, s.Lambda, s.v, s.W, m), "advance": (problem, c, problem.step, m),
        **{name: (np.arange(50) / problem.output_rate, np.full((50, 3), 0.1)) for name in RECORD},
    }  # fmt: skip


RECORD = ["sensor", "undo", "heard"]
IN_STEP = ["start", "plate_motion", "normal_force", "friction_coefficient", "point_wrench", "body_wrench", "advance"]


def test_every_hook_is_tried_on_one_run_and_those_of_the_step_on_two_side_by_side():
    calls.clear()
    probe(Recorder(), "mine.py:Mine")
    one = sample_problem()
    wanted = [(name, arguments_of(p)[name]) for p in (one, as_arrays(stack([one, one]))) for name in IN_STEP]
    wanted += [(name, arguments_of(one)[name]) for name in ("points", "release", *RECORD)]
    assert [name for name, _ in calls] == [name for name, _ in wanted]
    for (name, given), (_, expected) in zip(calls, wanted, strict=True):
        assert alike(given, expected), name


def test_an_absent_effect_is_asked_the_same():
    found = absent_arguments(Recorder())
    assert [name for name, _ in found] == [name for name in HOOKS | UNDO_HOOKS if name not in ("start", "advance")]
    for name, given in found:
        assert alike(given, arguments_of(sample_problem())[name]), name


def test_an_effect_whose_memory_cannot_be_made_while_it_is_absent_is_asked_nothing():
    class Divides(Effect):
        def start(self, problem):
            raise InputError("E-EFFECT", "mine.py:Mine.start", "fails", "Mend the line.")

    assert absent_arguments(Divides()) == []


@dataclass(frozen=True)
class Shaken(Effect):
    """A plate whose motion forgets the batch in one of its two results."""

    wrong: str = "displacement"

    def plate_motion(self, t, m):
        good, bad = np.zeros((2, 3)), np.zeros(3)
        return (bad, good) if self.wrong == "displacement" else (good, bad)


@pytest.mark.parametrize("wrong", ["displacement", "velocity"])
def test_a_plate_that_forgets_the_runs_beside_it_is_told(wrong):
    class OnlyTwo(Shaken):
        def plate_motion(self, t, m):
            return Shaken.plate_motion(self, t, m) if self.runs else None

        def start(self, problem):
            OnlyTwo.runs = problem.batch
            return {}

    found = refused(probe, OnlyTwo(wrong), "mine.py:Mine")
    error = found
    assert (error.code, error.where) == ("E-EFFECT", "mine.py:Mine.plate_motion")
    assert (error.what, error.cure) == (f"{wrong} has shape (3,), the law's has (2, 3)", AXES)


@dataclass(frozen=True)
class Leaning(Effect):
    """One that cannot be computed in one hook, and acts in a later one, where it should be absent."""

    quantities = {
        "c": Quantity("N", 0.0, 0.1, 10.0, 1.0), "d": Quantity("1", 1.0, 0.5, 2.0, 1.5),
        "height": Quantity("m", None, 0.0, 1.0, None),
    }  # fmt: skip
    c: float = 0.0
    d: float = 1.0
    height: float | None = None

    def points(self, block, points):
        raise InputError("E-EFFECT", "mine.py:Mine.points", "fails", "Mend the line.")

    def sensor(self, t, crv):
        return crv + 1e-3


def test_what_acts_while_it_is_absent_is_told_with_the_values_at_which_it_is():
    found = refused(probe_absent, Leaning(), "mine.py:Mine")
    error = found
    assert (error.code, error.where) == ("E-EFFECT", "mine.py:Mine.sensor")
    assert error.what == "changes something where the effect is absent (c=0, d=1)"
    assert error.cure == "Let the parameters that bring it in multiply what it adds."
    assert probe_absent(Effect(), "mine.py:Mine") is None


A = np.array([[1.0, -2e3], [3e-9, 0.0]])


@pytest.mark.parametrize(
    "a, b, alike",
    [
        (A, A.copy(), True), (A + 1e-9, A, True), (A - 1e-9, A, True), (A + 4e-9, A, False), (A - 4e-9, A, False),
        (np.zeros(3), np.zeros(3), True), (np.full(3, 1e-9), np.zeros(3), False), (A[:, :1], A, False),
        (np.array([1e-9]), np.array([1e-9 + 1e-13]), False), (np.zeros((0, 3)), np.zeros((0, 3)), True),
        (np.arange(3), np.arange(3), True), (np.arange(3), np.arange(3) + 1, False),
        (np.array([10**15]), np.array([10**15 + 1]), False), (np.array([True]), np.array([False]), False),
    ],
)  # fmt: skip
def test_arrays_are_the_same_but_for_a_rounding_of_the_largest(a, b, alike):
    """1e-12 of 2000 is 2e-9; whole numbers and truths do not round."""
    assert same(a, b) is alike


@pytest.mark.parametrize(
    "a, b, alike",
    [
        ((A, A), (A, A.copy()), True), ((A, A + 1), (A, A), False), ((A + 1, A), (A, A), False),
        ((np.zeros(3), np.zeros(3)), None, True), ((np.zeros(3), np.array([0.0, 1e-300])), None, False),
        (None, None, True), (("1ext", "2ext"), ("1ext", "2ext"), True), (("1ext",), ("2ext",), False),
        (0.1, 0.1, True), (0.1, 0.2, False), ((A, ("1ext",)), (A, ("1ext",)), True),
    ],
)  # fmt: skip
def test_results_are_the_same_where_all_that_they_hold_is(a, b, alike):
    """A load or a motion of zero is none."""
    assert same(a, b) is alike


def test_bodies_points_and_states_are_the_same_where_all_their_numbers_and_names_are():
    one, other = sample_problem(), sample_problem()
    points = one.points
    assert same(points, other.points) is same(one.start, other.start) is same((one.block, points), (one.block, points))
    assert same(points, other.points) is True
    for changed in ({"mu": points.mu * 1.01}, {"names": points.names[::-1]}, {"radius": np.full(8, 1e-3)}):
        assert same(replace(points, **changed), points) is False, changed
    heavier = replace(one.block, g=np.array(9.8))
    assert same((heavier, points), (one.block, points)) is False
