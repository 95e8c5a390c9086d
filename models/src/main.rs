//! The `mbs` command: mechanisms at a desk, and the paper reproduced.

mod drift;
mod paper;

use std::process::ExitCode;

use mbs_workbench::model::{in_lanes, of, with};
use mbs_workbench::{Model, Settings};

fn main() -> ExitCode {
    let app = library().into_iter().fold(mbs_workbench::app(), |app, (name, model)| app.model(name, model));
    app.command(paper::command(), paper::run)
        .command(drift::command(), drift::run)
        .default_command("paper")
        .run()
}

/// The mechanisms with the names under which commands know them.
fn library() -> Vec<(&'static str, Box<dyn Model>)> {
    // 20 000 steps that have to follow 300 rad/s
    let fast = Settings { step: 20e-6, end: 0.4, ..Settings::default() };
    let usual = Settings::default();
    vec![
        ("slider-crank", in_lanes::<models::SliderCrank>(usual.clone())),
        ("slider-crank-free", in_lanes::<models::SliderCrankFree>(usual.clone())),
        ("pendulum", of::<models::Pendulum>()),
        ("double-pendulum", of::<models::DoublePendulum>()),
        ("n-pendulum-1", of::<models::NPendulum1>()),
        ("n-pendulum-2", of::<models::NPendulum2>()),
        ("n-pendulum-10", of::<models::NPendulum10>()),
        ("n-pendulum-40", of::<models::NPendulum40>()),
        ("cart-pendulum", of::<models::CartPendulum>()),
        ("spring-mass-damper", of::<models::SpringMassDamper>()),
        ("metronome", of::<models::Metronome>()),
        ("block-on-incline", of::<models::BlockOnIncline>()),
        ("four-bar", in_lanes::<models::FourBar>(usual)),
        ("four-bar-free", of::<models::FourBarFree>()),
        ("n-four-bar-1", of::<models::NFourBar1>()),
        ("n-four-bar-2", of::<models::NFourBar2>()),
        ("n-four-bar-10", of::<models::NFourBar10>()),
        ("n-four-bar-40", of::<models::NFourBar40>()),
        ("quick-return", of::<models::QuickReturn>()),
        ("scotch-yoke", of::<models::ScotchYoke>()),
        ("geneva-pin-slot", of::<models::GenevaPinSlot>()),
        ("cam-follower", of::<models::CamFollower>()),
        ("toggle-press", of::<models::TogglePress>()),
        ("v-engine", of::<models::VEngine>()),
        ("excavator", of::<models::Excavator>()),
        ("tipper", of::<models::Tipper>()),
        ("andrews-squeezer", with::<models::AndrewsSqueezer>(fast)),
        ("planetary-gear", of::<models::PlanetaryGear>()),
        ("geared-motor", of::<models::GearedMotor>()),
        ("peaucellier", of::<models::Peaucellier>()),
        ("hart-inversor", of::<models::HartInversor>()),
        ("chebyshev", of::<models::Chebyshev>()),
        ("watt-linkage", of::<models::WattLinkage>()),
        ("trammel-of-archimedes", of::<models::TrammelOfArchimedes>()),
        ("pantograph", of::<models::Pantograph>()),
        ("jansen", of::<models::Jansen>()),
        ("jansen-walker", of::<models::JansenWalker>()),
        ("klann", of::<models::Klann>()),
    ]
}
