//! The first paragraph: the answer, why it is not more, why it is not less, and what it is the answer for.
//!
//! Words with a definition carry its number, so that nobody has to guess what *shaky* or *paradoxical* stands for.

use super::assembly;
use super::cite;
use super::page::Page;
use super::style::Tint;
use super::words::{capitalised, counted, degrees, figure, metres, names};
use crate::schema::{
    Advice, AsWritten, Branch, Nominal, Report, WarningKind, WrittenKind, WrittenStyle,
};
use kutzbach_mobility::{CertificateLevel, MobilityClass, PoseKind, SingularKind, Verdict};

/// The verdict, and what is held.
pub(crate) fn answer(report: &Report, page: &mut Page) {
    let tint = match report.mobility.verdict {
        Verdict::Mobile => Tint::Good,
        Verdict::Rigid => Tint::Notable,
        Verdict::Undecided => Tint::Doubtful,
        Verdict::Unassembled => Tint::Bad,
    };
    page.paragraph(&sentence(report), tint, "", "");
    // Of a gap that rounding explains, the distance to numbers that move says more.
    let explained = report.mobility.nominal.as_ref().is_some_and(|nominal| {
        nominal.noise || nominal.within_digits && nominal.distance.is_some()
    });
    let asked = report.assembly.tolerance_asked;
    if let Some(text) = assembly::left_open(&report.assembly).filter(|_| asked || !explained) {
        page.paragraph(&text, Tint::Doubtful, "", "");
    }
    if let Some(text) = nominal(report) {
        page.paragraph(&text, Tint::Doubtful, "", "");
    }
    if let Some(text) = redundant(report) {
        page.paragraph(&text, Tint::Plain, "", "");
    }
    for text in [nearly_idle(report), base(report)].into_iter().flatten() {
        page.paragraph(&text, Tint::Plain, "", "");
    }
}

/// Why it is not more and not less: in a line each, with proofs where everything is asked for.
pub(crate) fn reasons(report: &Report, page: &mut Page) {
    let verbose = page.layout().verbose;
    let open = report.mobility.verdict == Verdict::Undecided;
    for reason in [not_more(report, verbose), not_less(report, verbose)]
        .into_iter()
        .flatten()
    {
        page.item(&reason, Tint::Plain);
    }
    for reason in report.mobility.why.iter().filter(|_| open || verbose) {
        let reason = if open {
            format!("Open: {reason}.")
        } else {
            capitalised(reason)
        };
        page.item(&reason, Tint::Plain);
    }
}

/// What was read.
pub(crate) fn source(report: &Report, page: &mut Page) {
    page.gap();
    let verbose = page.layout().verbose;
    page.paragraph(&identity(report, verbose), Tint::Quiet, "", "");
}

/// Where to go on from here: the details, the motion, and the word most likely to be new.
pub(super) fn further(report: &Report, page: &mut Page) {
    if page.layout().verbose {
        return;
    }
    let mobility = &report.mobility;
    let word = match (mobility.verdict, report.home.kind, mobility.class) {
        (Verdict::Unassembled, ..) => "assembled",
        (_, Some(kind), _) => kind.word(),
        (_, _, Some(class @ (MobilityClass::Exceptional | MobilityClass::Paradoxical))) => {
            class.word()
        }
        _ if report.home.redundant.is_some_and(|n| n > 0) => "redundant",
        _ => "mobility",
    };
    let motion = match mobility.verdict {
        Verdict::Mobile => " Motion: `kutzbach trace`.",
        _ => "",
    };
    let text = format!("Details: `--verbose`.{motion} Words: `kutzbach explain {word}`.");
    page.paragraph(&text, Tint::Quiet, "", "");
}

/// That constraints are redundant, where the mechanism moves all the same.
fn redundant(report: &Report) -> Option<String> {
    let redundant = report.home.redundant.filter(|&n| n > 0)?;
    if report.mobility.verdict != Verdict::Mobile {
        return None;
    }
    let count = report.kutzbach;
    let many = match redundant {
        1 => format!("1 constraint is redundant ({})", cite::REDUNDANT),
        n => format!("{n} constraints are redundant ({})", cite::REDUNDANT),
    };
    Some(format!(
        "Counting (Kutzbach) gives {count}; {many}: it binds unless made accurately."
    ))
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
    if report
        .warnings
        .iter()
        .any(|w| w.kind == WarningKind::MayJoin)
    {
        text.push_str(", going by the part of the file that was read.");
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
            MobilityClass::Trivial => counting(report).to_owned(),
            MobilityClass::Exceptional => {
                "explained by the displacement subgroups of its chains".to_owned()
            }
            MobilityClass::Paradoxical => {
                format!("due to its dimensions{}", of_its_dimensions(report))
            }
        };
        text.push_str(&format!(
            ", {why}{} ({})",
            blocks_of(report, class),
            cite::class(class)
        ));
    } else if report.home.pose == Some(PoseKind::Regular) {
        text.push_str(&unexplained(report));
    }
    text.push('.');
    text
}

/// Which dimensions a paradoxical mobility is due to, as far as that is known.
fn of_its_dimensions(report: &Report) -> String {
    match superfluous(report) {
        Some(spare) => format!(": {spare} could be left out and fits by them"),
        None => "; no displacement group explains it".to_owned(),
    }
}

/// What is said of a mobility whose class is open.
fn unexplained(report: &Report) -> String {
    match superfluous(report) {
        Some(spare) => format!(", as it would without {spare}, which fits by its dimensions"),
        None => ", for a reason that displacement groups leave open".to_owned(),
    }
}

/// Links and couplings that could be left out, each by itself.
fn superfluous(report: &Report) -> Option<String> {
    let spare = |advice: &&Advice| advice.from == "link" || advice.from == "coupling";
    let spare: Vec<String> = report
        .advice
        .iter()
        .filter(spare)
        .map(|advice| format!("`{}`", advice.joint))
        .collect();
    match spare.as_slice() {
        [] => None,
        [one] => Some(one.clone()),
        several => Some(format!("one of {}", names(several, SPARE))),
    }
}

/// What can be left out is named up to so many.
const SPARE: usize = 3;

/// Which count predicts a trivial mobility.
fn counting(report: &Report) -> &'static str {
    let all = |space: &str| {
        let mut cycles = report.cycles.iter();
        cycles.len() > 0 && cycles.all(|cycle| cycle.space.as_deref() == Some(space))
    };
    if report.home.redundant == Some(0) {
        "as the count predicts"
    } else if all("G") {
        "as the planar (Grübler) count predicts"
    } else if all("S") {
        "as the spherical count predicts"
    } else {
        "as counting within the displacement subgroup of each loop predicts"
    }
}

/// ` (6 + 6 idle: rods that spin + 6 of a floating body)`, where some degrees of freedom are idle or nothing is held.
fn shares(report: &Report) -> String {
    let Some(found) = &report.freedoms else {
        return String::new();
    };
    if found.idle + found.floating == 0 {
        return String::new();
    }
    let mut parts = vec![format!("{}", found.useful)];
    if found.idle > 0 {
        let rods = match (found.rods, found.idle) {
            (true, 1) => ": a rod that spins",
            (true, _) => ": rods that spin",
            (false, _) => "",
        };
        parts.push(format!("{} idle{rods}", found.idle));
    }
    if found.floating > 0 {
        let bodies = match found.floating {
            6 => "a body that floats",
            _ => "bodies that float",
        };
        parts.push(format!("{} of {bodies}", found.floating));
    }
    let cited = match found.idle {
        0 => String::new(),
        _ => format!(", {}", cite::IDLE),
    };
    format!(" ({}{cited})", parts.join(" + "))
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
            "{freedom} of the useful degrees of freedom {} nearly idle ({}): {} a thousand times as much as anything else.",
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
    Some(format!("6 more if the base `{base}` is not fixed."))
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
            "not every infinitesimal motion can be continued (singular pose, {})",
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
        SingularKind::Shaky => "some infinitesimal motions cannot be continued".to_owned(),
        SingularKind::PermanentlyShaky => {
            "infinitesimally more mobile than it moves, here and along the whole motion".to_owned()
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
        return format!("Rigid: no joint can move ({}).", cite::FREEDOM);
    }
    let shaky = cite::KIND;
    match report.home.instantaneous {
        Some(1) => format!(
            "Rigid, but infinitesimally mobile (shaky, {shaky}): one infinitesimal motion, which cannot be continued."
        ),
        Some(many) if many > 1 => format!(
            "Rigid, but infinitesimally mobile (shaky, {shaky}): {many} independent infinitesimal motions, none of which can \
             be continued."
        ),
        Some(_) => format!(
            "Rigid: 0 degrees of freedom, and no infinitesimal motion ({}).",
            cite::INSTANTANEOUS
        ),
        None => format!("Rigid: 0 degrees of freedom ({}).", cite::FINITE),
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
fn not_drawn(nominal: &Nominal, distance: f64) -> String {
    let mut text = format!(
        "The nearest mechanism found that moves is {} away",
        metres(distance)
    );
    if let Some(change) = nominal.changes.first() {
        text.push_str(&format!(
            " ({}, {}: {} changed by {})",
            change.joint,
            change.number,
            figure(change.from),
            figure(change.to - change.from)
        ));
    }
    let beyond = match nominal.known_to {
        Some(known_to) => format!("the {} asked for", metres(known_to)),
        None => "the precision of these numbers".to_owned(),
    };
    text.push_str(&format!(
        ", beyond {beyond} ({}): it is not what is drawn.",
        cite::NOMINAL
    ));
    text
}

/// What numbers that a program printed miss as written.
fn noise(nominal: &Nominal) -> String {
    format!(
        "As written its loops miss by up to {}, which the noise of the numbers explains ({}); no number is off by more than {}.",
        metres(nominal.tolerance),
        cite::NOMINAL,
        metres(nominal.distance.unwrap_or(nominal.tolerance)),
    )
}

/// How far the numbers are from those of the mechanism meant, and what they leave as written.
fn meant(
    nominal: &Nominal,
    distance: f64,
    written: &AsWritten,
    (finite, asked): (Option<usize>, bool),
) -> String {
    let within = match nominal.known_to {
        Some(known_to) => format!("the {} asked for", metres(known_to)),
        None => "their precision".to_owned(),
    };
    let do_what = if nominal.finite > 0 { "move" } else { "close" };
    let away = format!(
        "dimensions that {do_what} differ from them by up to {}, within {within} ({})",
        metres(distance),
        cite::NOMINAL
    );
    let misfit = metres(nominal.tolerance);
    match (written.verdict, written.finite) {
        // What is open as written was told of the assembly.
        _ if asked => format!("The nearest {away}."),
        _ if nominal.finite == 0 => format!(
            "As written it does not close: its loops miss by up to {misfit}. The nearest {away}."
        ),
        (Verdict::Rigid, _) if finite == Some(0) => format!(
            "The numbers are taken as exact. If they are rounded, it is meant to move with {}: the nearest {away}; as written its \
             loops miss by up to {misfit} along that motion.",
            degrees(nominal.finite),
        ),
        (Verdict::Unassembled, _) => format!(
            "As written it does not close: its loops miss by up to {misfit}. The nearest {away}."
        ),
        (_, Some(0)) => format!(
            "As written it binds: its loops miss by up to {misfit} along the motion. The nearest {away}."
        ),
        _ => format!(
            "As written its loops miss by up to {misfit} along the motion. The nearest {away}."
        ),
    }
}

/// A mechanism that moves only if its numbers are read as rounded.
pub(super) fn nominal(report: &Report) -> Option<String> {
    let nominal = report.mobility.nominal.as_ref()?;
    if nominal.noise {
        return Some(noise(nominal));
    }
    if let Some(distance) = nominal.distance.filter(|_| !nominal.within_digits) {
        return Some(not_drawn(nominal, distance));
    }
    if nominal.distance == Some(0.0) {
        // Some numbers within the digits were sought, and those as written will do.
        return None;
    }
    if let (Some(distance), Some(written)) = (nominal.distance, &report.mobility.as_written) {
        let told = (report.mobility.finite, report.assembly.tolerance_asked);
        return Some(meant(nominal, distance, written, told));
    }
    let mut text = format!(
        "As written its loops miss by up to {} along the motion ({}): the numbers are probably rounded",
        metres(nominal.tolerance),
        cite::NOMINAL
    );
    match report.home.as_written {
        Some(0) => text.push_str("; taken literally they leave it rigid."),
        Some(literal) => text.push_str(&format!(
            "; taken literally they leave at most {}.",
            degrees(literal)
        )),
        None if report.mobility.finite == Some(nominal.finite) => text.push('.'),
        None => text.push_str(&format!(
            "; what they stand for has {}.",
            degrees(nominal.finite)
        )),
    }
    Some(text)
}

/// Why the finite mobility is not larger.
pub(super) fn not_more(report: &Report, verbose: bool) -> Option<String> {
    let mobility = &report.mobility;
    let home = &report.home;
    match (mobility.verdict, mobility.finite) {
        (Verdict::Unassembled, _) => None,
        (Verdict::Undecided, _) => Some(at_most(report, mobility.bounds[1]?)),
        _ if without_loops(report) => None,
        (Verdict::Rigid, _) => Some(format!("Why not more: {}.", proof(report, verbose)?)),
        (Verdict::Mobile, finite) => match (finite?, home.instantaneous?) {
            (finite, at_pose) if finite < at_pose => Some(singular_bound(report, finite, at_pose)),
            (_, at_pose) => Some(format!(
                "Why not more: rank {} of {} variables at this pose, which bounds the mobility from above ({}).",
                home.rank.unwrap_or(home.unknowns.saturating_sub(at_pose)),
                home.unknowns,
                cite::INSTANTANEOUS
            )),
        },
    }
}

/// The upper bound of what is not decided.
fn at_most(report: &Report, most: usize) -> String {
    let definition = match report.home.pose {
        Some(PoseKind::Singular) => cite::REGULAR,
        _ => cite::INSTANTANEOUS,
    };
    match report.home.instantaneous {
        Some(freedom) if most < freedom => format!(
            "Not more than {most}: the pose is singular, and no finite motion combines its {freedom} independent velocities \
             ({definition})."
        ),
        _ => format!(
            "Not more than {most}: the rank at a pose bounds the mobility from above ({definition})."
        ),
    }
}

/// Why fewer than the velocities at the pose suggest.
fn singular_bound(report: &Report, finite: usize, at_pose: usize) -> String {
    let mut text = match report.home.kind {
        Some(SingularKind::PermanentlyShaky) => format!(
            "Why not more: {} of the {at_pose} independent velocities cannot be continued, here and at every pose of the \
             motion ({})",
            at_pose - finite,
            cite::REGULAR
        ),
        _ => format!(
            "Why not more: {at_pose} independent velocities are possible at this singular pose, but no finite motion through \
             it has more than {finite} ({})",
            cite::BRANCH
        ),
    };
    if report.mobility.complex_dimension == Some(finite) {
        text.push_str(&format!(
            "; over the complex numbers the dimension is {finite} too ({})",
            cite::EVIDENCE
        ));
    }
    text.push('.');
    text
}

/// Why the finite mobility is not smaller.
pub(super) fn not_less(report: &Report, verbose: bool) -> Option<String> {
    let mobility = &report.mobility;
    match mobility.verdict {
        Verdict::Mobile if without_loops(report) && !verbose => None,
        Verdict::Mobile => Some(format!("Why not less: {}.", proof(report, verbose)?)),
        Verdict::Undecided => Some(match mobility.bounds[0]? {
            0 => format!(
                "Not less than 0: no motion has been proved ({}).",
                cite::CERTIFICATE
            ),
            least => format!(
                "Not less than {least}: joints outside loops, the sub-mechanisms already decided and the displacement \
                 subgroups of the others leave that many ({}).",
                cite::CERTIFICATE
            ),
        }),
        // Nothing is less mobile than what is rigid.
        Verdict::Rigid | Verdict::Unassembled => None,
    }
}

/// Reasons by groups up to so many letters are explanations; longer ones are proofs, for those who ask.
const SHORT_PROOF: usize = 160;

/// What the answer rests on, with its strength; what exactly it proves where everything is asked for.
fn proof(report: &Report, verbose: bool) -> Option<String> {
    let certificate = report.mobility.certificate.as_ref()?;
    let strength = match certificate.level {
        CertificateLevel::Numeric => "computed numerically, with a margin",
        CertificateLevel::Subgroup => "proved by displacement subgroups",
        CertificateLevel::Exact => "proved by exact algebra",
    };
    let text = certificate.text.trim_end_matches('.');
    let cited = cite::level(certificate.level);
    let explains =
        certificate.level == CertificateLevel::Subgroup && text.chars().count() <= SHORT_PROOF;
    Some(match verbose || explains {
        true => format!("{strength} ({cited}): {text}"),
        false => format!("{strength} ({cited})"),
    })
}

pub(super) fn without_loops(report: &Report) -> bool {
    report.size.loops == 0 && report.size.couplings == 0
}

/// The finite mobility, or what is known of it.
fn freedoms(report: &Report) -> String {
    match (report.mobility.finite, report.mobility.bounds) {
        (Some(n), _) => degrees(n),
        (None, [Some(least), Some(most)]) if least == most => {
            format!("{}, as far as is known", degrees(least))
        }
        (None, [Some(least), Some(most)]) => {
            format!("{least} to {most} degrees of freedom")
        }
        (None, [Some(least), None]) => format!("at least {}", degrees(least)),
        (None, [None, Some(most)]) => format!("at most {}", degrees(most)),
        (None, [None, None]) => "its degrees of freedom are not known".to_owned(),
    }
}

fn optional(count: Option<usize>) -> String {
    count.map_or_else(|| "?".to_owned(), |n| n.to_string())
}

/// How numbers are written that are not exact: all alike, or kind by kind.
fn written(kinds: &[WrittenKind]) -> String {
    let count = |number: u32, what: &str| counted(usize::try_from(number).unwrap_or(0), what);
    let style = |kind: &WrittenKind| {
        let decimals = count(kind.decimals.unwrap_or(0).unsigned_abs(), "decimal");
        let significant = count(kind.significant.unwrap_or(0), "significant digit");
        match kind.style {
            WrittenStyle::Decimals | WrittenStyle::Either => format!("to {decimals}"),
            WrittenStyle::Significant => format!("to {significant}"),
            WrittenStyle::Single => "in full single precision".to_owned(),
            WrittenStyle::Double => "in full double precision".to_owned(),
            WrittenStyle::Degrees => format!("to {decimals} of a degree"),
            WrittenStyle::Inches => format!("to {decimals} of an inch"),
        }
    };
    let each: Vec<String> = kinds.iter().map(style).collect();
    match each.first() {
        None => "numbers rounded".to_owned(),
        Some(first) if each.iter().all(|style| style == first) => {
            let in_full =
                |of: &WrittenKind| matches!(of.style, WrittenStyle::Single | WrittenStyle::Double);
            let stated = if kinds.iter().any(in_full) {
                ""
            } else {
                "stated "
            };
            format!("numbers {stated}{first}")
        }
        _ => {
            let named = kinds.iter().zip(&each);
            let named: Vec<String> = named
                .map(|(of, style)| format!("{} {style}", of.kind))
                .collect();
            names(&named, named.len())
        }
    }
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
        (true, _) => "exact numbers".to_owned(),
        (false, _) if source.precision.is_some() => format!(
            "numbers known to {:e} m or rad (`--precision`)",
            source.precision.unwrap_or_default()
        ),
        (false, _) => written(&source.written),
    };
    let constants = report.source.constants.as_ref();
    let rounded_by = source
        .rounded_by
        .as_ref()
        .filter(|_| source.precision.is_none());
    let numbers = match rounded_by {
        Some(at) => format!("{numbers}, such as `{}` in `{}`", at.literal, at.owner),
        None => numbers,
    };
    format!(
        "{} ({}): {}; {numbers}.{}{}",
        report.mechanism,
        report.source.file,
        names(&parts, parts.len()),
        constants
            .map(|constants| super::constants::sentence(constants, verbose))
            .unwrap_or_default(),
        super::constants::residues(&source.residues)
    )
}

#[cfg(test)]
#[path = "verdict_tests.rs"]
mod tests;
