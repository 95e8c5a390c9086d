//! Test whether the constant steps of a run are short enough for its forces.

use mbs_analysis::nalgebra::Complex;
use mbs_analysis::{Rates, rates};
use mbs_runtime::equations::At;
use mbs_runtime::{Composition, DOP853, Info, Row, System, Tableau};

use crate::doubt::Doubt;
use crate::instant::Instant;
use crate::settings::{OtherMethod, Start};

/// A run is looked at so often, at equal distances, and at the first steps whose number is a power of two.
const LOOKS: u64 = 12;
const FIRST: u64 = 64;
/// So many coordinates make a look expensive, and the looks at the first steps are left out.
const MANY: usize = 12;
/// Deviations that die away have grown by e in a run that is doubted.
const GROWN: f64 = 1.0;
/// The error of a step, as a share of the fastest motion, from which on a run is doubted: Heun's method has it
/// with less than thirty steps in a vibration, Kutta's of fourth order with eight.
const COARSE: f64 = 2e-3;
/// The same for implicit steps, which leave fast vibrations out, and the explicit steps of eighth order that one is
/// compared with.
const COARSE_IMPLICIT: f64 = 5e-2;
const PARTS: u32 = 8;
/// Of a step that is stable deviations grow by less than this in a run.
const LITTLE: f64 = 0.1;

/// Kind of the steps, which determines how deviations grow in them.
#[derive(Clone, Copy)]
enum Stepping {
    Explicit(&'static Tableau),
    Composed(&'static Composition),
    Implicit,
}

/// Stability and error of the steps of a run with a constant step.
pub(crate) struct Resolution {
    stepping: Stepping,
    step: f64,
    /// Steps between two looks.
    every: u64,
    looks_at_first: bool,
    /// 1 rad, or the size of the mechanism; of an own state the largest value so far.
    scales: Vec<f64>,
    /// How many of these are of coordinates of bodies.
    lines: usize,
    names: Vec<&'static str>,
    /// The fastest motion so far, in scales per second.
    speed: f64,
    /// The last look: after which step, and how deviations grow in a step.
    last: Option<(u64, f64)>,
    /// The exponent of the growth so far.
    growth: f64,
    worst: Option<Unstable>,
    /// The largest errors of velocities, and of own states, whose scales per second are these states.
    coarsest: [Option<Coarse>; 2],
    /// After which step an implicit one is looked at, the memories then, and velocities at its end by explicit steps, twice.
    expected: Option<(u64, Vec<f64>, [Vec<f64>; 2])>,
}

struct Unstable {
    growth: f64,
    at: f64,
    rates: Rates,
}

struct Coarse {
    /// In scales per second.
    error: f64,
    at: f64,
    coordinate: usize,
}

impl Resolution {
    /// Of a run of so many steps of a mechanism of this size; nothing where its steps follow from a tolerance.
    pub fn new(info: &'static Info, start: &Start, size: f64, steps: u64) -> Option<Self> {
        let stepping = match (start.other, start.tolerances) {
            // a run without a step has no error
            _ if steps == 0 => return None,
            (None, None) => Stepping::Explicit(start.method.tableau),
            (Some(OtherMethod::Rattle(composition)), _) => Stepping::Composed(composition),
            (Some(OtherMethod::Implicit(_)), None) => Stepping::Implicit,
            _ => return None,
        };
        let scale = |at: usize| if info.coordinates[at].dimension.length != 0 { size } else { 1.0 };
        let count = info.coordinates.len();
        Some(Self {
            stepping,
            step: start.step,
            every: steps.div_ceil(LOOKS).max(1),
            looks_at_first: count <= MANY,
            scales: (0..count).map(|at| if info.is_own(at) { 0.0 } else { scale(at) }).collect(),
            lines: info.lines,
            names: info.coordinates.iter().map(|q| q.name).collect(),
            speed: 0.0,
            last: None,
            growth: 0.0,
            worst: None,
            coarsest: [None, None],
            expected: None,
        })
    }

    /// Sees the state after some steps, with its accelerations if it is looked at.
    pub fn see(&mut self, run: &dyn System, now: &Instant, taken: u64) {
        for (at, (v, scale)) in now.v.iter().zip(&mut self.scales).enumerate() {
            match at < self.lines {
                true => self.speed = self.speed.max((v / *scale).abs()),
                false => *scale = scale.max(v.abs()),
            }
        }
        // what has jumped in the step is no error of it
        if let Some((_, before, [coarse, fine])) = self.expected.take_if(|(after, ..)| *after + 1 == taken)
            && memories_of_free(run) == Some(before)
        {
            self.compare(run.time(), &now.v, &fine, Some(&coarse));
        }
        let is_first = self.looks_at_first && taken <= FIRST && taken.is_power_of_two();
        if !is_first && !taken.is_multiple_of(self.every) {
            return;
        }
        let mut inputs = vec![0.0; run.equations().info().inputs.len()];
        run.inputs(&mut inputs);
        let at = At { t: run.time(), q: &now.q, v: &now.v };
        match self.stepping {
            Stepping::Explicit(tableau) => {
                self.look_at_rates(run, at, &inputs, taken);
                let stepped = |tableau, parts| stepped(tableau, run, at, &inputs, [self.step, parts]);
                let finer = if tableau.is(&DOP853) { 2.0 } else { 1.0 };
                let (found, finer) = (stepped(tableau, 1.0), stepped(&DOP853, finer));
                self.compare(at.t, &found, &finer, None);
            }
            Stepping::Composed(_) => self.look_at_rates(run, at, &inputs, taken),
            Stepping::Implicit => {
                let expected = [PARTS, 2 * PARTS]
                    .map(|parts| stepped(&DOP853, run, at, &inputs, [self.step, f64::from(parts)]));
                self.expected = memories_of_free(run).map(|memories| (taken, memories, expected));
            }
        }
    }

    fn look_at_rates(&mut self, run: &dyn System, at: At<'_, f64>, inputs: &[f64], taken: u64) {
        self.grow(taken);
        let Some(rates) = rates(run.equations(), at, inputs) else { return };
        let growth = self.stepping.growth(&rates, self.step);
        self.last = Some((taken, growth));
        if growth > self.worst.as_ref().map_or(0.0, |worst| worst.growth) {
            self.worst = Some(Unstable { growth, at: at.t, rates });
        }
    }

    /// Adds the growth of deviations since the last look.
    fn grow(&mut self, taken: u64) {
        if let Some((since, growth)) = self.last.take() {
            self.growth += growth * taken.saturating_sub(since) as f64;
        }
    }

    /// Compares velocities at the end of a step with those of a finer one; where a coarser one than that differs as
    /// much, neither tells anything.
    fn compare(&mut self, t: f64, found: &[f64], finer: &[f64], coarser: Option<&[f64]>) {
        let errors = |of: &[f64]| -> Vec<f64> {
            of.iter().zip(finer).zip(&self.scales).map(|((x, y), scale)| ((x - y) / scale).abs()).collect()
        };
        let lines = self.lines;
        let largest = |errors: Vec<f64>, are_states: bool| {
            // what is no number has an error of its own
            let finite = errors.into_iter().enumerate().filter(|(_, error)| error.is_finite());
            let kind = finite.filter(|(at, _)| (*at >= lines) == are_states);
            kind.max_by(|(_, a), (_, b)| a.total_cmp(b)).unwrap_or((0, 0.0))
        };
        for (are_states, coarsest) in [false, true].into_iter().zip(&mut self.coarsest) {
            let (coordinate, error) = largest(errors(found), are_states);
            let (_, unknown) = coarser.map_or((0, 0.0), |coarser| largest(errors(coarser), are_states));
            let is_known = unknown < 0.5 * error && finer.iter().all(|v| v.is_finite());
            if is_known && error > coarsest.as_ref().map_or(0.0, |coarsest| coarsest.error) {
                *coarsest = Some(Coarse { error, at: t, coordinate });
            }
        }
    }

    /// The doubt about a run of so many steps: unstable steps, or else coarse ones. `None` if they are neither.
    pub fn doubt(mut self, steps: u64) -> Option<Doubt> {
        self.grow(steps);
        let name = |at: usize| self.names.get(at).copied().unwrap_or_default();
        let step = self.step;
        if let Some(Unstable { at, rates, .. }) = self.worst.as_ref().filter(|_| self.growth > GROWN) {
            let fastest = rates.values.iter().map(|rate| rate.norm()).fold(0.0, f64::max);
            return Some(Doubt::Unstable {
                coordinate: name(rates.coordinate),
                at: *at,
                step,
                within: 1.0 / fastest,
                longest: self.longest(rates, steps),
            });
        }
        let shares = self.coarsest.iter().zip([self.speed, 1.0]);
        // what does not move at all has no share
        let shares = shares.filter(|(_, size)| *size > 0.0);
        let shares = shares.filter_map(|(coarsest, size)| Some((coarsest.as_ref()?, size)));
        let shares = shares.map(|(coarsest, size)| (coarsest, coarsest.error / size));
        let (Coarse { at, coordinate, .. }, share) = shares.max_by(|(_, a), (_, b)| a.total_cmp(b))?;
        let limit = if matches!(self.stepping, Stepping::Implicit) { COARSE_IMPLICIT } else { COARSE };
        (share > limit).then_some(Doubt::Coarse { coordinate: name(*coordinate), at: *at, step, share })
    }

    /// The longest step that is stable, about.
    fn longest(&self, rates: &Rates, steps: u64) -> f64 {
        let mut step = self.step;
        for _ in 0..100 {
            step *= 0.8;
            if self.stepping.growth(rates, step) * steps as f64 * self.step / step < LITTLE {
                break;
            }
        }
        step
    }
}

/// The memories of a run; nothing while a stop is rested on or a mode holds, whose forces no free step knows.
fn memories_of_free(run: &dyn System) -> Option<Vec<f64>> {
    let info = run.equations().info();
    let mut inputs = vec![0.0; info.inputs.len()];
    run.inputs(&mut inputs);
    let stops = info.stops.iter().map(|stop| stop.memory);
    let mut held = stops.chain(info.modes.modes.iter().map(|mode| mode.memory));
    let is_free = !held.any(|memory| inputs[memory] > 0.5);
    is_free.then(|| info.told_memories().map(|at| inputs[at]).collect())
}

impl Stepping {
    /// The exponent by which deviations grow in a step, beyond what they grow by in truth, or at all where they
    /// die away.
    fn growth(self, rates: &Rates, h: f64) -> f64 {
        let of = |rate: &Complex<f64>| {
            let z = rate * h;
            let factor = match self {
                Self::Explicit(tableau) => {
                    let coefficients = tableau.response.stability_function.iter().rev();
                    coefficients.fold(Complex::from(0.0), |sum, c| sum * z + Complex::from(*c)).norm()
                }
                Self::Composed(composition) => composed(composition, z.im.abs()),
                // they damp what they do not resolve
                Self::Implicit => 1.0,
            };
            factor.ln() - z.re.max(0.0)
        };
        rates.values.iter().map(of).fold(0.0, f64::max)
    }
}

/// By how much steps of RATTLE multiply a vibration that advances by so many radians in a step.
fn composed(composition: &Composition, advance: f64) -> f64 {
    let mut map = [[1.0, 0.0], [0.0, 1.0]];
    for share in composition.shares {
        let y = share * advance;
        // half a step of the force, a step of the position, and half a step of the force
        for [x, v] in &mut map {
            *v -= 0.5 * y * *x;
            *x += y * *v;
            *v -= 0.5 * y * *x;
        }
    }
    let half = 0.5 * (map[0][0] + map[1][1]).abs();
    if half > 1.0 { half + (half * half - 1.0).sqrt() } else { 1.0 }
}

/// Velocities after a step of `h` seconds in some parts, of all coordinates and without feedback.
fn stepped(
    tableau: &Tableau,
    run: &dyn System,
    at: At<'_, f64>,
    inputs: &[f64],
    [h, parts]: [f64; 2],
) -> Vec<f64> {
    let accelerated = |at: At<'_, f64>| {
        let mut acceleration = vec![0.0; at.q.len()];
        let mut multipliers = vec![0.0; run.equations().info().constraints.len()];
        run.equations().reactions(at, inputs, &mut acceleration, &mut multipliers);
        acceleration
    };
    let (part, mut q, mut v) = (h / parts, at.q.to_vec(), at.v.to_vec());
    for taken in 0..parts as u32 {
        let t = at.t + f64::from(taken) * part;
        [q, v] = advanced(tableau, At { t, q: &q, v: &v }, part, &accelerated);
    }
    v
}

/// Positions and velocities after a step of a scheme.
fn advanced(
    tableau: &Tableau,
    At { t, q, v }: At<'_, f64>,
    h: f64,
    accelerated: &dyn Fn(At<'_, f64>) -> Vec<f64>,
) -> [Vec<f64>; 2] {
    let mut velocities = vec![v.to_vec()];
    let mut accelerations = vec![accelerated(At { t, q, v })];
    let led = |row: &Row, from: &[f64], slopes: &[Vec<f64>]| -> Vec<f64> {
        let sum = |at: usize| row.terms().map(|(of, weight)| weight * slopes[of][at]).sum::<f64>();
        from.iter().enumerate().map(|(at, x)| x + row.share * h * sum(at)).collect()
    };
    for row in tableau.stages {
        let (q, v) = (led(row, q, &velocities), led(row, v, &accelerations));
        accelerations.push(accelerated(At { t: t + row.node() * h, q: &q, v: &v }));
        velocities.push(v);
    }
    [led(&tableau.update, q, &velocities), led(&tableau.update, v, &accelerations)]
}

#[cfg(test)]
mod tests {
    use mbs_runtime::{HEUN, RATTLE, RATTLE4, RK4};

    use super::*;

    fn growth(stepping: Stepping, rate: Complex<f64>) -> f64 {
        stepping.growth(&Rates { values: vec![rate], coordinate: 0 }, 1.0)
    }

    /// Heun's method is stable to z = −2, Kutta's to −2.785 and ±2.828 i, RATTLE to ±2 i; what grows by itself is
    /// no fault of a step.
    #[test]
    fn steps_are_stable_up_to_the_limits_of_their_schemes() {
        let (heun, rk4) = (Stepping::Explicit(&HEUN), Stepping::Explicit(&RK4));
        assert!(
            growth(heun, Complex::new(-1.99, 0.0)) <= 0.0 && growth(heun, Complex::new(-2.01, 0.0)) > 0.0
        );
        assert!(growth(rk4, Complex::new(-2.78, 0.0)) <= 0.0 && growth(rk4, Complex::new(-2.79, 0.0)) > 0.0);
        assert!(growth(rk4, Complex::new(0.0, 2.82)) <= 0.0 && growth(rk4, Complex::new(0.0, 2.83)) > 0.0);
        assert!(growth(rk4, Complex::new(0.5, 0.0)) < 1e-12);
        let found = growth(heun, Complex::new(0.0, 0.2));
        assert!((found - 0.2_f64.powi(4) / 8.0).abs() < 1e-5, "{found}");
        for (composition, limit) in [(&RATTLE, 2.0), (&RATTLE4, 2.72)] {
            let stepping = Stepping::Composed(composition);
            assert!(growth(stepping, Complex::new(0.0, 0.99 * limit)) == 0.0, "{}", composition.word);
            assert!(growth(stepping, Complex::new(0.0, 1.01 * limit)) > 0.0, "{}", composition.word);
        }
    }

    /// ẍ = −x: the error of a step of Heun's method in ẋ is h³/6 of it.
    #[test]
    fn a_step_is_that_of_its_scheme() {
        let accelerated = |at: At<'_, f64>| vec![-at.q[0]];
        let at = At { t: 0.0, q: &[0.0], v: &[1.0] };
        let [_, heun] = advanced(&HEUN, at, 0.1, &accelerated);
        let [q, v] = advanced(&DOP853, at, 0.1, &accelerated);
        assert!((q[0] - 0.1_f64.sin()).abs() < 1e-14 && (v[0] - 0.1_f64.cos()).abs() < 1e-14);
        assert!((heun[0] - (1.0 - 0.005)).abs() < 1e-15, "{heun:?}");
    }
}
