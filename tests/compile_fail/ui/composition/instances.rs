use mbs_runtime::mechanism;

mechanism! {
    Instances {
        dof = 3;
        assembly Leg {
            param length = 1 [m] where length > 0;
            param phase = 0;
            body shank (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            point foot on shank = (length, 0);
        }
        assembly Leg { }
        instance left: Leg { lenght = 2 [m]; }
        instance right: Lag;
        instance third: Wheel;
        instance fourth: Leg { length = 2 [m]; colour = 3; }
    }
}

mechanism! {
    Shapes {
        dof = 0;
        instance fifth Leg;
        instance sixth: Leg { length: 2 [m]; }
        require gap;
        assembly { }
        assembly Wheel;
    }
}

mechanism! {
    Misplaced {
        dof = 1;
        assembly Leg {
            dof = 1;
            gravity = (0, -9.81) [m/s^2];
            body bob (x) { mass = 1 [kg]; }
        }
        instance left: Leg;
    }
}

mechanism! {
    Nested {
        dof = 1;
        assembly A { instance b: B; }
        assembly B { instance a: A; }
        instance a: A;
    }
}

mechanism! {
    Paths {
        dof = 3;
        assembly Leg {
            body shank (x, y, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            point foot on shank = (1 [m], 0);
        }
        instance left: Leg;
        revolute pin (left.shank.foot, right.shank.foot);
        revolute hip (left.shank.toe, ground);
        start { right.theta = 1; }
        output height [m] = left.shank.foot.y + left.y + left.z;
    }
}

mechanism! {
    Conditions {
        dof = 1;
        assembly Slider {
            param length = 1 [m] where length > 0;
            body block (x) { mass = 1 [kg]; }
        }
        param gap = -1 [m];
        instance slider: Slider { length = 2*gap; }
        require gap > 0;
        require gap > 1 [s];
        instance other: Slider { length = 2 [kg]; };
        require slider.x > 0;
    }
}

mechanism! {
    ConditionsOfValues {
        dof = 1;
        assembly Slider {
            param length = 1 [m] where length > 0;
            body block (x) { mass = 1 [kg]; }
        }
        param gap = -1 [m];
        instance slider: Slider { length = 2*gap; }
        require gap > 0;
    }
}

mechanism! {
    Multiplied {
        dof = 1;
        assembly A { let a = 1; }
        assembly B { for i in 1..=30 { instance a[i]: A; } }
        assembly C { for i in 1..=30 { instance b[i]: B; } }
        assembly D { for i in 1..=30 { instance c[i]: C; } }
        instance d: D;
    }
}

fn main() {}
