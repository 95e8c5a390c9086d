//! Responses of a linear system to harmonic inputs and to a step.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, DMatrix, DVector};

use crate::{Error, Linearization, complex};

/// y after a step of one input, at rest before. See the example of [`Linearization::step_response`].
#[derive(Clone, Debug, PartialEq)]
pub struct StepResponse {
    /// The instants in s, from 0, evenly spaced.
    pub times: Vec<f64>,
    /// A row for each instant, a column for each output: the deviation from the operating point, per unit
    /// of the input.
    pub outputs: DMatrix<f64>,
}

impl Linearization {
    /// H(iω) = C (iω1 − A)⁻¹ B + D at a frequency in rad/s: outputs × inputs, each as amplitude and phase
    /// of an output per unit of an input that oscillates with that frequency. Infinite at the frequency
    /// of an undamped mode. Meaningful for stable systems, in which all else dies away.
    ///
    /// # Errors
    /// [`Error::Range`] for a frequency that is not above 0.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::{OperatingPoint, Ports, linearize};
    /// # use mbs_live::Text;
    /// # let text = "Oscillator {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body block (x) { mass = 2 [kg]; }
    /// #     force all on x = push - 200 [N/m]*x - 4 [N*s/m]*der(x);
    /// # }";
    /// # let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
    /// # let point = OperatingPoint::at_rest(0.0, &[0.0], &[0.0]);
    /// # let linear = linearize(&oscillator, &point, &Ports::default())?;
    /// // H = 1/(k − m ω² + iωc) with 2 kg, 200 N/m and 4 N s/m; at 10 rad/s only the damper resists
    /// let response = linear.frequency_response(10.0)?;
    /// assert!((response[(0, 0)].norm() - 1.0 / 40.0).abs() < 1e-10);
    /// assert!((response[(0, 0)].arg() + std::f64::consts::FRAC_PI_2).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn frequency_response(&self, omega: f64) -> Result<DMatrix<Complex<f64>>, Error> {
        if !(omega > 0.0 && omega.is_finite()) {
            return Err(Error::Range { what: "frequency", value: omega, unit: "rad/s" });
        }
        let (f, s) = (self.dof(), Complex::new(0.0, omega));
        let pencil = self.pencil(s);
        let unknowns = pencil.nrows();
        let right = self.b.rows(f, unknowns).map(Complex::from);
        let infinite = Complex::new(f64::INFINITY, f64::NAN);
        let solved = complex::solved(&pencil, &right)
            .unwrap_or_else(|| DMatrix::from_element(unknowns, self.b.ncols(), infinite));
        let [of_z, of_rates] = [0, f].map(|first| self.c.columns(first, f).map(Complex::from));
        let of_states = self.c.columns(2 * f, unknowns - f).map(Complex::from);
        let response = (of_z + of_rates * s) * solved.rows(0, f) + of_states * solved.rows(f, unknowns - f);
        Ok(response + self.d.map(Complex::from))
    }

    /// The matrix of (z, s) that ż = λz leaves of λ1 − A: λ²1 − λG − K, bordered by own states.
    pub(crate) fn pencil(&self, lambda: Complex<f64>) -> DMatrix<Complex<f64>> {
        let f = self.dof();
        let unknowns = self.a.nrows() - f;
        let entry = |row: usize, column: usize| {
            let unit = match row == column {
                true if row < f => lambda * lambda,
                true => lambda,
                false => Complex::from(0.0),
            };
            if column >= f {
                return unit - self.a[(f + row, f + column)];
            }
            unit - lambda * self.a[(f + row, f + column)] - self.a[(f + row, column)]
        };
        DMatrix::from_fn(unknowns, unknowns, entry)
    }

    /// The response to a unit step of an input at t = 0, at `steps` + 1 instants until `end` seconds.
    ///
    /// x_{k+1} = e^{Ah} x_k + ∫₀ʰ e^{As} ds B u is exact for an input that is held, whatever the step:
    /// the exponential is that of [A B; 0 0] h.
    ///
    /// # Errors
    /// [`Error::Range`] for an end or a number of steps that is not above 0; [`Error::Unknown`] for a
    /// name that no input of the system has.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::{OperatingPoint, Ports, linearize};
    /// # use mbs_live::Text;
    /// # let text = "Oscillator {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body block (x) { mass = 2 [kg]; }
    /// #     force all on x = push - 200 [N/m]*x - 4 [N*s/m]*der(x);
    /// # }";
    /// # let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
    /// # let point = OperatingPoint::at_rest(0.0, &[0.0], &[0.0]);
    /// # let linear = linearize(&oscillator, &point, &Ports::default())?;
    /// // 1 N on 2 kg with 200 N/m and 4 N s/m
    /// let step = linear.step_response("push", 2.0, 40)?;
    /// for (row, t) in step.times.iter().enumerate() {
    ///     let omega = f64::sqrt(99.0);
    ///     let left = (-t).exp() * ((omega * t).cos() + (omega * t).sin() / omega);
    ///     assert!((step.outputs[(row, 0)] - (1.0 - left) / 200.0).abs() < 1e-9);
    /// }
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// C. F. Van Loan, Computing integrals involving the matrix exponential, IEEE Trans. Automat.
    /// Control 23 (1978) 395-404. N. J. Higham, The scaling and squaring method for the matrix
    /// exponential revisited, SIAM J. Matrix Anal. Appl. 26 (2005) 1179-1193.
    pub fn step_response(&self, input: &str, end: f64, steps: usize) -> Result<StepResponse, Error> {
        if !(end > 0.0 && end.is_finite()) {
            return Err(Error::Range { what: "the end of a step response", value: end, unit: "s" });
        }
        if steps == 0 {
            return Err(Error::Range { what: "the number of steps", value: 0.0, unit: "" });
        }
        let Some(at) = self.inputs.iter().position(|signal| signal.name == input) else {
            let known = self.inputs.iter().map(|signal| signal.name.clone()).collect();
            return Err(Error::Unknown { kind: "input", name: input.to_owned(), known });
        };
        let (n, h) = (self.a.nrows(), end / steps as f64);
        let mut augmented = DMatrix::zeros(n + 1, n + 1);
        augmented.view_mut((0, 0), (n, n)).copy_from(&(&self.a * h));
        augmented.view_mut((0, n), (n, 1)).copy_from(&(self.b.column(at) * h));
        let exponential = augmented.exp();
        let (transition, forced) = (exponential.view((0, 0), (n, n)), exponential.column(n));
        let mut outputs = DMatrix::zeros(steps + 1, self.outputs.len());
        let mut x = DVector::zeros(n);
        for row in 0..=steps {
            let y = &self.c * &x + self.d.column(at);
            outputs.set_row(row, &y.transpose());
            x = transition * x + forced.rows(0, n);
        }
        let times = (0..=steps).map(|k| end * k as f64 / steps as f64).collect();
        Ok(StepResponse { times, outputs })
    }
}

/// The phases of a response in rad along ascending frequencies, without jumps by 2π. The first phase is between −π
/// and π. Where the phase turns by half a turn at once, it falls if the frequency of an undamped mode, one of
/// `resonances`, lies between, and rises at a zero, as both do with a little damping. No numbers where
/// the response has none.
///
/// # Example
/// ```
/// use mbs_analysis::nalgebra::Complex;
/// use mbs_analysis::phases;
///
/// // two oscillators in a row: 1/((1 − ω²)(4 − ω²)) turns by half a turn at 1 rad/s and at 2 rad/s
/// let frequencies = [0.5, 1.5, 2.5];
/// let response = frequencies.map(|omega| Complex::from(1.0 / ((1.0 - omega * omega) * (4.0 - omega * omega))));
/// let found = phases(&frequencies, &response, &[1.0, 2.0]);
/// let half = std::f64::consts::PI;
/// for (phase, expected) in found.iter().zip([0.0, -half, -2.0 * half]) {
///     assert!((phase - expected).abs() < 1e-12);
/// }
/// ```
pub fn phases(frequencies: &[f64], response: &[Complex<f64>], resonances: &[f64]) -> Vec<f64> {
    /// Of half a turn, for what is half a turn but for rounding.
    const SLACK: f64 = 1e-6;
    let mut last: Option<(f64, f64)> = None;
    let unwrapped = frequencies.iter().zip(response).map(|(&omega, h)| {
        let principal = h.arg();
        if !principal.is_finite() {
            return f64::NAN;
        }
        // half a turn may come out on either side
        let principal = if principal > PI - SLACK { principal - TAU } else { principal };
        let phase = last.map_or(principal, |(before, last)| {
            let near = principal + TAU * ((last - principal) / TAU).round();
            if ((near - last).abs() - PI).abs() > SLACK {
                return near;
            }
            let falls = resonances.iter().any(|pole| (before..=omega).contains(pole));
            last + if falls { -PI } else { PI }
        });
        last = Some((omega, phase));
        phase
    });
    unwrapped.collect()
}
