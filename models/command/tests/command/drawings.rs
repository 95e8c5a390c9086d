//! Drawings for CAD programs.

use std::fs;

use super::{mbs, refusal, refuses};

/// The values of a code in the entities of a kind and layer, in order.
fn values(drawing: &str, kind: &str, layer: &str, code: &str) -> Vec<f64> {
    let lines: Vec<&str> = drawing.lines().collect();
    let groups: Vec<(&str, &str)> = lines.chunks(2).map(|group| (group[0], group[1])).collect();
    // A piece follows its kind; the first piece is what stands before all kinds.
    let kinds = groups.iter().filter(|(code, _)| *code == "0").map(|(_, kind)| *kind);
    let pieces = groups.split(|(code, _)| *code == "0").skip(1);
    kinds
        .zip(pieces)
        .filter(|(of, piece)| *of == kind && piece.contains(&("8", layer)))
        .flat_map(|(_, piece)| {
            piece.iter().filter(|(of, _)| *of == code).map(|(_, value)| value.parse().unwrap())
        })
        .collect()
}

/// The four-bar of the library begins with its crank of 30 mm along x, its pivots 100 mm apart.
/// Its bars are 80 mm and 70 mm long. A run starts assembled to rounding, 1e-9 mm here.
#[test]
fn bodies_are_polylines_and_joints_circles_in_millimetres() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "export dxf four-bar-free --out start.dxf");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let drawing = fs::read_to_string(folder.path().join("start.dxf")).unwrap();
    assert!(drawing.ends_with("0\nENDSEC\n0\nEOF\n") && drawing.contains("AC1009"));
    let length = |layer: &str| {
        let [x, y] = ["10", "20"].map(|code| values(&drawing, "VERTEX", layer, code));
        assert_eq!(x.len(), 2, "{layer}");
        (x[1] - x[0]).hypot(y[1] - y[0])
    };
    for (layer, expected) in [("crank", 30.0), ("coupler", 80.0), ("rocker", 70.0)] {
        assert!((length(layer) - expected).abs() < 1e-9, "{layer}: {}", length(layer));
    }
    let mut joints = values(&drawing, "CIRCLE", "joints", "10");
    joints.sort_by(f64::total_cmp);
    assert_eq!(joints.len(), 4);
    assert!(joints[0].abs() < 1e-9 && joints.iter().any(|x| (x - 100.0).abs() < 1e-9));
}

/// A crank of 200 rpm is a quarter of a turn on after 75 ms; the feedback of a run with a
/// constant step leaves some 1e-8 of lengths of 60 mm.
#[test]
fn a_time_gives_the_pose_of_then() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "export dxf slider-crank --set omega=200rpm --at 75ms --out then.dxf");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let drawing = fs::read_to_string(folder.path().join("then.dxf")).unwrap();
    let [x, y] = ["10", "20"].map(|code| values(&drawing, "VERTEX", "crank", code));
    assert!(x.iter().all(|x| x.abs() < 1e-4), "{x:?}");
    assert!(y.iter().any(|y| (y - 60.0).abs() < 1e-4), "{y:?}");
}

#[test]
fn drawings_that_cannot_be_made() {
    refuses("export dxf four-bar --out a.svg", &["`a.svg` cannot be used: a drawing ends in .dxf"]);
    refuses("export dxf four-bar --out a.dxf --at soon", &["soon"]);
    assert!(refusal("export dxf nothing --out a.dxf").contains("there is no mechanism `nothing`"));
}
