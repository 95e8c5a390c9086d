//! Masses of bodies: as they are written, or from geoms as MuJoCo computes them.

use std::f64::consts::PI;

use crate::xml::Node;

use super::Reader;
use super::classes::Element;
use crate::robot::space::{Matrix, Pose, Rotation, Vector, diagonal, dot, minus, symmetric, unit};

use crate::robot::{GROUND, Lump, Mark};
use crate::{Refusal, shown};

/// The density of geoms in kg/m^3 unless they say another one.
const DENSITY: f64 = 1000.0;

/// The shape of a geom in its own frame.
struct Solid {
    volume: f64,
    /// About the axes of the frame, for a mass of 1.
    inertia: Vector,
    /// Its ends along the z axis, where it is long.
    half: Option<f64>,
}

impl<'a> Reader<'a> {
    /// The masses of a body, by its `inertial` or by its geoms, which also give it a shape.
    pub(super) fn masses(
        &mut self,
        node: Node<'a>,
        at: usize,
        inherited: Option<&'a str>,
    ) -> Result<(), Refusal> {
        let written = node.elements_named("inertial").next();
        let from_geoms = self.settings.masses_of_geoms.unwrap_or(written.is_none());
        if let Some(inertial) = written.filter(|_| !from_geoms && at != GROUND) {
            let lump = inertia(&self.element(inertial, "inertial", None)?, self)?;
            self.robot.bodies[at].lumps.push(lump);
        }
        for child in node.elements().filter(|child| child.name() == "geom") {
            self.has_geoms = true;
            if at != GROUND {
                let (lump, mark) = self.geom(child, inherited, from_geoms)?;
                self.robot.bodies[at].lumps.extend(lump);
                self.robot.bodies[at].marks.extend(mark);
            }
        }
        Ok(())
    }

    fn geom(
        &self,
        node: Node<'a>,
        inherited: Option<&'a str>,
        has_mass: bool,
    ) -> Result<(Option<Lump>, Vec<Mark>), Refusal> {
        let element = self.element(node, "geom", inherited)?;
        let mass = element.number("mass")?;
        let density = element.number("density")?.unwrap_or(DENSITY);
        let of = &element.of;
        if mass.unwrap_or(density) < 0.0 {
            return Err(Refusal(format!("{of} has a negative mass")));
        }
        let is_solid = mass.unwrap_or(density) > 0.0;
        let ends = element.ends()?;
        let pose = pose(&element, ends, self)?;
        let Some(solid) = solid(&element, ends)? else {
            if has_mass && is_solid {
                let kind = shown(element.get("type").unwrap_or_default());
                return Err(Refusal(format!(
                    "{of} is of the type {kind}, whose mass is not imported; `inertial` says it"
                )));
            }
            return Ok((None, Vec::new()));
        };
        if has_mass && is_solid && element.get("shellinertia") == Some("true") {
            return Err(Refusal(format!("{of} is a shell (`shellinertia`), which is not imported")));
        }
        let name = node.attribute("name").map_or_else(|| "tip".to_owned(), |name| format!("{name}_tip"));
        let tip = |end: f64| Mark {
            name: name.clone(),
            of: of.clone(),
            at: pose.place([0.0, 0.0, end]),
            is_shape: true,
        };
        // The far end first: the near one is often the joint.
        let marks = solid.half.into_iter().flat_map(|half| [tip(half), tip(-half)]).collect();
        let mass = mass.unwrap_or(density * solid.volume);
        let inertia = pose.turn.tensor(diagonal(solid.inertia.map(|entry| mass * entry)));
        Ok(((has_mass && mass > 0.0).then_some(Lump { mass, at: pose.at, inertia }), marks))
    }
}

/// Where a geom is in its body.
fn pose(element: &Element<'_, '_>, ends: Option<[Vector; 2]>, reader: &Reader<'_>) -> Result<Pose, Refusal> {
    let Some([a, b]) = ends else {
        let at = element.vector("pos")?.unwrap_or_default();
        return Ok(Pose { at, turn: element.turn(&reader.settings)? });
    };
    let of = &element.of;
    let direction = unit(minus(b, a)).ok_or_else(|| Refusal(format!("{of}: its `fromto` has no length")))?;
    let at = [0, 1, 2].map(|axis| 0.5 * (a[axis] + b[axis]));
    Ok(Pose { at, turn: Rotation::from_z_to(direction) })
}

/// The solid of a geom; nothing of a kind that is none, or whose form is in another file.
fn solid(element: &Element<'_, '_>, ends: Option<[Vector; 2]>) -> Result<Option<Solid>, Refusal> {
    let kind = element.get("type").unwrap_or("sphere");
    let size = element.list("size")?;
    let count = match kind {
        "sphere" => 1,
        "capsule" | "cylinder" => 2,
        "box" | "ellipsoid" => 3,
        "plane" | "hfield" | "mesh" | "sdf" => return Ok(None),
        other => {
            return Err(Refusal(format!(
                "{} is of the type {}, which is not known",
                element.of,
                shown(other)
            )));
        }
    };
    if element.get("mesh").is_some() {
        let of = &element.of;
        return Err(Refusal(format!("{of} is a {kind} of the size of a `mesh`, which is in another file")));
    }
    // With `fromto` the distance between its two places is the length, of which a size has half.
    let long = ends.map(|[a, b]| 0.5 * dot(minus(b, a), minus(b, a)).sqrt());
    let given = match (long, kind) {
        (None, _) => size,
        (Some(long), "capsule" | "cylinder") => size.iter().take(1).copied().chain([long]).collect(),
        // Its section is a square or a circle, whatever else its size says.
        (Some(long), _) => {
            size.first().into_iter().flat_map(|across| [*across, *across]).chain([long]).collect()
        }
    };
    let sizes = given.get(..count).filter(|sizes| sizes.iter().all(|size| *size > 0.0));
    let sizes = sizes.ok_or_else(|| {
        Refusal(format!("{}: a {kind} has {count} positive numbers as its `size`", element.of))
    })?;
    let shape = match *sizes {
        [r] => Solid { volume: 4.0 / 3.0 * PI * r.powi(3), inertia: [0.4 * r * r; 3], half: None },
        [r, half] if kind == "capsule" => capsule(r, half),
        [r, half] => {
            let across = (3.0 * r * r + 4.0 * half * half) / 12.0;
            Solid {
                volume: 2.0 * PI * r * r * half,
                inertia: [across, across, 0.5 * r * r],
                half: Some(half),
            }
        }
        [x, y, z] => {
            let (factor, share) = if kind == "box" { (8.0, 1.0 / 3.0) } else { (4.0 / 3.0 * PI, 0.2) };
            let about = [[y, z], [z, x], [x, y]].map(|[a, b]| share * (a * a + b * b));
            Solid { volume: factor * x * y * z, inertia: about, half: None }
        }
        _ => return Ok(None),
    };
    Ok(Some(shape))
}

/// A cylinder between two half spheres.
fn capsule(r: f64, half: f64) -> Solid {
    let (tube, ball) = (2.0 * PI * r * r * half, 4.0 / 3.0 * PI * r.powi(3));
    let volume = tube + ball;
    let [tube, ball] = [tube / volume, ball / volume];
    // The centre of a half sphere is 3/8 r from its base.
    let across = tube * (3.0 * r * r + 4.0 * half * half) / 12.0
        + ball * (0.4 * r * r + half * half + 0.75 * r * half);
    Solid { volume, inertia: [across, across, 0.5 * tube * r * r + 0.4 * ball * r * r], half: Some(half) }
}

/// The mass of an `inertial`.
fn inertia(element: &Element<'_, '_>, reader: &Reader<'_>) -> Result<Lump, Refusal> {
    let of = &element.of;
    let mass = element.number("mass")?.ok_or_else(|| Refusal(format!("{of} has no `mass`")))?;
    let at = element.vector("pos")?.ok_or_else(|| Refusal(format!("{of} has no `pos`")))?;
    let tensor: Matrix = match element.exactly::<6>("fullinertia")? {
        Some(entries) => symmetric(entries),
        None => {
            let principal = element.vector("diaginertia")?;
            diagonal(
                principal
                    .ok_or_else(|| Refusal(format!("{of} has neither `diaginertia` nor `fullinertia`")))?,
            )
        }
    };
    Lump::new(of, mass, &Pose { at, turn: element.turn(&reader.settings)? }, tensor)
}
