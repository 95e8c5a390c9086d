//! Four-bar linkage: accelerations implied by the matrices asserted in SymPy.
//!
//! SymPy physics.mechanics tests, test_jointsmethod.py::
//! test_four_bar_linkage_with_manual_constraints: four uniform links of 0.13,
//! 0.24, 0.21 and 0.34 m with 997 kg/m, the first fixed with its middle at the
//! origin; relative angles. The solution of the asserted 3×3 system (tolerance
//! 1e-10) is the vector of relative accelerations; the reference agrees with
//! it and with Eksergian's equation to 3e-14.
//!
//! One instant, no step and no feedback. Limit: rounding.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::Case;

mechanism! {
    FourBar {
        dof = 1;
        const rho = 997 [kg/m];
        const l1 = 0.13 [m];
        const l2 = 0.24 [m];
        const l3 = 0.21 [m];
        const l4 = 0.34 [m];
        body link2 (x2, y2, angle2) { mass = rho*l2; inertia = rho*l2^3/12; }
        body link3 (x3, y3, angle3) { mass = rho*l3; inertia = rho*l3^3/12; }
        body link4 (x4, y4, angle4) { mass = rho*l4; inertia = rho*l4^3/12; }
        point right on ground = (l1/2, 0);
        point left on ground = (-l1/2, 0);
        point begin on link2 = (-l2/2, 0);
        point end on link2 = (l2/2, 0);
        point begin on link3 = (-l3/2, 0);
        point end on link3 = (l3/2, 0);
        point begin on link4 = (-l4/2, 0);
        point end on link4 = (l4/2, 0);
        revolute pin1 (link2.begin, ground.right);
        revolute pin2 (link3.begin, link2.end);
        revolute pin3 (link4.begin, link3.end);
        revolute pin4 (link4.end, ground.left);
        start {
            angle2 = 2.1; der(angle2) = 0.2 [rad/s];
            guess angle3 = 2.1 + 0.6655470375077588;
            guess angle4 = 2.1 + 0.6655470375077588 + 2.527408138024188;
        }
    }
}

#[test]
fn fourbar_sympy_matrices() -> Result<(), Error> {
    let mut case = Case::new("fourbar_sympy_matrices");
    let at = Simulation::new(FourBar::declared(), 1e-3)?;
    let (q, v, a) = (at.state().q, at.state().v, at.reactions()?.acceleration);
    for (what, ours, reference) in [
        ("q2", q.angle3 - q.angle2, 0.6655470375077588),
        ("q3", q.angle4 - q.angle3, 2.527408138024188),
        ("u2", v.angle3 - v.angle2, -0.17963733938852067),
        ("u3", v.angle4 - v.angle3, 0.1309060540601612),
        ("u1 rate", a.angle2, 0.004875813576761963),
        ("u2 rate", a.angle3 - a.angle2, -0.019901808571723627),
        ("u3 rate", a.angle4 - a.angle3, 0.01218057311406308),
        ("link 3", a.angle3, -0.015025994994961663),
        ("link 4", a.angle4, -0.0028454218808985827),
    ] {
        case.near(what, ours, reference, 1e-12);
    }
    for (what, ours, asserted) in [
        ("u1 rate of the matrices", a.angle2, 0.004875813576771052),
        ("u2 rate of the matrices", a.angle3 - a.angle2, -0.01990180857175026),
        ("u3 rate of the matrices", a.angle4 - a.angle3, 0.012180573114075468),
    ] {
        case.near(what, ours, asserted, 1e-12);
    }
    case.finish();
    Ok(())
}
