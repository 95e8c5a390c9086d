/* The frictions of stops, and the bounds of their forces. */

/* The stop that a friction rubs on; -1 of any other row. */
static int NAME_stop_of(int row)
{
    for (int at = 0; at < CAPS_RUBBING; at++) {
        if (NAME_rubbing[at][0] == row) {
            return NAME_rubbing[at][1];
        }
    }
    return -1;
}

/* The friction on a stop; -1 where there is none. */
static int NAME_friction_on(int stop)
{
    for (int at = 0; at < CAPS_RUBBING; at++) {
        if (NAME_rubbing[at][1] == stop) {
            return NAME_rubbing[at][0];
        }
    }
    return -1;
}

/* True of the frictions of those stops that are in a set. */
static int NAME_is_borne(const int *stops, int row)
{
    const int stop = NAME_stop_of(row);
    return stop >= 0 && stops[stop];
}

/* The most that friction has beside x of its stop, by its row: it is from -forwards x, with which it slides forwards, to
   backwards x. Both are mu but where it has turned around within a step. */
struct NAME_bounds {
    real forwards[CAPS_ROWS], backwards[CAPS_ROWS];
};

static void NAME_find_bounds(const struct NAME *m, struct NAME_bounds *bounds)
{
    real laws[2 * CAPS_STOPS + CAPS_RUBBING] = {0};
    NAME_compute_stop_laws(m, laws);
    for (int row = 0; row < CAPS_ROWS; row++) {
        bounds->forwards[row] = 0;
        bounds->backwards[row] = 0;
    }
    for (int at = 0; at < CAPS_RUBBING; at++) {
        bounds->forwards[NAME_rubbing[at][0]] = laws[2 * CAPS_STOPS + at];
        bounds->backwards[NAME_rubbing[at][0]] = laws[2 * CAPS_STOPS + at];
    }
}

/* The middle of the bounds, and half of what is between them. */
static double NAME_middle(const struct NAME_bounds *bounds, int row)
{
    return 0.5 * ((double)bounds->forwards[row] - (double)bounds->backwards[row]);
}

static double NAME_most(const struct NAME_bounds *bounds, int row)
{
    return 0.5 * ((double)bounds->forwards[row] + (double)bounds->backwards[row]);
}

/* The x of frictions that slide in some directions as multiples of those of their stops. */
static void NAME_find_slides(const struct NAME_bounds *bounds, const double *directions, real *slides)
{
    for (int row = 0; row < CAPS_ROWS; row++) {
        slides[row] = 0;
    }
    for (int at = 0; at < CAPS_RUBBING; at++) {
        const int row = NAME_rubbing[at][0], stop = NAME_rubbing[at][1];
        slides[stop] =
            directions[row] > 0 ? -bounds->forwards[row] : directions[row] < 0 ? bounds->backwards[row] : 0;
    }
}

/* The same in the directions that a run remembers. */
static void NAME_find_sliding(const struct NAME_run *run, real *slides)
{
    struct NAME_bounds bounds;
    double directions[CAPS_ROWS] = {0};
    NAME_find_bounds(run->mechanism, &bounds);
    for (int at = 0; at < CAPS_RUBBING; at++) {
        const int row = NAME_rubbing[at][0];
        directions[row] = (double)NAME_elements(&run->inputs)[NAME_memories[row]];
    }
    NAME_find_slides(&bounds, directions, slides);
}

