//! Ten derivatives of where the slider is at the end of a run: in reverse, and eight at a time forward.

use std::time::Instant;

use mbs_live::{Live, Moment, Run};
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{Dual, System};

use super::{H, REPETITIONS, STEPS, TORQUE};

/// Room for all states of a run.
const MEMORY: usize = 1 << 20;

pub struct Reverse {
    live: Live,
    variables: Vec<Variable>,
}

impl Reverse {
    /// By all parameters, and by the torque over each third of the run.
    pub fn of(live: &Live) -> Self {
        let info = live.declared_info();
        let parameters = info.parameters.iter().map(|parameter| Variable::Parameter(parameter.name));
        let part = |third: u64| Variable::Input {
            name: "crank_torque",
            from: third * STEPS / 3,
            until: (third + 1) * STEPS / 3,
        };
        Self { live: live.clone(), variables: parameters.chain((0..3).map(part)).collect() }
    }

    fn run(&self) -> f64 {
        let mut run = Run::builder(&self.live, H).inputs(&[TORQUE]).build().expect("a start");
        run.advance(STEPS).expect("a regular motion");
        run.q()[6]
    }

    fn backward(&self, memory: usize) -> Vec<f64> {
        let mut gradient = vec![0.0; self.variables.len()];
        let builder = Run::builder(&self.live, H).inputs(&[TORQUE]);
        let sum = Sum::new(STEPS, &self.variables);
        let term = |moment: &mut Moment<'_>| {
            if moment.step < STEPS {
                return Ok(0.0);
            }
            moment.by_q[6] = 1.0;
            Ok(moment.at.q[6])
        };
        builder.gradient_in_reverse(&sum, memory, term, &mut gradient).expect("a regular motion");
        gradient
    }

    fn forward(&self) -> Vec<f64> {
        let mut gradient = vec![0.0; self.variables.len()];
        let builder = Run::builder(&self.live, H).inputs(&[TORQUE]);
        let sum = Sum::new(STEPS, &self.variables);
        let term =
            |run: &Run<Dual<f64, 8>>| Ok(if run.steps() == STEPS { run.q()[6] } else { Dual::default() });
        builder.gradient(&sum, term, &mut gradient).expect("a regular motion");
        gradient
    }

    /// Whether both are the same: this is the test of the benchmark.
    pub fn is_forward(&self) -> bool {
        let (forward, backward) = (self.forward(), self.backward(MEMORY));
        let mut pairs = forward.iter().zip(&backward);
        pairs.all(|(forward, backward)| (forward - backward).abs() <= 1e-10 * (1.0 + forward.abs()))
    }

    /// Least times, in turns, over that of the run.
    pub fn print(&self) {
        // every 24th or 25th state, and those between two of them
        let few = 49 * 8 * 2 * self.live.declared_info().states.len();
        let mut least = [f64::INFINITY; 4];
        for _ in 0..REPETITIONS {
            let programs: [&dyn Fn() -> f64; 4] =
                [&|| self.run(), &|| self.backward(MEMORY)[0], &|| self.backward(few)[0], &|| {
                    self.forward()[0]
                }];
            for (program, least) in programs.iter().zip(&mut least) {
                let start = Instant::now();
                std::hint::black_box(program());
                *least = least.min(start.elapsed().as_secs_f64() * 1e6);
            }
        }
        let states = STEPS as usize * 8 * 2 * self.live.declared_info().states.len();
        println!("{} derivatives of a run of a text of {STEPS} steps, least times", self.variables.len());
        let names = [
            "the run".to_owned(),
            format!("in reverse, {states} bytes of states"),
            format!("in reverse, {few} bytes of states"),
            "forward, eight at a time".to_owned(),
        ];
        for (name, time) in names.iter().zip(least) {
            println!("{name:40} {time:8.1} µs, {:5.2} times", time / least[0]);
        }
    }
}
