//! The model of a file that moves, and what is around it.

use crate::xml::Node;

use super::values::{is_set, text};
use crate::robot::numbers::exactly;
use crate::robot::space::Vector;
use crate::{Refusal, shown};

/// The gravity of a world that says none.
const GRAVITY: Vector = [0.0, 0.0, -9.8];

/// Models of other files that stand still: the light, and the floor.
const STILL: [&str; 2] = ["sun", "ground_plane"];

/// A model, and what acts on it.
pub(super) struct Scene<'a> {
    pub model: Node<'a>,
    pub gravity: Vector,
    pub notes: Vec<String>,
}

/// The only model of a file that moves: in its world, or without one.
pub(super) fn read<'a>(root: Node<'a>, wanted: Option<&str>) -> Result<Scene<'a>, Refusal> {
    let mut worlds = root.elements_named("world");
    let (place, gravity, mut notes) = match worlds.next() {
        Some(world) => (world, gravity(world)?, surroundings(world)?),
        None => {
            let note = "the file has no world: its gravity is the usual one of SDF, 9.8 m/s^2 against z";
            (root, GRAVITY, vec![note.into()])
        }
    };
    if let Some(second) = worlds.next() {
        return Err(Refusal(format!("{} is the second one of the file", second.described("world"))));
    }
    if let Some(include) = root.elements_named("include").next() {
        return Err(self::include(include));
    }
    let all: Vec<Node<'_>> = place.elements_named("model").collect();
    // A model alone may be static: it is refused for that, and not as missing.
    let (still, mut moving): (Vec<_>, Vec<_>) =
        all.iter().copied().partition(|model| all.len() > 1 && is_set(*model, "static"));
    if let Some(wanted) = wanted {
        let others;
        (moving, others) = moving.into_iter().partition(|model| model.attribute("name") == Some(wanted));
        if moving.is_empty() {
            let known: Vec<String> =
                others.iter().filter_map(|model| model.attribute("name").map(str::to_owned)).collect();
            return Err(Refusal(mbs_words::names::unknown("model that moves", wanted, &known)));
        }
        notes.extend(others.iter().map(|other| {
            format!("not carried over: {}, which is not the one wanted", other.described("model"))
        }));
    }
    for model in still {
        let of = model.described("model");
        notes.push(format!("not carried over: {of}, which is static and could act by contacts alone"));
    }
    let model = *moving.first().ok_or_else(|| Refusal("it has no model that moves".into()))?;
    match moving.get(1) {
        None => Ok(Scene { model, gravity, notes }),
        Some(second) => Err(Refusal(format!(
            "{} moves besides {}; one model of a file is imported: --model NAME says which one",
            second.described("model"),
            model.described("model")
        ))),
    }
}

fn gravity(world: Node<'_>) -> Result<Vector, Refusal> {
    let of = world.described("world");
    // Until SDF 1.5 it was in the physics.
    let of_physics = world.elements_named("physics").find_map(|physics| text(physics, "gravity"));
    text(world, "gravity").or(of_physics).map_or(Ok(GRAVITY), |text| exactly(text, "gravity", &of))
}

/// Notes on the parts of a world that are left out.
fn surroundings(world: Node<'_>) -> Result<Vec<String>, Refusal> {
    let mut notes = Vec::new();
    for node in world.elements() {
        let name = node.name();
        let of = node.described(name);
        match name {
            "include" if is_still(node) => {
                notes.push(format!("not carried over: {of}, which could act by contacts alone"));
            }
            "include" => return Err(include(node)),
            "joint" => {
                return Err(Refusal(format!(
                    "{of} is in the world; joints are imported that are in the model, with the parent `world`"
                )));
            }
            "plugin" | "state" | "actor" | "population" => notes.push(format!("not carried over: {of}")),
            _ => {}
        }
    }
    Ok(notes)
}

/// True if an include names a model that everybody knows to stand still.
fn is_still(node: Node<'_>) -> bool {
    let name = text(node, "uri").and_then(|uri| uri.rsplit('/').next()).unwrap_or_default();
    STILL.contains(&name.to_ascii_lowercase().replace("%20", "_").replace(' ', "_").as_str())
}

/// The refusal of what is in another file.
pub(super) fn include(node: Node<'_>) -> Refusal {
    let (of, uri) = (node.described("include"), shown(text(node, "uri").unwrap_or_default()));
    Refusal(format!(
        "{of} names the other file {uri}, which is not read; `gz sdf -p` prints a file with its includes in it"
    ))
}
