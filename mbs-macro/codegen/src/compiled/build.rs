//! From the stages of the compiler to the value that they give.

use super::derivation::readable;
use super::{
    Choices, Compiled, Condition, Constraint, Derivation, Event, Feedback, Friction, FunctionId, Input, Link,
    Lock, Mode, Pivot, Sampling, Sketch, SketchBody, Stop, Transition, Written,
};
use crate::derive::Equations;
use crate::model::{self, Block, Direction, Model};
use crate::plan::Plan;
use crate::quantity::Comparison;

impl Compiled {
    /// The results of all stages.
    pub(crate) fn new(model: Model, equations: &Equations, plan: Plan) -> Self {
        let symbols = plan.inputs.iter().enumerate().map(|(at, input)| {
            let name = model.arena.symbol_at(at).map_or("", |symbol| model.arena.name(symbol));
            (name.to_owned(), input)
        });
        let symbols = symbols.collect();
        let start = plan.programs[FunctionId::Start].evaluate(&model.values(|_| 0.0), &[]);
        Self {
            name: model.name.to_string(),
            doc: model.doc.clone(),
            places: places(&model),
            states: plan.inputs.states.iter().map(|state| state.coordinate).collect(),
            conditions: conditions(&model, equations, &plan),
            constraints: model.constraints.iter().map(|row| constraint(&model, row)).collect(),
            line_count: model.line_count(),
            degrees_of_freedom: model.line_count() as i32 - plan.rows.basis.len() as i32,
            redundant: plan.rows.watched(),
            has_stiffness: plan.has_stiffness,
            velocity_forces: velocity_forces(&model, equations, &plan),
            kept: [false, true].map(|is_rate| kept(&model, is_rate)),
            start,
            splines: model.arena.splines().to_vec(),
            corners: plan.corners.iter().map(|corner| corner.knots.clone()).collect(),
            switches: plan
                .switches
                .iter()
                .map(|it| (readable(&model.arena, it.value), it.knots.clone()))
                .collect(),
            sampling: sampling(&model),
            stops: model.stops.iter().map(|stop| stop_of(&model, stop)).collect(),
            frictions: model.frictions.iter().map(|friction| friction_of(&model, friction)).collect(),
            modes: model.modes.iter().map(Mode::from).collect(),
            locks: model.locks.iter().map(|lock| lock_of(&model, lock)).collect(),
            transitions: model.transitions.iter().map(Transition::from).collect(),
            jacobian: plan.phi_q_places.clone(),
            masses: plan.mass_places.clone(),
            pivots: pivots(&model, &plan.pivot_names),
            start_pivots: pivots(&model, &plan.start_pivot_names),
            derivation: Derivation::new(&model, equations, &plan),
            sketch: sketch(&model.sketch),
            choices: choices(&model.solver),
            written: written(&model),
            warnings: model.warnings,
            symbols,
            programs: plan.programs.into_vec(),
            fused_step: plan.fused_step,
            parameters: model.parameters,
            inputs: model.inputs,
            coordinates: model.coordinates.into_iter().map(|coordinate| coordinate.quantity).collect(),
            outputs: model.outputs.into_iter().map(|output| output.quantity).collect(),
            events: model.events.into_iter().map(Event::from).collect(),
        }
    }
}

/// The coordinates whose value, or rate, at the start is declared and no guess.
fn kept(model: &Model, is_rate: bool) -> Vec<usize> {
    let values = model.start.iter().filter(|start| start.is_rate == is_rate && !start.is_guess);
    values.map(|start| start.coordinate).collect()
}

/// The coordinates along which Q has terms in v or λ.
fn velocity_forces(model: &Model, equations: &Equations, plan: &Plan) -> Vec<usize> {
    let is_of_motion =
        |symbol| matches!(plan.inputs.of(symbol), Some(Input::Velocity(_) | Input::Multiplier(_)));
    let depends = |force| model.arena.symbols_in(force).into_iter().any(is_of_motion);
    let forces = equations.total_forces.iter().enumerate();
    forces.filter(|(_, force)| depends(**force)).map(|(coordinate, _)| coordinate).collect()
}

/// Where the x of a body has its y behind it.
fn places(model: &Model) -> Vec<usize> {
    let blocks: Vec<Block> = model.coordinates.iter().map(|coordinate| coordinate.block).collect();
    let neighbours = blocks.windows(2).enumerate().filter_map(|(at, pair)| match pair {
        [
            Block::Line { body, direction: Direction::X },
            Block::Line { body: other, direction: Direction::Y },
        ] if body == other => Some(at),
        _ => None,
    });
    neighbours.collect()
}

fn stop_of(model: &Model, stop: &model::Stop) -> Stop {
    let formula = readable(&model.arena, stop.contact.gap);
    Stop { quantity: stop.quantity.clone(), memory: stop.memory, force: stop.force, formula, span: stop.span }
}

fn friction_of(model: &Model, friction: &model::Friction) -> Friction {
    let [sliding, sticking] = friction.limits.map(|limit| readable(&model.arena, limit));
    Friction {
        name: friction.quantity.name.clone(),
        memory: friction.memory,
        limits: [sliding, sticking],
        stop: friction.stop,
        span: friction.span,
    }
}

fn lock_of(model: &Model, lock: &model::Lock) -> Lock {
    let is_rate = model.arena.is_zero(lock.contact.gap);
    let formula = readable(&model.arena, if is_rate { lock.contact.rate } else { lock.contact.gap });
    let model::Lock { name, mode, held, span, .. } = lock;
    Lock { name: name.clone(), mode: *mode, held: *held, is_rate, formula, span: *span }
}

impl From<&model::Mode> for Mode {
    fn from(mode: &model::Mode) -> Self {
        Self { name: mode.name.to_string(), memory: mode.memory }
    }
}

impl From<&model::Transition> for Transition {
    fn from(transition: &model::Transition) -> Self {
        let model::Transition { text, is_rising, is_strict, holds_near, sees_forces, memory, .. } =
            transition;
        let (text, holds_near, sees_forces) = (text.clone(), *holds_near, *sees_forces);
        Self { text, is_rising: *is_rising, is_strict: *is_strict, holds_near, sees_forces, memory: *memory }
    }
}

impl From<model::Event> for Event {
    fn from(model::Event { quantity, crossing, .. }: model::Event) -> Self {
        Self { quantity, crossing }
    }
}

/// The conditions on the results of [`Plan::requirements`], in their order.
fn conditions(model: &Model, equations: &Equations, plan: &Plan) -> Vec<Condition> {
    let mut conditions = Vec::new();
    for (at, requirement) in model.requirements.iter().enumerate() {
        conditions.push(Condition {
            name: requirement.name.clone(),
            difference: 2 * at,
            value: 2 * at + 1,
            comparison: requirement.comparison,
            requirement: requirement.text.clone(),
        });
    }
    let masses = 2 * model.requirements.len();
    for (at, coordinate) in model.coordinates.iter().enumerate() {
        let Block::Line { body, direction } = coordinate.block else { continue };
        let body = &model.bodies[body];
        let what = if direction == Direction::Angle { "inertia" } else { "mass" };
        // the mass along x and y is one
        if direction == Direction::Y && model.coordinate_of(body, Direction::X).is_some() {
            continue;
        }
        let other = at + 1;
        let has_other = direction == Direction::X && model.coordinate_of(body, Direction::Y) == Some(other);
        let is_alone = |at| is_accelerated_alone(at, model, equations, plan);
        let (comparison, requirement) = if is_alone(at) || (has_other && is_alone(other)) {
            (Comparison::Greater, "it has to be positive, since nothing else determines the acceleration")
        } else {
            (Comparison::GreaterOrEqual, "it must not be negative")
        };
        conditions.push(Condition {
            name: format!("{what} of {}", body.name),
            difference: masses + at,
            value: masses + at,
            comparison,
            requirement: requirement.to_owned(),
        });
    }
    let checks = masses + model.coordinates.len();
    for (at, check) in model.known_checks().enumerate() {
        conditions.push(Condition {
            name: format!("{} of {}", check.property, check.owner),
            difference: checks + at,
            value: checks + at,
            comparison: if check.is_strict { Comparison::Greater } else { Comparison::GreaterOrEqual },
            requirement: check.rule().to_owned(),
        });
    }
    conditions
}

/// True if the equation of motion along a coordinate is m q̈ = Q with the mass of its body alone: no constraint, no
/// lock of a mode and no other mass determines q̈ where m is 0.
fn is_accelerated_alone(at: usize, model: &Model, equations: &Equations, plan: &Plan) -> bool {
    equations.mass[at] == model.inertias[at].mass
        && !equations.couplings.keys().any(|&(i, j)| i == at || j == at)
        && !plan.phi_q_places.iter().any(|&(_, column)| column == at)
        && model.locks.is_empty()
}

fn constraint(model: &Model, row: &model::Constraint) -> Constraint {
    Constraint {
        name: row.name.clone(),
        doc: row.doc.clone(),
        formula: readable(&model.arena, row.declared()),
        is_drive: row.is_drive,
        is_rate: row.rate.is_some(),
        dimension: row.dimension,
    }
}

/// The names of what watched pivots pair.
fn pivots(model: &Model, pivots: &[(Option<usize>, Option<usize>)]) -> Vec<Pivot> {
    let pivot = |(row, coordinate): &(Option<usize>, Option<usize>)| Pivot {
        constraint: row.map_or_else(String::new, |at| model.constraints[at].name.clone()),
        coordinate: coordinate.map_or_else(String::new, |at| model.coordinates[at].quantity.name.clone()),
    };
    pivots.iter().map(pivot).collect()
}

fn sampling(model: &Model) -> Sampling {
    let sets = model.clocks.iter().map(|clock| &clock.sets);
    let sets = sets.chain(model.transitions.iter().map(|transition| &transition.sets)).enumerate();
    let samples = sets.flat_map(|(clock, sets)| sets.iter().map(move |(memory, _)| [clock, *memory]));
    Sampling { memories: model.memories, clocks: model.clocks.len(), samples: samples.collect() }
}

fn sketch(sketch: &model::Sketch) -> Sketch {
    let link = |link: &model::Link| Link {
        name: link.name.clone(),
        kind: link.kind,
        first: link.first,
        second: link.second,
        ahead: link.ahead,
    };
    let body = |body: &model::SketchBody| SketchBody {
        name: body.name.clone(),
        points: body.points.clone(),
        is_rigid: body.is_rigid,
    };
    Sketch {
        points: sketch.points.iter().map(|point| point.name.clone()).collect(),
        bodies: sketch.bodies.iter().map(body).collect(),
        ground: sketch.ground.clone(),
        particles: sketch.particles.clone(),
        joints: sketch.joints.iter().map(link).collect(),
        springs: sketch.springs.iter().map(link).collect(),
    }
}

fn choices(solver: &model::Solver) -> Choices {
    Choices {
        unrolled: solver.unrolled(),
        stack: solver.stack.map(|(limit, _)| limit),
        step: solver.step.map(|(step, _)| step),
        scheme: solver.scheme(),
        declares_scheme: solver.scheme.is_some(),
        feedback: solver.feedback.as_ref().map(|feedback| Feedback {
            is_held: feedback.is_held,
            alpha: feedback.alpha,
            beta: feedback.beta,
        }),
        has_reverse: solver.reverse.is_some(),
    }
}

fn written(model: &Model) -> Written {
    Written {
        name: model.name.clone(),
        visibility: model.visibility.clone(),
        runtime: model.runtime.clone(),
        stack: model.solver.stack.map(|(_, span)| span),
        feedback: model.solver.feedback.as_ref().map(|feedback| feedback.span),
    }
}
