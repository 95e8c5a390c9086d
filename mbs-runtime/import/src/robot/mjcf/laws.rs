//! The laws of actuators. MuJoCo has one for all of them; the short forms set parts of it, in
//! defaults as in actuators (`mjs_setTo…` of its source).

use super::super::numbers::{exactly, numbers};
use crate::robot::Input;
use crate::xml::Node;
use crate::{Refusal, shown};

/// The law of an actuator in MuJoCo. Its effort is gain u + b0 + b1 q + b2 q̇ with the input u.
#[derive(Clone, Copy, Debug)]
pub(super) struct Law {
    dynamics: Dynamics,
    gain: Gain,
    bias: Bias,
    gains: [f64; 3],
    biases: [f64; 3],
    /// A short form among its defaults that sets parts which are not imported.
    other: Option<&'static str>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dynamics {
    None,
    Filter,
    Integrator,
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Gain {
    Fixed,
    Affine,
    Other,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Bias {
    None,
    Affine,
    Other,
}

/// The short forms of actuators whose laws are more than gains and biases.
const OTHERS: [&str; 7] = ["muscle", "cylinder", "adhesion", "dcmotor", "pid", "orientation", "plugin"];

/// The short forms that are read.
const FORMS: [&str; 6] = ["general", "motor", "position", "velocity", "intvelocity", "damper"];

pub(super) fn is_actuator(kind: &str) -> bool {
    FORMS.contains(&kind) || OTHERS.contains(&kind)
}

impl Law {
    pub const USUAL: Self = Self {
        dynamics: Dynamics::None,
        gain: Gain::Fixed,
        bias: Bias::None,
        gains: [1.0, 0.0, 0.0],
        biases: [0.0; 3],
        other: None,
    };

    /// Sets what an actuator says, or one among defaults. Other elements say nothing.
    pub fn set(&mut self, node: Node<'_>) -> Result<(), Refusal> {
        let of = node.described(node.name());
        let number = |name: &str| -> Result<Option<f64>, Refusal> {
            let found = node.attribute(name).map(|text| exactly::<1>(text, name, &of)).transpose()?;
            Ok(found.map(|[number]| number))
        };
        match node.name() {
            "general" => self.general(node, &of)?,
            "motor" => *self = Self { biases: self.biases, ..Self::USUAL },
            "position" => self.position(&number)?,
            "intvelocity" => {
                self.position(&number)?;
                self.dynamics = Dynamics::Integrator;
            }
            "velocity" => {
                let kv = number("kv")?.unwrap_or(self.gains[0]);
                self.gains[0] = kv;
                self.biases = [0.0, 0.0, -kv];
                (self.dynamics, self.gain, self.bias) = (Dynamics::None, Gain::Fixed, Bias::Affine);
            }
            "damper" => {
                let inherited = if self.gain == Gain::Affine { -self.gains[2] } else { 0.0 };
                self.gains = [0.0, 0.0, -number("kv")?.unwrap_or(inherited)];
                (self.dynamics, self.gain, self.bias) = (Dynamics::None, Gain::Affine, Bias::None);
            }
            kind => {
                let other = OTHERS.iter().find(|other| **other == kind);
                self.other = other.copied().or(self.other);
            }
        }
        Ok(())
    }

    fn general(&mut self, node: Node<'_>, of: &str) -> Result<(), Refusal> {
        match node.attribute("dyntype") {
            None => {}
            Some("none") => self.dynamics = Dynamics::None,
            Some("filter" | "filterexact") => self.dynamics = Dynamics::Filter,
            Some("integrator") => self.dynamics = Dynamics::Integrator,
            Some(_) => self.dynamics = Dynamics::Other,
        }
        match node.attribute("gaintype") {
            None => {}
            Some("fixed") => self.gain = Gain::Fixed,
            Some("affine") => self.gain = Gain::Affine,
            Some(_) => self.gain = Gain::Other,
        }
        match node.attribute("biastype") {
            None => {}
            Some("none") => self.bias = Bias::None,
            Some("affine") => self.bias = Bias::Affine,
            Some(_) => self.bias = Bias::Other,
        }
        for (own, name) in [(&mut self.gains, "gainprm"), (&mut self.biases, "biasprm")] {
            let given = numbers(node.attribute(name).unwrap_or_default(), name, of)?;
            own.iter_mut().zip(given).for_each(|(own, given)| *own = given);
        }
        Ok(())
    }

    fn position(&mut self, number: &impl Fn(&str) -> Result<Option<f64>, Refusal>) -> Result<(), Refusal> {
        let kp = number("kp")?.unwrap_or(self.gains[0]);
        (self.gains[0], self.biases[1]) = (kp, -kp);
        if let Some(kv) = number("kv")? {
            self.biases[2] = -kv;
        }
        // A ratio is positive there, and a coefficient negative.
        if let Some(ratio) = number("dampratio")? {
            self.biases[2] = ratio;
        }
        if let Some(constant) = number("timeconst")? {
            self.dynamics = if constant == 0.0 { Dynamics::None } else { Dynamics::Filter };
        }
        (self.gain, self.bias) = (Gain::Fixed, Bias::Affine);
        Ok(())
    }

    /// The kind of an actuator's input, its gain, and its bias b0, b1, b2.
    ///
    /// # Errors
    /// A law that is more than a fixed gain and an affine bias, or an actuator of a kind that is not imported.
    pub fn imported(&self, node: Node<'_>, of: &str) -> Result<(Input, f64, [f64; 3]), Refusal> {
        let kind = node.name();
        let refused = |attribute: &str| {
            let value = node.attribute(attribute);
            let value = value.map_or(" of its class".into(), |value| format!(" = {}", shown(value)));
            Err(Refusal(format!("{of}: `{attribute}`{value} is not imported")))
        };
        let input = match kind {
            "motor" => Input::Effort,
            "position" => Input::Position,
            "velocity" => Input::Velocity,
            "general" => Input::Number,
            _ => {
                return Err(Refusal(format!(
                    "{of} is not imported; motor, position, velocity and general are"
                )));
            }
        };
        if let Some(other) = self.other.filter(|_| input != Input::Effort) {
            return Err(Refusal(format!("{of} has the defaults of a {other}, which are not imported")));
        }
        if self.dynamics != Dynamics::None {
            return refused(if kind == "position" { "timeconst" } else { "dyntype" });
        }
        if self.gain != Gain::Fixed {
            return refused("gaintype");
        }
        let [gain, ..] = self.gains;
        match self.bias {
            Bias::None => Ok((input, gain, [0.0; 3])),
            Bias::Affine if self.biases[2] > 0.0 && gain == -self.biases[1] => refused("dampratio"),
            Bias::Affine => Ok((input, gain, self.biases)),
            Bias::Other => refused("biastype"),
        }
    }
}
