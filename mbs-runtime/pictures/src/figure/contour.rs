//! Contour lines of a heat map (marching squares).

use super::HeatMap;

/// The segments of the line on which the map has the value `level`, in the
/// coordinates of its axes. Interpolation is linear in the value, or in its
/// logarithm on a logarithmic scale. A cell with a value that is not finite
/// has no segments.
pub(super) fn segments(map: &HeatMap, level: f64) -> Vec<[[f64; 2]; 2]> {
    let height = |v: f64| if map.scale.log { v.ln() - level.ln() } else { v - level };
    let mut segments = Vec::new();
    for row in 1..map.y.len() {
        for column in 1..map.x.len() {
            let corner = |c: usize, r: usize| (map.x[c], map.y[r], height(map.value(c, r)));
            let corners = [
                corner(column - 1, row - 1),
                corner(column, row - 1),
                corner(column, row),
                corner(column - 1, row),
            ];
            if corners.iter().any(|c| !c.2.is_finite()) {
                continue;
            }
            let mut crossings = Vec::new();
            for at in 0..4 {
                let (a, b) = (corners[at], corners[(at + 1) % 4]);
                if (a.2 > 0.0) != (b.2 > 0.0) {
                    let s = a.2 / (a.2 - b.2);
                    crossings.push([a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1)]);
                }
            }
            // Two crossings, or four at a saddle, where either pairing is right to the grid's resolution.
            segments.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::Axis;

    #[test]
    fn a_plane_has_a_straight_contour() {
        let map = HeatMap {
            x: vec![0.0, 1.0],
            y: vec![0.0, 1.0],
            values: vec![0.0, 1.0, 0.0, 1.0],
            scale: Axis::new("z", ""),
        };
        assert_eq!(segments(&map, 0.25), [[[0.25, 0.0], [0.25, 1.0]]]);
        assert!(segments(&map, 2.0).is_empty());
    }
}
