//! Whether two faces are the same set of points.

use super::{Face, classify_in_face};
use crate::decide::{Answer, Certainty, Decider, zero_vector};
use crate::entity::Point;
use crate::planar::Place;
use crate::scalar::Scalar;
use crate::triple::{cross, minus};

/// Whether a point belongs to a face.
pub(crate) fn in_face<S: Scalar>(point: &Point<S>, face: &Face<S>) -> Answer {
    let found = classify_in_face(point, face);
    found.certainty.answer(found.value != Place::Outside)
}

/// Whether two faces in one plane have the same points: the same loops, wherever these begin, in either sense, and whatever
/// corners they have on straight edges.
pub(crate) fn same_points<S: Scalar>(a: &Face<S>, b: &Face<S>) -> Answer {
    let inside = a.corners().map(|corner| in_face(corner, b));
    let around = b.corners().map(|corner| in_face(corner, a));
    let corners = inside.chain(around).fold(Answer::Yes, Answer::and);
    if corners.is_no() {
        return Answer::No;
    }
    let mut decider = Decider::default();
    let own = bent_corners(a, &mut decider);
    let other = bent_corners(b, &mut decider);
    let loops = match own.len() == other.len() {
        true => own
            .iter()
            .map(|x| {
                let among = other.iter().map(|y| same_ring(x, y));
                among.fold(Answer::No, Answer::or)
            })
            .fold(Answer::Yes, Answer::and),
        false => Answer::No,
    };
    match decider.certainty() {
        Certainty::Proven => corners.and(loops),
        // Which corners count is in doubt, and with them everything.
        doubt => doubt.answer(true),
    }
}

/// The corners of loops where these are not straight.
fn bent_corners<'a, S: Scalar>(face: &'a Face<S>, decider: &mut Decider) -> Vec<Vec<&'a Point<S>>> {
    let mut loops = Vec::new();
    for ring in face.loops() {
        let mut bent = Vec::new();
        let before = ring.iter().cycle().skip(ring.len().saturating_sub(1));
        let after = ring.iter().cycle().skip(1);
        for ((a, b), c) in before.zip(ring).zip(after) {
            let turn = cross(&minus(&b.0, &a.0), &minus(&c.0, &b.0));
            if !decider.vanishes(&turn) {
                bent.push(b);
            }
        }
        loops.push(bent);
    }
    loops
}

fn same_ring<S: Scalar>(a: &[&Point<S>], b: &[&Point<S>]) -> Answer {
    let count = a.len();
    if count != b.len() {
        return Answer::No;
    }
    let mut any = Answer::No;
    for start in 0..count {
        let forth = b.iter().cycle().skip(start);
        any = any.or(same_order(a, forth));
        let back = b.iter().rev().cycle().skip(start);
        any = any.or(same_order(a, back));
    }
    any
}

fn same_order<'a, 'b: 'a, S: Scalar + 'b>(
    a: &[&Point<S>],
    b: impl Iterator<Item = &'a &'b Point<S>>,
) -> Answer {
    let mut all = Answer::Yes;
    for (x, y) in a.iter().zip(b) {
        all = all.and(zero_vector(&minus(&x.0, &y.0)));
        if all.is_no() {
            break;
        }
    }
    all
}
