//! Long programs: what repeats itself as loops, the rest in blocks. The
//! [layout](mbs_symbolic::layout) says what is written where.

use std::collections::BTreeSet;
use std::fmt::Write;

use mbs_symbolic::layout::{Array, Column, Home, Kept as Storage, Loop, Part, Place, Read, Rule, Straight};
use mbs_symbolic::{Inconsistency, Program, Repetition};

use super::Target;
use super::instructions::{Kept, Printer, elements};
use crate::compiled::Vector;

/// What ends a loop whose steps do not fit together.
const CARRIED: Inconsistency = Inconsistency { pass: "C", rule: "a loop carries results of its own" };

const INSIDE: &str = "        ";
const IN_LOOP: &str = "            ";

/// The statements of a program that is laid out, up to its outputs.
///
/// # Errors
/// A result is read that is not kept.
pub fn parts(target: &Target<'_>, program: &Program, kept: Kept<'_>) -> Result<String, Inconsistency> {
    // C has no arrays without elements
    let mut text = format!("    real slots[{}];\n", kept.layout.slots.max(1));
    for part in &kept.layout.parts {
        let part = match part {
            Part::Straight(part) => straight(target, program, kept, part)?,
            Part::Loop(part) => repeated(target, program, kept, part)?,
        };
        let _ = write!(text, "    {{\n{part}    }}\n");
    }
    let outside = Printer::new(target, program, 0..0, Some(kept), "");
    for (operand, place) in &kept.layout.given {
        let _ = writeln!(text, "    {} = {};", kept.element(*place)?, outside.operand(*operand)?);
    }
    Ok(text)
}

/// Statements that copy those of the outputs of a result that are not there yet.
///
/// # Errors
/// There is no such result.
pub fn gather(kept: Kept<'_>, result: usize, outputs: &[Place]) -> Result<String, Inconsistency> {
    let to = kept.array(Array::Result(result))?;
    let moves = outputs.iter().enumerate().filter(|(_, place)| place.array == Array::Slots);
    let moves: Vec<String> = moves.map(|(to, from)| format!("{{{to}, {}}}", from.at)).collect();
    if moves.is_empty() {
        return Ok(String::new());
    }
    let (count, moves) = (moves.len(), lines(&moves, INSIDE));
    Ok(format!(
        "    {{\n{INSIDE}static const int places[{count}][2] = {{\n{moves}{INSIDE}}};\n\
         {INSIDE}for (int at = 0; at < {count}; at++) {{\n\
         {IN_LOOP}{to}[places[at][0]] = slots[places[at][1]];\n{INSIDE}}}\n    }}\n"
    ))
}

/// Instructions that run once.
fn straight(
    target: &Target<'_>,
    program: &Program,
    kept: Kept<'_>,
    part: &Straight,
) -> Result<String, Inconsistency> {
    let mut printer = Printer::new(target, program, part.range.clone(), Some(kept), INSIDE);
    for at in part.range.clone() {
        printer.instruction(at, [None, None])?;
    }
    for &(at, place) in &part.kept {
        printer.line(&format!("{} = {};", kept.element(place)?, printer.name(at)));
    }
    Ok(printer.text)
}

/// The copies of the same instructions, one after the other.
fn repeated(
    target: &Target<'_>,
    program: &Program,
    kept: Kept<'_>,
    part: &Loop<Vector>,
) -> Result<String, Inconsistency> {
    let Repetition { start, length, count } = part.repetition;
    let mut printer = Printer::new(target, program, start..start + length, Some(kept), IN_LOOP);
    let mut columns = Columns { target, kept, part, tables: String::new(), known: BTreeSet::new() };
    let (mut before, mut after, mut next) = (String::new(), String::new(), String::new());
    for (at, step) in part.steps.iter().enumerate() {
        if step.partner.is_none() {
            printer.set_apart(start + at);
        }
    }
    for (at, carried) in part.carried.iter().enumerate() {
        let from = carried.from;
        if from >= length {
            return Err(CARRIED);
        }
        let _ = writeln!(before, "{INSIDE}real carried{at} = {};", printer.operand(carried.first)?);
        let _ = writeln!(next, "{IN_LOOP}carried{at} = {};", printer.name(start + from));
    }
    let mut stored = BTreeSet::new();
    for (at, step) in part.steps.iter().enumerate() {
        let mut operands = [None, None];
        for (operand, read) in operands.iter_mut().zip(step.operands) {
            *operand = columns.read(read, &mut printer)?;
        }
        printer.instruction(start + at, operands)?;
        // a sine comes with its cosine
        for at in [Some(at), step.partner].into_iter().flatten() {
            if !printer.is_printed(start + at) || !stored.insert(at) {
                continue;
            }
            let value = printer.name(start + at);
            match part.steps[at].kept {
                Storage::No => {}
                Storage::Each(array, rule) => {
                    let place = columns.place(rule);
                    printer.line(&format!("{}[{place}] = {value};", kept.array(array)?));
                }
                Storage::Last(place) => {
                    let _ = writeln!(before, "{INSIDE}real last{at} = 0;");
                    printer.line(&format!("last{at} = {value};"));
                    let _ = writeln!(after, "{INSIDE}{} = last{at};", kept.element(place)?);
                }
            }
        }
    }
    let (tables, body) = (columns.tables(), printer.text);
    Ok(format!(
        "{INSIDE}/* {length} instructions, {count} times */\n{tables}{before}\
         {INSIDE}for (int copy = 0; copy < {count}; copy++) {{\n{body}{next}{INSIDE}}}\n{after}"
    ))
}

/// What differs from copy to copy of a loop.
struct Columns<'a> {
    target: &'a Target<'a>,
    kept: Kept<'a>,
    part: &'a Loop<Vector>,
    /// The numbers that copies read.
    tables: String,
    /// The columns that a variable of the copy holds.
    known: BTreeSet<usize>,
}

impl Columns<'_> {
    /// The operand in a copy; `None` if it reads as in straight instructions.
    fn read(&mut self, read: Read, printer: &mut Printer<'_>) -> Result<Option<String>, Inconsistency> {
        let start = self.part.repetition.start;
        Ok(match read {
            Read::Same(operand) => Some(printer.operand(operand)?),
            Read::Own(at) => Some(printer.name(start + at)),
            Read::Carried(at) => Some(format!("carried{at}")),
            Read::Each(at) => {
                if self.known.insert(at) {
                    let element = self.element(at)?;
                    printer.line(&format!("const real operand{at} = {element};"));
                }
                Some(format!("operand{at}"))
            }
        })
    }

    /// What a column has for a copy.
    fn element(&mut self, at: usize) -> Result<String, Inconsistency> {
        let (home, rule) = match &self.part.columns[at] {
            Column::Numbers(numbers) => {
                let count = numbers.len();
                let numbers: Vec<String> =
                    numbers.iter().map(|number| self.target.scalar.literal(number.to_f64())).collect();
                let numbers = lines(&numbers, INSIDE);
                let _ = write!(
                    self.tables,
                    "{INSIDE}static const real numbers{at}[{count}] = {{\n{numbers}{INSIDE}}};\n"
                );
                return Ok(format!("numbers{at}[copy]"));
            }
            Column::Elements(home, rule) => (*home, *rule),
        };
        let place = self.place(rule);
        Ok(match home {
            Home::Result(array) => format!("{}[{place}]", self.kept.array(array)?),
            Home::Hoisted => format!("m->hoisted[{place}]"),
            Home::Vector(vector) => format!("{}[{place}]", elements(self.target, vector)),
        })
    }

    /// The place that goes with a copy.
    fn place(&self, rule: Rule) -> String {
        match rule {
            Rule::Line { first, step, is_down } => {
                let distance = if step == 1 { "copy".to_owned() } else { format!("{step} * copy") };
                match (first, is_down) {
                    (0, false) => distance,
                    (_, false) => format!("{first} + {distance}"),
                    (_, true) => format!("{first} - {distance}"),
                }
            }
            Rule::Table(table) => format!("places[copy][{table}]"),
        }
    }

    /// The tables that stand before the loop.
    fn tables(&self) -> String {
        let (tables, count) = (&self.part.tables, self.part.repetition.count);
        if tables.is_empty() {
            return self.tables.clone();
        }
        let row = |copy: usize| {
            let places: Vec<String> = tables.iter().map(|table| table[copy].to_string()).collect();
            format!("{{{}}}", places.join(", "))
        };
        let rows: Vec<String> = (0..count).map(row).collect();
        let (columns, rows) = (tables.len(), lines(&rows, INSIDE));
        format!(
            "{}{INSIDE}static const int places[{count}][{columns}] = {{\n{rows}{INSIDE}}};\n",
            self.tables
        )
    }
}

/// Elements of a table, as many in a line as fit there.
fn lines(elements: &[String], indent: &str) -> String {
    const WIDTH: usize = 90;
    let mut text = String::new();
    let mut line = String::new();
    for element in elements {
        if !line.is_empty() && line.len() + element.len() > WIDTH {
            let _ = writeln!(text, "{indent}   {line}");
            line.clear();
        }
        let _ = write!(line, " {element},");
    }
    let _ = writeln!(text, "{indent}   {line}");
    text
}
