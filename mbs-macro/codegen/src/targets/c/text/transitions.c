/* Transitions: samples where a condition begins to hold. */

/* Notes on which side of its condition every transition is at a start. */
static void NAME_look(struct NAME_run *run)
{
    const struct NAME_state *const at = &run->state;
    real values[CAPS_TRANSITIONS] = {0};
    NAME_compute_transitions(run->mechanism, at->t, &at->q, &at->v, &run->inputs, values);
    for (int of = 0; of < CAPS_TRANSITIONS; of++) {
        /* one that is 0 is on the side that its comparison says */
        const real none = (real)(NAME_sides[of][2] * 1e-30);
        NAME_places(&run->inputs)[NAME_sides[of][0]] = values[of] == 0 ? none : values[of];
    }
}

/* Marks the transitions whose conditions have begun to hold; gives what their memories are from then on. */
static void NAME_find_seen(const struct NAME_run *run, int *due, real *seen)
{
    const struct NAME_state *const at = &run->state;
    NAME_compute_transitions(run->mechanism, at->t, &at->q, &at->v, &run->inputs, seen);
    for (int of = 0; of < CAPS_TRANSITIONS; of++) {
        const double side = NAME_sides[of][1], now = (double)seen[of];
        const double before = (double)NAME_elements(&run->inputs)[NAME_sides[of][0]];
        const double size = fabs(before) > fabs(now) ? fabs(before) : fabs(now);
        const int is_at_limit =
            NAME_sides[of][3] && fabs(now) <= NAME_rounding(1e-12) * fabs(before) && fabs(before) > 2e-30;
        /* what a mode keeps at its limit is off by the error of a step */
        const int has_held = side * before > 0;
        const int holds =
            has_held ? side * now >= -(NAME_rounding(1e-6) * fabs(before)) : side * now > 0 || is_at_limit;
        due[of] = side * before < 0 && holds;
        seen[of] = (real)(holds ? side * size : -side * size);
    }
}

/* Takes the samples of the transitions whose conditions have begun to hold, those of some that are known among them, and of
   those whose conditions do by that. */
static int NAME_pass(struct NAME_run *run, const int *known, int *passes)
{
    for (int turn = 0; turn <= 16; turn++) {
        real seen[CAPS_TRANSITIONS] = {0};
        int due[CAPS_TRANSITIONS] = {0}, is_due = 0;
        NAME_find_seen(run, due, seen);
        for (int of = 0; of < CAPS_TRANSITIONS; of++) {
            NAME_places(&run->inputs)[NAME_sides[of][0]] = seen[of];
            due[of] = due[of] || (turn == 0 && known[of]);
            is_due = is_due || due[of];
        }
        if (!is_due) {
            return CAPS_OK;
        }
        for (int of = 0; of < CAPS_TRANSITIONS; of++) {
            if (due[of]) {
                NAME_take_sample(run, CAPS_CLOCKS + of);
                *passes = 1;
            }
        }
    }
    return CAPS_ENDLESS;
}

