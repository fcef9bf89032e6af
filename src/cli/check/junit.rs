//! The outcome of a check as JUnit's XML, which programs that build and test show: a suite for every folder, a case for every file.

use super::{Case, Checked, Place};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

/// What became of a case.
enum Result<'a> {
    Passed,
    Skipped(&'a str),
    Failed(String),
    Broken(&'a str),
}

/// The document. What is open fails where the check is strict.
pub fn render(checked: &Checked, strict: bool) -> String {
    let mut suites: BTreeMap<String, Vec<&Case>> = BTreeMap::new();
    for case in &checked.cases {
        let folder = Path::new(&case.file).parent();
        let folder = folder.map_or_else(String::new, |folder| folder.display().to_string());
        suites.entry(folder).or_default().push(case);
    }
    let all: Vec<&Case> = checked.cases.iter().collect();
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let counts = counted(&results(&all, checked, strict));
    // Writing into a string does not fail.
    let _ = writeln!(text, "<testsuites name=\"kutzbach check\"{counts}>");
    for (folder, cases) in &suites {
        let results = results(cases, checked, strict);
        let name = attribute("name", if folder.is_empty() { "." } else { folder });
        let _ = writeln!(text, "  <testsuite{name}{}>", counted(&results));
        for (case, result) in cases.iter().zip(&results) {
            let _ = writeln!(text, "    {}", element(folder, case, result));
        }
        text.push_str("  </testsuite>\n");
    }
    text.push_str("</testsuites>\n");
    text
}

fn results<'a>(cases: &[&'a Case], checked: &Checked, strict: bool) -> Vec<Result<'a>> {
    let results = cases.iter().map(|case| result(case, checked, strict));
    results.collect()
}

fn result<'a>(case: &'a Case, checked: &Checked, strict: bool) -> Result<'a> {
    if let Some(message) = &case.unreadable {
        return Result::Broken(message);
    }
    let rows = checked.disagreements.iter();
    let mut lines: Vec<String> = rows
        .filter(|row| row.file == case.file)
        .map(|row| {
            let wrong = &row.disagreement;
            let place = row.place.as_ref().map(|place| format!("{place}: "));
            format!(
                "{}{}: expected {}, found {}",
                place.unwrap_or_default(),
                wrong.what,
                wrong.expected,
                wrong.found
            )
        })
        .collect();
    if strict {
        lines.extend(case.open.iter().map(|field| format!("{field}: open")));
    }
    match (lines.is_empty(), &case.place) {
        (false, _) => Result::Failed(lines.join("\n")),
        (true, None) if strict => Result::Failed("nothing is known of it".to_owned()),
        (true, None) => Result::Skipped("nothing is known of it"),
        (true, Some(_)) => Result::Passed,
    }
}

fn counted(results: &[Result<'_>]) -> String {
    let count = |wanted: fn(&Result<'_>) -> bool| results.iter().filter(|r| wanted(r)).count();
    format!(
        " tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"",
        results.len(),
        count(|result| matches!(result, Result::Failed(_))),
        count(|result| matches!(result, Result::Broken(_))),
        count(|result| matches!(result, Result::Skipped(_)))
    )
}

fn element(folder: &str, case: &Case, result: &Result<'_>) -> String {
    let stem = Path::new(&case.file).file_stem();
    let name = stem.map_or_else(|| case.file.clone(), |stem| stem.to_string_lossy().into());
    // Of what is wrong in another file, such as `expected.json`, the message tells the line.
    let own = |place: &&Place| place.file == case.file;
    let line = case.place.as_ref().filter(own).map(|place| place.line);
    let line = line.map(|line| attribute("line", &line.to_string()));
    let head = format!(
        "<testcase{}{}{}{}",
        attribute("classname", if folder.is_empty() { "." } else { folder }),
        attribute("name", &name),
        attribute("file", &case.file),
        line.unwrap_or_default()
    );
    let body = match result {
        Result::Passed => return format!("{head}/>"),
        Result::Skipped(why) => format!("<skipped{}/>", attribute("message", why)),
        Result::Failed(lines) => {
            let first = lines.lines().next().unwrap_or_default();
            let message = attribute("message", first);
            format!(
                "<failure{message} type=\"disagreement\">{}</failure>",
                escaped(lines)
            )
        }
        Result::Broken(why) => {
            let message = attribute("message", why);
            format!("<error{message} type=\"unreadable\"/>")
        }
    };
    format!("{head}>{body}</testcase>")
}

fn attribute(name: &str, value: &str) -> String {
    format!(" {name}=\"{}\"", escaped(value))
}

/// Characters that XML does not have become U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' => escaped.push('\n'),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}
