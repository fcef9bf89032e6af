//! Configurations by the exact closure equations of the loops.

use super::place::Pose;
use super::{Complete, Configuration, Modes, Way};
use crate::paths;
use kutzbach_algebra::{
    Budget, Equation, ExactOptions, HomePose, Meaning, Origin, PolynomialSystem, RealPoints,
    SystemOptions, count_solutions, exact_answer, polynomial_system,
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
    if let Some(modes) = by_paths(mechanism, budget) {
        return modes;
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
        paths: false,
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
    let real = solutions.real.iter();
    let real = real.map(|solution| (solution.values(), solution.multiplicity as usize));
    match configurations(mechanism, system, real, SAME) {
        Ok(configurations) => Modes {
            configurations,
            complete: Complete::Proven,
            moves: Some(0),
            ..modes
        },
        Err(why) => unknown(modes, why.to_owned()),
    }
}

/// More complex solutions than this are not followed along paths, and systems of more unknowns not counted for it.
const MOST_FOLLOWED: usize = 400;
const MOST_VARIABLES: usize = 12;

/// Share of the effort that counting solutions and following them may take.
const SHARE_OF_PATHS: f64 = 0.4;

/// All configurations, where the equations are as many as the unknowns and have simple solutions only: counted by exact algebra modulo primes,
/// followed along paths, and each proven. `None` where it does not come to that.
fn by_paths(mechanism: &Mechanism, budget: &Budget) -> Option<Modes> {
    let system = polynomial_system(mechanism, &SystemOptions::default()).ok()?;
    let (variables, equations) = (system.variables.len(), system.polynomials());
    if !system.is_exact()
        || !system.nonzero.is_empty()
        || equations.len() != variables
        || variables > MOST_VARIABLES
    {
        return None;
    }
    let part = budget.part(SHARE_OF_PATHS, None);
    let count = count_solutions(&equations, variables, &part).ok()??;
    if count == 0 || count > MOST_FOLLOWED {
        return None;
    }
    let (mirrors, kept) = (quaternions(&system), units(mechanism, &system));
    let roots = paths::real_solutions(&equations, count, &mirrors, &kept, &part).ok()??;
    let off = roots.iter().fold(0.0, |m: f64, root| m.max(root.off));
    let real = roots.into_iter().map(|root| (root.values, 1));
    let configurations = configurations(mechanism, &system, real, SAME.max(4.0 * off)).ok()?;
    let degrees = equations.iter().map(|p| p.degree() as usize);
    Some(Modes {
        configurations,
        ..Modes::new(Way::Polynomials {
            variables,
            equations: equations.len(),
            degree: degrees.max().unwrap_or(0),
            complex: Some(count),
            paths: true,
        })
    })
}

/// The configurations at real solutions with their multiplicities, coordinates being known up to a share of their size.
fn configurations(
    mechanism: &Mechanism,
    system: &PolynomialSystem,
    real: impl Iterator<Item = (Vec<f64>, usize)>,
    off: f64,
) -> Result<Vec<Configuration>, &'static str> {
    let mut found = Vec::new();
    let mut seen: Vec<Vec<f64>> = Vec::new();
    let mut home_met = false;
    let home = match &system.home {
        HomePose::Exact(values) => Some(values.iter().map(|v| v.value()).collect::<Vec<f64>>()),
        _ => None,
    };
    for (values, multiplicity) in real {
        let values = with_signs(system, &values);
        let same = |other: &Vec<f64>| {
            let mut pairs = other.iter().zip(&values);
            pairs.all(|(a, b)| (a - b).abs() < off * b.abs().max(1.0))
        };
        if seen.iter().any(same) {
            continue;
        }
        if let Some(home) = &home {
            home_met |= same(&with_signs(system, home));
        }
        let poses = poses(mechanism, system, &values)
            .ok_or("poses follow from more than turns, slides and balls")?;
        found.push(Configuration {
            joints: Vec::new(),
            poses: poses.into_iter().map(Some).collect(),
            multiplicity: Some(multiplicity),
            proven: true,
            finite: Some(0),
            drawn: false,
        });
        seen.push(values);
    }
    match home {
        Some(_) if !home_met => Err("the drawn pose is none of the solutions"),
        _ => Ok(found),
    }
}

/// The equations of circles and unit quaternions, and of algebraic numbers; not those of rods, which have the square of a length.
fn units(mechanism: &Mechanism, system: &PolynomialSystem) -> Vec<usize> {
    let quaternions = quaternions(system);
    let is_unit = |equation: &Equation| match equation.origin {
        Origin::Freedom { joint } if mechanism.joint(joint).kind == JointKind::Distance => {
            let of_ball = |set: &Vec<usize>| set.iter().all(|&v| equation.polynomial.mentions(v));
            quaternions.iter().any(of_ball)
        }
        Origin::Freedom { .. } | Origin::MinimalPolynomial { .. } => true,
        _ => false,
    };
    let all = 0..system.equations.len();
    all.filter(|&r| is_unit(&system.equations[r])).collect()
}

/// The variables of the quaternion of each ball.
fn quaternions(system: &PolynomialSystem) -> Vec<Vec<usize>> {
    let is_component =
        |&v: &usize| matches!(system.variables[v].meaning, Meaning::Quaternion { .. });
    let of_joint =
        |variables: &Vec<usize>| variables.iter().copied().filter(is_component).collect();
    let all = system.joint_variables.iter().map(of_joint);
    all.filter(|set: &Vec<usize>| !set.is_empty()).collect()
}

/// Of the two quaternions of each ball the one whose first component that is not zero is positive.
fn with_signs(system: &PolynomialSystem, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for quaternion in quaternions(system) {
        let sign = quaternion
            .iter()
            .map(|&v| values[v])
            .find(|x| x.abs() > 1e-9)
            .map_or(1.0, f64::signum);
        quaternion.iter().for_each(|&v| values[v] *= sign);
    }
    values
}

/// `world_from_link` from joint to joint; `None` where a link hangs only by joints with other variables than these can give.
fn poses(mechanism: &Mechanism, system: &PolynomialSystem, values: &[f64]) -> Option<Vec<Pose>> {
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let mut poses: Vec<Option<Pose>> = vec![None; mechanism.links().len()];
    let ground = mechanism.ground();
    poses[ground.0] = Some(geometry.home[ground.0].clone());
    // A link that floats is placed by any joint whose variables say all of it.
    let known = (0..mechanism.joints().len()).map(JointId).filter_map(|id| {
        let at = displacement(mechanism, &geometry, id, system, values)?;
        let [near, far] = &geometry.sides[id.0];
        let joint = mechanism.joint(id);
        let ends = [joint.predecessor.link.0, joint.successor.link.0];
        Some((ends, near.compose(&at).compose(&far.inverse())))
    });
    let known: Vec<([usize; 2], Pose)> = known.collect();
    // Each pass places one link at least, or is the last one.
    for _ in 0..poses.len() {
        for ([from, to], across) in &known {
            match (&poses[*from], &poses[*to]) {
                (Some(pose), None) => poses[*to] = Some(pose.compose(across)),
                (None, Some(pose)) => poses[*from] = Some(pose.compose(&across.inverse())),
                _ => {}
            }
        }
        if poses.iter().all(Option::is_some) {
            break;
        }
    }
    poses.into_iter().collect()
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
    let mut between = [0.0; 3];
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
            Meaning::Between { component, .. } => between[*component] = value,
            _ => return None,
        }
    }
    if is_ball {
        let told = matches!(joint.kind, JointKind::Spherical | JointKind::Distance);
        return told.then(|| Rigid {
            translation: between,
            ..drawn_turn(mechanism, geometry, id).compose(&of_quaternion(quaternion))
        });
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

/// How the frame of a joint on the successor is turned against that on the predecessor as drawn: balls are measured from there.
fn drawn_turn(mechanism: &Mechanism, geometry: &Geometry<f64>, id: JointId) -> Rigid<f64> {
    let joint = mechanism.joint(id);
    let [near, far] = &geometry.sides[id.0];
    let from = geometry.home[joint.predecessor.link.0].compose(near);
    let to = geometry.home[joint.successor.link.0].compose(far);
    Rigid {
        translation: [0.0; 3],
        ..from.inverse().compose(&to)
    }
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
