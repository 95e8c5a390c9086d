//! Friction that jams is an error, and never a number that solves nothing.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Error, Simulation, mechanism};

mechanism! {
    /// A rod in two guides, pushed at a handle: each friction presses on both guides.
    Drawer {
        dof = 1;
        param mu = 0.2;
        param nu = 0.2;
        param arm = 1 [m];
        param front = 0.25 [m];
        param rear = 0.25 [m];
        param height = 0.1 [m];
        param push = 10 [N];
        param lift = 3 [N];
        body rod (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point front on rod = (front, height);
        point rear on rod = (-rear, -height);
        point handle on rod = (0, arm);
        point ahead on ground = (0, height);
        point behind on ground = (0, -height);
        point_on_line a (rod.front, ground.ahead) along (1, 0);
        point_on_line b (rod.rear, ground.behind) along (1, 0);
        friction rub_a (rod.front, ground) along (1, 0) {
            coefficient = mu; normal = lambda(a); transition = 1e-3 [m/s];
        }
        friction rub_b (rod.rear, ground) along (1, 0) {
            coefficient = nu; normal = lambda(b); transition = 1e-3 [m/s];
        }
        force push on rod.handle = (push, lift);
        start { x = 0; der(x) = 1 [m/s]; }
        output rub_a [N] = force(rub_a);
        output rub_b [N] = force(rub_b);
    }
}

/// Uniform in 0 … 1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }
}

/// Regression: with coefficients times geometry of 1 and more, Newton's steps ended
/// anywhere, and one in a thousand was `Ok` with a friction of another size than that of
/// its guide.
#[test]
fn friction_is_that_of_its_guide_or_an_error() {
    let mut random = Random(7);
    let (mut solved, mut jammed) = (0, 0);
    for _ in 0..52_000 {
        let parameters = DrawerParameters {
            mu: random.within(0.0, 1.5),
            nu: random.within(0.0, 1.5),
            arm: random.within(-1.0, 1.0),
            front: random.within(0.05, 0.5),
            rear: random.within(0.05, 0.5),
            height: random.within(-0.5, 0.5),
            push: random.within(-20.0, 20.0),
            lift: random.within(-20.0, 20.0),
        };
        let run = Simulation::new(Drawer::new(parameters).expect("parameters"), 1e-4).expect("a start");
        let reactions = match run.reactions() {
            Ok(reactions) => reactions,
            Err(error) => {
                assert!(matches!(error, Error::Singular { constraint: "", coordinate: "", .. }), "{error:?}");
                jammed += 1;
                continue;
            }
        };
        solved += 1;
        let outputs = run.outputs().expect("outputs");
        // the frictions are those of the reactions; the motion has to be theirs
        let rest = 2.0 * reactions.acceleration.x - parameters.push - outputs.rub_a - outputs.rub_b;
        let size = 1.0 + outputs.rub_a.abs() + outputs.rub_b.abs();
        assert!(rest.abs() < 1e-5 * size, "{rest} N: {parameters:?}");
    }
    println!("{solved} solved, {jammed} jammed");
    assert!(solved > 25_000 && jammed > 100, "{solved} {jammed}");
}

/// Coefficients that a guide has are no trouble: L stays below 1/3.
#[test]
fn common_friction_is_always_solved() {
    let mut random = Random(11);
    for _ in 0..5_000 {
        let parameters = DrawerParameters {
            mu: random.within(0.0, 0.2),
            nu: random.within(0.0, 0.2),
            arm: random.within(-1.0, 1.0),
            front: 0.25,
            rear: 0.25,
            height: random.within(-0.1, 0.1),
            push: random.within(-20.0, 20.0),
            lift: random.within(-20.0, 20.0),
        };
        let run = Simulation::new(Drawer::new(parameters).expect("parameters"), 1e-4).expect("a start");
        run.reactions().expect("no jam");
    }
}
