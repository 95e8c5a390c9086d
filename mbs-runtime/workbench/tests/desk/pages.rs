//! Pages in which a mechanism runs: small, of one file, and safe whatever a declaration says.

use std::path::Path;

use mbs_workbench::{Settings, model};

fn page_of(file: &str) -> String {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/src").join(file);
    let model = model::as_declared(&mbs_live::Text::read(&file).unwrap()).unwrap();
    model.interactive_page("name", &Settings { end: 0.1, ..model.defaults() }).unwrap()
}

/// A page is to be sent by mail and opened on a telephone.
#[test]
fn a_page_has_less_than_250_kilobytes() {
    for file in ["double_pendulum.rs", "slider_crank.rs", "andrews_squeezer.rs", "jansen_walker.rs"] {
        let length = page_of(file).len();
        assert!(length < 250_000, "{file}: {length} bytes");
    }
}

#[test]
fn a_page_needs_nothing_from_elsewhere() {
    let html = page_of("double_pendulum.rs");
    assert!(html.contains("default-src 'none'; script-src 'sha256-"));
    // neither a place nor a policy is left open
    for part in ["@PACKED@", "@POLICY@", "unsafe-inline", "'unsafe-eval'", "src=\"", "href=\"", "url("] {
        assert!(!html.contains(part), "{part}");
    }
    assert!(html.contains("<math display=\"block\">"));
}

#[test]
fn a_page_refuses_the_steps_that_it_does_not_make() {
    let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    let model = model::as_declared(&mbs_live::Text::declaration("slider.mbs", text)).unwrap();
    let settings = Settings { scheme: Some(&mbs_runtime::RK4), ..model.defaults() };
    let error = model.interactive_page("slider", &settings).unwrap_err().to_string();
    assert!(error.contains("`method`") && error.contains("constant steps"), "{error}");
}

/// Texts of a declaration stand in the page as texts.
#[test]
fn hostile_texts_stay_texts() {
    let text = "/// </script><script>alert(1)</script> <img src=x onerror=alert(1)>
        Hostile { dof = 1; body ball (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    let model = model::as_declared(&mbs_live::Text::declaration("hostile.mbs", text)).unwrap();
    let html = model.interactive_page("</script>@PACKED@", &model.defaults()).unwrap();
    assert_eq!(html.matches("<script").count(), 2);
    assert_eq!(html.matches("</script>").count(), 2);
    assert!(!html.contains("<img") && html.contains("&lt;img"));
}
