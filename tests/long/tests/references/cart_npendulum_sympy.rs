//! Cart with a double pendulum.
//!
//! SymPy physics.mechanics.models.n_link_pendulum_on_cart (mass matrix and
//! forcing of its test): cart 2 kg on the x axis, massless links of 0.8 and
//! 0.6 m with 1 and 0.5 kg at their ends, angles from the upward vertical.
//! (a) accelerations of a state under a force of 3 N on the cart, exact; (b)
//! free motion from rest. Reference: those matrices in 80-bit arithmetic.
//!
//! (b) h = 1e-5 s, deadbeat feedback, held. Limit: Heun's truncation.

use mbs_runtime::{Error, Mechanism, Simulation, mechanism, start};
use paths::{Case, Single, through_every_path};

mechanism! {
    CartPendulum {
        dof = 3;
        input push [N];
        const l0 = 0.8 [m];
        const l1 = 0.6 [m];
        gravity = (0, -9.81) [m/s^2];
        body cart (x0) { mass = 2 [kg]; }
        body first (x1, y1, q1) { mass = 1 [kg]; inertia = 0; }
        body second (x2, y2, q2) { mass = 0.5 [kg]; inertia = 0; }
        point base on first = (0, -l0);
        point base on second = (0, -l1);
        revolute lower (first.base, cart);
        revolute upper (second.base, first);
        force push on x0 = push;
        start {
            x0 = 0; q1 = 2.5; q2 = 2.0;
            der(x0) = 0; der(q1) = 0; der(q2) = 0;
        }
    }
}

/// t, then the cart's position and the angles.
const SAMPLES: [(f64, [f64; 3]); 2] = [
    (1.0, [-0.5316276365113671, 3.639339901784722, 4.56629354769386]),
    (2.0, [-0.03199891816115994, 2.6294304823996737, 1.8179496173801828]),
];

#[test]
fn cart_npendulum_sympy() -> Result<(), Error> {
    let mut case = Case::new("cart_npendulum_sympy, an instant");
    let names = ["cart", "angle 1", "angle 2"];

    let mut state = CartPendulum::<f64>::declared().declared_start();
    (state.q.x0, state.q.q1, state.q.q2) = (0.3, 0.7, -0.4);
    (state.v.x0, state.v.q1, state.v.q2) = (0.5, -1.2, 2.0);
    let pushed = Simulation::builder(CartPendulum::declared(), 1e-4)
        .from_state(start::consistent(&CartPendulum::declared(), &state)?)
        .inputs(CartPendulumInputs { push: 3.0 })
        .build()?;
    let a = pushed.reactions()?.acceleration;
    let reference = [2.9202847425846037, 10.54315175089059, -6.549381474874766];
    case.all_near(names, "the pushed state", [a.x0, a.q1, a.q2], reference, [1e-12; 3]);
    case.finish();

    let start = |h| Simulation::new(CartPendulum::declared(), h);
    through_every_path("cart_npendulum_sympy", 1e-5, Single::Longer(100.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            let q = run.now()?.q;
            case.all_near(names, t, [q.x0, q.q1, q.q2], reference, [2e-8; 3]);
        }
        Ok(())
    })
}
