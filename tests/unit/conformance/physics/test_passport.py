"""The restitution passport against the spring and damper of the law, whose impact has a closed form."""

import numpy as np
import pytest

from rockref.conformance.physics.adapter import Engine
from rockref.conformance.physics.passport import MASS, drop, rows
from tests.unit.conformance.physics import seeded

K, BETA = 1e6, 0.1


def closed_form(n):
    """Restitution and contact time [s] of n springs and dampers that let go at zero force; C = 2 beta sqrt(K m)."""
    zeta, omega = BETA * np.sqrt(n), np.sqrt(n * K / MASS)
    root = np.sqrt(1 - zeta**2)
    # The force is zero again at the phase 2 atan(root / zeta).
    phase = 2 * np.arctan2(root, zeta)
    return np.exp(-zeta / root * phase), phase / (root * omega)


@pytest.mark.parametrize("shape, n", [("sphere", 1), ("corner", 1), ("edge", 2), ("flat", 4)])
def test_an_impact_on_springs_has_the_restitution_of_the_closed_form(shape, n):
    pytest.importorskip("numba")
    found = drop(Engine(seeded.contact(K=K, beta=BETA, step=5e-5), "default"), shape, 0.5)
    e, time = closed_form(n)
    # Weight adds m g / (n K), a per cent of the depth; the centre is back at touch later than the force is zero.
    assert found["e"] == pytest.approx(e, rel=0.02)
    assert time < found["time"] < 1.4 * time


def test_every_step_of_the_impact_is_recorded():
    t = rows(1e-4)
    assert np.diff(t[t < 0.02]) == pytest.approx(1e-4) and np.diff(t[t > 0.021]) == pytest.approx(1e-3)
    assert t[-1] == pytest.approx(0.25, abs=1e-3)
