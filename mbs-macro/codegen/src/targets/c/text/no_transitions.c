static void NAME_look(struct NAME_run *run)
{
    (void)run;
}

static int NAME_pass(struct NAME_run *run, int *passes)
{
    (void)run;
    *passes = 0;
    return CAPS_OK;
}

