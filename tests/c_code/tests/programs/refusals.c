/* What the free slider-crank refuses, and what it leaves as it was. */
#include "NAME.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition) \
    do { \
        if (!(condition)) { \
            fprintf(stderr, "line %d: %s\n", __LINE__, #condition); \
            exit(1); \
        } \
    } while (0)

int main(void)
{
    struct NAME_parameters parameters;
    struct NAME mechanism;
    struct NAME_run run;
    struct NAME_reactions reactions;

    /* parameters */
    NAME_default_parameters(&parameters);
    CHECK(parameters.l1 == 0.06);
    parameters.l2 = INFINITY;
    CHECK(NAME_init(&mechanism, &parameters) == CAPS_BAD_PARAMETER + 1);
    CHECK(strcmp(NAME_parameter_names[1], "l2") == 0);
    parameters.l2 = -1;
    const int code = NAME_init(&mechanism, &parameters);
    CHECK(code >= CAPS_BAD_CONDITION);
    CHECK(strncmp(NAME_words(code), "l2: ", 4) == 0);
    NAME_default_parameters(&parameters);
    parameters.m1 = -1;
    CHECK(strncmp(NAME_words(NAME_init(&mechanism, &parameters)), "mass of crank: ", 15) == 0);

    /* the start */
    NAME_default_parameters(&parameters);
    CHECK(NAME_init(&mechanism, &parameters) == CAPS_OK);
    CHECK(NAME_start(&run, &mechanism, 0.0) == CAPS_BAD_STEP);
    CHECK(NAME_start(&run, &mechanism, NAN) == CAPS_BAD_STEP);
    CHECK(NAME_start(&run, &mechanism, 1e-3) == CAPS_OK);
    CHECK(NAME_violation(&run) < 1e-15 && NAME_velocity_violation(&run) < 1e-13);
    CHECK(NAME_set_feedback(&run, 1.3e3, 1e3, 0) == CAPS_BAD_GAINS);
    CHECK(NAME_set_feedback(&run, -1.0, 0.0, 1) == CAPS_BAD_GAINS);
    CHECK(NAME_set_feedback(&run, 1e3, 1.4e3, 0) == CAPS_OK);

    /* an input that is not finite, and a state that was good */
    for (int k = 0; k < 10; k++) {
        CHECK(NAME_step(&run) == CAPS_OK);
    }
    const struct NAME_run good = run;
    run.inputs.crank_torque = NAN;
    CHECK(NAME_step(&run) == CAPS_BAD_INPUT && strcmp(NAME_where(&run, CAPS_BAD_INPUT), "crank_torque") == 0);
    CHECK(NAME_reactions(&run, &reactions) == CAPS_BAD_INPUT);
    CHECK(memcmp(&run.state, &good.state, sizeof run.state) == 0 && run.steps == 10);
    run.inputs.crank_torque = 0;
    CHECK(NAME_step(&run) == CAPS_OK && run.steps == 11);

    /* energy is kept without a torque */
    const double energy = NAME_energy(&run);
    for (int k = 0; k < 100; k++) {
        CHECK(NAME_step(&run) == CAPS_OK);
    }
    CHECK(fabs(NAME_energy(&run) - energy) < 1e-2 * energy);

    /* a state that is not finite */
    struct NAME_state bad = run.state;
    bad.v.theta2 = NAN;
    CHECK(NAME_start_from(&run, &bad) == CAPS_NOT_FINITE);
    CHECK(strcmp(NAME_where(&run, CAPS_NOT_FINITE), "theta2") == 0);

    /* one that violates its constraints, or their rates, and one that is kept to the bit */
    bad = run.state;
    bad.q.x2 += 1e-3;
    CHECK(NAME_start_from(&run, &bad) == CAPS_INCONSISTENT);
    CHECK(strcmp(NAME_where(&run, CAPS_INCONSISTENT), "rod_x") == 0);
    bad = run.state;
    bad.v.x3 += 1;
    CHECK(NAME_start_from(&run, &bad) == CAPS_INCONSISTENT);
    CHECK(strcmp(NAME_where(&run, CAPS_INCONSISTENT), "slider") == 0);
    bad = run.state;
    CHECK(NAME_start_from(&run, &bad) == CAPS_OK && run.steps == 0);
    CHECK(memcmp(&run.state, &bad, sizeof bad) == 0);

    /* a step with reactions is both */
    struct NAME_run other = run;
    struct NAME_reactions at_start;
    CHECK(NAME_reactions(&other, &reactions) == CAPS_OK && NAME_step(&other) == CAPS_OK);
    CHECK(NAME_step_with_reactions(&run, &at_start) == CAPS_OK);
    CHECK(memcmp(&run.state, &other.state, sizeof run.state) == 0);
    CHECK(memcmp(&reactions, &at_start, sizeof at_start) == 0);
    CHECK(strcmp(NAME_words(-1), NAME_words(1000)) == 0);
    return 0;
}
