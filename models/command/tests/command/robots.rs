//! Files of robots, MJCF, URDF and SDF: what they become, compared with what MuJoCo and Drake
//! compute of the same files.

use std::fs;
use std::path::Path;

use super::imports::{data, imported, run, table};

/// The declaration of a file, with the accelerations of its joints as outputs.
#[track_caller]
pub(super) fn with_accelerations(folder: &Path, file: &Path) -> String {
    let text = imported(folder, file);
    let coordinates = text.lines().filter_map(|line| line.trim().strip_prefix("let "));
    let names = coordinates.filter_map(|line| line.split_once("_q = ").map(|(name, _)| name.to_owned()));
    let output = |name: String| {
        let unit = if text.contains(&format!("output {name}_angle")) { "rad/s^2" } else { "m/s^2" };
        format!("    output acc_{name} [{unit}] = der(der({name}_q));\n")
    };
    let outputs: String = names.map(output).collect();
    let declared = text.trim_end().strip_suffix('}').unwrap();
    fs::write(folder.join("linkage.mbs"), format!("{declared}{outputs}}}\n")).unwrap();
    text
}

/// Runs a file for 0.5 s and compares with the table of numbers: joints to a tolerance,
/// accelerations at the start to rounding.
#[track_caller]
fn is_as_in_the_reference(file: &str, reference: &str, inputs: &str, tolerance: f64) {
    let folder = tempfile::tempdir().unwrap();
    let text = with_accelerations(folder.path(), &data(file));
    moves_as(file, &text, folder.path(), (reference, inputs), tolerance);
}

#[track_caller]
fn moves_as(file: &str, text: &str, folder: &Path, (reference, inputs): (&str, &str), tolerance: f64) {
    let (header, expected) = table(&data(reference));
    let name = |column: &String| {
        let endings = ["", "_angle", "_position"].map(|ending| format!("{column}{ending}"));
        let is_output = |name: &String| text.contains(&format!("output {name} ["));
        endings.into_iter().find(is_output).unwrap_or_else(|| column.clone())
    };
    let names: Vec<String> = header.iter().map(name).collect();
    let found = run(folder, &format!("--step 50ms --end 0.5s {inputs}"), &names);
    assert_eq!(found.len(), expected.len(), "{file}");
    for (row, (found, expected)) in found.iter().zip(&expected).enumerate() {
        for ((found, expected), column) in found.iter().zip(expected).zip(&names) {
            let allowed = match (column.starts_with("acc_"), row) {
                (true, 0) => 1e-12 * expected.abs().max(1.0),
                // later ones follow from positions and rates: they are not compared
                (true, _) => continue,
                _ => tolerance,
            };
            let off = (found - expected).abs();
            assert!(off <= allowed, "{file}: {column} is {found} at {} s, not {expected}", 0.05 * row as f64);
        }
    }
}

/// The accelerations at the start agree to rounding: sums of some ten products of numbers up to
/// 50 (2e-13 at most was found). The positions agree as the run's tolerance of 1e-11 and the
/// error of the reference, which is in its file, let them.
#[test]
fn motions_are_those_of_mujoco() {
    is_as_in_the_reference("double_pendulum.xml", "double_pendulum.csv", "--input drive=0.2", 1e-10);
    is_as_in_the_reference("cart_pole.xml", "cart_pole.csv", "--input slide=0.7", 1e-10);
    is_as_in_the_reference(
        "table.xml",
        "table.csv",
        "--input hold=0.1 --input turn_motor=0.5 --input push=0.3",
        1e-10,
    );
    is_as_in_the_reference("arm.urdf", "arm.csv", "", 1e-10);
}

/// The pendulum of Gazebo has what SDF gives to links that say nothing, and axes and poses of
/// SDF 1.5; the crane has frames, poses relative to others, springs with rests, and axes in other
/// frames. The accelerations at the start agree to rounding, as those of MuJoCo do.
#[test]
fn motions_of_sdf_are_those_of_drake() {
    is_as_in_the_reference("pendulum.sdf", "pendulum.csv", "", 1e-10);
    is_as_in_the_reference("crane.sdf", "crane.csv", "", 1e-10);
}

/// Two loops, closed by a hinge with a spring and by a ball, in a plane that no axis of the file
/// names; one joint has its parent and its child the other way round.
#[test]
fn closed_loops_of_sdf_move_as_drakes_matrices_say() {
    is_as_in_the_reference("press.sdf", "press.csv", "", 1e-10);
}

/// The same press with its slide behind the others: it is what closes the loop then.
#[test]
fn a_slide_closes_a_loop_too() {
    let press = fs::read_to_string(data("press.sdf")).unwrap();
    let (before, rest) = press.split_once("      <joint name=\"guide\"").unwrap();
    let (guide, after) = rest.split_once("</joint>\n").unwrap();
    let (joints, end) = after.split_once("    </model>").unwrap();
    let later = format!("{before}{joints}<joint name=\"guide\"{guide}</joint></model>{end}");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("later.sdf");
    fs::write(&file, later).unwrap();
    let text = with_accelerations(folder.path(), &file);
    let at = |joint: &str| text.find(&format!("output {joint} [")).unwrap();
    assert!(at("guide_position") > at("wrist_angle"), "{text}");
    moves_as("later.sdf", &text, folder.path(), ("press.csv", ""), 1e-10);
}

/// Pinion and wheel turn against each other as q, -q/4, and the needle as half of the wheel: by
/// hand, with J = J1 + J2/16 + J3/64, q = (rest + M/k)(1 - cos(t sqrt(k/J))). The tolerance is
/// that of the run, in a motion of 0.6 rad.
#[test]
fn gears_of_sdf_turn_as_their_ratios_say() {
    let folder = tempfile::tempdir().unwrap();
    imported(folder.path(), &data("gears.sdf"));
    let names = ["t", "input_angle", "output_angle", "hand_angle"].map(str::to_owned);
    let rows = run(folder.path(), "--step 50ms --end 0.5s --input input_effort=0.08", &names);
    let (stiffness, inertia) = (0.8f64, 0.002 + 0.03 / 16.0 + 0.004 / 64.0);
    let size = 0.5 + 0.08 / stiffness;
    assert_eq!(rows.len(), 11);
    for row in rows {
        let angle = size * (1.0 - (row[0] * (stiffness / inertia).sqrt()).cos());
        for (found, expected) in row[1..].iter().zip([angle, -angle / 4.0, -angle / 8.0]) {
            assert!((found - expected).abs() < 1e-9, "at {} s: {found}, not {expected}", row[0]);
        }
    }
}

/// Gravity is taken from all links or from none.
#[test]
fn a_model_of_sdf_whose_links_float_has_no_gravity() {
    let folder = tempfile::tempdir().unwrap();
    let gears = fs::read_to_string(data("gears.sdf")).unwrap();
    let floating = gears.replace("<link name=\"case\"/>", "<link name=\"case\"></link>");
    let floating = floating.replace("</link>", "<gravity>false</gravity></link>");
    fs::write(folder.path().join("floating.sdf"), floating).unwrap();
    let text = imported(folder.path(), &folder.path().join("floating.sdf"));
    assert!(text.contains("gravity = (0, 0) [m/s^2];"), "{text}");
}

/// The plane of a file says where its axes point: along y or, in the frame of a link that is
/// turned, along z. SDF 1.4 and a flag of 1.5 and 1.6 mean the model's y; since 1.7 the flag is
/// gone and axes may name their frame.
#[test]
fn axes_of_sdf_are_in_the_frame_that_its_version_says() {
    let plane = |version: &str, axis: &str, flag: &str| {
        let file = format!(
            "<sdf version='{version}'><model name='m'><link name='a'><pose>0 0 0 1.5707963267948966 0 0</pose></link>\
             <joint name='j' type='revolute'><parent>world</parent><child>a</child><axis>{axis}{flag}</axis></joint>\
             </model></sdf>"
        );
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("axis.sdf");
        fs::write(&path, file).unwrap();
        let text = imported(folder.path(), &path);
        let of = text.lines().next().unwrap().split("in its plane ").nth(1).unwrap().to_owned();
        (of, text.contains("// Not carried over: `use_parent_model_frame`"))
    };
    let (y, flag) = ("<xyz>0 1 0</xyz>", "<use_parent_model_frame>1</use_parent_model_frame>");
    let (of_model, of_joint) = ("x-z.".to_owned(), "x-y.".to_owned());
    assert_eq!(plane("1.4", y, ""), (of_model.clone(), false));
    assert_eq!(plane("1.5", y, ""), (of_joint.clone(), false));
    assert_eq!(plane("1.6", y, flag), (of_model.clone(), false));
    assert_eq!(plane("1.7", y, flag), (of_joint.clone(), true));
    assert_eq!(plane("1.7", "<xyz expressed_in='__model__'>0 1 0</xyz>", ""), (of_model, false));
    assert_eq!(plane("1.12", "<xyz expressed_in='a'>0 1 0</xyz>", ""), (of_joint, false));
}

/// Closed loops of `connect`, of bodies and of sites, `weld` and `joint`, which are constraints in
/// the reference too. The crank of the four-bar passes a place where the rocker is fast, which
/// lets the errors of the run and of the reference grow: 5e-9 was found, and 3e-10 of the others.
#[test]
fn closed_loops_move_as_mujocos_matrices_say() {
    is_as_in_the_reference("loops.xml", "loops.csv", "", 1e-9);
    is_as_in_the_reference("four_bar.xml", "four_bar_of_mujoco.csv", "--input torque=0.1", 2e-8);
}

/// Masses agree to rounding of a few operations, and so do inertias, which MuJoCo turns to
/// principal axes and back.
#[test]
fn masses_of_geoms_are_those_of_mujoco() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("solids.xml"));
    let reference = fs::read_to_string(data("solids.csv")).unwrap();
    let rows: Vec<Vec<&str>> = reference.lines().skip(2).map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 8);
    for row in rows {
        for (ending, expected) in ["mass", "inertia"].into_iter().zip(&row[1..]) {
            let start = format!("param {}_{ending} = ", row[0]);
            let (_, rest) = text.split_once(&start).unwrap();
            let found: f64 = rest.split(' ').next().unwrap().parse().unwrap();
            let expected: f64 = expected.parse().unwrap();
            assert!((found - expected).abs() < 1e-12 * expected, "{start}{found}, MuJoCo has {expected}");
        }
    }
}

/// A joint that mimics another one: by hand, follow = 0.1 - open/2 at every time.
#[test]
fn a_joint_that_mimics_another_follows_it() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("gripper.urdf"));
    assert!(
        text.contains("dof = 1;") && text.contains("the dry friction of the joint `open` (line 5)"),
        "{text}"
    );
    let names = ["open_angle", "follow_angle"].map(str::to_owned);
    let rows = run(folder.path(), "--end 0.5s --input open_motor=0.01", &names);
    let last = rows.last().unwrap();
    assert!((last[0] - rows[0][0]).abs() > 0.1, "it moves: {last:?}");
    for row in rows {
        assert!((row[1] - (0.1 - 0.5 * row[0])).abs() < 1e-9, "{row:?}");
    }
}

/// URDF may say to MuJoCo, in an element of that name, how it is to be read.
#[test]
fn a_file_of_urdf_that_speaks_to_mujoco_is_urdf() {
    let folder = tempfile::tempdir().unwrap();
    let gripper = fs::read_to_string(data("gripper.urdf")).unwrap();
    let (head, rest) = gripper.split_once("<link").unwrap();
    let head = format!("<!-- for <mujoco> -->\n{}", head.replace("<?xml version=\"1.0\"?>", ""));
    let file = format!("{head}<mujoco><compiler discardvisual=\"false\"/></mujoco><link{rest}");
    fs::write(folder.path().join("both.urdf"), file).unwrap();
    let text = imported(folder.path(), &folder.path().join("both.urdf"));
    assert!(text.contains("of ROS (URDF)"), "{text}");
}

/// An equality of one joint has the usual polynomial of two, of which its constant counts.
#[test]
fn an_equality_of_one_joint_fixes_it() {
    let folder = tempfile::tempdir().unwrap();
    let pendulum = fs::read_to_string(data("double_pendulum.xml")).unwrap();
    let held = |equality: &str| {
        let end = format!("<equality>{equality}</equality></mujoco>");
        fs::write(folder.path().join("held.xml"), pendulum.replace("</mujoco>", &end)).unwrap();
        imported(folder.path(), &folder.path().join("held.xml"))
    };
    let joint = pendulum.split("<joint name=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
    let text = held(&format!("<joint joint1=\"{joint}\"/>"));
    assert!(text.contains("dof = 1;") && text.contains(" = 0;"), "{text}");
    let text = held(&format!("<joint joint1=\"{joint}\" polycoef=\"0.2 1 0 0 0\"/>"));
    assert!(text.contains("dof = 1;") && text.contains(" = (0.2);"), "{text}");
}

/// A file may have equalities and take them away.
#[test]
fn equalities_that_a_flag_takes_away_are_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let four_bar = fs::read_to_string(data("four_bar.xml")).unwrap();
    let flag = "<flag constraint=\"disable\"/></option>";
    let open = four_bar.replacen("gravity=\"0 0 -9.81\"/>", &format!("gravity=\"0 0 -9.81\">{flag}"), 1);
    fs::write(folder.path().join("open.xml"), open).unwrap();
    let text = imported(folder.path(), &folder.path().join("open.xml"));
    assert!(text.contains("dof = 3;"), "{text}");
    assert!(text.contains("// Not carried over: the equality in line 20: a flag takes it away."), "{text}");
}

/// An `option` behind the one with the flag gave it back.
#[test]
fn gravity_that_a_flag_takes_away_stays_away() {
    let folder = tempfile::tempdir().unwrap();
    let four_bar = fs::read_to_string(data("four_bar.xml")).unwrap();
    let flag = "<option><flag gravity=\"disable\"/></option>";
    let without = four_bar.replacen("<option", &format!("{flag}<option"), 1);
    assert_ne!(without, four_bar);
    fs::write(folder.path().join("without.xml"), without).unwrap();
    let text = imported(folder.path(), &folder.path().join("without.xml"));
    assert!(text.contains("gravity = (0, 0) [m/s^2];"), "{text}");
}

#[test]
fn what_a_robot_loses_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("cart_pole.xml"));
    for part in [
        "// The mechanism `cart-pole` from the file `cart_pole.xml` of MuJoCo, in its plane x-z.",
        "// Not carried over: the stops (`range`) of the joint `slider` (line 6).",
        "// Not carried over: the limits (`ctrlrange`) of the motor `slide` (line 15).",
        "param pole_1_mass = 0.1 [kg]",
        "param slider_damping = 0.0005 [N*s/m]",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let text = imported(folder.path(), &data("crane.sdf"));
    for part in [
        "// The mechanism `crane on a rail` from the file `crane.sdf` of Gazebo (SDF), in its plane x-z.",
        "// Not carried over: the include in line 5, which could act by contacts alone.",
        "// Not carried over: the model `floor` (line 6), which is static and could act by contacts alone.",
        "// Not carried over: contacts: bodies pass through each other.",
        "// Not carried over: the limits of the joint `rail` (line 47).",
        "// Not carried over: the dry friction of the joint `wrist` (line 73).",
        "// Not carried over: the sensor `imu` (line 28).",
        "point tip on jib = ",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert_eq!(text.matches("the limits of").count(), 1, "a limit of 1e16 is none:\n{text}");
    let text = imported(folder.path(), &data("gripper.urdf"));
    for part in [
        "of ROS (URDF), in its plane x-y.",
        "// The file has no gravity: 9.81 m/s^2 against z is assumed.",
        "// The link `palm` is the ground.",
        "// Not carried over: the part of gravity across the plane x-y, which moves nothing in it.",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}
