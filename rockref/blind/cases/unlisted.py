"""Hidden effects that are in no list; the right answer is "something else".

Each truth has a `card`: on which axes (all three where clatter spreads it over them) and in which phase of the motion
the effect may honestly be said to show.
Phases: "release" (before the first main impact), "impacts" (from there on).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.blind.cases.drawing import about, said, signed
from rockref.blind.simulator.world import World

ANY_PHASE = ("release", "impacts")
LATER = ("impacts",)


def _told(parameters: dict[str, float], form: str, axes: str, phases: tuple[str, ...] = ANY_PHASE) -> dict[str, Any]:
    return said(parameters, form) | {"card": {"axes": list(axes), "phases": list(phases)}}


def _hang(world: World, m: float, height: float, frequency: tuple[float, float, float], ratio: float) -> None:
    """Hang a part m [kg] of the block at `height` [m] on springs along X, Y, Z [Hz]; at rest nothing has changed."""
    rest = world.mass - m
    shift = m * height / rest  # the remainder's centre of mass lies this far below
    moved = m * height**2 + rest * shift**2
    world.J = world.J - np.diag([moved, moved, 0.0])
    world.mass = rest
    world.points[:, 2] += shift
    world["top"] += shift
    world["bottom"] += shift
    world["hung_m"], world["hung_z"] = m, height + shift
    for axis, f in zip("xyz", frequency, strict=True):
        k = m * (2 * np.pi * f) ** 2
        world[f"hung_k{axis}"] = k
        world[f"hung_c{axis}"] = 2 * ratio * np.sqrt(k * m)


def _part(world: World, mass: float, frequency: float, height: float) -> tuple[float, ...]:
    """Return mass [kg], frequency [Hz] and height [m] of a part of the source's block, for this block."""
    factors = (world.factor(f"hung.{name}") for name in ("mass", "frequency", "height"))
    return tuple(f * value for f, value in zip(factors, (mass, frequency, height), strict=True))


# decided: where the mass is held it is held at 200 Hz, far above all that the block does between contacts.
HELD = 200.0


def loose_mass_y(world: World, rng, size, other, given):
    """Hide a part inside that swings in the rocking plane."""
    m, f, height = _part(world, about(rng, 3.0 * size), about(rng, 5.5), float(rng.uniform(0.1, 0.28)))
    _hang(world, m, height, (HELD, f, HELD), 0.03)
    return _told({"mass": m, "frequency": f, "height": height}, "a loose part, in the rocking plane", "xyz")


def loose_mass_x(world: World, rng, size, other, given):
    """Hide a part inside that swings across the rocking plane."""
    m, f, height = _part(world, about(rng, 3.0 * size), about(rng, 9.0), float(rng.uniform(0.1, 0.28)))
    _hang(world, m, height, (f, HELD, HELD), 0.03)
    return _told({"mass": m, "frequency": f, "height": height}, "a loose part, across the rocking plane", "xyz")


def sloshing(world: World, rng, size, other, given):
    """Hide a liquid inside: slow and hardly damped, in both directions."""
    m, f, height = _part(world, about(rng, 2.0 * size), about(rng, 2.2, 0.1), float(rng.uniform(0.0, 0.2)))
    _hang(world, m, height, (f, f, HELD), 0.01)
    return _told({"mass": m, "frequency": f}, "a liquid with a free surface", "xyz")


def magnet(world: World, rng, size, other, given):
    """Hide a pole beside the top: it pulls when the block leans far to its side."""
    far = world.factor("magnet.length")
    force, length = world.factor("magnet.force") * about(rng, 6.0 * size), far * about(rng, 0.02)
    world["magnet"], world["magnet_y"], world["magnet_length"] = force, far * 0.09, length
    return _told({"force": force, "length": length}, "a pull of a fixed pole", "x")


def gust(world: World, rng, size, other, given):
    """Hide a puff of air, at another time in every run."""
    force, time = world.factor("gust.force") * about(rng, 2.5 * size), world.factor("gust.time")

    def own(one: World, rng: np.random.Generator, number: int) -> dict[str, float]:
        one["gust"] = force * float(rng.choice([-1.0, 1.0]))
        one["gust_t"], one["gust_width"] = time * float(rng.uniform(0.6, 2.2)), time * about(rng, 0.25)
        one["gust_z"] = world.factor("gust.height") * 0.1
        return {"gust": one["gust"], "start": one["gust_t"], "length": one["gust_width"]}

    world.each_run.append(own)
    return _told({"force": force}, "a puff of air at any time", "xyz", LATER)


def knock(world: World, rng, size, other, given):
    """Hide a blow of a few milliseconds across the rocking plane, at another time in every run."""
    impulse, time = world.factor("knock.impulse") * about(rng, 0.4 * size), world.factor("gust.time")

    def own(one: World, rng: np.random.Generator, number: int) -> dict[str, float]:
        one["gust_width"] = 0.006
        one["gust_x"] = 2.0 * impulse / one["gust_width"] * float(rng.choice([-1.0, 1.0]))
        one["gust_t"], one["gust_z"] = time * float(rng.uniform(0.2, 2.2)), world.factor("gust.height") * 0.2
        return {"impulse": impulse, "start": one["gust_t"]}

    world.each_run.append(own)
    return _told({"impulse": impulse}, "a blow at any time", "xyz", LATER)


def rotor(world: World, rng, size, other, given):
    """Hide a wheel that spins inside about the transverse axis: rocking turns the block about its height."""
    h = world.factor("rotor.angular_momentum") * signed(rng, 1.5 * size)
    world["rotor_y"] = h
    return _told({"angular_momentum": h}, "a spinning wheel", "xyz")


def packet_loss(world: World, rng, size, other, given):
    """Hide a radio link that repeats the last packet when the next is late."""
    world.sensor.packet = int(rng.integers(8, 17))
    world.sensor.lost_packets = min(about(rng, 0.06 * size), 0.3)
    parameters = {"rows": float(world.sensor.packet), "share": world.sensor.lost_packets}
    return _told(parameters, "packets that are repeated", "xyz")


def ringing_mount(world: World, rng, size, other, given):
    """Hide a bracket of the sensor that rings after an impact."""
    world.sensor.ring_frequency, world.sensor.ring_gain = about(rng, 60.0), min(0.25 * size, 1.0)
    parameters = {"frequency": world.sensor.ring_frequency, "share": world.sensor.ring_gain}
    return _told(parameters, "a bracket that rings", "xyz", LATER)


def creeping_feet(world: World, rng, size, other, given):
    """Hide feet on a polymer: a second spring that relaxes in milliseconds."""
    k, tau = world.factor("creeping_feet.stiffness") * about(rng, 4e7 * size), about(rng, 3e-3)
    world["creep_k"], world["creep_tau"] = k, tau
    return _told({"stiffness": k, "time": tau}, "feet with a memory", "xyz", LATER)


#: Every unlisted effect by its name.
EFFECTS = {
    function.__name__: function
    for function in (
        loose_mass_y, loose_mass_x, sloshing, magnet, gust, knock, rotor, packet_loss, ringing_mount, creeping_feet,
    )
}  # fmt: skip
