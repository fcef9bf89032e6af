//! What a mechanism is.
//!
//! A [`Mechanism`] is rigid links held together by joints of Hervé's classes, plus linear couplings between joint variables.
//! It is made by [`MechanismBuilder::build`] only, which checks everything once; what exists is valid, and nothing
//! downstream checks again:
//!
//! - names are unique, every reference resolves, no joint connects a link with itself;
//! - every link has exactly one [`Placement`]: the root of the file's tree, or a home pose relative to another link,
//!   without circles;
//! - directions are not zero, numbers are small enough to compute with, limits are ordered, a screw has a lead, a distance
//!   joint a distance (its own or that of the home pose), couplings and drives speak of joints of one freedom, mimics form
//!   no circle;
//! - configurations, scene and expectation speak of joints and links that exist.
//!
//! Geometry stays as the file wrote it: exact [`Number`](kutzbach_math::number::Number)s in frames relative to links. Floating-point
//! poses, in as many digits as a question needs, are computed from it by `kutzbach::closure`.

mod builder;
mod configuration;
mod constants;
mod coupling;
mod derived_frames;
mod error;
mod exact_pose;
mod frame;
mod frame_tree;
mod held;
mod joint;
mod joint_numbers;
mod kind;
mod link;
mod model;
mod number_style;
mod other_unit;
mod precision;
mod precision_by_block;
mod rational_rotations;
mod replaced;
mod residues;
mod scene;
mod set_aside;

pub use builder::{JointBuilder, MechanismBuilder};
pub use configuration::Configuration;
pub use constants::{Recognised, Residue};
pub use coupling::{Assumption, Coupling, CouplingOrigin, CouplingTerm, HIGHEST_POWER};
pub use derived_frames::roll_pitch_yaw_rates;
pub use error::{Entity, MechanismError};
pub use exact_pose::ExactPose;
pub use frame::{Direction, Frame};
pub use frame_tree::FrameTree;
pub use held::HoldError;
pub use joint::{Dynamics, Joint, Limit, Side};
pub use kind::{FreedomPart, JointKind};
pub use link::{Geometry, Inertial, Link, Placement, Shape};
pub use model::{JointId, LinkId, Mechanism};
pub use number_style::Written;
pub use other_unit::OtherUnit;
pub use precision::{LiteralPlace, Precision};
pub use scene::{Drive, Expectation, Scene};
