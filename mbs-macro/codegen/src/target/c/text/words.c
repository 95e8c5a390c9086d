const char *NAME_words(int code)
{
    if (code < 0) {
        return "no such code";
    }
    if (code < CAPS_BAD_PARAMETER) {
        return NAME_error_words[code];
    }
    if (code < CAPS_BAD_CONDITION) {
        return "a parameter is not finite";
    }
    if (code < CAPS_BAD_CONDITION + CAPS_CONDITIONS) {
        return NAME_condition_words[code - CAPS_BAD_CONDITION];
    }
    return "no such code";
}
