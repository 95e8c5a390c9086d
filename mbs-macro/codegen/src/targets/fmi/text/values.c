/* Values. */

#define ELEMENTS(vector) ((const double *)&(vector))
#define PLACES(vector) ((double *)&(vector))

CLOCKED/* Takes the memories over that a run has come to. */
static void take_memories(struct memory *now)
{
    for (int at = AT_MEMORIES - AT_INPUTS; at < CAPS_INPUTS; at++) {
        PLACES(now->inputs)[at] = ELEMENTS(now->run.inputs)[at];
    }
}

/* Makes mechanism and start anew where parameters have changed. A run that goes on keeps its state, since no
   constraint knows of the parameters that may change then. */
static int start(struct instance *it)
{
    struct memory *const now = &it->now;
    int code = now->is_tuned ? CAPS_OK : NAME_init(&now->mechanism, &now->parameters);
    now->is_tuned = code == CAPS_OK;
    if (code != CAPS_OK || now->is_started) {
        return code;
    }
    code = NAME_start(&now->run, &now->mechanism, STEP);
    if (code == CAPS_OK) {
        const struct feedback gains = it->is_co_simulation ? CO_SIMULATION : MODEL_EXCHANGE;
        code = NAME_set_feedback(&now->run, gains.alpha, gains.beta, gains.is_held);
    }
    if (code != CAPS_OK) {
        return code;
    }
    now->shift = now->run.state.t - now->time;
    for (int at = 0; at < STATE_COUNT; at++) {
        now->states[at] = ELEMENTS(now->run.state.q)[STATE_PLACES[at]];
        now->states[STATE_COUNT + at] = ELEMENTS(now->run.state.v)[STATE_PLACES[at]];
    }
    take_memories(now);
    now->is_started = 1;
    now->is_solved = 0;
    begin_clocks(now);
    return CAPS_OK;
}

/* Positions and velocities of what is integrated, as the importer set them. */
static const struct NAME_STATES *positions(const struct memory *now)
{
    return (const struct NAME_STATES *)(const void *)now->states;
}

static const struct NAME_STATES *velocities(const struct memory *now)
{
    return (const struct NAME_STATES *)(const void *)(now->states + STATE_COUNT);
}

/* All coordinates at time and states of the importer. */
static void place(struct memory *now)
{
    struct NAME_state *const at = &now->run.state;
    at->t = now->time + now->shift;
    NAME_compute_complete(&now->mechanism, at->t, positions(now), velocities(now), &at->q, &at->v);
    now->is_solved = 0;
}

/* The derivatives of the velocities that are integrated, with feedback. */
static int accelerate(struct memory *now, double *derivatives)
{
    struct NAME_STATES solved;
    struct NAME_constraints feedback;
    now->run.inputs = now->inputs;
    const double growth = NAME_compute_stabilized(
        &now->mechanism, now->run.state.t, positions(now), velocities(now), &now->inputs, &now->run.gains, &solved,
        &feedback);
    int is_good = growth < GROWTH_LIMIT;
    for (int at = 0; at < STATE_COUNT; at++) {
        derivatives[at] = ELEMENTS(solved)[at];
        is_good = is_good && isfinite(derivatives[at]);
    }
    /* which finds out what is wrong */
    const int code = is_good ? CAPS_OK : NAME_reactions(&now->run, &now->reactions);
    return is_good || code != CAPS_OK ? code : CAPS_SINGULAR;
}

/* Accelerations, multipliers, outputs and event indicators of the present state. */
static int solve(struct instance *it)
{
    struct memory *const now = &it->now;
    struct NAME_run *const run = &now->run;
    const struct NAME_state *const at = &run->state;
    int code = start(it);
    if (code != CAPS_OK || now->is_solved) {
        return code;
    }
    run->inputs = now->inputs;
    code = NAME_reactions(run, &now->reactions);
    if (code != CAPS_OK) {
        return code;
    }
    now->acceleration = now->reactions.acceleration;
    if (!it->is_co_simulation) {
        double derivatives[STATE_COUNT + 1];
        code = accelerate(now, derivatives);
        for (int j = 0; j < STATE_COUNT; j++) {
            PLACES(now->acceleration)[STATE_PLACES[j]] = derivatives[j];
        }
    }
    if (HAS_STOPS) {
        /* with the forces with which frictions stick here */
        code = NAME_outputs(run, &now->outputs);
    } else {
        NAME_compute_outputs(run->mechanism, at->t, &at->q, &at->v, &now->inputs, &now->reactions, &now->outputs);
    }
    NAME_compute_events(run->mechanism, at->t, &at->q, &at->v, &now->inputs, now->events);
    for (int output = 0; output < CAPS_OUTPUTS; output++) {
        if (!isfinite(ELEMENTS(now->outputs)[output])) {
            run->where = output;
            return CAPS_UNDEFINED_OUTPUT;
        }
    }
    now->is_solved = code == CAPS_OK;
    return code;
}

/* A group of values that stand side by side, and whether they have to be solved for. */
static const double *found(const struct memory *now, uint32_t reference, int *is_result)
{
    const struct NAME_state *const at = &now->run.state;
    *is_result = reference >= AT_ACCELERATIONS;
    if (reference < AT_PARAMETERS) {
        return &now->time;
    }
    if (reference < AT_INPUTS) {
        return ELEMENTS(now->parameters) + (reference - AT_PARAMETERS);
    }
    if (reference < AT_POSITIONS) {
        return ELEMENTS(now->inputs) + (reference - AT_INPUTS);
    }
    if (reference < AT_VELOCITIES) {
        return ELEMENTS(at->q) + (reference - AT_POSITIONS);
    }
    if (reference < AT_ACCELERATIONS) {
        return ELEMENTS(at->v) + (reference - AT_VELOCITIES);
    }
    if (reference < AT_MULTIPLIERS) {
        return ELEMENTS(now->acceleration) + (reference - AT_ACCELERATIONS);
    }
    if (reference < AT_OUTPUTS) {
        return ELEMENTS(now->reactions.multipliers) + (reference - AT_MULTIPLIERS);
    }
    if (reference < AT_EVENTS) {
        return ELEMENTS(now->outputs) + (reference - AT_OUTPUTS);
    }
    return reference < AT_END ? now->events + (reference - AT_EVENTS) : NULL;
}

/* Reads values. */
static int get(struct instance *it, const uint32_t *references, size_t count, double *values)
{
    for (size_t at = 0; at < count; at++) {
        int is_result, code = CAPS_OK;
        const double *const value = found(&it->now, references[at], &is_result);
        if (!value) {
            return say(it, WRONG, "there is no variable with the value reference %lu", (unsigned long)references[at]);
        }
        if (references[at] >= AT_POSITIONS) {
            code = is_result ? solve(it) : start(it);
        }
        if (code != CAPS_OK) {
            return say_code(it, WRONG, code);
        }
        values[at] = *value;
    }
    return FINE;
}

/* Sets parameters and inputs. */
static int set(struct instance *it, const uint32_t *references, size_t count, const double *values)
{
    struct memory *const now = &it->now;
    for (size_t at = 0; at < count; at++) {
        const uint32_t reference = references[at];
        if (lies_in(reference, AT_PARAMETERS, AT_INPUTS)) {
            const uint32_t parameter = reference - AT_PARAMETERS;
            const int is_early = now->mode & (INSTANTIATED | INITIALIZATION);
            if (!is_early && !IS_TUNABLE[parameter]) {
                return say(it, WRONG, "the parameter %s is fixed once a run has begun", NAME_parameter_names[parameter]);
            }
            if (now->mode & CONTINUOUS_TIME) {
                return say(it, WRONG, "the parameter %s changes at events only", NAME_parameter_names[parameter]);
            }
            PLACES(now->parameters)[parameter] = values[at];
            now->is_tuned = now->is_solved = 0;
            now->is_started = now->is_started && !is_early;
        } else if (lies_in(reference, AT_INPUTS, AT_MEMORIES)) {
            PLACES(now->inputs)[reference - AT_INPUTS] = values[at];
            now->is_solved = 0;
        } else if (reference < AT_END) {
            return say(
                it, WRONG, "only parameters and inputs can be set; the variable with the value reference %lu is calculated",
                (unsigned long)reference);
        } else {
            return say(it, WRONG, "there is no variable with the value reference %lu", (unsigned long)reference);
        }
    }
    return FINE;
}

