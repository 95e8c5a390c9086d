//! `mbs linearize`: the linear system of small motions.

use std::path::{Path, PathBuf};

use clap::Args;
use mbs_analysis::nalgebra::DMatrix;
use mbs_analysis::{Linearization, Signal};
use mbs_runtime::Info;
use serde_json::{Value, json};

use super::json::number;
use super::operating::{self, Point, Ports};
use super::options;
use super::responses::Steps;
use crate::console::Warnings;
use crate::figure::Save;
use crate::models::Models;
use crate::npz::{Array, npz};
use crate::number::significant;
use crate::quantity::{self, TIME};
use crate::{Error, Operating, Table, Unit, files, say, write_csv};

const EXAMPLES: &str = "\
Examples:
  mbs linearize cart-pendulum
  mbs linearize spring-mass-damper --out system.npz --step-response step.svg
  mbs linearize my.mbs --inputs force --outputs 'x*,der(x1)' --parameters k --after 0.2s --json

Matrices are in SI units and rad. Files end in .json or .npz (NumPy); step responses in .svg, .png or .csv.";

/// Matrices with more columns are not printed.
const MOST_COLUMNS: usize = 12;

#[derive(Args)]
#[command(
    about = "Find the linear system of small motions, A, B, C and D, about an equilibrium or any state",
    after_help = EXAMPLES,
    mut_args(options::signed),
)]
pub(crate) struct Arguments {
    #[command(flatten)]
    point: Point,
    #[command(flatten)]
    ports: Ports,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
    /// Write the matrices with their names and units
    #[arg(long, value_name = "FILE.json|.npz")]
    out: Option<PathBuf>,
    /// Draw or write the responses to a unit step of each input
    #[arg(long, value_name = "FILE.svg|.png|.csv")]
    step_response: Option<PathBuf>,
    /// Until when [default: as long as the modes take]
    #[arg(long, value_name = "TIME")]
    end: Option<String>,
}

impl Arguments {
    pub fn run(&self, models: &Models) -> Result<Warnings, Error> {
        let found = self.point.find(models)?;
        let [out, step] = [&self.out, &self.step_response].map(Option::as_deref);
        out.map_or(Ok(()), check_out)?;
        let (table, picture) =
            if step.is_some_and(|path| is(path, "csv")) { (step, None) } else { (None, step) };
        options::check_files(None, &[picture], &[out, table])?;
        let end = self.end.as_ref().map(|text| quantity::parse("end", text, TIME)).transpose()?;

        let operating = self.point.operating(&found)?;
        let linear = operating::linearized(&operating, &(&self.ports).into())?;
        let shown = Shown { operating: &operating, linear: &linear, info: operating.info() };
        if let Some(path) = out {
            shown.write(path)?;
        }
        if let Some(path) = step {
            let steps = Steps::of(shown.info, &linear, end)?;
            if is(path, "csv") {
                write_csv(path, &steps.columns())?;
            } else {
                steps.figure(&format!("{}: response to unit steps", operating.name)).save(path)?;
            }
        }
        if self.json {
            say(shown.json())?;
        } else {
            shown.tables().iter().try_for_each(say)?;
            options::say_written([out, step])?;
        }
        Ok(operating::warnings(&linear))
    }
}

fn is(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}

fn check_out(path: &Path) -> Result<(), Error> {
    if is(path, "json") || is(path, "npz") {
        return Ok(());
    }
    let reason = "a linear system is written to a file that ends in .json or .npz".into();
    Err(Error::Name { name: path.display().to_string(), reason })
}

struct Shown<'a> {
    operating: &'a Operating<'a>,
    linear: &'a Linearization,
    info: &'static Info,
}

impl Shown<'_> {
    /// The values at the operating point of states, inputs and outputs.
    fn values(&self) -> [Vec<f64>; 3] {
        let mut parameters = vec![0.0; self.info.parameters.len()];
        self.operating.run.parameters(&mut parameters);
        let value = |signal: &Signal| self.linear.point.value(signal.variable, &parameters);
        let of = |list: &[Signal]| list.iter().map(value).collect();
        [of(&self.linear.states), of(&self.linear.inputs), self.linear.values.as_slice().to_vec()]
    }

    fn tables(&self) -> Vec<String> {
        let linear = self.linear;
        let mut table = Table::new([self.operating.name, "", "", ""]);
        table.row(["about", &operating::words(self.operating)]);
        let [x, u, y] = self.values();
        for (kind, list, values) in
            [("state", &linear.states, x), ("input", &linear.inputs, u), ("output", &linear.outputs, y)]
        {
            for (signal, value) in list.iter().zip(values) {
                let unit = Unit::of_signal(self.info, signal);
                let value = if value.abs() < 1e-13 { 0.0 } else { value };
                table.row([kind, &signal.name, &significant(unit.shown(value), 8), unit.name()]);
            }
        }
        let mut texts = vec![table.to_string()];
        let rate = linear.rate.amax();
        if self.operating.rest.is_none() && rate > 1e-9 {
            texts.push(format!(
                "Not in equilibrium: deviations from the motion through this point, dx/dt = f + A x + B u with f = {}\n",
                self.numbers(linear.rate.iter()).join(", ")
            ));
        }
        let wide = linear.states.len().max(linear.inputs.len());
        if wide > MOST_COLUMNS {
            texts.push(format!(
                "A has {} rows and columns: --json or --out gives the matrices",
                linear.a.nrows()
            ));
            return texts;
        }
        let columns = [&linear.states, &linear.inputs];
        for (name, matrix, rows, columns) in [
            ("A", &linear.a, &linear.states, columns[0]),
            ("B", &linear.b, &linear.states, columns[1]),
            ("C", &linear.c, &linear.outputs, columns[0]),
            ("D", &linear.d, &linear.outputs, columns[1]),
        ] {
            if matrix.is_empty() {
                continue;
            }
            let headings =
                std::iter::once(format!("{name} (SI, rad)")).chain(columns.iter().map(|x| x.name.clone()));
            let mut table = Table::new(headings);
            for (at, row) in rows.iter().enumerate() {
                // the rows of A and B give rates
                let label =
                    if matches!(name, "A" | "B") { format!("d/dt {}", row.name) } else { row.name.clone() };
                table.row(std::iter::once(label).chain(self.numbers(matrix.row(at).iter())));
            }
            texts.push(table.to_string());
        }
        texts.iter().map(|text| text.trim_end().to_owned() + "\n").collect()
    }

    /// Numbers with the digits that are known, and 0 for what is rounding of the others.
    fn numbers<'n>(&self, list: impl Iterator<Item = &'n f64> + Clone) -> Vec<String> {
        let largest = list.clone().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let small = 1e-12_f64.max(self.linear.uncertainty) * largest;
        list.map(|x| significant(if x.abs() <= small { 0.0 } else { *x }, 7)).collect()
    }

    fn json(&self) -> Value {
        let [x, u, y] = self.values();
        let list = |signals: &[Signal], values: &[f64]| -> Vec<Value> {
            let signal = |(signal, value): (&Signal, &f64)| json!({ "name": signal.name, "unit": self.si(signal), "value": number(*value) });
            signals.iter().zip(values).map(signal).collect()
        };
        let matrix = |of: &DMatrix<f64>| -> Vec<Vec<Value>> {
            of.row_iter().map(|row| row.iter().map(|x| number(*x)).collect()).collect()
        };
        let linear = self.linear;
        json!({
            "mechanism": self.operating.name,
            "about": operating::words(self.operating),
            "t_s": number(linear.point.t),
            "states": list(&linear.states, &x),
            "inputs": list(&linear.inputs, &u),
            "outputs": list(&linear.outputs, &y),
            "A": matrix(&linear.a), "B": matrix(&linear.b), "C": matrix(&linear.c), "D": matrix(&linear.d),
            "rate": linear.rate.iter().map(|x| number(*x)).collect::<Vec<_>>(),
            "uncertainty": number(linear.uncertainty),
        })
    }

    /// The SI unit of a signal; rad for an angle.
    fn si(&self, signal: &Signal) -> String {
        let shown = Unit::of_signal(self.info, signal);
        let si = Unit::si(signal.dimension);
        if shown.read(1.0) == 1.0 { shown.name().to_owned() } else { si.name().to_owned() }
    }

    fn write(&self, path: &Path) -> Result<(), Error> {
        if is(path, "json") {
            return files::write(path, format!("{:#}\n", self.json()).as_bytes());
        }
        let linear = self.linear;
        let matrix = |of: &DMatrix<f64>| Array::Matrix {
            rows: of.nrows(),
            columns: of.ncols(),
            values: of.transpose().as_slice().to_vec(),
        };
        let names = |list: &[Signal]| Array::Texts(list.iter().map(|signal| signal.name.clone()).collect());
        let units = |list: &[Signal]| Array::Texts(list.iter().map(|signal| self.si(signal)).collect());
        let [x, u, y] = self.values();
        let bytes = npz(&[
            ("A", matrix(&linear.a)),
            ("B", matrix(&linear.b)),
            ("C", matrix(&linear.c)),
            ("D", matrix(&linear.d)),
            ("x0", Array::Vector(x)),
            ("u0", Array::Vector(u)),
            ("y0", Array::Vector(y)),
            ("rate", Array::Vector(linear.rate.as_slice().to_vec())),
            ("states", names(&linear.states)),
            ("inputs", names(&linear.inputs)),
            ("outputs", names(&linear.outputs)),
            ("state_units", units(&linear.states)),
            ("input_units", units(&linear.inputs)),
            ("output_units", units(&linear.outputs)),
        ]);
        files::write(path, &bytes.map_err(Error::file("write", path))?)
    }
}
