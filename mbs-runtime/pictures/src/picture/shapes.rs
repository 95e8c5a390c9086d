//! From a sketch to shapes: which body looks how, and what is drawn at joints.
//!
//! The figure (`figure/mechanism.rs`) and the page (`html/mechanism.js`) draw the same ones.

use std::collections::BTreeSet;

use mbs_runtime::Sketch;
use mbs_runtime::sketch::{Body, Joint, Spring};

use super::geometry::{distance, outline};
use super::{Picture, Shape};

/// Places nearer to each other than this part of the whole coincide.
const SAME: f64 = 2e-3;
/// More paths than this would cover the mechanism.
const MOST_TRACES: usize = 8;
/// Of more bodies than this, centres of mass and names would cover the rest.
const MOST_DETAILED: usize = 14;

/// Adds the shapes of a sketch to a picture that has its points.
pub(super) fn draw(sketch: &Sketch, picture: &mut Picture) {
    let mut maker = Maker::new(sketch, picture);
    sketch.joints.iter().for_each(|joint| maker.joint(joint));
    sketch.springs.iter().for_each(|spring| maker.spring(spring));
    if picture.points.len() > 1 {
        maker.found();
    }
    for (colour, body) in sketch.bodies.iter().enumerate() {
        maker.body(body, colour);
    }
    for &at in sketch.particles {
        let colour = maker.colour_of(at).unwrap_or(0);
        maker.shapes.push(Shape::Dot { at, colour });
    }
    let Maker { mut shapes, traced, weight, .. } = maker;
    shapes.sort_by_key(layer);
    shapes.dedup();
    (picture.shapes, picture.traced, picture.weight) = (shapes, traced, weight);
}

/// The layer of a shape. Higher layers lie in front of lower ones.
fn layer(shape: &Shape) -> u8 {
    match shape {
        Shape::Rail { .. } => 0,
        Shape::Ground { .. } => 1,
        Shape::Link { .. } | Shape::Circle { .. } => 2,
        Shape::Spring { .. } => 3,
        Shape::Block { .. } => 4,
        Shape::Plate { .. } => 5,
        Shape::Bar { .. } => 6,
        Shape::Dot { .. } => 7,
        Shape::Coil { .. } | Shape::Mark { .. } => 8,
        Shape::Centre { .. } => 9,
        Shape::Weld { .. } | Shape::Pin { .. } => 10,
        Shape::Label { .. } => 11,
    }
}

struct Maker<'a> {
    sketch: &'a Sketch,
    picture: &'a Picture,
    shapes: Vec<Shape>,
    traced: Vec<(usize, usize)>,
    weight: f64,
    /// Points at which something is joined.
    joined: BTreeSet<usize>,
    /// Points that blocks are drawn at.
    blocks: BTreeSet<usize>,
    /// Per point, the body that it belongs to; `None` for the ground.
    owner: Vec<Option<usize>>,
    /// Size of the mechanism with its motion.
    span: f64,
}

impl<'a> Maker<'a> {
    fn new(sketch: &'a Sketch, picture: &'a Picture) -> Self {
        let mut owner = vec![None; sketch.points.len()];
        for (at, body) in sketch.bodies.iter().enumerate() {
            for &point in body.points {
                if let Some(owner) = owner.get_mut(point) {
                    *owner = Some(at);
                }
            }
        }
        let bodies = || sketch.bodies.iter().flat_map(|body| body.points);
        let all = picture.points.iter().flat_map(|places| bodies().filter_map(|&point| places.get(point)));
        let span = super::Extent::around(all.copied()).map_or(0.0, |extent| extent.span());
        let mut maker = Self {
            sketch,
            picture,
            shapes: Vec::new(),
            traced: Vec::new(),
            weight: 1.0,
            joined: BTreeSet::new(),
            blocks: BTreeSet::new(),
            owner,
            span,
        };
        maker.weight = maker.weight();
        maker.traced = maker.traced();
        maker
    }

    /// 1 where a typical body is long enough for its joints to be told apart.
    fn weight(&self) -> f64 {
        let length = |body: &Body| {
            let [a, b] = [0, 1].map(|end| self.outline(body).get(end).copied());
            Some(distance(self.picture.place(0, a?), self.picture.place(0, b?)))
        };
        let mut lengths: Vec<f64> = self.sketch.bodies.iter().filter_map(length).collect();
        lengths.sort_by(f64::total_cmp);
        let typical = lengths.get(lengths.len() / 3).copied().unwrap_or(self.span);
        if self.span > 0.0 { (typical / (0.07 * self.span)).clamp(0.35, 1.0) } else { 1.0 }
    }

    /// The ends or corners of a body; of one that bends, its points in order.
    fn outline(&self, body: &Body) -> Vec<usize> {
        if !body.is_rigid {
            return body.points.to_vec();
        }
        let places: Vec<_> = body.points.iter().map(|&point| self.picture.place(0, point)).collect();
        outline(&places, SAME * self.span).into_iter().filter_map(|at| body.points.get(at).copied()).collect()
    }

    fn colour_of(&self, point: usize) -> Option<usize> {
        self.owner.get(point).copied().flatten()
    }

    /// The body of a point, or of a place of an outline, which is named after its body.
    fn body_of(&self, point: usize) -> Option<usize> {
        let body = self.sketch.points.get(point).and_then(|name| name.split('.').next());
        self.colour_of(point).or_else(|| self.sketch.bodies.iter().position(|it| Some(it.name) == body))
    }

    /// The larger distance that a point gets from where it starts.
    fn travel(&self, point: usize) -> f64 {
        let start = self.picture.place(0, point);
        let all = 0..self.picture.points.len();
        all.map(|at| distance(self.picture.place(at, point), start)).fold(0.0, f64::max)
    }

    /// Paths of the points that nothing holds, such as a coupler's; of the
    /// centres where there are none.
    fn traced(&self) -> Vec<(usize, usize)> {
        let links = self.sketch.joints.iter().map(|joint| [joint.first, joint.second]);
        let springs = self.sketch.springs.iter().map(|spring| [spring.first, spring.second]);
        let held: Vec<usize> = links.chain(springs).flatten().collect();
        let is_alone = |point: &usize| {
            !held.iter().any(|&other| self.are_together(*point, other))
                && !self.sketch.bodies.iter().flat_map(|body| body.points).any(|&other| {
                    other != *point
                        && self.owner[other] != self.owner[*point]
                        && self.are_together(*point, other)
                })
        };
        let with_colour = |points: &mut dyn Iterator<Item = usize>| {
            let moving = points.filter(|&point| self.travel(point) > 0.01 * self.span);
            moving.map(|point| (point, self.colour_of(point).unwrap_or(0))).collect::<Vec<_>>()
        };
        let bodies = || self.sketch.bodies.iter();
        let named = &mut bodies().flat_map(|body| body.points.iter().skip(1).copied()).filter(is_alone);
        let mut traced = with_colour(named);
        if traced.is_empty() {
            traced = with_colour(&mut bodies().filter_map(|body| body.points.first().copied()));
        }
        let surplus = traced.len().saturating_sub(MOST_TRACES);
        traced.split_off(surplus)
    }

    /// True if two points coincide at every instant.
    fn are_together(&self, a: usize, b: usize) -> bool {
        let all = 0..self.picture.points.len();
        all.into_iter()
            .all(|at| distance(self.picture.place(at, a), self.picture.place(at, b)) <= SAME * self.span)
    }

    /// Marks ends on the ground as fixed.
    fn ends(&mut self, ends: [usize; 2]) {
        for at in ends {
            self.joined.insert(at);
            if self.colour_of(at).is_none() {
                self.shapes.push(Shape::Ground { at });
            }
        }
    }

    fn joint(&mut self, joint: &Joint) {
        let Joint { first, second, .. } = *joint;
        let between = [first, second];
        match (joint.kind, joint.ahead) {
            ("revolute", _) => {
                self.ends(between);
                self.shapes.push(Shape::Pin { at: first });
            }
            ("fixed", _) => {
                self.ends(between);
                self.shapes.push(Shape::Weld { at: first });
            }
            ("distance", _) => {
                self.ends(between);
                self.shapes.push(Shape::Link { between });
                self.shapes.extend(between.map(|at| Shape::Pin { at }));
            }
            ("prismatic" | "point_on_line" | "pin_slot", Some(ahead)) => {
                self.joined.extend(between);
                let reach = self.reach(first, second, ahead);
                let colour = self.colour_of(first).or(self.colour_of(second)).unwrap_or(0);
                self.blocks.insert(first);
                self.shapes.push(Shape::Rail { from: second, ahead, reach });
                self.shapes.push(Shape::Block { at: first, from: second, ahead, colour });
                if joint.kind != "prismatic" {
                    self.shapes.push(Shape::Pin { at: first });
                }
            }
            ("circle" | "bore", _) => {
                self.joined.extend(between);
                self.shapes.push(Shape::Circle { at: first, rim: second, colour: self.colour_of(first) });
            }
            ("segment", _) => {
                self.joined.extend(between);
                match self.body_of(first) {
                    // the edges of a polygon are those of the plate
                    Some(_) if between.iter().all(|at| self.colour_of(*at).is_some()) => {}
                    Some(colour) => self.shapes.push(Shape::Bar { between, colour }),
                    None => self.shapes.push(Shape::Link { between }),
                }
            }
            ("line", _) => {
                self.joined.extend(between);
                let reach = [-0.6 * self.span, 0.6 * self.span];
                self.shapes.push(Shape::Rail { from: first, ahead: second, reach });
            }
            (kind, _) => self.mark(between, kind),
        }
    }

    /// Something that has no shape of its own.
    fn mark(&mut self, between: [usize; 2], kind: &str) {
        self.joined.extend(between);
        self.shapes.push(Shape::Mark { between, text: kind.replace('_', " ") });
    }

    /// The part of a line on which a point slides during the run, and some more;
    /// on a moving body, up to the point through which the line goes.
    fn reach(&self, first: usize, second: usize, ahead: usize) -> [f64; 2] {
        let position = |instant: usize| {
            let ([x, y], [x0, y0]) =
                (self.picture.place(instant, first), self.picture.place(instant, second));
            let [u, v] = self.picture.direction(instant, second, ahead);
            (x - x0) * u + (y - y0) * v
        };
        let positions = (0..self.picture.points.len()).map(position);
        let attached = self.colour_of(second).map(|_| 0.0);
        let (low, high) = positions
            .chain(attached)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| (low.min(s), high.max(s)));
        let more = 0.06 * self.span.max(high - low);
        if low <= high { [low - more, high + more] } else { [0.0, 0.0] }
    }

    fn spring(&mut self, spring: &Spring) {
        let between = [spring.first, spring.second];
        match spring.kind {
            "rope" => {
                self.ends(between);
                self.shapes.push(Shape::Link { between });
            }
            "bushing" => {
                self.ends(between);
                self.shapes.push(Shape::Coil { at: spring.second });
            }
            "spring" | "force" | "strut" => {
                self.ends(between);
                self.shapes.push(Shape::Spring { between });
            }
            "torsion_spring" => {
                self.shapes.push(Shape::Coil { at: self.hinge(between) });
            }
            // outlines are drawn where they are
            "contact" => self.joined.extend(between),
            kind => self.mark(between, kind),
        }
    }

    /// Where a spring between two angles is drawn: at the joint of its bodies if
    /// they have one, else at the point of a body.
    fn hinge(&self, [first, second]: [usize; 2]) -> usize {
        let bodies = [self.colour_of(first), self.colour_of(second)];
        let of = |joint: &&Joint| {
            let joined = [self.colour_of(joint.first), self.colour_of(joint.second)];
            joint.kind == "revolute" && (joined == bodies || joined == [bodies[1], bodies[0]])
        };
        let joint = self.sketch.joints.iter().find(of).map(|joint| joint.first);
        joint.unwrap_or(if bodies[0].is_some() { first } else { second })
    }

    /// Joints that are written as equations are not known, but seen: points of
    /// two bodies that stay together, and points about which a body turns.
    fn found(&mut self) {
        let bodies = self.sketch.bodies;
        for (at, body) in bodies.iter().enumerate() {
            for &point in body.points.iter().filter(|point| !self.joined.contains(point)) {
                let others = bodies.iter().skip(at + 1).flat_map(|other| other.points.iter());
                if let Some(_together) = others.copied().find(|&other| self.are_together(point, other)) {
                    self.shapes.push(Shape::Pin { at: point });
                }
                let turns = body.points.iter().any(|&other| self.travel(other) > 0.01 * self.span);
                if turns && self.travel(point) <= 1e-6 * self.span {
                    self.shapes.extend([Shape::Ground { at: point }, Shape::Pin { at: point }]);
                }
            }
        }
    }

    fn body(&mut self, body: &Body, colour: usize) {
        let outline = self.outline(body);
        let is_detailed = self.sketch.bodies.len() <= MOST_DETAILED;
        let centre = body.points.first().copied();
        match outline[..] {
            [] => return,
            [_] => {
                if let Some(at) = centre.filter(|_| !body.points.iter().any(|at| self.blocks.contains(at))) {
                    self.shapes.push(Shape::Dot { at, colour });
                }
            }
            [a, b] => self.shapes.push(Shape::Bar { between: [a, b], colour }),
            _ if !body.is_rigid => {
                let bars = outline.windows(2).filter_map(|pair| pair.first_chunk().copied());
                self.shapes.extend(bars.map(|between| Shape::Bar { between, colour }));
            }
            _ => self.shapes.push(Shape::Plate { corners: outline.clone(), colour }),
        }
        let is_plain = |at: usize| {
            let place = self.picture.place(0, at);
            let joined =
                self.shapes.iter().filter(|shape| matches!(shape, Shape::Pin { .. } | Shape::Weld { .. }));
            let mut joints = joined.flat_map(Shape::points).chain(self.joined.iter().copied());
            joints.all(|other| distance(self.picture.place(0, other), place) > SAME * self.span)
        };
        if let Some(at) = centre.filter(|&at| is_detailed && outline.len() > 1 && is_plain(at)) {
            self.shapes.push(Shape::Centre { at });
        }
        if is_detailed {
            self.shapes.push(Shape::Label { text: body.name.to_owned(), near: outline, colour });
        }
    }
}
