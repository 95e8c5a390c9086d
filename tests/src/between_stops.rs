//! Random mechanisms between random stops, as texts.

use crate::random::Random;

/// The same with friction that sticks, of the masses against the ground and against each other, and forces that change.
pub fn rubbing(number: u64) -> String {
    let (text, _) = random(number);
    let mut random = Random::new(!number);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let bodies: Vec<&str> =
        ["y1", "y2", "y3", "y4"].into_iter().filter(|it| text.contains(&format!("body b{it} "))).collect();
    let mut frictions = String::new();
    for (at, body) in bodies.iter().enumerate() {
        let (coefficient, more, normal) = (whole(0, 4), whole(0, 2), whole(1, 40));
        let (amplitude, rate) = (whole(0, 30), whole(1, 9));
        let on =
            if at > 0 && whole(0, 1) == 1 { format!("b{}", bodies[at - 1]) } else { "ground".to_owned() };
        frictions += &format!(
            "    friction f{at} (b{body}, {on}) along (0, 1) {{ coefficient = {coefficient}/8; \
             static = {}/8; normal = {normal} [N]; law = coulomb; }}\n    force p{at} on {body} = \
             {amplitude} [N]*sin({rate} [1/s]*t);\n    output h{at} [N] = force(f{at});\n",
            coefficient + more
        );
    }
    text.trim_end().trim_end_matches('}').to_owned() + &frictions + "}\n"
}

/// A mechanism of these with modes that tie masses to each other or hold one, which are entered and left on the way. Behind the
/// outputs of the others are two per mode: whether it holds, and by how much its constraint is off.
pub fn switching(number: u64, text: &str) -> String {
    let mut random = Random::new(number ^ 0x5a5a);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let names: Vec<&str> =
        ["y1", "y2", "y3", "y4"].into_iter().filter(|it| text.contains(&format!("body b{it} "))).collect();
    let mut modes = String::new();
    for mode in 0..whole(1, 3) {
        let one = names[whole(0, names.len() as i64 - 1) as usize];
        let other = names[whole(0, names.len() as i64 - 1) as usize];
        let (place, time) = (whole(-2, 4), whole(1, 15));
        // a hook, or a clutch between two
        let (row, off) = if one == other {
            (format!("constraint c{mode}: {one} = {place}/4*(1 [m]);"), format!("{one} - {place}/4*(1 [m])"))
        } else {
            // 9/8 or 17/8: with a whole number the row of a stop depends on it where the joint is at 0, within rounding and no further
            let factor = whole(1, 2) * 8 + 1;
            (
                format!("rate c{mode}: der({one}) = {factor}/8*der({other});"),
                format!("(der({one}) - {factor}/8*der({other}))*(1 [s])"),
            )
        };
        modes += &format!(
            "    mode m{mode} {{ {row} }}\n    when {one} > {place}/4*(1 [m]) {{ enter m{mode}; }}\n    \
             when {one} < {}/4*(1 [m]) {{ leave m{mode}; }}\n    when t > {time}/8*(1 [s]) {{ leave m{mode}; }}\n    \
             output e{mode} = m{mode};\n    output o{mode} [m] = {off};\n",
            place - 1
        );
    }
    text.trim_end().trim_end_matches('}').to_owned() + &modes + "}\n"
}

/// The same with modes that are left where they hold with more than a force, and a memory that counts jolts. Two more outputs per
/// mode are whether it holds, and by which share it does so with more.
pub fn letting_go(number: u64, text: &str) -> String {
    let mut random = Random::new(number ^ 0xa5a5);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let text = switching(number, text);
    let mut conditions = format!(
        "    memory jolts [1] = 0;\n    when abs(der(der(y1))) > {} [m/s^2] {{ set jolts = jolts + 1; }}\n",
        whole(1, 30)
    );
    for mode in (0..3).filter(|mode| text.contains(&format!("mode m{mode} "))) {
        let most = whole(1, 80);
        conditions += &format!(
            "    when abs(lambda(c{mode})) > {most} [N] {{ leave m{mode}; }}\n    output holds{mode} = m{mode};\n    \
             output over{mode} = max(abs(lambda(c{mode}))/({most} [N]) - 1, 0);\n"
        );
    }
    text.trim_end().trim_end_matches('}').to_owned() + &conditions + "}\n"
}

/// The same with the force of every stop as an output behind the others, and a memory that counts how often the first one
/// begins to bear much.
pub fn bearing(text: &str) -> String {
    let names = text.lines().filter_map(|line| line.trim_start().strip_prefix("stop ")?.split(':').next());
    let names: Vec<&str> = names.collect();
    let outputs = names.iter().map(|name| format!("    output n_{name} [N] = force({name});\n"));
    let counts = format!(
        "    memory presses [1] = 0;\n    when force({}) > 20 [N] {{ set presses = presses + 1; }}\n",
        names[0]
    );
    text.trim_end().trim_end_matches('}').to_owned() + &outputs.collect::<String>() + &counts + "}\n"
}

/// A random mechanism: masses on springs, hung in joints of their own, between stops, some of which say the same or are
/// reached at once. All start at 0, before every stop or at it.
pub fn random(number: u64) -> (String, usize) {
    let mut random = Random::new(number);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let (bodies, stops) = (whole(1, 4), whole(1, 4));
    let names: Vec<String> = (1..=bodies).map(|body| format!("y{body}")).collect();
    let mut text = String::from("Random {\n    gravity = (0, -9.81) [m/s^2];\n");
    let is_tied = bodies > 2 && whole(0, 1) == 1;
    text += &format!("    dof = {};\n", bodies - i64::from(is_tied));
    for name in &names {
        let (mass, stiffness) = (whole(1, 5), whole(1, 4) * 20);
        text += &format!("    body b{name} (y = {name}) {{ mass = {mass} [kg]; }}\n");
        text += &format!("    potential s{name} = {stiffness} [N/m]*({name} - 1 [m])^2/2;\n");
    }
    if is_tied {
        // a joint that is not linear
        text += "    constraint tie: y1^2 + 2*y1*[m] = y2*[m];\n".replace("[m]", "(1 [m])").as_str();
    }
    for stop in 0..stops {
        let mut factors: Vec<i64> = names.iter().map(|_| whole(-2, 2)).collect();
        factors[whole(0, bodies - 1) as usize] = 1;
        let sum: Vec<String> =
            factors.iter().zip(&names).map(|(factor, name)| format!("{factor}*{name}")).collect();
        let (gap, e) = (whole(0, 2), whole(0, 4));
        text += &format!("    stop s{stop}: {} >= -{gap} [m] {{ restitution = {e}/4; }}\n", sum.join(" + "));
        text += &format!("    output g{stop} [m] = {} + {gap} [m];\n", sum.join(" + "));
    }
    (text + "}\n", stops as usize)
}
