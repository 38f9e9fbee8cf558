"""Loads, support and release, each against a closed form."""

import math

import numpy as np
import pytest

from rockref.effects.loads.base_vibration import BaseVibration
from rockref.effects.loads.cable_restraint import CableRestraint
from rockref.effects.loads.lingering_wire_pull import LingeringWirePull
from rockref.effects.loads.plate_tilt import PlateTilt
from rockref.effects.loads.quadratic_drag import QuadraticDrag
from rockref.effects.support.compliant_support import CompliantSupport
from rockref.model.integrator import evaluate_contact
from tests.unit.effects.bodies import H, body, last, points_at, puck, walk

FAR = 10.0  # height of a body that touches nothing


def flying(effect, **kwargs):
    """A block of one metre in the air."""
    return body(points_at([(0.1, 0.1, -0.5), (-0.1, -0.1, -0.5)]), [effect], x=(0, 0, FAR), **kwargs)


def load_on(effect, problem, **changes):
    """Force and moment that an effect adds at the start of a problem."""
    s = problem.start
    c = evaluate_contact(problem.replace(effects=()), s, s.x, s.Lambda, s.v, s.W, np.zeros(3), s.t, ())
    return effect.body_wrench(problem, c, s.x, s.Lambda, s.v, s.W, effect.start(problem))


def test_falling_block_reaches_terminal_velocity():
    """v = v_t tanh(g t/v_t), v_t = sqrt(m g/c)."""
    c, mass = 60.0, 1.0
    terminal = math.sqrt(mass * 9.81 / c)
    problem = flying(QuadraticDrag(c_v=c), mass=mass, h=1e-4)
    speeds = [-s.v[2] for s in walk(problem, 1500)]
    for i in (200, 600, 1500):
        # Second order in the step: (g h/v_t)^2 = 6e-6.
        assert speeds[i] == pytest.approx(terminal * math.tanh(9.81 * i * 1e-4 / terminal), rel=1e-4)
    assert speeds[1500] > 0.99 * terminal


def test_drag_slows_a_spinning_body():
    """J omega' = -c omega^2: omega = omega_0/(1 + c omega_0 t/J), about a principal axis."""
    c, spin = 0.4, 3.0
    J = 2.0
    problem = flying(QuadraticDrag(c), J=(1.0, 1.0, J), W=(0, 0, spin), h=1e-4)
    rates = [s.W[2] for s in walk(problem, 1000)]
    for i in (100, 1000):
        # Second order in the step: (c omega_0 h/J)^2.
        order = (c * spin * 1e-4 / J) ** 2
        assert rates[i] == pytest.approx(spin / (1 + c * spin * i * 1e-4 / J), rel=max(order, 1e-9))


def test_cable_swings_a_free_body():
    """A damped oscillator about where the body was at the start."""
    k, c, mass, speed = 400.0, 4.0, 1.0, 0.1
    problem = flying(CableRestraint(k, c, 0.0), mass=mass, g=0.0, v=(0, speed, 0), h=1e-4)
    problem = problem.replace(
        start=problem.start.at_rest(problem.start.x + [0.3, 0.2, 0], np.eye(3), 2, problem.start.v)
    )
    delta = c / 2 / mass
    omega = math.sqrt(k / mass - delta**2)
    t = 1000 * 1e-4
    state = last(problem, 1000)
    # Second order in the step: (omega h)^2 = 4e-6 over two radians.
    expected = 0.2 + speed / omega * math.exp(-delta * t) * math.sin(omega * t)
    assert state.x[1] == pytest.approx(expected, abs=1e-5 * speed / omega)
    assert state.x[0] == 0.3


def test_wire_gives_its_impulse():
    """The integral of F exp(-t/tau)/m, and its moment about a body that has hardly turned."""
    force, tau, J = 3.0, 0.02, 50.0
    state = last(flying(LingeringWirePull(force, tau), g=0.0, J=(J, J, J), mass=2.0, h=1e-4), 400)
    impulse = force * tau * (1 - math.exp(-0.04 / tau))
    # Trapezoidal in time: (h/tau)^2/12 = 2e-6.
    assert state.v[1] == pytest.approx(impulse / 2.0, rel=3e-6)
    assert state.W[0] == pytest.approx(-0.5 * impulse / J, rel=1e-5)


@pytest.mark.parametrize("direction", [0.0, math.pi / 2, 1.0])
def test_vibrating_base_moves_a_free_body(direction):
    """dv/dt = -A cos(2 pi f t + phase), along (sin d, cos d)."""
    A, f, phase = 0.5, 30.0, 0.7
    h, steps = 1e-4, 250
    state = last(flying(BaseVibration(A, f, direction, phase), g=0.0, h=h), steps)
    omega = 2 * math.pi * f
    speed = -A / omega * (math.sin(omega * steps * h + phase) - math.sin(phase))
    expected = [speed * math.sin(direction), speed * math.cos(direction), 0]
    # Trapezoidal in time: (omega h)^2/12 = 3e-5 of A/omega, at either end.
    assert state.v == pytest.approx(expected, abs=6e-5 * A / omega)


def test_a_second_harmonic_moves_a_free_body():
    """dv/dt = -A (cos psi + q_c cos 2 psi + q_s sin 2 psi), psi = 2 pi f t + phase."""
    A, f, phase, cosine, sine = 0.5, 30.0, 0.7, 0.6, -0.4
    h, steps = 1e-4, 250
    state = last(flying(BaseVibration(A, f, 0.0, phase, cosine, sine), g=0.0, h=h), steps)
    omega = 2 * math.pi * f

    def way(psi):
        return math.sin(psi) + (cosine * math.sin(2 * psi) - sine * math.cos(2 * psi)) / 2

    speed = -A / omega * (way(omega * steps * h + phase) - way(phase))
    # Trapezoidal in time: (2 omega h)^2/12 = 1.2e-4 of A/omega, of less than half of it, at either end.
    assert state.v[1] == pytest.approx(speed, abs=1.8e-4 * A / omega)
    assert abs(state.v[1] + A / omega * (math.sin(omega * steps * h + phase) - math.sin(phase))) > 0.1 * A / omega


def test_tilted_plate_is_tilted_gravity():
    """The weight in the plate's axes is m g (sin, sin, -cos) to third order in the angles."""
    x, y = 3e-3, -2e-3
    force, moment = load_on(PlateTilt(x, y), flying(PlateTilt(x, y), mass=2.0))
    whole = force + [0, 0, -2.0 * 9.81]
    tilt = np.hypot(x, y)
    exact = 2.0 * 9.81 * np.array([math.sin(tilt) * x / tilt, math.sin(tilt) * y / tilt, -math.cos(tilt)])
    # The first terms dropped are tilt^3/6 = 8e-9 sideways and tilt^4/24 = 7e-12 along e_z, of the weight.
    assert whole == pytest.approx(exact, abs=2.0 * 9.81 * tilt**3 / 6)
    assert np.all(moment == 0)


def test_puck_slides_on_a_plate_steeper_than_friction():
    steep = last(puck([PlateTilt(0.1, 0.0)], mu=0.06, K_T=1e6, K_N=1e6, C_T=500.0, C_N=500.0), 1000)
    held = last(puck([PlateTilt(0.05, 0.0)], mu=0.06, K_T=1e6, K_N=1e6, C_T=500.0, C_N=500.0), 1000)
    # Before it slides the spring gives way by mu m g/(4 K_T) = 1.5e-7 m, in 0.5 ms of 10 ms.
    assert steep.v[0] == pytest.approx(9.81 * (0.1 - 0.06 * (1 - 0.1**2 / 2)) * 1000 * H, rel=4e-2)
    assert abs(held.v[0]) < 1e-5


def support_run(frequency, mass, plate_mass, ratio, steps, push=0.0):
    effect = CompliantSupport(plate_mass, frequency, ratio)
    problem = puck([effect], mass=mass, K_N=1e7, C_N=2e3, h=2e-5)
    problem = problem.replace(start=problem.start.at_rest(problem.start.x, np.eye(3), 4, [0, 0, -push]))
    return [(s.x[2], float(s.memory[0]["q"])) for s in walk(problem, steps)]


def test_loaded_support_swings_with_the_block_on_it():
    """f = sqrt(k/(M + m))/2 pi: the contact is a hundred times stiffer than the plate's spring."""
    frequency, mass, plate_mass = 30.0, 2.0, 3.0
    q = np.array([b for _, b in support_run(frequency, mass, plate_mass, 0.0, 4500, push=0.01)])
    crossings = np.flatnonzero((q[1:] >= 0) & (q[:-1] < 0))
    period = (crossings[-1] - crossings[0]) * 2e-5 / (len(crossings) - 1)
    loaded = frequency * math.sqrt(plate_mass / (plate_mass + mass))
    # The contact's own softness lowers it by k/(2 * 4 K_N) * share = 1e-3.
    assert 1 / period == pytest.approx(loaded, rel=2e-3)


def test_pitching_support_swings_with_the_block_on_it():
    """A block that stands on a line at y is a point mass there: two motions that pull each other, as a 2 x 2 matrix."""
    mass, plate, frequency, y, pitch = 2.0, 3.0, 30.0, 0.2, 0.5
    effect = CompliantSupport(plate, frequency, 0.0, pitch)
    P = [(0.1, 0, -1e-6), (-0.1, 0, -1e-6)]
    start = (0, y, 1e-6 - mass * 9.81 / 2 / 1e7)
    problem = body(points_at(P, K_N=1e7, C_N=2e3), [effect], mass=mass, J=(1e6, 1e6, 1e6), x=start, h=2e-5)
    problem = problem.replace(start=problem.start.at_rest(problem.start.x, np.eye(3), 2, [0, 0, -0.01]))
    J, k = plate * 0.03, (2 * math.pi * frequency) ** 2 * plate
    k_p = (2 * math.pi * frequency) ** 2 * J / pitch
    masses = np.array([[plate + mass, mass * y], [mass * y, J + mass * y**2]])
    squares, shapes = np.linalg.eig(np.linalg.solve(masses, np.diag([k, k_p])))
    # A blow at y: each motion begins with its part of the block's momentum, and swings at its own frequency.
    begun = np.linalg.solve(masses, mass * -0.01 * np.array([1.0, y]))
    parts = np.linalg.solve(shapes, begun)
    t = 2e-5 * np.arange(2501)
    swing = shapes @ (parts[:, None] * np.sin(np.sqrt(squares)[:, None] * t) / np.sqrt(squares)[:, None])
    rows = np.array([[float(s.memory[0][key]) for key in ("q", "pitch")] for s in walk(problem, 2500)]).T
    # Two periods; the contact is a thousand times stiffer, and semi-implicit steps of 20 us are 1 % of one behind.
    assert np.all(np.abs(rows - swing).max(axis=1) < 0.03 * np.abs(swing).max(axis=1))


def test_support_starts_in_balance():
    """The release posture stays: q counts from the sinking under the block's weight."""
    rows = np.array(support_run(30.0, 2.0, 3.0, 0.03, 500))
    # The weight is carried to rounding: 1e-15 of 20 N over 5 ms.
    assert np.abs(rows[:, 1]).max() < 1e-15
    assert np.ptp(rows[:, 0]) < 1e-15


def test_typical_drag_is_that_of_the_sail_of_which_the_text_speaks():
    """rho C_d A H^3/2 of a plate about the base; bare, the integral of rho C_d w z^3/2 over the block's height."""
    rho, C_d, width, height = 1.2, 2.0, 0.1, 0.688
    sail = rho * C_d * 10 * width * height * 0.8**3 / 2
    bare = rho * C_d * width * height**4 / 4 / 2
    q = QuadraticDrag.quantities["c"]
    # The text gives one digit.
    assert q.typical == pytest.approx(sail, rel=0.1) and "0.4 N m s2 is a sail" in QuadraticDrag.__doc__
    assert bare == pytest.approx(0.007, rel=0.1) and q.low < bare
