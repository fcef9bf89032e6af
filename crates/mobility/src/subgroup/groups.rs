//! Displacement subgroups met in a part, each once, with what two of them generate and have in common.

use super::axes::{Axes, SAFE};
use super::clear;
use kutzbach_math::group::{Gauge, GroupError, Margin, ScrewSystem, Subalgebra, Twist};
use std::collections::BTreeMap;

/// A subgroup, by its number among those met.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Group(usize);

/// The subgroup of no displacement but the identity.
pub const NOTHING: Group = Group(0);

/// SE(3).
pub const EVERYTHING: Group = Group(1);

/// As many screws of a group are kept for a look at its axes.
const MOST_SCREWS: usize = 6;

/// What projecting a vector on a space of six coordinates loses, as in the rank decisions of `kutzbach_math::group`.
const ROUNDING: f64 = 32.0 * f64::EPSILON;

/// A group with its algebra.
struct Known {
    algebra: Subalgebra,
    basis: Vec<Twist>,
    /// Some screws of it of unit direction: a look at them tells most joins that are SE(3).
    screws: Vec<Twist>,
}

/// The subgroups met in a part, placed where the part is at its pose.
///
/// Whatever is not clearly decided is replaced by something larger that is certain: a join by SE(3), an intersection by one of its two
/// members. So all groups are upper bounds whatever the numbers are like.
pub struct Groups {
    gauge: Gauge,
    known: Vec<Known>,
    joins: BTreeMap<(Group, Group), Group>,
    meets: BTreeMap<(Group, Group), Group>,
    independent: BTreeMap<Vec<Group>, bool>,
    margin: Margin,
}

impl Groups {
    /// E and SE(3).
    pub fn new(gauge: Gauge) -> Result<Self, GroupError> {
        let nothing = Subalgebra::generated_by(&[], &gauge)?;
        let everything = Subalgebra::generated_by_system(&ScrewSystem::full(&gauge))?;
        let mut groups = Self {
            gauge,
            known: Vec::new(),
            joins: BTreeMap::new(),
            meets: BTreeMap::new(),
            independent: BTreeMap::new(),
            margin: Margin::CERTAIN,
        };
        groups.push(nothing, Vec::new());
        groups.push(everything, Vec::new());
        Ok(groups)
    }

    /// The algebra of a group.
    pub fn algebra(&self, group: Group) -> &Subalgebra {
        &self.known[group.0].algebra
    }

    /// Dimension of a group.
    pub fn dimension(&self, group: Group) -> usize {
        self.known[group.0].algebra.dimension()
    }

    /// The worst margin of all that was decided.
    pub fn margin(&self) -> Margin {
        self.margin
    }

    /// The smallest group that contains some screws of unit direction.
    pub fn generated_by(&mut self, screws: &[Twist]) -> Result<Group, GroupError> {
        if self.clearly_everything(screws.iter()) {
            return Ok(EVERYTHING);
        }
        let algebra = Subalgebra::generated_by(screws, &self.gauge)?;
        Ok(self.numbered(algebra, screws).unwrap_or(EVERYTHING))
    }

    /// The smallest group that contains both.
    pub fn join(&mut self, a: Group, b: Group) -> Result<Group, GroupError> {
        let pair = (a.min(b), a.max(b));
        if a == b || pair.0 == NOTHING {
            return Ok(pair.1);
        }
        if a == EVERYTHING || b == EVERYTHING {
            return Ok(EVERYTHING);
        }
        if let Some(known) = self.joins.get(&pair) {
            return Ok(*known);
        }
        let joined = self.joined(a, b)?;
        self.joins.insert(pair, joined);
        Ok(joined)
    }

    fn joined(&mut self, a: Group, b: Group) -> Result<Group, GroupError> {
        let (small, large) = self.by_dimension(a, b);
        if self.is_within(small, large) {
            return Ok(large);
        }
        let screws = |group: Group| self.known[group.0].screws.iter();
        if self.clearly_everything(screws(a).chain(screws(b))) {
            return Ok(EVERYTHING);
        }
        if let Some(known) = self.join_met(small, large) {
            return Ok(known);
        }
        let screws: Vec<Twist> = screws(a).chain(screws(b)).copied().collect();
        let algebra = self.algebra(a).join(self.algebra(b))?;
        Ok(self.numbered(algebra, &screws).unwrap_or(EVERYTHING))
    }

    /// A group of three dimensions already met that two groups generate, neither of which lies in the other: both lie in it, and they generate
    /// more than two, since one of them has two or they do not commute. Spares decompositions.
    fn join_met(&self, small: Group, large: Group) -> Option<Group> {
        let met = (0..self.known.len()).map(Group).find(|&group| {
            self.dimension(group) == 3
                && self.is_within(small, group)
                && self.is_within(large, group)
        })?;
        let [one, other] = [small, large].map(|group| self.known[group.0].basis.first());
        let bracket = one?.bracket(other?);
        let visible = SAFE * self.gauge.tolerance().max(ROUNDING);
        let commute = self.gauge.measure(&bracket).norm() <= visible;
        (self.dimension(large) == 2 || !commute).then_some(met)
    }

    /// What both have in common.
    pub fn meet(&mut self, a: Group, b: Group) -> Result<Group, GroupError> {
        let pair = (a.min(b), a.max(b));
        if a == b || pair.0 == NOTHING {
            return Ok(pair.0);
        }
        if a == EVERYTHING || b == EVERYTHING {
            return Ok(if a == EVERYTHING { b } else { a });
        }
        if let Some(known) = self.meets.get(&pair) {
            return Ok(*known);
        }
        let (small, large) = self.by_dimension(a, b);
        let met = if self.is_within(small, large) {
            small
        } else {
            let algebra = self.algebra(a).intersection(self.algebra(b))?;
            self.numbered(algebra, &[]).unwrap_or(small)
        };
        self.meets.insert(pair, met);
        Ok(met)
    }

    /// Whether some groups are independent: only identities of theirs multiply to the identity, near it.
    pub fn are_independent(&mut self, groups: &[Group]) -> Result<bool, GroupError> {
        let dimension: usize = groups.iter().map(|group| self.dimension(*group)).sum();
        if dimension > 6 {
            return Ok(false);
        }
        if let Some(known) = self.independent.get(groups) {
            return Ok(*known);
        }
        let mut sum = ScrewSystem::empty(&self.gauge);
        for group in groups {
            sum = sum.sum(self.algebra(*group).system())?;
        }
        let independent = sum.dimension() == dimension && clear(sum.margin());
        if independent {
            self.margin = self.margin.and(sum.margin());
        }
        self.independent.insert(groups.to_vec(), independent);
        Ok(independent)
    }

    fn by_dimension(&self, a: Group, b: Group) -> (Group, Group) {
        if self.dimension(a) <= self.dimension(b) {
            (a, b)
        } else {
            (b, a)
        }
    }

    /// Whether screws clearly generate SE(3), at a look.
    fn clearly_everything<'a>(&self, screws: impl Iterator<Item = &'a Twist>) -> bool {
        let mut axes = Axes::new(&self.gauge);
        screws.for_each(|screw| axes.add(screw));
        axes.generate_everything()
    }

    /// Whether a group lies in another within the accuracy of both: the root of the sum of squares of the distances of a basis bounds all
    /// singular values that an intersection would compare with that accuracy.
    fn is_within(&self, small: Group, large: Group) -> bool {
        let (small, large) = (&self.known[small.0], &self.known[large.0]);
        let system = large.algebra.system();
        let accuracy = system.uncertainty() + small.algebra.system().uncertainty() + ROUNDING;
        let mut squares = 0.0;
        for twist in &small.basis {
            squares += system.distance(twist).powi(2);
            if squares > accuracy * accuracy {
                return false;
            }
        }
        true
    }

    /// The number of a group, that of an equal one already met; `None` where it was not clearly decided.
    fn numbered(&mut self, algebra: Subalgebra, screws: &[Twist]) -> Option<Group> {
        if !clear(algebra.margin()) {
            return None;
        }
        self.margin = self.margin.and(algebra.margin());
        match algebra.dimension() {
            0 => return Some(NOTHING),
            6 => return Some(EVERYTHING),
            _ => {}
        }
        let screws = screws.iter().take(MOST_SCREWS).copied().collect();
        let group = self.push(algebra, screws);
        let equal = (0..group.0).map(Group).find(|&other| {
            self.dimension(other) == self.dimension(group) && self.is_within(group, other)
        });
        if let Some(equal) = equal {
            self.known.pop();
            return Some(equal);
        }
        Some(group)
    }

    fn push(&mut self, algebra: Subalgebra, screws: Vec<Twist>) -> Group {
        let basis = algebra.basis();
        self.known.push(Known {
            algebra,
            basis,
            screws,
        });
        Group(self.known.len() - 1)
    }
}
