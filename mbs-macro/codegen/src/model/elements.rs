//! Force elements: their properties are read and judged here, what comes of them is
//! mechanics.

use std::collections::BTreeMap;

use mbs_symbolic::{Algebra, Expr};
use proc_macro2::{Ident, Span};

use super::hints::in_radians;
use super::known::{KnownJoint, Typed};
use super::names::{Local, Place};
use super::resolver::Resolver;
use super::{Check, Gap};
use crate::diagnostics::{Diagnostic, listing, nearest, two_meanings};
use crate::mechanics::elements::{self, Effects, Freedom, Given, Property, Range, Unsaid};
use crate::mechanics::joints::Holds;
use crate::mechanics::{Outline, Placed};
use crate::syntax::{Attachment, Element, ElementProperty, Formula, FormulaKind, Load};

/// The help for a clearance that comes to 0 without being the number 0.
const NO_PLAY: &str = "it has to be positive; the joint without play is `clearance = 0`, a number";

/// The help for bristles that slide without friction and stick with some.
const NO_FRICTION: &str =
    "what slides without friction has no bristles that stick: leave the largest friction out, or the element";

/// An element with its places found and its properties read.
struct Resolved {
    first: Placed,
    second: Placed,
    along: [Expr; 2],
    values: BTreeMap<&'static str, Vec<Expr>>,
    memories: Option<[Expr; 2]>,
    state: Option<Expr>,
    outlines: [Outline; 2],
    words: BTreeMap<&'static str, &'static str>,
}

impl Resolver<'_> {
    pub(super) fn resolve_element(&mut self, element: &Element) {
        if !self.declare_load(&element.name) {
            return;
        }
        let Some(resolved) = self.resolved(element) else { return };
        if !self.check_place(element, &resolved)
            || !self.check_motion(element, &resolved)
            || !self.check_freedom(element)
        {
            return;
        }
        let mut effects = Effects::new(&self.scope.motion);
        let algebra = Algebra::new(&mut self.scope.arena);
        (element.kind.forces)(&resolved.on(&algebra), &mut effects);
        let Effects { applied, energies, exerts, gap, sticks, state_rate, .. } = effects;
        self.push_forces(&element.name, applied, energies, exerts);
        self.gaps.extend(gap.map(|(distance, free)| Gap { distance, free, name: element.name.clone() }));
        if let Some(sticks) = sticks {
            self.push_friction(&element.name, sticks);
        }
        if let Some(rate) = state_rate {
            self.push_bristle_rate(&element.name, rate);
        }
    }

    fn resolved(&mut self, element: &Element) -> Option<Resolved> {
        let first = self.scope.attachment(&element.first, &mut self.errors);
        let second = match &element.second {
            Some(second) => self.scope.attachment(second, &mut self.errors),
            None => first,
        };
        match first.zip(second) {
            Some((first, second)) => self.scope.locals = self.known(element, first, second),
            // a law in quantities of places that are not there
            None if element
                .kind
                .properties
                .iter()
                .any(|row| row.name == elements::LAW && row.words.is_empty()) =>
            {
                return None;
            }
            None => {}
        }
        let values = self.element_properties(element);
        self.scope.locals.clear();
        let (values, first, second) = (values?, first?, second?);
        let along = match &element.along {
            Some(along) => self.direction_of(&element.name, along)?,
            None => [self.scope.arena.one(), self.scope.arena.zero()],
        };
        let memories = self.friction_memories(element);
        let state = self.bristle(element);
        let outlines = [
            self.outline_at(&element.first)?,
            self.outline_at(element.second.as_ref().unwrap_or(&element.first))?,
        ];
        Some(Resolved { first, second, along, values, memories, state, outlines, words: words_of(element) })
    }

    /// The names that properties of an element know beside others.
    fn known(&mut self, element: &Element, first: Placed, second: Placed) -> Vec<Local> {
        let along = [self.scope.arena.one(), self.scope.arena.zero()];
        let outlines = [self.scope.arena.zero(); 2].map(|radius| Outline::Circle { radius });
        let (values, words) = (BTreeMap::new(), BTreeMap::new());
        let resolved =
            Resolved { first, second, along, values, memories: None, state: None, outlines, words };
        let effects = Effects::new(&self.scope.motion);
        let algebra = Algebra::new(&mut self.scope.arena);
        let on = resolved.on(&algebra);
        let local = |known: &elements::Known| Local {
            name: known.name,
            typed: Typed { expr: (known.value)(&on, &effects).expr(), dimension: Some(known.dimension) },
        };
        element.kind.knows.iter().map(local).collect()
    }

    /// Refuses a name that means something of the element here, and something else elsewhere.
    fn check_ambiguous(&mut self, element: &Element, formula: &Formula) -> Option<()> {
        let locals = &self.scope.locals;
        let is_local = |name: &Ident| locals.iter().any(|local| *name == local.name);
        let mut names = formula.names().into_iter().filter(|name| is_local(name));
        let Some((name, span)) =
            names.find_map(|name| Some((name, self.scope.values.get(&name.to_string())?.span())))
        else {
            return Some(());
        };
        self.errors.push(two_meanings(name, element.kind.word, span));
        None
    }

    fn element_properties(&mut self, element: &Element) -> Option<BTreeMap<&'static str, Vec<Expr>>> {
        let known = element.kind.properties;
        let mut values = BTreeMap::new();
        let mut given: BTreeMap<String, Span> = BTreeMap::new();
        let mut is_complete = true;
        for property in &element.properties {
            let text = property.name.to_string();
            let what = format!("the {text} of `{}`", element.name);
            if let Some(earlier) = given.insert(text.clone(), property.name.span()) {
                self.repeated(&what, property.name.span(), earlier);
                is_complete = false;
                continue;
            }
            let Some(row) = known.iter().find(|row| row.name == text) else {
                self.errors.push(unknown_property(element, &property.name));
                is_complete = false;
                continue;
            };
            if !row.words.is_empty() {
                is_complete &= self.errors.take(word_of(row, property, &what)).is_some();
                continue;
            }
            match self.property_value(element, row, property) {
                Some(value) => drop(values.insert(row.name, value)),
                None => is_complete = false,
            }
        }
        if is_complete {
            let said = is_said(element);
            self.errors.take(said);
        }
        is_complete.then_some(values)
    }

    fn property_value(
        &mut self,
        element: &Element,
        row: &Property,
        property: &ElementProperty,
    ) -> Option<Vec<Expr>> {
        let what = format!("the {} of `{}`", row.name, element.name);
        let formulas: Vec<&Formula> = match (&property.value, row.is_vector) {
            (Load::Scalar(formula), false) => vec![formula],
            (Load::Vector(vector), true) => vec![&vector.x, &vector.y],
            (Load::Scalar(formula), true) => {
                let help = format!("write `{} = (…, …);`", row.name);
                self.errors.push(Diagnostic::new(formula.span, format!("{what} is a vector")).help(help));
                return None;
            }
            (Load::Vector(vector), false) => {
                let help = format!("write one formula: `{} = …;`", row.name);
                self.errors.push(Diagnostic::new(vector.span, format!("{what} is a scalar")).help(help));
                return None;
            }
        };
        for formula in &formulas {
            self.check_ambiguous(element, formula)?;
        }
        let place = if row.varies { Place::Load } else { Place::Property };
        let mut read = |formula: &Formula| {
            if row.is_angle {
                self.errors.take(in_radians(formula))?;
            }
            self.scope.formula_of(formula, place, (&what, row.dimension), &mut self.errors)
        };
        let values: Option<Vec<Expr>> = formulas.iter().map(|formula| read(formula)).collect();
        let values = values?;
        if let (Range::Share, [value], [formula]) = (row.range, values.as_slice(), formulas.as_slice()) {
            self.within_one(&format!("the {} of {}", row.name, element.name), *value, formula.span);
        } else if let (true, [value]) = (row.range != Range::All, values.as_slice()) {
            let has = |name: &str| element.properties.iter().any(|property| property.name == name);
            let is_divisor = elements::is_divisor(row.name, has);
            self.checks.push(Check {
                value: *value,
                is_strict: row.range == Range::Positive || is_divisor,
                property: row.name,
                owner: element.name.to_string(),
                span: property.name.span(),
                zero_help: match row.name {
                    "clearance" => Some(NO_PLAY),
                    _ => is_divisor.then_some(NO_FRICTION),
                },
            });
        }
        Some(values)
    }

    /// Refuses an element that cannot act where it is.
    fn check_place(&mut self, element: &Element, resolved: &Resolved) -> bool {
        let algebra = Algebra::new(&mut self.scope.arena);
        let Some([message, help]) = (element.kind.refuses)(&resolved.on(&algebra)) else { return true };
        self.errors
            .push(Diagnostic::new(element.name.span(), format!("`{}` {message}", element.name)).help(help));
        false
    }

    /// Refuses an element of which nothing moves.
    fn check_motion(&mut self, element: &Element, resolved: &Resolved) -> bool {
        let algebra = Algebra::new(&mut self.scope.arena);
        let moved: Vec<Expr> =
            (element.kind.moved)(&resolved.on(&algebra)).into_iter().map(|moved| moved.expr()).collect();
        let moves = moved.into_iter().any(|moved| self.depends_on_coordinates(moved));
        if !moves {
            let what = if element.second.is_some() { "connects nothing" } else { "acts on nothing" };
            let message = format!("`{}` {what} that moves", element.name);
            self.errors.push(Diagnostic::new(element.name.span(), message).help(element.kind.mend));
        }
        moves
    }

    /// Refuses an element where a joint holds what it needs free: sliding of points that
    /// coincide, turning of bodies that keep their angle.
    fn check_freedom(&mut self, element: &Element) -> bool {
        let (Some(needed), Some(second)) = (element.kind.needs, &element.second) else { return true };
        let Freedom { from, verb, mend } = needed;
        let ends = [&element.first, second];
        let same =
            |a: &Attachment, b: &Attachment| a.body == b.body && (from != Holds::Place || a.point == b.point);
        let holds = |joint: &&KnownJoint| {
            let [first, second] = joint.ends.each_ref();
            let is_between = (same(ends[0], first) && same(ends[1], second))
                || (same(ends[0], second) && same(ends[1], first));
            is_between && joint.kind.holds(from)
        };
        let Some(joint) = self.scope.joints.values().find(holds) else { return true };
        let message = format!("nothing {verb} at `{}`", element.name);
        let error = Diagnostic::new(element.name.span(), message).help(mend);
        self.errors.push(error.note(joint.span, "this joint holds its places together"));
        false
    }
}

impl Resolved {
    /// The same, to compute with.
    fn on<'a>(&self, algebra: &'a Algebra<'a>) -> elements::Element<'a> {
        elements::Element {
            algebra,
            first: self.first.on(algebra),
            second: self.second.on(algebra),
            along: algebra.vector(self.along),
            values: self.values.clone(),
            memories: self.memories,
            state: self.state,
            outlines: self.outlines.each_ref().map(|outline| outline.on(algebra)),
            words: self.words.clone(),
        }
    }
}

/// The word of a property that has words in the place of values.
fn word_of(row: &Property, property: &ElementProperty, what: &str) -> Result<&'static str, Diagnostic> {
    let help = format!("it is one of {}", listing(row.words));
    let found = match &property.value {
        Load::Scalar(Formula { kind: FormulaKind::Name(name), .. }) => Some(name),
        _ => None,
    };
    let Some(name) = found else {
        return Err(Diagnostic::new(property.name.span(), format!("{what} is a word")).help(help));
    };
    row.words
        .iter()
        .copied()
        .find(|word| name == word)
        .ok_or_else(|| Diagnostic::new(name.span(), format!("{what} cannot be `{name}`")).help(help))
}

/// The words that an element gives.
pub(super) fn words_of(element: &Element) -> BTreeMap<&'static str, &'static str> {
    let word = |property: &ElementProperty| {
        let row =
            element.kind.properties.iter().find(|row| property.name == row.name && !row.words.is_empty())?;
        Some((row.name, word_of(row, property, "").ok()?))
    };
    element.properties.iter().filter_map(word).collect()
}

/// Checks that all properties are given that the element needs.
fn is_said(element: &Element) -> Result<(), Diagnostic> {
    let is_zero = |value: &Load| match value {
        Load::Scalar(Formula { kind: FormulaKind::Number { value, .. }, .. }) => value.is_zero(),
        _ => false,
    };
    let names: Vec<_> = element.properties.iter().map(|property| property.name.to_string()).collect();
    let zeros = element.properties.iter().map(|property| is_zero(&property.value));
    let names = names.iter().map(String::as_str).zip(zeros).collect();
    let given = Given { names, words: words_of(element) };
    let name = &element.name;
    let (message, help) = match (element.kind.said)(&given) {
        Ok(()) => return Ok(()),
        Err(Unsaid::Missing { what, example }) => {
            (format!("`{name}` does not say its {what}"), format!("as in `{example}`"))
        }
        Err(Unsaid::Twice { first, second, keep }) => {
            (format!("`{name}` says its `{first}` and its `{second}`"), keep.to_owned())
        }
        Err(Unsaid::OfOthers { property, word, others }) => {
            let others: Vec<_> = others.into_iter().map(|word| format!("`law = {word};`")).collect();
            (
                format!("`{name}` has a `{property}`, which `law = {word}` has not"),
                format!("leave it out, or take {}", others.join(" or ")),
            )
        }
    };
    Err(Diagnostic::new(name.span(), message).help(help))
}

fn unknown_property(element: &Element, name: &Ident) -> Diagnostic {
    let names: Vec<_> = element.kind.properties.iter().map(|row| row.name).collect();
    let error = Diagnostic::new(name.span(), format!("a {} has no `{name}`", element.kind.word));
    match nearest(&name.to_string(), names.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None => error.help(format!("its properties are {}", listing(names))),
    }
}
