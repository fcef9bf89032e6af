//! A planar mechanism as a sketch: hinges are points, sliders are lines, links hold them against each other.
//!
//! A hinge is a point that two bodies share, a slider a directed line that two bodies share. What one body has of these it keeps as
//! drawn: enough constraints for that are stated, and its triangles are never turned over
//! ([`Sketch::with_rigid`](crate::sketch::Sketch::with_rigid)). Links that are fixed to each other are one body, and so are those of
//! a joint that is held. Everything is seen along the hinges; both sides of every joint have to be equally far along them.
//!
//! Values are exact: lengths are square roots, angles inverse circular functions of what the file states.

mod bodies;
mod body;
mod places;
mod poses;

use crate::construction::Shape;
use crate::named::NamedSketch;
use crate::sketch::{Element, Sketch, SketchError};
use bodies::Bodies;
pub(crate) use body::{Exact, hold};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{JointKind, Mechanism};
use places::View;
use poses::Links;
use thiserror::Error;

/// Why a mechanism is no sketch.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NotPlanar {
    /// No joint turns, so that nothing says in which plane it moves.
    #[error("no joint turns: nothing says from where to look")]
    NoHinge,
    /// A joint of another kind.
    #[error("joint `{joint}` is {kind}: planar parts have hinges and sliders")]
    Kind {
        /// The joint.
        joint: String,
        /// Its kind.
        kind: &'static str,
    },
    /// A hinge that is not parallel to the others, or a slider that is not normal to them.
    #[error("joint `{joint}` does not move in the plane of the others")]
    Axis {
        /// The joint.
        joint: String,
    },
    /// A coupling says nothing of points and lines.
    #[error("coupling `{name}` says nothing of points and lines")]
    Coupling {
        /// The coupling.
        name: String,
    },
    /// A body with more lines than its points hold: three without a point, or two that are parallel with one.
    #[error("the sliders of link `{link}` are not all held by its hinges")]
    LinesOnly {
        /// A link of the body.
        link: String,
    },
    /// A body with nothing but parallel lines.
    #[error(
        "all sliders of link `{link}` are parallel, and it has no hinge: it is free along them"
    )]
    Parallel {
        /// A link of the body.
        link: String,
    },
    /// Fixed and held joints make one body of both sides of a joint that does not close there.
    #[error(
        "joint `{joint}` joins two sides of one body, that of link `{link}`, which are {gap} apart: nothing closes as it is written"
    )]
    Within {
        /// The joint.
        joint: String,
        /// A link of the body.
        link: String,
        /// How far the sides are apart, with its unit.
        gap: String,
    },
    /// The two sides of a joint are not equally far along the hinges, which no motion in the plane changes.
    #[error(
        "the sides of joint `{joint}` are {gap} apart along the hinges: nothing closes as it is written"
    )]
    Offset {
        /// The joint.
        joint: String,
        /// How far, with its unit.
        gap: String,
    },
    /// The hinge axis or the slider's frame points the other way on one side of a joint.
    #[error(
        "one side of joint `{joint}` is turned out of the plane against the other: nothing closes as it is written"
    )]
    TurnedOver {
        /// The joint.
        joint: String,
    },
    /// Joints that are in one place on some links and in two on another.
    #[error("link `{link}` has `{}` and `{}` in two places, other links in one", joints[0], joints[1])]
    Apart {
        /// A link of the body.
        link: String,
        /// The joints.
        joints: [String; 2],
    },
    /// A body with one hinge or slider: it turns or slides there whatever the others do.
    #[error("link `{link}` is held in `{joint}` only: it is free there")]
    Open {
        /// A link of the body.
        link: String,
        /// The hinge or slider.
        joint: String,
    },
    /// Fixed joints that are not closed as drawn.
    #[error("fixed joint `{joint}` is not closed as drawn")]
    Fixed {
        /// The joint.
        joint: String,
    },
    /// The sketch is none; the two joints named are its elements.
    #[error("joints {between}: {why}")]
    Sketch {
        /// The joints.
        between: String,
        /// Why.
        why: SketchError,
    },
}

/// A planar mechanism and its sketch.
#[derive(Clone, Debug)]
pub struct Planar {
    /// The sketch as drawn at home; its elements are named as the joints.
    pub sketch: NamedSketch,
    view: View,
    links: Links,
}

impl Planar {
    /// Reads off a mechanism.
    ///
    /// # Errors
    /// [`NotPlanar`], at the first joint that does not fit.
    pub fn of(mechanism: &Mechanism) -> Result<Self, NotPlanar> {
        read_off(mechanism)
    }

    /// `world_from_link` of all links (m) where the elements are at these places, up to one motion of the plane for all; `None` where a link
    /// has no two elements that hold it.
    #[must_use]
    pub fn poses(&self, shapes: &[Shape]) -> Option<Vec<Rigid<f64>>> {
        self.links.poses(&self.view, shapes)
    }
}

/// The sketch of a planar mechanism as drawn at home; its elements are named as its joints.
///
/// # Errors
/// [`NotPlanar`], at the first joint that does not fit.
pub fn sketch(mechanism: &Mechanism) -> Result<NamedSketch, NotPlanar> {
    Planar::of(mechanism).map(|planar| planar.sketch)
}

fn read_off(mechanism: &Mechanism) -> Result<Planar, NotPlanar> {
    if let Some(coupling) = mechanism.couplings().first() {
        let name = coupling.name.clone();
        return Err(NotPlanar::Coupling { name });
    }
    let homes = bodies::homes(mechanism);
    let view = View::of(mechanism, &homes)?;
    let bodies = Bodies::of(mechanism, &homes, &view)?;
    let mut constraints = Vec::new();
    let mut rigid = Vec::new();
    for (name, held) in bodies.held() {
        if let [(joint, _)] = held {
            return Err(NotPlanar::Open {
                link: name.to_owned(),
                joint: bodies.names[*joint].clone(),
            });
        }
        let parallel = |(_, e): &(usize, Exact)| e.is_line() && e.parallel(&held[0].1);
        if !held.is_empty() && held.iter().all(parallel) {
            return Err(NotPlanar::Parallel {
                link: name.to_owned(),
            });
        }
        let of_body = body::hold(held).ok_or_else(|| NotPlanar::LinesOnly {
            link: name.to_owned(),
        })?;
        constraints.extend(of_body.constraints);
        rigid.extend(of_body.triangles);
    }
    let elements: Vec<Element> = bodies.elements.iter().map(Exact::drawn).collect();
    let ends: Vec<[usize; 2]> = constraints.iter().map(|c| c.ends).collect();
    let sketch = Sketch::new(elements, constraints).map_err(|why| {
        let pair = match why {
            SketchError::Doubled { second, .. } | SketchError::Contradictory { second, .. } => {
                Some(ends[second])
            }
            SketchError::ZeroLength(i) | SketchError::Negative(i) => Some(ends[i]),
            _ => None,
        };
        let named = |[u, v]: [usize; 2]| format!("`{}` and `{}`", bodies.names[u], bodies.names[v]);
        NotPlanar::Sketch {
            between: pair.map_or_else(String::new, named),
            why,
        }
    })?;
    Ok(Planar {
        sketch: NamedSketch::new(
            mechanism.name().to_owned(),
            bodies.names,
            sketch.with_rigid(rigid),
        ),
        view,
        links: Links {
            homes,
            body: bodies.of_link,
            held: bodies.of_body.into_iter().map(|(_, held)| held).collect(),
        },
    })
}

/// Metres as millimetres; tiny ones keep their digits.
fn millimetres(metres: f64) -> String {
    match metres.abs() * 1e3 {
        small if small < 1e-3 => format!("{small:.3e} mm"),
        length => format!("{length:.3} mm"),
    }
}

/// Whether a joint of this kind is an element.
const fn is_element(kind: JointKind) -> bool {
    matches!(kind, JointKind::Revolute | JointKind::Prismatic)
}
