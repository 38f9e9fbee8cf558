"""A sixth list of strangers: mistakes and correct variants in the manner of solvers and of parallel programs.

Implicit solvers change the mass and correct penetrations, tables of contacts lose the identity of a foot, threads read
what another has not written yet, a stepper fits its step to the rows. Mistakes and variants were written down, and
published, before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import E, Variant
from strangers.list_01 import Mistake
from strangers.list_04 import FOUND, MOVED, UNSTARTED
from strangers.list_05 import SUMS, TAKEN, TRIAL

ANCHOR = '            memory["s"][i],\n'
SPIN = "    turn = np.sign((Lambda @ W)[2]) * F[:, 2].sum() * 1e-3\n"

MISTAKES = (
    Mistake("corners clockwise", ("G2",), "[(1, 1), (-1, 1), (-1, -1), (1, -1)]",
            "[(1, 1), (1, -1), (-1, -1), (-1, 1)]", False),
    Mistake("tangential damping by the normal stiffness", ("P2", "P3"), "damping(beta, K_T, mass)",
            "damping(beta, K_N, mass)", False),
    Mistake("rates in the axes of the first row", ("M1",), "np.degrees(W)",
            'np.degrees(np.einsum("ji,njk,nk->ni", Lambda[0], Lambda, W))', False),
    Mistake("penetration along the height of a block that leans", ("K1",), "-u[:, 2], -rate[:, 2]",
            "-u[:, 2] / Lambda[2, 2], -rate[:, 2]"),
    Mistake("a share of the penetration corrected in each step, as a rate", ("N1", "K1"), MOVED,
            MOVED + "    xi_rate = xi_rate + 0.2 * np.maximum(xi, 0) / problem.step\n"),
    Mistake("anchors in the order of the feet that touch, without their names", ("T5",), ANCHOR,
            '            old[now[i]] if xi[i] >= 0 and now[i] < len(old) else memory["s"][i],\n',
            more=((MOVED, MOVED + '    now, old = np.cumsum(xi >= 0) - 1, memory["s"][memory["anchored"]]\n'),)),
    Mistake("no friction below a newton", ("T1", "T2"), TRIAL, TRIAL + "    F_T = F_T * (np.hypot(*F_T) > 1.0)\n"),
    Mistake("the first step of sliding has the static coefficient", ("T3", "T6"), "sliding_force(F_T, F_N, mu)\n",
            "sliding_force(F_T, F_N, mu if sliding and anchored else mu_0)\n"),
    Mistake("levers to the anchors of the feet that touch", ("A2",), SUMS,
            SUMS.replace("r,", 'np.where((xi >= 0)[:, None], [[*(c["s"] - x[:2]), k[2]] for c, k in'
                               " zip(found, r, strict=True)], r),")),
    Mistake("a moment of friction against the spin", ("A2", "A3"), f"    force, _, T = {SUMS}\n",
            f"    force, _, T = {SUMS}\n{SPIN}    T = T - Lambda.T @ [0, 0, turn]\n"),
    Mistake("dampers of the feet added to the mass, as an implicit step does", ("A1", "I4"),
            "return force / block.mass,", "return force / (block.mass + problem.step * made[1] @ (xi >= 0)),"),
    Mistake("the last foot is seen where it was a step before", ("S1", "K1"), MOVED,
            MOVED + '    xi[-1] = memory["xi"][-1] if "xi" in memory else xi[-1]\n',
            more=((FOUND, FOUND + ' | {"xi": -u[:, 2]}'),)),
    Mistake("inertia of the plate's axes as it was at the start", ("I2", "I5"), TAKEN,
            "h = problem.step\n    back = state[\"Lambda\"].T @ problem.start.Lambda\n"
            "    J = back @ problem.block.inertia @ back.T"),
    Mistake("the loads that the run before left begin the next", ("S2",), UNSTARTED,
            '    if state["a"] is None and len(state["s"]) in LEFT:\n'
            '        state |= LEFT[len(state["s"])]\n' + UNSTARTED,
            more=(("def started(", "LEFT = {}\n\n\ndef started("),
                  ("        shown = (",
                   '        LEFT[len(state["s"])] = {k: state[k] for k in ("a", "T", "F")}\n        shown = ('))),
    Mistake("a step that is made to fit the rows", ("S2", "I1"), TAKEN,
            "row, J = 1 / problem.output_rate, problem.block.inertia\n"
            "    h = row / np.ceil(row / problem.step - 1e-9)"),
)  # fmt: skip

IN_PYTHON = (
    Variant("acceleration by a matrix of masses",
            (("return force / block.mass,", "return np.linalg.solve(block.mass * np.eye(3), force),"),)),
    Variant("places by a homogeneous matrix, four by four",
            (("    u = x + r\n",
              "    G = np.block([[Lambda, x[:, None]], [np.zeros((1, 3)), np.ones((1, 1))]])\n"
              "    u = (np.column_stack([P, np.ones(len(P))]) @ G.T)[:, :3]\n"),)),
    Variant("masks in place of branches",
            (("return max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0",
              "return np.where(xi >= 0, 1.0, 0.0) * np.maximum(K_N * xi + C_N * xi_rate, 0.0)"),
             ("return s if anchored and xi >= 0 else u_t",
              "return np.where(anchored & (xi >= 0), s, u_t)"))),
    Variant("exponential by squaring that of a sixteenth",
            ((E, "t = angle / 16\n    H = H / 16\n"
              "    e = np.sin(t) / t * H + 2 * (np.sin(t / 2) / t) ** 2 * H @ H\n"
              "    for _ in range(4):\n        e = 2 * e + e @ e\n    return e"),)),
    Variant("the way since the start is kept, and the start added",
            (("    x, _, Lambda, v_p, W_p, E = first_half(*(state",
              '    way = state.get("way", np.zeros(3)) + h * (state["v"] + h / 2 * state["a"])\n'
              "    x, _, Lambda, v_p, W_p, E = first_half(*(state"),
             ("    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n",
              "    x = problem.start.x + way\n"
              "    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n"
              '    memory["way"] = way\n'))),
    Variant("inertia by eight masses at the points of Gauss",
            (("return mass / 12 * np.diag([depth**2 + height**2, width**2 + height**2, width**2 + depth**2])",
              "half = np.array([width, depth, height]) / np.sqrt(12)\n"
              "    at = np.array([[i, j, k] for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]) * half\n"
              "    return mass / 8 * (np.sum(at * at) * np.eye(3) - at.T @ at)"),)),
)  # fmt: skip
