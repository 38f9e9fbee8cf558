"""A floor that shakes."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import Effect, Quantity
from rockref.effects.prior import Prior


@dataclass(frozen=True)
class BaseVibration(Effect):
    """An inertial force -m A cos(2 pi f t + phase) at the centre of mass, along a horizontal direction.

    The equations are those of the plate's own axes, which accelerate. Each run has a phase of its own, since the floor
    does not know when the wire lets go. Machines bring a second harmonic, whose size and phase against the first tone
    all runs share. Simplified: no other tones.
    """

    id = "base_vibration"
    question = "loads"
    quantities = {
        "amplitude": Quantity("m/s2", 0.0, 1e-3, 0.5, 0.1, "any", "of the base's acceleration"),
        "frequency": Quantity("Hz", 10.0, 1.0, 60.0, 10.0, "+", "of the base's motion", 0.0),
        "direction": Quantity("rad", 0.0, -math.pi, math.pi, 0.0, "any", "0: along y of the laboratory, pi/2: along x"),
        "phase": Quantity("rad", 0.0, -math.pi, math.pi, 0.0, "any", "at t = 0; its own in every run"),
        "harmonic_cosine": Quantity("1", 0.0, -1.0, 1.0, 0.0, "any", "second harmonic over the first", -1.0, 1.0),
        "harmonic_sine": Quantity("1", 0.0, -1.0, 1.0, 0.0, "any", "its part a quarter later", -1.0, 1.0),
    }
    switches = ("amplitude",)
    # Decided: a spectrum knows the tone within 2 %, and a fit may leave it; half a radian is half way to another axis.
    priors = {
        "frequency": Prior("shape", spread=0.02, deviation=10.0),
        "direction": Prior("shape", "linear", spread=0.5, deviation=3.0),
        "harmonic_cosine": Prior("form"),
        "harmonic_sine": Prior("form"),
    }
    of_run = ("amplitude", "phase")
    sentence = "Traffic, pumps or the table's own control shake the plate, and the block feels it as an inertial force."
    equation = (
        r"F = -m A\,(\cos\psi + q_c\cos 2\psi + q_s\sin 2\psi)\,(\sin d,\ \cos d,\ 0),\quad "
        r"\psi = 2\pi f t + \varphi"
    )
    source = (
        "C.-S. Yim, A. K. Chopra, J. Penzien (1980), Earthquake Eng. Struct. Dyn. 8:565-587, doi:10.1002/eqe.4290080606"
    )
    confounder = "gyro_drift"
    experiment = "Put an accelerometer on the plate, record at rest, repeat at night: it is not locked to the release."

    amplitude: float = 0.0
    frequency: float = 10.0
    direction: float = 0.0
    phase: float = 0.0
    harmonic_cosine: float = 0.0
    harmonic_sine: float = 0.0

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        if self.is_absent():
            return None
        size = -problem.block.mass * self.amplitude * self.wave(c.t)
        F = np.zeros_like(x)
        F[..., 0], F[..., 1] = size * math.sin(self.direction), size * math.cos(self.direction)
        return F, np.zeros_like(x)

    def wave(self, t):
        """Return the base's acceleration at time t (...) s over its amplitude, first tone and second harmonic."""
        # math's functions for one time, so that a run keeps its bits; windows of a fit have a time each.
        cos, sin = (np.cos, np.sin) if np.ndim(t) else (math.cos, math.sin)
        psi = 2 * math.pi * self.frequency * t + self.phase
        x, y = cos(psi), sin(psi)
        return x + self.harmonic_cosine * (x * x - y * y) + self.harmonic_sine * (2.0 * x * y)
