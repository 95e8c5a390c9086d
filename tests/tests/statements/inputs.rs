//! Inputs begin at their declared values: types, steps of all kinds, other scalars, lanes.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_analysis::{Search, equilibrium};
use mbs_ensemble::Ensemble;
use mbs_runtime::{
    Adaptive, Dopri5, Error, Mechanism, RATTLE, Rattle, Simulation, System, Tolerances, TrBdf2, mechanism,
};

mechanism! {
    /// A block on a spring, which its input holds at 0.1 m.
    Block {
        dof = 1;
        const half = 0.5;
        param stiffness = 200 [N/m];
        input wind [N];
        input push [kN] = 2*half*20 [N];
        body block (x) { mass = 2 [kg]; }
        force spring on x = push + wind - stiffness*x;
        start { x = 0.1 [m]; }
        output acting [N] = push;
    }
}

mechanism! {
    /// The same with a value that is not declared.
    Plain {
        dof = 1;
        param stiffness = 200 [N/m];
        input wind [N];
        input push [kN];
        body block (x) { mass = 2 [kg]; }
        force spring on x = push + wind - stiffness*x;
        start { x = 0.1 [m]; }
    }
}

#[test]
fn types_know_the_declared_values() {
    assert_eq!(BlockInputs::default(), BlockInputs { wind: 0.0, push: 20.0 });
    assert_eq!(BlockInputs::<f32>::default().push, 20.0);
    assert_eq!(
        <Block as Mechanism>::INFO.inputs.iter().map(|it| it.default).collect::<Vec<_>>(),
        [0.0, 20.0]
    );
    assert_eq!(PlainInputs::default(), PlainInputs { wind: 0.0, push: 0.0 });
    // a value costs no operation
    assert_eq!(Block::<f64>::OPERATIONS, Plain::<f64>::OPERATIONS);
}

/// The block rests where the input holds it, whatever takes the steps.
#[test]
fn all_runs_begin_with_them() -> Result<(), Error> {
    let mut steps = Simulation::new(Block::declared(), 1e-3)?;
    steps.advance(100)?;
    assert_eq!((steps.state().q.x, steps.inputs().push, steps.outputs()?.acting), (0.1, 20.0, 20.0));
    let single = Simulation::new(Block::<f32>::default(), 1e-3)?;
    assert_eq!(single.inputs().push, 20.0);
    let adaptive = Adaptive::builder(Block::declared()).scheme::<Dopri5>().tolerances(Tolerances::default());
    let mut adaptive = adaptive.build()?;
    adaptive.advance_to(0.1)?;
    assert!((adaptive.state().q.x - 0.1).abs() < 1e-15);
    let mut rattle = Rattle::builder(Block::declared(), 1e-3).composition(&RATTLE).build()?;
    rattle.advance(100)?;
    let mut stiff = TrBdf2::builder(Block::declared(), 1e-3).build()?;
    stiff.advance(100)?;
    assert!((rattle.state().q.x - 0.1).abs() < 1e-15 && (stiff.state().q.x - 0.1).abs() < 1e-15);
    let rest = equilibrium(&Block::declared(), &Search::default()).expect("an equilibrium");
    assert!((rest.q[0] - 0.1).abs() < 1e-12 && rest.inputs == [0.0, 20.0]);
    Ok(())
}

#[test]
fn lanes_begin_with_them() -> Result<(), Error> {
    let stiffer = |at: usize| {
        let stiffness = 200.0 + at as f64;
        Simulation::new(Block::new(BlockParameters { stiffness })?, 1e-3)
    };
    let together = Ensemble::new(0.1).run(11, stiffer, &()).unwrap_or_default();
    assert_eq!(together.len(), 11);
    for (at, together) in together.into_iter().enumerate() {
        let mut alone = stiffer(at)?;
        alone.advance_to(0.1)?;
        assert_eq!(alone.state(), together?.state, "{at}");
        // 20 N hold the first one alone
        assert_eq!(alone.state().q.x == 0.1, at == 0, "{at}");
    }
    Ok(())
}
