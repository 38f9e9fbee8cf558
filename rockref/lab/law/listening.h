#pragma once
#include "sensor.h"

// How a run listens: its release [rad], memories of rates and attitude [s], timing error of an impact [s], steps a tick
// of 0.5 ms, width of the means over residuals [samples, at most 32].
typedef struct {
  double theta_0, roll, memory_rates, memory_attitude, jitter;
  int turned, steps, smoothing;
} Listening;

int innovations(const double *model, const double *values, Gyro gyro, Listening how, const double *y, int m,
                const double *sigma, double *r);
