//! A rod on a cart that a sampled controller balances.
//!
//! ```text
//!             ╲ rod: length, rod_mass
//!           θ │╲
//!             │ ╲
//!    push   ┌─┴──o┐        every 10 ms: x, θ ──▶ observer ──▶ −K x̂ ──▶ push
//!    ─────▶ │cart │ ─── x
//!    ───────o─────o─────────
//! ```
//!
//! Two encoders measure x and θ, the angle from the upright position. Every 10 ms the controller takes both, sets the
//! force, which holds until the next sample, and predicts the state there:
//!
//! ```text
//! uₖ = −K x̂ₖ,   x̂ₖ₊₁ = A x̂ₖ + B uₖ + L (yₖ − C x̂ₖ)
//! ```
//!
//! A and B are the plant of the declared values, linear about the upright position and sampled with a held force
//! (K. J. Åström, B. Wittenmark, Computer-Controlled Systems, 3rd ed., Prentice Hall 1997, sections 2.3 and 11.4). K is
//! the optimal feedback for the cost ∑ 10 x² + θ² + ẋ² + 0.1 θ̇² + 0.05 u², L the stationary Kalman predictor for a
//! disturbance of 1 N in a sample and errors of 1 mm and 1 mrad of the encoders, both rounded to the digits below.
//!
//! Reference: Lagrange's equations of x and θ (`cart_pendulum.rs`) by a solver of order 8, from sample to sample.

use mbs_runtime::mechanism;

mechanism! {
    /// Rod on a cart, balanced by a sampled controller with an observer.
    pub CartPole {
        dof = 2;
        /// Mass of the cart.
        param cart_mass = 1 [kg] where cart_mass > 0;
        /// Mass of the rod.
        param rod_mass = 0.3 [kg] where rod_mass > 0;
        /// Length of the rod.
        param length = 0.6 [m] where length > 0;
        /// Angle of the rod at the start, from the upright position.
        param tilt = 5 [deg];
        /// Where the cart is to stand.
        param target = 0.5 [m];
        /// Share of the motor's force that acts: 1, or 0 without it.
        param motor = 1 where motor >= 0;
        /// Force that disturbs the cart.
        input disturbance [N] = 0;
        gravity = (0, -9.81) [m/s^2];

        /// Force of the motor, held between samples.
        memory push [N] = 0;
        /// Predicted place of the cart, from the target: at first where it is declared to start.
        memory place [m] = -0.5;
        /// Predicted angle of the rod.
        memory angle [rad] = 0;
        /// Predicted speed of the cart.
        memory speed [m/s] = 0;
        /// Predicted rate of the rod.
        memory turning [rad/s] = 0;
        /// Difference of the cart's encoder from the prediction.
        memory ahead [m] = 0;
        /// Difference of the rod's encoder from the prediction.
        memory beyond [rad] = 0;
        /// The predicted angle before the sample.
        memory before [rad] = 0;

        every 10 [ms] {
            set push = 12.960759 [N/m]*place - 61.29563 [N]*angle + 12.044296 [N*s/m]*speed - 11.976865 [N*s]*turning;
            set ahead = x - target - place;
            set beyond = theta - angle;
            set before = angle;
            set place = place + 0.000102688 [m]*angle + 0.01 [s]*speed + 0.000000342 [m*s]*turning
                + 0.000046514 [m/N]*push + 0.241178419*ahead + 0.177532589 [m]*beyond;
            set speed = speed + 0.020542709 [m/s]*angle + 0.000102688 [m]*turning + 0.009303122 [m/N/s]*push
                + 3.249728897 [1/s]*ahead + 5.737302444 [m/s]*beyond;
            set angle = 1.001483274*angle + 0.010004944 [s]*turning + 0.000116308 [1/N]*push
                + 0.178469459 [1/m]*ahead + 0.618052494*beyond;
            set turning = 1.001483274*turning + 0.296728018 [1/s]*before + 0.023267311 [1/N/s]*push
                + 5.848756777 [1/m/s]*ahead + 15.589419974 [1/s]*beyond;
        }

        body cart (x) { mass = cart_mass; }
        body rod (xr, yr, theta) { mass = rod_mass; inertia = rod_mass*length^2/12; }
        point base on rod = (0, -length/2);
        point tip on rod = (0, length/2);
        revolute pivot (cart, rod.base);
        force pushed on cart = (motor*push + disturbance, 0);

        start { x = 0; theta = tilt; der(x) = 0; der(theta) = 0; }

        /// Force of the motor.
        output force [N] = motor*push;
        /// Difference of the rod's encoder from the prediction, at the last sample.
        output innovation [rad] = beyond;
        /// Path of the rod's tip.
        output tip_x [m] = rod.tip.x;
        /// Path of the rod's tip.
        output tip_y [m] = rod.tip.y;
    }
}
