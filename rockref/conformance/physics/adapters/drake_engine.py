"""Drake: discrete multibody plant; contact by points or pressure patches."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked
from rockref.model.rotation import quaternion

NAME = "Drake"
REQUIRES = "pydrake.multibody.plant"
INSTALL = "pip install drake"
SETTINGS = {
    "default": {},
    # Eight spheres at the corners: a plain box has one contact point on a half-space.
    "careful": {"corners": True, "stiffness": 1e7},
}
PASSPORT = {
    "TAMSI, 1e6 N/m, 0.5 s/m": {"approximation": "tamsi", "stiffness": 1e6, "dissipation": 0.5, "step": 1e-4},
    "SAP, 1e6 N/m, no relaxation": {"stiffness": 1e6, "relaxation": 0.0, "step": 1e-4},
}
KNOBS = {
    "few_contacts": "give the body small spheres at its corners: a box on a half-space has one contact point",
    "friction": "give the body small spheres at its corners: a box on a half-space has one contact point",
    "energy": "give the body small spheres at its corners: a box on a half-space has one contact point",
    "creep": "give the body small spheres at its corners, or raise point_contact_stiffness",
    "rattling": "give the body small spheres at its corners: a box on a half-space has one contact point",
    "soft": "raise point_contact_stiffness (ProximityProperties), or the hydroelastic modulus",
    "pivot": "pressure patches move the pivot inwards: point contact at corner spheres, or a higher modulus",
}
#: Radius of the corner spheres [m], decided: far below the base, above the sink.
CORNER = 1e-4


def facts() -> dict[str, str]:
    """Return version and integrator."""
    from importlib.metadata import version

    return {"version": version("drake"), "integrator": "discrete plant, semi-implicit Euler (SAP)"}


def properties(scene: Scene, friction: float):
    """Return the contact's numbers; stiffness of two alike bodies in series is half of each one's."""
    from pydrake.geometry import AddContactMaterial, ProximityProperties
    from pydrake.multibody.plant import CoulombFriction

    knobs = scene.settings
    found = ProximityProperties()
    stiffness = {"point_stiffness": 2 * knobs["stiffness"]} if "stiffness" in knobs else {}
    dissipation = {"dissipation": knobs["dissipation"]} if "dissipation" in knobs else {}
    AddContactMaterial(friction=CoulombFriction(friction, friction), properties=found, **stiffness, **dissipation)
    if "relaxation" in knobs:
        found.AddProperty("material", "relaxation_time", knobs["relaxation"])
    return found


def build(scene: Scene):
    """Return the diagram, the plant and the body."""
    from pydrake.geometry import Box, HalfSpace, Sphere
    from pydrake.math import RigidTransform
    from pydrake.multibody.plant import AddMultibodyPlantSceneGraph, DiscreteContactApproximation
    from pydrake.multibody.tree import RotationalInertia, SpatialInertia
    from pydrake.systems.framework import DiagramBuilder

    builder = DiagramBuilder()
    plant, _ = AddMultibodyPlantSceneGraph(builder, scene.step)
    kinds = {"sap": DiscreteContactApproximation.kSap, "tamsi": DiscreteContactApproximation.kTamsi}
    if "approximation" in scene.settings:
        plant.set_discrete_contact_approximation(kinds[scene.settings["approximation"]])
    inertia = SpatialInertia.MakeFromCentralInertia(scene.mass, np.zeros(3), RotationalInertia(*scene.inertia))
    body = plant.AddRigidBody("body", inertia)
    # Friction of two bodies is the harmonic mean of theirs, 2 mu mu' / (mu + mu').
    material = properties(scene, scene.friction)
    if scene.plate:
        plant.RegisterCollisionGeometry(plant.world_body(), RigidTransform(), HalfSpace(), "plate", material)
    if scene.shape == "sphere":
        plant.RegisterCollisionGeometry(body, RigidTransform(), Sphere(float(scene.half[0])), "body", material)
    elif scene.settings.get("corners"):
        for k in range(8):
            sign = np.array([1 - 2 * (k & 1), 1 - (k & 2), 1 - (k & 4) / 2])
            # Centres at b (1 - r / h), h - r: the line from the contact to the centre keeps the angle alpha.
            at = RigidTransform(sign * scene.half * (1 - CORNER / scene.half[2]))
            plant.RegisterCollisionGeometry(body, at, Sphere(CORNER), f"corner{k}", material)
    else:
        plant.RegisterCollisionGeometry(body, RigidTransform(), Box(*scene.size), "body", material)
    plant.mutable_gravity_field().set_gravity_vector(np.zeros(3))
    plant.Finalize()
    return builder.Build(), plant, body


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; gravity is a force at the centre of mass, as the plant's own is fixed."""
    from pydrake.common.eigen_geometry import Quaternion
    from pydrake.math import RigidTransform
    from pydrake.multibody.math import SpatialForce, SpatialVelocity
    from pydrake.multibody.plant import ExternallyAppliedSpatialForce
    from pydrake.systems.analysis import Simulator

    diagram, plant, body = build(scene)
    simulator = Simulator(diagram)
    context = plant.GetMyMutableContextFromRoot(simulator.get_mutable_context())
    q = quaternion(start.R)
    pose = RigidTransform(Quaternion(q / np.linalg.norm(q)), start.x)
    plant.SetFreeBodyPose(context, body, pose)
    plant.SetFreeBodySpatialVelocity(context, body, SpatialVelocity(start.omega, start.v))
    port, load = plant.get_applied_spatial_force_input_port(), ExternallyAppliedSpatialForce()
    load.body_index, load.p_BoBq_B = body.index(), np.zeros(3)
    simulator.Initialize()
    rows, count = [], 0
    for leg in legs(scene, times, gravity):
        if leg.gravity is not None:
            load.F_Bq_W = SpatialForce(np.zeros(3), scene.mass * np.array(leg.gravity))
            port.FixValue(context, [load])
        if leg.steps:
            count += leg.steps
            simulator.AdvanceTo(count * scene.step)
        if leg.record:
            rows.append(state(plant, context, body))
    return stacked(rows)


def state(plant, context, body) -> Start:
    """Return pose and velocity of the body, world axes."""
    pose = plant.EvalBodyPoseInWorld(context, body)
    speed = plant.EvalBodySpatialVelocityInWorld(context, body)
    x, R = np.array(pose.translation()), pose.rotation().matrix()
    return Start(x, R, np.array(speed.translational()), np.array(speed.rotational()))
