//! A motion as a GIF file that begins again at its end.
//!
//! Frames are drawn as figures are, in the 256 colours that they have most of (`palette`). Each frame holds
//! the rectangle that differs from the one before it.

use ::gif::{Encoder, EncodingError, Frame, Repeat};
use plotters::prelude::{BitMapBackend, IntoDrawingArea};

use super::canvas::Canvas;
use super::layout::{Area, SCALE, Span};
use super::output::{OVERSAMPLING, averaged, with_font};
use super::palette::Palette;
use super::{Axis, mechanism};
use crate::Error;
use crate::picture::{Extent, Picture, Shape};

/// The longer side of what moves in px, and what stays free around it.
const SIZE: f64 = 440.0;
const MARGIN: i32 = 20;

/// The unit of the format's times in s.
const TICK: f64 = 0.01;
/// Programs that show the format take less time than this for a mistake.
const SHORTEST: u16 = 2;
const MOST_FRAMES: f64 = 200.0;

/// The palette is made of the colours in as many frames.
const SAMPLED: usize = 16;

/// The pixels of a frame as places in the palette, or why it could not be drawn.
pub type Drawn = Result<Vec<u8>, String>;

/// A picture in motion as the bytes of a GIF file. `all` has every frame drawn, by its number; the results are in the
/// order of the numbers.
///
/// # Errors
/// [`Error::Figure`].
pub fn gif(
    title: &str,
    picture: &Picture,
    all: impl FnOnce(&[usize], &(dyn Fn(&usize) -> Drawn + Sync)) -> Vec<Drawn>,
) -> Result<Vec<u8>, Error> {
    let failed = |reason: String| Error::Figure { title: title.to_owned(), reason };
    // a joint without a shape of its own is marked by its word
    with_font().map_err(failed)?;
    let (frames, delay) = in_frames(picture);
    let sheet = Sheet::around(picture);
    let drawn = |frame: &usize| sheet.drawn(picture, &frames, *frame);
    let numbers: Vec<usize> = (0..frames.points.len()).collect();
    let spread = numbers.len().div_ceil(SAMPLED).max(1);
    let sample: Result<Vec<_>, _> = numbers.iter().step_by(spread).map(drawn).collect();
    let palette = Palette::of(&sample.map_err(failed)?);
    let images = all(&numbers, &|frame| drawn(frame).map(|pixels| palette.indices(&pixels)));
    let images: Result<Vec<_>, _> = images.into_iter().collect();
    written(&images.map_err(failed)?, &sheet, &palette, delay).map_err(|e| failed(e.to_string()))
}

/// The picture at the times of the frames, and how long each of these is shown, in ticks.
///
/// The end of the motion has no frame: after a whole period, it is the start.
fn in_frames(picture: &Picture) -> (Picture, u16) {
    let [first, last] = [picture.times.first(), picture.times.last()].map(|t| t.copied().unwrap_or(0.0));
    let seconds = last - first;
    let delay = (seconds / MOST_FRAMES / TICK).ceil().clamp(f64::from(SHORTEST), f64::from(u16::MAX));
    let count = (seconds / (delay * TICK)).round().clamp(1.0, MOST_FRAMES);
    let mut frames = picture.clone();
    frames.shapes.retain(|shape| !matches!(shape, Shape::Label { .. } | Shape::Centre { .. }));
    frames.times = (0..count as usize).map(|k| first + seconds * k as f64 / count).collect();
    frames.points = frames.times.iter().map(|time| picture.places_at(*time)).collect();
    (frames, delay as u16)
}

/// The paper of a frame, in drawn pixels: the same for all of them.
struct Sheet {
    x: Span,
    y: Span,
    area: Area,
}

impl Sheet {
    /// Drawn pixels per pixel of the file: those of a figure are averaged twice.
    const FINER: i32 = SCALE;

    fn around(picture: &Picture) -> Self {
        let extent @ Extent { low, high } = picture.extent();
        let margin = Self::FINER * MARGIN;
        let [width, height] = extent.size().map(|side| {
            let pixels = (SIZE * side / extent.span()).round() as i32;
            Self::FINER * pixels + 2 * margin
        });
        let axis = Axis::new("", "");
        Self {
            x: Span::new(&axis, (low[0], high[0]), margin, width - margin),
            y: Span::new(&axis, (low[1], high[1]), height - margin, margin),
            area: Area { left: 0, top: 0, right: width, bottom: height },
        }
    }

    /// Width and height in pixels of the file.
    fn size(&self) -> (u16, u16) {
        let pixels = |drawn: i32| (drawn / Self::FINER) as u16;
        (pixels(self.area.right), pixels(self.area.bottom))
    }

    /// The pixels of one frame, three bytes each, with the paths of the whole motion.
    fn drawn(&self, motion: &Picture, frames: &Picture, frame: usize) -> Result<Vec<u8>, String> {
        let (width, height) = (self.area.right as usize, self.area.bottom as usize);
        let mut drawn = vec![255; 3 * width * height];
        {
            let size = (width as u32, height as u32);
            let surface = BitMapBackend::with_buffer(&mut drawn, size).into_drawing_area();
            let canvas = Canvas { surface: &surface, lowered: 0.0 };
            mechanism::paths(&canvas, motion, (&self.x, &self.y), self.area)?;
            mechanism::pose(&canvas, frames, (&self.x, &self.y), self.area, frame)?;
            surface.present().map_err(|e| e.to_string())?;
        }
        Ok(averaged(&averaged(&drawn, width), width / OVERSAMPLING))
    }
}

/// The file: of each frame what differs from the one before it.
fn written(
    images: &[Vec<u8>],
    sheet: &Sheet,
    palette: &Palette,
    delay: u16,
) -> Result<Vec<u8>, EncodingError> {
    let (width, height) = sheet.size();
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, width, height, palette.bytes())?;
    encoder.set_repeat(Repeat::Infinite)?;
    let mut before: Option<&[u8]> = None;
    for image in images {
        let part = changed(before, image, (width, height));
        encoder.write_frame(&Frame { delay, ..part })?;
        before = Some(image);
    }
    drop(encoder);
    Ok(bytes)
}

/// The smallest rectangle outside of which two images are the same, as a frame; of a pixel where
/// they are the same, since a frame stands for its time too.
fn changed(before: Option<&[u8]>, image: &[u8], (width, height): (u16, u16)) -> Frame<'static> {
    let wide = usize::from(width);
    let rows = || image.chunks_exact(wide).enumerate();
    let differs = |x: usize, y: usize| match before {
        Some(before) => before.get(wide * y + x) != image.get(wide * y + x),
        None => true,
    };
    let (mut left, mut right, mut top, mut bottom) = (wide, 0, usize::from(height), 0);
    for (y, row) in rows() {
        let first = (0..row.len()).find(|x| differs(*x, y));
        let last = (0..row.len()).rev().find(|x| differs(*x, y));
        if let (Some(first), Some(last)) = (first, last) {
            (left, right) = (left.min(first), right.max(last + 1));
            (top, bottom) = (top.min(y), y + 1);
        }
    }
    if left >= right {
        (left, right, top, bottom) = (0, 1, 0, 1);
    }
    let buffer: Vec<u8> = rows()
        .filter(|(y, _)| (top..bottom).contains(y))
        .flat_map(|(_, row)| row.get(left..right).unwrap_or_default())
        .copied()
        .collect();
    let [left, top, right, bottom] = [left, top, right, bottom].map(|at| at as u16);
    Frame { left, top, width: right - left, height: bottom - top, buffer: buffer.into(), ..Frame::default() }
}
