//! Where a place is not in the block: tokens of other macros, and no tokens at all.

use mbs_runtime::mechanism;

mechanism! {}

// Groups nest as deep as a person writes them, and not as deep as a macro does.
macro_rules! deep {
    ($x:expr; $($level:tt)+) => { deep!(@ ($x) ; $($level)+); };
    (@ $x:tt ; ) => {
        mechanism! {
            pub Deep {
                dof = 1;
                body block (x) { mass = 1 [kg]; }
                let deep = $x;
            }
        }
    };
    (@ $x:tt ; $level:tt $($rest:tt)*) => { deep!(@ (((((((((((((((($x)))))))))))))))) ; $($rest)*); };
}

deep!(x; a b c d e f g h i j k l m n o p q);

// An expression that a macro hands over is a parenthesis, and a unit has none.
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
