"""The moment or the attitude that turns it: what other runs show tells them apart."""

import numpy as np
import pytest

from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.backends.rule_set import law
from rockref.conformance.faults.run import BlackBox
from rockref.conformance.judge.findings import judge
from rockref.conformance.judge.verdict import verdict
from tests.unit.conformance.judge.causes.hidden_runs import verdict_on_hidden


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


def flat_levers(r, F):
    """Levers of half a height for all feet."""
    return law().moment(np.concatenate([r[..., :2], np.full_like(r[..., 2:], -0.344)], axis=-1), F)


def test_turns_that_are_wrong_where_no_place_is_speak_of_the_moment():
    found = verdict_on_hidden(moment=flat_levers)
    assert found.rule == "A2" and "what they turn is not" in found.says, (found.rule, found.check)


def test_friction_of_new_feet_alone_that_turns_otherwise_speaks_of_their_anchor():
    def touch(xi, u_t, s, anchored):
        return law().touch(xi, u_t, np.where(anchored[..., None], s, np.round(u_t, 6)), np.ones_like(anchored))

    found = verdict_on_hidden(touch=touch)
    assert found.rule == "T5" and "touch anew does not" in found.says, (found.rule, found.check)


def test_moments_that_are_wrong_after_a_step_alone_speak_of_its_velocities():
    def first_half(rules, state, inertia, h):
        *before, W_p, E, JW = law().first_half(rules, state, inertia, h)
        gain = np.squeeze(state.Lambda @ (W_p - state.W)[..., None], -1)
        return *before, state.W + gain, E, JW

    found = verdict_on_hidden(first_half=first_half)
    assert found.rule == "S1" and "after a step" in found.says, (found.rule, found.check)


def test_friction_with_a_wrong_lever_is_no_attitude():
    rule, found = named(moment=flat_levers)
    assert rule == "A2" and "that of friction" in found.says, (rule, found.check)
