//! Rests behind the impacts of a jump: the stops that are rested on, and the frictions that stick.

use super::dynamics::Dynamics;
use super::gaps::Stopping;
use super::jump::{Before, JUMPS, Jump, is_still};
use crate::contact::{Each, MOST_CONTACTS, bit, has, number, those};
use crate::equations::At;
use crate::locks::{locked, placed};
use crate::sticking::{Held, Undecided, all_frictions, decide, direction, frictions, set};
use crate::{Error, Real, modes, rubbing};

/// The gap of a stop that others hold closed moves by no more than this share of what it would without any.
const LEANS: f64 = 1e-6;

impl<D: Dynamics> Jump<'_, D> {
    /// The stops that are rested on and the frictions that stick; the stops that are closed and the frictions that do not
    /// move.
    ///
    /// # Errors
    /// [`Error::Impact`], [`Error::Jammed`], [`Error::Contradiction`].
    pub(super) fn rest(
        &mut self,
        before: &Before<D::Real>,
        stopping: &mut Stopping,
    ) -> Result<[u32; 2], Error> {
        let &Before { reached, held, closed, ref gaps, ref slopes, ref still, is_impact } = before;
        let (info, rates) = (self.dynamics.info(), self.gaps().rate);
        let count = info.stops.len();
        // nothing answers stops that contradict each other
        let is_passed =
            |stop: &usize| has(closed, *stop) && number(&rates, *stop) < -JUMPS * number(still, *stop);
        if let Some(stop) = (0..count).find(is_passed) {
            return Err(self.unanswered(bit(stop)));
        }
        // a stop that pulls is left, and so is one from which the impact throws back
        let pulling = if is_impact { 0 } else { reached & held & !stopping.stuck };
        let stuck = core::mem::take(&mut stopping.stuck);
        let rests = |stop: usize| is_still(&rates, still, stop) || has(stuck, stop);
        let resting = those(count, |stop| has(closed & !pulling, stop) && rests(stop));
        let (friction, locked) = (all_frictions(info), locked(info, self.inputs));
        let left = |row: usize| {
            let slowest = number(still, row).max(self.slowest * number(slopes, row));
            JUMPS * slowest + modes::left_of::<D::Real>(number(&gaps.rate, row).abs())
        };
        modes::do_not_contradict(info, self.t.to_f64(), locked, |row| number(&rates, row), left)?;
        let found = if is_impact { 0 } else { reached };
        let is_halted = |row: usize| number(&rates, row).abs() <= JUMPS * number(still, row);
        let halted = those(MOST_CONTACTS, |row| {
            has(friction & !held, row) && (has(found, row) && is_halted(row) || has(stuck, row))
        });
        let [not_moving, leaving] = self.slide(halted, &rates, still);
        self.clear(resting | placed(info, locked), &gaps.gap, true);
        let breaking = found & held & !stuck | leaving;
        let decided = self.decide(Undecided { resting, still: not_moving, breaking })?;
        let pushing = decided.held;
        let held = self.completed(resting, decided);
        // what friction does not hold keeps its velocity: at a dead centre it would be that of the whole mechanism
        let rates = self.gaps().rate;
        self.clear(resting | locked | held & not_moving, &rates, false);
        stopping.kept = resting & stuck & !held | held & !pushing;
        Ok([held | resting & stuck, closed | not_moving])
    }

    /// The stops that hold, and those that bear nothing yet. A beam on three supports whose load is over the middle one may lean
    /// on either of the others next; without them it would begin to tip before the run sees them close.
    fn completed(&mut self, resting: u32, Held { held, forces }: Held<D::Real>) -> u32 {
        let open = resting & !held;
        if open == 0 {
            return held;
        }
        let (free, slides) =
            (self.gaps().acceleration, rubbing::sliding(self.dynamics.equations(), self.inputs));
        let completed = self.contacts(|contacts| {
            let (contacts, changes) = (contacts.sliding(slides), contacts.rates(&forces));
            let is_still = |stop: usize| {
                let (free, change) = (number(&free, stop), number(&changes, stop));
                free < 0.0 && (free + change).abs() <= LEANS * -free
            };
            (0..MOST_CONTACTS)
                .filter(|stop| has(open, *stop) && is_still(*stop))
                .fold(held, |held, stop| if contacts.depends(stop, held) { held } else { held | bit(stop) })
        });
        completed.unwrap_or(held)
    }

    /// Sets the directions of the frictions that move. Gives those that do not, with those that have come to a halt, and of
    /// them those that have just broken loose, as far as their directions tell.
    fn slide(&mut self, halted: u32, rates: &Each<D::Real>, still: &Each<f64>) -> [u32; 2] {
        let info = self.dynamics.info();
        let (mut not_moving, mut leaving) = (0, 0);
        for (row, _) in frictions(info) {
            if has(halted, row) {
                not_moving |= bit(row);
            } else if is_still(rates, still, row) {
                not_moving |= bit(row);
                leaving |= if direction(info, self.inputs, row) == 0.0 { 0 } else { bit(row) };
            } else {
                let direction = if number(rates, row) > 0.0 { 1.0 } else { -1.0 };
                set(info, self.inputs, row, (direction, D::Real::default()));
            }
        }
        [not_moving, leaving]
    }

    fn decide(&mut self, undecided: Undecided) -> Result<Held<D::Real>, Error> {
        let Self { dynamics, inputs, t, q, v, a, .. } = self;
        let mut lambda = dynamics.no_feedback();
        let at = At { t: *t, q: q.as_ref(), v: v.as_ref() };
        decide(dynamics.equations(), at, inputs, undecided, [a.as_mut(), lambda.as_mut()])
    }
}
