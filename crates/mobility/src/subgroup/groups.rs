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

/// Up to so many groups of three dimensions all are looked at for one that holds two others; beyond, those that joins with one of the
/// two have come to.
const MOST_SEARCHED: usize = 256;

/// A direction that is special to no group: unit vectors of se(3) differ from it in all coordinates.
const PROBE: [f64; 6] = [0.31, -0.47, 0.59, 0.23, 0.41, -0.36];

/// A group with its algebra.
struct Known {
    algebra: Subalgebra,
    basis: Vec<Twist>,
    /// Groups of three dimensions that it was joined to.
    within: Vec<Group>,
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
    /// Those of three dimensions.
    threes: Vec<Group>,
    probe: Twist,
    /// By dimension and distance of the probe (a double that is not negative, whose bits rise with it). Spaces of one dimension, of
    /// which one lies in the other to within an angle, are no farther apart than its sine in this distance.
    index: BTreeMap<(usize, u64), Vec<Group>>,
    /// The largest uncertainty of any.
    widest: f64,
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
            threes: Vec::new(),
            probe: gauge.twist(&PROBE.into()),
            index: BTreeMap::new(),
            widest: 0.0,
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
        if self.dimension(joined) == 3 {
            for part in [a, b] {
                let within = &mut self.known[part.0].within;
                if !within.contains(&joined) {
                    within.push(joined);
                }
            }
        }
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
        let holds = |group: &Group| self.is_within(small, *group) && self.is_within(large, *group);
        let met = match self.threes.len() <= MOST_SEARCHED {
            true => self.threes.iter().copied().find(holds),
            false => {
                let near = [small, large].map(|group| self.known[group.0].within.iter());
                near.into_iter().flatten().copied().filter(holds).min()
            }
        }?;
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
        let dimension = algebra.dimension();
        let system = algebra.system();
        let (place, own) = (system.distance(&self.probe), system.uncertainty());
        let reach = self.widest + own + 2.0 * ROUNDING;
        let near = [(place - reach).max(0.0), place + reach].map(|x| (dimension, x.to_bits()));
        let screws = screws.iter().take(MOST_SCREWS).copied().collect();
        let group = self.push(algebra, screws);
        let others = self.index.range(near[0]..=near[1]).flat_map(|(_, g)| g);
        let equal = others.filter(|&&other| self.is_within(group, other)).min();
        if let Some(&equal) = equal {
            self.known.pop();
            return Some(equal);
        }
        self.widest = self.widest.max(own);
        let at = self.index.entry((dimension, place.to_bits())).or_default();
        at.push(group);
        if dimension == 3 {
            self.threes.push(group);
        }
        Some(group)
    }

    fn push(&mut self, algebra: Subalgebra, screws: Vec<Twist>) -> Group {
        let basis = algebra.basis();
        self.known.push(Known {
            algebra,
            basis,
            within: Vec::new(),
            screws,
        });
        Group(self.known.len() - 1)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_math::matrix::SplitMix64;
    use nalgebra::Vector3;

    #[test]
    fn groups_are_known_again_however_many_there_are() {
        let gauge = Gauge::new(Vector3::zeros(), 1.0, 1e-12).unwrap();
        let mut groups = Groups::new(gauge).unwrap();
        let mut random = SplitMix64::named("hinges through points");
        let mut vector = || Vector3::from_fn(|_, _| random.symmetric());
        // More balls than are searched through, each as three hinges through a point.
        let stars: Vec<[Twist; 3]> = (0..MOST_SEARCHED + 40)
            .map(|_| {
                let centre = vector();
                [(); 3].map(|()| Twist::revolute(vector(), centre))
            })
            .collect();
        let mut balls = Vec::new();
        for star in &stars {
            let hinges = star.map(|hinge| groups.generated_by(&[hinge]).unwrap());
            let [ball, same, again] = [[0, 1], [1, 2], [2, 0]]
                .map(|pair| pair.map(|i| hinges[i]))
                .map(|[a, b]| groups.join(a, b).unwrap());
            assert_eq!((groups.dimension(ball), same, again), (3, ball, ball));
            balls.push(ball);
        }
        let mut known = balls.clone();
        known.dedup();
        assert_eq!(known.len(), stars.len());
        for (star, ball) in stars.iter().zip(balls) {
            assert_eq!(groups.generated_by(star).unwrap(), ball);
        }
    }
}
