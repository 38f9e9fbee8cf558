"""What stands where in the flat arrays of the compiled step."""

from __future__ import annotations

#: Columns of `body`: mass, g, J (9), J^-1 (9), whether the axes are principal.
BODY = 21
MASS, GRAVITY, J, J_INVERSE, PRINCIPAL = 0, 1, 2, 11, 20
#: One more column of `body`, of runs that go abreast: the step in which the first force of a contact counts by its
#: share [s]; 0 where it counts in full.
ONSET = BODY
#: Columns of `state`: x, v, Lambda (9), W, a, T, whether a and T are given, t, origin, count; of the plate: q, q_rate,
#: pitch, pitch_rate.
STATE = 32
X, V, L, W_, A_, T_, GIVEN, TIME, ORIGIN, COUNT, Q, Q_RATE = 0, 3, 6, 15, 18, 21, 24, 25, 26, 27, 28, 29
PITCH, PITCH_RATE = 30, 31
#: The plate's motion, all of it.
PLATE = slice(Q, PITCH_RATE + 1)
#: Columns of `props` per point: stiffness, damping, friction, foot radius, foot (1 to 4, for effects by foot; else 0).
PROPS = 8
K_N, K_T, C_N, C_T, MU_0, MU, RADIUS, FOOT = 0, 1, 2, 3, 4, 5, 6, 7
#: Columns of `memory` per point: anchor s (2), anchored, sliding; of effects: largest penetration, yaw, moment that is
#: held against rolling (2).
MEMORY = 8
S_X, S_Y, ANCHORED, SLIDING, XI_LARGEST, YAW, ROLL_X, ROLL_Y = 0, 1, 2, 3, 4, 5, 6, 7
