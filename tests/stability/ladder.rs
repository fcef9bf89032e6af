//! A ladder: members of a family on a logarithmic scale, what is true of each, and what the analysis makes of it.

use super::support::in_parallel;
use kutzbach::families::{Outcome, Truth};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, PoseKind, Verdict, analyse};

/// What is true of a member.
#[derive(Clone, Copy, Debug)]
pub enum Known {
    /// It closes, and moves like this.
    Moves(Truth),
    /// What was meant by its rounded numbers moves like this. Numbers too coarse to tell are taken literally, and the
    /// instantaneous freedom told then comes with a note and the other candidates: that is no statement about what was meant.
    IsMeant(Truth),
    /// No pose of it closes.
    NeverCloses,
}

/// A regular pose of so many freedoms, finite ones.
pub fn regular(freedom: usize) -> Known {
    Known::Moves(Truth {
        finite: freedom,
        instantaneous: freedom,
        pose: PoseKind::Regular,
        branches: usize::from(freedom > 0),
    })
}

/// A singular pose.
pub fn singular(finite: usize, instantaneous: usize, branches: usize) -> Known {
    Known::Moves(Truth {
        finite,
        instantaneous,
        pose: PoseKind::Singular,
        branches,
    })
}

/// A member of a family.
pub struct Rung {
    /// The parameter, as a person would write it.
    pub label: String,
    /// Its decimal logarithm; `None` where it is zero.
    pub decades: Option<f64>,
    pub mechanism: Mechanism,
    /// The pose asked about, if it is not the home pose.
    pub configuration: Option<String>,
    pub known: Known,
}

impl Rung {
    /// At `10^exponent`.
    pub fn at(exponent: i32, mechanism: Mechanism, known: Known) -> Self {
        Self {
            label: format!("1e{exponent}"),
            decades: Some(f64::from(exponent)),
            mechanism,
            configuration: None,
            known,
        }
    }

    /// Where the parameter vanishes.
    pub fn limit(mechanism: Mechanism, known: Known) -> Self {
        Self {
            label: "0".to_owned(),
            decades: None,
            mechanism,
            configuration: None,
            known,
        }
    }
}

/// How the smallest singular value kept follows the parameter, as long as a rank is decided.
#[derive(Clone, Copy)]
pub struct Law {
    /// Its decimal logarithm for that of the parameter, up to a constant.
    pub decades: fn(f64) -> f64,
    /// By what factor it may differ from that, in either direction.
    pub within: f64,
    /// Whether it may also be any larger.
    pub at_least: bool,
    /// Up to how many decades of the parameter, to either side, it holds.
    pub up_to: f64,
}

impl Law {
    pub fn new(within: f64, decades: fn(f64) -> f64) -> Self {
        Self {
            decades,
            within,
            at_least: false,
            up_to: f64::INFINITY,
        }
    }

    pub fn at_least(self) -> Self {
        Self {
            at_least: true,
            ..self
        }
    }

    pub fn up_to(self, up_to: f64) -> Self {
        Self { up_to, ..self }
    }
}

/// A family, its members from tame to extreme.
pub struct Ladder {
    pub name: &'static str,
    /// What the parameter is, with its unit.
    pub parameter: &'static str,
    /// How the smallest singular value kept goes, where that is derived.
    pub law: Option<Law>,
    pub rungs: Vec<Rung>,
}

/// What the analysis makes of a member.
pub struct Seen {
    pub label: String,
    pub decades: Option<f64>,
    pub outcome: Outcome,
    pub verdict: Verdict,
    /// Why it is left open.
    pub why: Option<String>,
    /// Whether a rank was decided in every part.
    pub ranked: bool,
    /// Smallest singular value kept of any part, relative to the largest.
    pub kept: f64,
    /// What counts as zero beside it.
    pub tolerance: f64,
    /// Most bits that the rank of any part was decided with.
    pub rank_bits: u32,
    /// Most bits that any engine used.
    pub bits: u32,
    /// Steps of the assembly.
    pub steps: usize,
    /// Whether the verdict is said to hold within the stated precision only.
    pub nominal: bool,
    /// Whether that no mechanism within the digits moves was found from the nearest one that does, and not from a rank.
    pub excluded: bool,
}

impl Seen {
    /// Decades between the smallest singular value kept and the least one that would be accepted.
    pub fn margin(&self) -> f64 {
        (self.kept / self.tolerance).log10() - 1.0
    }
}

/// A family with what was seen of it.
pub struct Climbed {
    pub name: &'static str,
    pub parameter: &'static str,
    pub law: Option<Law>,
    pub seen: Vec<Seen>,
}

/// Climbs ladders, on two threads.
pub fn climb(ladders: &[Ladder]) -> Vec<Climbed> {
    let rungs: Vec<(usize, &Rung)> = ladders
        .iter()
        .enumerate()
        .flat_map(|(index, ladder)| ladder.rungs.iter().map(move |rung| (index, rung)))
        .collect();
    let seen = in_parallel(&rungs, |(index, rung)| (*index, look(rung)));
    let mut climbed: Vec<Climbed> = ladders
        .iter()
        .map(|ladder| Climbed {
            name: ladder.name,
            parameter: ladder.parameter,
            law: ladder.law,
            seen: Vec::new(),
        })
        .collect();
    for (index, seen) in seen {
        climbed[index].seen.push(seen);
    }
    climbed
}

/// Analyses a member.
fn look(rung: &Rung) -> Seen {
    let options = AnalysisOptions {
        configuration: rung.configuration.clone(),
        ..AnalysisOptions::default()
    };
    let analysis = analyse(&rung.mechanism, &options)
        .unwrap_or_else(|error| panic!("{} at {}: {error}", rung.mechanism.name(), rung.label));
    let decisions = || analysis.parts.iter().map(|part| &part.decision);
    // The part with the thinnest margin.
    let thinnest = decisions().min_by(|a, b| {
        let share = |d: &kutzbach::matrix::RankDecision| d.kept / d.tolerance;
        share(a).total_cmp(&share(b))
    });
    Seen {
        label: rung.label.clone(),
        decades: rung.decades,
        outcome: outcome(rung.known, &analysis),
        verdict: analysis.mobility.verdict,
        why: analysis.mobility.why.first().cloned(),
        ranked: !analysis.parts.is_empty()
            && analysis.parts.iter().all(|p| p.instantaneous.is_some()),
        kept: thinnest.map_or(1.0, |d| d.kept),
        tolerance: thinnest.map_or(0.0, |d| d.tolerance),
        rank_bits: analysis.parts.iter().map(|p| p.bits).max().unwrap_or(53),
        bits: most_bits(&analysis),
        steps: analysis.assembly.steps,
        nominal: analysis
            .mobility
            .nominal
            .as_ref()
            .is_some_and(|n| n.within_digits),
        excluded: analysis
            .mobility
            .nominal
            .as_ref()
            .is_some_and(|n| !n.within_digits),
    }
}

fn outcome(known: Known, analysis: &Analysis) -> Outcome {
    match known {
        Known::Moves(truth) => truth.outcome(analysis),
        Known::IsMeant(truth) => {
            let mut told = analysis.clone();
            let noted = analysis.parts.iter().any(|part| part.note.is_some());
            if let Some(home) = told.home.as_mut().filter(|_| noted) {
                home.instantaneous = None;
            }
            truth.outcome(&told)
        }
        Known::NeverCloses => match analysis.mobility.verdict {
            Verdict::Unassembled => Outcome::Right,
            Verdict::Undecided => Outcome::Undecided,
            other => Outcome::Wrong(vec![format!("{other}, though no pose closes")]),
        },
    }
}

/// The engines tell the bits they used in words: `…; 106 bits; …`.
fn most_bits(analysis: &Analysis) -> u32 {
    let texts = analysis.claims().map(|(_, claim)| &claim.text);
    let told = texts.flat_map(|text| {
        let before = text.match_indices(" bits").map(|(at, _)| &text[..at]);
        before
            .filter_map(|text| text.rsplit(' ').next()?.parse::<u32>().ok())
            .collect::<Vec<_>>()
    });
    let ranks = analysis.parts.iter().map(|part| part.bits);
    told.chain(ranks).max().unwrap_or(53)
}
