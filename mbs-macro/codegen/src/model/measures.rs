//! Functions that measure the mechanism: what its elements exert and do, how
//! fast its points are, how its bodies stand. Those of joints are in `reactions`.

use std::collections::BTreeSet;

use mbs_symbolic::Algebra;
use mbs_symbolic::units::Dimension;
use proc_macro2::Ident;

use super::known::{Source, Typed};
use super::names::{Place, Scope};
use crate::diagnostics::{Diagnostic, Diagnostics, listing, nearest};
use crate::mechanics::norm;
use crate::syntax::{Attachment, EnergyRole, Formula, FormulaKind};

/// The functions of this file.
pub const MEASURES: &[&str] = &[
    "force",
    "torque",
    "impulse",
    "length",
    "power",
    "kinetic_energy",
    "potential_energy",
    "reaction",
    "transmission_angle",
    "speed",
];

/// Those of them that a stop has.
const OF_STOPS: [&str; 3] = ["force", "torque", "impulse"];

pub(super) const FORCE: Dimension = Dimension::of(1, 1, -2);
pub(super) const ENERGY: Dimension = Dimension::of(1, 2, -2);
pub(super) const TIME: Dimension = Dimension::of(0, 0, 1);

impl Scope<'_> {
    pub(super) fn measure(
        &mut self,
        name: &Ident,
        arguments: &[Formula],
        place: Place,
        errors: &mut Diagnostics,
    ) -> Option<Typed> {
        let result = match (name.to_string().as_str(), arguments) {
            (text, [Formula { kind: FormulaKind::Name(stop), .. }])
                if OF_STOPS.contains(&text) && self.stops.contains_key(&stop.to_string()) =>
            {
                self.of_stop(name, stop, place)
            }
            ("impulse", [of]) => Err(self.no_impulse(name, of)),
            ("kinetic_energy" | "potential_energy", []) => self.energy(name),
            ("kinetic_energy" | "potential_energy", _) => {
                Err(Diagnostic::new(name.span(), format!("`{name}` takes no argument"))
                    .help(format!("write `{name}()`")))
            }
            ("power", [of]) => self.delivered(name, of),
            ("force", [of]) => self.exerted(name, of, FORCE),
            ("torque", [of]) => self.exerted(name, of, ENERGY),
            ("length", [of]) => self.length(name, of, errors).transpose()?,
            ("speed", [of]) => self.speed(name, of, errors).transpose()?,
            ("reaction", [joint]) => self.reaction(name, joint),
            ("reaction", [joint, body]) => Err(is_vector(name, joint, body)),
            ("transmission_angle", [a, b]) => self.transmission_angle(a, b),
            (text, _) => Err(wrong_arguments(name, text)),
        };
        let typed = errors.take(result)?;
        self.allowed(typed, name, place, errors)
    }

    /// Σ F ṡ over what a force, an element or a drive does.
    fn delivered(&mut self, name: &Ident, of: &Formula) -> Result<Typed, Diagnostic> {
        self.only_in_outputs(name)?;
        let asked = name_of(name, of)?;
        let text = asked.to_string();
        let expr = match (self.sources.get(&text), self.rows.get(&text)) {
            (Some(source), Some(row)) => {
                let message = format!("`{text}` is a {} and a constraint", source.word);
                return Err(Diagnostic::new(asked.span(), message)
                    .note(source.span, "the one is declared here")
                    .note(row.span, "the other is declared here")
                    .help("rename one of them"));
            }
            (Some(source), None) => {
                let algebra = &Algebra::new(&mut self.arena);
                algebra.sum(source.work.iter().map(|work| work.power(algebra, &self.motion))).expr()
            }
            (None, Some(row)) => {
                let (phi, rate, multiplier) = (row.phi, row.rate, row.multiplier);
                let phi = phi.unwrap_or(self.arena.zero());
                let algebra = Algebra::new(&mut self.arena);
                let rate = match rate {
                    Some(rate) => self.motion.part_in_velocities(algebra.scalar(rate)),
                    None => self.motion.rate_at_rest(algebra.scalar(phi)),
                };
                let lambda = algebra.variable(multiplier);
                (-(lambda * rate)).expr()
            }
            (None, None) => {
                let known = self.sources.keys().chain(self.rows.keys());
                return Err(unknown(asked, "force, element or drive", known));
            }
        };
        Ok(Typed { expr, dimension: Some(Dimension::of(1, 2, -3)) })
    }

    /// `force(floor)`, `torque(end)`: that with which a stop bears what rests on it; `impulse(floor)`: the sum of those of its
    /// impacts.
    fn of_stop(&mut self, function: &Ident, asked: &Ident, place: Place) -> Result<Typed, Diagnostic> {
        let Some(stop) = self.stops.get(&asked.to_string()).copied() else {
            return Err(unknown(asked, "stop", self.stops.keys()));
        };
        if function == "impulse" {
            let expr = self.arena.variable(stop.impulse);
            return Ok(Typed { expr, dimension: stop.dimension.map(|force| force.times(TIME)) });
        }
        let Some(force) = stop.force.filter(|_| place == Place::Anywhere) else {
            return Err(Diagnostic::new(function.span(), format!("the force of `{asked}` cannot stand here"))
                .help("a run finds the forces of stops behind all others: ask for them in an `output` or in the condition of a `when`"));
        };
        let wanted = if stop.dimension == Some(ENERGY) { "torque" } else { "force" };
        if function != wanted {
            return Err(exerts_another(asked, wanted));
        }
        Ok(Typed { expr: self.arena.variable(force), dimension: stop.dimension })
    }

    /// The error where the impulse of something else than a stop that hits is asked for.
    fn no_impulse(&self, name: &Ident, of: &Formula) -> Diagnostic {
        let asked = match name_of(name, of) {
            Ok(asked) => asked,
            Err(error) => return error,
        };
        if self.sources.get(&asked.to_string()).is_some_and(|source| source.word == "stop") {
            let message = format!("`{asked}` gives way, and has no impulses");
            return Diagnostic::new(asked.span(), message)
                .help(format!("what it pushes with is `force({asked})`"));
        }
        unknown(asked, "stop", self.stops.keys())
    }

    /// `force(s)`, `torque(m)`: the scalar that an element exerts.
    fn exerted(&mut self, name: &Ident, of: &Formula, wanted: Dimension) -> Result<Typed, Diagnostic> {
        self.only_in_outputs(name)?;
        let asked = name_of(name, of)?;
        let text = asked.to_string();
        let Some(source) = self.sources.get(&text) else {
            let known = self.sources.keys().chain(self.stops.keys());
            return Err(unknown(asked, "force, element or stop", known));
        };
        match source.exerts {
            // a force of another dimension is that of a gap that is neither a length nor an angle
            Some(exerts) if (exerts.dimension == ENERGY) == (wanted == ENERGY) => {
                Ok(Typed { expr: exerts.value, dimension: Some(exerts.dimension) })
            }
            Some(_) => Err(exerts_another(asked, if wanted == FORCE { "torque" } else { "force" })),
            // broken elsewhere, or a vector
            None if source.work.is_empty() => Ok(Typed { expr: self.arena.zero(), dimension: None }),
            None if EnergyRole::WORDS.contains(&source.word) => {
                let message =
                    format!("`{text}` is a {}, with a force along every coordinate in it", source.word);
                Err(Diagnostic::new(asked.span(), message)
                    .help(format!("what it delivers is `power({text})`")))
            }
            None => Err(Diagnostic::new(asked.span(), format!("`{text}` is a vector"))
                .help("give its components names with `let`, and record those")),
        }
    }

    /// `length(spring)`: the distance between its places.
    fn length(
        &mut self,
        name: &Ident,
        of: &Formula,
        errors: &mut Diagnostics,
    ) -> Result<Option<Typed>, Diagnostic> {
        let asked = name_of(name, of)?;
        let text = asked.to_string();
        // those of a force on one body are none
        let has_length = |source: &Source| {
            ["spring", "force", "rope", "strut"].contains(&source.word) && source.ends.is_some()
        };
        let Some(ends) = self.sources.get(&text).filter(|s| has_length(s)).and_then(|s| s.ends.clone())
        else {
            let known = self.sources.iter().filter(|(_, source)| has_length(source)).map(|(name, _)| name);
            return Err(unknown(asked, "spring, rope, strut or force between points", known));
        };
        let [first, second] = &ends;
        let placed = self.attachment(first, errors).zip(self.attachment(second, errors));
        Ok(placed.map(|(first, second)| {
            let algebra = Algebra::new(&mut self.arena);
            let expr = first.on(&algebra).distance_to(second.on(&algebra)).expr();
            Typed { expr, dimension: Some(Dimension::LENGTH) }
        }))
    }

    /// `speed(rod.tip)`
    fn speed(
        &mut self,
        name: &Ident,
        of: &Formula,
        errors: &mut Diagnostics,
    ) -> Result<Option<Typed>, Diagnostic> {
        let attachment = match &of.kind {
            FormulaKind::Name(body) => Attachment::of_path(body.clone(), Vec::new()),
            FormulaKind::Member(path) if path.len() == 2 => {
                Attachment::of_path(path[0].clone(), vec![path[1].clone()])
            }
            _ => {
                return Err(Diagnostic::new(name.span(), "`speed` takes a body or a point of one")
                    .help("write `speed(rod)` or `speed(rod.tip)`; of a quantity it is `der(…)`"));
            }
        };
        let Some(placed) = self.attachment(&attachment, errors) else { return Ok(None) };
        let algebra = Algebra::new(&mut self.arena);
        let velocity = placed.on(&algebra).position.map(|component| self.motion.rate(component));
        let expr = norm(velocity).expr();
        Ok(Some(Typed { expr, dimension: Some(Dimension::of(0, 1, -1)) }))
    }

    /// The angle between the x axes of two bodies, 0 … 90°.
    fn transmission_angle(&mut self, a: &Formula, b: &Formula) -> Result<Typed, Diagnostic> {
        let angle = |formula: &Formula| match &formula.kind {
            FormulaKind::Name(body) => self.frame(body).map(|frame| frame.angle),
            _ => Err(Diagnostic::new(formula.span, "the name of a body is expected here")
                .help("write `transmission_angle(rod, rocker)`")),
        };
        let (a, b) = (angle(a)?, angle(b)?);
        let algebra = Algebra::new(&mut self.arena);
        let between = algebra.scalar(a) - algebra.scalar(b);
        let expr = between.sin().abs().atan2(between.cos().abs()).expr();
        Ok(Typed { expr, dimension: Some(Dimension::NONE) })
    }

    fn energy(&mut self, name: &Ident) -> Result<Typed, Diagnostic> {
        self.only_in_outputs(name)?;
        let algebra = Algebra::new(&mut self.arena);
        let energy = match &self.energies {
            Some(energies) if name == "kinetic_energy" => energies.parts().kinetic(&algebra, &self.motion),
            Some(energies) => energies.parts().potential(&algebra, &self.motion),
            None => algebra.number(0),
        };
        Ok(Typed { expr: energy.expr(), dimension: Some(ENERGY) })
    }

    /// Forces are all known once the energies are: rates of states and outputs come last.
    fn only_in_outputs(&self, name: &Ident) -> Result<(), Diagnostic> {
        if self.energies.is_some() {
            return Ok(());
        }
        Err(Diagnostic::new(name.span(), format!("`{name}` cannot stand here"))
            .help("it measures the mechanism in motion, for outputs and rates of states alone"))
    }
}

/// The one name that is an argument.
pub(super) fn name_of<'f>(function: &Ident, argument: &'f Formula) -> Result<&'f Ident, Diagnostic> {
    match &argument.kind {
        FormulaKind::Name(name) => Ok(name),
        _ => Err(wrong_arguments(function, &function.to_string())),
    }
}

pub(super) fn wrong_arguments(name: &Ident, text: &str) -> Diagnostic {
    let (takes, example) = match text {
        "reaction" => ("the name of a joint, and a body for a component", "reaction(pin, rod).x"),
        "transmission_angle" => ("two bodies", "transmission_angle(rod, rocker)"),
        "speed" => ("a body or a point of one", "speed(rod.tip)"),
        "length" => ("the name of a spring", "length(s)"),
        "impulse" => ("the name of a stop", "impulse(floor)"),
        "power" => ("the name of a force, an element or a drive", "power(motor)"),
        _ => ("the name of an element", "force(s)"),
    };
    Diagnostic::new(name.span(), format!("`{name}` takes {takes}")).help(format!("as in `{example}`"))
}

/// The error where the other one of `force` and `torque` is meant.
fn exerts_another(asked: &Ident, is: &str) -> Diagnostic {
    Diagnostic::new(asked.span(), format!("`{asked}` exerts a {is}")).help(format!("write `{is}({asked})`"))
}

pub(super) fn unknown<'n>(name: &Ident, what: &str, known: impl Iterator<Item = &'n String>) -> Diagnostic {
    let known: BTreeSet<&str> = known.map(String::as_str).collect();
    let error = Diagnostic::new(name.span(), format!("there is no {what} `{name}`"));
    match nearest(&name.to_string(), known.iter().copied()) {
        Some(near) => error.help(format!("did you mean `{near}`?")),
        None if known.is_empty() => error.help("declare it first"),
        None => error.help(format!("declared are {}", listing(known))),
    }
}

/// The error for a reaction on a body without a component.
fn is_vector(name: &Ident, joint: &Formula, body: &Formula) -> Diagnostic {
    let call = format!("reaction({}, {})", text_of(joint), text_of(body));
    Diagnostic::new(name.span(), "a reaction on a body is a vector")
        .help(format!("write `{call}.x`, `{call}.y` or `{call}.torque`"))
}

fn text_of(formula: &Formula) -> String {
    match &formula.kind {
        FormulaKind::Name(name) => name.to_string(),
        _ => "…".to_owned(),
    }
}
