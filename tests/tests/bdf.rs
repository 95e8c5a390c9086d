//! Backward differentiation formulas of another crate: the tolerance on stiff bushings and dampers,
//! agreement with explicit runs, inputs, and what ends a run.
//! `cargo test --release -p tests --features bdf --test bdf`
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_analysis::{Bdf, BdfSteps, FirstOrder};
use mbs_live::{Live, Prepared, Text};
use mbs_runtime::{Adaptive, Dop853, Error, Sampled, System, Tolerances, TrBdf2};
use tests::bushing::{CRANK, REDUCED};

const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-8];

fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-3 * rtol, ..Tolerances::default() }
}

fn compiled(text: &str) -> Live {
    Text::declaration("text.mbs", text).compile().expect("a declaration")
}

fn started(live: &Live, rtol: f64, interval: f64) -> Bdf<Prepared> {
    let system = FirstOrder::new(live.clone()).expect("derivatives");
    let run = BdfSteps::builder(Prepared::new(live), system, tolerances(rtol), interval).build();
    run.expect("a start")
}

/// Positions and velocities.
type State = [Vec<f64>; 2];

fn state(run: &dyn System) -> State {
    let n = run.equations().info().coordinates.len();
    let mut all = [vec![0.0; n], vec![0.0; n]];
    let [q, v] = &mut all;
    run.state(q, v);
    all
}

/// A crank with this bushing, from a start on the slow motion (100 steps of TR-BDF2 damp the vibration
/// that the declared start begins with), and its state a turn later by steps that resolve a vibration.
fn turned(text: &str, stiffness: f64, damping: f64) -> (Live, (f64, State), State) {
    let at = |name: &str, live: &Live| {
        live.declared_info().parameters.iter().position(|parameter| parameter.name == name).expect("a name")
    };
    let live = compiled(text);
    let [k, c] = ["stiffness", "damping"].map(|name| at(name, &live));
    let live = live.with_parameters(|values| (values[k], values[c]) = (stiffness, damping));
    let live = live.expect("parameters");
    let mut settling = TrBdf2::builder(Prepared::new(&live), 1e-4).build().expect("a start");
    settling.advance_to(1e-2).expect("a regular motion");
    let (t, [q, v]) = (settling.time(), state(&settling));
    let mut fine = Adaptive::builder(Prepared::new(&live))
        .scheme::<Dop853>()
        .tolerances(tolerances(1e-11))
        .from_vectors(t, q.clone(), v.clone())
        .build()
        .expect("a start");
    fine.advance_to(t + 0.3).expect("a regular motion");
    let end = state(&Sampled::new(fine, 1.0).expect("an interval"));
    (live, (t, [q, v]), end)
}

/// The crank angle and the stroke a turn later, whose errors are those of some hundred to some ten
/// thousand steps. They stay within ten tolerances, and the samples on the constraints.
#[test]
fn stiff_bushings_are_followed_to_the_tolerance() {
    for text in [CRANK, REDUCED] {
        let (live, (t, [q, v]), [end, _]) = turned(text, 1e9, 0.0);
        for rtol in TOLERANCES {
            let system = FirstOrder::new(live.clone()).expect("derivatives");
            let mut run = BdfSteps::builder(Prepared::new(&live), system, tolerances(rtol), 0.01)
                .from_vectors(t, q.clone(), v.clone())
                .build()
                .expect("a start");
            run.advance_to(t + 0.3).expect("a regular motion");
            let [found, _] = state(&run);
            for at in [0, 4] {
                let allowed = rtol * end[at].abs() + 1e-3 * rtol;
                let ratio = (found[at] - end[at]).abs() / allowed;
                println!("{rtol:e} {ratio:.2} {:?}", run.effort());
                assert!(ratio < 10.0, "{rtol:e}: {ratio}");
            }
            assert!(System::violations(&run).iter().all(|violation| *violation < 1e-9));
        }
    }
}

/// A mass on a spring in a damper of 10⁶ N s/m: x = (λ₂ e^(λ₁t) − λ₁ e^(λ₂t))/(λ₂ − λ₁) with λ₁ ≈ −1/s
/// and λ₂ ≈ −10⁶/s. An explicit method is unstable in steps above 3.3/|λ₂|, of which this takes a
/// hundredth at most.
#[test]
fn stiff_dampers_do_not_shorten_steps() {
    let live = compiled(
        "Damped {
            dof = 1;
            body mass (x) { mass = 1 [kg]; }
            force damper on x = -1e6 [N*s/m]*der(x);
            force spring on x = -1e6 [N/m]*x;
            start { x = 1 [m]; }
        }",
    );
    let root = (1e12_f64 - 4e6).sqrt();
    let (fast, slow) = (-0.5 * (1e6 + root), -2e6 / (1e6 + root));
    let exact = (fast * (2.0 * slow).exp() - slow * (2.0 * fast).exp()) / (fast - slow);
    for rtol in TOLERANCES {
        let mut run = started(&live, rtol, 0.1);
        run.advance_to(2.0).expect("a regular motion");
        let [x, _] = state(&run);
        let effort = run.effort().expect("an effort");
        println!("{rtol:e} {:e} {effort:?}", x[0] - exact);
        assert!((x[0] - exact).abs() < 10.0 * (rtol * exact + 1e-3 * rtol), "{rtol:e} {:e}", x[0] - exact);
        assert!((effort.steps + effort.rejected) as f64 * 100.0 < 2.0 * 1e6 / 3.3, "{effort:?}");
    }
}

/// Where nothing is stiff it is as good as an explicit method, within ten tolerances, at every sample.
#[test]
fn soft_mechanisms_agree_with_explicit_runs() {
    let (live, (t, [q, v]), _) = turned(CRANK, 2e3, 5.0);
    for rtol in [1e-6, 1e-8] {
        let fine = Adaptive::builder(Prepared::new(&live))
            .tolerances(tolerances(1e-11))
            .from_vectors(t, q.clone(), v.clone())
            .build();
        let mut fine = Sampled::new(fine.expect("a start"), 3e-3).expect("an interval");
        let system = FirstOrder::new(live.clone()).expect("derivatives");
        let mut run = BdfSteps::builder(Prepared::new(&live), system, tolerances(rtol), 3e-3)
            .from_vectors(t, q.clone(), v.clone())
            .build()
            .expect("a start");
        for _ in 0..100 {
            run.step().expect("a regular motion");
            fine.step().expect("a regular motion");
            let ([[found, _], [exact, _]], allowed) = ([state(&run), state(&fine)], 10.0 * rtol);
            for (found, exact) in found.iter().zip(&exact) {
                assert!((found - exact).abs() < allowed * (exact.abs() + 1.0), "{rtol:e}: {found} {exact}");
            }
        }
    }
}

/// A force that changes at samples: the motion of a point mass, which BDF of order 2 and above
/// integrates exactly but for its tolerance. An input that is set to what it is does not start the
/// solver anew.
#[test]
fn inputs_act_from_a_sample_on() {
    let live = compiled(
        "Pushed {
            dof = 1;
            input push [N];
            body mass (x) { mass = 2 [kg]; }
            force hand on x = push;
            start { x = 0; }
        }",
    );
    let (h, mut x, mut v) = (0.1, 0.0, 0.0);
    let begun = || {
        let system = FirstOrder::new(live.clone()).expect("derivatives");
        let builder = BdfSteps::builder(Prepared::new(&live), system, tolerances(1e-8), h);
        builder.inputs(vec![5.0]).build().expect("a start")
    };
    let (mut run, mut same, mut untouched) = (begun(), begun(), begun());
    for step in 0..50 {
        let push = if step % 7 < 3 { 5.0 } else { -3.0 };
        System::set_inputs(&mut run, &[push]);
        System::set_inputs(&mut same, &[5.0]);
        run.step().expect("a regular motion");
        same.step().expect("a regular motion");
        x += h * v + 0.5 * h * h * push / 2.0;
        v += h * push / 2.0;
        let [found, rate] = state(&run);
        assert!((found[0] - x).abs() < 1e-6 && (rate[0] - v).abs() < 1e-6, "{found:?} {x}");
    }
    let effort = |run: &Bdf<Prepared>| run.effort().expect("an effort");
    untouched.advance(50).expect("a regular motion");
    assert_eq!(effort(&same), effort(&untouched));
    assert!(effort(&run).steps > 2 * effort(&same).steps, "{:?}", effort(&run));
}

/// Runs end with errors in the words of the mechanism, and leave the state of the last sample: a motion
/// that runs away in finite time, a force that is not defined any more, and a drive that leads beyond
/// what can be reached.
#[test]
fn runs_that_cannot_go_on_say_why() {
    let ended = |text: &str| {
        let mut run = started(&compiled(text), 1e-6, 0.05);
        let error = run.advance_to(20.0).expect_err("an end");
        assert!(run.time() < 20.0);
        (error, run.time())
    };
    // ẋ = ẏ² from 1 has 1/(1 − t)
    let (error, t) = ended(
        "Runaway {
            dof = 1;
            body mass (x) { mass = 1 [kg]; }
            force away on x = 1 [kg/m]*der(x)^2;
            start { x = 0; der(x) = 1 [m/s]; }
        }",
    );
    assert!(matches!(error, Error::StepTooShort { t, .. } if (t - 1.0).abs() < 1e-3), "{error}");
    assert!((t - 0.95).abs() < 0.06, "{t}");
    let (error, _) = ended(
        "Root {
            dof = 1;
            body mass (x) { mass = 1 [kg]; }
            force odd on x = 1 [N]*sqrt(1 - x/(1 [m]));
            start { x = 0; der(x) = 1 [m/s]; }
        }",
    );
    assert!(matches!(error, Error::StepTooShort { .. } | Error::NonFinite { .. }), "{error}");
    let (error, t) = ended(
        "Reach {
            dof = 0;
            body bar (x, y) { mass = 1 [kg]; }
            constraint rod: x^2 + y^2 = 1 [m^2];
            drive pull: x = 0.1 [m/s]*t;
            start { guess y = 1 [m]; }
        }",
    );
    assert!(t <= 10.0, "{t}");
    assert!(matches!(error, Error::OutOfReach { .. } | Error::Singular { .. }), "{error}");
}

/// Tolerances that no run can keep are refused at the start.
#[test]
fn tolerances_are_checked() {
    let live = compiled("S { dof = 1; body m (x) { mass = 1 [kg]; } start { x = 0; } }");
    for (rtol, atol) in [(0.0, 1e-9), (1e-15, 1e-9), (1e-6, 0.0), (f64::NAN, 1e-9)] {
        let system = FirstOrder::new(live.clone()).expect("derivatives");
        let given = Tolerances { rtol, atol, ..Tolerances::default() };
        let refused = BdfSteps::builder(Prepared::new(&live), system, given, 0.1).build().err();
        assert!(matches!(refused, Some(Error::Tolerance { .. })), "{refused:?}");
    }
    let system = FirstOrder::new(live.clone()).expect("derivatives");
    let refused = BdfSteps::builder(Prepared::new(&live), system, Tolerances::default(), 0.0).build().err();
    assert!(matches!(refused, Some(Error::Step { .. })), "{refused:?}");
}
