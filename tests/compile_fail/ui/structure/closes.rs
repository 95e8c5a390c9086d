//! A crank that cannot go round, as its declaration promises.

use mbs_runtime::mechanism;

mechanism! {
    pub Driven {
        dof = 0;
        param l1 = 60 [mm];
        param l2 = 50 [mm];
        param omega = 200 [rpm];
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        body rod (theta2) { inertia = 1 [kg*m^2]; }
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        drive motor: theta1 = omega*t;
        closes = 0 [s] .. 2*pi/omega;
    }
}

mechanism! {
    pub Free {
        dof = 1;
        param l1 = 60 [mm];
        param l2 = 50 [mm];
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        body rod (theta2) { inertia = 1 [kg*m^2]; }
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        closes theta1 = -30 [deg] .. 90 [deg];
    }
}

mechanism! {
    pub Misspelt {
        dof = 1;
        body crank (theta1) { inertia = 1 [kg*m^2]; }
        closes theta = 0 .. 1;
        closes = 0 [s];
    }
}

fn main() {}
