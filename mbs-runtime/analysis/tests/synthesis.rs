//! Synthesis: four-bars through the nine points of a published problem, checked by their closed form; a straight
//! line, a function of two angles and prescribed timing; defects of circuit, order and branch; and what is refused.
//!
//! Starts are random with a seed, so that every run of the tests sees the same.

#![allow(clippy::unwrap_used, clippy::panic, reason = "helpers of tests")]

use mbs_analysis::{Defect, Linkage, Synthesis, Task, Trials, Unknown};
use mbs_live::{Live, Prepared, Text};
use mbs_runtime::equations::Partials;
use std::f64::consts::{PI, TAU};

/// In the angles of crank and coupler, with the rocker as a distance.
const FOUR_BAR: &str = "FourBar {
    dof = 1;
    param ax = 0 [m];    param ay = 0 [m];    param bx = 1 [m];    param by = 0 [m];
    param crank_length = 0.4 [m] where crank_length > 0;
    param coupler_length = 0.8 [m] where coupler_length > 0;
    param rocker_length = 0.8 [m] where rocker_length > 0;
    param along = 0.5 [m];    param across = 0.5 [m];
    let pin_x = ax + crank_length*cos(crank);
    let pin_y = ay + crank_length*sin(crank);
    let end_x = pin_x + coupler_length*cos(coupler);
    let end_y = pin_y + coupler_length*sin(coupler);
    body first (angle = crank) { inertia = 1 [kg*m^2]; }
    body second (angle = coupler) { inertia = 1 [kg*m^2]; }
    constraint rocker: (end_x - bx)^2 + (end_y - by)^2 = rocker_length^2;
    output tip_x [m] = pin_x + along*cos(coupler) - across*sin(coupler);
    output tip_y [m] = pin_y + along*sin(coupler) + across*cos(coupler);
    start { crank = 90 [deg]; guess coupler = 0; }
}";

/// Of bodies and joints, in nine coordinates.
const BARS: &str = include_str!("bars.mbs");

/// C. W. Wampler, A. P. Morgan, A. J. Sommese, Complete solution of the nine-point path synthesis problem for
/// four-bar linkages, ASME J. Mech. Des. 114 (1992) 153-159, Problem 3.
const NINE: [[f64; 2]; 9] = [
    [0.25, 0.00],
    [0.52, 0.10],
    [0.80, 0.70],
    [1.20, 1.00],
    [1.40, 1.30],
    [1.10, 1.48],
    [0.70, 1.40],
    [0.20, 1.00],
    [0.02, 0.40],
];

const NAMES: [&str; 9] =
    ["ax", "ay", "bx", "by", "crank_length", "coupler_length", "rocker_length", "along", "across"];

fn unknown(name: &str, low: f64, high: f64) -> Unknown {
    Unknown { name: name.into(), guess: None, bounds: [low, high] }
}

/// Pivots and coupler point anywhere near, links of any length.
fn anything() -> Vec<Unknown> {
    let bounds = |name: &&str| {
        if name.ends_with("length") { unknown(name, 0.05, 4.0) } else { unknown(name, -3.0, 4.0) }
    };
    NAMES.iter().map(bounds).collect()
}

/// One mechanism, and what is within a millionth of it.
fn just(values: &[f64]) -> Vec<Unknown> {
    NAMES.iter().zip(values).map(|(name, x)| unknown(name, x - 1e-6, x + 1e-6)).collect()
}

fn compiled(text: &str) -> Live {
    Text::declaration("four_bar.mbs", text).compile().unwrap()
}

fn trials_of(live: &Live) -> impl Trials + Sync + use<> {
    let over = live.over::<Partials>();
    move |parameters: &[Partials]| {
        Ok(Prepared::new(&over.with_parameters(|own| own.copy_from_slice(parameters))?))
    }
}

fn through(live: &Live, points: &[[f64; 2]]) -> Task {
    Task {
        columns: vec!["tip_x".into(), "tip_y".into()],
        positions: points.iter().map(|point| point.map(Some).to_vec()).collect(),
        ..Task::of(live.declared_info())
    }
}

/// Angles of coupler and rocker for an angle of the crank, with the elbow on one side, and the coupler point.
fn closed_form(values: &[f64], crank: f64, side: f64) -> Option<([f64; 2], [f64; 2])> {
    let &[ax, ay, bx, by, a, b, c, along, across] = values else { panic!("nine") };
    let pin = [ax + a * crank.cos(), ay + a * crank.sin()];
    let (dx, dy) = (bx - pin[0], by - pin[1]);
    let d = dx.hypot(dy);
    let cosine = (b * b + d * d - c * c) / (2.0 * b * d);
    let coupler = dy.atan2(dx) + side * (cosine.abs() <= 1.0).then(|| cosine.acos())?;
    let (sin, cos) = coupler.sin_cos();
    let end = [pin[0] + b * cos, pin[1] + b * sin];
    let tip = [pin[0] + along * cos - across * sin, pin[1] + along * sin + across * cos];
    Some(([coupler, (end[1] - by).atan2(end[0] - bx)], tip))
}

/// Turned by its crank alone, in one direction and with one elbow, a four-bar comes to the points in their order.
fn passes(values: &[f64], points: &[[f64; 2]]) -> bool {
    let turns = |side: f64, direction: f64| {
        const STEPS: usize = 40_000;
        let at = |step: usize| {
            let crank = direction * TAU * step as f64 / STEPS as f64;
            closed_form(values, crank, side).map(|(_, tip)| tip)
        };
        let near = |step: usize, point: &[f64; 2]| {
            at(step).is_some_and(|tip| (tip[0] - point[0]).hypot(tip[1] - point[1]) < 1e-3)
        };
        let Some(first) = (0..STEPS).find(|step| near(*step, &points[0])) else { return false };
        let mut rest = points[1..].iter().peekable();
        for step in first..first + STEPS {
            if at(step).is_none() {
                return false;
            }
            while rest.peek().is_some_and(|point| near(step, point)) {
                rest.next();
            }
            if rest.peek().is_none() {
                return true;
            }
        }
        false
    };
    [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].iter().any(|(side, way)| turns(*side, *way))
}

/// From no hint, of some hundred starts; each by its closed form, and some refused.
#[test]
fn four_bars_through_nine_points() {
    let live = compiled(FOUR_BAR);
    for seed in 0..2 {
        let task = Task {
            unknown: anything(),
            drive: Some("crank".into()),
            tolerance: 1e-10,
            seed,
            ..through(&live, &NINE)
        };
        let found = task.synthesize(&trials_of(&live)).unwrap();
        println!("seed {seed}: {} of {} starts", found.linkages.len(), found.starts);
        // of which two cores make some hundred in a second
        assert!(found.starts <= 1000, "{}", found.starts);
        let best = &found.linkages[0];
        assert!(best.missed < 1e-10 && best.coordinates.len() == 9, "{best:?}");
        for (q, point) in best.coordinates.iter().zip(NINE) {
            let tips = [1.0, -1.0].map(|side| closed_form(&best.values, q[0], side).unwrap().1);
            let miss = tips.map(|tip| (tip[0] - point[0]).hypot(tip[1] - point[1]));
            assert!(miss[0].min(miss[1]) < 1e-10, "{miss:?}");
        }
        assert!(passes(&best.values, &NINE), "{best:?}");
    }
    // many, of which most have a defect
    let task = Task {
        unknown: anything(),
        drive: Some("crank".into()),
        starts: 2560,
        enough: usize::MAX,
        ..through(&live, &NINE)
    };
    let Synthesis { linkages, refused, .. } = task.synthesize(&trials_of(&live)).unwrap();
    println!("2560 starts: {} mechanisms, refused: {refused:?}", linkages.len());
    assert!(linkages.len() >= 2 && refused.iter().all(|(_, count)| *count > 0));
    assert!(linkages.iter().all(|linkage| passes(&linkage.values, &NINE)));
}

/// Bodies and joints do as well as equations of one's own.
#[test]
fn the_same_of_bodies_and_joints() {
    let live = compiled(BARS);
    let task = Task { unknown: anything(), drive: Some("theta1".into()), ..through(&live, &NINE) };
    let found = task.synthesize(&trials_of(&live)).unwrap();
    println!("of joints: {} of {} starts", found.linkages.len(), found.starts);
    assert!(passes(&found.linkages[0].values, &NINE));
}

/// A crank-rocker and places on its way.
const ROCKER: [f64; 9] = [0.0, 0.0, 1.0, 0.0, 0.3, 0.9, 0.7, 0.4, 0.5];

fn tips(values: &[f64], cranks: &[f64], side: f64) -> Vec<[f64; 2]> {
    cranks.iter().map(|crank| closed_form(values, *crank, side).unwrap().1).collect()
}

/// Judges one mechanism that can be assembled at all points.
fn judged(values: &[f64], points: &[[f64; 2]], drive: &str) -> Synthesis {
    let live = compiled(FOUR_BAR);
    let task =
        Task { unknown: just(values), drive: Some(drive.into()), starts: 128, ..through(&live, points) };
    task.synthesize(&trials_of(&live)).unwrap()
}

fn refusals(found: &Synthesis) -> [usize; 3] {
    found.refused.map(|(_, count)| count)
}

#[test]
fn defects_of_circuit_order_and_branch() {
    let cranks = [0.3, 1.2, 2.0, 3.1, 4.4];
    let sound = tips(&ROCKER, &cranks, 1.0);
    assert!(!judged(&ROCKER, &sound, "crank").linkages.is_empty());
    // backwards is an order too
    let reversed: Vec<_> = sound.iter().rev().copied().collect();
    assert!(!judged(&ROCKER, &reversed, "crank").linkages.is_empty());

    let mut mixed = sound.clone();
    mixed[2] = tips(&ROCKER, &[2.0], -1.0)[0];
    let found = judged(&ROCKER, &mixed, "crank");
    assert!(found.linkages.is_empty() && refusals(&found)[0] > 0, "{found:?}");
    assert_eq!(refusals(&found)[1..], [0, 0]);

    let mut swapped = sound.clone();
    swapped.swap(1, 3);
    let found = judged(&ROCKER, &swapped, "crank");
    assert!(found.linkages.is_empty() && refusals(&found)[1] > 0, "{found:?}");
    assert_eq!(refusals(&found)[0], 0);

    // three rockers: the crank of a = 1, b = 0.5, c = 1, d = 1.3 stops where coupler and rocker are in line
    let rockers = [0.0, 0.0, 1.3, 0.0, 1.0, 0.5, 1.0, 0.2, 0.3];
    let around: Vec<[f64; 2]> = [(0.9, 1.0), (1.0, 1.0), (1.0, -1.0), (0.9, -1.0)]
        .iter()
        .map(|(crank, side)| closed_form(&rockers, *crank, *side).unwrap().1)
        .collect();
    assert!(closed_form(&rockers, 1.5, 1.0).is_none());
    let found = judged(&rockers, &around, "crank");
    assert!(found.linkages.is_empty() && refusals(&found)[2] > 0, "{found:?}");
    assert_eq!(refusals(&found)[..2], [0, 0]);
    // where the coupler drives, that is no dead centre
    assert!(!judged(&rockers, &around, "coupler").linkages.is_empty());
}

/// Eleven points of a line of 1 m, to be passed within 2 mm: more than a four-bar can meet.
#[test]
fn an_approximate_straight_line() {
    let live = compiled(FOUR_BAR);
    let line: Vec<[f64; 2]> = (0..=10).map(|at| [0.1 * f64::from(at), 0.0]).collect();
    let task =
        Task { unknown: anything(), drive: Some("crank".into()), tolerance: 2e-3, ..through(&live, &line) };
    let found = task.synthesize(&trials_of(&live)).unwrap();
    println!("line: {:.1e} m of {} starts", found.linkages[0].missed, found.starts);
    let best = &found.linkages[0];
    assert!(best.missed <= 2e-3 && best.missed > 1e-9);
    // on its constraints, and as near as it says
    for (q, point) in best.coordinates.iter().zip(&line) {
        let tips = [1.0, -1.0].map(|side| closed_form(&best.values, q[0], side).unwrap().1);
        let miss = tips.map(|tip| (tip[0] - point[0]).abs().max((tip[1] - point[1]).abs()));
        assert!(miss[0].min(miss[1]) <= best.missed + 1e-9);
    }
}

/// A function generator: y = log₁₀ x for 1 ≤ x ≤ 2, with 60° of the crank and 90° of the rocker, in the five
/// precision points that a four-bar of base 1 can meet (three lengths and where both angles begin).
#[test]
fn a_function_generator() {
    let text = "Generator {
        dof = 1;
        param a = 1 [m] where a > 0;    param b = 1 [m] where b > 0;    param c = 1 [m] where c > 0;
        param first = 0;    param second = 0;
        body crank (angle = input_angle) { inertia = 1 [kg*m^2]; }
        body rocker (angle = output_angle) { inertia = 1 [kg*m^2]; }
        let u = first + input_angle;    let w = second + output_angle;
        constraint coupler: (1 [m] + c*cos(w) - a*cos(u))^2 + (c*sin(w) - a*sin(u))^2 = b^2;
        start { input_angle = 60 [deg]; guess output_angle = 60 [deg]; }
    }";
    let live = compiled(text);
    let point = |k: i32| {
        // Chebyshev's spacing
        let x = 1.5 - 0.5 * (PI * (2.0 * f64::from(k) + 1.0) / 10.0).cos();
        [PI / 3.0 * (x - 1.0), PI / 2.0 * x.log10() / 2.0_f64.log10()]
    };
    let points: Vec<[f64; 2]> = (0..5).map(point).collect();
    let angles = ["first", "second"].map(|name| unknown(name, -PI, PI));
    let lengths = ["a", "b", "c"].map(|name| unknown(name, 0.1, 10.0));
    let task = Task {
        unknown: [&lengths[..], &angles].concat(),
        columns: vec!["input_angle".into(), "output_angle".into()],
        drive: Some("input_angle".into()),
        ..through(&live, &points)
    };
    let found = task.synthesize(&trials_of(&live)).unwrap();
    let best = &found.linkages[0];
    let &[a, b, c, first, second] = &best.values[..] else { panic!("five") };
    // by SciPy's least_squares of Freudenstein's equation, from 3000 starts the only one with such lengths
    for (found, expected) in [a, b, c].into_iter().zip([3.0572, 6.3663, 8.5292]) {
        assert!((found - expected).abs() < 1e-4, "{:?}", best.values);
    }
    for [input, output] in points {
        // Freudenstein's equation
        let (u, w) = (first + input, second + output);
        let left = 1.0 + a * a + c * c - b * b + 2.0 * c * w.cos() - 2.0 * a * u.cos();
        assert!((left - 2.0 * a * c * (u - w).cos()).abs() < 1e-8, "{left}");
    }
    // between the points the error is small too
    let largest = best.path.iter().map(|q| {
        let near = |angle: f64| (angle + PI).rem_euclid(TAU) - PI;
        let x = 1.0 + near(q[0]) * 3.0 / PI;
        near(q[1] - PI / 2.0 * x.log10() / 2.0_f64.log10()).abs()
    });
    assert!(largest.fold(0.0, f64::max) < 0.02);
}

/// With a column of the drive the timing is prescribed; an empty cell is free.
#[test]
fn prescribed_timing_and_free_values() {
    let live = compiled(FOUR_BAR);
    let cranks = [0.3, 1.0, 1.7, 2.4, 3.1];
    let rows = cranks.iter().zip(tips(&ROCKER, &cranks, 1.0)).enumerate();
    let positions = rows.map(|(row, (crank, [x, y]))| vec![Some(*crank), Some(x), (row != 2).then_some(y)]);
    let task = Task {
        unknown: anything(),
        columns: ["crank", "tip_x", "tip_y"].map(String::from).to_vec(),
        positions: positions.collect(),
        drive: Some("crank".into()),
        ..Task::of(live.declared_info())
    };
    let found = task.synthesize(&trials_of(&live)).unwrap();
    let Linkage { values, coordinates, .. } = &found.linkages[0];
    for (q, crank) in coordinates.iter().zip(cranks) {
        assert!(((q[0] - crank) / TAU - ((q[0] - crank) / TAU).round()).abs() < 1e-9);
    }
    assert!(found.linkages[0].missed < 1e-9 && values.len() == 9);
}

/// Where a rocker turns back, crank and coupler are in line: a swing from 50° to 110° asks for that at both ends.
#[test]
fn an_extreme_is_a_position_with_a_condition() {
    let text = FOUR_BAR.replace(
        "output tip_x",
        "output rocker_angle = atan2(end_y - by, end_x - bx);
         output in_line = sin(coupler - crank);
         output tip_x",
    );
    let live = compiled(&text);
    let task = Task {
        unknown: vec![
            unknown("crank_length", 0.05, 0.9),
            unknown("coupler_length", 0.1, 2.0),
            unknown("rocker_length", 0.4, 1.0),
        ],
        columns: vec!["rocker_angle".into(), "in_line".into()],
        positions: [50.0_f64, 110.0].map(|angle| vec![Some(angle.to_radians()), Some(0.0)]).to_vec(),
        drive: Some("crank".into()),
        ..Task::of(live.declared_info())
    };
    let found = task.synthesize(&trials_of(&live)).unwrap();
    let &[a, b, c] = &found.linkages[0].values[..] else { panic!("three") };
    let extremes = [50.0_f64, 110.0].map(|angle| (1.0 + c * c + 2.0 * c * angle.to_radians().cos()).sqrt());
    assert!((extremes[0] - (a + b)).abs() < 1e-8 && (extremes[1] - (a - b).abs()).abs() < 1e-8);
}

#[test]
fn what_cannot_be_synthesized_is_refused() {
    let live = compiled(FOUR_BAR);
    let task = || Task { unknown: anything(), ..through(&live, &NINE) };
    let refused = |task: Task| task.synthesize(&trials_of(&live)).unwrap_err().to_string();
    let drive = refused(Task { drive: Some("wheel".into()), ..task() });
    assert!(drive.contains("`wheel`") && drive.contains("`crank`"), "{drive}");
    let column = Task { columns: vec!["tip_x".into(), "nose".into()], ..task() };
    assert!(refused(column).contains("`nose`"));
    let rate = Task { columns: vec!["tip_x".into(), "der(crank)".into()], ..task() };
    assert!(refused(rate).contains("coordinate or output `der(crank)`"));
    let unbounded = Task { unknown: vec![unknown("ax", 0.0, f64::INFINITY)], ..task() };
    assert!(refused(unbounded).contains("`ax` has no bounds"));
    let reversed = Task { unknown: vec![unknown("ax", 1.0, 0.0)], ..task() };
    assert!(refused(reversed).contains("bounds 1 to 0"));
    let twice = Task { unknown: vec![unknown("ax", 0.0, 1.0), unknown("ax", 0.0, 1.0)], ..task() };
    assert!(refused(twice).contains("twice"));
    assert!(refused(Task { unknown: vec![unknown("z", 0.0, 1.0)], ..task() }).contains("`z`"));
    assert!(refused(Task { positions: vec![], ..task() }).contains("0 positions"));
    let broken = Task { positions: vec![vec![Some(f64::NAN), None]; 2], ..task() };
    assert!(refused(broken).contains("finite values"));
    assert!(refused(Task { positions: vec![vec![None]; 3], ..task() }).contains("values of a position"));
    assert!(refused(Task { tolerance: 0.0, ..task() }).contains("tolerance"));
    let driven = compiled(
        "Driven { dof = 0; param l = 1 [m]; body bar (angle = phi) { inertia = 1 [kg*m^2]; }
         drive motor: phi = 1 [rad/s]*t; output x [m] = l*cos(phi); }",
    );
    let task = Task {
        unknown: vec![unknown("l", 0.1, 2.0)],
        columns: vec!["x".into()],
        positions: vec![vec![Some(0.0)]; 2],
        ..Task::of(driven.declared_info())
    };
    let message = task.synthesize(&trials_of(&driven)).unwrap_err().to_string();
    assert!(message.contains("0 degrees of freedom") && message.contains("take the drive away"), "{message}");
    // nothing that meets the points is no error
    let far = Task { unknown: vec![unknown("ax", 50.0, 51.0)], starts: 128, ..through(&live, &NINE) };
    let found = far.synthesize(&trials_of(&live)).unwrap();
    assert!(found.linkages.is_empty() && found.nearest > 1.0 && found.starts == 128, "{found:?}");
    assert_eq!(found.refused[0].0, Defect::Circuit);
}
