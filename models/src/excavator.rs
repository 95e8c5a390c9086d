//! Excavator arm: boom, stick and bucket on three hydraulic cylinders.
//!
//! ```text
//!                                o
//!                           2   ╱ ··          boom O–E, stick E–W, bucket W–T
//!                              ╱   o·  E
//!                             ╱  ··   ·o      cylinders
//!                            o···       ···     1: base to boom
//!                          ···           ···    2: boom to stick, behind E
//!                        ··           3   ····  3: stick to bucket, behind W
//!                     o··                    ···
//!                  ···                         o─o W
//!                ··╱╱                    ──────
//!             ··· ╱                   o──
//!          ···   ╱ 1                  T
//!        ··     ╱
//!  O   o·     ╱╱
//!            ╱
//!           o base
//! ```
//!
//! Drives set the lengths of the cylinders; their efforts are the cylinders'
//! forces, positive when they push. Each cylinder acts across one joint, so the
//! lengths give the joint angles one by one.
//!
//! Reference: a cylinder of length s across a joint, its ends a and b from the
//! joint, holds the lugs at the angle with cos = (a² + b² − s²)/(2ab) (law of
//! cosines), which gives the teeth's position in closed form.

use mbs_runtime::mechanism;

mechanism! {
    /// Excavator arm with driven cylinders.
    pub Excavator {
        dof = 0;
        /// Length of the boom.
        param boom_length = 4 [m] where boom_length > 0;
        /// Length of the stick.
        param stick_length = 2 [m] where stick_length > 0;
        /// Length of the bucket, wrist to teeth.
        param bucket_length = 1 [m] where bucket_length > 0;
        /// Mass of the boom.
        param boom_mass = 1200 [kg] where boom_mass > 0;
        /// Mass of the stick.
        param stick_mass = 500 [kg] where stick_mass > 0;
        /// Mass of the bucket.
        param bucket_mass = 400 [kg] where bucket_mass > 0;
        /// Angular frequency of the digging motion.
        param omega = 1 [rad/s];
        /// Horizontal digging resistance on the teeth.
        input resistance [N];
        gravity = (0, -9.81) [m/s^2];

        body boom   (x1, y1, phi1) { mass = boom_mass; inertia = boom_mass*boom_length^2/12; }
        body stick  (x2, y2, phi2) { mass = stick_mass; inertia = stick_mass*stick_length^2/12; }
        body bucket (x3, y3, phi3) { mass = bucket_mass; inertia = bucket_mass*bucket_length^2/12; }

        point foot on boom = (-boom_length/2, 0);
        point elbow on boom = (boom_length/2, 0);
        point lug on boom = (0, 0);                             // boom cylinder
        point eye on boom = (boom_length/4, 0);                 // stick cylinder
        point elbow on stick = (-stick_length/2, 0);
        point wrist on stick = (stick_length/2, 0);
        point lug on stick = (-0.75*stick_length, 0);           // behind the elbow
        point eye on stick = (-stick_length/4, 0);              // bucket cylinder
        point wrist on bucket = (-bucket_length/2, 0);
        point teeth on bucket = (bucket_length/2, 0);
        point lug on bucket = (-0.75*bucket_length, 0);         // behind the wrist
        point lug on ground = (0.5, -0.5) [m];

        revolute foot (ground, boom.foot);
        revolute elbow (boom.elbow, stick.elbow);
        revolute wrist (stick.wrist, bucket.wrist);

        let s1 = sqrt((boom.lug.x - ground.lug.x)^2 + (boom.lug.y - ground.lug.y)^2);
        let s2 = sqrt((stick.lug.x - boom.eye.x)^2 + (stick.lug.y - boom.eye.y)^2);
        let s3 = sqrt((bucket.lug.x - stick.eye.x)^2 + (bucket.lug.y - stick.eye.y)^2);
        drive boom_cylinder: s1 = 2.1 [m] + 0.2 [m]*sin(omega*t);
        drive stick_cylinder: s2 = 1.2 [m] + 0.15 [m]*cos(omega*t);
        drive bucket_cylinder: s3 = 1.55 [m] - 0.1 [m]*sin(2*omega*t);
        force resistance on bucket.teeth = (resistance, 0);

        start {
            guess phi1 = 43 [deg]; guess x1 = 1.5 [m]; guess y1 = 1.4 [m];
            guess phi2 = -82 [deg]; guess x2 = 3.1 [m]; guess y2 = 1.8 [m];
            guess phi3 = -179 [deg]; guess x3 = 2.7 [m]; guess y3 = 0.8 [m];
        }

        /// Path of the teeth.
        output teeth_x [m] = bucket.teeth.x;
        /// Path of the teeth.
        output teeth_y [m] = bucket.teeth.y;
        /// Force of the boom cylinder, positive when it pushes.
        output boom_force [kN] = effort(boom_cylinder);
        /// Force of the stick cylinder, positive when it pushes.
        output stick_force [kN] = effort(stick_cylinder);
        /// Force of the bucket cylinder, positive when it pushes.
        output bucket_force [kN] = effort(bucket_cylinder);
    }
}
