/* Friction that sticks: which of it does, and with which forces. */

/* The direction in which friction slides; 0 while it sticks. */
static double NAME_direction(const struct NAME_run *run, int row)
{
    return (double)NAME_elements(&run->inputs)[NAME_memories[row]];
}

/* Sets the memories of friction: its direction and the force with which it sticks. */
static void NAME_set_friction(struct NAME_run *run, int row, double direction, real held)
{
    real *const memory = NAME_places(&run->inputs) + NAME_memories[row];
    memory[0] = (real)direction;
    memory[1] = held;
}

/* Marks the constraints of the modes that hold; true if there is one. */
static int NAME_find_locked(const struct NAME_run *run, int *locked)
{
    const int is_held = NAME_find_held(run, locked);
    int is_locked = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        locked[row] = is_held && row >= CAPS_OWN_ROWS && locked[row];
        is_locked = is_locked || locked[row];
    }
    return is_locked;
}

/* True of constraints of modes that restrict no position. */
static int NAME_is_of_rates(int row)
{
    return row >= CAPS_OWN_ROWS && NAME_locks[row - CAPS_OWN_ROWS][1];
}

/* Sets the memories of the multipliers of the constraints of modes that hold. */
static void NAME_note_multipliers(struct NAME_run *run, const int *held, const real *forces)
{
    for (int row = CAPS_OWN_ROWS; row < CAPS_ROWS; row++) {
        const real multiplier = held[row] ? -forces[row] : 0;
        NAME_places(&run->inputs)[NAME_locks[row - CAPS_OWN_ROWS][0]] = multiplier;
    }
}

/* The first of a set of contacts has no answer. */
static int NAME_unanswered(struct NAME_run *run, const int *set)
{
    int first = 0;
    while (first < CAPS_ROWS - 1 && !set[first]) {
        first++;
    }
    run->where = NAME_memories[first];
    return first < CAPS_STOPS ? CAPS_IMPACT : first < CAPS_OWN_ROWS ? CAPS_JAMMED : CAPS_CONTRADICTION;
}

/* Adds to rates of gaps their changes by impulses. */
static void NAME_change_rates(const real *contacts, const real *impulses, real *rates)
{
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        real change = 0;
        for (int by = 0; by < CAPS_ROWS; by++) {
            change = change + NAME_mobility(contacts, stop, by) * impulses[by];
        }
        rates[stop] = rates[stop] + change;
    }
}

/* The first friction of a set that holds nothing, whatever its force: on what a drive moves, and at dead centres. */
static int NAME_without_hold(
    const int *set, const real *b, const double *left, struct NAME_reactions *reactions)
{
    const real *const a = NAME_places(&reactions->acceleration);
    double largest = 0;
    for (int at = 0; at < CAPS_COORDINATES; at++) {
        const double size = fabs((double)a[at]);
        largest = size > largest ? size : largest;
    }
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        const double size = fabs(left[row]);
        if (set[row] && size > 1e-6 * fabs((double)b[row]) && size > 1e-9 * largest) {
            return row;
        }
    }
    return -1;
}

/* Of the frictions of a set the one whose force is most beyond its limit, of which there are two per friction; -1 where none
   is. */
static int NAME_loose(const int *set, const real *forces, const real *limits)
{
    int loose = -1;
    double worst = 0;
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        const double force = fabs((double)forces[row]), most = (double)limits[2 * (row - CAPS_STOPS) + 1];
        /* what has no largest force does not stick */
        const double beyond = !(most > 0) ? HUGE_VAL : force > (1.0 + NAME_rounding(1e-12)) * most ? force / most : 0;
        if (set[row] && beyond > worst) {
            loose = row;
            worst = beyond;
        }
    }
    return loose;
}

/* Decides which of the frictions that do not move stick, and which stops are rested on; sets the memories of frictions. */
static int NAME_decide(struct NAME_run *run, const int *resting, const int *still, real *forces)
{
    const struct NAME *const m = run->mechanism;
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    int sticking[CAPS_ROWS], bound[CAPS_ROWS], set[CAPS_ROWS], locked[CAPS_ROWS];
    NAME_find_locked(run, locked);
    for (int row = 0; row < CAPS_ROWS; row++) {
        sticking[row] = still[row];
    }
    for (int tries = 0; tries <= 8 * (CAPS_OWN_ROWS - CAPS_STOPS); tries++) {
        struct NAME_reactions reactions = {0};
        real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, limits[2 * CAPS_ROWS] = {0}, b[CAPS_ROWS];
        int turned = -1;
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            if (sticking[row]) {
                NAME_set_friction(run, row, 0, 0);
            }
        }
        NAME_compute_reactions(
            m, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions.acceleration,
            &reactions.multipliers);
        NAME_compute_gaps(m, at->t, &at->q, &at->v, &reactions, gaps);
        NAME_compute_contacts(m, at->t, &at->q, contacts);
        for (int row = 0; row < CAPS_ROWS; row++) {
            b[row] = gaps[3 * row + 2];
            bound[row] = sticking[row] || locked[row];
            set[row] = resting[row] || bound[row];
        }
        if (!NAME_complementary(contacts, set, bound, b, forces)) {
            return NAME_unanswered(run, set);
        }
        NAME_add_responses(contacts, forces, 0, CAPS_COORDINATES, NAME_places(&reactions.acceleration));
        NAME_add_responses(
            contacts, forces, CAPS_COORDINATES, CAPS_CONSTRAINTS, NAME_places(&reactions.multipliers));
        NAME_compute_limits(m, at->t, &at->q, &at->v, &run->inputs, &reactions, limits);
        const int loose = NAME_loose(sticking, forces, limits);
        if (loose >= 0) {
            NAME_set_friction(run, loose, forces[loose] > 0 ? -1.0 : 1.0, 0);
            sticking[loose] = 0;
            continue;
        }
        double left[CAPS_ROWS] = {0};
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            real change = 0;
            for (int by = 0; by < CAPS_ROWS; by++) {
                change = change + NAME_mobility(contacts, row, by) * forces[by];
            }
            left[row] = (double)(b[row] + change);
        }
        const int slipping = NAME_without_hold(sticking, b, left, &reactions);
        if (slipping >= 0) {
            NAME_set_friction(run, slipping, left[slipping] > 0 ? 1.0 : -1.0, 0);
            sticking[slipping] = 0;
            continue;
        }
        for (int row = CAPS_OWN_ROWS - 1; row >= CAPS_STOPS; row--) {
            const double own = (double)NAME_mobility(contacts, row, row);
            const double least = 2.0 * 1e-6 * own * (double)limits[2 * (row - CAPS_STOPS) + 1];
            if (still[row] && !sticking[row] && least > 0 && NAME_direction(run, row) * left[row] < -least) {
                turned = row;
            }
        }
        if (turned >= 0) {
            sticking[turned] = 1;
            continue;
        }
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            if (sticking[row]) {
                NAME_set_friction(run, row, 0, forces[row]);
            }
        }
        NAME_note_multipliers(run, locked, forces);
        return CAPS_OK;
    }
    return NAME_unanswered(run, still);
}

/* Sets the memories of the forces with which frictions stick and modes hold. */
static void NAME_hold(struct NAME_run *run)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    struct NAME_reactions reactions = {0};
    real forces[CAPS_ROWS] = {0};
    int held[CAPS_ROWS], is_held = 0;
    const int none[CAPS_ROWS] = {0};
    NAME_find_held(run, held);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        NAME_set_friction(run, row, NAME_direction(run, row), 0);
    }
    for (int row = CAPS_STOPS; row < CAPS_ROWS; row++) {
        is_held = is_held || held[row];
    }
    NAME_note_multipliers(run, none, forces);
    if (!is_held) {
        return;
    }
    NAME_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions.acceleration,
        &reactions.multipliers);
    NAME_press_with(run, held, &reactions, forces);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        if (held[row]) {
            NAME_set_friction(run, row, 0, forces[row]);
        }
    }
    NAME_note_multipliers(run, held, forces);
}

/* Sets the directions of the frictions that move at a start; marks those that do not. */
static void NAME_slide(struct NAME_run *run, int *still)
{
    const struct NAME *const m = run->mechanism;
    const struct NAME_state *const at = &run->state;
    const struct NAME_reactions unmoved = {0};
    const double energy = (double)NAME_compute_kinetic_energy(m, at->t, &at->q, &at->v);
    real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0};
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &unmoved, gaps);
    NAME_compute_contacts(m, at->t, &at->q, contacts);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        const double own = (double)NAME_mobility(contacts, row, row), rate = (double)gaps[3 * row + 1];
        still[row] = fabs(rate) <= 1e-9 * sqrt(2.0 * (energy > 0 ? energy : 0) * (own > 0 ? own : 0));
        if (!still[row]) {
            NAME_set_friction(run, row, rate > 0 ? 1.0 : -1.0, 0);
        }
    }
}

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
            const real part = NAME_direction(run, row) * (double)from > 0 ? 1 - from / (from - to) : 1;
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
    const real *contacts, const int *resting, const real *now, struct NAME_halting *it, real *impulses)
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
        NAME_solve_at_stops(contacts, set, b, x);
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
    const real *contacts, const int *stuck, const int *resting, const int *locked, const real *was, const real *now,
    const struct NAME_halting *it, const real *moved, real *back)
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
        NAME_solve_at_stops(contacts, set, slipped, back);
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
    int held[CAPS_ROWS], locked[CAPS_ROWS], stuck[CAPS_ROWS] = {0}, crossed[CAPS_ROWS] = {0}, acts[CAPS_ROWS] = {0};
    int has_acted = NAME_find_locked(run, locked);
    if (CAPS_OWN_ROWS == CAPS_STOPS && !has_acted) {
        return CAPS_OK;
    }
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, now);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        stuck[row] = pushed[row];
        crossed[row] = NAME_direction(run, row) * (double)now[3 * row + 1] < 0;
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
        NAME_compute_gaps(m, before->t, &before->q, &before->v, &still, was);
        NAME_compute_contacts(m, at->t, &at->q, contacts);
        if (!(contacts[CAPS_CONTACTS - 1] < NAME_growth_limit)) {
            return NAME_unanswered(run, acts);
        }
        for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
            held[row] = 0;
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
            NAME_find_halts(contacts, held, now, &it, impulses);
            for (int row = 0; row < CAPS_ROWS; row++) {
                rates[row] = now[3 * row + 1];
            }
            NAME_change_rates(contacts, impulses, rates);
            for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
                if (!stuck[row] && !crossed[row] && NAME_direction(run, row) * (double)rates[row] < 0) {
                    ends[3 * row + 1] = rates[row];
                    crossed[row] = 1;
                    is_late = 1;
                }
            }
        }
        for (int row = 0; row < CAPS_ROWS; row++) {
            moved[row] = impulses[row] * it.shift[row];
        }
        NAME_find_way_back(contacts, stuck, held, locked, was, now, &it, moved, back);
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

