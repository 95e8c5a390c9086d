//! How modes follow parameters.
//!
//! It differences the linear systems about equilibria that move with a parameter. A mechanism at other
//! parameters comes from a `Family`.

use mbs_runtime::equations::Equations;
use nalgebra::{Complex, DMatrix, DVector};

use crate::complex;
use crate::derivative::scale;
use crate::difference::{derivative, from_one_side};
use crate::family::{Family, Varied};
use crate::modes::{Behaviour, Mode};
use crate::pencil::Pencil;
use crate::{
    Equilibrium, Error, Linearization, OperatingPoint, Ports, Search, Signal, Strategy, Variable,
    equilibrium, linearize,
};

/// The first difference changes a parameter by this share, each further one by half of the one before.
const LONGEST: f64 = 0.01;
const LEVELS: usize = 4;

/// The modes about an equilibrium, and how they follow parameters. See the example of [`sensitivities`].
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivities {
    /// The equilibrium.
    pub equilibrium: Equilibrium,
    /// The linear system about it.
    pub linearization: Linearization,
    /// The modes.
    pub modes: Vec<Mode>,
    /// The parameters.
    pub parameters: Vec<Signal>,
    /// dλ/dp in SI units: a row for each mode, a column for each parameter. No number for rigid-body
    /// modes, and at critical damping, where λ has no derivative.
    pub eigenvalues: DMatrix<Complex<f64>>,
}

impl Sensitivities {
    /// dω/dp of the natural frequency of a mode with respect to a parameter, in rad/s per SI unit. See the example of
    /// [`sensitivities`].
    pub fn natural_frequency(&self, mode: usize, parameter: usize) -> f64 {
        let (lambda, change) = (self.modes[mode].eigenvalue, self.eigenvalues[(mode, parameter)]);
        (lambda.conj() * change).re / lambda.norm()
    }

    /// dζ/dp of the damping ratio of a mode with respect to a parameter, per SI unit. See the example of
    /// [`sensitivities`].
    pub fn damping_ratio(&self, mode: usize, parameter: usize) -> f64 {
        let (lambda, change) = (self.modes[mode].eigenvalue, self.eigenvalues[(mode, parameter)]);
        let size = lambda.norm();
        lambda.re * self.natural_frequency(mode, parameter) / (size * size) - change.re / size
    }
}

/// The modes about an equilibrium, and their derivatives with respect to parameters.
///
/// The equilibrium moves with a parameter, and the linear system about it with both. With
/// P(λ) = λ²1 − λG − K, and the right and left null vectors z and y of P(λ),
///
/// ```text
/// dλ/dp = yᴴ (λ dG/dp + dK/dp) z / yᴴ (2λ1 − G) z
/// ```
///
/// and for eigenvalues that are equal the eigenvalues of the two matrices that z and y of all of them
/// make of this. K and G at other parameters are differenced, each about its own equilibrium, found
/// from the one before by Newton's method; good to about eight digits.
///
/// `parameters` are the values of all, `names` those to differentiate with respect to.
///
/// # Errors
/// [`Error::Unknown`] for a name that no parameter has; those of [`equilibrium`], of [`linearize`]
/// and of [`Linearization::modes`]; what the mechanism says of parameters.
///
/// # Example
/// ```
/// use mbs_analysis::{Ports, Search, of_type, sensitivities};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Oscillator {
///         dof = 1;
///         param k = 200 [N/m];
///         param c = 4 [N*s/m];
///         body block (x) { mass = 2 [kg]; }
///         force all on x = -k*x - c*der(x);
///     }
/// }
///
/// let (values, names) = ([200.0, 4.0], ["k".into(), "c".into()]);
/// let family = of_type::<Oscillator>();
/// let found = sensitivities(&family, &values, &Search::default(), &Ports::default(), &names)?;
/// // ω = √(k/m) = 10 rad/s and ζ = c/(2√(k m)) = 0.1
/// assert!((found.natural_frequency(0, 0) - 10.0 / (2.0 * 200.0)).abs() < 1e-8);
/// assert!((found.damping_ratio(0, 0) + 0.1 / (2.0 * 200.0)).abs() < 1e-9);
/// assert!((found.damping_ratio(0, 1) - 0.1 / 4.0).abs() < 1e-8);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
///
/// # Source
/// P. Lancaster, On eigenvalues of matrices dependent on a parameter, Numer. Math. 6 (1964) 377-387.
pub fn sensitivities(
    family: &dyn Family,
    parameters: &[f64],
    search: &Search,
    ports: &Ports<'_>,
    names: &[String],
) -> Result<Sensitivities, Error> {
    let varied = Varied { family, parameters };
    varied
        .seen(parameters, |mechanism| Error::refuse_states(mechanism.info(), "the sensitivity of modes"))?;
    let (equilibrium, linearization) =
        varied.seen(parameters, |mechanism| about_rest(mechanism, search, ports))?;
    let signals = varied.seen(parameters, |mechanism| Signal::parameters(mechanism.info(), names))?;
    let modes = linearization.modes()?;
    let pencil = Pencil::of(&linearization);
    let states = linearization.states.iter().take(linearization.dof()).map(|state| state.name.clone());
    let nearby = Nearby {
        varied,
        search: Search {
            from: Some(equilibrium.q.clone()),
            strategy: Strategy::Newton,
            inputs: Some(equilibrium.inputs.clone()),
            t: equilibrium.t,
        },
        ports: Ports {
            states: Some(states.collect()),
            inputs: Some(Vec::new()),
            outputs: Some(Vec::new()),
            ..Ports::default()
        },
    };
    let mut eigenvalues = DMatrix::zeros(modes.len(), signals.len());
    for (column, signal) in signals.iter().enumerate() {
        let Variable::Parameter(at) = signal.variable else { continue };
        let [stiffness, damping] = nearby.change(at, linearization.dof())?;
        let change = [
            pencil.changed(&stiffness) / (pencil.rate * pencil.rate),
            pencil.changed(&damping) / pencil.rate,
        ];
        for (row, value) in of_modes(&pencil, &modes, &change).into_iter().enumerate() {
            eigenvalues[(row, column)] = value * pencil.rate;
        }
    }
    Ok(Sensitivities { equilibrium, linearization, modes, parameters: signals, eigenvalues })
}

fn about_rest(
    mechanism: &dyn Equations<f64>,
    search: &Search,
    ports: &Ports<'_>,
) -> Result<(Equilibrium, Linearization), Error> {
    let rest = equilibrium(mechanism, search)?;
    let linear = linearize(mechanism, &OperatingPoint::from(&rest), ports)?;
    Ok((rest, linear))
}

impl Varied<'_> {
    /// Returns what `look` sees of the mechanism with these parameters.
    fn seen<R>(
        &self,
        parameters: &[f64],
        look: impl Fn(&dyn Equations<f64>) -> Result<R, Error>,
    ) -> Result<R, Error> {
        let mut seen = None;
        self.family.with(parameters, &mut |mechanism| seen = Some(look(mechanism)))?;
        seen.unwrap_or(Err(Error::NoFamily { parameter: String::new() }))
    }
}

/// A mechanism with other parameters, which rests near by.
struct Nearby<'a> {
    varied: Varied<'a>,
    search: Search,
    ports: Ports<'static>,
}

impl Nearby<'_> {
    /// dK/dp and dG/dp.
    fn change(&self, parameter: usize, f: usize) -> Result<[DMatrix<f64>; 2], Error> {
        let values = self.varied.parameters;
        let quantity = |mechanism: &dyn Equations<f64>| {
            Ok(scale(&mechanism.info().parameters[parameter], values[parameter]))
        };
        let step = LONGEST * self.varied.seen(values, quantity)?;
        let there = |change: f64| {
            let mut moved = values.to_vec();
            moved[parameter] += change;
            let (_, linear) =
                self.varied.seen(&moved, |mechanism| about_rest(mechanism, &self.search, &self.ports))?;
            Ok(DVector::from_column_slice(linear.a.rows(f, f).clone_owned().as_slice()))
        };
        let change = match derivative(there, step, LEVELS, false) {
            // a parameter that is not defined on one side, such as damping below 0
            Err(Error::Mechanism(_)) => from_one_side(there, step, LEVELS)?,
            other => other?,
        };
        let [change, _] = change;
        let both = DMatrix::from_column_slice(f, 2 * f, change.as_slice());
        Ok([both.columns(0, f).clone_owned(), both.columns(f, f).clone_owned()])
    }
}

/// dλ/dp of all modes, in units of the rate of the pencil.
fn of_modes(pencil: &Pencil, modes: &[Mode], change: &[DMatrix<f64>; 2]) -> Vec<Complex<f64>> {
    let unknown = Complex::new(f64::NAN, f64::NAN);
    let mut found = vec![unknown; modes.len()];
    let mut first = 0;
    while first < modes.len() {
        let lambda = modes[first].eigenvalue / pencil.rate;
        let is_same = |mode: &&Mode| (mode.eigenvalue / pencil.rate - lambda).norm() <= 1e-7 * lambda.norm();
        let count = modes[first..].iter().take_while(is_same).count().max(1);
        let equal = &modes[first..first + count];
        if modes[first].behaviour != Behaviour::RigidBody {
            let values = of_equal(pencil, lambda, equal, change);
            found[first..first + count].iter_mut().zip(values).for_each(|(place, value)| *place = value);
        }
        first += count;
    }
    found
}

/// Of modes with one eigenvalue.
fn of_equal(
    pencil: &Pencil,
    lambda: Complex<f64>,
    modes: &[Mode],
    [stiffness, damping]: &[DMatrix<f64>; 2],
) -> Vec<Complex<f64>> {
    let f = stiffness.nrows();
    let side = |side: usize| DMatrix::from_fn(f, modes.len(), |row, column| modes[column].vectors[side][row]);
    let (right, left) = (side(0), side(1).adjoint());
    let moved = damping.map(Complex::from) * lambda + stiffness.map(Complex::from);
    let slope = DMatrix::from_diagonal_element(f, f, lambda * 2.0) - pencil.damping.map(Complex::from);
    let (over, under) = (&left * moved * &right, &left * slope * &right);
    let none = vec![Complex::new(f64::NAN, f64::NAN); modes.len()];
    // at critical damping a change of p moves λ like its root
    if under.norm() < 1e-6 * lambda.norm() {
        return none;
    }
    let reduced = complex::solved(&under, &over);
    reduced.and_then(|reduced| complex::eigenvalues(&reduced)).unwrap_or(none)
}
