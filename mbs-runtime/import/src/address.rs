//! Web addresses that carry a mechanism behind `?`.

/// The part of an address behind `?`, decoded; `None` for a text that is no address.
pub(super) fn query(text: &str) -> Option<String> {
    let (before, behind) = text.trim().split_once('?')?;
    before.starts_with("http").then(|| decoded(behind))
}

/// `true` if a text is an address of PMKS+ before its version 2, which has parts named `j` and `l`.
pub(super) fn is_of_old_pmks_plus(text: &str) -> bool {
    let query = query(text).unwrap_or_default();
    ["j=", "l="].iter().all(|name| query.split('&').any(|part| part.starts_with(name)))
}

/// A text in which `%7C` stands for a byte.
fn decoded(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let [first, behind @ ..] = rest {
        let hex = |digit: u8| char::from(digit).to_digit(16);
        let code = match behind {
            [high, low, ..] if *first == b'%' => hex(*high).zip(hex(*low)),
            _ => None,
        };
        match code.and_then(|(high, low)| u8::try_from(16 * high + low).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = &behind[2..];
            }
            None => {
                bytes.push(*first);
                rest = behind;
            }
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}
