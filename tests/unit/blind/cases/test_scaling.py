"""Typical sizes go with the block: one for the source's, and by dimension for one that is a model of it."""

from dataclasses import fields

import pytest

from rockref.blind.cases import scaling, unlisted
from rockref.blind.cases.hidden import EFFECTS
from rockref.blind.simulator.world import SOURCE, TABLE, Block

TWICE = scaling.scale_of(Block(8 * SOURCE.mass, 2 * SOURCE.width, 2 * SOURCE.height), TABLE | {"K_N": 8 * TABLE["K_N"]})


def test_the_source_has_the_sizes_that_it_had():
    scale = scaling.scale_of(SOURCE, TABLE)
    assert all(getattr(scale, f.name) == 1.0 for f in fields(scale)) and set(scaling.factors(scale).values()) == {1.0}


@pytest.mark.parametrize(
    ("name", "power"),
    [
        # Lengths, masses and times of a block of twice the size go as 2, 8 and the root of 2: powers of two.
        ("spin_friction.radius", 1), ("mass_eccentricity.x", 1), ("plate_tilt", 0), ("base_vibration.amplitude", 0),
        ("adhesion.force", 3), ("lingering_wire_pull.force", 3), ("lingering_wire_pull.tau", 0.5),
        ("quadratic_drag.c", 3 + 2), ("cable_restraint.k", 3 - 1), ("cable_restraint.c", 3 - 0.5),
        ("viscous_friction.c", 3 - 0.5), ("hunt_crossley_contact.a", -0.5), ("release_velocity", -0.5),
        ("rotor.angular_momentum", 3 + 2 - 0.5), ("knock.impulse", 3 + 1 - 0.5), ("compliant_support.mass", 3),
        ("hung.frequency", -0.5), ("gust.time", 0.5), ("creeping_feet.stiffness", 3),
    ],
)  # fmt: skip
def test_units_of_a_block_of_twice_the_size(name, power):
    assert scaling.factors(TWICE)[name] == pytest.approx(2.0**power)


def test_every_factor_is_of_something_that_is_hidden():
    parts = {"hung"}
    assert {name.partition(".")[0] for name in scaling.factors(TWICE)} <= set(EFFECTS) | set(unlisted.EFFECTS) | parts


def test_a_factor_that_is_used_is_there():
    import ast
    import inspect

    from rockref.blind.cases import hidden, hidden_contact, unlisted

    used = set()
    for module in (hidden, hidden_contact, unlisted):
        for node in ast.walk(ast.parse(inspect.getsource(module))):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "factor":
                used |= {node.args[0].value} if isinstance(node.args[0], ast.Constant) else set()
    assert used <= set(scaling.factors(TWICE)) and len(used) > 20
