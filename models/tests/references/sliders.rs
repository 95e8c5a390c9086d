//! Mechanisms with slots, rams and pistons.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use mbs_runtime::{Kinematics, NoComponents};
use models::{
    GenevaPinSlot, QuickReturn, ScotchYoke, ScotchYokeInputs, Tipper, TogglePress, TogglePressInputs,
    TogglePressParameters, VEngine,
};

use super::{EXACT, along, near};

#[test]
fn quick_return_lever_and_ram() {
    let mechanism = QuickReturn::declared();
    let p = *mechanism.parameters();
    along(mechanism, Default::default(), TAU / p.omega, 200, |at| {
        let (sin, cos) = (p.omega * at.t).sin_cos();
        let lever = (p.crank_length * sin + p.offset).atan2(p.crank_length * cos);
        near("lever", at.outputs.lever_angle, lever, EXACT);
        let (tip_x, tip_y) = (p.lever_length * lever.cos(), p.lever_length * lever.sin() - p.offset);
        let ram = tip_x + (p.link_length.powi(2) - (p.ram_height - tip_y).powi(2)).sqrt();
        near("ram", at.outputs.ram_position, ram, EXACT);
    });
}

/// The lever stands where the crank is across it: at −α and at π + α, so the
/// strokes take as long as (π + 2α) : (π − 2α).
#[test]
fn quick_return_time_ratio() {
    let mechanism = QuickReturn::declared();
    let p = *mechanism.parameters();
    let alpha = (p.crank_length / p.offset).asin();
    let mut kinematics = Kinematics::new(mechanism).unwrap();
    let mut at = |angle: f64| kinematics.at(angle / p.omega).unwrap().state;
    let right = at(-alpha);
    for k in 0..20 {
        let moving = at(-alpha + 0.1 + (PI + 2.0 * alpha - 0.2) * f64::from(k) / 19.0);
        assert!(moving.v.phi > 0.0, "the slow stroke goes one way only");
    }
    let left = at(PI + alpha);
    // rates are of the size of ω
    near("rate at the right", right.v.phi, 0.0, 10.0 * EXACT);
    near("rate at the left", left.v.phi, 0.0, 10.0 * EXACT);
    near("swing", left.q.phi - right.q.phi, 2.0 * alpha, EXACT);
}

#[test]
fn scotch_yoke_is_harmonic() {
    let mechanism = ScotchYoke::declared();
    let p = *mechanism.parameters();
    let load = 20.0;
    along(mechanism, ScotchYokeInputs { load }, TAU / p.omega, 100, |at| {
        let (sin, cos) = (p.omega * at.t).sin_cos();
        near("x", at.motion.state.q.x, p.radius * cos, EXACT);
        near("ẋ", at.motion.state.v.x, -p.radius * p.omega * sin, EXACT);
        near("ẍ", at.motion.acceleration.x, -p.radius * p.omega * p.omega * cos, 1e2 * EXACT);
        let inertia = p.yoke_mass * (p.radius * p.omega).powi(2) * sin * cos;
        near("torque", at.outputs.drive_torque, inertia - load * p.radius * sin, EXACT);
    });
}

#[test]
fn geneva_wheel_while_driven() {
    let mechanism = GenevaPinSlot::declared();
    let p = *mechanism.parameters();
    let share = (PI / p.slots).sin();
    let (arm, entry) = (p.distance_of_shafts * share, FRAC_PI_2 - PI / p.slots);
    along(mechanism, NoComponents::default(), 2.0 * entry / p.omega, 200, |at| {
        let (sin, cos) = (p.omega * at.t - entry).sin_cos();
        let wheel = -(arm * sin).atan2(p.distance_of_shafts - arm * cos);
        near("wheel", at.outputs.wheel_angle, wheel, EXACT);
        let rate = at.motion.state.v.phi;
        let tolerance = 10.0 * EXACT;
        if at.t == 0.0 {
            near("angle at entry", wheel, PI / p.slots, EXACT);
            near("rate at entry", rate, 0.0, tolerance);
        }
        if (p.omega * at.t - entry).abs() < 1e-12 {
            near("rate in the middle", rate, -p.omega * share / (1.0 - share), tolerance);
        }
    });
}

/// In slow motion, 1e-9 rad/s, inertia does not matter: the forces are static.
#[test]
fn toggle_press_travel_and_amplification() {
    let p = TogglePressParameters { omega: 1e-9, ..Default::default() };
    let work = 1000.0;
    along(TogglePress::new(p).unwrap(), TogglePressInputs { work }, PI / p.omega, 100, |at| {
        let knee =
            f64::midpoint(p.farthest, p.nearest) + (p.farthest - p.nearest) / 2.0 * (p.omega * at.t).cos();
        let alpha = (knee / p.link).asin();
        near("angle", at.outputs.toggle_angle, alpha, EXACT);
        near("travel", at.outputs.ram_travel, 2.0 * p.link * (1.0 - alpha.cos()), EXACT);
        near("force", at.outputs.actuator_force, -work * 2.0 * alpha.tan(), work * EXACT);
        near("amplification", at.outputs.amplification, 0.5 / alpha.tan(), 1e2 * EXACT);
    });
}

#[test]
fn v_engine_pistons() {
    let mechanism = VEngine::declared();
    let p = *mechanism.parameters();
    along(mechanism, Default::default(), TAU / p.omega, 200, |at| {
        let piston = |bore: f64| {
            let (sin, cos) = (p.omega * at.t - bore).sin_cos();
            p.crank_length * cos + (p.rod_length.powi(2) - (p.crank_length * sin).powi(2)).sqrt()
        };
        near("piston 1", at.outputs.piston1_position, piston(FRAC_PI_2 - p.v_angle / 2.0), EXACT);
        near("piston 2", at.outputs.piston2_position, piston(FRAC_PI_2 + p.v_angle / 2.0), EXACT);
    });
}

#[test]
fn tipper_is_a_triangle() {
    let mechanism = Tipper::declared();
    let p = *mechanism.parameters();
    let (a, below) = (p.foot_x.hypot(p.foot_depth), p.foot_depth.atan2(p.foot_x));
    along(mechanism, NoComponents::default(), TAU / p.omega, 100, |at| {
        let s =
            f64::midpoint(p.shortest, p.longest) - (p.longest - p.shortest) / 2.0 * (p.omega * at.t).cos();
        let tilt = ((a * a + p.lug * p.lug - s * s) / (2.0 * a * p.lug)).acos() - below;
        near("tilt", at.outputs.tilt, tilt, EXACT);
    });
}
