// The effects on shape, mass and properties of the points, in the order of the step; `on` is at each effect's switch.
#include "body.h"
#define IS_ON(id) (v[E_##id##_on] != 0.0)
#define OF(id, name) v[E_##id##_##name]

// Geometric mean of four factors, one a foot.
static double mean_of(const double *feet) {
  int alike = feet[0] == 1 && feet[1] == 1 && feet[2] == 1 && feet[3] == 1;
  return alike ? 1 : exp((log(feet[0]) + log(feet[1]) + log(feet[2]) + log(feet[3])) / 4);
}

static void foot_defects(const double *v, Body *b) {
  const double *diag = &OF(foot_defects, diag1);
  double mean = mean_of(diag);
  for (int i = 0; i < 4; i++) {
    double *P = b->P + 3 * i, *Q = b->P + 3 * (4 + i), *q = b->props + C_PROPS * i, *inner = q + 4 * C_PROPS;
    double inward = 1 - OF(foot_defects, delta_diag) * (diag[i] / mean) / sqrt(P[0] * P[0] + P[1] * P[1]);
    Q[0] = P[0] * inward, Q[1] = P[1] * inward, Q[2] = P[2];
    P[2] += v[E_foot_defects_delta_long1 + i];
    for (int j = 0; j < C_PROPS; j++) inner[j] = q[j];
    inner[C_C_N] *= OF(foot_defects, beta_int), inner[C_C_T] *= OF(foot_defects, beta_int);
    inner[C_MU_0] *= OF(foot_defects, mu_int), inner[C_MU] *= OF(foot_defects, mu_int);
  }
  b->n = 8;
}

static void dimension_deviation(const double *v, Body *b) {
  const double *scale = &OF(dimension_deviation, width), share = OF(dimension_deviation, inertia_share);
  double *J = b->body + C_J, moments[9], half = (J[0] + J[4] + J[8]) / 2, own[3];
  for (int i = 0; i < 3; i++) own[i] = 1 + share * (scale[i] - 1);
  for (int i = 0; i < 9; i++) moments[i] = ((i % 4 ? 0.0 : half) - J[i]) * (own[i / 3] * own[i % 3]);
  double trace = moments[0] + moments[4] + moments[8];
  for (int i = 0; i < 9; i++) J[i] = (i % 4 ? 0.0 : trace) - moments[i];
  for (int i = 0; i < 3 * b->n; i++) b->P[i] = b->P[i] * scale[i % 3];
}

static void rounded_feet(const double *v, Body *b) {
  const double *feet = &OF(rounded_feet, foot1);
  double mean = mean_of(feet);
  for (int i = 0; i < b->n; i++) {
    double *q = b->props + C_PROPS * i;
    q[C_RADIUS] = OF(rounded_feet, radius) * (feet[(int)q[C_FOOT] - 1] / mean);
  }
}

static void inertia_deviation(const double *v, Body *b) {
  double *J = b->body + C_J, root[3], size[3];
  double xy = OF(inertia_deviation, xy), xz = OF(inertia_deviation, xz), yz = OF(inertia_deviation, yz);
  const double p[9] = {0, xy, xz, xy, 0, yz, xz, yz, 0};
  for (int i = 0; i < 3; i++) root[i] = sqrt(v[E_inertia_deviation_xx + i]), size[i] = sqrt(J[4 * i]);
  for (int i = 0; i < 9; i++) J[i] = J[i] + p[i] * (size[i / 3] * size[i % 3]);
  for (int i = 0; i < 9; i++) J[i] = J[i] * (root[i / 3] * root[i % 3]);
}

static void scale_feet(const double *feet, double share, int first, int second, double common, Body *b) {
  for (int i = 0; i < b->n; i++) {
    double *q = b->props + C_PROPS * i, scale = feet[(int)q[C_FOOT] - 1];
    q[first] = q[first] * scale, q[second] = q[second] * (common != 0 ? pow(scale, share) : scale);
  }
}

void with_effects(const double *v, Body *b) {
  if (IS_ON(foot_defects)) foot_defects(v, b);
  if (IS_ON(dimension_deviation)) dimension_deviation(v, b);
  if (IS_ON(rounded_feet)) rounded_feet(v, b);
  if (IS_ON(mass_eccentricity))
    for (int i = 0; i < 3 * b->n; i++) b->P[i] = b->P[i] - v[E_mass_eccentricity_x + i % 3];
  if (IS_ON(inertia_deviation)) inertia_deviation(v, b);
  if (IS_ON(uneven_foot_stiffness))
    scale_feet(&OF(uneven_foot_stiffness, foot1), OF(uneven_foot_stiffness, tangential_share), C_K_N, C_K_T, 1, b);
  if (IS_ON(uneven_foot_damping))
    scale_feet(&OF(uneven_foot_damping, foot1), 1 - OF(uneven_foot_damping, normal_share), C_C_N, C_C_T, 1, b);
  if (IS_ON(uneven_foot_friction)) scale_feet(&OF(uneven_foot_friction, foot1), 1, C_MU_0, C_MU, 0, b);
}

// Height of the centre of mass above the base, and the lowest point at a start.
static double half_height(const Body *b) {
  double least = b->P[2];
  for (int i = 1; i < b->n; i++) least = smaller(least, b->P[3 * i + 2]);
  return -least;
}

static double moment_at_rest(const Body *b, const double *state) {
  double lowest = INFINITY, y = 0;
  for (int i = 0; i < b->n; i++) {
    double r[3];
    apply(state + C_L, b->centres + 3 * i, r);
    double z = state[C_X + 2] + (r[2] - b->props[C_PROPS * i + C_RADIUS]);
    if (z < lowest) lowest = z, y = state[C_X + 1] + r[1];
  }
  return b->body[C_MASS] * b->body[C_GRAVITY] * y;
}

static void support(const double *v, const Body *b, const double *state, double *row) {
  const double gyration = 0.6 / sqrt(12); // of a plate 0.6 m wide
  double mass = OF(compliant_support, mass), ratio = OF(compliant_support, ratio), pitch = OF(compliant_support, pitch);
  double omega = 2 * M_PI * OF(compliant_support, frequency), k = omega * omega * mass;
  row[0] = 1, row[1] = mass, row[2] = k, row[3] = 2 * ratio * sqrt(k * mass);
  if (pitch <= 0.01) return;
  double J = mass * (gyration * gyration), turning = omega * omega * J / pitch;
  row[4] = J, row[5] = turning, row[6] = 2 * ratio * sqrt(turning * J), row[7] = moment_at_rest(b, state);
}

static void put(double *row, const double *from, int count) {
  row[0] = 1;
  for (int i = 0; i < count; i++) row[1 + i] = from[i];
}

// The numbers of an effect that acts in the step, as they are.
#define PUT(id, slot, count) if (IS_ON(id)) put(row + slot, v + E_##id##_on + 1, count)

void effects_row(const double *v, const Body *b, const double *state, double *row) {
  for (int i = 0; i < S_SLOTS; i++) row[i] = 0;
  PUT(hertzian_contact, S_HERTZ, 2);
  PUT(hysteretic_contact, S_HYSTERESIS, 2);
  PUT(hunt_crossley_contact, S_HUNT, 1);
  PUT(stribeck_friction, S_STRIBECK, 2);
  PUT(load_dependent_friction, S_LOAD, 2);
  PUT(adhesion, S_ADHESION, 2);
  PUT(viscous_friction, S_VISCOUS, 1);
  PUT(uneven_contact_normals, S_NORMALS, 9);
  PUT(spin_friction, S_SPIN, 2);
  PUT(rolling_resistance, S_ROLLING, 1);
  PUT(quadratic_drag, S_DRAG, 2);
  PUT(plate_tilt, S_TILT, 2);
  if (IS_ON(cable_restraint)) {
    double *to = row + S_CABLE, height = OF(cable_restraint, height), k = OF(cable_restraint, k);
    double share = OF(cable_restraint, stiffening), reference = OF(cable_restraint, reference);
    to[0] = 1, to[1] = k * (1 - share), to[2] = OF(cable_restraint, c), to[6] = k * share / reference / reference;
    to[3] = height == height ? height : half_height(b);
    to[4] = state[C_X] + state[C_L + 2] * to[3], to[5] = state[C_X + 1] + state[C_L + 5] * to[3];
  }
  if (IS_ON(lingering_wire_pull)) {
    double *to = row + S_WIRE;
    put(to, &OF(lingering_wire_pull, force), 2);
    to[3] = half_height(b), to[4] = OF(lingering_wire_pull, evenness);
  }
  if (IS_ON(base_vibration)) {
    double *to = row + S_VIBRATION, direction = OF(base_vibration, direction);
    to[0] = 1, to[1] = OF(base_vibration, amplitude), to[2] = 2 * M_PI * OF(base_vibration, frequency);
    to[3] = OF(base_vibration, phase), to[4] = sin(direction), to[5] = cos(direction);
    to[6] = OF(base_vibration, harmonic_cosine), to[7] = OF(base_vibration, harmonic_sine);
  }
  if (IS_ON(compliant_support)) support(v, b, state, row + S_SUPPORT);
}
