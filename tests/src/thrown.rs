//! Random blocks and rods on rough floors and walls, as texts.

use crate::random::Random;

/// Blocks and rods that are thrown on a rough floor and against a rough wall, alone, hung on each other or on springs. Outputs
/// are the gaps of their corners, of so many stops.
pub fn random(number: u64) -> (String, usize) {
    let mut random = Random::new(number ^ 0xabcd);
    let mut whole = |from: i64, to: i64| from + random.below((to - from + 1) as usize) as i64;
    let (bodies, is_hung, has_wall) = (whole(1, 2), whole(0, 1) == 1, whole(0, 1) == 1);
    let is_hung = is_hung && bodies == 2;
    let dof = 3 * bodies - 2 * i64::from(is_hung);
    let mut text = format!("Thrown {{\n    gravity = (0, -9.81) [m/s^2];\n    dof = {dof};\n");
    let places: Vec<String> = (0..bodies).flat_map(|at| corners(at, &mut text, &mut whole)).collect();
    if is_hung {
        text += "    revolute pin (b0.c1, b1.c0);\n";
    } else if whole(0, 2) == 0 {
        text += "    point nail on ground = (0, 2 [m]);\n";
        text += "    spring s (b0.c1, ground.nail) { stiffness = 30 [N/m]; length = 1 [m]; }\n";
    }
    let sides = if has_wall && places.len() < 6 { places.len().min(2) } else { 0 };
    let floor = places.iter().map(|place| (format!("{place}.y"), format!("{place}.x")));
    let wall = places.iter().take(sides).map(|place| (format!("2 [m] - {place}.x"), format!("{place}.y")));
    let mut stops = 0;
    for (gap, along) in floor.chain(wall) {
        // what loses nothing rattles for ever, however little
        let (e, mu) = (whole(0, 4).min(3), whole(0, 6));
        text += &format!(
            "    stop f{stops}: {gap} >= 0 [m] {{ restitution = {e}/4; friction = {mu}/8; along = {along}; }}\n    \
             output g{stops} [m] = {gap};\n"
        );
        stops += 1;
    }
    text += "    start { ";
    for body in 0..bodies {
        let [tilt, turn, height, across, down] =
            [(-8, 8), (-8, 8), (2, 4), (-2, 4), (-3, 0)].map(|(from, to)| whole(from, to));
        text += &format!("p{body} = {tilt}/4; der(p{body}) = {turn}/2*(1 [rad/s]); ");
        text += &if is_hung && body == 1 {
            "guess x1 = 0.5 [m]; guess y1 = 1 [m]; ".to_owned()
        } else {
            format!(
                "x{body} = {}/2*(1 [m]); y{body} = {height} [m]; der(x{body}) = {across}/2*(1 [m/s]); \
                 der(y{body}) = {down} [m/s]; ",
                -body
            )
        };
    }
    (text + "}\n}\n", stops)
}

/// A rod with two ends, or a block with three of its corners; gives the names of these.
fn corners(body: i64, text: &mut String, mut whole: impl FnMut(i64, i64) -> i64) -> Vec<String> {
    let [mass, inertia, width, height] = [(1, 5), (1, 8), (1, 4), (0, 3)].map(|(from, to)| whole(from, to));
    *text += &format!(
        "    body b{body} (x{body}, y{body}, p{body}) {{ mass = {mass} [kg]; inertia = {inertia}/16*(1 [kg*m^2]); }}\n"
    );
    let corners: &[[i64; 2]] = if height == 0 { &[[-1, 0], [1, 0]] } else { &[[-1, -1], [1, -1], [1, 1]] };
    let name = |(at, [x, y]): (usize, &[i64; 2])| {
        let [x, y] = [x * width, y * height].map(|eighths| format!("{eighths}/8*(1 [m])"));
        *text += &format!("    point c{at} on b{body} = ({x}, {y});\n");
        format!("b{body}.c{at}")
    };
    corners.iter().enumerate().map(name).collect()
}
