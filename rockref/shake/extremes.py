"""What is kept of a run on a plate that moves: extremes and how it ended, as numbers with units.

`rockref.engines.compiled.watching` finds them in the compiled loop; `watched` finds the same in the rows of a response,
tick by tick, for runs that only the law can make.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np

from rockref.model.contact import point_kinematics
from rockref.model.problem import Problem
from rockref.model.response import OVERTURNED, Response

#: Time from tick to tick [s]. Decided: between two of them a rocking block turns by a thousandth of its slenderness.
TICK = 5e-4
#: Time in the air [s] after which the landing of a foot is an impact, and between two impacts. Decided: clatter of feet
#: after one another and ringing on the springs are shorter, arcs of rocking that matter longer.
AIR = 0.01
#: A block is at rest where it stays slower than this, on three feet, for this long [m/s, rad/s, s]. Decided: a free
#: pendulum of a metre that is so slow for so long is within a thousandth of a degree of its end.
REST_SPEED, REST_RATE, REST_TIME = 1e-4, 1e-3, 0.5
#: Why a run has ended, by the numbers of the compiled loop.
ENDED = ("duration", "fell", "rest", "lost")


@dataclass(frozen=True)
class Extremes:
    """Of one run: how it ended and its extremes, at ticks of `TICK`.

    fell : beyond 45 degrees;  ended, end : why and when [s];  tilt, tilt_at : largest tilt of the height from the
    vertical [rad] and its time [s];  slide : largest distance, mean over the feet that stand, from where they stood at
    the start [m];  twist : largest turn about the vertical [rad];  uplift : first time a foot that carried at the start
    has left the plate [s], NaN without;  impacts : landings after `AIR` in the air;  left_x, left_y, left_twist,
    left_tilt : slide [m], twist and tilt [rad] at the end
    """

    fell: bool
    ended: str
    end: float
    tilt: float
    tilt_at: float
    slide: float
    twist: float
    uplift: float
    impacts: int
    left_x: float
    left_y: float
    left_twist: float
    left_tilt: float


#: Columns of a table of runs: the fields of `Extremes` with their units.
COLUMNS = tuple(
    {"end": "end_s", "tilt": "tilt_rad", "tilt_at": "tilt_at_s", "slide": "slide_m", "twist": "twist_rad",
     "uplift": "uplift_s", "left_x": "left_x_m", "left_y": "left_y_m", "left_twist": "left_twist_rad",
     "left_tilt": "left_tilt_rad"}.get(f.name, f.name)
    for f in fields(Extremes)
)  # fmt: skip


def limits(step: float) -> tuple[np.ndarray, int]:
    """Return the limits of the compiled loop, and the steps of one tick, for a step [s]."""
    every = max(1, round(TICK / step))
    tick = every * step
    ticks_of = [math.ceil(time / tick - 1e-9) for time in (REST_TIME, AIR)]
    return np.array([np.cos(OVERTURNED), REST_SPEED**2, REST_RATE**2, *ticks_of]), every


def ticks(problem: Problem, every: int) -> tuple[int, int]:
    """Return how many ticks a run has, and the tick after which rest counts: the end of its record."""
    tick = every * problem.step
    number = math.floor(problem.duration / tick + 1e-9)
    end = -math.inf if problem.base is None else problem.base.end - problem.start.t
    return number, 0 if end < 0 else math.ceil(end / tick - 1e-9)


def from_row(row: np.ndarray) -> Extremes:
    """Return the extremes that the compiled loop has found, a row of its table."""
    fell, ended, end, sine, cosine, at, slide, c, s, uplift, impacts, x, y, left_c, left_s, left_sine = map(float, row)
    return Extremes(
        fell=bool(fell), ended=ENDED[int(ended)], end=end,
        tilt=math.atan2(math.sqrt(sine), cosine), tilt_at=at, slide=math.sqrt(slide), twist=abs(math.atan2(s, c)),
        uplift=uplift, impacts=int(impacts), left_x=x, left_y=y, left_twist=math.atan2(left_s, left_c),
        left_tilt=math.atan2(math.sqrt(left_sine), math.sqrt(max(1 - left_sine, 0.0))),
    )  # fmt: skip


def watched(response: Response, quiet: int) -> Extremes:
    """Return the extremes of a response whose rows are the ticks, as the compiled loop finds them on the way.

    quiet : the tick after which rest counts.
    """
    limit, _ = limits(response.problem.step)
    still_for, air = limit[3:]
    L, foot = response.Lambda, response.anchored
    heading = np.arctan2(L[:, 1, 0], L[:, 0, 0])
    points, places = response.problem.points, response.problem.start
    at = point_kinematics(places.x, places.Lambda, places.v, places.W, points.P, points.radius).u[:, :2]
    impacts, found = 0, {"uplift": math.nan, "slide": 0.0, "tilt": 0.0, "tilt_at": 0.0, "twist": 0.0}
    left = dict.fromkeys(("left_x", "left_y", "left_twist", "left_tilt"), 0.0)
    aloft, still, last, ended = np.zeros(foot.shape[1]), 0, -math.inf, "duration"
    k = 0
    for k in range(1, len(response.t)):
        t = float(response.t[k])
        landed, aloft = bool(np.any(foot[k] & (aloft >= air))), np.where(foot[k], 0, aloft + 1)
        if np.any(foot[0] & ~foot[k]) and math.isnan(found["uplift"]):
            found["uplift"] = t
        if landed and k - last >= air:
            impacts, last = impacts + 1, k
        if foot[k].any():
            left["left_x"], left["left_y"] = np.mean((response.s[k] - at)[foot[k]], axis=0).tolist()
            found["slide"] = max(found["slide"], math.hypot(left["left_x"], left["left_y"]))
        tilt = math.atan2(math.hypot(L[k, 0, 2], L[k, 1, 2]), L[k, 2, 2])
        if tilt > found["tilt"]:
            found["tilt"], found["tilt_at"] = tilt, t
        twist = math.remainder(heading[k] - heading[0], 2 * math.pi)
        found["twist"], left["left_twist"], left["left_tilt"] = max(found["twist"], abs(twist)), twist, tilt
        if L[k, 2, 2] < limit[0]:
            ended = "fell"
            break
        slow = np.sum(response.v[k] ** 2) < limit[1] and np.sum(response.W[k] ** 2) < limit[2]
        still = still + 1 if slow and np.sum(foot[k]) >= 3 and k > quiet else 0
        if still >= still_for:
            ended = "rest"
            break
    return Extremes(fell=ended == "fell", ended=ended, end=float(response.t[k]), impacts=impacts, **found, **left)
