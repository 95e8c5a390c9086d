//! Experiments that are refused, and the words of the refusals.

use mbs_analysis::{Error, Experiment, Measurement, Unknown, trials_of_type};
use mbs_runtime::Mechanism;

use super::{Oscillator, instants, oscillator, pushed};

#[track_caller]
fn refused(experiment: &Experiment) -> String {
    experiment.fit(&trials_of_type::<Oscillator>()).unwrap_err().to_string()
}

/// m, c and k of an oscillator that nothing pushes are known up to a factor; paint has no influence.
#[test]
fn what_the_data_do_not_determine_is_named() {
    let times = instants(100, 0.02);
    let values: Vec<f64> = pushed(&times).iter().map(|x| 0.1 - x).collect();
    let free = || Experiment::of(<Oscillator as Mechanism>::INFO).measured("x", &times, &values);
    let experiment = free().unknown("m", 2.0).unknown("c", 4.0).unknown("k", 190.0).unknown("x", 0.1);
    let message = refused(&experiment);
    for part in ["`m`, `c`, `k` together", "`m` by +1 %, `c` by +1 %, `k` by +1 %", "hold one"] {
        assert!(message.contains(part), "{message}");
    }
    let message = refused(&free().unknown("k", 190.0).unknown("paint", 1.0).unknown("x", 0.1));
    assert!(message.contains("do not determine `paint`: they do not depend on it"), "{message}");
}

#[test]
fn what_cannot_be_fitted_is_refused() {
    let times = instants(10, 0.1);
    let values = pushed(&times);
    let measured = || oscillator().measured("x", &times, &values);
    let message = refused(&measured().unknown("stiffness", 1.0));
    assert!(message.contains("`stiffness`") && message.contains("`k`"), "{message}");
    assert!(refused(&oscillator().measured("z", &times, &values).unknown("k", 1.0)).contains("`z`"));
    let few = oscillator().measured("x", &times[..2], &values[..2]);
    assert!(refused(&few.unknown("m", 1.0).unknown("k", 100.0)).contains("2 samples do not determine 2"));
    assert!(refused(&measured()).contains("do not determine 0 unknowns"));
    let mut broken = values.clone();
    broken[3] = f64::NAN;
    assert!(
        refused(&oscillator().measured("x", &times, &broken).unknown("k", 1.0)).contains("sample 4 of `x`")
    );
    // its square is no number, which a decomposition met with a panic
    broken[3] = 1e155;
    let message = refused(&oscillator().measured("x", &times, &broken).unknown("k", 1.0));
    assert!(message.contains("sample 4 of `x`") && message.contains("beyond 1e100"), "{message}");
    let late = [0.0, 0.1, 1e9];
    let message = refused(&oscillator().measured("x", &late, &values[..3]).unknown("k", 100.0));
    assert!(message.contains("steps, and may take no more"), "{message}");
    let mut back = times.clone();
    back[5] = 0.2;
    let message = refused(&oscillator().measured("x", &back, &values).unknown("k", 1.0));
    assert!(message.contains("sample 6 of `x`") && message.contains("not after"), "{message}");
    let early: Vec<f64> = times.iter().map(|t| t - 0.5).collect();
    let message = refused(&oscillator().measured("x", &early, &values).unknown("k", 1.0));
    assert!(message.contains("measured at -0.5 s, but the run starts at 0 s"), "{message}");
    assert!(refused(&measured().unknown("k", 1.0).unknown("k", 2.0)).contains("twice"));
    assert!(refused(&measured().unknown("k", 1.0).confidence(95.0)).contains("between 0 and 1"));
    let outside = Unknown { name: "k".into(), guess: Some(100.0), bounds: [150.0, 300.0] };
    assert!(refused(&measured().looking_for(outside)).contains("bounds 150 to 300"));
    let noise =
        Measurement { name: "x".into(), times: times.clone(), values: values.clone(), deviation: Some(0.0) };
    assert!(refused(&oscillator().with(noise).unknown("k", 1.0)).contains("standard deviation"));
    let message = refused(&measured().unknown("m", -1.0));
    assert!(matches!(
        measured().unknown("m", -1.0).fit(&trials_of_type::<Oscillator>()),
        Err(Error::Mechanism(_))
    ));
    assert!(message.contains('m'), "{message}");
}
