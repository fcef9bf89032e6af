//! Solutions one by one.

use super::classes::Class;
use super::{Construction, Solution};

/// All solutions, each computed when asked for.
#[derive(Clone, Debug)]
pub struct Solutions<'a> {
    construction: &'a Construction<'a>,
    classes: Vec<Class>,
    /// Which of its ways each class takes next; `None` at the end.
    next: Option<Vec<usize>>,
}

impl<'a> Solutions<'a> {
    pub(super) fn new(construction: &'a Construction<'a>, classes: Vec<Class>) -> Self {
        let possible = classes.iter().all(|c| !c.ways.is_empty());
        Self {
            construction,
            next: possible.then(|| vec![0; classes.len()]),
            classes,
        }
    }

    /// Counts on: the last class changes first.
    fn advance(&mut self) {
        let Some(next) = &mut self.next else { return };
        for (digit, class) in next.iter_mut().zip(&self.classes).rev() {
            *digit += 1;
            if *digit < class.ways.len() {
                return;
            }
            *digit = 0;
        }
        self.next = None;
    }
}

impl Iterator for Solutions<'_> {
    type Item = Solution;

    fn next(&mut self) -> Option<Solution> {
        loop {
            let mut left = self.construction.drawn_left.clone();
            for (class, &way) in self.classes.iter().zip(self.next.as_ref()?) {
                for (&step, &other) in class.steps.iter().zip(&class.ways[way].other) {
                    left[step] ^= other;
                }
            }
            self.advance();
            // What rounding alone decides may differ from what the class was tried with.
            if let Ok(solution) = self.construction.with_sides(&left) {
                return Some(solution);
            }
        }
    }
}
