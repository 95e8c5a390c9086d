//! Files of other programs: what they become, compared with what those programs compute, and
//! what is said of those that cannot be imported.

use std::fs;
use std::path::{Path, PathBuf};

use super::{mbs, text};

pub(super) fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command/imported").join(name)
}

/// The declaration of a file, which is left in the folder as `linkage.mbs`.
#[track_caller]
pub(super) fn imported(folder: &Path, file: &Path) -> String {
    let output = mbs(folder, &format!("import {} --out linkage.mbs", file.display()));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    fs::read_to_string(folder.join("linkage.mbs")).unwrap()
}

/// Rows of numbers by the names of their columns, without units; lines of comments aside.
pub(super) fn table(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines().filter(|line| !line.starts_with('#'));
    let name = |column: &str| column.split(' ').next().unwrap_or_default().to_owned();
    let header = lines.next().unwrap().split(',').map(name).collect();
    (header, lines.map(|line| line.split(',').map(|number| number.parse().unwrap()).collect()).collect())
}

/// The columns of a run of the imported linkage, in the order of `names`.
pub(super) fn run(folder: &Path, options: &str, names: &[String]) -> Vec<Vec<f64>> {
    let output =
        mbs(folder, &format!("simulate linkage.mbs --rtol 1e-11 --atol 1e-12 {options} --out run.csv"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let (header, rows) = table(&folder.join("run.csv"));
    let places: Vec<usize> =
        names.iter().map(|name| header.iter().position(|column| column == name).unwrap()).collect();
    rows.iter().map(|row| places.iter().map(|place| row[*place]).collect()).collect()
}

/// Positions over a revolution are those that pylinkage computes, which solves each joint in
/// closed form. With its motor a linkage has no freedom, and a run to a tolerance is projected
/// onto the constraints: what is left is rounding of lengths of a few metres (7e-15 m at most
/// were found), through a solution that may amplify it some ten times near a dead centre.
#[test]
fn positions_are_those_of_pylinkage() {
    for name in ["four_bar", "slider_crank", "old_four_bar", "old_slider"] {
        let folder = tempfile::tempdir().unwrap();
        imported(folder.path(), &data(&format!("{name}.json")));
        let (header, expected) = table(&data(&format!("{name}.csv")));
        // A step of pylinkage is 10 ms.
        let found = run(folder.path(), "--step 10ms --end 0.63s", &header[1..]);
        assert_eq!(found.len(), 64, "{name}");
        for row in expected {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "steps are counted")]
            let step = row[0] as usize;
            for ((expected, found), column) in row[1..].iter().zip(&found[step]).zip(&header[1..]) {
                let off = (expected - found).abs();
                assert!(off < 1e-12, "{name}, step {step}: {column} = {found}, pylinkage has {expected}");
            }
        }
    }
}

/// A point where two circles meet, on the left of the way from the first to the second.
pub(super) fn left_of(a: [f64; 2], ra: f64, b: [f64; 2], rb: f64) -> [f64; 2] {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let d = dx.hypot(dy);
    let along = (d * d + ra * ra - rb * rb) / (2.0 * d);
    let across = (ra * ra - along * along).sqrt();
    [a[0] + (along * dx - across * dy) / d, a[1] + (along * dy + across * dx) / d]
}

/// Linkage turns an input of positive speed clockwise, by 6 degrees a second for each rpm
/// (`CSimulator::SimulateStep` of its source); the joints follow as intersections of circles.
/// The tolerance is that of the run, in lengths of 100 mm.
#[test]
fn a_file_of_linkage_turns_as_its_program_turns_it() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("crank_rocker.linkage2"));
    assert!(text.contains("param link0_speed = -30 [rpm];"), "{text}");
    assert!(text.contains("body rocker ("), "names are kept:\n{text}");
    let names = ["t", "c1_x", "c1_y", "c2_x", "c2_y", "pen_x", "pen_y"].map(str::to_owned);
    let rows = run(folder.path(), "--step 50ms --end 2s", &names);
    assert_eq!(rows.len(), 41);
    let (coupler, rocker) = (100f64.hypot(25.0), 10f64.hypot(100.0));
    for row in rows {
        let angle = std::f64::consts::FRAC_PI_2 - std::f64::consts::PI * row[0];
        let tip = [35.0 * angle.cos(), 35.0 * angle.sin()];
        let pin = left_of(tip, coupler, [110.0, -40.0], rocker);
        // The pen keeps its place in the frame of the coupler, whose x axis is along (100, 25).
        let [x, y] = [100.0 * 60.0 + 25.0 * 55.0, 100.0 * 55.0 - 25.0 * 60.0].map(|part| part / coupler);
        let [ux, uy] = [(pin[0] - tip[0]) / coupler, (pin[1] - tip[1]) / coupler];
        let pen = [tip[0] + x * ux - y * uy, tip[1] + x * uy + y * ux];
        let expected = [tip, pin, pen].concat();
        for (found, expected) in row[1..].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "at {} s: {found} mm, not {expected} mm", row[0]);
        }
    }
}

/// The crank's pin slides in a lever: it stays on the line from the lever's pivot to its end, while
/// the crank turns clockwise at 15 rpm. The tolerance is that of the run, in mm.
#[test]
fn a_slider_of_linkage_stays_on_the_line_of_its_link() {
    let folder = tempfile::tempdir().unwrap();
    imported(folder.path(), &data("slotted_lever.linkage2"));
    let names = ["t", "c1_x", "c1_y", "c5_x", "c5_y"].map(str::to_owned);
    let rows = run(folder.path(), "--step 50ms --end 4s", &names);
    let (radius, begin) = (1f64.hypot(23.5), 23.5f64.atan2(1.0));
    for row in &rows {
        let angle = begin - 0.5 * std::f64::consts::PI * row[0];
        let pin = [71.0 + radius * angle.cos(), -72.0 + radius * angle.sin()];
        assert!((row[1] - pin[0]).hypot(row[2] - pin[1]) < 1e-6, "{row:?}");
        let (lever, [px, py]) = ([row[3] + 59.0, row[4] + 71.0], [row[1] + 59.0, row[2] + 71.0]);
        let off = (lever[0] * py - lever[1] * px) / lever[0].hypot(lever[1]);
        assert!(off.abs() < 1e-6, "{off} mm from the line at {} s", row[0]);
    }
}

/// pylinkage's arc driver keeps between its ends; here it swings between them.
#[test]
fn an_arc_driver_swings_between_its_ends() {
    let folder = tempfile::tempdir().unwrap();
    let mut file: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(data("four_bar.json")).unwrap()).unwrap();
    let crank = &mut file["links"][1];
    (crank["type"], crank["arc_start"], crank["arc_end"]) = ("arc_driver".into(), 0.5.into(), 1.5.into());
    fs::write(folder.path().join("arc.json"), file.to_string()).unwrap();
    let text = imported(folder.path(), &folder.path().join("arc.json"));
    assert!(text.contains("turns back at once in pylinkage; here it swings as a sine does"), "{text}");
    let rows = run(folder.path(), "--step 5ms --end 1s", &["angle_crank".to_owned()]);
    let ends = rows.iter().fold((f64::MAX, f64::MIN), |(low, high), row| (low.min(row[0]), high.max(row[0])));
    assert!((rows[0][0] - 0.927_295_218_001_612_2).abs() < 1e-9, "it begins as it is drawn");
    // A period is 0.31 s, so that a sample is within 2.5 ms of an end: 0.5·(1 − cos(20·0.0025)) = 6e-4.
    assert!((ends.0 - 0.5).abs() < 1e-3 && (ends.1 - 1.5).abs() < 1e-3, "{ends:?}");
}

/// An expression has no motor: it begins as it is drawn, and its bars stay as long as they
/// are. 1e-6 mm is the tolerance of the run.
#[test]
fn expressions_begin_as_they_are_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let names = |of: &[&str]| of.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    imported(folder.path(), &data("crank_rocker.pyslvs"));
    let rows = run(folder.path(), "--end 0.1s", &names(&["P1_x", "P1_y", "P2_x", "P2_y", "P3_x", "P3_y"]));
    let close = |a: f64, b: f64| (a - b).abs() < 1e-6;
    for (found, drawn) in rows[0].iter().zip([12.92, 32.53, 73.28, 67.97, 33.3, 66.95]) {
        assert!(close(*found, drawn), "{found} {drawn}");
    }
    let last = rows.last().unwrap();
    assert!(!close(last[0], 12.92), "it moves");
    assert!(close(last[0].hypot(last[1]), 12.92f64.hypot(32.53)));
    assert!(close((last[4] - last[0]).hypot(last[5] - last[1]), (33.3f64 - 12.92).hypot(66.95 - 32.53)));

    imported(folder.path(), &data("slide.pyslvs"));
    let rows = run(folder.path(), "--end 0.1s", &names(&["P2_x", "P2_y"]));
    assert!(rows.iter().all(|row| close(row[1], 1.0)), "it slides along its line");

    // A block on a line of 30 degrees does not turn.
    imported(folder.path(), &data("block.pyslvs"));
    let rows = run(folder.path(), "--end 0.1s", &names(&["P2_x", "P2_y", "P3_x", "P3_y"]));
    let slope = 30f64.to_radians().tan();
    for row in &rows {
        assert!(close(row[3] - 2.0, slope * (row[2] - 22.0)), "{row:?}");
        assert!(close(row[2] - row[0], 2.0) && close(row[3] - row[1], 1.0), "{row:?}");
    }
    assert!(!close(rows.last().unwrap()[0], 20.0), "it moves");
}

/// A second coupler beside the first one repeats its constraint.
#[test]
fn repeated_constraints_are_counted_and_declared() {
    let folder = tempfile::tempdir().unwrap();
    let expression = "M[J[R, P[0, 0], L[ground, a]], J[R, P[10, 0], L[ground, b]], J[R, P[20, 0], L[ground, c]], \
                      J[R, P[0, 5], L[a, bar]], J[R, P[10, 5], L[b, bar]], J[R, P[20, 5], L[c, bar]]]";
    fs::write(folder.path().join("beam.txt"), expression).unwrap();
    let text = imported(folder.path(), &folder.path().join("beam.txt"));
    assert!(text.contains("dof = 1;") && text.contains("redundant = minimum_norm;"), "{text}");
    assert!(text.contains("1 of its constraints repeat others"), "{text}");
    run(folder.path(), "--end 0.1s", &["P3_x".to_owned()]);
}

#[test]
fn what_is_assumed_is_said() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("four_bar.json"));
    for part in [
        "// The linkage `Four-bar` from the file `four_bar.json` of pylinkage. Lengths are in m.",
        "// The file has no masses",
        "/// Mass of the links per length; assumed.",
        "/// Time of a step of pylinkage; assumed.",
        "\nFourBar {\n",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    let output = mbs(folder.path(), &format!("import {} --unit cm", data("four_bar.json").display()));
    let shown = self::text(output.stdout);
    assert!(shown.contains("Lengths are in cm.") && shown.contains("param crank_length = 1 [cm]"), "{shown}");
}

/// A name of the file is data: it cannot add a statement to the declaration.
#[test]
fn names_stay_in_their_comments() {
    let folder = tempfile::tempdir().unwrap();
    let four_bar = fs::read_to_string(data("four_bar.json")).unwrap();
    let wicked = four_bar.replace("\"Four-bar\"", "\"x\\n} dof = 7; //\"").replace("\"rocker\"", "\"fn\"");
    fs::write(folder.path().join("wicked.json"), wicked).unwrap();
    let text = imported(folder.path(), &folder.path().join("wicked.json"));
    assert!(text.starts_with("// The linkage `x\\n} dof = 7; //` from"), "{text}");
    assert!(text.contains("body fn_2 (") && !text.contains("\n} dof = 7"), "{text}");
}

#[track_caller]
pub(super) fn refused(name: &str, content: &str, options: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), content).unwrap();
    let output = mbs(folder.path(), &format!("import {name} --out linkage.mbs {options}"));
    assert!(!output.status.success(), "{content} went through");
    assert!(!folder.path().join("linkage.mbs").exists(), "nothing is written");
    let message = String::from_utf8(output.stderr).unwrap();
    let start = format!("error: cannot import {name}: ");
    message.trim_end().strip_prefix(&start).unwrap_or_else(|| panic!("{message}")).to_owned()
}

fn joints(joints: &str, links: &str) -> String {
    format!("{{\"joints\": [{joints}], \"links\": [{links}]}}")
}

const O: &str = r#"{"id": "O", "type": "ground", "position": [0, 0]}"#;
const A: &str = r#"{"id": "A", "position": [1, 0]}"#;
const CRANK: &str =
    r#"{"id": "crank", "type": "driver", "joints": ["O", "A"], "motor_joint": "O", "angular_velocity": 0.1}"#;

#[test]
fn refusals_of_pylinkage_name_the_part() {
    let says = |content: &str, message: &str| assert_eq!(refused("f.json", content, ""), message);
    says("{\"joints\": [", "it is no complete JSON: EOF while parsing a list at line 1 column 12");
    says("{}", "the file has no list `joints`");
    says(
        "{\"nodes\": []}",
        "it has the topology of a linkage alone, without lengths; write it with `mechanism_to_json`",
    );
    says(&joints(r#"{"type": "ground"}"#, ""), "a joint has no text `id`");
    says(
        &joints(r#"{"id": "A", "position": [null, 1]}"#, ""),
        "the joint `A` has no pair of numbers `position`",
    );
    says(
        &joints(r#"{"id": "A", "position": [1e12, 1]}"#, ""),
        "the joint `A` has no place within 1e9 m of the origin",
    );
    says(&joints(&format!("{O}, {O}"), ""), "the joint `O` is there twice");
    says(
        &joints(r#"{"id": "A", "type": "ball", "position": [0, 0]}"#, ""),
        "the joint `A` is of the type `ball`, which is not known",
    );
    says(
        &joints(O, r#"{"id": "bar", "joints": ["O", "B"]}"#),
        "the link `bar` refers to the joint `B`, which the file does not have",
    );
    says(&joints(O, ""), "nothing in it moves: no link has two joints");
    says(
        &joints(O, r#"{"id": "bar", "type": "rope", "joints": []}"#),
        "the link `bar` is of the type `rope`, which is not known",
    );
    says(
        &joints(&format!("{O}, {A}"), &CRANK.replace("\"O\", \"A\"", "\"O\"")),
        "the link `crank` is driven and has not exactly one joint beside its motor's",
    );
    says(
        &joints(&format!("{O}, {A}"), &CRANK.replace("0.1", "\"fast\"")),
        "the link `crank`: `angular_velocity` = `\\\"fast\\\"` is no number below 1e9",
    );
    says(
        &joints(&format!("{O}, {}", A.replace("[1, 0]", "[0, 0]")), CRANK),
        "the link `crank` has the joint `O` and the joint `A` at one place",
    );
    says(
        r#"{"joints": [{"type": "Crank", "name": "c", "distance": 1, "angle": 0.1}]}"#,
        "the joint `c` does not say its `joint0`",
    );
    let far = fs::read_to_string(data("old_four_bar.json"))
        .unwrap()
        .replace("\"distance0\": 3", "\"distance0\": 30");
    says(
        &far,
        "the joint `pin` is out of reach: its `distance0` and `distance1` are too short or too different",
    );
}

#[test]
fn refusals_of_linkage_name_the_part() {
    let file = fs::read_to_string(data("crank_rocker.linkage2")).unwrap();
    let says = |from: &str, to: &str, message: &str| {
        assert!(file.contains(from));
        assert_eq!(refused("f.linkage2", &file.replacen(from, to, 1), ""), message);
    };
    says("y=\"35\"", "y=\"high\"", "the connector `1`: `y` = `high` is no number");
    says(" y=\"35\"", "", "the connector `1` has no `y`");
    says(
        "<connector id=\"4\"/>",
        "<connector id=\"9\"/>",
        "the link `1` refers to the connector `9`, which the file does not have",
    );
    says(
        "<Link id=\"2\"",
        "<Link id=\"2\" actuator=\"true\"",
        "the link `2` is an actuator, which is not imported",
    );
    says("<Link id=\"2\"", "<Link id=\"2\" gear=\"true\"", "the link `2` is a gear, which is not imported");
    says(
        "<Link id=\"2\"",
        "<Link id=\"2\" fastenlink=\"1\"",
        "the link `2` is fastened to another part, which is not imported",
    );
    says(
        "anchor=\"true\" input",
        "input",
        "the connector `0` is an input that is no anchor; only motors on the ground are imported",
    );
    let slot = |radius: &str, limits: [usize; 2]| {
        let [a, b] = limits.map(|id| format!("<slidelimit id=\"{id}\"/>"));
        format!(
            "<connector draw=\"true\" slider=\"true\" slideradius=\"{radius}\" x=\"60\" y=\"90\" id=\"4\">{a}{b}</connector>"
        )
    };
    let pen = "<connector draw=\"true\" name=\"pen\" x=\"60\" y=\"90\" id=\"4\"/>";
    says(
        pen,
        &slot("12", [0, 3]),
        "the connector `4` slides along an arc (`slideradius`), which is not imported",
    );
    says(pen, &slot("0", [1, 3]), "the connector `4` slides between two connectors that no link has both of");
    let ratios = "<ratios><ratio type=\"gears\"/></ratios></linkage2>";
    says("</linkage2>", ratios, "it has gears or chains, which are not imported");
    let cut = &file[..file.len() / 2];
    assert!(refused("f.linkage2", cut, "").starts_with("it is no complete XML: "));
    assert_eq!(refused("f.xml", "<a/>", "--format linkage2"), "its root is not `linkage2`");
}

#[test]
fn refusals_of_expressions_say_the_line() {
    let says = |content: &str, message: &str| assert_eq!(refused("f.txt", content, ""), message);
    says("M[\nJ[R, P[0, x], L[ground, a]]]", "line 2: `x], L[ground` stands where a number should be");
    says("M[J[R, P[0, 0], L[ground, a]]", "line 1: the text ends where `,` or `]` should be");
    says("M[J[S, P[0, 0], L[ground]]]", "a joint is of the kind `S`, not R, P or RP");
    says("M[J[R, L[ground]]]", "line 1: `]` stands where a joint with a place `P[x, y]` before it should be");
    says("M[J[RP, P[0, 0], L[]]]", "the joint P0 slides and is on no link");
    says("M[] M", "line 1: `M` stands where the end should be");
    says("M[]", "nothing in it moves: no link has two joints");
    says(
        "hello",
        "it begins like none of the files that are known (pylinkage, linkage2, pyslvs, pmks, \
         pmks-plus, mjcf, urdf, sdf); \
         --format says which one it is",
    );
}

#[test]
fn a_file_that_is_too_large_is_refused() {
    assert_eq!(refused("f.json", &" ".repeat((1 << 22) + 1), ""), "it has more than 4194304 bytes");
    let many: Vec<String> = (0..300).map(|at| format!("J[R, P[{at}, 0], L[a{at}, b{at}]]")).collect();
    let message = refused("f.txt", &format!("M[{}]", many.join(",")), "");
    assert_eq!(message, "it has 600 links and 300 joints; at most 200 and 1000 are imported");
}

/// The answer of the compiler is given in the words of the file.
#[test]
fn the_compilers_answer_names_the_part_of_the_file() {
    // The rod of 3 m cannot reach the line 50 m above the crank.
    let file = fs::read_to_string(data("slider_crank.json")).unwrap();
    let mut far: serde_json::Value = serde_json::from_str(&file).unwrap();
    far["joints"][2]["line_point"][1] = 50.into();
    let far = far.to_string();
    let message = refused("f.json", &far, "");
    let start = "what it describes is refused: the joint `S`: the mechanism does not close";
    assert!(message.starts_with(start), "{message}");
}

/// A five-bar in one line was "3 degrees of freedom, 1 constraint too many": its constraints repeat each
/// other where it is drawn, and nowhere else.
#[test]
fn a_linkage_that_is_drawn_in_one_line_is_named_as_singular() {
    let joint = |x: f64, links: &str| format!("J[R, P[{x}, 0], L[{links}]]");
    let five_bar = |ends: [f64; 5]| {
        let links = ["ground, a", "a, b", "b, c", "c, d", "d, ground"];
        let joints: Vec<String> = ends.into_iter().zip(links).map(|(x, links)| joint(x, links)).collect();
        refused("f.pyslvs", &format!("M[{}]", joints.join(", ")), "")
    };
    let message = "it is drawn in a singular position, as with links in one line: 3 degrees of freedom there and 2 \
                   everywhere else; draw it a little away from there";
    assert_eq!(five_bar([0.0, 1.0, 2.0, 3.0, 4.0]), message);
    assert_eq!(five_bar([0.0, 2.0, 1.0, 3.0, 4.0]), message);
}
