//! The claims of the paper, the numbers that come out here, and how the two compare: always computed from the
//! numbers.

use mbs_workbench::Table;
use mbs_workbench::number::significant;

use super::scalars::Scalars;
use super::setup::SPEEDS;
use super::study::Study;

/// The paper's claim about a quantity.
#[derive(Clone, Copy, Debug)]
enum Claim {
    /// A number printed with so many decimals.
    Printed(f64, usize),
    /// A bound from above.
    Below(f64),
    /// "About" a number.
    About(f64),
}

impl Claim {
    fn text(self, unit: &str) -> String {
        let text = match self {
            Self::Printed(value, decimals) => format!("{value:.decimals$} {unit}"),
            Self::Below(bound) => format!("< {} {unit}", significant(bound, 3)),
            Self::About(value) => format!("about {} {unit}", significant(value, 3)),
        };
        text.trim_end().to_owned()
    }

    /// How `here` compares with it.
    fn verdict(self, here: f64) -> String {
        match self {
            Self::Printed(value, decimals) => {
                // Half a unit of the last printed digit, and a rounding.
                let half_unit = 0.5 * 10_f64.powi(-(decimals as i32)) * (1.0 + 1e-9);
                if (here - value).abs() <= half_unit {
                    return "agrees to every digit".into();
                }
                match relative(here, value).abs() {
                    small if small < 1e-3 => format!("agrees within {}", percent(small)),
                    _ => format!("{}, unexplained", deviation(here, value)),
                }
            }
            Self::Below(bound) if here < bound => "holds".into(),
            Self::Below(bound) => format!("does not hold: {}", deviation(here, bound)),
            Self::About(value) if relative(here, value).abs() < 0.05 => {
                format!("agrees roughly: {}", deviation(here, value))
            }
            Self::About(value) => format!("{}, unexplained", deviation(here, value)),
        }
    }
}

fn relative(here: f64, reference: f64) -> f64 {
    (here - reference) / reference
}

fn percent(fraction: f64) -> String {
    format!("{} %", significant(100.0 * fraction, 2))
}

/// `1.3 % above` or `85 % below`.
fn deviation(here: f64, reference: f64) -> String {
    let relative = relative(here, reference);
    let side = if relative < 0.0 { "below" } else { "above" };
    format!("{} {side}", percent(relative.abs()))
}

struct Rows<'a> {
    scalars: &'a Scalars,
    table: Table,
}

impl Rows<'_> {
    /// A quantity that the paper gives.
    fn claimed(&mut self, quantity: &str, key: &str, unit: &str, claim: Claim) {
        let verdict = |here: f64| claim.verdict(here);
        self.row(quantity, claim.text(unit), key, unit, verdict);
    }

    /// A quantity that the paper does not give; `verdict` judges it.
    fn new_here(&mut self, quantity: &str, key: &str, unit: &str, verdict: impl Fn(f64) -> String) {
        self.row(quantity, "–".into(), key, unit, verdict);
    }

    fn row(&mut self, quantity: &str, paper: String, key: &str, unit: &str, verdict: impl Fn(f64) -> String) {
        let (here, verdict) = match self.scalars.get(key) {
            Some(Ok(here)) => {
                (format!("{} {unit}", significant(here, 5)).trim_end().to_owned(), verdict(here))
            }
            Some(Err(error)) => ("no result".into(), error.to_string()),
            None => ("not computed".into(), String::new()),
        };
        self.table.row([quantity, &paper, &here, &verdict]);
    }
}

/// The table of results: quantity, paper, here, verdict.
pub fn table(study: &Study, scalars: &Scalars) -> Table {
    let mut rows = Rows { scalars, table: Table::new(["quantity", "paper", "here", "verdict"]) };
    stability(&mut rows);
    gains(study, &mut rows);
    torques(&mut rows);
    beyond(&mut rows);
    rows.table
}

fn stability(rows: &mut Rows<'_>) {
    rows.claimed("Fig. 6: x₃ < 0 first, α = β = 0", "fig6.x3_zero_crossing_s", "s", Claim::Below(0.15));
    let sign = |theta2: f64| if theta2 > 0.0 { "agrees: it rises" } else { "does not hold: it falls" };
    rows.row("Fig. 4: θ₂ at 50 ms, α = β = 0", "> 0".into(), "fig4.theta2_at_50ms", "rad", |x| {
        sign(x).into()
    });
    rows.claimed("Fig. 8: max ‖Φ‖, α = β = 2000", "fig8.max_phi", "", Claim::Below(1.6e-6));
    rows.claimed("Fig. 10: max rel. error of x₃", "fig10.max_rel_x3", "", Claim::Below(6e-6));
}

fn gains(study: &Study, rows: &mut Rows<'_>) {
    let n = |key: &str| rows.scalars.number(key);
    let (corner, alpha_low, beta_low) =
        (n("fig11.beta2000.alpha2000"), n("fig11.beta2000.alpha200"), n("fig12.alpha2000.beta200"));
    let (by_alpha, by_beta) = (alpha_low / corner, beta_low / corner);
    rows.table.row([
        "Fig. 11: ‖Φ‖ falls from 200 to 2000",
        "α matters more",
        &format!("α: {}×, β: {}×", significant(by_alpha, 3), significant(by_beta, 3)),
        if by_alpha > by_beta { "agrees" } else { "does not hold" },
    ]);

    let least = |limit: f64| {
        let points = study.along_beta.iter().filter(|(beta, _)| *beta <= limit);
        let finite = points.filter_map(|(beta, phi)| Some((*beta, phi.ok()?)));
        let finite: Vec<_> = finite.collect();
        let least = finite.iter().map(|(_, phi)| *phi).fold(f64::INFINITY, f64::min);
        // The first of those that differ by rounding alone.
        finite.into_iter().find(|(_, phi)| *phi <= least * (1.0 + 1e-9)).unwrap_or((f64::NAN, f64::NAN))
    };
    let (within, beyond) = (least(2000.0), least(f64::INFINITY));
    let claim = Claim::Printed(2000.0, 0);
    rows.table.row([
        "Fig. 12: best β in 200…2000, α = 2000",
        &claim.text("1/s"),
        &format!("{} 1/s", significant(within.0, 5)),
        &claim.verdict(within.0),
    ]);
    rows.table.row([
        "the same, β not limited to 2000",
        "–",
        &format!("from {} 1/s on", significant(beyond.0, 4)),
        &format!("max ‖Φ‖ is {} that at {}", deviation(beyond.1, within.1), significant(within.0, 4)),
    ]);
    let limit = study.along_alpha.iter().find(|(_, phi)| phi.is_err()).map_or(f64::NAN, |(alpha, _)| *alpha);
    rows.table.row([
        "α above 2000, β = 2000",
        "rapid divergence",
        &format!(
            "2200: {}, fails from {}",
            significant(n("fig11.beta2000.alpha2200"), 3),
            significant(limit, 4)
        ),
        &format!(
            "‖Φ‖ grows {}× from 2000 to 2200; the theory's limit is 2500",
            significant(n("fig11.beta2000.alpha2200") / corner, 2)
        ),
    ]);
}

/// Table 3 as printed, in N·m.
const TABLE_3: [f64; 5] = [1.0232, 1.7969, 2.8819, 4.2790, 5.9892];

fn torques(rows: &mut Rows<'_>) {
    for (rpm, printed) in SPEEDS.iter().zip(TABLE_3) {
        let claim = Claim::Printed(printed, 4);
        rows.claimed(&format!("Table 3: peak torque, {rpm} rpm"), &format!("table3.{rpm}rpm"), "N·m", claim);
    }
    for (rpm, about) in [(100, 31.0), (300, 91.0)] {
        let (name, key) = (format!("Fig. 14: spike, {rpm} rpm"), format!("fig14.spike.t1.{rpm}rpm"));
        rows.claimed(&name, &key, "N·m", Claim::About(about));
    }
}

/// Rows of numbers that the paper does not have.
fn beyond(rows: &mut Rows<'_>) {
    let scalars = rows.scalars;
    let smaller = |key: &'static str| {
        move |here: f64| {
            format!("{}× smaller than from the paper's start", significant(scalars.number(key) / here, 3))
        }
    };
    rows.new_here("max ‖Φ‖, consistent start", "fig8.consistent.max_phi", "", smaller("fig8.max_phi"));
    rows.new_here(
        "max rel. error of x₃, consistent start",
        "fig10.consistent.max_rel_x3",
        "",
        smaller("fig10.max_rel_x3"),
    );
    let better = |here: f64| format!("{} β = 2000", deviation(here, scalars.number("fig8.max_phi")));
    rows.new_here("max ‖Φ‖, α = 2000, β = 2000√2", "deadbeat.per_stage.max_phi", "", better);

    let off =
        |key: String| move |here: f64| format!("{} the closed form", deviation(here, scalars.number(&key)));
    for rpm in [100, 300] {
        let exact = format!("torque.closed_form.ml2_3.{rpm}rpm");
        rows.new_here(&format!("Table 3's run, {rpm} rpm"), &format!("table3.{rpm}rpm"), "N·m", off(exact));
    }
    let exact = || "torque.closed_form.ml2_12.200rpm".to_owned();
    let raw = "torque.raw_per_stage.ml2_12.200rpm.a2000";
    rows.new_here("peak torque, J = m l²/12, both stages, 2000", raw, "N·m", off(exact()));
    for rpm in SPEEDS {
        let exact = format!("torque.closed_form.ml2_12.{rpm}rpm");
        let name = format!("clean peak torque, held, {rpm} rpm");
        rows.new_here(&name, &format!("torque.clean.ml2_12.{rpm}rpm"), "N·m", off(exact));
    }
}

/// The torque of each kind of feedback, beside the closed form.
pub fn feedbacks(study: &Study, scalars: &Scalars) -> Table {
    let mut table = Table::new(["feedback", "raw peak (N·m)", "clean peak (N·m)", "max ‖Φ‖", "max ‖Φ̇‖"]);
    let number = |key: String| match scalars.get(&key) {
        Some(Ok(value)) => significant(value, 6),
        _ => "no result".into(),
    };
    for run in &study.feedbacks {
        let key = |what: &str| format!("feedback.{}.{what}", run.key);
        let cells = ["raw_torque", "clean_torque", "max_phi", "max_phi_dot"].map(|what| number(key(what)));
        table.row([run.name.to_owned()].into_iter().chain(cells));
    }
    let exact = number("torque.closed_form.ml2_12.200rpm".into());
    table.row(["closed form", &exact, &exact, "0", "0"]);
    table
}

#[cfg(test)]
mod tests {
    use super::Claim;

    #[test]
    fn verdicts_follow_from_the_numbers() {
        let printed = Claim::Printed(5.9892, 4);
        assert_eq!(printed.verdict(5.98919), "agrees to every digit");
        assert_eq!(printed.verdict(5.9912), "agrees within 0.033 %");
        assert_eq!(Claim::Printed(1.0232, 4).verdict(1.0361), "1.3 % above, unexplained");
        assert_eq!(Claim::Below(1.6e-6).verdict(1.5e-6), "holds");
        assert_eq!(Claim::Below(1.6e-6).verdict(3.2e-6), "does not hold: 100 % above");
        assert_eq!(Claim::About(91.0).verdict(93.98), "agrees roughly: 3.3 % above");
        assert_eq!(Claim::About(91.0).verdict(47.0), "48 % below, unexplained");
    }
}
