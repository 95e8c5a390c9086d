/* The largest period and offset, whose roundings the times of all samples have. */
static double clock_size(const struct memory *now)
{
    double times[2 * CAPS_CLOCKS], size = 0.0;
    NAME_compute_clocks(&now->mechanism, times);
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        const double of_clock = times[2 * clock] + fabs(times[2 * clock + 1]);
        size = of_clock > size ? of_clock : size;
    }
    return size;
}

/* The first sample of a clock behind the present time by more than some roundings. */
static double sample_behind(const struct memory *now, int clock, double roundings)
{
    double times[2 * CAPS_CLOCKS];
    NAME_compute_clocks(&now->mechanism, times);
    const double size = clock_size(now) + fabs(now->time) + fabs(now->shift);
    /* within a period, so that samples of several clocks at one time are that but for rounding */
    const double period = times[2 * clock], offset = times[2 * clock + 1] - floor(times[2 * clock + 1] / period) * period;
    const double t = now->run.state.t + roundings * 2.220446049250313e-16 * size;
    const double before = floor((t - offset) / period);
    const double next = offset + (before + 1) * period;
    return next > t ? next : offset + (before + 2) * period;
}

static void begin_clocks(struct memory *now)
{
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        now->samples[clock] = sample_behind(now, clock, -8.0);
    }
}

/* When the next sample is, in the time of the mechanism. */
static double next_sample(const struct memory *now)
{
    double first = INFINITY;
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        first = now->samples[clock] < first ? now->samples[clock] : first;
    }
    return first;
}

/* Takes the samples that are due, in the order of the clocks. */
static void take_samples(struct memory *now)
{
    now->run.inputs = now->inputs;
    for (int clock = 0; clock < CAPS_CLOCKS; clock++) {
        const double next = sample_behind(now, clock, 8.0);
        if (next > now->samples[clock]) {
            NAME_sample(&now->run, clock);
            now->samples[clock] = next;
            now->is_solved = 0;
        }
    }
    now->inputs = now->run.inputs;
}

