//! Mechanisms whose stops rub, as texts.

/// Each with a word of what it does.
const ROUGH: [(&str, &str); 9] = [
    (
        "a rod in a corner",
        "Rod {
            dof = 3;
            gravity = (0, -9.81) [m/s^2];
            body rod (x, y, phi) { mass = 1 [kg]; inertia = 1/12*(1 [kg*m^2]); }
            point a on rod = (-0.5 [m], 0);
            point b on rod = (0.5 [m], 0);
            stop floor_a: rod.a.y >= 0 [m] { restitution = 0.5; friction = 0.4; along = rod.a.x; }
            stop floor_b: rod.b.y >= 0 [m] { restitution = 0.9; friction = 0.4; along = rod.b.x; }
            stop wall_a: rod.a.x <= 1 [m] { restitution = 0.3; friction = 0.6; along = rod.a.y; }
            stop wall_b: rod.b.x <= 1 [m] { restitution = 1; friction = 0.6; along = rod.b.y; }
            start { phi = -0.6; y = 1 [m]; der(x) = 2 [m/s]; der(phi) = -3 [rad/s]; }
        }",
    ),
    ("a block that stops on an incline", "Incline { param mu = 0.5; INCLINE }"),
    ("a block that slides on an incline", "Incline { param mu = 0.3; INCLINE }"),
    ("a block without friction", "Incline { param mu = 0; INCLINE }"),
    (
        "a cabinet that rocks",
        "Cabinet {
            dof = 3;
            const w = 0.1 [m];
            const h = 0.4 [m];
            gravity = (0, -9.81) [m/s^2];
            body cabinet (x, y, phi) { mass = 10 [kg]; inertia = 10 [kg]*(w^2 + h^2)/3; }
            point left on cabinet = (-w, -h);
            point right on cabinet = (w, -h);
            stop at_left: cabinet.left.y >= 0 [m] { restitution = 0; friction = 0.3; along = cabinet.left.x; }
            stop at_right: cabinet.right.y >= 0 [m] { restitution = 0; friction = 0.3; along = cabinet.right.x; }
            start { phi = -5 [deg]; y = h*cos(5 [deg]) + w*sin(5 [deg]); }
        }",
    ),
    (
        "a stack that is shaken",
        "Stack {
            dof = 4;
            input push [N];
            gravity = (0, -9.81) [m/s^2];
            body lower (xa, ya) { mass = 2 [kg]; }
            body upper (xb, yb) { mass = 1 [kg]; }
            stop floor: ya >= 0 [m] { restitution = 0.1; friction = 0.3; along = xa; }
            stop table: yb - ya >= 0.2 [m] { restitution = 0.2; friction = 0.5; along = xb - xa; }
            force shake on lower = (12 [N]*sin(9 [1/s]*t) + push, 0 [N]);
            output rests = table;
            start { yb = 0.4 [m]; ya = 0.05 [m]; }
        }",
    ),
    (
        "a block on a table that swings and then rises at once, pushed to a wall",
        "Moving {
            dof = 2;
            gravity = (0, -9.81) [m/s^2];
            body block (x, y) { mass = 2 [kg]; }
            stop table: y >= 0.02 [m]*sin(20 [1/s]*t) + (if t < 0.6 [s] { 0 [m] } else { 1 [m/s]*(t - 0.6 [s]) }) {
                restitution = 0.5; friction = 0.1; along = x;
            }
            stop wall: x <= 0.1 [m] { restitution = 0; }
            friction guide (block, ground) along (1, 0) { coefficient = 0.3; normal = 10 [N]; law = coulomb; }
            force push on x = 20 [N];
            output held [N] = force(guide);
            start { y = 5e-4 [m]; der(y) = 0.4 [m/s]; }
        }",
    ),
    (
        "two arms with a stop that rubs, one that does not, and a joint that sticks",
        "Arms {
            dof = 2;
            gravity = (0, -9.81) [m/s^2];
            body upper (xa, ya, pa) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
            body lower (xb, yb, pb) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
            point top on upper = (0, 0.3 [m]);
            point end on upper = (0, -0.3 [m]);
            point top on lower = (0, 0.3 [m]);
            point end on lower = (0, -0.3 [m]);
            revolute shoulder (ground, upper.top);
            revolute elbow (upper.end, lower.top);
            stop floor: lower.end.y >= -1 [m] { restitution = 0.4; friction = 0.5; along = lower.end.x; }
            stop wall: lower.end.x <= 0.9 [m] { restitution = 0.2; }
            torsion_friction stiff (lower, upper) { torque = 0.3 [N*m]; law = coulomb; }
            start { pa = 70 [deg]; pb = 20 [deg]; }
        }",
    ),
    (
        "stops that rub with modes and friction of an element",
        "Mixed {
            dof = 4;
            gravity = (0, -9.81) [m/s^2];
            body lower (xa, ya) { mass = 2 [kg]; }
            body upper (xb, yb) { mass = 1 [kg]; }
            stop floor: ya >= 0 [m] { restitution = 0.1; friction = 0.3; along = xa; }
            stop ceiling: yb <= 1 [m] { restitution = 0.2; friction = 0.2; along = xb - xa; }
            friction guide (upper, ground) along (1, 0) {
                coefficient = 0.4; static = 0.5; normal = 10 [N]; law = coulomb;
            }
            force shake on lower = (20 [N]*sin(5 [1/s]*t), 3 [N]*cos(3 [1/s]*t));
            force lift on upper = (12 [N]*sin(8 [1/s]*t), 14 [N]*cos(2 [1/s]*t));
            mode clutch { rate locked: der(xa) = der(xb); }
            when t > 0.3 [s] { enter clutch; }
            when t > 0.8 [s] { leave clutch; }
            mode hook { constraint hung: xb = 0.05 [m]; }
            when xb > 0.05 [m] { enter hook; }
            when t > 0.9 [s] { leave hook; }
            output held [N] = force(guide);
            start { ya = 0.05 [m]; yb = 0.5 [m]; der(xa) = 1 [m/s]; }
        }",
    ),
];

/// The blocks on an incline but for their friction.
const INCLINE: &str = "
    dof = 2;
    param slope = 20 [deg];
    gravity = ((9.81 [m/s^2])*sin(slope), -(9.81 [m/s^2])*cos(slope));
    body block (x, y) { mass = 2 [kg]; }
    stop floor: y >= 0 [m] { restitution = 0.2; friction = mu; along = x; }
    start { y = 0.05 [m]; der(x) = -1 [m/s]; }";

/// These texts in full.
pub fn rough() -> impl Iterator<Item = (&'static str, String)> {
    ROUGH.into_iter().map(|(name, text)| (name, text.replace("INCLINE", INCLINE)))
}
