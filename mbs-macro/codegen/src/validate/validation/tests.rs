//! Programs that are right are accepted, and every wrong instruction is caught.

use mbs_interface::FunctionId;
use mbs_symbolic::{Operand, Operation, Program};

use super::check_programs;
use crate::independence::{Samples, check_equations};
use crate::inputs::Inputs;
use crate::plan::{Plan, plan};
use crate::{derive, model, reduction, syntax};

/// A loop with a drive, a spring, an output and most kinds of rows.
pub(crate) const DECLARATION: &str = "FourBar {
    dof = 1;
    param l1 = 0.3 [m]; param l2 = 0.8 [m]; param l3 = 0.6 [m]; param d = 0.7 [m]; param k = 20 [N/m];
    gravity = (0.5, -9.81) [m/s^2];
    body crank (theta1) { inertia = 0.1 [kg*m^2]; }
    body rod (x, y, theta2) { mass = 2 [kg]; inertia = 0.3 [kg*m^2]; }
    body rocker (theta3) { inertia = 0.2 [kg*m^2]; }
    point tip on rod = (l2/2, 0);
    constraint crank_x: l1*cos(theta1) + l2/2*cos(theta2) = x;
    constraint crank_y: l1*sin(theta1) + l2/2*sin(theta2) = y;
    constraint loop_x: l1*cos(theta1) + l2*cos(theta2) = d + l3*cos(theta3);
    constraint loop_y: l1*sin(theta1) + l2*sin(theta2) = l3*sin(theta3) + 0.01 [m]*sin(3 [1/s]*t);
    spring s (rod.tip, ground) { stiffness = k; length = 0.1 [m]; damping = 2 [N*s/m]; }
    start { theta1 = 1; guess theta2 = 0.3; guess theta3 = 1.5; guess x = 0.5 [m]; guess y = 0.3 [m]; }
    output power [W] = der(theta1)*lambda(loop_x)*l1;
}";

/// A plan that the checks judge again and again.
pub(crate) struct Planned {
    pub model: model::Model,
    equations: derive::Equations,
    samples: Samples,
    pub plan: Plan,
}

impl Planned {
    pub fn new(declaration: &str) -> Self {
        let declaration = syntax::parse(declaration.parse().expect("tokens")).expect("the right shape");
        let mut model = model::resolve(&declaration).expect("resolvable");
        let mut inputs = Inputs::new(&mut model);
        let equations = derive::derive(&mut model, &inputs);
        let samples = Samples::new(&model, &inputs);
        let rows = check_equations(&model, &equations, &samples).expect("regular");
        let reduction = reduction::reduce(&mut model, &equations, &rows, &mut inputs);
        let plan = plan(&mut model, &equations, &rows, &samples, inputs, reduction).expect("determined");
        Self { model, equations, samples, plan }
    }

    fn is_accepted(&self) -> bool {
        check_programs(&self.model, &self.equations, &self.plan, &self.samples).is_ok()
    }
}

/// Another operation of the same operands; `None` where there is none.
pub(crate) fn corrupted(operation: Operation) -> Option<Operation> {
    Some(match operation {
        Operation::Add => Operation::Sub,
        Operation::Sub => Operation::Add,
        Operation::Mul => Operation::Add,
        Operation::Div => Operation::Mul,
        _ => return None,
    })
}

/// The instructions that results other than the pivot growth need.
pub(crate) fn needed(program: &Program, is_solving: bool) -> Vec<usize> {
    let outputs = program.outputs.len() - usize::from(is_solving);
    let mut needed = vec![false; program.instructions.len()];
    let mut open: Vec<Operand> = program.outputs[..outputs].to_vec();
    while let Some(operand) = open.pop() {
        if let Operand::Value(at) = operand
            && !std::mem::replace(&mut needed[at], true)
        {
            open.extend([program.instructions[at].a, program.instructions[at].b]);
        }
    }
    (0..needed.len()).filter(|&at| needed[at]).collect()
}

/// How many wrong instructions there can be, and how many of them are accepted.
fn missed(planned: &mut Planned, function: FunctionId) -> (usize, usize) {
    let (mut tried, mut missed) = (0, 0);
    for at in needed(&planned.plan.programs[function], function.solves()) {
        let right = planned.plan.programs[function].instructions[at].operation;
        let Some(wrong) = corrupted(right) else { continue };
        planned.plan.programs[function].instructions[at].operation = wrong;
        tried += 1;
        missed += usize::from(planned.is_accepted());
        planned.plan.programs[function].instructions[at].operation = right;
    }
    (tried, missed)
}

#[test]
fn every_wrong_instruction_is_caught() {
    let mut planned = Planned::new(DECLARATION);
    assert!(planned.is_accepted());
    for function in [
        FunctionId::Phi,
        FunctionId::PhiDot,
        FunctionId::PhiQ,
        FunctionId::PhiT,
        FunctionId::Gamma,
        FunctionId::BaumgarteRhs,
        FunctionId::Forces,
        FunctionId::KineticEnergy,
        FunctionId::PotentialEnergy,
        FunctionId::Stabilized,
        FunctionId::Constrained,
        FunctionId::Reactions,
        FunctionId::Outputs,
    ] {
        let ((tried, missed), name) = (missed(&mut planned, function), function.name());
        assert!(tried > 0 && missed == 0, "{missed} of {tried} wrong instructions of {name} are accepted");
    }
}

/// Of corrections it is checked that they meet the constraints, not that
/// they are the shortest that do.
#[test]
fn corrections_that_miss_the_constraints_are_caught() {
    let mut planned = Planned::new(DECLARATION);
    for correction in [FunctionId::PositionCorrection, FunctionId::Projection] {
        let (tried, missed) = missed(&mut planned, correction);
        assert!(missed * 4 < tried, "{missed} of {tried}");
    }
}

/// Second derivatives of every function, in constraints and forces, agree.
#[test]
fn every_function_is_accepted() {
    let declaration = "Functions {
        dof = 1;
        param l = 1 [m]; param e = 0.5;
        input u [N];
        gravity = (0, -9.81) [m/s^2];
        body a (x1, y1, p) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body b (x2, y2, q) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        constraint c1: x1 = l*(sin(p) + cos(2*p) + tan(p/4) + asin(e*sin(q)) - acos(e*cos(q)));
        constraint c2: y1 = l*(atan(p*q) + atan2(2 + sin(p), 3 + cos(q)) + sqrt(2 + sin(q)));
        constraint c3: x2 = l*(exp(sin(p)) + ln(3 + sin(q)) + pow(2 + cos(p), 1 + e*sin(q)) + (2 + sin(p))^1.5);
        constraint c4: y2 = l*(abs(p) + min(p, q) + max(sin(p), q) + tanh(p - q) + p^3/(2 + q^2));
        constraint c5: q = p/2 + e*sin(p) + 0.1*sin(3 [1/s]*t);
        force push on x1 = u*sign(x1) - 0.3 [N*s/m]*der(x1)*abs(p);
        output energy [J] = 0.5 [kg]*der(x1)^2 + lambda(c1)*y1;
        start { p = 0.3; }
    }";
    let mut planned = Planned::new(declaration);
    assert!(planned.is_accepted());
    let (tried, missed) = missed(&mut planned, FunctionId::Gamma);
    assert!(tried > 0 && missed == 0, "{missed} of {tried} wrong instructions of gamma are accepted");
}
