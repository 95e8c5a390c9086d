//! A mechanism with particles on a body that bends.

use std::f64::consts::PI;

use mbs_runtime::{Dual, Error, NoComponents, Real, Simulation};
use models::{ElasticCrank, ElasticCrankParameters};
use paths::{EXHAUSTIVE, through_fused_path};

use super::{found, near, to_tolerance};

/// x, x′ and x″ along a line.
type Jet = Dual<Dual<f64, 1>, 1>;

/// x(s) = value + s·slope
const fn line(value: f64, slope: f64) -> Jet {
    Dual::new(Dual::new(value, [slope]), [Dual::new(slope, [0.0])])
}

/// Nodes and weights of Gauss's rule on 0 … 1.
const GAUSS: [[f64; 2]; 5] = [
    [0.046_910_077_030_668, 0.118_463_442_528_094_54],
    [0.230_765_344_947_158_46, 0.239_314_335_249_683_24],
    [0.5, 0.284_444_444_444_444_44],
    [0.769_234_655_052_841_5, 0.239_314_335_249_683_24],
    [0.953_089_922_969_332, 0.118_463_442_528_094_54],
];

/// The rod's mass and the stiffness of its first shape.
fn rod(p: &ElasticCrankParameters<f64>) -> [f64; 2] {
    let mass = p.density * p.side.powi(2) * p.rod_length;
    let moment = p.side.powi(4) / 12.0;
    [mass, PI.powi(4) * p.modulus * moment / (2.0 * p.rod_length.powi(3))]
}

/// Each mass with its place at an angle of the crank and a deflection, the slider last.
fn masses(p: &ElasticCrankParameters<f64>, [angle, w]: [Jet; 2]) -> Vec<(f64, [Jet; 2])> {
    let number = Jet::from_f64;
    let (a, l) = (number(p.crank_length), number(p.rod_length));
    let pin = [a * angle.cos(), a * angle.sin()];
    // (π w)²/4l, by which the rod is shorter
    let short = number(PI * PI / 4.0) * w * w / l;
    let sin = -pin[1] / (l - short);
    let cos = (number(1.0) - sin * sin).sqrt();
    let place = |x: Jet, y: Jet| [pin[0] + cos * x - sin * y, pin[1] + sin * x + cos * y];
    let piece = |[at, share]: [f64; 2]| {
        let come = at + (2.0 * PI * at).sin() / (2.0 * PI);
        let place = place(number(at) * l - number(come) * short, number((PI * at).sin()) * w);
        (share * rod(p)[0], place)
    };
    let slider = (p.slider_mass, place(l - short, number(0.0)));
    GAUSS.into_iter().map(piece).chain([slider]).collect()
}

/// ẅ and the torque of the drive.
fn reference(p: &ElasticCrankParameters<f64>, t: f64, [w, rate]: [f64; 2]) -> [f64; 2] {
    let first = |x: Jet| x.partials[0].value;
    let second = |x: Jet| x.partials[0].partials[0];
    let angle = p.speed * t;
    let [rod_mass, stiffness] = rod(p);
    let moving = masses(p, [line(angle, p.speed), line(w, rate)]);
    let along_w = masses(p, [line(angle, 0.0), line(w, 1.0)]);
    let along_angle = masses(p, [line(angle, 1.0), line(w, 0.0)]);
    let sum = |of: &dyn Fn(usize, usize) -> f64| -> f64 {
        moving.iter().enumerate().map(|(at, (mass, _))| mass * (of(at, 0) + of(at, 1))).sum()
    };
    let damping = 2.0 * p.damping_ratio * (stiffness * rod_mass / 2.0).sqrt();
    let pull = sum(&|at, x| first(along_w[at].1[x]) * second(moving[at].1[x]));
    let inertia = sum(&|at, x| first(along_w[at].1[x]).powi(2));
    let acceleration = -(pull + stiffness * w + damping * rate) / inertia;
    let torque = sum(&|at, x| {
        first(along_angle[at].1[x]) * (second(moving[at].1[x]) + first(along_w[at].1[x]) * acceleration)
    });
    [acceleration, torque]
}

/// w and its rate every millisecond, by Runge and Kutta's method: with steps of 2 µs and a frequency of 1277/s its error is
/// 1e-10 of the deflection after 0.1 s.
fn deflections(p: &ElasticCrankParameters<f64>, milliseconds: u32) -> Vec<[f64; 2]> {
    const STEP: f64 = 2e-6;
    let mut y = [p.plucked, 0.0];
    let mut found = vec![y];
    for step in 0..500 * milliseconds {
        let t = STEP * f64::from(step);
        let slope = |by: f64, k: [f64; 2]| {
            let y = [y[0] + by * STEP * k[0], y[1] + by * STEP * k[1]];
            [y[1], reference(p, t + by * STEP, y)[0]]
        };
        let a = slope(0.0, [0.0; 2]);
        let b = slope(0.5, a);
        let c = slope(0.5, b);
        let d = slope(1.0, c);
        y = [0, 1].map(|at| y[at] + STEP / 6.0 * (a[at] + 2.0 * b[at] + 2.0 * c[at] + d[at]));
        if (step + 1) % 500 == 0 {
            found.push(y);
        }
    }
    found
}

/// Along a run: accelerations of up to 400 m/s² and torques of up to 100 N·m.
#[test]
fn elastic_crank_obeys_lagrange() -> Result<(), Error> {
    let mechanism = ElasticCrank::declared();
    let p = *mechanism.parameters();
    let mut run = to_tolerance(mechanism, 1e-10).build()?;
    for at in 1..=100 {
        run.advance_to(1e-3 * f64::from(at))?;
        let state = run.state();
        let (a, outputs) = found(&mechanism, &state, &NoComponents::default());
        let [acceleration, torque] = reference(&p, state.t, [state.q.w, state.v.w]);
        near("ẅ", a.w, acceleration, 1e-7);
        near("torque", outputs.torque, torque, 1e-8);
    }
    Ok(())
}

/// To 1e-9 of the largest deflection, 2 mm.
#[test]
fn elastic_crank_bends() -> Result<(), Error> {
    let p = ElasticCrankParameters::default();
    let mut run = to_tolerance(ElasticCrank::declared(), 1e-12).build()?;
    let samples = if EXHAUSTIVE { 100 } else { 20 };
    for (at, [w, rate]) in deflections(&p, samples).into_iter().enumerate() {
        run.advance_to(1e-3 * at as f64)?;
        let now = run.state();
        near("w", now.q.w, w, 2e-12);
        near("its rate", now.v.w, rate, 3e-9);
    }
    Ok(())
}

/// Heun's error in phase is (ωh)²/6 of ωt, 1.1e-4 of 64 rad at 50 ms with steps of 20 µs.
#[test]
fn elastic_crank_on_every_path() -> Result<(), Error> {
    let p = ElasticCrankParameters::default();
    let instants: &[u32] = if EXHAUSTIVE { &[10, 30, 50] } else { &[10] };
    let deflections = deflections(&p, *instants.last().unwrap());
    let start = |step| Simulation::new(ElasticCrank::declared(), step);
    through_fused_path("elastic-crank", 2e-5, start, |case, run| {
        for &at in instants {
            run.advance_to(1e-3 * f64::from(at))?;
            case.near("w", run.now()?.q.w, deflections[at as usize][0], 1e-5);
        }
        Ok(())
    })
}

/// The first frequency is that of the test set, which is printed with π = 3.1415927 in the place of π, to what Gauss's rule
/// makes of ∫ sin².
#[test]
fn elastic_crank_has_the_published_frequency() {
    let [mass, stiffness] = rod(&ElasticCrankParameters::default());
    let by_gauss: f64 = GAUSS.iter().map(|[at, share]| share * (PI * at).sin().powi(2)).sum();
    // 3.1415927
    let rounded = PI + 4.641e-8;
    near("ω₁", (stiffness / (mass * 0.5)).sqrt() * (rounded / PI).powi(2), 1_276.686_436, 1e-6);
    near("∫ sin²", by_gauss, 0.5, 2e-5);
}
