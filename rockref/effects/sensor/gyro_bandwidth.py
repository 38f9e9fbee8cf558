"""A gyroscope that is slow."""

import math
from dataclasses import dataclass

import numpy as np

from rockref.effects.base import POSITIVE, Effect, Quantity
from rockref.model.errors import InputError


@dataclass(frozen=True)
class GyroBandwidth(Effect):
    """A second-order low-pass with damping 1/sqrt(2): -3 dB at `frequency`, slow motion late by sqrt(2)/(2 pi f).

    Exact for rates that are straight between samples; settled on the first sample. The rows must be evenly spaced.
    It comes on top of the bandwidth that an experiment's file states.
    """

    id = "gyro_bandwidth"
    question = "sensor"
    quantities = {
        "frequency": Quantity("Hz", math.inf, 5.0, 500.0, 40.0, "any", "at which half the power passes", POSITIVE),
    }
    sentence = "The sensor's own filter smooths the steps of an impact and shows everything a little late."
    equation = r"H(s) = \omega^2/(s^2 + \sqrt2\,\omega s + \omega^2),\quad \omega = 2\pi f"
    source = (
        "S. Butterworth (1930), On the theory of filter amplifiers, Experimental Wireless 7:536-541 (order two); a "
        "journal of that time: no DOI"
    )
    confounder = "hertzian_contact"
    experiment = "Knock the sensor alone on a table and look at the rise of the step; or log a second, faster sensor."

    frequency: float = math.inf

    def sensor(self, t, crv):
        if self.is_absent():
            return crv
        from scipy.signal import cont2discrete, lfilter, lfilter_zi

        t = np.asarray(t)
        step = (t[-1] - t[0]) / (len(t) - 1)
        if np.max(np.abs(np.diff(t) - step)) > 0.1 * step:
            cure = "Choose an output rate that divides the number of steps a second."
            raise InputError("E-STEP", f"effect {self.id}", "needs rows at even spacing", cure)
        omega = 2 * math.pi * self.frequency
        analog = ([omega**2], [1, math.sqrt(2) * omega, omega**2])
        numerator, denominator, _ = cont2discrete(analog, step, method="foh")
        numerator = np.squeeze(numerator)
        settled = lfilter_zi(numerator, denominator)[:, None] * crv[..., :1, :]
        return lfilter(numerator, denominator, crv, axis=-2, zi=settled)[0]
