/* Modes: constraints that hold with any force. */

/* Sum of |dg/dq| of a contact. */
static double NAME_slope(const real *contacts, int row)
{
    const real *const slopes =
        contacts + row * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS) + CAPS_COORDINATES + CAPS_CONSTRAINTS;
    double slope = 0;
    for (int j = 0; j < CAPS_COORDINATES; j++) {
        slope = slope + fabs((double)slopes[j]);
    }
    return slope;
}

/* True if a set has a contact. */
static int NAME_is_any(const int *set)
{
    int is_any = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        is_any = is_any || set[row];
    }
    return is_any;
}

/* How much of a constraint, or its rate, is that of joints which are off. */
static double NAME_of_joints(const real *contacts, int row, const struct NAME_constraints *off)
{
    const real *const reactions = contacts + row * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS) + CAPS_COORDINATES;
    double sum = 0;
    for (int k = 0; k < CAPS_CONSTRAINTS; k++) {
        sum = sum + fabs((double)(reactions[k] * NAME_elements(off)[k]));
    }
    return 2.0 * sum;
}

/* How far a constraint may be off where its mode is entered. */
static double NAME_allowed(double size, double slope)
{
    return NAME_rounding(1e-6) * (1e-3 + size) * slope;
}

/* Leads velocities to the constraints of the modes that hold. */
static int NAME_engage(struct NAME_run *run)
{
    const struct NAME *const m = run->mechanism;
    struct NAME_state *const at = &run->state;
    const struct NAME_reactions still = {0};
    const double size = (double)NAME_largest(NAME_elements(&at->q), CAPS_LINES);
    const double fastest = (double)NAME_largest(NAME_elements(&at->v), CAPS_LINES);
    struct NAME_coordinates of_v = {0};
    struct NAME_constraints off = {0};
    real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, rates[CAPS_ROWS], after[CAPS_ROWS], impulses[CAPS_ROWS] = {0};
    int locked[CAPS_ROWS], set[CAPS_ROWS];
    if (!NAME_find_locked(run, locked)) {
        return CAPS_OK;
    }
    NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, gaps);
    NAME_compute_contacts(m, at->t, &at->q, contacts);
    NAME_find_held(run, set);
    NAME_compute_phi(m, at->t, &at->q, &off);
    for (int row = 0; row < CAPS_ROWS; row++) {
        const double way = 4.0 * (double)run->step * fabs((double)gaps[3 * row + 1]);
        const double allowed =
            NAME_allowed(size, NAME_slope(contacts, row)) + way + NAME_of_joints(contacts, row, &off);
        rates[row] = gaps[3 * row + 1];
        after[row] = rates[row];
        set[row] = locked[row] || (row < CAPS_STOPS && set[row]);
        if (locked[row] && !(fabs((double)gaps[3 * row]) <= allowed)) {
            run->where = NAME_memories[row];
            return CAPS_APART;
        }
    }
RUBS     const double none[CAPS_ROWS] = {0};
RUBS     struct NAME_bounds bounds;
RUBS     struct NAME_struck struck;
RUBS     NAME_find_bounds(m, &bounds);
RUBS     for (int row = CAPS_STOPS; row < CAPS_ROWS; row++) {
RUBS         set[row] = 0;
RUBS     }
RUBS     const struct NAME_hit hit = {set, locked, none, &bounds, rates};
    if (!(contacts[CAPS_CONTACTS - 1] < NAME_growth_limit)
SMOOTH         || !NAME_complementary(contacts, set, locked, rates, impulses)) {
RUBS         || !NAME_answer_hit(contacts, &hit, rates, &struck)) {
        return NAME_unanswered(run, locked);
    }
RUBS     for (int row = 0; row < CAPS_ROWS; row++) {
RUBS         impulses[row] = struck.impulses[row];
RUBS     }
    NAME_change_rates(contacts, impulses, after);
    NAME_compute_phi_dot(m, at->t, &at->q, &at->v, &off);
    for (int row = CAPS_OWN_ROWS; row < CAPS_ROWS; row++) {
        /* and what moves no position by more than rounding */
        const double slope = NAME_slope(contacts, row), slowest = 1e-9 * (1e-3 + size) / (double)run->step;
        const double left =
            NAME_rounding(1e-6) * (fabs((double)rates[row]) + slope * fastest) + slope * slowest
            + NAME_of_joints(contacts, row, &off);
        if (locked[row] && !(fabs((double)after[row]) <= left)) {
            run->where = NAME_memories[row];
            return CAPS_CONTRADICTION;
        }
    }
    NAME_add_responses(contacts, impulses, 0, CAPS_COORDINATES, NAME_places(&of_v));
    NAME_add(NAME_places(&at->v), 1, NAME_elements(&of_v), CAPS_COORDINATES);
RUBS     for (int row = CAPS_STOPS; row < CAPS_OWN_ROWS; row++) {
RUBS         if (struck.rubbed[row]) {
RUBS             NAME_set_friction(run, row, struck.directions[row], 0);
RUBS         }
RUBS     }
    /* the entry of a mode hits what is rested on; a smaller impulse is the rounding of a mode that holds */
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        real *const sum = NAME_places(&run->inputs) + NAME_memories[stop] + 1;
        const double rate = (double)(NAME_mobility(contacts, stop, stop) * impulses[stop]);
        if (rate > NAME_rounding(1e-6) * (NAME_slope(contacts, stop) * fastest)) {
            *sum = *sum + impulses[stop];
        }
    }
    return CAPS_OK;
}

/* Leads positions to the constraints of the modes that hold; stops that are rested on stay closed. */
static void NAME_close(struct NAME_run *run)
{
    const struct NAME *const m = run->mechanism;
    struct NAME_state *const at = &run->state;
    const struct NAME_reactions still = {0};
    int set[CAPS_ROWS];
    if (!NAME_find_locked(run, set)) {
        return;
    }
    NAME_find_held(run, set);
    for (int row = CAPS_STOPS; row < CAPS_ROWS; row++) {
        set[row] = set[row] && row >= CAPS_OWN_ROWS && !NAME_is_of_rates(row);
    }
    for (int step = 0; step < 4; step++) {
        struct NAME_coordinates of_q = {0};
        real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, b[CAPS_ROWS], x[CAPS_ROWS];
        NAME_compute_gaps(m, at->t, &at->q, &at->v, &still, gaps);
        NAME_compute_contacts(m, at->t, &at->q, contacts);
        for (int row = 0; row < CAPS_ROWS; row++) {
            b[row] = gaps[3 * row];
        }
        NAME_solve_at_stops(contacts, set, b, x);
        NAME_add_responses(contacts, x, 0, CAPS_COORDINATES, NAME_places(&of_q));
        NAME_add(NAME_places(&at->q), 1, NAME_elements(&of_q), CAPS_COORDINATES);
    }
}

/* What conditions change that have begun to hold at the end of a step. */
static int NAME_pass_and_engage(struct NAME_run *run, const int *known)
{
    const int none[16] = {0};
    for (int turn = 0; turn <= 16; turn++) {
        int passes = 0, code = NAME_pass(run, turn == 0 ? known : none, &passes);
        if (code != CAPS_OK || !passes) {
            return code;
        }
        code = NAME_engage(run);
        if (code == CAPS_OK) {
            NAME_close(run);
            code = NAME_engage(run);
        }
        /* what modes have let go may slide, and what they hold does not */
        int held[CAPS_ROWS], resting[CAPS_ROWS], still[CAPS_ROWS] = {0};
        real forces[CAPS_ROWS] = {0};
        NAME_find_held(run, held);
        for (int row = 0; row < CAPS_ROWS; row++) {
            resting[row] = row < CAPS_STOPS && held[row];
        }
        NAME_slide(run, still);
        code = code == CAPS_OK ? NAME_decide(run, resting, still, forces) : code;
        /* velocities and forces have changed, and other conditions may begin */
        if (code != CAPS_OK) {
            return code;
        }
    }
    return CAPS_ENDLESS;
}
