//! Long programs: what repeats itself as loops over memory, the rest in straight lines. The
//! [layout](mbs_symbolic::layout) says what is kept where.

use mbs_symbolic::layout::{Array, Column, Home, Kept, Layout, Loop, Part, Place, Read, Rule};
use mbs_symbolic::{Inconsistency, Operation, Repetition};
use wasm_encoder::{BlockType, MemArg};

use super::memory::word;
use super::planned::Signature;
use super::program::{Printer, fault};
use super::slot::Slot;
use crate::compiled::Vector;

/// The parts of a program that is laid out, and its results.
///
/// # Errors
/// The program reads what the function is not given.
pub fn print(printer: &mut Printer<'_>, layout: &Layout<Vector>) -> Result<(), Inconsistency> {
    for part in &layout.parts {
        match part {
            Part::Straight(part) => printer.straight(part.range.clone(), &part.kept)?,
            Part::Loop(part) => Repeated::new(printer, part).print()?,
        }
    }
    // outside of all parts, everything is read from where it is kept
    printer.begin(0..0);
    for &(operand, place) in &layout.given {
        printer.keep(operand, place)?;
    }
    let Signature { lengths, returns, .. } = &printer.planned.signature;
    let mut places = layout.outputs.iter();
    for (result, &length) in lengths.iter().enumerate() {
        for (at, &place) in (0..length).zip(places.by_ref()) {
            let to = Place { array: Array::Result(result), at };
            if place != to {
                let to = printer.address(to.array, to.at);
                printer.load(place);
                printer.sink().f64_store(to);
            }
        }
    }
    match (returns, places.next()) {
        (true, Some(&place)) => printer.load(place),
        (true, None) => return Err(fault("a function has the number that it returns")),
        (false, _) => {}
    }
    Ok(())
}

/// The copies of the same instructions, one after the other. Every result has a local, and is computed in its turn:
/// what a copy reads may be overwritten by a later step of it.
struct Repeated<'a, 'b> {
    printer: &'a mut Printer<'b>,
    part: &'a Loop<Vector>,
    steps: Vec<u32>,
    carried: Vec<u32>,
    /// The locals of columns that were read in this copy.
    columns: Vec<Option<u32>>,
    /// The addresses of the tables of places.
    tables: Vec<usize>,
}

impl<'a, 'b> Repeated<'a, 'b> {
    fn new(printer: &'a mut Printer<'b>, part: &'a Loop<Vector>) -> Self {
        let Repetition { start, length, .. } = part.repetition;
        printer.begin(start..start + length);
        let steps: Vec<u32> = part.steps.iter().map(|_| printer.local()).collect();
        steps.iter().for_each(|&local| printer.is_in(local));
        let carried = part.carried.iter().map(|_| printer.local()).collect();
        let tables = part.tables.iter().map(|places| printer.memory.places(places)).collect();
        Self { printer, part, steps, carried, columns: vec![None; part.columns.len()], tables }
    }

    fn print(mut self) -> Result<(), Inconsistency> {
        let (part, copy) = (self.part, self.printer.copy);
        for (carried, &local) in part.carried.iter().zip(&self.carried) {
            self.printer.operand(carried.first)?;
            self.printer.sink().local_set(local);
        }
        self.printer.sink().i32_const(0).local_set(copy).loop_(BlockType::Empty);
        for at in 0..part.steps.len() {
            self.step(at)?;
        }
        for (carried, &local) in part.carried.iter().zip(&self.carried) {
            self.printer.sink().local_get(self.steps[carried.from]).local_set(local);
        }
        let end = 8 * part.repetition.count as i32;
        let mut code = self.printer.sink();
        code.local_get(copy).i32_const(8).i32_add().local_tee(copy).i32_const(end).i32_lt_u().br_if(0).end();
        // locals have what the last copy computed
        for (step, &local) in part.steps.iter().zip(&self.steps) {
            if let Kept::Last(place) = step.kept {
                let to = self.printer.address(place.array, place.at);
                self.printer.sink().local_get(local).f64_store(to);
            }
        }
        Ok(())
    }

    fn step(&mut self, at: usize) -> Result<(), Inconsistency> {
        let step = &self.part.steps[at];
        let operation = self.printer.planned.program.instructions[self.part.repetition.start + at].operation;
        let local = self.steps[at];
        if let Some(turn) = operation.turn() {
            // the first of both brings the other
            if step.partner.is_some_and(|partner| partner < at) {
                return Ok(());
            }
            self.read(step.operands[0])?;
            let partner = step.partner.map(|partner| self.steps[partner]);
            self.printer.turn(turn, local, partner);
        } else {
            let count = operation.arity();
            self.operands(operation, &step.operands[..count])?;
            self.printer.sink().local_set(local);
        }
        for at in [Some(at), step.partner].into_iter().flatten() {
            if let Kept::Each(array, rule) = self.part.steps[at].kept {
                let to = self.element(Home::Result(array), rule)?;
                self.printer.sink().local_get(self.steps[at]).f64_store(to);
            }
        }
        Ok(())
    }

    fn operands(&mut self, operation: Operation, reads: &[Read]) -> Result<(), Inconsistency> {
        // columns first: reading one for the first time sets its local
        for &read in reads {
            self.fetch(read)?;
        }
        for &read in reads {
            self.read(read)?;
        }
        self.printer.operation(operation)
    }

    /// Leaves an operand of a step on the stack.
    fn read(&mut self, read: Read) -> Result<(), Inconsistency> {
        self.fetch(read)?;
        let local = match read {
            Read::Same(operand) => return self.printer.operand(operand),
            Read::Own(at) => self.steps[at],
            Read::Carried(at) => self.carried[at],
            Read::Each(at) => self.columns[at].ok_or(fault("a column is read before it is used"))?,
        };
        self.printer.sink().local_get(local);
        Ok(())
    }

    /// Reads what a column has for the copy, when the copy first needs it.
    fn fetch(&mut self, read: Read) -> Result<(), Inconsistency> {
        let Read::Each(at) = read else { return Ok(()) };
        if self.columns[at].is_some() {
            return Ok(());
        }
        let from = match &self.part.columns[at] {
            Column::Numbers(numbers) => {
                let address = self.printer.memory.numbers(numbers.iter().map(|number| number.to_f64()));
                let copy = self.printer.copy;
                self.printer.sink().local_get(copy);
                word(address / 8)
            }
            Column::Elements(home, rule) => self.element(*home, *rule)?,
        };
        let local = self.printer.local();
        self.printer.sink().f64_load(from).local_set(local);
        self.columns[at] = Some(local);
        Ok(())
    }

    /// Leaves the address of an element on the stack that goes with the copy; gives what to add.
    fn element(&mut self, home: Home<Vector>, rule: Rule) -> Result<MemArg, Inconsistency> {
        let (base, first) = self.base(home)?;
        let (copy, at) = (self.printer.copy, |place: usize| 8 * (first + place) as i32);
        let table = match rule {
            Rule::Table(table) => Some(*self.tables.get(table).ok_or(fault("a loop has its tables"))?),
            Rule::Line { .. } => None,
        };
        let mut code = self.printer.sink();
        match base {
            Some(local) => code.local_get(local),
            None => code.i32_const(0),
        };
        Ok(match (rule, table) {
            (Rule::Line { first: place, step, is_down }, _) => {
                // all of it before the distance is taken off, which would lead below 0
                code.i32_const(at(place)).i32_add().local_get(copy);
                if step != 1 {
                    code.i32_const(step as i32).i32_mul();
                }
                if is_down {
                    code.i32_sub()
                } else {
                    code.i32_add()
                };
                word(0)
            }
            (Rule::Table(_), table) => {
                // places are half as long as numbers
                code.local_get(copy).i32_const(1).i32_shr_u();
                code.i32_load(MemArg { align: 2, offset: table.unwrap_or_default() as u64, ..word(0) })
                    .i32_add();
                word(first)
            }
        })
    }

    /// The local with the address of an array, if it is not 0, and the number of its first element.
    fn base(&self, home: Home<Vector>) -> Result<(Option<u32>, usize), Inconsistency> {
        let (slot, first) = match home {
            Home::Result(Array::Slots) => return Ok((None, self.printer.memory.slots() / 8)),
            Home::Result(Array::Result(at)) => return Ok((Some(self.printer.result(at)), 0)),
            Home::Hoisted => (Slot::Mechanism, self.printer.compiled.parameters.len()),
            Home::Vector(vector) => match vector {
                Vector::Parameters => (Slot::Mechanism, 0),
                Vector::Inputs => (Slot::Inputs, 0),
                Vector::Positions | Vector::StatePositions => (Slot::Positions, 0),
                Vector::Velocities | Vector::StateVelocities => (Slot::Velocities, 0),
                Vector::Accelerations => (Slot::Reactions, 0),
                Vector::Multipliers => (Slot::Reactions, self.printer.compiled.coordinates.len()),
                Vector::Feedback => (Slot::Feedback, 0),
                Vector::Predicted => (Slot::Predicted, 0),
                Vector::Weights => return Err(fault("a transposed program is not printed")),
            },
        };
        Ok((Some(self.printer.parameter(slot)?), first))
    }
}
