//! Vectors of the plane.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::Scalar;
use crate::arena::Expr;

/// A vector of the plane, by its components.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vector<T> {
    /// Along x.
    pub x: T,
    /// Along y.
    pub y: T,
}

impl<T> Vector<T> {
    /// The vector of what becomes of both components, x first.
    pub fn map<U>(self, mut each: impl FnMut(T) -> U) -> Vector<U> {
        let x = each(self.x);
        Vector { x, y: each(self.y) }
    }

    /// x and y.
    pub fn components(self) -> [T; 2] {
        [self.x, self.y]
    }
}

impl<T> From<[T; 2]> for Vector<T> {
    fn from([x, y]: [T; 2]) -> Self {
        Self { x, y }
    }
}

impl<'a> Vector<Scalar<'a>> {
    /// The components in the arena.
    pub fn exprs(self) -> [Expr; 2] {
        [self.x.expr(), self.y.expr()]
    }

    /// u·v
    pub fn dot(self, other: Self) -> Scalar<'a> {
        self.x * other.x + self.y * other.y
    }

    /// |v|, whose derivative has no value at 0.
    pub fn norm(self) -> Scalar<'a> {
        self.dot(self).sqrt()
    }

    /// v turned by 90°, from x to y.
    pub fn perpendicular(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// R(angle)·v
    pub fn rotated(self, angle: Scalar<'a>) -> Self {
        let (sine, cosine) = (angle.sin(), angle.cos());
        let (xc, ys) = (self.x * cosine, self.y * sine);
        let (xs, yc) = (self.x * sine, self.y * cosine);
        Self { x: xc - ys, y: xs + yc }
    }
}

impl Add for Vector<Scalar<'_>> {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for Vector<Scalar<'_>> {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for Vector<Scalar<'_>> {
    type Output = Self;

    fn neg(self) -> Self {
        self.map(Neg::neg)
    }
}

impl<'a> Mul<Vector<Self>> for Scalar<'a> {
    type Output = Vector<Self>;

    fn mul(self, vector: Vector<Self>) -> Vector<Self> {
        vector.map(|component| self * component)
    }
}

impl<'a> Div<Scalar<'a>> for Vector<Scalar<'a>> {
    type Output = Self;

    fn div(self, divisor: Scalar<'a>) -> Self {
        self.map(|component| component / divisor)
    }
}
