//! The linear system of small motions about an operating point.
//!
//! A, B, C and D are made of derivatives along directions of positions, velocities, inputs and parameters
//! (`derivative`). `chart` chooses the declared coordinates that are states.

use mbs_runtime::equations::Equations;
use nalgebra::{DMatrix, DVector};

use crate::chart::Chart;
use crate::derivative::{Derivatives, Direction, Values, size_of_state};
use crate::family::{Family, Varied};
use crate::resting::Resting;
use crate::stops::{not_by_parameters, rows_at};
use crate::{Error, OperatingPoint, Signal, Variable};

/// A rate in 1/s that is slower than any mechanism.
const SLOW: f64 = 1e-3;

/// The states, inputs and outputs of a linear system.
///
/// # Example
/// A weight of 2 kg hangs on a spring of k = 200 N/m:
/// ```
/// use mbs_analysis::{OperatingPoint, Ports, Search, equilibrium, linearize, of_type};
/// # use mbs_runtime::mechanism;
/// # mechanism! {
/// #     /// A weight that hangs on a spring.
/// #     pub Weight {
/// #         dof = 1;
/// #         param k = 200 [N/m];
/// #         gravity = (0, -9.81) [m/s^2];
/// #         body weight (y) { mass = 2 [kg]; }
/// #         force spring on y = -k*y;
/// #     }
/// # }
///
/// let rest = equilibrium(&Weight::declared(), &Search::default())?;
/// let family = of_type::<Weight>();
/// let ports = Ports {
///     outputs: Some(vec!["der(y)".into()]),
///     parameters: vec!["k".into()],
///     family: Some(&family),
///     ..Ports::default()
/// };
/// let linear = linearize(&Weight::declared(), &OperatingPoint::from(&rest), &ports)?;
/// assert_eq!((linear.inputs[0].name.as_str(), linear.outputs[0].name.as_str()), ("k", "der(y)"));
/// // ∂ÿ/∂k = −y/m at y = −m g/k
/// assert!((linear.b[(1, 0)] - 9.81 / 200.0).abs() < 1e-9);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Ports<'a> {
    /// The coordinates that are states, as many as there are degrees of freedom; `None` for those
    /// that move most, angles before lengths.
    pub states: Option<Vec<String>>,
    /// The inputs; `None` for all.
    pub inputs: Option<Vec<String>>,
    /// Declared outputs, coordinates `x`, their rates `der(x)` and multipliers `lambda(row)`; `None`
    /// for all declared outputs that have a value and derivatives at the point, or for the coordinates of a
    /// mechanism that declares none.
    pub outputs: Option<Vec<String>>,
    /// Parameters that are inputs too, after the others.
    pub parameters: Vec<String>,
    /// The mechanisms with other parameters; needed if `parameters` has names.
    pub family: Option<&'a dyn Family>,
}

/// ẋ = A x + B u, y = C x + D u, of deviations from an operating point.
///
/// With f degrees of freedom and k own states s, x = (δz, δż, δs) has 2f + k components: f declared coordinates z
/// that determine the others, their rates, and the own states. Everything is in SI units and rad. See the example of [`linearize`].
#[derive(Clone, Debug, PartialEq)]
pub struct Linearization {
    /// The operating point.
    pub point: OperatingPoint,
    /// x, 2f + k.
    pub states: Vec<Signal>,
    /// u
    pub inputs: Vec<Signal>,
    /// y
    pub outputs: Vec<Signal>,
    /// Declared outputs that are left out of y, since they have no value or no derivative at the point, as
    /// der(y)/der(x) has none at rest. An output that [`Ports::outputs`] names is an error instead.
    pub left_out: Vec<Signal>,
    /// A, square: [0 1 0; ∂z̈/∂z ∂z̈/∂ż ∂z̈/∂s; ∂ṡ/∂z ∂ṡ/∂ż ∂ṡ/∂s].
    pub a: DMatrix<f64>,
    /// B
    pub b: DMatrix<f64>,
    /// C
    pub c: DMatrix<f64>,
    /// D
    pub d: DMatrix<f64>,
    /// ẋ at the operating point, which deviations add to: 0 at an equilibrium.
    pub rate: DVector<f64>,
    /// y at the operating point.
    pub values: DVector<f64>,
    /// N, n × f: all coordinates move by δq = N δz.
    pub directions: DMatrix<f64>,
    /// M_r = NᵀMN, f × f: the mass of the minimal coordinates.
    pub mass: DMatrix<f64>,
    /// 1 rad or the size of the mechanism in m, for each of the coordinates.
    pub scales: DVector<f64>,
    /// The estimated error of ∂z̈/∂z and ∂z̈/∂ż, as a share of their largest entry, coordinates
    /// measured by their scales. About 10⁻¹² of smooth accelerations, more where friction changes
    /// its sign, and of the order of 1 at a stop.
    pub uncertainty: f64,
}

/// The linear system about an operating point.
///
/// On Φ(q, t) = 0 the position follows from f independent coordinates z = q_I, and the velocity from
/// z and ż:
///
/// ```text
/// δq = N δz              Φ_q N = 0, N_I = 1
/// δv = N δż + V δz       Φ_q V = −(Φ_q v + Φ_t)_q N, V_I = 0
/// δz̈ = (q̈_q N + q̈_v V)_I δz + (q̈_v N)_I δż + (q̈_u)_I δu
/// ```
///
/// V is how velocities turn with the manifold, and vanishes at rest. Outputs are differentiated in
/// the same way, with q̈ and λ that follow the state. A parameter that is an input moves the other
/// coordinates too, because the manifold changes: Φ_q δq = −Φ_p with δq_I = 0, and Φ̇ alike.
///
/// Derivatives along these directions are differences, extrapolated to ten digits or more of smooth
/// functions; [`uncertainty`](Linearization::uncertainty) says what is known.
///
/// # Errors
/// [`Error::NoFreedom`]; [`Error::Length`] and [`Error::OffConstraints`] of the point;
/// [`Error::Unknown`], [`Error::Dependent`] and [`Error::NoFamily`] of the ports;
/// [`Error::Undefined`] where the accelerations at the point are no numbers, and [`Error::Slope`] where a
/// derivative of them, or an output that the ports name, is none.
///
/// # Example
/// ```
/// use mbs_analysis::{OperatingPoint, Ports, linearize};
/// use mbs_runtime::mechanism;
///
/// mechanism! {
///     pub Oscillator {
///         dof = 1;
///         input push [N];
///         body block (x) { mass = 2 [kg]; }
///         force all on x = push - 200 [N/m]*x - 4 [N*s/m]*der(x);
///         output position [m] = x;
///     }
/// }
///
/// let point = OperatingPoint::at_rest(0.0, &[0.0], &[0.0]);
/// let linear = linearize(&Oscillator::declared(), &point, &Ports::default())?;
/// assert_eq!((linear.dof(), linear.states[1].name.as_str()), (1, "der(x)"));
/// assert!((linear.a[(1, 0)] + 100.0).abs() < 1e-9 && (linear.a[(1, 1)] + 2.0).abs() < 1e-9);
/// assert!((linear.b[(1, 0)] - 0.5).abs() < 1e-12 && linear.c[(0, 0)] == 1.0);
/// # Ok::<(), mbs_analysis::Error>(())
/// ```
///
/// # Source
/// D. Negrut, J. L. Ortiz, A practical approach for the linearization of the constrained multibody
/// dynamics equations, J. Comput. Nonlinear Dynam. 1 (2006) 230-239.
pub fn linearize(
    mechanism: &dyn Equations<f64>,
    point: &OperatingPoint,
    ports: &Ports<'_>,
) -> Result<Linearization, Error> {
    point.check(mechanism)?;
    let info = mechanism.info();
    info.refuse_sticking("a linear system")?;
    match rows_at(mechanism, point)?[..] {
        [] if info.stops.is_empty() || !ports.parameters.is_empty() => on_its_rows(mechanism, point, ports),
        [row, ..] if !ports.parameters.is_empty() => Err(not_by_parameters(info, row)),
        ref rows => on_its_rows(&Resting::new(mechanism, rows), point, ports),
    }
}

/// The same about a point at which no stop is closed, but for those among the rows.
pub(crate) fn on_its_rows(
    mechanism: &dyn Equations<f64>,
    point: &OperatingPoint,
    ports: &Ports<'_>,
) -> Result<Linearization, Error> {
    let info = mechanism.info();
    Error::refuse_rates(info, "a linearization")?;
    if info.dof <= 0 && info.lines == info.coordinates.len() {
        return Err(Error::NoFreedom { mechanism: info.name });
    }
    let mut inputs = Signal::inputs(info, ports.inputs.as_deref())?;
    inputs.extend(Signal::parameters(info, &ports.parameters)?);
    let outputs = Signal::outputs(info, ports.outputs.as_deref())?;
    let chart = Chart::new(mechanism, point, ports.states.as_deref())?;
    let mut parameters = vec![0.0; info.parameters.len()];
    mechanism.parameters(&mut parameters);
    let varied = match ports.family {
        Some(family) => Some(Varied { family, parameters: &parameters }),
        None if ports.parameters.is_empty() => None,
        None => return Err(Error::NoFamily { parameter: ports.parameters.concat() }),
    };
    let mut scales = chart.scales();
    for (at, state) in info.coordinates.iter().enumerate().skip(info.lines) {
        scales[at] = size_of_state(state, point.v[at]);
    }
    let derivatives = Derivatives { mechanism, point, varied, scales: scales.clone() };
    let here = derivatives.values();
    check_finite(info, &here)?;

    let system = Differentiated { derivatives, chart };
    let f = system.chart.independent.len();
    let of_states = system.columns(&system.of_states()?, &outputs)?;
    let of_inputs = system.columns(&system.of_inputs(&inputs)?, &outputs)?;
    let order = 2 * f + system.own().len();
    let mut a = DMatrix::zeros(order, order);
    a.view_mut((0, f), (f, f)).fill_with_identity();
    a.view_mut((f, 0), (order - f, order)).copy_from(&of_states.rates);
    let mut b = DMatrix::zeros(order, inputs.len());
    b.view_mut((f, 0), (order - f, inputs.len())).copy_from(&of_inputs.rates);
    let uncertainty = system.uncertainty(&of_states);
    let chart = &system.chart;
    let speed = chart.minimal(&DVector::from_column_slice(&point.v));
    let rate = speed.iter().chain(system.rates(&here.acceleration).iter()).copied().collect::<Vec<_>>();
    let independent = chart.independent.iter();
    let states = independent.clone().map(|&at| Variable::Coordinate(at));
    let states = states.chain(independent.copied().chain(system.own()).map(Variable::Velocity));
    let linear = Linearization {
        states: states.filter_map(|variable| Signal::of(info, variable)).collect(),
        values: DVector::from_iterator(outputs.len(), outputs.iter().map(|y| value(point, &here, y))),
        a,
        b,
        c: of_states.outputs,
        d: of_inputs.outputs,
        rate: DVector::from_vec(rate),
        uncertainty,
        directions: chart.directions.clone(),
        mass: chart.mass.clone(),
        scales,
        point: point.clone(),
        inputs,
        outputs,
        left_out: Vec::new(),
    };
    check_accelerations(&linear)?;
    linear.with_values(ports.outputs.is_some())
}

impl Linearization {
    /// f, the degrees of freedom. See the example of [`linearize`].
    pub fn dof(&self) -> usize {
        self.directions.ncols()
    }

    /// Without the outputs that have no value or no derivative; an error if they are asked for by name.
    fn with_values(mut self, is_named: bool) -> Result<Self, Error> {
        let has_value = |at: &usize| self.values[*at].is_finite() && is_finite([&self.c, &self.d], *at);
        let (kept, without): (Vec<usize>, Vec<usize>) = (0..self.outputs.len()).partition(has_value);
        let of =
            |rows: &[usize]| -> Vec<Signal> { rows.iter().map(|&at| self.outputs[at].clone()).collect() };
        let (outputs, left_out) = (of(&kept), of(&without));
        if let (Some(output), true) = (left_out.first(), is_named) {
            return Err(Error::Slope { of: format!("the output `{}`", output.name) });
        }
        self.c = self.c.select_rows(&kept);
        self.d = self.d.select_rows(&kept);
        self.values = self.values.select_rows(&kept);
        (self.outputs, self.left_out) = (outputs, left_out);
        Ok(self)
    }

    /// The scales of the coordinates that are states.
    pub(crate) fn scales_of_states(&self) -> impl Iterator<Item = f64> {
        let place = |state: &Signal| match state.variable {
            Variable::Coordinate(at) => self.scales.get(at).copied(),
            _ => None,
        };
        self.states.iter().filter_map(place)
    }
}

fn check_finite(info: &mbs_runtime::Info, here: &Values) -> Result<(), Error> {
    let at = here.acceleration.iter().position(|a| !a.is_finite());
    match at.and_then(|at| info.coordinates.get(at)) {
        Some(coordinate) => Err(Error::Undefined { coordinate: coordinate.name }),
        None => Ok(()),
    }
}

/// Refuses A or B with an entry that is no number.
fn check_accelerations(linear: &Linearization) -> Result<(), Error> {
    let f = linear.dof();
    let has_none = |at: &usize| !is_finite([&linear.a, &linear.b], *at);
    let Some(at) = (f..linear.a.nrows()).find(has_none) else { return Ok(()) };
    // the rows behind 2f are of own states, the others of accelerations
    let (what, state) = if at < 2 * f { ("acceleration", at - f) } else { ("rate", at) };
    let name = linear.states.get(state).map_or("", |state| state.name.as_str());
    Err(Error::Slope { of: format!("the {what} of `{name}`") })
}

fn is_finite(rows: [&DMatrix<f64>; 2], at: usize) -> bool {
    rows.iter().all(|matrix| matrix.row(at).iter().all(|x| x.is_finite()))
}

/// An output at the operating point.
fn value(point: &OperatingPoint, here: &Values, output: &Signal) -> f64 {
    match output.variable {
        Variable::Output(at) => here.outputs[at],
        Variable::Multiplier(at) => here.multipliers[at],
        state => point.value(state, &[]),
    }
}

struct Differentiated<'a> {
    derivatives: Derivatives<'a>,
    chart: Chart<'a>,
}

/// Derivatives along some directions, a column each.
struct Columns {
    /// Of z̈, and behind them of the rates of own states.
    rates: DMatrix<f64>,
    /// The estimated errors of these.
    errors: DMatrix<f64>,
    outputs: DMatrix<f64>,
}

impl Differentiated<'_> {
    fn of_states(&self) -> Result<Vec<Direction>, Error> {
        let none = Direction::none(self.derivatives.mechanism);
        let along = |at: usize| self.chart.directions.column(at).clone_owned();
        let f = self.chart.independent.len();
        let displaced = (0..f).map(|at| self.completed(Direction { q: along(at), ..none.clone() }));
        let faster = (0..f).map(|at| Ok(Direction { v: along(at), ..none.clone() }));
        let changed = self.own().map(|at| {
            let mut direction = none.clone();
            direction.v[at] = 1.0;
            Ok(direction)
        });
        displaced.chain(faster).chain(changed).collect()
    }

    /// The places of own states among the coordinates.
    fn own(&self) -> std::ops::Range<usize> {
        let info = self.derivatives.mechanism.info();
        info.lines..info.coordinates.len()
    }

    /// z̈ and the rates of own states, of all accelerations.
    fn rates(&self, acceleration: &DVector<f64>) -> DVector<f64> {
        let minimal = self.chart.minimal(acceleration);
        let own = self.own().map(|at| acceleration[at]);
        DVector::from_iterator(minimal.len() + self.own().len(), minimal.iter().copied().chain(own))
    }

    fn of_inputs(&self, inputs: &[Signal]) -> Result<Vec<Direction>, Error> {
        let direction = |input: &Signal| {
            let mut direction = Direction::none(self.derivatives.mechanism);
            match input.variable {
                Variable::Parameter(at) => {
                    direction.parameter = Some(at);
                    let [change, _] = self.derivatives.along(&direction)?;
                    direction.q = self.chart.carried(&change.phi);
                    self.completed(direction)
                }
                Variable::Input(at) => {
                    direction.inputs[at] = 1.0;
                    Ok(direction)
                }
                _ => Ok(direction),
            }
        };
        inputs.iter().map(direction).collect()
    }

    /// With the change of velocities that keeps them on the constraints, δv_I = 0.
    fn completed(&self, mut direction: Direction) -> Result<Direction, Error> {
        let [change, _] = self.derivatives.along(&direction)?;
        direction.v = self.chart.carried(&change.phi_dot);
        Ok(direction)
    }

    fn columns(&self, directions: &[Direction], outputs: &[Signal]) -> Result<Columns, Error> {
        let (rows, k) = (self.chart.independent.len() + self.own().len(), directions.len());
        let [mut rates, mut errors] = [(); 2].map(|()| DMatrix::zeros(rows, k));
        let mut of_outputs = DMatrix::zeros(outputs.len(), k);
        for (column, direction) in directions.iter().enumerate() {
            let [change, error] = self.derivatives.along(direction)?;
            rates.set_column(column, &self.rates(&change.acceleration));
            errors.set_column(column, &self.rates(&error.acceleration));
            for (row, output) in outputs.iter().enumerate() {
                of_outputs[(row, column)] = match output.variable {
                    Variable::Coordinate(at) => direction.q[at],
                    Variable::Velocity(at) => direction.v[at],
                    Variable::Output(at) => change.outputs[at],
                    Variable::Multiplier(at) => change.multipliers[at],
                    Variable::Input(_) | Variable::Parameter(_) => 0.0,
                };
            }
        }
        Ok(Columns { rates, errors, outputs: of_outputs })
    }

    fn uncertainty(&self, of_states: &Columns) -> f64 {
        let scales = self.chart.minimal(&self.chart.scales());
        let f = scales.len();
        let measured = |of: &DMatrix<f64>, first: usize| {
            let entry = |row: usize, column: usize| of[(row, first + column)] * scales[column] / scales[row];
            DMatrix::from_fn(f, f, entry).amax()
        };
        // what nothing drives back accelerates by rounding alone
        let stiffest = measured(&of_states.rates, 0).max(SLOW * SLOW);
        let fastest = measured(&of_states.rates, f).max(stiffest.sqrt());
        let share = |error: f64, size: f64| if error > 0.0 { error / size } else { 0.0 };
        share(measured(&of_states.errors, 0), stiffest).max(share(measured(&of_states.errors, f), fastest))
    }
}
