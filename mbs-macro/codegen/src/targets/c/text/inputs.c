void NAME_default_inputs(struct NAME_inputs *inputs)
{
    for (int at = 0; at < CAPS_INPUTS; at++) {
        NAME_places(inputs)[at] = NAME_declared_inputs[at];
    }
}

