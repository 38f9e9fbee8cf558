"""The moment or the attitude that turns it: what other runs show tells them apart."""

import numpy as np
import pytest

from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict


def named(**planted):
    found = verdict(judge(BlackBox(RulesBackend(law().replace(**planted))), ["L5s"]))
    return found.rule, found


def by_the_height_alone(Lambda, M):
    """The moment turned back as if the block did not lean."""
    c, s = Lambda[..., 0, 0], Lambda[..., 1, 0]
    size, zero = np.hypot(c, s), np.zeros_like(c)
    rows = [[c, s, zero], [-s, c, zero], [zero, zero, size]]
    yaw = np.stack([np.stack(row, -1) for row in rows], -2) / size[..., None, None]
    return np.squeeze(yaw @ M[..., None], -1)


def test_a_moment_of_the_right_size_that_points_another_way_is_turned_otherwise():
    rule, found = named(body_moment=by_the_height_alone)
    assert rule == "A3" and "right size" in found.says, (rule, found.check)


@pytest.mark.parametrize("signs", [(1, -1, 1), (-1, -1, -1)])
def test_a_sign_in_a_moment_keeps_its_size_and_is_no_attitude(signs):
    assert named(moment=lambda r, F: law().moment(r, F) * signs)[0] == "A2"


def test_friction_with_a_wrong_lever_is_no_attitude():
    def moment(r, F):
        flat = np.concatenate([r[..., :2], np.full_like(r[..., 2:], -0.344)], axis=-1)
        return law().moment(flat, F)

    rule, found = named(moment=moment)
    assert rule == "A2" and "that of friction" in found.says, (rule, found.check)
