//! A mechanism whose inputs are functions of time.
//!
//! Every stage, output and event sees the inputs of its own time. Runs to a tolerance step onto the corners
//! of the table.

use std::sync::Arc;

use mbs_runtime::equations::{At, Equations, Partials, Room};
use mbs_runtime::explicit::Beside;
use mbs_runtime::{Derivation, Dynamics, Error, Gains, Info, Real, Scheme, Sketch, Switch};

use crate::InputTable;

/// A mechanism with inputs from a table. Accelerations, reactions and outputs at a time are those with the inputs
/// that the table has at that time. So every stage of every method sees the inputs of its own time, and a step to a
/// tolerance ends where the lines of the table have corners.
///
/// # Example
/// A cart of 2 kg, pushed by a force that rises to 3 N within 2 s, has moved by ∫∫ 3 t/4 dt² = 1 m then:
/// ```
/// use std::sync::Arc;
///
/// use mbs_analysis::{Driven, InputTable};
/// use mbs_live::{Prepared, Text};
/// use mbs_runtime::{Adaptive, Sampled, System};
///
/// let text = "Cart {
///     dof = 1;
///     input push [N];
///     body cart (x) { mass = 2 [kg]; }
///     force pushed on x = push;
///     start { x = 0; }
/// }";
/// let cart = Text::declaration("cart.mbs", text).compile()?;
/// let table = InputTable::new(vec![0.0, 2.0], vec![(0, vec![0.0, 3.0])])?;
/// let run = Adaptive::builder(Driven::new(Prepared::new(&cart), Arc::new(table))).build()?;
/// // one sample, after 2 s
/// let mut run = Sampled::new(run, 2.0)?;
/// run.step()?;
/// let (mut x, mut v) = ([0.0], [0.0]);
/// run.state(&mut x, &mut v);
/// assert!((x[0] - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Driven<D> {
    dynamics: D,
    table: Arc<InputTable>,
    start_time: Option<f64>,
}

impl<D: Dynamics> Driven<D> {
    /// A mechanism with the inputs of a table. Inputs that the table does not have keep the values that they are
    /// given. See the example of [`Driven`].
    pub fn new(dynamics: D, table: Arc<InputTable>) -> Self {
        Self { dynamics, table, start_time: None }
    }

    /// Sets the time of the start in s; `None` for the declared one.
    ///
    /// # Example
    /// The cart of [`Driven`], pushed by a log whose clock showed 100 s at its beginning:
    /// ```
    /// # use std::sync::Arc;
    /// # use mbs_analysis::{Driven, InputTable};
    /// # use mbs_live::{Prepared, Text};
    /// # use mbs_runtime::{Adaptive, Sampled, System};
    /// # let text = "Cart {
    /// #     dof = 1;
    /// #     input push [N];
    /// #     body cart (x) { mass = 2 [kg]; }
    /// #     force pushed on x = push;
    /// #     start { x = 0; }
    /// # }";
    /// # let cart = Text::declaration("cart.mbs", text).compile()?;
    /// let table = InputTable::new(vec![100.0, 102.0], vec![(0, vec![0.0, 3.0])])?;
    /// let driven = Driven::new(Prepared::new(&cart), Arc::new(table)).starting_at(Some(100.0));
    /// let mut run = Sampled::new(Adaptive::builder(driven).build()?, 2.0)?;
    /// run.step()?;
    /// let (mut x, mut v) = ([0.0], [0.0]);
    /// run.state(&mut x, &mut v);
    /// assert!(run.time() == 102.0 && (x[0] - 1.0).abs() < 1e-9);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn starting_at(self, start_time: Option<f64>) -> Self {
        Self { start_time, ..self }
    }

    /// The inputs at a time.
    fn at(&self, t: D::Real, inputs: &[D::Real]) -> Vec<D::Real> {
        let mut present = inputs.to_vec();
        self.table.set(t, &mut present);
        present
    }
}

impl<D: Dynamics> Dynamics for Driven<D> {
    type Real = D::Real;
    type Coordinates = D::Coordinates;
    type States = D::States;
    type Constraints = D::Constraints;
    type Inputs = D::Inputs;

    const JUMPS: bool = D::JUMPS;
    const SAMPLES: bool = D::SAMPLES;
    const SWITCHES: bool = D::SWITCHES;

    fn equations(&self) -> &dyn Equations<D::Real> {
        self
    }

    fn derivation(&self) -> &Derivation {
        self.dynamics.derivation()
    }

    fn sketch(&self) -> &Sketch {
        self.dynamics.sketch()
    }

    fn declared_start(&self) -> (D::Real, D::Coordinates, D::Coordinates) {
        let (t, q, v) = self.dynamics.declared_start();
        (self.start_time.map_or(t, D::Real::from_f64), q, v)
    }

    fn states(&self, all: &D::Coordinates) -> D::States {
        self.dynamics.states(all)
    }

    fn complete(&self, t: D::Real, q: &D::States, v: &D::States, all: &mut [D::Coordinates; 2]) {
        self.dynamics.complete(t, q, v, all);
    }

    fn no_feedback(&self) -> D::Constraints {
        self.dynamics.no_feedback()
    }

    fn default_inputs(&self) -> D::Inputs {
        self.dynamics.default_inputs()
    }

    fn with_inputs<R>(&self, inputs: &mut D::Inputs, what: impl FnOnce(&mut [D::Real]) -> R) -> R {
        self.dynamics.with_inputs(inputs, what)
    }

    fn inputs_at(&self, t: D::Real, inputs: &D::Inputs) -> D::Inputs {
        let mut inputs = self.dynamics.inputs_at(t, inputs);
        self.dynamics.with_inputs(&mut inputs, |inputs| self.table.set(t, inputs));
        inputs
    }

    fn next_corner(&self, t: D::Real, inputs: &D::Inputs) -> D::Real {
        let present = self.inputs_at(t, inputs);
        let (own, others) = (self.table.next_corner(t), self.dynamics.next_corner(t, &present));
        if own < others { own } else { others }
    }

    fn with_room<S: Scheme>(
        &self,
        what: impl FnOnce(&mut Room<'_, D::Real>) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.dynamics.with_room::<S>(what)
    }

    fn events(&self, at: At<'_, D::Real>, inputs: &D::Inputs, values: &mut [D::Real]) {
        self.dynamics.events(at, &self.inputs_at(at.t, inputs), values);
    }

    fn free_acceleration(
        &self,
        t: D::Real,
        q: &D::States,
        v: &D::States,
        inputs: &D::Inputs,
        acceleration: &mut D::States,
    ) -> D::Real {
        self.dynamics.free_acceleration(t, q, v, &self.inputs_at(t, inputs), acceleration)
    }

    fn implicit(
        &self,
        t: D::Real,
        at: [&D::States; 2],
        inputs: &D::Inputs,
        predicted: (D::Real, &D::States),
        acceleration: &mut D::States,
    ) -> D::Real {
        self.dynamics.implicit(t, at, &self.inputs_at(t, inputs), predicted, acceleration)
    }

    fn correction(&self, t: D::Real, at: &Beside<'_, D::States>, delta: &mut D::States) -> D::Real {
        self.dynamics.correction(t, at, delta)
    }

    fn correction_along(
        &self,
        from: (D::Real, &D::States),
        t: D::Real,
        q: &D::States,
        delta: &mut D::States,
    ) -> D::Real {
        self.dynamics.correction_along(from, t, q, delta)
    }
}

/// Methods that are those of the mechanism, with the inputs of the table.
macro_rules! driven {
    ($($name:ident($($argument:ident: $Type:ty),*) $(-> $Result:ty)?;)*) => {$(
        fn $name(&self, at: At<'_, D::Real>, inputs: &[D::Real], $($argument: $Type),*) $(-> $Result)? {
            self.dynamics.equations().$name(at, &self.at(at.t, inputs), $($argument),*)
        }
    )*};
}

/// Methods that are those of the mechanism, since they depend on no input.
macro_rules! unchanged {
    ($($name:ident($($argument:ident: $Type:ty),*) $(-> $Result:ty)?;)*) => {$(
        fn $name(&self, $($argument: $Type),*) $(-> $Result)? {
            self.dynamics.equations().$name($($argument),*)
        }
    )*};
}

impl<D: Dynamics> Equations<D::Real> for Driven<D> {
    driven! {
        stabilized(gains: &Gains<D::Real>, a: &mut [D::Real], feedback: &mut [D::Real]) -> D::Real;
        constrained(feedback: &[D::Real], a: &mut [D::Real]) -> D::Real;
        implicit(shift: D::Real, predicted: &[D::Real], a: &mut [D::Real]) -> D::Real;
        accelerations(feedback: &[D::Real], a: &mut [D::Real]) -> D::Real;
        free_reactions(a: &mut [D::Real], multipliers: &mut [D::Real]) -> D::Real;
        limits(reactions: [&[D::Real]; 2], limits: &mut [D::Real]);
        switches(values: &mut [D::Real]);
        reactions(a: &mut [D::Real], multipliers: &mut [D::Real]) -> D::Real;
        outputs(reactions: [&[D::Real]; 2], outputs: &mut [D::Real]);
        events(values: &mut [D::Real]);
    }
    unchanged! {
        info() -> &Info;
        phi(t: D::Real, q: &[D::Real], phi: &mut [D::Real]);
        phi_dot(at: At<'_, D::Real>, phi_dot: &mut [D::Real]);
        complete(states: At<'_, D::Real>, q: &mut [D::Real], v: &mut [D::Real]);
        position_correction(t: D::Real, q: &[D::Real], residual: &[D::Real], correction: &mut [D::Real]) -> D::Real;
        velocity_correction(t: D::Real, q: &[D::Real], residual: &[D::Real], correction: &mut [D::Real]) -> D::Real;
        projection(t: D::Real, q: &[D::Real], violation: &[D::Real], correction: &mut [D::Real]) -> D::Real;
        worst_pivot(t: D::Real, q: &[D::Real]) -> Option<(usize, D::Real)>;
        worst_start_pivot(t: D::Real, q: &[D::Real]) -> Option<(usize, D::Real)>;
        kinetic_energy(at: At<'_, D::Real>) -> D::Real;
        states(all: &[D::Real], states: &mut [D::Real]);
        switching() -> &'static [Switch];
        stop_laws(laws: &mut [D::Real]);
        gaps(at: At<'_, D::Real>, acceleration: &[D::Real], gaps: &mut [D::Real]);
        contacts(t: D::Real, q: &[D::Real], what: &mut dyn FnMut(&[D::Real]));
        clock(clock: usize) -> [D::Real; 2];
        transitions(at: At<'_, D::Real>, inputs: &[D::Real], reactions: [&[D::Real]; 2], values: &mut [D::Real]);
        sample(at: At<'_, D::Real>, inputs: &mut [D::Real], clock: usize);
        potential_energy(at: At<'_, D::Real>) -> D::Real;
        points(t: D::Real, q: &[D::Real], points: &mut [D::Real]);
        parameters(parameters: &mut [D::Real]);
        // equations over duals are of the mechanism alone, with the inputs that are handed over
        is_differentiable() -> bool;
        with_partials(parameters: &[Partials], what: &mut dyn FnMut(&dyn Equations<Partials>)) -> Result<(), Error>;
    }
}
