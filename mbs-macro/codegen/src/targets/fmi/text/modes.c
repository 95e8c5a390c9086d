/* The way of an instance through its modes. */

static int enter_initialization(struct instance *it, double start_time)
{
    if (!isfinite(start_time)) {
        return say(it, WRONG, "the start time is not finite");
    }
    it->now.time = start_time;
    it->now.is_started = 0;
    it->now.mode = INITIALIZATION;
    return FINE;
}

static int exit_initialization(struct instance *it)
{
    int code = start(it);
    if (code == CAPS_OK) {
        take_samples(&it->now);
        code = solve(it);
    }
    if (code != CAPS_OK) {
        return say_code(it, WRONG, code);
    }
    it->now.mode = it->is_co_simulation ? STEP_MODE : EVENT_MODE;
    return FINE;
}

/* Model exchange. */

static int set_time(struct instance *it, double time)
{
    if (!isfinite(time)) {
        return say(it, WRONG, "the time is not finite");
    }
    it->now.time = time;
    place(&it->now);
    return FINE;
}

static int set_states(struct instance *it, const double *states, size_t count)
{
    if (count != 2 * STATE_COUNT) {
        return say(it, WRONG, "there are %d continuous states, and not %lu", 2 * STATE_COUNT, (unsigned long)count);
    }
    memcpy(it->now.states, states, count * sizeof *states);
    place(&it->now);
    return FINE;
}

static int get_states(struct instance *it, double *states, size_t count)
{
    const int code = start(it);
    if (code != CAPS_OK) {
        return say_code(it, WRONG, code);
    }
    if (count != 2 * STATE_COUNT) {
        return say(it, WRONG, "there are %d continuous states, and not %lu", 2 * STATE_COUNT, (unsigned long)count);
    }
    memcpy(states, it->now.states, count * sizeof *states);
    return FINE;
}

static int get_derivatives(struct instance *it, double *derivatives, size_t count)
{
    int code = start(it);
    if (count != 2 * STATE_COUNT) {
        return say(it, WRONG, "there are %d continuous states, and not %lu", 2 * STATE_COUNT, (unsigned long)count);
    }
    if (code == CAPS_OK) {
        memcpy(derivatives, velocities(&it->now), STATE_COUNT * sizeof *derivatives);
        code = accelerate(&it->now, derivatives + STATE_COUNT);
    }
    /* a solver may come again with a shorter step */
    return code == CAPS_OK ? FINE : say_code(it, DISCARD, code);
}

static int get_nominals(const struct instance *it, double *nominals, size_t count)
{
    if (count != 2 * STATE_COUNT) {
        return say(it, WRONG, "there are %d continuous states, and not %lu", 2 * STATE_COUNT, (unsigned long)count);
    }
    for (size_t at = 0; at < count; at++) {
        nominals[at] = 1.0;
    }
    return FINE;
}

static int get_events(struct instance *it, double *indicators, size_t count)
{
    const int code = solve(it);
    if (count != CAPS_EVENTS) {
        return say(it, WRONG, "there are %d event indicators, and not %lu", CAPS_EVENTS, (unsigned long)count);
    }
    if (code != CAPS_OK) {
        return say_code(it, DISCARD, code);
    }
    memcpy(indicators, it->now.events, count * sizeof *indicators);
    return FINE;
}

/* Co-simulation. */

/* Another step from here on, with feedback that suits it. */
static int change_step(struct memory *now, double step)
{
    const struct feedback gains = CO_SIMULATION;
    now->run.start_time = now->run.state.t;
    now->run.steps = 0;
    now->run.step = step;
    /* gains that were declared stay; others go with the step */
    const double scale = HAS_DECLARED_GAINS ? 1.0 : STEP / step;
    return NAME_set_feedback(&now->run, gains.alpha * scale, gains.beta * scale, gains.is_held);
}

/* Leads to a time by steps of equal length, as long as they are meant to be or a little shorter. Inputs are constant
   on the way. */
static int lead_to(struct memory *now, double end, double rounding)
{
    struct NAME_run *const run = &now->run;
    const double span = end - run->state.t;
    const double count = ceil((span - rounding) / STEP);
    const double steps = count < 1.0 ? 1.0 : count;
    const int is_whole = fabs(span - steps * STEP) <= rounding;
    int code = CAPS_OK;
    if (!is_whole || run->step != STEP) {
        code = change_step(now, is_whole ? STEP : span / steps);
    }
    run->inputs = now->inputs;
    now->is_solved = 0;
    for (double step = 0.0; code == CAPS_OK && step < steps; step += 1.0) {
        code = NAME_step(run);
    }
    take_memories(now);
    return code;
}

/* Leads to the end of a communication step, from sample to sample of the clocks. */
static int advance(struct instance *it, double point, double length)
{
    struct memory *const now = &it->now;
    struct NAME_run *const run = &now->run;
    const double end = point + length + now->shift;
    if (!(isfinite(end - run->state.t) && length > 0.0)) {
        return say(it, WRONG, "a communication step has to be positive and finite");
    }
    /* of the times of importer, mechanism and clocks */
    const double size = fabs(point) + length + fabs(now->shift) + fabs(run->start_time) + clock_size(now);
    const double rounding = 8.0 * 2.220446049250313e-16 * size;
    if (fabs(point + now->shift - run->state.t) > 1e-3 * length + rounding) {
        return say(
            it, WRONG, "the communication point is %.17g s, but the last step ended at %.17g s", point,
            run->state.t - now->shift);
    }
    int code = start(it);
    for (double sample = next_sample(now); code == CAPS_OK && sample < end - rounding; sample = next_sample(now)) {
        code = lead_to(now, sample, rounding);
        now->time = run->state.t - now->shift;
        take_samples(now);
    }
    code = code == CAPS_OK ? lead_to(now, end, rounding) : code;
    now->time = code == CAPS_OK ? point + length : run->state.t - now->shift;
    if (code == CAPS_OK) {
        take_samples(now);
    }
    return code == CAPS_OK ? FINE : say_code(it, WRONG, code);
}
