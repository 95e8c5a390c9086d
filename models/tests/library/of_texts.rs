//! Mechanisms of the library that are texts: what hits, rests, sticks, locks and touches.
//!
//! Their references are closed forms, or motions that another program integrated from contact to contact; each text says which.

use mbs::library;
use mbs_runtime::Tolerances;
use mbs_workbench::{Recording, Settings, model};

#[track_caller]
fn near(what: &str, ours: f64, reference: f64, tolerance: f64) {
    // written so that a NaN fails
    let is_near = (ours - reference).abs() <= tolerance;
    assert!(is_near, "{what}: {ours} against {reference}, off by {:e}", ours - reference);
}

/// A run to a relative tolerance, and an absolute one a thousandth of that.
fn run(name: &str, parameters: &[(&str, f64)], [end, step, rtol]: [f64; 3]) -> Recording {
    let entry = library().iter().find(|entry| entry.name == name).unwrap();
    let model = model::from_text(&entry.text(), entry.defaults()).unwrap_or_else(|error| panic!("{error}"));
    let tolerances = Some(Tolerances { rtol, atol: 1e-3 * rtol, ..Tolerances::default() });
    let parameters = parameters.iter().map(|&(name, value)| (name.to_owned(), value)).collect();
    let settings = Settings { end, step, tolerances, parameters, ..entry.defaults() };
    let recording = model.simulate(&settings, &mut |_, _| ()).unwrap();
    assert_eq!(recording.ended, None, "{name}");
    recording
}

/// The last value of a column, in its unit.
fn last(run: &Recording, column: &str) -> f64 {
    *run.column(column).unwrap().values.last().unwrap()
}

/// The times of an event.
fn times(run: &Recording, event: &str) -> Vec<f64> {
    run.occurrences.iter().filter(|found| found.name == event).map(|found| found.t).collect()
}

/// Flores, Leine and Glocker (2010): the first contact, of two corners at once. Sums of impulses without friction are those of
/// another program.
#[test]
fn two_corners_of_a_slider_with_play_hit_at_once() {
    let hits = 2.692_502_752e-3;
    let flight = run("clearance-crank", &[("friction", 0.0)], [hits, hits, 1e-12]);
    near("crank", last(&flight, "theta1"), 0.355_304_455, 1e-9);
    near("rod", last(&flight, "theta2"), -0.171_509_541, 1e-9);
    let both = run("clearance-crank", &[("friction", 0.0)], [3e-3, 1e-3, 1e-12]);
    for corner in ["guide_3", "guide_4"] {
        near(corner, times(&both, corner)[0], hits, 1e-12);
    }
    near("impulses", last(&both, "impulses"), 2.0 * 0.055_395_014_883, 1e-10);
}

/// A step of the Geneva wheel, less what the play leaves. Without friction the wheel flies from side to side of the slot, and a
/// contact begins and ends within one of the longest steps, beside other values that pass their limits.
#[test]
fn a_geneva_wheel_with_play_turns_by_a_step() {
    let step = run("geneva-contact", &[], [0.5, 5e-3, 1e-9]);
    near("angle", last(&step, "angle"), -89.987_499_569, 1e-5);
    for end in [0.375, 0.4, 0.5] {
        let free = run("geneva-contact", &[("friction", 0.0)], [end, 0.5e-3, 1e-6]);
        near("angle without friction", last(&free, "angle"), -90.024, 1e-3);
    }
}

/// The geometry of both pawls in the corners of their teeth, and a tooth a swing. The pawls move, by 5e-5 of the force.
#[test]
fn a_ratchet_holds_what_it_has_turned() {
    let [first, second] = [1.0, 2.0].map(|end| run("ratchet", &[], [end, 0.1, 1e-6]));
    near("angle", last(&first, "angle"), -12.851_161_037 + 30.0, 1e-4);
    near("force", last(&first, "holder_force"), 96.446_338_1, 0.01);
    near("a tooth", last(&second, "angle") - last(&first, "angle"), 30.0, 1e-4);
}

/// Another program, with all fifteen teeth.
#[test]
fn an_escapement_ticks() {
    let run = run("escapement", &[], [1.0, 2e-3, 1e-9]);
    near("pendulum", last(&run, "pendulum"), 6.850_240_98, 1e-5);
    near("wheel", last(&run, "wheel"), 24.418_319, 1e-4);
}

/// The lever overtakes the wheel at a quarter of its period, and lets go where the wheel would have to be braked:
/// ω t = π + atan(c/(J ω)).
#[test]
fn a_one_way_clutch_lets_go_where_the_wheel_needs_no_torque() {
    let run = run("one-way-clutch", &[], [3.0, 0.1, 1e-11]);
    let locks = times(&run, "der(lever.angle) > der(wheel.angle)");
    let frees = times(&run, "lambda(freewheel) < 0");
    for (period, t) in [(0, 1.310_380_602_732), (1, 2.310_380_602_732)] {
        near("locks", locks[period + 1], t, 1e-10);
        let lag = (0.025 / (0.02 * std::f64::consts::TAU)).atan() / std::f64::consts::TAU;
        near("lets go", frees[period], 0.5 + lag + period as f64, 1e-10);
    }
    near("wheel", last(&run, "wheel"), 22.866_154_094_235, 1e-8);
}

/// One equation for the angle of the handle, integrated by another program.
#[test]
fn a_toggle_latch_passes_its_dead_centre_and_holds() {
    let run = run("toggle-latch", &[], [2.2, 1e-2, 1e-11]);
    let passes = times(&run, "dead_centre");
    near("shut", passes[0], 0.593_649_694_027, 1e-9);
    near("opened", passes[1], 1.400_812_077_893, 1e-9);
    near("rests", times(&run, "closed")[0], 0.607_993_792_474, 1e-9);
    let held = run.column("clamping").unwrap().values[120];
    near("clamping at 1.2 s", held, 673.926_194_814_6, 1e-6);
}

#[test]
fn a_door_closer_is_opened_and_falls_shut() {
    let run = run("door-closer", &[], [6.5, 0.1, 1e-11]);
    for (row, opening) in [(30, 53.417_420_310_6), (40, 14.122_806_126_4)] {
        near("opening", run.column("opening").unwrap().values[row], opening, 1e-7);
    }
    let hits = [5.293_346_037_943, 5.315_414_197_717, 5.319_475_687_622, 5.320_275_687_123];
    for (found, hit) in times(&run, "frame").into_iter().zip(hits) {
        near("hit", found, hit, 1e-9);
    }
}

/// v √(m/k) √(2 (χ − ln(1 + χ)))/χ, and the motion of both wagons by another program.
#[test]
fn a_bumper_is_pressed_as_its_law_says() {
    let run = run("bumper", &[], [3.0, 1e-3, 1e-10]);
    near("first wagon", last(&run, "speed_1"), -0.621_466_442, 1e-7);
    near("second wagon", last(&run, "speed_2"), -0.828_137_803, 1e-7);
    // samples are up to 0.5 ms beside the deepest place, with 8.3 m/s²
    let first = run.column("compressed").unwrap().values[..800].iter().fold(0.0_f64, |most, x| most.max(*x));
    let chi = 1.5 * (1.0 - 0.4_f64);
    let law = 1.2 * (2e3 / 150e3_f64).sqrt() * (2.0 * (chi - chi.ln_1p())).sqrt() / chi;
    near("pressed", first, 1e3 * law, 1.1e-3);
}

#[test]
fn a_valve_floats_and_closes() {
    let run = run("valve-train", &[], [0.03, 1e-4, 1e-10]);
    let lifts = &run.column("valve_lift").unwrap().values;
    near("lift after 30 ms", lifts[300], 29.542_492_7, 1e-5);
    // the samples are up to 0.05 ms beside the top, with an acceleration of 300 m/s²
    near("top", lifts.iter().fold(0.0_f64, |most, x| most.max(*x)), 29.984_136, 4e-4);
}

/// A cycle sticks for 2 u/v and slides for 2 (π − ψ)/ω, u = (μ₀ − μ) m g/k and tan ψ = ω u/v.
#[test]
fn a_block_sticks_and_slips_in_cycles() {
    let run = run("stick-slip", &[], [3.98, 0.1, 1e-11]);
    let (omega, v, u) = (50.0_f64.sqrt(), 0.1, 0.2 * 2.0 * 9.81 / 100.0);
    let cycle = 2.0 * u / v + 2.0 * (std::f64::consts::PI - (omega * u / v).atan()) / omega;
    let halts: Vec<f64> = times(&run, "grip").into_iter().filter(|t| *t > 0.1).collect();
    for (at, t) in halts.iter().enumerate() {
        near("halts", *t, (at + 1) as f64 * cycle, 1e-9);
    }
    assert_eq!(halts.len(), 2, "{halts:?}");
}

/// Housner (1963): a landing keeps 1 − 3/2 sin²α of the rate. Times are quadratures of the energy.
#[test]
fn a_rocking_block_lands_as_housner_says() {
    let run = run("rocking-block", &[], [3.4, 0.1, 1e-11]);
    let mut lands = [times(&run, "on_left"), times(&run, "on_right")].concat();
    lands.sort_by(f64::total_cmp);
    let expected = [
        0.556_643_362_958,
        1.339_652_810_211,
        1.972_969_322_533,
        2.508_850_936_812,
        2.972_800_967_750,
        3.380_076_205_824,
    ];
    for (found, expected) in lands.into_iter().zip(expected) {
        near("lands", found, expected, 1e-9);
    }
}

/// Goswami, Thuilot and Espiau (1996); the strikes from here on by another program.
#[test]
fn a_compass_walker_comes_to_its_gait() {
    let run = run("compass-walker", &[], [30.0, 0.1, 1e-11]);
    let mut strikes: Vec<f64> = run.occurrences.iter().map(|found| found.t).collect();
    strikes.sort_by(f64::total_cmp);
    for (step, t) in
        [(0, 0.693_796_195_488), (1, 1.440_361_373_352), (9, 7.317_679_276_228), (39, 29.347_961_064_877)]
    {
        near("strikes", strikes[step], t, 1e-8);
    }
    near("period", strikes[39] - strikes[38], 0.734_346_391_159, 1e-8);
}
