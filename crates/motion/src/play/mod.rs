//! How much play joints need for a motion to go through that the numbers as written do not close along.
//!
//! The meant mechanism closes all along a motion. At each pose of it the loops of the given dimensions stay open by a residual
//! `r`, and what the joints' own freedoms cannot mend of it is `b = Nᵀ r`, with `N` the left kernel of the closure equations.
//! Every joint's sides may stand off by a small deviation in the directions that the joint constrains, `u_j` of them, which moves
//! `b` by `A_j u_j`. The play asked for is the least `t` with
//!
//! ```text
//! Σ_j A_j u_j = −b,   ‖u_j‖ ≤ t for every joint j
//! ```
//!
//! the same for all joints; of the motion, the largest such `t`. A deviation is measured at the successor's joint frame as
//! `√(d² + (a θ)²)`, with `d` the shift of its origin, `θ` the tilt and `a` the arm: half the distance of a bearing's two ends,
//! which then move by up to `t`.
//!
//! To first order in the misfit: deviations are added where the meant mechanism stands, and what they turn is neglected, a share of
//! misfit over size. Poses beside a singular one, where joints would have to move far to make up for little, are counted like
//! others; poses whose equations have another rank than most are left out and counted.

mod directions;
mod minimax;
mod search;

use crate::inputs::Variable;
use crate::result::{EndReason, Trace, TraceError, TraceOptions};
use crate::trace::trace;
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_mobility::Analysis;
use kutzbach_model::mechanism::Mechanism;
use search::Search;

/// Poses of a motion at which play is computed before the largest is refined.
const POSES: usize = 96;

/// Poses computed of the motion, each way.
const FOLLOWED: usize = 2000;

/// What to ask.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlayOptions {
    /// Name of the branch; the first if `None`.
    pub branch: Option<String>,
    /// The configuration that was analysed; the home pose if `None`.
    pub configuration: Option<String>,
    /// Distance of the two ends of every joint's bearing (m): a tilt counts by half of it. The length of the moving loops if
    /// `None`, by which angles count elsewhere.
    pub bearing: Option<f64>,
}

/// The play that a motion needs.
#[derive(Clone, Debug)]
pub struct Play {
    /// Name of the branch followed.
    pub branch: String,
    /// The deviation that every joint has to allow at the worst pose (m).
    pub needed: f64,
    /// A proven lower bound of the least such deviation (m): `needed` is at most one hundredth above it, or the search for a
    /// better one was given up.
    pub at_least: f64,
    /// The length by which tilts count (m).
    pub arm: f64,
    /// The variable that tells poses apart.
    pub driven: Variable,
    /// Its value at the worst pose (rad, m).
    pub worst: f64,
    /// Joints that stand off there, by joint index.
    pub joints: Vec<Deviation>,
    /// (value of the driven variable, play needed there) along the motion.
    pub along: Vec<(f64, f64)>,
    /// Whether the motion is followed all round, or from end to end.
    pub whole: bool,
    /// Poses left out, since the equations have another rank there.
    pub left_out: usize,
    /// Names of variables held, where the branch has several freedoms.
    pub held: Vec<String>,
}

/// How far a joint's sides stand off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Joint index.
    pub joint: usize,
    /// Shift of the successor's joint frame against the predecessor's, in the directions that the joint constrains (m).
    pub shift: f64,
    /// Tilt about the axes that it constrains (rad).
    pub tilt: f64,
}

/// Why no play is told.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NoPlay {
    /// The meant mechanism cannot be followed.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// It does not move.
    #[error("{0}")]
    Still(String),
    /// Too large.
    #[error("its loops have more redundant constraints than play is computed for ({0})")]
    TooLarge(usize),
    /// No deviation of joints mends the misfit, as with couplings that disagree.
    #[error("no deviation of its joints closes the loops along the motion")]
    Unmendable,
    /// No pose of the motion has equations of a clear rank.
    #[error("the rank of its equations is clear nowhere along the motion")]
    NoClearPose,
}

/// The play that a mechanism's joints need for the motion of the one that is meant; both have the same links and joints. The analysis
/// is that of the meant one.
///
/// Cost: a singular value decomposition of the closure equations for each of about a hundred poses.
///
/// # Errors
/// [`NoPlay`]; see there.
pub fn play(
    given: &Mechanism,
    meant: &Mechanism,
    analysis: &Analysis,
    options: &PlayOptions,
) -> Result<Play, NoPlay> {
    let traced = trace(
        meant,
        analysis,
        &TraceOptions {
            branch: options.branch.clone(),
            configuration: options.configuration.clone(),
            samples: 2,
            poses: FOLLOWED,
            ..TraceOptions::default()
        },
    )?;
    let mut motion = match traced {
        Trace::Moving(motion) => motion,
        Trace::Still(still) => return Err(NoPlay::Still(still.reason)),
    };
    let pose = |mechanism: &Mechanism| {
        let configuration = options.configuration.as_ref();
        let configuration = configuration.and_then(|name| mechanism.configuration(name));
        Geometry::new(mechanism, configuration, &Arithmetic::double())
    };
    let search = Search {
        given: pose(given),
        meant: pose(meant),
        parts: &analysis.structure.parts,
        arm: options
            .bearing
            .map_or(motion.length_unit, |bearing| bearing / 2.0),
    };
    let found = search.along(&mut motion.curve, POSES)?;
    Ok(Play {
        branch: motion.branch,
        needed: found.worst.play,
        at_least: found.worst.at_least,
        arm: search.arm,
        driven: motion.driven,
        worst: found.worst.value,
        joints: found.worst.joints,
        along: found.along,
        whole: motion.closed.is_some()
            || motion
                .ends
                .iter()
                .all(|end| end.reason != EndReason::GoesOn),
        left_out: found.left_out,
        held: motion
            .held
            .into_iter()
            .map(|held| held.variable.name)
            .collect(),
    })
}
