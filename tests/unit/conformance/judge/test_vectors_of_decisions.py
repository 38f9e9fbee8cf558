"""Vectors that show a decision whatever else a foot does: pieces and runs name the rule of one that asks for more."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "benchmarks"))
from strangers.judging import Runs, seen
from strangers.list_01 import Mistake
from strangers.planting import planted

CONE = "cone(F_N, sliding and anchored, mu_0, mu)"
SLIDES = "slides = not sticks(F_T, limit)"
MISTAKES = (
    Mistake("static coefficient for a foot that sinks", ("T6",), CONE,
            "cone(F_N, sliding and anchored and xi_rate <= 0, mu_0, mu)"),
    Mistake("static coefficient for a foot that is dragged back", ("T6",), CONE,
            "cone(F_N, sliding and anchored and (u_t - s) @ v_slide >= 0, mu_0, mu)"),
    Mistake("a new foot slides beyond twice the cone", ("T2",), SLIDES,
            "slides = not sticks(F_T, limit if anchored else 4 * limit)"),
    Mistake("turns below some billionths are none", ("I3",), "    if angle == 0:\n        return H\n",
            "    if angle < 2e-9:\n        return 0 * H\n"),
    Mistake("velocity in axes that lean where it moves the place", ("I1",), "x_next = x + h * v",
            "x_next = x + h * Lambda.T @ v"),
)  # fmt: skip
#: What one point of eight shows, a first step by a moment, and a length of zero.
BY_PIECES = (
    Mistake("z of the seventh lever with the other sign", ("K1",), "    r = P @ Lambda.T\n",
            "    r = P @ Lambda.T\n    r[6:7, 2] *= -1\n"),
    Mistake("moment of the start taken for one in plate axes", ("A3",), "        state |= memory\n    return state\n",
            '        state |= memory\n    return state | {"T": state["Lambda"].T @ state["T"]}\n'),
)  # fmt: skip
BY_RUNS = (
    Mistake("no turn by rates", ("I2",), "Theta = h * W + h * h / 2 * A", "Theta = h * h / 2 * A"),
    Mistake("more than half of a turn by rates", ("I2",), "Theta = h * W + h * h / 2 * A",
            "Theta = h * W * (1 - 0.3 * (W @ W > 0)) + h * h / 2 * A"),
    Mistake("a foot at which nothing pulls slides", ("T2", "T3"), "np.hypot(*F_trial) <= limit",
            "0 < np.hypot(*F_trial) <= limit"),
    Mistake("no spring of friction", ("T1",), "-K_T * (u_t - s) - C_T", "0 * s - C_T"),
)  # fmt: skip
FOUND = "    found = [\n"
ONE_STEP = "    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n"
#: What one foot of eight, a later row, or the last digits alone show.
HARDLY_SHOWN = (
    Mistake("a coefficient of the second outer foot from an inner one", ("T3", "T6", "T2"), FOUND,
            "    made[4:, 1] = made[4:, -2]\n" + FOUND),
    Mistake("normal damper of the third outer foot from an inner one", ("N1",), FOUND,
            "    made[1, 2] = made[1, -3]\n" + FOUND),
    Mistake("x of a new anchor is not kept", ("T5",), '"s": s, "touching": True',
            '"s": s if anchored or slides else np.array([old[0], s[1]]), "touching": True', True,
            (("    s = anchor_before(xi", "    old = s\n    s = anchor_before(xi"),)),
    Mistake("velocity predicted by the mean of two accelerations", ("S1",), ONE_STEP,
            '    v_p = state["v"] + h / 2 * (state["a"] + state.get("old", state["a"]))\n' + ONE_STEP, True,
            (('"F": F, **memory}', '"F": F, "old": state["a"], **memory}'),)),
    Mistake("penetration in single precision", ("N1", "K1"), "F_N = normal_force(xi,",
            "F_N = normal_force(float(np.float32(xi)),"),
    Mistake("no foot is tied where a run begins", ("T5", "S2"), '    if state["a"] is None:\n',
            '    state["anchored"] = state["anchored"] & False\n    if state["a"] is None:\n'),
    Mistake("three quarters of the step for the pose", ("I1", "I2", "I3"), '"W", "a", "T")), h, J)\n',
            '"W", "a", "T")), 0.75 * h, J)\n', True,
            ((ONE_STEP, '    v_p, W_p = state["v"] + h * state["a"], state["W"] + (W_p - state["W"]) / 0.75\n'
              + ONE_STEP),)),
)  # fmt: skip
#: What more feet than eight, loads that differ, rows at a rate that is not whole, and a pull up and down show.
SEVERAL = (
    Mistake("no springs of friction beyond the tenth foot", ("T1", "T5"), FOUND, "    made[2, 10:] = 0\n" + FOUND),
    Mistake("threshold by the largest normal force", ("T6", "T2"), CONE, CONE.replace("F_N", "F_most"), True,
            (("C_T, mu_0, mu):\n", "C_T, mu_0, mu, F_most):\n"),
             (FOUND, "    most = max(normal_force(xi[i], xi_rate[i], *made[:2, i]) for i in range(len(r)))\n" + FOUND),
             ("*made[:, i],", "*made[:, i], most,"))),
    Mistake("rows a second rounded to whole ones", ("S2",), "np.arange(rows) / (problem.output_rate *",
            "np.arange(rows) / (np.rint(problem.output_rate) *"),
    Mistake("upwards by the new acceleration alone", ("I4",), "v_next = v + h / 2 * (a + a_next)  # I4",
            "v_next = v + h / 2 * (np.array([a[0], a[1], a_next[2]]) + a_next)"),
    Mistake("the force of what slides less its cone", ("T3",), "sliding_force(F_T, F_N, mu)\n        s",
            "F_T - mu * F_N * F_T / np.hypot(*F_T)\n        s"),
    Mistake("a drag along the rate in place of a spring", ("T1",), "return -K_T * (u_t - s) - C_T * v_slide",
            "return -(K_T * 1e-4 * np.hypot(*(u_t - s)) / 1e-5 + C_T) * np.asarray(v_slide)"),
)  # fmt: skip
#: What feet show that are told apart by their flags, their height, or their load; velocities that turn back.
OF_THEIR_OWN = (
    Mistake("who slides of the foot three on", ("T6", "S2"), 'memory["sliding"][i]', 'memory["sliding"][i - 3]'),
    Mistake("who sticks above seven tenths of the cone is flagged", ("T2", "T6"), '"sliding": slides',
            '"sliding": slides or bool(np.hypot(*F_T) > 0.7 * limit)'),
    Mistake("who falls after it rose stands", ("I4",), "v_next = v + h / 2 * (a + a_next)  # I4",
            "v_next = v + h / 2 * (a + a_next)\n    v_next = np.where((v > 0) & (v_next < 0), 0.0, v_next)"),
    Mistake("y of the velocity of the turn without its height", ("K1",), "rate = v + np.cross(Lambda @ W, r)",
            "rate = v + np.cross(Lambda @ W, r)\n    rate[:, 1] += (Lambda @ W)[0] * r[:, 2]"),
    Mistake("every foot slides", ("T2",), "np.hypot(*F_trial) <= limit", "bool(np.hypot(*F_trial) * limit < 0)"),
)  # fmt: skip


@pytest.mark.parametrize("mistake", OF_THEIR_OWN, ids=lambda m: m.says)
def test_runs_with_forces_tell_apart(mistake):
    found = seen(Runs(planted(mistake), {}), mistake)
    assert found["named"], found


def test_pieces_see_that_feet_which_touch_without_a_load_are_flagged():
    flags = Mistake("feet that push for those that touch", ("T5", "S2"), "row[k] for row in kept",
                    '(row["F"][:, 2] > 0 if k == "anchored" else row[k]) for row in kept')  # fmt: skip
    found = seen(planted(flags), flags)
    assert found["named"], found


@pytest.mark.parametrize("mistake", MISTAKES + BY_PIECES, ids=lambda m: m.says)
def test_pieces_name_it(mistake):
    found = seen(planted(mistake), mistake)
    assert found["named"], found


@pytest.mark.parametrize(
    "mistake", MISTAKES[:1] + MISTAKES[2:] + HARDLY_SHOWN + BY_RUNS + SEVERAL[:4], ids=lambda m: m.says
)
@pytest.mark.parametrize("hidden", [(), ("F", "anchored")], ids=["forces", "no forces"])
def test_runs_name_it(mistake, hidden):
    found = seen(Runs(planted(mistake), {}, hidden), mistake)
    assert found["named"], found


@pytest.mark.parametrize("mistake", SEVERAL[4:], ids=lambda m: m.says)
def test_runs_that_show_forces_name_it(mistake):
    found = seen(Runs(planted(mistake), {}), mistake)
    assert found["named"], found


def test_a_moment_that_is_right_before_it_is_turned_is_turned_wrongly():
    """Also of an upright block, where the moment of the forces is shown."""
    left = Mistake("moment left turned by a quarter", ("A3",), "return force, moment, Lambda.T @ moment",
                   "return force, moment, (Lambda.T @ moment)[[1, 2, 0]]")  # fmt: skip
    assert seen(planted(left), left)["named"]


def test_what_a_run_leaves_behind_is_told_of_another_integrator():
    begun = "        state, kept = started(problem), []\n"
    left = Mistake("velocity that the run before left", ("S2",), begun, begun + """\
        if getattr(self, "left", None) is not None:
            state = state | {"v": self.left}
""", True, (("        shown = (", '        self.left = state["v"]\n        shown = ('),))  # fmt: skip
    found = seen(Runs(planted(left, "symplectic Euler"), {}), left, "scheme")
    assert found["named"], found


def test_who_asks_whether_a_foot_slides_by_what_sliding_leaves_is_seen_by_runs():
    twice = "a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n"
    mistake = Mistake("two passes, the second with what the first left", ("T6", "S1", "T2"), twice,
                      twice + "    " + twice.replace("state,", "state | memory,"))  # fmt: skip
    found = seen(Runs(planted(mistake), {}), mistake)
    assert found["detected"] and found["named"], found
