//! Coordinates without mass: whatever position is regular for the dense
//! system is regular for the elimination at compile time, also those in which
//! single entries of the Jacobian vanish (dead centres, links that hang straight
//! down), and the solutions agree.

use mbs_runtime::{Components, NoComponents, Simulation, State, mechanism};
use nalgebra::{DMatrix, DVector};
use tests::random::Random;

mechanism! {
    /// A slider-crank whose rod has no mass, at its dead centre.
    pub MasslessRod {
        dof = 1;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 2e-4 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 0; inertia = 0; }
        body slider (x3)             { mass = 2 [kg]; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        start { theta1 = 0; der(theta1) = 20 [rad/s]; }
    }
}

mechanism! {
    /// Three point masses on massless links that hang straight down.
    pub Hanging {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=3 {
            body link[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = 0; }
            point up on link[i] = (0, 0.5 [m]);
            point low on link[i] = (0, -0.5 [m]);
        }
        revolute j[1] (link[1].up, ground);
        for i in 2..=3 { revolute j[i] (link[i-1].low, link[i].up); }
        start { der(theta_1) = 0.1 [rad/s]; }
    }
}

mechanism! {
    /// Six of them, with the mass at the lower end.
    pub HangingSix {
        dof = 6;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=6 {
            body bob[i] (x[i], y[i], theta[i]) { mass = 0.3 [kg]; inertia = 0; }
            point up on bob[i] = (0, 0.4 [m]);
        }
        revolute j[1] (bob[1].up, ground);
        for i in 2..=6 { revolute j[i] (bob[i-1], bob[i].up); }
        start { der(theta_6) = 0.1 [rad/s]; }
    }
}

mechanism! {
    /// A cart with two massless poles and a bob at the end of each.
    pub TwoPoles {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        body cart  (x) { mass = 1 [kg]; }
        for i in 1..=2 {
            body pole[i] (xp[i], yp[i], phi[i]) { mass = 0; inertia = 0; }
            point low on pole[i] = (0, -0.5 [m]);
            body bob[i] (x = u[i], y = w[i]) { mass = 0.2 [kg]; }
            revolute top[i] (pole[i], cart);
            revolute end[i] (pole[i].low, bob[i]);
        }
        start { der(phi_1) = 0.3 [rad/s]; }
    }
}

mechanism! {
    /// A platform on two massless legs that stand upright: in this position the
    /// x of the legs' upper ends does not depend on their angles to first order.
    pub Legs {
        dof = 1;
        param a = 0.4 [m];
        body left  (xl, yl, pl) { mass = 0; inertia = 0; }
        body right (xr, yr, pr) { mass = 0; inertia = 0; }
        body plate (x, y, p)    { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        point foot on left = (0, -a/2);     point knee on left = (0, a/2);
        point foot on right = (0, -0.6*a);  point knee on right = (0, 0.6*a);
        point l on plate = (-a/2, 0);       point r on plate = (a/2, 0);
        revolute f1 (left.foot, ground);
        revolute k1 (left.knee, plate.l);
        point g on ground = (a, -0.2*a);
        revolute f2 (right.foot, ground.g);
        revolute k2 (right.knee, plate.r);
        start { pl = 0; guess x = 0.2 [m]; guess y = 0.4 [m]; guess xr = 0.4 [m]; der(pl) = 1 [rad/s]; }
    }
}

/// M, Φ_q, Q and γ of a state, for a dense solution.
struct Dense {
    matrix: DMatrix<f64>,
    rhs: DVector<f64>,
}

impl Dense {
    fn new(mass: DMatrix<f64>, phi_q: DMatrix<f64>, forces: &[f64], gamma: &[f64]) -> Self {
        let (n, m) = (mass.nrows(), phi_q.nrows());
        let mut matrix = DMatrix::zeros(n + m, n + m);
        matrix.view_mut((0, 0), (n, n)).copy_from(&mass);
        matrix.view_mut((n, 0), (m, n)).copy_from(&phi_q);
        matrix.view_mut((0, n), (n, m)).copy_from(&phi_q.transpose());
        Self { matrix, rhs: DVector::from_iterator(n + m, forces.iter().chain(gamma).copied()) }
    }

    fn condition(&self) -> f64 {
        let singular = self.matrix.singular_values();
        singular.max() / singular.min()
    }
}

/// How bad a position may be to be compared: a random one seldom is worse.
const LARGEST_CONDITION: f64 = 1e7;

/// The elimination solves the dense system. Each of the two is good to
/// size·condition·ε, and the one without exchanges of rows loses the growth of its
/// pivots besides.
fn assert_solves(dense: &Dense, ours: &[f64], growth: f64, at: &str) {
    let condition = dense.condition();
    let expected = dense.matrix.clone().lu().solve(&dense.rhs);
    let expected = expected.unwrap_or_else(|| DVector::zeros(dense.rhs.len()));
    let size = ours.len() as f64;
    assert!(growth * condition * f64::EPSILON < 1e-3, "{at}: growth {growth:e}, condition {condition:e}");
    let tolerance = size * f64::EPSILON * condition * (1.0 + growth) * (1.0 + expected.amax());
    let deviation = (DVector::from_column_slice(ours) - &expected).amax();
    assert!(deviation <= tolerance, "{at}: {deviation:e} > {tolerance:e}\n{ours:?}\n{expected}");
}

/// Compares at the declared start, along a run and in random positions.
macro_rules! compare {
    ($mechanism:ident, $steps:expr) => {{
        let mechanism = $mechanism::declared();
        let none = NoComponents::default();
        let check = |at: &State<_>, must_be_regular: bool| {
            let mass = mechanism.mass(&at.q);
            let phi_q = mechanism.phi_q(at.t, &at.q);
            let dense = Dense::new(
                DMatrix::from_fn(mass.nrows(), mass.ncols(), |i, j| mass[(i, j)]),
                DMatrix::from_fn(phi_q.nrows(), phi_q.ncols(), |i, j| phi_q[(i, j)]),
                mechanism.forces(at, &none).into_array().as_ref(),
                mechanism.gamma(at).into_array().as_ref(),
            );
            if !must_be_regular && dense.condition() > LARGEST_CONDITION {
                return;
            }
            let solved = mechanism.accelerations(at, &none);
            let mut ours = solved.acceleration.into_array().as_ref().to_vec();
            ours.extend(solved.multipliers.into_array().as_ref());
            assert_solves(&dense, &ours, solved.growth, &format!("{} at {at:?}", stringify!($mechanism)));
        };
        let mut run = Simulation::new(mechanism, 1e-3).expect("the start is regular");
        check(&run.state(), true);
        for _ in 0..$steps {
            run.step().expect("the motion is regular");
            check(&run.state(), true);
        }
        let mut random = Random::new(7);
        for _ in 0..200 {
            let mut at = run.state();
            let (mut q, mut v) = (at.q.into_array(), at.v.into_array());
            q.iter_mut().chain(&mut v).for_each(|x| *x = random.between(-3.0, 3.0));
            (at.q, at.v) = (Components::from_array(q), Components::from_array(v));
            check(&at, false);
        }
    }};
}

#[test]
fn a_massless_rod_passes_its_dead_centres() {
    // a turn takes 0.314 s
    compare!(MasslessRod, 400);
}

#[test]
fn point_masses_hang_straight_down() {
    compare!(Hanging, 200);
    compare!(HangingSix, 200);
}

#[test]
fn a_cart_carries_massless_poles() {
    compare!(TwoPoles, 200);
}

#[test]
fn a_platform_stands_on_massless_legs() {
    compare!(Legs, 50);
}
