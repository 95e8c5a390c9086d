//! The most memory that an ensemble holds at once depends neither on the number of steps nor on the number of
//! members that are handed over.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering};

use mbs_ensemble::{Ensemble, Violation};
use mbs_runtime::Simulation;
use models::SliderCrank;

/// Counts the bytes that are held, and the most of them.
struct Counting;

static HELD: AtomicUsize = AtomicUsize::new(0);
static PEAK: AtomicUsize = AtomicUsize::new(0);

#[allow(unsafe_code, reason = "a global allocator is unsafe by nature; it only counts and passes on")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let held = HELD.fetch_add(layout.size(), Ordering::Relaxed) + layout.size();
        PEAK.fetch_max(held, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Ordering::Relaxed);
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// The most that is held beyond what was held before.
fn peak(members: usize, end: f64) -> usize {
    let before = HELD.load(Ordering::Relaxed);
    PEAK.store(before, Ordering::Relaxed);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let member = |_| Simulation::new(SliderCrank::declared(), 0.5e-3);
    let mut seen = 0;
    pool.install(|| {
        let taken = Ensemble::new(end).for_each(members, member, &Violation, |_, outcome| {
            assert!(outcome.is_ok_and(|run| run.ended.is_none()));
            seen += 1;
        });
        taken.expect("nobody cancels");
    });
    assert_eq!(seen, members);
    drop(pool);
    PEAK.load(Ordering::Relaxed) - before
}

/// The slack is what threads allocate for themselves: queues, names.
#[test]
fn memory_is_bounded() {
    const SLACK: usize = 16 * 1024;
    peak(4096, 0.005);
    let few_steps = peak(4096, 0.005);
    let many_steps = peak(4096, 0.5);
    let many_members = peak(65_536, 0.005);
    println!("{few_steps} {many_steps} {many_members} bytes");
    assert!(many_steps.abs_diff(few_steps) <= SLACK);
    assert!(many_members.abs_diff(few_steps) <= SLACK);
}
