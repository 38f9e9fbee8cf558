"""An adapter to start from: `rockref conform physics mine.py`. Put your engine where the comments say so.

As it stands, it knows free flight alone: the checks without contact pass, the others fail.
"""

import numpy as np

from rockref.conformance.physics.scene import legs

NAME = "My engine"
# Settings are shown side by side. "step" [s] is read by the judge; the rest is yours, in scene.settings.
SETTINGS = {"default": {"step": 1e-3}, "careful": {"step": 5e-4}}
# Knobs by cause, said where a check fails: creep, damping, early, energy, few_contacts, friction, gravity, gyroscopic,
# inertia, pivot, pyramid_inside, pyramid_outside, rattling, sleep, soft, stale, step.
KNOBS = {"sleep": "my_world.sleep = False"}


def facts():
    """Return what the page says about the engine; precision "float32" widens bars of rounding."""
    return {"version": "1.0", "precision": "float64", "integrator": "semi-implicit Euler"}


def run(scene, start, times, gravity):
    """Return x (T, 3), R (T, 3, 3), v (T, 3), omega (T, 3) at the T times, in world axes.

    scene has shape ("box" or "sphere"), size, mass, inertia, friction, plate (the half-space z < 0, or none), step,
    settings; start has x, R, v, omega. SI units; x and v are those of the centre of mass.
    """
    # Make your world with one body of scene.size, scene.mass, scene.inertia and scene.friction, and set the start.
    x, R, v, omega = (np.array(a, float) for a in start)
    J, g = np.array(scene.inertia), np.zeros(3)
    rows = []
    for leg in legs(scene, times, gravity):  # gravity to set, steps to make, whether to record
        if leg.gravity is not None:
            g = np.array(leg.gravity)  # Set your world's gravity; wake the body.
        for _ in range(leg.steps):  # Make one step of your world.
            w = R.T @ omega
            v = v + scene.step * g
            w = w + scene.step * np.cross(J * w, w) / J
            x, R = x + scene.step * v, R @ rotation(scene.step * w)
            omega = R @ w
        if leg.record:
            rows.append((x, R, v, omega))
    return [np.array(column) for column in zip(*rows, strict=True)]


def rotation(angle):
    """Return the rotation by a vector of angles [rad]."""
    size = np.linalg.norm(angle)
    if size == 0:
        return np.eye(3)
    a = angle / size
    K = np.array([[0, -a[2], a[1]], [a[2], 0, -a[0]], [-a[1], a[0], 0]])
    return np.eye(3) + np.sin(size) * K + (1 - np.cos(size)) * K @ K
