"""What is wrong of the start alone speaks of the run (S2), of its anchors (T5) or of the places of feet (K1); what goes
on after the start has the name of its own rule."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[5] / "benchmarks"))
from strangers.judging import Runs, seen
from strangers.list_01 import Mistake
from strangers.planting import planted

N1 = "max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0"
STARTED = "        state |= memory\n    return state\n"
FIRST = '*(state[k] for k in ("x", "Lambda", "v", "W"))'
PLACE = "x_next = x + h * v + h * h / 2 * a  # I1"
BY_ALL = (
    Mistake("half of the acceleration that a start brings", ("S2",), STARTED,
            STARTED.replace("    return", '    else:\n        state["a"] = state["a"] / 2\n    return')),
    Mistake("a third of the acceleration in the place", ("I1",), PLACE, "x_next = x + h * v + h * h / 3 * a"),
    Mistake("the first evaluation by half of the velocities", ("S2",), FIRST,
            'state["x"], state["Lambda"], state["v"] / 2, state["W"] / 2'),
    Mistake("half of the velocities in all evaluations", ("K1", "N1"), "rate = v + np.cross(Lambda @ W, r)",
            "rate = (v + np.cross(Lambda @ W, r)) / 2"),
    Mistake("half of the damper in the step of touching", ("N1",), "F_N = normal_force(xi, xi_rate, K_N, C_N)",
            "F_N = normal_force(xi, xi_rate, K_N, C_N if anchored else C_N / 2)"),
    Mistake("the anchor of the opposite foot", ("T5",), 'memory["s"][i]', 'memory["s"][i - len(r) // 2]'),
)  # fmt: skip
BY_RUNS = (
    Mistake("x of the places without its lever", ("K1",), "    u = x + r\n", "    u = x + r * [0, 1, 1]\n"),
    Mistake("half of the spring of friction", ("T1",), "-K_T * (u_t - s)", "-K_T / 2 * (u_t - s)"),
)  # fmt: skip


@pytest.mark.parametrize("mistake", BY_ALL, ids=lambda m: m.says)
def test_pieces_tell_it(mistake):
    found = seen(planted(mistake), mistake)
    assert found["named"], found


@pytest.mark.parametrize("mistake", BY_ALL + BY_RUNS, ids=lambda m: m.says)
def test_runs_tell_it(mistake):
    found = seen(Runs(planted(mistake), {}), mistake)
    assert found["named"], found
