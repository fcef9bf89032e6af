use super::super::germ_zeros::{GermZeroOptions, GermZeros, germ_zeros};
use super::super::part_samples::{Posed, stretched};
use super::*;
use kutzbach_closure::samples::{Written, flat_parallelogram, four_bar, planar, ring};

/// A singular pose with its germ and the zeros of that.
struct Singular {
    posed: Posed,
    rank: PartRank,
    kernel: Kernel,
    germ: Germ,
    zeros: GermZeros,
}

impl Singular {
    fn new(posed: Posed) -> Self {
        let rank = posed.rank();
        let kernel = posed.kernel(&rank);
        let germ = Germ::of_part(&posed.mechanism, &rank, 4).unwrap().unwrap();
        let zeros = germ_zeros(
            germ.freedom(),
            germ.equations(),
            germ.noise(germ.order().unwrap()),
            &GermZeroOptions::default(),
        );
        Self {
            posed,
            rank,
            kernel,
            germ,
            zeros,
        }
    }

    fn lift(&self, branches: &[GermBranch]) -> Result<Vec<Lifted>, String> {
        let pose = self.posed.pose();
        let start = Start {
            pose: &pose,
            part: self.posed.part(),
            rank: &self.rank,
            kernel: &self.kernel,
            idle: &[],
        };
        lift_all(&start, &self.germ, branches).unwrap()
    }

    /// The value of a hinge at a pose.
    fn value(&self, pose: &PartPose, name: &str) -> f64 {
        self.posed.with(&pose.states)[self.posed.mechanism.joint_named(name).unwrap().0].values[0]
    }

    /// Closed, its tangents motions to first order, and away from the pose.
    fn check(&self, lifted: &Lifted) {
        let section = self.posed.section(&self.kernel);
        assert!(!lifted.branch.poses.is_empty());
        for pose in &lifted.branch.poses {
            let states = self.posed.with(&pose.states);
            assert!(self.posed.openness(&states) <= 1.0);
            assert_eq!(pose.tangents.len(), lifted.branch.dimension);
            for tangent in &pose.tangents {
                assert!(self.posed.opening(&states, tangent) < 1e-6);
            }
            let way = section.way_between(&self.posed.assembly.states, &states);
            assert!(0.0.norm(&way) > 0.02);
        }
    }
}

#[test]
fn two_motions_cross_in_a_flat_parallelogram() {
    let flat = Singular::new(Posed::new(flat_parallelogram()));
    assert_eq!(flat.zeros.branches.len(), 2);
    let lifted = flat.lift(&flat.zeros.branches).unwrap();
    assert_eq!(lifted.len(), 2);
    let mut parallel = 0;
    for branch in &lifted {
        flat.check(branch);
        assert!(!branch.shaky);
        assert_eq!(
            (branch.branch.dimension, branch.branch.half_branches),
            (1, Some(2))
        );
        assert_eq!(branch.branch.poses.len(), POSES);
        // Along one the coupler does not turn, along the other it does, at every pose.
        let turns: Vec<bool> = branch
            .branch
            .poses
            .iter()
            .map(|pose| {
                assert_eq!(pose.instantaneous, Some(1));
                (flat.value(pose, "r_a") + flat.value(pose, "r_b")).abs() > 1e-3
            })
            .collect();
        assert!(turns.iter().all(|t| *t == turns[0]), "it changed branch");
        parallel += usize::from(!turns[0]);
    }
    assert_eq!(parallel, 1);
}

#[test]
fn a_rhombus_folds_and_opens() {
    // Four equal sides, flat but not folded: it opens, or one half folds onto the other and turns.
    let flat = Singular::new(Posed::new(ring(
        &planar(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 0.0]]),
        [0.0; 3],
        Written::Exactly,
    )));
    let lifted = flat.lift(&flat.zeros.branches).unwrap();
    let idle = |branch: &Lifted, name: &str| {
        branch
            .branch
            .poses
            .iter()
            .all(|pose| flat.value(pose, name).abs() < 1e-10)
    };
    assert_eq!(lifted.len(), 2);
    for branch in &lifted {
        flat.check(branch);
        assert!(!branch.shaky && branch.branch.dimension == 1);
    }
    // r_b and r_d coincide: about them the two halves turn as one.
    let turning = lifted
        .iter()
        .filter(|b| idle(b, "r_a") && idle(b, "r_c"))
        .count();
    assert_eq!(turning, 1);
}

#[test]
fn a_point_that_is_no_solution_is_refused() {
    // Over the complex numbers two lines pass through this pose, over the reals none.
    let taut = Singular::new(Posed::new(stretched()));
    assert!(taut.zeros.branches.is_empty());
    let borrowed = Singular::new(Posed::new(flat_parallelogram()))
        .zeros
        .branches;
    let refused = taut.lift(&borrowed[..1]).map(|l| l.len()).unwrap_err();
    assert!(
        refused.contains("dimension 1") && refused.contains("does not close"),
        "{refused}"
    );
}

#[test]
fn one_false_branch_spoils_the_answer() {
    let flat = Singular::new(Posed::new(flat_parallelogram()));
    let mut branches = flat.zeros.branches.clone();
    // As far out as the true points, and across both of them.
    let [a, b] = [&branches[0].points[0], &branches[1].points[0]];
    let size = 0.0.norm(a);
    let mut between: Vec<f64> = a.iter().zip(b).map(|(x, y)| x + y).collect();
    let across: Vec<f64> = a.iter().zip(b).map(|(x, y)| x - y).collect();
    if 0.0.norm(&across) > 0.0.norm(&between) {
        between = across;
    }
    let length = 0.0.norm(&between);
    between.iter_mut().for_each(|x| *x *= size / length);
    branches[1].points = vec![between];
    // A sole branch has no other to be near to.
    assert!(flat.lift(&branches[..1]).is_ok());
    let lifted = flat.lift(&branches);
    assert!(
        lifted.is_err(),
        "{} branches",
        lifted.map_or(0, |l| l.len())
    );
}

#[test]
fn a_branch_of_too_many_dimensions_is_refused() {
    let flat = Singular::new(Posed::new(flat_parallelogram()));
    let mut branches = flat.zeros.branches.clone();
    branches[0].dimension = 2;
    let refused = flat.lift(&branches).map(|l| l.len()).unwrap_err();
    assert!(refused.contains("dimension 2"), "{refused}");
}

#[test]
fn no_branches_lift_to_none() {
    let flat = Singular::new(Posed::new(flat_parallelogram()));
    assert!(flat.lift(&[]).unwrap().is_empty());
}

#[test]
fn a_strap_drawn_taut_is_shaky_all_along() {
    // A four-bar whose coupler carries two links in a line: they could only buckle to first order.
    let shaky = Singular::new(Posed::known("permanently_shaky_fourbar"));
    assert_eq!(shaky.rank.instantaneous, Some(2));
    let lifted = shaky.lift(&shaky.zeros.branches).unwrap();
    assert_eq!(lifted.len(), 1);
    let only = &lifted[0];
    assert!(only.shaky && only.branch.dimension == 1);
    shaky.check(only);
    let columns: Vec<&str> = shaky
        .posed
        .part()
        .joints
        .iter()
        .map(|j| shaky.posed.mechanism.joints()[*j].name.as_str())
        .collect();
    let column = |name: &str| columns.iter().position(|n| *n == name).unwrap();
    for pose in &only.branch.poses {
        assert_eq!((pose.instantaneous, pose.tangents.len()), (Some(2), 1));
        // The strap stays straight as the coupler moves: the true tangent has no rate there, and turns the strap's links as
        // the coupler turns.
        assert!(shaky.value(pose, "M_s1_s2").abs() < 1e-7);
        let tangent = &pose.tangents[0];
        let size = 0.0.norm(tangent);
        assert!(
            tangent[column("M_s1_s2")].abs() < 1e-5 * size,
            "{tangent:?}"
        );
        let apart = tangent[column("A_c1_s1")] - tangent[column("A_c1_k")];
        assert!(apart.abs() < 1e-5 * size, "{tangent:?}");
        assert!(tangent[column("A0_ground_c1")].abs() > 0.1 * size);
    }
}

/// The sine of the angle between the secants' direction and the one tangent at a pose that has only one, when they are looked
/// for in a kernel larger by a direction that leads off the branch.
fn secant_error(posed: &Posed, kernel: &Kernel, states: &[JointState<f64>]) -> f64 {
    let section = posed.section(kernel);
    let (there, _) = tangents_at(&section, states, 0.0, 1).unwrap().unwrap();
    let tangent = &there.basis[0];
    assert_eq!(there.instantaneous, Some(1));
    let mut across = vec![0.0; tangent.len()];
    across[0] = 1.0;
    let pair = orthonormal(vec![tangent.clone(), across]);
    // Neither of the two that it starts from is the tangent.
    let turned: Vec<Vec<f64>> = [[0.8, 0.6], [-0.6, 0.8]]
        .iter()
        .map(|[a, b]| {
            let both = pair[0].iter().zip(&pair[1]);
            both.map(|(x, y)| a * x + b * y).collect()
        })
        .collect();
    let found = secant_poses(&section, states, &turned, 1, 2, 0.0).unwrap();
    assert_eq!((found.len(), found[0].instantaneous), (1, Some(2)));
    let weights = &kernel.metric.weights;
    let mut off: Vec<f64> = found[0].tangents[0]
        .iter()
        .zip(weights)
        .map(|(q, w)| q * w)
        .collect();
    assert!((0.0.norm(&off) - 1.0).abs() < 1e-12);
    let share = along(&off, tangent);
    off.iter_mut()
        .zip(tangent)
        .for_each(|(x, t)| *x -= share * t);
    0.0.norm(&off)
}

#[test]
fn secants_are_the_tangent_where_there_is_only_one() {
    let crank = Posed::new(four_bar());
    let kernel = crank.kernel(&crank.rank());
    let error = secant_error(&crank, &kernel, &crank.assembly.states);
    assert!(error < 1e-7, "crank and rocker: {error:e}");
    let flat = Singular::new(Posed::new(flat_parallelogram()));
    for branch in flat.lift(&flat.zeros.branches).unwrap() {
        for pose in &branch.branch.poses {
            let states = flat.posed.with(&pose.states);
            let error = secant_error(&flat.posed, &flat.kernel, &states);
            assert!(error < 1e-7, "flat: {error:e}");
        }
    }
}
