//! ns per step against the number of links, as a picture.

use std::path::Path;

use mbs_workbench::figure::{Axis, Figure, Panel, Save, Series, Stroke};

use crate::kernels::{Chain, Code, Kernel};
use crate::timing::Time;

/// Draws the least times to a file, `.svg` or `.png`.
pub fn save(kernels: &[Kernel], times: &[Time], file: &Path) -> Result<(), mbs_workbench::Error> {
    let series = |name: &str, chain: Chain, code: Code| {
        let of_it = kernels.iter().zip(times).filter(|(k, _)| k.chain == chain && k.code == code);
        Series::new(name, of_it.map(|(kernel, time)| [kernel.n as f64, time.least / 1000.0]))
    };
    let curves = [
        series("N four-bars", Chain::FourBar, Code::Generated).stroke(Stroke::Dotted),
        series("N-pendulum", Chain::Pendulum, Code::Generated).stroke(Stroke::Dotted),
        series("N-pendulum by hand", Chain::Pendulum, Code::ByHand).stroke(Stroke::Dashed),
    ];
    let (n, step) = (Axis::new("N", "").log(), Axis::new("Heun step", "µs").log());
    Figure::new("A step against the length of a chain").panel(Panel::lines(n, step, curves)).save(file)
}
