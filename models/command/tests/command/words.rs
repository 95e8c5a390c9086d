//! Words of the command about mechanisms: lists, equations and completions.

use std::path::Path;

use super::{mbs, text};

#[test]
fn the_list_has_names_units_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let list = String::from_utf8(mbs(folder.path(), "list").stdout).unwrap();
    for part in ["slider-crank-free", "pendulum", "60 mm", "200 rpm", "crank_torque", "drive_torque", "dof"] {
        assert!(list.contains(part), "{list}");
    }
}

#[test]
fn explain_prints_the_equations() {
    let output = mbs(Path::new("."), "explain slider-crank");
    let text = String::from_utf8(output.stdout).unwrap();
    for expected in [
        "7 coordinates, 7 constraints, 0 degrees of freedom",
        "Φ[crank_x]     = x1 - 1/2*l1*cos(theta1)",
        "∂guide/∂theta2       = l2*cos(theta2)",
        "γ[guide]   = l1*sin(theta1)*der(theta1)^2 + l2*sin(theta2)*der(theta2)^2",
        "Q[y1] = -9.81*m1",
        "lambda(guide), theta2        l2*cos(theta2)  watched",
        "stabilized           49   44   1    2",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}

#[test]
fn explain_writes_latex() {
    let output = mbs(Path::new("."), "explain slider-crank-free --latex");
    let text = String::from_utf8(output.stdout).unwrap();
    for expected in [
        r"\Phi^{\mathrm{crank\_x}} &= x_{1} - \frac{1}{2} l_{1} \, \cos \theta_{1}",
        r"\frac{\partial \Phi_{\mathrm{guide}}}{\partial \theta_{2}} &= l_{2} \, \cos \theta_{2}",
        r"\dot{\theta_{1}}^{2}",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
    // what opens closes
    assert_eq!(text.matches(r"\begin").count(), text.matches(r"\end").count());
    assert_eq!(text.matches('{').count(), text.matches('}').count());
    assert_eq!(text.matches(r"\left(").count(), text.matches(r"\right)").count());
    assert_eq!(text.matches('$').count() % 2, 0);
    // and what is no letter of LaTeX does not occur
    assert!(text.is_ascii(), "{text}");
}

#[test]
fn what_scripts_read() {
    let folder = tempfile::tempdir().unwrap();
    let json = |arguments: &str| -> serde_json::Value {
        serde_json::from_slice(&mbs(folder.path(), arguments).stdout).unwrap()
    };
    let list = json("list --json");
    let crank = list.as_array().unwrap().iter().find(|model| model["name"] == "slider-crank").unwrap();
    assert_eq!(
        (&crank["parameters"][0]["name"], &crank["parameters"][0]["unit"]),
        (&"l1".into(), &"mm".into())
    );
    let run = json("simulate slider-crank --set omega=300 --end 0.1s --json --out a.csv");
    assert_eq!(run["given"]["omega"], serde_json::json!({ "value": 300.0, "unit": "rpm" }));
    assert_eq!((&run["steps"], &run["error"], &run["files"][0]), (&200.into(), &().into(), &"a.csv".into()));
    assert!(
        run["final"]["theta1"]["value"].as_f64().unwrap() > 3.0 && run["warnings"] == serde_json::json!([])
    );
    let sweep = json("sweep slider-crank --param l1=50..60:2 --end 0.1s --json");
    assert_eq!((&sweep["runs"], &sweep["failed"]), (&2.into(), &0.into()));
    assert!(sweep["quantities"]["drive_torque"]["largest"]["at"]["l1"]["unit"] == "mm", "{sweep}");
}

#[test]
fn completions_know_the_mechanisms() {
    let script = text(mbs(Path::new("."), "completions bash").stdout);
    for part in ["--compare", "slider-crank-free", "complete"] {
        assert!(script.contains(part), "{part}");
    }
}

/// `inverse`, `travel`, `fit`, `synthesize` and `export` completed no names.
#[test]
fn completions_know_the_mechanisms_of_every_command_that_takes_one() {
    let script = text(mbs(Path::new("."), "completions bash").stdout);
    let completed = |command: &str| {
        let case = script.split(&format!("mbs__subcmd__{command})")).nth(1).unwrap();
        case.split(";;").next().unwrap().contains("slider-crank-free")
    };
    for command in ["simulate", "explain", "inverse", "travel", "fit", "synthesize", "export__subcmd__page"] {
        assert!(completed(command), "{command}");
    }
    assert!(!completed("new"));
}
