//! Laws of motion: functions that rise from 0 to 1 as the progress s does, and
//! rest outside (Norton, Cam Design and Manufacturing Handbook).
//!
//! They are built from operators whose derivatives hold from the right: `max`
//! and `min` have the slope of their second argument where both are equal. So a
//! motion that starts at s = 0 has its acceleration there, and none at s = 1.

use std::f64::consts::{PI, TAU};

use mbs_symbolic::Scalar;

/// A law with the word for it.
pub struct Law {
    pub name: &'static str,
    pub kind: LawKind,
}

/// The function of a law, by its arguments.
pub enum LawKind {
    /// The progress.
    Plain(for<'a> fn(Scalar<'a>) -> Scalar<'a>),
    /// The progress, and the share of the time in which it accelerates.
    Trapezoidal(for<'a> fn(Scalar<'a>, Scalar<'a>) -> Scalar<'a>),
}

pub const LAWS: &[Law] = &[
    Law { name: "cycloidal", kind: LawKind::Plain(cycloidal) },
    Law { name: "polynomial_345", kind: LawKind::Plain(polynomial_345) },
    Law { name: "harmonic", kind: LawKind::Plain(harmonic) },
    Law { name: "trapezoidal", kind: LawKind::Trapezoidal(trapezoidal) },
];

/// s between 0 and 1.
pub fn clamped(s: Scalar<'_>) -> Scalar<'_> {
    let algebra = s.algebra();
    algebra.number(0).max(s).min(algebra.number(1))
}

/// s − sin(2πs)/2π
fn cycloidal(s: Scalar<'_>) -> Scalar<'_> {
    let turn = s.algebra().number(TAU);
    s - (turn * s).sin() / turn
}

/// 10s³ − 15s⁴ + 6s⁵
fn polynomial_345(s: Scalar<'_>) -> Scalar<'_> {
    10 * s.powi(3) - 15 * s.powi(4) + 6 * s.powi(5)
}

/// (1 − cos πs)/2
fn harmonic(s: Scalar<'_>) -> Scalar<'_> {
    (1 - (s.algebra().number(PI) * s).cos()) / 2
}

/// The velocity rises to 1/(1 − a) up to s = a and falls from s = 1 − a on; each
/// change of the acceleration adds a parabola from there.
fn trapezoidal<'a>(s: Scalar<'a>, a: Scalar<'a>) -> Scalar<'a> {
    let rest = 1 - a;
    let parabola_from = |from: Scalar<'a>| s.algebra().number(0).max(s - from).squared();
    let (steady, falling) = (parabola_from(a), parabola_from(rest));
    (s.squared() - steady - falling) / 2 / (a * rest)
}
