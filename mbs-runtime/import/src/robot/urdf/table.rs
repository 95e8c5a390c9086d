//! Fate of each element and each attribute of URDF, and of those that Drake and Gazebo add.

use crate::robot::table::Fate::{Left, Read, Refused, Whole};
use crate::robot::table::{Fate, Row};

const LOOKS: Fate = Left("what is only seen");
const LIMITS: Fate = Left("limits of motions and efforts");
const OF_ROS: Fate = Left("how programs of ROS use it");
const DRAKE: &str = "it acts in Drake";
const DRIVES: &str = "a transmission has one motor at one joint";
const ROTORS: &str = "the rotor's inertia would turn with the joint";

pub(super) const ROWS: &[Row] = &[
    ("robot", Read, &[("name", Read), ("version", Left("the version of the file"))]),
    ("link", Read, &[("name", Read), ("type", OF_ROS)]),
    ("inertial", Read, &[]),
    ("mass", Read, &[("value", Read)]),
    ("inertia", Read, &[("ixx ixy ixz iyy iyz izz", Read)]),
    ("origin", Read, &[("xyz rpy", Read), ("quat_xyzw", Refused("", "`rpy` says the same"))]),
    ("visual material", LOOKS, &[]),
    ("collision", Left("how bodies touch"), &[]),
    ("joint", Read, &[("name type", Read)]),
    ("parent child", Read, &[("link", Read)]),
    ("axis", Read, &[("xyz", Read)]),
    ("dynamics", Read, &[("damping friction", Read), ("drake:coulomb_friction", Left("dry friction"))]),
    (
        "limit",
        Read,
        &[
            ("lower upper effort velocity", Read),
            ("acceleration deceleration jerk drake:acceleration", LIMITS),
        ],
    ),
    ("mimic", Read, &[("joint multiplier offset", Read)]),
    ("safety_controller", LIMITS, &[]),
    ("calibration joint_properties", OF_ROS, &[]),
    ("transmission", Read, &[("name", Read), ("type", OF_ROS)]),
    ("transmission/type hardwareInterface role motorTorqueConstant encoderReduction", OF_ROS, &[]),
    ("transmission/joint", Read, &[("name", Read)]),
    ("actuator", Read, &[("name", Read)]),
    ("mechanicalReduction", Read, &[]),
    // a reduction of a joint is that of a differential drive
    ("transmission/joint/mechanicalReduction", Refused("1", DRIVES), &[]),
    ("offset", Left("where motors are at zero"), &[]),
    (
        "leftActuator rightActuator flexJoint rollJoint gap_joint passive_joint use_simulated_gripper_joint \
         compensator",
        Refused("", DRIVES),
        &[],
    ),
    ("simulated_reduction drake:gear_ratio", Refused("1", ROTORS), &[]),
    ("motorInertia rotorInertia rotor_inertia drake:rotor_inertia", Refused("0", ROTORS), &[]),
    ("loop_joint force_element", Refused("", DRAKE), &[]),
    ("frame", Left("places that have names"), &[]),
    ("gazebo sensor", Whole, &[]),
    (
        "gazebo/springStiffness gazebo/kinematic gazebo/turnGravityOff",
        Refused("0|false", "it acts in Gazebo"),
        &[],
    ),
    ("gazebo/gravity", Refused("1|true", "it acts in Gazebo"), &[]),
    ("ros2_control", OF_ROS, &[]),
    ("mujoco", Left("how MuJoCo reads it"), &[]),
    ("drake:joint drake:*", Refused("", DRAKE), &[]),
    ("drake:acceleration", LIMITS, &[]),
    (
        "drake:proximity_properties drake:illustration_properties drake:perception_properties \
         drake:accepting_renderer drake:diffuse_map drake:collision_filter_group",
        Left("what is seen or touches"),
        &[],
    ),
    ("xacro:*", Refused("", RAW), &[]),
];

/// Reason to refuse a file that xacro has not expanded yet.
pub(super) const RAW: &str = "it is a part of xacro: run xacro first (`xacro FILE > OUT.urdf`)";
