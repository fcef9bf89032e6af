//! How far the sides of loops have to reach, in the measures left open.
//!
//! Equations hold for complex numbers as well. In real ones no side of a closed polygon is longer than all the others together: hinges,
//! universals, balls and rods keep a point of both links, a point on a line or a plane one of the first. A side within one link has
//! one length; one that leads through slides, lines or planes has a least length, so that only it can be too long, where it is the only one of its kind.
//!
//! All of it is exact, so that it holds for every value of a measure; directions that depend on one are left alone.

use super::element::Element;
use super::field::Field;
use super::fraction::{self, from_rational, to_rational};
use super::model::{Axis, JointModel};
use super::space::{Pose, Scalars, Vector, apply, cross, dot, subtract};
use super::{CycleEquations, PolynomialSystem};
use crate::{Budget, Limits, Polynomial, factor};
use kutzbach_model::mechanism::{JointId, JointKind};

/// Work on whether a squared length is the square of a polynomial; what takes more is written as a root.
const MOST_WORK: u64 = 1_000_000;

/// A side of a loop that must not be longer than all the others together, for a pose in real numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Reach {
    /// The joints that keep the ends of the side; the same twice for a rod.
    pub between: [JointId; 2],
    /// The least length of the side.
    pub apart: String,
    /// The lengths of the others.
    pub others: Vec<String>,
    /// By how much it is longer than all others at the file's values (m); negative where they reach.
    pub excess: f64,
}

/// Points p + Σ tᵢ dᵢ.
#[derive(Clone)]
struct Flat {
    point: Vector<Element>,
    directions: Vec<Vector<Element>>,
}

struct Side {
    between: [JointId; 2],
    square: Element,
    rigid: bool,
}

/// What a joint is for the points of the polygon.
enum Passage {
    /// A point is kept: where it may be as the link before sees it, and as the one behind does; the squared length of a rod.
    Kept(Vec<Vector<Element>>, Vec<Vector<Element>>, Option<Element>),
    Slides(Vec<Vector<Element>>),
    Any,
}

impl PolynomialSystem {
    /// What has to hold of the measures left open for a pose in real numbers: for each loop the sides of its polygon that are not longer than the others
    /// whatever the values. Necessary, not sufficient; none where no side depends on a measure.
    #[must_use]
    pub fn reaches(&self) -> Vec<Reach> {
        let mut all: Vec<Reach> = Vec::new();
        for reach in self
            .cycles
            .iter()
            .filter_map(|cycle| self.of_cycle(cycle))
            .flatten()
        {
            if !all.contains(&reach) {
                all.push(reach);
            }
        }
        all
    }

    /// The value of a polynomial in measures and algebraic numbers at the file's values, and the sum of the sizes of its terms; `None` where an unknown
    /// occurs.
    #[must_use]
    pub fn value_in_file(&self, polynomial: &Polynomial) -> Option<(f64, f64)> {
        let own = &self.construction;
        let unknowns = self.variables.len() - own.generators.len();
        let mut sums = (0.0, 0.0);
        for (exponents, coefficient) in polynomial.terms() {
            if exponents[..unknowns].iter().any(|&e| e > 0) {
                return None;
            }
            let powers = exponents[unknowns..].iter().zip(&own.generators);
            let start = fraction::to_f64(&from_rational(coefficient));
            let term = powers.fold(start, |term, (&e, &g)| {
                term * own.field.approximate(&Element::generator(g)).powi(e as i32)
            });
            sums = (sums.0 + term, sums.1 + term.abs());
        }
        Some(sums)
    }

    fn of_cycle(&self, cycle: &CycleEquations) -> Option<Vec<Reach>> {
        let mut field = self.construction.field.clone();
        let sides = self.sides(cycle, &mut field)?;
        let loose = sides.iter().filter(|side| !side.rigid).count();
        let lengths: Vec<String> = sides
            .iter()
            .map(|side| length(&field, &side.square))
            .collect();
        let found = sides.iter().enumerate().filter_map(|(own, side)| {
            // Of two that may be longer than they are known to be neither is bounded.
            if loose > 1 || loose == 1 && side.rigid || side.square.is_zero() {
                return None;
            }
            let others = sides.iter().enumerate();
            let others = others.filter(|(other, side)| *other != own && !side.square.is_zero());
            let others: Vec<usize> = others.map(|(other, _)| other).collect();
            if !may_be_too_long(&field, side, others.iter().map(|&other| &sides[other])) {
                return None;
            }
            let metres = |side: &Side| field.approximate(&side.square).sqrt();
            let reach: f64 = others.iter().map(|&other| metres(&sides[other])).sum();
            let others: Vec<String> = others.iter().map(|&other| lengths[other].clone()).collect();
            (!others.contains(&lengths[own])).then(|| Reach {
                between: side.between,
                apart: lengths[own].clone(),
                others,
                excess: metres(side) - reach,
            })
        });
        Some(found.collect())
    }

    /// The sides of the polygon; `None` where no point is kept, or a direction depends on a measure.
    fn sides(&self, cycle: &CycleEquations, field: &mut Field) -> Option<Vec<Side>> {
        let models = &self.construction.models;
        let mut corners: Vec<(JointId, Pose<Element>, Passage)> = Vec::new();
        let mut step = Pose::identity(&*field);
        for &(joint, forward) in &cycle.joints {
            let model = &models[joint.0];
            let [before, behind] =
                [usize::from(!forward), usize::from(forward)].map(|i| &model.sides[i]);
            step = step.then(&*field, before);
            if model.kind.freedom() > 0 {
                let to_here = std::mem::replace(&mut step, Pose::identity(&*field));
                corners.push((joint, to_here, passage(model, forward)));
            }
            step = step.then(&*field, &behind.inverse(&*field));
        }
        // What follows the last corner leads to the first one.
        let first = corners.first_mut()?;
        first.1 = step.then(&*field, &first.1);
        // A point has one place; across parallel axes, one line along them.
        let most = match across_axes(models, &mut corners, field) {
            true => 1,
            false => 0,
        };
        let is_point = |directions: &Vec<Vector<Element>>| directions.len() <= most;
        let start = corners
            .iter()
            .position(|c| matches!(c.2, Passage::Kept(..)))?;
        let Passage::Kept(_, behind, rod) = &corners[start].2 else {
            return None;
        };
        let mut sides = Vec::new();
        let mut last = corners[start].0;
        let as_rod = |joint: JointId, square: &Element| Side {
            between: [joint, joint],
            square: square.clone(),
            rigid: true,
        };
        sides.extend(rod.iter().map(|square| as_rod(last, square)));
        let mut place = Some(Flat::origin(behind));
        let mut rigid = is_point(behind);
        for offset in 1..=corners.len() {
            let (joint, step, passage) = &corners[(start + offset) % corners.len()];
            place = place.map(|flat| flat.seen_from(step, field));
            match passage {
                Passage::Kept(before, behind, rod) => {
                    let to = Flat::origin(before);
                    let square = match place {
                        Some(flat) => flat.square_to(&to, field)?,
                        None => Element::zero(),
                    };
                    sides.push(Side {
                        between: [last, *joint],
                        square,
                        rigid: rigid && is_point(before),
                    });
                    if offset < corners.len() {
                        sides.extend(rod.iter().map(|square| as_rod(*joint, square)));
                    }
                    last = *joint;
                    rigid = is_point(behind);
                    place = Some(Flat::origin(behind));
                }
                Passage::Slides(directions) => {
                    rigid = false;
                    place = place.map(|mut flat| {
                        flat.directions.extend(directions.iter().cloned());
                        flat
                    });
                }
                Passage::Any => {
                    rigid = false;
                    place = None;
                }
            }
        }
        Some(sides)
    }
}

/// Whether a side depends on a measure, or others that do not make up for it; false where none depends on one.
fn may_be_too_long<'a>(field: &Field, side: &Side, others: impl Iterator<Item = &'a Side>) -> bool {
    let is_open = |side: &Side| field.is_parametric(&side.square);
    let length = |side: &Side| field.approximate(&side.square).sqrt();
    let (open, fixed): (Vec<&Side>, Vec<&Side>) = others.partition(|side| is_open(side));
    // Doubles decide what is clear to a millionth only; the rest is told.
    let clear = length(side) * (1.0 + 1e-6);
    is_open(side) || !open.is_empty() && fixed.into_iter().map(length).sum::<f64>() < clear
}

/// Where all axes are parallel, and nothing but slides is between them, every point may be anywhere on the line through it along the axes, and
/// cylinders and screws keep such lines as hinges do: then the corners are those lines.
fn across_axes(
    models: &[JointModel],
    corners: &mut [(JointId, Pose<Element>, Passage)],
    field: &Field,
) -> bool {
    let turning = |joint: JointId| match models[joint.0].kind {
        JointKind::Revolute | JointKind::Cylindrical | JointKind::Screw => {
            models[joint.0].axis.as_ref().map(|axis| &axis.direction)
        }
        _ => None,
    };
    let slides = |joint: JointId| {
        matches!(
            models[joint.0].kind,
            JointKind::Prismatic | JointKind::PlanarTranslation
        )
    };
    let Some(first) = corners.iter().position(|c| turning(c.0).is_some()) else {
        return false;
    };
    let Some(mut along) = turning(corners[first].0).cloned() else {
        return false;
    };
    for offset in 1..=corners.len() {
        let (joint, step, _) = &corners[(first + offset) % corners.len()];
        along = apply(field, &step.inverse(field).rotation, &along);
        match turning(*joint) {
            Some(axis) if cross(field, &along, axis).iter().all(Element::is_zero) => {
                along = axis.clone()
            }
            None if slides(*joint) => {}
            _ => return false,
        }
    }
    for (joint, _, passage) in corners {
        if let Some(axis) = turning(*joint) {
            *passage = Passage::Kept(vec![axis.clone()], vec![axis.clone()], None);
        }
    }
    true
}

fn passage(model: &JointModel, forward: bool) -> Passage {
    let along = |axis: &Option<Axis>| axis.iter().map(|a| a.direction.clone()).collect::<Vec<_>>();
    let across = |axis: &Option<Axis>| {
        let both = axis.iter().flat_map(|a| &a.across);
        both.map(|a| a.direction.clone()).collect::<Vec<_>>()
    };
    let kept = |there: Vec<Vector<Element>>| match forward {
        true => Passage::Kept(Vec::new(), there, None),
        false => Passage::Kept(there, Vec::new(), None),
    };
    match model.kind {
        JointKind::Revolute | JointKind::Universal | JointKind::Spherical => kept(Vec::new()),
        JointKind::Distance => Passage::Kept(Vec::new(), Vec::new(), model.distance_square.clone()),
        JointKind::PointOnLine => kept(along(&model.axis2)),
        JointKind::PointOnPlane => kept(across(&model.axis2)),
        JointKind::Prismatic => Passage::Slides(along(&model.axis)),
        JointKind::PlanarTranslation => Passage::Slides(across(&model.axis)),
        _ => Passage::Any,
    }
}

impl Flat {
    fn origin(directions: &[Vector<Element>]) -> Self {
        Self {
            point: [0, 1, 2].map(|_| Element::zero()),
            directions: directions.to_vec(),
        }
    }

    /// In the frame that `step` leads to.
    fn seen_from(&self, step: &Pose<Element>, field: &Field) -> Self {
        let back = step.inverse(field);
        let turned = self
            .directions
            .iter()
            .map(|d| apply(field, &back.rotation, d));
        Self {
            point: back.image(field, &self.point),
            directions: turned.collect(),
        }
    }

    /// The squared distance of two flats; `None` where a direction depends on a measure.
    fn square_to(&self, other: &Self, field: &mut Field) -> Option<Element> {
        let way = subtract(&*field, &other.point, &self.point);
        let all: Vec<&Vector<Element>> = self.directions.iter().chain(&other.directions).collect();
        if all.iter().any(|d| d.iter().any(|x| field.is_parametric(x))) {
            return None;
        }
        let is_zero = |v: &Vector<Element>| v.iter().all(Element::is_zero);
        let Some(first) = all.iter().find(|d| !is_zero(d)) else {
            return Some(dot(&*field, &way, &way));
        };
        let normals = all.iter().map(|d| cross(&*field, first, d));
        let normal = normals.into_iter().find(|n| !is_zero(n));
        // Across one direction, or along the normal of two; of three everything can be reached.
        let (square, by) = match normal {
            None => {
                let across = cross(&*field, &way, first);
                (dot(&*field, &across, &across), dot(&*field, first, first))
            }
            Some(normal) => {
                if all.iter().any(|d| !dot(&*field, d, &normal).is_zero()) {
                    return Some(Element::zero());
                }
                let height = dot(&*field, &way, &normal);
                (
                    field.times(&height, &height),
                    dot(&*field, &normal, &normal),
                )
            }
        };
        let inverse = field.inverse(&by).ok()?;
        Some(field.multiply(&square, &inverse))
    }
}

/// The root of a squared length, in words: without a root where it is the square of a polynomial in the measures.
fn length(field: &Field, square: &Element) -> String {
    let count = field.generators().len();
    let terms = square.0.iter().map(|(exponents, coefficient)| {
        let mut full: Vec<u32> = exponents.iter().map(|e| u32::from(*e)).collect();
        full.resize(count, 0);
        (full, to_rational(coefficient))
    });
    let polynomial = Polynomial::from_terms(terms.collect(), count);
    let names: Vec<String> = field.generators().iter().map(|g| g.name.clone()).collect();
    match root(&polynomial) {
        Some(root) if root.as_constant().is_some() => root.text(&names),
        Some(root) => format!("|{}|", root.text(&names)),
        None => format!("sqrt({})", polynomial.text(&names)),
    }
}

/// A polynomial of which this is the square.
fn root(square: &Polynomial) -> Option<Polynomial> {
    if square.is_zero() {
        return Some(square.clone());
    }
    let limits = Limits {
        work: Some(MOST_WORK),
        ..Limits::default()
    };
    let found = factor(square, &Budget::new(limits)).ok()?;
    let unit = fraction::root(&from_rational(&found.unit))?;
    let mut root = Polynomial::constant(to_rational(&unit), square.variables());
    for (factor, times) in &found.factors {
        if times % 2 != 0 {
            return None;
        }
        root = &root * &factor.power(times / 2);
    }
    Some(root)
}
