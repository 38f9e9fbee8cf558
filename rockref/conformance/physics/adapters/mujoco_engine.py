"""MuJoCo: soft contact as a convex problem; friction cone a pyramid unless asked otherwise."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked
from rockref.model.rotation import from_quaternion, quaternion

NAME = "MuJoCo"
REQUIRES = "mujoco"
INSTALL = "pip install mujoco"
SETTINGS = {
    "default": {},
    # Stiff within what a step of 1 ms takes: the time constant is four steps.
    "careful": {"cone": "elliptic", "impratio": 10, "solref": "0.004 1", "solimp": "0.99 0.99 0.001"},
}
PASSPORT = {
    "solref 0.01 0.3": {"cone": "elliptic", "solref": "0.01 0.3", "step": 1e-4},
    "solref -1e5 -10": {"cone": "elliptic", "solref": "-1e5 -10", "step": 1e-4},
}
KNOBS = {
    "pyramid_inside": '<option cone="elliptic"/>',
    "integrator": '<option integrator="RK4"/>',
    "creep": 'raise impratio (10) with cone="elliptic", and solimp towards 0.99',
    "soft": "lower the first number of solref (not below two steps), raise solimp towards 0.99",
    "rattling": "raise the damping ratio, the second number of solref, to 1",
    "energy": 'use cone="elliptic" and a damping ratio of 1 in solref',
}
XML = """
<mujoco>
  <option timestep="{step}" cone="{cone}" impratio="{impratio}" integrator="{integrator}"/>
  <worldbody>
    {plate}
    <body><freejoint/><inertial pos="0 0 0" mass="{mass}" diaginertia="{J[0]} {J[1]} {J[2]}"/>
      <geom type="{shape}" size="{size}" mass="0" friction="{mu} 0 0" {contact}/></body>
  </worldbody>
</mujoco>
"""


def facts() -> dict[str, str]:
    """Return version and integrator."""
    import mujoco

    return {"version": mujoco.__version__, "integrator": "semi-implicit Euler"}


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`."""
    import mujoco

    knobs = {"cone": "pyramidal", "impratio": 1, "integrator": "Euler"} | scene.settings
    contact = "".join(f'{key}="{knobs[key]}" ' for key in ("solref", "solimp") if key in knobs)
    size = scene.half if scene.shape == "box" else scene.half[:1]
    text = XML.format(
        step=scene.step, cone=knobs["cone"], impratio=knobs["impratio"], integrator=knobs["integrator"],
        mass=scene.mass, J=scene.inertia, shape=scene.shape, mu=scene.friction, contact=contact,
        size=" ".join(repr(float(s)) for s in size),
        plate=f'<geom type="plane" size="9 9 1" friction="{scene.friction} 0 0" {contact}/>' if scene.plate else "",
    )  # fmt: skip
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    data.qpos[:3], data.qpos[3:] = start.x, quaternion(start.R)
    data.qvel[:3], data.qvel[3:] = start.v, start.R.T @ start.omega  # the rates of a free joint are in body axes
    rows = []
    for leg in legs(scene, times, gravity):
        if leg.gravity is not None:
            model.opt.gravity[:] = leg.gravity
        if leg.steps:
            mujoco.mj_step(model, data, leg.steps)
        if leg.record:
            R = from_quaternion(data.qpos[3:].copy())
            rows.append(Start(data.qpos[:3].copy(), R, data.qvel[:3].copy(), R @ data.qvel[3:]))
    return stacked(rows)
