//! The older JSON of `linkage_to_json`, up to version 0.9: joints that hang on others, each
//! with the links to them.

use serde_json::Value;

use super::values;
use crate::geometry::{Point, circle_and_line, circles, from, minus, polar};
use crate::linkage::{Drive, GROUND, Linkage, Motion, Slot};
use crate::{Refusal, shown};

/// A joint of the file with its pin.
struct Joint {
    name: String,
    pin: usize,
}

pub(super) fn read(joints: &[Value], linkage: &mut Linkage) -> Result<(), Refusal> {
    let mut reader = Reader { linkage, known: Vec::new() };
    for value in joints {
        reader.joint(value)?;
    }
    Ok(())
}

struct Reader<'a> {
    linkage: &'a mut Linkage,
    known: Vec<Joint>,
}

impl Reader<'_> {
    fn joint(&mut self, value: &Value) -> Result<(), Refusal> {
        let kind = values::text(value, "type", "a joint")?;
        let name = values::text(value, "name", "a joint")?;
        let of = format!("the joint {}", shown(name));
        if self.known.iter().any(|joint| joint.name == name) {
            return Err(Refusal(format!("{of} is there twice")));
        }
        let pin = match kind {
            "Static" | "_StaticBase" => self.fixed_place(value, name, of)?,
            "Crank" => self.crank(value, name, of)?,
            "Fixed" => self.carried(value, name, of)?,
            "Revolute" => self.revolute(value, name, of)?,
            "Linear" | "Prismatic" => self.slider(value, name, of)?,
            other => {
                return Err(Refusal(format!("{of} is of the type {}, which is not known", shown(other))));
            }
        };
        self.known.push(Joint { name: name.to_owned(), pin });
        Ok(())
    }

    fn at(&self, pin: usize) -> Point {
        self.linkage.pins[pin].at
    }

    /// The joint that another one refers to: by its name, or written in its place.
    fn parent(&mut self, value: &Value, key: &str, name: &str, of: &str) -> Result<usize, Refusal> {
        let parent = value.get(key).unwrap_or(&Value::Null);
        if parent.get("inline").and_then(Value::as_bool) == Some(true) {
            // A pivot that was given as a place has a number of the program as its name.
            let own = parent.get("name").and_then(Value::as_str).filter(|own| own.parse::<u128>().is_err());
            let pivot = format!("{name}_pivot");
            return self.fixed_place(parent, own.unwrap_or(&pivot), format!("`{key}` of {of}"));
        }
        let other = parent.get("ref").and_then(Value::as_str).or(parent.as_str());
        let other = other.ok_or_else(|| Refusal(format!("{of} does not say its `{key}`")))?;
        let known = self.known.iter().find(|joint| joint.name == other);
        known.map(|joint| joint.pin).ok_or_else(|| Linkage::missing("the joint", other, of))
    }

    fn fixed_place(&mut self, value: &Value, name: &str, of: String) -> Result<usize, Refusal> {
        let at = [values::number(value, "x", &of)?, values::number(value, "y", &of)?];
        let pin = self.linkage.pin(name, of, at)?;
        self.linkage.links[GROUND].pins.push(pin);
        Ok(pin)
    }

    /// Where the joint is drawn, or another place where it is not.
    fn drawn(value: &Value, of: &str, otherwise: Point) -> Result<Point, Refusal> {
        let [x, y] = [values::optional(value, "x", of)?, values::optional(value, "y", of)?];
        Ok(x.zip(y).map_or(otherwise, |(x, y)| [x, y]))
    }

    /// A joint on a link that a motor turns about another joint.
    fn crank(&mut self, value: &Value, name: &str, of: String) -> Result<usize, Refusal> {
        let centre = self.parent(value, "joint0", name, &of)?;
        let length = values::number(value, "distance", &of)?;
        let drawn = Self::drawn(value, &of, from(self.at(centre), length, 0.0))?;
        // The link has the length that the file gives, and the direction that it is drawn in.
        let at = from(self.at(centre), length, polar(minus(drawn, self.at(centre))));
        let per_step = values::number(value, "angle", &of)?;
        let pin = self.linkage.pin(name, of.clone(), at)?;
        let link = self.linkage.link(&format!("{name}_link"), format!("the link of {of}"), vec![centre, pin]);
        if !self.linkage.links[GROUND].pins.contains(&centre) {
            return Err(Refusal(format!(
                "{of} turns about a joint that moves; only motors on the ground are imported"
            )));
        }
        self.linkage.has_steps = true;
        let motion = Motion::PerStep(per_step);
        self.linkage.drives.push(Drive {
            link,
            against: GROUND,
            of,
            start: None,
            from: centre,
            to: pin,
            motion,
        });
        Ok(pin)
    }

    /// A joint at a place of the link through two others.
    fn carried(&mut self, value: &Value, name: &str, of: String) -> Result<usize, Refusal> {
        let [first, second] =
            [self.parent(value, "joint0", name, &of)?, self.parent(value, "joint1", name, &of)?];
        let (length, angle) = (values::number(value, "distance", &of)?, values::number(value, "angle", &of)?);
        let direction = minus(self.at(second), self.at(first));
        let at = from(self.at(first), length, polar(direction) + angle);
        let pin = self.linkage.pin(name, of.clone(), at)?;
        let both =
            |link: usize| [first, second].iter().all(|pin| self.linkage.links[link].pins.contains(pin));
        let carrier = (0..self.linkage.links.len()).find(|link| both(*link));
        match carrier {
            Some(link) => self.linkage.links[link].pins.push(pin),
            None => {
                // A link that turns about the first one, and on which the second one slides.
                let link =
                    self.linkage.link(&format!("{name}_link"), format!("the link of {of}"), vec![first, pin]);
                let through = self.at(first);
                self.linkage.slots.push(Slot {
                    rider: None,
                    pin: second,
                    link,
                    through,
                    along: direction,
                    keeps_angle: false,
                });
            }
        }
        Ok(pin)
    }

    /// A joint where two bars meet.
    fn revolute(&mut self, value: &Value, name: &str, of: String) -> Result<usize, Refusal> {
        let [first, second] =
            [self.parent(value, "joint0", name, &of)?, self.parent(value, "joint1", name, &of)?];
        let (long, other) =
            (values::number(value, "distance0", &of)?, values::number(value, "distance1", &of)?);
        let near = Self::drawn(value, &of, self.at(first))?;
        let at = circles(self.at(first), long, self.at(second), other, near).ok_or_else(|| {
            Refusal(format!(
                "{of} is out of reach: its `distance0` and `distance1` are too short or too different"
            ))
        })?;
        let pin = self.linkage.pin(name, of.clone(), at)?;
        for (parent, side) in [(first, "joint0"), (second, "joint1")] {
            let carrier = format!("{name}_{}", self.linkage.pins[parent].name);
            self.linkage.link(&carrier, format!("the link from {of} to its `{side}`"), vec![parent, pin]);
        }
        Ok(pin)
    }

    /// A joint on a bar that slides along the line through two others.
    fn slider(&mut self, value: &Value, name: &str, of: String) -> Result<usize, Refusal> {
        let [bar, first, second] = [
            self.parent(value, "joint0", name, &of)?,
            self.parent(value, "joint1", name, &of)?,
            self.parent(value, "joint2", name, &of)?,
        ];
        let length = values::number(value, "revolute_radius", &of)?;
        let near = Self::drawn(value, &of, self.at(second))?;
        let line = [self.at(first), self.at(second)];
        let at = circle_and_line(self.at(bar), length, line, near)
            .ok_or_else(|| Refusal(format!("{of} is out of reach: its `revolute_radius` is too short")))?;
        let pin = self.linkage.pin(name, of.clone(), at)?;
        self.linkage.link(&format!("{name}_link"), format!("the link of {of}"), vec![bar, pin]);
        let both =
            |link: usize| [first, second].iter().all(|pin| self.linkage.links[link].pins.contains(pin));
        let Some(link) = (0..self.linkage.links.len()).find(|link| both(*link)) else {
            return Err(Refusal(format!(
                "{of} slides along a line through two joints that no link has both of"
            )));
        };
        let along = minus(line[1], line[0]);
        self.linkage.slots.push(Slot { pin, rider: None, link, through: line[0], along, keeps_angle: false });
        Ok(pin)
    }
}
