//! Inverse dynamics: what a prescribed motion takes.

use mbs_runtime::equations::Equations;
use nalgebra::{DMatrix, DVector};

use crate::curve::{Curve, Moment};
use crate::derivative::scale;
use crate::difference::five_point;
use crate::guided::{Forces, Guided};
use crate::point::Drives;
use crate::singular::Singular;
use crate::{Error, Signal, Variable};

/// The efforts or inputs that produce a prescribed motion.
///
/// # Example
/// A rope lifts a load of 2 kg by the force `rope`:
/// ```
/// use mbs_analysis::{By, Curve, Prescription, inverse};
/// # use mbs_runtime::mechanism;
/// # mechanism! {
/// #     pub Hoist {
/// #         dof = 1;
/// #         input rope [N];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body load (y) { mass = 2 [kg]; }
/// #         force pull on y = rope;
/// #     }
/// # }
///
/// // halfway from 0 m to 3 m the acceleration is 0, and the weight is carried
/// for by in [By::Efforts, By::Inputs(vec!["rope".into()])] {
///     let curves = vec![("y".into(), Curve::rest_to_rest(0.0, 3.0, 0.0, 2.0)?)];
///     let request = Prescription { curves, by, ..Prescription::default() };
///     let found = inverse(&Hoist::declared(), &request, &[1.0])?;
///     // one of them is 0
///     assert!((found[0].efforts[0] + found[0].inputs[0] - 2.0 * 9.81).abs() < 1e-9);
/// }
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum By {
    /// A force or a torque along each prescribed coordinate, as if a drive moved it.
    #[default]
    Efforts,
    /// All declared inputs.
    AllInputs,
    /// The inputs with these names; the others keep their values.
    Inputs(Vec<String>),
}

/// A motion of some coordinates, and what produces it. See the examples of [`inverse`] and [`By`].
///
/// # Example
/// The drives of a mechanism without degrees of freedom prescribe its motion:
/// ```
/// use mbs_analysis::{Prescription, inverse};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Sledge {
///         dof = 0;
///         body sledge (x) { mass = 2 [kg]; }
///         drive motor: x = 3 [m/s^2]*t^2;
///     }
/// }
///
/// let found = inverse(&Sledge::declared(), &Prescription::default(), &[0.5])?;
/// assert!((found[0].v[0] - 3.0).abs() < 1e-12);
/// // the drive exerts −λ = m ẍ
/// assert!((found[0].multipliers[0] + 12.0).abs() < 1e-12);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Default)]
pub struct Prescription {
    /// The coordinates that are prescribed, as many as there are degrees of freedom, and their motions. It is empty for
    /// a mechanism that its drives determine.
    pub curves: Vec<(String, Curve)>,
    /// The efforts or inputs that produce the motion.
    pub by: By,
    /// All inputs: the values of those that are not looked for, and the first guesses of the others. `None` for their
    /// defaults.
    pub inputs: Option<Vec<f64>>,
    /// The positions from which the mechanism is led to the first sample, which decide on the branch;
    /// `None` for the declared start.
    pub from: Option<Vec<f64>>,
    /// The time of these positions in s.
    pub t: f64,
}

/// A moment of a prescribed motion. See the example of [`inverse`].
#[derive(Clone, Debug, PartialEq)]
pub struct Instant {
    /// The time in s.
    pub t: f64,
    /// Positions.
    pub q: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
    /// Accelerations.
    pub acceleration: Vec<f64>,
    /// The inputs: those that were found, and the others.
    pub inputs: Vec<f64>,
    /// The force or torque along each prescribed coordinate, in the order of the curves; 0 where inputs
    /// produce the motion.
    pub efforts: Vec<f64>,
    /// λ: that of a drive is −1 times what the drive exerts.
    pub multipliers: Vec<f64>,
    /// The declared outputs.
    pub outputs: Vec<f64>,
}

/// Newton's steps to inputs on which forces do not depend linearly.
const ITERATIONS: usize = 30;
/// Inputs whose effects are this share of the largest are none.
const NOTHING: f64 = 1e-9;
/// The forces that may be missing, as a share of the forces that act.
const MISSING: f64 = 1e-9;

/// Positions, velocities, accelerations and forces along a prescribed motion z(t) of some coordinates,
/// z = q_I, sample by sample:
///
/// ```text
/// Φ(q, t) = 0,  q_I = z             positions
/// Φ_q v = −Φ_t,  v_I = ż            velocities
/// Φ_q q̈ = γ,  q̈_I = z̈               accelerations
/// M q̈ + Φ_qᵀλ = Q(q, v, t, u) + 1_Iᵀτ
/// ```
///
/// By [`By::Efforts`] τ is found, the forces and torques along the prescribed coordinates, with the
/// inputs as they are. By inputs τ is 0 and u is found: from the accelerations that inputs cause, by
/// Newton's method, which ends after one step where Q is linear in u. As many inputs as degrees of
/// freedom are determined; of more, those of least norm (in SI units) are taken; of fewer, or of inputs
/// that act in the same way, the motion may take more than they can produce, which is an error.
///
/// A mechanism without degrees of freedom takes no curves: its drives prescribe the motion, and what they
/// exert is in the multipliers, and in outputs such as `effort(drive)`.
///
/// **Branches.** From sample to sample positions are followed by continuation: predicted along the
/// tangent, corrected by Newton's method, in steps that are halved where the correction is not small or
/// where the determinant of [Φ_q; 1_I] has changed its sign. So an assembly does not jump to another
/// branch, and a motion that leads to where the mechanism cannot be closed, or through a dead centre of
/// the prescribed coordinates, ends with the place where that is.
///
/// # Errors
/// [`Error::Prescribed`], [`Error::Unknown`], [`Error::Length`], [`Error::NoInputs`], and
/// [`Error::NoFreedom`] where drives leave inputs nothing to move, of what is asked;
/// [`Error::Unreachable`] and [`Error::Unproducible`] of the motion; [`Error::Undefined`].
///
/// # Example
/// ```
/// use mbs_analysis::{By, Curve, Prescription, inverse};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Arm {
///         dof = 1;
///         input torque [N*m];
///         gravity = (0, -9.81) [m/s^2];
///         body rod (x, y, phi) { mass = 2 [kg]; inertia = 0.06 [kg*m^2]; }
///         point hinge on rod = (-0.3, 0) [m];
///         revolute pivot (rod.hinge, ground);
///         torque motor on rod = torque;
///         start { phi = -90 [deg]; guess y = -0.3 [m]; }
///     }
/// }
///
/// // up by half a turn within a second
/// let half = std::f64::consts::FRAC_PI_2;
/// let lift = Curve::rest_to_rest(-half, half, 0.0, 1.0)?;
/// let request = Prescription { curves: vec![("phi".into(), lift)], by: By::AllInputs, ..Prescription::default() };
/// let found = inverse(&Arm::declared(), &request, &[0.0, 0.25, 0.5])?;
/// // (J + m s²) φ̈ + m g s cos φ
/// let expected = 2.0 * 9.81 * 0.3;
/// assert!((found[2].inputs[0] - expected).abs() < 1e-9);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
///
/// # Source
/// W. Blajer, K. Kołodziejczyk, A geometric approach to solving problems of control constraints, Multibody
/// System Dynamics 11 (2004) 343-364.
pub fn inverse(
    mechanism: &dyn Equations<f64>,
    request: &Prescription,
    times: &[f64],
) -> Result<Vec<Instant>, Error> {
    let info = mechanism.info();
    Error::refuse_rates(info, "an inverse motion")?;
    Error::refuse_states(info, "an inverse motion")?;
    info.refuse_clocks("an inverse motion")?;
    info.refuse_stops("an inverse motion")?;
    let names: Vec<String> = request.curves.iter().map(|(name, _)| name.clone()).collect();
    let places = places(mechanism, &names)?;
    let defaults = || info.inputs.iter().map(|input| input.default).collect();
    let inputs: Vec<f64> = request.inputs.clone().unwrap_or_else(defaults);
    let declared = || info.coordinates.iter().map(|q| q.default).collect();
    let from: Vec<f64> = request.from.clone().unwrap_or_else(declared);
    for (what, list, expected) in
        [("inputs", &inputs, info.inputs.len()), ("positions", &from, info.coordinates.len())]
    {
        if list.len() != expected {
            return Err(Error::Length { what, found: list.len(), expected });
        }
    }
    if times.iter().any(|t| !t.is_finite()) {
        return Err(Error::Samples { reason: "a time is no finite number" });
    }
    let wanted = wanted(mechanism, &request.by)?;
    if wanted.is_some() && places.is_empty() {
        return Err(Error::NoFreedom { mechanism: info.name });
    }
    let mut guided = Guided::new(mechanism, places, Drives::Moving, (request.t, &from))?;
    let mut producer = wanted.map(|places| Producer { places, inputs: inputs.clone() });
    let mut instants = Vec::with_capacity(times.len());
    for (at, t) in times.iter().enumerate() {
        let moments: Vec<Moment> = request.curves.iter().map(|(_, curve)| curve.at(*t)).collect();
        let of = |part: fn(&Moment) -> f64| DVector::from_iterator(moments.len(), moments.iter().map(part));
        let z = of(|moment| moment.position);
        guided.follow(*t, &z, at + 1)?;
        let v = guided.velocity(&of(|moment| moment.velocity));
        let acceleration = of(|moment| moment.acceleration);
        let (inputs, forces) = match &mut producer {
            None => (inputs.clone(), guided.forces(&v, &acceleration, &inputs)?),
            Some(producer) => {
                producer.find(&guided, &v, &acceleration, at + 1)?;
                let [q, multipliers] = guided.free(&v, &producer.inputs)?;
                let efforts = DVector::zeros(guided.places.len());
                (producer.inputs.clone(), Forces { acceleration: q, multipliers, efforts })
            }
        };
        instants.push(Instant::of(&guided, &v, inputs, &forces));
    }
    Ok(instants)
}

/// The coordinates with these names, as many as there are degrees of freedom.
fn places(mechanism: &dyn Equations<f64>, names: &[String]) -> Result<Vec<usize>, Error> {
    let info = mechanism.info();
    let place = |signal: Signal| match signal.variable {
        Variable::Coordinate(at) => Some(at),
        _ => None,
    };
    let places: Vec<usize> = Signal::coordinates(info, names)?.into_iter().filter_map(place).collect();
    let is_double = (1..places.len()).any(|at| places[..at].contains(&places[at]));
    if is_double || usize::try_from(info.dof) != Ok(places.len()) {
        return Err(Error::Prescribed { coordinates: names.to_vec(), dof: info.dof });
    }
    Ok(places)
}

/// The inputs that are to be found, if any are.
fn wanted(mechanism: &dyn Equations<f64>, by: &By) -> Result<Option<Vec<usize>>, Error> {
    let info = mechanism.info();
    let names = match by {
        By::Efforts => return Ok(None),
        By::AllInputs => None,
        By::Inputs(names) => Some(names.as_slice()),
    };
    let place = |signal: Signal| match signal.variable {
        Variable::Input(at) => Some(at),
        _ => None,
    };
    let places: Vec<usize> = Signal::inputs(info, names)?.into_iter().filter_map(place).collect();
    if places.is_empty() { Err(Error::NoInputs { mechanism: info.name }) } else { Ok(Some(places)) }
}

impl Instant {
    pub(crate) fn of(guided: &Guided<'_>, v: &DVector<f64>, inputs: Vec<f64>, forces: &Forces) -> Self {
        let list = |vector: &DVector<f64>| vector.as_slice().to_vec();
        Self {
            t: guided.t,
            q: list(&guided.q),
            v: list(v),
            acceleration: list(&forces.acceleration),
            efforts: list(&forces.efforts),
            multipliers: list(&forces.multipliers),
            outputs: guided.outputs(v, &inputs, forces),
            inputs,
        }
    }
}

/// The inputs that produce a motion.
struct Producer {
    /// Those that are looked for.
    places: Vec<usize>,
    /// All, as they were found last.
    inputs: Vec<f64>,
}

impl Producer {
    /// Finds u with q̈_I(u) = z̈. In every step G u′ = M_r(z̈ − q̈_I) + G u, with G = M_r ∂q̈_I/∂u: forces
    /// along the prescribed coordinates are balanced, so that what is missing is one.
    fn find(
        &mut self,
        guided: &Guided<'_>,
        v: &DVector<f64>,
        wanted: &DVector<f64>,
        sample: usize,
    ) -> Result<(), Error> {
        let mass = guided.mass();
        let scales = guided.scales.select_rows(&guided.places);
        // forces by the work that they do over a scale
        let work = |efforts: DVector<f64>| efforts.component_mul(&scales);
        let mut last = f64::INFINITY;
        let mut least = (f64::INFINITY, self.inputs.clone(), DVector::zeros(0));
        for _ in 0..ITERATIONS {
            let free = self.acceleration(guided, v, &self.inputs)?;
            let missing = work(&mass * (wanted - &free));
            let effects = self.effects(guided, v)?;
            let mut gains = &mass * &effects;
            for mut column in gains.column_iter_mut() {
                column.component_mul_assign(&scales);
            }
            let now = self.chosen();
            let done = &gains * &now;
            // what is at work: inertia, the forces of the free motion, and those of the inputs
            let parts = gains.component_mul(&DMatrix::from_rows(&vec![now.transpose(); gains.nrows()]));
            let acting = work(&mass * wanted).amax() + work(&mass * &free).amax() + parts.abs().amax();
            let share = if acting > 0.0 { missing.amax() / acting } else { 0.0 };
            if share < least.0 {
                least = (share, self.inputs.clone(), missing.clone());
            }
            if share <= f64::EPSILON || (share <= MISSING && share >= 0.5 * last) || !share.is_finite() {
                break;
            }
            last = share;
            let next = least_norm(&gains, &(&missing + &done));
            for (place, value) in self.places.iter().zip(&next) {
                self.inputs[*place] = *value;
            }
        }
        let (share, inputs, missing) = least;
        self.inputs = inputs;
        if share <= MISSING {
            Ok(())
        } else {
            Err(self.lacking(guided, &missing.component_div(&scales), sample))
        }
    }

    fn lacking(&self, guided: &Guided<'_>, missing: &DVector<f64>, sample: usize) -> Error {
        let info = guided.mechanism.info();
        let scales = guided.scales.select_rows(&guided.places);
        let at = if missing.is_empty() { 0 } else { missing.component_mul(&scales).icamax() };
        let coordinate = guided.places.get(at).and_then(|place| info.coordinates.get(*place));
        Error::Unproducible {
            sample,
            t: guided.t,
            coordinate: coordinate.map_or("", |q| q.name),
            effort: missing.get(at).map_or(f64::NAN, |x| x.abs()),
            inputs: self.places.iter().map(|place| info.inputs[*place].name.to_owned()).collect(),
        }
    }

    fn chosen(&self) -> DVector<f64> {
        DVector::from_iterator(self.places.len(), self.places.iter().map(|place| self.inputs[*place]))
    }

    /// q̈_I with these inputs.
    fn acceleration(
        &self,
        guided: &Guided<'_>,
        v: &DVector<f64>,
        inputs: &[f64],
    ) -> Result<DVector<f64>, Error> {
        let [free, _] = guided.free(v, inputs)?;
        Ok(free.select_rows(&guided.places))
    }

    /// ∂q̈_I/∂u: a step of Newton's method corrects what is wrong with differences.
    fn effects(&self, guided: &Guided<'_>, v: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        let quantities = guided.mechanism.info().inputs;
        let mut effects = DMatrix::zeros(guided.places.len(), self.places.len());
        for (column, place) in self.places.iter().enumerate() {
            let there = |change: f64| {
                let mut inputs = self.inputs.clone();
                inputs[*place] += change;
                let found = self.acceleration(guided, v, &inputs);
                found.unwrap_or_else(|_| DVector::from_element(guided.places.len(), f64::NAN))
            };
            effects.set_column(column, &five_point(there, scale(&quantities[*place], self.inputs[*place])));
        }
        Ok(effects)
    }
}

/// The least u with G u = `right`, or the one that leaves least of it.
fn least_norm(gains: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    if gains.iter().any(|x| !x.is_finite()) {
        return DVector::from_element(gains.ncols(), f64::NAN);
    }
    let decomposition = Singular::new(gains);
    decomposition.solve(right, NOTHING * decomposition.values.amax())
}
