//! WebAssembly: the bytes of a module with a function per program over linear memory, the tables of
//! the mechanism as JSON, and the script of a run around them. No tool chain takes part.
//!
//! A function is given addresses of vectors of `f64` and, where it needs them, t and s as numbers. The
//! first address is that of the mechanism: its parameters, and behind them what depends on them alone.
//! Results are written to addresses; they must not lie over arguments. A last single number, the growth or
//! an energy, is returned. The memory below the exported `heap` belongs to the module.
//!
//! Results are those of the other targets to the bit: WebAssembly rounds each operation by itself, sines
//! and cosines up to 10⁹ rad are written with the code, as splines are. Long programs are written as
//! loops. Tangents, inverse functions, exponentials and powers are those of the host, which need not agree
//! with Rust's in the last place.
//!
//! An interpreter of WebAssembly holds modules of the library to that (`tests/tests/live/wasm`).

mod helpers;
mod loops;
mod memory;
mod planned;
mod program;
mod slot;
mod tables;

use mbs_symbolic::Inconsistency;
use wasm_encoder::{
    CodeSection, ConstExpr, DataSection, EntityType, ExportKind, ExportSection, FunctionSection,
    GlobalSection, GlobalType, ImportSection, MemorySection, MemoryType, Module, TypeSection, ValType,
};

use crate::compiled::Compiled;
use crate::diagnostics::{Diagnostic, Diagnostics};
use memory::Memory;
use planned::{Signature, planned};
use program::body;

macro_rules! run_script {
    ($($contacts:literal),*) => {
        concat!(
            "const mbs = (() => {\n\"use strict\";\n",
            include_str!("text/mechanism.js"),
            include_str!("text/start.js"),
            $(include_str!($contacts),)*
            include_str!("text/step.js"),
            "return { Failure, Mechanism, Run, largest, add };\n})();\n",
        )
    };
}

/// The JavaScript that runs a mechanism in its module: it defines `mbs.Mechanism` and `mbs.Run`. The first one is of
/// mechanisms without stops and without friction that sticks, the second one of those whose stops do not rub, the third one of
/// all. The order of operations is that of the C target, so that numbers agree with those of C and Rust to the bit.
pub const RUN_SCRIPTS: [&str; 3] = [
    run_script!("text/no_contacts.js"),
    run_script!("text/no_rubbing.js", "text/sticking.js", "text/modes.js", "text/stops.js"),
    run_script!("text/pivoting.js", "text/rubbing.js", "text/sticking.js", "text/modes.js", "text/stops.js"),
];

/// A mechanism in WebAssembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Wasm {
    /// The module. It imports functions of JavaScript's `Math` from `math`.
    pub module: Vec<u8>,
    /// Names, units, conditions and counts as JSON: what [`RUN_SCRIPTS`] have to know.
    pub tables: String,
}

/// The module of a mechanism with all functions but those of implicit stages, and with whole steps where
/// the mechanism is small enough.
///
/// # Example
/// ```
/// use mbs_codegen::targets::wasm;
///
/// let declaration = "Pendulum {
///     dof = 1;
///     param length = 1 [m];
///     gravity = (0, -9.81) [m/s^2];
///     body bob (x, y) { mass = 2 [kg]; }
///     constraint rod: x^2 + y^2 = length^2;
///     start { x = length; guess y = 0; }
/// }";
/// let pendulum = wasm(&mbs_codegen::analyse(declaration.parse()?)?)?;
/// assert!(pendulum.module.starts_with(b"\0asm"));
/// assert!(pendulum.tables.contains("\"name\":\"Pendulum\""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A program that reads what its function is not given, which is a mistake of the compiler.
pub fn wasm(compiled: &Compiled) -> Result<Wasm, Diagnostics> {
    let internal = |fault| Diagnostic::internal(compiled.written.name.span(), fault);
    let module = module(compiled).map_err(internal)?;
    Ok(Wasm { module, tables: tables::tables(compiled) })
}

fn module(compiled: &Compiled) -> Result<Vec<u8>, Inconsistency> {
    let planned = planned(compiled)?;
    let slots = planned.iter().filter_map(|it| Some(it.layout.as_ref()?.slots)).max().unwrap_or(0);
    let mut memory = Memory::new(&compiled.splines, slots);
    let mut parts = Parts::default();
    for (name, arity) in helpers::IMPORTS {
        parts.import(name, arity);
    }
    for helper in helpers::all() {
        parts.function(&helper.parameters, &helper.results, &helper.body);
    }
    for it in &planned {
        let Signature { name, slots, lengths, returns } = &it.signature;
        let addresses = lengths.iter().map(|_| ValType::I32);
        let parameters: Vec<ValType> = slots.iter().map(|slot| slot.kind()).chain(addresses).collect();
        let results = if *returns { &[ValType::F64][..] } else { &[] };
        let code = body(compiled, it, &mut memory)?;
        let at = parts.function(&parameters, results, &code);
        parts.exports.export(name, ExportKind::Func, at);
    }
    Ok(parts.module(&memory))
}

/// The sections of a module as they grow.
#[derive(Default)]
struct Parts {
    types: TypeSection,
    imports: ImportSection,
    functions: FunctionSection,
    exports: ExportSection,
    code: CodeSection,
    /// Imported and own functions.
    count: u32,
}

impl Parts {
    /// A function of `Math` that is given this many numbers.
    fn import(&mut self, name: &str, arity: usize) {
        self.types.ty().function(vec![ValType::F64; arity], [ValType::F64]);
        self.imports.import("math", name, EntityType::Function(self.count));
        self.count += 1;
    }

    /// A function of the module; gives its position. Every function has a type of its own.
    fn function(
        &mut self,
        parameters: &[ValType],
        results: &[ValType],
        body: &wasm_encoder::Function,
    ) -> u32 {
        self.types.ty().function(parameters.iter().copied(), results.iter().copied());
        self.functions.function(self.count);
        self.code.function(body);
        self.count += 1;
        self.count - 1
    }

    fn module(mut self, memory: &Memory) -> Vec<u8> {
        const PAGE: usize = 65_536;
        let heap = memory.heap();
        let mut pages = MemorySection::new();
        pages.memory(MemoryType {
            minimum: heap.div_ceil(PAGE).max(1) as u64,
            maximum: None,
            memory64: false,
            shared: false,
            page_size_log2: None,
        });
        let mut globals = GlobalSection::new();
        let constant = GlobalType { val_type: ValType::I32, mutable: false, shared: false };
        globals.global(constant, &ConstExpr::i32_const(heap as i32));
        self.exports.export("memory", ExportKind::Memory, 0).export("heap", ExportKind::Global, 0);
        let mut data = DataSection::new();
        for (address, bytes) in memory.data() {
            data.active(0, &ConstExpr::i32_const(address as i32), bytes.iter().copied());
        }
        let mut module = Module::new();
        module.section(&self.types).section(&self.imports).section(&self.functions).section(&pages);
        module.section(&globals).section(&self.exports).section(&self.code).section(&data);
        module.finish()
    }
}
