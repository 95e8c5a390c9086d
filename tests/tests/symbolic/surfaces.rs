//! Functions over a grid, inside and outside of it, with their derivatives, beside SciPy.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_symbolic::Interpolation::{self, Cubic, Linear, Monotone, Step};
use mbs_symbolic::Outside::{self, Extend, Hold, Periodic, Refuse};
use mbs_symbolic::{Arena, Expr, Grid, Stage, Symbol};

/// Beyond rounding of twenty terms of 65, and of a place behind five rows.
const ROUNDING: f64 = 4000.0 * f64::EPSILON;

fn grid() -> Grid {
    let values = [
        [1.0, -2.0, 0.5, 3.0],
        [0.0, 1.5, 2.5, -1.0],
        [2.0, 2.0, -3.0, 0.25],
        [1.0, 0.0, -1.0, 4.0],
        [-2.0, 0.5, 1.0, 1.0],
    ];
    Grid { x: vec![0.0, 0.4, 1.0, 1.1, 2.5], y: vec![-1.0, 0.5, 0.7, 2.0], values: values.concat() }
}

/// A surface with its derivatives by x and y.
struct Graph {
    arena: Arena,
    symbols: [Symbol; 2],
    roots: [Expr; 3],
}

impl Graph {
    fn new(grid: &Grid, interpolation: Interpolation, outside: [Outside; 2]) -> Self {
        let mut arena = Arena::new();
        let symbols = ["x", "y"].map(|name| arena.symbol(name, Stage::Variable));
        let surface = arena.add_surface("f", grid, interpolation, outside).expect("a grid");
        let arguments = symbols.map(|symbol| arena.variable(symbol));
        let value = arena.surface(&surface, arguments);
        let [by_x, by_y] = symbols.map(|symbol| arena.partial(value, symbol));
        Self { arena, symbols, roots: [value, by_x, by_y] }
    }

    fn at(&self, x: f64, y: f64) -> [f64; 3] {
        let value = |symbol: Symbol| if symbol == self.symbols[0] { x } else { y };
        let found = self.arena.evaluate(&self.roots, &value);
        [found[0], found[1], found[2]]
    }
}

fn same(found: [f64; 3], expected: [f64; 3], what: &str) {
    let is_near = |(found, expected): (f64, f64)| (found - expected).abs() < ROUNDING;
    assert!(found.into_iter().zip(expected).all(is_near), "{what}: {found:?} for {expected:?}");
}

/// `RegularGridInterpolator((x, y), z)` of SciPy 1.17.1.
#[test]
fn a_linear_surface_is_bilinear() {
    let graph = Graph::new(&grid(), Linear, [Refuse; 2]);
    for ([x, y], expected) in [
        ([0.0, -1.0], 1.0),
        ([0.2, 0.6], 0.625),
        ([0.4, 0.5], 1.5),
        ([0.9, 1.3], -1.1025641025641024),
        ([1.05, -0.4], 1.3),
        ([1.7, 0.65], -0.053571428571428825),
        ([2.5, 2.0], 1.0),
        ([2.2, 1.9], 1.5604395604395602),
    ] {
        let [found, ..] = graph.at(x, y);
        assert!((found - expected).abs() < ROUNDING, "({x}, {y}): {found} for {expected}");
    }
    assert!(graph.at(2.6, 0.0)[0].is_nan() && graph.at(1.0, -1.1)[0].is_nan());
}

/// `CubicSpline(y, CubicSpline(x, z, bc_type="natural")(x), bc_type="natural")(y)` of SciPy 1.17.1, and its
/// derivatives.
#[test]
fn a_cubic_surface_is_the_product_of_natural_splines() {
    let graph = Graph::new(&grid(), Cubic, [Hold; 2]);
    for ([x, y], expected) in [
        ([0.2, 0.6], [1.0781480359854256, 7.6964944552916785, 14.098496212489378]),
        ([0.4, 0.5], [1.5, 9.358284409654267, 4.997577225923684]),
        ([0.9, 1.3], [-11.41542789661981, 16.76417234506239, 3.268997431639187]),
        ([1.05, -0.4], [5.009002519228698, -65.13113176283674, 3.4552775231007113]),
        ([1.7, 0.65], [2.6560294116420664, 1.0824826142596, 53.126856982685]),
        ([2.2, 1.9], [8.239427207331895, -21.621708790442455, -9.231711508650761]),
    ] {
        same(graph.at(x, y), expected, &format!("({x}, {y})"));
    }
}

/// Beyond the grid: the value of the nearest point, or the plane that touches the surface there.
#[test]
fn outside_it_is_held_or_goes_on_by_lines() {
    for interpolation in [Linear, Cubic] {
        let held = Graph::new(&grid(), interpolation, [Hold; 2]);
        let extended = Graph::new(&grid(), interpolation, [Extend; 2]);
        let inside = Graph::new(&grid(), interpolation, [Extend, Hold]);
        for (x, y) in [(-0.3_f64, 0.6_f64), (2.9, 1.5), (3.0, 2.5), (-1.0, -2.0)] {
            let (near_x, near_y) = (x.clamp(0.0, 2.5), y.clamp(-1.0, 2.0));
            let corner = held.at(near_x, near_y)[0];
            assert!((held.at(x, y)[0] - corner).abs() < ROUNDING);
            // along y first, then both
            let [_, by_x, by_y] = extended.at(near_x, near_y);
            let across = corner + (y - near_y) * by_y;
            assert!((extended.at(near_x, y)[0] - across).abs() < ROUNDING, "{x} {y}");
            let along = corner + (x - near_x) * by_x;
            assert!((extended.at(x, near_y)[0] - along).abs() < ROUNDING, "{x} {y}");
            assert!((inside.at(x, y)[0] - inside.at(x, near_y)[0]).abs() < ROUNDING, "{x} {y}");
        }
    }
}

/// Along x it repeats, with one value and two derivatives where a period ends; along y it steps.
#[test]
fn periodic_surfaces_close() {
    let Grid { x, y, values } = grid();
    let closed = Grid { x: x[..4].to_vec(), y, values: values[..16].to_vec() };
    let graph = Graph::new(&closed, Cubic, [Periodic(2.5), Hold]);
    for (x, y) in [(0.3, 0.1), (1.05, 1.9), (2.2, -0.7)] {
        for periods in [-3.0, 1.0, 4.0] {
            same(graph.at(x + 2.5 * periods, y), graph.at(x, y), "a period later");
        }
    }
    let [before, behind] = [-1e-9, 1e-9].map(|x| graph.at(x, 0.1));
    assert!((0..3).all(|at| (before[at] - behind[at]).abs() < 1e-6), "{before:?} {behind:?}");
    let steps = Graph::new(&grid(), Step, [Hold; 2]);
    assert_eq!(steps.at(0.5, 0.69), [1.5, 0.0, 0.0]);
    assert_eq!(steps.at(1.0, 0.7), [-3.0, 0.0, 0.0]);
    // the last line of each argument holds as well
    assert_eq!([steps.at(2.5, 0.6)[0], steps.at(3.0, 9.0)[0], steps.at(0.5, 2.0)[0]], [0.5, 1.0, -1.0]);
}

#[test]
fn what_is_no_grid_has_no_surface() {
    let mut arena = Arena::new();
    let Grid { x, y, values } = grid();
    let short = Grid { x: x.clone(), y: y.clone(), values: values[1..].to_vec() };
    let back = Grid { x: x.into_iter().rev().collect(), y, values };
    for (grid, interpolation) in [(&short, Linear), (&back, Linear), (&grid(), Monotone)] {
        assert!(arena.add_surface("f", grid, interpolation, [Hold; 2]).is_none());
    }
}
