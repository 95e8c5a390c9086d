//! Members of one mechanism that take their steps together.

use mbs_codegen::FunctionId;
use mbs_runtime::{Explicit, Gains, Lanes, growth_limit};

use crate::Live;
use crate::arguments::Arguments;
use crate::lanes::{Column, LANES, VECTORS, Vector, column, read, run, trouble, write, zip};
use crate::steps::Steps;

/// A member of a [`Block`].
pub struct Member<'a> {
    /// The mechanism, with its own parameters.
    pub mechanism: &'a Live,
    /// The coordinates that are integrated, and their velocities.
    pub q: &'a [f64],
    pub v: &'a [f64],
    pub inputs: &'a [f64],
    pub gains: Gains<f64>,
    /// h in s
    pub step: f64,
    /// The time of the start in s, and steps since then.
    pub start: f64,
    pub steps: u64,
}

/// As many members as there are lanes. A member comes out as its
/// [`Stepper`](crate::Stepper) alone does, to the last bit. Lanes cannot compute a sine or
/// cosine beyond 10⁹ rad, which is no number there.
pub struct Block {
    stepper: Steps<Vector, VECTORS>,
    q: Vec<Column>,
    v: Vec<Column>,
    inputs: Vec<Column>,
    gains: [Column; 2],
    step: Column,
    start: Column,
    steps: Column,
    measure: Measure,
}

/// Room to solve for reactions, and to measure outputs.
struct Measure {
    complete: Vec<Column>,
    /// All coordinates and velocities.
    all: [Vec<Column>; 2],
    reactions: Vec<Column>,
    outputs: Vec<Column>,
    no_feedback: Vec<Column>,
    acceleration: Vec<Column>,
    multipliers: Vec<Column>,
    measured: Vec<Column>,
}

impl Block {
    /// Members of the mechanism of `first`; `of` gives that of a lane.
    pub fn new<'a>(method: Explicit, first: &Live, of: impl Fn(usize) -> Member<'a>) -> Self {
        let each = |number: &dyn Fn(&Member<'_>) -> f64| column(|lane| number(&of(lane)));
        let component = |vector: &[f64], at: usize| vector.get(at).copied().unwrap_or(f64::NAN);
        let (info, programs) = (first.declared_info(), first.programs());
        let fixed = |fixed| each(&|it| it.mechanism.fixed(fixed));
        let (n, s, m) = (info.coordinates.len(), info.states.len(), info.constraints.len());
        let zeros = |count: usize| vec![column(|_| 0.0); count];
        Self {
            stepper: Steps::new(programs, method, run, fixed),
            q: (0..s).map(|at| each(&|it| component(it.q, at))).collect(),
            v: (0..s).map(|at| each(&|it| component(it.v, at))).collect(),
            inputs: (0..info.inputs.len()).map(|at| each(&|it| component(it.inputs, at))).collect(),
            gains: [each(&|it| it.gains.minus_two_alpha), each(&|it| it.gains.minus_beta_squared)],
            step: each(&|it| it.step),
            start: each(&|it| it.start),
            steps: each(&|it| it.steps as f64),
            measure: Measure {
                complete: programs.function(FunctionId::Complete).memory(fixed),
                all: [zeros(n), zeros(n)],
                reactions: programs.function(FunctionId::Reactions).memory(fixed),
                outputs: programs.function(FunctionId::Outputs).memory(fixed),
                no_feedback: zeros(m),
                acceleration: zeros(n),
                multipliers: zeros(m),
                measured: zeros(info.outputs.len()),
            },
        }
    }

    /// A step of every member, and which of them took it: a member stays where it is if its
    /// growth would be over its limit, or its state not finite.
    pub fn step(&mut self, limits: &[f64; LANES]) -> [bool; LANES] {
        let next = self.steps.map(|count| count + Lanes([1.0; _]));
        let (t, t_next) = (self.after(self.steps), self.after(next));
        let Self { stepper, q, v, inputs, gains, step, steps, .. } = self;
        stepper.step(&Arguments {
            t,
            q,
            v,
            inputs,
            gains: *gains,
            step: *step,
            t_next,
            ..Arguments::default()
        });
        let trouble = trouble(stepper.q.iter().chain(&stepper.v));
        let is_taken = std::array::from_fn(|lane| {
            read(&stepper.growth, lane) <= limits[lane] && read(&trouble, lane) == 0.0
        });
        if is_taken == [true; LANES] {
            std::mem::swap(q, &mut stepper.q);
            std::mem::swap(v, &mut stepper.v);
            *steps = next;
        } else {
            let states = q.iter_mut().zip(&stepper.q).chain(v.iter_mut().zip(&stepper.v));
            for (column, next) in states.chain([(steps, &next)]) {
                for lane in (0..LANES).filter(|&lane| is_taken[lane]) {
                    write(column, lane, read(next, lane));
                }
            }
        }
        is_taken
    }

    /// Times after so many steps.
    fn after(&self, steps: Column) -> Column {
        zip(self.start, zip(steps, self.step, |n, h| n * h), |t, span| t + span)
    }

    /// The coordinates and velocities of every member.
    fn completed(&mut self) -> &[Vec<Column>; 2] {
        let t = self.after(self.steps);
        let Self { stepper, q, v, measure: Measure { complete, all, .. }, .. } = self;
        let code = stepper.programs().function(FunctionId::Complete);
        code.load(complete, &Arguments { t, q, v, ..Arguments::default() });
        run(&code.instructions, stepper.programs().tables.splines, complete);
        let [q, v] = all;
        code.store(complete, &mut [q, v]);
        all
    }

    /// The outputs of every member, and whether they and the reactions are healthy.
    pub fn outputs(&mut self) -> (&[Column], [bool; LANES]) {
        let t = self.after(self.steps);
        self.completed();
        let Self { stepper, inputs, measure, .. } = self;
        let Measure { all: [q, v], reactions, outputs, no_feedback, .. } = measure;
        let Measure { acceleration, multipliers, measured, .. } = measure;
        let (programs, splines) = (stepper.programs(), stepper.programs().tables.splines);
        let at = Arguments { t, q, v, inputs, feedback: no_feedback, ..Arguments::default() };
        let mut growth = column(|_| f64::NAN);
        let code = programs.function(FunctionId::Reactions);
        code.load(reactions, &at);
        run(&code.instructions, splines, reactions);
        code.store(reactions, &mut [acceleration, multipliers, std::slice::from_mut(&mut growth)]);
        let code = programs.function(FunctionId::Outputs);
        code.load(outputs, &Arguments { acceleration, multipliers, ..at });
        run(&code.instructions, splines, outputs);
        code.store(outputs, &mut [measured]);
        let trouble = trouble(acceleration.iter().chain(multipliers.iter()).chain(measured.iter()));
        let is_healthy = std::array::from_fn(|lane| {
            read(&growth, lane) < growth_limit::<f64>() && read(&trouble, lane) == 0.0
        });
        (measured, is_healthy)
    }

    /// The pivot growth of the last step of a member, taken or not.
    pub fn growth(&self, lane: usize) -> f64 {
        read(&self.stepper.growth, lane)
    }

    /// The coordinates of every member, the first `lines` of which are of bodies; of an own state its value.
    pub fn observed(&mut self, lines: usize) -> impl ExactSizeIterator<Item = &Column> {
        let [q, v] = self.completed();
        q.iter().zip(v).enumerate().map(move |(at, (q, v))| if at < lines { q } else { v })
    }

    /// Copies what is integrated of a member; the steps since its start.
    pub fn get(&self, lane: usize, q: &mut [f64], v: &mut [f64]) -> u64 {
        let columns = self.q.iter().zip(q).chain(self.v.iter().zip(v));
        columns.for_each(|(column, number)| *number = read(column, lane));
        read(&self.steps, lane) as u64
    }

    /// Takes a member a step ahead to a state that was computed elsewhere.
    pub fn put(&mut self, lane: usize, q: &[f64], v: &[f64]) {
        for (column, &number) in self.q.iter_mut().zip(q).chain(self.v.iter_mut().zip(v)) {
            write(column, lane, number);
        }
        let next = read(&self.steps, lane) + 1.0;
        write(&mut self.steps, lane, next);
    }

    /// Sets the inputs of a member for the steps to come.
    pub fn set_inputs(&mut self, lane: usize, inputs: &[f64]) {
        for (column, &input) in self.inputs.iter_mut().zip(inputs) {
            write(column, lane, input);
        }
    }
}
