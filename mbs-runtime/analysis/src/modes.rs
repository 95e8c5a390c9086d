//! Natural frequencies, damping ratios and mode shapes.
//!
//! The pencil is λ²1 − λG − K in coordinates of unit mass. Directions without stiffness are taken out of it
//! first. Complex matrices are real ones of twice the size (`complex`), which spares compiling
//! decompositions twice.

use nalgebra::linalg::balancing::balance_parlett_reinsch;
use nalgebra::{Complex, DVector, Schur};

use crate::complex::null_vectors;
use crate::pencil::{DEFECT, Pencil, decades};
use crate::{Error, Linearization};

/// An eigenvalue is 0 that is this share of the fastest rate.
const STILL: f64 = 1e-9;
/// A real part is 0 that is this share of its eigenvalue.
const UNDAMPED: f64 = 1e-10;
/// A component of a shape is 0 that is this share of the largest one.
pub(crate) const SMALL: f64 = 1e-9;
/// Two eigenvalues are one that differ by this share: rounding ε parts a double one by √ε.
const DOUBLE: f64 = 1e-7;

/// The behaviour of a small displacement in the shape of a mode.
///
/// # Example
/// ```
/// use mbs_analysis::{OperatingPoint, Ports, linearize};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     /// A rod upright: φ̈ = 4 φ.
///     pub Upright {
///         dof = 1;
///         body rod (angle = phi) { inertia = 1 [kg*m^2]; }
///         torque weight on rod = 4 [N*m]*phi;
///     }
/// }
///
/// let top = OperatingPoint::at_rest(0.0, &[0.0], &[]);
/// let modes = linearize(&Upright::declared(), &top, &Ports::default())?.modes()?;
/// let falling: Vec<_> = modes.iter().filter(|mode| mode.behaviour.is_unstable()).collect();
/// assert!(falling.len() == 1 && (falling[0].eigenvalue.re - 2.0).abs() < 1e-9);
/// assert_eq!(falling[0].behaviour.words(), "unstable: grows without oscillating (divergence)");
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Behaviour {
    /// Nothing drives it back: λ = 0.
    RigidBody,
    /// It oscillates for ever: λ = ±iω.
    Undamped,
    /// It oscillates and dies away: Re λ < 0.
    Underdamped,
    /// It dies away without oscillating: λ < 0. A mode with more than critical damping is two of these.
    Overdamped,
    /// It oscillates and grows: Re λ > 0.
    Flutter,
    /// It grows without oscillating: λ > 0.
    Divergence,
}

impl Behaviour {
    /// The behaviour in words. See the example of [`Behaviour`].
    pub fn words(self) -> &'static str {
        match self {
            Self::RigidBody => "rigid-body mode: moves freely",
            Self::Undamped => "oscillates, undamped",
            Self::Underdamped => "oscillates, damped",
            Self::Overdamped => "decays without oscillating (overdamped)",
            Self::Flutter => "unstable: oscillates and grows (flutter)",
            Self::Divergence => "unstable: grows without oscillating (divergence)",
        }
    }

    /// True if displacements grow.
    pub fn is_unstable(self) -> bool {
        matches!(self, Self::Flutter | Self::Divergence)
    }
}

/// Motions δq = Re(φ e^{λt}) of a linear system: a pair of conjugate eigenvalues, or a real one.
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
/// // 2 kg on 200 N/m and 4 N s/m: λ² + 2 λ + 100 = 0
/// let modes = linear.modes()?;
/// let mode = &modes[0];
/// assert!((mode.natural_frequency() - 10.0).abs() < 1e-9);
/// assert!((mode.damped_frequency() - f64::sqrt(99.0)).abs() < 1e-9);
/// assert!(mode.damping_ratio().is_some_and(|ratio| (ratio - 0.1).abs() < 1e-9));
/// assert!((mode.time_constant() - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// λ in 1/s, with Im λ ≥ 0. A part that cannot be told from 0 is 0.
    pub eigenvalue: Complex<f64>,
    /// φ, a component for each coordinate and own state. That of the state that moves most is 1 rad or 1 m, where an
    /// angle of 1 rad counts as much as a length of the size of the mechanism.
    pub shape: DVector<Complex<f64>>,
    /// The behaviour of a displacement in this shape.
    pub behaviour: Behaviour,
    /// The right and left null vectors of λ²1 − λG − K, in the norm of the mass.
    pub(crate) vectors: [DVector<Complex<f64>>; 2],
}

impl Mode {
    /// ω = |λ| in rad/s: the frequency without damping.
    pub fn natural_frequency(&self) -> f64 {
        self.eigenvalue.norm()
    }

    /// ω_d = Im λ in rad/s: the frequency at which it oscillates.
    pub fn damped_frequency(&self) -> f64 {
        self.eigenvalue.im
    }

    /// ζ = −Re λ/|λ|: 0 without damping, 1 for what decays without oscillating, negative for what grows;
    /// `None` for a rigid-body mode.
    pub fn damping_ratio(&self) -> Option<f64> {
        // 0 and not −0
        let ratio = 0.0 - self.eigenvalue.re / self.eigenvalue.norm();
        (self.behaviour != Behaviour::RigidBody).then_some(ratio)
    }

    /// 1/|Re λ| in s: the time in which it decays to 1/e, or grows by e.
    pub fn time_constant(&self) -> f64 {
        1.0 / self.eigenvalue.re.abs()
    }
}

impl Linearization {
    /// The modes, rigid-body modes first and the others with ascending natural frequencies.
    ///
    /// λ is a root of det(λ²1 − λG − K) with K = ∂z̈/∂z and G = ∂z̈/∂ż, and φ = N z with
    /// (λ²1 − λG − K) z = 0, computed in coordinates in which the mass is 1. Directions without
    /// stiffness are taken out first, because rounding would part their double eigenvalue 0; what
    /// damps their velocity is a mode of its own. Equal eigenvalues have shapes that are independent of
    /// each other, any combination of which is one.
    ///
    /// # Errors
    /// [`Error::Eigenvalues`] if the QR algorithm does not converge.
    ///
    /// # Example
    /// Two blocks of 1 kg between three springs of 100 N/m:
    /// ```
    /// use mbs_analysis::{OperatingPoint, Ports, linearize};
    /// # use mbs_runtime::mechanism;
    /// # mechanism! {
    /// #     /// Two blocks between three springs.
    /// #     pub Blocks {
    /// #         dof = 2;
    /// #         body first (x1) { mass = 1 [kg]; }
    /// #         body second (x2) { mass = 1 [kg]; }
    /// #         force on_first on x1 = -100 [N/m]*(2*x1 - x2);
    /// #         force on_second on x2 = -100 [N/m]*(2*x2 - x1);
    /// #     }
    /// # }
    ///
    /// let point = OperatingPoint::at_rest(0.0, &[0.0, 0.0], &[]);
    /// let modes = linearize(&Blocks::declared(), &point, &Ports::default())?.modes()?;
    /// // together at √(k/m), against each other at √(3 k/m)
    /// for (mode, [omega, second]) in modes.iter().zip([[10.0, 1.0], [f64::sqrt(300.0), -1.0]]) {
    ///     assert!((mode.natural_frequency() - omega).abs() < 1e-8);
    ///     assert!((mode.shape[1].re / mode.shape[0].re - second).abs() < 1e-8);
    /// }
    /// # Ok::<(), mbs_analysis::Error>(())
    /// ```
    ///
    /// # Source
    /// F. Tisseur, K. Meerbergen, The quadratic eigenvalue problem, SIAM Rev. 43 (2001) 235-286.
    pub fn modes(&self) -> Result<Vec<Mode>, Error> {
        if self.a.nrows() > 2 * self.dof() {
            return self.modes_with_states();
        }
        let pencil = Pencil::of(self);
        let (free, held) = pencil.free_and_held(self.uncertainty);
        let mut modes: Vec<Mode> = free
            .column_iter()
            .map(|y| pencil.mode(self, Complex::from(0.0), &complex(&y.clone_owned())))
            .collect();
        let mut roots = pencil.roots(&free, &held)?;
        // the velocity of a free direction is 0 too, unless something damps it
        for _ in 0..free.ncols() {
            if roots.first().is_some_and(|root| root.norm() <= STILL) {
                roots.remove(0);
            }
        }
        while let Some(root) = roots.first().copied() {
            let is_same = |other: &&Complex<f64>| (**other - root).norm() <= DOUBLE * root.norm();
            let equal: Vec<_> = roots.drain(..roots.iter().take_while(is_same).count().max(1)).collect();
            modes.extend(pencil.modes(self, &equal));
        }
        Ok(modes)
    }

    /// The damped frequencies Im λ in rad/s of modes that oscillate, ascending.
    ///
    /// # Errors
    /// As [`modes`](Self::modes).
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
    /// // 2 kg on 200 N/m and 4 N s/m: λ² + 2 λ + 100 = 0
    /// let resonances = linear.resonances()?;
    /// assert!(resonances.len() == 1 && (resonances[0] - f64::sqrt(99.0)).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn resonances(&self) -> Result<Vec<f64>, Error> {
        let modes = self.modes()?;
        let oscillates = modes.iter().map(Mode::damped_frequency).filter(|omega| *omega > 0.0);
        let mut found: Vec<f64> = oscillates.collect();
        found.sort_by(f64::total_cmp);
        Ok(found)
    }
}

impl Linearization {
    /// The modes of a mechanism with own states: eigenvalues of A as it stands, balanced, and shapes from the
    /// [`pencil`](Self::pencil).
    fn modes_with_states(&self) -> Result<Vec<Mode>, Error> {
        const ITERATIONS: usize = 10_000;
        // by a power of two, since squares of large entries are beyond all numbers, and balancing then never ends
        let largest = self.a.amax();
        let scale = if largest.is_normal() { largest.log2().floor().exp2() } else { 1.0 };
        let mut system = &self.a / scale;
        let _ = balance_parlett_reinsch(&mut system);
        let schur = Schur::try_new(system.clone(), f64::EPSILON, ITERATIONS);
        let Some(schur) = schur else { return Err(Error::Eigenvalues { decades: decades(&system) }) };
        let eigenvalues = schur.complex_eigenvalues() * Complex::from(scale);
        let fastest = eigenvalues.iter().map(|root| root.norm()).fold(0.0, f64::max);
        let rate = if fastest > 0.0 { fastest } else { 1.0 };
        let of_rest = |root: Complex<f64>| if root.norm() <= STILL { Complex::from(0.0) } else { root };
        let roots = eigenvalues.iter().map(|root| of_rest(known(&(root / rate))));
        let mut roots: Vec<Complex<f64>> = roots.filter(|root| root.im >= 0.0).collect();
        roots.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        // the next shape of an eigenvalue that has been there before, of as many as there are
        let equal = |of: &[Complex<f64>], at: usize| of.iter().filter(|root| **root == roots[at]).count();
        Ok(roots
            .iter()
            .enumerate()
            .map(|(at, root)| {
                self.mode_with_states(*root, rate, [equal(&roots[..at], at), equal(&roots, at)])
            })
            .collect())
    }

    /// The mode of an eigenvalue by its place among so many that are equal.
    fn mode_with_states(&self, root: Complex<f64>, rate: f64, [number, of]: [usize; 2]) -> Mode {
        let (f, eigenvalue) = (self.dof(), root * rate);
        let pencil = self.pencil(eigenvalue);
        let small = DEFECT * pencil.iter().map(|x| x.norm()).fold(0.0, f64::max);
        let [right, left] = null_vectors(&pencil, of, small);
        let none = || DVector::zeros(self.a.nrows() - f);
        // one that is defective has a single shape
        let one = |vectors: Vec<DVector<Complex<f64>>>| {
            vectors.get(number).or(vectors.last()).cloned().unwrap_or_else(none)
        };
        let [right, left] = [right, left].map(one);
        let (z, states) = (right.rows(0, f).clone_owned(), right.rows(f, right.len() - f).clone_owned());
        let all = self.directions.map(Complex::from) * z;
        let lines = all.len() - states.len();
        let shape =
            DVector::from_fn(all.len(), |at, _| if at < lines { all[at] } else { states[at - lines] });
        let sizes: Vec<f64> = shape.iter().zip(&self.scales).map(|(x, scale)| x.norm() / scale).collect();
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        // a coordinate that moves is 1; of a mode of own states alone, the largest of these
        let moves = |at: &usize| sizes[*at] > SMALL * largest;
        let first = (0..lines).filter(moves).max_by(|a, b| sizes[*a].total_cmp(&sizes[*b]));
        let first = first.or_else(|| (lines..sizes.len()).find(|at| sizes[*at] >= largest));
        let unit = first.map_or(Complex::from(1.0), |at| shape[at]);
        let unit = if unit.norm() > 0.0 { unit } else { Complex::from(1.0) };
        let shape = DVector::from_fn(shape.len(), |at, _| {
            let known = |x: f64| if x.abs() > SMALL * largest * self.scales[at] { x } else { 0.0 };
            let share = Complex::new(known(shape[at].re), known(shape[at].im)) / unit;
            // what does not oscillate moves in phase, and so does what is off it by rounding
            if root.im == 0.0 || share.im.abs() <= SMALL * share.norm() {
                Complex::from(share.re)
            } else {
                share
            }
        });
        Mode { eigenvalue, shape, behaviour: behaviour(root), vectors: [right, left] }
    }
}

/// An eigenvalue without the parts that rounding gave it.
pub(crate) fn known(root: &Complex<f64>) -> Complex<f64> {
    let size = root.norm();
    let re = if root.re.abs() <= UNDAMPED * size { 0.0 } else { root.re };
    let im = if root.im.abs() <= DOUBLE * size { 0.0 } else { root.im };
    Complex::new(re, im)
}

/// The behaviour that an eigenvalue tells.
pub(crate) fn behaviour(root: Complex<f64>) -> Behaviour {
    match (root.re, root.im) {
        _ if root.norm() <= STILL => Behaviour::RigidBody,
        (re, im) if im > 0.0 && re == 0.0 => Behaviour::Undamped,
        (re, im) if im > 0.0 && re < 0.0 => Behaviour::Underdamped,
        (_, im) if im > 0.0 => Behaviour::Flutter,
        (re, _) if re < 0.0 => Behaviour::Overdamped,
        _ => Behaviour::Divergence,
    }
}

fn complex(real: &DVector<f64>) -> DVector<Complex<f64>> {
    real.map(Complex::from)
}
