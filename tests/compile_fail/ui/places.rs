//! rustc points at the tokens that the compiler points at, in each of several mechanisms.

use mbs_runtime::mechanism;

mechanism! {
    pub Attribute {
        #[allow(unused)]
        param l = 1 [m];
    }
}

mechanism! {
    #[derive(Clone)]
    pub Derived { dof = 0; }
}

mechanism! {
    pub Units {
        /* behind letters of several bytes: Φ̇ = −½ 𝜔 */ param torque = 1 [Nm];
        param empty = 1 [];
    }
}

mechanism! {
    pub Ends {
        dof = 1
        param l = 1 [m];
        body bob (x) { mass = 1 [kg] }
        param nested = (2 * );
    }
}

mechanism! {
    pub SecondPlaces {
        dof = 1;
        param l = 1 [m];
        param l = 2 [m];
        body bob (x) { mass = 1 [kg]; mass = 2 [kg]; }
    }
}

mechanism! {
    pub Formulas {
        dof = 3;
        param l = 1 [m];
        body arm (x, y, theta) { mass = 1 [kg] + 2*l; inertia = 1 [kg*m^2]; }
        prismatic guide (arm, ground) along (1, l);
        output speed [N] = der(x + 2*y) - arm.x;
    }
}

mechanism! {
    pub Copies {
        dof = 3;
        assembly Leg { param length = 1 [m]; body shank (x) { mass = length; } }
        for i in 1..=3 { instance leg[i]: Leg; }
        output last = leg[4].x;
    }
}

fn main() {}
