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
SMOOTH     real laws[2 * CAPS_STOPS + 1] = {0};
RUBS     real laws[2 * CAPS_STOPS + CAPS_RUBBING] = {0};
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

/* Half of what the forces of rest do in a step, before it; what pushes, with these halves. */
static int NAME_push(struct NAME_run *run, int *pushed, real *halves)
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
        halves[row] = half * forces[row];
    }
    NAME_add_responses(contacts, halves, 0, CAPS_COORDINATES, NAME_places(&at->v));
    return CAPS_OK;
}

/* A step that ends at stops: the rates of gaps at its start and its end, and the impulses that answer them. */
struct NAME_answer {
    /* the stops that push before the step, and half of the impulses of all rests */
    const int *pushed;
    const real *halves;
    real before[CAPS_ROWS], now[CAPS_ROWS], gap_now[CAPS_ROWS];
    /* the part of the step behind the closing of a gap, and what an impulse moves positions by */
    real rest[CAPS_ROWS], shift[CAPS_ROWS];
    int closed[CAPS_ROWS], rested[CAPS_ROWS], held[CAPS_ROWS], locked[CAPS_ROWS], is_impact;
    /* how far gaps may be behind their stops where modes lead them, and up to which they are closed */
    double allowed[CAPS_ROWS], nearest[CAPS_ROWS];
    /* the rates that are rounding of velocities, and those below which gaps do not move */
    double slowest[CAPS_ROWS], still[CAPS_ROWS];
    /* how the rates change in a step without the forces of stops */
    real pressing[CAPS_ROWS];
    real impulses[CAPS_ROWS], moved[CAPS_ROWS], gaps[CAPS_ROWS];
RUBS     /* the directions in which frictions slid at its start, and in which they slide then */
RUBS     double slid[CAPS_ROWS], directions[CAPS_ROWS];
RUBS     struct NAME_bounds bounds;
};
RUBS
RUBS /* Sets the bounds of the frictions that turn around within the step: half of the impulse of the direction in which they slid
RUBS    acted before it. */
RUBS static void NAME_turn_bounds(
RUBS     const real *contacts, const real *rates, const int *closing, const real *wanted, const struct NAME_answer *it,
RUBS     struct NAME_bounds *bounds)
RUBS {
RUBS     const struct NAME_hit on = {closing, it->locked, it->slid, &it->bounds, rates};
RUBS     struct NAME_struck struck;
RUBS     real changes[CAPS_ROWS];
RUBS     int moves[CAPS_ROWS], is_moving = 0;
RUBS     for (int row = 0; row < CAPS_ROWS; row++) {
RUBS         const int stop = NAME_stop_of(row);
RUBS         moves[row] = stop >= 0 && it->pushed[stop] && closing[stop] && it->slid[row] != 0;
RUBS         is_moving = is_moving || moves[row];
RUBS     }
RUBS     if (!is_moving || !NAME_meet(contacts, &on, wanted, &struck)) {
RUBS         return;
RUBS     }
RUBS     NAME_find_changes(contacts, struck.impulses, changes);
RUBS     for (int row = 0; row < CAPS_ROWS; row++) {
RUBS         const real from = it->before[row], to = rates[row] + changes[row];
RUBS         if (moves[row] && it->slid[row] * (double)from > 0 && it->slid[row] * (double)to < 0) {
RUBS             real *const size = it->slid[row] > 0 ? &bounds->backwards[row] : &bounds->forwards[row];
RUBS             *size = *size * (3 - 4 * (from / (from - to)));
RUBS         }
RUBS     }
RUBS }
RUBS
RUBS /* Keeps the directions of what moves by more than the rounding of impulses: what does not is open to stick. */
RUBS static void NAME_keep_moving(const real *contacts, const real *rates, struct NAME_answer *it)
RUBS {
RUBS     double roots[CAPS_ROWS], size = 0;
RUBS     for (int row = 0; row < CAPS_ROWS; row++) {
RUBS         const double own = (double)NAME_mobility(contacts, row, row);
RUBS         roots[row] = sqrt(own > 0 ? own : 0);
RUBS         size = size + roots[row] * fabs((double)it->impulses[row]);
RUBS     }
RUBS     for (int row = 0; row < CAPS_ROWS; row++) {
RUBS         const int moves = fabs((double)rates[row]) > NAME_rounding(1e-12) * roots[row] * size;
RUBS         it->directions[row] = moves ? it->directions[row] : 0;
RUBS     }
RUBS }

/* An impact at the gaps that are closing, with these rates; 0 where no impulses answer it. */
static int NAME_hit(
    const struct NAME_run *run, const real *contacts, const real *rates, const int *closing, const int *hit, int turn,
    struct NAME_answer *it)
{
    real change[CAPS_ROWS] = {0}, taken[CAPS_ROWS] = {0}, approach[CAPS_ROWS] = {0}, thrown[CAPS_ROWS] = {0}, wanted[CAPS_ROWS] = {0};
    real more[CAPS_ROWS] = {0}, second[CAPS_ROWS];
    int set[CAPS_ROWS];
RUBS     const double none[CAPS_ROWS] = {0};
RUBS     struct NAME_bounds bounds = it->bounds;
RUBS     const struct NAME_hit at = {closing, it->locked, none, &bounds, rates};
RUBS     struct NAME_struck struck;
    for (int row = 0; row < CAPS_ROWS; row++) {
        change[row] = it->now[row] - it->before[row];
        second[row] = it->now[row];
        wanted[row] = rates[row];
        set[row] = closing[row] || it->locked[row];
    }
    NAME_change_rates(contacts, it->halves, second);
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        /* of a rest what its second half leaves */
        const real first = it->pushed[stop] ? second[stop] : it->now[stop] - it->rest[stop] * change[stop];
        approach[stop] = turn == 0 ? first : rates[stop];
    }
    if (!NAME_hold_back(contacts, it->closed, it->locked, it->pressing, taken)
        && !NAME_hold_back(contacts, it->closed, it->locked, change, taken)) {
        if (!NAME_is_any(it->locked)) {
            return 0;
        }
        for (int row = 0; row < CAPS_ROWS; row++) {
            taken[row] = 0;
        }
    }
    NAME_rebound(run, approach, thrown);
    /* one stop may bear what several could: by what presses without any, too */
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        taken[stop] = -it->pressing[stop] > taken[stop] ? -it->pressing[stop] : taken[stop];
    }
    for (int stop = 0; stop < CAPS_STOPS; stop++) {
        const real later = turn == 0 ? it->rest[stop] * change[stop] : 0;
        const double least = (double)taken[stop] + it->still[stop];
        /* what is closed in the last of all impacts is rested on */
        it->held[stop] = it->closed[stop] && (turn == 15 || (double)thrown[stop] <= least);
        /* a force that presses for a step is no impact */
        it->is_impact = it->is_impact || (hit[stop] && -(double)approach[stop] > least);
        const real target = it->held[stop] ? 0 : thrown[stop] + later;
        wanted[stop] = rates[stop] - (target > 0 ? target : 0);
    }
RUBS     /* an impact takes no time: friction that it turns around has no part of the step */
RUBS     if (turn == 0 && !it->is_impact) {
RUBS         NAME_turn_bounds(contacts, rates, closing, wanted, it, &bounds);
RUBS     }
SMOOTH     int is_answered = NAME_complementary(contacts, set, it->locked, wanted, more);
RUBS     int is_answered = NAME_answer_hit(contacts, &at, wanted, &struck);
    if (!is_answered) {
        /* what others keep closed throws nothing back */
        int kept[CAPS_ROWS];
        NAME_find_kept_closed(contacts, set, it->locked, kept);
        for (int row = 0; row < CAPS_ROWS; row++) {
            wanted[row] = kept[row] ? rates[row] : wanted[row];
        }
SMOOTH         is_answered = NAME_complementary(contacts, set, it->locked, wanted, more);
RUBS         is_answered = NAME_answer_hit(contacts, &at, wanted, &struck);
    }
RUBS     for (int row = 0; is_answered && row < CAPS_ROWS; row++) {
RUBS         more[row] = struck.impulses[row];
RUBS         it->directions[row] = struck.rubbed[row] ? struck.directions[row] : it->directions[row];
RUBS     }
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
            it->still[stop] = it->slowest[stop] + NAME_rounding(1e-12) * size;
            it->closed[stop] = it->closed[stop] || (double)it->gaps[stop] <= it->nearest[stop];
            /* what was rested on has a part in the first one, whatever its rate is without the second half of the rest */
            const int takes_part = turn == 15 || (turn == 0 && it->rested[stop]);
            closing[stop] = it->closed[stop] && (takes_part || (double)rates[stop] <= it->still[stop]);
            hit[stop] = closing[stop] && (double)rates[stop] < -it->still[stop];
            is_hit = is_hit || hit[stop];
        }
        if (turn == 16 || !is_hit) {
            for (int stop = 0; stop < CAPS_STOPS; stop++) {
                it->held[stop] = closing[stop] && it->held[stop] && it->impulses[stop] > 0;
            }
RUBS             NAME_keep_moving(contacts, rates, it);
            return 1;
        }
        if (!NAME_hit(run, contacts, rates, closing, hit, turn, it)) {
            return 0;
        }
    }
    return 0;
}

