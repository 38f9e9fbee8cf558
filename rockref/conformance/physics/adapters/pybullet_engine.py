"""PyBullet: Bullet's multibody world, sequential impulses, double precision."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked
from rockref.model.rotation import quaternion

NAME = "PyBullet"
REQUIRES = "pybullet"
INSTALL = "pip install pybullet (on arm64: pybullet-arm64)"
SETTINGS = {
    "default": {},
    "careful": {"damping": 0.0, "ground": "box"},
}
PASSPORT = {
    "k 1e6, c 100": {"damping": 0.0, "stiffness": 1e6, "contact_damping": 100.0, "step": 1e-4},
    "restitution 0.5": {"damping": 0.0, "restitution": 0.5, "step": 1e-4},
    "restitution 0.5, threshold 0": {"damping": 0.0, "restitution": 0.5, "threshold": 0.0, "step": 1e-4},
}
KNOBS = {
    "damping": "changeDynamics(body, -1, linearDamping=0, angularDamping=0): the default is 0.04 each",
    "energy": "give the ground as a large box in place of GEOM_PLANE, or raise contactStiffness",
    "few_contacts": "give the ground as a large box: GEOM_PLANE finds two of four corners of a soft body",
    "soft": "raise contactStiffness, or leave it out: contact is then rigid",
    "inertia": "changeDynamics(body, -1, localInertiaDiagonal=...): Bullet makes its own from the collision shape",
    "sleep": "changeDynamics(body, -1, activationState=p.ACTIVATION_STATE_DISABLE_SLEEPING)",
}


def facts() -> dict[str, str]:
    """Return version and integrator."""
    from importlib.metadata import version

    return {"version": version("pybullet"), "integrator": "semi-implicit Euler"}


def build(p, client: int, scene: Scene) -> int:
    """Make plate and body, and return the body's number; friction is the product of both coefficients."""
    knobs = scene.settings
    contact = {"lateralFriction": scene.friction, "restitution": knobs.get("restitution", 0.0)}
    if "threshold" in knobs:
        contact["contactProcessingThreshold"] = knobs["threshold"]
    if scene.plate:
        if knobs.get("ground") == "box":
            shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[5, 5, 1], physicsClientId=client)
            plate = p.createMultiBody(0, shape, basePosition=[0, 0, -1], physicsClientId=client)
        else:
            shape = p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client)
            plate = p.createMultiBody(0, shape, physicsClientId=client)
        other = contact | {"lateralFriction": 1.0, "restitution": 1.0}
        p.changeDynamics(plate, -1, physicsClientId=client, **other)
    if scene.shape == "sphere":
        shape = p.createCollisionShape(p.GEOM_SPHERE, radius=float(scene.half[0]), physicsClientId=client)
    else:
        shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=list(scene.half), physicsClientId=client)
    body = p.createMultiBody(scene.mass, shape, physicsClientId=client)
    if "stiffness" in knobs:  # of the body alone: the plate is rigid
        contact |= {"contactStiffness": knobs["stiffness"], "contactDamping": knobs["contact_damping"]}
    damping = {"linearDamping": knobs["damping"], "angularDamping": knobs["damping"]} if "damping" in knobs else {}
    p.changeDynamics(
        body, -1, localInertiaDiagonal=scene.inertia, physicsClientId=client, **contact, **damping
    )  # fmt: skip
    return body


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`."""
    import pybullet as p

    client = p.connect(p.DIRECT)
    try:
        body = build(p, client, scene)
        p.setTimeStep(scene.step, physicsClientId=client)
        q = quaternion(start.R)
        p.resetBasePositionAndOrientation(body, list(start.x), [*q[1:], q[0]], physicsClientId=client)
        p.resetBaseVelocity(body, list(start.v), list(start.omega), physicsClientId=client)
        rows = []
        for leg in legs(scene, times, gravity):
            if leg.gravity is not None:
                p.setGravity(*leg.gravity, physicsClientId=client)
            for _ in range(leg.steps):
                p.stepSimulation(physicsClientId=client)
            if leg.record:
                x, q = p.getBasePositionAndOrientation(body, physicsClientId=client)
                v, omega = p.getBaseVelocity(body, physicsClientId=client)
                R = np.reshape(p.getMatrixFromQuaternion(q), (3, 3))
                rows.append(Start(np.array(x), R, np.array(v), np.array(omega)))
        return stacked(rows)
    finally:
        p.disconnect(client)
