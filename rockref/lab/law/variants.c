// The loop once for the law alone, once for each group of effects, and once for all, so that the law pays nothing for
// the effects and one effect little for the others.
#include "loop.h"

#define EACH(do_) do_(0) do_(S_CONTACT) do_(S_FORCES) do_(S_MOMENTS) do_(S_LOADS) do_(S_PLATE)
#define ALL (S_CONTACT | S_FORCES | S_MOMENTS | S_LOADS | S_PLATE)

// The groups that effects (SLOTS,) need.
static int needed(const double *e) {
  static const int bounds[] = {S_HERTZ, S_ADHESION, S_SPIN, S_DRAG, S_SUPPORT, S_SLOTS};
  static const int groups[] = {S_CONTACT, S_FORCES, S_MOMENTS, S_LOADS, S_PLATE};
  int found = 0;
  for (int k = 0; k < 5; k++)
    for (int i = bounds[k]; i < bounds[k + 1]; i++)
      if (e[i] != 0.0) found |= groups[k];
  return found;
}

int run_rows(Parts p, double *memory, double *forces, const double *state, double h, Rows rows) {
  Motion s;
  int given = state[C_GIVEN] != 0.0;
  read_motion(state, &s);
  switch (needed(p.e)) {
#define RUN(groups) case groups: return run(groups, p, memory, forces, s, given, h, rows);
    EACH(RUN)
  }
  return run(ALL, p, memory, forces, s, given, h, rows);
}

void run_listening(Parts p, double *memory, double *forces, const double *state, double h, int steps, int ticks,
                   Target of, double *rates) {
  Motion s;
  read_motion(state, &s);
  if (needed(p.e) == 0) listen(0, p, memory, forces, s, h, steps, ticks, of, rates);
  else listen(ALL, p, memory, forces, s, h, steps, ticks, of, rates);
}
