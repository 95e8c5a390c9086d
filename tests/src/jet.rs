//! Numbers that carry their first and second derivative along one direction: duals of duals, so
//! that generated code, run with them, differentiates itself twice.

use mbs_runtime::Dual;

/// x, x′ and x″ with respect to one variable s.
pub type Jet = Dual<Dual<f64, 1>, 1>;

/// x(s) = value + s·first
pub const fn line(value: f64, first: f64) -> Jet {
    Dual::new(Dual::new(value, [first]), [Dual::new(first, [0.0])])
}

/// x
pub const fn value(x: Jet) -> f64 {
    x.value.value
}

/// dx/ds
pub const fn first(x: Jet) -> f64 {
    let [slope] = x.partials;
    slope.value
}

/// d²x/ds²
pub const fn second(x: Jet) -> f64 {
    let [Dual { partials: [second], .. }] = x.partials;
    second
}

/// Compares all that a mechanism generates with what jets find in a Φ of (t, q):
/// Φ itself, Φ_q column by column, Φ_t along t, Φ̇ and −γ as the first and second
/// derivative of Φ(q + s v, t + s) at s = 0.
#[macro_export]
macro_rules! check_against_jets {
    ($mechanism:ident, $coordinates:ident, $phi:expr, $position:expr, $rate:expr, $tolerance:expr) => {{
        use $crate::jet::{first, line, second, value};
        let plain = $mechanism::<f64>::default();
        let mut random = $crate::random::Random::new(6);
        let mut worst = 0.0_f64;
        for _ in 0..1000 {
            let q: [f64; $coordinates::<f64>::NAMES.len()] = random.around_zero($position);
            let v: [f64; $coordinates::<f64>::NAMES.len()] = random.around_zero($rate);
            let t = random.between(0.0, 1.0);
            let at = mbs_runtime::State { t, q: $coordinates::from_array(q), v: $coordinates::from_array(v) };
            let along = |direction: &dyn Fn(usize) -> f64, of_time: f64| {
                $phi(line(t, of_time), std::array::from_fn(|i| line(q[i], direction(i))))
            };
            let mut compare = |what: &str, ours: f64, jet: f64, scale: f64| {
                let deviation = (ours - jet).abs() / (1.0 + scale);
                worst = worst.max(deviation);
                assert!(deviation <= $tolerance, "{what}: {ours:e} and {jet:e} at {at:?}");
            };

            let rows = plain.phi(t, &at.q).into_array();
            for (ours, jet) in rows.iter().zip(along(&|_| 0.0, 0.0)) {
                compare("Φ", *ours, value(jet), value(jet).abs());
            }
            let phi_q = plain.phi_q(t, &at.q);
            for column in 0..q.len() {
                let jets = along(&|i| f64::from(u8::from(i == column)), 0.0);
                for (row, &jet) in jets.iter().enumerate() {
                    compare("Φ_q", phi_q[(row, column)], first(jet), first(jet).abs());
                }
            }
            let rows = plain.phi_t(t, &at.q).into_array();
            for (ours, jet) in rows.iter().zip(along(&|_| 0.0, 1.0)) {
                compare("Φ_t", *ours, first(jet), first(jet).abs());
            }
            let (phi_dot, gamma) = (plain.phi_dot(&at).into_array(), plain.gamma(&at).into_array());
            for (row, jet) in along(&|i| v[i], 1.0).into_iter().enumerate() {
                compare("Φ̇", phi_dot[row], first(jet), $rate);
                compare("γ", gamma[row], -second(jet), $rate * $rate);
            }
        }
        println!("{}: {worst:.1e}", stringify!($mechanism));
    }};
}
