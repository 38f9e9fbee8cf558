// What the effects at the contact points add to force and moment; each effect sums over the points by itself.
#pragma once
#include "contact.h"

// Arm of the turning stiffness of rolling resistance [m]: half the base.
#define ARM 0.05

// Adhesion: force along z and moments about x and y, with the pull of one point at this height [m] added.
INLINE void pulled(double *sum, const double *e, double height, double rx, double ry) {
  double pull = e[S_ADHESION + 1];
  if (height > 0.0) pull = pull * larger(1 + -height / e[S_ADHESION + 2], 0.0);
  sum[0] = sum[0] - pull, sum[1] = sum[1] - ry * pull, sum[2] = sum[2] + rx * pull;
}

// Force in the plate (2) and moment (3), with those of one point added.
INLINE void pushed(double *sum, double px, double py, const double *r) {
  sum[0] = sum[0] + px, sum[1] = sum[1] + py, sum[2] = sum[2] - r[2] * py, sum[3] = sum[3] + r[2] * px;
  sum[4] = sum[4] + (r[0] * py - r[1] * px);
}

INLINE double spin_moment(const double *e, const double *prop, double *memory, double F_N, const double *v, double oz,
                          double turn) {
  double radius = e[S_SPIN + 1], share = e[S_SPIN + 2], square = radius * radius;
  double K = prop[C_K_T] * square, C = prop[C_C_T] * square, yaw = memory[C_YAW] + turn;
  double M = -K * yaw - C * oz, limit = radius * prop[C_MU] * F_N;
  if (share != 0.0) {
    double rim = radius * fabs(oz), size = sqrt(rim * rim + v[0] * v[0] + v[1] * v[1]);
    limit = limit * (1 + share * ((size > 0.0 ? rim / size : 1.0) - 1));
  }
  if (fabs(M) > limit) {
    M = smaller(larger(M, -limit), limit);
    yaw = -(M + C * oz) / K;
  }
  memory[C_YAW] = yaw;
  return M;
}

INLINE void roll_moment(const double *e, const double *prop, double *memory, double F_N, const double *omega,
                        const double *turn, double *M) {
  double lever = e[S_ROLLING + 1], size = lever * ARM, K = prop[C_K_N] * size, C = prop[C_C_N] * size;
  double hx = memory[C_ROLL_X] - K * turn[0], hy = memory[C_ROLL_Y] - K * turn[1];
  double dx = C * omega[0], dy = C * omega[1], mx = hx - dx, my = hy - dy;
  double trial = length(mx, my), limit = lever * F_N;
  if (trial > limit) {
    double scale = limit / trial;
    mx = scale * mx, my = scale * my, hx = mx + dx, hy = my + dy;
  }
  memory[C_ROLL_X] = hx, memory[C_ROLL_Y] = hy;
  M[0] = mx, M[1] = my;
}
