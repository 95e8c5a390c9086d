/* The mechanism, and what codes mean. */

void NAME_default_parameters(struct NAME_parameters *parameters)
{
    for (int at = 0; at < (CAPS_PARAMETERS > 0 ? CAPS_PARAMETERS : 1); at++) {
        NAME_places(parameters)[at] = NAME_declared[at];
    }
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
    for (int at = 0; at < CAPS_CONDITIONS; at++) {
        const int *const condition = NAME_conditions[at];
        const real value = (real)condition[1] * values[condition[0]];
        if (!(condition[2] ? value > 0 : value >= 0)) {
            return CAPS_BAD_CONDITION + at;
        }
    }
    NAME_compute_hoisted(m, m->hoisted);
    return CAPS_OK;
}

const char *NAME_words(int code)
{
    if (code < 0 || code >= CAPS_BAD_CONDITION + CAPS_CONDITIONS) {
        return "no such code";
    }
    if (code >= CAPS_BAD_CONDITION) {
        return NAME_condition_words[code - CAPS_BAD_CONDITION];
    }
    return code < CAPS_BAD_PARAMETER ? NAME_error_words[code] : "a parameter is not finite";
}

