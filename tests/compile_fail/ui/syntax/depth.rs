//! Formulas and groups nest as deep as a person writes them, and a hundred times deeper.

use mbs_runtime::mechanism;

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

fn main() {}
