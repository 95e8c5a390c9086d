//! Laws of motion take a progress without dimension; a distance takes places.

use mbs_runtime::mechanism;

mechanism! {
    pub Lift {
        dof = 1;
        param stroke = 0.1 [m];
        body slider (x) { mass = 1 [kg]; }
        point tip on slider = (0, 1 [m]);
        drive a: x = stroke*cycloidal(t);
        drive b: x = stroke*harmonic(t/(2 [s]), 0.5);
        drive c: x = stroke*trapezoidal(t/(2 [s]));
        drive d: x = stroke*trapezoidal(t/(2 [s]), 0.6);
        drive e: x = stroke*trapezoidal(t/(2 [s]), 0);
        drive f: x = stroke*trapezoidal(t/(2 [s]), t/(1 [s]));
        drive g: x = stroke*cycloid(t/(2 [s]));
        drive h: x = stroke*polynomial_345;
        drive i: distance(slider.tip, x + 1) = stroke;
        drive j: distance(slider) = stroke;
        drive k: distance(slider.top, ground) = stroke;
        drive l: distance(slider, ground) = 3;
        param far = 3 [m] where far > distance(slider, ground);
    }
}

fn main() {}
