//! Whatever is declared, the compiler answers: it never panics.

mod declarations;

use proc_macro2::{Group, TokenStream, TokenTree};

const MUTATIONS: usize = 20_000;

/// Statements that the mechanisms of `models` do not use.
const FROM_PARTS: &str = "pub Swing {
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
}";

/// Valid declarations with a few random tokens deleted, doubled, exchanged
/// with a neighbour or replaced by another one of the declaration.
#[test]
fn mutated_declarations_do_not_panic() {
    let mut random = Random(1);
    let mut declarations = Vec::from(declarations::of_models().map(|(_, declaration)| declaration));
    declarations.push(FROM_PARTS.parse().unwrap());
    let mut compiled = 0;
    for round in 0..MUTATIONS {
        let declaration = &declarations[round % declarations.len()];
        let all = flat(declaration);
        let mut mutated = declaration.clone();
        for _ in 0..=random.below(3) {
            mutated = mutate(mutated, &all, &mut random);
        }
        let text = mutated.to_string();
        let answer = std::panic::catch_unwind(|| mbs_codegen::compile(mutated).is_ok());
        compiled += usize::from(answer.unwrap_or_else(|_| panic!("the compiler panicked on\n{text}")));
    }
    assert!(0 < compiled && compiled < MUTATIONS, "{compiled} of {MUTATIONS} mutations compile");
}

/// One change to one token, at any depth.
fn mutate(stream: TokenStream, all: &[TokenTree], random: &mut Random) -> TokenStream {
    let mut tokens: Vec<TokenTree> = stream.into_iter().collect();
    if tokens.is_empty() {
        return all[random.below(all.len())].clone().into();
    }
    // Groups are most of a declaration: descend into one where there is any.
    let groups: Vec<usize> =
        (0..tokens.len()).filter(|&at| matches!(tokens[at], TokenTree::Group(_))).collect();
    let at = match groups.as_slice() {
        [_, ..] if random.below(2) == 0 => groups[random.below(groups.len())],
        _ => random.below(tokens.len()),
    };
    if let TokenTree::Group(group) = &tokens[at]
        && random.below(8) != 0
    {
        let inner = mutate(group.stream(), all, random);
        tokens[at] = Group::new(group.delimiter(), inner).into();
        return tokens.into_iter().collect();
    }
    match random.below(4) {
        0 => drop(tokens.remove(at)),
        1 => tokens.insert(at, tokens[at].clone()),
        2 => {
            let next = (at + 1) % tokens.len();
            tokens.swap(at, next);
        }
        _ => tokens[at] = all[random.below(all.len())].clone(),
    }
    tokens.into_iter().collect()
}

/// All tokens, at every depth.
fn flat(stream: &TokenStream) -> Vec<TokenTree> {
    let mut all = Vec::new();
    for token in stream.clone() {
        if let TokenTree::Group(group) = &token {
            all.extend(flat(&group.stream()));
        }
        all.push(token);
    }
    all
}

/// A small fixed generator (SplitMix64, Steele et al. 2014).
struct Random(u64);

impl Random {
    fn below(&mut self, limit: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) % limit as u64) as usize
    }
}
