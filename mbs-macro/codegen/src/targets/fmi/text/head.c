/* {mechanism} as a functional mock-up unit: the functions of FMI 2.0 and 3.0, for model exchange and for
   co-simulation, around the solver in NAME.c. Printed from its declaration; changes here are lost.

   Compile it with NAME.c to a shared library: cc -std=c99 -O2 -ffp-contract=off -fPIC -shared.

   The first parts know no version of the standard. What both versions ask for is written there
   once, and the last two parts translate. */

#include "NAME.h"

#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined _WIN32 || defined __CYGWIN__
#define EXPORT __declspec(dllexport)
#elif defined __GNUC__
#define EXPORT __attribute__((visibility("default")))
#else
#define EXPORT
#endif

