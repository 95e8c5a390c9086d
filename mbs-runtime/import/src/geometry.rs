//! Points of the plane, in the unit of the file.

pub(super) type Point = [f64; 2];

pub(super) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(super) fn distance(a: Point, b: Point) -> f64 {
    let [x, y] = minus(a, b);
    x.hypot(y)
}

/// The polar angle of a vector in rad.
pub(super) fn polar([x, y]: Point) -> f64 {
    y.atan2(x)
}

/// A vector turned by an angle in rad.
pub(super) fn turned([x, y]: Point, angle: f64) -> Point {
    let (sin, cos) = angle.sin_cos();
    [x * cos - y * sin, x * sin + y * cos]
}

/// The point at a distance from another one, in a direction.
pub(super) fn from(a: Point, length: f64, angle: f64) -> Point {
    [a[0] + length * angle.cos(), a[1] + length * angle.sin()]
}

/// Where two circles meet, the place that is nearer to `near`; nothing where they do not.
pub(super) fn circles(a: Point, ra: f64, b: Point, rb: f64, near: Point) -> Option<Point> {
    let d = distance(a, b);
    let along = (d * d + ra * ra - rb * rb) / (2.0 * d);
    let square = ra * ra - along * along;
    // Circles that touch miss each other by rounding.
    let across = if square.abs() <= 1e-9 * ra * ra { 0.0 } else { square.sqrt() };
    let direction = polar(minus(b, a));
    let foot = from(a, along, direction);
    let [left, right] =
        [1.0, -1.0].map(|side| from(foot, across, direction + side * 0.5 * std::f64::consts::PI));
    nearer(left, right, near)
}

/// Where a circle meets the line through two points, the place that is nearer to `near`;
/// nothing where it does not.
pub(super) fn circle_and_line(a: Point, radius: f64, line: [Point; 2], near: Point) -> Option<Point> {
    let direction = polar(minus(line[1], line[0]));
    let [along, across] = turned(minus(a, line[0]), -direction);
    let half = (radius * radius - across * across).sqrt();
    let [left, right] = [along + half, along - half].map(|place| from(line[0], place, direction));
    nearer(left, right, near)
}

fn nearer(left: Point, right: Point, near: Point) -> Option<Point> {
    let is_real = left.iter().chain(&right).all(|number| number.is_finite());
    is_real.then(|| if distance(left, near) <= distance(right, near) { left } else { right })
}
