//! Valid declarations: those of the models, of the tests, and some that use the
//! statements which these leave out.

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::mutation::flat;

/// A declaration, and all of its tokens at every depth.
pub struct Seed {
    pub tokens: TokenStream,
    pub all: Vec<TokenTree>,
}

/// All of them.
pub fn all() -> Vec<Seed> {
    let of_files = SOURCES.iter().flat_map(|source| of_source(source));
    let written = WRITTEN.iter().filter_map(|text| text.parse::<TokenStream>().ok());
    of_files.chain(written).map(|tokens| Seed { all: flat(&tokens), tokens }).collect()
}

const SOURCES: &[&str] = &[
    include_str!("../../../models/src/slider_crank.rs"),
    include_str!("../../../models/src/slider_crank_free.rs"),
    include_str!("../../../models/src/pendulum.rs"),
    include_str!("../../tests/composition.rs"),
    include_str!("../../tests/couplings.rs"),
    include_str!("../../tests/hygiene.rs"),
    include_str!("../../tests/joints.rs"),
    include_str!("../../tests/profiles.rs"),
    include_str!("../../tests/references/double_fourbar_a02.rs"),
    include_str!("../../tests/references/slotted_pendulum_modelica.rs"),
];

/// What stands between the braces of every `mechanism! { … }` in a file.
fn of_source(source: &str) -> Vec<TokenStream> {
    source.parse().map(declarations).unwrap_or_default()
}

fn declarations(stream: TokenStream) -> Vec<TokenStream> {
    let tokens: Vec<TokenTree> = stream.into_iter().collect();
    let mut found = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        let TokenTree::Group(group) = token else { continue };
        let is_declaration = group.delimiter() == Delimiter::Brace
            && at >= 2
            && matches!(&tokens[at - 2], TokenTree::Ident(word) if word == "mechanism")
            && matches!(&tokens[at - 1], TokenTree::Punct(mark) if mark.as_char() == '!');
        match is_declaration {
            true => found.push(group.stream()),
            false => found.extend(declarations(group.stream())),
        }
    }
    found
}

/// Statements that the mechanisms of the files use rarely or never.
pub const WRITTEN: &[&str] = &[
    "pub Swing {
    dof = 1;
    param l = 0.5 [m] where l > 0;
    const c = 2*sqrt(2) [N*s/m];
    input push [N];
    let lean = arm.end.x/l;
    body arm (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
    body bob (x2, y2) { mass = 2 [kg]; }
    body cart (x = s) { mass = 1 [kg]; }
    point base on arm = (-l/2, 0);
    point end on arm = (l/2, 0);
    point rail on ground = (0, 1) [m];
    revolute pin (arm.base, cart);
    distance rope (bob, arm.end) = 2*l;
    point_on_line slot (bob, ground.rail) along (0, 1);
    drive motor: cart.x = 0.1 [m]*sin(3 [Hz]*t);
    spring rubber (bob, ground) { stiffness = 3 [N/m]; length = l; damping = c; }
    torsion_spring coil (arm, ground) { stiffness = 1 [N*m]; angle = 90 [deg]; }
    force wind on arm.end = (push, -1 [N]*lean);
    torque brake on arm = -der(theta)*(1 [N*m*s]);
    start { theta = -pi/2; guess y2 = -l; der(theta) = 2 [rad/s]; }
    output height [mm] = bob.y;
    output pull = lambda(rope);
}",
    "Press {
    /// One motor, a screw, and two loops.
    dof = 2;
    crate = ::mbs_runtime;
    const N = 2;
    const lead = 4 [mm];
    param r = 30 [mm] where r > 10 [mm];
    param l = 120 [mm];
    require 2*r < l;
    gravity = (0, -9.81) [m/s^2];
    body crank (phi) { inertia = 1e-4 [kg*m^2]; }
    point eye on crank = (r, 0);
    body nut (x5) { mass = 0.5 [kg]; }
    drive motor: crank.angle = 10 [rad/s]*t + 2*harmonic(t/(1 [s]));
    coupler screw: nut.x = lead/(2*pi)*crank.angle;
    assembly Ram {
        param lean = 0 [deg];
        body ram (y) { mass = 1 [kg]; }
        body rod (x, yr, theta) { mass = 0.2 [kg]; inertia = 1e-4 [kg*m^2]; }
        point low on rod = (-l/2, 0);
        point high on rod = (l/2, 0);
        torque drag on rod = -lean*(1 [N*m]);
        revolute pin (rod.low, crank.eye);
        revolute bolt (rod.high, ram);
        start { guess y = l; guess theta = 90 [deg]; guess yr = l/2; }
    }
    instance left: Ram { lean = 20 [deg]; }
    instance right: Ram;
    for i in 1..=N {
        body weight[i] (x = q[i]) { mass = 1 [kg]; }
    }
    output push [N] = effort(motor)/r;
}",
    "Weights {
    dof = 4;
    const N = 3;
    body root (x = s) { mass = 1 [kg]; }
    for i in 1..=N {
        body weight[i] (y = h[i]) { mass = i*(1 [kg]); }
        if i == 1 {
            force lift[i] on weight[i] = (0, 1 [N]);
        } else if i >= N {
            spring last[i] (weight[i], weight[i-1]) { stiffness = 3 [N/m]; length = 0.1 [m]; }
            start { h[i] = 1 [m]; h[i-1] = -1 [m]; }
        } else {
            force down[i] on h[i] = -2 [N]*tanh(der(h[i])/(1 [m/s]));
        }
        for j in 0..i { output gap[i][j] [m] = weight[i].y - j*(1 [m]); }
    }
}",
    "Cylinder {
    dof = 1;
    input supply [bar];
    param area = 3e-4 [m^2];
    body boom (x, y, phi) { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
    point heel on boom = (-1 [ft], 0);
    point eye on boom = (2 [inch], 1 [cm]);
    point frame on ground = (-0.1 [m], -20 [cm]);
    revolute pin (boom.heel, ground);
    let stroke = distance(boom.eye, ground.frame);
    force push on phi = supply*area*(der(stroke)/der(phi));
    start { phi = 30 [deg]; der(phi) = 1 [rpm]; guess x = 1 [ft]; }
    output length [mm] = stroke;
    output power = supply*area*der(stroke);
}",
];
