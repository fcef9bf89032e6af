//! Points beside faces and solids, and whether a solid is turned outwards.

use super::cut::pierced;
use super::{Boundary, Face, Ratio};
use crate::decide::{Certainty, Decider, Outcome, Sign};
use crate::entity::Point;
use crate::error::{GeometryError, Spot};
use crate::planar::Place;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, minus, plus};
use std::cmp::Ordering;

/// So many rays are tried where digits leave each of them in doubt: another one would hardly do better.
const DOUBTFUL_RAYS: usize = 8;

/// Where a point is beside a face: inside between its loops, on one of them, or outside and off its plane.
#[must_use]
pub fn classify_in_face<S: Scalar>(point: &Point<S>, face: &Face<S>) -> Outcome<Place> {
    let mut decider = Decider::default();
    let place = in_face(point, face, &mut decider);
    decider.outcome(place)
}

fn in_face<S: Scalar>(point: &Point<S>, face: &Face<S>, decider: &mut Decider) -> Place {
    let mut level = Decider::default();
    if !level.is_zero(&face.plane().height(&point.0)) {
        return Place::Outside;
    }
    let mut flat = Decider::default();
    let place = face.place(&Ratio::of(&point.0), &mut flat);
    let certainty = flat.certainty();
    // What is certainly outside of the loops is outside whatever its height.
    if place != Place::Outside || certainty != Certainty::Proven {
        decider.weaken(level.certainty().max(certainty));
    }
    place
}

/// Where a point is beside a solid: inside its material, on a face, or outside, cavities among that.
///
/// # Errors
/// Where the boundary was not made as one of a solid.
pub fn classify_in_solid<S: Scalar>(
    point: &Point<S>,
    solid: &Boundary<S>,
) -> Result<Outcome<Place>, GeometryError> {
    if !solid.is_solid() {
        return Err(GeometryError::Degenerate {
            needed: "the boundary of a solid",
            found: "one that may be open: make it with build_solid",
        });
    }
    let mut decider = Decider::default();
    let faces: Vec<&Face<S>> = solid.faces().iter().collect();
    let place = in_shells(point, &faces, &mut decider);
    Ok(decider.outcome(place))
}

/// Where a point is beside closed shells: inside where a ray from it passes faces an odd number of times.
fn in_shells<S: Scalar>(point: &Point<S>, faces: &[&Face<S>], decider: &mut Decider) -> Place {
    let mut doubt = Certainty::Proven;
    for face in faces {
        let mut own = Decider::default();
        if in_face(point, face, &mut own) != Place::Outside {
            decider.weaken(own.certainty());
            return Place::OnBorder;
        }
        doubt = doubt.max(own.certainty());
    }
    decider.weaken(doubt);
    // Directions (1, k, k²): no three of them are in one plane, so that each edge spoils at most two, and each face in the
    // plane of which the point is two as well; one more is certainly free.
    let edges: usize = faces.iter().map(|face| face.corners().count()).sum();
    let mut best: Option<Outcome<bool>> = None;
    let mut usable_in_doubt = 0;
    for k in 1..=2 * (edges + faces.len()) + 1 {
        let mut own = Decider::default();
        let ray = ray(k);
        if let Some(odd) = passes(point, &ray, faces, &mut own) {
            let outcome = own.outcome(odd);
            let certainty = outcome.certainty;
            if best.as_ref().is_none_or(|b| certainty < b.certainty) {
                best = Some(outcome);
            }
            if certainty == Certainty::Proven {
                break;
            }
            usable_in_doubt += 1;
        } else if own.certainty() != Certainty::Proven {
            usable_in_doubt += 1;
        }
        if usable_in_doubt >= DOUBTFUL_RAYS {
            break;
        }
    }
    match best {
        Some(outcome) => match decider.take(outcome) {
            true => Place::Inside,
            false => Place::Outside,
        },
        // No ray could be followed: nothing tells the point from one on the border.
        None => {
            decider.weaken(Certainty::WithinDigits);
            Place::OnBorder
        }
    }
}

/// One of the directions along which rays are followed.
fn ray<S: Scalar>(k: usize) -> [S; 3] {
    // As products, for k beyond what an integer of 32 bits has a square of.
    let step = S::whole(i32::try_from(k).unwrap_or(i32::MAX));
    [S::whole(1), step.clone(), step.squared()]
}

/// Whether a ray from a point off all faces passes an odd number of them; `None` where it meets a border, or runs in the
/// plane of a face.
fn passes<S: Scalar>(
    point: &Point<S>,
    ray: &[S; 3],
    faces: &[&Face<S>],
    decider: &mut Decider,
) -> Option<bool> {
    let mut odd = false;
    for face in faces {
        let rise = dot(ray, face.plane().normal().components());
        let height = face.plane().height(&point.0);
        let at = pierced(&point.0, ray, &height, &rise);
        if is_doubtful(&height) && !is_doubtful(&rise) {
            // A plane that is passed off its face matters on neither side of the point.
            let mut off = Decider::default();
            let place = face.place(&at, &mut off);
            if place == Place::Outside && off.certainty() == Certainty::Proven {
                continue;
            }
        }
        let (up, above) = (decider.order(&rise), decider.order(&height));
        if above == Ordering::Equal {
            // The point is in the plane, off the face: only a ray in the plane may meet it.
            if up == Ordering::Equal {
                return None;
            }
            continue;
        }
        if up != above.reverse() {
            continue;
        }
        match face.place(&at, decider) {
            Place::Inside => odd = !odd,
            Place::OnBorder => return None,
            Place::Outside => {}
        }
    }
    Some(odd)
}

fn is_doubtful<S: Scalar>(x: &S) -> bool {
    matches!(x.sign(), Sign::WithinDigits | Sign::Indistinguishable)
}

/// Shells around material have their normals outwards, shells around cavities inwards.
pub(super) fn check_outward<S: Scalar>(
    boundary: &Boundary<S>,
    decider: &mut Decider,
) -> Result<(), GeometryError> {
    for (number, shell) in boundary.shells.iter().enumerate() {
        let own = faces_of(boundary, &shell.faces);
        let first = shell.faces.first().copied();
        let wrong = |needed: &'static str, found: &'static str| GeometryError::NoFace {
            spot: Spot {
                face: first,
                ring: None,
                corner: None,
            },
            needed,
            found,
        };
        let cavity = is_cavity(boundary, number, &own, decider).ok_or(wrong(
            "a shell inside or outside of the others",
            "one that touches another everywhere, or may do so within its digits: join both to one",
        ))?;
        let volume = volume(&own);
        let inside_out = match cavity {
            true => Ordering::Greater,
            false => Ordering::Less,
        };
        if decider.order(&volume) == inside_out || volume.sign() == Sign::Zero {
            let found = match cavity {
                true => "a cavity turned like a solid: reverse the loops of all its faces",
                false => "one that is turned inside out: reverse the loops of all its faces",
            };
            return Err(wrong("a shell with its normals out of the material", found));
        }
    }
    Ok(())
}

fn faces_of<'a, S: Scalar>(boundary: &'a Boundary<S>, numbers: &[usize]) -> Vec<&'a Face<S>> {
    let face = |number: &usize| boundary.faces.get(*number);
    numbers.iter().filter_map(face).collect()
}

/// Whether a shell is inside an odd number of others; `None` where this cannot be told.
fn is_cavity<S: Scalar>(
    boundary: &Boundary<S>,
    number: usize,
    own: &[&Face<S>],
    decider: &mut Decider,
) -> Option<bool> {
    let mut odd = false;
    for (other, shell) in boundary.shells.iter().enumerate() {
        if other == number {
            continue;
        }
        let faces = faces_of(boundary, &shell.faces);
        // Any corner off the other shell tells for the whole, as long as the shells do not cross, which is not looked for.
        let told = own
            .iter()
            .flat_map(|face| face.corners())
            .find_map(|corner| {
                let mut choice = Decider::default();
                let place = in_shells(corner, &faces, &mut choice);
                (place != Place::OnBorder).then(|| choice.outcome(place))
            })?;
        odd ^= decider.take(told) == Place::Inside;
    }
    Some(odd)
}

/// Six times the volume that faces enclose, positive where their normals point outwards.
fn volume<S: Scalar>(faces: &[&Face<S>]) -> S {
    let mut whole = S::whole(0);
    let Some(base) = faces.first().map(|face| face.plane().point()) else {
        return whole;
    };
    for face in faces {
        let height = minus(&face.plane().point().0, &base.0);
        let mut area = [S::whole(0), S::whole(0), S::whole(0)];
        for (a, b) in face.edges() {
            let part = cross(&minus(&a.0, &base.0), &minus(&b.0, &base.0));
            area = plus(&area, &part);
        }
        whole = whole.plus(&dot(&height, &area));
    }
    whole
}
