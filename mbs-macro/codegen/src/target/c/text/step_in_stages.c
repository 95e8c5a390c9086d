int NAME_step(struct NAME_run *run)
{
    return NAME_step_again(run, run->start_time + (real)(run->steps + 1) * run->step);
}
