//! Plain shapes of any size, to see how cost grows: trees, rings, gear trains, loops side by side.

use super::{along, at};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{
    JointBuilder, JointKind, Mechanism, MechanismBuilder, MechanismError,
};

/// A hinge a metre and a half from that of the parent link, its axis along x, y or z in turn.
fn hinge(number: usize, parent: &str, child: &str) -> JointBuilder {
    let axis = [along(1, 0, 0), along(0, 1, 0), along(0, 0, 1)][number % 3].clone();
    JointBuilder::tree(
        &format!("hinge_{number}"),
        JointKind::Revolute,
        parent,
        child,
    )
    .origin(at(100, 100, 50))
    .axis(axis)
}

/// A tree of hinges: `parent` says which link each hangs on, 0 being the ground and others counted from 1.
fn tree(
    name: &str,
    hinges: usize,
    parent: impl Fn(usize) -> usize,
) -> Result<Mechanism, MechanismError> {
    let link = |number: usize| match number {
        0 => "ground".to_owned(),
        _ => format!("link_{number}"),
    };
    let mut builder = MechanismBuilder::new(&format!("{name}_{hinges}"));
    builder.link("ground");
    for number in 1..=hinges {
        builder.link(&link(number));
        builder.joint(hinge(number, &link(parent(number)), &link(number)));
    }
    builder.build()
}

/// A serial chain of `hinges` hinges, each of them a freedom.
///
/// # Errors
/// None in practice.
pub fn serial_chain(hinges: usize) -> Result<Mechanism, MechanismError> {
    tree("serial_chain", hinges, |number| number - 1)
}

/// `hinges` links that all hang on the ground.
///
/// # Errors
/// None in practice.
pub fn star(hinges: usize) -> Result<Mechanism, MechanismError> {
    tree("star", hinges, |_| 0)
}

/// A serial chain with a tooth on every link: `hinges` hinges in all.
///
/// # Errors
/// None in practice.
pub fn comb(hinges: usize) -> Result<Mechanism, MechanismError> {
    // Odd links are the spine, even ones the teeth.
    tree("comb", hinges, |number| match number % 2 {
        1 => number.saturating_sub(2),
        _ => number - 1,
    })
}

/// A closed ring of `hinges` hinges (8 at least), which go out in steps of a metre and come back a metre beside; their axes are
/// along x, y and z in turn. All but six are freedoms.
///
/// # Errors
/// None in practice.
pub fn hinge_ring(hinges: usize) -> Result<Mechanism, MechanismError> {
    let half = hinges.max(8) / 2;
    let last = 2 * half - 1;
    let mut builder = MechanismBuilder::new(&format!("hinge_ring_{}", 2 * half));
    builder.link("link_0");
    for number in 1..=last {
        let (parent, child) = (format!("link_{}", number - 1), format!("link_{number}"));
        let step = match number {
            n if n < half => at(100, 0, 0),
            n if n == half => at(0, 100, 0),
            _ => at(-100, 0, 0),
        };
        builder.link(&child);
        builder.joint(hinge(number, &parent, &child).origin(step));
    }
    let closing = JointBuilder::closing(
        "closing",
        JointKind::Revolute,
        &format!("link_{last}"),
        "link_0",
    );
    builder.joint(closing.origin(at(0, -100, 0)).axis(along(0, 0, 1)));
    builder.build()
}

/// `count` parallelograms of hinges side by side on a base: a freedom each.
///
/// # Errors
/// None in practice.
pub fn parallelograms(count: usize) -> Result<Mechanism, MechanismError> {
    let mut builder = MechanismBuilder::new(&format!("parallelograms_{count}"));
    builder.link("ground");
    for number in 0..count {
        let name = |what: &str| format!("{what}_{number}");
        for what in ["crank", "coupler", "rocker"] {
            builder.link(&name(what));
        }
        let hinge = |what: &str, parent: &str, child: &str| {
            JointBuilder::tree(&name(what), JointKind::Revolute, parent, child).axis(along(0, 0, 1))
        };
        let place = 400 * i64::try_from(number).unwrap_or(i64::MAX / 400);
        let (crank, coupler, rocker) = (name("crank"), name("coupler"), name("rocker"));
        builder.joint(hinge("a", "ground", &crank).origin(at(place, 0, 0)));
        builder.joint(hinge("b", &crank, &coupler).origin(at(50, 100, 0)));
        builder.joint(hinge("d", "ground", &rocker).origin(at(place + 200, 0, 0)));
        let closing = JointBuilder::closing(&name("c"), JointKind::Revolute, &rocker, &coupler);
        builder.joint(
            closing
                .origin(at(50, 100, 0))
                .successor_origin(at(200, 0, 0))
                .axis(along(0, 0, 1)),
        );
    }
    builder.build()
}

/// A train of `stages` worm gears of 1 : 3 between shafts on a base.
///
/// # Errors
/// None in practice.
pub fn gear_train(stages: usize) -> Result<Mechanism, MechanismError> {
    let mut builder = MechanismBuilder::new(&format!("gear_train_{stages}"));
    builder.link("ground");
    let third = Number::ratio(1, 3).unwrap_or_else(Number::one);
    for number in 0..=stages {
        let (shaft, wheel) = (format!("shaft_{number}"), format!("wheel_{number}"));
        builder.link(&wheel);
        let place = 100 * i64::try_from(number).unwrap_or(i64::MAX / 100);
        builder.joint(
            JointBuilder::tree(&shaft, JointKind::Revolute, "ground", &wheel)
                .origin(at(place, 0, 0))
                .axis(along(0, 0, 1)),
        );
        if let Some(before) = number.checked_sub(1) {
            // Back and forth, so that no ratio of the train leaves the range of numbers.
            let ratio = match number % 2 {
                0 => Number::integer(3),
                _ => third.clone(),
            };
            builder.mimic(&shaft, &format!("shaft_{before}"), ratio, Number::zero());
        }
    }
    builder.build()
}

/// A body held by `hinges` parallel hinges side by side: two are enough to hold it still.
///
/// # Errors
/// None in practice.
pub fn parallel_hinges(hinges: usize) -> Result<Mechanism, MechanismError> {
    let mut builder = MechanismBuilder::new(&format!("parallel_hinges_{hinges}"));
    builder.link("ground").link("body");
    for number in 0..hinges.max(1) {
        let place = 10 * i64::try_from(number).unwrap_or(i64::MAX / 10);
        let name = format!("hinge_{number}");
        let joint = match number {
            0 => JointBuilder::tree(&name, JointKind::Revolute, "ground", "body"),
            _ => JointBuilder::closing(&name, JointKind::Revolute, "ground", "body")
                .successor_origin(at(place, 0, 0)),
        };
        builder.joint(joint.origin(at(place, 0, 0)).axis(along(0, 0, 1)));
    }
    builder.build()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::{AnalysisOptions, analyse};

    #[test]
    fn freedoms_are_as_told() {
        for (mechanism, freedom) in [
            (serial_chain(7), 7),
            (star(5), 5),
            (comb(9), 9),
            (hinge_ring(10), 4),
            (parallelograms(3), 3),
            (gear_train(4), 1),
            (parallel_hinges(3), 0),
        ] {
            let mechanism = mechanism.unwrap();
            let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
            assert!(analysis.assembly.closed, "{}", mechanism.name());
            let found = analysis.home.unwrap().instantaneous;
            assert_eq!(found, Some(freedom), "{}", mechanism.name());
        }
    }
}
