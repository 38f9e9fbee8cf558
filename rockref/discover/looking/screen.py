"""Every candidate by one step from where a family stands: what it promises, and what the step gains."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from rockref.discover.fit.beside import side_by_side
from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.search import Setup

#: Size, in typical sizes, at which a candidate's derivative is taken: large enough for laws that do not show at zero.
PROBE = 0.2
#: Gain that a candidate must promise of its own for its step to be tried (decided: three quarters of what an effect has
#: to gain).
PROMISING = 60.0
#: Shares of a step that are tried.
SHARES = (1.0, 0.4)


@dataclass
class Trial:
    """One candidate tried from the baseline: predicted gain of one Gauss-Newton step, the gain found, the point; how
    much of the prediction is the candidate's own, and where the whole step leads (G,)."""

    effects: tuple[str, ...]
    predicted: float
    gain: float
    fit: Fit
    point: Point
    own: float
    whole: np.ndarray


def with_priors(H: np.ndarray, g: np.ndarray, prior: np.ndarray, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """H (G, G) and g (G,) of the runs with the priors' part, and a trifle of damping."""
    return H + np.diag(1 / prior**2) + 1e-4 * np.diag(np.diag(H)), g + z / prior**2


def promise(fit: Fit, point: Point, r, Js, Jg, w) -> float:
    """What one Gauss-Newton step without any candidate promises to gain."""
    H, g, _ = fit.reduced(r, Js, [Jg], w, point.corrections)
    H, g = with_priors(H, g, fit.prior, point.z)
    return float(g @ np.linalg.solve(H, g) / 2)


def screen(fit: Fit, point: Point, kinds, setup: Setup, effects: tuple[str, ...] = ()) -> list[Trial]:
    """Every candidate by one Gauss-Newton step of everything (nuisances, corrections, candidate) from a fit's point."""
    z, c = point.z, point.corrections
    r = fit.residual(z, c)
    Js = fit.state_jacobian(z, c, r)
    Jg, w = fit.parameter_jacobian(z, c, r, Js), fit.weights(r)
    promised = promise(fit, point, r, Js, Jg, w)

    def tried(own: Setup, id: str) -> Trial:
        wide = own.fit(fit.series.twin(), (*effects, id))
        trial = stepped(wide, point, (*effects, id), (r, Js, Jg, w), promised)
        wide.series = fit.series  # what the twin has kept is not needed any more
        return trial

    trials = side_by_side(setup, tried, [kind.id for kind in kinds if kind.id not in effects])
    return sorted(trials, key=lambda t: (-t.gain, -t.own))


def own_columns(wide: Fit, point: Point, effect: str, r: np.ndarray, Js: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Where the last effect is absent beside a narrower family's point, z (G,), and the derivative of its parameters
    there, (B, own, M, 3); r: the residuals there."""
    G, own = len(point.z), len(wide.parameters) - len(point.z)
    wide.parameters = tuple(replace(p, step=PROBE) if p.name.startswith(effect + ".") else p for p in wide.parameters)
    wide.forget()
    z0 = np.concatenate([point.z, np.zeros(own)])
    return z0, wide.parameter_jacobian(z0, point.corrections, r, Js, only=range(G, G + own))


def stepped(wide: Fit, point: Point, effects: tuple[str, ...], linear: tuple, promised: float) -> Trial:
    """One candidate: its fit, the point of the narrower family and its residuals, Jacobians and weights.

    The step is only tried where it promises more than the narrower family's own, `promised`, and something.
    """
    r, Js, Jg, w = linear
    c = point.corrections
    z0, Jc = own_columns(wide, point, effects[-1], r, Js)
    H, g, (H_ss, H_sg, g_s, _) = wide.reduced(r, Js, [Jg, Jc], w, c)
    H, g = with_priors(H, g, wide.prior, z0)
    dz = np.clip(-np.linalg.solve(H, g), -3, 3)
    absent = Point(z0, c.copy(), point.loss.copy(), point.penalty)
    predicted = float(-(g @ dz) / 2)
    best = Trial(effects, predicted, 0.0, wide, absent, predicted - promised, np.minimum(z0 + dz, wide.most))
    for share in SHARES if best.own > PROMISING else ():
        dc = -np.linalg.solve(H_ss, (g_s + H_sg @ (share * dz))[..., None])[..., 0]
        dc = np.clip(dc, -4 * wide.state_prior, 4 * wide.state_prior)
        dc[wide.series.first] = 0
        z = np.minimum(z0 + share * dz, wide.most)
        trial, _ = wide.point(z, c + dc)
        kept, _ = wide.point(z, c)
        swap = kept.loss < trial.loss
        trial.corrections[swap], trial.loss[swap] = kept.corrections[swap], kept.loss[swap]
        gain = point.objective - trial.objective
        if gain > best.gain:
            best = replace(best, gain=gain, point=trial)
    return best
