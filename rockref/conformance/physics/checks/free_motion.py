"""Without contact: what is set is read back, a free body flips, a body falls."""

from __future__ import annotations

import numpy as np

from rockref.conformance.physics.finding import Finding, judged, percent
from rockref.conformance.physics.scene import Motion, Start, down, turn
from rockref.conformance.physics.theory import flip_interval, spin_change
from rockref.conformance.physics.trial import FLIPPER, G, Trial, crossing

NO_GRAVITY = down(0.0)
#: A pose in which no two components of the quaternion, and no two of the rates, are alike.
POSE = turn("z", 0.9) @ turn("y", -0.5) @ turn("x", 0.3)
SPIN = np.array([1.5, -2.0, 3.0])  # rad/s
#: Rounding of a rotation to a quaternion and back, in either precision.
ECHO_DOUBLE, ECHO_SINGLE = 1e-12, 1e-6
#: An explicit step of 1 ms is off by omega dt, half a percent; a swapped pair of moments by tens of percent.
SPIN_BAR = 0.01


def echo(trial: Trial) -> Finding:
    """Check that the engine returns the state it was given, and that its first step obeys Euler's equations."""
    start = Start(np.array([0.3, -0.2, 1.0]), POSE, np.array([0.1, 0.2, -0.3]), SPIN)
    step = trial.engine.step
    later = step * max(1, round(1e-3 / step))
    motion = trial.engine.run(FLIPPER, start, np.array([0.0, later]), NO_GRAVITY)
    off = max(float(np.max(np.abs(a[0] - b))) for a, b in zip(motion, start, strict=True))
    change = spin_change(FLIPPER.inertia, start.R, start.omega, later)
    spin = float(np.linalg.norm(motion.omega[1] - start.omega - change) / np.linalg.norm(change))
    bar = ECHO_DOUBLE if trial.engine.double else ECHO_SINGLE
    seen, cause = "", ""
    if off > bar:
        small = off < 10 * ECHO_SINGLE
        cause = "precision" if small else "frame"
        seen = "the state is rounded" if small else f"{differing(motion, start)} comes back as another"
    elif spin > SPIN_BAR:
        cause = spin_cause(motion.omega[1] - start.omega, change, start.omega)
        seen = "a free body of three moments keeps its rate" if cause == "gyroscopic" else (
            f"the first change of rate is off by {100 * spin:.2g} % of Euler's equations")  # fmt: skip
    return judged("echo", not seen, f"state off by {off:.1g}, change of omega by {spin:.2g}", "0, 0",
                  f"{bar:g}, {SPIN_BAR:g}", seen, cause, {"state": off, "spin": spin})  # fmt: skip


def spin_cause(found: np.ndarray, change: np.ndarray, omega: np.ndarray) -> str:
    """Return the cause of another change of rate: none at all, twice the steps, a loss along the rate, or the rest."""
    size, rest = float(np.linalg.norm(change)), found - change
    if np.linalg.norm(found) < 0.01 * size:
        return "gyroscopic"
    if np.linalg.norm(found - 2 * change) < 0.05 * size:
        return "count"
    along = float(rest @ omega / np.linalg.norm(omega) / np.linalg.norm(rest))
    return "damping" if along < -0.95 else "inertia"


def differing(motion: Motion, start: Start) -> str:
    """Return the name of the quantity that comes back most differently."""
    off = [float(np.max(np.abs(a[0] - b))) for a, b in zip(motion, start, strict=True)]
    return ("the position", "the rotation", "the velocity", "the angular velocity")[int(np.argmax(off))]


FLIPS = 4
#: The interval holds for second-order integrators at 1 ms to 1e-6 (measured on four engines); swapped moments move it
#: by percents. Single precision rounds the small rate that decides when the body flips.
FLIP_DOUBLE, FLIP_SINGLE = 1e-4, 0.03
#: Energy and momentum of a first-order integrator at 1 ms drift by 2 % over four flips; drag at a rate of 0.02 / s by
#: more.
DRIFT_BAR = 0.05


def flight(trial: Trial) -> Finding:
    """Check the interval between flips of a free body about its middle axis, energy and momentum over four flips."""
    omega = 5 * np.array([0.05, 1.0, 0.0])
    interval = flip_interval(FLIPPER.inertia, omega)
    start = Start(np.array([0.0, 0.0, 1.0]), np.eye(3), np.zeros(3), omega)
    times = trial.rows((FLIPS + 0.2) * interval, 2e-3)
    motion = trial.engine.run(FLIPPER, start, times, NO_GRAVITY)
    J = np.array(FLIPPER.inertia)
    w = np.einsum("tji,tj->ti", motion.R, motion.omega)
    first = crossing(times, w[:, 1], 0.0)
    after = times > first
    second = crossing(times[after][1:], w[after][1:, 1], 0.0)
    off = (second - first) / interval - 1
    energy = float(np.sum(J * w[-1] ** 2) / np.sum(J * w[0] ** 2) - 1)
    L = np.linalg.norm(J * w, axis=1)
    momentum = float(L[-1] / L[0] - 1)
    bar = FLIP_DOUBLE if trial.engine.double else FLIP_SINGLE
    drift = max(abs(energy), abs(momentum))
    measured = f"interval {percent(off)}; energy {percent(energy)}, momentum {percent(momentum)} after {FLIPS} flips"
    seen, cause = "", ""
    if not np.isfinite(off):
        seen = f"the body does not flip twice in {FLIPS} intervals"
        steady = np.max(np.abs(motion.omega - motion.omega[0])) < 1e-3 * np.linalg.norm(omega)
        cause = "damping" if energy < -DRIFT_BAR else "gyroscopic" if steady else "inertia"
    elif energy < -DRIFT_BAR or momentum < -DRIFT_BAR:
        seen, cause = f"a free body loses {-100 * min(energy, momentum):.2g} % of its energy or momentum", "damping"
    elif abs(off) > bar:
        seen, cause = f"a free body flips every {second - first:.4f} s, not every {interval:.4f} s", "inertia"
    numbers = {"interval": off, "energy": energy, "momentum": momentum}
    bars = f"{percent(bar)[1:]} of the interval; losses up to {percent(DRIFT_BAR)[1:]}"
    if seen or drift <= 1e-3:
        return judged("flight", not seen, measured, f"{interval:.4f} s", bars, seen, cause, numbers)
    told = f"energy or momentum drifts by {100 * drift:.2g} % in four flips"
    cause = "integrator" if trial.engine.double else "rounding"
    return Finding("flight", "remark", measured, f"{interval:.4f} s", bars, told, cause, numbers)


FALL = 2.0  # s
#: Sums of 1e3 to 1e5 products: 1e-12 and, in single precision, 1e-3.
FALL_DOUBLE, FALL_SINGLE = 1e-9, 2e-3


def fall(trial: Trial) -> Finding:
    """Check speed and depth after two seconds of free fall.

    A first-order integrator is deeper, or less deep, by g t dt / 2: that is allowed.
    """
    start = Start.at_rest((0.0, 0.0, 1.0), POSE)
    motion = trial.engine.run(FLIPPER, start, np.array([FALL]), down(G))
    speed = float(-motion.v[0, 2] / (G * FALL) - 1)
    depth = G * FALL * FALL / 2
    off = float(1.0 - motion.x[0, 2] - depth)
    bar = FALL_DOUBLE if trial.engine.double else FALL_SINGLE
    half = G * FALL * trial.engine.step / 2
    # The depth may be off by up to half a step of speed; beyond, by the bar.
    excess = max(abs(off) - half, 0.0) / depth
    cause, seen = "", ""
    if max(abs(speed), excess) > bar:
        # Damping takes a share that grows with time and speed: the depth misses less than the speed.
        damped = speed < 0 and abs(off / depth) < 0.8 * abs(speed)
        cause = "damping" if damped else "gravity"
        seen = f"after {FALL:g} s of fall the speed is off by {percent(speed)}, the depth by {percent(off / depth)}"
    return judged("fall", not seen, f"speed {percent(speed)}, depth {percent(off / depth)}", f"{G * FALL:.2f} m/s, "
                  f"{depth:.2f} m", f"{bar:g}, and g t dt / 2 = {half:.2g} m in depth", seen, cause,
                  {"speed": speed, "depth": off / depth})  # fmt: skip
