//! What can be chosen on the command line of `simulate`.

use clap::ValueEnum;
use kutzbach::mechanism::Mechanism;
use kutzbach::simulate::{Effects, Integrator, Solver};

/// Form of the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// Tables for a person
    Text,
    /// Everything, for a program
    Json,
}

/// How trees of joints are held.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum SolverChoice {
    /// Multibodies, and impulses where those do not confirm
    Auto,
    /// By reduced coordinates
    Multibody,
    /// By impulses between free bodies
    Impulse,
}

impl SolverChoice {
    /// In the order of trying.
    pub fn solvers(self) -> Vec<Solver> {
        match self {
            Self::Auto => vec![Solver::Multibody, Solver::Impulse],
            Self::Multibody => vec![Solver::Multibody],
            Self::Impulse => vec![Solver::Impulse],
        }
    }
}

/// What makes a scene move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum IntegratorChoice {
    /// Runge-Kutta steps where the motion is smooth, and the engine where something touches, sticks or stops
    Auto,
    /// Steps of order five on the loops' constraints
    RungeKutta,
    /// The physics engine, as a second opinion
    Engine,
}

impl IntegratorChoice {
    /// `None` for what the scene calls for.
    pub fn integrator(self) -> Option<Integrator> {
        match self {
            Self::Auto => None,
            Self::RungeKutta => Some(Integrator::RungeKutta),
            Self::Engine => Some(Integrator::Engine),
        }
    }
}

/// An effect of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Effect {
    /// The scene's gravity; 9.81 m/s² against z where it has none
    Gravity,
    /// Contact between collision shapes
    Contact,
    /// Joint limits
    Limits,
    /// Dry friction in joints
    Friction,
    /// Viscous damping in joints
    Damping,
}

/// The first effect that is both to be added and left out.
pub fn contradiction(with: &[Effect], without: &[Effect]) -> Option<String> {
    let both = with.iter().find(|effect| without.contains(effect))?;
    let name = both.to_possible_value()?.get_name().to_owned();
    Some(format!(
        "`--with {name}` and `--without {name}` contradict one another"
    ))
}

/// Gravity where the file names none (m/s²).
const EARTH: [f64; 3] = [0.0, 0.0, -9.81];

/// The effects of the file's scene, with some added and others left out.
pub fn effects(mechanism: &Mechanism, with: &[Effect], without: &[Effect]) -> Effects {
    let mut effects = Effects::of_scene(mechanism);
    for (chosen, on) in [(with, true), (without, false)] {
        for effect in chosen {
            match effect {
                Effect::Gravity => {
                    effects.gravity = on.then(|| effects.gravity.unwrap_or(EARTH));
                }
                Effect::Contact => effects.contact = on,
                Effect::Limits => effects.limits = on,
                Effect::Friction => effects.friction = on,
                Effect::Damping => effects.damping = on,
            }
        }
    }
    effects
}

/// Numbers of substeps, ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ladder(pub Vec<usize>);

/// Reads `4,8,16`.
pub fn substeps(text: &str) -> Result<Ladder, String> {
    let wrong = || "write ascending whole numbers from 1 to 65536, for example `4,8,16`".to_owned();
    let rungs: Vec<usize> = text
        .split(',')
        .map(|part| part.trim().parse().map_err(|_| wrong()))
        .collect::<Result<_, _>>()?;
    let ascending = rungs.is_sorted_by(|a, b| a < b);
    let possible = rungs.iter().all(|n| (1..=65_536).contains(n));
    if ascending && possible {
        Ok(Ladder(rungs))
    } else {
        Err(wrong())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn ladders_ascend() {
        assert_eq!(substeps("1, 2,4").unwrap().0, [1, 2, 4]);
        for wrong in ["", "0", "4,4", "8,4", "x", "4,,8", "70000", "-1"] {
            assert!(substeps(wrong).is_err(), "{wrong}");
        }
    }
}
