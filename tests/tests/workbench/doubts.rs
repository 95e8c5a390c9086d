//! Runs that went through but are not to be trusted, each with its reason.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_workbench::{Doubt, Settings, model};

mbs_runtime::mechanism! {
    /// A weight on a rod.
    pub Swing {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        start { x = 1 [m]; guess y = 0; }
    }
}

mbs_runtime::mechanism! {
    /// A weight on a spring.
    pub Bouncer {
        dof = 1;
        body bob (x) { mass = 1 [kg]; }
        spring s (bob, ground) { stiffness = 400 [N/m]; length = 1 [m]; }
        start { x = 1.1 [m]; }
        /// A number for half a second.
        output left = sqrt(1 - 2*t/(1 [s]));
    }
}

mbs_runtime::mechanism! {
    pub Damped {
        dof = 1;
        body bob (x) { mass = 1 [kg]; }
        spring s (bob, ground) { stiffness = 400 [N/m]; length = 1 [m]; damping = 4 [N*s/m]; }
        start { x = 1.1 [m]; }
    }
}

mbs_runtime::mechanism! {
    pub Pushed {
        dof = 1;
        body bob (x) { mass = 1 [kg]; }
        force push on bob = (1 [N], 0);
        start { x = 1.1 [m]; }
    }
}

fn doubts<M: mbs_runtime::Mechanism<Real = f64>>(settings: Settings) -> Vec<Doubt> {
    model::of::<M>().simulate(&settings, &mut |_, _| ()).unwrap().doubts
}

fn settings(step: f64, end: f64) -> Settings {
    Settings { step, end, ..Settings::default() }
}

#[test]
fn a_joint_that_comes_apart() {
    assert!(doubts::<Swing>(settings(1e-3, 5.0)).is_empty());
    let coarse = doubts::<Swing>(settings(0.1, 5.0));
    let Some(Doubt::Violation { constraint: "rod", value, size, .. }) = coarse.first() else {
        panic!("{coarse:?}")
    };
    assert!(*value > 1e-3 && *size == 1.0, "{coarse:?}");
}

#[test]
fn an_energy_that_nothing_changes() {
    assert!(doubts::<Bouncer>(settings(1e-3, 0.4)).is_empty());
    let change = |doubts: Vec<Doubt>| {
        doubts.into_iter().find_map(|doubt| match doubt {
            Doubt::Energy { change, .. } => Some(change),
            _ => None,
        })
    };
    // Heun's method gains energy where ωh is large; a damper takes it away.
    let gained = change(doubts::<Bouncer>(settings(20e-3, 0.4)));
    assert!(gained.is_some_and(|gained| gained > 0.0), "{gained:?}");
    assert_eq!(change(doubts::<Damped>(settings(20e-3, 0.4))), None);
    // Nor is it kept where a force without a potential acts.
    assert_eq!(change(doubts::<Pushed>(settings(20e-3, 0.4))), None);
}

mbs_runtime::mechanism! {
    /// Two rods over a base: nothing moves, and rounding made 2.6e-28 J.
    pub Triangle {
        dof = 0;
        body a (x1, y1, phi1) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        body b (x2, y2, phi2) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        point q on a = (0.5, 0) [m];
        point r on b = (0.5, 0) [m];
        point right on ground = (0.4, 0) [m];
        revolute foot (a, ground);
        revolute elbow (a.q, b);
        revolute hand (b.r, ground.right);
        start { guess phi1 = 60 [deg]; }
    }
}

#[test]
fn the_energy_of_what_is_at_rest_is_rounding() {
    let found = doubts::<Triangle>(settings(5e-4, 1.0));
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn a_value_that_is_no_number() {
    let doubts = doubts::<Bouncer>(settings(1e-3, 1.0));
    let [Doubt::NotFinite { name, value, at }] = doubts.as_slice() else { panic!("{doubts:?}") };
    assert!(name == "left" && value.is_nan() && (0.5..0.502).contains(at), "{doubts:?}");
    assert!(doubts[0].to_string().starts_with("`left` is NaN from t = 0.5"), "{}", doubts[0]);
}
