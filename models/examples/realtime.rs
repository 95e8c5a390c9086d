//! A plant in a real-time loop on Linux: a thousand times a second it wakes, takes a step and sleeps again. How late
//! it woke and how long the step took is printed at the end. Nothing in the loop allocates.
//!
//! `cargo run --release --example realtime -- 10` runs for ten seconds. Of an ordinary process the scheduler wakes
//! when it suits; `sudo chrt --fifo 80 target/release/examples/realtime 10` runs before all others.

use std::error::Error;
use std::io::{self, Write};
use std::thread;
use std::time::{Duration, Instant};

use mbs_runtime::Simulation;
use models::SliderCrankFree;

const PERIOD: Duration = Duration::from_millis(1);
/// The plant takes two steps in a period.
const STEPS: u32 = 2;

fn main() -> Result<(), Box<dyn Error>> {
    let seconds: f64 = std::env::args().nth(1).map_or(Ok(5.0), |text| text.parse())?;
    let periods = (seconds / PERIOD.as_secs_f64()).clamp(1.0, 1e7) as usize;
    let step = PERIOD.as_secs_f64() / f64::from(STEPS);
    let mut plant = Simulation::new(SliderCrankFree::declared(), step)?;
    let (mut late, mut took) = (vec![0.0; periods], vec![0.0; periods]);
    let mut missed = 0;

    let mut next = Instant::now() + PERIOD;
    for period in 0..periods {
        thread::sleep(next.saturating_duration_since(Instant::now()));
        let woken = Instant::now();
        // a load that follows the speed, as a controller would set it
        plant.inputs_mut().crank_torque = 0.02 * (26.0 - plant.state().v.theta1);
        for _ in 0..STEPS {
            plant.step()?;
        }
        let done = Instant::now();
        late[period] = microseconds(woken.saturating_duration_since(next));
        took[period] = microseconds(done - woken);
        next += PERIOD;
        missed += usize::from(done > next);
        if period % 1000 == 999 {
            eprint!("\r{} of {seconds} s", (period + 1) / 1000);
            io::stderr().flush()?;
        }
    }
    eprintln!();
    println!("µs              median      99 %    99.9 %   longest");
    for (name, times) in [("woken late", &mut late), ("step of 1 ms", &mut took)] {
        times.sort_by(f64::total_cmp);
        let [a, b, c, d] = [0.5, 0.99, 0.999, 1.0].map(|share| at(times, share));
        println!("{name:12} {a:9.1} {b:9.1} {c:9.1} {d:9.1}");
    }
    println!(
        "{missed} of {periods} periods were not kept; the crank turns at {:.3} rad/s",
        plant.state().v.theta1
    );
    Ok(())
}

fn microseconds(time: Duration) -> f64 {
    time.as_secs_f64() * 1e6
}

/// The value that this share of sorted values does not exceed.
fn at(sorted: &[f64], share: f64) -> f64 {
    let place = (share * sorted.len() as f64).ceil() as usize;
    sorted.get(place.clamp(1, sorted.len()) - 1).copied().unwrap_or(f64::NAN)
}
