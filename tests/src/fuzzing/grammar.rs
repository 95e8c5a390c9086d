//! Declarations made up from the grammar of the language: mostly right in shape,
//! mostly wrong in sense, with everything that is hard on a parser among them.

use std::fmt::Write;

use mbs_codegen::{KeywordKind, keywords};
use proc_macro2::TokenStream;

use crate::random::Random;

const NAMES: &[&str] = &[
    "a", "b", "rod", "crank", "x", "y", "phi", "theta", "x1", "y1", "theta1", "s", "l", "m", "N", "i", "pin",
    "tip", "left", "ground", "t", "pi", "link[1]", "link[i]", "x[i-1]", "größe", "变量", "ﬁ", "Å", "r#for",
    "r#loop", "gen", "Self", "self", "crate", "fn", "dyn", "_", "__", "T", "new", "body", "a_x", "pin_x",
];

const UNITS: &[&str] = &[
    "m",
    "mm",
    "kg",
    "g",
    "s",
    "rad",
    "deg",
    "rpm",
    "N",
    "N*m",
    "kg*m^2",
    "m/s^2",
    "1/s",
    "N/m",
    "N*s/m",
    "m^127",
    "m^-127",
    "m^128",
    "km^100*km^100*km^100",
    "1",
    "1/1",
    "m/",
    "*m",
    "furlong",
    "Nm",
    "",
    "m^0",
    "MPa^90",
    "2*m",
    "m m",
    "deg^120",
    "GPa",
];

const NUMBERS: &[&str] = &[
    "0",
    "1",
    "2",
    "0.5",
    "3.25",
    "1e-3",
    "1e400",
    "1e-400",
    "1e308",
    "4e-324",
    "9223372036854775807",
    "9223372036854775808",
    "170141183460469231731687303715884105728",
    "1_0",
    "0x10",
    "0b11",
    "1f64",
    "1u8",
    "2kg",
    "1.",
    "00",
    "1e9",
    "0.1e-1",
    "123456789.123456789",
    "2147483648",
    "1e",
    "'c'",
    "\"text\"",
    "b\"b\"",
];

const FUNCTIONS: &[&str] = &[
    "sin",
    "cos",
    "tan",
    "asin",
    "acos",
    "atan",
    "atan2",
    "sqrt",
    "exp",
    "ln",
    "tanh",
    "pow",
    "abs",
    "sign",
    "min",
    "max",
    "cycloidal",
    "polynomial_345",
    "harmonic",
    "trapezoidal",
    "distance",
    "der",
    "lambda",
    "effort",
    "lift",
    "sine",
];

/// The words of the language that declare things of a kind.
fn words(kind: KeywordKind) -> Vec<&'static str> {
    let of_kind = keywords().into_iter().filter(|keyword| keyword.kind == kind);
    of_kind.map(|keyword| keyword.word).collect()
}

/// A whole declaration.
pub fn declaration(random: &mut Random) -> String {
    let mut text = format!("Made {{ dof = {}; {BASE}", random.below(5));
    for _ in 0..random.below(8) {
        let _ = write!(text, "{} ", statement(random, 0));
    }
    text + "}"
}

/// So that some of what is made up compiles.
const BASE: &str = "const N = 2; param l = 1 [m]; param m = 1 [kg]; \
    body rod (x, y, theta) { mass = m; inertia = m*l^2; } body crank (phi) { inertia = m*l^2; } \
    point tip on rod = (l/2, 0); point tip on crank = (0, l); ";

/// Hardly a declaration: what a parser stumbles over, long and deep.
pub fn noise(random: &mut Random) -> String {
    let size = 1 << random.below(12);
    let deep = |open: &str, core: &str, close: &str| open.repeat(size) + core + &close.repeat(size);
    let long = |part: &dyn Fn(usize) -> String| (0..size).map(part).collect::<String>();
    // Growth by squaring and by differentiation, within names that build on each other.
    let few = 2 + size % 60;
    let tower = |step: &str| {
        (0..few)
            .map(|at| format!("let a{} = {};", at + 1, step.replace('A', &format!("a{at}"))))
            .collect::<String>()
    };
    let content = match random.below(22) {
        0 => format!("let a = {};", deep("(", "1", ")")),
        1 => format!("let a = {};", deep("-", "1", "")),
        2 => format!("let a = {};", deep("sin(", "x", ")")),
        3 => format!("let a = {}1;", "x^".repeat(size)),
        4 => format!("let a = 0{};", long(&|at| format!("+x^{at}"))),
        5 => format!("let a = 1{};", long(&|at| format!("*(x+{at}*y)"))),
        6 => format!("output o = {};", deep("der(", "x", ")")),
        7 => deep("if 1 > 0 { ", "let b = 1;", "}"),
        8 => (0..size).map(|at| format!("for i{at} in 0..1 {{ ")).collect::<String>() + &"}".repeat(size),
        9 => (0..size).map(|at| format!("assembly A{at} {{ ")).collect::<String>() + &"}".repeat(size),
        10 => format!("let a = rod{};", ".tip".repeat(size)),
        11 => deep("{", "", "}"),
        12 => format!("let a = {};", deep("invisible!(", "x", ")")),
        13 => format!("let a0 = x; {} output o = a{few};", tower("A*A + A")),
        14 => format!("let a0 = sin(x); {} output o = der(a{few});", tower("sin(A)*cos(A) + A")),
        15 => format!("let a0 = x + y; {} output o = a{few};", tower("(A + 1)^2 + y*A")),
        16 => format!("const k0 = 1.5; {} output o = k{few};", tower("A*A").replace('a', "k")),
        17 => format!("for i in 0..{} {{ body w[i] (q[i] = z[i]) {{ mass = 1 [kg]; }} }}", size.min(64)),
        18 => {
            let inner = random.of(&[
                "instance i: A;",
                "instance i: A; instance j: A; instance k: A;",
                "instance i: B;",
            ]);
            format!(
                "assembly A {{ {inner} body w (x) {{ mass = m; }} }} assembly B {{ instance i: A; }} instance i: B;"
            )
        }
        19 => format!(
            "let a = x{};",
            random.of(&["^-1", "/x", "^0", "^0.5", "^1000000", "^(1/3)"]).repeat(size)
        ),
        20 => format!("constraint c: x{0} = y{0};", "*x*y*theta".repeat(size.min(16))),
        _ => format!("{}{}", statement(random, 0), deep("[", "", "]")),
    };
    format!("Noise {{ dof = {}; {BASE} {content} }}", random.below(5))
}

/// A piece that another one is replaced by.
pub fn fragment(random: &mut Random) -> TokenStream {
    let text = match random.below(8) {
        0 => format!("{};", statement(random, 1)),
        1 => formula(random, 1),
        2 => (*random.of(NUMBERS)).to_owned(),
        3 => (*random.of(NAMES)).to_owned(),
        4 => format!("[{}]", random.of(UNITS)),
        5 => vector(random),
        6 => (*random.of(&["", "()", "{}", "[]", ";", "=", "..", "..=", ",", ":", "'a", "#", "-", "^", "."]))
            .to_owned(),
        _ => format!("invisible!({})", formula(random, 1)),
    };
    text.parse().unwrap_or_default()
}

/// A number in another one's place.
pub fn plain_number(random: &mut Random) -> TokenStream {
    let small = random.below(4).to_string();
    let text = if random.once_in(2) { &small } else { *random.of(NUMBERS) };
    text.parse().unwrap_or_default()
}

fn statement(random: &mut Random, depth: usize) -> String {
    let r = random;
    let name = name(r);
    let doc = if r.once_in(20) { "/// what it is\n" } else { "" };
    let text = match r.below(if depth > 3 { 22 } else { 27 }) {
        0 => format!("dof = {};", r.of(NUMBERS)),
        1 => format!("param {name} = {};", number(r)),
        2 => format!("param {name} = {} where {name} {} {};", formula(r, 1), comparison(r), formula(r, 2)),
        3 => format!("const {name} = {};", formula(r, 1)),
        4 if r.once_in(2) => format!("input {name} [{}] = {};", r.of(UNITS), formula(r, 2)),
        4 => format!("input {name} [{}];", r.of(UNITS)),
        5 => format!("let {name} = {};", formula(r, 0)),
        6 => format!("gravity = {};", vector(r)),
        7 => {
            let coordinates = (0..r.below(4)).map(|_| coordinate(r)).collect::<Vec<_>>().join(", ");
            let (mass, inertia) = (formula(r, 2), formula(r, 2));
            format!("body {name} ({coordinates}) {{ mass = {mass}; inertia = {inertia}; }}")
        }
        8 => format!("constraint {name}: {} = {};", formula(r, 1), formula(r, 1)),
        9 => format!("drive {name}: {} = {};", formula(r, 2), formula(r, 1)),
        10 => format!("coupler {name}: {} = {};", formula(r, 2), formula(r, 1)),
        11 => format!("point {name} on {} = {};", self::name(r), vector(r)),
        12 => format!("force {name} on {} = {};", place(r), vector(r)),
        13 => format!("torque {name} on {} = {};", place(r), formula(r, 1)),
        14 => element(r, &name),
        15 => format!(
            "start {{ {} = {}; guess {name} = {}; der({name}) = 1; }}",
            place(r),
            number(r),
            formula(r, 1)
        ),
        16 if r.below(3) == 0 => {
            let how = r.of(&["", "rising", "falling", "up"]);
            format!("event {name}: {} = {} {how};", formula(r, 2), formula(r, 2))
        }
        16 => format!("output {name} [{}] = {};", r.of(UNITS), formula(r, 0)),
        17 => format!("require {} {} {};", formula(r, 1), comparison(r), formula(r, 1)),
        18 => joint(r, &name),
        19 => {
            let points = (0..r.below(6)).map(|at| format!("({at}, {}),", formula(r, 3))).collect::<String>();
            if r.below(2) == 0 {
                format!("profile {name} = spline({points}) period {};", formula(r, 2))
            } else {
                let way = r.of(&["linear", "cubic", "monotone", "step", "straight"]);
                let outside = r.of(&["hold", "extend", "periodic", "refuse", "nothing"]);
                format!("table {name}(x) = [{points}] {way} outside {outside};")
            }
        }
        20 => solver(r),
        21 => element(r, &name),
        22 | 23 => format!("for {name} in {}..={} {{ {} }}", whole(r), whole(r), statement(r, depth + 1)),
        24 => {
            let (first, second) = (statement(r, depth + 1), statement(r, depth + 1));
            format!("if {} {} {} {{ {first} }} else {{ {second} }}", whole(r), comparison(r), whole(r))
        }
        25 => format!("assembly {name} {{ {} {} }}", statement(r, depth + 1), statement(r, depth + 1)),
        _ => format!("instance {name}: {} {{ {} = {}; }}", self::name(r), self::name(r), formula(r, 2)),
    };
    format!("{doc}{text}")
}

/// Most of its properties are given that it needs.
fn element(r: &mut Random, name: &str) -> String {
    if r.once_in(6) {
        let known = r.of(&["length", "rate", "angle", "x"]);
        let word = r.of(&["force", "torque"]);
        return format!("{word} {name} ({}, {}) = {}*{known};", place(r), place(r), formula(r, 2));
    }
    let word = *r.of(&words(KeywordKind::Element));
    let properties: &[&str] = match word {
        "spring" => &["stiffness", "length", "damping"],
        "torsion_spring" => &["stiffness", "angle", "damping"],
        "rope" | "strut" => &["stiffness", "length", "damping"],
        "bushing" => &["stiffness", "torsion", "damping"],
        "motor" => &["stall", "no_load", "level"],
        "friction" => &["coefficient", "normal", "transition", "viscous"],
        "torsion_friction" => &["torque", "coefficient", "normal", "radius", "transition", "viscous"],
        "drag" => &["density", "area", "coefficient", "wind"],
        _ => &["stiffness", "torque"],
    };
    let mut block = String::new();
    for property in properties.iter().filter(|_| !r.once_in(4)).collect::<Vec<_>>() {
        let value = if r.once_in(8) { vector(r) } else { formula(r, 2) };
        let _ = write!(block, "{property} = {value}; ");
    }
    if word == "drag" {
        return format!("{word} {name} on {} {{ {block}}}", place(r));
    }
    let along = if word == "friction" { format!(" along {}", vector(r)) } else { String::new() };
    format!("{word} {name} ({}, {}){along} {{ {block}}}", place(r), place(r))
}

/// How the mechanism is to be solved.
fn solver(r: &mut Random) -> String {
    match r.below(7) {
        0 => "redundant = minimum_norm;".to_owned(),
        6 => format!("states = {};", r.of(&["reduced", "all", "some"])),
        4 => format!("closes {}= {} .. {};", r.of(&["", "theta ", "x ", "t "]), number(r), number(r)),
        1 => format!("limit {} = {};", r.of(&["operations", "stack", "unrolled", "power"]), r.of(NUMBERS)),
        2 => format!("step = {} [ms];", r.of(NUMBERS)),
        3 => format!("feedback = {}({}, {});", r.of(&["held", "per_stage", "sin"]), number(r), number(r)),
        _ => format!("step = 1 [ms]; feedback = held({} [1/s], {} [1/s]);", r.below(2000), r.below(2000)),
    }
}

fn joint(r: &mut Random, name: &str) -> String {
    let mut text = format!("{} {name} ({}, {})", r.of(&words(KeywordKind::Joint)), place(r), place(r));
    for _ in 0..r.below(4) {
        let clause = match r.below(7) {
            0 => format!(" along {}", vector(r)),
            1 => format!(" at {}", formula(r, 2)),
            2 => format!(" = {}", formula(r, 1)),
            3 => format!(" radius {}", formula(r, 2)),
            4 => format!(" radii {}", vector(r)),
            5 => format!(" teeth {}", vector(r)),
            _ => format!(" carrier {}", self::name(r)),
        };
        text += &clause;
    }
    text + ";"
}

fn formula(r: &mut Random, depth: usize) -> String {
    if depth > 4 || r.once_in(3) {
        return match r.below(3) {
            0 => number(r),
            1 => name(r),
            _ => format!("{}.{}", place(r), r.of(&["x", "y", "angle"])),
        };
    }
    match r.below(9) {
        0 => format!("{}({})", r.of(FUNCTIONS), formula(r, depth + 1)),
        1 => format!("{}({}, {})", r.of(FUNCTIONS), formula(r, depth + 1), formula(r, depth + 1)),
        2 => format!("({}) [{}]", formula(r, depth + 1), r.of(UNITS)),
        3 => format!("-{}", formula(r, depth + 1)),
        4 => format!("({})", formula(r, depth + 1)),
        5 => {
            let join = r.of(&["", "", "&& !", "||", "and"]);
            let test = format!("{} {} {}", formula(r, depth + 2), comparison(r), formula(r, depth + 2));
            let test = if join.is_empty() { test } else { format!("{test} {join} ({test})") };
            format!("if {test} {{ {} }} else {{ {} }}", formula(r, depth + 1), formula(r, depth + 1))
        }
        _ => {
            let op = *r.of(&["+", "-", "*", "/", "^", "*", "+", "%", "**", "=="]);
            format!("{} {op} {}", formula(r, depth + 1), formula(r, depth + 1))
        }
    }
}

fn vector(r: &mut Random) -> String {
    match r.below(8) {
        0 => format!("({}, {}) [{}]", formula(r, 3), formula(r, 3), r.of(UNITS)),
        1 => formula(r, 2),
        2 => "(1, 2, 3)".to_owned(),
        _ => format!("({}, {})", formula(r, 2), formula(r, 2)),
    }
}

fn number(r: &mut Random) -> String {
    match r.below(2) {
        0 => (*r.of(NUMBERS)).to_owned(),
        _ => format!("{} [{}]", r.of(NUMBERS), r.of(UNITS)),
    }
}

fn whole(r: &mut Random) -> &'static str {
    const WHOLE: &[&str] = &[
        "0",
        "1",
        "2",
        "N",
        "i",
        "3*N",
        "(N+1)",
        "-5",
        "2147483647",
        "-2147483647*2147483647",
        "x",
        "1+",
        "",
    ];
    WHOLE[r.below(WHOLE.len())]
}

fn comparison(r: &mut Random) -> &'static str {
    const COMPARISONS: &[&str] = &["<", "<=", ">", ">=", "==", "!=", "="];
    COMPARISONS[r.below(COMPARISONS.len())]
}

fn coordinate(r: &mut Random) -> String {
    let name = name(r);
    match r.below(3) {
        0 => format!("{} = {name}", r.of(&["x", "y", "angle", "z"])),
        _ => name,
    }
}

/// The first ones, which are declared, most of the time.
fn name(r: &mut Random) -> String {
    let end = if r.once_in(3) { NAMES.len() } else { 18 };
    (*r.of(&NAMES[..end])).to_owned()
}

fn place(r: &mut Random) -> String {
    match r.below(6) {
        0 => "ground".to_owned(),
        1 => "rod.tip".to_owned(),
        2 => "crank.tip".to_owned(),
        3 => format!("{}.{}.{}", name(r), name(r), name(r)),
        4 => format!("{}.{}", name(r), name(r)),
        _ => name(r),
    }
}
