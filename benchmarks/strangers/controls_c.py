"""Correct variants of the tutorial backend in C: changes of its text, and options of the compiler."""

from __future__ import annotations

from strangers.controls import Variant

IN_C = (
    Variant("the C text, fast mathematics", flags=("-O3", "-ffast-math")),
    Variant("the C text, fused multiply-add", flags=("-O3", "-march=native", "-ffp-contract=fast")),
    Variant("the C text, not optimised", flags=("-O0",)),
    Variant("the C text, extended doubles", flags=("-DREAL=long double",)),
    Variant(
        "C, direction by atan2",
        (
            ("    slides[i] = 1;", "    slides[i] = 1;\n    real to = atan2(F_i[1], F_i[0]);"),
            ("F_i[j] *= mu[i] * F_i[2] / size;", "F_i[j] = mu[i] * F_i[2] * (j ? sin(to) : cos(to));"),
        ),
    ),
    Variant(
        "C, sqrt(x*x + y*y) for a length",
        (("size = hypot(F_i[0], F_i[1])", "size = sqrt(F_i[0] * F_i[0] + F_i[1] * F_i[1])"),),
    ),
    Variant(
        "C, feet summed in an order that is drawn anew each step",
        (
            (
                "apply(L, W_, omega);\n    for (int i = 0; i < n; i++) {\n        apply(L, P",
                "apply(L, W_, omega);\n    for (int k = 0, at = rand() % n, by = rand() % 2 ? 1 : n - 1; k < n; k++)"
                " {\n        int i = (at + k * by) % n;\n        apply(L, P",
            ),
        ),
    ),
    Variant(
        "C, feet summed from the last to the first",
        (
            (
                "apply(L, W_, omega);\n    for (int i = 0; i < n; i++) {\n        apply(L, P",
                "apply(L, W_, omega);\n    for (int i = n - 1; i >= 0; i--) {\n        apply(L, P",
            ),
        ),
    ),
    Variant(
        "C, moments turned foot by foot",
        (
            ("moment[j] += arm[j];", "moment[j] += L[j] * arm[0] + L[3 + j] * arm[1] + L[6 + j] * arm[2];"),
            ("apply_transposed(L, moment, T);", "memcpy(T, moment, sizeof T);"),
        ),
    ),
    Variant(
        "C, weight as an acceleration",
        (
            ("force[3] = {0, 0, -mass * g}", "force[3] = {0, 0, 0}"),
            ("a[j] = force[j] / mass;", "a[j] = force[j] / mass - (j == 2 ? g : 0);"),
        ),
    ),
    Variant(
        "C, > for >= at zero penetration",
        (("touches[i] = xi >= 0", "touches[i] = xi > 0"), ("if (xi < 0) return;", "if (xi <= 0) return;")),
    ),
    Variant(
        "C, trial force by places times stiffness",
        (
            (
                "-K_T[i] * (u[j] - s[2 * i + j]) - C_T[i] * v_slide[j]",
                "-(C_T[i] * v_slide[j] + K_T[i] * u[j] - K_T[i] * s[2 * i + j])",
            ),
        ),
    ),
    Variant(
        "C, exponential by 1 - cos",
        (("second = t > 0 ? 2 * half * half / t : 0.5;", "second = t > 0 ? (1 - cos(size)) / t : half * 0 + 0.5;"),),
    ),
    Variant(
        "C, rates by the whole momentum, not by its gain",
        (
            ("back[j] += half[j] - JW[j] + h / 2 * T[j];", "back[j] += half[j] + h / 2 * T[j];"),
            ("W[j] += gain[j];", "W[j] = gain[j];"),
        ),
    ),
    Variant(
        "C, momentum in plate axes, never made orthogonal again",
        (
            (
                "gain[3], turn[9];",
                "gain[3], turn[9], spin[3], old[3];\n    apply(J, W, JW);\n"
                "    for (int j = 0; j < 3; j++) half[j] = JW[j] + h / 2 * T[j];\n    apply(L, half, old);",
            ),
            (
                "    apply_transposed(E, half, back);\n",
                "    apply(L, T, spin);\n    for (int j = 0; j < 3; j++) spin[j] = old[j] + h / 2 * spin[j];\n"
                "    apply_transposed(L, spin, gain), apply(J_inverse, gain, W);\n",
            ),
            (
                "        back[j] += half[j] - JW[j] + h / 2 * T[j];          "
                "                                     /* I5: what J W gains */\n",
                "",
            ),
            ("    apply(J_inverse, back, gain);\n    for (int j = 0; j < 3; j++) W[j] += gain[j];\n", ""),
        ),
    ),
    Variant(
        "C, pose made orthogonal again every step",
        (
            (
                "    for (int i = 0; i < 9; i++) L[i] += turn[i];",
                """\
    for (int i = 0; i < 9; i++) L[i] += turn[i];
    for (int i = 0; i < 3; i++) { /* Gram and Schmidt */
        for (int k = 0; k < i; k++) {
            real d = L[3 * i] * L[3 * k] + L[3 * i + 1] * L[3 * k + 1] + L[3 * i + 2] * L[3 * k + 2];
            for (int j = 0; j < 3; j++) L[3 * i + j] -= d * L[3 * k + j];
        }
        real size = sqrt(L[3 * i] * L[3 * i] + L[3 * i + 1] * L[3 * i + 1] + L[3 * i + 2] * L[3 * i + 2]);
        for (int j = 0; j < 3; j++) L[3 * i + j] /= size;
    }""",
            ),
        ),
    ),
    Variant(
        "C, a quaternion rebuilt from the matrix every step",
        (
            (
                "    for (int i = 0; i < 9; i++) L[i] += turn[i];",
                """\
    real w = sqrt(1 + L[0] + L[4] + L[8]) / 2;
    real p[3] = {(L[7] - L[5]) / (4 * w), (L[2] - L[6]) / (4 * w), (L[3] - L[1]) / (4 * w)};
    real angle = sqrt(Theta[0] * Theta[0] + Theta[1] * Theta[1] + Theta[2] * Theta[2]);
    real c = cos(angle / 2), b[3], q[4], pb[3];
    for (int j = 0; j < 3; j++) b[j] = angle > 0 ? sin(angle / 2) / angle * Theta[j] : Theta[j] / 2;
    cross(p, b, pb), q[0] = w * c - p[0] * b[0] - p[1] * b[1] - p[2] * b[2];
    for (int j = 0; j < 3; j++) q[j + 1] = w * b[j] + c * p[j] + pb[j];
    real norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int j = 0; j < 4; j++) q[j] /= norm;
    real M[9] = {1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2]),
                 2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1]),
                 2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])};
    memcpy(L, M, sizeof M);""",
            ),
        ),
    ),
    Variant(
        "C, place by Horner's form, velocity by halves",
        (
            ("x[j] += h * v[j] + h * h / 2 * a[j];", "x[j] += h * (v[j] + h / 2 * a[j]);"),
            ("v[j] += h / 2 * (a_old[j] + a[j]);", "v[j] += h / 2 * a_old[j], v[j] += h / 2 * a[j];"),
        ),
    ),
    Variant(
        "C, anchor moved by what the force lost",
        (
            ("F_i[j] *= mu[i] * F_i[2] / size;", "real star = F_i[j];\n        F_i[j] *= mu[i] * F_i[2] / size;"),
            (
                "s[2 * i + j] = u[j] + (F_i[j] + C_T[i] * v_slide[j]) / K_T[i];",
                "s[2 * i + j] += (F_i[j] - star) / K_T[i];",
            ),
        ),
    ),
    Variant(
        "C, places and velocities with compensated sums",
        (
            (
                "static void step(void) {\n",
                """\
static real lost[6];
static void add(real *to, real what, int k) {
    volatile real gain = what - lost[k], sum = *to + gain, kept = sum - *to;
    lost[k] = kept - gain, *to = sum;
}
static void step(void) {
""",
            ),
            ("x[j] += h * v[j] + h * h / 2 * a[j]; ", "add(x + j, h * v[j] + h * h / 2 * a[j], j); "),
            ("v[j] += h / 2 * (a_old[j] + a[j]); ", "add(v + j, h / 2 * (a_old[j] + a[j]), 3 + j); "),
            ("mass = plain(", "memset(lost, 0, sizeof lost), mass = plain("),
        ),
    ),
    Variant(
        "C, moments about the origin of the plate, then about the centre of mass",
        (
            (
                "cross(r, F + 3 * i, arm);",
                "real at[3] = {u[0], u[1], x[2] + r[2]};\n        cross(at, F + 3 * i, arm);",
            ),
            (
                "    for (int j = 0; j < 3; j++) a[j] = force[j] / mass;\n",
                """\
    force[2] += mass * g, cross(x, force, arm);
    for (int j = 0; j < 3; j++) moment[j] -= arm[j], a[j] = force[j] / mass - (j == 2 ? g : 0);
""",
            ),
        ),
    ),
    Variant(
        "C, the stretch of a spring by the way of its foot in each step",
        (
            (
                "-K_T[i] * (u[j] - s[2 * i + j]) - C_T[i] * v_slide[j];",
                "-K_T[i] * stretch[j] - C_T[i] * v_slide[j];",
            ),
            (
                "    F_i[0] = F_i[1] = F_i[2] = 0, touches[i] = xi >= 0, slides[i] = 0;\n",
                """\
    F_i[0] = F_i[1] = F_i[2] = 0, touches[i] = xi >= 0, slides[i] = 0;
    real stretch[2];
    for (int j = 0; j < 2; j++) {
        stretch[j] = !had_anchor ? 0 : counted ? before[2 * i + j] + (u[j] - was[2 * i + j]) : u[j] - s[2 * i + j];
        was[2 * i + j] = u[j], before[2 * i + j] = stretch[j], s[2 * i + j] = u[j] - stretch[j];
    }
""",
            ),
            (
                "/* One point: N1, N2, T1 to T6.",
                "static int counted;\nstatic real was[2 * MOST], before[2 * MOST];\n/* One point: N1, N2, T1 to T6.",
            ),
            (
                "s[2 * i + j] = u[j] + (F_i[j] + C_T[i] * v_slide[j]) / K_T[i]; ",
                "before[2 * i + j] = -(F_i[j] + C_T[i] * v_slide[j]) / K_T[i],\n"
                "        s[2 * i + j] = u[j] - before[2 * i + j]; ",
            ),
            ("    evaluate(v_p, W_p);\n", "    evaluate(v_p, W_p), counted = 1;\n"),
            ("mass = plain(", "counted = 0, mass = plain("),
        ),
    ),
    Variant(
        "C, a quaternion is the state",
        (
            (
                "static void step(void) {\n",
                """\
static real q[4];
static int known;
static void step(void) {
""",
            ),
            (
                "    for (int i = 0; i < 9; i++) L[i] += turn[i];",
                """\
    if (!known) {
        q[0] = sqrt(1 + L[0] + L[4] + L[8]) / 2, known = 1;
        q[1] = (L[7] - L[5]) / (4 * q[0]), q[2] = (L[2] - L[6]) / (4 * q[0]), q[3] = (L[3] - L[1]) / (4 * q[0]);
    }
    real angle = sqrt(Theta[0] * Theta[0] + Theta[1] * Theta[1] + Theta[2] * Theta[2]);
    real c = cos(angle / 2), b[3], pb[3], w = q[0];
    for (int j = 0; j < 3; j++) b[j] = angle > 0 ? sin(angle / 2) / angle * Theta[j] : Theta[j] / 2;
    cross(q + 1, b, pb), q[0] = w * c - q[1] * b[0] - q[2] * b[1] - q[3] * b[2];
    for (int j = 0; j < 3; j++) q[j + 1] = w * b[j] + c * q[j + 1] + pb[j];
    real norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int j = 0; j < 4; j++) q[j] /= norm;
    real M[9] = {1 - 2 * (q[2] * q[2] + q[3] * q[3]), 2 * (q[1] * q[2] - q[0] * q[3]), 2 * (q[1] * q[3] + q[0] * q[2]),
                 2 * (q[1] * q[2] + q[0] * q[3]), 1 - 2 * (q[1] * q[1] + q[3] * q[3]), 2 * (q[2] * q[3] - q[0] * q[1]),
                 2 * (q[1] * q[3] - q[0] * q[2]), 2 * (q[2] * q[3] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2])};
    memcpy(L, M, sizeof M), (void)turn;""",
            ),
            ("mass = plain(", "known = 0, mass = plain("),
        ),
    ),
)
