"""The eight-point rocking block in plain NumPy, as a backend that rockref can judge. Copy it, change it, judge it:

    rockref conform examples/backend_numpy.py:Backend --quick
    rockref conform exe python examples/backend_numpy.py        (the same as a program that speaks JSON lines)

Only `simulate` is mandatory. Every other method of `Backend` is a piece that the judge asks by itself, so that it can
name the wrong equation. One function per rule; the rule's id stands in its docstring. SI units throughout; arrays are
float64.
"""

import numpy as np

# -- what follows from the parameters -------------------------------------------------------------------------------


def inertia_of_cuboid(mass, width, depth, height):
    """G1: about the centre of mass, sides along X, Y, Z, (3, 3) [kg m2]."""
    return mass / 12 * np.diag([depth**2 + height**2, width**2 + height**2, width**2 + depth**2])


def contact_points(width, depth, height, delta_long, delta_diag):
    """G2: 1ext..4ext at the corners, raised by delta_long; 1int..4int delta_diag inwards on the diagonals, (8, 3)
    [m]."""
    corners = np.array([(1, 1), (-1, 1), (-1, -1), (1, -1)]) * [width / 2, depth / 2]
    inwards = 1 - delta_diag / (np.hypot(width, depth) / 2)
    external = np.column_stack([corners, delta_long - height / 2])
    internal = np.column_stack([corners * inwards, np.full(4, -height / 2)])
    return np.concatenate([external, internal])


def damping(beta, K, mass):
    """P2 (3.8) [N s/m]."""
    return 2 * beta * np.sqrt(K * mass)


# -- one contact point ----------------------------------------------------------------------------------------------


def point_motion(x, Lambda, v, W, P):
    """K1: lever arms r and places u (n, 3) [m], penetration xi (n,) [m], its rate [m/s], sliding velocity (n, 2)
    [m/s]."""
    r = P @ Lambda.T
    u = x + r
    rate = v + np.cross(Lambda @ W, r)
    return r, u, -u[:, 2], -rate[:, 2], rate[:, :2]


def normal_force(xi, xi_rate, K_N, C_N):
    """N1 (3.5a) and N2 (3.5b): Kelvin-Voigt without tension [N]; nothing above the plate."""
    return max(K_N * xi + C_N * xi_rate, 0.0) if xi >= 0 else 0.0


def anchor_before(xi, u_t, s, anchored):
    """T5: where the spring of friction is tied; a point that touches anew is tied where it is."""
    return s if anchored and xi >= 0 else u_t


def trial_force(u_t, s, v_slide, K_T, C_T):
    """T1: the force of sticking [N]."""
    return -K_T * (u_t - s) - C_T * v_slide


def cone(F_N, was_sliding, mu_0, mu):
    """T6 (3.6): how large friction may be [N]."""
    return (mu if was_sliding else mu_0) * F_N


def sticks(F_trial, limit):
    """T2 (3.6a)."""
    return np.hypot(*F_trial) <= limit


def sliding_force(F_trial, F_N, mu):
    """T3 (3.6b): mu F_N along the trial force [N]."""
    return mu * F_N / np.hypot(*F_trial) * F_trial


def anchor_after(F_T, u_t, v_slide, K_T, C_T):
    """T4: where the spring must be tied to give the sliding force."""
    return u_t + (F_T + C_T * v_slide) / K_T


def contact_law(xi, xi_rate, u_t, v_slide, s, anchored, sliding, K_N, C_N, K_T, C_T, mu_0, mu):
    """N1 to T6 for one point, in order. `trace` shows what lies between, and is optional."""
    F_N = normal_force(xi, xi_rate, K_N, C_N)
    touching = bool(xi >= 0)
    s = anchor_before(xi, u_t, s, anchored)
    trace = {"s_trial": s, "F_trial": np.zeros(2), "threshold": 0.0}
    if not touching:
        return {"F_N": F_N, "F_T": np.zeros(2), "s": s, "touching": False, "sliding": False, "trace": trace}
    F_T = trial_force(u_t, s, v_slide, K_T, C_T)
    limit = cone(F_N, sliding and anchored, mu_0, mu)
    trace |= {"F_trial": F_T, "threshold": limit}
    slides = not sticks(F_T, limit)
    if slides:
        F_T = sliding_force(F_T, F_N, mu)
        s = anchor_after(F_T, u_t, v_slide, K_T, C_T)
    return {"F_N": F_N, "F_T": F_T, "s": s, "touching": True, "sliding": slides, "trace": trace}


# -- the body -------------------------------------------------------------------------------------------------------


def resultants(Lambda, r, F, mass, g):
    """A1 force with weight [N], A2 moment about the centre of mass [N m], plate axes; A3 the moment in body axes."""
    force = F.sum(axis=0) - [0, 0, mass * g]
    moment = np.cross(r, F).sum(axis=0)
    return force, moment, Lambda.T @ moment


def rotation_less_identity(Theta):
    """exp(Theta^) - I by Rodrigues, (3, 3)."""
    x, y, z = Theta
    H = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.sqrt(x * x + y * y + z * z)
    if angle == 0:
        return H
    return np.sin(angle) / angle * H + 2 * (np.sin(angle / 2) / angle) ** 2 * H @ H


def first_half(x, v, Lambda, W, a, T, h, J):
    """I1 to I3, and the velocities with which the contact forces are evaluated."""
    A = np.linalg.solve(J, T - np.cross(W, J @ W))
    x_next = x + h * v + h * h / 2 * a  # I1
    Theta = h * W + h * h / 2 * A  # I2
    E = rotation_less_identity(Theta)
    Lambda_next = Lambda + Lambda @ E  # I3
    return x_next, Theta, Lambda_next, v + h * a, W + h * A, E


def second_half(v, W, a, T, a_next, T_next, h, J, E):
    """I4 and I5; the momentum's gain is solved for, so that a steady rate stays what it is."""
    v_next = v + h / 2 * (a + a_next)  # I4
    half = J @ W + h / 2 * T
    gain = h / 2 * T + E.T @ half + h / 2 * T_next  # I5
    return v_next, W + np.linalg.solve(J, gain)


PROPERTIES = ("K_N", "C_N", "K_T", "C_T", "mu_0", "mu")


def evaluate(problem, memory, x, Lambda, v, W):
    """All points at one pose: acceleration, moment, point forces, and their memory (anchors and flags)."""
    points, block = problem.points, problem.block
    r, u, xi, xi_rate, v_slide = point_motion(x, Lambda, v, W, points.P)
    made = np.array([getattr(points, k) for k in PROPERTIES])
    found = [
        contact_law(
            xi[i],
            xi_rate[i],
            u[i, :2],
            v_slide[i],
            memory["s"][i],
            memory["anchored"][i],
            memory["sliding"][i],
            *made[:, i],
        )
        for i in range(len(r))
    ]
    F = np.array([[*c["F_T"], c["F_N"]] for c in found])
    force, _, T = resultants(Lambda, r, F, block.mass, block.g)
    keys = {"s": "s", "anchored": "touching", "sliding": "sliding"}
    return force / block.mass, T, F, {k: np.array([c[name] for c in found]) for k, name in keys.items()}


def started(problem):
    """The start with its first force evaluation, unless it brings one."""
    start = problem.start
    state = {k: getattr(start, k) for k in ("x", "v", "Lambda", "W", "s", "anchored", "sliding", "a", "T", "F")}
    if state["a"] is None:
        state["a"], state["T"], state["F"], memory = evaluate(
            problem, state, *(state[k] for k in ("x", "Lambda", "v", "W"))
        )
        state |= memory
    return state


def advanced(problem, state):
    """One step later."""
    h, J = problem.step, problem.block.inertia
    x, _, Lambda, v_p, W_p, E = first_half(*(state[k] for k in ("x", "v", "Lambda", "W", "a", "T")), h, J)
    a, T, F, memory = evaluate(problem, state, x, Lambda, v_p, W_p)
    v, W = second_half(state["v"], state["W"], state["a"], state["T"], a, T, h, J, E)
    return {"x": x, "v": v, "Lambda": Lambda, "W": W, "a": a, "T": T, "F": F, **memory}


class Backend:
    """What the judge sees. `simulate` is mandatory, the other methods are pieces."""

    name, version, language, precision = "tutorial, NumPy", "1", "Python", "float64"

    def simulate(self, problem):
        """A run: rows at i / output_rate, each at the nearest step."""
        last = int(np.floor(problem.duration / problem.step + 1e-9))
        rows = int(np.floor(last * problem.step * problem.output_rate + 1e-9)) + 1
        wanted = np.rint(np.arange(rows) / (problem.output_rate * problem.step)).astype(int)
        state, kept = started(problem), []
        for count in range(wanted[-1] + 1):
            if count == wanted[len(kept)]:
                kept.append(state)
            if count < wanted[-1]:
                state = advanced(problem, state)
        shown = ("W", "x", "Lambda", "F", "anchored")
        return {"t": wanted * problem.step, **{k: np.array([row[k] for row in kept]) for k in shown}}

    def step(self, problem):
        """One step from a state that brings a, T and F."""
        return advanced(problem, started(problem))

    def derived(self, mass, width, depth, height, K_N, K_T, beta_int, beta_ext, mu_int, mu_ext, delta_long, delta_diag):
        """G1, G2, P1 to P3."""
        beta, mu = np.repeat([beta_ext, beta_int], 4), np.repeat([mu_ext, mu_int], 4)
        K_N, K_T = np.full(8, K_N), np.full(8, K_T)
        return {
            "inertia": inertia_of_cuboid(mass, width, depth, height),
            "P": contact_points(width, depth, height, delta_long, delta_diag),
            **{
                "K_N": K_N,
                "K_T": K_T,
                "C_N": damping(beta, K_N, mass),
                "C_T": damping(beta, K_T, mass),
                "mu_0": mu,
                "mu": mu,
            },
        }

    def kinematics(self, x, Lambda, v, W, P):
        """K1."""
        return dict(zip(("r", "u", "xi", "xi_rate", "v_slide"), point_motion(x, Lambda, v, W, P), strict=True))

    def contact_law(self, **q):
        """N1 to T6."""
        return contact_law(**q)

    def assemble(self, Lambda, r, F, mass, g):
        """A1 to A3."""
        return dict(zip(("force", "moment", "T"), resultants(Lambda, r, F, mass, g), strict=True))

    def rotate(self, Theta):
        """The exponential of I3."""
        return {"Lambda": np.eye(3) + rotation_less_identity(Theta)}

    def integrate(self, x, v, Lambda, W, a, T, a_next, T_next, h, inertia):
        """I1 to I5 with prescribed loads."""
        *half, E = first_half(x, v, Lambda, W, a, T, h, inertia)
        v_next, W_next = second_half(v, W, a, T, a_next, T_next, h, inertia, E)
        names = ("x", "Theta", "Lambda", "v_predicted", "W_predicted")
        return dict(zip(names, half, strict=True)) | {"v": v_next, "W": W_next}

    def channel(self, W, Lambda):
        """M1: W (N, 3) [rad/s] as measured, in deg/s."""
        return {"crv_deg_s": np.degrees(W)}


if __name__ == "__main__":
    from rockref.conformance import serve

    serve(Backend())
