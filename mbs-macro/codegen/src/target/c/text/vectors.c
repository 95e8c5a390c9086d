/* Small functions on vectors. */

static int NAME_first_non_finite(const real *x, int count)
{
    for (int at = 0; at < count; at++) {
        if (!isfinite(x[at])) {
            return at;
        }
    }
    return -1;
}

static real NAME_norm(const real *x, int count)
{
    real sum = 0;
    for (int at = 0; at < count; at++) {
        sum = sum + x[at] * x[at];
    }
    return SQRT(sum);
}

/* The largest magnitude, and where it stands; what is not a number is largest. */
static real NAME_largest(const real *x, int count, int *place)
{
    real largest = 0;
    *place = 0;
    for (int at = 0; at < count; at++) {
        const real magnitude = FABS(x[at]);
        if (magnitude > largest || magnitude != magnitude) {
            largest = magnitude;
            *place = at;
        }
        if (magnitude != magnitude) {
            break;
        }
    }
    return largest;
}

/* The largest growth, and where it stands; one that is not finite is largest, and the
   place is -1 where there is none. */
static real NAME_worst(const real *growths, int count, int *place)
{
    real worst = 0;
    *place = -1;
    for (int at = 0; at < count; at++) {
        if (!isfinite(growths[at])) {
            *place = at;
            return growths[at];
        }
        if (*place < 0 || growths[at] > worst) {
            worst = growths[at];
            *place = at;
        }
    }
    return worst;
}

static real NAME_worst_pivot(const struct NAME *m, real t, const struct NAME_coordinates *q, int *place)
{
    real growths[CAPS_PIVOTS + 1] = {0};
    NAME_compute_pivots(m, t, q, growths);
    return NAME_worst(growths, CAPS_PIVOTS, place);
}

static real NAME_worst_start_pivot(const struct NAME *m, real t, const struct NAME_coordinates *q, int *place)
{
    real growths[CAPS_START_PIVOTS + 1] = {0};
    NAME_compute_start_pivots(m, t, q, growths);
    return NAME_worst(growths, CAPS_START_PIVOTS, place);
}

/* What is wrong: an error, and the place that it belongs to. */
struct NAME_cause {
    int code, where;
};

/* Why a solution is no good: a position that is not finite, a pivot, or, with all pivots
   healthy, a component that is not finite. */
static struct NAME_cause NAME_cause_of(
    const struct NAME_coordinates *q, const struct NAME_coordinates *value, real growth, real limit,
    int pivot, real pivot_growth)
{
    struct NAME_cause cause = {CAPS_NOT_FINITE, NAME_first_non_finite(NAME_elements(q), CAPS_COORDINATES)};
    const real worst = pivot < 0 ? growth : pivot_growth;
    if (cause.where < 0 && growth < limit && worst < limit) {
        cause.where = NAME_first_non_finite(NAME_elements(value), CAPS_COORDINATES);
    }
    if (cause.where < 0) {
        cause.code = CAPS_SINGULAR;
        cause.where = pivot >= 0 && !(pivot_growth < limit / 64) ? pivot : -1;
    }
    return cause;
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

