"""Judging whole runs: rows against rows, up to the horizon, and the instants of the main impacts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from rockref.conformance.backends.call import ANYTHING, as_mapping, raised
from rockref.conformance.backends.side_by_side import grouped, simulate
from rockref.conformance.judge.compare_answer import grade_of, likely_shape, look_of, weighed_in_bars, wrong_instants
from rockref.conformance.judge.negligible import INSTANT, size_and_unit
from rockref.conformance.vectors import Trajectory, trajectory, trajectory_names, window_names

#: Column of the values, and of the bars, by profile.
VALUES = {"float64": "", "float32": "", "scheme": "converged_"}
BARS = {"float64": "bar_", "float32": "bar_float32_", "scheme": "bar_scheme_"}
SHOWN = {"W": "W_rad_s", "x": "x_m", "Lambda": "Lambda"}


@dataclass
class RunCheck:
    """One run, judged.

    worst : largest deviation in bars; ratios : (rows,) largest deviation of each row; first : the first row outside,
    with
    what was expected there; event : the last event of the expected run before it; impacts : instants with deviation in
    bars
    """

    id: str
    title: str
    grade: str
    worst: float = 0.0
    horizon_s: float = 0.0
    t: np.ndarray = field(default_factory=lambda: np.zeros(0))
    ratios: np.ndarray = field(default_factory=lambda: np.zeros(0))
    first: dict[str, Any] | None = None
    event: list[Any] | None = None
    impacts: list[dict[str, Any]] = field(default_factory=list)
    note: str = ""

    @property
    def failed(self) -> bool:
        """Return whether the run is outside."""
        return self.grade == "outside"


def expected_columns(t: Trajectory, profile: str) -> tuple[dict[str, np.ndarray], dict[str, np.ndarray]]:
    """Return expected W, x, Lambda (rows first) and their bars (rows,)."""
    value = {k: t.columns[VALUES[profile] + column] for k, column in SHOWN.items()}
    value["Lambda"] = value["Lambda"].reshape(-1, 3, 3)
    return value, {k: t.columns[BARS[profile] + column] for k, column in SHOWN.items()}


def judge_rows(t: Trajectory, out: dict[str, Any], profile: str) -> RunCheck:
    """Judge one run against one trajectory."""
    expected, bars = expected_columns(t, profile)
    horizon = float(t.meta["horizon_s"][profile])
    instants = t.columns["t_s"]
    check = RunCheck(t.id, t.title, "bitwise", horizon_s=horizon)
    rows = int(np.sum(instants <= horizon * (1 + 1e-12)))
    ratios: dict[str, np.ndarray] = {}
    negligible, look = False, look_of(profile, "L5")
    said = "" if out.get("t") is None else wrong_instants(out["t"], instants, t.problem.step)
    if said:
        return replace(check, grade="outside", worst=np.inf, note=said)
    for key, right in expected.items():
        got = out.get(key)
        if got is None:
            continue
        try:
            got = np.asarray(got)
        except ValueError:
            return replace(check, grade="outside", worst=np.inf, note=f"{key} has rows of different lengths")
        if got.dtype.kind not in "fiu" or got.shape != right.shape:
            note = f"{key} has shape {got.shape}, not {right.shape}{likely_shape(got.shape, right.shape)}"
            return replace(check, grade="outside", worst=np.inf, note=note)
        bar = bars[key].reshape((-1,) + (1,) * (right.ndim - 1))
        bar = np.broadcast_to(bar[:rows], right[:rows].shape)
        ratios[key], small = weighed_in_bars(got[:rows], right[:rows], bar, size_and_unit(key)[0], look)
        negligible = negligible or bool(np.any(small))
    if "W" not in ratios:
        return replace(check, grade="outside", worst=np.inf, note="gives no W")
    by_row = np.max([r.reshape(rows, -1).max(axis=1) for r in ratios.values()], axis=0)
    check.t, check.ratios, check.worst = instants[:rows], by_row, float(by_row.max())
    check.grade = grade_of(check.worst, negligible, look)
    if check.failed:
        check.first = first_outside(ratios, expected, bars, out, instants, look)
        before = [e for e in t.meta["events"] if e[0] <= check.first["t_s"]]
        check.event = before[-1] if before else None
    if profile != "float32":
        expected_ = t.meta["impacts"] if profile == "float64" else t.meta["converged"]["impacts"]
        check.impacts = judge_impacts(expected_, out, instants, rows, look)
        if any(i["grade"] == "outside" for i in check.impacts):
            check.grade = "outside"
    return check


def first_outside(
    ratios: dict, expected: dict, bars: dict, out: dict[str, Any], instants: np.ndarray, look: float
) -> dict[str, Any]:
    """Return the first row that is outside, and the quantity that is most off in it."""
    outside = {k: np.flatnonzero(r.reshape(len(r), -1).max(axis=1) > look) for k, r in ratios.items()}
    row = min(int(i[0]) for i in outside.values() if len(i))
    key = max((k for k, i in outside.items() if len(i) and i[0] == row), key=lambda k: float(np.max(ratios[k][row])))
    index = np.unravel_index(int(np.argmax(ratios[key][row])), ratios[key][row].shape)
    return {
        "row": row,
        "t_s": float(instants[row]),
        "quantity": key,
        "index": [int(i) for i in index],
        "expected": float(expected[key][row][index]),
        "bar": float(bars[key][row]),
        "got": float(np.asarray(out[key])[row][index]),
        "bars": float(ratios[key][row][index]),
    }


def upright(t: np.ndarray, Lambda: np.ndarray) -> np.ndarray:
    """Return instants [s] at which the block passes upright, linear between rows.

    Swings below 0.01 rad (decided) do not count.
    """
    tilt = np.arctan2(np.asarray(Lambda[:, 2, 1], float), np.asarray(Lambda[:, 2, 2], float))
    found, last = [], 0
    for i in np.flatnonzero(np.signbit(tilt[1:]) != np.signbit(tilt[:-1])):
        if np.max(np.abs(tilt[last : i + 1])) > 0.01:
            found.append(t[i] + tilt[i] / (tilt[i] - tilt[i + 1]) * (t[i + 1] - t[i]))
            last = int(i) + 1
    return np.array(found)


def judge_impacts(
    expected: list[dict[str, float]], out: dict[str, Any], instants: np.ndarray, rows: int, look: float
) -> list[dict[str, Any]]:
    """Judge the main impacts, each with its deviation in bars."""
    if out.get("Lambda") is None:
        return []
    with np.errstate(all="ignore"):
        got = upright(instants[:rows], np.asarray(out["Lambda"])[:rows])
    judged = []
    for i, impact in enumerate(expected):
        apart = abs(got[i] - impact["t_s"]) if i < len(got) else np.inf
        off = min(apart / impact["bar_s"], look) if apart <= INSTANT else apart / impact["bar_s"]
        judged.append(
            {**impact, "got_s": float(got[i]) if i < len(got) else None, "bars": off, "grade": grade_of(off, look=look)}
        )
    return judged


def judge_runs(backend: Any, profile: str, report: Callable[[float], None] | None = None) -> list[RunCheck]:
    """Judge all windows and trajectories of L5."""
    names = trajectory_names() if profile == "scheme" else window_names() + trajectory_names()
    asked = [t for t in map(trajectory, names) if profile in t.meta["horizon_s"]]
    found: dict[int, RunCheck] = {}
    for group in grouped([t.problem for t in asked]):
        answers = simulate(backend, [asked[i].problem for i in group])
        for i, answer in zip(group, answers, strict=True):
            if isinstance(answer, ANYTHING):
                found[i] = RunCheck(asked[i].id, asked[i].title, "outside", np.inf, note=raised(answer))
            else:
                found[i] = judge_rows(asked[i], as_mapping(answer, "simulate"), profile)
        if report is not None:
            report(len(found) / len(asked))
    return [found[i] for i in range(len(asked))]
