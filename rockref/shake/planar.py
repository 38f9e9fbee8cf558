"""The rigid block on a shaken plate in two dimensions: rocking about two corner lines, instant impacts, no sliding.

The model in which overturning by pulses was worked out; the three-dimensional law tends to it where feet are even,
contacts stiff and friction large. Many blocks or levels at a time.

Sources: G. W. Housner (1963), Bull. Seismol. Soc. Am. 53(2):403-417; C.-S. Yim, A. K. Chopra, J. Penzien (1980),
Earthquake Eng. Struct. Dyn. 8:565-587, doi:10.1002/eqe.4290080606 (the equation with a moving base).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from rockref.model.problem import GRAVITY

#: Rate after an impact below which the block stands, in units of alpha p. Decided: it lifts by 1e-10 alpha at most.
STANDS = 1e-5


@dataclass(frozen=True)
class Rocking:
    """What became of m blocks: t (N,) [s]; theta, rate (N, m) [rad, rad/s]; impacts (m,); fell (m,) bool."""

    t: np.ndarray
    theta: np.ndarray
    rate: np.ndarray
    impacts: np.ndarray
    fell: np.ndarray


def rock(
    alpha: Any,
    p: Any,
    e: Any,
    t: np.ndarray,
    a: np.ndarray,
    theta: Any = 0.0,
    rate: Any = 0.0,
    g: float = GRAVITY,
) -> Rocking:
    """Integrate rocking on a plate with an acceleration that is linear between the times given.

    theta" = -p^2 [sin(s alpha - theta) + a/g cos(s alpha - theta)],  s the side on which it leans,

    by RK4, one step a sample; a block at rest lifts where |a| > g tan(alpha); a passage of zero within a step is
    placed by Newton's method, the rate is multiplied by e there, and the rest of the step follows on the other side.

    Parameters
    ----------
    alpha, p, e : slenderness angle [rad], frequency parameter sqrt(m g R / I_O) [1/s], ratio of the rates after and
        before an impact; numbers, or arrays that broadcast to (m,).
    t, a : (N,) times, evenly spaced [s], and (N,) or (N, m) acceleration of the plate [m/s2].
    theta, rate : tilt and rate at the start [rad, rad/s].

    Beyond 90 degrees a block has fallen and stays where it is.
    """
    a = np.asarray(a, float)
    a = a[:, None] if a.ndim == 1 else a
    shape = np.broadcast_shapes(*(np.shape(v) for v in (alpha, p, e, theta, rate, a[0])))
    alpha, p, e, q, v = (np.broadcast_to(np.asarray(k, float), shape).copy() for k in (alpha, p, e, theta, rate))
    side = np.sign(np.where(q != 0, q, v))
    impacts, fell = np.zeros(shape, int), np.zeros(shape, bool)
    rows = np.empty((2, len(t), *shape))
    rows[:, 0] = q, v
    for k in range(len(t) - 1):
        h, here, there = t[k + 1] - t[k], a[k] / g, a[k + 1] / g
        lifts = (side == 0) & (np.abs(here) > np.tan(alpha))
        side = np.where(lifts, -np.sign(here), side)
        moves = (side != 0) & ~fell
        q_new, v_new = rk4(q, v, np.where(moves, h, 0.0), side, alpha, p, here, there)
        hits = moves & (q_new * side < 0)
        if hits.any():
            share = passage(q, v, h, side, alpha, p, here, there)
            middle = here + (there - here) * share
            _, v_hit = rk4(q, v, share * h, side, alpha, p, here, middle)
            after = e * v_hit
            stands = np.abs(after) < STANDS * alpha * p
            q_rest, v_rest = rk4(0 * q, after, (1 - share) * h, -side, alpha, p, middle, there)
            q_new, v_new = (
                np.where(hits, np.where(stands, 0, q_rest), q_new),
                np.where(hits, np.where(stands, 0, v_rest), v_new),
            )
            side = np.where(hits, np.where(stands, 0, -side), side)
            impacts += hits
        q, v = np.where(moves, q_new, q), np.where(moves, v_new, v)
        fell |= np.abs(q) > np.pi / 2
        rows[:, k + 1] = q, v
    return Rocking(np.asarray(t), rows[0], rows[1], impacts, fell)


def acceleration(q, side, alpha, p, a):
    """Return theta" [rad/s2] at a tilt q on one side, with the plate's acceleration a in units of g."""
    return -(p**2) * (np.sin(side * alpha - q) + a * np.cos(side * alpha - q))


def rk4(q, v, h, side, alpha, p, here, there):
    """Return tilt and rate after h [s]; here, there: acceleration of the plate at both ends, in units of g."""
    middle = (here + there) / 2
    l1 = acceleration(q, side, alpha, p, here)
    l2 = acceleration(q + h / 2 * v, side, alpha, p, middle)
    l3 = acceleration(q + h / 2 * (v + h / 2 * l1), side, alpha, p, middle)
    l4 = acceleration(q + h * (v + h / 2 * l2), side, alpha, p, there)
    return q + h * v + h * h / 6 * (l1 + l2 + l3), v + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)


def passage(q, v, h, side, alpha, p, here, there):
    """Return the share of a step of h [s] after which the tilt passes zero, by Newton's method; any where none does."""
    share = np.full_like(q, 0.5)
    for _ in range(8):
        q_new, v_new = rk4(q, v, share * h, side, alpha, p, here, here + (there - here) * share)
        share = np.clip(share - q_new / np.where(v_new * h != 0, v_new * h, 1), 0, 1)
    return share
