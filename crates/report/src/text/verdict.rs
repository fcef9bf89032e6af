//! The first paragraph: the answer, why it is not more, why it is not less, and what it is the answer for.
//!
//! Words with a definition carry its number, so that nobody has to guess what *shaky* or *paradoxical* stands for.

use super::assembly;
use super::cite;
use super::page::Page;
use super::style::Tint;
use super::words::{capitalised, counted, figure, names};
use crate::schema::{Branch, Nominal, Report};
use kutzbach_format::MAY_JOIN;
use kutzbach_mobility::{CertificateLevel, MobilityClass, PoseKind, SingularKind, Verdict};

/// Writes the verdict, its reasons and the line that says what was read.
#[cfg(feature = "html")]
pub(crate) fn write(report: &Report, page: &mut Page) {
    answer(report, page);
    reasons(report, page);
}

/// The verdict, and what is held.
pub(super) fn answer(report: &Report, page: &mut Page) {
    let tint = match report.mobility.verdict {
        Verdict::Mobile => Tint::Good,
        Verdict::Rigid => Tint::Notable,
        Verdict::Undecided => Tint::Doubtful,
        Verdict::Unassembled => Tint::Bad,
    };
    page.paragraph(&sentence(report), tint, "", "");
    if let Some(text) = nominal(report) {
        page.paragraph(&text, Tint::Doubtful, "", "");
    }
    for text in [nearly_idle(report), base(report)].into_iter().flatten() {
        page.paragraph(&text, Tint::Plain, "", "");
    }
}

/// Why it is not more and not less, and what was read.
pub(super) fn reasons(report: &Report, page: &mut Page) {
    for reason in [not_more(report), not_less(report)].into_iter().flatten() {
        page.item(&reason, Tint::Plain);
    }
    let open = report.mobility.verdict == Verdict::Undecided;
    for reason in &report.mobility.why {
        let reason = if open {
            format!("Open: {reason}.")
        } else {
            capitalised(reason)
        };
        page.item(&reason, Tint::Plain);
    }
    page.gap();
    let verbose = page.layout().verbose;
    page.paragraph(&identity(report, verbose), Tint::Plain, "", "");
}

/// The answer in one sentence.
pub(crate) fn sentence(report: &Report) -> String {
    match report.mobility.verdict {
        Verdict::Unassembled => assembly::unassembled(&report.assembly),
        Verdict::Rigid => rigid(report),
        Verdict::Mobile => mobile(report),
        Verdict::Undecided => undecided(report),
    }
}

fn mobile(report: &Report) -> String {
    let mut text = format!("Mobile: {}{}", freedoms(report), shares(report));
    let instantaneous = report.home.instantaneous;
    if instantaneous.is_some() && instantaneous != report.mobility.finite {
        text.push_str(&format!("; {} at this pose", optional(instantaneous)));
    }
    if report.home.pose == Some(PoseKind::Singular) {
        text.push_str(&format!(": {}.", singular(report)));
        return text;
    }
    if report.warnings.iter().any(|w| w.contains(MAY_JOIN)) {
        text.push_str(", by what of the file is read.");
        return text;
    }
    if without_loops(report) {
        text.push_str(&format!(
            ", since there is no loop and every joint is free ({}).",
            cite::FREEDOM
        ));
        return text;
    }
    if let Some(class) = report.mobility.class {
        let why = match class {
            MobilityClass::Trivial if report.home.redundant == Some(0) => "as counting says",
            MobilityClass::Trivial => {
                "as counting says within the displacement subgroup of each loop"
            }
            MobilityClass::Exceptional => "explained by the displacement subgroups of its chains",
            MobilityClass::Paradoxical => "owed to its special dimensions",
        };
        text.push_str(&format!(
            ", {why}{} ({})",
            blocks_of(report, class),
            cite::class(class)
        ));
    }
    text.push('.');
    text
}

/// ` = 6 + 6 idle (rods that spin, D10) + 6 of the floating base`, where some freedoms are idle or nothing is held.
fn shares(report: &Report) -> String {
    let Some(found) = &report.freedoms else {
        return String::new();
    };
    if found.idle + found.floating == 0 {
        return String::new();
    }
    let mut text = format!(" = {}", found.useful);
    if found.idle > 0 {
        let rods = match (found.rods, found.idle) {
            (true, 1) => "a rod that spins, ",
            (true, _) => "rods that spin, ",
            (false, _) => "",
        };
        text.push_str(&format!(" + {} idle ({rods}{})", found.idle, cite::IDLE));
    }
    if found.floating > 0 {
        text.push_str(&format!(" + {} of what floats", found.floating));
    }
    text
}

/// Freedoms that are idle but for a hair.
fn nearly_idle(report: &Report) -> Option<String> {
    let branch = report.branches.as_ref()?.first()?;
    let links: Vec<String> = branch
        .nearly_idle
        .iter()
        .filter_map(|idle| Some(format!("`{}`", idle.links.first()?)))
        .collect();
    let freedom: usize = branch.nearly_idle.iter().map(|idle| idle.freedom).sum();
    (freedom > 0).then(|| {
        format!(
            "{freedom} of the useful {} nearly idle ({}): {} a thousand times as much as anything else.",
            if freedom == 1 { "is" } else { "are" },
            cite::IDLE,
            match links.as_slice() {
                [one] => format!("{one} moves"),
                several => format!("{} move", names(several, 4)),
            }
        )
    })
}

/// What is held, where that is a convention of the file only.
fn base(report: &Report) -> Option<String> {
    let base = report.freedoms.as_ref()?.base.as_ref()?;
    Some(format!("With `{base}` held; 6 more if it floats."))
}

/// The blocks that a class is owed to, where others that move have another.
fn blocks_of(report: &Report, class: MobilityClass) -> String {
    let moving = || {
        report
            .home
            .blocks
            .iter()
            .filter_map(|b| Some((b, b.class?)))
    };
    if moving().all(|(_, other)| other == class) {
        return String::new();
    }
    let labels: Vec<String> = moving()
        .filter(|(_, other)| *other == class)
        .map(|(block, _)| block.label.clone())
        .collect();
    match labels.is_empty() {
        true => String::new(),
        false => format!(" in {}", names(&labels, 3)),
    }
}

/// What happens at a singular pose of a mechanism that moves.
fn singular(report: &Report) -> String {
    let Some(kind) = report.home.kind else {
        return format!(
            "not every one of these can be followed (singular pose, {})",
            cite::REGULAR
        );
    };
    let branches = report.branches.as_deref().unwrap_or_default();
    let many = match branches.len() {
        0 | 1 => "branches".to_owned(),
        2 => "two branches".to_owned(),
        3 => "three branches".to_owned(),
        n => format!("{n} branches"),
    };
    let what = match kind {
        SingularKind::Bifurcation => format!("{many} cross here"),
        SingularKind::Tangential => format!("{many} touch here, with one tangent"),
        SingularKind::Cusp => "the motion stops here and turns back".to_owned(),
        SingularKind::Kinematotropic if branches.len() > 1 => {
            format!("branches of dimensions {} meet here", dimensions(branches))
        }
        SingularKind::Kinematotropic => "branches of different dimensions meet here".to_owned(),
        SingularKind::Shaky => "it gives way in directions that lead nowhere".to_owned(),
        SingularKind::PermanentlyShaky => {
            "it gives way in more directions than it moves, here and all along the motion"
                .to_owned()
        }
    };
    format!("{what} ({})", cite::kind(kind))
}

/// `2, 1 and 1`.
fn dimensions(branches: &[Branch]) -> String {
    let each: Vec<String> = branches.iter().map(|b| b.dimension.to_string()).collect();
    names(&each, 12)
}

fn rigid(report: &Report) -> String {
    if without_loops(report) {
        return format!("Rigid: no joint has any freedom ({}).", cite::FREEDOM);
    }
    let shaky = cite::KIND;
    match report.home.instantaneous {
        Some(1) => format!(
            "Rigid, but shaky ({shaky}): it gives way in 1 direction at this pose, which leads nowhere."
        ),
        Some(many) if many > 1 => format!(
            "Rigid, but shaky ({shaky}): it gives way in {many} directions at this pose, none of which leads anywhere."
        ),
        Some(_) => format!(
            "Rigid: nothing can move, not even for an instant ({}).",
            cite::INSTANTANEOUS
        ),
        None => format!("Rigid: nothing can move ({}).", cite::FINITE),
    }
}

fn undecided(report: &Report) -> String {
    let mut text = format!("Undecided: {} ({})", freedoms(report), cite::FINITE);
    if let Some(instantaneous) = report.home.instantaneous {
        text.push_str(&format!("; {instantaneous} at this pose"));
    }
    if report.home.pose == Some(PoseKind::Singular) {
        text.push_str(&format!(", which is singular ({})", cite::REGULAR));
    }
    text.push('.');
    text
}

/// The nearest mobile mechanism where it is not the one drawn.
fn not_drawn(nominal: &Nominal) -> String {
    let mut text = format!(
        "The nearest mobile mechanism that was found is {} m away",
        figure(nominal.distance.unwrap_or(nominal.tolerance))
    );
    if let Some(change) = nominal.changes.first() {
        text.push_str(&format!(
            " ({}, {}: {} instead of {})",
            change.joint,
            change.number,
            figure(change.to),
            figure(change.from)
        ));
    }
    text.push_str(", beyond what the digits leave open: it is not what is drawn.");
    text
}

/// A mechanism that moves only if its numbers are read as rounded.
pub(super) fn nominal(report: &Report) -> Option<String> {
    let nominal = report.mobility.nominal.as_ref()?;
    if !nominal.within_digits {
        return Some(not_drawn(nominal));
    }
    if let (Some(distance), Some(written)) = (nominal.distance, &report.mobility.as_written) {
        return Some(format!(
            "These numbers round a mechanism that moves ({}): its nearest dimensions differ by up to {} m from them, within their \
             digits; {}, as its loops miss by up to {} m along the motion.",
            cite::NOMINAL,
            figure(distance),
            match (written.verdict, written.finite) {
                (Verdict::Unassembled, _) => "as written it does not close".to_owned(),
                (_, Some(0)) => "as written it binds".to_owned(),
                _ => "as written it binds or moves less".to_owned(),
            },
            figure(nominal.tolerance),
        ));
    }
    let mut text = format!(
        "Mobile within {} m of the numbers written ({}): they are probably rounded",
        figure(nominal.tolerance),
        cite::NOMINAL
    );
    match report.home.as_written {
        Some(0) => text.push_str("; taken literally 0 freedoms: rigid."),
        Some(literal) => text.push_str(&format!(
            "; taken literally at most {}.",
            counted(literal, "freedom")
        )),
        None if report.mobility.finite == Some(nominal.finite) => text.push('.'),
        None => text.push_str(&format!(
            "; what they stand for has {}.",
            counted(nominal.finite, "finite freedom")
        )),
    }
    Some(text)
}

/// Why the finite freedom is not larger.
pub(super) fn not_more(report: &Report) -> Option<String> {
    let mobility = &report.mobility;
    let instantaneous = report.home.instantaneous;
    let text = match (mobility.verdict, mobility.finite) {
        (Verdict::Unassembled, _) => return None,
        (Verdict::Undecided, _) => {
            let most = mobility.bounds[1]?;
            let definition = match report.home.pose {
                Some(PoseKind::Singular) => cite::REGULAR,
                _ => cite::INSTANTANEOUS,
            };
            match instantaneous {
                Some(freedom) if most < freedom => format!(
                    "Not more than {most}: of the {} at this pose not all can be followed, because the pose is singular \
                     ({definition}).",
                    counted(freedom, "freedom")
                ),
                _ => format!(
                    "Not more than {most}: the closure equations at this pose and the joints by themselves leave no more, \
                     and no motion has more freedoms than its poses ({definition})."
                ),
            }
        }
        _ if without_loops(report) => return None,
        (Verdict::Rigid, _) => format!("Why not more: {}.", proof(report)?),
        (Verdict::Mobile, finite) => match (finite, instantaneous) {
            (Some(finite), Some(at_pose)) if finite < at_pose => {
                let mut text = match report.home.kind {
                    Some(SingularKind::PermanentlyShaky) => format!(
                        "Why not more: the pose is singular ({}): {} of its {} lead nowhere, here and at \
                         every pose of the motion",
                        cite::REGULAR,
                        at_pose - finite,
                        counted(at_pose, "freedom")
                    ),
                    _ => format!(
                        "Why not more: the pose is singular ({}): its {} exist together to first order only, and no branch \
                         through it has more than {} ({})",
                        cite::REGULAR,
                        counted(at_pose, "freedom"),
                        finite,
                        cite::BRANCH
                    ),
                };
                if mobility.complex_dimension == Some(finite) {
                    text.push_str(&format!(
                        "; over the complex numbers the dimension is {finite} too ({})",
                        cite::EVIDENCE
                    ));
                }
                text.push('.');
                text
            }
            (Some(_), Some(at_pose)) => format!(
                "Why not more: the rank of the closure equations leaves {} at this pose, and no motion has more freedoms \
                 than its poses ({}).",
                counted(at_pose, "freedom"),
                cite::INSTANTANEOUS
            ),
            _ => return None,
        },
    };
    Some(text)
}

/// Why the finite freedom is not smaller.
pub(super) fn not_less(report: &Report) -> Option<String> {
    let mobility = &report.mobility;
    match mobility.verdict {
        Verdict::Mobile => Some(format!("Why not less: {}.", proof(report)?)),
        Verdict::Undecided => Some(match mobility.bounds[0]? {
            0 => format!(
                "Not less than 0: no motion has been proved ({}).",
                cite::CERTIFICATE
            ),
            least => format!(
                "Not less than {least}: so many remain by the joints outside loops, the blocks that are decided and the \
                 displacement subgroups of the others ({}).",
                cite::CERTIFICATE
            ),
        }),
        // Nothing has fewer freedoms than none.
        Verdict::Rigid | Verdict::Unassembled => None,
    }
}

/// What the answer rests on, with its strength.
fn proof(report: &Report) -> Option<String> {
    let certificate = report.mobility.certificate.as_ref()?;
    let strength = match certificate.level {
        CertificateLevel::Numeric => "computed with a margin",
        CertificateLevel::Subgroup => "proved by displacement subgroups",
        CertificateLevel::Exact => "proved in exact arithmetic",
    };
    Some(format!(
        "{strength} ({}): {}",
        cite::level(certificate.level),
        certificate.text.trim_end_matches('.')
    ))
}

pub(super) fn without_loops(report: &Report) -> bool {
    report.size.loops == 0 && report.size.couplings == 0
}

/// The finite mobility, or what is known of it.
fn freedoms(report: &Report) -> String {
    let finite = |n| counted(n, "finite freedom");
    match (report.mobility.finite, report.mobility.bounds) {
        (Some(n), _) => finite(n),
        (None, [Some(least), Some(most)]) if least == most => {
            format!("{}, as far as is known", finite(least))
        }
        (None, [Some(least), Some(most)]) => {
            format!("between {least} and {}", finite(most))
        }
        (None, [Some(least), None]) => format!("at least {}", finite(least)),
        (None, [None, Some(most)]) => format!("at most {}", finite(most)),
        (None, [None, None]) => "nothing is known of its finite freedoms yet".to_owned(),
    }
}

fn optional(count: Option<usize>) -> String {
    count.map_or_else(|| "?".to_owned(), |n| n.to_string())
}

fn identity(report: &Report, verbose: bool) -> String {
    let size = &report.size;
    let mut parts = vec![
        counted(size.links, "link"),
        counted(size.joints, "joint"),
        counted(size.loops, "independent loop"),
    ];
    if size.couplings > 0 {
        parts.push(counted(size.couplings, "coupling"));
    }
    let source = &report.source;
    let numbers = match (source.exact, source.digits) {
        (true, _) => "numbers taken as exact".to_owned(),
        (false, _) if source.precision.is_some() => format!(
            "numbers known to {:e} m or rad, as said by hand",
            source.precision.unwrap_or_default()
        ),
        (false, Some(digits)) => format!(
            "numbers stated to {}",
            counted(usize::try_from(digits).unwrap_or(0), "decimal")
        ),
        (false, None) => "numbers rounded".to_owned(),
    };
    let constants = report.source.constants.as_ref();
    format!(
        "{} ({}): {}; {numbers}.{}",
        report.mechanism,
        report.source.file,
        names(&parts, parts.len()),
        constants
            .map(|constants| super::constants::sentence(constants, verbose))
            .unwrap_or_default()
    )
}

#[cfg(test)]
#[path = "verdict_tests.rs"]
mod tests;
