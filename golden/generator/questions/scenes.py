"""The runs of L5: what is let go, from where, and why it is worth looking at."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from golden.generator.bounds.arithmetic import Digits, converted
from golden.generator.questions.drawing import HEIGHT, THETA_0, rotation, table_3_1
from golden.independent import exact, exact_run

PER_POINT = ("P", "K_N", "C_N", "K_T", "C_T", "mu_0", "mu")
EVEN = (5e-5, 5e-5, 5e-5, 5e-5)


@dataclass(frozen=True)
class Scene:
    """A run: flat inputs without the step, duration [s], rows a second [Hz], step [s], what it shows; whether it is
    asked for as a whole, and not for a window of it alone."""

    id: str
    title: str
    q: dict[str, Any]
    duration: float
    rate: float = 250.0
    step: float = 1e-5
    whole: bool = True

    @property
    def inputs(self) -> dict[str, Any]:
        """Return flat inputs of the run."""
        return self.q | {"step": self.step, "duration": self.duration, "output_rate": self.rate}

    @property
    def converged(self) -> bool:
        """Return whether the converged solution is given too ("same physics, other scheme"); once per physics."""
        return not self.id.startswith("step_")


def at_rest(q: dict[str, Any], x: Any, Lambda: Any, v: Any = (0, 0, 0), W: Any = (0, 0, 0)) -> dict[str, Any]:
    """Return the inputs with a start state without contact history."""
    n = len(q["P"])
    pose = {
        "x": np.array(x, float),
        "Lambda": np.array(Lambda, float),
        "v": np.array(v, float),
        "W": np.array(W, float),
    }
    names = [f"{c}{k}" for k in ("ext", "int") for c in "1234"][:n]
    memory = {"s": np.zeros((n, 2)), "anchored": np.zeros(n, bool), "sliding": np.zeros(n, bool)}
    return q | pose | memory | {"names": q.get("names", names)}


def released(q: dict[str, Any], theta_0: float = THETA_0, W: Any = (0, 0, 0)) -> dict[str, Any]:
    """Return the inputs with the release posture."""
    m = Digits()
    numbers = {k: converted(q[k], m.number) for k in ("mass", "g", "P", "K_N")}
    x, Lambda = exact_run.release(**numbers, theta_0=m.number(theta_0), m=m)
    return at_rest(q, np.array(x, float), np.array(Lambda, float), W=W)


def standing(q: dict[str, Any], gap: float, **state: Any) -> dict[str, Any]:
    """Return the inputs with the block upright, its internal points `gap` above the plate."""
    return at_rest(q, (0, 0, HEIGHT / 2 + gap), np.eye(3), **state)


def flying(q: dict[str, Any]) -> dict[str, Any]:
    """Return the inputs of a body with three different moments of inertia that turns far above the plate."""
    q = q | {"inertia": np.diag([0.5, 1.25, 2.0])}
    return at_rest(q, (0.5, -0.25, 8.0), rotation((0.3, -0.2, 0.5)), v=(1.0, -0.5, 0.25), W=(3.1, 4.7, -2.3))


def without(q: dict[str, Any], *corners: int) -> dict[str, Any]:
    """Return the inputs without the two points of some corners (1..4)."""
    keep = [i for i in range(8) if i % 4 + 1 not in corners]
    names = [f"{i % 4 + 1}{'ext' if i < 4 else 'int'}" for i in keep]
    return {k: v[keep] if k in PER_POINT else v for k, v in q.items()} | {"names": names}


def corners_only(q: dict[str, Any]) -> dict[str, Any]:
    """Return the four-point model: the external points in the plane of the base."""
    P = q["P"][:4].copy()
    P[:, 2] = -HEIGHT / 2
    return {k: v[:4] if k in PER_POINT else v for k, v in q.items()} | {"P": P}


def leaning_out_of_plane(q: dict[str, Any], roll: float) -> dict[str, Any]:
    """Release with a further roll about Y, as an oblique wire gives it: one corner carries all the weight."""
    tilt, roll_ = rotation((-THETA_0, 0, 0)).tolist(), rotation((0, roll, 0)).tolist()
    Lambda = exact.product(tilt, roll_)
    heights = [exact.dot(Lambda[2], p) for p in q["P"].tolist()]
    return at_rest(q, (0, 0, -min(heights) - 2.0**-17), Lambda)


@lru_cache
def scenes() -> dict[str, Scene]:
    """Return all runs, by id."""
    base = table_3_1()
    low, pair = table_3_1(mu=0.05), table_3_1(mu=0.15, mu_0=0.25)
    even, slippery = table_3_1(delta_long=EVEN), table_3_1(mu=0.05, delta_long=EVEN)
    oblique = released(base) | {
        "inertia": base["inertia"] + np.array([[0, 0.02, -0.03], [0.02, 0, 0.015], [-0.03, 0.015, 0]])
    }
    heavy = released(base | {"g": 9.80665, "mass": 60.0})
    uneven = standing(base, 2e-5) | {"Lambda": rotation((1e-4, 2e-4, 0))}
    sliding = standing(slippery, -1e-6, v=(0.125, 0.0625, 0))
    found = [
        Scene("table_3_1", "Table 3.1, released at 0.1170 rad", released(base), 1.4),
        Scene("planar", "even feet: the motion stays in its plane", released(even), 1.4),
        Scene("out_of_plane", "released with a roll of 2 mrad: on one corner", leaning_out_of_plane(base, 2e-3), 1.4),
        Scene("spinning", "low friction, spinning about the height: the feet slide", released(low, W=(0, 0, 2.0)), 1.2),
        Scene("two_coefficients", "static above dynamic friction, spinning", released(pair, W=(0, 0, 1.0)), 1.4),
        Scene("four_points", "four corners", released(corners_only(base)), 1.4),
        Scene("one_foot_missing", "corner 3 has no points: it comes down there", released(without(base, 3)), 0.8),
        Scene("oblique_inertia", "products of inertia", oblique, 1.4),
        Scene("other_gravity", "60 kg, 9.80665 m/s2", heavy, 1.4),
        Scene("step_3e-6", "Table 3.1 with the source's smaller step", released(base), 0.6, 250.0, 3e-6, False),
        Scene("step_2e-5", "Table 3.1 with twice the step", released(base), 1.4, 250.0, 2e-5),
        Scene("static", "let go upright, leaning by 0.2 mrad: it settles on its feet", uneven, 0.3, 1000.0),
        Scene("slide", "upright, sliding, until friction has stopped it", sliding, 0.5, 500.0),
        Scene("drop", "dropped flat from 1 mm; the closed form is known", standing(even, 1e-3), 0.06, 5000.0),
        # A row every 33 1/3 steps: a clock that is added up, or cut, is some rows late before the end.
        Scene("flight", "far above the plate, three different moments: ten thousand steps", flying(base), 0.1, 3000.0),
    ]
    return {scene.id: scene for scene in found}


@dataclass(frozen=True)
class Window:
    """A short run cut out of a scene: 20 ms from an instant [s]."""

    scene: str
    instant: float
    shows: str


#: Where the mistakes of the zoo come apart: release, touch-down, impacts, sliding with and without load, lift-off.
WINDOWS = (
    Window("table_3_1", 0.0, "release"),
    Window("table_3_1", 0.5, "main impact"),
    Window("table_3_1", 0.52, "clatter"),
    Window("out_of_plane", 0.0, "one corner"),
    Window("out_of_plane", 0.49, "main impact"),
    Window("planar", 0.5, "main impact, both sides at once"),
    Window("spinning", 0.05, "sliding under half the weight"),
    Window("spinning", 0.415, "main impact while sliding"),
    Window("spinning", 0.45, "lift-off and touch while sliding"),
    Window("two_coefficients", 0.3, "between the cones"),
    Window("two_coefficients", 0.505, "main impact, two coefficients"),
    Window("oblique_inertia", 0.5, "main impact"),
    Window("slide", 0.1, "sliding on four feet"),
    Window("slide", 0.28, "sliding ends"),
    Window("drop", 0.01, "flat touch-down"),
)
#: They stand behind the trajectories, so that these keep their seeds.
LATER_WINDOWS = (Window("step_3e-6", 0.5, "main impact, with the source's smaller step"),)
WINDOW_DURATION, WINDOW_RATE = 0.02, 5000.0
