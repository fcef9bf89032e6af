//! How a mechanism can move: engines, and the one file that decides the verdict.
//!
//! The question is answered part by part ([`Structure`]): bridges are free, blocks that share no joint and no coupling
//! cannot influence each other. Each part is counted ([`kutzbach_count`], [`generic_count`]), closed
//! ([`kutzbach_closure::assemble`]) and ranked at its pose ([`rank_part`]); from the kernel come the joints' roles
//! ([`roles_of_part`]), from the left kernel the redundant constraints ([`SelfStresses`]) and what to relax
//! ([`advice_for_part`]).
//!
//! Then [`part_mobility`] asks what is left of that freedom in finite motion: displacement subgroups
//! ([`subgroup_finding`]), the chart test ([`chart_test`]), and at singular poses the germ of the configuration space and
//! its real zeros. Where the numbers are exact and doubt is left, exact algebra is asked last, within an
//! [`ExactBudget`]. Every branch is walked to generic poses of its own, where [`branch_facts`] asks what moves along it.
//! [`judge`] puts the parts together.
//!
//! Cost: near-linear in the mechanism where its loops are short and hang together like a chain; fronts of the sparse
//! elimination grow with the width of a lattice. Singular poses cost power series in the variables of one part's kernel.

mod across_joints;
mod actuation;
mod advice;
mod alike;
mod analyse;
mod analysis;
mod as_stated;
mod branch;
mod branch_facts;
mod branch_roles;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod branch_samples;
mod change_search;
mod chart;
mod claim;
mod closed_form;
mod coupling_locks;
mod cycles;
mod depth;
mod engines;
mod exact;
mod exact_constraint;
pub mod families;
mod followed;
mod generic;
mod germ;
mod germ_zeros;
mod hidden;
mod idle;
mod idle_directions;
mod intended;
mod judge;
mod kutzbach;
mod leftover;
mod lifting;
mod limbs;
mod limit_facts;
mod link_twists;
mod loops_at_rest;
mod meant;
mod more_digits;
mod near_singular;
mod one_engine;
mod one_sided;
mod options;
mod part_mobility;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod part_samples;
mod passive;
mod plane_germ;
mod point_chains;
mod pose_facts;
mod pose_rank;
mod question;
mod redundancy;
mod redundant_directions;
mod relative_motion;
mod relaxation;
mod restricted;
mod roles;
mod rounded;
mod row_space;
mod singular;
mod splitting_lemma;
mod subgroup;
mod superfluous;
mod tangent_space;
mod tracing;
mod tree_bound;
mod verdict;
mod vocabulary;
mod whole_branches;
mod without_body;

pub use actuation::{Actuation, DependentInput, Follower, Freedom, actuation};
pub use advice::{Advice, advice_for_part};
pub use analyse::{analyse, analyse_within};
pub use analysis::{Analysis, HomeFreedom};
pub use branch::{Branch, BranchPose, IdleLink, RelativeMotion, Tangent};
pub use branch_facts::{BranchFacts, branch_facts};
pub use branch_roles::branch_roles;
pub use chart::{ChartOutcome, ChartTest, Kernel, chart_test};
pub use claim::{Answer, Bounds, Claim, PartBranch, Says};
pub use coupling_locks::{LockingCoupling, freedom_locked_by_couplings, locking_couplings};
pub use cycles::{CycleFacts, cycle_facts};
pub use depth::Depth;
pub use engines::{engines, part_mobility};
pub use exact::ExactBudget;
pub use exact_constraint::{ChangeSets, JointChange, NoChangeSet};
pub use followed::{Followed, analyse_to_follow};
pub use generic::{GenericCount, generic_count};
pub use germ::{
    ComplexDimension, Germ, PrestressCertificate, complex_dimension, prestress_certificate,
};
pub use germ_zeros::{GermBranch, GermZeroOptions, GermZeros, HalfBranch, Isolation, germ_zeros};
pub use idle::idle_links;
pub use intended::{AsWritten, Change, Kept, Meant};
pub use judge::{Contradiction, PartFinding, Quantity};
pub use kutzbach::kutzbach_count;
pub use kutzbach_closure::{Structure, constraint_graph};
pub use limbs::{Limb, Limbs, limbs};
pub use limit_facts::LimitFact;

pub use more_digits::MoreDigits;
pub use near_singular::{ClearerPose, NearSingular, pose_of_branch};
pub use one_engine::{
    OneEngine, chart_alone, exact_alone, germ_alone, kernel_of, rank_alone, subgroups_alone,
};
pub use options::{AnalysisError, AnalysisOptions};
pub use pose_facts::PoseFacts;
pub use pose_rank::{Doubt, LADDER, PartRank, Pose, RankNote, Reading, Trial, rank_part};
pub use redundancy::SelfStresses;
pub use redundant_directions::{JointDirections, ReactionDirection};
pub use relative_motion::{motions_to_ground, relative_motions};
pub use roles::{JointRole, freedom_groups, roles_of_part};
pub use subgroup::{SubgroupFinding, subgroup_finding};
pub use superfluous::{Spare, Superfluous};
pub use tracing::tangents_at;
pub use tracing::{PartPose, poses_of_regular_part};
pub use verdict::{Mobility, Nominal, judge, unassembled};
pub use vocabulary::{
    CertificateLevel, EngineName, MobilityClass, PoseKind, RelationKind, Scope, SingularKind,
    Verdict,
};
