//! Fate of each element and each attribute of SDF, and of those that Drake and Gazebo add.

use crate::robot::table::Fate::{Left, Read, Refused, Whole};
use crate::robot::table::{Fate, Row};

const LOOKS: Fate = Left("what is only seen or sounds");
const CONTACTS: Fate = Left("how bodies touch");
const LIMITS: Fate = Left("limits of motions and efforts");
const SOLVING: Fate = Left("how engines of physics compute");
const PLACES: Fate = Left("what is around the model");
const DRAKE: &str = "it acts in Drake";
const FRAMES: &str = "it moves the joint to another frame; `parent` and `child` may name frames themselves";

pub(super) const ROWS: &[Row] = &[
    ("sdf", Read, &[("version", Read)]),
    ("world", Read, &[("name", Read)]),
    ("world/gravity physics/gravity", Read, &[]),
    ("world/plugin world/state world/actor world/population world/joint world/include include", Whole, &[]),
    ("world/light world/scene world/gui world/road world/audio", LOOKS, &[]),
    ("world/wind world/magnetic_field world/spherical_coordinates world/atmosphere", PLACES, &[]),
    ("world/physics", Read, &[("name default type", SOLVING)]),
    (
        "physics/max_step_size physics/real_time_factor physics/real_time_update_rate physics/max_contacts",
        SOLVING,
        &[],
    ),
    ("physics/dart physics/bullet physics/update_rate physics/magnetic_field physics/profile", SOLVING, &[]),
    ("sdf/light sdf/actor", LOOKS, &[]),
    (
        "model",
        Read,
        &[("name canonical_link placement_frame", Read), ("namespace", Left("names of other programs"))],
    ),
    ("static", Read, &[]),
    ("self_collide", CONTACTS, &[]),
    ("allow_auto_disable must_be_base_link", SOLVING, &[]),
    ("enable_wind", Refused("false|0", "a wind would push"), &[]),
    ("pose", Read, &[("relative_to frame rotation_format degrees", Read)]),
    ("frame", Read, &[("name attached_to", Read)]),
    ("plugin gripper", Whole, &[]),
    ("link", Read, &[("name", Read)]),
    ("gravity kinematic", Read, &[]),
    ("velocity_decay", Whole, &[]),
    ("visual light projector audio_sink audio_source particle_emitter", LOOKS, &[]),
    ("collision sensor", Whole, &[]),
    ("battery", Left("batteries"), &[]),
    ("inertial", Read, &[("auto", Read)]),
    ("mass inertia ixx ixy ixz iyy iyz izz", Read, &[]),
    ("fluid_added_mass", Whole, &[]),
    ("density auto_inertia_params", Left("what inertias of shapes would need"), &[]),
    ("joint", Read, &[("name type", Read)]),
    ("parent child gearbox_ratio gearbox_reference_body thread_pitch screw_thread_pitch", Read, &[]),
    ("axis axis2 dynamics limit damping friction spring_reference spring_stiffness", Read, &[]),
    ("xyz", Read, &[("expressed_in", Read)]),
    ("initial_position use_parent_model_frame lower upper effort velocity", Read, &[]),
    ("limit/stiffness limit/dissipation", LIMITS, &[]),
    ("mimic", Read, &[("joint axis", Read)]),
    ("multiplier offset reference", Read, &[]),
    ("joint/physics ode", Read, &[]),
    ("world/ode physics/simbody joint/simbody simbody", SOLVING, &[]),
    (
        "provide_feedback cfm_damping implicit_spring_damper fudge_factor cfm erp bounce ode/limit suspension \
         ode/velocity ode/solver ode/constraints",
        SOLVING,
        &[],
    ),
    ("ode/max_force", Refused("0", "a motor of ODE would hold the joint"), &[]),
    ("*:parent_frame *:child_frame", Refused("", FRAMES), &[]),
    ("drake:*", Refused("", DRAKE), &[]),
    ("drake:rotor_inertia", Refused("0", "the rotor's inertia would turn with the joint"), &[]),
    ("drake:gear_ratio", Refused("1", "a rotor's inertia would turn with the joint"), &[]),
    (
        "drake:proximity_properties drake:illustration_properties drake:perception_properties \
         drake:accepting_renderer drake:diffuse_map drake:collision_filter_group drake:acceleration",
        Left("what is seen or touches"),
        &[],
    ),
];
