//! Tables of mechanism families: how counts, ranks and time grow with the size, and how they do not change with the shape.
//!
//! ```text
//! cargo run --release --example tabulate_family [STAGES [PANELS]]
//! ```
//!
//! The scissor lift and the Miura sheet are taken from `kutzbach::families` with N = 1, 2, 5, 10, 20, ... up to STAGES (100
//! if not given) and PANELS a side (10 if not given: a sheet of N × N panels has N² links, and a width of N that the fronts
//! of the elimination grow with). The Bennett linkages are built here from their twist angles.

use kutzbach::families::{miura_sheet, scissor_lift};
use kutzbach::mechanism::{
    Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::number::{Number, NumberError};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let stages = size_or(arguments.next(), 100)?;
    let panels = size_or(arguments.next(), 10)?;

    println!("Scissor lift of N stages");
    print_head("N");
    for size in sizes(stages) {
        print_row(&size.to_string(), &scissor_lift(size)?)?;
    }

    println!("\nMiura sheet of N x N panels");
    print_head("N");
    for size in sizes(panels) {
        print_row(&size.to_string(), &miura_sheet(size, size)?)?;
    }

    println!(
        "\nBennett linkage, twists of 40 degrees and beta, lengths in the ratio of their sines"
    );
    print_head("beta");
    for beta in [50, 60, 75, 90, 105, 120, 140] {
        print_row(&beta.to_string(), &bennett(40, beta, "sin(beta)")?)?;
    }

    println!("\nThe same four hinges with one link longer than Bennett's condition allows");
    print_head("beta");
    for beta in [60, 90, 120] {
        print_row(&beta.to_string(), &bennett(40, beta, "1.05*sin(beta)")?)?;
    }
    Ok(())
}

fn size_or(argument: Option<String>, default: usize) -> Result<usize, String> {
    match argument {
        None => Ok(default),
        Some(text) => text
            .parse()
            .map_err(|_| format!("needed a size, found `{text}`")),
    }
}

/// 1, 2, 5, 10, 20, 50, ...
fn sizes(largest: usize) -> impl Iterator<Item = usize> {
    (0..)
        .flat_map(|exponent| [1, 2, 5].map(|digit| digit * 10usize.saturating_pow(exponent)))
        .take_while(move |size| *size <= largest)
}

fn print_head(first: &str) {
    println!(
        "{first:>6} {:>7} {:>7} {:>9} {:>8} {:>14} {:>10} {:>9}  verdict",
        "links", "joints", "Kutzbach", "generic", "instantaneous", "redundant", "ms"
    );
}

fn print_row(first: &str, mechanism: &Mechanism) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let analysis = analyse(mechanism, &AnalysisOptions::default())?;
    let milliseconds = start.elapsed().as_secs_f64() * 1e3;
    let (instantaneous, redundant) = analysis
        .home
        .as_ref()
        .map_or((None, None), |home| (home.instantaneous, home.redundant));
    let or_dash = |value: Option<String>| value.unwrap_or_else(|| "-".to_owned());
    println!(
        "{first:>6} {:>7} {:>7} {:>9} {:>8} {:>14} {:>10} {milliseconds:>9.1}  {}",
        mechanism.links().len(),
        mechanism.joints().len(),
        analysis.kutzbach,
        analysis.generic.map_or(0, |generic| generic.mobility),
        or_dash(instantaneous.map(|value| value.to_string())),
        or_dash(redundant.map(|value| value.to_string())),
        analysis.mobility.verdict.word()
    );
    Ok(())
}

/// A Bennett linkage (Bennett 1903) with the crank turned by a right angle.
///
/// Opposite links are alike: twists α, β (degrees) and lengths sin α, sin β in metres, which is Bennett's condition. The
/// hinge angles obey `tan(θ₁/2) tan(θ₂/2) = sin((β + α)/2) / sin((β − α)/2)`, so with θ₁ = 90° cosine and sine of θ₂ are
/// algebraic, and the whole geometry is written with exact numbers: the loop closes exactly, not just to rounding.
///
/// `ground` is the expression for the length of the ground link; anything but `sin(beta)` breaks the condition.
fn bennett(alpha: i64, beta: i64, ground: &str) -> Result<Mechanism, Box<dyn Error>> {
    let degrees = |value: i64| number(&format!("radians({value})"), &[]);
    let mut known = vec![("alpha", degrees(alpha)?), ("beta", degrees(beta)?)];
    // Half-angle formulas for θ₂.
    for (name, text) in [
        ("t", "sin((beta + alpha)/2)/sin((beta - alpha)/2)"),
        ("c", "(1 - t**2)/(1 + t**2)"),
        ("s", "2*t/(1 + t**2)"),
        ("a", "sin(alpha)"),
        ("b", "sin(beta)"),
        ("ground", ground),
    ] {
        let value = number(text, &known)?;
        known.push((name, value));
    }
    let triple = |texts: [&str; 3]| -> Result<[Number; 3], NumberError> {
        let [x, y, z] = texts;
        Ok([number(x, &known)?, number(y, &known)?, number(z, &known)?])
    };
    let point = |texts| triple(texts).map(Frame::at);
    let direction = |texts| triple(texts).map(Direction);

    let mut builder = MechanismBuilder::new("bennett");
    builder
        .link("ground")
        .link("crank")
        .link("coupler")
        .link("rocker");
    let hinge = |name: &str, parent: &str, child: &str| {
        JointBuilder::tree(name, JointKind::Revolute, parent, child)
    };
    // The corners are at (0 0 0), (0 a 0), (-b 0 0) and hinge 3; all frames are parallel to the ground's as drawn.
    builder.joint(hinge("hinge_1", "ground", "crank").axis(direction(["0", "0", "1"])?));
    builder.joint(
        hinge("hinge_2", "crank", "coupler")
            .origin(point(["0", "a", "0"])?)
            .axis(direction(["sin(alpha)", "0", "cos(alpha)"])?),
    );
    builder.joint(
        hinge("hinge_4", "ground", "rocker")
            .origin(point(["-ground", "0", "0"])?)
            .axis(direction(["0", "sin(beta)", "cos(beta)"])?),
    );
    builder.joint(
        JointBuilder::closing("hinge_3", JointKind::Revolute, "coupler", "rocker")
            .origin(point(["-b - a*c", "-a - a*s*cos(beta)", "a*s*sin(beta)"])?)
            .successor_origin(point(["-a*c", "-a*s*cos(beta)", "a*s*sin(beta)"])?)
            .axis(direction([
                "-s*sin(alpha)",
                "c*sin(alpha)*cos(beta) + cos(alpha)*sin(beta)",
                "cos(alpha)*cos(beta) - c*sin(alpha)*sin(beta)",
            ])?),
    );
    builder
        .build()
        .map_err(|error: MechanismError| error.into())
}

/// An expression of the format, with names already known.
fn number(text: &str, known: &[(&str, Number)]) -> Result<Number, NumberError> {
    Number::expression(text, &mut |wanted| {
        let found = known.iter().find(|(name, _)| *name == wanted);
        Ok(found.map(|(_, value)| value.clone()))
    })
}
