//! A mechanism that runs as soon as it is compiled.
//!
//! Mechanisms and runs are generic over the scalar, all but `Pack`. The code is the same for each scalar, so
//! derivatives need no second compilation.

use std::fmt;
use std::sync::Arc;

use mbs_codegen::compiled::{self, Condition, Feedback, FusedStep};
use mbs_codegen::{Compiled, FunctionId};
use mbs_runtime::{Derivation, Error, Explicit, Info, Real, Sketch, Stabilization, Tableau};
use mbs_symbolic::Inconsistency;

use crate::arguments::Arguments;
use crate::code::{Code, Fixed};
use crate::instruction::execute;
use crate::statics::{self, Tables};
use crate::transposed::Transposes;

/// A mechanism that was compiled from a text, with its parameters.
///
/// It is [`Equations`](mbs_runtime::equations::Equations): what is written for these runs
/// with it as with a mechanism of `mechanism!`, and gives the same to the last bit. A copy
/// shares the compiled programs. `T` is its scalar: `f64`, or by [`over`](Self::over) a
/// [`Dual`](mbs_runtime::Dual) for derivatives.
///
/// # Example
/// ```
/// use mbs_live::Text;
/// use mbs_runtime::equations::{At, Equations};
///
/// let text = "Pendulum {
///     dof = 1;
///     param length = 1 [m] where length > 0;
///     gravity = (0, -9.81) [m/s^2];
///     body bob (x, y) { mass = 2 [kg]; }
///     constraint rod: x^2 + y^2 = length^2;
///     start { x = length; guess y = 0; }
/// }";
/// let pendulum = Text::declaration("pendulum.mbs", text).compile()?;
/// assert_eq!(pendulum.declared_info().coordinates[1].name, "y");
/// assert_eq!(pendulum.kinetic_energy(At { t: 0.0, q: &[1.0, 0.0], v: &[0.0, 3.0] }), 9.0);
///
/// let longer = pendulum.with_parameters(|values| values[0] = 2.0)?;
/// assert_eq!(longer.parameters(), [2.0]);
/// let mut phi = [0.0];
/// longer.phi(0.0, &[2.0, 0.0], &mut phi);
/// assert_eq!(phi, [0.0]);
/// assert!(pendulum.with_parameters(|values| values[0] = -1.0).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone)]
pub struct Live<T = f64> {
    programs: Arc<Programs>,
    parameters: Vec<T>,
    hoisted: Vec<T>,
}

/// The programs of a declaration, whatever its parameters are.
pub(crate) struct Programs {
    pub tables: &'static Tables,
    /// In the order of [`FunctionId`].
    functions: Vec<Code>,
    /// The scheme of the declaration: the one it names, or Heun's method.
    scheme: &'static Tableau,
    /// `true` if the declaration names its scheme.
    declares_scheme: bool,
    /// A whole step of the scheme as one program, with feedback held over the step and with feedback in each of its
    /// stages. `None` if the mechanism is too large for that.
    steps: Option<[Arc<Code>; 2]>,
    conditions: Vec<Condition>,
    /// The programs that go back through a run, where they were asked for.
    pub transposes: Option<Transposes>,
}

impl Programs {
    /// The programs of a compiled mechanism; `declaration` is its text as tokens.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn new(declaration: String, compiled: &Compiled) -> Result<Self, Inconsistency> {
        let functions = FunctionId::all().map(|function| Code::new(compiled, compiled.program(function)));
        let steps = compiled.fused_step.as_ref().map(|step| steps(compiled, step)).transpose()?;
        let conditions = compiled.conditions.iter().map(|condition| Condition {
            name: condition.name.clone(),
            requirement: condition.requirement.clone(),
            ..*condition
        });
        Ok(Self {
            functions: functions.collect::<Result<_, _>>()?,
            scheme: compiled.choices.scheme,
            declares_scheme: compiled.choices.declares_scheme,
            steps,
            conditions: conditions.collect(),
            tables: statics::tables(declaration, compiled),
            transposes: None,
        })
    }

    /// The same with transposed programs.
    ///
    /// # Errors
    /// A mistake of this crate.
    pub fn with_transposes(self, compiled: &Compiled) -> Result<Self, Inconsistency> {
        Ok(Self { transposes: Some(Transposes::new(compiled)?), ..self })
    }

    /// The code of a function.
    pub fn function(&self, function: FunctionId) -> &Code {
        &self.functions[function as usize]
    }

    /// The code of a whole step of a method, if there is one.
    pub fn step(&self, method: Explicit) -> Option<&Arc<Code>> {
        let [held, per_stage] = self.steps.as_ref().filter(|_| self.scheme.is(method.tableau))?;
        match method.stabilization {
            Stabilization::Held => Some(held),
            Stabilization::PerStage => Some(per_stage),
            Stabilization::Projection => None,
        }
    }
}

/// The steps with both kinds of feedback: the state after it, and the growth.
fn steps(compiled: &Compiled, step: &FusedStep) -> Result<[Arc<Code>; 2], Inconsistency> {
    let compiled::Kinds { held, per_stage } = &step.alone;
    let code = |program| Code::new(compiled, program).map(Arc::new);
    Ok([code(held)?, code(per_stage)?])
}

impl Live {
    /// The mechanism with its declared parameters.
    pub(crate) fn new(programs: Programs) -> Self {
        let parameters = programs.tables.info.parameters.iter().map(|parameter| parameter.default).collect();
        Self::prepared(Arc::new(programs), parameters)
    }
}

impl<T: Real> Live<T> {
    /// Computes what depends on parameters alone.
    fn prepared(programs: Arc<Programs>, parameters: Vec<T>) -> Self {
        let mut hoisted = vec![T::from_f64(f64::NAN); programs.function(FunctionId::Hoisted).outputs.len()];
        let bare = Self { programs, parameters, hoisted: Vec::new() };
        bare.call(FunctionId::Hoisted, &Arguments::default(), [&mut hoisted]);
        Self { hoisted, ..bare }
    }

    /// The same mechanism over another scalar, its parameters as constants. Nothing is compiled
    /// again.
    ///
    /// # Example
    /// How the acceleration from the side changes with gravity:
    /// ```
    /// use mbs_live::Text;
    /// use mbs_runtime::Dual;
    /// use mbs_runtime::equations::{At, Equations};
    ///
    /// let text = "Fall {
    ///     dof = 1;
    ///     param g = 9.81 [m/s^2];
    ///     gravity = (0, -g);
    ///     body ball (y) { mass = 1 [kg]; }
    ///     start { y = 1 [m]; }
    /// }";
    /// let ball = Text::declaration("fall.mbs", text).compile()?;
    /// let ball = ball.over().with_parameters(|values| values[0] = Dual::<f64, 1>::variable(9.81, 0))?;
    /// let (still, mut a) = ([Dual::default()], [Dual::default()]);
    /// ball.constrained(At { t: Dual::default(), q: &still, v: &still }, &[], &[], &mut a);
    /// assert_eq!((a[0].value, a[0].partials), (-9.81, [-1.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn over<S: Real>(&self) -> Live<S> {
        let parameters = self.parameters.iter().map(|x| S::from_f64(x.to_f64())).collect();
        Live::prepared(Arc::clone(&self.programs), parameters)
    }

    /// The same mechanism with other parameters: `change` is given those that it has, in SI
    /// units and in the order of [`Info::parameters`]. See the example of [`Live`].
    ///
    /// # Errors
    /// [`Error::Parameter`] if one is not finite, if a mass or an inertia comes out
    /// negative, or if a declared condition does not hold; as the `new` of a mechanism of
    /// `mechanism!`.
    pub fn with_parameters(&self, change: impl FnOnce(&mut [T])) -> Result<Self, Error> {
        let mut parameters = self.parameters.clone();
        change(&mut parameters);
        for (&value, parameter) in parameters.iter().zip(self.declared_info().parameters) {
            if !value.is_finite() {
                let value = value.to_f64();
                let requirement = "it has to be finite";
                return Err(Error::Parameter { name: parameter.name, value, requirement });
            }
        }
        let live = Self { parameters, ..self.clone() };
        live.check_conditions()?;
        Ok(Self::prepared(live.programs, live.parameters))
    }

    fn check_conditions(&self) -> Result<(), Error> {
        let code = self.programs.function(FunctionId::Conditions);
        let mut found = vec![T::from_f64(f64::NAN); code.outputs.len()];
        self.call(FunctionId::Conditions, &Arguments::default(), [&mut found]);
        let number = |at: usize| found.get(at).map_or(f64::NAN, |found| found.to_f64());
        for condition in &self.programs.conditions {
            if !condition.comparison.holds(number(condition.difference)) {
                return Err(Error::Parameter {
                    name: statics::text(&condition.name),
                    value: number(condition.value),
                    requirement: statics::text(&condition.requirement),
                });
            }
        }
        Ok(())
    }

    /// The parameters, in SI units and in the order of [`Info::parameters`].
    pub fn parameters(&self) -> &[T] {
        &self.parameters
    }

    /// Time in s, positions and velocities of the declared start. Guesses are as they are written, and need not keep
    /// the constraints.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Wedge {
    ///     dof = 1;
    ///     param reach = 3 [m];
    ///     body slide (x, y) { mass = 1 [kg]; }
    ///     constraint slope: y = 0.5*x;
    ///     start { x = reach; guess y = 1 [m]; der(x) = 2 [m/s]; }
    /// }";
    /// let wedge = Text::declaration("wedge.mbs", text).compile()?;
    /// let farther = wedge.with_parameters(|values| values[0] = 4.0)?;
    /// assert_eq!(farther.declared_start(), (0.0, vec![4.0, 1.0], vec![2.0, 0.0]));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn declared_start(&self) -> (T, Vec<T>, Vec<T>) {
        let n = self.declared_info().coordinates.len();
        let unknown = T::from_f64(f64::NAN);
        let (mut q, mut v, mut t) = (vec![unknown; n], vec![unknown; n], [unknown]);
        self.call(FunctionId::Start, &Arguments::default(), [&mut q, &mut v, &mut t]);
        (t[0], q, v)
    }

    /// True if both were compiled by the same call of
    /// [`Text::compile`](crate::Text::compile), so that they differ in parameters only.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = Text::declaration("a.mbs", "Block { dof = 1; param m = 1 [kg]; body block (x) { mass = m; } }");
    /// let block = text.compile()?;
    /// let heavier = block.with_parameters(|values| values[0] = 2.0)?;
    /// assert!(heavier.shares_programs_with(&block));
    /// assert!(!text.compile()?.shares_programs_with(&block));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn shares_programs_with<S>(&self, other: &Live<S>) -> bool {
        Arc::ptr_eq(&self.programs, &other.programs)
    }

    /// Names, units, equations and counts, which do not depend on parameters. See the example of [`Live`].
    pub fn declared_info(&self) -> &'static Info {
        &self.programs.tables.info
    }

    /// The equations and their elimination, for people to read.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Oscillator {
    ///     dof = 1;
    ///     param k = 4 [N/m];
    ///     body block (x) { mass = 2 [kg]; }
    ///     force spring on x = -k*x;
    /// }";
    /// let oscillator = Text::declaration("oscillator.mbs", text).compile()?;
    /// let force = oscillator.derivation().forces[0];
    /// assert_eq!((force.of, force.text), ("x", "-x*k"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn derivation(&self) -> &'static Derivation {
        &self.programs.tables.derivation
    }

    /// The picture of the mechanism: names of bodies, points, joints and springs.
    ///
    /// # Example
    /// ```
    /// use mbs_live::Text;
    ///
    /// let text = "Bar {
    ///     dof = 1;
    ///     body bar (x, y, phi) { mass = 4 [kg]; inertia = 0.03 [kg*m^2]; }
    ///     point end on bar = (-0.15, 0) [m];
    ///     revolute hinge (bar.end, ground);
    /// }";
    /// let bar = Text::declaration("bar.mbs", text).compile()?;
    /// let sketch = bar.sketch();
    /// let joint = sketch.joints[0];
    /// assert_eq!((joint.name, joint.kind, sketch.points[joint.first]), ("hinge", "revolute", "bar.end"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn sketch(&self) -> &'static Sketch {
        &self.programs.tables.sketch
    }

    /// The feedback that the declaration asks for, stable with its step. See the example of
    /// [`declared_scheme`](Self::declared_scheme).
    pub fn declared_feedback(&self) -> Option<Feedback> {
        self.programs.tables.feedback
    }

    /// The scheme that the declaration asks for; Heun's method by default.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{Feedback, Text};
    ///
    /// let text = "Slider {
    ///     dof = 1;
    ///     method = rk4;
    ///     step = 0.5 [ms];
    ///     feedback = held(1500 [1/s], 2000 [1/s]);
    ///     body block (x) { mass = 1 [kg]; }
    /// }";
    /// let slider = Text::declaration("slider.mbs", text).compile()?;
    /// assert!(slider.declared_scheme().word == "rk4" && slider.declares_scheme());
    /// assert_eq!(slider.declared_step(), Some(0.5e-3));
    /// let gains = Feedback { is_held: true, alpha: 1500.0, beta: 2000.0 };
    /// assert_eq!(slider.declared_feedback(), Some(gains));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn declared_scheme(&self) -> &'static Tableau {
        self.programs.scheme
    }

    /// `true` if the declaration names its scheme, `false` if the scheme is the default. See the example of
    /// [`declared_scheme`](Self::declared_scheme).
    pub fn declares_scheme(&self) -> bool {
        self.programs.declares_scheme
    }

    /// The step that the declaration asks for, in s. See the example of [`declared_scheme`](Self::declared_scheme).
    pub fn declared_step(&self) -> Option<f64> {
        self.programs.tables.step
    }

    pub(crate) fn programs(&self) -> &Arc<Programs> {
        &self.programs
    }

    /// The number in a slot that does not change from run to run.
    pub(crate) fn fixed(&self, fixed: Fixed) -> T {
        fixed.value(&self.parameters, &self.hoisted)
    }

    /// Runs a function; `results` are its results, one vector after the other.
    pub(crate) fn call<const VECTORS: usize>(
        &self,
        function: FunctionId,
        arguments: &Arguments<'_, T>,
        results: [&mut [T]; VECTORS],
    ) {
        let code = self.programs.function(function);
        let mut values = code.memory(|fixed| [self.fixed(fixed)]);
        code.load(&mut values, arguments);
        execute(&code.instructions, self.programs.tables.splines, &mut values);
        code.store(&values, &mut results.map(|vector| vector.as_chunks_mut().0));
    }
}

impl<T: fmt::Debug> fmt::Debug for Live<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let info = &self.programs.tables.info;
        let parameters = info.parameters.iter().zip(&self.parameters);
        let parameters = parameters.map(|(parameter, value)| (parameter.name, value));
        f.debug_struct(info.name).field("parameters", &parameters.collect::<Vec<_>>()).finish_non_exhaustive()
    }
}
