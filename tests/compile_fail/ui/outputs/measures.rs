//! What measures the mechanism: of things that exist, for outputs.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 2;
        body arm (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body bob (xb) { mass = 1 [kg]; }
        point tip on arm = (0.1 [m], 0);
        revolute pin (ground, arm.tip);
        constraint wall: xb = x;
        spring s (bob, ground) { stiffness = 1 [N/m]; length = 0; }
        torsion_spring twist (arm, ground) { stiffness = 1 [N*m]; angle = 0; }
        force pushed on bob = (1 [N], 0);
        force wall on xb = 1 [N];
        force late on phi = power(s)/(1 [1/s]);
        output a = power(spring_s);
        output b = force(twist);
        output c = force(pushed);
        output d = length(twist);
        output e = reaction(pin).x;
        output f = reaction(pin, bob).x;
        output g = reaction(pin, arm).torque;
        output h = reaction(pin, arm);
        output i = reaction(wall);
        output j = reaction(pin, arm).z;
        output k = kinetic_energy;
        output l = kinetic_energy(arm);
        output m = sin(phi).x;
        output n = speed(arm.tip.x);
        output o = transmission_angle(arm);
        output p = transmission_angle(arm, phi + 1);
        output q = power(wall);
        output r = power(2*x);
        output u = reactoin(pin);
    }
}

fn main() {}
