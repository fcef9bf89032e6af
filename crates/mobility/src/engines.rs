//! The engines, in the order in which they are asked: one table, and the loop through it.
//!
//! An engine is asked where it may tell something that is not known; what it says is a [`Claim`](super::claim::Claim), which the judge
//! holds against all others. A new engine is a file and a row.

use super::depth::Depth;
use super::exact::ask_exact;
use super::judge::PartFinding;
use super::loops_at_rest::{with_a_loop_that_does_not_start, with_loops_at_rest};
use super::more_digits::MoreDigits;
use super::options::AnalysisError;
use super::part_mobility::{by_chart, by_closed_form, by_independence, by_rank, by_subgroups};
use super::pose_rank::{PartRank, Pose};
use super::question::{Means, OfWhole, Question};
use super::singular::{
    arrangement, complex_bound, form, is_multiple, one_variable, polygon, search, splitting,
    splitting_beyond_doubles, variables,
};
use super::vocabulary::{EngineName, PoseKind};
use kutzbach_closure::{Part, Structure};

/// One engine.
struct Engine {
    /// By what name it claims.
    name: EngineName,
    /// Why it is asked, and why here.
    because: &'static str,
    may_tell: fn(&Question<'_>, &PartFinding) -> Result<bool, AnalysisError>,
    ask: fn(&Question<'_>, &mut Means<'_>, &mut PartFinding) -> Result<(), AnalysisError>,
}

/// All of them.
static ENGINES: [Engine; 17] = [
    Engine {
        name: EngineName::Rank,
        because: "done already; no motion has more freedoms than velocities, and what it leaves open no other tells",
        may_tell: |_, _| Ok(true),
        ask: by_rank,
    },
    Engine {
        name: EngineName::ClosedForm,
        because: "loops of hinges in a plane or about a point: a count, by the places of the axes alone",
        may_tell: |_, _| Ok(true),
        ask: by_closed_form,
    },
    Engine {
        name: EngineName::Subgroup,
        because: "a few brackets a cycle, and true at every pose: it explains, which others do not",
        may_tell: |question, _| Ok(question.freedom.get().is_some_and(|freedom| freedom > 0)),
        ask: by_subgroups,
    },
    Engine {
        name: EngineName::Rank,
        because: "independent equations leave a manifold, where subgroups were not looked for",
        may_tell: |question, found| Ok(is_open(found) && question.is_independent()),
        ask: by_independence,
    },
    Engine {
        name: EngineName::LoopsAtRest,
        because: "a loop that does not start at all, and gives way by itself: what it stops looks regular in any number of digits",
        may_tell: |question, found| Ok(is_open(found) && question.freedom.get().is_some()),
        ask: loops_that_do_not_start,
    },
    Engine {
        name: EngineName::Chart,
        because: "some dozen closures tell regular poses from singular ones",
        may_tell: |question, found| Ok(is_open(found) && question.freedom.get().is_some()),
        ask: by_chart,
    },
    Engine {
        name: EngineName::Chart,
        because: "one equation in one variable needs no power series",
        may_tell: |question, found| Ok(is_singular(found) && variables(question)? == Some(1)),
        ask: one_variable,
    },
    Engine {
        name: EngineName::SplittingLemma,
        because: "numbers of many digits may make quadratic terms that doubles do not see, and a search in doubles is confident without them",
        may_tell: |question, found| Ok(in_space(question, found)? && question.is_tall()),
        ask: splitting_beyond_doubles,
    },
    Engine {
        name: EngineName::Germ,
        because: "real zeros of power series, of which each is closed on all equations: general, and in doubles",
        may_tell: |question, found| Ok(is_singular(found) && variables(question)?.is_some()),
        ask: search,
    },
    Engine {
        name: EngineName::NewtonPolygon,
        because: "in the plane, many digits tell apart what doubles take for multiple",
        may_tell: |question, found| {
            let unsure = is_singular(found) || is_multiple(found);
            Ok(unsure && !question.is_rounded()? && variables(question)? == Some(2))
        },
        ask: polygon,
    },
    Engine {
        name: EngineName::SplittingLemma,
        because: "what doubles take for multiple in more variables",
        may_tell: |question, found| Ok(is_multiple(found) && !question.is_rounded()?),
        ask: splitting,
    },
    Engine {
        name: EngineName::SecondOrder,
        because: "one quadratic form of full rank is a cone, however many variables there are",
        may_tell: in_space,
        ask: form,
    },
    Engine {
        name: EngineName::SecondOrder,
        because: "quadratic forms that vanish on linear spaces only, each of them a branch",
        may_tell: in_space,
        ask: arrangement,
    },
    Engine {
        name: EngineName::SplittingLemma,
        because: "one equation whose quadratic terms are not of full rank, in many digits",
        may_tell: in_space,
        ask: splitting,
    },
    Engine {
        name: EngineName::LoopsAtRest,
        because: "asks all engines again, of every loop: where nothing else tells",
        may_tell: |_, found| Ok(is_singular(found)),
        ask: loops_at_rest,
    },
    Engine {
        name: EngineName::Germ,
        because: "the dimension of complex solutions bounds what no engine tells",
        may_tell: |_, found| Ok(is_singular(found)),
        ask: complex_bound,
    },
    Engine {
        name: EngineName::Exact,
        because: "proves, at a price that is known beforehand: last, of what is open or numeric",
        may_tell: |_, _| Ok(true),
        ask: exact,
    },
];

/// The engines in the order in which they are asked, and why each is asked where it is.
pub fn engines() -> impl Iterator<Item = (EngineName, &'static str)> {
    ENGINES.iter().map(|engine| (engine.name, engine.because))
}

/// Asks the engines about one part, but for those that ask others again or have a budget. Below [`Depth::Motions`] the branch of a
/// regular pose comes without poses on it.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub fn part_mobility(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    part: &Part,
    rank: &PartRank,
    depth: Depth,
) -> Result<PartFinding, AnalysisError> {
    let question = Question::new(pose, structure, (part, rank), depth);
    ask_all(&question, &mut Means { more, whole: None })
}

/// Asks all engines that may tell something about a part.
///
/// # Errors
/// [`AnalysisError`] where numbers overflow.
pub(super) fn ask_all(
    question: &Question<'_>,
    means: &mut Means<'_>,
) -> Result<PartFinding, AnalysisError> {
    let mut found = PartFinding::new(question.rank.unknowns());
    ask(&ENGINES, question, means, &mut found)?;
    Ok(found)
}

fn ask(
    engines: &[Engine],
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    for engine in engines {
        if (engine.may_tell)(question, found)? {
            (engine.ask)(question, means, found)?;
        }
    }
    Ok(())
}

/// Asks the engines that come after the chart test.
#[cfg(test)]
pub(super) fn ask_after_chart(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    let chart = ENGINES.iter().position(|e| e.name == EngineName::Chart);
    ask(
        &ENGINES[chart.map_or(0, |chart| chart + 1)..],
        question,
        means,
        found,
    )
}

fn loops_that_do_not_start(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    match &means.whole {
        Some(OfWhole { options, again, .. }) => with_a_loop_that_does_not_start(
            question.pose,
            means.more,
            question.structure,
            (question.part, question.rank),
            (*options, *again),
            found,
        ),
        None => Ok(()),
    }
}

fn loops_at_rest(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    let Question {
        pose,
        structure,
        part,
        rank,
        ..
    } = *question;
    match &means.whole {
        Some(OfWhole { options, again, .. }) => {
            let asked = (*options, *again);
            with_loops_at_rest(pose, means.more, structure, (part, rank), asked, found)
        }
        None => Ok(()),
    }
}

fn exact(
    question: &Question<'_>,
    means: &mut Means<'_>,
    found: &mut PartFinding,
) -> Result<(), AnalysisError> {
    let wanted = found.open().is_some() || question.depth == Depth::Everything;
    if let Some(OfWhole { allowance, .. }) = means.whole.as_mut().filter(|_| wanted) {
        ask_exact(
            question.pose,
            question.part,
            question.rank,
            found,
            allowance,
        );
    }
    Ok(())
}

fn is_open(found: &PartFinding) -> bool {
    found.open().is_some() && found.contradictions().is_empty()
}

fn is_singular(found: &PartFinding) -> bool {
    is_open(found) && found.pose() == Some(PoseKind::Singular)
}

/// A singular pose with more variables than a plane has.
fn in_space(question: &Question<'_>, found: &PartFinding) -> Result<bool, AnalysisError> {
    let many = || Ok::<_, AnalysisError>(variables(question)?.is_some_and(|count| count > 2));
    Ok(is_singular(found) && many()? && !question.is_rounded()?)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::fmt::Write;

    #[test]
    fn the_documentation_gives_the_order_of_the_engines() {
        let mut table = String::from("| engine | asked because |\n|---|---|\n");
        for (name, because) in engines() {
            let _ = writeln!(table, "| {name} | {because} |");
        }
        let page = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/src/mobility.md");
        let text = std::fs::read_to_string(page).unwrap();
        assert!(
            text.contains(&table),
            "docs/src/mobility.md has not:\n{table}"
        );
    }
}
