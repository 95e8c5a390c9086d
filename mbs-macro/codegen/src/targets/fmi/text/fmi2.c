/* FMI 2.0. */

/* The instance behind a component, if it may be asked this now. */
#define ASK_2(modes) \
    struct instance *const it = c; \
    if (!may(it, modes, __func__)) { \
        return fmi2Error; \
    }

/* What there is nothing of: it is fine to ask for none. */
#define NONE_2(count, what) \
    ASK_2(ANY) \
    return (count) == 0 ? fmi2OK : (fmi2Status)say(it, WRONG, "%s: there are no " what, __func__);

EXPORT const char *fmi2GetTypesPlatform(void)
{
    return "default";
}

EXPORT const char *fmi2GetVersion(void)
{
    return "2.0";
}

EXPORT fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count, const fmi2String categories[])
{
    ASK_2(ANY)
    (void)on, (void)count, (void)categories;
    return fmi2OK;
}

EXPORT fmi2Component fmi2Instantiate(
    fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources, const fmi2CallbackFunctions *functions,
    fmi2Boolean visible, fmi2Boolean logging)
{
    struct instance *const it = made(name, type == fmi2CoSimulation);
    (void)resources, (void)visible, (void)logging;
    if (it && functions) {
        it->log_2 = functions->logger;
        it->environment = functions->componentEnvironment;
    }
    return it && is_of(it, guid) ? it : discarded(it);
}

EXPORT void fmi2FreeInstance(fmi2Component c)
{
    discarded(c);
}

EXPORT fmi2Status fmi2SetupExperiment(
    fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start_time, fmi2Boolean has_stop,
    fmi2Real stop_time)
{
    ASK_2(INSTANTIATED)
    (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop_time;
    it->now.time = start_time;
    return fmi2OK;
}

EXPORT fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
    ASK_2(INSTANTIATED)
    return (fmi2Status)enter_initialization(it, it->now.time);
}

EXPORT fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
    ASK_2(INITIALIZATION)
    return (fmi2Status)exit_initialization(it);
}

EXPORT fmi2Status fmi2Terminate(fmi2Component c)
{
    ASK_2(RUNNING)
    it->now.mode = TERMINATED;
    return fmi2OK;
}

EXPORT fmi2Status fmi2Reset(fmi2Component c)
{
    ASK_2(ANY)
    reset(it);
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Real values[])
{
    ASK_2(ANY)
    return (fmi2Status)get(it, vr, count, values);
}

EXPORT fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Integer values[])
{
    (void)vr, (void)values;
    NONE_2(count, "integers")
}

EXPORT fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2Boolean values[])
{
    (void)vr, (void)values;
    NONE_2(count, "booleans")
}

EXPORT fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, fmi2String values[])
{
    (void)vr, (void)values;
    NONE_2(count, "strings")
}

EXPORT fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Real values[])
{
    ASK_2(ANY & ~TERMINATED)
    return (fmi2Status)set(it, vr, count, values);
}

EXPORT fmi2Status fmi2SetInteger(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer values[])
{
    (void)vr, (void)values;
    NONE_2(count, "integers")
}

EXPORT fmi2Status fmi2SetBoolean(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Boolean values[])
{
    (void)vr, (void)values;
    NONE_2(count, "booleans")
}

EXPORT fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2String values[])
{
    (void)vr, (void)values;
    NONE_2(count, "strings")
}

EXPORT fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    ASK_2(ANY)
    return (fmi2Status)save(it, state);
}

EXPORT fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state)
{
    ASK_2(ANY)
    return (fmi2Status)restore(it, state);
}

EXPORT fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state)
{
    ASK_2(ANY)
    return (fmi2Status)forget(state);
}

EXPORT fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t *size)
{
    ASK_2(ANY)
    (void)state;
    *size = sizeof(struct saved);
    return fmi2OK;
}

EXPORT fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size)
{
    ASK_2(ANY)
    return (fmi2Status)write_bytes(it, state, bytes, size);
}

EXPORT fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate *state)
{
    ASK_2(ANY)
    return (fmi2Status)read_bytes(it, bytes, size, state);
}

EXPORT fmi2Status fmi2GetDirectionalDerivative(
    fmi2Component c, const fmi2ValueReference unknowns[], size_t unknown_count, const fmi2ValueReference knowns[],
    size_t known_count, const fmi2Real seed[], fmi2Real sensitivity[])
{
    ASK_2(INITIALIZATION | RUNNING)
    return (fmi2Status)forward(it, unknowns, unknown_count, knowns, known_count, seed, sensitivity);
}

EXPORT fmi2Status fmi2EnterEventMode(fmi2Component c)
{
    ASK_2(CONTINUOUS_TIME | EVENT_MODE)
    it->now.mode = EVENT_MODE;
    return fmi2OK;
}

EXPORT fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *info)
{
    static const fmi2EventInfo nothing;
    ASK_2(EVENT_MODE)
    *info = nothing;
    take_samples(&it->now);
    info->nextEventTimeDefined = isfinite(next_sample(&it->now));
    info->nextEventTime = info->nextEventTimeDefined ? next_sample(&it->now) - it->now.shift : 0.0;
    return fmi2OK;
}

EXPORT fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c)
{
    ASK_2(EVENT_MODE)
    it->now.mode = CONTINUOUS_TIME;
    return fmi2OK;
}

EXPORT fmi2Status fmi2CompletedIntegratorStep(
    fmi2Component c, fmi2Boolean has_no_way_back, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate)
{
    ASK_2(CONTINUOUS_TIME)
    (void)has_no_way_back;
    *enter_event_mode = 0;
    *terminate = 0;
    return fmi2OK;
}

EXPORT fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time)
{
    ASK_2(EVENT_MODE | CONTINUOUS_TIME)
    return (fmi2Status)set_time(it, time);
}

EXPORT fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real states[], size_t count)
{
    ASK_2(CONTINUOUS_TIME)
    return (fmi2Status)set_states(it, states, count);
}

EXPORT fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real derivatives[], size_t count)
{
    ASK_2(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi2Status)get_derivatives(it, derivatives, count);
}

EXPORT fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real indicators[], size_t count)
{
    ASK_2(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi2Status)get_events(it, indicators, count);
}

EXPORT fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real states[], size_t count)
{
    ASK_2(INITIALIZATION | EVENT_MODE | CONTINUOUS_TIME)
    return (fmi2Status)get_states(it, states, count);
}

EXPORT fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real nominals[], size_t count)
{
    ASK_2(ANY)
    return (fmi2Status)get_nominals(it, nominals, count);
}

EXPORT fmi2Status fmi2SetRealInputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer orders[], const fmi2Real values[])
{
    (void)vr, (void)orders, (void)values;
    NONE_2(count, "inputs that are interpolated")
}

EXPORT fmi2Status fmi2GetRealOutputDerivatives(
    fmi2Component c, const fmi2ValueReference vr[], size_t count, const fmi2Integer orders[], fmi2Real values[])
{
    (void)vr, (void)orders, (void)values;
    NONE_2(count, "derivatives of outputs")
}

EXPORT fmi2Status fmi2DoStep(fmi2Component c, fmi2Real point, fmi2Real length, fmi2Boolean has_no_way_back)
{
    ASK_2(STEP_MODE)
    (void)has_no_way_back;
    return (fmi2Status)advance(it, point, length);
}

EXPORT fmi2Status fmi2CancelStep(fmi2Component c)
{
    NONE_2(1, "steps in the background")
}

EXPORT fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind, (void)value;
    NONE_2(1, "steps in the background")
}

EXPORT fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real *value)
{
    ASK_2(ANY)
    if (kind != fmi2LastSuccessfulTime) {
        return (fmi2Status)say(it, WRONG, "the last successful time is the only status that is a number");
    }
    *value = it->now.time;
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    NONE_2(1, "integers")
}

EXPORT fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean *value)
{
    ASK_2(ANY)
    if (kind != fmi2Terminated) {
        return (fmi2Status)say(it, WRONG, "whether it is terminated is the only status that is true or false");
    }
    *value = 0;
    return fmi2OK;
}

EXPORT fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind, (void)value;
    NONE_2(1, "strings")
}

