//! The records of a text of PMKS+: settings, joints, links and forces, between points.

use super::digits::{checked, decimal, flags, integer};
use crate::geometry::Point;
use crate::{Refusal, shown};

/// The contents of a text, in its own units.
pub(super) struct Drawing<'a> {
    pub settings: Settings,
    pub joints: Vec<Joint<'a>>,
    pub links: Vec<Link<'a>>,
    pub forces: Vec<Force<'a>>,
}

/// Settings of the whole drawing.
pub(super) struct Settings {
    pub clockwise: bool,
    pub weightless: bool,
    /// The speed of slides in lengths per second, where the text says it.
    pub slide_speed: Option<f64>,
    pub rpm: f64,
    /// The number of the unit of lengths.
    pub length_unit: f64,
}

pub(super) struct Joint<'a> {
    pub id: &'a str,
    pub name: &'a str,
    /// For messages.
    pub of: String,
    pub slides: bool,
    pub is_input: bool,
    pub is_grounded: bool,
    pub is_welded: bool,
    pub is_cylinder: bool,
    pub at: Point,
    /// Of the line that it slides along, in rad.
    pub angle: f64,
    /// The link that has the line, and two joints of it that the line goes through.
    pub slot: Option<[&'a str; 3]>,
    /// Of its own motor, counter-clockwise, where the text says it.
    pub speed: Option<f64>,
}

pub(super) struct Link<'a> {
    /// True if it is a body of its own and no part of one.
    pub is_root: bool,
    pub is_block: bool,
    pub id: &'a str,
    pub name: &'a str,
    /// For messages.
    pub of: String,
    pub mass: f64,
    pub inertia: f64,
    pub centre: Point,
    pub joints: Vec<&'a str>,
    /// The links that are welded to it.
    pub parts: Vec<&'a str>,
}

pub(super) struct Force<'a> {
    pub id: &'a str,
    pub name: &'a str,
    /// For messages.
    pub of: String,
    pub link: &'a str,
    pub from: Point,
    pub to: Point,
    pub magnitude: f64,
    pub turns: bool,
    pub points_outward: bool,
}

/// True if a text begins as one of PMKS+ does: settings between points, then joints.
pub(super) fn is_begun(text: &str) -> bool {
    let sections: Vec<&str> = text.split('.').take(5).collect();
    let is_number = |text: &str| {
        !text.is_empty()
            && text.chars().all(|letter| letter.is_ascii_alphanumeric() || "_-,".contains(letter))
    };
    let [flags, decimals, integers, units, joint] = sections[..] else { return false };
    flags.len() < 4
        && [flags, decimals, integers, units].into_iter().all(is_number)
        && (joint.is_empty() || joint.split(',').count() > 4)
}

/// The records of a text.
pub(super) fn read(text: &str) -> Result<Drawing<'_>, Refusal> {
    let mut sections = checked(text)?.split('.');
    let mut next = |what: &str| sections.next().ok_or_else(|| Refusal(format!("it ends before its {what}")));
    let head = [next("settings")?, next("decimal settings")?, next("speed")?, next("units")?];
    let settings = settings(head)?;
    let (mut joints, mut links, mut forces) = (Vec::new(), Vec::new(), Vec::new());
    loop {
        match next("links")? {
            "" => break,
            record => joints.push(joint(record)?),
        }
    }
    loop {
        match next("forces")? {
            "" => break,
            record => links.push(link(record)?),
        }
    }
    loop {
        match next("end")? {
            "" => break,
            record => forces.push(force(record)?),
        }
    }
    // what is selected on the screen
    let _ = sections.next();
    let marks = sections.flat_map(|section| section.split(',')).filter(|mark| !mark.is_empty());
    for mark in marks {
        // Locks, anchors of centres of mass, synthesis and colours are of the editor alone.
        if !mark.starts_with(['J', 'L', 'F', 'C', 'S', 'K']) {
            return Err(Refusal(format!("it has {}, which only a later PMKS+ knows", shown(mark))));
        }
    }
    Ok(Drawing { settings, joints, links, forces })
}

fn settings([bits, decimals, integers, units]: [&str; 4]) -> Result<Settings, Refusal> {
    let of = "its settings";
    let wrong = || Refusal(format!("{of} have {} in the place of flags", shown(bits)));
    let [clockwise, _, _, _, _, _, _, _, weightless] = flags::<9>(bits).ok_or_else(wrong)?;
    let slide_speed = decimals.split(',').nth(1).map(|speed| decimal(speed, of)).transpose()?;
    Ok(Settings {
        clockwise,
        weightless,
        slide_speed: slide_speed.filter(|speed| *speed != 0.0),
        rpm: integer(integers.split(',').next().unwrap_or_default(), of)?,
        length_unit: integer(units.get(..1).unwrap_or_default(), of)?,
    })
}

/// The first letter of a record and its fields.
fn fields<'a>(record: &'a str, least: usize, what: &str) -> Result<(&'a str, Vec<&'a str>), Refusal> {
    let first = record.chars().next().map_or(0, char::len_utf8);
    let (first, rest) = record.split_at(first);
    let fields: Vec<&str> = rest.split(',').collect();
    if fields.len() < least || fields[0].is_empty() {
        return Err(Refusal(format!("{what} is not complete: {}", shown(record))));
    }
    Ok((first, fields))
}

fn joint(record: &str) -> Result<Joint<'_>, Refusal> {
    let (bits, fields) = fields(record, 5, "a joint")?;
    let of = format!("the joint {}", shown(fields[0]));
    let Some([slides, is_input, is_grounded, is_welded, _, is_cylinder]) = flags::<6>(bits) else {
        return Err(Refusal(format!("{of} has {} in the place of flags", shown(bits))));
    };
    let slot = match [5, 6, 7].map(|at| fields.get(at).copied().unwrap_or_default()) {
        ["", "", ""] => None,
        slot if !slot.contains(&"") => Some(slot),
        _ => return Err(Refusal(format!("{of} slides on a link without two joints of it"))),
    };
    let speed = fields.get(8).map(|speed| decimal(speed, &of)).transpose()?;
    Ok(Joint {
        id: fields[0],
        name: fields[1],
        slides,
        is_input,
        is_grounded,
        is_welded,
        is_cylinder,
        at: [decimal(fields[2], &of)?, decimal(fields[3], &of)?],
        angle: decimal(fields[4], &of)?,
        slot,
        speed: speed.filter(|speed| *speed != 0.0),
        of,
    })
}

fn link(record: &str) -> Result<Link<'_>, Refusal> {
    let (kind, fields) = fields(record, 9, "a link")?;
    let (kind_of_body, id) = fields[0].split_at(fields[0].chars().next().map_or(0, char::len_utf8));
    let of = format!("the link {}", shown(id));
    // The letters say too what PMKS+ computed by itself, which is in the text as well.
    let is_root = match kind {
        "Y" | "A" | "M" | "G" | "0" | "1" | "2" | "3" => true,
        "N" | "a" | "m" | "g" | "4" | "5" | "6" | "7" => false,
        _ => return Err(Refusal(format!("{of} is of the kind {}, which is not known", shown(kind)))),
    };
    let mut rest = fields[7..].iter().copied();
    let joints = rest.by_ref().take_while(|id| !id.is_empty()).collect();
    Ok(Link {
        is_root,
        is_block: match kind_of_body {
            "R" => false,
            "P" => true,
            _ => return Err(Refusal(format!("{of} is neither a link (R) nor a block (P)"))),
        },
        id,
        name: fields[1],
        mass: decimal(fields[2], &of)?,
        inertia: decimal(fields[3], &of)?,
        centre: [decimal(fields[4], &of)?, decimal(fields[5], &of)?],
        joints,
        parts: rest.filter(|id| !id.is_empty()).collect(),
        of,
    })
}

fn force(record: &str) -> Result<Force<'_>, Refusal> {
    let (bits, fields) = fields(record, 8, "a force")?;
    let of = format!("the force {}", shown(fields[0]));
    let Some([turns, points_outward]) = flags::<2>(bits) else {
        return Err(Refusal(format!("{of} has {} in the place of flags", shown(bits))));
    };
    let number = |at: usize| decimal(fields[at], &of);
    Ok(Force {
        id: fields[0],
        link: fields[1],
        name: fields[2],
        from: [number(3)?, number(4)?],
        to: [number(5)?, number(6)?],
        magnitude: number(7)?,
        turns,
        points_outward,
        of,
    })
}
