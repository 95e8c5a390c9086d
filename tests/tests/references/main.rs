//! Published results and closed forms, one module per case: the mechanism in
//! the language, the data with its source, what limits the agreement.
//!
//! Steps in s; `k` is kinematic analysis or a single instant, without steps.
//! The feedback is the default, deadbeat and held, except for baumgarte_decay
//! (per stage). The error is the largest in units of its tolerance.
//!
//! | case | step | numbers | error | of tolerance |
//! |---|---|---|---|---|
//! | adams_joint_tests | 1e-4 | 24 | 3e-7 m | 1e-6 |
//! | andrews_squeezer | 1e-7 | 42 | 1.5e-6 rad/s (angles 4e-9 rad) | 1e-5 (1e-7) |
//! | baumgarte_decay | 2e-5 | 12 | 2e-9 m² | 1e-8 |
//! | cart_npendulum_sympy | 1e-5, k | 9 | 3e-9 rad | 2e-8 |
//! | double_fourbar_a02 | 1/11000 | 13 | 3e-7 m | 1e-6 |
//! | double_pendulum_chrono | 1e-5 | 18 | 7e-10 m | 1e-8 |
//! | double_pendulum_modes | k | 8 | 6e-10 rad/s | 3e-9 |
//! | double_pendulum_points_exudyn | 1e-5 | 13 | 2e-9 m | 1e-8 |
//! | fourbar_drake_equilibrium | 1e-4, k | 9 | 7e-9 rad | 5e-8 |
//! | fourbar_nikravesh_statics | k | 25 | 9e-15 N | 1e-13 |
//! | fourbar_ondsel_driven | k; 1e-4 | 125; 125 | 1e-14 m/s²; 3e-6 m/s² | 1e-12; 1e-5 |
//! | fourbar_sympy_matrices | k | 12 | 2e-13 rad | 1e-12 |
//! | heun_oscillator | 0.01 | 15 | 3e-15 m/s | 1e-13 |
//! | kinematics_exact_linkages | k | 48 | 3e-14° | 1e-12 |
//! | kinematics_fourbar | k | 20 | 1e-13 rad/s² | 1e-11 |
//! | kinematics_slider_crank | k | 56 | 1e-14 rad/s² | 1e-12 |
//! | ladder_sliding | 1e-4 | 11 | 9e-9 rad | 2e-8 |
//! | pendulum_damped_modelica | 1e-4 | 12 | 5e-7 rad | 1e-6 |
//! | pendulum_iftomm_a01 | 1e-4 | 17 | 4e-3 N (1e-4 m) after 2000 s | 1e-2 (5e-4) |
//! | pendulum_period_table | 1e-4 | 15 | 7e-8 s | 3e-7 |
//! | pendulum_sundials_period2 | 1e-4 | 17 | 1e-5 m/s after 30 s | 5e-5 |
//! | rod_pendulum_reactions | 1e-4 | 15 | 1.4e-6 N | 5e-6 |
//! | slider_crank_matlab_exudyn | 1e-5 | 18 | 3e-5 rad after 19 turns | 1e-4 |
//! | slider_crank_sundials | 1e-4 | 24 | 4e-9 rad | 2e-8 |
//! | slotted_pendulum_modelica | 1e-4 | 20, twice | 2.4e-7 m/s | 1e-6 |
//!
//! Not run, since mechanisms are planar so far:
//!
//! | case | needs |
//! |---|---|
//! | spatial_conical_pendulum | a point mass in space |
//! | spatial_free_body_jacobi | rotations in space |
//! | spatial_heavy_top | rotations in space, a spherical joint |
//! | spatial_slider_crank_iftomm | spherical and universal joints |
//! | spatial_universal_joint | a universal joint |

mod adams_joint_tests;
mod andrews_squeezer;
mod baumgarte_decay;
mod cart_npendulum_sympy;
mod compare;
mod double_fourbar_a02;
mod double_pendulum_chrono;
mod double_pendulum_modes;
mod double_pendulum_points_exudyn;
mod fourbar_drake_equilibrium;
mod fourbar_nikravesh_statics;
mod fourbar_ondsel_driven;
mod fourbar_sympy_matrices;
mod heun_oscillator;
mod kinematics_exact_linkages;
mod kinematics_fourbar;
mod kinematics_slider_crank;
mod ladder_sliding;
mod pendulum_damped_modelica;
mod pendulum_iftomm_a01;
mod pendulum_period_table;
mod pendulum_sundials_period2;
mod rod_pendulum_reactions;
mod slider_crank_matlab_exudyn;
mod slider_crank_sundials;
mod slotted_pendulum_modelica;
