//! Polynomial systems of mechanisms: what they count, and that they vanish where the mechanisms stand.

#![allow(clippy::unwrap_used)]

mod support;

use kutzbach::algebra::{
    Formulation, HomePose, PolynomialSystem, Rational, SystemOptions, polynomial_system,
};
use kutzbach::closure::{Arithmetic, Geometry, Rigid, spanning_poses};
use kutzbach::mechanism::Mechanism;
use support::{analysis, assert_none, in_parallel, own_mechanisms, zoo};

const FORMULATIONS: [Formulation; 3] = [
    Formulation::Canonical,
    Formulation::Tree,
    Formulation::Positional,
];

fn system(mechanism: &Mechanism, formulation: Formulation) -> Result<PolynomialSystem, String> {
    let options = SystemOptions {
        formulation,
        ..SystemOptions::default()
    };
    polynomial_system(mechanism, &options).map_err(|error| error.to_string())
}

fn to_f64(x: &Rational) -> f64 {
    use num_traits::ToPrimitive;
    x.to_f64().unwrap()
}

/// Largest value of an equation at a point, relative to the sum of its terms' sizes.
fn largest_residual(system: &PolynomialSystem, point: &[f64]) -> (f64, usize) {
    let mut worst = (0.0, 0);
    for (index, equation) in system.equations.iter().enumerate() {
        let (mut value, mut size) = (0.0f64, 0.0f64);
        for (exponents, coefficient) in equation.polynomial.terms() {
            let term = exponents
                .iter()
                .zip(point)
                .fold(to_f64(coefficient), |product, (e, x)| {
                    product * x.powi(*e as i32)
                });
            value += term;
            size += to_f64(coefficient).abs();
        }
        let residual = (value / size).abs();
        if !(residual <= worst.0) {
            worst = (residual, index);
        }
    }
    worst
}

fn survey(name: &str, mechanism: &Mechanism) -> Vec<String> {
    let mut lines = Vec::new();
    let analysis = analysis(mechanism);
    let geometry = Geometry::new(mechanism, None, &Arithmetic::double());
    let poses: Vec<Rigid<f64>> = spanning_poses(mechanism, &geometry, &analysis.assembly.states).0;
    for formulation in FORMULATIONS {
        let started = std::time::Instant::now();
        match system(mechanism, formulation) {
            Err(error) => lines.push(format!("ERR {name} {formulation:?}: {error}")),
            Ok(system) => {
                let time = started.elapsed().as_millis();
                let point = system.point_at(&poses);
                let (worst, at) = largest_residual(&system, &point);
                let home = match &system.home {
                    HomePose::Exact(_) => "exact".to_owned(),
                    HomePose::Open { left, equation } => {
                        format!("open {left:e} {:?}", system.equations[*equation].origin)
                    }
                    HomePose::NotAlgebraic(e) => format!("not algebraic {e}"),
                    other => format!("{other:?}"),
                };
                let terms: usize = system
                    .equations
                    .iter()
                    .map(|e| e.polynomial.terms().len())
                    .sum();
                let algebraic = system
                    .variables
                    .iter()
                    .filter(|v| v.meaning.is_algebraic_number())
                    .count();
                let bad = if analysis.assembly.closed && !(worst < 1e-9) {
                    format!("BAD {worst:e} {:?}", system.equations[at].origin)
                } else {
                    String::new()
                };
                lines.push(format!(
                    "{name} {formulation:?}: {} variables ({algebraic} algebraic) {} equations {terms} terms {time} ms home {home} relaxed {} {bad}",
                    system.variables.len(), system.equations.len(), system.relaxations.len(),
                ));
            }
        }
    }
    lines
}

#[test]
fn survey_all() {
    for set in [own_mechanisms(), zoo()] {
        for lines in in_parallel(&set, |(name, mechanism)| survey(name, mechanism)) {
            for line in lines {
                println!("{line}");
            }
        }
    }
    let _ = assert_none;
}
