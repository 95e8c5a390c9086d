//! A run as C sees it: what is set for it, and the mechanism in motion once it was started.
//!
//! A motion is any `System` that can be copied (`motion`). So a state is saved by copying a run.

use mbs_runtime::equations::At;
use mbs_runtime::{Baumgarte, Error, Held, Info, SystemClone, Tolerances};

use crate::border::Handle;
use crate::mechanism::{Kind, Mechanism, no_index};
use crate::method::Method;
use crate::motion::Settings;
use crate::status::{Failure, Status};

/// A run, `mbs_run` of the header.
pub struct Run {
    settings: Settings,
    motion: Option<Box<dyn SystemClone>>,
}

impl Handle for Run {
    const NAME: &'static str = "run";
}

impl Clone for Run {
    fn clone(&self) -> Self {
        let motion = self.motion.as_ref().map(|motion| motion.boxed_clone());
        Self { settings: self.settings.clone(), motion }
    }
}

/// Set before the start.
impl Run {
    /// A run that is not started; a step of 0 is the declared one.
    ///
    /// # Errors
    /// There is no such method or step.
    pub fn new(mechanism: &Mechanism, method: &str, step: f64) -> Result<Self, Failure> {
        let live = mechanism.live().clone();
        let step = if step == 0.0 { declared_step(mechanism)? } else { step };
        if !(step > 0.0 && step.is_finite()) {
            return Err(Error::Step { step }.into());
        }
        let settings = Settings {
            method: Method::find(method)?,
            step,
            parameters: live.parameters().to_vec(),
            inputs: live.declared_info().inputs.iter().map(|input| input.default).collect(),
            start: None,
            tolerances: None,
            gains: None,
            live,
        };
        Ok(Self { settings, motion: None })
    }

    /// Names and counts.
    pub fn info(&self) -> &'static Info {
        self.settings.live.declared_info()
    }

    /// The number of points.
    pub fn points(&self) -> usize {
        self.settings.live.sketch().points.len()
    }

    /// The parameters as they are set.
    pub fn parameters(&self) -> &[f64] {
        &self.settings.parameters
    }

    /// The inputs as they are set.
    pub fn inputs(&self) -> &[f64] {
        &self.settings.inputs
    }

    /// Sets a parameter for the next start.
    ///
    /// # Errors
    /// There is none with this index.
    pub fn set_parameter(&mut self, index: usize, value: f64) -> Result<(), Failure> {
        set(Kind::Parameter, &mut self.settings.parameters, index, value)
    }

    /// Sets an input at once.
    ///
    /// # Errors
    /// There is none with this index; it is not finite.
    pub fn set_input(&mut self, index: usize, value: f64) -> Result<(), Failure> {
        if let (Some(input), false) = (self.info().free_inputs().get(index), value.is_finite()) {
            return Err(Error::Input { name: input.name, value }.into());
        }
        set(Kind::Input, &mut self.settings.inputs, index, value)?;
        if let Some(motion) = &mut self.motion {
            motion.set_inputs(&self.settings.inputs);
        }
        Ok(())
    }

    /// Sets time, positions and velocities of the next start.
    pub fn set_start(&mut self, time: f64, positions: Vec<f64>, velocities: Vec<f64>) {
        self.settings.start = Some((time, positions, velocities));
    }

    /// Sets the tolerances of the next start.
    ///
    /// # Errors
    /// They cannot be kept.
    pub fn set_tolerances(&mut self, rtol: f64, atol: f64) -> Result<(), Failure> {
        let tolerances = Tolerances { rtol, atol, ..Tolerances::default() };
        tolerances.check::<f64>()?;
        self.settings.tolerances = Some(tolerances);
        Ok(())
    }

    /// Sets α and β of the next start.
    ///
    /// # Errors
    /// They are negative or not finite.
    pub fn set_gains(&mut self, alpha: f64, beta: f64) -> Result<(), Failure> {
        Baumgarte::<Held>::new(alpha, beta)?;
        self.settings.gains = Some([alpha, beta]);
        Ok(())
    }
}

/// In motion.
impl Run {
    /// Starts, or starts anew.
    ///
    /// # Errors
    /// Those of the mechanism, and settings that do not go together; nothing changes then.
    pub fn start(&mut self) -> Result<(), Failure> {
        self.motion = Some(self.settings.begin()?);
        Ok(())
    }

    /// The mechanism in motion.
    ///
    /// # Errors
    /// The run was not started.
    pub fn motion(&self) -> Result<&dyn SystemClone, Failure> {
        self.motion.as_deref().ok_or_else(not_started)
    }

    /// The same to be moved.
    ///
    /// # Errors
    /// The run was not started.
    pub fn motion_mut(&mut self) -> Result<&mut dyn SystemClone, Failure> {
        // the box is taken apart here, since its contents have no lifetime of their own
        match &mut self.motion {
            Some(motion) => Ok(motion.as_mut()),
            None => Err(not_started()),
        }
    }

    /// Positions and velocities.
    ///
    /// # Errors
    /// The run was not started.
    pub fn state(&self) -> Result<[Vec<f64>; 2], Failure> {
        let motion = self.motion()?;
        let [mut q, mut v] = [(); 2].map(|()| vec![f64::NAN; self.info().coordinates.len()]);
        motion.state(&mut q, &mut v);
        Ok([q, v])
    }

    /// Accelerations and multipliers.
    ///
    /// # Errors
    /// The run was not started, or they are not determined.
    pub fn reactions(&self) -> Result<[Vec<f64>; 2], Failure> {
        let (motion, info) = (self.motion()?, self.info());
        let mut accelerations = vec![f64::NAN; info.coordinates.len()];
        let mut multipliers = vec![f64::NAN; info.constraints.len()];
        motion.reactions(&mut accelerations, &mut multipliers)?;
        Ok([accelerations, multipliers])
    }

    /// The declared outputs.
    ///
    /// # Errors
    /// As [`reactions`](Self::reactions); one is not finite.
    pub fn outputs(&self) -> Result<Vec<f64>, Failure> {
        let [accelerations, multipliers] = self.reactions()?;
        let mut outputs = vec![f64::NAN; self.info().outputs.len()];
        self.motion()?.outputs(&accelerations, &multipliers, &mut outputs)?;
        Ok(outputs)
    }

    /// x and y of every point.
    ///
    /// # Errors
    /// The run was not started.
    pub fn places(&self) -> Result<Vec<f64>, Failure> {
        let (motion, [q, _]) = (self.motion()?, self.state()?);
        let mut places = vec![f64::NAN; 2 * self.points()];
        motion.points(motion.time(), &q, &mut places);
        Ok(places)
    }

    /// Kinetic and potential energy.
    ///
    /// # Errors
    /// The run was not started.
    pub fn energies(&self) -> Result<[f64; 2], Failure> {
        let (motion, [q, v]) = (self.motion()?, self.state()?);
        Ok(motion.energies(At { t: motion.time(), q: &q, v: &v }))
    }
}

fn not_started() -> Failure {
    Failure::new(Status::NotStarted, "the run is not started; call `mbs_run_start` first")
}

fn declared_step(mechanism: &Mechanism) -> Result<f64, Failure> {
    mechanism.live().declared_step().ok_or_else(|| {
        Failure::new(
            Status::Value,
            "the step is 0, but the text declares none; give one in s, or add `step = 1 [ms];` to the text",
        )
    })
}

fn set(kind: Kind, values: &mut [f64], index: usize, value: f64) -> Result<(), Failure> {
    let count = values.len();
    *values.get_mut(index).ok_or_else(|| no_index(kind, index, count))? = value;
    Ok(())
}
