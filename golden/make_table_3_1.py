"""Make the golden files of Table 3.1: ``python -m golden.make_table_3_1 [FOLDER]``.

Values are those of a run in extended precision; bars come from the run in float64 and from an ensemble of float64 runs
with every input moved by one ulp and the points in another order. Some minutes; the same bytes every time.
"""

from __future__ import annotations

import hashlib
import json
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import rockref
from golden import table_3_1_files as files
from golden.bars import SAFETY, bar, compressed, down_to, ensemble, rounded_up
from rockref.model.simulate import simulate
from rockref.model.storage import write_bytes, write_text

MEMBERS = 14


def scheme() -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return t, values, bars and contact flags of the law at the source's step."""
    problem = files.problem(files.SCHEME_STEP)
    exact = simulate(problem, dtype=np.longdouble)
    plain = simulate(problem)
    batch, orders = ensemble(problem, MEMBERS)
    moved = simulate(batch)
    members = []
    for i, order in enumerate(orders):
        members.append(replace(moved[i], F=moved[i].F[:, order], anchored=moved[i].anchored[:, order]))
    values = files.values(exact)
    bars = bar(values, [files.values(plain), *map(files.values, members)])
    return exact.t, values, bars, agreed([exact.anchored, plain.anchored, *(m.anchored for m in members)])


def converged(rounding: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return the same of the motion that the scheme tends to, from compiled runs at a thousandth of the step.

    rounding : bars of the same values at the source's step.

    Contacts switch at whole steps, so a run of step h is off by up to C h, more or less by chance: halving the step
    may make it better by four or worse by two. C is therefore the largest over several steps, and over 5 ms to either
    side, since differences pass through zero; and it counts twice. Rounding walks at random: with so many more steps it
    comes as much farther as the root of their ratio.
    """
    fine = rockref.simulate(files.problem(files.CONVERGED_STEP), engine="numba")
    values, flags, C = files.values(fine), [fine.anchored], np.zeros(1)
    for step in files.COARSER_STEPS:
        coarse = rockref.simulate(files.problem(step), engine="numba")
        flags.append(coarse.anchored)
        C = np.maximum(C, np.abs(files.values(coarse) - values) / (step - files.CONVERGED_STEP))
    padded = np.pad(C, ((10, 10), (0, 0)), mode="edge")
    nearby = np.max([padded[i : i + len(values)] for i in range(21)], axis=0)
    bars = 2 * nearby * files.CONVERGED_STEP + np.sqrt(files.SCHEME_STEP / files.CONVERGED_STEP) * rounding
    return fine.t, values, np.where((nearby == 0) & (values == 0), 0, bars), agreed(flags)


def agreed(flags: list[np.ndarray]) -> np.ndarray:
    """1 or 0 where all runs agree on a contact, -1 elsewhere."""
    every, some = np.all(flags, axis=0), np.any(flags, axis=0)
    return np.where(every, 1, np.where(some, -1, 0))


def tables(t, values, bars, contact) -> dict[str, bytes]:
    """Packed tables of values and bars."""
    names = files.columns(rockref.Model.table_3_1().body()[1].names)
    rows = [",".join(["t_s", "contact", *names])]
    bar_rows = [",".join(["t_s", *names])]
    for instant, numbers, sizes, flags in zip(t, values, bars, contact, strict=True):
        texts = [rounded_up(float(size)) for size in sizes]
        cells = [down_to(float(a), float(text)) for a, text in zip(numbers, texts, strict=True)]
        rows.append(",".join([f"{instant:.4f}", "".join("01?"[flag] for flag in flags), *cells]))
        bar_rows.append(",".join([f"{instant:.4f}", *texts]))
    return {"": compressed("\n".join(rows) + "\n"), "_bars": compressed("\n".join(bar_rows) + "\n")}


def description() -> dict:
    """Describe the files, for a program in any language."""
    model = rockref.Model.table_3_1()
    p = model.parameters
    return {
        "schema": files.SCHEMA,
        "what": "Response of the eight-point rocking block of Table 3.1, from release to the second main impact",
        "files": {
            "scheme.csv.gz": "the scheme at the source's step, not converged: 6e-5 s early at the second main impact",
            "converged.csv.gz": "the motion that the scheme tends to for small steps",
            "*_bars.csv.gz": "error bar of each value, same rows and columns",
        },
        "columns": {
            "t_s": "time from release",
            "contact": "one character a point: 1 in contact, 0 not, ? undecided within the bars",
            "wx_deg_s, wy_deg_s, wz_deg_s": "convected rotational velocities about X, Y, Z (rule M1)",
            "x_m, y_m, z_m": "centre of mass, plate axes",
            "qw, qx, qy, qz": "rotation, body to plate, scalar first and not negative",
            "fx_1ext_N, ...": "force of the plate on each point, plate axes, of the last force evaluation",
        },
        "points": list(model.body()[1].names),
        "step_s": {
            "scheme": files.SCHEME_STEP,
            "converged": files.CONVERGED_STEP,
            "for the bars of converged": files.COARSER_STEPS,
        },
        "output_rate_hz": files.OUTPUT_RATE,
        "bars": {
            "scheme": f"{SAFETY} x the largest difference of {MEMBERS} runs with every input moved by one ulp and the"
            " points in another order, and of the run in float64, from the run in extended precision; and one ulp",
            "converged": "2 C h, where C is the largest, within 5 ms and over runs of other steps, of the difference to"
            " this one over that of the steps; and the rounding of so many steps, from the bars of scheme",
        },
        "block": {"mass_kg": model.mass, "width_m": model.width, "depth_m": model.depth, "height_m": model.height},
        "g_m_s2": model.g,
        "parameters": {k: list(v) if isinstance(v, tuple) else v for k, v in vars(p).items()},
    }


def make(folder: Path) -> None:
    """Write all files and the list of their digests."""
    if np.finfo(np.longdouble).eps >= np.finfo(float).eps:
        raise SystemExit("this machine has no extended precision; use one with an x86-64 or POWER processor")
    folder.mkdir(parents=True, exist_ok=True)
    made = {"schema.json": (json.dumps(description(), indent=1, ensure_ascii=True) + "\n").encode()}
    of_scheme = scheme()
    for kind, parts in (("scheme", of_scheme), ("converged", converged(of_scheme[2]))):
        made |= {f"{kind}{suffix}.csv.gz": data for suffix, data in tables(*parts).items()}
    for name, data in made.items():
        write_bytes(folder / name, data)
    digests = "".join(f"{hashlib.sha256(data).hexdigest()}  {name}\n" for name, data in sorted(made.items()))
    write_text(folder / "MANIFEST.sha256", digests)


if __name__ == "__main__":
    make(Path(sys.argv[1]) if len(sys.argv) > 1 else files.FOLDER)
