//! The mechanisms as models of the workbench. Here and not in the command, so that
//! what they make of its generic code is compiled once.

use mbs_workbench::model::{in_lanes, of, with};
use mbs_workbench::{Model, Settings};

/// The mechanisms with the names under which commands know them.
pub fn library() -> Vec<(&'static str, Box<dyn Model>)> {
    // 20 000 steps that have to follow 300 rad/s
    let fast = Settings { step: 20e-6, end: 0.4, ..Settings::default() };
    let usual = Settings::default();
    vec![
        ("slider-crank", in_lanes::<crate::SliderCrank>(usual.clone())),
        ("slider-crank-free", in_lanes::<crate::SliderCrankFree>(usual.clone())),
        ("pendulum", of::<crate::Pendulum>()),
        ("double-pendulum", of::<crate::DoublePendulum>()),
        ("n-pendulum-1", of::<crate::NPendulum1>()),
        ("n-pendulum-2", of::<crate::NPendulum2>()),
        ("n-pendulum-10", of::<crate::NPendulum10>()),
        ("n-pendulum-40", of::<crate::NPendulum40>()),
        ("cart-pendulum", of::<crate::CartPendulum>()),
        ("spring-mass-damper", of::<crate::SpringMassDamper>()),
        ("metronome", of::<crate::Metronome>()),
        ("block-on-incline", of::<crate::BlockOnIncline>()),
        ("four-bar", in_lanes::<crate::FourBar>(usual)),
        ("four-bar-free", of::<crate::FourBarFree>()),
        ("n-four-bar-1", of::<crate::NFourBar1>()),
        ("n-four-bar-2", of::<crate::NFourBar2>()),
        ("n-four-bar-10", of::<crate::NFourBar10>()),
        ("n-four-bar-40", of::<crate::NFourBar40>()),
        ("quick-return", of::<crate::QuickReturn>()),
        ("scotch-yoke", of::<crate::ScotchYoke>()),
        ("geneva-pin-slot", of::<crate::GenevaPinSlot>()),
        ("cam-follower", of::<crate::CamFollower>()),
        ("toggle-press", of::<crate::TogglePress>()),
        ("v-engine", of::<crate::VEngine>()),
        ("excavator", of::<crate::Excavator>()),
        ("tipper", of::<crate::Tipper>()),
        ("andrews-squeezer", with::<crate::AndrewsSqueezer>(fast)),
        ("planetary-gear", of::<crate::PlanetaryGear>()),
        ("geared-motor", of::<crate::GearedMotor>()),
        ("peaucellier", of::<crate::Peaucellier>()),
        ("hart-inversor", of::<crate::HartInversor>()),
        ("chebyshev", of::<crate::Chebyshev>()),
        ("watt-linkage", of::<crate::WattLinkage>()),
        ("trammel-of-archimedes", of::<crate::TrammelOfArchimedes>()),
        ("pantograph", of::<crate::Pantograph>()),
        ("jansen", of::<crate::Jansen>()),
        ("jansen-walker", of::<crate::JansenWalker>()),
        ("klann", of::<crate::Klann>()),
    ]
}
