//! Comments, and the page that explains the files.

use super::target::{Scalar, Target};
use crate::compiled::FunctionId;

/// A text as a comment, which Doxygen reads.
pub fn comment(text: &str, indent: &str) -> String {
    // what would begin or end a comment within it
    let text = text.trim().replace("*/", "* /").replace("/*", "/ *");
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let lines: Vec<String> = lines.iter().map(|line| format!("{indent}    {line}")).collect();
    let lines: Vec<&str> = lines.iter().map(|line| line.trim_end()).collect();
    let text = lines.join("\n");
    let text = text.trim_start();
    if text.is_empty() { String::new() } else { format!("{indent}/** {text} */\n") }
}

/// Fills in a file that builds the code; its version is that of the compiler of mechanisms.
pub fn build(target: &Target<'_>, text: &str) -> String {
    text.replace("{name}", &target.names.prefix)
        .replace("{mechanism}", &target.compiled.name)
        .replace("{version}", env!("CARGO_PKG_VERSION"))
}

/// The page that explains the files.
pub fn readme(target: &Target<'_>) -> String {
    let compiled = target.compiled;
    let step = if compiled.fused_step.is_some() {
        "all stages of a step are one straight line of code"
    } else {
        "a step runs its stages one after the other"
    };
    let precision = match target.scalar {
        Scalar::Double => include_str!("text/double.md"),
        Scalar::Float => include_str!("text/float.md"),
    };
    let stabilized = compiled.count(FunctionId::Stabilized).operations;
    // the name of the mechanism last, because it may be any word
    target
        .fill(include_str!("text/README.md"))
        .replace("PRECISION", precision.trim())
        .replace("ORDER", &compiled.choices.scheme.order.to_string())
        .replace("STAGE", &stabilized.to_string())
        .replace("FUSION", step)
        .replace("{mechanism}", &compiled.name)
}
