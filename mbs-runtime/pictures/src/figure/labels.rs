//! Where names stand beside what they name.

use super::layout::{Area, SCALE};

/// Size of the text.
pub(super) const SIZE: i32 = 15;

type Pixel = (f64, f64);

/// A text and what it names.
pub(super) struct Label<'a> {
    pub(super) text: &'a str,
    /// Points of what it names.
    pub(super) near: Vec<Pixel>,
    /// Its width in drawn pixels.
    pub(super) width: f64,
}

/// The left middle of every text, in drawn pixels: of the places around the
/// middle of what it names, the one that covers least. A text that could only be
/// printed over another has none.
pub(super) fn places(labels: &[Label<'_>], obstacles: &[Pixel], area: Area) -> Vec<Option<Pixel>> {
    let mut taken: Vec<[f64; 4]> = Vec::new();
    let mut places = Vec::new();
    for label in labels {
        let count = label.near.len().max(1) as f64;
        let (x, y) = label.near.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
        let height = f64::from(SIZE * SCALE);
        let boxes = candidates().map(|(radius, turn)| {
            let (s, c) = turn.sin_cos();
            let radius = radius * f64::from(SCALE);
            // A box touches the circle of its candidate with the side that faces the middle.
            let (cx, cy) = (x + radius * c + 0.5 * label.width * c, y - radius * s - 0.5 * height * s);
            (radius, [cx - 0.5 * label.width, cy - 0.5 * height, cx + 0.5 * label.width, cy + 0.5 * height])
        });
        let cost = |radius: f64, of: [f64; 4]| {
            let air = 7.0 * f64::from(SCALE);
            let covered = obstacles.iter().filter(|p| holds(of, **p, air)).count();
            let outside = !(area.contains(of[0], of[1]) && area.contains(of[2], of[3]));
            covered as f64 + 400.0 * f64::from(outside) + 0.02 * radius / f64::from(SCALE)
        };
        let is_free = |of: &[f64; 4]| !taken.iter().any(|other| overlap(*of, *other));
        let costs = boxes.filter(|(_, of)| is_free(of)).map(|(radius, of)| (cost(radius, of), of));
        let best = costs.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, of)| of);
        taken.extend(best);
        places.push(best.map(|[left, top, _, bottom]| (left, 0.5 * (top + bottom))));
    }
    places
}

/// Radii and angles to be tried.
fn candidates() -> impl Iterator<Item = (f64, f64)> {
    const DIRECTIONS: usize = 16;
    let turn = |k: usize| (k as f64 + 0.5) / DIRECTIONS as f64 * std::f64::consts::TAU;
    [14.0, 22.0, 34.0, 50.0]
        .into_iter()
        .flat_map(move |radius| (0..DIRECTIONS).map(move |k| (radius, turn(k))))
}

fn holds([left, top, right, bottom]: [f64; 4], (x, y): Pixel, air: f64) -> bool {
    x > left - air && x < right + air && y > top - air && y < bottom + air
}

fn overlap(a: [f64; 4], b: [f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_avoid_each_other_what_is_drawn_and_the_frame() {
        let area = Area { left: 0, top: 0, right: 2000, bottom: 2000 };
        let bar: Vec<Pixel> = (0..100).map(|k| (20.0 * f64::from(k), 1000.0)).collect();
        let label = |near: Pixel| Label { text: "rod", near: vec![near], width: 120.0 };
        let labels = [label((1000.0, 1000.0)), label((1000.0, 1000.0)), label((1995.0, 1000.0))];
        let places = places(&labels, &bar, area);
        let boxes: Vec<_> =
            places.iter().flatten().map(|&(x, y)| [x, y - 30.0, x + 120.0, y + 30.0]).collect();
        assert_eq!(boxes.len(), labels.len());
        for (at, of) in boxes.iter().enumerate() {
            assert!(!bar.iter().any(|p| holds(*of, *p, 0.0)), "{of:?}");
            assert!(area.contains(of[0], of[1]) && area.contains(of[2], of[3]), "{of:?}");
            assert!(boxes.iter().skip(at + 1).all(|other| !overlap(*of, *other)));
        }
    }

    #[test]
    fn names_without_room_are_left_out() {
        let area = Area { left: 0, top: 0, right: 2000, bottom: 2000 };
        let labels: Vec<_> =
            (0..400).map(|_| Label { text: "rod", near: vec![(1000.0, 1000.0)], width: 120.0 }).collect();
        let places = places(&labels, &[], area);
        let shown: Vec<_> =
            places.iter().flatten().map(|&(x, y)| [x, y - 30.0, x + 120.0, y + 30.0]).collect();
        assert!((2..100).contains(&shown.len()), "{}", shown.len());
        assert!(shown.iter().enumerate().all(|(at, a)| shown.iter().skip(at + 1).all(|b| !overlap(*a, *b))));
    }
}
