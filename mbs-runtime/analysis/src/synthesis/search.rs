//! From random starts to mechanisms without defects.

use std::f64::consts::{PI, TAU};

use nalgebra::DVector;
use rayon::prelude::*;

use super::circuit::passage;
use super::descent::descend;
use super::system::{Guess, System};
use super::{Defect, Linkage, Synthesis, Task};
use crate::{Error, Trials};

/// Starts that are made at once on all cores, before what they found is looked at.
const TOGETHER: usize = 128;
/// Mechanisms whose values differ by less than this part of their bounds are the same.
const SAME: f64 = 1e-5;
/// Positions are missed by less than this part of the tolerance, or not: how much does not matter then.
const EXACT: f64 = 1e-3;

/// Where a start led.
enum End {
    /// So far from the positions.
    Away(f64),
    /// To a mechanism, which may have a defect.
    There(Linkage, Option<Defect>),
}

impl Task {
    /// Looks for mechanisms that pass the positions in their order, on one circuit and without a turn of the
    /// drive.
    ///
    /// # Errors
    /// [`Error::Freedom`] for a mechanism with another number of degrees of freedom than 1; [`Error::Unknown`]
    /// for a name that it does not have; [`Error::NoBounds`], [`Error::Bounds`], [`Error::NoPositions`],
    /// [`Error::Length`] for what cannot be looked for. That none was found is no error.
    ///
    /// # Example
    /// A pin on a wheel moves a slider, x = r cos φ:
    /// ```
    /// use mbs_analysis::{Task, Unknown, trials_of_type};
    /// # use mbs_runtime::{Mechanism, mechanism};
    /// # mechanism! {
    /// #     /// A pin on a wheel moves a slider.
    /// #     pub Scotch {
    /// #         dof = 1;
    /// #         param r = 1 [m];
    /// #         body wheel (angle = phi) { inertia = 1 [kg*m^2]; }
    /// #         body slider (x) { mass = 1 [kg]; }
    /// #         constraint pin: x = r*cos(phi);
    /// #     }
    /// # }
    ///
    /// // from 0.3 m at 0 to half of that at 60°
    /// let task = Task {
    ///     unknown: vec![Unknown { name: "r".into(), guess: None, bounds: [0.1, 1.0] }],
    ///     columns: vec!["phi".into(), "x".into()],
    ///     positions: vec![vec![Some(0.0), Some(0.3)], vec![Some(std::f64::consts::FRAC_PI_3), Some(0.15)]],
    ///     ..Task::of(<Scotch as Mechanism>::INFO)
    /// };
    /// let found = task.synthesize(&trials_of_type::<Scotch>())?;
    /// assert!((found.linkages[0].values[0] - 0.3).abs() < 1e-8 && found.linkages[0].missed < 1e-9);
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    pub fn synthesize(&self, trials: &(dyn Trials + Sync)) -> Result<Synthesis, Error> {
        self.synthesize_while(trials, &mut |_, _| true)
    }

    /// Looks for mechanisms as [`synthesize`](Self::synthesize) does, as long as `goes_on` returns `true`. It is
    /// called now and then with the number of starts that are done and the number of mechanisms that are found. The
    /// result is what was found until then.
    ///
    /// # Errors
    /// As [`synthesize`](Self::synthesize).
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::{Task, Unknown};
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::equations::Partials;
    /// # let text = "Scotch {
    /// #     dof = 1;
    /// #     param r = 1 [m];
    /// #     body wheel (angle = phi) { inertia = 1 [kg*m^2]; }
    /// #     body slider (x) { mass = 1 [kg]; }
    /// #     constraint pin: x = r*cos(phi);
    /// # }";
    /// # let live = Text::declaration("scotch.mbs", text).compile()?;
    /// # let over = live.over::<Partials>();
    /// # let trials = |values: &[Partials]| {
    /// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
    /// #     Ok(Prepared::new(&live))
    /// # };
    /// // no radius below 0.29 m reaches 0.3 m: the search is given up after 100 starts
    /// let task = Task {
    ///     unknown: vec![Unknown { name: "r".into(), guess: None, bounds: [0.1, 0.29] }],
    ///     columns: vec!["phi".into(), "x".into()],
    ///     positions: vec![vec![Some(0.0), Some(0.3)], vec![Some(std::f64::consts::PI), Some(-0.3)]],
    ///     ..Task::of(live.declared_info())
    /// };
    /// let found = task.synthesize_while(&trials, &mut |starts, _| starts < 100)?;
    /// assert!(found.linkages.is_empty() && found.starts < 1000);
    /// assert!((found.nearest - 0.01).abs() < 1e-6);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn synthesize_while(
        &self,
        trials: &(dyn Trials + Sync),
        goes_on: &mut dyn FnMut(usize, usize) -> bool,
    ) -> Result<Synthesis, Error> {
        self.check()?;
        synthesize(self, trials, goes_on)
    }
}

/// Looks for mechanisms until there are enough.
fn synthesize(
    task: &Task,
    trials: &(dyn Trials + Sync),
    goes_on: &mut dyn FnMut(usize, usize) -> bool,
) -> Result<Synthesis, Error> {
    let system = System::new(task, trials)?;
    let refused = [Defect::Circuit, Defect::Order, Defect::Branch].map(|defect| (defect, 0));
    let mut found = Synthesis { linkages: Vec::new(), refused, starts: 0, nearest: f64::INFINITY };
    while found.starts < task.starts && found.linkages.len() < task.enough {
        let last = task.starts.min(found.starts + TOGETHER);
        let ends: Vec<End> =
            (found.starts..last).into_par_iter().filter_map(|start| attempt(&system, start)).collect();
        found.starts = last;
        ends.into_iter().for_each(|end| found.take(&system, end));
        if !goes_on(found.starts, found.linkages.len()) {
            break;
        }
    }
    let extent =
        |linkage: &Linkage| linkage.coordinates.iter().flatten().fold(0.0_f64, |a, q| a.max(q.abs()));
    let rank = |linkage: &Linkage| (linkage.missed.max(EXACT * task.tolerance), extent(linkage));
    found.linkages.sort_by(|a, b| {
        let ((missed, extent), (other, wider)) = (rank(a), rank(b));
        missed.total_cmp(&other).then(extent.total_cmp(&wider))
    });
    Ok(found)
}

impl Synthesis {
    fn take(&mut self, system: &System<'_>, end: End) {
        let (linkage, defect) = match end {
            End::Away(missed) => {
                self.nearest = self.nearest.min(missed);
                return;
            }
            End::There(linkage, defect) => (linkage, defect),
        };
        self.nearest = self.nearest.min(linkage.missed);
        if let Some(defect) = defect {
            let counts = self.refused.iter_mut().filter(|(other, _)| *other == defect);
            counts.for_each(|(_, count)| *count += 1);
            return;
        }
        let is_same = |other: &&mut Linkage| {
            let pairs = other.values.iter().zip(&linkage.values).zip(&system.scales[1]);
            pairs.into_iter().all(|((a, b), scale)| (a - b).abs() < SAME * scale)
        };
        match self.linkages.iter_mut().find(is_same) {
            Some(known) => known.count += 1,
            None => self.linkages.push(linkage),
        }
    }
}

/// One start; nothing where the mechanism refuses what it leads to.
fn attempt(system: &System<'_>, start: usize) -> Option<End> {
    let task = system.task;
    let mut random = Random(task.seed.wrapping_mul(0xd134_2543_de82_ef95) ^ (start as u64) << 20);
    let end = descend(system, guess(system, &mut random))?;
    let blocks = system.blocks(&end, 1.0, false)?;
    let missed = system.missed(&blocks);
    if missed > task.tolerance || blocks.iter().any(|block| block.residuals.amax() > 1e-6_f64.max(missed)) {
        return Some(End::Away(missed));
    }
    let (path, defect) = match passage(system, &end) {
        Ok(path) => (path, None),
        Err(defect) => (Vec::new(), Some(defect)),
    };
    let linkage = Linkage {
        values: end.values.iter().copied().collect(),
        coordinates: end.coordinates.iter().map(|q| q.iter().copied().collect()).collect(),
        path,
        missed,
        count: 1,
    };
    Some(End::There(linkage, defect))
}

/// Random values between their bounds, the same random position everywhere, and a turn of the drive.
fn guess(system: &System<'_>, random: &mut Random) -> Guess {
    let task = system.task;
    let values: Vec<f64> = task
        .unknown
        .iter()
        .map(|unknown| {
            let [low, high] = unknown.bounds;
            low + (high - low) * random.uniform()
        })
        .collect();
    let coordinate = |(at, declared): (usize, &f64)| {
        let part = 2.0 * random.uniform() - 1.0;
        declared + part * if system.is_angle(at) { PI } else { system.size }
    };
    let base = DVector::from_vec(system.declared.iter().enumerate().map(coordinate).collect());
    let turn = if random.uniform() < 0.5 { TAU } else { -TAU };
    let count = task.positions.len();
    let position = |at: usize| {
        let mut q = base.clone();
        if let Some(drive) = system.drive.filter(|drive| system.is_angle(*drive)) {
            q[drive] += turn * at as f64 / count as f64;
        }
        q
    };
    Guess { values: DVector::from_vec(values), coordinates: (0..count).map(position).collect() }
}

/// SplitMix64 (Steele, Lea, Flood 2014).
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}
