"""Mistakes of somebody whose integrator is another one: the list of `--profile scheme`.

The tutorial backend with its step exchanged for a symplectic Euler step or a midpoint step, and one mistake in it:
those of the two other lists that lie outside the law's integrator, and those of this one. Written down before any was
judged.
"""

from __future__ import annotations

from strangers.list_01 import Mistake

#: Where the step of the tutorial begins and ends.
BEGIN, END = "def advanced(problem, state):", "class Backend:"
SYMPLECTIC_EULER = '''def advanced(problem, state):
    """One step later: velocities by the loads, the pose by the new velocities, the loads there."""
    h, J = problem.step, problem.block.inertia
    v = state["v"] + h * state["a"]
    W = state["W"] + h * np.linalg.solve(J, state["T"] - np.cross(state["W"], J @ state["W"]))
    x = state["x"] + h * v
    Lambda = state["Lambda"] + state["Lambda"] @ rotation_less_identity(h * W)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v, W)
    return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}


'''
MIDPOINT = '''def advanced(problem, state):
    """One step later, by the loads in its middle."""
    h, J = problem.step, problem.block.inertia
    spin = state["W"] + h / 2 * np.linalg.solve(J, state["T"] - np.cross(state["W"], J @ state["W"]))
    v_m, turn = state["v"] + h / 2 * state["a"], rotation_less_identity(h / 2 * state["W"])
    x_m, Lambda_m = state["x"] + h / 2 * state["v"], state["Lambda"] + state["Lambda"] @ turn
    a, T, _, memory = evaluate(problem, state, x_m, Lambda_m, v_m, spin)
    v = state["v"] + h * a
    W = state["W"] + h * np.linalg.solve(J, T - np.cross(spin, J @ spin))
    x = state["x"] + h * v_m
    Lambda = state["Lambda"] + state["Lambda"] @ rotation_less_identity(h * spin)
    a, T, F, memory = evaluate(problem, memory, x, Lambda, v, W)
    return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}


'''
SCHEMES = {"symplectic Euler": SYMPLECTIC_EULER, "midpoint": MIDPOINT}
EULER = ("I2", "I5")

#: Mistakes in the step of symplectic Euler.
MISTAKES = (
    Mistake("gyroscopic moment with the other sign", EULER, '["T"] - np.cross', '["T"] + np.cross'),
    Mistake("no gyroscopic moment", EULER, ' - np.cross(state["W"], J @ state["W"])', ""),
    Mistake("gyroscopic moment with half its size", EULER, '["T"] - np.cross', '["T"] - 0.5 * np.cross'),
    Mistake("products of inertia left out", EULER, "h * np.linalg.solve(J, ", "h / np.diag(J) * np.array("),
    Mistake("gyroscopic moment of the rates alone", EULER, 'np.cross(state["W"], J @ state["W"])',
            'np.cross(state["W"], np.diag(J))'),
    Mistake("increment on the plate's side", ("I3",), 'state["Lambda"] @ rotation_less_identity(h * W)',
            'rotation_less_identity(h * W) @ state["Lambda"]'),
    Mistake("increment turned back", ("I3",), "rotation_less_identity(h * W)", "rotation_less_identity(-h * W)"),
    Mistake("turn by the rates in plate axes", ("I3",), "rotation_less_identity(h * W)",
            'rotation_less_identity(h * state["Lambda"] @ W)'),
    Mistake("half of the acceleration", ("I4", "A1"), '["v"] + h * state["a"]', '["v"] + h / 2 * state["a"]'),
    Mistake("half of the moment", ("I5", "I2", "A2", "A3"), 'solve(J, state["T"]', 'solve(J, state["T"] / 2'),
    Mistake("a percent too far", ("I1", "S2"), 'state["x"] + h * v', 'state["x"] + 1.01 * h * v'),
    Mistake("turned a thousandth too far", ("I3",), "rotation_less_identity(h * W)",
            "rotation_less_identity(1.001 * h * W)"),
)  # fmt: skip


def exchanged(source: str, scheme: str) -> str:
    """The tutorial's text with another step in it."""
    begin, end = source.index(BEGIN), source.index(END)
    return source[:begin] + SCHEMES[scheme] + source[end:]
