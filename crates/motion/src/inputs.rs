//! Which joint variables single out a curve on a branch of several dimensions.
//!
//! A branch of dimension d is cut down to a curve by holding d − 1 joint variables; a d-th one moves. The d inputs have to
//! be coordinates of the branch near the start: the rows of its tangent basis that belong to them must be independent.
//! They are chosen by QR with column pivoting of the transposed tangents (Businger & Golub 1965), what was asked for first,
//! then the inputs, then other hinges and slides, then balls. A row depends on the tangent *space*
//! only, so that neither the basis nor the order of the file matters; equal rows are told apart by name.

use super::system::LoopSystem;
use kutzbach_model::mechanism::{CouplingOrigin, Joint, Mechanism};

/// A variable of a joint.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Index of the joint.
    pub joint: usize,
    /// Index of the variable in the joint.
    pub freedom: usize,
    /// Its name, such as `slider.rot`.
    pub name: String,
}

impl Variable {
    /// A variable of a joint of the mechanism.
    #[must_use]
    pub fn of(mechanism: &Mechanism, joint: usize, freedom: usize) -> Self {
        Self {
            joint,
            freedom,
            name: mechanism.joints()[joint].freedom_name(freedom),
        }
    }

    /// All variables of a mechanism, joint by joint.
    #[must_use]
    pub fn all(mechanism: &Mechanism) -> Vec<Self> {
        (0..mechanism.joints().len())
            .flat_map(|joint| {
                (0..mechanism.joints()[joint].freedom())
                    .map(move |freedom| Self::of(mechanism, joint, freedom))
            })
            .collect()
    }

    /// The smaller, the sooner a variable that is no input is driven or held: hinges and slides, those of dummy links and followers of
    /// couplings last, then joints of several freedoms.
    pub fn rank(&self, mechanism: &Mechanism) -> usize {
        let joint = &mechanism.joints()[self.joint];
        match joint.freedom() {
            1 => usize::from(passive(mechanism, self.joint)),
            _ if joint.kind.class() == "S·S" => 4,
            _ => 2 + usize::from(several_turns(joint)),
        }
    }
}

/// Whether no motor sits at a joint, by all that a file without motors tells: it follows another by a `mimic`, or one of its
/// links is a dummy, without mass and shape, while the mechanism has links with them.
fn passive(mechanism: &Mechanism, joint: usize) -> bool {
    let dummy = |link: usize| {
        let link = &mechanism.links()[link];
        let massless = link
            .inertial
            .as_ref()
            .is_none_or(|i| !(i.mass.value() > 0.0));
        massless && link.visuals.is_empty() && link.collisions.is_empty()
    };
    let ground = mechanism.ground().0;
    let ends = &mechanism.joints()[joint];
    let ends = [ends.predecessor.link.0, ends.successor.link.0];
    // The first term of a `mimic` is the joint that follows.
    let follows = mechanism.couplings().iter().any(|coupling| {
        matches!(coupling.origin, CouplingOrigin::Mimic { .. })
            && coupling
                .terms
                .first()
                .is_some_and(|term| term.joint.0 == joint)
    });
    let bodies = || (0..mechanism.links().len()).any(|link| link != ground && !dummy(link));
    follows || ends.iter().any(|&link| link != ground && dummy(link)) && bodies()
}

/// Whether a joint has rotations that do not commute.
fn several_turns(joint: &Joint) -> bool {
    joint
        .kind
        .freedoms()
        .iter()
        .filter(|f| f.suffix() == "rot")
        .count()
        > 1
}

/// Rows shorter than this (of an orthonormal basis) do not move.
const RESTS: f64 = 1e-7;

/// A row has to keep this share of the longest one left, to be preferred by kind or name.
const SHARE: f64 = 0.2;

/// Chooses as many inputs as there are tangents (vectors in the metric of a part, any basis). `first` are wanted in this
/// order and taken as long as they are independent; the second result lists those that were not.
pub(super) fn choose_inputs(
    mechanism: &Mechanism,
    system: &LoopSystem,
    tangents: &[Vec<f64>],
    first: &[usize],
) -> (Vec<usize>, Vec<usize>) {
    let n = system.unknowns();
    let mut basis = orthonormal(tangents);
    // rows[i] are the coordinates of the i-th unknown on the tangent space.
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| basis.iter().map(|b| b[i]).collect())
        .collect();
    let wanted = basis.len();
    basis.clear();
    let variables = system.variables();
    let name = |i: usize| {
        let (joint, freedom) = variables[i];
        Variable::of(mechanism, joint, freedom)
    };
    let mut order: Vec<(usize, String, usize)> = (0..n)
        .map(|i| {
            let variable = name(i);
            let rank = variable.rank(mechanism);
            (rank, variable.name, i)
        })
        .collect();
    order.sort();
    let mut chosen = Vec::new();
    let mut left_out = Vec::new();
    let take = |rows: &mut Vec<Vec<f64>>, i: usize| {
        let size = norm(&rows[i]);
        let unit: Vec<f64> = rows[i].iter().map(|x| x / size).collect();
        for row in rows.iter_mut() {
            let along: f64 = row.iter().zip(&unit).map(|(a, b)| a * b).sum();
            row.iter_mut().zip(&unit).for_each(|(x, u)| *x -= along * u);
        }
    };
    for &i in first {
        if chosen.len() < wanted && norm(&rows[i]) > RESTS {
            take(&mut rows, i);
            chosen.push(i);
        } else {
            left_out.push(i);
        }
    }
    while chosen.len() < wanted {
        let longest = (0..n).map(|i| norm(&rows[i])).fold(0.0, f64::max);
        if !(longest > RESTS) {
            break;
        }
        // The first kind that has a row of some length, and in it the longest; of equal ones the first by name.
        let mut best: Option<(usize, f64, usize)> = None;
        for (rank, _, i) in &order {
            let size = norm(&rows[*i]);
            if size < SHARE * longest {
                continue;
            }
            match best {
                Some((known, _, _)) if known < *rank => break,
                Some((_, length, _)) if size <= length * (1.0 + 1e-6) => {}
                _ => best = Some((*rank, size, *i)),
            }
        }
        let Some((_, _, i)) = best else { break };
        take(&mut rows, i);
        chosen.push(i);
    }
    (chosen, left_out)
}

fn norm(v: &[f64]) -> f64 {
    v.iter().map(|x| x * x).sum::<f64>().sqrt()
}

pub(super) fn orthonormal(vectors: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for vector in vectors {
        let mut v = vector.clone();
        for _ in 0..2 {
            for b in &basis {
                let along: f64 = b.iter().zip(&v).map(|(a, b)| a * b).sum();
                v.iter_mut().zip(b).for_each(|(x, y)| *x -= along * y);
            }
        }
        let size = norm(&v);
        if size > 1e-8 * norm(vector) && size > 0.0 {
            v.iter_mut().for_each(|x| *x /= size);
            basis.push(v);
        }
    }
    basis
}
