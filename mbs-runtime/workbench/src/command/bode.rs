//! `mbs bode`: how outputs answer to inputs that oscillate.

use std::f64::consts::TAU;
use std::path::PathBuf;

use clap::Args;
use mbs_runtime::Dimension;

use super::operating::{self, Point, Ports};
use super::options;
use super::responses::Bode;
use crate::console::Warnings;
use crate::figure::Save;
use crate::models::Models;
use crate::{Error, quantity, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs bode spring-mass-damper --plot bode.svg
  mbs bode cart-pendulum --outputs theta --range 0.1Hz..20Hz --out response.csv
  mbs bode my.mbs --inputs force --parameters k --from x=10mm";

const RATE: Dimension = Dimension::of(0, 0, -1);

#[derive(Args)]
#[command(
    about = "Find magnitude and phase of the outputs about an operating point, over the frequency of the inputs",
    after_help = EXAMPLES,
    mut_args(options::signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    ports: Ports,
    /// Frequencies in Hz, or with a unit: 0.1Hz..50Hz, 1rad/s..300rad/s [default: that of the modes]
    #[arg(long, value_name = "LOW..HIGH")]
    range: Option<String>,
    /// Draw magnitude and phase
    #[arg(long, value_name = "FILE.svg|.png")]
    plot: Option<PathBuf>,
    /// Write magnitude and phase
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.point.find(models)?;
        let [plot, out] = [&self.plot, &self.out].map(Option::as_deref);
        options::check_files(None, &[plot], &[out])?;
        let range = self.range.as_ref().map(|text| range(text)).transpose()?;
        let operating = self.point.operating(&found)?;
        let linear = operating::linearized(&operating, &(&self.ports).into())?;
        if linear.inputs.is_empty() {
            let reason = "it has no inputs, so nothing can answer to them; declare one, such as `input force [N];`, or \
                          take parameters as inputs with --parameters";
            return Err(Error::Name { name: operating.name.to_owned(), reason: reason.into() });
        }
        let bode = Bode::of(operating.info(), &linear, range)?;
        if let Some(path) = plot {
            bode.figure(&format!("{}: frequency response", operating.name)).save(path)?;
        }
        if let Some(path) = out {
            write_csv(path, &bode.columns())?;
        }
        say(format_args!("about {}", operating::words(&operating)))?;
        say(bode.table(operating.name).to_string().trim_end())?;
        bode.remark().map_or(Ok(()), say)?;
        options::say_written([plot, out])?;
        Ok(operating::warnings(&linear))
    }
}

/// `LOW..HIGH` in Hz.
fn range(text: &str) -> Result<[f64; 2], Error> {
    let wrong = |reason: &str| Error::Value {
        what: "range".into(),
        text: text.into(),
        reason: format!("{reason}; write LOW..HIGH, for instance 0.1Hz..50Hz"),
    };
    let (low, high) = text.split_once("..").ok_or_else(|| wrong("that is not a range"))?;
    let [low, high] = [hertz(low)?, hertz(high)?];
    if !(low > 0.0 && low < high) {
        return Err(wrong("frequencies are above 0, and the first is smaller than the last"));
    }
    Ok([low, high])
}

/// A frequency in Hz: a bare number is one, and a rate of an angle is 2π of one.
fn hertz(text: &str) -> Result<f64, Error> {
    let text = text.trim();
    let value = quantity::parse("range", text, RATE)?;
    let is_hertz = text.ends_with("Hz") || text.parse::<f64>().is_ok();
    Ok(if is_hertz { value } else { value / TAU })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_in_hertz_and_in_radians() {
        assert_eq!(range("0.1..50 Hz").unwrap(), [0.1, 50.0]);
        assert_eq!(range("60rpm..600rpm").unwrap().map(|f| (f * 1e9).round() / 1e9), [1.0, 10.0]);
        assert_eq!(hertz("1rad/s").unwrap(), 1.0 / TAU);
        for (text, part) in
            [("0..5", "above 0"), ("5..1", "smaller"), ("3", "not a range"), ("1m..3m", "range")]
        {
            let message = range(text).unwrap_err().to_string();
            assert!(message.contains(part), "{message}");
        }
    }
}
