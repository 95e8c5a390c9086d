//! Whether code does what its program does.
//!
//! The code is followed symbolically once, before anything runs.

use mbs_codegen::compiled::Compiled;
use mbs_symbolic::{Function, Inconsistency, Instruction as Step, Operand, Operation, Program, SinCos};

use crate::code::{Code, Fixed, Role, role};
use crate::instruction::Instruction;
use crate::products::Products;

/// Follows the slots through a run, and compares what they hold with what the program
/// reads: so every result is that of the program, on the same operands, and every slot
/// exists.
///
/// # Errors
/// The code does something else.
pub fn check(compiled: &Compiled, program: &Program, code: &Code) -> Result<(), Inconsistency> {
    let mut slots = vec![None; code.slots];
    for (slot, &number) in slots.iter_mut().zip(&code.fixed) {
        *slot = Some(Role::Fixed(number));
    }
    for &(argument, at) in &code.given {
        if let Some(slot) = slots.get_mut(at as usize) {
            *slot = Some(Role::Given(argument));
        }
    }
    let (pairs, products) = (SinCos::of(program), Products::of(program));
    let follower = Follower { compiled, program, pairs, products, slots };
    let rule = "slots hold what the program reads";
    follower.follow(&code.instructions, &code.outputs).ok_or(Inconsistency { pass: "live code", rule })
}

/// Follows the code with operands of the program in slots, instead of numbers.
struct Follower<'a> {
    compiled: &'a Compiled,
    program: &'a Program,
    pairs: SinCos,
    products: Products,
    slots: Vec<Option<Role>>,
}

impl Follower<'_> {
    /// Something, if the instructions are those of the program, each on its operands, the
    /// fixed slots stay what they are, and the outputs end in these slots.
    fn follow(mut self, instructions: &[Instruction], outputs: &[u32]) -> Option<()> {
        let fixed = self.slots.iter().take_while(|slot| matches!(slot, Some(Role::Fixed(_)))).count();
        let mut instructions = instructions.iter();
        for (at, step) in self.program.instructions.iter().enumerate() {
            if let Some((product, ..)) = self.products.product(self.program, at) {
                self.sum(at, step, product, instructions.next()?, fixed)?;
            } else if self.pairs.partner(at).is_none_or(|partner| partner > at)
                && self.products.reader(at).is_none()
            {
                self.step(at, step, instructions.next()?, fixed)?;
            }
        }
        let are_outputs = outputs.len() == self.program.outputs.len();
        let mut places = self.program.outputs.iter().zip(outputs);
        let is_there = places.all(|(&output, &slot)| self.holds(slot, output).is_some());
        (are_outputs && is_there && instructions.next().is_none()).then_some(())
    }

    /// A sum with its product, both of them on the operands of the program.
    fn sum(
        &mut self,
        at: usize,
        step: &Step,
        product: usize,
        instruction: &Instruction,
        fixed: usize,
    ) -> Option<()> {
        let (is_first, is_second) = (step.a == Operand::Value(product), step.b == Operand::Value(product));
        let (other, [to, a, b, c]) = match (step.operation, is_first, is_second, *instruction) {
            (Operation::Add, true, false, Instruction::MulAdd(slots)) => (step.b, slots),
            (Operation::Add, false, true, Instruction::MulAdd(slots)) => (step.a, slots),
            (Operation::Sub, false, true, Instruction::SubMul(slots)) => (step.a, slots),
            (Operation::Sub, true, false, Instruction::MulSub(slots)) => (step.b, slots),
            _ => return None,
        };
        let factors = self.program.instructions.get(product).filter(|it| it.operation == Operation::Mul)?;
        self.holds(a, factors.a)?;
        self.holds(b, factors.b)?;
        self.holds(c, other)?;
        self.put(to, at, fixed)
    }

    /// A slot holds a result from now on.
    fn put(&mut self, slot: u32, value: usize, fixed: usize) -> Option<()> {
        if (slot as usize) < fixed {
            return None;
        }
        *self.slots.get_mut(slot as usize)? = Some(Role::Value(value));
        Some(())
    }

    fn step(&mut self, at: usize, step: &Step, instruction: &Instruction, fixed: usize) -> Option<()> {
        let (is_same, results) = match (step.operation, *instruction) {
            (Operation::Add, Instruction::Add([to, a, b]))
            | (Operation::Sub, Instruction::Sub([to, a, b]))
            | (Operation::Mul, Instruction::Mul([to, a, b]))
            | (Operation::Div, Instruction::Div([to, a, b])) => {
                self.holds(b, step.b)?;
                (self.holds(a, step.a).is_some(), [(to, at), (to, at)])
            }
            (Operation::Neg, Instruction::Neg([to, a])) => {
                (self.holds(a, step.a).is_some(), [(to, at), (to, at)])
            }
            (Operation::Call(Function::Sin), Instruction::SinCos([sine, cosine, a])) => {
                let partner = self.pairs.partner(at)?;
                (self.holds(a, step.a).is_some(), [(sine, at), (cosine, partner)])
            }
            (Operation::Call(Function::Cos), Instruction::SinCos([sine, cosine, a])) => {
                let partner = self.pairs.partner(at)?;
                (self.holds(a, step.a).is_some(), [(cosine, at), (sine, partner)])
            }
            (Operation::Call(f), Instruction::Call(called, [to, a, b])) => {
                self.holds(b, step.b)?;
                (f == called && self.holds(a, step.a).is_some(), [(to, at), (to, at)])
            }
            (Operation::Spline(id, order), Instruction::Spline { order: called, spline, slots: [to, a] }) => {
                let is_spline = id.index() == spline as usize && id.index() < self.compiled.splines.len();
                (is_spline && order == called && self.holds(a, step.a).is_some(), [(to, at), (to, at)])
            }
            _ => return None,
        };
        for (slot, value) in results {
            self.put(slot, value, fixed)?;
        }
        is_same.then_some(())
    }

    /// Something, if a slot holds an operand.
    fn holds(&self, slot: u32, operand: Operand) -> Option<()> {
        let wanted = role(self.compiled, operand);
        let held = (*self.slots.get(slot as usize)?)?;
        let is_same = match (held, wanted) {
            (Role::Fixed(Fixed::Number(a)), Role::Fixed(Fixed::Number(b))) => a.to_bits() == b.to_bits(),
            _ => held == wanted,
        };
        is_same.then_some(())
    }
}

#[cfg(test)]
pub mod tests {
    use mbs_codegen::{FunctionId, analyse};

    use crate::code::Code;
    use crate::instruction::Instruction;

    /// With all kinds of instructions.
    pub const DECLARATION: &str = "Crank {
        dof = 1;
        param r = 60 [mm];
        param l = 180 [mm];
        gravity = (0, -9.81) [m/s^2];
        body crank (theta) { inertia = 1e-3 [kg*m^2]; }
        body rod (phi) { inertia = 2e-3 [kg*m^2]; }
        body slider (x) { mass = 2 [kg]; }
        profile wave = spline((0 [deg], 1), (90 [deg], 2), (200 [deg], 0)) period 360 [deg];
        torque load on crank = -0.1 [N*m]*wave(theta) - 1 [N*m]*tanh(der(theta)/(1 [rad/s]));
        constraint guide: r*sin(theta) + l*sin(phi) = 0;
        constraint pin: x = r*cos(theta) + l*cos(phi);
        start { theta = 0.3; der(theta) = 10 [rad/s]; guess x = r + l; }
    }";

    /// The slots of an instruction.
    fn slots(instruction: &mut Instruction) -> &mut [u32] {
        match instruction {
            Instruction::Add(slots)
            | Instruction::Sub(slots)
            | Instruction::Mul(slots)
            | Instruction::Div(slots)
            | Instruction::SinCos(slots)
            | Instruction::Call(_, slots) => slots,
            Instruction::MulAdd(slots) | Instruction::SubMul(slots) | Instruction::MulSub(slots) => slots,
            Instruction::Neg(slots) | Instruction::Spline { slots, .. } => slots,
        }
    }

    /// Another operation on the same slots.
    fn confused(instruction: Instruction) -> Instruction {
        match instruction {
            Instruction::Add(slots) => Instruction::Sub(slots),
            Instruction::Sub(slots) => Instruction::Add(slots),
            Instruction::Mul(slots) => Instruction::Div(slots),
            Instruction::Div(slots) | Instruction::Call(_, slots) => Instruction::Mul(slots),
            Instruction::MulAdd(slots) => Instruction::SubMul(slots),
            Instruction::SubMul(slots) => Instruction::MulSub(slots),
            Instruction::MulSub(slots) => Instruction::MulAdd(slots),
            Instruction::SinCos([sine, cosine, angle]) => Instruction::SinCos([cosine, sine, angle]),
            Instruction::Neg([to, a]) => Instruction::Add([to, a, a]),
            Instruction::Spline { order, spline, slots } => {
                Instruction::Spline { order: order + 1, spline, slots }
            }
        }
    }

    #[test]
    fn every_wrong_slot_and_operation_is_caught() {
        let compiled = analyse(DECLARATION.parse().unwrap()).unwrap();
        let program = compiled.program(FunctionId::Stabilized);
        let code = || Code::in_order(&compiled, program).unwrap();
        let is_accepted = |code: &Code| super::check(&compiled, program, code).is_ok();
        let right = code();
        assert!(is_accepted(&right));
        for at in 0..right.instructions.len() {
            let mut wrong = code();
            wrong.instructions[at] = confused(wrong.instructions[at]);
            assert!(!is_accepted(&wrong), "operation {at}: {:?}", right.instructions[at]);
            for slot in 0..slots(&mut code().instructions[at]).len() {
                for other in [0, u32::MAX] {
                    let mut wrong = code();
                    let slots = slots(&mut wrong.instructions[at]);
                    if slots[slot] == other {
                        continue;
                    }
                    slots[slot] = other;
                    assert!(!is_accepted(&wrong), "slot {slot} of {at}: {:?}", right.instructions[at]);
                }
            }
        }
    }
}
