"""Rapier: sequential impulses with soft constraints, single precision."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked
from rockref.model.rotation import from_quaternion, quaternion

NAME = "Rapier"
REQUIRES = "rapier3d"
INSTALL = "pip install rapier3d"
SETTINGS = {"default": {}, "careful": {"sleep": False, "parameters": {"normalized_prediction_distance": 0.001}}}
PASSPORT = {"restitution 0.5": {"sleep": False, "restitution": 0.5}}
KNOBS = {
    "sleep": "RigidBodyBuilder.can_sleep(False)",
    "gyroscopic": "RigidBodyBuilder.gyroscopic_forces(True)",
    "early": "IntegrationParameters.normalized_prediction_distance = 0.001: the default is 20 mm",
    "stale": "IntegrationParameters.contact_recycling = False",
    "soft": "raise IntegrationParameters.contact_softness' natural frequency",
}


def facts() -> dict[str, str]:
    """Return version, precision and integrator."""
    from importlib.metadata import version

    return {"version": version("rapier3d"), "precision": "float32", "integrator": "semi-implicit Euler in substeps"}


def build(rapier, scene: Scene, start: Start):
    """Return the world and the body."""
    knobs = scene.settings
    world = rapier.PhysicsWorld(gravity=(0.0, 0.0, 0.0))
    parameters = world.integration_parameters
    parameters.dt = scene.step
    for key, value in knobs.get("parameters", {}).items():
        setattr(parameters, key, value)
    if scene.plate:
        if knobs.get("ground") == "box":
            plate = rapier.Collider.cuboid(5.0, 5.0, 1.0).translation((0.0, 0.0, -1.0))
        else:
            plate = rapier.Collider.halfspace((0.0, 0.0, 1.0))
        world.add_collider(plate.friction(scene.friction).restitution(knobs.get("restitution", 0.0)))
    w, x, y, z = (float(a) for a in quaternion(start.R))
    pose = rapier.Isometry3([float(a) for a in start.x], rapier.Quaternion(w, x, y, z))
    made = rapier.RigidBody.dynamic().position(pose).linvel([float(a) for a in start.v])
    made = made.angvel([float(a) for a in start.omega]).can_sleep(knobs.get("sleep", True))
    made = made.gyroscopic_forces(knobs["gyroscopic"]) if "gyroscopic" in knobs else made
    half = [float(a) for a in scene.half]
    shape = rapier.Collider.ball(half[0]) if scene.shape == "sphere" else rapier.Collider.cuboid(*half)
    mass = rapier.MassProperties((0.0, 0.0, 0.0), scene.mass, scene.inertia)
    shape = shape.mass_properties(mass).friction(scene.friction).restitution(knobs.get("restitution", 0.0))
    return world, world.add_body(made, [shape])


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`. A sleeper is woken when gravity turns."""
    import rapier3d as rapier

    world, handle = build(rapier, scene, start)
    rows = []
    for leg in legs(scene, times, gravity):
        if leg.gravity is not None:
            world.gravity = leg.gravity
            world.wake_up_all()
        for _ in range(leg.steps):
            world.step()
        if leg.record:
            body = world.rigid_bodies[handle]
            q = body.rotation
            R = from_quaternion(np.array([q.w, q.i, q.j, q.k]))
            x, v, omega = (np.array([a.x, a.y, a.z]) for a in (body.translation, body.linvel, body.angvel))
            rows.append(Start(x, R, v, omega))
    return stacked(rows)
