//! A heat map on a canvas: cells, contour lines, colour bar.

use plotters::prelude::DrawingBackend;
use plotters::style::RGBColor;

use super::draw::{Canvas, Place, heading};
use super::layout::{Area, SCALE, Span, range};
use super::{HeatMap, colour_map, contour};

/// Colours are rounded to this many shades, so that neighbouring cells of one
/// shade become one rectangle.
const SHADES: f64 = 96.0;
const NO_VALUE: RGBColor = RGBColor(190, 190, 190);

fn value_range(map: &HeatMap) -> (f64, f64) {
    range(&map.scale, map.values.iter().copied(), false)
}

fn colour(map: &HeatMap, (low, high): (f64, f64), value: f64) -> RGBColor {
    let fraction = if map.scale.log {
        (value.ln() - low.ln()) / (high.ln() - low.ln())
    } else {
        (value - low) / (high - low)
    };
    if !fraction.is_finite() {
        return NO_VALUE;
    }
    let [r, g, b] = colour_map((fraction * SHADES).round() / SHADES);
    RGBColor(r, g, b)
}

/// The pixel at which cell `at` of an axis begins: half-way between grid
/// points, and the frame at both ends.
fn edge(points: &[f64], at: usize, span: &Span) -> i32 {
    let pixel = |i: usize| span.pixel(points[i.min(points.len() - 1)]);
    let at = match at {
        0 => pixel(0),
        at if at >= points.len() => pixel(points.len() - 1),
        at => 0.5 * (pixel(at - 1) + pixel(at)),
    };
    at.round() as i32
}

/// Cells, and contour lines over them.
pub(super) fn cells<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    map: &HeatMap,
    x: &Span,
    y: &Span,
    area: Area,
) -> Result<(), String> {
    let limits = value_range(map);
    for row in 0..map.y.len() {
        let (bottom, top) = (edge(&map.y, row, y), edge(&map.y, row + 1, y));
        let mut start = 0;
        for column in 1..=map.x.len() {
            let shade = |c: usize| colour(map, limits, map.value(c, row));
            if column < map.x.len() && shade(column) == shade(start) {
                continue;
            }
            let (left, right) = (edge(&map.x, start, x), edge(&map.x, column, x));
            canvas.fill(Area { left, top, right, bottom }, shade(start))?;
            start = column;
        }
    }
    let levels = Span::new(&map.scale, limits, area.bottom, area.top).ticks;
    // On a logarithmic scale three lines a decade, at 1, 2 and 5.
    let round = |level: &f64| {
        let mantissa = level / 10_f64.powf(level.log10().floor());
        [1.0, 2.0, 5.0, 10.0].iter().any(|m| (mantissa - m).abs() < 1e-6)
    };
    let minor = levels.minor.into_iter().filter(round);
    for level in levels.major.iter().map(|(at, _)| *at).chain(minor) {
        for [a, b] in contour::segments(map, level) {
            let pixel = |p: [f64; 2]| (x.pixel(p[0]).round() as i32, y.pixel(p[1]).round() as i32);
            canvas.line(vec![pixel(a), pixel(b)], RGBColor(255, 255, 255), 0.8)?;
        }
    }
    Ok(())
}

/// The colour bar right of the frame.
pub(super) fn bar<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    map: &HeatMap,
    area: Area,
) -> Result<(), String> {
    let limits = value_range(map);
    let left = area.right + 20 * SCALE;
    let bar = Area { left, right: left + 20 * SCALE, ..area };
    let span = Span::new(&map.scale, limits, bar.bottom, bar.top);
    let shades = SHADES as i32;
    for shade in 0..shades {
        let edge = |k: i32| bar.bottom + (bar.top - bar.bottom) * k / shades;
        let [r, g, b] = colour_map((f64::from(shade) + 0.5) / SHADES);
        canvas.fill(Area { top: edge(shade + 1), bottom: edge(shade), ..bar }, RGBColor(r, g, b))?;
    }
    canvas.frame(bar)?;
    for (at, label) in &span.ticks.major {
        let at = span.pixel(*at).round() as i32;
        canvas.line(vec![(bar.right, at), (bar.right + 4 * SCALE, at)], RGBColor(30, 30, 30), 1.0)?;
        canvas.text(label, (bar.right + 7 * SCALE, at), Place::Right, 13)?;
    }
    let middle = (bar.top + bar.bottom) / 2;
    canvas.text(&heading(&map.scale, &span), (bar.right + 56 * SCALE, middle), Place::Upwards, 15)
}
