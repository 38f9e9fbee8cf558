"""What must be known before the runs are cut: a sensor that misleads, a wire that holds, a base that shakes."""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations

import numpy as np

from rockref.discover.fit.approach import best_for_all, placed, shares_of, switches
from rockref.discover.fit.families import Family, size_of
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import Setup, release_windows
from rockref.discover.window_rules import LEAST_SIZE
from rockref.discover.windows.clipped import flat_tops
from rockref.effects import catalogue

#: Sensor effects that spoil the reconstructed state, so that every window misfits whatever the physics.
MISLEADING = ("gyro_misalignment", "gyro_scale", "gyro_drift", "gyro_bandwidth", "clock_error", "gyro_saturation")
#: Loads that act on the release so strongly that the baseline has to bend out of shape to follow.
HOLDING = ("lingering_wire_pull", "release_velocity", "plate_tilt", "mass_eccentricity")
#: Mean loss of the release windows (1 is noise) above which something strong is at work; decided on the control's 0.9.
STRONG = 1.35
#: Mean loss of the worst run's release above which loads are looked for there (decided: wires that hold on, releases
#: with a velocity and a centre that is off, at once and twice the typical size, left 9 to 10.6; uneven feet that settle
#: left 2.4, which a tenth of a typical velocity or a typical tilt of the plate explain as well, and neither is there).
HELD = 5.0
#: Of these, what is looked for below HELD, too, where it must have a size: both are over when the block is on its way,
#: and a sensor that takes their place spoils what follows. Decided: half a typical pull left 2.2 in the worst run, and
#: was taken for a clock; of feet that settle, and of six other releases that were a little off, it explained nothing.
#: Half a typical push left 4.5, and was taken for a drift, which explains 0.62 of it where the push explains all; of
#: the eight other releases of one blind set that were so far off it explained at most 0.3, at an eighth of its size.
SLIGHT = ("lingering_wire_pull", "release_velocity")
#: Share of the excess loss that an effect must explain to be taken along from the start.
EXPLAINED = 0.6
#: The same for two effects together, which are tried where no single one does: the best few of them, two at a time.
#: Decided: axes askew and a release with a velocity explain 0.33 and 0.11 alone and all of it together; axes askew and
#: a drift, which was not there, 0.61.
TOGETHER, FEW = 0.9, 3
#: A fit of the releases goes on past its iterations, up to LONGEST, while one of them takes off more than this share of
#: what is left. Decided: of a wire that pulled with 6.3 N half was left after six, the sixth had taken off a seventh of
#: it, and after nine nothing was left; fits that were on no way had gained hundredths.
FALLING, LONGEST = 0.05, 24
#: A tone stands out when its power exceeds this many times the median of the scan (decided on records without one).
TONE = 12.0


def excess(fit: Fit, point: Point) -> float:
    """Loss of the release windows beyond noise."""
    return max(point.objective - 0.5 * float(fit.series.count.sum()), 0.0)


def begun(setup: Setup, fit: Fit) -> Point:
    """Where a fit of the releases begins: with everything absent; stops of the gyroscope as soft ones, if there are any
    (hard ones show as flat tops)."""
    soft = [p.name == "gyro_saturation.softness" for p in fit.parameters]
    if not any(soft) or flat_tops(setup.experiment, setup.runs) is not None:
        return fit.begin()
    return placed(fit, np.array(soft, float))


def release_fit(setup: Setup, effects: tuple[str, ...] = (), iterations: int = 6) -> tuple[Fit, Point]:
    """Fit of the release windows, where nothing is restarted; begun at the best of some sizes of the effects."""
    fit = setup.fit(release_windows(setup), effects)
    point = begun(setup, fit)
    for i in switches([p.name for p in fit.parameters], []):
        moves = np.zeros((len(shares := shares_of(fit.parameters[i])), len(point.z)))
        moves[:, i] = shares
        point = best_for_all(fit, point, moves)
    lam, little = 1e-2, 0
    for i in range(LONGEST):
        before = point.objective
        point, lam = fit.step(point, lam)
        if i + 1 >= iterations and before - point.objective <= max(FALLING * excess(fit, point), 1.0):
            break
        # Twice in a row: a shaking base of half the typical size gained 1.1 and 0.8 units before it gained 400.
        little = little + 1 if before - point.objective < 1.0 else 0
        if little == 2:
            break
    return fit, point


def two_at_once(setup: Setup, ranked: list, whole: float) -> list:
    """The row of the two effects of `ranked` that explain the release together, in a list, or none.

    A row is the share of the whole excess, the effect to be taken along, and the fit with both, whose first parameters
    are those of the law and of that effect: the one that spoils what is reconstructed, or that explains more alone. The
    other is left to be found.
    """
    rows = []
    for (_, a, *_), (_, b, *_) in combinations(ranked[:FEW], 2):
        first, other = (b, a) if b in MISLEADING and a not in MISLEADING else (a, b)
        fit, point = release_fit(setup, (first, other))
        rows.append((1 - excess(fit, point) / max(whole, 1e-9), first, fit, point))
        setup.log(f"  release: {first} and {other} explain {rows[-1][0]:.2f}")
    best = max(rows, key=lambda row: row[0], default=(0.0,))
    return [best] if best[0] > TOGETHER else []


def tone(fit: Fit, point: Point, low: float = 2.0, high: float = 60.0) -> tuple[float, float]:
    """Frequency [Hz] of the strongest tone in the residuals of the release, and its power against the median one.

    The power counts as far as it is as strong in the second half as in the first: a block that settles rings down.
    """
    r = fit.residual(point.z, point.corrections)
    frequencies = np.arange(low, high, 0.1)
    power, halves = np.zeros(len(frequencies)), np.zeros((2, len(frequencies)))
    for b in range(r.shape[0]):
        n = int(fit.series.length[b])
        t = np.arange(n) / fit.series.rate
        X = np.stack([((t - t.mean()) / t[-1]) ** k for k in range(6)], axis=1)
        y = r[b, :n] - X @ np.linalg.lstsq(X, r[b, :n], rcond=None)[0]
        for k, f in enumerate(frequencies):
            A = np.stack([np.cos(2 * np.pi * f * t), np.sin(2 * np.pi * f * t)], axis=1)
            A = A - X @ np.linalg.lstsq(X, A, rcond=None)[0]
            coefficient = np.linalg.lstsq(A, y, rcond=None)[0]
            power[k] += np.sum((A @ coefficient) ** 2)
            for j, part in enumerate((slice(None, n // 2), slice(n // 2, None))):
                halves[j, k] += np.sum((A[part] @ np.linalg.lstsq(A[part], y[part], rcond=None)[0]) ** 2)
    best = int(np.argmax(power))
    steady = 2 * halves[:, best].min() / max(halves[:, best].sum(), 1e-9)
    return float(frequencies[best]), float(steady * power[best] / max(np.median(power), 6.0 * r.shape[0]))


def suspects(setup: Setup) -> tuple[Setup, list[tuple[str, ...]], dict]:
    """Sets of effects with which the whole search is to be made, the plain baseline always among them.

    Returns the setup (with the frequency of a tone), the sets, and what was seen at release (for the report).
    """
    fit, point = release_fit(setup)
    seen: dict = {"loss": float(np.mean(2 * point.loss / fit.series.count)), "z": point.z}
    sets: list[tuple[str, ...]] = [()]
    had = {e.id for e in setup.base.active_effects()}
    if "gyro_saturation" not in had and (limit := flat_tops(setup.experiment, setup.runs)) is not None:
        seen["flat_top"] = limit
        sets.append(("gyro_saturation",))
        own, _ = setup.parameters(("gyro_saturation",))[len(seen["z"]) :]
        seen.setdefault("starts", {})["gyro_saturation",] = np.append(seen["z"], [1 / limit / own.spread, 0.0])
    best = (fit, point)
    if seen["loss"] > STRONG:
        whole = excess(fit, point)
        ranked = []
        worst = float(np.max(2 * point.loss / fit.series.count))
        sensors = [id for id in MISLEADING if id != "gyro_saturation" or "flat_top" not in seen]
        for id in (id for id in (*sensors, *(HOLDING if worst > HELD else SLIGHT)) if id not in had):
            other, trial = release_fit(setup, (id,))
            if worst <= HELD and id in SLIGHT and size_of(Family((id,), other, trial)) < LEAST_SIZE:
                continue
            share = 1 - excess(other, trial) / max(whole, 1e-9)
            ranked.append((share, id, other, trial))
            setup.log(f"  release: {id} explains {share:.2f}")
        ranked.sort(key=lambda row: -row[0])
        seen["release_shares"] = {id: share for share, id, _, _ in ranked}
        taken = [row for row in ranked[:2] if row[0] > EXPLAINED] or two_at_once(setup, ranked, whole)
        sets += [(id,) for _, id, _, _ in taken]
        starts = {(id,): trial.z[: len(setup.parameters((id,)))] for _, id, _, trial in taken}
        seen.setdefault("starts", {}).update(starts)
        best = taken[0][2:] if taken else best
    frequency, strength = tone(*best)
    seen |= {"tone_hz": frequency, "tone_strength": strength}
    setup.log(f"  release: strongest tone {frequency:.2f} Hz, {strength:.1f} times the median")
    if strength > TONE and "base_vibration" not in had:
        setup = replace(setup, frequency=frequency)
        other, trial = release_fit(setup, ("base_vibration",), iterations=12)
        share = 1 - excess(other, trial) / max(excess(fit, point), 1e-9)
        setup.log(f"  release: base_vibration explains {share:.2f}")
        if share > EXPLAINED:
            sets.append(("base_vibration",))
            seen.setdefault("starts", {})["base_vibration",] = trial.z
    if setup.experiment.baseline == setup.base.points == "four_points" and "foot_defects" not in had:
        sets.append(("foot_defects",))
        seen.setdefault("starts", {})["foot_defects",] = np.concatenate([seen["z"], typical_defects(setup)])
    return setup, sets, seen


def typical_defects(setup: Setup) -> np.ndarray:
    """The z at which `foot_defects` is typical: one size from its absence, up or down."""
    quantities = catalogue.find("foot_defects").quantities
    own = [p for p in setup.parameters(("foot_defects",)) if p.name.startswith("foot_defects.")]
    return np.array([(float(quantities[p.name.split(".")[1]].typical or 0.0) - p.centre) / p.spread for p in own])
