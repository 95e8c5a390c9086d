//! The free slider-crank in one coordinate, as a person writes it.

/// θ̈ from T = ½ I(θ) θ̇²: I θ̈ + ½ I′ θ̇² = τ − V′.
fn acceleration(angle: f64, rate: f64, torque: f64) -> f64 {
    const L1: f64 = 0.06;
    const L2: f64 = 0.18;
    const M: [f64; 3] = [0.5, 1.2, 2.0];
    const J1: f64 = M[0] * L1 * L1 / 12.0;
    const J2: f64 = M[1] * L2 * L2 / 12.0;
    const RATIO: f64 = L1 / L2;
    let (s1, c1) = angle.sin_cos();
    // l1 sin θ1 + l2 sin θ2 = 0
    let s2 = -RATIO * s1;
    let c2 = (1.0 - s2 * s2).sqrt();
    let turn = -RATIO * c1 / c2;
    let turn_rate = RATIO * s1 / c2 - RATIO * c1 * s2 * turn / (c2 * c2);
    let (half, bend) = (L2 / 2.0, c2 * turn * turn + s2 * turn_rate);
    let [x2, y2, x3] = [-L1 * s1 - half * s2 * turn, L1 * c1 + half * c2 * turn, -L1 * s1 - L2 * s2 * turn];
    let x2_rate = -L1 * c1 - half * bend;
    let y2_rate = -L1 * s1 + half * (c2 * turn_rate - s2 * turn * turn);
    let x3_rate = -L1 * c1 - L2 * bend;
    let inertia = M[0] * L1 * L1 / 4.0 + J1 + M[1] * (x2 * x2 + y2 * y2) + J2 * turn * turn + M[2] * x3 * x3;
    let change = M[1] * (x2 * x2_rate + y2 * y2_rate) + J2 * turn * turn_rate + M[2] * x3 * x3_rate;
    let weight = 9.81 * (M[0] * L1 / 2.0 * c1 + M[1] * y2);
    (torque - weight - change * rate * rate) / inertia
}

/// x3 of an angle.
pub fn slider(angle: f64) -> f64 {
    let s2 = -angle.sin() / 3.0;
    0.06 * angle.cos() + 0.18 * (1.0 - s2 * s2).sqrt()
}

/// The classical Runge–Kutta method; `look` sees every angle.
pub fn run(steps: u32, end: f64, torque: f64, mut look: impl FnMut(u32, f64)) {
    let h = end / f64::from(steps);
    let (mut q, mut v) = (0.0, 200.0 * std::f64::consts::TAU / 60.0);
    look(0, q);
    for step in 1..=steps {
        let a1 = acceleration(q, v, torque);
        let v2 = v + h / 2.0 * a1;
        let a2 = acceleration(q + h / 2.0 * v, v2, torque);
        let v3 = v + h / 2.0 * a2;
        let a3 = acceleration(q + h / 2.0 * v2, v3, torque);
        let v4 = v + h * a3;
        let a4 = acceleration(q + h * v3, v4, torque);
        q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
        v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
        look(step, q);
    }
}
