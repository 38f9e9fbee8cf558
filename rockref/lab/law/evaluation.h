// One force evaluation: rules K1 to A3 for all points, with the groups of effects that a variant has.
#pragma once
#include "loads.h"
#include "points.h"

// The rows of one run that do not change: body, contact points raised by their radius, properties, effects.
typedef struct {
  const double *body, *centres, *props, *e;
  int n;
} Parts;

// The pose at which forces are asked for; o: angular velocity, turn: since the last evaluation, both in plate axes;
// sunk: q, q_rate, pitch, pitch_rate of the plate.
typedef struct { const double *x, *v, *L, *o, *turn, *sunk; } Pose;

// Sums over the points: force and moment; those of each effect by itself; on the plate: moment, and with `listens` the
// normal forces and these times their lever arms.
typedef struct {
  double F[3], M[3], pull[3], viscous[5], slope[5], spin, rolled[2], turning, pressed[4];
} Sums;

typedef struct { double a[3], T[3], carried, turning, pressed[4]; } Evaluated;

// K1: lever arm of a point; its height; its velocity.
INLINE double lever_z(const double *L, const double *P, double radius) {
  return (L[6] * P[0] + L[7] * P[1] + L[8] * P[2]) - radius;
}

INLINE void lever_xy(const double *L, const double *P, double *r) {
  r[0] = L[0] * P[0] + L[1] * P[1] + L[2] * P[2], r[1] = L[3] * P[0] + L[4] * P[1] + L[5] * P[2];
}

INLINE void point_velocity(const double *v, const double *o, const double *r, double *out) {
  out[0] = v[0] + (o[1] * r[2] - o[2] * r[1]);
  out[1] = v[1] + (o[2] * r[0] - o[0] * r[2]), out[2] = v[2] + (o[0] * r[1] - o[1] * r[0]);
}

INLINE double kelvin_voigt(const double *prop, double xi, double xi_rate) {
  return prop[C_K_N] * xi + prop[C_C_N] * xi_rate; // (3.5a)
}

INLINE double without_tension(double force) { return force <= 0.0 ? 0.0 : force; } // N1

INLINE void gather(double *F, double *M, const double *f, const double *r) {
  F[0] += f[0], F[1] += f[1], F[2] += f[2];
  M[0] += r[1] * f[2] - r[2] * f[1], M[1] += r[2] * f[0] - r[0] * f[2], M[2] += r[0] * f[1] - r[1] * f[0]; // A2
}

// A point above the plate: what it remembered is gone, and only adhesion pulls.
INLINE void open_point(int groups, Parts p, Pose at, int i, double height, double *memory, double *f, Sums *s) {
  if (memory[C_ANCHORED] != 0.0) {
    memory[C_ANCHORED] = memory[C_SLIDING] = 0.0; // T5
    f[0] = f[1] = f[2] = 0.0;                     // N2
    if (groups & S_CONTACT) memory[C_XI_LARGEST] = 0.0;
    if (groups & S_MOMENTS) memory[C_YAW] = memory[C_ROLL_X] = memory[C_ROLL_Y] = 0.0;
  }
  if ((groups & S_FORCES) && ON(p.e, S_ADHESION) && height < p.e[S_ADHESION + 2]) {
    double r[2];
    lever_xy(at.L, p.centres + 3 * i, r);
    pulled(s->pull, p.e, height, r[0], r[1]);
  }
}

// What the effects at a touching point add: fz its normal force, r its lever arm, v its velocity.
INLINE void point_effects(int groups, Parts p, Pose at, int i, double height, double fz, const double *r,
                          const double *v, double *memory, Sums *s) {
  const double *e = p.e, *prop = p.props + C_PROPS * i, *L = at.L;
  if (groups & S_FORCES) {
    if (ON(e, S_ADHESION)) pulled(s->pull, e, height, r[0], r[1]);
    if (ON(e, S_VISCOUS)) pushed(s->viscous, -e[S_VISCOUS + 1] * v[0], -e[S_VISCOUS + 1] * v[1], r);
    if (ON(e, S_NORMALS)) {
      const double *of = e + S_NORMALS + 2 * (int)prop[C_FOOT];
      double a = of[-1], b = of[0], share = e[S_NORMALS + 9];
      double ta = a + share * ((L[0] * a + L[1] * b) - a), tb = b + share * ((L[3] * a + L[4] * b) - b);
      pushed(s->slope, fz * ta, fz * tb, r);
    }
  }
  if (groups & S_MOMENTS) {
    if (ON(e, S_SPIN)) s->spin += spin_moment(e, prop, memory, fz, v, at.o[2], at.turn[2]);
    if (ON(e, S_ROLLING)) {
      double m[2];
      roll_moment(e, prop, memory, fz, at.o, at.turn, m);
      s->rolled[0] += m[0], s->rolled[1] += m[1];
    }
  }
}

// One point: its force is written into f; forces and moments are added up.
INLINE void point(int groups, int listens, Parts p, Pose at, int i, double *memory, double *f, Sums *s) {
  const double *P = p.centres + 3 * i, *prop = p.props + C_PROPS * i, *x = at.x;
  double r[3], v[3];
  r[2] = lever_z(at.L, P, prop[C_RADIUS]);
  double height = x[2] + r[2];
  if (groups & S_PLATE)
    height = height - at.sunk[0] - at.sunk[2] * (x[1] + (at.L[3] * P[0] + at.L[4] * P[1] + at.L[5] * P[2]));
  if (height > 0.0) { // not touching; lost numbers count as touching, so that they show
    open_point(groups, p, at, i, height, memory, f, s);
    return;
  }
  lever_xy(at.L, P, r);
  point_velocity(at.v, at.o, r, v);
  if (groups & S_PLATE) v[2] = v[2] - at.sunk[1] - at.sunk[3] * (x[1] + r[1]);
  double fz = kelvin_voigt(prop, -height, -v[2]);
  if (groups & S_CONTACT) {
    fz = altered(p.e, fz, -height, -v[2], prop, memory);
    if (ON(p.e, S_ORIENTATION)) fz = oriented(p.e, fz, -v[2], prop, r);
  }
  f[2] = fz = without_tension(fz);
  const double u[2] = {x[0] + r[0], x[1] + r[1]};
  friction(groups & S_CONTACT, p.e, u, v, prop, memory, at.turn, fz, f);
  gather(s->F, s->M, f, r);
  if (groups & S_PLATE) s->turning += (x[1] + r[1]) * fz;
  if (listens) {
    s->pressed[0] += fz;
    for (int j = 0; j < 3; j++) s->pressed[1 + j] += fz * r[j];
  }
  point_effects(groups, p, at, i, height, fz, r, v, memory, s);
}

// Adds what the effects at the points have summed up; carried: force on the plate.
INLINE void add_point_effects(int groups, Parts p, Pose at, Sums *s, double *carried) {
  const double *e = p.e;
  if (groups & S_FORCES) {
    if (ON(e, S_ADHESION)) {
      *carried += s->pull[0], s->turning += s->pull[1] + at.x[1] * s->pull[0];
      s->F[2] += s->pull[0], s->M[0] += s->pull[1], s->M[1] += s->pull[2];
    }
    if (ON(e, S_VISCOUS)) s->F[0] += s->viscous[0], s->F[1] += s->viscous[1];
    if (ON(e, S_VISCOUS)) s->M[0] += s->viscous[2], s->M[1] += s->viscous[3], s->M[2] += s->viscous[4];
    if (ON(e, S_NORMALS)) s->F[0] += s->slope[0], s->F[1] += s->slope[1];
    if (ON(e, S_NORMALS)) s->M[0] += s->slope[2], s->M[1] += s->slope[3], s->M[2] += s->slope[4];
  }
  if (groups & S_MOMENTS) {
    if (ON(e, S_SPIN)) s->M[2] += s->spin;
    if (ON(e, S_ROLLING)) s->M[0] += s->rolled[0], s->M[1] += s->rolled[1];
  }
}

// Acceleration, body moment, and force and moment on the plate at one pose; forces and memories are written. Points
// above the plate are passed over: their forces are zero, and adding zero changes no bit.
INLINE Evaluated evaluate(int groups, int listens, Parts p, double *memories, double *forces, Timed timed, Pose at,
                          const double *W) {
  Evaluated out = {{0}, {0}, 0, 0, {0}};
  Sums s = {{0}, {0}, {0}, {0}, {0}, 0, {0}, 0, {0}};
  double o[3], mass = p.body[C_MASS], g = p.body[C_GRAVITY];
  apply(at.L, W, o);
  at.o = o;
  for (int i = 0; i < p.n; i++) point(groups, listens, p, at, i, memories + C_MEMORY * i, forces + 3 * i, &s);
  out.carried = s.F[2];
  s.F[2] -= mass * g; // A1
  add_point_effects(groups, p, at, &s, &out.carried);
  if (groups & S_LOADS) add_loads(p.e, s.F, s.M, timed, mass, g, at.x, at.v, at.L, o);
  out.turning = s.turning;
  for (int i = 0; i < 3; i++) out.a[i] = s.F[i] / mass;
  for (int i = 0; i < 4; i++) out.pressed[i] = s.pressed[i];
  apply_transposed(at.L, s.M, out.T); // A3
  return out;
}
