use super::super::part_samples::{Posed, bennett, cylinders, five_bar, shaky_triangle};
use super::*;
use crate::families::{flattening_parallelogram, negative_power_of_ten, spoiled_bennett};
use kutzbach_closure::samples::{Written, four_bar, sarrus};

/// A walk from the pose drawn, along the kernel there.
fn walked(posed: &Posed, toward: Option<f64>, wanted: usize, away: f64) -> Vec<PartPose> {
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let basis = kernel.basis.vectors.clone();
    let toward = toward.map(|sign| basis[0].iter().map(|x| sign * x).collect());
    walk(
        &posed.section(&kernel),
        &mut posed.assembly.states.clone(),
        basis,
        toward,
        rank.open_by_digits(),
        wanted,
        away,
    )
    .unwrap()
}

/// The ways between one pose and the next, from the drawn one on.
fn ways(posed: &Posed, poses: &[PartPose]) -> Vec<Vec<f64>> {
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let section = posed.section(&kernel);
    let mut before = posed.assembly.states.clone();
    poses
        .iter()
        .map(|pose| {
            let here = posed.with(&pose.states);
            section.way_between(&std::mem::replace(&mut before, here.clone()), &here)
        })
        .collect()
}

fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

#[test]
fn poses_are_closed_and_their_tangents_span_the_kernel() {
    for (name, posed, freedom) in [
        ("four-bar", Posed::new(four_bar()), 1),
        ("five-bar", Posed::new(five_bar()), 2),
        ("sarrus", Posed::new(sarrus()), 1),
        ("cylinders", Posed::new(cylinders()), 1),
        ("Bennett", Posed::new(bennett(Written::Decimals(15))), 1),
    ] {
        let poses = walked(&posed, None, 4, f64::INFINITY);
        assert_eq!(poses.len(), 4, "{name}");
        for pose in &poses {
            let states = posed.with(&pose.states);
            assert!(posed.openness(&states) <= 1.0, "{name}");
            assert_eq!(pose.instantaneous, Some(freedom), "{name}");
            assert_eq!(pose.tangents.len(), freedom, "{name}");
            for tangent in &pose.tangents {
                let opening = posed.opening(&states, tangent);
                assert!(opening < 1e-11, "{name}: {opening:e}");
            }
            assert_eq!(orthonormal(pose.tangents.clone()).len(), freedom, "{name}");
            let rank = posed.rank();
            let surplus = rank.unknowns() as i64 - rank.equations() as i64;
            assert_eq!(pose.surplus, surplus, "{name}");
        }
        // Every step is of a quarter in the metric: nothing but closing is added to it.
        for way in ways(&posed, &poses) {
            let length = 0.0.norm(&way);
            assert!(
                (0.9 * STEP..1.6 * STEP).contains(&length),
                "{name}: {length}"
            );
        }
    }
}

#[test]
fn the_way_goes_on_and_not_back() {
    let posed = Posed::new(four_bar());
    let rank = posed.rank();
    let first = posed.kernel(&rank).basis.vectors[0].clone();
    for sign in [1.0, -1.0] {
        let poses = walked(&posed, Some(sign), 6, f64::INFINITY);
        let ways = ways(&posed, &poses);
        assert_eq!(ways.len(), 6);
        assert!(sign * along(&ways[0], &first) > 0.2, "{sign}");
        for pair in ways.windows(2) {
            assert!(along(&pair[0], &pair[1]) > 0.0, "{sign}");
        }
    }
}

#[test]
fn directions_lean_on_the_one_before() {
    let basis = [vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
    let before = [0.6, -0.8, 0.0];
    let mut sum = 0.0;
    for seed in 0..200 {
        let mut random = SplitMix64::new(seed);
        let direction = onward(&mut random, &basis, Some(&before)).unwrap();
        assert!((0.0.norm(&direction) - 1.0).abs() < 1e-14);
        assert!(along(&direction, &before) > 0.0, "{seed}: {direction:?}");
        assert_eq!(direction[2], 0.0);
        sum += along(&direction, &before);
    }
    // Mostly straight on: a direction at random, turned forward, would make it 2/π.
    assert!(sum / 200.0 > 0.85, "{}", sum / 200.0);
    assert_eq!(onward(&mut SplitMix64::new(1), &[], None), None);
}

#[test]
fn a_walk_ends_where_the_cycles_do_not_close() {
    let posed = Posed::new(shaky_triangle());
    assert_eq!(posed.rank().instantaneous, Some(1));
    assert!(walked(&posed, None, 3, f64::INFINITY).is_empty());
    assert!(walked(&Posed::new(four_bar()), None, 0, f64::INFINITY).is_empty());
}

#[test]
fn short_steps_lead_away_from_where_branches_meet() {
    // A parallelogram so flat that the other branch, along which the coupler turns, is a few hundredths away.
    let posed = Posed::new(flattening_parallelogram(&negative_power_of_ten(2)).unwrap());
    let poses = walked(&posed, None, 3, 0.01);
    assert_eq!(poses.len(), 3);
    let ways = ways(&posed, &poses);
    // The first pose kept is one far away.
    assert!(0.0.norm(&ways[0]) > 0.8 * (FAR - 0.01), "{ways:?}");
    let part = posed.part();
    let of = |name: &str| {
        let joint = posed.mechanism.joint_named(name).unwrap().0;
        part.joints.iter().position(|j| *j == joint).unwrap()
    };
    for pose in &poses {
        let [a, b] = ["A", "B"].map(|name| pose.states[of(name)].values[0]);
        assert!(
            a.abs() > 0.05 && (a + b).abs() < 1e-10,
            "the coupler turned: {a} {b}"
        );
    }
}

#[test]
fn the_freedom_expected_is_taken_where_the_margin_is_thin() {
    let posed = Posed::new(spoiled_bennett(&negative_power_of_ten(4)).unwrap());
    let mut rank = posed.rank();
    assert_eq!(rank.instantaneous, Some(0));
    rank.instantaneous = Some(1);
    let kernel = posed.kernel(&rank);
    let section = posed.section(&kernel);
    let states = &posed.assembly.states;
    let seen = |stated, expected| tangents_at(&section, states, stated, expected).unwrap();
    let clear = seen(0.0, 1).unwrap().0;
    assert_eq!((clear.instantaneous, clear.basis.len()), (Some(0), 0));
    // An accuracy like the offset leaves it open.
    let thin = seen(0.3 * rank.decision.kept, 1).unwrap().0;
    assert_eq!((thin.instantaneous, thin.basis.len()), (None, 1));
    assert!(
        seen(0.3 * rank.decision.kept, 5).is_none(),
        "more than there are unknowns"
    );
}

#[test]
fn tangents_are_orthonormal_in_the_metric_of_the_start() {
    let posed = Posed::new(five_bar());
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let section = posed.section(&kernel);
    let poses = walked(&posed, None, 1, f64::INFINITY);
    let states = posed.with(&poses[0].states);
    let (there, _) = tangents_at(&section, &states, 0.0, 2).unwrap().unwrap();
    for (i, a) in there.basis.iter().enumerate() {
        for (j, b) in there.basis.iter().enumerate() {
            let expected = f64::from(u8::from(i == j));
            assert!((along(a, b) - expected).abs() < 1e-13);
        }
        let opening = posed.opening(&states, &natural(&kernel.metric, a));
        assert!(opening < 1e-12, "{opening:e}");
    }
}

#[test]
fn dependent_vectors_are_left_out() {
    let basis = orthonormal(vec![
        vec![3.0, 4.0, 0.0],
        vec![-6.0, -8.0, 0.0],
        vec![0.0; 3],
        vec![1.0, 0.0, 1e-3],
        vec![7.0, 1.0, 0.0],
        vec![1.0, 1.0, 1.0],
    ]);
    assert_eq!(basis.len(), 3);
    assert!((basis[0][0] - 0.6).abs() < 1e-15 && (basis[0][1] - 0.8).abs() < 1e-15);
    for (i, a) in basis.iter().enumerate() {
        for b in &basis[..i] {
            assert!(along(a, b).abs() < 1e-15);
        }
    }
}

#[test]
fn a_part_that_cannot_be_walked_keeps_its_pose() {
    let poses_of = |posed: &Posed, limit: usize| {
        let rank = posed.rank();
        let kernel = Kernel::of(&posed.pose(), &rank, limit).unwrap().unwrap();
        poses_of_regular_part(&posed.pose(), posed.part(), &rank, &kernel).unwrap()
    };
    let five_bar = Posed::new(five_bar());
    let moved = poses_of(&five_bar, 64);
    assert_eq!(moved.len(), POSES);
    assert!(0.0.norm(&ways(&five_bar, &moved)[0]) > 0.2);
    // Of a larger kernel only a sample is known.
    let stayed = poses_of(&five_bar, 1);
    assert_eq!(stayed.len(), 1);
    assert_eq!(0.0.norm(&ways(&five_bar, &stayed)[0]), 0.0);
    assert_eq!(stayed[0].tangents.len(), 1);
    assert_eq!(stayed[0].instantaneous, Some(2));
    let shaky = Posed::new(shaky_triangle());
    let stayed = poses_of(&shaky, 64);
    assert_eq!((stayed.len(), stayed[0].surplus), (1, -3));
    let opening = shaky.opening(&shaky.assembly.states, &stayed[0].tangents[0]);
    assert!(opening < 1e-14, "{opening:e}");
}
