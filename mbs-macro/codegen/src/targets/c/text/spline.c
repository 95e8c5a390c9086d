/* c0 + c1 u + c2 u^2 + c3 u^3, where u counts from a distance from the first point on. */
struct NAME_segment {
    double from, coefficients[4];
};

/* A function that is cubic from point to point. The argument of the first point is its origin,
   the period of one that is not periodic 0. */
struct NAME_spline {
    double origin, period;
    int count;
    const struct NAME_segment *segments;
};

