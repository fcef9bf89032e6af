//! What each joint does at the pose: which of its freedoms move in some motion, which in none.
//!
//! A variable is locked when its component vanishes in every vector of ker J (a coloop of the column matroid), at the pose
//! and at poses nearby.

use super::pose_rank::PartRank;
use kutzbach_closure::{Geometry, JointState, Part, entry_accuracy, follow, jacobian};
use kutzbach_math::matrix::{
    MatrixError, NullVectors, RankDecision, Real, SplitMix64, coloops, decide, null_vectors,
};
use kutzbach_model::mechanism::{FreedomPart, Joint, JointKind, Mechanism};

/// Above this nullity random null vectors stand for a basis. A variable that moves is missed with probability zero.
pub(super) const NULL_VECTORS: usize = 24;

/// Finite ways of the moved check, in radians or part lengths of the fastest variable: two, so that a joint that pauses
/// again at the first is seen at the second.
const STEPS: [f64; 2] = [0.05, -0.13];

/// The role of one joint at the pose.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct JointRole {
    /// Whether no freedom of the joint moves; `None` where the margin does not tell. Meaningless without freedoms.
    pub locked: Option<bool>,
    /// Names of freedoms that do not move while others of the joint do, such as `slider.rot`.
    pub locked_parts: Vec<String>,
}

/// What is known of the finite motion of a part, beside its rank.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Seen {
    /// Nothing more than doubles show near the pose.
    Here,
    /// The variables that move along the motion, seen in more digits.
    Moving(Vec<bool>),
    /// That it is open: what rests at the pose may move to higher order, or in the mechanism meant.
    Open,
}

/// Roles of the joints of a part at its pose, in the part's order.
///
/// A joint can pause: at a dead centre its rate is zero for an instant. So where some joint seems locked, the part is
/// moved a finite way along a random motion and asked again; what moves there is not locked. (Where the rank changes on
/// the way the pose is singular, and the roles are those of the pose itself.) The states are the pose's again afterwards.
///
/// # Errors
/// [`MatrixError`] where the null vectors cannot be computed.
pub fn roles_of_part(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
) -> Result<Vec<JointRole>, MatrixError> {
    roles_seen_closer(mechanism, geometry, states, part, rank, &Seen::Here)
}

/// [`roles_of_part`], where somebody has looked at the part's finite motion.
pub(super) fn roles_seen_closer(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
    seen: &Seen,
) -> Result<Vec<JointRole>, MatrixError> {
    // Where the numbers may be rounded, what moves is as open as the rank.
    let Some(decision) = rank.settled().filter(|_| rank.doubt.is_none()) else {
        return Ok(vec![JointRole::default(); part.joints.len()]);
    };
    let Some(null) = rank.null_vectors(NULL_VECTORS, 1)? else {
        return Ok(vec![JointRole::default(); part.joints.len()]);
    };
    let Some(Resting {
        mut zero,
        mut doubtful,
    }) = Resting::columns(&null, &decision)
    else {
        return Ok(vec![JointRole::default(); part.joints.len()]);
    };
    match seen {
        Seen::Here => {}
        Seen::Moving(closer) => {
            for (column, _) in closer.iter().enumerate().filter(|(_, moves)| **moves) {
                zero[column] = false;
                doubtful[column] = false;
            }
        }
        Seen::Open => {
            for (rests, open) in zero.iter_mut().zip(&mut doubtful) {
                *open |= std::mem::take(rests);
            }
        }
    }
    let freedom = decision.nullity().unwrap_or(0);
    if freedom > 0 && zero.iter().any(|z| *z) {
        for size in STEPS {
            for (paused, moves) in zero.iter_mut().zip(moving(
                mechanism, geometry, states, part, rank, &null, size,
            )?) {
                *paused &= !moves;
            }
        }
    }
    let mut first = 0;
    let mut roles = Vec::with_capacity(part.joints.len());
    for &joint in &part.joints {
        let joint = &mechanism.joints()[joint];
        let columns = first..first + joint.freedom();
        first += joint.freedom();
        roles.push(role(joint, &zero[columns.clone()], &doubtful[columns]));
    }
    Ok(roles)
}

/// Which columns vanish in all null vectors, and of which that cannot be said.
pub(super) struct Resting {
    pub zero: Vec<bool>,
    pub doubtful: Vec<bool>,
}

impl Resting {
    /// `None` where the null vectors are too uncertain to tell anything.
    ///
    /// Components of a unit vector of length n are of the order of a share, 1/√n. Where the error of the vectors is as
    /// large they tell nothing. And however coarse the numbers, a component of a ten-thousandth of a share or more is not
    /// called zero: it is small within their precision, which is not the same as resting.
    pub fn columns(null: &NullVectors<f64>, decision: &RankDecision) -> Option<Self> {
        let share = 1.0 / (null.length.max(1) as f64).sqrt();
        let error = null.residual + decision.accuracy;
        if decision.kept > 0.0 && error > share * decision.kept {
            return None;
        }
        // Ten times the error over the smallest kept value is what is taken for zero, a thousand times is doubtful.
        let found = |least: f64| {
            let careful = RankDecision {
                accuracy: decision.accuracy.min(least * share * decision.kept),
                ..decision.clone()
            };
            coloops(null, &careful)
        };
        let (certain, possible) = (found(1e-5), found(1e-3));
        let mut zero = vec![false; null.length];
        let mut doubtful = zero.clone();
        for column in certain.zero {
            zero[column] = true;
        }
        for column in possible.zero.into_iter().chain(possible.undecided) {
            doubtful[column] = !zero[column];
        }
        Some(Self { zero, doubtful })
    }
}

/// Which variables move at a pose a finite step away; none where the step fails or the rank is another there.
fn moving(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    states: &mut [JointState<f64>],
    part: &Part,
    rank: &PartRank,
    null: &NullVectors<f64>,
    size: f64,
) -> Result<Vec<bool>, MatrixError> {
    let still = vec![false; rank.matrix.columns()];
    // A fixed combination of the null vectors, in the Jacobian's own units: unit columns were divided by their norms.
    let mut random = SplitMix64::new(7);
    let mut direction = vec![0.0; still.len()];
    for vector in &null.vectors {
        let weight = random.symmetric();
        for (d, x) in direction.iter_mut().zip(vector) {
            *d += weight * x;
        }
    }
    for (d, scale) in direction.iter_mut().zip(&rank.column_scales) {
        if *scale > 0.0 {
            *d /= scale;
        }
    }
    let largest = direction.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return Ok(still);
    }
    direction.iter_mut().for_each(|x| *x *= size / largest);
    let moves = follow(mechanism, geometry, states, part, &direction, |there| {
        let moved = jacobian(mechanism, geometry, there, part)?;
        let (_, rounding) = entry_accuracy(&moved);
        let mut matrix = moved.matrix;
        matrix.scale_columns();
        let left = 0.0.norm(&moved.residual);
        // The same reading of the numbers as at the pose itself: literal, where both say the same there.
        let stated = if rank.as_written == rank.instantaneous {
            0.0
        } else {
            rank.open_by_digits()
        };
        let decision = decide(&matrix, stated + rounding + left)?;
        if decision.nullity().is_none() || decision.nullity() != rank.instantaneous {
            return Ok(None);
        }
        let null = null_vectors(&matrix, &decision, NULL_VECTORS, 1)?;
        Ok(Resting::columns(&null, &decision).map(|found| {
            let still = found.zero.iter().zip(&found.doubtful);
            still.map(|(zero, doubtful)| !zero && !doubtful).collect()
        }))
    })?;
    Ok(moves.flatten().unwrap_or(still))
}

/// The role of a joint by its variables: which rest, and of which that stays open.
pub(super) fn role(joint: &Joint, zero: &[bool], doubtful: &[bool]) -> JointRole {
    if zero.is_empty() {
        return JointRole::default();
    }
    if zero.iter().all(|z| *z) {
        return JointRole {
            locked: Some(true),
            locked_parts: Vec::new(),
        };
    }
    let moves = zero.iter().zip(doubtful).any(|(z, d)| !z && !d);
    let locked_parts = freedom_groups(joint.kind)
        .into_iter()
        .filter(|(_, variables)| variables.iter().all(|v| zero[*v]))
        .map(|(suffix, _)| format!("{}.{suffix}", joint.name))
        .collect();
    JointRole {
        locked: moves.then_some(false),
        locked_parts,
    }
}

/// The parts of a joint that can be locked on their own, by name and variables: all rotations together and all
/// translations together, since which of two directions in a plane is called the first means nothing; the two axes of a
/// universal joint and of a line on a plane are lines of the mechanism and count one by one.
#[must_use]
pub fn freedom_groups(kind: JointKind) -> Vec<(String, Vec<usize>)> {
    let parts = kind.freedoms();
    let of = |wanted: FreedomPart| -> Vec<usize> {
        (0..parts.len()).filter(|v| parts[*v] == wanted).collect()
    };
    let mut groups = Vec::new();
    for part in [
        FreedomPart::Rotation,
        FreedomPart::Translation,
        FreedomPart::Screw,
    ] {
        let variables = of(part);
        let one_by_one = matches!(kind, JointKind::Universal | JointKind::LineOnPlane)
            && part == FreedomPart::Rotation;
        if one_by_one {
            for (index, variable) in variables.into_iter().enumerate() {
                groups.push((format!("{}{}", part.suffix(), index + 1), vec![variable]));
            }
        } else if !variables.is_empty() {
            groups.push((part.suffix().to_owned(), variables));
        }
    }
    groups
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{AnalysisOptions, analyse};
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Place, Written, add_ring, four_bar, general_four, planar, ring,
    };
    use kutzbach_math::matrix::SparseMatrix;
    use kutzbach_model::mechanism::MechanismBuilder;

    fn roles(mechanism: &Mechanism) -> Vec<JointRole> {
        analyse(mechanism, &AnalysisOptions::default())
            .unwrap()
            .roles
    }

    fn locked(mechanism: &Mechanism) -> Vec<Option<bool>> {
        roles(mechanism)
            .into_iter()
            .map(|role| role.locked)
            .collect()
    }

    #[test]
    fn all_joints_of_a_four_bar_move_and_none_of_a_rigid_ring() {
        assert_eq!(locked(&four_bar()), [Some(false); 4]);
        assert_eq!(locked(&general_four()), [Some(true); 4]);
    }

    #[test]
    fn a_joint_at_a_dead_centre_pauses_but_is_not_locked() {
        // Crank and coupler in one line: at this instant the rocker's own joint stands still.
        let points = [[0.0, 0.0], [0.6, 0.8], [2.4, 3.2], [4.0, 0.0]];
        let mechanism = ring(&planar(&points), [0.0; 3], Written::Exactly);
        let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
        let part = &analysis.parts[0];
        let null = null_vectors(&part.matrix, &part.settled().unwrap(), NULL_VECTORS, 1).unwrap();
        let resting = Resting::columns(&null, &part.settled().unwrap()).unwrap();
        let last = analysis.structure.parts[0]
            .joints
            .iter()
            .position(|j| *j == 3)
            .unwrap();
        assert!(resting.zero[last], "it does pause: {:?}", null.vectors);
        assert_eq!(locked(&mechanism), [Some(false); 4]);
    }

    #[test]
    fn a_cylindrical_joint_in_a_planar_loop_turns_and_does_not_slide() {
        let mut places = planar(&CRANK_ROCKER);
        places[1].0 = JointKind::Cylindrical;
        let found = roles(&ring(&places, [0.0; 3], Written::Exactly));
        assert_eq!(found[1].locked, Some(false));
        assert_eq!(found[1].locked_parts, ["r_b.trans"]);
        assert!(found[0].locked_parts.is_empty());
    }

    #[test]
    fn joints_without_freedom_have_no_role() {
        let mut places = planar(&CRANK_ROCKER);
        places.insert(2, (JointKind::Fixed, [1.0, 4.0, 0.0], [0.0; 3]));
        let found = roles(&ring(&places, [0.0; 3], Written::Exactly));
        assert_eq!(found[2], JointRole::default());
        assert_eq!(found[3].locked, Some(false));
    }

    #[test]
    fn coarse_numbers_do_not_hide_that_a_joint_moves() {
        // Centimetres with three decimals, crank and coupler in line.
        let points = [[0.0, 0.0], [0.006, 0.008], [0.024, 0.032], [0.04, 0.001]];
        let mechanism = ring(&planar(&points), [0.0; 3], Written::Decimals(3));
        // The rocker's own joint rests at the pose and moves beside it.
        assert_eq!(locked(&mechanism), [Some(false); 4]);
    }

    #[test]
    fn a_locked_part_beside_a_moving_one() {
        let mut builder = MechanismBuilder::new("two");
        builder.link("ground");
        add_ring(
            &mut builder,
            "moves",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        add_ring(
            &mut builder,
            "stays",
            "ground",
            &planar(&CRANK_ROCKER[..3]),
            [0.0; 3],
            Written::Exactly,
        );
        let mechanism = builder.build().unwrap();
        let found = locked(&mechanism);
        assert_eq!(found[..4], [Some(false); 4]);
        assert_eq!(found[4..], [Some(true); 3]);
    }

    #[test]
    fn components_small_by_lack_of_digits_are_not_called_zero() {
        // The null vector (1, −0.01, 0) / |·|, uncertain by 1e-3 and by 1e-9.
        let matrix =
            SparseMatrix::from_triplets(2, 3, 0.0, [(0, 0, 0.01), (0, 1, 1.0), (1, 2, 1.0)])
                .unwrap();
        for (accuracy, expected) in [(1e-3, [false, false, true]), (1e-9, [false, false, true])] {
            let decision = decide(&matrix, accuracy).unwrap();
            let null = null_vectors(&matrix, &decision, 9, 1).unwrap();
            let found = Resting::columns(&null, &decision).unwrap();
            assert_eq!(found.zero, expected);
            assert_eq!(found.doubtful[1], accuracy > 1e-6);
        }
        // Vectors as uncertain as they are large say nothing.
        let decision = decide(&matrix, 0.0).unwrap();
        let null = null_vectors(&matrix, &decision, 9, 1).unwrap();
        let hopeless = RankDecision {
            accuracy: 1.0,
            ..decision
        };
        assert!(Resting::columns(&null, &hopeless).is_none());
    }

    #[test]
    fn groups_cover_every_freedom_once() {
        for kind in JointKind::ALL {
            let mut variables: Vec<usize> = freedom_groups(kind)
                .into_iter()
                .flat_map(|(_, v)| v)
                .collect();
            variables.sort_unstable();
            assert_eq!(variables, (0..kind.freedom()).collect::<Vec<_>>(), "{kind}");
        }
        let names = |kind| -> Vec<String> {
            freedom_groups(kind)
                .into_iter()
                .map(|(name, _)| name)
                .collect()
        };
        assert_eq!(names(JointKind::Universal), ["rot1", "rot2"]);
        assert_eq!(names(JointKind::Planar), ["rot", "trans"]);
    }

    #[test]
    fn roles_do_not_depend_on_where_the_file_names_a_joint() {
        // Three hinges idle about one axis beside a slider that cannot move.
        let hinge = (JointKind::Revolute, [0.0; 3], [0.0, 0.0, 1.0]);
        let places: Vec<Place> = vec![
            hinge,
            hinge,
            (JointKind::Prismatic, [0.0; 3], [1.0, 0.0, 0.0]),
        ];
        let found = locked(&ring(&places, [0.0; 3], Written::Exactly));
        assert_eq!(found, [Some(false), Some(false), Some(true)]);
    }
}
