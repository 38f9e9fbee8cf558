"""What each run says about the shared parameters: its normal equations, with window starts and own tilt eliminated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.hypotheses.counted import Parameter


@dataclass(frozen=True)
class Information:
    """Normal equations by run, without priors: H (R, G, G) and gradient g (R, G) of half the sum of squares, in z."""

    H: np.ndarray
    g: np.ndarray

    @property
    def total(self) -> np.ndarray:
        """Of all runs together, (G, G)."""
        return self.H.sum(axis=0)


def information(
    fit: Fit, point: Point, extra: Fit | None = None, z_extra: np.ndarray | None = None, weighted: bool = True
) -> Information:
    """Normal equations of each run at a point, the corrections of its windows eliminated.

    extra : a fit over the same windows whose first parameters are those of `fit`; its further ones are taken along,
    about z_extra. weighted : as the robust loss sees the residuals; without, every sample counts alike.
    """
    z, c = point.z, point.corrections
    r = fit.residual(z, c)
    Js = fit.state_jacobian(z, c, r)
    Jg = [fit.parameter_jacobian(z, c, r, Js)]
    if extra is not None:
        assert z_extra is not None
        Jg.append(extra.parameter_jacobian(z_extra, c, r, Js, only=range(len(z), len(extra.parameters))))
    w = fit.weights(r) if weighted else np.ones_like(r)
    return by_run(fit, r, Js, Jg, w, c)


def by_run(fit: Fit, r, Js, Jg, w, c) -> Information:
    """What the windows of each run add to the normal equations (:meth:`Fit.by_window`)."""
    H_b, g_b, _ = fit.by_window(r, Js, Jg, w, c)
    H, g = np.zeros((fit.runs, *H_b.shape[1:])), np.zeros((fit.runs, g_b.shape[1]))
    np.add.at(H, fit.series.run_of, H_b)
    np.add.at(g, fit.series.run_of, g_b)
    return Information(H, g)


def eliminated(H: np.ndarray, g: np.ndarray, out: np.ndarray, prior: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """H and g (G, G), (G,) with the parameters `out` (mask) eliminated, their priors (standard deviations) counted."""
    keep = ~out
    if not out.any():
        return H, g
    inner = H[np.ix_(out, out)] + np.diag(1 / prior[out] ** 2)
    K = np.linalg.solve(inner, H[np.ix_(out, keep)])
    return H[np.ix_(keep, keep)] - H[np.ix_(keep, out)] @ K, g[keep] - K.T @ g[out]


def own_parameters(parameters: tuple[Parameter, ...], run: int | None = None) -> np.ndarray:
    """Which parameters belong to one run (or to this run), as a mask."""
    return np.array([p.run is not None and run in (None, p.run) for p in parameters])


def covariance(fit: Fit, found: Information) -> np.ndarray:
    """Covariance (G, G) of z, priors included."""
    return np.linalg.inv(found.total + np.diag(1 / fit.prior**2))
