//! Formulas that choose by a condition: their values, derivatives and motions.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use core::f64::consts::PI;

use mbs_runtime::{
    Adaptive, AdaptiveScheme, Components, Dop853, Dopri5, Dual, Error, Mechanism, Real, Sampled, State,
    System, Tolerances, implicit::Esdirk4, mechanism,
};
use tests::random::Random;

/// All outputs in their order.
fn values(found: &PiecesOutputs<f64>) -> [f64; 11] {
    let PiecesOutputs { root, rate, both, either, neither, mixed, bound, strict, folded, clamped, stepped } =
        *found;
    [root, rate, both, either, neither, mixed, bound, strict, folded, clamped, stepped]
}

mechanism! {
    /// Outputs with all that conditions are made of.
    Pieces {
        dof = 1;
        param gap = 0.3 [m];
        body cart (x) { mass = 1 [kg]; }
        let u = x/gap;
        output root = if x > gap { sqrt(u - 1) } else if x < -gap { ln(-u) } else { 0 };
        output rate [1/s] = der(if x > gap { sqrt(u - 1) } else if x < -gap { ln(-u) } else { 0 });
        output both = if x > 0 [m] && der(x) > 0 [m/s] { 1 } else { 2 };
        output either = if x > 0 [m] || der(x) > 0 [m/s] { 1 } else { 2 };
        output neither = if !(x > 0 [m] || der(x) > 0 [m/s]) { 1 } else { 2 };
        output mixed = if x > 0 [m] || x < 0 [m] && der(x) >= 0 [m/s] { 1 } else { 2 };
        output bound = if x <= gap { 1 } else { 2 } + if x >= gap { 10 } else { 20 };
        output strict = if x < gap { 1 } else { 2 } + if x > gap { 10 } else { 20 };
        output folded = if 1 < 2 { x/gap } else { ln(-1 - x^2/gap^2) };
        output clamped [m] = clamp(x, -gap, 2*gap);
        output stepped = step(u) + ramp(u);
    }
}

fn outputs<T: Real>(x: T, rate: T) -> <Pieces<T> as Mechanism>::Outputs {
    let cart = Pieces::<T>::new(Default::default()).expect("declared parameters");
    let state = State { t: T::from_f64(0.0), q: Components::splat(x), v: Components::splat(rate) };
    let inputs = Default::default();
    let reactions = cart.reactions(&state, &inputs, &Components::splat(T::from_f64(0.0)));
    cart.outputs(&state, &inputs, &reactions)
}

/// Of x and its rate, as Rust says it.
fn expected(x: f64, rate: f64) -> [f64; 11] {
    let u = x / 0.3;
    let root = if x > 0.3 {
        (u - 1.0).sqrt()
    } else if x < -0.3 {
        (-u).ln()
    } else {
        0.0
    };
    let slope = if x > 0.3 {
        0.5 / (u - 1.0).sqrt()
    } else if x < -0.3 {
        1.0 / u
    } else {
        0.0
    };
    let one_or_two = |holds: bool| if holds { 1.0 } else { 2.0 };
    [
        root,
        slope * rate / 0.3,
        one_or_two(x > 0.0 && rate > 0.0),
        one_or_two(x > 0.0 || rate > 0.0),
        one_or_two(!(x > 0.0 || rate > 0.0)),
        one_or_two(x > 0.0 || x < 0.0 && rate >= 0.0),
        one_or_two(x <= 0.3) + if x >= 0.3 { 10.0 } else { 20.0 },
        one_or_two(x < 0.3) + if x > 0.3 { 10.0 } else { 20.0 },
        u,
        x.clamp(-0.3, 0.6),
        if u < 0.0 { 0.0 } else { 1.0 + u },
    ]
}

/// The values are those of Rust's own `if`, at the ends of pieces too. What a condition shuts out has no value
/// there: the root and the logarithm of negative numbers. Derivatives are those of the piece, in `der` and by dual
/// numbers, to roundings of one quotient and one product more.
#[test]
fn conditions_choose_values_and_derivatives() {
    let mut random = Random::new(7);
    let mut places = vec![[0.0, 0.0], [0.3, 1.0], [-0.3, 1.0], [0.3, 0.0], [0.0, -1.0], [0.6, 1.0]];
    places.extend((0..100).map(|_| [random.between(-1.0, 1.0), random.between(-1.0, 1.0)]));
    for [x, rate] in places {
        let found = outputs(x, rate);
        for (at, (found, expected)) in values(&found).into_iter().zip(expected(x, rate)).enumerate() {
            let allowed = 4.0 * f64::EPSILON * expected.abs();
            assert!((found - expected).abs() <= allowed, "output {at} at {x}, {rate}: {found} {expected}");
        }
        let moved = outputs(Dual::<f64, 1>::variable(x, 0), Dual::constant(rate));
        let slope = outputs(x, 1.0).rate;
        let partial = moved.root.partials[0];
        assert!((partial - slope).abs() <= 8.0 * f64::EPSILON * slope.abs(), "{x}: {partial} {slope}");
    }
}

const TIGHT: Tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, max_step: f64::INFINITY, first_step: None };

mechanism! {
    /// A ball between two springs, of which one is four times as stiff.
    Bilinear {
        dof = 1;
        gradients = reverse;
        param soft = 100 [N/m];
        param hard = 400 [N/m];
        body ball (x) { mass = 1 [kg]; }
        force springs on x = if x > 0 [m] { -soft*x } else { -hard*x };
        start { x = 0.1 [m]; }
    }
}

/// Half a period takes π/10 s on the one side and π/20 s on the other.
#[test]
fn a_ball_between_two_springs_keeps_its_period() -> Result<(), Error> {
    let mut run = Adaptive::builder(Bilinear::declared()).tolerances(TIGHT).build()?;
    run.advance_to(20.0 * (PI / 10.0 + PI / 20.0))?;
    let state = run.state();
    assert!((state.q.x - 0.1).abs() < 1e-8 && state.v.x.abs() < 1e-8, "{state:?}");
    Ok(())
}

mechanism! {
    /// A slide that a motor drives there and back, with all of its force: the drive that takes the least time.
    BangBang {
        dof = 1;
        param force = 2 [N];
        param way = 1 [m];
        body slide (x) { mass = 2 [kg]; }
        let switching = der(x)*abs(der(x))/(2 [m/s^2]) + (x - way);
        force motor on x = if x >= way { 0 } else if switching < 0 [m] { force } else { -force };
        start { x = 0 [m]; }
    }
}

/// It accelerates on the first half of its way and brakes on the second one.
#[test]
fn a_bang_bang_drive_switches_half_way() -> Result<(), Error> {
    let mut run = Adaptive::builder(BangBang::declared()).tolerances(TIGHT).build()?;
    run.advance_to(1.0)?;
    let half = run.state();
    assert!((half.q.x - 0.5).abs() < 1e-9 && (half.v.x - 1.0).abs() < 1e-9, "{half:?}");
    Ok(())
}

mechanism! {
    /// Slides that are pushed for a moment each, long after the start.
    Pulses {
        dof = 4;
        param begin = 20 [s];
        param duration = 5 [ms];
        param force = 4 [N];
        body first (x1) { mass = 1 [kg]; }
        body second (x2) { mass = 1 [kg]; }
        body third (x3) { mass = 1 [kg]; }
        body fourth (x4) { mass = 1 [kg]; }
        let late = t - begin;
        force one on x1 = if late > 0 [s] && late < duration { force } else { 0 };
        // a triangle, a cycle of it and a trapezoid
        force two on x2 = force*ramp(1 - abs(2*late/duration - 1));
        table cycle(u) = [(0, 0 [N]), (0.1, 1 [N]), (0.2, 0 [N]), (10, 0 [N])] linear outside periodic;
        force three on x3 = cycle(late/(2*duration));
        force four on x4 = force*clamp(3 - abs(6*late/duration - 3), 0, 1);
        table valve(u) = [(0, 0), (30, 0), (30.01, 1), (30.02, 0)] linear outside hold;
        event opens: valve(t/(1 [s])) = 0.5 rising;
    }
}

/// The speeds that the pulses give, F T, F T/2 and 5/6 F T, of the cycle one a second tenth of its period: steps that
/// have grown to seconds end where a pulse begins. So they do for an event that is over in 20 ms.
#[test]
fn no_pulse_of_time_is_stepped_over() -> Result<(), Error> {
    let mut run = Adaptive::builder(Pulses::declared()).build()?;
    run.advance_to(20.0 + 0.4)?;
    let State { v, .. } = run.state();
    let (impulse, cycles) = (4.0 * 5e-3, 20.4 / 0.1);
    // triangles of 0.2 · 10 ms; at 20.4 s a cycle is over
    let expected = [impulse, impulse / 2.0, cycles * 0.1 * 0.01, 5.0 / 6.0 * impulse];
    for (found, expected) in v.into_array().into_iter().zip(expected) {
        assert!((found - expected).abs() < 1e-12, "{found} {expected}");
    }
    let event = run.advance_to_event(40.0)?.map(|event| event.t);
    assert!(event.is_some_and(|t| (t - 30.005).abs() < 1e-12), "{event:?}");
    Ok(())
}

/// The derivatives by the begin and the end of a push: x = F T (t − b − T/2), whose jumps move with them.
#[test]
fn ends_of_pulses_have_derivatives() -> Result<(), Error> {
    let [begin, duration] = [Dual::<f64, 2>::variable(0.5, 0), Dual::variable(0.25, 1)];
    let parameters = PulsesParameters { begin, duration, force: Dual::constant(4.0) };
    let mut run = Adaptive::builder(Pulses::new(parameters)?).tolerances(TIGHT).build()?;
    run.advance_to(2.0)?;
    let [x, v] = [run.state().q.x1, run.state().v.x1];
    assert!((x.value - 1.0 * (1.5 - 0.125)).abs() < 1e-12 && (v.value - 1.0).abs() < 1e-12);
    // −F T and F (t − b − T), 0 and F
    for (found, expected) in x.partials.into_iter().chain(v.partials).zip([-1.0, 5.0, 0.0, 4.0]) {
        assert!((found - expected).abs() < 1e-11, "{found} {expected}");
    }
    Ok(())
}

mechanism! {
    /// A cart on a spring, which a motor pushes by the sign of what it measures, or smoothly.
    Relay {
        dof = 3;
        const k = 10 [N/m];
        const f = 2 [N];
        body timed (x) { mass = 1 [kg]; }
        body placed (y) { mass = 1 [kg]; }
        body smooth (x = z) { mass = 1 [kg]; }
        param of_time = 0;
        param of_place = 0;
        force on_timed on x = of_time*f*sign(sin(3 [rad/s]*t)) - k*x;
        force on_placed on y = of_place*f*(if y > 0.2 [m] { 1 } else { -1 }) - k*y;
        force on_smooth on z = f*sin(3 [rad/s]*t) - k*z;
        start { y = 1 [m]; z = 1 [m]; x = 1 [m]; }
    }
}

/// The end of a run of 20 s in which a force jumps twenty times, the steps that it took, and those of smooth forces.
fn relay<S: AdaptiveScheme>(of_time: f64, of_place: f64) -> Result<(State<RelayCoordinates>, u64), Error> {
    let parameters = RelayParameters { of_time, of_place };
    let mut run = Adaptive::builder(Relay::new(parameters)?).scheme::<S>().tolerances(TIGHT).build()?;
    run.advance_to(20.0)?;
    Ok((run.state(), run.effort().steps))
}

/// Between its jumps at π/3, 2π/3 … a force of time is constant, and the cart turns about where it rests with the
/// force: x + i v/ω. A force of place has the potential −f |y − 0.2|. Both take less than three times the steps of
/// the smooth motion.
#[test]
fn jumps_cost_few_steps() -> Result<(), Error> {
    let w = 10.0_f64.sqrt();
    let (mut x, mut v, mut t, mut rest) = (1.0_f64, 0.0_f64, 0.0_f64, 0.2);
    while t < 20.0 {
        let next = (((t * 3.0 / PI).round() + 1.0) * PI / 3.0).min(20.0);
        let (sine, cosine) = (w * (next - t)).sin_cos();
        let (from, speed) = (x - rest, v / w);
        (x, v) = (rest + cosine * from + sine * speed, w * (cosine * speed - sine * from));
        (t, rest) = (next, -rest);
    }
    let energy = |y: f64, v: f64| v * v / 2.0 + 5.0 * y * y - 2.0 * (y - 0.2).abs();
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-8, "{found} {expected}");
    let check = |[smooth, timed, placed]: [(State<RelayCoordinates>, u64); 3]| {
        near(timed.0.q.x, x);
        near(timed.0.v.x, v);
        near(energy(placed.0.q.y, placed.0.v.y), energy(1.0, 0.0));
        assert!(timed.1.max(placed.1) < 3 * smooth.1, "{} {} {}", timed.1, placed.1, smooth.1);
    };
    check([relay::<Dopri5>(0.0, 0.0)?, relay::<Dopri5>(1.0, 0.0)?, relay::<Dopri5>(0.0, 1.0)?]);
    check([relay::<Dop853>(0.0, 0.0)?, relay::<Dop853>(1.0, 0.0)?, relay::<Dop853>(0.0, 1.0)?]);
    Ok(())
}

mechanism! {
    /// Dry friction by the sign of the velocity, and a push.
    Dry {
        dof = 1;
        param push = 0.5 [N];
        body sled (x) { mass = 1 [kg]; }
        force ground on x = push - 2 [N]*sign(der(x));
        start { der(x) = 1 [m/s]; }
    }
}

/// Regression: at its rest after 1/(2 − push) s the run took steps of 10⁻⁸ s without end. A push that is stronger than
/// the friction turns the sled around, and the run goes on.
#[test]
fn a_jump_that_holds_is_named() -> Result<(), Error> {
    let run = |push: f64| -> Result<f64, Error> {
        let mut run = Adaptive::builder(Dry::new(DryParameters { push })?).build()?;
        run.advance_to(2.0)?;
        Ok(run.state().v.x)
    };
    for push in [0.5, -0.5, 0.0] {
        let error = run(push).expect_err("it rests");
        let Error::Sliding { t, name } = error else { panic!("{error}") };
        assert!((t - 1.0 / (2.0 - push)).abs() < 1e-4 && name == "der(x)", "{push}: {error}");
    }
    // −5 m/s² for 0.2 s, then −1 m/s²
    assert!((run(-3.0)? - -1.8).abs() < 1e-6);
    Ok(())
}

mechanism! {
    /// A brake of 40 mm on a long way, and pushes by a smooth table of time.
    Zone {
        dof = 2;
        body cart (x) { mass = 1 [kg]; }
        force brake on x = if x > 0.68 [m] && x < 0.72 [m] { -40 [N] } else { 0 };
        body sled (y) { mass = 1 [kg]; }
        table bump(u) = [(0 [s], 0 [N]), (0.7 [s], 0 [N]), (0.701 [s], 4 [N]), (0.702 [s], 0 [N]), (1 [s], 0 [N])]
            monotone outside hold;
        force push on y = bump(t);
        start { der(x) = 2 [m/s]; }
    }
}

/// No stage of a long step meets a short zone, or a bump of a smooth table. The run meets both. The bump is made of two
/// cubics with flat ends, so that its impulse is half of its width times its height.
#[test]
fn no_zone_is_stepped_over() -> Result<(), Error> {
    fn speeds<S: AdaptiveScheme>() -> Result<[f64; 2], Error> {
        let builder =
            Adaptive::builder(Zone::declared()).scheme::<S>().tolerances(Tolerances::relative(1e-9));
        let mut run = builder.build()?;
        run.advance_to(1.0)?;
        let v = run.state().v;
        Ok([v.x, v.y])
    }
    for [x, y] in [speeds::<Dopri5>()?, speeds::<Dop853>()?, speeds::<Esdirk4>()?] {
        assert!((x - 0.8_f64.sqrt()).abs() < 1e-7, "{x}");
        assert!((y - 4e-3).abs() < 1e-9, "{y}");
    }
    Ok(())
}

mechanism! {
    /// Pushes of 0.1 ms whose delays are known when the run has begun.
    Delayed {
        dof = 3;
        input delay [s] = 0.6;
        memory begin [s] = 0;
        every 10 [s] { set begin = 0.3 [s]; }
        table pulse(u) = [(0 [s], 0 [N]), (0.1 [s], 100 [N]), (0.1001 [s], 0 [N])] step outside hold;
        body first (x1) { mass = 1 [kg]; }
        body second (x2) { mass = 1 [kg]; }
        body third (x3) { mass = 1 [kg]; }
        force of_memory on x1 = pulse(t - begin);
        force of_input on x2 = if t > delay && t < delay + 0.1 [ms] { 100 [N] } else { 0 };
        force of_both on x3 = pulse(max(t - delay, begin - t));
    }
}

/// A delay that is an input or a memory is known until it is set again. Each push gives F T = 0.01 m/s,
/// and the last one two: both before and behind the delays.
#[test]
fn no_pulse_behind_a_delay_is_stepped_over() -> Result<(), Error> {
    let mut run = Adaptive::builder(Delayed::declared()).tolerances(Tolerances::relative(1e-6)).build()?;
    run.advance_to(0.65)?;
    let State { v, .. } = run.state();
    for (found, expected) in v.into_array().into_iter().zip([0.01, 0.01, 0.01]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    let count = run.effort().steps;
    assert!(count < 60, "{count} steps");
    // the input is set anew: its push comes again
    run.inputs_mut().delay = 0.8;
    run.advance_to(1.0)?;
    let State { v, .. } = run.state();
    for (found, expected) in v.into_array().into_iter().zip([0.01, 0.02, 0.02]) {
        assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    }
    Ok(())
}

mechanism! {
    /// A cart far from the origin that a motor pulls from a moment on.
    Pulled {
        dof = 1;
        param begin = 0.3 [s];
        body cart (x) { mass = 2 [kg]; }
        force motor on x = if t > begin { 1 [N] } else { 0 };
        event faster: der(x) = 1.2 [m/s] rising;
        event slower: der(x) = 0.8 [m/s] falling;
        start { x = 10 [m]; der(x) = 1 [m/s]; }
    }
}

/// The step over a corner is as short as rounding: the roundings of a position over it were velocities, of -0.48 m/s for
/// 1 m/s, in rows at that time, and events that never were.
#[test]
fn velocities_at_a_corner_are_those_of_the_motion() -> Result<(), Error> {
    for begin in [0.1, 0.2, 0.3, 0.4, 0.5, 0.7] {
        let pulled = Pulled::new(PulledParameters { begin })?;
        let run = Adaptive::builder(pulled).tolerances(Tolerances::relative(1e-8)).build()?;
        let mut rows = Sampled::new(run, 0.05)?;
        for row in 1..=13 {
            while let Some(event) = rows.step_to_event()? {
                // the one that there is: 1.2 m/s
                assert!((event.t - begin - 0.4).abs() < 1e-9 && event.index == 0, "{begin}: {event:?}");
            }
            let t = f64::from(row) * 0.05;
            let (mut q, mut v) = ([0.0], [0.0]);
            rows.state(&mut q, &mut v);
            let expected = 1.0 + 0.5 * (t - begin).max(0.0);
            assert!((v[0] - expected).abs() < 1e-9, "{begin}: {v:?} for {expected} at {t}");
        }
    }
    Ok(())
}

mechanism! {
    /// A push over a way of 0.1 mm, beside a clock of 1 ms that sets nothing new.
    Ticking {
        dof = 2;
        param place = 0.7004 [m];
        memory nothing [1] = 0;
        every 1 [ms] { set nothing = 0; }
        body feeler (y) { mass = 1 [kg]; }
        body cart (x) { mass = 1 [kg]; }
        force kick on x = 100 [N]*min(step(y - place), step(place + 0.1 [mm] - y));
        start { der(y) = 1 [m/s]; }
    }
}

/// A sample begins a step anew, and that step knows on which pieces it begins. The zone lies within a tick, so that the
/// cart, which has F T = 0.01 m/s of it, had nothing.
#[test]
fn no_zone_behind_a_sample_is_stepped_over() -> Result<(), Error> {
    fn speed<S: AdaptiveScheme>() -> Result<f64, Error> {
        let builder = Adaptive::builder(Ticking::declared()).scheme::<S>();
        let mut run = builder.tolerances(Tolerances::relative(1e-7)).build()?;
        run.advance_to(1.0)?;
        Ok(run.state().v.x)
    }
    for v in [speed::<Dopri5>()?, speed::<Dop853>()?] {
        assert!((v - 0.01).abs() < 1e-7, "{v}");
    }
    Ok(())
}
