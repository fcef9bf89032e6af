//! What can be chosen in every class of steps that hang together.

use super::third::Outcome;
use std::collections::BTreeSet;

/// Classes with more ways to try than this are not tried to the end.
const MOST_TRIES: usize = 4096;

/// Steps that hang together, and the choices that lead to solutions.
#[derive(Clone, Debug)]
pub(super) struct Class {
    /// The steps, ascending.
    pub(super) steps: Vec<usize>,
    /// For each solution whether a step of the class takes the other side than drawn; the fewest such steps first.
    pub(super) ways: Vec<Vec<bool>>,
    /// Whether these are all.
    pub(super) complete: bool,
}

/// The classes: a step together with all steps that it depends on.
pub(super) fn classes(depends: Option<&[BTreeSet<usize>]>, steps: usize) -> Vec<Vec<usize>> {
    let Some(depends) = depends else {
        return vec![(0..steps).collect()];
    };
    let mut parent: Vec<usize> = (0..steps).collect();
    for (step, on) in depends.iter().enumerate() {
        for &other in on {
            let [a, b] = [step, other].map(|s| top(&mut parent, s));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut of: Vec<Vec<usize>> = vec![Vec::new(); steps];
    for step in 0..steps {
        of[top(&mut parent, step)].push(step);
    }
    of.retain(|class| !class.is_empty());
    of
}

fn top(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}

impl Class {
    /// A step that depends on nothing, by how it turns out.
    pub(super) fn single(step: usize, outcome: Outcome) -> Self {
        let ways: &[bool] = match outcome {
            Outcome::Two { .. } => &[false, true],
            Outcome::Touching { .. } | Outcome::One => &[false],
            Outcome::Apart { .. } | Outcome::Degenerate => &[],
        };
        Self {
            steps: vec![step],
            ways: ways.iter().map(|&w| vec![w]).collect(),
            complete: true,
        }
    }

    /// Tries all choices, the drawn ones first. `outcomes` says how the steps of the class turn out by a choice for them.
    pub(super) fn tried(
        steps: Vec<usize>,
        mut outcomes: impl FnMut(&[bool]) -> Vec<Outcome>,
    ) -> Self {
        let mut ways = Vec::new();
        let mut other = vec![false; steps.len()];
        let mut complete = false;
        for _ in 0..MOST_TRIES {
            let found = outcomes(&other);
            // Choices after a step that is impossible change nothing; nor do those of a step with one place only.
            let dead = found.iter().position(|o| !o.is_possible());
            if dead.is_none() {
                ways.push(other.clone());
            }
            let until = dead.unwrap_or(steps.len());
            let next = (0..until)
                .rev()
                .find(|&k| !other[k] && matches!(found[k], Outcome::Two { .. }));
            let Some(k) = next else {
                complete = true;
                break;
            };
            other[k] = true;
            other[k + 1..].fill(false);
        }
        ways.sort_by_key(|w| w.iter().filter(|&&o| o).count());
        Self {
            steps,
            ways,
            complete,
        }
    }
}
