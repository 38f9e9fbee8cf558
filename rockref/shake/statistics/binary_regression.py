"""Regression of 0/1 outcomes with Jeffreys' prior: finite where outcomes separate, by probit or logit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from rockref.model.errors import InputError
from rockref.shake.statistics.outcomes import outcomes

Link = Literal["probit", "logit"]


@dataclass(frozen=True)
class BinaryRegression:
    """P(fell) = H(design @ coefficients), H the normal or the logistic distribution function.

    coefficients : (k,);  covariance : (k, k), the inverse of the expected information
    penalised_log_likelihood : at the maximum [nat]
    """

    link: Link
    coefficients: np.ndarray
    covariance: np.ndarray
    penalised_log_likelihood: float

    def probability(self, design: np.ndarray) -> np.ndarray:
        """Return the probability (n,) of falling for the rows of a design matrix (n, k)."""
        return _forms(self.link)[0](np.asarray(design, float) @ self.coefficients)

    def interval(self, design: np.ndarray, confidence: float = 0.95) -> tuple[np.ndarray, np.ndarray]:
        """Return lower and upper probability (n,): normal interval of the linear predictor (Wald), then H."""
        from scipy.stats import norm

        rows = np.asarray(design, float)
        half = norm.ppf(0.5 + 0.5 * confidence) * np.sqrt(np.einsum("ij,jk,ik->i", rows, self.covariance, rows))
        middle, form = rows @ self.coefficients, _forms(self.link)[0]
        return form(middle - half), form(middle + half)


def fit_binary(design: Any, fell: Any, link: Link = "logit") -> BinaryRegression:
    """Fit by the largest penalised likelihood ln L + ln det(I)/2, I the expected information (Jeffreys' prior).

    Parameters
    ----------
    design : (n, k) matrix, with a column of ones where a constant is wanted
    fell : (n,) outcomes, 0 or 1
    link : ``"logit"`` or ``"probit"``

    Raises InputError E-SHAPE, E-RANGE, and E-RANK where columns depend on one another.

    Source: Firth, Biometrika 80 (1993), doi 10.1093/biomet/80.1.27; Heinze and Schemper, Statistics in Medicine 21
    (2002), doi 10.1002/sim.1047.
    """
    from scipy.optimize import minimize

    X, y = np.asarray(design, float), outcomes(fell)
    if X.ndim != 2 or len(X) != len(y):
        raise InputError("E-SHAPE", "design", f"has shape {X.shape}", f"Give one row for each of {len(y)} outcomes.")
    if not np.isfinite(X).all():
        raise InputError("E-RANGE", "design", "holds a number that is not finite", "Leave that test out.")
    if np.linalg.matrix_rank(X) < X.shape[1]:
        raise InputError("E-RANK", "design", "has columns that depend on one another", "Vary what the columns hold.")
    # Orthonormal columns: the search sees the same scales whatever the units are.
    Q, R = np.linalg.qr(X)
    scale = np.sqrt(len(X))
    Q *= scale
    found = minimize(
        lambda b: -penalised(Q, y, b, link),
        np.zeros(X.shape[1]),
        jac=lambda b: -penalised_slope(Q, y, b, link),
        method="BFGS",
    )
    coefficients = np.linalg.solve(R, found.x * scale)
    covariance = np.linalg.inv(_information(X, X @ coefficients, link))
    return BinaryRegression(link, coefficients, covariance, penalised(X, y, coefficients, link))


def penalised(X: np.ndarray, y: np.ndarray, coefficients: np.ndarray, link: Link) -> float:
    """Return ln L + ln det(I)/2 [nat] of outcomes y (n,) under a design X (n, k) and coefficients (k,)."""
    eta = X @ coefficients
    _, log_fell, log_stood = _forms(link)
    log_likelihood = np.sum(y * log_fell(eta) + (1.0 - y) * log_stood(eta))
    weight = _log_weight(eta, link)
    # The largest weight is taken out of the determinant, so that far tails do not underflow.
    largest = weight.max()
    scaled = (X * np.exp(weight - largest)[:, None]).T @ X
    return float(log_likelihood + 0.5 * (np.linalg.slogdet(scaled)[1] + X.shape[1] * largest))


def _information(X: np.ndarray, eta: np.ndarray, link: Link) -> np.ndarray:
    """Return expected information (k, k): sum of w x x', w = h(eta)^2/(H (1 - H)), h the density of H."""
    return (X * np.exp(_log_weight(eta, link))[:, None]).T @ X


def penalised_slope(X: np.ndarray, y: np.ndarray, coefficients: np.ndarray, link: Link) -> np.ndarray:
    """Return slope (k,) of the penalised likelihood: X' [d ln L/d eta + (leverage/2) d ln w/d eta], a row a test."""
    eta = X @ coefficients
    _, log_fell, log_stood = _forms(link)
    log_density = log_fell(eta) + log_stood(eta) if link == "logit" else -0.5 * eta**2 - 0.5 * np.log(2.0 * np.pi)
    up, down = np.exp(log_density - log_fell(eta)), np.exp(log_density - log_stood(eta))
    log_weight = _log_weight(eta, link)
    # Leverages do not change with the unit of the weights. From an orthonormal basis they are finite in far tails, too.
    basis = np.linalg.qr(X * np.exp(0.5 * (log_weight - log_weight.max()))[:, None])[0]
    leverage = np.sum(basis**2, axis=1)
    slope_of_weight = up - down if link == "logit" else -2.0 * eta - up + down
    return X.T @ (y * up - (1.0 - y) * down + 0.5 * leverage * slope_of_weight)


def _log_weight(eta: np.ndarray, link: Link) -> np.ndarray:
    _, log_fell, log_stood = _forms(link)
    if link == "logit":
        return log_fell(eta) + log_stood(eta)
    return -(eta**2) - np.log(2.0 * np.pi) - log_fell(eta) - log_stood(eta)


def _forms(link: Link) -> tuple[Callable, Callable, Callable]:
    """Return H, ln H and ln(1 - H) of a link. Raises InputError E-RANGE."""
    from scipy.special import expit, log_expit, log_ndtr, ndtr

    if link == "probit":
        return ndtr, log_ndtr, lambda eta: log_ndtr(-eta)
    if link == "logit":
        return expit, log_expit, lambda eta: log_expit(-eta)
    raise InputError("E-RANGE", "link", f"is {link!r}", "Give probit or logit.")
