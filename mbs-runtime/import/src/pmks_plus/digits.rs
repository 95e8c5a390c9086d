//! How PMKS+ writes numbers, flags and what shows that a text is complete.

use crate::{Refusal, shown};

/// The digits, by their values. A number is written in thousandths; a zero before others is a minus.
const DIGITS: &str = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-";

/// The digits that checks are written with.
const OF_CHECKS: usize = 62;

/// The number that digits stand for, in the order of their weight.
fn whole(digits: &str) -> Option<f64> {
    // 53 bits are whole numbers of a float.
    if digits.len() > 8 {
        return None;
    }
    let value = |digit: char| DIGITS.find(digit).and_then(|value| u8::try_from(value).ok());
    digits.chars().try_fold(0.0, |sum, digit| Some(64.0 * sum + f64::from(value(digit)?)))
}

/// A whole number.
pub(super) fn integer(digits: &str, of: &str) -> Result<f64, Refusal> {
    let number = match digits.strip_prefix('0') {
        Some(rest) => whole(rest).map(|number| -number),
        None => whole(digits),
    };
    let number = number.filter(|_| !digits.is_empty());
    number.ok_or_else(|| Refusal(format!("{of} has {} in the place of a number", shown(digits))))
}

/// A number of thousandths.
pub(super) fn decimal(digits: &str, of: &str) -> Result<f64, Refusal> {
    Ok(integer(digits, of)? / 1000.0)
}

/// Yes and no, six to a digit, the first one in the last bit.
pub(super) fn flags<const N: usize>(digits: &str) -> Option<[bool; N]> {
    let mut number = whole(digits)?;
    Some(std::array::from_fn(|_| {
        let is_set = number % 2.0 >= 1.0;
        number = (number / 2.0).floor();
        is_set
    }))
}

/// The text without its checks: a digit of its length, and since 2026 six of its content behind `*`.
pub(super) fn checked(text: &str) -> Result<&str, Refusal> {
    let wrong = || Refusal("its check at the end does not fit: it is damaged or not complete".into());
    let (text, content) = match text.rsplit_once('*') {
        Some((text, content)) => (text, Some(content)),
        None => (text, None),
    };
    if content.is_some_and(|content| content != digest(text)) {
        return Err(wrong());
    }
    let (at, last) = text.char_indices().next_back().ok_or_else(wrong)?;
    let length = text[..at].chars().count();
    if DIGITS.chars().nth(length % OF_CHECKS) == Some(last) { Ok(&text[..at]) } else { Err(wrong()) }
}

/// The hash FNV-1a of 32 bits, in six digits.
fn digest(text: &str) -> String {
    let hash = text
        .encode_utf16()
        .fold(0x811c_9dc5_u32, |hash, unit| (hash ^ u32::from(unit)).wrapping_mul(0x0100_0193));
    let digits = DIGITS.as_bytes();
    let mut rest = hash as usize;
    let mut letters: Vec<char> = Vec::new();
    for _ in 0..6 {
        letters.push(digits.get(rest % OF_CHECKS).copied().map_or('0', char::from));
        rest /= OF_CHECKS;
    }
    letters.into_iter().rev().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers as a template of PMKS+ has them.
    #[test]
    fn numbers_are_thousandths() {
        let number = |digits| decimal(digits, "it").unwrap();
        assert_eq!((number("Fe"), number("0mv"), number("0"), number("OZ")), (1.0, -3.129, 0.0, 1.571));
        assert!(
            decimal("a b", "it").is_err()
                && decimal("", "it").is_err()
                && decimal("111111111", "it").is_err()
        );
        assert_eq!(flags::<5>("M"), Some([false, true, true, false, true]));
    }

    /// Two texts that PMKS+ published, one with the later check.
    #[test]
    fn a_text_that_lost_a_letter_is_refused() {
        let old = "0P.TY.K,0.101.MA,A,0mA,0c,0.GB,B,0Yt,bK,0.GC,C,il,H-,0.LD,D,il,H-,0..YRAB,AB,Fe,Fe,0fW,IN,c5cae9,A,B,,.YRBC,BC,Fe,Fe,4y,Rf,303e9f,B,C,,.YPCD,CD,Fe,0,0,0,,C,D,,...JAe";
        let new = "2v.Ay,1E8.A,0.1011.6A,A,0,0,0.0B,B,0,ku,0.4C,C,Fe,0,0.0D,D,095,1A7,0.1P,P,0,ku,0,CD,C,D..YRAB,AB,0,0,0,NS,303e9f,A,B,,.YRCD,CD,0,0,3H,b4,0d125a,C,D,,.YPBP,BP,0,0,0,0,,B,P,,...N_r*4EPIoh";
        assert!(checked(old).is_ok_and(|text| text.ends_with("...JA")));
        assert!(checked(new).is_ok_and(|text| text.ends_with("...N_")));
        for text in [old, new] {
            for at in 0..text.len() {
                assert!(checked(&format!("{}{}", &text[..at], &text[at + 1..])).is_err());
            }
        }
        assert!(checked(&new.replacen("ku", "kv", 1)).is_err() && checked("").is_err());
    }
}
