//! The programs that are compared: the same steps of the same mechanism from
//! the same start, compiled by `mechanism!`, solved densely, and written by a
//! person.

use std::hint::black_box;

use mbs_runtime::{Baumgarte, Components, Held, Mechanism, Method as Integrator, PerStage, Simulation};
use models::slider_crank::SliderCrank;
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs};
use tests::by_hand::{Coordinates, Gains, Rows, SliderCrank as ByHand};
use tests::by_hand_on_pairs::Places;

/// The step in s.
pub const H: f64 = 0.5e-3;
/// Torque on the free crank in N·m.
const TORQUE: f64 = 0.5;

/// How a step is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Compiled from the declaration.
    Compiled,
    /// nalgebra's LU of the whole system, static size.
    Dense,
    /// Eliminated by a person, scalars.
    ByHand,
    /// Eliminated by a person, everything kept in vector registers.
    OnPairs,
}

/// A step comes with the clean multipliers at its start, or without.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reactions {
    None,
    /// Computed before it, by a call of their own.
    Before,
    /// Computed within it; with the torque of the drive.
    Within,
}

/// One program to be measured.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    pub method: Method,
    pub is_driven: bool,
    pub is_held: bool,
    pub reactions: Reactions,
}

impl Kernel {
    /// `driven held compiled`, …
    pub fn name(&self) -> String {
        let Self { method, .. } = self;
        format!("{} {}", self.case(), format!("{method:?}").to_lowercase())
    }

    /// The name without the method.
    pub fn case(&self) -> String {
        let motion = if self.is_driven { "driven" } else { "free" };
        let feedback = if self.is_held { "held" } else { "per-stage" };
        let reactions = match self.reactions {
            Reactions::None => "",
            Reactions::Before => " reactions",
            Reactions::Within => " with λ and torque",
        };
        format!("{motion} {feedback}{reactions}")
    }

    /// All of them, the methods of a case next to each other.
    pub fn all() -> Vec<Self> {
        let mut all = Vec::new();
        for is_driven in [true, false] {
            for is_held in [true, false] {
                for reactions in [Reactions::None, Reactions::Before, Reactions::Within] {
                    for method in [Method::Compiled, Method::Dense, Method::ByHand, Method::OnPairs] {
                        all.push(Self { method, is_driven, is_held, reactions });
                    }
                }
            }
        }
        // nobody wrote everything out by hand
        all.retain(|k| match k.method {
            Method::ByHand => match k.reactions {
                Reactions::None => true,
                Reactions::Before => k.is_driven,
                Reactions::Within => false,
            },
            Method::OnPairs => k.reactions == Reactions::None && !k.is_held,
            Method::Compiled | Method::Dense => true,
        });
        all
    }

    /// Takes `steps` steps from the start; the angle of the crank and the last
    /// multiplier of the slider's row.
    pub fn run(&self, steps: u32) -> (f64, f64) {
        match (self.method, self.is_held) {
            (Method::Compiled, true) => self.compiled::<Held>(steps),
            (Method::Compiled, false) => self.compiled::<PerStage>(steps),
            (Method::Dense, _) => self.dense(steps),
            (Method::ByHand, _) => self.by_hand(steps),
            (Method::OnPairs, _) if self.is_driven => self.on_pairs::<true>(steps),
            (Method::OnPairs, _) => self.on_pairs::<false>(steps),
        }
    }

    #[inline(never)]
    fn compiled<X: Integrator>(&self, steps: u32) -> (f64, f64) {
        if self.is_driven {
            let simulation = simulation::<_, X>(SliderCrank::declared(), Default::default());
            run_compiled(simulation, steps, self.reactions, |outputs| outputs.drive_torque)
        } else {
            let inputs = SliderCrankFreeInputs { crank_torque: TORQUE };
            let simulation = simulation::<_, X>(SliderCrankFree::declared(), inputs);
            run_compiled(simulation, steps, self.reactions, |_| TORQUE)
        }
    }

    fn start(&self) -> (ByHand, Gains, Coordinates, Coordinates) {
        let torque = if self.is_driven { 0.0 } else { TORQUE };
        let hand = ByHand { torque, ..ByHand::paper(1.0 / 12.0) };
        let (two_alpha, beta_squared) = if self.is_held {
            let best = Baumgarte::<Held>::deadbeat(H);
            (2.0 * best.alpha(), best.beta() * best.beta())
        } else {
            let best = Baumgarte::<PerStage>::deadbeat(H);
            (2.0 * best.alpha(), best.beta() * best.beta())
        };
        let ByHand { l1, l2, omega, .. } = hand;
        let q = Coordinates::from([l1 / 2.0, 0.0, 0.0, l1 + l2 / 2.0, 0.0, 0.0, l1 + l2]);
        let v = [0.0, l1 / 2.0 * omega, omega, 0.0, l1 / 2.0 * omega, -omega * l1 / l2, 0.0];
        (black_box(hand), black_box(Gains { two_alpha, beta_squared }), q, Coordinates::from(v))
    }

    #[inline(never)]
    fn dense(&self, steps: u32) -> (f64, f64) {
        let (hand, gains, mut q, mut v) = self.start();
        let solve = |q: &Coordinates, v: &Coordinates, feedback: &Rows| {
            let solution = if self.is_driven {
                hand.solve_driven(q, v, feedback)
            } else {
                hand.solve_free(q, v, feedback)
            };
            solution.unwrap_or_else(|| std::process::abort())
        };
        let mut reaction = 0.0;
        for k in 0..steps {
            let (t, t_next) = (f64::from(k) * H, f64::from(k + 1) * H);
            if self.reactions != Reactions::None {
                reaction = black_box(solve(&q, &v, &Rows::zeros())).multipliers[6];
            }
            let feedback = hand.feedback(t, &q, &v, &gains);
            let here = solve(&q, &v, &feedback).acceleration;
            let (predicted_q, predicted_v) = (q + v * H, v + here * H);
            let feedback = if self.is_held {
                feedback
            } else {
                hand.feedback(t_next, &predicted_q, &predicted_v, &gains)
            };
            let there = solve(&predicted_q, &predicted_v, &feedback).acceleration;
            q += (v + predicted_v) * (0.5 * H);
            v += (here + there) * (0.5 * H);
        }
        black_box((q, v));
        (q[2], reaction)
    }

    #[inline(never)]
    fn by_hand(&self, steps: u32) -> (f64, f64) {
        let (hand, gains, q, v) = self.start();
        let ([mut q], [mut v]) = (q.data.0, v.data.0);
        let mut reaction = 0.0;
        for k in 0..steps {
            let (t, t_next) = (f64::from(k) * H, f64::from(k + 1) * H);
            let stage = |q: &[f64; 7], v: &[f64; 7], t: f64| {
                if self.is_driven {
                    hand.accelerations_driven(q, v, t, &gains)
                } else {
                    hand.accelerations_free(q, v, &gains)
                }
            };
            let held = |q: &[f64; 7], v: &[f64; 7], feedback: &[f64; 7]| {
                if self.is_driven {
                    hand.accelerations_driven_held(q, v, feedback)
                } else {
                    hand.accelerations_free_held(q, v, feedback)
                }
            };
            if self.reactions != Reactions::None {
                let clean = held(&q, &v, &[0.0; 7]);
                reaction = black_box(hand.multipliers_driven(&q, &clean))[6];
            }
            let (here, feedback) = stage(&q, &v, t);
            let predicted_q: [f64; 7] = std::array::from_fn(|i| q[i] + H * v[i]);
            let predicted_v: [f64; 7] = std::array::from_fn(|i| v[i] + H * here[i]);
            let there = if self.is_held {
                held(&predicted_q, &predicted_v, &feedback)
            } else {
                stage(&predicted_q, &predicted_v, t_next).0
            };
            for i in 0..7 {
                q[i] += 0.5 * H * (v[i] + predicted_v[i]);
                v[i] += 0.5 * H * (here[i] + there[i]);
            }
        }
        black_box((q, v));
        (q[2], reaction)
    }

    #[inline(never)]
    fn on_pairs<const IS_DRIVEN: bool>(&self, steps: u32) -> (f64, f64) {
        let (hand, gains, q, v) = self.start();
        let ([q], [v]) = (q.data.0, v.data.0);
        let (mut q, mut v) = (Places::new(q), Places::new(v));
        for k in 0..steps {
            let times = [f64::from(k) * H, f64::from(k + 1) * H];
            (q, v) = hand.step_on_pairs::<IS_DRIVEN>((&q, &v), &gains, H, times);
        }
        black_box((q, v));
        (q.theta1(), 0.0)
    }
}

fn simulation<M: Mechanism, X: Integrator>(mechanism: M, inputs: M::Inputs) -> Simulation<M, X> {
    Simulation::builder(black_box(mechanism), H)
        .baumgarte(Baumgarte::<X>::deadbeat(H))
        .inputs(inputs)
        .build()
        .unwrap_or_else(|_| std::process::abort())
}

#[inline(never)]
fn run_compiled<M, X>(
    mut simulation: Simulation<M, X>,
    steps: u32,
    reactions: Reactions,
    torque: impl Fn(M::Outputs) -> f64,
) -> (f64, f64)
where
    M: Mechanism<Real = f64>,
    X: Integrator,
{
    let last = |multipliers: M::Constraints| {
        black_box(multipliers).into_array().as_ref().last().copied().unwrap_or(0.0)
    };
    let mut reaction = 0.0;
    // A loop for each, as a program has one of them.
    match reactions {
        Reactions::None => {
            for _ in 0..steps {
                done(simulation.step());
            }
        }
        Reactions::Before => {
            for _ in 0..steps {
                if let Ok(solved) = simulation.reactions() {
                    reaction = last(solved.multipliers);
                }
                done(simulation.step());
            }
        }
        Reactions::Within => {
            for _ in 0..steps {
                let before = simulation.state();
                let solved = done(simulation.step_with_reactions());
                reaction = last(solved.multipliers);
                let outputs = simulation.mechanism().outputs(&before, simulation.inputs(), &solved);
                black_box(torque(outputs));
            }
        }
    }
    black_box(simulation.state());
    (simulation.state().q.get("theta1").unwrap_or(f64::NAN), reaction)
}

fn done<T>(result: Result<T, mbs_runtime::Error>) -> T {
    result.unwrap_or_else(|_| std::process::abort())
}
