/* Small functions on vectors. */

static real NAME_norm(const struct NAME_constraints *phi)
{
    const real *const x = NAME_elements(phi);
    real sum = 0;
    for (int at = 0; at < CAPS_CONSTRAINTS; at++) {
        sum = sum + x[at] * x[at];
    }
    return SQRT(sum);
}

/* x + scale y, in the place of x. */
static void NAME_add(real *x, real scale, const real *y, int count)
{
    for (int at = 0; at < count; at++) {
        x[at] = x[at] + scale * y[at];
    }
}

/* Where the largest magnitude stands, or the first that is not finite; -1 where there is none. */
static int NAME_place(const real *x, int count)
{
    int place = -1;
    for (int at = 0; at < count; at++) {
        if (!isfinite(x[at])) {
            return at;
        }
        place = place < 0 || FABS(x[at]) > FABS(x[place]) ? at : place;
    }
    return place;
}

static real NAME_largest(const real *x, int count)
{
    const int place = NAME_place(x, count);
    return place < 0 ? 0 : FABS(x[place]);
}

static int NAME_first_non_finite(const real *x, int count)
{
    const int place = NAME_place(x, count);
    return place < 0 || isfinite(x[place]) ? -1 : place;
}

static int NAME_is_finite(const struct NAME_coordinates *x)
{
    return NAME_first_non_finite(NAME_elements(x), CAPS_COORDINATES) < 0;
}

/* The size of coordinates that rounding is compared with. */
static real NAME_extent(const struct NAME_coordinates *q)
{
    return 1 + NAME_largest(NAME_elements(q), CAPS_LINES);
}

/* Refuses what is not finite: an input, a position or a velocity. */
static int NAME_check_state(struct NAME_run *run, const struct NAME_state *at)
{
    run->where = NAME_first_non_finite(NAME_elements(&run->inputs), CAPS_INPUTS);
    if (run->where >= 0) {
        return CAPS_BAD_INPUT;
    }
    run->where = NAME_first_non_finite(NAME_elements(&at->q), CAPS_COORDINATES);
    if (run->where < 0) {
        run->where = NAME_first_non_finite(NAME_elements(&at->v), CAPS_COORDINATES);
    }
    return run->where < 0 ? CAPS_OK : CAPS_NOT_FINITE;
}

/* Why a solution with pivots of these growths is no good: a position that is not finite, a pivot,
   or, with all pivots healthy, a component that is not finite. */
static int NAME_cause(
    struct NAME_run *run, const struct NAME_coordinates *q, const struct NAME_coordinates *solution,
    real growth, real limit, const real *growths, int pivots)
{
    const int pivot = NAME_place(growths, pivots);
    run->where = NAME_first_non_finite(NAME_elements(q), CAPS_COORDINATES);
    if (run->where < 0 && growth < limit && (pivot < 0 || growths[pivot] < limit)) {
        run->where = NAME_first_non_finite(NAME_elements(solution), CAPS_COORDINATES);
    }
    if (run->where >= 0) {
        return CAPS_NOT_FINITE;
    }
    run->where = pivot >= 0 && !(growths[pivot] < limit / 64) ? pivot : -1;
    return CAPS_SINGULAR;
}

/* The same of accelerations. */
static int NAME_cause_of(
    struct NAME_run *run, real t, const struct NAME_coordinates *q,
    const struct NAME_coordinates *acceleration, real growth, real limit)
{
    real growths[CAPS_PIVOTS + 1] = {0};
    NAME_compute_pivots(run->mechanism, t, q, growths);
    return NAME_cause(run, q, acceleration, growth, limit, growths, CAPS_PIVOTS);
}

/* Redundant constraints take no part in starts and steps: with parameters for which they do not
   fit they would be violated. They may be by a share of the size, to the power of a length. */
static int NAME_meets_redundant(struct NAME_run *run, const struct NAME_state *at, real share, real size)
{
    struct NAME_constraints phi = {0};
    if (CAPS_REDUNDANT > 0) {
        NAME_compute_phi(run->mechanism, at->t, &at->q, &phi);
    }
    for (int k = 0; k < CAPS_REDUNDANT; k++) {
        const int row = NAME_redundant[k];
        real allowed = share;
        for (int power = 0; power < NAME_constraint_length[row]; power++) {
            allowed = allowed * size;
        }
        if (!(FABS(NAME_elements(&phi)[row]) <= allowed)) {
            run->where = row;
            return 0;
        }
    }
    return 1;
}

