"""What may be missing behind outcomes on a shake table: in the contact, under the feet, in the table."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from scipy.integrate import cumulative_trapezoid

from rockref.api import Model
from rockref.model.base_motion import BaseMotion
from rockref.model.problem import GRAVITY
from rockref.shake.ensemble import Draws


@dataclass(frozen=True, eq=False)
class Setting:
    """What runs are made of: the block, the motion of the plate in each test, what is drawn anew."""

    model: Model
    motions: tuple[BaseMotion, ...]
    draws: Draws


@dataclass(frozen=True)
class Candidate:
    """An effect of one number, absent at zero.

    key, unit : of its number;  typical : what is often found, the deviation of the prior;  signed : zero is no end
    apply : returns a setting with the effect, of this size in `unit`
    """

    id: str
    key: str
    unit: str
    typical: float
    apply: Callable[[Setting, float], Setting]
    signed: bool = True


def with_contact(model: Model, damping: float = 1.0, friction: float = 1.0) -> Model:
    """Return a model with the damping and the friction of all its points multiplied by factors."""
    factors = {"C_N": damping, "C_T": damping, "mu_0": friction, "mu": friction}
    if model.points == "custom" and model.custom_points is not None:
        own = {key: getattr(model.custom_points, key) * factor for key, factor in factors.items()}
        return model.replace(custom_points=replace(model.custom_points, **own))
    if model.properties is not None:
        scaled = {key: np.asarray(value) * factors.get(key, 1.0) for key, value in model.properties.items()}
        return model.replace(properties=scaled)
    p = model.parameters
    return model.replace(
        beta_int=p.beta_int * damping, beta_ext=p.beta_ext * damping,
        mu_int=p.mu_int * friction, mu_ext=p.mu_ext * friction,
    )  # fmt: skip


def contact_damping(setting: Setting, size: float) -> Setting:
    """Multiply the damping of the contact by exp(size): less of it bounces more."""
    return replace(setting, model=with_contact(setting.model, damping=math.exp(size)))


def contact_friction(setting: Setting, size: float) -> Setting:
    """Multiply the friction of all points by exp(size)."""
    return replace(setting, model=with_contact(setting.model, friction=math.exp(size)))


def uneven_feet(setting: Setting, size: float) -> Setting:
    """Draw the height of each foot with this much more deviation [m]."""
    return replace(setting, draws=replace(setting.draws, feet=math.hypot(setting.draws.feet, size)))


def table_gain(setting: Setting, size: float) -> Setting:
    """Multiply the motion of the table by 1 + size."""
    return moved(setting, lambda base: base.a * (1.0 + size))


def cross_motion(setting: Setting, size: float) -> Setting:
    """Add to each horizontal axis of the table this share of the other one."""
    mix = np.array([[1.0, size, 0.0], [size, 1.0, 0.0], [0.0, 0.0, 1.0]])
    return moved(setting, lambda base: base.a @ mix)


def table_pitching(setting: Setting, size: float) -> Setting:
    """Tilt the table by `size` [rad/m] times its displacement, of which the block feels g sin(tilt) along it.

    A slow tilt: what a table that turns does beside, by its angular acceleration, is left out.
    """
    return moved(setting, lambda base: base.a + GRAVITY * np.sin(size * displacement(base)))


def axis_delay(setting: Setting, size: float) -> Setting:
    """Let the table's y axis come later than x and z by this time [s]."""

    def late(base: BaseMotion) -> np.ndarray:
        a = base.a.copy()
        t = base.dt * np.arange(len(a))
        a[:, 1] = np.interp(t - size, t, base.a[:, 1], left=0.0, right=0.0)
        return a

    return moved(setting, late)


def displacement(base: BaseMotion) -> np.ndarray:
    """Return the horizontal displacement of the plate (n, 3) [m], zero along z; it begins at rest and ends at rest.

    Both integrals are those of straight lines between samples. A straight line is taken off the velocity and off the
    displacement, so that both are zero at both ends: what drifts is no motion of a table.
    """
    found = base.a * np.array([1.0, 1.0, 0.0])
    share = np.linspace(0.0, 1.0, len(found))[:, None]
    for _ in range(2):
        found = cumulative_trapezoid(found, dx=base.dt, axis=0, initial=0.0)
        found -= share * found[-1]
    return found


def moved(setting: Setting, acceleration: Callable[[BaseMotion], np.ndarray]) -> Setting:
    """Return a setting whose motions have another acceleration; tests of one motion keep sharing it."""
    made: dict[int, BaseMotion] = {}
    for base in setting.motions:
        if id(base) not in made:
            made[id(base)] = replace(base, a=acceleration(base))
    return replace(setting, motions=tuple(made[id(base)] for base in setting.motions))


#: Typical sizes are decided: a factor of 1.6 on damping and of 1.3 on friction; feet filed to a tenth of a millimetre;
#: a table that gives a tenth too much, couples a tenth across, pitches by half a degree at 0.1 m, and whose second
#: axis is a fiftieth of a second late.
CANDIDATES = (
    Candidate("contact_damping", "log_factor", "", 0.5, contact_damping),
    Candidate("contact_friction", "log_factor", "", 0.3, contact_friction),
    Candidate("uneven_feet", "deviation", "m", 1e-4, uneven_feet, signed=False),
    Candidate("table_gain", "share", "", 0.1, table_gain),
    Candidate("cross_motion", "share", "", 0.1, cross_motion),
    Candidate("table_pitching", "rate", "rad/m", 0.1, table_pitching),
    Candidate("axis_delay", "delay", "s", 0.02, axis_delay),
)
