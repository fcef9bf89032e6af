//! All engines, as a user asks them: for the verdict, and for everything that a report says.
//!
//! Each is an analysis of its own, so that what it says is what it found, and not what a deeper one knows.

use super::analysis::{Subject, bounds_text};
use super::result::{Claim, Way, WayTiming};
use kutzbach_mobility::{Analysis, AnalysisError, AnalysisOptions, Depth, Verdict, analyse};
use std::collections::BTreeSet;
use std::hint::black_box;

/// What a user waits for, and how deep the analysis is that answers it.
pub(super) const WAITED_FOR: [(&str, Depth); 2] = [
    ("verdict", Depth::Verdict),
    ("whole report", Depth::Everything),
];

impl Subject<'_> {
    /// All engines, as far as `depth` asks them.
    pub(super) fn all_engines(&self, name: &str, depth: Depth) -> Way {
        let options = AnalysisOptions {
            depth,
            ..self.options.clone()
        };
        let (answer, timing) = self
            .patience
            .time(|| analyse(black_box(self.mechanism), &options));
        self.told(name, &answer, timing)
    }

    fn told(&self, name: &str, answer: &Result<Analysis, AnalysisError>, timing: WayTiming) -> Way {
        let mut way = Way {
            name: name.to_owned(),
            precision: "as needed".to_owned(),
            says: String::new(),
            claim: Claim::Silent,
            decades: None,
            certificate: None,
            text: String::new(),
            timing,
        };
        let analysis = match answer {
            Ok(analysis) => analysis,
            Err(error) => {
                way.text = error.to_string();
                return way;
            }
        };
        let mobility = &analysis.mobility;
        let engines: BTreeSet<&str> = analysis.claims().map(|(_, c)| c.engine.word()).collect();
        let engines: Vec<&str> = engines.into_iter().collect();
        way.text = match engines.as_slice() {
            [] => "no engine is needed".to_owned(),
            several => format!("asked: {}", several.join(", ")),
        };
        let (Some(lower), Some(upper)) = mobility.bounds else {
            return way;
        };
        way.says = bounds_text(lower, Some(upper));
        way.claim = match (self.claim(lower, Some(upper)), mobility.verdict) {
            (_, Verdict::Unassembled) => Claim::Silent,
            // Bounds that meet are no decision while something else is open.
            (Claim::Decides, Verdict::Undecided) => Claim::Bounds,
            (claim, _) => claim,
        };
        if way.claim == Claim::Decides {
            way.certificate = Some(mobility.level);
            way.text = format!("{} certificate; {}", mobility.level.word(), way.text);
        }
        way
    }
}
