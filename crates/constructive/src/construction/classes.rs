//! What can be chosen in every class of steps that hang together.

use super::third::Outcome;
use std::collections::BTreeSet;

/// Classes with more ways to try than this are not tried to the end.
const MOST_TRIES: usize = 4096;
/// Nor are those of large sketches, where one try is long: all tries together take so many steps, a second or two.
const MOST_STEPS: usize = 1 << 20;

/// A class of more steps is hardly ever tried to the end: once it has a solution, and so many choices were tried, there are at least as many as were
/// found.
const LONG: usize = 64;
const ENOUGH: usize = 16;
/// In small sketches as many as take so many steps.
const ENOUGH_STEPS: usize = 1 << 18;

/// Steps that hang together, and the choices that lead to solutions.
#[derive(Clone, Debug)]
pub(super) struct Class {
    /// The steps, ascending.
    pub(super) steps: Vec<usize>,
    /// The choices that lead to solutions, those with the fewest steps on the other side than drawn first.
    pub(super) ways: Vec<Choices>,
    /// Whether these are all.
    pub(super) complete: bool,
    /// Whether some choices leave an element without a place of its own: infinitely many solutions, or none.
    pub(super) degenerate: bool,
    /// Whether that happens in the last step of the class, so that they are infinitely many.
    pub(super) infinite: bool,
}

/// One choice for every step of a class.
#[derive(Clone, Debug)]
pub(super) struct Choices {
    /// Whether a step takes the other side than drawn.
    pub(super) other: Vec<bool>,
    /// Steps that touch or nearly do, which leave none, one or two places.
    pub(super) nearly: u32,
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
    fn new(steps: Vec<usize>) -> Self {
        Self {
            other: vec![false; steps.len()],
            class: Class {
                steps,
                ways: Vec::new(),
                complete: false,
                degenerate: false,
                infinite: false,
            },
        }
    }

    /// Takes note of how the steps turned out, and makes the next choice. Nothing is learnt from steps that stand on impossible
    /// ones of other classes.
    fn next(&mut self, all: &[Outcome], rigid: &[bool], trusted: &[bool]) {
        let steps = &self.class.steps;
        let dead = steps.iter().position(|&s| !all[s].is_possible());
        let looked_at = &steps[..dead.map_or(steps.len(), |k| k + 1)];
        if !looked_at.iter().all(|&s| trusted[s]) {
            return;
        }
        match dead {
            Some(k) if all[steps[k]] == Outcome::Degenerate => {
                self.class.degenerate = true;
                self.class.infinite |= k + 1 == steps.len();
            }
            Some(_) => {}
            None => {
                let nearly = |s: &&usize| {
                    !rigid[**s] && matches!(all[**s], Outcome::Touching { within } if within > 0.0)
                };
                self.class.ways.push(Choices {
                    other: self.other.clone(),
                    nearly: steps.iter().filter(nearly).count() as u32,
                });
            }
        }
        // Choices after a step that is impossible change nothing; nor do those of a step with one place only.
        let next = (0..dead.unwrap_or(steps.len())).rev().find(|&k| {
            !self.other[k] && !rigid[steps[k]] && matches!(all[steps[k]], Outcome::Two { .. })
        });
        match next {
            Some(k) => {
                self.other[k] = true;
                self.other[k + 1..].fill(false);
            }
            None => self.complete(),
        }
    }

    /// From now on the class takes choices that are possible, if there are any: others learn nothing from impossible steps.
    fn complete(&mut self) {
        self.class.complete = true;
        if let Some(way) = self.class.ways.first() {
            self.other.clone_from(&way.other);
        }
    }
}

/// In which classes steps are impossible.
#[derive(Clone, Copy, PartialEq)]
enum Dead {
    Nowhere,
    In(usize),
    InSeveral,
}

impl Dead {
    fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Nowhere, dead) | (dead, Self::Nowhere) => dead,
            (one, other) if one == other => one,
            _ => Self::InSeveral,
        }
    }
}

/// Whether all is possible, but for the step's own class, in the clusters that a step puts together: where it is not, the nearest
/// thing to a place stands in for one, and lengths that other steps measure are not what they would be.
fn trusted(all: &[Outcome], class_of: &[usize], parts: &[Vec<usize>]) -> Vec<bool> {
    let mut dead: Vec<Dead> = Vec::with_capacity(all.len());
    let mut trusted = Vec::with_capacity(all.len());
    for (step, outcome) in all.iter().enumerate() {
        let below = parts[step]
            .iter()
            .fold(Dead::Nowhere, |d, &p| d.and(dead[p]));
        trusted.push(below == Dead::Nowhere || below == Dead::In(class_of[step]));
        dead.push(match outcome.is_possible() {
            true => below,
            false => below.and(Dead::In(class_of[step])),
        });
    }
    trusted
}

/// Tries the choices of all classes, the drawn ones first; at once where they do not stand on each other's impossible steps.
/// `outcomes` says how all steps turn out where these take the other side than drawn; what is rigid never does. `parts` has for
/// every step those that made the clusters that it puts together. Where a class has no solution the others are left as they are.
pub(super) fn tried(
    classes: Vec<Vec<usize>>,
    rigid: &[bool],
    parts: &[Vec<usize>],
    mut outcomes: impl FnMut(&[bool]) -> Vec<Outcome>,
) -> Vec<Class> {
    let steps = rigid.len();
    let mut class_of = vec![0; steps];
    for (class, own) in classes.iter().enumerate() {
        own.iter().for_each(|&s| class_of[s] = class);
    }
    let mut trials: Vec<Trial> = classes.into_iter().map(Trial::new).collect();
    let mut other = vec![false; steps];
    for tries in 0..MOST_TRIES.min(1 + MOST_STEPS / steps.max(1)) {
        let long = |t: &Trial| t.class.steps.len() > LONG && !t.class.ways.is_empty();
        if tries >= ENOUGH.max(ENOUGH_STEPS / steps.max(1))
            && trials.iter().all(|t| t.class.complete || long(t))
        {
            break;
        }
        for trial in &trials {
            for (&step, &o) in trial.class.steps.iter().zip(&trial.other) {
                other[step] = o;
            }
        }
        let all = outcomes(&other);
        let trusted = trusted(&all, &class_of, parts);
        for trial in trials.iter_mut().filter(|t| !t.class.complete) {
            trial.next(&all, rigid, &trusted);
        }
        let none = |t: &Trial| t.class.complete && t.class.ways.is_empty();
        if trials.iter().any(none) {
            trials.iter_mut().for_each(|t| t.class.complete = true);
        }
        if trials.iter().all(|t| t.class.complete) {
            break;
        }
    }
    trials
        .into_iter()
        .map(|mut trial| {
            let others = |way: &Choices| way.other.iter().filter(|&&o| o).count();
            trial.class.ways.sort_by_key(others);
            trial.class
        })
        .collect()
}
