/* An instance. */

/* What an instance may be asked depends on its mode. */
enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    EVENT_MODE = 4,
    CONTINUOUS_TIME = 8,
    STEP_MODE = 16,
    TERMINATED = 32,
    RUNNING = EVENT_MODE | CONTINUOUS_TIME | STEP_MODE,
    ANY = 63
};

/* All that changes, which a saved state is a copy of. */
struct memory {
    int mode;
    /* whether the start belongs to the parameters, the mechanism does, and results belong to the state */
    int is_started, is_tuned, is_solved;
    /* of the importer; that of the mechanism is later by the shift, and begins as it is declared */
    double time, shift;
    struct NAME_parameters parameters;
    struct NAME_inputs inputs;
    struct NAME mechanism;
    struct NAME_run run;
    /* what the importer integrates: positions, then velocities; one more, for there may be none */
    double states[2 * STATE_COUNT + 1];
    /* results */
    struct NAME_reactions reactions;
    struct NAME_coordinates acceleration;
    struct NAME_outputs outputs;
    double events[CAPS_EVENTS + 1];
    /* when the clocks sample next, in the time of the mechanism */
    double samples[CLOCK_COUNT + 1];
};

struct instance {
    struct memory now;
    int is_co_simulation;
    char *name;
    void *environment;
    void (*log_2)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);
    fmi3LogMessageCallback log_3;
};

/* The values of both versions are the same. */
enum status { FINE = fmi3OK, DISCARD = fmi3Discard, WRONG = fmi3Error };

static const char CATEGORY[] = "logStatusError";

/* Tells the importer what is wrong, whether it asked for logs or not. */
static int say(const struct instance *it, int status, const char *format, ...)
{
    char message[512], doubled[2 * sizeof message];
    size_t length = 0;
    va_list values;
    va_start(values, format);
    vsnprintf(message, sizeof message, format, values);
    va_end(values);
    if (it->log_3) {
        it->log_3(it->environment, (fmi3Status)status, CATEGORY, message);
    }
    if (it->log_2) {
        /* the message is a format for that of FMI 2 */
        for (const char *letter = message; *letter; letter++) {
            doubled[length++] = *letter;
            if (*letter == '%') {
                doubled[length++] = '%';
            }
        }
        doubled[length] = 0;
        it->log_2(it->environment, it->name, (fmi2Status)status, CATEGORY, doubled);
    }
    return status;
}

/* Whether a code or a value reference is one of a group, which may be empty. */
static int lies_in(int64_t number, int64_t first, int64_t end)
{
    return number >= first && number < end;
}

/* What a code of the mechanism says, and of what. */
static int say_code(const struct instance *it, int status, int code)
{
    const char *where = NAME_where(&it->now.run, code);
    if (lies_in(code, CAPS_BAD_PARAMETER, CAPS_BAD_CONDITION)) {
        where = NAME_parameter_names[code - CAPS_BAD_PARAMETER];
    }
    if (code >= CAPS_BAD_CONDITION) {
        where = "";
    }
    return say(it, status, "%s%s%s", where, *where ? ": " : "", NAME_words(code));
}

/* Whether a function may be called in the present mode. */
static int may(const struct instance *it, int modes, const char *function)
{
    static const char *const names[] = {
        "before initialization", "in initialization mode", "in event mode", "in continuous-time mode",
        "in step mode", "after termination"};
    if (!it) {
        return 0;
    }
    if (it->now.mode & modes) {
        return 1;
    }
    int at = 0;
    while (at < 5 && !(it->now.mode >> at & 1)) {
        at++;
    }
    say(it, WRONG, "%s cannot be called %s", function, names[at]);
    return 0;
}

/* As it was when it was made. */
static void reset(struct instance *it)
{
    memset(&it->now, 0, sizeof it->now);
    it->now.mode = INSTANTIATED;
    NAME_default_parameters(&it->now.parameters);
    NAME_default_inputs(&it->now.inputs);
}

static void *discarded(struct instance *it)
{
    if (it) {
        free(it->name);
        free(it);
    }
    return NULL;
}

/* A new instance, which has no way to log yet. */
static struct instance *made(const char *name, int is_co_simulation)
{
    const size_t size = strlen(name ? name : "") + 1;
    struct instance *it = calloc(1, sizeof *it);
    if (it) {
        it->name = malloc(size);
    }
    if (!it || !it->name) {
        return discarded(it);
    }
    memcpy(it->name, name ? name : "", size);
    it->is_co_simulation = is_co_simulation;
    reset(it);
    return it;
}

/* Whether the importer read the description of this very mechanism. */
static int is_of(const struct instance *it, const char *token)
{
    if (HAS_STOPS && !it->is_co_simulation) {
        say(it, WRONG, "the impacts of stops are seen by co-simulation alone");
        return 0;
    }
    if (token && strcmp(token, TOKEN) == 0) {
        return 1;
    }
    say(it, WRONG, "the model description belongs to another export than this binary, whose token is %s", TOKEN);
    return 0;
}

