//! Slider-crank with a torque on the crank (temporary hand-written form).
#![allow(missing_docs, reason = "temporary")]
use mbs_runtime::{Info, NoComponents, Reactions};
use crate::temporary::info::*;

components!(SliderCrankFreeParameters, 7, l1, l2, m1, m2, m3, inertia_factor, omega);
components!(SliderCrankFreeCoordinates, 7, x1, y1, theta1, x2, y2, theta2, x3);
components!(SliderCrankFreeConstraints, 6, crank_x, crank_y, rod_x, rod_y, guide, slider);
components!(SliderCrankFreeInputs, 1, crank_torque);
impl Default for SliderCrankFreeInputs {
    fn default() -> Self {
        Self { crank_torque: 0.0 }
    }
}
slider_crank!(SliderCrankFree, SliderCrankFreeParameters, SliderCrankFreeInputs, SliderCrankFreeCoordinates,
    SliderCrankFreeConstraints, NoOutputs, 6, [0, 1, 3, 4, 5, 6], false);

type NoOutputs<T> = NoComponents<T>;
fn outputs(_: &Reactions<SliderCrankFreeCoordinates, SliderCrankFreeConstraints>) -> NoOutputs<f64> {
    NoComponents::default()
}

static INFO: Info = Info::from_parts("SliderCrankFree", "Slider-crank with a torque on the crank.", 1,
    PARAMETERS, &[quantity("crank_torque", "N*m", 1.0, TORQUE, 0.0)], COORDINATES, &[],
    &[row("crank_x", LENGTH, false), row("crank_y", LENGTH, false),
      row("rod_x", LENGTH, false), row("rod_y", LENGTH, false), row("guide", LENGTH, false), row("slider", LENGTH, false)],
    &[], &[]);
