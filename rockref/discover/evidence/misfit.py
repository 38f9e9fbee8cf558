"""What the misfit of a baseline looks like: its axis, its stretch, and whether it begins with the release."""

from __future__ import annotations

from typing import Any

import numpy as np

from rockref.discover.compare.stretches import AXES
from rockref.discover.evidence.parity import coherence, locked_to, parity, repeats, slopes
from rockref.discover.fit.fitter import FittedModel, Fitter
from rockref.discover.fit.objective import WHITE, loss
from rockref.discover.listening.listener import record_of
from rockref.measure.signals.impacts import main_impacts

#: A misfit before the first main impact that is so many times that after it belongs to the release (decided).
RELEASE = 1.5
#: What belongs to an impact [s before, after]; decided: a contact lasts 1.5 ms, the feet clatter for some 20 ms.
IMPACT = (0.005, 0.025)


def misfit(fitter: Fitter, null: FittedModel, best: FittedModel) -> dict[str, Any]:
    """Return shares of the loss above white by axis and stretch, before and after the best hypothesis.

    Both are evaluated at the longest memory.
    """
    listener, runs = fitter.problem.listener, fitter.problem.runs
    assert null.r is not None and best.r is not None
    excess = above_white(null.r, listener.valid)
    rest = above_white(best.r, listener.valid)
    impacts = [main_impacts(*record_of(run)) for run in runs]
    near = np.zeros(listener.valid.shape, bool)
    first = np.zeros(listener.valid.shape, bool)
    for i, found in enumerate(impacts):
        t, times = listener.t[i], found.times
        for at in times:
            near[i, : len(t)] |= (t > at - IMPACT[0]) & (t < at + IMPACT[1])
        if len(times):
            first[i, : len(t)] = t < times[0] - IMPACT[0]
    at_release = float(np.median([mean_of(null.r, first, i) for i in range(len(runs))]))
    after = mean_of(null.r, listener.valid & ~first)
    axis = int(np.argmax(excess))
    alike, coherent = repeats(listener, null.r[..., axis]), coherence(listener, null.r[..., axis])
    return {
        "axis": AXES[axis],
        "axis_shares": shares(AXES, excess),
        "remaining_axis_shares": shares(AXES, rest),
        "phase": "release" if at_release > RELEASE * max(after, WHITE) else "impacts",
        "loss_at_release": at_release,
        "loss_after": after,
        "stretch_shares": shares(("free_arc", "impact"), by_stretch(null.r, listener.valid, near)),
        "frequency_hz": strongest_frequency(null.r, listener.gyro.sample_rate),
        **parity(slopes(listener, impacts, near, null.r[..., 0])),
        "repeats": alike,
        "coherence": coherent,
        "locked_to": locked_to(alike, coherent),
    }


def above_white(r: np.ndarray, valid: np.ndarray) -> np.ndarray:
    """Return the loss (3,) of each axis above that of white noise."""
    n = int(valid[:, : r.shape[1]].sum())
    return np.maximum(loss(r).sum(axis=(0, 1)) - WHITE * n, 0.0)


def mean_of(r: np.ndarray, mask: np.ndarray, run: int | None = None) -> float:
    """Return the mean loss of the samples of a mask (R, N), of one run or of all."""
    rows = slice(None) if run is None else slice(run, run + 1)
    chosen = mask[rows, : r.shape[1]]
    return float(loss(r[rows])[chosen].mean()) if chosen.any() else WHITE


def by_stretch(r: np.ndarray, valid: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Return the loss (2,) above white in free arcs and at main impacts."""
    total = loss(r).sum(axis=-1)
    valid, near = valid[:, : r.shape[1]], near[:, : r.shape[1]]
    return np.array([max(total[m].sum() - 3 * WHITE * m.sum(), 0.0) for m in (valid & ~near, valid & near)])


def strongest_frequency(r: np.ndarray, rate: float) -> float:
    """Return the strongest frequency of the innovations [Hz]."""
    power = np.sum(np.abs(np.fft.rfft(np.clip(r, -10, 10), axis=1)) ** 2, axis=(0, 2))
    return float(np.fft.rfftfreq(r.shape[1], 1 / rate)[1 + int(np.argmax(power[1:]))])


def shares(names: tuple[str, ...], power: np.ndarray) -> dict[str, float]:
    """Return shares of a power by name."""
    return {name: float(p / max(power.sum(), 1e-9)) for name, p in zip(names, power, strict=True)}
