"""The law in exact arithmetic: closed forms, and agreement with the law's own text to rounding."""

import math
import random
from fractions import Fraction

import numpy as np
import pytest

from golden.generator.bounds.answers import ANSWERS
from golden.generator.bounds.arithmetic import Digits, Doubles, LongDoubles, RandomRounding, converted
from golden.generator.questions.scenes import scenes
from golden.independent import exact, exact_run
from rockref.conformance.backends.law import RulesBackend
from rockref.conformance.rules import BY_ID, ORDER, RULES, downstream

F = Fraction


def test_inertia_of_a_cube_is_a_sixth_of_m_a_squared():
    J = exact.cuboid_inertia(F(6), F(1), F(1), F(1))
    assert J == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_points_of_a_block_whose_diagonal_is_a_whole_number():
    # 3-4-5: half diagonal 2.5, inset 0.5 -> the internal points lie at 4/5 of the corners, exactly.
    class Roots:
        sqrt = staticmethod(lambda x: F(math.isqrt(int(x))))

    P = exact.contact_points(F(3), F(4), F(10), [F(1), F(2), F(3), F(4)], F(1, 2), Roots)
    assert P[0] == [F(3, 2), 2, -4] and P[2] == [F(-3, 2), -2, -2]
    assert P[4] == [F(6, 5), F(8, 5), -5] and P[7] == [F(6, 5), F(-8, 5), -5]


class Pythagoras:
    """Lengths of 3-4-5 triangles."""

    @staticmethod
    def hypot(x, y):
        square = F(x) ** 2 + F(y) ** 2
        root = F(math.isqrt(square.numerator), math.isqrt(square.denominator))
        assert root * root == square
        return root


FOOT = exact.Point(F(100), F(10), F(50), F(5), F(1, 2), F(1, 2))


def touched(**changes):
    q = {"xi": F(1), "xi_rate": F(0), "u_t": [F(0), F(0)], "v_slide": [F(0), F(0)], "s": [F(0), F(0)]}
    q |= {"anchored": True, "sliding": False} | changes
    return exact.contact(**q, point=FOOT, m=Pythagoras)


def test_normal_force_in_every_branch():
    assert touched(xi_rate=F(2)).F_N == 120
    assert touched(xi_rate=F(-4)).F_N == 60
    assert touched(xi_rate=F(-20)).F_N == 0  # would-be tension
    assert touched(xi=F(-1), xi_rate=F(100)).F_N == 0


def test_sticking_up_to_the_cone_and_on_it():
    on_the_cone = touched(s=[F(3, 5), F(4, 5)])
    assert on_the_cone.F_T == [30, 40] and not on_the_cone.sliding


def test_sliding_returns_to_the_cone_and_moves_the_anchor():
    t = touched(s=[F(6, 5), F(8, 5)], v_slide=[F(0), F(0)])
    assert t.sliding and t.F_T == [30, 40]
    assert [-50 * (0 - t.s[i]) for i in range(2)] == t.F_T


def test_a_new_touch_is_anchored_where_it_is():
    t = touched(u_t=[F(7), F(8)], s=[F(0), F(0)], anchored=False)
    assert t.F_T == [0, 0] and t.s == [7, 8]


def test_with_two_coefficients_who_slid_keeps_sliding():
    made = FOOT._replace(mu_0=F(1))
    q = {"xi": F(1), "xi_rate": F(0), "u_t": [F(0), F(0)], "v_slide": [F(0), F(0)], "s": [F(9, 10), F(12, 10)]}
    stuck = exact.contact(**q, anchored=True, sliding=False, point=made, m=Pythagoras)
    slid = exact.contact(**q, anchored=True, sliding=True, point=made, m=Pythagoras)
    assert not stuck.sliding and stuck.F_T == [45, 60]
    assert slid.sliding and slid.F_T == [30, 40]


def test_exponential_is_a_rotation_to_fifty_digits():
    m = Digits()
    L = exact.exponential([m.number(x) for x in (0.3, -1.1, 0.7)], m)
    off = exact.product(L, exact.transposed(L))
    assert max(abs(off[i][j] - (i == j)) for i in range(3) for j in range(3)) < m.number("1e-48")


def test_torque_free_step_keeps_the_momentum_in_plate_axes():
    m = Digits()
    J = converted(np.diag([0.5, 1.25, 2.0]), m.number)
    W, zero = [m.number(x) for x in (3.0, -2.0, 5.0)], [m.number(0)] * 3
    one = converted(np.eye(3), m.number)
    half = exact.first_half(zero, zero, one, W, zero, zero, m.number(2.0**-6), J, m)
    _, W_next = exact.second_half(zero, zero, zero, zero, zero, m.number(2.0**-6), J, half)
    before, after = exact.apply(J, W), exact.apply(half.Lambda, exact.apply(J, W_next))
    assert max(abs(a - b) for a, b in zip(before, after, strict=True)) < m.number("1e-47")


def test_free_fall_is_the_closed_form():
    q = scenes()["drop"].inputs
    numbers = {k: converted(v, F) for k, v in q.items() if k not in ("names", "duration", "output_rate")}
    from golden.generator.bounds.answers import body_of, start_of

    h, g = F(q["step"]), F(q["g"])
    row = list(exact_run.run(body_of(numbers), start_of(numbers), h, [5], Rational))[0]
    assert row.x[2] == F(q["x"][2]) - g * (5 * h) ** 2 / 2
    assert row.v[2] == -g * 5 * h


class Rational:
    """Enough for a block that does not turn and does not touch."""

    @staticmethod
    def sqrt(x):
        assert x == 0
        return x


def test_both_texts_of_the_law_agree_on_a_main_impact():
    # 60 steps about the first main impact of Table 3.1, float64 both: each step rounds positions of 0.34 m (6e-17) in
    # another order, times 6e7 N/m, times eight feet, over 2 kg m2 and 1e-5 s a step.
    from golden.generator.bounds.answers import body_of, start_of
    from rockref.conformance.vectors import problem_of, trajectory

    problem = trajectory("window_table_3_1_0500ms").problem
    from dataclasses import replace

    from rockref.conformance.vectors import flat

    q = flat(replace(problem, duration=60e-5, output_rate=1e5))
    numbers = {k: converted(v, float) for k, v in q.items() if k != "names"}
    rows = list(exact_run.run(body_of(numbers), start_of(numbers), 1e-5, list(range(61)), Doubles))
    law = RulesBackend().simulate(problem_of(q))
    assert np.abs(np.array([r.W for r in rows]) - law.W).max() < 1e-11
    assert np.array_equal(np.array([r.anchored for r in rows]), law.anchored)


def test_random_rounding_stays_within_an_ulp_and_leaves_exact_results_alone():
    m = RandomRounding(3)
    third = [m.number(1.0) / m.number(3.0) for _ in range(50)]
    assert {float(x) for x in third} == {1 / 3, math.nextafter(1 / 3, 1)}
    assert float(m.number(0.5) + m.number(0.25)) == 0.75
    single = RandomRounding(3, single=True)
    assert all(np.float32(float(x)) == float(x) for x in (single.number(1.0) / single.number(3.0) for _ in range(9)))


def test_random_rounding_is_reproducible():
    def course(seed):
        m = RandomRounding(seed)
        return [float(m.number(1.0) / m.number(7.0) * m.number(3.0)) for _ in range(20)]

    assert course(1) == course(1)
    assert course(1) != course(2)


@pytest.mark.parametrize("arithmetic", [Doubles, LongDoubles])
def test_every_piece_answers_in_every_arithmetic(arithmetic):
    from rockref.conformance import vectors

    rng = random.Random(0)
    for layer in ("L0", "L1", "L2", "L3", "L4", "L7"):
        v = rng.choice(vectors.layer(layer))
        q = {k: converted(x, arithmetic.number) for k, x in v.inputs.items()}
        assert set(v.expect) <= set(ANSWERS[v.piece](q, arithmetic))


def test_rule_table_is_in_the_order_of_the_flow():
    for rule in RULES:
        assert all(ORDER[need] < ORDER[rule.id] for need in rule.needs), rule.id
    assert len(BY_ID) == len(RULES)


def test_every_rule_has_its_function_and_its_docstring_says_so():
    from importlib import import_module

    for rule in RULES:
        module, _, name = rule.function.partition(":")
        function = getattr(import_module(module), name)
        if rule.id not in ("S1", "S2", "R1", "I2", "I3"):
            assert rule.id in function.__doc__, rule.id


def test_what_feeds_on_the_trial_force():
    assert {"T2", "T3", "T4", "A1", "I4", "I5"} <= downstream("T1")
    assert "N1" not in downstream("T1")
