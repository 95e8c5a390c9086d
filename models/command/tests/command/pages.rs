//! Pages in which a mechanism runs.

use std::fs;

use super::{mbs, refuses};

/// A page is to be sent by mail and opened on a telephone: the longest ones of the library too.
#[test]
fn a_page_has_less_than_250_kilobytes() {
    let folder = tempfile::tempdir().unwrap();
    for model in ["n-four-bar-40", "n-pendulum-40", "jansen-walker", "v-engine", "excavator"] {
        let output = mbs(folder.path(), &format!("export page {model} --end 10ms --out page.html"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let length = fs::metadata(folder.path().join("page.html")).unwrap().len();
        assert!(length < 250_000, "{model}: {length} bytes");
    }
}

#[test]
fn pages_that_cannot_be_made() {
    refuses("export page four-bar --set l=1m --out page.html", &["no parameter `l`"]);
    refuses("export page four-bar --input @none.csv --out page.html", &["none.csv"]);
    refuses("export page four-bar --step 0s --out page.html", &["step"]);
}
