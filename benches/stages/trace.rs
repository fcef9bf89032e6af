//! Poses of a predicted motion.

use super::cases::mechanism;
use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::motion::{Curve, TraceOptions, trace};

/// Poses per turn.
const POSES: usize = 1000;

fn curve(case: &str) -> Curve {
    let mechanism = mechanism(case);
    let analysis =
        analyse(&mechanism, &AnalysisOptions::default()).expect("coordinates are in range");
    let options = TraceOptions {
        samples: 2,
        ..TraceOptions::default()
    };
    trace(&mechanism, &analysis, &options)
        .expect("nothing is asked for that is not there")
        .into_motion()
        .expect("it moves")
        .curve
}

/// Closed poses along one turn of a mechanism of one loop.
#[divan::bench(args = ["four bar", "bennett"])]
fn poses(bencher: Bencher, case: &str) {
    let mut curve = curve(case);
    let (first, last) = curve.arclengths();
    bencher.counter(ItemsCount::new(POSES)).bench_local(|| {
        let mut worst = 0.0f64;
        for index in 0..POSES {
            let arc = first + (last - first) * (index as f64 + 0.5) / POSES as f64;
            let found = curve
                .pose_at_arclength(black_box(arc))
                .expect("on the curve");
            worst = worst.max(found.closure);
        }
        assert!(worst <= 1e-12);
        worst
    });
}

/// The whole curve, from the analysis on, with a hundred samples and everything met on the way.
#[divan::bench(args = ["four bar", "bennett", "steffen", "scissor 100"], sample_count = 3)]
fn whole_curve(bencher: Bencher, case: &str) {
    let mechanism = mechanism(case);
    let analysis =
        analyse(&mechanism, &AnalysisOptions::default()).expect("coordinates are in range");
    bencher.bench_local(|| {
        trace(black_box(&mechanism), &analysis, &TraceOptions::default())
            .expect("nothing is asked for that is not there")
    });
}
