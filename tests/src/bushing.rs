//! A slider-crank whose crank pin is a bushing: a spring and dampers between the ends of crank and
//! rod, as a type and as a text, with all coordinates and with reduced states.

/// A type and its text.
macro_rules! crank {
    ($name:ident, $text:ident, $states:tt) => {
        crank!(@ $name, $text, {
            dof = 3;
            states = $states;
            param l1 = 60 [mm];
            param l2 = 180 [mm];
            param stiffness = 1e9 [N/m];
            param damping = 0 [N*s/m];
            gravity = (0, -9.81) [m/s^2];
            body crank (theta1) { inertia = 6e-4 [kg*m^2]; }
            body rod (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 3.24e-3 [kg*m^2]; }
            body slider (x3) { mass = 2 [kg]; }
            point pin on crank = (l1, 0);
            point pin on rod = (-l2/2, 0);
            constraint end_x: x2 + l2/2*cos(theta2) = x3;
            constraint end_y: y2 + l2/2*sin(theta2) = 0;
            spring bushing (crank.pin, rod.pin) { stiffness = stiffness; length = 0; }
            let rate_x = der(x2) + l2/2*sin(theta2)*der(theta2) + l1*sin(theta1)*der(theta1);
            let rate_y = der(y2) - l2/2*cos(theta2)*der(theta2) - l1*cos(theta1)*der(theta1);
            force damp_x on x2 = -damping*rate_x;
            force damp_y on y2 = -damping*rate_y;
            torque damp_rod on rod = -damping*l2/2*(sin(theta2)*rate_x - cos(theta2)*rate_y);
            torque damp_crank on crank = -damping*l1*(sin(theta1)*rate_x - cos(theta1)*rate_y);
            torque motor on crank = 0.5 [N*m];
            start {
                theta1 = 0; der(theta1) = 200 [rpm];
                theta2 = 0; der(theta2) = -(200/3) [rpm];
                x2 = l1 + l2/2; der(x2) = 0;
                guess y2 = 0; guess der(y2) = 100 [mm/s]; guess x3 = l1 + l2;
            }
        });
    };
    (@ $name:ident, $text:ident, { $($body:tt)* }) => {
        mbs_runtime::mechanism! { pub $name { $($body)* } }
        #[doc = "The declaration as a text."]
        pub const $text: &str = stringify!($name { $($body)* });
    };
}

crank!(Crank, CRANK, all);
crank!(ReducedCrank, REDUCED, reduced);
