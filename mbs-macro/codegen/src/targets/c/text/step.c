/* A step. */

/* The stages of a step, the first one at its start, and behind them its end. */
struct NAME_trial {
    struct NAME_STAGE at[CAPS_STAGES + 1];
    struct NAME_STATES solved[CAPS_STAGES];
    real growth[CAPS_STAGES];
};

/* Leads to what stands behind some solved stages: x = x0 + (share h) (w_1 k_1 + w_2 k_2 + ...). */
static void NAME_lead(struct NAME_trial *trial, int last, real h, real t_next)
{
    const struct NAME_STAGE *const start = trial->at;
    struct NAME_STAGE *const to = &trial->at[last + 1];
    const real factor = (real)NAME_share[last] * h;
    to->t = NAME_node[last] < 1 ? start->t + (real)NAME_node[last] * h : t_next;
    for (int j = 0; j < STATE_COUNT; j++) {
        real v = 0, a = 0;
        for (int stage = 0; stage <= last; stage++) {
            const real weight = (real)NAME_weight[last][stage];
            v = v + weight * NAME_elements(&trial->at[stage].v)[j];
            a = a + weight * NAME_elements(&trial->solved[stage])[j];
        }
        NAME_places(&to->q)[j] = NAME_elements(&start->q)[j] + factor * v;
        NAME_places(&to->v)[j] = NAME_elements(&start->v)[j] + factor * a;
    }
}

/* A step stage by stage; the growths of all, added. */
static real NAME_try(const struct NAME_run *run, real t_next, struct NAME_trial *trial)
{
    const struct NAME *const m = run->mechanism;
    struct NAME_constraints feedback = {0}, unread = {0};
    real growth = 0;
    NAME_select(&run->state, &trial->at[0]);
    for (int stage = 0; stage < CAPS_STAGES; stage++) {
        const struct NAME_STAGE *const at = &trial->at[stage];
        trial->growth[stage] = stage > 0 && run->is_held
            ? NAME_compute_constrained(
                m, at->t, &at->q, &at->v, &run->inputs, &feedback, &trial->solved[stage])
            : NAME_compute_stabilized(
                m, at->t, &at->q, &at->v, &run->inputs, &run->gains, &trial->solved[stage],
                stage > 0 ? &unread : &feedback);
        growth = growth + trial->growth[stage];
        NAME_lead(trial, stage, run->step, t_next);
    }
    return growth;
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
    struct NAME_constraints phi = {0}, best = {0}, unread;
    NAME_compute_phi(m, t, &q, &best);
    for (int iteration = 0; iteration < 30; iteration++) {
        struct NAME_constraints feedback = {0};
        NAME_compute_phi(m, t, &q, &phi);
        if (NAME_norm(&phi) < NAME_norm(&best)) {
            best = phi;
        }
        NAME_add(NAME_places(&feedback), -1 / (h * h), NAME_elements(&phi), CAPS_CONSTRAINTS);
        const real growth =
            NAME_compute_reactions(m, t, &q, &still, &run->inputs, &feedback, &moved, &unread);
        NAME_compute_reactions(m, t, &q, &still, &run->inputs, &no_feedback, &unmoved, &unread);
        NAME_add(NAME_places(&moved), -1, NAME_elements(&unmoved), CAPS_COORDINATES);
        const real length = h * h * NAME_largest(NAME_elements(&moved), CAPS_LINES);
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
    /* if only the sum of the growths is over the limit, the largest is over its share */
    const real limit = NAME_growth_limit / CAPS_STAGES;
    for (int stage = 0; stage < CAPS_STAGES; stage++) {
        struct NAME_state at;
        struct NAME_coordinates solved;
        NAME_complete(run->mechanism, &trial->at[stage], &at);
        NAME_spread(&trial->solved[stage], &solved);
        const int code = NAME_check_state(run, &at);
        if (code != CAPS_OK) {
            return code;
        }
        if (!(trial->growth[stage] < limit) || !NAME_is_finite(&solved)) {
            return NAME_cause_of(run, at.t, &at.q, &solved, trial->growth[stage], limit);
        }
    }
    return CAPS_NOT_FINITE;
}

/* Why a step failed: a position that cannot be reached from one that was good, or what its
   stages say. */
static int NAME_diagnose(struct NAME_run *run, const struct NAME_trial *trial)
{
    const int code = NAME_cause_in_stages(run, trial), where = run->where;
    if (code != CAPS_BAD_INPUT && trial->growth[0] < NAME_growth_limit
        && NAME_reach(run, run->state.t, &run->state.q) == CAPS_OK
        && NAME_reach(run, trial->at[CAPS_STAGES].t, &run->state.q) != CAPS_OK) {
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
static inline int NAME_take(struct NAME_run *run, const struct NAME_STAGE *next, real growth)
{
    struct NAME_state all;
    if (!(growth <= run->alarm)) {
        return 0;
    }
    NAME_complete(run->mechanism, next, &all);
    if (!NAME_meets_redundant(run, &all, (real)1e-3, run->size)) {
        return 0;
    }
    run->state = all;
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
    const real growth = NAME_try(run, t_next, &trial);
    const struct NAME_STAGE *const next = &trial.at[CAPS_STAGES];
    struct NAME_state all;
    if (!(growth < NAME_growth_limit) || NAME_first_non_finite(NAME_elements(&next->q), STATE_COUNT) >= 0
        || NAME_first_non_finite(NAME_elements(&next->v), STATE_COUNT) >= 0) {
        return NAME_diagnose(run, &trial);
    }
    if (NAME_take(run, next, growth)) {
        return CAPS_OK;
    }
    NAME_complete(run->mechanism, next, &all);
    return NAME_examine(run, &all, growth);
}
