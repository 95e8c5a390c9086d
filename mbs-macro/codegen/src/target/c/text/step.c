/* A step. */

/* Both stages of a step, and what they lead to. */
struct NAME_trial {
    struct NAME_state predicted, next;
    struct NAME_coordinates here, there;
    real growth_here, growth_there;
};

static void NAME_try(const struct NAME_run *run, real t_next, struct NAME_trial *trial)
{
    const struct NAME *const m = run->mechanism;
    const struct NAME_state *const at = &run->state;
    const real *const q = NAME_elements(&at->q), *const v = NAME_elements(&at->v);
    real *const q_next = NAME_places(&trial->next.q), *const v_next = NAME_places(&trial->next.v);
    const real h = run->step, half_h = (real)0.5 * h;
    struct NAME_constraints feedback = {0};
    trial->growth_here =
        NAME_compute_stabilized(m, at->t, &at->q, &at->v, &run->inputs, &run->gains, &trial->here, &feedback);
    const real *const a = NAME_elements(&trial->here), *const b = NAME_elements(&trial->there);
    for (int j = 0; j < CAPS_COORDINATES; j++) {
        q_next[j] = q[j] + h * v[j];
        v_next[j] = v[j] + h * a[j];
    }
    trial->next.t = t_next;
    trial->predicted = trial->next;
    const struct NAME_coordinates *const q_there = &trial->predicted.q, *const v_there = &trial->predicted.v;
    if (run->is_held) {
        trial->growth_there =
            NAME_compute_constrained(m, t_next, q_there, v_there, &run->inputs, &feedback, &trial->there);
    } else {
        trial->growth_there = NAME_compute_stabilized(
            m, t_next, q_there, v_there, &run->inputs, &run->gains, &trial->there, &feedback);
    }
    for (int j = 0; j < CAPS_COORDINATES; j++) {
        q_next[j] = q[j] + half_h * (v[j] + v_next[j]);
        v_next[j] = v[j] + half_h * (a[j] + b[j]);
    }
}

/* Whether the constraints can be met near q: Newton's iteration comes to rest at rounding,
   which beyond a dead end it cannot. */
static int NAME_reach(struct NAME_run *run, real t, const struct NAME_coordinates *start)
{
    const struct NAME *const m = run->mechanism;
    const struct NAME_coordinates still = {0};
    const struct NAME_constraints no_feedback = {0};
    struct NAME_coordinates q = *start, moved, unmoved;
    struct NAME_constraints phi = {0}, best = {0}, feedback = {0};
    const real h = run->step;
    int place;
    NAME_compute_phi(m, t, &q, &best);
    for (int iteration = 0; iteration < 30; iteration++) {
        NAME_compute_phi(m, t, &q, &phi);
        if (NAME_norm(NAME_elements(&phi), CAPS_CONSTRAINTS) < NAME_norm(NAME_elements(&best), CAPS_CONSTRAINTS)) {
            best = phi;
        }
        for (int row = 0; row < CAPS_CONSTRAINTS; row++) {
            NAME_places(&feedback)[row] = -(NAME_elements(&phi)[row] / (h * h));
        }
        const real growth = NAME_compute_constrained(m, t, &q, &still, &run->inputs, &feedback, &moved);
        NAME_compute_constrained(m, t, &q, &still, &run->inputs, &no_feedback, &unmoved);
        for (int j = 0; j < CAPS_COORDINATES; j++) {
            NAME_places(&moved)[j] = h * h * (NAME_elements(&moved)[j] - NAME_elements(&unmoved)[j]);
        }
        const real length = NAME_largest(NAME_elements(&moved), CAPS_COORDINATES, &place);
        const real size = 1 + NAME_largest(NAME_elements(&q), CAPS_COORDINATES, &place);
        /* without a first correction it is a drive that ends, and not a position */
        if (length <= (64 + growth) * NAME_epsilon * size || (iteration == 0 && !isfinite(length))) {
            return CAPS_OK;
        }
        if (!isfinite(length)) {
            break;
        }
        for (int j = 0; j < CAPS_COORDINATES; j++) {
            NAME_places(&q)[j] += NAME_elements(&moved)[j];
        }
    }
    (void)NAME_largest(NAME_elements(&best), CAPS_CONSTRAINTS, &run->where);
    return CAPS_OUT_OF_REACH;
}

/* Redundant constraints are watched: a thousandth of the size is allowed. */
static int NAME_watch_redundant(struct NAME_run *run, const struct NAME_state *at)
{
    struct NAME_constraints phi = {0};
    if (CAPS_REDUNDANT == 0) {
        return CAPS_OK;
    }
    NAME_compute_phi(run->mechanism, at->t, &at->q, &phi);
    for (int k = 0; k < CAPS_REDUNDANT; k++) {
        const int row = NAME_redundant[k];
        real allowed = (real)1e-3;
        for (int power = 0; power < NAME_constraint_length[row]; power++) {
            allowed = allowed * run->size;
        }
        if (!(FABS(NAME_elements(&phi)[row]) <= allowed)) {
            run->where = row;
            return CAPS_OUT_OF_REACH;
        }
    }
    return CAPS_OK;
}

/* Why a step failed: an input, a position that cannot be reached from one that was good,
   or what its stages say. */
static int NAME_diagnose(struct NAME_run *run, const struct NAME_trial *trial)
{
    const struct NAME_state *const stages[2] = {&run->state, &trial->predicted};
    const struct NAME_coordinates *const solved[2] = {&trial->here, &trial->there};
    const real growths[2] = {trial->growth_here, trial->growth_there};
    /* if only the sum of two growths is over the limit, the larger is over half */
    const real limit = NAME_growth_limit / 2;
    struct NAME_cause cause = {CAPS_NOT_FINITE, -1};
    for (int stage = 0; stage < 2; stage++) {
        const struct NAME_coordinates *const q = &stages[stage]->q;
        int pivot, code = NAME_check_state(run, stages[stage]);
        if (code == CAPS_BAD_INPUT) {
            return code;
        }
        if (code != CAPS_OK) {
            cause.where = run->where;
            break;
        }
        if (!(growths[stage] < limit)
            || NAME_first_non_finite(NAME_elements(solved[stage]), CAPS_COORDINATES) >= 0) {
            const real worst = NAME_worst_pivot(run->mechanism, stages[stage]->t, q, &pivot);
            cause = NAME_cause_of(q, solved[stage], growths[stage], limit, pivot, worst);
            break;
        }
    }
    if (trial->growth_here < NAME_growth_limit && NAME_reach(run, run->state.t, &run->state.q) == CAPS_OK
        && NAME_reach(run, trial->next.t, &run->state.q) != CAPS_OK) {
        return CAPS_OUT_OF_REACH;
    }
    run->where = cause.where;
    return cause.code;
}

/* A step is taken: its growth is compared with that of the next. */
static void NAME_note(struct NAME_run *run, real growth)
{
    const real rise = (real)1.25 * growth;
    run->worst_growth = growth > run->worst_growth ? growth : run->worst_growth;
    run->alarm = rise < run->remembered_from ? rise : run->remembered_from;
    run->steps++;
}

/* Takes a step that is calm: its growth has not risen, and redundant constraints are met. */
static inline int NAME_take(struct NAME_run *run, const struct NAME_state *next, real growth)
{
    if (!(growth <= run->alarm) || NAME_watch_redundant(run, next) != CAPS_OK) {
        return 0;
    }
    run->state = *next;
    NAME_note(run, growth);
    return 1;
}

/* A step whose growth has risen: whether its constraints can still be met. A growth that has
   doubled since one was examined is examined again. */
static int NAME_examine(struct NAME_run *run, const struct NAME_state *next, real growth)
{
    const int is_first = run->worst_growth <= 0;
    const real before = (real)1.125 * run->alarm;
    int code = NAME_reach(run, next->t, &next->q);
    if (code == CAPS_OK) {
        code = NAME_watch_redundant(run, next);
    }
    if (code != CAPS_OK) {
        return code;
    }
    if (growth > run->remembered_from) {
        run->remembered_from = 2 * growth < NAME_growth_limit ? 2 * growth : NAME_growth_limit;
    }
    run->state = *next;
    NAME_note(run, growth);
    run->alarm = is_first || run->alarm < before ? run->alarm : before;
    return CAPS_OK;
}

/* The step of mechanisms that have no other, and of those whose step was not calm: it finds
   out what went wrong, if anything did. */
static int NAME_step_again(struct NAME_run *run, real t_next)
{
    struct NAME_trial trial;
    NAME_try(run, t_next, &trial);
    const real growth = trial.growth_here + trial.growth_there;
    const int is_healthy = growth < NAME_growth_limit
        && NAME_first_non_finite(NAME_elements(&trial.next.q), CAPS_COORDINATES) < 0
        && NAME_first_non_finite(NAME_elements(&trial.next.v), CAPS_COORDINATES) < 0;
    if (!is_healthy) {
        return NAME_diagnose(run, &trial);
    }
    return NAME_take(run, &trial.next, growth) ? CAPS_OK : NAME_examine(run, &trial.next, growth);
}

