//! Drawings for CAD programs, and pictures that move.

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

/// The values of an attribute, wherever it stands.
fn attributes<'a>(picture: &'a str, name: &str) -> Vec<&'a str> {
    let start = format!(" {name}=\"");
    let parts = picture.split(start.as_str()).skip(1);
    parts.map(|part| part.split('"').next().unwrap()).collect()
}

/// The crank of the four-bar turns once in a second. Its ends are kept to the tenth of a pixel,
/// of a bar that is more than 50 pixels long.
#[test]
fn a_motion_is_a_picture_that_moves_by_itself() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "export svg four-bar --set omega=60rpm --end 1s --out run.svg");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let picture = fs::read_to_string(folder.path().join("run.svg")).unwrap();
    assert!(!picture.contains("script") && picture.contains("<title>four-bar</title>"));
    assert!(attributes(&picture, "dur").iter().all(|seconds| *seconds == "1s"));
    assert!(attributes(&picture, "repeatCount").iter().all(|count| *count == "indefinite"));
    let times: Vec<f64> =
        attributes(&picture, "keyTimes")[0].split(';').map(|time| time.parse().unwrap()).collect();
    assert!(times[0].abs() < 1e-12 && (times[times.len() - 1] - 1.0).abs() < 1e-12, "as SVG asks");
    assert!(times.is_sorted());
    let values = attributes(&picture, "values");
    assert!(values.len() >= 5, "three bodies and two pins move");
    assert!(values.iter().all(|values| values.split(';').count() == times.len()));
    // The first bar is the crank.
    let crank = picture.lines().find(|line| line.contains("stroke-opacity=\"0.8\"")).unwrap();
    let numbers = |frame: &str| frame.split([' ', ',']).map(|number| number.parse().unwrap()).collect();
    let frames: Vec<Vec<f64>> = attributes(crank, "values")[0].split(';').map(numbers).collect();
    let length = |frame: &[f64]| (frame[2] - frame[0]).hypot(frame[3] - frame[1]);
    assert!(length(&frames[0]) > 50.0);
    // Half a tenth of a pixel for each of four coordinates, twice.
    assert!(frames.iter().all(|frame| (length(frame) - length(&frames[0])).abs() < 0.3));
    // y goes down in a picture
    let angle = |frame: &[f64]| (frame[1] - frame[3]).atan2(frame[2] - frame[0]);
    let close = |a: f64, b: f64| (a - b).abs() < 0.3 / 50.0;
    assert!(close(angle(&frames[0]), angle(&frames[frames.len() - 1])), "a whole turn");
    let quarter = times.iter().position(|time| *time >= 0.25).unwrap();
    let turned = angle(&frames[quarter]) - angle(&frames[0]);
    assert!(close(turned, std::f64::consts::TAU * times[quarter]), "counter-clockwise by {turned}");
    refuses(
        "export svg four-bar --out a.gif",
        &["`a.gif` cannot be used: a picture of `mbs export svg` ends in .svg"],
    );
}

/// Where the pixels of a colour lie on the average, with y upwards; frame by frame.
fn middles(file: &[u8], colour: [u8; 3]) -> Vec<[f64; 2]> {
    let mut decoder = gif::DecodeOptions::new().read_info(file).unwrap();
    assert_eq!(decoder.repeat(), gif::Repeat::Infinite);
    let palette = decoder.global_palette().unwrap().as_chunks().0.to_vec();
    let width = usize::from(decoder.width());
    let mut shown = vec![0; width * usize::from(decoder.height())];
    let mut middles = Vec::new();
    while let Some(frame) = decoder.read_next_frame().unwrap() {
        assert_eq!(frame.delay, 2, "hundredths of a second");
        let wide = usize::from(frame.width);
        for (row, pixels) in frame.buffer.chunks_exact(wide).enumerate() {
            let start = (usize::from(frame.top) + row) * width + usize::from(frame.left);
            shown[start..start + wide].copy_from_slice(pixels);
        }
        let of_colour = (0..shown.len()).filter(|at| palette[usize::from(shown[*at])] == colour);
        let places: Vec<_> = of_colour.map(|at| [(at % width) as f64, -((at / width) as f64)]).collect();
        let mean = |axis: usize| places.iter().map(|place| place[axis]).sum::<f64>() / places.len() as f64;
        middles.push([0, 1].map(mean));
    }
    middles
}

/// The crank of the four-bar turns once in a second, in fifty frames.
#[test]
fn a_motion_is_a_gif() {
    const CRANK: [u8; 3] = [0, 114, 178];
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "export gif four-bar --set omega=60rpm --end 1s --out run.gif");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let middles = middles(&fs::read(folder.path().join("run.gif")).unwrap(), CRANK);
    assert_eq!(middles.len(), 50, "the end is the start of the next turn");
    let mean = |axis: usize| middles.iter().map(|middle| middle[axis]).sum::<f64>() / 50.0;
    let pivot = [0, 1].map(mean);
    let angle = |[x, y]: [f64; 2]| (y - pivot[1]).atan2(x - pivot[0]);
    let whole = std::f64::consts::TAU;
    for (frame, pair) in middles.windows(2).enumerate() {
        let turned = (angle(pair[1]) - angle(pair[0])).rem_euclid(whole);
        // a middle of hundreds of pixels, half a crank of tens of pixels from the pivot; pins and
        // other bodies that cover a part of the crank move it by about a pixel
        assert!((turned - whole / 50.0).abs() < 0.08, "frame {frame} turned by {turned}");
    }
    refuses(
        "export gif four-bar --out a.svg",
        &["`a.svg` cannot be used: a picture of `mbs export gif` ends in .gif"],
    );
}
