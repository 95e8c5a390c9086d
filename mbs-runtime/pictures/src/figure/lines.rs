//! Curves in pixels: clipped, thinned, dashed.

use super::Stroke;
use super::layout::{Area, SCALE, Span};

type Pixel = (f64, f64);
/// A polyline as it is drawn.
type Path = Vec<(i32, i32)>;

/// The pieces of a curve that lie inside `area`, in pixels.
///
/// A point that is not finite breaks the curve; points nearer to each other
/// than half a pixel are drawn as one.
pub(super) fn pieces(points: &[[f64; 2]], x: &Span, y: &Span, area: Area) -> Vec<Vec<Pixel>> {
    let mut pieces: Vec<Vec<Pixel>> = Vec::new();
    let mut last: Option<Pixel> = None;
    let mut open = false;
    for point in points {
        let here = (x.pixel(point[0]), y.pixel(point[1]));
        if !(here.0.is_finite() && here.1.is_finite()) {
            (last, open) = (None, false);
            continue;
        }
        if let Some(from) = last {
            match clip(from, here, area) {
                None => open = false,
                Some((a, b)) => {
                    if !open || a != from {
                        pieces.push(vec![a]);
                    }
                    if let Some(piece) = pieces.last_mut() {
                        extend(piece, b);
                    }
                    open = b == here;
                }
            }
        }
        last = Some(here);
    }
    pieces
}

fn extend(piece: &mut Vec<Pixel>, to: Pixel) {
    let near = |p: &Pixel| (p.0 - to.0).hypot(p.1 - to.1) < 0.5 * f64::from(SCALE);
    // The end of a piece is moved rather than dropped, so that curves meet their last point.
    match piece.len() {
        0 | 1 => piece.push(to),
        n if near(&piece[n - 2]) => piece[n - 1] = to,
        _ => piece.push(to),
    }
}

/// The part of a segment inside a rectangle (Liang and Barsky 1984).
fn clip(a: Pixel, b: Pixel, area: Area) -> Option<(Pixel, Pixel)> {
    let (dx, dy) = (b.0 - a.0, b.1 - a.1);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges = [
        (-dx, a.0 - f64::from(area.left)),
        (dx, f64::from(area.right) - a.0),
        (-dy, a.1 - f64::from(area.top)),
        (dy, f64::from(area.bottom) - a.1),
    ];
    for (direction, distance) in edges {
        if direction == 0.0 {
            if distance < 0.0 {
                return None;
            }
        } else if direction < 0.0 {
            enter = enter.max(distance / direction);
        } else {
            leave = leave.min(distance / direction);
        }
    }
    if enter > leave {
        return None;
    }
    let at = |s: f64| (a.0 + s * dx, a.1 + s * dy);
    Some((if enter > 0.0 { at(enter) } else { a }, if leave < 1.0 { at(leave) } else { b }))
}

/// A piece as it is stroked: itself, or its dashes.
pub(super) fn stroked(piece: &[Pixel], stroke: Stroke) -> Vec<Path> {
    let rounded = |p: &Pixel| (p.0.round() as i32, p.1.round() as i32);
    match stroke {
        Stroke::Solid | Stroke::Dotted => return vec![piece.iter().map(rounded).collect()],
        Stroke::Points => return Vec::new(),
        Stroke::Dashed => {}
    }
    let (dash, gap) = (8.0 * f64::from(SCALE), 5.0 * f64::from(SCALE));
    let mut dashes = Vec::new();
    let mut current = Vec::new();
    // How much of the present dash or gap is left.
    let (mut drawing, mut left) = (true, dash);
    for pair in piece.windows(2) {
        let &[a, b] = pair else { continue };
        let length = (b.0 - a.0).hypot(b.1 - a.1);
        let mut done = 0.0;
        if drawing && current.is_empty() {
            current.push(rounded(&a));
        }
        while length - done > left {
            done += left;
            let at = (a.0 + done / length * (b.0 - a.0), a.1 + done / length * (b.1 - a.1));
            current.push(rounded(&at));
            if drawing {
                dashes.push(std::mem::take(&mut current));
            } else {
                current = vec![rounded(&at)];
            }
            drawing = !drawing;
            left = if drawing { dash } else { gap };
        }
        left -= length - done;
        if drawing {
            current.push(rounded(&b));
        }
    }
    if drawing && current.len() > 1 {
        dashes.push(current);
    }
    dashes
}

/// A stroke cut at its sharp corners, where the drawing library's mitred
/// joints would stick out far; the corners are given too.
pub(super) fn cut_at_corners(stroke: &[(i32, i32)]) -> (Vec<Path>, Path) {
    let is_sharp = |at: usize| {
        let (a, b, c) = (stroke[at - 1], stroke[at], stroke[at + 1]);
        let (u, v) =
            ((f64::from(b.0 - a.0), f64::from(b.1 - a.1)), (f64::from(c.0 - b.0), f64::from(c.1 - b.1)));
        // The cosine of the change of direction; a repeated point is no corner.
        let cosine = (u.0 * v.0 + u.1 * v.1) / (u.0.hypot(u.1) * v.0.hypot(v.1));
        cosine < 0.6
    };
    let corners: Vec<_> = (1..stroke.len().saturating_sub(1)).filter(|at| is_sharp(*at)).collect();
    let ends = corners.iter().copied().chain([stroke.len().saturating_sub(1)]);
    let mut start = 0;
    let parts = ends.map(|end| {
        let part = stroke[start..=end.max(start)].to_vec();
        start = end;
        part
    });
    let parts = if stroke.is_empty() { Vec::new() } else { parts.collect() };
    (parts, corners.into_iter().map(|at| stroke[at]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Area = Area { left: 0, top: 0, right: 100, bottom: 100 };

    #[test]
    fn segments_are_clipped_at_the_frame() {
        assert_eq!(clip((10.0, 10.0), (20.0, 20.0), AREA), Some(((10.0, 10.0), (20.0, 20.0))));
        assert_eq!(clip((50.0, 50.0), (50.0, 250.0), AREA), Some(((50.0, 50.0), (50.0, 100.0))));
        assert_eq!(clip((-10.0, 120.0), (120.0, 130.0), AREA), None);
        assert_eq!(clip((-50.0, 50.0), (150.0, 50.0), AREA), Some(((0.0, 50.0), (100.0, 50.0))));
    }

    #[test]
    fn a_spike_is_cut_at_its_tip() {
        let (parts, corners) = cut_at_corners(&[(0, 0), (10, 0), (10, 500), (12, 0), (30, 1)]);
        assert_eq!(parts.len(), 4);
        assert_eq!(corners, [(10, 0), (10, 500), (12, 0)]);
        assert_eq!(cut_at_corners(&[(0, 0), (10, 1), (20, 3)]).0.len(), 1);
        assert!(cut_at_corners(&[]).0.is_empty());
    }

    #[test]
    fn dashes_leave_gaps() {
        let dashes = stroked(&[(0.0, 0.0), (400.0, 0.0)], Stroke::Dashed);
        assert_eq!(dashes[0], [(0, 0), (32, 0)]);
        assert_eq!(dashes[1], [(52, 0), (84, 0)]);
        assert_eq!(stroked(&[(0.0, 0.0), (400.0, 0.0)], Stroke::Solid).len(), 1);
    }
}
