//! Files that somebody damaged: they are refused or imported, and nothing panics.

use proptest::prelude::*;
use proptest::sample::Index;

use super::{FORMATS, Format, Known, import, pmks, pmks_plus, recognized};

const FILES: [&str; 24] = [
    include_str!("../../../models/command/tests/command/imported/four_bar.json"),
    include_str!("../../../models/command/tests/command/imported/slider_crank.json"),
    include_str!("../../../models/command/tests/command/imported/old_four_bar.json"),
    include_str!("../../../models/command/tests/command/imported/old_slider.json"),
    include_str!("../../../models/command/tests/command/imported/crank_rocker.linkage2"),
    include_str!("../../../models/command/tests/command/imported/block.pyslvs"),
    include_str!("../../../models/command/tests/command/imported/double_pendulum.xml"),
    include_str!("../../../models/command/tests/command/imported/cart_pole.xml"),
    include_str!("../../../models/command/tests/command/imported/four_bar.xml"),
    include_str!("../../../models/command/tests/command/imported/table.xml"),
    include_str!("../../../models/command/tests/command/imported/arm.urdf"),
    include_str!("../../../models/command/tests/command/imported/gripper.urdf"),
    include_str!("../../../models/command/tests/command/imported/loops.xml"),
    include_str!("../../../models/command/tests/command/imported/crane.sdf"),
    include_str!("../../../models/command/tests/command/imported/press.sdf"),
    include_str!("../../../models/command/tests/command/imported/gears.sdf"),
    include_str!("../../../models/command/tests/command/imported/pendulum.sdf"),
    include_str!("../../../models/command/tests/command/imported/pmks_four_bar.txt"),
    include_str!("../../../models/command/tests/command/imported/pmks_quick_return.txt"),
    include_str!("../../../models/command/tests/command/imported/pmks_slider_crank.txt"),
    include_str!("../../../models/command/tests/command/imported/pmks_four_bar.pmks"),
    include_str!("../../../models/command/tests/command/imported/pmks_plus_slider.pmks"),
    include_str!("../../../models/command/tests/command/imported/pmks_plus_whitworth.pmks"),
    include_str!("../../../models/command/tests/command/imported/pmks_plus_watt.pmks"),
];

/// Texts that are put in the place of others in files.
const WRONG: [&str; 16] = [
    "", "0", "-1", "1e308", "NaN", "1e-320", "null", "\"\"", "[", "]", "{", "<", "&#0;", "\u{7f}ä", "true",
    "ground",
];

fn of_format(format: Format) -> Known<'static> {
    Known { format: Some(format), ..Known::default() }
}

/// A file in which words are exchanged for others, and which may be cut.
fn damaged() -> impl Strategy<Value = String> {
    let change = (any::<Index>(), 0..WRONG.len(), any::<bool>());
    (0..FILES.len(), prop::collection::vec(change, 1..4), prop::option::weighted(0.2, any::<Index>()))
        .prop_map(|(file, changes, cut)| {
            let mut words: Vec<String> = FILES[file]
                .split_inclusive(|letter: char| !letter.is_ascii_alphanumeric())
                .map(str::to_owned)
                .collect();
            for (at, wrong, exchanges) in changes {
                let (at, other) = (at.index(words.len()), (wrong * 7919) % words.len());
                if exchanges { words.swap(at, other) } else { words[at] = WRONG[wrong].into() }
            }
            let mut letters: Vec<char> = words.concat().chars().collect();
            if let Some(cut) = cut {
                letters.truncate(cut.index(letters.len()));
            }
            letters.into_iter().collect()
        })
}

proptest! {
    #[test]
    fn damaged_files_never_panic(text in damaged()) {
        if let Err(refusal) = import("damaged", &text, Known::default()) {
            prop_assert!(!refusal.0.is_empty());
        }
    }

    #[test]
    fn any_text_in_any_format(text in "[ -~\\n]{0,60}", format in 0..FORMATS.len()) {
        let _ = import("any", &text, of_format(FORMATS[format].1));
    }
}

/// A file that was copied half is none, wherever it ends.
#[test]
fn files_that_are_cut_never_panic() {
    for file in FILES {
        for (end, _) in file.char_indices() {
            if let Err(refusal) = import("cut", &file[..end], Known::default()) {
                assert!(!refusal.0.is_empty());
            }
        }
    }
}

#[test]
fn files_that_nest_deeply_are_refused() {
    let deep = 100_000;
    for text in ["[".repeat(deep), "{\"joints\":".repeat(deep), "M[".repeat(deep), "J[R,".repeat(deep)] {
        for (_, format) in FORMATS {
            assert!(import("deep", &text, of_format(format)).is_err());
        }
    }
    for (root, part) in [
        ("linkage2", "a"),
        ("mujoco", "default"),
        ("mujoco", "worldbody"),
        ("mujoco><worldbody", "body"),
        ("robot", "link"),
        ("sdf", "model"),
    ] {
        let begun = format!("<{root}>{}", format!("<{part}>").repeat(deep));
        let ended: Vec<&str> = root.split("><").collect();
        let ended: String = ended.iter().rev().map(|name| format!("</{name}>")).collect();
        let elements = format!("{begun}{}{ended}", format!("</{part}>").repeat(deep));
        assert!(import("deep", &elements, Known::default()).is_err());
    }
}

/// Texts of PMKS and PMKS+ that end anywhere. The checks of PMKS+ refuse nearly all of its; they are
/// written anew here, so that what is behind them is cut as well.
#[test]
fn texts_of_pmks_may_be_cut_anywhere() {
    const DIGITS: &[u8] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    for file in FILES {
        let is_plus = match recognized(file) {
            Ok(Format::Pmks) => false,
            Ok(Format::PmksPlus) => true,
            _ => continue,
        };
        let end = file.rfind('*').unwrap_or(file.len());
        for cut in 0..end {
            // The compiler, whose answers other tests have, takes seconds of all positions.
            let begun = &file[..cut];
            if is_plus {
                let _ = pmks_plus::read(&format!("{begun}{}", char::from(DIGITS[cut % DIGITS.len()])));
            } else {
                let _ = pmks::read(begun);
            }
        }
    }
}

/// The files are imported as they are, so that the ones above are damaged and not refused at once.
#[test]
fn sound_files_are_imported() {
    for file in FILES {
        let imported = import("sound", file, Known::default()).unwrap();
        assert!(imported.links >= 2 && imported.text.contains("body "), "{}", imported.text);
    }
}
