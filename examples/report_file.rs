//! Reads a mechanism file and prints what its analysis says, field by field.
//!
//! ```text
//! cargo run --example report_file -- mechanisms/sarrus.urdf [CONFIGURATION]
//! ```
//!
//! The ready-made page of the command line comes from `kutzbach::report`; this example shows where its facts come from.

use kutzbach::format::{Reading, read_file};
use kutzbach::mechanism::Mechanism;
use kutzbach::mobility::{Analysis, AnalysisOptions, JointRole, analyse};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let file = arguments
        .next()
        .ok_or("needed a mechanism file: report_file FILE [CONFIGURATION]")?;
    let options = AnalysisOptions {
        configuration: arguments.next(),
        ..AnalysisOptions::default()
    };

    let Reading {
        mechanism,
        warnings,
        skipped,
        format,
        ..
    } = read_file(&file, &[])?;
    for warning in &warnings {
        eprintln!("{file}:{}: {}", warning.line, warning.message);
    }
    println!(
        "{} ({format}): {} links, {} joints, {} couplings; {} elements not read",
        mechanism.name(),
        mechanism.links().len(),
        mechanism.joints().len(),
        mechanism.couplings().len(),
        skipped.len()
    );

    let analysis = analyse(&mechanism, &options)?;
    print_verdict(&analysis);
    print_counts(&analysis);
    print_joints(&mechanism, &analysis);
    Ok(())
}

fn print_verdict(analysis: &Analysis) {
    let mobility = &analysis.mobility;
    println!("\nverdict        {}", mobility.verdict.word());
    println!(
        "finite         {}",
        match (mobility.finite(), mobility.bounds) {
            (Some(finite), _) => finite.to_string(),
            (None, (Some(low), Some(high))) => format!("between {low} and {high}"),
            (None, _) => "unknown".to_owned(),
        }
    );
    println!("because        {}", mobility.certificate);
    for reason in &mobility.why {
        println!("               {reason}");
    }
}

fn print_counts(analysis: &Analysis) {
    println!("\nKutzbach       {:>4}", analysis.kutzbach);
    if let Some(generic) = analysis.generic {
        println!("generic        {:>4}", generic.mobility);
    }
    // Without a closed pose there is nothing to rank.
    if let Some(home) = &analysis.home {
        println!("instantaneous  {:>4}", or_dash(home.instantaneous));
        println!("redundant      {:>4}", or_dash(home.redundant));
    }
}

fn print_joints(mechanism: &Mechanism, analysis: &Analysis) {
    let name = |link: kutzbach::mechanism::LinkId| mechanism.link(link).name.as_str();
    let width = mechanism
        .joints()
        .iter()
        .map(|joint| joint.name.chars().count())
        .fold("joint".len(), usize::max);
    println!("\n{:width$}  class  role              links", "joint");
    for (joint, role) in mechanism.joints().iter().zip(&analysis.roles) {
        println!(
            "{:width$}  {:<5}  {:<16}  {} - {}",
            joint.name,
            joint.kind.class(),
            role_in_words(joint.freedom(), role),
            name(joint.predecessor.link),
            name(joint.successor.link),
        );
    }
}

fn role_in_words(freedom: usize, role: &JointRole) -> String {
    match role.locked {
        _ if freedom == 0 => "rigid".to_owned(),
        Some(true) => "locked".to_owned(),
        Some(false) if role.locked_parts.is_empty() => "moves".to_owned(),
        Some(false) => format!("but for {}", role.locked_parts.join(", ")),
        None => "not known".to_owned(),
    }
}

fn or_dash(value: Option<impl ToString>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| value.to_string())
}
