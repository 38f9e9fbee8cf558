"""What a run of the law may not depend on: the side, the order of the points, the axes of the plate, the units.

Where the change of description costs no rounding (signs, quarter turns, powers of two) the bits must be the same.
"""

from dataclasses import replace

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from rockref.model.base_motion import BaseMotion
from rockref.model.problem import Block, ContactPoints, Problem
from rockref.model.rotation import apply, exponential, product
from rockref.model.simulate import simulate
from tests.strategies import between, problems

#: A run is 25 steps and costs some 10 ms.
RUNS = settings(max_examples=15)


def shaken(drawn):
    """The drawn problems, on a plate that moves: three components, samples between steps, the last one not zero."""
    record = st.integers(0, 2**32 - 1).map(lambda seed: np.random.default_rng(seed).uniform(-30, 30, (7, 3)))
    return st.builds(lambda p, a: replace(p, base=BaseMotion(0.3e-5, 3.3e-5, a)), drawn, record)


def rows(response):
    return {k: getattr(response, k) for k in ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")}


def same(a, b):
    """Whether two runs agree in every bit but the signs of zeros; anchors count where they hold."""
    hold = a["anchored"]
    return all(np.array_equal(a[k], b[k]) for k in a if k != "s") and np.array_equal(a["s"][hold], b["s"][hold])


def mirrored(problem: Problem) -> Problem:
    """Right and left exchanged: x -> -x of plate and body; what turns changes sign about the other two axes."""
    m, w = np.array([-1.0, 1, 1]), np.array([1.0, -1, -1])
    S = np.outer(m, m)
    start = problem.start
    return replace(
        problem,
        block=replace(problem.block, inertia=problem.block.inertia * S),
        points=replace(problem.points, P=problem.points.P * m),
        start=replace(start, x=start.x * m, v=start.v * m, Lambda=start.Lambda * S, W=start.W * w),
        base=None if problem.base is None else replace(problem.base, a=problem.base.a * m),
    )


@RUNS
@given(st.one_of(problems(), problems(radius=True), shaken(problems())))
def test_the_mirror_image_moves_as_the_mirror_image(problem):
    m, w = np.array([-1.0, 1, 1]), np.array([1.0, -1, -1])
    left = rows(simulate(mirrored(problem)))
    left["x"], left["v"], left["F"] = left["x"] * m, left["v"] * m, left["F"] * m
    left["W"], left["Lambda"], left["s"] = left["W"] * w, left["Lambda"] * np.outer(m, m), left["s"] * m[:2]
    assert same(rows(simulate(problem)), left)


def turned(problem: Problem, R: np.ndarray) -> Problem:
    """The whole scene turned about the vertical by R."""
    s = problem.start
    start = replace(s, x=apply(R, s.x), v=apply(R, s.v), Lambda=product(R, s.Lambda))
    base = None if problem.base is None else replace(problem.base, a=apply(R, problem.base.a))
    return replace(problem, start=start, base=base)


QUARTER = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])


@RUNS
@given(st.one_of(problems(), problems(radius=True), shaken(problems())))
def test_a_quarter_turn_of_the_scene_about_the_vertical_changes_no_bit(problem):
    there, back = rows(simulate(turned(problem, QUARTER))), QUARTER.T
    there["x"], there["v"] = apply(back, there["x"]), apply(back, there["v"])
    there["F"], there["Lambda"] = apply(back[None], there["F"]), product(back, there["Lambda"])
    there["s"] = np.stack([there["s"][..., 1], -there["s"][..., 0]], axis=-1)
    assert same(rows(simulate(problem)), there)


@RUNS
@given(problems(), between(-3, 3))
def test_any_turn_about_the_vertical_changes_rounding_only(problem, angle):
    R = exponential(np.array([0, 0, angle]))
    here, there = simulate(problem), simulate(turned(problem, R))
    # 1e-16 of positions of 0.4 m times 1e8 N/m: forces to 4e-9 N; a touch may come a step later
    if np.array_equal(here.anchored, there.anchored) and np.array_equal(here.sliding, there.sliding):
        assert np.max(np.abs(there.W - here.W)) < 1e-9
        assert np.max(np.abs(apply(R.T, there.x) - here.x)) < 1e-12
        assert np.max(np.abs(apply(R.T[None], there.F) - here.F)) < 1e-4


@RUNS
@given(problems(), st.permutations(range(8)))
def test_the_order_of_the_points_changes_rounding_only(problem, order):
    order = np.array(order)
    p = problem.points
    values = {k: getattr(p, k)[order] for k in ("P", "K_N", "K_T", "C_N", "C_T", "mu_0", "mu")}
    other = simulate(replace(problem, points=replace(p, **values)))
    here = simulate(problem)
    # sums of forces of 1e4 N in another order: 1e-12 N on 54 kg; and 25 steps to grow by the stiffness
    assert np.max(np.abs(other.W - here.W)) < 1e-9
    assert np.max(np.abs(other.F - here.F[:, order])) < 1e-4
    # the first evaluation does not depend on the sums: bit for bit
    assert np.array_equal(other.F[0], here.F[0][order])


@RUNS
@given(st.one_of(problems(), problems(radius=True)), st.integers(-9, 9), st.integers(-9, 9), st.integers(-9, 9))
def test_dimensional_similarity(problem, mass, length, time):
    """In units of 2^k kilograms, metres and seconds the same numbers come out: the law has no hidden units."""
    M, L, T = 2.0**mass, 2.0**length, 2.0**time
    b, p, s = problem.block, problem.points, problem.start
    scaled = Problem(
        Block(b.mass * M, b.inertia * (M * L * L), b.g * (L / T**2)),
        ContactPoints(
            p.P * L, p.K_N * (M / T**2), p.K_T * (M / T**2), p.C_N * (M / T), p.C_T * (M / T), p.mu_0, p.mu,
            None if p.radius is None else p.radius * L, p.names,
        ),
        replace(s, x=s.x * L, v=s.v * (L / T), W=s.W / T),
        problem.step * T, problem.duration * T, problem.output_rate / T,
    )  # fmt: skip
    other = rows(simulate(scaled))
    units = {
        "x": L,
        "v": L / T,
        "W": 1 / T,
        "F": M * L / T**2,
        "s": L,
        "Lambda": 1.0,
        "anchored": True,
        "sliding": True,
    }
    here = rows(simulate(problem))
    assert same(here, {k: a / units[k] if a.dtype != bool else a for k, a in other.items()})


@RUNS
@given(problems(), st.tuples(between(-100, 100), between(-100, 100)))
def test_the_plate_is_the_same_everywhere(problem, place):
    """Moved to another place, the run is the same but for the rounding of larger coordinates."""
    offset = np.array([*place, 0.0])
    moved = replace(problem, start=replace(problem.start, x=problem.start.x + offset))
    here, there = simulate(problem), simulate(moved)
    # 1.4e-14 m at 100 m, times 1e8 N/m
    assert np.max(np.abs(there.F - here.F)[0]) < 1e-5
    assert np.max(np.abs(there.x - offset - here.x)) < 1e-9


@RUNS
@given(problems(), st.integers(0, 2))
def test_names_of_the_body_axes_do_not_matter(problem, k):
    """Body axes renamed in turn (x to y to z to x): the same motion of the same block."""
    order = np.roll(np.arange(3), k)
    p, s, b = problem.points, problem.start, problem.block
    renamed = replace(
        problem,
        block=replace(b, inertia=b.inertia[np.ix_(order, order)]),
        points=replace(p, P=p.P[:, order]),
        start=replace(s, Lambda=s.Lambda[:, order], W=s.W[order]),
    )
    here, there = simulate(problem), simulate(renamed)
    # sums of three in another order
    assert np.max(np.abs(there.W - here.W[:, order])) < 1e-9
    assert np.max(np.abs(there.x - here.x)) < 1e-12
