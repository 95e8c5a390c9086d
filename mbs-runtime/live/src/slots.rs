//! Which slot holds what, and for how long.

use mbs_symbolic::{Function, Inconsistency, Instruction as Step, Operand, Operation, Program, SinCos};
use rustc_hash::FxHashMap as HashMap;

use crate::code::{Code, Role};
use crate::instruction::Instruction;
use crate::products::{Products, Sum};

/// A position behind all instructions: results are read there.
const END: usize = usize::MAX;

/// The code of a program. A slot is taken again when its number has been read for the last
/// time, so that those in use stay few and near.
///
/// # Errors
/// The program reads what it does not have.
pub fn allocate(program: &Program, role: &dyn Fn(Operand) -> Role) -> Result<Code, Inconsistency> {
    let (pairs, products) = (SinCos::of(program), Products::of(program));
    let last_reads = last_reads(program, &pairs, &products);
    let mut allocator = Allocator { places: HashMap::default(), free: Vec::new(), slots: 0, last_reads };
    let (mut fixed, mut given) = (Vec::new(), Vec::new());
    let operands = program.instructions.iter().flat_map(|step| [step.a, step.b]);
    let operands: Vec<Operand> = operands.chain(program.outputs.iter().copied()).collect();
    // fixed numbers first, which keep their slots
    for &operand in &operands {
        if let Role::Fixed(number) = role(operand)
            && allocator.take_once(operand)?.is_some()
        {
            fixed.push(number);
        }
    }
    for &operand in &operands {
        if let Role::Given(argument) = role(operand)
            && let Some(slot) = allocator.take_once(operand)?
        {
            given.push((argument, slot));
        }
    }
    let mut instructions = Vec::with_capacity(program.instructions.len());
    for (at, step) in program.instructions.iter().enumerate() {
        let partner = pairs.partner(at);
        if let Some((product, sum, other)) = products.product(program, at) {
            instructions.push(allocator.sum(at, &program.instructions[product], sum, other, role)?);
        } else if partner.is_none_or(|partner| partner > at) && products.reader(at).is_none() {
            instructions.push(allocator.instruction(at, step, partner, role)?);
        }
    }
    let outputs = program.outputs.iter().map(|&output| allocator.place(output));
    let outputs = outputs.collect::<Result<_, _>>()?;
    Ok(Code { instructions, fixed, given, outputs, slots: allocator.slots as usize })
}

/// Where every operand is read for the last time. The later one of a sine and a cosine of
/// the same angle reads it where the earlier one does, a product where its sum is.
fn last_reads(program: &Program, pairs: &SinCos, products: &Products) -> HashMap<Operand, usize> {
    let mut last_reads = HashMap::default();
    for (at, step) in program.instructions.iter().enumerate() {
        let earlier = pairs.partner(at).map_or(at, |partner| partner.min(at));
        let reader = products.reader(at).unwrap_or(earlier);
        for operand in [step.a, step.b] {
            let last = last_reads.entry(operand).or_insert(reader);
            *last = reader.max(*last);
        }
    }
    last_reads.extend(program.outputs.iter().map(|&output| (output, END)));
    last_reads
}

/// Slots while a program is gone through.
struct Allocator {
    places: HashMap<Operand, u32>,
    free: Vec<u32>,
    slots: u32,
    last_reads: HashMap<Operand, usize>,
}

impl Allocator {
    fn take(&mut self, operand: Operand) -> Result<u32, Inconsistency> {
        let slot = match self.free.pop() {
            Some(slot) => slot,
            None => {
                let too_many =
                    Inconsistency { pass: "live code", rule: "a program has less than 2^32 slots" };
                self.slots = self.slots.checked_add(1).ok_or(too_many)?;
                self.slots - 1
            }
        };
        self.places.insert(operand, slot);
        Ok(slot)
    }

    /// A slot for an operand that has none yet.
    fn take_once(&mut self, operand: Operand) -> Result<Option<u32>, Inconsistency> {
        if self.places.contains_key(&operand) { Ok(None) } else { self.take(operand).map(Some) }
    }

    fn place(&self, operand: Operand) -> Result<u32, Inconsistency> {
        let unknown = Inconsistency { pass: "live code", rule: "instructions read earlier results" };
        self.places.get(&operand).copied().ok_or(unknown)
    }

    /// Gives slots back that nothing reads behind an instruction.
    fn release(&mut self, at: usize, operand: Operand) {
        let is_read_later = self.last_reads.get(&operand).is_some_and(|&last| last > at);
        if !is_read_later && let Some(slot) = self.places.remove(&operand) {
            self.free.push(slot);
        }
    }

    /// A sum or a difference with its product.
    fn sum(
        &mut self,
        at: usize,
        product: &Step,
        sum: Sum,
        other: Operand,
        role: &dyn Fn(Operand) -> Role,
    ) -> Result<Instruction, Inconsistency> {
        let [a, b, c] = [self.place(product.a)?, self.place(product.b)?, self.place(other)?];
        for operand in [product.a, product.b, other] {
            if !matches!(role(operand), Role::Fixed(_)) {
                self.release(at, operand);
            }
        }
        let result = Operand::Value(at);
        let slots = [self.take(result)?, a, b, c];
        self.release(at, result);
        Ok(match sum {
            Sum::MulAdd => Instruction::MulAdd(slots),
            Sum::SubMul => Instruction::SubMul(slots),
            Sum::MulSub => Instruction::MulSub(slots),
        })
    }

    /// An instruction, and the slots of its results.
    fn instruction(
        &mut self,
        at: usize,
        step: &Step,
        partner: Option<usize>,
        role: &dyn Fn(Operand) -> Role,
    ) -> Result<Instruction, Inconsistency> {
        let (a, b) = (self.place(step.a)?, self.place(step.b)?);
        for operand in [step.a, step.b] {
            if !matches!(role(operand), Role::Fixed(_)) {
                self.release(at, operand);
            }
        }
        let result = Operand::Value(at);
        let to = self.take(result)?;
        let slots = [to, a, b];
        let instruction = match (step.operation, partner.map(Operand::Value)) {
            (Operation::Call(function), Some(partner)) => {
                let other = self.take(partner)?;
                let is_sine = function == Function::Sin;
                let (sine, cosine) = if is_sine { (to, other) } else { (other, to) };
                self.release(at, partner);
                Instruction::SinCos([sine, cosine, a])
            }
            (Operation::Add, _) => Instruction::Add(slots),
            (Operation::Sub, _) => Instruction::Sub(slots),
            (Operation::Mul, _) => Instruction::Mul(slots),
            (Operation::Div, _) => Instruction::Div(slots),
            (Operation::Neg, _) => Instruction::Neg([to, a]),
            (Operation::Call(function), _) => Instruction::Call(function, slots),
            (Operation::Spline(spline, order), _) => {
                Instruction::Spline { order, spline: spline.index() as u32, slots: [to, a] }
            }
        };
        // what nothing reads has its slot for the moment
        self.release(at, result);
        Ok(instruction)
    }
}
