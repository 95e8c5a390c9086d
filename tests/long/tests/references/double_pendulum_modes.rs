//! Normal modes of double pendulums about the hanging position.
//!
//! Classical: equal point masses and lengths have ω² = (g/l)(2 ∓ √2) and
//! φ₂/φ₁ = ±√2; two uniform rods of 1 m and 1 kg have the modes of
//! [4/3 1/2; 1/2 1/3] φ̈ + g diag(3/2, 1/2) φ = 0. g = 9.81.
//!
//! The linearisation is the central difference of the mechanism's own
//! accelerations, no step and no feedback. Limit: the difference, ε² = 1e-10
//! from the sine's cubic term, 1e-11 from rounding.

use mbs_runtime::{Error, Mechanism, Simulation, mechanism, start};
use paths::Case;

mechanism! {
    Points {
        dof = 2;
        const length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1, phi1) { mass = 1 [kg]; inertia = 0; }
        body lower (x2, y2, phi2) { mass = 1 [kg]; inertia = 0; }
        point top on upper = (0, length);
        point top on lower = (0, length);
        revolute hook (upper.top, ground);
        revolute elbow (lower.top, upper);
        start { phi1 = 0; phi2 = 0; }
    }
}

mechanism! {
    Rods {
        dof = 2;
        const length = 1 [m];
        const mass = 1 [kg];
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1, phi1) { mass = mass; inertia = mass*length^2/12; }
        body lower (x2, y2, phi2) { mass = mass; inertia = mass*length^2/12; }
        point top on upper = (0, length/2);
        point bottom on upper = (0, -length/2);
        point top on lower = (0, length/2);
        revolute hook (upper.top, ground);
        revolute elbow (lower.top, upper.bottom);
        start { phi1 = 0; phi2 = 0; }
    }
}

/// ω and φ₂/φ₁ of both modes of φ̈ = A φ.
fn modes(a: [[f64; 2]; 2]) -> [(f64, f64); 2] {
    let half_trace = f64::midpoint(a[0][0], a[1][1]);
    let determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    let root = (half_trace * half_trace - determinant).sqrt();
    [half_trace + root, half_trace - root].map(|eigen| ((-eigen).sqrt(), (eigen - a[0][0]) / a[0][1]))
}

/// ∂φ̈/∂φ at rest; `accelerations` gives φ̈ of two angles.
fn linearised(accelerations: impl Fn([f64; 2]) -> Result<[f64; 2], Error>) -> Result<[[f64; 2]; 2], Error> {
    let epsilon = 1e-5;
    let mut slope = [[0.0; 2]; 2];
    for column in 0..2 {
        let mut phi = [0.0; 2];
        phi[column] = epsilon;
        let (ahead, behind) = (accelerations(phi)?, accelerations(phi.map(|x| -x))?);
        for row in 0..2 {
            slope[row][column] = (ahead[row] - behind[row]) / (2.0 * epsilon);
        }
    }
    Ok(slope)
}

fn points([phi1, phi2]: [f64; 2]) -> Result<[f64; 2], Error> {
    let mut state = Points::<f64>::declared().declared_start();
    (state.q.phi1, state.q.phi2) = (phi1, phi2);
    let state = start::consistent(&Points::declared(), &state)?;
    let at = Simulation::builder(Points::declared(), 1e-3).from_state(state).build()?;
    let a = at.reactions()?.acceleration;
    Ok([a.phi1, a.phi2])
}

fn rods([phi1, phi2]: [f64; 2]) -> Result<[f64; 2], Error> {
    let mut state = Rods::<f64>::declared().declared_start();
    (state.q.phi1, state.q.phi2) = (phi1, phi2);
    let state = start::consistent(&Rods::declared(), &state)?;
    let at = Simulation::builder(Rods::declared(), 1e-3).from_state(state).build()?;
    let a = at.reactions()?.acceleration;
    Ok([a.phi1, a.phi2])
}

#[test]
fn double_pendulum_modes() -> Result<(), Error> {
    let mut case = Case::new("double_pendulum_modes");
    let sqrt2 = std::f64::consts::SQRT_2;
    let of_points = modes(linearised(points)?);
    let of_rods = modes(linearised(rods)?);
    for (what, (omega, ratio), (omega_reference, ratio_reference)) in [
        ("points, mode 1", of_points[0], ((9.81 * (2.0 - sqrt2)).sqrt(), sqrt2)),
        ("points, mode 2", of_points[1], ((9.81 * (2.0 + sqrt2)).sqrt(), -sqrt2)),
        ("rods, mode 1", of_rods[0], (2.6801140122533753, 1.4305008740430605)),
        ("rods, mode 2", of_rods[1], (7.188670870287714, -2.097167540709727)),
    ] {
        case.near(format_args!("frequency of {what}"), omega, omega_reference, 3e-9);
        case.near(format_args!("ratio of {what}"), ratio, ratio_reference, 3e-9);
    }
    case.finish();
    Ok(())
}
