"""What a run looks like, from its signal alone: the same for a measured one and a modelled one, and the differences."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.measure.signals.activity import ONSET_SIGMAS, Leakage, leakage, onset
from rockref.measure.signals.envelopes import Envelope, EnvelopeShape, envelope_shape, envelopes
from rockref.measure.signals.impacts import Impacts, main_impacts
from rockref.measure.signals.ledger import Ledger, RockingBlock, energy_ledger
from rockref.measure.signals.noise import NoiseFloor
from rockref.measure.signals.spectra import Spectrum, amplitude_spectrum

# decided: an impact that comes more than half a swing early or late belongs to another swing.
SAME_SWING = 0.5
# decided: an arc shorter than this has no envelope and no spectrum.
LEAST_ARC = 0.1


@dataclass(frozen=True, eq=False)
class Features:
    """One run, seen through its signal.

    Attributes: ``impacts``, ``ledger``, ``leak`` as in :mod:`rockref.measure`; ``onset`` s, begin of the
    transverse motion (NaN if unseen); ``envelope``, ``shapes`` (of the rates about Y and Z) and ``spectrum`` of the arc
    between the first two main impacts, None where there is no such arc.
    """

    impacts: Impacts
    ledger: Ledger
    leak: Leakage
    onset: float
    envelope: Envelope | None
    shapes: tuple[EnvelopeShape, EnvelopeShape] | None
    spectrum: Spectrum | None


def features(t: np.ndarray, crv: np.ndarray, block: RockingBlock, noise: np.ndarray) -> Features:
    """Return the features of a run with times t (N,) s and rates crv (N, 3) rad/s; noise (3,) rad/s of the data.

    For a modelled run give the noise of the measured one: both are then read with the same thresholds.
    """
    impacts = main_impacts(t, crv)
    leak = leakage(t, crv, impacts)
    floor = NoiseFloor(noise, np.zeros(3), np.zeros(3), np.zeros(3))
    begin = onset(t, crv, impacts, leak, floor, level=ONSET_SIGMAS * float(noise[1]))
    envelope = shapes = spectrum = None
    if len(impacts) > 1 and impacts.times[1] - impacts.times[0] > LEAST_ARC:
        first, second = map(float, impacts.times[:2])
        envelope = envelopes(t, crv, first, second, noise=float(noise[1:].max()))
        upper, lower = envelope.upper, envelope.lower
        shapes = envelope_shape(upper[0], lower[0]), envelope_shape(upper[1], lower[1])
        spectrum = amplitude_spectrum(t, crv, first, second)
    ledger = energy_ledger(t, crv, block, impacts)
    return Features(impacts, ledger, leak, begin, envelope, shapes, spectrum)


@dataclass(frozen=True)
class ImpactPair:
    """The same main impact in both.

    Attributes: ``number`` from 1; ``measured``, ``model`` s after the release, the model let go at the stated tilt (NaN
    where it then has no such impact); ``error`` s, their difference (positive: the model is late); ``aligned_error`` s,
    the same after the model was aligned with the run's first main impact (whose is zero); ``loss_measured``,
    ``loss_model`` J (NaN where not known).
    """

    number: int
    measured: float
    model: float
    error: float
    aligned_error: float
    loss_measured: float
    loss_model: float


def impact_pairs(measured: Features, stated: Features, aligned: Features, shift: float) -> tuple[ImpactPair, ...]:
    """Return the impacts that the run and the aligned model (then moved by `shift` s) have, in order, up to the first
    that is half a swing off; `stated` is the model at the stated tilt."""
    a, b, c = measured.impacts, aligned.impacts, stated.impacts
    pairs: list[ImpactPair] = []
    for k in range(min(len(a), len(b))):
        swing = float(a.times[k] - (a.times[k - 1] if k else 0.0))
        off = float(b.times[k] + shift - a.times[k])
        if abs(off) > SAME_SWING * swing or a.signs[k] != b.signs[k]:
            break
        known = k < len(c) and a.signs[k] == c.signs[k]
        model = float(c.times[k]) if known else float("nan")
        pairs.append(
            ImpactPair(
                number=k + 1,
                measured=float(a.times[k]),
                model=model,
                error=model - float(a.times[k]),
                aligned_error=off,
                loss_measured=float(measured.ledger.impact_loss[k]),
                loss_model=float(aligned.ledger.impact_loss[k]),
            )
        )
    return tuple(pairs)


@dataclass(frozen=True)
class Losses:
    """Energy lost, as shares: ``impact`` of the energy before an impact, ``free`` of that after it, in the free arc,
    ``cycle`` of that at an apex up to the next apex; means over ``count`` cycles, weighted by energy (NaN if none)."""

    impact: float
    free: float
    cycle: float
    count: int


def losses(ledger: Ledger, count: int) -> Losses:
    """Return the shares over the first `count` main impacts of a ledger (fewer where it has fewer)."""
    n = min(count, len(ledger.times))
    whole = np.isfinite(ledger.impact_loss[:n])
    before = float(ledger.energy_before[:n][whole].sum())
    after = ledger.energy_after[: max(n - 1, 0)]
    free = ledger.free_loss[: max(n - 1, 0)]
    known = np.isfinite(free) & np.isfinite(after)
    apexes = ledger.apex_energy[: max(n - 1, 0)]
    apexes = apexes[np.isfinite(apexes)]
    cycle = float("nan")
    if len(apexes) > 1 and apexes[0] > 0.0:
        cycle = 1.0 - (float(apexes[-1]) / float(apexes[0])) ** (1.0 / (len(apexes) - 1))
    return Losses(
        impact=float(ledger.impact_loss[:n][whole].sum()) / before if before > 0.0 else float("nan"),
        free=float(free[known].sum()) / float(after[known].sum()) if known.any() else float("nan"),
        cycle=cycle,
        count=n,
    )


@dataclass(frozen=True)
class EnvelopeDifference:
    """Envelope of one axis between the first two impacts.

    ``width``, model over measured mean half width; ``shape``, the RMS over the arc of the difference of
    upper and lower line, in measured mean half widths; ``period``, model over measured time between teeth (None where
    one has fewer than three).
    """

    axis: str
    width: float | None
    shape: float | None
    period: float | None


def envelope_differences(measured: Features, model: Features, floor: np.ndarray) -> tuple[EnvelopeDifference, ...]:
    """Return the differences about the transverse and the longitudinal axis; nothing where one has no such arc.

    floor (2,) rad/s: where the measured half width is below it there is no envelope to speak of.
    """
    a, b = measured.envelope, model.envelope
    if a is None or b is None or measured.shapes is None or model.shapes is None:
        return ()
    found = []
    for row, axis in enumerate(("transverse", "longitudinal")):
        mean = measured.shapes[row].mean
        if mean <= floor[row]:
            found.append(EnvelopeDifference(axis, None, None, None))
            continue
        both = np.stack((b.upper[row] - a.upper[row], b.lower[row] - a.lower[row]))
        few = min(a.teeth[row], b.teeth[row]) < 3
        period = None if few else float(b.periods[row] / a.periods[row])
        width = model.shapes[row].mean / mean
        found.append(EnvelopeDifference(axis, width, float(np.sqrt(np.mean(both**2))) / mean, period))
    return tuple(found)


@dataclass(frozen=True)
class SpectrumDifference:
    """Spectrum of one axis between the first two impacts: ``distance``, size of the difference of the amplitudes over
    the size of the measured ones; peaks of both as frequency Hz and amplitude rad/s."""

    axis: str
    distance: float
    peak_measured: tuple[float, float]
    peak_model: tuple[float, float]


def spectrum_differences(measured: Features, model: Features) -> tuple[SpectrumDifference, ...]:
    """Return the differences of the amplitude spectra, axis by axis; nothing where one has no such arc."""
    a, b = measured.spectrum, model.spectrum
    if a is None or b is None:
        return ()
    found = []
    for k, axis in enumerate(("main", "transverse", "longitudinal")):
        size = float(np.linalg.norm(a.amplitudes[k]))
        distance = float(np.linalg.norm(b.amplitudes[k] - a.amplitudes[k])) / size if size > 0.0 else float("nan")
        found.append(SpectrumDifference(axis, distance, a.peak(k), b.peak(k)))
    return tuple(found)
