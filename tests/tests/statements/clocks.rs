//! Clocks and memories: the closed form of a sampled loop, the same bits on all ways of a step, the order of what is
//! set, and runs that go on. References of their own have `models/tests/references/sampled.rs`.
#![allow(clippy::panic, reason = "a test says by panicking what is wrong")]

use mbs_live::Text;
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{
    Adaptive, Dop853, Dual, Error, Mechanism, Pack, Rk4, Sampled, Simulation, System, Tolerances, TrBdf2,
    mechanism,
};

/// A declaration as a type and as a text.
macro_rules! both {
    ($text:ident = $($declaration:tt)*) => {
        mechanism! { $($declaration)* }

        const $text: &str = stringify!($($declaration)*);
    };
}

both! { MOTOR =
    /// A motor with inductance, whose speed a sampled controller keeps.
    Motor {
        dof = 1;
        method = rk4;
        param resistance = 1 [ohm];
        param inductance = 0.5 [mH];
        param constant = 0.05 [N*m/A];
        param inertia = 1e-4 [kg*m^2];
        param stiff = 0.1 [V*s];
        param summed = 5 [V];
        param period = 1 [ms] where period > 0;
        input target [rad/s] = 100;
        memory integral [rad] = 0;
        memory volts [V] = 0;
        state current [A] = 0;
        der(current) = (volts - resistance*current - constant*der(theta))/inductance;
        body rotor (theta) { inertia = inertia; }
        torque drive on rotor = constant*current;
        let off = target - der(theta);
        every period {
            set integral = integral + off*period;
            set volts = stiff*off + summed*integral;
        }
        output applied [V] = volts;
    }
}

both! { RATES =
    /// Two clocks, one of which begins later; a count of the samples, and what each saw of the other.
    Rates {
        dof = 1;
        body slide (x) { mass = 1 [kg]; }
        memory fast [1] = 0;
        memory slow [1] = 0;
        memory seen [1] = 0;
        memory twice [1] = 0;
        every 3 [ms] offset 1 [ms] { set fast = fast + 1; set twice = 2*fast; }
        every 5 [ms] { set seen = fast; set slow = slow + 1; set slow = slow + 1; }
        force push on x = 1 [N]*(fast - slow);
        event third: fast = 2.5 rising;
        event behind: x = 1 [mm] rising;
        start { der(x) = 0.1 [m/s]; }
        output counted = fast;
        output counted_slowly = slow;
        output last = seen;
        output doubled = twice;
    }
}

const H: f64 = 1e-4;

/// exp(A t) of speed and current without voltage, and what a held volt adds: by the series on a thousandth of the
/// time, doubled ten times.
fn plant(t: f64) -> ([[f64; 2]; 2], [f64; 2]) {
    let a = [[0.0, 0.05 / 1e-4, 0.0], [-0.05 / 0.5e-3, -1.0 / 0.5e-3, 1.0 / 0.5e-3], [0.0; 3]];
    let product = |x: &[[f64; 3]; 3], y: &[[f64; 3]; 3]| {
        std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| x[i][k] * y[k][j]).sum()))
    };
    let part = t / 1024.0;
    let mut power = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mut sum = power;
    for k in 1..12 {
        let next: [[f64; 3]; 3] = product(&power, &a);
        power = next.map(|row| row.map(|entry| entry * part / f64::from(k)));
        sum = std::array::from_fn(|i| std::array::from_fn(|j| sum[i][j] + power[i][j]));
    }
    for _ in 0..10 {
        sum = product(&sum, &sum);
    }
    ([[sum[0][0], sum[0][1]], [sum[1][0], sum[1][1]]], [sum[0][2], sum[1][2]])
}

/// In the z domain: x(k+1) = exp(A T) x(k) + b u(k), with u of the controller, to 1e-12 of 100 rad/s and 12 V.
#[test]
fn a_sampled_loop_has_its_closed_form_at_every_sample() -> Result<(), Error> {
    let (a, b) = plant(1e-3);
    let tolerances = Tolerances { rtol: 1e-13, atol: 1e-14, ..Tolerances::default() };
    let mut run = Adaptive::builder(Motor::declared()).scheme::<Dop853>().tolerances(tolerances).build()?;
    let (mut speed, mut current, mut integral) = (0.0, 0.0, 0.0);
    for sample in 0..200 {
        run.advance_to(1e-3 * f64::from(sample))?;
        let off = 100.0 - speed;
        integral += off * 1e-3;
        let volts = 0.1 * off + 5.0 * integral;
        let now = run.state().v;
        assert!((now.theta - speed).abs() < 1e-10, "{sample}: {} rad/s against {speed}", now.theta);
        assert!((now.current - current).abs() < 1e-11, "{sample}: {} A against {current}", now.current);
        let inputs = run.inputs();
        assert!((inputs.volts - volts).abs() < 1e-11, "{sample}: {} V against {volts}", inputs.volts);
        assert!((inputs.integral - integral).abs() < 1e-12, "{sample}");
        (speed, current) = (
            a[0][0] * speed + a[0][1] * current + b[0] * volts,
            a[1][0] * speed + a[1][1] * current + b[1] * volts,
        );
    }
    // every sample costs some steps
    assert!(run.effort().steps < 200 * 40, "{:?}", run.effort());
    Ok(())
}

fn told(run: &dyn System) -> Vec<f64> {
    let info = run.equations().info();
    let n = info.coordinates.len();
    let (mut q, mut v, mut inputs) = (vec![0.0; n], vec![0.0; n], vec![0.0; info.inputs.len()]);
    run.state(&mut q, &mut v);
    run.inputs(&mut inputs);
    [q, v, inputs].concat()
}

#[test]
fn stages_lanes_and_texts_compute_the_same_bits() -> Result<(), Box<dyn std::error::Error>> {
    fn same<M: Mechanism<Real = f64>>(
        mechanism: M,
        text: &str,
        h: f64,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let live = Text::declaration("sampled.mbs", text).compile()?;
        let start = Simulation::new(mechanism, h)?;
        let (mut fused, mut staged, mut pack, mut strides) =
            (start, start, Pack::new([start; 4]), Pack::new([start; 3]));
        let mut of_text = mbs_live::Run::builder(&live, h).build()?;
        let mut together =
            mbs_live::Pack::new(vec![of_text.clone(), of_text.clone()]).map_err(|_| "alike")?;
        for _ in 0..300 {
            fused.step()?;
            staged.step_in_stages()?;
            assert_eq!(pack.step(), [true; 4]);
            of_text.step()?;
            assert!(together.step().is_empty());
        }
        assert_eq!(strides.advance(300), 300);
        let expected = told(&fused);
        assert_eq!(told(&staged), expected, "in stages");
        assert_eq!(told(&pack.simulation(3)), expected, "in lanes");
        assert_eq!(told(&strides.simulation(1)), expected, "in lanes, many steps at once");
        assert_eq!(told(&of_text), expected, "the text");
        let runs = together.into_runs();
        assert_eq!(told(&runs[1]), expected, "texts in lanes");
        Ok(())
    }
    same(Motor::declared(), MOTOR, H)?;
    same(Rates::declared(), RATES, 1e-3)
}

/// Sample k of a clock is at offset + k period; at 30 ms, that of 10 samples of one and of 7 of the other.
#[test]
fn clocks_count_their_samples() -> Result<(), Error> {
    let mut run = Simulation::new(Rates::declared(), 1e-3)?;
    // at 0 s the slow one samples, the fast one at 1 ms
    assert_eq!((run.outputs()?.counted, run.outputs()?.counted_slowly), (0.0, 2.0));
    run.step()?;
    assert_eq!((run.outputs()?.counted, run.outputs()?.doubled), (1.0, 2.0));
    run.advance_to(0.010)?;
    // 1, 4, 7, 10 ms, and 0, 5, 10 ms: at 10 ms the fast one is the first of both
    let now = run.outputs()?;
    assert_eq!((now.counted, now.counted_slowly, now.last), (4.0, 6.0, 4.0));
    let tolerances = Tolerances::default();
    let mut exact = Adaptive::builder(Rates::declared()).tolerances(tolerances).build()?;
    exact.advance_to(0.0304)?;
    run.advance_to(0.0304)?;
    let found = exact.inputs();
    assert_eq!((found.fast, found.slow, found.seen), (10.0, 14.0, 10.0));
    assert_eq!(run.inputs(), found);
    Ok(())
}

mechanism! {
    /// Offsets of more than a period and before 0, which are those within one.
    Shifted {
        dof = 0;
        param early = -0.7 [s];
        state clock [s] = 0;
        der(clock) = 1;
        memory first [s] = -1;
        memory second [s] = -1;
        memory third [s] = -1;
        memory late [1] = 0;
        memory count [1] = 0;
        every 100 [ms] { set first = clock; set count = count + 1; }
        every 100 [ms] offset 300 [ms] { set second = first; }
        every 100 [ms] offset early { set third = second; set late = late + (if clock - third > 1 [ms] { 1 } else { 0 }); }
    }
}

/// All three clocks sample at once, in their order: 0.3 and 0.7 are no multiples of 0.1 but for rounding.
#[test]
fn offsets_of_more_than_a_period_are_those_within_one() -> Result<(), Error> {
    let mut steps = Simulation::new(Shifted::declared(), 1e-2)?;
    let mut exact = Adaptive::builder(Shifted::declared()).build()?;
    for _ in 0..30 {
        let end = steps.time() + 0.1;
        steps.advance_to(end)?;
        exact.advance_to(steps.time())?;
        for inputs in [steps.inputs(), exact.inputs()] {
            assert_eq!((inputs.late, inputs.count), (0.0, (10.0 * end).round() + 1.0), "{end} s");
            assert!((inputs.third - end).abs() < 1e-9, "{end} s: {inputs:?}");
        }
    }
    assert!(exact.effort().steps < 50, "{:?}", exact.effort());
    Ok(())
}

/// A sample that no step meets is refused where it is an offset, too, and where the start is beside it.
#[test]
fn steps_lead_to_offsets() -> Result<(), Error> {
    let shifted = |early: f64| Shifted::new(ShiftedParameters { early });
    assert!(Simulation::new(shifted(-0.65)?, 1e-2).is_ok());
    let refused = Simulation::new(shifted(0.123)?, 1e-2).err();
    let Some(Error::Period { memory, better, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!(memory, "third");
    assert!((better - 1e-3).abs() < 1e-15, "{better}");
    let mut start = Simulation::new(shifted(0.0)?, 1e-2)?.state();
    start.t = 0.004;
    let beside = Simulation::builder(shifted(0.0)?, 1e-2).from_state(start).build().err();
    assert!(beside.is_some_and(|error| error.to_string().contains("from the start at 0.004 s")));
    Ok(())
}

/// The third sample of the fast clock, at 7 ms, takes its count over 2.5; x, which moves, passes its event by itself.
#[test]
fn a_sample_is_an_event_where_it_changes_a_sign() -> Result<(), Error> {
    let builder = || Adaptive::builder(Rates::declared());
    let mut run = builder().build()?;
    let mut found = Vec::new();
    while let Some(event) = run.advance_to_event(0.02)? {
        assert_eq!(event.index == 0, run.inputs().fast == 3.0);
        found.push(event);
    }
    let by_index = |index| found.iter().filter(move |event| event.index == index).collect::<Vec<_>>();
    let (third, behind) = (by_index(0), by_index(1));
    assert!(third.len() == 1 && third[0].is_rising && (third[0].t - 7e-3).abs() < 1e-15, "{found:?}");
    assert_eq!(behind.len(), 1, "{found:?}");
    // looked at every 7 ms, and every millisecond
    for interval in [7e-3, 1e-3] {
        let mut seen = Sampled::new(builder().build()?, interval)?;
        let mut told = Vec::new();
        while seen.time() < 0.02 {
            told.extend(seen.step_to_event()?);
        }
        assert_eq!(told.iter().filter(|event| event.index == 0).copied().collect::<Vec<_>>(), [*third[0]]);
    }
    Ok(())
}

/// A run that is cloned, and one that begins where another is, go on to the same bits and take no sample twice.
#[test]
fn runs_go_on() -> Result<(), Box<dyn std::error::Error>> {
    let live = Text::declaration("sampled.mbs", MOTOR).compile()?;
    let mut run = mbs_live::Run::builder(&live, H).build()?;
    run.advance(40)?;
    let (mut q, mut v) = ([0.0; 2], [0.0; 2]);
    run.state(&mut q, &mut v);
    let mut inputs = [0.0; 3];
    run.inputs(&mut inputs);
    let at = mbs_runtime::equations::At { t: 0.0, q: &q, v: &v };
    let mut other =
        mbs_live::Run::builder(&live, H).inputs(&inputs).from_state(at).steps_taken(40).build()?;
    let mut copy = run.clone();
    run.advance(100)?;
    other.advance(100)?;
    copy.advance(100)?;
    assert_eq!(told(&other), told(&run));
    assert_eq!(told(&copy), told(&run));
    Ok(())
}

/// Looked at between samples, what is seen has the memories of that time; at a sample those from then on.
#[test]
fn what_is_seen_between_samples_has_their_memories() -> Result<(), Error> {
    let builder = || Adaptive::builder(Motor::declared());
    let mut seen = Sampled::new(builder().build()?, 2.5e-4)?;
    let mut constant =
        Simulation::builder(Motor::declared(), 2.5e-5).method::<mbs_runtime::Held<Rk4>>().build()?;
    for _ in 0..40 {
        seen.step()?;
        for _ in 0..10 {
            constant.step()?;
        }
        let mut inputs = [0.0; 3];
        System::inputs(&seen, &mut inputs);
        assert!((inputs[2] - constant.inputs().volts).abs() < 1e-3, "{} s: {inputs:?}", seen.time());
    }
    Ok(())
}

/// A program sets inputs, and no memories; a clock acts on what it has set.
#[test]
fn programs_set_inputs_and_clocks_memories() -> Result<(), Error> {
    let mut run = Simulation::new(Motor::declared(), H)?;
    System::set_inputs(&mut run, &[50.0, 7.0, 9.0]);
    assert_eq!(*run.inputs(), MotorInputs { target: 50.0, integral: 0.1, volts: 10.5 });
    run.advance_to(1e-3)?;
    assert!(run.inputs().volts < 6.0);
    Ok(())
}

/// Through 20 samples, by parameters of plant and controller: against differences.
#[test]
fn gradients_go_through_samples() -> Result<(), Error> {
    let variables =
        [Variable::Parameter("constant"), Variable::Parameter("summed"), Variable::Parameter("stiff")];
    let mut gradient = [0.0; 3];
    let mut taken = 0;
    Simulation::builder(Motor::declared(), H).gradient(
        &Sum::new(200, &variables),
        |run: &Simulation<Motor<Dual<f64, 3>>>| {
            taken += 1;
            Ok(if taken > 200 { run.state().v.theta } else { Dual::constant(0.0) })
        },
        &mut gradient,
    )?;
    let end = |change: [f64; 3]| -> Result<f64, Error> {
        let mut p = MotorParameters::<f64>::default();
        p.constant += change[0];
        p.summed += change[1];
        p.stiff += change[2];
        let mut run = Simulation::new(Motor::new(p)?, H)?;
        run.advance(200)?;
        Ok(run.state().v.theta)
    };
    for (at, size) in [1e-6, 1e-4, 1e-6].into_iter().enumerate() {
        let moved = |sign: f64| end(std::array::from_fn(|j| if j == at { sign * size } else { 0.0 }));
        let difference = (moved(1.0)? - moved(-1.0)?) / (2.0 * size);
        let found = gradient[at];
        assert!((found - difference).abs() < 1e-6 * difference.abs(), "{at}: {found} against {difference}");
    }
    Ok(())
}

/// A memory that becomes no number names itself.
#[test]
fn a_memory_that_is_no_number_is_named() -> Result<(), Error> {
    mechanism! {
        Broken {
            dof = 1;
            memory push [N] = 0;
            every 10 [ms] { set push = 1 [N*m]/(0.01 [m] - x); }
            body slide (x) { mass = 1 [kg]; }
            force pushed on x = push;
            start { x = 0; der(x) = 1 [m/s]; }
        }
    }
    let exact = Broken::declared();
    let mut run = Simulation::builder(exact, 1e-2).build()?;
    run.inputs_mut().push = f64::NAN;
    let refused = run.step();
    assert_eq!(refused.map_err(|error| error.to_string().contains("memory `push`")), Err(true));
    Ok(())
}

#[test]
fn stiff_methods_sample() -> Result<(), Error> {
    let mut stiff = TrBdf2::builder(Motor::declared(), 1e-5).build()?;
    let mut run = Simulation::new(Motor::declared(), 1e-5)?;
    stiff.advance_to(0.02)?;
    run.advance_to(0.02)?;
    let [found, expected] = [stiff.state().v.theta, run.state().v.theta];
    assert!((found - expected).abs() < 1e-4 * expected, "{found} against {expected}");
    Ok(())
}
