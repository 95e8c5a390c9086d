//! `limit unrolled` is one fact: it decides whether a program is searched for repetitions,
//! whether it is ordered for them, and whether it is one function.
#![allow(clippy::expect_used, reason = "helpers of tests")]

/// Several rods that hang on each other, expanded.
fn pendulum(rods: usize, limit: &str) -> String {
    expanded(rods, limit, "revolute pin[i] (rod[i-1].tip, rod[i].base);")
}

/// Several rods that hang on the ground, side by side.
fn row(rods: usize, limit: &str) -> String {
    expanded(rods, limit, "revolute pin[i] (ground, rod[i].base);")
}

/// Several rods, the first of which hangs on the ground.
fn expanded(rods: usize, limit: &str, pin: &str) -> String {
    let declaration = format!(
        "Pendulum {{ dof = {rods}; {limit}
            param l = 0.4 [m] where l > 0; param m = 1 [kg] where m > 0;
            gravity = (0, -9.81) [m/s^2];
            for i in 1..={rods} {{
                body rod[i] (x[i], y[i], theta[i]) {{ mass = m; inertia = m*l^2/12; }}
                point base on rod[i] = (-l/2, 0);
                point tip on rod[i] = (l/2, 0);
                if i == 1 {{ revolute pin[i] (rod[i].base, ground); }}
                if i > 1 {{ {pin} }}
            }} }}"
    );
    let tokens = declaration.parse().expect("tokens");
    mbs_codegen::compile(tokens).expect("a valid declaration").to_string()
}

/// Operations, lines and loops of the accelerations with reactions.
fn reactions(expansion: &str) -> [u32; 3] {
    let start = expansion.find("Function { name : \"reactions\"").expect("the function is described");
    let text = &expansion[start..];
    let number = |field: &str| {
        let from = text.find(&format!("{field} : ")).expect("a field") + field.len() + 3;
        let digits: String = text[from..].chars().take_while(char::is_ascii_digit).collect();
        digits.parse::<u32>().expect("a number")
    };
    let counts = ["mul", "add", "div", "sin_cos", "watch"].map(number);
    [counts.iter().sum(), number("written"), number("loops")]
}

#[test]
fn a_short_row_is_ordered_for_loops_if_it_is_to_have_them() {
    let [operations, written, loops] = reactions(&row(20, "limit unrolled = 100;"));
    assert!(operations < 1024, "{operations}");
    // what repeats itself is most of the row
    assert!(loops >= 1 && 2 * written < operations, "{written} of {operations} in {loops} loops");
    assert_eq!(reactions(&row(20, ""))[2], 0);
    assert_eq!(reactions(&row(20, "limit unrolled = 100;"))[0], reactions(&row(20, ""))[0]);
}

/// A chain is eliminated from both ends, and has half as many links that are alike.
#[test]
fn a_chain_is_ordered_for_loops() {
    let [operations, written, loops] = reactions(&pendulum(30, ""));
    assert!(loops >= 2 && 2 * written < operations, "{written} of {operations} in {loops} loops");
}

#[test]
fn a_longer_chain_is_one_function_if_it_is_to_be_straight() {
    let expansion = pendulum(20, "limit unrolled = 1000000;");
    let [operations, _, loops] = reactions(&expansion);
    assert!(operations > 1024 && loops == 0, "{operations}, {loops}");
    assert!(!expansion.contains("part_1"));
}
