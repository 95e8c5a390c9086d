//! A step takes no more stack than `STACK_BYTES` promises, measured from the
//! addresses of locals in the operations of a scalar that reports them.
//!
//! The scalar's operations are calls, across which every live value has to stand
//! on the stack: more than code for `f64` needs, which keeps values in registers.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::cell::Cell;
use std::fmt;
use std::hint::black_box;
use std::ops::{Add, Div, Mul, Neg, Sub};

use mbs_runtime::{Mechanism, Real, Simulation};
use models::pendulum::Pendulum;
use models::slider_crank::SliderCrank;
use models::slider_crank_free::SliderCrankFree;

thread_local! {
    static DEEPEST: Cell<usize> = const { Cell::new(usize::MAX) };
}

/// Where the stack stands; it grows downwards on every platform of these tests.
#[inline(never)]
fn here() -> usize {
    let local = 0_u8;
    std::ptr::from_ref(black_box(&local)) as usize
}

#[inline(never)]
fn probed(value: f64) -> Probe {
    DEEPEST.with(|deepest| deepest.set(deepest.get().min(here())));
    Probe(value)
}

/// An `f64` whose operations look at the stack.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
struct Probe(f64);

impl fmt::Display for Probe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Add for Probe {
    type Output = Self;
    fn add(self, y: Self) -> Self {
        probed(self.0 + y.0)
    }
}

impl Sub for Probe {
    type Output = Self;
    fn sub(self, y: Self) -> Self {
        probed(self.0 - y.0)
    }
}

impl Mul for Probe {
    type Output = Self;
    fn mul(self, y: Self) -> Self {
        probed(self.0 * y.0)
    }
}

impl Div for Probe {
    type Output = Self;
    fn div(self, y: Self) -> Self {
        probed(self.0 / y.0)
    }
}

impl Neg for Probe {
    type Output = Self;
    fn neg(self) -> Self {
        probed(-self.0)
    }
}

macro_rules! unary {
    ($($name:ident)*) => {
        $(fn $name(self) -> Self {
            probed(Real::$name(self.0))
        })*
    };
}

macro_rules! binary {
    ($($name:ident)*) => {
        $(fn $name(self, other: Self) -> Self {
            probed(Real::$name(self.0, other.0))
        })*
    };
}

impl Real for Probe {
    const ZERO: Self = Self(0.0);
    const EPSILON: Self = Self(f64::EPSILON);
    type Pair = mbs_runtime::Two<Self>;

    fn from_f64(x: f64) -> Self {
        Self(x)
    }
    fn to_f64(self) -> f64 {
        self.0
    }
    fn is_finite(self) -> bool {
        self.0.is_finite()
    }
    fn sin_cos(self) -> (Self, Self) {
        (self.sin(), self.cos())
    }
    unary! { sin cos tan asin acos atan sqrt exp ln tanh abs sign }
    binary! { atan2 pow min max greater gate }
}

/// The stack that a step takes, in bytes.
#[inline(never)]
fn taken<M: Mechanism<Real = Probe>>() -> usize {
    let mechanism = M::new(M::Parameters::default()).expect("declared parameters");
    let mut run = Simulation::new(mechanism, 1e-3).expect("assembles");
    DEEPEST.set(usize::MAX);
    let above = here();
    step(&mut run);
    above - DEEPEST.get()
}

#[inline(never)]
fn step<M: Mechanism>(run: &mut Simulation<M>) {
    run.step().expect("regular");
}

#[test]
fn a_step_keeps_its_promise() {
    for (name, taken, promised) in [
        ("slider-crank", taken::<SliderCrank<Probe>>(), SliderCrank::<Probe>::STACK_BYTES),
        ("free slider-crank", taken::<SliderCrankFree<Probe>>(), SliderCrankFree::<Probe>::STACK_BYTES),
        ("pendulum", taken::<Pendulum<Probe>>(), Pendulum::<Probe>::STACK_BYTES),
    ] {
        println!("{name}: {taken} of {promised} bytes");
        assert!(taken > 0 && taken <= promised, "{name} takes {taken} of {promised} bytes");
    }
}
