/* Transitions: samples where a condition begins to hold. */

/* The value of every transition. Where forces are known, those that see them see those of this state; memories stay as they
   are. */
static void NAME_find_transitions(struct NAME_run *run, int are_forces_known, real *values)
{
    const struct NAME_state *const at = &run->state;
    struct NAME_reactions reactions = {0};
SEES     const struct NAME_inputs inputs = run->inputs;
SEES     if (are_forces_known) {
SEES         NAME_measure(run, &reactions);
SEES     }
BLIND     (void)are_forces_known;
    NAME_compute_transitions(run->mechanism, at->t, &at->q, &at->v, &run->inputs, &reactions, values);
SEES     run->inputs = inputs;
}

/* Notes on which side of its condition every transition is at a start. Those that see forces do not hold yet. */
static void NAME_look(struct NAME_run *run)
{
    real values[CAPS_TRANSITIONS] = {0};
    NAME_find_transitions(run, 0, values);
    for (int of = 0; of < CAPS_TRANSITIONS; of++) {
        /* one that is 0 is on the side that its comparison says */
        const int side = NAME_sides[of][4] ? -NAME_sides[of][1] : NAME_sides[of][2];
        const int is_known = !NAME_sides[of][4] && values[of] != 0;
        NAME_places(&run->inputs)[NAME_sides[of][0]] = is_known ? values[of] : (real)(side * 1e-30);
    }
}

/* True if a condition that holds goes on to: its value is that much beyond its limit, and was at most `largest`. */
static int NAME_stays(int of, double largest, double beyond)
{
    /* where no mode holds that it asks for, there is no force */
    const int is_strict = NAME_sides[of][1] != NAME_sides[of][2];
    const int is_none = NAME_sides[of][4] && is_strict && beyond == 0;
    /* what a mode keeps at its limit is off by the error of a step */
    return beyond >= -(NAME_rounding(1e-6) * largest) && !is_none;
}

/* True if a condition that does not hold begins to. Forces are solved for, and are none within rounding. */
static int NAME_begins(int of, double largest, double beyond)
{
    const double rounding = NAME_rounding(1e-12) * largest;
    const int is_at_limit = NAME_sides[of][3] && fabs(beyond) <= rounding && largest > 2e-30;
    return NAME_sides[of][4] ? beyond > rounding : beyond > 0 || is_at_limit;
}

/* Marks the transitions whose conditions have begun to hold; gives what their memories are from then on. Those that see
   forces are judged where these are known. */
static void NAME_find_seen(struct NAME_run *run, int are_forces_known, int *due, real *seen)
{
    NAME_find_transitions(run, are_forces_known, seen);
    for (int of = 0; of < CAPS_TRANSITIONS; of++) {
        const double side = NAME_sides[of][1], now = (double)seen[of];
        const real remembered = NAME_elements(&run->inputs)[NAME_sides[of][0]];
        const double before = (double)remembered;
        const double size = fabs(before) > fabs(now) ? fabs(before) : fabs(now);
        if (NAME_sides[of][4] && !are_forces_known) {
            due[of] = 0;
            seen[of] = remembered;
            continue;
        }
        const int holds = side * before > 0 ? NAME_stays(of, fabs(before), side * now)
                                            : NAME_begins(of, fabs(before), side * now);
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
        /* behind what the first ones set, forces are known where velocities have followed */
        NAME_find_seen(run, turn == 0, due, seen);
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

