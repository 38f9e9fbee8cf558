"""A fitted model family: where it stands, what it gains over another, how large its effects are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rockref.discover import window_rules as rules
from rockref.discover.fit.beside import side_by_side
from rockref.discover.fit.common_factor import shared_out
from rockref.discover.fit.evidence import clipped_gain
from rockref.discover.fit.intervals import NINETY, half_widths
from rockref.discover.fit.least_squares import Fit, Point, out_of_step
from rockref.discover.fit.search import Setup, baseline, nominal
from rockref.discover.hypotheses.candidates import FORMS, SHAPES, value_of


@dataclass
class Family:
    """A fitted model family: which effects, the fit and where it stands."""

    effects: tuple[str, ...]
    fit: Fit
    point: Point


def refit(family: Family, iterations: int, seed: int, relative: float = 0.0) -> Family:
    """Go on from where a family stands; the baseline and every candidate get the same iterations."""
    rng = np.random.default_rng(seed)
    point = family.fit.run(family.point, iterations, rng, relative=relative)
    return Family(family.effects, family.fit, shared_out(family.fit, point))


def refit_all(
    setup: Setup, families: Sequence[Family], iterations: int, seed: int, relative: float = 0.0
) -> list[Family]:
    """The same for several families, side by side."""

    def one(own: Setup, family: Family) -> Family:
        return refit(replace(family, fit=family.fit.twin(own.log)), iterations, seed, relative)

    return side_by_side(setup, one, families)


def afresh(setup: Setup, family: Family) -> Family:
    """A family fitted from the nominal parameters and the sizes of its effects.

    What it started from was bent to make up for the effect, and holds it back.
    """
    z = nominal(family.fit.parameters, family.point.z)
    return Family(family.effects, *baseline(setup, family.effects, z))


def structured(family: Family, run: int | None = None) -> float:
    """Share of the windows (of one run, if given) that the family leaves structured."""
    mine = slice(None) if run is None else family.fit.series.run_of == run
    return float(np.mean(out_of_step(family.fit, family.point)[mine]))


def loud(loss: np.ndarray, count: np.ndarray) -> int:
    """How many windows are far above the noise; loss, count: of each window."""
    return int(np.sum(2 * loss / count > rules.LOUD))


def room(family: Family) -> float:
    """What any further effect could gain: the loss above noise, each window's clipped as in a gain."""
    count = family.fit.series.count
    return clipped_gain(family.point.loss, rules.NOISE * count / 2, count)


def mean_loss(family: Family) -> float:
    """Mean over the windows of the loss; 1 is noise."""
    return float(np.mean(2 * family.point.loss / family.fit.series.count))


def same_windows(one: Family, other: Family) -> bool:
    """Whether two families were compared on the same windows (a sensor effect moves the cuts)."""
    a, b = one.fit.series, other.fit.series
    return len(a.start) == len(b.start) and bool(np.all(a.start == b.start) and np.all(a.stop == b.stop))


def gain_over(kept: Family, other: Family) -> float:
    """What a family gains over another one on the same windows, priors included."""
    gain = clipped_gain(kept.point.loss, other.point.loss, kept.fit.series.count)
    return gain - (other.point.penalty - kept.point.penalty)


def gain_between(kept: Family, other: Family) -> float:
    """The gain, also where a sensor effect has moved the cuts of the windows: sample by sample then.

    Both kinds of gain are clipped alike, so that candidates with and without a sensor may be ranked by them.
    """
    if same_windows(kept, other):
        return gain_over(kept, other)
    worse, better = by_sample(kept, kept.point.loss), by_sample(other, other.point.loss)
    count = by_sample(kept, kept.fit.series.count)
    return clipped_gain(worse, better, count) - (other.point.penalty - kept.point.penalty)


def leaves_nothing(family: Family, kept: Family) -> bool:
    """Whether a family that gains much over `kept` leaves nothing above the noise: another can be little better."""
    return room(family) <= 0 and gain_between(kept, family) > rules.WELL_ABOVE_NOISE


def by_sample(family: Family, of_windows: np.ndarray) -> np.ndarray:
    """What the windows of a family have, shared out evenly over the samples of the runs, one after the other."""
    series = family.fit.series
    return np.repeat(of_windows / series.length, series.length)


def size_of(family: Family, effect: str | None = None) -> float:
    """Largest switch of an effect (by default the last one) in typical sizes; what only shapes it does not count."""
    effect = effect or family.effects[-1]
    z = [
        abs(max(zi, p.least))
        for p, zi in zip(family.fit.parameters, family.point.z, strict=True)
        if p.name.startswith(effect + ".")
        and tuple(p.name.split(".")) not in SHAPES | FORMS
        and p.name not in ("base_vibration.frequency", "base_vibration.direction")
    ]
    return float(max(z, default=0.0))


def far_fetched(families: Iterable[Family], winner: Family) -> frozenset[str]:
    """Effects that these families would need at far more than their typical size; none, if the winner is one."""
    if max((size_of(winner, e) for e in winner.effects), default=0.0) > rules.FAR_FETCHED:
        return frozenset()
    return frozenset(f.effects[-1] for f in families if size_of(f) > rules.FAR_FETCHED)


def amplitudes(family: Family) -> dict[str, dict[str, Any]]:
    """Value, 90 % interval and unit of each parameter of the family's effects."""
    fit, point = family.fit, family.point
    H, _, _ = fit.normal_equations(point)
    covariance = np.linalg.inv(H + np.diag(1 / fit.prior**2))
    half, found = half_widths(fit, point, covariance), {}
    for i, p in enumerate(fit.parameters):
        if "." not in p.name:
            continue
        ends = sorted((value_of(p, point.z[i] - half[i]), value_of(p, point.z[i] + half[i])))
        found[p.name] = {
            "value": value_of(p, point.z[i]), "low": ends[0], "high": ends[1], "unit": p.unit,
            "in_typical_sizes": float(point.z[i]),
        }  # fmt: skip
    return found | vibration_amplitude(found)


def vibration_amplitude(found: dict[str, dict[str, Any]]) -> dict[str, dict[str, Any]]:
    """The amplitude of a base vibration, from the cosine and sine parts of the runs: their mean, and their spread."""
    parts = [[row["value"] for name, row in found.items() if f".{part}[" in name] for part in ("cosine", "sine")]
    if not parts[0]:
        return {}
    sizes = np.hypot(*np.array(parts))
    value, half = (
        float(sizes.mean()),
        float(NINETY * sizes.std() / np.sqrt(len(sizes)) + rules.SYSTEMATIC * sizes.mean()),
    )
    return {"base_vibration.amplitude": {"value": value, "low": value - half, "high": value + half, "unit": "m/s2"}}
