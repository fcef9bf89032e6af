use super::*;
use crate::analyse;
use kutzbach_closure::samples::{Place, Written, ring, sarrus_places};

/// Sarrus' linkage in a general place, so that no coordinate is short.
fn sarrus(decimals: usize) -> Mechanism {
    let (cosine, sine) = (0.3f64.cos(), 0.3f64.sin());
    let turned = |[x, y, z]: [f64; 3]| {
        let (x, y) = (cosine * x - sine * y, sine * x + cosine * y);
        [x, cosine * y - sine * z, sine * y + cosine * z]
    };
    let places: Vec<Place> = sarrus_places()
        .into_iter()
        .map(|(kind, at, along)| (kind, turned(at), turned(along)))
        .collect();
    ring(&places, [0.0; 3], Written::Decimals(decimals))
}

#[test]
fn a_linkage_of_coarse_decimals_is_the_one_that_it_rounds() {
    for decimals in 3..=5 {
        let found = analyse(&sarrus(decimals), &AnalysisOptions::default()).unwrap();
        assert_eq!(found.mobility.finite(), Some(1), "{decimals}");
    }
}
