//! N four-bars in a row: N windows with N + 1 uprights, all bars equal.
//!
//! ```text
//!     B0      bar 1      B1      bar 2      B2             BN
//!      o─────────────────o──────────────────o──  ···  ──────o
//!      │                 │                  │               │
//!      │ upright 0       │ upright 1        │ upright 2     │ length
//!      │                 │                  │               │
//!      o                 o                  o               o
//!     ─┴─ A0            ─┴─ A1             ─┴─ A2          ─┴─ AN
//! ```
//!
//! Source: IFToMM library of multibody benchmarks, "N-four-bar mechanism"
//! (M. González and others, 2006; A02 with N = 2), bars of 1 m and 1 kg that
//! start upright with B0 moving to the right at 1 m/s. One declaration serves
//! for N = 1, 2, 10 and 40.
//!
//! Where the uprights lie flat every window may fold by itself: the freedom
//! jumps from 1 to N + 1. No step of a run should end near such a position.
//!
//! Reference: uprights stay parallel and bars level, so the row is a pendulum
//! with J = m l² ((N + 1)/3 + N) and the moment of mass S = m l ((N + 1)/2 + N):
//! with the angle φ from upright, φ̇² = ω₀² + 2λ² (1 − cos φ), λ² = g S/J. With
//! the arithmetic–geometric mean of Gauss a turn takes
//! 2π/AGM(ω₀, √(ω₀² + 4λ²)).

use mbs_runtime::mechanism;

macro_rules! n_four_bar {
    ($(#[$($attribute:tt)*])* $Name:ident, $n:tt) => {
        mechanism! {
            $(#[$($attribute)*])*
            pub $Name {
                dof = 1;
                const N = $n;
                /// Length of a bar.
                param length = 1 [m] where length > 0;
                /// Mass of a bar.
                param mass = 1 [kg] where mass > 0;
                /// Speed of B0 at the start, to the right.
                param speed = 1 [m/s];
                gravity = (0, -9.81) [m/s^2];
                let inertia = mass*length^2/12;

                for i in 0..=N {
                    body upright[i] (xu[i], yu[i], phi[i]) { mass = mass; inertia = inertia; }
                    point foot on upright[i] = (-length/2, 0);
                    point head on upright[i] = (length/2, 0);
                    point a[i] on ground = (i*length, 0);
                    revolute foot[i] (upright[i].foot, ground.a[i]);
                    start { guess xu[i] = i*length; guess yu[i] = length/2; }
                    if i == 0 {
                        start { phi[i] = 90 [deg]; der(phi[i]) = -speed/length; }
                    } else {
                        start { guess phi[i] = 90 [deg]; }
                    }
                }
                for i in 1..=N {
                    body bar[i] (xb[i], yb[i], psi[i]) { mass = mass; inertia = inertia; }
                    point left on bar[i] = (-length/2, 0);
                    point right on bar[i] = (length/2, 0);
                    revolute left[i] (upright[i-1].head, bar[i].left);
                    revolute right[i] (upright[i].head, bar[i].right);
                    start { guess xb[i] = (i - 1/2)*length; guess yb[i] = length; }
                }
                /// Place of B0.
                output head_x [m] = upright[0].head.x;
                /// Place of B0.
                output head_y [m] = upright[0].head.y;
                /// How far the last upright is from parallel to the first.
                output skew [rad] = phi[N] - phi[0];
                /// Force in the first foot.
                output foot_force [N] = reaction(foot[0]);
            }
        }
    };
}

n_four_bar! {
    /// One four-bar of equal bars, a parallelogram.
    NFourBar1, 1
}
n_four_bar! {
    /// Two four-bars in a row, benchmark A02.
    NFourBar2, 2
}
n_four_bar! {
    /// Ten four-bars in a row.
    NFourBar10, 10
}
n_four_bar! {
    /// Forty four-bars in a row: 243 coordinates, 242 constraints.
    NFourBar40, 40
}
