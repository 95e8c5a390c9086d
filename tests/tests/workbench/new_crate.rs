//! The mechanism of a new crate, as `new` writes it.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use mbs_workbench::picture::Shape;
use mbs_workbench::{Picture, Settings, model};

#[path = "../../../mbs-runtime/workbench/template/lib.rs.in"]
mod template;

/// The first picture of a newcomer showed a mechanism without points.
#[test]
fn the_mechanism_of_a_new_crate_is_worth_looking_at() {
    let stepper = model::of::<template::Stepper>();
    let recording = stepper.simulate(&Settings::default(), &mut |_, _| ()).unwrap();
    assert_eq!((recording.ended, recording.doubts.len()), (None, 0));
    let picture = Picture::of(&stepper.motion(&Settings::default(), &recording).unwrap());
    let count = |is: fn(&Shape) -> bool| picture.shapes.iter().filter(|shape| is(shape)).count();
    assert_eq!(count(|shape| matches!(shape, Shape::Bar { .. })), 3);
    assert_eq!(count(|shape| matches!(shape, Shape::Ground { .. })), 2);
    assert!(count(|shape| matches!(shape, Shape::Pin { .. })) >= 4);
    assert!(!picture.traced.is_empty() && picture.times.len() > 100);
    // Straight for half a turn: for a quarter before and after half a second.
    let height = recording.column("foot_y").unwrap();
    assert_eq!(height.unit, "mm");
    assert!(height.values[501..1500].iter().all(|y| (y + 160.0).abs() < 0.4));
}
