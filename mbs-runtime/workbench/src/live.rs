//! Mechanisms from texts as models: compiled in milliseconds, and run at once.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};

use mbs_analysis::Trials;
use mbs_ensemble::Cancelled;
use mbs_live::{LANES, Live, Pack, Prepared, Run};
use mbs_runtime::equations::{At, Equations, Partials};
use mbs_runtime::{Derivation, Error, Explicit, Info, Sketch, Stabilization, System, SystemClone, Tableau};
use rayon::prelude::*;

use crate::Model;
use crate::adaptive;
use crate::erased::Erased;
use crate::members::lanes::{Batch, InLanes};
use crate::members::{Extent, Member, extents};
use crate::settings::{Settings, Start, StartKind, StartState};

/// The mechanism that a text declares as a [`Model`] with these defaults: compiled in
/// milliseconds, and slower to run than one whose type the compiler knew.
///
/// # Errors
/// [`Declaration`](crate::Error::Declaration).
pub fn from_text(text: &mbs_live::Text, defaults: Settings) -> Result<Box<dyn Model>, crate::Error> {
    Ok(Box::new(FromText { live: text.compile()?, text: text.clone(), defaults }))
}

/// The mechanism that a text declares as a [`Model`], with the step and the feedback that it declares.
///
/// # Errors
/// [`Declaration`](crate::Error::Declaration).
pub fn as_declared(text: &mbs_live::Text) -> Result<Box<dyn Model>, crate::Error> {
    let live = text.compile()?;
    let defaults = declared(&live, Settings::default());
    Ok(Box::new(FromText { live, text: text.clone(), defaults }))
}

/// Step and feedback as they are declared.
fn declared(live: &Live, settings: Settings) -> Settings {
    let step = live.declared_step().unwrap_or(settings.step);
    let settings = Settings { fits_clocks: live.declared_step().is_none(), ..settings };
    let Some(feedback) = live.declared_feedback() else { return Settings { step, ..settings } };
    let stabilization = if feedback.is_held { Stabilization::Held } else { Stabilization::PerStage };
    let (alpha, beta) = (Some(feedback.alpha), Some(feedback.beta));
    Settings { step, stabilization: Some(stabilization), alpha, beta, ..settings }
}

struct FromText {
    live: Live,
    text: mbs_live::Text,
    defaults: Settings,
}

impl Model for FromText {
    fn info(&self) -> &'static Info {
        self.live.declared_info()
    }

    fn derivation(&self) -> &'static Derivation {
        self.live.derivation()
    }

    fn sketch(&self) -> &'static Sketch {
        self.live.sketch()
    }

    fn scheme(&self) -> &'static Tableau {
        self.live.declared_scheme()
    }

    fn declares_scheme(&self) -> bool {
        self.live.declares_scheme()
    }

    fn defaults(&self) -> Settings {
        self.defaults.clone()
    }

    fn clocks(&self, parameters: &[f64]) -> Result<Vec<[f64; 2]>, Error> {
        let live = self.with(parameters)?;
        Ok((0..self.info().sampling.clocks).map(|clock| live.clock(clock)).collect())
    }

    fn start(&self, start: &Start) -> Result<Box<dyn SystemClone>, Error> {
        let live = self.with(&start.parameters)?;
        if let Some(tolerances) = start.tolerances {
            return adaptive::start(Erased::new(Prepared::new(&live)), tolerances, start);
        }
        if let Some(method) = start.other {
            return adaptive::constant(Erased::new(Prepared::new(&live)), method, start);
        }
        if start.has_signals() {
            return adaptive::in_stages(Erased::new(Prepared::new(&live)), start);
        }
        Ok(Box::new(run(&live, start)?))
    }

    fn text(&self) -> Option<&mbs_live::Text> {
        Some(&self.text)
    }

    fn trials(&self) -> Option<Box<dyn Trials + Sync + '_>> {
        let over = self.live.over::<Partials>();
        Some(Box::new(move |parameters: &[Partials]| {
            let live = over.with_parameters(|own| own.copy_from_slice(parameters))?;
            Ok(Erased::new(Prepared::new(&live)))
        }))
    }

    fn in_lanes(&self) -> Option<&dyn InLanes> {
        // redundant constraints are judged run by run
        self.live.declared_info().redundant.is_empty().then_some(self as &dyn InLanes)
    }
}

impl InLanes for FromText {
    fn can_take(&self, _: Explicit) -> bool {
        true
    }

    fn width(&self) -> usize {
        LANES
    }

    fn run(&self, batch: &Batch<'_>, take: &mut dyn FnMut(usize, Member)) -> Result<(), Cancelled> {
        let packs: Vec<usize> = batch.members.clone().step_by(LANES).collect();
        let done = AtomicUsize::new(0);
        let pack = |first: usize| {
            let members = first..batch.members.end.min(first + LANES);
            let outcome = self.together(members.clone(), batch);
            if outcome.is_some() {
                (batch.progress)(members.len() + done.fetch_add(members.len(), Ordering::Relaxed));
            }
            (first, outcome)
        };
        let packs: Vec<_> = packs.into_par_iter().map(pack).collect();
        let mut finished = 0;
        for (first, outcome) in packs {
            for (at, member) in outcome.into_iter().flatten().enumerate() {
                take(first + at, member);
                finished += 1;
            }
        }
        if finished == batch.members.len() { Ok(()) } else { Err(Cancelled { finished }) }
    }
}

impl FromText {
    /// Runs some members together; nothing if they were cancelled.
    fn together(&self, members: Range<usize>, batch: &Batch<'_>) -> Option<Vec<Member>> {
        let begin = |index: usize| {
            let start = (batch.start)(index);
            let run = run(&self.with(&start.parameters)?, &start)?;
            let steps = run.steps_to(batch.end)?;
            Ok((run, steps))
        };
        let mut outcomes: Vec<Member> = Vec::new();
        let (mut places, mut runs, mut ends) = (Vec::new(), Vec::new(), Vec::new());
        for (place, begun) in members.map(begin).enumerate() {
            outcomes.push(begun.map(|(run, steps)| {
                places.push(place);
                runs.push(run);
                ends.push(steps);
                Vec::new()
            }));
        }
        let Some(last) = ends.iter().copied().max() else { return Some(outcomes) };
        let info = self.live.declared_info();
        let mut pack = match Pack::new(runs) {
            Ok(pack) => pack,
            Err(runs) => {
                for (place, run) in places.into_iter().zip(runs) {
                    let alone = extents(Box::new(run), info, batch.end, batch.cancel);
                    outcomes[place] = alone.transpose()?;
                }
                return Some(outcomes);
            }
        };
        let mut rows = vec![[f64::NAN; LANES]; info.coordinates.len() + info.outputs.len()];
        for taken in 0..=last {
            if taken.is_multiple_of(64) && batch.cancel.load(Ordering::Relaxed) {
                return None;
            }
            for (lane, error) in pack.observe(&mut rows) {
                outcomes[places[lane]] = Err(error);
            }
            for (lane, (&place, &end)) in places.iter().zip(&ends).enumerate() {
                if let (true, true, Ok(extents)) = (pack.goes_on(lane), taken <= end, &mut outcomes[place]) {
                    Extent::see_all(extents, rows.iter().map(|row| row[lane]));
                }
            }
            if taken < last {
                for (lane, error) in pack.step() {
                    if taken < ends[lane] {
                        outcomes[places[lane]] = Err(error);
                    }
                }
            }
        }
        Some(outcomes)
    }

    /// The mechanism with the parameters of a start.
    fn with(&self, given: &[f64]) -> Result<Live, Error> {
        self.live.with_parameters(|parameters| {
            parameters.iter_mut().zip(given).for_each(|(parameter, value)| *parameter = *value);
        })
    }
}

fn run(live: &Live, start: &Start) -> Result<Run, Error> {
    let mut builder = Run::builder(live, start.step)
        .method(start.method)
        .gains([start.alpha, start.beta])
        .inputs(&start.inputs);
    if let Some(StartState { start_time, steps_taken, q, v }) = &start.state {
        builder = builder.from_state(At { t: *start_time, q, v }).steps_taken(*steps_taken);
    }
    if start.kind == StartKind::Declared {
        builder = builder.as_declared();
    }
    if start.allow_unstable {
        builder = builder.allow_unstable();
    }
    builder.build()
}
