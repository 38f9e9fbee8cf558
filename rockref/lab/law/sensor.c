// What a gyroscope makes of the body rates, in the order of a real one: misalignment, scale, low-pass of the data sheet,
// bandwidth and delay, bias and drift, the clock; then samples, cut at the range.
#include "sensor.h"
#define IS_ON(id) (v[E_##id##_on] != 0.0)
#define OF(id, name) v[E_##id##_##name]

typedef struct { double re, im; } Complex;
static Complex sum(Complex a, Complex b) { return (Complex){a.re + b.re, a.im + b.im}; }
static Complex less(Complex a, Complex b) { return (Complex){a.re - b.re, a.im - b.im}; }
static Complex mul(Complex a, Complex b) { return (Complex){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
static Complex over(Complex a, Complex b) {
  double square = b.re * b.re + b.im * b.im;
  return (Complex){(a.re * b.re + a.im * b.im) / square, (a.im * b.re - a.re * b.im) / square};
}

#define HELD 0.05 // of itself, by which a clock's rate moves at most
static double change_of_rate(const double *v) { return (OF(clock_error, rate) - 1) * OF(clock_error, growth); }

double true_time(const double *v, double t) {
  if (!IS_ON(clock_error)) return t;
  double rate = OF(clock_error, rate), change = change_of_rate(v);
  if (change == 0) return rate * t;
  double moves = smaller(t, HELD * rate / fabs(change));
  return rate * t + change * moves * (t - moves / 2);
}

double recorder_time(const double *v, double t) {
  if (!IS_ON(clock_error)) return t;
  double rate = OF(clock_error, rate), change = change_of_rate(v);
  if (change == 0) return t / rate;
  double held = HELD * rate / fabs(change), last = rate + change * held;
  if (t > true_time(v, held)) return (t + change * held * held / 2) / last;
  return 2 * t / (rate + sqrt(rate * rate + 2 * change * t));
}

// Undamped angular frequency [rad/s] of a second-order low-pass whose -3 dB point is `bandwidth` Hz.
double natural_frequency(double bandwidth, double damping) {
  double b = 1.0 - 2.0 * damping * damping;
  double root = b > 0 ? b + sqrt(b * b + 1.0) : 1.0 / (sqrt(b * b + 1.0) - b);
  return 2.0 * M_PI * bandwidth / sqrt(root);
}

// Numerator and denominator in 1/z of the low-pass, exact for a signal that is straight between samples: pole by pole.
static void held_first_order(double omega, double damping, double h, double *numerator, double *denominator) {
  double inside = damping * damping - 1.0;
  if (fabs(damping - 1.0) <= 1e-6) inside = 2e-6; // a double pole has no partial fractions
  Complex split = inside < 0 ? (Complex){0, sqrt(-inside)} : (Complex){sqrt(inside), 0};
  Complex pole[2], turn[2], residue[2], both[2], last[2];
  for (int k = 0; k < 2; k++) {
    Complex s = k ? (Complex){-split.re, -split.im} : split;
    pole[k] = (Complex){omega * (-damping + s.re), omega * s.im};
    double size = exp(pole[k].re * h);
    turn[k] = (Complex){size * cos(pole[k].im * h), size * sin(pole[k].im * h)};
  }
  Complex square = {omega * omega, 0}, step = {h, 0};
  residue[0] = over(square, less(pole[0], pole[1])), residue[1] = over(square, less(pole[1], pole[0]));
  for (int j = 0; j < 3; j++) numerator[j] = 0;
  for (int k = 0; k < 2; k++) {
    Complex one = {1, 0}, gain = less(turn[k], one);
    both[k] = over(gain, pole[k]);
    last[k] = over(less(gain, mul(pole[k], step)), mul(mul(pole[k], pole[k]), step));
    Complex first = less(both[k], last[k]), other = turn[1 - k];
    numerator[0] += mul(residue[k], last[k]).re;
    numerator[1] += mul(residue[k], less(first, mul(last[k], other))).re;
    numerator[2] += mul(residue[k], less((Complex){0, 0}, mul(first, other))).re;
  }
  denominator[0] = 1, denominator[1] = -sum(turn[0], turn[1]).re, denominator[2] = mul(turn[0], turn[1]).re;
}

// The filter, settled on the first sample, in place.
void low_pass(double *crv, int n, double step, double bandwidth, double damping) {
  double b[3], a[3];
  held_first_order(natural_frequency(bandwidth, damping), damping, step, b, a);
  for (int axis = 0; axis < 3; axis++) {
    double first = crv[axis], z1 = (b[2] - a[2]) * first, z0 = z1 + (b[1] - a[1]) * first;
    for (int i = 0; i < n; i++) {
      double x = crv[3 * i + axis], y = b[0] * x + z0;
      z0 = b[1] * x - a[1] * y + z1, z1 = b[2] * x - a[2] * y;
      crv[3 * i + axis] = y;
    }
  }
}

// Slopes (n,) of the cubic spline through y[stride i] at t whose third derivative does not jump at the outermost knots.
static void slopes(const double *t, const double *y, int stride, int n, double *s, double *work) {
  double *diagonal = work, *upper = work + n;
#define Y(i) y[(long)stride * (i)]
#define DX(i) (t[(i) + 1] - t[i])
#define SLOPE(i) ((Y((i) + 1) - Y(i)) / DX(i))
  if (n == 2) {
    s[0] = s[1] = SLOPE(0);
    return;
  }
  if (n == 3) { // the parabola
    double bend = (SLOPE(1) - SLOPE(0)) / (t[2] - t[0]);
    s[0] = SLOPE(0) - bend * DX(0), s[1] = SLOPE(0) + bend * DX(0), s[2] = SLOPE(1) + bend * DX(1);
    return;
  }
  double d = t[2] - t[0];
  diagonal[0] = DX(1), upper[0] = d;
  s[0] = ((DX(0) + 2 * d) * DX(1) * SLOPE(0) + DX(0) * DX(0) * SLOPE(1)) / d;
  for (int i = 1; i < n - 1; i++) {
    double ratio = DX(i) / diagonal[i - 1];
    diagonal[i] = 2 * (DX(i - 1) + DX(i)) - ratio * upper[i - 1], upper[i] = DX(i - 1);
    s[i] = 3 * (DX(i) * SLOPE(i - 1) + DX(i - 1) * SLOPE(i)) - ratio * s[i - 1];
  }
  d = t[n - 1] - t[n - 3];
  double right = (DX(n - 2) * DX(n - 2) * SLOPE(n - 3) + (2 * d + DX(n - 2)) * DX(n - 3) * SLOPE(n - 2)) / d;
  double ratio = d / diagonal[n - 2];
  s[n - 1] = (right - ratio * s[n - 2]) / (DX(n - 3) - ratio * upper[n - 2]);
  for (int i = n - 2; i >= 0; i--) s[i] = (s[i] - upper[i] * s[i + 1]) / diagonal[i];
}

static double between(const double *t, const double *y, int stride, const double *s, int i, double at) {
  double z = at - t[i], dx = DX(i), slope = SLOPE(i), bend = (s[i] + s[i + 1] - 2 * slope) / dx;
  return Y(i) + z * (s[i] + z * (((slope - s[i]) / dx - bend) + z * (bend / dx)));
}

// Cubic values of crv (n, 3) at k * spacing + shift, or at the true times of `times` (m,) by the clock, for k < m, held
// beyond the ends; work: 3 n numbers.
static void resampled(const double *t, const double *crv, int n, const double *clock, double shift, const double *times,
                      double spacing, double *out, int m, double *work) {
  double *s = work + 2 * n;
  for (int axis = 0; axis < 3; axis++) {
    int i = 0;
    slopes(t, crv + axis, 3, n, s, work);
    for (int k = 0; k < m; k++) {
      double at = times ? times[k] : k * spacing;
      at = (clock ? true_time(clock, at) : at) + shift;
      at = smaller(larger(at, t[0]), t[n - 1]);
      while (i < n - 2 && t[i + 1] <= at) i++;
      out[3 * (long)k + axis] = between(t, crv + axis, 3, s, i, at);
    }
  }
}

// The matrix (I + S) R of a sensor that is not square to the block.
void mounting(const double *v, double *A) {
  double xy = OF(gyro_misalignment, xy), xz = OF(gyro_misalignment, xz), yz = OF(gyro_misalignment, yz);
  const double S[9] = {1, xy, xz, xy, 1, yz, xz, yz, 1};
  exponential(&OF(gyro_misalignment, x), A);
  if (xy != 0 || xz != 0 || yz != 0) product(S, A, A);
}

static void bandwidth_and_delay(const double *v, const double *t, double *crv, int n, double *work) {
  double frequency = OF(gyro_bandwidth, frequency), delay = OF(gyro_bandwidth, delay), *copy = work + 3 * n;
  if (frequency < INFINITY) low_pass(crv, n, (t[n - 1] - t[0]) / (n - 1), frequency, OF(gyro_bandwidth, damping));
  if (delay == 0.0) return;
  for (int i = 0; i < 3 * n; i++) copy[i] = crv[i];
  resampled(t, copy, n, 0, -delay, t, 0, crv, n, work);
}

// What a sampler finds, in place; work: 6 n numbers.
void analogue(const double *v, const double *t, double *crv, int n, double bandwidth, double *work) {
  double A[9], *copy = work + 3 * n;
  if (IS_ON(gyro_misalignment)) {
    mounting(v, A);
    for (int i = 0; i < n; i++) apply(A, crv + 3 * i, crv + 3 * i);
  }
  if (IS_ON(gyro_scale))
    for (int i = 0; i < 3 * n; i++) crv[i] = crv[i] * v[E_gyro_scale_x + i % 3];
  if (n < 2) return;
  if (bandwidth > 0) low_pass(crv, n, (t[n - 1] - t[0]) / (n - 1), bandwidth, 1 / sqrt(2));
  if (IS_ON(gyro_bandwidth)) bandwidth_and_delay(v, t, crv, n, work);
  if (IS_ON(gyro_drift))
    for (int i = 0; i < 3 * n; i++)
      crv[i] = crv[i] + v[E_gyro_drift_bias_x + i % 3] + t[i / 3] * v[E_gyro_drift_rate_x + i % 3];
  if (!IS_ON(clock_error)) return;
  for (int i = 0; i < 3 * n; i++) copy[i] = crv[i];
  resampled(t, copy, n, v, 0, t, 0, crv, n, work);
}

// What becomes of the samples (n, 3): cut where the sensor runs into its stops.
void digital(const double *v, double *crv, int n) {
  if (!IS_ON(gyro_saturation)) return;
  double range = OF(gyro_saturation, range), soft = OF(gyro_saturation, softness);
  for (int i = 0; i < 3 * n; i++) {
    double hard = smaller(larger(crv[i], -range), range);
    crv[i] = soft != 0 ? hard + soft * (range * tanh(crv[i] / range) - hard) : hard;
  }
}

// The samples (m, 3) at k / rate of rates (n, 3) that `analogue` has gone over; work: 3 n numbers.
void sampled(const double *v, Gyro gyro, const double *t, const double *crv, int n, double *out, int m, double *work) {
  double step = (t[n - 1] - t[0]) / (n - 1), every = 1 / (gyro.rate * step), whole = nearbyint(every);
  if (fabs(every - whole) * m < 1e-3) // a thousandth of a row is rounding of the clock
    for (int i = 0; i < 3 * m; i++) out[i] = crv[3 * (long)smaller((i / 3) * whole, n - 1) + i % 3];
  else
    resampled(t, crv, n, 0, 0, 0, 1 / gyro.rate, out, m, work);
  digital(v, out, m);
  if (gyro.range > 0)
    for (int i = 0; i < 3 * m; i++) out[i] = smaller(larger(out[i], -gyro.range), gyro.range);
}
