//! A type that is compiled with derivatives can be fitted by a program's own command, and another is refused
//! with what to do.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use mbs_analysis::Experiment;
use mbs_workbench::{Model, Settings, model};

mbs_runtime::mechanism! {
    /// A weight on a massless rod.
    pub Pendulum {
        dof = 1;
        param length = 1 [m] where length > 0;
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        start { x = length; guess y = 0; }
        output pull [N] = 2*length*lambda(rod);
    }
}

/// The start moves with the length, and its derivative with the start.
#[test]
fn the_length_of_a_pendulum_is_found_from_the_pull_of_its_rod() {
    let settings = Settings { end: 0.6, every: 50, ..Settings::default() };
    let parameters = vec![("length".to_owned(), 0.7)];
    let swing = model::differentiated::<Pendulum>(Settings::default());
    let recording = swing.simulate(&Settings { parameters, ..settings }, &mut |_, _| ()).unwrap();
    let values = |name: &str| &recording.column(name).unwrap().values;
    let fit = Experiment::of(swing.info())
        .measured("pull", values("t"), values("pull"))
        .unknown("length", 2.0)
        .fit(&*swing.trials().unwrap())
        .unwrap();
    // the recording is one of Heun's method
    assert!((fit.estimates[0].value - 0.7).abs() < 1e-5, "{fit:?}");
    let plain: Box<dyn Model> = model::of::<Pendulum>();
    assert!(plain.trials().is_none());
}
