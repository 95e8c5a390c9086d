//! Tables of two arguments, tables of files, and forces by differentiation: the same bits on all ways of a step,
//! derivatives, energies.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::path::Path;

use mbs_live::Text;
use mbs_runtime::{
    Adaptive, Components, Dop853, Dual, Error, Mechanism, Pack, Simulation, State, System, Tolerances,
    mechanism,
};

/// A mechanism as a type and as a text.
macro_rules! both {
    ($text:ident: $($declaration:tt)*) => {
        mechanism! { $($declaration)* }

        const $text: &str = stringify!($($declaration)*);
    };
}

both! {
    ENGINE:
    Engine {
        dof = 1;
        table torque_of(speed, load) = from "maps/torque.csv" linear outside (extend, hold);
        table smooth(speed, load) = [
            (0 [rpm], 0, 0 [N*m]), (0 [rpm], 0.5, 30 [N*m]), (0 [rpm], 1, 50 [N*m]),
            (2000 [rpm], 0, -5 [N*m]), (2000 [rpm], 0.5, 45 [N*m]), (2000 [rpm], 1, 90 [N*m]),
            (5000 [rpm], 0, -20 [N*m]), (5000 [rpm], 0.5, 10 [N*m]), (5000 [rpm], 1, 60 [N*m])
        ] cubic outside hold;
        body wheel (angle = phi) { inertia = 0.3 [kg*m^2]; }
        let load = 0.5 + 0.4*sin(phi/20);
        torque drive on wheel = torque_of(der(phi), load);
        start { der(phi) = 800 [rpm]; }
        output driven [N*m] = torque_of(der(phi), load);
        output smooth [N*m] = smooth(der(phi), load);
    }
}

/// A magnet above a plate of iron, on a spring, in oil, with statements for its forces.
macro_rules! magnet {
    ($Name:ident: $($statement:tt)*) => {
        mechanism! {
            $Name {
                dof = 2;
                param stiffness = 40 [N/m];
                param strength = 0.02 [N*m^2];
                param damping = 0.3 [N*s/m];
                gravity = (0, -9.81) [m/s^2];
                body magnet (x, y) { mass = 0.5 [kg]; }
                start { x = 0.3 [m]; y = 0.1 [m]; }
                $($statement)*
            }
        }
    };
}

magnet! {
    Magnet:
    potential spring = stiffness*(x^2 + y^2)/2;
    potential attraction = -strength/(y + 1 [m]);
    dissipation oil = damping*(der(x)^2 + der(x)*der(y) + der(y)^2)/2;
    output lost [W] = power(oil);
    output gained [W] = power(spring) + power(attraction);
}

magnet! {
    ByForces:
    force along on x = -stiffness*x - damping*(der(x) + der(y)/2);
    force across on y = -stiffness*y - strength/(y + 1 [m])^2 - damping*(der(y) + der(x)/2);
}

fn engine() -> mbs_live::Live {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/statements");
    Text::declaration("engine.mbs", ENGINE).in_folder(folder).compile().expect("an engine")
}

#[test]
fn stages_lanes_and_texts_compute_the_same_bits() -> Result<(), Error> {
    let start = Simulation::new(Engine::declared(), 1e-3)?;
    let (mut fused, mut staged, mut pack) = (start, start, Pack::new([start; 4]));
    let live = engine();
    let mut text = mbs_live::Run::builder(&live, 1e-3).build()?;
    for _ in 0..2000 {
        fused.step()?;
        staged.step_in_stages()?;
        assert_eq!(pack.step(), [true; 4]);
        text.step()?;
        let (mut q, mut v) = ([0.0], [0.0]);
        text.state(&mut q, &mut v);
        let state = fused.state();
        assert_eq!(staged.state(), state);
        assert_eq!(pack.simulation(2).state(), state);
        assert_eq!((q[0], v[0]), (state.q.phi, state.v.phi));
    }
    // it ran through several fields of the map
    assert!(fused.state().v.phi > 250.0 && fused.state().q.phi > 150.0);
    Ok(())
}

/// ∂/∂phi and ∂/∂der(phi) of both maps by dual numbers, against central differences: their error is 1e-6 of the
/// largest third derivative and a rounding over the step.
#[test]
fn derivatives_are_those_of_the_formula() {
    fn outputs<T: mbs_runtime::Real>(q: T, v: T) -> [T; 2] {
        let engine = Engine::<T>::new(Default::default()).expect("declared parameters");
        let zero = T::from_f64(0.0);
        let state = State { t: zero, q: Components::splat(q), v: Components::splat(v) };
        let none = Components::splat(zero);
        let found = engine.outputs(
            &state,
            &Default::default(),
            &engine.reactions(&state, &Default::default(), &none),
        );
        [found.driven, found.smooth]
    }
    for (q, v) in [(3.0, 100.0), (25.0, 210.0), (70.0, 400.0), (50.0, 520.0)] {
        let (h, constant) = (1e-4, |x| Dual::<f64, 1>::constant(x));
        let mut moving = [constant(q), constant(v)];
        moving[0].partials = [1.0];
        let by_q = outputs(moving[0], constant(v));
        moving[1].partials = [1.0];
        let by_v = outputs(constant(q), moving[1]);
        for at in 0..2 {
            let difference = |a: [f64; 2], b: [f64; 2]| (a[at] - b[at]) / (2.0 * h);
            let expected_q = difference(outputs(q + h, v), outputs(q - h, v));
            let expected_v = difference(outputs(q, v + h), outputs(q, v - h));
            assert!((by_q[at].partials[0] - expected_q).abs() < 1e-8, "{at} at {q} {v}");
            assert!((by_v[at].partials[0] - expected_v).abs() < 1e-8, "{at} at {q} {v}");
        }
    }
}

/// A table of a file is the table of its points.
#[test]
fn a_file_gives_the_points_of_its_columns() {
    let written = ENGINE.replacen(
        "from \"maps/torque.csv\"",
        "[(500 [rpm], 0, -5 [N*m]), (500 [rpm], 0.5, 40 [N*m]), (500 [rpm], 1, 60 [N*m]),
          (1500 [rpm], 0, -10 [N*m]), (1500 [rpm], 0.5, 70 [N*m]), (1500 [rpm], 1, 120 [N*m]),
          (3000 [rpm], 0, -15 [N*m]), (3000 [rpm], 0.5, 60 [N*m]), (3000 [rpm], 1, 110 [N*m]),
          (4500 [rpm], 0, -30 [N*m]), (4500 [rpm], 0.5, 20 [N*m]), (4500 [rpm], 1, 70 [N*m])]",
        1,
    );
    assert_ne!(written, ENGINE);
    let written = Text::declaration("engine.mbs", written).compile().expect("an engine");
    assert_eq!(written.derivation(), engine().derivation());
    let ends = [written, engine()].map(|live| {
        let mut run = mbs_live::Run::builder(&live, 1e-3).build().expect("a start");
        (0..500).for_each(|_| run.step().expect("a step"));
        let (mut q, mut v) = ([0.0], [0.0]);
        run.state(&mut q, &mut v);
        (q, v)
    });
    assert_eq!(ends[0], ends[1]);
}

fn to_tolerance<M: Mechanism<Real = f64>>(mechanism: M) -> Result<Adaptive<M, Dop853>, Error> {
    let tolerances = Tolerances { rtol: 1e-12, atol: 1e-14, ..Tolerances::default() };
    Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances).build()
}

/// Forces by differentiation are those written by hand, with the same operations. The energy, potentials included,
/// falls by what oil takes: over 10 s to 1e-10 of it, by Simpson's rule with parts of 1 ms, whose error is 1e-12.
#[test]
fn energies_exert_their_slopes() -> Result<(), Error> {
    assert_eq!(Magnet::<f64>::OPERATIONS, ByForces::<f64>::OPERATIONS);
    let (mut run, mut by_forces) = (to_tolerance(Magnet::declared())?, to_tolerance(ByForces::declared())?);
    let energy = |run: &Adaptive<Magnet, Dop853>| {
        let at = run.state();
        run.mechanism().kinetic_energy(&at) + run.mechanism().potential_energy(&at)
    };
    let powers = |run: &Adaptive<Magnet, Dop853>| {
        let at = run.state();
        let found = run.mechanism().accelerations(&at, run.inputs());
        run.mechanism().outputs(&at, run.inputs(), &found)
    };
    let (before, mut lost, h) = (energy(&run), 0.0, 1e-3);
    for at in 0..=10_000 {
        if at > 0 {
            run.advance_to(at as f64 * h)?;
        }
        let weight = if at == 0 || at == 10_000 { 1.0 } else { 2.0 + 2.0 * f64::from(at % 2) };
        lost += weight * h / 3.0 * powers(&run).lost;
    }
    let change = energy(&run) - before;
    assert!(change < -1.0 && (change - lost).abs() < 1e-10 * change.abs(), "{change} for {lost}");
    by_forces.advance_to(10.0)?;
    let (a, b) = (run.state(), by_forces.state());
    assert!((a.q.x - b.q.x).abs() < 1e-11 && (a.q.y - b.q.y).abs() < 1e-11, "{a:?} {b:?}");
    // along the motion a potential changes by the power that it gives
    let dual = |energy: Dual<f64, 1>| energy.partials[0];
    let magnet = Magnet::<Dual<f64, 1>>::new(Default::default())?;
    let mut q = MagnetCoordinates { x: Dual::constant(a.q.x), y: Dual::constant(a.q.y) };
    (q.x.partials, q.y.partials) = ([a.v.x], [a.v.y]);
    let v = MagnetCoordinates { x: Dual::constant(a.v.x), y: Dual::constant(a.v.y) };
    let rate = dual(magnet.potential_energy(&State { t: Dual::constant(10.0), q, v }));
    let of_weight = 0.5 * 9.81 * a.v.y;
    assert!((rate - of_weight + powers(&run).gained).abs() < 1e-12, "{rate}");
    Ok(())
}
