//! A run behind [`System`] is the simulation it is made of, to the bit.

use mbs_runtime::equations::At;
use mbs_runtime::{
    Adaptive, Components, Error, Held, Method, PerStage, Sampled, Simulation, System, Tolerances, mechanism,
};

mechanism! {
    /// A cart with a pole, pushed.
    Cart {
        dof = 2;
        param length = 0.5 [m];
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = 1 [kg]; }
        body bob (x = u, y = w) { mass = 0.2 [kg]; }
        constraint pole: (u - x)^2 + w^2 = length^2;
        force f on cart = (push, 0);
        start { x = 0; u = 0.3 [m]; guess w = 0.4 [m]; }
        output tension [N] = lambda(pole)*length;
        output reserve [m] = length*ln(1 - x/(20 [mm]));
    }
}

fn run<X: Method>() -> Result<Simulation<Cart, X>, Error> {
    let gains = mbs_runtime::Baumgarte::<X>::deadbeat(1e-3);
    Simulation::builder(Cart::declared(), 1e-3).baumgarte(gains).build()
}

fn same_bits<X: Method>() -> Result<(), Error> {
    let mut run = run::<X>()?;
    let mut system: Box<dyn System> = Box::new(run);
    let (mut q, mut v, mut a, mut lambda) = ([0.0; 3], [0.0; 3], [0.0; 3], [0.0; 1]);
    for step in 0..200 {
        let push = if step < 100 { 1.0 } else { -2.0 };
        run.inputs_mut().push = push;
        system.set_inputs(&[push]);
        if step % 2 == 0 {
            run.step()?
        } else {
            run.step_in_stages()?
        }
        system.step()?;
        system.state(&mut q, &mut v);
        assert_eq!((q, v), (run.state().q.into_array(), run.state().v.into_array()));
        system.reactions(&mut a, &mut lambda)?;
        let reactions = run.reactions()?;
        assert_eq!((a, lambda), (reactions.acceleration.into_array(), reactions.multipliers.into_array()));
        assert_eq!(system.violations(), [run.violation(), run.velocity_violation()]);
        let [kinetic, potential] = system.energies(At { t: system.time(), q: &q, v: &v });
        assert_eq!(kinetic + potential, run.energy());
        assert_eq!((system.time(), system.steps()), (run.time(), run.steps()));
    }
    let mut numbers = ([0.0], [0.0], [0.0; 2 * 2]);
    system.parameters(&mut numbers.0);
    system.inputs(&mut numbers.1);
    assert_eq!((numbers.0, numbers.1), ([0.5], [-2.0]));
    assert_eq!(system.steps_to(0.3), Ok(100));
    assert_eq!(system.worst_growth(), run.worst_growth());
    Ok(())
}

#[test]
fn it_is_the_simulation() -> Result<(), Error> {
    same_bits::<Held>()?;
    same_bits::<PerStage>()
}

/// The output ends where the cart has moved by 20 mm: after √(2 · 0.02 m/a), whatever a is.
#[test]
fn what_is_not_finite_is_an_error_and_written_all_the_same() -> Result<(), Error> {
    let mut system: Box<dyn System> = Box::new(run::<Held>()?);
    let (mut a, mut lambda, mut outputs) = ([0.0; 3], [0.0], [0.0; 2]);
    system.set_inputs(&[20.0]);
    system.reactions(&mut a, &mut lambda)?;
    system.outputs(&a, &lambda, &mut outputs)?;
    assert_eq!(outputs, [lambda[0] * 0.5, 0.0]);
    system.advance(1000)?;
    system.reactions(&mut a, &mut lambda)?;
    let ended = system.outputs(&a, &lambda, &mut outputs);
    assert!(matches!(ended, Err(Error::Undefined { name: "reserve", .. })), "{ended:?}");
    assert!(outputs[0] == lambda[0] * 0.5 && f64::is_nan(outputs[1]));
    Ok(())
}

/// Samples at uneven times are those of the motion, and the steps between them are counted from where the
/// interval was set.
#[test]
fn samples_may_be_at_any_times() -> Result<(), Error> {
    let tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() };
    let start = || Adaptive::builder(Cart::declared()).tolerances(tolerances).build();
    let mut samples = Sampled::new(start()?, 0.1)?;
    let mut run = start()?;
    for t in [0.05, 0.3, 0.31, 1.0] {
        samples.set_interval(t - samples.time())?;
        samples.step()?;
        run.advance_to(t)?;
        let (mut q, mut v) = ([0.0; 3], [0.0; 3]);
        samples.state(&mut q, &mut v);
        let expected = run.state().q.into_array();
        assert!((samples.time() - t).abs() < 1e-15);
        assert!(
            q.iter().zip(expected).all(|(q, expected)| (q - expected).abs() < 1e-8),
            "{q:?} {expected:?}"
        );
        assert_eq!(samples.steps_to(t + 3.0 * samples.step_size())?, 3);
    }
    assert_eq!((samples.steps(), samples.run().effort().rejected), (4, run.effort().rejected));
    assert!(matches!(samples.set_interval(0.0), Err(Error::Step { .. })));
    Ok(())
}
