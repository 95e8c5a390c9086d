//! `mbs bode`: how outputs answer to inputs that oscillate.

use std::f64::consts::TAU;
use std::path::PathBuf;

use clap::{ArgMatches, Command, value_parser};
use mbs_runtime::Dimension;

use super::operating;
use super::options::{self, option};
use super::responses::Bode;
use crate::app::Warnings;
use crate::figure::Figure;
use crate::models::Models;
use crate::{Error, quantity, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs bode spring-mass-damper --plot bode.svg
  mbs bode cart-pendulum --outputs theta --range 0.1Hz..20Hz --out response.csv
  mbs bode my.mbs --inputs force --parameters k --from x=10mm";

const RATE: Dimension = Dimension { mass: 0, length: 0, time: -1 };

pub(crate) fn command() -> Command {
    let file = |name: &'static str, value: &'static str, help: &'static str| {
        option(name, value, help).value_parser(value_parser!(PathBuf))
    };
    Command::new("bode")
        .about("Find magnitude and phase of the outputs about an operating point, over the frequency of the inputs")
        .after_help(EXAMPLES)
        .args(operating::of_a_point())
        .args(operating::of_ports())
        .arg(option(
            "range",
            "LOW..HIGH",
            "Frequencies in Hz, or with a unit: 0.1Hz..50Hz, 1rad/s..300rad/s [default: that of the modes]",
        ))
        .arg(file("plot", "FILE.svg|.png", "Draw magnitude and phase"))
        .arg(file("out", "FILE.csv", "Write magnitude and phase"))
}

pub(crate) fn run(models: &Models, matches: &ArgMatches) -> Result<Warnings, Error> {
    let found = operating::named(models, matches)?;
    let [plot, out] = ["plot", "out"].map(|name| matches.get_one::<PathBuf>(name));
    options::check_files([plot, out].into_iter().flatten().map(PathBuf::as_path))?;
    plot.map_or(Ok(()), |path| Figure::check_ending(path))?;
    let range = matches.get_one::<String>("range").map(|text| range(text)).transpose()?;
    let operating = operating::operating(found.name(), found.model(), matches)?;
    let linear = operating::linearized(&operating, matches)?;
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
    [plot, out]
        .into_iter()
        .flatten()
        .try_for_each(|path| say(format_args!("written: {}", path.display())))?;
    Ok(operating::warnings(&linear))
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
