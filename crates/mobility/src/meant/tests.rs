use super::dimensions::Dimensions;
use super::relations::Relations;
use super::*;
use crate::analyse;
use crate::part_samples::bennett_places;
use kutzbach_closure::samples::{
    CRANK_ROCKER, Place, Written, add_ring, planar, ring, sarrus_places,
};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_model::mechanism::MechanismBuilder;

/// Sarrus' linkage in a general place, so that no coordinate is short.
fn sarrus(decimals: usize) -> Mechanism {
    ring(&turned_sarrus(), [0.0; 3], Written::Decimals(decimals))
}

fn turned_sarrus() -> Vec<Place> {
    let (cosine, sine) = (0.3f64.cos(), 0.3f64.sin());
    let turned = |[x, y, z]: [f64; 3]| {
        let (x, y) = (cosine * x - sine * y, sine * x + cosine * y);
        [x, cosine * y - sine * z, sine * y + cosine * z]
    };
    sarrus_places()
        .into_iter()
        .map(|(kind, at, along)| (kind, turned(at), turned(along)))
        .collect()
}

#[test]
fn a_linkage_of_coarse_decimals_is_the_one_that_it_rounds() {
    for decimals in 3..=5 {
        let found = analyse(&sarrus(decimals), &AnalysisOptions::default()).unwrap();
        assert_eq!(found.mobility.finite(), Some(1), "{decimals}");
    }
}

/// A four-bar of which one hinge leans over, wherever it stands.
fn leaning(tilt: f64, at: f64) -> Mechanism {
    let mut places: Vec<Place> = planar(&[
        [0.0, 0.0],
        [0.10003, 0.21001],
        [0.43017, 0.35002],
        [0.50009, 0.0],
    ]);
    places[2].2 = [0.0, tilt, 1.0];
    for (_, point, _) in &mut places {
        point[0] += at;
    }
    ring(&places, [0.0; 3], Written::Decimals(5))
}

#[test]
fn what_no_numbers_within_the_digits_move_is_rigid() {
    for at in [0.0, 14.5] {
        for tilt in [4e-5, 4.7e-4, 3e-3, 2e-2] {
            let found = analyse(&leaning(tilt, at), &AnalysisOptions::default()).unwrap();
            assert_eq!(found.mobility.finite(), Some(0), "{tilt} at {at}");
            let nominal = found.mobility.nominal;
            assert!(nominal.is_none_or(|n| !n.within_digits), "{tilt} at {at}");
        }
        // Half a unit of the last place is none.
        let found = analyse(&leaning(4e-6, at), &AnalysisOptions::default()).unwrap();
        assert_eq!(found.mobility.finite(), Some(1));
    }
}

/// The relations that the numbers of a loop as written nearly satisfy.
fn related(mechanism: &Mechanism) -> Relations {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let found = analyse(mechanism, &AnalysisOptions::default()).unwrap();
    let part = &found.structure.parts[0];
    let dimensions = Dimensions::of(mechanism, part);
    Relations::of(mechanism, part, &dimensions, &geometry, 1.0)
}

#[test]
fn relations_seen_in_rounded_numbers_hold_of_what_was_drawn() {
    // Two links of each leg; the other four pairs of axes are none.
    let related = related(&sarrus(3));
    assert_eq!(related.parallel_pairs(), 4);
    let off = |decimals: usize| {
        let drawn = Geometry::new(&sarrus(decimals), None, &Arithmetic::double());
        let rows = related.rows(&drawn, 1.0);
        rows.iter().fold(0.0f64, |most, row| row.abs().max(most))
    };
    assert!(off(13) < 1e-12 && off(3) > 1e-5, "{} {}", off(13), off(3));
}

#[test]
fn with_one_decimal_anything_would_be_related_by_chance() {
    assert!(related(&sarrus(1)).is_empty());
}

/// A four-bar of which a program printed the numbers, one axis out of parallel by so much.
fn noisy(tilt: f64) -> Vec<Place> {
    const UNIT: f64 = 0.731_058_578_630_004_9;
    let mut places = planar(&CRANK_ROCKER.map(|point| point.map(|x| x * UNIT)));
    places[1].2 = [UNIT * tilt, 0.0, UNIT];
    places
}

#[test]
fn each_loop_is_read_by_its_own_numbers() {
    let plain = noisy(0.0);
    for tilt in [3e-9, 1e-7] {
        for (other, decimals) in [(&plain, 9), (&turned_sarrus(), 5), (&turned_sarrus(), 4)] {
            // Names decide the order of the parts.
            for [one, two] in [["a", "b"], ["b", "a"]] {
                let mut builder = MechanismBuilder::new("two");
                builder.link("ground");
                let mut add = |name: &str, places: &[Place], decimals: usize| {
                    let written = Written::Decimals(decimals);
                    add_ring(&mut builder, name, "ground", places, [0.0; 3], written);
                };
                add(one, &noisy(tilt), 12);
                add(two, other, decimals);
                let found = analyse(&builder.build().unwrap(), &AnalysisOptions::default());
                let found = found.unwrap();
                let case = format!("{tilt:e} beside {decimals} decimals, {one} first");
                assert_eq!(found.mobility.finite(), Some(2), "{case}");
                let mut locked = found.roles.iter().map(|role| role.locked);
                assert!(locked.all(|locked| locked == Some(false)), "{case}");
            }
        }
    }
}

#[test]
fn noise_frees_no_loop_that_the_digits_of_another_hold_fast() {
    let mut builder = MechanismBuilder::new("two");
    builder.link("ground");
    let written = Written::Decimals(12);
    add_ring(&mut builder, "a", "ground", &noisy(1e-7), [0.0; 3], written);
    let mut bent = turned_sarrus();
    bent[1].2 = [0.9, 0.3, 0.1];
    let written = Written::Decimals(5);
    add_ring(&mut builder, "b", "ground", &bent, [0.0; 3], written);
    let found = analyse(&builder.build().unwrap(), &AnalysisOptions::default()).unwrap();
    assert_eq!(found.mobility.finite(), Some(1));
    let locked: Vec<Option<bool>> = found.roles.iter().map(|role| role.locked).collect();
    assert_eq!(locked[..4], [Some(false); 4]);
    assert_eq!(locked[4..], [Some(true); 6]);
}

#[test]
fn what_was_rounded_in_inches_is_what_was_drawn() {
    // Thousandths of an inch.
    const STEP: f64 = 2.54e-5;
    let mut places = bennett_places();
    for (_, point, _) in &mut places {
        *point = point.map(|x| (x / STEP).round() * STEP);
    }
    // The directions have as many digits: they were computed.
    for decimals in [17, 12, 8] {
        let found = ring(&places, [0.0; 3], Written::Decimals(decimals));
        let found = analyse(&found, &AnalysisOptions::default()).unwrap();
        assert_eq!(found.mobility.finite(), Some(1), "{decimals}");
    }
    // A tenth of a millimetre is no rounding of an inch.
    places[1].1[2] += 1e-4 + 0.3 * STEP;
    let found = ring(&places, [0.0; 3], Written::Decimals(12));
    let found = analyse(&found, &AnalysisOptions::default()).unwrap();
    assert_ne!(found.mobility.finite(), Some(1));
}

/// Sarrus' linkage of some size, its numbers off by up to so much of it (m), and as much in directions.
fn noisy_sarrus(size: f64, noise: f64) -> Mechanism {
    let mut random = kutzbach_math::matrix::SplitMix64::new(5);
    let mut off = |x: f64| x + noise * random.symmetric();
    let mut places = turned_sarrus();
    for (_, point, along) in &mut places {
        *point = point.map(|x| size * off(x));
        *along = along.map(&mut off);
    }
    // Fifteen digits or so, whatever the size.
    let decimals = if size < 1.0 { 17 } else { 14 };
    ring(&places, [0.0; 3], Written::Decimals(decimals))
}

#[test]
fn noise_is_noise_whatever_the_size() {
    // The last as drawn misses by more than any single number is off.
    for (size, noise) in [(1e-3, 1e-8), (1e2, 1e-7), (1.0, 1e-7), (1.0, 5e-7)] {
        let found = noisy_sarrus(size, noise);
        let found = analyse(&found, &AnalysisOptions::default()).unwrap();
        assert_eq!(found.mobility.finite(), Some(1), "{noise:e} of {size}");
    }
    let far = analyse(&noisy_sarrus(1.0, 1e-3), &AnalysisOptions::default()).unwrap();
    assert_ne!(far.mobility.finite(), Some(1));
}
