//! What a macro hands over is a parenthesis; a unit has none.

use mbs_runtime::mechanism;

macro_rules! slider {
    ($mass:expr, $unit:expr, $load:expr) => {
        mechanism! {
            pub Slider {
                dof = 1;
                body block (x) { mass = 1/$mass; }
                input push [1/$unit];
                force pushed on x = $load;
            }
        }
    };
}

slider!(1 [kg] + 1 [1], m*s, 3 [N] - 2);

fn main() {}
