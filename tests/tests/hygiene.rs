//! Generated code stands anywhere: without a prelude, among names that shadow
//! its own, in any visibility and scalar, and silent under strict lints.
#![deny(warnings, rust_2018_idioms, unused_qualifications)]

use mbs_runtime::{Error, Simulation};

/// Runs a mechanism for a few steps.
fn runs<M: mbs_runtime::Mechanism>(mechanism: M) -> Result<Simulation<M>, Error> {
    let mut simulation = Simulation::new(mechanism, 1e-3)?;
    for _ in 0..10 {
        simulation.step()?;
    }
    Ok(simulation)
}

mod without_prelude {
    #![no_implicit_prelude]

    ::mbs_runtime::mechanism! {
        /// A weight on a massless rod.
        pub(crate) Pendulum {
            dof = 1;
            param length = 1 [m] where length > 0;
            input push [N];
            gravity = (0, -9.81) [m/s^2];
            profile unused = spline((0, 3.1415926), (1, 2), (2, 1)) period 3;
            body bob (x, y) { mass = 2 [kg]; }
            force pushed on bob = (push, 0);
            constraint rod: x^2 + y^2 = length^2;
            start { x = length; guess y = 0; }
            output height = y;
        }
    }
}

#[test]
fn without_the_prelude() {
    let simulation = runs(without_prelude::Pendulum::declared()).unwrap();
    assert!(simulation.state().q.y < 0.0);
}

/// Names that generated code could mistake for its own.
#[allow(dead_code, non_camel_case_types, unused_macros)]
mod shadowed {
    struct Real;
    struct State;
    struct Mechanism;
    struct Components;
    struct Error;
    struct Info;
    struct T;
    struct Default;
    struct From;
    enum Option {}
    enum Result {}
    type f64 = ();
    type usize = ();
    type str = ();
    mod core {}
    mod std {}
    mod mbs_runtime {}
    mod nalgebra {}
    const L: i32 = 0;
    static M: i32 = 0;
    fn push() {}
    fn phi() {}
    struct Theta;
    macro_rules! compile_error {
        () => {};
    }

    ::mbs_runtime::mechanism! {
        /// A weight on a massless rod.
        pub Pendulum {
            dof = 2;
            param L = 1 [m] where L > 0;
            param M = 1 [kg];
            input push [N];
            gravity = (0, -9.81) [m/s^2];
            body bob (x, y, angle = Theta) { mass = M; inertia = M*L^2*exp(1); }
            force pushed on bob = (push, 0);
            profile Segment = spline((0, 1), (1, 2), (2, 1)) period 3;
            torque spring on bob = -3 [N*m]*sin(Theta)*Segment(Theta);
            constraint rod: x^2 + y^2 = L^2;
            start { x = L; guess y = 0; }
            output height = y;
        }
    }
}

#[test]
fn among_names_that_shadow_its_own() {
    runs(shadowed::Pendulum::declared()).unwrap();
}

mod words_of_generated_code {
    //! Declared names that are also those of locals and arguments.

    mbs_runtime::mechanism! {
        pub Words {
            dof = 3;
            param parameters = 1 [kg];
            param hoisted = 2 [kg];
            param value = 3 [kg];
            param array = 1;
            param gains = 1 [N];
            param marker = 1;
            param v1 = 1;
            param union = 1;
            param auto = 1;
            param raw = 1;
            param default = 1;
            input inputs [N];
            input none [N];
            body a (x = q, y = at, angle = v0) { mass = parameters + hoisted*array; inertia = value*1 [m^2]; }
            body b (x = v, y = feedback, angle = growth) { mass = value*v1*marker*union*auto*raw*default; inertia = 1 [kg*m^2]; }
            force reactions on a = (inputs + none, gains*cos(v0)*sin(growth));
            constraint self_: q = v*cos(growth);
            constraint state: at = feedback*exp(array - 1) + v*sin(growth);
            constraint outputs: v0 = growth*marker;
            start { v = 1 [m]; feedback = 1 [m]; growth = 1; }
            output acceleration = der(der(q));
            output multipliers = lambda(outputs);
            output phi = at*parameters;
        }
    }
}

#[test]
fn declared_names_are_free() {
    runs(words_of_generated_code::Words::declared()).unwrap();
}

mod upper_case {
    mbs_runtime::mechanism! {
        pub Slider {
            dof = 1;
            param M = 2 [kg];
            param K = 3 [N/m];
            input Push [N];
            body Cart (x = X1) { mass = M; }
            force Spring on Cart = (-K*X1 + Push, 0);
            let Theta = X1/(1 [m]);
            constraint Nothing: Y2 = X1*sin(Theta);
            body Other (y = Y2) { mass = M; }
            start { X1 = 1 [m]; }
            output Position = X1;
        }
    }
}

#[test]
fn upper_case_names_give_no_warning() {
    runs(upper_case::Slider::declared()).unwrap();
}

mod private {
    mbs_runtime::mechanism! {
        Slider {
            dof = 1;
            body slider (x) { mass = 1 [kg]; }
        }
    }

    #[test]
    fn without_parameters_constraints_inputs_and_outputs() {
        let simulation = super::runs(Slider::declared()).unwrap();
        assert_eq!(simulation.state().q.x, 0.0);
    }
}

mod never_used {
    mbs_runtime::mechanism! {
        Slider {
            dof = 1;
            param m = 1 [kg];
            body slider (x, y) { mass = m; }
            constraint guide: y = 0;
            output position = x;
        }
    }
}

mod two_in_one_module {
    mbs_runtime::mechanism! {
        pub(super) First {
            dof = 1;
            body slider (x) { mass = 1 [kg]; }
        }
    }
    mbs_runtime::mechanism! {
        pub(in crate::two_in_one_module) Second {
            dof = 0;
            param speed = 2 [m/s];
            body slider (x) { mass = 1 [kg]; }
            drive motor: x = speed*t;
        }
    }

    #[test]
    fn two_mechanisms_share_a_module() {
        super::runs(First::declared()).unwrap();
        let second = super::runs(Second::declared()).unwrap();
        assert!((second.state().q.x - 0.02).abs() < 1e-15);
    }
}

#[test]
fn inside_a_function() {
    mbs_runtime::mechanism! {
        Local {
            dof = 1;
            param m = 1 [kg];
            body slider (x) { mass = m; }
            force push on x = 2 [N];
        }
    }
    let simulation = runs(Local::declared()).unwrap();
    assert!(simulation.state().v.x > 0.0);
}

#[test]
fn in_single_precision() {
    let simulation = runs(without_prelude::Pendulum::<f32>::default()).unwrap();
    let height: f32 = simulation.outputs().unwrap().height;
    assert!(height < 0.0);
}

#[test]
fn with_the_runtime_renamed() {
    let simulation = runs(renamed::Pendulum::declared()).unwrap();
    assert!(simulation.state().q.y < 0.0);
    runs(renamed::undocumented::Slider::declared()).unwrap();
}
