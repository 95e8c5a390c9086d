//! A member of a block that cannot take a step stays where it is, and the others go on.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use mbs_live::{Block, LANES, Live, Member, Stepper, Text};
use mbs_runtime::equations::At;
use mbs_runtime::{Gains, growth_limit};

const H: f64 = 1e-3;
const GAINS: Gains<f64> = Gains { minus_two_alpha: 0.0, minus_beta_squared: 0.0 };

/// A disc that a torque turns which depends on its angle.
fn disc() -> Live {
    let text = "Disc {
        dof = 1;
        param stiffness = 3 [N*m];
        input push [N*m];
        body disc (theta) { inertia = 2 [kg*m^2]; }
        torque turn on disc = push - stiffness*sin(theta);
        start { theta = 0.1; }
    }";
    Text::declaration("disc.mbs", text).compile().unwrap()
}

fn alone(disc: &Live, [q, v]: [f64; 2], push: f64, steps: usize) -> [f64; 2] {
    let mut stepper = Stepper::new(disc, true);
    let (mut q, mut v) = ([q], [v]);
    for k in 0..steps {
        let t = k as f64 * H;
        stepper.step(At { t, q: &q, v: &v }, &[push], &GAINS, H, t + H);
        (q, v) = ([stepper.q()[0]], [stepper.v()[0]]);
    }
    [q[0], v[0]]
}

#[test]
fn far_angles_and_growths_hold_back_their_own_lane() {
    let disc = disc();
    // the last one is beyond what lanes can compute
    let starts = [[0.1, 0.0], [2.0, 1.0], [1.1e5, 1.0]];
    let at =
        starts.each_ref().map(|[q, v]| At { t: 0.0, q: std::slice::from_ref(q), v: std::slice::from_ref(v) });
    let members = at.map(|at| Member { mechanism: &disc, at, inputs: &[0.5], gains: GAINS, step: H });
    let mut block = Block::new(true, &members).unwrap();
    let mut limits = [growth_limit(); LANES];
    let state = |block: &Block, lane| [block.position(0, lane), block.velocity(0, lane)];

    let taken = block.step(&limits);
    assert_eq!(taken[..3], [true, true, false]);
    assert_eq!(state(&block, 0), alone(&disc, starts[0], 0.5, 1));
    assert_eq!(state(&block, 2), starts[2]);
    assert_eq!([block.time(1), block.time(2)], [H, 0.0]);

    // that one is taken ahead by itself
    let [q, v] = alone(&disc, starts[2], 0.5, 1);
    block.put(2, &[q], &[v]);
    assert_eq!((state(&block, 2), block.time(2)), ([q, v], H));

    // without constraints the growth is 0, which is over a limit below 0
    limits[1] = -1.0;
    assert_eq!(block.step(&limits)[..2], [true, false]);
    assert_eq!(state(&block, 1), alone(&disc, starts[1], 0.5, 1));
    block.set_input(0, 0, -2.0);
    let before = state(&block, 0);
    assert!(block.step(&limits)[0]);
    assert_eq!(state(&block, 0), alone(&disc, before, -2.0, 1));
}

#[test]
fn members_of_a_block_are_of_one_kind() {
    let (disc, other) = (disc(), disc());
    let at = At { t: 0.0, q: &[0.1], v: &[0.0] };
    let member = |mechanism| Member { mechanism, at, inputs: &[0.0], gains: GAINS, step: H };
    assert!(Block::new(true, &[]).is_none());
    assert!(Block::new(true, &[member(&disc); LANES + 1]).is_none());
    assert!(Block::new(true, &[member(&disc), member(&other)]).is_none());
    assert!(Block::new(true, &[member(&disc), member(&disc.with_parameters(|_| ()).unwrap())]).is_some());
}
