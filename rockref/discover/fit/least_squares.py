"""Least squares over windows: parameters shared by all runs, a release tilt per run, five corrections per window.

The corrections of a window touch only its own residuals, so they are eliminated from the normal equations (Schur
complement); a step costs one simulation per shared parameter and five for all corrections together.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np

from rockref.api import Model
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.threads import on_threads, threads_left
from rockref.discover.windows.reconstruct import moved_by
from rockref.discover.windows.series import STATES, Series, running_mean

Item = TypeVar("Item")

#: Scale of the Cauchy loss in noise sigmas; decided: an impact half a sample early is some tens of sigmas and must not
#: steer.
CAUCHY = 5.0
#: Mean loss of a window beyond which it counts only by its logarithm; decided: a window whose corner impacts come in
#: the wrong order cannot be mended by parameters.
CAP = 2.5
#: Finite-difference steps of the corrections: tilt, roll [rad]; rates [rad/s].
STATE_STEP = np.array([1e-5, 1e-5, 3e-4, 3e-4, 3e-4])
#: Error of the reconstructed rates [rad/s]; decided from the smoothing of 0.05 deg/s over 17 samples and its bias.
RATE_ERROR = 9e-4
#: Error of the reconstructed attitude [rad]: at the start, and its growth with the root of time (white noise of
#: 0.05 deg/s at 1 kHz integrates to 2.8e-5 rad after a second; decided with some room).
ATTITUDE_ERROR, ATTITUDE_GROWTH = 2.5e-5, 4e-5
#: What adds up to attitudes far beyond those errors (decided: half a typical drift was held in its place otherwise).
ADDING_UP = ("gyro_drift.",)
#: Rise of a window's loss, per sample value, that tells that a joint step threw it into another order of impacts.
THROWN = 0.03
#: Shares of a window on which its corrections are found one after the other; decided: some 25 ms at a time, the
#: distance of corner impacts.
GROWTH = (0.35, 0.7, 1.0)
#: Mean loss above which a window is structured: not explained (decided: 1 is noise).
STRUCTURED = 1.5
#: Mean loss above which a window's corrections are improved by themselves before each joint step (1 is noise).
ROUGH = 1.3


@dataclass
class Point:
    """Where a fit stands: z (G,), tilt offsets are among z; corrections (B, 5); loss per window (B,)."""

    z: np.ndarray
    corrections: np.ndarray
    loss: np.ndarray
    penalty: float = 0.0

    @property
    def objective(self) -> float:
        """What is minimised."""
        return float(self.loss.sum() + self.penalty)


def out_of_step(fit: Fit, point: Point) -> np.ndarray:
    """Which windows a fit leaves structured, (B,)."""
    return 2 * point.loss / fit.series.count > STRUCTURED


@dataclass
class Fit:
    """A model family over a series of windows; averaged : over how many samples residuals are averaged."""

    series: Series
    base: Model
    parameters: tuple[Parameter, ...]
    log: Callable[[str], None] = field(default=lambda line: None)
    averaged: int = 1

    def __post_init__(self):
        s = self.series
        self.runs = len(s.runs)
        spread = np.sqrt(ATTITUDE_ERROR**2 + ATTITUDE_GROWTH**2 * s.time)
        self.state_prior = np.stack([spread, spread, *[np.full(s.B, RATE_ERROR)] * 3], axis=1)
        self.prior = np.array([p.prior for p in self.parameters])
        self.most = np.array([p.most for p in self.parameters])
        self.stated = np.array([r.release_tilt for r in s.runs])
        self._last: tuple | None = None

    @property
    def name(self) -> str:
        """The effects that are fitted, or "baseline"."""
        return " + ".join(dict.fromkeys(p.name.split(".")[0] for p in self.parameters if "." in p.name)) or "baseline"

    def twin(self, log: Callable[[str], None]) -> Fit:
        """The same fit for another thread: what is kept from call to call is its own."""
        other = replace(self, series=self.series.twin(), log=log)
        other._last = self._last
        return other

    def on_twins(self, do: Callable[[Fit, Item], None], items: Sequence[Item]) -> None:
        """do(fit, item) for each item, on as many threads as are free, each thread with a twin of its own."""
        threads = threads_left(len(items), self.series.workers)

        def some(first: int) -> None:
            twin = self.twin(self.log)
            twin.series.workers = 1
            for item in items[first::threads]:
                do(twin, item)

        if threads < 2:
            for item in items:
                do(self, item)
        else:
            on_threads(some, range(threads), threads)

    def models(self, z: np.ndarray) -> tuple[list[Model], np.ndarray]:
        """One model a run, and the release tilts [rad]; the last ones are kept."""
        key = z.tobytes()
        if self._last is None or self._last[0] != key:
            self._last = (key, *self._models(z))
        return self._last[1], self._last[2]

    def forget(self) -> None:
        """After the parameters themselves were exchanged."""
        self._last = None

    def _models(self, z: np.ndarray) -> tuple[list[Model], np.ndarray]:
        models = [self.base] * self.runs
        # What all runs share comes first: it is set once, and not once a run.
        for p, zi in sorted(zip(self.parameters, z, strict=True), key=lambda own: own[0].run is not None):
            if p.run is None:
                changed = {id(m): p.set(m, p.value(zi)) for m in {id(m): m for m in models}.values()}
                models = [changed[id(m)] for m in models]
            else:
                models[p.run] = p.set(models[p.run], p.value(zi))
        offsets = np.array([m.origin.get("tilt_offset", 0.0) for m in models])
        return models, self.stated + offsets

    def residual(self, z: np.ndarray, corrections: np.ndarray, which=None, upto=None) -> np.ndarray:
        """Residuals of the windows `which` in sigmas, of their first `upto` samples (default all)."""
        models, tilt = self.models(z)
        r = self.series.residual(models, tilt, corrections, which, upto)
        for rows, n in self.pieces(which) if self.averaged > 1 else ():
            r[rows, :n] = running_mean(r[rows, :n], self.averaged)
        return r

    def pieces(self, which=None) -> list[tuple[slice, int]]:
        """Neighbours among the windows, and how many samples of them have residuals (averages reach further)."""
        return self.series.pieces(which, self.averaged if self.averaged > 1 else 0)

    def counts(self, which=None, upto=None) -> np.ndarray:
        """Sample values of each window that count."""
        if which is None:
            return self.series.count
        return self.series.count[which] if upto is None else self.series.counted(which, upto)

    def cauchy(self, r: np.ndarray, which=None) -> np.ndarray:
        """Cauchy loss of each window, summed over its samples."""
        total = np.empty(len(r))
        for rows, n in self.pieces(which):
            total[rows] = CAUCHY**2 / 2 * np.sum(np.log1p((r[rows, :n] / CAUCHY) ** 2), axis=(1, 2))
        return total

    def window_loss(self, r: np.ndarray, which=None, upto=None) -> np.ndarray:
        """Robust loss of each window, as half a sum of squares: Cauchy per sample, logarithm above CAP."""
        total = self.cauchy(r, which)
        count = self.counts(which, upto)
        mean = total / count * 2
        return np.where(mean <= CAP, total, count / 2 * CAP * (1 + np.log(np.maximum(mean, CAP) / CAP)))

    def weights(self, r: np.ndarray, which=None, upto=None) -> np.ndarray:
        """Weight of each squared residual for which Gauss and Newton see the robust loss, (B, M, 3)."""
        count = self.counts(which, upto)
        mean = self.cauchy(r, which) / count * 2
        capped, weights = np.where(mean <= CAP, 1.0, CAP / mean)[:, None, None], np.ones_like(r)
        for rows, n in self.pieces(which):
            weights[rows, :n] = capped[rows] / (1 + (r[rows, :n] / CAUCHY) ** 2)
        return weights

    def penalties(self, corrections: np.ndarray, which=None) -> np.ndarray:
        """Prior cost of the corrections of each window."""
        prior = self.state_prior if which is None else self.state_prior[which]
        return np.sum((corrections / prior) ** 2, axis=1) / 2

    def point(self, z: np.ndarray, corrections: np.ndarray) -> tuple[Point, np.ndarray]:
        """The point and its residuals."""
        r = self.residual(z, corrections)
        loss = self.window_loss(r) + self.penalties(corrections)
        return Point(z.copy(), corrections.copy(), loss, float(np.sum((z / self.prior) ** 2) / 2)), r

    def carried(self, point: Point) -> Point:
        """The same, with what lives on from window to window handed on."""
        models, tilt = self.models(point.z)
        if not self.series.carry(models, tilt, point.corrections):
            return point
        return self.point(point.z, point.corrections)[0]

    def begin(self) -> Point:
        """The centre of all priors."""
        return self.point(np.zeros(len(self.parameters)), np.zeros((self.series.B, STATES)))[0]

    def state_jacobian(self, z: np.ndarray, corrections: np.ndarray, r: np.ndarray, which=None, upto=None):
        """d residual / d corrections, (B, STATES, M, 3); the release windows have none."""
        J = np.zeros((len(r), STATES, *r.shape[1:]))
        pieces = self.pieces(which)

        def column(fit: Fit, j: int) -> None:
            moved = corrections.copy()
            moved[:, j] += STATE_STEP[j]
            there = fit.residual(z, moved, which, upto)
            for rows, n in pieces:
                J[rows, j, :n] = (there[rows, :n] - r[rows, :n]) / STATE_STEP[j]

        self.on_twins(column, range(STATES))
        J[self.series.first if which is None else self.series.first[which]] = 0
        return J

    def parameter_jacobian(self, z, corrections, r: np.ndarray, Js: np.ndarray, only=None) -> np.ndarray:
        """d residual / d z, (B, G, M, 3), by differences away from bounds (of the parameters `only`, if given).

        What belongs to one run moves only the windows of that run: such parameters of all runs are moved together.
        What is in ADDING_UP is seen with corrections that move the starts of the windows back to where they were. The
        way back is added by the derivatives of the corrections, Js (B, STATES, M, 3), which so make up for it exactly.
        """
        only = range(len(z)) if only is None else only
        adding_up = any(self.parameters[j].name.startswith(ADDING_UP) for j in only)
        begun = self.series.starts(*self.models(z)) if adding_up else None
        columns, pieces = np.zeros((len(only), *r.shape)), self.pieces()
        together: dict[str, list[int]] = {}
        for at, j in enumerate(only):
            p = self.parameters[j]
            together.setdefault(p.name if p.run is None else p.name.split("[")[0] + "[", []).append(at)

        def some(fit: Fit, group: list[int]) -> None:
            moved = z.copy()
            for at in group:
                moved[only[at]] += self.parameters[only[at]].step_from(z[only[at]])
            shift = None
            if begun is not None and self.parameters[only[group[0]]].name.startswith(ADDING_UP):
                shift = moved_by(begun, fit.series.starts(*fit.models(moved)))
                shift[self.series.first] = 0
            there = fit.residual(moved, corrections if shift is None else corrections - shift)
            for rows, n in pieces:
                change = there[rows, :n] - r[rows, :n]
                if shift is not None:
                    change += np.einsum("bi,bimk->bmk", shift[rows], Js[rows, :, :n])
                for at in group:
                    p = self.parameters[only[at]]
                    mine = 1 if p.run is None else (self.series.run_of[rows] == p.run)[:, None, None]
                    columns[at, rows, :n] = change * mine / p.step_from(z[only[at]])

        self.on_twins(some, list(together.values()))
        return columns.swapaxes(0, 1)

    def relax_states(self, point: Point, iterations: int = 2, which=None, damping: float = 1e-3, upto=None) -> Point:
        """Improve the corrections of each window by itself (Levenberg-Marquardt), parameters fixed.

        upto : samples of each window that count (default all).
        """
        which = np.arange(self.series.B) if which is None else which
        c = point.corrections[which].copy()
        lam = np.full(len(which), damping)
        r = self.residual(point.z, c, which, upto)
        loss = self.window_loss(r, which, upto) + self.penalties(c, which)
        for _ in range(iterations):
            J = self.state_jacobian(point.z, c, r, which, upto)
            w = self.weights(r, which, upto)
            Jw = J * w[:, None]
            H = np.einsum("bimk,bjmk->bij", Jw, J)
            g = np.einsum("bimk,bmk->bi", Jw, r) + c / self.state_prior[which] ** 2
            P = 1 / self.state_prior[which] ** 2
            A = H + np.einsum("bi,ij->bij", P, np.eye(STATES))
            A += lam[:, None, None] * np.einsum("bi,ij->bij", np.einsum("bii->bi", A), np.eye(STATES))
            new = c - np.linalg.solve(A, g[..., None])[..., 0]
            new[self.series.first[which]] = 0
            r_new = self.residual(point.z, new, which, upto)
            loss_new = self.window_loss(r_new, which, upto) + self.penalties(new, which)
            better = loss_new < loss
            c[better], loss[better], r[better] = new[better], loss_new[better], r_new[better]
            lam = np.where(better, lam / 5, lam * 10)
        out = Point(point.z, point.corrections.copy(), point.loss.copy(), point.penalty)
        out.corrections[which], out.loss[which] = c, loss
        return out

    def grow(self, point: Point, which: np.ndarray, rng: np.random.Generator | None = None) -> Point:
        """Find the corrections of windows anew, on their beginning first and then on more and more of them.

        A window that holds several corner impacts has many local minima; its first milliseconds have one. Kept where
        it ends better. With `rng` the search begins at a drawn start.
        """
        which = which[~self.series.first[which]]
        if not len(which):
            return point
        c = np.zeros((len(which), STATES)) if rng is None else rng.normal(size=(len(which), STATES))
        trial = Point(point.z, point.corrections.copy(), np.full(self.series.B, np.inf), point.penalty)
        trial.corrections[which] = c * self.state_prior[which]
        for share in GROWTH:
            upto = np.ceil(share * self.series.length[which]).astype(int) if share < 1 else None
            trial = self.relax_states(trial, 2, which, upto=upto)
        better = which[trial.loss[which] < point.loss[which]]
        point = Point(point.z, point.corrections.copy(), point.loss.copy(), point.penalty)
        point.corrections[better], point.loss[better] = trial.corrections[better], trial.loss[better]
        return point

    def normal_equations(self, point: Point):
        """Schur-reduced normal equations: H (G, G), gradient (G,), and what back-substitution needs."""
        z, c = point.z, point.corrections
        r = self.residual(z, c)
        Js = self.state_jacobian(z, c, r)
        Jg = self.parameter_jacobian(z, c, r, Js)
        w = self.weights(r)
        return self.reduced(r, Js, [Jg], w, c)

    def reduced(self, r, Js, Jg, w, c):
        """The reduction itself, from residuals, Jacobians and weights; Jg: the one of the parameters, in parts."""
        H, g, back = self.by_window(r, Js, Jg, w, c)
        return H.sum(axis=0), g.sum(axis=0), back

    def by_window(self, r, Js, Jg, w, c):
        """What each window adds to it: H (B, G, G), gradient (B, G), and what back-substitution needs."""
        ends = np.cumsum([STATES, *(part.shape[1] for part in Jg)])
        products = np.empty((len(r), ends[-1], ends[-1] + 1))
        for rows, n in self.pieces():
            J = np.concatenate([part[rows, :, :n] for part in (Js, *Jg, r[:, None])], axis=1)
            J = (J * np.sqrt(w[rows, None, :n])).reshape(len(J), ends[-1] + 1, -1)
            products[rows] = J[:, :-1] @ J.swapaxes(1, 2)
        s, g = slice(STATES), slice(STATES, ends[-1])
        H_ss = products[:, s, s] + np.einsum("bi,ij->bij", 1 / self.state_prior**2, np.eye(STATES))
        H_sg, g_s = products[:, s, g], products[:, s, -1] + c / self.state_prior**2
        K = np.linalg.solve(H_ss, H_sg)
        H = products[:, g, g] - H_sg.swapaxes(1, 2) @ K
        return H, products[:, g, -1] - np.einsum("bsg,bs->bg", K, g_s), (H_ss, H_sg, g_s, K)

    def step(self, point: Point, lam: float) -> tuple[Point, float]:
        """One damped Gauss-Newton step of everything; returns the better point and the next damping."""
        H, g, (H_ss, H_sg, g_s, _) = self.normal_equations(point)
        H = H + np.diag(1 / self.prior**2)
        g = g + point.z / self.prior**2
        for _ in range(4):
            A = H + lam * np.diag(np.diag(H))
            dz = -np.linalg.solve(A, g)
            dz = np.clip(dz, -1.5, 1.5)
            dc = -np.linalg.solve(H_ss, (g_s + H_sg @ dz)[..., None])[..., 0]
            dc = np.clip(dc, -4 * self.state_prior, 4 * self.state_prior)
            dc[self.series.first] = 0
            z = np.minimum(point.z + dz, self.most)
            trial, _ = self.point(z, point.corrections + dc)
            kept, _ = self.point(z, point.corrections)
            swap = kept.loss < trial.loss  # a window may keep its corrections where the joint step overshoots
            trial.corrections[swap], trial.loss[swap] = kept.corrections[swap], kept.loss[swap]
            thrown = np.flatnonzero((trial.loss - point.loss > THROWN * self.series.count) & ~self.series.first)
            if len(thrown):
                trial = self.relax_states(trial, 2, thrown)
                thrown = thrown[trial.loss[thrown] - point.loss[thrown] > THROWN * self.series.count[thrown]]
                trial = self.grow(trial, thrown)
            if trial.objective < point.objective:
                return trial, max(lam / 5, 1e-4)
            lam *= 10
        return point, lam

    def run(
        self,
        point: Point,
        iterations: int,
        rng: np.random.Generator,
        lam: float = 1e-2,
        tolerance: float = 2.0,
        relative: float = 0.0,
    ) -> Point:
        """Iterate until the objective falls by less than `tolerance`, or twice by less than the share `relative`."""
        little = 0
        for i in range(iterations):
            point = self.carried(point)
            before = point.objective
            rough = np.flatnonzero((2 * point.loss / self.series.count > ROUGH) & ~self.series.first)
            if len(rough):
                point = self.relax_states(point, 1, rough)
                if i % 2 == 0:
                    rough = rough[2 * point.loss[rough] / self.series.count[rough] > ROUGH]
                    point = self.grow(point, rough, rng if i % 4 else None)
            point, lam = self.step(point, lam)
            median = np.median(2 * point.loss / self.series.count)
            self.log(
                f"  {self.name} {i}: objective {point.objective:.0f} median {median:.3f} "
                f"bad {np.mean(out_of_step(self, point)):.3f} lam {lam:.1e}"
            )
            little = little + 1 if before - point.objective < relative * before else 0
            if before - point.objective < tolerance or lam > 1e4 or little == 2:
                break
        return point
