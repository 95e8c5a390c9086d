//! The functions of a mechanism, one for each program.

use std::collections::BTreeSet;

use mbs_symbolic::{Block, Inconsistency, Operand, Operations, Program};

use super::Target;
use super::docs::comment;
use super::instructions::{Kept, Printer, argument};
use super::loops;
use crate::compiled::{Argument, Count, FunctionId, Programs, Results, Vector};

/// A function of C.
pub struct Kernel {
    /// What it does, for a comment.
    pub doc: String,
    /// Its head, without a semicolon.
    pub head: String,
    pub body: String,
    /// Whether others than the code itself may call it.
    pub is_public: bool,
}

impl Kernel {
    /// The function; the comment of a public one stands in the header.
    pub fn text(&self) -> String {
        let Self { doc, head, body, is_public } = self;
        let doc = if *is_public { String::new() } else { comment(doc, "") };
        format!("{doc}{head}\n{{\n{body}}}\n\n")
    }
}

/// A struct or an array that a function writes its results into.
struct Output {
    name: &'static str,
    kind: Results,
}

/// The functions, in their order.
///
/// # Errors
/// A program is not written as it was checked.
pub fn all(target: &Target<'_>) -> Result<Vec<Kernel>, Inconsistency> {
    FunctionId::all().map(|id| kernel(target, id)).collect()
}

fn kernel(target: &Target<'_>, id: FunctionId) -> Result<Kernel, Inconsistency> {
    let program = target.compiled.program(id);
    let Count { operations, watch, .. } = target.compiled.count(id);
    let is_public = !matches!(id, FunctionId::Hoisted | FunctionId::Conditions);
    let outputs = outputs(id);
    let returns = matches!(id.results().last(), Some(Results::Scalar | Results::Growth));
    let mut arguments = vec![("const struct NAME *", "m")];
    arguments.extend(id.arguments().iter().map(|&argument| argument_of(argument)));
    let is_static = if is_public { "" } else { "static " };
    let result = if returns { "NAME_real" } else { "void" };
    let name = if id == FunctionId::Hoisted { "hoisted" } else { id.name() };
    let written = outputs.iter().map(|output| (type_of(output.kind), output.name));
    let declarations: Vec<_> =
        arguments.iter().copied().chain(written).map(|(of, name)| format!("{of}{name}")).collect();
    let head = format!("{is_static}{result} NAME_compute_{name}(\n    {})", declarations.join(",\n    "));
    let empty = outputs.iter().filter(|output| target.compiled.length(output.kind) == 0);
    let names = arguments.iter().map(|(_, name)| *name).chain(empty.map(|output| output.name));
    let unused = unused(target, program, names);
    let blocks = target.compiled.blocks(program);
    let statements = statements(target, program, &blocks, &outputs, returns)?;
    Ok(Kernel {
        doc: format!("{}\nCost: {}.", doc(id), cost(&operations, watch)),
        head: target.fill(&head),
        body: format!("{unused}{statements}"),
        is_public,
    })
}

/// A whole step as one program, for both kinds of feedback; nothing if the mechanism is too large.
///
/// # Errors
/// A program is not written as it was checked.
pub fn fused(target: &Target<'_>) -> Result<Vec<Kernel>, Inconsistency> {
    let Some(step) = &target.compiled.fused_step else { return Ok(Vec::new()) };
    let Programs { held, per_stage, .. } = &step.alone.programs;
    let kinds = [("held", "held over it", held), ("per_stage", "in both stages", per_stage)];
    kinds.into_iter().map(|(name, how, program)| fused_step(target, name, how, program)).collect()
}

fn fused_step(
    target: &Target<'_>,
    name: &str,
    how: &str,
    program: &Program,
) -> Result<Kernel, Inconsistency> {
    let given = ["m", "t", "q", "v", "inputs", "gains", "h", "half_h", "t_next"];
    let unused = unused(target, program, given.into_iter());
    let mut printer = Printer::new(target, program, 0..program.instructions.len(), None, "    ");
    for at in 0..program.instructions.len() {
        printer.instruction(at, [None, None])?;
    }
    let members = target.names.members(Vector::Positions);
    let places = ["q", "v"].into_iter().flat_map(|vector| members.iter().map(move |member| (vector, member)));
    let mut values = program.outputs.iter();
    for ((vector, member), &value) in places.zip(values.by_ref()) {
        let value = printer.operand(value)?;
        printer.line(&format!("next.{vector}.{member} = {value};"));
        printer.line(&format!("sum += {value};"));
    }
    if let Some(&growth) = values.next() {
        let growth = printer.operand(growth)?;
        printer.line("/* the sum is finite only if every component is */");
        printer.line(
            &target.fill(&format!("const int is_taken = isfinite(sum) && NAME_take(run, &next, {growth});")),
        );
        printer.line(&target.fill("return is_taken ? CAPS_OK : NAME_step_again(run, t_next);"));
    }
    let given = target.fill(include_str!("text/step_fused_head.c"));
    let cost = cost(&program.operations(), 0);
    Ok(Kernel {
        doc: format!("A step with the feedback {how}, both stages in one.\nCost: {cost}."),
        head: target.fill(&format!("static int NAME_step_{name}(struct NAME_run *run, real t_next)")),
        body: format!("{given}{unused}{}", printer.text),
        is_public: false,
    })
}

/// Statements that run a program and write its outputs.
fn statements(
    target: &Target<'_>,
    program: &Program,
    blocks: &[Block],
    outputs: &[Output],
    returns: bool,
) -> Result<String, Inconsistency> {
    let compiled = target.compiled;
    let lengths: Vec<usize> = outputs.iter().map(|output| compiled.length(output.kind)).collect();
    let range = match blocks {
        [] => 0..0,
        [Block::Straight(range)] => range.clone(),
        _ => {
            let layout = compiled.layout(program, blocks, &lengths)?;
            let results: Vec<String> = outputs.iter().map(|output| array(target, output)).collect();
            let kept = Kept { layout: &layout, results: &results };
            let mut text = loops::parts(target, program, kept)?;
            let mut places = &layout.outputs[..];
            for (at, &length) in lengths.iter().enumerate() {
                let (here, rest) = places.split_at(length);
                text += &loops::gather(kept, at, here)?;
                places = rest;
            }
            if let (true, Some(place)) = (returns, places.first()) {
                text += &format!("    return {};\n", kept.element(*place)?);
            }
            return Ok(text);
        }
    };
    let mut printer = Printer::new(target, program, range.clone(), None, "    ");
    for at in range {
        printer.instruction(at, [None, None])?;
    }
    let mut values = program.outputs.iter();
    for (output, length) in outputs.iter().zip(lengths) {
        for (at, &value) in (0..length).zip(values.by_ref()) {
            printer.line(&format!("{} = {};", member(target, output, at), printer.operand(value)?));
        }
    }
    if let (true, Some(&value)) = (returns, values.next()) {
        printer.line(&format!("return {};", printer.operand(value)?));
    }
    Ok(printer.text)
}

/// Statements without effect for arguments that a program does not read.
fn unused(target: &Target<'_>, program: &Program, arguments: impl Iterator<Item = &'static str>) -> String {
    let of_instructions = program.instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]);
    let used: BTreeSet<&str> = of_instructions
        .chain(program.outputs.iter().copied())
        .filter_map(|operand| match operand {
            Operand::Hoisted(_) => Some("m"),
            other => target.compiled.input_of(other).map(argument),
        })
        .collect();
    let unused: Vec<String> =
        arguments.filter(|name| !used.contains(name)).map(|name| format!("(void){name};")).collect();
    if unused.is_empty() { String::new() } else { format!("    {}\n", unused.join(" ")) }
}

/// The type of an argument, and its name.
fn argument_of(argument: Argument) -> (&'static str, &'static str) {
    match argument {
        Argument::Time => ("NAME_real ", "t"),
        Argument::Positions => ("const struct NAME_coordinates *", "q"),
        Argument::Velocities => ("const struct NAME_coordinates *", "v"),
        Argument::Inputs => ("const struct NAME_inputs *", "inputs"),
        Argument::Gains => ("const struct NAME_gains *", "gains"),
        Argument::Feedback => ("const struct NAME_constraints *", "feedback"),
        Argument::Reactions => ("const struct NAME_reactions *", "reactions"),
    }
}

/// The type that results are written into.
fn type_of(kind: Results) -> &'static str {
    match kind {
        Results::Coordinates => "struct NAME_coordinates *",
        Results::Constraints => "struct NAME_constraints *",
        Results::Outputs => "struct NAME_outputs *",
        _ => "NAME_real *",
    }
}

/// What a function writes; a last single number is returned.
fn outputs(id: FunctionId) -> Vec<Output> {
    let names: &[&'static str] = match id {
        FunctionId::Hoisted => &["hoisted"],
        FunctionId::Phi => &["phi"],
        FunctionId::PhiDot => &["phi_dot"],
        FunctionId::PhiQ => &["entries"],
        FunctionId::PhiT => &["phi_t"],
        FunctionId::Gamma => &["gamma"],
        FunctionId::BaumgarteRhs => &["rhs"],
        FunctionId::Mass => &["mass"],
        FunctionId::Forces => &["forces"],
        FunctionId::KineticEnergy | FunctionId::PotentialEnergy => &[],
        FunctionId::Stabilized => &["acceleration", "feedback"],
        FunctionId::Constrained => &["acceleration"],
        FunctionId::Reactions => &["acceleration", "multipliers"],
        FunctionId::PositionCorrection | FunctionId::VelocityCorrection => &["correction"],
        FunctionId::Outputs => &["outputs"],
        FunctionId::Conditions => &["values"],
        FunctionId::Start => &["q", "v"],
        FunctionId::Pivots | FunctionId::StartPivots => &["growths"],
        FunctionId::Points => &["places"],
    };
    id.results().iter().zip(names).map(|(&kind, &name)| Output { name, kind }).collect()
}

/// The members of the struct that results are written into; `None` of an array.
fn members<'a>(target: &'a Target<'_>, kind: Results) -> Option<&'a [String]> {
    match kind {
        Results::Coordinates => Some(target.names.members(Vector::Positions)),
        Results::Constraints => Some(target.names.members(Vector::Multipliers)),
        Results::Outputs => Some(&target.names.outputs),
        _ => None,
    }
}

/// An output as an array.
fn array(target: &Target<'_>, output: &Output) -> String {
    match members(target, output.kind) {
        Some(_) => format!("{}_places({})", target.names.prefix, output.name),
        None => output.name.to_owned(),
    }
}

/// A number of an output.
fn member(target: &Target<'_>, output: &Output, at: usize) -> String {
    match members(target, output.kind) {
        Some(members) => format!("{}->{}", output.name, members[at]),
        None => format!("{}[{at}]", output.name),
    }
}

fn cost(operations: &Operations, watch: u32) -> String {
    match watch {
        0 => operations.to_string(),
        watch => format!("{operations}, and {watch} to watch pivots"),
    }
}

/// What a function computes.
fn doc(id: FunctionId) -> &'static str {
    match id {
        FunctionId::Hoisted => "What depends on parameters alone.",
        FunctionId::Phi => "The constraints Φ(q, t): 0 where the mechanism is assembled.",
        FunctionId::PhiDot => "The constraint violation in velocities, Φ̇ = Φ_q v + Φ_t.",
        FunctionId::PhiQ => {
            "The entries of the Jacobian Φ_q that are not 0, in the order of the table of places."
        }
        FunctionId::PhiT => "The partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.",
        FunctionId::Gamma => "γ, so that accelerations satisfy Φ_q q̈ = γ.",
        FunctionId::BaumgarteRhs => "γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation.",
        FunctionId::Mass => "The diagonal of the mass matrix M; its other entries are 0.",
        FunctionId::Forces => "The generalized forces Q: gravity and applied loads.",
        FunctionId::KineticEnergy => "The kinetic energy ½ vᵀMv in J.",
        FunctionId::PotentialEnergy => "The potential energy of gravity and springs in J.",
        FunctionId::Stabilized => {
            "Accelerations with feedback of the state's own violation, and this feedback.\nReturns the pivot growth."
        }
        FunctionId::Constrained => "Accelerations with the given feedback.\nReturns the pivot growth.",
        FunctionId::Reactions => {
            "Accelerations q̈ and multipliers λ from M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ + feedback.\nReturns the pivot growth."
        }
        FunctionId::PositionCorrection => {
            "The shortest Δq, measured by masses, with Φ_q Δq = feedback, a residual here; coordinates\n\
             that the start prescribes do not move. Returns the pivot growth."
        }
        FunctionId::VelocityCorrection => "The same for velocities.\nReturns the pivot growth.",
        FunctionId::Outputs => "The declared outputs.",
        FunctionId::Conditions => "What the conditions of the parameters judge.",
        FunctionId::Start => "The declared start, before guesses are corrected. Returns its time.",
        FunctionId::Pivots => "The growth of every pivot that may vanish.",
        FunctionId::StartPivots => "The growth of every pivot of the corrections.",
        FunctionId::Points => "Where the points of the mechanism are in m: x and y of each in turn.",
    }
}
