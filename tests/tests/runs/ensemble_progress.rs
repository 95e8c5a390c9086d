//! An ensemble tells how far it is, hands its members over in order, and ends soon after it is
//! cancelled.
#![allow(clippy::panic, reason = "a test says by panicking what is wrong")]

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use mbs_ensemble::{Cancelled, Ensemble};
use mbs_runtime::Simulation;
use models::{SliderCrank, SliderCrankParameters};

#[test]
fn progress_and_cancelling() {
    let (flag, calls, handed_over) = (AtomicBool::new(false), AtomicUsize::new(0), AtomicUsize::new(0));
    let report = |done: usize, all: usize| {
        assert!(done <= all && all == 5000);
        calls.fetch_add(1, Ordering::Relaxed);
    };
    let ensemble = Ensemble::new(0.01).cancelled_by(&flag).progress(&report);
    let member = |index: usize| {
        let l1 = 0.05 + 0.001 * (index % 19) as f64;
        Simulation::new(SliderCrank::new(SliderCrankParameters { l1, ..Default::default() })?, 0.5e-3)
    };
    let count = |index: usize, _| assert_eq!(handed_over.fetch_add(1, Ordering::Relaxed), index);
    assert_eq!(ensemble.for_each(5000, member, &(), count), Ok(()));
    assert_eq!((calls.load(Ordering::Relaxed), handed_over.load(Ordering::Relaxed)), (625, 5000));

    let stops = |index: usize, _| flag.store(index >= 1000, Ordering::Relaxed);
    let Err(Cancelled { finished }) = ensemble.for_each(5000, member, &(), stops) else {
        panic!("it went on");
    };
    assert!((1000..5000).contains(&finished), "{finished}");
    // within a block too, however long it is
    assert_eq!(Ensemble::new(1e9).cancelled_by(&flag).run(1, member, &()), Err(Cancelled { finished: 0 }));
}
