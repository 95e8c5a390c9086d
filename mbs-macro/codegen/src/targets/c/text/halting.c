/* The impulses of frictions at the end of a step, and those of stops that are rested on. */
struct NAME_halting {
    int halted[CAPS_ROWS];
    /* the directions in which they slide from then on */
    double directions[CAPS_ROWS];
    /* the impulses before the step, of those that stuck in it */
    real given[CAPS_ROWS];
    /* the largest impulses that halt, in pairs as the limits of forces, and those of what is not halted by them, both with
       what was given */
    real most[2 * CAPS_ROWS], loose[CAPS_ROWS];
    /* half of the rest of the step: by how much an impulse moves positions */
    real shift[CAPS_ROWS];
};

/* True if a friction that slid has come to a halt, or goes against the direction in which it slid. */
static int NAME_has_crossed(const struct NAME_run *run, int row, real was, real rate)
{
    const double direction = NAME_direction(run, row), from = direction * (double)was, to = direction * (double)rate;
    return to < 0 || (from > 0 && to <= NAME_rounding(1e-12) * from);
}

/* Half a step of those that stuck, and the rest of the step of those that have come to a halt in it. */
static void NAME_begin_halt(
    const struct NAME_run *run, const int *stuck, const int *crossed, const real *was, const real *now,
    const real *limits, struct NAME_halting *it)
{
    const real h = run->step, half = (real)0.5;
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        const int at = 2 * (row - CAPS_STOPS);
        const real sliding = limits[at], sticking = limits[at + 1];
        it->halted[row] = stuck[row] || crossed[row];
        if (crossed[row]) {
            const real from = was[3 * row + 1], to = now[3 * row + 1];
            const double direction = NAME_direction(run, row);
            /* what is halted by others may have been still all the time */
            const int has_turned = direction * (double)from > 0 && direction * (double)to < 0;
            const real part = has_turned ? 1 - from / (from - to) : 1;
            const real rest = part * h;
            it->most[at + 1] = rest * (sliding + sticking);
            it->loose[row] = rest * (sliding + sliding);
            it->shift[row] = half * rest;
        } else if (stuck[row]) {
            it->given[row] = half * h * NAME_elements(&run->inputs)[NAME_memories[row] + 1];
            it->most[at + 1] = h * sticking;
            it->loose[row] = h * sliding;
        }
    }
}

/* The impulses; the worst of those that need more than they can have slides on. */
static void NAME_find_halts(
SMOOTH     const real *contacts, const int *resting, const real *now, struct NAME_halting *it, real *impulses)
RUBS     const real *contacts, const real *slides, const int *resting, const real *now, struct NAME_halting *it,
RUBS     real *impulses)
{
    real fixed[CAPS_ROWS] = {0}, b[CAPS_ROWS], x[CAPS_ROWS], total[CAPS_ROWS];
    int set[CAPS_ROWS], loose = 0;
    while (loose >= 0) {
        for (int row = 0; row < CAPS_ROWS; row++) {
            real change = 0;
            for (int by = 0; by < CAPS_ROWS; by++) {
                change = change + NAME_mobility(contacts, row, by) * fixed[by];
            }
            b[row] = now[3 * row + 1] + change;
            set[row] = it->halted[row] || resting[row];
        }
SMOOTH         NAME_solve_at_stops(contacts, set, b, x);
RUBS         NAME_solve_sliding(contacts, slides, set, b, x);
        for (int row = 0; row < CAPS_ROWS; row++) {
            total[row] = x[row] + it->given[row];
        }
        loose = NAME_loose(it->halted, total, it->most);
        if (loose >= 0) {
            fixed[loose] = (total[loose] > 0 ? it->loose[loose] : -it->loose[loose]) - it->given[loose];
            it->directions[loose] = total[loose] > 0 ? -1.0 : 1.0;
            it->halted[loose] = 0;
        }
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        impulses[row] = x[row] + fixed[row];
    }
}

/* What leads back to where they were what stuck in the whole step, and to the constraints of modes; stops that are rested on
   stay where they are. */
static void NAME_find_way_back(
SMOOTH     const real *contacts, const int *stuck, const int *resting, const int *locked, const real *was, const real *now,
SMOOTH     const struct NAME_halting *it, const real *moved, real *back)
RUBS     const real *contacts, const real *slides, const int *stuck, const int *resting, const int *locked, const real *was,
RUBS     const real *now, const struct NAME_halting *it, const real *moved, real *back)
{
    real slipped[CAPS_ROWS];
    int set[CAPS_ROWS], is_held = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        const int held = it->halted[row] && stuck[row];
        slipped[row] = locked[row] && !NAME_is_of_rates(row) ? now[3 * row] : held ? now[3 * row] - was[3 * row] : 0;
        set[row] = held || (resting[row] && !NAME_is_of_rates(row));
        back[row] = 0;
        is_held = is_held || held || locked[row];
    }
    if (is_held) {
        NAME_change_rates(contacts, moved, slipped);
SMOOTH         NAME_solve_at_stops(contacts, set, slipped, back);
RUBS         NAME_solve_sliding(contacts, slides, set, slipped, back);
    }
}

/* Answers friction at the end of a step, behind what stops did. */
static int NAME_halt(struct NAME_run *run, const int *pushed, const struct NAME_state *before)
{
    const struct NAME *const m = run->mechanism;
    struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    const struct NAME_reactions still = {0};
    struct NAME_reactions reactions = {0};
    struct NAME_halting it = {0};
    struct NAME_coordinates of_q = {0}, of_v = {0};
    real now[3 * CAPS_ROWS] = {0}, was[3 * CAPS_ROWS] = {0}, limits[2 * CAPS_ROWS] = {0};
    real contacts[CAPS_CONTACTS] = {0}, forces[CAPS_ROWS], impulses[CAPS_ROWS], moved[CAPS_ROWS];
    real back[CAPS_ROWS], ends[3 * CAPS_ROWS], rates[CAPS_ROWS];
RUBS     real slides[CAPS_ROWS];
    int held[CAPS_ROWS], locked[CAPS_ROWS], stuck[CAPS_ROWS] = {0}, crossed[CAPS_ROWS] = {0}, acts[CAPS_ROWS] = {0};
    int has_acted = NAME_find_locked(run, locked);
SMOOTH     if (CAPS_OWN_ROWS == CAPS_STOPS && !has_acted) {
RUBS     if (CAPS_OWN_ROWS == CAPS_STOPS + CAPS_RUBBING && !has_acted) {
RUBS         NAME_hold(run);
        return CAPS_OK;
    }
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, now);
    NAME_compute_gaps(m, before->t, &before->q, &before->v, &still, was);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
SMOOTH         stuck[row] = pushed[row];
SMOOTH         crossed[row] = NAME_has_crossed(run, row, was[3 * row + 1], now[3 * row + 1]);
RUBS         stuck[row] = pushed[row] && NAME_stop_of(row) < 0;
RUBS         crossed[row] = NAME_stop_of(row) < 0 && NAME_has_crossed(run, row, was[3 * row + 1], now[3 * row + 1]);
        acts[row] = stuck[row] || crossed[row];
        has_acted = has_acted || acts[row];
    }
    for (int row = CAPS_OWN_ROWS; row < CAPS_ROWS; row++) {
        acts[row] = locked[row];
    }
    if (has_acted) {
        const int is_held = NAME_find_held(run, held);
        NAME_compute_reactions(
            m, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions.acceleration,
            &reactions.multipliers);
        if (is_held) {
            NAME_press_with(run, held, &reactions, forces);
        }
        NAME_compute_limits(m, at->t, &at->q, &at->v, &run->inputs, &reactions, limits);
        NAME_compute_contacts(m, at->t, &at->q, contacts);
        if (!(contacts[CAPS_CONTACTS - 1] < NAME_growth_limit)) {
            return NAME_unanswered(run, acts);
        }
RUBS         NAME_find_sliding(run, slides);
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
SMOOTH             held[row] = 0;
RUBS             held[row] = held[row] && NAME_stop_of(row) >= 0;
        }
        for (int row = 0; row < 3 * CAPS_ROWS; row++) {
            ends[row] = now[row];
        }
        /* sliding may come to a halt by the impulses of those that stick */
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            crossed[row] = 0;
        }
        int is_late = 1;
        while (is_late) {
            const struct NAME_halting none = {0};
            it = none;
            is_late = 0;
            NAME_begin_halt(run, stuck, crossed, was, ends, limits, &it);
SMOOTH             NAME_find_halts(contacts, held, now, &it, impulses);
RUBS             NAME_find_halts(contacts, slides, held, now, &it, impulses);
            for (int row = 0; row < CAPS_ROWS; row++) {
                rates[row] = now[3 * row + 1];
            }
            NAME_change_rates(contacts, impulses, rates);
            for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
RUBS                 if (NAME_stop_of(row) >= 0) {
RUBS                     continue;
RUBS                 }
                if (!stuck[row] && !crossed[row] && NAME_has_crossed(run, row, was[3 * row + 1], rates[row])) {
                    ends[3 * row + 1] = rates[row];
                    crossed[row] = 1;
                    is_late = 1;
                }
            }
        }
        for (int row = 0; row < CAPS_ROWS; row++) {
            moved[row] = impulses[row] * it.shift[row];
        }
SMOOTH         NAME_find_way_back(contacts, stuck, held, locked, was, now, &it, moved, back);
RUBS         NAME_find_way_back(contacts, slides, stuck, held, locked, was, now, &it, moved, back);
        NAME_add_responses(contacts, moved, 0, CAPS_COORDINATES, NAME_places(&of_q));
        NAME_add_responses(contacts, back, 0, CAPS_COORDINATES, NAME_places(&of_q));
        NAME_add_responses(contacts, impulses, 0, CAPS_COORDINATES, NAME_places(&of_v));
        NAME_add(NAME_places(&at->q), 1, NAME_elements(&of_q), CAPS_COORDINATES);
        NAME_add(NAME_places(&at->v), 1, NAME_elements(&of_v), CAPS_COORDINATES);
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            if (stuck[row] || crossed[row]) {
                NAME_set_friction(run, row, it.directions[row], 0);
            }
        }
    }
    NAME_hold(run);
    return CAPS_OK;
}

