/* Times the steps of a mechanism that was printed as C, with feedback in both stages: prints the
   median of ns per step and the sum of the last state. One unit with the loop around it. */
#define _POSIX_C_SOURCE 199309L
#include "NAME.c"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define STEPS 600
#define REPETITIONS 21

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void)
{
    const double h = H, input = INPUT;
    double times[REPETITIONS], sum = 0;
    struct NAME_parameters parameters;
    struct NAME mechanism;
    struct NAME_run start, run;
    NAME_default_parameters(&parameters);
    if (NAME_init(&mechanism, &parameters) || NAME_start(&start, &mechanism, h)) { return 1; }
    if (NAME_set_feedback(&start, 1 / h, sqrt(2.0) / h, 0)) { return 1; }
    for (int i = 0; i < CAPS_INPUTS; i++) { NAME_places(&start.inputs)[i] = input; }
    for (int k = 0; k < REPETITIONS; k++) {
        struct timespec before, after;
        clock_gettime(CLOCK_MONOTONIC, &before);
        run = start;
        for (int step = 0; step < STEPS; step++) {
            if (NAME_step(&run)) { return 1; }
        }
        clock_gettime(CLOCK_MONOTONIC, &after);
        times[k] = ((after.tv_sec - before.tv_sec) * 1e9 + (after.tv_nsec - before.tv_nsec)) / STEPS;
        sum = 0;
        for (int i = 0; i < CAPS_COORDINATES; i++) {
            sum += NAME_elements(&run.state.q)[i] + NAME_elements(&run.state.v)[i];
        }
    }
    qsort(times, REPETITIONS, sizeof *times, compare);
    printf("step %.3f %.12g\n", times[REPETITIONS / 2], sum);
    return 0;
}
