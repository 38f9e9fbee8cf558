"""What a run says that loses its numbers, word for word: at which step, of which block, at which points it began."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.model import problem
from rockref.model.errors import NumericalError
from tests import physics
from tests.unit.model.test_messages import FOOT, bar, run

CURE = "Check the start state and the parameters, or use a smaller step. [E-NAN]"


def lost_at_a_point(problem):
    """An anchor that is no number: the friction of this point is none either."""
    s = np.full(problem.start.s.shape, np.nan)
    return replace(problem, start=replace(problem.start, s=s, anchored=np.ones(s.shape[:-1], bool)))


class Twisted(physics.Pull):
    """After the start a moment that is no number: it takes the angular velocity of the same step, no force yet."""

    def body_wrench(self, problem, c, x, Lambda, v, W, m):
        return np.zeros_like(x), np.full_like(x, np.nan if c.t > 0 else 0)


class Broken(physics.Pull):
    """Pressed in by 55 nm, feet on the +x side push with a force that is no number."""

    def normal_force(self, F_N, k, points, m):
        return np.where((k.u[..., 0] > 0) & (k.xi > 5.5e-8), np.nan, F_N)


def settling():
    """A bar on two feet, the second of which breaks while they go down together."""
    points = physics.points([[-0.1, 0, 0], [0.1, 0, 0]])
    state = problem.State.at_rest(np.zeros(3), np.eye(3), 2, v=np.array([0, 0, -1e-3]))
    return replace(FOOT, points=points, start=state, effects=(Broken(),))


@pytest.mark.parametrize(
    "lost, text",
    [
        (
            settling(),
            f"step 5 (t = 5e-05 s): the motion is no longer made of finite numbers; it began at: 1. {CURE}",
        ),
        (
            physics.flying((1, 2, 3), (1e160, 0, 1), 1e-5, 1e-3),
            "step 1 (t = 1e-05 s): the motion is no longer made of finite numbers; "
            f"it began at: none of the contact points, its turn overflows. {CURE}",
        ),
        (
            problem.stack([physics.flying((1, 2, 3), (W, 0, 1), 1e-5, 1e-3) for W in (1.0, 1e160)]),
            "step 1 (t = 1e-05 s): the motion of block 1 is no longer made of finite numbers; "
            f"it began at: none of the contact points, its turn overflows. {CURE}",
        ),
        (
            lost_at_a_point(FOOT),
            f"step 0 (t = 0 s): the motion is no longer made of finite numbers; it began at: 0. {CURE}",
        ),
        (
            lost_at_a_point(bar()),
            f"step 0 (t = 0 s): the motion is no longer made of finite numbers; it began at: 0, 1, 2. {CURE}",
        ),
        (
            # the damper's force overflows before the first step, without a warning
            physics.mass_on_a_foot(v=(0, 0, -1e306)),
            f"step 0 (t = 0 s): the motion is no longer made of finite numbers; it began at: 0. {CURE}",
        ),
        (
            physics.mass_on_a_foot(z=1.0, effects=(physics.Pull(force=np.inf),)),
            "step 1 (t = 1e-05 s): the motion is no longer made of finite numbers; "
            f"it began at: none of the contact points. {CURE}",
        ),
        (
            physics.mass_on_a_foot(effects=(Twisted(),)),
            "step 1 (t = 1e-05 s): the motion is no longer made of finite numbers; "
            f"it began at: none of the contact points. {CURE}",
        ),
        (
            problem.stack([problem.stack([FOOT, FOOT]), problem.stack([lost_at_a_point(FOOT), FOOT])]),
            f"step 0 (t = 0 s): the motion of block 1, 0 is no longer made of finite numbers; it began at: 0. {CURE}",
        ),
        (
            problem.stack([FOOT, lost_at_a_point(FOOT)]),
            f"step 0 (t = 0 s): the motion of block 1 is no longer made of finite numbers; it began at: 0. {CURE}",
        ),
    ],
    ids=[
        "late point",
        "overflow",
        "overflow in a batch",
        "point",
        "points",
        "first force",
        "body",
        "turn",
        "plane of blocks",
        "batch",
    ],
)
def test_a_run_that_loses_its_numbers_says_where(lost, text):
    with pytest.raises(NumericalError) as stopped:
        run(lost)
    assert str(stopped.value) == text
