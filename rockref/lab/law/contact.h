// Normal force and friction of one contact point; rule ids at the margin.
#pragma once
#include "layout.h"
#include "vector.h"
#define ON(e, slot) ((e)[slot] != 0.0)

// Squares below this (tiny / eps) are taken by the longer way, so that a force of 1e-170 N has a length.
#define SMALL (2.2250738585072014e-308 / 2.220446049250313e-16)
// Least normal force in parts of the reference of load-dependent friction.
#define FLOOR 1e-3
// Less than one by more than the roundings of a threshold, some 1e-15 (decided).
#define SURELY (1 - 1e-12)

INLINE double length(double x, double y) {
  double squares = x * x + y * y;
  if (squares < SMALL) {
    double most = larger(fabs(x), fabs(y));
    return most > 0 ? most * sqrt((x / most) * (x / most) + (y / most) * (y / most)) : 0.0;
  }
  return sqrt(squares);
}

// Spring and damper with the effects on the normal force, in the order of the step.
INLINE double altered(const double *e, double force, double xi, double xi_rate, const double *prop, double *memory) {
  double K = prop[C_K_N], C = prop[C_C_N];
  if (ON(e, S_HERTZ)) {
    double reference = e[S_HERTZ + 2], exponent = e[S_HERTZ + 1], depth = xi / reference;
    double power = exponent == 1.5 ? depth * sqrt(depth) : pow(depth, exponent);
    force = force + K * (reference * power - xi);
  }
  if (ON(e, S_HYSTERESIS)) {
    double kappa = e[S_HYSTERESIS + 1], share = e[S_HYSTERESIS + 2];
    memory[C_XI_LARGEST] = larger(memory[C_XI_LARGEST], xi);
    double damper = C * xi_rate, dent = kappa / (1 + kappa) * memory[C_XI_LARGEST];
    double unloading = K * (1 + kappa) * (xi - dent);
    if (share != 0.0) {
      double way = memory[C_XI_LARGEST] - dent, left = larger(xi - dent, 0.0) / (way > 0.0 ? way : 1.0);
      unloading = unloading * (1 + share * (sqrt(left) - 1));
    }
    force = larger(smaller(force - damper, unloading), 0.0) + damper;
  }
  if (ON(e, S_HUNT)) force = force + e[S_HUNT + 1] * K * xi * xi_rate;
  return force;
}

// The force with the damper that depends on how its corner is turned, after all of `altered`.
INLINE double oriented(const double *e, double force, double xi_rate, const double *prop, const double *r) {
  double z = r[2] + prop[C_RADIUS], squares = r[0] * r[0] + r[1] * r[1] + z * z;
  double tip = larger(1.5 * (z * z / (squares > 0.0 ? squares : 1.0)) - 0.5, 0.0);
  return force + e[S_ORIENTATION + 1] * tip * prop[C_C_N] * xi_rate;
}

// Both friction coefficients with the effects on them, in the order of the step.
INLINE void altered_friction(const double *e, double *mu_0, double *mu, double vx, double vy, double F_N) {
  if (ON(e, S_STRIBECK)) {
    double relative = sqrt(vx * vx + vy * vy) / e[S_STRIBECK + 2];
    double factor = 1 + (e[S_STRIBECK + 1] - 1) * exp(-(relative * relative));
    *mu_0 = *mu_0 * factor, *mu = *mu * factor;
  }
  if (ON(e, S_LOAD)) {
    double reference = e[S_LOAD + 2];
    double factor = pow(larger(F_N, FLOOR * reference) / reference, -e[S_LOAD + 1]);
    *mu_0 = *mu_0 * factor, *mu = *mu * factor;
  }
}

// A friction force [N] below which a point sticks whatever its altered coefficient is: exp and pow cost more than all
// the rest of a point, and most points are far from sliding.
INLINE double surely_held(const double *e, double mu, double F_N) {
  double held = SURELY * mu * F_N;
  if (ON(e, S_STRIBECK)) held = held * smaller(e[S_STRIBECK + 1], 1.0);
  if (ON(e, S_LOAD)) {
    double reference = e[S_LOAD + 2];
    held = held * smaller(e[S_LOAD + 1] < 0.0 ? F_N / reference : reference / F_N, 1.0);
  }
  return held;
}

// Rules T1 to T6 with a given normal force: the friction force (2); the anchor moves, the sliding is noted.
INLINE void friction(int contact, const double *e, const double *u, const double *v, const double *prop, double *memory,
                     const double *turn, double F_N, double *F) {
  double K = prop[C_K_T], C = prop[C_C_T], sx = u[0], sy = u[1]; // T5
  if (memory[C_ANCHORED] != 0.0) {
    double radius = prop[C_RADIUS];
    sx = memory[C_S_X], sy = memory[C_S_Y];
    if (radius != 0.0) sx = sx + radius * turn[1], sy = sy - radius * turn[0];
  }
  double tx = K * (sx - u[0]) - C * v[0], ty = K * (sy - u[1]) - C * v[1]; // T1
  double size = length(tx, ty), mu_0 = prop[C_MU_0], mu = prop[C_MU];
  if (contact && !(size <= surely_held(e, mu, F_N))) altered_friction(e, &mu_0, &mu, v[0], v[1], F_N);
  double limit = (memory[C_SLIDING] != 0.0 ? mu : mu_0) * F_N; // T6
  memory[C_ANCHORED] = 1.0;
  if (size <= limit) { // T2
    memory[C_S_X] = sx, memory[C_S_Y] = sy, memory[C_SLIDING] = 0.0;
    F[0] = tx, F[1] = ty;
    return;
  }
  double scale = mu * F_N / size;
  F[0] = scale * tx, F[1] = scale * ty;                                                         // T3
  memory[C_S_X] = u[0] + (F[0] + C * v[0]) / K, memory[C_S_Y] = u[1] + (F[1] + C * v[1]) / K; // T4
  memory[C_SLIDING] = 1.0;
}
