//! Driven four-bar with gravity: all joint forces and the driving torque.
//!
//! Example "fourbar" of A.-S. Koh's CADSM / FreeCAD solver with its stored
//! series (Ondsel-Development/OndselSolver, testapp/fourbar.asmt): three uniform
//! bars pinned 0.1 m inside their ends, crank at one turn a second. Reference:
//! closed-form kinematics and Newton–Euler equations in 80-bit arithmetic; all
//! 125 stored numbers agree to 3e-11 relative.
//!
//! Twice: instant by instant from kinematic analysis (limit: rounding), and
//! integrated with h = 1e-4 s, deadbeat feedback, held (limit: Heun's
//! truncation).

use mbs_runtime::{Components, Error, Kinematics, Simulation, mechanism};
use paths::{Case, Single, through_every_path};

mechanism! {
    FourBar {
        dof = 0;
        const l1 = 0.8 [m];
        const l2 = 1.8 [m];
        const l3 = 1.3 [m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, theta1) { mass = 0.2 [kg]; inertia = (0.052/3) [kg*m^2]; }
        body coupler (x2, y2, theta2) { mass = 0.4 [kg]; inertia = (0.404/3) [kg*m^2]; }
        body rocker (x3, y3, theta3) { mass = 0.3 [kg]; inertia = 0.05725 [kg*m^2]; }
        point o on crank = (-l1/2, 0);
        point a on crank = (l1/2, 0);
        point a on coupler = (-l2/2, 0);
        point c on coupler = (l2/2, 0);
        point corner on coupler = (-l2/2 - 0.1 [m], -0.1 [m]);
        point c on rocker = (-l3/2, 0);
        point d on rocker = (l3/2, 0);
        point corner on rocker = (-l3/2 - 0.1 [m], -0.1 [m]);
        point d on ground = (2, 0) [m];
        // λ: the force on the second body
        revolute o (crank.o, ground);
        revolute a (coupler.a, crank.a);
        revolute c (rocker.c, coupler.c);
        revolute d (ground.d, rocker.d);
        drive motor: crank.angle = 1 [rev/s]*t;
        start { guess theta2 = 0.8; guess theta3 = -1.6; der(theta1) = 1 [rev/s]; }

        output coupler_corner_x [m] = coupler.corner.x;
        output coupler_corner_vx [m/s] = der(coupler.corner.x);
        output coupler_corner_ax [m/s^2] = der(der(coupler.corner.x));
        output coupler_corner_y [m] = coupler.corner.y;
        output coupler_corner_vy [m/s] = der(coupler.corner.y);
        output coupler_corner_ay [m/s^2] = der(der(coupler.corner.y));
        output rocker_corner_x [m] = rocker.corner.x;
        output rocker_corner_vx [m/s] = der(rocker.corner.x);
        output rocker_corner_ax [m/s^2] = der(der(rocker.corner.x));
        output rocker_corner_y [m] = rocker.corner.y;
        output rocker_corner_vy [m/s] = der(rocker.corner.y);
        output rocker_corner_ay [m/s^2] = der(der(rocker.corner.y));
        output coupler_rate [rad/s] = der(theta2);
        output coupler_acceleration [rad/s^2] = der(der(theta2));
        output rocker_rate [rad/s] = der(theta3);
        output rocker_acceleration [rad/s^2] = der(der(theta3));
        output o_on_ground_x [N] = lambda(o_x);
        output o_on_ground_y [N] = lambda(o_y);
        output a_on_crank_x [N] = lambda(a_x);
        output a_on_crank_y [N] = lambda(a_y);
        output c_on_coupler_x [N] = lambda(c_x);
        output c_on_coupler_y [N] = lambda(c_y);
        output d_on_rocker_x [N] = lambda(d_x);
        output d_on_rocker_y [N] = lambda(d_y);
        output drive_torque [N*m] = effort(motor);
    }
}

/// t, then the outputs in order.
const SAMPLES: [(f64, [f64; 25]); 5] = [
    (
        0.0,
        [
            0.8029643586684714,
            -0.5922542391609715,
            -31.415947793824476,
            -0.1413902845943973,
            5.014131169189703,
            2.48541604528147,
            1.9494211444077576,
            5.875428615215505,
            -58.1129310439257,
            1.4026552603426756,
            0.21186421487409032,
            -26.7384541773917,
            -4.188790204786391,
            1.5474812780133578,
            -4.188790204786391,
            42.06335473872672,
            27.138030750486898,
            14.260541779148461,
            23.979757342138303,
            16.22254177914846,
            6.572699505846626,
            15.973008219032465,
            -1.745183758849239,
            15.78585804894547,
            -12.19323342331877,
        ],
    ),
    (
        0.1,
        [
            0.6024082687668941,
            -3.2759148569931513,
            -22.574467425068086,
            0.3360921414462386,
            4.17391448832034,
            -18.702166136603488,
            2.1794923314995858,
            -1.1233303985748486,
            -55.753550666303134,
            1.3920425650578516,
            0.14484412858178586,
            6.267397284770173,
            -2.395954728947708,
            20.27263774385279,
            0.806965553189219,
            39.967647427249275,
            26.113617331552046,
            8.471564331232026,
            23.558520471315546,
            8.577177799097237,
            8.229372378695174,
            10.682275257152648,
            0.5651565995846481,
            15.045678148896389,
            6.161531173685001,
        ],
    ),
    (
        0.25,
        [
            -0.07020349869090146,
            -5.096111089996357,
            0.8973079686239398,
            0.6772340895380293,
            0.039779406408928845,
            -32.043552303405235,
            1.618544911332482,
            -5.048837078164868,
            -2.741393073091489,
            1.3507375819638898,
            -1.4258169914241117,
            -21.15098347313066,
            -0.5666299707379733,
            7.125494051587329,
            3.7378371236433416,
            5.975153770004274,
            1.799251485839975,
            5.264110092932715,
            1.799251485839975,
            4.06783668458412,
            1.0135699381716,
            -2.1966298094324506,
            0.4243087774203186,
            -2.157569567421987,
            1.4394011886719802,
        ],
    ),
    (
        0.5,
        [
            -0.8567928266638108,
            0.23250783101153488,
            33.556501943900976,
            -0.12951669714571298,
            -5.12850248975717,
            -0.36783903285843866,
            0.7400373204356062,
            -1.1102586454795333,
            16.8259063736317,
            0.6184610303850298,
            -2.26187971309532,
            24.013218706764093,
            1.7951958020513104,
            13.826325632331397,
            1.7951958020513104,
            -20.640571969410463,
            -21.257053312551307,
            -10.084256834912026,
            -18.09877990420271,
            -8.122256834912026,
            -8.356358160410188,
            0.016635572980210137,
            -5.78695196508869,
            6.120804878899388,
            -7.282605467929621,
        ],
    ),
    (
        0.77,
        [
            0.14000564803748136,
            5.260838659633434,
            -6.241817111688548,
            -0.9294150347228739,
            0.7101977110458054,
            31.26536532929979,
            0.8240210566459838,
            1.7556037939598015,
            17.65458465221346,
            0.7662072335784698,
            2.694510054319021,
            13.59800617100888,
            2.0182702697553783,
            -15.631639169851082,
            -2.2912910724693707,
            -14.983776342666904,
            -4.384220709476278,
            -20.08340213071076,
            -4.780057328224764,
            -14.988032651517535,
            -2.1301991069136483,
            -2.517773365572873,
            0.4509494871924166,
            2.134866880095788,
            5.395052518053152,
        ],
    ),
];

#[test]
fn kinematics() -> Result<(), Error> {
    let mut case = Case::new("fourbar_ondsel_driven, kinematics");
    let mut kinematics = Kinematics::new(FourBar::declared())?;
    for (t, reference) in SAMPLES {
        let motion = kinematics.at(t)?;
        let instant = Simulation::builder(FourBar::declared(), 1e-4).from_state(motion.state).build()?;
        compare(&mut case, t, instant.outputs()?, reference, 1e-12);
    }
    case.finish();
    Ok(())
}

#[test]
fn integrated() -> Result<(), Error> {
    let start = |h| Simulation::new(FourBar::declared(), h);
    through_every_path("fourbar_ondsel_driven", 1e-4, Single::Longer(20.0), start, |case, run| {
        for (t, reference) in SAMPLES {
            run.advance_to(t)?;
            compare(case, t, run.now()?.outputs, reference, 1e-5);
        }
        Ok(())
    })
}

fn compare(case: &mut Case, t: f64, ours: FourBarOutputs<f64>, reference: [f64; 25], tolerance: f64) {
    for ((name, ours), reference) in FourBarOutputs::<f64>::NAMES.iter().zip(ours.into_array()).zip(reference)
    {
        case.near(format_args!("{name} at {t}"), ours, reference, tolerance);
    }
}
