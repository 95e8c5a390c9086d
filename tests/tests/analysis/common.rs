//! A four-bar linkage. A test adds its degrees of freedom, the place of the rocker's bearing and what acts on it.

macro_rules! four_bar {
    ($name:ident; $($statements:tt)*) => {
        mbs_runtime::mechanism! {
            /// A crank that turns a rocker.
            pub $name {
                gravity = (0, -9.81) [m/s^2];
                body crank (x1, y1, t1) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
                body coupler (x2, y2, t2) { mass = 2 [kg]; inertia = 0.05 [kg*m^2]; }
                body rocker (x3, y3, t3) { mass = 1.5 [kg]; inertia = 0.03 [kg*m^2]; }
                point a on crank = (-0.1, 0) [m];  point b on crank = (0.1, 0) [m];
                point a on coupler = (-0.25, 0) [m];  point b on coupler = (0.25, 0) [m];
                point a on rocker = (-0.15, 0) [m];  point b on rocker = (0.15, 0) [m];
                revolute o (crank.a, ground);
                revolute p (crank.b, coupler.a);
                revolute r (coupler.b, rocker.b);
                revolute s (rocker.a, ground.bearing);
                start { t1 = 1; guess t2 = 0.3; guess t3 = 1.2; guess x1 = 0.05 [m]; guess y1 = 0.08 [m];
                        guess x2 = 0.3 [m]; guess y2 = 0.25 [m]; guess x3 = 0.55 [m]; guess y3 = 0.14 [m]; }
                $($statements)*
            }
        }
    };
}
