/* Derivatives of results by states, inputs and time, without differences. */

/* How fast everything changes along a direction. */
struct rates {
    double time;
    struct NAME_STATES states_q, states_v;
    struct NAME_inputs inputs;
    struct NAME_coordinates q, v, acceleration;
    struct NAME_reactions reactions;
    struct NAME_outputs outputs;
    double events[CAPS_EVENTS + 1];
};

static double *append(double *to, const void *from, int count)
{
    memcpy(to, from, (size_t)count * sizeof *to);
    return to + count;
}

/* A direction of the arguments of a function: time, positions, velocities, and inputs. */
static double *direction(double *to, const struct rates *of, const void *q, const void *v, int count)
{
    *to = of->time;
    to = append(append(to + 1, q, count), v, count);
    return append(to, &of->inputs, CAPS_INPUTS);
}

static void differentiate(struct instance *it, struct rates *rates)
{
    struct memory *const now = &it->now;
    const struct NAME *const m = &now->mechanism;
    const struct NAME_state *const at = &now->run.state;
    const struct NAME_constraints no_feedback = {0};
    struct NAME_STATES solved, q, v;
    struct NAME_constraints feedback;
    double along[1 + 3 * CAPS_COORDINATES + CAPS_INPUTS + CAPS_CONSTRAINTS + 1] = {0};
    for (int j = 0; j < STATE_COUNT; j++) {
        PLACES(q)[j] = ELEMENTS(at->q)[STATE_PLACES[j]];
        PLACES(v)[j] = ELEMENTS(at->v)[STATE_PLACES[j]];
    }
    direction(along, rates, &rates->states_q, &rates->states_v, STATE_COUNT);
    NAME_along_complete(m, at->t, &q, &v, along, &rates->q, &rates->v);
    /* the feedback that reactions are given is none, and stays none */
    double *end = direction(along, rates, &rates->q, &rates->v, CAPS_COORDINATES);
    memset(end, 0, CAPS_CONSTRAINTS * sizeof *end);
    NAME_along_reactions(
        m, at->t, &at->q, &at->v, &now->inputs, &no_feedback, along, &rates->reactions.acceleration,
        &rates->reactions.multipliers);
    NAME_along_events(m, at->t, &at->q, &at->v, &now->inputs, along, rates->events);
    end = append(end, &rates->reactions.acceleration, CAPS_COORDINATES);
    append(end, &rates->reactions.multipliers, CAPS_CONSTRAINTS);
    NAME_along_outputs(m, at->t, &at->q, &at->v, &now->inputs, &now->reactions, along, &rates->outputs);
    rates->acceleration = rates->reactions.acceleration;
    if (!it->is_co_simulation) {
        direction(along, rates, &rates->states_q, &rates->states_v, STATE_COUNT);
        NAME_along_stabilized(m, at->t, &q, &v, &now->inputs, &now->run.gains, along, &solved, &feedback);
        for (int j = 0; j < STATE_COUNT; j++) {
            PLACES(rates->acceleration)[STATE_PLACES[j]] = ELEMENTS(solved)[j];
        }
    }
}

/* Where the rate of a known stands: the time, an input, or what is integrated. */
static double *known(struct rates *rates, uint32_t reference)
{
    if (reference == AT_TIME) {
        return &rates->time;
    }
    if (lies_in(reference, AT_INPUTS, AT_MEMORIES)) {
        return PLACES(rates->inputs) + (reference - AT_INPUTS);
    }
    for (int j = 0; j < STATE_COUNT; j++) {
        if (reference == AT_POSITIONS + (uint32_t)STATE_PLACES[j]) {
            return PLACES(rates->states_q) + j;
        }
        if (reference == AT_VELOCITIES + (uint32_t)STATE_PLACES[j]) {
            return PLACES(rates->states_v) + j;
        }
    }
    return NULL;
}

/* The rate of an unknown. */
static const double *unknown(const struct rates *rates, uint32_t reference)
{
    if (reference < AT_POSITIONS || reference >= AT_END) {
        return NULL;
    }
    if (reference < AT_VELOCITIES) {
        return ELEMENTS(rates->q) + (reference - AT_POSITIONS);
    }
    if (reference < AT_ACCELERATIONS) {
        return ELEMENTS(rates->v) + (reference - AT_VELOCITIES);
    }
    if (reference < AT_MULTIPLIERS) {
        return ELEMENTS(rates->acceleration) + (reference - AT_ACCELERATIONS);
    }
    if (reference < AT_OUTPUTS) {
        return ELEMENTS(rates->reactions.multipliers) + (reference - AT_MULTIPLIERS);
    }
    return reference < AT_EVENTS ? ELEMENTS(rates->outputs) + (reference - AT_OUTPUTS)
                                 : rates->events + (reference - AT_EVENTS);
}

static int no_known(const struct instance *it, uint32_t reference)
{
    return say(
        it, WRONG, "derivatives are by the time, inputs and continuous states; the value reference %lu is none of them",
        (unsigned long)reference);
}

/* sensitivity = d unknowns / d knowns * seed */
static int forward(
    struct instance *it, const uint32_t *unknowns, size_t unknown_count, const uint32_t *knowns, size_t known_count,
    const double *seed, double *sensitivity)
{
    if (HAS_STOPS) {
        return say(it, WRONG, "a mechanism with stops has no derivatives, since impacts have none");
    }
    struct rates rates = {0};
    const int code = solve(it);
    if (code != CAPS_OK) {
        return say_code(it, WRONG, code);
    }
    for (size_t at = 0; at < known_count; at++) {
        double *const rate = known(&rates, knowns[at]);
        if (!rate) {
            return no_known(it, knowns[at]);
        }
        *rate += seed[at];
    }
    differentiate(it, &rates);
    for (size_t at = 0; at < unknown_count; at++) {
        const double *const rate = unknown(&rates, unknowns[at]);
        if (!rate) {
            return say(
                it, WRONG, "the value reference %lu is no result, and has no derivative", (unsigned long)unknowns[at]);
        }
        sensitivity[at] = *rate;
    }
    return FINE;
}

/* sensitivity = seed * d unknowns / d knowns, one known after the other */
static int adjoint(
    struct instance *it, const uint32_t *unknowns, size_t unknown_count, const uint32_t *knowns, size_t known_count,
    const double *seed, double *sensitivity)
{
    double slope = 0.0;
    for (size_t at = 0; at < known_count; at++) {
        const double one = 1.0;
        sensitivity[at] = 0.0;
        for (size_t row = 0; row < unknown_count; row++) {
            const int status = forward(it, unknowns + row, 1, knowns + at, 1, &one, &slope);
            if (status != FINE) {
                return status;
            }
            sensitivity[at] += seed[row] * slope;
        }
    }
    return FINE;
}

