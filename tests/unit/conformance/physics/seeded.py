"""Seeded faults: engines that are right but for one thing."""

import inspect
from types import SimpleNamespace

import numpy as np

from rockref.conformance.physics.adapter import Adapter
from rockref.conformance.physics.adapters import own_engine, rockref_four
from rockref.conformance.physics.scene import Motion, Start


def adapter(run, step, **more):
    """An adapter of a function `run` with one setting."""
    settings = {"default": {"step": step, **more}}
    return Adapter(SimpleNamespace(run=run, SETTINGS=settings, facts=own_engine.facts), "seeded")


def free(text, fault):
    """Free flight of the template, with a piece of its text replaced."""
    source = inspect.getsource(own_engine)
    assert text in source
    names = {}
    exec(compile(source.replace(text, fault), "seeded.py", "exec"), names)
    return adapter(names["run"], 2e-3)


def contact(run=rockref_four.run, step=1e-4, **knobs):
    """The law on four points: stiff enough to judge at a step that is cheap, damped so that landings are dead."""
    return adapter(run, step, **{"K": 4e6, "beta": 0.2, **knobs})


def swapped_inertia(scene, start, times, gravity):
    a, b, c = scene.inertia
    return rockref_four.run(scene.replace(inertia=(c, b, a)), start, times, gravity)


def weaker_gravity(scene, start, times, gravity):
    return rockref_four.run(scene, start, times, [(t, tuple(0.995 * a for a in g)) for t, g in gravity])


def with_sleep(scene, start, times, gravity, rate=0.05, waits=0.5):
    """A body slower than `rate` [rad/s, m/s] for half a second stays where it is."""
    m = rockref_four.run(scene, start, times, gravity)
    slow = (np.linalg.norm(m.omega, axis=1) < rate) & (np.linalg.norm(m.v, axis=1) < rate)
    awake = np.maximum.accumulate(np.where(slow, -np.inf, times))
    asleep = np.flatnonzero(times - np.maximum(awake, times[0]) > waits)
    if not len(asleep):
        return m
    rows = np.minimum(np.arange(len(times)), asleep[0])
    still = (np.arange(len(times)) <= asleep[0])[:, None]
    return Motion(m.x[rows], m.R[rows], m.v[rows] * still, m.omega[rows] * still)


def lively(scene, start, times, gravity, gain=1.1):
    """Every pass through the upright pose gives a tenth of the rates on top."""
    m = rockref_four.run(scene, start, times, gravity)
    lean = m.R[:, 0, 2]
    passes = np.flatnonzero(np.signbit(lean[1:]) != np.signbit(lean[:-1])) + 1
    if not len(passes) or len(times) - passes[0] < 20 or abs(lean[0]) < 0.01:
        return m
    k = int(passes[0]) + 5  # after the landing
    faster = Start(m.x[k], m.R[k], gain * m.v[k], gain * m.omega[k])
    rest = lively(scene, faster, times[k:] - times[k], gravity, gain)
    return Motion(*(np.concatenate([a[:k], b]) for a, b in zip(m, rest, strict=True)))
