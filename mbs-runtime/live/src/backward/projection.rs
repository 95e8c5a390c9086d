//! Projection backward: from how much positions and velocities on the constraints count to how much those count
//! that were moved there.

use mbs_codegen::FunctionId;

use super::{Slots, add, put};
use crate::Live;
use crate::arguments::Arguments;
use crate::instruction::execute;
use crate::live::Programs;
use crate::transposed::{Counts, Transposes};

/// The functions with which positions and velocities are projected: complete, Φ, Φ̇, projection.
pub const FUNCTIONS: [FunctionId; 4] =
    [FunctionId::Complete, FunctionId::Phi, FunctionId::PhiDot, FunctionId::Projection];
const COMPLETE: usize = 0;
const PHI: usize = 1;
const PHI_DOT: usize = 2;
const PROJECTION: usize = 3;

/// Room for a projection.
pub struct Projection {
    forward: [Slots; 4],
    backward: [Slots; 4],
    /// What is integrated, before the projection,
    pub q: Slots,
    pub v: Slots,
    /// and positions behind it.
    moved: Slots,
    /// All coordinates before positions are projected,
    before: [Slots; 2],
    /// and behind, with velocities that are not.
    behind: [Slots; 2],
    /// Φ and Φ̇
    violations: [Slots; 2],
    correction: Slots,
    /// Weights of results.
    weights: Slots,
}

impl Projection {
    pub fn new(live: &Live, transposes: &Transposes) -> Self {
        let info = live.declared_info();
        let (n, m, s) = (info.coordinates.len(), info.constraints.len(), info.states.len());
        let column = |count: usize| vec![[0.0]; count];
        Self {
            forward: FUNCTIONS
                .map(|function| live.programs().function(function).memory(|fixed| [live.fixed(fixed)])),
            backward: transposes.projection.each_ref().map(|it| it.code.memory(|fixed| [live.fixed(fixed)])),
            q: column(s),
            v: column(s),
            moved: column(s),
            before: [(); 2].map(|()| column(n)),
            behind: [(); 2].map(|()| column(n)),
            violations: [(); 2].map(|()| column(m)),
            correction: column(n),
            weights: column(2 * n + m),
        }
    }

    /// The projection of q and v, as it was made.
    pub fn forward(&mut self, programs: &Programs, at: &Arguments<'_>) {
        let Self { forward, q, v, moved, before, behind, violations: [phi, phi_dot], correction, .. } = self;
        let mut run = |which: usize, at: &Arguments<'_>, results: &mut [&mut [[f64; 1]]]| {
            let (function, slots) = (FUNCTIONS[which], &mut forward[which]);
            let code = programs.function(function);
            code.load(slots, at);
            execute(&code.instructions, programs.tables.splines, slots);
            code.store(slots, results);
        };
        let at = Arguments { t: at.t_next, ..*at };
        let [q_all, v_all] = before;
        run(COMPLETE, &Arguments { q, v, ..at }, &mut [q_all, v_all]);
        run(PHI, &Arguments { q: q_all, ..at }, &mut [phi]);
        run(PROJECTION, &Arguments { q: q_all, feedback: phi, ..at }, &mut [correction]);
        for ((moved, q), &state) in moved.iter_mut().zip(&*q).zip(programs.tables.info.states) {
            *moved = [q[0] - correction[state][0]];
        }
        let [q_all, v_all] = behind;
        run(COMPLETE, &Arguments { q: moved, v, ..at }, &mut [q_all, v_all]);
        run(PHI_DOT, &Arguments { q: q_all, v: v_all, ..at }, &mut [phi_dot]);
    }

    /// From how much positions and velocities behind the projection count to how much those before it do.
    pub fn backward(
        &mut self,
        programs: (&Programs, &Transposes),
        at: &Arguments<'_>,
        [of_q, of_v]: [&mut [f64]; 2],
        counts: &mut Counts,
    ) {
        let (at, layout) = (Arguments { t: at.t_next, ..*at }, counts.layout);
        self.correct(PHI_DOT, programs, &at, of_v, counts);
        add(of_q, counts.part(layout.positions()));
        add(of_v, counts.part(layout.velocities()));
        self.correct(PHI, programs, &at, of_q, counts);
        add(of_q, counts.part(layout.positions()));
    }

    /// What a correction −Δ by a violation counts, to what it was made of: in the positions and the velocities
    /// of `counts`, of what is integrated.
    fn correct(
        &mut self,
        violation: usize,
        (programs, transposes): (&Programs, &Transposes),
        at: &Arguments<'_>,
        count: &[f64],
        counts: &mut Counts,
    ) {
        let layout = counts.layout;
        let is_rate = violation == PHI_DOT;
        let ([q, v], states) = if is_rate { (&self.behind, &self.moved) } else { (&self.before, &self.q) };
        let residual = &self.violations[usize::from(is_rate)];
        let splines = programs.tables.splines;
        for range in [layout.positions(), layout.velocities(), layout.feedback()] {
            counts.part(range).fill(0.0);
        }
        self.weights.iter_mut().for_each(|weight| *weight = [0.0]);
        for (&state, count) in programs.tables.info.states.iter().zip(count) {
            self.weights[state] = [-count];
        }
        let mut run = |which: usize, weights: &Slots, given: &Arguments<'_>, counts: &mut Counts| {
            let given = Arguments { weights, ..*given };
            transposes.projection[which].run(splines, &mut self.backward[which], &given, &mut counts.numbers);
        };
        run(PROJECTION, &self.weights, &Arguments { q, feedback: residual, ..*at }, counts);
        put(&mut self.weights, counts.part(layout.feedback()));
        counts.part(layout.feedback()).fill(0.0);
        run(violation, &self.weights, &Arguments { q, v, ..*at }, counts);
        // all coordinates, and then their velocities
        let n = q.len();
        put(&mut self.weights[..n], counts.part(layout.positions()));
        put(&mut self.weights[n..], counts.part(layout.velocities()));
        counts.part(layout.positions()).fill(0.0);
        counts.part(layout.velocities()).fill(0.0);
        run(COMPLETE, &self.weights, &Arguments { q: states, v: &self.v, ..*at }, counts);
    }
}
