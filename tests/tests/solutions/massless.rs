//! Coordinates without mass: whatever position is regular for the dense
//! system is regular for the elimination at compile time, also those in which
//! single entries of the Jacobian vanish (dead centres, links that hang straight
//! down), and the solutions agree.

use mbs_runtime::mechanism;
use tests::solves_as_dense;

mechanism! {
    /// A slider-crank whose rod has no mass, at its dead centre.
    pub MasslessRod {
        dof = 1;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 2e-4 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 0; inertia = 0; }
        body slider (x3)             { mass = 2 [kg]; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        start { theta1 = 0; der(theta1) = 20 [rad/s]; }
    }
}

mechanism! {
    /// Three point masses on massless links that hang straight down.
    pub Hanging {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=3 {
            body link[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = 0; }
            point up on link[i] = (0, 0.5 [m]);
            point low on link[i] = (0, -0.5 [m]);
        }
        revolute j[1] (link[1].up, ground);
        for i in 2..=3 { revolute j[i] (link[i-1].low, link[i].up); }
        start { der(theta_1) = 0.1 [rad/s]; }
    }
}

mechanism! {
    /// Six of them, with the mass at the lower end.
    pub HangingSix {
        dof = 6;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=6 {
            body bob[i] (x[i], y[i], theta[i]) { mass = 0.3 [kg]; inertia = 0; }
            point up on bob[i] = (0, 0.4 [m]);
        }
        revolute j[1] (bob[1].up, ground);
        for i in 2..=6 { revolute j[i] (bob[i-1], bob[i].up); }
        start { der(theta_6) = 0.1 [rad/s]; }
    }
}

mechanism! {
    /// A cart with two massless poles and a bob at the end of each.
    pub TwoPoles {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body cart  (x) { mass = 1 [kg]; }
        for i in 1..=2 {
            body pole[i] (xp[i], yp[i], phi[i]) { mass = 0; inertia = 0; }
            point low on pole[i] = (0, -0.5 [m]);
            body bob[i] (x = u[i], y = w[i]) { mass = 0.2 [kg]; }
            revolute top[i] (pole[i], cart);
            revolute end[i] (pole[i].low, bob[i]);
        }
        start { der(phi_1) = 0.3 [rad/s]; }
    }
}

mechanism! {
    /// A platform on two massless legs that stand upright: in this position the
    /// x of the legs' upper ends does not depend on their angles to first order.
    pub Legs {
        dof = 1;
        param a = 0.4 [m];
        body left  (xl, yl, pl) { mass = 0; inertia = 0; }
        body right (xr, yr, pr) { mass = 0; inertia = 0; }
        body plate (x, y, p)    { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        point foot on left = (0, -a/2);     point knee on left = (0, a/2);
        point foot on right = (0, -0.6*a);  point knee on right = (0, 0.6*a);
        point l on plate = (-a/2, 0);       point r on plate = (a/2, 0);
        revolute f1 (left.foot, ground);
        revolute k1 (left.knee, plate.l);
        point g on ground = (a, -0.2*a);
        revolute f2 (right.foot, ground.g);
        revolute k2 (right.knee, plate.r);
        start { pl = 0; guess x = 0.2 [m]; guess y = 0.4 [m]; guess xr = 0.4 [m]; der(pl) = 1 [rad/s]; }
    }
}

#[test]
fn a_massless_rod_passes_its_dead_centres() {
    // a turn takes 0.314 s
    solves_as_dense!(MasslessRod, 400);
}

#[test]
fn point_masses_hang_straight_down() {
    solves_as_dense!(Hanging, 200);
    solves_as_dense!(HangingSix, 200);
}

#[test]
fn a_cart_carries_massless_poles() {
    solves_as_dense!(TwoPoles, 200);
}

#[test]
fn a_platform_stands_on_massless_legs() {
    solves_as_dense!(Legs, 50);
}
