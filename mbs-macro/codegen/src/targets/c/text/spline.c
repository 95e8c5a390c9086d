/* c0 + c1 u + c2 u^2 + c3 u^3, where u counts from a distance from the first point on. */
struct NAME_segment {
    double from, coefficients[4];
};

/* A periodic function, cubic from point to point; the argument of the first point is its
   origin. */
struct NAME_spline {
    double origin, period;
    int count;
    const struct NAME_segment *segments;
};

