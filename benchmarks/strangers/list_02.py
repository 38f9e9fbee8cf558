"""A second list of mistakes of strangers, planted in the tutorial backend one at a time.

They were written down from the equations and the text of the tutorial, and published, before any of them was judged.
"""

from __future__ import annotations

from strangers.list_01 import Mistake

N1 = "max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0"
E = "np.sin(angle) / angle * H + 2 * (np.sin(angle / 2) / angle) ** 2 * H @ H"
TRIAL = "return -K_T * (u_t - s) - C_T * v_slide"
ANCHOR = "return s if anchored and xi >= 0 else u_t"
OPEN = """"touching": False, "sliding": False, "trace": trace}
    F_T = trial_force(u_t, s, v_slide, K_T, C_T)
    limit = cone(F_N, sliding and anchored, mu_0, mu)"""
EVALUATED = "state, x, Lambda, v_p, W_p)\n    v, W = second_half"
UNSTARTED = '    if state["a"] is None:\n'

OF_PARAMETERS = (
    Mistake("a sixth for a twelfth in the inertia", ("G1",), "mass / 12 *", "mass / 6 *", False),
    Mistake("depth not squared in the inertia", ("G1",), "[depth**2 + height**2", "[depth + height**2", False),
    Mistake("internal points raised like the external ones", ("G2",), "np.full(4, -height / 2)",
            "delta_long - height / 2", False),
    Mistake("internal points outside the corners", ("G2",), "1 - delta_diag /", "1 + delta_diag /", False),
    Mistake("damping divided by a turn", ("P2",), "2 * beta * np.sqrt", "beta / np.pi * np.sqrt", False),
    Mistake("damping ratios exchanged", ("P2", "P3"), "[beta_ext, beta_int]", "[beta_int, beta_ext]", False),
    Mistake("coefficients of friction exchanged", ("P3",), "[mu_ext, mu_int]", "[mu_int, mu_ext]", False),
    Mistake("one stiffness for both directions", ("P1",), "np.full(8, K_T)", "np.full(8, K_N)", False),
)  # fmt: skip

OF_POINTS = (
    Mistake("penetration along the height of the block", ("K1",), "-u[:, 2], -rate", "-u @ Lambda[:, 2], -rate"),
    Mistake("sliding velocity without the spin about the height", ("K1",), "rate[:, :2]",
            "(rate - np.cross([0, 0, W[2]], r))[:, :2]"),
    Mistake("half of the velocity of the turn", ("K1",), "np.cross(Lambda @ W, r)", "0.5 * np.cross(Lambda @ W, r)"),
    Mistake("rates turned back instead of forth", ("K1",), "np.cross(Lambda @ W, r)", "np.cross(Lambda.T @ W, r)"),
    Mistake("levers in single precision", ("K1",), "r = P @ Lambda.T", "r = (P @ Lambda.T).astype(np.float32) * 1.0"),
    Mistake("x and y of the sliding velocity exchanged", ("K1",), "rate[:, :2]", "rate[:, 1::-1]"),
    Mistake("damper never above the spring", ("N1",), N1, N1.replace("C_N * xi_rate", "min(C_N * xi_rate, K_N * xi)")),
    Mistake("Hertz's exponent", ("N1",), N1, N1.replace("K_N * xi", "K_N * xi * np.sqrt(max(xi, 0) / 1e-5)")),
    Mistake("normal force never above twenty kilonewtons", ("N1",), N1, N1.replace("max(", "min(2e4, max(", 1)
            .replace("0.0) if", "0.0)) if")),
    Mistake("damper with the square of the rate", ("N1",), N1, N1.replace("* xi_rate", "* xi_rate * abs(xi_rate)")),
    Mistake("no force in fast rebound", ("N1",), N1, N1.replace("xi >= 0", "xi >= 0 and xi_rate > -0.1")),
    Mistake("ten nanometres of play", ("N1",), N1, N1.replace("K_N * xi", "K_N * max(xi - 1e-8, 0.0)")),
    Mistake("contact a step ahead of the gap", ("N2",), N1, N1.replace("xi >= 0", "xi + 1e-5 * xi_rate >= 0")),
    Mistake("no damper at the first touch", ("N1", "S1"), "F_N = normal_force(xi, xi_rate, K_N, C_N)",
            "F_N = normal_force(xi, xi_rate if anchored else 0.0, K_N, C_N)"),
    Mistake("a new foot is tied half-way to its old anchor", ("T5",), ANCHOR, ANCHOR + " / 2 + s / 2"),
    Mistake("anchor creeps by a thousandth a step", ("T5", "T1"), ANCHOR,
            ANCHOR.replace("return s if", "return s + 1e-3 * (u_t - s) if")),
    Mistake("spring of friction with the other sign along y", ("T1",), TRIAL, TRIAL.replace("-K_T", "[-K_T, K_T]")),
    Mistake("tangential damper without sign", ("T1",), TRIAL, TRIAL.replace("v_slide", "np.abs(v_slide)")),
    Mistake("trial force in single precision", ("T1",), TRIAL, "return np.float32(" + TRIAL[7:] + ").astype(float)"),
    Mistake("stretch never above four micrometres", ("T1",), TRIAL,
            TRIAL.replace("(u_t - s)", "np.clip(u_t - s, -4e-6, 4e-6)")),
    Mistake("sticks up to a thousandth above the cone", ("T2",), "np.hypot(*F_trial) <= limit",
            "np.hypot(*F_trial) <= 1.001 * limit"),
    Mistake("an ellipse for the cone", ("T2",), "return np.hypot(*F_trial) <= limit",
            "return np.hypot(F_trial[0], 0.9 * F_trial[1]) <= limit"),
    Mistake("mean of both coefficients for the threshold", ("T6",), "(mu if was_sliding else mu_0)",
            "(mu if was_sliding else (mu + mu_0) / 2)"),
    Mistake("a new foot counts as sliding", ("T6",), "sliding and anchored", "sliding or not anchored"),
    Mistake("a foot that slid before it opened still slides", ("T6", "T5"), OPEN,
            OPEN.replace("False, \"trace\"", "sliding, \"trace\"").replace("sliding and anchored", "sliding")),
    Mistake("sliding force by the spring's part of the normal force", ("T3",), "sliding_force(F_T, F_N, mu)",
            "sliding_force(F_T, max(K_N * xi, 0.0), mu)"),
    Mistake("sliding force along the spring alone", ("T3",), "sliding_force(F_T, F_N, mu)",
            "sliding_force(s - u_t, F_N, mu)"),
    Mistake("friction that falls with the speed", ("T3",), "sliding_force(F_T, F_N, mu)",
            "sliding_force(F_T, F_N, mu / (1 + 0.1 * np.hypot(*v_slide)))"),
    Mistake("anchor moved with half of the damper", ("T4",), "(F_T + C_T * v_slide) / K_T",
            "(F_T + C_T * v_slide / 2) / K_T"),
    Mistake("anchor moved with the damper's other sign", ("T4",), "(F_T + C_T * v_slide) / K_T",
            "(F_T - C_T * v_slide) / K_T"),
    Mistake("anchor moved by the normal stiffness", ("T4",), "s = anchor_after(F_T, u_t, v_slide, K_T, C_T)",
            "s = anchor_after(F_T, u_t, v_slide, K_N, C_T)"),
    Mistake("a foot that slid before is not flagged again", ("T2", "T6"), '"sliding": slides, "trace"',
            '"sliding": slides and not sliding, "trace"'),
)  # fmt: skip

OF_BODIES = (
    Mistake("friction with the other sign in the sum", ("A1",), "force = F.sum(axis=0) -",
            "force = F.sum(axis=0) * [-1, -1, 1] -"),
    Mistake("buoyancy in air", ("A1",), "mass * g]", "mass * g * (1 - 1.2 / 7850)]"),
    Mistake("a thousandth of added mass", ("A1",), "return force / block.mass,",
            "return force / (1.001 * block.mass),"),
    Mistake("levers from the middle of the feet", ("A2",), "np.cross(r, F).sum", "np.cross(r - r.mean(axis=0), F).sum"),
    Mistake("no moment about the height", ("A2",), "np.cross(r, F).sum(axis=0)",
            "np.cross(r, F).sum(axis=0) * [1, 1, 0]"),
    Mistake("moment in single precision", ("A2",), "np.cross(r, F).sum(axis=0)",
            "np.cross(r, F).sum(axis=0).astype(np.float32) * 1.0"),
    Mistake("moment turned back twice", ("A3",), "moment, Lambda.T @ moment", "moment, Lambda.T @ Lambda.T @ moment"),
    Mistake("the gravity that a run is given not used", ("A1",), "block.mass, block.g)", "block.mass, 9.81)"),
    Mistake("a third for a half in the position", ("I1",), "h * h / 2 * a  # I1", "h * h / 3 * a  # I1"),
    Mistake("way of a step in single precision", ("I1",), "x + h * v + h * h / 2 * a  # I1",
            "x + (h * v + h * h / 2 * a).astype(np.float32)"),
    Mistake("half of the gyroscopic moment", ("I2",), "T - np.cross(W, J @ W)", "T - 0.5 * np.cross(W, J @ W)"),
    Mistake("increment with twice the acceleration", ("I2",), "h * h / 2 * A  # I2", "h * h * A  # I2"),
    Mistake("one cosine in the exponential", ("I3",), f"return {E}",
            "return np.sin(angle) / angle * H + (1 - np.cos(angle)) / angle * H @ H"),
    Mistake("Cayley's transform for the exponential", ("I3",), f"return {E}",
            "return np.linalg.solve(np.eye(3) - H / 2, H)"),
    Mistake("increment of the pose in single precision", ("I3",), "Lambda + Lambda @ E",
            "Lambda + Lambda @ E.astype(np.float32)"),
    Mistake("rates not predicted", ("S1",), "v + h * a, W + h * A, E", "v + h * a, W, E"),
    Mistake("forces at the place of the step before", ("S1", "K1"), EVALUATED,
            EVALUATED.replace("state, x,", 'state, state["x"],')),
    Mistake("velocity by thirds of the accelerations", ("I4",), "h / 2 * (a + a_next)", "h / 3 * (a + 2 * a_next)"),
    Mistake("the whole new moment", ("I5",), "+ h / 2 * T_next", "+ h * T_next"),
    Mistake("rates by the diagonal of the inertia", ("I5",), "np.linalg.solve(J, gain)", "gain / np.diag(J)"),
)  # fmt: skip

OF_RUNS = (
    Mistake("instants in milliseconds", ("S2",), '"t": wanted * problem.step', '"t": 1e3 * wanted * problem.step'),
    Mistake("the last row lost by rounding", ("S2",), "problem.duration / problem.step + 1e-9",
            "problem.duration / problem.step - 1e-9"),
    Mistake("every start evaluated anew", ("S2", "I1"), UNSTARTED, "    if True:\n"),
    Mistake("who slid before the start forgotten", ("S2", "T6"), UNSTARTED,
            '    state["sliding"] = np.zeros_like(state["sliding"])\n' + UNSTARTED),
    Mistake("both coefficients exchanged on the way", ("T6", "T3", "T2"), '"mu_0", "mu")', '"mu", "mu_0")'),
    Mistake("feet that slide lose their anchors", ("T5", "T4"), 'memory["anchored"][i],',
            'memory["anchored"][i] and not memory["sliding"][i],'),
    Mistake("3.1416 in the degrees", ("M1",), "np.degrees(W)", "W * 180 / 3.1416", False),
    Mistake("two axes of the gyroscope exchanged", ("M1",), "np.degrees(W)", "np.degrees(W[:, [1, 0, 2]])", False),
    Mistake("mean of a sample and the one before", ("M1",), "np.degrees(W)",
            "np.degrees((W + np.roll(W, 1, axis=0)) / 2)", False),
)  # fmt: skip

MISTAKES = OF_PARAMETERS + OF_POINTS + OF_BODIES + OF_RUNS
