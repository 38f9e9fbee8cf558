"""Hypothesis strategies: physical objects in the ranges in which the block lives."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rockref.model.parameters import Parameters
from rockref.model.problem import Block, ContactPoints, Problem, State
from rockref.model.rotation import exponential

#: Stiffness [N/m], from a soft rubber foot to a Hertzian contact of steel; damping ratio; friction coefficient.
STIFFNESS, RATIO, FRICTION = (1e5, 1e9), (0.0, 1.0), (0.0, 1.2)


#: Smaller numbers are drawn as zero: the product of two 1e-206 m underflows, and nothing of the kind is on a plate.
#: Lengths of atoms, and their squares, are well above it. Underflow has tests of its own.
LEAST = 1e-40


def between(low: float, high: float) -> st.SearchStrategy[float]:
    """Ordinary numbers of a range: zero, or not too small."""
    return st.floats(low, high, allow_subnormal=False).map(lambda a: a if abs(a) >= LEAST else 0.0)


def vectors(size: float, n: int = 3) -> st.SearchStrategy[np.ndarray]:
    """Vectors with components up to `size`."""
    return arrays(float, n, elements=between(-size, size))


def penetrations() -> st.SearchStrategy[float]:
    """Penetration [m]: touching exactly, pressed in, above the plate."""
    return st.one_of(st.just(0.0), between(0, 1e-4), between(-1e-3, 0))


def rates() -> st.SearchStrategy[float]:
    """Penetration rate or sliding speed [m/s]."""
    return st.one_of(st.just(0.0), between(-1, 1))


def rotation_vectors(size: float = 3.1) -> st.SearchStrategy[np.ndarray]:
    """Rotation vectors [rad] of length up to `size`."""
    return vectors(size / np.sqrt(3))


def rotations() -> st.SearchStrategy[np.ndarray]:
    """Rotation matrices."""
    return rotation_vectors().map(exponential)


def parameter_sets() -> st.SearchStrategy[Parameters]:
    """The twelve parameters of a block that somebody might have."""
    height = between(0, 2e-4)
    return st.builds(
        Parameters,
        K_N=between(1e6, 1e8),
        K_T=between(1e6, 1e8),
        beta_int=between(0, 0.5),
        beta_ext=between(0, 0.5),
        mu_int=between(0, 1),
        mu_ext=between(0, 1),
        delta_long=st.tuples(height, height, height, height),
        delta_diag=between(0, 0.03),
        theta_0=between(0.01, 0.14),
    )


@dataclass(frozen=True)
class ContactStates:
    """n contact points: arguments of the rules N1 to T6, arrays (n,) and (n, 2)."""

    xi: np.ndarray
    xi_rate: np.ndarray
    u_t: np.ndarray
    v_slide: np.ndarray
    s: np.ndarray
    anchored: np.ndarray
    sliding: np.ndarray
    K_N: np.ndarray
    C_N: np.ndarray
    K_T: np.ndarray
    C_T: np.ndarray
    mu_0: np.ndarray
    mu: np.ndarray


@st.composite
def contact_states(draw, n: int = 8) -> ContactStates:
    """Points in contact or not, sticking or sliding, with anchors within 0.1 mm."""

    def scalars(elements):
        return draw(arrays(float, n, elements=elements))

    def planes(size):
        return draw(arrays(float, (n, 2), elements=between(-size, size)))

    u_t, mu = planes(0.1), scalars(between(*FRICTION))
    return ContactStates(
        xi=scalars(penetrations()),
        xi_rate=scalars(rates()),
        u_t=u_t,
        v_slide=planes(1.0),
        s=u_t + planes(1e-4),
        anchored=draw(arrays(bool, n)),
        sliding=draw(arrays(bool, n)),
        K_N=scalars(between(*STIFFNESS)),
        C_N=scalars(between(0, 1e5)),
        K_T=scalars(between(*STIFFNESS)),
        C_T=scalars(between(0, 1e5)),
        mu_0=mu + scalars(st.one_of(st.just(0.0), between(0, 0.5))),
        mu=mu,
    )


@st.composite
def problems(draw, steps: int = 25, step: float = 1e-5, n: int = 8, radius: bool = False) -> Problem:
    """A block that has just come near the plate: some points pressed in, some above it, turning and sliding."""
    P = draw(arrays(float, (n, 3), elements=between(-0.05, 0.05))) * [1, 1, 1e-3] - [0, 0, 0.344]
    mu = draw(arrays(float, n, elements=between(0.05, 0.8)))
    points = ContactPoints(
        P,
        K_N=draw(arrays(float, n, elements=between(1e7, 1e8))),
        K_T=draw(arrays(float, n, elements=between(1e7, 1e8))),
        C_N=draw(arrays(float, n, elements=between(0, 3e4))),
        C_T=draw(arrays(float, n, elements=between(0, 3e4))),
        mu_0=mu * draw(st.sampled_from([1.0, 1.5])),
        mu=mu,
        radius=draw(arrays(float, n, elements=between(1e-4, 2e-3))) if radius else None,
        names=tuple(f"p{i}" for i in range(n)),
    )
    Lambda = exponential(draw(vectors(0.01)) * [1, 1, 100])
    low = np.min(P @ Lambda[2])
    start = State.at_rest(
        np.array([*draw(vectors(0.1, 2)), -low - draw(between(-1e-5, 3e-5))]),
        Lambda,
        n,
        v=draw(vectors(0.3)),
        W=draw(vectors(0.5)),
    )
    J = np.diag([2.175, 2.175, 0.09] * (1 + 0.3 * draw(vectors(1.0))))
    if draw(st.booleans()):
        J = J + 0.01 * np.array([[0, 1.0, 2], [1, 0, 3], [2, 3, 0]])
    block = Block(np.array(draw(between(20, 100))), J, np.array(9.81))
    return Problem(block, points, start, step, steps * step, 1 / step)
