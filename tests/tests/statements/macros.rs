//! Declarations inside `macro_rules!`: what a macro hands over as a fragment
//! means what it means in Rust. A group without delimiters is a parenthesis.

use mbs_runtime::{Mechanism, Simulation, mechanism};

#[test]
fn fragments_in_formulas_keep_their_grouping() {
    mod declared {
        use super::*;
        macro_rules! given {
            ($u:expr, $v:literal, $side:expr, $at:expr) => {
                mechanism! {
                    pub Given {
                        dof = 1;
                        param side = $side;
                        body rod (x) { mass = 1 [kg]; }
                        point edge on rod = (2 [m], 0);
                        output quotient = 1/$u;
                        output difference = 10 - $u;
                        output twice = 2*$u;
                        output square = $v^2;
                        output opposite = -$u^2;
                        output root = 16^(1/$u);
                        output minus = 1 - $v;
                        output with_unit [mm] = $u [mm];
                        output place [m] = $at;
                        output literal = $v;
                    }
                }
            };
            // through a second macro, so that groups stand in groups
            (nested $u:expr) => {
                given!(1 * $u, -3, 60[mm], rod.edge.x);
            };
        }
        given!(nested 1 + 1);
    }
    let given = declared::Given::declared();
    assert_eq!(given.parameters().side, 0.06);
    let start = given.declared_start();
    let found = Simulation::new(given, 1e-3).unwrap().outputs().unwrap();
    assert_eq!(start.q.x, 0.0);
    assert_eq!(found.quotient, 0.5);
    assert_eq!(found.difference, 8.0);
    assert_eq!(found.twice, 4.0);
    assert_eq!(found.square, 9.0);
    assert_eq!(found.opposite, -4.0);
    assert_eq!(found.root, 4.0);
    assert_eq!(found.minus, 4.0);
    assert_eq!(found.with_unit, 2e-3);
    assert_eq!(found.place, 2.0);
    assert_eq!(found.literal, -3.0);
}

#[test]
fn fragments_in_ranges_and_indices_keep_their_grouping() {
    mod declared {
        use super::*;
        macro_rules! chain {
            ($name:ident, $n:expr, $range:expr, $is_first:expr) => {
                mechanism! {
                    pub $name {
                        dof = 7;
                        for i in 1..=2*$n {
                            body w[i] (x = z[i]) { mass = 1 [kg]; }
                            if i - $n > 0 { start { z[i] = 1 [m]; } }
                        }
                        for k in $range { body v[k] (y[k]) { mass = 1 [kg]; } }
                        let last = z[2*$n];
                        for j in 1..=1 { if $is_first { output first [m] = last + z[j*$n]; } }
                    }
                }
            };
        }
        chain!(Weights, 1 + 1, 3..6, j == 1);
    }
    let weights = declared::Weights::declared();
    let start = weights.declared_start();
    // four weights, of which the last two start at 1 m
    assert_eq!([start.q.z_1, start.q.z_2, start.q.z_3, start.q.z_4], [0.0, 0.0, 1.0, 1.0]);
    assert_eq!([start.q.y_3, start.q.y_4, start.q.y_5], [0.0; 3]);
    let found = Simulation::new(weights, 1e-3).unwrap().outputs().unwrap();
    assert_eq!(found.first, 1.0);
}

#[test]
fn fragments_stand_for_whole_statements_parts() {
    mod declared {
        use super::*;
        macro_rules! swing {
            ($vis:vis $name:ident, $gravity:expr, $unit:expr, $length:expr, $condition:expr, $place:expr) => {
                mechanism! {
                    $vis $name {
                        dof = 1;
                        gravity = $gravity;
                        param length = $length;
                        require $condition;
                        input push [$unit];
                        body bob (x, y) { mass = 1 [kg]; }
                        point hook on ground = (0, 1 [m]);
                        distance string (bob, $place) = length - $length/2;
                        force pushed on bob = (push, 0);
                        start { x = 0; y = 0.5 [m]; }
                    }
                }
            };
        }
        swing!(pub Swing, (0, -9.81) [m/s^2], kg*m/s^2, 1 [m], length > 0.3 [m] + 0.2 [m], ground.hook);
    }
    let swing = Simulation::new(declared::Swing::declared(), 1e-3).unwrap();
    assert_eq!(swing.state().q.y, 0.5);
    assert!((swing.reactions().unwrap().multipliers.string - 9.81).abs() < 1e-12);
    let parameters = declared::SwingParameters { length: 0.4 };
    let refused = declared::Swing::new(parameters).unwrap_err().to_string();
    assert_eq!(refused, "`length` is 0.4, but `length > 0.3 [m] + 0.2 [m]` has to hold");
}
