//! A page that leads to many pages, and an index of pictures alone.

use super::document::shell;
use super::escape::escaped;
use super::stage::{Assets, Stage};
use crate::Report;
use crate::text::{verdict, words::counted};
use kutzbach_mobility::{MobilityClass, SingularKind, Verdict};
use kutzbach_model::mechanism::Mechanism;

/// A thumbnail has room for this many pixels.
pub(super) const THUMBNAIL: [f64; 2] = [320.0, 200.0];

/// One mechanism of a gallery, or a file that is none.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The page it leads to, or its still, relative to the gallery; `None` for a file that could not be read.
    page: Option<String>,
    title: String,
    sentence: String,
    figures: String,
    picture: String,
    group: Group,
    families: Vec<&'static str>,
}

/// What the mechanism is like, in words by which the index can be narrowed.
fn families(report: &Report) -> Vec<&'static str> {
    let mut families = Vec::new();
    match report.size.loops {
        0 => families.push("open chain"),
        1 => families.push("one loop"),
        _ => families.push("several loops"),
    }
    if report.four_bars.iter().any(|bar| !bar.within_larger) {
        families.push("four-bar");
    }
    if report.size.couplings > 0 {
        families.push("gears and couplings");
    }
    families.extend(report.mobility.class.map(MobilityClass::word));
    families.extend(report.home.kind.map(SingularKind::word));
    let freedoms = report.freedoms.as_ref();
    if freedoms.is_some_and(|freedoms| freedoms.idle > 0) {
        families.push("idle freedoms");
    }
    if report.home.redundant.is_some_and(|redundant| redundant > 0) {
        families.push("overconstrained");
    }
    families
}

/// What mechanisms are sorted by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Mobile,
    Rigid,
    Undecided,
    Unassembled,
    Unreadable,
}

impl Group {
    const ALL: [Self; 5] = [
        Self::Mobile,
        Self::Rigid,
        Self::Undecided,
        Self::Unassembled,
        Self::Unreadable,
    ];

    fn title(self) -> &'static str {
        match self {
            Self::Mobile => "They move",
            Self::Rigid => "They are rigid",
            Self::Undecided => "Not decided",
            Self::Unassembled => "No closed pose",
            Self::Unreadable => "Not read",
        }
    }
}

impl Entry {
    pub(super) fn new(page: &str, mechanism: &Mechanism, report: &Report, stage: &Stage) -> Self {
        let size = &report.size;
        Self {
            page: Some(page.to_owned()),
            title: report.mechanism.clone(),
            sentence: verdict::sentence(report),
            figures: format!(
                "{}, {}, {}; Kutzbach {}",
                counted(size.links, "link"),
                counted(size.joints, "joint"),
                counted(size.loops, "loop"),
                report.kutzbach
            ),
            picture: super::document::still(mechanism, stage, THUMBNAIL),
            group: match report.mobility.verdict {
                Verdict::Mobile => Group::Mobile,
                Verdict::Rigid => Group::Rigid,
                Verdict::Undecided => Group::Undecided,
                Verdict::Unassembled => Group::Unassembled,
            },
            families: families(report),
        }
    }

    /// The entry of a file that could not be read, and why.
    #[must_use]
    pub fn unreadable(file: &str, why: &str) -> Self {
        Self {
            page: None,
            title: file.to_owned(),
            sentence: why.to_owned(),
            figures: String::new(),
            picture: String::new(),
            group: Group::Unreadable,
            families: Vec::new(),
        }
    }
}

/// Members of the groups that have any, those that move first, each group in the order given.
fn groups(entries: &[Entry]) -> impl Iterator<Item = (Group, Vec<&Entry>)> {
    let members = |group| -> Vec<&Entry> { entries.iter().filter(|e| e.group == group).collect() };
    let all = Group::ALL.into_iter().map(move |g| (g, members(g)));
    all.filter(|(_, members)| !members.is_empty())
}

/// The page with a thumbnail of every mechanism, those that move first, each group in the order given.
#[must_use]
pub fn index(title: &str, entries: &[Entry]) -> String {
    let mut content = format!(
        "<main class=\"gallery\">\n<header><h1>{}</h1>\n<p class=\"quiet\">{}. Every page shows how its mechanism moves, \
         and why.</p></header>\n",
        escaped(title),
        counted(entries.len(), "mechanism")
    );
    for (group, members) in groups(entries) {
        content.push_str(&format!(
            "<section><h2>{} <span class=\"quiet\">{}</span></h2>\n<ul class=\"cards\">\n",
            group.title(),
            members.len()
        ));
        for entry in members {
            content.push_str(&format!(
                "<li data-families=\"{}\">",
                entry.families.join("|")
            ));
            if let Some(page) = &entry.page {
                content.push_str(&format!("<a href=\"{}\">", escaped(page)));
            }
            content.push_str(&entry.picture);
            content.push_str(&format!("<h3>{}</h3>", escaped(&entry.title)));
            if entry.page.is_some() {
                content.push_str("</a>");
            }
            content.push_str(&format!("<p>{}</p>", escaped(&entry.sentence)));
            if !entry.figures.is_empty() {
                content.push_str(&format!(
                    "<p class=\"quiet\">{}</p>",
                    escaped(&entry.figures)
                ));
            }
            content.push_str("</li>\n");
        }
        content.push_str("</ul></section>\n");
    }
    content.push_str("</main>\n");
    shell(title, &content, Assets::Beside)
}

/// An index in Markdown for where pages are not shown: the still that each entry names beside what is said of its mechanism,
/// those that move first, each group in the order given.
#[must_use]
pub fn stills_index(title: &str, entries: &[Entry]) -> String {
    let mut text = format!("# {}\n", escaped(title));
    for (group, members) in groups(entries) {
        text += &format!("\n## {}: {}\n\n<table>\n", group.title(), members.len());
        for entry in members {
            let picture = entry.page.as_ref().map_or_else(String::new, |still| {
                format!("<img src=\"{}\" alt=\"\" width=\"240\">", escaped(still))
            });
            text += &format!(
                "<tr><td>{picture}</td><td><b>{}</b><br>{}<br><sub>{}</sub></td></tr>\n",
                escaped(&entry.title),
                escaped(&entry.sentence),
                escaped(&entry.figures)
            );
        }
        text += "</table>\n";
    }
    text
}
