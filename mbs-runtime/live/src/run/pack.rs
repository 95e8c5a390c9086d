//! Runs of one mechanism that advance together.

use mbs_runtime::{Error, System};

use super::Run;
use crate::block::{Block, Member};
use crate::lanes::{LANES, read};

/// Up to [`LANES`](crate::LANES) runs of one mechanism that advance together: an instruction
/// is decoded once for all of them and done in vectors, so that a step of a member takes a
/// small part of what it takes alone.
///
/// Parameters, inputs, states, gains and steps are their own. A run does what it would do
/// alone, to the last bit; one that cannot make a step ends, and does not touch the others.
///
/// # Example
/// ```
/// use mbs_live::{Pack, Run, Text};
/// use mbs_runtime::System;
///
/// let text = "Pendulum {
///     dof = 1;
///     param length = 1 [m];
///     gravity = (0, -9.81) [m/s^2];
///     body bob (x, y) { mass = 2 [kg]; }
///     constraint rod: x^2 + y^2 = length^2;
///     start { x = length; guess y = 0; }
///     output height [m] = y + length;
/// }";
/// let pendulum = Text::declaration("pendulum.mbs", text).compile()?;
/// let swing = |length: f64| {
///     let longer = pendulum.with_parameters(|values| values[0] = length)?;
///     Run::builder(&longer, 1e-3).build()
/// };
/// let runs = vec![swing(0.5)?, swing(1.0)?, swing(2.0)?];
/// let mut pack = Pack::new(runs).map_err(|_| "they are alike")?;
/// for _ in 0..500 {
///     assert!(pack.step().is_empty());
/// }
/// // x, y and the height of all
/// let mut rows = vec![[0.0; mbs_live::LANES]; 3];
/// assert!(pack.observe(&mut rows).is_empty());
///
/// let mut alone = swing(2.0)?;
/// alone.advance(500)?;
/// let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
/// alone.state(&mut q, &mut v);
/// assert_eq!([rows[0][2], rows[1][2], rows[2][2]], [q[0], q[1], q[1] + 2.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Pack {
    /// Their states are in the block as long as they go on.
    runs: Vec<Run>,
    goes_on: Vec<bool>,
    block: Block,
}

impl Pack {
    /// These runs, each from where it is. See the example of [`Pack`].
    ///
    /// # Errors
    /// The runs themselves if there is none, if there are more than
    /// [`LANES`](crate::LANES), if their mechanisms do not
    /// [share their programs](crate::Live::shares_programs_with), if their methods
    /// differ, or if the mechanism has redundant constraints or stops, which
    /// are judged run by run.
    pub fn new(runs: Vec<Run>) -> Result<Self, Vec<Run>> {
        let Some(first) = runs.first() else { return Err(runs) };
        let is_like_first =
            |run: &Run| run.mechanism.shares_programs_with(&first.mechanism) && run.method == first.method;
        let info = first.mechanism.declared_info();
        let are_judged_alone = !info.redundant.is_empty() || info.jumps();
        if runs.len() > LANES || are_judged_alone || !runs.iter().all(is_like_first) {
            return Err(runs);
        }
        // lanes that are left over do what the first one does
        let member = |lane: usize| runs.get(lane).unwrap_or(first).member();
        let block = Block::new(first.method, &first.mechanism, member);
        Ok(Self { goes_on: vec![true; runs.len()], runs, block })
    }

    /// Advances every run that goes on by a step. The result has the runs that end now, with their errors; the state
    /// of such a run stays that of its last good step.
    pub fn step(&mut self) -> Vec<(usize, Error)> {
        let mut limits = [f64::INFINITY; LANES];
        for (limit, (run, goes_on)) in limits.iter_mut().zip(self.runs.iter().zip(&self.goes_on)) {
            if *goes_on {
                *limit = run.watch.alarm;
            }
        }
        let is_taken = self.block.step(&limits);
        let mut ended = Vec::new();
        for (lane, is_taken) in is_taken.into_iter().enumerate().take(self.runs.len()) {
            if is_taken && self.goes_on[lane] {
                self.runs[lane].watch.note(self.block.growth(lane));
                self.sample(lane);
            } else if let Err(error) = self.step_alone(lane) {
                self.goes_on[lane] = false;
                ended.push((lane, error));
            }
        }
        ended
    }

    /// Takes the samples of a run that are due.
    fn sample(&mut self, lane: usize) {
        if self.runs[lane].mechanism.declared_info().sampling.clocks > 0 {
            self.meet(lane);
            let run = &mut self.runs[lane];
            run.sample();
            self.block.set_inputs(lane, &run.inputs);
        }
    }

    /// A step of a run by itself, if it goes on: it finds out what went wrong, or computes
    /// what lanes cannot.
    fn step_alone(&mut self, lane: usize) -> Result<(), Error> {
        if !self.goes_on[lane] {
            return Ok(());
        }
        self.meet(lane);
        let run = &mut self.runs[lane];
        run.step()?;
        self.block.put(lane, &run.q, &run.v);
        self.block.set_inputs(lane, &run.inputs);
        Ok(())
    }

    /// Writes coordinates and outputs of every run that goes on: a row for each coordinate,
    /// then one for each output, with a number for each run. Runs whose reactions or outputs
    /// are not finite end; the result has them with their errors.
    pub fn observe(&mut self, rows: &mut [[f64; LANES]]) -> Vec<(usize, Error)> {
        let lanes = 0..self.runs.len();
        let lines = self.runs.first().map_or(0, |run| run.mechanism.declared_info().lines);
        let positions = self.block.observed(lines);
        let (of_coordinates, of_outputs) = rows.split_at_mut(positions.len().min(rows.len()));
        for (row, column) in of_coordinates.iter_mut().zip(positions) {
            lanes.clone().filter(|&lane| self.goes_on[lane]).for_each(|lane| row[lane] = read(column, lane));
        }
        let (outputs, is_healthy) = self.block.outputs();
        for (row, column) in of_outputs.iter_mut().zip(outputs) {
            let lanes = lanes.clone().filter(|&lane| is_healthy[lane] && self.goes_on[lane]);
            lanes.for_each(|lane| row[lane] = read(column, lane));
        }
        let mut ended = Vec::new();
        for lane in lanes.filter(|&lane| !is_healthy[lane]) {
            if let Err(error) = self.observe_alone(lane, of_outputs) {
                self.goes_on[lane] = false;
                ended.push((lane, error));
            }
        }
        ended
    }

    /// The outputs of a run by itself, if it goes on.
    fn observe_alone(&mut self, lane: usize, rows: &mut [[f64; LANES]]) -> Result<(), Error> {
        if !self.goes_on[lane] {
            return Ok(());
        }
        self.meet(lane);
        let run = &self.runs[lane];
        let info = run.mechanism.declared_info();
        let mut acceleration = vec![0.0; info.coordinates.len()];
        let mut multipliers = vec![0.0; info.constraints.len()];
        let mut outputs = vec![0.0; info.outputs.len()];
        run.reactions(&mut acceleration, &mut multipliers)?;
        run.outputs(&acceleration, &multipliers, &mut outputs)?;
        rows.iter_mut().zip(outputs).for_each(|(row, output)| row[lane] = output);
        Ok(())
    }

    /// Brings a run to where its lane is.
    fn meet(&mut self, lane: usize) {
        let run = &mut self.runs[lane];
        run.steps = self.block.get(lane, &mut run.q, &mut run.v);
        run.t = run.start_time + run.steps as f64 * run.step;
    }

    /// True if a run goes on; one that does not exist does not. See the example of
    /// [`set_inputs`](Self::set_inputs).
    pub fn goes_on(&self, lane: usize) -> bool {
        self.goes_on.get(lane).copied().unwrap_or(false)
    }

    /// Sets the inputs of a run for the steps to come, in SI units.
    ///
    /// # Example
    /// Carts of 2 kg, pushed by their own forces:
    /// ```
    /// use mbs_live::{Pack, Run, Text};
    /// # let text = "Cart {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body cart (x) { mass = 2 [kg]; }
    /// #     force pushed on x = push;
    /// # }";
    ///
    /// let cart = Text::declaration("cart.mbs", text).compile()?;
    /// let run = Run::builder(&cart, 1e-2).build()?;
    /// let mut pack = Pack::new(vec![run.clone(), run]).map_err(|_| "they are alike")?;
    /// pack.set_inputs(1, &[6.0]);
    /// for _ in 0..100 {
    ///     pack.step();
    /// }
    /// assert!(pack.goes_on(1) && !pack.goes_on(2));
    /// // after a second: v = a t
    /// let speeds: Vec<f64> = pack.into_runs().iter().map(|run| run.v()[0]).collect();
    /// assert!(speeds[0] == 0.0 && (speeds[1] - 3.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn set_inputs(&mut self, lane: usize, inputs: &[f64]) {
        if let Some(run) = self.runs.get_mut(lane) {
            run.set_inputs(inputs);
            self.block.set_inputs(lane, &run.inputs);
        }
    }

    /// The runs, each where it is now or where it ended. See the example of [`set_inputs`](Self::set_inputs).
    pub fn into_runs(mut self) -> Vec<Run> {
        for lane in 0..self.runs.len() {
            if self.goes_on[lane] {
                self.meet(lane);
            }
        }
        self.runs
    }
}

impl Run {
    /// The run as a member of a block.
    fn member(&self) -> Member<'_> {
        Member {
            mechanism: &self.mechanism,
            q: &self.q,
            v: &self.v,
            inputs: &self.inputs,
            gains: self.gains,
            step: self.step,
            start: self.start_time,
            steps: self.steps,
        }
    }
}
