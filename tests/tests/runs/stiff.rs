//! TR-BDF2 on stiff forces: the stage against a dense solution, its order, the slow motion of
//! cranks with stiff bushings, decay of what is too fast, types and texts alike.
#![allow(clippy::expect_used, clippy::indexing_slicing, reason = "helpers of tests")]

use mbs_live::{Prepared, Text};
use mbs_runtime::{Adaptive, Components, Dop853, Error, Mechanism, State, System, Tolerances, TrBdf2};
use nalgebra::{DMatrix, DVector};
use tests::bushing::{CRANK, Crank, CrankCoordinates, CrankParameters, REDUCED, ReducedCrank};

/// A point mass on a spring.
const ROD: &str = "Rod {
    dof = 2;
    param stiffness = 1e9 [N/m];
    body bob (x, y) { mass = 1 [kg]; }
    point hook on ground = (0, 0);
    spring rod (ground.hook, bob) { stiffness = stiffness; length = 0.1 [m]; }
    // stretched by its own speed
    start { x = 0.1 [m] + 44.1e-9 [m]; y = 0; der(y) = 2.1 [m/s]; }
}";

/// Two masses on a spring, of which one is pushed.
const PUSHED: &str = "Pair {
    dof = 2;
    input push [N];
    body first (x) { mass = 1 [kg]; }
    body second (y) { mass = 2 [kg]; }
    force pull on x = 1e9 [N/m]*(y - x) + push;
    force back on y = 1e9 [N/m]*(x - y);
    start { x = 0; y = 0; }
}";

const STEP: f64 = 0.5e-3;

fn numbers(components: impl Components<Real = f64>) -> Vec<f64> {
    components.into_array().as_ref().to_vec()
}

fn stiff(stiffness: f64, damping: f64) -> CrankParameters {
    CrankParameters { stiffness, damping, ..*Crank::declared().parameters() }
}

/// Dense: M + D from derivatives of the forces by duals, the system as it stands, LU.
fn stage_by_lu(crank: &Crank, at: &State<CrankCoordinates>, shift: f64, predicted: &[f64]) -> Vec<f64> {
    use mbs_runtime::Dual;
    const N: usize = 5;
    type Scalar = Dual<f64, { 2 * N }>;
    let over = Crank::<Scalar>::new(crank.parameters().over()).expect("parameters");
    let (mut q, mut v) = (at.q.over::<CrankCoordinates<Scalar>>(), at.v.over::<CrankCoordinates<Scalar>>());
    let variables = |components: &mut CrankCoordinates<Scalar>, from: usize| {
        let mut array = components.into_array();
        for (index, component) in array.iter_mut().enumerate() {
            *component = Dual::variable(component.value, from + index);
        }
        *components = Components::from_array(array);
    };
    variables(&mut q, 0);
    variables(&mut v, N);
    let state = State { t: Dual::constant(at.t), q, v };
    let forces = over.forces(&state, &Default::default()).into_array();
    let slope = |i: usize, j: usize| {
        let of = |at: usize| 0.5 * (forces[i].partials[at + j] + forces[j].partials[at + i]);
        -shift * of(N) - shift * shift * of(0)
    };
    let d = DMatrix::from_fn(N, N, slope);
    let m = numbers(crank.phi(at.t, &at.q)).len();
    let phi_q = crank.phi_q(at.t, &at.q);
    let mass = crank.mass(&at.q);
    let mut matrix = DMatrix::zeros(N + m, N + m);
    let mut rhs = DVector::zeros(N + m);
    let gamma = numbers(crank.gamma(at));
    let predicted = DVector::from_column_slice(predicted);
    let correction = &d * &predicted;
    for i in 0..N {
        rhs[i] = forces[i].value + correction[i];
        for j in 0..N {
            matrix[(i, j)] = mass[(i, j)] + d[(i, j)];
        }
        for row in 0..m {
            matrix[(N + row, i)] = phi_q[(row, i)];
            matrix[(i, N + row)] = phi_q[(row, i)];
        }
    }
    (0..m).for_each(|row| rhs[N + row] = gamma[row]);
    let solution = matrix.lu().solve(&rhs).expect("a regular matrix");
    solution.rows(0, N).iter().copied().collect()
}

/// The straight lines solve what the stage is: to roundings times the condition of the matrix,
/// 10⁴ with these masses.
#[test]
fn stages_are_those_of_a_dense_solution() {
    for (stiffness, damping) in [(1e9, 0.0), (1e7, 1e3), (1e3, 1.0)] {
        let crank = Crank::new(stiff(stiffness, damping)).expect("parameters");
        let mut run = TrBdf2::builder(crank, STEP).build().expect("a start");
        for step in 0..20 {
            run.step().expect("a regular motion");
            let at = run.state();
            let predicted: Vec<f64> = (0..5).map(|i| f64::from(i - 2) * f64::from(step)).collect();
            let mut given = CrankCoordinates::default().into_array();
            given.copy_from_slice(&predicted);
            let shift = 0.29 * STEP;
            let found = crank.implicit(&at, &Default::default(), shift, &Components::from_array(given));
            let expected = stage_by_lu(&crank, &at, shift, &predicted);
            let size = expected.iter().fold(1.0_f64, |size, a| size.max(a.abs()));
            for (found, expected) in numbers(found.acceleration).iter().zip(&expected) {
                assert!((found - expected).abs() < 1e-11 * size, "{stiffness:e}: {found} {expected}");
            }
        }
    }
}

/// A start on the slow motion: 100 steps of 0.1 ms, which damp the vibration that the declared start
/// begins with, because its bushing carries no load yet. (That vibration has 10⁻³ m/s, and a step
/// cannot follow it.)
fn settled(crank: Crank) -> State<CrankCoordinates> {
    let mut run = TrBdf2::builder(crank, 1e-4).build().expect("a start");
    run.advance_to(1e-2).expect("a regular motion");
    run.state()
}

/// θ1 and x3 after 0.3 s, a turn of the crank, by steps that resolve a vibration.
fn reference(crank: Crank, start: State<CrankCoordinates>) -> [f64; 2] {
    let tolerances = Tolerances { rtol: 1e-11, atol: 1e-13, ..Tolerances::default() };
    let builder = Adaptive::builder(crank).scheme::<Dop853>().tolerances(tolerances);
    let mut run = builder.from_state(start).build().expect("a start");
    run.advance_to(start.t + 0.3).expect("a regular motion");
    let state = run.state();
    [state.q.theta1, state.q.x3]
}

/// As many components of another type.
fn same<A: Components<Real = f64>, B: Components<Real = f64>>(from: A) -> B {
    let mut array = B::splat(0.0).into_array();
    array.as_mut().copy_from_slice(from.into_array().as_ref());
    B::from_array(array)
}

/// The slow motion of both stiff cranks is followed in steps of 0.5 ms, 0.01 rad of the crank, to
/// 10⁻⁴ of the angle and of the stroke of 0.12 m, while the bushing alone would vibrate by several
/// radians in a step. With reduced states too.
#[test]
fn the_slow_motion_of_stiff_cranks_is_followed() {
    for (stiffness, damping) in [(1e9, 0.0), (1e7, 1e3)] {
        let parameters = stiff(stiffness, damping);
        let crank = Crank::new(parameters).expect("parameters");
        let start = settled(crank);
        let [theta, x] = reference(crank, start);
        let mut run = TrBdf2::builder(crank, STEP).from_state(start).build().expect("a start");
        run.advance_to(start.t + 0.3).expect("a regular motion");
        let found = run.state().q;
        let reduced = ReducedCrank::new(same(parameters)).expect("parameters");
        let start = State { t: start.t, q: same(start.q), v: same(start.v) };
        let mut other = TrBdf2::builder(reduced, STEP).from_state(start).build().expect("a start");
        other.advance_to(start.t + 0.3).expect("a regular motion");
        let other = other.state().q;
        for [found_theta, found_x] in [[found.theta1, found.x3], [other.theta1, other.x3]] {
            let errors = [(found_theta - theta) / theta, (found_x - x) / 0.12];
            println!("{stiffness:e} N/m, {damping:e} N s/m: {errors:?}");
            assert!(errors.iter().all(|error| error.abs() < 1e-4), "{stiffness:e}: {errors:?}");
        }
    }
}

/// Second order where nothing is stiff, to 0.1.
#[test]
fn errors_of_soft_mechanisms_fall_with_the_square_of_the_step() {
    let soft = stiff(2e3, 5.0);
    let crank = Crank::new(soft).expect("parameters");
    let [theta, _] = reference(crank, TrBdf2::builder(crank, STEP).build().expect("a start").state());
    let error = |step: f64| {
        let mut run = TrBdf2::builder(crank, step).build().expect("a start");
        run.advance_to(0.3).expect("a regular motion");
        (run.state().q.theta1 - theta).abs()
    };
    let order = (error(1e-4) / error(5e-5)).log2();
    assert!((order - 2.0).abs() < 0.1, "{order}");
}

/// A rod of 10⁹ N/m turns by 0.01 rad a step: over a turn its end is off by 3e-5 of its radius
/// from that of a rigid rod (second order: 1.2e-4 in steps of 1 ms), while its stretch is 4e-7 of it.
/// A text.
#[test]
fn a_stiff_rod_turns_as_a_rigid_one() {
    let live = Text::declaration("rod.mbs", ROD).compile().expect("a declaration");
    let mut run = TrBdf2::builder(Prepared::new(&live), STEP).build().expect("a start");
    run.advance(600).expect("a regular motion");
    let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
    run.state(&mut q, &mut v);
    let angle: f64 = 21.0 * 0.3;
    let error = (q[0] - 0.1 * angle.cos()).hypot(q[1] - 0.1 * angle.sin()) / 0.1;
    assert!(error < 4e-5, "{error:e}");
}

/// A rod of 1 m whose end a drive pulls away at 0.1 m/s, until the rod lies on the way of the drive at 10 s. Steps
/// went on from there to places 10¹⁴⁴ m away, since the one correction that a step makes was not looked at.
#[test]
fn a_run_ends_where_a_drive_leads_beyond_reach() {
    let text = "Pulled {
        dof = 0;
        body end (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = 1 [m^2];
        drive pull: x = 0.1 [m/s]*t;
        start { guess y = 1 [m]; }
    }";
    let live = Text::declaration("pulled.mbs", text).compile().expect("a declaration");
    for step in [1e-2, 1e-3, 1.7e-4] {
        let mut run = TrBdf2::builder(Prepared::new(&live), step).build().expect("a start");
        let error = run.advance_to(20.0).expect_err("an end");
        assert!(matches!(error, Error::OutOfReach { constraint: "rod", .. }), "{error}");
        assert!((run.time() - 10.0).abs() < 1.5 * step, "{}", run.time());
    }
}

/// A force that a program sets anew for every step acts on both masses at once, though it is applied
/// to the first one. Their centre moves as one mass, of which a method of second order integrates each
/// step exactly; roundings of 10⁹ N/m times a position are left. A jump of the force passes between
/// them within some steps: until then they are apart by h² times the jump of the acceleration.
#[test]
fn inputs_act_on_what_is_slow() {
    let live = Text::declaration("pair.mbs", PUSHED).compile().expect("a declaration");
    let mut run = TrBdf2::builder(Prepared::new(&live), STEP).build().expect("a start");
    let (mut x, mut v) = (0.0, 0.0);
    for step in 0..2000 {
        let push = if step % 7 < 3 { 5.0 } else { -3.0 };
        run.set_inputs(&[push]);
        run.step().expect("a regular motion");
        x += STEP * v + 0.5 * STEP * STEP * push / 3.0;
        v += STEP * push / 3.0;
    }
    let (mut q, mut rates) = ([0.0; 2], [0.0; 2]);
    run.state(&mut q, &mut rates);
    let centre = |[a, b]: [f64; 2]| (a + 2.0 * b) / 3.0;
    assert!((centre(q) - x).abs() < 1e-9 && (centre(rates) - v).abs() < 1e-9, "{q:?} {x}, {rates:?} {v}");
    let jump = 8.0;
    assert!((q[0] - q[1]).abs() < 2.0 * STEP * STEP * jump, "{q:?}");
}

/// A step that is refused leaves no trace: with the input from before, the run goes on as one that was
/// given the same input anew. The inputs that are refused are infinite, or so large that the motion is
/// not finite.
#[test]
fn a_refused_step_leaves_the_run_as_it_was() {
    let live = Text::declaration("pair.mbs", PUSHED).compile().expect("a declaration");
    let run = || {
        let mut run = TrBdf2::builder(Prepared::new(&live), STEP).build().expect("a start");
        for _ in 0..50 {
            run.set_inputs(&[5.0]);
            run.step().expect("a regular motion");
        }
        run
    };
    let (mut refused, mut regular) = (run(), run());
    for push in [f64::INFINITY, f64::MAX, 1e307] {
        refused.set_inputs(&[push]);
        assert!(refused.step().is_err(), "{push:e}");
    }
    let [refused, regular] = [&mut refused, &mut regular].map(|run| {
        run.set_inputs(&[5.0]);
        run.step().expect("a regular motion");
        let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
        run.state(&mut q, &mut v);
        [q, v]
    });
    assert_eq!(refused, regular);
}

/// A text computes what its type does, to the bit.
#[test]
fn texts_run_alike() {
    let text = CRANK.replace("states = all ;", "").replace("states = all;", "");
    let live = Text::declaration("crank.mbs", &text).compile().expect("a declaration");
    let mut of_text = TrBdf2::builder(Prepared::new(&live), STEP).build().expect("a start");
    let mut of_type = TrBdf2::builder(Crank::declared(), STEP).build().expect("a start");
    of_text.advance(100).expect("a regular motion");
    of_type.advance(100).expect("a regular motion");
    let mut found = [[[0.0; 5]; 2]; 2];
    let runs: [&dyn System; 2] = [&of_text, &of_type];
    for (run, [q, v]) in runs.into_iter().zip(&mut found) {
        run.state(q, v);
    }
    assert_eq!(found[0], found[1]);
    let reduced = Text::declaration("reduced.mbs", REDUCED).compile().expect("a declaration");
    let mut of_text = TrBdf2::builder(Prepared::new(&reduced), STEP).build().expect("a start");
    let mut of_type = TrBdf2::builder(ReducedCrank::declared(), STEP).build().expect("a start");
    of_text.advance(100).expect("a regular motion");
    of_type.advance(100).expect("a regular motion");
    let runs: [&dyn System; 2] = [&of_text, &of_type];
    for (run, [q, v]) in runs.into_iter().zip(&mut found) {
        run.state(q, v);
    }
    assert_eq!(found[0], found[1]);
}

/// The operations of a stage stand in the description. A mechanism without forces of positions or velocities
/// has no stage of its own.
#[test]
fn operations_of_a_stage_are_told() {
    let of_stage = Crank::<f64>::INFO.operations("implicit").expect("a stiff mechanism");
    let explicit = Crank::<f64>::INFO.operations("constrained").expect("a mechanism");
    let total = |count: mbs_runtime::Operations| count.mul + count.add + count.div + count.other;
    println!("{of_stage:?}\n{explicit:?}");
    assert!(total(of_stage) > total(explicit) && total(of_stage) < 4 * total(explicit));
    assert!(of_stage.sin_cos == explicit.sin_cos);
    assert!(models::SliderCrank::<f64>::INFO.operations("implicit").is_none());
}
