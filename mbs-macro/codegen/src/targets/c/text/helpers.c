static inline real NAME_sin(real x)
{
    real sine, cosine;
    NAME_sin_cos(x, &sine, &cosine);
    return sine;
}

static inline real NAME_cos(real x)
{
    real sine, cosine;
    NAME_sin_cos(x, &sine, &cosine);
    return cosine;
}

/* -1, 0 or 1; what is not a number stays so. */
static inline real NAME_sign(real x)
{
    return x > 0 ? (real)1 : x < 0 ? (real)-1 : x;
}

/* The smaller of two; not a number if either is not. */
static inline real NAME_min(real a, real b)
{
    return a < b || a != a ? a : b;
}

/* The larger of two; not a number if either is not. */
static inline real NAME_max(real a, real b)
{
    return a > b || a != a ? a : b;
}

/* 1 if a > b, else 0. */
static inline real NAME_greater(real a, real b)
{
    return a > b ? (real)1 : (real)0;
}

/* b where a, which is 0 or 1, is 1; else 0, even if b is not a number. */
static inline real NAME_gate(real a, real b)
{
    return a == 0 ? (real)0 : b;
}

/* The derivative of this order of a spline, the function itself for 0. */
static real NAME_interpolate(const struct NAME_spline *spline, int order, real x)
{
    const double offset = (double)x - spline->origin;
    const double period = spline->period;
    const double distance = period > 0 ? offset - floor(offset / period) * period : offset;
    int first = 0, last = spline->count - 1;
    while (first < last) {
        const int middle = (first + last + 1) / 2;
        if (spline->segments[middle].from <= distance) {
            first = middle;
        } else {
            last = middle - 1;
        }
    }
    const struct NAME_segment *const segment = &spline->segments[first];
    /* x - x is 0, or not a number */
    const real u = (real)(distance - segment->from) + (x - x);
    const real c0 = (real)segment->coefficients[0], c1 = (real)segment->coefficients[1];
    const real c2 = (real)segment->coefficients[2], c3 = (real)segment->coefficients[3];
    const real two = 2, three = 3;
    switch (order) {
    case 0: return c0 + u * (c1 + u * (c2 + u * c3));
    case 1: return c1 + u * (two * c2 + u * (three * c3));
    case 2: return two * c2 + u * (two * three * c3);
    default: return two * three * c3;
    }
}
