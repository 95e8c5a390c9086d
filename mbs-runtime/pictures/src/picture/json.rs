//! Shapes as data for the script of a page.

use serde_json::{Value, json};

use super::Shape;

/// A shape for the script that draws it.
pub fn shape(shape: &Shape) -> Value {
    match shape {
        Shape::Rail { from, ahead, reach } => {
            json!({ "kind": "rail", "from": from, "ahead": ahead, "reach": reach })
        }
        Shape::Ground { at } => json!({ "kind": "ground", "at": at }),
        Shape::Link { between } => json!({ "kind": "link", "points": between }),
        Shape::Circle { at, rim, colour } => {
            json!({ "kind": "circle", "at": at, "rim": rim, "colour": colour })
        }
        Shape::Spring { between } => json!({ "kind": "spring", "points": between }),
        Shape::Bar { between, colour } => json!({ "kind": "bar", "points": between, "colour": colour }),
        Shape::Plate { corners, colour } => json!({ "kind": "plate", "points": corners, "colour": colour }),
        Shape::Dot { at, colour } => json!({ "kind": "dot", "at": at, "colour": colour }),
        Shape::Block { at, from, ahead, colour } => {
            json!({ "kind": "block", "at": at, "from": from, "ahead": ahead, "colour": colour })
        }
        Shape::Coil { at } => json!({ "kind": "coil", "at": at }),
        Shape::Pin { at } => json!({ "kind": "pin", "at": at }),
        Shape::Weld { at } => json!({ "kind": "weld", "at": at }),
        Shape::Centre { at } => json!({ "kind": "centre", "at": at }),
        Shape::Mark { between, text } => json!({ "kind": "mark", "points": between, "text": text }),
        Shape::Label { text, near, colour } => {
            json!({ "kind": "label", "points": near, "text": text, "colour": colour })
        }
    }
}
