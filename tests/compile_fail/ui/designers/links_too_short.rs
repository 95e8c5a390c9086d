//! The four bars do not reach from one bearing to the other.

use mbs_runtime::mechanism;

mechanism! {
    pub FourBar {
        dof = 1;
        param l1 = 40 [mm];
        param l2 = 100 [mm];
        param l3 = 60 [mm];
        param frame = 300 [mm];
        body crank   (x1, y1, a1) { mass = 0.1 [kg]; inertia = 1e-5 [kg*m^2]; }
        body coupler_link (x2, y2, a2) { mass = 0.2 [kg]; inertia = 1e-4 [kg*m^2]; }
        body rocker  (x3, y3, a3) { mass = 0.1 [kg]; inertia = 4e-5 [kg*m^2]; }
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point left on coupler_link = (-l2/2, 0);
        point right on coupler_link = (l2/2, 0);
        point base on rocker = (-l3/2, 0);
        point tip on rocker = (l3/2, 0);
        point far on ground = (frame, 0);
        revolute a (ground, crank.base);
        revolute b (crank.tip, coupler_link.left);
        revolute c (coupler_link.right, rocker.tip);
        revolute d (rocker.base, ground.far);
        start { a1 = 60 [deg]; guess a3 = 90 [deg]; guess x3 = frame; guess y3 = l3/2; }
    }
}

fn main() {}
