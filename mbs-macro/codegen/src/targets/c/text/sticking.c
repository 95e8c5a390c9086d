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
    return row >= CAPS_OWN_ROWS && NAME_of_rates[row - CAPS_OWN_ROWS];
}

/* Sets the memories of the forces of stops and of the multipliers of modes, those of what holds to theirs and the others to
   0. */
static void NAME_note_forces(struct NAME_run *run, const int *held, const real *forces)
{
    for (int at = 0; at < CAPS_NOTED; at++) {
        const int row = NAME_noted[at][0];
        const real force = row < CAPS_STOPS ? forces[row] : -forces[row];
        NAME_places(&run->inputs)[NAME_noted[at][1]] = held[row] ? force : 0;
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
RUBS     int rubbing[CAPS_ROWS], free[CAPS_ROWS];
RUBS     double directions[CAPS_ROWS] = {0};
RUBS     struct NAME_bounds bounds;
RUBS     NAME_find_bounds(m, &bounds);
    NAME_find_locked(run, locked);
    for (int row = 0; row < CAPS_ROWS; row++) {
SMOOTH         sticking[row] = still[row];
RUBS         /* what is off its stop does not rub; what is on it is decided with the stop */
RUBS         free[row] = still[row] && NAME_stop_of(row) < 0;
RUBS         sticking[row] = free[row];
RUBS         rubbing[row] = still[row] && NAME_is_borne(resting, row);
RUBS         if (row >= CAPS_STOPS && row < CAPS_OWN_ROWS) {
RUBS             directions[row] = rubbing[row] ? 0 : NAME_direction(run, row);
RUBS         }
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
SMOOTH         if (!NAME_complementary(contacts, set, bound, b, forces)) {
RUBS         const struct NAME_hit rest = {resting, bound, directions, &bounds, b};
RUBS         struct NAME_struck struck;
RUBS         if (!NAME_meet(contacts, &rest, b, &struck)) {
            return NAME_unanswered(run, set);
        }
RUBS         for (int row = 0; row < CAPS_ROWS; row++) {
RUBS             forces[row] = struck.impulses[row];
RUBS         }
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
SMOOTH             if (still[row] && !sticking[row] && least > 0 && NAME_direction(run, row) * left[row] < -least) {
RUBS             if (free[row] && !sticking[row] && least > 0 && NAME_direction(run, row) * left[row] < -least) {
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
RUBS             if (rubbing[row]) {
RUBS                 NAME_set_friction(run, row, struck.directions[row], struck.held[row] ? forces[row] : 0);
RUBS             }
        }
        NAME_note_forces(run, set, forces);
        return CAPS_OK;
    }
SMOOTH     return NAME_unanswered(run, still);
RUBS     return NAME_unanswered(run, free);
}

/* Sets the memories of all forces that hold to 0. */
static void NAME_let_go(struct NAME_run *run)
{
    const real forces[CAPS_ROWS] = {0};
    const int none[CAPS_ROWS] = {0};
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        NAME_set_friction(run, row, NAME_direction(run, row), 0);
    }
    NAME_note_forces(run, none, forces);
}

/* Sets the memories of the forces of stops, frictions that stick and modes; gives the accelerations and multipliers there. */
static void NAME_measure(struct NAME_run *run, struct NAME_reactions *reactions)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    real forces[CAPS_ROWS] = {0};
    int held[CAPS_ROWS];
    const int is_held = NAME_find_held(run, held);
    NAME_let_go(run);
    NAME_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, &reactions->acceleration,
        &reactions->multipliers);
    if (!is_held) {
        return;
    }
    NAME_press_with(run, held, reactions, forces);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        if (held[row]) {
            NAME_set_friction(run, row, 0, forces[row]);
        }
    }
    NAME_note_forces(run, held, forces);
}

/* The same without these. */
static void NAME_hold(struct NAME_run *run)
{
    struct NAME_reactions reactions = {0};
    int held[CAPS_ROWS], is_held = 0;
    NAME_find_held(run, held);
    for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
        is_held = is_held || held[row];
    }
    for (int at = 0; at < CAPS_NOTED; at++) {
        is_held = is_held || held[NAME_noted[at][0]];
    }
    if (is_held) {
        NAME_measure(run, &reactions);
    } else {
        NAME_let_go(run);
    }
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

