//! The rig and the motor of `models/examples/observer` on a Cortex-M: the same digits, and how many instructions they take.
//!
//! `cargo run --release`, with QEMU.

#![no_std]
#![no_main]

#[path = "../../examples/observer/filter.rs"]
mod filter;
#[path = "../../examples/observer/motor.rs"]
mod motor;
#[path = "../../examples/observer/rig.rs"]
mod rig;
#[path = "../../src/slider_crank_free.rs"]
mod slider_crank_free;

use core::panic::PanicInfo;

use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use cortex_m_semihosting::{debug, hprintln};
use mbs_runtime::{Components, Error, Simulation};
use slider_crank_free::{SliderCrankFree, SliderCrankFreeCoordinates};

#[cortex_m_rt::entry]
fn main() -> ! {
    let status = match cortex_m::Peripherals::take().map(|it| work(it.SYST)) {
        Some(Ok(())) => debug::EXIT_SUCCESS,
        Some(Err(error)) => {
            hprintln!("{}", error);
            debug::EXIT_FAILURE
        }
        None => debug::EXIT_FAILURE,
    };
    debug::exit(status);
    loop {
        cortex_m::asm::wfi();
    }
}

fn work(timer: SYST) -> Result<(), Error> {
    let mut rig = rig::Rig::new()?;
    hprintln!(
        "time in s, angle in rad and speed in rad/s of the crank, their estimates and deviations, torque in N·m"
    );
    for tick in 0..=1000 {
        if tick % 50 == 0 {
            let rig::Seen { time, truth, estimate, deviation, torque } = rig.seen();
            hprintln!("{:?} {:?} {:?} {:?} {:?}", time, truth, estimate, deviation, torque);
        }
        rig.tick()?;
    }
    hprintln!(
        "time in s, speed in rad/s, current in A, voltage in V and sum in rad of a motor under a sampled controller"
    );
    motor::run(|seen| {
        hprintln!("{:?}", seen);
    })?;
    let mut clock = Clock::new(timer);
    let mut rig = rig::Rig::new()?;
    let ticks = clock.instructions(TURNS, || rig.tick())?;
    let mut plant = Simulation::new(SliderCrankFree::declared(), rig::STEP)?;
    let steps = clock.instructions(TURNS, || plant.step())?;
    let parameters = plant.mechanism().parameters().over();
    let mut single = Simulation::new(SliderCrankFree::<f32>::new(parameters)?, rig::STEP)?;
    let single_steps = clock.instructions(TURNS, || single.step())?;
    hprintln!(
        "instructions: step in f64 {}, step in f32 {}, tick of plant, observer and controller {}",
        steps,
        single_steps,
        ticks
    );
    Ok(())
}

/// How often something is done to be counted.
const TURNS: u32 = 100;

/// The timer of the core, which runs at 25 MHz on these boards.
struct Clock {
    timer: SYST,
}

impl Clock {
    /// Instructions from one tick of the timer to the next, at a nanosecond each.
    const INSTRUCTIONS: u32 = 40;
    const LONGEST: u32 = 0x00ff_ffff;

    fn new(mut timer: SYST) -> Self {
        timer.set_clock_source(SystClkSource::Core);
        timer.set_reload(Self::LONGEST);
        timer.enable_counter();
        Self { timer }
    }

    /// The instructions of one turn, on average.
    fn instructions(
        &mut self,
        turns: u32,
        mut work: impl FnMut() -> Result<(), Error>,
    ) -> Result<u32, Error> {
        self.timer.clear_current();
        for _ in 0..turns {
            work()?;
        }
        let ticks = Self::LONGEST - SYST::get_current();
        Ok((u64::from(ticks) * u64::from(Self::INSTRUCTIONS) / u64::from(turns)) as u32)
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    hprintln!("{}", info);
    debug::exit(debug::EXIT_FAILURE);
    loop {
        cortex_m::asm::wfi();
    }
}
