/* The eight-point rocking block in C, as a backend that rockref can judge: one JSON object a line, in and out.
 *
 *     cc -O2 -o backend backend.c -lm                  and then    rockref conform exe ./backend
 *     cc -O2 -DMISTAKE -o mistaken backend.c -lm       a twin with one wrong line: see what the judge says
 *     cc -O2 -DREAL=float -o single backend.c -lm      in single precision: rockref conform exe ./single --profile float32
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h> /* sqrt, sin, hypot of whatever REAL is */
#define MOST 64 /* contact points */
#ifndef REAL
#define REAL double
#endif
typedef REAL real;

static char *line;      /* the request */
static const char *sep; /* what goes before the next result */
static int n;           /* contact points */
static real mass, g, h, J[9], J_inverse[9], P[3 * MOST], K_N[MOST], C_N[MOST], K_T[MOST], C_T[MOST], mu_0[MOST], mu[MOST];
static real x[3], v[3], L[9], W[3], a[3], T[3], F[3 * MOST], s[2 * MOST], touches[MOST], slides[MOST];

/* JSON, as much as is needed: the numbers of a key (true is 1), whatever the nesting; and nested lists of numbers. */
static int get(const char *key, real *out, int most) {
    char name[64], *end;
    int depth = 0, count = 0;
    snprintf(name, sizeof name, "\"%s\":", key);
    const char *p = strstr(line, name);
    for (p = p ? p + strlen(name) : ""; *p && count < most;) {
        if (*p == '[') depth++, p++;
        else if (*p == ']') depth--, p++;
        else if (*p == ',' || *p == ' ') p++;
        else if (!strncmp(p, "true", 4)) out[count++] = 1, p += 4;
        else if (!strncmp(p, "false", 5)) out[count++] = 0, p += 5;
        else if (out[count] = strtod(p, &end), end != p) count++, p = end;
        else break;
        if (depth == 0) break;
    }
    return count;
}
static double plain(const char *key) { /* a single number in double precision: steps are counted with it */
    char name[64];
    snprintf(name, sizeof name, "\"%s\":", key);
    const char *p = strstr(line, name);
    return p ? strtod(p + strlen(name), NULL) : 0;
}
static const real *list(const real *b, const int *size, int flags) {
    if (!*size) return flags ? printf(*b ? "true" : "false") : printf("%.17g", (double)*b), b + 1;
    for (int i = 0; i < *size; i++) printf(i ? "," : "["), b = list(b, size + 1, flags);
    return printf("]"), b;
}
#define PUT(key, b, flags, ...) (printf("%s\"%s\":", sep, key), list(b, (int[]){__VA_ARGS__, 0}, flags), sep = ",")

static void cross(const real *b, const real *c, real *d) {
    d[0] = b[1] * c[2] - b[2] * c[1], d[1] = b[2] * c[0] - b[0] * c[2], d[2] = b[0] * c[1] - b[1] * c[0];
}
static void apply(const real *A, const real *b, real *c) {
    for (int i = 0; i < 3; i++) c[i] = A[3 * i] * b[0] + A[3 * i + 1] * b[1] + A[3 * i + 2] * b[2];
}
static void apply_transposed(const real *A, const real *b, real *c) {
    for (int i = 0; i < 3; i++) c[i] = A[i] * b[0] + A[3 + i] * b[1] + A[6 + i] * b[2];
}
static void invert_inertia(void) {
    real c[9];
    for (int i = 0; i < 3; i++) cross(J + 3 * ((i + 1) % 3), J + 3 * ((i + 2) % 3), c + 3 * i);
    for (int i = 0; i < 9; i++) J_inverse[i] = c[3 * (i % 3) + i / 3] / (J[0] * c[0] + J[1] * c[1] + J[2] * c[2]);
}
static void exp_minus_identity(const real *q, real *E) { /* Rodrigues */
    real t = q[0] * q[0] + q[1] * q[1] + q[2] * q[2], size = sqrt(t), half = sin(size / 2);
    real first = t > 0 ? sin(size) / size : 1, second = t > 0 ? 2 * half * half / t : 0.5;
    real H[9] = {0, -q[2], q[1], q[2], 0, -q[0], -q[1], q[0], 0}, HH[3];
    for (int j = 0; j < 3; j++) {
        apply(H, (real[]){H[j], H[3 + j], H[6 + j]}, HH); /* column j of H H */
        for (int i = 0; i < 3; i++) E[3 * i + j] = first * H[3 * i + j] + second * HH[i];
    }
}

/* One point: N1, N2, T1 to T6. Fills F_i and moves s, touches, slides of the point. */
static void contact(int i, real xi, real xi_rate, const real *u, const real *v_slide, real *F_i) {
    int had_anchor = touches[i] != 0, slid = slides[i] != 0;
    F_i[0] = F_i[1] = F_i[2] = 0, touches[i] = xi >= 0, slides[i] = 0;
    if (xi < 0) return;                                                                          /* N2, T5 */
    F_i[2] = fmax(K_N[i] * xi + C_N[i] * xi_rate, 0);                                            /* N1 */
    if (!had_anchor) s[2 * i] = u[0], s[2 * i + 1] = u[1], slid = 0;                             /* T5 */
    for (int j = 0; j < 2; j++) F_i[j] = -K_T[i] * (u[j] - s[2 * i + j]) - C_T[i] * v_slide[j];  /* T1 */
    real size = hypot(F_i[0], F_i[1]), limit = (slid ? mu[i] : mu_0[i]) * F_i[2];              /* T6 */
    if (size <= limit) return;                                                                   /* T2 */
    slides[i] = 1;
    for (int j = 0; j < 2; j++) {
#ifdef MISTAKE
        F_i[j] = fmax(-mu[i] * F_i[2], fmin(mu[i] * F_i[2], F_i[j])); /* a box, not a cone */
#else
        F_i[j] *= mu[i] * F_i[2] / size;                                                         /* T3 */
#endif
        s[2 * i + j] = u[j] + (F_i[j] + C_T[i] * v_slide[j]) / K_T[i];                           /* T4 */
    }
}

/* All points, K1 and A1 to A3: a, T, F at x, L and the velocities v_, W_. */
static void evaluate(const real *v_, const real *W_) {
    real omega[3], r[3], turning[3], arm[3], force[3] = {0, 0, -mass * g}, moment[3] = {0, 0, 0};
    apply(L, W_, omega);
    for (int i = 0; i < n; i++) {
        apply(L, P + 3 * i, r), cross(omega, r, turning);                                        /* K1 */
        real u[2] = {x[0] + r[0], x[1] + r[1]}, v_slide[2] = {v_[0] + turning[0], v_[1] + turning[1]};
        contact(i, -(x[2] + r[2]), -(v_[2] + turning[2]), u, v_slide, F + 3 * i);
        cross(r, F + 3 * i, arm);
        for (int j = 0; j < 3; j++) force[j] += F[3 * i + j], moment[j] += arm[j];               /* A1, A2 */
    }
    for (int j = 0; j < 3; j++) a[j] = force[j] / mass;
    apply_transposed(L, moment, T);                                                              /* A3 */
}
static void step(void) {
    real JW[3], gyro[3], net[3], A[3], Theta[3], E[9], v_p[3], W_p[3], a_old[3], half[3], back[3], gain[3], turn[9];
    apply(J, W, JW), cross(W, JW, gyro);
    for (int j = 0; j < 3; j++) net[j] = T[j] - gyro[j];
    apply(J_inverse, net, A);
    for (int j = 0; j < 3; j++) {
        x[j] += h * v[j] + h * h / 2 * a[j];                                                     /* I1 */
        Theta[j] = h * W[j] + h * h / 2 * A[j];                                                  /* I2 */
        v_p[j] = v[j] + h * a[j], W_p[j] = W[j] + h * A[j], a_old[j] = a[j], half[j] = JW[j] + h / 2 * T[j];
    }
    exp_minus_identity(Theta, E);
    for (int i = 0; i < 3; i++) apply_transposed(E, L + 3 * i, turn + 3 * i);
    for (int i = 0; i < 9; i++) L[i] += turn[i];                                                 /* I3 */
    evaluate(v_p, W_p);
    apply_transposed(E, half, back);
    for (int j = 0; j < 3; j++) {
        v[j] += h / 2 * (a_old[j] + a[j]);                                                       /* I4 */
        back[j] += half[j] - JW[j] + h / 2 * T[j];                                               /* I5: what J W gains */
    }
    apply(J_inverse, back, gain);
    for (int j = 0; j < 3; j++) W[j] += gain[j];
}

/* The questions. */
static void read_request(void) {
    struct { const char *key; real *to; } arrays[] = {
        {"K_N", K_N}, {"C_N", C_N}, {"K_T", K_T}, {"C_T", C_T}, {"mu_0", mu_0}, {"mu", mu}, {"s", s}, {"anchored", touches},
        {"sliding", slides}, {"F", F}, {"x", x}, {"v", v}, {"W", W}, {"Lambda", L}, {"inertia", J}, {"T", T}, {"a", a}};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) get(arrays[i].key, arrays[i].to, 3 * MOST);
    mass = plain("mass"), g = plain("g"), h = plain("step"), n = get("P", P, 3 * MOST) / 3, invert_inertia();
}
static void simulate(void) {
    if (!get("a", a, 3)) evaluate(v, W); /* the first evaluation, unless the state brings one */
    double dt = plain("step"), rate = plain("output_rate");
    long last = (long)floor(plain("duration") / dt + 1e-9), rows = (long)floor(last * dt * rate + 1e-9) + 1, done = 0;
    real *t = malloc(rows * (16 + 4 * n) * sizeof *t), *w = t + rows, *y = w + 3 * rows, *l = y + 3 * rows;
    real *f = l + 9 * rows, *c = f + 3 * n * rows;
    for (long i = 0; i < rows; i++) {
        for (long wanted = (long)floor(i / (rate * dt) + 0.5); done < wanted; done++) step();
        t[i] = done * dt, memcpy(w + 3 * i, W, sizeof W), memcpy(y + 3 * i, x, sizeof x), memcpy(l + 9 * i, L, sizeof L);
        memcpy(f + 3 * n * i, F, 3 * n * sizeof *F), memcpy(c + n * i, touches, n * sizeof *touches);
    }
    PUT("t", t, 0, rows), PUT("W", w, 0, rows, 3), PUT("x", y, 0, rows, 3), PUT("Lambda", l, 0, rows, 3, 3);
    PUT("F", f, 0, rows, n, 3), PUT("anchored", c, 1, rows, n), free(t);
}
static void one_step(void) {
    step();
    PUT("x", x, 0, 3), PUT("v", v, 0, 3), PUT("Lambda", L, 0, 3, 3), PUT("W", W, 0, 3), PUT("s", s, 0, n, 2), PUT("F", F, 0, n, 3);
    PUT("a", a, 0, 3), PUT("T", T, 0, 3), PUT("anchored", touches, 1, n), PUT("sliding", slides, 1, n);
}
static void contact_law(void) {
    real xi, xi_rate, u[2], v_slide[2], F_i[3];
    get("xi", &xi, 1), get("xi_rate", &xi_rate, 1), get("u_t", u, 2), get("v_slide", v_slide, 2);
    contact(0, xi, xi_rate, u, v_slide, F_i);
    PUT("F_N", F_i + 2, 0, 0), PUT("F_T", F_i, 0, 2), PUT("s", s, 0, 2), PUT("touching", touches, 1, 0), PUT("sliding", slides, 1, 0);
}
static void kinematics(void) {
    real omega[3], r[3 * MOST], u[3 * MOST], xi[MOST], xi_rate[MOST], v_slide[2 * MOST], turning[3];
    apply(L, W, omega);
    for (int i = 0; i < n; i++) {
        apply(L, P + 3 * i, r + 3 * i), cross(omega, r + 3 * i, turning);
        for (int j = 0; j < 3; j++) u[3 * i + j] = x[j] + r[3 * i + j];
        xi[i] = -u[3 * i + 2], xi_rate[i] = -(v[2] + turning[2]);
        v_slide[2 * i] = v[0] + turning[0], v_slide[2 * i + 1] = v[1] + turning[1];
    }
    PUT("r", r, 0, n, 3), PUT("u", u, 0, n, 3), PUT("xi", xi, 0, n), PUT("xi_rate", xi_rate, 0, n), PUT("v_slide", v_slide, 0, n, 2);
}

int main(void) {
    size_t room = 0;
    while (getline(&line, &room, stdin) > 0 && !strstr(line, "\"cmd\":\"stop\"")) {
        if (strstr(line, "\"cmd\":\"start\"")) {
            printf("{\"protocol\":1,\"name\":\"tutorial\",\"version\":\"1\",\"language\":\"C\",\"precision\":\"%s\","
                   "\"capabilities\":[\"simulate\",\"step\",\"kinematics\",\"contact_law\"]}\n", sizeof(real) == 4 ? "float32" : "float64");
        } else {
            char *id = strstr(line, "\"id\":\"") + 6, *piece = strstr(line, "\"piece\":\"") + 9;
            read_request(), sep = "";
            void (*answer)(void) = !strncmp(piece, "simulate", 8) ? simulate : !strncmp(piece, "step", 4) ? one_step
                : !strncmp(piece, "kinematics", 10) ? kinematics : !strncmp(piece, "contact_law", 11) ? contact_law : NULL;
            printf("{\"id\":\"%.*s\",", (int)strcspn(id, "\""), id);
            if (answer) printf("\"out\":{"), answer(), printf("}}\n");
            else printf("\"error\":\"no such piece\"}\n");
        }
        fflush(stdout);
    }
    return 0;
}
