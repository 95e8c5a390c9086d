//! Andrews' squeezer mechanism (seven bodies) at t = 0.03 s.
//!
//! Hairer & Wanner, Solving Ordinary Differential Equations II, VI.9/VII.7; Test
//! Set for IVP Solvers (Bari), problem andrews: no gravity, 0.033 N m on K1, one
//! spring, from rest. The multipliers are joint forces at E: on K3, K4, K6.
//! Reference: one-freedom reduction in 80-bit arithmetic, confirmed by
//! quadrature of the work–energy theorem and by Newton–Euler equations; the
//! printed reference (PSIDE, 1e-14) agrees with it to 1e-9 in the angles, 1e-6
//! in the rates, 0.06 in the accelerations.
//!
//! h = 1e-7 s, deadbeat feedback, held. Limit: Heun's truncation at 1000 rad/s,
//! enlarged by the near-singular positions that it passes.

use mbs_runtime::{Error, Simulation};
use paths::{Case, Single, through_every_path};

declared! {
    Squeezer {
        dof = 1;
        const xa = -0.06934 [m];
        const ya = -0.00227 [m];
        const xb = -0.03635 [m];
        const yb = 0.03273 [m];
        const xc = 0.014 [m];
        const yc = 0.072 [m];
        const d = 0.028 [m];
        const da = 0.0115 [m];
        const e = 0.02 [m];
        const ea = 0.01421 [m];
        const rr = 0.007 [m];
        const ra = 0.00092 [m];
        const ss = 0.035 [m];
        const sa = 0.01874 [m];
        const sb = 0.01043 [m];
        const sc = 0.018 [m];
        const sd = 0.02 [m];
        const ta = 0.02308 [m];
        const tb = 0.00916 [m];
        const u = 0.04 [m];
        const ua = 0.01228 [m];
        const ub = 0.00449 [m];
        const zf = 0.02 [m];
        const zt = 0.04 [m];
        const fa = 0.01421 [m];

        // angles: β, β + Θ, γ − π/2, Φ + δ − π/2, δ, Ω + ε, ε − π/2
        body k1 (x1, y1, angle1) { mass = 0.04325 [kg]; inertia = 2.194e-6 [kg*m^2]; }
        body k2 (x2, y2, angle2) { mass = 0.00365 [kg]; inertia = 4.410e-7 [kg*m^2]; }
        body k3 (x3, y3, angle3) { mass = 0.02373 [kg]; inertia = 5.255e-6 [kg*m^2]; }
        body k4 (x4, y4, angle4) { mass = 0.00706 [kg]; inertia = 5.667e-7 [kg*m^2]; }
        body k5 (x5, y5, angle5) { mass = 0.07050 [kg]; inertia = 1.169e-5 [kg*m^2]; }
        body k6 (x6, y6, angle6) { mass = 0.00706 [kg]; inertia = 5.667e-7 [kg*m^2]; }
        body k7 (x7, y7, angle7) { mass = 0.05498 [kg]; inertia = 1.912e-5 [kg*m^2]; }

        point a on ground = (xa, ya);
        point b on ground = (xb, yb);
        point c on ground = (xc, yc);
        point o on k1 = (-ra, 0);
        point f on k1 = (rr - ra, 0);
        point f on k2 = (da, 0);
        point e on k2 = (da - d, 0);
        point b on k3 = (-sa, -sb);
        point e on k3 = (ss - sa, -sb);
        point d on k3 = (sc - sa, sd - sb);
        point g on k4 = (ea - e, 0);
        point e on k4 = (ea, 0);
        point a on k5 = (-ta, -tb);
        point g on k5 = (zt - ta, -tb);
        point h on k6 = (fa - zf, 0);
        point e on k6 = (fa, 0);
        point a on k7 = (-ua, ub);
        point h on k7 = (u - ua, ub);

        revolute o (k1.o, ground);
        revolute f (k2.f, k1.f);
        revolute e3 (k2.e, k3.e);
        revolute e4 (k2.e, k4.e);
        revolute e6 (k2.e, k6.e);
        revolute b (k3.b, ground.b);
        revolute g (k4.g, k5.g);
        revolute a5 (k5.a, ground.a);
        revolute h (k6.h, k7.h);
        revolute a7 (k7.a, ground.a);
        spring coil (k3.d, ground.c) { stiffness = 4530 [N/m]; length = 0.07785 [m]; }
        torque motor on k1 = 0.033 [N*m];

        start {
            angle1 = -0.06171389001427645; der(angle1) = 0;
            guess x1 = 0.00092 [m]; guess y1 = -0.00006 [m];
            guess x2 = -0.00449 [m]; guess y2 = 0.00028 [m]; guess angle2 = -0.0617;
            guess x3 = -0.01874 [m]; guess y3 = 0.02049 [m]; guess angle3 = -1.1155;
            guess x4 = -0.03022 [m]; guess y4 = 0.01207 [m]; guess angle4 = -0.8608;
            guess x5 = -0.05324 [m]; guess y5 = 0.01663 [m]; guess angle5 = 0.4874;
            guess x6 = -0.02854 [m]; guess y6 = -0.01072 [m]; guess angle6 = 1.0079;
            guess x7 = -0.05926 [m]; guess y7 = -0.01060 [m]; guess angle7 = -0.3402;
        }
        output f_x [m] = k1.f.x;
        output f_y [m] = k1.f.y;
        output e_x [m] = k2.e.x;
        output e_y [m] = k2.e.y;
    }
}

const NAMES: [&str; 7] = ["beta", "Theta", "gamma", "Phi", "delta", "Omega", "epsilon"];

/// The test set's angles of a coordinate vector; of rates with `right_angle` 0.
fn angles(q: SqueezerCoordinates<f64>, right_angle: f64) -> [f64; 7] {
    [
        q.angle1,
        q.angle2 - q.angle1,
        q.angle3 + right_angle,
        q.angle4 + right_angle - q.angle5,
        q.angle5,
        q.angle6 - q.angle7 - right_angle,
        q.angle7 + right_angle,
    ]
}

#[test]
fn andrews_squeezer_at_the_start() -> Result<(), Error> {
    let mut case = Case::new("andrews_squeezer");
    let right_angle = std::f64::consts::FRAC_PI_2;
    let simulation = Simulation::new(Squeezer::declared(), 1e-7)?;
    let start = simulation.reactions()?;
    let (a, lambda) = (angles(start.acceleration, 0.0), start.multipliers);
    case.all_near(
        NAMES,
        "the start",
        angles(simulation.state().q, right_angle),
        [
            -0.06171389001427645,
            0.0,
            0.45527981916307037,
            0.22266839016588588,
            0.48736497954384256,
            -0.22266839016588588,
            1.2305474445498212,
        ],
        [1e-14; 7],
    );
    case.near("acceleration of beta at the start", a[0], 14222.443919954114, 1e-9);
    case.near("acceleration of Theta at the start", a[1], -10666.832939965585, 1e-9);
    case.near("lambda1 at the start", lambda.e3_x, 98.56687039624109, 1e-12);
    case.near("lambda2 at the start", lambda.e3_y, -6.122688344255662, 1e-12);

    case.finish();
    Ok(())
}

#[test]
fn andrews_squeezer() -> Result<(), Error> {
    let start = |h| Simulation::new(Squeezer::declared(), h);
    let right_angle = std::f64::consts::FRAC_PI_2;
    through_every_path("andrews_squeezer", 1e-7, Single::Longer(150.0), start, |case, run| {
        run.advance_to(0.03)?;
        let end = run.now()?;
        let (lambda, outputs) = (end.multipliers, end.outputs);
        let position = [
            15.810771195153707,
            -15.75637105841184,
            0.0408222401196458,
            -0.5347301163420796,
            0.524409965879954,
            0.5347301163420796,
            1.048080741041938,
        ];
        let rate = [
            1139.9203022591062,
            -1424.3792951775401,
            11.032911910618623,
            19.29337410503209,
            0.5735699148295039,
            -19.29337410503209,
            0.32317914924913177,
        ];
        let acceleration = [
            -24631.763122874734,
            51850.31963646439,
            324102.6007075786,
            566749.4220009954,
            16743.635418345442,
            -566749.4220009954,
            9826.507801544165,
        ];
        case.all_near(NAMES, "the end", angles(end.q, right_angle), position, [1e-7; 7]);
        case.all_near(NAMES, "the end, rate", angles(end.v, 0.0), rate, [1e-5; 7]);
        case.all_near(NAMES, "the end, acceleration", angles(end.acceleration, 0.0), acceleration, [0.05; 7]);
        case.all_near(
            ["lambda1", "lambda2", "lambda3", "lambda4", "lambda5", "lambda6"],
            "the end",
            [lambda.e3_x, lambda.e3_y, lambda.e4_x, lambda.e4_y, lambda.e6_x, lambda.e6_y],
            [
                199.1753481045386,
                -29.755309974971773,
                23.06654361162215,
                31.452725275771137,
                22.64249478639438,
                11.617392352611258,
            ],
            [2e-6; 6],
        );
        case.all_near(
            ["F x", "F y", "E x", "E y"],
            "the end",
            [outputs.f_x, outputs.f_y, outputs.e_x, outputs.e_y],
            [-0.006963039427046852, -0.0007183884307191026, -0.034921618395303125, -0.0022408410821267433],
            [1e-9; 4],
        );
        Ok(())
    })
}
