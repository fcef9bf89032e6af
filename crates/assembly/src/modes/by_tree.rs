//! Configurations by the equations of an incidence tree.

use super::exact::{decide, decide_with};
use super::{Complete, Configuration, Modes, Part, Way, by_parts, extreme, place, rounded};
use crate::placed::{Placed, Slack, Unsuited};
use crate::real::{RealSolutions, real_solutions, real_solutions_within};
use crate::reduced::ReducedSystem;
use crate::words::count;
use kutzbach_algebra::{Budget, RealSet};
use kutzbach_model::mechanism::Mechanism;

/// What came of it.
pub(super) enum Outcome {
    /// An answer, and whether it is one with all digits that rounding left out.
    Modes(Box<Modes>, bool),
    /// Why the tree cannot say.
    NotByTree(String),
}

/// Boxes that a search may look at: a minute's work, so that there is an end without a limit as well.
const MOST_BOXES: u64 = 4_000_000;

/// Effort of a first search, half a second's: what is small is done by then, and what is singular stays open however long it takes.
const FIRST_EFFORT: u64 = 500_000_000;

/// Share of the effort for subdivision, so that some is left for exact algebra.
const SHARE: f64 = 0.5;

/// Systems of more unknowns than this are not searched: every one more costs ten times as much.
pub(super) const MOST_UNKNOWNS: usize = 6;

/// Of a mechanism whose numbers are known so far.
pub(super) fn answer(mechanism: &Mechanism, slack: &Slack, budget: &Budget) -> Outcome {
    let placed = match Placed::within(mechanism, slack) {
        Ok(placed) => placed,
        Err(Unsuited::Contradiction(mismatch)) => {
            let proven = mismatch
                .gap()
                .is_some_and(|gap| rounded::is_beyond(mechanism, gap));
            let modes = Modes {
                contradiction: Some(mismatch.to_string()),
                ..Modes::new(Way::Nothing)
            };
            return Outcome::Modes(Box::new(modes), proven);
        }
        Err(Unsuited::OneBody(links)) => {
            let configuration = Configuration {
                joints: Vec::new(),
                poses: place::poses_of_one_body(mechanism, &links),
                multiplicity: Some(1),
                proven: true,
                finite: Some(0),
                drawn: false,
            };
            let modes = Modes {
                configurations: vec![configuration],
                ..Modes::new(Way::Nothing)
            };
            let tree = mechanism.joints().len() < mechanism.links().len();
            return Outcome::Modes(Box::new(modes), tree);
        }
        Err(why) => return Outcome::NotByTree(why.to_string()),
    };
    if !place::are_spread(&placed) {
        return Outcome::NotByTree(
            "some of a body's points are the same within rounding".to_owned(),
        );
    }
    let system = match ReducedSystem::within(&placed, slack.share * placed.lever) {
        Ok(system) => system,
        Err(why) => return Outcome::NotByTree(why.to_string()),
    };
    let part = || budget.part(SHARE, Some(MOST_BOXES));
    if slack.share == 0.0
        && let Some(found) = by_parts::answer(&placed, system.freedom(), &part())
    {
        let modes = of_parts(mechanism, &placed, found);
        if is_finite(&modes) {
            return Outcome::Modes(Box::new(modes), false);
        }
    }
    if system.freedom() > MOST_UNKNOWNS {
        return Outcome::NotByTree(format!(
            "the incidence tree leaves {} unknowns",
            system.freedom()
        ));
    }
    let mut modes = Modes::new(way(&system, Vec::new()));
    if system.impossible.is_some() {
        return Outcome::Modes(Box::new(modes), false);
    }
    if system.closures.len() < system.freedom() {
        modes.moves = None;
        modes.complete =
            Complete::Unknown(too_few_equations(system.closures.len(), system.freedom()));
        return Outcome::Modes(Box::new(modes), false);
    }
    let configuration = |unknowns: &[f64], multiplicity: usize, proven: bool| {
        let points = system.points_at(unknowns);
        placed_at(mechanism, &placed, &points, multiplicity, proven)
    };
    // A joint within one body that closes as it is written need not with other digits.
    let loose = placed.redundant && slack.share > 0.0;
    let all = |found: &RealSolutions| -> Vec<Configuration> {
        let roots = found.roots.iter();
        roots
            .map(|root| configuration(&root.unknowns, 1, root.proven && !loose))
            .collect()
    };
    // The numbers are rounded: what holds of all digits is asked first.
    let mut within = None;
    if slack.share > 0.0 {
        let found = real_solutions_within(&system, system.share, &part());
        modes.configurations = all(&found);
        set_boxes(&mut modes, found.boxes);
        if found.open.is_empty() && found.stopped.is_none() && is_finite(&modes) {
            // Near each place there is one at most.
            for configuration in &mut modes.configurations {
                configuration.finite = Some(0);
            }
            return Outcome::Modes(Box::new(modes), true);
        }
        within = Some((modes.configurations.clone(), found.open.len()));
    }
    let mut found = real_solutions(&system, &part().at_most(FIRST_EFFORT));
    set_boxes(&mut modes, found.boxes);
    modes.open = found.open.len();
    modes.configurations = all(&found);
    if !is_finite(&modes) {
        return Outcome::NotByTree(
            "some of a body's points are the same within rounding".to_owned(),
        );
    }
    // More than the equations as they are written have: with other digits these may be configurations too.
    if let Some((places, open)) = within
        && places.len() > modes.configurations.len()
    {
        modes.configurations = places;
        modes.open = open;
        modes.moves = None;
        modes.complete = Complete::Unknown(
            "the numbers are rounded so coarsely that the search leaves places open where there may be several configurations or none"
                .to_owned(),
        );
        return Outcome::Modes(Box::new(modes), false);
    }
    if found.is_complete() {
        return Outcome::Modes(Box::new(modes), false);
    }
    // What is isolated over the reals alone is found by what it is an extreme of.
    let extremes = match slack.share > 0.0 {
        true => Vec::new(),
        false => extreme::equations(&system, &part()),
    };
    let (decided, real_only) = match extremes.is_empty() {
        true => (decide(&system, &budget.part(SHARE, None)), false),
        false => match decide(&system, &part()) {
            Ok(RealSet::Unclear) | Err(_) => (decide_with(&system, &extremes, budget), true),
            decided => (decided, false),
        },
    };
    // Where algebra is no help, subdivision goes on as long as it may.
    if found.stopped.is_some() && matches!(decided, Err(_) | Ok(RealSet::Unclear)) {
        found = real_solutions(&system, &budget.part(1.0, Some(MOST_BOXES)));
        set_boxes(&mut modes, found.boxes);
        modes.open = found.open.len();
        modes.configurations = all(&found);
        if found.is_complete() {
            return Outcome::Modes(Box::new(modes), false);
        }
    }
    match decided {
        Ok(RealSet::Finite { real: all, .. }) => {
            modes.configurations = all
                .iter()
                .map(|(u, m)| Configuration {
                    // Of infinitely many complex solutions none is counted.
                    multiplicity: (!real_only).then_some(*m),
                    ..configuration(u, *m, true)
                })
                .collect();
            modes.open = 0;
            if let Way::Tree { exact, .. } = &mut modes.way {
                *exact = true;
            }
        }
        Ok(RealSet::Dimension(dimension)) => {
            modes.moves = Some(dimension);
            modes.complete = Complete::Unknown(format!(
                "infinitely many: the configurations form a set of dimension {dimension}"
            ));
            if let Way::Tree { exact, .. } = &mut modes.way {
                *exact = true;
            }
        }
        Ok(RealSet::Unclear) => {
            modes.moves = None;
            modes.complete = Complete::Unknown(
                "infinitely many complex solutions; which real ones there are is not known"
                    .to_owned(),
            );
        }
        Err(stop) => {
            modes.moves = None;
            modes.complete = Complete::Unknown(match found.open.len() {
                0 => {
                    "the equations that prove a configuration are more than its unknowns".to_owned()
                }
                open => format!("{open} boxes stayed open, and {stop} in exact algebra"),
            });
        }
    }
    Outcome::Modes(Box::new(modes), false)
}

fn set_boxes(modes: &mut Modes, count: usize) {
    if let Way::Tree { boxes, .. } = &mut modes.way {
        *boxes = count;
    }
}

/// Whether all poses are numbers.
fn is_finite(modes: &Modes) -> bool {
    let finite = |pose: &place::Pose| {
        let numbers = pose
            .translation
            .iter()
            .chain(pose.rotation.iter().flatten());
        numbers.copied().all(f64::is_finite)
    };
    let poses = modes.configurations.iter().flat_map(|c| &c.poses);
    poses.flatten().all(finite)
}

/// A real solution lies on a motion where the equations have independent derivatives. Only over the complex numbers does every
/// solution: a sum of squares is a single equation, and a stretched linkage does not move.
fn too_few_equations(equations: usize, unknowns: usize) -> String {
    format!(
        "{} for {}: where the equations are independent to first order, at least {} left; where they are not, as in a \
         stretched pose, a configuration may be isolated",
        count(equations, "equation"),
        count(unknowns, "unknown"),
        match unknowns - equations {
            1 => "1 freedom is".to_owned(),
            more => format!("{more} degrees of freedom are"),
        }
    )
}

/// An answer by parts.
fn of_parts(mechanism: &Mechanism, placed: &Placed, found: by_parts::Found) -> Modes {
    let places = found.places.iter();
    let configurations = places.map(|place| placed_at(mechanism, placed, &place.points, 1, true));
    let mut modes = Modes {
        configurations: configurations.collect(),
        ..Modes::new(way(&found.system, found.parts))
    };
    set_boxes(&mut modes, found.boxes);
    modes
}

/// The configuration with all points at these places (m).
fn placed_at(
    mechanism: &Mechanism,
    placed: &Placed,
    points: &[Option<[f64; 3]>],
    multiplicity: usize,
    proven: bool,
) -> Configuration {
    Configuration {
        joints: Vec::new(),
        poses: place::link_poses(mechanism, placed, points),
        multiplicity: Some(multiplicity),
        proven,
        finite: proven.then_some(0),
        drawn: false,
    }
}

fn way(system: &ReducedSystem, parts: Vec<Part>) -> Way {
    let name = |body: usize| system.collection.bodies()[body].name.clone();
    let edges = system.tree.edges.iter();
    Way::Tree {
        parts,
        weight: system.tree.weight,
        root: name(system.tree.root),
        edges: edges
            .map(|e| (name(e.parent), name(e.child), e.weight))
            .collect(),
        equations: system.closures.len(),
        degree: system
            .closures
            .iter()
            .map(|c| c.polynomial.degree())
            .max()
            .unwrap_or(0),
        boxes: 0,
        exact: false,
    }
}
