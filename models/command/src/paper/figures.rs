//! The figures of the paper, and those that it could have had.

use mbs_workbench::figure::{Axis, Figure, HeatMap, Panel, Series, Stroke};

use super::setup::{Inertia, SPEEDS, Setup, Trace};
use super::study::{Point, Study};
use super::{scalars::Scalars, torque};

/// A figure with the name of its files and what it shows.
pub struct Picture {
    /// Name of its files, without ending.
    pub file: &'static str,
    /// A caption of a sentence or two.
    pub caption: String,
    /// The figure.
    pub figure: Figure,
}

const COORDINATES: [&str; 7] = ["x₁", "y₁", "θ₁", "x₂", "y₂", "θ₂", "x₃"];

fn picture(file: &'static str, caption: impl Into<String>, figure: Figure) -> Picture {
    Picture { file, caption: caption.into(), figure }
}

fn time() -> Axis {
    Axis::new("time", "s")
}

/// ‖Φ‖ mixes metres and radians, so it has no unit.
fn violation() -> Axis {
    Axis::new("constraint violation ‖Φ‖", "")
}

/// Figures 4–7: no feedback, the paper's start.
pub fn drift(study: &Study) -> Vec<Picture> {
    let run = &study.drift;
    let shown = &until_it_explodes(run);
    let consistent = &study.drift_consistent;
    let compared = [
        Series::xy("paper's start", &run.t, &run.phi),
        Series::xy("consistent start", &consistent.t, &consistent.phi).stroke(Stroke::Dashed),
    ];
    vec![
        picture(
            "fig04",
            "No stabilization: θ₂ rises although it should fall, and x₃ goes through the origin. Both come from \
             the start, which gives the crank its speed and leaves everything else at rest.",
            coordinates("Figure 4. Generalized coordinates without stabilization", shown, &[0, 1, 3, 4, 6]),
        ),
        picture(
            "fig05",
            "The violation from the paper's start, and that of the same integration from velocities that \
             satisfy the constraints.",
            Figure::new("Figure 5. Constraint violation without stabilization").panel(Panel::lines(
                time(),
                violation().log().range(1e-9, 1.0),
                compared,
            )),
        ),
        picture(
            "fig06",
            "The slider's position against the exact one.",
            x3("Figure 6. x₃ without stabilization, numerical and analytical", shown),
        ),
        picture(
            "fig07",
            "Relative error of x₃.",
            x3_error("Figure 7. Relative error of x₃ without stabilization", run, true),
        ),
    ]
}

/// Figures 8–10 and 13: α = β = 2000, the paper's start.
pub fn stabilized(study: &Study) -> Vec<Picture> {
    let run = &study.stabilized;
    let phi = Series::xy("", &run.t, &run.phi);
    let starts = [
        Series::xy("both stages, paper's start", &run.t, &run.phi),
        Series::xy(
            "both stages, consistent start",
            &study.stabilized_consistent.t,
            &study.stabilized_consistent.phi,
        ),
        Series::xy("held, consistent start", &study.held.t, &study.held.phi).stroke(Stroke::Dashed),
    ];
    vec![
        picture(
            "fig08",
            "With α = β = 2000 1/s. The peak within the first milliseconds is the start's violation of Φ̇ = 0.",
            Figure::new("Figure 8. Constraint violation with stabilization").panel(Panel::lines(
                time(),
                violation(),
                [phi],
            )),
        ),
        picture(
            "fig09",
            "The two curves cannot be told apart.",
            x3("Figure 9. x₃ with stabilization, numerical and analytical", run),
        ),
        picture(
            "fig10",
            "Relative error of x₃.",
            x3_error("Figure 10. Relative error of x₃ with stabilization", run, false),
        ),
        picture(
            "fig13",
            "All coordinates but θ₁ over one turn.",
            coordinates("Figure 13. Generalized coordinates with stabilization", run, &[0, 1, 3, 4, 6]),
        ),
        picture(
            "fig08b",
            "From a consistent start nothing has to be corrected, and the violation stays at the level of Heun's own error.",
            Figure::new("Constraint violation: what the start does").panel(Panel::lines(
                time(),
                violation().log().range(1e-9, 1e-5),
                starts,
            )),
        ),
    ]
}

/// The run as long as the linkage has any likeness to itself: in its last
/// millisecond the singular system throws the parts to 10⁶⁰ m.
fn until_it_explodes(run: &Trace) -> Trace {
    // θ₁, the largest coordinate, stays below π.
    let end = (0..run.t.len()).find(|&k| run.q.iter().any(|q| q[k].abs() > 4.0)).unwrap_or(run.t.len());
    let cut = |column: &[f64]| column[..end].to_vec();
    Trace {
        t: cut(&run.t),
        q: run.q.each_ref().map(|q| cut(q)),
        exact_x3: cut(&run.exact_x3),
        ..Trace::default()
    }
}

fn coordinates(title: &str, run: &Trace, lengths: &[usize]) -> Figure {
    let series = |at: usize| Series::xy(COORDINATES[at], &run.t, &run.q[at]);
    // y₁ and y₂ coincide by the geometry: the second is dashed, so that both are seen.
    let stroked = |at: usize| series(at).stroke(if at == 4 { Stroke::Dashed } else { Stroke::Solid });
    Figure::new(title)
        .panel_height(360)
        .panel(Panel::lines(time(), Axis::new("position", "m"), lengths.iter().map(|at| stroked(*at))))
        .panel(Panel::lines(time(), Axis::new("angle", "rad"), [series(5)]))
}

fn x3(title: &str, run: &Trace) -> Figure {
    let numerical = Series::xy("numerical", &run.t, &run.q[6]);
    let exact = Series::xy("analytical", &run.t, &run.exact_x3).stroke(Stroke::Dashed);
    Figure::new(title).panel(Panel::lines(time(), Axis::new("x₃", "m"), [numerical, exact]))
}

fn x3_error(title: &str, run: &Trace, log: bool) -> Figure {
    let error = Series::xy("", &run.t, &run.relative_x3);
    let axis = Axis::new("relative error of x₃", "");
    Figure::new(title).panel(Panel::lines(
        time(),
        if log { axis.log().range(1e-6, 10.0) } else { axis },
        [error],
    ))
}

/// Figures 11 and 12, and the same curves beyond the paper's range.
pub fn gains(study: &Study) -> Vec<Picture> {
    let rate = |name: &str| Axis::new(name, "1/s");
    let largest = || Axis::new("max ‖Φ‖", "").log();
    let map = HeatMap {
        x: study.gains.clone(),
        y: study.gains.clone(),
        values: study.map.iter().map(|phi| phi.unwrap_or(f64::NAN)).collect(),
        scale: largest(),
    };
    let curve = |points: &[Point], limit: f64| {
        let shown = points.iter().filter(move |(gain, _)| *gain <= limit);
        shown.map(|(gain, phi)| [*gain, phi.unwrap_or(f64::NAN)]).collect::<Vec<_>>()
    };
    let line = |label: &str, points: &[Point], limit: f64| {
        let series = Series::new("", curve(points, limit)).stroke(Stroke::Dotted);
        Panel::lines(rate(label), largest(), [series])
    };
    let beyond = [
        Series::new("over β at α = 2000", curve(&study.along_beta, 3000.0)),
        Series::new("over α at β = 2000", curve(&study.along_alpha, 3000.0)),
    ];
    vec![
        picture(
            "fig11",
            "The largest violation during one turn, over both gains. Along α it falls much more than along β.",
            Figure::new("Figure 11. Constraint violation over α and β")
                .panel(Panel::map(rate("α"), rate("β"), map))
                .panel_height(620),
        ),
        picture(
            "fig12",
            "The section of Figure 11 at α = 2000 1/s: the minimum is where the range ends.",
            Figure::new("Figure 12. Constraint violation over β at α = 2000 1/s").panel(line(
                "β",
                &study.along_beta,
                2000.0,
            )),
        ),
        picture(
            "gains",
            "Over β the violation falls on beyond 2000, down to that of the first step, which does not depend on β; \
             over α it rises. Per-stage feedback with β = 2000 is stable up to α = 2500.",
            Figure::new("Beyond the paper's range of gains").panel(Panel::lines(
                rate("gain"),
                largest().range(1e-6, 1e-2),
                beyond,
            )),
        ),
    ]
}

/// Figure 14, Table 3, and the torque that the paper did not see.
pub fn torques(study: &Study, scalars: &Scalars) -> Vec<Picture> {
    let angle = || Axis::new("crank angle θ₁", "rad");
    let torque = || Axis::new("drive torque", "N·m");
    let runs = || SPEEDS.iter().zip(&study.torque);
    let over_angle = runs().map(|(rpm, run)| Series::xy(format!("{rpm} rpm"), &run.q[2], &run.raw_torque));
    let spikes = runs().map(|(rpm, run)| {
        let ms = run.t.iter().map(|t| 1e3 * t).collect::<Vec<_>>();
        Series::xy(format!("{rpm} rpm"), &ms, &run.raw_torque).stroke(Stroke::Dotted)
    });
    let turns = 2.0 * std::f64::consts::TAU;
    vec![
        picture(
            "fig14",
            "The spike at the start is the start's violation, fed back; then the torque repeats every turn.",
            Figure::new("Figure 14. Drive torque (J = m l²/3, α = β = 1000 1/s)")
                .panel_height(400)
                .panel(Panel::lines(angle().range(0.0, turns), torque().range(-8.0, 8.0), over_angle))
                .panel(Panel::lines(Axis::new("time", "ms").range(0.0, 10.0), torque(), spikes)),
        ),
        peaks(scalars),
        feedback_torques(study),
    ]
}

fn peaks(scalars: &Scalars) -> Picture {
    let series = |name: &str, key: &dyn Fn(f64) -> String| {
        Series::new(name, SPEEDS.map(|rpm| [rpm, scalars.number(&key(rpm))]))
    };
    let curves = [
        series("Table 3's run, J = m l²/3", &|rpm| format!("table3.{rpm}rpm")).stroke(Stroke::Dotted),
        series("closed form, J = m l²/3", &|rpm| format!("torque.closed_form.ml2_3.{rpm}rpm"))
            .stroke(Stroke::Dashed),
        series("clean multipliers, J = m l²/12", &|rpm| format!("torque.clean.ml2_12.{rpm}rpm"))
            .stroke(Stroke::Dotted),
        series("closed form, J = m l²/12", &|rpm| format!("torque.closed_form.ml2_12.{rpm}rpm"))
            .stroke(Stroke::Dashed),
    ];
    let axes = (Axis::new("crank speed", "rpm"), Axis::new("peak drive torque", "N·m"));
    picture(
        "table3",
        "Raw multipliers under per-stage feedback miss the closed form; clean ones lie on it.",
        Figure::new("Table 3. Peak torque over crank speed").panel(Panel::lines(axes.0, axes.1, curves)),
    )
}

fn feedback_torques(study: &Study) -> Picture {
    let p = Setup::gains(0.0, 0.0).torque(200.0, Inertia::Rod).parameters(&study.crank);
    let exact =
        (0..=360).map(|k| f64::from(k).to_radians()).map(|theta| [theta, torque::closed_form(&p, theta)]);
    let turn = std::f64::consts::TAU;
    let runs = study.feedbacks.iter().filter(|run| run.key != "none" && run.key != "per_stage.a2000_sqrt2");
    let mut curves: Vec<_> = runs
        .map(|run| {
            let angle: Vec<_> = run.trace.q[2].iter().map(|theta| theta - turn).collect();
            Series::xy(format!("raw, {}", run.name), &angle, &run.trace.raw_torque)
        })
        .collect();
    curves.push(Series::new("closed form", exact).stroke(Stroke::Dashed));
    let axes = (Axis::new("crank angle θ₁", "rad").range(0.0, turn), Axis::new("drive torque", "N·m"));
    picture(
        "torque",
        "The torque as the solver's multipliers give it, with the feedback terms left in (second turn, 200 rpm, \
         J = m l²/12). Fed back in both stages of Heun's method, the predictor's error spoils it.",
        Figure::new("Drive torque under different feedbacks").panel(Panel::lines(axes.0, axes.1, curves)),
    )
}
