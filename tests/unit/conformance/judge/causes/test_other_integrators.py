"""Mistakes in other integrators have a name: by forces of the start, by sums, velocities, drifts at the stated step."""

from dataclasses import replace

import numpy as np
import pytest

from rockref.conformance import vectors
from rockref.conformance.backends import richardson, rule_set
from rockref.conformance.backends.law import NumpyEngine, RulesBackend
from rockref.conformance.backends.other_scheme import kick_and_drift
from rockref.conformance.backends.rule_set import law
from rockref.conformance.judge.causes.flags import without_lost_numbers
from rockref.conformance.judge.causes.other_integrators import gains_speed, rule_of_sixteen_steps
from rockref.conformance.judge.causes.rows_of_the_law import rows_of_the_law
from rockref.conformance.judge.compare_answer import Check, compare
from rockref.conformance.judge.findings import Findings, answered, by_finer_steps, judge
from rockref.conformance.judge.verdict import verdict
from rockref.model.contact import point_kinematics


@pytest.mark.parametrize(("share", "rule"), [(1.1, "N1"), (1.001, "A1")])
def test_normal_forces_that_are_not_those_of_springs_after_sixteen_steps_speak_of_the_force(share, rule):
    answers = []
    for v in vectors.layer("LS"):
        out = richardson.ask(NumpyEngine(), v)
        answers.append((v, out | {"F": np.asarray(out["F"]) * [[[1.0]], *[[[share]]] * (len(out["F"]) - 1)]}))
    told = next(v.id for v in vectors.layer("LS") if v.rule == "A2")
    check = Check(told, "LS", "A1", "x@1", "outside", float("inf"))
    assert rule_of_sixteen_steps(answers, [], check)[0] == rule


class Other:
    """Runs of another integrator by some rules; `shown` what of a row."""

    precision = "float64"

    def __init__(self, shown=("t", "W", "x", "Lambda", "F", "anchored"), step=kick_and_drift, **planted):
        self.name, self.shown = "another integrator", shown
        self.backend = RulesBackend(law().replace(step=step, **planted))

    def simulate(self, problem):
        rows = self.backend.simulate(problem)
        rows = rows if isinstance(rows, dict) else vars(rows)
        return {k: rows[k] for k in self.shown}


HIDDEN = ("t", "W", "x", "Lambda")


def named(backend):
    found = verdict(judge(backend, ["L5s", "LS"], "scheme"))
    return found.rule, found


def without_the_fall(x, Lambda, v, W, P):
    k, still = point_kinematics(x, Lambda, v, W, P), point_kinematics(x, Lambda, 0 * v, W, P)
    return k._replace(xi_rate=still.xi_rate)


def test_forces_of_the_start_tell_the_velocity_from_the_damper():
    rule, found = named(Other(kinematics=without_the_fall))
    assert rule == "K1" and "turns alone" in found.says, (rule, found.check)


def test_where_forces_are_hidden_dampers_that_turn_rightly_speak_of_the_velocity():
    assert named(Other(HIDDEN, kinematics=without_the_fall))[0] == "K1"


def test_where_forces_are_hidden_a_sum_without_a_foot_moves_the_block_and_turns_it_rightly():
    def force(F, mass, g):
        return law().force(F[..., :-1, :], mass, g)

    assert named(Other(HIDDEN, force=force))[0] == "A1"
    assert named(Other(HIDDEN, normal=lambda xi, rate, K, C: law().normal(xi, rate, 0.9 * K, C)))[0] == "N1"


def test_where_forces_are_right_a_sum_of_four_feet_at_a_time_shows_in_what_happens_then():
    def force(F, mass, g):
        return law().force(F[..., : F.shape[-2] // 4 * 4, :], mass, g)

    assert named(Other(force=force))[0] == "A1", "three feet carry nothing"


def dragged(rules, problem, state, inertia):
    """The step, and a hundredth of the velocity lost each second."""
    return kick_and_drift(rules, problem, replace(state, a=state.a - 0.01 * state.v), inertia)


def test_a_velocity_that_is_lost_is_no_clock():
    rule, found = named(Other(step=dragged))
    assert rule == "A1" and "faster than the steps" in found.says


@pytest.mark.parametrize(
    ("off", "changes"),
    [((0, 0, 0, 4), False), ((0, 0, 1, 2), False), ((0, 1, 2, 3), False), ((0, 1, 3, 6), True), ((0, 1, 4, 9), True)],
)
def test_a_place_that_loses_the_same_in_each_step_has_its_velocity(off, changes):
    """A place that is lost from the second step on does as well."""
    vector = next(v for v in vectors.layer("L5s") if v.id == "L5s-S2-0002")
    x = np.array([row.x for row in rows_of_the_law(vector.id)])
    lost = 0.01 * np.array(off)[:, None] * (x[1] - x[0])
    assert gains_speed([(vector, {"x": x - lost})]) is changes


def half_a_step_first(rules, problem, state, inertia):
    return kick_and_drift(rules, replace(problem, step=problem.step * (1.0 if state.count else 0.5)), state, inertia)


def test_a_first_step_that_is_too_short_is_not_extrapolated_away():
    assert named(Other(step=half_a_step_first))[0] == "S2"
    drift = next(v for v in vectors.layer("LS") if v.rule == "S2")
    assert richardson.parts_of(drift) == (1,)


@pytest.mark.parametrize("shown", [HIDDEN, (*HIDDEN, "F", "anchored")])
def test_anchors_that_turn_with_the_block_speak_of_anchors(shown):
    def step(rules, problem, state, inertia):
        after = kick_and_drift(rules, problem, state, inertia)
        turn = after.Lambda @ state.Lambda.T
        s = np.concatenate([after.s, np.zeros((len(after.s), 1))], axis=1) @ turn.T
        return replace(after, s=np.where(after.anchored[:, None], s[:, :2], after.s))

    assert named(Other(shown, step=step))[0] == "T5"


def test_where_feet_stick_rightly_a_block_that_slides_on_speaks_of_its_anchors():
    def anchor(F_T, u_t, s, *others):
        return 2 * law().anchor(F_T, u_t, s, *others) - s

    rule, found = named(Other((*HIDDEN, "F", "anchored"), anchor=anchor))
    assert rule == "T4" and "Where feet stick" in found.says, (rule, found.check)


def in_plate_axes(rules, problem, state, inertia):
    """The step, with rates that are made of the momentum in plate axes."""
    after = kick_and_drift(rules, problem, state, inertia)
    J = problem.block.inertia
    return replace(after, W=np.linalg.solve(J, after.Lambda @ J @ after.W))


def test_rates_that_jump_in_no_time_are_no_turn():
    assert named(Other(step=in_plate_axes))[0] == "I5"


def test_a_ball_that_nothing_turns_keeps_its_rates():
    def body_moment(Lambda, M):
        return rule_set.law().body_moment(Lambda, M) - 0.05

    assert named(Other(body_moment=body_moment))[0] in ("A2", "I5")


class Uneven:
    """The law's runs, that of a vector off by some bars of its place, with a sign that changes from one step to its
    half; `order` of the step by which that becomes less."""

    name, precision = "uneven", "float64"

    def __init__(self, vector, order):
        self.vector, self.order = vector, order

    def simulate(self, problem):
        rows = NumpyEngine().simulate(problem)
        rows = dict(rows) if isinstance(rows, dict) else {k: getattr(rows, k) for k in ("t", *SHOWN)}
        if problem.block.mass != self.vector.inputs["mass"] or np.any(problem.start.x != self.vector.inputs["x"]):
            return rows
        parts = float(self.vector.inputs["step"]) / problem.step
        sign = 1 if round(np.log2(parts)) % 2 == 0 else -1
        off = 5 * self.vector.expect["x@1"].bar * sign / parts**self.order
        return rows | {"x": np.array(rows["x"]) + np.array([[0.0], [1.0]]) * off}


SHOWN = ("W", "x", "Lambda", "F", "anchored")


@pytest.mark.parametrize(("order", "wrong"), [(2, False), (0, True)])
def test_what_goes_with_the_step_is_no_mistake(order, wrong):
    vector = next(v for v in vectors.layer("LS") if v.id == "LS-A1-0005")
    backend, found = Uneven(vector, order), Findings({}, "scheme", ("LS",))
    found.checks = answered(backend, vector, "scheme", found.answers)
    assert found.failures, "outside at the stated step"
    found.checks = by_finer_steps(backend, found, found.checks, compare)
    assert bool(found.failures) is wrong


@pytest.mark.parametrize(("order", "wrong"), [(2, False), (0, True)])
def test_what_goes_with_the_step_is_no_wrong_sum_of_forces_that_are_right(order, wrong):
    vector = next(v for v in vectors.layer("LS") if v.id == "LS-N1-0020")
    found = judge(Uneven(vector, order), ["LS"], "scheme")
    assert bool(found.failures) is wrong
    assert not wrong or verdict(found).rule == "A1"


def test_numbers_that_are_lost_tell_less_than_wrong_ones():
    lost = Check("LS-T2-0129", "LS", "T2", "x_T@1", "outside", float("inf"), got=float("nan"))
    wrong = replace(lost, vector="LS-T3-0149", rule="T3", worst=1e3, got=0.2)
    assert without_lost_numbers([lost, wrong]) == [wrong] and without_lost_numbers([lost]) == [lost]
    early = replace(lost, layer="L5s")
    assert without_lost_numbers([early, wrong]) == [early, wrong], "of the law's own steps the first one tells"


def half_the_velocity(rules, problem, state, inertia):
    """The step; its forces are evaluated with half of the velocities."""

    def contact(rules, problem, state, x, Lambda, v, W):
        return law().contact(rules, problem, state, x, Lambda, v / 2, W / 2)

    return kick_and_drift(rules.replace(contact=contact), problem, state, inertia)


def test_dampers_that_are_wrong_after_the_start_alone_speak_of_the_velocities_there():
    rule, found = named(Other((*HIDDEN, "F", "anchored"), step=half_the_velocity))
    assert rule == "S1" and "after a step" in found.says, (rule, found.check)
    damper = named(Other((*HIDDEN, "F", "anchored"), normal=lambda xi, rate, K, C: law().normal(xi, rate / 2, K, C)))
    assert damper[0] == "N1", "forces of the start are wrong"


def without_friction_of_sliding_feet():
    """Contact and moment: friction of feet that slide has no moment."""
    seen = []

    def contact(rules, problem, state, x, Lambda, v, W):
        made = law().contact(rules, problem, state, x, Lambda, v, W)
        seen[:] = [made[1].sliding]
        return made

    def moment(r, F):
        slides = seen[0][..., None] & np.array([True, True, False])
        return law().moment(r, np.where(slides, 0.0, F))

    return {"contact": contact, "moment": moment}


@pytest.mark.parametrize("shown", [HIDDEN, (*HIDDEN, "F", "anchored")])
def test_what_turns_otherwise_and_moves_rightly_is_the_moment_in_other_integrators_too(shown):
    rule, found = named(Other(shown, **without_friction_of_sliding_feet()))
    assert rule == "A2" and "what they turn is not" in found.says, (rule, found.says, found.check)


def test_a_place_that_makes_a_share_of_every_way_is_not_the_clock():
    """Turns are right at the same instants; where the start has another velocity, no two ways lose the same."""

    def late(rules, problem, state, inertia):
        after = kick_and_drift(rules, problem, state, inertia)
        return replace(after, x=state.x + 0.75 * (after.x - state.x))

    rule, found = named(Other(step=late))
    assert rule == "I1" and "not the clock" in found.says, (rule, found.check)


def test_where_forces_are_hidden_friction_that_turns_rightly_and_moves_otherwise_speaks_of_the_sum():
    def force(F, mass, g):
        return law().force(F * [2.0, 2.0, 1.0], mass, g)

    rule, found = named(Other(HIDDEN, force=force))
    assert rule == "A1", (rule, found.check, found.says)


def test_where_forces_are_hidden_a_slide_without_the_spin_speaks_of_the_velocity():
    def without_the_spin(x, Lambda, v, W, P):
        k, still = point_kinematics(x, Lambda, v, W, P), point_kinematics(x, Lambda, v, W * [1.0, 1.0, 0.0], P)
        return k._replace(v_slide=still.v_slide)

    rule, found = named(Other(HIDDEN, kinematics=without_the_spin))
    assert rule == "K1", (rule, found.check, found.says)


class AnchorsOfOthers(Other):
    """Anchors of the start go to other feet."""

    def simulate(self, problem):
        start = replace(problem.start, s=np.roll(problem.start.s, 3, axis=0))
        return super().simulate(replace(problem, start=start))


def test_where_forces_are_hidden_anchors_of_other_feet_are_no_sum():
    assert named(AnchorsOfOthers(HIDDEN))[0] in ("T1", "T5")
