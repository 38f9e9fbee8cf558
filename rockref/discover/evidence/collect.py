"""From fits to evidence: eigenvalues, losses by run and axis, amplitudes with intervals, held-out runs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.discover.evidence.evidence import HypothesisEvidence, Number
from rockref.discover.evidence.held_out import held_out_fit
from rockref.discover.evidence.widths import deviations
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.floor import floor
from rockref.discover.fit.objective import WHITE, loss
from rockref.discover.fit.stages import TOLD, F
from rockref.discover.hypotheses.effects import own_value
from rockref.discover.hypotheses.parameter import Parameter, centring
from rockref.discover.listening.listener import Listener

#: Half width of a 90 % interval in standard deviations of a normal law.
NINETY = 1.6449
#: Mean loss, of all and of one axis of a run, from which a model is asked what it leaves in records of its own
#: (decided: below them no limit is near).
ASKED, ASKED_OF_AXIS = 1.0, 1.15
#: Length of a block [s] and mean loss from which it is far above white; decided: white blocks of 150 values have 0.947
#: with a deviation of 0.09.
BLOCK, FAR_ABOVE = 0.05, 1.5
#: Share of the blocks, the worst fitting ones, that the error in deg/s leaves out: they are out of step (decided).
TRIMMED = 0.10


def least_loss(fitter: Fitter, h: FittedModel) -> tuple[float, np.ndarray]:
    """Return the mean loss that these runs would leave of a right model, in all and by run and axis (R, 3): that of
    white noise, or what a model that comes near it leaves in records of its own.

    h : the best of all that were fitted. Records of a wrong model's own are others than these.
    """
    losses = fitter.losses(h)
    if h.loss > ASKED or losses.max() > ASKED_OF_AXIS:
        return floor(fitter, h, F)
    return WHITE, np.full(losses.shape, WHITE)


def hypothesis_evidence(
    fitter: Fitter, h: FittedModel, temperature: float, interval: float, least: tuple[float, np.ndarray] | None = None
) -> HypothesisEvidence:
    """Return what a fit at the longest memory says of the fit runs.

    temperature : of the evidence;  interval : factor on the half widths of intervals;  least : of a right
    model, as `least_loss` returns it; h is asked if None
    """
    deviation, H = deviations(fitter, h, F, temperature)
    runs = fitter.problem.runs
    parameters = fitter.parameters(h)
    found = numbers_of(parameters, centring(parameters) @ h.z, interval * deviation)
    losses, (all_of_it, floors) = fitter.losses(h), least or least_loss(fitter, h)
    law = [abs(float(z)) for p, z in zip(parameters, h.z, strict=True) if not p.effect and p.run is None]
    return HypothesisEvidence(
        effects=h.effects,
        objective=h.objective,
        eigenvalues=np.linalg.eigvalsh(H).tolist(),
        loss=h.loss,
        loss_by_run_and_axis={run.id: row.tolist() for run, row in zip(runs, losses, strict=True)},
        floor=all_of_it,
        floor_by_run_and_axis={run.id: row.tolist() for run, row in zip(runs, floors, strict=True)},
        blocks={run.id: float(share) for run, share in zip(runs, far_above(fitter, h), strict=True)},
        farthest=max(law, default=0.0),
        numbers={name: n for name, n in found.items() if "." in name},
        law={name: n for name, n in found.items() if "." not in name},
        error=errors(fitter, h),
    )


def add_held_out(said: HypothesisEvidence, fitter: Fitter, h: FittedModel, held: Listener) -> None:
    """Add what the held-out runs say of a hypothesis."""
    inner, k = held_out_fit(fitter, h, held)
    by_run = inner.losses(k).mean(axis=1)
    said.held_out = {run.id: float(value) for run, value in zip(held.runs, by_run, strict=True)}
    said.held_out_error = errors(inner, k)["total"]


def errors(fitter: Fitter, h: FittedModel) -> dict[str, float]:
    """Return the root mean square of the innovations by axis and in all [deg/s], the worst tenth of blocks left out.

    Innovations are those of a longer memory, without the jitter by which steep parts count less.
    """
    listener, parameters = fitter.problem.listener, fitter.parameters(h)
    r = fitter.residuals(TOLD).at(parameters, [h.z])[0] * listener.sigma[:, None, :]
    length = max(1, round(BLOCK * listener.gyro.sample_rate))
    n = r.shape[1] // length * length
    square = (np.degrees(r[:, :n]) ** 2).reshape(r.shape[0], -1, length, 3).mean(axis=2)
    there = listener.valid[:, :n].reshape(r.shape[0], -1, length).all(axis=2)
    square = square[there]
    kept = square.sum(axis=1) <= np.quantile(square.sum(axis=1), 1 - TRIMMED)
    by_axis = np.sqrt(square[kept].mean(axis=0))
    return {**dict(zip(AXES, map(float, by_axis), strict=True)), "total": float(np.sqrt(square[kept].mean()))}


def numbers_of(parameters: Sequence[Parameter], z: np.ndarray, deviation: np.ndarray) -> dict[str, Number]:
    """Return the numbers that all runs share, and those of effects in single runs, with their 90 % intervals."""
    found = {}
    for k, p in enumerate(parameters):
        if not p.effect and p.run is not None:
            continue
        half = NINETY * float(deviation[k])
        ends = sorted(own_value(p, float(np.clip(z[k] + s * half, p.least, p.most))) for s in (-1, 1))
        size = float(z[k]) / p.typical if p.typical else 0.0
        found[p.name] = Number(own_value(p, float(z[k])), ends[0], ends[1], p.unit, float(z[k]), size)
    if "K_T" in found and "K_N" in found:  # fitted as their ratio
        by = found["K_N"].value
        n = found["K_T"]
        found["K_T"] = replace(n, value=by * n.value, low=by * n.low, high=by * n.high, unit=found["K_N"].unit)
    return found


def far_above(fitter: Fitter, h: FittedModel) -> np.ndarray:
    """Return the share of blocks of each run whose mean loss is far above white, (R,)."""
    assert h.r is not None
    length = max(1, round(BLOCK * fitter.problem.listener.gyro.sample_rate))
    R, n = h.r.shape[:2]
    whole = n // length * length
    means = loss(h.r[:, :whole]).reshape(R, -1, length * 3).mean(axis=2)
    return (means > FAR_ABOVE).mean(axis=1)
