//! Joints turned by nearly half a turn, where angles jump and the logarithm of a rotation has no derivative.

use super::drawn::{Place, Triple, built, drawn, integers, power_of_ten, ratio, rectangle};
use super::ladder::{Ladder, Law, Rung, regular};
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::number::Number;

/// What is left of a half turn: ten to the minus these.
const SHORT: [i32; 12] = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16, 20, 50];

/// Angles around a half turn, with their names.
fn angles() -> Vec<(String, Number)> {
    let pi = Number::pi();
    let mut angles = Vec::new();
    for exponent in SHORT {
        let rest = power_of_ten(-exponent);
        angles.push((format!("pi - 1e-{exponent}"), &pi - &rest));
        angles.push((format!("-pi + 1e-{exponent}"), -(&pi - &rest)));
        angles.push((format!("pi + 1e-{exponent}"), &pi + &rest));
    }
    angles.push(("pi".to_owned(), pi.clone()));
    angles.push(("-pi".to_owned(), -pi.clone()));
    for turns in [1_000, 1_000_000] {
        let whole = &Number::integer(2 * turns) * &pi;
        angles.push((format!("pi + {turns} turns"), &whole + &pi));
    }
    angles
}

/// The rectangular parallelogram, its crank turned from upright by an angle. It translates its coupler along a circle, so
/// that the joints turn by φ, −φ and φ, and is flat at a quarter turn only: near a half turn it is regular, with one freedom.
fn crank(angle: &Number) -> Mechanism {
    let mut builder = drawn(
        "crank_turned",
        &rectangle(&Number::integer(2)),
        &Number::zero(),
    );
    let value = |joint: &str, angle: Number| (joint.to_owned(), vec![angle]);
    builder.configuration(
        "turned",
        vec![
            value("A", angle.clone()),
            value("B", -angle),
            value("D", angle.clone()),
        ],
    );
    builder.build().unwrap()
}

/// Where the flat pose is, and the offsets from it: ten to the minus these.
const FROM_FLAT: [i32; 12] = [1, 2, 3, 4, 6, 8, 10, 12, 14, 16, 20, 50];

/// The same parallelogram close to its flat pose, a quarter turn away, where three hinges more come in line with the first:
/// regular at any offset, as `kutzbach::families::flattening_parallelogram` is, but the offset is in the configuration.
fn nearly_flat() -> Ladder {
    let quarter = &Number::pi() * &ratio(1, 2);
    let rung = |exponent: i32| Rung {
        configuration: Some("turned".to_owned()),
        ..Rung::at(
            -exponent,
            crank(&(&quarter - &power_of_ten(-exponent))),
            regular(1),
        )
    };
    Ladder {
        name: "crank_turned_flat",
        parameter: "crank angle from flat in a configuration (rad)",
        law: Some(Law::new(2.0, |decades| decades)),
        rungs: FROM_FLAT.into_iter().map(rung).collect(),
    }
}

/// Two cranks on skew shafts and a rod between two balls, of which one has its frame on the crank rolled by an angle: how a
/// frame lies in its link is a matter of drawing, so that nothing depends on it, although the ball is turned at home.
///
/// The rod asks for one thing only, that its ends keep their distance. The end at (1, 0, 0) moves along (0, 1, 0) with its
/// crank, which is not across the rod's direction (1, 3, 2): so that equation has a derivative, and the two cranks have one
/// freedom. The spin of the rod is another.
fn ball(angle: &Number) -> Mechanism {
    let at = |x, y, z| -> Triple { integers(x, y, z) };
    let up = at(0, 0, 1);
    let places = [
        Place::hinge("crank_pivot", ["base", "crank"], at(0, 0, 0), up.clone()),
        Place::hinge("rocker_pivot", ["base", "rocker"], at(2, 3, 0), at(1, 2, 2)),
        Place::new(
            "crank_ball",
            JointKind::Spherical,
            ["crank", "rod"],
            at(1, 0, 0),
            up.clone(),
        ),
        Place::new(
            "rocker_ball",
            JointKind::Spherical,
            ["rod", "rocker"],
            at(2, 3, 2),
            up,
        )
        .second_roll(angle.clone()),
    ];
    built("ball_turned", &places)
}

pub fn ladders() -> Vec<Ladder> {
    let same = Some(Law::new(1.5, |_| 0.0));
    let rungs = |build: fn(&Number) -> Mechanism, configuration: Option<&str>, freedom| {
        let rung = |(label, angle): (String, Number)| Rung {
            label,
            decades: Some(0.0),
            mechanism: build(&angle),
            configuration: configuration.map(str::to_owned),
            known: regular(freedom),
        };
        angles().into_iter().map(rung).collect::<Vec<_>>()
    };
    vec![
        Ladder {
            name: "crank_turned",
            parameter: "angle of a crank (rad)",
            law: same,
            rungs: rungs(crank, Some("turned"), 1),
        },
        nearly_flat(),
        Ladder {
            name: "ball_turned",
            parameter: "angle of a ball at home (rad)",
            law: same,
            rungs: rungs(ball, None, 2),
        },
    ]
}
