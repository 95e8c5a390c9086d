/* The start. */

/* Refuses a correction of the start in a singular position. */
static int NAME_check_correction(
    struct NAME_run *run, const struct NAME_coordinates *correction, real growth)
{
    const struct NAME_state *const at = &run->state;
    real growths[CAPS_START_PIVOTS + 1] = {0};
    if (NAME_is_finite(correction) && growth < NAME_growth_limit) {
        return CAPS_OK;
    }
    NAME_compute_start_pivots(run->mechanism, at->t, &at->q, growths);
    const int code =
        NAME_cause(run, &at->q, correction, growth, NAME_growth_limit, growths, CAPS_START_PIVOTS);
    return code == CAPS_SINGULAR ? CAPS_SINGULAR_START : code;
}

/* q becomes q + delta, or what the longest halved step that does not enlarge the violation
   leads to; phi becomes the violation there. */
static void NAME_damped(
    struct NAME_run *run, const struct NAME_coordinates *delta, struct NAME_constraints *phi)
{
    const struct NAME_coordinates q = run->state.q;
    const real violation = NAME_norm(phi);
    real length = 1;
    for (int halvings = 0; halvings <= 10; halvings++) {
        run->state.q = q;
        NAME_add(NAME_places(&run->state.q), length, NAME_elements(delta), CAPS_COORDINATES);
        NAME_compute_phi(run->mechanism, run->state.t, &run->state.q, phi);
        if (NAME_norm(phi) < violation) {
            return;
        }
        length = length / 2;
    }
}

/* Positions on phi = 0 by Newton's iteration. */
static int NAME_assemble(struct NAME_run *run)
{
    struct NAME_coordinates *const q = &run->state.q;
    struct NAME_constraints phi = {0};
    int is_at_rest = 0;
    NAME_compute_phi(run->mechanism, run->state.t, q, &phi);
    for (int iteration = 0; iteration < 50 && !is_at_rest; iteration++) {
        struct NAME_constraints residual = {0};
        struct NAME_coordinates delta;
        NAME_add(NAME_places(&residual), -1, NAME_elements(&phi), CAPS_CONSTRAINTS);
        const real growth =
            NAME_compute_position_correction(run->mechanism, run->state.t, q, &residual, &delta);
        const int code = NAME_check_correction(run, &delta, growth);
        if (code != CAPS_OK) {
            return code;
        }
        const real length = NAME_largest(NAME_elements(&delta), CAPS_COORDINATES);
        is_at_rest = length <= 4 * NAME_epsilon * NAME_extent(q);
        if (is_at_rest) {
            NAME_add(NAME_places(q), 1, NAME_elements(&delta), CAPS_COORDINATES);
        } else {
            NAME_damped(run, &delta, &phi);
        }
    }
    run->where = NAME_place(NAME_elements(&phi), CAPS_CONSTRAINTS);
    const real most = NAME_largest(NAME_elements(&phi), CAPS_CONSTRAINTS);
    /* it may circle at rounding level, where the violation itself is at rounding */
    if (is_at_rest || most <= 64 * NAME_epsilon * NAME_extent(q)) {
        is_at_rest = NAME_meets_redundant(run, &run->state, SQRT(NAME_epsilon) * NAME_extent(q), 1);
    }
    return is_at_rest ? CAPS_OK : CAPS_NOT_ASSEMBLED;
}

/* Velocities whose constraints hold: one solution and one refinement of it. */
static int NAME_project_velocities(struct NAME_run *run)
{
    struct NAME_state *const at = &run->state;
    for (int pass = 0; pass < 2; pass++) {
        struct NAME_constraints phi_dot = {0}, residual = {0};
        struct NAME_coordinates delta;
        NAME_compute_phi_dot(run->mechanism, at->t, &at->q, &at->v, &phi_dot);
        NAME_add(NAME_places(&residual), -1, NAME_elements(&phi_dot), CAPS_CONSTRAINTS);
        const real growth =
            NAME_compute_velocity_correction(run->mechanism, at->t, &at->q, &residual, &delta);
        const int code = NAME_check_correction(run, &delta, growth);
        if (code != CAPS_OK) {
            return code;
        }
        NAME_add(NAME_places(&at->v), 1, NAME_elements(&delta), CAPS_COORDINATES);
    }
    return CAPS_OK;
}

/* The size of the mechanism: the largest coordinate that is a length, or lever arm. */
static real NAME_size(const struct NAME *m, const struct NAME_state *at)
{
    real size = 0, entries[CAPS_JACOBIAN + 1] = {0};
    for (int j = 0; j < CAPS_LINES; j++) {
        const real length = NAME_coordinate_length[j] != 0 ? FABS(NAME_elements(&at->q)[j]) : 0;
        size = length > size ? length : size;
    }
    NAME_compute_phi_q(m, at->t, &at->q, entries);
    for (int k = 0; k < CAPS_JACOBIAN; k++) {
        const int *const place = NAME_phi_q_places[k];
        const int is_arm = NAME_constraint_length[place[0]] == 1 && NAME_coordinate_length[place[1]] == 0;
        size = is_arm && FABS(entries[k]) > size ? FABS(entries[k]) : size;
    }
    return size;
}

int NAME_set_feedback(struct NAME_run *run, double alpha, double beta, int is_held)
{
    const double h = (double)run->step;
    const double a = 2.0 * alpha * h;
    const double b = beta * h * (beta * h);
    /* what a step makes of (e, h e') = (1, 0) and (0, 1) where e'' + 2 alpha e' + beta^2 e = 0 */
    double e[2][CAPS_STAGES + 1] = {{1.0}, {0.0}}, v[2][CAPS_STAGES + 1] = {{0.0}, {1.0}};
    for (int start = 0; start < 2; start++) {
        for (int last = 0; last < CAPS_STAGES; last++) {
            double e_sum = 0.0, v_sum = 0.0;
            for (int stage = 0; stage <= last; stage++) {
                const int from = is_held ? 0 : stage;
                const double weight = NAME_share[last] * NAME_weight[last][stage];
                e_sum += weight * v[start][stage];
                v_sum -= weight * (a * v[start][from] + b * e[start][from]);
            }
            e[start][last + 1] = e[start][0] + e_sum;
            v[start][last + 1] = v[start][0] + v_sum;
        }
    }
    const int end = CAPS_STAGES;
    const double trace = e[0][end] + v[1][end];
    const double determinant = e[0][end] * v[1][end] - e[1][end] * v[0][end];
    /* both eigenvalues of the map from step to step lie in the unit disc, up to rounding */
    const double slack = 16.0 * 2.220446049250313e-16 * (1.0 + a + b) * (1.0 + a + b);
    const int is_stable = fabs(trace) <= 1.0 + determinant + slack && determinant <= 1.0 + slack;
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
    struct NAME_STAGE at;
    NAME_select(&run->state, &at);
    NAME_complete(run->mechanism, &at, &run->state);
    run->start_time = run->state.t;
    run->steps = 0;
    run->worst_growth = 0;
    run->alarm = run->remembered_from = 64;
    run->size = NAME_size(run->mechanism, &run->state);
}

/* Refuses a given state that violates a constraint by more than a thousandth of its size, or the
   rate of one by more than a thousandth of the motion, beside roundings of the size. */
static int NAME_check_consistent(struct NAME_run *run, const struct NAME_state *at)
{
    const struct NAME *const m = run->mechanism;
    const real *const v = NAME_elements(&at->v);
    const real share = (real)1e-3, length = NAME_size(m, at), roundings = 1024 * NAME_epsilon / run->step;
    real entries[CAPS_JACOBIAN + 1] = {0}, sizes[CAPS_CONSTRAINTS + 1] = {0}, fastest = 0;
    struct NAME_constraints phi = {0}, phi_dot = {0}, rates = {0};
    NAME_compute_phi(m, at->t, &at->q, &phi);
    NAME_compute_phi_dot(m, at->t, &at->q, &at->v, &phi_dot);
    NAME_compute_phi_t(m, at->t, &at->q, &rates);
    NAME_compute_phi_q(m, at->t, &at->q, entries);
    for (int row = 0; row < CAPS_CONSTRAINTS; row++) {
        NAME_places(&rates)[row] = FABS(NAME_elements(&rates)[row]);
    }
    for (int j = 0; j < CAPS_LINES; j++) {
        const real scale = NAME_coordinate_length[j] == 0 ? 1 : length;
        fastest = FABS(v[j]) > fastest * scale && scale > 0 ? FABS(v[j]) / scale : fastest;
    }
    for (int k = 0; k < CAPS_JACOBIAN; k++) {
        const int row = NAME_phi_q_places[k][0], j = NAME_phi_q_places[k][1];
        sizes[row] += FABS(entries[k]) * (NAME_coordinate_length[j] == 0 ? 1 : length);
        NAME_places(&rates)[row] += FABS(entries[k] * v[j]);
    }
    for (int row = 0; row < CAPS_CONSTRAINTS; row++) {
        const real size = sizes[row], motion = NAME_elements(&rates)[row];
        const real rate = motion > size * fastest ? motion : size * fastest;
        run->where = row;
        if (!(FABS(NAME_elements(&phi)[row]) <= share * size)
            || !(FABS(NAME_elements(&phi_dot)[row]) <= share * rate + roundings * size)) {
            return CAPS_INCONSISTENT;
        }
    }
    return CAPS_OK;
}

int NAME_start_from(struct NAME_run *run, const struct NAME_state *state)
{
    int code = NAME_check_state(run, state);
    code = code == CAPS_OK ? NAME_check_consistent(run, state) : code;
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
    NAME_default_inputs(&run->inputs);
    run->state.t = NAME_compute_declared_start(m, &run->state.q, &run->state.v);
    if (!(run->step > 0 && isfinite(run->step) && 4 * NAME_epsilon * FABS(run->state.t) <= run->step)) {
        return CAPS_BAD_STEP;
    }
    int code = NAME_set_feedback(run, NAME_deadbeat[0] / step, NAME_deadbeat[1] / step, 1);
    code = code == CAPS_OK ? NAME_assemble(run) : code;
    code = code == CAPS_OK ? NAME_project_velocities(run) : code;
    code = code == CAPS_OK ? NAME_check_state(run, &run->state) : code;
    NAME_begin(run);
    return code;
}

