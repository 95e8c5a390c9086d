//! Properties of elements that are negative, or 0 where they divide.

use mbs_runtime::mechanism;

mechanism! {
    pub Bench {
        dof = 3;
        param slow = 0 [rad/s];
        param top = -3000 [rpm];
        body rotor (phi) { mass = 0; inertia = 1 [kg*m^2]; }
        body block (x, y) { mass = 1 [kg]; }
        friction rub (block, ground) along (1, 0) { coefficient = -0.3; normal = 2 [N]; transition = 0; }
        torsion_friction pin (rotor, ground) { torque = 1 [N*m]; transition = slow; }
        motor drive (rotor, ground) { stall = 2 [N*m]; no_load = top; }
        drag air on block { density = -1.2 [kg/m^3]; area = 1 [m^2]; coefficient = 1; }
    }
}

fn main() {}
