//! Draws how the verdict holds along families of mechanisms that come, as a small number vanishes, to one that moves
//! otherwise, and along chains that grow.
//!
//! ```text
//! cargo run --release --example families_figure [FILE]
//! ```
//!
//! writes the figure of `docs/src/families.md` to FILE (`docs/src/images/families.svg` if not given) and prints a table of
//! the verdicts. `tests/families.rs` compares the figure in the repository with what is found now.

mod figure;

use figure::{Member, cases, families_of, look, render};
use kutzbach::families::Outcome;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args()
        .nth(1)
        .unwrap_or_else(|| "docs/src/images/families.svg".to_owned());
    let members = cases()?
        .iter()
        .map(look)
        .collect::<Result<Vec<Member>, _>>()?;
    println!(
        "{:26} {:>5} {:>9} {:>5}",
        "family", "right", "undecided", "wrong"
    );
    for family in families_of(&members) {
        let count = |word: &str| {
            let of = members.iter().filter(|m| m.family == family);
            of.filter(|m| m.outcome.word() == word).count()
        };
        println!(
            "{family:26} {:>5} {:>9} {:>5}",
            count("right"),
            count("undecided"),
            count("wrong")
        );
    }
    for member in &members {
        let reasons = match &member.outcome {
            Outcome::Right => continue,
            Outcome::Undecided => &member.why,
            Outcome::Wrong(reasons) => reasons,
        };
        let (family, place) = (member.family, member.place.label());
        println!(
            "{family} {place}, {}: {}",
            member.outcome.word(),
            reasons.join("; ")
        );
    }
    std::fs::write(&file, render(&members))?;
    println!("wrote {file}");
    Ok(())
}
