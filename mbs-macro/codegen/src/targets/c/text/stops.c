/* Stops at the ends of steps: time stepping by Moreau and Jean. */

/* Sets the memories of stops: which are rested on, and what impulses add up to. */
static void NAME_note_stops(struct NAME_run *run, const int *held, const real *impulses)
{
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        real *const memory = NAME_places(&run->inputs) + NAME_memories[stop];
        memory[0] = held[stop] ? 1 : 0;
        memory[1] = memory[1] + impulses[stop];
    }
}

/* The rates with which gaps open that close with others. */
static void NAME_rebound(const struct NAME_run *run, const real *rates, real *rebounds)
{
    real laws[2 * CAPS_STOPS + 1] = {0};
    NAME_compute_stop_laws(run->mechanism, laws);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        rebounds[stop] = rates[stop] < 0 ? -(laws[2 * stop] * rates[stop]) : 0;
    }
}

/* The rates that forces at the stops of a set take from gaps in a step, in which gaps change their rates without them; 0
   where there are none. */
static int NAME_hold_back(
    const real *contacts, const int *closed, const int *locked, const real *change, real *taken)
{
    int set[CAPS_ROWS];
    for (int row = 0; row < CAPS_ROWS; row++) {
        set[row] = closed[row] || locked[row];
    }
    const int is_answered = NAME_complementary(contacts, set, locked, change, taken);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        taken[stop] = NAME_mobility(contacts, stop, stop) * taken[stop];
    }
    return is_answered;
}

/* Half of what the forces of rest do in a step, before it. */
static int NAME_push(struct NAME_run *run, int *pushed)
{
    struct NAME_state *const at = &run->state;
    const real half = (real)0.5 * run->step;
    real contacts[CAPS_CONTACTS] = {0}, forces[CAPS_ROWS] = {0};
    int held[CAPS_ROWS], resting[CAPS_ROWS] = {0}, still[CAPS_ROWS] = {0};
    if (!NAME_find_held(run, held)) {
        return CAPS_OK;
    }
    int code = NAME_engage(run);
    if (code != CAPS_OK) {
        return code;
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        resting[row] = row < CAPS_STOPS && held[row];
        still[row] = row >= CAPS_STOPS && row < CAPS_OWN_ROWS && held[row];
    }
    code = NAME_decide(run, resting, still, forces);
    if (code != CAPS_OK) {
        return code;
    }
    NAME_find_held(run, held);
    NAME_compute_contacts(run->mechanism, at->t, &at->q, contacts);
    for (int row = 0; row < CAPS_ROWS; row++) {
        pushed[row] = forces[row] > 0 || (row >= CAPS_STOPS && held[row]);
        forces[row] = half * forces[row];
    }
    NAME_add_responses(contacts, forces, 0, CAPS_COORDINATES, NAME_places(&at->v));
    return CAPS_OK;
}

/* A step that ends at stops: the rates of gaps at its start and its end, and the impulses that answer them. */
struct NAME_answer {
    real before[CAPS_ROWS], now[CAPS_ROWS], gap_now[CAPS_ROWS];
    /* the part of the step behind the closing of a gap, and what an impulse moves positions by */
    real rest[CAPS_ROWS], shift[CAPS_ROWS];
    int closed[CAPS_ROWS], held[CAPS_ROWS], locked[CAPS_ROWS], is_impact;
    /* how far gaps may be behind their stops where modes lead them */
    double allowed[CAPS_ROWS];
    real impulses[CAPS_ROWS], moved[CAPS_ROWS], gaps[CAPS_ROWS];
};

/* An impact at the gaps that are closing, with these rates; 0 where no impulses answer it. */
static int NAME_hit(
    const struct NAME_run *run, const real *contacts, const real *rates, const int *closing, const int *hit, int turn,
    struct NAME_answer *it)
{
    real change[CAPS_ROWS] = {0}, taken[CAPS_ROWS] = {0}, approach[CAPS_ROWS] = {0}, thrown[CAPS_ROWS] = {0}, wanted[CAPS_ROWS] = {0};
    real more[CAPS_ROWS] = {0};
    int set[CAPS_ROWS];
    for (int row = 0; row < CAPS_ROWS; row++) {
        change[row] = it->now[row] - it->before[row];
        wanted[row] = rates[row];
        set[row] = closing[row] || it->locked[row];
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        approach[stop] = turn == 0 ? it->now[stop] - it->rest[stop] * change[stop] : rates[stop];
    }
    if (!NAME_hold_back(contacts, it->closed, it->locked, change, taken)) {
        if (!NAME_is_any(it->locked)) {
            return 0;
        }
        for (int row = 0; row < CAPS_ROWS; row++) {
            taken[row] = 0;
        }
    }
    NAME_rebound(run, approach, thrown);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const real later = turn == 0 ? it->rest[stop] * change[stop] : 0;
        /* what closes in the last of all impacts is rested on */
        it->held[stop] = it->closed[stop] && (turn == 15 || thrown[stop] <= taken[stop]);
        /* a force that presses for a step is no impact */
        it->is_impact = it->is_impact || (hit[stop] && -approach[stop] > taken[stop]);
        const real target = it->held[stop] ? 0 : thrown[stop] + later;
        wanted[stop] = rates[stop] - (target > 0 ? target : 0);
    }
    int is_answered = NAME_complementary(contacts, set, it->locked, wanted, more);
    if (!is_answered) {
        /* what others keep closed throws nothing back */
        int kept[CAPS_ROWS];
        NAME_find_kept_closed(contacts, set, it->locked, kept);
        for (int row = 0; row < CAPS_ROWS; row++) {
            wanted[row] = kept[row] ? rates[row] : wanted[row];
        }
        is_answered = NAME_complementary(contacts, set, it->locked, wanted, more);
    }
    if (!is_answered) {
        /* where modes and drives lead to what is closed, it gives no impulse while it is closed within what modes may be off */
        int is_led = NAME_is_any(it->locked);
        for (int stop = 0; stop < CAPS_STOPS; stop++) {
            is_led = is_led && !(closing[stop] && (double)it->gap_now[stop] < -it->allowed[stop]);
        }
        if (!is_led) {
            return 0;
        }
        NAME_solve_at_stops(contacts, it->locked, rates, more);
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        it->impulses[row] = it->impulses[row] + more[row];
    }
    return 1;
}

/* The impulses at the stops that are closed, or that impulses close, one impact after the other; 0 where there are none. */
static int NAME_find_impulses(const struct NAME_run *run, const real *contacts, struct NAME_answer *it)
{
    if (!(contacts[CAPS_CONTACTS - 1] < NAME_growth_limit)) {
        return 0;
    }
    for (int turn = 0; turn <= 16; turn++) {
        real rates[CAPS_ROWS] = {0};
        int closing[CAPS_ROWS] = {0}, hit[CAPS_ROWS] = {0}, is_hit = 0;
        for (int row = 0; row < CAPS_ROWS; row++) {
            it->moved[row] = it->impulses[row] * it->shift[row];
            it->gaps[row] = it->gap_now[row];
            rates[row] = it->now[row];
        }
        NAME_change_rates(contacts, it->moved, it->gaps);
        NAME_change_rates(contacts, it->impulses, rates);
        for (int stop = 0; stop < CAPS_STOPS; stop++) {
            double size = fabs((double)it->before[stop]) + fabs((double)it->now[stop]);
            for (int by = 0; by < CAPS_ROWS; by++) {
                size = size + fabs((double)NAME_mobility(contacts, stop, by) * (double)it->impulses[by]);
            }
            it->closed[stop] = it->closed[stop] || it->gaps[stop] <= 0;
            closing[stop] = it->closed[stop] && (double)rates[stop] <= NAME_rounding(1e-12) * size;
            hit[stop] = closing[stop] && (double)rates[stop] < -(NAME_rounding(1e-12) * size);
            is_hit = is_hit || hit[stop];
        }
        if (turn == 16 || !is_hit) {
            for (int stop = 0; stop < CAPS_STOPS; stop++) {
                it->held[stop] = closing[stop] && it->held[stop] && it->impulses[stop] > 0;
            }
            return 1;
        }
        if (!NAME_hit(run, contacts, rates, closing, hit, turn, it)) {
            return 0;
        }
    }
    return 0;
}

/* Leads the end of a step back from the stops that are closed there, or that are closed by impulses at these. */
static int NAME_strike_stops(struct NAME_run *run, const int *pushed, const struct NAME_state *before)
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
    int set[CAPS_ROWS], is_closed = 0;
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, now);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        it.closed[stop] = pushed[stop] || now[3 * stop] <= 0;
        is_closed = is_closed || it.closed[stop];
    }
    if (!is_closed) {
        NAME_note_stops(run, it.held, it.impulses);
        return CAPS_OK;
    }
    NAME_compute_gaps(m, before->t, &before->q, &before->v, &still, was);
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
        it.allowed[row] = NAME_allowed(size, NAME_slope(contacts, row));
        it.gap_now[row] = now[3 * row];
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const real gap = was[3 * stop], end = now[3 * stop];
        const real part = gap > 0 && end < gap ? gap / (gap - end) : 0;
        it.rest[stop] = part < 1 ? 1 - part : 0;
        it.shift[stop] = pushed[stop] ? 0 : it.rest[stop] * run->step;
    }
    if (!NAME_find_impulses(run, contacts, &it)) {
        return NAME_unanswered(run, it.closed);
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        set[row] = it.held[row] || (it.locked[row] && !NAME_is_of_rates(row));
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
        it.impulses[stop] = it.is_impact ? it.impulses[stop] : 0;
    }
    NAME_note_stops(run, it.held, it.impulses);
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

int NAME_step(struct NAME_run *run)
{
    const struct NAME_run before = *run;
    int pushed[CAPS_ROWS] = {0}, due[CAPS_ROWS + 16] = {0};
    int code = NAME_push(run, pushed);
    code = code == CAPS_OK ? NAME_step_free(run) : code;
    /* a stop may throw back what a condition has let pass */
    NAME_find_due(run, due);
    code = code == CAPS_OK ? NAME_strike_stops(run, pushed, &before.state) : code;
    code = code == CAPS_OK ? NAME_halt(run, pushed, &before.state) : code;
    code = code == CAPS_OK ? NAME_pass_and_engage(run, due) : code;
    if (code != CAPS_OK) {
        const int where = run->where;
        *run = before;
        run->where = where;
    }
    return code;
}

