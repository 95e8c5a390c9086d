static void NAME_find_due(struct NAME_run *run, int *due)
{
    real seen[CAPS_TRANSITIONS] = {0};
    NAME_find_seen(run, 0, due, seen);
}

