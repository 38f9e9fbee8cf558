"""Every effect that acts in the step has a compiled twin that does what its NumPy text does."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import EFFECTS, IN_STEP_ORDER, OF_TOSSES
from rockref.effects.friction import load_dependent_friction, rolling_resistance
from rockref.effects.loads import quadratic_drag
from rockref.engines import chosen
from rockref.engines.compiled import contact, engine, loads, pack, slots
from rockref.model.errors import InputError
from rockref.model.simulate import simulate as law

#: Their text calls `power` or `exp`, whose last bit NumPy and the C library need not share.
TRANSCENDENTAL = {"hertzian_contact", "load_dependent_friction", "stribeck_friction"}
EXACT = [id for id in slots.IN_THE_STEP if id not in TRANSCENDENTAL]


def kicked(effects, duration: float = 4e-3):
    """The block of Table 3.1 at release, kicked so that its feet stick, slide, lift and land; every step recorded."""
    problem = rockref.Model.table_3_1().problem(duration, output_rate=1e5)
    start = replace(problem.start, W=np.array([3.0, 0.4, 1.0]), v=np.array([0.3, 0.1, -0.2]))
    return problem.replace(start=start, effects=tuple(effects))


def assert_same_bits(a, b):
    for key in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        np.testing.assert_array_equal(getattr(a, key), getattr(b, key), err_msg=key)
    for mine, twin in zip(a.final_state.memory, b.final_state.memory, strict=True):
        assert mine.keys() == twin.keys()
        for key in mine:
            np.testing.assert_array_equal(mine[key], twin[key], err_msg=key)


def test_every_effect_is_known():
    known = set(slots.IN_THE_STEP) | (set(slots.OUTSIDE_THE_STEP) - {"none"})
    assert known == set(EFFECTS) | set(OF_TOSSES)
    assert [e.id for e in IN_STEP_ORDER if e.id in slots.IN_THE_STEP] == list(slots.IN_THE_STEP)
    assert set(pack.FILL) == set(slots.IN_THE_STEP)


def test_constants_are_those_of_the_text():
    assert loads.ARM == rolling_resistance.ARM
    assert loads.SLICES == quadratic_drag.SLICES
    assert contact.FLOOR == load_dependent_friction.FLOOR
    assert contact.SMALL == np.finfo(float).tiny / np.finfo(float).eps


@pytest.mark.parametrize("id", EXACT)
def test_alone_bit_for_bit(id):
    problem = kicked([EFFECTS[id].typical()])
    a = law(problem)
    assert_same_bits(a, engine.simulate(problem))
    assert not np.array_equal(a.W, law(kicked([])).W), "the run must show the effect"


@pytest.mark.parametrize("leave_out", [None, *EXACT])
def test_together_bit_for_bit(leave_out):
    problem = kicked([EFFECTS[id].typical() for id in EXACT if id != leave_out], 1e-3)
    assert_same_bits(law(problem), engine.simulate(problem))


@pytest.mark.parametrize("id", sorted(TRANSCENDENTAL))
def test_transcendental_ones_to_a_few_units_in_the_last_place(id):
    """One evaluation each from 40 states of a run: 4 ulp that NumPy grants itself, 1 of the C library, 3 roundings."""
    problem = kicked([EFFECTS[id].typical()])
    states = law(problem)
    for row in range(0, 400, 10):
        one = problem.replace(start=states.state(row), duration=1e-5)
        a, b = law(one), engine.simulate(one)
        scale = np.max(np.abs(a.F[0]), axis=-1, keepdims=True)
        assert np.all(np.abs(a.F[0] - b.F[0]) <= 8 * np.finfo(float).eps * scale)


def test_absent_effects_leave_the_law_bit_for_bit():
    absent = [e() for e in IN_STEP_ORDER]
    assert all(e.is_absent() for e in absent)
    plain = engine.simulate(kicked([]))
    with_absent = engine.simulate(kicked(absent))
    for key in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        np.testing.assert_array_equal(getattr(plain, key), getattr(with_absent, key))


def test_the_kernel_with_effects_gives_the_law_where_none_is_on():
    """The second kernel, with all switches off, is the first: what the effects add is behind their switches."""
    from rockref.engines.compiled import kernel

    problem = kicked([])
    rows = {}
    for name, run in (("law", kernel.law), ("with_effects", kernel.with_effects)):
        props = pack.props_rows(problem)
        n, wanted = problem.points.n, np.arange(0, 400, 7)
        out = [np.zeros((len(wanted), pack.col.STATE)), np.zeros((len(wanted), n, 3))]
        run(
            pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start),
            np.zeros((n, 3)), np.zeros(slots.SLOTS), pack.state_row(problem), problem.step, wanted, True, *out,
            np.zeros((len(wanted), n, pack.col.MEMORY)),
        )  # fmt: skip
        rows[name] = out
    for a, b in zip(rows["law"], rows["with_effects"], strict=True):
        np.testing.assert_array_equal(a, b)


def test_another_order_than_that_of_the_step_is_left_to_numpy():
    effects = [EFFECTS["hunt_crossley_contact"].typical(), EFFECTS["hysteretic_contact"].typical()]
    problem = kicked(effects)
    assert chosen(problem, "auto") == "numpy"
    with pytest.raises(InputError) as error:
        engine.simulate(problem)
    assert error.value.code == "E-TWIN"


def test_a_user_s_effect_has_no_twin_even_under_a_known_id():
    @dataclass(frozen=True)
    class Mine(EFFECTS["quadratic_drag"]):
        id: ClassVar[str] = "quadratic_drag"

    problem = kicked([Mine(c=1.0)])
    assert chosen(problem, "auto") == "numpy"
    with pytest.raises(InputError) as error:
        engine.simulate(problem)
    assert error.value.code == "E-TWIN" and "numpy" in error.value.cure


def test_uneven_normals_refuse_points_without_a_foot():
    problem = kicked([EFFECTS["uneven_contact_normals"].typical()])
    nameless = replace(problem.points, names=tuple("abcdefgh"))
    with pytest.raises(InputError) as error:
        engine.simulate(problem.replace(points=nameless))
    assert error.value.code == "E-FEET"
