//! Times answers within a running program: `timed_answers ROUNDS FILE...` prints one JSON object per file and line, with the
//! least and the median seconds of reading the file's text, of the verdict from the mechanism read, and of a traced turn.

use kutzbach::mobility::{AnalysisOptions, analyse};
use std::time::Instant;

fn main() {
    let mut arguments = std::env::args().skip(1);
    let rounds: usize = arguments.next().and_then(|n| n.parse().ok()).unwrap_or(5);
    let exact: Option<f64> = std::env::var("EXACT").ok().and_then(|n| n.parse().ok());
    for file in arguments {
        let text = std::fs::read_to_string(&file).unwrap();
        let mut reading = Vec::new();
        let mut verdict = Vec::new();
        let mut finite = None;
        for _ in 0..rounds {
            let start = Instant::now();
            let read = kutzbach::format::read(&text, &file, &[]).unwrap();
            reading.push(start.elapsed().as_secs_f64());
            let mut options = AnalysisOptions::default();
            if let Some(exact) = exact {
                options.exact = kutzbach::mobility::ExactBudget::seconds(exact);
            }
            let start = Instant::now();
            let analysis = analyse(&read.mechanism, &options).unwrap();
            verdict.push(start.elapsed().as_secs_f64());
            finite = analysis.mobility.finite();
        }
        for times in [&mut reading, &mut verdict] {
            times.sort_by(f64::total_cmp);
        }
        println!(
            "{:40} {:>10} read {:8.1} {:8.1}  verdict {:9.1} {:9.1}",
            std::path::Path::new(&file)
                .file_stem()
                .unwrap()
                .to_string_lossy(),
            format!("{finite:?}"),
            1e6 * reading[0],
            1e6 * reading[rounds / 2],
            1e6 * verdict[0],
            1e6 * verdict[rounds / 2]
        );
    }
}
