//! Time to compile a long chain: `mechanism!` alone, in this process, and with `-- --compile` a crate around
//! it, by cargo.

mod release;

use std::env;
use std::error::Error;
use std::process::ExitCode;
use std::time::Instant;

use proc_macro2::TokenStream;

/// A declaration of a chain.
struct Chain {
    name: &'static str,
    /// Links, or four-bars.
    n: usize,
    coordinates: usize,
    text: &'static str,
}

macro_rules! chains {
    ($($n:tt)*) => {[
        $(Chain {
            name: "pendulum",
            n: $n,
            coordinates: 3 * $n,
            text: tests::pendulum!(stringify; Chain $n),
        },)*
        $(Chain {
            name: "four-bar",
            n: $n,
            coordinates: 3 * (2 * $n + 1),
            text: tests::four_bar!(stringify; Chain $n),
        },)*
    ]};
}

const CHAINS: [Chain; 8] = chains!(1 10 40 200);

/// Repetitions, of which the quickest counts.
const REPETITIONS: usize = 3;

fn main() -> ExitCode {
    let has = |flag: &str| env::args().any(|argument| argument == flag);
    // `cargo test --benches` runs this without the flag: short chains, once
    let result = if has("--bench") { print(has("--compile")) } else { check() };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            println!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn check() -> Result<(), Box<dyn Error>> {
    for chain in CHAINS.iter().filter(|chain| chain.n <= 10) {
        let (_, expansion) = expanded(chain)?;
        if written(&expansion) == 0 {
            return Err(format!("{} {}: no instructions are described", chain.name, chain.n).into());
        }
    }
    Ok(())
}

fn print(with_compilation: bool) -> Result<(), Box<dyn Error>> {
    println!("expansion in process, least of {REPETITIONS}");
    println!(
        "{:14} {:>12} {:>8} {:>12} {:>14} {:>10}",
        "", "coordinates", "s", "ms per N", "instructions", "tokens"
    );
    for chain in &CHAINS {
        let mut least = f64::INFINITY;
        let mut expansion = TokenStream::new();
        for _ in 0..REPETITIONS {
            let (seconds, tokens) = expanded(chain)?;
            least = least.min(seconds);
            expansion = tokens;
        }
        println!(
            "{:14} {:12} {least:8.3} {:12.2} {:14} {:10}",
            format!("{} {}", chain.name, chain.n),
            chain.coordinates,
            1e3 * least / chain.n as f64,
            written(&expansion),
            count(expansion)
        );
    }
    if with_compilation { release::print(CHAINS.iter().filter(|chain| chain.n >= 10)) } else { Ok(()) }
}

/// Seconds from the tokens of a declaration to those of its solver, and these.
fn expanded(chain: &Chain) -> Result<(f64, TokenStream), Box<dyn Error>> {
    // all within braces, behind `pub Chain`, as the macro is given it
    let declaration: TokenStream = chain.text.parse()?;
    let start = Instant::now();
    let expansion = mbs_codegen::compile(declaration)
        .map_err(|_| format!("{} {} does not compile", chain.name, chain.n))?;
    Ok((start.elapsed().as_secs_f64(), expansion))
}

/// Instructions in the text of all functions, as they describe it themselves.
fn written(expansion: &TokenStream) -> u64 {
    let text = expansion.to_string();
    let after = text.split("written :").skip(1);
    let number =
        |after: &str| after.trim_start().split(|c: char| !c.is_ascii_digit()).next()?.parse::<u64>().ok();
    after.filter_map(number).sum()
}

fn count(tokens: TokenStream) -> usize {
    let tokens = tokens.into_iter().map(|token| match token {
        proc_macro2::TokenTree::Group(group) => 2 + count(group.stream()),
        _ => 1,
    });
    tokens.sum()
}
