/* FMI 3.0: what this export has none of. */

#define NONE_3(count, what) \
    ASK_3(ANY) \
    return (count) == 0 ? fmi3OK : (fmi3Status)say(it, WRONG, "%s: there are no " what, __func__);

/* All variables are of the type Float64. */
#define NO_VALUES(type) \
    EXPORT fmi3Status fmi3Get##type( \
        fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3##type values[], size_t value_count) \
    { \
        (void)vr, (void)values, (void)value_count; \
        NONE_3(count, "variables of this type") \
    } \
    EXPORT fmi3Status fmi3Set##type( \
        fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3##type values[], size_t value_count) \
    { \
        (void)vr, (void)values, (void)value_count; \
        NONE_3(count, "variables of this type") \
    }

NO_VALUES(Float32)
NO_VALUES(Int8)
NO_VALUES(UInt8)
NO_VALUES(Int16)
NO_VALUES(UInt16)
NO_VALUES(Int32)
NO_VALUES(UInt32)
NO_VALUES(Int64)
NO_VALUES(UInt64)
NO_VALUES(Boolean)
NO_VALUES(String)

EXPORT fmi3Status fmi3GetBinary(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, size_t sizes[], fmi3Binary values[],
    size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    NONE_3(count, "variables of this type")
}

EXPORT fmi3Status fmi3SetBinary(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const size_t sizes[], const fmi3Binary values[],
    size_t value_count)
{
    (void)vr, (void)sizes, (void)values, (void)value_count;
    NONE_3(count, "variables of this type")
}

EXPORT fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Clock values[])
{
    (void)vr, (void)values;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Clock values[])
{
    (void)vr, (void)values;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, fmi3ValueReference vr, size_t *count)
{
    (void)vr, (void)count;
    NONE_3(1, "dependencies of single elements")
}

EXPORT fmi3Status fmi3GetVariableDependencies(
    fmi3Instance c, fmi3ValueReference dependent, size_t of_dependent[], fmi3ValueReference independents[],
    size_t of_independents[], fmi3DependencyKind kinds[], size_t count)
{
    (void)dependent, (void)of_dependent, (void)independents, (void)of_independents, (void)kinds;
    NONE_3(count, "dependencies of single elements")
}

EXPORT fmi3Status fmi3EnterConfigurationMode(fmi3Instance c)
{
    NONE_3(1, "structural parameters")
}

EXPORT fmi3Status fmi3ExitConfigurationMode(fmi3Instance c)
{
    NONE_3(1, "structural parameters")
}

EXPORT fmi3Status fmi3GetIntervalDecimal(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 intervals[],
    fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)intervals, (void)qualifiers;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3GetIntervalFraction(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
    fmi3IntervalQualifier qualifiers[])
{
    (void)vr, (void)counters, (void)resolutions, (void)qualifiers;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3GetShiftDecimal(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3GetShiftFraction(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3SetIntervalDecimal(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Float64 intervals[])
{
    (void)vr, (void)intervals;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3SetIntervalFraction(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3SetShiftDecimal(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Float64 shifts[])
{
    (void)vr, (void)shifts;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3SetShiftFraction(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)vr, (void)counters, (void)resolutions;
    NONE_3(count, "clocks")
}

EXPORT fmi3Status fmi3EnterStepMode(fmi3Instance c)
{
    NONE_3(1, "events in co-simulation")
}

EXPORT fmi3Status fmi3GetOutputDerivatives(
    fmi3Instance c, const fmi3ValueReference vr[], size_t count, const fmi3Int32 orders[], fmi3Float64 values[],
    size_t value_count)
{
    (void)vr, (void)orders, (void)values, (void)value_count;
    NONE_3(count, "derivatives of outputs")
}

EXPORT fmi3Status fmi3ActivateModelPartition(fmi3Instance c, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)clock, (void)time;
    NONE_3(1, "model partitions")
}
