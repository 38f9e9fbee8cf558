// From the numbers of a model to block and contact points: rules G1, G2, P1 to P3.
#include "body.h"

static const double SIGN_X[4] = {1, -1, -1, 1}, SIGN_Y[4] = {1, 1, -1, -1};

static void inertia_of(const double *m, double *J) {
  for (int i = 0; i < 9; i++) J[i] = m[M_inertia_0 + i];
  for (int i = 0; i < 9; i++)
    if (J[i] != 0.0) return;
  double mass = m[M_mass], width = m[M_width], depth = m[M_depth], height = m[M_height];
  J[0] = mass / 12 * (depth * depth + height * height); // G1
  J[4] = mass / 12 * (width * width + height * height);
  J[8] = mass / 12 * (width * width + depth * depth);
}

static void points_of(const double *m, Body *b) {
  double width = m[M_width], depth = m[M_depth], height = m[M_height];
  double diagonal = sqrt(width * width + depth * depth), inward = 1 - m[M_delta_diag] / (diagonal / 2);
  int eight = b->n == 8;
  for (int i = 0; i < 4; i++) { // G2
    double x = SIGN_X[i] * width / 2, y = SIGN_Y[i] * depth / 2, *P = b->P + 3 * i, *Q = b->P + 3 * (4 + i);
    P[0] = x, P[1] = y, P[2] = eight ? -height / 2 + m[M_delta_long_1 + i] : -height / 2;
    Q[0] = x * inward, Q[1] = y * inward, Q[2] = -height / 2;
  }
}

void of_model(const double *m, Body *b) {
  b->n = m[M_points] == 4 ? 4 : 8;
  b->body[C_MASS] = m[M_mass], b->body[C_GRAVITY] = m[M_g];
  inertia_of(m, b->body + C_J);
  points_of(m, b);
  for (int i = 0; i < b->n; i++) {
    double *q = b->props + C_PROPS * i, beta = m[i < 4 ? M_beta_ext : M_beta_int];
    q[C_K_N] = m[M_K_N], q[C_K_T] = m[M_K_T];                 // P1
    q[C_C_N] = 2 * beta * sqrt(q[C_K_N] * m[M_mass]);         // P2, P3
    q[C_C_T] = 2 * beta * sqrt(q[C_K_T] * m[M_mass]);
    q[C_MU_0] = q[C_MU] = m[i < 4 ? M_mu_ext : M_mu_int];
    q[C_RADIUS] = m[M_foot_radius], q[C_FOOT] = i % 4 + 1;
  }
}

static void inverse(const double *J, double *K) {
  double c[9];
  cross(J + 3, J + 6, c), cross(J + 6, J, c + 3), cross(J, J + 3, c + 6);
  double determinant = dot(J, c);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) K[3 * i + j] = c[3 * j + i] / determinant;
}

void prepare(Body *b) {
  double *J = b->body + C_J, *K = b->body + C_J_INVERSE;
  int principal = 1;
  for (int i = 0; i < 9; i++) principal &= i % 4 == 0 || J[i] == 0.0;
  b->body[C_PRINCIPAL] = principal;
  if (principal)
    for (int i = 0; i < 9; i++) K[i] = i % 4 ? 0.0 : 1 / J[i];
  else
    inverse(J, K);
  for (int i = 0; i < b->n; i++) {
    for (int j = 0; j < 3; j++) b->centres[3 * i + j] = b->P[3 * i + j];
    b->centres[3 * i + 2] += b->props[C_PROPS * i + C_RADIUS];
  }
}
