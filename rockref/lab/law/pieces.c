// The pieces of a step by themselves, for the judge: the functions of the step, asked one by one.
#include "loop.h"

// K1: r, u (3), xi, xi_rate, v_slide (2) of each of n points, one row of 10 a point.
EXPORT void piece_kinematics(const double *x, const double *L, const double *v, const double *W, int n, const double *P,
                             double *out) {
  double o[3];
  apply(L, W, o);
  for (int i = 0; i < n; i++, out += 10) {
    double rate[3];
    lever_xy(L, P + 3 * i, out), out[2] = lever_z(L, P + 3 * i, 0);
    point_velocity(v, o, out, rate);
    for (int j = 0; j < 3; j++) out[3 + j] = x[j] + out[j];
    out[6] = -out[5], out[7] = -rate[2], out[8] = rate[0], out[9] = rate[1];
  }
}

// N1 to T6 for one point at u (2): its force (3); its memory is written.
EXPORT void piece_contact_law(double xi, double xi_rate, const double *u, const double *slide, const double *prop,
                              double *memory, double *F) {
  const double none[S_SLOTS] = {0}, still[3] = {0, 0, 0};
  if (-xi > 0.0) {
    memory[C_ANCHORED] = memory[C_SLIDING] = F[0] = F[1] = F[2] = 0.0; // T5, N2
    return;
  }
  F[2] = without_tension(kelvin_voigt(prop, xi, xi_rate));
  friction(0, none, u, slide, prop, memory, still, F[2], F);
}

// A1 to A3: force (3), moment (3), body moment (3).
EXPORT void piece_assemble(const double *L, int n, const double *r, const double *F, double mass, double g, double *out) {
  for (int i = 0; i < 6; i++) out[i] = 0;
  for (int i = 0; i < n; i++) gather(out, out + 3, F + 3 * i, r + 3 * i);
  out[2] -= mass * g;
  apply_transposed(L, out + 3, out + 6);
}

EXPORT void piece_rotate(const double *Theta, double *L) { exponential(Theta, L); }

// I1 to I5 with given accelerations and moments, in place; state (C_STATE,), predicted: v, W (6).
EXPORT void piece_integrate(const double *body, double h, double *state, const double *a, const double *T,
                            double *predicted) {
  Motion s;
  read_motion(state, &s);
  Half m = first_half(body, h, &s);
  for (int i = 0; i < 3; i++) predicted[i] = m.v[i], predicted[3 + i] = m.W[i];
  second_half(body, h, &m, a, T, &s);
  write_motion(&s, state);
}
