//! Joints with play: contacts and stops that are written out do the same.

use mbs_live::{Prepared, Text};
use mbs_runtime::equations::Equations;
use mbs_runtime::{Adaptive, Dop853, Error, Sampled, System, Tolerances};

/// A block in a guide on a lever that swings, with `joint` between both.
fn guided(joint: &str) -> String {
    format!(
        "Guided {{
            dof = 4;
            gravity = (0.5, -9.81) [m/s^2];
            body lever (a, b, psi) {{ mass = 2 [kg]; inertia = 0.3 [kg*m^2]; }}
            body block (x, y, phi) {{ mass = 1 [kg]; inertia = 0.002 [kg*m^2]; }}
            point end on lever = (-0.3 [m], 0);
            point middle on lever = (0.1 [m], 0.02 [m]);
            point eye on block = (0.01 [m], 0);
            revolute pivot (lever.end, ground);
            {joint}
            start {{ psi = 0.1; x = 0.3861 [m]; y = 0.0588 [m]; phi = 0.1; der(x) = 0.1 [m/s]; guess a = 0.3 [m]; }}
        }}"
    )
}

fn at(text: &str, t: f64) -> Result<Vec<f64>, Error> {
    let live = Text::declaration("play.mbs", text).compile().expect("a mechanism");
    let tolerances = Tolerances { rtol: 1e-9, atol: 1e-12, ..Tolerances::default() };
    let built = Adaptive::builder(Prepared::new(&live)).scheme::<Dop853>().tolerances(tolerances).build()?;
    let mut run = Sampled::new(built, t)?;
    run.advance(1)?;
    let count = live.info().coordinates.len();
    let (mut q, mut v) = (vec![0.0; count], vec![0.0; count]);
    run.state(&mut q, &mut v);
    q.append(&mut v);
    Ok(q)
}

fn same(joint: &str, written_out: &str, apart: f64) -> Result<(), Error> {
    let [ours, theirs] = [joint, written_out].map(|joint| at(&guided(joint), 0.2));
    let (ours, theirs, free) = (ours?, theirs?, at(&guided(""), 0.2)?);
    for (a, b) in ours.iter().zip(&theirs) {
        assert!((a - b).abs() <= apart, "{joint}: {ours:?} {theirs:?}");
    }
    assert!(ours.iter().zip(&free).any(|(a, b)| (a - b).abs() > 1e-3), "{joint} does nothing");
    Ok(())
}

#[test]
fn a_pin_with_play_is_a_circle_in_a_bore() -> Result<(), Error> {
    let law = "stiffness = 1 [MN/m]; damping = 100 [N*s/m]; coefficient = 0.1; transition = 1 [cm/s];";
    same(
        &format!("revolute pin (block.eye, lever.middle) clearance = 1 [mm] {{ radius = 10 [mm]; {law} }}"),
        &format!(
            "circle pin on block = (0.01 [m], 0) radius 10 [mm]; bore hole on lever = (0.1 [m], 0.02 [m]) radius 11 [mm];
             contact c (block.pin, lever.hole) {{ {law} }}"
        ),
        1e-12,
    )
}

/// The block lies along its guide where both have the same angle, whatever the length of the direction.
#[test]
fn a_block_with_play_is_a_polygon_in_a_slot() -> Result<(), Error> {
    let law = "stiffness = 1 [MN/m]; damping = 100 [N*s/m]; coefficient = 0.1; transition = 1 [cm/s];";
    let guide = "prismatic guide (block.eye, lever.middle) along (3, 0) clearance = 1 [mm]";
    same(
        &format!("{guide} {{ length = 80 [mm]; height = 40 [mm]; {law} }}"),
        &format!(
            "polygon hull on block = (-0.03 [m], -0.02 [m]) to (0.05 [m], -0.02 [m]) to (0.05 [m], 0.02 [m]) to (-0.03 [m], 0.02 [m]);
             slot guide on lever = (0.1 [m], 0.02 [m]) along (1, 0) width 42 [mm];
             contact c (block.hull, lever.guide) {{ {law} }}"
        ),
        // roundings grow a hundredfold in each of some impacts
        1e-5,
    )
}

/// (c² − d²)/(2c) is c − d where d is c, so that impacts are those of the distance.
#[test]
fn a_pin_that_hits_is_a_stop_of_its_distance() -> Result<(), Error> {
    same(
        "revolute pin (block.eye, lever.middle) clearance = 1 [mm] { restitution = 0.3; }",
        "stop pin: distance(block.eye, lever.middle) <= 1 [mm] { restitution = 0.3; }",
        1e-6,
    )
}

#[test]
fn a_block_that_hits_is_four_stops_of_its_corners() -> Result<(), Error> {
    let corner = |name: &str, [a, b]: [&str; 2], sign: &str| {
        // across the guide, and along it
        let [x, y] = ["x", "y"].map(|of| format!("(block.{name}.{of} - lever.middle.{of})"));
        format!(
            "point {name} on block = ({a}, {b});
             stop at_{name}: {sign}({y}*cos(psi) - {x}*sin(psi)) <= 21 [mm] {{
                 restitution = 0.3; friction = 0.1; along = {x}*cos(psi) + {y}*sin(psi);
             }}"
        )
    };
    let corners = [
        corner("i", ["-0.03 [m]", "-0.02 [m]"], "-"),
        corner("j", ["0.05 [m]", "-0.02 [m]"], "-"),
        corner("k", ["0.05 [m]", "0.02 [m]"], ""),
        corner("l", ["-0.03 [m]", "0.02 [m]"], ""),
    ];
    same(
        "prismatic guide (block.eye, lever.middle) along (3, 0) clearance = 1 [mm] {
            length = 80 [mm]; height = 40 [mm]; restitution = 0.3; friction = 0.1;
        }",
        &corners.concat(),
        1e-6,
    )
}
