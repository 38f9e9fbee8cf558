"""A comparison as plain JSON values; the keys carry the units and are documented in docs/reference/compare.md."""

from __future__ import annotations

import math
from dataclasses import asdict
from typing import Any

import numpy as np

from rockref.discover.compare.band import Departure
from rockref.discover.compare.features import Features, Losses
from rockref.discover.compare.models import Comparison, MeasuredRun, RunComparison
from rockref.discover.compare.sentences import findings
from rockref.discover.compare.stretches import AXES, STRETCHES, StretchError
from rockref.discover.diagnosis_record import plain
from rockref.model.channel import DEGREES

SCHEMA = "rockref.compare/1"


def to_dict(comparison: Comparison) -> dict[str, Any]:
    """Return the whole comparison: JSON numbers, null where something is not known; keys: docs/reference/compare.md."""
    c, e = comparison, comparison.experiment
    return plain(
        {
            "schema": SCHEMA,
            "experiment": {
                "name": e.name,
                "sha256": e.digest,
                "runs": {use: [m.run.id for m in c.measured if m.run.use == use] for use in ("fit", "holdout")},
                "notices": [str(notice) for notice in e.notices],
            },
            "noise_floor_deg_s": {axis: DEGREES * c.noise(k) for k, axis in enumerate(AXES)},
            "measured": [_measured(m) for m in c.measured],
            "models": [_model(c, k) for k in range(len(c.names))],
            "sentences": [{"kind": f.kind, "model": f.model, "text": f.text, "values": f.values} for f in findings(c)],
            "engine": c.engine,
            "step_s": c.step,
            "seconds": round(c.seconds, 3),
        }
    )


def _measured(m: MeasuredRun) -> dict[str, Any]:
    spread = m.repeats
    return {
        "run": m.run.id,
        "use": m.run.use,
        "release_tilt_rad": m.run.release_tilt,
        "block_turned_deg": None if m.run.block_turned is None else math.degrees(m.run.block_turned),
        "noise_deg_s": _by_axis(m.noise * DEGREES),
        "main_impacts_s": m.features.impacts.times,
        "onset_before_first_impact_s": _lead(m.features),
        "spread": None if spread is None else "borrowed" if m.borrowed else "own",
        "runs_agree_until_s": None if spread is None else _by_axis(m.first_impact + spread.alike_until),
    }


def _by_axis(values: np.ndarray) -> dict[str, float]:
    return dict(zip(AXES, values.tolist(), strict=True))


def _model(c: Comparison, k: int) -> dict[str, Any]:
    uses = [use for use in ("fit", "holdout") if c.of(use)]
    return {
        "name": c.names[k],
        "effects": {effect.id: effect.values() for effect in c.models[k].active_effects()},
        "error_deg_s": {
            use: {s: {axis: DEGREES * c.rms(k, s, axis, use) for axis in AXES} for s in STRETCHES} for use in uses
        },
        "runs": [_run(r, c.measured[i]) for i, r in enumerate(c.results[k])],
    }


def _run(r: RunComparison, m: MeasuredRun) -> dict[str, Any]:
    return {
        "run": r.run,
        "use": m.run.use,
        "overturned": r.overturned,
        "tilt_offset_rad": r.tilt_offset,
        "shift_s": r.shift,
        "leaves_band": None if r.leaves_band is None else _departure(r.leaves_band),
        "errors": [_error(e) for e in r.errors],
        "impacts": [
            {
                "number": p.number,
                "measured_s": p.measured,
                "model_s": p.model,
                "error_s": p.error,
                "aligned_error_s": p.aligned_error,
                "loss_measured_J": p.loss_measured,
                "loss_model_J": p.loss_model,
            }
            for p in r.impacts
        ],
        "loss_shares": {"measured": _losses(r.losses_measured), "model": _losses(r.losses_model)},
        "onset_before_first_impact_s": _lead(r.features),
        "envelopes": [asdict(e) for e in r.envelopes],
        "spectra": [
            {
                "axis": s.axis,
                "distance": s.distance,
                "peak_measured": {"frequency_hz": s.peak_measured[0], "amplitude_deg_s": DEGREES * s.peak_measured[1]},
                "peak_model": {"frequency_hz": s.peak_model[0], "amplitude_deg_s": DEGREES * s.peak_model[1]},
            }
            for s in r.spectra
        ],
    }


def _error(e: StretchError) -> dict[str, Any]:
    return {
        "stretch": e.stretch,
        "axis": e.axis,
        "rms_deg_s": DEGREES * e.rms,
        "rms_on_clock_deg_s": DEGREES * e.on_clock,
        "in_noise": e.in_noise,
        "in_spread": e.in_spread,
        "measured_over_model": e.ratio,
        "correlation": e.correlation,
    }


def _departure(d: Departure) -> dict[str, Any]:
    return {
        "time_s": d.time,
        "after_impact_s": d.after_impact,
        "axis": d.axis,
        "error_deg_s": DEGREES * d.error,
        "limit_deg_s": DEGREES * d.limit,
        "points": [{"name": name, "share": share} for name, share in d.points],
    }


def _losses(x: Losses) -> dict[str, Any]:
    return {"impact": x.impact, "free": x.free, "cycle": x.cycle, "impacts": x.count}


def _lead(f: Features) -> float | None:
    return float(f.impacts.times[0] - f.onset) if len(f.impacts) else None
