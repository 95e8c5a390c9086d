//! Laws of pieces at the command line.

use super::{mbs, text};

/// A sled that a motor pushes for a while over ground with dry friction, towards a stop.
const SLED: &str = "Sled {
    dof = 1;
    param stop = 3 [m];
    body sled (x) { mass = 1 [kg]; }
    force motor on x = if t < 0.5 [s] { 6 [N] } else { 0 };
    force ground on x = -2 [N]*sign(der(x));
    force bumper on x = if x > stop { -1 [kN/m]*(x - stop) } else { 0 };
    start { der(x) = 1 [m/s]; }
}";

/// 4 m/s² for half a second, then −2 m/s²: the sled rests after 2 s, at 3.25 m but for the stop.
#[test]
fn a_sled_rests_where_its_friction_holds_it() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("sled.mbs"), SLED).unwrap();
    let explained = text(mbs(folder.path(), "explain sled.mbs").stdout);
    let (_, switches) = explained.split_once("Switches: laws bend or jump where these values pass").unwrap();
    for words in [["der(x)", "0"].as_slice(), &["x", "-", "stop", "0"]] {
        assert!(switches.lines().any(|line| line.split_whitespace().eq(words.iter().copied())), "{switches}");
    }
    let output = mbs(folder.path(), "simulate sled.mbs --set stop=5m --end 3s --rtol 1e-6");
    let message = text(output.stderr);
    assert_eq!(output.status.code(), Some(1), "{message}");
    let told = " s: a law jumps with `der(x)`, and leads it back to the jump from both sides";
    let (when, _) = message.split_once(told).unwrap();
    let (_, when) = when.rsplit_once("from t = ").unwrap();
    assert!((when.parse::<f64>().unwrap() - 2.0).abs() < 1e-4, "{message}");
    // up to there nothing is wrong
    let output = mbs(folder.path(), "simulate sled.mbs --set stop=5m --end 1.9s --rtol 1e-6");
    let summary = text(output.stdout);
    assert!(
        summary.lines().any(|line| line.starts_with("x at the end") && line.contains("  3.24  ")),
        "{summary}"
    );
}
