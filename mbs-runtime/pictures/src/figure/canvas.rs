//! A surface to draw on.

use plotters::prelude::{DrawingArea, DrawingBackend, IntoFont, PathElement, Rectangle, Text};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{Color, FontTransform, RGBColor, ShapeStyle, TextStyle};

use super::layout::{Area, SCALE};

/// The colour of lines and letters.
pub(super) const INK: RGBColor = RGBColor(30, 30, 30);

/// How a text is placed relative to its point.
#[derive(Clone, Copy, Debug)]
pub(super) enum Place {
    Left,
    Right,
    Below,
    /// Centred on the point and read from below.
    Upwards,
}

/// A surface to draw on, in drawn pixels.
pub(super) struct Canvas<'a, B: DrawingBackend> {
    pub(super) surface: &'a DrawingArea<B, plotters::coord::Shift>,
    /// By how much of their size vertically centred texts have to be lowered.
    pub(super) lowered: f64,
}

pub(super) type Drawn = Result<(), String>;

impl<B: DrawingBackend> Canvas<'_, B> {
    pub(super) fn line(&self, points: Vec<(i32, i32)>, colour: RGBColor, width: f64) -> Drawn {
        let style = ShapeStyle::from(colour).stroke_width((width * f64::from(SCALE)).round() as u32);
        self.surface.draw(&PathElement::new(points, style)).map_err(|e| e.to_string())
    }

    pub(super) fn fill(&self, area: Area, colour: RGBColor) -> Drawn {
        let corners = [(area.left, area.top), (area.right, area.bottom)];
        self.surface.draw(&Rectangle::new(corners, colour.filled())).map_err(|e| e.to_string())
    }

    pub(super) fn polygon(&self, corners: Vec<(i32, i32)>, colour: RGBColor) -> Drawn {
        let polygon = plotters::element::Polygon::new(corners, colour.filled());
        self.surface.draw(&polygon).map_err(|e| e.to_string())
    }

    pub(super) fn dot(&self, at: (i32, i32), radius: f64, colour: RGBColor) -> Drawn {
        let radius = (radius * f64::from(SCALE)) as i32;
        let dot = plotters::element::Circle::new(at, radius, colour.filled());
        self.surface.draw(&dot).map_err(|e| e.to_string())
    }

    pub(super) fn text(&self, text: &str, at: (i32, i32), place: Place, size: i32) -> Drawn {
        self.coloured_text(text, at, place, size, INK)
    }

    pub(super) fn coloured_text(
        &self,
        text: &str,
        at: (i32, i32),
        place: Place,
        size: i32,
        colour: RGBColor,
    ) -> Drawn {
        let sideways = matches!(place, Place::Left | Place::Right);
        let drop = if sideways { (self.lowered * f64::from(size * SCALE)) as i32 } else { 0 };
        let at = (at.0, at.1 + drop);
        let (h, v) = match place {
            Place::Left => (HPos::Right, VPos::Center),
            Place::Right => (HPos::Left, VPos::Center),

            Place::Below | Place::Upwards => (HPos::Center, VPos::Top),
        };
        let mut font = ("sans-serif", f64::from(size * SCALE)).into_font();
        if let Place::Upwards = place {
            font = font.transform(FontTransform::Rotate270);
        }
        let style = TextStyle::from(font).color(&colour).pos(Pos::new(h, v));
        self.surface.draw(&Text::new(text.to_owned(), at, style)).map_err(|e| e.to_string())
    }

    pub(super) fn text_width(&self, text: &str, size: i32) -> i32 {
        let style = TextStyle::from(("sans-serif", f64::from(size * SCALE)).into_font());
        self.surface.estimate_text_size(text, &style).map_or(0, |(width, _)| width as i32)
    }

    pub(super) fn frame(&self, area: Area) -> Drawn {
        let Area { left, top, right, bottom } = area;
        let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
        self.line(corners, INK, 1.0)
    }
}
