//! Efforts along coordinates: springs, rotors, couplings and actuators.

use std::collections::BTreeMap;

use super::declaration::Writer;
use super::digits::{angle, product, term, tidy};
use super::flat::{Coupled, Freedom, Measure};
use super::{Actuator, GROUND, Input, Kind};
use crate::Refusal;
use crate::declaration::number;

/// The endings of names that belong to an actuator.
const OF_AN_ACTUATOR: [&str; 3] = ["_effort", "_drive", "_reaction"];

impl Writer<'_> {
    pub(super) fn spring(&mut self, at: usize) -> Result<(), Refusal> {
        let coordinate = &self.flat.coordinates[at];
        let joint = coordinate.joint;
        if joint.stiffness == 0.0 && joint.damping == 0.0 {
            return Ok(());
        }
        let (of, name) = (&joint.of, self.coordinates[at].clone());
        let [stiffness, damping] = match joint.kind {
            Kind::Hinge => ["N*m/rad", "N*m*s/rad"],
            Kind::Slide => ["N/m", "N*s/m"],
        };
        for (value, what, unit) in
            [(joint.stiffness, "stiffness", stiffness), (joint.damping, "damping", damping)]
        {
            if value != 0.0 {
                self.line(of, format!("    param {name}_{what} = {} [{unit}];", number(value)));
            }
        }
        if let Measure::Angle { sign } = coordinate.measure {
            let parts = self.flat.joints[coordinate.held].parts;
            let [body, parent] = parts.map(|part| self.parts[part].0.clone());
            let mut properties = String::new();
            if joint.stiffness != 0.0 {
                let rest = self.difference(parts) + sign * (joint.rest - joint.reference);
                properties += &format!(" stiffness = {name}_stiffness; angle = {};", angle(rest));
            }
            if joint.damping != 0.0 {
                properties += &format!(" damping = {name}_damping;");
            }
            self.line(of, format!("    torsion_spring {name}_spring ({body}, {parent}) {{{properties} }}"));
            return Ok(());
        }
        let mut pull = String::new();
        if joint.stiffness != 0.0 {
            pull += &format!("-{name}_stiffness*({name}_q{})", term(-joint.rest, "m"));
        }
        if joint.damping != 0.0 {
            let minus = if pull.is_empty() { "-" } else { " - " };
            pull += &format!("{minus}{name}_damping*der({name}_q)");
        }
        self.line(of, format!("    let {name}_pull = {pull};"));
        self.effort(at, of, [&format!("{name}_spring"), &format!("{name}_reaction"), &format!("{name}_pull")])
    }

    /// A torque or a force along a coordinate, between a body and its parent: the names of both,
    /// and that of its size.
    fn effort(&mut self, at: usize, of: &str, [action, reaction, size]: [&str; 3]) -> Result<(), Refusal> {
        let coordinate = &self.flat.coordinates[at];
        let held = &self.flat.joints[coordinate.held];
        let [body, parent] = held.parts.map(|part| self.parts[part].0.clone());
        let is_grounded = held.parts[1] == GROUND;
        match coordinate.measure {
            Measure::Angle { sign } => {
                let [own, other] = if sign < 0.0 { ["-", ""] } else { ["", "-"] };
                self.line(of, format!("    torque {action} on {body} = {own}{size};"));
                if !is_grounded {
                    self.line(of, format!("    torque {reaction} on {parent} = {other}{size};"));
                }
            }
            Measure::Along { along, is_of_body } => {
                if !is_grounded && matches!(held.freedom, Freedom::Shift | Freedom::All) {
                    return Err(Refusal(format!(
                        "{of} acts along one of two slides between bodies that both move, which is not imported"
                    )));
                }
                let name = self
                    .firsts()
                    .nth(coordinate.held)
                    .map_or(String::new(), |(first, _)| self.coordinates[first].clone());
                let frame = if is_of_body { &body } else { &parent };
                let frame = if frame == "ground" { String::new() } else { format!(" in {frame}") };
                let vector =
                    |sign: f64| along.map(|entry| product(&tidy(sign * entry, 1.0), size)).join(", ");
                self.line(of, format!("    force {action} on {body}.{name}{frame} = ({});", vector(1.0)));
                if !is_grounded {
                    self.line(
                        of,
                        format!("    force {reaction} on {parent}.{name}{frame} = ({});", vector(-1.0)),
                    );
                }
            }
        }
        Ok(())
    }

    /// Inertia of a coordinate: a body without mass that turns with it.
    pub(super) fn rotor(&mut self, at: usize) {
        let joint = self.flat.coordinates[at].joint;
        if joint.armature == 0.0 {
            return;
        }
        let (of, name) = (&joint.of, self.coordinates[at].clone());
        let turned = self.names.take(&format!("angle_{name}_rotor"), "angle", &[]);
        let value = number(joint.armature);
        let (unit, inertia, travel) = match joint.kind {
            Kind::Hinge => ("kg*m^2", format!("{name}_armature"), format!("{name}_q")),
            Kind::Slide => ("kg", format!("{name}_armature*(1 [m^2])"), format!("{name}_q/(1 [m])")),
        };
        self.line(of, format!("    param {name}_armature = {value} [{unit}] where {name}_armature >= 0;"));
        self.line(of, format!("    body {name}_rotor ({turned}) {{ mass = 0; inertia = {inertia}; }}"));
        self.line(of, format!("    constraint {name}_gear: {turned} = {travel};"));
        self.rotors.push((turned, joint.reference));
    }

    pub(super) fn couplings(&mut self) {
        for coupled in &self.flat.couplings {
            let name = self.names.take(&coupled.coupling.name, "coupling", &[]);
            let side = |at: usize| {
                let joint = self.flat.coordinates[at].joint;
                let unit = if joint.kind == Kind::Hinge { "rad" } else { "m" };
                (format!("{}_q{}", self.coordinates[at], term(-joint.reference, unit)), joint.kind)
            };
            let (follower, kind) = side(coupled.follower);
            let (leader, leads) = coupled.leader.map_or((String::new(), Kind::Hinge), side);
            let mut terms = Vec::new();
            for (power, coefficient) in (0i32..).zip(&coupled.coupling.coefficients) {
                let metres = i32::from(kind == Kind::Slide) - power * i32::from(leads == Kind::Slide);
                let unit = match metres {
                    0 => String::new(),
                    1.. => " [m]".into(),
                    -1 => " [1/m]".into(),
                    _ => format!(" [1/m^{}]", -metres),
                };
                let factor = format!("({}{unit})", number(*coefficient));
                match power {
                    _ if *coefficient == 0.0 => {}
                    0 => terms.push(factor),
                    1 => terms.push(format!("{factor}*({leader})")),
                    _ => terms.push(format!("{factor}*({leader})^{power}")),
                }
            }
            let right = if terms.is_empty() { "0".into() } else { terms.join(" + ") };
            let word = if self.is_transmission(coupled) { "coupler" } else { "constraint" };
            self.line(&coupled.coupling.of, format!("    {word} {name}: {follower} = {right};"));
        }
    }

    /// `true` if a coupling has more than one coordinate of the language in it, or is curved. A body whose joint goes
    /// back as far as that of its parent goes forth keeps its own angle, which is then the only coordinate.
    fn is_transmission(&self, coupled: &Coupled<'_>) -> bool {
        let Some(leader) = coupled.leader else { return false };
        let [_, slope, curved @ ..] = coupled.coupling.coefficients.as_slice() else { return false };
        let mut angles: BTreeMap<usize, f64> = BTreeMap::new();
        for (at, factor) in [(coupled.follower, 1.0), (leader, -slope)] {
            let coordinate = &self.flat.coordinates[at];
            let Measure::Angle { sign } = coordinate.measure else { return true };
            let [body, parent] = self.flat.joints[coordinate.held].parts;
            *angles.entry(body).or_default() += sign * factor;
            *angles.entry(parent).or_default() -= sign * factor;
        }
        let turning = angles.iter().filter(|(part, factor)| **part != GROUND && **factor != 0.0);
        turning.count() > 1 || curved.iter().any(|coefficient| *coefficient != 0.0)
    }

    pub(super) fn actuators(&mut self) -> Result<(), Refusal> {
        for (actuator, at) in &self.flat.actuators {
            self.actuator(actuator, *at)?;
        }
        Ok(())
    }

    fn actuator(&mut self, actuator: &Actuator, at: usize) -> Result<(), Refusal> {
        let kind = self.flat.coordinates[at].joint.kind;
        let name = self.names.take(&actuator.name, "motor", &OF_AN_ACTUATOR);
        let (effort, per_travel, per_rate, travel, rate) = match kind {
            Kind::Hinge => ("N*m", "N*m/rad", "N*m*s/rad", "rad", "rad/s"),
            Kind::Slide => ("N", "N/m", "N*s/m", "m", "m/s"),
        };
        let (unit, gain) = match actuator.input {
            Input::Effort => (effort, "1"),
            Input::Position => (travel, per_travel),
            Input::Velocity => (rate, per_rate),
            Input::Number => ("1", effort),
        };
        let (of, q, gear) = (&actuator.of, format!("{}_q", self.coordinates[at]), actuator.gear);
        let mut terms = vec![match (actuator.gain, gain) {
            (1.0, "1") => name.clone(),
            (factor, "1") => format!("{}*{name}", number(factor)),
            (factor, unit) => format!("({} [{unit}])*{name}", number(factor)),
        }];
        let of_gear = [
            (1.0, effort, String::new()),
            (gear, per_travel, format!("*{q}")),
            (gear, per_rate, format!("*der({q})")),
        ];
        for (bias, (factor, unit, of)) in actuator.bias.into_iter().zip(of_gear) {
            if bias != 0.0 {
                terms.push(format!("({} [{unit}]){of}", number(bias * factor)));
            }
        }
        let sum = terms.join(" + ");
        let total = match gear {
            1.0 => sum,
            gear if terms.len() == 1 => format!("{}*{sum}", number(gear)),
            gear => format!("{}*({sum})", number(gear)),
        };
        self.line(of, format!("    input {name} [{unit}];"));
        self.line(of, format!("    let {name}_effort = {total};"));
        self.effort(
            at,
            of,
            [&format!("{name}_drive"), &format!("{name}_reaction"), &format!("{name}_effort")],
        )
    }
}
