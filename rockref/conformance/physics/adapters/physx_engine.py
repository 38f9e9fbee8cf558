"""PhysX 5 on the processor, through SAPIEN; single precision."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked
from rockref.model.rotation import from_quaternion, quaternion

NAME = "PhysX (SAPIEN)"
REQUIRES = "sapien"
INSTALL = "pip install sapien"
SETTINGS = {"default": {}, "careful": {"sleep": False, "damping": 0.0}}
PASSPORT = {
    "restitution 0.5": {"sleep": False, "damping": 0.0, "restitution": 0.5},
    "restitution 0.5, bounce threshold 0.1": {
        "sleep": False,
        "damping": 0.0,
        "restitution": 0.5,
        "bounce_threshold": 0.1,
    },
}
KNOBS = {
    "sleep": "component.sleep_threshold = 0",
    "damping": "component.linear_damping = component.angular_damping = 0",
}


def facts() -> dict[str, str]:
    """Return version, precision and integrator."""
    import sapien

    return {"version": sapien.__version__, "precision": "float32", "integrator": "semi-implicit Euler"}


def build(sapien, scene: Scene, start: Start):
    """Return the system and the component of the body; gravity comes as a force."""
    physx, knobs = sapien.physx, scene.settings
    config = physx.PhysxSceneConfig()
    config.gravity = np.zeros(3)
    config.bounce_threshold = knobs.get("bounce_threshold", config.bounce_threshold)
    physx.set_scene_config(config)
    system = physx.PhysxCpuSystem()
    system.timestep = scene.step
    world = sapien.Scene([system])
    material = physx.PhysxMaterial(scene.friction, scene.friction, knobs.get("restitution", 0.0))
    if scene.plate:
        plate = physx.PhysxRigidStaticComponent()
        shape = physx.PhysxCollisionShapePlane(material)
        shape.local_pose = sapien.Pose([0, 0, 0], [0.7071068, 0, -0.7071068, 0])  # its normal is x
        plate.attach(shape)
        entity = sapien.Entity()
        entity.add_component(plate)
        world.add_entity(entity)
    body = physx.PhysxRigidDynamicComponent()
    half = scene.half.astype(np.float32)
    if scene.shape == "sphere":
        body.attach(physx.PhysxCollisionShapeSphere(float(half[0]), material))
    else:
        body.attach(physx.PhysxCollisionShapeBox(half, material))
    body.mass, body.inertia, body.cmass_local_pose = scene.mass, np.array(scene.inertia), sapien.Pose()
    if not knobs.get("sleep", True):
        body.sleep_threshold = 0.0
    if "damping" in knobs:
        body.linear_damping = body.angular_damping = knobs["damping"]
    entity = sapien.Entity()
    entity.add_component(body)
    world.add_entity(entity)
    entity.set_pose(sapien.Pose(start.x, quaternion(start.R)))
    body.set_linear_velocity(start.v)
    body.set_angular_velocity(start.omega)
    return world, system, body, entity


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`. The scene's own gravity is fixed."""
    import sapien

    world, system, body, entity = build(sapien, scene, start)
    force, rows = np.zeros(3), []
    for leg in legs(scene, times, gravity):
        if leg.gravity is not None:
            force = scene.mass * np.array(leg.gravity)
        for _ in range(leg.steps):
            if np.any(force):
                body.add_force_torque(force, np.zeros(3), "force")
            system.step()
        if leg.record:
            pose = entity.get_pose()
            rows.append(
                Start(
                    np.array(pose.p),
                    from_quaternion(np.array(pose.q, float)),
                    np.array(body.linear_velocity),
                    np.array(body.angular_velocity),
                )
            )
    return stacked(rows)
