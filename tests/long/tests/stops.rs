//! Stops over many impacts: a ball in a box, and random mechanisms between random stops.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_live::{Prepared, Text};
use mbs_runtime::equations::At;
use mbs_runtime::{Adaptive, Dop853, Error, Sampled, System, Tolerances, mechanism};
use paths::EXHAUSTIVE;
use tests::random::Random;

const TIGHT: Tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, max_step: f64::INFINITY, first_step: None };

mechanism! {
    /// A ball in a box, without loss.
    Box {
        dof = 2;
        param e = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (x, y) { mass = 1 [kg]; }
        stop floor: y >= 0 [m] { restitution = e; }
        stop ceiling: y <= 1.2 [m] { restitution = e; }
        stop left: x >= 0 [m] { restitution = e; }
        stop right: x <= 1 [m] { restitution = e; }
        start { x = 0.3 [m]; y = 1 [m]; der(x) = 1.3 [m/s]; der(y) = 2 [m/s]; }
    }
}

/// 10⁵ impacts, or 2,000 in the short run, neither gain nor lose energy but for rounding: each is located to
/// some roundings of its time, in which gravity works.
#[test]
fn a_ball_in_a_box_keeps_its_energy() -> Result<(), Error> {
    let most = if EXHAUSTIVE { 100_000 } else { 2_000 };
    let mut run = Adaptive::builder(Box::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    let energy = |run: &Adaptive<Box<f64>, Dop853>| {
        let state = run.state();
        run.mechanism().kinetic_energy(&state) + run.mechanism().potential_energy(&state)
    };
    let (begin, mut impacts, mut sum) = (energy(&run), 0, 0.0);
    while impacts < most {
        run.step()?;
        let inputs = run.inputs();
        let now = inputs.floor_impulse + inputs.ceiling_impulse + inputs.left_impulse + inputs.right_impulse;
        if now > sum {
            (impacts, sum) = (impacts + 1, now);
        }
    }
    // an impact is located to a rounding of its time, in which gravity works
    let rounding = f64::EPSILON * run.time();
    let speed = (2.0 * begin).sqrt();
    let bound = f64::from(most) * 9.81 * speed * rounding;
    assert!((energy(&run) - begin).abs() < bound, "{:e} of {bound:e}", energy(&run) - begin);
    Ok(())
}

/// A random mechanism: masses on springs, hung in joints of their own, between stops, some of which say the same or are
/// reached at once. All start at 0, before every stop or at it.
fn random(number: u64) -> (String, usize) {
    let mut random = Random::new(number);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let (bodies, stops) = (whole(1, 4), whole(1, 4));
    let names: Vec<String> = (1..=bodies).map(|body| format!("y{body}")).collect();
    let mut text = String::from("Random {\n    gravity = (0, -9.81) [m/s^2];\n");
    let is_tied = bodies > 2 && whole(0, 1) == 1;
    text += &format!("    dof = {};\n", bodies - i64::from(is_tied));
    for name in &names {
        let (mass, stiffness) = (whole(1, 5), whole(1, 4) * 20);
        text += &format!("    body b{name} (y = {name}) {{ mass = {mass} [kg]; }}\n");
        text += &format!("    potential s{name} = {stiffness} [N/m]*({name} - 1 [m])^2/2;\n");
    }
    if is_tied {
        // a joint that is not linear
        text += "    constraint tie: y1^2 + 2*y1*[m] = y2*[m];\n".replace("[m]", "(1 [m])").as_str();
    }
    for stop in 0..stops {
        let mut factors: Vec<i64> = names.iter().map(|_| whole(-2, 2)).collect();
        factors[whole(0, bodies - 1) as usize] = 1;
        let sum: Vec<String> =
            factors.iter().zip(&names).map(|(factor, name)| format!("{factor}*{name}")).collect();
        let (gap, e) = (whole(0, 2), whole(0, 4));
        text += &format!("    stop s{stop}: {} >= -{gap} [m] {{ restitution = {e}/4; }}\n", sum.join(" + "));
        text += &format!("    output g{stop} [m] = {} + {gap} [m];\n", sum.join(" + "));
    }
    (text + "}\n", stops as usize)
}

/// Energy does not grow, no gap becomes negative, and a run ends in its time.
#[test]
fn random_impacts_take_energy_and_keep_gaps() {
    let mut impacts = 0;
    let count = if EXHAUSTIVE { 2000 } else { 100 };
    for number in 0..count {
        let (text, stops) = random(number);
        let live = Text::declaration("random.mbs", &text)
            .compile()
            .unwrap_or_else(|error| panic!("{error}\n{text}"));
        let built = Adaptive::builder(Prepared::new(&live)).tolerances(TIGHT).most_steps(20_000).build();
        let run = built.unwrap_or_else(|error| panic!("{error}\n{text}"));
        let mut run = Sampled::new(run, 0.02).expect("an interval");
        let info = *run.described().info();
        let (n, m) = (info.coordinates.len(), info.constraints.len());
        let mut last = f64::INFINITY;
        for _ in 0..100 {
            run.step().unwrap_or_else(|error| panic!("{number}: {error}\n{text}"));
            let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
            run.state(&mut q, &mut v);
            let at = At { t: run.time(), q: &q, v: &v };
            let of = run.described();
            let (kinetic, energy) = (of.kinetic_energy(at), of.kinetic_energy(at) + of.potential_energy(at));
            let allowed = 1e-7 * (1.0 + kinetic + energy.abs());
            assert!(energy <= last + allowed, "{number}: {energy} after {last} J at {} s\n{text}", at.t);
            last = last.min(energy);
            let (mut a, mut multipliers, mut gaps) = (vec![0.0; n], vec![0.0; m], vec![0.0; stops]);
            run.reactions(&mut a, &mut multipliers)
                .unwrap_or_else(|error| panic!("{number}: {error}\n{text}"));
            run.outputs(&a, &multipliers, &mut gaps).expect("gaps");
            assert!(gaps.iter().all(|gap| *gap > -1e-7), "{number}: {gaps:?} at {} s\n{text}", at.t);
        }
        let mut inputs = vec![0.0; 2 * stops];
        run.inputs(&mut inputs);
        impacts += inputs.chunks(2).filter(|stop| stop[1] > 0.0).count() as u64;
    }
    assert!(impacts > count / 2, "{impacts} stops are hit");
}
