//! The tables in the book are those of the record, and the sizes in the record are those of the program as it is now. No
//! seconds are asserted.
#[allow(dead_code)] // the example takes the times
#[path = "../examples/exact_tables/measure.rs"]
mod measure;
#[path = "../examples/exact_tables/page.rs"]
mod page;
#[path = "../examples/exact_tables/published.rs"]
mod published;
#[path = "../examples/exact_tables/record.rs"]
mod record;
#[path = "../examples/exact_tables/scenes.rs"]
mod scenes;
use crate::support;

use record::{Figures, Record, Table};
use std::fs;
use support::folder;

fn kept() -> Record {
    let path = folder("benches/record/exact_tables.json");
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn the_page_is_that_of_the_record() {
    let page = fs::read_to_string(folder("docs/src/exact.md")).unwrap();
    assert_eq!(page::replaced(&page, &kept()).unwrap(), page);
}

/// Figures without times.
fn sizes(tables: &[Table]) -> Vec<(String, Option<Figures>)> {
    let rows = tables.iter().flat_map(|table| &table.rows);
    rows.map(|row| {
        let ours = row.ours.clone().map(|figures| Figures {
            seconds: None,
            ..figures
        });
        (format!("{} {} {}", row.example, row.way, row.what), ours)
    })
    .collect()
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn the_tables_are_computed_again() {
        let fresh = measure::tables(1, |_| ()).unwrap();
        assert_eq!(sizes(&fresh), sizes(&kept().tables));
    }

    /// All ways find the same dimension (which the measurement refuses to go on without), and the sizes are those kept.
    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn small_families_are_computed_again() {
        let kept = kept();
        for (family, scene) in scenes::FAMILIES.iter().zip(&kept.scenes) {
            assert_eq!(family.name, scene.name);
            for size in scene.sizes.iter().take(2) {
                let fresh = measure::size(family, size.n, 300.0).unwrap();
                assert_eq!(
                    (
                        fresh.variables,
                        fresh.equations,
                        fresh.dimension,
                        fresh.cases
                    ),
                    (size.variables, size.equations, size.dimension, size.cases),
                    "{} {}",
                    family.name,
                    size.n
                );
                let work = |size: &record::Size| size.ways.map(|way| way.map(|cost| cost.work));
                assert_eq!(work(&fresh), work(size), "{} {}", family.name, size.n);
            }
        }
    }
}
