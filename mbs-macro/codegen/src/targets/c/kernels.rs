//! The functions of a mechanism, one for each program.

use mbs_symbolic::{Block, Inconsistency, Operations, Program};

use super::docs::comment;
use super::instructions::{Kept, Printer};
use super::loops;
use super::target::Target;
use crate::compiled::{Argument, Count, FunctionId, Kinds, Property, Results};

/// A function of C.
pub struct Kernel {
    /// Its documentation, as a comment.
    doc: String,
    /// Its head, without a semicolon.
    head: String,
    body: String,
    /// True if others than the code itself may call it.
    is_public: bool,
}

impl Kernel {
    /// Its declaration in the header; empty if it is not public.
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
    target.compiled.functions().map(|id| kernel(target, id)).collect()
}

fn kernel(target: &Target<'_>, id: FunctionId) -> Result<Kernel, Inconsistency> {
    let program = target.compiled.program(id);
    let Count { operations, watch, .. } = target.compiled.count(id);
    let is_public = !matches!(id, FunctionId::Hoisted | FunctionId::Conditions);
    let outputs: Vec<Output> = id.written().map(|(name, kind)| Output { name, kind }).collect();
    let returns = id.returns();
    let name = if id == FunctionId::Hoisted { "hoisted" } else { id.name() };
    let is_static = if is_public { "" } else { "static " };
    let result = if returns { "NAME_real" } else { "void" };
    let arguments = id.arguments().iter().map(|&argument| argument_of(argument));
    let statements = statements(target, program, &outputs, returns)?;
    Ok(Kernel {
        doc: documented(id.row().doc.trim(), &operations, watch, id.solves()),
        is_public,
        ..function(
            target,
            &format!("{is_static}{result} NAME_compute_{name}"),
            arguments,
            &outputs,
            &statements,
        )
    })
}

/// The derivatives of functions along a direction, in their order.
///
/// # Errors
/// A program is not written as it was checked.
pub fn tangents(target: &Target<'_>) -> Result<Vec<Kernel>, Inconsistency> {
    target.compiled.functions().filter(|id| id.is(Property::Tangent)).map(|id| tangent(target, id)).collect()
}

fn tangent(target: &Target<'_>, id: FunctionId) -> Result<Kernel, Inconsistency> {
    let program = target.compiled.tangent(id)?;
    let outputs: Vec<Output> = id.written().map(|(name, kind)| Output { name, kind }).collect();
    let arguments = id.arguments().iter().map(|&argument| argument_of(argument));
    let arguments = arguments.chain([("const NAME_real *".to_owned(), "direction")]);
    let statements = statements(target, &program, &outputs, false)?;
    let doc = format!(
        "The derivatives of the results of NAME_compute_{name} along a direction, which has {} numbers: how fast the \
         time changes, and every component of the structs among the arguments, in their order, without gains.",
        target.compiled.directions(id),
        name = id.name()
    );
    let head = format!("void NAME_along_{}", id.name());
    Ok(Kernel {
        doc: target.fill(&documented(&doc, &program.operations(), 0, false)),
        is_public: true,
        ..function(target, &head, arguments, &outputs, &statements)
    })
}

/// A function with these arguments behind the mechanism, and with its results behind them.
fn function(
    target: &Target<'_>,
    head: &str,
    arguments: impl Iterator<Item = (String, &'static str)>,
    outputs: &[Output],
    statements: &str,
) -> Kernel {
    let results = outputs.iter().map(|output| (output.declared_as(target), output.name));
    let arguments: Vec<_> =
        [("const struct NAME *".to_owned(), "m")].into_iter().chain(arguments).chain(results).collect();
    let declarations: Vec<String> = arguments.iter().map(|(of, name)| format!("{of}{name}")).collect();
    // not every program reads all that it is given
    let given: Vec<String> = arguments.iter().map(|(_, name)| format!("(void){name};")).collect();
    Kernel {
        doc: String::new(),
        head: target.fill(&format!("{head}(\n    {})", declarations.join(",\n    "))),
        body: format!("    {}\n{statements}", given.join(" ")),
        is_public: false,
    }
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
        let results: Vec<String> =
            outputs.iter().map(|it| format!("{}_places({})", target.names.prefix, it.name)).collect();
        let kept = Kept { layout: &layout, results: &results };
        return Ok(loops::statements(target, program, kept, &lengths, returns));
    }
    let mut printer = Printer::of(target, program);
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
    let Kinds { held, per_stage } = &step.alone;
    let kinds = [("held", "held over it", held), ("per_stage", "in every stage", per_stage)];
    kinds.into_iter().map(|(name, how, program)| fused_step(target, name, how, program)).collect()
}

fn fused_step(target: &Target<'_>, name: &str, how: &str, program: &Program) -> Kernel {
    let mut printer = Printer::of(target, program);
    let members = &target.names.states().members;
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
    let doc = format!("A step with the feedback {how}, all stages in one.");
    Kernel {
        doc: documented(&doc, &program.operations(), 0, false),
        head: target.fill(&format!("static int NAME_step_{name}(struct NAME_run *run, real t_next)")),
        body: format!("{given}{}{end}", printer.text),
        is_public: false,
    }
}

/// The type of an argument, and its name.
fn argument_of(argument: Argument) -> (String, &'static str) {
    let (of, name) = match argument {
        Argument::Time => return ("NAME_real ".to_owned(), "t"),
        Argument::Positions => ("coordinates", "q"),
        Argument::Velocities => ("coordinates", "v"),
        Argument::StatePositions => ("STATES", "q"),
        Argument::StateVelocities => ("STATES", "v"),
        Argument::Inputs => ("inputs", "inputs"),
        Argument::Gains => ("gains", "gains"),
        Argument::Feedback => ("constraints", "feedback"),
        Argument::Reactions => ("reactions", "reactions"),
        Argument::Shift => return ("NAME_real ".to_owned(), "shift"),
        Argument::Predicted => ("STATES", "predicted"),
    };
    (format!("const struct NAME_{of} *"), name)
}

impl Output {
    /// The type of the argument that it is written to.
    fn declared_as(&self, target: &Target<'_>) -> String {
        let of = target.names.of_results(self.kind);
        of.map_or_else(|| "NAME_real *".to_owned(), |of| format!("struct NAME_{} *", of.name))
    }

    /// A number of it.
    fn element(&self, target: &Target<'_>, at: usize) -> String {
        match target.names.of_results(self.kind) {
            Some(of) => format!("{}->{}", self.name, of.members[at].name),
            None => format!("{}[{at}]", self.name),
        }
    }
}

/// The comment of a function: its results and its cost.
fn documented(doc: &str, operations: &Operations, watch: u32, solves: bool) -> String {
    let returns = if solves { "\nReturns the pivot growth." } else { "" };
    let watch = if watch > 0 { format!(", and {watch} to watch pivots") } else { String::new() };
    comment(&format!("{doc}{returns}\nCost: {operations}{watch}."), "")
}
