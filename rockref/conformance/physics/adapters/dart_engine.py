"""DART: rigid contact as a complementarity problem; friction a pyramid unless the solver is changed."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked

NAME = "DART"
REQUIRES = "dartpy"
INSTALL = "pip install dartpy"
SETTINGS = {"default": {}, "careful": {"sleep": False, "cone": "round"}}
PASSPORT = {"restitution 0.5": {"sleep": False, "restitution": 0.5, "step": 1e-4}}
KNOBS = {
    "pyramid_outside": "getConstraintSolver().setBoxedLcpSolver(NsgsFrictionSolver()), which has Coulomb's cone",
    "sleep": "world.setDeactivationOptions with mEnabled = False",
}


def facts() -> dict[str, str]:
    """Return version and integrator."""
    import dartpy

    return {"version": str(dartpy.__version__), "integrator": "semi-implicit Euler"}


def part(dart, scene: Scene, name: str, shape, mu: float):
    """Return a skeleton of one body with a shape and its contact numbers."""
    skeleton = dart.dynamics.Skeleton(name)
    joint, body = skeleton.createFreeJointAndBodyNodePair()
    node = body.createShapeNode(shape)
    node.createCollisionAspect()
    contact = node.createDynamicsAspect()
    contact.setFrictionCoeff(mu)
    contact.setRestitutionCoeff(scene.settings.get("restitution", 0.0))
    return skeleton, joint, body


def pose(dart, R, x):
    """Return an isometry of DART."""
    found = dart.math.Isometry3()
    found.set_rotation(R)
    found.set_translation(x)
    return found


def build(dart, scene: Scene):
    """Return the world, and joint and body of what moves. The plate is a large box."""
    world = dart.simulation.World()
    world.setTimeStep(scene.step)
    knobs = scene.settings
    if not knobs.get("sleep", True):
        options = world.getDeactivationOptions()
        options.mEnabled = False
        world.setDeactivationOptions(options)
    if knobs.get("cone") == "round":
        world.getConstraintSolver().setBoxedLcpSolver(dart.constraint.NsgsFrictionSolver())
    if scene.plate:
        plate, joint, _ = part(dart, scene, "plate", dart.dynamics.BoxShape([10, 10, 2]), scene.friction)
        joint.setTransform(pose(dart, np.eye(3), [0, 0, -1]))
        plate.setMobile(False)
        world.addSkeleton(plate)
    ball = scene.shape == "sphere"
    shape = dart.dynamics.SphereShape(scene.half[0]) if ball else dart.dynamics.BoxShape(list(scene.size))
    skeleton, joint, body = part(dart, scene, "body", shape, scene.friction)
    body.setInertia(dart.dynamics.Inertia(scene.mass, np.zeros(3), np.diag(scene.inertia)))
    world.addSkeleton(skeleton)
    return world, joint, body


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`."""
    import dartpy as dart

    world, joint, body = build(dart, scene)
    joint.setTransform(pose(dart, start.R, start.x))
    joint.setLinearVelocity(start.v)
    joint.setAngularVelocity(start.omega)
    rows = []
    for leg in legs(scene, times, gravity):
        if leg.gravity is not None:
            world.setGravity(list(leg.gravity))
        for _ in range(leg.steps):
            world.step()
        if leg.record:
            at = body.getWorldTransform()
            rows.append(
                Start(
                    np.array(at.translation()).ravel(),
                    np.array(at.rotation()),
                    np.array(body.getLinearVelocity()),
                    np.array(body.getAngularVelocity()),
                )
            )
    return stacked(rows)
