    /* the sum is finite only if every component is */
    const int is_taken = isfinite(sum) && NAME_take(run, &next, growth);
    return is_taken ? CAPS_OK : NAME_step_again(run, t_next);
