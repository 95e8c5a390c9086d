//! mbs
use mbs_runtime::{Baumgarte, PerStage, Simulation};
fn main() {
    let mut s = Simulation::builder(models::SliderCrank::declared(), 0.5e-3)
        .baumgarte(Baumgarte::<PerStage>::new(2000.0, 2000.0).unwrap()).as_declared().build().unwrap();
    let mut m = 0.0f64;
    for _ in 0..600 { s.step().unwrap(); m = m.max(s.violation()); }
    println!("{m:e}");
}
