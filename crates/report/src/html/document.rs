//! The order of the page, its policy, script and style.

use super::accuracy;
use super::blocks;
use super::drawing::page_data;
use super::escape::{escaped, in_script};
use super::names::Names;
use super::plots;
use super::ranges::ranges;
use super::stage::{Assets, Facts, Stage};
use crate::definitions;
use crate::picture::pictogram::{self, Build, Pictogram};
use crate::picture::plot;
use crate::picture::sketch::{self, Sketch};
use crate::schema::{Cycle, Report};
use crate::text::words::metres;
use crate::text::{
    Block, Layout, Page, Units, assembly, branches, counts, explanation, four_bars, inputs, joints,
    sections, verdict,
};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kutzbach_model::graph::{self, FoldedGraph};
use kutzbach_model::mechanism::Mechanism;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// Names of the files that pages of a gallery share.
pub const SCRIPT: &str = "viewer.js";
/// See [`SCRIPT`].
pub const STYLE: &str = "page.css";

/// The script of every page, built from `viewer/src`; see `viewer/README.md`.
#[must_use]
pub fn script() -> &'static str {
    include_str!("../../viewer/viewer.js")
}

/// The style of every page.
#[must_use]
pub fn style() -> String {
    let page = include_str!("../../viewer/page.css");
    // The page has the last word on colours.
    [
        plot::STYLE,
        sketch::STYLE,
        pictogram::STYLE,
        graph::SVG_STYLE,
        page,
    ]
    .join("\n")
}

/// Poses drawn faintly in the still.
const GHOSTS: usize = 4;

/// The still has room for this many pixels.
const STILL: [f64; 2] = [960.0, 540.0];

pub(super) fn document(
    facts: &Facts<'_>,
    stage: &Stage,
    assets: Assets,
) -> Result<String, serde_json::Error> {
    let names = Names::new(facts.mechanism, facts.report);
    let data = serde_json::to_string(&page_data(facts, stage, &names))?;
    let title = format!("{}: how it moves", facts.mechanism.name());
    let mut content = String::with_capacity(data.len() + 200_000);
    content.push_str("<main>\n");
    body(facts, stage, &names, &mut content);
    content.push_str("</main>\n<script type=\"application/json\" id=\"page-data\">");
    content.push_str(&in_script(&data));
    content.push_str("</script>\n");
    Ok(shell(&title, &content, assets))
}

/// A document around its content, with policy, style and script.
pub(super) fn shell(title: &str, content: &str, assets: Assets) -> String {
    shell_with("", title, content, assets)
}

/// The same with more style than all pages have, where a page has its own.
pub(super) fn shell_with(more: &str, title: &str, content: &str, assets: Assets) -> String {
    let (policy, style, script) = match assets {
        Assets::Inside => {
            let style = format!("{}{more}", style());
            (
                policy(&hash(script()), &hash(&style)),
                format!("<style>{style}</style>"),
                format!("<script>{}</script>", script()),
            )
        }
        Assets::Beside => (
            // A folder that is opened without a server is its own origin in some browsers only.
            policy("'self' file:", "'self' file:"),
            format!("<link rel=\"stylesheet\" href=\"{STYLE}\">"),
            format!("<script src=\"{SCRIPT}\"></script>"),
        ),
    };
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>{}</title>\n{style}\n</head>\n<body>\n{content}{script}\n</body>\n</html>\n",
        escaped(title)
    )
}

/// Nothing may be loaded but the page's own script and style, and only these are obeyed.
fn policy(script: &str, style: &str) -> String {
    format!(
        "default-src 'none'; script-src {script}; style-src {style}; img-src data:; base-uri 'none'; form-action 'none'"
    )
}

fn hash(text: &str) -> String {
    format!(
        "'sha256-{}'",
        STANDARD.encode(Sha256::digest(text.as_bytes()))
    )
}

/// A page that has room for everything.
fn verbose() -> Page {
    Page::new(Layout {
        verbose: true,
        ..Layout::default()
    })
}

fn body(facts: &Facts<'_>, stage: &Stage, names: &Names, out: &mut String) {
    let report = facts.report;
    let mut answer = verbose();
    verdict::answer(report, &mut answer);
    inputs::inputs(report, &mut answer);
    sections::pose(report, &mut answer);
    header(report, answer.blocks(), names, out);
    let mut reasons = verbose();
    verdict::reasons(report, &mut reasons);
    verdict::source(report, &mut reasons);
    out.push_str("<section id=\"motion\"><h2>Motion</h2>\n<div id=\"stage\">");
    out.push_str(&still(facts.mechanism, stage, STILL));
    out.push_str("</div>\n<div id=\"controls\"></div>\n");
    if let Some(distance) = stage.nearest {
        out.push_str(&format!(
            "<p class=\"quiet\">As drawn it does not move. Shown is the nearest mechanism found that does: its dimensions \
             differ by up to {}.</p>\n",
            metres(distance)
        ));
    }
    out.push_str("</section>\n<section id=\"reasons\">\n");
    blocks::write(reasons.blocks(), names, out);
    out.push_str("</section>\n");
    let section = |id: &str, write: &dyn Fn(&mut Page), out: &mut String| {
        let mut page = verbose();
        write(&mut page);
        if !page.blocks().is_empty() {
            out.push_str(&format!("<section id=\"{id}\">\n"));
            blocks::write(page.blocks(), names, out);
            out.push_str("</section>\n");
        }
    };
    section("freedoms", &|page| counts::write(report, page), out);
    section("assembly", &|page| assembly::section(report, page), out);
    section("branches", &|page| branches::branches(report, page), out);
    // Of another mechanism than the one that the table is about they would say nothing.
    let ranges = match stage.nearest {
        None => ranges(facts.mechanism, stage),
        Some(_) => BTreeMap::new(),
    };
    section(
        "joints",
        &|page| {
            joints::joints(report, &ranges, true, page);
            four_bars::four_bars(report, Units::Drawing, page);
        },
        out,
    );
    section("couplings", &|page| sections::couplings(report, page), out);
    graph_section(facts, out);
    section("loops", &|page| sections::cycles(report, page), out);
    section(
        "motions",
        &|page| branches::motions(report, true, page),
        out,
    );
    plots::section(facts, stage, out);
    if let Some(accuracy) = facts.accuracy {
        accuracy::section(accuracy, names, out);
    }
    section("advice", &|page| sections::advice(report, page), out);
    section(
        "warnings",
        &|page| sections::other_warnings(report, page),
        out,
    );
    section("evidence", &|page| branches::evidence(report, page), out);
    section("details", &|page| sections::details(report, page), out);
    definition_list(names, out);
}

/// What to read first; the reasons stand below the mechanism.
fn header(report: &Report, answer: &[Block], names: &Names, out: &mut String) {
    let mobility = &report.mobility;
    let build = match report.four_bars.as_slice() {
        _ if report.size.loops == 0 => Build::Tree,
        [bar] if !bar.within_larger => Build::FourBar,
        _ => Build::Other,
    };
    let sign = Pictogram::of(mobility.verdict, mobility.class, report.home.kind, build);
    out.push_str(&format!(
        "<header id=\"verdict\">\n{}\n<h1>{}</h1>\n",
        sign.fragment(),
        escaped(&report.mechanism)
    ));
    blocks::write(answer, names, out);
    out.push_str("</header>\n");
}

/// The mechanism at the pose analysed, with where it goes drawn faintly.
pub(super) fn still(mechanism: &Mechanism, stage: &Stage, size: [f64; 2]) -> String {
    sketch(mechanism, stage, size).fragment()
}

pub(super) fn sketch<'a>(mechanism: &'a Mechanism, stage: &'a Stage, size: [f64; 2]) -> Sketch<'a> {
    let mut sketch = Sketch::new(mechanism, &stage.drawing, &stage.home, stage.view);
    sketch.size = size;
    sketch.gaps.clone_from(&stage.gaps);
    if let Some(played) = stage.repertoire.played.first() {
        // On a closed curve the last pose is the first again.
        let all = played.poses.len().saturating_sub(1);
        let poses = (0..GHOSTS).map(|k| (2 * k + 1) * all / (2 * GHOSTS));
        sketch.ghosts = poses.map(|k| played.poses[k].links.as_slice()).collect();
    }
    sketch
}

fn graph_section(facts: &Facts<'_>, out: &mut String) {
    let structure = &facts.analysis.structure;
    out.push_str(
        "<section id=\"graph\">\n<h2>Constraint graph</h2>\n<p class=\"quiet\">Links are boxes, joints are lines: those of \
         the spanning <a class=\"term\" href=\"#D15\">tree</a> solid, those that close \
         <a class=\"term\" href=\"#D14\">loops</a> dashed.</p>\n<div class=\"scroll\">",
    );
    let folded = FoldedGraph::new(&structure.graph, &structure.tree, facts.mechanism);
    out.push_str(&graph::folded_svg_fragment(&folded));
    out.push_str("</div>\n");
    if !folded.folded.is_empty() {
        out.push_str(&format!(
            "<p class=\"quiet\">Links fixed to one another are one box ({} of them are not drawn).</p>\n",
            folded.folded.len()
        ));
    }
    loop_chips(&facts.report.cycles, out);
    out.push_str("</section>\n");
}

/// Loops shown beside the graph; the table has all.
const CHIPS: usize = 60;

/// The loops to point at, close to graph and picture.
fn loop_chips(cycles: &[Cycle], out: &mut String) {
    if cycles.is_empty() {
        return;
    }
    out.push_str("<p class=\"chips\">Loops: ");
    for (index, cycle) in cycles.iter().enumerate().take(CHIPS) {
        out.push_str(&format!(
            "<span class=\"chip\" data-cycle=\"{index}\">{}</span> ",
            escaped(&cycle.name)
        ));
    }
    if cycles.len() > CHIPS {
        out.push_str(&format!("and {} more", cycles.len() - CHIPS));
    }
    out.push_str("</p>\n");
}

pub(super) fn definition_list(names: &Names, out: &mut String) {
    out.push_str("<section id=\"definitions\">\n<h2>Definitions</h2>\n");
    for definition in definitions::all() {
        out.push_str(&format!(
            "<details id=\"{0}\"><summary>{0} {1}</summary>\n",
            definition.number,
            escaped(definition.title)
        ));
        let mut page = verbose();
        explanation::write(&definition, &mut page);
        blocks::write(page.blocks(), names, out);
        out.push_str("</details>\n");
    }
    out.push_str("</section>\n");
}
