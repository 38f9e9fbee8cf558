"""What is watched of a run while the plate shakes: extremes, impacts, and whether the run may end. Compiled.

`rockref.shake.extremes` says the same of the rows of a response; a test compares the two.
"""

from __future__ import annotations

import math

from rockref.engines.compiled import columns as col
from rockref.engines.compiled.jit import called

#: Columns of what a run leaves: whether it fell, why it ended, when; largest squared sine of the tilt, its cosine and
#: its time; largest squared slide [m2]; cosine and sine of the largest twist; time of uplift; number of impacts; place
#: of the feet at the end (2) [m]; cosine and sine of the twist there; squared sine of the tilt there.
FOUND = 16
FELL, ENDED, END, SINE, COSINE, TILTED, SLIDE, TWIST_C, TWIST_S, UPLIFT, IMPACTS, LEFT_X, LEFT_Y = range(13)
LEFT_C, LEFT_S, LEFT_SINE = 13, 14, 15
#: Why a run ended: the time asked for is over, it fell, it came to rest, it lost its numbers.
TIME_OVER, HAS_FALLEN, AT_REST, LOST = 0.0, 1.0, 2.0, 3.0
#: What is kept of each foot: its place at the start (2), whether it carried then, ticks in the air.
FOOT = 4
#: What is kept of each run: cosine and sine of its heading at the start, ticks at rest, tick of the last impact, tick.
KEPT = 5
#: What `limits` holds: cosine of the tilt beyond which a block has fallen, squared speed [m2/s2] and squared rate
#: [rad2/s2] below which it is at rest, ticks of rest, ticks in the air before a landing is an impact.
LIMITS = 5


@called
def begin_watch(lane, state, centres, memory, foot, kept, found):
    """Note where a run and each of its feet start; a foot in the air has a place, and no anchor."""
    for j in range(FOUND):
        found[j] = 0.0
    found[COSINE] = found[TWIST_C] = found[LEFT_C] = 1.0
    found[UPLIFT] = math.nan
    for i in range(memory.shape[0]):
        Px, Py, Pz = centres[i, 0, lane], centres[i, 1, lane], centres[i, 2, lane]
        foot[i, 0, lane] = state[0, lane] + (state[6, lane] * Px + state[7, lane] * Py + state[8, lane] * Pz)
        foot[i, 1, lane] = state[1, lane] + (state[9, lane] * Px + state[10, lane] * Py + state[11, lane] * Pz)
        foot[i, 2, lane], foot[i, 3, lane] = memory[i, col.ANCHORED, lane], 0.0
    size = math.sqrt(state[6, lane] * state[6, lane] + state[9, lane] * state[9, lane])
    kept[0, lane], kept[1, lane] = state[6, lane] / size, state[9, lane] / size
    kept[2, lane], kept[3, lane], kept[4, lane] = 0.0, -math.inf, 0.0


@called
def watch_feet(lane, memory, foot, kept, found, air, t):
    """Look at the feet of a run: uplift, impacts, slide; return how many stand."""
    stand, dx, dy, landed, lifted = 0.0, 0.0, 0.0, False, False
    for i in range(memory.shape[0]):
        if memory[i, col.ANCHORED, lane] == 0.0:
            foot[i, 3, lane] += 1.0
            lifted = lifted or foot[i, 2, lane] != 0.0
        else:
            landed = landed or foot[i, 3, lane] >= air
            foot[i, 3, lane] = 0.0
            stand += 1.0
            dx += memory[i, col.S_X, lane] - foot[i, 0, lane]
            dy += memory[i, col.S_Y, lane] - foot[i, 1, lane]
    if lifted and not found[UPLIFT] >= 0.0:
        found[UPLIFT] = t
    if landed and kept[4, lane] - kept[3, lane] >= air:
        found[IMPACTS] += 1.0
        kept[3, lane] = kept[4, lane]
    if stand > 0.0:
        found[LEFT_X], found[LEFT_Y] = dx / stand, dy / stand
        found[SLIDE] = max(found[SLIDE], found[LEFT_X] * found[LEFT_X] + found[LEFT_Y] * found[LEFT_Y])
    return stand


@called
def watch_pose(lane, state, kept, found, t):
    """Look at tilt and twist of a run."""
    sine = state[8, lane] * state[8, lane] + state[11, lane] * state[11, lane]
    if sine > found[SINE]:
        found[SINE], found[COSINE], found[TILTED] = sine, state[14, lane], t
    size = math.sqrt(state[6, lane] * state[6, lane] + state[9, lane] * state[9, lane])
    x, y = state[6, lane] / size, state[9, lane] / size
    found[LEFT_C], found[LEFT_S] = x * kept[0, lane] + y * kept[1, lane], y * kept[0, lane] - x * kept[1, lane]
    found[LEFT_SINE] = sine
    if found[LEFT_C] < found[TWIST_C]:
        found[TWIST_C], found[TWIST_S] = found[LEFT_C], found[LEFT_S]


@called
def watch(lane, state, memory, foot, kept, found, limits, ticks, quiet):
    """Look at a run after a tick; return whether it ends. Rest counts after tick `quiet`."""
    kept[4, lane] += 1.0
    t = state[col.TIME, lane]
    found[END] = t
    v2 = state[3, lane] ** 2 + state[4, lane] ** 2 + state[5, lane] ** 2
    W2 = state[15, lane] ** 2 + state[16, lane] ** 2 + state[17, lane] ** 2
    if not math.isfinite(v2 + W2 + (state[0, lane] + state[1, lane] + state[2, lane])):
        found[ENDED] = LOST
        return True
    stand = watch_feet(lane, memory, foot, kept, found, limits[4], t)
    watch_pose(lane, state, kept, found, t)
    if state[14, lane] < limits[0]:
        found[FELL], found[ENDED] = 1.0, HAS_FALLEN
        return True
    still = stand >= 3.0 and v2 < limits[1] and W2 < limits[2]
    kept[2, lane] = kept[2, lane] + 1.0 if still and kept[4, lane] > quiet else 0.0
    if kept[2, lane] >= limits[3]:
        found[ENDED] = AT_REST
        return True
    return kept[4, lane] >= ticks
