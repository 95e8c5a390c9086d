//! A heat map on a canvas: cells, contour lines, colour bar.

use plotters::prelude::DrawingBackend;
use plotters::style::RGBColor;

use super::canvas::{Canvas, INK, Place};
use super::draw::heading;
use super::layout::{Area, SCALE, Span, range};
use super::{HeatMap, colour_map, contour};

/// Colours are rounded to this many shades, so that neighbouring cells of one
/// shade become one rectangle.
const SHADES: f64 = 96.0;
const WHITE: RGBColor = RGBColor(255, 255, 255);
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
    let minor = levels.minor.into_iter().filter(round).map(|level| (level, String::new()));
    let mut numbers = Vec::new();
    for (level, text) in levels.major.into_iter().chain(minor) {
        let pixel = |p: [f64; 2]| (x.pixel(p[0]).round() as i32, y.pixel(p[1]).round() as i32);
        let line: Vec<_> = contour::segments(map, level).into_iter().map(|ends| ends.map(pixel)).collect();
        for ends in &line {
            canvas.line(ends.to_vec(), WHITE, 0.8)?;
        }
        if !text.is_empty()
            && let Some(at) = place_of_number(&line, &numbers, area)
        {
            numbers.push((at, level, text));
        }
    }
    for ((x, y), level, text) in numbers {
        let (half_width, half_height) =
            (canvas.text_width(&text, NUMBER) / 2 + 4 * SCALE, NUMBER * SCALE * 5 / 8);
        let behind = Area {
            left: x - half_width,
            right: x + half_width,
            top: y - half_height,
            bottom: y + half_height,
        };
        let shade = colour(map, limits, level);
        canvas.fill(behind, shade)?;
        let is_dark = u32::from(shade.0) * 3 + u32::from(shade.1) * 6 + u32::from(shade.2) < 1300;
        let ink = if is_dark { WHITE } else { INK };
        canvas.coloured_text(&text, (x - half_width + 4 * SCALE, y), Place::Right, NUMBER, ink)?;
    }
    Ok(())
}

/// Size of the numbers on contour lines.
const NUMBER: i32 = 12;

type Pixel = (i32, i32);

/// Where on a line its number stands: as far from the frame and from other numbers as the
/// line allows, or nowhere if that is too near.
fn place_of_number(line: &[[Pixel; 2]], taken: &[(Pixel, f64, String)], area: Area) -> Option<Pixel> {
    const LEAST: i32 = 26 * SCALE;
    let middle = |[a, b]: &[Pixel; 2]| ((a.0 + b.0) / 2, (a.1 + b.1) / 2);
    let clearance = |(x, y): Pixel| {
        let sides = [x - area.left, area.right - x, y - area.top, area.bottom - y];
        // Numbers are wider than they are high.
        let others = taken.iter().map(|((u, v), ..)| ((x - u).abs() / 2).max((y - v).abs()));
        sides.into_iter().chain(others).min().unwrap_or(0).min(4 * LEAST)
    };
    let best = line.iter().map(middle).max_by_key(|at| clearance(*at))?;
    (clearance(best) > LEAST).then_some(best)
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
    // Beside the longest number.
    let widths = span.ticks.major.iter().map(|(_, label)| canvas.text_width(label, 13));
    let heading_at = bar.right + widths.max().unwrap_or(0).max(36 * SCALE) + 14 * SCALE;
    canvas.text(&heading(&map.scale, &span), (heading_at, middle), Place::Upwards, 15)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_on_lines_keep_apart() {
        let area = Area { left: 0, top: 0, right: 4000, bottom: 2000 };
        let line = |y: i32| (0..40).map(|k| [(100 * k, y), (100 * (k + 1), y)]).collect::<Vec<_>>();
        let first = place_of_number(&line(1000), &[], area).unwrap();
        let taken = [(first, 1.0, "1".to_owned())];
        let second = place_of_number(&line(1010), &taken, area).unwrap();
        assert!((first.0 - second.0).abs() > 8 * NUMBER * SCALE, "{first:?} {second:?}");
        assert_eq!(place_of_number(&line(10), &[], area), None);
        assert_eq!(place_of_number(&[], &[], area), None);
    }
}
