//! Outputs, and from how much they count to how much the state counts that they were measured of.

use mbs_codegen::FunctionId;
use mbs_runtime::Error;
use mbs_runtime::equations::{At, check_outputs};

use super::{Slots, add, put};
use crate::Live;
use crate::arguments::Arguments;
use crate::equations::{single, state};
use crate::instruction::execute;
use crate::transposed::{Counts, Transposes};

/// The functions of a measurement: complete, q̈ and λ, outputs.
pub const FUNCTIONS: [FunctionId; 3] = [FunctionId::Complete, FunctionId::Reactions, FunctionId::Outputs];
const COMPLETE: usize = 0;
const REACTIONS: usize = 1;
const OUTPUTS: usize = 2;

/// Room for measurements.
pub struct Measures {
    live: Live,
    forward: [Slots; 3],
    backward: [Slots; 3],
    /// All coordinates, velocities and accelerations.
    q: Slots,
    v: Slots,
    acceleration: Slots,
    multipliers: Slots,
    outputs: Slots,
    no_feedback: Slots,
    weights: Slots,
    /// What the state counted before.
    counted: Vec<f64>,
}

impl Measures {
    pub fn new(live: &Live, transposes: &Transposes) -> Self {
        let info = live.declared_info();
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let column = |count: usize| vec![[0.0]; count];
        Self {
            forward: FUNCTIONS
                .map(|function| live.programs().function(function).memory(|fixed| [live.fixed(fixed)])),
            backward: transposes.measures.each_ref().map(|it| it.code.memory(|fixed| [live.fixed(fixed)])),
            q: column(n),
            v: column(n),
            acceleration: column(n),
            multipliers: column(m),
            outputs: column(info.outputs.len()),
            no_feedback: column(m),
            weights: column((2 * n).max(n + m).max(info.outputs.len())),
            counted: vec![0.0; 2 * n],
            live: live.clone(),
        }
    }

    /// The outputs of a state of what is integrated.
    pub fn measure(&mut self, states: At<'_, f64>, inputs: &[f64]) -> Result<&[f64], Error> {
        let Self { live, forward, q, v, acceleration, multipliers, outputs, no_feedback, .. } = self;
        let programs = live.programs();
        let mut run = |which: usize, at: &Arguments<'_>, results: &mut [&mut [[f64; 1]]]| {
            let (function, slots) = (FUNCTIONS[which], &mut forward[which]);
            let code = programs.function(function);
            code.load(slots, at);
            execute(&code.instructions, programs.tables.splines, slots);
            code.store(slots, results);
        };
        let given = Arguments { inputs: single(inputs), ..state(states) };
        run(COMPLETE, &given, &mut [q, v]);
        let all = Arguments { q, v, feedback: no_feedback, ..given };
        run(REACTIONS, &all, &mut [acceleration, multipliers]);
        run(OUTPUTS, &Arguments { acceleration, multipliers, ..all }, &mut [outputs]);
        let outputs = outputs.as_flattened();
        check_outputs(live.declared_info(), states.t, outputs)?;
        Ok(outputs)
    }

    /// Adds what the outputs that were measured last count, to what that state and everything else does.
    pub fn backward(
        &mut self,
        transposes: &Transposes,
        states: At<'_, f64>,
        inputs: &[f64],
        weights: &[f64],
        counts: &mut Counts,
    ) {
        let layout = counts.layout;
        let [positions, velocities] = [layout.positions(), layout.velocities()];
        let state_counts = positions.start..velocities.end;
        self.counted.copy_from_slice(counts.part(state_counts.clone()));
        for range in [state_counts.clone(), layout.accelerations(), layout.multipliers()] {
            counts.part(range).fill(0.0);
        }
        let splines = self.live.programs().tables.splines;
        let Self { backward, q, v, acceleration, multipliers, no_feedback, weights: slots, .. } = self;
        let mut run = |which: usize, weights: &Slots, given: &Arguments<'_>, counts: &mut Counts| {
            let given = Arguments { weights, ..*given };
            transposes.measures[which].run(splines, &mut backward[which], &given, &mut counts.numbers);
        };
        let given = Arguments { inputs: single(inputs), ..state(states) };
        let all = Arguments { q, v, feedback: no_feedback, acceleration, multipliers, ..given };
        put(slots, weights);
        run(OUTPUTS, slots, &all, counts);
        // q̈ and then λ, which stand beside each other
        put(slots, counts.part(layout.accelerations().start..layout.multipliers().end));
        run(REACTIONS, slots, &all, counts);
        counts.part(layout.feedback()).fill(0.0);
        // q and then v
        put(slots, counts.part(state_counts.clone()));
        counts.part(state_counts.clone()).fill(0.0);
        run(COMPLETE, slots, &given, counts);
        add(counts.part(state_counts), &self.counted);
    }
}
