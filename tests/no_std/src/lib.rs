//! A plant model as it would run in firmware: started, stepped with an input,
//! its reactions read. Its panic handler calls a function that exists nowhere,
//! so it links only if no panic is reachable.
#![no_std]

use core::panic::PanicInfo;

use mbs_runtime::{
    Adaptive, Baumgarte, Direction, Dual, Held, Kinematics, Mechanism, PerStage, Projected, Real, Rk4,
    Simulation, State, Tolerances, mechanism,
};

mechanism! {
    /// Slider-crank with a motor.
    pub Crank {
        dof = 1;
        param l1 = 60 [mm] where l1 > 0;
        param l2 = 180 [mm] where l2 > 0;
        param m1 = 0.5 [kg];
        param m2 = 1.2 [kg];
        param m3 = 2.0 [kg];
        input torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = m1; inertia = m1*l1^2/12; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = m2*l2^2/12; }
        body slider (x3)             { mass = m3; }
        torque motor on crank = torque;
        constraint crank_x: x1 = l1/2*cos(theta1);
        constraint crank_y: y1 = l1/2*sin(theta1);
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);
        start { theta1 = 0; der(theta1) = 200 [rpm]; }
    }
}

mechanism! {
    /// A driven mass whose drive uses the elementary functions and a profile.
    pub Cam {
        dof = 0;
        param lift = 5 [mm];
        param omega = 10 [rad/s];
        profile wave = spline((0, 0), (1, 0.4), (2.5, -0.2)) period 4;
        body follower (x) { mass = 1 [kg]; }
        drive cam: x = lift*(exp(sin(omega*t)) + atan2(1, 2 + cos(omega*t)) + (2 + sin(omega*t))^0.7
            + sqrt(2 + cos(omega*t)) + ln(3 + sin(omega*t)) + tanh(omega*t) + tan(0.1*sin(omega*t))
            + asin(0.5*cos(omega*t)) + acos(0.5*cos(omega*t)) + atan(omega*t) + wave(omega*t));
        output force [N] = effort(cam);
    }
}

unsafe extern "C" {
    fn a_panic_is_reachable() -> !;
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    unsafe { a_panic_is_reachable() }
}

/// Runs everything on values that no compiler knows, in `out[0 .. 16]`.
///
/// # Safety
/// `out` points to 16 values.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn entry(out: *mut f64) {
    let value = |at: usize| unsafe { out.add(at).read_volatile() };
    let put = |at: usize, x: f64| unsafe { out.add(at).write_volatile(x) };
    put(0, run::<f64>(&value).unwrap_or(f64::NAN));
    put(1, run::<f32>(&value).unwrap_or(f64::NAN));
    put(3, run::<Dual<f64, 2>>(&value).unwrap_or(f64::NAN));
    #[cfg(feature = "reachable-panic")]
    put(2, [1.0, 2.0, 3.0][value(2) as usize]);
}

fn run<T: Real>(value: &dyn Fn(usize) -> f64) -> Option<f64> {
    let parameters =
        CrankParameters::<T> { l1: T::from_f64(value(0)), m1: T::from_f64(value(1)), ..Default::default() };
    let crank = Crank::new(parameters).ok()?;
    let step = value(2);
    let gains = Baumgarte::<PerStage>::new(value(3), value(4)).ok()?;
    let mut per_stage = Simulation::builder(crank, step).baumgarte(gains).build().ok()?;
    let mut held =
        Simulation::builder(crank, step).baumgarte(Baumgarte::<Held>::deadbeat(step)).build().ok()?;
    let torque = T::from_f64(value(5));
    per_stage.inputs_mut().torque = torque;
    held.inputs_mut().torque = torque;
    per_stage.advance_to(value(6)).ok()?;
    held.advance_to(value(6)).ok()?;
    let reactions = held.reactions().ok()?;
    let raw = per_stage.raw_reactions().ok()?;

    let cam = Cam::<T>::default();
    let mut kinematics = Kinematics::new(cam).ok()?;
    let motion = kinematics.at(T::from_f64(value(7))).ok()?;
    let mut driven = Simulation::new(cam, step).ok()?;
    driven.step().ok()?;
    let force = driven.outputs().ok()?.force;
    let known = cam.phi_q(T::from_f64(0.0), &motion.state.q);
    let sum =
        reactions.multipliers.guide + raw.multipliers.guide + force + motion.acceleration.x + known[(0, 0)];
    let energies = held.energy() + per_stage.violation() + crank.declared_start().q.theta1;
    Some((sum + energies + to_a_tolerance(crank, value)?).to_f64())
}

/// With projection, and steps that follow from a tolerance.
fn to_a_tolerance<T: Real>(crank: Crank<T>, value: &dyn Fn(usize) -> f64) -> Option<T> {
    let mut projected = Simulation::builder(crank, value(2)).method::<Projected<Rk4>>().build().ok()?;
    projected.advance_to(value(6)).ok()?;
    let tolerances = Tolerances { rtol: value(8), atol: value(9), ..Tolerances::default() };
    let mut adaptive = Adaptive::builder(crank).tolerances(tolerances).build().ok()?;
    adaptive.advance_to(value(6)).ok()?;
    let middle = adaptive.at(value(7)).ok()?;
    let turned = |at: &State<CrankCoordinates<T>>| [at.q.theta1, at.v.theta1];
    let directions = [Direction::Rising, Direction::Falling];
    let event = adaptive.advance_until(value(10), directions, turned).ok()?;
    let t = T::from_f64(event.map_or(0.0, |event| event.t));
    Some(projected.violation() + middle.q.theta1 + adaptive.state().v.theta1 + t)
}
