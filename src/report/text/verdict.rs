//! The first paragraph: the answer, what it rests on, and what it is the answer for.

use super::page::Page;
use super::style::Tint;
use super::words::{counted, figure, names};
use crate::mobility::{CertificateLevel, MobilityClass, Verdict};
use crate::report::schema::{Assembly, Report};

/// Writes the verdict, its reasons and the line that says what was read.
pub(super) fn write(report: &Report, page: &mut Page) {
    let tint = match report.mobility.verdict {
        Verdict::Mobile => Tint::Good,
        Verdict::Rigid => Tint::Notable,
        Verdict::Undecided => Tint::Doubtful,
        Verdict::Unassembled => Tint::Bad,
    };
    page.paragraph(&sentence(report), tint, "", "");
    if let Some(nominal) = &report.mobility.nominal {
        let text = format!(
            "Rigid only as written: a mechanism with {} lies within {} m of the numbers in the file, which are probably \
             rounded.",
            counted(nominal.finite, "finite freedom"),
            figure(nominal.tolerance)
        );
        page.paragraph(&text, Tint::Doubtful, "", "");
    }
    if let Some(certificate) = &report.mobility.certificate {
        let strength = match certificate.level {
            CertificateLevel::Numeric => "By floating-point numbers with a margin",
            CertificateLevel::Subgroup => "Proved by the group of displacements",
            CertificateLevel::Exact => "Proved in exact arithmetic",
        };
        page.item(&format!("{strength}: {}", certificate.text), Tint::Plain);
    }
    for reason in &report.mobility.why {
        page.item(reason, Tint::Plain);
    }
    page.gap();
    page.paragraph(&identity(report), Tint::Plain, "", "");
}

fn sentence(report: &Report) -> String {
    let mobility = &report.mobility;
    match mobility.verdict {
        Verdict::Unassembled => unassembled(&report.assembly),
        Verdict::Rigid => match report.home.instantaneous {
            Some(1) => {
                "Rigid, but shaky: it gives way in 1 direction at this pose, which leads nowhere."
                    .to_owned()
            }
            Some(shaky) if shaky > 1 => format!(
                "Rigid, but shaky: it gives way in {shaky} directions at this pose, none of which leads anywhere."
            ),
            _ => "Rigid: nothing can move.".to_owned(),
        },
        Verdict::Mobile => {
            let class = match mobility.class {
                Some(MobilityClass::Trivial) => ", as its joints' common subgroup says",
                Some(MobilityClass::Exceptional) => {
                    ", explained by the displacement groups of its chains"
                }
                Some(MobilityClass::Paradoxical) => {
                    ", owed to its special dimensions (paradoxical)"
                }
                None => "",
            };
            format!("Mobile: {}{class}.", freedoms(report))
        }
        Verdict::Undecided => format!("Undecided: {}.", freedoms(report)),
    }
}

/// The finite mobility, or what is known of it.
fn freedoms(report: &Report) -> String {
    let finite = |n| counted(n, "finite freedom");
    match (report.mobility.finite, report.mobility.bounds) {
        (Some(n), _) => finite(n),
        (None, [Some(least), Some(most)]) => {
            format!("between {least} and {}", finite(most))
        }
        (None, [Some(least), None]) => format!("at least {}", finite(least)),
        (None, [None, Some(most)]) => format!("at most {}", finite(most)),
        (None, [None, None]) => "nothing is known of its finite freedoms yet".to_owned(),
    }
}

fn unassembled(assembly: &Assembly) -> String {
    let worst = assembly
        .gaps
        .iter()
        .max_by(|a, b| a.left_position.total_cmp(&b.left_position));
    match worst {
        Some(gap) => format!(
            "Does not assemble: loop `{}` stays open by {} m and {}° however the joints are turned, so there is no pose \
             to analyse.",
            gap.cycle,
            figure(gap.left_position),
            figure(gap.left_angle.to_degrees())
        ),
        None => "Does not assemble: the loops cannot be closed, so there is no pose to analyse."
            .to_owned(),
    }
}

fn identity(report: &Report) -> String {
    let size = &report.size;
    let mut parts = vec![
        counted(size.links, "link"),
        counted(size.joints, "joint"),
        counted(size.loops, "independent loop"),
    ];
    if size.couplings > 0 {
        parts.push(counted(size.couplings, "coupling"));
    }
    let numbers = match (report.source.exact, report.source.digits) {
        (true, _) => "numbers taken as exact".to_owned(),
        (false, Some(digits)) => format!(
            "numbers stated to {}",
            counted(usize::try_from(digits).unwrap_or(0), "decimal")
        ),
        (false, None) => "numbers rounded".to_owned(),
    };
    format!(
        "{} ({}): {}; {numbers}.",
        report.mechanism,
        report.source.file,
        names(&parts, parts.len())
    )
}
