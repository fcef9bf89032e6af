//! What a report holds only where it was asked for: the motions of named pairs of links, and what every engine found.

use super::asked::ReportError;
use super::definitions::closest;
use super::motions::motion_row;
use super::schema::{Evidence, Motion, Report, Warning, WarningKind};
use kutzbach_mobility::{Analysis, relative_motions};
use kutzbach_model::mechanism::Mechanism;

/// The links of these names, as indices; each pair once.
///
/// # Errors
/// [`ReportError::UnknownLink`] for a name that no link has.
pub(super) fn pairs(
    mechanism: &Mechanism,
    names: &[(String, String)],
) -> Result<Vec<(usize, usize)>, ReportError> {
    let index = |name: &str| {
        mechanism
            .link_named(name)
            .map(|link| link.0)
            .ok_or_else(|| ReportError::UnknownLink {
                name: name.to_owned(),
                mechanism: mechanism.name().to_owned(),
                nearest: closest(name, mechanism.links().iter().map(|l| l.name.as_str()))
                    .map(str::to_owned),
            })
    };
    let mut pairs = Vec::new();
    for (link, relative_to) in names {
        let pair = (index(link)?, index(relative_to)?);
        if !pairs.contains(&pair) {
            pairs.push(pair);
        }
    }
    Ok(pairs)
}

/// Puts the motions of these pairs on every branch before the others, or says why there are none.
pub(super) fn ask_between(
    report: &mut Report,
    mechanism: &Mechanism,
    analysis: &Analysis,
    pairs: &[(usize, usize)],
) {
    if pairs.is_empty() {
        return;
    }
    let link = |index: usize| mechanism.links()[index].name.as_str();
    let mut asked: Vec<Motion> = Vec::new();
    let mut unanswered = Vec::new();
    let answers: Vec<_> = analysis
        .branches
        .iter()
        .flatten()
        .map(|branch| {
            relative_motions(
                mechanism,
                &analysis.geometry,
                &analysis.structure,
                &branch.poses,
                pairs,
            )
        })
        .collect();
    for &(a, b) in pairs {
        let question = format!("how `{}` moves seen from `{}`", link(a), link(b));
        match &analysis.branches {
            None => unanswered.push(format!(
                "{question} is not known, because the branches through this pose are not"
            )),
            Some(branches) if branches.is_empty() => unanswered.push(format!(
                "`{}` does not move seen from `{}`: no motion passes through this pose",
                link(a),
                link(b)
            )),
            Some(branches) => {
                for (branch, motions) in branches.iter().zip(&answers) {
                    let known = motions.iter().find(|m| (m.link, m.relative_to) == (a, b));
                    asked.extend(known.map(|motion| Motion {
                        asked: true,
                        ..motion_row(mechanism, &branch.name, motion)
                    }));
                }
            }
        }
    }
    let already = |row: &Motion| {
        asked
            .iter()
            .any(|a| (&a.link, &a.relative_to) == (&row.link, &row.relative_to))
    };
    report.motions.retain(|row| !already(row));
    report.motions.splice(0..0, asked);
    let unanswered = unanswered.into_iter();
    let warnings = unanswered.map(|text| Warning::new(WarningKind::Unanswered, text));
    report.warnings.extend(warnings);
}

/// What every engine found, block by block, in the order they were asked.
pub(super) fn evidence(report: &Report, analysis: &Analysis) -> Vec<Evidence> {
    analysis
        .claims()
        .map(|(part, found)| Evidence {
            block: report
                .home
                .blocks
                .get(part)
                .map_or_else(String::new, |block| block.name.clone()),
            engine: found.engine.word().to_owned(),
            scope: found.scope.word().to_owned(),
            bounds: [Some(found.finite.lower), found.finite.upper],
            text: found.text.clone(),
        })
        .collect()
}
