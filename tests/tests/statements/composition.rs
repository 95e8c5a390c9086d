//! Loops, conditions on whole numbers and assemblies are a way of writing: what
//! they give is what would be written out.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Components, Mechanism, Simulation, mechanism};

mechanism! {
    /// Three rods, written with a loop.
    pub Looped {
        dof = 3;
        const N = 3;
        param l = 0.5 [m];
        param m = 2 [kg];
        input torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=N {
            body link[i] (x[i], y[i], theta[i]) { mass = m*i; inertia = m*l^2/12; }
            point base on link[i] = (-l/2, 0);
            point tip on link[i] = (l/2, 0);
            if i == 1 {
                revolute pin[i] (link[i].base, ground);
            } else {
                revolute pin[i] (link[i-1].tip, link[i].base);
            }
            if i < N { torsion_spring hinge[i] (link[i], ground) { stiffness = 3 [N*m]; angle = 0; } }
            start { theta[i] = (i - 1)*20 [deg]; }
            /// Height of a tip.
            output height[i] [mm] = link[i].tip.y;
        }
        torque motor on link[N] = torque;
        output last = lambda(pin[2].x);
    }
}

mechanism! {
    /// The same, written out.
    pub Written {
        dof = 3;
        param l = 0.5 [m];
        param m = 2 [kg];
        input torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        body link_1 (x_1, y_1, theta_1) { mass = m; inertia = m*l^2/12; }
        body link_2 (x_2, y_2, theta_2) { mass = m*2; inertia = m*l^2/12; }
        body link_3 (x_3, y_3, theta_3) { mass = m*3; inertia = m*l^2/12; }
        point base on link_1 = (-l/2, 0);
        point tip on link_1 = (l/2, 0);
        point base on link_2 = (-l/2, 0);
        point tip on link_2 = (l/2, 0);
        point base on link_3 = (-l/2, 0);
        point tip on link_3 = (l/2, 0);
        revolute pin_1 (link_1.base, ground);
        revolute pin_2 (link_1.tip, link_2.base);
        revolute pin_3 (link_2.tip, link_3.base);
        torsion_spring hinge_1 (link_1, ground) { stiffness = 3 [N*m]; angle = 0; }
        torsion_spring hinge_2 (link_2, ground) { stiffness = 3 [N*m]; angle = 0; }
        start { theta_1 = 0; theta_2 = 20 [deg]; theta_3 = 40 [deg]; }
        output height_1 [mm] = link_1.tip.y;
        output height_2 [mm] = link_2.tip.y;
        output height_3 [mm] = link_3.tip.y;
        torque motor on link_3 = torque;
        output last = lambda(pin_2_x);
    }
}

/// The positions after a second, and the names of everything.
fn run<M: Mechanism<Real = f64>>() -> (Vec<f64>, Vec<&'static str>) {
    let mechanism = M::new(M::Parameters::default()).expect("declared values are valid");
    let mut simulation = Simulation::builder(mechanism, 1e-3).build().expect("the start is consistent");
    simulation.advance_to(1.0).expect("nothing is singular");
    let names = M::INFO.outputs.iter().chain(M::INFO.coordinates).chain(M::INFO.parameters).map(|q| q.name);
    (simulation.state().q.into_array().as_ref().to_vec(), names.collect())
}

#[test]
fn a_loop_is_what_it_writes() {
    // the same statements in the same order give the same code, to the bit
    assert_eq!(run::<Looped>(), run::<Written>());
    assert_eq!(<Looped>::INFO.functions, <Written>::INFO.functions);
    assert_eq!(<Looped>::INFO.outputs[0].doc, "Height of a tip.");
}

mechanism! {
    /// Two pendulums on a cart, from one assembly within another.
    pub Assembled {
        dof = 3;
        param m = 3 [kg];
        param size = 2;
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = m; }
        assembly Bob {
            param weight = 1 [kg] where weight > 0;
            body mass (x, y) { mass = weight; }
        }
        assembly Pendulum {
            param length = 1 [m] where length > 0;
            param lean = 0;
            instance bob: Bob { weight = m/2; }
            distance rod (bob.mass, cart) = length;
            start { guess bob.x = length*sin(lean); guess bob.y = -length*cos(lean); }
            output height [m] = bob.y;
        }
        instance left: Pendulum { lean = -30 [deg]; }
        instance right: Pendulum { length = size*0.3 [m]; lean = 50 [deg]; }
        output gap [m] = right.bob.x - left.bob.x;
        output tension [N] = lambda(left.rod);
        start { der(right.bob.x) = 0; }
    }
}

mechanism! {
    /// The same, written out.
    pub Flat {
        dof = 3;
        param m = 3 [kg];
        param size = 2;
        param left_length = 1 [m] where left_length > 0;
        gravity = (0, -9.81) [m/s^2];
        body cart (x) { mass = m; }
        let right_length = size*0.3 [m];
        body left_bob_mass (x1, y1) { mass = m/2; }
        body right_bob_mass (x2, y2) { mass = m/2; }
        distance left_rod (left_bob_mass, cart) = left_length;
        distance right_rod (right_bob_mass, cart) = right_length;
        start { guess x1 = left_length*sin(-30 [deg]); guess y1 = -left_length*cos(-30 [deg]); }
        start { guess x2 = right_length*sin(50 [deg]); guess y2 = -right_length*cos(50 [deg]); der(x2) = 0; }
        output left_height [m] = y1;
        output right_height [m] = y2;
        output gap [m] = x2 - x1;
        output tension [N] = lambda(left_rod);
    }
}

#[test]
fn an_assembly_is_its_statements_under_the_names_of_its_instances() {
    let (assembled, names) = run::<Assembled>();
    let (flat, _) = run::<Flat>();
    // the statements stand in another order, so sums may be rounded otherwise
    for (a, b) in assembled.iter().zip(&flat) {
        assert!((a - b).abs() < 1e-9, "{assembled:?} {flat:?}");
    }
    assert!(
        ["left_height", "left_bob_x", "left_length"].iter().all(|name| names.contains(name)),
        "{names:?}"
    );
    // a bound parameter is no field any more
    assert!(!names.contains(&"right_length") && !names.contains(&"left_bob_weight"), "{names:?}");
}

#[test]
fn the_condition_of_a_bound_parameter_still_holds() {
    let parameters = AssembledParameters { size: -1.0, ..Default::default() };
    let error = Assembled::new(parameters).expect_err("a length is negative");
    assert_eq!(error.to_string(), "`right_length` is -0.3, but `length > 0` has to hold");
}

mechanism! {
    /// A condition between parameters, as Grashof's.
    pub Required {
        dof = 1;
        param short = 1 [m];
        param long = 2 [m];
        require short + long <= 4 [m];
        body block (x) { mass = 1 [kg]; }
    }
}

#[test]
fn conditions_between_parameters_hold() {
    assert!(Required::new(RequiredParameters { short: 1.0, long: 3.0 }).is_ok());
    let error = Required::new(RequiredParameters { short: 1.5, long: 3.0 }).expect_err("too long together");
    assert_eq!(error.to_string(), "`short + long` is 4.5, but `short + long <= 4 [m]` has to hold");
}

mechanism! {
    /// Rods in a row, more than fit in one function.
    pub Long {
        dof = 20;
        const N = 20;
        param l = 0.1 [m];
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=N {
            body link[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = (1 [kg])*l^2/12; }
            point base on link[i] = (-l/2, 0);
            point tip on link[i] = (l/2, 0);
            if i == 1 { revolute pin[i] (link[i].base, ground); }
            if i > 1 { revolute pin[i] (link[i-1].tip, link[i].base); }
            start { theta[i] = -i*2 [deg]; }
        }
    }
}

#[test]
fn a_long_chain_agrees_with_a_dense_solution() {
    use nalgebra::{SMatrix, SVector};
    const N: usize = 60;
    const M: usize = 40;
    let long = Long::declared();
    let simulation = Simulation::builder(long, 1e-3).build().expect("the start is consistent");
    let at = simulation.state();
    let mut solved = Box::new(SMatrix::<f64, { N + M }, { N + M }>::zeros());
    let (mass, phi_q) = (long.mass(&at.q), long.phi_q(at.t, &at.q));
    solved.fixed_view_mut::<N, N>(0, 0).copy_from(&mass);
    solved.fixed_view_mut::<M, N>(N, 0).copy_from(&phi_q);
    solved.fixed_view_mut::<N, M>(0, N).copy_from(&phi_q.transpose());
    let mut rhs = SVector::<f64, { N + M }>::zeros();
    rhs.fixed_rows_mut::<N>(0).copy_from(&SVector::from(long.forces(&at, &Default::default())));
    rhs.fixed_rows_mut::<M>(N).copy_from(&SVector::from(long.gamma(&at)));
    let dense = solved.lu().solve(&rhs).expect("regular");
    let reactions = long.accelerations(&at, &Default::default());
    let ours = reactions.acceleration.into_array().into_iter().chain(reactions.multipliers.into_array());
    let largest = dense.amax();
    for (ours, dense) in ours.zip(&dense) {
        // both carry rounding times the condition of the chain, about N²
        assert!((ours - dense).abs() < 1e4 * f64::EPSILON * largest, "{ours} {dense}");
    }
}

mechanism! {
    /// Two pendulums from one assembly, each on a post of its own on the ground.
    pub Posts {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        assembly Arm {
            param base = 0 [m];
            param l = 0.5 [m];
            point post on ground = (base, 0);
            body rod (x, y, theta) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
            point top on rod = (-l/2, 0);
            revolute pin (rod.top, ground.post);
            output reach [mm] = rod.x - ground.post.x;
        }
        instance left: Arm { base = -1 [m]; }
        instance right: Arm { base = 2 [m]; }
    }
}

/// A point on an outer body belongs to the instance, not to the body: it was
/// declared twice by the second instance.
#[test]
fn instances_have_points_on_bodies_around_them() {
    let mechanism: Posts = Posts::new(Default::default()).expect("declared values are valid");
    let simulation = Simulation::builder(mechanism, 1e-3).build().expect("the start is consistent");
    let q = &simulation.state().q;
    assert!((q.left_x - (-1.0 + 0.25)).abs() < 1e-12 && (q.right_x - (2.0 + 0.25)).abs() < 1e-12);
    let outputs = simulation.outputs().expect("the start is regular");
    assert!((outputs.left_reach - 0.25).abs() < 1e-12 && (outputs.right_reach - 0.25).abs() < 1e-12);
}
