"""What the guard of a user's own effect lets pass and what it refuses, hook by hook."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from rockref import InputError
from rockref.effects.base import Effect
from rockref.effects.guard import AXES, LOOKS, NotFinite, are_finite, guard, line_in, numbers, pair
from rockref.model.problem import as_arrays, stack
from tests.unit.effects.bodies import body, points_at


def one_run():
    """A body on eight points."""
    return body(points_at([(0.1, 0.1, -0.5)] * 8))


def two_runs():
    """Two of them side by side."""
    return as_arrays(stack([one_run(), one_run()]))


@pytest.fixture(params=[one_run, two_runs])
def problem(request):
    return request.param()


def refusal(call, *arguments):
    """The error with which something is refused; its code and place are the same everywhere."""
    with pytest.raises(InputError) as found:
        call(*arguments)
    assert (found.value.code, found.value.where) == ("E-EFFECT", "mine.py:Mine.hook")
    return found.value.what, found.value.cure


def looked(name, arguments, result):
    """The error with which the result of a hook is refused."""
    return refusal(LOOKS[name], "mine.py:Mine.hook", arguments, result)


def passes(name, arguments, result):
    """Whether the result of a hook is let pass."""
    return LOOKS[name]("mine.py:Mine.hook", arguments, result) is None


NOT_FINITE = ("a holds a number that is not finite", "Look for 0/0, roots and powers of negatives.")


@pytest.mark.parametrize("a", [np.ones(2), [1.0, 2.0], (1, 2), np.array([True, False]), np.array([1, 2], np.uint8)])
def test_numbers_may_be_of_any_kind_that_is_real(a):
    numbers("here", "a", a, (2,))


@pytest.mark.parametrize("a", ["ab", [[1.0], [1.0, 2.0]], {"a": 1.0}, np.array([1j, 2j]), None, np.array(["1", "2"])])
def test_what_is_no_array_of_numbers_is_refused(a):
    said = refusal(numbers, "mine.py:Mine.hook", "a", a, (2,))
    assert said == (f"a is {type(a).__name__}", "Return an array of numbers.")


def test_another_shape_and_numbers_that_are_not_finite_are_refused():
    said = refusal(numbers, "mine.py:Mine.hook", "a", np.ones(3), (2,))
    assert said == ("a has shape (3,), the law's has (2,)", AXES)
    for lost in (np.nan, np.inf, -np.inf):
        with pytest.raises(NotFinite):
            numbers("mine.py:Mine.hook", "a", np.array([1.0, lost]), (2,))
        assert refusal(numbers, "mine.py:Mine.hook", "a", np.array([1.0, lost]), (2,)) == NOT_FINITE


def test_a_pair_is_a_tuple_of_two():
    assert pair("here", (1, "b")) == (1, "b")
    for given in (1.0, [1, 2], (1,), (1, 2, 3), None):
        said = refusal(pair, "mine.py:Mine.hook", given)
        assert said == (f"gives back {type(given).__name__}", "Return two things, with a comma between them.")


@pytest.mark.parametrize(
    "things, finite",
    [
        (np.ones(2), True), (np.array([1.0, np.nan]), False), (np.array([1.0, np.inf]), False), (1.5, True),
        (np.inf, False), (np.arange(3), True), (np.array([True]), True), (("a", 1, object(), None), True), ({}, True),
        ({"q": np.ones(2)}, True), ({"q": np.array([np.nan])}, False), ((np.ones(2), {"q": np.array(np.nan)}), False),
        ((object(), (1.0, np.nan)), False),
    ],
)  # fmt: skip
def test_arguments_are_finite_where_all_arrays_in_them_are(things, finite):
    assert are_finite(things) is finite


def test_a_hook_of_points_gives_back_a_body_and_its_points(problem):
    given = (problem.block, problem.points)
    assert passes("points", given, given)
    wider = replace(problem.points, P=np.zeros((*problem.points.P.shape[:-1], 4)))
    n = problem.points.P.shape[:-1]
    assert looked("points", given, (problem.block, wider)) == (
        f"P has shape {(*n, 4)}, the law's has {(*n, 3)}", AXES
    )  # fmt: skip
    for key in ("K_N", "K_T", "C_N", "C_T", "mu_0", "mu"):
        fewer = replace(problem.points, **{key: getattr(problem.points, key)[..., :5]})
        said = f"{key} has shape {(*n[:-1], 5)}, the law's has {n}"
        assert looked("points", given, (problem.block, fewer)) == (said, AXES)
    assert passes("points", given, (problem.block, replace(problem.points, radius=np.full(n, 1e-3))))
    odd = replace(problem.points, radius=np.full(4, 1e-3))
    assert looked("points", given, (problem.block, odd)) == (f"radius has shape (4,), the law's has {n}", AXES)
    for key in ("mass", "inertia", "g"):
        a = getattr(problem.block, key)
        lost = replace(problem.block, **{key: a * np.nan})
        assert looked("points", given, (lost, problem.points))[0] == f"{key} holds a number that is not finite"
        odd = replace(problem.block, **{key: np.zeros((*np.shape(a), 5))})
        said = f"{key} has shape {(*np.shape(a), 5)}, the law's has {np.shape(a)}"
        assert looked("points", given, (odd, problem.points)) == (said, AXES)


@pytest.mark.parametrize("names", [("1ext", "2ext"), ["1ext", "2ext", "3ext", "4ext", "5", "6", "7", "8"], None])
def test_every_point_has_a_name(problem, names):
    """A point without one would be missing in every table."""
    odd = replace(problem.points, names=names)
    what, cure = looked("points", (problem.block, problem.points), (problem.block, odd))
    assert what == f"names are {names!r}"[:80] and cure == "Give each of the 8 points a name, in a tuple."


def test_a_message_about_many_names_can_be_read():
    """It is cut at eighty characters."""
    given = (one_run().block, one_run().points)
    odd = replace(given[1], names=("left",) * 100)
    assert len(looked("points", given, (given[0], odd))[0]) == 80


def test_points_may_be_more_than_they_were():
    """As the eight of a block that had four."""
    p = one_run().points
    four = replace(p, **{k: getattr(p, k)[:4] for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu", "names")})
    assert passes("points", (one_run().block, four), (one_run().block, p))


def test_a_hook_of_points_that_gives_back_something_else_is_told():
    given = (one_run().block, one_run().points)
    assert looked("points", given, one_run().points)[0] == "gives back ContactPoints"
    assert looked("points", given, given[::-1]) == ("gives back ContactPoints, Block", "Return block, points.")
    assert looked("points", given, (one_run().block, 1.0)) == ("gives back Block, float", "Return block, points.")
    assert looked("points", given, (1.0, one_run().points))[0] == "gives back float, ContactPoints"


def test_a_hook_of_the_release_gives_back_a_state_like_the_one_that_came_in(problem):
    given = (problem.block, problem.points, problem.start)
    assert passes("release", given, problem.start)
    for nothing, kind in ((None, "NoneType"), (1.0, "float")):
        assert looked("release", given, nothing) == (f"gives back {kind}", "Return dataclasses.replace(state, ...).")
    for key in ("x", "Lambda", "v", "W"):
        a = getattr(problem.start, key)
        odd = replace(problem.start, **{key: a[..., :2]})
        said = f"{key} has shape {a[..., :2].shape}, the law's has {a.shape}"
        assert looked("release", given, odd) == (said, AXES)


def test_a_memory_begins_with_the_runs():
    assert passes("start", (one_run(),), {}) and passes("start", (one_run(),), {"q": 0.0, "held": np.zeros((8, 2))})
    assert passes("start", (two_runs(),), {"q": np.zeros(2), "held": np.zeros((2, 8))})
    assert looked("start", (two_runs(),), [1.0]) == ("gives back list", "Return a dict of arrays, or leave it out.")
    assert looked("start", (two_runs(),), {"q": np.zeros(2), "held": np.zeros((8, 2))}) == (
        "memory 'held' has shape (8, 2) for a batch of shape (2,)",
        "Begin its shape as those of the problem's arrays, with np.zeros_like.",
    )


@pytest.mark.parametrize("runs", [(), (2,), (2, 4)])
def test_a_plate_moves_along_three_axes_or_not_at_all(runs):
    good, short = np.zeros((*runs, 3)), np.zeros((*runs, 2))
    assert passes("plate_motion", (0.0, {}), None) and passes("plate_motion", (0.0, {}), (good, good))
    said = f"has shape {(*runs, 2)}, the law's has {(*runs, 3)}"
    assert looked("plate_motion", (0.0, {}), (short, good)) == (f"displacement {said}", AXES)
    assert looked("plate_motion", (0.0, {}), (good, short)) == (f"velocity {said}", AXES)
    assert looked("plate_motion", (0.0, {}), good)[0] == "gives back ndarray"
    assert passes("plate_motion", (0.0, {}), (good,) * 4)
    assert looked("plate_motion", (0.0, {}), (good, good, short, good)) == (f"turn {said}", AXES)
    assert looked("plate_motion", (0.0, {}), (good, good, good, short)) == (f"rate of turn {said}", AXES)
    assert looked("plate_motion", (0.0, {}), (good,) * 3)[0] == "gives back tuple"


def test_a_normal_force_has_a_number_for_each_point():
    given = (np.zeros(8), "kinematics", one_run().points, {})
    assert passes("normal_force", given, np.ones(8))
    assert looked("normal_force", given, np.ones(7)) == ("F has shape (7,), the law's has (8,)", AXES)


def test_both_coefficients_have_a_number_for_each_point():
    given = (0.5, 0.4, np.zeros(8), "kinematics", one_run().points, {})
    good, short = np.ones(8), np.ones(7)
    assert passes("friction_coefficient", given, (good, good))
    said = "has shape (7,), the law's has (8,)"
    assert looked("friction_coefficient", given, (short, good)) == (f"mu_0 {said}", AXES)
    assert looked("friction_coefficient", given, (good, short)) == (f"mu {said}", AXES)
    assert looked("friction_coefficient", given, good)[0] == "gives back ndarray"


@pytest.mark.parametrize("name", ["point_wrench", "body_wrench"])
def test_force_and_moment_are_those_of_each_run(name, problem):
    shape = problem.start.x.shape
    good, short = np.zeros(shape), np.zeros((5, 3))
    assert passes(name, (problem,), None) and passes(name, (problem,), (good, good))
    said = f"has shape (5, 3), the law's has {shape}"
    assert looked(name, (problem,), (short, good)) == (f"force {said}", AXES)
    assert looked(name, (problem,), (good, short)) == (f"moment {said}", AXES)
    assert looked(name, (problem,), 1.0)[0] == "gives back float"


def test_a_memory_that_goes_on_is_finite():
    assert passes("advance", (one_run(), "contact", 1e-5, {"q": np.zeros(3), "n": np.arange(2)}), None)
    lost = {"q": np.zeros(3), "held": np.array([0.0, np.nan])}
    assert looked("advance", (one_run(), "contact", 1e-5, lost), None) == (
        "memory 'held'" + NOT_FINITE[0][1:],
        NOT_FINITE[1],
    )


def test_a_sensor_shows_as_many_rates_as_came_in():
    given = (np.arange(7.0), np.zeros((7, 3)))
    assert passes("sensor", given, np.ones((7, 3)))
    assert looked("sensor", given, np.ones((6, 3))) == ("crv has shape (6, 3), the law's has (7, 3)", AXES)


def test_a_record_taken_back_has_as_many_rows_and_a_truth_for_every_rate():
    t, crv = given = (np.arange(7.0), np.zeros((7, 3)))
    assert passes("undo", given, (t, crv)) and passes("heard", given, np.ones((7, 3), bool))
    assert looked("undo", given, crv)[0] == "gives back ndarray"
    assert looked("undo", given, (t[1:], crv)) == ("t has shape (6,), the law's has (7,)", AXES)
    assert looked("undo", given, (t, crv[1:])) == ("crv has shape (6, 3), the law's has (7, 3)", AXES)
    assert looked("heard", given, np.ones(7, bool)) == ("what is heard has shape (7,), the law's has (7, 3)", AXES)
    said = ("gives back float64 numbers", "Return truths, such as abs(crv) < 1.")
    assert looked("heard", given, np.ones((7, 3))) == said


def test_only_the_hooks_that_a_class_has_of_its_own_are_guarded():
    @dataclass(frozen=True)
    class Mine(Effect):
        def sensor(self, t, crv):
            return crv[:1]

    guard(Mine, "mine.py:Mine")
    assert Mine.normal_force is Effect.normal_force and Mine.release is Effect.release
    with pytest.raises(InputError) as found:
        Mine().sensor(np.arange(7.0), np.zeros((7, 3)))
    assert (found.value.where, found.value.what) == (
        "mine.py:Mine.sensor", "crv has shape (1, 3), the law's has (7, 3)"
    )  # fmt: skip


def fails_at_once():
    raise KeyError("speed")


def fails_further_in():
    fails_at_once()


def fails_deep_in():
    fails_further_in()


def line_of(function):
    """The only line of a function."""
    return function.__code__.co_firstlineno + 1


@pytest.mark.parametrize("fails", [fails_at_once, fails_further_in, fails_deep_in])
def test_the_line_of_an_error_is_the_last_one_in_the_file(fails):
    from pathlib import Path

    with pytest.raises(KeyError) as found:
        fails()
    assert line_in(found.value, Path(__file__)) == f", line {line_of(fails_at_once)}"
    assert line_in(found.value, Path("another.py")) == ""


def test_an_error_of_one_line_has_that_line():
    from pathlib import Path

    try:
        raise KeyError("speed")
    except KeyError as e:
        assert line_in(e, Path(__file__)).startswith(", line ")
