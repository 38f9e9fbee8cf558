"""Effects on the normal contact, each against a closed form of one bouncing mass."""

import math

import numpy as np
import pytest

from rockref.effects.contact.adhesion import Adhesion
from rockref.effects.contact.hertzian_contact import HertzianContact
from rockref.effects.contact.hunt_crossley_contact import HuntCrossleyContact
from rockref.effects.contact.hysteretic_contact import HystereticContact
from rockref.effects.contact.orientation_dependent_damping import OrientationDependentDamping
from rockref.effects.contact.uneven_foot_damping import UnevenFootDamping
from rockref.effects.contact.uneven_foot_stiffness import UnevenFootStiffness
from tests.unit.effects.bodies import H, ball, body, last, points_at, puck, walk

TOUCH = 1e-3  # height at which the ball touches


def bounce(effect, speed, h=H, **kwargs):
    """Speed after one bounce without gravity, and the time in contact [m/s, s]."""
    problem = ball([effect], g=0.0, x=(0, 0, TOUCH), v=(0, 0, -speed), h=h, **kwargs)
    contact = 0
    for state in walk(problem, 20000):
        if state.x[2] > TOUCH and state.v[2] > 0:
            return float(state.v[2]), contact * h
        contact += 1
    raise AssertionError("it never came back")


@pytest.mark.parametrize("exponent", [1.2, 1.5, 2.0])
def test_hertz_contact_lasts_as_hertz_says(exponent):
    """m v^2/2 = K x0^(1-p) d^(p+1)/(p+1) gives the depth; T = 2 d/v int_0^1 du/sqrt(1 - u^(p+1)), a gamma function."""
    K, x0, speed = 1e6, 2e-5, 0.05
    effect = HertzianContact(exponent, x0)
    rebound, duration = bounce(effect, speed, h=2e-6, K_N=K)
    q = exponent + 1
    depth = (q * speed**2 / 2 / (K * x0 ** (1 - exponent))) ** (1 / q)
    share = math.sqrt(math.pi) * math.gamma(1 + 1 / q) / math.gamma(0.5 + 1 / q)
    # The end of the contact is seen to a step of 2e-6 s in 6e-3 s.
    assert duration == pytest.approx(2 * depth / speed * share, rel=1e-3)
    # What the spring stores comes back; the step's own error is of second order.
    assert rebound == pytest.approx(speed, rel=1e-5)


def test_hunt_crossley_restitution():
    """m v dv/dxi = -K xi (1 + a v): v/a - ln(1 + a v)/a^2 is the same before and after."""
    a, speed = 3.0, 0.1
    rebound, _ = bounce(HuntCrossleyContact(a), speed)

    def same(v):
        return v / a - math.log1p(a * v) / a**2

    low, high = -speed, 0.0
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if same(middle) > same(speed) else (low, middle)
    # The way of the last step above the plate is not part of the bounce: 1e-6 m of 1e-4 m.
    assert rebound == pytest.approx(-low, rel=1e-4)
    assert rebound < speed


def test_a_tip_rebounds_as_with_a_damper_that_is_larger():
    """The mass stands on its point: P_2 is one all the while, and C (1 + a) is the law's own damper."""
    C, a, speed = 20.0, 1.5, 0.1
    with_effect = bounce(OrientationDependentDamping(a), speed, C_N=C)
    plain = bounce(OrientationDependentDamping(0.0), speed, C_N=C * (1 + a))
    # Forces of 100 N that are summed in another order, over a thousand steps.
    assert with_effect == pytest.approx(plain, rel=1e-12)
    assert with_effect[0] < 0.99 * bounce(OrientationDependentDamping(0.0), speed, C_N=C)[0]


@pytest.mark.parametrize("share", [0.0, 0.5, 1.0])
@pytest.mark.parametrize("speed", [0.02, 0.2])
def test_hysteretic_restitution_does_not_know_the_speed(speed, share):
    """Stored K d^2/2, given back K d^2/(1 + kappa) times 1/2 along a line, times 2/5 along the power 3/2."""
    kappa = 0.7
    rebound, _ = bounce(HystereticContact(kappa, curved_share=share), speed, h=2e-6)
    # The corner at the turning point costs a step: 2e-6 s in 3e-3 s.
    assert rebound == pytest.approx(speed * math.sqrt((1 - 0.2 * share) / (1 + kappa)), rel=1e-3)


@pytest.mark.parametrize("speed", [0.05, 0.0999, 0.1001, 0.2])
def test_adhesion_holds_what_is_slower_than_its_work(speed):
    """To leave takes force * range/2 = m 0.1^2/2; what is faster leaves with the rest, and gets it back at landing."""
    reach = 2e-4
    effect = Adhesion(2 * 0.5 * 0.1**2 / reach, reach)
    problem = ball([effect], g=0.0, K_N=1e6, x=(0, 0, TOUCH), v=(0, 0, speed), h=4e-6)
    state = last(problem, 2500)
    if speed < 0.1:
        assert state.x[2] < TOUCH + reach
    else:
        # The pull is stepped, not integrated: 4e-7 m of a range of 2e-4 m at this speed.
        assert state.v[2] == pytest.approx(math.sqrt(speed**2 - 0.1**2), abs=2e-4)


def test_uneven_feet_sink_as_their_springs_say():
    """A body on four unequal springs, started in the balance of the linear system, stays there."""
    effect = UnevenFootStiffness(0.5, 2.0, 1.25, 0.9)
    K = 1e6
    corners = np.array([(0.1, 0.1, 0), (-0.1, 0.1, 0), (-0.1, -0.1, 0), (0.1, -0.1, 0)])
    points = points_at(corners, K_N=K, C_N=500.0)
    block, scaled = effect.points(None, points)
    k = K * np.array([0.5, 2.0, 1.25, 0.9])
    # Depth d - y a + x b at the corners (x, y), for a sink d and small turns a, b about x, y: three equations.
    columns = np.stack([np.ones(4), -corners[:, 1], corners[:, 0]])
    d, a, b = np.linalg.solve((columns * k) @ columns.T, [9.81, 0, 0])
    Lambda = np.array([[1, 0, b], [0, 1, -a], [-b, a, 1]])
    problem = body(scaled, x=(0, 0, -d), J=(0.01, 0.01, 0.01), Lambda=Lambda)
    state = last(problem, 200)
    # Turns are first order: their squares, 1e-9, times the corner's 0.1 m move no corner by more than 1e-10 of 1e-5 m.
    assert np.abs(state.W).max() < 1e-6
    assert state.F[:, 2] == pytest.approx(k * (columns.T @ [d, a, b]), rel=1e-4)
    assert effect.points(None, points)[1].K_T == pytest.approx(points.K_T)


def test_uneven_damping_shortens_the_ringing():
    """Four equal dampers, scaled by four: a damped oscillator of four times the damping, in contact all the time."""
    K, C, scale, mass = 1e5, 20.0, 4.0, 1.0
    effect = UnevenFootDamping(scale, scale, scale, scale)
    problem = puck(mass=mass, K_N=K, C_N=C)
    _, points = effect.points(problem.block, problem.points)
    # Pushed so gently that the springs stay pressed.
    depth = mass * 9.81 / 4 / K
    push = 1e-2
    problem = problem.replace(points=points, start=problem.start.at_rest(problem.start.x, np.eye(3), 4, [0, 0, -push]))
    omega, delta = math.sqrt(4 * K / mass), 4 * C * scale / 2 / mass
    ringing = math.sqrt(omega**2 - delta**2)
    t = 200 * H
    moved = -push / ringing * math.exp(-delta * t) * math.sin(ringing * t)
    assert abs(moved) < depth
    state = last(problem, 200)
    assert state.x[2] - problem.start.x[2] == pytest.approx(moved, rel=1e-3)
