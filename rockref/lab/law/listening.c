// The record as a target, and the innovations of a run that listens to it.
#include "listening.h"
#include <stdlib.h>
#include "body.h"
#include "variants.h"
#define IS_ON(id) (v[E_##id##_on] != 0.0)
#define OF(id, name) v[E_##id##_##name]

#define TICK 5e-4
// A filter is undone by its differential equation where it is no slower than this many radians a sample (decided):
// beyond, differences would raise the noise more than the motion.
#define LEAST_TURN 0.7

static double *taken(int n) { return malloc(sizeof(double) * n); }

static void inverse_of(const double *A, double *B) {
  double c[9];
  cross(A + 3, A + 6, c), cross(A + 6, A, c + 3), cross(A, A + 3, c + 6);
  double determinant = dot(A, c);
  for (int i = 0; i < 9; i++) B[i] = c[3 * (i % 3) + i / 3] / determinant;
}

// The record (m, 3) without bias, drift, low-pass of the data sheet, scale and misalignment; returns the lateness [s]
// of what is left.
static double undone(const double *v, Gyro gyro, const double *y, int m, double *out) {
  double A[9], late = 0, dt = 1 / gyro.rate;
  double omega = natural_frequency(gyro.bandwidth, 1 / sqrt(2)), turn = omega * dt;
  double first = turn > LEAST_TURN ? sqrt(2) / turn : 0, second = turn > LEAST_TURN ? 1 / (turn * turn) : 0;
  if (first == 0) late += sqrt(2) / omega;
  if (IS_ON(gyro_bandwidth)) {
    double frequency = OF(gyro_bandwidth, frequency), damping = OF(gyro_bandwidth, damping);
    if (frequency < INFINITY) late += 2 * damping / natural_frequency(frequency, damping);
    late += OF(gyro_bandwidth, delay);
  }
  for (int i = 0; i < 9; i++) A[i] = i % 4 ? 0 : 1;
  if (IS_ON(gyro_misalignment)) mounting(v, A);
  for (int i = 0; i < 9 && IS_ON(gyro_scale); i++) A[i] = A[i] * v[E_gyro_scale_x + i / 3];
  inverse_of(A, A);
  for (int i = 0; i < m; i++) {
    int a = i > 0 ? i - 1 : 0, b = i < m - 1 ? i + 1 : m - 1;
    double z[3];
    for (int j = 0; j < 3; j++) {
      double here = y[3 * i + j], before = y[3 * a + j], after = y[3 * b + j];
      z[j] = here + first * (after - before) / 2 + second * (after - 2 * here + before);
      if (IS_ON(gyro_drift)) z[j] -= v[E_gyro_drift_bias_x + j] + true_time(v, i * dt) * v[E_gyro_drift_rate_x + j];
    }
    apply(A, z, out + 3 * i);
  }
  return late;
}

// Rates (ticks, 3) [rad/s] and attitudes (ticks, 9), from that of the release, which a record (m, 3) shows.
void target(const double *v, Gyro gyro, const double *y, int m, const double *start, int ticks, double *rates,
            double *attitudes) {
  double *z = taken(3 * m), late = undone(v, gyro, y, m, z), E[9];
  for (int k = 0; k < ticks; k++) {
    double place = smaller(recorder_time(v, k * TICK + late) * gyro.rate, m - 1);
    int i = (int)smaller(place, m - 2);
    for (int j = 0; j < 3; j++) rates[3 * k + j] = z[3 * i + j] + (place - i) * (z[3 * i + 3 + j] - z[3 * i + j]);
  }
  for (int i = 0; i < 9; i++) attitudes[i] = start[i];
  for (int k = 1; k < ticks; k++) {
    double Theta[3];
    for (int j = 0; j < 3; j++) Theta[j] = TICK * (rates[3 * k + j] + rates[3 * k - 3 + j]) / 2;
    exp_minus_identity(Theta, E);
    for (int i = 0; i < 3; i++) turned(attitudes + 9 * (k - 1) + 3 * i, E, attitudes + 9 * k + 3 * i);
  }
  free(z);
}

// Gaussian means of r (m, 3) over `width` samples, white noise kept at size one, every width-th of them; the number
// of rows that are left. Width 0 leaves all.
static int smoothed(double *r, int m, int width) {
  int reach = 4 * width, left = 0;
  if (width <= 0) return m;
  double weight[2 * 32 * 4 + 1], squares = 0, *from = taken(3 * m);
  for (int i = -reach; i <= reach; i++) {
    double w = exp(-0.5 * i * i / (double)(width * width));
    weight[i + reach] = w, squares += w * w;
  }
  for (int i = 0; i < 3 * m; i++) from[i] = r[i];
  for (int i = 0; i < m; i += width, left++)
    for (int j = 0; j < 3; j++) {
      double total = 0;
      for (int k = -reach; k <= reach; k++)
        if (i + k >= 0 && i + k < m) total += weight[k + reach] * from[3 * (i + k) + j];
      r[3 * left + j] = total / sqrt(squares);
    }
  free(from);
  return left;
}

// The rates (m, 3) [rad/s] that the record of a listening run would show; 0 where there is no release.
static int listened(const double *model, const double *v, Gyro gyro, Listening how, const double *y, int m, double *out) {
  static Body b;
  double state[C_STATE], e[S_SLOTS], memory[C_MEMORY * MOST_POINTS] = {0}, forces[3 * MOST_POINTS];
  int ticks = (int)(true_time(v, m / gyro.rate) / TICK) + 2, n = ticks;
  of_model(model, &b), with_effects(v, &b), prepare(&b);
  if (!release(&b, how.theta_0, how.turned, how.roll, state)) return 0;
  released_with(v, &b, state), effects_row(v, &b, state, e);
  double *rates = taken(3 * n), *attitudes = taken(9 * n), *crv = taken(3 * n), *t = taken(n), *work = taken(6 * n);
  target(v, gyro, y, m, state + C_L, ticks, rates, attitudes);
  Target of = {rates, attitudes, 1 - exp(-TICK / how.memory_rates), 1 - exp(-TICK / how.memory_attitude)};
  Parts p = {b.body, b.centres, b.props, e, b.n};
  run_listening(p, memory, forces, state, TICK / how.steps, how.steps, ticks, of, crv);
  for (int i = 0; i < n; i++) t[i] = i * TICK;
  analogue(v, t, crv, n, gyro.bandwidth, work);
  sampled(v, gyro, t, crv, n, out, m, work);
  free(rates), free(attitudes), free(crv), free(t), free(work);
  return 1;
}

// Innovations of a record y (m, 3) [rad/s] over the noise sigma (3,), smoothed; the number of rows that are left.
int innovations(const double *model, const double *v, Gyro gyro, Listening how, const double *y, int m,
                const double *sigma, double *r) {
  double *shown = taken(3 * m);
  if (!listened(model, v, gyro, how, y, m, shown))
    for (int i = 0; i < 3 * m; i++) shown[i] = 50;
  for (int i = 0; i < 3 * m; i++) {
    int j = i % 3, before = i >= 3 ? i - 3 : i, after = i < 3 * (m - 1) ? i + 3 : i;
    double slope = (y[after] - y[before]) / 2 * gyro.rate, late = how.jitter * slope;
    double value = (y[i] - shown[i]) / sqrt(sigma[j] * sigma[j] + late * late);
    r[i] = value == value ? smaller(larger(value, -1e3), 1e3) : 1e3;
  }
  free(shown);
  return smoothed(r, m, how.smoothing);
}
