/* FMI 3.0. */

#define ASK_3(modes) \
    struct instance *const it = c; \
    if (!may(it, modes, __func__)) { \
        return fmi3Error; \
    }

/* As many values as references: there are no arrays. */
static int fits(const struct instance *it, size_t count, size_t value_count)
{
    return count == value_count || say(it, WRONG, "%lu variables have no %lu values", (unsigned long)count,
        (unsigned long)value_count) == FINE;
}

EXPORT const char *fmi3GetVersion(void)
{
    return "3.0";
}

EXPORT fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    ASK_3(ANY)
    (void)on, (void)count, (void)categories;
    return fmi3OK;
}

static struct instance *made_3(
    fmi3String name, fmi3String token, int is_co_simulation, void *environment, fmi3LogMessageCallback log)
{
    struct instance *const it = made(name, is_co_simulation);
    if (it) {
        it->environment = environment;
        it->log_3 = log;
    }
    return it && is_of(it, token) ? it : discarded(it);
}

EXPORT fmi3Instance fmi3InstantiateModelExchange(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    (void)resources, (void)visible, (void)logging;
    return made_3(name, token, 0, environment, log);
}

EXPORT fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3Boolean has_event_mode, fmi3Boolean may_return_early, const fmi3ValueReference intermediate[], size_t count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3IntermediateUpdateCallback update)
{
    struct instance *const it = made_3(name, token, 1, environment, log);
    (void)resources, (void)visible, (void)logging, (void)may_return_early, (void)intermediate, (void)update;
    if (it && (has_event_mode || count > 0)) {
        say(it, WRONG, "this export has neither an event mode nor intermediate variables in co-simulation");
        return discarded(it);
    }
    return it;
}

EXPORT fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible, fmi3Boolean logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log, fmi3ClockUpdateCallback update,
    fmi3LockPreemptionCallback lock, fmi3UnlockPreemptionCallback unlock)
{
    struct instance *const it = made_3(name, token, 1, environment, log);
    (void)resources, (void)visible, (void)logging, (void)update, (void)lock, (void)unlock;
    if (it) {
        say(it, WRONG, "this export is for model exchange and co-simulation");
    }
    return discarded(it);
}

EXPORT void fmi3FreeInstance(fmi3Instance c)
{
    discarded(c);
}

EXPORT fmi3Status fmi3EnterInitializationMode(
    fmi3Instance c, fmi3Boolean has_tolerance, fmi3Float64 tolerance, fmi3Float64 start_time, fmi3Boolean has_stop,
    fmi3Float64 stop_time)
{
    ASK_3(INSTANTIATED)
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop_time;
    return (fmi3Status)enter_initialization(it, start_time);
}

EXPORT fmi3Status fmi3ExitInitializationMode(fmi3Instance c)
{
    ASK_3(INITIALIZATION)
    return (fmi3Status)exit_initialization(it);
}

EXPORT fmi3Status fmi3EnterEventMode(fmi3Instance c)
{
    ASK_3(CONTINUOUS_TIME | EVENT_MODE)
    it->now.mode = EVENT_MODE;
    return fmi3OK;
}

EXPORT fmi3Status fmi3Terminate(fmi3Instance c)
{
    ASK_3(RUNNING)
    it->now.mode = TERMINATED;
    return fmi3OK;
}

EXPORT fmi3Status fmi3Reset(fmi3Instance c)
{
    ASK_3(ANY)
    reset(it);
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetFloat64(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 values[], size_t value_count)
{
    ASK_3(ANY)
    return fits(it, count, value_count) ? (fmi3Status)get(it, vr, count, values) : fmi3Error;
}

EXPORT fmi3Status fmi3SetFloat64(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Float64 values[], size_t value_count)
{
    ASK_3(ANY & ~TERMINATED)
    return fits(it, count, value_count) ? (fmi3Status)set(it, vr, count, values) : fmi3Error;
}

EXPORT fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *state)
{
    ASK_3(ANY)
    return (fmi3Status)save(it, state);
}

EXPORT fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state)
{
    ASK_3(ANY)
    return (fmi3Status)restore(it, state);
}

EXPORT fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *state)
{
    ASK_3(ANY)
    return (fmi3Status)forget(state);
}

EXPORT fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t *size)
{
    ASK_3(ANY)
    (void)state;
    *size = sizeof(struct saved);
    return fmi3OK;
}

EXPORT fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size)
{
    ASK_3(ANY)
    return (fmi3Status)write_bytes(it, state, bytes, size);
}

EXPORT fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState *state)
{
    ASK_3(ANY)
    return (fmi3Status)read_bytes(it, bytes, size, state);
}

EXPORT fmi3Status fmi3GetDirectionalDerivative(
    fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[],
    size_t known_count, const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[],
    size_t sensitivity_count)
{
    ASK_3(INITIALIZATION | RUNNING)
    if (!fits(it, known_count, seed_count) || !fits(it, unknown_count, sensitivity_count)) {
        return fmi3Error;
    }
    return (fmi3Status)forward(it, unknowns, unknown_count, knowns, known_count, seed, sensitivity);
}

EXPORT fmi3Status fmi3GetAdjointDerivative(
    fmi3Instance c, const fmi3ValueReference unknowns[], size_t unknown_count, const fmi3ValueReference knowns[],
    size_t known_count, const fmi3Float64 seed[], size_t seed_count, fmi3Float64 sensitivity[],
    size_t sensitivity_count)
{
    ASK_3(INITIALIZATION | RUNNING)
    if (!fits(it, unknown_count, seed_count) || !fits(it, known_count, sensitivity_count)) {
        return fmi3Error;
    }
    return (fmi3Status)adjoint(it, unknowns, unknown_count, knowns, known_count, seed, sensitivity);
}

EXPORT fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c)
{
    ASK_3(INITIALIZATION | EVENT_MODE)
    return fmi3OK;
}

EXPORT fmi3Status fmi3UpdateDiscreteStates(
    fmi3Instance c, fmi3Boolean *needs_update, fmi3Boolean *terminate, fmi3Boolean *nominals_changed,
    fmi3Boolean *states_changed, fmi3Boolean *has_next_event, fmi3Float64 *next_event)
{
    ASK_3(EVENT_MODE)
    *needs_update = *terminate = *nominals_changed = *states_changed = false;
    take_samples(&it->now);
    *has_next_event = isfinite(next_sample(&it->now));
    *next_event = *has_next_event ? next_sample(&it->now) - it->now.shift : 0.0;
    return fmi3OK;
}

EXPORT fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c)
{
    ASK_3(EVENT_MODE)
    it->now.mode = CONTINUOUS_TIME;
    return fmi3OK;
}

EXPORT fmi3Status fmi3CompletedIntegratorStep(
    fmi3Instance c, fmi3Boolean has_no_way_back, fmi3Boolean *enter_event_mode, fmi3Boolean *terminate)
{
    ASK_3(CONTINUOUS_TIME)
    (void)has_no_way_back;
    *enter_event_mode = *terminate = false;
    return fmi3OK;
}

EXPORT fmi3Status fmi3SetTime(fmi3Instance c, fmi3Float64 time)
{
    ASK_3(EVENT_MODE | CONTINUOUS_TIME)
    return (fmi3Status)set_time(it, time);
}

EXPORT fmi3Status fmi3SetContinuousStates(fmi3Instance c, const fmi3Float64 states[], size_t count)
{
    ASK_3(CONTINUOUS_TIME)
    return (fmi3Status)set_states(it, states, count);
}

EXPORT fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, fmi3Float64 derivatives[], size_t count)
{
    ASK_3(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi3Status)get_derivatives(it, derivatives, count);
}

EXPORT fmi3Status fmi3GetEventIndicators(fmi3Instance c, fmi3Float64 indicators[], size_t count)
{
    ASK_3(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi3Status)get_events(it, indicators, count);
}

EXPORT fmi3Status fmi3GetContinuousStates(fmi3Instance c, fmi3Float64 states[], size_t count)
{
    ASK_3(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi3Status)get_states(it, states, count);
}

EXPORT fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, fmi3Float64 nominals[], size_t count)
{
    ASK_3(ANY)
    return (fmi3Status)get_nominals(it, nominals, count);
}

EXPORT fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, size_t *count)
{
    ASK_3(ANY)
    *count = CAPS_EVENTS;
    return fmi3OK;
}

EXPORT fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, size_t *count)
{
    ASK_3(ANY)
    *count = 2 * STATE_COUNT;
    return fmi3OK;
}

EXPORT fmi3Status fmi3DoStep(
    fmi3Instance c, fmi3Float64 point, fmi3Float64 length, fmi3Boolean has_no_way_back, fmi3Boolean *has_event,
    fmi3Boolean *terminate, fmi3Boolean *returns_early, fmi3Float64 *last_successful_time)
{
    ASK_3(STEP_MODE)
    (void)has_no_way_back;
    *has_event = *terminate = *returns_early = false;
    const int status = advance(it, point, length);
    *last_successful_time = it->now.time;
    return (fmi3Status)status;
}

