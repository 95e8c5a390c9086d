/* The start. */

/* Refuses a correction of the start in a singular position. */
static int NAME_check_correction(
    struct NAME_run *run, const struct NAME_coordinates *q, const struct NAME_coordinates *correction,
    real growth)
{
    int pivot;
    if (NAME_first_non_finite(NAME_elements(correction), CAPS_COORDINATES) < 0 && growth < NAME_growth_limit) {
        return CAPS_OK;
    }
    const real worst = NAME_worst_start_pivot(run->mechanism, run->state.t, q, &pivot);
    const struct NAME_cause cause = NAME_cause_of(q, correction, growth, NAME_growth_limit, pivot, worst);
    run->where = cause.where;
    return cause.code == CAPS_SINGULAR ? CAPS_SINGULAR_START : cause.code;
}

/* Redundant constraints take no part in the corrections: with parameters for which they do
   not fit they stay violated. */
static int NAME_check_redundant(struct NAME_run *run)
{
    struct NAME_constraints phi = {0};
    int place;
    NAME_compute_phi(run->mechanism, run->state.t, &run->state.q, &phi);
    const real size = 1 + NAME_largest(NAME_elements(&run->state.q), CAPS_COORDINATES, &place);
    for (int at = 0; at < CAPS_REDUNDANT; at++) {
        run->where = NAME_redundant[at];
        if (FABS(NAME_elements(&phi)[run->where]) > SQRT(NAME_epsilon) * size) {
            return CAPS_NOT_ASSEMBLED;
        }
    }
    return CAPS_OK;
}

/* q becomes q + delta, or what the longest halved step that does not enlarge the violation
   leads to; phi becomes the violation there. */
static void NAME_damped(
    struct NAME_run *run, const struct NAME_coordinates *delta, struct NAME_constraints *phi)
{
    const real violation = NAME_norm(NAME_elements(phi), CAPS_CONSTRAINTS);
    struct NAME_coordinates next;
    real length = 1;
    for (int halvings = 0; halvings <= 10; halvings++) {
        for (int at = 0; at < CAPS_COORDINATES; at++) {
            NAME_places(&next)[at] =
                NAME_elements(&run->state.q)[at] + length * NAME_elements(delta)[at];
        }
        NAME_compute_phi(run->mechanism, run->state.t, &next, phi);
        if (NAME_norm(NAME_elements(phi), CAPS_CONSTRAINTS) < violation) {
            break;
        }
        length = length / 2;
    }
    run->state.q = next;
}

/* Positions on phi = 0 by Newton's iteration. */
static int NAME_assemble(struct NAME_run *run)
{
    struct NAME_coordinates *const q = &run->state.q;
    struct NAME_constraints phi = {0}, residual = {0};
    struct NAME_coordinates delta;
    int place;
    NAME_compute_phi(run->mechanism, run->state.t, q, &phi);
    for (int iteration = 0; iteration < 50; iteration++) {
        for (int at = 0; at < CAPS_CONSTRAINTS; at++) {
            NAME_places(&residual)[at] = -NAME_elements(&phi)[at];
        }
        const real growth =
            NAME_compute_position_correction(run->mechanism, run->state.t, q, &residual, &delta);
        const int code = NAME_check_correction(run, q, &delta, growth);
        if (code != CAPS_OK) {
            return code;
        }
        const real size = 1 + NAME_largest(NAME_elements(q), CAPS_COORDINATES, &place);
        if (NAME_largest(NAME_elements(&delta), CAPS_COORDINATES, &place) <= 4 * NAME_epsilon * size) {
            for (int at = 0; at < CAPS_COORDINATES; at++) {
                NAME_places(q)[at] += NAME_elements(&delta)[at];
            }
            return NAME_check_redundant(run);
        }
        NAME_damped(run, &delta, &phi);
    }
    /* it may circle at rounding level, where the violation itself is at rounding */
    const real size = 1 + NAME_largest(NAME_elements(q), CAPS_COORDINATES, &place);
    if (NAME_largest(NAME_elements(&phi), CAPS_CONSTRAINTS, &run->where) <= 64 * NAME_epsilon * size) {
        return NAME_check_redundant(run);
    }
    return CAPS_NOT_ASSEMBLED;
}

/* Velocities whose constraints hold: one solution and one refinement of it. */
static int NAME_project_velocities(struct NAME_run *run)
{
    struct NAME_constraints residual = {0};
    struct NAME_coordinates delta;
    const struct NAME_state *const at = &run->state;
    for (int pass = 0; pass < 2; pass++) {
        NAME_compute_phi_dot(run->mechanism, at->t, &at->q, &at->v, &residual);
        for (int row = 0; row < CAPS_CONSTRAINTS; row++) {
            NAME_places(&residual)[row] = -NAME_elements(&residual)[row];
        }
        const real growth =
            NAME_compute_velocity_correction(run->mechanism, at->t, &at->q, &residual, &delta);
        const int code = NAME_check_correction(run, &at->q, &delta, growth);
        if (code != CAPS_OK) {
            return code;
        }
        for (int j = 0; j < CAPS_COORDINATES; j++) {
            NAME_places(&run->state.v)[j] += NAME_elements(&delta)[j];
        }
    }
    return CAPS_OK;
}

/* The size of the mechanism: the largest coordinate that is a length, or lever arm. */
static real NAME_size(const struct NAME *m, const struct NAME_state *at)
{
    struct NAME_coordinates direction = {0};
    struct NAME_constraints along = {0}, still = {0};
    real size = 0;
    NAME_compute_phi_dot(m, at->t, &at->q, &direction, &still);
    for (int j = 0; j < CAPS_COORDINATES; j++) {
        if (NAME_coordinate_length[j] != 0) {
            const real length = FABS(NAME_elements(&at->q)[j]);
            size = length > size ? length : size;
            continue;
        }
        NAME_places(&direction)[j] = 1;
        NAME_compute_phi_dot(m, at->t, &at->q, &direction, &along);
        NAME_places(&direction)[j] = 0;
        for (int row = 0; row < CAPS_CONSTRAINTS; row++) {
            if (NAME_constraint_length[row] == 1) {
                const real arm = FABS(NAME_elements(&along)[row] - NAME_elements(&still)[row]);
                size = arm > size ? arm : size;
            }
        }
    }
    return size;
}

int NAME_set_feedback(struct NAME_run *run, double alpha, double beta, int is_held)
{
    const double h = (double)run->step;
    const double a = 2.0 * alpha * h;
    const double b = beta * h * (beta * h);
    const double trace = is_held ? 2.0 - a - b / 2.0 : 2.0 - a + a * a / 2.0 - b;
    const double determinant =
        is_held ? 1.0 - a + b / 2.0 : 1.0 - a + a * a / 2.0 - a * b / 2.0 + b * b / 4.0;
    /* both eigenvalues of the map from step to step lie in the unit disc, up to rounding */
    const double slack = 8.0 * 2.220446049250313e-16 * (1.0 + a * a + b * b);
    const int is_stable = (trace < 0.0 ? -trace : trace) <= 1.0 + determinant + slack && determinant <= 1.0 + slack;
    if (!(alpha >= 0.0 && beta >= 0.0 && is_stable)) {
        return CAPS_BAD_GAINS;
    }
    run->gains.minus_two_alpha = (real)(-2.0 * alpha);
    run->gains.minus_beta_squared = (real)(-beta * beta);
    run->is_held = is_held;
    return CAPS_OK;
}

/* The watch over a run that begins. */
static void NAME_begin(struct NAME_run *run)
{
    run->start_time = run->state.t;
    run->steps = 0;
    run->worst_growth = 0;
    run->alarm = run->remembered_from = 64;
    run->size = CAPS_REDUNDANT > 0 ? NAME_size(run->mechanism, &run->state) : 0;
}

int NAME_start_from(struct NAME_run *run, const struct NAME_state *state)
{
    const int code = NAME_check_state(run, state);
    if (code == CAPS_OK) {
        run->state = *state;
        NAME_begin(run);
    }
    return code;
}

int NAME_start(struct NAME_run *run, const struct NAME *m, double step)
{
    const struct NAME_run nothing = {0};
    *run = nothing;
    run->mechanism = m;
    run->where = -1;
    run->step = (real)step;
    run->state.t = NAME_compute_declared_start(m, &run->state.q, &run->state.v);
    if (!(run->step > 0 && isfinite(run->step) && 4 * NAME_epsilon * FABS(run->state.t) <= run->step)) {
        return CAPS_BAD_STEP;
    }
    int code = NAME_set_feedback(run, 0.75 / step, 1.0 / step, 1);
    if (code == CAPS_OK) {
        code = NAME_assemble(run);
    }
    if (code == CAPS_OK) {
        code = NAME_project_velocities(run);
    }
    if (code == CAPS_OK) {
        code = NAME_check_state(run, &run->state);
    }
    NAME_begin(run);
    return code;
}

