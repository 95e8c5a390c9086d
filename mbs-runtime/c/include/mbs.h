/**
 * @file mbs.h
 * @brief Planar mechanisms from texts: compiled in milliseconds, run at once.
 *
 * A text declares bodies, joints, forces, inputs and outputs. ::mbs_compile makes a mechanism of it,
 * ::mbs_run_new a run of a mechanism, and ::mbs_run_step integrates the run in time. The numbers are those of the
 * Rust library `mbs-live`, to the last bit.
 *
 * @code{.c}
 * mbs_mechanism *mechanism;
 * mbs_run *run;
 * if (mbs_read("crank.mbs", NULL, 0.0, &mechanism) == MBS_OK &&
 *     mbs_run_new(mechanism, "rk4", 1e-3, &run) == MBS_OK) {
 *     mbs_run_start(run);
 *     mbs_run_step(run, 1000);
 *     mbs_run_free(run);
 * } else {
 *     fputs(mbs_error(), stderr);
 * }
 * mbs_mechanism_free(mechanism);
 * @endcode
 *
 * @par Units
 * All numbers are in SI units: m, kg, s, N, N·m, J. Angles are in rad. ::mbs_describe tells the unit in which a text
 * declares a quantity, and its size in SI units.
 *
 * @par Status and error
 * Every function that can fail returns an ::mbs_status and gives its results through pointers. After a failure, results
 * are left as they were, except that pointers to new handles are set to NULL, and ::mbs_error tells what went wrong.
 * Null pointers, wrong counts, unknown names and indices, and texts that are not UTF-8 are answered by a status.
 *
 * @par Contract
 * What cannot be checked is the duty of the caller:
 * - a handle is NULL, or was given by this library, is of the type that the function asks for, and was not freed;
 * - a text is NULL, or ends with a NUL character and does not change during the call;
 * - an array is NULL, or has room for as many numbers as the count beside it says; an array that is read holds
 *   numbers; neither changes during the call;
 * - a pointer to a result is NULL, or points to memory that may be written.
 *
 * Memory need not be aligned, and need not be initialized if it is written alone. Results may overlap each other; the
 * last one that is written stays.
 *
 * @par Texts
 * All texts are UTF-8 and end with a NUL character. Texts that the library gives are its own and must not be freed;
 * each function says for how long they stay.
 *
 * @par Threads
 * A mechanism never changes, and any number of threads may use it at the same time. A run may be used from any thread,
 * by one thread at a time. Errors are kept for each thread. No function takes a lock for long, calls back, prints, or
 * sets a signal handler; compiling starts a thread that has ended when ::mbs_compile returns, unless a limit of time
 * was met.
 *
 * @par Stability
 * Functions, numbers of enumerations and fields of structs stay as they are while ::MBS_ABI does. Functions and
 * numbers may be added: a program should expect a status that it does not know.
 */
#ifndef MBS_H
#define MBS_H

#include <stddef.h>
#include <stdint.h>

/** @brief The binary interface that this header describes; ::mbs_abi tells that of the library. */
#define MBS_ABI 1

/* On Windows, define MBS_STATIC to link the static library. */
#if defined(_WIN32) && !defined(MBS_STATIC)
#define MBS_API __declspec(dllimport)
#else
#define MBS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** @brief How a call ended. */
typedef enum mbs_status {
    /** It did what was asked. */
    MBS_OK = 0,
    /** A pointer is NULL that must not be. */
    MBS_NULL = 1,
    /** A text is not UTF-8. */
    MBS_UTF8 = 2,
    /** An array has another count of numbers than the mechanism. */
    MBS_COUNT = 3,
    /** There is no quantity, or no kind of quantities, with this number. */
    MBS_INDEX = 4,
    /** There is no quantity, or no method, with this name. */
    MBS_NAME = 5,
    /** A file cannot be read. */
    MBS_FILE = 6,
    /** A text does not declare a mechanism that can be compiled; ::mbs_problem_at has the places. */
    MBS_DECLARATION = 7,
    /** A number cannot be taken: a parameter, an input, a step, a time, a gain or a tolerance. */
    MBS_VALUE = 8,
    /** A method does not go with the mechanism, or with what else was set. */
    MBS_METHOD = 9,
    /** The run has not been started. */
    MBS_NOT_STARTED = 10,
    /** A start violates the constraints, or cannot be made consistent with them. */
    MBS_START = 11,
    /** The mechanism is in a singular position. */
    MBS_SINGULAR = 12,
    /** A constraint cannot be met any more: a drive leads beyond what the dimensions allow. */
    MBS_OUT_OF_REACH = 13,
    /** The motion is no longer finite. */
    MBS_DIVERGED = 14,
    /** An output or a multiplier is not finite, though the motion is. */
    MBS_UNDEFINED = 15,
    /** A step is too long for the method, or none is short enough for the tolerances. */
    MBS_ACCURACY = 16,
    /** A mistake of the library; please report it. A run or mechanism that was used is to be freed. */
    MBS_INTERNAL = 17
} mbs_status;

/** @brief The kinds of quantities that a mechanism has, each numbered from 0. */
typedef enum mbs_kind {
    /** Parameters: fixed over a run. */
    MBS_PARAMETER = 1,
    /** Inputs: set from outside and held over each step. */
    MBS_INPUT = 2,
    /** Coordinates, lengths in m or angles in rad. */
    MBS_COORDINATE = 3,
    /** Outputs: what the text measures. */
    MBS_OUTPUT = 4,
    /** Constraints, drives included; their multipliers are the reactions. */
    MBS_CONSTRAINT = 5,
    /** Points of bodies and of the ground; a body itself is the point at its centre of mass. */
    MBS_POINT = 6
} mbs_kind;

/** @brief A mechanism that was compiled. It never changes. */
typedef struct mbs_mechanism mbs_mechanism;

/** @brief A run: what is set for it, and once it was started, the mechanism in motion. */
typedef struct mbs_run mbs_run;

/** @brief A quantity of a mechanism. */
typedef struct mbs_quantity {
    /** Its name. */
    const char *name;
    /** What the text says about it in comments `///`; empty where it says nothing. */
    const char *doc;
    /** The unit in which it is declared, or the SI unit where none is, such as `mm` or `N*m`; empty for a bare number.
     *  Of a coordinate `m` or `rad`; of a constraint that of its multiplier. */
    const char *unit;
    /** How many SI units one such unit is. A value x in SI units is x / scale in this unit. */
    double scale;
    /** The declared value of a parameter, the declared start or guess of a coordinate, in SI units; else 0. */
    double value;
} mbs_quantity;

/** @brief A problem of a text that was not compiled. */
typedef struct mbs_problem {
    /** What is wrong. */
    const char *message;
    /** How to mend it; empty where nothing is known. */
    const char *help;
    /** The line at fault, from 1; 0 if it is no single place. */
    size_t line;
    /** The column of its first character in this line, from 1; 0 if it is no single place. */
    size_t column;
    /** How many characters are at fault; 0 at the end of the text. */
    size_t length;
} mbs_problem;

/** @name The library
 *  @{ */

/** @brief The version of the library, such as `0.1.0`. The text stays for ever. */
MBS_API const char *mbs_version(void);

/** @brief The binary interface of the library; it has to be ::MBS_ABI. */
MBS_API uint32_t mbs_abi(void);

/**
 * @brief A status in words, such as `singular position`. The text stays for ever.
 * @param status any number
 */
MBS_API const char *mbs_status_text(mbs_status status);

/**
 * @brief What went wrong in the last call of this thread that failed; empty if none did.
 *
 * Of a text that was not compiled these are all problems with file, line, column and the underlined source, in lines
 * without colours. The text stays until another call of this thread fails or the thread ends.
 */
MBS_API const char *mbs_error(void);

/** @brief How many problems a text has, if one was not compiled in the last call of this thread that failed; else 0. */
MBS_API size_t mbs_problem_count(void);

/**
 * @brief A problem of that text, for editors. Its texts stay as long as that of ::mbs_error.
 * @param index of the problem, from 0
 * @param[out] problem the problem
 * @return ::MBS_INDEX, ::MBS_NULL. A failure of this function leaves ::mbs_error as it is.
 */
MBS_API mbs_status mbs_problem_at(size_t index, mbs_problem *problem);

/** @}
 *  @name Mechanisms
 *  @{ */

/**
 * @brief Compiles a text.
 *
 * The text is a declaration by itself, or Rust with a block `mechanism! { ... }` if the name of the file ends in
 * `.rs`. It may come from a stranger: nothing in it runs a program or reads a file, and its size is bounded. A text
 * that was compiled leaves some kilobytes of names behind until the process ends, once for each different text.
 *
 * @param text the declaration, at most 1 MiB
 * @param file what messages call it; it is not read. NULL for `text`.
 * @param name of the mechanism, where Rust has several; NULL for the only one
 * @param limit of time in s after which compiling is given up; 0 for none
 * @param[out] mechanism a new handle for ::mbs_mechanism_free
 * @return ::MBS_DECLARATION, ::MBS_VALUE (the limit), ::MBS_UTF8, ::MBS_NULL
 */
MBS_API mbs_status mbs_compile(const char *text, const char *file, const char *name, double limit,
                               mbs_mechanism **mechanism);

/**
 * @brief Compiles what stands in a file.
 * @param path of the file
 * @param name as in ::mbs_compile
 * @param limit as in ::mbs_compile
 * @param[out] mechanism a new handle for ::mbs_mechanism_free
 * @return ::MBS_FILE, and as ::mbs_compile
 */
MBS_API mbs_status mbs_read(const char *path, const char *name, double limit, mbs_mechanism **mechanism);

/**
 * @brief Frees a mechanism. Its runs go on without it.
 * @param mechanism a handle, or NULL for nothing to do
 */
MBS_API void mbs_mechanism_free(mbs_mechanism *mechanism);

/**
 * @brief The name of a mechanism.
 * @param mechanism a handle
 * @param[out] name stays until the mechanism is freed
 * @return ::MBS_NULL
 */
MBS_API mbs_status mbs_mechanism_name(const mbs_mechanism *mechanism, const char **name);

/**
 * @brief The degrees of freedom: coordinates minus independent constraints, drives included.
 * @param mechanism a handle
 * @param[out] freedom how many; 0 for a mechanism that its drives move
 * @return ::MBS_NULL
 */
MBS_API mbs_status mbs_mechanism_freedom(const mbs_mechanism *mechanism, int32_t *freedom);

/**
 * @brief How many quantities of a kind there are.
 * @param mechanism a handle
 * @param kind of quantities
 * @param[out] count how many
 * @return ::MBS_INDEX (the kind), ::MBS_NULL
 */
MBS_API mbs_status mbs_count(const mbs_mechanism *mechanism, mbs_kind kind, size_t *count);

/**
 * @brief The quantity with a name.
 * @param mechanism a handle
 * @param kind of quantities
 * @param name of the quantity
 * @param[out] index of the quantity, from 0
 * @return ::MBS_NAME, ::MBS_INDEX (the kind), ::MBS_UTF8, ::MBS_NULL
 */
MBS_API mbs_status mbs_find(const mbs_mechanism *mechanism, mbs_kind kind, const char *name, size_t *index);

/**
 * @brief Name, unit and declared value of a quantity.
 * @param mechanism a handle
 * @param kind of quantities
 * @param index of the quantity, from 0
 * @param[out] quantity whose texts stay until the mechanism is freed
 * @return ::MBS_INDEX, ::MBS_NULL
 */
MBS_API mbs_status mbs_describe(const mbs_mechanism *mechanism, mbs_kind kind, size_t index, mbs_quantity *quantity);

/** @}
 *  @name Runs: what is set before the start
 *  @{ */

/**
 * @brief A run that is not started yet.
 *
 * A method is one or two words, a scheme and what keeps the constraints, with a space between them; a word that is left
 * out is as declared. Schemes are `heun` (second order, unless the text declares another), `bs3`, `ssp3`, `rk4`,
 * `dopri5`, `dop853`; constraints are kept by feedback, `held` over a step or `per-stage`, or by `projection`. Methods that keep
 * the constraints themselves stand alone: `rattle` and `rattle4` for conservative mechanisms, `trbdf2` and `esdirk4`
 * for stiff ones, the latter always to a tolerance.
 *
 * @param mechanism a handle; it may be freed before the run
 * @param method such as `rk4` or `rk4 projection`; NULL for what the text declares
 * @param step in s; 0 for what the text declares
 * @param[out] run a new handle for ::mbs_run_free
 * @return ::MBS_NAME (the method), ::MBS_VALUE (the step), ::MBS_UTF8, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_new(const mbs_mechanism *mechanism, const char *method, double step, mbs_run **run);

/**
 * @brief A copy of a run with all that was set and with its state. Both go on by themselves, and alike: a copy is also
 * how a state is saved.
 * @param run a handle
 * @param[out] copy a new handle for ::mbs_run_free
 * @return ::MBS_NULL
 */
MBS_API mbs_status mbs_run_clone(const mbs_run *run, mbs_run **copy);

/**
 * @brief Frees a run.
 * @param run a handle, or NULL for nothing to do
 */
MBS_API void mbs_run_free(mbs_run *run);

/**
 * @brief Sets a parameter for the next ::mbs_run_start, which checks it.
 * @param run a handle
 * @param index of the parameter, from 0
 * @param value in SI units
 * @return ::MBS_INDEX, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_set_parameter(mbs_run *run, size_t index, double value);

/**
 * @brief Sets an input, at once and for later starts. It is held until it is set again; before, it has its
 * declared value.
 * @param run a handle
 * @param index of the input, from 0
 * @param value in SI units
 * @return ::MBS_VALUE if it is not finite, ::MBS_INDEX, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_set_input(mbs_run *run, size_t index, double value);

/**
 * @brief Sets the state at which the next ::mbs_run_start begins, in place of the declared start. It has to be
 * consistent with the constraints, which is checked then.
 * @param run a handle
 * @param time in s
 * @param positions the coordinates in m and rad
 * @param velocities their rates in m/s and rad/s
 * @param count of coordinates, the length of both arrays
 * @return ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_set_start(mbs_run *run, double time, const double *positions, const double *velocities,
                                     size_t count);

/**
 * @brief Has the next ::mbs_run_start begin a run to a tolerance.
 *
 * Its steps are then as long as their error permits, and the step of the run is the time between two samples of it. The
 * scheme is `bs3`, `dopri5` or `dop853`, `dopri5` unless the text or the method says another; constraints are kept by
 * projection.
 *
 * @param run a handle
 * @param relative error that a step may add, such as 1e-6; at least 2.3e-14
 * @param absolute error that a step may add, in m, rad, m/s and rad/s, such as 1e-9
 * @return ::MBS_VALUE, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_set_tolerances(mbs_run *run, double relative, double absolute);

/**
 * @brief Sets the gains of the feedback for the next ::mbs_run_start. Without this call they are as declared, or else
 * those that remove a violation in two steps.
 * @param run a handle
 * @param alpha of the rate of the violation, in 1/s
 * @param beta of the violation, in 1/s
 * @return ::MBS_VALUE, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_set_gains(mbs_run *run, double alpha, double beta);

/** @}
 *  @name Runs: motion
 *  @{ */

/**
 * @brief Starts a run with what was set, or starts it anew.
 *
 * The declared start is made consistent with the constraints. A failure leaves a run that was started as it was.
 *
 * @param run a handle
 * @return ::MBS_VALUE (a parameter, a step, a time), ::MBS_METHOD, ::MBS_START, ::MBS_SINGULAR, ::MBS_DIVERGED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_start(mbs_run *run);

/**
 * @brief Advances by some steps.
 *
 * After a failure the state is that of the last good step. With a method of scheme and feedback, steps of a healthy
 * motion allocate no memory.
 *
 * @param run a handle
 * @param steps how many; 0 for none
 * @return ::MBS_SINGULAR, ::MBS_OUT_OF_REACH, ::MBS_DIVERGED, ::MBS_ACCURACY, ::MBS_VALUE (the time),
 * ::MBS_NOT_STARTED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_step(mbs_run *run, uint64_t steps);

/**
 * @brief Advances by steps until less than half a step is left to a time; a run to a tolerance to that time,
 * where one of its own steps ends.
 * @param run a handle
 * @param end time in s
 * @return ::MBS_VALUE for a time before the present one, and as ::mbs_run_step
 */
MBS_API mbs_status mbs_run_advance_to(mbs_run *run, double end);

/** @}
 *  @name Runs: what can be read
 *  @{ */

/**
 * @brief The present time.
 * @param run a handle
 * @param[out] time in s
 * @return ::MBS_NOT_STARTED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_time(const mbs_run *run, double *time);

/**
 * @brief The parameters as they are set.
 * @param run a handle
 * @param[out] values in SI units
 * @param count of parameters
 * @return ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_parameters(const mbs_run *run, double *values, size_t count);

/**
 * @brief The inputs as they are set.
 * @param run a handle
 * @param[out] values in SI units
 * @param count of inputs
 * @return ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_inputs(const mbs_run *run, double *values, size_t count);

/**
 * @brief Positions and velocities.
 * @param run a handle
 * @param[out] positions the coordinates in m and rad
 * @param[out] velocities their rates in m/s and rad/s
 * @param count of coordinates, the length of both arrays
 * @return ::MBS_NOT_STARTED, ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_state(const mbs_run *run, double *positions, double *velocities, size_t count);

/**
 * @brief Accelerations, and the multipliers of the constraints, which are the efforts of drives and joints.
 * @param run a handle
 * @param[out] accelerations of the coordinates in m/s^2 and rad/s^2
 * @param count of coordinates
 * @param[out] multipliers in N and N·m where the constraint is a length or an angle; ::mbs_describe has their units
 * @param constraints count of constraints
 * @return ::MBS_SINGULAR, ::MBS_UNDEFINED, ::MBS_DIVERGED, ::MBS_NOT_STARTED, ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_reactions(const mbs_run *run, double *accelerations, size_t count, double *multipliers,
                                     size_t constraints);

/**
 * @brief What the text measures.
 * @param run a handle
 * @param[out] values in SI units
 * @param count of outputs
 * @return as ::mbs_run_reactions
 */
MBS_API mbs_status mbs_run_outputs(const mbs_run *run, double *values, size_t count);

/**
 * @brief Where the points of the mechanism are.
 * @param run a handle
 * @param[out] places x and y of every point in m, one after the other
 * @param count of numbers: twice that of the points
 * @return ::MBS_NOT_STARTED, ::MBS_COUNT, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_points(const mbs_run *run, double *places, size_t count);

/**
 * @brief Kinetic and potential energy.
 * @param run a handle
 * @param[out] kinetic energy in J
 * @param[out] potential energy in J
 * @return ::MBS_NOT_STARTED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_energy(const mbs_run *run, double *kinetic, double *potential);

/**
 * @brief How well the constraints are met: the Euclidean norms of the constraints and of their rates.
 * @param run a handle
 * @param[out] violation of the constraints, in m and rad
 * @param[out] rate of the violation, in m/s and rad/s
 * @return ::MBS_NOT_STARTED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_violation(const mbs_run *run, double *violation, double *rate);

/**
 * @brief How many decimal digits the position nearest to a singular one has left to the accelerations.
 * @param run a handle
 * @param[out] digits about 15 of a healthy run; with fewer than 8 results are to be doubted
 * @return ::MBS_NOT_STARTED, ::MBS_NULL
 */
MBS_API mbs_status mbs_run_digits(const mbs_run *run, double *digits);

/** @} */

#ifdef __cplusplus
}
#endif

#endif
