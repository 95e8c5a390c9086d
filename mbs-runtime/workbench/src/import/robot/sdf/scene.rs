//! The model of a file that moves, and what is around it.

use roxmltree::Node;

use super::values::{is_set, text};
use crate::import::robot::space::Vector;
use crate::import::robot::xml::{described, elements, elements_named, exactly};
use crate::import::{Refusal, shown};

/// The gravity of a world that says none.
const GRAVITY: Vector = [0.0, 0.0, -9.8];

/// Models of other files that stand still: the light, and the floor.
const STILL: [&str; 2] = ["sun", "ground_plane"];

/// A model, and what acts on it.
pub(super) struct Scene<'a, 'i> {
    pub model: Node<'a, 'i>,
    pub gravity: Vector,
    pub notes: Vec<String>,
}

/// The only model of a file that moves: in its world, or without one.
pub(super) fn read<'a, 'i>(root: Node<'a, 'i>) -> Result<Scene<'a, 'i>, Refusal> {
    let mut worlds = elements_named(root, "world");
    let (place, gravity, mut notes) = match worlds.next() {
        Some(world) => (world, gravity(world)?, surroundings(world)?),
        None => {
            let note = "the file has no world: its gravity is the usual one of SDF, 9.8 m/s^2 against z";
            (root, GRAVITY, vec![note.into()])
        }
    };
    if let Some(second) = worlds.next() {
        return Err(Refusal(format!("{} is the second one of the file", described("world", second))));
    }
    if let Some(include) = elements_named(root, "include").next() {
        return Err(self::include(include));
    }
    let all: Vec<Node<'_, '_>> = elements_named(place, "model").collect();
    // A model alone may be static: it is refused for that, and not as missing.
    let (still, moving): (Vec<_>, Vec<_>) =
        all.iter().copied().partition(|model| all.len() > 1 && is_set(*model, "static"));
    for model in still {
        let of = described("model", model);
        notes.push(format!("not carried over: {of}, which is static and could act by contacts alone"));
    }
    let model = *moving.first().ok_or_else(|| Refusal("it has no model that moves".into()))?;
    match moving.get(1) {
        None => Ok(Scene { model, gravity, notes }),
        Some(second) => Err(Refusal(format!(
            "{} moves besides {}; one model of a file is imported",
            described("model", *second),
            described("model", model)
        ))),
    }
}

fn gravity(world: Node<'_, '_>) -> Result<Vector, Refusal> {
    let of = described("world", world);
    text(world, "gravity").map_or(Ok(GRAVITY), |text| exactly(text, "gravity", &of))
}

/// What of a world is left out, in notes.
fn surroundings(world: Node<'_, '_>) -> Result<Vec<String>, Refusal> {
    let mut notes = Vec::new();
    for node in elements(world) {
        let name = node.tag_name().name();
        let of = described(name, node);
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

/// Whether an include names a model that everybody knows to stand still.
fn is_still(node: Node<'_, '_>) -> bool {
    let name = text(node, "uri").and_then(|uri| uri.rsplit('/').next()).unwrap_or_default();
    STILL.contains(&name.to_ascii_lowercase().replace("%20", "_").replace(' ', "_").as_str())
}

/// The refusal of what is in another file.
pub(super) fn include(node: Node<'_, '_>) -> Refusal {
    let (of, uri) = (described("include", node), shown(text(node, "uri").unwrap_or_default()));
    Refusal(format!(
        "{of} names the other file {uri}, which is not read; `gz sdf -p` prints a file with its includes in it"
    ))
}
