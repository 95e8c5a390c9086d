//! A library of mechanisms, one a file: figure, source, parameters, reference
//! values.
//!
//! | mechanism | degrees of freedom | what it shows |
//! |---|---|---|
//! | [`SliderCrank`] | 0 | fully driven: kinematics, drive torque |
//! | [`SliderCrankFree`] | 1 | an `input` set by the embedding program |
//! | [`Pendulum`] | 1 | Cartesian coordinates, a reaction as output |
//! | [`DoublePendulum`] | 2 | a chain of rods, normal modes |
//! | [`NPendulum1`], 2, 10, 40 | N | a chain by `for`, one text for every N |
//! | [`CartPendulum`] | 2 | a plant for controllers |
//! | [`SpringMassDamper`] | 1 | a spring with damping, no constraint |
//! | [`Metronome`] | 1 | a torsion spring, a fixed joint |
//! | [`BlockOnIncline`] | 1 | dry friction that follows a reaction |
//! | [`FourBar`] | 0 | coupler curve, transmission angle, bearing forces |
//! | [`FourBarFree`] | 1 | a closed loop that keeps its energy |
//! | [`NFourBar1`], 2, 10, 40 | 1 | N loops, change points |
//! | [`QuickReturn`] | 0 | a pin in a slot, unequal strokes |
//! | [`ScotchYoke`] | 0 | harmonic motion |
//! | [`GenevaPinSlot`] | 0 | intermittent motion, its driven phase |
//! | [`CamFollower`] | 0 | a profile, contact force, lift-off |
//! | [`TogglePress`] | 0 | a drive on a point, force amplification |
//! | [`VEngine`] | 0 | two loops on one crank pin |
//! | [`Excavator`] | 0 | hydraulic cylinders as drives of distances |
//! | [`Tipper`] | 0 | a prismatic joint between moving bodies, as in a cylinder |
//! | [`AndrewsSqueezer`] | 1 | the test problem of seven bodies |
//! | [`PlanetaryGear`] | 1 | gears on a carrier, tooth forces |
//! | [`GearedMotor`] | 1 | a torque–speed line, a pair of gears |
//! | [`DcMotor`] | 1 | states of its own: a current, a controller's integral |
//! | [`Suspension`] | 2 | tables, a force by a law between two bodies |
//! | [`CraneRope`] | 2 | a rope that goes slack, drives by laws of motion, events |
//! | [`Brake`] | 1 | a temperature as a state, friction that falls with it |
//! | [`Engine`] | 1 | an indicator diagram as a periodic table, a starter with a freewheel |
//! | [`BoomCylinder`] | 1 | pressures as states, a valve, a force by a law between two points |
//! | [`ChaplyginSleigh`] | 2 | an equation between rates: an edge that does not slip |
//! | [`DifferentialDrive`] | 2 | wheels that roll and do not slide, torques as inputs |
//! | [`CartPole`] | 2 | a sampled controller with an observer |
//! | [`PathFollower`] | 2 | two clocks, one controller within the other |
//! | [`ElasticCrank`] | 1 | a rod that bends: a coordinate of its own, particles |
//! | [`DropHammer`] | 2 | a mode that a clock enters, a stop |
//! | [`NewtonsCradle`] | 5 | stops, impacts one after the other |
//! | [`Peaucellier`] | 0 | exact straight line |
//! | [`HartInversor`] | 0 | exact straight line, with fewer bars |
//! | [`Chebyshev`] | 0 | nearly straight line |
//! | [`WattLinkage`] | 0 | nearly straight line |
//! | [`TrammelOfArchimedes`] | 0 | ellipse |
//! | [`Pantograph`] | 0 | scaling, two drives |
//! | [`Jansen`] | 0 | walking, bars as distances |
//! | [`JansenWalker`] | 0 | an assembly, three times |
//! | [`Klann`] | 0 | walking, bars as distances |
//!
//! More mechanisms are texts, in the folder `texts`, for the command and the gallery alone.
//!
//! Each file states a reference result, which `tests/references` holds the
//! mechanism to. `tests/library` holds all of them to the balance of forces and
//! power, and to the order of the method over a long run.

pub mod andrews_squeezer;
pub mod block_on_incline;
pub mod boom_cylinder;
pub mod brake;
pub mod cam_follower;
pub mod cart_pendulum;
pub mod cart_pole;
pub mod chaplygin_sleigh;
pub mod chebyshev;
pub mod crane_rope;
pub mod dc_motor;
pub mod differential_drive;
pub mod double_pendulum;
pub mod drop_hammer;
pub mod elastic_crank;
pub mod engine;
pub mod excavator;
pub mod four_bar;
pub mod four_bar_free;
pub mod geared_motor;
pub mod geneva_pin_slot;
pub mod hart_inversor;
pub mod jansen;
pub mod jansen_walker;
pub mod klann;
pub mod metronome;
pub mod n_four_bar;
pub mod n_pendulum;
pub mod newtons_cradle;
pub mod pantograph;
pub mod path_follower;
pub mod peaucellier;
pub mod pendulum;
pub mod planetary_gear;
pub mod quick_return;
pub mod scotch_yoke;
pub mod slider_crank;
pub mod slider_crank_free;
pub mod spring_mass_damper;
pub mod suspension;
pub mod tipper;
pub mod toggle_press;
pub mod trammel_of_archimedes;
pub mod v_engine;
pub mod watt_linkage;

pub use andrews_squeezer::{AndrewsSqueezer, AndrewsSqueezerInputs, AndrewsSqueezerParameters};
pub use block_on_incline::{BlockOnIncline, BlockOnInclineInputs, BlockOnInclineParameters};
pub use boom_cylinder::{BoomCylinder, BoomCylinderInputs, BoomCylinderParameters};
pub use brake::{Brake, BrakeInputs, BrakeParameters};
pub use cam_follower::{CamFollower, CamFollowerParameters};
pub use cart_pendulum::{CartPendulum, CartPendulumInputs, CartPendulumParameters};
pub use cart_pole::{CartPole, CartPoleInputs, CartPoleParameters};
pub use chaplygin_sleigh::{ChaplyginSleigh, ChaplyginSleighParameters};
pub use chebyshev::{Chebyshev, ChebyshevParameters};
pub use crane_rope::{CraneRope, CraneRopeParameters};
pub use dc_motor::{DcMotor, DcMotorInputs, DcMotorParameters};
pub use differential_drive::{DifferentialDrive, DifferentialDriveInputs, DifferentialDriveParameters};
pub use double_pendulum::{DoublePendulum, DoublePendulumParameters};
pub use drop_hammer::{DropHammer, DropHammerInputs, DropHammerParameters};
pub use elastic_crank::{ElasticCrank, ElasticCrankParameters};
pub use engine::{Engine, EngineParameters};
pub use excavator::{Excavator, ExcavatorInputs, ExcavatorParameters};
pub use four_bar::{FourBar, FourBarParameters};
pub use four_bar_free::{FourBarFree, FourBarFreeInputs, FourBarFreeParameters};
pub use geared_motor::{GearedMotor, GearedMotorInputs, GearedMotorParameters};
pub use geneva_pin_slot::{GenevaPinSlot, GenevaPinSlotParameters};
pub use hart_inversor::{HartInversor, HartInversorParameters};
pub use jansen::{Jansen, JansenInputs, JansenParameters};
pub use jansen_walker::{JansenWalker, JansenWalkerParameters};
pub use klann::{Klann, KlannInputs, KlannParameters};
pub use metronome::{Metronome, MetronomeParameters};
pub use n_four_bar::{
    NFourBar1, NFourBar1Parameters, NFourBar2, NFourBar2Parameters, NFourBar10, NFourBar10Parameters,
    NFourBar40, NFourBar40Parameters,
};
pub use n_pendulum::{
    NPendulum1, NPendulum1Parameters, NPendulum2, NPendulum2Parameters, NPendulum10, NPendulum10Parameters,
    NPendulum40, NPendulum40Parameters,
};
pub use newtons_cradle::{NewtonsCradle, NewtonsCradleInputs, NewtonsCradleParameters};
pub use pantograph::{Pantograph, PantographParameters};
pub use path_follower::{PathFollower, PathFollowerInputs, PathFollowerParameters};
pub use peaucellier::{Peaucellier, PeaucellierParameters};
pub use pendulum::Pendulum;
pub use planetary_gear::{PlanetaryGear, PlanetaryGearInputs, PlanetaryGearParameters};
pub use quick_return::{QuickReturn, QuickReturnInputs, QuickReturnParameters};
pub use scotch_yoke::{ScotchYoke, ScotchYokeInputs, ScotchYokeParameters};
pub use slider_crank::{SliderCrank, SliderCrankParameters};
pub use slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs, SliderCrankFreeParameters};
pub use spring_mass_damper::{SpringMassDamper, SpringMassDamperInputs, SpringMassDamperParameters};
pub use suspension::{Suspension, SuspensionParameters};
pub use tipper::{Tipper, TipperParameters};
pub use toggle_press::{TogglePress, TogglePressInputs, TogglePressParameters};
pub use trammel_of_archimedes::{TrammelOfArchimedes, TrammelOfArchimedesParameters};
pub use v_engine::{VEngine, VEngineInputs, VEngineParameters};
pub use watt_linkage::{WattLinkage, WattLinkageParameters};
