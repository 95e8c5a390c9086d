//! The programs that are compared: methods, each with several steps or tolerances.

use mbs_runtime::{
    Adaptive, Bs3, Components, Dop853, Dopri5, Held, Heun, Mechanism, Method, Projected, Rk4, Scheme,
    Simulation, Tolerances,
};
use models::{SliderCrankFree, SliderCrankFreeInputs};

use super::by_hand;

const END: f64 = 0.3;
const TORQUE: f64 = 0.5;
const INPUTS: SliderCrankFreeInputs<f64> = SliderCrankFreeInputs { crank_torque: TORQUE };
/// The place of x3 among the coordinates.
const X3: usize = 6;
/// x3 is compared at so many instants at equal distances.
pub const SAMPLES: u32 = 30;

/// x3 at the instants.
pub type Samples = Vec<f64>;

/// A run by some method, with a step or a tolerance.
pub struct Program {
    pub method: &'static str,
    pub effort: String,
    /// Makes the run and looks at nothing but its end.
    pub run: Box<dyn Fn()>,
    sampled: Box<dyn Fn() -> Samples>,
}

impl Program {
    /// The largest error of x3.
    pub fn error(&self, reference: &Samples) -> f64 {
        (self.sampled)().iter().zip(reference).fold(0.0, |largest, (x, y)| f64::max(largest, (x - y).abs()))
    }
}

/// The method that a person writes, with which the others are compared.
pub const BY_HAND: &str = "by hand, RK4 in the angle";

/// The names of the methods.
pub fn methods() -> impl Iterator<Item = &'static str> {
    [
        BY_HAND,
        "Heun, feedback",
        "RK4, feedback",
        "RK4, projection",
        "BS3(2) to a tolerance",
        "DP5(4) to a tolerance",
        "DP5(4), reduced states",
        "DOP853 to a tolerance",
    ]
    .into_iter()
}

/// By the scheme of order 8 with 3,000 steps: within 10⁻¹³ m of runs with a third of them.
pub fn reference() -> Samples {
    sampled::<Projected<Dop853>>(3000)
}

fn simulation<X: Method>(steps: u32) -> Simulation<SliderCrankFree, X> {
    let builder = Simulation::builder(SliderCrankFree::declared(), END / f64::from(steps));
    builder.method::<X>().inputs(INPUTS).build().expect("a start")
}

fn sampled<X: Method>(steps: u32) -> Samples {
    let mut run = simulation::<X>(steps);
    let mut samples = vec![run.state().q.x3];
    for _ in 0..SAMPLES {
        for _ in 0..steps / SAMPLES {
            run.step().expect("a regular motion");
        }
        samples.push(run.state().q.x3);
    }
    samples
}

fn constant<X: Method>(method: &'static str, steps: u32) -> Program {
    let start = simulation::<X>(steps);
    let run = move || {
        let mut run = start;
        for _ in 0..steps {
            run.step().expect("a regular motion");
        }
        std::hint::black_box(run.state());
    };
    let sampled = Box::new(move || sampled::<X>(steps));
    Program { method, effort: format!("{steps} steps"), run: Box::new(run), sampled }
}

/// Of the mechanism with some choice of states.
fn adaptive<S: Scheme, M: Mechanism<Real = f64> + 'static>(
    method: &'static str,
    mechanism: M,
    power: i32,
) -> Program
where
    S::Stages<<M::States as Components>::Array>: 'static,
{
    let rtol = 10_f64.powi(-power);
    let tolerances = Tolerances { rtol, atol: 1e-2 * rtol, ..Tolerances::default() };
    let start = move || {
        let builder = Adaptive::builder(mechanism).scheme::<S>();
        builder.tolerances(tolerances).inputs(M::Inputs::splat(TORQUE)).build().expect("a start")
    };
    // the start is made consistent outside of the time that is taken, as for the others
    let at_start = start();
    let run = move || {
        let mut run = at_start.clone();
        run.advance_to(END).expect("a regular motion");
        std::hint::black_box(run.state());
    };
    let sampled = move || {
        let mut run = start();
        let times = (0..=SAMPLES).map(|at| END * f64::from(at) / f64::from(SAMPLES));
        let x3 = |t: f64| {
            run.cover(t).expect("a regular motion");
            run.at(t).expect("within the step").q.into_array().as_ref()[X3]
        };
        times.map(x3).collect()
    };
    Program { method, effort: format!("rtol 1e-{power}"), run: Box::new(run), sampled: Box::new(sampled) }
}

fn by_hand(method: &'static str, steps: u32) -> Program {
    let run = move || {
        let mut last = 0.0;
        by_hand::run(steps, END, TORQUE, |_, angle| last = angle);
        std::hint::black_box(last);
    };
    let sampled = move || {
        let mut samples = Samples::new();
        by_hand::run(steps, END, TORQUE, |step, angle| {
            if step % (steps / SAMPLES) == 0 {
                samples.push(by_hand::slider(angle));
            }
        });
        samples
    };
    Program { method, effort: format!("{steps} steps"), run: Box::new(run), sampled: Box::new(sampled) }
}

/// All programs, those of a method one after the other.
pub fn all() -> Vec<Program> {
    let names: Vec<&'static str> = methods().collect();
    let [hand, heun, rk4, projected, bs3, dopri5, angles, dop853] = names[..] else { return Vec::new() };
    let mut all = Vec::new();
    all.extend([60, 120, 240, 480, 960, 1920].map(|steps| by_hand(hand, steps)));
    all.extend([300, 600, 1200, 2400, 4800].map(|steps| constant::<Held<Heun>>(heun, steps)));
    all.extend([120, 240, 480, 960, 1920].map(|steps| constant::<Held<Rk4>>(rk4, steps)));
    all.extend([120, 240, 480, 960, 1920].map(|steps| constant::<Projected<Rk4>>(projected, steps)));
    let (free, with_angles) = (SliderCrankFree::declared(), reduced::SliderCrankFree::declared());
    all.extend((3..=7).map(|power| adaptive::<Bs3, _>(bs3, free, power)));
    all.extend((3..=11).map(|power| adaptive::<Dopri5, _>(dopri5, free, power)));
    all.extend((3..=11).map(|power| adaptive::<Dopri5, _>(angles, with_angles, power)));
    all.extend((3..=11).map(|power| adaptive::<Dop853, _>(dop853, free, power)));
    all
}
