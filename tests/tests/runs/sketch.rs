//! Pictures: what a mechanism tells of its shape, where its points are, and
//! that every body gets into figures and pages.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{Mechanism, State, mechanism};
use mbs_workbench::figure::{Figure, Save};
use mbs_workbench::picture::Shape;
use mbs_workbench::report::{Animation, Block, Report, Section};
use mbs_workbench::{Motion, Picture, Settings, model};

mechanism! {
    /// An arm on a cart, a spring, a rod and a slot.
    pub Everything {
        dof = 2;
        param l = 2 [m];
        gravity = (0, -9.81) [m/s^2];

        body cart (x) { mass = 5 [kg]; }
        body arm (xa, ya, phi) { mass = 1 [kg]; inertia = 0.4 [kg*m^2]; }
        body pin (xp, yp) { mass = 0.5 [kg]; }
        body flywheel (psi) { inertia = 0.1 [kg*m^2]; }
        point top on arm = (-l/2, 0);
        point eye on arm = (l/2, 0);
        point side on arm = (0, 0.5 [m]);
        point wall on ground = (-3, 1) [m];

        revolute hinge (cart, arm.top);
        point_on_line slot (pin, arm.side) along (0, 2 [m]);
        distance rod (pin, ground.wall) = 4 [m];
        spring bumper (ground.wall, cart) { stiffness = 50 [N/m]; length = 3 [m]; }
        torsion_spring twist (arm, ground) { stiffness = 1 [N*m]; angle = 0; }
        drive turn: psi = 2 [rad/s]*t;
        start { x = 0.2 [m]; phi = -60 [deg]; guess xa = 0.7 [m]; guess ya = -0.8 [m]; guess xp = 0.8 [m]; guess yp = 0.5 [m]; }
    }
}

#[test]
fn a_sketch_has_bodies_points_joints_and_springs() {
    let sketch = <Everything>::SKETCH;
    let name = |at: usize| sketch.points[at];
    let bodies: Vec<_> = sketch
        .bodies
        .iter()
        .map(|body| (body.name, body.points.iter().map(|&at| name(at)).collect::<Vec<_>>()))
        .collect();
    assert_eq!(
        bodies,
        [
            ("cart", vec!["cart"]),
            ("arm", vec!["arm", "arm.top", "arm.eye", "arm.side"]),
            ("pin", vec!["pin"]),
            ("flywheel", vec!["flywheel"]),
        ]
    );
    assert_eq!(sketch.ground.iter().map(|&at| name(at)).collect::<Vec<_>>(), ["ground", "ground.wall"]);
    let joints: Vec<_> = sketch
        .joints
        .iter()
        .map(|j| (j.name, j.kind, name(j.first), name(j.second), j.ahead.is_some()))
        .collect();
    assert_eq!(
        joints,
        [
            // bodies that lack coordinates are guided by the ground
            ("cart", "prismatic", "cart", "ground", true),
            ("flywheel", "revolute", "flywheel", "ground", false),
            ("hinge", "revolute", "cart", "arm.top", false),
            ("slot", "point_on_line", "pin", "arm.side", true),
            ("rod", "distance", "pin", "ground.wall", false),
        ]
    );
    let springs: Vec<_> =
        sketch.springs.iter().map(|s| (s.name, s.kind, name(s.first), name(s.second))).collect();
    assert_eq!(
        springs,
        [("bumper", "spring", "ground.wall", "cart"), ("twist", "torsion_spring", "arm", "ground")]
    );
}

#[test]
fn points_are_where_their_bodies_carry_them() {
    let mechanism = Everything::declared();
    let State { mut q, .. } = mechanism.declared_start();
    (q.x, q.xa, q.ya, q.phi, q.xp, q.yp, q.psi) = (0.7, 1.5, -0.25, 0.9, 2.5, 3.5, 0.1);
    let places = mechanism.points(0.0, &q);
    let sketch = <Everything>::SKETCH;
    let (s, c) = 0.9_f64.sin_cos();
    let slot = sketch.joints.iter().find(|joint| joint.name == "slot").and_then(|joint| joint.ahead);
    let rail = sketch.joints.iter().find(|joint| joint.name == "cart").and_then(|joint| joint.ahead);
    let known = |name: &str| sketch.points.iter().position(|other| *other == name);
    let expected = [
        (known("cart"), [0.7, 0.0]),
        (known("arm"), [1.5, -0.25]),
        (known("arm.top"), [1.5 - c, -0.25 - s]),
        (known("arm.eye"), [1.5 + c, -0.25 + s]),
        (known("arm.side"), [1.5 - 0.5 * s, -0.25 + 0.5 * c]),
        (known("pin"), [2.5, 3.5]),
        (known("flywheel"), [0.0, 0.0]),
        (known("ground"), [0.0, 0.0]),
        (known("ground.wall"), [-3.0, 1.0]),
        // from the side 2 m on along the arm's own y axis; along the x axis
        (slot, [1.5 - 2.5 * s, -0.25 + 2.5 * c]),
        (rail, [1.0, 0.0]),
    ];
    assert_eq!(expected.len(), places.len());
    for (at, place) in expected {
        let at = at.expect("the point exists");
        // numbers below 4, rounded in two rotations and a few sums, here and there
        let off = (places[at][0] - place[0]).hypot(places[at][1] - place[1]);
        assert!(off <= 8.0 * f64::EPSILON * 4.0, "{}: {:?} against {place:?}", sketch.points[at], places[at]);
    }
}

fn motion<M: Mechanism<Real = f64>>(end: f64) -> Motion {
    let model = model::of::<M>();
    let settings = Settings { end, ..Settings::default() };
    let recording = model.simulate(&settings, &mut |_, _| ()).expect("it runs");
    assert!(recording.ended.is_none());
    model.motion(&settings, &recording).expect("the settings are good")
}

#[test]
fn every_body_and_joint_is_drawn() {
    let picture = Picture::of(&motion::<Everything>(0.5));
    let count = |wanted: fn(&Shape) -> bool| picture.shapes.iter().filter(|shape| wanted(shape)).count();
    assert_eq!(count(|s| matches!(s, Shape::Plate { .. })), 1, "the arm");
    assert_eq!(count(|s| matches!(s, Shape::Block { .. })), 2, "cart and pin");
    assert_eq!(count(|s| matches!(s, Shape::Dot { .. })), 1, "the flywheel");
    assert_eq!(count(|s| matches!(s, Shape::Link { .. })), 1);
    assert_eq!(count(|s| matches!(s, Shape::Spring { .. })), 1);
    assert_eq!(count(|s| matches!(s, Shape::Coil { .. })), 1);
    assert_eq!(count(|s| matches!(s, Shape::Mark { .. })), 0, "all kinds are known");
    let folder = tempfile::tempdir().expect("a folder");
    for file in ["mechanism.svg", "mechanism.png"] {
        Figure::mechanism("everything", picture.clone())
            .save(&folder.path().join(file))
            .expect("it is drawn");
    }
    let svg = std::fs::read_to_string(folder.path().join("mechanism.svg")).expect("the file");
    let animation = Animation { title: String::new(), picture, readouts: Vec::new() };
    let section = Section::new("Motion").with(Block::Animation(animation));
    let page = Report { sections: vec![section], ..Report::default() }.html().expect("a page");
    for body in <Everything>::SKETCH.bodies {
        assert!(svg.contains(body.name), "{} is not in the figure", body.name);
        assert!(page.contains(&format!("\"text\":\"{}\"", body.name)), "{} is not in the page", body.name);
    }
    assert!(!svg.contains("NaN"));
}

#[test]
fn joints_written_as_equations_are_seen() {
    let motion = motion::<models::SliderCrank>(0.3);
    let picture = Picture::of(&motion);
    let at = |name: &str| motion.sketch.points.iter().position(|point| *point == name).expect("a point");
    let pins: Vec<usize> =
        picture.shapes.iter().filter(|s| matches!(s, Shape::Pin { .. })).flat_map(Shape::points).collect();
    for name in ["crank.base", "crank.tip", "rod.tip"] {
        assert!(pins.contains(&at(name)), "{name}");
    }
    let grounds: Vec<usize> =
        picture.shapes.iter().filter(|s| matches!(s, Shape::Ground { .. })).flat_map(Shape::points).collect();
    assert_eq!(grounds, [at("crank.base")]);
}

mechanism! {
    /// A bead that rests where everything else is.
    pub Rest {
        dof = 2;
        body bead (x, y) { mass = 1 [kg]; }
        spring s (bead, ground) { stiffness = 1 [N/m]; length = 0.1 [m]; }
        start { x = 0.1 [m]; }
    }
}

#[test]
fn a_mechanism_at_one_place_still_draws() {
    let mut motion = motion::<Rest>(0.1);
    motion.places.iter_mut().flatten().for_each(|place| *place = [0.25, 0.25]);
    let picture = Picture::of(&motion);
    let extent = picture.extent();
    assert!(extent.size().iter().all(|side| side.is_finite() && *side > 0.0), "{extent:?}");
    let figure = Figure::mechanism("rest", picture);
    let svg = figure.svg().expect("it is drawn");
    assert!(svg.contains("bead") && !svg.contains("NaN") && !svg.contains("inf"));
    assert!(figure.png().is_ok());
    // nothing at all is no panic either
    let nothing = Motion { times: Vec::new(), places: Vec::new(), ..motion };
    assert!(Figure::mechanism("nothing", Picture::of(&nothing)).svg().is_ok());
}

mechanism! {
    /// A chain of forty rods.
    pub Chain {
        dof = 40;
        const N = 40;
        param l = 0.1 [m];
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=N {
            body link[i] (x[i], y[i], theta[i]) { mass = 1 [kg]; inertia = l^2/12*1 [kg]; }
            point base on link[i] = (-l/2, 0);
            point tip on link[i] = (l/2, 0);
            if i == 1 { revolute pin[i] (link[i].base, ground); } else { revolute pin[i] (link[i].base, link[i-1].tip); }
        }
    }
}

#[test]
fn a_long_chain_stays_a_small_picture() {
    let motion = motion::<Chain>(0.1);
    assert_eq!(motion.sketch.points.len(), 121);
    // of 201 recorded instants, as many as give 12 000 places
    assert_eq!(motion.times.len(), 99);
    let picture = Picture::of(&motion);
    // only the free end leaves a path, and no names cover the links
    assert_eq!(picture.traced.len(), 1);
    assert!(!picture.shapes.iter().any(|shape| matches!(shape, Shape::Label { .. })));
    let animation = Animation { title: String::new(), picture, readouts: Vec::new() };
    let with = |blocks: Vec<Block>| Report {
        sections: vec![Section { heading: String::new(), blocks }],
        ..Report::default()
    };
    let size = |report: Report| report.html().expect("a page").len();
    let added = size(with(vec![Block::Animation(animation)])) - size(with(Vec::new()));
    // 12 000 places of two numbers with at most five digits, commas and brackets
    assert!(added < 12_000 * 15 + 20_000, "{added} bytes");
}
