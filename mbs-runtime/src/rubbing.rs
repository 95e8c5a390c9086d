//! Friction at stops: Coulomb's law, of forces while a stop is rested on, and of impulses where it is hit.
//!
//! A body that touches a stop slides along s. With x of the stop and x_s of its friction, W and b as at [stops](crate::contact),
//! and the rate r = W x + b of s behind an impact, or its second derivative at rest,
//!
//! ```text
//! r = 0 and |x_s| ≤ μ x,   or   x_s = −μ x sign(r)
//! ```
//!
//! beside Newton's law of x, without restitution along s. That is one complementary problem (Stewart and Trinkle, Int. J.
//! Numer. Methods Eng. 39 (1996) 2673), whose pivots tell which stops push and what slides which way; the impulses are solved for
//! with these states. An impact without restitution always has an answer, a rest need not have one (Painlevé).
//!
//! Newton's law with friction may give energy (Kane and Levinson 1985). Where it would, its impulses are led to those
//! without restitution as far as energy is kept: both are within the bounds of friction, and so is what lies between.

pub(crate) use crate::bounds::{Bounds, all_rubbing, borne, rubbing, sizes};
use crate::contact::{Contacts, DEPENDENT, Each, MOST_CONTACTS, bit, has, number, share, those};
use crate::equations::Equations;
use crate::pivoting::Table;
use crate::sticking::{direction, set};
use crate::{Info, Real};

/// A rate is 0 below this share of the terms of which it is made.
const ROUNDING: f64 = 1e-12;

/// The x of frictions that slide, as the memories of a run have them: −μ d by their stops.
pub(crate) fn sliding<T: Real>(equations: &dyn Equations<T>, inputs: &[T]) -> Each<T> {
    let info = equations.info();
    Bounds::of(equations).slides(info, |row| direction(info, inputs, row))
}

/// Notes how what touches stops slides behind an impact.
pub(crate) fn note<T: Real>(info: &Info, inputs: &mut [T], struck: &Struck<T>) {
    for (row, _) in rubbing(info).filter(|(row, _)| has(struck.rubbed, *row)) {
        set(info, inputs, row, (number(&struck.directions, row), T::ZERO));
    }
}

/// An impact, or a rest: its impulses or forces, and how what touches slides behind it.
#[derive(Clone, Copy)]
pub(crate) struct Struck<T> {
    pub impulses: Each<T>,
    /// The stops that push, and the rows that hold.
    pub held: u32,
    /// The frictions of the stops that were closed.
    pub rubbed: u32,
    /// Their directions: 0 of what sticks.
    pub directions: Each<f64>,
}

/// An impact, or a rest, that is to be answered.
#[derive(Clone, Copy)]
pub(crate) struct Hit<'a, T> {
    pub info: &'a Info,
    /// The stops that are closed, and the rows that hold with any impulse.
    pub closed: u32,
    pub bound: u32,
    /// The frictions that slide in a known direction; the others of closed stops stick, or slide in either.
    pub directions: Each<f64>,
    pub bounds: &'a Bounds<T>,
    /// The rates before it.
    pub rates: &'a Each<T>,
}

impl<T: Real> Hit<'_, T> {
    /// The impulses with which rates become W x + b ≥ 0, b = ġ − ġ⁺ of what is thrown back; nothing where there are none.
    pub fn answer(&self, contacts: &Contacts<'_, T>, b: &Each<T>) -> Option<Struck<T>> {
        // what friction jams throws nothing back
        let thrown = self.with(contacts, b).or_else(|| self.with(contacts, self.rates))?;
        let throws = |row: usize| has(self.closed, row) && number(b, row) != number(self.rates, row);
        if thrown.rubbed == 0 || !(0..MOST_CONTACTS).any(throws) {
            return Some(thrown);
        }
        let (gain, size) = self.gain(contacts, &thrown.impulses);
        if gain <= share::<T>(ROUNDING) * size {
            return Some(thrown);
        }
        let stopped = self.with(contacts, self.rates)?;
        Some(self.between(contacts, [&stopped, &thrown]))
    }

    /// The impulses by Newton's and Coulomb's laws.
    pub fn with(&self, contacts: &Contacts<'_, T>, b: &Each<T>) -> Option<Struck<T>> {
        let rubbed = borne(self.info, self.closed);
        if rubbed == 0 {
            let (held, impulses) = contacts.complementary(self.closed | self.bound, self.bound, b)?;
            return Some(Struck { impulses, held, rubbed, directions: self.directions });
        }
        let (active, mut directions) = Pairs::new(self, contacts, b).states()?;
        // what has no friction does not stick
        let smooth = |row: &usize| self.is_open(*row) && self.bounds.middle(*row)[1] <= 0.0;
        for row in (0..MOST_CONTACTS).filter(smooth) {
            set_direction(&mut directions, row, 1.0);
        }
        let sticks = |row: usize| has(borne(self.info, active), row) && number(&directions, row) == 0.0;
        let held = active | self.bound | those(MOST_CONTACTS, sticks);
        let slides = self.bounds.slides(self.info, |row| number(&directions, row));
        let impulses = contacts.sliding(slides).solve(held, b);
        for row in (0..MOST_CONTACTS).filter(smooth) {
            let (rate, _) = contacts.rate(row, b, &impulses);
            set_direction(&mut directions, row, if rate > 0.0 { 1.0 } else { -1.0 });
        }
        Some(Struck { impulses, held, rubbed, directions })
    }

    /// True of the friction of a closed stop that sticks, or slides in either direction.
    fn is_open(&self, row: usize) -> bool {
        has(borne(self.info, self.closed), row) && number(&self.directions, row) == 0.0
    }

    /// The energy that impulses give, Σ x (ġ + ½ W x), and the sum of the sizes of its terms.
    fn gain(&self, contacts: &Contacts<'_, T>, impulses: &Each<T>) -> (f64, f64) {
        let changes = contacts.rates(impulses);
        (0..contacts.stops()).fold((0.0, 0.0), |(gain, size), row| {
            let x = number(impulses, row);
            let [before, half] = [x * number(self.rates, row), 0.5 * x * number(&changes, row)];
            (gain + before + half, size + before.abs() + half.abs())
        })
    }

    /// The impulses between two that keep the energy: those of the first one do not give any, those of the second one do.
    fn between(&self, contacts: &Contacts<'_, T>, [from, to]: [&Struck<T>; 2]) -> Struck<T> {
        let way: Each<T> = core::array::from_fn(|row| of(&to.impulses, row) - of(&from.impulses, row));
        let [change, of_way] = [contacts.rates(&from.impulses), contacts.rates(&way)];
        let (mut linear, mut square) = (0.0, 0.0);
        for row in 0..contacts.stops() {
            linear += number(&way, row) * (number(self.rates, row) + number(&change, row));
            square += 0.5 * number(&way, row) * number(&of_way, row);
        }
        // c + b s + a s² = 0 with c ≤ 0
        let at_first = self.gain(contacts, &from.impulses).0.min(0.0);
        let root = Real::sqrt(linear * linear - 4.0 * square * at_first);
        let part = match linear >= 0.0 {
            true if linear + root > 0.0 => -2.0 * at_first / (linear + root),
            true => 0.0,
            false => (root - linear) / (2.0 * square),
        };
        let part = T::from_f64(part);
        let impulses = core::array::from_fn(|row| of(&from.impulses, row) + part * of(&way, row));
        let directions = core::array::from_fn(|row| {
            let (rate, _) = contacts.rate(row, self.rates, &impulses);
            let sticks = number(&from.directions, row) == 0.0 && number(&to.directions, row) == 0.0;
            let slides = !sticks && rate != 0.0;
            if slides { if rate > 0.0 { 1.0 } else { -1.0 } } else { 0.0 }
        });
        Struck { impulses, held: from.held | to.held, rubbed: to.rubbed, directions }
    }
}

/// Stops with friction as complementary pairs: x of every stop beside ġ, and for every friction that may stick τ⁺ and τ⁻ beside
/// r + η and η − r, and the speed η beside m x − τ⁺ − τ⁻; its x_s is τ⁺ − τ⁻ − k x, in the middle of its bounds k = (a₊ − a₋)/2
/// and m = (a₊ + a₋)/2. Rows are scaled by √W of their own.
struct Pairs<'a, T> {
    hit: &'a Hit<'a, T>,
    /// The rows: stops, then frictions that may stick.
    rows: [usize; MOST_CONTACTS],
    counts: [usize; 2],
    /// W and b without what is bound, scaled.
    w: [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS],
    scales: Each<f64>,
}

impl<'a, T: Real> Pairs<'a, T> {
    fn new(hit: &'a Hit<'a, T>, contacts: &Contacts<'_, T>, b: &Each<T>) -> Self {
        let sticks = |row: usize| hit.is_open(row) && hit.bounds.middle(row)[1] > 0.0;
        let free = those(MOST_CONTACTS, sticks);
        let (mut rows, mut count, mut counts) = ([0; MOST_CONTACTS], 0, [0; 2]);
        for (set, to) in [(hit.bound, None), (hit.closed, Some(0)), (free, Some(1))] {
            for row in (0..MOST_CONTACTS).filter(|row| has(set, *row)) {
                if let Some(to) = rows.get_mut(count) {
                    (*to, count) = (row, count + 1);
                }
                if let Some(count) = to.and_then(|to: usize| counts.get_mut(to)) {
                    *count += 1;
                }
            }
        }
        // x_s = τ − k x: the middle of the bounds goes with the stop
        let middle = hit.bounds.slides(hit.info, |row| number(&hit.directions, row));
        let mut slides = middle;
        for (row, stop) in rubbing(hit.info).filter(|(row, _)| has(free, *row)) {
            if let Some(to) = slides.get_mut(stop) {
                let [k, _] = hit.bounds.middle(row);
                *to = T::from_f64(-k);
            }
        }
        let contacts = contacts.sliding(slides);
        let mut w = [[0.0; MOST_CONTACTS + 1]; MOST_CONTACTS];
        let members = rows.get(..count).unwrap_or_default();
        for (entries, &of) in w.iter_mut().zip(members) {
            for (entry, &by) in entries.iter_mut().zip(members) {
                *entry = contacts.slid_mobility(of, by).to_f64();
            }
            if let Some(last) = entries.last_mut() {
                *last = number(b, of);
            }
        }
        let bound = count - counts[0] - counts[1];
        without(&mut w, [bound, count]);
        lead_back(&mut rows, bound);
        let scales = core::array::from_fn(|at| match w.get(at).and_then(|row| row.get(at)) {
            Some(own) if *own > 0.0 => 1.0 / Real::sqrt(*own),
            _ => 1.0,
        });
        Self { hit, rows, counts, w, scales }
    }

    /// The stops that push, and the directions of frictions.
    fn states(&self) -> Option<(u32, Each<f64>)> {
        let [stops, frictions] = self.counts;
        let place = |friction: usize, pair: usize| stops + 3 * friction + pair;
        let mut table = Table::new(stops + 3 * frictions);
        // of a row the pairs that have its rate, and of a column those that have its x
        let pairs = |row: usize| match row.checked_sub(stops) {
            None => [Some((row, 1.0)), None],
            Some(friction) => [Some((place(friction, 0), 1.0)), Some((place(friction, 1), -1.0))],
        };
        for of in 0..stops + frictions {
            for (row, sign) in pairs(of).into_iter().flatten() {
                table.set(row, sign * self.scaled(of, None));
                for by in 0..stops + frictions {
                    for (column, by_sign) in pairs(by).into_iter().flatten() {
                        table.add(row, column, sign * by_sign * self.scaled(of, Some(by)));
                    }
                }
            }
        }
        for friction in 0..frictions {
            let [forwards, backwards, speed] = [0, 1, 2].map(|pair| place(friction, pair));
            for row in [forwards, backwards] {
                table.add(row, speed, 1.0);
                table.add(speed, row, -1.0);
            }
            let row = self.row(stops + friction);
            let stop = rubbing(self.hit.info).find(|(of, _)| *of == row)?.1;
            let at = (0..stops).find(|at| self.row(*at) == stop)?;
            let [_, most] = self.hit.bounds.middle(row);
            table.add(speed, at, most * self.scale(at) / self.scale(stops + friction));
        }
        if !table.solve() {
            return None;
        }
        let mut directions = self.hit.directions;
        for friction in 0..frictions {
            let [forwards, backwards, speed] = [0, 1, 2].map(|pair| place(friction, pair));
            // at its bound the force has the sign that a slide gives it, also where others hold what it does not
            let direction = match [forwards, backwards].map(|pair| table.is_active(pair)) {
                _ if !table.is_active(speed) => 0.0,
                [true, true] => 0.0,
                [true, false] => -1.0,
                [false, true] => 1.0,
                [false, false] if table.rest(forwards) > table.rest(backwards) => 1.0,
                [false, false] => -1.0,
            };
            set_direction(&mut directions, self.row(stops + friction), direction);
        }
        let pushing = (0..stops).filter(|at| table.is_active(*at));
        Some((pushing.fold(0, |set, at| set | bit(self.row(at))), directions))
    }

    fn row(&self, at: usize) -> usize {
        self.rows.get(at).copied().unwrap_or(0)
    }

    fn scale(&self, at: usize) -> f64 {
        number(&self.scales, at)
    }

    /// W, or b, scaled.
    fn scaled(&self, of: usize, by: Option<usize>) -> f64 {
        let entry =
            self.w.get(of).and_then(|row| row.get(by.unwrap_or(MOST_CONTACTS))).copied().unwrap_or(0.0);
        entry * self.scale(of) * by.map_or(1.0, |by| self.scale(by))
    }
}

/// Leads entries to the beginning, so many places; the last one of a row of W is b, and stays where it is.
fn lead_back<T: Copy>(entries: &mut [T], places: usize) {
    for to in 0..MOST_CONTACTS {
        let from = entries.get(to + places).copied().filter(|_| to + places < MOST_CONTACTS);
        if let (Some(entry), Some(from)) = (entries.get_mut(to), from) {
            *entry = from;
        }
    }
}

/// Eliminates the first rows and columns, and leads the others to their places.
fn without(w: &mut [[f64; MOST_CONTACTS + 1]; MOST_CONTACTS], [bound, count]: [usize; 2]) {
    let entry = |w: &[[f64; MOST_CONTACTS + 1]; MOST_CONTACTS], row: usize, column: usize| {
        w.get(row).and_then(|row| row.get(column)).copied().unwrap_or(0.0)
    };
    let before: Each<f64> = core::array::from_fn(|at| entry(w, at, at));
    for at in 0..bound {
        let pivot = entry(w, at, at);
        let Some(&above) = w.get(at).filter(|_| pivot > DEPENDENT * number(&before, at)) else { continue };
        for row in w.iter_mut().take(count).skip(at + 1) {
            let factor = row.get(at).copied().unwrap_or(0.0) / pivot;
            for (entry, above) in row.iter_mut().zip(above) {
                *entry -= factor * above;
            }
        }
    }
    for row in w.iter_mut() {
        lead_back(row, bound);
    }
    lead_back(w, bound);
}

fn set_direction(directions: &mut Each<f64>, row: usize, to: f64) {
    if let Some(direction) = directions.get_mut(row) {
        *direction = to;
    }
}

fn of<T: Real>(each: &Each<T>, row: usize) -> T {
    each.get(row).copied().unwrap_or_default()
}
