int NAME_start(struct NAME_run *run, const struct NAME *m, double step)
{
    const int code = NAME_start_free(run, m, step);
    NAME_look(run);
    return code;
}

int NAME_start_from(struct NAME_run *run, const struct NAME_state *state)
{
    const int code = NAME_start_from_free(run, state);
    NAME_look(run);
    return code;
}

int NAME_step(struct NAME_run *run)
{
    const struct NAME_run before = *run;
    const int known[CAPS_TRANSITIONS] = {0};
    int passes = 0;
    int code = NAME_step_free(run);
    code = code == CAPS_OK ? NAME_pass(run, known, &passes) : code;
    if (code != CAPS_OK) {
        const int where = run->where;
        *run = before;
        run->where = where;
    }
    return code;
}

