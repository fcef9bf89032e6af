//! The same first-order question in absolute coordinates: one twist per link, `6 − f` equations per joint.
//!
//! It shares nothing with the cycle equations but the joint screws: no cycles, no tree, no signs. Its kernel has the same
//! dimension, which the tests use as an independent check.

use super::cycle::characteristic_length;
use super::displacement::JointState;
use super::geometry::{Geometry, Uncertainty};
use super::jacobian::Part;
use kutzbach_math::matrix::{MatrixError, Real, SparseMatrix};
use kutzbach_math::space::{PlacedScrew, Rigid, Vector, cross, subtract};
use kutzbach_model::mechanism::Mechanism;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Builds the positional matrix of a part: rows are the wrenches reciprocal to each joint's screws, columns the six twist
/// components of every link but the first of each connected piece, each about a point of its own, in units of the part's length.
///
/// Shape: (Σ (6 − f) + couplings) × 6 (links − 1). The kernel is the part's instantaneous motion with one link held.
///
/// # Errors
/// Only if a joint is missing from the part's own links.
pub fn positional_jacobian<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> Result<SparseMatrix<R>, MatrixError> {
    let one = &geometry.one;
    let (poses, held) = part_poses(mechanism, geometry, states, part);
    // World screws of every joint, and the point of every joint.
    let mut placed: Vec<(usize, Rigid<R>, Vec<PlacedScrew<R>>)> =
        Vec::with_capacity(part.joints.len());
    for &joint in &part.joints {
        let link = mechanism.joints()[joint].predecessor.link.0;
        let Some(pose) = poses.get(&link) else {
            continue;
        };
        let frame = pose.compose(&geometry.sides[joint][0]);
        let screws = geometry.displacements[joint]
            .screws(&states[joint])
            .iter()
            .map(|screw| screw.moved(&frame))
            .collect();
        placed.push((joint, frame, screws));
    }
    let reach = placed
        .iter()
        .flat_map(|(_, frame, _)| &frame.translation)
        .fold(0.0, |far: f64, x| far.max(x.to_f64().abs()));
    let uncertainty = Uncertainty::total(
        part.joints
            .iter()
            .map(|joint| &geometry.uncertainties[*joint]),
    );
    let (_, length) = characteristic_length(
        placed.iter().flat_map(|(_, _, screws)| screws),
        reach,
        || {
            let arms = part.joints.iter().map(|&j| geometry.arms[j]);
            arms.fold(0.0, f64::max)
        },
        &uncertainty,
    );
    let inverse_length = one.constant(1.0 / length);
    // The reference point of a link is one of its joints, so that arms stay short.
    let mut reference: BTreeMap<usize, Vector<R>> = BTreeMap::new();
    for (joint, frame, _) in &placed {
        let joint = &mechanism.joints()[*joint];
        for link in [joint.predecessor.link.0, joint.successor.link.0] {
            reference
                .entry(link)
                .or_insert_with(|| frame.translation.clone());
        }
    }
    let first_column: BTreeMap<usize, usize> = poses
        .keys()
        .filter(|link| !held.contains(link))
        .enumerate()
        .map(|(index, link)| (*link, 6 * index))
        .collect();
    let mut equations = Equations {
        mechanism,
        reference,
        first_column,
        inverse_length,
        triplets: Vec::new(),
    };
    let mut rows = 0;
    let mut blocks = Vec::new();
    for (joint, frame, screws) in &placed {
        let point = &frame.translation;
        let twists: Vec<[R; 6]> = screws
            .iter()
            .map(|s| twist_about(s, point, &equations.inverse_length))
            .collect();
        let wrenches = complement(&twists, one);
        if !wrenches.is_empty() {
            blocks.push(rows);
        }
        for wrench in wrenches {
            equations.add(rows, &wrench, point, *joint);
            rows += 1;
        }
    }
    let place_of: BTreeMap<usize, usize> = placed
        .iter()
        .enumerate()
        .map(|(place, (joint, _, _))| (*joint, place))
        .collect();
    for &coupling in &part.couplings {
        blocks.push(rows);
        for (joint, factor) in geometry.couplings[coupling].slopes(states) {
            let Some((_, frame, screws)) = place_of.get(&joint).map(|&place| &placed[place]) else {
                continue;
            };
            let Some(screw) = screws.first() else {
                continue;
            };
            // The rate of a joint of one freedom is its relative twist times the dual vector S / (S·S).
            let twist = twist_about(screw, &frame.translation, &equations.inverse_length);
            let square = one.dot(&twist, &twist);
            let functional = twist.map(|x| x * factor.clone() / square.clone());
            equations.add(rows, &functional, &frame.translation, joint);
        }
        rows += 1;
    }
    let columns = 6 * equations.first_column.len();
    SparseMatrix::from_triplets(rows, columns, one.zero_like(), equations.triplets)?
        .with_row_blocks(blocks)
}

/// Poses of the part's links relative to the first of their connected piece, along a breadth-first tree of the joints,
/// and those first links. (Couplings may tie together pieces that no joint connects.)
fn part_poses<R: Real>(
    mechanism: &Mechanism,
    geometry: &Geometry<R>,
    states: &[JointState<R>],
    part: &Part,
) -> (BTreeMap<usize, Rigid<R>>, BTreeSet<usize>) {
    let mut incident: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &index in &part.joints {
        let joint = &mechanism.joints()[index];
        incident
            .entry(joint.predecessor.link.0)
            .or_default()
            .push(index);
        incident
            .entry(joint.successor.link.0)
            .or_default()
            .push(index);
    }
    let mut poses = BTreeMap::new();
    let mut held = BTreeSet::new();
    let starts: Vec<usize> = incident.keys().copied().collect();
    for start in starts {
        if poses.contains_key(&start) {
            continue;
        }
        poses.insert(start, Rigid::identity(&geometry.one));
        held.insert(start);
        let mut queue = VecDeque::from([start]);
        while let Some(link) = queue.pop_front() {
            for &index in incident.get(&link).into_iter().flatten() {
                let joint = &mechanism.joints()[index];
                let [predecessor, successor] = &geometry.sides[index];
                let displacement = geometry.displacements[index].displacement(&states[index]);
                let across = predecessor
                    .compose(&displacement)
                    .compose(&successor.inverse());
                let (other, step) = if joint.predecessor.link.0 == link {
                    (joint.successor.link.0, across)
                } else {
                    (joint.predecessor.link.0, across.inverse())
                };
                if poses.contains_key(&other) {
                    continue;
                }
                let Some(pose) = poses.get(&link).map(|pose: &Rigid<R>| pose.compose(&step)) else {
                    continue;
                };
                poses.insert(other, pose);
                queue.push_back(other);
            }
        }
    }
    (poses, held)
}

fn twist_about<R: Real>(screw: &PlacedScrew<R>, point: &Vector<R>, inverse_length: &R) -> [R; 6] {
    let (angular, linear) = screw.about(point);
    let [a, b, c] = angular;
    let [x, y, z] = linear.map(|v| v * inverse_length.clone());
    [a, b, c, x, y, z]
}

/// The equations collected so far, and what a row needs to know of the links.
struct Equations<'a, R> {
    mechanism: &'a Mechanism,
    /// The point every link's velocity is that of.
    reference: BTreeMap<usize, Vector<R>>,
    /// First of the six columns of every link that can move.
    first_column: BTreeMap<usize, usize>,
    inverse_length: R,
    triplets: Vec<(usize, usize, R)>,
}

impl<R: Real> Equations<'_, R> {
    /// Adds `⟨wrench, twist(successor) − twist(predecessor)⟩` at a joint's point to a row.
    fn add(&mut self, row: usize, wrench: &[R; 6], point: &Vector<R>, joint: usize) {
        let joint = &self.mechanism.joints()[joint];
        let moment = [wrench[0].clone(), wrench[1].clone(), wrench[2].clone()];
        let force = [wrench[3].clone(), wrench[4].clone(), wrench[5].clone()];
        for (link, negative) in [
            (joint.successor.link.0, false),
            (joint.predecessor.link.0, true),
        ] {
            let (Some(&column), Some(origin)) =
                (self.first_column.get(&link), self.reference.get(&link))
            else {
                continue;
            };
            // The velocity at the joint is v + ω × arm, so the moment about the link's point gains arm × force.
            let arm = subtract(point, origin).map(|x| x * self.inverse_length.clone());
            let gained = cross(&arm, &force);
            for i in 0..3 {
                let entries = [
                    (column + i, moment[i].clone() + gained[i].clone()),
                    (column + 3 + i, force[i].clone()),
                ];
                for (column, entry) in entries {
                    let entry = if negative { -entry } else { entry };
                    self.triplets.push((row, column, entry));
                }
            }
        }
    }
}

/// An orthonormal basis of the complement of a few independent vectors in six dimensions, by Gram–Schmidt done twice.
/// Vectors that depend on the others (a universal joint with parallel axes) leave a larger complement.
fn complement<R: Real>(vectors: &[[R; 6]], like: &R) -> Vec<[R; 6]> {
    let drop_below = 64.0 * like.unit_roundoff();
    let mut basis: Vec<[R; 6]> = Vec::with_capacity(6);
    let reduce = |basis: &[[R; 6]], mut v: [R; 6]| {
        for _ in 0..2 {
            for b in basis {
                let part = -like.dot(b, &v);
                part.add_scaled(b, &mut v);
            }
        }
        v
    };
    for vector in vectors {
        let size = like.dot(vector, vector).sqrt();
        let reduced = reduce(&basis, vector.clone());
        let norm = like.dot(&reduced, &reduced).sqrt();
        if norm.to_f64() > drop_below * size.to_f64() {
            basis.push(reduced.map(|x| x / norm.clone()));
        }
    }
    let spanned = basis.len();
    while basis.len() < 6 {
        // The coordinate vector that keeps most of its length: never shorter than √((6 − k)/6).
        let best = (0..6)
            .map(|i| {
                let mut v = [0, 1, 2, 3, 4, 5].map(|_| like.zero_like());
                v[i] = like.one_like();
                let reduced = reduce(&basis, v);
                let norm = like.dot(&reduced, &reduced).sqrt();
                (reduced, norm)
            })
            .fold(None::<([R; 6], R)>, |best, candidate| match best {
                Some(best) if best.1 >= candidate.1 => Some(best),
                _ => Some(candidate),
            });
        let Some((vector, norm)) = best else { break };
        basis.push(vector.map(|x| x / norm.clone()));
    }
    basis.split_off(spanned)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::geometry::Arithmetic;
    use super::super::jacobian::jacobian;
    use super::super::samples::{
        CRANK_ROCKER, Place, Written, flat_parallelogram, four_bar, general_four, planar, ring,
        sarrus, spherical,
    };
    use super::*;
    use crate::Structure;
    use kutzbach_math::matrix::{Ring, decide};
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{JointBuilder, JointKind, MechanismBuilder};

    fn nullities(mechanism: &Mechanism) -> [Option<usize>; 2] {
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        let structure = Structure::new(mechanism);
        let [part] = structure.parts.as_slice() else {
            return [None; 2];
        };
        let states = &geometry.states;
        let by_cycles = jacobian(mechanism, &geometry, states, part).unwrap().matrix;
        let by_links = positional_jacobian(mechanism, &geometry, states, part).unwrap();
        [by_cycles, by_links].map(|mut matrix| {
            matrix.scale_columns();
            decide(&matrix, 1e-13).unwrap().nullity()
        })
    }

    #[test]
    fn both_formulations_leave_the_same_freedom() {
        let sphere = ring(
            &spherical([0.5, 0.0, 1.0], [1.0; 4]),
            [0.0; 3],
            Written::Exactly,
        );
        for (mechanism, freedom) in [
            (four_bar(), 1),
            (sarrus(), 1),
            (general_four(), 0),
            (flat_parallelogram(), 2),
            (sphere, 1),
        ] {
            assert_eq!(nullities(&mechanism), [Some(freedom); 2]);
        }
    }

    #[test]
    fn every_kind_of_joint_agrees() {
        // Each kind closes a ring with two balls and a hinge.
        for kind in JointKind::ALL
            .into_iter()
            .filter(|k| *k != JointKind::Distance)
        {
            let along = if kind.uses_second_axis() && kind.uses_axis() {
                // The same direction on both sides would be a line across its own plane.
                continue;
            } else {
                [0.5, 0.25, 1.0]
            };
            let places: Vec<Place> = vec![
                (JointKind::Revolute, [0.0, 0.0, 0.0], [1.0, 0.5, 0.0]),
                (JointKind::Spherical, [1.0, 0.5, 0.0], [0.0; 3]),
                (JointKind::Spherical, [2.0, 0.0, 1.0], [0.0; 3]),
                (kind, [0.0, 1.0, 1.0], along),
            ];
            let found = nullities(&ring(&places, [0.0; 3], Written::Exactly));
            assert!(
                found[0].is_some() && found[0] == found[1],
                "{kind}: {found:?}"
            );
        }
    }

    #[test]
    fn couplings_hold_in_both() {
        // Two pairs of links that only a gear ties together, then a coupled four-bar.
        let mut builder = MechanismBuilder::new("gears");
        builder.link("ground").link("wheel").link("rack");
        builder.joint(JointBuilder::tree(
            "turn",
            JointKind::Revolute,
            "ground",
            "wheel",
        ));
        builder.joint(JointBuilder::tree(
            "slide",
            JointKind::Prismatic,
            "ground",
            "rack",
        ));
        builder.mimic("slide", "turn", Number::integer(3), Number::zero());
        assert_eq!(nullities(&builder.build().unwrap()), [Some(1); 2]);
        let mut builder = MechanismBuilder::new("geared");
        builder.link("ground");
        super::super::samples::add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        builder.mimic("r_b", "r_a", Number::integer(3), Number::zero());
        assert_eq!(nullities(&builder.build().unwrap()), [Some(0); 2]);
    }

    #[test]
    fn complements_are_orthonormal_and_orthogonal() {
        let given = [
            [1.0, 2.0, 0.0, 0.0, 1e-9, 0.0],
            [0.0, 0.0, 3.0, 0.0, 0.0, -1.0],
            // Depends on the first.
            [2.0, 4.0, 0.0, 0.0, 2e-9, 0.0],
        ];
        let found = complement(&given, &1.0);
        assert_eq!(found.len(), 4);
        for (i, a) in found.iter().enumerate() {
            for (j, b) in found.iter().enumerate() {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((1f64.dot(a, b) - expected).abs() < 1e-15);
            }
            assert!(given.iter().all(|g| 1f64.dot(a, g).abs() < 1e-14));
        }
        assert_eq!(complement(&[], &1.0).len(), 6);
    }
}
