/* Runs NAME for a second and prints time, coordinates, own states and outputs as a table. */
#include "NAME.h"

#include <stdio.h>

static void print_row(const struct NAME_run *run, const struct NAME_outputs *outputs)
{
    const NAME_real *const q = (const NAME_real *)&run->state.q;
    const NAME_real *const v = (const NAME_real *)&run->state.v;
    const NAME_real *const measured = (const NAME_real *)outputs;
    printf("%.17g", (double)run->state.t);
    for (int at = 0; at < CAPS_COORDINATES; at++) {
        /* the value of an own state is that of a rate */
        printf(",%.17g", (double)(at < CAPS_LINES ? q[at] : v[at]));
    }
    for (int at = 0; at < CAPS_OUTPUTS; at++) {
        printf(",%.17g", (double)measured[at]);
    }
    printf("\n");
}

int main(void)
{
    const double step = STEP;
    const long steps = (long)(1.0 / step + 0.5), rows = 100;
    const long every = steps > rows ? steps / rows : 1;
    struct NAME_parameters parameters;
    struct NAME mechanism;
    struct NAME_run run = {0};
    struct NAME_outputs outputs = {0};

    NAME_default_parameters(&parameters);
    int code = NAME_init(&mechanism, &parameters);
    if (code == CAPS_OK) {
        code = NAME_start(&run, &mechanism, step);
    }
    if (code == CAPS_OK) {
        code = NAME_set_feedback(&run, FEEDBACK);
    }
    printf("t");
    for (int at = 0; at < CAPS_COORDINATES; at++) {
        printf(",%s", NAME_coordinate_names[at]);
    }
    for (int at = 0; at < CAPS_OUTPUTS; at++) {
        printf(",%s", NAME_output_names[at]);
    }
    printf("\n");
    for (long k = 0; code == CAPS_OK && k <= steps; k++) {
        if (k % every == 0) {
            code = NAME_outputs(&run, &outputs);
            if (code == CAPS_OK) {
                print_row(&run, &outputs);
            }
        }
        if (code == CAPS_OK) {
            code = NAME_step(&run);
        }
    }
    if (code != CAPS_OK) {
        fprintf(stderr, "t = %g s: %s: %s\n", (double)run.state.t, NAME_words(code), NAME_where(&run, code));
    }
    return code == CAPS_OK ? 0 : 1;
}
