//! Configurations as text and as data.

use super::{count, degrees_of_freedom};
use crate::modes::{Complete, Configuration, LeftOut, Modes, Part, Pose, WITHIN, Way, Why};
use kutzbach_model::mechanism::{FreedomPart, Joint, JointId, JointKind, Mechanism};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// Name of the data's form.
pub const SCHEMA: &str = "kutzbach-assembly-1";

/// Decimals that are shown of lengths (m) and angles (rad) in data: what differs beyond is rounding.
const DECIMALS: f64 = 1e10;

fn plain(x: f64) -> f64 {
    // Adding zero turns −0 into 0.
    (x * DECIMALS).round() / DECIMALS + 0.0
}

fn pose(pose: &Pose) -> Value {
    json!({
        "position": pose.translation.map(plain),
        "rotation": pose.rotation.map(|row| row.map(plain)),
    })
}

fn kind(configuration: &Configuration) -> &'static str {
    match (configuration.multiplicity, configuration.finite) {
        (None, _) | (_, None) => "unknown",
        (Some(1), _) => "regular",
        _ => "singular",
    }
}

fn solution(mechanism: &Mechanism, configuration: &Configuration) -> Value {
    let mut joints = Map::new();
    for (joint, values) in &configuration.joints {
        let name = mechanism.joint(*joint).name.clone();
        let value = match values.as_deref() {
            None => Value::Null,
            Some([one]) => json!(plain(*one)),
            Some(more) => json!(more.iter().map(|x| plain(*x)).collect::<Vec<_>>()),
        };
        joints.insert(name, value);
    }
    let mut poses = Map::new();
    for (link, at) in mechanism.links().iter().zip(&configuration.poses) {
        poses.insert(link.name.clone(), at.as_ref().map_or(Value::Null, pose));
    }
    json!({
        "joints": joints,
        "poses": poses,
        "kind": kind(configuration),
        "multiplicity": configuration.multiplicity,
        "finite": configuration.finite,
        "proven": configuration.proven,
        "drawn": configuration.drawn,
    })
}

/// A solution that is no configuration, and why.
fn left_out(mechanism: &Mechanism, out: &LeftOut) -> Value {
    let mut data = solution(mechanism, &out.configuration);
    let name = |joint: &JointId| mechanism.joint(*joint).name.clone();
    data["why"] = match &out.why {
        Why::Open { joint, gap } => json!({
            "open": name(joint),
            "metres": plain(gap.metres),
            "radians": plain(gap.radians),
        }),
        Why::Limit { joint, value } => json!({"limit": name(joint), "value": plain(*value)}),
    };
    data
}

/// Links that have no definite pose: rods that spin about themselves between two balls, one freedom each.
fn spinning<'a>(mechanism: &'a Mechanism, modes: &Modes) -> Vec<&'a str> {
    let spins = |index: usize| {
        let poses = modes.configurations.iter().map(|c| c.poses.get(index));
        poses.flatten().any(Option::is_none)
    };
    let links = mechanism.links().iter().enumerate();
    links
        .filter(|(index, _)| spins(*index))
        .map(|(_, link)| link.name.as_str())
        .collect()
}

/// Everything, for a program.
#[must_use]
pub fn data(mechanism: &Mechanism, modes: &Modes) -> Value {
    let held: Map<String, Value> = modes
        .held
        .iter()
        .map(|(joint, value)| {
            (
                mechanism.joint(*joint).name.clone(),
                json!(plain(value.value())),
            )
        })
        .collect();
    let held_near: Map<String, Value> = modes
        .held_near
        .iter()
        .map(|(joint, half)| {
            let [p, q] = half.tangent;
            let at = json!({"half_tangent": format!("{p}/{q}"), "within": WITHIN});
            (mechanism.joint(*joint).name.clone(), at)
        })
        .collect();
    let (complete, why) = match &modes.complete {
        Complete::Proven => ("proven", Value::Null),
        Complete::Unknown(why) => ("unknown", json!(why)),
    };
    let system = match &modes.way {
        Way::Tree {
            parts,
            weight,
            root,
            edges,
            equations,
            degree,
            boxes,
            exact,
        } => json!({
            "variables": weight,
            "equations": equations,
            "degree": degree,
            "parts": parts.iter().map(|part| {
                json!({"bodies": part.bodies, "weight": part.weight, "ways": part.ways})
            }).collect::<Vec<_>>(),
            "tree": {
                "weight": weight,
                "root": root,
                "edges": edges.iter().map(|(parent, child, weight)| {
                    json!({"parent": parent, "child": child, "weight": weight})
                }).collect::<Vec<_>>(),
            },
            "boxes": boxes,
            "exact": exact,
        }),
        Way::Polynomials {
            variables,
            equations,
            degree,
            complex,
            paths,
        } => json!({
            "variables": variables,
            "equations": equations,
            "degree": degree,
            "tree": Value::Null,
            "complex": complex,
            "paths": paths,
            "exact": true,
        }),
        Way::Construction { steps } => json!({
            "steps": steps,
            "tree": Value::Null,
        }),
        Way::AtOnce { cores } => json!({
            "solved_at_once": cores,
            "tree": Value::Null,
        }),
        Way::Nothing => Value::Null,
    };
    json!({
        "schema": SCHEMA,
        "mechanism": mechanism.name(),
        "freedom": modes.freedom,
        "held": held,
        "held_near": held_near,
        "not_held": modes.not_held,
        "solutions": modes.configurations.iter().map(|c| solution(mechanism, c)).collect::<Vec<_>>(),
        "left_out": modes.left_out.iter().map(|out| left_out(mechanism, out)).collect::<Vec<_>>(),
        "in_all": modes.in_all,
        "complete": complete,
        "why": why,
        "moves": modes.moves,
        "propose": modes.proposed,
        "spinning": spinning(mechanism, modes),
        "contradiction": modes.contradiction,
        "open": modes.open,
        "system": system,
    })
}

/// The units of values in a text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Units {
    /// Radians and metres.
    #[default]
    Si,
    /// Degrees and millimetres.
    Drawing,
}

impl Units {
    /// A value (rad, m) in its unit, and the unit's name.
    fn of(self, part: FreedomPart, value: f64) -> (f64, &'static str) {
        match (self, part) {
            (Self::Si, _) => (value, ""),
            (Self::Drawing, FreedomPart::Translation) => (1000.0 * value, " mm"),
            (Self::Drawing, _) => (value.to_degrees(), "°"),
        }
    }

    /// Numbers in columns, each with the unit of its freedom where that is not plain.
    fn columns(self, values: &[f64], parts: impl Fn(usize) -> FreedomPart) -> String {
        let shown = values.iter().enumerate().map(|(index, value)| {
            let (value, unit) = self.of(parts(index), *value);
            format!("{:9.5}{unit}", (value * 1e5).round() / 1e5 + 0.0)
        });
        shown.collect::<Vec<_>>().join(" ")
    }
}

/// Lines for a person.
#[must_use]
pub fn text(mechanism: &Mechanism, modes: &Modes, units: Units) -> String {
    let mut text = String::new();
    let found = modes.configurations.len();
    let unproven = modes.configurations.iter().filter(|c| !c.proven).count();
    // Of rounded numbers the proof takes what is unknown of every length and angle by its slope.
    let proved = if mechanism.precision().is_exact() {
        "proved"
    } else {
        "proved to first order in what the digits leave open"
    };
    let first = match (&modes.complete, found) {
        (Complete::Proven, 0) if beyond_limits(modes) > 0 => {
            format!("No configuration is within the limits of all joints, which is {proved}.")
        }
        (Complete::Proven, 0) => {
            let held = if modes.held.is_empty() {
                ""
            } else {
                ", held so"
            };
            format!("It cannot be put together{held}: no configuration exists, which is {proved}.")
        }
        (Complete::Proven, _) if modes.in_all.is_some() => format!(
            "{} configurations, and no other, which is {proved}; {found} are listed.",
            modes.in_all.as_deref().unwrap_or_default()
        ),
        (Complete::Proven, _) => format!(
            "{}{}, and no other, which is {proved}.",
            count(found, "configuration"),
            if unproven > 0 {
                " within the digits"
            } else {
                ""
            }
        ),
        (Complete::Unknown(_), _) if modes.moves.is_some_and(|m| m > 0) => moving(modes),
        (Complete::Unknown(_), 0) => "In how many ways it closes is not known.".to_owned(),
        (Complete::Unknown(_), _) if modes.in_all.is_some() => format!(
            "{} configurations found, of which {found} are listed; whether there are others is not known.",
            modes.in_all.as_deref().unwrap_or_default()
        ),
        (Complete::Unknown(_), _) => {
            format!(
                "{} found; whether there are others is not known.",
                count(found, "configuration")
            )
        }
    };
    if let Some(freedom) = modes.freedom.filter(|f| *f > 0 && !modes.held.is_empty()) {
        let held = modes.held.iter();
        let names: Vec<&str> = held
            .map(|(j, _)| mechanism.joint(*j).name.as_str())
            .collect();
        let _ = writeln!(
            text,
            "It moves with {}. With {} held:",
            degrees_of_freedom(freedom),
            names.join(", ")
        );
    }
    let _ = writeln!(text, "{first}");
    if let Some(contradiction) = &modes.contradiction {
        let _ = writeln!(text, "  • {contradiction}.");
    }
    if let Complete::Unknown(why) = &modes.complete {
        let _ = writeln!(text, "  • {why}.");
    }
    left_out_lines(&mut text, mechanism, modes, units);
    if unproven > 0 && modes.complete == Complete::Proven {
        let _ = writeln!(
            text,
            "  • the numbers are rounded: with other digits than those written {} may not close.",
            match unproven {
                1 if found == 1 => "it",
                all if all == found => "they",
                _ => "those marked so",
            }
        );
    }
    if !modes.proposed.is_empty() {
        let _ = writeln!(
            text,
            "  • To have finitely many, hold as well: {}.",
            modes.proposed.join(", ")
        );
    }
    let spinning = spinning(mechanism, modes);
    if !spinning.is_empty() {
        let _ = writeln!(
            text,
            "  • At any angle about the line through its two balls, in every configuration: {}.",
            spinning.join(", ")
        );
    }
    if !modes.not_held.is_empty() {
        let _ = writeln!(
            text,
            "  • Inputs that no number holds: {}; hold other joints with --hold.",
            modes.not_held.join(", ")
        );
    }
    if !modes.held.is_empty() {
        let held = modes.held.iter();
        let held: Vec<String> = held
            .map(|(j, v)| {
                let joint = mechanism.joint(*j);
                let part = joint.kind.freedoms().first();
                let part = part.copied().unwrap_or(FreedomPart::Rotation);
                let (value, unit) = units.of(part, v.value());
                format!("{} = {}{unit}", joint.name, plain(value))
            })
            .collect();
        let _ = writeln!(text, "\nHeld: {}", held.join(", "));
        held_near(&mut text, mechanism, modes);
    }
    way(&mut text, &modes.way);
    for (number, configuration) in modes.configurations.iter().enumerate() {
        let marks = match note(configuration) {
            note if note.is_empty() => note,
            note => format!(" ({note})"),
        };
        let _ = writeln!(text, "\nConfiguration {}{marks}", number + 1);
        joint_lines(&mut text, mechanism, configuration, units);
        link_lines(&mut text, mechanism, configuration, units);
    }
    text
}

/// How many solutions close, and are beyond a limit.
fn beyond_limits(modes: &Modes) -> usize {
    let beyond = |out: &&LeftOut| matches!(out.why, Why::Limit { .. });
    modes.left_out.iter().filter(beyond).count()
}

/// What was found and is no configuration.
fn left_out_lines(text: &mut String, mechanism: &Mechanism, modes: &Modes, units: Units) {
    let name = |joint: &JointId| mechanism.joint(*joint).name.as_str();
    for out in &modes.left_out {
        let drawn = match out.configuration.drawn {
            true => " (the drawn one)",
            false => "",
        };
        let why = match &out.why {
            Why::Open { joint, gap } => {
                format!(
                    "a solution of the equations, since it leaves `{}` {gap}",
                    name(joint)
                )
            }
            Why::Limit { joint, value } => {
                let held = &mechanism.joint(*joint);
                let (lower, upper) = held.bounds().unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
                let part = held.kind.freedoms().first().copied();
                let shown = |value: f64| {
                    let (value, unit) = units.of(part.unwrap_or(FreedomPart::Rotation), value);
                    format!("{value:.5}{unit}")
                };
                format!(
                    "a configuration{drawn} that closes with `{}` at {}, beyond its limits {} to {}",
                    name(joint),
                    shown(plain(*value)),
                    shown(lower),
                    shown(upper)
                )
            }
        };
        let _ = writeln!(text, "  • Left out: {why}.");
    }
    if modes.in_all.is_some() && beyond_limits(modes) > 0 {
        let _ = writeln!(
            text,
            "  • The number of all counts those beyond limits too."
        );
    }
}

/// Which joints are held beside the angle asked for.
fn held_near(text: &mut String, mechanism: &Mechanism, modes: &Modes) {
    for (joint, half) in &modes.held_near {
        let [p, q] = half.tangent;
        let _ = writeln!(
            text,
            "  {} at 2 atan({p}/{q}), which is within {WITHIN:e} rad of it: cosine and sine are then fractions",
            mechanism.joint(*joint).name
        );
    }
}

/// The first line where configurations form a set of some dimension, in which the drawn one need not lie.
fn moving(modes: &Modes) -> String {
    let most = modes.moves.unwrap_or(0);
    let drawn = modes.configurations.iter().find(|c| c.drawn);
    match drawn.map(|c| c.finite) {
        Some(Some(0)) => format!(
            "The drawn configuration does not move; others do, with {}.",
            degrees_of_freedom(most)
        ),
        Some(Some(freedom)) => format!("It moves: {} left.", degrees_of_freedom(freedom)),
        _ => format!(
            "Some configurations move, with {}; whether the drawn one does is not known.",
            degrees_of_freedom(most)
        ),
    }
}

/// A bar has no variables that anybody would set.
fn is_shown(joint: &Joint) -> bool {
    joint.freedom() > 0 && joint.kind != JointKind::Distance
}

fn joint_lines(
    text: &mut String,
    mechanism: &Mechanism,
    configuration: &Configuration,
    units: Units,
) {
    for (joint, values) in &configuration.joints {
        let joint = mechanism.joint(*joint);
        if let Some(values) = values.as_ref().filter(|_| is_shown(joint)) {
            let parts = joint.kind.freedoms();
            let part = |index: usize| parts.get(index).copied().unwrap_or(FreedomPart::Rotation);
            let values = units.columns(values, part);
            let _ = writeln!(text, "  {:<20} {values}", joint.name);
        }
    }
}

/// Links that bars alone hold have no joint values that would tell where they are.
fn link_lines(
    text: &mut String,
    mechanism: &Mechanism,
    configuration: &Configuration,
    units: Units,
) {
    for (index, (link, pose)) in mechanism
        .links()
        .iter()
        .zip(&configuration.poses)
        .enumerate()
    {
        let touches = |joint: &&Joint| {
            [&joint.predecessor, &joint.successor]
                .iter()
                .any(|side| side.link.0 == index)
        };
        let mut own = mechanism.joints().iter().filter(touches).peekable();
        let by_bars = own.peek().is_some() && own.all(|j| j.kind == JointKind::Distance);
        if let (Some(pose), true) = (pose, by_bars && index != mechanism.ground().0) {
            let _ = writeln!(
                text,
                "  {:<20} at {}, turned by {}",
                link.name,
                units.columns(&pose.translation, |_| FreedomPart::Translation),
                units.columns(&pose.rotation_vector(), |_| FreedomPart::Rotation)
            );
        }
    }
}

/// What is to be said of a configuration: that it is the drawn one, singular, or not proven; empty where nothing is.
#[must_use]
pub fn note(configuration: &Configuration) -> String {
    let mut marks = Vec::new();
    if configuration.drawn {
        marks.push("drawn".to_owned());
    }
    match configuration.multiplicity {
        Some(times) if times > 1 => marks.push(format!("counts {times} times: singular")),
        Some(_) if !configuration.proven => {
            marks.push("closes within rounding, not proved".to_owned())
        }
        Some(_) => {}
        None => {
            if !configuration.proven {
                marks.push("closes within rounding".to_owned());
            }
            match configuration.finite {
                Some(0) => marks.push("does not move".to_owned()),
                Some(freedom) => marks.push(format!("moves with {}", degrees_of_freedom(freedom))),
                None => {}
            }
        }
    }
    marks.join("; ")
}

fn way(text: &mut String, way: &Way) {
    match way {
        Way::Tree {
            parts,
            weight,
            root,
            edges,
            equations,
            degree,
            boxes,
            exact,
        } => {
            let hung: Vec<String> = edges
                .iter()
                .map(|(parent, child, weight)| format!("{parent} – {child} ({weight})"))
                .collect();
            let _ = writeln!(
                text,
                "\nHow: {}an incidence tree of weight {weight} from {root}: {}; {} of degree {degree} at most; {boxes} boxes{}",
                first(parts),
                hung.join(", "),
                count(*equations, "equation"),
                if *exact { ", then exact algebra" } else { "" }
            );
        }
        Way::Polynomials {
            variables,
            equations,
            degree,
            complex,
            paths,
        } => {
            let by = match paths {
                true => "paths that lead to all solutions, which exact algebra has counted, for",
                false => "exact algebra on",
            };
            let complex = complex.map_or(String::new(), |n| {
                format!("; {} over the complex numbers", count(n, "solution"))
            });
            let _ = writeln!(
                text,
                "\nHow: {by} the closure equations of the loops: {} in {} of degree {degree} at most{complex}",
                count(*equations, "equation"),
                count(*variables, "unknown"),
            );
        }
        Way::Construction { steps } => {
            let _ = writeln!(
                text,
                "\nHow: by circles and lines in the plane: {} with two places at most",
                count(*steps, "step")
            );
        }
        Way::AtOnce { cores } => {
            let sizes: Vec<String> = cores.iter().map(|n| count(*n, "joint")).collect();
            let _ = writeln!(
                text,
                "\nHow: by circles and lines in the plane, on what exact algebra solves at once: {}",
                sizes.join(", ")
            );
        }
        Way::Nothing => {}
    }
}

/// What was put together before the tree.
fn first(parts: &[Part]) -> String {
    let all = parts.iter().map(|part| {
        format!(
            "{} become one body by an incidence tree of weight {}, in {}; ",
            part.bodies.join(" and "),
            part.weight,
            count(part.ways, "way")
        )
    });
    all.collect()
}
