"""What properties ask, and what they leave free."""

import numpy as np
import pytest

from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.faults.controls import CONTROLS
from rockref.conformance.faults.mistakes import MISTAKES
from rockref.conformance.judge.properties import anchor_fits_the_force, inside_the_cone, no_tension, point

AT_THE_PLATE = {"xi": 0.0, "xi_rate": 0.2, "u_t": np.array([1e-4, 0.0]), "v_slide": np.array([0.5, -0.1]),
                "s": np.zeros(2), "anchored": True, "sliding": False, "mu": 0.3}  # fmt: skip


@pytest.mark.parametrize("holds", [no_tension, inside_the_cone, anchor_fits_the_force])
def test_a_foot_exactly_at_the_plate_may_be_open_or_touch(holds):
    strict = next(c for c in CONTROLS if c.id == "C07").backend()
    assert not strict.contact_law(**point(AT_THE_PLATE))["touching"]
    for backend in (RulesBackend(), strict):
        holds(backend, dict(AT_THE_PLATE))


def test_an_anchor_that_is_not_moved_breaks_the_fit():
    stays = next(m for m in MISTAKES if m.id == "Z11").backend()
    with pytest.raises(AssertionError, match="off by"):
        anchor_fits_the_force(stays, AT_THE_PLATE | {"xi": 1e-5})
