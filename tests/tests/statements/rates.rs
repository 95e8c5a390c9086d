//! Equations between rates: orders of methods, the same bits on all ways of a step, starts, power, and what does not
//! know them. References of their own have `models/tests/references/wheels.rs`.

use mbs_analysis::{Search, equilibrium};
use mbs_live::Text;
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{
    Adaptive, Dop853, Dual, Error, Held, Heun, Kinematics, Mechanism, Method, Pack, PerStage, Projected,
    Rattle, Rk4, Simulation, State, System, Tolerances, TrBdf2, mechanism,
};

/// A tractor on a knife edge with a trailer on another one, as a type and as a text.
macro_rules! trolley {
    ($text:ident, $Name:ident: $($statement:tt)*) => {
        trolley! {
            $text =
            $Name {
                dof = 2;
                $($statement)*
                param pulled = 3 [N];
                body frame (x, y, phi) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; }
                body trailer (u, v, psi) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
                point edge on frame = (-0.3 [m], 0);
                point hitch on frame = (-0.5 [m], 0);
                point eye on trailer = (0.6 [m], 0);
                revolute pin (frame.hitch, trailer.eye);
                rate knife: der(frame.edge.y)*cos(phi) = der(frame.edge.x)*sin(phi);
                rate tail: der(v)*cos(psi) - der(u)*sin(psi) = 0;
                force pull on frame in frame = (pulled, 0);
                // the place and both angles are kept, and the two rates that are free
                start {
                    x = 0; y = 0; phi = 20 [deg]; psi = -10 [deg];
                    der(x) = 0.8 [m/s]; der(phi) = 0.5 [rad/s];
                }
                output across [N] = -lambda(tail);
            }
        }
    };
    ($text:ident = $($declaration:tt)*) => {
        mechanism! { $($declaration)* }

        const $text: &str = stringify!($($declaration)*);
    };
}

trolley!(TROLLEY, Trolley: gradients = reverse;);
trolley!(REDUCED, Reduced: states = reduced;);

mechanism! {
    /// A crank at a speed by a table, and a slide that what moves carries along: rates with parts of their own.
    Carried {
        dof = 0;
        table given(time) = [(0 [s], 0 [rad/s]), (1 [s], 10 [rad/s]), (2 [s], 4 [rad/s])] linear outside hold;
        body crank (angle = phi) { inertia = 0.1 [kg*m^2]; }
        body slide (x, y) { mass = 1 [kg]; }
        rate motor: der(phi) = given(t);
        rate belt: der(x) - 0.2 [m]*sin(phi)*der(phi) = 0.3 [m/s]*cos(2 [rad/s]*t);
        rate lift: der(y) = -0.5 [1/s]*x;
        output motor_power [W] = power(motor);
        output belt_power [W] = power(belt);
        output lift_power [W] = power(lift);
    }
}

const H: f64 = 1e-3;

fn to_tolerance<M: Mechanism<Real = f64>>(mechanism: M) -> Result<Adaptive<M, Dop853>, Error> {
    let tolerances = Tolerances { rtol: 1e-13, atol: 1e-15, ..Tolerances::default() };
    Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances).build()
}

/// The angles of the trolley at 1 s.
fn angles(q: TrolleyCoordinates) -> [f64; 2] {
    [q.phi, q.psi]
}

fn order(run: impl Fn(f64) -> Result<[f64; 2], Error>) -> Result<f64, Error> {
    let mut exact = to_tolerance(Trolley::declared())?;
    exact.advance_to(1.0)?;
    let exact = angles(exact.state().q);
    let error = |h: f64| -> Result<f64, Error> {
        let found = run(h)?;
        Ok((found[0] - exact[0]).abs().max((found[1] - exact[1]).abs()))
    };
    Ok((error(0.02)? / error(0.01)?).log2())
}

fn constant<X: Method>(h: f64) -> Result<[f64; 2], Error> {
    let mut run = Simulation::builder(Trolley::declared(), h).method::<X>().build()?;
    run.advance_to(1.0)?;
    Ok(angles(run.state().q))
}

#[test]
fn methods_keep_their_orders() -> Result<(), Error> {
    for (found, expected) in [
        (order(constant::<Held<Heun>>)?, 2.0),
        (order(constant::<PerStage<Heun>>)?, 2.0),
        (order(constant::<Projected<Heun>>)?, 2.0),
        (order(constant::<Projected<Rk4>>)?, 4.0),
        (
            order(|h| {
                let mut run = TrBdf2::builder(Trolley::declared(), h).build()?;
                run.advance_to(1.0)?;
                Ok(angles(run.state().q))
            })?,
            2.0,
        ),
    ] {
        assert!((found - expected).abs() < 0.4, "{found} for {expected}");
    }
    Ok(())
}

#[test]
fn stages_lanes_and_texts_compute_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    fn same<M: Mechanism<Real = f64>>(mechanism: M, text: &str) -> Result<(), Box<dyn std::error::Error>> {
        let live = Text::declaration("trolley.mbs", text).compile()?;
        let start = Simulation::new(mechanism, H)?;
        let (mut fused, mut staged, mut pack) = (start, start, Pack::new([start; 4]));
        let mut of_text = mbs_live::Run::builder(&live, H).build()?;
        for _ in 0..300 {
            fused.step()?;
            staged.step_in_stages()?;
            assert_eq!(pack.step(), [true; 4]);
            of_text.step()?;
        }
        assert_eq!(staged.state(), fused.state(), "in stages");
        assert_eq!(pack.simulation(3).state(), fused.state(), "in lanes");
        let told = |run: &dyn System| {
            let n = run.equations().info().coordinates.len();
            let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
            run.state(&mut q, &mut v);
            [q, v].concat()
        };
        assert_eq!(told(&of_text), told(&fused), "the text");
        Ok(())
    }
    same(Trolley::declared(), TROLLEY)?;
    same(Reduced::declared(), REDUCED)
}

/// Nothing but the error of 1e-13 a step.
#[test]
fn reduced_states_move_the_same() -> Result<(), Error> {
    let (mut all, mut reduced) = (to_tolerance(Trolley::declared())?, to_tolerance(Reduced::declared())?);
    all.advance_to(2.0)?;
    reduced.advance_to(2.0)?;
    let (all, reduced) = (all.state().q, reduced.state().q);
    let apart = [all.phi - reduced.phi, all.psi - reduced.psi, all.x - reduced.x, all.v - reduced.v];
    assert!(apart.iter().all(|x| x.abs() < 1e-11), "{apart:?}");
    Ok(())
}

/// The start keeps the four values that say where the mechanism is, of which degrees of freedom are only two, and
/// both rates.
#[test]
fn starts_have_more_places_than_rates() -> Result<(), Error> {
    let State { q, v, .. } = Simulation::new(Trolley::declared(), H)?.state();
    let kept = [q.x, q.y, q.phi - 20_f64.to_radians(), q.psi + 10_f64.to_radians(), v.x - 0.8, v.phi - 0.5];
    assert!(kept.iter().all(|x| x.abs() < 1e-14), "{kept:?}");
    assert!((v.v * q.psi.cos() - v.u * q.psi.sin()).abs() < 1e-15);
    Ok(())
}

/// The edges take no power: ½ vᵀMv grows by that of the force, F ∫ u dt, to 1e-11 of 12 J.
#[test]
fn edges_take_no_power() -> Result<(), Error> {
    mechanism! {
        Pulled {
            dof = 2;
            body sleigh (x, y, phi) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; }
            point edge on sleigh = (-0.3 [m], 0);
            rate knife: der(sleigh.edge.y)*cos(phi) = der(sleigh.edge.x)*sin(phi);
            force pull on sleigh in sleigh = (3 [N], 1 [N]);
            state work [J] = 0;
            der(work) = 3 [N]*(der(x)*cos(phi) + der(y)*sin(phi)) + 1 [N]*(der(y)*cos(phi) - der(x)*sin(phi));
            start { x = 0; y = 0; phi = 0; der(phi) = 2 [rad/s]; der(x) = 0; }
        }
    }
    let mut run = to_tolerance(Pulled::declared())?;
    let energy = |run: &Adaptive<Pulled, Dop853>| run.mechanism().kinetic_energy(&run.state());
    let before = energy(&run);
    run.advance_to(10.0)?;
    let (gained, work) = (energy(&run) - before, run.state().v.work);
    assert!((gained - work).abs() < 1e-9 * work.abs(), "{gained} for {work}");
    Ok(())
}

/// vᵀM q̈ is the power of the rates with parts of their own, at any instant.
#[test]
fn rates_that_are_given_do_work() -> Result<(), Error> {
    let mut run = to_tolerance(Carried::declared())?;
    for t in [0.3, 1.0, 1.7] {
        run.advance_to(t)?;
        let at = run.state();
        let found = run.mechanism().accelerations(&at, run.inputs());
        let out = run.mechanism().outputs(&at, run.inputs(), &found);
        let (v, a) = (at.v, found.acceleration);
        let gained = 0.1 * v.phi * a.phi + v.x * a.x + v.y * a.y;
        let power = out.motor_power + out.belt_power + out.lift_power;
        assert!((gained - power).abs() < 1e-13 * (1.0 + gained.abs()), "{gained} for {power}");
    }
    // ∫ of the table: 5 rad, then 5 rad and 4.55 rad
    assert!((run.state().q.phi - (5.0 + 10.0 * 0.7 - 0.5 * 6.0 * 0.49)).abs() < 1e-12);
    Ok(())
}

/// Through 300 steps, in both directions, by a parameter and by where the trolley begins: to 1e-10 of 1 rad.
#[test]
fn gradients_go_both_ways() -> Result<(), Error> {
    fn agree<X: Method>() -> Result<(), Error> {
        const STEPS: u64 = 300;
        let variables = [Variable::Parameter("pulled"), Variable::Position("psi"), Variable::Velocity("phi")];
        let sum = Sum::new(STEPS, &variables);
        let builder = || Simulation::builder(Trolley::declared(), H).method::<X>();
        let [mut forward, mut backward] = [[0.0; 3]; 2];
        let found = builder().gradient(
            &sum,
            |run: &Simulation<Trolley<Dual<f64, 4>>, X>| match run.steps() {
                STEPS => Ok(run.state().q.psi),
                _ => Ok(Dual::default()),
            },
            &mut forward,
        )?;
        let same = builder().gradient_in_reverse(
            &sum,
            1 << 20,
            |moment| {
                if moment.step < STEPS {
                    return Ok(0.0);
                }
                moment.by_q[5] = 1.0;
                Ok(moment.at.q[5])
            },
            &mut backward,
        )?;
        assert!((found - same).abs() < 1e-14, "{found} {same}");
        for (forward, backward) in forward.iter().zip(backward) {
            assert!(forward.abs() > 1e-4 && (forward - backward).abs() < 1e-10, "{forward} {backward}");
        }
        Ok(())
    }
    agree::<Held<Heun>>()?;
    agree::<PerStage<Rk4>>()?;
    agree::<Projected<Heun>>()
}

#[test]
fn what_knows_positions_alone_refuses_rates() {
    let error = equilibrium(&Trolley::declared(), &Search::default()).map(|_| ());
    let refused =
        mbs_analysis::Error::Rates { what: "an equilibrium", mechanism: "Trolley", constraint: "knife" };
    assert_eq!(error, Err(refused));
    let kinematics = Kinematics::new(Carried::declared()).map(|_| ());
    assert_eq!(kinematics, Err(Error::Rates { method: "kinematics", constraint: "motor" }));
    let rattle = Rattle::builder(Trolley::declared(), H).build().map(|_| ());
    assert_eq!(rattle, Err(Error::Rates { method: "rattle", constraint: "knife" }));
}
