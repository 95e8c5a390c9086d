//! Long lines, cut to what stands around the places that are shown.

use std::collections::BTreeMap;
use std::ops::Range;

/// Lines of more bytes are cut,
const LONGEST_LINE: usize = 240;
/// to so many before and behind a place,
const AROUND: usize = 60;
/// and to so many of a place itself.
const LONGEST_PLACE: usize = 90;

/// A text with as many lines, the long ones among those with places cut.
pub struct Excerpt {
    pub text: String,
    /// Parts of the original text, in its order, and where they begin in the other one.
    parts: Vec<(Range<usize>, usize)>,
}

impl Excerpt {
    /// Of a text around some places; nothing if their lines are short.
    pub fn of(text: &str, places: &[Range<usize>]) -> Option<Self> {
        let mut lines: BTreeMap<usize, (usize, Vec<Range<usize>>)> = BTreeMap::new();
        for place in places {
            let line = line_at(text, place.start)?;
            if line.len() > LONGEST_LINE {
                let end = place.end.min(place.start + LONGEST_PLACE) + AROUND;
                let start = boundary(text, place.start.saturating_sub(AROUND)).max(line.start);
                let window = start..boundary(text, end).min(line.end);
                lines.entry(line.start).or_insert((line.end, Vec::new())).1.push(window);
            }
        }
        if lines.is_empty() {
            return None;
        }
        let mut excerpt = Self { text: String::new(), parts: Vec::new() };
        let mut at = 0;
        for (start, (end, mut windows)) in lines {
            excerpt.keep(text, at..start);
            windows.sort_by_key(|window| window.start);
            at = start;
            for window in windows {
                if window.start > at {
                    excerpt.text.push('…');
                }
                excerpt.keep(text, window.start.max(at)..window.end.max(at));
                at = window.end.max(at);
            }
            if end > at {
                excerpt.text.push('…');
            }
            at = end;
        }
        excerpt.keep(text, at..text.len());
        Some(excerpt)
    }

    /// Where a place of the text is that was cut, as far as it is shown.
    pub fn place(&self, place: &Range<usize>) -> Range<usize> {
        let part = self.parts.iter().rfind(|(part, _)| part.start <= place.start);
        let Some((part, start)) = part else { return 0..0 };
        let shown = |at: usize| start + at.min(part.end) - part.start;
        // one over several parts ends with the first
        shown(place.start)..shown(place.end.max(place.start))
    }

    fn keep(&mut self, text: &str, part: Range<usize>) {
        let kept = text.get(part.clone()).unwrap_or_default();
        self.parts.push((part, self.text.len()));
        self.text.push_str(kept);
    }
}

/// The line of a byte, without its end.
fn line_at(text: &str, at: usize) -> Option<Range<usize>> {
    let (before, behind) = text.split_at_checked(at)?;
    let start = before.rfind('\n').map_or(0, |at| at + 1);
    Some(start..at + behind.find('\n').unwrap_or(behind.len()))
}

/// The place itself, or the letter that it is within.
fn boundary(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at)).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_stay_what_they_are() {
        let long =
            format!("short\n{}first{}second{}\nend", "ä".repeat(400), "-".repeat(500), "ö".repeat(300));
        let find = |word: &str| {
            let at = long.find(word).unwrap();
            at..at + word.len()
        };
        let excerpt = Excerpt::of(&long, &[find("second"), find("first"), find("end")]).unwrap();
        for word in ["first", "second", "short", "end"] {
            assert_eq!(&excerpt.text[excerpt.place(&find(word))], word);
        }
        assert_eq!(excerpt.text.lines().count(), 3);
        let line = excerpt.text.lines().nth(1).unwrap();
        assert!(line.starts_with("…ä") && line.ends_with("ö…") && line.matches('…').count() == 3, "{line}");
        assert!(line.chars().count() < 300, "{line}");
        assert!(Excerpt::of(&long, &[find("short")]).is_none());
        // a place that is as long as the line
        let line = 6..long.len() - 4;
        let whole = Excerpt::of(&long, std::slice::from_ref(&line)).unwrap();
        assert!(whole.text.len() < 200, "{}", whole.text);
    }
}
