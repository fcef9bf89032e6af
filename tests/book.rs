//! What the book says exists: names of the library, fields of reports, files, pages, and what the program prints.
use crate::support;

use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use support::folder;

/// The pages of the book by file name, and the README.
fn pages() -> Vec<(String, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(folder("docs/src"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect();
    paths.push(folder("README.md"));
    paths.sort();
    paths
        .into_iter()
        .map(|path| {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            (name, fs::read_to_string(path).unwrap())
        })
        .collect()
}

/// What stands between backticks in the running text of a page.
fn code(page: &str) -> Vec<&str> {
    let prose = page.split("```").step_by(2);
    prose
        .flat_map(|p| p.split('`').skip(1).step_by(2))
        .collect()
}

/// The sources of a module: its own file, and everything below its folder.
fn sources(module: &Path) -> Vec<String> {
    let mut texts = Vec::new();
    if let Ok(text) = fs::read_to_string(module.with_extension("rs")) {
        texts.push(text);
    }
    for entry in fs::read_dir(module).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            texts.extend(sources(&path));
        } else if path.extension().is_some_and(|e| e == "rs") {
            texts.push(fs::read_to_string(path).unwrap());
        }
    }
    texts
}

fn words(text: &str) -> impl Iterator<Item = &str> {
    text.split(|c: char| !(c.is_alphanumeric() || c == '_'))
}

/// Whether a source declares a public item of this name.
fn declares(source: &str, item: &str) -> bool {
    let kinds = [
        "fn", "const fn", "struct", "enum", "trait", "type", "const", "mod",
    ];
    source.lines().any(|line| {
        kinds.iter().any(|kind| {
            line.trim_start()
                .strip_prefix(&format!("pub {kind} "))
                .is_some_and(|rest| words(rest).next() == Some(item))
        })
    })
}

/// The modules of the library, each with the folder of its sources, from what the facade exports.
fn modules() -> BTreeMap<String, PathBuf> {
    let mut found = BTreeMap::new();
    for statement in include_str!("../src/lib.rs")
        .split("pub use kutzbach_")
        .skip(1)
    {
        let statement = statement.split(';').next().unwrap();
        let name = words(statement).next().unwrap();
        let sources = folder("crates").join(name).join("src");
        let list = statement[name.len()..].trim_start_matches("::");
        match list {
            // What a module of the facade itself is made of.
            "*" => {
                found.insert("record".to_owned(), sources);
                continue;
            }
            item if item.starts_with(char::is_uppercase) => continue,
            _ => {}
        }
        for entry in list.trim_matches(['{', '}']).split(',') {
            match entry.rsplit_once("as ") {
                Some((_, module)) => found.insert(module.trim().to_owned(), sources.clone()),
                None => found.insert(entry.trim().to_owned(), sources.join(entry.trim())),
            };
        }
    }
    found
}

/// The file that says what a folder of sources exports.
fn root(module: &Path) -> String {
    [module.join("lib.rs"), module.join("mod.rs")]
        .into_iter()
        .chain([module.with_extension("rs")])
        .find_map(|path| fs::read_to_string(path).ok())
        .unwrap()
}

/// Why there is no such item in the library; `None` where it exists and can be reached by this path.
fn missing(path: &str) -> Option<String> {
    let mut segments = path.strip_prefix("kutzbach::").unwrap_or(path).split("::");
    let first = segments.next()?;
    let Some(mut module) = modules().remove(first) else {
        return Some(format!("`{path}`: the library has no `{first}`"));
    };
    let mut root = self::root(&module);
    let item = loop {
        let segment = segments.next()?;
        if !root.contains(&format!("pub mod {segment};")) {
            break segment;
        }
        module = module.join(segment);
        root = self::root(&module);
    };
    let exported = declares(&root, item)
        || root
            .split("pub use ")
            .skip(1)
            .any(|rest| words(rest.split(';').next().unwrap_or("")).any(|w| w == item));
    if !exported {
        return Some(format!(
            "`{path}`: {} exports no `{item}`",
            module.display()
        ));
    }
    let sources = sources(&module);
    let Some(source) = sources.iter().find(|s| declares(s, item)) else {
        return Some(format!("`{path}`: no `{item}` below {}", module.display()));
    };
    let member = segments.next()?;
    let owns = |source: &String| {
        source.contains(&format!("impl {item}"))
            && (declares(source, member) || source.contains(&format!("pub const fn {member}(")))
    };
    let field = source.contains(&format!("pub {member}: "));
    (!field && !sources.iter().any(owns)).then(|| format!("`{path}`: `{item}` has no `{member}`"))
}

#[test]
fn every_path_into_the_library_leads_somewhere() {
    let modules = modules();
    assert_eq!(modules.len(), 19);
    let mut seen = 0;
    for (page, text) in pages() {
        for path in code(&text) {
            let own = path.strip_prefix("kutzbach::").unwrap_or(path);
            let Some((module, _)) = own.split_once("::") else {
                continue;
            };
            let into_library = path.starts_with("kutzbach::") || modules.contains_key(module);
            if !into_library || path.contains(|c: char| !(c.is_alphanumeric() || "_:".contains(c)))
            {
                continue;
            }
            seen += 1;
            if let Some(why) = missing(path) {
                panic!("{page}: {why}");
            }
        }
    }
    assert!(seen > 30, "only {seen} paths were found in the book");
}

#[test]
fn paths_that_lead_nowhere_are_found_out() {
    for path in [
        "kutzbach::mobility::decide_all",
        "kutzbach::mobility::singular_finding",
        "kutzbach::nowhere::judge",
        "kutzbach::mechanism::JointKind::weight",
        "mechanism::Joint::colour",
        "report::kutzbach_count",
    ] {
        assert!(missing(path).is_some(), "{path}");
    }
    for path in [
        "kutzbach::closure",
        "mechanism::Joint::lead",
        "report::text::render",
    ] {
        assert_eq!(missing(path), None);
    }
}

fn printed(arguments: &[&str]) -> String {
    let run = crate::support::program()
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    String::from_utf8([run.stdout, run.stderr].concat()).unwrap()
}

/// Follows `branches[].idle` into a report.
fn has_field(report: &Value, field: &str) -> bool {
    let mut here = report;
    for step in field.split('.') {
        let name = step.trim_end_matches("[]");
        let Some(inner) = here.get(name) else {
            return false;
        };
        here = inner;
        if step.ends_with("[]") {
            let Some(first) = here.get(0) else {
                return false;
            };
            here = first;
        }
    }
    true
}

#[test]
fn the_summary_lists_every_page_and_only_those() {
    let listed: BTreeSet<&str> = include_str!("../docs/src/SUMMARY.md")
        .split("](")
        .skip(1)
        .filter_map(|rest| rest.split(')').next())
        .collect();
    let there = pages();
    let there: BTreeSet<&str> = there
        .iter()
        .map(|(name, _)| name.as_str())
        .filter(|name| !["SUMMARY.md", "README.md"].contains(name))
        .collect();
    assert_eq!(listed, there);
}

#[test]
fn links_and_sources_that_a_page_names_exist() {
    for (page, text) in pages() {
        let base = if page == "README.md" {
            folder("")
        } else {
            folder("docs/src")
        };
        for link in text
            .split("](")
            .skip(1)
            .filter_map(|rest| rest.split(')').next())
        {
            let path = link.split('#').next().unwrap();
            if !path.is_empty() && !path.contains("://") {
                assert!(base.join(path).exists(), "{page}: {link}");
            }
        }
        for path in code(&text)
            .into_iter()
            .filter(|c| c.starts_with("src/") || c.starts_with("crates/"))
        {
            assert!(folder(path).exists(), "{page}: {path}");
        }
    }
}

/// Blocks that open with `$ kutzbach …` show the program's own words; a line `...` stands for lines left out.
#[test]
fn what_the_book_shows_is_what_the_program_prints() {
    let mut shown = 0;
    for (page, text) in pages() {
        for block in text.split("```text\n$ kutzbach ").skip(1) {
            let block = block.split("\n```").next().unwrap();
            let (command, expected) = block.split_once('\n').unwrap();
            let output = printed(&command.split_whitespace().collect::<Vec<_>>());
            let mut rest = output.as_str();
            for piece in expected.split("\n...\n") {
                let piece = piece.trim_end_matches("\n...").trim_start_matches("...\n");
                let Some(at) = rest.find(piece) else {
                    panic!("{page}: `kutzbach {command}` does not print\n{piece}\nbut\n{output}");
                };
                rest = &rest[at + piece.len()..];
            }
            shown += 1;
        }
    }
    assert!(shown >= 4, "only {shown} blocks were found");
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn every_field_that_a_definition_names_is_in_a_report() {
        // Several definitions name the same command.
        let mut asked: BTreeMap<Vec<&str>, Value> = BTreeMap::new();
        // One at a singular pose, one with the facts of four-bars, and one of rounded numbers.
        let files = [
            "mechanisms/kite_equal_bars",
            "mechanisms/planar_four_bar",
            "tests/zoo/bennett_ratio2",
        ];
        let reports = files.map(|name| -> Value {
            let file = format!("{name}.urdf");
            let report = printed(&["report", &file, "--format", "json", "--evidence"]);
            serde_json::from_str(&report).unwrap()
        });
        let mut seen = 0;
        for definition in kutzbach::report::definitions::all() {
            let (_, decided) = definition.body.split_once("Decided by:").unwrap();
            // Fields after the name of another command are those of its output.
            let mut other = None;
            for field in code(decided)
                .into_iter()
                .filter(|c| !c.contains("::") && !c.starts_with("--"))
            {
                if let Some(command) = field.strip_prefix("kutzbach ") {
                    let mut arguments: Vec<&str> = command.split_whitespace().collect();
                    arguments.extend(["mechanisms/planar_four_bar.urdf", "--format", "json"]);
                    let answer = asked.entry(arguments.clone());
                    let answer = answer
                        .or_insert_with(|| serde_json::from_str(&printed(&arguments)).unwrap());
                    other = Some(answer.clone());
                    continue;
                }
                let told = match &other {
                    Some(other) => has_field(other, field),
                    None => reports.iter().any(|report| has_field(report, field)),
                };
                assert!(told, "{}: {field}", definition.number);
                seen += 1;
            }
        }
        assert!(seen > 25, "only {seen} fields were found");
        assert!(!has_field(&reports[0], "home.mass") && !has_field(&reports[0], "joints[].mass"));
    }
}
