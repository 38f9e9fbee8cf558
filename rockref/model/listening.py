"""A run that listens: the law, pulled at every tick a little towards rates and attitudes that were observed.

Between two ticks the law moves the block. At a tick the run gives its rates, which are a prediction from all that was
observed before, and is then corrected. What was observed less what was predicted is the innovation. The first force of
a contact counts by the share of its step in contact (`rockref.model.contact.share_of_first`): so innovations hardly
depend on where the steps fall.

Sources: D. G. Luenberger (1971), An introduction to observers, IEEE Trans. Autom. Control 16:596-602,
doi:10.1109/TAC.1971.1099826; L. Ljung (1999), System Identification: Theory for the User, 2nd ed., Prentice Hall,
ISBN 978-0-13-656695-3, chapters 3 and 7 (prediction errors).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.model import contact
from rockref.model.assembly import sum_over_points
from rockref.model.integrator import first_evaluation, prepared_inertia, step, update_rotation
from rockref.model.problem import Problem, State, as_arrays
from rockref.model.rotation import apply, cross, exp_minus_identity, product, transposed

#: Below this share of the weight the feet carry nothing about which the block could turn. Decided: a block that lands
#: or rocks carries some of its weight in nearly every tick; in flight the sum is zero.
LEAST_LOAD = 0.02


@dataclass(frozen=True)
class Target:
    """What one run, or each run of a batch (leading axes), listens to, at ticks 0 .. K-1.

    rates : (..., K, 3) observed body rates [rad/s]
    turns : (..., K, 3, 3) observed rotation since the start, in the axes that the block had then
    gain_rate, gain_attitude : (..., K, 3) and (..., K), shares from 0 to 1 by which a tick corrects
    every : steps from tick to tick
    """

    rates: np.ndarray
    turns: np.ndarray
    gain_rate: np.ndarray
    gain_attitude: np.ndarray
    every: int


def rate_correction(W, W_observed, gain):
    """Return the change of the rates [rad/s], body axes; all (..., 3)."""
    return gain * (W_observed - W)


def attitude_correction(Lambda, Lambda_observed, gain):
    """Return the rotation vector [rad], body axes (..., 3), that takes a share of the way to the observed attitude.

    The vector of the skew part of Lambda^T Lambda_observed, the sine of the angle along its axis; both (..., 3, 3),
    gain (...).
    """
    D = product(transposed(Lambda), Lambda_observed)
    skew = [D[..., 2, 1] - D[..., 1, 2], D[..., 0, 2] - D[..., 2, 0], D[..., 1, 0] - D[..., 0, 1]]
    return gain[..., None] * (0.5 * np.stack(skew, axis=-1))


def lever_arms(problem: Problem, state: State) -> np.ndarray:
    """Return the contact points from the centre of mass, plate axes, (..., n, 3) [m]."""
    points = problem.points
    return contact.point_kinematics(state.x, state.Lambda, state.v, state.W, points.P, points.radius).r


def corrected(problem: Problem, state: State, dW, dq, load, moment, steps: int) -> State:
    """Return the state after a correction: the block turns about the place that carries it.

    So no foot that carries is torn from the plate, pressed into it or dragged over it.

    What the next step takes over from the last one stays as it is. The momentum J W is formed anew from W. Acceleration
    a, moment T and forces F are loads that have acted: the next step weighs them by one half, and its own evaluation
    sees the corrected block. T stays in body axes. An anchor moves with its foot, since a correction is no slip. The
    other memories stay (deepest penetration, moments and yaw that are held, motion of the plate): they count the turn
    of the steps only.

    Parameters
    ----------
    dW, dq : (..., 3) change of the rates [rad/s] and rotation vector [rad], body axes.
    load, moment : (...) and (..., 3), sums over points and the last `steps` steps of the normal force [N] and of the
        normal force times the lever arm [N m].
    """
    Lambda, weight = state.Lambda, problem.block.mass * problem.block.g
    carries = load > LEAST_LOAD * weight * steps
    place = moment / np.where(carries, load, 1)[..., None]
    change, turn = apply(Lambda, dW), apply(Lambda, dq)
    v = np.where(carries[..., None], state.v - cross(change, place), state.v)
    x = np.where(carries[..., None], state.x - cross(turn, place), state.x)
    arms = lever_arms(problem, state) - place[..., None, :]
    foot = cross(np.broadcast_to(turn[..., None, :], arms.shape), arms)
    moves = state.anchored & carries[..., None]
    s = np.where(moves[..., None], state.s + foot[..., :2], state.s)
    # The law's own rotation: the angle may be large while a run finds its target, and its twin has the same bits.
    turned = update_rotation(Lambda, exp_minus_identity(dq))
    return replace(state, x=x, v=v, s=s, Lambda=turned, W=state.W + dW)


def listen(problem: Problem, target: Target) -> np.ndarray:
    """Return the body rates (..., K, 3) [rad/s] of a listening run at the ticks, each before its own correction.

    The first row holds the rates of the start. A run that loses its numbers has NaN from there on.

    Raises
    ------
    InputError
        E-ANGLE, where a step turns the block too far.
    """
    problem = replace(as_arrays(problem), first_by_share=True)
    inertia = prepared_inertia(problem.block)
    rates = np.full_like(target.rates, np.nan)
    with np.errstate(all="ignore"):
        state = first_evaluation(problem)
        observed = product(np.broadcast_to(state.Lambda[..., None, :, :], target.turns.shape), target.turns)
        rates[..., 0, :] = state.W
        for k in range(1, rates.shape[-2]):
            load = moment = np.zeros(())
            for _ in range(target.every):
                state = step(problem, state, inertia)
                F = np.asarray(state.F)
                load = load + sum_over_points(F)[..., 2]
                moment = moment + sum_over_points(F[..., 2:] * lever_arms(problem, state))
            lost = ~np.all(np.isfinite(state.x) & np.isfinite(state.v) & np.isfinite(state.W), axis=-1)
            rates[..., k, :] = np.where(lost[..., None], np.nan, state.W)
            if np.all(lost):
                break
            dW = rate_correction(state.W, target.rates[..., k, :], target.gain_rate[..., k, :])
            dq = attitude_correction(state.Lambda, observed[..., k, :, :], target.gain_attitude[..., k])
            state = corrected(problem, state, dW, dq, load, moment, target.every)
    return rates
