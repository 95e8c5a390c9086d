/* Friction at stops: Coulomb's law, of forces while a stop is rested on, and of impulses where it is hit. */

/* An impact, or a rest, that is to be answered. */
struct NAME_hit {
    /* the stops that are closed, and the rows that hold with any impulse */
    const int *closed, *bound;
    /* the frictions that slide in a known direction; the others of closed stops stick, or slide in either */
    const double *directions;
    const struct NAME_bounds *bounds;
    /* the rates before it */
    const real *rates;
};

/* Its impulses or forces, the rows that hold, and the directions in which the frictions of closed stops slide, 0 of what
   sticks. */
struct NAME_struck {
    real impulses[CAPS_ROWS];
    int held[CAPS_ROWS], rubbed[CAPS_ROWS];
    double directions[CAPS_ROWS];
};

/* W x + b of a row, and the sum of the sizes of its terms. */
static double NAME_rate_of(const real *contacts, int row, const real *b, const real *x)
{
    double rate = (double)b[row];
    for (int by = 0; by < CAPS_ROWS; by++) {
        rate = rate + (double)NAME_mobility(contacts, row, by) * (double)x[by];
    }
    return rate;
}

/* W x, by which impulses change the rates of gaps. */
static void NAME_find_changes(const real *contacts, const real *x, real *changes)
{
    for (int row = 0; row < CAPS_ROWS; row++) {
        changes[row] = 0;
        for (int by = 0; by < CAPS_ROWS; by++) {
            changes[row] = changes[row] + NAME_mobility(contacts, row, by) * x[by];
        }
    }
}

/* True of the friction of a closed stop that sticks, or slides in either direction. */
static int NAME_is_open(const struct NAME_hit *hit, int row)
{
    return NAME_is_borne(hit->closed, row) && hit->directions[row] == 0;
}

/* Stops with friction as complementary pairs: x of every stop beside its rate, and for every friction that may stick two
   parts of its x beside its rate and that of the other direction, and its speed beside what its bound leaves of its x. Rows
   are scaled by the root of their own W. */
struct NAME_pairs {
    /* what is bound, stops, and frictions that may stick */
    int rows[CAPS_ROWS], bound, stops, frictions;
    /* W, and b behind it */
    double w[CAPS_ROWS][CAPS_ROWS + 1], scales[CAPS_ROWS];
};

/* Eliminates what is bound. */
static void NAME_eliminate_bound(struct NAME_pairs *it)
{
    const int count = it->bound + it->stops + it->frictions;
    double before[CAPS_ROWS] = {0};
    for (int at = 0; at < count; at++) {
        before[at] = it->w[at][at];
    }
    for (int at = 0; at < it->bound; at++) {
        const double *const above = it->w[at], pivot = above[at];
        for (int row = at + 1; pivot > 1e-10 * before[at] && row < count; row++) {
            const double factor = it->w[row][at] / pivot;
            for (int column = 0; column <= CAPS_ROWS; column++) {
                it->w[row][column] = it->w[row][column] - factor * above[column];
            }
        }
    }
}

static void NAME_find_pairs(
    const real *contacts, const struct NAME_hit *hit, const real *b, struct NAME_pairs *it)
{
    real slides[CAPS_ROWS];
    int count = 0;
    NAME_find_slides(hit->bounds, hit->directions, slides);
    for (int kind = 0; kind < 3; kind++) {
        for (int row = 0; row < CAPS_ROWS; row++) {
            const int is_free = NAME_is_open(hit, row) && NAME_most(hit->bounds, row) > 0;
            if (kind == 0 ? hit->bound[row] : kind == 1 ? hit->closed[row] : is_free) {
                it->rows[count] = row;
                count++;
                it->bound += kind == 0;
                it->stops += kind == 1;
                it->frictions += kind == 2;
            }
            if (kind == 2 && is_free) {
                /* the middle of the bounds goes with the stop */
                slides[NAME_stop_of(row)] = (real)-NAME_middle(hit->bounds, row);
            }
        }
    }
    for (int of = 0; of < count; of++) {
        for (int by = 0; by < count; by++) {
            it->w[of][by] = (double)NAME_slid_mobility(contacts, slides, it->rows[of], it->rows[by]);
        }
        it->w[of][CAPS_ROWS] = (double)b[it->rows[of]];
    }
    NAME_eliminate_bound(it);
    for (int at = 0; at < count; at++) {
        it->scales[at] = it->w[at][at] > 0 ? 1.0 / sqrt(it->w[at][at]) : 1.0;
    }
}

/* The place of the first pair of a row. */
static int NAME_place_of(const struct NAME_pairs *it, int row)
{
    return row < it->stops ? row : it->stops + 3 * (row - it->stops);
}

static void NAME_fill_table(const struct NAME_hit *hit, const struct NAME_pairs *it, struct NAME_table *table)
{
    const int count = it->stops + it->frictions, last = it->stops + 3 * it->frictions + 1;
    NAME_begin_table(table, it->stops + 3 * it->frictions);
    for (int of = 0; of < count; of++) {
        const double *const w = it->w[it->bound + of], scale = it->scales[it->bound + of];
        for (int side = 0; side < (of < it->stops ? 1 : 2); side++) {
            const double sign = side == 0 ? 1.0 : -1.0;
            double *const row = table->rows[NAME_place_of(it, of) + side];
            row[last] = sign * (w[CAPS_ROWS] * scale);
            for (int by = 0; by < count; by++) {
                const double entry = w[it->bound + by] * scale * it->scales[it->bound + by];
                for (int by_side = 0; by_side < (by < it->stops ? 1 : 2); by_side++) {
                    const double by_sign = by_side == 0 ? 1.0 : -1.0;
                    const int column = NAME_place_of(it, by) + by_side;
                    row[column] = row[column] + sign * by_sign * entry;
                }
            }
        }
    }
    for (int friction = 0; friction < it->frictions; friction++) {
        const int at = it->bound + it->stops + friction, row = it->rows[at], stop = NAME_stop_of(row);
        const int forwards = NAME_place_of(it, it->stops + friction), speed = forwards + 2;
        for (int pair = forwards; pair < speed; pair++) {
            table->rows[pair][speed] = table->rows[pair][speed] + 1.0;
            table->rows[speed][pair] = table->rows[speed][pair] - 1.0;
        }
        for (int place = 0; place < it->stops; place++) {
            if (it->rows[it->bound + place] == stop) {
                const double most = NAME_most(hit->bounds, row) * it->scales[it->bound + place] / it->scales[at];
                table->rows[speed][place] = table->rows[speed][place] + most;
            }
        }
    }
}

/* Marks the stops that push, and sets the directions of frictions that may stick; 0 where there is no answer. */
static int NAME_find_states(
    const real *contacts, const struct NAME_hit *hit, const real *b, int *active, double *directions)
{
    struct NAME_pairs it = {{0}, 0, 0, 0, {{0}}, {0}};
    struct NAME_table table;
    NAME_find_pairs(contacts, hit, b, &it);
    NAME_fill_table(hit, &it, &table);
    if (!NAME_find_pivots(&table)) {
        return 0;
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        active[row] = 0;
        directions[row] = hit->directions[row];
    }
    for (int at = 0; at < it.stops; at++) {
        active[it.rows[it.bound + at]] = NAME_is_active(&table, at);
    }
    for (int friction = 0; friction < it.frictions; friction++) {
        const int first = NAME_place_of(&it, it.stops + friction);
        const int forwards = NAME_is_active(&table, first), backwards = NAME_is_active(&table, first + 1);
        /* at its bound the force has the sign that a slide gives it, also where others hold what it does not */
        const int is_forwards = forwards == backwards
            ? NAME_rest_of(&table, first) > NAME_rest_of(&table, first + 1)
            : backwards;
        const int sticks = !NAME_is_active(&table, first + 2) || (forwards && backwards);
        directions[it.rows[it.bound + it.stops + friction]] = sticks ? 0 : is_forwards ? 1.0 : -1.0;
    }
    return 1;
}

/* The impulses by Newton's and Coulomb's laws, with which rates become W x + b >= 0; 0 where there are none. */
static int NAME_meet(const real *contacts, const struct NAME_hit *hit, const real *b, struct NAME_struck *struck)
{
    real slides[CAPS_ROWS];
    int active[CAPS_ROWS] = {0}, set[CAPS_ROWS], is_smooth[CAPS_ROWS], is_rubbed = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        struck->rubbed[row] = NAME_is_borne(hit->closed, row);
        struck->directions[row] = hit->directions[row];
        struck->held[row] = hit->bound[row];
        set[row] = hit->closed[row] || hit->bound[row];
        is_smooth[row] = NAME_is_open(hit, row) && NAME_most(hit->bounds, row) <= 0;
        is_rubbed = is_rubbed || struck->rubbed[row];
    }
    if (!is_rubbed) {
        return NAME_complementary(contacts, set, hit->bound, b, struck->impulses);
    }
    if (!NAME_find_states(contacts, hit, b, active, struck->directions)) {
        return 0;
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        /* what has no friction does not stick */
        struck->directions[row] = is_smooth[row] ? 1.0 : struck->directions[row];
        struck->held[row] = active[row] || hit->bound[row]
            || (NAME_is_borne(active, row) && struck->directions[row] == 0);
    }
    NAME_find_slides(hit->bounds, struck->directions, slides);
    NAME_solve_sliding(contacts, slides, struck->held, b, struck->impulses);
    for (int row = 0; row < CAPS_ROWS; row++) {
        if (is_smooth[row]) {
            struck->directions[row] = NAME_rate_of(contacts, row, b, struck->impulses) > 0 ? 1.0 : -1.0;
        }
    }
    return 1;
}

/* The energy that impulses give, beside the sum of the sizes of its terms. */
static double NAME_gain(const real *contacts, const struct NAME_hit *hit, const real *impulses, double *size)
{
    real changes[CAPS_ROWS];
    double gain = 0;
    *size = 0;
    NAME_find_changes(contacts, impulses, changes);
    for (int row = 0; row < CAPS_ROWS; row++) {
        const double x = (double)impulses[row];
        const double before = x * (double)hit->rates[row], half = 0.5 * x * (double)changes[row];
        gain = gain + before + half;
        *size = *size + fabs(before) + fabs(half);
    }
    return gain;
}

/* Leads impulses that give energy to those of a stop without restitution, as far as they do not. */
static void NAME_lead_back(
    const real *contacts, const struct NAME_hit *hit, const struct NAME_struck *from, struct NAME_struck *to)
{
    real way[CAPS_ROWS], change[CAPS_ROWS], of_way[CAPS_ROWS];
    double linear = 0, square = 0, size = 0, part = 0;
    for (int row = 0; row < CAPS_ROWS; row++) {
        way[row] = to->impulses[row] - from->impulses[row];
    }
    NAME_find_changes(contacts, from->impulses, change);
    NAME_find_changes(contacts, way, of_way);
    for (int row = 0; row < CAPS_ROWS; row++) {
        linear = linear + (double)way[row] * ((double)hit->rates[row] + (double)change[row]);
        square = square + 0.5 * (double)way[row] * (double)of_way[row];
    }
    /* c + b s + a s^2 = 0 with c <= 0 */
    const double gain = NAME_gain(contacts, hit, from->impulses, &size), at_first = gain < 0 ? gain : 0;
    const double root = sqrt(linear * linear - 4.0 * square * at_first);
    if (!(linear >= 0)) {
        part = (root - linear) / (2.0 * square);
    } else if (linear + root > 0) {
        part = -2.0 * at_first / (linear + root);
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        to->impulses[row] = from->impulses[row] + (real)part * way[row];
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        const double rate = NAME_rate_of(contacts, row, hit->rates, to->impulses);
        const int sticks = from->directions[row] == 0 && to->directions[row] == 0;
        to->directions[row] = sticks || rate == 0 ? 0 : rate > 0 ? 1.0 : -1.0;
    }
}

/* The impulses with which rates become W x + b >= 0, b beside the rates what is thrown back; 0 where there are none. */
static int NAME_answer_hit(
    const real *contacts, const struct NAME_hit *hit, const real *b, struct NAME_struck *struck)
{
    struct NAME_struck stopped;
    double size = 0;
    int is_rubbed = 0, is_thrown = 0;
    /* what friction jams throws nothing back */
    if (!NAME_meet(contacts, hit, b, struck) && !NAME_meet(contacts, hit, hit->rates, struck)) {
        return 0;
    }
    for (int row = 0; row < CAPS_ROWS; row++) {
        is_rubbed = is_rubbed || struck->rubbed[row];
        is_thrown = is_thrown || (hit->closed[row] && b[row] != hit->rates[row]);
    }
    if (!is_rubbed || !is_thrown) {
        return 1;
    }
    const double gain = NAME_gain(contacts, hit, struck->impulses, &size);
    if (gain <= NAME_rounding(1e-12) * size) {
        return 1;
    }
    if (!NAME_meet(contacts, hit, hit->rates, &stopped)) {
        return 0;
    }
    NAME_lead_back(contacts, hit, &stopped, struck);
    return 1;
}

