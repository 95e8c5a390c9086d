//! The report of the reproduction: `index.html`.

use mbs_workbench::Table;
use mbs_workbench::picture::{self, Shape};
use mbs_workbench::report::{Animation, Block, Readout, Report, Section};

use super::crank::Crank;
use super::figures::Picture;
use super::setup::{Setup, Trace};
use super::study::Study;

const LEAD: &str = "Zanyu Jiang, “Dynamic Modeling of Multi-body Systems: A Numerical Study on Crank-slider \
    Mechanism” (2025, doi 10.26855/oajrcap.2025.12.001), computed again from a declaration of the mechanism \
    that is compiled to a solver. The numbers on this page come from the run that wrote it.";

/// Its tables and figures, ready to be put in their places.
pub struct Parts {
    /// Quantity, paper, here, verdict.
    pub results: Table,
    /// The feedbacks compared.
    pub feedbacks: Table,
    /// The pictures by the section that shows them: 4–7, 8–10 and 13, 11–12, 14 and Table 3.
    pub pictures: [Vec<Picture>; 4],
}

/// The whole report.
pub fn report(study: &Study, parts: Parts) -> Report {
    let [drift, stabilized, gains, torques] = parts.pictures.map(|pictures| {
        pictures.into_iter().map(|picture| {
            let endings = ["svg", "png", "csv"];
            let files = endings.iter().map(|ending| format!("{}.{ending}", picture.file)).collect();
            Block::Figure { figure: picture.figure, caption: picture.caption, files }
        })
    });
    let section = |heading: &str, text: &str, blocks: &mut dyn Iterator<Item = Block>| {
        blocks.fold(Section::new(heading).text(text), Section::with)
    };
    let sections = vec![
        Section::new("Results")
            .text(
                "What the paper says, what comes out here, and how they compare. A verdict is computed from the two \
                 numbers; “unexplained” means that no setting was found that gives the paper's number.",
            )
            .with(Block::Table(parts.results)),
        Section::new("The mechanism").with(Block::Animation(animation(
            &study.crank,
            "Driven at 200 rpm, held feedback, consistent start",
            &study.held,
        ))),
        section(
            "Without stabilization",
            "The paper integrates Eq. (6) from a start in which only the crank moves. That start violates the \
             velocity constraints, nothing corrects it, and the parts drift away from each other.",
            &mut std::iter::once(Block::Animation(animation(
            &study.crank,
                "The paper's start without stabilization: the linkage falls apart",
                &study.drift,
            )))
            .chain(drift),
        ),
        section(
            "With stabilization",
            "Baumgarte's feedback with α = β = 1/h = 2000 1/s in both stages of Heun's method, h = 0.5 ms.",
            &mut stabilized.into_iter(),
        ),
        section(
            "Choice of gains",
            "The largest violation during one turn from the paper's start. The linear model of the feedback \
             explains the minimum: with αh = 1 and βh = √2 both stages together cancel a violation within two steps.",
            &mut gains.into_iter(),
        ),
        section(
            "Drive torque",
            "The torque is the multiplier of the drive. The paper's runs use J = m l²/3 (a rod about its end) with \
             coordinates at the centre, where m l²/12 belongs.",
            &mut torques.into_iter(),
        )
        .text(
            "The table compares feedbacks at 200 rpm, J = m l²/12, consistent start, from 0.1 s to 0.6 s. “Raw” \
             multipliers contain the feedback terms, “clean” ones do not. Held feedback is evaluated once a step.",
        )
        .with(Block::Table(parts.feedbacks)),
    ];
    Report { title: "The driven slider-crank, reproduced".into(), lead: LEAD.into(), sections }
}

/// Each body drawn where its own coordinates say it is, so that a violated
/// joint is seen to be open.
fn animation(crank: &Crank, title: &str, run: &Trace) -> Animation {
    /// Every third step: a turn has 200 pictures.
    const STRIDE: usize = 3;
    let p = Setup::gains(0.0, 0.0).parameters(crank);
    let [x1, y1, theta1, x2, y2, theta2, x3] = &run.q;
    let frames = (0..run.t.len()).step_by(STRIDE).filter(|&k| run.q.iter().all(|q| q[k].abs() < 1e3));
    let frames: Vec<_> = frames.collect();
    let ends = |x: f64, y: f64, theta: f64, length: f64| {
        let (s, c) = theta.sin_cos();
        let (dx, dy) = (0.5 * length * c, 0.5 * length * s);
        [[x - dx, y - dy], [x + dx, y + dy]]
    };
    let place = |&k: &usize| {
        let [a, b] = ends(x1[k], y1[k], theta1[k], p.l1);
        let [c, d] = ends(x2[k], y2[k], theta2[k], p.l2);
        vec![[0.0, 0.0], a, b, c, d, [x3[k], 0.0], [x2[k], y2[k]], [1.0, 0.0]]
    };
    let readout = |name: &str, unit: &str, values: &[f64]| Readout {
        name: name.into(),
        unit: unit.into(),
        values: frames.iter().map(|&k| values[k]).collect(),
    };
    let bar = |between: [usize; 2], colour| Shape::Bar { between, colour };
    let label =
        |text: &str, near: &[usize], colour| Shape::Label { text: text.into(), near: near.into(), colour };
    let shapes = vec![
        Shape::Rail { from: 0, ahead: 7, reach: [0.0, 1.15 * (p.l1 + p.l2)] },
        Shape::Ground { at: 0 },
        bar([1, 2], 0),
        bar([3, 4], 1),
        Shape::Block { at: 5, from: 0, ahead: 7, colour: 2 },
        Shape::Pin { at: 1 },
        Shape::Pin { at: 2 },
        Shape::Pin { at: 3 },
        Shape::Pin { at: 4 },
        label("crank", &[1, 2], 0),
        label("rod", &[3, 4], 1),
        label("slider", &[5], 2),
    ];
    Animation {
        title: title.into(),
        picture: picture::Picture {
            times: frames.iter().map(|&k| run.t[k]).collect(),
            points: frames.iter().map(place).collect(),
            shapes,
            traced: vec![(6, 1)],
            weight: 1.0,
        },
        readouts: vec![
            readout("x₃", "m", x3),
            readout("drive torque", "N·m", &run.clean_torque),
            readout("‖Φ‖", "", &run.phi),
        ],
    }
}
