//! Mechanisms of any size are mechanisms: a four-bar of 1 nm and one of 10¹⁰ m,
//! with masses from 1e-300 to 1e300 kg, moves as the one of 1 m does.

use mbs_runtime::{Error, Simulation, mechanism};

/// A four-bar of this size (in m) and mass (in kg), which coasts at 1 rad/s: its
/// motion does not depend on either.
macro_rules! four_bar {
    ($name:ident, $size:literal, $mass:literal) => {
        mechanism! {
            /// A four-bar that coasts.
            pub $name {
                dof = 1;
                const s = $size [m];
                const m = $mass [kg];
                body crank   (x1, y1, p1) { mass = m; inertia = 0.1*m*s^2; }
                body coupler (x2, y2, p2) { mass = 2*m; inertia = 0.3*m*s^2; }
                body rocker  (x3, y3, p3) { mass = m; inertia = 0.2*m*s^2; }
                point tip on crank = (0.5*s, 0);
                point tip on coupler = (1.2*s, 0);
                point tip on rocker = (s, 0);
                point far on ground = (1.55*s, 0);
                revolute o (crank, ground);
                revolute a (crank.tip, coupler);
                revolute b (coupler.tip, rocker.tip);
                revolute c (rocker, ground.far);
                start { p1 = 60 [deg]; der(p1) = 1 [rad/s]; guess p2 = 30 [deg]; guess p3 = 100 [deg]; }
            }
        }
    };
}

four_bar!(Metre, 1, 1);
four_bar!(Nanometre, 1e-9, 1e-18);
four_bar!(Orbit, 1e10, 1e24);
four_bar!(Heavy, 1, 1e300);
four_bar!(Light, 1, 1e-300);

/// The crank's angle after a second and a half.
macro_rules! angle {
    ($name:ident) => {{
        let mut run = Simulation::new($name::declared(), 1e-3)?;
        run.advance_to(1.5)?;
        run.state().q.p1
    }};
}

#[test]
fn motion_does_not_depend_on_size_or_mass() -> Result<(), Error> {
    let expected = angle!(Metre);
    // 1500 steps of some 500 operations each, in a motion that amplifies errors by
    // no more than its length; scales are no powers of two, so that all of it rounds
    let tolerance = 1500.0 * 500.0 * f64::EPSILON;
    for (name, found) in [
        ("nanometre", angle!(Nanometre)),
        ("orbit", angle!(Orbit)),
        ("heavy", angle!(Heavy)),
        ("light", angle!(Light)),
    ] {
        assert!((found - expected).abs() < tolerance, "{name}: {found} for {expected}");
    }
    Ok(())
}
