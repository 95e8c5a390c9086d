//! A mechanism as a small square picture, without axes and names.

use plotters::prelude::{BitMapBackend, IntoDrawingArea};

use super::canvas::Canvas;
use super::layout::{Area, SCALE, Span, with_equal_scales};
use super::output::{OVERSAMPLING, averaged, encoded, with_font};
use super::{Axis, mechanism};
use crate::Error;
use crate::picture::{Extent, Picture, Shape};

/// Width and height in pixels of the description, and what stays free around the mechanism: the ground
/// of a point reaches below it.
const SIZE: i32 = 160;
const MARGIN: i32 = 16;

/// A picture at its start as the bytes of a PNG file.
///
/// # Errors
/// [`Error::Figure`].
pub fn icon(title: &str, picture: &Picture) -> Result<Vec<u8>, Error> {
    let failed = |reason: String| Error::Figure { title: title.to_owned(), reason };
    // a joint without a shape of its own is marked by its word
    with_font().map_err(failed)?;
    let mut picture = picture.clone();
    picture.shapes.retain(|shape| !matches!(shape, Shape::Label { .. }));
    let side = SCALE * SIZE;
    let area = Area { left: 0, top: 0, right: side, bottom: side };
    let Extent { low, high } = picture.extent();
    let (x, y) = with_equal_scales(((low[0], high[0]), (low[1], high[1])), area);
    let axis = Axis::new("", "");
    let (near, far) = (SCALE * MARGIN, side - SCALE * MARGIN);
    let (x, y) = (Span::new(&axis, x, near, far), Span::new(&axis, y, far, near));
    let mut drawn = vec![255; 3 * (side * side) as usize];
    {
        let surface = BitMapBackend::with_buffer(&mut drawn, (side as u32, side as u32)).into_drawing_area();
        let canvas = Canvas { surface: &surface, lowered: 0.0 };
        mechanism::draw(&canvas, &picture, (&x, &y), area).map_err(failed)?;
        surface.present().map_err(|e| failed(e.to_string()))?;
    }
    let pixels = averaged(&drawn, side as usize);
    let side = (side as usize / OVERSAMPLING) as u32;
    encoded(&pixels, side, side).map_err(|e| failed(e.to_string()))
}
