//! A spring that could do nothing is refused.

use mbs_runtime::mechanism;

mechanism! {
    pub Pendulum {
        dof = 2;
        body bob (x, y) { mass = 1 [kg]; }
        spring idle (bob, ground) { }
        spring slack (bob, ground) { length = 1 [m]; }
        spring bare (bob, ground) { stiffness = 1 [N/m]; }
        spring self_tied (bob, bob) { stiffness = 1 [N/m]; length = 0; }
        spring coloured (bob, ground) { stifness = 1 [N/m]; colour = 3; length = 0; }
        torsion_spring twist (bob, ground) { stiffness = 1 [N*m]; angle = 0; }
        torsion_spring idle_twist (bob, ground) { angle = 0; }
    }
}

fn main() {}
