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
    const real h = run->step;
    struct NAME_coordinates q = *start, moved, unmoved;
    struct NAME_constraints phi = {0}, best = {0};
    NAME_compute_phi(m, t, &q, &best);
    for (int iteration = 0; iteration < 30; iteration++) {
        struct NAME_constraints feedback = {0};
        NAME_compute_phi(m, t, &q, &phi);
        if (NAME_norm(&phi) < NAME_norm(&best)) {
            best = phi;
        }
        NAME_add(NAME_places(&feedback), -1 / (h * h), NAME_elements(&phi), CAPS_CONSTRAINTS);
        const real growth = NAME_compute_constrained(m, t, &q, &still, &run->inputs, &feedback, &moved);
        NAME_compute_constrained(m, t, &q, &still, &run->inputs, &no_feedback, &unmoved);
        NAME_add(NAME_places(&moved), -1, NAME_elements(&unmoved), CAPS_COORDINATES);
        const real length = h * h * NAME_largest(NAME_elements(&moved), CAPS_COORDINATES);
        const real roundings = (64 + growth) * NAME_epsilon;
        /* without a first correction it is a drive that ends, and not a position */
        if (length <= roundings * NAME_extent(&q) || (iteration == 0 && !isfinite(length))) {
            return CAPS_OK;
        }
        if (!isfinite(length)) {
            break;
        }
        NAME_add(NAME_places(&q), h * h, NAME_elements(&moved), CAPS_COORDINATES);
    }
    run->where = NAME_place(NAME_elements(&best), CAPS_CONSTRAINTS);
    return CAPS_OUT_OF_REACH;
}

/* What the stages of a step that failed say of themselves. */
static int NAME_cause_in_stages(struct NAME_run *run, const struct NAME_trial *trial)
{
    const struct NAME_state *const stages[2] = {&run->state, &trial->predicted};
    const struct NAME_coordinates *const solved[2] = {&trial->here, &trial->there};
    const real growths[2] = {trial->growth_here, trial->growth_there};
    /* if only the sum of two growths is over the limit, the larger is over half */
    const real limit = NAME_growth_limit / 2;
    for (int stage = 0; stage < 2; stage++) {
        const struct NAME_state *const at = stages[stage];
        const int code = NAME_check_state(run, at);
        if (code != CAPS_OK) {
            return code;
        }
        if (!(growths[stage] < limit)
            || !NAME_is_finite(solved[stage])) {
            return NAME_cause_of(run, at->t, &at->q, solved[stage], growths[stage], limit);
        }
    }
    return CAPS_NOT_FINITE;
}

/* Why a step failed: a position that cannot be reached from one that was good, or what its
   stages say. */
static int NAME_diagnose(struct NAME_run *run, const struct NAME_trial *trial)
{
    const int code = NAME_cause_in_stages(run, trial), where = run->where;
    if (code != CAPS_BAD_INPUT && trial->growth_here < NAME_growth_limit
        && NAME_reach(run, run->state.t, &run->state.q) == CAPS_OK
        && NAME_reach(run, trial->next.t, &run->state.q) != CAPS_OK) {
        return CAPS_OUT_OF_REACH;
    }
    run->where = where;
    return code;
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
    if (!(growth <= run->alarm) || !NAME_meets_redundant(run, next, (real)1e-3, run->size)) {
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
    if (NAME_reach(run, next->t, &next->q) != CAPS_OK
        || !NAME_meets_redundant(run, next, (real)1e-3, run->size)) {
        return CAPS_OUT_OF_REACH;
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
    if (!(growth < NAME_growth_limit)
        || !NAME_is_finite(&trial.next.q)
        || !NAME_is_finite(&trial.next.v)) {
        return NAME_diagnose(run, &trial);
    }
    return NAME_take(run, &trial.next, growth) ? CAPS_OK : NAME_examine(run, &trial.next, growth);
}

