//! Names of the declaration as names of C.

use std::collections::BTreeSet;

use crate::compiled::{Compiled, Constraint, Results, Vector};
use crate::targets::words::{coordinate, input, quantity};

/// The names of a printed mechanism.
pub struct Names {
    /// The beginning of every name at file level: `slider_crank`.
    pub prefix: String,
    /// The beginning of every constant: `SLIDER_CRANK`.
    pub capitals: String,
    /// Those of parameters, inputs, coordinates, constraints and outputs, and of the coordinates
    /// that are integrated where these are not all.
    pub structs: Vec<Struct>,
}

/// A struct of numbers.
pub struct Struct {
    /// The kind of its numbers, in the plural.
    pub name: &'static str,
    pub doc: &'static str,
    pub members: Vec<Member>,
}

/// A number with a name.
pub struct Member {
    /// As it is declared.
    pub declared: String,
    /// As C takes it.
    pub name: String,
    pub doc: String,
}

impl Names {
    pub fn new(compiled: &Compiled) -> Self {
        let prefix = mended(&snake_case(&compiled.name), &mut BTreeSet::new());
        let outputs = compiled.outputs.iter().map(|it| (&it.name, quantity(it, None)));
        let parameters = compiled.parameters.iter().map(|it| (&it.quantity, it.value));
        let parameters = parameters.map(|(it, value)| (&it.name, quantity(it, Some(value))));
        let inputs = compiled.inputs.iter().map(|it| (&it.quantity.name, input(it)));
        let coordinates = compiled.coordinates.iter().enumerate();
        let coordinates = members(coordinates.map(|(at, it)| (&it.name, coordinate(compiled, at))));
        let constraints = compiled.constraints.iter().map(|it| (&it.name, constraint(it)));
        let mut structs = vec![
            ("parameters", "Numbers that are set once.", members(parameters)),
            ("inputs", "Numbers that may change from step to step.", members(inputs)),
            ("coordinates", "The coordinates, or their rates per second.", coordinates),
            ("constraints", ROWS, members(constraints)),
            ("outputs", "What the declaration measures.", members(outputs)),
        ];
        if compiled.has_reduced_states() {
            let states =
                compiled.states.iter().map(|&at| (&compiled.coordinates[at].name, coordinate(compiled, at)));
            let states = members(states);
            structs.push((
                "states",
                "The coordinates that are integrated, or their rates per second.",
                states,
            ));
        }
        let structs = structs.into_iter().map(|(name, doc, members)| Struct { name, doc, members });
        Self { capitals: prefix.to_uppercase(), prefix, structs: structs.collect() }
    }

    /// The structs whose members have names of their own.
    pub fn named(&self) -> impl Iterator<Item = &Struct> {
        self.structs.iter().take(STATES)
    }

    /// The struct that holds the coordinates that are integrated.
    pub fn states(&self) -> &Struct {
        self.structs.get(STATES).unwrap_or(&self.structs[COORDINATES])
    }

    /// The struct that holds a vector.
    pub fn of(&self, vector: Vector) -> &Struct {
        match vector {
            Vector::Parameters => &self.structs[PARAMETERS],
            Vector::Inputs => &self.structs[INPUTS],
            Vector::Positions | Vector::Velocities | Vector::Accelerations => &self.structs[COORDINATES],
            Vector::StatePositions | Vector::StateVelocities | Vector::Predicted => self.states(),
            // a direction, which weights are, is an array and has no struct
            Vector::Multipliers | Vector::Feedback | Vector::Weights => &self.structs[CONSTRAINTS],
        }
    }

    /// The struct that holds results; `None` of an array.
    pub fn of_results(&self, results: Results) -> Option<&Struct> {
        match results {
            Results::Coordinates => Some(&self.structs[COORDINATES]),
            Results::States => Some(self.states()),
            Results::Constraints => Some(&self.structs[CONSTRAINTS]),
            Results::Outputs => Some(&self.structs[OUTPUTS]),
            _ => None,
        }
    }
}

/// Where the structs stand.
const PARAMETERS: usize = 0;
const INPUTS: usize = 1;
const COORDINATES: usize = 2;
const CONSTRAINTS: usize = 3;
const OUTPUTS: usize = 4;
const STATES: usize = 5;

const ROWS: &str =
    "One number per constraint: its violation, its multiplier, or an amount added to its right-hand side.";

fn members<'a>(declared: impl Iterator<Item = (&'a String, String)>) -> Vec<Member> {
    let mut taken = BTreeSet::new();
    let member = |(name, doc): (&String, String)| Member {
        declared: name.clone(),
        name: mended(name, &mut taken),
        doc,
    };
    declared.map(member).collect()
}

/// The documentation of a constraint: its doc comment and its equation.
fn constraint(constraint: &Constraint) -> String {
    format!("{}\n\n`{} = 0`", constraint.doc, constraint.formula)
}

/// A name that C takes and nobody has yet.
fn mended(name: &str, taken: &mut BTreeSet<String>) -> String {
    let mut name = plain(name);
    while is_reserved(&name) || taken.contains(&name) {
        name.push('_');
    }
    taken.insert(name.clone());
    name
}

/// A name in the letters that every C compiler knows: `θ` becomes `u3b8`.
pub fn plain(name: &str) -> String {
    let name = name.strip_prefix("r#").unwrap_or(name);
    let letter = |c: char| match c {
        'a'..='z' | 'A'..='Z' | '0'..='9' | '_' => c.to_string(),
        _ => format!("u{:x}", u32::from(c)),
    };
    name.chars().map(letter).collect()
}

/// `SliderCrank` becomes `slider_crank`, and `VEngine` becomes `v_engine`.
fn snake_case(name: &str) -> String {
    let letters: Vec<char> = name.chars().collect();
    let mut snake = String::new();
    for (at, &letter) in letters.iter().enumerate() {
        let follows_small = at > 0 && !letters[at - 1].is_uppercase() && letters[at - 1] != '_';
        let begins_word =
            at > 0 && letters[at - 1] != '_' && letters.get(at + 1).is_some_and(|next| next.is_lowercase());
        if letter.is_uppercase() && (follows_small || begins_word) {
            snake.push('_');
        }
        snake.extend(letter.to_lowercase());
    }
    snake
}

/// Keywords of C and C++, macros of the headers that the code includes, and headers whose
/// file a mechanism must not replace, nor that of the example.
const RESERVED: &str = include_str!("text/reserved.txt");

fn is_reserved(name: &str) -> bool {
    // no macro of the headers ends like a mended name
    let is_macro = !name.ends_with('_') && (name.starts_with("M_") || name.starts_with("FP_"))
        || name.ends_with("_MAX")
        || name.ends_with("_MIN");
    is_macro || RESERVED.split_whitespace().any(|word| word == name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_become_prefixes() {
        let cases = [
            ("SliderCrank", "slider_crank"),
            ("VEngine", "v_engine"),
            ("NFourBar", "n_four_bar"),
            ("Pendulum40", "pendulum40"),
            ("PaperDFT", "paper_dft"),
            ("already_plain", "already_plain"),
        ];
        for (name, prefix) in cases {
            assert_eq!(snake_case(name), prefix);
        }
    }

    #[test]
    fn words_of_c_are_mended_and_no_name_is_given_twice() {
        let mut taken = BTreeSet::new();
        let mended =
            ["int", "int_", "r#type", "θ", "u3b8", "x1", "M_PI"].map(|name| mended(name, &mut taken));
        assert_eq!(mended, ["int_", "int__", "type", "u3b8", "u3b8_", "x1", "M_PI_"]);
        assert_eq!(super::mended("math", &mut BTreeSet::new()), "math_");
    }
}
