use super::super::geometry::Arithmetic;
use super::super::jacobian::jacobian;
use super::super::samples::{
    CRANK_ROCKER, Place, Written, flat_parallelogram, four_bar, planar, ring, sarrus,
};
use super::*;
use kutzbach_math::matrix::{SplitMix64, decide, null_vectors};
use kutzbach_model::mechanism::JointKind;
use proptest::prelude::*;

/// A ring at the pose drawn, in some arithmetic.
struct Drawn<R> {
    mechanism: Mechanism,
    geometry: Geometry<R>,
    part: Part,
    metric: Metric,
    /// Orthonormal in the metric.
    kernel: Vec<Vec<f64>>,
}

impl<R: Real> Drawn<R> {
    fn new(mechanism: Mechanism, arithmetic: &Arithmetic<R>) -> Self {
        let geometry = Geometry::new(&mechanism, None, arithmetic);
        let joints: Vec<usize> = (0..mechanism.joints().len()).collect();
        let part = Part {
            cycles: vec![joints.iter().map(|j| (*j, true)).collect()],
            couplings: Vec::new(),
            joints,
        };
        let here = jacobian(&mechanism, &geometry, &geometry.states, &part).unwrap();
        let mut matrix = here.matrix.map(&0.0, Real::to_f64);
        let scales = matrix.scale_columns();
        let metric = Metric::of(&mechanism, &here, &scales);
        let decision = decide(&matrix, 1e-12).unwrap();
        let kernel = null_vectors(&matrix, &decision, 64, 1).unwrap().vectors;
        Self {
            mechanism,
            geometry,
            part,
            metric,
            kernel,
        }
    }

    fn section(&self) -> Section<'_, R> {
        Section {
            mechanism: &self.mechanism,
            geometry: &self.geometry,
            part: &self.part,
            metric: &self.metric,
        }
    }

    fn residual(&self, states: &[JointState<R>]) -> f64 {
        let there = Equations::at(&self.mechanism, &self.geometry, states, &self.part).unwrap();
        there.largest()
    }
}

fn drawn(mechanism: Mechanism) -> Drawn<f64> {
    Drawn::new(mechanism, &Arithmetic::double())
}

/// A random vector of a length in the metric.
fn random(length: usize, size: f64) -> Vec<f64> {
    let mut random = SplitMix64::new(7);
    let mut z: Vec<f64> = (0..length).map(|_| random.symmetric()).collect();
    let norm = 0.0.norm(&z);
    z.iter_mut().for_each(|x| *x *= size / norm);
    z
}

fn along(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Turns, slides, a ball and a screw: 10 unknowns.
fn mixed() -> Mechanism {
    let places: Vec<Place> = vec![
        (JointKind::Revolute, [0.0, 0.0, 0.0], [0.0, 0.5, 1.0]),
        (JointKind::Spherical, [1.0, 0.5, 0.0], [1.0, 0.0, 0.0]),
        (JointKind::Cylindrical, [2.0, 0.0, 0.5], [1.0, 0.25, 0.0]),
        (JointKind::Screw, [2.0, -1.0, 0.0], [0.0, 1.0, 1.0]),
        (JointKind::Universal, [1.0, -2.0, 0.0], [0.5, 1.0, 0.0]),
        (JointKind::Prismatic, [0.0, -1.0, 0.5], [0.5, 0.0, 1.0]),
    ];
    ring(&places, [0.0; 3], Written::Exactly)
}

#[test]
fn columns_have_unit_length_in_the_metric() {
    for mechanism in [four_bar(), sarrus(), mixed()] {
        let drawn = drawn(mechanism);
        let section = drawn.section();
        let here = jacobian(
            &drawn.mechanism,
            &drawn.geometry,
            &drawn.geometry.states,
            &drawn.part,
        )
        .unwrap();
        let held = random(here.matrix.columns(), 1.0);
        let bordered = section
            .bordered(&here, std::slice::from_ref(&held))
            .unwrap();
        let mut squares = vec![0.0; bordered.columns()];
        for (row, column, value) in bordered.triplets() {
            if row < here.matrix.rows() {
                squares[column] += value * value;
            } else {
                assert_eq!(*value, held[column], "held directions are rows");
            }
        }
        assert!(
            squares.iter().all(|s| (s - 1.0).abs() < 1e-12),
            "{squares:?}"
        );
    }
}

#[test]
fn a_column_that_vanishes_has_a_weight_all_the_same() {
    let drawn = drawn(four_bar());
    let here = jacobian(
        &drawn.mechanism,
        &drawn.geometry,
        &drawn.geometry.states,
        &drawn.part,
    )
    .unwrap();
    let metric = Metric::of(&drawn.mechanism, &here, &[2.0, 0.0, 1.0, 1.0]);
    assert_eq!(metric.weights, [2.0, 1.0, 1.0, 1.0]);
}

/// R C C C at general places, whose equations are independent.
fn cylinders() -> Mechanism {
    let places: Vec<Place> = vec![
        (JointKind::Revolute, [0.0; 3], [0.0, 0.25, 1.0]),
        (JointKind::Cylindrical, [1.0, 0.25, 0.0], [0.5, 0.0, 1.0]),
        (JointKind::Cylindrical, [1.0, 1.5, 0.5], [0.0, 1.0, 0.5]),
        (JointKind::Cylindrical, [0.25, 1.0, -0.5], [1.0, -0.5, 0.25]),
    ];
    ring(&places, [0.0; 3], Written::Exactly)
}

#[test]
fn closing_leads_back_to_the_set_nearby() {
    for (name, mechanism) in [
        ("four-bar", four_bar()),
        ("cylinders", cylinders()),
        ("mixed", mixed()),
    ] {
        let drawn = drawn(mechanism);
        let section = drawn.section();
        let mut states = drawn.geometry.states.clone();
        let z = random(drawn.metric.weights.len(), 0.1);
        section.advance_by(&mut states, &z);
        let off = states.clone();
        assert!(drawn.residual(&states) > 1e-3, "{name}");
        let closing = section.close(&mut states, &[], 30).unwrap();
        assert!(closing.residual <= closing.rounding, "{name}: {closing:?}");
        assert_eq!(closing.residual, drawn.residual(&states), "{name}");
        // The way back is no longer than the way there, and hardly along the set.
        assert!(closing.way <= 0.11, "{name}: {closing:?}");
        assert!(
            closing.steps < 8 && closing.last_step < 1e-6,
            "{name}: {closing:?}"
        );
        let way = section.way_between(&off, &states);
        for tangent in &drawn.kernel {
            assert!(along(&way, tangent).abs() < 0.02, "{name}: {way:?}");
        }
    }
}

#[test]
fn equations_that_are_redundant_on_the_set_only_lead_along_it() {
    // Off its set a Sarrus linkage has six independent equations, and a step that meets all of them.
    let drawn = drawn(sarrus());
    let section = drawn.section();
    let z = random(6, 0.1);
    let mut ways = [0.0; 2];
    for (held, way) in [&[][..], &drawn.kernel[..]].into_iter().zip(&mut ways) {
        let mut states = drawn.geometry.states.clone();
        section.advance_by(&mut states, &z);
        let closing = section.close(&mut states, held, 30).unwrap();
        assert!(closing.residual <= closing.rounding, "{closing:?}");
        *way = closing.way;
    }
    assert!(ways[0] > 0.3 && ways[1] < 0.15, "{ways:?}");
}

#[test]
fn held_directions_stay_held() {
    // (A Sarrus linkage would stay closed along its kernel: its angles are proportional.)
    for (mechanism, freedom) in [(four_bar(), 1), (cylinders(), 1)] {
        let drawn = drawn(mechanism);
        let section = drawn.section();
        let held = &drawn.kernel;
        assert_eq!(held.len(), freedom);
        let mut states = drawn.geometry.states.clone();
        let z: Vec<f64> = held[0].iter().map(|x| 0.2 * x).collect();
        section.advance_by(&mut states, &z);
        let off = states.clone();
        let closing = section.close(&mut states, held, 30).unwrap();
        assert!(closing.residual <= closing.rounding, "{closing:?}");
        assert!(closing.way > 1e-3, "nothing was to do: {closing:?}");
        let way = section.way_between(&off, &states);
        for direction in held {
            assert!(along(&way, direction).abs() < 1e-14, "{way:?}");
        }
    }
}

#[test]
fn closing_is_exact_to_the_arithmetic() {
    for bits in [106, 212] {
        let drawn = Drawn::new(four_bar(), &Arithmetic::bits(bits));
        let section = drawn.section();
        let mut states = drawn.geometry.states.clone();
        section.advance_by(
            &mut states,
            &drawn.kernel[0].iter().map(|x| 0.2 * x).collect::<Vec<_>>(),
        );
        let closing = section.close(&mut states, &drawn.kernel, 60).unwrap();
        let roundoff = 0.5f64.powi(bits as i32);
        assert!(closing.residual <= closing.rounding, "{bits}: {closing:?}");
        assert!(closing.rounding < 1e4 * roundoff, "{bits}: {closing:?}");
    }
}

#[test]
fn what_cannot_be_closed_is_met_as_well_as_it_goes() {
    // Both velocities of the flat pose at once: they lead off the set, and what is left grows with their square.
    let drawn = drawn(flat_parallelogram());
    let section = drawn.section();
    assert_eq!(drawn.kernel.len(), 2);
    let left = |size: f64| {
        let mut states = drawn.geometry.states.clone();
        let z: Vec<f64> = drawn.kernel[0]
            .iter()
            .zip(&drawn.kernel[1])
            .map(|(a, b)| size * (0.8 * a + 0.6 * b))
            .collect();
        section.advance_by(&mut states, &z);
        let open = drawn.residual(&states);
        let closing = section.close(&mut states, &drawn.kernel, 40).unwrap();
        assert!(
            closing.residual <= open && closing.steps < 40,
            "{closing:?}"
        );
        assert!(closing.way < size, "{closing:?}");
        closing.residual
    };
    let (far, near) = (left(0.1), left(0.05));
    assert!(near > 1e-6 && (far / near).log2() > 1.7, "{far:e} {near:e}");
}

#[test]
fn no_step_is_taken_that_was_not_allowed_or_leads_nowhere() {
    // A gap across the plane of the hinges, which none of them can close.
    let drawn = drawn(ring(
        &planar(&CRANK_ROCKER),
        [0.0, 0.0, 0.5],
        Written::Exactly,
    ));
    let section = drawn.section();
    let mut states = drawn.geometry.states.clone();
    let open = drawn.residual(&states);
    let closing = section.close(&mut states, &[], 40).unwrap();
    assert_eq!((closing.residual, closing.way), (open, 0.0));
    assert!(
        section
            .way_between(&drawn.geometry.states, &states)
            .iter()
            .all(|x| *x == 0.0)
    );
    // None allowed.
    section.advance_by(&mut states, &[0.1, 0.0, 0.0, 0.0]);
    let before = states.clone();
    let closing = section.close(&mut states, &[], 0).unwrap();
    assert_eq!(closing.steps, 0);
    assert!(
        section
            .way_between(&before, &states)
            .iter()
            .all(|x| *x == 0.0)
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn ways_lead_from_one_pose_to_the_other(
        first in proptest::collection::vec(-1.0f64..1.0, 10),
        second in proptest::collection::vec(-0.8f64..0.8, 10),
    ) {
        let drawn = drawn(mixed());
        let section = drawn.section();
        prop_assert_eq!(drawn.metric.weights.len(), 10);
        let mut from = drawn.geometry.states.clone();
        section.advance_by(&mut from, &first);
        let mut to = from.clone();
        section.advance_by(&mut to, &second);
        let way = section.way_between(&from, &to);
        for (found, gone) in way.iter().zip(&second) {
            prop_assert!((found - gone).abs() < 1e-12, "{way:?} {second:?}");
        }
        // And back again: what the way says is what has to be gone.
        let back = section.way_between(&to, &from);
        section.advance_by(&mut to, &back);
        let rest = section.way_between(&from, &to);
        prop_assert!(rest.iter().all(|x| x.abs() < 1e-12), "{rest:?}");
    }
}

#[test]
fn within_rounding_is_reached_sooner_than_the_last_digit() {
    let mut steps = [0, 0];
    for mechanism in [four_bar(), cylinders(), mixed()] {
        let drawn = drawn(mechanism);
        let section = drawn.section();
        let mut best = drawn.geometry.states.clone();
        section.advance_by(&mut best, &random(drawn.metric.weights.len(), 0.1));
        let mut enough = best.clone();
        let long = section.close(&mut best, &[], 30).unwrap();
        let short = section.close_within_rounding(&mut enough, &[], 30).unwrap();
        assert!(short.residual <= short.rounding, "{short:?}");
        steps[0] += short.steps;
        steps[1] += long.steps;
        // The steps taken are the same.
        assert!(0.0.norm(&section.way_between(&best, &enough)) < 1e-8);
    }
    assert!(steps[0] < steps[1], "{steps:?}");
}

/// A part closed in double precision at a distance along its kernel, and that way.
fn closed_away(drawn: &Drawn<f64>) -> (Vec<JointState<f64>>, Vec<f64>) {
    let section = drawn.section();
    let mut states = drawn.geometry.states.clone();
    let z: Vec<f64> = drawn.kernel[0].iter().map(|x| 0.2 * x).collect();
    section.advance_by(&mut states, &z);
    section
        .close_within_rounding(&mut states, &drawn.kernel, 30)
        .unwrap();
    let led = section.way_between(&drawn.geometry.states, &states);
    (states, led)
}

#[test]
fn many_digits_follow_double_precision() {
    for mechanism in [four_bar(), cylinders()] {
        let double = drawn(mechanism.clone());
        let (near, led) = closed_away(&double);
        for bits in [106, 212, 424] {
            let fine = Drawn::new(mechanism.clone(), &Arithmetic::bits(bits));
            let section = fine.section();
            let mut states = fine.geometry.states.clone();
            section.advance_by(&mut states, &led);
            let open = fine.residual(&states);
            assert!(open > 1e-20, "{bits}: nothing is to do");
            let closing = section
                .close_guided(&mut states, (&double.section(), &near), &double.kernel, 60)
                .unwrap();
            assert_eq!(closing.residual, fine.residual(&states));
            assert!(closing.residual <= closing.rounding, "{bits}: {closing:?}");
            // Each step finds about as many digits as a double has.
            assert!(
                closing.steps <= 1 + bits as usize / 40,
                "{bits}: {closing:?}"
            );
            assert!(closing.way < 1e-10, "{bits}: {closing:?}");
        }
    }
}

#[test]
fn a_guide_that_stands_elsewhere_is_left() {
    let mechanism = cylinders();
    let double = drawn(mechanism.clone());
    let (near, led) = closed_away(&double);
    let fine = Drawn::new(mechanism, &Arithmetic::bits(212));
    let section = fine.section();
    // Half of the way: not closed, and not where the guide is.
    let mut states = fine.geometry.states.clone();
    let half: Vec<f64> = led.iter().map(|x| 0.5 * x).collect();
    section.advance_by(&mut states, &half);
    let closing = section
        .close_guided(&mut states, (&double.section(), &near), &double.kernel, 60)
        .unwrap();
    assert!(closing.residual <= closing.rounding, "{closing:?}");
    assert!(closing.way > 1e-4, "{closing:?}");
}
