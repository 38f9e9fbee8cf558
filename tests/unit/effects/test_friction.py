"""Effects on friction, each against a closed form of a sliding puck, a spinning top or a rolling ball."""

import math
from dataclasses import dataclass

import numpy as np
import pytest

from rockref.effects.base import Effect
from rockref.effects.friction.load_dependent_friction import LoadDependentFriction
from rockref.effects.friction.rolling_resistance import RollingResistance
from rockref.effects.friction.spin_friction import SpinFriction
from rockref.effects.friction.stribeck_friction import StribeckFriction
from rockref.effects.friction.uneven_foot_friction import UnevenFootFriction
from rockref.effects.friction.viscous_friction import ViscousFriction
from rockref.effects.loads.plate_tilt import PlateTilt
from tests.unit.effects.bodies import H, body, last, points_at, puck, walk


@dataclass(frozen=True)
class PulledBySpring(Effect):
    """A spring along x whose far end moves at a constant speed; for these tests."""

    stiffness: float
    speed: float

    def is_absent(self):
        return False

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        F = np.zeros_like(x)
        F[..., 0] = self.stiffness * (self.speed * c.t - x[..., 0])
        return F, np.zeros_like(x)


def test_stick_slip_amplitude():
    """A mass that slips on a spring pulled at speed V swings about its kinetic balance; it begins and ends at rest, so
    the pull lies within mu m g -+ sqrt(D^2 + k m V^2), D = (rho - 1) mu m g."""
    mu, rho, stiffness, speed = 0.3, 1.5, 2e5, 4e-3
    problem = puck(
        [StribeckFriction(rho, 2e-5), PulledBySpring(stiffness, speed)], mu=mu, K_N=1e7, K_T=1e8, C_N=2e3, C_T=6e3
    )
    pull = np.array([stiffness * (speed * s.t - s.x[0]) for s in walk(problem, 1800)])
    swing = math.hypot((rho - 1) * mu * 9.81, math.sqrt(stiffness) * speed)
    top = int(np.argmax(pull))
    # Friction stays high below 2e-5 m/s, of a slip at 5e-3 m/s; the slip begins that much late.
    assert pull[top] == pytest.approx(mu * 9.81 + swing, abs=2e-2 * swing)
    assert pull[top:].min() == pytest.approx(mu * 9.81 - swing, abs=2e-2 * swing)


def test_viscous_friction_slows_exponentially():
    """Without Coulomb friction: v = v0 exp(-4 c t/m), for four feet."""
    c, speed = 5.0, 0.3
    state = last(puck([ViscousFriction(c)], mass=2.0, v=(speed, 0, 0)), 1000)
    # The damping force is stepped with second order: (4 c h/m)^2 = 1e-8.
    assert state.v[0] == pytest.approx(speed * math.exp(-4 * c * 1000 * H / 2.0), rel=1e-6)


@pytest.mark.parametrize("mass", [0.5, 4.0])
def test_load_dependent_friction_changes_with_the_mass(mass):
    """Deceleration mu (m g/4/F0)^(-p) g of a sliding puck."""
    p, F0, mu = 0.25, 2.5, 0.3
    problem = puck([LoadDependentFriction(p, F0)], mass=mass, mu=mu, v=(0.5, 0, 0), K_N=1e6, K_T=1e6)
    state = last(problem, 500)
    slide = mu * (mass * 9.81 / 4 / F0) ** (-p) * 9.81
    # Friction needs a few steps to reach its cone: mu F_N/K_T/v = 7e-6 s of 5e-3 s.
    assert 0.5 - state.v[0] == pytest.approx(slide * 500 * H, rel=3e-3)


def test_a_spinning_body_is_stopped_by_spin_friction():
    """J domega/dt = -r mu m g: it stops after J W/(r mu m g) and turns J W^2/(2 r mu m g)."""
    radius, mu, mass, J, spin = 2e-3, 0.4, 1.0, 2e-5, 2.0
    top = points_at([(0, 0, 0)], K_N=1e5, K_T=1e8, C_N=300.0, C_T=2e4, mu=mu)
    moment = radius * mu * mass * 9.81
    problem = body(
        top, [SpinFriction(radius)], mass=mass, J=(1.0, 1.0, J), W=(0, 0, spin), x=(0, 0, -mass * 9.81 / 1e5)
    )
    stop = J * spin / moment
    spins = np.array([s.W[2] for s in walk(problem, int(1.5 * stop / H))])
    # The spring holds within r mu m g/(K_T r^2) = 2e-5 rad, which takes 1e-5 s of 5e-3 s.
    half = int(stop / 2 / H)
    assert spins[half] == pytest.approx(spin / 2, rel=1e-2)
    assert np.trapezoid(spins, dx=H) == pytest.approx(J * spin**2 / 2 / moment, rel=1e-2)
    # It stays stopped, but for the last ringing of that spring.
    assert np.abs(spins[-1]) < 1e-3 * spin


def test_sliding_wears_a_spin_away_by_a_power_of_its_speed():
    """While r omega << v: J domega/dt = -r^2 mu m g omega/v and dv/dt = -mu g, so omega goes with v^(m r^2/J)."""
    radius, mu, mass, J, speed, spin = 2e-3, 0.4, 1.0, 4e-7, 0.5, 2.0
    foot = points_at([(0, 0, 0)], K_N=1e5, K_T=1e8, C_N=300.0, C_T=2e4, mu=mu)
    problem = body(
        foot,
        [SpinFriction(radius, sliding_share=1.0)],
        mass=mass,
        J=(1.0, 1.0, J),
        v=(speed, 0, 0),
        W=(0, 0, spin),
        x=(0, 0, -mass * 9.81 / 1e5),
    )
    state = last(problem, round(0.03 / H))
    assert state.v[0] == pytest.approx(speed - mu * 9.81 * 0.03, rel=1e-3)
    # r omega/v is 1e-2 at most, and counts by half its square.
    assert state.W[2] / spin == pytest.approx((state.v[0] / speed) ** (mass * radius**2 / J), rel=2e-3)


def rolling_ball(lever, slope, radius=0.05, mass=1.0, mu=0.5):
    """A ball on a slope toward x, at rest, in balance with its weight."""
    ball_points = points_at([(0, 0, -radius)], K_N=1e7, K_T=1e7, C_N=500.0, C_T=500.0, mu=mu, radius=radius)
    J = 0.4 * mass * radius**2
    effects = [RollingResistance(lever), PlateTilt(slope, 0.0)]
    return body(ball_points, effects, mass=mass, J=(J, J, J), x=(0, 0, radius - mass * 9.81 / 1e7))


@pytest.mark.parametrize("lever", [0.0, 5e-4])
def test_a_ball_rolls_down_a_slope(lever):
    """a = 5/7 g (slope - lever/R): five sevenths for the ball that must turn, less the shift of the pressure."""
    slope, radius = 0.05, 0.05
    states = list(walk(rolling_ball(lever, slope, radius), 2000))
    expected = 5 / 7 * 9.81 * (slope - lever / radius)
    # Counted from 5 ms on: before, the spring gives way by F_N/(K_N ARM) = 2e-5 rad until it holds. The vertical spring
    # rings on a little: a part in a thousand.
    assert states[-1].v[0] - states[500].v[0] == pytest.approx(expected * 1500 * H, rel=1e-3)
    assert states[-1].W[1] * radius == pytest.approx(states[-1].v[0], rel=1e-3)


def test_a_ball_stays_on_a_slope_that_is_too_gentle():
    """slope < lever/R: held by the spring, within the angle at which it carries m g slope R."""
    lever, slope, radius = 5e-4, 0.005, 0.05
    problem = rolling_ball(lever, slope, radius)
    furthest = max(abs(s.x[0]) for s in walk(problem, 1500))
    held = 9.81 * slope * radius / (1e7 * lever * 0.05)
    # Put on the slope at once, it swings to twice the angle of rest at most.
    assert 0.5 * held * radius < furthest < 2.2 * held * radius


def test_uneven_friction_turns_a_sliding_puck():
    """Feet 1 and 4 (x > 0) rough, 2 and 3 smooth: sliding along y, half the spread times mu m g a turns it about z."""
    mu, mass, J, arm = 0.3, 1.0, 0.02, 0.1
    effect = UnevenFootFriction(1.5, 0.5, 0.5, 1.5)
    problem = puck(mass=mass, mu=mu, v=(0, 0.5, 0), J=(1e3, 1e3, J))
    problem = problem.replace(points=effect.points(None, problem.points)[1])
    state = last(problem, 300)
    assert state.W[2] * J == pytest.approx(-(1.5 - 0.5) / 2 * mu * mass * 9.81 * arm * 300 * H, rel=1e-2)
    assert 0.5 - state.v[1] == pytest.approx(mu * 9.81 * 300 * H, rel=1e-2)
