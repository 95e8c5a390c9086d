//! Slider-crank driven at constant speed (temporary hand-written form).
#![allow(missing_docs, reason = "temporary")]
use mbs_runtime::{Info, NoComponents, Reactions};
use crate::temporary::info::*;

components!(SliderCrankParameters, 7, l1, l2, m1, m2, m3, inertia_factor, omega);
components!(SliderCrankCoordinates, 7, x1, y1, theta1, x2, y2, theta2, x3);
components!(SliderCrankConstraints, 7, crank_x, crank_y, crank_speed, rod_x, rod_y, guide, slider);
components!(SliderCrankOutputs, 1, drive_torque);
slider_crank!(SliderCrank, SliderCrankParameters, NoComponents<f64>, SliderCrankCoordinates,
    SliderCrankConstraints, SliderCrankOutputs, 7, [0, 1, 2, 3, 4, 5, 6], true);

fn outputs(r: &Reactions<SliderCrankCoordinates, SliderCrankConstraints>) -> SliderCrankOutputs {
    SliderCrankOutputs { drive_torque: -r.multipliers.crank_speed }
}

static INFO: Info = Info::from_parts("SliderCrank", "Slider-crank driven at constant speed.", 0,
    PARAMETERS, &[], COORDINATES, &[quantity("drive_torque", "N*m", 1.0, TORQUE, 0.0)],
    &[row("crank_x", LENGTH, false), row("crank_y", LENGTH, false), row("crank_speed", D0, true),
      row("rod_x", LENGTH, false), row("rod_y", LENGTH, false), row("guide", LENGTH, false), row("slider", LENGTH, false)],
    &[], &[]);
