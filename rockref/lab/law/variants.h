#pragma once
#include "evaluation.h"

// Where the rows of a run are written: at the step numbers `wanted`, rising. forces and memory may be NULL.
typedef struct {
  const int *wanted;
  int count;
  double *states, *forces, *memory;
} Rows;

// What a run listens to: body rates (3) and attitude (9) at every tick, and the share of the difference that is taken.
typedef struct {
  const double *rates, *attitudes;
  double share_rates, share_attitude;
} Target;

// A run of which rows are written; returns their number.
int run_rows(Parts p, double *memory, double *forces, const double *state, double h, Rows rows);
// A run that listens to a record.
void run_listening(Parts p, double *memory, double *forces, const double *state, double h, int steps, int ticks,
                   Target of, double *rates);
