    const struct NAME *const m = run->mechanism;
    const real t = run->state.t;
    const struct NAME_coordinates *const q = &run->state.q, *const v = &run->state.v;
    struct NAME_coordinates *const q_next = &next->q, *const v_next = &next->v;
    const struct NAME_inputs *const inputs = &run->inputs;
    const struct NAME_gains *const gains = &run->gains;
    const real h = run->step, half_h = (real)0.5 * h;
    next->t = t_next;
