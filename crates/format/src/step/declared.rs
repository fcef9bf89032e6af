//! What the kinematic pairs of a file say of its parts.

use super::geometry::{Geometry, Taken};
use kutzbach_model::mechanism::JointKind;
use kutzbach_step::{Assembly, KinematicPair, PairMotion};
use nalgebra::Vector3;
use std::collections::{BTreeMap, BTreeSet};

/// What a file says of two parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Said {
    /// A joint, whose geometry has the part of the smaller place first.
    Joint(Taken),
    /// That they do not hold each other.
    Nothing,
    /// What is no joint here.
    Unknown,
}

/// What a file says of its parts.
pub(super) struct Declared {
    /// By the places of two parts, the smaller one first.
    pub pairs: BTreeMap<(usize, usize), Said>,
    /// The parts of which it says something.
    links: BTreeSet<usize>,
}

impl Declared {
    /// What the kinematic pairs of an assembly say. Of two pairs of the same parts, gears aside, both together are no joint here.
    pub fn of(assembly: &Assembly) -> Self {
        let mut found = Self {
            pairs: BTreeMap::new(),
            links: BTreeSet::new(),
        };
        for pair in &assembly.pairs {
            let (one, two) = pair.parts;
            found.links.extend([one, two]);
            if let Some(said) = said(pair) {
                let key = (one.min(two), one.max(two));
                found
                    .pairs
                    .entry(key)
                    .and_modify(|known| *known = Said::Unknown)
                    .or_insert(said);
            }
        }
        found
    }

    /// Whether the file joins both parts, but not to each other.
    pub fn joins_otherwise(&self, (one, two): (usize, usize)) -> bool {
        self.links.contains(&one)
            && self.links.contains(&two)
            && !self.pairs.contains_key(&(one, two))
    }
}

/// What one pair says; `None` of gears, which couple joints and are none.
fn said(pair: &KinematicPair) -> Option<Said> {
    let (one, two) = &pair.frames;
    let point = one.translation;
    let along = |place: usize| -> Vector3<f64> { one.rotation.column(place).into_owned() };
    let line = |place: usize| Geometry::Line {
        point,
        direction: along(place),
    };
    let joint = |kind: JointKind, geometry: Geometry| {
        Said::Joint(Taken {
            kind,
            geometry,
            lead: None,
        })
    };
    let (translations, rotations) = match pair.motion {
        PairMotion::Gears { .. } => return None,
        PairMotion::Screw { lead } => {
            return Some(Said::Joint(Taken {
                kind: JointKind::Screw,
                geometry: line(2),
                lead: Some(lead),
            }));
        }
        PairMotion::Free {
            translations,
            rotations,
        } => (places(translations), places(rotations)),
        _ => return Some(Said::Unknown),
    };
    Some(match (translations.as_slice(), rotations.as_slice()) {
        ([], []) => joint(JointKind::Fixed, Geometry::Free),
        ([], [axis]) => joint(JointKind::Revolute, line(*axis)),
        ([axis], []) => joint(JointKind::Prismatic, Geometry::Direction(along(*axis))),
        ([axis], [same]) if axis == same => joint(JointKind::Cylindrical, line(*axis)),
        ([a, b], []) => {
            let normal = Geometry::Direction(along(3 - a - b));
            joint(JointKind::PlanarTranslation, normal)
        }
        ([a, b], [normal]) if a + b + normal == 3 && a != normal && b != normal => {
            joint(JointKind::Planar, Geometry::Direction(along(*normal)))
        }
        ([_, _, _], []) => joint(JointKind::Translational, Geometry::Free),
        ([_, _, _], [axis]) => joint(JointKind::Schoenflies, Geometry::Direction(along(*axis))),
        ([], [a, b]) => {
            let (first, second) = (along(*a), two.rotation.column(*b).into_owned());
            let (first, second) = match pair.parts.0 < pair.parts.1 {
                true => (first, second),
                false => (second, first),
            };
            let geometry = Geometry::Cross {
                point,
                first,
                second,
            };
            joint(JointKind::Universal, geometry)
        }
        ([], [_, _, _]) => joint(JointKind::Spherical, Geometry::Point(point)),
        ([_, _, _], [_, _, _]) => Said::Nothing,
        _ => Said::Unknown,
    })
}

/// The places of the flags that are set.
fn places(flags: [bool; 3]) -> Vec<usize> {
    let set = flags.iter().enumerate().filter(|(_, flag)| **flag);
    set.map(|(place, _)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_math::group::Pose;

    fn pair(translations: [u8; 3], rotations: [u8; 3]) -> KinematicPair {
        KinematicPair {
            line: 1,
            entity: 1,
            parts: (1, 0),
            frames: (
                Pose::identity(),
                Pose::rotation_about(Vector3::z(), std::f64::consts::FRAC_PI_2),
            ),
            motion: PairMotion::Free {
                translations: translations.map(|flag| flag == 1),
                rotations: rotations.map(|flag| flag == 1),
            },
        }
    }

    #[test]
    fn flags_are_joints_where_they_are_one() {
        use JointKind as K;
        for (translations, rotations, kind) in [
            ([0, 0, 0], [0, 0, 0], Some(K::Fixed)),
            ([0, 0, 0], [0, 0, 1], Some(K::Revolute)),
            ([1, 0, 0], [0, 0, 0], Some(K::Prismatic)),
            ([0, 0, 1], [0, 0, 1], Some(K::Cylindrical)),
            ([0, 1, 1], [0, 0, 0], Some(K::PlanarTranslation)),
            ([1, 1, 0], [0, 0, 1], Some(K::Planar)),
            ([1, 1, 1], [0, 0, 0], Some(K::Translational)),
            ([1, 1, 1], [0, 1, 0], Some(K::Schoenflies)),
            ([0, 0, 0], [1, 0, 1], Some(K::Universal)),
            ([0, 0, 0], [1, 1, 1], Some(K::Spherical)),
            ([1, 0, 0], [0, 0, 1], None),
            ([1, 1, 0], [1, 0, 0], None),
        ] {
            let found = said(&pair(translations, rotations));
            match (kind, found) {
                (Some(kind), Some(Said::Joint(taken))) => assert_eq!(taken.kind, kind),
                (None, Some(Said::Unknown)) => {}
                other => panic!("{translations:?} {rotations:?}: {other:?}"),
            }
        }
        assert_eq!(said(&pair([1; 3], [1; 3])), Some(Said::Nothing));
    }

    #[test]
    fn the_first_axis_of_a_universal_joint_is_of_the_first_part() {
        let found = said(&pair([0, 0, 0], [1, 1, 0]));
        let Some(Said::Joint(Taken {
            geometry: Geometry::Cross { first, second, .. },
            ..
        })) = found
        else {
            panic!("{found:?}");
        };
        // The pair's second part is the assembly's first: its y axis is along -x.
        assert!((first + Vector3::x()).norm() < 1e-12, "{first}");
        assert_eq!(second, Vector3::x());
    }
}
