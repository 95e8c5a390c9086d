//! Published results and closed forms, one module per case.
#![allow(clippy::excessive_precision, reason = "references are copied with all their digits")]

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
