"""The listening run: what a correction does, and what it leaves alone."""

from dataclasses import replace

import numpy as np
import pytest

import rockref
from rockref.model.integrator import first_evaluation
from rockref.model.listening import (
    Target,
    attitude_correction,
    corrected,
    lever_arms,
    listen,
    rate_correction,
)
from rockref.model.problem import State, stack
from rockref.model.rotation import exponential
from rockref.model.simulate import simulate
from tests import physics

TABLE = rockref.Model.table_3_1()


def test_a_rate_moves_by_its_share():
    moved = rate_correction(np.array([1.0, 2.0, 3.0]), np.array([2.0, 0.0, 3.0]), np.array([0.5, 0.25, 1.0]))
    np.testing.assert_array_equal(moved, [0.5, -0.5, 0.0])


def test_an_attitude_turns_by_its_share():
    """The sine of the angle about the axis between the two, in body axes."""
    Lambda, axis = exponential(np.array([0.3, -0.2, 0.5])), np.array([2.0, -1.0, 2.0]) / 3
    observed = Lambda @ exponential(0.2 * axis)
    turn = attitude_correction(Lambda, observed, np.array(0.5))
    np.testing.assert_allclose(turn, 0.5 * np.sin(0.2) * axis, atol=1e-15)  # a few roundings of numbers below one


def standing(load: float):
    """A block on its feet, its forces evaluated, with sums over two steps that carry this share of its weight."""
    problem = TABLE.problem(1e-3).replace(step=1e-5)
    state = first_evaluation(problem)
    state = replace(state, anchored=np.arange(8) % 2 == 0, v=np.array([0.1, 0.2, 0.3]))
    place, weight = np.array([0.1, -0.05, -0.4]), problem.block.mass * problem.block.g
    sums = 2 * load * weight
    return problem, state, place, sums, sums * place


def velocity_at(state, arm):
    return state.v + np.cross(state.Lambda @ state.W, arm)


def test_a_correction_turns_about_the_loaded_place():
    problem, state, place, load, moment = standing(0.5)
    dW, dq = np.array([0.2, -0.1, 0.3]), np.array([2e-4, 1e-4, -3e-4])
    after = corrected(problem, state, dW, dq, load, moment, 2)
    # Its velocity and its position are kept: to rounding, and to the square of the angle, 1e-7, times 0.4 m.
    np.testing.assert_allclose(
        velocity_at(replace(after, Lambda=state.Lambda), place), velocity_at(state, place), atol=1e-15
    )
    kept = after.x + after.Lambda @ (state.Lambda.T @ place)
    np.testing.assert_allclose(kept, state.x + place, atol=1e-7)
    assert np.abs(after.x - state.x).max() > 1e-5
    np.testing.assert_allclose(
        after.Lambda, state.Lambda @ exponential(dq), atol=1e-15
    )  # a rounding of a number below one
    np.testing.assert_array_equal(after.W, state.W + dW)


def test_anchors_move_with_their_feet():
    problem, state, _, load, moment = standing(0.5)
    after = corrected(problem, state, np.zeros(3), np.array([2e-4, 1e-4, -3e-4]), load, moment, 2)
    feet = (after.x + lever_arms(problem, after)) - (state.x + lever_arms(problem, state))
    moved = after.s - state.s
    # To the square of the angle, 1e-7, times 0.5 m.
    np.testing.assert_allclose(moved[state.anchored], feet[state.anchored, :2], atol=1e-7)
    np.testing.assert_array_equal(moved[~state.anchored], 0.0)
    assert np.abs(moved).max() > 1e-5


def test_forces_at_the_lever_arms_make_the_moment_of_the_law():
    """Of round feet on a leaning block, too, whose contact point is not where the foot ends."""
    problem = TABLE.problem(1e-3)
    problem = problem.replace(points=replace(problem.points, radius=np.full(8, 0.02)))
    start = replace(problem.start, Lambda=exponential(np.array([0.1, -0.05, 0.3])))
    lowest = (start.x + lever_arms(problem, start))[:, 2].min()
    pressed = problem.replace(start=replace(start, x=start.x - [0, 0, lowest + 1e-5]))
    state = first_evaluation(pressed)
    moment = np.cross(lever_arms(pressed, state), state.F).sum(axis=0)
    # A few roundings of forces of 1e3 N at arms of 0.4 m.
    np.testing.assert_allclose(state.Lambda @ state.T, moment, atol=1e-12)
    assert np.abs(moment).max() > 1


def test_in_flight_only_the_turn_is_corrected():
    problem, state, _, load, moment = standing(0.019)
    after = corrected(problem, state, np.ones(3), np.full(3, 1e-3), load, moment, 2)
    for key in ("x", "v", "s", "a", "T", "F"):
        np.testing.assert_array_equal(getattr(after, key), getattr(state, key))
    assert not np.array_equal(after.W, state.W) and not np.array_equal(after.Lambda, state.Lambda)


def own_record(problem, every: int, gain: float) -> tuple[np.ndarray, Target]:
    """The rates of a run, and the target that is its own record."""
    record = simulate(problem.replace(output_rate=1 / (every * problem.step)))
    turns = record.Lambda[0].T @ record.Lambda
    K = len(record.t)
    return record.W, Target(record.W, turns, np.full((K, 3), gain), np.full(K, gain), every)


def speed_after_impact(z: float, step: float, first_by_share: bool) -> float:
    """The speed [m/s] at which a point mass without weight leaves the plate, 0.1 m/s before."""
    start = physics.mass_on_a_foot(z=z, v=(0, 0, -0.1), g=0.0, step=step, duration=0.01)
    return float(simulate(start.replace(first_by_share=first_by_share)).v[-1, 2])


def test_by_its_share_the_first_force_hardly_depends_on_where_the_steps_fall():
    """To the second order of the step; the law's own first force to the first."""
    step = 4e-5
    heights = 1e-5 + 0.1 * step * np.arange(8) / 8
    right = speed_after_impact(heights[0], step / 64, first_by_share=True)
    by_share, whole = (np.array([speed_after_impact(z, step, kind) for z in heights]) for kind in (True, False))
    # Of the first order is C_N h / m, 1.5 % of the speed; of the second its square, a seventieth of that: a tenth, and
    # against the right speed a fifth, leave room for what its factors are.
    assert np.ptp(by_share) < np.ptp(whole) / 10
    assert np.abs(by_share - right).max() < np.abs(whole - right).max() / 5
    coarser = np.array([speed_after_impact(1e-5 + 0.2 * step * k / 8, 2 * step, True) for k in range(8)])
    assert 3 < np.ptp(coarser) / np.ptp(by_share) < 6, "four times for twice the step"


@pytest.mark.parametrize("gain", [0.0, 0.5])
def test_a_run_that_listens_to_itself_is_the_plain_run(gain):
    """While no contact begins: without gain to the bit; with gain the roundings of the record's attitude are heard,
    1e-16 rad over 5e-5 s."""
    W, target = own_record(TABLE.problem(3e-3), 5, gain)
    np.testing.assert_allclose(listen(TABLE.problem(3e-3), target), W, rtol=0, atol=1e-10 if gain else 0)


@pytest.mark.parametrize("knock", [0.0, 1e-3])
def test_listening_moves_no_energy_into_a_block_at_rest(knock):
    """A block in balance on its feet, or knocked out of it [rad/s], listens to a record at rest with large gains."""
    problem = TABLE.problem(0.02)
    flat = problem.points.P.copy()
    flat[:, 2] = flat[:, 2].min()
    xi = problem.block.mass * problem.block.g / np.sum(problem.points.K_N)
    start = replace(problem.start, x=np.array([0, 0, -flat[0, 2] - xi]), Lambda=np.eye(3), W=np.array([knock, 0, 0]))
    problem = problem.replace(start=start, points=replace(problem.points, P=flat))
    K = 41
    target = Target(np.zeros((K, 3)), np.broadcast_to(np.eye(3), (K, 3, 3)), np.full((K, 3), 0.9), np.full(K, 0.9), 50)
    rates = np.linalg.norm(listen(problem, target), axis=-1)
    # In balance to a rounding of the weight, whose acceleration of 1e-15 g turns it by less than this in 0.02 s.
    assert rates.max() <= max(knock, 1e-14)
    assert rates[-1] <= max(1e-6 * knock, 1e-14)


def test_a_batch_has_the_bits_of_its_blocks():
    problems = [TABLE.replace(K_N=K_N).problem(1e-3) for K_N in (2e7, 5e7)]
    _, target = own_record(problems[0], 5, 0.3)
    two = Target(
        *(np.stack([a, 0.5 * a]) for a in (target.rates, target.turns, target.gain_rate, target.gain_attitude)), 5
    )
    both = listen(stack(problems), two)
    for i, problem in enumerate(problems):
        one = Target(two.rates[i], two.turns[i], two.gain_rate[i], two.gain_attitude[i], 5)
        np.testing.assert_array_equal(both[i], listen(problem, one))


@pytest.mark.parametrize(("key", "number"), [("x", np.nan), ("v", np.inf), ("W", np.nan)])
@pytest.mark.parametrize("feet", [False, True])
def test_a_run_that_loses_its_numbers_has_none_from_there_on(key, number, feet):
    """Without feet a lost position or velocity turns no block: its rates are numbers still, of a run that is none. With
    them nothing is warned of. The block beside keeps its bits."""
    sound = physics.flying((2.0, 2.0, 1.0), (0.1, 0.2, 0.3), 1e-3, 0.01)
    if feet:
        sound = TABLE.problem(1e-3).replace(start=State.at_rest(sound.start.x, np.eye(3), 8, W=sound.start.W))
    lost = sound.replace(start=replace(sound.start, **{key: getattr(sound.start, key) + [number, 0, 0]}))
    K = 4
    target = Target(np.zeros((K, 3)), np.broadcast_to(np.eye(3), (K, 3, 3)), np.zeros((K, 3)), np.zeros(K), 2)
    two = Target(*(np.stack([a, a]) for a in (target.rates, target.turns, target.gain_rate, target.gain_attitude)), 2)
    alone, (first, second) = listen(lost, target), listen(stack([lost, sound]), two)
    for rates in (alone, first):
        np.testing.assert_array_equal(rates[0], lost.start.W)
        assert np.isnan(rates[1:]).all()
    np.testing.assert_array_equal(second, listen(sound, target))
    assert np.isfinite(second).all()
