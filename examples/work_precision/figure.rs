//! The figure: wall time over closure error, both axes logarithmic.

use super::measure::{SOLVERS, SUBJECTS};
use super::record::Record;
use std::fmt::Write;

// All measures in pixels.
const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 500.0;
const LEFT: f64 = 78.0;
const RIGHT: f64 = 836.0;
const TOP: f64 = 64.0;
const BOTTOM: f64 = 440.0;

/// The frame in powers of ten: closure errors, then seconds. What is measured has room to double.
const ERRORS: (f64, f64) = (-16.0, -2.0);
const SECONDS: (f64, f64) = (-3.0, 1.0);

/// Colours by light and by dark, one for each solver and one for the trace.
const STYLE: &str = "text{font:12px system-ui,Helvetica,Arial,sans-serif;fill:#223}.title{font-weight:600;font-size:14px}\
    .mid{text-anchor:middle}.end{text-anchor:end}.small{font-size:11px}.back{fill:#fff}.frame{fill:none;stroke:#9ab}\
    .grid{stroke:#e3e9ee}.multibody{stroke:#1f4e9c;fill:#1f4e9c}.impulses{stroke:#b3541e;fill:#b3541e}\
    .trace{stroke:#1b7f5c;fill:#1b7f5c}.line{fill:none;stroke-width:1.6}.hollow{fill:#fff;stroke-width:1.6}\
    @media(prefers-color-scheme:dark){text{fill:#dde3ea}.back,.hollow{fill:#161b22}.frame{stroke:#56616d}\
    .grid{stroke:#2a323b}.multibody{stroke:#7fb0ff;fill:#7fb0ff}.impulses{stroke:#f2a26b;fill:#f2a26b}\
    .trace{stroke:#5fd3a5;fill:#5fd3a5}.line{fill:none}.hollow{fill:#161b22}}";

fn x_of(error: f64) -> f64 {
    along(error, ERRORS, LEFT, RIGHT)
}

fn y_of(seconds: f64) -> f64 {
    along(seconds, SECONDS, BOTTOM, TOP)
}

/// Where a number comes to lie between two ends; outside the frame, on its border.
fn along(value: f64, (low, high): (f64, f64), from: f64, to: f64) -> f64 {
    let share = (value.max(1e-300).log10() - low) / (high - low);
    from + (to - from) * share.clamp(0.0, 1.0)
}

/// Draws the figure.
#[must_use]
pub fn render(record: &Record) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH:.0} {HEIGHT:.0}\" width=\"{WIDTH:.0}\" \
         height=\"{HEIGHT:.0}\" role=\"img\">\n<title>Wall time of one turn over its closure error</title>\n\
         <style>{STYLE}</style>\n<rect class=\"back\" width=\"100%\" height=\"100%\"/>\n"
    );
    axes(&mut svg);
    legend(&mut svg);
    for (index, subject) in SUBJECTS.iter().enumerate() {
        for (_, solver) in SOLVERS {
            ladder(&mut svg, record, subject.name, solver, index);
        }
        traces(&mut svg, record, subject.name, index);
    }
    svg.push_str("</svg>\n");
    svg
}

fn line(svg: &mut String, text: String) {
    // Writing to a string does not fail.
    let _ = writeln!(svg, "{text}");
}

fn text(svg: &mut String, class: &str, (x, y): (f64, f64), what: &str) {
    line(
        svg,
        format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{what}</text>"),
    );
}

fn axes(svg: &mut String) {
    for power in ERRORS.0 as i32..=ERRORS.1 as i32 {
        let x = x_of(10f64.powi(power));
        line(
            svg,
            format!("<path class=\"grid\" d=\"M{x:.1} {TOP}V{BOTTOM}\"/>"),
        );
        if power % 2 == 0 {
            text(svg, "mid", (x, BOTTOM + 18.0), &format!("1e{power}"));
        }
    }
    for power in SECONDS.0 as i32..=SECONDS.1 as i32 {
        let y = y_of(10f64.powi(power));
        line(
            svg,
            format!("<path class=\"grid\" d=\"M{LEFT} {y:.1}H{RIGHT}\"/>"),
        );
        let label = match power {
            -3 => "1 ms".to_owned(),
            -2 => "10 ms".to_owned(),
            -1 => "0.1 s".to_owned(),
            _ => format!("{} s", 10f64.powi(power)),
        };
        text(svg, "end", (LEFT - 8.0, y + 4.0), &label);
    }
    line(
        svg,
        format!(
            "<rect class=\"frame\" x=\"{LEFT}\" y=\"{TOP}\" width=\"{}\" height=\"{}\"/>",
            RIGHT - LEFT,
            BOTTOM - TOP
        ),
    );
    let middle = 0.5 * (LEFT + RIGHT);
    text(
        svg,
        "mid",
        (middle, BOTTOM + 42.0),
        "largest closure error during the turn (characteristic lengths, rad)",
    );
    line(
        svg,
        format!(
            "<text class=\"mid\" transform=\"translate(18 {:.1}) rotate(-90)\">wall time of one turn</text>",
            0.5 * (TOP + BOTTOM)
        ),
    );
}

fn legend(svg: &mut String) {
    text(
        svg,
        "title",
        (LEFT, 22.0),
        "One driven turn: simulated with 1 to 256 substeps, and traced",
    );
    let mut x = LEFT;
    for (class, words) in [
        ("multibody", "multibody"),
        ("impulses", "impulses"),
        ("trace", "trace"),
    ] {
        line(
            svg,
            format!("<rect class=\"{class}\" x=\"{x:.1}\" y=\"36\" width=\"18\" height=\"10\"/>"),
        );
        text(svg, "", (x + 24.0, 45.0), words);
        x += 100.0;
    }
    for (index, subject) in SUBJECTS.iter().enumerate() {
        mark(svg, "multibody", (x, 41.0), index, 4.0);
        text(svg, "", (x + 11.0, 45.0), subject.name);
        x += 90.0;
    }
    text(
        svg,
        "end small",
        (RIGHT, 45.0),
        "numbers: substeps, or poses of a turn",
    );
}

/// A point: full and round for the first mechanism, hollow and square for the second.
fn mark(svg: &mut String, class: &str, (x, y): (f64, f64), mechanism: usize, size: f64) {
    line(
        svg,
        if mechanism == 0 {
            format!("<circle class=\"{class}\" cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{size}\"/>")
        } else {
            let side = 2.0 * size;
            let (left, top) = (x - size, y - size);
            format!(
                "<rect class=\"{class} hollow\" x=\"{left:.1}\" y=\"{top:.1}\" width=\"{side}\" height=\"{side}\"/>"
            )
        },
    );
}

fn ladder(svg: &mut String, record: &Record, mechanism: &str, solver: &str, index: usize) {
    let points: Vec<(usize, f64, f64)> = record
        .ladder(mechanism, solver)
        .map(|row| (row.substeps, x_of(row.closure_error), y_of(row.wall_time)))
        .collect();
    let path: Vec<String> = points
        .iter()
        .map(|(_, x, y)| format!("{x:.1} {y:.1}"))
        .collect();
    let dashes = if index == 0 {
        ""
    } else {
        " stroke-dasharray=\"5 3\""
    };
    line(
        svg,
        format!(
            "<path class=\"line {solver}\" d=\"M{}\"{dashes}/>",
            path.join(" L")
        ),
    );
    for (substeps, x, y) in points {
        mark(svg, solver, (x, y), index, 3.2);
        // The lines in between lie too close to one another, and their points as high as the outer ones.
        match (index, solver) {
            (0, "multibody") => text(svg, "small end", (x - 7.0, y + 12.0), &substeps.to_string()),
            (1, "impulses") => text(svg, "small", (x + 7.0, y - 4.0), &substeps.to_string()),
            _ => {}
        }
    }
}

fn traces(svg: &mut String, record: &Record, mechanism: &str, index: usize) {
    for trace in record.traces_of(mechanism) {
        let (x, y) = (x_of(trace.closure_error), y_of(trace.wall_time));
        mark(svg, "trace", (x, y), index, 4.0);
        // Both mechanisms lie side by side: one label for the two, behind the second.
        if index + 1 == SUBJECTS.len() {
            let poses = format!("{} poses", trace.poses);
            text(svg, "small", (x + 12.0, y + 4.0), &poses);
        }
    }
}
