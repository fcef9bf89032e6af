//! What the figure shows, and how it is drawn. Shared with `tests/families.rs`.

use kutzbach::families::{
    Outcome, Truth, bennett_chain, bennett_row, continuous_families, negative_power_of_ten,
};
use kutzbach::mechanism::{Mechanism, MechanismError};
use kutzbach::mobility::{Analysis, AnalysisError, AnalysisOptions, PoseKind, analyse};
use kutzbach::number::Number;
use std::fmt::Write;

/// The smallest offset is 10 to the minus this.
pub const LEAST_EXPONENT: u32 = 14;

/// Chains and rows have up to so many loops.
pub const MOST_LOOPS: usize = 20;

/// Where in its family a member stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// At an offset of `10^-exponent`.
    Offset(u32),
    /// Where the offset vanishes.
    Limit,
    /// At so many loops.
    Loops(usize),
}

impl Place {
    /// For the axis.
    #[must_use]
    pub fn label(self) -> String {
        match self {
            Self::Offset(exponent) => format!("1e-{exponent}"),
            Self::Limit => "0".to_owned(),
            Self::Loops(loops) => loops.to_string(),
        }
    }
}

/// A member that is to be analysed.
#[derive(Clone, Debug)]
pub struct Case {
    /// The name of its family.
    pub family: &'static str,
    /// Where it stands in it.
    pub place: Place,
    /// What is true of it.
    pub truth: Truth,
    /// The mechanism.
    pub mechanism: Mechanism,
}

/// What was found of a member.
#[derive(Clone, Debug)]
pub struct Member {
    /// The name of its family.
    pub family: &'static str,
    /// Where it stands in it.
    pub place: Place,
    /// How the analysis compares with the truth.
    pub outcome: Outcome,
    /// The reasons the analysis gives where it leaves the verdict open.
    pub why: Vec<String>,
    /// Smallest singular value kept, relative to the largest.
    pub kept: f64,
    /// What counts as zero, relative to the largest.
    pub tolerance: f64,
}

/// All members, family by family.
///
/// # Errors
/// None in practice: every family has such members.
pub fn cases() -> Result<Vec<Case>, MechanismError> {
    let mut cases = Vec::new();
    for family in continuous_families() {
        for place in (1..=LEAST_EXPONENT)
            .map(Place::Offset)
            .chain([Place::Limit])
        {
            let epsilon = match place {
                Place::Offset(exponent) => negative_power_of_ten(exponent),
                _ => Number::zero(),
            };
            cases.push(Case {
                family: family.name,
                place,
                truth: *family.truth(&epsilon),
                mechanism: family.member(&epsilon)?,
            });
        }
    }
    for (family, chained) in [("bennett_chain", true), ("bennett_row", false)] {
        for loops in 1..=MOST_LOOPS {
            let freedom = if chained { 1 } else { loops };
            let mechanism = if chained {
                bennett_chain(loops)
            } else {
                bennett_row(loops)
            };
            cases.push(Case {
                family,
                place: Place::Loops(loops),
                truth: Truth {
                    finite: freedom,
                    instantaneous: freedom,
                    pose: PoseKind::Regular,
                    branches: 1,
                },
                mechanism: mechanism?,
            });
        }
    }
    Ok(cases)
}

/// Analyses a member.
///
/// # Errors
/// What the analysis finds wrong.
pub fn look(case: &Case) -> Result<Member, AnalysisError> {
    let analysis = analyse(&case.mechanism, &AnalysisOptions::default())?;
    Ok(member(case, &analysis))
}

fn member(case: &Case, analysis: &Analysis) -> Member {
    let decisions = || analysis.parts.iter().map(|part| &part.decision);
    Member {
        family: case.family,
        place: case.place,
        outcome: case.truth.outcome(analysis),
        why: analysis.mobility.why.clone(),
        kept: decisions().map(|d| d.kept).fold(1.0, f64::min),
        tolerance: decisions().map(|d| d.tolerance).fold(0.0, f64::max),
    }
}

/// The families that have members, in their order.
#[must_use]
pub fn families_of(members: &[Member]) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = members.iter().map(|m| m.family).collect();
    names.dedup();
    names
}

/// The name of a family for people, and its axis.
fn titles(family: &str) -> (String, String) {
    let mut title = family.replace('_', " ").replace("bennett", "Bennett");
    if let Some(first) = title.get(..1).map(str::to_uppercase) {
        title.replace_range(..1, &first);
    }
    let axis = continuous_families()
        .iter()
        .find(|f| f.name == family)
        .map_or("number of loops", |f| f.epsilon);
    (title, axis.to_owned())
}

// All measures in pixels.
const COLUMNS: usize = 2;
const PANEL: (f64, f64) = (460.0, 230.0);
const HEAD: f64 = 64.0;
/// The frame of the curves within a panel.
const LEFT: f64 = 58.0;
const TOP: f64 = 26.0;
const WIDTH: f64 = 384.0;
const HEIGHT: f64 = 128.0;
/// The strip of verdicts below it.
const STRIP: f64 = 18.0;
/// The axis of singular values goes from 1, a little below the frame's top, down to 10 to the minus this.
const MARGIN: f64 = 8.0;
const DECADES: f64 = 32.0;

fn height_of(value: f64) -> f64 {
    let decades = (-value.max(1e-300).log10()).clamp(0.0, DECADES);
    TOP + MARGIN + (HEIGHT - MARGIN) * decades / DECADES
}

/// Draws the figure.
#[must_use]
pub fn render(members: &[Member]) -> String {
    let families = families_of(members);
    let rows = families.len().div_ceil(COLUMNS);
    let (width, height) = (PANEL.0 * COLUMNS as f64, HEAD + PANEL.1 * rows as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" width=\"{width:.0}\" \
         height=\"{height:.0}\" role=\"img\">\n<title>Verdicts along families of mechanisms</title>\n<style>text{{font:11px \
         system-ui,Helvetica,Arial,sans-serif;fill:#223}}.title{{font-weight:600;font-size:13px}}.mid{{text-anchor:middle}}\
         .end{{text-anchor:end}}.frame{{fill:none;stroke:#9ab}}.grid{{stroke:#e3e9ee}}.kept{{fill:none;stroke:#1f4e9c;\
         stroke-width:1.6}}.dot{{fill:#1f4e9c}}.tolerance{{fill:none;stroke:#555;stroke-width:1.4;stroke-dasharray:5 3}}\
         .right{{fill:#8fd0b0}}.undecided{{fill:#f5c542}}.wrong{{fill:#c0392b}}.on-wrong{{fill:#fff}}.cell{{stroke:#fff}}</style>\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    legend(&mut svg);
    for (index, family) in families.iter().enumerate() {
        let x = PANEL.0 * (index % COLUMNS) as f64;
        let y = HEAD + PANEL.1 * (index / COLUMNS) as f64;
        let of: Vec<&Member> = members.iter().filter(|m| m.family == *family).collect();
        line(
            &mut svg,
            format!("<g transform=\"translate({x:.0} {y:.0})\">"),
        );
        panel(&mut svg, family, &of);
        line(&mut svg, "</g>".to_owned());
    }
    svg.push_str("</svg>\n");
    svg
}

fn line(svg: &mut String, text: String) {
    // Writing to a string does not fail.
    let _ = writeln!(svg, "{text}");
}

fn legend(svg: &mut String) {
    line(svg, "<g transform=\"translate(58 14)\">".to_owned());
    for (x, word, glyph) in [
        (0, "right", ""),
        (90, "undecided", "?"),
        (200, "wrong", "×"),
    ] {
        let class = if word == "wrong" {
            "mid on-wrong"
        } else {
            "mid"
        };
        line(
            svg,
            format!(
                "<rect class=\"cell {word}\" x=\"{x}\" y=\"0\" width=\"22\" height=\"16\"/><text class=\"{class}\" x=\"{}\" \
                 y=\"12\">{glyph}</text><text x=\"{}\" y=\"12\">{word}</text>",
                x + 11,
                x + 28
            ),
        );
    }
    line(
        svg,
        "<path class=\"kept\" d=\"M280 8H310\"/><circle class=\"dot\" cx=\"295\" cy=\"8\" r=\"2.6\"/><text x=\"316\" \
         y=\"12\">smallest singular value kept</text><path class=\"tolerance\" d=\"M490 8H520\"/><text x=\"526\" \
         y=\"12\">tolerance: below it, a singular value counts as zero</text>"
            .to_owned(),
    );
    line(
        svg,
        "<text x=\"0\" y=\"34\">Singular values of the closure equations relative to the largest, without unit; offsets fall \
         from left to right, 0 is the limit.</text>"
            .to_owned(),
    );
    line(svg, "</g>".to_owned());
}

fn panel(svg: &mut String, family: &str, members: &[&Member]) {
    let (title, axis) = titles(family);
    let bottom = TOP + HEIGHT;
    let middle = LEFT + WIDTH / 2.0;
    line(
        svg,
        format!("<text class=\"title\" x=\"{LEFT}\" y=\"16\">{title}</text>"),
    );
    for exponent in [0, 8, 16, 24, 32] {
        let y = height_of(10f64.powi(-exponent));
        let text = if exponent == 0 {
            "1".to_owned()
        } else {
            format!("1e-{exponent}")
        };
        line(
            svg,
            format!(
                "<path class=\"grid\" d=\"M{LEFT} {y:.1}H{:.1}\"/><text class=\"end\" x=\"{:.1}\" y=\"{:.1}\">{text}</text>",
                LEFT + WIDTH,
                LEFT - 5.0,
                y + 4.0
            ),
        );
    }
    line(
        svg,
        format!(
            "<text class=\"mid\" transform=\"translate(13 {:.1}) rotate(-90)\">relative singular value</text>",
            TOP + HEIGHT / 2.0
        ),
    );
    // One slot per member; the limit stands apart from the offsets.
    let apart = if members.iter().any(|m| m.place == Place::Limit) {
        0.6
    } else {
        0.0
    };
    let slot = WIDTH / (members.len() as f64 + apart);
    let left_of = |index: usize| {
        let shift = if members[index].place == Place::Limit {
            apart
        } else {
            0.0
        };
        LEFT + slot * (index as f64 + shift)
    };
    let centre = |index: usize| left_of(index) + slot / 2.0;
    for (class, value) in [
        ("tolerance", (|m| m.tolerance) as fn(&Member) -> f64),
        ("kept", |m| m.kept),
    ] {
        let mut path = String::new();
        for (index, member) in members.iter().enumerate() {
            let start = index == 0 || member.place == Place::Limit;
            let _ = write!(
                path,
                "{}{:.1} {:.1}",
                if start { " M" } else { " L" },
                centre(index),
                height_of(value(member))
            );
            if member.place == Place::Limit && class == "tolerance" {
                // A single point has no line: a short stroke.
                let _ = write!(path, " m{:.1} 0 h{:.1}", -slot / 2.0, slot);
            }
        }
        line(
            svg,
            format!("<path class=\"{class}\" d=\"{}\"/>", path.trim_start()),
        );
    }
    for (index, member) in members.iter().enumerate() {
        let (x, y) = (centre(index), height_of(member.kept));
        line(
            svg,
            format!("<circle class=\"dot\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"2.6\"/>"),
        );
    }
    line(
        svg,
        format!(
            "<rect class=\"frame\" x=\"{LEFT}\" y=\"{TOP}\" width=\"{WIDTH}\" height=\"{HEIGHT}\"/>"
        ),
    );
    for (index, member) in members.iter().enumerate() {
        let word = member.outcome.word();
        let (glyph, class) = match member.outcome {
            Outcome::Right => ("", "mid"),
            Outcome::Undecided => ("?", "mid"),
            Outcome::Wrong(_) => ("×", "mid on-wrong"),
        };
        let label = member.place.label();
        line(
            svg,
            format!(
                "<g><title>{label}: {word}</title><rect class=\"cell {word}\" x=\"{:.1}\" y=\"{:.1}\" width=\"{slot:.1}\" \
                 height=\"{STRIP}\"/><text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\">{glyph}</text></g>",
                left_of(index),
                bottom + 5.0,
                centre(index),
                bottom + 18.0
            ),
        );
        let shown = match member.place {
            Place::Offset(exponent) => exponent % 2 == 1,
            Place::Limit => true,
            Place::Loops(loops) => loops == 1 || loops % 5 == 0,
        };
        if shown {
            line(
                svg,
                format!(
                    "<text class=\"mid\" x=\"{:.1}\" y=\"{:.1}\">{label}</text>",
                    centre(index),
                    bottom + 37.0
                ),
            );
        }
    }
    line(
        svg,
        format!(
            "<text class=\"mid\" x=\"{middle:.1}\" y=\"{:.1}\">{axis}</text>",
            bottom + 54.0
        ),
    );
}
