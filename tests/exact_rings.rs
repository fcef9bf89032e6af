//! Rings of hinges as facts: how many dimensions, how many pieces, how many shapes.

use kutzbach::algebra::{
    Budget, ExactAnswer, ExactOptions, FinitePoints, Formulation, Limits, MonomialOrder,
    SystemOptions, exact_answer, groebner_basis, polynomial_system,
};
use kutzbach::format::read_file;
use kutzbach::mechanism::Mechanism;
use std::path::Path;

/// Generous: a slow machine must not fail a test of mathematics.
fn budget() -> Budget {
    Budget::new(Limits::seconds(300.0))
}

fn mechanism(file: &str, settings: &[(&str, &str)]) -> Mechanism {
    let settings: Vec<(String, String)> = settings
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    read_file(path, &settings).unwrap().mechanism
}

fn options(formulation: Formulation) -> SystemOptions {
    SystemOptions {
        formulation,
        ..SystemOptions::default()
    }
}

fn answer(file: &str, formulation: Formulation) -> ExactAnswer {
    let options = ExactOptions {
        system: options(formulation),
        ..ExactOptions::default()
    };
    let answer = exact_answer(&mechanism(file, &[]), &options, &budget()).unwrap();
    assert_eq!(answer.stopped, None, "{file}");
    assert!(answer.decomposed, "{file}");
    answer
}

/// The joints' freedoms and those of a tree: two systems with nothing but the mechanism in common.
const BOTH: [Formulation; 2] = [Formulation::Canonical, Formulation::Tree];

/// With √3 among its numbers: the degree counts both conjugates.
#[test]
fn threefold_ring_with_a_square_root() {
    let answer = answer("mechanisms/bricard_threefold.urdf", Formulation::Tree);
    assert_eq!(answer.dimension, Some(Some(1)));
    assert_eq!(answer.pieces.len(), 1);
    assert_eq!(answer.pieces[0].component.degree, Some(16));
}

#[test]
fn five_hinges_stand_still_or_do_not_fit() {
    for formulation in BOTH {
        let closed = answer("tests/rings/five_hinges_closed.urdf", formulation);
        assert_eq!(closed.dimension, Some(Some(0)));
        // Five angles, six equations: nothing but the pose drawn.
        let solutions = closed.solutions.as_ref().unwrap();
        assert_eq!((solutions.complex, solutions.real.len()), (1, 1));
        assert_eq!(closed.pieces[0].contains_home, Some(true));
        let open = answer("tests/rings/five_hinges_open.urdf", formulation);
        assert_eq!(open.dimension, Some(None));
        assert!(open.basis.unwrap().is_inconsistent());
    }
}

/// Shapes of a ring that stands still: complex ones with their multiplicities, distinct complex ones, real ones.
fn shapes(file: &str, settings: &[(&str, &str)], formulation: Formulation) -> [usize; 3] {
    let budget = budget();
    let system = polynomial_system(&mechanism(file, settings), &options(formulation)).unwrap();
    let (equations, variables) = (system.polynomials(), system.variables.len());
    let order = MonomialOrder::Degrevlex;
    let basis = groebner_basis(&equations, variables, &order, &budget).unwrap();
    assert_eq!(basis.dimension(), Some(0), "{file}");
    let points = FinitePoints::new(&basis, &budget).unwrap().unwrap();
    assert_eq!(basis.degree(), Some(points.multiplicity()), "{file}");
    let real = points.real_solutions(32, &budget).unwrap();
    assert_eq!(points.real_count(&budget), Ok(real.len()), "{file}");
    [points.multiplicity(), points.count(), real.len()]
}

/// Measures that are set, and shapes with and without their multiplicities.
type ShapesRow<'a> = (&'a [(&'a str, &'a str)], [usize; 2]);

/// Offsets that vanish take no shape away; twists and hinges in special position do.
#[test]
fn six_hinges_with_fewer_shapes() {
    let rows: [ShapesRow; 5] = [
        (&[], [16, 16]),
        // Two neighbours' twists add to a right angle; the same two apart from one another do nothing.
        (&[("twist_2", "acos(4/5)")], [12, 12]),
        (&[("twist_3", "acos(4/5)")], [16, 16]),
        // Two hinges meet, or the last three: without offsets two of the eight shapes are double.
        (&[("L5", "0")], [16, 16]),
        (&[("L4", "0"), ("L5", "0")], [8, 6]),
    ];
    let file = "tests/rings/six_hinges_twists.urdf";
    for (settings, expected) in rows {
        let [all, distinct, _] = shapes(file, settings, Formulation::Tree);
        assert_eq!([all, distinct], expected, "{settings:?}");
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    /// The whole answer, solutions and cycles included, comes to its end.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn six_hinges_are_answered_in_full() {
        let found = answer(
            "tests/rings/six_hinges_no_offsets.urdf",
            Formulation::Canonical,
        );
        let solutions = found.solutions.as_ref().unwrap();
        assert_eq!((solutions.complex, solutions.real.len()), (16, 8));
        assert!(found.decomposed);
        assert_eq!(found.dimension_at_home(), Some(0));
        // Six joints, every one with a cosine and a sine, of which the drawn pose has one value each.
        assert_eq!(found.fixed.len(), 12);
        assert!(found.fixed.iter().all(|f| !f.values.is_empty()));
        assert_eq!(found.cycles[0].clusters[0].len(), 6);
    }

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn six_hinges_have_sixteen_shapes() {
        for file in [
            "mechanisms/six_hinge_rigid.urdf",
            "tests/rings/six_hinges_no_offsets.urdf",
        ] {
            let [_, complex, real] = shapes(file, &[], Formulation::Tree);
            assert_eq!(complex, 16, "{file}");
            // The pose drawn, and complex shapes come in pairs.
            assert!(real >= 2 && real % 2 == 0, "{file}: {real}");
        }
    }

    /// Rings that are one curve, irreducible over the rationals, of this degree, with the drawn pose on it.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn rings_that_move() {
        let rings = [
            ("mechanisms/planar_four_bar.urdf", 6),
            ("tests/rings/spherical_four_hinges.urdf", 8),
            ("mechanisms/spherical_four_bar.urdf", 8),
            ("mechanisms/bennett.urdf", 4),
            ("mechanisms/goldberg_five_bar.urdf", 6),
            ("tests/rings/bricard_threefold_rational.urdf", 8),
        ];
        for (file, degree) in rings {
            for formulation in BOTH {
                let answer = answer(file, formulation);
                assert_eq!(answer.dimension, Some(Some(1)), "{file}");
                let [piece] = &answer.pieces[..] else {
                    panic!("{file}: {} pieces", answer.pieces.len());
                };
                assert_eq!(piece.component.dimension, 1, "{file}");
                assert_eq!(piece.component.degree, Some(degree), "{file}");
                assert_eq!(piece.contains_home, Some(true), "{file}");
                assert!(answer.fixed.is_empty(), "{file}");
            }
        }
    }
}
