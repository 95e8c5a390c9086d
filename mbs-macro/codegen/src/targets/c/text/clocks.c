/* Clocks, which set memories. */

/* The steps from sample to sample of a clock, a whole number. */
static double NAME_steps_of(const struct NAME_run *run, double seconds)
{
    return floor(seconds / (double)run->step + 0.5);
}

void NAME_sample(struct NAME_run *run, int clock)
{
    NAME_take_sample(run, clock);
}

/* Takes the samples that are due, in the order of the clocks. */
static void NAME_sample_due(struct NAME_run *run)
{
    real times[2 * CAPS_CLOCKS] = {0};
    NAME_compute_clocks(run->mechanism, times);
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        const double period = (double)times[2 * clock], offset = (double)times[2 * clock + 1];
        const double count = NAME_steps_of(run, period);
        const double steps = NAME_steps_of(run, (double)run->start_time - offset) + (double)run->steps;
        if (steps - floor(steps / count) * count == 0) {
            NAME_sample(run, clock);
        }
    }
}

/* The first samples, where whole numbers of steps lead to them and from each to the next. */
static int NAME_begin_clocks(struct NAME_run *run)
{
    real times[2 * CAPS_CLOCKS] = {0};
    NAME_compute_clocks(run->mechanism, times);
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        const double period = (double)times[2 * clock], offset = (double)times[2 * clock + 1];
        const double start = (double)run->start_time, step = (double)run->step;
        const double slack = 8 * (double)NAME_epsilon, count = NAME_steps_of(run, period);
        const double first = (start - offset) / step, rounding = slack * (1 + (fabs(start) + fabs(offset)) / step);
        if (!(count >= 1 && fabs(period / step - count) <= slack * count
              && fabs(first - floor(first + 0.5)) <= rounding)) {
            return CAPS_BAD_PERIOD;
        }
    }
    NAME_sample_due(run);
    return CAPS_OK;
}

int NAME_start(struct NAME_run *run, const struct NAME *m, double step)
{
    const int code = NAME_start_unsampled(run, m, step);
    return code == CAPS_OK ? NAME_begin_clocks(run) : code;
}

int NAME_start_from(struct NAME_run *run, const struct NAME_state *state)
{
    const int code = NAME_start_from_unsampled(run, state);
    return code == CAPS_OK ? NAME_begin_clocks(run) : code;
}

int NAME_step(struct NAME_run *run)
{
    const int code = NAME_step_unsampled(run);
    if (code == CAPS_OK) {
        NAME_sample_due(run);
    }
    return code;
}

