//! Runs of many steps: methods, stops, and what limits their digits. One program, so that runs to a tolerance are compiled
//! once for all of them.

mod digits;
mod implicit;
mod rattle;
mod schemes;
mod stops;
