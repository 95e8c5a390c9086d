//! A figure on a canvas: title, frames, ticks, legends, curves.

use plotters::prelude::{DrawingArea, DrawingBackend};
use plotters::style::RGBColor;

use super::canvas::{Canvas, Drawn, INK, Place};
use super::layout::{Area, SCALE, Span, ranges, with_equal_scales};
use super::{Axis, Content, Figure, Panel, Series, Stroke, colour, lines, map, mechanism};
use crate::picture::Picture;
use mbs_words::number::superscript;

pub(super) const WIDTH: i32 = 900;
const TITLE: i32 = 44;
const LEGEND_ROW: i32 = 24;
/// Around the frame of a panel: left, right, top, bottom.
const MARGINS: (i32, i32, i32, i32) = (84, 28, 20, 62);
/// The right margin where a colour bar stands in it.
const BAR_MARGIN: i32 = 140;

const GRID: RGBColor = RGBColor(222, 222, 222);
const TEXT: i32 = 16;
/// Width of a curve.
const CURVE: f64 = 2.0;

/// Height of a figure in pixels of the description.
pub(super) fn height(figure: &Figure) -> i32 {
    TITLE + figure.panels.len() as i32 * figure.panel_height as i32
}

impl Figure {
    /// A figure of one mechanism, as high as its shape asks for.
    pub fn mechanism(title: impl Into<String>, picture: Picture) -> Self {
        let height = mechanism_height(&picture);
        Self::new(title).panel(Panel::mechanism(picture)).panel_height(height)
    }
}

/// The height of a panel in which a mechanism fills the width, within bounds.
fn mechanism_height(picture: &Picture) -> u32 {
    let (left, right, above, below) = MARGINS;
    let [width, height] = picture.extent().size();
    let drawn = f64::from(WIDTH - left - right) * height / width;
    (drawn.clamp(240.0, 640.0) as i32 + above + below).unsigned_abs()
}

/// Draws the whole figure.
pub(super) fn figure<B: DrawingBackend>(
    surface: &DrawingArea<B, plotters::coord::Shift>,
    figure: &Figure,
    lowered: f64,
) -> Drawn {
    surface.fill(&plotters::style::WHITE).map_err(|e| e.to_string())?;
    let canvas = Canvas { surface, lowered };
    canvas.text(&figure.title, (SCALE * WIDTH / 2, SCALE * 14), Place::Below, 19)?;
    for (at, shown) in figure.panels.iter().enumerate() {
        let top = TITLE + at as i32 * figure.panel_height as i32;
        panel(&canvas, shown, top, top + figure.panel_height as i32)?;
    }
    Ok(())
}

fn panel<B: DrawingBackend>(canvas: &Canvas<'_, B>, panel: &Panel, top: i32, bottom: i32) -> Drawn {
    let (left, mut right, above, below) = MARGINS;
    let mut legend_height = 0;
    match &panel.content {
        Content::Map(_) => right = BAR_MARGIN,
        Content::Mechanism(_) => {}
        Content::Lines(series) => {
            let named: Vec<_> = series.iter().enumerate().filter(|(_, s)| !s.name.is_empty()).collect();
            legend_height = LEGEND_ROW * legend(canvas, &named, SCALE * left, SCALE * (top + 8))?;
        }
    }
    let area = Area {
        left: SCALE * left,
        top: SCALE * (top + above + legend_height),
        right: SCALE * (WIDTH - right),
        bottom: SCALE * (bottom - below),
    };
    let (x_range, y_range) = match &panel.content {
        Content::Mechanism(_) => with_equal_scales(ranges(panel), area),
        _ => ranges(panel),
    };
    let x = Span::new(&panel.x, x_range, area.left, area.right);
    let y = Span::new(&panel.y, y_range, area.bottom, area.top);
    if let Content::Map(heat) = &panel.content {
        map::cells(canvas, heat, &x, &y, area)?;
        map::bar(canvas, heat, area)?;
    } else {
        grid(canvas, &x, &y, area)?;
    }
    if let Content::Mechanism(picture) = &panel.content {
        mechanism::draw(canvas, picture, (&x, &y), area)?;
    }
    if let Content::Lines(series) = &panel.content {
        for (at, shown) in series.iter().enumerate() {
            curve(canvas, shown, colour::series(at), (&x, &y), area)?;
        }
    }
    axes(canvas, panel, (&x, &y), area)
}

/// The legend over a panel, wrapped into rows; gives the number of rows.
fn legend<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    series: &[(usize, &Series)],
    left: i32,
    top: i32,
) -> Result<i32, String> {
    const SAMPLE: i32 = 30 * SCALE;
    let (mut x, mut row) = (left, 0);
    for (at, shown) in series {
        let width = SAMPLE + 8 * SCALE + canvas.text_width(&shown.name, TEXT - 1);
        if x > left && x + width > SCALE * (WIDTH - 20) {
            (x, row) = (left, row + 1);
        }
        let y = top + SCALE * (LEGEND_ROW * row + LEGEND_ROW / 2);
        let ends = [(f64::from(x), f64::from(y)), (f64::from(x + SAMPLE), f64::from(y))];
        for stroke in lines::stroked(&ends, shown.stroke) {
            canvas.line(stroke, colour::series(*at), 2.2)?;
        }
        if let Some(radius) = dots(shown.stroke) {
            canvas.dot((x + SAMPLE / 2, y), radius, colour::series(*at))?;
        }
        canvas.text(&shown.name, (x + SAMPLE + 8 * SCALE, y), Place::Right, TEXT - 1)?;
        x += width + 22 * SCALE;
    }
    Ok(if series.is_empty() { 0 } else { row + 1 })
}

fn grid<B: DrawingBackend>(canvas: &Canvas<'_, B>, x: &Span, y: &Span, area: Area) -> Drawn {
    for (at, _) in &x.ticks.major {
        let at = x.pixel(*at).round() as i32;
        canvas.line(vec![(at, area.top), (at, area.bottom)], GRID, 0.8)?;
    }
    for (at, _) in &y.ticks.major {
        let at = y.pixel(*at).round() as i32;
        canvas.line(vec![(area.left, at), (area.right, at)], GRID, 0.8)?;
    }
    Ok(())
}

/// The radius of the dots at the points of a curve that has such.
const fn dots(stroke: Stroke) -> Option<f64> {
    match stroke {
        Stroke::Solid | Stroke::Dashed => None,
        Stroke::Dotted => Some(3.2),
        Stroke::Points => Some(2.0),
    }
}

fn curve<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    series: &Series,
    colour: RGBColor,
    (x, y): (&Span, &Span),
    area: Area,
) -> Drawn {
    for piece in lines::pieces(&series.points, x, y, area) {
        for stroke in lines::stroked(&piece, series.stroke) {
            let (parts, corners) = lines::cut_at_corners(&stroke);
            for part in parts {
                canvas.line(part, colour, CURVE)?;
            }
            for corner in corners {
                canvas.dot(corner, 0.5 * CURVE, colour)?;
            }
        }
    }
    let Some(radius) = dots(series.stroke) else { return Ok(()) };
    for point in &series.points {
        let (px, py) = (x.pixel(point[0]), y.pixel(point[1]));
        if area.contains(px, py) {
            canvas.dot((px.round() as i32, py.round() as i32), radius, colour)?;
        }
    }
    Ok(())
}

/// Frame, ticks, their labels and the axes' headings.
fn axes<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    panel: &Panel,
    (x, y): (&Span, &Span),
    area: Area,
) -> Drawn {
    const TICK: i32 = 5 * SCALE;
    const MARK: i32 = 9 * SCALE;
    canvas.frame(area)?;
    let marks = panel.marks.iter().map(|mark| x.pixel(*mark));
    let mut marks: Vec<i32> =
        marks.filter(|at| area.contains(*at, f64::from(area.top))).map(|at| at.round() as i32).collect();
    marks.sort_unstable();
    marks.dedup();
    for at in marks {
        canvas.line(vec![(at, area.top), (at, area.top + MARK)], INK, 1.4)?;
    }
    for (at, label) in &x.ticks.major {
        let at = x.pixel(*at).round() as i32;
        canvas.line(vec![(at, area.bottom), (at, area.bottom + TICK)], INK, 1.0)?;
        canvas.text(label, (at, area.bottom + TICK + 4 * SCALE), Place::Below, TEXT - 1)?;
    }
    for (at, label) in &y.ticks.major {
        let at = y.pixel(*at).round() as i32;
        canvas.line(vec![(area.left - TICK, at), (area.left, at)], INK, 1.0)?;
        canvas.text(label, (area.left - TICK - 4 * SCALE, at), Place::Left, TEXT - 1)?;
    }
    for at in &x.ticks.minor {
        let at = x.pixel(*at).round() as i32;
        canvas.line(vec![(at, area.bottom), (at, area.bottom + TICK / 2)], INK, 0.7)?;
    }
    for at in &y.ticks.minor {
        let at = y.pixel(*at).round() as i32;
        canvas.line(vec![(area.left - TICK / 2, at), (area.left, at)], INK, 0.7)?;
    }
    let middle = ((area.left + area.right) / 2, (area.top + area.bottom) / 2);
    canvas.text(&heading(&panel.x, x), (middle.0, area.bottom + 32 * SCALE), Place::Below, TEXT)?;
    // Beside the longest number, which may be longer than the margin foresees.
    let widths = y.ticks.major.iter().map(|(_, label)| canvas.text_width(label, TEXT - 1));
    let beside = area.left - widths.max().unwrap_or(0) - (13 + TEXT) * SCALE;
    let x_of_label = beside.min(area.left - (MARGINS.0 - 10) * SCALE).max(0);
    canvas.text(&heading(&panel.y, y), (x_of_label, middle.1), Place::Upwards, TEXT)
}

/// The heading of an axis with the power of ten taken out of its labels.
pub(super) fn heading(axis: &Axis, span: &Span) -> String {
    match (span.ticks.exponent, axis.unit.is_empty()) {
        (0, _) => axis.heading(),
        (e, true) => format!("{} (10{})", axis.label, superscript(e)),
        (e, false) => format!("{} (10{} {})", axis.label, superscript(e), axis.unit),
    }
}
