//! Laws that every mechanism of the library obeys, whatever it does: its reactions balance forces and
//! moments, its energy changes by the power that goes in, its constraints stay closed.
//!
//! Energies are differentiated by dual numbers. Drift falls as the order of the method demands.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

mod balance;
mod drift;
mod model;
mod of_texts;
mod random;
mod texts;

use mbs_runtime::{Components, Dual, Mechanism, State};
use models::{
    AndrewsSqueezer, BlockOnIncline, BoomCylinder, Brake, CamFollower, CartPendulum, CartPole,
    ChaplyginSleigh, Chebyshev, CraneRope, DcMotor, DifferentialDrive, DoublePendulum, DropHammer,
    ElasticCrank, Engine, Excavator, FourBar, FourBarFree, GearedMotor, GenevaPinSlot, HartInversor, Jansen,
    JansenWalker, Klann, Metronome, NFourBar1, NFourBar2, NFourBar10, NFourBar40, NPendulum1, NPendulum2,
    NPendulum10, NPendulum40, NewtonsCradle, Pantograph, PathFollower, Peaucellier, Pendulum, PlanetaryGear,
    QuickReturn, ScotchYoke, SliderCrank, SliderCrankFree, SpringMassDamper, Suspension, Tipper, TogglePress,
    TrammelOfArchimedes, VEngine, WattLinkage,
};

use paths::STRIDE;

use crate::model::{Model, model};

/// How a mechanism is to be tested.
pub struct Case<M: Mechanism> {
    /// As in the library.
    pub name: &'static str,
    /// Step of the long run in s.
    pub step: f64,
    /// Length of the long run in s.
    pub end: f64,
    /// Parameters that take energy, to be 0 in the long run.
    pub without: &'static [&'static str],
    /// The power of inputs and dampers.
    pub power: Power<M>,
}

/// Power of everything that is neither gravity, spring nor drive, in W.
type Power<M> = fn(
    &<M as Mechanism>::Parameters,
    &State<<M as Mechanism>::Coordinates>,
    &<M as Mechanism>::Inputs,
) -> f64;

/// A row per mechanism: step and length of the long run, parameters to leave
/// out in it, and the power of inputs and dampers written out by hand.
macro_rules! library {
    ($($Name:ident: $step:literal, $end:literal, $without:expr, $power:expr;)*) => {
        $(model!($Name);)*

        const NAMES: &[&str] = &[$(stringify!($Name)),*];

        enum Place {
            $($Name),*
        }

        fn texts() {
            $(if const { (Place::$Name as usize).is_multiple_of(STRIDE) } {
                texts::same::<$Name>(stringify!($Name));
            })*
        }

        fn laws() {
            $(if const { (Place::$Name as usize).is_multiple_of(STRIDE) } {
                let case = case::<$Name>(stringify!($Name), $step, $end, &$without, $power);
                balance::reactions(&case);
                balance::power(&case);
                drift::check(&case);
            })*
        }
    };
}

fn case<M: Model>(
    name: &'static str,
    step: f64,
    end: f64,
    without: &'static [&'static str],
    power: Power<M>,
) -> Case<M> {
    Case { name, step, end, without, power }
}

library! {
    SliderCrank: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    SliderCrankFree: 0.5e-3, 10.0, [], |_, at, u| u.crank_torque*at.v.theta1;
    Pendulum: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    DoublePendulum: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NPendulum1: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NPendulum2: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NPendulum10: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NPendulum40: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    CartPendulum: 0.5e-3, 10.0, [], |_, at, u| u.push*at.v.x;
    SpringMassDamper: 0.5e-3, 10.0, ["damping"], |p, at, u| (u.push - p.damping*at.v.x)*at.v.x;
    Metronome: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    BlockOnIncline: 0.5e-3, 10.0, ["coefficient"], |p, at, u| {
        let (s, c) = p.slope.sin_cos();
        let v = at.v.x*c + at.v.y*s;
        (u.push - p.coefficient*p.mass*9.81*c*(v/p.transition).tanh())*v
    };
    FourBar: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    FourBarFree: 0.5e-3, 10.0, [], |_, at, u| u.crank_torque*at.v.theta2;
    NFourBar1: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NFourBar2: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NFourBar10: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    NFourBar40: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    QuickReturn: 0.5e-3, 10.0, [], |_, at, u| u.cutting_force*at.v.x3;
    ScotchYoke: 0.5e-3, 10.0, [], |_, at, u| -u.load*at.v.x;
    GenevaPinSlot: 0.5e-3, 10.0, [], |p, at, _| -p.friction*at.v.phi.powi(2);
    // ten steps from point to point of its profile, so that the jumps of the
    // spline's third derivative are not inside a step
    CamFollower: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    TogglePress: 0.5e-3, 10.0, [], |_, at, u| u.work*at.v.y3;
    VEngine: 0.5e-3, 10.0, [], |p, at, u| {
        let (s, c) = (p.v_angle/2.0).sin_cos();
        -u.gas1*(s*at.v.x3 + c*at.v.y3) - u.gas2*(-s*at.v.x4 + c*at.v.y4)
    };
    Excavator: 0.5e-3, 10.0, [], |p, at, u| {
        u.resistance*(at.v.x3 - p.bucket_length/2.0*at.q.phi3.sin()*at.v.phi3)
    };
    Tipper: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    AndrewsSqueezer: 1e-5, 1.0, [], |_, at, u| u.motor_torque*at.v.angle1;
    PlanetaryGear: 0.5e-3, 10.0, [], |_, at, u| u.sun_torque*at.v.alpha + u.load*at.v.beta;
    GearedMotor: 0.5e-3, 10.0, ["stall", "viscous"], |p, at, u| {
        p.stall*(1.0 - at.v.phi1/p.no_load)*at.v.phi1 + (u.load - p.viscous*at.v.phi2)*at.v.phi2
    };
    DcMotor: 0.5e-3, 10.0, ["constant"], |p, at, u| (p.constant*at.v.current + u.load)*at.v.theta;
    // without spring, damper and tyre it falls
    Suspension: 0.5e-3, 10.0, ["spring", "damper", "tyre_stiffness"], |p, at, _| power_of_suspension(p, at);
    // without rope and floor the load falls
    CraneRope: 0.5e-3, 10.0, ["stiffness", "damping", "floor_stiffness", "hoist", "travel"], |p, at, _| {
        let (dx, dy) = (at.q.x - at.q.x_h, at.q.y - at.q.y_h);
        let d = (dx*dx + dy*dy).sqrt();
        let (s, rate) = (d - p.rope_length, (dx*(at.v.x - at.v.x_h) + dy*(at.v.y - at.v.y_h))/d);
        // beside what its spring stores
        let rope = if s > 0.0 { (p.stiffness*s - (p.stiffness*s + p.damping*rate).max(0.0))*rate } else { 0.0 };
        rope + p.floor_stiffness*(-p.height - at.q.y).max(0.0)*at.v.y
    };
    // cold: the own states are below 5 K
    Brake: 0.5e-3, 10.0, ["press"], |p, at, u| {
        let grip = 2.0*p.press*p.radius*p.cold*(at.v.theta/p.transition).tanh();
        (u.drive - grip)*at.v.theta
    };
    Engine: 0.5e-3, 10.0, ["gas", "starter", "viscous", "load"], |p, at, u| {
        let omega = at.v.theta;
        let starter = p.starter*(1.0 - omega/p.starter_speed).max(0.0);
        // the gas gives what its work grows by, a state
        let found = Engine::new(*p).unwrap().reactions(at, u, &Components::splat(0.0));
        found.acceleration.gas_work + (starter - p.viscous*omega - p.load*omega*omega.abs())*omega
    };
    BoomCylinder: 0.5e-3, 10.0, ["cylinder"], |p, at, _| {
        let ((sin, cos), arm) = (at.q.phi.sin_cos(), -p.boom_length/10.0);
        let (dx, dy) = (
            at.q.x_b + arm*cos - 0.15*p.boom_length,
            at.q.y_b + arm*sin + 0.225*p.boom_length,
        );
        let (vx, vy) = (at.v.x_b - arm*sin*at.v.phi, at.v.y_b + arm*cos*at.v.phi);
        let rate = (dx*vx + dy*vy)/(dx*dx + dy*dy).sqrt();
        let [area_a, area_b] =
            [p.bore*p.bore, p.bore*p.bore - p.rod*p.rod].map(|square| std::f64::consts::PI/4.0*square);
        p.cylinder*(area_a*at.v.p_a - area_b*at.v.p_b - p.viscous*rate)*rate
    };
    ChaplyginSleigh: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    DifferentialDrive: 0.5e-3, 10.0, [], |_, at, u| u.left_torque*at.v.alpha + u.right_torque*at.v.beta;
    CartPole: 0.5e-3, 10.0, ["motor"], |p, at, u| (p.motor*u.push + u.disturbance)*at.v.x;
    PathFollower: 0.5e-3, 10.0, ["motors"], |p, at, u| {
        p.motors*(u.left_torque*at.v.alpha + u.right_torque*at.v.beta)
    };
    ElasticCrank: 2e-5, 1.0, ["damping_ratio", "speed"], |p, at, _| {
        let mass = p.density*p.side.powi(2)*p.rod_length;
        let stiffness = std::f64::consts::PI.powi(4)*p.modulus*p.side.powi(4)/(24.0*p.rod_length.powi(3));
        -2.0*p.damping_ratio*(stiffness*mass/2.0).sqrt()*at.v.w.powi(2)
    };
    // until the first impact
    DropHammer: 0.5e-3, 0.2, ["stall"], |p, s, _| p.stall*(1.0 - s.v.phi/p.no_load)*s.v.phi;
    NewtonsCradle: 0.5e-3, 0.2, [], |_, _, _| 0.0;
    Peaucellier: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    HartInversor: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    Chebyshev: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    WattLinkage: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    TrammelOfArchimedes: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    Pantograph: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    Jansen: 0.5e-3, 10.0, [], |_, at, u| u.beach*at.v.yf;
    JansenWalker: 0.5e-3, 10.0, [], |_, _, _| 0.0;
    Klann: 0.5e-3, 10.0, [], |_, at, u| u.support*at.v.yf;
}

/// The strut takes the power of its tension, which the road's bump does not change; the tyre gives the wheel's.
fn power_of_suspension(
    p: &<Suspension as Mechanism>::Parameters,
    at: &State<<Suspension as Mechanism>::Coordinates>,
) -> f64 {
    let between = |points: &[(f64, f64)], x: f64| {
        let piece = points.windows(2).rfind(|pair| pair[0].0 <= x).unwrap_or(&points[..2]);
        piece[0].1 + (piece[1].1 - piece[0].1) / (piece[1].0 - piece[0].0) * (x - piece[0].0)
    };
    let spring = [(0.2, 12e3), (0.25, 5.2e3), (0.5, 0.2e3), (0.52, -2e3)];
    let damper = [(-2.0, -0.9e3), (-0.1, -0.12e3), (0.1, 0.12e3), (2.0, 2.7e3)];
    let (apart, opening) = (at.q.y_c - at.q.y_w, at.v.y_c - at.v.y_w);
    // a distance has no sign
    let (length, rate) = (apart.abs(), opening * apart.signum());
    let tension = p.damper * between(&damper, rate) - p.spring * between(&spring, length);
    let u = p.speed * at.t - 1.0;
    let road = if (0.0..1.0).contains(&u) { 4.0 * u * (1.0 - u) } else { 0.0 };
    -tension * rate + p.tyre_stiffness * (p.bump * road - at.q.y_w).max(0.0) * at.v.y_w
}

/// In any state M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ, and the energy changes by the power of drives, inputs and dampers.
/// Over a long run, with half the step, violations and energy drift fall as the order of the method demands. The
/// code of mechanisms that are not tried is not made: it takes rustc two seconds each.
#[test]
fn laws_hold() {
    println!("{}", drift::HEADING);
    laws();
}

/// A mechanism that is added to the library has to be added to the command, and here.
#[test]
fn no_mechanism_is_left_out() {
    let known: Vec<_> = mbs::library().iter().filter_map(|entry| entry.mechanism).collect();
    assert_eq!(NAMES, known, "rows here, then the library of the command");
    let sources = include_str!("../../src/lib.rs");
    for file in sources.lines().filter_map(|line| line.strip_prefix("pub mod ")) {
        let file = file.trim_end_matches(';').replace('_', "-");
        let is_known =
            mbs::library().iter().any(|entry| entry.name == file || entry.name == format!("{file}-1"));
        assert!(is_known, "the command does not know `{file}`");
    }
}

/// Compiled by rustc or run from its text, a mechanism does the same to the last bit, and
/// says the same of itself.
#[test]
fn a_text_is_its_type() {
    texts();
}
