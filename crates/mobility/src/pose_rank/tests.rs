use super::readings::decide_twice;
use super::*;
use crate::Structure;
use crate::families::{
    bennett_row, double_planar, flattening_parallelogram, negative_power_of_ten, spoiled_bennett,
};
use kutzbach_closure::samples::{
    CRANK_ROCKER, Place, Written, flat_parallelogram, four_bar, general_four, planar, ring, sarrus,
    sarrus_places, spherical,
};
use kutzbach_closure::{Arithmetic, assemble};
use kutzbach_math::matrix::Ranks;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Direction, Frame, JointBuilder, JointKind, MechanismBuilder};

/// The rank of a one-part mechanism at its assembled pose.
fn ranked(mechanism: &Mechanism) -> PartRank {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let structure = Structure::new(mechanism);
    let held = BTreeSet::new();
    let assembly = assemble(mechanism, &geometry, &structure.parts, &held).unwrap();
    assert!(assembly.closed, "{assembly:?}");
    let pose = Pose {
        mechanism,
        configuration: None,
        held: &held,
        geometry: &geometry,
        states: &assembly.states,
        as_drawn: assembly.steps == 0,
        trial: Trial::default(),
    };
    rank_part(&pose, &structure.parts[0]).unwrap()
}

/// Hinges along x and along y, one of them tilted by `tilt`: a Sarrus linkage only if that is zero.
fn tilted(tilt: f64, written: Written) -> Mechanism {
    let mut places = sarrus_places();
    places[1].2 = [1.0, 0.5 * tilt, tilt];
    ring(&places, [0.0; 3], written)
}

#[test]
fn known_freedoms() {
    for (mechanism, freedom) in [
        (four_bar(), 1),
        (sarrus(), 1),
        (general_four(), 0),
        (flat_parallelogram(), 2),
    ] {
        let rank = ranked(&mechanism);
        assert_eq!(rank.instantaneous, Some(freedom));
        assert_eq!(rank.candidates, (freedom, freedom));
        assert_eq!((rank.bits, &rank.note), (53, &None));
        assert_eq!(
            rank.unknowns() - freedom,
            rank.settled().unwrap().rank.unwrap()
        );
    }
}

#[test]
fn a_tilt_of_1e_13_is_seen_with_106_bits() {
    let plain = ranked(&tilted(0.0, Written::Exactly));
    assert_eq!((plain.instantaneous, plain.bits), (Some(1), 53));
    // Doubles cannot tell this from rounding; the numbers themselves can.
    let rank = ranked(&tilted(1e-13, Written::Exactly));
    assert_eq!(
        rank.instantaneous,
        Some(0),
        "{:?} {:?}",
        rank.decision,
        rank.note
    );
    assert_eq!(rank.bits, 106);
    assert!(rank.decision.kept < 1e-12 && rank.decision.kept > 1e-15);
    // What doubles do tell, they tell.
    let rank = ranked(&tilted(1e-6, Written::Exactly));
    assert_eq!((rank.instantaneous, rank.bits), (Some(0), 53));
}

#[test]
fn rounded_numbers_have_two_readings() {
    // Six decimals of a tilt that is not theirs: nominally a Sarrus linkage.
    let mut places = sarrus_places();
    for (i, (_, at, along)) in places.iter_mut().enumerate() {
        // Turned about z by an angle whose cosine has no end.
        let (s, c) = 0.7f64.sin_cos();
        let turn = |v: [f64; 3]| [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
        (*at, *along) = (turn(*at), turn(*along));
        along[2] += if i == 1 { 1e-6 } else { 0.0 };
    }
    let rank = ranked(&ring(&places, [0.0; 3], Written::Decimals(6)));
    assert_eq!(rank.instantaneous, Some(1));
    assert!(rank.open_by_digits() > 1e-7 && rank.open_by_digits() < 1e-4);
    if let Some(literal) = rank.as_written {
        assert_eq!(literal, 0);
        assert!(rank.note.is_some());
    }
    // The same as doubles states nothing about rounding.
    let rank = ranked(&tilted(1e-6, Written::Exactly));
    assert_eq!((rank.instantaneous, rank.open_by_digits()), (Some(0), 0.0));
}

#[test]
fn numbers_that_agree_in_both_readings_need_no_note() {
    let points = [[0.0, 0.0], [0.333, 2.0], [4.0, 5.125], [4.0, 0.0]];
    let rank = ranked(&ring(&planar(&points), [0.0; 3], Written::Decimals(6)));
    assert_eq!(rank.instantaneous, Some(1));
    assert_eq!((rank.as_written, &rank.note), (Some(1), &None));
}

#[test]
fn coarse_numbers_are_taken_as_they_are() {
    // Centimetres with three decimals.
    let points = [[0.0, 0.0], [0.003, 0.02], [0.04, 0.05], [0.04, 0.001]];
    let rank = ranked(&ring(&planar(&points), [0.0; 3], Written::Decimals(3)));
    assert!(rank.is_taken_literally());
    assert_eq!((rank.instantaneous, rank.open_by_digits()), (Some(1), 0.0));
    let rank = ranked(&ring(
        &planar(&CRANK_ROCKER),
        [0.0; 3],
        Written::Decimals(3),
    ));
    assert!(!rank.is_taken_literally());
}

#[test]
fn rounded_spheres_are_spheres() {
    // The axes of a spherical loop miss each other by what the decimals left out, whether joints are drawn at the centre
    // or away from it: the size of that miss must not become the unit of length.
    for distances in [[0.0; 4], [0.3, 0.7, 0.2, 0.9]] {
        let centre = [0.123_456_7, -0.345_678_9, 0.765_432_1];
        let mut places = spherical(centre, distances);
        for (_, at, along) in &mut places {
            let (s, c) = 0.7f64.sin_cos();
            let turn = |v: [f64; 3]| [c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]];
            (*at, *along) = (turn(*at), turn(*along));
        }
        for decimals in [6, 9, 12] {
            let rank = ranked(&ring(&places, [0.0; 3], Written::Decimals(decimals)));
            assert_eq!(rank.instantaneous, Some(1), "{decimals}: {:?}", rank.note);
            assert!(!rank.is_taken_literally());
        }
    }
}

/// A four-bar that just reaches: a crank of 1 and a coupler of 2, stretched, to a rocker's pin, drawn with a gap that
/// only bending the rocker back closes.
fn stretched(short: f64) -> Mechanism {
    let points = [[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [4.0, 0.0]];
    ring(&planar(&points), [short, 0.0, 0.0], Written::Exactly)
}

#[test]
fn a_singular_pose_found_by_iteration_is_no_regular_one() {
    // Drawn bent, with lengths that close on one line only: the iteration comes near it as √ρ, where a small singular
    // value looks decided. It is the flat four-bar with two freedoms, and nothing else may be claimed.
    let mut builder = MechanismBuilder::new("taut");
    let n = |x: f64| Number::from_f64(x).unwrap();
    builder
        .link("ground")
        .link("crank")
        .link("coupler")
        .link("rocker");
    let z = || Direction([Number::zero(), Number::zero(), Number::one()]);
    let pin = |name: &str, a: &str, b: &str, at: [f64; 3]| {
        JointBuilder::tree(name, JointKind::Revolute, a, b)
            .origin(Frame::at(at.map(n)))
            .axis(z())
    };
    builder.joint(pin("a", "ground", "crank", [0.0; 3]));
    builder.joint(pin("b", "crank", "coupler", [1.0, 0.0, 0.0]));
    builder.joint(pin("c", "coupler", "rocker", [2.0, 0.0, 0.0]));
    builder.joint(
        JointBuilder::closing("d", JointKind::Revolute, "rocker", "ground")
            .origin(Frame::at([n(1.0), n(0.0), n(0.0)]))
            .successor_origin(Frame::at([n(4.0), n(0.0), n(0.0)]))
            .axis(z()),
    );
    builder.configuration(
        "bent",
        vec![
            ("a".to_owned(), vec![n(0.1)]),
            ("b".to_owned(), vec![n(-0.2)]),
        ],
    );
    let mechanism = builder.build().unwrap();
    let configuration = mechanism.configuration("bent");
    let geometry = Geometry::new(&mechanism, configuration, &Arithmetic::double());
    let structure = Structure::new(&mechanism);
    let held = BTreeSet::new();
    let assembly = assemble(&mechanism, &geometry, &structure.parts, &held).unwrap();
    assert!(assembly.closed && assembly.steps > 3, "{assembly:?}");
    let pose = Pose {
        mechanism: &mechanism,
        configuration,
        held: &held,
        geometry: &geometry,
        states: &assembly.states,
        as_drawn: false,
        trial: Trial::default(),
    };
    let rank = rank_part(&pose, &structure.parts[0]).unwrap();
    assert_eq!(rank.candidates.1, 2, "{:?} {:?}", rank.decision, rank.note);
    assert_ne!(rank.instantaneous, Some(1));
    // The stuck pose above, moved by assembly onto a regular one, is decided at once.
    let regular = ranked(&stretched(-0.5));
    assert_eq!((regular.instantaneous, regular.bits), (Some(1), 53));
}

#[test]
fn the_rank_knows_no_unit_and_no_origin() {
    for unit in [1e-9, 1e-6, 1.0, 1e6, 1e90] {
        let places: Vec<Place> = sarrus_places()
            .into_iter()
            .map(|(kind, at, along)| (kind, at.map(|x| x * unit), along))
            .chain([(JointKind::Prismatic, [0.5 * unit; 3], [1.0, 0.25, 0.0])])
            .collect();
        let rank = ranked(&ring(&places, [0.0; 3], Written::Exactly));
        // The slider goes in the plane of the two chains' translations, and repeats them.
        assert_eq!(rank.instantaneous, Some(2), "{unit:e}");
    }
    let shifted: Vec<Place> = sarrus_places()
        .into_iter()
        .map(|(kind, [x, y, z], along)| (kind, [x + 2048.0, y - 512.0, z], along))
        .collect();
    assert_eq!(
        ranked(&ring(&shifted, [0.0; 3], Written::Exactly)).instantaneous,
        Some(1)
    );
}

#[test]
fn loops_without_freedom_or_without_size() {
    let fixed: Vec<Place> = vec![(JointKind::Fixed, [0.0; 3], [0.0; 3]); 3];
    let rank = ranked(&ring(&fixed, [0.0; 3], Written::Exactly));
    assert_eq!(
        (rank.instantaneous, rank.unknowns(), rank.equations()),
        (Some(0), 0, 6)
    );
    // Four hinges on one axis at one point: three of them are idle.
    let coaxial: Vec<Place> = vec![(JointKind::Revolute, [0.0; 3], [0.0, 0.0, 1.0]); 4];
    assert_eq!(
        ranked(&ring(&coaxial, [0.0; 3], Written::Exactly)).instantaneous,
        Some(3)
    );
    let sliders: Vec<Place> = vec![
        (JointKind::Prismatic, [0.0; 3], [1.0, 0.0, 0.0]),
        (JointKind::Prismatic, [0.0; 3], [0.0, 1.0, 0.0]),
        (JointKind::Prismatic, [0.0; 3], [1.0, 1.0, 0.0]),
    ];
    assert_eq!(
        ranked(&ring(&sliders, [0.0; 3], Written::Exactly)).instantaneous,
        Some(1)
    );
}

#[test]
fn two_accuracies_must_agree() {
    let matrix = SparseMatrix::from_triplets(2, 2, 0.0, [(0, 0, 1.0), (1, 1, 1e-8)]).unwrap();
    let ranks = Ranks::of(&matrix).unwrap();
    assert_eq!(decide_twice(&ranks, 1e-14, 0.0).unwrap().rank, Some(2));
    let doubtful = decide_twice(&ranks, 1e-14, 1e-7).unwrap();
    assert_eq!((doubtful.rank, doubtful.candidates), (None, (1, 2)));
    assert_eq!(decide_twice(&ranks, 1e-14, 1e-10).unwrap().rank, Some(2));
}

/// The rank of a mechanism and the height of its numbers.
fn ranked_by_height(mechanism: &Mechanism) -> (usize, PartRank) {
    let structure = Structure::new(mechanism);
    (height(mechanism, &structure.parts[0]), ranked(mechanism))
}

#[test]
fn doubles_and_decimals_are_never_tall() {
    for written in [Written::Exactly, Written::Decimals(15)] {
        let (height, rank) = ranked_by_height(&ring(&sarrus_places(), [0.0; 3], written));
        assert_eq!((height, rank.bits), (0, 53), "{written:?}");
    }
}

#[test]
fn tall_numbers_are_ranked_in_more_bits_than_they_have() {
    // The smallest offsets are far below what doubles would call rounding.
    for exponent in [9, 14, 40] {
        let epsilon = negative_power_of_ten(exponent);
        for (name, mechanism, freedom) in [
            ("Bennett", spoiled_bennett(&epsilon).unwrap(), 0),
            ("flattening", flattening_parallelogram(&epsilon).unwrap(), 1),
            ("planes", double_planar(&epsilon).unwrap(), 1),
        ] {
            let (height, rank) = ranked_by_height(&mechanism);
            assert!(height > TALL, "{name} 1e-{exponent}: {height}");
            assert_eq!(
                rank.instantaneous,
                Some(freedom),
                "{name} 1e-{exponent}: {:?}",
                rank.note
            );
            // What doubles see to be independent needs no more of them.
            let seen = freedom == 0 && exponent < 13;
            let enough = if seen { 53 } else { (3 * height).min(848) };
            assert!(
                rank.bits as usize >= enough && (rank.bits == 53) == seen,
                "{name} 1e-{exponent}: {} bits for {height}",
                rank.bits
            );
            assert_eq!(rank.candidates, (freedom, freedom), "{name} 1e-{exponent}");
        }
    }
}

#[test]
fn short_exact_numbers_are_left_to_doubles() {
    for mechanism in [
        bennett_row(1).unwrap(),
        spoiled_bennett(&Number::zero()).unwrap(),
        spoiled_bennett(&negative_power_of_ten(3)).unwrap(),
    ] {
        let (height, rank) = ranked_by_height(&mechanism);
        assert!(height <= TALL, "{height}");
        assert_eq!(rank.bits, 53);
    }
}

#[test]
fn tall_numbers_of_full_rank_ask_for_nothing() {
    // Nothing was dropped that could have been meant: a triangle with an offset in its last corner.
    let number = |x: f64| Number::from_f64(x).unwrap();
    let offset = |x: f64| &number(x) + &negative_power_of_ten(14);
    let mut builder = MechanismBuilder::new("tall");
    let z = || Direction([Number::zero(), Number::zero(), Number::one()]);
    builder.link("ground");
    let mut before = "ground".to_owned();
    let at = |x: f64, y: f64| Frame::at([offset(x), number(y), Number::zero()]);
    for (i, (x, y)) in [(0.0, 0.0), (0.5, 2.0)].into_iter().enumerate() {
        let link = format!("link_{i}");
        builder.link(&link);
        let joint = JointBuilder::tree(&format!("j{i}"), JointKind::Revolute, &before, &link);
        builder.joint(joint.origin(at(x, y)).axis(z()));
        before = link;
    }
    let third = Frame::at([number(3.0), number(-2.0), Number::zero()]);
    let there = Frame::at([
        &(&number(3.5) + &negative_power_of_ten(14)) + &negative_power_of_ten(14),
        Number::zero(),
        Number::zero(),
    ]);
    let closing = JointBuilder::closing("last", JointKind::Revolute, &before, "ground");
    builder.joint(closing.origin(third).successor_origin(there).axis(z()));
    let (height, rank) = ranked_by_height(&builder.build().unwrap());
    assert!(height > TALL);
    assert_eq!(
        (rank.instantaneous, rank.bits),
        (Some(0), 53),
        "{:?}",
        rank.note
    );
}

#[test]
fn tall_numbers_that_stay_open_leave_the_rank_open() {
    // A four-bar whose last side is off across the plane: closed to doubles, and to more digits at no pose.
    let number = |x: f64| Number::from_f64(x).unwrap();
    let mut builder = MechanismBuilder::new("open");
    builder.link("ground");
    let z = || Direction([Number::zero(), Number::zero(), Number::one()]);
    let mut before = "ground".to_owned();
    let steps = [(0.0, 0.0), (0.0, 2.0), (4.0, 3.0)];
    for (i, (x, y)) in steps.into_iter().enumerate() {
        let link = format!("link_{i}");
        builder.link(&link);
        let joint = JointBuilder::tree(&format!("j{i}"), JointKind::Revolute, &before, &link);
        let at = Frame::at([number(x), number(y), Number::zero()]);
        builder.joint(joint.origin(at).axis(z()));
        before = link;
    }
    let here = Frame::at([number(0.0), number(-5.0), Number::zero()]);
    let there = Frame::at([number(4.0), number(0.0), negative_power_of_ten(20)]);
    let closing = JointBuilder::closing("last", JointKind::Revolute, &before, "ground");
    builder.joint(closing.origin(here).successor_origin(there).axis(z()));
    let (height, rank) = ranked_by_height(&builder.build().unwrap());
    // From 1e-20 m to 5 m.
    assert_eq!(height, 69);
    assert_eq!(rank.instantaneous, None, "{:?}", rank.decision);
    assert!(
        rank.candidates.0 <= 1 && rank.candidates.1 >= 1,
        "{:?}",
        rank.candidates
    );
    let note = rank.note.unwrap();
    assert!(matches!(note, RankNote::StaysOpen { .. }), "{note}");
}

/// A planar four-bar with a screw, a gear between two of its links, and one side of a length given: one part.
fn rectangle(side: Number, lead: Number, ratio: Number) -> Mechanism {
    let mut builder = MechanismBuilder::new("rectangle");
    let z = || Direction([Number::zero(), Number::zero(), Number::one()]);
    let at = |x: Number, y: i64| Frame::at([x, Number::integer(y), Number::zero()]);
    for link in ["ground", "crank", "coupler", "rocker"] {
        builder.link(link);
    }
    let tree = |name, parent, child| JointBuilder::tree(name, JointKind::Revolute, parent, child);
    builder.joint(tree("a", "ground", "crank").axis(z()));
    builder.joint(
        tree("b", "crank", "coupler")
            .origin(at(Number::zero(), 1))
            .axis(z()),
    );
    builder.joint(
        tree("d", "ground", "rocker")
            .origin(at(side.clone(), 0))
            .axis(z()),
    );
    let closing = JointBuilder::closing("c", JointKind::Screw, "coupler", "rocker");
    let closing = closing
        .origin(at(side, 0))
        .successor_origin(at(Number::zero(), 1));
    builder.joint(closing.axis(z()).lead(lead));
    builder.coupling("gear", "crank", "rocker", ratio);
    builder.build().unwrap()
}

#[test]
fn leads_ratios_and_sides_far_apart_count() {
    let bits = |side: i32, lead: i32, ratio: i32| {
        let [side, lead, ratio] =
            [side, lead, ratio].map(|exponent| Number::integer(10).power(exponent).unwrap());
        let mechanism = rectangle(side, lead, ratio);
        let structure = Structure::new(&mechanism);
        height(&mechanism, &structure.parts[0])
    };
    assert_eq!(bits(0, 0, 0), 0);
    // 1000 beside 1 is nothing special; 1e16 beside 1 are 54 bits, though a double holds each of them.
    assert_eq!(bits(3, 0, 0), 0);
    assert_eq!(bits(16, 0, 0), 54);
    assert_eq!(bits(0, 16, 0), 54);
    assert_eq!(bits(0, 0, 16), 54);
    // Fractions are as long as they are written.
    assert_eq!(bits(0, -16, 0), 54);
    assert_eq!(bits(0, 0, -16), 54);
}

#[test]
fn values_of_a_configuration_count() {
    let mut builder = MechanismBuilder::new("turned");
    builder.link("ground").link("arm");
    let hinge = JointBuilder::tree("hinge", JointKind::Revolute, "ground", "arm");
    builder.joint(hinge);
    let angle = &Number::pi() - &negative_power_of_ten(14);
    let turned = vec![("hinge".to_owned(), vec![angle])];
    builder.configuration("turned", turned.clone());
    builder.configuration_with_starts("begun", Vec::new(), turned);
    let mechanism = builder.build().unwrap();
    let part = Part {
        joints: vec![0],
        ..Part::default()
    };
    let held = BTreeSet::new();
    let at = |name: &str, moved: f64| {
        let configuration = mechanism.configuration(name);
        let geometry = Geometry::new(&mechanism, configuration, &Arithmetic::double());
        let mut states = geometry.states.clone();
        states[0].values[0] += moved;
        let pose = Pose {
            mechanism: &mechanism,
            configuration,
            held: &held,
            geometry: &geometry,
            states: &states,
            as_drawn: moved == 0.0,
            trial: Trial::default(),
        };
        height_at(&pose, &part)
    };
    assert_eq!(at("none", 0.0), 0);
    assert_eq!([at("turned", 0.0), at("turned", 0.1)], [47; 2]);
    // Where the joint only begins counts as long as it stands there.
    assert_eq!([at("begun", 0.0), at("begun", 0.1)], [47, 0]);
}

#[test]
fn a_kernel_is_the_one_of_the_rank_it_is_asked_at() {
    let mut rank = crate::part_samples::Posed::new(flat_parallelogram()).rank();
    let decision = rank.settled().unwrap();
    let anew = |limit, seed| null_vectors_in_doubles(&rank.matrix, &decision, limit, seed).unwrap();
    let basis = rank.null_vectors(9, 1).unwrap();
    assert_eq!(basis, anew(9, 1));
    assert_eq!(basis.as_ref().map(|found| found.nullity), Some(2));
    assert_eq!(rank.null_vectors(2, 5).unwrap(), basis);
    // Fewer vectors than a basis has are others, and no basis.
    let one = rank.null_vectors(1, 5).unwrap();
    assert_eq!(one, anew(1, 5));
    assert!(one.is_some_and(|found| !found.complete));
    rank.instantaneous = Some(1);
    assert_ne!(rank.null_vectors(9, 1).unwrap(), basis);
}
