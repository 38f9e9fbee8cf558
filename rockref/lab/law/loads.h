// What the effects on the body add to force and moment, and the plate on its spring.
#pragma once
#include "contact.h"

// Evenness up to which the pull of the wire is the exponential.
#define LEAST_EVENNESS 1e-8

typedef struct { double pull, wave; } Timed;

// What of the loads depends on the time alone: pull of the wire [N], wave of the vibration.
INLINE Timed of_time(const double *e, double t) {
  Timed timed = {0.0, 0.0};
  if (ON(e, S_WIRE)) {
    double even = e[S_WIRE + 4], left;
    if (even > LEAST_EVENNESS) left = pow(larger(1.0 - even * t / e[S_WIRE + 2], 0.0), 1.0 / even);
    else left = exp(-t / e[S_WIRE + 2]);
    timed.pull = e[S_WIRE + 1] * left;
  }
  if (ON(e, S_VIBRATION)) {
    double psi = e[S_VIBRATION + 2] * t + e[S_VIBRATION + 3], x = cos(psi), y = sin(psi);
    timed.wave = x + e[S_VIBRATION + 6] * (x * x - y * y) + e[S_VIBRATION + 7] * (2.0 * x * y);
  }
  return timed;
}

// Adds drag, cable, wire, vibration and tilt to force and moment, in the order of the step.
INLINE void add_loads(const double *e, double *F, double *M, Timed timed, double mass, double g, const double *x,
                      const double *v, const double *L, const double *o) {
  if (ON(e, S_DRAG)) {
    double turning = -e[S_DRAG + 1] * sqrt(dot(o, o)), moving = -e[S_DRAG + 2] * sqrt(dot(v, v));
    for (int i = 0; i < 3; i++) F[i] += moving * v[i], M[i] += turning * o[i];
  }
  if (ON(e, S_CABLE)) {
    double k = e[S_CABLE + 1], c = e[S_CABLE + 2], z = e[S_CABLE + 3];
    double rx = L[2] * z, ry = L[5] * z, rz = L[8] * z;
    double wx = x[0] + rx - e[S_CABLE + 4], wy = x[1] + ry - e[S_CABLE + 5];
    k = k + e[S_CABLE + 6] * (wx * wx + wy * wy);
    double fx = -k * wx - c * (v[0] + (o[1] * rz - o[2] * ry));
    double fy = -k * wy - c * (v[1] + (o[2] * rx - o[0] * rz));
    F[0] += fx, F[1] += fy, M[0] -= rz * fy, M[1] += rz * fx, M[2] += rx * fy - ry * fx;
  }
  if (ON(e, S_WIRE)) {
    double z = e[S_WIRE + 3];
    F[1] += timed.pull, M[0] -= (L[8] * z) * timed.pull, M[2] += (L[2] * z) * timed.pull;
  }
  if (ON(e, S_VIBRATION)) {
    double size = -mass * e[S_VIBRATION + 1] * timed.wave;
    F[0] += size * e[S_VIBRATION + 4], F[1] += size * e[S_VIBRATION + 5];
  }
  if (ON(e, S_TILT)) {
    double weight = mass * g, a = e[S_TILT + 1], b = e[S_TILT + 2];
    F[0] += weight * a, F[1] += weight * b, F[2] += weight * ((a * a + b * b) / 2);
  }
}

// The plate on its spring, one step on; sunk: q, q_rate, pitch, pitch_rate.
INLINE void advance_support(const double *e, double weight, double h, double carried, double turning, double *sunk) {
  const double *p = e + S_SUPPORT;
  sunk[1] = sunk[1] + h * ((weight - carried) - p[2] * sunk[0] - p[3] * sunk[1]) / p[1];
  sunk[0] = sunk[0] + h * sunk[1];
  if (p[4] != 0.0) {
    double load = p[7] - turning;
    sunk[3] = sunk[3] + h * (load - p[5] * sunk[2] - p[6] * sunk[3]) / p[4];
    sunk[2] = sunk[2] + h * sunk[3];
  }
}
