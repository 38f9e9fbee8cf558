#pragma once
#include "layout.h"
#include "vector.h"

// The data sheet of a gyroscope: rate [Hz], bandwidth [Hz] (0: none), range [rad/s] (0: none).
typedef struct { double rate, bandwidth, range; } Gyro;

// The true time [s] of what the recorder dates t [s], and back.
double true_time(const double *values, double t);
double recorder_time(const double *values, double t);
double natural_frequency(double bandwidth, double damping);
void low_pass(double *crv, int n, double step, double bandwidth, double damping);
void mounting(const double *values, double *A);
// What a sampler finds of crv (n, 3) [rad/s] at t (n,) [s], in place; work: 6 n numbers.
void analogue(const double *values, const double *t, double *crv, int n, double bandwidth, double *work);
// The samples (m, 3) at k / rate of what a sampler finds, cut at the range. work: 6 n numbers.
void sampled(const double *values, Gyro gyro, const double *t, const double *crv, int n, double *out, int m, double *work);
void digital(const double *values, double *crv, int n);
