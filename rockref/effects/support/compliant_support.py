"""A plate that yields."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.prior import Prior
from rockref.model import assembly
from rockref.model.contact import point_kinematics

#: Radius of gyration of the plate about X [m]; decided: that of a plate 0.6 m wide.
GYRATION = 0.6 / math.sqrt(12)
#: Pitch up to which a plate does not pitch: its frequency would be ten times that of its bouncing, which no explicit
#: step has to follow (decided).
LEAST_PITCH = 0.01
#: Frequencies [Hz] and masses [kg] of the plate from which fits start, since what rings shows nothing in a small step
#: from zero. Decided: steps of 12 % over the range of tones that rocking excites; the typical mass and three times it.
TONES, MASSES = tuple(100.0 / 1.12**k for k in range(18)), (100.0, 300.0)
#: Spread of the logarithms of mass and damping ratio (decided: a factor of two).
SPREAD = 0.7

#: What moves, its stiffness, its damping.
Oscillator = tuple[float, float, float]


@dataclass(frozen=True)
class CompliantSupport(Effect):
    """The plate is a mass on a spring and a damper, free in the vertical, and about X if it pitches; it carries the
    contact forces.

    M q'' = -sum F_N + m g - k q - c q', with k = (2 pi f)^2 M, c = 2 ratio sqrt(k M); q counts from the static
    equilibrium under the block's weight, so the release posture stays. It pitches by phi about the origin of the plate
    axes, the axis about which the block rocks: J phi'' = m g y_0 - sum F_N y - k_p phi - c_p phi', with the weight at
    its pivot y_0 at release, J = M GYRATION^2, k_p = (2 pi f)^2 J / pitch, c_p = 2 ratio sqrt(k_p J). Stepped by
    semi-implicit Euler after the block: the points see the plate of one step before. Simplified: no pitching about Y.
    """

    id = "compliant_support"
    question = "support"
    quantities = {
        "mass": Quantity("kg", 100.0, 20.0, 2000.0, 100.0, "+", "of the plate that moves along", POSITIVE),
        "frequency": Quantity("Hz", 0.0, 14.0, 300.0, 60.0, "+", "of the plate alone; 0: rigid", 0.0),
        "ratio": Quantity("1", 0.03, 0.0, 0.2, 0.03, "+", "damping ratio of the plate alone", 0.0),
        "pitch": Quantity("1", 0.0, 0.0, 4.0, 0.0, "+", "(frequency / that of its pitching)^2; 0: none", 0.0),
    }
    switches = not_with_block = ("frequency",)  # as the contacts', whose stiffness grows with the mass
    priors = {"mass": Prior("shape", spread=SPREAD), "ratio": Prior("shape", spread=SPREAD)}
    priors |= {"frequency": Prior(scale="compliance"), "pitch": Prior("form")}
    seeds = tuple({"mass": mass, "frequency": frequency} for mass in MASSES for frequency in TONES)
    sentence = "The plate and its table give a little under each impact and ring on after it."
    equation = r"M\ddot q = -\sum_i F_i^{(N)} + m g - k q - c\dot q,\quad \xi_i = q + \varphi y_i - z_i"
    source = (
        "I. N. Psycharis, P. C. Jennings (1983), Rocking of slender rigid bodies allowed to uplift, "
        "Earthquake Eng. Struct. Dyn. 11:57-76, doi:10.1002/eqe.4290110106"
    )
    not_shaken = "has a mass of its own, which a moving table would shake too: the law has no term for that"
    confounder = "hertzian_contact"
    experiment = "Put an accelerometer on the plate, or the plate on the floor: its ringing goes or stays."

    mass: float = 100.0
    frequency: float = 0.0
    ratio: float = 0.03
    pitch: float = 0.0

    def bouncing(self) -> Oscillator:
        """Return mass [kg], stiffness [N/m] and damping [N s/m] of the plate in the vertical."""
        return oscillator(self.mass, (2 * math.pi * self.frequency) ** 2 * self.mass, self.ratio)

    def pitching(self) -> Oscillator | None:
        """Return inertia [kg m2], stiffness [N m/rad] and damping [N m s/rad] about X; None where the plate does not
        pitch."""
        if self.is_absent() or self.pitch <= LEAST_PITCH:
            return None
        J = self.mass * GYRATION**2
        return oscillator(J, (2 * math.pi * self.frequency) ** 2 * J / self.pitch, self.ratio)

    def start(self, problem):
        moving = ("q", "q_rate") if self.pitching() is None else ("q", "q_rate", "pitch", "pitch_rate")
        m = {key: np.zeros_like(problem.block.mass) for key in moving}
        return m if len(m) == 2 else m | {"moment": moment_at_rest(problem)}

    def plate_motion(self, t, m):
        if self.is_absent():
            return None
        x, _, up = np.eye(3, dtype=m["q"].dtype)
        motion = m["q"][..., None] * up, m["q_rate"][..., None] * up
        if self.pitching() is None:
            return motion
        return *motion, m["pitch"][..., None] * x, m["pitch_rate"][..., None] * x

    def advance(self, problem, c, h, m):
        if self.is_absent():
            return
        carried = assembly.sum_over_points(c.F)[..., 2]
        turning = assembly.sum_over_points(c.k.u[..., 1:2] * c.F)[..., 2]
        for effect in problem.effects:
            if isinstance(effect, Adhesion) and not effect.is_absent():
                force, moment = effect.point_wrench(problem, c, {})
                carried = carried + force[..., 2]
                turning = turning + (moment[..., 0] + (c.k.u - c.k.r)[..., 0, 1] * force[..., 2])
        swing(m, "q", problem.block.mass * problem.block.g - carried, self.bouncing(), h)
        if pitching := self.pitching():
            swing(m, "pitch", m["moment"] - turning, pitching, h)


def oscillator(mass: float, k: float, ratio: float) -> Oscillator:
    """Return mass or inertia, stiffness, and the damping of this ratio."""
    return mass, k, 2 * ratio * math.sqrt(k * mass)


def swing(m, name: str, load, of: Oscillator, h: float) -> None:
    """Advance `name` and its rate by one semi-implicit step under a load."""
    mass, k, damping = of
    rate = f"{name}_rate"
    m[rate] = m[rate] + h * (load - k * m[name] - damping * m[rate]) / mass
    m[name] = m[name] + h * m[rate]


def moment_at_rest(problem) -> np.ndarray:
    """Return moment of the weight about X [N m], on the lowest point at the start, under which the plate is level:
    (...)."""
    s, points = problem.start, problem.points
    u = point_kinematics(s.x, s.Lambda, s.v, s.W, points.P, points.radius).u
    lowest = np.argmin(u[..., 2], axis=-1)
    y = np.take_along_axis(u[..., 1], np.asarray(lowest)[..., None], axis=-1)[..., 0]
    return problem.block.mass * problem.block.g * y
