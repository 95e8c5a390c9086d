//! The sketch of the mechanism: the points of bodies, and the links between
//! them. It is read once everything else is, so that it cannot change the equations.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Arena, Expr, Number, Scalar, Stage, Vector};
use proc_macro2::Ident;

use super::Direction;
use super::known::GROUND;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::Diagnostics;
use crate::mechanics::{Outline, Placed};
use crate::syntax::{Attachment, Clause, Declaration, Item, ItemKind};

/// An arc is drawn by so many chords.
const CHORDS: i64 = 12;

/// Points of bodies and pairs of them.
#[derive(Default)]
pub struct Sketch {
    pub points: Vec<Point>,
    /// The bodies, and behind them the points of the ground that move, each as one.
    pub bodies: Vec<Body>,
    /// The points of the ground, the origin first.
    pub ground: Vec<usize>,
    /// Where particles are.
    pub particles: Vec<usize>,
    pub joints: Vec<Link>,
    pub springs: Vec<Link>,
}

/// A body with its points, its centre first.
#[derive(Clone)]
pub struct Body {
    pub name: String,
    pub points: Vec<usize>,
    /// False if a point of it moves on it.
    pub is_rigid: bool,
}

/// A point with its place on a body.
pub struct Point {
    pub name: String,
    pub origin: [Expr; 2],
    pub angle: Expr,
    /// Its place on the body; `None` for the origin of the body itself.
    pub local: Option<[Expr; 2]>,
}

/// A joint or a spring between two points.
pub struct Link {
    pub name: String,
    /// The word that declares it.
    pub kind: &'static str,
    pub first: usize,
    pub second: usize,
    /// A point ahead of the second one in the direction of a joint.
    pub ahead: Option<usize>,
}

impl Sketch {
    /// x and y of every point, in the ground frame.
    pub fn places(&self, arena: &mut Arena) -> Vec<Expr> {
        let algebra = Algebra::new(arena);
        let place = |point: &Point| {
            let Some(local) = point.local else { return point.origin };
            let origin = Placed { position: point.origin.into(), angle: point.angle };
            origin.on(&algebra).point(algebra.vector(local)).position.exprs()
        };
        self.points.iter().flat_map(place).collect()
    }
}

/// Positions of points by body and name, that of a centre by its body alone.
type Known = BTreeMap<(String, Option<String>), usize>;

impl Resolver<'_> {
    /// The sketch of a declaration without errors; of one with errors, a part of it.
    pub(super) fn sketch(&mut self, declaration: &Declaration) -> Sketch {
        let mut sketch = Sketch::default();
        let mut known = Known::new();
        let mut declared: BTreeMap<String, Vec<&Ident>> = BTreeMap::new();
        for item in &declaration.items {
            if let ItemKind::Point { name, body, .. } = &item.kind {
                declared.entry(body.to_string()).or_default().push(name);
            }
        }
        let bodies: Vec<String> = self.bodies.iter().map(|body| body.name.clone()).collect();
        for body in bodies {
            let points = self.sketch_points(&body, &declared, &mut sketch, &mut known);
            let is_rigid = !points.iter().any(|&at| self.moves(&sketch.points[at]));
            sketch.bodies.push(Body { name: body, points, is_rigid });
        }
        let ground = self.sketch_points(GROUND, &declared, &mut sketch, &mut known);
        let (moving, ground): (Vec<usize>, _) =
            ground.into_iter().partition(|&at| self.moves(&sketch.points[at]));
        sketch.ground = ground;
        for at in moving {
            let name = sketch.points[at].name.clone();
            sketch.bodies.push(Body { name, points: vec![at], is_rigid: true });
        }
        for at in 0..self.bodies.len() {
            self.sketch_guide(at, &mut sketch);
        }
        for item in &declaration.items {
            self.sketch_link(item, &known, &mut sketch);
            self.sketch_outline(item, &known, &mut sketch);
        }
        sketch
    }

    /// True if a point moves on its body.
    fn moves(&self, point: &Point) -> bool {
        let arena = &self.scope.arena;
        point.local.is_some_and(|local| local.into_iter().any(|x| arena.stage(x) == Stage::Variable))
    }

    /// A body that lacks coordinates is guided by the ground: one that has x
    /// alone slides on the x axis, one that has an angle alone turns about the
    /// origin.
    fn sketch_guide(&self, body: usize, sketch: &mut Sketch) {
        let centre = sketch.bodies.get(body).and_then(|body| body.points.first().copied());
        let Some(body) = self.bodies.get(body) else { return };
        let has = |direction| {
            body.coordinates.iter().any(|&at| self.coordinates[at].direction() == Some(direction))
        };
        let (zero, one) = (self.scope.arena.zero(), self.scope.arena.one());
        let (kind, along) = match [Direction::X, Direction::Y, Direction::Angle].map(has) {
            [true, false, false] => ("prismatic", Some([one, zero])),
            [false, true, false] => ("prismatic", Some([zero, one])),
            [true, false, true] => ("point_on_line", Some([one, zero])),
            [false, true, true] => ("point_on_line", Some([zero, one])),
            [false, false, true] => ("revolute", None),
            _ => return,
        };
        let (Some(first), Some(&second)) = (centre, sketch.ground.first()) else { return };
        let ahead = along.map(|origin| {
            let name = format!("{}.ahead", body.name);
            sketch.points.push(Point { name, origin, angle: zero, local: None });
            sketch.points.len() - 1
        });
        sketch.joints.push(Link { name: body.name.clone(), kind, first, second, ahead });
    }

    /// Adds the points of a body and gives their positions.
    fn sketch_points(
        &self,
        body: &str,
        declared: &BTreeMap<String, Vec<&Ident>>,
        sketch: &mut Sketch,
        known: &mut Known,
    ) -> Vec<usize> {
        let Some(frame) = self.scope.bodies.get(body) else { return Vec::new() };
        let named = declared.get(body).into_iter().flatten().map(|name| Some(name.to_string()));
        let mut positions = Vec::new();
        for name in [None].into_iter().chain(named) {
            let local = name.as_ref().and_then(|name| frame.local(name));
            let text = name.as_ref().map_or_else(|| body.to_owned(), |name| format!("{body}.{name}"));
            known.insert((body.to_owned(), name), sketch.points.len());
            positions.push(sketch.points.len());
            sketch.points.push(Point { name: text, origin: frame.origin, angle: frame.angle, local });
        }
        positions
    }

    /// Adds the outline about a point, as links from places of its body to others: each shows an edge, or a size.
    fn sketch_outline(&mut self, item: &Item, known: &Known, sketch: &mut Sketch) {
        let ItemKind::Point { name, body, .. } = &item.kind else { return };
        let place = Attachment::of_path(body.clone(), vec![name.clone()]);
        let Some(&first) = known.get(&(body.to_string(), Some(name.to_string()))) else { return };
        let Some(outline) = self.outline_at(&place) else { return };
        let zero = self.scope.arena.zero();
        let Point { origin, angle, local, .. } = sketch.points[first];
        let local = local.unwrap_or([zero; 2]);
        // a plate has the corners of a polygon
        let is_plate = matches!(outline, Outline::Polygon { .. });
        for (kind, path) in self.paths(outline) {
            let mut corners: Vec<usize> = if path.len() == 1 { vec![first] } else { Vec::new() };
            for away in path {
                let arena = &mut self.scope.arena;
                let local = Some([arena.add(local[0], away[0]), arena.add(local[1], away[1])]);
                let name = format!("{body}.{name}.{kind}");
                corners.push(sketch.points.len());
                sketch.points.push(Point { name, origin, angle, local });
            }
            if let Some(of) = sketch.bodies.iter_mut().find(|of| is_plate && *body == of.name) {
                of.points.extend(corners.iter().skip(1));
            }
            for (&first, &second) in corners.iter().zip(corners.iter().skip(1)) {
                sketch.joints.push(Link { name: name.to_string(), kind, first, second, ahead: None });
            }
        }
    }

    /// The lines of an outline, and what each is drawn as: from its place to one that is so far away, or through several.
    fn paths(&mut self, outline: Outline) -> Vec<(&'static str, Vec<[Expr; 2]>)> {
        let zero = self.scope.arena.zero();
        match outline {
            Outline::Circle { radius } if radius == zero => Vec::new(),
            Outline::Circle { radius } => vec![("circle", vec![[radius, zero]])],
            Outline::Bore { radius } => vec![("bore", vec![[radius, zero]])],
            Outline::Line { along } => vec![("line", vec![along.components()])],
            Outline::Segment { way, .. } => vec![("segment", vec![way.components()])],
            Outline::Arc { radius, middle, half } => vec![("segment", self.chords(radius, middle, half))],
            Outline::Polygon { ways, .. } => {
                let place = [[zero; 2]];
                let corners = ways.into_iter().map(Vector::components);
                vec![("segment", place.into_iter().chain(corners).chain(place).collect())]
            }
            Outline::Slot { along, half } => {
                let algebra = Algebra::new(&mut self.scope.arena);
                let (along, half) = (algebra.vector(along.components()), algebra.scalar(half));
                let aside = half / along.norm() * along.perpendicular();
                [aside, -aside].map(|aside| ("line", vec![aside.exprs(), (aside + along).exprs()])).into()
            }
        }
    }

    /// The ends of chords of an arc, from its centre.
    fn chords(&mut self, radius: Expr, middle: Expr, half: Expr) -> Vec<[Expr; 2]> {
        let algebra = Algebra::new(&mut self.scope.arena);
        let [radius, middle, half] = [radius, middle, half].map(|x| algebra.scalar(x));
        let end = |at: i64| {
            let share = Number::ratio(2 * at - CHORDS, CHORDS);
            let angle = middle + half * algebra.number(share);
            [radius * angle.cos(), radius * angle.sin()].map(Scalar::expr)
        };
        (0..=CHORDS).map(end).collect()
    }

    /// Adds a joint, a spring or a particle; of other statements, nothing.
    fn sketch_link(&mut self, item: &Item, known: &Known, sketch: &mut Sketch) {
        let (name, kind, first, second, along) = match &item.kind {
            ItemKind::Joint(joint) => {
                let along = joint.clauses.iter().find_map(|clause| match clause {
                    Clause::Along(vector) => Some(vector),
                    _ => None,
                });
                (&joint.name, joint.kind.word, &joint.first, &joint.second, along)
            }
            ItemKind::Element(element) => {
                let Some(second) = &element.second else { return };
                (&element.name, element.kind.word, &element.first, second, None)
            }
            ItemKind::Particle { at, .. } => {
                let at = self.scope.on_body(at);
                let point = at.point.as_ref().map(Ident::to_string);
                sketch.particles.extend(known.get(&(at.body.to_string(), point)));
                return;
            }
            _ => return,
        };
        let position = |place: &Attachment| {
            let place = self.scope.on_body(place);
            let point = place.point.as_ref().map(Ident::to_string);
            known.get(&(place.body.to_string(), point)).copied()
        };
        let (Some(first), Some(second)) = (position(first), position(second)) else { return };
        // Errors of a direction have been reported already.
        let errors = &mut Diagnostics::default();
        let along = along.and_then(|vector| {
            let x = self.scope.formula(&vector.x, Place::Property, errors)?;
            let y = self.scope.formula(&vector.y, Place::Property, errors)?;
            Some([x.expr, y.expr])
        });
        let ahead = along.map(|along| {
            let Point { origin, angle, local, .. } = sketch.points[second];
            let local = local.unwrap_or([self.scope.arena.zero(); 2]);
            let arena = &mut self.scope.arena;
            let local = [arena.add(local[0], along[0]), arena.add(local[1], along[1])];
            sketch.points.push(Point { name: format!("{name}.ahead"), origin, angle, local: Some(local) });
            sketch.points.len() - 1
        });
        let link = Link { name: name.to_string(), kind, first, second, ahead };
        match &item.kind {
            ItemKind::Element(_) => sketch.springs.push(link),
            _ => sketch.joints.push(link),
        }
    }
}
