//! Steps on columns of numbers.

use std::sync::Arc;

use mbs_codegen::FunctionId;
use mbs_runtime::__private::Spline;
use mbs_runtime::explicit::Element;
use mbs_runtime::explicit::{self, Beside, Slopes, Span};
use mbs_runtime::{Explicit, Real, Stabilization};

use crate::arguments::Arguments;
use crate::code::{Code, Fixed};
use crate::instruction::Instruction;
use crate::live::Programs;

/// A function that runs instructions: for one number in a slot, or for many at once.
pub type Execute<T, const C: usize> = fn(&[Instruction], &[Spline], &mut [[T; C]]);

/// Vectors of columns.
type Columns<T, const C: usize> = Vec<[T; C]>;

/// Steps of `C` members of one mechanism, and room for them.
#[derive(Clone)]
pub struct Steps<T, const C: usize> {
    programs: Arc<Programs>,
    execute: Execute<T, C>,
    memory: Memory<T, C>,
    /// The positions that are integrated, after the last step.
    pub q: Columns<T, C>,
    /// The velocities of these positions after the last step.
    pub v: Columns<T, C>,
    /// The pivot growths of the stages of the last step, added.
    pub growth: [T; C],
}

/// Slots, and vectors between stages.
#[derive(Clone)]
enum Memory<T, const C: usize> {
    /// The whole step is one program.
    Fused(Arc<Code>, Columns<T, C>),
    Staged(Box<Stages<T, C>>),
}

#[derive(Clone)]
struct Stages<T, const C: usize> {
    method: Explicit,
    /// The slots of the first stage, and those of the others.
    first: Columns<T, C>,
    others: Columns<T, C>,
    /// The projection, if the method has one.
    projection: Option<Projection<T, C>>,
    /// v and q̈ of every stage.
    velocities: Vec<Columns<T, C>>,
    accelerations: Vec<Columns<T, C>>,
    /// q of a stage behind the first one.
    there: Columns<T, C>,
    feedback: Columns<T, C>,
    unread: Columns<T, C>,
}

/// The slots of the functions that project, and vectors between them.
#[derive(Clone)]
struct Projection<T, const C: usize> {
    slots: [Columns<T, C>; 4],
    /// All coordinates, velocities and corrections.
    all: [Columns<T, C>; 3],
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
        let (n, s, m) = (info.coordinates.len(), info.states.len(), info.constraints.len());
        let memory = match programs.step(method) {
            Some(code) => Memory::Fused(Arc::clone(code), code.memory(number)),
            None => Memory::Staged(Box::new(Stages {
                method,
                first: programs.function(first(method)).memory(&number),
                others: programs.function(others(method)).memory(&number),
                projection: method.is_projected().then(|| Projection {
                    slots: PROJECTION.map(|function| programs.function(function).memory(&number)),
                    all: [(); 3].map(|()| column(n)),
                }),
                velocities: vec![column(s); method.tableau.stage_count()],
                accelerations: vec![column(s); method.tableau.stage_count()],
                there: column(s),
                feedback: column(m),
                unread: column(m),
            })),
        };
        let (q, v) = (column(s), column(s));
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

/// The functions with which positions and velocities are projected.
const PROJECTION: [FunctionId; 4] =
    [FunctionId::Complete, FunctionId::Phi, FunctionId::PhiDot, FunctionId::Projection];

/// The function of the first stage.
fn first(method: Explicit) -> FunctionId {
    match method.stabilization {
        Stabilization::Held | Stabilization::PerStage => FunctionId::Stabilized,
        Stabilization::Projection => FunctionId::Constrained,
    }
}

/// The function of the stages behind the first one.
fn others(method: Explicit) -> FunctionId {
    match method.stabilization {
        Stabilization::PerStage => FunctionId::Stabilized,
        Stabilization::Held | Stabilization::Projection => FunctionId::Constrained,
    }
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
        let Self { method, first: of_first, others: of_others, velocities, accelerations, there, .. } = self;
        let Self { feedback, unread, projection, .. } = self;
        q.copy_from_slice(at.q);
        if let Some(start) = velocities.first_mut() {
            start.copy_from_slice(at.v);
        }
        let span = Span { t: at.t, h: at.step, t_next: at.t_next };
        let slopes = Slopes { velocities, accelerations };
        let mut growth = explicit::step(method.tableau, &span, q, slopes, there, |stage, t, q, v, a| {
            let mut growth = [T::default(); C];
            let (function, slots) = match stage {
                0 => (first(*method), &mut *of_first),
                _ => (others(*method), &mut *of_others),
            };
            let code = programs.function(function);
            code.load(slots, &Arguments { t, q, v, feedback, ..*at });
            execute(&code.instructions, programs.tables.splines, slots);
            let end = std::slice::from_mut(&mut growth);
            match (stage, function) {
                (_, FunctionId::Constrained) => code.store(slots, &mut [a, end]),
                (0, _) => code.store(slots, &mut [a, feedback, end]),
                _ => code.store(slots, &mut [a, unread, end]),
            }
            growth
        });
        if let (Some(projection), Some(v)) = (projection, velocities.first_mut()) {
            let at = Arguments { t: at.t_next, ..*at };
            let projected = explicit::project(q, v, there, |beside, delta| {
                projection.correct(programs, execute, &at, &beside, feedback, delta)
            });
            growth = growth.plus(projected);
            // the stages of the next step are given no feedback
            feedback.fill([T::default(); C]);
        }
        if let Some(end) = velocities.first() {
            v.copy_from_slice(end);
        }
        growth
    }
}

impl<T: Real, const C: usize> Projection<T, C> {
    /// Writes the correction of positions, or of the velocities there, that leads to the
    /// constraints; its growth.
    fn correct(
        &mut self,
        programs: &Programs,
        execute: Execute<T, C>,
        at: &Arguments<'_, T, C>,
        beside: &Beside<'_, Columns<T, C>>,
        violation: &mut Columns<T, C>,
        delta: &mut Columns<T, C>,
    ) -> [T; C] {
        let Self { slots: [of_complete, of_phi, of_phi_dot, of_projection], all: [q, v, correction] } = self;
        let run =
            |function, slots: &mut Columns<T, C>, at: &Arguments<'_, T, C>, results: &mut [&mut [[T; C]]]| {
                let code = programs.function(function);
                code.load(slots, at);
                execute(&code.instructions, programs.tables.splines, slots);
                code.store(slots, results);
            };
        // positions do not depend on velocities
        let states = Arguments { q: beside.q, v: beside.v.unwrap_or(beside.q), ..*at };
        run(FunctionId::Complete, of_complete, &states, &mut [&mut *q, &mut *v]);
        let at = Arguments { q, v, ..*at };
        match beside.v {
            None => run(FunctionId::Phi, of_phi, &at, &mut [violation]),
            Some(_) => run(FunctionId::PhiDot, of_phi_dot, &at, &mut [violation]),
        }
        let mut growth = [T::default(); C];
        let given = Arguments { feedback: violation, ..at };
        let end = std::slice::from_mut(&mut growth);
        run(FunctionId::Projection, of_projection, &given, &mut [&mut *correction, end]);
        for (delta, &state) in delta.iter_mut().zip(programs.tables.info.states) {
            if let Some(correction) = correction.get(state) {
                *delta = *correction;
            }
        }
        growth
    }
}
