//! Equilibria and small motions of what modes hold: those of a mechanism that has their constraints outright.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_analysis::{Equilibrium, Error, OperatingPoint, Ports, Search, equilibrium, linearize};
use mbs_live::{Live, Text};
use mbs_runtime::equations::Equations;

fn live(text: &str) -> Live {
    Text::declaration("held.mbs", text).compile().unwrap_or_else(|error| panic!("{error}"))
}

/// A bar on a spring over a floor, a slide on a spring that may be tied to it, and what is put in place of `HELD`.
fn bar(dof: i32, held: &str) -> Live {
    let text = "Bar {
        dof = DOF;
        gravity = (0, -9.81) [m/s^2];
        body bar (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        body slide (x = s) { mass = 3 [kg]; }
        point tip on bar = (-0.5 [m], 0);
        point end on bar = (0.5 [m], 0);
        spring hang (bar.end, ground) { stiffness = 100 [N/m]; length = 0.2 [m]; }
        potential own = 40 [N/m]*(s - 0.3 [m])^2/2;
        stop floor: y >= -0.55 [m] { restitution = 0; }
        output held [N] = lambda(hook_y);
        start { guess x = 0.3 [m]; guess y = -0.3 [m]; guess phi = -1; }
        HELD
    }";
    live(&text.replace("DOF", &dof.to_string()).replace("HELD", held))
}

/// With modes on, by their names.
fn at_rest(live: &Live, on: &[&str]) -> Result<Equilibrium, Error> {
    let is_on = |name: &str| f64::from(u8::from(on.contains(&name)));
    let inputs = live.info().inputs.iter().map(|input| is_on(input.name)).collect();
    equilibrium(live, &Search { inputs: Some(inputs), ..Search::default() })
}

const MODES: &str = "mode caught { revolute hook (bar.tip, ground); }
    mode tied { constraint tie: s = 0.2*y + 0.3 [m]; }
    mode twice { constraint again: 2*x - cos(phi)*(1 [m]) = 0; }
    mode apart { constraint far: x = 3*s + 2 [m]; constraint wide: x = 3*s + 1 [m]; }
    mode rolling { rate roll: der(s) = (1 [m])*der(phi); }
    when x > 5 [m] { enter caught; enter tied; enter apart; enter rolling; enter twice; }
    when t > 1 [s] { leave caught; leave tied; leave apart; leave rolling; leave twice; }";

#[test]
fn what_modes_hold_rests_as_what_joints_hold() {
    let hook = "revolute hook (bar.tip, ground);";
    let tie = "constraint tie: s = 0.2*y + 0.3 [m];";
    // the hook says what `twice` says
    for (on, dof, outright) in [
        (&["caught"][..], 2, hook.to_owned()),
        (&["caught", "tied"], 1, format!("{hook} {tie}")),
        (&["caught", "twice"], 2, hook.to_owned()),
    ] {
        let (switching, fixed) = (bar(4, MODES), bar(dof, &outright));
        let rest = at_rest(&switching, on).unwrap();
        let expected = equilibrium(&fixed, &Search::default()).unwrap();
        let is_close = |a: f64, b: f64| (a - b).abs() < 1e-9 * (1.0 + b.abs());
        assert!(rest.q.iter().zip(&expected.q).all(|(a, b)| is_close(*a, *b)), "{on:?}: {:?}", rest.q);
        let multipliers: Vec<f64> = rest.held.iter().map(|(_, multiplier)| *multiplier).collect();
        assert_eq!(multipliers.len(), expected.multipliers.len());
        let pairs = || multipliers.iter().zip(&expected.multipliers);
        assert!(pairs().all(|(a, b)| is_close(*a, *b)), "{on:?}: {multipliers:?}");
        assert_eq!(rest.stiffness.len(), usize::try_from(dof).unwrap());
        let pairs = || rest.stiffness.iter().zip(&expected.stiffness);
        assert!(pairs().all(|(a, b)| is_close(*a, *b)), "{on:?}: {:?}", rest.stiffness);

        let linear =
            |live: &Live, rest| linearize(live, &OperatingPoint::from(rest), &Ports::default()).unwrap();
        let [found, outright] = [linear(&switching, &rest), linear(&fixed, &expected)];
        assert!((found.a.clone() - &outright.a).amax() < 1e-7 * outright.a.amax(), "{on:?}: {}", found.a);
        // neither modes nor what they remember are inputs
        assert_eq!(found.b.ncols(), 0);
    }
}

/// The floor pushes where the hook holds the bar so that it touches.
#[test]
fn stops_are_rested_on_beside_modes() {
    let held = "mode low { constraint down: phi = 0.2*x/(1 [m]); }
        when x > 5 [m] { enter low; } when t > 1 [s] { leave low; }
        force load on y = -200 [N];";
    let text =
        held.to_owned() + "mode unused { revolute hook (bar.tip, ground); } when t > 2 [s] { enter unused; }";
    let rest = at_rest(&bar(4, &text), &["low"]).unwrap();
    assert!(rest.q[1] == -0.55 && rest.rests.len() == 1 && rest.held.len() == 1);
    let [(_, floor), (_, turning)] = [rest.rests[0], rest.held[0]];
    let outright = "constraint down: phi = 0.2*x/(1 [m]); force load on y = -200 [N]; mode unused { revolute hook \
                    (bar.tip, ground); } when t > 2 [s] { enter unused; }";
    let expected = equilibrium(&bar(3, outright), &Search::default()).unwrap();
    assert!((floor - expected.rests[0].1).abs() < 1e-9 && (turning - expected.multipliers[0]).abs() < 1e-9);
}

/// Regression: a stop at the place where a mode holds was refused, as one that is touched without force. A mode at its place
/// and the constraint outright, a little above it, have the same small motions.
#[test]
fn a_stop_sees_no_small_motion_where_a_mode_holds() {
    let at = |y: &str| {
        let low = format!("mode low {{ constraint down: y = {y} [m]; }} when x > 5 [m] {{ enter low; }}");
        let live = bar(4, &(MODES.to_owned() + &low));
        let rest = at_rest(&live, &["low"]).unwrap();
        assert!(rest.rests.is_empty() && rest.stiffness.len() == 3);
        linearize(&live, &OperatingPoint::from(&rest), &Ports::default()).unwrap().a
    };
    let [touching, above] = [at("-0.55"), at("-0.549999")];
    assert!((touching.clone() - above).amax() < 1e-4 * touching.amax(), "{touching}");
}

#[test]
fn what_cannot_hold_is_refused() {
    let live = bar(4, MODES);
    for (on, part) in [("apart", "constraint `wide` is off by"), ("rolling", "equation between rates")] {
        let message = at_rest(&live, &[on]).unwrap_err().to_string();
        assert!(message.contains(part), "{message}");
    }
    let mut point = OperatingPoint::from(&at_rest(&live, &["caught"]).unwrap());
    point.q[0] += 0.1;
    let message = linearize(&live, &point, &Ports::default()).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("`hook_x` is off by 0.1"), "{message}");
}
