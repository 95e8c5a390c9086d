/* Stops: responses to unit impulses along their gaps. */

/* The change of the rate of one gap by a unit impulse at a stop. */
static real NAME_mobility(const real *contacts, int of, int by)
{
    return contacts[CAPS_STOPS * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS + by) + of];
}

/* x of a set of stops with W x + b = 0 there, by elimination; 0 of one that depends on others of the set. */
static void NAME_solve_at_stops(const real *contacts, const int *set, const real *b, real *x)
{
    real rows[CAPS_STOPS][CAPS_STOPS + 1] = {{0}};
    double diagonal[CAPS_STOPS];
    int members[CAPS_STOPS], is_pivot[CAPS_STOPS], count = 0;
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        x[stop] = 0;
        if (set[stop]) {
            members[count] = stop;
            count++;
        }
    }
    for (int row = 0; row < count; row++) {
        for (int column = 0; column < count; column++) {
            rows[row][column] = NAME_mobility(contacts, members[row], members[column]);
        }
        rows[row][CAPS_STOPS] = -b[members[row]];
        diagonal[row] = (double)rows[row][row];
    }
    for (int at = 0; at < count; at++) {
        const real pivot = rows[at][at];
        is_pivot[at] = (double)pivot > 1e-10 * diagonal[at];
        for (int row = 0; is_pivot[at] && row < count; row++) {
            const real factor = rows[row][at] / pivot;
            for (int column = 0; row != at && column <= CAPS_STOPS; column++) {
                rows[row][column] = rows[row][column] - factor * rows[at][column];
            }
        }
    }
    for (int at = 0; at < count; at++) {
        x[members[at]] = is_pivot[at] ? rows[at][CAPS_STOPS] / rows[at][at] : 0;
    }
}

/* The first stop of a set that is pulled, or that is left free and closes; -1 where there is none. */
static int NAME_least_wrong(const real *contacts, const int *set, const int *active, const real *b, const real *x)
{
    double largest = 0;
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const double size = fabs((double)x[stop]);
        largest = size > largest ? size : largest;
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        double rate = (double)b[stop], size = fabs(rate);
        if (!set[stop]) {
            continue;
        }
        if (active[stop] && (double)x[stop] < -1e-12 * largest) {
            return stop;
        }
        for (int by = 0; by < CAPS_STOPS; by++) {
            const double term = (double)NAME_mobility(contacts, stop, by) * (double)x[by];
            rate = rate + term;
            size = size + fabs(term);
        }
        if (rate < -1e-12 * size) {
            return stop;
        }
    }
    return -1;
}

/* The first active stop whose impulse becomes 0 where that of one grows that depends on them; -1 where there is none. */
static int NAME_exchanged(const real *contacts, const int *active, int by, const real *x)
{
    real column[CAPS_STOPS], shares[CAPS_STOPS];
    int others[CAPS_STOPS], first = -1;
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        column[stop] = -NAME_mobility(contacts, stop, by);
        others[stop] = active[stop] && stop != by;
    }
    NAME_solve_at_stops(contacts, others, column, shares);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        if ((double)shares[stop] > 1e-10
            && (first < 0
                || (double)x[stop] / (double)shares[stop] < (double)x[first] / (double)shares[first])) {
            first = stop;
        }
    }
    return first;
}

/* x >= 0 with W x + b >= 0 at the stops of a set, one or the other 0 at each, by pivots of the least index; 0 where there
   is none. */
static int NAME_complementary(const real *contacts, const int *set, const real *b, real *x)
{
    int active[CAPS_STOPS] = {0};
    for (int pivots = 0; pivots < 512; pivots++) {
        NAME_solve_at_stops(contacts, active, b, x);
        int wrong = NAME_least_wrong(contacts, set, active, b, x);
        if (wrong < 0) {
            return 1;
        }
        /* an active one that closes all the same depends on others: it takes the place of one of them */
        if (active[wrong] && x[wrong] == 0) {
            wrong = NAME_exchanged(contacts, active, wrong, x);
        }
        if (wrong < 0) {
            return 0;
        }
        active[wrong] = !active[wrong];
    }
    return 0;
}

/* Adds what impulses or forces at stops do to velocities, accelerations or multipliers. */
static void NAME_add_responses(const real *contacts, const real *x, int from, int count, real *to)
{
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        if (x[stop] != 0) {
            NAME_add(to, x[stop], contacts + stop * (2 * CAPS_COORDINATES + CAPS_CONSTRAINTS) + from, count);
        }
    }
}

/* Marks the stops that are rested on; true if there is one. */
static int NAME_find_held(const struct NAME_run *run, int *held)
{
    int is_held = 0;
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        held[stop] = NAME_elements(&run->inputs)[NAME_stop_places[stop]] > (real)0.5;
        is_held = is_held || held[stop];
    }
    return is_held;
}

/* Adds what the stops do that are rested on; the growth of the responses. */
static real NAME_press(const struct NAME_run *run, struct NAME_reactions *reactions)
{
    const struct NAME_state *const at = &run->state;
    real gaps[3 * CAPS_STOPS] = {0}, contacts[CAPS_CONTACTS] = {0}, b[CAPS_STOPS], forces[CAPS_STOPS];
    int held[CAPS_STOPS];
    if (!NAME_find_held(run, held)) {
        return 0;
    }
    NAME_compute_gaps(run->mechanism, at->t, &at->q, &at->v, reactions, gaps);
    NAME_compute_contacts(run->mechanism, at->t, &at->q, contacts);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        b[stop] = gaps[3 * stop + 2];
    }
    NAME_solve_at_stops(contacts, held, b, forces);
    NAME_add_responses(contacts, forces, 0, CAPS_COORDINATES, NAME_places(&reactions->acceleration));
    NAME_add_responses(
        contacts, forces, CAPS_COORDINATES, CAPS_CONSTRAINTS, NAME_places(&reactions->multipliers));
    return contacts[CAPS_CONTACTS - 1];
}

