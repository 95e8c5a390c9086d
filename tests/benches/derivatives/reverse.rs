//! Ten derivatives of where the slider is at the end of a run, of its text and of its type: in reverse, and
//! forward.

use std::time::Instant;

use mbs_live::{Live, Run};
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::reverse::Moment;
use mbs_runtime::{Dual, Error, Simulation, System};
use reverse::slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs};

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

    fn run_of_type(&self) -> f64 {
        let mut run = typed().build().expect("a start");
        (0..STEPS).for_each(|_| run.step().expect("a regular motion"));
        run.state().q.x3
    }

    fn backward(&self, memory: usize) -> Vec<f64> {
        let builder = Run::builder(&self.live, H).inputs(&[TORQUE]);
        self.gradient(|sum, gradient| builder.gradient_in_reverse(sum, memory, end, gradient))
    }

    fn backward_of_type(&self, memory: usize) -> Vec<f64> {
        self.gradient(|sum, gradient| typed().gradient_in_reverse(sum, memory, end, gradient))
    }

    fn forward(&self) -> Vec<f64> {
        let builder = Run::builder(&self.live, H).inputs(&[TORQUE]);
        let term =
            |run: &Run<Dual<f64, 8>>| Ok(if run.steps() == STEPS { run.q()[6] } else { Dual::default() });
        self.gradient(|sum, gradient| builder.gradient(sum, term, gradient))
    }

    fn forward_of_type(&self) -> Vec<f64> {
        let term = |run: &Simulation<SliderCrankFree<Dual<f64, 4>>>| {
            Ok(if run.steps() == STEPS { run.state().q.x3 } else { Dual::default() })
        };
        self.gradient(|sum, gradient| typed().gradient(sum, term, gradient))
    }

    fn gradient(&self, run: impl FnOnce(&Sum<'_>, &mut [f64]) -> Result<f64, Error>) -> Vec<f64> {
        let mut gradient = vec![0.0; self.variables.len()];
        run(&Sum::new(STEPS, &self.variables), &mut gradient).expect("a regular motion");
        gradient
    }

    /// True if all are the same: this is the test of the benchmark.
    pub fn is_forward(&self) -> bool {
        let forward = self.forward();
        let others = [self.backward(MEMORY), self.backward_of_type(MEMORY), self.forward_of_type()];
        others.iter().all(|other| {
            let mut pairs = forward.iter().zip(other);
            pairs.all(|(forward, other)| (forward - other).abs() <= 1e-10 * (1.0 + forward.abs()))
        })
    }

    /// Least times, in turns, over that of the run.
    pub fn print(&self) {
        // every 24th or 25th state, and those between two of them
        let few = 49 * 8 * 2 * self.live.declared_info().states.len();
        let states = STEPS as usize * 8 * 2 * self.live.declared_info().states.len();
        println!("{} derivatives of a run of {STEPS} steps, least times", self.variables.len());
        print(
            "text",
            [states, few],
            "forward, eight at a time",
            [&|| self.run(), &|| self.backward(MEMORY)[0], &|| self.backward(few)[0], &|| self.forward()[0]],
        );
        print(
            "type",
            [states, few],
            "forward, four at a time",
            [
                &|| self.run_of_type(),
                &|| self.backward_of_type(MEMORY)[0],
                &|| self.backward_of_type(few)[0],
                &|| self.forward_of_type()[0],
            ],
        );
    }
}

/// The type, which is compiled with transposed programs.
fn typed() -> mbs_runtime::Builder<SliderCrankFree> {
    let inputs = SliderCrankFreeInputs { crank_torque: TORQUE };
    Simulation::builder(SliderCrankFree::declared(), H).inputs(inputs)
}

/// Where the slider is at the end.
fn end(moment: &mut Moment<'_>) -> Result<f64, Error> {
    if moment.step < STEPS {
        return Ok(0.0);
    }
    moment.by_q[6] = 1.0;
    Ok(moment.at.q[6])
}

fn print(what: &str, [states, few]: [usize; 2], forward: &str, programs: [&dyn Fn() -> f64; 4]) {
    let mut least = [f64::INFINITY; 4];
    for _ in 0..REPETITIONS {
        for (program, least) in programs.iter().zip(&mut least) {
            let start = Instant::now();
            std::hint::black_box(program());
            *least = least.min(start.elapsed().as_secs_f64() * 1e6);
        }
    }
    let names = [
        "the run".to_owned(),
        format!("in reverse, {states} bytes of states"),
        format!("in reverse, {few} bytes of states"),
        forward.to_owned(),
    ];
    for (name, time) in names.iter().zip(least) {
        println!("{what} {name:40} {time:8.1} µs, {:5.2} times", time / least[0]);
    }
}
