//! Random mechanisms have the accelerations and motions that a dense solver gives them: with numbers that
//! are not round, in any order of their statements, with states reduced and not, with constraints that repeat
//! others, from starts where springs have no direction.
//!
//! `MECHANISMS=20000 SEED=7 cargo test --release -p tests --test dense_solutions` tries more, or others.
#![allow(clippy::expect_used, reason = "a test")]

use std::collections::BTreeMap;

use mbs_live::{Live, Run, Text};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::{Sampled, System, Tolerances};
use paths::some_of;
use rayon::prelude::*;
use tests::dense::{Judgement, Mechanism, mechanism};
use tests::random::Random;

const MECHANISMS: u64 = 400;
/// Of the tolerance of runs, by which two runs of one motion may differ per unit of condition.
const RUN: f64 = 1e-9;
const END: f64 = 0.02;
/// Some ten thousand roundings: of operations, and of pivots that are chosen before numbers are known.
const ROUNDING: f64 = 1e4 * f64::EPSILON;

fn number(name: &str, default: u64) -> u64 {
    std::env::var(name).map_or(default, |text| text.parse().expect("a number"))
}

#[test]
fn random_mechanisms_move_as_a_dense_solver_says() {
    let (count, seed) = (number("MECHANISMS", some_of(MECHANISMS)), number("SEED", 0));
    let outcomes: Vec<_> =
        (seed..seed + count).into_par_iter().map(|number| (number, examine(number))).collect();
    let mut kinds = BTreeMap::new();
    let mut wrong = Vec::new();
    for (number, outcome) in outcomes {
        match outcome {
            Ok(kind) => *kinds.entry(kind).or_insert(0) += 1,
            Err(problem) => wrong.push(format!("SEED={number} MECHANISMS=1: {problem}")),
        }
    }
    assert!(wrong.is_empty(), "{} of {count} are wrong\n{}\n{kinds:?}", wrong.len(), wrong.join("\n"));
    // most have one right answer
    assert!(kinds.get("right").is_some_and(|right| 2 * right > count), "{kinds:?}");
}

/// A declared mechanism and where its coordinates are among those of the drawing.
struct Variant {
    live: Live,
    columns: Vec<usize>,
    /// Rows of the drawing that the motion is that of.
    independent: Vec<usize>,
}

fn examine(number: u64) -> Result<&'static str, String> {
    let drawn = mechanism(number);
    let judgement = drawn.judgement();
    let (Judgement::Regular { rank }, n) = (&judgement, drawn.coordinates().len()) else {
        return nothing_internal(&drawn, number, judgement);
    };
    let mut random = Random::new(!number);
    let mut orders = || [order(&mut random, drawn.bodies.len()), order(&mut random, drawn.joints.len())];
    let variants: Vec<Variant> = ["all", "reduced", "reduced"]
        .into_iter()
        .map(|states| variant(&drawn, states, &orders(), *rank))
        .collect::<Result<_, _>>()?;

    let q = drawn.assembled(&drawn.drawn()).expect("as it was judged");
    let any: Vec<f64> = (0..n).map(|_| random.between(-2.0, 2.0)).collect();
    let v = drawn.speeds(&q, &any);
    let motion = drawn.motion(&q, &v);
    for variant in &variants {
        let found = variant.accelerations(&q, &v);
        let condition = drawn.condition(&q, &variant.independent);
        let scale = motion.accelerations.iter().fold(motion.scale, |scale, x| scale.max(x.abs()));
        let share = condition * (ROUNDING + motion.open / scale);
        close(&drawn, "q̈", [&found, &motion.accelerations], motion.scale, share)?;
    }
    let ends = variants.iter().map(|variant| variant.end(&q, &v)).collect::<Result<Vec<_>, _>>();
    let ends = ends.map_err(|error| format!("{error}\n{drawn:?}"))?;
    let condition = drawn.condition(&q, &variants[0].independent);
    for end in &ends[1..] {
        close(&drawn, "q at the end", [end, &ends[0]], 1.0, 1e2 * RUN * condition)?;
    }
    Ok("right")
}

/// The numbers from 0 up to and without `count` in any order.
fn order(random: &mut Random, count: usize) -> Vec<usize> {
    let mut order: Vec<usize> = (0..count).collect();
    for end in (1..count).rev() {
        order.swap(end, random.below(end + 1));
    }
    order
}

/// Checks that a mechanism without one right answer is accepted, or refused without an internal error.
fn nothing_internal(drawn: &Mechanism, number: u64, judgement: Judgement) -> Result<&'static str, String> {
    let mut random = Random::new(!number);
    let orders = [order(&mut random, drawn.bodies.len()), order(&mut random, drawn.joints.len())];
    let rank = drawn.rank_as_drawn();
    for states in ["all", "reduced"] {
        let text = drawn.text(states, [&orders[0], &orders[1]], rank);
        if let Err(error) = Text::declaration("drawn.mbs", &*text).compile() {
            let told = error.to_string();
            if told.contains("internal") {
                return Err(format!("{told}\n{text}"));
            }
        }
    }
    let Judgement::Unclear(kind) = judgement else { unreachable!("regular ones have an answer") };
    Ok(kind)
}

fn variant(
    drawn: &Mechanism,
    states: &str,
    orders: &[Vec<usize>; 2],
    rank: usize,
) -> Result<Variant, String> {
    let text = drawn.text(states, [&orders[0], &orders[1]], rank);
    let live =
        Text::declaration("drawn.mbs", &*text).compile().map_err(|error| format!("{error}\n{text}"))?;
    let mut columns: Vec<usize> = (0..drawn.coordinates().len()).collect();
    let bodies: Vec<usize> = drawn.coordinates().iter().map(|(body, _)| *body).collect();
    // coordinates of its own are declared behind bodies
    let place = |at: usize| orders[0].iter().position(|&body| body == bodies[at]).unwrap_or(usize::MAX);
    columns.sort_by_key(|&at| (place(at), at));
    let rows: Vec<usize> = orders[1].iter().flat_map(|&joint| drawn.rows_of(joint)).collect();
    let redundant = live.declared_info().redundant;
    let independent = (0..rows.len()).filter(|row| !redundant.contains(row)).map(|row| rows[row]).collect();
    Ok(Variant { live, columns, independent })
}

impl Variant {
    /// In the order of the declaration.
    fn ordered(&self, values: &[f64]) -> Vec<f64> {
        self.columns.iter().map(|&at| values[at]).collect()
    }

    /// In the order of the drawing.
    fn drawn(&self, values: &[f64]) -> Vec<f64> {
        let mut drawn = vec![0.0; values.len()];
        for (&at, value) in self.columns.iter().zip(values) {
            drawn[at] = *value;
        }
        drawn
    }

    fn accelerations(&self, q: &[f64], v: &[f64]) -> Vec<f64> {
        let (q, v) = (self.ordered(q), self.ordered(v));
        let feedback = vec![0.0; self.live.declared_info().constraints.len()];
        let mut found = vec![f64::NAN; q.len()];
        self.live.accelerations(At { t: 0.0, q: &q, v: &v }, &[], &feedback, &mut found);
        self.drawn(&found)
    }

    fn end(&self, q: &[f64], v: &[f64]) -> Result<Vec<f64>, mbs_runtime::Error> {
        let (q, v) = (self.ordered(q), self.ordered(v));
        let tolerances = Tolerances { rtol: RUN, atol: RUN, ..Tolerances::default() };
        let run = Run::adaptive(&self.live)
            .tolerances(tolerances)
            .from_vectors(0.0, q.clone(), v.clone())
            .build()?;
        let mut run = Sampled::new(run, END)?;
        run.step()?;
        let (mut q, mut v) = (q, v);
        run.state(&mut q, &mut v);
        Ok(self.drawn(&q))
    }
}

/// Checks that two vectors differ by at most this share of their size, or of `scale` if that is larger.
fn close(
    drawn: &Mechanism,
    what: &str,
    [found, expected]: [&[f64]; 2],
    scale: f64,
    share: f64,
) -> Result<(), String> {
    let scale = expected.iter().fold(scale, |scale, x| scale.max(x.abs()));
    let off = found.iter().zip(expected).map(|(a, b)| (a - b).abs());
    let worst = off.fold(0.0, |worst: f64, x| if x.is_nan() { f64::INFINITY } else { worst.max(x) });
    if worst <= share * scale {
        return Ok(());
    }
    Err(format!("{what}: off by {worst:e}, {share:e} of {scale}\n{found:?}\n{expected:?}\n{drawn:?}"))
}
