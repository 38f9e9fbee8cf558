// The loop over the steps; the order of `rockref.model.integrator`, rule ids at the margin.
#pragma once
#include "variants.h"

// What a run carries from step to step; a, T: acceleration and body moment of the last evaluation.
typedef struct {
  double x[3], v[3], L[9], W[3], a[3], T[3], sunk[4], t, origin, count;
} Motion;

INLINE void times(const double *body, int at, const double *a, double *b) {
  if (body[C_PRINCIPAL] != 0.0)
    b[0] = body[at] * a[0], b[1] = body[at + 4] * a[1], b[2] = body[at + 8] * a[2];
  else
    apply(body + at, a, b);
}

INLINE void read_motion(const double *row, Motion *s) {
  for (int i = 0; i < 3; i++)
    s->x[i] = row[C_X + i], s->v[i] = row[C_V + i], s->W[i] = row[C_W + i], s->a[i] = row[C_A + i], s->T[i] = row[C_T + i];
  for (int i = 0; i < 9; i++) s->L[i] = row[C_L + i];
  for (int i = 0; i < 4; i++) s->sunk[i] = row[C_Q + i];
  s->t = row[C_TIME], s->origin = row[C_ORIGIN], s->count = row[C_COUNT];
}

INLINE void write_motion(const Motion *s, double *row) {
  for (int i = 0; i < 3; i++)
    row[C_X + i] = s->x[i], row[C_V + i] = s->v[i], row[C_W + i] = s->W[i], row[C_A + i] = s->a[i], row[C_T + i] = s->T[i];
  for (int i = 0; i < 9; i++) row[C_L + i] = s->L[i];
  for (int i = 0; i < 4; i++) row[C_Q + i] = s->sunk[i];
  row[C_GIVEN] = 1.0, row[C_TIME] = s->t, row[C_ORIGIN] = s->origin, row[C_COUNT] = s->count;
}

// The first force evaluation of a run: a and T at the start; forces and memories are written.
INLINE void begin(int groups, Parts p, double *memory, double *forces, Motion *s) {
  const double still[3] = {0, 0, 0};
  Timed timed = {0.0, 0.0};
  for (int i = 0; i < 3 * p.n; i++) forces[i] = 0.0;
  if (groups & S_LOADS) timed = of_time(p.e, s->t);
  Pose at = {s->x, s->v, s->L, 0, still, s->sunk};
  Evaluated out = evaluate(groups, 0, p, memory, forces, timed, at, s->W);
  for (int i = 0; i < 3; i++) s->a[i] = out.a[i], s->T[i] = out.T[i];
  for (int i = 0; i < p.n; i++) // only a touching point slides and remembers, whatever the start says
    if (memory[C_MEMORY * i + C_ANCHORED] == 0.0)
      for (int j = C_SLIDING; j < C_MEMORY; j++) memory[C_MEMORY * i + j] = 0.0;
}

// What the first half of a step hands to the second.
typedef struct { double JW[3], E[9], turn[3], v[3], W[3]; } Half;

// Rules I1 to I3: pose one step later, and the velocities predicted for the forces there.
INLINE Half first_half(const double *body, double h, Motion *s) {
  const double half_square = h * h / 2;
  double A[3], Theta[3], moment[3];
  Half m;
  times(body, C_J, s->W, m.JW);
  cross(s->W, m.JW, moment);
  for (int i = 0; i < 3; i++) moment[i] = s->T[i] - moment[i];
  times(body, C_J_INVERSE, moment, A);
  for (int i = 0; i < 3; i++) {
    s->x[i] = s->x[i] + h * s->v[i] + half_square * s->a[i]; // I1
    Theta[i] = h * s->W[i] + half_square * A[i];             // I2
  }
  exp_minus_identity(Theta, m.E);
  apply(s->L, Theta, m.turn);
  for (int i = 0; i < 3; i++) turned(s->L + 3 * i, m.E, s->L + 3 * i); // I3
  for (int i = 0; i < 3; i++) m.v[i] = s->v[i] + h * s->a[i], m.W[i] = s->W[i] + h * A[i];
  return m;
}

// Rules I4 and I5, with acceleration and body moment at the new pose.
INLINE void second_half(const double *body, double h, const Half *m, const double *a, const double *T, Motion *s) {
  const double half = h / 2;
  double kept[3], gained[3], change[3];
  for (int i = 0; i < 3; i++) {
    s->v[i] = s->v[i] + half * (s->a[i] + a[i]); // I4
    s->a[i] = a[i];
    kept[i] = m->JW[i] + half * s->T[i];
  }
  turned(kept, m->E, gained);
  for (int i = 0; i < 3; i++) gained[i] = (gained[i] + half * T[i]) - m->JW[i];
  times(body, C_J_INVERSE, gained, change);
  for (int i = 0; i < 3; i++) s->W[i] = s->W[i] + change[i], s->T[i] = T[i]; // I5
}

// One step of length h. pressed (4): normal force, and that times its lever arms, added up.
INLINE void step(int groups, int listens, Parts p, double *memory, double *forces, double h, Motion *s, double *pressed) {
  Timed timed = {0.0, 0.0};
  s->count += 1.0;
  s->t = s->origin + s->count * h;
  if (groups & S_LOADS) timed = of_time(p.e, s->t);
  Half m = first_half(p.body, h, s);
  Pose at = {s->x, m.v, s->L, 0, m.turn, s->sunk};
  Evaluated out = evaluate(groups, listens, p, memory, forces, timed, at, m.W);
  if ((groups & S_PLATE) && ON(p.e, S_SUPPORT))
    advance_support(p.e, p.body[C_MASS] * p.body[C_GRAVITY], h, out.carried, out.turning, s->sunk);
  second_half(p.body, h, &m, out.a, out.T, s);
  if (listens)
    for (int i = 0; i < 4; i++) pressed[i] += out.pressed[i];
}

// All steps of a run; returns the number of rows written. A run ends with the first row without numbers.
INLINE int run(int groups, Parts p, double *memory, double *forces, Motion s, int given, double h, Rows rows) {
  int done = 0;
  if (!given) begin(groups, p, memory, forces, &s);
  for (int row = 0; row < rows.count; row++) {
    for (; done < rows.wanted[row]; done++) step(groups, 0, p, memory, forces, h, &s, 0);
    write_motion(&s, rows.states + (long)C_STATE * row);
    if (rows.forces)
      for (int i = 0; i < 3 * p.n; i++) rows.forces[(long)3 * p.n * row + i] = forces[i];
    if (rows.memory)
      for (int i = 0; i < C_MEMORY * p.n; i++) rows.memory[(long)C_MEMORY * p.n * row + i] = memory[i];
    double sum = (s.x[0] + s.x[1] + s.x[2]) + (s.v[0] + s.v[1] + s.v[2]) + (s.W[0] + s.W[1] + s.W[2]);
    if (!(sum - sum == 0.0)) return row + 1;
  }
  return rows.count;
}

// The part of the weight below which a tick makes no correction of the place (decided).
#define LEAST_PRESSED 0.02

// Pulls rates and attitude toward the target by a turn about the loaded place, which tears no contact.
INLINE void correct(Parts p, double *memory, int steps, const double *pressed, const double *rates,
                    const double *attitude, Target of, Motion *s) {
  double dW[3], dTheta[3], D[9], spun[3], turn[3], place[3], change[3], E[9];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      D[3 * i + j] = s->L[i] * attitude[j] + s->L[3 + i] * attitude[3 + j] + s->L[6 + i] * attitude[6 + j];
  const double skew[3] = {D[7] - D[5], D[2] - D[6], D[3] - D[1]};
  for (int i = 0; i < 3; i++) {
    dW[i] = of.share_rates * (rates[i] - s->W[i]);
    dTheta[i] = of.share_attitude * 0.5 * skew[i];
  }
  if (pressed[0] > LEAST_PRESSED * steps * p.body[C_MASS] * p.body[C_GRAVITY]) {
    for (int i = 0; i < 3; i++) place[i] = pressed[1 + i] / pressed[0];
    apply(s->L, dW, spun);
    cross(spun, place, change);
    for (int i = 0; i < 3; i++) s->v[i] -= change[i];
    apply(s->L, dTheta, turn);
    cross(turn, place, change);
    for (int i = 0; i < 3; i++) s->x[i] -= change[i];
    for (int k = 0; k < p.n; k++) {
      double *m = memory + C_MEMORY * k, r[3];
      if (m[C_ANCHORED] == 0.0) continue;
      apply(s->L, p.centres + 3 * k, r); // the anchors go with the feet: a correction is no slip
      r[2] -= p.props[C_PROPS * k + C_RADIUS];
      for (int i = 0; i < 3; i++) r[i] -= place[i];
      cross(turn, r, change);
      m[C_S_X] += change[0], m[C_S_Y] += change[1];
    }
  }
  for (int i = 0; i < 3; i++) s->W[i] += dW[i];
  exp_minus_identity(dTheta, E);
  for (int i = 0; i < 3; i++) turned(s->L + 3 * i, E, s->L + 3 * i);
}

// A run that listens after each tick of `steps` steps; rates (ticks, 3) are those before the correction.
INLINE void listen(int groups, Parts p, double *memory, double *forces, Motion s, double h, int steps, int ticks,
                   Target of, double *rates) {
  begin(groups, p, memory, forces, &s);
  for (int i = 0; i < 3; i++) rates[i] = s.W[i];
  for (int k = 1; k < ticks; k++) {
    double pressed[4] = {0, 0, 0, 0}, *out = rates + 3 * k;
    for (int i = 0; i < steps; i++) step(groups, 1, p, memory, forces, h, &s, pressed);
    for (int i = 0; i < 3; i++) out[i] = s.W[i];
    if (!(dot(s.W, s.W) < 1e6)) { // lost: 50 rad/s from here on, which no hypothesis survives
      for (int i = 0; i < 3 * (ticks - k); i++) out[i] = 50.0;
      return;
    }
    correct(p, memory, steps, pressed, of.rates + 3 * k, of.attitudes + 9 * k, of, &s);
  }
}
