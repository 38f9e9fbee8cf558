"""Runs that show no forces tell a decision or a term where they are those of the law with other inputs."""

import numpy as np
import pytest

from rockref.conformance.backends.rule_set import law
from tests.unit.conformance.judge.causes.hidden_runs import verdict_on_hidden


def kept_nearby(xi, u_t, s, anchored):
    """A foot that touches anew within a millimetre of its old anchor keeps it."""
    near = np.hypot(*np.moveaxis(u_t - s, -1, 0)) < 1e-3
    return law().touch(xi, u_t, s, anchored | near)


def never_slides_slowly(size, threshold):
    """A foot sticks up to ten times the cone."""
    return law().sticks(size, 10 * threshold)


def tied_elsewhere(xi, u_t, s, anchored):
    """The anchor of the foot before."""
    return law().touch(xi, u_t, np.roll(s, 1, axis=-2), anchored)


def slid_elsewhere(F_N, slid, mu_0, mu):
    """Whether the opposite foot slid, counted from the last."""
    return law().threshold(F_N, slid[..., ::-1], mu_0, mu)


def upside_down(x, Lambda, v, W, P):
    """Feet where the top of the block is."""
    return law().kinematics(x, Lambda, v, W, P * [1.0, 1.0, -1.0])


def never_deep(xi, F_N):
    """Feet deeper than 30 micrometres push by nothing."""
    return law().gap(xi, F_N) * (xi < 3e-5)


@pytest.mark.parametrize(
    ("planted", "rule", "words"),
    [
        ({"kinematics": upside_down}, "K1", "No foot pushes"),
        ({"gap": never_deep}, "N1", ""),
        ({"touch": kept_nearby}, "T5", "keep an old anchor"),
        ({"touch": tied_elsewhere}, "T5", "anchors of the foot before"),
        ({"threshold": slid_elsewhere}, "T6", "flags of sliding from the last foot"),
        ({"sticks": never_slides_slowly}, "T2", "never slide"),
        ({"threshold": lambda F_N, slid, mu_0, mu: law().threshold(F_N, slid & False, mu_0, mu)}, "T6", "no foot slid"),
        ({"trial": lambda u_t, s, v, K_T, C_T: law().trial(u_t, s, v, 1.001 * K_T, C_T)}, "T1", ""),
    ],
)
def test_runs_of_the_law_with_other_inputs_tell_the_rule(planted, rule, words):
    found = verdict_on_hidden(**planted)
    assert found.rule == rule and words in found.says, (found.rule, found.says, found.check)
