"""A third list of mistakes of strangers, planted in the tutorial backend one at a time.

They are of other kinds than those of the two lists before: what goes wrong in C++, Julia or Rust on the way from the
documents to a program. They were written down, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.list_01 import Mistake

ROWS = """\
        state, kept = started(problem), []
        for count in range(wanted[-1] + 1):
            if count == wanted[len(kept)]:
                kept.append(state)
            if count < wanted[-1]:
                state = advanced(problem, state)
"""
#: A row is a share of the way from the step before its instant to the step after it.
BETWEEN = """\
        exact, state, kept = np.arange(rows) / (problem.output_rate * problem.step), started(problem), []
        wanted = np.floor(exact + 1e-6).astype(int)
        for count in range(wanted[-1] + 1):
            after = advanced(problem, state)
            while len(kept) < rows and count == wanted[len(kept)]:
                share = max(exact[len(kept)] - count, 0.0)
                way = {k: state[k] + share * (after[k] - state[k]) for k in ("W", "x", "Lambda", "F")}
                kept.append(way | {"anchored": state["anchored"]})
            state = after
"""
OF_PARAMETERS = (
    Mistake("stiffness in newtons a millimetre", ("P1",), "np.full(8, K_N)", "np.full(8, K_N / 1000)", False),
    Mistake("properties alternate, outer and inner", ("P2", "P3"),
            "np.repeat([beta_ext, beta_int], 4), np.repeat([mu_ext, mu_int], 4)",
            "np.tile([beta_ext, beta_int], 4), np.tile([mu_ext, mu_int], 4)", False),
)  # fmt: skip

OF_POINTS = (
    Mistake("points read column by column", ("K1",), "point_motion(x, Lambda, v, W, points.P)",
            "point_motion(x, Lambda, v, W, points.P.reshape(3, -1).T)"),
    Mistake("contact is seen a step late", ("N2", "N1", "T5"), "F_N = normal_force(xi, xi_rate, K_N, C_N)",
            "F_N = normal_force(xi, xi_rate, K_N, C_N) if anchored else 0.0"),
    Mistake("one array for the anchors of all feet", ("T5", "T4"), "np.array([c[name] for c in found]) for",
            'np.array([(found[-1] if k == "s" else c)[name] for c in found]) for'),
    Mistake("contact ends a tenth of a micrometre above the plate", ("T5", "N2"), "touching = bool(xi >= 0)",
            "touching = bool(xi >= 0 or (anchored and xi > -1e-7))"),
    Mistake("absolute value of whole numbers", ("T2",), "np.hypot(*F_trial) <= limit",
            "int(np.hypot(*F_trial)) <= limit"),
    Mistake("who has slid is flagged until it opens", ("T2", "T6"), '"sliding": slides, "trace"',
            '"sliding": slides or bool(sliding and anchored), "trace"'),
    Mistake("sliding force smoothed by the speed", ("T3",), "sliding_force(F_T, F_N, mu)",
            "sliding_force(F_T, F_N, mu * np.tanh(np.hypot(*v_slide) / 1e-3))"),
    Mistake("sliding velocity of the step before", ("S1", "K1", "T1"),
            "    made = np.array([getattr(points, k) for k in PROPERTIES])\n",
            '    *_, v_slide = point_motion(x, Lambda, memory.get("v", v), memory.get("W", W), points.P)\n'
            "    made = np.array([getattr(points, k) for k in PROPERTIES])\n"),
)  # fmt: skip

OF_BODIES = (
    Mistake("weight without the mass", ("A1",), "[0, 0, mass * g]", "[0, 0, g]"),
    Mistake("moment turned back by the attitude of the step before", ("A3", "S1"),
            "resultants(Lambda, r, F, block.mass, block.g)",
            'resultants(memory.get("Lambda", Lambda), r, F, block.mass, block.g)'),
    Mistake("place by the weight alone", ("I1",), "h * h / 2 * a  # I1", "h * h / 2 * np.array([0, 0, -9.81])  # I1"),
    Mistake("gyroscopic moment by the rates in plate axes", ("I2",), "T - np.cross(W, J @ W)",
            "T - np.cross(Lambda @ W, J @ W)"),
    Mistake("quaternion of the whole angle", ("I3",), "x, y, z = Theta", "x, y, z = 2 * np.asarray(Theta)"),
    Mistake("rates overwritten before the momentum is taken", ("I5",),
            'second_half(state["v"], state["W"], state["a"]', 'second_half(state["v"], W_p, state["a"]'),
    Mistake("forces evaluated once more by the corrected velocities", ("S1",),
            'state["a"], state["T"], a, T, h, J, E)\n    return',
            'state["a"], state["T"], a, T, h, J, E)\n'
            "    a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)\n    return"),
)  # fmt: skip

OF_RUNS = (
    Mistake("pose handed out column by column", ("S2", "I3"), "np.array([row[k] for row in kept]) for k in",
            'np.array([row[k].T if k == "Lambda" else row[k] for row in kept]) for k in'),
    Mistake("rows between two steps", ("S2",), ROWS, BETWEEN),
    Mistake("rates rounded to a hundredth of a degree", ("M1",), "np.degrees(W)", "np.round(np.degrees(W), 2)", False),
)  # fmt: skip

MISTAKES = OF_PARAMETERS + OF_POINTS + OF_BODIES + OF_RUNS
