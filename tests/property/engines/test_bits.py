"""The compiled step gives the law's bits, whatever the block, its feet and its motion."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("numba")

from rockref.engines.compiled import engine
from rockref.model.base_motion import BaseMotion
from rockref.model.problem import stack
from rockref.model.response import Response
from rockref.model.simulate import simulate as law
from tests.property.engines.problems import problems, similar_problem


def assert_same_bits(a: Response, b: Response, rows=slice(None)) -> None:
    """Equal numbers, NaN included; +0 and -0 count as equal. The anchor of a point without anchor means nothing."""
    for key in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        np.testing.assert_array_equal(getattr(a, key)[..., :], getattr(b, key)[..., :], err_msg=key)
    np.testing.assert_array_equal(a.s[a.anchored], b.s[b.anchored], err_msg="s")
    for key in ("x", "v", "Lambda", "W", "a", "T", "F", "t", "origin", "count", "h"):
        np.testing.assert_array_equal(getattr(a.final_state, key), getattr(b.final_state, key), err_msg=key)


@given(problems())
def test_one_run(problem):
    assert_same_bits(law(problem), engine.simulate(problem))


@given(problems(), st.integers(0, 2**32 - 1))
def test_one_run_on_a_plate_that_moves(problem, seed):
    """Records begin before or within the run, end within or after it, and have samples between steps or on them."""
    rng = np.random.default_rng(seed)
    dt = problem.step * rng.choice([0.3, 1.0, 2.0, 7.77])
    t_0 = problem.start.t + problem.step * rng.choice([-50.5, -3.0, 0.0, 11.25])
    base = BaseMotion(t_0, dt, rng.normal(size=(rng.integers(1, 40), 3)) * 30)
    problem = problem.replace(base=base)
    assert_same_bits(law(problem), engine.simulate(problem))


@given(problems(steps=30), st.integers(1, 29))
def test_restart_from_the_law_s_state_and_back(problem, cut):
    """A run may change engine at any step: the law's state continues on the compiled step, and the other way round."""
    whole = law(problem)
    first, rest = problem.replace(duration=cut * problem.step), problem.replace(duration=(30 - cut) * problem.step)
    for before, after in ((law, engine.simulate), (engine.simulate, law), (engine.simulate, engine.simulate)):
        end = after(rest.replace(start=before(first).final_state))
        for key in ("x", "v", "Lambda", "W", "F", "anchored", "sliding"):
            np.testing.assert_array_equal(getattr(whole, key)[cut:], getattr(end, key), err_msg=key)
        np.testing.assert_array_equal(whole.t[cut:], end.t)


@given(st.lists(st.integers(0, 2**32 - 1), min_size=2, max_size=4), st.integers(1, 8))
def test_a_batch_is_its_runs(seeds, n):
    batch = stack([similar_problem(seed, n) for seed in seeds])
    together = engine.simulate(batch)
    assert_same_bits(law(batch), together)
    for i, seed in enumerate(seeds):
        assert_same_bits(law(similar_problem(seed, n)), together[i])
