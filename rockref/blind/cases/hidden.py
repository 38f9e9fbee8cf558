"""Hidden effects that the catalogue has a name for: ids and parameters as in the catalogue, the physics written anew.

A drawing function takes the world (which it changes), a random generator, a size (1: typical), whether another
functional form is to hide behind the same name, and parameters that are set; it returns the truth.
"""

from __future__ import annotations

import numpy as np

from rockref.blind.cases import hidden_contact as contact
from rockref.blind.cases.drawing import CATALOGUE, about, pick, said, signed
from rockref.blind.simulator.world import World


def quadratic_drag(world: World, rng, size, other, given):
    """Hide air drag, as of a sail."""
    c = pick(given, "c", world.factor("quadratic_drag.c") * about(rng, 0.4 * size))
    world["drag"], world["drag_form"] = c, other
    return said({"c": c}, "each pair of faces for itself" if other else CATALOGUE)


def cable_restraint(world: World, rng, size, other, given):
    """Hide the sensor's cable."""
    k = pick(given, "k", world.factor("cable_restraint.k") * about(rng, 5.0 * size))
    c = pick(given, "c", world.factor("cable_restraint.c") * about(rng, 0.3 * size))
    world["cable_k"], world["cable_c"], world["cable_form"] = k, c, other
    return said({"k": k, "c": c}, "a cable that stiffens" if other else CATALOGUE)


def lingering_wire_pull(world: World, rng, size, other, given):
    """Hide a wire that lets go slowly."""
    force = pick(given, "force", world.factor("lingering_wire_pull.force") * about(rng, 3.0 * size))
    tau = pick(given, "tau", world.factor("lingering_wire_pull.tau") * about(rng, 0.3))
    world["wire"], world["wire_tau"], world["wire_form"] = force, tau, other
    return said({"force": force, "tau": tau}, "a pull that falls linearly" if other else CATALOGUE)


def base_vibration(world: World, rng, size, other, given):
    """Hide a floor that shakes; each run meets it at a phase of its own."""
    amplitude = pick(given, "amplitude", world.factor("base_vibration.amplitude") * about(rng, 0.1 * size))
    frequency = pick(given, "frequency", float(rng.uniform(5.0, 22.0)))
    direction = pick(given, "direction", float(rng.uniform(-0.5, 0.5)))
    world["shake"], world["shake_f"], world["shake_dir"] = amplitude, frequency, direction
    world["shake_harmonic"] = 0.3 if other else 0.0

    def own_phase(one: World, rng: np.random.Generator, number: int) -> dict[str, float]:
        one["shake_phase"] = float(rng.uniform(-np.pi, np.pi))
        return {"phase": one["shake_phase"]}

    world.each_run.append(own_phase)
    parameters = {"amplitude": amplitude, "frequency": frequency, "direction": direction}
    return said(parameters, "with a second harmonic" if other else CATALOGUE)


def plate_tilt(world: World, rng, size, other, given):
    """Hide a plate that is not level."""
    x, y = (pick(given, axis, world.factor("plate_tilt") * signed(rng, 1e-3 * size)) for axis in "xy")
    length = np.sqrt(1.0 + x * x + y * y)
    g = world["gravity"]
    world["gravity_x"], world["gravity_y"], world["gravity"] = g * x / length, g * y / length, g / length
    return said({"x": x, "y": y})


def compliant_support(world: World, rng, size, other, given):
    """Hide a plate that yields: the softer, the larger."""
    mass = pick(given, "mass", world.factor("compliant_support.mass") * about(rng, 100.0))
    natural = world.factor("compliant_support.frequency") * about(rng, 60.0 / np.sqrt(size))
    frequency = pick(given, "frequency", natural)
    ratio = pick(given, "ratio", about(rng, 0.03))
    world["plate_m"], world["plate_f"], world["plate_ratio"] = mass, frequency, ratio
    if other:  # it pitches too, a little faster than it bounces; a plate six times as wide as the block
        J = mass * (0.6 * world.factor("compliant_support.pitch")) ** 2 / 12
        world["pitch_J"], world["pitch_k"] = J, J * (2 * np.pi * 1.4 * frequency) ** 2
        world["pitch_c"] = 2 * ratio * np.sqrt(world["pitch_k"] * J)
    return said({"mass": mass, "frequency": frequency, "ratio": ratio}, "it pitches too" if other else CATALOGUE)


def release_velocity(world: World, rng, size, other, given):
    """Hide a release with a push, the same in every run."""
    spin = world.factor("release_velocity")
    kick = [pick(given, k, spin * signed(rng, v * size)) for k, v in (("x", 0.02), ("y", 0.01), ("z", 0.02))]
    world.kick = np.array(kick)
    if other:  # the foot slips a little: the block turns about a line a twentieth of its width above its feet
        world.kick_at = 5e-3 * world.factor("release_velocity.height")
    parameters = dict(zip("xyz", kick, strict=True))
    return said(parameters, "turning about a line above the feet" if other else CATALOGUE)


def gyro_misalignment(world: World, rng, size, other, given):
    """Hide a sensor glued on slightly turned."""
    r = np.array([pick(given, axis, signed(rng, 0.03 * size)) for axis in "xyz"])
    angle = float(np.linalg.norm(r))
    hat = np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
    turn = np.eye(3) + np.sin(angle) / angle * hat + (1 - np.cos(angle)) / angle**2 * hat @ hat
    if other:  # axes that are not square to each other: the part above the diagonal is halved
        turn = np.where(np.triu(np.ones((3, 3)), 1) > 0, 0.7 * turn, turn)
    world.sensor.turn = turn
    return said(dict(zip("xyz", map(float, r), strict=True)), "axes that are not square" if other else CATALOGUE)


def gyro_scale(world: World, rng, size, other, given):
    """Hide a gyroscope that shows too much or too little."""
    scale = [pick(given, axis, 1.0 + signed(rng, 0.02 * size)) for axis in "xyz"]
    world.sensor.scale = np.array(scale)
    if other:  # and is a little bent: a half per cent at 1 rad/s
        world.sensor.cubic = 0.005
    return said(dict(zip("xyz", scale, strict=True)), "a little bent" if other else CATALOGUE)


def gyro_drift(world: World, rng, size, other, given):
    """Hide a gyroscope that does not show zero at rest."""
    bias = [pick(given, f"bias_{a}", signed(rng, v * size)) for a, v in zip("xyz", (5e-3, 2e-3, 5e-3), strict=True)]
    drift = [pick(given, f"rate_{a}", signed(rng, 1e-3 * size)) for a in "xyz"]
    world.sensor.bias, world.sensor.drift = np.array(bias), np.array(drift)
    if other:  # it warms up: an exponential of 3 s that begins with the same slope
        world.sensor.warm_up = 3.0
        world.sensor.drift = 3.0 * world.sensor.drift
    names = [f"bias_{a}" for a in "xyz"] + [f"rate_{a}" for a in "xyz"]
    return said(dict(zip(names, bias + drift, strict=True)), "warming up" if other else CATALOGUE)


def gyro_bandwidth(world: World, rng, size, other, given):
    """Hide a gyroscope that is slow: the slower, the larger."""
    frequency = pick(given, "frequency", about(rng, 40.0 / size))
    world.sensor.bandwidth, world.sensor.bandwidth_order = frequency, 1 if other else 2
    return said({"frequency": frequency}, "first order" if other else CATALOGUE)


def gyro_saturation(world: World, rng, size, other, given):
    """Hide a gyroscope that runs into its stops: the range is a share of the largest rate of the first run."""
    if "range" in given:
        world.sensor.range = float(given["range"])
    else:
        world.sensor.range = -float(np.clip(1.0 - 0.2 * about(rng, size, 0.1), 0.4, 0.95))
    world.sensor.soft = other
    return said({"range": world.sensor.range}, "soft stops" if other else CATALOGUE)


def clock_error(world: World, rng, size, other, given):
    """Hide a recorder whose seconds are not seconds."""
    rate = pick(given, "rate", 1.0 + signed(rng, 0.01 * size))
    world.sensor.clock = rate
    if other:  # its rate moves by a tenth of its error a second
        world.sensor.clock_bend = 0.1 * (rate - 1.0)
    return said({"rate": rate}, "a rate that moves" if other else CATALOGUE)


#: Every effect by its id.
EFFECTS = {
    function.__name__: function
    for function in (
        contact.hertzian_contact, contact.hunt_crossley_contact, contact.hysteretic_contact, contact.adhesion,
        contact.uneven_foot_stiffness, contact.uneven_foot_damping,
        contact.stribeck_friction, contact.viscous_friction, contact.load_dependent_friction, contact.spin_friction,
        contact.rolling_resistance, contact.uneven_foot_friction,
        contact.foot_defects, contact.rounded_feet, contact.uneven_contact_normals, contact.mass_eccentricity,
        contact.inertia_deviation, contact.dimension_deviation,
        quadratic_drag, cable_restraint, lingering_wire_pull, base_vibration, plate_tilt,
        compliant_support, release_velocity,
        gyro_misalignment, gyro_scale, gyro_drift, gyro_bandwidth, gyro_saturation, clock_error,
    )
}  # fmt: skip
