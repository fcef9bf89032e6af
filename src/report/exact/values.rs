//! The values of fixed freedoms, in the words of a mechanism: angles in degrees, ways in metres.

use crate::algebra::{FixedVariable, Meaning, PolynomialSystem};
use crate::mechanism::Mechanism;
use crate::report::text::words::figure;

/// Points off the circle by more than this are no cosine and sine of one angle; the values are known to 64 bits.
const OFF_THE_CIRCLE: f64 = 1e-9;

/// What is fixed, freedom by freedom: `rotation of hinge: 90° or −90°`. A freedom only one of whose two coordinates is
/// fixed cannot be anywhere else than at the points of the circle above it, so it is fixed as well.
pub(super) fn fixed_freedoms(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    fixed: &[FixedVariable],
) -> Vec<String> {
    let mut said = Vec::new();
    for entry in fixed {
        let meaning = &system.variables[entry.variable].meaning;
        match meaning {
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
                let name = freedom_name(mechanism, *joint, *freedom);
                let mut angles: Vec<f64> = Vec::new();
                for c in doubles(entry) {
                    for s in doubles(sine) {
                        let s = s * length;
                        if (c * c + s * s - 1.0).abs() < OFF_THE_CIRCLE {
                            angles.push(s.atan2(c).to_degrees());
                        }
                    }
                }
                said.push(one_of(&format!("rotation of {name}"), &angles, "°"));
            }
            Meaning::Translation {
                joint,
                freedom,
                unit_square,
            } => {
                let name = freedom_name(mechanism, *joint, *freedom);
                let unit = unit_square.value().sqrt();
                let ways: Vec<f64> = doubles(entry).iter().map(|x| x * unit).collect();
                said.push(one_of(&format!("slide of {name}"), &ways, " m"));
            }
            Meaning::Sine { .. } => {}
            _ => said.push(one_of(
                &system.variables[entry.variable].name,
                &doubles(entry),
                "",
            )),
        }
    }
    said
}

/// The real roots in double precision.
pub(super) fn doubles(fixed: &FixedVariable) -> Vec<f64> {
    fixed.values.iter().map(|root| root.value()).collect()
}

fn freedom_name(
    mechanism: &Mechanism,
    joint: crate::mechanism::JointId,
    freedom: Option<usize>,
) -> String {
    let joint = mechanism.joint(joint);
    freedom.map_or_else(|| joint.name.clone(), |index| joint.freedom_name(index))
}

fn one_of(what: &str, values: &[f64], unit: &str) -> String {
    if values.is_empty() {
        return format!("{what}: no real value");
    }
    let mut texts: Vec<String> = values
        .iter()
        .map(|x| format!("{}{unit}", figure(if x.abs() < 1e-12 { 0.0 } else { *x })))
        .collect();
    texts.dedup();
    format!("{what}: {}", texts.join(" or "))
}
