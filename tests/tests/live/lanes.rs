//! A run of a pack that cannot go on ends as it does alone, and the others go on.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use mbs_live::{LANES, Live, Pack, Run, Text};
use mbs_runtime::equations::At;
use mbs_runtime::{Error, System};

const H: f64 = 1e-3;

fn compiled(text: &str) -> Live {
    Text::declaration("mechanism.mbs", text).compile().unwrap()
}

/// A disc that a torque turns which depends on its angle.
fn disc() -> Live {
    compiled(
        "Disc {
            dof = 1;
            param stiffness = 3 [N*m];
            input push [N*m];
            body disc (theta) { inertia = 2 [kg*m^2]; }
            torque turn on disc = push - stiffness*sin(theta);
            start { theta = 0.1; }
            output load [N*m] = push - stiffness*sin(theta);
        }",
    )
}

/// A crank that drives a rod, which some lengths let pass and others do not.
fn crank() -> Live {
    compiled(
        "Crank {
            dof = 0;
            param r = 60 [mm];
            param l = 180 [mm];
            param offset = 0 [mm];
            body crank (theta) { inertia = 1e-3 [kg*m^2]; }
            body rod (phi) { inertia = 2e-3 [kg*m^2]; }
            body slider (x) { mass = 2 [kg]; }
            constraint guide: r*sin(theta) + l*sin(phi) = offset;
            constraint pin: x = r*cos(theta) + l*cos(phi);
            drive speed: theta = 20 [rad/s]*t;
            start { guess x = r + l; }
            output torque [N*m] = effort(speed);
        }",
    )
}

/// The steps, time, state, growth and violations of a run.
fn told(run: &Run) -> (u64, f64, Vec<f64>, f64, [f64; 2]) {
    let n = run.equations().info().coordinates.len();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    run.state(&mut q, &mut v);
    q.extend(v);
    (run.steps(), run.time(), q, run.worst_growth(), run.violations())
}

#[test]
fn a_run_that_gets_stuck_ends_as_it_does_alone() {
    let crank = crank();
    let run = |lane: usize| {
        let offset = 5e-3 * lane as f64;
        Run::builder(&crank.with_parameters(|values| values[2] = offset).unwrap(), H).build().unwrap()
    };
    let mut pack = Pack::new((0..LANES).map(run).collect()).map_err(|_| ()).unwrap();
    let mut ends: Vec<Option<(u64, Error)>> = vec![None; LANES];
    for step in 0..400 {
        for (lane, error) in pack.step() {
            assert!(ends[lane].is_none() && !pack.goes_on(lane));
            ends[lane] = Some((step, error));
        }
    }
    let together = pack.into_runs();
    for (lane, (found, end)) in together.iter().zip(&ends).enumerate() {
        let mut alone = run(lane);
        let expected = alone.advance(400).err().map(|error| (alone.steps(), error));
        assert_eq!(*end, expected, "{lane}");
        assert_eq!(told(found), told(&alone), "{lane}");
    }
    let stuck = ends.iter().flatten().count();
    assert!((2..LANES - 10).contains(&stuck), "{stuck}");
    assert!(ends.iter().flatten().any(|(_, error)| matches!(error, Error::OutOfReach { .. })));
}

#[test]
fn what_lanes_cannot_compute_is_computed_alone() {
    let disc = disc();
    // the last one is beyond the sines of lanes
    let starts = [[0.1, 0.0], [2.0, 1.0], [1.1e5, 1.0]];
    let run = |[q, v]: [f64; 2]| {
        Run::builder(&disc, H).inputs(&[0.5]).from_state(At { t: 0.0, q: &[q], v: &[v] }).build().unwrap()
    };
    let mut pack = Pack::new(starts.map(run).into()).map_err(|_| ()).unwrap();
    let mut alone = starts.map(run);
    let mut rows = [[0.0; LANES]; 2];
    for step in 0..100 {
        if step == 50 {
            pack.set_inputs(1, &[-2.0]);
            alone[1].set_inputs(&[-2.0]);
        }
        assert_eq!(pack.step(), []);
        assert_eq!(pack.observe(&mut rows), []);
        for (lane, run) in alone.iter_mut().enumerate() {
            run.step().unwrap();
            let ([mut q, mut v], mut load) = ([[0.0]; 2], [0.0]);
            run.state(&mut q, &mut v);
            run.outputs(&[0.0], &[], &mut load).unwrap();
            assert_eq!([rows[0][lane], rows[1][lane]], [q[0], load[0]]);
        }
    }
    for (found, expected) in pack.into_runs().iter().zip(&alone) {
        assert_eq!(told(found), told(expected));
    }
}

#[test]
fn an_output_that_is_no_number_ends_its_run() {
    let rooted = compiled(
        "Root {
            dof = 1;
            body mass (x) { mass = 1 [kg]; }
            start { x = 2 [mm]; der(x) = -1 [m/s]; }
            output root = sqrt(x/(1 [m]));
        }",
    );
    let run =
        |x: f64| Run::builder(&rooted, H).from_state(At { t: 0.0, q: &[x], v: &[-1.0] }).build().unwrap();
    let mut pack = Pack::new(vec![run(1.0), run(1.5e-3)]).map_err(|_| ()).unwrap();
    let mut rows = [[0.0; LANES]; 2];
    assert_eq!((pack.step(), pack.observe(&mut rows)), (vec![], vec![]));
    assert_eq!(pack.step(), []);
    let ended = pack.observe(&mut rows);
    assert!(matches!(ended[..], [(1, Error::Undefined { name: "root", .. })]), "{ended:?}");
    assert!(pack.goes_on(0) && !pack.goes_on(1) && !pack.goes_on(2));
    assert_eq!((pack.step(), pack.observe(&mut rows)), (vec![], vec![]));
    let steps: Vec<u64> = pack.into_runs().iter().map(System::steps).collect();
    assert_eq!(steps, [3, 2]);
}

#[test]
fn runs_of_a_pack_are_of_one_kind() {
    let (disc, other) = (disc(), disc());
    let run = |mechanism| Run::builder(mechanism, H).build().unwrap();
    assert!(Pack::new(vec![]).is_err());
    let many: Vec<Run> = (0..=LANES).map(|_| run(&disc)).collect();
    assert_eq!(Pack::new(many).err().map(|runs| runs.len()), Some(LANES + 1));
    assert!(Pack::new(vec![run(&disc), run(&other)]).is_err());
    let copy = disc.with_parameters(|values| values[0] = 4.0).unwrap();
    assert!(Pack::new(vec![run(&disc), run(&copy)]).is_ok());
}
