//! Runs to a tolerance near singular positions: they pass, or name the position soon.
#![allow(clippy::expect_used, clippy::unwrap_used, reason = "helpers of tests")]

use std::fmt::Write;
use std::time::Instant;

use mbs_live::{Live, Run, Text};
use mbs_runtime::{Bs3, Dop853, Dopri5, Error, Scheme, Tolerances};

/// So many four-bar windows side by side, of links of 1 m, which are flat on their way; released upright with
/// 1 rad/s. At 0.7084 s one of them is flat, where its constraints depend on each other.
fn windows(count: usize) -> Live {
    let mut text = String::from("Windows { dof = 1; gravity = (0, -9.81) [m/s^2];\n");
    for post in 0..=count {
        writeln!(
            text,
            "body p{post} (x{post}, y{post}, a{post}) {{ mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }}
             point foot on p{post} = (-0.5 [m], 0); point head on p{post} = (0.5 [m], 0);
             point base{post} on ground = ({post} [m], 0); revolute foot{post} (p{post}.foot, ground.base{post});"
        )
        .unwrap();
    }
    for beam in 0..count {
        let next = beam + 1;
        writeln!(
            text,
            "body b{beam} (x = u{beam}, y = v{beam}, angle = c{beam}) {{ mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }}
             point left on b{beam} = (-0.5 [m], 0); point right on b{beam} = (0.5 [m], 0);
             revolute left{beam} (p{beam}.head, b{beam}.left);
             revolute right{beam} (b{beam}.right, p{next}.head);"
        )
        .unwrap();
    }
    text.push_str("start { a0 = 90 [deg]; der(a0) = 1 [rad/s];\n");
    for post in 0..=count {
        let angle = if post > 0 { format!("guess a{post} = 90 [deg];") } else { String::new() };
        writeln!(text, "{angle} guess x{post} = {post} [m]; guess y{post} = 0.5 [m];").unwrap();
    }
    for beam in 0..count {
        writeln!(text, "guess u{beam} = {beam} [m] + 0.5 [m]; guess v{beam} = 1 [m];").unwrap();
    }
    text.push_str("} }");
    Text::declaration("windows.mbs", &text).compile().expect("windows")
}

/// The result of a run of 20 s, and the number of steps that it tried.
fn ended<S: Scheme>(live: &Live, rtol: f64) -> (Result<(), Error>, u64) {
    let tolerances = Tolerances { rtol, atol: 1e-9_f64.min(rtol), ..Tolerances::default() };
    let mut run = Run::adaptive(live).scheme::<S>().tolerances(tolerances).build().expect("a start");
    let result = run.advance_to(20.0);
    let effort = run.effort();
    (result, effort.steps + effort.rejected)
}

/// Steps as short as rounding makes them are few: the run passes, or the error names a pin.
#[test]
fn a_window_that_is_flat_on_its_way_is_passed_or_named() {
    let live = windows(1);
    let mut named = 0;
    for rtol in [1e-4, 1e-6, 1e-8, 1e-10] {
        for (word, (result, steps)) in [
            ("bs3", ended::<Bs3>(&live, rtol)),
            ("dopri5", ended::<Dopri5>(&live, rtol)),
            ("dop853", ended::<Dop853>(&live, rtol)),
        ] {
            assert!(steps < 5000, "{word} {rtol:e}: {steps}");
            match result {
                Ok(()) => {}
                Err(Error::Singular { constraint, growth, .. }) => {
                    assert!(!constraint.is_empty() && growth > 1e3, "{word} {rtol:e}: {result:?}");
                    named += 1;
                }
                Err(error) => panic!("{word} {rtol:e}: {error}"),
            }
        }
    }
    assert!(named > 0);
    // a scheme of low order and a fine tolerance lead straight to the first one
    let (result, _) = ended::<Bs3>(&live, 1e-10);
    let Err(Error::Singular { t, .. }) = result else { panic!("{result:?}") };
    assert!((t - 0.70845).abs() < 1e-3, "{t}");
}

#[test]
fn forty_windows_end_within_seconds() {
    let live = windows(40);
    let began = Instant::now();
    let (result, _) = ended::<Bs3>(&live, 1e-10);
    assert!(matches!(result, Err(Error::Singular { t, .. }) if (t - 0.7215).abs() < 1e-3), "{result:?}");
    assert!(began.elapsed().as_secs() < 10, "{:?}", began.elapsed());
}
