// Three-vectors and rotations, summed left to right as in `rockref.model.rotation`.
#pragma once
#include <math.h>
#define INLINE static inline __attribute__((always_inline))
#define EXPORT __attribute__((visibility("default")))

INLINE double larger(double a, double b) { return b > a ? b : a; }
INLINE double smaller(double a, double b) { return b < a ? b : a; }
INLINE double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

INLINE void cross(const double *a, const double *b, double *c) {
  double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
  c[0] = x, c[1] = y, c[2] = z;
}

// Matrix (row by row) times vector.
INLINE void apply(const double *A, const double *a, double *b) {
  double x = dot(A, a), y = dot(A + 3, a), z = dot(A + 6, a);
  b[0] = x, b[1] = y, b[2] = z;
}

INLINE void apply_transposed(const double *A, const double *a, double *b) {
  double x = A[0] * a[0] + A[3] * a[1] + A[6] * a[2];
  double y = A[1] * a[0] + A[4] * a[1] + A[7] * a[2];
  double z = A[2] * a[0] + A[5] * a[1] + A[8] * a[2];
  b[0] = x, b[1] = y, b[2] = z;
}

INLINE void product(const double *A, const double *B, double *C) {
  double D[9];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) D[3 * i + j] = A[3 * i] * B[j] + A[3 * i + 1] * B[3 + j] + A[3 * i + 2] * B[6 + j];
  for (int i = 0; i < 9; i++) C[i] = D[i];
}

// sin(theta)/theta and (1 - cos(theta))/theta^2 from t = theta^2 beyond 0.01 rad. Beyond 3.2 rad the law refuses the
// step; here the numbers are lost.
static __attribute__((noinline)) void long_series(double t, double *sine, double *cosine) {
  double s = t <= 10.24 ? 1.0 : NAN, c = s;
  for (int k = 17; k > 0; k--) {
    s = 1.0 - t * s * (1.0 / (2 * k * (2 * k + 1)));
    c = 1.0 - t * c * (1.0 / ((2 * k + 1) * (2 * k + 2)));
  }
  *sine = s, *cosine = c / 2;
}

// exp(hat(Theta)) - I by Rodrigues' formula; the short series up to 0.01 rad.
INLINE void exp_minus_identity(const double *Theta, double *E) {
  double x = Theta[0], y = Theta[1], z = Theta[2], s, c;
  double xx = x * x, yy = y * y, zz = z * z, t = xx + yy + zz;
  if (t <= 1e-4) {
    s = 1.0 - t * 1.0 * (1.0 / 42.0), s = 1.0 - t * s * (1.0 / 20.0), s = 1.0 - t * s * (1.0 / 6.0);
    c = 1.0 - t * 1.0 * (1.0 / 56.0), c = 1.0 - t * c * (1.0 / 30.0), c = 1.0 - t * c * (1.0 / 12.0);
    c = c / 2;
  } else
    long_series(t, &s, &c);
  E[0] = -c * (zz + yy), E[4] = -c * (zz + xx), E[8] = -c * (yy + xx);
  E[1] = c * (x * y) - s * z, E[3] = c * (x * y) + s * z;
  E[2] = c * (x * z) + s * y, E[6] = c * (x * z) - s * y;
  E[5] = c * (y * z) - s * x, E[7] = c * (y * z) + s * x;
}

INLINE void exponential(const double *Theta, double *R) {
  exp_minus_identity(Theta, R);
  R[0] += 1, R[4] += 1, R[8] += 1;
}

// The row m (I + E).
INLINE void turned(const double *m, const double *E, double *out) {
  double x = m[0] + (m[0] * E[0] + m[1] * E[3] + m[2] * E[6]);
  double y = m[1] + (m[0] * E[1] + m[1] * E[4] + m[2] * E[7]);
  double z = m[2] + (m[0] * E[2] + m[1] * E[5] + m[2] * E[8]);
  out[0] = x, out[1] = y, out[2] = z;
}
