//! A mechanism as a system of first order, for solvers of ordinary differential equations.

use std::fmt;
use std::sync::Arc;

use mbs_runtime::equations::{At, Equations, PARTIALS, Partials};
use mbs_runtime::{Gains, Real, System};
use nalgebra::DMatrix;

use crate::{Error, InputTable};

/// A mechanism as ẏ = f(t, y), as crates that solve ordinary differential equations take it.
///
/// With the positions q and velocities v that are integrated
/// ([`Info::states`](mbs_runtime::Info::states)), one after the other,
///
/// ```text
/// y = (q, v),   f = (v, q̈(t, q, v)),   ∂f/∂y = [0 1; ∂q̈/∂q ∂q̈/∂v]
/// ```
///
/// in SI units and rad. q̈ solves Eq. (8) with the feedback Φ̈ = −2αΦ̇ − α²Φ, so that violations of
/// the constraints decay with e^(−αt) in place of growing; α is [`FEEDBACK`](Self::FEEDBACK). The Jacobian
/// is exact: it comes from the equations over duals, [`PARTIALS`] columns at once. The page
/// [`ode_crates`](crate::ode_crates) shows how a crate is given these functions.
///
/// A copy shares the mechanism.
///
/// # Example
/// ```
/// use mbs_analysis::FirstOrder;
/// use mbs_analysis::nalgebra::DMatrix;
/// use mbs_runtime::equations::Differentiated;
/// use mbs_runtime::{Simulation, mechanism};
///
/// mechanism! {
///     pub Oscillator {
///         dof = 1;
///         body mass (x) { mass = 2 [kg]; }
///         force spring on x = -8 [N/m]*x;
///         start { x = 1 [m]; der(x) = 3 [m/s]; }
///     }
/// }
///
/// let start = Simulation::new(Oscillator::declared(), 1e-3)?;
/// let system = FirstOrder::new(Differentiated(Oscillator::declared()))?;
/// let y = system.state(&start);
/// let mut slope = [0.0; 2];
/// system.derivative(0.0, &y, &mut slope);
/// assert_eq!((y, slope), (vec![1.0, 3.0], [3.0, -4.0]));
///
/// let mut jacobian = DMatrix::zeros(2, 2);
/// system.jacobian(0.0, &[1.0, 3.0], &mut jacobian);
/// assert_eq!(jacobian, DMatrix::from_row_slice(2, 2, &[0.0, 1.0, -4.0, 0.0]));
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone)]
pub struct FirstOrder {
    mechanism: Arc<dyn Equations<f64> + Send + Sync>,
    parameters: Vec<Partials>,
    inputs: Vec<f64>,
    table: Arc<InputTable>,
}

impl FirstOrder {
    /// The gain α of the feedback in 1/s. Between 10/s and 200/s it changes neither the steps of a
    /// solver nor the error of the motion by more than a few per cent.
    pub const FEEDBACK: f64 = 50.0;

    /// A mechanism whose equations can be had over duals: a type in
    /// [`Differentiated`](mbs_runtime::equations::Differentiated), or a text that `mbs-live` has compiled.
    /// Its inputs are at their defaults.
    ///
    /// # Errors
    /// [`Error::NoDerivatives`] for others.
    pub fn new(mechanism: impl Equations<f64> + Send + Sync + 'static) -> Result<Self, Error> {
        let info = mechanism.info();
        if !mechanism.is_differentiable() {
            return Err(Error::NoDerivatives { mechanism: info.name.to_owned() });
        }
        let inputs = info.inputs.iter().map(|input| input.default).collect();
        let mut parameters = vec![0.0; info.parameters.len()];
        mechanism.parameters(&mut parameters);
        let parameters = parameters.into_iter().map(Partials::constant).collect();
        Ok(Self { mechanism: Arc::new(mechanism), parameters, inputs, table: Arc::default() })
    }

    /// The same with inputs that change with time.
    ///
    /// # Example
    /// ```
    /// # use std::sync::Arc;
    /// # use mbs_analysis::{FirstOrder, InputTable};
    /// # use mbs_live::Text;
    /// # let text = "Cart {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body cart (x) { mass = 2 [kg]; }
    /// #     force pushed on x = push;
    /// # }";
    /// # let cart = Text::declaration("cart.mbs", text).compile()?;
    /// // 3 N/s on a cart of 2 kg
    /// let table = InputTable::new(vec![0.0, 2.0], vec![(0, vec![0.0, 6.0])])?;
    /// let system = FirstOrder::new(cart)?.driven_by(Arc::new(table));
    /// let mut slope = [0.0; 2];
    /// system.derivative(0.5, &[0.0, 1.0], &mut slope);
    /// assert_eq!(slope, [1.0, 3.0 * 0.5 / 2.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn driven_by(self, table: Arc<InputTable>) -> Self {
        Self { table, ..self }
    }

    /// The numbers of y: twice the coordinates that are integrated.
    pub fn dimension(&self) -> usize {
        2 * self.mechanism.info().states.len()
    }

    /// The inputs in SI units. f holds those constant that no table has.
    pub fn inputs(&self) -> &[f64] {
        &self.inputs
    }

    /// The inputs in SI units, to be changed. A solver that uses values of f from before has to start anew.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::FirstOrder;
    /// # use mbs_live::Text;
    /// # let text = "Cart {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body cart (x) { mass = 2 [kg]; }
    /// #     force pushed on x = push;
    /// # }";
    /// # let cart = Text::declaration("cart.mbs", text).compile()?;
    /// let mut system = FirstOrder::new(cart)?;
    /// assert_eq!(system.inputs(), [0.0]);
    /// system.inputs_mut()[0] = 6.0;
    /// let mut slope = [0.0; 2];
    /// system.derivative(0.0, &[0.0, 1.0], &mut slope);
    /// // 6 N on 2 kg
    /// assert_eq!(slope, [1.0, 3.0]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn inputs_mut(&mut self) -> &mut [f64] {
        &mut self.inputs
    }

    /// y of the present state of a run of the same mechanism, such as one that was just built and is
    /// at its consistent start. See the example of [`FirstOrder`].
    pub fn state(&self, run: &dyn System) -> Vec<f64> {
        let n = self.mechanism.info().coordinates.len();
        let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
        run.state(&mut q, &mut v);
        let mut y = vec![0.0; self.dimension()];
        let (states, rates) = y.split_at_mut(self.dimension() / 2);
        self.mechanism.states(&q, states);
        self.mechanism.states(&v, rates);
        y
    }

    /// All positions and velocities at `t` seconds, of y.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::FirstOrder;
    /// use mbs_live::Text;
    ///
    /// let text = "Bar {
    ///     dof = 1;
    ///     states = reduced;
    ///     body bar (x, y, phi) { mass = 4 [kg]; inertia = 0.03 [kg*m^2]; }
    ///     point end on bar = (-0.15, 0) [m];
    ///     revolute hinge (bar.end, ground);
    /// }";
    /// let system = FirstOrder::new(Text::declaration("bar.mbs", text).compile()?)?;
    /// assert_eq!(system.dimension(), 2);
    /// // the centre is 0.15 m from the hinge
    /// let [q, v] = system.completed(0.0, &[0.5, 2.0]);
    /// assert!((q[1] - 0.15 * f64::sin(0.5)).abs() < 1e-15);
    /// assert!((v[1] - 0.15 * f64::cos(0.5) * 2.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn completed(&self, t: f64, y: &[f64]) -> [Vec<f64>; 2] {
        let (q, v) = y.split_at(y.len() / 2);
        let n = self.mechanism.info().coordinates.len();
        let mut all = [(); 2].map(|()| vec![0.0; n]);
        let [q_all, v_all] = &mut all;
        self.mechanism.complete(At { t, q, v }, q_all, v_all);
        all
    }

    fn inputs_at(&self, t: f64) -> Vec<f64> {
        let mut inputs = self.inputs.clone();
        self.table.set(t, &mut inputs);
        inputs
    }

    /// Writes f(t, y). See the example of [`FirstOrder`]. At a position in which the mechanism is singular, and where a force is not
    /// defined, it is not finite or has no accuracy.
    pub fn derivative(&self, t: f64, y: &[f64], slope: &mut [f64]) {
        derivative(&*self.mechanism, t, y, &self.inputs_at(t), slope);
    }

    /// Writes ∂f/∂y, of as many rows and columns as the [dimension](Self::dimension).
    pub fn jacobian(&self, t: f64, y: &[f64], jacobian: &mut DMatrix<f64>) {
        jacobian.fill(f64::NAN);
        let constants = |numbers: &[f64]| numbers.iter().map(|x| Partials::constant(*x)).collect::<Vec<_>>();
        let (inputs, still) = (constants(&self.inputs_at(t)), constants(y));
        let mut slope = still.clone();
        let mut evaluate = |equations: &dyn Equations<Partials>| {
            for first in (0..y.len()).step_by(PARTIALS) {
                let mut along = still.clone();
                for (at, y) in along.iter_mut().skip(first).take(PARTIALS).enumerate() {
                    *y = Partials::variable(y.value, at);
                }
                derivative(equations, Partials::constant(t), &along, &inputs, &mut slope);
                for (at, mut column) in jacobian.column_iter_mut().skip(first).take(PARTIALS).enumerate() {
                    column.iter_mut().zip(&slope).for_each(|(entry, slope)| *entry = slope.partial(at));
                }
            }
        };
        // the parameters are those that it has, so that it does not refuse them
        let _ = self.mechanism.with_partials(&self.parameters, &mut evaluate);
    }
}

/// f over any scalar.
fn derivative<T: Real>(equations: &dyn Equations<T>, t: T, y: &[T], inputs: &[T], slope: &mut [T]) {
    let (q, v) = y.split_at(y.len() / 2);
    let (rates, accelerations) = slope.split_at_mut(slope.len() / 2);
    rates.iter_mut().zip(v).for_each(|(rate, v)| *rate = *v);
    let gain = FirstOrder::FEEDBACK;
    let gains =
        Gains { minus_two_alpha: T::from_f64(-2.0 * gain), minus_beta_squared: T::from_f64(-gain * gain) };
    let mut feedback = vec![T::ZERO; equations.info().constraints.len()];
    equations.stabilized(At { t, q, v }, inputs, &gains, accelerations, &mut feedback);
}

impl fmt::Debug for FirstOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = self.mechanism.info().name;
        f.debug_struct("FirstOrder")
            .field("mechanism", &name)
            .field("inputs", &self.inputs)
            .finish_non_exhaustive()
    }
}
