// The posture in which the wire lets go, and the effects on it; `rockref.model.release`.
#include "body.h"
#define IS_ON(id) (v[E_##id##_on] != 0.0)
#define OF(id, name) v[E_##id##_##name]

// Height of a tilted point, and the lowest ones with x > 0 and with x < 0.
static int pivots(const Body *b, double theta_0, int side, int *pivot) {
  double s = -side * sin(theta_0), c = cos(theta_0);
  for (int k = 0; k < 2; k++) {
    double lowest = INFINITY;
    pivot[k] = -1;
    for (int i = 0; i < b->n; i++) {
      const double *P = b->P + 3 * i;
      double height = s * P[1] + c * P[2];
      if ((k ? P[0] < 0 : P[0] > 0) && height < lowest) lowest = height, pivot[k] = i;
    }
  }
  return pivot[0] >= 0 && pivot[1] >= 0;
}

// The roll about Y with which both pivot points reach their depth: a cos - b sin = d.
static void roll_of(const Body *b, const double *tilt, const int *pivot, const double *depth, double *roll) {
  const double *p = b->centres + 3 * pivot[0], *q = b->centres + 3 * pivot[1];
  double radius = b->props[C_PROPS * pivot[0] + C_RADIUS] - b->props[C_PROPS * pivot[1] + C_RADIUS];
  double a = tilt[8] * (p[2] - q[2]), c = tilt[8] * (p[0] - q[0]);
  double d = -tilt[7] * (p[1] - q[1]) + radius - (depth[0] - depth[1]);
  double root = sqrt(a * a + c * c - d * d);
  double cosine = (a * d + c * root) / (a * a + c * c), sine = (a * root - c * d) / (a * a + c * c);
  for (int i = 0; i < 9; i++) roll[i] = 0;
  roll[4] = 1, roll[0] = cosine, roll[2] = sine, roll[6] = -sine, roll[8] = cosine;
}

// Height of the centre of mass [m] at which two springs carry the weight, without tension.
static double settled(const double *height, const double *K, double weight) {
  double z = -(weight + K[0] * height[0] + K[1] * height[1]) / (K[0] + K[1]);
  if (z + height[0] > 0) z = -height[1] - weight / K[1];
  else if (z + height[1] > 0) z = -height[0] - weight / K[0];
  return z;
}

// Writes the state (C_STATE,) at release; returns 0 where there is no pivot on one of the sides.
int release(const Body *b, double theta_0, int is_turned, double out_of_plane, double *state) {
  int pivot[2], side = is_turned ? -1 : 1;
  if (!pivots(b, theta_0, side, pivot)) return 0;
  double weight = b->body[C_MASS] * b->body[C_GRAVITY], tilt[9], roll[9], depth[2], height[2], K[2];
  const double lean[3] = {-theta_0, 0, 0}, over[3] = {0, out_of_plane, 0};
  exponential(lean, tilt);
  if (is_turned)
    for (int i = 0; i < 9; i++) tilt[i] = tilt[i] * (i % 3 == 2 ? 1 : -1);
  for (int k = 0; k < 2; k++) K[k] = b->props[C_PROPS * pivot[k] + C_K_N], depth[k] = weight / 2 / K[k];
  roll_of(b, tilt, pivot, depth, roll);
  for (int i = 0; i < C_STATE; i++) state[i] = 0;
  product(tilt, roll, state + C_L);
  if (out_of_plane != 0.0) {
    exponential(over, roll);
    product(state + C_L, roll, state + C_L);
  }
  for (int k = 0; k < 2; k++)
    height[k] = dot(state + C_L + 6, b->centres + 3 * pivot[k]) - b->props[C_PROPS * pivot[k] + C_RADIUS];
  state[C_X + 2] = settled(height, K, weight);
  return 1;
}

static void hertz(const double *v, const Body *b, double *state) {
  double reference = OF(hertzian_contact, reference), power = 1 / OF(hertzian_contact, exponent), change = 0;
  for (int i = 0; i < b->n; i++) {
    double load = b->body[C_MASS] * b->body[C_GRAVITY] / 2 / b->props[C_PROPS * i + C_K_N];
    change += load - reference * pow(load / reference, power);
  }
  state[C_X + 2] += change / b->n;
}

static void velocity(const double *v, const Body *b, double *state) {
  double middle[3] = {0, 0, 0}, omega[3], drift[3];
  int found = 0;
  for (int k = 0; k < 2; k++) {
    double lowest = INFINITY, at[3] = {0, 0, 0};
    for (int i = 0; i < b->n; i++) {
      double r[3];
      apply(state + C_L, b->P + 3 * i, r);
      if ((k ? b->P[3 * i] < 0 : b->P[3 * i] > 0) && r[2] < lowest)
        for (int j = 0; j < 3; j++) lowest = r[2], at[j] = r[j];
    }
    if (lowest < INFINITY) found++;
    for (int j = 0; j < 3; j++) middle[j] += at[j];
  }
  for (int j = 0; j < 3 && found; j++) middle[j] /= found;
  apply(state + C_L, &OF(release_velocity, x), omega);
  cross(omega, middle, drift);
  for (int j = 0; j < 3; j++) state[C_W + j] += v[E_release_velocity_x + j], state[C_V + j] -= drift[j];
}

void released_with(const double *v, const Body *b, double *state) {
  if (IS_ON(hertzian_contact)) hertz(v, b, state);
  if (IS_ON(adhesion)) {
    double deeper = 0;
    for (int i = 0; i < b->n; i++) deeper += OF(adhesion, force) / b->props[C_PROPS * i + C_K_N];
    state[C_X + 2] -= deeper / b->n;
  }
  if (IS_ON(release_velocity)) velocity(v, b, state);
}
