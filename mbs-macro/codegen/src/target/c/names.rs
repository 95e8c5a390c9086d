//! Names of the declaration as names of C.

use std::collections::BTreeSet;

use crate::compiled::{Compiled, Vector};

/// The names of a printed mechanism.
pub struct Names {
    /// What every name at file level begins with: `slider_crank`.
    pub prefix: String,
    /// What every constant begins with: `SLIDER_CRANK`.
    pub capitals: String,
    parameters: Vec<String>,
    inputs: Vec<String>,
    coordinates: Vec<String>,
    constraints: Vec<String>,
    /// The members of the outputs.
    pub outputs: Vec<String>,
}

impl Names {
    pub fn new(compiled: &Compiled) -> Self {
        let prefix = mended(&snake_case(&compiled.name), &mut BTreeSet::new());
        Self {
            capitals: prefix.to_uppercase(),
            prefix,
            parameters: members(compiled.parameters.iter().map(|parameter| &parameter.quantity.name)),
            inputs: members(compiled.inputs.iter().map(|input| &input.name)),
            coordinates: members(compiled.coordinates.iter().map(|coordinate| &coordinate.name)),
            constraints: members(compiled.constraints.iter().map(|constraint| &constraint.name)),
            outputs: members(compiled.outputs.iter().map(|output| &output.name)),
        }
    }

    /// The members of the struct that holds a vector.
    pub fn members(&self, vector: Vector) -> &[String] {
        match vector {
            Vector::Parameters => &self.parameters,
            Vector::Inputs => &self.inputs,
            Vector::Positions | Vector::Velocities | Vector::Accelerations => &self.coordinates,
            Vector::Multipliers | Vector::Feedback => &self.constraints,
        }
    }
}

fn members<'a>(names: impl Iterator<Item = &'a String>) -> Vec<String> {
    let mut taken = BTreeSet::new();
    names.map(|name| mended(name, &mut taken)).collect()
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
const RESERVED: &str = "\
    auto break case char const continue default do double else enum extern float for goto if inline int long \
    register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while \
    alignas alignof bool constexpr false nullptr static_assert thread_local true typeof typeof_unqual \
    and and_eq asm bitand bitor catch char16_t char32_t char8_t class co_await co_return co_yield compl concept \
    const_cast consteval constinit decltype delete dynamic_cast explicit export friend mutable namespace new \
    noexcept not not_eq operator or or_eq private protected public reinterpret_cast requires static_cast template \
    this throw try typeid typename using virtual wchar_t xor xor_eq \
    NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL MATH_ERRNO MATH_ERREXCEPT math_errhandling NULL EOF I complex errno \
    linux unix i386 arm assert ctype fenv inttypes iso646 limits locale math setjmp signal stdarg stdbool stddef \
    stdint stdio stdlib string tgmath time wchar wctype main";

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
        let names = ["int", "int_", "r#type", "θ", "u3b8", "x1", "M_PI"].map(str::to_owned);
        let mended = members(names.iter());
        assert_eq!(mended, ["int_", "int__", "type", "u3b8", "u3b8_", "x1", "M_PI_"]);
        assert_eq!(super::mended("math", &mut BTreeSet::new()), "math_");
    }
}
