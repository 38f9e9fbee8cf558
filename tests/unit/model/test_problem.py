"""Problems, batches, and the order of their memory."""

import numpy as np
import pytest

import rockref
from rockref.model import problem as p
from tests.refusal import refused

MODEL = rockref.Model.table_3_1()


def test_state_at_rest():
    s = p.State.at_rest(np.zeros(3), np.eye(3), 8)
    assert s.s.shape == (8, 2)
    for flags in (s.anchored, s.sliding):
        assert flags.dtype == bool
        assert not flags.any()
    assert np.array_equal(s.v, np.zeros(3))
    assert s.a is s.T is s.F is None
    moving = p.State.at_rest(np.zeros((5, 3), np.float32), np.eye(3), 4, v=[1, 2, 3], W=[4, 5, 6])
    assert moving.s.shape == (5, 4, 2)
    assert moving.s.dtype == np.float32
    assert np.array_equal(moving.v, [1, 2, 3])
    assert np.array_equal(moving.W, [4, 5, 6])


def test_complete_state_is_the_state():
    s = p.State.at_rest(np.zeros(3), np.eye(3), 8)
    same = p.complete_state(**{name: getattr(s, name) for name in s.__dataclass_fields__})
    assert vars(same) == vars(s)
    with pytest.raises(AttributeError):
        same.t = 1.0


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.longdouble])
def test_as_arrays_converts_everything_and_keeps_flags(dtype):
    q = p.as_arrays(MODEL.problem(), dtype)
    for thing, names in ((q.block, p.ARRAYS_OF_BLOCK), (q.points, p.ARRAYS_OF_POINTS), (q.start, p.ARRAYS_OF_STATE)):
        for name in names:
            a = getattr(thing, name)
            if a is not None:
                assert a.dtype == (bool if name in ("anchored", "sliding") else dtype), name


def test_as_arrays_copies():
    original = MODEL.problem()
    p.as_arrays(original).start.x[2] = 99
    assert original.start.x[2] != 99


def test_stack_puts_the_batch_fastest():
    q = p.as_arrays(p.stack([MODEL.replace(mu_ext=0.2 + 0.01 * i).problem() for i in range(5)]))
    assert q.batch == (5,)
    assert q.points.P.shape == (5, 8, 3)
    assert q.points.P.strides[0] == q.points.P.itemsize
    assert np.array_equal(q.points.mu[:, 0], 0.2 + 0.01 * np.arange(5))


def test_a_batch_of_one_is_a_batch():
    one = p.stack([MODEL.problem()])
    assert one.batch == (1,)
    assert np.array_equal(one.points.P[0], MODEL.problem().points.P)


def test_one_value_is_broadcast_to_the_batch():
    one, many = MODEL.problem(), p.stack([MODEL.problem()] * 3)
    q = p.as_arrays(p.replace(one, start=many.start))
    assert q.block.inertia.shape == (3, 3, 3)
    assert q.points.K_N.shape == (3, 8)


@pytest.mark.parametrize(
    "key, other",
    [
        ("step", MODEL.problem(step=2e-5)),
        ("duration", MODEL.problem(duration=9.0)),
        ("output_rate", MODEL.problem(output_rate=7.0)),
        ("radius", MODEL.replace(foot_radius=1e-3).problem()),
    ],
)
def test_problems_that_differ_in_what_a_batch_shares(key, other):
    error = refused(p.stack, [MODEL.problem(), other])
    assert (error.code, error.where) == ("E-STACK", key)


def test_replace():
    assert MODEL.problem().replace(duration=7.0).duration == 7.0
    assert MODEL.problem().batch == ()


def test_every_block_of_a_batch_is_its_own():
    both = p.stack([MODEL.problem(), MODEL.replace(mass=60.0).problem()])
    assert np.array_equal(both.block.mass, [54, 60])
