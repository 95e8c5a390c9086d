//! Files of robots whose axes, frames and couplings once came out as something else, or not at all.

use std::fs;

use super::imports::{imported, refused, run};
use super::robots::with_accelerations;
use super::{mbs, text};

const INERTIA: &str = "<mass value='1'/><inertia ixx='0.1' iyy='0.1' izz='0.1' ixy='0' ixz='0' iyz='0'/>";

/// The declaration of a file, and the columns of its run of 0.5 s.
#[track_caller]
fn moved(name: &str, content: &str, columns: &[&str]) -> (String, Vec<Vec<f64>>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(name), content).unwrap();
    let declared = imported(folder.path(), &folder.path().join(name));
    let columns: Vec<String> = columns.iter().map(|&column| column.to_owned()).collect();
    let rows = run(folder.path(), "--step 50ms --end 0.5s", &columns);
    (declared, rows)
}

/// The axis of a balanced fan, written with 1.57 for a right angle, was taken as one of the file, and
/// its mass stayed where it was: an arm of 0.8 mm, which tipped. Pinocchio 4.1 has no motion.
#[test]
fn a_mass_on_an_axis_stays_on_it() {
    let fan = "<robot name='fan'><link name='mast'/><link name='fan'><inertial><origin xyz='0 0 1'/><mass value='2'/>\
               <inertia ixx='0.3' iyy='0.3' izz='0.0004' ixy='0' ixz='0' iyz='0'/></inertial></link>\
               <joint name='spin' type='continuous'><parent link='mast'/><child link='fan'/>\
               <origin rpy='1.57 0 0'/><axis xyz='0 0 1'/></joint></robot>";
    let (declared, rows) = moved("fan.urdf", fan, &["spin_angle"]);
    assert!(declared.contains("point spin on fan = (0, 0) [m];"), "{declared}");
    assert!(declared.contains("fan_inertia = 0.0004 [kg*m^2]"), "{declared}");
    assert!(
        declared.contains("// The axis of the joint `spin` (line 1) is off by less than 0.002 rad"),
        "{declared}"
    );
    assert!(rows.iter().all(|row| row[0].abs() < 1e-12), "{rows:?}");
}

/// The angle of a joint that another one follows with an offset was a guess, and moved half of the way.
#[test]
fn a_joint_that_others_follow_starts_where_it_is_drawn() {
    let robot = format!(
        "<robot name='g'><link name='base'/><link name='l'><inertial><origin xyz='0.1 0 0'/>{INERTIA}</inertial></link>\
         <link name='r'><inertial><origin xyz='0.1 0 0'/>{INERTIA}</inertial></link>\
         <joint name='jl' type='continuous'><parent link='base'/><child link='l'/><axis xyz='0 0 1'/></joint>\
         <joint name='jr' type='prismatic'><parent link='base'/><child link='r'/><axis xyz='1 0 0'/>\
         <limit effort='1' velocity='1' lower='-1' upper='1'/>\
         <mimic joint='jl' multiplier='-0.5' offset='0.02'/></joint></robot>"
    );
    let (declared, rows) = moved("g.urdf", &robot, &["jl_angle", "jr_position"]);
    let off = (rows[0][0].abs()).max((rows[0][1] - 0.02).abs());
    assert!(off < 1e-12, "{:?}\n{declared}", rows[0]);
}

/// Each joint of a chain is compared with the one before it: four turns by 1.57 are off by 3 mrad together.
#[test]
fn small_errors_of_axes_do_not_add_up() {
    let mut chain = "<robot name='chain'><link name='l0'/>".to_owned();
    for (above, axis) in ["0 0 -1", "0 -1 0", "0 0 1", "0 1 0"].into_iter().enumerate() {
        let at = above + 1;
        chain += &format!(
            "<link name='l{at}'><inertial><origin xyz='0.5 0 0'/>{INERTIA}</inertial></link>\
             <joint name='j{at}' type='continuous'><parent link='l{above}'/><child link='l{at}'/>\
             <origin xyz='1 0 0' rpy='1.57 0 0'/><axis xyz='{axis}'/></joint>"
        );
    }
    let (declared, _) = moved("chain.urdf", &(chain + "</robot>"), &["j4_angle"]);
    assert!(declared.contains("in its plane x-z.") && declared.contains("dof = 4;"), "{declared}");
}

/// A joint that turns back as far as the one before it turns forth keeps the angle of its body, as in
/// parallel linkages and grippers: "does not couple anything". By hand, with arms of 0.5 m to the first
/// centre and of 1 m to the second body: (0.1 + 0.25 + 1) q'' = 9.81 (0.5 + 1).
#[test]
fn a_body_that_keeps_its_angle_is_imported() {
    let urdf = format!(
        "<robot name='grip'><link name='base'/><link name='a'><inertial><origin xyz='-0.5 0 0'/>{INERTIA}</inertial></link>\
         <link name='b'><inertial><origin xyz='0 0 -0.5'/>{INERTIA}</inertial></link>\
         <joint name='ja' type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 -1 0'/></joint>\
         <joint name='jb' type='continuous'><parent link='a'/><child link='b'/><origin xyz='-1 0 0'/>\
         <axis xyz='0 -1 0'/><mimic joint='ja' multiplier='-1'/></joint></robot>"
    );
    let link = |name: &str, pose: &str, centre: &str| {
        format!(
            "<link name='{name}'><pose>{pose} 0 0 0</pose><inertial><pose>{centre} 0 0 0</pose><mass>1</mass>\
             <inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>"
        )
    };
    let axis = |inside: &str| format!("<axis><xyz>0 -1 0</xyz>{inside}</axis>");
    let sdf = format!(
        "<sdf version='1.11'><world name='w'><gravity>0 0 -9.81</gravity><model name='m'>{}{}\
         <joint name='ja' type='revolute'><parent>world</parent><child>a</child>{}</joint>\
         <joint name='jb' type='revolute'><parent>a</parent><child>b</child>{}</joint></model></world></sdf>",
        link("a", "0 0 0", "-0.5 0 0"),
        link("b", "-1 0 0", "0 0 -0.5"),
        axis(""),
        axis("<mimic joint='ja'><multiplier>-1</multiplier></mimic>"),
    );
    let mjcf = "<mujoco><worldbody><body><joint name='ja' axis='0 -1 0'/>\
                <inertial pos='-0.5 0 0' mass='1' diaginertia='0.1 0.1 0.1'/>\
                <body pos='-1 0 0'><joint name='jb' axis='0 -1 0'/>\
                <inertial pos='0 0 -0.5' mass='1' diaginertia='0.1 0.1 0.1'/></body></body></worldbody>\
                <equality><joint joint1='jb' joint2='ja' polycoef='0 -1 0 0 0'/></equality></mujoco>";
    for (name, content) in [("g.urdf", urdf.as_str()), ("g.sdf", &sdf), ("g.xml", mjcf)] {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join(name), content).unwrap();
        let declared = with_accelerations(folder.path(), &folder.path().join(name));
        assert!(declared.contains("dof = 1;"), "{name}: {declared}");
        let names = ["acc_ja", "ja_angle", "jb_angle"].map(str::to_owned);
        let rows = run(folder.path(), "--step 50ms --end 0.5s", &names);
        let expected = 9.81 * 1.5 / 1.35;
        assert!((rows[0][0] - expected).abs() < 1e-12 * expected, "{name}: {}", rows[0][0]);
        assert!(rows.iter().all(|row| (row[1] + row[2]).abs() < 1e-9), "{name}: {rows:?}");
    }
}

/// A link that no element declares, and that every tool takes for the ground.
#[test]
fn the_world_of_urdf_needs_no_element() {
    let file = format!(
        "<robot name='r'><link name='a'><inertial>{INERTIA}</inertial></link><joint name='j' type='prismatic'>\
         <parent link='world'/><child link='a'/><axis xyz='0 0 1'/></joint></robot>"
    );
    let (declared, rows) = moved("r.urdf", &file, &["j_position"]);
    assert!(!declared.contains("is the ground"), "{declared}");
    let fallen = rows.last().map_or(0.0, |row| row[0]);
    assert!((fallen + 0.5 * 9.81 * 0.25).abs() < 1e-9, "{fallen}");
}

/// A frame that is attached to the world is a place of it, wherever the model stands.
#[test]
fn frames_of_sdf_may_be_attached_to_the_world() {
    let file = "<sdf version='1.11'><model name='m'><pose>5 0 0 0 0 0</pose>\
                <frame name='hook' attached_to='world'><pose>1 0 2 0 0 0</pose></frame>\
                <link name='a'><pose relative_to='hook'>0 0 -1 0 0 0</pose></link>\
                <joint name='j' type='revolute'><pose relative_to='hook'/><parent>hook</parent><child>a</child>\
                <axis><xyz>0 1 0</xyz></axis></joint></model></sdf>";
    let (declared, _) = moved("m.sdf", file, &["j_angle"]);
    assert!(declared.contains("point j on ground = (1, 2) [m];"), "{declared}");
    assert!(declared.contains("point j on a = (0, 1) [m];"), "{declared}");
}

#[test]
fn one_of_several_models_is_imported_by_its_name() {
    let model = |name: &str, axis: &str| {
        format!(
            "<model name='{name}'><link name='{name}_link'/><joint name='j' type='revolute'><parent>world</parent>\
             <child>{name}_link</child><axis><xyz>{axis}</xyz></axis></joint></model>"
        )
    };
    // what the other one has that is refused does not matter
    let one = model("one", "0 1 0").replace("</model>", "<enable_wind>1</enable_wind></model>");
    let file = format!("<sdf version='1.11'>{one}\n{}</sdf>", model("two", "0 0 1"));
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("both.sdf"), &file).unwrap();
    let output = mbs(folder.path(), "import both.sdf --model two");
    let declared = text(output.stdout);
    assert!(declared.contains("body two_link") && !declared.contains("one_link"), "{declared}");
    assert!(
        declared.contains("// Not carried over: the model `one` (line 1), which is not the one wanted."),
        "{declared}"
    );
    assert_eq!(
        refused("both.sdf", &file, "--model tow"),
        "there is no model that moves `tow`, did you mean `two`? (there is one, two)"
    );
    assert_eq!(
        refused("r.urdf", "<robot/>", "--model r"),
        "it has one mechanism; --model is for files of SDF with several models"
    );
}

/// MJCF, URDF and SDF with what their programs read and the standard of XML forbids.
#[test]
fn comments_and_prefixes_that_programs_read_are_read() {
    let file = format!(
        "<!-- drawn 2020 -- by hand -->\n<robot name='r'><link name='base'/><link name='a'><inertial>{INERTIA}</inertial>\
         </link><joint name='j'type='continuous'><parent link='base'/><child link='a'/><axis xyz='0 1 0'/></joint></robot>"
    );
    let (declared, _) = moved("r.urdf", &file, &["j_angle"]);
    assert!(declared.contains("dof = 1;"), "{declared}");
}
