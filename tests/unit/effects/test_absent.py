"""Absent means absent: with every effect at its absent value, alone or all together, the bits are the law's."""

from dataclasses import replace

import numpy as np
import pytest

from rockref import Model
from rockref.effects import catalogue
from rockref.model.integrator import first_evaluation, prepared_inertia, step
from rockref.model.problem import State, stack
from rockref.model.release import release_posture
from rockref.model.simulate import simulate

BITS = ("x", "v", "Lambda", "W", "F", "s", "anchored", "sliding")


@pytest.fixture(scope="module")
def busy():
    """A problem of a few steps in which points touch, stick, slide and leave: the block falls on its feet, turning."""
    model = Model.table_3_1()
    block, points = model.body()
    x = release_posture(block, points, 1e-3).x - [0, 0, 1e-6]
    start = State.at_rest(x, np.eye(3), 8, v=np.array([0.05, -0.02, -0.1]), W=np.array([0.3, -0.2, 0.4]))
    return model.problem(duration=2e-3, output_rate=1e5, start=start)


@pytest.fixture(scope="module")
def law(busy):
    response = simulate(busy)
    assert {True, False} == set(response.anchored.ravel()) == set(response.sliding.ravel())
    return response


def same_bits(a, b):
    return all(getattr(a, key).tobytes() == getattr(b, key).tobytes() for key in BITS)


@pytest.mark.parametrize("kind", catalogue.IN_STEP_ORDER, ids=lambda kind: kind.id)
def test_absent_effect_in_the_step_is_the_law(kind, busy, law):
    assert same_bits(simulate(busy.replace(effects=(kind(),))), law)


def test_all_absent_effects_together_are_the_law(busy, law):
    assert same_bits(simulate(busy.replace(effects=tuple(kind() for kind in catalogue.IN_STEP_ORDER))), law)
    none = tuple(kind() for kind in catalogue.NONE.values())
    assert all(effect.is_absent() for effect in none)
    assert same_bits(simulate(busy.replace(effects=none)), law)


def test_absent_effects_leave_the_body_the_release_and_the_record():
    model = Model.table_3_1()
    block, points = model.body()
    start = release_posture(block, points, 0.1)
    crv = np.random.default_rng(1).normal(size=(7, 3))
    for kind in catalogue.IN_STEP_ORDER:
        effect = kind()
        assert effect.points(block, points) == (block, points)
        assert effect.release(block, points, start) is start
        assert effect.sensor(np.arange(7.0), crv) is crv


def test_absent_effects_are_dropped_from_a_model(law):
    model = Model.table_3_1().replace(effects=tuple(kind() for kind in catalogue.IN_STEP_ORDER))
    assert model.active_effects() == ()


@pytest.mark.parametrize("kind", catalogue.IN_STEP_ORDER, ids=lambda kind: kind.id)
def test_typical_effect_is_not_the_law(kind, busy, law):
    """Each one changes the body, the start, the step or the record, and nothing turns into a lost number."""
    effect = kind.typical()
    four = kind.id == "foot_defects"
    model = Model.four_points() if four else Model.table_3_1()
    block, points = model.body()
    changed_block, changed_points = effect.points(block, points)
    start = release_posture(changed_block, changed_points, 0.1)
    posture = effect.release(changed_block, changed_points, start)
    crv = np.cumsum(np.full((200, 3), 0.01), axis=0)
    outside = (
        changed_points is not points
        or changed_block is not block
        or posture is not start
        or not np.array_equal(effect.sensor(np.arange(200) / 2000, crv), crv)
    )
    problem = busy.replace(block=changed_block, points=changed_points, effects=(effect,))
    response = simulate(problem)
    assert np.all(np.isfinite(response.W)) and np.all(np.isfinite(response.F))
    assert outside or not same_bits(response, law)


IN_STEP = [k for k in catalogue.IN_STEP_ORDER if k.question in ("contact", "friction", "loads", "support")]
MANY = tuple(k.typical() for k in [*IN_STEP, catalogue.EFFECTS["uneven_contact_normals"]])


def test_a_batch_is_its_members_bit_for_bit(busy):
    """All effects of the step at once: runs side by side do not see each other."""
    effects = catalogue.in_step_order(MANY)
    other = replace(busy.start, W=np.array([-0.2, 0.1, 0.3]))
    problems = [busy.replace(effects=effects, duration=3e-4), busy.replace(effects=effects, duration=3e-4, start=other)]
    both = simulate(stack(problems))
    for i, problem in enumerate(problems):
        alone = simulate(problem)
        for key in BITS:
            assert np.array_equal(getattr(both[i], key), getattr(alone, key)), key
        for own, ours in zip(alone.final_state.memory, both[i].final_state.memory, strict=True):
            assert all(np.array_equal(own[key], ours[key]) for key in own)


def test_a_run_restarts_bit_for_bit_with_its_memories(busy):
    """Dents, turns, the plate and the cable's end are part of the state."""
    problem = busy.replace(effects=catalogue.in_step_order(MANY), duration=4e-4)
    whole = simulate(problem).final_state
    half = simulate(problem.replace(duration=2e-4)).final_state
    again = simulate(problem.replace(start=half, duration=2e-4)).final_state
    for key in ("x", "v", "Lambda", "W", "F", "s"):
        assert getattr(again, key).tobytes() == getattr(whole, key).tobytes(), key
    for a, b in zip(again.memory, whole.memory, strict=True):
        assert all(np.array_equal(a[key], b[key]) for key in a)


@pytest.mark.parametrize("dtype", [np.float32, np.longdouble])
def test_effects_keep_the_precision_that_was_asked_for(dtype, busy):
    problem = busy.replace(effects=catalogue.in_step_order(MANY), duration=1e-4)
    response = simulate(problem, dtype=dtype)
    assert response.W.dtype == dtype
    for memory in response.final_state.memory:
        assert all(a.dtype == dtype for a in memory.values())


def test_memories_are_replaced_never_changed(busy):
    """The state before a step is as it was after it: a run may be continued twice from one state."""
    problem = busy.replace(effects=catalogue.in_step_order(MANY))
    state = first_evaluation(problem)
    state = step(problem, state, prepared_inertia(problem.block))
    before = [{key: a.copy() for key, a in m.items()} for m in state.memory]
    step(problem, state, prepared_inertia(problem.block))
    for m, kept in zip(state.memory, before, strict=True):
        assert all(np.array_equal(m[key], kept[key]) for key in kept)
