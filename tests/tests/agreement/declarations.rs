//! Declarations, each as a type and as a text.

use mbs_runtime::mechanism;

macro_rules! declare {
    ($text:ident; $($declaration:tt)*) => {
        mechanism! { $($declaration)* }
        pub const $text: &str = stringify!($($declaration)*);
    };
}

declare! { DRIVEN;
    /// Slider-crank driven at constant speed.
    pub Driven {
        dof = 0;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        param m1 = 0.5 [kg];   param m2 = 1.2 [kg];   param m3 = 2.0 [kg];
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = m1; inertia = m1*l1^2/12; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = m2*l2^2/12; }
        body slider (x3)             { mass = m3; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        drive crank_speed: theta1 = omega*t;
        /// Torque that keeps the speed.
        output torque [N*m] = effort(crank_speed);
    }
}

/// The parameters of [`Free`] in their order.
pub const FREE_PARAMETERS: [&str; 7] = ["l1", "l2", "m1", "m2", "m3", "inertia_factor", "omega"];

declare! { FREE;
    /// Slider-crank with a torque on the crank.
    pub Free {
        dof = 1;
        param l1 = 60 [mm] where l1 > 0;
        param l2 = 180 [mm] where l2 > 0;
        param m1 = 0.5 [kg];
        param m2 = 1.2 [kg];
        param m3 = 2.0 [kg];
        param inertia_factor = 1/12;
        param omega = 200 [rpm];
        input crank_torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = m1; inertia = inertia_factor*m1*l1^2; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = inertia_factor*m2*l2^2; }
        body slider (x3)             { mass = m3; }
        torque motor on crank = crank_torque;
        constraint crank_x: x1 = l1/2*cos(theta1);
        constraint crank_y: y1 = l1/2*sin(theta1);
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);
        start {
            theta1 = 0;
            guess x1 = l1/2;
            guess x2 = l1 + l2/2;
            guess x3 = l1 + l2;
            der(theta1) = omega;
        }
        output motor_power [W] = crank_torque*der(theta1);
    }
}

declare! { CAM;
    /// Cam and follower with a spring.
    pub Cam {
        dof = 0;
        param base = 25 [mm] where base > 0;
        param stroke = 10 [mm];
        param omega = 250 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body cam (theta) { inertia = 1e-4 [kg*m^2]; }
        body follower (y) { mass = 0.3 [kg]; }
        point tip on follower = (0, -30 [mm]);
        point head on follower = (0, 30 [mm]);
        point seat on ground = (0, 130 [mm]);
        profile law = spline(
            (0 [deg], 0), (40 [deg], 0.3), (80 [deg], 0.9), (120 [deg], 1), (180 [deg], 0.8),
            (240 [deg], 0.3), (300 [deg], 0.05),
        ) period 360 [deg];
        cam contact (cam, follower.tip) = base + stroke*law(90 [deg] - angle);
        drive motor: cam.angle = omega*t;
        spring press (follower.head, ground.seat) { stiffness = 4 [N/mm]; length = 60 [mm]; }
        start { guess y = base + 30 [mm]; der(theta) = omega; }
        output contact_force [N] = lambda(contact);
    }
}

declare! { INCLINE;
    /// Block that is thrown up a slope.
    pub Incline {
        dof = 1;
        method = rk4;
        param mass = 2 [kg] where mass > 0;
        param slope = 30 [deg] where abs(slope) < 90 [deg];
        param speed = 2 [m/s];
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = mass; }
        point_on_line guide (block, ground) along (cos(slope), sin(slope));
        friction rub (block, ground) along (cos(slope), sin(slope)) {
            coefficient = 0.3;
            normal = reaction(guide);
            transition = 1 [mm/s];
        }
        force push on block = (push*cos(slope), push*sin(slope));
        start { x = 0; der(x) = speed*cos(slope); }
        output friction [N] = force(rub);
    }
}

declare! { PARALLELOGRAM;
    /// Parallelogram with a spare link.
    pub Parallelogram {
        dof = 1;
        redundant = minimum_norm;
        param l = 1 [m];
        param w = 2 [m];
        param a = 0.3 [m];
        gravity = (0, -9.81) [m/s^2];
        body left  (angle = theta1) { inertia = 1 [kg*m^2]; }
        body right (angle = theta2) { inertia = 1 [kg*m^2]; }
        body spare (angle = theta3) { inertia = 1e-3 [kg*m^2]; }
        body top   (x, y, theta) { mass = 2 [kg]; inertia = 3 [kg*m^2]; }
        constraint left_x:  l*cos(theta1) = x;
        constraint left_y:  l*sin(theta1) = y;
        constraint right_x: w + l*cos(theta2) = x + w*cos(theta);
        constraint right_y: l*sin(theta2) = y + w*sin(theta);
        constraint spare_x: a + l*cos(theta3) = x + a*cos(theta);
        constraint spare_y: l*sin(theta3) = y + a*sin(theta);
        start {
            theta1 = -1; der(theta1) = 0.5 [rad/s];
            guess theta2 = -1; guess theta3 = -1; guess x = 0.5 [m]; guess y = -0.8 [m];
        }
    }
}

declare! { FUNCTIONS;
    /// A force with every function of the language in it.
    pub Functions {
        dof = 2;
        method = rk4;
        param k = 3 [N];
        param l = 2 [m];
        input first [1];
        input second [1];
        body one (x) { mass = 1 [kg]; }
        body two (y) { mass = 2 [kg]; }
        let u = x/l;
        let w = y/l + first;
        force elementary on x = -k*(sin(u) + cos(w) + tan(u/4) + asin(u/8) + acos(w/8) + atan(w) + sqrt(1 + u^2)
            + exp(-w^2) + ln(2 + u^2) + tanh(w) + abs(u) + sign(w));
        force others on y = k*(atan2(u, 1 + w^2) + min(u, w) + max(u, second) + pow(1 + u^2, w/3) - 2*w);
        table rises(u) = [(-1, -0.3), (0, 0), (0.25, 0.5), (2, 0.7)] monotone outside hold;
        table bends(u) = [(-0.5, 1), (0, 0.5), (0.4, 2), (0.9, -1)] cubic outside extend;
        table kinks(w) = [(-0.3, 0), (0, 1), (0.3, 0)] linear outside periodic;
        table steps(w) = [(-0.2, 1), (0.1, 2)] step outside extend;
        table all(w) = [(-100, 0.5), (0, 1), (100, 3)] cubic outside refuse;
        force by_tables on x = k*(rises(u) + bends(2*w) + kinks(w) - steps(u) + all(w));
        force chosen on y = k*(if u > w && !(w > 0.2) { sqrt(u - w) } else if u < -0.1 || t < 0.1 [s] { u } else { ln(w) })
            + k*(clamp(u, -0.1, w) - step(u) + ramp(w));
        start { x = 0.3 [m]; y = -0.4 [m]; der(x) = 1 [m/s]; }
        output largest = max(u, w);
    }
}

declare! { CHAIN;
    /// Four-bars side by side, too long for a step in one program.
    pub Chain {
        dof = 1;
        const N = 8;
        param l = 1 [m] where l > 0;
        param m = 1 [kg] where m > 0;
        gravity = (0, -9.81) [m/s^2];
        for i in 0..=N {
            body rocker[i] (x[i], y[i], theta[i]) { mass = m; inertia = m*l^2/12; }
            point foot on rocker[i] = (-l/2, 0);
            point head on rocker[i] = (l/2, 0);
            point pivot[i] on ground = (i*l, 0);
            revolute foot[i] (rocker[i].foot, ground.pivot[i]);
            start { theta[i] = 60 [deg]; guess x[i] = i*l + l/4; guess y[i] = 0.433*l; }
        }
        for i in 1..=N {
            body coupler[i] (xc[i], yc[i], phi[i]) { mass = m; inertia = m*l^2/12; }
            point left on coupler[i] = (-l/2, 0);
            point right on coupler[i] = (l/2, 0);
            revolute left[i] (rocker[i-1].head, coupler[i].left);
            revolute right[i] (rocker[i].head, coupler[i].right);
            start { guess xc[i] = i*l; guess yc[i] = 0.866*l; }
        }
    }
}

declare! { BOUNCER;
    /// A ball that passes a shelf.
    pub Bouncer {
        dof = 1;
        param shelf = 0.5 [m];
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 0.3 [kg]; }
        /// It stands still for a moment.
        event top: der(y) = 0 falling;
        event level: ball.y = shelf;
        event late: t = 0.65 [s] rising;
        start { y = 1 [m]; der(y) = 2 [m/s]; }
    }
}
