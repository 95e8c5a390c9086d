//! Expressions of Pyslvs (KmolYuan), in the words of PMKS:
//! `M[J[R, color[green], P[0.0, 0.0], L[ground, link_0]], …]`.
//!
//! A joint is `R` (its links turn), `RP` (they turn and slide along a line of its first link)
//! or `P` (they slide); `A[…]` is the line's angle in degrees. An expression names no motor.

use super::geometry::from;
use super::linkage::{Linkage, Slot};
use super::{Refusal, shown};

/// True if a text begins as an expression does.
pub(super) fn is_begun(text: &str) -> bool {
    let text: String =
        without_comments(text).chars().filter(|letter| !letter.is_whitespace()).take(2).collect();
    text == "M["
}

/// Reads an expression. Its lengths have no unit; they count as mm unless one is given.
pub(super) fn read(text: &str) -> Result<Linkage, Refusal> {
    let text = without_comments(text);
    let mut linkage = Linkage::new("Pyslvs", "mm");
    linkage.note("Lengths of Pyslvs have no unit; they count as mm, if --unit says nothing else");
    linkage.note("An expression names no motor: the mechanism moves freely; a `drive` would turn a link");
    let mut parser = Parser { rest: text.trim_start_matches('\u{feff}'), text: &text };
    parser.expect("M")?;
    parser.expect("[")?;
    let mut links: Vec<String> = vec!["ground".into()];
    while !parser.takes("]") {
        let joint = parser.joint()?;
        add(&joint, &mut links, &mut linkage)?;
        if !parser.takes(",") && !parser.rest.trim_start().starts_with(']') {
            return Err(parser.refusal("`,` or `]`"));
        }
    }
    if !parser.rest.trim().is_empty() {
        return Err(parser.refusal("the end"));
    }
    Ok(linkage)
}

/// Comments: `#` to the end of a line, `#[` to `#]`.
fn without_comments(text: &str) -> String {
    let mut left = String::new();
    let mut rest = text;
    while let Some(at) = rest.find('#') {
        left.push_str(&rest[..at]);
        let comment = &rest[at..];
        let end = if comment.starts_with("#[") { comment.find("#]").unwrap_or(comment.len()) } else { 0 };
        let line = comment[end..].find('\n').map_or(comment.len(), |line| end + line);
        rest = &comment[line..];
    }
    left + rest
}

/// A joint as it is written.
struct Joint {
    kind: Kind,
    degrees: f64,
    at: [f64; 2],
    links: Vec<String>,
}

#[derive(PartialEq)]
enum Kind {
    Revolute,
    Slot,
    Prismatic,
}

fn add(joint: &Joint, links: &mut Vec<String>, linkage: &mut Linkage) -> Result<(), Refusal> {
    let name = format!("P{}", linkage.pins.len());
    let of = format!("the joint {name}");
    let pin = linkage.pin(&name, of.clone(), joint.at)?;
    let mut on = Vec::new();
    for name in &joint.links {
        let link = links.iter().position(|known| known == name).unwrap_or_else(|| {
            links.push(name.clone());
            linkage.link(name, format!("the link {}", shown(name)), Vec::new())
        });
        on.push(link);
    }
    let riders = match joint.kind {
        Kind::Revolute => &on[..],
        Kind::Slot | Kind::Prismatic => {
            let [base, riders @ ..] = &on[..] else {
                return Err(Refusal(format!("{of} slides and is on no link")));
            };
            let along = from([0.0; 2], 1.0, joint.degrees.to_radians());
            let keeps_angle = joint.kind == Kind::Prismatic;
            linkage.slots.push(Slot { pin, rider: None, link: *base, through: joint.at, along, keeps_angle });
            if keeps_angle && riders.len() > 1 {
                return Err(Refusal(format!("{of} slides without turning and joins more than two links")));
            }
            riders
        }
    };
    riders.iter().for_each(|link| linkage.links[*link].pins.push(pin));
    Ok(())
}

struct Parser<'a> {
    rest: &'a str,
    text: &'a str,
}

impl<'a> Parser<'a> {
    fn takes(&mut self, word: &str) -> bool {
        let Some(rest) = self.rest.trim_start().strip_prefix(word) else { return false };
        self.rest = rest;
        true
    }

    fn expect(&mut self, word: &str) -> Result<(), Refusal> {
        if self.takes(word) { Ok(()) } else { Err(self.refusal(&format!("`{word}`"))) }
    }

    /// The refusal of what stands here, with what should be here.
    fn refusal(&self, expected: &str) -> Refusal {
        let rest = self.rest.trim_start();
        let line = self.text[..self.text.len() - rest.len()].matches('\n').count() + 1;
        let found: String = rest.chars().take(12).collect();
        let found =
            if found.is_empty() { "the text ends".into() } else { format!("{} stands", shown(&found)) };
        Refusal(format!("line {line}: {found} where {expected} should be"))
    }

    /// The word or number that comes next.
    fn word(&mut self, what: &str) -> Result<&'a str, Refusal> {
        let rest = self.rest.trim_start();
        let is_of_it = |letter: char| letter.is_ascii_alphanumeric() || "_+-.".contains(letter);
        let end = rest.find(|letter| !is_of_it(letter)).unwrap_or(rest.len());
        if end == 0 {
            return Err(self.refusal(what));
        }
        self.rest = &rest[end..];
        Ok(&rest[..end])
    }

    fn number(&mut self) -> Result<f64, Refusal> {
        let before = self.rest;
        let word = self.word("a number")?;
        let is_written = word.starts_with(|letter: char| letter.is_ascii_digit() || "+-.".contains(letter));
        match word.parse::<f64>() {
            Ok(number) if is_written && number.is_finite() => Ok(number),
            _ => {
                self.rest = before;
                Err(self.refusal("a number"))
            }
        }
    }

    /// `J[R, A[30.0], color[green], P[1.0, 2.0], L[ground, link_0]]`.
    fn joint(&mut self) -> Result<Joint, Refusal> {
        self.expect("J")?;
        self.expect("[")?;
        let kind = match self.word("`R`, `P` or `RP`")? {
            "R" => Kind::Revolute,
            "RP" => Kind::Slot,
            "P" => Kind::Prismatic,
            other => return Err(Refusal(format!("a joint is of the kind {}, not R, P or RP", shown(other)))),
        };
        let (mut degrees, mut at, mut links) = (0.0, None, None);
        while self.takes(",") {
            let before = self.rest;
            let part = self.word("a part of a joint")?;
            self.expect("[")?;
            match part {
                "A" => degrees = self.number()?,
                "color" => self.colour(),
                "P" => at = Some(self.pair()?),
                "L" => links = Some(self.names()?),
                _ => {
                    self.rest = before;
                    return Err(self.refusal("`A`, `color`, `P` or `L`"));
                }
            }
            self.expect("]")?;
        }
        self.expect("]")?;
        match (at, links) {
            (Some(at), Some(links)) => Ok(Joint { kind, degrees, at, links }),
            (None, _) => Err(self.refusal("a joint with a place `P[x, y]` before it")),
            (_, None) => Err(self.refusal("a joint with its links `L[…]` before it")),
        }
    }

    /// A colour is for the picture alone.
    fn colour(&mut self) {
        self.rest = self.rest.find(']').map_or("", |end| &self.rest[end..]);
    }

    fn pair(&mut self) -> Result<[f64; 2], Refusal> {
        let x = self.number()?;
        self.expect(",")?;
        Ok([x, self.number()?])
    }

    fn names(&mut self) -> Result<Vec<String>, Refusal> {
        let mut names: Vec<String> = Vec::new();
        while !self.rest.trim_start().starts_with(']') {
            names.push(self.word("the name of a link")?.to_owned());
            if !self.takes(",") {
                break;
            }
        }
        Ok(names)
    }
}
