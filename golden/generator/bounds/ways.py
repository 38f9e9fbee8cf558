"""Other texts of the tutorial in C: other ways to write the law, and other integrators for the same physics.

From their runs the bars of long runs are measured: what a right program may lose by the way in which it is written, and
what a right scheme is off by at a stated step. Each is a change of the text of `backend.c`.
"""

from __future__ import annotations

Changes = tuple[tuple[str, str], ...]

#: Kept is Lambda J W, the momentum in plate axes; Lambda is never made orthogonal again.
PLATE_MOMENTUM: Changes = (
    (
        "half[3], back[3], gain[3], turn[9];\n",
        "half[3], gain[3], turn[9], spin[3], old[3];\n    apply(J, W, JW);\n"
        "    for (int j = 0; j < 3; j++) old[j] = JW[j] + h / 2 * T[j];\n    apply(L, old, spin);\n",
    ),
    (
        "    apply_transposed(E, half, back);\n",
        "    apply(L, T, old), (void)half;\n    for (int j = 0; j < 3; j++) spin[j] += h / 2 * old[j];\n"
        "    apply_transposed(L, spin, gain), apply(J_inverse, gain, W);\n",
    ),
    (
        "        back[j] += half[j] - JW[j] + h / 2 * T[j];                                               "
        "/* I5: what J W gains */\n",
        "",
    ),
    ("    apply(J_inverse, back, gain);\n    for (int j = 0; j < 3; j++) W[j] += gain[j];\n", ""),
)
#: The pose made orthogonal again every step, row by row (Gram and Schmidt).
ORTHOGONAL: Changes = (
    (
        "    for (int i = 0; i < 9; i++) L[i] += turn[i];",
        """    for (int i = 0; i < 9; i++) L[i] += turn[i];
    for (int i = 0; i < 3; i++) {
        real *row = L + 3 * i, size;
        for (int k = 0; k < i; k++) {
            real d = row[0] * L[3 * k] + row[1] * L[3 * k + 1] + row[2] * L[3 * k + 2];
            for (int j = 0; j < 3; j++) row[j] -= d * L[3 * k + j];
        }
        size = sqrt(row[0] * row[0] + row[1] * row[1] + row[2] * row[2]);
        for (int j = 0; j < 3; j++) row[j] /= size;
    }""",
    ),
)
#: The whole of J W+, not what it gains; the moment turned into body axes foot by foot; the anchor by the force lost.
OTHER_SUMS: Changes = (
    ("back[j] += half[j] - JW[j] + h / 2 * T[j];", "back[j] += half[j] + h / 2 * T[j];"),
    ("W[j] += gain[j];", "W[j] = gain[j];"),
    ("moment[j] += arm[j];", "moment[j] += L[j] * arm[0] + L[3 + j] * arm[1] + L[6 + j] * arm[2];"),
    ("apply_transposed(L, moment, T);", "memcpy(T, moment, sizeof T);"),
)
#: Feet taken from the last to the first.
REVERSED: Changes = (
    (
        "apply(L, W_, omega);\n    for (int i = 0; i < n; i++) {\n        apply(L, P",
        "apply(L, W_, omega);\n    for (int i = n - 1; i >= 0; i--) {\n        apply(L, P",
    ),
)
#: Ways to write the law, by name.
WAYS: dict[str, Changes] = {
    "plate momentum": PLATE_MOMENTUM,
    "plate momentum, reversed": PLATE_MOMENTUM + REVERSED,
    "orthogonal": ORTHOGONAL,
    "other sums": OTHER_SUMS,
    "plate momentum, orthogonal": PLATE_MOMENTUM + ORTHOGONAL,
}

#: What turns the body axes by the rates R in a time t, and what the rates gain by the moment T there.
HELP = """static void turned(const real *R, real t, real *M) {
    real q[3] = {t * R[0], t * R[1], t * R[2]}, E[9], D[9];
    exp_minus_identity(q, E);
    for (int i = 0; i < 3; i++) apply_transposed(E, M + 3 * i, D + 3 * i);
    for (int i = 0; i < 9; i++) M[i] += D[i];
}
static void kicked(real *R, const real *from, const real *at, real t) {
    real JR[3], gyro[3], net[3], A[3];
    apply(J, at, JR), cross(at, JR, gyro);
    for (int j = 0; j < 3; j++) net[j] = T[j] - gyro[j];
    apply(J_inverse, net, A);
    for (int j = 0; j < 3; j++) R[j] = from[j] + t * A[j];
}
"""
SYMPLECTIC_EULER = """static void step(void) {
    kicked(W, W, W, h);
    for (int j = 0; j < 3; j++) v[j] += h * a[j], x[j] += h * v[j];
    turned(W, h, L), evaluate(v, W);
}
"""
LEAPFROG = """static void step(void) {
    kicked(W, W, W, h / 2);
    for (int j = 0; j < 3; j++) v[j] += h / 2 * a[j], x[j] += h * v[j];
    turned(W, h, L), evaluate(v, W), kicked(W, W, W, h / 2);
    for (int j = 0; j < 3; j++) v[j] += h / 2 * a[j];
}
"""
MIDPOINT = """static void step(void) {
    real x_0[3], v_0[3], W_0[3], L_0[9], W_m[3];
    memcpy(x_0, x, sizeof x), memcpy(v_0, v, sizeof v), memcpy(W_0, W, sizeof W), memcpy(L_0, L, sizeof L);
    for (int j = 0; j < 3; j++) x[j] += h / 2 * v[j], v[j] += h / 2 * a[j];
    kicked(W_m, W, W, h / 2), turned(W, h / 2, L), evaluate(v, W_m);
    kicked(W, W_0, W_m, h), memcpy(L, L_0, sizeof L), turned(W_m, h, L);
    for (int j = 0; j < 3; j++) x[j] = x_0[j] + h * v[j], v[j] = v_0[j] + h * a[j];
    evaluate(v, W);
}
"""
ADAMS_BASHFORTH = """static int started;
static real v_b[3], W_b[3], a_b[3], A_b[3];
static void step(void) {
    real none[3] = {0, 0, 0}, A[3], mean[3];
    kicked(A, none, W, 1);
    if (!started) memcpy(v_b, v, sizeof v), memcpy(W_b, W, sizeof W);
    if (!started) memcpy(a_b, a, sizeof a), memcpy(A_b, A, sizeof A);
    for (int j = 0; j < 3; j++) {
        real v_n = v[j], W_n = W[j];
        x[j] += h / 2 * (3 * v[j] - v_b[j]), mean[j] = (3 * W[j] - W_b[j]) / 2;
        v[j] += h / 2 * (3 * a[j] - a_b[j]), W[j] += h / 2 * (3 * A[j] - A_b[j]);
        v_b[j] = v_n, W_b[j] = W_n, a_b[j] = a[j], A_b[j] = A[j];
    }
    started = 1, turned(mean, h, L), evaluate(v, W);
}
"""
#: The turn of a step by a quaternion that gains h/2 q W and is normalised: by 2 atan(h |W| / 2) for h |W|.
QUATERNION = """static void step(void) {
    real R[3], half;
    kicked(W, W, W, h), half = h / 2 * sqrt(W[0] * W[0] + W[1] * W[1] + W[2] * W[2]);
    for (int j = 0; j < 3; j++) v[j] += h * a[j], x[j] += h * v[j], R[j] = W[j] * (half > 0 ? atan(half) / half : 1);
    turned(R, h, L), evaluate(v, W);
}
"""
#: The turn of a step about one axis of the body after another, there and back, as free tops are split.
AXIS_BY_AXIS = """static void step(void) {
    static const int axis[5] = {0, 1, 2, 1, 0};
    kicked(W, W, W, h / 2);
    for (int j = 0; j < 3; j++) v[j] += h / 2 * a[j], x[j] += h * v[j];
    for (int i = 0; i < 5; i++) {
        real R[3] = {0, 0, 0};
        R[axis[i]] = W[axis[i]], turned(R, i == 2 ? h : h / 2, L);
    }
    evaluate(v, W), kicked(W, W, W, h / 2);
    for (int j = 0; j < 3; j++) v[j] += h / 2 * a[j];
}
"""
#: An integrator that looks back at the step before forgets it where the next run begins.
FORGETTING: Changes = (("mass = plain(", "started = 0, mass = plain("),)
#: Where the step of the tutorial begins and ends.
BEGIN, END = "static void step(void) {", "\n/* The questions. */"
#: The integrators from which the bars of the profile "scheme" are measured, with the law's own; None: a change.
SCHEMES: dict[str, str | None] = {
    "symplectic Euler": SYMPLECTIC_EULER,
    "leapfrog": LEAPFROG,
    "midpoint": MIDPOINT,
    "velocities before": None,
}
#: Of those of short runs others are a part, too: one that looks back a step, the first of which is a poorer one, and
#: two that do not turn by the exponential.
OF_SHORT_RUNS = (*SCHEMES, "Adams-Bashforth", "quaternion", "axis by axis")
NOT_OF_LONG_RUNS = {"Adams-Bashforth": ADAMS_BASHFORTH, "quaternion": QUATERNION, "axis by axis": AXIS_BY_AXIS}
#: The law's own step with the forces of the velocities of the step before.
VELOCITIES_BEFORE: Changes = (("evaluate(v_p, W_p);", "(void)v_p, (void)W_p, evaluate(v, W);"),)


def changed(text: str, changes: Changes) -> str:
    """Return text with each change made at its one place. Raises ValueError where there is another number of places."""
    for old, new in changes:
        if text.count(old) != 1:
            raise ValueError(f"{text.count(old)} places of {old!r}")
        text = text.replace(old, new)
    return text


def with_scheme(text: str, name: str) -> str:
    """Return the text with the step of another integrator."""
    step = (SCHEMES | NOT_OF_LONG_RUNS)[name]
    if step is None:
        return changed(text, VELOCITIES_BEFORE)
    if step is ADAMS_BASHFORTH:
        text = changed(text, FORGETTING)
    begin, end = text.index(BEGIN), text.index(END)
    return text[:begin] + HELP + step + text[end:]
