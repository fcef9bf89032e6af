//! The collection of a mechanism: which points its bodies share, and where they are in each body.
//!
//! Links that are fixed to each other are one body. A ball is a point of both bodies; a hinge is two points of its axis, and
//! where other axes or balls meet the axis, their points are taken, so that what meets in one point is one point (the corner
//! of a box belongs to three faces). A universal joint is a small body, its cross. A bar is a distance, and so is a link that
//! two balls hold: its spin changes nothing.
//!
//! Everything is exact: points are one point where their coordinates are equal as numbers.

mod axes;
mod bodies;
mod nodes;
mod one_body;
mod within;

pub use bodies::{PlacedBody, PlacedLink};
pub use within::Gap;

use crate::collection::{Bar, Body, Collection};
use bodies::{Groups, home_poses};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{ExactPose, Joint, JointKind, Mechanism};
use nodes::Nodes;
use thiserror::Error;

/// A point or vector with exact coordinates (m).
pub type Exact3 = [Number; 3];

/// Why a mechanism is no collection of bodies that share points.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Unsuited {
    /// A joint that makes no points coincide.
    #[error("joint `{joint}` is {kind}: its bodies share no points")]
    Kind {
        /// The joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
    },
    /// A coupling says nothing of points.
    #[error("coupling `{name}` says nothing of shared points")]
    Coupling {
        /// The coupling.
        name: String,
    },
    /// A body that less than three points hold: it can turn about them.
    #[error("link `{link}` has {points} shared points: it turns about them")]
    Loose {
        /// A link of the body.
        link: String,
        /// Number of points.
        points: usize,
    },
    /// A body whose points are on one line.
    #[error("the shared points of link `{link}` are on one line")]
    Collinear {
        /// A link of the body.
        link: String,
    },
    /// A point in which only bars meet.
    #[error("only bars meet in the point of `{point}`")]
    OnlyBars {
        /// The point.
        point: String,
    },
    /// Fixed and held joints make one body of all links, and everything else closes: nothing is left to solve.
    #[error("all links are one body")]
    OneBody(Vec<PlacedLink>),
    /// What excludes each other.
    #[error("{0}")]
    Contradiction(Box<Mismatch>),
}

/// Two things that a mechanism asks for and that exclude each other. In names of points and bodies.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Mismatch {
    /// Two points are not equally far apart in two bodies, or in a body and a bar.
    Distances {
        /// The points.
        points: [String; 2],
        /// The bodies, or bars.
        bodies: [String; 2],
        /// The distances there, six decimals (m).
        distances: [String; 2],
    },
    /// A joint between two sides of one body, which does not close.
    Within {
        /// The joint.
        joint: String,
        /// A link of the body.
        link: String,
        /// How far its sides are apart.
        gap: Gap,
    },
    /// Joints make one point of two points of one body.
    Torn {
        /// The points.
        points: [String; 2],
        /// The body.
        body: String,
        /// How far they are apart in it.
        gap: Gap,
    },
}

impl Mismatch {
    /// How far what should meet is apart in one body.
    #[must_use]
    pub const fn gap(&self) -> Option<&Gap> {
        match self {
            Self::Within { gap, .. } | Self::Torn { gap, .. } => Some(gap),
            Self::Distances { .. } => None,
        }
    }
}

impl std::fmt::Display for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Distances {
                points: [p, q],
                bodies: [a, b],
                distances: [one, two],
            } => write!(
                f,
                "points `{p}` and `{q}` are {one} m apart in `{a}` and {two} m in `{b}`"
            )?,
            Self::Within { joint, link, gap } => write!(
                f,
                "joint `{joint}` joins two sides of one body, that of link `{link}`, which are {gap}"
            )?,
            Self::Torn {
                points: [p, q],
                body,
                gap,
            } => write!(
                f,
                "points `{p}` and `{q}` of `{body}` are {gap}, and joints make them one point"
            )?,
        }
        f.write_str(": nothing closes")
    }
}

/// How far numbers may be from those meant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slack {
    /// In parts of the largest coefficient of an equation, and of an angle (rad).
    pub share: f64,
    /// Of a length (m).
    pub metres: f64,
}

/// A mechanism as bodies with exact points.
#[derive(Clone, Debug)]
pub struct Placed {
    /// Bodies and bars.
    pub collection: Collection,
    /// The bodies' links and coordinates, by body.
    pub bodies: Vec<PlacedBody>,
    /// Squared lengths of the bars (m²).
    pub bar_squares: Vec<Number>,
    /// Whether some joint closes within a body: with other numbers it might not.
    pub redundant: bool,
    /// How much farther than the points by which bodies became one other points of theirs move at most, where the former are off
    /// by a little.
    pub lever: f64,
}

impl Placed {
    /// Reads off a mechanism; links that [`Mechanism::with_joints_held`] fixed are one body.
    ///
    /// # Errors
    /// [`Unsuited`] where something else than shared points and distances holds it together, or where shared points
    /// contradict each other.
    pub fn of(mechanism: &Mechanism) -> Result<Self, Unsuited> {
        Self::within(mechanism, &Slack::default())
    }

    /// The same where numbers are known so far: what contradicts each other by no more does not.
    ///
    /// # Errors
    /// [`Unsuited`].
    pub fn within(mechanism: &Mechanism, slack: &Slack) -> Result<Self, Unsuited> {
        let mut groups = Groups::of(mechanism);
        let mut lever = 1.0;
        // Every body that becomes one with another may bring more points together.
        loop {
            let (nodes, bars) = shared(mechanism, &mut groups, slack)?;
            if let Some(joined) = one_body::joined(&nodes, slack) {
                lever *= joined.lever;
                groups.merge(&joined);
                continue;
            }
            groups.check_torn(&nodes)?;
            let placed = groups.finish(mechanism, &nodes, bars, slack)?;
            return Ok(Self { lever, ..placed });
        }
    }
}

/// Names, ends and squared lengths of bars.
type Bars = Vec<(String, [usize; 2], Number)>;

/// The points of all bodies, joined where bodies share them, and the bars; where what holds within one body closes.
fn shared(
    mechanism: &Mechanism,
    groups: &mut Groups,
    slack: &Slack,
) -> Result<(Nodes, Bars), Unsuited> {
    let sides = |joint: &Joint, groups: &Groups| {
        [&joint.predecessor, &joint.successor].map(|side| {
            let (group, pose) = groups.place(side.link);
            (group, pose.then(&ExactPose::of(&side.frame)))
        })
    };
    let mut left = Vec::new();
    for joint in mechanism.joints() {
        let [one, other] = sides(joint, groups);
        if one.0 != other.0 || within::leaves_a_freedom(joint) {
            left.push((joint, one, other));
            continue;
        }
        let square = bar_square(mechanism, joint);
        let gap = within::gap(joint, [&one.1, &other.1], &square);
        if let Some(gap) = gap.filter(|gap| gap.is_beyond(slack)) {
            return Err(Unsuited::Contradiction(Box::new(Mismatch::Within {
                joint: joint.name.clone(),
                link: groups.name(one.0).to_owned(),
                gap,
            })));
        }
    }
    if let Some(coupling) = mechanism.couplings().first() {
        return Err(Unsuited::Coupling {
            name: coupling.name.clone(),
        });
    }
    if let Some(links) = groups.only_body(mechanism, slack)? {
        return Err(Unsuited::OneBody(links));
    }
    let mut nodes = Nodes::default();
    let mut bars: Bars = Vec::new();
    let mut hinges = Vec::new();
    for (joint, one, other) in left {
        let name = &joint.name;
        match joint.kind {
            JointKind::Spherical => {
                let a = nodes.add(one.0, one.1.translation, name);
                let b = nodes.add(other.0, other.1.translation, name);
                nodes.join(a, b);
            }
            JointKind::Distance => {
                let square = bar_square(mechanism, joint);
                let a = nodes.add(one.0, one.1.translation, &format!("{name}.1"));
                let b = nodes.add(other.0, other.1.translation, &format!("{name}.2"));
                bars.push((name.clone(), [a, b], square));
            }
            JointKind::Revolute => {
                let axis = [&one.1, &other.1].map(|pose| pose.rotate(&joint.axis.0));
                hinges.push(axes::Hinge::new(name, one, other, axis));
            }
            JointKind::Universal => {
                // The cross: its frame is the joint's, at the joint's home.
                let (cross, at) = groups.cross(name);
                for (side, axis) in [(one, &joint.axis.0), (other, &joint.axis2.0)] {
                    let axis = [side.1.rotate(axis), at.rotate(axis)];
                    hinges.push(axes::Hinge::new(name, side, (cross, at.clone()), axis));
                }
            }
            other => {
                return Err(Unsuited::Kind {
                    joint: name.clone(),
                    kind: other.word(),
                });
            }
        }
    }
    let size = (slack.share > 0.0).then(|| slack.metres / slack.share);
    axes::share_points(&hinges, &mut nodes, size);
    Ok((nodes, bars))
}

/// The squared length of a bar (zero of any other joint): as stated, or between its points where the file draws them.
fn bar_square(mechanism: &Mechanism, joint: &Joint) -> Number {
    if joint.kind != JointKind::Distance {
        return Number::zero();
    }
    if let Some(distance) = &joint.distance {
        return distance * distance;
    }
    let home = home_poses(mechanism);
    let [a, b] = [&joint.predecessor, &joint.successor]
        .map(|side| home[side.link.0].apply(&side.frame.position));
    square(&minus(&a, &b))
}

/// The difference of two points.
pub(crate) fn minus(a: &Exact3, b: &Exact3) -> Exact3 {
    [0, 1, 2].map(|i| &a[i] - &b[i])
}

/// The squared length of a vector (m²).
pub(crate) fn square(v: &Exact3) -> Number {
    dot(v, v)
}

/// The scalar product.
pub(crate) fn dot(a: &Exact3, b: &Exact3) -> Number {
    let mut sum = Number::zero();
    for (x, y) in a.iter().zip(b) {
        let plain_zero = |n: &Number| n.rational().is_some_and(|r| r.is_zero());
        if !plain_zero(x) && !plain_zero(y) {
            sum = &sum + &(x * y);
        }
    }
    sum
}

/// The vector product.
pub(crate) fn cross(a: &Exact3, b: &Exact3) -> Exact3 {
    let part = |i: usize, j: usize| &(&a[i] * &b[j]) - &(&a[j] * &b[i]);
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// What is put together of all this.
pub(crate) fn collection(
    points: Vec<String>,
    bodies: Vec<Body>,
    bars: Vec<Bar>,
) -> Option<Collection> {
    Collection::new(points, bodies, bars).ok()
}
