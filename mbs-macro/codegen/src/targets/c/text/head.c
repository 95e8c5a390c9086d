#include "NAME.h"

#include <math.h>

typedef NAME_real real;

/* Structs of numbers as arrays: they have no padding. */
#define NAME_elements(vector) ((const real *)(vector))
#define NAME_places(vector) ((real *)(vector))

/* The distance from 1 to the next larger number, and the pivot growth from which on a
   position is singular: fewer than ten bits are left. */
static const real NAME_epsilon = EPSILON;
static const real NAME_growth_limit = LIMIT;

