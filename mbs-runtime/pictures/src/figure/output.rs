//! Figures as SVG and PNG files.

use std::path::Path;
use std::sync::OnceLock;

use plotters::prelude::{BitMapBackend, IntoDrawingArea, SVGBackend};
use plotters::style::{FontStyle, register_font};

use super::layout::SCALE;
use super::{Figure, draw};
use crate::Error;

/// DejaVu Sans, reduced to Latin, Greek and mathematical signs; its licence
/// stands beside it.
static FONT: &[u8] = include_bytes!("../../assets/dejavu/DejaVuSans-subset.ttf");

/// Drawn pixels per pixel of a PNG, in each direction.
pub(super) const OVERSAMPLING: usize = 2;

/// The bitmap backend centres the box of a text, which holds more above its
/// digits than below: by this part of its size they come out too high.
const LOWERED: f64 = 0.12;

pub(super) fn with_font() -> Result<(), String> {
    static REGISTERED: OnceLock<bool> = OnceLock::new();
    let register = || register_font("sans-serif", FontStyle::Normal, FONT).is_ok();
    if *REGISTERED.get_or_init(register) { Ok(()) } else { Err("the built-in font is damaged".into()) }
}

impl Figure {
    /// The bytes of a file of this name, whose ending says what they are: `.svg` or `.png`.
    ///
    /// # Errors
    /// [`Error::Ending`] for another ending, [`Error::Figure`].
    pub fn file(&self, path: &Path) -> Result<Vec<u8>, Error> {
        Self::check_ending(path)?;
        let is_svg = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("svg"));
        if is_svg { self.svg().map(String::into_bytes) } else { self.png() }
    }

    /// Checks that a picture can be written to a file of this name.
    ///
    /// # Errors
    /// [`Error::Ending`].
    pub fn check_ending(path: &Path) -> Result<(), Error> {
        let is = |known: &str| path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known));
        if is("svg") || is("png") {
            return Ok(());
        }
        Err(Error::Ending { name: path.display().to_string() })
    }

    /// The figure as the text of an SVG file.
    ///
    /// # Errors
    /// [`Error::Figure`].
    pub fn svg(&self) -> Result<String, Error> {
        let (width, height) = self.drawn_size();
        let mut text = String::new();
        with_font().map_err(|reason| self.failed(reason))?;
        {
            let surface = SVGBackend::with_string(&mut text, (width, height)).into_drawing_area();
            draw::figure(&surface, self, 0.0).map_err(|reason| self.failed(reason))?;
            surface.present().map_err(|e| self.failed(e.to_string()))?;
        }
        // Cells of a heat map touch: smoothed edges would let the paper shine through between them.
        let text = text.replace("<rect ", "<rect shape-rendering=\"crispEdges\" ");
        // Shown at the size of the description; the viewBox keeps the drawn one.
        let (shown, scale) = (draw::height(self), SCALE as u32);
        let drawn = format!("width=\"{width}\" height=\"{height}\"");
        Ok(text.replacen(&drawn, &format!("width=\"{}\" height=\"{shown}\"", width / scale), 1))
    }

    /// The figure as the bytes of a PNG file, two pixels to one of the description.
    ///
    /// # Errors
    /// [`Error::Figure`].
    pub fn png(&self) -> Result<Vec<u8>, Error> {
        let (width, height) = self.drawn_size();
        let mut drawn = vec![0; 3 * width as usize * height as usize];
        with_font().map_err(|reason| self.failed(reason))?;
        {
            let surface = BitMapBackend::with_buffer(&mut drawn, (width, height)).into_drawing_area();
            draw::figure(&surface, self, LOWERED).map_err(|reason| self.failed(reason))?;
            surface.present().map_err(|e| self.failed(e.to_string()))?;
        }
        let pixels = averaged(&drawn, width as usize);
        let (width, height) = (width / OVERSAMPLING as u32, height / OVERSAMPLING as u32);
        encoded(&pixels, width, height).map_err(|e| self.failed(e.to_string()))
    }

    fn drawn_size(&self) -> (u32, u32) {
        ((SCALE * draw::WIDTH) as u32, (SCALE * draw::height(self)) as u32)
    }

    fn failed(&self, reason: String) -> Error {
        Error::Figure { title: self.title.clone(), reason }
    }
}

/// Squares of pixels averaged: smooth edges whatever was drawn.
pub(super) fn averaged(drawn: &[u8], width: usize) -> Vec<u8> {
    let stride = 3 * width;
    let mut pixels = Vec::with_capacity(drawn.len() / (OVERSAMPLING * OVERSAMPLING));
    for rows in drawn.chunks_exact(OVERSAMPLING * stride) {
        for at in 0..width / OVERSAMPLING {
            for channel in 0..3 {
                let sample = |dy: usize, dx: usize| {
                    u32::from(rows[dy * stride + 3 * (OVERSAMPLING * at + dx) + channel])
                };
                let sum: u32 = (0..OVERSAMPLING)
                    .flat_map(|dy| (0..OVERSAMPLING).map(move |dx| (dy, dx)))
                    .map(|(dy, dx)| sample(dy, dx))
                    .sum();
                pixels.push((sum / (OVERSAMPLING * OVERSAMPLING) as u32) as u8);
            }
        }
    }
    pixels
}

pub(super) fn encoded(pixels: &[u8], width: u32, height: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_compression(png::Compression::Balanced);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::figure::{Axis, Figure, HeatMap, Panel, Series, Stroke};

    fn sample() -> Figure {
        let wave = |k: f64| (0..200).map(move |i| [f64::from(i) * 1e-3, k * (f64::from(i) * 0.05).sin()]);
        let map = HeatMap {
            x: vec![0.0, 1.0, 2.0],
            y: vec![0.0, 1.0],
            values: vec![1e-6, 1e-5, 1e-4, 1e-5, f64::NAN, 1e-3],
            scale: Axis::new("‖Φ‖", "m").log(),
        };
        Figure::new("Test of θ, Φ and β²")
            .panel(Panel::lines(
                Axis::new("time", "s"),
                Axis::new("‖Φ‖", "m"),
                [Series::new("solid", wave(1e-6)), Series::new("dashed", wave(2e-6)).stroke(Stroke::Dashed)],
            ))
            .panel(Panel::map(Axis::new("α", "1/s"), Axis::new("β", "1/s"), map))
    }

    #[test]
    fn svg_shows_titles_units_and_factors() {
        let svg = sample().svg().unwrap();
        for text in ["Test of θ", "time (s)", "‖Φ‖ (10⁻⁶ m)", "dashed", "β (1/s)"] {
            assert!(svg.contains(text), "{text}");
        }
        assert!(svg.contains("width=\"900\""));
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn files_by_their_ending() {
        assert!(sample().file(Path::new("a.png")).unwrap().starts_with(b"\x89PNG"));
        assert!(sample().file(Path::new("a.SVG")).unwrap().starts_with(b"<svg"));
        let wrong = sample().file(Path::new("a.bmp")).unwrap_err();
        assert!(wrong.to_string().contains(".svg or .png"));
    }

    #[test]
    fn degenerate_data_still_draws() {
        let flat = Series::new("", [[0.0, 1.0], [1.0, 1.0]]);
        let empty = Series::new("none", [[f64::NAN, f64::NAN]]);
        let log = Axis::new("y", "").log();
        let figure = Figure::new("flat")
            .panel(Panel::lines(Axis::new("x", ""), Axis::new("y", ""), [flat]))
            .panel(Panel::lines(Axis::new("x", ""), log, [empty]));
        assert!(figure.svg().is_ok() && figure.png().is_ok());
    }
}
