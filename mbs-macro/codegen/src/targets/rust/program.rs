//! The statements of a program, in one line of them or as loops.

use mbs_symbolic::{Block, Program, SinCos};

use super::access::Access;
use super::body::Body;
use super::long;
use super::names::Names;
use super::writer::Writer;
use crate::compiled::{Compiled, FunctionId};

/// A program as one list of statements, or if it is long, as loops and
/// functions of bounded size.
pub fn body(compiled: &Compiled, names: &Names, function: FunctionId, access: &Access) -> Body {
    body_of(compiled, names, compiled.program(function), access)
}

/// The same of any program.
pub fn body_of(compiled: &Compiled, names: &Names, program: &Program, access: &Access) -> Body {
    let blocks = compiled.blocks(program);
    let range = match &blocks[..] {
        [] => 0..0,
        [Block::Straight(range)] => range.clone(),
        _ => {
            let body = long::body(compiled, names, program, access, &blocks);
            return body.unwrap_or_else(|fault| {
                names.faults.borrow_mut().push(fault);
                Body::none(program, names)
            });
        }
    };
    let pairs = SinCos::of(program);
    let mut writer = Writer::new(compiled, program, access, &pairs, range.clone());
    range.for_each(|at| writer.instruction(at));
    let outputs = program.outputs.iter().map(|&output| writer.operand(output)).collect();
    Body { statements: writer.statements, outputs, places: None, slots: 0, runtime: names.runtime.clone() }
}
