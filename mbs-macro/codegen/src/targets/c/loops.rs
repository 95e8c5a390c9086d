//! Long programs: what repeats itself as loops, the rest in blocks. The
//! [layout](mbs_symbolic::layout) says what is written where.

use std::collections::BTreeSet;
use std::fmt::Write;

use mbs_symbolic::layout::{
    Array, Column, Home, Kept as Storage, Layout, Loop, Part, Place, Read, Rule, Straight,
};
use mbs_symbolic::{Program, Repetition};

use super::instructions::{Kept, Printer, elements};
use super::target::Target;
use crate::compiled::Vector;

const INSIDE: &str = "        ";
const IN_LOOP: &str = "            ";

/// The statements of a program that is laid out, with results of these lengths; the output
/// behind them may be returned.
pub fn statements(
    target: &Target<'_>,
    program: &Program,
    kept: Kept<'_>,
    lengths: &[usize],
    returns: bool,
) -> String {
    let Layout { slots, parts, given, outputs, .. } = kept.layout;
    // C has no arrays without elements
    let mut text = format!("    real slots[{}];\n", slots.max(&1));
    for part in parts {
        let part = match part {
            Part::Straight(part) => straight(target, program, kept, part),
            Part::Loop(part) => repeated(target, program, kept, part),
        };
        let _ = write!(text, "    {{\n{part}    }}\n");
    }
    let outside = Printer::new(target, program, 0..0, Some(kept), "");
    for (operand, place) in given {
        let _ = writeln!(text, "    {} = {};", kept.element(*place), outside.operand(*operand));
    }
    // those outputs that are not yet where they belong
    let mut places = outputs.iter();
    for (result, &length) in lengths.iter().enumerate() {
        for (at, &place) in (0..length).zip(places.by_ref()) {
            let to = Place { array: Array::Result(result), at };
            if place != to {
                let _ = writeln!(text, "    {} = {};", kept.element(to), kept.element(place));
            }
        }
    }
    if let (true, Some(&place)) = (returns, places.next()) {
        let _ = writeln!(text, "    return {};", kept.element(place));
    }
    text
}

/// Instructions that run once.
fn straight(target: &Target<'_>, program: &Program, kept: Kept<'_>, part: &Straight) -> String {
    let mut printer = Printer::new(target, program, part.range.clone(), Some(kept), INSIDE).instructions();
    for &(at, place) in &part.kept {
        printer.line(&format!("{} = {};", kept.element(place), printer.name(at)));
    }
    printer.text
}

/// The copies of the same instructions, one after the other.
fn repeated(target: &Target<'_>, program: &Program, kept: Kept<'_>, part: &Loop<Vector>) -> String {
    let Repetition { start, length, count } = part.repetition;
    let mut printer = Printer::new(target, program, start..start + length, Some(kept), IN_LOOP);
    let mut columns = Columns { target, kept, part, tables: String::new(), known: BTreeSet::new() };
    let (mut before, mut after, mut next) = (String::new(), String::new(), String::new());
    for (at, carried) in part.carried.iter().enumerate() {
        let _ = writeln!(before, "{INSIDE}real carried{at} = {};", printer.operand(carried.first));
        let _ = writeln!(next, "{IN_LOOP}carried{at} = {};", printer.name(start + carried.from));
    }
    let mut stored = BTreeSet::new();
    for (at, step) in part.steps.iter().enumerate() {
        let operands = step.operands.map(|read| columns.read(read, &mut printer));
        printer.instruction(start + at, operands, step.partner.map(|partner| start + partner));
        // a sine comes with its cosine
        for at in [Some(at), step.partner].into_iter().flatten() {
            if !stored.insert(at) {
                continue;
            }
            let value = printer.name(start + at);
            match part.steps[at].kept {
                Storage::No => {}
                Storage::Each(array, rule) => {
                    let place = columns.place(rule);
                    printer.line(&format!("{}[{place}] = {value};", kept.array(array)));
                }
                Storage::Last(place) => {
                    let _ = writeln!(before, "{INSIDE}real last{at} = 0;");
                    printer.line(&format!("last{at} = {value};"));
                    let _ = writeln!(after, "{INSIDE}{} = last{at};", kept.element(place));
                }
            }
        }
    }
    let (tables, body) = (columns.tables(), printer.text);
    format!(
        "{INSIDE}/* {length} instructions, {count} times */\n{tables}{before}\
         {INSIDE}for (int copy = 0; copy < {count}; copy++) {{\n{body}{next}{INSIDE}}}\n{after}"
    )
}

/// The operands that differ from copy to copy of a loop.
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
    /// The operand in a copy.
    fn read(&mut self, read: Read, printer: &mut Printer<'_>) -> Option<String> {
        Some(match read {
            Read::Same(operand) => printer.operand(operand),
            Read::Own(at) => printer.name(self.part.repetition.start + at),
            Read::Carried(at) => format!("carried{at}"),
            Read::Each(at) => {
                if self.known.insert(at) {
                    let element = self.element(at);
                    printer.line(&format!("const real operand{at} = {element};"));
                }
                format!("operand{at}")
            }
        })
    }

    /// The element of a column for a copy.
    fn element(&mut self, at: usize) -> String {
        let (home, rule) = match &self.part.columns[at] {
            Column::Numbers(numbers) => {
                let count = numbers.len();
                let numbers: Vec<String> =
                    numbers.iter().map(|number| self.target.scalar.literal(number.to_f64())).collect();
                let numbers = lines(&numbers, IN_LOOP);
                let _ = write!(
                    self.tables,
                    "{INSIDE}static const real numbers{at}[{count}] = {{\n{numbers}{INSIDE}}};\n"
                );
                return format!("numbers{at}[copy]");
            }
            Column::Elements(home, rule) => (*home, *rule),
        };
        let place = self.place(rule);
        match home {
            Home::Result(array) => format!("{}[{place}]", self.kept.array(array)),
            Home::Hoisted => format!("m->hoisted[{place}]"),
            Home::Vector(vector) => format!("{}[{place}]", elements(self.target, vector)),
        }
    }

    /// The place that goes with a copy.
    fn place(&self, rule: Rule) -> String {
        match rule {
            Rule::Line { first, step, is_down } => {
                let distance = if step == 1 { "copy".to_owned() } else { format!("{step} * copy") };
                let sign = if is_down { "-" } else { "+" };
                if first == 0 && !is_down { distance } else { format!("{first} {sign} {distance}") }
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
        let (columns, rows) = (tables.len(), lines(&rows, IN_LOOP));
        format!(
            "{}{INSIDE}static const int places[{count}][{columns}] = {{\n{rows}{INSIDE}}};\n",
            self.tables
        )
    }
}

/// Elements of a table, as many in a line as fit there.
pub fn lines(elements: &[String], indent: &str) -> String {
    const WIDTH: usize = 90;
    let mut text = String::from(indent);
    let mut width = 0;
    for element in elements {
        if width > 0 && width + element.len() > WIDTH {
            let _ = write!(text, "\n{indent}");
            width = 0;
        }
        let space = if width > 0 { " " } else { "" };
        let _ = write!(text, "{space}{element},");
        width += element.len() + 2;
    }
    text + "\n"
}
