/* Sets the memories of a clock, or of a transition, which count behind the clocks. */
static void NAME_take_sample(struct NAME_run *run, int of)
{
    const struct NAME_state *const at = &run->state;
    real values[CAPS_SAMPLES] = {0};
    NAME_compute_samples(run->mechanism, at->t, &at->q, &at->v, &run->inputs, values);
    for (int sample = 0; sample < CAPS_SAMPLES; sample++) {
        if (NAME_sample_places[sample][0] == of) {
            NAME_places(&run->inputs)[NAME_sample_places[sample][1]] = values[sample];
        }
    }
}

