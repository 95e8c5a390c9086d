/* There are no clocks. */
static void begin_clocks(struct memory *now)
{
    (void)now;
}

static double clock_size(const struct memory *now)
{
    (void)now;
    return 0.0;
}

static double next_sample(const struct memory *now)
{
    (void)now;
    return INFINITY;
}

static void take_samples(struct memory *now)
{
    (void)now;
}

