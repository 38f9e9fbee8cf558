"""The second simulator and the law agree on blocks that are not the source's, to what a step of either is worth."""

import numpy as np
import pytest

from rockref.api import Model, simulate
from rockref.blind.cases import hidden
from rockref.blind.cases.blocks import other_block
from rockref.blind.cases.generator import _world
from rockref.blind.simulator import release
from rockref.effects.catalogue import EFFECTS

STEP = 5e-6


def law(setup, effects, tilt, seconds):
    """Body rates (N, 3) [rad/s] by the law, a thousand lines a second."""
    p = dict(setup.parameters) | {"theta_0": tilt}
    p["delta_long"] = np.array([p.pop(f"delta_long_{i}") for i in (1, 2, 3, 4)])
    block = setup.block
    sides = {"width": block.width, "depth": block.width, "height": block.height}
    model = Model(mass=block.mass, effects=effects, **sides).replace(**p)
    return np.radians(simulate(model, seconds, STEP, 1000.0, engine="auto").crv)


def rms(a):
    return float(np.sqrt(np.mean(a**2)))


@pytest.mark.parametrize(
    ("seed", "effect"),
    [(7, None), (11, "adhesion"), (4, "cable_restraint"), (6, "rolling_resistance"), (5, "viscous_friction")],
)
def test_rates_past_the_first_main_impact(seed, effect):
    pytest.importorskip("numba")
    setup = other_block(seed)
    world, acts = _world(setup, setup.parameters), ()
    if effect is not None:
        truth = hidden.EFFECTS[effect](world, np.random.default_rng(1), 1.0, False, {})
        absent = {name: q.absent for name, q in EFFECTS[effect].quantities.items()}
        acts = (EFFECTS[effect](**absent | truth["parameters"]),)
    tilt = setup.runs[0][2]
    # The source's block, whose record is five seconds, comes down at half a second.
    seconds = round(0.13 * setup.seconds, 3)
    ours, finer = (release.simulate(world, tilt, seconds=seconds, step=h)[::10] for h in (STEP, STEP / 2))
    theirs = law(setup, acts, tilt, seconds)
    assert np.abs(ours[-1, 0]) < 0.95 * np.abs(ours[:, 0]).max(), "the block has come down"
    # Both schemes are of second order, and what one step leaves is three quarters or more of their error.
    assert rms(ours - theirs) < rms(ours - finer)
    if effect is not None:
        plain = release.simulate(_world(setup, setup.parameters), tilt, seconds=seconds)[::10]
        assert rms(ours - theirs) < 0.02 * rms(ours - plain)
