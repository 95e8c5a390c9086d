//! An observer in the loop: an extended Kalman filter finds angle and speed of a crank from the position of its
//! slider, and a controller holds the speed that it finds. Behind it a motor with a sampled controller in its declaration.
//! `models/firmware` runs the same files on a microcontroller, with the same digits.
//!
//! `cargo run --release --example observer`

mod filter;
mod motor;
mod rig;

use mbs_runtime::Error;
use models::SliderCrankFree;
use models::slider_crank_free::SliderCrankFreeCoordinates;

fn main() -> Result<(), Error> {
    let mut rig = rig::Rig::new()?;
    println!(
        "time in s, angle in rad and speed in rad/s of the crank, their estimates and deviations, torque in N·m"
    );
    for tick in 0..=1000 {
        if tick % 50 == 0 {
            let rig::Seen { time, truth, estimate, deviation, torque } = rig.seen();
            println!("{time:?} {truth:?} {estimate:?} {deviation:?} {torque:?}");
        }
        rig.tick()?;
    }
    println!(
        "time in s, speed in rad/s, current in A, voltage in V and sum in rad of a motor under a sampled controller"
    );
    motor::run(|seen| println!("{seen:?}"))
}
