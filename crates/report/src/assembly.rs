//! How the loops closed, as data, and the file that holds the pose found.

use super::natural::natural_order;
use super::schema::{Assembly, Gap, JointPlace, OutsideLimit, Reversal};
use super::text::words::{counted, in_degrees, metres};
use kutzbach_closure::{self as closure, Obstacle, ProvenOpen};
use kutzbach_format::{WriteOptions, write_with};
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{Configuration, FreedomPart, JointId, Mechanism};
use std::collections::BTreeSet;

/// The name of the configuration that [`assembled_file`] adds.
pub const ASSEMBLED: &str = "assembled";

/// What the closure of a mechanism came to.
pub(super) fn assembly(mechanism: &Mechanism, found: &closure::Assembly) -> Assembly {
    let joints = mechanism.joints();
    let name = |joint: usize| joints[joint].name.clone();
    let names = |of: &std::collections::BTreeSet<usize>| {
        let mut names: Vec<String> = of.iter().map(|&joint| name(joint)).collect();
        names.sort_by(|a, b| natural_order(a, b));
        names
    };
    let places = |places: &[closure::JointPlace]| {
        let mut rows: Vec<JointPlace> = places
            .iter()
            .map(|place| JointPlace {
                name: name(place.joint),
                values: place.values.iter().map(|x| plain_zero(*x)).collect(),
                drawn: place.drawn.iter().map(|x| plain_zero(*x)).collect(),
                correction: place.turned.max(place.shifted),
                turned: place.turned,
                shifted: place.shifted,
            })
            .collect();
        rows.sort_by(|a, b| natural_order(&a.name, &b.name));
        rows
    };
    let mut gaps: Vec<Gap> = found
        .gaps
        .iter()
        .map(|gap| Gap {
            cycle: name(gap.joint),
            position: gap.position,
            angle: gap.angle,
            left_position: gap.left_position,
            left_angle: gap.left_angle,
        })
        .collect();
    gaps.sort_by(|a, b| natural_order(&a.cycle, &b.cycle));
    Assembly {
        closed: Some(found.closed),
        residual: Some(found.residual * found.length),
        moved: Some(found.moved),
        tolerance: Some(found.tolerance * found.length),
        tolerance_asked: false,
        gaps,
        starts: Some(found.starts),
        work_limited: found.work_ended,
        held: names(&found.held),
        corrected: names(&found.corrected),
        joints: places(&found.joints),
        outside_limits: found
            .outside
            .iter()
            .map(|outside| OutsideLimit {
                joint: name(outside.joint),
                by: outside.by,
                angle: joints[outside.joint].kind.freedoms().first()
                    != Some(&FreedomPart::Translation),
            })
            .collect(),
        proven_open: found.proven_open.is_some() && found.held.is_empty(),
        proof: found
            .proven_open
            .map(|open| proof(mechanism, open, found.held.len())),
        misfits: Vec::new(),
        released: found.released.as_deref().map(places),
        reversal: found.reversal.map(|reversal| Reversal {
            cycle: name(reversal.joint),
            about: reversal.about.map(plain_zero),
        }),
        dimensions_changed: false,
    }
}

/// Why a loop closes at no pose, as a clause; at none with so many joints held, where any are.
fn proof(mechanism: &Mechanism, open: ProvenOpen, held: usize) -> String {
    let name = |joint: usize| &mechanism.joints()[joint].name;
    let cycle = name(open.joint);
    let (held, held_then) = match held {
        0 => (String::new(), String::new()),
        _ => {
            let held = format!(", with {} held", counted(held, "joint"));
            let then = format!("{held},");
            (held, then)
        }
    };
    match open.obstacle {
        Obstacle::TooShort {
            between: [one, other],
            apart,
            reach,
        } => {
            let side = match one == other {
                true => format!("`{}` is {} long", name(one), metres(apart)),
                false => format!(
                    "`{}` and `{}` are at least {} apart",
                    name(one),
                    name(other),
                    metres(apart)
                ),
            };
            format!(
                "in the loop through `{cycle}`{held_then} one side is longer than all the others together, by {}: {side}, and the others \
                 span {} at most",
                metres(apart - reach),
                metres(reach)
            )
        }
        Obstacle::Directions(miss) => format!(
            "the angles between the axes of the loop through `{cycle}`{held_then} miss those of a closed loop by {}°",
            in_degrees(miss)
        ),
        Obstacle::Offset(along) => format!(
            "all axes of the loop through `{cycle}` are parallel, and its links step {} along them in all{held}",
            metres(along)
        ),
        Obstacle::Contradiction(loops) => format!(
            "the equations of {} contradict one another, over the complex numbers too{held}",
            loops_through(cycle, loops)
        ),
        Obstacle::NoRealSolution(loops) => format!(
            "the equations of {} have finitely many solutions over the complex numbers, and none of them is real{held}",
            loops_through(cycle, loops)
        ),
        Obstacle::NothingMoves => {
            format!("no joint of the loop through `{cycle}` may move{held}")
        }
    }
}

/// The loop through a joint, or several of which it passes one.
fn loops_through(cycle: &str, loops: usize) -> String {
    match loops {
        0 | 1 => format!("the loop through `{cycle}`"),
        _ => format!("{loops} loops, among them the one through `{cycle}`,"),
    }
}

/// `−0` is `0`.
fn plain_zero(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x }
}

/// The mechanism as a file, with a configuration [`ASSEMBLED`] that holds the values of all joints at the pose found, to the
/// last digit of double precision; one of that name is replaced. `None` where the mechanism does not assemble.
///
/// Where a piece stands that no joint connects with the rest, no joint value says; it stays where the file draws it.
#[must_use]
pub fn assembled_file(
    mechanism: &Mechanism,
    found: &closure::Assembly,
    options: &WriteOptions<'_>,
) -> Option<String> {
    if !found.closed {
        return None;
    }
    let positions: Option<Vec<(JointId, Vec<Number>)>> = found
        .joints
        .iter()
        .map(|place| {
            let values = place
                .values
                .iter()
                .map(|value| Number::decimal(&format!("{:?}", plain_zero(*value))).ok());
            Some((JointId(place.joint), values.collect::<Option<Vec<_>>>()?))
        })
        .collect();
    let assembled = mechanism.with_configuration(Configuration {
        name: ASSEMBLED.to_owned(),
        positions: positions?,
        free: BTreeSet::new(),
    });
    Some(write_with(&assembled, options))
}
