//! Refusals of files of robots that cannot be imported: one line for each message.

use super::imports::refused;

#[track_caller]
fn of_mjcf(content: &str) -> String {
    refused("f.xml", &format!("<mujoco>{content}</mujoco>"), "")
}

/// A body with a hinge about y, and what else is in it.
fn body(inside: &str) -> String {
    format!("<worldbody><body name='b'><joint name='j' axis='0 1 0'/>{inside}</body></worldbody>")
}

const BALL: &str = "<geom size='1'/>";

#[test]
fn refusals_of_sections_name_the_line() {
    let says = |content: &str, message: &str| assert_eq!(of_mjcf(content), message);
    says(
        "<tendon><fixed/></tendon>",
        "the fixed in line 1 is not imported; tendons pull on several joints at once",
    );
    says(
        "\n<include file='other.xml'/>",
        "the include in line 2 is not imported; it names another file, which is not read; `mj_saveLastXML` of MuJoCo \
         writes a file with its includes in it",
    );
    says("<compiler angle='turns'/>", "the compiler in line 1: `angle` = `turns` is not imported");
    says(
        "<compiler boundmass='3'/>",
        "the compiler in line 1: `boundmass` = `3` is not imported; an attribute of this name changes masses or places",
    );
    says(
        "<compiler inertiafromgeom='x'/>",
        "the compiler in line 1: `inertiafromgeom` = `x` is not imported",
    );
    says("<compiler eulerseq='xy'/>", "the compiler in line 1: `eulerseq` = `xy` is not imported");
    says(
        "<option density='1.2'/>",
        "the option in line 1: `density` = `1.2` is not imported; a fluid would act on the bodies",
    );
    says("<option gravity='0 -9.81'/>", "the option in line 1: `gravity` has 2 numbers, not 3");
    says(
        "<option><flag spring='disable'/></option>",
        "the flag in line 1: `spring` = `disable` is not imported; it takes forces away",
    );
    says("<default><default/></default>", "the default in line 1 has no `class`");
    let deep = 60;
    let nested = "<default class='c'>".repeat(deep) + &"</default>".repeat(deep);
    says(&nested, "the default in line 1 is nested more than 50 deep");
    says("", "nothing in it moves: it has no joint");
    assert_eq!(refused("f.xml", "<a/>", "--format mjcf"), "its root is not `mujoco`");
    assert!(refused("f.xml", "<mujoco><a>", "").starts_with("it is no complete XML: "));
    assert_eq!(
        refused("f.xml", "<mujoco/>", "--unit mm"),
        "its lengths are in m; --unit is for files that leave their unit open"
    );
}

#[test]
fn refusals_of_bodies_and_joints_name_them() {
    let says = |inside: &str, message: &str| assert_eq!(of_mjcf(&body(inside)), message);
    let joint =
        |joint: &str| of_mjcf(&format!("<worldbody>\n<body name='b'>\n{joint}{BALL}</body></worldbody>"));
    let space = "lets its body move through space: it is not planar; two slides and a hinge move in a plane";
    assert_eq!(joint("<freejoint/>"), format!("the freejoint in line 3 {space}"));
    assert_eq!(joint("<joint name='f' type='free'/>"), format!("the joint `f` (line 3) {space}"));
    assert_eq!(
        joint("<joint type='ball'/>"),
        "the joint in line 3 is a ball, which turns about every axis: it is not planar"
    );
    assert_eq!(
        joint("<joint type='rope'/>"),
        "the joint in line 3 is of the type `rope`, which is not known"
    );
    assert_eq!(joint("<joint axis='0 0 0'/>"), "the joint in line 3: its `axis` has no direction");
    assert_eq!(
        joint("<joint axis='0 0 up'/>"),
        "the joint in line 3: `axis` has `up` in the place of a number below 1e9"
    );
    assert_eq!(joint("<joint damping='-1'/>"), "the joint in line 3: its `damping` is negative");
    assert_eq!(
        joint("<joint stiffness='1 2'/>"),
        "the joint in line 3: a `stiffness` that grows with its argument is not imported"
    );
    assert_eq!(
        joint("<joint springdamper='1 1'/>"),
        "the joint in line 3: `springdamper` = `1 1` is not imported; `stiffness` and `damping` say the same"
    );
    assert_eq!(
        joint("<joint class='arm'/>"),
        "the joint in line 3 has the class `arm`, which the file does not have"
    );
    assert_eq!(
        of_mjcf("<worldbody><joint/></worldbody>"),
        "the joint in line 1 is on the ground, which does not move"
    );
    says(
        "<flexcomp/>",
        "the flexcomp in line 1 is not imported; joints make planar mechanisms of bodies that stand in the file themselves",
    );
    says(
        "<body mocap='true'/>",
        "the body in line 1: `mocap` = `true` is not imported; it would be moved from outside",
    );
    says(
        "<body gravcomp='1'/>",
        "the body in line 1: `gravcomp` = `1` is not imported; it would be held against gravity",
    );
    for (way, value) in
        [("quat", "0 0 0 0"), ("axisangle", "0 0 0 1"), ("xyaxes", "1 0 0 1 0 0"), ("zaxis", "0 0 0")]
    {
        says(
            &format!("<body {way}='{value}'/>"),
            &format!("the body in line 1: its `{way}` has no direction"),
        );
    }
    let many = "<body/>".repeat(200);
    says(&many, "it has more than 200 bodies, which is the most that is imported");
    says("", "the body `b` (line 1) moves and has no mass");
}

#[test]
fn refusals_of_masses_name_them() {
    let says = |inside: &str, message: &str| assert_eq!(of_mjcf(&body(inside)), message);
    says("<geom size='1' mass='-1'/>", "the geom in line 1 has a negative mass");
    says(
        "<geom name='g' type='mesh'/>",
        "the geom `g` (line 1) is of the type `mesh`, whose mass is not imported; `inertial` says it",
    );
    says("<geom type='heart'/>", "the geom in line 1 is of the type `heart`, which is not known");
    says(
        "<geom size='1' shellinertia='true'/>",
        "the geom in line 1 is a shell (`shellinertia`), which is not imported",
    );
    says(
        "<geom type='capsule' size='1' fromto='0 0 0 0 0 0'/>",
        "the geom in line 1: its `fromto` has no length",
    );
    says("<geom type='box' size='1 1'/>", "the geom in line 1: a box has 3 positive numbers as its `size`");
    says("<inertial pos='0 0 0'/>", "the inertial in line 1 has no `mass`");
    says("<inertial mass='1'/>", "the inertial in line 1 has no `pos`");
    says(
        "<inertial mass='-1' pos='0 0 0' diaginertia='1 1 1'/>",
        "the inertial in line 1 has a negative mass",
    );
    says(
        "<inertial mass='1' pos='0 0 0'/>",
        "the inertial in line 1 has neither `diaginertia` nor `fullinertia`",
    );
    says(
        "<inertial mass='1' pos='0 0 0' diaginertia='1 -1 1'/>",
        "the body `b` (line 1) has a negative inertia about the plane's normal",
    );
}

#[test]
fn refusals_of_what_is_not_planar_name_the_joint() {
    let says = |inside: &str, message: &str| assert_eq!(of_mjcf(&body(inside)), message);
    says(
        &format!("{BALL}<body><joint name='k' axis='1 0 0'/>{BALL}</body>"),
        "the joint `k` (line 1) turns about (1, 0, 0), and the joint `j` (line 1) about (0, 1, 0): \
         axes that are not parallel make no planar mechanism",
    );
    says(
        &format!("{BALL}<body><joint name='k' type='slide' axis='0 1 0'/>{BALL}</body>"),
        "the joint `k` (line 1) slides along (0, 1, 0), which leaves the plane x-z of the other joints",
    );
    says(
        &format!("<joint name='k' axis='0 1 0'/>{BALL}"),
        "the joint `k` (line 1) follows others on the body `b` (line 1) in a way that is not imported; a body \
         has a hinge, slides at right angles, and a hinge after them or before one",
    );
    let slides = "<joint name='k' type='slide' axis='1 0 0' damping='1'/><joint type='slide' axis='0 0 1'/>";
    says(
        &format!("{BALL}<body>{slides}{BALL}</body>"),
        "the joint `k` (line 1) acts along one of two slides between bodies that both move, which is not imported",
    );
}

#[test]
fn refusals_of_equalities_and_actuators_name_them() {
    let equality = |inside: &str, message: &str| {
        let file = body(&format!("{BALL}<site name='s'/>")) + &format!("\n<equality>{inside}</equality>");
        assert_eq!(of_mjcf(&file), message);
    };
    equality("<flex/>", "the flex in line 2 is not imported; bodies that bend are no mechanism");
    equality("<connect/>", "the connect in line 2 has no `body1`");
    equality("<connect body1='b'/>", "the connect in line 2 has no `anchor`");
    equality(
        "<connect name='c' body1='z' anchor='0 0 0'/>",
        "the connect `c` (line 2) refers to the body `z`, which the file does not have",
    );
    equality("<connect site1='s'/>", "the connect in line 2 has no `site2`");
    equality(
        "<connect site1='s' site2='z'/>",
        "the connect in line 2 refers to the site `z`, which the file does not have",
    );
    equality(
        "<weld site1='s' site2='s'/>",
        "the weld in line 2 joins sites; a weld is imported of bodies alone",
    );
    equality("<joint/>", "the joint in line 2 has no `joint1`");
    equality(
        "<joint joint1='z'/>",
        "the joint in line 2 refers to the joint `z`, which does not move or is not there",
    );
    equality(
        &"<joint joint1='j'/>".repeat(1001),
        "it has more than 1000 closed loops, couplings and actuators, which is the most that is imported",
    );
    let actuator = |inside: &str, message: &str| {
        let file = body(BALL) + &format!("\n<actuator>{inside}</actuator>");
        assert_eq!(of_mjcf(&file), message);
    };
    actuator(
        "<motor site='s'/>",
        "the motor in line 2 has no `joint`; what acts on other things is not imported",
    );
    actuator(
        "<muscle joint='j'/>",
        "the muscle in line 2 is not imported; motor, position, velocity and general are",
    );
    actuator(
        "<position joint='j' dampratio='1'/>",
        "the position in line 2: `dampratio` = `1` is not imported",
    );
    for (attribute, value) in [("dyntype", "filter"), ("gaintype", "affine"), ("biastype", "muscle")] {
        actuator(
            &format!("<general joint='j' {attribute}='{value}'/>"),
            &format!("the general in line 2: `{attribute}` = `{value}` is not imported"),
        );
    }
}

#[test]
fn refusals_of_urdf_name_the_part() {
    let mass = "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>";
    let arm = format!("<link name='w'/><link name='a'>{mass}</link>");
    let joint = |kind: &str, inside: &str| {
        format!("{arm}\n<joint name='j' type='{kind}'><parent link='w'/><child link='a'/>{inside}</joint>")
    };
    let says = |content: &str, message: &str| {
        assert_eq!(refused("f.urdf", &format!("<robot>{content}</robot>"), ""), message);
    };
    says("", "no link is the root of a tree");
    says("<link/>", "the link in line 1 has no `name`");
    says("<link name='w'/><link name='w'/>", "the link `w` (line 1) is there twice");
    says(&arm, "the links `a` and `w` hang on no joint: one of them would be the ground");
    says(&format!("{arm}<joint/>"), "the joint in line 1 has no `parent` with a link");
    says(
        &joint("fixed", "").replace("parent link='w'", "parent link='z'"),
        "the joint `j` (line 2) refers to the link `z`, which the file does not have",
    );
    let second = "<joint name='k' type='fixed'><parent link='w'/><child link='a'/></joint>";
    says(
        &format!("{}{second}", joint("fixed", "")),
        "the joint `k` (line 2): its child `a` has another parent already, and URDF has trees alone",
    );
    says(
        &format!("{}{}", joint("fixed", ""), second.replace("'k'", "'j'")),
        "the joint `j` (line 2) is there twice",
    );
    let circle = joint("fixed", "").replace("parent link='w'", "parent link='a'");
    says(&circle, "the joint `j` (line 2) is in a circle of joints, and URDF has trees alone");
    says(&joint("floating", ""), "the joint `j` (line 2) lets its link move through space: it is not planar");
    says(&joint("screw", ""), "the joint `j` (line 2) is of the type `screw`, which is not imported");
    says(&joint("revolute", "<axis xyz='0 0 0'/>"), "the joint `j` (line 2): its `axis` has no direction");
    says(&joint("revolute", "<dynamics damping='-1'/>"), "the joint `j` (line 2): its `damping` is negative");
    says(&joint("revolute", "<mimic/>"), "the joint `j` (line 2) has a `mimic` without its `joint`");
    says(&joint("revolute", "<origin rpy='1 2'/>"), "the joint `j` (line 2): `rpy` has 2 numbers, not 3");
    says(
        &joint("revolute", "").replace("value='1'", "value='-1'"),
        "the link `a` (line 1) has a negative mass",
    );
    says(
        &joint("revolute", "").replace("<mass value='1'/>", ""),
        "the link `a` (line 1) has no value of its `mass`",
    );
    says(&joint("revolute", "").replace(mass, ""), "the link `a` (line 1) moves and has no mass");
    let drive = |inside: &str| format!("{}<transmission>{inside}</transmission>", joint("revolute", ""));
    says(&drive(""), "the transmission in line 2 has no `joint` with a name");
    says(
        &drive("<joint name='j'/><joint name='j'/>"),
        "the transmission in line 2 drives more than one joint, which is not imported",
    );
    assert_eq!(refused("f.xml", "<a/>", "--format urdf"), "its root is not `robot`");
}
