/* Leads the end of a step back from the stops that are closed there, or that are closed by impulses at these. */
static int NAME_strike_stops(
    struct NAME_run *run, const int *pushed, const real *halves, const struct NAME_state *before, int *is_impact)
{
    const struct NAME *const m = run->mechanism;
    struct NAME_state *const at = &run->state;
    const struct NAME_reactions still = {0};
    struct NAME_answer it = {0};
    struct NAME_coordinates of_q = {0}, of_v = {0}, led = {0};
    struct NAME_constraints rows = {0};
    real now[3 * CAPS_ROWS] = {0}, was[3 * CAPS_ROWS] = {0}, rated[3 * CAPS_ROWS] = {0};
    real contacts[CAPS_CONTACTS] = {0}, shifts[CAPS_ROWS] = {0};
    const double size = (double)NAME_largest(NAME_elements(&at->q), CAPS_LINES);
    const struct NAME_constraints no_feedback = {0};
    struct NAME_reactions free = {0};
    double speed = (double)NAME_largest(NAME_elements(&before->v), CAPS_LINES);
    int set[CAPS_ROWS], is_closed = 0;
RUBS     int closed[CAPS_ROWS] = {0}, held[CAPS_ROWS];
    it.pushed = pushed;
    it.halves = halves;
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, now);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        /* a gap that is no number, too, for which there is no answer */
        it.closed[stop] = pushed[stop] || !(now[3 * stop] > 0);
RUBS         closed[stop] = it.closed[stop];
        is_closed = is_closed || it.closed[stop];
    }
    if (!is_closed) {
        NAME_note_stops(run, it.held, it.impulses);
        return CAPS_OK;
    }
    NAME_compute_gaps(m, before->t, &before->q, &before->v, &still, was);
    NAME_compute_reactions(
        m, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &free.acceleration, &free.multipliers);
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &free, rated);
    for (int row = 0; row < CAPS_ROWS; row++) {
        it.pressing[row] = run->step * rated[3 * row + 2];
    }
    if ((double)NAME_largest(NAME_elements(&at->v), CAPS_LINES) > speed) {
        speed = (double)NAME_largest(NAME_elements(&at->v), CAPS_LINES);
    }
    /* velocities as joints at the end have them: those of the start change by forces alone, and stops that depend on each
       other do not contradict each other by what joints are off */
    for (int end = 0; end < 2; end++) {
        const struct NAME_coordinates *const v = end ? &at->v : &before->v;
        NAME_compute_phi_dot(m, at->t, &at->q, v, &rows);
        NAME_compute_projection(m, at->t, &at->q, &rows, &of_v);
        for (int j = 0; j < CAPS_COORDINATES; j++) {
            NAME_places(&led)[j] = NAME_elements(v)[j] - NAME_elements(&of_v)[j];
            NAME_places(&of_v)[j] = 0;
        }
        NAME_compute_gaps(m, at->t, &at->q, &led, &still, rated);
        for (int row = 0; row < CAPS_ROWS; row++) {
            (end ? it.now : it.before)[row] = rated[3 * row + 1];
        }
    }
    NAME_compute_contacts(m, at->t, &at->q, contacts);
    NAME_find_locked(run, it.locked);
    for (int row = 0; row < CAPS_ROWS; row++) {
        const double slope = NAME_slope(contacts, row);
        it.allowed[row] = NAME_allowed(size, slope);
        it.nearest[row] = NAME_rounding(1e-14) * size * slope;
        it.slowest[row] = NAME_rounding(1e-14) * speed * slope;
        it.gap_now[row] = now[3 * row];
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const real gap = was[3 * stop], end = now[3 * stop];
        const real part = gap > 0 && end < gap ? gap / (gap - end) : 0;
        it.rest[stop] = part < 1 ? 1 - part : 0;
        it.shift[stop] = pushed[stop] ? 0 : it.rest[stop] * run->step;
        it.rested[stop] = pushed[stop] || NAME_elements(&run->inputs)[NAME_memories[stop]] > (real)0.5;
    }
RUBS     NAME_find_bounds(m, &it.bounds);
RUBS     NAME_find_held(run, held);
RUBS     for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
RUBS         it.slid[row] = NAME_direction(run, row);
RUBS         it.shift[row] = NAME_stop_of(row) >= 0 ? it.shift[NAME_stop_of(row)] : 0;
RUBS     }
    if (!NAME_find_impulses(run, contacts, &it)) {
SMOOTH         return NAME_unanswered(run, it.closed);
RUBS         return NAME_unanswered(run, closed);
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        set[row] = it.held[row] || (it.locked[row] && !NAME_is_of_rates(row));
RUBS         /* what has stuck in the whole step is where it was */
RUBS         if (NAME_stop_of(row) >= 0 && held[row] && it.directions[row] == 0) {
RUBS             set[row] = 1;
RUBS             it.gaps[row] = it.gaps[row] - was[3 * row];
RUBS         }
    }
    NAME_solve_at_stops(contacts, set, it.gaps, shifts);
    for (int row = 0; row < CAPS_ROWS; row++) {
        shifts[row] = it.moved[row] + shifts[row];
    }
    NAME_add_responses(contacts, shifts, 0, CAPS_COORDINATES, NAME_places(&of_q));
    NAME_add_responses(contacts, it.impulses, 0, CAPS_COORDINATES, NAME_places(&of_v));
    NAME_add(NAME_places(&at->q), 1, NAME_elements(&of_q), CAPS_COORDINATES);
    NAME_add(NAME_places(&at->v), 1, NAME_elements(&of_v), CAPS_COORDINATES);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        /* the second half of a rest has no part in an impact */
        const real impulse = it.impulses[stop] - (pushed[stop] ? halves[stop] : 0);
        it.impulses[stop] = it.is_impact && impulse > 0 ? impulse : 0;
    }
    NAME_note_stops(run, it.held, it.impulses);
    *is_impact = it.is_impact;
RUBS     for (int at_row = 0; at_row < CAPS_RUBBING; at_row++) {
RUBS         const int row = NAME_rubbing[at_row][0], stop = NAME_rubbing[at_row][1];
RUBS         if (closed[stop] || it.held[stop]) {
RUBS             NAME_set_friction(run, row, it.directions[row], 0);
RUBS         }
RUBS     }
    return CAPS_OK;
}

/* Rests on the stops that a start touches; one behind a stop is refused. */
static int NAME_touch(struct NAME_run *run)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    const double size = 1e-9 * (1e-3 + (double)NAME_largest(NAME_elements(&at->q), CAPS_LINES));
    struct NAME_reactions reactions = {0};
    real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, thrown[CAPS_ROWS] = {0}, taken[CAPS_ROWS] = {0};
    real b[CAPS_ROWS] = {0}, forces[CAPS_ROWS] = {0};
    const real none[CAPS_ROWS] = {0};
    int closed[CAPS_ROWS] = {0}, settled[CAPS_ROWS] = {0}, still[CAPS_ROWS] = {0}, locked[CAPS_ROWS];
    NAME_look(run);
    NAME_find_locked(run, locked);
    NAME_slide(run, still);
    NAME_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions.acceleration,
        &reactions.multipliers);
    NAME_compute_gaps(run->mechanism, at->t, &at->q, &at->v, &reactions, gaps);
    NAME_compute_contacts(run->mechanism, at->t, &at->q, contacts);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        b[stop] = gaps[3 * stop + 1];
    }
    NAME_rebound(run, b, thrown);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const double slope = NAME_slope(contacts, stop);
        if ((double)gaps[3 * stop] < -(size * slope)) {
            run->where = NAME_memories[stop];
            return CAPS_BEHIND;
        }
        closed[stop] = (double)gaps[3 * stop] <= size * slope;
        b[stop] = run->step * gaps[3 * stop + 2];
    }
    for (int row = CAPS_OWN_ROWS; row < CAPS_ROWS; row++) {
        b[row] = run->step * gaps[3 * row + 2];
        if (locked[row] && !(fabs((double)gaps[3 * row]) <= NAME_allowed(size / 1e-9, NAME_slope(contacts, row)))) {
            run->where = NAME_memories[row];
            return CAPS_APART;
        }
    }
    if (!NAME_hold_back(contacts, closed, locked, b, taken)) {
        return NAME_unanswered(run, closed);
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        settled[stop] = closed[stop] && gaps[3 * stop + 1] <= taken[stop] && thrown[stop] <= taken[stop];
    }
    const int code = NAME_decide(run, settled, still, forces);
    if (code != CAPS_OK) {
        return code;
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        settled[stop] = forces[stop] > 0;
    }
    NAME_note_stops(run, settled, none);
    return CAPS_OK;
}

int NAME_start(struct NAME_run *run, const struct NAME *m, double step)
{
    const int code = NAME_start_free(run, m, step);
    return code == CAPS_OK ? NAME_touch(run) : code;
}

int NAME_start_from(struct NAME_run *run, const struct NAME_state *state)
{
    const int code = NAME_start_from_free(run, state);
    return code == CAPS_OK ? NAME_touch(run) : code;
}

/* Leaves the stops that would have to pull at what rests on them with the velocities behind an impact. */
static int NAME_keep_pushing(struct NAME_run *run)
{
    const real none[CAPS_ROWS] = {0};
    real forces[CAPS_ROWS] = {0};
    int held[CAPS_ROWS], resting[CAPS_ROWS], still[CAPS_ROWS], is_resting = 0;
    NAME_find_held(run, held);
    for (int row = 0; row < CAPS_ROWS; row++) {
        resting[row] = row < CAPS_STOPS && held[row];
        still[row] = row >= CAPS_STOPS && row < CAPS_OWN_ROWS && held[row];
        is_resting = is_resting || resting[row];
    }
    const int code = is_resting ? NAME_decide(run, resting, still, forces) : CAPS_OK;
    if (code != CAPS_OK || !is_resting) {
        return code;
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        resting[stop] = resting[stop] && forces[stop] > 0;
    }
    NAME_note_stops(run, resting, none);
    return CAPS_OK;
}

int NAME_step(struct NAME_run *run)
{
    const struct NAME_run before = *run;
    int pushed[CAPS_ROWS] = {0}, due[CAPS_ROWS + 16] = {0}, is_impact = 0;
    real halves[CAPS_ROWS] = {0};
    int code = NAME_push(run, pushed, halves);
    code = code == CAPS_OK ? NAME_step_free(run) : code;
    NAME_find_due(run, due);
    code = code == CAPS_OK ? NAME_strike_stops(run, pushed, halves, &before.state, &is_impact) : code;
    code = code == CAPS_OK ? NAME_halt(run, pushed, &before.state) : code;
    code = code == CAPS_OK && is_impact ? NAME_keep_pushing(run) : code;
    /* an impact throws back what a condition has let pass; what modes, rests and frictions lead back has not passed it */
    for (int of = 0; of < CAPS_ROWS + 16; of++) {
        due[of] = is_impact && due[of];
    }
    code = code == CAPS_OK ? NAME_pass_and_engage(run, due) : code;
    if (code != CAPS_OK) {
        const int where = run->where;
        *run = before;
        run->where = where;
    }
    return code;
}

