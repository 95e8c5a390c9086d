//! Errors stand at the very tokens that cause them, marked here by ⟦ ⟧.
#![allow(clippy::panic, clippy::unwrap_used, reason = "helpers of tests")]

use proc_macro2::TokenStream;

/// Compiles a declaration and compares the places of its errors with the marks.
fn assert_marked(marked: &str) {
    let source = marked.replace(['⟦', '⟧'], "");
    let declaration: TokenStream = source.parse().unwrap();
    let errors = match mbs_codegen::compile(declaration) {
        Ok(_) => panic!("this compiles:\n{source}"),
        Err(errors) => errors,
    };
    let mut places: Vec<_> = errors.iter().map(|error| error.span.byte_range()).collect();
    places.sort_by_key(|place| place.start);
    let mut underlined = String::new();
    let mut behind = 0;
    for place in places {
        underlined += &format!("{}⟦{}⟧", &source[behind..place.start], &source[place.clone()]);
        behind = place.end;
    }
    underlined += &source[behind..];
    assert!(underlined == marked, "expected\n{marked}\nunderlined\n{underlined}");
}

#[test]
fn shape() {
    assert_marked(
        "pub Pendulum {
            ⟦parm⟧ l = 1 [m];
            param l ⟦1⟧ [m];
            param l = ⟦1m⟧;
            param l = 1 [⟦furlong⟧];
            param ⟦type⟧ = 1;
            constraint rod ⟦x⟧^2 + y^2 = l^2;
            gravity = ⟦9.81⟧ [m/s^2];
        }",
    );
}

#[test]
fn names() {
    assert_marked(
        "pub Pendulum {
            dof = 1;
            param l = 1 [m];
            param ⟦l⟧ = 2 [m];
            param ⟦sin⟧ = 2;
            body bob (x, y) { ⟦weight⟧ = 1 [kg]; mass = 1 [kg]; }
            constraint rod: x^2 + ⟦z⟧^2 = l^2;
            force push on ⟦bop⟧ = (1, 0) [N];
            let a = 2*⟦b⟧;
            start { ⟦theta⟧ = 0; der(⟦phi⟧) = 0; }
            output force = ⟦cosinus⟧(l) + lambda(⟦rodd⟧);
        }",
    );
}

#[test]
fn dimensions() {
    assert_marked(
        "pub Pendulum {
            dof = 1;
            param l = 1 [m] where l ⟦>⟧ 1;
            param m = 1 [kg];
            body bob (x, y) { mass = ⟦l⟧; }
            constraint rod: x^2 + y^2 ⟦=⟧ l;
            let sum = l ⟦+⟧ m;
            let bare = l + ⟦2⟧;
            let angle = sin(⟦l⟧);
            let power = 2^⟦l⟧;
            force push on bob = (⟦1⟧, 0);
            start { x = ⟦m⟧; }
        }",
    );
}

#[test]
fn structure() {
    assert_marked(
        "pub Pendulum {
            ⟦dof⟧ = 2;
            body bob (x, y) { mass = 1 [kg]; }
            constraint rod: x^2 + y^2 = 1 [m^2];
        }",
    );
    assert_marked(
        "pub Pendulum {
            dof = 1;
            body bob (x, y) { mass = 1 [kg]; }
            drive sideways: x = 1 [m/s]*t;
            drive ⟦again⟧: 2*x = 1 [m/s]*t;
        }",
    );
    assert_marked(
        "pub Pendulum {
            dof = 1;
            param m = -1 [kg] where m ⟦>⟧ 0;
            body ⟦bob⟧ (x) { mass = m; }
        }",
    );
    assert_marked(
        "pub Pendulum {
            dof = 2;
            body bob (⟦x⟧, y) { mass = 0 [kg]; }
        }",
    );
    assert_marked(
        "pub Pendulum {
            dof = 0;
            body arm (theta) { inertia = 1 [kg*m^2]; }
            constraint ⟦reach⟧: sin(theta) = 2;
        }",
    );
}
