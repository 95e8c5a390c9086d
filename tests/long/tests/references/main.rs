//! Published results and closed forms, one module per case: the mechanism in
//! the language, the data with its source, what limits the agreement.
//!
//! Steps in s; `k` is kinematic analysis or a single instant, without steps.
//! The feedback is the default, deadbeat and held, except for baumgarte_decay
//! (per stage). The error is the largest in units of its tolerance.
//!
//! A case with steps goes through every path that a step can take (crate `paths`): in
//! stages, fused, in packs of 4 and 8 lanes and, in single precision, alone and in
//! packs of 8 and 16 lanes. In `f64` all of them meet the same tolerance. In `f32` h
//! is so small that rounding would be all: there steps are longer by the factor in
//! the last column, and tolerances wider by its square, as Heun's method is of second
//! order (`ε`: the same steps, tolerances in units of ε); behind it, the largest error.
//! Where the programs have parts that repeat themselves, these are loops in a second
//! round (`in_loops`).
//!
//! | case | step | numbers | error | of tolerance | single |
//! |---|---|---|---|---|---|
//! | adams_joint_tests | 1e-4 | 24 | 3e-7 m | 1e-6 | 10, 20: 3e-5 m |
//! | andrews_squeezer | 1e-7 | 42 | 1.5e-6 rad/s (angles 4e-9 rad) | 1e-5 (1e-7) | 150: 0.09 rad/s |
//! | baumgarte_decay | 2e-5 | 12 | 2e-9 m² | 1e-8 | 50: 5e-6 m² |
//! | cart_npendulum_sympy | 1e-5, k | 9 | 3e-9 rad | 2e-8 | 100: 3e-5 rad |
//! | double_fourbar_a02 | 1/11000 | 13 | 3e-7 m | 1e-6 | –, flat positions are singular to seven digits |
//! | double_pendulum_chrono | 1e-5 | 18 | 7e-10 m | 1e-8 | 200: 4e-5 m/s |
//! | double_pendulum_modes | k | 8 | 6e-10 rad/s | 3e-9 | |
//! | double_pendulum_points_exudyn | 1e-5 | 13 | 2e-9 m | 1e-8 | 100: 2e-5 m |
//! | fourbar_drake_equilibrium | 1e-4, k | 9 | 7e-9 rad | 5e-8 | 50: 5e-5 rad/s |
//! | fourbar_nikravesh_statics | k | 25 | 9e-15 N | 1e-13 | |
//! | fourbar_ondsel_driven | k; 1e-4 | 125; 125 | 1e-14 m/s²; 3e-6 m/s² | 1e-12; 1e-5 | 20: 1.4e-3 m/s² |
//! | fourbar_sympy_matrices | k | 12 | 2e-13 rad | 1e-12 | |
//! | heun_oscillator | 0.01 | 15 | 3e-15 m/s | 1e-13 | ε: 3e-7 m/s |
//! | kinematics_exact_linkages | k | 48 | 3e-14° | 1e-12 | |
//! | kinematics_fourbar | k | 20 | 1e-13 rad/s² | 1e-11 | |
//! | kinematics_slider_crank | k | 56 | 1e-14 rad/s² | 1e-12 | |
//! | ladder_sliding | 1e-4 | 11 | 9e-9 rad | 2e-8 | 50: 2e-5 rad |
//! | pendulum_damped_modelica | 1e-4 | 12 | 5e-7 rad | 1e-6 | 10: 5e-5 rad |
//! | pendulum_iftomm_a01 | 1e-4 | 17 | 4e-3 N (1e-4 m) after 2000 s | 1e-2 (5e-4) | 10: 9e-5 m in 10 s; –, two million steps |
//! | pendulum_period_table | 1e-4 | 15 | 7e-8 s | 3e-7 | 10: 8e-6 s; – from 150°, rounding near the top |
//! | pendulum_sundials_period2 | 1e-4 | 17 | 1e-5 m/s after 30 s | 5e-5 | 20: 3e-5 m in 30 s |
//! | rod_pendulum_reactions | 1e-4 | 15 | 1.4e-6 N | 5e-6 | 20: 5e-4 N |
//! | slider_crank_matlab_exudyn | 1e-5 | 18 | 3e-5 rad after 19 turns | 1e-4 | 10: 9e-5 m in 2 s; – later |
//! | slider_crank_sundials | 1e-4 | 24 | 4e-9 rad | 2e-8 | 50: 1.2e-5 rad/s |
//! | slotted_pendulum_modelica | 1e-4 | 20, twice | 2.4e-7 m/s | 1e-6 | 10: 3e-5 rad/s |
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

/// A mechanism that is declared as it stands here, and in [`in_loops`] with loops.
macro_rules! declared {
    ($($declaration:tt)*) => {
        mbs_runtime::mechanism! { $($declaration)* }
    };
}

mod adams_joint_tests;
mod andrews_squeezer;
mod baumgarte_decay;
mod cart_npendulum_sympy;
mod double_fourbar_a02;
mod double_pendulum_chrono;
mod double_pendulum_modes;
mod double_pendulum_points_exudyn;
mod fourbar_drake_equilibrium;
mod fourbar_nikravesh_statics;
mod fourbar_ondsel_driven;
mod fourbar_sympy_matrices;
mod heun_oscillator;
mod in_loops;
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
