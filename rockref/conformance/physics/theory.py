"""What mechanics says, whatever the contact is made of: closed forms and the rocking block of Housner.

Sources: L. D. Landau & E. M. Lifshitz, Mechanics, section 37 (the free asymmetric top); G. W. Housner (1963), Bull.
Seismol. Soc. Am. 53(2):403-417 (the rocking block), with the full equation in place of the linear one.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from rockref.conformance.physics.scene import Scene
from rockref.model.housner import frequency_parameter, velocity_ratio


class Rocking(NamedTuple):
    """A block that rocks about the body axis y: half base b, half height h, R [m]; alpha [rad]; p [rad/s]."""

    b: float
    h: float
    R: float
    alpha: float
    p: float
    ratio: float

    @classmethod
    def of(cls, scene: Scene, g: float) -> Rocking:
        """Return the numbers of a scene; g [m/s2]."""
        b, _, h = (float(a) for a in scene.half)
        R, alpha, J = float(np.hypot(b, h)), float(np.arctan2(b, h)), scene.inertia[1]
        p = frequency_parameter(scene.mass, J, R, g)
        return cls(b, h, R, alpha, p, velocity_ratio(scene.mass, J, R, alpha))


def flip_interval(inertia: tuple[float, float, float], omega: np.ndarray) -> float:
    """Return the time between two flips of a free body that turns about its middle axis [s].

    The component along the middle axis changes sign every 2 K(k) / lambda. Moments [kg m2] in any order; omega (3,)
    [rad/s], body axes. Landau & Lifshitz, eqs. 37.8 to 37.12.
    """
    from scipy.special import ellipk

    J, w = np.array(inertia), np.asarray(omega)
    order = np.argsort(J)
    J, w = J[order], w[order]
    E2, L2 = float(np.sum(J * w * w)), float(np.sum((J * w) ** 2))
    if L2 < E2 * J[1]:  # the momentum circles the smallest axis: the same formula with the axes in reverse
        J = J[::-1]
    rate = np.sqrt((J[2] - J[1]) * (L2 - E2 * J[0]) / np.prod(J))
    m = (J[1] - J[0]) * (E2 * J[2] - L2) / ((J[2] - J[1]) * (L2 - E2 * J[0]))
    return float(2 * ellipk(m) / rate)


def spin_change(inertia: tuple[float, float, float], R: np.ndarray, omega: np.ndarray, time: float) -> np.ndarray:
    """Return the change of omega after `time` [s] of free flight, world axes (3,) [rad/s].

    Euler's equations with the attitude, by an integrator of order 8; omega (3,) in world axes.
    """
    from scipy.integrate import solve_ivp

    J = np.array(inertia)

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        w, A = y[:3], y[3:].reshape(3, 3)
        return np.concatenate([np.cross(J * w, w) / J, (A @ cross_matrix(w)).ravel()])

    y = np.concatenate([R.T @ omega, R.ravel()])
    end = solve_ivp(rates, (0.0, time), y, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    return end[3:].reshape(3, 3) @ end[:3] - omega


def cross_matrix(w: np.ndarray) -> np.ndarray:
    """Return the matrix of w x, (3, 3)."""
    return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])


def quarter_period(theta_0: float, alpha: float, p: float) -> float:
    """Return the time from rest at theta_0 to the upright pose [s]; angles [rad], p [rad/s].

    The integral of theta" = -p^2 sin(alpha - theta). The substitution theta = theta_0 (1 - s^2) takes the square root
    at the start away.
    """
    from scipy.integrate import quad

    def slowness(s: float) -> float:
        u = theta_0 * s * s  # theta_0 - theta; the difference of cosines without loss of digits
        lost = 2 * np.sin(alpha - theta_0 + u / 2) * np.sin(u / 2)
        return 2 * theta_0 * s / np.sqrt(2 * p * p * lost) if s > 0 else limit

    limit = 2 * theta_0 / np.sqrt(2 * p * p * theta_0 * np.sin(alpha - theta_0))
    return float(quad(slowness, 0.0, 1.0, epsabs=1e-13, epsrel=1e-12)[0])


def rocking_energy(theta: float, alpha: float) -> float:
    """Return the energy of a block at rest at theta over m g R: cos(alpha - theta) - cos(alpha)."""
    return float(np.cos(alpha - theta) - np.cos(alpha))


def impact_ratio(before: float, after: float, alpha: float) -> float:
    """Return the ratio of rates at an impact from the apex angles before and after it [rad]."""
    return float(np.sqrt(max(rocking_energy(after, alpha), 0.0) / rocking_energy(before, alpha)))


def growth_time(first: float, last: float, start: float, p: float) -> float:
    """Return the time in which the deviation from balance grows from `first` to `last` [s].

    A block at rest at the deviation `start` [rad]: phi" = p^2 sin(phi).
    """
    from scipy.integrate import quad

    def slowness(phi: float) -> float:
        gained = 2 * np.sin((phi + start) / 2) * np.sin((phi - start) / 2)
        return float(1 / np.sqrt(2 * p * p * gained))

    return float(quad(slowness, first, last)[0])


def toppling_load(sink: float, b: float, h: float) -> float:
    """Return the acceleration that topples a block, over g b / h: 1 - (sink / b)(h / b + b / h).

    Four equal springs at the corners, which sink by `sink` [m] under the weight: the load that lifts the edge turns
    the block by sink / b, which moves its centre of mass towards the pivot and lowers it.
    """
    return 1 - sink / b * (h / b + b / h)


def sliding(speed: float, friction: float, g: float) -> tuple[float, float]:
    """Return the distance [m] and the time [s] after which friction stops a sliding body."""
    return speed * speed / (2 * friction * g), speed / (friction * g)
