//! Operations that stops, modes and contacts take in a right-hand side.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_live::Text;

/// Those of a wheel on a rod, with more statements.
fn cost(more: &str) -> u32 {
    let text = format!(
        "Wheel {{ dof = 3; gravity = (0, -9.81) [m/s^2];
            body wheel (x, y, phi) {{ mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }}
            circle rim on wheel = (0, 0) radius 0.2 [m];
            line floor on ground = (0, 0) along (1, 0.1);
            {more}
            start {{ y = 1 [m]; }} }}"
    );
    let live = Text::declaration("wheel", &text).compile().unwrap_or_else(|error| panic!("{error}\n{text}"));
    let count = live.declared_info().operations("stabilized").expect("a function");
    count.mul + count.add + count.div + count.sin_cos + count.other
}

#[test]
fn what_does_not_act_costs_nothing() {
    let bare = cost("");
    for more in [
        "stop end: y >= 0.2 [m] { restitution = 0.4; }",
        "stop end: y >= 0.2 [m] { restitution = 0.4; friction = 0.3; along = x; } output load [N] = force(end);",
        "mode caught { constraint hook: x = 0; } when y < 0.5 [m] { enter caught; }",
    ] {
        assert_eq!(cost(more), bare, "{more}");
    }
}

#[test]
fn a_contact_takes_at_most_40_operations() {
    let bare = cost("");
    for law in [
        "",
        "damping = 20 [N*s/m];",
        "restitution = 0.5; speed = 1 [m/s]; coefficient = 0.3; transition = 1 [mm/s];",
    ] {
        let more =
            cost(&format!("contact c (wheel.rim, ground.floor) {{ stiffness = 1 [MN/m]; {law} }}")) - bare;
        assert!(more <= 40, "{law}: {more}");
    }
    let more = cost("stop soft: y >= 0.2 [m] { stiffness = 1 [MN/m]; damping = 20 [N*s/m]; }") - bare;
    assert!(more <= 10, "{more}");
}
