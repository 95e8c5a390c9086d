//! Positions at which nothing moves.
//!
//! The search goes along the free directions of `tangent`. `newton` and `relaxation` are two ways, both made
//! of corrections of a position (`correction`). `stiffness` tells where a mechanism falls away.

mod correction;
mod newton;
mod relaxation;
mod stiffness;

use mbs_runtime::equations::Equations;
use nalgebra::{Complex, DVector};

use self::newton::newton;
use self::relaxation::relax;
use self::stiffness::Stiffness;
use crate::Error;
use crate::linearization::{Ports, on_its_rows};
use crate::point::OperatingPoint;
use crate::resting::Resting;
use crate::stops::{self, complementary, held_rows, meets_modes};
use crate::tangent::Rest;

/// The method by which an equilibrium is looked for.
///
/// # Example
/// ```
/// use mbs_analysis::{Search, Strategy, equilibrium};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     /// A pendulum, by its angle from the lowest position.
///     pub Pendulum {
///         dof = 1;
///         body rod (angle = phi) { inertia = 1 [kg*m^2]; }
///         torque weight on rod = -5 [N*m]*sin(phi);
///     }
/// }
///
/// // from a place near the top
/// let by = |strategy| Search { from: Some(vec![3.0]), strategy, ..Search::default() };
/// let nearest = equilibrium(&Pendulum::declared(), &by(Strategy::Newton))?;
/// assert!((nearest.q[0] - std::f64::consts::PI).abs() < 1e-9 && !nearest.is_stable());
/// let fallen = equilibrium(&Pendulum::declared(), &by(Strategy::Relaxation))?;
/// assert!(fallen.q[0].abs() < 1e-9 && fallen.is_stable());
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// Newton's method, then relaxation from the same position in two cases: Newton's method finds nothing, or the
    /// mechanism falls away where it leads, although it does not at the start.
    #[default]
    Automatic,
    /// Newton's method alone. It finds the nearest equilibrium, stable or not.
    Newton,
    /// Relaxation. It goes where the mechanism would come to rest if it moved slowly through a viscous fluid, to a
    /// stable equilibrium.
    Relaxation,
}

/// The start and the method of a search for an equilibrium. By default it begins at the declared start and goes on by
/// [`Strategy::Automatic`].
///
/// # Example
/// ```
/// use mbs_analysis::{Search, equilibrium};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Scale {
///         dof = 1;
///         input load [N];
///         body plate (y) { mass = 1 [kg]; }
///         force all on y = -load - 400 [N/m]*y;
///     }
/// }
///
/// let loaded = Search { inputs: Some(vec![20.0]), ..Search::default() };
/// let rest = equilibrium(&Scale::declared(), &loaded)?;
/// assert!((rest.q[0] + 20.0 / 400.0).abs() < 1e-12);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Search {
    /// The positions from which the search begins. They decide on the branch. `None` for the declared start.
    pub from: Option<Vec<f64>>,
    /// The inputs; `None` for their defaults.
    pub inputs: Option<Vec<f64>>,
    /// The time in s at which drives and forces are held.
    pub t: f64,
    /// The method.
    pub strategy: Strategy,
}

/// A position at which nothing moves. See the example of [`equilibrium`].
#[derive(Clone, Debug, PartialEq)]
pub struct Equilibrium {
    /// The time in s at which drives and forces are held.
    pub t: f64,
    /// Positions; behind them the values of own states.
    pub q: Vec<f64>,
    /// How many of these are positions.
    pub lines: usize,
    /// Multipliers: the reactions that hold it.
    pub multipliers: Vec<f64>,
    /// The inputs with which it was found, with the memories of stops as they are there.
    pub inputs: Vec<f64>,
    /// The stops that it rests on, by their places in [`Info::stops`](mbs_runtime::Info::stops), and the forces with which
    /// they push: along a gap in m in N.
    pub rests: Vec<(usize, f64)>,
    /// The constraints of modes that hold, by their places in [`Modes::locks`](mbs_runtime::Modes::locks), and their
    /// multipliers. Those that repeat others are left out.
    pub held: Vec<(usize, f64)>,
    /// κ of K_r x = κ M_r x, ascending, in 1/s²: the squares of the natural frequencies of an
    /// undamped mechanism, negative for directions in which it falls away.
    pub stiffness: Vec<f64>,
    /// The share of the largest stiffness below which a stiffness counts as zero: 10⁻¹² with derivatives by the chain
    /// rule, 10⁻⁹ with differences. Derivatives are known to about a hundredth of that.
    pub resolution: f64,
    /// λ of deviations e^{λt} with own states, in 1/s, one of each conjugate pair; empty for a mechanism without own
    /// states, or where they were not found.
    pub rates: Vec<Complex<f64>>,
    /// The number of iterations.
    pub iterations: u32,
}

/// The growth of small disturbances, as far as the stiffness tells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stability {
    /// Every small displacement is driven back.
    Stable,
    /// Some displacements are neither driven back nor driven on.
    Indifferent,
    /// The mechanism falls away in some directions.
    Unstable {
        /// The number of negative stiffnesses.
        directions: usize,
    },
}

/// A search ends after so many iterations.
const ITERATIONS: u32 = 200;
/// A step of a search moves no coordinate by more than this share of its scale.
const LONGEST: f64 = 0.25;
/// A search ends that leads further than so many sizes of the mechanism at the start.
const FAR: f64 = 1e4;

/// The result of a search.
struct Found {
    q: DVector<f64>,
    iterations: u32,
}

impl Equilibrium {
    /// The response to small disturbances, as far as the stiffness tells. Friction, dampers and gyroscopic
    /// terms are not asked; forces that follow the motion may make a position unstable by flutter although
    /// its stiffness is positive. Of a mechanism with own states it is what their linear system tells, with all of
    /// these: a controller holds what falls without it.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::{Search, Stability, equilibrium};
    /// use mbs_runtime::mechanism;
    ///
    /// mechanism! {
    ///     /// A ball on a saddle.
    ///     pub Ball {
    ///         dof = 2;
    ///         body ball (x, y) { mass = 1 [kg]; }
    ///         force slope on ball = (3 [N/m]*x, -7 [N/m]*y);
    ///     }
    /// }
    ///
    /// let rest = equilibrium(&Ball::declared(), &Search::default())?;
    /// assert_eq!(rest.stability(), Stability::Unstable { directions: 1 });
    /// // force over displacement and mass, in 1/s²
    /// assert!((rest.stiffness[0] + 3.0).abs() < 1e-9 && (rest.stiffness[1] - 7.0).abs() < 1e-9);
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    pub fn stability(&self) -> Stability {
        if !self.rates.is_empty() {
            let growing = |rate: &&Complex<f64>| rate.re > 0.0;
            // of a pair both grow
            let of = |rate: &Complex<f64>| if rate.im == 0.0 { 1 } else { 2 };
            return match self.rates.iter().filter(growing).map(of).sum() {
                0 if self.rates.iter().all(|rate| rate.norm() > 0.0) => Stability::Stable,
                0 => Stability::Indifferent,
                directions => Stability::Unstable { directions },
            };
        }
        let largest = self.stiffness.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let directions = self.stiffness.iter().filter(|x| **x < -self.resolution * largest).count();
        match directions {
            0 if self.stiffness.iter().all(|x| *x > self.resolution * largest) => Stability::Stable,
            0 => Stability::Indifferent,
            directions => Stability::Unstable { directions },
        }
    }

    /// True if every small displacement is driven back. See the example of [`Strategy`].
    pub fn is_stable(&self) -> bool {
        self.stability() == Stability::Stable
    }
}

impl From<&Equilibrium> for OperatingPoint {
    fn from(rest: &Equilibrium) -> Self {
        Self::split(rest.t, &rest.q, rest.lines, &rest.inputs)
    }
}

/// A position near the given one at which nothing moves: with v = 0,
///
/// ```text
/// ⎡ Q − Φ_qᵀ λ ⎤
/// ⎣ Φ          ⎦ = 0
/// ```
///
/// The unknowns are minimal coordinates z along the constraints, Φ_q N = 0, and what vanishes is
/// the acceleration from rest, z̈ = N⁺q̈: zero where the forces along the constraints are.
///
/// *Newton's method* takes steps of a bounded length, so that the branch of the start is kept, and solves for
/// the least step, so that a direction without forces does not matter. A step is halved where the correction
/// after it is longer than the last few (a non-monotone line search): lengths are compared and not
/// accelerations, because any step bends a stiff spring.
///
/// *Relaxation* follows ż = z̈ in implicit Euler steps that become longer as the mechanism comes to rest
/// (pseudo-transient continuation), and ends with Newton's method: towards a stable equilibrium, past
/// unstable ones, from which it is pushed if it begins there. The equation of each step is solved, which
/// leads along the curved valley of a stiff spring.
///
/// *Stops* that a mechanism rests on push, and no gap is negative: the search is made on the constraints and on the gaps of
/// sets of stops, first those that the start touches, until both hold. Where several sets have an equilibrium, it is that of
/// the set to which the search is led, or of the smallest one from which the mechanism does not fall away.
///
/// *Modes* hold as the inputs say: without inputs as they are declared. Their constraints are met where it rests, and their
/// multipliers are found with the others.
///
/// A mechanism without degrees of freedom rests where it is assembled: what is found are its reactions.
///
/// Own states are unknowns as positions are: at rest ż = 0. Stiffnesses are those of the mechanism while they are
/// held.
///
/// Drives are held where they are at `t`. Derivatives are exact for a mechanism that is
/// [differentiable](Equations::is_differentiable): a text, or a type in
/// [`Differentiated`](mbs_runtime::equations::Differentiated). For other types they are five-point
/// differences, about 10⁻¹¹ of their size, which bounds the rate of convergence and not the result;
/// stiffnesses are good to ten digits then.
///
/// # Example
/// ```
/// use mbs_analysis::{Search, equilibrium};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     /// A weight that hangs on a spring.
///     pub Weight {
///         dof = 1;
///         gravity = (0, -9.81) [m/s^2];
///         body weight (y) { mass = 2 [kg]; }
///         force spring on y = -100 [N/m]*y;
///     }
/// }
///
/// let rest = equilibrium(&Weight::declared(), &Search::default())?;
/// // y = −m g/k, and κ = k/m
/// assert!((rest.q[0] + 2.0 * 9.81 / 100.0).abs() < 1e-12);
/// assert!((rest.stiffness[0] - 50.0).abs() < 1e-8 && rest.is_stable());
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoEquilibrium`], [`Error::NoRest`], [`Error::Length`]; [`Error::Undefined`] and
/// [`Error::Slope`] where a force has no value or an infinite slope; of the mechanism
/// [`NotAssembled`](mbs_runtime::Error::NotAssembled).
///
/// # Source
/// L. Grippo, F. Lampariello, S. Lucidi, A nonmonotone line search technique for Newton's method, SIAM J.
/// Numer. Anal. 23 (1986) 707-716;
/// C. T. Kelley, D. E. Keyes, Convergence analysis of pseudo-transient continuation, SIAM J.
/// Numer. Anal. 35 (1998) 508-523.
pub fn equilibrium(mechanism: &dyn Equations<f64>, search: &Search) -> Result<Equilibrium, Error> {
    let info = mechanism.info();
    Error::refuse_rates(info, "an equilibrium")?;
    info.refuse_sticking("an equilibrium")?;
    let declared: Vec<f64> = info.coordinates.iter().map(|q| q.default).collect();
    let defaults: Vec<f64> = info.inputs.iter().map(|input| input.default).collect();
    let from = search.from.clone().unwrap_or(declared);
    let inputs = search.inputs.clone().unwrap_or(defaults);
    check("positions", &from, info.coordinates.len())?;
    check("inputs", &inputs, info.inputs.len())?;
    let held = held_rows(mechanism, (search.t, &from), &inputs);
    Error::refuse_rates(Resting::new(mechanism, &held).info(), "an equilibrium")?;
    if info.stops.is_empty() && held.is_empty() {
        return on_rows(mechanism, search, DVector::from_vec(from), inputs);
    }
    let (stops, mut found) = complementary(mechanism, (search.t, &from, &held), |mechanism| {
        let found = on_rows(mechanism, search, DVector::from_column_slice(&from), inputs.clone())?;
        let (q, multipliers) = (found.q.clone(), found.multipliers.clone());
        let falls =
            search.strategy != Strategy::Newton && matches!(found.stability(), Stability::Unstable { .. });
        Ok(stops::Found { result: found, q, multipliers, falls })
    })?;
    meets_modes(mechanism, (search.t, &found.q), &inputs)?;
    let mut of_modes = found.multipliers.split_off(info.constraints.len());
    let of_stops = of_modes.split_off(held.len());
    found.rests = stops.into_iter().zip(of_stops.into_iter().map(|multiplier| -multiplier)).collect();
    let place = |row: usize| info.locks().position(|(of, _)| of == row);
    found.held = held.into_iter().filter_map(place).zip(of_modes).collect();
    for (at, multiplier) in &found.held {
        found.inputs[info.modes.locks[*at].held] = *multiplier;
    }
    for (at, stop) in info.stops.iter().enumerate() {
        let is_rested_on = found.rests.iter().any(|(stop, _)| *stop == at);
        found.inputs[stop.memory] = f64::from(u8::from(is_rested_on));
    }
    Ok(found)
}

/// The same for a mechanism without stops but for those among its rows.
fn on_rows(
    mechanism: &dyn Equations<f64>,
    search: &Search,
    mut start: DVector<f64>,
    inputs: Vec<f64>,
) -> Result<Equilibrium, Error> {
    let info = mechanism.info();
    let rest = Rest::new(mechanism, search.t, &inputs, start.as_slice());
    rest.assemble(&mut start)?;
    let is_held = info.dof == 0 && info.lines == info.coordinates.len();
    let Found { q, iterations } = match search.strategy {
        _ if is_held => Found { q: start, iterations: 0 },
        Strategy::Newton => newton(&rest, &rest, start, ITERATIONS)?,
        Strategy::Relaxation => relax(&rest, start)?,
        Strategy::Automatic => automatic(&rest, start)?,
    };
    let (_, multipliers) = rest.acceleration(&q);
    // without a free direction the reactions are all that is found
    let is_known = info.dof != 0 || multipliers.iter().all(|x| x.is_finite());
    let stiffness = if is_known { stiffness(&rest, &q) } else { None };
    let Some(stiffness) = stiffness else { return Err(lost(&rest, &q, iterations)) };
    let mut found = Equilibrium {
        t: search.t,
        q: q.as_slice().to_vec(),
        lines: info.lines,
        multipliers: multipliers.as_slice().to_vec(),
        stiffness,
        resolution: rest.resolution(),
        rates: Vec::new(),
        iterations,
        inputs,
        rests: Vec::new(),
        held: Vec::new(),
    };
    if info.lines < info.coordinates.len() {
        found.rates = rates(mechanism, &found).unwrap_or_default();
    }
    Ok(found)
}

/// λ of all modes of the linear system about an equilibrium.
fn rates(mechanism: &dyn Equations<f64>, rest: &Equilibrium) -> Result<Vec<Complex<f64>>, Error> {
    let linear = on_its_rows(mechanism, &OperatingPoint::from(rest), &Ports::default())?;
    Ok(linear.modes()?.into_iter().map(|mode| mode.eigenvalue).collect())
}

fn stiffness(rest: &Rest<'_>, q: &DVector<f64>) -> Option<Vec<f64>> {
    Stiffness::at(rest, q).map(|stiffness| stiffness.values)
}

fn check(what: &'static str, values: &[f64], expected: usize) -> Result<(), Error> {
    if values.len() == expected { Ok(()) } else { Err(Error::Length { what, found: values.len(), expected }) }
}

/// By Newton's method; by relaxation if that leads nowhere, or to where the mechanism falls away although it
/// does not at the start.
fn automatic(rest: &Rest<'_>, start: DVector<f64>) -> Result<Found, Error> {
    let falls = |q| Stiffness::at(rest, q).is_some_and(|found| found.falling > 0.0);
    match newton(rest, rest, start.clone(), ITERATIONS) {
        Ok(found) if falls(&start) || !falls(&found.q) => Ok(found),
        found => relax(rest, start).or(found),
    }
}

/// The mechanism with the size that it has at a position, unless that is far away. Steps are measured by
/// the size, and those from a start near the origin would stay as small as the mechanism seems there.
fn near<'a>(rest: &Rest<'a>, q: &DVector<f64>) -> Option<Rest<'a>> {
    let grown = rest.grown(q.as_slice());
    (grown.length <= FAR * rest.length).then_some(grown)
}

/// Nothing was found; `q` is where least accelerated.
fn lost(rest: &Rest<'_>, q: &DVector<f64>, iterations: u32) -> Error {
    let coordinates = rest.mechanism.info().coordinates;
    let name = |at: usize| coordinates.get(at).map_or("", |q| q.name);
    let (a, _) = rest.acceleration(q);
    if let Some(at) = a.iter().position(|a| !a.is_finite()) {
        return Error::Undefined { coordinate: name(at) };
    }
    if let Some(at) = rest.without_derivative(q) {
        return Error::Slope { of: format!("the acceleration of `{}`", name(at)) };
    }
    let at = a.component_div(&rest.scales()).iamax();
    if rest.mechanism.info().is_own(at) {
        return Error::NoRest { state: name(at), rate: a[at], iterations };
    }
    Error::NoEquilibrium { coordinate: name(at), acceleration: a[at], iterations }
}
