//! Dampers whose places coincide: forces, linear systems, derivatives and the order of runs that start there.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests")]

use mbs_analysis::{OperatingPoint, Ports, linearize};
use mbs_live::{Run, Text};
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{
    Components, Dual, Error, Explicit, Mechanism, Method, MethodVisitor, Real, Rk4, SCHEMES, Simulation,
    State, TrBdf2, mechanism, with_type,
};
use tests::random::Random;

mechanism! {
    /// A block on a line through the wall, at the wall: m ẍ + c ẋ + k x = −m g.
    pub Line {
        dof = 1;
        param k = 100 [N/m];
        param c = 4 [N*s/m];
        gravity = (0, -9.81) [m/s^2];
        body block (y) { mass = 1 [kg]; }
        spring coil (block, ground) { stiffness = k; length = 0; damping = c; }
        start { der(y) = 1 [m/s]; }
        output tension [N] = force(coil);
        output loss [W] = power(coil);
    }
}

mechanism! {
    /// The same in the plane, thrown in any direction.
    pub Plane {
        dof = 2;
        param k = 100 [N/m];
        param c = 4 [N*s/m];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = 1 [kg]; }
        spring coil (block, ground) { stiffness = k; length = 0; damping = c; }
        start { der(y) = 1 [m/s]; }
        output tension [N] = force(coil);
        output loss [W] = power(coil);
    }
}

mechanism! {
    /// A damper alone between points of two bodies that move and turn.
    pub Dashpot {
        dof = 6;
        param c = 7 [N*s/m];
        body a (xa, ya, phia) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body b (xb, yb, phib) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point eye on a = (0.3, -0.2) [m];
        point eye on b = (0.1, 0.4) [m];
        spring oil (a.eye, b.eye) { damping = c; }
        output tension [N] = force(oil);
        output loss [W] = power(oil);
    }
}

/// Where the eyes of the dashpot are apart by `apart`, and how fast they part.
fn dashpot(random: &mut Random, apart: [f64; 2]) -> (State<DashpotCoordinates<f64>>, [f64; 2]) {
    let [mut q, v]: [[f64; 6]; 2] = [random.around_zero(2.0), random.around_zero(2.0)];
    let arm = |angle: f64, [x, y]: [f64; 2]| {
        let (s, c) = angle.sin_cos();
        [c * x - s * y, s * x + c * y]
    };
    let (of_a, of_b) = (arm(q[2], [0.3, -0.2]), arm(q[5], [0.1, 0.4]));
    (q[3], q[4]) = (q[0] + of_a[0] - of_b[0] - apart[0], q[1] + of_a[1] - of_b[1] - apart[1]);
    let eye = |first: usize, arm: [f64; 2]| {
        [v[first] - v[first + 2] * arm[1], v[first + 1] + v[first + 2] * arm[0]]
    };
    let (a, b) = (eye(0, of_a), eye(3, of_b));
    let at = State { t: 0.0, q: Components::from_array(q), v: Components::from_array(v) };
    (at, [a[0] - b[0], a[1] - b[1]])
}

/// Where its places coincide a damper exerts c times their relative velocity on both bodies, and takes c |v|²
/// from them; where they are apart, c times the component along the line between them.
#[test]
fn a_damper_acts_where_its_places_coincide() {
    let mechanism = Dashpot::declared();
    let mut random = Random::new(5);
    for round in 0..100 {
        let angle = 0.7 * f64::from(round);
        let line = [angle.cos(), angle.sin()];
        for distance in [0.0, 0.05] {
            let (at, rate) = dashpot(&mut random, line.map(|x| distance * x));
            let along = rate[0] * line[0] + rate[1] * line[1];
            let damped = if distance > 0.0 { line.map(|x| along * x) } else { rate };
            let forces = mechanism.forces(&at, &Default::default());
            // places that coincide are apart by a rounding, (5e-16/1e-10)² of c against what counts as apart
            let near = |x: f64, y: f64| (x - y).abs() < 1e-10 * (1.0 + y.abs());
            assert!(near(forces.xa, -7.0 * damped[0]) && near(forces.ya, -7.0 * damped[1]), "{distance}");
            assert!(near(forces.xb, 7.0 * damped[0]) && near(forces.yb, 7.0 * damped[1]), "{distance}");
            let none = mechanism.reactions(&at, &Default::default(), &Default::default());
            let outputs = mechanism.outputs(&at, &Default::default(), &none);
            let speed = if distance > 0.0 { along } else { rate[0].hypot(rate[1]) };
            assert!(near(outputs.tension, 7.0 * speed), "{distance}: {} {speed}", outputs.tension);
            assert!(near(outputs.loss, -7.0 * speed * speed), "{distance}: {} {speed}", outputs.loss);
        }
    }
}

/// ẍ = −k x − c ẋ to the last digit: ω = 10 rad/s and ζ = 0.2, along a line and along both axes of the plane.
#[test]
fn a_linear_system_about_a_coincidence_is_damped() {
    let line = Line::declared();
    let linear = linearize(&line, &OperatingPoint::at_rest(0.0, &[0.0], &[]), &Ports::default()).unwrap();
    assert!(
        (linear.a[(1, 0)] + 100.0).abs() < 1e-12 && (linear.a[(1, 1)] + 4.0).abs() < 1e-12,
        "{}",
        linear.a
    );
    let plane = Plane::declared();
    let linear =
        linearize(&plane, &OperatingPoint::at_rest(0.0, &[0.0, 0.0], &[]), &Ports::default()).unwrap();
    let modes = linear.modes().unwrap();
    assert_eq!(modes.len(), 2);
    for mode in modes {
        let (omega, ratio) = (mode.natural_frequency(), mode.damping_ratio().unwrap());
        assert!((omega - 10.0).abs() < 1e-7 && (ratio - 0.2).abs() < 1e-8, "{omega} {ratio}");
    }
}

/// y, ẏ of the free motion from y = 0 and ẏ = 1 m/s under gravity, with any scalar.
fn closed_form<T: Real>([k, c]: [T; 2], t: f64) -> [T; 2] {
    let number = T::from_f64;
    let t = number(t);
    let decay = number(0.5) * c;
    let omega = (k - decay * decay).sqrt();
    let rest = number(-9.81) / k;
    // y = rest + e^(−decay t) (a cos ωt + b sin ωt)
    let a = -rest;
    let b = (number(1.0) + decay * a) / omega;
    let (sine, cosine) = (omega * t).sin_cos();
    let shrunk = (-decay * t).exp();
    let y = shrunk * (a * cosine + b * sine);
    let rate = shrunk * (omega * (b * cosine - a * sine)) - decay * y;
    [rest + y, rate]
}

/// Derivatives by stiffness and damping, with dual numbers and in reverse.
#[test]
fn gradients_of_runs_from_a_coincidence_are_those_of_the_closed_form() {
    type One = Dual<f64, 2>;
    let (h, steps) = (1e-3, 300_u32);
    let seeded = [One::variable(100.0, 0), One::variable(4.0, 1)];
    let [expected, _] = closed_form(seeded, h * f64::from(steps));
    let line = Line::<One>::new(LineParameters { k: seeded[0], c: seeded[1] }).unwrap();
    let plane = Plane::<One>::new(PlaneParameters { k: seeded[0], c: seeded[1] }).unwrap();
    let mut run = Simulation::builder(line, h).method::<mbs_runtime::Held<Rk4>>().build().unwrap();
    (0..steps).for_each(|_| run.step().unwrap());
    let along_line = run.state().q.y;
    let mut run = Simulation::builder(plane, h).method::<mbs_runtime::Held<Rk4>>().build().unwrap();
    (0..steps).for_each(|_| run.step().unwrap());
    let in_plane = run.state().q.y;
    for found in [along_line, in_plane] {
        assert!((found.value - expected.value).abs() < 1e-9);
        for (found, expected) in found.partials.iter().zip(expected.partials) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
    for text in ["body block (y) { mass = 1 [kg]; }", "body block (x, y) { mass = 1 [kg]; }"] {
        let dof = if text.contains('x') { 2 } else { 1 };
        let text = format!(
            "Thrown {{ dof = {dof}; param k = 100 [N/m]; param c = 4 [N*s/m]; gravity = (0, -9.81) [m/s^2]; \
             method = rk4; {text} spring coil (block, ground) {{ stiffness = k; length = 0; damping = c; }} \
             start {{ der(y) = 1 [m/s]; }} }}"
        );
        let live = Text::declaration("thrown.mbs", &text).compile_with_transposes().unwrap();
        let variables = [Variable::Parameter("k"), Variable::Parameter("c")];
        let mut gradient = [0.0; 2];
        let sum = Sum::new(u64::from(steps), &variables);
        let value = Run::builder(&live, h).gradient_in_reverse(
            &sum,
            1 << 20,
            |moment| {
                let last = moment.step == u64::from(steps);
                moment.by_q[dof - 1] = f64::from(u8::from(last));
                Ok(if last { moment.at.q[dof - 1] } else { 0.0 })
            },
            &mut gradient,
        );
        assert!((value.unwrap() - expected.value).abs() < 1e-9);
        for (found, expected) in gradient.iter().zip(expected.partials) {
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
}

/// The error of a run of so many steps after 0.3 s: √(Δy² + (0.1 Δẏ)²), with the differences from the closed form.
struct Miss<M> {
    mechanism: M,
    steps: u32,
    /// y and ẏ.
    seen: fn(&[f64], &[f64]) -> [f64; 2],
}

const END: f64 = 0.3;

impl<M: Mechanism<Real = f64>> MethodVisitor for Miss<M> {
    type Result = Result<f64, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        let mut run =
            Simulation::builder(self.mechanism, END / f64::from(self.steps)).method::<X>().build()?;
        run.advance_to(END)?;
        let (q, v) = (run.state().q.into_array(), run.state().v.into_array());
        let [y, rate] = (self.seen)(q.as_ref(), v.as_ref());
        let [exact, exact_rate] = closed_form([100.0, 4.0], END);
        Ok((y - exact).hypot(0.1 * (rate - exact_rate)))
    }
}

fn order_of(miss: impl Fn(u32) -> f64, steps: u32) -> f64 {
    (miss(steps) / miss(3 * steps / 2)).ln() / 1.5_f64.ln()
}

/// Along a line, which is that of the motion in the plane too, the force is smooth: both kinds of runs have the
/// order of their scheme from the coincidence on.
#[test]
fn runs_from_a_coincidence_have_the_order_of_their_scheme() {
    for scheme in SCHEMES {
        let steps = match scheme.order {
            2 | 3 => 160,
            4 => 80,
            5 => 40,
            _ => 6,
        };
        let method = Explicit::held(scheme);
        let line = |steps| {
            let miss = Miss { mechanism: Line::declared(), steps, seen: |q, v| [q[0], v[0]] };
            with_type(method, miss).unwrap().unwrap()
        };
        let plane = |steps| {
            let miss = Miss { mechanism: Plane::declared(), steps, seen: |q, v| [q[1], v[1]] };
            with_type(method, miss).unwrap().unwrap()
        };
        for found in [order_of(line, steps), order_of(plane, steps)] {
            let order = f64::from(scheme.order);
            println!("{}: {found:.3}", scheme.word);
            assert!((found - order).abs() < 0.3, "{}: {found}", scheme.word);
        }
    }
    // the implicit method has the derivatives of the force there
    let implicit = |steps: u32| {
        let mut run = TrBdf2::builder(Plane::declared(), END / f64::from(steps)).build().unwrap();
        run.advance_to(END).unwrap();
        (run.state().q.y - closed_form([100.0, 4.0], END)[0]).abs()
    };
    let found = order_of(implicit, 200);
    assert!((found - 2.0).abs() < 0.1, "{found}");
}

/// A path that bends at the coincidence turns the direction of the damper, from which the step there loses
/// accuracy: second order is left, and third of schemes of higher order.
#[test]
fn a_path_that_bends_at_a_coincidence_is_of_second_order() {
    let thrown = |scheme: &str, steps: u32| -> [f64; 2] {
        let text = "Thrown { dof = 2; gravity = (0, -9.81) [m/s^2]; body block (x, y) { mass = 1 [kg]; }
            spring coil (block, ground) { stiffness = 100 [N/m]; length = 0; damping = 4 [N*s/m]; }
            start { der(x) = 1 [m/s]; } }";
        let live = Text::declaration("thrown.mbs", text).compile().unwrap();
        let method = Explicit::projected(mbs_runtime::Tableau::find(scheme).unwrap());
        let mut run = Run::builder(&live, END / f64::from(steps)).method(method).build().unwrap();
        mbs_runtime::System::advance(&mut run, u64::from(steps)).unwrap();
        let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
        mbs_runtime::System::state(&run, &mut q, &mut v);
        q
    };
    let exact = thrown("dop853", 10_000);
    for (scheme, least) in [("heun", 1.8), ("bs3", 1.8), ("rk4", 2.8), ("dopri5", 2.8), ("dop853", 2.8)] {
        let order_of = |miss: &dyn Fn(u32) -> f64| (miss(20) / miss(160)).log2() / 3.0;
        let miss = |steps: u32| {
            let found = thrown(scheme, steps);
            (found[0] - exact[0]).hypot(found[1] - exact[1])
        };
        let found = order_of(&miss);
        println!("{scheme}: {found:.3}");
        assert!(found > least, "{scheme}: {found}");
    }
}
