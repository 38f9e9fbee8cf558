// What the host calls. Arrays are float64 in the module's memory, made by `take`; integers are 32 bits wide.
#include <stdlib.h>
#include "body.h"
#include "listening.h"
#include "variants.h"

void sha256(const unsigned char *data, int bytes, char *out);

EXPORT void *take(int bytes) { return malloc(bytes); }
EXPORT void give_back(void *what) { free(what); }
EXPORT int count(int what) {
  const int counts[] = {C_STATE, C_BODY, C_PROPS, C_MEMORY, S_SLOTS, M_COUNT, E_COUNT};
  return counts[what];
}

// Rows of a run from flat arrays, as `rockref.engines.compiled` packs them; returns the number of rows written.
EXPORT int run_packed(int n, const double *body, const double *centres, const double *props, double *memory,
                      double *forces, const double *e, const double *state, double h, const int *wanted, int rows,
                      double *states, double *row_forces, double *row_memory) {
  Parts p = {body, centres, props, e, n};
  return run_rows(p, memory, forces, state, h, (Rows){wanted, rows, states, row_forces, row_memory});
}

// Applies the effects on shape to packed points; returns their number. P, props: room for MOST_POINTS.
EXPORT int shape_packed(const double *values, int n, double *body, double *P, double *props, double *centres) {
  static Body b;
  b.n = n;
  for (int i = 0; i < C_BODY; i++) b.body[i] = body[i];
  for (int i = 0; i < 3 * n; i++) b.P[i] = P[i];
  for (int i = 0; i < C_PROPS * n; i++) b.props[i] = props[i];
  with_effects(values, &b), prepare(&b);
  for (int i = 0; i < C_BODY; i++) body[i] = b.body[i];
  for (int i = 0; i < 3 * b.n; i++) P[i] = b.P[i], centres[i] = b.centres[i];
  for (int i = 0; i < C_PROPS * b.n; i++) props[i] = b.props[i];
  return b.n;
}

static void packed(int n, const double *body, const double *P, const double *props, Body *b) {
  b->n = n;
  for (int i = 0; i < C_BODY; i++) b->body[i] = body[i];
  for (int i = 0; i < 3 * n; i++) b->P[i] = P[i];
  for (int i = 0; i < C_PROPS * n; i++) b->props[i] = props[i];
  prepare(b);
}

// The effects on the release of a state (C_STATE,), and the row (S_SLOTS,) of those that act in the step.
EXPORT void start_packed(const double *values, int n, const double *body, const double *P, const double *props,
                         double *state, double *e) {
  static Body b;
  packed(n, body, P, props, &b);
  released_with(values, &b, state), effects_row(values, &b, state, e);
}

EXPORT int release_packed(int n, const double *body, const double *P, const double *props, double theta_0, int is_turned,
                          double out_of_plane, double *state) {
  static Body b;
  packed(n, body, P, props, &b);
  return release(&b, theta_0, is_turned, out_of_plane, state);
}

// Body, points and properties of a model (M_COUNT,), with effects (E_COUNT,); returns the number of points.
EXPORT int body_of(const double *model, const double *values, double *body, double *P, double *props) {
  static Body b;
  of_model(model, &b), with_effects(values, &b), prepare(&b);
  for (int i = 0; i < C_BODY; i++) body[i] = b.body[i];
  for (int i = 0; i < 3 * b.n; i++) P[i] = b.P[i];
  for (int i = 0; i < C_PROPS * b.n; i++) props[i] = b.props[i];
  return b.n;
}

// A run of a model from its release: rows (count, C_STATE) of every `every`-th step, and what the feet do in them,
// (count, n, 3) forces and (count, n, C_MEMORY) memories. Returns the rows that have numbers; -1 without a release.
EXPORT int run_model(const double *model, const double *values, double theta_0, int is_turned, double roll, double h,
                     int every, int rows, double *states, double *row_forces, double *row_memory) {
  static Body b;
  double state[C_STATE], e[S_SLOTS], memory[C_MEMORY * MOST_POINTS] = {0}, forces[3 * MOST_POINTS] = {0};
  of_model(model, &b), with_effects(values, &b), prepare(&b);
  if (!release(&b, theta_0, is_turned, roll, state)) return -1;
  released_with(values, &b, state), effects_row(values, &b, state, e);
  int *wanted = malloc(sizeof(int) * rows);
  for (int i = 0; i < rows; i++) wanted[i] = i * every;
  Parts p = {b.body, b.centres, b.props, e, b.n};
  int written = run_rows(p, memory, forces, state, h, (Rows){wanted, rows, states, row_forces, row_memory});
  free(wanted);
  return written;
}

// What a gyroscope would record, (m, 3) [rad/s], of rates (n, 3) in rows of `stride` numbers, `step` s apart.
EXPORT void recorded(const double *values, const double *rates, int stride, int n, double step, double rate,
                     double bandwidth, double range, double *out, int m) {
  double *crv = malloc(sizeof(double) * 3 * n), *t = malloc(sizeof(double) * n), *work = malloc(sizeof(double) * 6 * n);
  Gyro gyro = {rate, bandwidth, range};
  for (int i = 0; i < n; i++) t[i] = i * step;
  for (int i = 0; i < 3 * n; i++) crv[i] = rates[(long)stride * (i / 3) + i % 3];
  analogue(values, t, crv, n, bandwidth, work);
  sampled(values, gyro, t, crv, n, out, m, work);
  free(crv), free(t), free(work);
}

// What the sensor effects alone make of rates (n, 3) [rad/s] at t (n,) [s], in place.
EXPORT void sensed(const double *values, const double *t, double *crv, int n) {
  double *work = malloc(sizeof(double) * 6 * n);
  analogue(values, t, crv, n, 0, work);
  digital(values, crv, n);
  free(work);
}

EXPORT int innovations_of(const double *model, const double *values, double rate, double bandwidth, double range,
                          double theta_0, double roll, int is_turned, double memory_rates, double memory_attitude,
                          double jitter, int steps, int smoothing, const double *y, int m, const double *sigma, double *r) {
  Gyro gyro = {rate, bandwidth, range};
  Listening how = {theta_0, roll, memory_rates, memory_attitude, jitter, is_turned, steps, smoothing};
  return innovations(model, values, gyro, how, y, m, sigma, r);
}

// SHA-256, as 64 characters, of the bits of W, x and Lambda of rows (rows, C_STATE). Adding zero gives every zero one
// sign.
EXPORT void digest_of(const double *states, int rows, char *out) {
  const int first[] = {C_W, C_X, C_L}, width[] = {3, 3, 9};
  double *packed = malloc(sizeof(double) * 15 * rows), *to = packed;
  for (int i = 0; i < rows; i++)
    for (int k = 0; k < 3; k++)
      for (int j = 0; j < width[k]; j++) *to++ = states[(long)C_STATE * i + first[k] + j] + 0.0;
  sha256((const unsigned char *)packed, 120 * rows, out);
  free(packed);
}
