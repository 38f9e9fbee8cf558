"""The correction of runs that listen, compiled; the text of `rockref.model.listening` for one run or for lanes."""

from __future__ import annotations

from rockref.engines.compiled import columns as col
from rockref.engines.compiled.jit import inlined
from rockref.engines.compiled.lanes import anyof, both, choose
from rockref.engines.compiled.steps import exp_minus_identity, turned
from rockref.model.listening import LEAST_LOAD

#: What is heard at a tick: rates (3), turn since the start (9), factors on the gains (4).
HEARD = 16
RATES, TURN, FACTORS = 0, 3, 12


@inlined
def observed_row(r0, r1, r2, tick):
    """Return a row of the attitude at the start times the observed turn."""
    return (
        r0 * tick[3] + r1 * tick[6] + r2 * tick[9],
        r0 * tick[4] + r1 * tick[7] + r2 * tick[10],
        r0 * tick[5] + r1 * tick[8] + r2 * tick[11],
    )


@inlined
def attitude_correction(state, released, tick, gain):
    """Return the rotation vector that takes a share of the way to the observed attitude."""
    L0, L1, L2, L3, L4, L5 = state[6], state[7], state[8], state[9], state[10], state[11]
    L6, L7, L8 = state[12], state[13], state[14]
    O0, O1, O2 = observed_row(released[0], released[1], released[2], tick)
    O3, O4, O5 = observed_row(released[3], released[4], released[5], tick)
    O6, O7, O8 = observed_row(released[6], released[7], released[8], tick)
    return (
        gain * (0.5 * ((L2 * O1 + L5 * O4 + L8 * O7) - (L1 * O2 + L4 * O5 + L7 * O8))),
        gain * (0.5 * ((L0 * O2 + L3 * O5 + L6 * O8) - (L2 * O0 + L5 * O3 + L8 * O6))),
        gain * (0.5 * ((L1 * O0 + L4 * O3 + L7 * O6) - (L0 * O1 + L3 * O4 + L6 * O7))),
    )


@inlined
def move_anchors(centres, props, memory, state, carries, turn, place):
    """Move the anchors of touching points with their feet, which turn about the loaded place."""
    (t0, t1, t2), (p0, p1, p2) = turn, place
    for i in range(centres.shape[0]):
        moves = both(memory[i, col.ANCHORED] != 0.0, carries)
        if anyof(moves):
            Px, Py, Pz = centres[i, 0], centres[i, 1], centres[i, 2]
            rx = (state[6] * Px + state[7] * Py + state[8] * Pz) - p0
            ry = (state[9] * Px + state[10] * Py + state[11] * Pz) - p1
            rz = ((state[12] * Px + state[13] * Py + state[14] * Pz) - props[i, col.RADIUS]) - p2
            sx, sy = memory[i, col.S_X], memory[i, col.S_Y]
            memory[i, col.S_X] = choose(moves, sx + (t1 * rz - t2 * ry), sx)
            memory[i, col.S_Y] = choose(moves, sy + (t2 * rx - t0 * rz), sy)


@inlined
def to_plate(state, a, b, c):
    """Multiply Lambda by a vector in body axes."""
    return (
        state[6] * a + state[7] * b + state[8] * c,
        state[9] * a + state[10] * b + state[11] * c,
        state[12] * a + state[13] * b + state[14] * c,
    )


@inlined
def move_back(state, at, carries, c0, c1, c2, p0, p1, p2):
    """Subtract c x p, from column `at` of the state on."""
    v0, v1, v2 = state[at], state[at + 1], state[at + 2]
    state[at] = choose(carries, v0 - (c1 * p2 - c2 * p1), v0)
    state[at + 1] = choose(carries, v1 - (c2 * p0 - c0 * p2), v1)
    state[at + 2] = choose(carries, v2 - (c0 * p1 - c1 * p0), v2)


@inlined
def correct(body, centres, props, memory, state, bearing, released, tick, gains, number):
    """Correct the state at a tick after `number` steps, and move the anchors.

    bearing : sums of normal force and normal force times lever arm over these steps;  released : Lambda of the start.
    tick : (HEARD,) what is heard;  gains : of rates and attitude.
    """
    d0 = gains[0] * tick[12] * (tick[0] - state[15])
    d1 = gains[0] * tick[13] * (tick[1] - state[16])
    d2 = gains[0] * tick[14] * (tick[2] - state[17])
    q0, q1, q2 = attitude_correction(state, released, tick, gains[1] * tick[15])
    load, p0, p1, p2 = bearing
    carries = load > LEAST_LOAD * (body[col.MASS] * body[col.GRAVITY]) * number
    if anyof(carries):
        load = choose(carries, load, 1.0)
        p0, p1, p2 = p0 / load, p1 / load, p2 / load
        c0, c1, c2 = to_plate(state, d0, d1, d2)
        move_back(state, col.V, carries, c0, c1, c2, p0, p1, p2)
        t0, t1, t2 = to_plate(state, q0, q1, q2)
        move_back(state, col.X, carries, t0, t1, t2, p0, p1, p2)
        move_anchors(centres, props, memory, state, carries, (t0, t1, t2), (p0, p1, p2))
    E = exp_minus_identity(q0, q1, q2)
    state[6], state[7], state[8] = turned(state[6], state[7], state[8], E)
    state[9], state[10], state[11] = turned(state[9], state[10], state[11], E)
    state[12], state[13], state[14] = turned(state[12], state[13], state[14], E)
    state[15], state[16], state[17] = state[15] + d0, state[16] + d1, state[17] + d2
