//! Configurations of planar mechanisms by circles and lines, one after the other.
//!
//! All hinges are parallel and all sliders across them, and links hold one another in that plane: so every configuration is one of the
//! sketch. Its steps have two places at most, and what does not hang together multiplies: a machine of many dyads has 2ᵏ configurations,
//! which are counted and not listed.

use super::{Complete, Configuration, Modes, Way, place};
use crate::placed::Slack;
use kutzbach_algebra::Budget;
use kutzbach_constructive::analysis::s_tree;
use kutzbach_constructive::construction::{Construction, Outcome, Shape};
use kutzbach_constructive::planar::Planar;
use kutzbach_constructive::sketch::{Element, Sketch};
use kutzbach_constructive::together::together_from;
use kutzbach_math::number::Number;
use kutzbach_model::mechanism::Mechanism;

/// Configurations that are listed; those nearest to the drawing come first.
const MOST_LISTED: usize = 256;

/// The answer where what circles and lines do not construct is solved at once, by exact algebra; `None` where that is not the case, or takes
/// longer than it may.
pub(super) fn at_once(mechanism: &Mechanism, budget: &Budget) -> Option<Modes> {
    let planar = Planar::of(mechanism).ok()?;
    let sketch = &planar.sketch.sketch;
    let tree = s_tree(sketch.graph());
    let found = together_from(sketch, &tree, budget);
    let cores = found.cores.iter().map(|core| core.elements.len()).collect();
    let mut modes = Modes::new(Way::AtOnce { cores });
    for (shapes, multiplicity) in found.solutions(sketch, MOST_LISTED)? {
        let found = configuration(mechanism, &planar, &shapes, Some(multiplicity), true)?;
        modes.configurations.push(found);
    }
    Some(modes)
}

/// A configuration from where the elements are; `None` where a body has no two that hold it.
fn configuration(
    mechanism: &Mechanism,
    planar: &Planar,
    shapes: &[Shape],
    multiplicity: Option<usize>,
    proven: bool,
) -> Option<Configuration> {
    let mut poses: Vec<_> = planar.poses(shapes)?.into_iter().map(Some).collect();
    place::onto_ground(mechanism, &mut poses);
    Some(Configuration {
        joints: Vec::new(),
        poses,
        multiplicity,
        proven,
        finite: proven.then_some(0),
        drawn: false,
    })
}

/// The answer where circles and lines construct the mechanism, in at least so many steps of two places; `None` elsewhere.
///
/// With it whether it is the answer for all numbers that are known so far.
pub(super) fn answer(mechanism: &Mechanism, slack: &Slack, least: usize) -> Option<(Modes, bool)> {
    let planar = Planar::of(mechanism).ok()?;
    let construction = Construction::new(&planar.sketch.sketch).ok()?;
    let steps = (0..construction.drawn_left().len()).filter(|step| !construction.is_rigid(*step));
    let steps = steps.count();
    if steps < least {
        return None;
    }
    let count = construction.count();
    // What doubles leave open exact algebra may decide.
    if count.degenerate || count.infinite || least > 0 && count.between.is_some() {
        return None;
    }
    let mut modes = Modes::new(Way::Construction { steps });
    for solution in construction.solutions().take(MOST_LISTED) {
        // What one link has on a line has one place, although circles touch there.
        let outcomes: Vec<Outcome> = construction
            .outcomes(&solution.left)
            .into_iter()
            .enumerate()
            .filter(|(step, _)| !construction.is_rigid(*step))
            .map(|(_, outcome)| outcome)
            .collect();
        let touching = |o: &&Outcome| matches!(o, Outcome::Touching { .. });
        let double = outcomes.iter().filter(touching).count();
        let nearly = |o: &Outcome| matches!(o, Outcome::Touching { within } if *within > 0.0);
        let proven = !outcomes.iter().any(nearly);
        let times = 1_usize.checked_shl(u32::try_from(double).ok()?);
        let found = configuration(mechanism, &planar, &solution.shapes, times, proven)?;
        modes.configurations.push(found);
    }
    let listed = modes.configurations.len();
    if count.value() != Some(listed as u128) {
        modes.in_all = Some(count.to_string());
    }
    if !count.complete {
        modes.complete = Complete::Unknown(
            "there are more choices than are tried, so that there are at least so many".to_owned(),
        );
    } else if modes.configurations.iter().any(|c| !c.proven) || count.between.is_some() {
        modes.complete =
            Complete::Unknown("circles touch or nearly do, which doubles do not decide".to_owned());
    }
    let stays =
        modes.complete == Complete::Proven && stays(&planar.sketch.sketch, &construction, slack);
    Some((modes, stays))
}

/// Steps of two places at most, all choices of which are looked at with other digits.
const FEW_STEPS: usize = 6;

/// Share of a margin that other digits may use up: what they do is found to first order.
const USED: f64 = 0.5;

/// Whether every step of every choice, up to the first that is impossible, turns out the same with all lengths and angles off by what is
/// known of them.
fn stays(sketch: &Sketch, construction: &Construction<'_>, slack: &Slack) -> bool {
    let drawn = construction.drawn_left();
    let free: Vec<usize> = (0..drawn.len())
        .filter(|s| !construction.is_rigid(*s))
        .collect();
    if slack.share == 0.0 || free.len() > FEW_STEPS {
        return false;
    }
    let is_line = |e: &usize| matches!(sketch.elements()[*e], Element::Line { .. });
    let moved = sketch
        .constraints()
        .iter()
        .enumerate()
        .map(|(i, constraint)| {
            let by = if constraint.ends.iter().all(is_line) {
                slack.share
            } else {
                slack.metres
            };
            Number::from_f64(constraint.value.value() + by).map(|value| sketch.with_value(i, value))
        });
    let Some(moved) = moved.collect::<Option<Vec<Sketch>>>() else {
        return false;
    };
    let others: Result<Vec<_>, _> = moved.iter().map(Construction::new).collect();
    let Ok(others) = others else {
        return false;
    };
    (0..1_usize << free.len()).all(|choice| {
        let mut left = drawn.to_vec();
        for (bit, step) in free.iter().enumerate() {
            left[*step] ^= choice >> bit & 1 == 1;
        }
        let here = construction.outcomes(&left);
        let there: Vec<Vec<Outcome>> = others.iter().map(|c| c.outcomes(&left)).collect();
        let last = here
            .iter()
            .position(|o| !o.is_possible())
            .unwrap_or(here.len() - 1);
        (0..=last).filter(|step| free.contains(step)).all(|step| {
            let Some(own) = margin(&here[step]) else {
                return false;
            };
            let used = there
                .iter()
                .map(|outcomes| Some((margin(&outcomes[step])? - own).abs()));
            let used: Option<f64> = used.sum();
            used.is_some_and(|used| used <= USED * own.abs())
        })
    })
}

/// By how much circles overlap, below zero where they stay apart; `None` where they touch or nothing fixes the element.
fn margin(outcome: &Outcome) -> Option<f64> {
    match outcome {
        Outcome::Two { by } => Some(*by),
        Outcome::Apart { by } => Some(-by),
        Outcome::One => Some(f64::MAX),
        Outcome::Touching { .. } | Outcome::Degenerate => None,
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::by_tree::{self, Outcome as ByTree};
    use super::super::{inputs, place::apart};
    use super::*;
    use crate::samples;
    use kutzbach_algebra::Budget;
    use kutzbach_algebra::Limits;
    use std::fmt::Write;
    use std::path::Path;

    /// Four-bars in a row, each driven by the rocker of the one before; the crank held.
    fn chain(loops: usize) -> Mechanism {
        let mut joints = String::from(
            "<joint name=\"crank\" type=\"fixed\"><parent link=\"g\"/><child link=\"b0\"/></joint>",
        );
        let mut links = String::from("<link name=\"g\"/><link name=\"b0\"/>");
        for k in 0..loops {
            let (near, far) = (6 * k, 6 * k + 6);
            let _ = write!(
                links,
                "<link name=\"c{k}\"/><link name=\"b{next}\"/>",
                next = k + 1
            );
            let hinge = |name: &str, on: [&str; 2], at: &str| {
                format!(
                    "<loop name=\"{name}{k}\" type=\"continuous\"><predecessor link=\"{}\"><origin xyz=\"{at}\"/></predecessor>\
                     <successor link=\"{}\"><origin xyz=\"{at}\"/></successor><axis xyz=\"0 0 1\"/></loop>",
                    on[0], on[1]
                )
            };
            let [b, c, next] = [format!("b{k}"), format!("c{k}"), format!("b{}", k + 1)];
            joints += &hinge("p", [&b, &c], &format!("{near} 2 0"));
            joints += &hinge("q", [&c, &next], &format!("{far} 3 0"));
            joints += &hinge("r", [&next, "g"], &format!("{far} 0 0"));
            for link in [&c, &next] {
                let _ = write!(
                    joints,
                    "<joint name=\"at {link}\" type=\"floating\"><parent link=\"g\"/><child link=\"{link}\"/></joint>"
                );
            }
        }
        let text = format!("<robot name=\"chain\">{links}{joints}</robot>");
        kutzbach_format::read(&text, "chain.urdf", &[])
            .unwrap()
            .mechanism
    }

    /// Circles and lines find what subdivision and exact algebra on the equations of a tree find.
    #[test]
    fn constructions_and_trees_agree() {
        let zoo = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/zoo");
        let of_zoo = |name: &str| {
            let drawn = samples::read(&zoo.join(name).with_extension("urdf"), &[]);
            let held = inputs::proposed(&drawn).held;
            drawn.with_joints_held(&held).unwrap()
        };
        for (mechanism, count) in [
            (of_zoo("jansen_leg"), 8),
            (of_zoo("watt_I"), 4),
            (of_zoo("stephenson_III"), 2),
            (chain(3), 8),
        ] {
            let name = mechanism.name();
            let built = answer(&mechanism, &Slack::default(), 0).unwrap().0;
            assert_eq!(built.complete, Complete::Proven, "{name}");
            assert_eq!(built.configurations.len(), count, "{name}");
            let budget = Budget::new(Limits::seconds(60.0));
            let ByTree::Modes(tree, _) = by_tree::answer(&mechanism, &Slack::default(), &budget)
            else {
                panic!("{name}");
            };
            same(&built, &tree, name);
        }
    }

    /// Each configuration of one answer is one of the other.
    fn same(one: &Modes, other: &Modes, name: &str) {
        assert_eq!(
            one.configurations.len(),
            other.configurations.len(),
            "{name}"
        );
        for configuration in &one.configurations {
            let poses = |other: &&Configuration| {
                let pairs = configuration
                    .poses
                    .iter()
                    .flatten()
                    .zip(other.poses.iter().flatten());
                pairs.into_iter().all(|(a, b)| apart(a, b, 10.0) < 1e-6)
            };
            assert_eq!(
                other.configurations.iter().filter(poses).count(),
                1,
                "{name}"
            );
        }
    }

    /// A platform on three legs is no construction: subdivision and exact algebra in coordinates find the same.
    #[test]
    fn what_is_solved_at_once_agrees_with_the_tree() {
        let drawn = samples::own("planar_3rrr");
        let mechanism = drawn
            .with_joints_held(&inputs::proposed(&drawn).held)
            .unwrap();
        let budget = Budget::new(Limits::seconds(60.0));
        assert!(answer(&mechanism, &Slack::default(), 0).is_none());
        let found = at_once(&mechanism, &budget).unwrap();
        let ByTree::Modes(tree, _) = by_tree::answer(&mechanism, &Slack::default(), &budget) else {
            panic!("no tree");
        };
        assert_eq!(
            (found.complete.clone(), found.configurations.len()),
            (Complete::Proven, 2)
        );
        same(&found, &tree, "planar_3rrr");
    }

    #[test]
    fn many_steps_are_counted_and_not_listed() {
        let built = answer(&chain(10), &Slack::default(), 0).unwrap().0;
        assert_eq!(built.complete, Complete::Proven);
        assert_eq!(
            (built.in_all.as_deref(), built.configurations.len()),
            (Some("1024"), MOST_LISTED)
        );
        assert!(
            built
                .configurations
                .iter()
                .all(|c| c.proven && c.multiplicity == Some(1))
        );
    }
}
