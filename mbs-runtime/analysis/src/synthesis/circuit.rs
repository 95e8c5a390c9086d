//! Whether a mechanism passes its positions in their order, on one circuit, with a drive that does not turn back.
//!
//! With one degree of freedom the positions that a mechanism can take without being taken apart are a curve
//! Φ(q) = 0. It is followed from the first position in steps along its tangent, each corrected by Newton's
//! method in the plane across it, until it is back or goes no further; the positions are found on the way.
//! Angles that differ by whole turns are the same.
//!
//! Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods, SIAM 2003, chapter 6, for
//! the continuation; T. R. Chase, J. A. Mirth, Circuits and branches of single-degree-of-freedom planar linkages,
//! ASME J. Mech. Des. 115 (1993) 223-230, for the defects.

use mbs_runtime::equations::{Equations, PARTIALS, Partials};
use nalgebra::{DMatrix, DVector};

use super::system::{Guess, System, nearest_turn, seeded, store};
use super::task::Defect;
use crate::singular::Singular;

/// Steps along the curve, in rad or in sizes of the mechanism: the longest, the first and the shortest, at which
/// the curve ends.
const LONGEST: f64 = 0.1;
const FIRST: f64 = 0.01;
const SHORTEST: f64 = 1e-7;
/// The tangent turns by less than this cosine says in a step.
const STRAIGHT: f64 = 0.98;
/// A curve that has not come back after so many steps is taken to be open.
const MOST: usize = 20_000;
/// Positions that are nearer than this are the same; the mechanism is known that well.
const SAME: f64 = 1e-5;
/// A second direction along which nothing moves at first order: two curves cross, or the mechanism is singular.
const SINGULAR: f64 = 1e-9;

/// The coordinates on the way from the first position to the last, or what is wrong with it.
pub fn passage(system: &System<'_>, guess: &Guess) -> Result<Vec<Vec<f64>>, Defect> {
    let mut found = Err(Defect::Circuit);
    let parameters = system.parameters(&guess.values, None);
    let look = system.trials.look(&parameters, &mut |mechanism, _| {
        let curve = Curve { system, mechanism, guess };
        found = curve.passage();
    });
    look.map_or(Err(Defect::Circuit), |()| found)
}

/// The curve on which a mechanism moves, in coordinates that are measured by their sizes.
struct Curve<'a> {
    system: &'a System<'a>,
    mechanism: &'a dyn Equations<Partials>,
    guess: &'a Guess,
}

/// The course of a curve, by the way from its beginning.
#[derive(Default)]
struct Way {
    /// The positions by their numbers.
    positions: Vec<(usize, f64)>,
    /// Where the drive turns back.
    turns: Vec<f64>,
    /// Its length if it is closed.
    length: Option<f64>,
    /// Places on it, at the ends of steps.
    places: Vec<(f64, DVector<f64>)>,
}

impl Way {
    /// With the way to the other side.
    fn lengthen(&mut self, back: Self) {
        self.positions.extend(back.positions.into_iter().map(|(at, s)| (at, -s)));
        self.turns.extend(back.turns.into_iter().map(|s| -s));
        self.places.extend(back.places.into_iter().map(|(s, place)| (-s, place)));
    }
}

impl Curve<'_> {
    fn passage(&self) -> Result<Vec<Vec<f64>>, Defect> {
        let count = self.guess.coordinates.len();
        let mut way = self.follow(1.0);
        if way.length.is_none() && way.positions.len() + 1 < count {
            way.lengthen(self.follow(-1.0));
        }
        // one that is passed twice is taken where it was met first
        let place = |at: usize| way.positions.iter().find(|(other, _)| *other == at).map(|(_, s)| *s);
        let places: Vec<f64> = (1..count).map(place).collect::<Option<_>>().ok_or(Defect::Circuit)?;
        let rises = |places: &[f64]| std::iter::once(&0.0).chain(places).zip(places).all(|(a, b)| a < b);
        // a closed curve can be followed the other way too
        let around = way.length.unwrap_or(0.0);
        let backwards: Vec<f64> = places.iter().map(|s| around - s).collect();
        let (is_forward, last) = match (rises(&places), rises(&backwards)) {
            (true, _) => (true, places.last()),
            (false, true) => (false, backwards.last()),
            (false, false) => return Err(Defect::Order),
        };
        let last = last.copied().unwrap_or(0.0);
        let along = |s: f64| if is_forward { s } else { around - s };
        if way.turns.iter().any(|s| along(*s) > SAME && along(*s) < last - SAME) {
            return Err(Defect::Branch);
        }
        let mut path: Vec<(f64, DVector<f64>)> = way.places.into_iter().map(|(s, z)| (along(s), z)).collect();
        path.retain(|(s, _)| *s > 0.0 && *s < last);
        path.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let scales = &self.system.scales[0];
        let between = path.into_iter().map(|(_, z)| z.component_mul(scales).iter().copied().collect());
        let end = |q: Option<&DVector<f64>>| q.map(|q| q.iter().copied().collect::<Vec<f64>>());
        let positions = &self.guess.coordinates;
        Ok(end(positions.first()).into_iter().chain(between).chain(end(positions.last())).collect())
    }

    /// Follows the curve from the first position in one of its directions.
    fn follow(&self, direction: f64) -> Way {
        let mut way = Way::default();
        let Some(first) = self.guess.coordinates.first() else { return way };
        let mut here = first.component_div(&self.system.scales[0]);
        let start = here.clone();
        let Some(mut tangent) = self.tangent(&here) else { return way };
        // the direction in which the drive grows, or any
        let forward = self.system.drive.map_or(1.0, |at| if tangent[at] < 0.0 { -1.0 } else { 1.0 });
        tangent *= direction * forward;
        let (mut s, mut h) = (0.0, FIRST);
        for _ in 0..MOST {
            let Some((there, turned)) = self.step(&here, &tangent, h) else {
                h *= 0.5;
                if h < SHORTEST {
                    return way;
                }
                continue;
            };
            for (at, position) in self.guess.coordinates.iter().enumerate() {
                let position = position.component_div(&self.system.scales[0]);
                let Some(part) = self.passed(&here, &tangent, h, &position) else { continue };
                if at > 0 {
                    way.positions.push((at, s + part));
                } else if s > 0.0 {
                    way.length = Some(s + part);
                    return way;
                }
            }
            if let Some(drive) = self.system.drive
                && tangent[drive] * turned[drive] <= 0.0
            {
                way.turns.push(s + 0.5 * h);
            }
            let is_straight = tangent.dot(&turned) > 0.5 * (1.0 + STRAIGHT);
            s += h;
            (here, tangent) = (there, turned);
            way.places.push((s, here.clone()));
            // a curve that has gone away does not come back
            if (&here - &start).amax() > 1e3 {
                return way;
            }
            if is_straight {
                h = (1.5 * h).min(LONGEST);
            }
        }
        way
    }

    /// The end of a step and the tangent there, if the step is short enough.
    fn step(
        &self,
        here: &DVector<f64>,
        tangent: &DVector<f64>,
        h: f64,
    ) -> Option<(DVector<f64>, DVector<f64>)> {
        let there = self.corrected(here + tangent * h, tangent)?;
        let turned = self.tangent(&there)?;
        let turned = if turned.dot(tangent) < 0.0 { -turned } else { turned };
        (turned.dot(tangent) > STRAIGHT).then_some((there, turned))
    }

    /// How far along a step a position lies, if it lies on it.
    fn passed(
        &self,
        here: &DVector<f64>,
        tangent: &DVector<f64>,
        h: f64,
        position: &DVector<f64>,
    ) -> Option<f64> {
        let away = self.between(position, here);
        let part = away.dot(tangent);
        // the end belongs to the next step
        if !(0.0..h).contains(&part) || (&away - tangent * part).norm() > 0.3 * h + SAME {
            return None;
        }
        let there = self.corrected(here + tangent * part, tangent)?;
        (self.between(position, &there).norm() < SAME).then_some(part)
    }

    /// The difference of two positions, with angles up to half a turn.
    fn between(&self, a: &DVector<f64>, b: &DVector<f64>) -> DVector<f64> {
        let difference = |at: usize, _| {
            let difference = a[at] - b[at];
            if self.system.is_angle(at) { nearest_turn(difference) } else { difference }
        };
        DVector::from_fn(a.len(), difference)
    }

    /// Φ and Φ_q at a position.
    fn constraints(&self, place: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let [scales, _] = &self.system.scales;
        let (m, n) = (self.system.info().constraints.len(), place.len());
        let q: Vec<Partials> =
            place.iter().zip(scales).map(|(z, scale)| Partials::constant(z * scale)).collect();
        let mut phi = vec![Partials::default(); m];
        let mut jacobian = DMatrix::zeros(m, n);
        for first in (0..n).step_by(PARTIALS) {
            self.mechanism.phi(Partials::default(), &seeded(&q, first), &mut phi);
            store(&phi, &mut jacobian, first);
        }
        jacobian.column_iter_mut().zip(scales).for_each(|(mut column, scale)| column *= *scale);
        let mut values = DVector::from_iterator(m, phi.iter().map(|phi| phi.value));
        for (mut row, value) in jacobian.row_iter_mut().zip(values.iter_mut()) {
            let size = row.norm();
            if size > 0.0 {
                row /= size;
                *value /= size;
            }
        }
        (values, jacobian)
    }

    /// The direction along which Φ stays 0; nothing where there are two.
    fn tangent(&self, place: &DVector<f64>) -> Option<DVector<f64>> {
        let (_, jacobian) = self.constraints(place);
        let n = place.len();
        if jacobian.iter().any(|x| !x.is_finite()) {
            return None;
        }
        // square, so that all right singular vectors are there
        let rows = jacobian.nrows().max(n);
        let Singular { values, v_t, .. } = Singular::new(&jacobian.resize(rows, n, 0.0));
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        let (least, next) = (order.first()?, order.get(1));
        next.is_none_or(|next| values[*next] > SINGULAR).then(|| v_t.row(*least).transpose())
    }

    /// The position on the curve in the plane across a direction.
    fn corrected(&self, mut place: DVector<f64>, across: &DVector<f64>) -> Option<DVector<f64>> {
        for _ in 0..8 {
            let (phi, jacobian) = self.constraints(&place);
            let (m, n) = jacobian.shape();
            let bordered = jacobian.insert_row(m, 0.0);
            let mut bordered = bordered;
            bordered.row_mut(m).copy_from(&across.transpose());
            let right = (-phi).insert_row(m, 0.0);
            if !bordered.iter().chain(&right).all(|x| x.is_finite()) {
                return None;
            }
            let change = if m + 1 == n {
                bordered.lu().solve(&right)?
            } else {
                Singular::new(&bordered).solve(&right, SINGULAR)
            };
            place += &change;
            if change.amax() < 1e-12 * (1.0 + place.amax()) {
                return Some(place);
            }
        }
        None
    }
}
