//! Compliant contact: closed forms of its laws, and what every pair of outlines conserves.

use mbs_live::{Prepared, Text};
use mbs_runtime::equations::Equations;
use mbs_runtime::{Adaptive, Dop853, Error, Sampled, System, Tolerances, mechanism};
use paths::STRIDE;

const TIGHT: Tolerances = Tolerances { rtol: 1e-12, atol: 1e-13, max_step: f64::INFINITY, first_step: None };

mechanism! {
    /// A ball that hits a floor at 1 m/s, by the three laws of restitution and without loss, on two kinds of springs.
    Balls {
        dof = 6;
        param m = 2 [kg];
        param e = 0.6;
        for i in 0..6 {
            body ball[i] (y = y[i]) { mass = m; }
            circle rim[i] on ball[i] = (0, 0) radius 5 [cm];
            start { y[i] = 51 [mm]; der(y[i]) = -1 [m/s]; }
        }
        line floor on ground = (0, 0) along (1, 0);
        contact hunt (ball[0].rim[0], ground.floor) { stiffness = 1 [MN/m]; restitution = e; speed = 1 [m/s]; }
        contact lankarani (ball[1].rim[1], ground.floor) {
            law = lankarani_nikravesh; modulus = 1 [GPa]; restitution = e; speed = 1 [m/s];
        }
        contact flores (ball[2].rim[2], ground.floor) { law = flores; modulus = 1 [GPa]; restitution = e; speed = 1 [m/s]; }
        contact hertz (ball[3].rim[3], ground.floor) { modulus = 1 [GPa]; }
        contact linear (ground.floor, ball[4].rim[4]) { stiffness = 1 [MN/m]; }
        contact damped (ball[5].rim[5], ground.floor) { stiffness = 1 [MN/m]; damping = 800 [N*s/m]; }
        event top: der(y[3]) = 0 rising;
        event lowest: der(y[4]) = 0 rising;
    }
}

/// With N = K δⁿ (1 + d δ̇) the speeds v before and u behind obey F(v) = F(−u), F(w) = w/d − ln(1 + d w)/d², for every
/// K and n, since m δ̇ dδ̇/(1 + d δ̇) = −K δⁿ dδ.
fn parted(d: f64, v: f64, u: f64) -> f64 {
    let f = |w: f64| w / d - (d * w).ln_1p() / (d * d);
    f(v) - f(-u)
}

#[test]
fn balls_bounce_as_their_laws_say() -> Result<(), Error> {
    let mut run = Adaptive::builder(Balls::declared()).scheme::<Dop853>().tolerances(TIGHT).build()?;
    // Hertz: δ = (5 m v²/(4 K))^(2/5), reached after √π Γ(7/5)/Γ(9/10) δ/v; K = 4/3 E √R
    let (m, k) = (2.0_f64, 4.0 / 3.0 * 1e9 * 0.05_f64.sqrt());
    let (touch, depth) = (1e-3, (1.25 * m / k).powf(0.4));
    // of a spring: v √(m/k), after a quarter of its period
    let (quarter, deep) = ((m / 1e6_f64).sqrt() * std::f64::consts::FRAC_PI_2, (m / 1e6_f64).sqrt());
    let mut seen = 0;
    while let Some(event) = run.advance_to_event(0.02)? {
        let q = run.state().q;
        let (found, expected) = match event.index {
            0 => ([event.t - touch, 0.05 - q.y_3], [1.471_637_592_162 * depth, depth]),
            _ => ([event.t - touch, 0.05 - q.y_4], [quarter, deep]),
        };
        for (found, expected) in found.into_iter().zip(expected) {
            assert!((found / expected - 1.0).abs() < 1e-7, "{}: {found} {expected}", event.index);
        }
        seen += 1;
    }
    assert_eq!(seen, 2);
    let v = run.state().v;
    for (u, factor) in [(v.y_0, 1.5 * 0.4), (v.y_1, 0.75 * (1.0 - 0.36)), (v.y_2, 8.0 * 0.4 / 3.0)] {
        assert!(parted(factor, 1.0, u).abs() < 1e-9, "{u} {factor}");
    }
    assert!((v.y_3 - 1.0).abs() < 1e-9 && (v.y_4 - 1.0).abs() < 1e-9, "{} {}", v.y_3, v.y_4);
    // a damper pulls at no time, which ends its contact early (Schwager and Pöschel 2007)
    let decay: f64 = 800.0 / 4.0;
    let omega = (1e6_f64 / 2.0 - decay * decay).sqrt();
    let angle = (2.0 * decay * omega).atan2(omega * omega - decay * decay);
    let expected = (-decay / omega * (std::f64::consts::PI - angle)).exp();
    assert!((v.y_5 - expected).abs() < 1e-9, "{} {expected}", v.y_5);
    Ok(())
}

/// Positions and velocities of a text at a time.
fn at(text: &str, t: f64, tolerances: Tolerances) -> Result<[Vec<f64>; 2], Error> {
    let live = Text::declaration("contact.mbs", text).compile().expect("a mechanism");
    let built = Adaptive::builder(Prepared::new(&live)).scheme::<Dop853>().tolerances(tolerances).build()?;
    let mut run = Sampled::new(built, t)?;
    run.advance(1)?;
    let count = live.info().coordinates.len();
    let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
    run.state(&mut q, &mut v);
    Ok([q, v])
}

/// A ball that slides at first rolls in the end, with v₀/(1 + J/m ρ²), whatever friction was: ρ is from its centre to the
/// middle of the penetration, about which friction has no moment.
#[test]
fn a_ball_begins_to_roll() -> Result<(), Error> {
    let text = "Bowling {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        param r = 0.1 [m];
        body ball (x, y, phi) { mass = 7 [kg]; inertia = 2*7 [kg]*r^2/5; }
        circle rim on ball = (0, 0) radius r;
        segment lane on ground = (-1 [m], 0) to (20 [m], 0);
        contact c (ball.rim, ground.lane) {
            stiffness = 1 [MN/m]; damping = 2 [kN*s/m]; coefficient = 0.2; transition = 1 [mm/s];
        }
        start { y = r - 7*9.81*1e-6*1 [m]; der(x) = 5 [m/s]; }
    }";
    let tolerances = Tolerances { rtol: 1e-8, atol: 1e-10, max_step: f64::INFINITY, first_step: None };
    let [_, v] = at(text, 3.0, tolerances)?;
    let reach = 0.1 - 7.0 * 9.81e-6 / 2.0;
    let rolling = 5.0 / (1.0 + 0.4 * (0.1 / reach) * (0.1 / reach));
    assert!((v[0] - rolling).abs() < 1e-6 && (v[0] + reach * v[2]).abs() < 1e-6, "{v:?}");
    Ok(())
}

/// Two free bodies that hit each other off their centres, while they turn.
fn pair([of_a, of_b]: [&str; 2], ends: &str, properties: &str) -> String {
    format!(
        "Pair {{
            dof = 6;
            body a (x, y, phi) {{ mass = 1 [kg]; inertia = 0.004 [kg*m^2]; }}
            {of_a}
            body b (x2, y2, phi2) {{ mass = 2 [kg]; inertia = 0.04 [kg*m^2]; }}
            {of_b}
            contact c ({ends}) {{ modulus = 0.1 [GPa]; {properties} }}
            start {{
                y = 0.5 [m]; der(x) = 0.3 [m/s]; der(y) = -2 [m/s]; der(phi) = 20 [rad/s]; der(phi2) = 1 [rad/s];
            }}
        }}"
    )
}

/// Momentum, and angular momentum about the origin.
fn momenta([q, v]: &[Vec<f64>; 2]) -> [f64; 3] {
    let spin = |m: f64, j: f64, at: usize| m * (q[at] * v[at + 1] - q[at + 1] * v[at]) + j * v[at + 2];
    [v[0] + 2.0 * v[3], v[1] + 2.0 * v[4], spin(1.0, 0.004, 0) + spin(2.0, 0.04, 3)]
}

fn energy([_, v]: &[Vec<f64>; 2]) -> f64 {
    let of =
        |m: f64, j: f64, at: usize| m * (v[at] * v[at] + v[at + 1] * v[at + 1]) + j * v[at + 2] * v[at + 2];
    0.5 * (of(1.0, 0.004, 0) + of(2.0, 0.04, 3))
}

/// Forces in contact are opposite and act at one point: momenta are what they were. Without friction and loss the energy is, too.
#[test]
fn every_pair_of_outlines_conserves_momenta_and_energy() -> Result<(), Error> {
    let rim = "circle rim on a = (0.02 [m], 0.01 [m]) radius 0.1 [m];";
    let bar = "segment rim on a = (-0.1 [m], 0.02 [m]) to (0.12 [m], -0.01 [m]) radius 0.03 [m];";
    let tile = "polygon rim on a = (-0.1 [m], -0.05 [m]) to (0.1 [m], -0.06 [m]) to (0 [m], 0.1 [m]) radius 0.02 [m];";
    let block = "polygon s on b = (-0.3 [m], -0.1 [m]) to (0.3 [m], -0.1 [m]) to (0.3 [m], 0.08 [m]) to (-0.3 [m], 0.1 [m]) radius 0.01 [m];";
    let with = |of_a| move |of_b| [of_a, of_b];
    let touched = [
        "circle s on b = (0.05 [m], 0.05 [m]) radius 0.1 [m];",
        "bore s on b = (0.1 [m], 0.02 [m]) radius 0.61 [m];",
        "line s on b = (0.1 [m], 0.05 [m]) along (1, 0.1);",
        "segment s on b = (-0.3 [m], 0.05 [m]) to (0.3 [m], 0.1 [m]) radius 0.02 [m];",
        // its end is hit
        "segment s on b = (0.05 [m], 0.05 [m]) to (0.5 [m], -0.4 [m]) radius 0.02 [m];",
        // from outside, from within, its end
        "arc s on b = (0, -0.3 [m]) radius 0.4 [m] from 60 [deg] to 120 [deg];",
        "arc s on b = (0.1 [m], 0.65 [m]) radius 0.7 [m] from 240 [deg] to 300 [deg];",
        "arc s on b = (0.3 [m], -0.2 [m]) radius 0.32 [m] from 20 [deg] to 140 [deg];",
        block,
        // its corner
        "polygon s on b = (0, -0.3 [m]) to (0.2 [m], -0.3 [m]) to (0.04 [m], 0.2 [m]);",
    ];
    let cornered = [
        "line s on b = (0.1 [m], 0.05 [m]) along (1, 0.1);",
        "bore s on b = (0.1 [m], 0.02 [m]) radius 0.61 [m];",
        block,
    ];
    let pairs =
        touched.map(with(rim)).into_iter().chain(cornered.map(with(bar))).chain(cornered.map(with(tile)));
    let tolerances = Tolerances { rtol: 1e-10, ..TIGHT };
    for outline in pairs.step_by(STRIDE) {
        let mut found = Vec::new();
        for properties in
            ["", "restitution = 0.5; speed = 2 [m/s]; coefficient = 0.4; transition = 1 [cm/s];"]
        {
            for ends in ["a.rim, b.s", "b.s, a.rim"] {
                let text = pair(outline, ends, properties);
                let [start, end] = [1e-9, 0.5].map(|t| at(&text, t, tolerances));
                let (start, end) = (start?, end?);
                for (before, behind) in momenta(&start).into_iter().zip(momenta(&end)) {
                    assert!((before - behind).abs() < 1e-9, "{outline:?} {ends} {before} {behind}");
                }
                let lost = energy(&start) - energy(&end);
                assert!((end[1][1] + 2.0).abs() > 0.1, "no contact: {outline:?} {end:?}");
                if properties.is_empty() {
                    assert!(lost.abs() < 1e-8, "{outline:?} {ends} {lost}");
                } else {
                    assert!(lost > 1e-3, "{outline:?} {ends} {lost}");
                }
                found.push(end[1].clone());
            }
        }
        // whichever of them is the first
        for pair in found.chunks(2) {
            let apart = pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-8, "{outline:?} {apart}");
        }
    }
    Ok(())
}

/// Regression: a run to a tolerance led a ball, or a plank, through what is thin beside the way of a step: 18 of 40 balls.
#[test]
fn what_is_thin_is_not_passed() -> Result<(), Error> {
    let ball = "body ball (x, y) { mass = 1 [kg]; } circle outline on ball = (0, 0) radius 5 [mm];";
    let plank = "body ball (x, y, phi) { mass = 1 [kg]; inertia = 0.03 [kg*m^2]; }
        polygon outline on ball = (-0.3 [m], -0.02 [m]) to (0.3 [m], -0.02 [m]) to (0.3 [m], 0.02 [m]) to (-0.3 [m], 0.02 [m]) radius 1 [mm];";
    for number in 0..40 {
        let share = f64::from(number) / 40.0;
        let (thickness, height) = (1e-4 * 10.0_f64.powf(2.0 * share), 0.3 + 2.0 * share);
        let is_plank = number % 4 == 3;
        let (dof, body) = if is_plank { (3, plank) } else { (2, ball) };
        let turned = if is_plank { "phi = 0.1 [rad];" } else { "" };
        let wall = match number % 2 {
            0 => format!(
                "polygon wall on ground = (-9 [m], {low} [m]) to (9 [m], {low} [m]) to (9 [m], 0) to (-9 [m], 0);",
                low = -thickness
            ),
            _ => {
                format!("segment wall on ground = (-9 [m], 0) to (9 [m], 0) radius {} [m];", 0.5 * thickness)
            }
        };
        // on a floor, or thrown against a ceiling
        let (up, speed) = if number % 8 < 4 { (1.0, 0.0) } else { (-1.0, 10.0) };
        // a hit dents by a quarter of the thickness
        let hit = (speed * speed + 2.0 * 9.81 * up * height).sqrt();
        let stiffness = (4.0 * hit / thickness).powi(2);
        let text = format!(
            "Thin {{ dof = {dof}; gravity = (0, -9.81) [m/s^2]; {body} {wall}
               contact c (ball.outline, ground.wall) {{ stiffness = {stiffness} [N/m]; restitution = 0.5; speed = {hit} [m/s]; }}
               start {{ y = {} [m]; der(y) = {speed} [m/s]; der(x) = {share} [m/s]; {turned} }} }}",
            up * height
        );
        let rtol = [1e-3, 1e-6, 1e-9][number as usize % 3];
        let tolerances = Tolerances { rtol, atol: 1e-3 * rtol, max_step: f64::INFINITY, first_step: None };
        let first = (hit - speed).abs() / 9.81;
        let [q, _] = at(&text, first + 0.05, tolerances)?;
        assert!(up * q[1] > 0.0, "{rtol}: {q:?}\n{text}");
    }
    Ok(())
}
