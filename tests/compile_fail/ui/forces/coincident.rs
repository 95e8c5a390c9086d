//! A spring with a free length has no direction where its places coincide.

use mbs_runtime::mechanism;

mechanism! {
    pub Springs {
        dof = 3;
        body bob (x, y) { mass = 1 [kg]; }
        body arm (phi) { inertia = 1 [kg*m^2]; }
        point tip on arm = (1 [m], 0);
        point mark on ground = (0, 1 [m]);
        spring free (bob, ground) { stiffness = 1 [N/m]; length = 0; damping = 1 [N*s/m]; }
        spring coil (bob, ground) { stiffness = 1 [N/m]; length = 0.2 [m]; }
        spring far (bob, arm.tip) { stiffness = 1 [N/m]; length = 0.2 [m]; }
        spring turned (ground.mark, arm.tip) { stiffness = 1 [N/m]; length = 0.2 [m]; }
        start { phi = 90 [deg]; }
    }
}

fn main() {}
