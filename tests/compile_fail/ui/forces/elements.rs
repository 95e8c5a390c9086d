//! Force elements that could do nothing, or do not say what they need.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 7;
        body rotor (phi) { mass = 0; inertia = 1 [kg*m^2]; }
        body block (x, y) { mass = 1 [kg]; }
        body arm (xa, ya, phia) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body hand (xh, yh, phih) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point tip on arm = (0.1 [m], 0);
        revolute pin (arm.tip, hand);
        motor unsaid (rotor, ground) { no_load = 3000 [rpm]; }
        motor misspelt (rotor, ground) { stal = 2 [N*m]; no_load = 3000 [rpm]; }
        motor still (block, ground) { stall = 2 [N*m]; no_load = 3000 [rpm]; }
        friction stuck (arm.tip, hand) along (1, 0) { coefficient = 0.3; normal = 2 [N]; transition = 1e-3 [m/s]; }
        friction sharp (block, ground) along (1, 0) { coefficient = 0.3; normal = 2 [N]; }
        friction nowhere (block, ground) along (0, 0) { viscous = 1 [N*s/m]; }
        friction idle (block, ground) along (1, 0) { }
        torsion_friction both (rotor, ground) {
            torque = 1 [N*m]; coefficient = 0.1; transition = 0.1 [rad/s];
        }
        torsion_friction half (rotor, ground) { coefficient = 0.1; normal = 3 [N]; transition = 0.1 [rad/s]; }
        drag air on rotor { density = 1.2 [kg/m^3]; area = 1 [m^2]; coefficient = 1; }
        drag gust on block { density = 1.2 [kg/m^3]; area = 1 [m^2]; coefficient = 1; wind = 3 [m/s]; }
        drag thin on block { density = (1.2, 1.3) [kg/m^3]; area = 1 [m^2]; coefficient = 1; }
    }
}

fn main() {}
