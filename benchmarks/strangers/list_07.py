"""A seventh list of strangers: mistakes and correct variants in the manner of particle codes, robots, graphics.

Particle codes add up how far a foot has slid, robots smooth and clamp what they compute, graphics keep two buffers and
take the wrong one; frames are turned the other way round. Mistakes and variants were written down, and published,
before any of them was judged.
"""

from __future__ import annotations

from strangers.controls import SECOND, SUM, TURNED, E, Variant
from strangers.list_01 import SPEED, T3, Mistake
from strangers.list_04 import FOUND, MOVED, UNSTARTED
from strangers.list_05 import FORCES, TRIAL
from strangers.list_06 import ANCHOR

SLIDES = "slides = not sticks(F_T, limit)"
AFTER = "        s = anchor_after(F_T, u_t, v_slide, K_T, C_T)\n"
ONE_STEP = "a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)\n"
KEPT = "{k: np.array([c[name] for c in found]) for k, name in keys.items()}"
ADVANCED = '"F": F, **memory}'

MISTAKES = (
    # What follows from the parameters, and the channel.
    Mistake("distance on the diagonal from the middle of the base", ("G2",), "corners * inwards",
            "corners * (1 - inwards)", False),
    Mistake("rates of the plate as the block sees it", ("M1",), "np.degrees(W)", "-np.degrees(W)", False),
    # Points.
    Mistake("velocity of the turn with levers in body axes", ("K1",), "np.cross(Lambda @ W, r)",
            "np.cross(Lambda @ W, P)"),
    Mistake("rates turned by the attitude of the step before", ("K1", "S1"), MOVED,
            MOVED.replace("v, W,", 'v, Lambda.T @ memory.get("Lambda", Lambda) @ W,')),
    Mistake("rate of penetration along the height of the block", ("K1",), "-rate[:, 2], rate",
            "-rate @ Lambda[:, 2], rate"),
    Mistake("normal forces smoothed by those of the step before", ("N1", "S1"), FORCES,
            FORCES + '    if memory.get("F") is not None:\n        F[:, 2] = (F[:, 2] + memory["F"][:, 2]) / 2\n'),
    Mistake("penetration never above twenty micrometres", ("N1",), "F_N = normal_force(xi, xi_rate",
            "F_N = normal_force(min(xi, 2e-5), xi_rate"),
    Mistake("friction begins a step after the contact", ("T1", "T5"), TRIAL, TRIAL + "    F_T = F_T * anchored\n"),
    Mistake("stretch by adding up the way of each step", ("T1", "T5"), ANCHOR, "            tied[i],\n",
            more=((MOVED, MOVED + '    tied = memory["s"]\n    if memory["x"] is not x:\n'
                   '        before = (memory["x"] + points.P @ memory["Lambda"].T)[:, :2]\n'
                   "        tied = u[:, :2] - (before - tied + problem.step * v_slide)\n"),)),
    Mistake("tangential damper while the stretch grows only", ("T1",), TRIAL,
            TRIAL.replace("C_T)", "C_T * ((u_t - s) @ v_slide > 0))")),
    Mistake("a foot slower than a tenth of a millimetre a second sticks", ("T2",), SLIDES,
            SLIDES + " and np.hypot(*v_slide) > 1e-4"),
    Mistake("who slides is asked after the return to the cone", ("T2", "T6"), AFTER, AFTER + f"        {SLIDES}\n"),
    Mistake("coefficients of the foot before", ("T6", "T3", "T2"), "*made[:, i],", "*made[:4, i], *made[4:, i - 1],"),
    Mistake("length of the whole force in the direction of sliding", ("T3",), T3,
            T3.replace("np.hypot(*F_trial)", "np.hypot(np.hypot(*F_trial), F_N)")),
    Mistake("anchor of a sliding foot moved by the way of the step", ("T4", "T5"), FOUND,
            f"kept = {KEPT}\n"
            '    slid = (kept["sliding"] & memory["anchored"])[:, None]\n'
            '    kept["s"] = np.where(slid, memory["s"] + problem.step * v_slide, kept["s"])\n'
            "    return force / block.mass, T, F, kept"),
    Mistake("memory of the feet of two steps before", ("T5", "T4", "T6", "S2"), ONE_STEP,
            ONE_STEP.replace("state,", 'state | state.get("older", {}),'),
            more=((ADVANCED, '"F": F, "older": {k: state[k] for k in memory}, **memory}'),)),
    # The body.
    Mistake("friction left out of the sum of forces", ("A1",), "force = F.sum(axis=0) -",
            "force = F.sum(axis=0) * [0, 0, 1] -"),
    Mistake("levers without their height", ("A2",), "np.cross(r, F).sum(axis=0)",
            "np.cross(r * [1, 1, 0], F).sum(axis=0)"),
    Mistake("inertia turned to plate axes the wrong way round", ("I2",), SPEED,
            "Lambda.T @ " + SPEED.replace("J", "Lambda.T @ J @ Lambda").replace("T -", "Lambda @ T -")
            .replace("W", "Lambda @ W")),
    Mistake("momentum turned back by half", ("I5",), "E.T @ half + ", "E.T @ half / 2 + "),
    # The run.
    Mistake("every start at rest", ("S2",), UNSTARTED,
            '    state |= {"v": np.zeros(3), "W": np.zeros(3)}\n' + UNSTARTED),
    Mistake("rows by a stride of whole steps", ("S2",),
            "np.rint(np.arange(rows) / (problem.output_rate * problem.step)).astype(int)",
            "np.arange(rows) * max(1, int(1 / (problem.output_rate * problem.step)))"),
)  # fmt: skip

IN_PYTHON = (
    Variant("pose made orthogonal column by column",
            ((TURNED, "X, Y, _ = (Lambda + Lambda @ E).T\n    X = X / np.sqrt(X @ X)\n    Y = Y - (X @ Y) * X\n"
              "    Y = Y / np.sqrt(Y @ Y)\n    Lambda_next = np.column_stack([X, Y, np.cross(X, Y)])"),)),
    Variant("rates kept in plate axes",
            ((SECOND, SECOND.removesuffix("    return {") + "    W = Lambda.T @ (Lambda @ W)\n    return {"),)),
    Variant("stretches kept, in place of anchors",
            ((ANCHOR, "            tied[i],\n"),
             (MOVED, MOVED + '    tied = memory["s"]\n    if "stretch" in memory:\n'
              '        tied = u[:, :2] - (memory["stretch"] + (u[:, :2] - memory["u_t"]))\n'),
             (FOUND, FOUND + ' | {"stretch": np.array([u[i, :2] - c["s"] for i, c in enumerate(found)]),'
              ' "u_t": u[:, :2]}'))),
    Variant("exponential by a quarter of the angle",
            ((E, "t = np.tan(angle / 4)\n    S = t / angle * H\n"
              "    return (8 * S @ S + 4 * (1 - t * t) * S) / (1 + t * t) ** 2"),)),
    Variant("moments about the middle of the feet, moved to the centre of mass",
            ((SUM, "    middle, total = r.mean(axis=0), F.sum(axis=0)\n    force = total - [0, 0, mass * g]\n"
              "    moment = np.cross(r - middle, F).sum(axis=0) + np.cross(middle, total)\n"),)),
    Variant("places summed with what rounding took away before",
            ((ONE_STEP, '    way = h * state["v"] + h * h / 2 * state["a"] - state.get("lost", np.zeros(3))\n'
              '    x = state["x"] + way\n    lost = (x - state["x"]) - way\n'.lstrip() + "    " + ONE_STEP),
             (ADVANCED, '"F": F, "lost": lost, **memory}'))),
    Variant("empty feet fill the lanes",
            ((FORCES, FORCES + "    F, r = (np.concatenate([a, np.zeros((8, 3))]) for a in (F, r))\n"),
             (FOUND, FOUND.replace("T, F,", "T, F[: len(u)],")))),
    Variant("the weight is one more force, without a lever",
            ((SUM, "    r, F = np.concatenate([r, np.zeros((1, 3))]), np.concatenate([F, [[0, 0, -mass * g]]])\n"
              "    force, moment = F.sum(axis=0), np.cross(r, F).sum(axis=0)\n"),)),
)  # fmt: skip
