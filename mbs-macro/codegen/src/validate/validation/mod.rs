//! Checks of the programs that are about to be emitted, against an independent
//! evaluation of the declaration. `functions` compares programs with Φ along curves,
//! and with forces and energies from their definitions. `solutions` puts solutions back
//! into the equations. `arguments` looks at what programs read.

mod arguments;
mod bodies;
mod functions;
mod solutions;

use mbs_interface::FunctionId;
use mbs_symbolic::{Expr, Operand, Program, Rounded, Symbol, Tape};

use self::bodies::{Bodies, Moved, dot, evaluate};
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::independence::Samples;
use crate::independence::assembly::Assembly;
use crate::inputs::Input;
use crate::model::{Direction, Meaning, Model};
use crate::plan::Plan;

/// Directions in which rows and the balance of forces are looked at.
const DIRECTIONS: usize = 3;

/// Everything agrees at the sampled positions.
///
/// # Errors
/// The first function that does not, as the compiler's own fault.
pub fn check_programs(
    model: &Model,
    equations: &Equations,
    plan: &Plan,
    samples: &Samples,
) -> Result<(), Diagnostics> {
    arguments::check(model, plan).map_err(|wrong| Diagnostic::internal(model.name.span(), wrong))?;
    if has_extreme_numbers(model, plan) {
        return Ok(());
    }
    let declared: Vec<Expr> = model.constraints.iter().map(|constraint| constraint.declared()).collect();
    let tape = Tape::new(&model.arena, &declared);
    let hoisted = run(&plan.programs[FunctionId::Hoisted], &model.values(|_| f64::NAN), &[]);
    // Redundant constraints repeat the others on Φ = 0 only.
    let assembled = (!plan.rows.redundant.is_empty()).then(|| {
        let assembly = Assembly::new(model, equations);
        // all, since those that are solved for may leave others far off where they nearly depend on each other
        let all: Vec<usize> = (0..plan.rows.count).collect();
        assembly.close(&all, &samples.start_position(model)).at
    });
    for position in samples.positions() {
        let sample = |symbol: Symbol| match (model.meanings.get(symbol.index()), &assembled) {
            (Some(Meaning::Coordinate(at)), Some(assembled)) => assembled.q[*at],
            (Some(Meaning::Time), Some(assembled)) => assembled.t,
            _ => samples.value(symbol, position),
        };
        let symbol = completed(model, plan, &hoisted, &sample);
        let bodies = Bodies::new(model, &symbol);
        let point = Point { model, plan, tape: &tape, hoisted: &hoisted, bodies: &bodies, symbol: &symbol };
        let found = point.functions().and_then(|()| point.solutions());
        found.map_err(|wrong| Diagnostic::internal(model.name.span(), wrong))?;
    }
    Ok(())
}

/// A sample whose coordinates are what those that are integrated make of them.
fn completed<'a>(
    model: &'a Model,
    plan: &'a Plan,
    hoisted: &[Rounded],
    sample: &'a impl Fn(Symbol) -> f64,
) -> impl Fn(Symbol) -> f64 + 'a {
    let coordinate = |at: usize| &model.coordinates[plan.inputs.states[at].coordinate];
    let given = move |symbol: Symbol| match plan.inputs.of(symbol) {
        Some(Input::StatePosition(at)) => sample(coordinate(at).position),
        Some(Input::StateVelocity(at)) => sample(coordinate(at).velocity),
        _ => sample(symbol),
    };
    let hoisted: Vec<f64> = hoisted.iter().map(|hoisted| hoisted.value).collect();
    let all = plan.programs[FunctionId::Complete].evaluate(&given, &hoisted);
    let n = model.coordinates.len();
    move |symbol| match model.meanings.get(symbol.index()) {
        Some(Meaning::Coordinate(at)) => all[*at],
        Some(Meaning::Velocity(at)) => all[n + at],
        _ => given(symbol),
    }
}

/// True if products of two or three of the declared numbers leave the range of a
/// double: what comes of that tells nothing.
fn has_extreme_numbers(model: &Model, plan: &Plan) -> bool {
    let is_extreme = |x: f64| x != 0.0 && !(1e-100..1e100).contains(&x.abs());
    let programs = [
        &plan.programs[FunctionId::Hoisted],
        &plan.programs[FunctionId::Phi],
        &plan.programs[FunctionId::Gamma],
        &plan.programs[FunctionId::Forces],
        &plan.programs[FunctionId::Mass],
    ];
    let numbers = programs.iter().flat_map(|program| &program.instructions).flat_map(|i| [i.a, i.b]);
    let in_code = numbers.into_iter().any(|operand| match operand {
        Operand::Number(number) => is_extreme(number.to_f64()),
        _ => false,
    });
    in_code || model.parameters.iter().any(|parameter| is_extreme(parameter.value))
}

/// Rows and their derivatives along a curve.
type Jet = mbs_symbolic::Jet<Rounded>;

/// The results of a program with the bounds of their errors.
fn run(program: &Program, symbol: &dyn Fn(Symbol) -> f64, hoisted: &[Rounded]) -> Vec<Rounded> {
    program.evaluate_with(&|s| Rounded::exact(symbol(s)), &|at| hoisted[at])
}

/// The result of a check; its error is the fault in words.
type Check = Result<(), String>;

#[derive(Clone, Copy)]
struct Point<'a> {
    model: &'a Model,
    plan: &'a Plan,
    tape: &'a Tape,
    hoisted: &'a [Rounded],
    bodies: &'a Bodies,
    symbol: &'a dyn Fn(Symbol) -> f64,
}

impl Point<'_> {
    fn run(&self, program: &Program) -> Vec<Rounded> {
        run(program, self.symbol, self.hoisted)
    }

    /// Φ along q + s·first + s²/2·second, t + s·rate.
    fn phi(&self, first: &dyn Fn(usize) -> f64, second: &dyn Fn(usize) -> f64, rate: f64) -> Vec<Jet> {
        let along = |speed: f64| {
            self.tape.jets(&self.model.arena, &|symbol| {
                let along = match self.model.meanings.get(symbol.index()) {
                    Some(Meaning::Time) => [(self.symbol)(symbol), rate, 0.0],
                    Some(Meaning::Coordinate(at)) => [(self.symbol)(symbol), first(*at), second(*at)],
                    // in equations between rates
                    Some(Meaning::Velocity(at)) => [speed * first(*at), speed * second(*at), 0.0],
                    _ => [(self.symbol)(symbol), 0.0, 0.0],
                };
                let [value, first, second] = along.map(Rounded::exact);
                Jet { value, first, second }
            })
        };
        let has_rates = self.model.constraints.iter().any(|constraint| constraint.rate.is_some());
        let (motion, rest) = (along(1.0), if has_rates { along(0.0) } else { Vec::new() });
        let rows = self.model.constraints.iter().enumerate().zip(motion);
        rows.map(|((at, constraint), motion)| match (&constraint.rate, rest.get(at)) {
            // A v + b, of which b counts where time passes
            (Some(_), Some(rest)) => {
                let still = Rounded::exact(rate - 1.0);
                let first = motion.value + still * rest.value;
                Jet { value: Rounded::default(), first, second: motion.first }
            }
            _ => motion,
        })
        .collect()
    }

    fn velocity(&self, at: usize) -> f64 {
        (self.symbol)(self.model.coordinates[at].velocity)
    }

    fn value(&self, expr: Expr) -> Rounded {
        evaluate(self.model, &[expr], self.symbol).first().copied().unwrap_or_default()
    }

    /// −2αΦ̇ − β²Φ, and −αΦ̇ of an equation between rates
    fn feedback(&self, motion: &[Jet]) -> Vec<Rounded> {
        let inputs = &self.plan.inputs;
        let gains = [inputs.minus_two_alpha, inputs.minus_beta_squared];
        let [damping, stiffness] = gains.map(|gain| Rounded::exact((self.symbol)(gain)));
        let rows = self.model.constraints.iter().zip(motion);
        rows.map(|(constraint, row)| match constraint.rate {
            Some(_) => Rounded::exact(0.5) * damping * row.first,
            None => damping * row.first + stiffness * row.value,
        })
        .collect()
    }

    /// Numbers of order 1 that are not in any relation to each other.
    fn weight(&self, at: usize, direction: usize) -> f64 {
        1.0 + ((at + 1) as f64 * (direction as f64 + 0.618)).sin()
    }

    /// The diagonal entry of M.
    fn mass(&self, at: usize) -> Rounded {
        self.bodies.masses.get(&(at, at)).copied().unwrap_or_default()
    }

    /// Every entry of M with its row and its column.
    fn over_masses(&self, mut each: impl FnMut(Rounded, usize, usize)) {
        for (&(i, j), &mass) in &self.bodies.masses {
            each(mass, i, j);
            if i != j {
                each(mass, j, i);
            }
        }
    }

    fn gravity(&self, at: usize) -> Rounded {
        match self.model.coordinates[at].direction() {
            Some(Direction::X) => self.bodies.gravity[0],
            Some(Direction::Y) => self.bodies.gravity[1],
            Some(Direction::Angle) | None => Rounded::default(),
        }
    }

    /// Q without the loads that depend on reactions.
    fn known_forces(&self) -> Vec<Rounded> {
        let weight = |at: usize| self.bodies.own[at] * self.gravity(at);
        let mut forces: Vec<_> = (0..self.model.coordinates.len()).map(weight).collect();
        for Moved { mass, place, columns } in &self.bodies.particles {
            let pull = [0, 1].map(|at| self.bodies.gravity[at] - place[at].second);
            for (at, column) in columns {
                forces[*at] = forces[*at] + *mass * dot(*column, pull);
            }
        }
        for load in &self.model.loads {
            forces[load.coordinate] = forces[load.coordinate] + self.value(load.value);
        }
        forces
    }
}

#[cfg(test)]
pub(crate) mod tests;
