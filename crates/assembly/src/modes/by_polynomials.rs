//! Configurations by the exact closure equations of the loops.

use super::place::Pose;
use super::{Complete, Configuration, Modes, Way};
use kutzbach_algebra::{
    Budget, ExactOptions, HomePose, Meaning, PolynomialSystem, RealPoints, RealSolution,
    exact_answer,
};
use kutzbach_closure::{Arithmetic, Geometry};
use kutzbach_math::space::Rigid;
use kutzbach_model::mechanism::{JointId, JointKind, Mechanism, Placement};

/// Two solutions that differ by less in every coordinate are one, with another sign of a quaternion: they are enclosed to
/// 64 bits, and different ones of a proven list are apart.
const SAME: f64 = 1e-12;

pub(super) fn answer(mechanism: &Mechanism, why_no_tree: &str, budget: &Budget) -> Modes {
    let mut modes = Modes {
        complete: Complete::Unknown(String::new()),
        moves: None,
        ..Modes::new(Way::Nothing)
    };
    let unknown = |modes: Modes, why: String| Modes {
        complete: Complete::Unknown(format!("{why}; no incidence tree either: {why_no_tree}")),
        ..modes
    };
    let tied = !mechanism.couplings().is_empty()
        || mechanism.joints().iter().any(|joint| joint.closes_loop);
    if !tied {
        let free: usize = mechanism.joints().iter().map(|j| j.freedom()).sum();
        let floating = mechanism
            .links()
            .iter()
            .filter(|l| matches!(l.placement, Placement::Floating { .. }))
            .count();
        let moves = free + 6 * floating;
        let complete = match moves {
            0 => Complete::Proven,
            _ => Complete::Unknown(format!(
                "infinitely many: nothing closes a loop, and {moves} degrees of freedom are left"
            )),
        };
        let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
        modes.configurations.push(Configuration {
            joints: Vec::new(),
            poses: geometry.home.into_iter().map(Some).collect(),
            multiplicity: (moves == 0).then_some(1),
            proven: true,
            finite: Some(moves),
            drawn: true,
        });
        return Modes {
            complete,
            moves: Some(moves),
            ..modes
        };
    }
    let answer = match exact_answer(mechanism, &ExactOptions::default(), budget) {
        Ok(answer) => answer,
        Err(error) => return unknown(modes, error.to_string()),
    };
    let system = &answer.system;
    modes.way = Way::Polynomials {
        variables: system.variables.len(),
        equations: system.equations.len(),
        degree: system
            .equations
            .iter()
            .map(|e| e.polynomial.degree() as usize)
            .max()
            .unwrap_or(0),
        complex: answer.solutions.as_ref().map(|s| s.complex),
    };
    if !system.is_exact() {
        return unknown(modes, system.relaxations[0].to_string());
    }
    match answer.dimension {
        Some(None) => {
            return Modes {
                complete: Complete::Proven,
                moves: Some(0),
                ..modes
            };
        }
        Some(Some(0)) => {}
        Some(Some(_)) => {
            let real = answer
                .pieces
                .iter()
                .map(|piece| &piece.component)
                .filter(|c| c.dimension > 0 && c.real == RealPoints::FullDimension)
                .map(|c| c.dimension)
                .max();
            let why = match real {
                Some(dimension) => {
                    format!(
                        "infinitely many: the configurations form a set of dimension {dimension}"
                    )
                }
                None => "infinitely many complex solutions; which are real is not known".to_owned(),
            };
            return Modes {
                complete: Complete::Unknown(why),
                moves: real,
                ..modes
            };
        }
        None => {
            let why = match &answer.stopped {
                Some((step, stop)) => format!("{step}: {stop}"),
                None => "exact algebra did not get that far".to_owned(),
            };
            return unknown(modes, why);
        }
    }
    let Some(solutions) = &answer.solutions else {
        return unknown(
            modes,
            "the finitely many solutions were not reached".to_owned(),
        );
    };
    let mut seen: Vec<Vec<f64>> = Vec::new();
    let mut home_met = false;
    let home = match &system.home {
        HomePose::Exact(values) => Some(values.iter().map(|v| v.value()).collect::<Vec<f64>>()),
        _ => None,
    };
    for solution in &solutions.real {
        let values = canonical(system, solution);
        let same = |other: &Vec<f64>| {
            other
                .iter()
                .zip(&values)
                .all(|(a, b)| (a - b).abs() < SAME * b.abs().max(1.0))
        };
        if seen.iter().any(same) {
            continue;
        }
        if let Some(home) = &home {
            home_met |= same(&with_signs(system, home));
        }
        let Some(poses) = poses(mechanism, system, &values) else {
            return unknown(
                modes,
                "poses follow from more than turns, slides and balls".to_owned(),
            );
        };
        modes.configurations.push(Configuration {
            joints: Vec::new(),
            poses: poses.into_iter().map(Some).collect(),
            multiplicity: Some(solution.multiplicity as usize),
            proven: true,
            finite: Some(0),
            drawn: false,
        });
        seen.push(values);
    }
    if home.is_some() && !home_met {
        return unknown(modes, "the drawn pose is none of the solutions".to_owned());
    }
    Modes {
        complete: Complete::Proven,
        moves: Some(0),
        ..modes
    }
}

fn canonical(system: &PolynomialSystem, solution: &RealSolution) -> Vec<f64> {
    with_signs(system, &solution.values())
}

/// Of the two quaternions of each ball the one whose first component that is not zero is positive.
fn with_signs(system: &PolynomialSystem, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for variables in &system.joint_variables {
        let quaternion: Vec<usize> = variables
            .iter()
            .copied()
            .filter(|&v| matches!(system.variables[v].meaning, Meaning::Quaternion { .. }))
            .collect();
        let sign = quaternion
            .iter()
            .map(|&v| values[v])
            .find(|x| x.abs() > 1e-9)
            .map_or(1.0, f64::signum);
        quaternion.iter().for_each(|&v| values[v] *= sign);
    }
    values
}

/// `world_from_link` along the file's tree; `None` where a joint of it has other variables than these can give.
fn poses(mechanism: &Mechanism, system: &PolynomialSystem, values: &[f64]) -> Option<Vec<Pose>> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut poses = geometry.home.clone();
    for &link in mechanism.placement_order() {
        match &mechanism.link(link).placement {
            Placement::World => {}
            // A floating link has no variables of its own here.
            Placement::Floating { .. } => return None,
            Placement::Joint(id) => {
                let joint = mechanism.joint(*id);
                let [near, far] = &geometry.sides[id.0];
                let at = displacement(mechanism, &geometry, *id, system, values)?;
                poses[link.0] = poses[joint.predecessor.link.0]
                    .compose(near)
                    .compose(&at)
                    .compose(&far.inverse());
            }
        }
    }
    // The ground, not the root, stays.
    let ground = mechanism.ground().0;
    let back = geometry.home[ground].compose(&poses[ground].inverse());
    Some(poses.iter().map(|pose| back.compose(pose)).collect())
}

fn displacement(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    id: JointId,
    system: &PolynomialSystem,
    values: &[f64],
) -> Option<Rigid<f64>> {
    let joint = mechanism.joint(id);
    if joint.freedom() == 0 {
        return Some(Rigid::identity(&1.0));
    }
    let mut freedoms: Vec<Option<f64>> = vec![None; joint.freedom()];
    let mut turn: Vec<[Option<f64>; 2]> = vec![[None; 2]; joint.freedom()];
    let mut quaternion = [0.0; 4];
    let mut is_ball = false;
    for &variable in &system.joint_variables[id.0] {
        let value = values[variable];
        match &system.variables[variable].meaning {
            Meaning::Translation {
                freedom: Some(freedom),
                unit_square,
                ..
            } => freedoms[*freedom] = Some(value * unit_square.value().sqrt()),
            Meaning::Cosine {
                freedom: Some(freedom),
                ..
            } => turn[*freedom][0] = Some(value),
            Meaning::Sine {
                freedom: Some(freedom),
                axis_square,
                ..
            } => turn[*freedom][1] = Some(value * axis_square.value().sqrt()),
            Meaning::Quaternion { component, .. } => {
                quaternion[*component] = value;
                is_ball = true;
            }
            _ => return None,
        }
    }
    if is_ball {
        return (joint.kind == JointKind::Spherical).then(|| of_quaternion(quaternion));
    }
    for (freedom, parts) in turn.iter().enumerate() {
        if let [Some(c), Some(s)] = parts {
            freedoms[freedom] = Some(s.atan2(*c));
        }
    }
    let all: Vec<f64> = freedoms.into_iter().collect::<Option<_>>()?;
    let displacement = &geometry.displacements[id.0];
    Some(displacement.displacement(&displacement.at(&all)))
}

fn of_quaternion([w, x, y, z]: [f64; 4]) -> Rigid<f64> {
    let n = w * w + x * x + y * y + z * z;
    let rotation = [
        [
            w * w + x * x - y * y - z * z,
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
        ],
        [
            2.0 * (x * y + w * z),
            w * w - x * x + y * y - z * z,
            2.0 * (y * z - w * x),
        ],
        [
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            w * w - x * x - y * y + z * z,
        ],
    ];
    Rigid {
        rotation: rotation.map(|row| row.map(|e| e / n)),
        translation: [0.0; 3],
    }
}
