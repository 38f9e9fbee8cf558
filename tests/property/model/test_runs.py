"""How a run may be cut and bundled without a bit of difference, and what it keeps."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from rockref.model import integrator, rotation
from rockref.model.problem import as_arrays, stack
from rockref.model.simulate import simulate
from tests import physics
from tests.strategies import problems, rotation_vectors, rotations

RUNS = settings(max_examples=12)
DTYPES = [np.float32, np.float64, np.longdouble]
ROWS = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")


def identical(a, b, names=ROWS):
    return all(np.array_equal(getattr(a, k), getattr(b, k), equal_nan=True) for k in names)


@pytest.mark.parametrize("dtype", DTYPES)
@RUNS
@given(st.one_of(problems(), problems(radius=True)), st.integers(1, 24))
def test_restart_equals_continue(dtype, problem, cut):
    step = problem.step
    whole = simulate(problem, dtype=dtype)
    first = simulate(replace(problem, duration=cut * step), dtype=dtype)
    second = simulate(replace(problem, start=first.final_state, duration=(25 - cut) * step), dtype=dtype)
    assert identical(second.final_state, whole.final_state, (*ROWS, "a", "T", "t", "origin", "count", "h"))
    for name in ROWS:
        joined = np.concatenate([getattr(first, name), getattr(second, name)[1:]])
        assert np.array_equal(joined, getattr(whole, name)), name
    assert np.array_equal(np.concatenate([first.t, second.t[1:]]), whole.t)


@RUNS
@given(st.lists(problems(), min_size=2, max_size=4), st.integers(1, 24))
def test_restart_of_a_batch_equals_continue(singles, cut):
    batch = stack(singles)
    whole = simulate(batch)
    first = simulate(replace(batch, duration=cut * batch.step))
    second = simulate(replace(batch, start=first.final_state, duration=(25 - cut) * batch.step))
    assert identical(second.final_state, whole.final_state, (*ROWS, "a", "T", "t", "count"))


@RUNS
@given(problems(), st.integers(1, 24))
def test_restart_with_an_effect_that_remembers(problem, cut):
    problem = replace(problem, effects=(physics.Pull(stiffness=1e3, speed=0.1),))
    whole = simulate(problem)
    first = simulate(replace(problem, duration=cut * problem.step))
    second = simulate(replace(problem, start=first.final_state, duration=(25 - cut) * problem.step))
    assert identical(second.final_state, whole.final_state)


@pytest.mark.parametrize("dtype", DTYPES)
@RUNS
@given(st.integers(1, 5).flatmap(lambda n: st.lists(problems(), min_size=n, max_size=n)))
def test_alone_or_in_a_batch_the_same_bits(dtype, singles):
    together = simulate(stack(singles), dtype=dtype)
    for i, problem in enumerate(singles):
        assert identical(together[i], simulate(problem, dtype=dtype))


@RUNS
@given(problems(radius=True), problems(radius=True), problems(radius=True))
def test_a_batch_of_two_axes(a, b, c):
    together = simulate(stack([stack([a, b, c]), stack([c, a, b])]))
    assert together.problem.batch == (2, 3)
    alone = [simulate(problem) for problem in (a, b, c)]
    for i in range(6):
        assert identical(together[i // 3, i % 3], alone[[0, 1, 2, 2, 0, 1][i]])


@RUNS
@given(problems())
def test_rows_do_not_change_the_run(problem):
    often, seldom = simulate(problem), simulate(replace(problem, output_rate=problem.output_rate / 5))
    for name in ROWS:
        assert np.array_equal(getattr(often, name)[::5], getattr(seldom, name)), name


@RUNS
@given(problems())
def test_the_start_is_not_touched(problem):
    before = {k: getattr(problem.start, k).copy() for k in ("x", "v", "Lambda", "W", "s")}
    simulate(problem)
    assert all(np.array_equal(before[k], getattr(problem.start, k)) for k in before)


@RUNS
@given(problems())
def test_precision_changes_the_last_digits_only(problem):
    """float64 against extended precision: the arithmetic has no hidden float32 or integer in it."""
    here, exact = simulate(problem), simulate(problem, dtype=np.longdouble)
    assert exact.W.dtype == np.longdouble
    if np.array_equal(here.anchored, exact.anchored) and np.array_equal(here.sliding, exact.sliding):
        # forces: 1e8 N/m times the rounding of 0.4 m; rates: that on 0.09 kg m2 over 25 steps of 1e-5 s
        assert np.max(np.abs(here.F - exact.F)) < 1e-6
        assert np.max(np.abs(here.W - exact.W)) < 1e-10


@given(rotations(), st.lists(rotation_vectors(0.05), min_size=20, max_size=20))
def test_a_rotation_stays_orthogonal(Lambda, increments):
    for Theta in increments:
        Lambda = integrator.update_rotation(Lambda, rotation.exp_minus_identity(Theta))
    gram = rotation.product(rotation.transposed(Lambda), Lambda)
    # three roundings of 1e-16 a step, twenty steps
    assert np.max(np.abs(gram - np.eye(3))) < 20 * 4e-16


@given(rotation_vectors(3.1))
def test_exponential_and_its_opposite(Theta):
    there = rotation.product(rotation.exponential(Theta), rotation.exponential(-Theta))
    assert np.max(np.abs(there - np.eye(3))) < 2e-15
    assert np.array_equal(rotation.exponential(-Theta), rotation.transposed(rotation.exponential(Theta)))


@RUNS
@given(problems(), st.sampled_from([1, 3]))
def test_in_the_air_the_spatial_angular_momentum_is_kept(problem, turns):
    """Ten metres above the plate, turning up to 15 rad/s."""
    start = problem.start
    up = replace(start, x=start.x + np.array([0, 0, 10.0]), W=start.W * 10 * turns)
    response = simulate(replace(problem, start=up, duration=100 * problem.step))
    L = rotation.apply(response.Lambda, rotation.apply(problem.block.inertia, response.W))
    # 100 steps of roundings of 1e-16
    assert np.max(np.abs(L - L[0])) <= 1e-14 * np.max(np.abs(L[0]))
    assert np.all(response.F == 0)


@RUNS
@given(problems())
def test_a_step_moves_memory_only_where_there_is_contact(problem):
    problem = as_arrays(problem)
    state = integrator.first_evaluation(problem)
    inertia = integrator.prepared_inertia(problem.block)
    for _ in range(25):
        state = integrator.step(problem, state, inertia)
        assert not np.any(state.sliding & ~state.anchored)
        assert np.all(state.F[~state.anchored] == 0)
        assert np.all(state.F[..., 2] >= 0)
