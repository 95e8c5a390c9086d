//! Four-bar of Nikravesh: kinematics, damper force, joint reactions.
//!
//! P. E. Nikravesh, Planar Multibody Dynamics (CRC, 2nd ed. 2018), Examples 5.2
//! and 6.5, data of the companion script: crank 0.1, coupler 0.3, rocker 0.22 m,
//! pivots 0.2 m apart; crank at 45° with 1.5 rad/s and −1.2 rad/s²; coupler point
//! P 0.2 m from A, 30° ahead of the coupler; damper of 125 N s/m from P to
//! (0, 0.2). The reactions are those of the undriven crank. Reference:
//! intersection of circles with exact derivatives, Newton–Euler equations.
//!
//! One instant, no step and no feedback. Limit: rounding.

use mbs_runtime::{Error, Simulation, mechanism};
use paths::Case;

mechanism! {
    /// The crank is driven; masses play no part.
    Driven {
        dof = 0;
        const l1 = 0.1 [m];
        const l2 = 0.3 [m];
        const l3 = 0.22 [m];
        const c = 125 [N*s/m];
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 0.001 [kg*m^2]; }
        body coupler (x2, y2, theta2) { mass = 6 [kg]; inertia = 0.1 [kg*m^2]; }    // at the pin A
        body rocker (x3, y3, theta3) { mass = 3 [kg]; inertia = 0.015 [kg*m^2]; }
        point o on crank = (-l1/2, 0);
        point a on crank = (l1/2, 0);
        point b on coupler = (l2, 0);
        point p on coupler = (0.2 [m]*cos(30 [deg]), 0.2 [m]*sin(30 [deg]));
        point g on coupler = (0.16 [m]*cos(12 [deg]), 0.16 [m]*sin(12 [deg]));
        point q on rocker = (-l3/2, 0);
        point b on rocker = (l3/2, 0);
        point q on ground = (0.2, 0) [m];
        point post on ground = (0, 0.2) [m];
        revolute o (crank.o, ground);
        revolute a (coupler, crank.a);
        revolute b (coupler.b, rocker.b);
        revolute q (rocker.q, ground.q);
        drive motor: crank.angle = 45 [deg] + 1.5 [rad/s]*t - 0.6 [rad/s^2]*t^2;
        start { guess theta1 = 45 [deg]; guess theta2 = 0.5; guess theta3 = 1.3; }

        let px = coupler.p.x;
        let py = coupler.p.y;
        let length = sqrt(px^2 + (py - 0.2 [m])^2);
        let fx = -c*der(length)*px/length;
        let fy = -c*der(length)*(py - 0.2 [m])/length;
        output rp_x [m] = px;
        output rp_y [m] = py;
        output vp_x [m/s] = der(px);
        output vp_y [m/s] = der(py);
        output ap_x [m/s^2] = der(der(px));
        output ap_y [m/s^2] = der(der(py));
        output damper_rate [m/s] = der(length);
        output fp_x [N] = fx;
        output fp_y [N] = fy;
        output moment [N*m] = (px - coupler.g.x)*fy - (py - coupler.g.y)*fx;
    }
}

mechanism! {
    /// The crank is free; λ of a pin is the force on its second body.
    Free {
        dof = 1;
        const l1 = 0.1 [m];
        const l2 = 0.3 [m];
        const l3 = 0.22 [m];
        const gx = 0.16 [m]*cos(12 [deg]);
        const gy = 0.16 [m]*sin(12 [deg]);
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, theta1) { mass = 1 [kg]; inertia = 0.001 [kg*m^2]; }
        body coupler (x2, y2, theta2) { mass = 6 [kg]; inertia = 0.1 [kg*m^2]; }
        body rocker (x3, y3, theta3) { mass = 3 [kg]; inertia = 0.015 [kg*m^2]; }
        point o on crank = (-l1/2, 0);
        point a on crank = (l1/2, 0);
        point a on coupler = (-gx, -gy);
        point b on coupler = (l2 - gx, -gy);
        point p on coupler = (0.2 [m]*cos(30 [deg]) - gx, 0.2 [m]*sin(30 [deg]) - gy);
        point q on rocker = (-l3/2, 0);
        point b on rocker = (l3/2, 0);
        point q on ground = (0.2, 0) [m];
        point post on ground = (0, 0.2) [m];
        revolute o (ground, crank.o);
        revolute a (crank.a, coupler.a);
        revolute b (coupler.b, rocker.b);
        revolute q (ground.q, rocker.q);
        spring damper (coupler.p, ground.post) { damping = 125 [N*s/m]; }
        start { theta1 = 45 [deg]; der(theta1) = 1.5 [rad/s]; guess theta2 = 0.5; guess theta3 = 1.3; }
    }
}

#[test]
fn fourbar_nikravesh_statics() -> Result<(), Error> {
    let mut case = Case::new("fourbar_nikravesh_statics");
    let driven = Simulation::new(Driven::declared(), 1e-3)?;
    let (q, v, a) = (driven.state().q, driven.state().v, driven.reactions()?.acceleration);
    let o = driven.outputs()?;
    for (what, ours, reference) in [
        ("theta2", q.theta2, 0.2721247429362482),
        ("theta3", q.theta3, 0.7586309236111005),
        ("theta2 rate", v.theta2, 0.028622177505291023),
        ("theta3 rate", v.theta3, 0.7160755715521798),
        ("theta2 acceleration", a.theta2, 0.777949593219184),
        ("theta3 acceleration", a.theta3, 0.3656437407617549),
        ("P x", o.rp_x, 0.21066429596757313),
        ("P y", o.rp_y, 0.21358469552909545),
        ("velocity of P, x", o.vp_x, -0.11015538266519781),
        ("velocity of P, y", o.vp_y, 0.11007179447056153),
        ("acceleration of P, x", o.ap_x, -0.1855096498193453),
        ("acceleration of P, y", o.ap_y, -0.13519202597909882),
        ("damper rate", o.damper_rate, -0.10284379172196492),
        ("damper force x", o.fp_x, 12.82882844733247),
        ("damper force y", o.fp_y, 0.8272675141820698),
        ("moment about G2", o.moment, -0.883736017172995),
    ] {
        case.near(what, ours, reference, 1e-13);
    }

    let free = Simulation::new(Free::declared(), 1e-3)?.reactions()?;
    let lambda = free.multipliers;
    case.near("free crank", free.acceleration.theta1, -85.9387713578224, 1e-12);
    for (what, ours, reference) in [
        ("O on 1, x", lambda.o_x, 13.359813199766991),
        ("O on 1, y", lambda.o_y, 16.4417765599483),
        ("A on 2, x", lambda.a_x, 10.400968312952655),
        ("A on 2, y", lambda.a_y, 9.749720472529606),
        ("B on 3, x", lambda.b_x, -12.648692551457687),
        ("B on 3, y", lambda.b_y, -10.153491493534409),
        ("Q on 3, x", lambda.q_x, 21.626348175341803),
        ("Q on 3, y", lambda.q_y, 29.865908451197985),
    ] {
        case.near(what, ours, reference, 1e-12);
    }
    case.finish();
    Ok(())
}
