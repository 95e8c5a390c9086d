//! Temporary hand-written pieces that stand in for what `mechanism!` generates.
#![allow(missing_docs, reason = "temporary")]

macro_rules! components {
    ($name:ident, $n:literal, $($field:ident),+) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T = f64> { $(pub $field: T),+ }
        impl<T: mbs_runtime::Real> mbs_runtime::Components for $name<T> {
            type Real = T;
            type Array = [T; $n];
            const NAMES: &'static [&'static str] = &[$(stringify!($field)),+];
            fn into_array(self) -> [T; $n] { [$(self.$field),+] }
            fn from_array(array: [T; $n]) -> Self {
                let [$($field),+] = array;
                Self { $($field),+ }
            }
            fn splat(value: T) -> Self { Self { $($field: value),+ } }
        }
    };
}

macro_rules! slider_crank {
    ($name:ident, $params:ident, $inputs:ty, $coords:ident, $cons:ident, $outs:ident, $m:literal, $rows:expr, $driven:literal) => {
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name<T = f64> { p: $params<T> }

        impl Default for $params<f64> {
            fn default() -> Self {
                Self { l1: 0.06, l2: 0.18, m1: 0.5, m2: 1.2, m3: 2.0, inertia_factor: 1.0 / 12.0,
                       omega: 200.0 * (std::f64::consts::PI / 30.0) }
            }
        }

        impl $name<f64> {
            pub fn declared() -> Self { Self { p: $params::default() } }
            pub fn new(p: $params<f64>) -> Result<Self, mbs_runtime::Error> {
                <Self as mbs_runtime::Mechanism>::new(p)
            }
            fn phi_q(&self, q: &$coords<f64>) -> nalgebra::SMatrix<f64, $m, 7> {
                let ($coords { theta1, theta2, .. }, $params { l1, l2, .. }) = (*q, self.p);
                let ((s1, c1), (s2, c2)) = (theta1.sin_cos(), theta2.sin_cos());
                let all = [
                    [1., 0., l1 / 2. * s1, 0., 0., 0., 0.],
                    [0., 1., -l1 / 2. * c1, 0., 0., 0., 0.],
                    [0., 0., 1., 0., 0., 0., 0.],
                    [0., 0., l1 * s1, 1., 0., l2 / 2. * s2, 0.],
                    [0., 0., -l1 * c1, 0., 1., -l2 / 2. * c2, 0.],
                    [0., 0., l1 * c1, 0., 0., l2 * c2, 0.],
                    [0., 0., l1 * s1, 0., 0., l2 * s2, 1.],
                ];
                let rows: [usize; $m] = $rows;
                nalgebra::SMatrix::from_fn(|i, j| all[rows[i]][j])
            }
            fn pick(all: [f64; 7]) -> $cons<f64> {
                let rows: [usize; $m] = $rows;
                mbs_runtime::Components::from_array(rows.map(|i| all[i]))
            }
            fn masses(&self) -> [f64; 7] {
                let $params { l1, l2, m1, m2, m3, inertia_factor: k, .. } = self.p;
                [m1, m1, k * m1 * l1 * l1, m2, m2, k * m2 * l2 * l2, m3]
            }
            fn solve(&self, q: &$coords<f64>, mass: [f64; 7], top: [f64; 7], bottom: [f64; $m])
                -> ($coords<f64>, $cons<f64>, f64)
            {
                let mut kkt = nalgebra::SMatrix::<f64, { 7 + $m }, { 7 + $m }>::zeros();
                let phi_q = self.phi_q(q);
                for i in 0..7 { kkt[(i, i)] = mass[i]; }
                kkt.fixed_view_mut::<$m, 7>(7, 0).copy_from(&phi_q);
                kkt.fixed_view_mut::<7, $m>(0, 7).copy_from(&phi_q.transpose());
                let mut rhs = nalgebra::SVector::<f64, { 7 + $m }>::zeros();
                for i in 0..7 { rhs[i] = top[i]; }
                for i in 0..$m { rhs[7 + i] = bottom[i]; }
                let growth = if kkt.lu().solve_mut(&mut rhs) { 1.0 } else { f64::NAN };
                (mbs_runtime::Components::from_array(std::array::from_fn(|i| rhs[i])),
                 mbs_runtime::Components::from_array(std::array::from_fn(|i| rhs[7 + i])), growth)
            }
            fn gamma(&self, at: &mbs_runtime::State<$coords<f64>>) -> $cons<f64> {
                let $params { l1, l2, .. } = self.p;
                let ((s1, c1), (s2, c2)) = (at.q.theta1.sin_cos(), at.q.theta2.sin_cos());
                let (w1, w2) = (at.v.theta1 * at.v.theta1, at.v.theta2 * at.v.theta2);
                Self::pick([-l1 / 2. * w1 * c1, -l1 / 2. * w1 * s1, 0.,
                    -l1 * w1 * c1 - l2 / 2. * w2 * c2, -l1 * w1 * s1 - l2 / 2. * w2 * s2,
                    l1 * w1 * s1 + l2 * w2 * s2, -l1 * w1 * c1 - l2 * w2 * c2])
            }
        }

        impl mbs_runtime::Mechanism for $name<f64> {
            type Real = f64;
            type Parameters = $params<f64>;
            type Inputs = $inputs;
            type Coordinates = $coords<f64>;
            type Constraints = $cons<f64>;
            type Outputs = $outs<f64>;
            const INFO: &'static mbs_runtime::Info = &INFO;

            fn new(p: $params<f64>) -> Result<Self, mbs_runtime::Error> {
                use mbs_runtime::Components;
                for (value, name) in p.into_array().into_iter().zip(<$params<f64>>::NAMES) {
                    if !value.is_finite() {
                        return Err(mbs_runtime::Error::Parameter { name, value, requirement: "it has to be finite" });
                    }
                }
                for (name, value) in [("m1", p.m1), ("m2", p.m2), ("m3", p.m3)] {
                    if value < 0.0 {
                        return Err(mbs_runtime::Error::Parameter { name, value, requirement: "a mass cannot be negative" });
                    }
                }
                for (name, value) in [("l1", p.l1), ("l2", p.l2)] {
                    if value <= 0.0 {
                        return Err(mbs_runtime::Error::Parameter { name, value, requirement: "a length has to be positive" });
                    }
                }
                Ok(Self { p })
            }
            fn parameters(&self) -> &$params<f64> { &self.p }
            fn declared_start(&self) -> mbs_runtime::State<$coords<f64>> {
                let $params { l1, l2, omega, .. } = self.p;
                let q = $coords { x1: l1 / 2., y1: 0., theta1: 0., x2: l1 + l2 / 2., y2: 0., theta2: 0., x3: l1 + l2 };
                let v = $coords { x1: 0., y1: 0., theta1: omega, x2: 0., y2: 0., theta2: 0., x3: 0. };
                mbs_runtime::State { t: 0., q, v }
            }
            fn phi(&self, t: f64, q: &$coords<f64>) -> $cons<f64> {
                let $params { l1, l2, omega, .. } = self.p;
                let ((s1, c1), (s2, c2)) = (q.theta1.sin_cos(), q.theta2.sin_cos());
                Self::pick([q.x1 - l1 / 2. * c1, q.y1 - l1 / 2. * s1, q.theta1 - omega * t,
                    q.x2 - l1 * c1 - l2 / 2. * c2, q.y2 - l1 * s1 - l2 / 2. * s2,
                    l1 * s1 + l2 * s2, q.x3 - l1 * c1 - l2 * c2])
            }
            fn phi_dot(&self, at: &mbs_runtime::State<$coords<f64>>) -> $cons<f64> {
                use mbs_runtime::Components;
                let v = nalgebra::SVector::<f64, 7>::from_fn(|i, _| at.v.into_array()[i]);
                let jv = self.phi_q(&at.q) * v;
                let phi_t = Self::pick([0., 0., -self.p.omega, 0., 0., 0., 0.]);
                <$cons<f64>>::from_array(std::array::from_fn(|i| jv[i])).zip_map(phi_t, |a, b| a + b)
            }
            fn stabilized(&self, at: &mbs_runtime::State<$coords<f64>>, inputs: &$inputs, gains: &mbs_runtime::Gains<f64>)
                -> mbs_runtime::Stabilized<$coords<f64>, $cons<f64>>
            {
                use mbs_runtime::Components;
                let feedback = self.phi_dot(at).zip_map(self.phi(at.t, &at.q),
                    |d, p| -gains.two_alpha * d - gains.beta_squared * p);
                let solved = self.constrained(at, inputs, &feedback);
                mbs_runtime::Stabilized { acceleration: solved.acceleration, feedback, growth: solved.growth }
            }
            fn constrained(&self, at: &mbs_runtime::State<$coords<f64>>, inputs: &$inputs, feedback: &$cons<f64>)
                -> mbs_runtime::Accelerations<$coords<f64>>
            {
                let r = self.reactions(at, inputs, feedback);
                mbs_runtime::Accelerations { acceleration: r.acceleration, growth: r.growth }
            }
            fn reactions(&self, at: &mbs_runtime::State<$coords<f64>>, inputs: &$inputs, feedback: &$cons<f64>)
                -> mbs_runtime::Reactions<$coords<f64>, $cons<f64>>
            {
                use mbs_runtime::Components;
                let $params { m1, m2, .. } = self.p;
                let tau = inputs.get("crank_torque").unwrap_or(0.0);
                let top = [0., -m1 * 9.81, tau, 0., -m2 * 9.81, 0., 0.];
                let bottom = self.gamma(at).zip_map(*feedback, |a, b| a + b).into_array();
                let (acceleration, multipliers, growth) = self.solve(&at.q, self.masses(), top, bottom);
                mbs_runtime::Reactions { acceleration, multipliers, growth }
            }
            fn position_correction(&self, _: f64, q: &$coords<f64>, residual: &$cons<f64>)
                -> mbs_runtime::Accelerations<$coords<f64>>
            {
                use mbs_runtime::Components;
                let mut mass = self.masses();
                if !$driven { mass[2] = 1e12; }
                let (acceleration, _, growth) = self.solve(q, mass, [0.; 7], residual.into_array());
                mbs_runtime::Accelerations { acceleration, growth }
            }
            fn velocity_correction(&self, t: f64, q: &$coords<f64>, residual: &$cons<f64>)
                -> mbs_runtime::Accelerations<$coords<f64>> { self.position_correction(t, q, residual) }
            fn worst_pivot(&self, _: f64, _: &$coords<f64>) -> Option<usize> { None }
            fn kinetic_energy(&self, at: &mbs_runtime::State<$coords<f64>>) -> f64 {
                use mbs_runtime::Components;
                self.masses().iter().zip(at.v.into_array()).map(|(m, v)| 0.5 * m * v * v).sum()
            }
            fn potential_energy(&self, at: &mbs_runtime::State<$coords<f64>>) -> f64 {
                9.81 * (self.p.m1 * at.q.y1 + self.p.m2 * at.q.y2)
            }
            fn outputs(&self, _: &mbs_runtime::State<$coords<f64>>, _: &$inputs,
                reactions: &mbs_runtime::Reactions<$coords<f64>, $cons<f64>>) -> $outs<f64> { outputs(reactions) }
        }
    };
}

pub(crate) mod info {
    use mbs_runtime::{Constraint, Dimension, Quantity};
    pub const D0: Dimension = Dimension { mass: 0, length: 0, time: 0 };
    pub const LENGTH: Dimension = Dimension { mass: 0, length: 1, time: 0 };
    pub const MASS: Dimension = Dimension { mass: 1, length: 0, time: 0 };
    pub const RATE: Dimension = Dimension { mass: 0, length: 0, time: -1 };
    pub const TORQUE: Dimension = Dimension { mass: 1, length: 2, time: -2 };
    pub const fn quantity(
        name: &'static str, unit: &'static str, scale: f64, dimension: Dimension, default: f64,
    ) -> Quantity {
        Quantity { name, doc: "", unit, scale, dimension, default }
    }
    pub const fn row(name: &'static str, dimension: Dimension, is_drive: bool) -> Constraint {
        Constraint { name, doc: "", formula: "", is_drive, dimension }
    }
    pub const RPM: f64 = std::f64::consts::PI / 30.0;
    pub const PARAMETERS: &[Quantity] = &[
        quantity("l1", "mm", 1e-3, LENGTH, 0.06), quantity("l2", "mm", 1e-3, LENGTH, 0.18),
        quantity("m1", "kg", 1.0, MASS, 0.5), quantity("m2", "kg", 1.0, MASS, 1.2),
        quantity("m3", "kg", 1.0, MASS, 2.0), quantity("inertia_factor", "", 1.0, D0, 1.0 / 12.0),
        quantity("omega", "rpm", RPM, RATE, 200.0 * RPM),
    ];
    pub const COORDINATES: &[Quantity] = &[
        quantity("x1", "m", 1.0, LENGTH, 0.03), quantity("y1", "m", 1.0, LENGTH, 0.0),
        quantity("theta1", "rad", 1.0, D0, 0.0), quantity("x2", "m", 1.0, LENGTH, 0.15),
        quantity("y2", "m", 1.0, LENGTH, 0.0), quantity("theta2", "rad", 1.0, D0, 0.0),
        quantity("x3", "m", 1.0, LENGTH, 0.24),
    ];
}
