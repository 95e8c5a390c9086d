//! Files of PMKS and of PMKS+: the motion of what they become, compared with positions and torques
//! that were published of those programs, and with closed forms.

use std::f64::consts::{FRAC_PI_6, PI};
use std::fs;
use std::path::Path;

use super::imports::{data, imported, left_of, run, table};
use super::mbs;

/// Positions of PMKS in steps of 1° of its input, as `PMKS_Verification` publishes them; those before
/// the drawn position are where the reversed motor leads. PMKS solves each joint in closed form; the run
/// is projected onto the constraints to rounding. Lengths are some tens at most, and the six-bars come
/// within 1° and 2° of dead centres, where PMKS_Verification computes condition numbers to 86: rounding of
/// 1e-14 becomes 1e-12, and 6e-13 at most were found.
#[test]
fn positions_are_those_of_pmks() {
    for name in ["pmks_four_bar", "pmks_slider_crank", "pmks_watt", "pmks_stephenson"] {
        let (header, expected) = table(&data(&format!("{name}.csv")));
        let file = fs::read_to_string(data(&format!("{name}.txt"))).unwrap();
        let (setting, _) = file.split_once('|').unwrap();
        let rpm: f64 = setting.trim_start_matches("set=s").parse().unwrap();
        for sign in [1.0, -1.0] {
            let rows: Vec<&Vec<f64>> = expected.iter().filter(|row| sign * row[0] >= 0.0).collect();
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("file.txt");
            fs::write(&path, file.replacen(setting, &format!("set=s{}", sign * rpm), 1)).unwrap();
            imported(folder.path(), &path);
            let end = rows.iter().map(|row| row[0].abs()).fold(0.0, f64::max);
            if end == 0.0 {
                continue;
            }
            // A step is 1° of the input.
            let step = 1.0 / (6.0 * rpm);
            let found = run(folder.path(), &format!("--step {step}s --end {end}s"), &header[1..]);
            assert!(rows.len() >= 6, "{name}");
            for row in rows {
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "steps are counted"
                )]
                let at = (row[0].abs() / step).round() as usize;
                for ((expected, found), column) in row[1..].iter().zip(&found[at]).zip(&header[1..]) {
                    let off = (expected - found).abs();
                    assert!(off < 1e-11, "{name} at {} s: {column} = {found}, PMKS has {expected}", row[0]);
                }
            }
        }
    }
}

/// The columns of a run over some time in steps of 50 ms.
fn motion(file: &Path, end: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let folder = tempfile::tempdir().unwrap();
    imported(folder.path(), file);
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    run(folder.path(), &format!("--step 50ms --end {end}"), &names)
}

fn motion_of(text: &str, end: &str, names: &[&str]) -> Vec<Vec<f64>> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file.txt"), text).unwrap();
    motion(&folder.path().join("file.txt"), end, names)
}

/// A place is as it should be, to the rounding of lengths of some hundreds.
#[track_caller]
fn is_at(found: &[f64], [x, y]: [f64; 2], time: f64) {
    let off = (found[0] - x).hypot(found[1] - y);
    assert!(off < 1e-9, "at {time} s: {found:?}, not ({x}, {y})");
}

/// The quick return of the examples of PMKS: the lever turns about (5, 0), the pin of the crank of
/// length 2 slides in it, and the point on the lever is 9 from its pivot. PMKS turns its input with
/// 10 rpm, counter-clockwise.
#[test]
fn a_slot_of_pmks_is_a_line_of_its_first_link() {
    let rows = motion(&data("pmks_quick_return.txt"), "6s", &["t", "P1_x", "P1_y", "P3_x", "P3_y"]);
    assert_eq!(rows.len(), 121);
    for row in rows {
        let angle = row[0] * PI / 3.0;
        let pin = [2.0 * angle.cos(), 2.0 * angle.sin()];
        let (dx, dy) = (pin[0] - 5.0, pin[1]);
        is_at(&row[1..3], pin, row[0]);
        is_at(&row[3..], [5.0 + 9.0 * dx / dx.hypot(dy), 9.0 * dy / dx.hypot(dy)], row[0]);
    }
}

/// A four-bar as JSON, whose speed is in rad/s as the library of PMKS has it.
#[test]
fn a_json_of_pmks_turns_with_its_speed() {
    let rows = motion(&data("pmks_four_bar.pmks"), "0.6s", &["t", "P1_x", "P1_y", "P2_x", "P2_y"]);
    for row in rows {
        let angle = 10.0 * row[0];
        let tip = [100.0 + 250.0 * angle.cos(), 100.0 + 250.0 * angle.sin()];
        is_at(&row[1..3], tip, row[0]);
        is_at(&row[3..], left_of(tip, 50f64.hypot(380.0), [600.0, 100.0], 200f64.hypot(380.0)), row[0]);
    }
}

/// Other inputs of PMKS: a slide that is driven along its line with 10 lengths per second, and a motor
/// between two links that both move, which prescribes the angle of one against the other.
#[test]
fn inputs_of_pmks_may_slide_or_be_between_links() {
    let sliding = "n6, ground,P,120,330\nground, n2,R,0,350\nn2, n4,R,0,450\nn4, n6,R,120,370\n";
    let rows = motion_of(sliding, "1s", &["t", "P2_x", "P2_y", "P3_x", "P3_y"]);
    for row in rows {
        let end = [120.0 + 10.0 * row[0], 370.0];
        is_at(&row[3..], end, row[0]);
        is_at(&row[1..3], left_of([0.0, 350.0], 100.0, end, 120f64.hypot(80.0)), row[0]);
    }

    let between = "ground,a,R,0,0,0,tfff\na,b,R,0,100,0,ffft\nb,c,R,150,150\nc,ground,R,200,0";
    let rows = motion_of(between, "1s", &["t", "P1_x", "P1_y", "P2_x", "P2_y"]);
    let b = 150f64.hypot(50.0);
    for row in rows {
        // The angle between the two links at their pin opens by 60° per second.
        let begin = 50f64.atan2(150.0) + 0.5 * PI;
        let angle = begin + row[0] * PI / 3.0;
        let diagonal = (100f64.powi(2) + b * b - 200.0 * b * angle.cos()).sqrt();
        let end = left_of([0.0; 2], diagonal, [200.0, 0.0], 50f64.hypot(150.0));
        is_at(&row[3..], end, row[0]);
        let hinge =
            if angle < PI { left_of([0.0; 2], 100.0, end, b) } else { left_of(end, b, [0.0; 2], 100.0) };
        is_at(&row[1..3], hinge, row[0]);
    }
}

/// A web address has the joints behind `mech=`, between bars, with codes for letters; and the examples
/// of PMKS name the ground in several ways, mark the input by words, and draw points twice.
#[test]
fn addresses_and_older_texts_of_pmks_are_read() {
    let address = "http://people.oregonstate.edu/~campmatt/pmks/pmks.html?set=s-20&mech=\
                   gnd%20r%20R%200%200%200%20ffft%7Cr%20bar%20R%202%200%200%20tfff|bar lever R 2.73 6.189|\
                   lever 0 R 6 0 True False False False|bar R 5 5|bar R 5 5|";
    let rows = motion_of(address, "1s", &["t", "P1_x", "P1_y", "P2_x", "P2_y"]);
    let (bar, lever) = (0.73f64.hypot(6.189), 3.27f64.hypot(6.189));
    for row in rows {
        let angle = -4.0 * FRAC_PI_6 * row[0];
        let tip = [2.0 * angle.cos(), 2.0 * angle.sin()];
        is_at(&row[1..3], tip, row[0]);
        is_at(&row[3..], left_of(tip, bar, [6.0, 0.0], lever), row[0]);
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file.txt"), address).unwrap();
    let text = imported(folder.path(), &folder.path().join("file.txt"));
    assert!(text.contains("the joint P5 is at the place of the joint P4: both are one point"), "{text}");
    let plain = "ground, a,R,0,0\na bar,R,1,0\nbar c,R,3,4\nc ground,R,5,0\n";
    fs::write(folder.path().join("file.txt"), plain).unwrap();
    let text = imported(folder.path(), &folder.path().join("file.txt"));
    for part in [
        "The file marks no input: the joint P0 is driven, as PMKS does",
        "The file says no speed: the joint P0 moves with 10 rpm, as PMKS has it",
        "Lengths of PMKS have no unit; they count as mm",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
}

/// The mechanism that the page of PMKS+ shows for its verification, as an address. Its motor turns
/// clockwise with 20 rpm, so that it passes the positions of PMKS before the drawn one at half of their
/// times. The tolerance is that of `positions_are_those_of_pmks`.
#[test]
fn an_address_of_pmks_plus_moves_as_pmks_computes() {
    let (header, expected) = table(&data("pmks_watt.csv"));
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("pmks_plus_readme.url"));
    assert!(text.contains("Lengths are in cm.") && text.contains("param AB_mass = 0.001 [kg]"), "{text}");
    assert!(text.contains("param AB_speed = -20 [rpm];"), "{text}");
    let letters = ["A", "B", "C", "D", "E", "F"];
    let names: Vec<String> = header[1..]
        .iter()
        .map(|name| letters[name[1..2].parse::<usize>().unwrap()].to_owned() + &name[2..])
        .collect();
    let step = 1.0 / 120.0;
    let found = run(folder.path(), &format!("--step {step}s --end {}s", 5.0 * step), &names);
    let before: Vec<_> = expected.iter().filter(|row| row[0] <= 0.0).collect();
    assert_eq!(before.len(), 6);
    for (row, found) in before.iter().rev().zip(found) {
        for ((expected, found), name) in row[1..].iter().zip(found).zip(&names) {
            assert!((expected - found).abs() < 1e-11, "{name} = {found}, PMKS has {expected}");
        }
    }
}

/// The check of an address is that of its text, in which a space is a space and no `%20`.
#[test]
fn an_address_of_pmks_plus_may_have_names_of_words() {
    let file = fs::read_to_string(data("pmks_plus_slider.pmks")).unwrap();
    // Eight letters more are eight digits more in the check, which was `e`.
    let named = file.replacen("YRAB,AB,", "YRAB,Crank of B,", 1).replace("JAe", "JAm");
    let folder = tempfile::tempdir().unwrap();
    let address = format!("https://app.pmksplus.com/?{}\n", named.replace(' ', "%20"));
    fs::write(folder.path().join("file.url"), address).unwrap();
    let text = imported(folder.path(), &folder.path().join("file.url"));
    assert!(text.contains("body Crank_of_B ("), "{text}");
}

/// The torque that a motor needs against masses, weights and a load, as the routines for MATLAB of
/// PMKS_Verification compute it by Newton's and Euler's equations (case `watt_i`, `newton_gravity`), at
/// 0° to 4° of the crank. The file has one of the load's digits rounded (55.902 N for √3125 N) and one
/// of a centre of mass (1.783 m for 1.78333 m), 5e-6 of the load and 2e-5 of the weights' torque.
#[test]
fn torques_are_those_of_newton_and_euler() {
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &data("pmks_plus_watt.pmks"));
    let body = text.trim_end().strip_suffix('}').unwrap();
    let text = format!("{body}    output torque [N*m] = effort(AB_motor);\n}}\n");
    fs::write(folder.path().join("linkage.mbs"), text).unwrap();
    let step = 1.0 / 60.0;
    let names = ["torque".to_owned()];
    let rows = run(folder.path(), &format!("--step {step}s --end {}s", 4.0 * step), &names);
    let expected = [
        1_844.317_474_993_1,
        3_483.304_148_264_8,
        6_371.762_446_230_6,
        13_428.684_543_542_464,
        41_870.483_757_103_4,
    ];
    for (row, expected) in rows.iter().zip(expected) {
        assert!((row[0] / expected - 1.0).abs() < 3e-5, "{row:?}, not {expected} N·m");
    }
}

/// The slider-crank among the templates of PMKS+: a crank from A to B, a rod to C, whose block slides
/// along the line y = 1.151.
#[test]
fn a_slider_of_pmks_plus_stays_on_its_line() {
    let file = data("pmks_plus_slider.pmks");
    let rows = motion(&file, "3s", &["t", "B_x", "B_y", "C_x", "C_y"]);
    let (a, b, c): ([f64; 2], [f64; 2], [f64; 2]) = ([-3.082, -0.038], [-2.231, 2.388], [2.863, 1.151]);
    let (crank, rod) = ((b[0] - a[0]).hypot(b[1] - a[1]), (c[0] - b[0]).hypot(c[1] - b[1]));
    for row in rows {
        let angle = (b[1] - a[1]).atan2(b[0] - a[0]) - row[0] * 20.0 * PI / 30.0;
        let pin = [a[0] + crank * angle.cos(), a[1] + crank * angle.sin()];
        is_at(&row[1..3], pin, row[0]);
        let slide = pin[0] + (rod * rod - (c[1] - pin[1]).powi(2)).sqrt();
        is_at(&row[3..], [slide, c[1]], row[0]);
    }
    let folder = tempfile::tempdir().unwrap();
    let text = imported(folder.path(), &file);
    assert!(
        text.contains("param CD_mass = 0.001 [kg]") && text.contains("prismatic C_slot (CD.C,"),
        "{text}"
    );
}

/// The Whitworth quick return among the templates of 2026: the pin B of the crank slides on the line
/// through the joints C and D of a lever that turns about C.
#[test]
fn a_slot_of_pmks_plus_moves_with_its_link() {
    let rows = motion(&data("pmks_plus_whitworth.pmks"), "6s", &["t", "B_x", "B_y", "D_x", "D_y"]);
    let length = (1.0f64 + 0.581).hypot(4.743);
    for row in &rows {
        let angle = 0.5 * PI - row[0] * PI / 3.0;
        let pin = [3.0 * angle.cos(), 3.0 * angle.sin()];
        is_at(&row[1..3], pin, row[0]);
        let lever = (pin[1]).atan2(pin[0] - 1.0);
        is_at(&row[3..], [1.0 + length * lever.cos(), length * lever.sin()], row[0]);
    }
}

/// A unit that the file says cannot be another one.
#[test]
fn the_unit_of_pmks_plus_is_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let file = data("pmks_plus_slider.pmks");
    let output = mbs(folder.path(), &format!("import {} --unit mm", file.display()));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("its lengths are in cm; --unit is for files that leave their unit open"),
        "{message}"
    );
    assert!(mbs(folder.path(), &format!("import {} --unit cm", file.display())).status.success());
}
