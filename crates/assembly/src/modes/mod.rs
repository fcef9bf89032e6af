//! In how many ways a mechanism closes, with some joints held.
//!
//! Three ways lead to all configurations. What is planar and not small is constructed by circles and lines
//! ([`kutzbach_constructive`]). Where bodies share points, the incidence tree leaves few unknowns, which are
//! searched with proof ([`crate::real`]); where that leaves something open (double solutions, curves), exact algebra decides on
//! the same equations, as long as it takes no longer than it may. Where joints slide or the geometry is of another kind, the
//! exact closure equations of the loops are solved as they are: along paths where they are as many as the unknowns (`paths`),
//! otherwise by exact algebra alone.
//!
//! An answer is *proven* only if nothing else is left and, for exact numbers, every configuration is proven to be one; if, besides, the
//! drawn pose closes and is not among them, the answer contradicts a known fact and is withdrawn.
//!
//! Rounded numbers are asked first what holds of all digits: then a configuration may be one that closes only within the digits, which it
//! says of itself.

mod by_construction;
mod by_parts;
mod by_polynomials;
mod by_tree;
mod closing;
mod drawn;
mod exact;
mod extreme;
mod half_turn;
mod inputs;
mod place;
mod rounded;

pub use by_parts::Part;
pub use half_turn::{HalfTurn, WITHIN};
pub use place::Pose;

use crate::placed::{Gap, Placed};
use crate::reduced::{Exported, ReducedSystem};
use kutzbach_algebra::{Budget, Limits, Stop};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{HoldError, JointId, Mechanism};
use thiserror::Error;

/// What is asked.
#[derive(Clone, Debug, Default)]
pub struct Question {
    /// Joints to hold, and where (rad, m). `None`: as many as the mechanism has freedoms, where they are drawn.
    pub held: Option<Vec<(JointId, Number)>>,
    /// What the answer may cost.
    pub limits: Limits,
}

/// Why there is no answer to look for.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum ModesError {
    /// A joint that cannot be held.
    #[error(transparent)]
    Hold(#[from] HoldError),
}

/// How the configurations were found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Way {
    /// By the equations of an incidence tree.
    Tree {
        /// Rigid parts that were put together before, each by a tree of its own; the tree below joins them as bodies.
        parts: Vec<Part>,
        /// Weight of the tree: independent unknowns.
        weight: usize,
        /// The root's name, then parent and child of every edge with its weight.
        root: String,
        /// Parent, child, weight.
        edges: Vec<(String, String, usize)>,
        /// Number of closure equations.
        equations: usize,
        /// Largest total degree of one.
        degree: usize,
        /// Boxes that were looked at.
        boxes: usize,
        /// Whether exact algebra had to decide.
        exact: bool,
    },
    /// By the closure equations of the loops.
    Polynomials {
        /// Number of unknowns.
        variables: usize,
        /// Number of equations.
        equations: usize,
        /// Largest total degree of one.
        degree: usize,
        /// Number of complex solutions, where they are finitely many and were counted.
        complex: Option<usize>,
        /// Whether they were followed along paths and each proven, after exact algebra had counted them.
        paths: bool,
    },
    /// By circles and lines of a planar mechanism.
    Construction {
        /// Steps that have two places at most, of which each link of several joints has one only.
        steps: usize,
    },
    /// By circles and lines of a planar mechanism, on parts that are solved at once.
    AtOnce {
        /// Hinges and sliders of each part.
        cores: Vec<usize>,
    },
    /// No loop closes, or everything is held: the tree of joints alone.
    Nothing,
}

/// Whether these are all configurations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Complete {
    /// There is no other, proven. Whether each of them is one it says itself.
    Proven,
    /// It is not known, because.
    Unknown(String),
}

/// A configuration.
#[derive(Clone, Debug)]
pub struct Configuration {
    /// Values of each joint with freedoms (rad, m), by joint; `None` where a link has no definite pose.
    pub joints: Vec<(JointId, Option<Vec<f64>>)>,
    /// `world_from_link`, by link; `None` for a rod that spins.
    pub poses: Vec<Option<Pose>>,
    /// How often it counts as a solution; more than once is a singular one. `None` where it was not counted: a configuration
    /// on a curve, or the drawn one where the equations were not solved.
    pub multiplicity: Option<usize>,
    /// Whether it is proven to be one.
    pub proven: bool,
    /// Freedoms that are left there with the joints held, where known.
    pub finite: Option<usize>,
    /// Whether it is the drawn one, as assembled.
    pub drawn: bool,
}

/// Why a solution of the equations is no configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Why {
    /// A joint is open there.
    Open {
        /// The joint that is most open.
        joint: JointId,
        /// By how much.
        gap: Gap,
    },
    /// A joint is beyond its limits there.
    Limit {
        /// The joint.
        joint: JointId,
        /// Where it stands (rad, m), for a hinge with the whole turns by which it is nearest to its range.
        value: f64,
    },
}

/// A solution that was found and is no configuration.
#[derive(Clone, Debug)]
pub struct LeftOut {
    /// Where everything stands there.
    pub configuration: Configuration,
    /// Why it is none.
    pub why: Why,
}

/// All configurations, as far as they are known.
#[derive(Clone, Debug)]
pub struct Modes {
    /// The joints held, and where.
    pub held: Vec<(JointId, Number)>,
    /// Inputs that were to be held, since nobody says what is, and that no number holds: those of balls, and the like.
    pub not_held: Vec<String>,
    /// Joints that are held within [`WITHIN`] of that value instead: its cosine is not algebraic.
    pub held_near: Vec<(JointId, HalfTurn)>,
    /// Finite freedoms of the mechanism with nothing held, at the drawn pose; `None` where that was not asked or is not known.
    pub freedom: Option<usize>,
    /// The configurations: every joint closes there, and is within its limits.
    pub configurations: Vec<Configuration>,
    /// Solutions that failed when they were tried: poses at which a joint is open, or beyond its limits.
    pub left_out: Vec<LeftOut>,
    /// How many there are, such as `2^40`, where they are more than those listed.
    pub in_all: Option<String>,
    /// Whether these are all.
    pub complete: Complete,
    /// The most freedoms that are known to be left at some configurations with the joints held, not at all of them; `None` where
    /// that is not known.
    pub moves: Option<usize>,
    /// Freedoms to hold as well, where something moves.
    pub proposed: Vec<String>,
    /// Two things that the file says and that exclude each other, where that is why nothing closes.
    pub contradiction: Option<String>,
    /// How they were found.
    pub way: Way,
    /// Places left open: so many boxes may hold more.
    pub open: usize,
}

/// Planar mechanisms of so many steps with circles and lines are constructed, although a tree may leave few enough unknowns to search.
const MANY_STEPS: usize = 4;

/// All configurations of a mechanism.
///
/// # Errors
/// [`ModesError`] for joints that cannot be held; everything else is an answer.
pub fn assembly_modes(mechanism: &Mechanism, question: &Question) -> Result<Modes, ModesError> {
    let inputs::Proposed {
        held,
        not_held,
        finite: freedom,
    } = match &question.held {
        Some(held) => inputs::Proposed {
            held: held.clone(),
            ..inputs::Proposed::default()
        },
        None => inputs::proposed(mechanism),
    };
    let held_near = inputs::held_near(mechanism, &held);
    let fixed = mechanism.with_joints_held(&inputs::replaced(&held, &held_near))?;
    let place::Start {
        drawn,
        never_closes,
    } = place::start(&fixed);
    let budget = Budget::new(question.limits.clone());
    let joints: Vec<JointId> = (0..fixed.joints().len()).map(JointId).collect();
    let (algebraic, _) = fixed.with_rational_rotations(&joints);
    let slack = rounded::slack(&fixed);
    let (mut modes, stays) = match by_construction::answer(&fixed, &slack, MANY_STEPS) {
        Some(built) => built,
        None => match by_tree::answer(&algebraic, &slack, &budget) {
            by_tree::Outcome::Modes(modes, stays) => (*modes, stays),
            by_tree::Outcome::NotByTree(why) => by_construction::answer(&fixed, &slack, 0)
                .unwrap_or_else(|| {
                    let modes = by_construction::at_once(&fixed, &budget);
                    let polynomials = || by_polynomials::answer(&algebraic, &why, &budget);
                    (modes.unwrap_or_else(polynomials), false)
                }),
        },
    };
    rounded::doubt(&mut modes, &fixed, stays, never_closes);
    modes.held = held;
    modes.not_held = not_held;
    modes.held_near = held_near;
    modes.freedom = freedom;
    let test = closing::Test::new(&fixed, &slack);
    test.leave_open_ones_out(&mut modes);
    let in_time = budget.left().is_none_or(|left| left > 0);
    drawn::tell(&mut modes, &fixed, drawn.as_ref(), slack.share, in_time);
    test.leave_those_beyond_limits_out(&mut modes);
    // Joints by the mechanism as it was asked about: those held have their values.
    let left_out = modes.left_out.iter_mut().map(|out| &mut out.configuration);
    for configuration in modes.configurations.iter_mut().chain(left_out) {
        configuration.joints =
            place::joint_values(mechanism, &fixed, &modes.held, &configuration.poses);
    }
    Ok(modes)
}

/// The equations of the incidence tree that [`assembly_modes`] solves, over the rationals, for another program.
///
/// # Errors
/// Where joints cannot be held, or there is no tree; in a sentence.
pub fn reduced_equations(
    mechanism: &Mechanism,
    held: Option<&[(JointId, Number)]>,
) -> Result<Exported, String> {
    let held = match held {
        Some(held) => held.to_vec(),
        None => inputs::proposed(mechanism).held,
    };
    let held_near = inputs::held_near(mechanism, &held);
    let fixed = mechanism
        .with_joints_held(&inputs::replaced(&held, &held_near))
        .map_err(|error| error.to_string())?;
    let placed = Placed::of(&fixed).map_err(|why| why.to_string())?;
    let system = ReducedSystem::new(&placed).map_err(|why| why.to_string())?;
    Ok(system.exported())
}

impl Modes {
    /// No configuration, proven, as long as nothing else is entered.
    fn new(way: Way) -> Self {
        Self {
            held: Vec::new(),
            not_held: Vec::new(),
            held_near: Vec::new(),
            freedom: None,
            configurations: Vec::new(),
            left_out: Vec::new(),
            in_all: None,
            complete: Complete::Proven,
            moves: Some(0),
            proposed: Vec::new(),
            contradiction: None,
            way,
            open: 0,
        }
    }

    /// The answer where none was waited for.
    #[must_use]
    pub fn interrupted(question: &Question) -> Self {
        Self {
            held: question.held.clone().unwrap_or_default(),
            complete: Complete::Unknown(Stop::Cancelled.to_string()),
            moves: None,
            ..Self::new(Way::Nothing)
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests_of_parts;
#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests_of_platforms;
