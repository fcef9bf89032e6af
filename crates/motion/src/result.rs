//! What a trace says.

use super::curve::Curve;
use super::inputs::Variable;
use kutzbach_closure::Rigid;
use thiserror::Error;

/// Where nothing else is said, a hinge is followed for so many turns, a slide for as many radians in part lengths.
const MOST_TURNS: f64 = 12.0;

/// Where nothing else is said, no more poses are computed each way.
const MOST_POSES: usize = 20_000;

/// What to trace.
#[derive(Clone, Debug, PartialEq)]
pub struct TraceOptions {
    /// Name of the branch; the first if `None`.
    pub branch: Option<String>,
    /// Name of the variable that is driven, such as `crank` or `slider.rot`.
    pub drive: Option<String>,
    /// Values of the driven variable that are wanted (rad, m): from, to.
    pub range: Option<(f64, f64)>,
    /// Names of variables that are held where they start.
    pub hold: Vec<String>,
    /// How many samples are wanted.
    pub samples: usize,
    /// The configuration that was analysed; the home pose if `None`.
    pub configuration: Option<String>,
    /// How far a variable may go from its start before the curve has been followed far enough: rad, and units of the
    /// part's length for slides.
    pub reach: f64,
    /// Poses computed each way before the curve has been followed far enough.
    pub poses: usize,
    /// How well the loops of a sample have to close (rad, cycle lengths): Newton's method stops there. Zero asks for
    /// rounding. The curve itself, its ends and what is met on it are found to rounding in any case.
    pub tolerance: f64,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self {
            branch: None,
            drive: None,
            range: None,
            hold: Vec::new(),
            samples: 100,
            configuration: None,
            reach: MOST_TURNS * std::f64::consts::TAU,
            poses: MOST_POSES,
            tolerance: 0.0,
        }
    }
}

/// Why there is no trace. That nothing moves is an answer ([`Trace::Still`]), not an error.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum TraceError {
    /// No branch of that name.
    #[error("there is no branch `{name}`; there is {known}")]
    UnknownBranch {
        /// The name asked for.
        name: String,
        /// Those there are.
        known: String,
    },
    /// No variable of that name.
    #[error("there is no joint variable `{name}`")]
    UnknownVariable {
        /// The name asked for.
        name: String,
        /// The closest there is.
        nearest: Option<String>,
        /// The variables of the joint, where it names a joint of several.
        several: Vec<String>,
    },
    /// What is held leaves nothing for the driven variable to do.
    #[error("`{drive}` cannot move with {held} held")]
    NothingLeft {
        /// The variable that was to be driven.
        drive: String,
        /// What was held.
        held: String,
    },
    /// As many independent variables held as there are degrees of freedom.
    #[error("holding `{name}` too leaves no degree of freedom")]
    HoldsTooMuch {
        /// The first variable too many.
        name: String,
    },
    /// A held variable that is at an extreme position at the start, or depends on the other ones held.
    #[error(
        "holding `{name}` fixes nothing at the start: its rate is zero there, or follows from the others held"
    )]
    HoldsNothing {
        /// The variable.
        name: String,
    },
    /// The wanted range is no range.
    #[error("the range {from} to {to} is not finite")]
    Range {
        /// Where it was to begin.
        from: f64,
        /// Where it was to end.
        to: f64,
    },
    /// The reach is not positive.
    #[error("a motion cannot be followed for {reach}")]
    Reach {
        /// What was wanted.
        reach: f64,
    },
    /// The tolerance is negative or no number.
    #[error("loops cannot be closed to {tolerance}")]
    Tolerance {
        /// What was wanted.
        tolerance: f64,
    },
    /// Too many or too few samples.
    #[error("{samples} samples; from 2 to 10000000 are possible")]
    Samples {
        /// How many were wanted.
        samples: usize,
    },
    /// Numbers out of range.
    #[error("the geometry leaves the range of floating-point numbers: {0}")]
    OutOfRange(#[from] kutzbach_math::matrix::MatrixError),
}

impl TraceError {
    /// How to mend it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::UnknownBranch { .. } => "`kutzbach report FILE` lists the branches".to_owned(),
            Self::UnknownVariable { several, .. } if !several.is_empty() => {
                format!("this joint has several: {}", several.join(", "))
            }
            Self::UnknownVariable {
                nearest: Some(nearest),
                ..
            } => format!("did you mean `{nearest}`?"),
            Self::UnknownVariable { .. } => {
                "`kutzbach report FILE` lists the joints; joints of several degrees of freedom are driven by a part, such as `slider.rot`".to_owned()
            }
            Self::NothingLeft { .. } => "hold other joints, or fewer".to_owned(),
            Self::HoldsTooMuch { .. } | Self::HoldsNothing { .. } => {
                "on a branch of d degrees of freedom, d − 1 independent variables can be held".to_owned()
            }
            Self::Range { .. } => "write it as --drive joint=from..to".to_owned(),
            Self::Reach { .. } => "a positive number of radians".to_owned(),
            Self::Tolerance { .. } => "a number such as 1e-9, or 0 for rounding".to_owned(),
            Self::Samples { .. } => "--samples 100".to_owned(),
            Self::OutOfRange(_) => "check the unit of the numbers".to_owned(),
        }
    }
}

/// Why nothing moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Still {
    /// In one sentence.
    pub reason: String,
    /// Which branch it is said of, if of one.
    pub branch: Option<String>,
}

/// The predicted motion of a mechanism, or why there is none.
#[derive(Clone, Debug)]
pub enum Trace {
    /// Nothing moves, or nothing is known to.
    Still(Still),
    /// A motion.
    Moving(Box<Motion>),
}

impl Trace {
    /// The motion, where there is one.
    #[must_use]
    pub fn motion(&self) -> Option<&Motion> {
        match self {
            Self::Still(_) => None,
            Self::Moving(motion) => Some(motion),
        }
    }

    /// The motion, where there is one.
    #[must_use]
    pub fn into_motion(self) -> Option<Motion> {
        match self {
            Self::Still(_) => None,
            Self::Moving(motion) => Some(*motion),
        }
    }
}

/// A variable that is held.
#[derive(Clone, Debug, PartialEq)]
pub struct Held {
    /// The variable.
    pub variable: Variable,
    /// Where (rad, m).
    pub value: f64,
}

/// What is equidistant from sample to sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// The driven variable.
    Drive,
    /// The arclength.
    Arclength,
}

/// A pose of the motion.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Arclength from the start (metric; see [`Curve`]).
    pub arclength: f64,
    /// The driven variable (rad, m).
    pub drive: f64,
    /// All joint variables of the mechanism, joint by joint (rad, m); hinges counted through full turns, balls as rotation
    /// vectors.
    pub values: Vec<f64>,
    /// `world_from_link` of every link.
    pub links: Vec<Rigid<f64>>,
    /// Largest loop equation left (rad, cycle lengths).
    pub closure: f64,
}

/// What is met on the way.
#[derive(Clone, Debug, PartialEq)]
pub enum EventKind {
    /// A joint variable turns back.
    DeadCentre {
        /// Which.
        variable: Variable,
        /// Its value there (rad, m).
        value: f64,
        /// Whether it is a greatest value.
        greatest: bool,
    },
    /// A joint meets its limit.
    JointLimit {
        /// Which.
        variable: Variable,
        /// The limit (rad, m).
        value: f64,
    },
    /// The moving part gives way in more directions than one.
    Singular {
        /// Instantaneous freedom of the moving part there, nothing held.
        freedom: usize,
        /// By how many that is more than beside it.
        excess: usize,
        /// Whether another branch crosses; otherwise one touches, or none is there.
        crosses: bool,
        /// Whether it is the pose at home.
        home: bool,
    },
    /// The motion turns back on the other half of the branch.
    Cusp {
        /// Whether it is the pose at home.
        home: bool,
    },
}

/// Something met on the way.
#[derive(Clone, Debug)]
pub struct Event {
    /// What.
    pub kind: EventKind,
    /// Arclength from the start.
    pub arclength: f64,
    /// The driven variable there (rad, m).
    pub drive: f64,
    /// All joint variables of the mechanism there, as in [`Sample::values`].
    pub values: Vec<f64>,
}

/// Why a motion ends.
#[derive(Clone, Debug, PartialEq)]
pub enum EndReason {
    /// A joint limit of the file.
    JointLimit {
        /// The joint's variable.
        variable: Variable,
        /// The limit (rad, m).
        value: f64,
    },
    /// Followed far enough: it goes on.
    GoesOn,
    /// No pose is found beyond.
    CannotGoOn,
}

/// One end of a motion that is not closed.
#[derive(Clone, Debug, PartialEq)]
pub struct End {
    /// Arclength from the start.
    pub arclength: f64,
    /// The driven variable there.
    pub drive: f64,
    /// Why.
    pub reason: EndReason,
}

/// Why wanted values of the driven variable are not reached.
#[derive(Clone, Debug, PartialEq)]
pub struct Unreached {
    /// The value farthest from the start that was wanted.
    pub wanted: f64,
    /// The last value that is reached on the way there.
    pub reached: f64,
    /// Why not farther, in words.
    pub reason: String,
}

/// The range of one joint variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Range {
    /// The variable.
    pub variable: Variable,
    /// Least and greatest value (rad, m), counted through full turns.
    pub min: f64,
    /// See [`min`](Self::min).
    pub max: f64,
    /// How far it moves, there and back counted, along the whole curve.
    pub travel: f64,
    /// Full turns once around a closed curve; zero where it only swings.
    pub turns: i64,
    /// Whether it moves at all.
    pub moves: bool,
    /// How often it turns back.
    pub dead_centres: usize,
}

/// The predicted motion along a branch.
#[derive(Clone, Debug)]
pub struct Motion {
    /// Name of the branch.
    pub branch: String,
    /// Its dimension.
    pub dimension: usize,
    /// All branches through the pose.
    pub branches: Vec<String>,
    /// The variable that is driven.
    pub driven: Variable,
    /// The variables that are held, where the branch has more than one freedom.
    pub held: Vec<Held>,
    /// Whether the motion starts at the pose that was analysed; otherwise at a generic pose of the branch.
    pub starts_at_home: bool,
    /// Full circle: arclength once around; `None` where the curve has ends.
    pub closed: Option<f64>,
    /// The two ends where it is not closed.
    pub ends: Vec<End>,
    /// What is met on the way, by arclength.
    pub events: Vec<Event>,
    /// One row per joint variable.
    pub ranges: Vec<Range>,
    /// What is equidistant.
    pub spacing: Spacing,
    /// The samples.
    pub samples: Vec<Sample>,
    /// Wanted drive values that are not reached.
    pub unreached: Vec<Unreached>,
    /// Largest closure of a sample (rad, cycle lengths).
    pub largest_closure: f64,
    /// What the closure is held against: 1e-12, or what the digits of the file leave open.
    pub allowed_closure: f64,
    /// The length in whose units slides count for the arclength (m).
    pub length_unit: f64,
    /// What a reader should know.
    pub notes: Vec<String>,
    /// Whether something is seen to move: more than rods that spin about the line through their balls.
    pub shown: bool,
    /// The curve itself.
    pub curve: Curve,
}
