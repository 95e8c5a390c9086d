/* The coordinates that are integrated, in a stage of a step. */
struct NAME_stage {
    real t;
    struct NAME_states q;
    struct NAME_states v;
};

static void NAME_select(const struct NAME_state *all, struct NAME_stage *at)
{
    at->t = all->t;
    for (int j = 0; j < CAPS_STATES; j++) {
        NAME_places(&at->q)[j] = NAME_elements(&all->q)[NAME_state_places[j]];
        NAME_places(&at->v)[j] = NAME_elements(&all->v)[NAME_state_places[j]];
    }
}

/* The others follow from the constraints. */
static inline void NAME_complete(
    const struct NAME *m, const struct NAME_stage *at, struct NAME_state *all)
{
    all->t = at->t;
    NAME_compute_complete(m, at->t, &at->q, &at->v, &all->q, &all->v);
}

/* With 0 for the others. */
static void NAME_spread(const struct NAME_states *states, struct NAME_coordinates *all)
{
    const struct NAME_coordinates none = {0};
    *all = none;
    for (int j = 0; j < CAPS_STATES; j++) {
        NAME_places(all)[NAME_state_places[j]] = NAME_elements(states)[j];
    }
}

