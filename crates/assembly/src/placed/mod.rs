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

pub use bodies::{PlacedBody, PlacedLink};

use crate::collection::{Bar, Body, Collection};
use bodies::{Groups, home_poses};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{ExactPose, JointKind, Mechanism};
use nodes::Nodes;
use thiserror::Error;

/// A point or vector with exact coordinates (m).
pub type Exact3 = [Number; 3];

/// Why a mechanism is no collection of bodies that share points.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
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
    /// Fixed joints that place a link in two ways.
    #[error("fixed joint `{joint}` contradicts other fixed or held joints")]
    Fixed {
        /// The joint.
        joint: String,
    },
    /// Two points whose distance is different in two bodies, so that they cannot share both.
    #[error("{0}")]
    Contradiction(Box<Mismatch>),
}

/// Two points that are not equally far apart in two bodies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mismatch {
    /// The points.
    pub points: [String; 2],
    /// The bodies, or bars.
    pub bodies: [String; 2],
    /// The distances there, six decimals (m).
    pub distances: [String; 2],
}

impl std::fmt::Display for Mismatch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let ([p, q], [a, b], [one, two]) = (&self.points, &self.bodies, &self.distances);
        write!(
            f,
            "points `{p}` and `{q}` are {one} m apart in `{a}` and {two} m in `{b}`: nothing closes"
        )
    }
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
}

impl Placed {
    /// Reads off a mechanism; links that [`Mechanism::with_joints_held`] fixed are one body.
    ///
    /// # Errors
    /// [`Unsuited`] where something else than shared points and distances holds it together, or where shared points
    /// contradict each other.
    pub fn of(mechanism: &Mechanism) -> Result<Self, Unsuited> {
        if let Some(coupling) = mechanism.couplings().first() {
            return Err(Unsuited::Coupling {
                name: coupling.name.clone(),
            });
        }
        let mut groups = Groups::of(mechanism)?;
        let mut nodes = Nodes::default();
        let mut bars: Vec<(String, [usize; 2], Number)> = Vec::new();
        let mut hinges = Vec::new();
        for joint in mechanism.joints() {
            let [one, other] = [&joint.predecessor, &joint.successor].map(|side| {
                let (group, pose) = groups.place(side.link);
                (group, pose.then(&ExactPose::of(&side.frame)))
            });
            let name = &joint.name;
            match joint.kind {
                JointKind::Fixed => {}
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
                    let cross = groups.add_cross(name);
                    let at = ExactPose::identity();
                    for (side, axis) in [(one, &joint.axis.0), (other, &joint.axis2.0)] {
                        let axis = [side.1.rotate(axis), axis.clone()];
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
        axes::share_points(&hinges, &mut nodes);
        groups.finish(mechanism, &nodes, bars)
    }
}

/// The squared length of a bar: as stated, or between its points where the file draws them.
fn bar_square(mechanism: &Mechanism, joint: &kutzbach_model::mechanism::Joint) -> Number {
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
