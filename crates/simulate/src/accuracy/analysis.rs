//! The ways to know how a mechanism can move, each by itself, and then all of them as a user asks them.

use super::all_engines::WAITED_FOR;
use super::clock::Patience;
use super::result::{Claim, Way, WayTiming};
use kutzbach_closure::{Arithmetic, Geometry, Part};
use kutzbach_math::matrix::MatrixError;
use kutzbach_mobility::{
    Analysis, AnalysisOptions, MoreDigits, OneEngine, PartRank, Pose, Structure, Trial,
    chart_alone, exact_alone, generic_count, germ_alone, kernel_of, kutzbach_count, rank_alone,
    subgroups_alone,
};
use kutzbach_model::mechanism::{Configuration, Mechanism};
use std::collections::BTreeSet;
use std::hint::black_box;

/// The arithmetic that ranks and chart tests are asked in: doubles, and the first two rungs beyond.
const BITS: [u32; 3] = [53, 106, 212];

/// The orders after which power series are cut off.
const ORDERS: [usize; 5] = [2, 3, 4, 6, 8];

/// What is asked, ready.
pub(super) struct Subject<'a> {
    pub mechanism: &'a Mechanism,
    pub configuration: Option<&'a Configuration>,
    pub geometry: &'a Geometry<f64>,
    pub analysis: &'a Analysis,
    pub options: &'a AnalysisOptions,
    pub patience: Patience,
}

impl Subject<'_> {
    /// Freedoms of what no loop constrains.
    fn base(&self) -> usize {
        let structure = &self.analysis.structure;
        let joints = self.mechanism.joints();
        let free = structure.free_joints.iter().map(|&j| joints[j].freedom());
        free.sum::<usize>() + 6 * structure.loose_pieces
    }

    fn finite(&self) -> Option<usize> {
        self.analysis.mobility.finite()
    }

    /// Asks every way, in turn; `watch` is told the share done, and stops it.
    pub fn ways(
        &self,
        mut watch: impl FnMut(f64) -> bool,
    ) -> Result<(Vec<Way>, bool), MatrixError> {
        let mut ways = Vec::new();
        let mut held = BTreeSet::new();
        if let Some(configuration) = self.configuration {
            held.extend(configuration.held().map(|joint| joint.0));
        }
        let pose = Pose {
            mechanism: self.mechanism,
            configuration: self.configuration,
            held: &held,
            geometry: self.geometry,
            states: &self.analysis.assembly.states,
            as_drawn: self.analysis.assembly.steps == 0,
            trial: Trial::default(),
        };
        self.counts(&mut ways)?;
        let closed = self.analysis.assembly.closed;
        let mut asked: Vec<Question> = Vec::new();
        if closed {
            asked.extend(BITS.map(Question::Rank));
            asked.push(Question::Subgroups);
            asked.extend(BITS.map(Question::Chart));
            asked.extend(ORDERS.map(Question::Germ));
            asked.push(Question::Exact);
        }
        let total = (asked.len() + WAITED_FOR.len()) as f64;
        let alone = asked.len();
        for (index, question) in asked.into_iter().enumerate() {
            if watch(index as f64 / total) {
                return Ok((ways, true));
            }
            ways.push(self.way(&pose, question)?);
        }
        for (index, (name, depth)) in WAITED_FOR.into_iter().enumerate() {
            if watch((alone + index) as f64 / total) {
                return Ok((ways, true));
            }
            ways.push(self.all_engines(name, depth));
        }
        Ok((ways, false))
    }

    fn counts(&self, ways: &mut Vec<Way>) -> Result<(), MatrixError> {
        let structure = &self.analysis.structure;
        let (number, timing) = self
            .patience
            .time(|| kutzbach_count(black_box(self.mechanism)));
        ways.push(self.number("count", "Kutzbach", number, timing));
        let (count, timing) = self.patience.time(|| {
            let structure = Structure::new(black_box(self.mechanism));
            generic_count(self.mechanism, &structure)
        });
        debug_assert_eq!(structure.parts.len(), self.analysis.structure.parts.len());
        ways.push(self.number("generic rank", "modulo 2⁶¹ − 1", count?.mobility, timing));
        Ok(())
    }

    fn number(&self, name: &str, precision: &str, number: i64, timing: WayTiming) -> Way {
        let claim = match self.finite() {
            Some(finite) if number == finite as i64 => Claim::Equal,
            Some(_) => Claim::Wrong,
            None => Claim::Open,
        };
        let text = match name {
            "count" => "counts joints and links, and knows no dimensions",
            _ => "the same joints and links at dimensions drawn at random",
        };
        Way {
            name: name.to_owned(),
            precision: precision.to_owned(),
            says: number.to_string(),
            claim,
            decades: None,
            certificate: None,
            text: text.to_owned(),
            timing,
        }
    }

    fn way(&self, pose: &Pose<'_>, question: Question) -> Result<Way, MatrixError> {
        let parts = &self.analysis.structure.parts;
        let (answers, timing) = self.patience.time(|| {
            // Evaluated anew, and shared by the parts of one run.
            let mut more = MoreDigits::new();
            let ranks = self.analysis.parts.iter();
            parts
                .iter()
                .zip(ranks)
                .map(|(part, rank)| self.ask(pose, &mut more, part, rank, question))
                .collect::<Result<Vec<OneEngine>, MatrixError>>()
        });
        let answers = answers?;
        let base = self.base();
        let lower = base + answers.iter().map(|a| a.lower).sum::<usize>();
        let upper = answers
            .iter()
            .map(|a| a.upper)
            .sum::<Option<usize>>()
            .map(|upper| upper + base);
        let margin = answers.iter().filter_map(|a| a.margin).reduce(f64::min);
        // The part that says least, or hangs on least.
        let weight = |a: &OneEngine| (a.upper.is_some(), a.margin.unwrap_or(f64::INFINITY));
        let text = answers
            .iter()
            .filter(|answer| answer.asked)
            .min_by(|a, b| {
                let (a, b) = (weight(a), weight(b));
                a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
            })
            .or(answers.first())
            .map_or_else(|| "nothing is constrained".to_owned(), |a| a.text.clone());
        let (name, precision) = question.words();
        if !answers.is_empty() && answers.iter().all(|answer| !answer.asked) {
            return Ok(Way {
                name: name.to_owned(),
                precision,
                says: String::new(),
                claim: Claim::Silent,
                decades: None,
                certificate: None,
                text,
                timing: WayTiming::default(),
            });
        }
        Ok(Way {
            name: name.to_owned(),
            precision,
            says: bounds_text(lower, upper),
            claim: self.claim(lower, upper),
            decades: margin.filter(|m| *m > 0.0).map(f64::log10),
            certificate: None,
            text,
            timing,
        })
    }

    /// What bounds are worth.
    pub(super) fn claim(&self, lower: usize, upper: Option<usize>) -> Claim {
        let Some(upper) = upper else {
            return Claim::Silent;
        };
        match self.finite() {
            Some(finite) if finite < lower || finite > upper => Claim::Wrong,
            _ if lower == upper => Claim::Decides,
            _ => Claim::Bounds,
        }
    }

    fn ask(
        &self,
        pose: &Pose<'_>,
        more: &mut MoreDigits,
        part: &Part,
        rank: &PartRank,
        question: Question,
    ) -> Result<OneEngine, MatrixError> {
        match question {
            Question::Rank(53) => {
                // More digits begin with the numbers of the file; so that times compare, doubles do too.
                let geometry =
                    Geometry::new(pose.mechanism, pose.configuration, &Arithmetic::double());
                black_box(&geometry);
                rank_alone(pose, more, part, 53)
            }
            Question::Rank(bits) => rank_alone(pose, more, part, bits),
            Question::Subgroups => subgroups_alone(pose, &self.analysis.structure, part, rank),
            Question::Chart(bits) => {
                let kernel = kernel_of(pose, rank)?;
                chart_alone(pose, more, part, rank, kernel.as_ref(), bits)
            }
            Question::Germ(order) => {
                let kernel = kernel_of(pose, rank)?;
                germ_alone(pose, part, rank, kernel.as_ref(), order)
            }
            Question::Exact => Ok(exact_alone(pose, part, rank, self.options.exact)),
        }
    }
}

/// One way with its precision.
#[derive(Clone, Copy)]
enum Question {
    Rank(u32),
    Subgroups,
    Chart(u32),
    Germ(usize),
    Exact,
}

impl Question {
    fn words(self) -> (&'static str, String) {
        match self {
            Self::Rank(bits) => ("rank", format!("{bits} bits")),
            Self::Subgroups => ("subgroups", String::new()),
            Self::Chart(bits) => ("chart test", format!("{bits} bits")),
            Self::Germ(order) => ("germ", format!("to order {order}")),
            Self::Exact => ("exact algebra", "exact".to_owned()),
        }
    }
}

/// Bounds on the freedom, as short as they can be said; empty where there is none from above.
pub(super) fn bounds_text(lower: usize, upper: Option<usize>) -> String {
    match upper {
        None => String::new(),
        Some(upper) if upper == lower => upper.to_string(),
        Some(upper) if lower == 0 => format!("at most {upper}"),
        Some(upper) => format!("{lower} to {upper}"),
    }
}
