//! What can be chosen in every class of steps that hang together.

use super::third::Outcome;
use std::collections::BTreeSet;

/// Classes with more ways to try than this are not tried to the end.
const MOST_TRIES: usize = 4096;
/// Nor are those of large sketches, where one try is long: all tries together take so many steps, a second or two.
const MOST_STEPS: usize = 1 << 20;

/// Steps that hang together, and the choices that lead to solutions.
#[derive(Clone, Debug)]
pub(super) struct Class {
    /// The steps, ascending.
    pub(super) steps: Vec<usize>,
    /// For each solution whether a step of the class takes the other side than drawn; the fewest such steps first.
    pub(super) ways: Vec<Vec<bool>>,
    /// Whether these are all.
    pub(super) complete: bool,
    /// Whether some choices leave an element without a place of its own: infinitely many solutions, or none.
    pub(super) degenerate: bool,
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

/// A class while its choices are tried.
struct Trial {
    class: Class,
    other: Vec<bool>,
}

impl Trial {
    /// Takes note of how the steps turned out, and makes the next choice; false where there is none.
    fn next(&mut self, all: &[Outcome], rigid: &[bool]) -> bool {
        let steps = &self.class.steps;
        let found: Vec<Outcome> = steps.iter().map(|&s| all[s]).collect();
        // Choices after a step that is impossible change nothing; nor do those of a step with one place only.
        let dead = found.iter().position(|o| !o.is_possible());
        self.class.degenerate |= dead.is_some_and(|k| found[k] == Outcome::Degenerate);
        if dead.is_none() {
            self.class.ways.push(self.other.clone());
        }
        let next = (0..dead.unwrap_or(steps.len())).rev().find(|&k| {
            !self.other[k] && !rigid[steps[k]] && matches!(found[k], Outcome::Two { .. })
        });
        if let Some(k) = next {
            self.other[k] = true;
            self.other[k + 1..].fill(false);
        }
        next.is_some()
    }
}

/// Tries the choices of all classes at once, as they do not change each other's steps: the drawn ones first. `outcomes` says how
/// all steps turn out where these take the other side than drawn; what is
/// rigid never does.
pub(super) fn tried(
    classes: Vec<Vec<usize>>,
    rigid: &[bool],
    mut outcomes: impl FnMut(&[bool]) -> Vec<Outcome>,
) -> Vec<Class> {
    let trial = |steps: Vec<usize>| Trial {
        other: vec![false; steps.len()],
        class: Class {
            steps,
            ways: Vec::new(),
            complete: false,
            degenerate: false,
        },
    };
    let mut trials: Vec<Trial> = classes.into_iter().map(trial).collect();
    let steps = rigid.len();
    let mut other = vec![false; steps];
    for _ in 0..MOST_TRIES.min(1 + MOST_STEPS / steps.max(1)) {
        for trial in &trials {
            for (&step, &o) in trial.class.steps.iter().zip(&trial.other) {
                other[step] = o;
            }
        }
        let all = outcomes(&other);
        let mut open = false;
        for trial in trials.iter_mut().filter(|t| !t.class.complete) {
            trial.class.complete = !trial.next(&all, rigid);
            open |= !trial.class.complete;
        }
        if !open {
            break;
        }
    }
    trials
        .into_iter()
        .map(|mut trial| {
            let others = |way: &Vec<bool>| way.iter().filter(|&&o| o).count();
            trial.class.ways.sort_by_key(others);
            trial.class
        })
        .collect()
}
