/** A bob on a rod.

    Printed from its declaration; changes here are lost. All numbers are in SI units, angles in rad. */
#ifndef PENDULUM_H
#define PENDULUM_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef double pendulum_real;

/** How many there are. */
enum {
    PENDULUM_PARAMETERS = 1,
    PENDULUM_INPUTS = 1,
    PENDULUM_COORDINATES = 2,
    PENDULUM_CONSTRAINTS = 1,
    PENDULUM_OUTPUTS = 1,
    PENDULUM_REDUNDANT = 0,
    PENDULUM_EVENTS = 0,
    PENDULUM_POINTS = 2,
    PENDULUM_JACOBIAN = 2,
    PENDULUM_PIVOTS = 1,
    PENDULUM_START_PIVOTS = 1,
    PENDULUM_CONDITIONS = 1,
    PENDULUM_CONDITION_VALUES = 2,
    PENDULUM_HOISTED = 1,
    PENDULUM_STAGES = 2,
};

/** What functions return that may fail. */
enum {
    /** no error */
    PENDULUM_OK,
    /** the position is singular: constraints depend on each other there, or friction jams */
    PENDULUM_SINGULAR,
    /** constraints depend on each other at the start */
    PENDULUM_SINGULAR_START,
    /** a position or a velocity is no longer finite */
    PENDULUM_NOT_FINITE,
    /** the mechanism cannot be assembled: check the dimensions, or start from a closer guess */
    PENDULUM_NOT_ASSEMBLED,
    /** a constraint cannot be met any more: check the dimensions and how far the drives go */
    PENDULUM_OUT_OF_REACH,
    /** a multiplier is not finite, though the motion is */
    PENDULUM_UNDEFINED_MULTIPLIER,
    /** an output is not finite */
    PENDULUM_UNDEFINED_OUTPUT,
    /** an input is not finite */
    PENDULUM_BAD_INPUT,
    /** the step has to be positive, finite, and more than the rounding of time */
    PENDULUM_BAD_STEP,
    /** gains must not be negative, and violations must not grow with them from step to step */
    PENDULUM_BAD_GAINS,
    /** the given state violates a constraint, or its rate, too much to be kept as it is */
    PENDULUM_INCONSISTENT,
    /** a parameter is not finite; with its position added */
    PENDULUM_BAD_PARAMETER,
    /** a condition does not hold; with its position added */
    PENDULUM_BAD_CONDITION = PENDULUM_BAD_PARAMETER + PENDULUM_PARAMETERS
};

/** Numbers that are set once. */
struct pendulum_parameters {
    /** `length`: a length [m], declared as 1 m = 1 in SI units. */
    pendulum_real length;
};

/** Numbers that may change from step to step. */
struct pendulum_inputs {
    /** `wind`: a force [N]. */
    pendulum_real wind;
};

/** The coordinates, or their rates per second. */
struct pendulum_coordinates {
    /** `x`: a length [m]. */
    pendulum_real x;
    /** `y`: a length [m]. */
    pendulum_real y;
};

/** One number per constraint: its violation, its multiplier, or an amount added to its right-hand side. */
struct pendulum_constraints {
    /** `x^2 + y^2 - length^2 = 0` */
    pendulum_real rod;
};

/** What the declaration measures. */
struct pendulum_outputs {
    /** `height`: a length [m]. */
    pendulum_real height;
};

/** Time, positions and velocities. */
struct pendulum_state {
    pendulum_real t;
    struct pendulum_coordinates q;
    struct pendulum_coordinates v;
};

/** Accelerations, multipliers, and the growth of the pivots that they were divided by. */
struct pendulum_reactions {
    struct pendulum_coordinates acceleration;
    struct pendulum_constraints multipliers;
    pendulum_real growth;
};

/** The feedback -2 alpha phi_dot - beta^2 phi of the constraint violation. */
struct pendulum_gains {
    pendulum_real minus_two_alpha;
    pendulum_real minus_beta_squared;
};

/** The mechanism: parameters, and what depends on them alone. Made by pendulum_init. */
struct pendulum {
    struct pendulum_parameters parameters;
    pendulum_real hoisted[PENDULUM_HOISTED + 1];
};

/** A run. Set the inputs before a step, and read the state after it. */
struct pendulum_run {
    const struct pendulum *mechanism;
    struct pendulum_inputs inputs;
    struct pendulum_state state;
    /** in s */
    pendulum_real step;
    uint64_t steps;
    /** the largest pivot growth of a step so far: a factor by which rounding is magnified */
    pendulum_real worst_growth;
    /** what the last error belongs to; see pendulum_where */
    int where;
    /** the rest is for the functions below */
    struct pendulum_gains gains;
    int is_held;
    pendulum_real start_time, alarm, remembered_from, size;
};

/** Names of the declaration, a null pointer after the last. */
extern const char *const pendulum_parameter_names[PENDULUM_PARAMETERS + 1];
extern const char *const pendulum_input_names[PENDULUM_INPUTS + 1];
extern const char *const pendulum_coordinate_names[PENDULUM_COORDINATES + 1];
extern const char *const pendulum_constraint_names[PENDULUM_CONSTRAINTS + 1];
extern const char *const pendulum_output_names[PENDULUM_OUTPUTS + 1];
extern const char *const pendulum_point_names[PENDULUM_POINTS + 1];

/** Row and column of the entries of the Jacobian; one more at the end. */
extern const int pendulum_phi_q_places[PENDULUM_JACOBIAN + 1][2];

/** The declared parameters. */
void pendulum_default_parameters(struct pendulum_parameters *parameters);

/** Makes the mechanism, or refuses parameters that are not finite or break a condition. */
int pendulum_init(struct pendulum *m, const struct pendulum_parameters *parameters);

/** Starts a run with steps of so many seconds at the declared start, made consistent: values
   that it prescribes are kept, the others move least in the norm of the mass matrix. Inputs
   are 0. The feedback removes a violation within two steps (deadbeat), and is held over each
   step. The mechanism has to outlive the run. */
int pendulum_start(struct pendulum_run *run, const struct pendulum *m, double step);

/** Starts at a state that is kept as it is, with the step, feedback and inputs of the run, or
   refuses one that is not consistent. */
int pendulum_start_from(struct pendulum_run *run, const struct pendulum_state *state);

/** Other gains in 1/s, held over each step or computed in every stage. Deadbeat gains of a step
   h are 0.75/h and 1/h held, 1/h and 1.4142135623730951/h in every stage. */
int pendulum_set_feedback(struct pendulum_run *run, double alpha, double beta, int is_held);

/** One step of Heun's method. After an error the state is that of the last good step. */
int pendulum_step(struct pendulum_run *run);

/** Accelerations and multipliers of the present state, without feedback: the forces that the
   mechanism feels. */
int pendulum_reactions(struct pendulum_run *run, struct pendulum_reactions *reactions);

/** Both: accelerations and multipliers of the present state, then a step. */
int pendulum_step_with_reactions(struct pendulum_run *run, struct pendulum_reactions *reactions);

/** The declared outputs in the present state. */
int pendulum_outputs(struct pendulum_run *run, struct pendulum_outputs *outputs);

/** Kinetic plus potential energy in J. */
pendulum_real pendulum_energy(const struct pendulum_run *run);

/** The constraint violation in positions, and in velocities: Euclidean norms. */
pendulum_real pendulum_violation(const struct pendulum_run *run);
pendulum_real pendulum_velocity_violation(const struct pendulum_run *run);

/** An error in words, and the coordinate, constraint, pivot, input or output that it belongs
   to; empty where there is none. */
const char *pendulum_words(int code);
const char *pendulum_where(const struct pendulum_run *run, int code);

/** The equations. Results must not lie where arguments do. */

/** The constraints Φ(q, t): 0 where the mechanism is assembled.
    Cost: 2 mul + 2 add + 0 div + 0 sincos. */
void pendulum_compute_phi(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_constraints *result);

/** The constraint violation in velocities, Φ̇ = Φ_q v + Φ_t.
    Cost: 4 mul + 1 add + 0 div + 0 sincos. */
void pendulum_compute_phi_dot(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_constraints *result);

/** The entries of the Jacobian Φ_q that are not 0, as the table of places has them.
    Cost: 2 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_phi_q(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result);

/** The partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_phi_t(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_constraints *result);

/** γ, so that accelerations satisfy Φ_q q̈ = γ.
    Cost: 4 mul + 2 add + 0 div + 0 sincos. */
void pendulum_compute_gamma(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_constraints *result);

/** γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation.
    Cost: 10 mul + 6 add + 0 div + 0 sincos. */
void pendulum_compute_baumgarte_rhs(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_gains *gains,
    struct pendulum_constraints *result);

/** The diagonal of the mass matrix M; its other entries are 0.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_mass(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    struct pendulum_coordinates *result);

/** The generalized forces Q: gravity and applied loads.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_forces(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    struct pendulum_coordinates *result);

/** The kinetic energy ½ vᵀMv in J.
    Cost: 2 mul + 1 add + 0 div + 0 sincos. */
pendulum_real pendulum_compute_kinetic_energy(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v);

/** The potential energy of gravity and springs in J.
    Cost: 1 mul + 0 add + 0 div + 0 sincos. */
pendulum_real pendulum_compute_potential_energy(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v);

/** Accelerations of what is integrated, with feedback of its own violation, and this feedback.
    Returns the pivot growth.
    Cost: 21 mul + 11 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_stabilized(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_gains *gains,
    struct pendulum_coordinates *acceleration,
    struct pendulum_constraints *feedback);

/** Accelerations of what is integrated, with the given feedback.
    Returns the pivot growth.
    Cost: 15 mul + 7 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_constrained(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result);

/** q̈ and λ from M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ + feedback.
    Returns the pivot growth.
    Cost: 15 mul + 8 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_reactions(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *acceleration,
    struct pendulum_constraints *multipliers);

/** The shortest Δq by masses, with Φ_q Δq = feedback; prescribed coordinates do not move.
    Returns the pivot growth.
    Cost: 8 mul + 1 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_position_correction(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result);

/** The same for velocities.
    Returns the pivot growth.
    Cost: 8 mul + 1 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_velocity_correction(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result);

/** The same Δq or Δv with no coordinate prescribed.
    Returns the pivot growth.
    Cost: 8 mul + 1 add + 1 div + 0 sincos. */
pendulum_real pendulum_compute_projection(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_constraints *feedback,
    struct pendulum_coordinates *result);

/** The declared outputs.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_outputs(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    const struct pendulum_reactions *reactions,
    struct pendulum_outputs *result);

/** The values whose changes of sign are declared as events.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_events(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    const struct pendulum_inputs *inputs,
    pendulum_real *result);

/** The declared start, before guesses are corrected. Returns its time.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
pendulum_real pendulum_compute_declared_start(
    const struct pendulum *m,
    struct pendulum_coordinates *q,
    struct pendulum_coordinates *v);

/** The growth of every pivot that may vanish.
    Cost: 6 mul + 1 add + 1 div + 0 sincos + 1 other. */
void pendulum_compute_pivots(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result);

/** The growth of every pivot of the corrections.
    Cost: 6 mul + 1 add + 1 div + 0 sincos + 1 other. */
void pendulum_compute_start_pivots(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result);

/** Where the points of the mechanism are in m: x and y of each.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_points(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    pendulum_real *result);

/** All coordinates and velocities, from those that are integrated.
    Cost: 0 mul + 0 add + 0 div + 0 sincos. */
void pendulum_compute_complete(
    const struct pendulum *m,
    pendulum_real t,
    const struct pendulum_coordinates *q,
    const struct pendulum_coordinates *v,
    struct pendulum_coordinates *q_all,
    struct pendulum_coordinates *v_all);

#ifdef __cplusplus
}
#endif

#endif
