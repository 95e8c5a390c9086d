//! Steps on columns of numbers.

use std::sync::Arc;

use mbs_codegen::FunctionId;
use mbs_runtime::__private::Spline;
use mbs_runtime::explicit::{self, Slopes, Span};
use mbs_runtime::{Explicit, Real};

use crate::arguments::Arguments;
use crate::code::{Code, Fixed};
use crate::instruction::Instruction;
use crate::live::Programs;

/// What runs instructions: for one number in a slot, or for many at once.
pub type Execute<T, const C: usize> = fn(&[Instruction], &[Spline], &mut [[T; C]]);

/// Vectors of columns.
type Columns<T, const C: usize> = Vec<[T; C]>;

/// Steps of `C` members of one mechanism, and room for them.
pub struct Steps<T, const C: usize> {
    programs: Arc<Programs>,
    execute: Execute<T, C>,
    memory: Memory<T, C>,
    /// q after the last step,
    pub q: Columns<T, C>,
    /// v after it,
    pub v: Columns<T, C>,
    /// and the pivot growths of its stages, added.
    pub growth: [T; C],
}

/// Slots, and vectors between stages.
enum Memory<T, const C: usize> {
    /// The whole step is one program.
    Fused(Arc<Code>, Columns<T, C>),
    Staged(Stages<T, C>),
}

struct Stages<T, const C: usize> {
    method: Explicit,
    /// The slots of the first stage, and those of the others.
    first: Columns<T, C>,
    others: Columns<T, C>,
    /// v and q̈ of every stage.
    velocities: Vec<Columns<T, C>>,
    accelerations: Vec<Columns<T, C>>,
    /// q of a stage behind the first one.
    there: Columns<T, C>,
    feedback: Columns<T, C>,
    unread: Columns<T, C>,
}

impl<T: Real, const C: usize> Steps<T, C> {
    /// Steps with this method; `number` gives what fixed slots hold.
    pub fn new(
        programs: &Arc<Programs>,
        method: Explicit,
        execute: Execute<T, C>,
        number: impl Fn(Fixed) -> [T; C],
    ) -> Self {
        let info = &programs.tables.info;
        let column = |count: usize| vec![[T::default(); C]; count];
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let memory = match programs.step(method) {
            Some(code) => Memory::Fused(Arc::clone(code), code.memory(number)),
            None => Memory::Staged(Stages {
                method,
                first: programs.function(FunctionId::Stabilized).memory(&number),
                others: programs.function(others(method)).memory(&number),
                velocities: vec![column(n); method.tableau.stage_count()],
                accelerations: vec![column(n); method.tableau.stage_count()],
                there: column(n),
                feedback: column(m),
                unread: column(m),
            }),
        };
        let (q, v) = (column(n), column(n));
        let programs = Arc::clone(programs);
        Self { programs, execute, memory, q, v, growth: [T::default(); C] }
    }

    /// The programs of the mechanism.
    pub fn programs(&self) -> &Programs {
        &self.programs
    }

    /// A step from `at`, whose step, gains and inputs are given too.
    pub fn step(&mut self, at: &Arguments<'_, T, C>) {
        let Self { programs, execute, memory, q, v, growth } = self;
        match memory {
            Memory::Fused(code, values) => {
                code.load(values, at);
                execute(&code.instructions, programs.tables.splines, values);
                code.store(values, &mut [q, v, std::slice::from_mut(growth)]);
            }
            Memory::Staged(stages) => *growth = stages.step(programs, *execute, at, q, v),
        }
    }
}

/// The function of the stages behind the first one.
fn others(method: Explicit) -> FunctionId {
    if method.is_held { FunctionId::Constrained } else { FunctionId::Stabilized }
}

impl<T: Real, const C: usize> Stages<T, C> {
    /// A step stage by stage; the growth.
    fn step(
        &mut self,
        programs: &Programs,
        execute: Execute<T, C>,
        at: &Arguments<'_, T, C>,
        q: &mut Columns<T, C>,
        v: &mut Columns<T, C>,
    ) -> [T; C] {
        let Self { method, first, others: slots, velocities, accelerations, there, feedback, unread } = self;
        q.copy_from_slice(at.q);
        if let Some(start) = velocities.first_mut() {
            start.copy_from_slice(at.v);
        }
        let span = Span { t: at.t, h: at.step, t_next: at.t_next };
        let slopes = Slopes { velocities, accelerations };
        let growth = explicit::step(method.tableau, &span, q, slopes, there, |stage, t, q, v, a| {
            let mut growth = [T::default(); C];
            let (function, slots) = match stage {
                0 => (FunctionId::Stabilized, &mut *first),
                _ => (others(*method), &mut *slots),
            };
            let code = programs.function(function);
            code.load(slots, &Arguments { t, q, v, feedback, ..*at });
            execute(&code.instructions, programs.tables.splines, slots);
            let end = std::slice::from_mut(&mut growth);
            match (stage, function) {
                (0, _) => code.store(slots, &mut [a, feedback, end]),
                (_, FunctionId::Constrained) => code.store(slots, &mut [a, end]),
                _ => code.store(slots, &mut [a, unread, end]),
            }
            growth
        });
        if let Some(end) = velocities.first() {
            v.copy_from_slice(end);
        }
        growth
    }
}
