"""Every effect that acts in the step has a compiled twin that does what its NumPy text does."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np
import pytest

pytest.importorskip("numba")

import rockref
from rockref.effects.catalogue import EFFECTS, IN_STEP_ORDER, OF_TOSSES
from rockref.effects.friction import load_dependent_friction, rolling_resistance
from rockref.engines import chosen
from rockref.engines.compiled import contact, engine, kernel, pack, points, slots
from rockref.model.simulate import simulate as law
from tests.refusal import refused

#: Their text calls `power` or `exp`, whose last bit NumPy and the C library need not share.
TRANSCENDENTAL = {"hertzian_contact", "load_dependent_friction", "stribeck_friction"}
EXACT = [id for id in slots.IN_THE_STEP if id not in TRANSCENDENTAL]
#: Every effect in the order in which it acts.
ALL = {**EFFECTS, **OF_TOSSES}


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
    assert [id for id in ALL if id in slots.IN_THE_STEP] == list(slots.IN_THE_STEP)
    assert list(EFFECTS) == [e.id for e in IN_STEP_ORDER]
    assert set(pack.FILL) == set(slots.IN_THE_STEP)


def test_constants_are_those_of_the_text():
    assert points.ARM == rolling_resistance.ARM
    assert contact.FLOOR == load_dependent_friction.FLOOR
    assert contact.SMALL == np.finfo(float).tiny / np.finfo(float).eps


@pytest.mark.parametrize("id", EXACT)
def test_alone_bit_for_bit(id):
    problem = kicked([ALL[id].typical()])
    a = law(problem)
    assert_same_bits(a, engine.simulate(problem))
    assert not np.array_equal(a.W, law(kicked([])).W), "the run must show the effect"


@pytest.mark.parametrize(
    "effect, plain",
    [
        # The way of the run is some micrometres.
        (EFFECTS["cable_restraint"](5.0, 0.3, None, 0.5, 1e-6), EFFECTS["cable_restraint"](5.0, 0.3)),
        (EFFECTS["base_vibration"](0.1, 10.0, 0.4, 0.5, 0.3, -0.2), EFFECTS["base_vibration"](0.1, 10.0, 0.4, 0.5)),
    ],
    ids=lambda effect: effect.id,
)
def test_another_form_bit_for_bit(effect, plain):
    problem = kicked([effect])
    a = law(problem)
    assert_same_bits(a, engine.simulate(problem))
    assert not np.array_equal(a.W, law(kicked([plain])).W)


@pytest.mark.parametrize("leave_out", [None, *EXACT])
def test_together_bit_for_bit(leave_out):
    problem = kicked([ALL[id].typical() for id in EXACT if id != leave_out], 1e-3)
    assert_same_bits(law(problem), engine.simulate(problem))


@pytest.mark.parametrize(
    "effect",
    [ALL[id].typical() for id in sorted(TRANSCENDENTAL)]
    # Other powers than 3/2, which is taken by a root; friction that falls at speed and rises with the load.
    + [EFFECTS["hertzian_contact"](exponent=1.3), EFFECTS["stribeck_friction"](ratio=0.6)]
    + [EFFECTS["load_dependent_friction"](exponent=-0.3)]
    # Two wires that let go more evenly, one of them within the run.
    + [EFFECTS["lingering_wire_pull"](force=3.0, tau=0.02, evenness=0.5)]
    + [EFFECTS["lingering_wire_pull"](force=3.0, tau=0.002, evenness=1.0)],
    ids=lambda effect: effect.id,
)
def test_transcendental_ones_to_a_few_units_in_the_last_place(effect):
    """One evaluation each from 40 states of a run: 4 ulp that NumPy grants itself, 1 of the C library, 3 roundings."""
    problem = kicked([effect])
    states = law(problem)
    for row in range(0, 400, 10):
        one = problem.replace(start=states.state(row), duration=1e-5)
        a, b = law(one), engine.simulate(one)
        scale = np.max(np.abs(a.F[0]), axis=-1, keepdims=True)
        assert np.all(np.abs(a.F[0] - b.F[0]) <= 8 * np.finfo(float).eps * scale)


def test_a_point_that_is_surely_held_sticks_under_its_altered_coefficient():
    """What spares exp and power: below this friction force the altered threshold is not exceeded, nor the plain one."""
    rng = np.random.default_rng(3)
    tight = 0
    for _ in range(2000):
        e = np.zeros(slots.SLOTS)
        on = [False] * len(slots.Switches._fields)
        on[slots.Switches._fields.index("stribeck")], on[slots.Switches._fields.index("load")] = rng.random(2) < 0.7
        on = slots.Switches(*on)
        e[slots.STRIBECK : slots.STRIBECK + 3] = 1, rng.uniform(0, 3), 10 ** rng.uniform(-4, -1)
        e[slots.LOAD : slots.LOAD + 3] = 1, rng.uniform(-1, 1), rng.uniform(50, 1000)
        mu, F_N = rng.uniform(0, 1), 10 ** rng.uniform(-3, 5)
        v_x, v_y = rng.normal(size=2) * 10 ** rng.uniform(-6, 0)
        held = contact.surely_held.py_func(on, e, mu, F_N)
        mu_0, altered = contact.altered_friction.py_func(on, e, mu, mu, v_x, v_y, F_N)
        assert held <= altered * F_N and held <= mu_0 * F_N and held <= mu * F_N
        tight += held > 0.99 * altered * F_N
    assert tight > 100, "the bound must be near the threshold now and then, or the test could not fail"


def test_absent_effects_leave_the_law_bit_for_bit():
    absent = [e() for e in IN_STEP_ORDER]
    assert all(e.is_absent() for e in absent)
    plain = engine.simulate(kicked([]))
    with_absent = engine.simulate(kicked(absent))
    for key in ("t", "x", "v", "Lambda", "W", "F", "anchored", "sliding"):
        np.testing.assert_array_equal(getattr(plain, key), getattr(with_absent, key))


def rows_by(groups: int, problem) -> list[np.ndarray]:
    """States and forces of a run on one variant of the loop."""
    problem = pack.with_memory(problem)
    props = pack.props_rows(problem)
    n, wanted = problem.points.n, np.arange(0, 400, 7)
    out = [np.zeros((1, len(wanted), pack.col.STATE)), np.zeros((1, len(wanted), n, 3))]
    read = (
        pack.body_row(problem), pack.centres(problem.points.P, props), props, pack.memory_rows(problem.start),
        np.zeros((n, 3)), pack.effects_row(problem), pack.state_row(problem),
    )  # fmt: skip
    kernel.LOOPS[groups](
        0, 1, *(a[None] for a in read), problem.step, np.zeros((1, 3)), wanted[None], True, *out,
        np.zeros((1, len(wanted), n, pack.col.MEMORY)), np.zeros(1, np.int64),
    )  # fmt: skip
    return out


@pytest.mark.parametrize("groups", slots.VARIANTS)
def test_every_variant_gives_the_law_where_nothing_is_on(groups):
    """What the effects add is behind their switches, also in the loops that have them."""
    problem = kicked([])
    for a, b in zip(rows_by(0, problem), rows_by(groups, problem), strict=True):
        np.testing.assert_array_equal(a, b)


@pytest.mark.parametrize("id", slots.IN_THE_STEP)
def test_an_effect_is_the_same_on_its_own_variant_and_on_that_of_all(id):
    problem = kicked([ALL[id].typical()])
    own = kernel.loop_for(pack.effects_row(problem))
    groups = next(g for g, loop in kernel.LOOPS.items() if loop is own)
    assert groups not in (0, slots.ALL)
    for a, b in zip(rows_by(groups, problem), rows_by(slots.ALL, problem), strict=True):
        np.testing.assert_array_equal(a, b)


def test_effects_of_several_groups_run_on_the_variant_of_all():
    effects = [ALL[id].typical() for id in ("hunt_crossley_contact", "quadratic_drag")]
    assert kernel.loop_for(pack.effects_row(kicked(effects))) is kernel.LOOPS[slots.ALL]
    assert kernel.loop_for(pack.effects_row(kicked([]))) is kernel.LOOPS[0]


def test_another_order_than_that_of_the_step_is_left_to_numpy():
    effects = [EFFECTS["hunt_crossley_contact"].typical(), EFFECTS["hysteretic_contact"].typical()]
    problem = kicked(effects)
    assert chosen(problem, "auto") == "numpy"
    error = refused(engine.simulate, problem)
    assert error.code == "E-TWIN"


def test_a_user_s_effect_has_no_twin_even_under_a_known_id():
    @dataclass(frozen=True)
    class Mine(EFFECTS["quadratic_drag"]):
        id: ClassVar[str] = "quadratic_drag"

    problem = kicked([Mine(c=1.0)])
    assert chosen(problem, "auto") == "numpy"
    error = refused(engine.simulate, problem)
    assert error.code == "E-TWIN" and "numpy" in error.cure


def test_uneven_normals_refuse_points_without_a_foot():
    problem = kicked([EFFECTS["uneven_contact_normals"].typical()])
    nameless = replace(problem.points, names=tuple("abcdefgh"))
    error = refused(engine.simulate, problem.replace(points=nameless))
    assert error.code == "E-FEET"
