//! A mechanism on a canvas: paths, faint poses, and the start in full colour.
//! The page's script draws the same shapes in the same sizes.

use plotters::prelude::DrawingBackend;
use plotters::style::RGBColor;

use super::canvas::{Canvas, INK, Place};
use super::labels::{self, Label};
use super::layout::{Area, SCALE, Span};
use super::{Stroke, colour, lines};
use crate::picture::{Picture, Shape};

/// How many poses stand faintly behind the start.
const POSES: usize = 5;
/// Straight parts of which a circle is drawn.
const CIRCLE: u32 = 72;
/// Ground, rails and massless rods.
const GREY: RGBColor = RGBColor(120, 128, 136);
const WHITE: RGBColor = RGBColor(255, 255, 255);

type Drawn = Result<(), String>;
type Pixel = (f64, f64);

/// Draws a picture at its start, with other poses behind it.
pub(super) fn draw<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    picture: &Picture,
    (x, y): (&Span, &Span),
    area: Area,
) -> Drawn {
    for pose in picture.poses(POSES) {
        let pen = Pen { canvas, picture, x, y, area, instant: pose, is_faint: true };
        picture.shapes.iter().try_for_each(|shape| pen.body(shape))?;
    }
    paths(canvas, picture, (x, y), area)?;
    if picture.points.is_empty() {
        return Ok(());
    }
    pose(canvas, picture, (x, y), area, 0)
}

/// Draws the paths of points over the whole motion.
pub(super) fn paths<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    picture: &Picture,
    (x, y): (&Span, &Span),
    area: Area,
) -> Drawn {
    for (point, of) in &picture.traced {
        let path: Vec<_> = (0..picture.points.len()).map(|instant| picture.place(instant, *point)).collect();
        for piece in lines::pieces(&path, x, y, area) {
            // Piece by piece: a path that goes back upon itself would cancel where areas are filled.
            for part in piece.windows(2) {
                let part = part.iter().map(|p| rounded(*p)).collect();
                canvas.line(part, tinted(colour::series(*of), 0.5), 1.4)?;
            }
        }
    }
    Ok(())
}

/// Draws everything as it stands at one instant.
pub(super) fn pose<B: DrawingBackend>(
    canvas: &Canvas<'_, B>,
    picture: &Picture,
    (x, y): (&Span, &Span),
    area: Area,
    instant: usize,
) -> Drawn {
    let pen = Pen { canvas, picture, x, y, area, instant, is_faint: false };
    for shape in &picture.shapes {
        pen.body(shape)?;
        pen.joint(shape)?;
    }
    pen.labels()
}

/// `colour` with this part of white.
fn tinted(colour: RGBColor, white: f64) -> RGBColor {
    let mix = |c: u8| (f64::from(c) + white * (255.0 - f64::from(c))).round() as u8;
    RGBColor(mix(colour.0), mix(colour.1), mix(colour.2))
}

fn rounded(p: Pixel) -> (i32, i32) {
    (p.0.round() as i32, p.1.round() as i32)
}

/// A pen that draws the shapes of one instant.
struct Pen<'a, B: DrawingBackend> {
    canvas: &'a Canvas<'a, B>,
    picture: &'a Picture,
    x: &'a Span,
    y: &'a Span,
    area: Area,
    instant: usize,
    is_faint: bool,
}

impl<B: DrawingBackend> Pen<'_, B> {
    fn pixel(&self, place: [f64; 2]) -> Pixel {
        (self.x.pixel(place[0]), self.y.pixel(place[1]))
    }

    fn at(&self, point: usize) -> Pixel {
        self.pixel(self.picture.place(self.instant, point))
    }

    /// A length on paper, smaller where there is little room.
    fn size(&self, pixels: f64) -> f64 {
        self.picture.weight * pixels
    }

    /// The same in drawn pixels.
    fn drawn(&self, pixels: f64) -> f64 {
        self.size(pixels) * f64::from(SCALE)
    }

    /// Unit vector from one point to another on paper, where y points down.
    fn direction(&self, from: usize, to: usize) -> Pixel {
        let [u, v] = self.picture.direction(self.instant, from, to);
        (u, -v)
    }

    fn colour(&self, of: usize) -> RGBColor {
        tinted(colour::series(of), if self.is_faint { 0.8 } else { 0.0 })
    }

    /// A line that is straight, or cut at its corners, where the drawing
    /// library's mitres would stick out.
    fn line(&self, points: &[Pixel], colour: RGBColor, width: f64) -> Drawn {
        for pair in points.windows(2) {
            self.canvas.line(pair.iter().map(|p| rounded(*p)).collect(), colour, width)?;
        }
        let corners = points.iter().skip(1).take(points.len().saturating_sub(2));
        corners.copied().try_for_each(|corner| self.canvas.dot(rounded(corner), 0.5 * width, colour))
    }

    /// Draws a shape if faint poses have it too.
    fn body(&self, shape: &Shape) -> Drawn {
        let width = self.size(8.0);
        match shape {
            Shape::Link { between } => {
                let colour = tinted(GREY, if self.is_faint { 0.7 } else { 0.0 });
                self.line(&between.map(|at| self.at(at)), colour, self.size(3.0))
            }
            Shape::Circle { at, rim, colour } => {
                let colour = match colour {
                    Some(colour) => self.colour(*colour),
                    None => tinted(GREY, if self.is_faint { 0.7 } else { 0.0 }),
                };
                self.line(&self.circle(*at, *rim), colour, self.size(3.0))
            }
            Shape::Bar { between, colour } => {
                let (ends, colour) = (between.map(|at| self.at(at)), self.colour(*colour));
                self.line(&ends, colour, width)?;
                ends.into_iter().try_for_each(|end| self.canvas.dot(rounded(end), 0.5 * width, colour))
            }
            Shape::Plate { corners, colour } => {
                let colour = self.colour(*colour);
                let mut outline: Vec<_> = corners.iter().map(|&at| self.at(at)).collect();
                if !self.is_faint {
                    let inside = outline.iter().map(|p| rounded(*p)).collect();
                    self.canvas.polygon(inside, tinted(colour, 0.72))?;
                }
                outline.extend(outline.first().copied());
                outline.extend(outline.get(1).copied());
                self.line(&outline, colour, 0.5 * width)
            }
            Shape::Dot { at, colour } => {
                self.canvas.dot(rounded(self.at(*at)), self.size(9.0), self.colour(*colour))
            }
            Shape::Block { at, from, ahead, colour } => {
                let corners = self.block(*at, self.direction(*from, *ahead));
                self.canvas.polygon(corners, self.colour(*colour))
            }
            _ => Ok(()),
        }
    }

    /// Points on a circle through one point about another, the first one again at the end.
    fn circle(&self, at: usize, rim: usize) -> Vec<Pixel> {
        let (centre, rim) = (self.at(at), self.at(rim));
        let (dx, dy) = (rim.0 - centre.0, rim.1 - centre.1);
        let point = |part: u32| {
            let (sine, cosine) = (std::f64::consts::TAU * f64::from(part) / f64::from(CIRCLE)).sin_cos();
            (centre.0 + cosine * dx - sine * dy, centre.1 + sine * dx + cosine * dy)
        };
        (0..=CIRCLE).map(point).collect()
    }

    fn block(&self, at: usize, (u, v): Pixel) -> Vec<(i32, i32)> {
        let (x, y) = self.at(at);
        let (long, wide) = (self.drawn(18.0), self.drawn(11.0));
        let corner =
            |a: f64, b: f64| rounded((x + a * long * u - b * wide * v, y + a * long * v + b * wide * u));
        vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)]
    }

    /// Draws a shape if faint poses do not have it.
    fn joint(&self, shape: &Shape) -> Drawn {
        match shape {
            Shape::Rail { from, ahead, reach } => {
                let ends = reach.map(|s| self.pixel(self.picture.along(self.instant, *from, *ahead, s)));
                self.line(&ends, GREY, 1.5)
            }
            Shape::Ground { at } => self.ground(self.at(*at)),
            Shape::Spring { between } => self.spring(self.at(between[0]), self.at(between[1])),
            Shape::Coil { at } => self.coil(self.at(*at)),
            Shape::Pin { at } => self.ring(self.at(*at), 4.5),
            Shape::Weld { at } => {
                let (x, y) = self.at(*at);
                let half = self.drawn(4.5);
                let corner = |a: f64, b: f64| rounded((x + a * half, y + b * half));
                let corners =
                    vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
                self.canvas.polygon(corners, INK)
            }
            Shape::Centre { at } => self.centre(self.at(*at)),
            Shape::Mark { between, text } => self.mark(between.map(|at| self.at(at)), text),
            _ => Ok(()),
        }
    }

    fn ring(&self, at: Pixel, radius: f64) -> Drawn {
        self.canvas.dot(rounded(at), self.size(radius), INK)?;
        self.canvas.dot(rounded(at), self.size(radius - 1.5), WHITE)
    }

    /// A triangle on a hatched line.
    fn ground(&self, (x, y): Pixel) -> Drawn {
        let d = |pixels: f64| self.drawn(pixels);
        let foot = y + d(18.0);
        let corners = vec![rounded((x, y)), rounded((x - d(11.0), foot)), rounded((x + d(11.0), foot))];
        self.canvas.polygon(corners, tinted(GREY, 0.55))?;
        self.line(&[(x - d(11.0), foot), (x, y), (x + d(11.0), foot)], GREY, self.size(1.5))?;
        self.line(&[(x - d(16.0), foot), (x + d(16.0), foot)], GREY, self.size(1.5))?;
        (0..5).try_for_each(|k| {
            let right = x - d(16.0) + f64::from(k + 1) * d(6.4);
            self.line(&[(right, foot), (right - d(6.0), foot + d(6.0))], GREY, self.size(1.2))
        })
    }

    /// A zigzag between short straight ends.
    fn spring(&self, (ax, ay): Pixel, (bx, by): Pixel) -> Drawn {
        const TURNS: u32 = 6;
        let (dx, dy) = (bx - ax, by - ay);
        let length = dx.hypot(dy);
        if length < 1.0 {
            return Ok(());
        }
        let half = self.drawn(10.0) / length;
        let at = |along: f64, aside: f64| {
            (ax + along * dx - aside * half * dy, ay + along * dy + aside * half * dx)
        };
        let zigzag = (0..2 * TURNS).map(|k| {
            let aside = if k % 2 == 0 { 1.0 } else { -1.0 };
            at(0.14 + 0.72 * (f64::from(k) + 0.5) / f64::from(2 * TURNS), aside)
        });
        let ends = |fractions: [f64; 2]| fractions.map(|along| at(along, 0.0));
        let path: Vec<_> = ends([0.0, 0.14]).into_iter().chain(zigzag).chain(ends([0.86, 1.0])).collect();
        self.line(&path, INK, self.size(1.8))
    }

    /// A spiral.
    fn coil(&self, (x, y): Pixel) -> Drawn {
        let spiral = (0..=60).map(|k| {
            let turn = f64::from(k) / 60.0 * 2.5 * std::f64::consts::TAU;
            let radius = self.drawn(6.0 + 8.0 * f64::from(k) / 60.0);
            (x + radius * turn.cos(), y - radius * turn.sin())
        });
        let path: Vec<_> = spiral.map(rounded).collect();
        self.canvas.line(path, INK, self.size(1.5))
    }

    /// A circle of which two quarters are dark.
    fn centre(&self, at: Pixel) -> Drawn {
        self.ring(at, 4.5)?;
        for quarter in [0.0, 2.0] {
            let arc = (0..=8).map(|k| {
                let turn = (quarter + f64::from(k) / 8.0) * std::f64::consts::FRAC_PI_2;
                rounded((at.0 + self.drawn(4.0) * turn.cos(), at.1 - self.drawn(4.0) * turn.sin()))
            });
            self.canvas.polygon([rounded(at)].into_iter().chain(arc).collect(), INK)?;
        }
        Ok(())
    }

    /// A dashed line with a word at its middle.
    fn mark(&self, ends: [Pixel; 2], text: &str) -> Drawn {
        for dash in lines::stroked(&ends, Stroke::Dashed) {
            self.canvas.line(dash, GREY, 1.5)?;
        }
        let [a, b] = ends;
        let middle = (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1) + self.drawn(8.0));
        self.canvas.coloured_text(text, rounded(middle), Place::Below, labels::SIZE, tinted(INK, 0.35))
    }

    /// The names of bodies, each where least is in its way.
    fn labels(&self) -> Drawn {
        let named = self.picture.shapes.iter().filter_map(|shape| match shape {
            Shape::Label { text, near, colour } => Some((text, near, *colour)),
            _ => None,
        });
        let (texts, colours): (Vec<_>, Vec<_>) = named
            .map(|(text, near, colour)| {
                let near: Vec<_> = near.iter().map(|&at| self.at(at)).collect();
                let width = f64::from(self.canvas.text_width(text, labels::SIZE));
                (Label { text, near, width }, colour)
            })
            .unzip();
        let places = labels::places(&texts, &self.obstacles(), self.area);
        for ((label, colour), place) in texts.iter().zip(colours).zip(places) {
            let Some((x, y)) = place else { continue };
            let RGBColor(r, g, b) = colour::series(colour);
            let dark = RGBColor(r / 4 * 3, g / 4 * 3, b / 4 * 3);
            self.canvas.coloured_text(label.text, rounded((x, y)), Place::Right, labels::SIZE, dark)?;
        }
        Ok(())
    }

    /// Places that a name should not cover.
    fn obstacles(&self) -> Vec<Pixel> {
        let mut obstacles = Vec::new();
        for shape in &self.picture.shapes {
            let points: Vec<_> = match shape {
                Shape::Label { .. } => Vec::new(),
                Shape::Rail { from, ahead, reach } => {
                    reach.map(|s| self.pixel(self.picture.along(self.instant, *from, *ahead, s))).to_vec()
                }
                Shape::Circle { at, rim, .. } => self.circle(*at, *rim),
                Shape::Ground { at } => {
                    let (x, y) = self.at(*at);
                    let foot = y + self.drawn(22.0);
                    vec![(x, y), (x - self.drawn(16.0), foot), (x + self.drawn(16.0), foot), (x, y)]
                }
                Shape::Block { at, from, ahead, .. } => {
                    let corners = self.block(*at, self.direction(*from, *ahead));
                    corners.into_iter().map(|(x, y)| (f64::from(x), f64::from(y))).collect()
                }
                shape => {
                    let mut points: Vec<_> = shape.points().into_iter().map(|at| self.at(at)).collect();
                    if let Shape::Plate { .. } = shape {
                        points.extend(points.first().copied());
                    }
                    points
                }
            };
            obstacles.extend(points.first());
            for pair in points.windows(2) {
                let &[a, b] = pair else { continue };
                let count = ((b.0 - a.0).hypot(b.1 - a.1) / f64::from(5 * SCALE)).ceil().max(1.0);
                let at = |k: f64| (a.0 + (b.0 - a.0) * k / count, a.1 + (b.1 - a.1) * k / count);
                obstacles.extend((0..=count as usize).map(|k| at(k as f64)));
            }
        }
        obstacles
    }
}
