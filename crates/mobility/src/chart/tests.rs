use super::super::part_samples::{Posed, bennett, cylinders, five_bar, fresh, shaky_triangle};
use super::*;
use crate::families::{
    bennett_row, flattening_parallelogram, negative_power_of_ten, spoiled_bennett,
};
use kutzbach_closure::samples::{
    CRANK_ROCKER, Written, flat_parallelogram, four_bar, planar, ring,
};
use kutzbach_model::mechanism::Mechanism;

fn tested(posed: &Posed) -> (PartRank, ChartTest) {
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let test = chart_test(&posed.pose(), &mut fresh(), posed.part(), &rank, &kernel).unwrap();
    (rank, test)
}

fn test(mechanism: Mechanism) -> ChartTest {
    tested(&Posed::new(mechanism)).1
}

fn order(test: &ChartTest) -> f64 {
    match test.outcome {
        ChartOutcome::Singular { order } => order,
        _ => panic!("no singular pose: {test:?}"),
    }
}

#[test]
fn where_nothing_is_left_over_the_pose_is_regular() {
    for (name, mechanism, freedom) in [
        ("four-bar", four_bar(), 1),
        ("five-bar", five_bar(), 2),
        ("cylinders", cylinders(), 1),
        ("Bennett, rational", bennett_row(1).unwrap(), 1),
        ("Bennett, doubles", bennett(Written::Decimals(15)), 1),
    ] {
        let (rank, test) = tested(&Posed::new(mechanism));
        assert_eq!(rank.instantaneous, Some(freedom), "{name}");
        assert_eq!(test.outcome, ChartOutcome::Regular, "{name}: {test:?}");
        assert!(test.leftover <= test.noise && !test.literal, "{name}");
        // Far enough that what a germ of the last order seen leaves would stand out from the noise.
        assert!(
            COEFFICIENT * test.radius.powi(ORDERS_SEEN_ROUNDED) > test.noise,
            "{name}: {test:?}"
        );
        // One direction where there is only one, and both ways along each.
        let ways = if freedom == 1 { 1 } else { freedom + 1 };
        assert_eq!(test.directions, 2 * ways, "{name}");
    }
}

#[test]
fn what_singular_poses_leave_over_falls_like_its_power() {
    for (name, posed, expected) in [
        ("flat", Posed::new(flat_parallelogram()), 2.0),
        ("triangle", Posed::new(shaky_triangle()), 2.0),
        (
            "contact of order 3",
            Posed::known("rsc_contact3_shaky"),
            3.0,
        ),
        (
            "platform of order 4",
            Posed::known("wren_platform_6US"),
            4.0,
        ),
    ] {
        let (_, test) = tested(&posed);
        assert!(
            (order(&test) - expected).abs() < 0.3,
            "{name}: order {} of {test:?}",
            order(&test)
        );
        assert!(test.leftover > CLEAR * test.noise, "{name}: {test:?}");
    }
}

#[test]
fn the_radius_shrinks_with_the_smallest_singular_value() {
    // Close to the flat pose the other branch is close too, and a chart reaches only as far.
    let mut before = f64::INFINITY;
    for exponent in [1, 2, 3] {
        let epsilon = negative_power_of_ten(exponent);
        let (rank, test) = tested(&Posed::new(flattening_parallelogram(&epsilon).unwrap()));
        assert_eq!(
            test.outcome,
            ChartOutcome::Regular,
            "1e-{exponent}: {test:?}"
        );
        assert!(test.radius <= rank.decision.kept, "1e-{exponent}: {test:?}");
        assert!(test.radius < 0.2 * before, "1e-{exponent}: {test:?}");
        before = test.radius;
    }
}

#[test]
fn short_radii_take_more_digits() {
    // Radius to the sixth power is beyond doubles here.
    let epsilon = negative_power_of_ten(5);
    let test = test(flattening_parallelogram(&epsilon).unwrap());
    assert_eq!(test.outcome, ChartOutcome::Regular, "{test:?}");
    assert!(test.bits > 53 && test.leftover <= test.noise, "{test:?}");
    assert!(test.noise < 1e-25, "noise is that of the bits: {test:?}");
}

#[test]
fn rounded_numbers_are_regular_within_their_noise() {
    let (rank, test) = tested(&Posed::new(bennett(Written::Decimals(7))));
    assert_eq!(rank.instantaneous, Some(1), "{:?}", rank.note);
    assert!(rank.open_by_digits() > 1e-8);
    assert_eq!(test.outcome, ChartOutcome::Regular, "{test:?}");
    // Not closed to rounding, but to what the digits say.
    assert!(
        test.leftover > 1e-12 && test.leftover <= test.noise,
        "{test:?}"
    );
    assert!(test.noise >= rank.open_by_digits());
}

#[test]
fn a_rounded_singular_pose_is_singular_still() {
    let (s, c) = 0.7f64.sin_cos();
    let places = [0.0, 1.0, 3.0, 2.0].map(|x| [c * x, s * x]);
    let (rank, test) = tested(&Posed::new(ring(
        &planar(&places),
        [0.0; 3],
        Written::Decimals(9),
    )));
    assert_eq!(rank.instantaneous, Some(2), "{:?}", rank.note);
    assert!((order(&test) - 2.0).abs() < 0.3, "{test:?}");
}

#[test]
fn the_same_dice_every_time() {
    let posed = Posed::new(flat_parallelogram());
    assert_eq!(tested(&posed).1, tested(&posed).1);
}

#[test]
fn directions_are_unit_vectors_of_the_kernel_both_ways() {
    let posed = Posed::new(five_bar());
    let rank = posed.rank();
    let kernel = posed.kernel(&rank).basis;
    let ways = directions(&kernel);
    for pair in ways.chunks(2) {
        assert!((0.0.norm(&pair[0]) - 1.0).abs() < 1e-14);
        assert!(pair[0].iter().zip(&pair[1]).all(|(a, b)| *a == -b));
        let mut outside = pair[0].clone();
        for vector in &kernel.vectors {
            let along: f64 = vector.iter().zip(&pair[0]).map(|(a, b)| a * b).sum();
            outside
                .iter_mut()
                .zip(vector)
                .for_each(|(x, v)| *x -= along * v);
        }
        assert!(0.0.norm(&outside) < 1e-14);
    }
}

#[test]
fn no_kernel_without_a_rank() {
    let posed = Posed::new(four_bar());
    let mut rank = posed.rank();
    let kernel = posed.kernel(&rank);
    assert_eq!((kernel.basis.nullity, kernel.basis.complete), (1, true));
    assert_eq!(kernel.metric.weights.len(), rank.unknowns());
    rank.instantaneous = None;
    assert!(Kernel::of(&posed.pose(), &rank, 64).unwrap().is_none());
}

fn literally_left(mechanism: Mechanism) -> (PartRank, Option<f64>) {
    literally_left_of(&Posed::new(mechanism))
}

fn literally_left_of(posed: &Posed) -> (PartRank, Option<f64>) {
    let rank = posed.rank();
    let kernel = posed.kernel(&rank);
    let left = literal_leftover(&posed.pose(), &mut fresh(), posed.part(), &rank, &kernel).unwrap();
    (rank, left)
}

#[test]
fn rounding_a_special_shape_leaves_something_over() {
    let mut before = f64::INFINITY;
    for decimals in [6, 9] {
        let (rank, left) = literally_left(bennett(Written::Decimals(decimals)));
        let left = left.unwrap();
        assert!(
            left < rank.open_by_digits(),
            "{decimals}: {left:e} of {:e}",
            rank.open_by_digits()
        );
        assert!(left < 0.1 * before, "{decimals}: {left:e}");
        before = left;
    }
    // Finer than doubles see: more digits see it.
    let (rank, left) = literally_left(bennett(Written::Decimals(15)));
    let left = left.unwrap();
    assert!(
        left < 1e-14 && left > 1e-18,
        "{left:e} of {:e}",
        rank.open_by_digits()
    );
    // Nobody wrote the last digits of a double.
    let posed = Posed::known("bennett_generic");
    let (_, left) = literally_left_of(&posed);
    assert_eq!(left, None);
}

#[test]
fn numbers_that_need_no_special_shape_leave_nothing_over() {
    // A planar loop moves whatever its lengths are.
    for decimals in [3, 6] {
        let points = CRANK_ROCKER.map(|[x, y]| [x + 0.123_456_7, y - 0.765_432_1]);
        let (_, left) = literally_left(ring(
            &planar(&points),
            [0.0; 3],
            Written::Decimals(decimals),
        ));
        assert_eq!(left, None, "{decimals}");
    }
    assert_eq!(literally_left(bennett_row(1).unwrap()).1, None);
}

#[test]
fn an_exact_offset_is_not_taken_for_a_special_shape() {
    // Spoiled, its axes are independent: there is no kernel to try.
    let posed = Posed::new(spoiled_bennett(&negative_power_of_ten(9)).unwrap());
    let rank = posed.rank();
    assert_eq!(rank.instantaneous, Some(0));
    let kernel = Kernel::of(&posed.pose(), &rank, 64).unwrap().unwrap();
    assert_eq!(kernel.basis.vectors.len(), 0);
}
