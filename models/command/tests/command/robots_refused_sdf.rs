//! Refusals of files of SDF that cannot be imported.

use super::imports::refused;

#[track_caller]
fn of_sdf(content: &str) -> String {
    refused("f.sdf", &format!("<sdf version='1.11'>{content}</sdf>"), "")
}

#[track_caller]
fn of_model(content: &str) -> String {
    of_sdf(&format!("<model name='m'>{content}</model>"))
}

const LINKS: &str = "<link name='a'/><link name='b'/>";

/// A joint of a model in its second line.
fn joint(kind: &str, inside: &str) -> String {
    format!("{LINKS}\n<joint name='j' type='{kind}'><parent>a</parent><child>b</child>{inside}</joint>")
}

#[test]
fn refusals_of_scenes_name_the_model() {
    let says = |content: &str, message: &str| assert_eq!(of_sdf(content), message);
    assert_eq!(refused("f.sdf", "<sdf><model/></sdf>", ""), "the sdf has no `version`");
    for version in ["1.2", "2.0", "new"] {
        assert_eq!(
            refused("f.sdf", &format!("<sdf version='{version}'/>"), ""),
            format!("the sdf is of the version `{version}`; those from 1.3 on are imported")
        );
    }
    assert_eq!(refused("f.xml", "<a/>", "--format sdf"), "its root is not `sdf`");
    assert_eq!(
        refused("f.sdf", "<sdf/>", "--unit mm"),
        "its lengths are in m; --unit is for files that leave their unit open"
    );
    says("", "it has no model that moves");
    says("<world name='w'/>\n<world name='v'/>", "the world `v` (line 2) is the second one of the file");
    says(
        "<model name='m'/>\n<model name='n'/>",
        "the model `n` (line 2) moves besides the model `m` (line 1); one model of a file is imported: --model NAME \
         says which one",
    );
    let include = "the include in line 1 names the other file `model://arm`, which is not read; `gz sdf -p` prints a \
                   file with its includes in it";
    let uri = "<include><uri>model://arm</uri></include>";
    says(uri, include);
    says(&format!("<world name='w'>{uri}</world>"), include);
    assert_eq!(of_model(uri), include);
    says(
        "<world name='w'><gravity>0 -9.8</gravity></world>",
        "the world `w` (line 1): `gravity` has 2 numbers, not 3",
    );
    says(
        "<world name='w'><joint name='j'/></world>",
        "the joint `j` (line 1) is in the world; joints are imported that are in the model, with the parent `world`",
    );
    says(
        "<model name='m'><static>true</static></model>",
        "the model `m` (line 1) is static: nothing in it moves",
    );
    says(
        "<model name='m'><pose relative_to='n'>1 0 0 0 0 0</pose><link name='a'/></model>",
        "the model `m` (line 1): its pose is relative to `n`; only `world` is imported there",
    );
    says(
        "<model name='m' canonical_link='z'><link name='a'/></model>",
        "the model `m` (line 1) has no link `z`, its `canonical_link`",
    );
}

#[test]
fn refusals_of_links_and_frames_name_them() {
    let says = |content: &str, message: &str| assert_eq!(of_model(content), message);
    says("", "the model `m` (line 1) has no link with a name");
    says(
        "<link name='a'/><model name='n'/>",
        "the model `n` (line 1) is in another model, which is not imported; its links and joints may stand in that one",
    );
    says("<link name='a'/><frame/>", "the frame in line 1 has no `name`");
    says("<link name='world'/>", "the link `world` (line 1) has a name that SDF keeps for itself");
    says(
        "<link name='a'/>\n<frame name='a'/>",
        "the frame `a` (line 2) has the name of the link `a` (line 1)",
    );
    let many: String = (0..1000).map(|at| format!("<frame name='f{at}'/>")).collect();
    says(
        &format!("<link name='a'/>{many}"),
        "it has more than 1000 links, joints and frames, which is the most that is imported",
    );
    let revolute = joint("revolute", "<axis><xyz>0 1 0</xyz></axis>");
    let with = |frame: &str| format!("{revolute}{frame}");
    says(
        &with("<frame name='f'><pose relative_to='z'/></frame>"),
        "the frame `f` (line 2) refers to `z`, which is no link, joint or frame of the model",
    );
    let [f, g] = ["fg", "gf"].map(|names| {
        let (name, other) = names.split_at(1);
        format!("<frame name='{name}' attached_to='{other}'/>")
    });
    says(&with(&format!("{f}{g}")), "the frame `f` (line 2): frames are attached to each other in a circle");
    says(
        &with(&f).replace(
            "<link name='b'/>",
            "<link name='b'><pose relative_to='g'/></link><frame name='g'><pose relative_to='b'/></frame>",
        ),
        "the joint `j` (line 2): the poses of frames refer to each other in a circle",
    );
    let pose = |pose: &str| revolute.replace("<link name='b'/>", &format!("<link name='b'>{pose}</link>"));
    says(&pose("<pose>1 2 3</pose>"), "the link `b` (line 1): `pose` has 3 numbers, not 6");
    says(
        &pose("<pose rotation_format='quat_xyzw'>0 0 0 0 0 0 0</pose>"),
        "the link `b` (line 1): the quaternion of its `pose` has no direction",
    );
    says(
        &pose("<gravity>0</gravity>"),
        "the link `b` (line 1) is without gravity and the link `a` (line 1) is not, which is not imported; all links or none are",
    );
    says(
        &pose("<kinematic>1</kinematic>"),
        "the link `b` (line 1) is moved from outside (`kinematic`), which is not imported",
    );
    says(&pose("<inertial><mass>-1</mass></inertial>"), "the link `b` (line 1) has a negative mass");
    says(&pose("<inertial><mass>0</mass></inertial>"), "the link `b` (line 1) moves and has no mass");
    says(
        &pose("<inertial auto='true'/>"),
        "the link `b` (line 1) has the inertia of its shapes (`auto`), which is not imported; numbers may stand there",
    );
    says(
        &pose("<inertial><fluid_added_mass/></inertial>"),
        "the link `b` (line 1): the fluid_added_mass in line 1 is not imported",
    );
}

#[test]
fn refusals_of_joints_of_sdf_name_them() {
    let says = |content: &str, message: &str| assert_eq!(of_model(content), message);
    let y = "<axis><xyz>0 1 0</xyz></axis>";
    let of_kind =
        |kind: &str, message: &str| says(&joint(kind, y), &format!("the joint `j` (line 2) {message}"));
    of_kind("screw", "is a screw, which slides along the axis about which it turns: it is not planar");
    of_kind("universal", "(universal) turns about two axes: it is not planar");
    of_kind("revolute2", "(revolute2) turns about two axes: it is not planar");
    of_kind("rope", "is of the type `rope`, which is not known");
    of_kind("ball", "is a ball, and no other joint keeps the link `b` in a plane");
    of_kind("gearbox", "has no `gearbox_reference_body`");
    let revolute = |inside: &str, message: &str| {
        says(&joint("revolute", inside), &format!("the joint `j` (line 2){message}"));
    };
    revolute("", " has no `axis`");
    revolute("<axis><xyz>0 0 0</xyz></axis>", ": its `axis` has no direction");
    revolute("<axis><xyz>0 1</xyz></axis>", ": `xyz` has 2 numbers, not 3");
    revolute(
        "<axis><xyz expressed_in='z'>0 1 0</xyz></axis>",
        " refers to `z`, which is no link, joint or frame of the model",
    );
    let dynamics = |inside: &str| format!("<axis><xyz>0 1 0</xyz><dynamics>{inside}</dynamics></axis>");
    revolute(&dynamics("<damping>-1</damping>"), ": its `damping` is negative");
    revolute(&dynamics("<spring_stiffness>-1</spring_stiffness>"), ": its `spring_stiffness` is negative");
    revolute(
        "<axis><limit><lower>low</lower></limit></axis>",
        ": `lower` has `low` in the place of a number",
    );
    let mimic = |mimic: &str| format!("<axis><xyz>0 1 0</xyz>{mimic}</axis>");
    revolute(&mimic("<mimic/>"), " has a `mimic` without its `joint`");
    revolute(
        &mimic("<mimic joint='k' axis='axis2'/>"),
        " mimics another axis than the first one, which is not imported",
    );
    revolute(&mimic("<mimic joint='k'/>"), " refers to the joint `k`, which does not move or is not there");
    let ends = |from: &str, to: &str, message: &str| {
        says(&joint("fixed", "").replace(from, to), &format!("the joint `j` (line 2){message}"));
    };
    ends("<child>b</child>", "", " has no `child`");
    ends("<parent>a</parent>", "<parent/>", " has no `parent`");
    ends("<child>b", "<child>z", " refers to `z`, which is no link, joint or frame of the model");
    ends("<child>b", "<child>world", " has the world as its child; it is the parent, and the link the child");
    ends("<child>b", "<child>a", " joins the link `a` with itself");
    let reaches = |parent: &str, ground: &str| {
        let file =
            joint("revolute", y).replace("<parent>a", &format!("<parent>{parent}")) + "<link name='c'/>";
        says(&file, &format!("the link {ground}, which is the ground"));
    };
    reaches("world", "`a` (line 1): no joint leads from it to the world");
    reaches("a", "`c` (line 2): no joint leads from it to the link `a`");
    let gears = |from: &str| {
        let gears = "<parent>a</parent><child>b</child><gearbox_reference_body>a</gearbox_reference_body>";
        joint("revolute", y) + &format!("\n<joint name='g' type='gearbox'>{gears}{from}</joint>")
    };
    says(&gears(""), "the joint `g` (line 3) has no `axis`");
    says(&gears(y), "the joint `g` (line 3): `a` has no hinge about its `axis` to the reference body `a`");
    let many: String = (0..201)
        .map(|at| {
            format!(
                "<link name='l{at}'/><joint name='j{at}' type='fixed'><parent>world</parent><child>l{at}</child></joint>"
            )
        })
        .collect();
    says(&many, "it has more than 200 bodies, which is the most that is imported");
}

/// A joint whose limits are both zero is how files fixed links before there were fixed joints.
#[test]
fn a_hinge_without_a_way_is_fixed() {
    let limits = "<axis><xyz>1 2 3</xyz><limit><lower>0</lower><upper>0</upper></limit></axis>";
    assert_eq!(of_model(&joint("revolute", limits)), "nothing in it moves: it has no joint");
}
