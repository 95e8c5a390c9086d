//! Runs: their methods, starts, ends, errors and derivatives; what looks at them; and many of them at once.

mod adaptive;
mod dual_runs;
mod ensemble;
mod ensemble_progress;
mod errors;
mod events;
mod kinematics;
mod library_gradients;
mod observer;
mod order;
mod rk4;
mod sketch;
mod spans;
mod stability;
mod start;
mod stiff;
