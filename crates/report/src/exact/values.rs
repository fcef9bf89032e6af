//! The values of fixed freedoms, in the words of a mechanism: angles in degrees, ways in metres.

use crate::text::words::figure;
use kutzbach_algebra::{FixedVariable, Meaning, PolynomialSystem};
use kutzbach_model::mechanism::{JointId, Mechanism};
use serde::Serialize;

/// Points off the circle by more than this are no cosine and sine of one angle; the values are known to 64 bits.
const OFF_THE_CIRCLE: f64 = 1e-9;

/// A freedom with finitely many values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FixedFreedom {
    /// The joint's freedom or, where it is none, the variable.
    pub name: String,
    /// What it is of its joint: `rotation`, `slide`, `rotation 2`, `quaternion component 0`, `x between its points`;
    /// otherwise the variable.
    pub part: String,
    /// Its values: degrees in (−180, 180] for a rotation, metres for a slide, otherwise as the variable counts. None: it
    /// has no real one.
    pub values: Vec<f64>,
    /// `°`, ` m` or nothing.
    pub unit: &'static str,
    /// The value at the drawn pose, where that is known exactly.
    pub drawn: Option<f64>,
}

/// A joint with freedoms that are fixed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FixedJoint {
    /// The joint; `null` for what belongs to no joint.
    pub joint: Option<String>,
    /// Its fixed freedoms.
    pub freedoms: Vec<FixedFreedom>,
    /// The same in words.
    pub text: String,
}

impl FixedFreedom {
    fn values_in_words(&self) -> String {
        if self.values.is_empty() {
            return "no real value".to_owned();
        }
        let mut texts: Vec<String> = self
            .values
            .iter()
            .map(|x| self.value_in_words(*x))
            .collect();
        texts.dedup();
        texts.join(" or ")
    }

    fn value_in_words(&self, value: f64) -> String {
        let value = if value.abs() < 1e-12 { 0.0 } else { value };
        format!("{}{}", figure(value), self.unit)
    }

    /// Whether two values are one, a half turn the same either way round; they are known to 64 bits.
    fn is_same(&self, a: f64, b: f64) -> bool {
        let off = (a - b).abs();
        let off = if self.unit == "°" {
            off.min((off - 360.0).abs())
        } else {
            off
        };
        off <= 1e-9 * (1.0 + a.abs())
    }

    /// `rotation fixed at 90°`; where there are several values, that of the drawn pose first.
    fn text(&self) -> String {
        let all = self.values_in_words();
        match self.drawn {
            _ if self.values.is_empty() => format!("{} fixed at {all}", self.part),
            Some(drawn) if self.values.len() > 1 => {
                let others = self.values.iter().filter(|x| !self.is_same(**x, drawn));
                let others: Vec<String> = others.map(|x| self.value_in_words(*x)).collect();
                format!(
                    "{} fixed at {} in this assembly mode ({} in others)",
                    self.part,
                    self.value_in_words(drawn),
                    others.join(" or ")
                )
            }
            _ => format!("{} fixed at {all}", self.part),
        }
    }
}

/// What is fixed, freedom by freedom: `rotation of hinge: 90° or -90°`.
pub(super) fn fixed_freedoms(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
) -> Vec<String> {
    found(mechanism, system, fixed)
        .iter()
        .map(|(_, freedom)| {
            let what = match freedom.part.split(' ').next() {
                Some(word @ ("rotation" | "slide")) => format!("{word} of {}", freedom.name),
                _ => freedom.name.clone(),
            };
            format!("{what}: {}", freedom.values_in_words())
        })
        .collect()
}

/// What is fixed, joint by joint, in the order of the variables.
pub(super) fn fixed_joints(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
) -> Vec<FixedJoint> {
    let mut joints: Vec<(Option<JointId>, Vec<FixedFreedom>)> = Vec::new();
    for (joint, freedom) in found(mechanism, system, fixed) {
        match joints.iter_mut().find(|(known, _)| *known == joint) {
            Some((_, freedoms)) => freedoms.push(freedom),
            None => joints.push((joint, vec![freedom])),
        }
    }
    joints
        .into_iter()
        .map(|(joint, freedoms)| {
            let parts = in_words(&freedoms).join(", ");
            let joint = joint.map(|joint| mechanism.joint(joint).name.clone());
            FixedJoint {
                text: match &joint {
                    Some(name) => format!("joint {name}: {parts}"),
                    None => parts,
                },
                joint,
                freedoms,
            }
        })
        .collect()
}

/// Fixed freedoms in words. The four components of a ball's quaternion are one fact, and one of them alone says nothing that
/// a person could see.
fn in_words(freedoms: &[FixedFreedom]) -> Vec<String> {
    let component = |freedom: &FixedFreedom| freedom.part.starts_with("quaternion");
    let turns: Vec<&FixedFreedom> = freedoms.iter().filter(|f| component(f)).collect();
    let mut words = Vec::new();
    if turns.len() == 4 {
        // q and -q are one orientation.
        let one = turns.iter().all(|f| {
            let first = f.values.first().copied().unwrap_or_default().abs();
            f.values
                .iter()
                .all(|x| (x.abs() - first).abs() < OFF_THE_CIRCLE)
        });
        words.push(match one {
            true => "orientation fixed".to_owned(),
            false => "orientation fixed in every assembly mode".to_owned(),
        });
    }
    let others = freedoms.iter().filter(|f| turns.len() < 4 || !component(f));
    words.extend(others.map(FixedFreedom::text));
    words
}

/// Fixed freedoms and their joints. A freedom only one of whose two coordinates is fixed cannot be anywhere else than at
/// the points of the circle above it, so it is fixed as well.
fn found(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
) -> Vec<(Option<JointId>, FixedFreedom)> {
    let mut found = Vec::new();
    let drawn = |variable: usize| {
        let values = system.home.exact()?;
        values.get(variable).map(|value| value.value())
    };
    for entry in fixed {
        let meaning = &system.variables[entry.variable].meaning;
        let freedom = match meaning {
            Meaning::Cosine { joint, freedom } => {
                let sine = fixed.iter().find_map(|other| {
                    match &system.variables[other.variable].meaning {
                        Meaning::Sine {
                            joint: j,
                            freedom: f,
                            axis_square,
                        } if j == joint && f == freedom => {
                            Some((other, axis_square.value().sqrt()))
                        }
                        _ => None,
                    }
                });
                let Some((sine, length)) = sine else { continue };
                let angle = |c: f64, s: f64| (s * length).atan2(c).to_degrees();
                let mut angles: Vec<f64> = Vec::new();
                for c in doubles(entry) {
                    for s in doubles(sine) {
                        if (c * c + s * s * length * length - 1.0).abs() < OFF_THE_CIRCLE {
                            angles.push(angle(c, s));
                        }
                    }
                }
                angles.sort_by(f64::total_cmp);
                FixedFreedom {
                    name: freedom_name(mechanism, *joint, *freedom),
                    part: part(mechanism, *joint, *freedom, "rotation"),
                    values: angles,
                    unit: "°",
                    drawn: drawn(entry.variable)
                        .zip(drawn(sine.variable))
                        .map(|(c, s)| angle(c, s)),
                }
            }
            Meaning::Translation {
                joint,
                freedom,
                unit_square,
            } => {
                let unit = unit_square.value().sqrt();
                FixedFreedom {
                    name: freedom_name(mechanism, *joint, *freedom),
                    part: part(mechanism, *joint, *freedom, "slide"),
                    values: doubles(entry).iter().map(|x| x * unit).collect(),
                    unit: " m",
                    drawn: drawn(entry.variable).map(|x| x * unit),
                }
            }
            Meaning::Sine { .. } => continue,
            _ => {
                let name = system.variables[entry.variable].name.clone();
                let part = match meaning {
                    Meaning::Quaternion { component, .. } => {
                        format!("quaternion component {component}")
                    }
                    Meaning::Between { component, .. } => {
                        format!("{} between its points", ["x", "y", "z"][*component])
                    }
                    _ => name.clone(),
                };
                FixedFreedom {
                    part,
                    name,
                    values: doubles(entry),
                    unit: "",
                    drawn: drawn(entry.variable),
                }
            }
        };
        found.push((meaning.joint(), freedom));
    }
    found
}

/// The real roots in double precision.
pub(super) fn doubles(fixed: &FixedVariable) -> Vec<f64> {
    fixed.values.iter().map(|root| root.value()).collect()
}

fn freedom_name(mechanism: &Mechanism, joint: JointId, freedom: Option<usize>) -> String {
    let joint = mechanism.joint(joint);
    freedom.map_or_else(|| joint.name.clone(), |index| joint.freedom_name(index))
}

/// `rotation`, or `rotation 2` where the joint has several: the number in the freedom's name.
fn part(mechanism: &Mechanism, joint: JointId, freedom: Option<usize>, word: &str) -> String {
    let name = freedom_name(mechanism, joint, freedom);
    let suffix = name.strip_prefix(mechanism.joint(joint).name.as_str());
    let number: String = suffix
        .unwrap_or_default()
        .chars()
        .filter(char::is_ascii_digit)
        .collect();
    if number.is_empty() {
        word.to_owned()
    } else {
        format!("{word} {number}")
    }
}
