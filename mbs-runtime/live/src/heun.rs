//! A step of Heun's method on columns of numbers.

use std::sync::Arc;

use mbs_codegen::FunctionId;
use mbs_runtime::__private::Spline;
use mbs_runtime::Real;

use crate::arguments::Arguments;
use crate::code::{Code, Fixed};
use crate::instruction::Instruction;
use crate::live::Programs;

/// What runs instructions: for one number in a slot, or for many at once.
pub type Execute<T, const C: usize> = fn(&[Instruction], &[Spline], &mut [[T; C]]);

/// Steps of `C` members of one mechanism, and room for them.
pub struct Heun<T, const C: usize> {
    programs: Arc<Programs>,
    is_held: bool,
    execute: Execute<T, C>,
    memory: Memory<T, C>,
    /// q after the last step,
    pub q: Vec<[T; C]>,
    /// v after it,
    pub v: Vec<[T; C]>,
    /// and the pivot growths of its stages, added.
    pub growth: [T; C],
}

/// Slots, and vectors between stages.
enum Memory<T, const C: usize> {
    /// The whole step is one program.
    Fused(Arc<Code>, Vec<[T; C]>),
    Staged(Stages<T, C>),
}

struct Stages<T, const C: usize> {
    first: Vec<[T; C]>,
    second: Vec<[T; C]>,
    /// q̈ and feedback of the first stage,
    here: Vec<[T; C]>,
    feedback: Vec<[T; C]>,
    /// and of the second.
    there: Vec<[T; C]>,
    unread: Vec<[T; C]>,
}

impl<T: Real, const C: usize> Heun<T, C> {
    /// Steps with feedback held over each or not; `number` gives what fixed slots hold.
    pub fn new(
        programs: &Arc<Programs>,
        is_held: bool,
        execute: Execute<T, C>,
        number: impl Fn(Fixed) -> [T; C],
    ) -> Self {
        let info = &programs.tables.info;
        let column = |count: usize| vec![[T::default(); C]; count];
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let memory = match programs.step(is_held) {
            Some(code) => Memory::Fused(Arc::clone(code), code.memory(number)),
            None => Memory::Staged(Stages {
                first: programs.function(FunctionId::Stabilized).memory(&number),
                second: programs.function(second(is_held)).memory(&number),
                here: column(n),
                feedback: column(m),
                there: column(n),
                unread: column(m),
            }),
        };
        let (q, v) = (column(n), column(n));
        let programs = Arc::clone(programs);
        Self { programs, is_held, execute, memory, q, v, growth: [T::default(); C] }
    }

    /// The programs of the mechanism.
    pub fn programs(&self) -> &Programs {
        &self.programs
    }

    /// A step from `at`, whose step, gains and inputs are given too.
    pub fn step(&mut self, at: &Arguments<'_, T, C>) {
        let Self { programs, is_held, execute, memory, q, v, growth } = self;
        let splines = programs.tables.splines;
        match memory {
            Memory::Fused(code, values) => {
                code.load(values, at);
                execute(&code.instructions, splines, values);
                code.store(values, &mut [q, v, std::slice::from_mut(growth)]);
            }
            Memory::Staged(stages) => *growth = stages.step(programs, *is_held, *execute, at, q, v),
        }
    }
}

fn second(is_held: bool) -> FunctionId {
    if is_held { FunctionId::Constrained } else { FunctionId::Stabilized }
}

impl<T: Real, const C: usize> Stages<T, C> {
    /// A step stage by stage, in the operations of `mbs_runtime`; the growth.
    fn step(
        &mut self,
        programs: &Programs,
        is_held: bool,
        execute: Execute<T, C>,
        at: &Arguments<'_, T, C>,
        q: &mut [[T; C]],
        v: &mut [[T; C]],
    ) -> [T; C] {
        let Self { first, second: values, here, feedback, there, unread } = self;
        let splines = programs.tables.splines;
        let mut growths = [[T::default(); C]; 2];
        let [growth_here, growth_there] = &mut growths;

        let stage = programs.function(FunctionId::Stabilized);
        stage.load(first, at);
        execute(&stage.instructions, splines, first);
        stage.store(first, &mut [here, feedback, std::slice::from_mut(growth_here)]);

        let start = || at.q.iter().zip(at.v);
        for ((q, v), ((q0, v0), a)) in q.iter_mut().zip(v.iter_mut()).zip(start().zip(here.iter())) {
            for c in 0..C {
                q[c] = q0[c] + at.step[c] * v0[c];
                v[c] = v0[c] + at.step[c] * a[c];
            }
        }
        let predicted = Arguments { t: at.t_next, q, v, feedback, ..*at };
        let stage = programs.function(second(is_held));
        stage.load(values, &predicted);
        execute(&stage.instructions, splines, values);
        let growth_there = std::slice::from_mut(growth_there);
        if is_held {
            stage.store(values, &mut [there, growth_there]);
        } else {
            stage.store(values, &mut [there, unread, growth_there]);
        }

        let half_step = at.step.map(|step| T::from_f64(0.5) * step);
        let rates = here.iter().zip(there.iter());
        for ((q, v), ((q0, v0), (a, b))) in q.iter_mut().zip(v).zip(start().zip(rates)) {
            for c in 0..C {
                q[c] = q0[c] + half_step[c] * (v0[c] + v[c]);
                v[c] = v0[c] + half_step[c] * (a[c] + b[c]);
            }
        }
        let [here, there] = growths;
        std::array::from_fn(|c| here[c] + there[c])
    }
}
