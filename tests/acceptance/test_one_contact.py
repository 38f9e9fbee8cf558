"""One contact point against closed forms: bounce, slide, tangential spring, stick and slip on an incline."""

import numpy as np
import pytest

import rockref
from rockref.model.problem import stack
from tests import physics

MASS, G = physics.MASS, 9.81
STEPS = (2e-5, 1e-5, 5e-6)


def order(errors):
    """Mean order of convergence over the halvings of the step."""
    errors = np.abs(errors)
    return np.log2(errors[0] / errors[-1]) / (len(errors) - 1)


# --- normal: the Kelvin-Voigt bounce


def bounce(beta, K, v_0):
    """Duration of the contact [s] and coefficient of restitution, without gravity, contact over when the force is zero.

    Source: T. Schwager, T. Poeschel (2007), Coefficient of restitution and linear-dashpot model revisited, Granular
    Matter 9:465-469, doi:10.1007/s10035-007-0065-z: there the no-tension cut is the end of the contact, as in (3.5a).
    Written with sin(phi) = beta: the force vanishes at the phase pi - 2 phi.
    """
    omega = np.sqrt(K / MASS)
    damped = omega * np.sqrt(1 - beta * beta)
    duration = (np.pi - 2 * np.arcsin(beta)) / damped
    return duration, np.exp(-beta * omega * duration)


def bounced(betas, step, v_0=0.1, K=6e7):
    """End of the contact [s], restitution, and forces of bounces with these damping ratios, side by side."""
    problems = []
    for beta in betas:
        C = 2 * beta * np.sqrt(K * MASS)
        foot = dict(K_N=K, C_N=C, mu_0=0.0, step=step, duration=0.004)
        problems.append(physics.mass_on_a_foot(v=(0, 0, -v_0), g=0.0, **foot))
    response = rockref.simulate(stack(problems), engine="numpy")
    F = response.F[..., 0, 2]
    ends = []
    for force in F:
        last = np.flatnonzero(force > 0)[-1]
        # the force falls to zero along a line: from its last two rows
        ends.append(response.t[last] + force[last] / (force[last - 1] - force[last]) * step)
    return np.array(ends), response.v[:, -1, 2] / v_0, F


@pytest.mark.parametrize("beta", [0.02, 0.15, 0.18, 0.6])
def test_bounce(beta):
    """Of order two, though the contact ends anywhere within a step; eight neighbouring damping ratios vary where."""
    betas = beta * np.linspace(1, 1.05, 8)
    duration, restitution = bounce(betas, 6e7, 0.1)
    for step in STEPS:
        end, ratio, F = bounced(betas, step)
        assert np.all(F >= 0)
        # Measured: at most 0.29 and 0.13 of the squared phase of a step, at every step: that is order two. What the
        # last, cut step adds is between 0 and 1/8 of it.
        phase = np.sqrt(6e7 / MASS) * step
        assert np.max(np.abs(end / duration - 1)) < 0.35 * phase**2
        assert np.max(np.abs(ratio - restitution)) < 0.15 * phase**2


def test_without_the_cut_the_bounce_would_end_slower():
    """What the no-tension cut is worth: exp(-pi beta / sqrt(1 - beta^2)) with tension, against the closed form."""
    beta = 0.18
    _, cut = bounce(beta, 6e7, 0.1)
    with_tension = np.exp(-np.pi * beta / np.sqrt(1 - beta * beta))
    assert cut / with_tension == pytest.approx(1.068, abs=1e-3)
    assert bounced([beta], 1e-5)[1] == pytest.approx([cut], rel=1e-4)


def test_restitution_is_the_same_at_every_speed():
    """A linear contact: the same number of steps, the same ratio."""
    slow, fast = bounced([0.18], 1e-5, v_0=0.01)[1], bounced([0.18], 1e-5, v_0=1.0)[1]
    # scaling by 100 rounds, 300 steps
    assert slow == pytest.approx(fast, rel=1e-12)


def test_settles_where_the_spring_carries_the_weight():
    problem = physics.mass_on_a_foot(v=(0, 0, -0.01), K_N=6e7, C_N=2e4, duration=0.2)
    response = rockref.simulate(problem, engine="numba")
    # e-folding in 2 m / C = 5.4 ms: 37 of them
    assert response.x[-1, 2] == pytest.approx(physics.resting(), rel=1e-12)


# --- tangential: spring and slider. A hundred times softer than the block's feet, so that steps of 1e-4 s are fine.

K_T, C_T, H = 5e5, 1.8e3, 1e-4


def tangential(v, step=H, duration=0.2, mu_0=0.25, mu=None, effects=()):
    foot = dict(K_T=K_T, C_T=C_T, K_N=6e5, C_N=2e3, mu_0=mu_0, mu=mu)
    start = dict(z=physics.resting(K_N=6e5), v=(v, 0, 0))
    return rockref.simulate(
        physics.mass_on_a_foot(**start, **foot, step=step, duration=duration, effects=effects), engine="numpy"
    )


def damped(t, u_0, v_0):
    """Position of m x'' = -K_T x - C_T x' from u_0 and v_0."""
    omega, beta = np.sqrt(K_T / MASS), C_T / (2 * np.sqrt(K_T * MASS))
    damped = omega * np.sqrt(1 - beta**2)
    return np.exp(-beta * omega * t) * (
        u_0 * np.cos(damped * t) + (v_0 + beta * omega * u_0) / damped * np.sin(damped * t)
    )


def test_mass_on_the_tangential_spring():
    """Sticking all the time: a damped oscillator about the anchor, of order 2."""
    errors = []
    for step in (2e-4, 1e-4, 5e-5):
        response = tangential(1e-4, step=step, duration=0.1, mu_0=1e3)
        assert not response.sliding.any()
        u = damped(response.t, 0.0, 1e-4)
        errors.append(np.max(np.abs(response.x[:, 0] - u)) / np.max(np.abs(u)))
    # (omega h)^2 / 10 at omega = 96 rad/s
    assert errors[1] < 1e-4
    assert order(errors) == pytest.approx(2, abs=0.05)


def test_slide_stops_where_the_closed_form_says():
    """From 0.2 m/s: uniform deceleration, then the anchor holds and the mass swings on its damped spring.

    While it slides the force is mu N and the anchor moves along (T4). The next trial force is larger than mu N while
    K v > C mu g, so the slide ends at v_1 = C mu g / K; the spring is then stretched by (mu m g - C v_1) / K.
    """
    v_0, mu = 0.2, 0.25
    response = tangential(v_0)
    v_1 = C_T * mu * G / K_T
    t_1, u_1 = (v_0 - v_1) / (mu * G), (v_0**2 - v_1**2) / (2 * mu * G)
    stretch = (mu * MASS * G - C_T * v_1) / K_T
    slides = response.sliding[:, 0]
    end = response.t[np.flatnonzero(slides)[-1]]
    # a step, and the predicted velocity is one step ahead
    assert end == pytest.approx(t_1, abs=2 * H)
    during = response.t < t_1 - 2 * H
    assert np.all(slides[during])
    # on the cone, against the motion, from the first evaluation on
    assert response.F[during, 0, 0] == pytest.approx(-mu * MASS * G, rel=1e-12)
    expected = v_0 * response.t - mu * G * response.t**2 / 2
    # exact for a constant force, up to 800 roundings of 1e-18
    assert np.max(np.abs(response.x[during, 0] - expected[during])) < 1e-14
    after = u_1 - stretch + damped(response.t[~during] - t_1, stretch, v_1)
    # the end of the slide is a step off: mu g h in velocity, 2.5e-4 m/s, over omega = 96 rad/s
    assert np.max(np.abs(response.x[~during, 0] - after)) < 2.5e-4 / 96
    assert not slides[response.t > t_1 + 2 * H].any()
    # it comes to rest where the anchor is
    assert response.x[-1, 0] == pytest.approx(u_1 - stretch, abs=2.5e-4 / 96)


def incline(slope, mu_0, mu=None, v=0.0, duration=0.2):
    """A load slope * m g along the plate, as on an incline of tan = slope, normal force m g."""
    return tangential(v, duration=duration, mu_0=mu_0, mu=mu, effects=(physics.Pull(force=slope * MASS * G),))


def test_incline_below_the_friction_angle_holds():
    response = incline(0.15, 0.25, duration=0.6)
    # applied at once, the load overshoots to 1.58 of its static value (damping ratio 0.173): 0.237 m g, in the cone
    assert not response.sliding.any()
    # ten e-foldings, 5e-5
    assert response.x[-1, 0] == pytest.approx(0.15 * MASS * G / K_T, rel=2e-4)
    assert response.F[-1, 0, 0] == pytest.approx(-0.15 * MASS * G, rel=2e-4)


def test_incline_above_the_friction_angle_slides():
    response = incline(0.40, 0.25)
    late = response.t > 0.05
    assert response.sliding[late].all()
    acceleration = np.diff(response.v[late, 0]) / H
    # difference of velocities of 0.3 m/s rounded at 5e-17, over 1e-4 s
    assert acceleration == pytest.approx(np.full(len(acceleration), (0.40 - 0.25) * G), rel=1e-11)


@pytest.mark.parametrize("v, slides", [(0.0, False), (0.5, True)])
def test_incline_between_the_two_friction_angles_goes_on_as_it_was(v, slides):
    """mu = 0.2 < 0.25 < mu_0 = 0.5: what sticks goes on sticking, what slides goes on sliding (T6)."""
    response = incline(0.25, 0.5, mu=0.2, v=v, duration=0.1 if slides else 0.6)
    assert response.sliding.all() if slides else not response.sliding.any()
    if slides:
        # constant force from the start: the closed form to rounding
        assert response.v[-1, 0] == pytest.approx(0.5 + 0.1 * (0.25 - 0.2) * G, rel=1e-12)
    else:
        assert response.x[-1, 0] == pytest.approx(0.25 * MASS * G / K_T, rel=2e-4)


def test_stick_slip_on_an_incline():
    """A mass pulled up an incline by a spring whose end moves steadily: it sticks and jumps, in a closed-form rhythm.

    Spring k, end speed V, slope load p m g downhill, static and dynamic friction mu_0 and mu. It slips when the spring
    has (p + mu_0) m g; then y = V t - u - (p + mu) m g / k swings, from y_0 = (mu_0 - mu) m g / k with speed V, as
    y_0 cos + V/w sin, until u is as slow as v_1 = C mu g / K. It then sticks until y is y_0 again.
    """
    k, V, p, mu_0, mu = 2e3, 0.5, 0.1, 0.3, 0.2
    y_0, w, v_1 = (mu_0 - mu) * MASS * G / k, np.sqrt(k / MASS), C_T * mu * G / K_T
    amplitude, phase = np.hypot(w * y_0, V), np.arctan2(w * y_0, V)
    # speed of y: amplitude cos(w t + phase) = V - v_1, for the second time
    slip = (2 * np.pi - np.arccos((V - v_1) / amplitude) - phase) / w
    stick = (y_0 - amplitude / w * np.sin(w * slip + phase)) / V
    pull = physics.Pull(force=-p * MASS * G, stiffness=k, speed=V)
    response = tangential(0.0, duration=3.5, mu_0=mu_0, mu=mu, effects=(pull,), step=4e-4)
    sliding = response.sliding[:, 0].astype(int)
    begins, ends = np.flatnonzero(np.diff(sliding) == 1), np.flatnonzero(np.diff(sliding) == -1)
    # The foot's spring in series gives way by k/K_T = 0.4 %, and the mass quivers on it when a slide has stopped.
    assert response.t[begins[0]] == pytest.approx((p + mu_0) * MASS * G / (k * V), rel=5e-3)
    assert len(begins) >= 3
    assert response.t[ends[:2]] - response.t[begins[:2]] == pytest.approx([slip, slip], rel=5e-3)
    assert response.t[begins[1:3]] - response.t[ends[:2]] == pytest.approx([stick, stick], rel=2e-2)
    # each jump carries the mass by V times the period
    jumps = response.x[begins[1:3], 0] - response.x[begins[:2], 0]
    assert jumps == pytest.approx([V * (slip + stick)] * 2, rel=5e-3)
