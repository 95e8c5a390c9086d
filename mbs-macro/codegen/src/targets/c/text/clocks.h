/** Clocks. The last CAPS_MEMORIES inputs are memories: the mechanism sets them, at the start and at the end of every
   step that leads to a sample; of each clock, a whole number of steps has to lead from sample to sample. The functions
   below are for programs with clocks of their own: they start and step without samples, and take those of one clock. */
int NAME_start_unsampled(struct NAME_run *run, const struct NAME *m, double step);
int NAME_start_from_unsampled(struct NAME_run *run, const struct NAME_state *state);
int NAME_step_unsampled(struct NAME_run *run);
void NAME_sample(struct NAME_run *run, int clock);

