//! A mechanism of the library, compiled by rustc and run from its text.

use mbs_runtime::{Mechanism, RK4};
use mbs_workbench::{FeedbackKind, Settings, model};

/// Info, equations, sketch, start and 1,000 steps are the same, with held feedback and with
/// feedback in each stage, and with another scheme.
pub fn same<M: Mechanism<Real = f64>>(name: &str) {
    let entry = mbs::library().iter().find(|entry| entry.mechanism == name).unwrap();
    let text = model::from_text(&entry.text(), entry.defaults()).unwrap_or_else(|error| panic!("{error}"));
    let typed = model::with::<M>(entry.defaults());
    assert_eq!(text.info(), typed.info());
    assert_eq!(text.derivation(), typed.derivation(), "{name}");
    assert_eq!(text.sketch(), typed.sketch(), "{name}");
    assert_eq!(text.start_values().unwrap(), typed.start_values().unwrap(), "{name}");
    for (feedback, scheme) in
        [(FeedbackKind::Held, None), (FeedbackKind::PerStage, None), (FeedbackKind::Held, Some(&RK4))]
    {
        let Settings { step, .. } = entry.defaults();
        let settings = Settings { end: 1000.0 * step, every: 10, feedback, scheme, ..entry.defaults() };
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
