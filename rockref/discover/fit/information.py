"""What each run says about the shared parameters: its normal equations, with window starts and own tilt eliminated."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rockref.discover.fit.least_squares import Fit, Point
from rockref.discover.fit.parameter import Parameter
from rockref.discover.windows.series import STATES


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
    Jg = fit.parameter_jacobian(z, c, r, Js)
    if extra is not None:
        assert z_extra is not None
        more = extra.parameter_jacobian(z_extra, c, r, Js, only=range(len(z), len(extra.parameters)))
        Jg = np.concatenate([Jg, more], axis=1)
    w = fit.weights(r) if weighted else np.ones_like(r)
    return by_run(fit, r, Js, Jg, w, c)


def by_run(fit: Fit, r, Js, Jg, w, c) -> Information:
    """The reduction of :meth:`Fit.reduced`, summed run by run: residuals (B, M, 3), Jacobians (B, ., M, 3), weights."""
    B, G = Jg.shape[:2]
    root = np.sqrt(w)[:, None]
    A, D = (Js * root).reshape(B, STATES, -1), (Jg * root).reshape(B, G, -1)
    e = (r[:, None] * root).reshape(B, 1, -1)
    H_ss = A @ A.swapaxes(1, 2) + np.einsum("bi,ij->bij", 1 / fit.state_prior**2, np.eye(STATES))
    g_s = (A @ e.swapaxes(1, 2))[..., 0] + c / fit.state_prior**2
    H_sg = A @ D.swapaxes(1, 2)
    K = np.linalg.solve(H_ss, H_sg)
    H_b = D @ D.swapaxes(1, 2) - H_sg.swapaxes(1, 2) @ K
    g_b = (D @ e.swapaxes(1, 2))[..., 0] - np.einsum("bsg,bs->bg", K, g_s)
    runs = fit.series.run_of
    H, g = np.zeros((fit.runs, G, G)), np.zeros((fit.runs, G))
    np.add.at(H, runs, H_b)
    np.add.at(g, runs, g_b)
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
