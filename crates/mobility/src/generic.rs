//! The generic count: what a mechanism of the same topology and joint classes would do with its geometry chosen at random.
//!
//! The rank of the Jacobian at random geometry over a prime field of 2⁶¹ − 1 elements is never above the rank over the
//! reals at generic geometry, and below it with a probability of less than (unknowns / 2⁶¹) (Schwartz 1980). So the
//! difference between this count and the instantaneous freedom is what the *special* geometry does.

use kutzbach_closure::Structure;
use kutzbach_math::matrix::{Field61, MatrixError, Ring, SparseMatrix, SplitMix64, modular_rank};
use kutzbach_model::mechanism::{Joint, JointKind, Mechanism};

type Vector = [Field61; 3];
type Screw = (Vector, Vector);

/// Result of the generic count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GenericCount {
    /// Freedoms at random geometry.
    pub mobility: i64,
    /// Dependent equations at random geometry: those that topology alone makes dependent.
    pub redundant: i64,
}

/// Counts at random geometry. The random numbers depend on joint names only, never on file order.
///
/// # Errors
/// Only if the structure does not belong to the mechanism.
pub fn generic_count(
    mechanism: &Mechanism,
    structure: &Structure,
) -> Result<GenericCount, MatrixError> {
    let zero = Field61::new(0);
    let mut mobility = 6 * structure.loose_pieces as i64;
    let mut redundant = 0;
    mobility += structure
        .free_joints
        .iter()
        .map(|&joint| mechanism.joints()[joint].freedom() as i64)
        .sum::<i64>();
    for part in &structure.parts {
        let mut columns = 0;
        let mut first_column = std::collections::BTreeMap::new();
        for &joint in &part.joints {
            first_column.insert(joint, columns);
            columns += mechanism.joints()[joint].freedom();
        }
        let screws: std::collections::BTreeMap<usize, Vec<Screw>> = part
            .joints
            .iter()
            .map(|&joint| (joint, random_screws(&mechanism.joints()[joint])))
            .collect();
        let mut triplets = Vec::new();
        for (index, cycle) in part.cycles.iter().enumerate() {
            for (joint, forward) in cycle {
                let (Some(&first), Some(screws)) = (first_column.get(joint), screws.get(joint))
                else {
                    continue;
                };
                for (variable, (angular, linear)) in screws.iter().enumerate() {
                    for (row, entry) in angular.iter().chain(linear).enumerate() {
                        let entry = if *forward { *entry } else { -*entry };
                        triplets.push((6 * index + row, first + variable, entry));
                    }
                }
            }
        }
        let mut rows = 6 * part.cycles.len();
        let mut blocks: Vec<usize> = (0..part.cycles.len()).map(|i| 6 * i).collect();
        for &coupling in &part.couplings {
            let coupling = &mechanism.couplings()[coupling];
            let mut random = SplitMix64::named(&coupling.name);
            blocks.push(rows);
            for term in &coupling.terms {
                if let Some(&first) = first_column.get(&term.joint.0) {
                    triplets.push((rows, first, Field61::random(&mut random)));
                }
            }
            rows += 1;
        }
        let matrix =
            SparseMatrix::from_triplets(rows, columns, zero, triplets)?.with_row_blocks(blocks)?;
        let rank = modular_rank(&matrix);
        mobility += columns as i64 - rank as i64;
        redundant += rows as i64 - rank as i64;
    }
    Ok(GenericCount {
        mobility,
        redundant,
    })
}

/// Screws of a joint of the same class in a random place (FORMAT's table, over the prime field; lengths and the sine of
/// angles have no meaning there and none is needed, a span does not change when its vectors are scaled).
fn random_screws(joint: &Joint) -> Vec<Screw> {
    let mut random = SplitMix64::named(&joint.name);
    let zero = Field61::new(0);
    let nothing: Vector = [zero; 3];
    let mut vector = || -> Vector { [0, 1, 2].map(|_| Field61::random(&mut random)) };
    let axis = vector();
    let point = vector();
    let other = vector();
    let helper = vector();
    let pitch = vector()[0];
    let turn =
        |direction: &Vector, point: &Vector| -> Screw { (*direction, cross(point, direction)) };
    let slide = |direction: &Vector| -> Screw { (nothing, *direction) };
    let helix = || -> Screw {
        let moment = cross(&point, &axis);
        (axis, [0, 1, 2].map(|i| moment[i] + pitch * axis[i]))
    };
    let unit = |i: usize| -> Vector {
        let mut v = nothing;
        v[i] = zero.one_like();
        v
    };
    let ball = |point: &Vector| -> Vec<Screw> { (0..3).map(|i| turn(&unit(i), point)).collect() };
    let in_plane = |normal: &Vector| -> [Screw; 2] {
        [
            slide(&cross(normal, &other)),
            slide(&cross(normal, &helper)),
        ]
    };
    match joint.kind {
        JointKind::Fixed => vec![],
        JointKind::Revolute => vec![turn(&axis, &point)],
        JointKind::Prismatic => vec![slide(&axis)],
        JointKind::Screw => vec![helix()],
        JointKind::Cylindrical => vec![slide(&axis), turn(&axis, &point)],
        JointKind::Universal => vec![turn(&axis, &point), turn(&other, &point)],
        JointKind::PlanarTranslation => in_plane(&axis).to_vec(),
        JointKind::Planar => [in_plane(&axis).as_slice(), &[turn(&axis, &point)]].concat(),
        JointKind::Spherical => ball(&point),
        JointKind::Translational => (0..3).map(|i| slide(&unit(i))).collect(),
        JointKind::TranslatingScrew => [in_plane(&axis).as_slice(), &[helix()]].concat(),
        JointKind::Schoenflies => {
            let mut screws: Vec<Screw> = (0..3).map(|i| slide(&unit(i))).collect();
            screws.push(turn(&axis, &point));
            screws
        }
        JointKind::PointOnLine => [ball(&point), vec![slide(&axis)]].concat(),
        JointKind::PointOnPlane => [ball(&point).as_slice(), &in_plane(&axis)].concat(),
        JointKind::LineOnPlane => {
            // The plane's normal is perpendicular to the line; one in-plane direction is the line itself.
            let normal = cross(&axis, &other);
            vec![
                turn(&axis, &point),
                slide(&axis),
                slide(&cross(&normal, &helper)),
                turn(&normal, &point),
            ]
        }
        // Two swings about one end, three rotations about the other; a fourth about the first end would repeat the spin.
        JointKind::Distance => [
            vec![turn(&axis, &point), turn(&helper, &point)],
            ball(&other),
        ]
        .concat(),
    }
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::samples::{Place, Written, four_bar, planar, ring, sarrus};
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{JointBuilder, MechanismBuilder};

    fn count(mechanism: &Mechanism) -> (i64, i64) {
        let found = generic_count(mechanism, &Structure::new(mechanism)).unwrap();
        (found.mobility, found.redundant)
    }

    #[test]
    fn special_geometry_is_not_seen() {
        assert_eq!(count(&four_bar()), (0, 2));
        assert_eq!(count(&sarrus()), (0, 0));
        // Seven hinges in any position move.
        let points: Vec<[f64; 2]> = (0..7).map(|i| [f64::from(i), f64::from(i * i)]).collect();
        assert_eq!(
            count(&ring(&planar(&points), [0.0; 3], Written::Exactly)),
            (1, 0)
        );
    }

    #[test]
    fn what_topology_repeats_is_seen() {
        // A rod between two balls spins whatever the geometry: 3 + 3 freedoms, 5 of them stop it… and two rods in a row
        // on one line would not be generic. A ring of two balls and a fixed joint: three rotations and the spin.
        let places: Vec<Place> = vec![
            (JointKind::Spherical, [0.0; 3], [0.0; 3]),
            (JointKind::Spherical, [1.0, 0.0, 0.0], [0.0; 3]),
            (JointKind::Fixed, [0.0, 1.0, 0.0], [0.0; 3]),
        ];
        assert_eq!(count(&ring(&places, [0.0; 3], Written::Exactly)), (1, 1));
        // Sliders alone never turn: three equations are idle however they point.
        let slider = |x: f64| (JointKind::Prismatic, [x, 0.0, 0.0], [0.0, x, 1.0]);
        let places: Vec<Place> = (0..5).map(|i| slider(f64::from(i))).collect();
        assert_eq!(count(&ring(&places, [0.0; 3], Written::Exactly)), (2, 3));
    }

    #[test]
    fn every_kind_spans_its_freedoms_and_closes_generically() {
        // One joint of the kind and enough hinges: mobility is the excess over six whatever the kind.
        for kind in JointKind::ALL {
            let mut builder = MechanismBuilder::new("loop");
            let hinges = 8 - kind.freedom();
            for link in 0..=hinges {
                builder.link(&format!("l{link}"));
            }
            for link in 0..hinges {
                let (from, to) = (format!("l{link}"), format!("l{}", link + 1));
                let name = format!("h{link}");
                builder.joint(JointBuilder::tree(&name, JointKind::Revolute, &from, &to));
            }
            let mut last = JointBuilder::closing("last", kind, &format!("l{hinges}"), "l0");
            if kind.uses_lead() {
                last = last.lead(Number::one());
            }
            if kind == JointKind::Distance {
                last = last.distance(Number::one());
            }
            builder.joint(last);
            assert_eq!(count(&builder.build().unwrap()), (2, 0), "{kind}");
        }
    }

    #[test]
    fn trees_gears_and_loose_pieces() {
        let mut builder = MechanismBuilder::new("arm");
        builder.link("ground").link("arm").link("hand");
        builder.joint(JointBuilder::tree(
            "a",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        builder.joint(JointBuilder::tree(
            "b",
            JointKind::Cylindrical,
            "arm",
            "hand",
        ));
        assert_eq!(count(&builder.clone().build().unwrap()), (3, 0));
        builder.link("wheel");
        builder.joint(JointBuilder::tree(
            "c",
            JointKind::Revolute,
            "ground",
            "wheel",
        ));
        builder.mimic("c", "a", Number::integer(2), Number::zero());
        assert_eq!(count(&builder.clone().build().unwrap()), (3, 0));
        builder.link("stone");
        builder.floating(
            "drop",
            "ground",
            "stone",
            kutzbach_model::mechanism::Frame::identity(),
        );
        assert_eq!(count(&builder.build().unwrap()), (9, 0));
    }
}
