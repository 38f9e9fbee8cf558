"""What the contact law has to be, whatever the point does."""

import mpmath
import numpy as np
from hypothesis import example, given, settings, target
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rockref.model import contact
from tests.strategies import ContactStates, between, contact_states

#: Rounding of a length, a quotient and a product: four units in the last place.
ROUNDING = 1 + 4 * np.finfo(float).eps


def friction(q: ContactStates):
    """Rules N1 to T4 for all points: F_N, F_T, the moved anchors, and which points slide."""
    F_N = contact.open_gap(q.xi, contact.kelvin_voigt(q.xi, q.xi_rate, q.K_N, q.C_N))
    s, touching = contact.touch(q.xi, q.u_t, q.s, q.anchored)
    F_trial = contact.trial_force(q.u_t, s, q.v_slide, q.K_T, q.C_T)
    size = contact.norm(F_trial)
    stick = contact.sticks(size, contact.threshold(F_N, q.sliding & touching, q.mu_0, q.mu))
    F_T = contact.radial_return(F_trial, size, stick, q.mu * F_N)
    return F_N, F_T, contact.move_anchor(F_T, q.u_t, s, q.v_slide, stick, q.K_T, q.C_T), stick, s, touching


@given(contact_states())
def test_normal_force_pushes_or_is_zero(q):
    F_N, *_ = friction(q)
    assert np.all(F_N >= 0)
    assert np.all(F_N[q.xi < 0] == 0)


@given(contact_states())
def test_friction_stays_in_its_cone(q):
    F_N, F_T, _, stick, _, touching = friction(q)
    limit = np.where(stick & ~(q.sliding & touching), q.mu_0, q.mu) * F_N
    size = contact.norm(F_T)
    assert np.all(size <= limit * ROUNDING)
    assert np.all(size[q.xi < 0] == 0)
    with np.errstate(invalid="ignore", divide="ignore"):
        target(float(np.nanmax(np.where(limit > 0, size / limit, 0))))


@given(contact_states())
def test_a_sliding_point_has_its_friction_force_on_the_cone_along_the_trial_force(q):
    F_N, F_T, _, stick, s, _ = friction(q)
    F_trial = contact.trial_force(q.u_t, s, q.v_slide, q.K_T, q.C_T)
    slides = ~stick
    assert np.all(np.abs(contact.norm(F_T) - q.mu * F_N)[slides] <= 4 * np.spacing(q.mu * F_N)[slides])
    # Directions, because products of a force of 1e-303 N with another underflow.
    pushes = slides & (contact.norm(F_T) > 0)
    there, wanted = (F[pushes] / contact.norm(F)[pushes, None] for F in (F_T, F_trial))
    # four roundings each of numbers up to one; where the force has lost digits to underflow, half of its last one
    rounding = 1e-15 + 5e-324 / contact.norm(F_T)[pushes]
    assert np.all(np.abs(there - wanted) <= rounding[:, None])


@given(contact_states())
def test_moved_anchor_carries_the_friction_force(q):
    """T4: -K (u - s) - C v = F_T, up to the rounding of positions of 0.1 m times the stiffness."""
    _, F_T, s, stick, _, touching = friction(q)
    carried = contact.trial_force(q.u_t, s, q.v_slide, q.K_T, q.C_T)
    rounding = 4 * (np.spacing(0.2) * q.K_T + np.spacing(1.0) * q.C_T + np.spacing(contact.norm(F_T)))
    assert np.all(np.abs(carried - F_T)[touching] <= rounding[touching, None])


@given(contact_states())
def test_the_anchor_gets_no_power(q):
    """-F_T . (change of the anchor) = mu F_N (|F*| - mu F_N) / K_T >= 0, in every step of every point."""
    _, F_T, s_after, stick, s_before, touching = friction(q)
    work = -np.sum(F_T * (s_after - s_before), axis=-1)
    rounding = contact.norm(F_T) * 4 * np.spacing(0.2)
    assert np.all((work >= -rounding)[touching])


planes = arrays(float, (1, 2), elements=between(-1e4, 1e4))


def returned(F, limit):
    size = contact.norm(F)
    return contact.radial_return(F, size, contact.sticks(size, np.array([limit])), np.array([limit]))


@given(planes, between(0, 5e3))
def test_radial_return_is_idempotent(F, limit):
    once = returned(F, limit)
    assert np.all(np.abs(returned(once, limit) - once) <= 2 * np.spacing(np.abs(once)))


@given(planes, planes, between(0, 5e3))
@example(np.array([[5e3, 0.0]]), np.array([[5e3, 1e-3]]), 1.0)
def test_radial_return_brings_no_two_forces_apart(F, G, limit):
    apart = contact.norm(returned(F, limit) - returned(G, limit))
    # three roundings of forces up to the limit
    assert np.all(apart <= contact.norm(F - G) + 8 * np.spacing(limit))


@given(planes, between(0, 5e3), between(0, 5e3))
def test_radial_return_grows_with_the_cone(F, a, b):
    small, large = sorted((a, b))
    assert contact.norm(returned(F, small)) <= contact.norm(returned(F, large)) * ROUNDING


def exact_length(F):
    with mpmath.workdps(60):
        return mpmath.sqrt(mpmath.mpf(float(F[0])) ** 2 + mpmath.mpf(float(F[1])) ** 2)


near_underflow = st.floats(-1e-160, 1e-160, allow_subnormal=True).filter(lambda x: abs(x) >= 1e-290 or x == 0)


@given(st.tuples(near_underflow, near_underflow))
@example((1e-170, 0.0))
@example((3e-170, 4e-170))
@example((1.1e-146, 1e-160))
def test_length_of_tiny_forces(F):
    """At 1e-170 N the squares vanish; the length must not, or an unloaded point would stick."""
    size, exact = float(contact.norm(np.array([F]))[0]), exact_length(F)
    # three roundings
    assert abs(mpmath.mpf(size) - exact) <= 4 * np.finfo(float).eps * exact
    assert (size == 0) == (F == (0.0, 0.0))


@given(arrays(float, (1, 2), elements=st.floats(-1e150, 1e150)))
def test_length_of_any_force(F):
    exact = exact_length(F[0])
    # where the result is subnormal, half of the smallest number
    assert abs(mpmath.mpf(float(contact.norm(F)[0])) - exact) <= 4 * np.finfo(float).eps * exact + 5e-324


@settings(max_examples=20)  # 400 steps each
@given(
    arrays(float, (3, 2, 2), elements=between(-1e-3, 1e-3)),
    between(10, 1e4),
    between(1e6, 1e8),
    between(0, 1e4),
    between(0.1, 1.0),
)
def test_friction_takes_power_over_a_closed_slip(waves, F_N, K_T, C_T, mu):
    """A loaded point is led round a closed curve; over the second round the force does no positive work on it.

    The first round brings anchor and spring into the state to which they come back. Without damper this is a theorem
    for every step length; with it, for smooth motion.
    """
    phase = np.linspace(0, 4 * np.pi, 401)
    orders = np.arange(1, 4)[:, None, None]
    angle = orders * phase[None, None, :]
    amplitudes = waves[..., None]
    u = np.sum(amplitudes[:, 0, :] * np.cos(angle) + amplitudes[:, 1, :] * np.sin(angle), axis=0).T
    period = 0.1
    v = np.sum(orders * (amplitudes[:, 1, :] * np.cos(angle) - amplitudes[:, 0, :] * np.sin(angle)), axis=0).T
    v = v * 2 * np.pi / period
    one = np.ones(1)
    s, anchored, sliding, forces = u[:1], np.array([False]), np.array([False]), []
    for at, speed in zip(u, v, strict=True):
        q = ContactStates(
            one * F_N / 6e7, 0 * one, at[None], speed[None], s, anchored, sliding,
            6e7 * one, 0 * one, K_T * one, C_T * one, mu * one, mu * one,
        )  # fmt: skip
        _, F_T, s, stick, _, anchored = friction(q)
        sliding = anchored & ~stick
        forces.append(F_T[0])
    forces = np.array(forces)
    work = np.sum(forces[201:] * np.diff(u, axis=0)[200:], axis=-1)
    # rounding of positions of 1e-3 m times the force, 200 times; the damper's lag of half a step
    assert np.sum(work) <= 1e-12 * mu * F_N + 1e-9 * np.sum(np.abs(work))
