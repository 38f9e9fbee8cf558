"""Blocks on four even feet for comparisons with closed forms, at rest on a plate that moves along y."""

import numpy as np

from rockref.model.base_motion import BaseMotion
from rockref.model.problem import Block, ContactPoints, Problem
from rockref.model.standing import standing_posture

G = 9.81


def block(b: float, h: float, K: float = 1e8, beta: float = 0.2, mu: float = 10.0, mass: float = 50.0):
    """A uniform cuboid with half width b along x and y and half height h [m], and its feet."""
    P = np.array([[b, b, -h], [-b, b, -h], [-b, -b, -h], [b, -b, -h]])
    C = 2 * beta * np.sqrt(K * mass)
    inertia = mass / 3 * np.diag([b * b + h * h, b * b + h * h, 2 * b * b])
    same = {"K_N": K, "K_T": K, "C_N": C, "C_T": C, "mu_0": mu, "mu": mu}
    points = ContactPoints(P, **{k: np.full(4, v) for k, v in same.items()}, radius=None, names=tuple("1234"))
    return Block(np.array(mass), inertia, np.array(G)), points


def along_y(times, a, dt: float, t_0: float = 0.0) -> BaseMotion:
    """A record along y [m/s2] that is linear between these times, sampled every dt."""
    t = np.arange(np.ceil(times[-1] / dt) + 1) * dt
    samples = np.zeros((len(t), 3))
    samples[:, 1] = np.interp(t, times, a)
    return BaseMotion(t_0, dt, samples)


def shaken(body, base, duration: float, step: float = 1e-5, output_rate: float = 1000.0) -> Problem:
    """The block of `block`, standing on the plate."""
    return Problem(*body, standing_posture(*body), step, duration, output_rate, base=base)


def tilt(response):
    """Signed turn about x [rad], (..., T), small angles and large."""
    return np.arctan2(response.Lambda[..., 2, 1], response.Lambda[..., 2, 2])
