    const struct NAME *const m = run->mechanism;
    const real t = run->state.t;
    const struct NAME_coordinates *const q = &run->state.q, *const v = &run->state.v;
    const struct NAME_inputs *const inputs = &run->inputs;
    const struct NAME_gains *const gains = &run->gains;
    const real h = run->step, half_h = (real)0.5 * h;
    struct NAME_STAGE next;
    real sum = 0, growth;
    next.t = t_next;
    /* not every program reads all of them */
    (void)m; (void)t; (void)inputs; (void)gains; (void)half_h;
