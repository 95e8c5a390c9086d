//! Parts of robot files that the import leaves out, refuses, or once dropped without a note.

use std::fs;

use super::imports::{imported, refused, run};
use super::{mbs, text};

/// The declaration of a file with this content, and what the command says of it.
#[track_caller]
fn of(name: &str, content: &str) -> (String, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), content).unwrap();
    let output = mbs(folder.path(), &format!("import {name} --out linkage.mbs"));
    assert!(output.status.success(), "{}", text(output.stderr));
    (fs::read_to_string(folder.path().join("linkage.mbs")).unwrap(), text(output.stdout))
}

#[track_caller]
fn has_notes(name: &str, content: &str, notes: &[&str]) {
    let (declared, said) = of(name, content);
    for note in notes {
        assert!(said.contains(&format!("note:    {note}\n")), "{note} is not in\n{said}");
        let first: String = note.chars().take(1).flat_map(char::to_uppercase).collect();
        let comment = format!("// {first}{}.\n", note.get(1..).unwrap());
        assert!(declared.contains(&comment), "{comment} is not in\n{declared}");
    }
}

const INERTIA: &str = "<inertial><origin xyz='0 0 -0.5'/><mass value='1'/>\
                       <inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/></inertial>";

/// A pendulum of URDF, with more in its joint and behind it.
fn urdf(in_joint: &str, behind: &str) -> String {
    format!(
        "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><link name='base'/><link name='a'>{INERTIA}</link>\
         <joint name='j' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 1 0'/>{in_joint}\
         </joint>\n{behind}</robot>"
    )
}

/// A pendulum of SDF, with more in its link, in its joint and behind them.
fn sdf(in_link: &str, in_joint: &str, behind: &str) -> String {
    let inertia = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>";
    format!(
        "<sdf version='1.11'><model name='m'><link name='a'><inertial><pose>0 0 -0.5 0 0 0</pose><mass>1</mass>{inertia}\
         </inertial>{in_link}</link><joint name='j' type='revolute'><parent>world</parent><child>a</child>\
         <axis><xyz>0 1 0</xyz></axis>{in_joint}</joint>\n{behind}</model></sdf>"
    )
}

/// An arm of MJCF, with more in its joint and behind its bodies.
fn mjcf(of_joint: &str, behind: &str) -> String {
    format!(
        "<mujoco><worldbody><body name='a'><joint name='j' axis='0 -1 0'{of_joint}/>\
         <geom type='capsule' fromto='0 0 0 .3 0 0' size='.02' rgba='1 0 0 1' user='1'/></body></worldbody>\n\
         {behind}</mujoco>"
    )
}

#[test]
fn what_is_left_out_is_listed_on_the_screen_and_in_the_file() {
    has_notes(
        "f.xml",
        &mjcf(" group='2' dampin='1'", "<visual/><sensor/>"),
        &[
            "not carried over: `dampin` of the joint `j` (line 1), which is not known, did you mean `damping`?",
            "not carried over: groups, and numbers of the user (`group` of joint, `user` of geom)",
            "not carried over: what is measured (`sensor`)",
            "not carried over: what is only seen or sounds (`rgba` of geom, `visual`)",
        ],
    );
    has_notes(
        "f.urdf",
        &urdf("<dynamic damping='1'/>", "<gz:light/><material name='red'/><link_names/>"),
        &[
            "not carried over: `dynamic` in line 1, which is not known, did you mean `dynamics`?",
            "not carried over: `link_names` in line 2, which is not known",
            "not carried over: elements of other programs (`gz:light`)",
            "not carried over: what is only seen (`material`)",
        ],
    );
    has_notes(
        "f.sdf",
        &sdf(
            "<gz:visible>1</gz:visible><heat/>",
            "<physics><ode><cfm_damping>1</cfm_damping></ode></physics>",
            "",
        ),
        &[
            "not carried over: `heat` in line 1, which is not known",
            "not carried over: elements of other programs (`gz:visible`)",
            "not carried over: how engines of physics compute (`cfm_damping`)",
        ],
    );
}

#[test]
fn parts_of_mjcf_that_act_are_refused_by_name() {
    let says = |of_joint: &str, behind: &str, message: &str| {
        assert_eq!(refused("f.xml", &mjcf(of_joint, behind), ""), message);
    };
    let actuator = |inside: &str| format!("<actuator>{inside}</actuator>");
    says(
        " actuatorfrcrange='-0.1 0.1'",
        &actuator("<motor joint='j'/>"),
        "the joint `j` (line 1): `actuatorfrcrange` limits what the motor in line 2 does to it, which is not imported",
    );
    says(
        "",
        &actuator("<motor joint='j' delay='0.1' nsample='3'/>"),
        "the motor in line 2: `delay` = `0.1` is not imported; inputs act at once",
    );
    says(
        "",
        "<default><motor delay='0.1'/></default><actuator><motor joint='j'/></actuator>",
        "the motor in line 2: `delay` = `0.1` is not imported; inputs act at once",
    );
    says("", "<extension/>", "the extension in line 2 is not imported");
    says(
        "",
        "<default><muscle force='2'/></default><actuator><position joint='j'/></actuator>",
        "the position in line 2 has the defaults of a muscle, which are not imported",
    );
    says(
        "",
        "<default><intvelocity kp='2'/></default><actuator><general joint='j'/></actuator>",
        "the general in line 2: `dyntype` of its class is not imported",
    );
}

/// A default that no element has changes nothing.
#[test]
fn defaults_that_no_element_has_are_not_refused() {
    of("f.xml", &mjcf("", "<default><default class='soft'><joint springdamper='1 1'/></default></default>"));
}

#[test]
fn parts_of_urdf_that_act_are_refused_by_name() {
    let says = |in_joint: &str, behind: &str, message: &str| {
        assert_eq!(refused("f.urdf", &urdf(in_joint, behind), ""), message);
    };
    says("", "<loop_joint name='c'/>", "the loop_joint `c` (line 2) is not imported; it acts in Drake");
    says("", "<force_element name='s'/>", "the force_element `s` (line 2) is not imported; it acts in Drake");
    says(
        "",
        "<drake:linear_bushing_rpy/>",
        "the drake:linear_bushing_rpy in line 2 is not imported; it acts in Drake",
    );
    let rotor = |name: &str| {
        format!(
            "<transmission><joint name='j'/><actuator name='m'><{name} value='0.1'/></actuator></transmission>"
        )
    };
    for name in ["drake:rotor_inertia", "rotorInertia"] {
        let message =
            format!("the {name} in line 2 is not imported; the rotor's inertia would turn with the joint");
        says("", &rotor(name), &message);
    }
    let xacro = "it is a part of xacro: run xacro first (`xacro FILE > OUT.urdf`)";
    says(
        "",
        "<xacro:include filename='a'/>",
        &format!("the xacro:include in line 2 is not imported; {xacro}"),
    );
    says("<origin xyz='0 0 ${l}'/>", "", &format!("the origin in line 1 has `0 0 ${{l}}`; {xacro}"));
    says(
        "",
        "<gazebo reference='j'><springStiffness>5</springStiffness></gazebo>",
        "the springStiffness in line 2 is not imported; it acts in Gazebo",
    );
}

#[test]
fn parts_of_sdf_that_act_are_refused_by_name() {
    let says = |in_link: &str, in_joint: &str, behind: &str, message: &str| {
        assert_eq!(refused("f.sdf", &sdf(in_link, in_joint, behind), ""), message);
    };
    says(
        "<enable_wind>true</enable_wind>",
        "",
        "",
        "the enable_wind in line 1 is not imported; a wind would push",
    );
    says(
        "",
        "<drake:rotor_inertia>0.5</drake:rotor_inertia>",
        "",
        "the drake:rotor_inertia in line 1 is not imported; the rotor's inertia would turn with the joint",
    );
    says(
        "",
        "<drake:gear_ratio>3</drake:gear_ratio>",
        "",
        "the drake:gear_ratio in line 1 is not imported; a rotor's inertia would turn with the joint",
    );
    for element in ["drake:linear_bushing_rpy", "drake:ball_constraint", "drake:distance_constraint"] {
        says(
            "",
            "",
            &format!("<{element}/>"),
            &format!("the {element} in line 2 is not imported; it acts in Drake"),
        );
    }
    says(
        "",
        "<gz:child_frame>b</gz:child_frame>",
        "",
        "the gz:child_frame in line 1 is not imported; it moves the joint to another frame; `parent` and `child` may \
         name frames themselves",
    );
    of("f.sdf", &sdf("<enable_wind>false</enable_wind>", "<drake:gear_ratio>1.0</drake:gear_ratio>", ""));
}

/// Until SDF 1.5 the gravity was that of the physics; it was forgotten.
#[test]
fn gravity_of_older_worlds_is_that_of_their_physics() {
    let model = sdf("", "", "").replace("<sdf version='1.11'>", "").replace("</sdf>", "");
    let world = format!(
        "<sdf version='1.4'><world name='w'><physics type='ode'><gravity>0 0 -1.6</gravity></physics>{model}</world></sdf>"
    );
    assert!(of("f.sdf", &world).0.contains("gravity = (0, -1.6) [m/s^2];"));
}

/// Where the arm is after 0.4 s.
#[track_caller]
fn angle_after(content: &str) -> f64 {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("f.xml"), content).unwrap();
    imported(folder.path(), &folder.path().join("f.xml"));
    let rows = run(folder.path(), "--step 100ms --end 0.4s", &["j_angle".to_owned()]);
    rows.last().unwrap()[0]
}

/// The angles are those of MuJoCo 4.0 to the digits that it was printed with.
#[test]
fn what_actuators_add_to_their_joint_moves_as_in_mujoco() {
    let arm = |option: &str, actuator: &str| {
        angle_after(&mjcf("", &format!("<option {option}/><actuator>{actuator}</actuator>")))
    };
    for (option, actuator, angle) in [
        ("", "<motor joint='j'/>", -2.670),
        ("", "<motor joint='j' damping='0.3'/>", -0.677),
        ("", "<motor joint='j' armature='0.05' gear='2'/>", -0.227),
        ("actuatorgroupdisable='1'", "<position joint='j' kp='3' group='1'/>", -2.670),
        ("actuatorgroupdisable='0'", "<position joint='j' kp='3' group='1'/>", -0.0005),
    ] {
        let found = arm(option, actuator);
        assert!((found - angle).abs() < 6e-4, "{option} {actuator}: {found}, MuJoCo has {angle}");
    }
}

/// A pendulum of 2 kg at 0.5 m with actuators and defaults.
fn law(defaults: &str, actuators: &str) -> String {
    of(
        "f.xml",
        &format!(
            "<mujoco><default>{defaults}</default><worldbody><body name='arm'><joint name='p' axis='0 1 0'/>\
             <geom size='0.1' mass='2' pos='0 0 -0.5'/></body></worldbody><actuator>{actuators}</actuator></mujoco>"
        ),
    )
    .0
}

/// MuJoCo 4.0 keeps one law among the defaults of a class, of which each short form sets a part: a gain
/// of 20 is the `kp` of a position, and so on.
#[test]
fn defaults_of_actuators_are_shared_between_their_short_forms() {
    let says = |defaults: &str, actuators: &str, parts: &[&str]| {
        let text = law(defaults, actuators);
        for part in parts {
            assert!(text.contains(part), "{part} is not in\n{text}");
        }
    };
    says(
        "<position kp='40'/>",
        "<general name='g' joint='p'/>",
        &["let g_effort = (40 [N*m])*g + (-40 [N*m/rad])*p_q;"],
    );
    says(
        "<general gainprm='20'/>",
        "<position name='g' joint='p'/>",
        &["let g_effort = (20 [N*m/rad])*g + (-20 [N*m/rad])*p_q;"],
    );
    says(
        "<default class='a'><general gainprm='7' biastype='affine' biasprm='0 -7 -2'/></default>",
        "<motor class='a' name='m' joint='p'/><velocity class='a' name='v' joint='p'/>\
         <position class='a' name='s' joint='p' kp='5'/>",
        &[
            "let m_effort = m;",
            "let v_effort = (7 [N*m*s/rad])*v + (-7 [N*m*s/rad])*der(p_q);",
            "let s_effort = (5 [N*m/rad])*s + (-5 [N*m/rad])*p_q + (-2 [N*m*s/rad])*der(p_q);",
        ],
    );
    says(
        "<general biastype='affine' biasprm='0 -2 -0.1' gainprm='2'/>",
        "<motor name='m' joint='p'/><general name='g' joint='p'/>",
        &[
            "let m_effort = m;",
            "let g_effort = (2 [N*m])*g + (-2 [N*m/rad])*p_q + (-0.1 [N*m*s/rad])*der(p_q);",
        ],
    );
}

/// The weld of bodies without torque was rigid. In MuJoCo it is a `connect` then.
#[test]
fn a_weld_without_torque_is_a_pin() {
    let file = |scale: &str| {
        let body = |name: &str, x: f64| {
            format!(
                "<body name='{name}' pos='{x} 0 0'><joint name='{name}_j' axis='0 1 0'/>\
                 <geom size='0.1' mass='2' pos='0 0 -0.5'/></body>"
            )
        };
        let bodies = body("one", 0.0) + &body("two", 1.0);
        format!(
            "<mujoco><worldbody>{bodies}</worldbody>\
             <equality><weld name='w' body1='one' body2='two' torquescale='{scale}' anchor='-0.5 0 -0.5'/></equality></mujoco>"
        )
    };
    assert!(of("f.xml", &file("1")).0.contains("fixed w (one.w, two.w)"));
    let (pinned, _) = of("f.xml", &file("0"));
    assert!(pinned.contains("revolute w (one.w, two.w);") && pinned.contains("dof = 0;"), "{pinned}");
}
