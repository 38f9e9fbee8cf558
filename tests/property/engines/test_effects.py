"""The compiled twins of the effects: the law's text, whatever the numbers, alone and up to three together."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import find, in_step_order
from rockref.engines.compiled import engine, slots
from rockref.model.simulate import simulate as law
from tests.property.engines.test_bits import assert_same_bits
from tests.unit.engines.test_twins import EXACT

#: What a last bit may become over forty steps of stiff contact, relative to the largest number of its kind: each step
#: hands an error on, grown by less than (w h)^2 + 1 < 1.1 for w = 3e4 1/s, so by less than 1.1^40 = 45; a point at the
#: edge of its cone may add a slip of the same smallness.
LAST_BITS = 1e-12


@st.composite
def effects(draw, ids: tuple[str, ...]):
    """One to three effects, each number absent, at an end of its plausible range, or anywhere in it."""
    made = []
    for id in draw(st.lists(st.sampled_from(ids), min_size=1, max_size=3, unique=True)):
        values = {}
        for key, q in find(id).quantities.items():
            anywhere = st.floats(q.low, q.high)
            values[key] = draw(st.one_of(st.sampled_from([q.absent, q.low, q.high]), anywhere))
        made.append(find(id)(**values))
    return in_step_order(made)


@st.composite
def runs(draw, ids: tuple[str, ...]):
    """Forty steps of the block of Table 3.1 near the plate: its feet press, slip, stick, lift and land."""
    problem = rockref.Model.table_3_1().problem(4e-4, output_rate=1e5)
    rng = np.random.default_rng(draw(st.integers(0, 2**32 - 1)))
    fast = draw(st.sampled_from([0.02, 0.2, 1.0]))
    start = replace(
        problem.start,
        x=problem.start.x + [0.0, 0.0, rng.uniform(-1e-5, 2e-5)],
        v=rng.normal(size=3) * 0.3 * fast,
        W=rng.normal(size=3) * 3.0 * fast,
    )
    return problem.replace(start=start, effects=tuple(draw(effects(ids))))


@given(runs(tuple(EXACT)))
def test_the_law_s_bits(problem):
    assert_same_bits(law(problem), engine.simulate(problem))


@given(runs(slots.IN_THE_STEP))
def test_the_law_s_numbers_where_a_power_is_taken(problem):
    a, b = law(problem), engine.simulate(problem)
    for key in ("x", "v", "Lambda", "W"):
        expected = getattr(a, key)
        largest = float(np.max(np.abs(expected)))
        np.testing.assert_allclose(getattr(b, key), expected, rtol=0, atol=LAST_BITS * largest, err_msg=key)
