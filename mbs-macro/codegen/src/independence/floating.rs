//! Bodies that no joint or constraint connects to the ground.

use crate::model::{Body, Direction, Meaning, Model};

/// Their names. Two bodies are connected by an equation in coordinates of both,
/// and a body to the ground by one in its own alone, or by a position that it
/// lacks: `body slider (x)` stays on the x axis. Drives do not count: a motor
/// turns a shaft but does not carry it.
pub fn floating_bodies(model: &Model) -> Vec<&str> {
    let held: Vec<Vec<usize>> =
        model.constraints.iter().filter(|c| !c.is_drive).map(|c| bodies_in(model, c.declared())).collect();
    let lacks = |body: &Body, direction| model.coordinate_of(body, direction).is_none();
    let is_guided = |body: &Body| lacks(body, Direction::X) || lacks(body, Direction::Y);
    let mut is_grounded: Vec<bool> = model.bodies.iter().map(is_guided).collect();
    // From the ground outwards, until nothing is added.
    let mut count = 0;
    loop {
        for bodies in &held {
            if bodies.len() == 1 || bodies.iter().any(|&body| is_grounded[body]) {
                bodies.iter().for_each(|&body| is_grounded[body] = true);
            }
        }
        let now = is_grounded.iter().filter(|&&grounded| grounded).count();
        if now == count {
            break;
        }
        count = now;
    }
    let floating = model.bodies.iter().zip(is_grounded).filter(|(_, grounded)| !grounded);
    floating.map(|(body, _)| body.name.as_str()).collect()
}

/// The bodies whose coordinates are in an expression.
fn bodies_in(model: &Model, expr: mbs_symbolic::Expr) -> Vec<usize> {
    let mut bodies: Vec<usize> = model
        .arena
        .symbols_in(expr)
        .iter()
        .filter_map(|symbol| match model.meanings.get(symbol.index()) {
            Some(Meaning::Coordinate(at) | Meaning::Velocity(at)) => model.coordinates[*at].body(),
            _ => None,
        })
        .collect();
    bodies.sort_unstable();
    bodies.dedup();
    bodies
}
