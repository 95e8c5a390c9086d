//! Splines: functions of one argument given by a table, cubic from point to point.
//!
//! The compiler solves for the coefficients. Generated code holds them as a constant.

mod surface;
mod through;

pub use surface::{Grid, Surface};

/// A jump of a derivative is one if it is more than this share of the largest terms of the derivative.
const JUMP: f64 = 1e-9;

/// A spline: a handle into an [`Arena`](crate::Arena)'s list of splines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct SplineId(pub(crate) u32);

impl SplineId {
    /// Its position in the list of splines.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// How a spline leads from point to point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// By straight lines.
    Linear,
    /// By cubics with two continuous derivatives. At the ends of one that is not periodic the second
    /// derivative is 0 (the natural spline).
    Cubic,
    /// By cubics with one continuous derivative, which rise or fall where the points do and do not overshoot:
    /// F. N. Fritsch and J. Butland, A method for constructing local monotone piecewise cubic interpolants,
    /// SIAM Journal on Scientific and Statistical Computing 5 (1984), 300–304.
    Monotone,
    /// Each value holds up to the next point.
    Step,
}

impl Interpolation {
    /// The words for them, with which tables are declared.
    pub const WORDS: [(&str, Self); 4] = [
        ("linear", Self::Linear),
        ("cubic", Self::Cubic),
        ("monotone", Self::Monotone),
        ("step", Self::Step),
    ];
}

/// A rule for what is outside of the points of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// [`Outside::Hold`].
    Hold,
    /// [`Outside::Extend`].
    Extend,
    /// The points repeat: the last one is the first one again.
    Periodic,
    /// [`Outside::Refuse`].
    Refuse,
}

impl Beyond {
    /// The words for them, with which tables are declared.
    pub const WORDS: [(&str, Self); 4] = [
        ("hold", Self::Hold),
        ("extend", Self::Extend),
        ("periodic", Self::Periodic),
        ("refuse", Self::Refuse),
    ];
}

/// The value of a spline outside of its points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outside {
    /// That of the nearest point.
    Hold,
    /// That of the outermost piece, continued; of a monotone one that of the line that touches its end.
    Extend,
    /// That of a period before: the first point returns after this period.
    Periodic(f64),
    /// None: it is not a number.
    Refuse,
}

/// One cubic: c₀ + c₁u + c₂u² + c₃u³ from `from` on, u counted from there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Distance from the first point.
    pub from: f64,
    /// c₀ … c₃
    pub coefficients: [f64; 4],
}

impl Segment {
    /// The coefficients of the same cubic counted from another place, where it has this value.
    fn counted_from(&self, place: f64, value: f64) -> [f64; 4] {
        let (u, [_, c1, c2, c3]) = (place - self.from, self.coefficients);
        [value, c1 + u * (2.0 * c2 + u * (3.0 * c3)), c2 + u * (3.0 * c3), c3]
    }
}

/// A function through given points, cubic between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// The way in which it is called.
    pub name: String,
    /// The argument of the first point.
    pub origin: f64,
    /// The period, of a periodic one.
    pub period: Option<f64>,
    /// In ascending order. The first one holds before its beginning, too, and the last one for ever.
    pub segments: Vec<Segment>,
    /// Where the function bends of which this one is a part; of a function of its own that follows from the segments.
    pub bends: Option<Bends>,
}

/// Where a function of two arguments bends along one of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bends {
    /// The name of the function.
    pub of: String,
    /// The arguments, in ascending order.
    pub at: Vec<f64>,
    /// The order of the derivative that jumps there, 0 for the value.
    pub order: u8,
}

impl Spline {
    /// Overshoots between neighbouring points of equal values: the index of the first point, and the largest distance
    /// of the cubic from that value. The cubic leaves the value where it has a slope at both ends.
    pub fn overshoots(&self) -> impl Iterator<Item = (usize, f64)> {
        let next = self.segments.iter().skip(1).chain(self.segments.first());
        self.segments.iter().zip(next).enumerate().filter_map(|(at, (segment, next))| {
            let Segment { from, coefficients: [c0, c1, c2, c3] } = *segment;
            let end = if at + 1 == self.segments.len() { self.period? } else { next.from };
            // u (c₁ + u (c₂ + u c₃)) vanishes at both ends; where it is flat, its slope does
            let root = (c2 * c2 - 3.0 * c1 * c3).sqrt();
            let flat = [-c2 - root, -c2 + root].map(|q| [q / (3.0 * c3), c1 / q]);
            let inside = flat.into_iter().flatten().filter(|u| *u > 0.0 && *u < end - from);
            let away = inside.map(|u| (u * (c1 + u * (c2 + u * c3))).abs()).fold(0.0, f64::max);
            (next.coefficients[0] == c0 && end > from).then_some((at, away))
        })
    }

    /// The arguments at which the value or one of its first two derivatives jumps, in ascending order; of a periodic
    /// one those within a period.
    pub fn knots(&self) -> Vec<f64> {
        if let Some(bends) = &self.bends {
            return bends.at.clone();
        }
        self.corners().into_iter().map(|(at, _)| at).collect()
    }

    /// The [`knots`](Self::knots), and the arguments at which pieces meet smoothly of which one is curved, in ascending
    /// order; of a periodic one those within a period.
    pub fn points(&self) -> Vec<f64> {
        if self.bends.is_some() {
            return self.knots();
        }
        let is_curved = |segment: &Segment| segment.coefficients.iter().skip(2).any(|c| *c != 0.0);
        let pairs = self.segments.windows(2).filter(|pair| pair.iter().any(is_curved));
        let mut points: Vec<f64> = pairs.filter_map(|pair| Some(self.origin + pair.last()?.from)).collect();
        points.extend(self.knots());
        points.sort_by(f64::total_cmp);
        points.dedup();
        points
    }

    /// True if the value itself jumps somewhere.
    pub fn has_jumps(&self) -> bool {
        match &self.bends {
            Some(bends) => bends.order == 0,
            None => self.corners().iter().any(|(_, jumps)| *jumps),
        }
    }

    /// The [`knots`](Self::knots) with the word whether the value itself jumps there.
    pub fn corners(&self) -> Vec<(f64, bool)> {
        let jumps = self.jumps().into_iter();
        let jumps = jumps.filter(|(_, jumps)| jumps.iter().any(Option::is_some));
        let mut corners: Vec<_> =
            jumps.map(|(at, [value, ..])| (self.origin + at, value.is_some())).collect();
        if let (Some(period), Some((last, _))) = (self.period, corners.last_mut()) {
            // the end of the period is its beginning
            if *last == self.origin + period {
                *last = self.origin;
                corners.rotate_right(1);
            }
        }
        corners
    }

    /// The place of the largest jump of a derivative of this order, 0 or 1, between two pieces, and the jump; none
    /// where there is only that of rounding.
    ///
    /// Of a part of a function of two arguments the first place, and a jump of unknown size.
    pub fn jump(&self, order: u8) -> Option<(f64, f64)> {
        if let Some(bends) = &self.bends {
            return bends.at.first().filter(|_| bends.order == order).map(|at| (*at, f64::NAN));
        }
        let jumps = self.jumps().into_iter();
        let jumps =
            jumps.filter_map(|(at, jumps)| Some((self.origin + at, (*jumps.get(usize::from(order))?)?)));
        jumps.max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Where pieces meet, and the jumps of c₀, c₁ and c₂ there that are more than rounding.
    fn jumps(&self) -> Vec<(f64, [Option<f64>; 3])> {
        let wrapped = self.period.zip(self.segments.first());
        let wrapped =
            wrapped.map(|(period, first)| Segment { from: period, coefficients: first.coefficients });
        let next = self.segments.iter().skip(1).copied().chain(wrapped);
        let pairs: Vec<(Segment, Segment)> = self.segments.iter().copied().zip(next).collect();
        let terms = pairs.iter().map(|(segment, next)| {
            let ([c0, c1, c2, c3], w) = (segment.coefficients.map(f64::abs), next.from - segment.from);
            [c0 + w * (c1 + w * (c2 + w * c3)), c1 + w * (2.0 * c2 + w * (3.0 * c3)), c2 + w * (3.0 * c3)]
        });
        let sizes = terms.fold([0.0_f64; 3], |sizes, terms| [0, 1, 2].map(|at| sizes[at].max(terms[at])));
        let jumps_of = |(segment, next): &(Segment, Segment)| {
            let w = next.from - segment.from;
            let [c0, c1, c2, c3] = segment.coefficients;
            let end = segment.counted_from(next.from, c0 + w * (c1 + w * (c2 + w * c3)));
            let jumps = [0, 1, 2].map(|order| {
                let jump = (next.coefficients[order] - end[order]).abs();
                (jump > JUMP * sizes[order]).then_some(jump)
            });
            (next.from, jumps)
        };
        pairs.iter().map(jumps_of).collect()
    }

    /// The largest order of a derivative that is not 0 everywhere.
    pub fn degree(&self) -> u8 {
        let is_there =
            |order: &u8| self.segments.iter().any(|it| it.coefficients[usize::from(*order)] != 0.0);
        (1..4).rev().find(is_there).unwrap_or(0)
    }

    /// A length that distances from a segment's beginning do not exceed much, to judge rounding by.
    pub(crate) fn span(&self) -> f64 {
        self.period.or_else(|| self.segments.last().map(|last| last.from)).unwrap_or_default()
    }

    /// The derivative of this order at x, the function itself for 0; as the
    /// runtime computes it.
    pub fn derivative(&self, order: u8, x: f64) -> f64 {
        let x = x - self.origin;
        let u = self.period.map_or(x, |period| x - (x / period).floor() * period);
        let at = self.segments.partition_point(|segment| segment.from <= u).saturating_sub(1);
        let Some(Segment { from, coefficients: [c0, c1, c2, c3] }) = self.segments.get(at).copied() else {
            return f64::NAN;
        };
        let u = u - from;
        match order {
            0 => c0 + u * (c1 + u * (c2 + u * c3)),
            1 => c1 + u * (2.0 * c2 + u * (3.0 * c3)),
            2 => 2.0 * c2 + u * (6.0 * c3),
            _ => 6.0 * c3,
        }
    }
}
