//! Files of robots, MJCF and URDF: what they become, compared with what MuJoCo computes of the
//! same files.

use std::fs;
use std::path::Path;

use super::imports::{data, imported, run, table};

/// The declaration of a file, with the accelerations of its joints as outputs.
#[track_caller]
fn with_accelerations(folder: &Path, file: &str) -> String {
    let text = imported(folder, &data(file));
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
fn is_as_in_mujoco(file: &str, reference: &str, inputs: &str, tolerance: f64) {
    let folder = tempfile::tempdir().unwrap();
    let text = with_accelerations(folder.path(), file);
    let (header, expected) = table(&data(reference));
    let name = |column: &String| {
        let endings = ["", "_angle", "_position"].map(|ending| format!("{column}{ending}"));
        let is_output = |name: &String| text.contains(&format!("output {name} ["));
        endings.into_iter().find(is_output).unwrap_or_else(|| column.clone())
    };
    let names: Vec<String> = header.iter().map(name).collect();
    let found = run(folder.path(), &format!("--step 50ms --end 0.5s {inputs}"), &names);
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
            assert!(
                off <= allowed,
                "{file}: {column} is {found} at {} s, MuJoCo has {expected}",
                0.05 * row as f64
            );
        }
    }
}

/// The accelerations at the start agree to rounding: sums of some ten products of numbers up to
/// 50 (2e-13 at most was found). The positions agree as the run's tolerance of 1e-11 and the
/// error of the reference, which is in its file, let them.
#[test]
fn motions_are_those_of_mujoco() {
    is_as_in_mujoco("double_pendulum.xml", "double_pendulum.csv", "--input drive=0.2", 1e-10);
    is_as_in_mujoco("cart_pole.xml", "cart_pole.csv", "--input slide=0.7", 1e-10);
    is_as_in_mujoco(
        "table.xml",
        "table.csv",
        "--input hold=0.1 --input turn_motor=0.5 --input push=0.3",
        1e-10,
    );
    is_as_in_mujoco("arm.urdf", "arm.csv", "", 1e-10);
}

/// Closed loops of `connect`, of bodies and of sites, `weld` and `joint`, which are constraints in
/// the reference too. The crank of the four-bar passes a place where the rocker is fast, which
/// lets the errors of the run and of the reference grow: 5e-9 was found, and 3e-10 of the others.
#[test]
fn closed_loops_move_as_mujocos_matrices_say() {
    is_as_in_mujoco("loops.xml", "loops.csv", "", 1e-9);
    is_as_in_mujoco("four_bar.xml", "four_bar_of_mujoco.csv", "--input torque=0.1", 2e-8);
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
