//! Work that is asked to end: it ends soon, and leaves nothing that only looks like an answer.

use crate::support::folder;
use kutzbach::format::read_file;
use kutzbach::interruption::{Interrupted, Interruption};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{AnalysisOptions, Depth, Followed, analyse, analyse_to_follow};
use kutzbach::motion::{TraceOptions, trace};
use kutzbach::report::traced::data;
use kutzbach::sweep::{Family, MeasuredFile, Over, Plan, outcome};
use std::thread;
use std::time::{Duration, Instant};

/// A fifth of a second is wanted; the rest is what builds without optimisation take on a machine with much to do.
const SOON: Duration = Duration::from_secs(5);

/// A singular pose of six legs that many engines are asked about, for some ten seconds in a build for tests.
const LONG: &str = "tests/zoo/wren_platform_6US.urdf";

fn read(file: &str) -> Mechanism {
    read_file(folder(file), &[]).unwrap().mechanism
}

/// Does work that another thread interrupts after a while: what became of it, and how long it took to end from then on.
fn interrupted_after<T>(
    wait: Duration,
    work: impl FnOnce() -> T,
) -> (Result<T, Interrupted>, Duration) {
    let interruption = Interruption::default();
    let other = interruption.clone();
    let waiting = thread::spawn(move || {
        thread::sleep(wait);
        other.interrupt();
        Instant::now()
    });
    let result = interruption.during(work);
    let ended = Instant::now();
    let asked = waiting.join().unwrap();
    (result, ended.saturating_duration_since(asked))
}

#[test]
fn an_analysis_ends_soon_wherever_it_is() {
    let mechanism = read(LONG);
    for wait in [20, 100, 300, 700] {
        let work = || analyse(&mechanism, &AnalysisOptions::default()).is_ok();
        let (result, took) = interrupted_after(Duration::from_millis(wait), work);
        assert_eq!(result, Err(Interrupted), "after {wait} ms");
        assert!(took < SOON, "after {wait} ms it took {took:?}");
    }
}

#[test]
fn a_trace_ends_soon() {
    let Followed {
        mechanism,
        analysis,
        ..
    } = analyse_to_follow(
        &read("mechanisms/bennett.urdf"),
        &AnalysisOptions {
            depth: Depth::Motions,
            ..AnalysisOptions::default()
        },
    )
    .unwrap();
    let options = TraceOptions {
        samples: 10_000_000,
        ..TraceOptions::default()
    };
    let work = || trace(&mechanism, &analysis, &options).is_ok();
    let (result, took) = interrupted_after(Duration::from_millis(200), work);
    assert_eq!(result, Err(Interrupted));
    assert!(took < SOON, "{took:?}");
}

#[test]
fn there_is_the_whole_answer_or_none_and_the_next_one_is_whole() {
    let mut without = 0;
    for file in [
        "mechanisms/bennett.urdf",
        "mechanisms/sarrus.urdf",
        "tests/zoo/double_watt_tangential.urdf",
    ] {
        let mechanism = read(file);
        let options = AnalysisOptions::default();
        let told = || {
            let analysis = analyse(&mechanism, &options).unwrap();
            let mobility = &analysis.mobility;
            let words = (mobility.certificate.clone(), mobility.why.clone());
            (outcome(&mechanism, &analysis, Depth::Everything), words)
        };
        let whole = told();
        for micros in [0, 100, 300, 1000, 3000, 10_000, 30_000, 100_000] {
            // An interrupted analysis may be an error, of which nothing is told either.
            let work = || analyse(&mechanism, &options).map(|_| ());
            let (result, _) = interrupted_after(Duration::from_micros(micros), work);
            without += usize::from(result.is_err());
            // The same mechanism: what was interrupted has left nothing in it.
            assert_eq!(told(), whole, "{file}, {micros} µs");
        }
    }
    assert!(without > 0, "nothing was interrupted");
}

#[test]
fn a_trace_is_whole_or_none() {
    let mechanism = read("mechanisms/bennett.urdf");
    let told = || {
        let followed = analyse_to_follow(&mechanism, &AnalysisOptions::default()).unwrap();
        let found = trace(
            &followed.mechanism,
            &followed.analysis,
            &TraceOptions::default(),
        )
        .unwrap();
        data(&followed.mechanism, followed.changed, &found, &[]).to_string()
    };
    let whole = told();
    for micros in [100, 1000, 5000, 20_000, 60_000] {
        // Work that panics because a part of it is missing would be a fault too.
        let work = || {
            let followed = analyse_to_follow(&mechanism, &AnalysisOptions::default()).ok()?;
            let options = TraceOptions::default();
            let found = trace(&followed.mechanism, &followed.analysis, &options).ok()?;
            Some(data(&followed.mechanism, followed.changed, &found, &[]).to_string())
        };
        if let (Ok(found), _) = interrupted_after(Duration::from_micros(micros), work) {
            assert_eq!(found.as_ref(), Some(&whole), "{micros} µs");
        }
    }
}

#[test]
fn a_variant_under_way_has_no_row() {
    let path = folder("mechanisms/bennett_spoiled.urdf");
    let source = MeasuredFile {
        bytes: std::fs::read(&path).unwrap(),
        file: "bennett_spoiled.urdf".to_owned(),
        base: Some(path),
        options: kutzbach::format::ReadOptions::default(),
    };
    let plan = Plan::new(vec![Over::read("off=0..1:100").unwrap()], None).unwrap();
    let family = Family::new(source, plan, AnalysisOptions::default()).unwrap();
    let members = family.members();
    let interruption = Interruption::default();
    let whole = members.row(1);
    assert_eq!(interruption.during(|| members.row(1)), Ok(whole));
    interruption.interrupt();
    assert_eq!(interruption.during(|| members.row(1)), Err(Interrupted));
}
