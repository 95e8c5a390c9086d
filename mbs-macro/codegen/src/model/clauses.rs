//! The clauses of joints, as expressions.

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr};
use proc_macro2::{Ident, Span};

use super::Check;
use super::hints::in_radians;
use super::known::GROUND;
use super::names::Place;
use super::resolver::Resolver;
use crate::diagnostics::Diagnostic;
use crate::mechanics::joints::{Connection, Part};
use crate::syntax::{Clause, Formula, Joint, Vector};

const COINCIDENT: &str = "points that coincide are a `revolute` joint";

/// A size of a transmission, which has to be positive.
struct Size {
    property: &'static str,
    /// With its article.
    words: &'static str,
    dimension: Dimension,
}

const RADIUS: Size = Size { property: "radius", words: "the radius", dimension: Dimension::LENGTH };

const RADII: [Size; 2] = [
    Size { property: "first radius", words: "a radius", dimension: Dimension::LENGTH },
    Size { property: "second radius", words: "a radius", dimension: Dimension::LENGTH },
];

const TEETH: [Size; 2] = [
    Size { property: "first number of teeth", words: "a number of teeth", dimension: Dimension::NONE },
    Size { property: "second number of teeth", words: "a number of teeth", dimension: Dimension::NONE },
];

impl Resolver<'_> {
    /// A joint with its places and clauses; `None` if one has errors, which are
    /// added. All of them are read, so that all errors are.
    pub(super) fn connection(&mut self, joint: &Joint) -> Option<Connection> {
        let first = self.scope.attachment(&joint.first, &mut self.errors);
        let second = self.scope.attachment(&joint.second, &mut self.errors);
        let places = first.zip(second);
        let (zero, one) = (self.scope.arena.zero(), self.scope.arena.one());
        let (mut along, mut at, mut value) = (Some([one, zero]), Some(zero), Some(zero));
        let (mut sizes, mut unit, mut carrier) = (Some([one; 2]), Dimension::LENGTH, Some(zero));
        for clause in &joint.clauses {
            match clause {
                Clause::Along(vector) => along = self.direction_of(&joint.name, vector),
                Clause::Angle(formula) => at = self.angle_between(formula),
                Clause::Place(formula) => {
                    let what = ("the place at which the angles are equal", Dimension::LENGTH);
                    at = self.scope.formula_of(formula, Place::Property, what, &mut self.errors);
                }
                Clause::Profile(formula) => {
                    value = places.and_then(|(first, second)| {
                        let algebra = Algebra::new(&mut self.scope.arena);
                        let angle = first.on(&algebra).polar_angle_of(second.on(&algebra)).expr();
                        self.polar_profile(joint, formula, angle)
                    });
                }
                Clause::Distance(formula) => value = self.distance_of(joint, formula),
                Clause::Radius(formula) => {
                    sizes = self.size(joint, formula, &RADIUS).map(|radius| [radius; 2]);
                }
                Clause::Radii(vector) => sizes = self.pair(joint, vector, &RADII),
                Clause::Teeth(vector) => {
                    unit = Dimension::NONE;
                    let teeth = self.pair(joint, vector, &TEETH);
                    let ratio = teeth.and_then(|[first, second]| self.scope.arena.div(second, first));
                    sizes = ratio.map(|ratio| [one, ratio]);
                }
                Clause::Carrier(body) => carrier = self.body_angle(body),
            }
        }
        let (first, second) = places?;
        let connection = Connection {
            first,
            second,
            along: along?.into(),
            at: at?,
            value: value?,
            sizes: sizes?,
            unit,
            carrier: carrier?,
        };
        self.turns(joint, &connection).then_some(connection)
    }

    /// A direction: two numbers or lengths, not both 0.
    pub(super) fn direction_of(&mut self, name: &Ident, vector: &Vector) -> Option<[Expr; 2]> {
        let x = self.scope.formula(&vector.x, Place::Property, &mut self.errors);
        let y = self.scope.formula(&vector.y, Place::Property, &mut self.errors);
        let (x, y) = (x?, y?);
        if let (Some(a), Some(b)) = (x.dimension, y.dimension)
            && a != b
        {
            self.errors.push(
                Diagnostic::new(vector.span, format!("the direction of `{name}` mixes dimensions"))
                    .help("give both components in the same unit, or both as numbers"),
            );
            return None;
        }
        if self.scope.arena.is_zero(x.expr) && self.scope.arena.is_zero(y.expr) {
            self.errors.push(
                Diagnostic::new(vector.span, format!("the direction of `{name}` is zero"))
                    .help("write `(1, 0)` for x, `(0, 1)` for y"),
            );
            return None;
        }
        Some([x.expr, y.expr])
    }

    fn angle_between(&mut self, formula: &Formula) -> Option<Expr> {
        self.errors.take(in_radians(formula))?;
        let what = ("the angle between the bodies", Dimension::NONE);
        self.scope.formula_of(formula, Place::Property, what, &mut self.errors)
    }

    fn distance_of(&mut self, joint: &Joint, formula: &Formula) -> Option<Expr> {
        let what = ("the distance", Dimension::LENGTH);
        let length = self.scope.formula_of(formula, Place::Property, what, &mut self.errors)?;
        if self.scope.arena.is_zero(length) {
            let message = format!("the distance of `{}` is 0", joint.name);
            self.errors.push(Diagnostic::new(formula.span, message).help(COINCIDENT));
            return None;
        }
        self.is_positive(joint, "distance", length, formula.span);
        Some(length)
    }

    /// Requires that a value is positive, at compile time and at run time.
    fn is_positive(&mut self, joint: &Joint, property: &'static str, value: Expr, span: Span) {
        let zero_help = (property == "distance").then_some(COINCIDENT);
        let owner = joint.name.to_string();
        self.checks.push(Check { value, is_strict: true, property, owner, span, zero_help });
    }

    /// A radius or a number of teeth: positive.
    fn size(&mut self, joint: &Joint, formula: &Formula, size: &Size) -> Option<Expr> {
        let what = format!("{} of `{}`", size.words, joint.name);
        let value =
            self.scope.formula_of(formula, Place::Property, (&what, size.dimension), &mut self.errors)?;
        let Some(number) = self.scope.arena.as_number(value) else {
            self.is_positive(joint, size.property, value, formula.span);
            return Some(value);
        };
        let (fault, help) = if number.is_zero() || number.is_negative() {
            let fault = if number.is_zero() { "0" } else { "negative" };
            (fault, "it has to be positive; the kind of joint says which way the bodies turn")
        } else if size.dimension == Dimension::NONE && number.as_integer().is_none() {
            ("not a whole number", "teeth are counted; any other ratio is one of `radii`")
        } else {
            return Some(value);
        };
        self.errors.push(Diagnostic::new(formula.span, format!("{what} is {fault}")).help(help));
        None
    }

    fn pair(&mut self, joint: &Joint, vector: &Vector, sizes: &[Size; 2]) -> Option<[Expr; 2]> {
        let first = self.size(joint, &vector.x, &sizes[0]);
        let second = self.size(joint, &vector.y, &sizes[1]);
        Some([first?, second?])
    }

    fn body_angle(&mut self, body: &Ident) -> Option<Expr> {
        let frame = self.scope.frame(body).map(|frame| frame.angle);
        self.errors.take(frame)
    }

    /// Returns true if all parts that a joint turns can turn; reports the others.
    fn turns(&mut self, joint: &Joint, connection: &Connection) -> bool {
        let mut all = true;
        for &(part, against) in joint.kind.turns {
            let angle = connection.angle(part);
            let relative = self.scope.arena.sub(angle, connection.angle(against));
            if self.coordinates_in(relative) == 0 {
                self.errors.push(still(joint, (part, against), self.coordinates_in(angle) > 0));
                all = false;
            }
        }
        all
    }
}

/// The error for a body that does not turn relative to what it should.
fn still(joint: &Joint, (part, against): (Part, Part), has_angle: bool) -> Diagnostic {
    let name = &joint.name;
    let body = if part == Part::First { &joint.first.body } else { &joint.second.body };
    if has_angle {
        return Diagnostic::new(body.span(), format!("`{body}` cannot turn relative to itself"))
            .help(format!("`{name}` connects two bodies; a carrier is a third one"));
    }
    let help = match (body == GROUND, against) {
        (true, Part::Carrier) => {
            "what meshes with the ground needs a carrier that turns: `carrier arm`".to_owned()
        }
        (true, _) => "the first place is that of the body that turns".to_owned(),
        (false, _) => format!("give it an angle: `body {body} (angle = phi) {{ inertia = …; }}`"),
    };
    Diagnostic::new(body.span(), format!("`{body}` does not turn, as `{name}` needs")).help(help)
}
