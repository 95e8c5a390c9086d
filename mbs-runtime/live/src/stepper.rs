//! Steps of one live mechanism.

use mbs_runtime::equations::At;
use mbs_runtime::{Explicit, Gains, Real};

use crate::Live;
use crate::arguments::Arguments;
use crate::equations::{both, single, state};
use crate::instruction::execute;
use crate::steps::Steps;

/// Steps of a live mechanism, in room of their own.
///
/// A step does what that of a mechanism of `mechanism!` does, to the last bit, and judges
/// nothing: where its growth exceeds what is healthy, or the state is not finite, the step
/// must not be taken.
///
/// # Example
/// ```
/// use mbs_live::{Stepper, Text};
/// use mbs_runtime::equations::At;
/// use mbs_runtime::{Explicit, Gains, Real};
///
/// let text = "Oscillator {
///     dof = 1;
///     body mass (x) { mass = 1 [kg]; }
///     force spring on x = -4 [N/m]*x;
///     start { x = 1 [m]; }
/// }";
/// let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
/// let (h, mut q, mut v) = (1e-3, vec![1.0], vec![0.0]);
/// let gains = Gains { minus_two_alpha: 0.0, minus_beta_squared: 0.0 };
/// let mut steps = Stepper::new(&oscillator, Explicit::default());
/// for k in 0..1000 {
///     let t = f64::from(k) * h;
///     steps.step(At { t, q: &q, v: &v }, &[], &gains, h, t + h);
///     (q, v) = (steps.q().to_vec(), steps.v().to_vec());
/// }
/// assert!((q[0] - 2.0_f64.cos()).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Stepper<T = f64>(Steps<T, 1>);

impl<T: Real> Stepper<T> {
    /// Steps of this method.
    pub fn new(mechanism: &Live<T>, method: Explicit) -> Self {
        let run = |instructions: &_, splines: &_, values: &mut _| execute(instructions, splines, values);
        Self(Steps::new(mechanism.programs(), method, run, |fixed| [mechanism.fixed(fixed)]))
    }

    /// Takes a step of length `h` seconds from a state to the time `t_next`, and returns the pivot growth, that of
    /// all stages added. Vectors have a component per coordinate that is integrated
    /// ([`Info::states`](mbs_runtime::Info::states)), or per input.
    pub fn step(&mut self, at: At<'_, T>, inputs: &[T], gains: &Gains<T>, h: T, t_next: T) -> T {
        self.0.step(&Arguments {
            inputs: single(inputs),
            gains: both(gains),
            step: [h],
            t_next: [t_next],
            ..state(at)
        });
        self.0.growth[0]
    }

    /// The positions that are integrated after the last step.
    pub fn q(&self) -> &[T] {
        self.0.q.as_flattened()
    }

    /// Their velocities after the last step.
    pub fn v(&self) -> &[T] {
        self.0.v.as_flattened()
    }
}
