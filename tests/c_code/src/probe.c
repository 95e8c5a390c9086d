/* Runs NAME as its input says, and prints numbers by their bits, as doubles:

   step steps every, alpha beta is_held (is_held < 0 for the deadbeat gains of the step),
   inputs, NaN for those that stay as they are, 1 and a state to start from (t, q, v) or 0.

   A line has t, q, v, q̈, λ and the outputs, in every so-manieth state. */
#include "NAME.h"

#include <stdio.h>
#include <string.h>

static double next(void)
{
    double x = 0;
    if (scanf("%lf", &x) != 1) {
        fprintf(stderr, "a number is missing\n");
    }
    return x;
}

static void print(const NAME_real *x, int count)
{
    for (int at = 0; at < count; at++) {
        const double value = (double)x[at];
        unsigned long long bits;
        memcpy(&bits, &value, sizeof bits);
        printf("%llx ", bits);
    }
}

static int print_line(struct NAME_run *run)
{
    struct NAME_reactions reactions;
    struct NAME_outputs outputs;
    int code = NAME_reactions(run, &reactions);
    if (code == CAPS_OK) {
        code = NAME_outputs(run, &outputs);
    }
    if (code == CAPS_OK) {
        print(&run->state.t, 1);
        print((const NAME_real *)&run->state.q, CAPS_COORDINATES);
        print((const NAME_real *)&run->state.v, CAPS_COORDINATES);
        print((const NAME_real *)&reactions.acceleration, CAPS_COORDINATES);
        print((const NAME_real *)&reactions.multipliers, CAPS_CONSTRAINTS);
        print((const NAME_real *)&outputs, CAPS_OUTPUTS);
        printf("\n");
    }
    return code;
}

int main(void)
{
    struct NAME_parameters parameters;
    struct NAME mechanism;
    struct NAME_run run = {0};
    struct NAME_state state;
    const double step = next();
    const long steps = (long)next(), every = (long)next();
    const double alpha = next(), beta = next();
    const int is_held = (int)next();

    NAME_default_parameters(&parameters);
    int code = NAME_init(&mechanism, &parameters);
    if (code == CAPS_OK) {
        code = NAME_start(&run, &mechanism, step);
    }
    if (code == CAPS_OK && is_held >= 0) {
        code = NAME_set_feedback(&run, alpha, beta, is_held);
    }
    for (int at = 0; at < CAPS_INPUTS; at++) {
        /* what is no number stays as it is */
        const double input = next();
        if (input == input) {
            ((NAME_real *)&run.inputs)[at] = (NAME_real)input;
        }
    }
    if (next() > 0) {
        state.t = (NAME_real)next();
        for (int at = 0; at < CAPS_COORDINATES; at++) {
            ((NAME_real *)&state.q)[at] = (NAME_real)next();
        }
        for (int at = 0; at < CAPS_COORDINATES; at++) {
            ((NAME_real *)&state.v)[at] = (NAME_real)next();
        }
        code = code == CAPS_OK ? NAME_start_from(&run, &state) : code;
    }
    if (code == CAPS_OK) {
        code = print_line(&run);
    }
    for (long k = 1; code == CAPS_OK && k <= steps; k++) {
        code = NAME_step(&run);
        if (code == CAPS_OK && k % every == 0) {
            code = print_line(&run);
        }
    }
    if (code != CAPS_OK) {
        printf("error %d %s: %s\n", code, NAME_words(code), NAME_where(&run, code));
    }
    return 0;
}
