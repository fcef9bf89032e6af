//! Builds a Sarrus linkage in code, analyses it, and relaxes the joint that the advice names.
//!
//! ```text
//! cargo run --example build_in_code
//!
//!            platform
//!          o----------o        two legs of three parallel hinges each; the hinges of one leg run along y,
//!         /            \       those of the other along x
//!        o knee    knee o
//!         \            /       Kutzbach: 6 (6 - 1) - 6 (6 - 1) = 0, and yet the platform rises and sinks
//!          o----------o
//!              base
//! ```

use kutzbach::mechanism::{
    Direction, Frame, JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};
use kutzbach::mobility::{AnalysisOptions, analyse};
use kutzbach::number::Number;
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    describe(&sarrus("sarrus", JointKind::Revolute)?)?;

    println!("\nA ball instead of the last hinge takes the repeated constraint away:\n");
    describe(&sarrus("sarrus_with_ball", JointKind::Spherical)?)?;

    // What contradicts itself is told with the joint it is about, and does not become a mechanism.
    let mut wrong = MechanismBuilder::new("wrong");
    wrong.link("base").link("platform");
    wrong.joint(JointBuilder::tree(
        "rise",
        JointKind::Prismatic,
        "base",
        "platfrom",
    ));
    if let Err(error) = wrong.build() {
        let help = error.help.as_deref().unwrap_or("no help");
        println!("\nA builder that contradicts itself: {error}; {help}");
    }
    Ok(())
}

/// A tenth of a metre is no binary fraction, so lengths are given in tenths.
fn at(x: i64, y: i64, z: i64) -> Frame {
    Frame::at([x, y, z].map(tenths))
}

fn tenths(value: i64) -> Number {
    Number::ratio(value, 10).unwrap_or_else(Number::zero)
}

fn along(x: i64, y: i64, z: i64) -> Direction {
    Direction([x, y, z].map(Number::integer))
}

/// `last` is the joint between the second leg and the platform.
fn sarrus(name: &str, last: JointKind) -> Result<Mechanism, MechanismError> {
    let (x, y) = (along(1, 0, 0), along(0, 1, 0));
    let hinge = |name: &str, parent: &str, child: &str, axis: &Direction| {
        JointBuilder::tree(name, JointKind::Revolute, parent, child).axis(axis.clone())
    };
    let mut builder = MechanismBuilder::new(name);
    builder.link("base").link("platform");
    builder.link("lower_1").link("upper_1");
    builder.link("lower_2").link("upper_2");

    // Every link's frame lies in the joint that places it, so an origin is a step along the leg.
    builder.joint(hinge("foot_1", "base", "lower_1", &y).origin(at(10, 0, 0)));
    builder.joint(hinge("knee_1", "lower_1", "upper_1", &y).origin(at(8, 0, 6)));
    builder.joint(hinge("hip_1", "upper_1", "platform", &y).origin(at(-8, 0, 6)));
    builder.joint(hinge("foot_2", "base", "lower_2", &x).origin(at(0, 10, 0)));
    builder.joint(hinge("knee_2", "lower_2", "upper_2", &x).origin(at(0, 8, 6)));
    // The platform is placed by the first leg; the second one closes the loop, with a frame on either side.
    builder.joint(
        JointBuilder::closing("hip_2", last, "upper_2", "platform")
            .origin(at(0, -8, 6))
            .successor_origin(at(-10, 10, 0))
            .axis(x),
    );
    builder.build()
}

fn describe(mechanism: &Mechanism) -> Result<(), Box<dyn Error>> {
    let analysis = analyse(mechanism, &AnalysisOptions::default())?;
    let home = analysis
        .home
        .as_ref()
        .ok_or("the mechanism does not assemble")?;
    let (Some(instantaneous), Some(redundant)) = (home.instantaneous, home.redundant) else {
        return Err("the rank is open".into());
    };
    println!(
        "{}: Kutzbach {}, instantaneous {instantaneous}, redundant {redundant}, verdict {}",
        mechanism.name(),
        analysis.kutzbach,
        analysis.mobility.verdict.word()
    );
    for (joint, role) in mechanism.joints().iter().zip(&analysis.roles) {
        let does = match role.locked {
            Some(true) => "is locked",
            Some(false) => "moves",
            None => "may move",
        };
        println!("  {:<7} {:<10} {does}", joint.name, joint.kind.word());
    }
    for advice in &analysis.advice {
        println!(
            "  advice: make {} a {} joint: {} redundant constraints instead of {}",
            mechanism.joints()[advice.joint].name,
            advice.to,
            advice.redundant_after,
            advice.redundant_before
        );
    }
    Ok(())
}
