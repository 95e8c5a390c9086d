}

int NAME_init(struct NAME *m, const struct NAME_parameters *parameters)
{
    real values[CAPS_CONDITION_VALUES + 1] = {0};
    m->parameters = *parameters;
    const int infinite = NAME_first_non_finite(NAME_elements(parameters), CAPS_PARAMETERS);
    if (infinite >= 0) {
        return CAPS_BAD_PARAMETER + infinite;
    }
    NAME_compute_conditions(m, values);
