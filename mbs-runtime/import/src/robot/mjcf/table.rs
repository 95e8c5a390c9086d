//! Fate of each element and each attribute of MJCF, with the names of `mjcf.schema` of MuJoCo.

use crate::robot::table::Fate::{Left, Read, Refused, Whole};
use crate::robot::table::{Fate, Row};

const LOOKS: Fate = Left("what is only seen or sounds");
const CONTACTS: Fate = Left("how bodies touch");
const LIMITS: Fate = Left("limits of motions and efforts");
const SOLVING: Fate = Left("how the program computes");
const BOOKS: Fate = Left("groups, and numbers of the user");
const OUTSIDE: &str = "an attribute of this name changes masses or places";
const SPACE: &str = "joints make planar mechanisms of bodies that stand in the file themselves";
const TENDONS: &str = "tendons pull on several joints at once";

pub(super) const ROWS: &[Row] = &[
    ("mujoco", Read, &[("model", Read)]),
    (
        "compiler",
        Read,
        &[
            ("angle eulerseq inertiafromgeom settotalmass", Read),
            ("coordinate", Refused("local", OUTSIDE)),
            ("boundmass boundinertia", Refused("0", OUTSIDE)),
            ("balanceinertia fitaabb discardvisual alignfree", Refused("false", OUTSIDE)),
            ("inertiagrouprange", Refused("0 5", OUTSIDE)),
            ("autolimits", LIMITS),
            ("strippath meshdir texturedir assetdir", Left("files beside it")),
            ("usethread fusestatic saveinertial conflict convexhull exactmeshinertia", SOLVING),
        ],
    ),
    ("lengthrange", LIMITS, &[]),
    (
        "option",
        Read,
        &[
            ("gravity actuatorgroupdisable", Read),
            ("density viscosity", Refused("0", "a fluid would act on the bodies")),
            ("wind magnetic", Left("what a fluid or a sensor would feel")),
            ("o_margin o_solref o_solimp o_friction impratio cone", CONTACTS),
            (
                "timestep tolerance ls_tolerance noslip_tolerance ccd_tolerance mpr_tolerance sleep_tolerance \
                 integrator jacobian solver iterations ls_iterations noslip_iterations ccd_iterations \
                 mpr_iterations sdf_iterations sdf_initpoints apirate collision",
                SOLVING,
            ),
        ],
    ),
    (
        "flag",
        Read,
        &[
            ("gravity contact constraint equality", Read),
            ("passive spring damper actuation", Refused("enable", "it takes forces away")),
            ("frictionloss limit clampctrl", LIMITS),
            ("filterparent override multiccd nativeccd midphase refsafe", CONTACTS),
            (
                "warmstart sensor eulerdamp autoreset island energy fwdinv invdiscrete sensornoise sleep diagexact",
                SOLVING,
            ),
        ],
    ),
    ("size statistic custom", Left("sizes and numbers for other uses"), &[]),
    ("visual asset camera light", LOOKS, &[]),
    ("sensor", Left("what is measured"), &[]),
    ("mujoco/contact", CONTACTS, &[]),
    // A note of its own says where it begins instead.
    ("keyframe", Whole, &[]),
    (
        "include",
        Refused(
            "",
            "it names another file, which is not read; `mj_saveLastXML` of MuJoCo writes a file with its includes in it",
        ),
        &[],
    ),
    ("deformable extension", Refused("", ""), &[]),
    ("tendon", Read, &[]),
    ("tendon/spatial tendon/fixed equality/tendon", Refused("", TENDONS), &[]),
    ("default", Read, &[("class", Read)]),
    ("default/tendon", Whole, &[]),
    ("default/mesh default/material default/camera default/light", LOOKS, &[]),
    ("default/pair", CONTACTS, &[]),
    ("worldbody", Read, &[("childclass", Read)]),
    (
        "body",
        Read,
        &[
            ("name childclass pos quat axisangle xyaxes zaxis euler", Read),
            ("mocap", Refused("false", "it would be moved from outside")),
            ("gravcomp", Refused("0", "it would be held against gravity")),
            ("sleep simple", SOLVING),
            ("user", BOOKS),
        ],
    ),
    ("frame replicate attach composite flexcomp plugin", Refused("", SPACE), &[]),
    ("inertial", Read, &[("pos quat axisangle xyaxes zaxis euler mass diaginertia fullinertia", Read)]),
    (
        "joint",
        Read,
        &[
            (
                "name class type pos axis limited range stiffness ref springref armature damping frictionloss \
                 actuatorfrcrange actuatorfrclimited",
                Read,
            ),
            ("springdamper", Refused("0", "`stiffness` and `damping` say the same")),
            ("solreflimit solimplimit solreffriction solimpfriction margin", LIMITS),
            ("actuatorgravcomp", Left("what bodies that are held against gravity would need")),
            ("group user", BOOKS),
        ],
    ),
    ("freejoint", Read, &[("name", Read), ("group align", BOOKS)]),
    (
        "geom",
        Read,
        &[
            (
                "name class type size mass density shellinertia fromto pos quat axisangle xyaxes zaxis euler mesh \
                 hfield",
                Read,
            ),
            (
                "contype conaffinity condim priority friction solmix solref solimp margin gap surfacevel adhesion",
                CONTACTS,
            ),
            ("material rgba fitscale", LOOKS),
            ("fluidshape fluidcoef", Left("what a fluid or a sensor would feel")),
            ("group user", BOOKS),
        ],
    ),
    (
        "site",
        Read,
        &[
            ("name class pos fromto quat axisangle xyaxes zaxis euler", Read),
            ("type size material rgba", LOOKS),
            ("group user", BOOKS),
        ],
    ),
    ("equality", Read, EQUALITY),
    ("connect weld", Read, EQUALITY),
    ("equality/joint", Read, EQUALITY),
    ("flex flexvert flexstrain distance", Refused("", "bodies that bend are no mechanism"), &[]),
    ("actuator", Read, &[]),
    (
        "general motor position velocity intvelocity damper",
        Read,
        &[
            (
                "name class group joint jointinparent tendon cranksite slidersite site refsite body cranklength gear \
                 damping armature kp kv dampratio timeconst dyntype gaintype biastype dynprm gainprm biasprm \
                 ctrlrange forcerange",
                Read,
            ),
            ("delay", Refused("0", "inputs act at once")),
            ("input", Refused("", "an actuator has one input")),
            ("ctrllimited forcelimited lengthrange inheritrange", LIMITS),
            ("velrange ffrange actlimited actrange actdim actearly", LIMITS),
            ("nsample interp", SOLVING),
            ("user", BOOKS),
        ],
    ),
    (
        "muscle cylinder adhesion dcmotor pid orientation",
        Refused("", "motor, position, velocity and general are"),
        &[],
    ),
    ("actuator/plugin", Refused("", "motor, position, velocity and general are"), &[]),
];

const EQUALITY: &[(&str, Fate)] = &[
    ("name class active body1 body2 anchor site1 site2 relpose torquescale joint1 joint2 polycoef", Read),
    ("solref solimp", Left("how stiff its equalities are")),
];
