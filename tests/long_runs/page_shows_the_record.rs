//! Record, page and figures agree.

use super::record::{drift, drift_share, growth};
use super::{figure, kept, page, runs};
use crate::support::folder;
use std::fs;

#[test]
fn the_record_has_every_run() {
    let kept = kept();
    let settings = runs::settings();
    assert_eq!(kept.runs.len(), settings.len());
    for (run, setting) in kept.runs.iter().zip(&settings) {
        assert_eq!(
            (run.subject, run.solver.as_str(), run.substeps, run.steps),
            (
                setting.subject,
                setting.solver.word(),
                setting.substeps,
                setting.steps
            )
        );
        let seen = &run.seen;
        for list in [
            &seen.closure,
            &seen.distance,
            &seen.energy_least,
            &seen.energy_mean,
            &seen.energy_most,
            &seen.behind,
        ] {
            assert_eq!(list.len(), setting.windows, "{setting:?}");
            assert!(list.iter().all(|x| x.is_finite()));
        }
    }
}

/// Page and figures are drawn from the record, every digit of them.
#[test]
fn the_page_and_the_figures_show_the_record() {
    let record = kept();
    let text = fs::read_to_string(folder("docs/src/long_runs.md")).unwrap();
    let anew = "to write them anew: cargo run --example long_runs -- --redraw";
    assert!(page::replaced(&text, &record).unwrap() == text, "{anew}");
    for (name, svg) in figure::figures(&record) {
        let path = folder("docs/src/images").join(format!("{name}.svg"));
        assert!(fs::read_to_string(path).unwrap() == svg, "{name}: {anew}");
        assert!(text.contains(&format!("images/{name}.svg")), "{name}");
    }
    assert_eq!(page::long_runs(&record).len(), 6);
}

#[test]
fn a_page_without_its_markers_is_refused() {
    let record = kept();
    for text in ["", page::BEGIN, page::END] {
        assert!(page::replaced(text, &record).is_err());
    }
}

#[test]
fn growth_and_drift_are_what_they_say() {
    let even = vec![2.0; 100];
    assert_eq!((growth(&even), drift(&even)), (1.0, 0.0));
    let rising: Vec<f64> = (0..100).map(|i| 1.0 + f64::from(i) / 100.0).collect();
    assert!((drift(&rising) - 1.0).abs() < 1e-12);
    assert!((drift_share(&rising) - 1.0 / 1.495).abs() < 1e-12);
    assert!((growth(&rising) - 1.99 / 1.09).abs() < 1e-12);
    // A single window that stands out at the end grows and hardly drifts: both are needed.
    let mut late = even.clone();
    late[99] = 4.0;
    assert!(growth(&late) == 2.0 && drift_share(&late) < 0.1);
}
