//! Settings of a file that hold for all of its parts: the sections `compiler` and `option`, and those that
//! are left out or refused.

use crate::xml::Node;

use crate::Refusal;
use crate::robot::Robot;
use crate::robot::numbers::{exactly, numbers};

/// How numbers of the file are to be read.
pub(super) struct Settings {
    pub is_in_degrees: bool,
    /// The axes of Euler angles; capitals are those that do not turn with the body.
    pub euler: [char; 3],
    /// True if masses come from geoms: always, never, or where a body has no `inertial`.
    pub masses_of_geoms: Option<bool>,
    /// The mass of all bodies together, if the masses of the file are to be scaled to it.
    pub total_mass: Option<f64>,
    pub has_gravity: bool,
    pub has_contacts: bool,
    pub has_equalities: bool,
    /// The groups of actuators that do not act.
    pub disabled_groups: Vec<f64>,
}

impl Settings {
    /// An angle in rad.
    pub fn angle(&self, value: f64) -> f64 {
        if self.is_in_degrees { value.to_radians() } else { value }
    }
}

/// The settings of a file; gravity goes to the robot.
pub(super) fn read(root: Node<'_>, robot: &mut Robot) -> Result<Settings, Refusal> {
    let mut settings = Settings {
        is_in_degrees: true,
        euler: ['x', 'y', 'z'],
        masses_of_geoms: None,
        total_mass: None,
        has_gravity: true,
        has_contacts: true,
        has_equalities: true,
        disabled_groups: Vec::new(),
    };
    robot.gravity = [0.0, 0.0, -9.81];
    for section in root.elements() {
        match section.name() {
            "compiler" => compiler(section, &mut settings)?,
            "option" => option(section, &mut settings, robot)?,
            "keyframe" => robot.lost("the keyframes: it begins at the reference of its joints"),
            _ => {}
        }
    }
    // whichever of several sections says so
    if !settings.has_gravity {
        robot.gravity = [0.0; 3];
    }
    Ok(settings)
}

fn compiler(node: Node<'_>, settings: &mut Settings) -> Result<(), Refusal> {
    let of = node.described("compiler");
    let wrong = |attribute: &str, value: &str| {
        Refusal(format!("{of}: `{attribute}` = {} is not imported", crate::shown(value)))
    };
    match node.attribute("angle") {
        None => {}
        Some("degree") => settings.is_in_degrees = true,
        Some("radian") => settings.is_in_degrees = false,
        Some(other) => return Err(wrong("angle", other)),
    }
    match node.attribute("inertiafromgeom") {
        None => {}
        Some("true") => settings.masses_of_geoms = Some(true),
        Some("false") => settings.masses_of_geoms = Some(false),
        Some("auto") => settings.masses_of_geoms = None,
        Some(other) => return Err(wrong("inertiafromgeom", other)),
    }
    if let Some(total) = node.attribute("settotalmass") {
        let [total] = exactly(total, "settotalmass", &of)?;
        settings.total_mass = (total > 0.0).then_some(total);
    }
    if let Some(sequence) = node.attribute("eulerseq") {
        let axes: Vec<char> = sequence.chars().filter(|axis| "xyzXYZ".contains(*axis)).collect();
        let is_whole = axes.len() == sequence.chars().count();
        settings.euler =
            axes.try_into().ok().filter(|_| is_whole).ok_or_else(|| wrong("eulerseq", sequence))?;
    }
    Ok(())
}

fn option(node: Node<'_>, settings: &mut Settings, robot: &mut Robot) -> Result<(), Refusal> {
    let of = node.described("option");
    if let Some(gravity) = node.attribute("gravity") {
        robot.gravity = exactly(gravity, "gravity", &of)?;
    }
    if let Some(groups) = node.attribute("actuatorgroupdisable") {
        settings.disabled_groups = numbers(groups, "actuatorgroupdisable", &of)?;
    }
    for flag in node.elements().filter(|child| child.name() == "flag") {
        let is_off = |name: &str| flag.attribute(name) == Some("disable");
        settings.has_gravity &= !is_off("gravity");
        settings.has_contacts &= !is_off("contact") && !is_off("constraint");
        settings.has_equalities &= !is_off("equality") && !is_off("constraint");
    }
    Ok(())
}
