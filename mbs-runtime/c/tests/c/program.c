/* A program of somebody else, in C99 and in C++17: every function, and the digits of runs, which the test compares with
 * those of Rust. Its arguments are a step in s, a number of steps and the files of mechanisms. */
#include <mbs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                                               \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            fprintf(stderr, "line %d: %s; the last error is: %s\n", __LINE__, #condition, mbs_error());                \
            exit(1);                                                                                                   \
        }                                                                                                              \
    } while (0)

static const char PENDULUM[] = "Pendulum { dof = 1; step = 2 [ms];\n"
                               "  param length = 500 [mm] where length > 0;\n"
                               "  input push [N];\n"
                               "  gravity = (0, -9.81) [m/s^2];\n"
                               "  body bob (x, y) { mass = 2 [kg]; }\n"
                               "  constraint rod: x^2 + y^2 = length^2;\n"
                               "  force wind on bob = (push, 0 [N]);\n"
                               "  start { x = length; guess y = 0; }\n"
                               "  output height [mm] = y; }";

static double *numbers(size_t count)
{
    /* without numbers too, so that there is something to free */
    double *room = (double *)malloc((count + 1) * sizeof *room);
    CHECK(room != NULL);
    return room;
}

static size_t count(const mbs_mechanism *mechanism, mbs_kind kind)
{
    size_t found = 0;
    CHECK(mbs_count(mechanism, kind, &found) == MBS_OK);
    return found;
}

static void print(const double *values, size_t many)
{
    for (size_t k = 0; k < many; k++) {
        uint64_t bits;
        memcpy(&bits, &values[k], sizeof bits);
        printf("%llx ", (unsigned long long)bits);
    }
}

/* All that can be read of a run, in the order of the test. */
static void print_run(const mbs_mechanism *mechanism, const mbs_run *run)
{
    const size_t n = count(mechanism, MBS_COORDINATE), m = count(mechanism, MBS_CONSTRAINT);
    const size_t outputs = count(mechanism, MBS_OUTPUT), places = 2 * count(mechanism, MBS_POINT);
    double scalars[6];
    double *q = numbers(n), *v = numbers(n), *a = numbers(n);
    double *multipliers = numbers(m), *y = numbers(outputs), *xy = numbers(places);
    CHECK(mbs_run_time(run, &scalars[0]) == MBS_OK);
    CHECK(mbs_run_energy(run, &scalars[1], &scalars[2]) == MBS_OK);
    CHECK(mbs_run_violation(run, &scalars[3], &scalars[4]) == MBS_OK);
    CHECK(mbs_run_digits(run, &scalars[5]) == MBS_OK);
    CHECK(mbs_run_state(run, q, v, n) == MBS_OK);
    CHECK(mbs_run_reactions(run, a, n, multipliers, m) == MBS_OK);
    CHECK(mbs_run_outputs(run, y, outputs) == MBS_OK);
    CHECK(mbs_run_points(run, xy, places) == MBS_OK);
    print(scalars, 6);
    print(q, n);
    print(v, n);
    print(a, n);
    print(multipliers, m);
    print(y, outputs);
    print(xy, places);
    printf("\n");
    free(q);
    free(v);
    free(a);
    free(multipliers);
    free(y);
    free(xy);
}

static void run_file(const char *path, double step, uint64_t steps)
{
    mbs_mechanism *mechanism;
    mbs_run *run;
    CHECK(mbs_read(path, NULL, 0.0, &mechanism) == MBS_OK);
    CHECK(mbs_run_new(mechanism, NULL, step, &run) == MBS_OK);
    for (size_t k = 0; k < count(mechanism, MBS_INPUT); k++) {
        CHECK(mbs_run_set_input(run, k, 0.5) == MBS_OK);
    }
    CHECK(mbs_run_start(run) == MBS_OK);
    CHECK(mbs_run_step(run, steps) == MBS_OK);
    print_run(mechanism, run);
    mbs_run_free(run);
    mbs_mechanism_free(mechanism);
}

static void describe(const mbs_mechanism *mechanism)
{
    const char *name;
    int32_t freedom;
    size_t index;
    mbs_quantity quantity;
    CHECK(mbs_mechanism_name(mechanism, &name) == MBS_OK && strcmp(name, "Pendulum") == 0);
    CHECK(mbs_mechanism_freedom(mechanism, &freedom) == MBS_OK && freedom == 1);
    CHECK(mbs_find(mechanism, MBS_PARAMETER, "length", &index) == MBS_OK && index == 0);
    CHECK(mbs_find(mechanism, MBS_OUTPUT, "width", &index) == MBS_NAME);
    CHECK(mbs_describe(mechanism, MBS_PARAMETER, 0, &quantity) == MBS_OK);
    CHECK(strcmp(quantity.unit, "mm") == 0 && quantity.scale == 1e-3 && quantity.value == 0.5);
    CHECK(mbs_describe(mechanism, MBS_POINT, 2, &quantity) == MBS_INDEX);
    CHECK(mbs_count(mechanism, (mbs_kind)0, &index) == MBS_INDEX);
}

static void play(const mbs_mechanism *mechanism)
{
    mbs_run *run, *copy;
    double t, q[2], v[2], parameter, input, later;
    CHECK(mbs_run_new(mechanism, "euler", 1e-3, &run) == MBS_NAME && run == NULL);
    CHECK(mbs_run_new(mechanism, "rk4 projection", 0.0, &run) == MBS_OK);
    CHECK(mbs_run_step(run, 1) == MBS_NOT_STARTED);
    CHECK(mbs_run_set_parameter(run, 0, 1.0) == MBS_OK);
    CHECK(mbs_run_start(run) == MBS_OK);
    CHECK(mbs_run_step(run, 1) == MBS_OK && mbs_run_time(run, &t) == MBS_OK && t == 0.002);
    CHECK(mbs_run_advance_to(run, 0.1) == MBS_OK && mbs_run_time(run, &t) == MBS_OK && fabs(t - 0.1) < 1e-15);
    CHECK(mbs_run_set_input(run, 0, 2.0) == MBS_OK);
    CHECK(mbs_run_parameters(run, &parameter, 1) == MBS_OK && parameter == 1.0);
    CHECK(mbs_run_inputs(run, &input, 1) == MBS_OK && input == 2.0);
    CHECK(mbs_run_inputs(run, &input, 2) == MBS_COUNT);
    /* a step that is tried, and taken back */
    CHECK(mbs_run_clone(run, &copy) == MBS_OK);
    CHECK(mbs_run_step(run, 1) == MBS_OK && mbs_run_time(run, &later) == MBS_OK && later > t);
    mbs_run_free(run);
    CHECK(mbs_run_time(copy, &later) == MBS_OK && later == t);
    /* anew from its state, to a tolerance */
    CHECK(mbs_run_state(copy, q, v, 2) == MBS_OK);
    CHECK(mbs_run_set_start(copy, 1.0, q, v, 2) == MBS_OK);
    CHECK(mbs_run_set_tolerances(copy, 1e-8, 1e-10) == MBS_OK);
    CHECK(mbs_run_start(copy) == MBS_METHOD);
    mbs_run_free(copy);
    CHECK(mbs_run_new(mechanism, "dopri5", 0.01, &run) == MBS_OK);
    CHECK(mbs_run_set_parameter(run, 0, 1.0) == MBS_OK);
    CHECK(mbs_run_set_start(run, 1.0, q, v, 2) == MBS_OK);
    CHECK(mbs_run_set_tolerances(run, 1e-8, 1e-10) == MBS_OK);
    CHECK(mbs_run_start(run) == MBS_OK && mbs_run_step(run, 10) == MBS_OK);
    CHECK(mbs_run_time(run, &t) == MBS_OK && fabs(t - 1.1) < 1e-14);
    mbs_run_free(run);
    CHECK(mbs_run_new(mechanism, "per-stage", 1e-3, &run) == MBS_OK);
    CHECK(mbs_run_set_gains(run, 1e5, 1e5) == MBS_OK && mbs_run_start(run) == MBS_METHOD);
    CHECK(mbs_run_set_gains(run, 100.0, 150.0) == MBS_OK && mbs_run_start(run) == MBS_OK);
    CHECK(mbs_run_set_input(run, 0, 1e308) == MBS_OK && mbs_run_step(run, 2) == MBS_DIVERGED);
    CHECK(strstr(mbs_error(), "no longer finite") != NULL);
    mbs_run_free(run);
}

static void refuse(void)
{
    mbs_mechanism *mechanism;
    mbs_problem problem;
    CHECK(mbs_compile("Pendulum {\n  dof = 1;\n  bodi bob (x) { }\n}", "wrong.mbs", NULL, 0.0, &mechanism) ==
          MBS_DECLARATION);
    CHECK(mechanism == NULL && strstr(mbs_error(), "wrong.mbs:3:3") != NULL);
    CHECK(mbs_problem_count() == 1 && mbs_problem_at(0, &problem) == MBS_OK);
    CHECK(problem.line == 3 && problem.column == 3 && problem.length == 4);
    CHECK(strlen(problem.message) > 0 && strlen(problem.help) > 0);
    CHECK(mbs_problem_at(1, &problem) == MBS_INDEX);
    CHECK(mbs_compile(NULL, NULL, NULL, 0.0, &mechanism) == MBS_NULL);
    CHECK(mbs_compile("\xff", NULL, NULL, 0.0, &mechanism) == MBS_UTF8);
    CHECK(mbs_read("/nowhere", NULL, 0.0, &mechanism) == MBS_FILE);
    mbs_mechanism_free(NULL);
    mbs_run_free(NULL);
}

int main(int many, char **arguments)
{
    mbs_mechanism *mechanism;
    CHECK(mbs_abi() == MBS_ABI && strlen(mbs_version()) >= 5);
    CHECK(strcmp(mbs_status_text(MBS_SINGULAR), "singular position") == 0);
    CHECK(strcmp(mbs_error(), "") == 0 && mbs_problem_count() == 0);
    refuse();
    CHECK(mbs_compile(PENDULUM, NULL, NULL, 10.0, &mechanism) == MBS_OK);
    describe(mechanism);
    play(mechanism);
    mbs_mechanism_free(mechanism);
    for (int k = 3; k < many; k++) {
        run_file(arguments[k], atof(arguments[1]), (uint64_t)atoi(arguments[2]));
    }
    return 0;
}
