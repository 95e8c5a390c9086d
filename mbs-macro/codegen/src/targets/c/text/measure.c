
/* The accelerations and multipliers of a state. */
static void NAME_measure(const struct NAME_run *run, struct NAME_reactions *reactions)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    NAME_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions->acceleration,
        &reactions->multipliers);
}
