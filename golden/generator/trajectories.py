"""The files of L5: trajectories and windows, with bars for every profile, events and main impacts."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from golden.generator import runs
from golden.generator.bounds.answers import pattern
from golden.generator.bounds.bars import FACTOR
from golden.generator.questions.drawing import orthonormal
from golden.generator.questions.scenes import (
    LATER_WINDOWS,
    WINDOW_DURATION,
    WINDOW_RATE,
    WINDOWS,
    Scene,
    Window,
    scenes,
)
from golden.generator.runs import HORIZON, Rows
from golden.generator.small_layers import rounded_up, stored
from rockref.conformance.judge.trajectories import SHOWN
from rockref.conformance.vectors import SCHEMA, problem_of
from rockref.engines import run
from rockref.model.simulate import output_steps

#: Steps of the converged solution [s]; the difference of the two is how far it is converged.
FINE, LESS_FINE = 1e-7, 2e-7
#: Bar of the profile "scheme": so many times the largest deviation from the converged solution of five schemes at the
#: stated step, the law's own and `ways.SCHEMES`. Decided: another scheme of the same order may be as much worse again;
#: two that are not among the five (drift-kick-drift, Heun's) keep within it.
SCHEME_FACTOR = 2
#: Least bar of that profile, of the largest value: ten times what storing twelve digits takes away. Decided.
FLOOR = 1e-11
STATE = ("x", "v", "Lambda", "W", "s", "anchored", "sliding")


def window_id(window: Window) -> str:
    """Return the name of a window: scene and instant in milliseconds."""
    return f"window_{window.scene}_{round(window.instant * 1000):04d}ms"


def names() -> tuple[list[str], list[str]]:
    """Return names of the trajectories and of the windows."""
    return [s.id for s in scenes().values() if s.whole], [window_id(w) for w in WINDOWS + LATER_WINDOWS]


def met(q: dict[str, Any]) -> dict[str, Any]:
    """Return what happens in a run of the float64 law: the branch, what every foot does in each row; and the events,
    step by step, [t, point, what it does]: touches, lifts, slides, sticks."""
    problem = problem_of(q)
    r = run(replace(problem, output_rate=1 / problem.step), engine="auto")
    code = r.anchored.astype(int) + (r.anchored & r.sliding)
    found = []
    for row, point in np.argwhere(code[1:] != code[:-1]):
        before, after = code[row, point], code[row + 1, point]
        what = "lifts" if after == 0 else "touches" if before == 0 else "slides" if after == 2 else "sticks"
        found.append([float(f"{r.t[row + 1]:.7g}"), problem.points.names[point], what])
    rows = [pattern(r.anchored[i], r.sliding[i]) for i in output_steps(problem)]
    return {"branch": {"rows": rows}, "events": found}


def table(columns: dict[str, np.ndarray]) -> bytes:
    """Return columns as gzipped CSV; the same bytes for the same numbers."""
    header, flat = [], []
    for name, values in columns.items():
        values = values.reshape(len(values), -1)
        header += [name] if values.shape[1] == 1 else [f"{name}[{i}]" for i in range(values.shape[1])]
        flat.append(values)
    rows = np.concatenate(flat, axis=1)
    lines = [",".join(header)] + [",".join(shortest(v) for v in row) for row in rows.tolist()]
    return gzip.compress(("\n".join(lines) + "\n").encode(), 9, mtime=0)


def shortest(value: float) -> str:
    """Return the shortest decimal that reads back to the same double; nothing where there is no number."""
    return "" if not np.isfinite(value) else repr(value).removesuffix(".0")


@dataclass
class Item:
    """A run to be made: its name, inputs, and seed; whether the converged solution is given too."""

    name: str
    title: str
    kind: str
    q: dict[str, Any]
    seed: int
    converging: bool = False


def items() -> list[Item]:
    """Return all windows and trajectories."""
    things: list[Window | Scene] = [*WINDOWS, *scenes().values(), *LATER_WINDOWS]
    found = [(w, 1000 * (i + 1)) for i, w in enumerate(things)]
    return [item_of(thing, seed) for thing, seed in found if isinstance(thing, Window) or thing.whole]


def item_of(thing: Window | Scene, seed: int) -> Item:
    """Return a run to be made, of a window or a scene."""
    if isinstance(thing, Window):
        return Item(window_id(thing), f"{thing.scene}: {thing.shows}", "window", window_inputs(thing), seed)
    return Item(thing.id, thing.title, "trajectory", thing.inputs, seed, thing.converged)


def barred(item: Item) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Return columns and facts of one run."""
    truth = runs.in_longdouble(item.q)
    members = (
        runs.double_members(item.q, item.seed) + runs.rounding_members(item.q, item.seed) + runs.way_members(item.q)
    )
    bars = runs.bars(members, truth)
    single = runs.bars(runs.single_members(item.q, item.seed), truth, dtype=np.float32)
    runs.held_to_exact(item.q, truth, bars, 1.0 if item.kind == "window" else 0.1)
    columns: dict[str, np.ndarray] = {"t_s": truth.t}
    columns |= {column: np.asarray(getattr(truth, k), float) for k, column in SHOWN.items()}
    columns |= {f"bar_{column}": np.array(rounded_up(bars[k])) for k, column in SHOWN.items()}
    columns |= {f"bar_float32_{column}": np.array(rounded_up(single[k])) for k, column in SHOWN.items()}
    horizon = {
        "float64": runs.horizon(bars, truth, HORIZON[""]),
        "float32": runs.horizon(single, truth, HORIZON["float32_"]),
    }
    impacts = runs.impact_bars(members, truth, horizon["float64"])
    meta: dict[str, Any] = {"horizon_s": horizon, "impacts": impacts, **met(item.q)}
    if item.converging:
        more, facts = converged(item, members[0], truth)
        columns |= more
        meta["horizon_s"]["scheme"] = facts.pop("horizon_s")
        meta["converged"] = facts
    return columns, meta


def converged(item: Item, law: Any, truth: Rows) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """Return the converged solution, and how far five schemes at the stated step are from it."""
    fine, less = (runs.converged(problem_of(item.q), step) for step in (FINE, LESS_FINE))
    right = Rows(truth.t, fine.W, fine.x, fine.Lambda)
    schemes = [law, *runs.scheme_members(item.q)]
    width = {
        k: SCHEME_FACTOR * runs.deviation(schemes, right, k) + FACTOR * runs.deviation([less], right, k) for k in SHOWN
    }
    width = {k: w + FLOOR * max(1.0, float(np.abs(getattr(right, k)).max())) for k, w in width.items()}
    columns = {f"converged_{column}": rounded(getattr(right, k)) for k, column in SHOWN.items()}
    columns |= {f"bar_scheme_{column}": np.array(rounded_up(width[k])) for k, column in SHOWN.items()}
    end = runs.horizon(width, right, HORIZON["scheme_"])
    impacts = [i for i in runs.impact_bars([*schemes, less], right, end, SCHEME_FACTOR) if np.isfinite(i["bar_s"])]
    facts = {"step_s": FINE, "bar_step_s": item.q["step"], "factor": SCHEME_FACTOR, "impacts": impacts}
    return columns, facts | {"horizon_s": end}


def rounded(a: np.ndarray) -> np.ndarray:
    """Round to twelve digits: far below the bar of a converged solution."""
    return np.vectorize(lambda v: float(f"{v:.12g}"))(np.asarray(a, float))


def window_inputs(window: Window) -> dict[str, Any]:
    """Return inputs of a window: the state of the float64 law at its instant, without the last force evaluation."""
    scene = scenes()[window.scene]
    q = scene.q | {"step": scene.step, "duration": WINDOW_DURATION, "output_rate": WINDOW_RATE}
    if window.instant == 0:
        return q
    before = run(
        replace(problem_of(scene.inputs), duration=window.instant, output_rate=1 / window.instant), engine="auto"
    )
    state = {k: np.array(getattr(before.final_state, k)) for k in STATE}
    return q | state | {"Lambda": orthonormal(state["Lambda"])}


def document(name: str, title: str, kind: str, q: dict[str, Any], meta: dict[str, Any]) -> bytes:
    """Return the JSON beside the rows."""
    problem = {k: stored(v) for k, v in q.items()}
    head = {"schema": SCHEMA, "id": name, "layer": "L5", "kind": kind, "title": title, "route": "longdouble"}
    return (json.dumps(head | meta | {"problem": problem}, ensure_ascii=False, separators=(",", ":")) + "\n").encode()


def files(say: Callable[[str], None]) -> Iterator[tuple[str, bytes]]:
    """Yield all files of L5: name and bytes."""
    for item in items():
        columns, meta = barred(item)
        say(f"{item.name}: {meta['horizon_s']}, impacts {meta['impacts']}, {len(meta['events'])} events")
        yield f"L5/{item.name}.json", document(item.name, item.title, item.kind, item.q, meta)
        yield f"L5/{item.name}.csv.gz", table(columns)
