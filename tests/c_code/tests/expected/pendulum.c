#include "pendulum.h"

#include <math.h>

typedef pendulum_real real;

/* Structs of numbers as arrays: they have no padding. */
#define pendulum_elements(vector) ((const real *)(vector))
#define pendulum_places(vector) ((real *)(vector))

/* The distance from 1 to the next larger number, and the pivot growth from which on a
   position is singular: fewer than ten bits are left. */
static const real pendulum_epsilon = 2.220446049250313e-16;
static const real pendulum_growth_limit = 4398046511104.0;

typedef char pendulum_parameters_are_an_array[sizeof(struct pendulum_parameters) == 1 * sizeof(real) ? 1 : -1];
typedef char pendulum_inputs_are_an_array[sizeof(struct pendulum_inputs) == 1 * sizeof(real) ? 1 : -1];
typedef char pendulum_coordinates_are_an_array[sizeof(struct pendulum_coordinates) == 2 * sizeof(real) ? 1 : -1];
typedef char pendulum_constraints_are_an_array[sizeof(struct pendulum_constraints) == 1 * sizeof(real) ? 1 : -1];
typedef char pendulum_outputs_are_an_array[sizeof(struct pendulum_outputs) == 1 * sizeof(real) ? 1 : -1];

const char *const pendulum_parameter_names[] = {
    "length", 0,
};

const char *const pendulum_input_names[] = {
    "wind", 0,
};

const char *const pendulum_coordinate_names[] = {
    "x", "y", 0,
};

const char *const pendulum_constraint_names[] = {
    "rod", 0,
};

const char *const pendulum_output_names[] = {
    "height", 0,
};

const char *const pendulum_point_names[] = {
    "bob", "ground", 0,
};

static const char *const pendulum_pivot_names[] = {
    "rod", 0,
};

static const char *const pendulum_start_pivot_names[] = {
    "rod", 0,
};

const int pendulum_phi_q_places[][2] = {
    {0, 0}, {0, 1}, {0, 0},
};

static const int pendulum_redundant[] = {
    0,
};

/* The power of a length in the dimension. */
static const int pendulum_coordinate_length[] = {
    1, 1, 0,
};

static const int pendulum_constraint_length[] = {
    2, 0,
};

static const real pendulum_declared[] = {
    1.0, 0,
};

/* What is judged, its sign, and whether it must not be 0. */
static const int pendulum_conditions[][3] = {
    {0, 1, 0}, {0, 0, 0},
};

static const char *const pendulum_condition_words[] = {
    "mass of bob: it must not be negative", 0,
};

static const char *const pendulum_error_words[] = {
    "no error",
    "the position is singular: constraints depend on each other there, or friction jams",
    "constraints depend on each other at the start",
    "a position or a velocity is no longer finite",
    "the mechanism cannot be assembled: check the dimensions, or start from a closer guess",
    "a constraint cannot be met any more: check the dimensions and how far the drives go",
    "a multiplier is not finite, though the motion is", "an output is not finite",
    "an input is not finite",
    "the step has to be positive, finite, and more than the rounding of time",
    "gains must not be negative, and violations must not grow with them from step to step",
    "the given state violates a constraint, or its rate, too much to be kept as it is", 0,
};

/* The table of Heun's method, and its gains for a step of 1 s. */
static const double pendulum_share[PENDULUM_STAGES] = {1.0, 0.5};
static const double pendulum_node[PENDULUM_STAGES] = {1.0, 1.0};
static const double pendulum_weight[PENDULUM_STAGES][PENDULUM_STAGES] = {{1.0}, {1.0, 1.0}};
static const double pendulum_deadbeat[2] = {0.75, 1.0};

/** What depends on parameters alone.
    Cost: 1 mul + 0 add + 0 div + 0 sincos. */
static void pendulum_compute_hoisted(
    const struct pendulum *m,
    pendulum_real *result)
{
    (void)m; (void)result;
    const real v0 = m->parameters.length * m->parameters.length;
    result[0] = v0;
}

void pendulum_compute_phi(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_constraints *result)
{
    (void)m; (void)t; (void)q; (void)result;
    const real v0 = q->x * q->x;
    const real v1 = q->y * q->y;
    const real v2 = v1 - m->hoisted[0];
    const real phi_rod_3 = v0 + v2;
    result->rod = phi_rod_3;
}

void pendulum_compute_phi_dot(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_constraints *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)result;
    const real v0 = 2.0 * v->x;
    const real v1 = q->x * v0;
    const real v2 = 2.0 * v->y;
    const real v3 = q->y * v2;
    const real phi_dot_rod_4 = v3 + v1;
    result->rod = phi_dot_rod_4;
}

void pendulum_compute_phi_q(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result)
{
    (void)m; (void)t; (void)q; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real phi_q_rod_y_1 = 2.0 * q->y;
    result[0] = phi_q_rod_x_0;
    result[1] = phi_q_rod_y_1;
}

void pendulum_compute_phi_t(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_constraints *result)
{
    (void)m; (void)t; (void)q; (void)result;
    result->rod = 0.0;
}

void pendulum_compute_gamma(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_constraints *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)result;
    const real v0 = 2.0 * v->x;
    const real v1 = v->x * v0;
    const real v2 = 2.0 * v->y;
    const real v3 = v->y * v2;
    const real v4 = v3 + v1;
    const real gamma_rod_5 = -v4;
    result->rod = gamma_rod_5;
}

void pendulum_compute_baumgarte_rhs(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_gains *gains,
    struct pendulum_constraints *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)gains; (void)result;
    const real v0 = 2.0 * v->x;
    const real v1 = v->x * v0;
    const real v2 = 2.0 * v->y;
    const real v3 = v->y * v2;
    const real v4 = q->x * q->x;
    const real v5 = q->y * q->y;
    const real v6 = v5 - m->hoisted[0];
    const real phi_rod_7 = v4 + v6;
    const real v8 = gains->minus_beta_squared * phi_rod_7;
    const real v9 = q->x * v0;
    const real v10 = q->y * v2;
    const real phi_dot_rod_11 = v10 + v9;
    const real v12 = gains->minus_two_alpha * phi_dot_rod_11;
    const real v13 = v3 + v1;
    const real v14 = v12 - v13;
    const real v15 = v8 + v14;
    result->rod = v15;
}

void pendulum_compute_mass(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)result;
    result->x = 2.0;
    result->y = 2.0;
}

void pendulum_compute_forces(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)result;
    result->x = inputs->wind;
    result->y = (-19.62);
}

pendulum_real pendulum_compute_kinetic_energy(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v)
{
    (void)m; (void)t; (void)q; (void)v;
    const real v0 = v->x * v->x;
    const real v1 = v->y * v->y;
    const real v2 = v1 + v0;
    return v2;
}

pendulum_real pendulum_compute_potential_energy(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v)
{
    (void)m; (void)t; (void)q; (void)v;
    const real v0 = 19.62 * q->y;
    return v0;
}

pendulum_real pendulum_compute_stabilized(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_gains *gains,
    struct pendulum_coordinates *acceleration,
    struct pendulum_constraints *feedback)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)gains; (void)acceleration; (void)feedback;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = q->x * q->x;
    const real v8 = q->y * q->y;
    const real v9 = v8 - m->hoisted[0];
    const real phi_rod_10 = v7 + v9;
    const real v11 = gains->minus_beta_squared * phi_rod_10;
    const real v12 = v->x * phi_q_rod_x_0;
    const real v13 = v->y * phi_q_rod_y_3;
    const real phi_dot_rod_14 = v13 + v12;
    const real v15 = gains->minus_two_alpha * phi_dot_rod_14;
    const real feedback_rod_16 = v15 + v11;
    const real v17 = inputs->wind * v1;
    const real v18 = v->x * v->x;
    const real v19 = 2.0 * v18;
    const real v20 = v->y * v->y;
    const real v21 = 2.0 * v20;
    const real v22 = 9.81 * phi_q_rod_y_3;
    const real v23 = v22 - v21;
    const real v24 = v23 - v19;
    const real v25 = v24 - v17;
    const real v26 = v25 + feedback_rod_16;
    const real v27 = v26 / v6;
    const real v28 = v1 * v27;
    const real v29 = 0.5 * inputs->wind;
    const real acc_x_30 = v29 + v28;
    const real v31 = v4 * v27;
    const real acc_y_32 = v31 - 9.81;
    acceleration->x = acc_x_30;
    acceleration->y = acc_y_32;
    feedback->rod = feedback_rod_16;
    return 0.0;
}

pendulum_real pendulum_compute_constrained(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)feedback; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = inputs->wind * v1;
    const real v8 = v->x * v->x;
    const real v9 = 2.0 * v8;
    const real v10 = v->y * v->y;
    const real v11 = 2.0 * v10;
    const real v12 = 9.81 * phi_q_rod_y_3;
    const real v13 = feedback->rod + v12;
    const real v14 = v11 + v9;
    const real v15 = v13 - v14;
    const real v16 = v15 - v7;
    const real v17 = v16 / v6;
    const real v18 = v1 * v17;
    const real v19 = 0.5 * inputs->wind;
    const real acc_x_20 = v19 + v18;
    const real v21 = v4 * v17;
    const real acc_y_22 = v21 - 9.81;
    result->x = acc_x_20;
    result->y = acc_y_22;
    return 0.0;
}

pendulum_real pendulum_compute_reactions(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *acceleration,
    struct pendulum_constraints *multipliers)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)feedback; (void)acceleration; (void)multipliers;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = inputs->wind * v1;
    const real v8 = v->x * v->x;
    const real v9 = 2.0 * v8;
    const real v10 = v->y * v->y;
    const real v11 = 2.0 * v10;
    const real v12 = 9.81 * phi_q_rod_y_3;
    const real v13 = feedback->rod + v12;
    const real v14 = v11 + v9;
    const real v15 = v13 - v14;
    const real v16 = v15 - v7;
    const real v17 = v16 / v6;
    const real v18 = v1 * v17;
    const real v19 = 0.5 * inputs->wind;
    const real acc_x_20 = v19 + v18;
    const real v21 = v4 * v17;
    const real acc_y_22 = v21 - 9.81;
    const real lambda_rod_23 = -v17;
    acceleration->x = acc_x_20;
    acceleration->y = acc_y_22;
    multipliers->rod = lambda_rod_23;
    return 0.0;
}

pendulum_real pendulum_compute_position_correction(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)feedback; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = feedback->rod / v6;
    const real v8 = v1 * v7;
    const real v9 = v4 * v7;
    result->x = v8;
    result->y = v9;
    return 0.0;
}

pendulum_real pendulum_compute_velocity_correction(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)feedback; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = feedback->rod / v6;
    const real v8 = v1 * v7;
    const real v9 = v4 * v7;
    result->x = v8;
    result->y = v9;
    return 0.0;
}

pendulum_real pendulum_compute_projection(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result)
{
    (void)m; (void)t; (void)q; (void)feedback; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = feedback->rod / v6;
    const real v8 = v1 * v7;
    const real v9 = v4 * v7;
    result->x = v8;
    result->y = v9;
    return 0.0;
}

void pendulum_compute_outputs(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_reactions *reactions,
    struct pendulum_outputs *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)reactions; (void)result;
    result->height = q->y;
}

void pendulum_compute_events(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    pendulum_real *result)
{
    (void)m; (void)t; (void)q; (void)v; (void)inputs; (void)result;
}

/** What the conditions of the parameters judge.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
static void pendulum_compute_conditions(
    const struct pendulum *m,
    pendulum_real *result)
{
    (void)m; (void)result;
    result[0] = 2.0;
    result[1] = 2.0;
}

pendulum_real pendulum_compute_declared_start(
    const struct pendulum *m,
    struct pendulum_coordinates *q,
    struct pendulum_coordinates *v)
{
    (void)m; (void)q; (void)v;
    q->x = m->parameters.length;
    q->y = 0.0;
    v->x = 0.0;
    v->y = 0.0;
    return 0.0;
}

void pendulum_compute_pivots(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result)
{
    (void)m; (void)t; (void)q; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = v6 / v6;
    const real v8 = fabs(v7);
    result[0] = v8;
}

void pendulum_compute_start_pivots(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result)
{
    (void)m; (void)t; (void)q; (void)result;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = v6 / v6;
    const real v8 = fabs(v7);
    result[0] = v8;
}

void pendulum_compute_points(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result)
{
    (void)m; (void)t; (void)q; (void)result;
    result[0] = q->x;
    result[1] = q->y;
    result[2] = 0.0;
    result[3] = 0.0;
}

void pendulum_compute_complete(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_coordinates *q_all,
    struct pendulum_coordinates *v_all)
{
    (void)m; (void)t; (void)q; (void)v; (void)q_all; (void)v_all;
    q_all->x = q->x;
    q_all->y = q->y;
    v_all->x = v->x;
    v_all->y = v->y;
}

/* Small functions on vectors. */

static real pendulum_norm(const struct pendulum_constraints *phi)
{
    const real *const x = pendulum_elements(phi);
    real sum = 0;
    for (int at = 0; at < PENDULUM_CONSTRAINTS; at++) {
        sum = sum + x[at] * x[at];
    }
    return sqrt(sum);
}

/* x + scale y, in the place of x. */
static void pendulum_add(real *x, real scale, const real *y, int count)
{
    for (int at = 0; at < count; at++) {
        x[at] = x[at] + scale * y[at];
    }
}

/* Where the largest magnitude stands, or the first that is not finite; -1 where there is none. */
static int pendulum_place(const real *x, int count)
{
    int place = -1;
    for (int at = 0; at < count; at++) {
        if (!isfinite(x[at])) {
            return at;
        }
        place = place < 0 || fabs(x[at]) > fabs(x[place]) ? at : place;
    }
    return place;
}

static real pendulum_largest(const real *x, int count)
{
    const int place = pendulum_place(x, count);
    return place < 0 ? 0 : fabs(x[place]);
}

static int pendulum_first_non_finite(const real *x, int count)
{
    const int place = pendulum_place(x, count);
    return place < 0 || isfinite(x[place]) ? -1 : place;
}

static int pendulum_is_finite(const struct pendulum_coordinates *x)
{
    return pendulum_first_non_finite(pendulum_elements(x), PENDULUM_COORDINATES) < 0;
}

/* The size of coordinates that rounding is compared with. */
static real pendulum_extent(const struct pendulum_coordinates *q)
{
    return 1 + pendulum_largest(pendulum_elements(q), PENDULUM_COORDINATES);
}

/* Refuses what is not finite: an input, a position or a velocity. */
static int pendulum_check_state(struct pendulum_run *run, const struct pendulum_state *at)
{
    run->where = pendulum_first_non_finite(pendulum_elements(&run->inputs), PENDULUM_INPUTS);
    if (run->where >= 0) {
        return PENDULUM_BAD_INPUT;
    }
    run->where = pendulum_first_non_finite(pendulum_elements(&at->q), PENDULUM_COORDINATES);
    if (run->where < 0) {
        run->where = pendulum_first_non_finite(pendulum_elements(&at->v), PENDULUM_COORDINATES);
    }
    return run->where < 0 ? PENDULUM_OK : PENDULUM_NOT_FINITE;
}

/* Why a solution with pivots of these growths is no good: a position that is not finite, a pivot,
   or, with all pivots healthy, a component that is not finite. */
static int pendulum_cause(
    struct pendulum_run *run, const struct pendulum_coordinates *q, const struct pendulum_coordinates *solution,
    real growth, real limit, const real *growths, int pivots)
{
    const int pivot = pendulum_place(growths, pivots);
    run->where = pendulum_first_non_finite(pendulum_elements(q), PENDULUM_COORDINATES);
    if (run->where < 0 && growth < limit && (pivot < 0 || growths[pivot] < limit)) {
        run->where = pendulum_first_non_finite(pendulum_elements(solution), PENDULUM_COORDINATES);
    }
    if (run->where >= 0) {
        return PENDULUM_NOT_FINITE;
    }
    run->where = pivot >= 0 && !(growths[pivot] < limit / 64) ? pivot : -1;
    return PENDULUM_SINGULAR;
}

/* The same of accelerations. */
static int pendulum_cause_of(
    struct pendulum_run *run, real t, const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *acceleration, real growth, real limit)
{
    real growths[PENDULUM_PIVOTS + 1] = {0};
    pendulum_compute_pivots(run->mechanism, t, q, growths);
    return pendulum_cause(run, q, acceleration, growth, limit, growths, PENDULUM_PIVOTS);
}

/* Redundant constraints take no part in starts and steps: with parameters for which they do not
   fit they would be violated. They may be by a share of the size, to the power of a length. */
static int pendulum_meets_redundant(struct pendulum_run *run, const struct pendulum_state *at, real share, real size)
{
    struct pendulum_constraints phi = {0};
    if (PENDULUM_REDUNDANT > 0) {
        pendulum_compute_phi(run->mechanism, at->t, &at->q, &phi);
    }
    for (int k = 0; k < PENDULUM_REDUNDANT; k++) {
        const int row = pendulum_redundant[k];
        real allowed = share;
        for (int power = 0; power < pendulum_constraint_length[row]; power++) {
            allowed = allowed * size;
        }
        if (!(fabs(pendulum_elements(&phi)[row]) <= allowed)) {
            run->where = row;
            return 0;
        }
    }
    return 1;
}

/* The mechanism, and what codes mean. */

void pendulum_default_parameters(struct pendulum_parameters *parameters)
{
    for (int at = 0; at < (PENDULUM_PARAMETERS > 0 ? PENDULUM_PARAMETERS : 1); at++) {
        pendulum_places(parameters)[at] = pendulum_declared[at];
    }
}

int pendulum_init(struct pendulum *m, const struct pendulum_parameters *parameters)
{
    real values[PENDULUM_CONDITION_VALUES + 1] = {0};
    m->parameters = *parameters;
    const int infinite = pendulum_first_non_finite(pendulum_elements(parameters), PENDULUM_PARAMETERS);
    if (infinite >= 0) {
        return PENDULUM_BAD_PARAMETER + infinite;
    }
    pendulum_compute_conditions(m, values);
    for (int at = 0; at < PENDULUM_CONDITIONS; at++) {
        const int *const condition = pendulum_conditions[at];
        const real value = (real)condition[1] * values[condition[0]];
        if (!(condition[2] ? value > 0 : value >= 0)) {
            return PENDULUM_BAD_CONDITION + at;
        }
    }
    pendulum_compute_hoisted(m, m->hoisted);
    return PENDULUM_OK;
}

const char *pendulum_words(int code)
{
    if (code < 0 || code >= PENDULUM_BAD_CONDITION + PENDULUM_CONDITIONS) {
        return "no such code";
    }
    if (code >= PENDULUM_BAD_CONDITION) {
        return pendulum_condition_words[code - PENDULUM_BAD_CONDITION];
    }
    return code < PENDULUM_BAD_PARAMETER ? pendulum_error_words[code] : "a parameter is not finite";
}

/* All coordinates are integrated. */

static inline void pendulum_select(const struct pendulum_state *all, struct pendulum_state *at)
{
    *at = *all;
}

static inline void pendulum_complete(
    const struct pendulum *m, const struct pendulum_state *at, struct pendulum_state *all)
{
    (void)m;
    *all = *at;
}

static void pendulum_spread(const struct pendulum_coordinates *states, struct pendulum_coordinates *all)
{
    *all = *states;
}

/* The start. */

/* Refuses a correction of the start in a singular position. */
static int pendulum_check_correction(
    struct pendulum_run *run, const struct pendulum_coordinates *correction, real growth)
{
    const struct pendulum_state *const at = &run->state;
    real growths[PENDULUM_START_PIVOTS + 1] = {0};
    if (pendulum_is_finite(correction) && growth < pendulum_growth_limit) {
        return PENDULUM_OK;
    }
    pendulum_compute_start_pivots(run->mechanism, at->t, &at->q, growths);
    const int code =
        pendulum_cause(run, &at->q, correction, growth, pendulum_growth_limit, growths, PENDULUM_START_PIVOTS);
    return code == PENDULUM_SINGULAR ? PENDULUM_SINGULAR_START : code;
}

/* q becomes q + delta, or what the longest halved step that does not enlarge the violation
   leads to; phi becomes the violation there. */
static void pendulum_damped(
    struct pendulum_run *run, const struct pendulum_coordinates *delta, struct pendulum_constraints *phi)
{
    const struct pendulum_coordinates q = run->state.q;
    const real violation = pendulum_norm(phi);
    real length = 1;
    for (int halvings = 0; halvings <= 10; halvings++) {
        run->state.q = q;
        pendulum_add(pendulum_places(&run->state.q), length, pendulum_elements(delta), PENDULUM_COORDINATES);
        pendulum_compute_phi(run->mechanism, run->state.t, &run->state.q, phi);
        if (pendulum_norm(phi) < violation) {
            return;
        }
        length = length / 2;
    }
}

/* Positions on phi = 0 by Newton's iteration. */
static int pendulum_assemble(struct pendulum_run *run)
{
    struct pendulum_coordinates *const q = &run->state.q;
    struct pendulum_constraints phi = {0};
    int is_at_rest = 0;
    pendulum_compute_phi(run->mechanism, run->state.t, q, &phi);
    for (int iteration = 0; iteration < 50 && !is_at_rest; iteration++) {
        struct pendulum_constraints residual = {0};
        struct pendulum_coordinates delta;
        pendulum_add(pendulum_places(&residual), -1, pendulum_elements(&phi), PENDULUM_CONSTRAINTS);
        const real growth =
            pendulum_compute_position_correction(run->mechanism, run->state.t, q, &residual, &delta);
        const int code = pendulum_check_correction(run, &delta, growth);
        if (code != PENDULUM_OK) {
            return code;
        }
        const real length = pendulum_largest(pendulum_elements(&delta), PENDULUM_COORDINATES);
        is_at_rest = length <= 4 * pendulum_epsilon * pendulum_extent(q);
        if (is_at_rest) {
            pendulum_add(pendulum_places(q), 1, pendulum_elements(&delta), PENDULUM_COORDINATES);
        } else {
            pendulum_damped(run, &delta, &phi);
        }
    }
    run->where = pendulum_place(pendulum_elements(&phi), PENDULUM_CONSTRAINTS);
    const real most = pendulum_largest(pendulum_elements(&phi), PENDULUM_CONSTRAINTS);
    /* it may circle at rounding level, where the violation itself is at rounding */
    if (is_at_rest || most <= 64 * pendulum_epsilon * pendulum_extent(q)) {
        is_at_rest = pendulum_meets_redundant(run, &run->state, sqrt(pendulum_epsilon) * pendulum_extent(q), 1);
    }
    return is_at_rest ? PENDULUM_OK : PENDULUM_NOT_ASSEMBLED;
}

/* Velocities whose constraints hold: one solution and one refinement of it. */
static int pendulum_project_velocities(struct pendulum_run *run)
{
    struct pendulum_state *const at = &run->state;
    for (int pass = 0; pass < 2; pass++) {
        struct pendulum_constraints phi_dot = {0}, residual = {0};
        struct pendulum_coordinates delta;
        pendulum_compute_phi_dot(run->mechanism, at->t, &at->q, &at->v, &phi_dot);
        pendulum_add(pendulum_places(&residual), -1, pendulum_elements(&phi_dot), PENDULUM_CONSTRAINTS);
        const real growth =
            pendulum_compute_velocity_correction(run->mechanism, at->t, &at->q, &residual, &delta);
        const int code = pendulum_check_correction(run, &delta, growth);
        if (code != PENDULUM_OK) {
            return code;
        }
        pendulum_add(pendulum_places(&at->v), 1, pendulum_elements(&delta), PENDULUM_COORDINATES);
    }
    return PENDULUM_OK;
}

/* The size of the mechanism: the largest coordinate that is a length, or lever arm. */
static real pendulum_size(const struct pendulum *m, const struct pendulum_state *at)
{
    real size = 0, entries[PENDULUM_JACOBIAN + 1] = {0};
    for (int j = 0; j < PENDULUM_COORDINATES; j++) {
        const real length = pendulum_coordinate_length[j] != 0 ? fabs(pendulum_elements(&at->q)[j]) : 0;
        size = length > size ? length : size;
    }
    pendulum_compute_phi_q(m, at->t, &at->q, entries);
    for (int k = 0; k < PENDULUM_JACOBIAN; k++) {
        const int *const place = pendulum_phi_q_places[k];
        const int is_arm = pendulum_constraint_length[place[0]] == 1 && pendulum_coordinate_length[place[1]] == 0;
        size = is_arm && fabs(entries[k]) > size ? fabs(entries[k]) : size;
    }
    return size;
}

int pendulum_set_feedback(struct pendulum_run *run, double alpha, double beta, int is_held)
{
    const double h = (double)run->step;
    const double a = 2.0 * alpha * h;
    const double b = beta * h * (beta * h);
    /* what a step makes of (e, h e') = (1, 0) and (0, 1) where e'' + 2 alpha e' + beta^2 e = 0 */
    double e[2][PENDULUM_STAGES + 1] = {{1.0}, {0.0}}, v[2][PENDULUM_STAGES + 1] = {{0.0}, {1.0}};
    for (int start = 0; start < 2; start++) {
        for (int last = 0; last < PENDULUM_STAGES; last++) {
            double e_sum = 0.0, v_sum = 0.0;
            for (int stage = 0; stage <= last; stage++) {
                const int from = is_held ? 0 : stage;
                const double weight = pendulum_share[last] * pendulum_weight[last][stage];
                e_sum += weight * v[start][stage];
                v_sum -= weight * (a * v[start][from] + b * e[start][from]);
            }
            e[start][last + 1] = e[start][0] + e_sum;
            v[start][last + 1] = v[start][0] + v_sum;
        }
    }
    const int end = PENDULUM_STAGES;
    const double trace = e[0][end] + v[1][end];
    const double determinant = e[0][end] * v[1][end] - e[1][end] * v[0][end];
    /* both eigenvalues of the map from step to step lie in the unit disc, up to rounding */
    const double slack = 16.0 * 2.220446049250313e-16 * (1.0 + a + b) * (1.0 + a + b);
    const int is_stable = fabs(trace) <= 1.0 + determinant + slack && determinant <= 1.0 + slack;
    if (!(alpha >= 0.0 && beta >= 0.0 && is_stable)) {
        return PENDULUM_BAD_GAINS;
    }
    run->gains.minus_two_alpha = (real)(-2.0 * alpha);
    run->gains.minus_beta_squared = (real)(-beta * beta);
    run->is_held = is_held;
    return PENDULUM_OK;
}

/* The watch over a run that begins. */
static void pendulum_begin(struct pendulum_run *run)
{
    struct pendulum_state at;
    pendulum_select(&run->state, &at);
    pendulum_complete(run->mechanism, &at, &run->state);
    run->start_time = run->state.t;
    run->steps = 0;
    run->worst_growth = 0;
    run->alarm = run->remembered_from = 64;
    run->size = pendulum_size(run->mechanism, &run->state);
}

/* Refuses a given state that violates a constraint by more than a thousandth of its size, or the
   rate of one by more than a thousandth of the motion, beside roundings of the size. */
static int pendulum_check_consistent(struct pendulum_run *run, const struct pendulum_state *at)
{
    const struct pendulum *const m = run->mechanism;
    const real *const v = pendulum_elements(&at->v);
    const real share = (real)1e-3, length = pendulum_size(m, at), roundings = 1024 * pendulum_epsilon / run->step;
    real entries[PENDULUM_JACOBIAN + 1] = {0}, sizes[PENDULUM_CONSTRAINTS + 1] = {0}, fastest = 0;
    struct pendulum_constraints phi = {0}, phi_dot = {0}, rates = {0};
    pendulum_compute_phi(m, at->t, &at->q, &phi);
    pendulum_compute_phi_dot(m, at->t, &at->q, &at->v, &phi_dot);
    pendulum_compute_phi_t(m, at->t, &at->q, &rates);
    pendulum_compute_phi_q(m, at->t, &at->q, entries);
    for (int row = 0; row < PENDULUM_CONSTRAINTS; row++) {
        pendulum_places(&rates)[row] = fabs(pendulum_elements(&rates)[row]);
    }
    for (int j = 0; j < PENDULUM_COORDINATES; j++) {
        const real scale = pendulum_coordinate_length[j] == 0 ? 1 : length;
        fastest = fabs(v[j]) > fastest * scale && scale > 0 ? fabs(v[j]) / scale : fastest;
    }
    for (int k = 0; k < PENDULUM_JACOBIAN; k++) {
        const int row = pendulum_phi_q_places[k][0], j = pendulum_phi_q_places[k][1];
        sizes[row] += fabs(entries[k]) * (pendulum_coordinate_length[j] == 0 ? 1 : length);
        pendulum_places(&rates)[row] += fabs(entries[k] * v[j]);
    }
    for (int row = 0; row < PENDULUM_CONSTRAINTS; row++) {
        const real size = sizes[row], motion = pendulum_elements(&rates)[row];
        const real rate = motion > size * fastest ? motion : size * fastest;
        run->where = row;
        if (!(fabs(pendulum_elements(&phi)[row]) <= share * size)
            || !(fabs(pendulum_elements(&phi_dot)[row]) <= share * rate + roundings * size)) {
            return PENDULUM_INCONSISTENT;
        }
    }
    return PENDULUM_OK;
}

int pendulum_start_from(struct pendulum_run *run, const struct pendulum_state *state)
{
    int code = pendulum_check_state(run, state);
    code = code == PENDULUM_OK ? pendulum_check_consistent(run, state) : code;
    if (code == PENDULUM_OK) {
        run->state = *state;
        pendulum_begin(run);
    }
    return code;
}

int pendulum_start(struct pendulum_run *run, const struct pendulum *m, double step)
{
    const struct pendulum_run nothing = {0};
    *run = nothing;
    run->mechanism = m;
    run->where = -1;
    run->step = (real)step;
    run->state.t = pendulum_compute_declared_start(m, &run->state.q, &run->state.v);
    if (!(run->step > 0 && isfinite(run->step) && 4 * pendulum_epsilon * fabs(run->state.t) <= run->step)) {
        return PENDULUM_BAD_STEP;
    }
    int code = pendulum_set_feedback(run, pendulum_deadbeat[0] / step, pendulum_deadbeat[1] / step, 1);
    code = code == PENDULUM_OK ? pendulum_assemble(run) : code;
    code = code == PENDULUM_OK ? pendulum_project_velocities(run) : code;
    code = code == PENDULUM_OK ? pendulum_check_state(run, &run->state) : code;
    pendulum_begin(run);
    return code;
}

/* A step. */

/* The stages of a step, the first one at its start, and behind them its end. */
struct pendulum_trial {
    struct pendulum_state at[PENDULUM_STAGES + 1];
    struct pendulum_coordinates solved[PENDULUM_STAGES];
    real growth[PENDULUM_STAGES];
};

/* Leads to what stands behind some solved stages: x = x0 + (share h) (w_1 k_1 + w_2 k_2 + ...). */
static void pendulum_lead(struct pendulum_trial *trial, int last, real h, real t_next)
{
    const struct pendulum_state *const start = trial->at;
    struct pendulum_state *const to = &trial->at[last + 1];
    const real factor = (real)pendulum_share[last] * h;
    to->t = pendulum_node[last] < 1 ? start->t + (real)pendulum_node[last] * h : t_next;
    for (int j = 0; j < PENDULUM_COORDINATES; j++) {
        real v = 0, a = 0;
        for (int stage = 0; stage <= last; stage++) {
            const real weight = (real)pendulum_weight[last][stage];
            v = v + weight * pendulum_elements(&trial->at[stage].v)[j];
            a = a + weight * pendulum_elements(&trial->solved[stage])[j];
        }
        pendulum_places(&to->q)[j] = pendulum_elements(&start->q)[j] + factor * v;
        pendulum_places(&to->v)[j] = pendulum_elements(&start->v)[j] + factor * a;
    }
}

/* A step stage by stage; the growths of all, added. */
static real pendulum_try(const struct pendulum_run *run, real t_next, struct pendulum_trial *trial)
{
    const struct pendulum *const m = run->mechanism;
    struct pendulum_constraints feedback = {0}, unread = {0};
    real growth = 0;
    pendulum_select(&run->state, &trial->at[0]);
    for (int stage = 0; stage < PENDULUM_STAGES; stage++) {
        const struct pendulum_state *const at = &trial->at[stage];
        trial->growth[stage] = stage > 0 && run->is_held
            ? pendulum_compute_constrained(
                m, at->t, &at->q, &at->v, &run->inputs, &feedback, &trial->solved[stage])
            : pendulum_compute_stabilized(
                m, at->t, &at->q, &at->v, &run->inputs, &run->gains, &trial->solved[stage],
                stage > 0 ? &unread : &feedback);
        growth = growth + trial->growth[stage];
        pendulum_lead(trial, stage, run->step, t_next);
    }
    return growth;
}

/* Whether the constraints can be met near q: Newton's iteration comes to rest at rounding,
   which beyond a dead end it cannot. */
static int pendulum_reach(struct pendulum_run *run, real t, const struct pendulum_coordinates *start)
{
    const struct pendulum *const m = run->mechanism;
    const struct pendulum_coordinates still = {0};
    const struct pendulum_constraints no_feedback = {0};
    const real h = run->step;
    struct pendulum_coordinates q = *start, moved, unmoved;
    struct pendulum_constraints phi = {0}, best = {0}, unread;
    pendulum_compute_phi(m, t, &q, &best);
    for (int iteration = 0; iteration < 30; iteration++) {
        struct pendulum_constraints feedback = {0};
        pendulum_compute_phi(m, t, &q, &phi);
        if (pendulum_norm(&phi) < pendulum_norm(&best)) {
            best = phi;
        }
        pendulum_add(pendulum_places(&feedback), -1 / (h * h), pendulum_elements(&phi), PENDULUM_CONSTRAINTS);
        const real growth =
            pendulum_compute_reactions(m, t, &q, &still, &run->inputs, &feedback, &moved, &unread);
        pendulum_compute_reactions(m, t, &q, &still, &run->inputs, &no_feedback, &unmoved, &unread);
        pendulum_add(pendulum_places(&moved), -1, pendulum_elements(&unmoved), PENDULUM_COORDINATES);
        const real length = h * h * pendulum_largest(pendulum_elements(&moved), PENDULUM_COORDINATES);
        const real roundings = (64 + growth) * pendulum_epsilon;
        /* without a first correction it is a drive that ends, and not a position */
        if (length <= roundings * pendulum_extent(&q) || (iteration == 0 && !isfinite(length))) {
            return PENDULUM_OK;
        }
        if (!isfinite(length)) {
            break;
        }
        pendulum_add(pendulum_places(&q), h * h, pendulum_elements(&moved), PENDULUM_COORDINATES);
    }
    run->where = pendulum_place(pendulum_elements(&best), PENDULUM_CONSTRAINTS);
    return PENDULUM_OUT_OF_REACH;
}

/* What the stages of a step that failed say of themselves. */
static int pendulum_cause_in_stages(struct pendulum_run *run, const struct pendulum_trial *trial)
{
    /* if only the sum of the growths is over the limit, the largest is over its share */
    const real limit = pendulum_growth_limit / PENDULUM_STAGES;
    for (int stage = 0; stage < PENDULUM_STAGES; stage++) {
        struct pendulum_state at;
        struct pendulum_coordinates solved;
        pendulum_complete(run->mechanism, &trial->at[stage], &at);
        pendulum_spread(&trial->solved[stage], &solved);
        const int code = pendulum_check_state(run, &at);
        if (code != PENDULUM_OK) {
            return code;
        }
        if (!(trial->growth[stage] < limit) || !pendulum_is_finite(&solved)) {
            return pendulum_cause_of(run, at.t, &at.q, &solved, trial->growth[stage], limit);
        }
    }
    return PENDULUM_NOT_FINITE;
}

/* Why a step failed: a position that cannot be reached from one that was good, or what its
   stages say. */
static int pendulum_diagnose(struct pendulum_run *run, const struct pendulum_trial *trial)
{
    const int code = pendulum_cause_in_stages(run, trial), where = run->where;
    if (code != PENDULUM_BAD_INPUT && trial->growth[0] < pendulum_growth_limit
        && pendulum_reach(run, run->state.t, &run->state.q) == PENDULUM_OK
        && pendulum_reach(run, trial->at[PENDULUM_STAGES].t, &run->state.q) != PENDULUM_OK) {
        return PENDULUM_OUT_OF_REACH;
    }
    run->where = where;
    return code;
}

/* A step is taken: its growth is compared with that of the next. */
static void pendulum_note(struct pendulum_run *run, real growth)
{
    const real rise = (real)1.25 * growth;
    run->worst_growth = growth > run->worst_growth ? growth : run->worst_growth;
    run->alarm = rise < run->remembered_from ? rise : run->remembered_from;
    run->steps++;
}

/* Takes a step that is calm: its growth has not risen, and redundant constraints are met. */
static inline int pendulum_take(struct pendulum_run *run, const struct pendulum_state *next, real growth)
{
    struct pendulum_state all;
    if (!(growth <= run->alarm)) {
        return 0;
    }
    pendulum_complete(run->mechanism, next, &all);
    if (!pendulum_meets_redundant(run, &all, (real)1e-3, run->size)) {
        return 0;
    }
    run->state = all;
    pendulum_note(run, growth);
    return 1;
}

/* A step whose growth has risen: whether its constraints can still be met. A growth that has
   doubled since one was examined is examined again. */
static int pendulum_examine(struct pendulum_run *run, const struct pendulum_state *next, real growth)
{
    const int is_first = run->worst_growth <= 0;
    const real before = (real)1.125 * run->alarm;
    if (pendulum_reach(run, next->t, &next->q) != PENDULUM_OK
        || !pendulum_meets_redundant(run, next, (real)1e-3, run->size)) {
        return PENDULUM_OUT_OF_REACH;
    }
    if (growth > run->remembered_from) {
        run->remembered_from = 2 * growth < pendulum_growth_limit ? 2 * growth : pendulum_growth_limit;
    }
    run->state = *next;
    pendulum_note(run, growth);
    run->alarm = is_first || run->alarm < before ? run->alarm : before;
    return PENDULUM_OK;
}

/* The step of mechanisms that have no other, and of those whose step was not calm: it finds
   out what went wrong, if anything did. */
static int pendulum_step_again(struct pendulum_run *run, real t_next)
{
    struct pendulum_trial trial;
    const real growth = pendulum_try(run, t_next, &trial);
    const struct pendulum_state *const next = &trial.at[PENDULUM_STAGES];
    struct pendulum_state all;
    if (!(growth < pendulum_growth_limit) || pendulum_first_non_finite(pendulum_elements(&next->q), PENDULUM_COORDINATES) >= 0
        || pendulum_first_non_finite(pendulum_elements(&next->v), PENDULUM_COORDINATES) >= 0) {
        return pendulum_diagnose(run, &trial);
    }
    if (pendulum_take(run, next, growth)) {
        return PENDULUM_OK;
    }
    pendulum_complete(run->mechanism, next, &all);
    return pendulum_examine(run, &all, growth);
}
/** A step with the feedback held over it, all stages in one.
    Cost: 43 mul + 30 add + 2 div + 0 sincos. */
static int pendulum_step_held(struct pendulum_run *run, real t_next)
{
    const struct pendulum *const m = run->mechanism;
    const real t = run->state.t;
    const struct pendulum_coordinates *const q = &run->state.q, *const v = &run->state.v;
    const struct pendulum_inputs *const inputs = &run->inputs;
    const struct pendulum_gains *const gains = &run->gains;
    const real h = run->step, half_h = (real)0.5 * h;
    struct pendulum_state next;
    real sum = 0, growth;
    next.t = t_next;
    /* not every program reads all of them */
    (void)m; (void)t; (void)inputs; (void)gains; (void)half_h;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = q->x * q->x;
    const real v8 = q->y * q->y;
    const real v9 = v8 - m->hoisted[0];
    const real phi_rod_10 = v7 + v9;
    const real v11 = gains->minus_beta_squared * phi_rod_10;
    const real v12 = v->x * phi_q_rod_x_0;
    const real v13 = v->y * phi_q_rod_y_3;
    const real phi_dot_rod_14 = v13 + v12;
    const real v15 = gains->minus_two_alpha * phi_dot_rod_14;
    const real feedback_rod_16 = v15 + v11;
    const real v17 = inputs->wind * v1;
    const real v18 = v->x * v->x;
    const real v19 = 2.0 * v18;
    const real v20 = v->y * v->y;
    const real v21 = 2.0 * v20;
    const real v22 = 9.81 * phi_q_rod_y_3;
    const real v23 = v22 - v21;
    const real v24 = v23 - v19;
    const real v25 = v24 - v17;
    const real v26 = v25 + feedback_rod_16;
    const real v27 = v26 / v6;
    const real v28 = v1 * v27;
    const real v29 = 0.5 * inputs->wind;
    const real acc_x_30 = v29 + v28;
    const real v31 = v4 * v27;
    const real acc_y_32 = v31 - 9.81;
    const real v33 = h * v->x;
    const real v34 = q->x + v33;
    const real v35 = h * acc_x_30;
    const real v36 = v->x + v35;
    const real v37 = h * v->y;
    const real v38 = q->y + v37;
    const real v39 = h * acc_y_32;
    const real v40 = v->y + v39;
    const real phi_q_rod_x_41 = 2.0 * v34;
    const real v42 = 0.5 * phi_q_rod_x_41;
    const real v43 = phi_q_rod_x_41 * v42;
    const real phi_q_rod_y_44 = v38 * 2.0;
    const real v45 = 0.5 * phi_q_rod_y_44;
    const real v46 = phi_q_rod_y_44 * v45;
    const real v47 = v46 + v43;
    const real v48 = inputs->wind * v42;
    const real v49 = v36 * v36;
    const real v50 = 2.0 * v49;
    const real v51 = v40 * v40;
    const real v52 = 2.0 * v51;
    const real v53 = 9.81 * phi_q_rod_y_44;
    const real v54 = feedback_rod_16 + v53;
    const real v55 = v52 + v50;
    const real v56 = v54 - v55;
    const real v57 = v56 - v48;
    const real v58 = v57 / v47;
    const real v59 = v42 * v58;
    const real acc_x_60 = v29 + v59;
    const real v61 = v45 * v58;
    const real acc_y_62 = v61 - 9.81;
    const real v63 = v->x + v36;
    const real v64 = half_h * v63;
    const real v65 = q->x + v64;
    const real v66 = v->y + v40;
    const real v67 = half_h * v66;
    const real v68 = q->y + v67;
    const real v69 = acc_x_30 + acc_x_60;
    const real v70 = half_h * v69;
    const real v71 = v->x + v70;
    const real v72 = acc_y_32 + acc_y_62;
    const real v73 = half_h * v72;
    const real v74 = v->y + v73;
    next.q.x = v65;
    sum += v65;
    next.q.y = v68;
    sum += v68;
    next.v.x = v71;
    sum += v71;
    next.v.y = v74;
    sum += v74;
    growth = 0.0;
    /* the sum is finite only if every component is */
    const int is_taken = isfinite(sum) && pendulum_take(run, &next, growth);
    return is_taken ? PENDULUM_OK : pendulum_step_again(run, t_next);
}

/** A step with the feedback in every stage, all stages in one.
    Cost: 49 mul + 34 add + 2 div + 0 sincos. */
static int pendulum_step_per_stage(struct pendulum_run *run, real t_next)
{
    const struct pendulum *const m = run->mechanism;
    const real t = run->state.t;
    const struct pendulum_coordinates *const q = &run->state.q, *const v = &run->state.v;
    const struct pendulum_inputs *const inputs = &run->inputs;
    const struct pendulum_gains *const gains = &run->gains;
    const real h = run->step, half_h = (real)0.5 * h;
    struct pendulum_state next;
    real sum = 0, growth;
    next.t = t_next;
    /* not every program reads all of them */
    (void)m; (void)t; (void)inputs; (void)gains; (void)half_h;
    const real phi_q_rod_x_0 = 2.0 * q->x;
    const real v1 = 0.5 * phi_q_rod_x_0;
    const real v2 = phi_q_rod_x_0 * v1;
    const real phi_q_rod_y_3 = q->y * 2.0;
    const real v4 = 0.5 * phi_q_rod_y_3;
    const real v5 = phi_q_rod_y_3 * v4;
    const real v6 = v5 + v2;
    const real v7 = q->x * q->x;
    const real v8 = q->y * q->y;
    const real v9 = v8 - m->hoisted[0];
    const real phi_rod_10 = v7 + v9;
    const real v11 = gains->minus_beta_squared * phi_rod_10;
    const real v12 = v->x * phi_q_rod_x_0;
    const real v13 = v->y * phi_q_rod_y_3;
    const real phi_dot_rod_14 = v13 + v12;
    const real v15 = gains->minus_two_alpha * phi_dot_rod_14;
    const real feedback_rod_16 = v15 + v11;
    const real v17 = inputs->wind * v1;
    const real v18 = v->x * v->x;
    const real v19 = 2.0 * v18;
    const real v20 = v->y * v->y;
    const real v21 = 2.0 * v20;
    const real v22 = 9.81 * phi_q_rod_y_3;
    const real v23 = v22 - v21;
    const real v24 = v23 - v19;
    const real v25 = v24 - v17;
    const real v26 = v25 + feedback_rod_16;
    const real v27 = v26 / v6;
    const real v28 = v1 * v27;
    const real v29 = 0.5 * inputs->wind;
    const real acc_x_30 = v29 + v28;
    const real v31 = v4 * v27;
    const real acc_y_32 = v31 - 9.81;
    const real v33 = h * v->x;
    const real v34 = q->x + v33;
    const real v35 = h * acc_x_30;
    const real v36 = v->x + v35;
    const real v37 = h * v->y;
    const real v38 = q->y + v37;
    const real v39 = h * acc_y_32;
    const real v40 = v->y + v39;
    const real phi_q_rod_x_41 = 2.0 * v34;
    const real v42 = 0.5 * phi_q_rod_x_41;
    const real v43 = phi_q_rod_x_41 * v42;
    const real phi_q_rod_y_44 = v38 * 2.0;
    const real v45 = 0.5 * phi_q_rod_y_44;
    const real v46 = phi_q_rod_y_44 * v45;
    const real v47 = v46 + v43;
    const real v48 = v34 * v34;
    const real v49 = v38 * v38;
    const real v50 = v49 - m->hoisted[0];
    const real phi_rod_51 = v48 + v50;
    const real v52 = gains->minus_beta_squared * phi_rod_51;
    const real v53 = v36 * phi_q_rod_x_41;
    const real v54 = v40 * phi_q_rod_y_44;
    const real phi_dot_rod_55 = v54 + v53;
    const real v56 = gains->minus_two_alpha * phi_dot_rod_55;
    const real feedback_rod_57 = v56 + v52;
    const real v58 = inputs->wind * v42;
    const real v59 = v36 * v36;
    const real v60 = 2.0 * v59;
    const real v61 = v40 * v40;
    const real v62 = 2.0 * v61;
    const real v63 = 9.81 * phi_q_rod_y_44;
    const real v64 = v63 - v62;
    const real v65 = v64 - v60;
    const real v66 = v65 - v58;
    const real v67 = v66 + feedback_rod_57;
    const real v68 = v67 / v47;
    const real v69 = v42 * v68;
    const real acc_x_70 = v29 + v69;
    const real v71 = v45 * v68;
    const real acc_y_72 = v71 - 9.81;
    const real v73 = v->x + v36;
    const real v74 = half_h * v73;
    const real v75 = q->x + v74;
    const real v76 = v->y + v40;
    const real v77 = half_h * v76;
    const real v78 = q->y + v77;
    const real v79 = acc_x_30 + acc_x_70;
    const real v80 = half_h * v79;
    const real v81 = v->x + v80;
    const real v82 = acc_y_32 + acc_y_72;
    const real v83 = half_h * v82;
    const real v84 = v->y + v83;
    next.q.x = v75;
    sum += v75;
    next.q.y = v78;
    sum += v78;
    next.v.x = v81;
    sum += v81;
    next.v.y = v84;
    sum += v84;
    growth = 0.0;
    /* the sum is finite only if every component is */
    const int is_taken = isfinite(sum) && pendulum_take(run, &next, growth);
    return is_taken ? PENDULUM_OK : pendulum_step_again(run, t_next);
}

int pendulum_step(struct pendulum_run *run)
{
    const real t_next = run->start_time + (real)(run->steps + 1) * run->step;
    return run->is_held ? pendulum_step_held(run, t_next) : pendulum_step_per_stage(run, t_next);
}

/* What a run gives. */

int pendulum_reactions(struct pendulum_run *run, struct pendulum_reactions *reactions)
{
    const struct pendulum_state *const at = &run->state;
    const struct pendulum_constraints no_feedback = {0};
    struct pendulum_coordinates *const acceleration = &reactions->acceleration;
    reactions->growth = pendulum_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, acceleration,
        &reactions->multipliers);
    const int row = pendulum_first_non_finite(pendulum_elements(&reactions->multipliers), PENDULUM_CONSTRAINTS);
    const int is_good = reactions->growth < pendulum_growth_limit
        && pendulum_is_finite(acceleration);
    if (is_good && row < 0) {
        return PENDULUM_OK;
    }
    if (pendulum_check_state(run, at) == PENDULUM_BAD_INPUT) {
        return PENDULUM_BAD_INPUT;
    }
    if (is_good) {
        run->where = row;
        return PENDULUM_UNDEFINED_MULTIPLIER;
    }
    return pendulum_cause_of(run, at->t, &at->q, acceleration, reactions->growth, pendulum_growth_limit);
}

int pendulum_step_with_reactions(struct pendulum_run *run, struct pendulum_reactions *reactions)
{
    const int code = pendulum_reactions(run, reactions);
    return code == PENDULUM_OK ? pendulum_step(run) : code;
}

int pendulum_outputs(struct pendulum_run *run, struct pendulum_outputs *outputs)
{
    const struct pendulum_state *const at = &run->state;
    struct pendulum_reactions reactions = {0};
    const int code = pendulum_reactions(run, &reactions);
    if (code != PENDULUM_OK) {
        return code;
    }
    pendulum_compute_outputs(run->mechanism, at->t, &at->q, &at->v, &run->inputs, &reactions, outputs);
    run->where = pendulum_first_non_finite(pendulum_elements(outputs), PENDULUM_OUTPUTS);
    return run->where < 0 ? PENDULUM_OK : PENDULUM_UNDEFINED_OUTPUT;
}

pendulum_real pendulum_energy(const struct pendulum_run *run)
{
    const struct pendulum_state *const at = &run->state;
    return pendulum_compute_kinetic_energy(run->mechanism, at->t, &at->q, &at->v)
        + pendulum_compute_potential_energy(run->mechanism, at->t, &at->q, &at->v);
}

pendulum_real pendulum_violation(const struct pendulum_run *run)
{
    struct pendulum_constraints phi = {0};
    pendulum_compute_phi(run->mechanism, run->state.t, &run->state.q, &phi);
    return pendulum_norm(&phi);
}

pendulum_real pendulum_velocity_violation(const struct pendulum_run *run)
{
    struct pendulum_constraints phi_dot = {0};
    pendulum_compute_phi_dot(run->mechanism, run->state.t, &run->state.q, &run->state.v, &phi_dot);
    return pendulum_norm(&phi_dot);
}

const char *pendulum_where(const struct pendulum_run *run, int code)
{
    if (run->where < 0) {
        return "";
    }
    switch (code) {
    case PENDULUM_SINGULAR: return pendulum_pivot_names[run->where];
    case PENDULUM_SINGULAR_START: return pendulum_start_pivot_names[run->where];
    case PENDULUM_NOT_FINITE: return pendulum_coordinate_names[run->where];
    case PENDULUM_NOT_ASSEMBLED:
    case PENDULUM_INCONSISTENT:
    case PENDULUM_OUT_OF_REACH:
    case PENDULUM_UNDEFINED_MULTIPLIER: return pendulum_constraint_names[run->where];
    case PENDULUM_UNDEFINED_OUTPUT: return pendulum_output_names[run->where];
    case PENDULUM_BAD_INPUT: return pendulum_input_names[run->where];
    default: return "";
    }
}
