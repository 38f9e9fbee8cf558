"""The numbers that fill the page: effects, priors, the model, the measured runs; plain values for JSON."""

from __future__ import annotations

import base64
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from rockref.api import Model
from rockref.effects.base import in_json
from rockref.effects.catalogue import EFFECTS, QUESTIONS
from rockref.lab import golden, layout
from rockref.lab.wasm import binary
from rockref.measure import main_impacts
from rockref.measure.experiment import TILT_UNCERTAINTY
from rockref.measure.records.release import Experiment, Run
from rockref.measure.signals.noise import noise_floor
from rockref.measure.signals.repeatability import Repeatability, repeat_groups, repeatability
from rockref.model.channel import DEGREES
from rockref.model.errors import InputError
from rockref.model.geometry import EXTERNAL, INTERNAL
from rockref.model.parameters import GENES_12, TABLE_3_1
from rockref.report.html.encoding import LARGEST, packed

#: Spread of a parameter about Table 3.1: the standard deviation of its logarithm. Decided, as in the fits of
#: `rockref.discover`: 15 %, and 8 % for delta_diag, half a stated digit and more.
SPREAD = dict.fromkeys(GENES_12[:-1], 0.15) | {"delta_diag": 0.08}
#: What a slider spans. Decided: factors of three, of two for delta_diag, and heights down to nothing and up to 0.2 mm.
SPAN = {name: (1 / 3, 3.0) for name in GENES_12[:6]} | {"delta_diag": (0.5, 2.0)}
HEIGHTS = (-5e-5, 2e-4)
#: Roll of a release against the posture at rest [rad], as in the fits of `rockref.discover`.
ROLL_UNCERTAINTY = 1e-4
WORDS = {
    "K_N": "normal stiffness", "K_T": "tangential stiffness", "beta_int": "damping, inner points",
    "beta_ext": "damping, outer points", "mu_int": "friction, inner points", "mu_ext": "friction, outer points",
    "delta_long_1": "height of outer point 1", "delta_long_2": "height of outer point 2",
    "delta_long_3": "height of outer point 3", "delta_long_4": "height of outer point 4",
    "delta_diag": "inner points from the corner", "theta_0": "release tilt",
}  # fmt: skip


def effects() -> list[dict[str, Any]]:
    """Return all effects of the catalogue that the page can switch on, with their quantities, question by question."""
    found = []
    for question, answers in QUESTIONS.items():
        for kind in answers[1:]:
            quantities: list[dict[str, Any]] = [
                {"name": name, "unit": q.unit, "sign": q.sign, "meaning": q.meaning}
                | {key: in_json(getattr(q, key)) for key in ("absent", "low", "high", "typical", "least", "most")}
                for name, q in kind.quantities.items()
            ]
            facts = {"id": kind.id, "question": question, "sentence": kind.sentence, "experiment": kind.experiment}
            switches = list(kind.quantities if kind.switches is None else kind.switches)
            found.append(facts | {"confounder": kind.confounder, "switches": switches, "quantities": quantities})
    assert {entry["id"] for entry in found} == set(EFFECTS)
    return found


def parameters(model: Model, tilt_uncertainty: float) -> list[dict[str, Any]]:
    """Return the twelve parameters with prior (centre and spread) and the span of their sliders."""
    acting = model.acting_parameters()
    found = []
    for name in GENES_12:
        given = TABLE_3_1[name]
        entry = {"name": name, "unit": given.unit, "words": WORDS[name], "acts": name in acting, "centre": given.value}
        if name == "theta_0":
            entry |= {"spread": tilt_uncertainty, "log": False}
        else:
            low, high = HEIGHTS if name.startswith("delta_long") else tuple(given.value * s for s in SPAN[name])
            entry |= {"spread": SPREAD[name], "log": True, "low": low, "high": high}
        found.append(entry)
    return found


def column(values: np.ndarray, resolution: float) -> dict[str, Any]:
    """Return rates (N,) in deg/s, exact: as 16-bit multiples of `resolution` where they are that, else float64."""
    if resolution > 0.0:
        whole = np.rint(values / resolution)
        # 1e-9 deg/s: what a text of a rate loses on its way through rad/s is a millionth of that.
        if np.max(np.abs(whole)) <= LARGEST and np.max(np.abs(whole * resolution - values)) < 1e-9:
            return packed(values, resolution)
    return {"unit": 0.0, "n": len(values), "data": base64.b64encode(values.astype("<f8").tobytes()).decode("ascii")}


def measured(run: Run, resolution: float, repeats: Repeatability | None) -> dict[str, Any]:
    """Return one run: release, rates in deg/s at even instants, main impacts [s], noise and spread [deg/s].

    Raises InputError E-LAB where the samples are not even.
    """
    assert run.t is not None and run.crv is not None and run.release_tilt is not None
    step = float(run.t[-1] - run.t[0]) / (len(run.t) - 1)
    if np.max(np.abs(np.diff(run.t) - step)) > 0.5 * step or abs(run.t[0]) > 0.5 * step:
        what = "is not sampled evenly from the release on"
        raise InputError("E-LAB", f"run {run.id}", what, "Resample it: the page compares sample by sample.")
    impacts = main_impacts(run.t, run.crv).times
    sigma = np.maximum(noise_floor(run.t, run.crv).sigma * DEGREES, resolution / math.sqrt(12.0))
    return {
        "id": run.id, "use": run.use, "tilt": run.release_tilt, "turned": abs(run.block_turned) > 0.5 * math.pi,
        "step": step, "rates": [column(run.crv[:, k] * DEGREES, resolution) for k in range(3)],
        "impacts": [float(t) for t in impacts], "noise": sigma.tolist(), "spread": spread(run, impacts, repeats),
    }  # fmt: skip


def spread(run: Run, impacts: np.ndarray, repeats: Repeatability | None) -> list[list[float | None]] | None:
    """Return the standard deviation between repeated runs [deg/s] by stretch and axis; None without repeats."""
    if repeats is None or not len(impacts):
        return None
    assert run.t is not None
    first, second = float(impacts[0]), float(impacts[1]) if len(impacts) > 1 else math.inf
    inside = [run.t < first, (run.t >= first) & (run.t < second), run.t >= second]
    after, rows = run.t - first, []
    known = np.stack([np.interp(after, repeats.t, s, left=np.nan, right=np.nan) for s in repeats.spread.T], axis=-1)
    for mask in inside:
        values = known[mask] * DEGREES
        values = values[np.isfinite(values[:, 0])]
        rows.append([in_json(float(r)) for r in np.sqrt(np.mean(values**2, axis=0))] if len(values) else [None] * 3)
    return rows  # type: ignore[return-value]


def experiment(e: Experiment) -> dict[str, Any]:
    """Return an experiment of releases: gyroscope, uncertainty of the tilt, runs. Raises InputError E-KIND, E-LAB."""
    if e.kind != "release" or e.gyro is None:
        cure = "The lab shows releases with a gyroscope; rockref compare shows tosses."
        raise InputError("E-KIND", str(e.path), f"kind is {e.kind!r}", cure)
    runs: Sequence[Run] = [run for run in e.runs if run.loaded]
    groups = {
        (group[0].release_tilt, group[0].block_turned): repeatability([(r.t, r.crv) for r in group])  # type: ignore[misc]
        for group in repeat_groups(runs)
    }
    # decided: where several releases were repeated, the first of the file is lent to the others.
    lent, resolution = next(iter(groups.values()), None), round(e.gyro.resolution * DEGREES, 12)
    sheet = {
        "rate": e.gyro.sample_rate, "bandwidth": e.gyro.bandwidth, "noise": e.gyro.noise * DEGREES,
        "resolution": resolution, "range": None if e.gyro.range is None else e.gyro.range * DEGREES,
    }  # fmt: skip
    return {
        "name": e.name,
        "gyro": sheet,
        "tilt_uncertainty": e.tilt_uncertainty or TILT_UNCERTAINTY,
        "runs": [measured(r, resolution, groups.get((r.release_tilt, r.block_turned), lent)) for r in runs],
    }


def start(model: Model) -> dict[str, Any]:
    """Return the model at which the page begins: its numbers by name, and its effects. Raises InputError E-LAB."""
    row = dict(zip(layout.MODEL, layout.model_row(model), strict=True))
    on = {e.id: {k: in_json(v) for k, v in e.values().items()} for e in model.active_effects()}
    if unknown := set(on) - set(EFFECTS):
        what = f"has {', '.join(sorted(unknown))}, which the page does not have"
        raise InputError("E-LAB", "the model", what, "Take it out: the lab has the effects of the catalogue.")
    return {"numbers": row, "effects": on}


def pack(model: Model, measurement: Experiment | None = None) -> dict[str, Any]:
    """Return everything that the page needs beside its programs. Raises InputError E-KIND, E-LAB."""
    import rockref

    shown = None if measurement is None else experiment(measurement)
    uncertainty = TILT_UNCERTAINTY if shown is None else shown["tilt_uncertainty"]
    return {
        "version": rockref.__version__,
        "layout": {
            "model": list(layout.MODEL),
            "values": layout.value_places(),
            "count": layout.count_values(),
            "columns": layout.page_columns(),
        },
        "points": {"8": list(EXTERNAL + INTERNAL), "4": list(EXTERNAL)},
        "effects": effects(),
        "parameters": parameters(model, uncertainty),
        "roll_uncertainty": ROLL_UNCERTAINTY,
        "start": start(model),
        "golden": golden.read(),
        "golden_models": {name: start(getattr(Model, name)())["numbers"] for name in ("table_3_1", "four_points")},
        "experiment": shown,
        "wasm": base64.b64encode(binary()).decode("ascii"),
    }
