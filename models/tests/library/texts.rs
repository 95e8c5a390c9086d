//! A mechanism of the library, compiled by rustc and run from its text.

use mbs_runtime::{DOPRI5, Mechanism, RK4, Stabilization, Tableau, Tolerances};
use mbs_workbench::{Settings, model};

/// Info, equations, sketch, start and 1,000 steps are the same, with held feedback, with
/// feedback in each stage, with projection and with other schemes, and to a tolerance.
pub fn same<M: Mechanism<Real = f64>>(name: &str) {
    let entry = mbs::library().iter().find(|entry| entry.mechanism == Some(name)).unwrap();
    let text = model::from_text(&entry.text(), entry.defaults()).unwrap_or_else(|error| panic!("{error}"));
    let typed = model::with::<M>(entry.defaults());
    assert_eq!(text.info(), typed.info());
    assert_eq!(text.derivation(), typed.derivation(), "{name}");
    assert_eq!(text.sketch(), typed.sketch(), "{name}");
    assert_eq!(text.start_values().unwrap(), typed.start_values().unwrap(), "{name}");
    let Settings { step, .. } = entry.defaults();
    let run_as = |stabilization, scheme: Option<&'static Tableau>| {
        let stabilization = Some(stabilization);
        Settings { end: 1000.0 * step, every: 10, stabilization, scheme, ..entry.defaults() }
    };
    let settings = [
        run_as(Stabilization::Held, None),
        run_as(Stabilization::PerStage, None),
        run_as(Stabilization::Held, Some(&RK4)),
        run_as(Stabilization::Projection, Some(&DOPRI5)),
        Settings { tolerances: Some(Tolerances::default()), ..run_as(Stabilization::Projection, None) },
    ];
    for settings in settings {
        let run = |model: &dyn mbs_workbench::Model| model.simulate(&settings, &mut |_, _| ()).unwrap();
        let (text, typed) = (run(&*text), run(&*typed));
        assert_eq!(text.ended, typed.ended, "{name}");
        for (text, typed) in text.columns.iter().zip(&typed.columns) {
            let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            assert_eq!(bits(&text.values), bits(&typed.values), "{name}: {}", text.name);
        }
        assert_eq!(text.summary, typed.summary, "{name}");
    }
}
