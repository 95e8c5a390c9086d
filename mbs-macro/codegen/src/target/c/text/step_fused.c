/* The sum is finite only if every component is; four sums do not wait for each other. */
static real NAME_sum(const real *x, int count)
{
    real sums[4] = {0};
    for (int at = 0; at < count; at++) {
        sums[at % 4] = sums[at % 4] + x[at];
    }
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

int NAME_step(struct NAME_run *run)
{
    const real t_next = run->start_time + (real)(run->steps + 1) * run->step;
    struct NAME_state next;
    const real growth =
        run->is_held ? NAME_step_held(run, t_next, &next) : NAME_step_per_stage(run, t_next, &next);
    const real sum = NAME_sum(NAME_elements(&next.q), CAPS_COORDINATES)
        + NAME_sum(NAME_elements(&next.v), CAPS_COORDINATES);
    /* written so that what is not a number fails the test */
    if (growth <= run->alarm && isfinite(sum) && NAME_watch_redundant(run, &next) == CAPS_OK) {
        run->state = next;
        NAME_note(run, growth);
        return CAPS_OK;
    }
    return NAME_step_again(run, t_next);
}
