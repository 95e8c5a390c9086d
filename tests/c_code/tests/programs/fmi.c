/* Functional mock-up units as an importer calls them, and as it should not. Prints the states of both
   versions after some steps, as bits. */

#include "NAME_fmi.c"

#include <inttypes.h>

/* more than any mechanism here has */
enum { MOST_STATES = 512 };

enum { INSTANCES = TURNS, COMMUNICATION_STEPS = 5 };

static int said;

static void say_2(void *environment, const char *name, fmi2Status status, const char *category, const char *text, ...)
{
    (void)environment, (void)name, (void)category;
    said += status == fmi2Error && strlen(text) > 10;
}

static void say_3(void *environment, fmi3Status status, const char *category, const char *text)
{
    (void)environment, (void)category;
    said += status == fmi3Error && strlen(text) > 10;
}

static void expect(int holds, const char *what)
{
    if (!holds) {
        fprintf(stderr, "not so: %s\n", what);
        exit(1);
    }
}
#define EXPECT(condition) expect(condition, #condition)

static const fmi2CallbackFunctions CALLBACKS = {say_2, NULL, NULL, NULL, NULL};

static struct instance *new_2(fmi2Type type)
{
    return fmi2Instantiate("two", type, TOKEN, "", &CALLBACKS, 0, 0);
}

static struct instance *new_3(int is_co_simulation)
{
    return is_co_simulation
        ? fmi3InstantiateCoSimulation("three", TOKEN, "", 0, 0, 0, 0, NULL, 0, NULL, say_3, NULL)
        : fmi3InstantiateModelExchange("three", TOKEN, "", 0, 0, NULL, say_3);
}

static void step_2(struct instance *it, int from, int to)
{
    for (int k = from; k < to; k++) {
        EXPECT(fmi2DoStep(it, k * 4 * STEP, 4 * STEP, 1) == fmi2OK);
    }
}

static void step_3(struct instance *it, int from, int to)
{
    for (int k = from; k < to; k++) {
        bool has_event, ends, is_early;
        double last;
        EXPECT(fmi3DoStep(it, k * 4 * STEP, 4 * STEP, 1, &has_event, &ends, &is_early, &last) == fmi3OK);
        EXPECT(!has_event && !ends && !is_early && last == k * 4 * STEP + 4 * STEP);
    }
}

static void print(struct instance *it)
{
    for (uint32_t at = AT_POSITIONS; at < AT_ACCELERATIONS; at++) {
        double value;
        uint64_t bits;
        EXPECT(fmi3GetFloat64(it, &at, 1, &value, 1) == fmi3OK);
        memcpy(&bits, &value, sizeof bits);
        printf("%016" PRIx64 " ", bits);
    }
    printf("\n");
}

/* A life with a saved state, which another instance goes on from. */
static void live_2(int is_printed)
{
    struct instance *it = new_2(fmi2CoSimulation), *other = new_2(fmi2CoSimulation);
    void *state = NULL, *copy = NULL;
    size_t size = 0;
    EXPECT(fmi2SetupExperiment(it, 0, 0, 0, 0, 0) == fmi2OK && fmi2EnterInitializationMode(it) == fmi2OK);
    EXPECT(fmi2ExitInitializationMode(it) == fmi2OK);
    step_2(it, 0, 2);
    EXPECT(fmi2GetFMUstate(it, &state) == fmi2OK && fmi2SerializedFMUstateSize(it, state, &size) == fmi2OK);
    char *bytes = malloc(size);
    EXPECT(fmi2SerializeFMUstate(it, state, bytes, size) == fmi2OK);
    EXPECT(fmi2DeSerializeFMUstate(other, bytes, size, &copy) == fmi2OK && fmi2SetFMUstate(other, copy) == fmi2OK);
    fmi2FreeFMUstate(it, &state);
    fmi2FreeInstance(it);
    step_2(other, 2, COMMUNICATION_STEPS);
    if (is_printed) {
        print(other);
    }
    EXPECT(fmi2FreeFMUstate(other, &copy) == fmi2OK && !copy && fmi2Reset(other) == fmi2OK);
    free(bytes);
    fmi2FreeInstance(other);
}

static void live_3(int is_printed)
{
    struct instance *it = new_3(1);
    EXPECT(fmi3EnterInitializationMode(it, 0, 0, 0, 0, 0) == fmi3OK && fmi3ExitInitializationMode(it) == fmi3OK);
    step_3(it, 0, COMMUNICATION_STEPS);
    if (is_printed) {
        print(it);
    }
    EXPECT(fmi3Terminate(it) == fmi3OK);
    fmi3FreeInstance(it);
#ifndef CO_SIMULATION_ALONE
    struct instance *const exchange = new_3(0);
    double derivatives[MOST_STATES];
    size_t count;
    EXPECT(fmi3EnterInitializationMode(exchange, 0, 0, 0, 0, 0) == fmi3OK);
    EXPECT(fmi3ExitInitializationMode(exchange) == fmi3OK && fmi3EnterContinuousTimeMode(exchange) == fmi3OK);
    EXPECT(fmi3GetNumberOfContinuousStates(exchange, &count) == fmi3OK && count <= MOST_STATES);
    EXPECT(fmi3GetContinuousStateDerivatives(exchange, derivatives, count) == fmi3OK);
    fmi3FreeInstance(exchange);
#endif
}

/* What is wrong is refused with words, and does not harm. */
static void misuse(void)
{
    struct instance *it = new_3(1);
    const uint32_t first = AT_PARAMETERS, none = AT_END, position = AT_POSITIONS;
    double number = 0.0;
    char bytes[8] = "nothing";
    void *state = NULL;
    bool flag;
    said = 0;
    EXPECT(fmi3GetFloat64(NULL, &first, 1, &number, 1) == fmi3Error);
    EXPECT(fmi3DoStep(it, 0, 1, 1, &flag, &flag, &flag, &number) == fmi3Error && said == 1);
    EXPECT(fmi3GetFloat64(it, &none, 1, &number, 1) == fmi3Error && said == 2);
    EXPECT(fmi3GetFloat64(it, &position, 1, &number, 2) == fmi3Error && said == 3);
    EXPECT(fmi3SetFloat64(it, &position, 1, &number, 1) == fmi3Error && said == 4);
    EXPECT(fmi3DeserializeFMUState(it, (const uint8_t *)bytes, sizeof bytes, &state) == fmi3Error && said == 5);
    EXPECT(fmi3SetFMUState(it, NULL) == fmi3Error && said == 6);
    EXPECT(fmi3GetInt32(it, &first, 1, NULL, 1) == fmi3Error && said == 7);
    EXPECT(fmi3GetInt32(it, NULL, 0, NULL, 0) == fmi3OK && said == 7);
    EXPECT(fmi3EnterInitializationMode(it, 0, 0, (double)NAN, 0, 0) == fmi3Error && said == 8);
    EXPECT(fmi3EnterInitializationMode(it, 0, 0, 0, 0, 0) == fmi3OK && fmi3ExitInitializationMode(it) == fmi3OK);
    EXPECT(fmi3DoStep(it, 0, -1, 1, &flag, &flag, &flag, &number) == fmi3Error && said == 9);
    EXPECT(fmi3DoStep(it, 5, 1, 1, &flag, &flag, &flag, &number) == fmi3Error && said == 10);
    EXPECT(fmi3SetContinuousStates(it, &number, 1) == fmi3Error && said == 11);
    fmi3FreeInstance(it);
    EXPECT(!fmi3InstantiateModelExchange("other", "{another token}", "", 0, 0, NULL, say_3) && said == 12);
    EXPECT(!fmi2Instantiate("other", fmi2CoSimulation, NULL, "", &CALLBACKS, 0, 0) && said == 13);
    EXPECT(!fmi3InstantiateCoSimulation("early", TOKEN, "", 0, 0, 1, 0, NULL, 0, NULL, say_3, NULL) && said == 14);
    fmi3FreeInstance(NULL);
    fmi2FreeInstance(NULL);
}

/* Parameters of which constraints know are fixed once a run has begun. Another one that changes has from there on the
   steps of a mechanism that was made with it, and the state stays. */
static void tune(void)
{
    struct instance *it = new_3(1);
    static struct NAME other;
    EXPECT(fmi3EnterInitializationMode(it, 0, 0, 0, 0, 0) == fmi3OK && fmi3ExitInitializationMode(it) == fmi3OK);
    step_3(it, 0, 2);
    struct NAME_run run = it->now.run;
    struct NAME_parameters parameters = it->now.parameters;
    for (uint32_t at = AT_PARAMETERS; at < AT_INPUTS; at++) {
        double *const parameter = PLACES(parameters) + (at - AT_PARAMETERS);
        const double value = 1.25 * *parameter;
        said = 0;
        const int is_set = fmi3SetFloat64(it, &at, 1, &value, 1) == fmi3OK;
        EXPECT(is_set == IS_TUNABLE[at - AT_PARAMETERS] && said == !is_set);
        *parameter = is_set ? value : *parameter;
    }
    EXPECT(NAME_init(&other, &parameters) == 0);
    run.mechanism = &other;
    for (int k = 0; k < 4 * (COMMUNICATION_STEPS - 2); k++) {
        EXPECT(NAME_step(&run) == 0);
    }
    step_3(it, 2, COMMUNICATION_STEPS);
    EXPECT(memcmp(&it->now.run.state, &run.state, sizeof run.state) == 0);
    fmi3FreeInstance(it);
}

int main(void)
{
    misuse();
    tune();
    for (int k = 0; k < INSTANCES; k++) {
        live_2(k == 0);
        live_3(k == 0);
    }
    return 0;
}
