//! Pantograph: the pen draws what the tracer follows, enlarged exactly.
//!
//! ```text
//!             elbow  o──────
//!                  ╱╱       ─────  long2
//!          long1  ╱             ─o──────
//!                ╱            ╱╱        ──────
//!              ╱╱   short1  ╱╱                ───o pen
//!             ╱            ╱
//!            o────       ╱╱
//!           ╱     ──────o tracer
//!          ╱   short2
//!        ╱╱
//!       o pivot
//! ```
//!
//! A parallelogram in the elbow of two arms keeps pivot, tracer and pen on a
//! ray. The tracer is led round a circle.
//!
//! Reference: pen = ratio · tracer, for any arms (C. Scheiner, Pantographice,
//! 1631, describes the instrument).

use mbs_runtime::mechanism;

mechanism! {
    /// Pantograph whose tracer is led round a circle.
    pub Pantograph {
        dof = 0;
        /// Length of the arm at the pivot.
        param arm1 = 0.3 [m] where arm1 > 0;
        /// Length of the arm at the pen.
        param arm2 = 0.35 [m] where arm2 > 0;
        /// Enlargement.
        param ratio = 2.5 where ratio > 1;
        /// Centre of the circle.
        param centre_x = 0.2 [m];
        /// Centre of the circle.
        param centre_y = 0.03 [m];
        /// Radius of the circle.
        param radius = 30 [mm];
        /// Angular frequency of the tracer.
        param omega = 3 [rad/s];
        /// Mass of the bars per length.
        param density = 0.3 [kg/m] where density > 0;

        let short1_length = arm1*(1 - 1/ratio);
        let short2_length = arm2/ratio;
        body long1  (x1, y1, phi1) { mass = density*arm1; inertia = density*arm1^3/12; }
        body long2  (x2, y2, phi2) { mass = density*arm2; inertia = density*arm2^3/12; }
        body short1 (x3, y3, phi3) { mass = density*short1_length; inertia = density*short1_length^3/12; }
        body short2 (x4, y4, phi4) { mass = density*short2_length; inertia = density*short2_length^3/12; }

        point pivot on long1 = (-arm1/2, 0);
        point joint on long1 = (arm1/ratio - arm1/2, 0);
        point elbow on long1 = (arm1/2, 0);
        point elbow on long2 = (-arm2/2, 0);
        point joint on long2 = (arm2/ratio - arm2/2, 0);
        point pen on long2 = (arm2/2, 0);
        point tracer on short1 = (-short1_length/2, 0);     // parallel to long1
        point joint on short1 = (short1_length/2, 0);
        point joint on short2 = (-short2_length/2, 0);      // parallel to long2
        point tracer on short2 = (short2_length/2, 0);

        revolute pivot (ground, long1.pivot);
        revolute elbow (long1.elbow, long2.elbow);
        revolute joint1 (long1.joint, short2.joint);
        revolute joint2 (long2.joint, short1.joint);
        revolute tracer (short1.tracer, short2.tracer);
        drive lead_x: short1.tracer.x = centre_x + radius*cos(omega*t);
        drive lead_y: short1.tracer.y = centre_y + radius*sin(omega*t);

        start {
            guess phi1 = 40 [deg]; guess phi2 = -20 [deg]; guess phi3 = 40 [deg]; guess phi4 = -20 [deg];
            guess x1 = 0.11 [m]; guess y1 = 0.1 [m]; guess x2 = 0.4 [m]; guess y2 = 0.13 [m];
            guess x3 = 0.3 [m]; guess y3 = 0.09 [m]; guess x4 = 0.16 [m]; guess y4 = 0.05 [m];
        }

        /// Path of the pen.
        output pen_x [m] = long2.pen.x;
        /// Path of the pen.
        output pen_y [m] = long2.pen.y;
        /// Force that leads the tracer.
        output lead_force [N] = sqrt(effort(lead_x)^2 + effort(lead_y)^2);
    }
}
