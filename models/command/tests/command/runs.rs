//! Runs of one mechanism.

use paths::STRIDE;

use super::sweeps::sweep;
use super::{mbs, text};

#[test]
fn a_run_with_everything() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(
        folder.path(),
        "simulate slider-crank-free --set omega=300rpm --set l1=70mm --input crank_torque=0.5N*m --step 0.5ms \
         --end 0.1s --alpha 1000 --beta 1500 --feedback per-stage --start consistent --out a.csv --plot a.svg \
         --sketch mechanism.svg --report a.html",
    );
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report = String::from_utf8(output.stdout).unwrap();
    for part in ["steps", "200", "max ‖Φ‖", "energy change", "x3 at the end"] {
        assert!(report.contains(part), "{report}");
    }
    let csv = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let mut lines = csv.lines();
    let heading = lines.next().unwrap();
    assert!(heading.starts_with("t [s],x1 [m],y1 [m],theta1 [rad]"), "{heading}");
    for part in ["der(theta1) [rad/s]", "lambda(guide) [N]", "violation [SI]"] {
        assert!(heading.contains(part), "{heading}");
    }
    assert_eq!(lines.count(), 201);
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("angle (rad)"));
    let sketch = std::fs::read_to_string(folder.path().join("mechanism.svg")).unwrap();
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    for body in ["crank", "rod", "slider"] {
        assert!(sketch.contains(body) && page.contains(&format!("\"text\":\"{body}\"")), "{body}");
    }
    for part in ["max ‖Φ‖", "crank speed", "\"kind\":\"lines\""] {
        assert!(page.contains(part), "{part}");
    }
}

/// θ1 after 0.3 s is known to 12 digits (see `models/src/slider_crank_free.rs`): at 1 ms the
/// scheme of fourth order is off by 3e-7 rad, Heun's method by 1.7e-3.
#[test]
fn a_method_of_ones_choice() {
    const REFERENCE: f64 = 5.644159549774;
    let folder = tempfile::tempdir().unwrap();
    let error = |model: &str, options: &str| {
        let output = mbs(
            folder.path(),
            &format!("simulate {model} {options} --input crank_torque=0.5 --step 1ms --end 0.3s --out a.csv"),
        );
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let csv = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
        let at = csv.lines().next().unwrap().split(',').position(|name| name == "theta1 [rad]").unwrap();
        let end: f64 = csv.lines().next_back().unwrap().split(',').nth(at).unwrap().parse().unwrap();
        (end - REFERENCE).abs()
    };
    // to a tolerance, and in constant steps with projection
    assert!(error("slider-crank-free", "--rtol 1e-9 --atol 1e-11") < 5e-8);
    assert!(error("slider-crank-free", "--rtol 1e-10 --atol 1e-12 --method dop853") < 5e-9);
    assert!(error("slider-crank-free", "--method dop853 --feedback projection") < 1e-11);
    let (heun, rk4) = (error("slider-crank-free", ""), error("slider-crank-free", "--method rk4"));
    assert!(heun > 1e-3 && rk4 < 4e-7, "{heun} {rk4}");

    // RATTLE of fourth order, under a constant torque
    assert!(error("slider-crank-free", "--method rattle4") < 1e-6);
    // nothing is stiff there: a scheme of second order
    let trbdf2 = error("slider-crank-free", "--method trbdf2");
    assert!(trbdf2 > 1e-5 && trbdf2 < 2e-3, "{trbdf2}");
    let refused = |options: &str| {
        let output = mbs(folder.path(), &format!("simulate {options}"));
        assert!(!output.status.success());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(refused("spring-mass-damper --method rattle").contains("`x` depends on velocities"));
    assert!(refused("double-pendulum --method rattle --feedback held").contains("`feedback` cannot be used"));

    // implicit schemes to a tolerance
    for method in ["trbdf2", "esdirk4"] {
        let [coarse, fine] = ["1e-6", "1e-8"]
            .map(|rtol| error("slider-crank-free", &format!("--method {method} --rtol {rtol} --atol 1e-10")));
        assert!(fine < coarse / 10.0 && coarse < 1e-3, "{method}: {coarse} {fine}");
        let crank = format!("slider-crank-free --method {method}");
        assert!(refused(&format!("{crank} --rtol 0")).contains("rtol"));
        assert!(refused(&format!("{crank} --feedback held")).contains("`feedback` cannot be used"));
    }

    // declared in a file, and taken back
    let source = include_str!("../../../src/slider_crank_free.rs");
    let source = source.replace("dof = 1;", "dof = 1; method = rk4;");
    std::fs::write(folder.path().join("crank.rs"), source).unwrap();
    assert_eq!(error("crank.rs", ""), rk4);
    assert_eq!(error("crank.rs", "--method heun"), heun);

    let output = mbs(folder.path(), "simulate slider-crank-free --method euler");
    let words = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(words.contains("heun") && words.contains("rk4"), "{words}");
}

#[test]
fn beyond_stability_only_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = "simulate slider-crank --alpha 2600 --beta 2000 --feedback per-stage --end 5ms";
    assert!(!mbs(folder.path(), arguments).status.success());
    assert!(mbs(folder.path(), &format!("{arguments} --allow-unstable")).status.success());
}

/// A name begins its line; what belongs to it is indented.
#[test]
fn every_mechanism_runs_as_it_is_declared() {
    let folder = tempfile::tempdir().unwrap();
    let list = String::from_utf8(mbs(folder.path(), "list").stdout).unwrap();
    let heads = list.lines().skip(2).filter(|line| !line.starts_with(' '));
    let names: Vec<_> = heads.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() > 20, "{list}");
    for name in names.into_iter().step_by(STRIDE) {
        let output = mbs(folder.path(), &format!("simulate {name} --every 1000 --out {name}.csv"));
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let rows = std::fs::read_to_string(folder.path().join(format!("{name}.csv"))).unwrap();
        assert!(rows.lines().count() > 2, "{name}: {rows}");
    }
}

#[test]
fn long_lists_are_shortened() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        let output = mbs(folder.path(), &format!("simulate n-pendulum-10 --end 1ms {arguments}"));
        String::from_utf8(output.stdout).unwrap()
    };
    let (short, all) = (run("--out run.csv"), run("--all"));
    let parts =
        ["x_1 at the end", "theta_1 at the end", "theta_10 at the end", "der(x_1)", "hook_force at the end"];
    for part in parts {
        assert!(short.contains(part) && all.contains(part), "{part}: {short}");
    }
    assert_eq!(short.matches("… 24 more, with --all").count(), 2, "{short}");
    assert!(!short.contains("x_5") && all.contains("x_5 at the end") && !all.contains('…'), "{all}");
    let heading = std::fs::read_to_string(folder.path().join("run.csv")).unwrap();
    assert!(heading.lines().next().unwrap().contains("der(theta_5)"), "{heading}");
}

/// Values were in the declared unit over axes in SI units.
#[test]
fn the_unit_of_a_picture_is_that_of_its_values() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let run = "simulate chebyshev --end 0.1s --out a.csv --plot a.svg --report a.html --columns p_x";
    assert!(mbs(folder.path(), run).status.success());
    let csv = file("a.csv");
    let mut lines = csv.lines();
    assert_eq!(lines.next().unwrap(), "t [s],p_x [mm]");
    let first: f64 = lines.next().unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert!((first - 80.0).abs() < 1e-3, "{first}");
    assert!(file("a.svg").contains("p x (mm)"));
    let page = file("a.html");
    let begin = page.find("id=\"data\">").unwrap() + 10;
    let data = &page[begin..begin + page[begin..].find("</script>").unwrap()];
    let plots: serde_json::Value = serde_json::from_str(data).unwrap();
    let curve = plots.as_array().unwrap().iter().find(|plot| plot["kind"] == "lines").unwrap();
    assert_eq!(curve["y"]["label"], "p x (mm)");
    assert!((curve["series"][0]["y"][0].as_f64().unwrap() - first).abs() < 1e-3);
    let readout = &plots[0]["readouts"][0];
    assert_eq!((&readout["name"], &readout["unit"]), (&"p x".into(), &"mm".into()));
    // A sweep over one parameter, and over two.
    let (_, rows) = sweep(folder.path(), "chebyshev --param crank_length=30..50:3 --output p_x --end 0.5s");
    assert!(rows[0].contains(&"max p_x [mm]".to_owned()), "{:?}", rows[0]);
    assert!(file("out.svg").contains("peak p x (mm)") && file("out.svg").contains("crank length (mm)"));
    let two = "chebyshev --param crank_length=30..50:3 --param omega=30..60:2 --output p_x --end 0.5s";
    sweep(folder.path(), two);
    for part in ["peak p x (mm)", "crank length (mm)", "omega (rpm)"] {
        assert!(file("out.svg").contains(part), "{part}");
    }
}

#[test]
fn doubtful_numbers_end_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "simulate slider-crank --step 20ms --end 4s --out a.csv");
    assert_eq!(output.status.code(), Some(3));
    let warning = text(output.stderr);
    assert!(
        warning.starts_with("warning: the constraint `") && warning.contains("try a smaller --step"),
        "{warning}"
    );
    assert!(folder.path().join("a.csv").exists() && text(output.stdout).contains("written: a.csv"));
}

#[test]
fn columns_and_runs_of_ones_choice() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let run = |arguments: &str| {
        let output = mbs(folder.path(), &format!("simulate slider-crank --end 0.1s {arguments}"));
        assert!(output.status.success(), "{}", text(output.stderr));
        text(output.stdout)
    };
    let report = run("--columns x?,drive* --x theta1 --out a.csv --plot a.svg");
    assert!(file("a.csv").starts_with("theta1 [rad],x1 [m],x2 [m],x3 [m],drive_torque [N*m]\n"));
    assert!(report.contains("x3 at the end") && !report.contains("y1 at the end"), "{report}");
    let svg = file("a.svg");
    assert!(svg.contains("theta1 (rad)") && svg.contains("position (m)") && !svg.contains("time (s)"));
    let report = run("--compare omega=100,200 --columns x3 --out b.csv --plot b.svg");
    for part in ["omega = 100 rpm", "omega = 200 rpm"] {
        assert!(report.contains(part) && file("b.svg").contains(part), "{part}");
    }
    let csv = file("b.csv");
    assert!(csv.starts_with("omega [rpm],t [s],x3 [m]\n100.0,0.0,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 2 * 201);
}

#[test]
fn inputs_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), "t [s],crank_torque [N*mm]\n0,0\n0.1,500\n").unwrap();
    let run =
        |arguments: &str| mbs(folder.path(), &format!("simulate slider-crank-free --end 0.1s {arguments}"));
    let end = |arguments: &str| {
        let output = run(&format!("--json {arguments}"));
        assert!(output.status.success(), "{}", text(output.stderr));
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        json["final"]["theta1"]["value"].as_f64().unwrap()
    };
    let (none, rising, constant) = (end(""), end("--input @in.csv"), end("--input crank_torque=0.5"));
    assert!(none < rising && rising < constant, "{none} {rising} {constant}");
    // the only column beside the time has any name, and columns of a log that are no inputs are skipped
    std::fs::write(folder.path().join("load.csv"), "t [s];load [N*mm]\n0;0\n0,1;500\n").unwrap();
    assert_eq!(end("--input crank_torque=@load.csv").to_bits(), rising.to_bits());
    std::fs::write(
        folder.path().join("log.csv"),
        "crank_torque (N*mm),t (ms),oil (K)\n0,0,300\n500,100,301\n",
    )
    .unwrap();
    assert_eq!(end("--input @log.csv").to_bits(), rising.to_bits());
    let noted = text(run("--input @log.csv").stderr);
    assert!(noted.contains("note: columns that are no inputs are not used: oil"), "{noted}");
    let absent = text(run("--input crank_torque=@log2.csv --input crank_torque=@in.csv").stderr);
    assert!(absent.contains("log2.csv"), "{absent}");
    let both = text(run("--input @log.csv --input crank_torque=@in.csv").stderr);
    assert!(both.contains("`crank_torque` cannot be used: two tables have it"), "{both}");
    let twice = run("--input @in.csv --input crank_torque=1");
    assert!(text(twice.stderr).contains("set to a value and changes with time"));
}

/// The ramp of a geared motor, whose motion depended on the time between two samples: -21.8 rad with 1 s.
#[test]
fn a_ramp_for_any_step() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ramp.csv"), "t [s],load [N*m]\n0,0\n1,1\n").unwrap();
    for step in ["1s", "0.3s", "1ms"] {
        let run = format!(
            "simulate geared-motor --set speed=0 --input @ramp.csv --end 1s --rtol 1e-9 --step {step} --json"
        );
        let json: serde_json::Value = serde_json::from_slice(&mbs(folder.path(), &run).stdout).unwrap();
        let phi2 = json["final"]["phi2"]["value"].as_f64().unwrap();
        assert!((phi2 + 23.77122).abs() < 1e-5, "{step}: {phi2}");
    }
}

/// A log that begins at 646 s is followed on its clock, to its end.
#[test]
fn inputs_on_a_clock_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let table = |start: i32| format!("t [s],load [N*m]\n{start},0\n{},1\n", start + 1);
    for (name, start) in [("own.csv", 0), ("log.csv", 646)] {
        std::fs::write(folder.path().join(name), table(start)).unwrap();
    }
    let run = |arguments: &str| {
        mbs(
            folder.path(),
            &format!("simulate geared-motor --set speed=0 --rtol 1e-9 --step 0.1s {arguments}"),
        )
    };
    let json = |arguments: &str| -> serde_json::Value {
        serde_json::from_slice(&run(&format!("{arguments} --json")).stdout).unwrap()
    };
    let (own, log) = (json("--input @own.csv"), json("--input @log.csv"));
    let value = |json: &serde_json::Value, name: &str| json["final"][name]["value"].as_f64().unwrap();
    assert_eq!((value(&own, "t"), value(&log, "t")), (1.0, 647.0));
    assert!((value(&own, "phi2") - value(&log, "phi2")).abs() < 1e-7);
    assert!(log["notes"][0].as_str().unwrap().contains("begin at 646 s on a clock of their own"), "{log}");
    let early = text(run("--input @log.csv --end 2s").stderr);
    assert!(early.contains("the end time is 2 s"), "{early}");
}

/// The torque that a motion takes, followed by a run, gives the motion: to a tolerance but for the straight lines
/// between its samples, an error that falls with the square of their distance; in steps whose stages are at the
/// samples, to the error of the steps.
#[test]
fn inverse_dynamics_lead_back() {
    let folder = tempfile::tempdir().unwrap();
    let error = |samples: u32, method: &str| {
        let inverse = "inverse four-bar-free --move theta2=0deg..90deg --over 0.1s --inputs crank_torque";
        let output = mbs(folder.path(), &format!("{inverse} --samples {samples} --out torque.csv"));
        assert!(output.status.success(), "{}", text(output.stderr));
        let run = "simulate four-bar-free --set omega=0 --input @torque.csv --end 0.1s --json";
        let output = mbs(folder.path(), &format!("{run} {method}"));
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        (json["final"]["theta2"]["value"].as_f64().unwrap() - std::f64::consts::FRAC_PI_2).abs()
    };
    let [coarse, fine] = [201, 401].map(|samples| error(samples, "--rtol 1e-10 --atol 1e-12"));
    assert!(fine < 2e-4 && (coarse / fine - 4.0).abs() < 0.1, "{coarse} {fine}");
    let steps = error(201, "--method rk4 --step 1ms");
    assert!(steps < 2e-6, "{steps}");
}

#[test]
fn what_a_run_to_a_tolerance_cannot_do_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (options, part) in [
        ("--rtol 0", "rtol"),
        ("--atol -1e-9", "atol"),
        ("--rtol 1e-6 --feedback held", "projection"),
        ("--rtol 1e-6 --alpha 100", "alpha"),
        ("--feedback projection --beta 100", "beta"),
        ("--rtol 1e-6 --method rk4", "dopri5"),
        ("--rtol 1mm", "without a unit"),
        ("--until x3=200mm", "x3 > 200mm"),
        ("--until y9>200mm", "y9"),
    ] {
        let output = mbs(folder.path(), &format!("simulate slider-crank-free --end 10ms {options}"));
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && words.contains(part), "{options}: {words}");
    }
}

/// A ball thrown upwards: y = 1 m + 2 m/s t − 4.905 m/s² t².
#[test]
fn events_and_conditions_that_end_a_run() {
    const BALL: &str = "Ball {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 0.3 [kg]; }
        event top: der(y) = 0 falling;
        event shelf: ball.y = 0.5 [m];
        start { y = 1 [m]; der(y) = 2 [m/s]; }
        output height [mm] = y;
    }";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ball.mbs"), BALL).unwrap();
    let json = |options: &str| -> serde_json::Value {
        let output = mbs(folder.path(), &format!("simulate ball.mbs --json {options}"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let height = |y: f64| (2.0 + (4.0 + 4.0 * 4.905 * (1.0 - y)).sqrt()) / 9.81;
    let is_near = |value: &serde_json::Value, t: f64| (value.as_f64().unwrap() - t).abs() < 1e-12;
    let run = json("--until height<200mm --out ball.csv");
    let events = run["events"].as_array().unwrap();
    let names: Vec<&str> = events.iter().map(|event| event["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["top", "shelf", "height<200mm"]);
    for (event, t) in events.iter().zip([2.0 / 9.81, height(0.5), height(0.2)]) {
        assert!(is_near(&event["t_s"], t), "{event} {t}");
    }
    // the run ends there, and so does its table
    assert!(is_near(&run["end_s"], height(0.2)) && run["unmet"].is_null());
    let csv = std::fs::read_to_string(folder.path().join("ball.csv")).unwrap();
    let last: f64 = csv.lines().next_back().unwrap().split(',').next().unwrap().parse().unwrap();
    assert!((last - height(0.2)).abs() < 1e-9, "{last}");

    // a declared event ends a run by its name
    let run = json("--until shelf --out ball.csv");
    let names: Vec<&str> =
        run["events"].as_array().unwrap().iter().map(|event| event["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["top", "shelf"]);
    assert!(is_near(&run["end_s"], height(0.5)) && run["unmet"].is_null());

    let run = json("--until y>2 --end 0.5s");
    assert_eq!((run["unmet"].as_str(), run["end_s"].as_f64()), (Some("y>2"), Some(0.5)));
    // constant steps find no events
    assert_eq!(json("--feedback held --end 0.5s")["events"].as_array().unwrap().len(), 0);
    let table = mbs(folder.path(), "simulate ball.mbs --until y>0 --end 0.5s");
    assert!(String::from_utf8_lossy(&table.stdout).contains("holds from the start"));
    // an event that does not come, a name that is none, and a method that finds no events
    assert_eq!(json("--until shelf --end 0.5s")["unmet"].as_str(), Some("shelf"));
    for (options, part) in [
        ("--until self", "or what is declared so (`top`, `shelf`)"),
        ("--until shelf --method rattle", "`until` cannot be used"),
        ("--rtol 1e-6 --method rattle", "`rtol` cannot be used"),
        ("--rtol 0", "rtol is 0.0"),
    ] {
        let output = mbs(folder.path(), &format!("simulate ball.mbs --end 0.5s {options}"));
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && words.contains(part), "{options}: {words}");
    }
}

/// Two rods of 0.5 m and 1 kg on each other: they hang, and stand where they begin near to it.
#[test]
fn where_a_mechanism_rests() {
    let folder = tempfile::tempdir().unwrap();
    let json = |options: &str| -> serde_json::Value {
        let output = mbs(folder.path(), &format!("equilibrium double-pendulum --json {options}"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice(&output.stdout).unwrap()
    };
    let rest = json("--sketch rest.svg");
    assert!(rest["is_stable"].as_bool().unwrap() && folder.path().join("rest.svg").exists());
    assert!((rest["outputs"]["end_y"]["value"].as_f64().unwrap() + 1.0).abs() < 1e-10);
    // both weights hang from the hook
    assert!((rest["outputs"]["hook_force"]["value"].as_f64().unwrap() - 2.0 * 9.81).abs() < 1e-8);
    let standing = json("--from angle1=175deg --from angle2=178deg");
    assert!((standing["outputs"]["end_y"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-10);
    assert_eq!(standing["stability"], "unstable: it falls away in 2 directions");
    assert!(json("--from angle1=175deg --from angle2=178deg --relax")["is_stable"].as_bool().unwrap());
    // a chain of 40 did not come to rest within the iterations
    let chain = mbs(folder.path(), "equilibrium n-pendulum-40 --relax");
    let table = String::from_utf8_lossy(&chain.stdout).into_owned();
    assert!(table.lines().any(|line| line.starts_with("stability") && line.ends_with(" stable")), "{table}");

    // a drive holds it: what is found are its reactions
    let held = mbs(folder.path(), "equilibrium slider-crank");
    let table = String::from_utf8_lossy(&held.stdout).into_owned();
    assert!(held.status.success() && table.contains("held: nothing is free to move"), "{table}");

    for (options, part) in [
        ("double-pendulum --from angle3=1", "angle2"),
        ("double-pendulum --input @force.csv", "@FILE"),
        ("spring-mass-damper --set stiffness=much", "much"),
    ] {
        let output = mbs(folder.path(), &format!("equilibrium {options}"));
        let words = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && words.contains(part), "{options}: {words}");
    }
}

/// A start at a stop hits it, which is the first event of a run. Regression: `--from` took the velocity behind that impact to a
/// place where nothing is hit.
#[test]
fn a_start_at_a_stop_hits_it_where_it_is() {
    const BALL: &str = "Ball {
        dof = 1;
        body ball (y) { mass = 2 [kg]; }
        stop floor: y >= 0 [m] { restitution = 0.5; }
        start { y = 0; der(y) = -2 [m/s]; }
    }";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ball.mbs"), BALL).unwrap();
    for (from, events, rate, impulse) in
        [("", 1, 1.0, 6.0), ("--from y=0", 1, 1.0, 6.0), ("--from y=0.5", 0, -2.0, 0.0)]
    {
        let output = mbs(folder.path(), &format!("simulate ball.mbs --end 0.1 {from} --out ball.csv --json"));
        let run: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let found = run["events"].as_array().unwrap();
        assert!(found.len() == events && found.iter().all(|event| event["t_s"] == 0.0), "{from}: {found:?}");
        let csv = std::fs::read_to_string(folder.path().join("ball.csv")).unwrap();
        let last: Vec<f64> =
            csv.lines().next_back().unwrap().split(',').map(|x| x.parse().unwrap()).collect();
        assert!((last[2] - rate).abs() < 1e-12 && (last[4] - impulse).abs() < 1e-12, "{from}: {last:?}");
    }
}

/// A value that stands at the limit does not meet `>`, and does as soon as it is above: an output that counts, one that jumps
/// from 0 to 1, and what rests at 0. Regression: `n > 50` ended a run at 50, and `s > 0` none.
#[test]
fn strict_conditions_are_met_above_their_limit() {
    let folder = tempfile::tempdir().unwrap();
    let ends = |text: &str, until: &str| -> f64 {
        std::fs::write(folder.path().join("text.mbs"), text).unwrap();
        let mut ends = ["--step 1ms", "--rtol 1e-9"].map(|stepping| {
            let options = format!("simulate text.mbs --json --end 1s --until {until} {stepping}");
            let output = mbs(folder.path(), &options);
            assert!(output.status.success(), "{until}: {}", String::from_utf8_lossy(&output.stderr));
            let found: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
            assert!(found["unmet"].is_null(), "{found}");
            found["end_s"].as_f64().unwrap()
        });
        ends.sort_by(f64::total_cmp);
        assert!(ends[1] - ends[0] < 1e-6, "{until}: {ends:?}");
        ends[0]
    };
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-6, "{found}");
    let counter = "Counter { dof = 1; body b (x) { mass = 1 [kg]; }
        memory n [1] = 0; every 10 [ms] { set n = n + 1; } output n = n; }";
    near(ends(counter, "n>50"), 0.5);
    near(ends(counter, "n>=50"), 0.49);
    let shown = "Shown { dof = 1; body b (x) { mass = 1 [kg]; } start { der(x) = 1 [m/s]; }
        output s = if x > 0.3 [m] { 1 } else { 0 }; }";
    near(ends(shown, "s>0"), 0.3);
    let pushed = "Pushed { dof = 1; body b (x) { mass = 1 [kg]; }
        force f on x = if t > 0.2 [s] { 1 [N] } else { 0 }; }";
    near(ends(pushed, "x>0"), 0.2);
}
