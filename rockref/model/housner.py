"""Housner's 2-D model of the rocking block, drawn beside the 3-D one.

Source: G. W. Housner (1963), The behavior of inverted pendulum structures during earthquakes, Bull. Seismol. Soc. Am.
53(2):403-417. A rigid block rocks about two corner lines O and O'; impacts keep the angular momentum about the new one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.model.errors import InputError


class HousnerResponse(NamedTuple):
    """t (N,) [s]; theta (N,) tilt, signed [rad]; rate (N,) [rad/s], positive on the first swing; impacts (k,) [s]."""

    t: np.ndarray
    theta: np.ndarray
    rate: np.ndarray
    impacts: np.ndarray


def frequency_parameter(mass: float, J_G: float, R: float, g: float) -> float:
    """Return p = sqrt(m g R / I_O), I_O = J_G + m R^2 [rad/s]. mass [kg]; J_G about the rocking axis [kg m2]; R [m]."""
    return float(np.sqrt(mass * g * R / (J_G + mass * R * R)))


def velocity_ratio(mass: float, J_G: float, R: float, alpha: float) -> float:
    """Return angular velocity after an impact over that before: 1 - (2 m R^2 / I_O) sin^2(alpha); alpha, slenderness
    [rad]."""
    return 1 - 2 * mass * R * R / (J_G + mass * R * R) * float(np.sin(alpha)) ** 2


def first_impact(theta_0: float, alpha: float, p: float) -> float:
    """Return time from rest at theta_0 [rad] to the first impact [s], small angles: cosh(p t) = alpha / (alpha -
    theta_0)."""
    return float(np.arccosh(alpha / (alpha - theta_0)) / p)


#: Where rocking ends. Decided: an arc that lasts less than this is rest. Impacts take a fixed share of the rate, so the
#: arcs between them shorten in geometric progression, and infinitely many fit into a finite time. Of the block of
#: Table 3.1 what is left then is a rate of 0.009 deg/s and a tilt of 4 nrad, below any gyroscope, and the rest of the
#: progression, 3 ms.
SHORTEST_ARC = 1e-4  # s

#: Halvings of a step that find an impact in it: 2^-60 of 1e-3 s is below the rounding of a time.
HALVINGS = 60


def housner(
    mass: float,
    width: float,
    height: float,
    J_G: float,
    g: float,
    theta_0: float,
    duration: float,
    output_rate: float,
    step: float = 1e-4,
) -> HousnerResponse:
    """Simulate free rocking from rest at tilt theta_0 by the full (not linearised) equation, RK4, impacts found by
    bisection.

    mass [kg]; width, height [m] in the rocking plane; J_G about the rocking axis through the centre of mass [kg m2];
    g [m/s2]; theta_0 [rad]; duration [s]; output_rate [Hz]; step of the integration [s].

    The block is at rest, tilt and rate zero, from the impact on after which the next would come within `SHORTEST_ARC`;
    a block so squat that the impact does not lift it on the other side (velocity ratio not positive), from the first.

    Raises
    ------
    InputError
        E-TILT, where the block would overturn.
    """
    alpha, R = float(np.arctan2(width, height)), float(np.hypot(width, height) / 2)
    if not 0 < theta_0 < alpha:
        raise InputError("E-TILT", "theta_0", f"is {theta_0!r} rad", f"Give a tilt between 0 and {alpha:.4g} rad.")
    p2 = frequency_parameter(mass, J_G, R, g) ** 2
    ratio = velocity_ratio(mass, J_G, R, alpha)
    # An arc that starts at a small rate is a throw upwards against p^2 sin(alpha): it lasts 2 rate / (p^2 sin(alpha)).
    least_rate = SHORTEST_ARC / 2 * p2 * float(np.sin(alpha))
    times = np.arange(int(np.floor(duration * output_rate + 1e-9)) + 1) / output_rate
    # The lean is counted negative at the start, so that the rate of the first swing is positive, as in the 3-D model.
    theta, rate, side, now = -theta_0, 0.0, -1.0, 0.0
    out, impacts = np.zeros((len(times), 2)), []
    for row, t in enumerate(times):
        while t - now > 1e-12 and side:
            h = min(step, t - now)
            new = rk4(theta, rate, h, side, p2, alpha)
            if new[0] * side < 0:
                h = to_impact(theta, rate, h, side, p2, alpha)
                theta, rate, side = 0.0, rk4(theta, rate, h, side, p2, alpha)[1] * ratio, -side
                impacts.append(now + h)
                if ratio <= 0 or abs(rate) < least_rate:
                    rate, side = 0.0, 0.0
            else:
                theta, rate = new
            now += h
        out[row] = theta, rate
    return HousnerResponse(times, out[:, 0], out[:, 1], np.array(impacts))


def rk4(theta: float, rate: float, h: float, side: float, p2: float, alpha: float) -> tuple[float, float]:
    """Return tilt [rad] and rate [rad/s] after h [s] on the corner line of this side (1 or -1); p2 = p^2 [1/s2], alpha
    [rad].

    The equation, beyond the corner line too: theta" = -p^2 side sin(alpha - side theta).
    """

    def f(q: float) -> float:
        return -p2 * side * np.sin(alpha - side * q)

    k1, l1 = rate, f(theta)
    k2, l2 = rate + h / 2 * l1, f(theta + h / 2 * k1)
    k3, l3 = rate + h / 2 * l2, f(theta + h / 2 * k2)
    k4, l4 = rate + h * l3, f(theta + h * k3)
    return theta + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4), rate + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


def to_impact(theta: float, rate: float, h: float, side: float, p2: float, alpha: float) -> float:
    """Return time [s], at most h, to the impact within a step of h; arguments as `rk4`."""
    low, high = 0.0, h
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if rk4(theta, rate, middle, side, p2, alpha)[0] * side < 0:
            high = middle
        else:
            low = middle
    return high
