/* Contacts: the gaps of stops, behind them the ways of frictions that stick, and behind these the constraints of modes.
   Responses to unit impulses along them. */

/* The change of the rate of one gap by a unit impulse at a stop. */
static real NAME_mobility(const real *contacts, int of, int by)
{
    return contacts[CAPS_ROWS * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS + by) + of];
}

/* What that of its own rate would be without joints; where no mass tells, as it is. */
static double NAME_free_mobility(const real *contacts, int row)
{
    const double free = (double)contacts[CAPS_ROWS * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS + CAPS_ROWS) + row];
    return free > 0 && free <= 1.7976931348623157e308 ? free : (double)NAME_mobility(contacts, row, row);
}

RUBS /* The change of the rate of one gap by a unit impulse at a stop, and by that of what slides on it. */
RUBS static real NAME_slid_mobility(const real *contacts, const real *slides, int of, int by)
RUBS {
RUBS     const real own = NAME_mobility(contacts, of, by);
RUBS     const int row = NAME_friction_on(by);
RUBS     return row >= 0 && slides[by] != 0 ? own + slides[by] * NAME_mobility(contacts, of, row) : own;
RUBS }
RUBS
/* x of a set of stops with W x + b = 0 there, by elimination; 0 of one that depends on others of the set. Constraints of modes
   are the first, in the order of their pivots. A pivot is rounding beside what it was before the others; of modes, which hold
   where joints may hold, too, also beside what W would be without joints. */
SMOOTH static void NAME_solve_at_stops(const real *contacts, const int *set, const real *b, real *x)
RUBS static void NAME_solve_sliding(
RUBS     const real *contacts, const real *slides, const int *set, const real *b, real *x)
{
    real rows[CAPS_ROWS][CAPS_ROWS + 1] = {{0}};
    double diagonal[CAPS_ROWS], free[CAPS_ROWS];
    int members[CAPS_ROWS], is_pivot[CAPS_ROWS] = {0}, is_done[CAPS_ROWS] = {0}, locks = 0, count = 0;
    for (int place = 0; place < CAPS_ROWS; place++) {
        const int is_lock = place < CAPS_ROWS - CAPS_OWN_ROWS;
        const int row = is_lock ? CAPS_OWN_ROWS + place : place - (CAPS_ROWS - CAPS_OWN_ROWS);
        x[row] = 0;
SMOOTH         if (set[row]) {
RUBS         if (set[row] && (NAME_stop_of(row) < 0 || NAME_is_borne(set, row))) {
            members[count] = row;
            count++;
            locks += is_lock;
        }
    }
    for (int row = 0; row < count; row++) {
        for (int column = 0; column < count; column++) {
SMOOTH             rows[row][column] = NAME_mobility(contacts, members[row], members[column]);
RUBS             rows[row][column] = NAME_slid_mobility(contacts, slides, members[row], members[column]);
        }
        rows[row][CAPS_ROWS] = -b[members[row]];
        diagonal[row] = (double)rows[row][row];
        free[row] = NAME_free_mobility(contacts, members[row]);
    }
    for (int turn = 0; turn < count; turn++) {
        int at = -1;
        for (int lock = 0; lock < locks; lock++) {
            if (!is_done[lock]
                && (at < 0 || (double)rows[lock][lock] / free[lock] > (double)rows[at][at] / free[at])) {
                at = lock;
            }
        }
        at = at < 0 ? turn : at;
        const real pivot = rows[at][at];
        const double shared = NAME_rounding(1e-10) * diagonal[at];
        const double least = at < locks ? 64.0 * (double)NAME_epsilon * free[at] : 0;
        is_pivot[at] = (double)pivot > (shared > least ? shared : least);
        is_done[at] = 1;
        for (int row = 0; is_pivot[at] && row < count; row++) {
            const real factor = rows[row][at] / pivot;
            for (int column = 0; row != at && column <= CAPS_ROWS; column++) {
                rows[row][column] = rows[row][column] - factor * rows[at][column];
            }
        }
    }
    for (int at = 0; at < count; at++) {
        x[members[at]] = is_pivot[at] ? rows[at][CAPS_ROWS] / rows[at][at] : 0;
RUBS         if (slides[members[at]] != 0) {
RUBS             x[NAME_friction_on(members[at])] = slides[members[at]] * x[members[at]];
RUBS         }
    }
}
RUBS
RUBS /* The same where nothing slides. */
RUBS static void NAME_solve_at_stops(const real *contacts, const int *set, const real *b, real *x)
RUBS {
RUBS     const real none[CAPS_ROWS] = {0};
RUBS     NAME_solve_sliding(contacts, none, set, b, x);
RUBS }

/* The first stop of a set that is pulled, or that is left free and closes; -1 where there is none. */
static int NAME_least_wrong(const real *contacts, const int *set, const int *active, const real *b, const real *x)
{
    double largest = 0;
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        const double size = fabs((double)x[stop]);
        largest = size > largest ? size : largest;
    }
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        double rate = (double)b[stop], size = fabs(rate);
        if (!set[stop]) {
            continue;
        }
        if (active[stop] && (double)x[stop] < -NAME_rounding(1e-12) * largest) {
            return stop;
        }
        for (int by = 0; by < CAPS_ROWS; by++) {
            const double term = (double)NAME_mobility(contacts, stop, by) * (double)x[by];
            rate = rate + term;
            size = size + fabs(term);
        }
        if (rate < -NAME_rounding(1e-12) * size) {
            return stop;
        }
    }
    return -1;
}

/* The impulses at active stops that do what a unit impulse at another one does, as far as they can. */
static void NAME_shares(const real *contacts, const int *active, int by, real *shares)
{
    real column[CAPS_ROWS];
    int others[CAPS_ROWS];
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        column[stop] = -NAME_mobility(contacts, stop, by);
        others[stop] = active[stop] && stop != by;
    }
    NAME_solve_at_stops(contacts, others, column, shares);
}

/* True if an impulse at a stop does what impulses at the active ones can do. */
static int NAME_depends(const real *contacts, int stop, const int *active)
{
    real shares[CAPS_ROWS];
    const double own = (double)NAME_mobility(contacts, stop, stop);
    double rest = own;
    NAME_shares(contacts, active, stop, shares);
    for (int by = 0; by < CAPS_ROWS; by++) {
        if (active[by]) {
            rest = rest - (double)NAME_mobility(contacts, stop, by) * (double)shares[by];
        }
    }
    return rest <= NAME_rounding(1e-10) * own;
}

/* The first active stop whose impulse becomes 0 where that of one grows that depends on them; -1 where there is none. */
static int NAME_exchanged(const real *contacts, const int *active, int by, const int *bound, const real *x)
{
    real shares[CAPS_ROWS];
    int first = -1;
    NAME_shares(contacts, active, by, shares);
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        if (!bound[stop] && (double)shares[stop] > NAME_rounding(1e-10)
            && (first < 0
                || (double)x[stop] / (double)shares[stop] < (double)x[first] / (double)shares[first])) {
            first = stop;
        }
    }
    return first;
}

/* x >= 0 with W x + b >= 0 at the stops of a set, one or the other 0 at each, by pivots of the least index; W x + b = 0 at
   those that are bound; 0 where there is none. */
static int NAME_complementary(const real *contacts, const int *set, const int *bound, const real *b, real *x)
{
    int active[CAPS_ROWS], open[CAPS_ROWS], is_bound = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        is_bound = is_bound || (bound[row] && set[row]);
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        /* stops press before friction holds, where they depend on each other */
        active[row] = is_bound && set[row];
        open[row] = set[row] && !bound[row];
    }
    for (int pivots = 0; pivots < 512; pivots++) {
        NAME_solve_at_stops(contacts, active, b, x);
        int wrong = NAME_least_wrong(contacts, open, active, b, x);
        if (wrong < 0) {
            return 1;
        }
        /* one that closes with others, or although it is active, depends on them: it takes the place of one of them */
        if (active[wrong] ? x[wrong] == 0 : NAME_depends(contacts, wrong, active)) {
            const int left = NAME_exchanged(contacts, active, wrong, bound, x);
            if (left < 0) {
                return 0;
            }
            active[wrong] = 1;
            wrong = left;
        }
        active[wrong] = !active[wrong];
    }
    return 0;
}

/* Marks the stops of a set that others of it and what is bound keep closed: no impulses open them. */
static void NAME_find_kept_closed(const real *contacts, const int *set, const int *bound, int *kept)
{
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        real opening[CAPS_ROWS] = {0}, x[CAPS_ROWS] = {0};
        opening[stop] = -1;
        kept[stop] = set[stop] && !bound[stop] && !NAME_complementary(contacts, set, bound, opening, x);
    }
}

/* Adds what impulses or forces at stops do to velocities, accelerations or multipliers. */
static void NAME_add_responses(const real *contacts, const real *x, int from, int count, real *to)
{
    for (int stop = 0; stop < CAPS_ROWS; stop++) {
        if (x[stop] != 0) {
            NAME_add(to, x[stop], contacts + stop * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS) + from, count);
        }
    }
}

/* Marks the stops that are rested on, the frictions that stick and the constraints of modes that hold; true if there is
   one. */
static int NAME_find_held(const struct NAME_run *run, int *held)
{
    int is_held = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        const real memory = NAME_elements(&run->inputs)[NAME_memories[row]];
        const int is_friction = row >= CAPS_STOPS && row < CAPS_OWN_ROWS;
        held[row] = is_friction ? fabs((double)memory) < 0.5 : memory > (real)0.5;
RUBS         held[row] = held[row] && (NAME_stop_of(row) < 0 || NAME_is_borne(held, row));
        is_held = is_held || held[row];
    }
    return is_held;
}

/* Adds to accelerations and multipliers what some stops and frictions do that hold; their forces, and the growth. */
static real NAME_press_with(
    const struct NAME_run *run, const int *held, struct NAME_reactions *reactions, real *forces)
{
    const struct NAME_state *const at = &run->state;
SMOOTH     real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, b[CAPS_ROWS];
RUBS     real gaps[3 * CAPS_ROWS] = {0}, contacts[CAPS_CONTACTS] = {0}, b[CAPS_ROWS], slides[CAPS_ROWS];
    NAME_compute_gaps(run->mechanism, at->t, &at->q, &at->v, reactions, gaps);
    NAME_compute_contacts(run->mechanism, at->t, &at->q, contacts);
    for (int row = 0; row < CAPS_ROWS; row++) {
        b[row] = gaps[3 * row + 2];
    }
SMOOTH     NAME_solve_at_stops(contacts, held, b, forces);
RUBS     NAME_find_sliding(run, slides);
RUBS     NAME_solve_sliding(contacts, slides, held, b, forces);
    NAME_add_responses(contacts, forces, 0, CAPS_COORDINATES, NAME_places(&reactions->acceleration));
    NAME_add_responses(
        contacts, forces, CAPS_COORDINATES, CAPS_CONSTRAINTS, NAME_places(&reactions->multipliers));
    return contacts[CAPS_CONTACTS - 1];
}

/* Adds what the stops do that are rested on, and the frictions that stick; the growth of the responses. */
static real NAME_press(const struct NAME_run *run, struct NAME_reactions *reactions)
{
    int held[CAPS_ROWS];
    real forces[CAPS_ROWS];
    return NAME_find_held(run, held) ? NAME_press_with(run, held, reactions, forces) : 0;
}
