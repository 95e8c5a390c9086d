//! A library with strict lints and without a prelude, in which `mbs-runtime`
//! has another name.
#![no_implicit_prelude]
#![deny(warnings, missing_docs, unsafe_code, unused_qualifications, unreachable_pub)]

::solver::mechanism! {
    /// A weight on a massless rod.
    pub Pendulum {
        crate = ::solver;
        dof = 1;
        param length = 1 [m] where length > 0;
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        force pushed on bob = (push, 0);
        constraint rod: x^2 + y^2 = length^2;
        start { x = length; guess y = 0; }
        output height = y;
        output pull [N] = lambda(rod)*length;
    }
}

pub mod undocumented {
    //! Declared without any doc comment.

    ::solver::mechanism! {
        pub Slider {
            crate = ::solver;
            dof = 1;
            body slider (x) { mass = 1 [kg]; }
        }
    }
}
