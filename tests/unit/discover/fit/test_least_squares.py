"""The reduced normal equations held to the whole ones, on a small made-up problem."""

from types import SimpleNamespace

import numpy as np
import pytest

from rockref.discover.fit.information import by_run, eliminated
from rockref.discover.fit.least_squares import CAP, CAUCHY, Fit
from rockref.discover.hypotheses.counted import Parameter
from rockref.discover.windows.series import STATES

B, G, M = 6, 4, 5


def whole_rows(which=None, beyond=0):
    """As if all windows were as long as the longest."""
    return [(slice(None), None)]


def two_lengths(which=None, beyond=0):
    """As if the second to fourth window were short."""
    return [(slice(0, 1), M), (slice(1, 4), min(M, 2 + beyond)), (slice(4, B), M)]


@pytest.fixture
def problem():
    """A Fit without simulator, with residuals, Jacobians and weights of its own."""
    rng = np.random.default_rng(3)
    fit = object.__new__(Fit)
    fit.series = SimpleNamespace(
        B=B, run_of=np.array([0, 0, 1, 1, 2, 2]), count=np.full(B, 3 * M), workers=1, pieces=whole_rows
    )
    fit.averaged = 1
    fit.runs = 3
    fit.state_prior = rng.uniform(0.5, 2.0, (B, STATES))
    r, Js, Jg = rng.normal(size=(B, M, 3)), rng.normal(size=(B, STATES, M, 3)), rng.normal(size=(B, G, M, 3))
    w, c = rng.uniform(0.2, 1.0, (B, M, 3)), 0.1 * rng.normal(size=(B, STATES))
    return fit, r, Js, Jg, w, c


def dense(fit, r, Js, Jg, w, c):
    """Hessian and gradient of half the weighted squares and the priors, all corrections and parameters together."""
    J = np.zeros((B * M * 3, B * STATES + G))
    for b in range(B):
        rows = slice(b * M * 3, (b + 1) * M * 3)
        J[rows, b * STATES : (b + 1) * STATES] = Js[b].reshape(STATES, -1).T
        J[rows, B * STATES :] = Jg[b].reshape(G, -1).T
    W = w.ravel()
    prior = np.concatenate([(1 / fit.state_prior**2).ravel(), np.zeros(G)])
    H = J.T @ (W[:, None] * J) + np.diag(prior)
    g = J.T @ (W * r.ravel()) + prior * np.concatenate([c.ravel(), np.zeros(G)])
    return H, g


def test_reduced_step_is_the_step_of_everything(problem):
    fit, r, Js, Jg, w, c = problem
    H, g = dense(*problem)
    step = -np.linalg.solve(H, g)
    h, k, (H_ss, H_sg, g_s, _) = fit.reduced(r, Js, [Jg], w, c)
    dz = -np.linalg.solve(h, k)
    dc = -np.linalg.solve(H_ss, (g_s + H_sg @ dz)[..., None])[..., 0]
    # Both solve the same linear system; it is well conditioned.
    np.testing.assert_allclose(dz, step[B * STATES :], rtol=1e-9)
    np.testing.assert_allclose(dc.ravel(), step[: B * STATES], rtol=1e-8, atol=1e-12)


def test_uncertainty_of_parameters_includes_that_of_the_starts(problem):
    fit, r, Js, Jg, w, c = problem
    H, _ = dense(*problem)
    h, _, _ = fit.reduced(r, Js, [Jg], w, c)
    np.testing.assert_allclose(np.linalg.inv(h), np.linalg.inv(H)[B * STATES :, B * STATES :], rtol=1e-9)


def test_runs_add_up_to_the_whole(problem):
    fit, r, Js, Jg, w, c = problem
    h, k, _ = fit.reduced(r, Js, [Jg], w, c)
    found = by_run(fit, r, Js, [Jg], w, c)
    assert found.H.shape == (3, G, G)
    np.testing.assert_allclose(found.total, h, rtol=1e-10, atol=1e-12)
    np.testing.assert_allclose(found.g.sum(axis=0), k, rtol=1e-10, atol=1e-12)


def test_eliminating_a_parameter_leaves_the_step_of_the_others(problem):
    fit, r, Js, Jg, w, c = problem
    h, k, _ = fit.reduced(r, Js, [Jg], w, c)
    out, prior = np.array([False, True, False, False]), np.array([np.inf, 0.5, np.inf, np.inf])
    H, g = eliminated(h, k, out, prior)
    whole = np.linalg.solve(h + np.diag(1 / prior**2), k)
    np.testing.assert_allclose(np.linalg.solve(H, g), whole[~out], rtol=1e-9)


def test_weights_are_the_slope_of_the_loss(problem):
    fit = problem[0]
    rng = np.random.default_rng(1)
    # One window like noise, one far off (beyond the cap): both must be descended along the right slope.
    r = rng.normal(size=(B, M, 3)) * np.array([1, 1, 1, 30, 30, 30])[:, None, None]
    d = rng.normal(size=r.shape)
    mean = 2 * fit.window_loss(r) / fit.series.count
    assert mean[:3].max() < CAP < mean[3:].min()
    e = 1e-6
    slope = (fit.window_loss(r + e * d) - fit.window_loss(r - e * d)) / (2 * e)
    np.testing.assert_allclose(np.sum(fit.weights(r) * r * d, axis=(1, 2)), slope, rtol=1e-5)


def test_parameter_values():
    log = Parameter("a", None, 2.0, 0.5, log=True)
    assert log.value(0.0) == 2.0 and log.value(2.0) == pytest.approx(2.0 * np.e)
    bounded = Parameter("b", None, 0.0, 3.0, low=0.0)
    assert bounded.value(-1.0) == 0.0 and bounded.value(1.0) == 3.0


def test_parameters_of_runs_are_moved_together_and_kept_apart():
    """One evaluation gives the columns of a parameter that each run has of its own."""
    fit = object.__new__(Fit)
    fit.series = SimpleNamespace(run_of=np.array([0, 0, 1, 2]), workers=1, pieces=whole_rows)
    slopes = np.random.default_rng(0).normal(size=(5, 4, M, 3))
    make = dict(set=lambda model, value: model, centre=0.0, spread=1.0)
    fit.parameters = (
        Parameter("K_N", **make), Parameter("mu", **make),
        *(Parameter(f"tilt_offset[{i}]", run=i, step=0.01, **make) for i in range(3)),
    )  # fmt: skip
    calls = []

    def residual(z, corrections):
        calls.append(z)
        mine = np.ones((5, 4))
        for i in range(3):
            mine[2 + i] = fit.series.run_of == i
        return np.einsum("j,jb,jbmk->bmk", z, mine, slopes)

    fit.residual = residual
    z = np.zeros(5)
    J = fit.parameter_jacobian(z, None, residual(z, None), None)
    assert len(calls) == 1 + 3  # the start, two shared parameters, one group
    for j in range(5):
        mine = np.ones(4, bool) if j < 2 else fit.series.run_of == j - 2
        # A linear model: forward differences are exact but for rounding.
        np.testing.assert_allclose(J[mine, j], slopes[j][mine], rtol=1e-9)
        assert np.all(J[~mine, j] == 0)


def test_a_derivative_is_taken_away_from_an_upper_bound():
    """A share of 1 shows nothing of more than 1; less of it shows what it does."""
    share = Parameter("gyro_saturation.softness", None, 0.0, 1.0, low=0.0, high=1.0)
    factor = Parameter("uneven_foot_friction.foot1", None, 2.0, 0.5, log=True, high=4.0)
    assert share.most == 1.0 and factor.value(factor.most) == pytest.approx(4.0, rel=1e-15)
    assert Parameter("K_N", None, 6e7, 0.15, log=True).most == np.inf
    assert [share.step_from(z) for z in (0.0, 0.95, 0.96, 1.0)] == [0.05, 0.05, -0.05, -0.05]
    fit = object.__new__(Fit)
    fit.series = SimpleNamespace(run_of=np.zeros(1, int), workers=1, pieces=whole_rows)
    fit.parameters = (share,)
    fit.residual = lambda z, corrections: np.full((1, M, 3), share.value(z[0]) ** 2)
    for z, slope in ((0.0, 0.05), (1.0, 1.95)):
        z = np.array([z])
        J = fit.parameter_jacobian(z, None, fit.residual(z, None), None)
        np.testing.assert_allclose(J, slope, rtol=1e-12)


def test_what_adds_up_is_seen_from_the_starts_that_there_were():
    """A drift that only moves the starts: its column is theirs, however the residual bends meanwhile."""
    fit, rng = object.__new__(Fit), np.random.default_rng(1)
    Js, moves = rng.normal(size=(3, STATES, M, 3)), rng.normal(size=(3, STATES))
    begun = np.tile(np.eye(3), (3, 1, 1))

    def starts(z):
        tilt, roll, *rates = 1e-4 * z[0] * moves.T
        turns = np.stack([np.stack(row, -1) for row in ((0 * roll, 0 * roll, roll), (0 * roll, 0 * roll, -tilt))], 1)
        Lambda = begun.copy()
        Lambda[:, :2] += turns
        Lambda[:, 2, 0], Lambda[:, 2, 1] = -roll, tilt
        return Lambda, np.stack(rates, 1)

    def residual(z, corrections):
        _, rates = starts(z)
        tilt_roll = 1e-4 * z[0] * moves[:, :2]
        whole = corrections + np.concatenate([tilt_roll, rates], axis=1)
        return np.einsum("bi,bimk->bmk", whole + 1e6 * whole**3, Js)

    first = np.array([False, False, True])
    fit.series = SimpleNamespace(run_of=np.zeros(3, int), workers=1, starts=starts, first=first, pieces=whole_rows)
    fit.models, fit.residual = lambda z: (z,), residual
    fit.parameters = (Parameter("gyro_drift.bias_x", None, 0.0, 1.0, step=1.0),)
    J = fit.parameter_jacobian(np.zeros(1), np.zeros((3, STATES)), residual(np.zeros(1), np.zeros((3, STATES))), Js)
    # The bent part, 1e6 of the cube of 1e-4 and a little more, would be a hundredth and more; here rounding is left.
    np.testing.assert_allclose(J[~first, 0], 1e-4 * np.einsum("bi,bimk->bmk", moves, Js)[~first], atol=1e-16)
    plain = residual(np.ones(1), np.zeros((3, STATES)))
    np.testing.assert_allclose(J[first, 0], plain[first], atol=1e-16)


def test_the_loss_is_that_of_the_samples_that_are_there(problem):
    """Zeros behind a shorter window cost nothing, and are not looked at."""
    fit, r, *_ = problem
    r[1:4, 2:] = 0
    r[1, :2] = 100.0  # far above CAP: its weights are scaled down
    whole, weights = CAUCHY**2 / 2 * np.sum(np.log1p((r / CAUCHY) ** 2), axis=(1, 2)), fit.weights(r)
    fit.series.pieces = two_lengths
    # Rounding of sums of at most fifteen terms.
    np.testing.assert_allclose(fit.cauchy(r), whole, rtol=1e-14)
    there = np.ones((B, M), bool)
    there[1:4, 2:] = False
    np.testing.assert_allclose(fit.weights(r)[there], weights[there], rtol=1e-14)
    assert weights[1, 0].max() < 0.5 / (1 + (100.0 / CAUCHY) ** 2)
    # An average reaches beyond the samples that count, and counts there.
    fit.averaged, r[1, 2:4] = 2, 1.0
    assert fit.cauchy(r)[1] > whole[1]
    np.testing.assert_allclose(np.delete(fit.cauchy(r), 1), np.delete(whole, 1), rtol=1e-14)


def test_what_short_windows_lack_to_the_longest_changes_no_equation(problem):
    fit, r, Js, Jg, w, c = problem
    for a in (r[1:4, 2:], Js[1:4, :, 2:], Jg[1:4, :, 2:]):
        a[:] = 0
    whole = fit.by_window(r, Js, [Jg], w, c)
    fit.series.pieces = two_lengths
    H, g, (H_ss, H_sg, g_s, K) = fit.by_window(r, Js, [Jg[:, :1], Jg[:, 1:]], w, c)
    # Sums of at most 15 products each, in another order.
    for there, then in zip((H, g, H_ss, H_sg, g_s, K), (whole[0], whole[1], *whole[2]), strict=True):
        np.testing.assert_allclose(there, then, rtol=1e-11, atol=1e-13)


def test_what_all_runs_share_is_set_once_and_before_what_is_their_own():
    asked = []

    def setter(name):
        def set_value(model, value):
            asked.append(name)
            return SimpleNamespace(origin=model.origin | {name: value})

        return set_value

    tilts = (Parameter(f"tilt_offset[{i}]", setter("tilt_offset"), 0.0, 0.1, run=i) for i in range(2))
    parameters = (Parameter("K_N", setter("K_N"), 0.0, 1.0), *tilts, Parameter("mu", setter("mu"), 0.0, 1.0))
    fit = object.__new__(Fit)
    fit.base, fit.runs, fit.parameters = SimpleNamespace(origin={}), 2, parameters
    fit.stated, fit._last = np.array([0.1, 0.2]), None
    models, tilt = fit.models(np.array([1.0, 2.0, 3.0, 4.0]))
    assert asked == ["K_N", "mu", "tilt_offset", "tilt_offset"]
    assert [m.origin for m in models] == [{"K_N": 1.0, "mu": 4.0, "tilt_offset": x} for x in (0.2, 0.1 * 3.0)]
    assert tilt == pytest.approx([0.3, 0.5])
