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
    /// What it does, as a comment.
    doc: String,
    /// Its head, without a semicolon.
    head: String,
    body: String,
    /// Whether others than the code itself may call it.
    is_public: bool,
}

impl Kernel {
    /// What the header says of it.
    pub fn declaration(&self) -> String {
        if self.is_public { format!("{}{};\n\n", self.doc, self.head) } else { String::new() }
    }

    /// The function; the comment of a public one stands in the header.
    pub fn text(&self) -> String {
        let doc = if self.is_public { "" } else { &self.doc };
        format!("{doc}{}\n{{\n{}}}\n\n", self.head, self.body)
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
    let outputs = id.results().iter().zip(results(id)).map(|(&kind, &name)| Output { name, kind });
    let outputs: Vec<Output> = outputs.collect();
    // a last single number is returned
    let returns = outputs.len() < id.results().len();
    let mut arguments = vec![("const struct NAME *", "m")];
    arguments.extend(id.arguments().iter().map(|&argument| argument_of(argument)));
    let empty = outputs.iter().filter(|output| target.compiled.length(output.kind) == 0);
    let names = arguments.iter().map(|(_, name)| *name).chain(empty.map(|output| output.name));
    let unused = unused(target, program, names);
    let written = outputs.iter().map(|output| output.declaration(target));
    let declarations: Vec<String> =
        arguments.iter().map(|(of, name)| format!("{of}{name}")).chain(written).collect();
    let is_static = if is_public { "" } else { "static " };
    let result = if returns { "NAME_real" } else { "void" };
    let name = if id == FunctionId::Hoisted { "hoisted" } else { id.name() };
    let head = format!("{is_static}{result} NAME_compute_{name}(\n    {})", declarations.join(",\n    "));
    let statements = statements(target, program, &outputs, returns)?;
    Ok(Kernel {
        doc: documented(described(id), &operations, watch, id.solves()),
        head: target.fill(&head),
        body: format!("{unused}{statements}"),
        is_public,
    })
}

/// Statements that run a program and write its outputs.
fn statements(
    target: &Target<'_>,
    program: &Program,
    outputs: &[Output],
    returns: bool,
) -> Result<String, Inconsistency> {
    let compiled = target.compiled;
    let lengths: Vec<usize> = outputs.iter().map(|output| compiled.length(output.kind)).collect();
    let blocks = compiled.blocks(program);
    if !matches!(blocks[..], [] | [Block::Straight(_)]) {
        let layout = compiled.layout(program, &blocks, &lengths)?;
        let results: Vec<String> = outputs.iter().map(|output| output.array(target)).collect();
        let kept = Kept { layout: &layout, results: &results };
        return Ok(loops::statements(target, program, kept, &lengths, returns));
    }
    let mut printer =
        Printer::new(target, program, 0..program.instructions.len(), None, "    ").instructions();
    let mut values = program.outputs.iter();
    for (output, length) in outputs.iter().zip(lengths) {
        for (at, &value) in (0..length).zip(values.by_ref()) {
            printer.line(&format!("{} = {};", output.element(target, at), printer.operand(value)));
        }
    }
    if let (true, Some(&value)) = (returns, values.next()) {
        printer.line(&format!("return {};", printer.operand(value)));
    }
    Ok(printer.text)
}

/// A whole step as one program, for both kinds of feedback; nothing if the mechanism is too large.
pub fn fused(target: &Target<'_>) -> Vec<Kernel> {
    let Some(step) = &target.compiled.fused_step else { return Vec::new() };
    let Programs { held, per_stage } = &step.alone.programs;
    let kinds = [("held", "held over it", held), ("per_stage", "in both stages", per_stage)];
    kinds.into_iter().map(|(name, how, program)| fused_step(target, name, how, program)).collect()
}

fn fused_step(target: &Target<'_>, name: &str, how: &str, program: &Program) -> Kernel {
    let given = ["m", "t", "q", "v", "inputs", "gains", "h", "half_h", "t_next"];
    let unused = unused(target, program, given.into_iter());
    let mut printer =
        Printer::new(target, program, 0..program.instructions.len(), None, "    ").instructions();
    let members = &target.names.of(Vector::Positions).members;
    let places = ["q", "v"].into_iter().flat_map(|vector| members.iter().map(move |member| (vector, member)));
    let mut values = program.outputs.iter();
    for ((vector, member), &value) in places.zip(values.by_ref()) {
        let value = printer.operand(value);
        printer.line(&format!("next.{vector}.{} = {value};", member.name));
        printer.line(&format!("sum += {value};"));
    }
    if let Some(&growth) = values.next() {
        printer.line(&format!("growth = {};", printer.operand(growth)));
    }
    let given = target.fill(include_str!("text/step_fused_head.c"));
    let end = target.fill(include_str!("text/step_fused_end.c"));
    let doc = format!("A step with the feedback {how}, both stages in one.");
    Kernel {
        doc: documented(&doc, &program.operations(), 0, false),
        head: target.fill(&format!("static int NAME_step_{name}(struct NAME_run *run, real t_next)")),
        body: format!("{given}{unused}{}{end}", printer.text),
        is_public: false,
    }
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

impl Output {
    fn declaration(&self, target: &Target<'_>) -> String {
        match target.names.of_results(self.kind) {
            Some(of) => format!("struct NAME_{} *{}", of.name, self.name),
            None => format!("NAME_real *{}", self.name),
        }
    }

    /// All of it, as an array.
    fn array(&self, target: &Target<'_>) -> String {
        match target.names.of_results(self.kind) {
            Some(_) => format!("{}_places({})", target.names.prefix, self.name),
            None => self.name.to_owned(),
        }
    }

    /// A number of it.
    fn element(&self, target: &Target<'_>, at: usize) -> String {
        match target.names.of_results(self.kind) {
            Some(of) => format!("{}->{}", self.name, of.members[at].name),
            None => format!("{}[{at}]", self.name),
        }
    }
}

/// What a function computes, and what that costs.
fn documented(doc: &str, operations: &Operations, watch: u32, solves: bool) -> String {
    let returns = if solves { "\nReturns the pivot growth." } else { "" };
    let watch = if watch > 0 { format!(", and {watch} to watch pivots") } else { String::new() };
    comment(&format!("{doc}{returns}\nCost: {operations}{watch}."), "")
}

/// The names of what a function writes, one kind after the other.
fn results(id: FunctionId) -> &'static [&'static str] {
    match id {
        FunctionId::Stabilized => &["acceleration", "feedback"],
        FunctionId::Reactions => &["acceleration", "multipliers"],
        FunctionId::Start => &["q", "v"],
        FunctionId::KineticEnergy | FunctionId::PotentialEnergy => &[],
        _ => &["result"],
    }
}

/// What a function computes.
fn described(id: FunctionId) -> &'static str {
    match id {
        FunctionId::Hoisted => "What depends on parameters alone.",
        FunctionId::Phi => "The constraints Φ(q, t): 0 where the mechanism is assembled.",
        FunctionId::PhiDot => "The constraint violation in velocities, Φ̇ = Φ_q v + Φ_t.",
        FunctionId::PhiQ => {
            "The entries of the Jacobian Φ_q that are not 0, as the table of places has them."
        }
        FunctionId::PhiT => "The partial time derivative Φ_t; velocities satisfy Φ_q v = −Φ_t.",
        FunctionId::Gamma => "γ, so that accelerations satisfy Φ_q q̈ = γ.",
        FunctionId::BaumgarteRhs => "γ − 2αΦ̇ − β²Φ, the right-hand side with feedback of the violation.",
        FunctionId::Mass => "The diagonal of the mass matrix M; its other entries are 0.",
        FunctionId::Forces => "The generalized forces Q: gravity and applied loads.",
        FunctionId::KineticEnergy => "The kinetic energy ½ vᵀMv in J.",
        FunctionId::PotentialEnergy => "The potential energy of gravity and springs in J.",
        FunctionId::Stabilized => {
            "Accelerations with feedback of the state's own violation, and this feedback."
        }
        FunctionId::Constrained => "Accelerations with the given feedback.",
        FunctionId::Reactions => "q̈ and λ from M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ + feedback.",
        FunctionId::PositionCorrection => {
            "The shortest Δq, measured by masses, with Φ_q Δq = feedback, a residual here; coordinates\n\
             that the start prescribes do not move."
        }
        FunctionId::VelocityCorrection => "The same for velocities.",
        FunctionId::Outputs => "The declared outputs.",
        FunctionId::Conditions => "What the conditions of the parameters judge.",
        FunctionId::Start => "The declared start, before guesses are corrected. Returns its time.",
        FunctionId::Pivots => "The growth of every pivot that may vanish.",
        FunctionId::StartPivots => "The growth of every pivot of the corrections.",
        FunctionId::Points => "Where the points of the mechanism are in m: x and y of each.",
    }
}
