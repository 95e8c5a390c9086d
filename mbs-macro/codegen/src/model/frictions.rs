//! Friction that sticks, `law = coulomb`: its memories, and the way along which it holds; and the own state of
//! friction by bristles, `law = lugre`.
//!
//! A memory has the direction of sliding, −1 or 1, and is 0 while friction sticks; another one has the force with which
//! it holds. Where it sticks a run asks for the response of the mechanism to an impulse along ∂s/∂q, s how far it has slid,
//! as it does at [stops](super::stops).

use mbs_symbolic::units::{Dimension, Unit};
use mbs_symbolic::{Algebra, Expr, Stage};
use proc_macro2::Ident;

use super::declare::quantity;
use super::elements::words_of;
use super::known::Value;
use super::resolver::Resolver;
use super::{Contact, Friction, Meaning};
use crate::diagnostics::Diagnostic;
use crate::mechanics::elements::{COULOMB, LUGRE, PRESLIDING, Sticks};
use crate::quantity::Setting;
use crate::syntax::Element;

impl Resolver<'_> {
    /// The memories of friction that sticks: which way it slides, and the force that holds it.
    pub(super) fn declare_friction(&mut self, element: &Element) {
        if !words_of(element).values().any(|word| *word == COULOMB) {
            return;
        }
        self.declare_sticking(&element.name);
    }

    /// The memories of what rubs by a name.
    pub(super) fn declare_sticking(&mut self, name: &Ident) {
        self.scope.first_memory = self.scope.first_memory.min(self.inputs.len());
        let [direction, held] = memories_of(name);
        let docs = ["the direction in which it slides, 0 while it sticks", "the force with which it sticks"];
        for (name, doc) in [&direction, &held].into_iter().zip(docs) {
            let meaning = Meaning::Input(self.inputs.len());
            let symbol = self.scope.symbol(&name.to_string(), Stage::Variable, meaning);
            if *name == direction {
                let value = Value::Symbol { symbol, dimension: Unit::ONE.dimension, span: name.span() };
                self.scope.declare(name, value, &mut self.errors);
            }
            self.inputs.push(Setting { quantity: quantity(name, doc, "", Unit::ONE), value: 0.0 });
        }
    }

    /// The place of the first memory of an element among the inputs, if it has any.
    fn friction_memory(&self, name: &Ident) -> Option<usize> {
        let [direction, _] = memories_of(name);
        let memories = self.inputs.iter().enumerate().skip(self.scope.first_memory);
        memories.into_iter().find(|(_, input)| direction == input.quantity.name).map(|(at, _)| at)
    }

    /// The memories of an element that sticks.
    pub(super) fn friction_memories(&mut self, element: &Element) -> Option<[Expr; 2]> {
        let sticks = words_of(element).values().any(|word| *word == COULOMB);
        let memory = self.friction_memory(&element.name).filter(|_| sticks)?;
        let symbols = [
            self.scope.symbol_of(Meaning::Input(memory))?,
            self.scope.symbol_of(Meaning::Input(memory + 1))?,
        ];
        Some(symbols.map(|symbol| self.scope.arena.variable(symbol)))
    }

    /// The own state of friction by bristles: how far they are bent.
    pub(super) fn declare_bristle(&mut self, element: &Element) {
        if !words_of(element).values().any(|word| *word == LUGRE) {
            return;
        }
        let bent = element.kind.properties.iter().find(|row| row.name == PRESLIDING);
        let is_length = bent.is_some_and(|row| row.dimension == Dimension::LENGTH);
        let (text, dimension) = if is_length { ("m", Dimension::LENGTH) } else { ("rad", Dimension::NONE) };
        let name = bristle_of(&element.name);
        let unit = Unit { dimension, ..Unit::ONE };
        self.declare_state_of(&name, quantity(&name, "how far its bristles are bent", text, unit));
        if let Some(state) = self.state_named(&name) {
            // the element says how it changes, and no one else
            self.rates.insert(state, name.span());
        }
    }

    /// The own state of an element whose bristles bend.
    pub(super) fn bristle(&mut self, element: &Element) -> Option<Expr> {
        let bends = words_of(element).values().any(|word| *word == LUGRE);
        let state = self.state_named(&bristle_of(&element.name)).filter(|_| bends)?;
        Some(self.scope.arena.variable(self.coordinates.get(state)?.velocity))
    }

    /// Enters the rate at which bristles bend.
    pub(super) fn push_bristle_rate(&mut self, name: &Ident, rate: Expr) {
        let name = bristle_of(name);
        let Some(state) = self.state_named(&name) else { return };
        self.push_rate(&name, state, rate);
    }

    /// Enters friction that sticks.
    pub(super) fn push_friction(&mut self, name: &Ident, sticks: Sticks) {
        self.push_sticking(name, None, sticks);
    }

    /// Enters the friction of a stop, whose limits are shares of what the stop pushes with.
    pub(super) fn push_friction_at(&mut self, name: &Ident, stop: usize, sticks: Sticks) {
        self.push_sticking(name, Some(stop), sticks);
    }

    fn push_sticking(&mut self, name: &Ident, stop: Option<usize>, Sticks { slip, limits }: Sticks) {
        let Some(memory) = self.friction_memory(name) else { return };
        if self.has_room_for(name, "friction", "take `law = smooth;` with a `transition` for some").is_none()
        {
            return;
        }
        let contact = self.contact(slip);
        let told = if stop.is_some() { &memory_of(name, "friction") } else { name };
        let quantity = quantity(told, "", "", Unit::ONE);
        self.frictions.push(Friction { quantity, contact, limits, memory, stop, span: name.span() });
    }

    /// A value of positions with its derivatives.
    pub(super) fn contact(&mut self, gap: Expr) -> Contact {
        let algebra = Algebra::new(&mut self.scope.arena);
        let motion = &self.scope.motion;
        let scalar = algebra.scalar(gap);
        let slopes = motion.slopes(scalar);
        let rate = motion.rate(scalar);
        let curved = motion.rate(rate);
        let (rate, curved) = (rate.expr(), curved.expr());
        self.contact_with((gap, rate, curved), slopes)
    }

    /// The same with the derivatives that are known: the second one without accelerations.
    pub(super) fn contact_with(
        &mut self,
        (gap, rate, curved): (Expr, Expr, Expr),
        slopes: Vec<(usize, Expr)>,
    ) -> Contact {
        let mut acceleration = curved;
        for &(at, slope) in &slopes {
            let Some(of_coordinate) = self.scope.symbol_of(Meaning::Acceleration(at)) else { continue };
            let arena = &mut self.scope.arena;
            let of_coordinate = arena.variable(of_coordinate);
            let term = arena.mul(slope, of_coordinate);
            acceleration = arena.add(acceleration, term);
        }
        Contact { gap, rate, acceleration, slopes }
    }

    /// Frictions that hold one motion, and more than they brake it with.
    pub(super) fn parallel_frictions(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for (at, second) in self.frictions.iter().enumerate() {
            let is_alike = |first: &&Friction| {
                let holds_more = [first, second].iter().any(|it| it.limits[0] != it.limits[1]);
                let is_of_stop = [first, second].iter().any(|it| it.stop.is_some());
                holds_more && !is_of_stop && first.contact.slopes == second.contact.slopes
            };
            let Some(first) = self.frictions.iter().take(at).find(is_alike) else { continue };
            let [first_name, name] = [first, second].map(|it| &it.quantity.name);
            let message = format!(
                "`{name}` holds the same motion as `{first_name}`, and they let go one after the other"
            );
            let help = "describe them as one friction, which holds the sum of both";
            let note = format!("`{first_name}` is declared here");
            found.push(Diagnostic::new(second.span, message).help(help).note(first.span, note));
        }
        found
    }

    /// Puts the frictions of stops behind those of elements. Where several hold one motion, a run lets the first one hold it,
    /// and finds how much a stop has to hold from what the others leave.
    pub(super) fn order_frictions(&mut self) {
        self.frictions.sort_by_key(|friction| friction.stop.is_some());
    }

    /// Refuses what does not go with friction that sticks.
    pub(super) fn check_frictions(&mut self) {
        let Some(friction) = self.frictions.first() else { return };
        let (name, span) = (friction.quantity.name.clone(), friction.span);
        let mut refuse = |message: String, help: &str| {
            self.errors.push(Diagnostic::new(span, message).help(help));
        };
        if self.solver.has_reduced_states() {
            refuse(
                format!("`{name}` sticks along coordinates that are not integrated"),
                "leave `states = reduced;` out where friction sticks",
            );
        }
        if self.solver.reverse.is_some() {
            refuse(
                format!("no way leads back through the sticking of `{name}`"),
                "take `law = smooth;` with a `transition`",
            );
        }
    }
}

/// The names of the memories of friction that sticks.
fn memories_of(name: &Ident) -> [Ident; 2] {
    ["direction", "held"].map(|what| memory_of(name, what))
}

/// The name of the own state of friction by bristles.
fn bristle_of(name: &Ident) -> Ident {
    memory_of(name, "bristle")
}

/// The name of a memory, or a state, that something has by its own name.
pub(super) fn memory_of(name: &Ident, what: &str) -> Ident {
    Ident::new(&format!("{}_{what}", name.to_string().trim_start_matches("r#")), name.span())
}
