//! Statics along a slow motion: efforts over travel, and mechanical advantage.

use mbs_runtime::equations::Equations;
use nalgebra::{DMatrix, DVector};

use crate::chart::beside;
use crate::difference::five_point;
use crate::guided::{Forces, Guided};
use crate::inverse::Instant;
use crate::point::Drives;
use crate::tangent::Rest;
use crate::{Error, Signal, Variable};

/// The coordinate or the drive that is moved slowly.
///
/// # Example
/// A drive moves a ram against a spring of 500 N/m, by 0.1 m/s:
/// ```
/// use mbs_analysis::{Along, Travel, travel};
/// # use mbs_runtime::mechanism;
/// # mechanism! {
/// #     pub Press {
/// #         dof = 0;
/// #         body ram (x) { mass = 2 [kg]; }
/// #         force spring on x = -500 [N/m]*x;
/// #         drive motor: x = 0.1 [m/s]*t;
/// #     }
/// # }
///
/// let stroke = Travel {
///     along: Along::Drive("motor".into()),
///     samples: vec![0.0, 1.0, 2.0],
///     inputs: None, from: None, t: 0.0,
/// };
/// for position in travel(&Press::declared(), &stroke)? {
///     assert!((position.travel - 0.1 * position.t).abs() < 1e-12);
///     assert!((position.effort - 500.0 * position.travel).abs() < 1e-9);
/// }
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Along {
    /// A coordinate, by a force or a torque along it.
    Coordinate(String),
    /// A declared drive, over the time of its law.
    Drive(String),
}

/// A slow motion. See the example of [`travel`].
#[derive(Clone, Debug, PartialEq)]
pub struct Travel {
    /// The coordinate or the drive that is moved.
    pub along: Along,
    /// The positions of the coordinate in m or rad, or the times of a drive in s, in their order.
    pub samples: Vec<f64>,
    /// The inputs; `None` for their defaults.
    pub inputs: Option<Vec<f64>>,
    /// The positions from which the mechanism is led to the first sample, which decide on the branch;
    /// `None` for the declared start.
    pub from: Option<Vec<f64>>,
    /// The time of these positions in s, at which drives and forces are held where a coordinate is moved.
    pub t: f64,
}

/// A position of a slow motion, and what holds it there. See the example of [`travel`].
#[derive(Clone, Debug, PartialEq)]
pub struct Position {
    /// The time in s at which drives and forces are held.
    pub t: f64,
    /// The coordinate in m or rad; how far a drive has moved its left side since the first sample.
    pub travel: f64,
    /// The force or torque along the coordinate, or that of the drive, −λ: positive where it pushes
    /// towards larger values.
    pub effort: f64,
    /// Positions.
    pub q: Vec<f64>,
    /// λ
    pub multipliers: Vec<f64>,
    /// The declared outputs.
    pub outputs: Vec<f64>,
    /// dq/dx: the way of each coordinate for a unit of what is moved. `None` for a mechanism with further degrees of
    /// freedom.
    pub ratios: Option<Vec<f64>>,
}

/// Newton's steps to an equilibrium of the coordinates that are not led.
const ITERATIONS: usize = 60;
/// None of them is longer than this share of a scale.
const LONGEST: f64 = 0.1;
/// The last one is shorter than this.
const SMALL: f64 = 1e-11;
/// A stiffness below this share of the largest one holds nothing.
const SOFT: f64 = 1e-9;
/// A ratio below this, in scales, is that of a dead centre.
const DEAD: f64 = 1e-12;

impl Position {
    /// The mechanical advantage at a coordinate, by virtual work: F_out/F_in = dx_in/dx_out. F_in is the effort, and
    /// F_out the force or torque along the coordinate that balances it. The advantage is positive where the mechanism
    /// pushes its load towards larger values, and infinite at a dead centre of the coordinate. It is `None` for a
    /// mechanism with further degrees of freedom.
    ///
    /// Springs and weights take part in the effort, not in the advantage: it is what the geometry gives.
    ///
    /// # Example
    /// A wedge lifts a load of 8 kg by a quarter of its own way, y = x/4:
    /// ```
    /// use mbs_analysis::{Along, Travel, travel};
    /// # use mbs_runtime::mechanism;
    /// # mechanism! {
    /// #     /// A wedge lifts a load by a quarter of its own way.
    /// #     pub Wedge {
    /// #         dof = 1;
    /// #         gravity = (0, -9.81) [m/s^2];
    /// #         body slide (x) { mass = 1 [kg]; }
    /// #         body load (y) { mass = 8 [kg]; }
    /// #         constraint slope: y = 0.25*x;
    /// #     }
    /// # }
    ///
    /// let push = Travel {
    ///     along: Along::Coordinate("x".into()),
    ///     samples: vec![0.0, 0.1],
    ///     inputs: None, from: None, t: 0.0,
    /// };
    /// for position in travel(&Wedge::declared(), &push)? {
    ///     assert!(position.advantage(1).is_some_and(|advantage| (advantage - 4.0).abs() < 1e-12));
    ///     assert!((position.effort - 8.0 * 9.81 / 4.0).abs() < 1e-9);
    /// }
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    pub fn advantage(&self, coordinate: usize) -> Option<f64> {
        let ratios = self.ratios.as_ref()?;
        let largest = ratios.iter().fold(0.0_f64, |largest, ratio| largest.max(ratio.abs()));
        let ratio = *ratios.get(coordinate)?;
        Some(if ratio.abs() <= DEAD * largest { f64::INFINITY } else { 1.0 / ratio })
    }
}

/// Effort over travel: the forces that hold a mechanism at rest at every position of a slow motion.
///
/// ```text
/// Φ(q, t) = 0,  q_x = x
/// Φ_qᵀλ = Q(q, 0, t, u) + 1_x F        F along a coordinate, −λ of a drive
/// ```
///
/// All velocities and accelerations are 0: springs, gravity and inputs act, dampers and drag do not, and
/// dry friction, which is smooth here, is 0 at rest. So the curve is that of a mechanism without friction,
/// the same in both directions. For conservative forces it is F = dV/dx.
///
/// A mechanism with further degrees of freedom keeps its other coordinates in the equilibrium that
/// continues the one before; where that is stable no longer, it snaps through, which is an error.
///
/// Positions are followed as [`inverse`](crate::inverse) follows them.
///
/// # Errors
/// [`Error::Unknown`], [`Error::NoDrive`], [`Error::Length`], [`Error::Samples`] of what is asked, and
/// [`Error::Prescribed`] for a coordinate of a mechanism without degrees of freedom;
/// [`Error::Unreachable`], [`Error::Snap`], [`Error::Undefined`] of the motion.
///
/// # Example
/// ```
/// use mbs_analysis::{Along, Travel, travel};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     /// A lid with a coil spring in its hinge.
///     pub Lid {
///         dof = 1;
///         gravity = (0, -9.81) [m/s^2];
///         body lid (x, y, phi) { mass = 3 [kg]; inertia = 0.04 [kg*m^2]; }
///         point hinge on lid = (-0.2, 0) [m];
///         revolute pivot (lid.hinge, ground);
///         torsion_spring coil (lid, ground) { stiffness = 2 [N*m]; angle = 180 [deg]; }
///         start { phi = 0; guess x = 0.2 [m]; }
///     }
/// }
///
/// let lift = Travel {
///     along: Along::Coordinate("phi".into()),
///     samples: vec![0.0, 0.5, 1.0],
///     inputs: None, from: None, t: 0.0,
/// };
/// for position in travel(&Lid::declared(), &lift)? {
///     let phi = position.travel;
///     let expected = 3.0 * 9.81 * 0.2 * phi.cos() + 2.0 * (phi - std::f64::consts::PI);
///     assert!((position.effort - expected).abs() < 1e-10);
/// }
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
///
/// # Source
/// J. E. Shigley, J. J. Uicker, Theory of Machines and Mechanisms, McGraw-Hill 1980, sections 2-9 and 11-13.
pub fn travel(mechanism: &dyn Equations<f64>, request: &Travel) -> Result<Vec<Position>, Error> {
    let info = mechanism.info();
    Error::refuse_rates(info, "a slow motion")?;
    Error::refuse_states(info, "a slow motion")?;
    info.refuse_clocks("a slow motion")?;
    info.refuse_stops("a slow motion")?;
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
    if request.samples.iter().any(|x| !x.is_finite()) {
        return Err(Error::Samples { reason: "one is no finite number" });
    }
    let lead = Lead::of(mechanism, &request.along)?;
    let places = lead.places(mechanism, (request.t, &inputs, &from))?;
    let mut guided = Guided::new(mechanism, places, Drives::Held, (request.t, &from))?;
    let mut first = None;
    let mut positions = Vec::with_capacity(request.samples.len());
    for (at, sample) in request.samples.iter().enumerate() {
        let (t, z) = lead.target(&guided, *sample);
        guided.follow(t, &z, at + 1)?;
        let others = Others { led: lead.led(), inputs: &inputs };
        others.settle(&mut guided, at + 1)?;
        let still = DVector::zeros(guided.q.len());
        let forces = guided.forces(&still, &DVector::zeros(guided.places.len()), &inputs)?;
        let first = *first.get_or_insert(guided.t);
        positions.push(lead.position(&guided, first, &inputs, &forces));
    }
    Ok(positions)
}

/// The coordinate or the drive that is moved, by its position among the coordinates or the constraints.
#[derive(Clone, Copy)]
enum Lead {
    Coordinate(usize),
    Drive(usize),
}

impl Lead {
    fn of(mechanism: &dyn Equations<f64>, along: &Along) -> Result<Self, Error> {
        let info = mechanism.info();
        match along {
            Along::Coordinate(name) => {
                let found = Signal::coordinates(info, std::slice::from_ref(name))?;
                match found.first().map(|signal| signal.variable) {
                    Some(Variable::Coordinate(at)) if info.dof > 0 => Ok(Self::Coordinate(at)),
                    _ => Err(Error::Prescribed { coordinates: vec![name.clone()], dof: info.dof }),
                }
            }
            Along::Drive(name) => {
                let found = info.constraints.iter().position(|row| row.name == *name && row.is_drive);
                found.map(Self::Drive).ok_or_else(|| Error::NoDrive { name: name.clone() })
            }
        }
    }

    /// How many of the prescribed coordinates are led; the others rest.
    fn led(self) -> usize {
        match self {
            Self::Coordinate(_) => 1,
            Self::Drive(_) => 0,
        }
    }

    /// The led coordinate, and others that determine the position with it.
    fn places(
        self,
        mechanism: &dyn Equations<f64>,
        (t, inputs, from): (f64, &[f64], &[f64]),
    ) -> Result<Vec<usize>, Error> {
        let mut places = match self {
            Self::Coordinate(at) => vec![at],
            Self::Drive(_) => Vec::new(),
        };
        let rest = Rest::new(mechanism, t, inputs, from);
        let mut q = DVector::from_column_slice(from);
        rest.assemble(&mut q)?;
        places.extend(beside(&rest, &q, &places));
        Ok(places)
    }

    /// Where a sample leads, with the coordinates that are not led as they are.
    fn target(self, guided: &Guided<'_>, sample: f64) -> (f64, DVector<f64>) {
        let mut z = guided.prescribed();
        match self {
            Self::Coordinate(_) => {
                z[0] = sample;
                (guided.t, z)
            }
            Self::Drive(_) => (sample, z),
        }
    }

    fn position(self, guided: &Guided<'_>, first: f64, inputs: &[f64], forces: &Forces) -> Position {
        let still = DVector::zeros(guided.q.len());
        let (n, m) = (guided.q.len(), forces.multipliers.len());
        let (travel, effort, direction) = match self {
            Self::Coordinate(at) => {
                let unit = DVector::from_fn(guided.places.len(), |at, _| f64::from(u8::from(at == 0)));
                (guided.q[at], forces.efforts[0], guided.jacobian.solve(&DVector::zeros(m), &unit))
            }
            Self::Drive(row) => {
                let moved =
                    guided.violation(first, &guided.q)[row] - guided.violation(guided.t, &guided.q)[row];
                let unit = DVector::from_fn(m, |at, _| f64::from(u8::from(at == row)));
                let held = DVector::zeros(guided.places.len());
                (moved, -forces.multipliers[row], guided.jacobian.solve(&unit, &held))
            }
        };
        let is_alone = guided.places.len() == self.led();
        let Instant { t, q, multipliers, outputs, .. } = Instant::of(guided, &still, inputs.to_vec(), forces);
        let ratios = (is_alone && direction.len() == n).then(|| direction.as_slice().to_vec());
        Position { t, travel, effort, q, multipliers, outputs, ratios }
    }
}

/// The prescribed coordinates that are not led, w, which rest where no force along them is needed.
struct Others<'a> {
    led: usize,
    inputs: &'a [f64],
}

impl Others<'_> {
    /// Newton's method on τ_w(w) = 0, in steps of a bounded length.
    fn settle(&self, guided: &mut Guided<'_>, sample: usize) -> Result<(), Error> {
        if guided.places.len() == self.led {
            return Ok(());
        }
        for _ in 0..ITERATIONS {
            let efforts = self.efforts(guided, guided.prescribed())?;
            let Some(stiffness) = self.stiffness(guided) else { break };
            let Some(step) = stiffness.lu().solve(&-efforts) else { break };
            let scales = guided.scales.select_rows(&guided.places);
            let length = step.component_div(&scales.rows(self.led, step.len())).amax();
            if !length.is_finite() {
                break;
            }
            let mut z = guided.prescribed();
            let mut others = z.rows_mut(self.led, step.len());
            others += step * (LONGEST / length).min(1.0);
            guided.follow(guided.t, &z, sample)?;
            if length < SMALL {
                return Ok(());
            }
        }
        let names =
            guided.places.iter().skip(self.led).filter_map(|at| guided.mechanism.info().coordinates.get(*at));
        let coordinates = names.map(|q| q.name.to_owned()).collect();
        Err(Error::Snap { sample, coordinates, place: guided.place() })
    }

    /// τ_w where the prescribed coordinates are led to, or no numbers where they cannot be.
    fn efforts(&self, guided: &Guided<'_>, z: DVector<f64>) -> Result<DVector<f64>, Error> {
        let mut there = guided.clone();
        let others = z.len() - self.led;
        if there.follow(guided.t, &z, 0).is_err() {
            return Ok(DVector::from_element(others, f64::NAN));
        }
        let still = DVector::zeros(there.q.len());
        let forces = there.forces(&still, &DVector::zeros(z.len()), self.inputs)?;
        Ok(forces.efforts.rows(self.led, others).clone_owned())
    }

    /// ∂τ_w/∂w, if it holds them: its symmetric part is positive.
    fn stiffness(&self, guided: &Guided<'_>) -> Option<DMatrix<f64>> {
        let z = guided.prescribed();
        let scales = guided.scales.select_rows(&guided.places);
        let others = z.len() - self.led;
        let mut stiffness = DMatrix::zeros(others, others);
        for column in 0..others {
            let there = |change: f64| {
                let mut moved = z.clone();
                moved[self.led + column] += change;
                self.efforts(guided, moved).unwrap_or_else(|_| DVector::from_element(others, f64::NAN))
            };
            stiffness.set_column(column, &five_point(there, scales[self.led + column]));
        }
        let scaled = DMatrix::from_fn(others, others, |row, column| {
            let sizes = scales[self.led + row] * scales[self.led + column];
            0.5 * (stiffness[(row, column)] + stiffness[(column, row)]) * sizes
        });
        if scaled.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let values = scaled.symmetric_eigenvalues();
        (values.min() > SOFT * values.amax()).then_some(stiffness)
    }
}
