#pragma once
#include "layout.h"
#include "vector.h"

// Most contact points that an effect on the shape may make.
#define MOST_POINTS 16

// The block as arrays: P (n, 3) [m], props (n, C_PROPS), body (C_BODY,), before or after the effects on its shape.
typedef struct {
  int n;
  double body[C_BODY], P[3 * MOST_POINTS], props[C_PROPS * MOST_POINTS], centres[3 * MOST_POINTS];
} Body;

void of_model(const double *model, Body *b);              // G1, G2, P1 to P3
void with_effects(const double *values, Body *b);         // the effects on shape, mass and properties
void prepare(Body *b);                                    // J^-1, and the points raised by their radius
int release(const Body *b, double theta_0, int is_turned, double out_of_plane, double *state);
void released_with(const double *values, const Body *b, double *state); // the effects on the release
void effects_row(const double *values, const Body *b, const double *state, double *row);
