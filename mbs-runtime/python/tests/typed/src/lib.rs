//! A mechanism that rustc compiles, as the Python module `typed`.
//!
//! An interpreter links `mbs-python` and this library, so they are no part of the tests of the workspace.
//! `.ci/run` builds the wheels and runs the tests in Python.

mbs_runtime::mechanism! {
    /// A weight on a massless rod, pushed at its end.
    pub Pendulum {
        dof = 1;
        param length = 500 [mm] where length > 0;
        gravity = (0, -9.81) [m/s^2];
        input push [N];
        body bob (x, y) { mass = 2 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        force hand on x = push;
        start { x = length; guess y = 0; }
        output tension [N] = 2*lambda(rod)*sqrt(x^2 + y^2);
    }
}

mbs_python::module!(typed: Pendulum);
