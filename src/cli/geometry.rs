//! `kutzbach geometry FILE`: questions about entities, and scripts.

use super::failure::Failure;
use super::files::cannot_read;
use super::load::{STANDARD_INPUT, standard_input};
use super::{DONE, output};
use clap::Args;
use kutzbach::format::{FormatError, MEMORY};
use kutzbach::number::Number;
use kutzbach::report::text::visible;
use kutzbach_geometry::ask::{Answers, Session, Shown, Told, Transcript};
use kutzbach_geometry::{Answer, Certainty, Legible, Measured, Reading, TextError, read_world};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// What the data are, for who reads them.
const SCHEMA: &str = "kutzbach-geometry-1";

/// Ask what points, lines, planes, faces, solids and round surfaces are to each other
#[derive(Debug, Args)]
pub struct Arguments {
    /// Text that names entities; `-` for standard input. Without a question all of them are listed
    file: PathBuf,
    /// Answer a question: `distance(pin, plate.top)`, or with free names `parallel(?f, plate.top)`; may be repeated
    #[arg(long, value_name = "QUESTION")]
    ask: Vec<String>,
    /// Run a script of questions and constructions and write its transcript, which is a script again
    #[arg(long, value_name = "FILE", conflicts_with = "ask")]
    script: Option<PathBuf>,
    /// Take decimals as known to half a unit of their last place, and answer `within the digits` where that leaves a doubt; if not
    /// given, they are exact
    #[arg(long)]
    tolerant: bool,
    /// Write data for a program
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    destination: output::Destination,
}

/// Runs the command.
///
/// # Errors
/// Where a text says no entities, a question has no answer, or the output cannot be written.
pub fn run(arguments: &Arguments) -> Result<u8, Failure> {
    let both =
        arguments.script.as_deref() == Some(Path::new("-")) && arguments.file == Path::new("-");
    if both {
        return Err(Failure::Plain {
            message: "needed one text from standard input, found two: FILE and the script"
                .to_owned(),
            help: Some("write one of both to a file".to_owned()),
        });
    }
    let text = match arguments.tolerant {
        false => answered::<Number>(arguments)?,
        true => answered::<Measured>(arguments)?,
    };
    arguments.destination.put(&text)?;
    Ok(DONE)
}

fn answered<S: Legible>(arguments: &Arguments) -> Result<String, Failure> {
    let reading: Reading<S> = world(&arguments.file)?;
    let mut session = Session::from(reading);
    let data = |key: &str, value: Value| {
        let mut data = json!({
            "schema": SCHEMA,
            "file": arguments.file.display().to_string(),
            "form": if arguments.tolerant { "tolerant" } else { "exact" },
        });
        data[key] = value;
        output::json(&data)
    };
    if let Some(script) = &arguments.script {
        let (name, text) = read(script)?;
        let transcript = session.run(&text).map_err(|error| in_file(&name, error))?;
        return match arguments.json {
            true => data("lines", transcript_data(&transcript)),
            false => Ok(told(&transcript.text())),
        };
    }
    let mut asked = Vec::new();
    for question in &arguments.ask {
        let answers = session
            .ask(question)
            .map_err(|error| in_question(question, error))?;
        asked.push((question, answers));
    }
    if asked.is_empty() {
        let transcript = session
            .run("list")
            .map_err(|error| in_question("list", error))?;
        return match arguments.json {
            true => data("lines", transcript_data(&transcript)),
            false => {
                let replies = transcript
                    .lines
                    .iter()
                    .filter_map(|line| line.reply.as_ref());
                let lines: Vec<String> = replies.flat_map(|reply| reply.told.lines()).collect();
                Ok(told(&lines_text(&lines)))
            }
        };
    }
    if arguments.json {
        let all = asked.iter().map(|(question, answers)| {
            let mut data = answers_data(answers);
            data["question"] = json!(question);
            data
        });
        return data("questions", all.collect());
    }
    let mut lines = Vec::new();
    for (question, answers) in &asked {
        if asked.len() > 1 {
            lines.push(format!("{question}:"));
        }
        lines.extend(answers.lines());
    }
    Ok(told(&lines_text(&lines)))
}

fn lines_text(lines: &[String]) -> String {
    lines.iter().map(|line| format!("{line}\n")).collect()
}

/// What would steer a terminal is written out; tabs do not.
fn told(text: &str) -> String {
    let line = |line: &str| {
        let parts: Vec<String> = line
            .split('\t')
            .map(|part| visible(part).into_owned())
            .collect();
        parts.join("\t")
    };
    text.lines().map(|own| line(own) + "\n").collect()
}

/// The name and the text of a file, or of standard input.
pub fn read(file: &Path) -> Result<(String, String), Failure> {
    if file == Path::new("-") {
        return Ok((STANDARD_INPUT.to_owned(), standard_input(MEMORY)?));
    }
    let text = std::fs::read_to_string(file).map_err(|error| cannot_read(file, &error))?;
    Ok((file.display().to_string(), text))
}

/// Reads the entities of a file.
pub fn world<S: Legible>(file: &Path) -> Result<Reading<S>, Failure> {
    let (name, text) = read(file)?;
    read_world(&text).map_err(|error| in_file(&name, error))
}

/// What is wrong with a file, where it stands.
pub fn in_file(file: &str, error: TextError) -> Failure {
    Failure::from(FormatError {
        message: error.message,
        help: error.help,
        line: error.line,
        column: error.column,
        span: error.span,
        file: file.to_owned(),
        others: Box::new([]),
    })
}

fn in_question(question: &str, error: TextError) -> Failure {
    Failure::Plain {
        message: format!("`{question}`, column {}: {}", error.column, error.message),
        help: error.help,
    }
}

/// The word of an answer in data.
pub fn word(answer: Answer) -> &'static str {
    match answer {
        Answer::Yes => "yes",
        Answer::No => "no",
        Answer::WithinDigits => "within digits",
        Answer::Indistinguishable => "indistinguishable",
    }
}

fn certainty_word(certainty: Certainty) -> &'static str {
    match certainty {
        Certainty::Proven => "proven",
        Certainty::Indistinguishable => "indistinguishable",
        Certainty::WithinDigits => "within digits",
    }
}

/// A value; lists are nested no deeper than questions.
fn shown_data(shown: &Shown) -> Value {
    let mut data = json!({ "text": shown.text });
    if let Some(kind) = shown.kind {
        data["kind"] = json!(kind.to_string());
    }
    if let Some(number) = shown.number {
        data["number"] = json!(number);
    }
    if !shown.members.is_empty() {
        data["members"] = shown.members.iter().map(shown_data).collect();
    }
    data
}

fn answers_data(answers: &Answers) -> Value {
    let rows = answers.rows.iter().map(|row| {
        let names = answers.names.iter().zip(&row.found);
        let found: serde_json::Map<String, Value> = names
            .map(|(name, shown)| (name.clone(), shown_data(shown)))
            .collect();
        let values: Vec<Value> = row.values.iter().map(shown_data).collect();
        json!({ "found": found, "values": values, "holds": word(row.holds) })
    });
    json!({
        "names": answers.names,
        "answers": rows.collect::<Vec<Value>>(),
        "tried": answers.tried,
        "without_value": answers.without_value,
        "first_without_value": answers.first_without_value,
    })
}

fn named_data(all: &[(String, Shown)]) -> Value {
    let one = |(name, shown): &(String, Shown)| {
        let mut data = shown_data(shown);
        data["name"] = json!(name);
        data
    };
    all.iter().map(one).collect()
}

fn transcript_data(transcript: &Transcript) -> Value {
    let replies = transcript.lines.iter().filter_map(|line| {
        let reply = line.reply.as_ref()?;
        let mut data = match &reply.told {
            Told::Answers(answers) => answers_data(answers),
            Told::Made { made, certainty } => {
                json!({ "made": named_data(made), "certainty": certainty_word(*certainty) })
            }
            Told::Deleted(count) => json!({ "deleted": count }),
            Told::Listed(all) => json!({ "listed": named_data(all) }),
            // A new name changes nothing else.
            _ => json!({ "renamed": true }),
        };
        data["line"] = json!(reply.line);
        data["source"] = json!(line.source);
        Some(data)
    });
    replies.collect()
}
