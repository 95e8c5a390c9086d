int NAME_step(struct NAME_run *run)
{
    const real t_next = run->start_time + (real)(run->steps + 1) * run->step;
    return STEP;
}

/* What a run gives. */

int NAME_reactions(struct NAME_run *run, struct NAME_reactions *reactions)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_constraints no_feedback = {0};
    struct NAME_coordinates *const acceleration = &reactions->acceleration;
    reactions->growth = NAME_compute_reactions(
        run->mechanism, at->t, &at->q, &at->v, &run->inputs, &no_feedback, acceleration,
        &reactions->multipliers);
    reactions->growth = reactions->growth + NAME_press(run, reactions);
    const int row = NAME_first_non_finite(NAME_elements(&reactions->multipliers), CAPS_CONSTRAINTS);
    const int is_good = reactions->growth < NAME_growth_limit
        && NAME_is_finite(acceleration);
    if (is_good && row < 0) {
        return CAPS_OK;
    }
    if (NAME_check_state(run, at) == CAPS_BAD_INPUT) {
        return CAPS_BAD_INPUT;
    }
    if (is_good) {
        run->where = row;
        return CAPS_UNDEFINED_MULTIPLIER;
    }
    return NAME_cause_of(run, at->t, &at->q, acceleration, reactions->growth, NAME_growth_limit);
}

int NAME_step_with_reactions(struct NAME_run *run, struct NAME_reactions *reactions)
{
    const int code = NAME_reactions(run, reactions);
    return code == CAPS_OK ? NAME_step(run) : code;
}

static void NAME_find_outputs(
    struct NAME_run *run, const struct NAME_reactions *reactions, struct NAME_outputs *outputs)
{
    const struct NAME_state *const at = &run->state;
    const struct NAME_inputs inputs = run->inputs;
    /* with the forces with which frictions stick here */
    NAME_hold(run);
    NAME_compute_outputs(run->mechanism, at->t, &at->q, &at->v, &run->inputs, reactions, outputs);
    run->inputs = inputs;
}

int NAME_outputs(struct NAME_run *run, struct NAME_outputs *outputs)
{
    struct NAME_reactions reactions = {0};
    const int code = NAME_reactions(run, &reactions);
    if (code != CAPS_OK) {
        return code;
    }
    NAME_find_outputs(run, &reactions, outputs);
    run->where = NAME_first_non_finite(NAME_elements(outputs), CAPS_OUTPUTS);
    return run->where < 0 ? CAPS_OK : CAPS_UNDEFINED_OUTPUT;
}

NAME_real NAME_energy(const struct NAME_run *run)
{
    const struct NAME_state *const at = &run->state;
    return NAME_compute_kinetic_energy(run->mechanism, at->t, &at->q, &at->v)
        + NAME_compute_potential_energy(run->mechanism, at->t, &at->q, &at->v);
}

NAME_real NAME_violation(const struct NAME_run *run)
{
    struct NAME_constraints phi = {0};
    NAME_compute_phi(run->mechanism, run->state.t, &run->state.q, &phi);
    return NAME_norm(&phi);
}

NAME_real NAME_velocity_violation(const struct NAME_run *run)
{
    struct NAME_constraints phi_dot = {0};
    NAME_compute_phi_dot(run->mechanism, run->state.t, &run->state.q, &run->state.v, &phi_dot);
    return NAME_norm(&phi_dot);
}

const char *NAME_where(const struct NAME_run *run, int code)
{
    if (run->where < 0) {
        return "";
    }
    switch (code) {
    case CAPS_SINGULAR: return NAME_pivot_names[run->where];
    case CAPS_SINGULAR_START: return NAME_start_pivot_names[run->where];
    case CAPS_NOT_FINITE: return NAME_coordinate_names[run->where];
    case CAPS_NOT_ASSEMBLED:
    case CAPS_INCONSISTENT:
    case CAPS_OUT_OF_REACH:
    case CAPS_UNDEFINED_MULTIPLIER: return NAME_constraint_names[run->where];
    case CAPS_UNDEFINED_OUTPUT: return NAME_output_names[run->where];
    case CAPS_BEHIND:
    case CAPS_IMPACT:
    case CAPS_JAMMED:
    case CAPS_APART:
    case CAPS_CONTRADICTION:
    case CAPS_BAD_INPUT: return NAME_input_names[run->where];
    default: return "";
    }
}
