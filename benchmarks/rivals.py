"""Simpler methods that the discoverer has to beat: `python benchmarks/rivals.py FOLDER`.

FOLDER is a blind test that was scored (`rockref blind make`, `rockref blind score`). The methods name effects without
refitting, or without held-out runs; their answers are kept beside each case, and the scores of all are printed.
"""

from __future__ import annotations

import argparse
import json
import math
import sys
from collections.abc import Callable
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from rockref.blind.cases.sealing import unseal, write_json
from rockref.blind.scoring import table
from rockref.blind.scoring.evaluation import COMMITTED
from rockref.blind.scoring.judging import VERDICT
from rockref.blind.scoring.marks import mark

#: Seconds of a record that are compared: through the second main impact, after which the baseline is out of step.
STRETCH = 1.3
#: decided: a correlation below this is said to be nothing; the square, a twentieth, is the share that is explained.
LEAST_CORRELATION = 0.22
#: Terms whose part of the torque is below this share of the largest part are dropped; decided, as is usual, a tenth.
SPARSITY = 0.10
#: decided: a regression that explains less of the residual torque than this says nothing.
LEAST_EXPLAINED = 0.05
#: Family-wise limit of the largest of some thirty correlated z (5 %); from a simulated null.
LEAST_Z = 3.1


def said(effect: str | None, **more: Any) -> dict[str, Any]:
    """A rival's verdict: one effect, or none."""
    return {"verdict": "named" if effect else "none", "effects": [effect] if effect else [], **more}


def residual_correlation(case: Path) -> dict[str, Any]:
    """The effect whose trace, typical size on the nominal baseline, correlates best with the residual; no refit."""
    from rockref.measure.experiment import load_experiment
    from rockref.measure.records.release import FIT

    experiment = load_experiment(case, uses=(FIT,))
    runs = [run for run in experiment.fit_runs() if run.crv is not None]
    releases = tuple(dict.fromkeys((run.release_tilt, abs(run.block_turned) > 1.0) for run in runs))
    block = (experiment.mass, experiment.width, experiment.height, experiment.baseline)
    traces = _traces(block, releases, experiment.gyro)
    n = traces["none"][releases[0]].shape[0]
    found = {}
    for effect, trace in traces.items():
        if effect == "none":
            continue
        products = np.zeros(3)
        for run in runs:
            release = (run.release_tilt, abs(run.block_turned) > 1.0)
            assert run.crv is not None
            residual = run.crv[:n] - traces["none"][release]
            shape = trace[release]
            products += np.sum(residual * shape), np.sum(residual**2), np.sum(shape**2)
        found[effect] = float(products[0] / math.sqrt(max(products[1] * products[2], 1e-300)))
    best = max(found, key=lambda id: abs(found[id]))
    return said(best if abs(found[best]) > LEAST_CORRELATION else None, correlation=found[best])


@lru_cache(maxsize=4)
def _traces(block: tuple, releases: tuple, gyro: Any) -> dict[str, dict[tuple, np.ndarray]]:
    """What each effect changes in the record, by release; "none": the record of the nominal baseline itself."""
    from rockref.api import Model
    from rockref.effects import catalogue
    from rockref.measure.prediction import predict
    from rockref.measure.records.release import Run

    mass, width, height, baseline = block
    make = Model.four_points if baseline == "four_points" else Model.table_3_1
    model = make().replace(mass=mass, width=width, depth=width, height=height)
    t = np.arange(round(STRETCH * gyro.sample_rate)) / gyro.sample_rate
    runs = [
        Run(str(i), "", "fit", tilt, math.pi if turned else 0.0, t=t, crv=np.zeros((len(t), 3)))
        for i, (tilt, turned) in enumerate(releases)
    ]

    def records(one: Model) -> dict[tuple, np.ndarray]:
        return {r: p.at(t) for r, p in zip(releases, predict(one, runs, gyro), strict=True)}

    found = {"none": records(model)}
    for id, kind in catalogue.EFFECTS.items():
        if id == "foot_defects" and baseline != "four_points":
            continue
        with_it = records(replace(model, effects=(kind.typical(),)))
        found[id] = {r: with_it[r] - found["none"][r] for r in releases}
    return found


def sparse_regression(case: Path) -> dict[str, Any]:
    """The effect with the largest part in a sparse regression of the residual torque about the pivot, weak form.

    Sequentially thresholded least squares on a library of torques; the torque that is left is that of Housner's block
    on its edge, between main impacts. Source of the method: S. L. Brunton, J. L. Proctor, J. N. Kutz (2016), PNAS
    113:3932-3937, doi:10.1073/pnas.1517384113; weak form: D. A. Messenger, D. M. Bortz (2021), J. Comput. Phys.
    443:110525, doi:10.1016/j.jcp.2021.110525.
    """
    from rockref.measure.experiment import load_experiment
    from rockref.measure.records.release import FIT

    experiment = load_experiment(case, uses=(FIT,))
    rows, targets = [], []
    names: tuple[str, ...] = ()
    for run in experiment.fit_runs():
        if run.t is None or run.crv is None or run.release_tilt is None:
            continue
        library, residual = weak_rows(run.t, run.crv, run.release_tilt, abs(run.block_turned) > 1.0, experiment)
        names = tuple(library)
        rows.append(np.column_stack(list(library.values())))
        targets.append(residual)
    A, y = np.vstack(rows), np.concatenate(targets)
    parts = sparse_parts(A, y)
    total = float(np.linalg.norm(y))
    left = float(np.linalg.norm(y - A @ least_squares(A, y, parts > 0)))
    explained = 1.0 - (left / total) ** 2 if total > 0 else 0.0
    by_effect: dict[str, float] = {}
    for name, part in zip(names, parts, strict=True):
        id = name.partition(" ")[0]
        by_effect[id] = by_effect.get(id, 0.0) + float(part)
    by_effect.pop("baseline", None)
    best = max(by_effect, key=lambda id: by_effect[id])
    right = by_effect[best] > 0 and explained > LEAST_EXPLAINED
    return said(best if right else None, explained=explained)


def weak_rows(t, crv, tilt: float, turned: bool, experiment, width: float = 0.06):
    """Library of torques and residual torque, both integrated over windows of `width` s with a bump (1 - s^2)^2.

    t (N,) s, crv (N, 3) rad/s. Returns {name: (K,)} and (K,), N m s. Windows that hold a main impact are left out.
    """
    from rockref.model.problem import GRAVITY

    h = float(t[1] - t[0])
    w = -crv[:, 0] * (-1.0 if turned else 1.0)  # rate of the lean toward the side of the release
    lean = tilt + np.concatenate([[0.0], np.cumsum(0.5 * h * (w[1:] + w[:-1]))])
    side = np.where(lean >= 0, 1.0, -1.0)
    radius = 0.5 * math.hypot(experiment.width, experiment.height)
    alpha = math.atan2(experiment.width, experiment.height)
    inertia = 4.0 / 3.0 * experiment.mass * radius**2
    weight = experiment.mass * GRAVITY * radius
    gravity = -weight * np.sin(alpha - np.abs(lean)) * side
    lab = -1.0 if turned else 1.0
    torques = {
        "baseline": gravity,
        "quadratic_drag": -np.abs(w) * w,
        "cable_restraint rate": -w,
        "cable_restraint place": tilt - lean,
        "rolling_resistance": -np.sign(w) * np.cos(lean),
        "plate_tilt": np.cos(lean),
        "mass_eccentricity": lab * np.cos(lean),
        "lingering_wire_pull": np.exp(-t / 0.3),
        "gyro_drift": t,
        "clock_error": -gravity * t,
    }
    half = max(2, round(0.5 * width / h))
    s = np.arange(-half, half + 1) / half
    bump, slope = (1 - s**2) ** 2, -4 * s * (1 - s**2) / (half * h)
    centres = np.arange(half, min(len(t), round(3.0 / h)) - half, half)
    centres = centres[[np.all(side[c - half : c + half + 1] == side[c]) and abs(lean[c]) > 0.01 for c in centres]]
    place = centres[:, None] + np.arange(-half, half + 1)

    def weak(signal: np.ndarray, kernel: np.ndarray) -> np.ndarray:
        return h * signal[place] @ kernel

    # By parts: the integral of bump I w' is less the integral of bump' I w; no derivative of the noisy rate is needed.
    residual = -weak(inertia * w, slope) - weak(gravity, bump)
    library = {name: weak(torque, bump) for name, torque in torques.items()}
    return library, residual


def sparse_parts(A: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Norm of each column's part in the fit after terms below SPARSITY of the largest are dropped, till none is."""
    kept = np.ones(A.shape[1], bool)
    parts = np.zeros(A.shape[1])
    for _ in range(A.shape[1]):
        parts = np.abs(least_squares(A, y, kept)) * np.linalg.norm(A, axis=0)
        stay = kept & (parts >= SPARSITY * parts.max())
        if np.array_equal(stay, kept):
            break
        kept = stay
    return np.where(kept, parts, 0.0)


def least_squares(A: np.ndarray, y: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """Least squares on some columns, scaled to length one first; zero elsewhere."""
    found = np.zeros(A.shape[1])
    if kept.any():
        size = np.maximum(np.linalg.norm(A[:, kept], axis=0), 1e-300)
        found[kept] = np.linalg.lstsq(A[:, kept] / size, y, rcond=1e-8)[0] / size
    return found


def first_of_ranking(verdict: dict[str, Any]) -> dict[str, Any]:
    """The first of a verdict's own ranking, taken at its word: no held-out runs, no classes, no abstention."""
    ranking = verdict.get("ranking") or []
    if not ranking or not float(ranking[0].get("z") or 0.0) > LEAST_Z:
        return said(None)
    return said(str(ranking[0]["effect"]))


#: Methods that look at the data themselves.
METHODS: dict[str, Callable[[Path], dict[str, Any]]] = {
    "residual correlation without refit": residual_correlation,
    "sparse regression on the residual torque": sparse_regression,
}
#: The discoverer's own ranking, taken at its word.
RANKING = "ranking without holdout"
KEPT = "rivals.json"


def answers(case: Path) -> dict[str, dict[str, Any]]:
    """The verdicts of all methods on one case, kept in its folder; what is there is not made again."""
    path = case / KEPT
    if not path.exists():
        found = {}
        for id, method in METHODS.items():
            try:
                found[id] = method(case)
            except Exception as error:
                found[id] = {"verdict": "error", "effects": [], "why": repr(error)}
        write_json(path, found)
    verdict = json.loads((case / VERDICT).read_text(encoding="utf-8"))
    return {"discoverer": verdict, **json.loads(path.read_text(encoding="utf-8")), RANKING: first_of_ranking(verdict)}


def beside(methods: dict[str, list[dict[str, Any]]]) -> str:
    """Scores of several methods side by side, in Markdown; only those that have a goal and a case."""
    lines = ["| score | " + " | ".join(methods) + " | n |", "| --- |" + " --- |" * (len(methods) + 1)]
    for rows in zip(*methods.values(), strict=True):
        if rows[0]["goal"] and any(row["value"] is not None for row in rows) and "seconds" not in rows[0]["score"]:
            cells = " | ".join(table.shown(row["value"], row["percent"]) for row in rows)
            lines.append(f"| {rows[0]['score']} | {cells} | {rows[0]['n']} |")
    return "\n".join(lines)


def main(arguments: list[str] | None = None) -> int:
    """Ask every method, then open the truth and print the table. Exit code 2 where the folder was not scored."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    folder = parser.parse_args(arguments).folder
    if not (folder / COMMITTED).is_file():
        print(f"{folder}: no scored blind test. Run rockref blind make and score first.", file=sys.stderr)
        return 2
    cases = sorted(path.parent for path in folder.glob(f"case-*/{VERDICT}"))
    found = {case.name: answers(case) for case in cases}
    truth = {t["name"]: t for t in unseal(folder)[0]["cases"]}
    methods = ("discoverer", *METHODS, RANKING)
    marks = {id: [mark(truth[name], said[id]) for name, said in found.items()] for id in methods}
    print(beside({id: table.scores(some) for id, some in marks.items()}))
    return 0


if __name__ == "__main__":
    sys.exit(main())
