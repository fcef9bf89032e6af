//! Tangency decided exactly, where a step hangs on constraints alone or on a few points.

use super::derived::Derived;
use super::plan::{Move, Plan};
use super::third::Outcome;
use crate::sketch::{Element, Sketch};
use kutzbach_math::number::Number;
use std::collections::HashMap;

/// Steps that touch or nearly do are proven to touch, or found not to, where all three of their measures are constraints, or follow
/// from a few steps of points.
pub(super) fn settle(derived: &Derived<'_>, outcomes: &mut [Outcome]) {
    let (sketch, plan) = (derived.sketch, derived.plan);
    let open = |o: &Outcome| matches!(o, Outcome::Touching { .. });
    if !outcomes.iter().any(open) {
        return;
    }
    let by_ends = sketch.by_ends();
    for (index, (step, outcome)) in plan.moves.iter().zip(outcomes).enumerate() {
        if !open(outcome) {
            continue;
        }
        let values = given(sketch, step, &by_ends);
        let Some(margin) = values.and_then(|v| margin(sketch, step, v)) else {
            if let Some(decided) = derived.outcome(index) {
                *outcome = decided;
            }
            continue;
        };
        *outcome = match margin.signum() {
            0 => Outcome::Touching { within: 0.0 },
            1 => Outcome::Two { by: margin.value() },
            _ => Outcome::Apart {
                by: -margin.value(),
            },
        };
    }
}

/// Steps whose margin is smaller than what was rounded off its three numbers together.
pub(super) fn left_open(sketch: &Sketch, plan: &Plan) -> Vec<usize> {
    let by_ends = sketch.by_ends();
    let is_open = |step: &Move| {
        let values = given(sketch, step, &by_ends)?;
        // Whole numbers are meant as they are.
        let fraction = |n: &Number| n.stated().filter(|s| s.decimals > 0);
        let off = |n: &Number| fraction(n).map_or(0.0, |s| 0.5 * 10_f64.powi(-s.decimals));
        let slack: f64 = values.iter().map(|n| off(n)).sum();
        let margin = margin(sketch, step, values)?.value().abs();
        Some(slack > 0.0 && margin <= slack)
    };
    let steps = plan.moves.iter().enumerate();
    steps
        .filter(|(_, step)| is_open(step) == Some(true))
        .map(|(i, _)| i)
        .collect()
}

/// The values of first and second, second and third, third and first, if all are constraints.
fn given<'a>(
    sketch: &'a Sketch,
    step: &Move,
    by_ends: &HashMap<[usize; 2], usize>,
) -> Option<[&'a Number; 3]> {
    let [x, y, z] = step.shared;
    let value = |pair: [usize; 2]| {
        let constraint = by_ends.get(&pair)?;
        Some(&sketch.constraints()[*constraint].value)
    };
    Some([value([x, y])?, value([y, z])?, value([z, x])?])
}

/// By how much circles overlap, from the measures of first and second, second and third, third and first.
fn margin(sketch: &Sketch, step: &Move, [a, b, c]: [&Number; 3]) -> Option<Number> {
    let line = step
        .shared
        .map(|e| matches!(sketch.elements()[e], Element::Line { .. }));
    let tangent = |length: &Number, one: &Number, other: &Number| length - &(one - other).abs();
    Some(match line {
        [false, false, false] => {
            let sums = [&(a + b) - c, &(b + c) - a, &(c + a) - b];
            let least = sums.into_iter().reduce(|x, y| match (&x - &y).signum() {
                1 => y,
                _ => x,
            });
            least?
        }
        [true, false, false] => tangent(b, a, c),
        [false, true, false] => tangent(c, a, b),
        [false, false, true] => tangent(a, b, c),
        _ => return None,
    })
}
