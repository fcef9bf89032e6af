//! `kutzbach gallery DIR`: a page for every mechanism of a folder and one that leads to them, or a picture of each and an index.

use super::failure::Failure;
use super::{BAD_INPUT, DONE, files, load, output};
use clap::Args;
use kutzbach::report::Options;
use kutzbach::report::html::{
    Assets, Entry, Facts, Prepared, SCRIPT, STYLE, index, script, stills_index, style,
};
use std::any::Any;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Make a page for every mechanism of a folder, and an index with a picture of each
#[derive(Debug, Args)]
pub struct Arguments {
    /// Mechanism files, or folders of them
    #[arg(required = true, value_name = "DIR")]
    paths: Vec<PathBuf>,
    /// Folder to write to; made where it does not exist
    #[arg(short, long, value_name = "OUT")]
    output: PathBuf,
    /// Make no pages: an SVG picture of each mechanism, and an index of them in Markdown (README.md)
    #[arg(long)]
    stills: bool,
    /// Title of the index
    #[arg(long, default_value = "Mechanisms")]
    title: String,
}

/// Runs the command.
///
/// # Errors
/// Where a path does not exist or the output cannot be written. A file that cannot be read, or whose page cannot be made, is told
/// of in the index and on standard error, and all others are still done.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let files = files::mechanism_files(&arguments.paths)?;
    let names = names(&files, if arguments.stills { "svg" } else { "html" });
    std::fs::create_dir_all(&arguments.output).map_err(|error| Failure::Plain {
        message: format!("cannot make `{}`: {error}", arguments.output.display()),
        help: None,
    })?;
    let put = |name: &str, text: &str| output::put(text, Some(&arguments.output.join(name)));
    if !arguments.stills {
        put(SCRIPT, script())?;
        put(STYLE, &style())?;
    }
    let done = files::each(&files, |file| {
        let name = &names[file];
        // A fault of this program in one page is no reason to lose the others.
        let made = std::panic::catch_unwind(|| one(file, name, arguments.stills));
        let (entry, content) = made.unwrap_or_else(|fault| Err(broken(file, &*fault)))?;
        put(name, &content)?;
        Ok(entry)
    });
    let mut code = DONE;
    let mut entries = Vec::new();
    for (file, result) in files.iter().zip(done) {
        entries.push(result.unwrap_or_else(|failure: Failure| {
            code = BAD_INPUT;
            let why = failure.line();
            failure.tell();
            Entry::unreadable(&file.display().to_string(), &why)
        }));
    }
    match arguments.stills {
        true => put("README.md", &stills_index(&arguments.title, &entries))?,
        false => put("index.html", &index(&arguments.title, &entries))?,
    }
    Ok(code)
}

/// What a page that could not be made broke on.
fn broken(file: &Path, fault: &(dyn Any + Send)) -> Failure {
    let text = fault.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| fault.downcast_ref::<&str>().copied());
    Failure::Plain {
        message: format!(
            "{}: its page could not be made, by a fault of this program: {}",
            file.display(),
            text.unwrap_or("no reason is known")
        ),
        help: None,
    }
}

/// Reads, analyses and draws one file: its entry, and its page or still.
fn one(file: &Path, name: &str, still: bool) -> Result<(Entry, String), Failure> {
    let reading = load::mechanism(file, &[], false)?;
    let (report, analysis) = load::analysed(&reading, file, &Options::default())?;
    let facts = Facts {
        mechanism: &reading.mechanism,
        report: &report,
        analysis: &analysis,
        configuration: None,
        verification: None,
        accuracy: None,
    };
    let prepared = Prepared::new(facts, Assets::Beside);
    let text = match still {
        true => prepared.still(),
        false => load::html(&prepared)?,
    };
    Ok((prepared.entry(name), text))
}

/// A name with this extension for every file: its own, numbered where several files have the same.
fn names(files: &[PathBuf], extension: &str) -> BTreeMap<PathBuf, String> {
    let mut used: BTreeMap<String, usize> = BTreeMap::new();
    files
        .iter()
        .map(|file| {
            let stem = file.file_stem().unwrap_or_default().to_string_lossy();
            let safe: String = stem
                .chars()
                .map(|c| {
                    if c.is_alphanumeric() || "-_.".contains(c) {
                        c
                    } else {
                        '_'
                    }
                })
                .collect();
            let count = used.entry(safe.to_lowercase()).or_insert(0);
            *count += 1;
            // An index of the folder is there already.
            let name = match (*count, safe.as_str()) {
                (1, safe) if safe != "index" => format!("{safe}.{extension}"),
                (n, safe) => format!("{safe}-{n}.{extension}"),
            };
            (file.clone(), name)
        })
        .collect()
}
