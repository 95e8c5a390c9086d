//! A motion as an SVG file.
//!
//! The animation is declared in the picture (SMIL: `animate` and `animateTransform`), without a
//! script, so that it also moves where scripts are forbidden, such as in an `img` of a page.

use std::fmt::Write;

use crate::figure::SERIES_COLOURS;
use crate::picture::{Extent, Picture, Shape};

/// The longer side of the picture in px, without its margins.
const SIZE: f64 = 560.0;
/// Its margins in px.
const MARGIN: f64 = 40.0;

type Pixel = [f64; 2];

/// The file for a picture.
pub(super) fn animated(name: &str, picture: &Picture) -> String {
    let pen = Pen::new(picture);
    let mut svg = String::new();
    let [width, height] = pen.size();
    let name = name.replace('&', "&amp;").replace('<', "&lt;");
    // a text takes everything
    let _ = write!(
        svg,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
         viewBox=\"0 0 {width:.0} {height:.0}\" stroke-linecap=\"round\" stroke-linejoin=\"round\" \
         fill=\"none\" stroke=\"#788088\" stroke-width=\"2\">\n<title>{name}</title>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#ffffff\" stroke=\"none\"/>\n"
    );
    for (point, of) in &picture.traced {
        let path: Vec<Pixel> = (0..picture.points.len()).map(|instant| pen.pixel(instant, *point)).collect();
        let (path, colour) = (written(&path), colour(*of));
        let _ = writeln!(svg, "<polyline points=\"{path}\" stroke=\"{colour}\" stroke-opacity=\"0.4\"/>");
    }
    for shape in &picture.shapes {
        svg += &pen.shape(shape);
    }
    svg + "</svg>\n"
}

/// A pen that draws shapes at every instant.
struct Pen<'a> {
    picture: &'a Picture,
    extent: Extent,
    /// Pixels in a metre.
    scale: f64,
    /// The instants as parts of the whole.
    key_times: String,
    seconds: f64,
}

impl<'a> Pen<'a> {
    fn new(picture: &'a Picture) -> Self {
        let extent = picture.extent();
        let span = extent.span();
        let [first, last] =
            [picture.times.first(), picture.times.last()].map(|time| time.copied().unwrap_or(0.0));
        let seconds = (last - first).max(1e-3);
        let part = |time: &f64| format!("{:.4}", ((time - first) / seconds).clamp(0.0, 1.0));
        let key_times = picture.times.iter().map(part).collect::<Vec<_>>().join(";");
        Self { picture, extent, scale: if span > 0.0 { SIZE / span } else { 1.0 }, key_times, seconds }
    }

    fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| self.scale * (self.extent.high[axis] - self.extent.low[axis]) + 2.0 * MARGIN)
    }

    fn at(&self, [x, y]: [f64; 2]) -> Pixel {
        let Extent { low, high } = self.extent;
        [MARGIN + self.scale * (x - low[0]), MARGIN + self.scale * (high[1] - y)]
    }

    fn pixel(&self, instant: usize, point: usize) -> Pixel {
        self.at(self.picture.place(instant, point))
    }

    fn shape(&self, shape: &Shape) -> String {
        let weight = self.picture.weight;
        let thick = 7.0 * weight;
        match shape {
            Shape::Rail { from, ahead, reach } => {
                let end = |instant, reach| self.at(self.picture.along(instant, *from, *ahead, reach));
                let rail = |instant| reach.map(|reach| end(instant, reach)).to_vec();
                self.line("polyline", "stroke-width=\"1\"", rail)
            }
            Shape::Circle { at, rim, colour: of } => {
                let stroke = of.map_or_else(|| "#788088".to_owned(), colour);
                let radius = self.scale * self.picture.apart(0, *at, *rim);
                self.disk(*at, radius, &format!("fill=\"none\" stroke=\"{stroke}\" stroke-width=\"2\""))
            }
            Shape::Ground { at } => {
                let [x, y] = self.pixel(0, *at);
                let (half, down) = (10.0 * weight, 16.0 * weight);
                let corners = [[x, y], [x - half, y + down], [x + half, y + down]];
                format!("<polygon points=\"{}\" fill=\"#d8dce0\"/>\n", written(&corners))
            }
            Shape::Link { between } | Shape::Spring { between } => {
                let dashes =
                    if matches!(shape, Shape::Spring { .. }) { "stroke-dasharray=\"5 5\"" } else { "" };
                self.line("polyline", dashes, |instant| self.pixels(instant, between))
            }
            Shape::Bar { between, colour: of } => {
                let style =
                    format!("stroke=\"{}\" stroke-width=\"{thick:.1}\" stroke-opacity=\"0.8\"", colour(*of));
                self.line("polyline", &style, |instant| self.pixels(instant, between))
            }
            Shape::Plate { corners, colour: of } => {
                let of = colour(*of);
                let style = format!("stroke=\"{of}\" fill=\"{of}\" fill-opacity=\"0.3\"");
                self.line("polygon", &style, |instant| self.pixels(instant, corners))
            }
            Shape::Block { at, from, ahead, colour: of } => {
                let of = colour(*of);
                let style = format!("stroke=\"{of}\" fill=\"{of}\" fill-opacity=\"0.3\"");
                self.line("polygon", &style, |instant| self.block(instant, *at, [*from, *ahead]))
            }
            Shape::Dot { at, colour: of } => {
                self.disk(*at, 6.0 * weight, &format!("fill=\"{}\"", colour(*of)))
            }
            Shape::Pin { at } | Shape::Weld { at } => {
                self.disk(*at, 4.5 * weight, "fill=\"#ffffff\" stroke=\"#202428\"")
            }
            // No part of the mechanism: names, centres, and signs for joints of other kinds.
            Shape::Coil { .. } | Shape::Mark { .. } | Shape::Centre { .. } | Shape::Label { .. } => {
                String::new()
            }
        }
    }

    fn pixels(&self, instant: usize, points: &[usize]) -> Vec<Pixel> {
        points.iter().map(|point| self.pixel(instant, *point)).collect()
    }

    /// The corners of a block that slides along a line.
    fn block(&self, instant: usize, at: usize, [from, ahead]: [usize; 2]) -> Vec<Pixel> {
        let [x, y] = self.pixel(instant, at);
        let ([u, v], weight) = (self.picture.direction(instant, from, ahead), self.picture.weight);
        // y goes down in the picture
        let corner = |(a, b): (f64, f64)| [x + weight * (a * u - b * v), y - weight * (a * v + b * u)];
        [(16.0, 10.0), (-16.0, 10.0), (-16.0, -10.0), (16.0, -10.0)].map(corner).to_vec()
    }

    /// A line or an area whose corners move.
    fn line(&self, element: &str, style: &str, corners: impl Fn(usize) -> Vec<Pixel>) -> String {
        let frames: Vec<String> =
            (0..self.picture.points.len()).map(|instant| written(&corners(instant))).collect();
        let first = frames.first().map_or("", String::as_str);
        let start = format!("<{element} points=\"{first}\" {style}");
        self.moving(element, &start, &frames, "<animate attributeName=\"points\"")
    }

    /// A circle that moves.
    fn disk(&self, at: usize, radius: f64, style: &str) -> String {
        let frame = |instant| {
            let [x, y] = self.pixel(instant, at);
            format!("{x:.1} {y:.1}")
        };
        let frames: Vec<String> = (0..self.picture.points.len()).map(frame).collect();
        let first = frames.first().map_or("", String::as_str);
        let start = format!("<circle r=\"{radius:.1}\" transform=\"translate({first})\" {style}");
        let animation = "<animateTransform attributeName=\"transform\" type=\"translate\"";
        self.moving("circle", &start, &frames, animation)
    }

    /// An element with its animation, if anything of it moves.
    fn moving(&self, element: &str, start: &str, frames: &[String], animation: &str) -> String {
        if frames.windows(2).all(|pair| pair[0] == pair[1]) {
            return format!("{start}/>\n");
        }
        let (values, times, seconds) = (frames.join(";"), &self.key_times, self.seconds);
        format!(
            "{start}>{animation} dur=\"{seconds}s\" repeatCount=\"indefinite\" keyTimes=\"{times}\" \
             values=\"{values}\"/></{element}>\n"
        )
    }
}

fn colour(of: usize) -> String {
    let [r, g, b] = SERIES_COLOURS.get(of % SERIES_COLOURS.len()).copied().unwrap_or_default();
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Places as an attribute, to a tenth of a pixel.
fn written(places: &[Pixel]) -> String {
    places.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}
