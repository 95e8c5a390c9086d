/** Time, positions and velocities. */
struct NAME_state {
    NAME_real t;
    struct NAME_coordinates q;
    struct NAME_coordinates v;
};

/** Accelerations, multipliers, and the growth of the pivots that they were divided by. */
struct NAME_reactions {
    struct NAME_coordinates acceleration;
    struct NAME_constraints multipliers;
    NAME_real growth;
};

/** The feedback -2 alpha phi_dot - beta^2 phi of the constraint violation. */
struct NAME_gains {
    NAME_real minus_two_alpha;
    NAME_real minus_beta_squared;
};

/** The mechanism: parameters, and what depends on them alone. Made by NAME_init. */
struct NAME {
    struct NAME_parameters parameters;
    NAME_real hoisted[CAPS_HOISTED + 1];
};

/** A run. Set the inputs before a step, and read the state after it. */
struct NAME_run {
    const struct NAME *mechanism;
    struct NAME_inputs inputs;
    struct NAME_state state;
    /** in s */
    NAME_real step;
    uint64_t steps;
    /** the largest pivot growth of a step so far: a factor by which rounding is magnified */
    NAME_real worst_growth;
    /** what the last error belongs to; see NAME_where */
    int where;
    /** the rest is for the functions below */
    struct NAME_gains gains;
    int is_held;
    NAME_real start_time, alarm, remembered_from, size;
};

/** Names of the declaration, a null pointer after the last. */
extern const char *const NAME_parameter_names[CAPS_PARAMETERS + 1];
extern const char *const NAME_input_names[CAPS_INPUTS + 1];
extern const char *const NAME_coordinate_names[CAPS_COORDINATES + 1];
extern const char *const NAME_constraint_names[CAPS_CONSTRAINTS + 1];
extern const char *const NAME_output_names[CAPS_OUTPUTS + 1];
extern const char *const NAME_point_names[CAPS_POINTS + 1];

/** Row and column of the entries of the Jacobian; one more at the end. */
extern const int NAME_phi_q_places[CAPS_JACOBIAN + 1][2];
/** Row and column of the entries of the mass matrix, one half of it; one more at the end. */
extern const int NAME_mass_places[CAPS_MASSES + 1][2];

/** The declared parameters. */
void NAME_default_parameters(struct NAME_parameters *parameters);

DEFAULT_INPUTS/** Makes the mechanism, or refuses parameters that are not finite or break a condition. */
int NAME_init(struct NAME *m, const struct NAME_parameters *parameters);

/** Starts a run with steps of so many seconds at the declared start, made consistent: values
   that it prescribes are kept, the others move least in the norm of the mass matrix. Inputs
   are AT_FIRST. The feedback removes a violation within two steps (deadbeat), and is held over each
   step. The mechanism has to outlive the run. */
int NAME_start(struct NAME_run *run, const struct NAME *m, double step);

/** Starts at a state that is kept as it is, with the step, feedback and inputs of the run, or
   refuses one that is not consistent. */
int NAME_start_from(struct NAME_run *run, const struct NAME_state *state);

/** Other gains in 1/s, held over each step or computed in every stage. Deadbeat gains of a step
   h are HELD held, STAGED in every stage. */
int NAME_set_feedback(struct NAME_run *run, double alpha, double beta, int is_held);

/** One step of SCHEME. After an error the state is that of the last good step. */
int NAME_step(struct NAME_run *run);

/** Accelerations and multipliers of the present state, without feedback: the forces that the
   mechanism feels. */
int NAME_reactions(struct NAME_run *run, struct NAME_reactions *reactions);

/** Both: accelerations and multipliers of the present state, then a step. */
int NAME_step_with_reactions(struct NAME_run *run, struct NAME_reactions *reactions);

/** The declared outputs in the present state. */
int NAME_outputs(struct NAME_run *run, struct NAME_outputs *outputs);

/** Kinetic plus potential energy in J. */
NAME_real NAME_energy(const struct NAME_run *run);

/** The constraint violation in positions, and in velocities: Euclidean norms. */
NAME_real NAME_violation(const struct NAME_run *run);
NAME_real NAME_velocity_violation(const struct NAME_run *run);

/** An error in words, and the coordinate, constraint, pivot, input or output that it belongs
   to; empty where there is none. */
const char *NAME_words(int code);
const char *NAME_where(const struct NAME_run *run, int code);

CLOCKED/** The equations. Results must not lie where arguments do. */

