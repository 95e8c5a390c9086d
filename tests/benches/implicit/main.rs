//! Implicit schemes to a tolerance beside TR-BDF2 with a constant step and explicit pairs to a tolerance, on a
//! slider-crank whose crank pin is a stiff bushing, one turn, as a text: steps, errors of the crank angle, and
//! times over that of `dopri5` at 10⁻⁶. `cargo bench -p tests --bench implicit -- --figure FILE.svg`
#![allow(clippy::expect_used, reason = "a benchmark ends where it cannot go on")]

use std::env;
use std::process::ExitCode;
use std::time::Instant;

use mbs_live::{Live, Prepared, Text};
use mbs_runtime::{
    Adaptive, AdaptiveScheme, Dop853, Dopri5, Effort, Sampled, System, Tolerances, TrBdf2, implicit,
};
use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series, Stroke};
use tests::bushing::CRANK;

/// N/m and N s/m
const BUSHINGS: [(&str, f64, f64); 4] = [
    ("10⁹ N/m", 1e9, 0.0),
    ("10⁷ N/m, 10³ N·s/m", 1e7, 1e3),
    ("10⁹ N/m, 10⁵ N·s/m", 1e9, 1e5),
    ("2 · 10³ N/m, 5 N·s/m", 2e3, 5.0),
];
const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// ms
const LENGTHS: [f64; 4] = [1.0, 0.3, 0.1, 0.03];
const END: f64 = 0.3;
const REPETITIONS: usize = 5;

/// Where the runs begin: the slow motion.
struct Start {
    live: Live,
    t: f64,
    q: Vec<f64>,
    v: Vec<f64>,
}

/// Outcome of a run: the step or the tolerance that it was asked for, the steps that it tried, its error in
/// rad, and its least time in s.
struct Outcome {
    asked: String,
    steps: u64,
    error: f64,
    time: f64,
}

fn main() -> ExitCode {
    let is_bench = env::args().any(|argument| argument == "--bench");
    let bushings = if is_bench { &BUSHINGS[..] } else { &BUSHINGS[3..] };
    let mut panels = Vec::new();
    let mut is_good = true;
    for (name, stiffness, damping) in bushings {
        let start = Start::new(*stiffness, *damping);
        let curves = start.outcomes();
        let unit = curves.iter().find(|(method, _)| *method == "dopri5").map_or(1.0, |(_, all)| all[1].time);
        println!("\n{name}\n\n| method | | steps | error, rad | time |\n|---|---|---|---|---|");
        let mut series = Vec::new();
        for (method, outcomes) in curves {
            for Outcome { asked, steps, error, time } in &outcomes {
                println!("| {method} | {asked} | {steps} | {error:.1e} | {:.2} |", time / unit);
            }
            is_good &= outcomes.iter().any(|outcome| outcome.error < 1e-3);
            let points = outcomes.iter().map(|outcome| [outcome.error, outcome.time / unit]);
            series.push(Series::new(method, points).stroke(Stroke::Dotted));
        }
        let (error, time) =
            (Axis::new("error after a turn", "rad").log(), Axis::new("time over dopri5 at 1e-6", "").log());
        panels.push(Panel::lines(error, time, series));
    }
    if let Some(file) = env::args().skip_while(|argument| argument != "--figure").nth(1) {
        let figure = Figure::new("Crank with a bushing: of 1e9 N/m, and with 1e5 N s/m");
        let shown = panels.into_iter().enumerate().filter(|(at, _)| at % 2 == 0);
        let figure = shown.fold(figure, |figure, (_, panel)| figure.panel(panel));
        if let Err(error) = figure.save(file.as_ref()) {
            println!("{error}");
            return ExitCode::FAILURE;
        }
    }
    if is_good { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

impl Start {
    /// A hundred steps of TR-BDF2 damp the vibration that the declared start begins with.
    fn new(stiffness: f64, damping: f64) -> Self {
        let live = Text::declaration("crank.mbs", CRANK).compile().expect("a declaration");
        let names: Vec<_> = live.declared_info().parameters.iter().map(|parameter| parameter.name).collect();
        let live = live.with_parameters(|values| {
            for (value, name) in values.iter_mut().zip(names) {
                *value = match name {
                    "stiffness" => stiffness,
                    "damping" => damping,
                    _ => *value,
                };
            }
        });
        let live = live.expect("parameters");
        let mut settling = TrBdf2::builder(Prepared::new(&live), 1e-4).build().expect("a start");
        settling.advance_to(1e-2).expect("a regular motion");
        let n = live.declared_info().coordinates.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        settling.state(&mut q, &mut v);
        Self { t: settling.time(), live, q, v }
    }

    fn outcomes(&self) -> [(&'static str, Vec<Outcome>); 5] {
        let exact = self.fine();
        let outcome = |asked: String, run: &dyn Fn() -> (f64, u64)| {
            let mut time = f64::INFINITY;
            let (mut found, mut steps) = (f64::NAN, 0);
            for _ in 0..REPETITIONS {
                let clock = Instant::now();
                (found, steps) = run();
                time = time.min(clock.elapsed().as_secs_f64());
            }
            Outcome { asked, steps, error: (found - exact).abs(), time }
        };
        let to = |run: &dyn Fn(&Self, f64) -> (f64, u64)| {
            TOLERANCES.map(|rtol| outcome(format!("{rtol:e}"), &|| run(self, rtol))).into()
        };
        let in_steps = LENGTHS.map(|h| outcome(format!("{h} ms"), &|| self.trbdf2(1e-3 * h)));
        [
            ("esdirk4", to(&Self::adaptive::<implicit::Esdirk4>)),
            ("trbdf2", to(&Self::adaptive::<implicit::TrBdf2>)),
            ("trbdf2 in constant steps", in_steps.into()),
            ("dopri5", to(&Self::adaptive::<Dopri5>)),
            ("dop853", to(&Self::adaptive::<Dop853>)),
        ]
    }

    fn fine(&self) -> f64 {
        let builder =
            Adaptive::builder(Prepared::new(&self.live)).scheme::<Dop853>().tolerances(tolerances(1e-11));
        let mut run = builder.from_vectors(self.t, self.q.clone(), self.v.clone()).build().expect("a start");
        run.advance_to(self.t + END).expect("a regular motion");
        self.angle(&Sampled::new(run, 1.0).expect("an interval"))
    }

    fn adaptive<S: AdaptiveScheme>(&self, rtol: f64) -> (f64, u64) {
        let builder = Adaptive::builder(Prepared::new(&self.live)).scheme::<S>().tolerances(tolerances(rtol));
        let mut run = builder.from_vectors(self.t, self.q.clone(), self.v.clone()).build().expect("a start");
        run.advance_to(self.t + END).expect("a regular motion");
        let tried = tried(*run.effort());
        (self.angle(&Sampled::new(run, 1.0).expect("an interval")), tried)
    }

    fn trbdf2(&self, step: f64) -> (f64, u64) {
        let builder = TrBdf2::builder(Prepared::new(&self.live), step);
        let mut run = builder.from_vectors(self.t, self.q.clone(), self.v.clone()).build().expect("a start");
        run.advance_to(self.t + END).expect("a regular motion");
        (self.angle(&run), run.steps())
    }

    fn angle(&self, run: &dyn System) -> f64 {
        let (mut q, mut v) = (self.q.clone(), self.v.clone());
        run.state(&mut q, &mut v);
        q[0]
    }
}

fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-3 * rtol, ..Tolerances::default() }
}

fn tried(effort: Effort) -> u64 {
    effort.steps + effort.rejected
}
