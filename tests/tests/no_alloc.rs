//! Not one allocation in 20,000 steps: driven and free, with both kinds of
//! feedback, with reactions, outputs and points, with derivatives, and on the way into an error.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use mbs_live::{Prepared, Run, Text};
use mbs_runtime::gradients::{Sum, Variable};
use mbs_runtime::{
    Adaptive, Baumgarte, Components, Dual, Held, Kinematics, Mechanism, Method, PerStage, Projected, Rattle,
    Rk4, Sampled, Simulation, System as _, TrBdf2, start,
};
use models::slider_crank::SliderCrank;
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeParameters};
use tests::bushing::Crank;

/// Counts on its own thread, so that the test harness does not disturb.
struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

fn count() {
    // A thread that is ending has no counter any more.
    let _ = COUNT.try_with(|count| count.set(count.get() + 1));
}

#[allow(unsafe_code, reason = "a global allocator is unsafe by nature; it only counts and passes on")]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count();
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count();
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = COUNT.get();
    work();
    COUNT.get() - before
}

const H: f64 = 0.5e-3;
const STEPS: u32 = 20_000;

fn count_steps<M: Mechanism, X: Method>(mechanism: M, baumgarte: Baumgarte<X>) -> u64 {
    allocations(|| {
        let mut simulation = Simulation::builder(mechanism, H).baumgarte(baumgarte).build().expect("a start");
        for _ in 0..STEPS {
            simulation.step().expect("a step");
        }
        assert_eq!(simulation.steps(), u64::from(STEPS));
    })
}

#[test]
fn counter_counts() {
    assert_eq!(allocations(|| drop(std::hint::black_box(vec![1, 2, 3]))), 1);
}

#[test]
fn steps_do_not_allocate() {
    assert_eq!(count_steps(SliderCrank::declared(), Baumgarte::<Held>::deadbeat(H)), 0);
    assert_eq!(count_steps(SliderCrank::declared(), Baumgarte::<PerStage>::deadbeat(H)), 0);
    assert_eq!(count_steps(SliderCrankFree::declared(), Baumgarte::<Held>::deadbeat(H)), 0);
    assert_eq!(count_steps(SliderCrankFree::declared(), Baumgarte::<PerStage>::deadbeat(H)), 0);
    assert_eq!(count_steps(SliderCrankFree::declared(), Baumgarte::<Projected<Rk4>>::NONE), 0);
}

/// Steps of duals, starts and runs to a tolerance with them; steps of a text with them.
#[test]
fn derivatives_do_not_allocate() {
    let declared = SliderCrankFree::declared();
    let allocated = allocations(|| {
        let mut parameters: SliderCrankFreeParameters<_> = declared.parameters().over();
        parameters.l1 = Dual::<f64, 4>::variable(0.06, 0);
        let builder = Simulation::builder(declared, H).over(parameters).expect("lengths");
        let mut run = builder.build().expect("a start");
        for _ in 0..STEPS / 100 {
            run.step().expect("a step");
            let _ = std::hint::black_box((run.outputs(), run.step_with_reactions()));
        }
        let mut run = Adaptive::builder(*run.mechanism()).build().expect("a start");
        run.advance_to(1.0).expect("a regular motion");
    });
    assert_eq!(allocated, 0);

    let text = "Block { dof = 1; param k = 4 [N/m]; body block (x) { mass = 1 [kg]; }
        force spring on x = -k*x; start { x = 1 [m]; } }";
    let block = Text::declaration("block.mbs", text).compile().expect("a declaration");
    let by_stiffness = |values: &mut [Dual<f64, 4>]| values[0] = Dual::variable(4.0, 0);
    let builder = Run::builder(&block, H).over(by_stiffness).expect("a stiffness");
    let mut run = builder.build().expect("a start");
    assert_eq!(allocations(|| run.advance(10_000).expect("a regular motion")), 0);
}

/// A gradient in reverse allocates once: a longer run takes as many allocations, whether all states are kept
/// or most are made again.
#[test]
fn steps_in_reverse_do_not_allocate() {
    let text = "Block { dof = 1; param k = 4 [N/m]; body block (x) { mass = 1 [kg]; }
        force spring on x = -k*x; start { x = 1 [m]; } output pull [N] = k*x; }";
    let block = Text::declaration("block.mbs", text).compile_with_transposes().expect("a mechanism");
    let variables = [Variable::Parameter("k"), Variable::Position("x")];
    let mut gradient = [0.0; 2];
    let mut count = |steps: u64, memory: usize| {
        allocations(|| {
            let found = Run::builder(&block, H).gradient_in_reverse(
                &Sum::new(steps, &variables),
                memory,
                |moment| {
                    moment.by_q[0] = 1.0;
                    moment.by_outputs[0] = 0.5;
                    Ok(moment.at.q[0] + 0.5 * moment.outputs()?[0])
                },
                &mut gradient,
            );
            assert!(found.is_ok());
        })
    };
    for memory in [1 << 20, 4096] {
        assert_eq!(count(1000, memory), count(10_000, memory));
    }
}

#[test]
fn runs_to_a_tolerance_do_not_allocate() {
    let allocated = allocations(|| {
        let mut run = Adaptive::builder(SliderCrankFree::declared()).build().expect("a start");
        let mut samples = Sampled::new(run.clone(), 1e-3).expect("an interval");
        run.advance_to(10.0).expect("a regular motion");
        samples.advance(1000).expect("a regular motion");
        run.inputs_mut().crank_torque = f64::NAN;
        assert!(run.step().is_err());
    });
    assert_eq!(allocated, 0);
}

#[test]
fn steps_of_rattle_do_not_allocate() {
    let allocated = allocations(|| {
        let mut run = Rattle::builder(SliderCrankFree::declared(), H).build().expect("a start");
        run.advance_to(10.0).expect("a regular motion");
        run.inputs_mut().crank_torque = f64::NAN;
        assert!(run.step().is_err());
    });
    assert_eq!(allocated, 0);

    let text = "Block { dof = 1; body block (x, y) { mass = 1 [kg]; }
        force spring on x = -4 [N/m]*x; constraint line: y = 2*x; start { x = 1 [m]; } }";
    let block = Text::declaration("block.mbs", text).compile().expect("a declaration");
    let mut run = Rattle::builder(Prepared::new(&block), H).build().expect("a start");
    assert_eq!(allocations(|| run.advance_to(5.0).expect("a regular motion")), 0);
    let mut run = TrBdf2::builder(Prepared::new(&block), H).build().expect("a start");
    assert_eq!(allocations(|| run.advance_to(5.0).expect("a regular motion")), 0);
}

#[test]
fn implicit_steps_do_not_allocate() {
    let allocated = allocations(|| {
        let mut run = TrBdf2::builder(Crank::declared(), H).build().expect("a start");
        run.advance_to(1.0).expect("a regular motion");
    });
    assert_eq!(allocated, 0);
}

#[test]
fn reactions_and_outputs_do_not_allocate() {
    fn count<M: Mechanism>(mechanism: M) -> u64 {
        allocations(|| {
            let mut simulation = Simulation::new(mechanism, H).expect("a start");
            for _ in 0..STEPS / 10 {
                simulation.step().expect("a step");
                let values = (
                    simulation.reactions(),
                    simulation.raw_reactions(),
                    simulation.outputs(),
                    simulation.energy(),
                    simulation.mechanism().points(simulation.time(), &simulation.state().q),
                );
                let _ = std::hint::black_box(values);
            }
        })
    }
    assert_eq!(count(SliderCrank::declared()), 0);
    assert_eq!(count(SliderCrankFree::declared()), 0);
}

#[test]
fn starts_kinematics_and_errors_do_not_allocate() {
    let allocated = allocations(|| {
        let mechanism = SliderCrank::declared();
        let declared = mechanism.declared_start();
        assert!(start::consistent(&mechanism, &declared).is_ok());
        let mut kinematics = Kinematics::new(mechanism).expect("driven");
        for k in 0..1000 {
            assert!(kinematics.at(f64::from(k) * H).is_ok());
        }
        let mut bad = *mechanism.parameters();
        bad.m1 = -1.0;
        assert!(SliderCrank::new(bad).is_err());
        let mut free = Simulation::new(SliderCrankFree::declared(), H).expect("a start");
        free.inputs_mut().crank_torque = f64::NAN;
        assert!(free.step().is_err());
    });
    assert_eq!(allocated, 0);
}
