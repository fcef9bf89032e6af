//! Rule 1 on the part as it is: does the dimension of the cycles' subgroups explain the rank?

use super::axes::Axes;
use super::clear;
use crate::PartRank;
use kutzbach_closure::{Part, WalkedCycle};
use kutzbach_math::group::{Gauge, GroupError, Margin, Subalgebra, Twist};
use nalgebra::Vector3;

/// The algebras that the screws of each cycle generate, in the order of the part's cycles, each in a frame parallel to
/// that of the cycle's first link and with its origin in the cycle's centre.
pub struct LoopSpaces {
    /// One for each cycle.
    pub algebras: Vec<Subalgebra>,
    /// The worst margin met.
    pub margin: Margin,
}

/// The loop spaces of a part where their dimensions add up to `wanted` independent equations; otherwise, or where a margin
/// is thin, `None`. The rank is never more than that sum, so the search ends where the sum exceeds it.
///
/// # Errors
/// [`GroupError`] where screws are not finite.
pub fn loop_spaces(
    part: &Part,
    rank: &PartRank,
    accuracy: f64,
    wanted: usize,
) -> Result<Option<LoopSpaces>, GroupError> {
    let walks = &rank.jacobian.walks;
    if walks.len() != part.cycles.len() {
        return Ok(None);
    }
    let cycles = walks
        .iter()
        .map(|walk| Cycle::of(walk, accuracy))
        .collect::<Result<Vec<_>, _>>()?;
    if 6 * cycles.iter().filter(|cycle| cycle.has_everything()).count() > wanted {
        return Ok(None);
    }
    let mut algebras = Vec::with_capacity(walks.len());
    let mut sum = 0;
    let mut margin = Margin::CERTAIN;
    for cycle in cycles {
        let algebra = Subalgebra::generated_by(&cycle.twists, &cycle.gauge)?;
        sum += algebra.dimension();
        margin = margin.and(algebra.margin());
        // A cycle that explains more equations than its own rank cannot be made up for by another.
        if sum > wanted || !clear(margin) {
            return Ok(None);
        }
        algebras.push(algebra);
    }
    Ok((sum == wanted).then_some(LoopSpaces { algebras, margin }))
}

/// The screws of a cycle, about its centre.
struct Cycle {
    gauge: Gauge,
    twists: Vec<Twist>,
}

impl Cycle {
    fn of(walk: &WalkedCycle<f64>, accuracy: f64) -> Result<Self, GroupError> {
        let gauge = Gauge::new(Vector3::zeros(), walk.length, accuracy)?;
        let twists = walk
            .joints
            .iter()
            .flat_map(|joint| &joint.screws)
            .map(|screw| {
                let (angular, linear) = screw.about(&walk.centre);
                Twist::new(Vector3::from(angular), Vector3::from(linear))
            })
            .collect();
        Ok(Self { gauge, twists })
    }

    /// Whether the screws clearly generate all of se(3), at a look.
    fn has_everything(&self) -> bool {
        let mut axes = Axes::new(&self.gauge);
        self.twists.iter().for_each(|twist| axes.add(twist));
        axes.generate_everything()
    }
}
