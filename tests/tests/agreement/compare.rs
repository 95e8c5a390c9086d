//! A compiled mechanism and one from the same text, side by side.

use crate::packs::packs_agree;
use crate::runs::{runs_agree, tolerances_agree};
use mbs_live::{Live, Stepper, Text};
use mbs_runtime::equations::{At, Equations, Room, consistent};
use mbs_runtime::{
    Baumgarte, Components, Dop853, Gains, Held, Mechanism, Method, PerStage, Projected, Rk4, Simulation,
    State,
};

const STEPS: usize = 1000;

/// Everything that both compute is the same, to the last bit.
pub fn agree<M: Mechanism<Real = f64>>(text: &str, inputs: &[f64], h: f64)
where
    M::Parameters: Default,
{
    let live = Text::declaration("mechanism.mbs", text).compile().expect("a mechanism");
    let mechanism = M::new(M::Parameters::default()).expect("declared parameters");
    assert_eq!(live.info(), M::INFO);
    assert_eq!(live.parameters(), numbers(*mechanism.parameters()));
    functions_agree(&live, &mechanism, inputs);
    start_agrees(&live, &mechanism, h);
    steps_agree::<M, Held>(&live, mechanism, inputs, Baumgarte::<Held>::deadbeat(h), h);
    steps_agree::<M, PerStage>(&live, mechanism, inputs, Baumgarte::<PerStage>::deadbeat(h), h);
    steps_agree::<M, Held<Rk4>>(&live, mechanism, inputs, Baumgarte::deadbeat(h), h);
    steps_agree::<M, PerStage<Rk4>>(&live, mechanism, inputs, Baumgarte::deadbeat(h), h);
    steps_agree::<M, Projected>(&live, mechanism, inputs, Baumgarte::NONE, h);
    steps_agree::<M, Projected<Dop853>>(&live, mechanism, inputs, Baumgarte::NONE, h);
    tolerances_agree(&live, mechanism, inputs, h);
    runs_agree(&live, mechanism, inputs, h);
    packs_agree(&live, inputs, h);
}

pub fn numbers<C: Components<Real = f64>>(components: C) -> Vec<f64> {
    components.into_array().as_ref().to_vec()
}

pub fn of<C: Components<Real = f64>>(numbers: &[f64]) -> C {
    let mut array = C::splat(0.0).into_array();
    array.as_mut().copy_from_slice(numbers);
    C::from_array(array)
}

/// Two lists are the same to the bit; one no number is as good as another.
#[track_caller]
pub fn same(what: &str, found: &[f64], expected: &[f64]) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (at, (x, y)) in found.iter().zip(expected).enumerate() {
        assert!(x.to_bits() == y.to_bits() || x.is_nan() && y.is_nan(), "{what}, {at}: {x:e} and {y:e}");
    }
}

/// Uniform in −1 … 1.
fn random(state: &mut u64) -> f64 {
    *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
    (*state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

fn gains<X: Method>(best: &Baumgarte<X>) -> Gains<f64> {
    Gains { minus_two_alpha: -2.0 * best.alpha(), minus_beta_squared: -best.beta() * best.beta() }
}

/// The functions of [`Equations`] at random states near the declared start.
fn functions_agree<M: Mechanism<Real = f64>>(live: &Live, mechanism: &M, inputs: &[f64]) {
    let State { q, v, .. } = mechanism.declared_start();
    let (n, m) = (M::INFO.coordinates.len(), M::INFO.constraints.len());
    let gains = Gains { minus_two_alpha: -300.0, minus_beta_squared: -2e5 };
    let mut seed = 5;
    for round in 0..50 {
        let mut near = |values: Vec<f64>, size: f64| -> Vec<f64> {
            values.iter().map(|value| value + size * random(&mut seed)).collect()
        };
        let (q, v) = (near(numbers(q), 0.1), near(numbers(v), 3.0));
        let feedback = near(vec![0.0; m], 1.0);
        let t = 0.01 * f64::from(round);
        let (at, state) = (At { t, q: &q, v: &v }, State { t, q: of(&q), v: of(&v) });
        let typed_inputs = of(inputs);

        let mut rows = vec![0.0; m];
        live.phi(t, &q, &mut rows);
        same("phi", &rows, &numbers(mechanism.phi(t, &state.q)));
        live.phi_dot(at, &mut rows);
        same("phi_dot", &rows, &numbers(mechanism.phi_dot(&state)));

        let states = State { t, q: M::states(state.q), v: M::states(state.v) };
        let (q_states, v_states) = (numbers(states.q), numbers(states.v));
        let at_states = At { t, q: &q_states, v: &v_states };
        let (mut q_all, mut v_all) = (vec![0.0; n], vec![0.0; n]);
        live.complete(at_states, &mut q_all, &mut v_all);
        let all = Mechanism::complete(mechanism, &states);
        same("complete", &[q_all, v_all].concat(), &[numbers(all.q), numbers(all.v)].concat());

        let mut found = vec![0.0; M::INFO.states.len()];
        let growth = live.stabilized(at_states, inputs, &gains, &mut found, &mut rows);
        let solved = mechanism.stabilized(&states, &typed_inputs, &gains);
        same("stabilized", &found, &numbers(solved.acceleration));
        same("feedback", &rows, &numbers(solved.feedback));
        same("growth", &[growth], &[solved.growth]);

        let growth = live.constrained(at_states, inputs, &feedback, &mut found);
        let solved = mechanism.constrained(&states, &typed_inputs, &of(&feedback));
        same("constrained", &found, &numbers(solved.acceleration));
        same("growth", &[growth], &[solved.growth]);

        let mut found = vec![0.0; n];
        let growth = live.accelerations(at, inputs, &feedback, &mut found);
        let solved = mechanism.reactions(&state, &typed_inputs, &of(&feedback));
        same("accelerations", &found, &numbers(solved.acceleration));
        same("growth", &[growth], &[solved.growth]);

        let growth = live.position_correction(t, &q, &feedback, &mut found);
        let solved = mechanism.position_correction(t, &state.q, &of(&feedback));
        same("position_correction", &found, &numbers(solved.acceleration));
        same("growth", &[growth], &[solved.growth]);

        let growth = live.velocity_correction(t, &q, &feedback, &mut found);
        let solved = mechanism.velocity_correction(t, &state.q, &of(&feedback));
        same("velocity_correction", &found, &numbers(solved.acceleration));
        same("growth", &[growth], &[solved.growth]);

        let growth = live.projection(t, &q, &feedback, &mut found);
        let solved = mechanism.projection(t, &state.q, &of(&feedback));
        same("projection", &found, &numbers(solved.acceleration));
        same("growth", &[growth], &[solved.growth]);

        assert_eq!(live.worst_pivot(t, &q), mechanism.worst_pivot(t, &state.q));
        assert_eq!(live.worst_start_pivot(t, &q), mechanism.worst_start_pivot(t, &state.q));
        same("energy", &[live.kinetic_energy(at)], &[mechanism.kinetic_energy(&state)]);
    }
}

/// The declared start, made consistent by the function that both use.
fn start_agrees<M: Mechanism<Real = f64>>(live: &Live, mechanism: &M, h: f64) {
    let declared = mechanism.declared_start();
    let (mut q, mut v) = (numbers(declared.q), numbers(declared.v));
    let mut vectors = vec![0.0; Room::<f64>::len(M::INFO, 0)];
    let mut room = Room::within(&mut vectors, M::INFO);
    consistent(live, declared.t, &mut q, &mut v, &mut room).expect("a start");
    let start = Simulation::new(*mechanism, h).expect("a start").state();
    same("start", &q, &numbers(start.q));
    same("velocities of the start", &v, &numbers(start.v));
}

fn steps_agree<M: Mechanism<Real = f64>, X: Method>(
    live: &Live,
    mechanism: M,
    inputs: &[f64],
    baumgarte: Baumgarte<X>,
    h: f64,
) {
    let mut run =
        Simulation::builder(mechanism, h).inputs(of(inputs)).baumgarte(baumgarte).build().expect("a start");
    let mut steps = Stepper::new(live, X::EXPLICIT);
    let gains = gains(&baumgarte);
    let start = run.state();
    let (mut q, mut v) = (numbers(start.q), numbers(start.v));
    let mut worst = 0.0_f64;
    for k in 1..=STEPS {
        let t = run.time();
        let t_next = start.t + k as f64 * h;
        let growth = steps.step(At { t, q: &q, v: &v }, inputs, &gains, h, t_next);
        worst = worst.max(growth);
        run.step().expect("a step");
        q.copy_from_slice(steps.q());
        v.copy_from_slice(steps.v());
        same("q", &q, &numbers(run.state().q));
        same("v", &v, &numbers(run.state().v));
        assert_eq!(run.time(), t_next);
    }
    same("growth", &[worst], &[run.worst_growth()]);
}
