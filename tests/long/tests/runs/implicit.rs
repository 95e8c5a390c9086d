//! Implicit schemes to a tolerance: stiff bushings and dampers, agreement with explicit runs, orders, events,
//! inputs, and what ends a run.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_live::{Live, Prepared, Text};
use mbs_runtime::implicit::{self, Visitor};
use mbs_runtime::{
    Adaptive, AdaptiveScheme, Direction, Dop853, ESDIRK4, Effort, Error, IMPLICIT, Implicit, Measured,
    Sampled, System, SystemClone, TRBDF2, Threshold, Tolerances, TrBdf2, mechanism,
};
use paths::EXHAUSTIVE;
use tests::bushing::{CRANK, REDUCED};

const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-8];
/// So many tolerances the error of a run is at most. A step adds less than one; of a scheme of second order, which
/// takes many of them, those of one sign add up to a quarter of their number.
fn allowed(scheme: &Implicit, effort: &Effort) -> f64 {
    if scheme.order > 2 { 10.0 } else { 10.0 + 0.25 * effort.steps as f64 }
}

fn tolerances(rtol: f64) -> Tolerances {
    Tolerances { rtol, atol: 1e-3 * rtol, ..Tolerances::default() }
}

fn compiled(text: &str) -> Live {
    Text::declaration("text.mbs", text).compile().expect("a declaration")
}

/// A run of a text with samples so far apart, from the declared start or from another state.
fn started(
    scheme: &Implicit,
    live: &Live,
    tolerances: Tolerances,
    interval: f64,
    from: Option<(f64, State)>,
) -> Result<Box<dyn SystemClone>, Error> {
    struct Started<'a>(&'a Live, Tolerances, f64, Option<(f64, State)>);

    impl Visitor for Started<'_> {
        type Result = Result<Box<dyn SystemClone>, Error>;

        fn visit<S: AdaptiveScheme>(self) -> Self::Result {
            let Self(live, tolerances, interval, from) = self;
            let mut builder = Adaptive::builder(Prepared::new(live)).scheme::<S>().tolerances(tolerances);
            if let Some((t, [q, v])) = from {
                builder = builder.from_vectors(t, q, v);
            }
            Ok(Box::new(Sampled::new(builder.build()?, interval)?))
        }
    }

    implicit::with_type(scheme, Started(live, tolerances, interval, from)).expect("a type")
}

fn effort(run: &dyn System) -> Effort {
    run.effort().expect("an effort")
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
/// thousand steps. The samples stay on the constraints.
#[test]
fn stiff_bushings_are_followed_to_the_tolerance() {
    let texts = if EXHAUSTIVE { &[CRANK, REDUCED][..] } else { &[REDUCED] };
    for (text, scheme) in texts.iter().flat_map(|text| IMPLICIT.map(|scheme| (*text, scheme))) {
        for damping in [0.0, 1e5] {
            let (live, from, [end, _]) = turned(text, 1e9, damping);
            for rtol in TOLERANCES {
                let mut run =
                    started(scheme, &live, tolerances(rtol), 0.01, Some(from.clone())).expect("a start");
                run.advance(30).expect("a regular motion");
                let [found, _] = state(&*run);
                for at in [0, 4] {
                    let one = rtol * end[at].abs() + 1e-3 * rtol;
                    let ratio = (found[at] - end[at]).abs() / one;
                    let effort = effort(&*run);
                    println!("{} {damping:e} {rtol:e} {ratio:.2} {effort:?}", scheme.word);
                    assert!(
                        ratio < allowed(scheme, &effort),
                        "{} {damping:e} {rtol:e}: {ratio}",
                        scheme.word
                    );
                }
                assert!(run.violations().iter().all(|violation| *violation < 1e-9), "{:?}", run.violations());
            }
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
    for (scheme, rtol) in IMPLICIT.into_iter().flat_map(|scheme| TOLERANCES.map(|rtol| (scheme, rtol))) {
        let mut run = started(scheme, &live, tolerances(rtol), 0.1, None).expect("a start");
        run.advance(20).expect("a regular motion");
        let [x, _] = state(&*run);
        let effort = effort(&*run);
        println!("{} {rtol:e} {:e} {effort:?}", scheme.word, x[0] - exact);
        let allowed = allowed(scheme, &effort) * (rtol * exact + 1e-3 * rtol);
        assert!((x[0] - exact).abs() < allowed, "{rtol:e} {:e}", x[0] - exact);
        assert!((effort.steps + effort.rejected) as f64 * 100.0 < 2.0 * 1e6 / 3.3, "{effort:?}");
    }
}

/// The force of a stiff damper and spring, at every sample and between steps, is that of the motion: k x + c ẋ = −m ẍ =
/// −e^(−t) N but for 10⁻⁸. It is 10⁸ times what a tolerance allows in positions, and was off by 153 N.
#[test]
fn stiff_forces_between_steps_are_those_of_the_motion() {
    let live = compiled(
        "Creeping {
            dof = 1;
            body mass (x) { mass = 1 [kg]; }
            spring strong (mass, ground) { stiffness = 1e8 [N/m]; damping = 1e8 [N*s/m]; length = 0; }
            start { x = 1 [m]; }
            output force [N] = force(strong);
        }",
    );
    for (scheme, rtol) in IMPLICIT.into_iter().flat_map(|scheme| [1e-4, 1e-6].map(|rtol| (scheme, rtol))) {
        let mut run = started(scheme, &live, tolerances(rtol), 0.0137, None).expect("a start");
        let mut worst = 0.0_f64;
        for sample in 1..=200 {
            run.step().expect("a regular motion");
            let (mut a, mut multipliers, mut force) = ([0.0], [0.0; 0], [0.0]);
            run.reactions(&mut a, &mut multipliers).expect("accelerations");
            run.outputs(&a, &multipliers, &mut force).expect("outputs");
            if sample > 10 {
                worst = worst.max((force[0].abs() - (-run.time()).exp()).abs());
            }
        }
        println!("{} {rtol:e} {worst:e}", scheme.word);
        // where a velocity follows from a position, an acceleration is its difference quotient in the scheme of second
        // order, and no more accurate than that
        let allowed = if scheme.order > 2 { 100.0 * rtol } else { 0.05 };
        assert!(worst < allowed, "{} {rtol:e}: {worst:e}", scheme.word);
    }
}

/// Where nothing is stiff they are as good as an explicit method at every sample.
#[test]
fn soft_mechanisms_agree_with_explicit_runs() {
    let (live, (t, [q, v]), _) = turned(CRANK, 2e3, 5.0);
    for (scheme, rtol) in IMPLICIT.into_iter().flat_map(|scheme| [1e-6, 1e-8].map(|rtol| (scheme, rtol))) {
        let fine = Adaptive::builder(Prepared::new(&live))
            .tolerances(tolerances(1e-11))
            .from_vectors(t, q.clone(), v.clone())
            .build();
        let mut fine = Sampled::new(fine.expect("a start"), 3e-3).expect("an interval");
        let from = Some((t, [q.clone(), v.clone()]));
        let mut run = started(scheme, &live, tolerances(rtol), 3e-3, from).expect("a start");
        for _ in 0..100 {
            run.step().expect("a regular motion");
            fine.step().expect("a regular motion");
            let ([found, _], [exact, _]) = (state(&*run), state(&fine));
            let allowed = allowed(scheme, &effort(&*run)) * rtol;
            for (found, exact) in found.iter().zip(&exact) {
                assert!((found - exact).abs() < allowed * (exact.abs() + 1.0), "{rtol:e}: {found} {exact}");
            }
        }
    }
}

/// A force that changes at samples: the motion of a point mass.
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
    let (h, x0, v0) = (0.1, 0.0, 0.0);
    for scheme in IMPLICIT {
        let (mut x, mut v) = (x0, v0);
        let mut run = started(scheme, &live, tolerances(1e-8), h, None).expect("a start");
        for step in 0..50 {
            let push = if step % 7 < 3 { 5.0 } else { -3.0 };
            run.set_inputs(&[push]);
            run.step().expect("a regular motion");
            x += h * v + 0.5 * h * h * push / 2.0;
            v += h * push / 2.0;
            let [found, rate] = state(&*run);
            assert!((found[0] - x).abs() < 1e-6 && (rate[0] - v).abs() < 1e-6, "{found:?} {x}");
        }
    }
}

/// Runs end with errors in the words of the mechanism, and leave the state of the last sample: a motion
/// that runs away in finite time, a force that is not defined any more, and a drive that leads beyond
/// what can be reached.
#[test]
fn runs_that_cannot_go_on_say_why() {
    let ended = |scheme: &Implicit, text: &str| {
        let mut run = started(scheme, &compiled(text), tolerances(1e-6), 0.05, None).expect("a start");
        let error = run.advance(400).expect_err("an end");
        assert!(run.time() < 20.0);
        (error, run.time())
    };
    for scheme in IMPLICIT {
        // ẋ = ẏ² from 1 has 1/(1 − t)
        let (error, t) = ended(
            scheme,
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
            scheme,
            "Root {
                dof = 1;
                body mass (x) { mass = 1 [kg]; }
                force odd on x = 1 [N]*sqrt(1 - x/(1 [m]));
                start { x = 0; der(x) = 1 [m/s]; }
            }",
        );
        assert!(matches!(error, Error::StepTooShort { .. } | Error::Undefined { .. }), "{error}");
        let (error, t) = ended(
            scheme,
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
}

/// Andrews' squeezer and the car axis of the Test Set for IVP Solvers (Bari), against the solutions that it prints.
/// The first passes positions that are nearly singular at 1000 rad/s. The second shakes undamped, and magnifies
/// what is off: at 10⁻⁸ the explicit pair of fifth order misses its `yr` by four tolerances.
#[test]
fn test_problems_are_solved_to_the_tolerance() {
    const AXIS: &str = include_str!("declarations/car_axis.mbs");
    let squeezer =
        Text::rust("andrews_squeezer.rs", include_str!("../../../../models/src/andrews_squeezer.rs"));
    let squeezer = squeezer.compile().expect("a declaration");
    let angle = |at: usize| {
        let name = format!("angle{at}");
        squeezer.declared_info().coordinates.iter().position(|q| q.name == name).expect("an angle")
    };
    // β = angle1, δ = angle5, Φ + δ − π/2 = angle4, at 0.03 s
    let half_turn = core::f64::consts::FRAC_PI_2;
    let squeezed = [
        (angle(1), 15.810_771_5),
        (angle(5), 0.524_409_96),
        (angle(4), -0.534_730_13 + 0.524_409_96 - half_turn),
    ];
    let axis = [
        0.049_345_578_427_540_28,
        0.496_989_460_230_171_15,
        1.041_742_524_885_421_5,
        0.373_911_027_265_361_26,
    ];
    let shaken: Vec<(usize, f64)> = axis.into_iter().enumerate().collect();
    for (scheme, rtol) in [(&TRBDF2, 1e-6), (&ESDIRK4, 1e-8)] {
        for (live, input, end, expected, printed) in
            [(&squeezer, 0.033, 0.03, &squeezed[..], 1e-6), (&compiled(AXIS), 0.0, 3.0, &shaken, 1e-12)]
        {
            let mut run = started(scheme, live, tolerances(rtol), 0.1 * end, None).expect("a start");
            if !live.declared_info().inputs.is_empty() {
                run.set_inputs(&[input]);
            }
            run.advance(10).expect("a regular motion");
            let [q, _] = state(&*run);
            for (at, expected) in expected {
                let ratio = ((q[*at] - expected).abs() - printed).max(0.0) / (rtol * (1e-3 + expected.abs()));
                let effort = effort(&*run);
                println!("{} {at} {:e} {ratio:.2} {effort:?}", scheme.word, q[*at] - expected);
                assert!(ratio < 4.0 * allowed(scheme, &effort), "{} {at}: {ratio}", scheme.word);
            }
        }
    }
}

mechanism! {
    /// A pendulum with a spring and a damper.
    pub Damped {
        dof = 1;
        param length = 0.8 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        point wall on ground = (1, 0) [m];
        spring coil (bob, ground.wall) { stiffness = 30 [N/m]; damping = 3 [N*s/m]; length = 0.5 [m]; }
        start { x = length; guess y = 0; }
    }
}

/// In steps of a given length the error falls with the power of the step that the scheme has.
#[test]
fn every_scheme_has_its_order() {
    fn end<S: AdaptiveScheme>(h: f64) -> [f64; 2] {
        let tolerances = Tolerances { rtol: 1.0, atol: 1.0, max_step: h, first_step: Some(h) };
        let builder = Adaptive::builder(Damped::declared()).scheme::<S>().tolerances(tolerances);
        let mut run = builder.build().expect("a start");
        run.advance_to(0.8).expect("a regular motion");
        [run.state().q.x, run.state().v.x]
    }
    let exact = end::<Dop853>(1e-3);
    let order = |end: fn(f64) -> [f64; 2], h: f64| {
        let [coarse, fine] = [h, 0.5 * h].map(|h| {
            let found = end(h);
            [0, 1].map(|at| (found[at] - exact[at]).abs())
        });
        [0, 1].map(|at| (coarse[at] / fine[at]).log2())
    };
    for (word, found, expected) in [
        ("trbdf2", order(end::<implicit::TrBdf2>, 0.01), 2.0),
        ("esdirk4", order(end::<implicit::Esdirk4>, 0.02), 4.0),
    ] {
        println!("{word} {found:?}");
        assert!(found.iter().all(|found| (found - expected).abs() < 0.4), "{word}: {found:?}");
    }
}

/// A weight of 1 kg that sinks in grease of 10⁶ N·s/m passes 10 µm at t = 10 µm · c/g + m/c, and the run ends there.
#[test]
fn events_of_stiff_mechanisms_are_found() {
    let live = compiled(
        "Sinking {
            dof = 1;
            gravity = (0, -9.81) [m/s^2];
            body weight (y) { mass = 1 [kg]; }
            force grease on y = -1e6 [N*s/m]*der(y);
            start { y = 0; }
        }",
    );
    let exact = 1e-5 * 1e6 / 9.81 + 1e-6;
    for scheme in IMPLICIT {
        struct Passing<'a>(&'a Live);

        impl Visitor for Passing<'_> {
            type Result = f64;

            fn visit<S: AdaptiveScheme>(self) -> f64 {
                let fine = Tolerances { rtol: 1e-8, atol: 1e-14, ..Tolerances::default() };
                let builder = Adaptive::builder(Prepared::new(self.0)).scheme::<S>().tolerances(fine);
                let threshold = Threshold {
                    measured: Measured::Position(0),
                    value: -1e-5,
                    direction: Direction::Falling,
                };
                let run = Sampled::new(builder.build().expect("a start"), 0.1).expect("an interval");
                let mut run = run.watching(threshold);
                let event = (0..20).find_map(|_| run.step_to_event().expect("a regular motion"));
                event.expect("a passage").t
            }
        }

        let found = implicit::with_type(scheme, Passing(&live)).expect("a type");
        println!("{} {:e}", scheme.word, found - exact);
        assert!((found - exact).abs() < 1e-6, "{}: {found}", scheme.word);
    }
}

/// A knot of a law is met by a step that ends right behind it. Regression: steps were halved until one did, and of a touch
/// that begins slowly, or of a pin in the middle of its bore, they became so short that rounding let nothing move.
#[test]
fn knots_of_laws_take_few_steps() {
    let touch = |from: &str| {
        format!(
            "Touch {{ dof = 1; body b (y) {{ mass = 1 [kg]; }} force weight on y = -9.81 [N];
                circle c on b = (0, 0) radius 5 [mm]; line f on ground = (0, 0) along (1, 0);
                contact k (b.c, ground.f) {{ modulus = 1 [GPa]; }} start {{ y = {from}; }} }}"
        )
    };
    let loose = "Loose { dof = 3; gravity = (0, -9.81) [m/s^2];
        body b (x, y, phi) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        circle pin on b = (0, 0.25 [m]) radius 10 [mm]; bore hole on ground = (0, 0) radius 10.2 [mm];
        contact c (b.pin, ground.hole) { stiffness = 1 [MN/m]; }
        start { phi = 0.5; x = 0.25 [m]*sin(0.5); y = -0.25 [m]*cos(0.5); } }";
    let texts = [touch("5.001 [mm]"), touch("5 [mm]"), touch("5.0000001 [mm]"), loose.to_owned()];
    for text in texts {
        let live = compiled(&text);
        let tight = Tolerances { rtol: 1e-11, atol: 1e-14, ..Tolerances::default() };
        let mut exact = Sampled::new(
            Adaptive::builder(Prepared::new(&live)).tolerances(tight).build().expect("a start"),
            2e-3,
        )
        .expect("an interval");
        exact.step().expect("a contact");
        let [expected, _] = state(&exact);
        for scheme in IMPLICIT {
            let mut run = started(scheme, &live, tolerances(1e-6), 2e-3, None).expect("a start");
            run.step().expect("a contact");
            let (effort, [q, _]) = (effort(&*run), state(&*run));
            let off = q.iter().zip(&expected).map(|(q, expected)| (q - expected).abs()).fold(0.0, f64::max);
            let name = scheme.word;
            assert!(effort.steps + effort.rejected < 200, "{name}: {effort:?}\n{text}");
            // in m and rad, of motions of some micrometres
            assert!(off < 1e-8, "{name}: {off:e}\n{text}");
        }
    }
}

/// Far from the origin rounding changes a stiff force more than a short step does, and so it does at a start where stiffness and
/// damping cancel each other. Regression: that was taken for the rate of the force, which seemed to run through knots, and
/// steps became ever shorter.
#[test]
fn rounding_of_a_stiff_force_is_no_rate() {
    for (floor, height, speed) in [(10.0, 5.001e-3, 0.01), (0.0, 5.1e-3, 1.0)] {
        let live = compiled(&format!(
            "Touch {{ dof = 1; body b (y) {{ mass = 1 [kg]; }} force weight on y = -9.81 [N];
                circle c on b = (0, 0) radius 5 [mm]; line f on ground = (0, {floor} [m]) along (1, 0);
                contact k (b.c, ground.f) {{ stiffness = 1 [MN/m]; damping = 100 [N*s/m]; }}
                start {{ y = {height} [m] + {floor} [m]; der(y) = -{speed} [m/s]; }} }}"
        ));
        let explicit = Adaptive::builder(Prepared::new(&live)).tolerances(tolerances(1e-11));
        let mut exact = Sampled::new(explicit.build().expect("a start"), 0.02).expect("an interval");
        exact.step().expect("a contact");
        let [expected, _] = state(&exact);
        for scheme in IMPLICIT {
            let mut run = started(scheme, &live, tolerances(1e-8), 0.02, None).expect("a start");
            run.step().expect("a contact");
            let (effort, [q, _]) = (effort(&*run), state(&*run));
            assert!(effort.steps + effort.rejected < 10_000, "{}: {effort:?}", scheme.word);
            // of motions of up to 20 mm
            let bound = allowed(scheme, &effort) * 1e-8 * 0.02;
            assert!((q[0] - expected[0]).abs() < bound, "{}: {q:?} {expected:?}", scheme.word);
        }
    }
}

/// Tolerances that no run can keep are refused at the start.
#[test]
fn tolerances_are_checked() {
    let live = compiled("S { dof = 1; body m (x) { mass = 1 [kg]; } start { x = 0; } }");
    for (rtol, atol) in [(0.0, 1e-9), (1e-15, 1e-9), (1e-6, 0.0), (f64::NAN, 1e-9)] {
        let given = Tolerances { rtol, atol, ..Tolerances::default() };
        let refused = started(&ESDIRK4, &live, given, 0.1, None).err();
        assert!(matches!(refused, Some(Error::Tolerance { .. })), "{refused:?}");
    }
    let refused = started(&ESDIRK4, &live, Tolerances::default(), 0.0, None).err();
    assert!(matches!(refused, Some(Error::Step { .. })), "{refused:?}");
}
