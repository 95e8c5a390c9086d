//! Where things are: rectangles, and data to pixels.

use super::{Axis, Content, Panel, ticks};
use crate::picture::Extent;
use ticks::Ticks;

/// Pixels per unit of length of the description: both SVG and PNG are drawn
/// this much larger, which gives the SVG (whose coordinates the drawing
/// library rounds) sub-pixel positions and the PNG its smooth edges.
pub(super) const SCALE: i32 = 4;

/// A rectangle in drawn pixels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

impl Area {
    /// True if a point lies inside; one that is not finite does not.
    pub(super) fn contains(self, x: f64, y: f64) -> bool {
        // The frame itself counts, to rounding.
        let within =
            |low: i32, value: f64, high: i32| f64::from(low) - 0.5 <= value && value <= f64::from(high) + 0.5;
        within(self.left, x, self.right) && within(self.top, y, self.bottom)
    }
}

/// One axis in pixels: its range, and where that lies.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Span {
    low: f64,
    high: f64,
    log: bool,
    from: f64,
    to: f64,
    pub(super) ticks: Ticks,
}

impl Span {
    /// An axis from pixel `from` to pixel `to` showing `low … high`.
    pub(super) fn new(axis: &Axis, (low, high): (f64, f64), from: i32, to: i32) -> Self {
        let length = f64::from((to - from).abs() / SCALE);
        let spacing = if from < to { 90.0 } else { 42.0 };
        let ticks = if axis.log {
            ticks::logarithmic(low, high)
        } else {
            let count = (length / spacing) as usize;
            axis.unit_tick.map_or_else(
                || ticks::linear(low, high, count),
                |unit| ticks::multiples(low, high, count, unit),
            )
        };
        Self { low, high, log: axis.log, from: f64::from(from), to: f64::from(to), ticks }
    }

    /// The pixel of a value; not finite where the value has none.
    pub(super) fn pixel(&self, value: f64) -> f64 {
        let fraction = if self.log {
            (value.ln() - self.low.ln()) / (self.high.ln() - self.low.ln())
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.from + fraction * (self.to - self.from)
    }
}

/// The range that an axis shows: what it prescribes, else that of the values,
/// on a linear axis with a little air if `air` is wanted.
pub(super) fn range(axis: &Axis, values: impl Iterator<Item = f64>, air: bool) -> (f64, f64) {
    if let Some(range) = axis.range {
        return range;
    }
    let shown = values.filter(|v| v.is_finite() && (!axis.log || *v > 0.0));
    let (low, high) = shown.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
    if low > high {
        return if axis.log { (0.1, 1.0) } else { (0.0, 1.0) };
    }
    if axis.log {
        let factor = if air { 1.25 } else { 1.0 };
        return if low < high { (low / factor, high * factor) } else { (low / 2.0, high * 2.0) };
    }
    let largest = high.abs().max(low.abs());
    // Values that are 0 throughout have no scale of their own.
    if air && largest == 0.0 {
        return (0.0, 1.0);
    }
    // A constant needs some height, however small it is.
    let flat = high - low <= 1e-12 * largest;
    let span = if flat { largest } else { high - low };
    let margin = if air { 0.05 * span } else { 0.0 };
    let low_margin = if low >= 0.0 && low < margin { low } else { margin };
    let (low, high) = (low - low_margin, high + margin);
    if high > low { (low, high) } else { (low - 0.5, high + 0.5) }
}

/// Ranges around the same middle that give both axes the scale of the one that
/// needs more room.
pub(super) fn with_equal_scales(ranges: ((f64, f64), (f64, f64)), area: Area) -> ((f64, f64), (f64, f64)) {
    let [(x0, x1), (y0, y1)] = [ranges.0, ranges.1];
    let (width, height) = (f64::from(area.right - area.left), f64::from(area.bottom - area.top));
    let half_pixel = 0.5 * ((x1 - x0) / width).max((y1 - y0) / height);
    let around = |low: f64, high: f64, pixels: f64| {
        let middle = 0.5 * (low + high);
        (middle - half_pixel * pixels, middle + half_pixel * pixels)
    };
    (around(x0, x1, width), around(y0, y1, height))
}

/// The ranges of both axes of a panel.
pub(super) fn ranges(panel: &Panel) -> ((f64, f64), (f64, f64)) {
    match &panel.content {
        Content::Map(map) => {
            (range(&panel.x, map.x.iter().copied(), false), range(&panel.y, map.y.iter().copied(), false))
        }
        Content::Lines(series) => {
            let points = || series.iter().flat_map(|s| s.points.iter());
            let x = range(&panel.x, points().map(|p| p[0]), false);
            let visible = points().filter(|p| p[0] >= x.0 && p[0] <= x.1).map(|p| p[1]);
            (x, range(&panel.y, visible, true))
        }
        Content::Mechanism(picture) => {
            let Extent { low, high } = picture.extent();
            ((low[0], high[0]), (low[1], high[1]))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reduced states have no violation, which was drawn on an axis up to 5·10⁻³⁰².
    #[test]
    fn what_is_0_throughout_is_drawn_from_0_to_1() {
        let of = |values: &[f64]| range(&Axis::new("violation", "1"), values.iter().copied(), true);
        assert_eq!(of(&[0.0, 0.0]), (0.0, 1.0));
        let (low, high) = of(&[2e-300, 2e-300]);
        assert!(low < 2e-300 && high > 2e-300 && high < 3e-300);
    }
}
