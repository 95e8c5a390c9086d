//! Positions in which constraints lose their hold: constraints that touch, as a circle touches its
//! tangent, are told from constraints that repeat others; dead centres of the guesses are named.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_live::{Live, Text};

fn compile(text: &str) -> Result<Live, String> {
    let compiled = Text::declaration("test.mbs", text).compile();
    compiled.map_err(|error| error.problems().iter().map(|problem| problem.message.clone()).collect())
}

/// Two blocks on parallel rails 1 m apart, joined by a bar of exactly 1 m.
fn rungs(statements: &str) -> String {
    format!(
        "Rungs {{ dof = 1; body left (y1) {{ mass = 1 [kg]; }} body right (x2, y2) {{ mass = 1 [kg]; }}
            constraint rail: x2 = 1 [m]; {statements} start {{ guess x2 = 1 [m]; }} }}"
    )
}

/// With a guess beside the double root it was accepted, with a force of 4.5e15 N in the bar.
#[test]
fn a_bar_across_parallel_rails_touches_them() {
    let bar = "distance bar (left, right) = 1 [m];";
    for more in ["", "redundant = minimum_norm;", "force push on y1 = 2 [N];"] {
        for guess in ["", "start { guess y2 = 0.1 [m]; }", "start { guess y2 = -3 [m]; }"] {
            let message = compile(&rungs(&format!("{bar} {more} {guess}"))).map(|_| ()).unwrap_err();
            assert!(message.contains("`bar`") && message.contains("touches constraint `rail`"), "{message}");
        }
    }
    compile(&rungs("constraint level: y1 = y2;")).unwrap();
}

/// Regression: two pins weld two bodies, and a short rod between them is met on another branch too, a few centimetres
/// away. A nudge that led there was taken for a violation by its square.
#[test]
fn another_branch_nearby_is_no_touching() {
    let welded = "Welded { dof = 1; redundant = minimum_norm; gravity = (0, -9.81) [m/s^2];
        body b1 (x1, y1, phi1) { mass = 2.6 [kg]; inertia = 0.02 [kg*m^2]; }
        body b0 (x0, y0, phi0) { mass = 3.1 [kg]; inertia = 0.9 [kg*m^2]; }
        point j3b on b0 = (1.1890375587210464, -1.4240031212542297) [m];
        revolute j3 (b1, b0.j3b);
        point j2a on b1 = (-0.5016081375710644, 0.8441433477945857) [m];
        point j2b on b0 = (0.7128972605120627, -2.201742989885313) [m];
        distance j2 (b1.j2a, b0.j2b) = 0.09461592013101576 [m];
        point j0a on b0 = (0.5901524742249427, -0.9971283382639209) [m];
        point j0b on ground = (0.046300122943707174, -0.6153129637439662) [m];
        rolling j0 (b0.j0a, ground.j0b) along (-0.2347705915947329, 0.1515303279580733)
            radius 0.09318530746465709 [m] at -0.3370825380710797 [m];
        point j1a on b1 = (-0.24583877548283595, 0.2807440797278482) [m];
        point j1b on b0 = (1.0322666553129929, -1.762642790634176) [m];
        revolute j1 (b1.j1a, b0.j1b);
        start { guess x0 = -0.41714509184613213 [m]; guess y0 = 0.03662294085371531 [m];
            guess phi0 = 0.12028922115296314; guess x1 = 0.9341798867711102 [m];
            guess y1 = -1.2344065661036188 [m]; guess phi1 = 2.1091081848875026; } }";
    for states in ["", "states = reduced;"] {
        let text = welded.replace("dof = 1;", &format!("dof = 1; {states}"));
        assert_eq!(compile(&text).map(|live| live.declared_info().redundant.len()), Ok(2));
    }
}

/// A deck on two straight-line linkages: its second pin repeats the first at every position that can
/// be reached, and a slot in its place does not.
fn deck(second: &str, redundant: &str) -> String {
    let mut text = format!("Deck {{ dof = 1; {redundant} gravity = (0, -9.81) [m/s^2];");
    for (name, foot) in [("a", 0), ("b", 1)] {
        text += &format!(
            "body {name} (x{name}, y{name}, p{name}) {{ mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }}
             body s{name} (x = u{name}) {{ mass = 0.5 [kg]; }}
             body c{name} (xc{name}, yc{name}, pc{name}) {{ mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }}
             point low on {name} = (-0.4, 0) [m]; point mid on {name} = (0, 0); point top on {name} = (0.4, 0) [m];
             point foot on c{name} = (-0.2, 0) [m]; point end on c{name} = (0.2, 0) [m];
             point base{name} on ground = ({foot} [m], 0);
             revolute f{name} (c{name}.foot, ground.base{name}); revolute m{name} (c{name}.end, {name}.mid);
             revolute l{name} ({name}.low, s{name});"
        );
    }
    text + &format!(
        "body deck (xd, yd, pd) {{ mass = 10 [kg]; inertia = 1 [kg*m^2]; }}
         point left on deck = (0, 0); point right on deck = (1, 0) [m];
         revolute ta (a.top, deck.left); {second}
         start {{ ua = -0.5 [m]; guess pa = 50 [deg]; guess pca = 130 [deg];
            guess ub = 0.5 [m]; guess pb = 50 [deg]; guess pcb = 130 [deg];
            guess xa = -0.25 [m]; guess ya = 0.3 [m]; guess xb = 0.75 [m]; guess yb = 0.3 [m];
            guess xca = -0.12 [m]; guess yca = 0.15 [m]; guess xcb = 0.87 [m]; guess ycb = 0.15 [m];
            guess yd = 0.6 [m]; }} }}"
    )
}

#[test]
fn a_deck_on_two_straight_line_linkages_touches_them() {
    let pin = "revolute tb (b.top, deck.right);";
    for redundant in ["", "redundant = minimum_norm;"] {
        let message = compile(&deck(pin, redundant)).map(|_| ()).unwrap_err();
        assert!(message.contains("joint `tb`") && message.contains("touches joints"), "{message}");
    }
    // the deck slides on the second linkage, and two degrees of freedom are left
    let slot = deck("pin_slot tb (b.top, deck.left) along (1, 0);", "").replace("dof = 1", "dof = 2");
    compile(&slot).unwrap();
}

/// Off the parallelogram the rank is 3; on it, it is 2 everywhere.
#[test]
fn a_spare_rope_of_a_parallelogram_repeats_the_others() {
    for [x, y] in [[0.0, -0.3], [0.1, -0.28], [-0.2, -0.2], [0.25, 0.15]] {
        compile(&format!(
            "Parallelogram {{ dof = 1; redundant = minimum_norm; gravity = (0, -9.81) [m/s^2];
                body coupler (x, y, theta) {{ mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }}
                point l on coupler = (-0.5, 0) [m]; point r on coupler = (0.5, 0) [m];
                point a on ground = (-0.5, 0) [m]; point b on ground = (0.5, 0) [m];
                distance left (coupler.l, ground.a) = 0.3 [m]; distance right (coupler.r, ground.b) = 0.3 [m];
                distance spare (coupler, ground) = 0.3 [m];
                start {{ guess x = {x} [m]; guess y = {y} [m]; }} }}"
        ))
        .unwrap_or_else(|message| panic!("{x} {y}: {message}"));
    }
}

/// A span that would have been followed for days.
#[test]
fn a_span_that_is_too_long_says_how_far_it_was_followed() {
    for span in ["closes theta = 0 .. 1e9;", "closes = 0 [s] .. 1e9 [s];"] {
        let message = compile(&format!(
            "M {{ dof = 1; body b (x, y, theta) {{ mass = 1 [kg]; inertia = 1 [kg*m^2]; }}
                body c (x = z) {{ mass = 1 [kg]; }} drive d: z = 1 [m/s]*t;
                point p on b = (1, 0) [m]; revolute r (b.p, ground); {span} }}"
        ))
        .map(|_| ())
        .unwrap_err();
        assert!(message.contains("too long to be followed"), "{message}");
    }
}

/// A compound lever, half of it: at h = 0 the centre guide does not depend on h to first order, so that
/// the jaw was moved from where it is declared to start.
fn cutter(guess: &str) -> String {
    format!(
        "Cutter {{ dof = 1; body jawb (angle = j) {{ inertia = 1e-4 [kg*m^2]; }}
            body grip (xh, yh, h) {{ mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }}
            point eye on jawb = (-80, 10) [mm]; point eye on grip = (0, 0); point mid on grip = (0, -25) [mm];
            revolute pin (jawb.eye, grip.eye); point_on_line centre (grip.mid, ground) along (1, 0);
            start {{ j = 0; guess h = {guess}; guess xh = -80 [mm]; guess yh = 10 [mm]; }} }}"
    )
}

#[test]
fn a_dead_centre_of_the_guesses_is_named() {
    let error = Text::declaration("test.mbs", cutter("0")).compile().map(|_| ()).unwrap_err();
    let [problem] = error.problems() else { panic!("{error}") };
    assert!(problem.message.contains("`j` cannot start at 0 [deg]"), "{}", problem.message);
    assert!(problem.message.contains("a dead centre"), "{}", problem.message);
    // 10 mm = 25 mm cos h
    let help = problem.help.as_deref().unwrap_or_default();
    assert!(help.contains("guess h = 66.42") || help.contains("guess h = -66.42"), "{help}");
    for guess in ["66.4 [deg]", "-66.4 [deg]", "30 [deg]"] {
        compile(&cutter(guess)).unwrap();
    }
}
