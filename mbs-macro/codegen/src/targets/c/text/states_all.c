/* All coordinates are integrated. */

static inline void NAME_select(const struct NAME_state *all, struct NAME_state *at)
{
    *at = *all;
}

static inline void NAME_complete(
    const struct NAME *m, const struct NAME_state *at, struct NAME_state *all)
{
    (void)m;
    *all = *at;
}

static void NAME_spread(const struct NAME_coordinates *states, struct NAME_coordinates *all)
{
    *all = *states;
}

