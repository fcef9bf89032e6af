//! Relations between the axes and points of a link that rounded numbers nearly satisfy, and that were meant exactly.
//!
//! Whoever draws a linkage draws axes that are parallel or at right angles, that meet or coincide, and links that are alike. Rounding spoils
//! such relations by about as much as it changes numbers, so that they can be seen; and taken for exact, they make most loops close by
//! themselves and leave the rest to lengths and angles that differ for a reason. Asked are, for each pair of axes or points of one
//! link: whether directions are parallel, or make an angle of a whole multiple of 15°; whether lines coincide or meet, whether a
//! point is on a line; which angles and distances of links are alike; and whether the common normals of a hinge with its two
//! neighbours meet on its axis.
//!
//! A relation is taken where what the digits leave open is enough for it, and where it would be rare by chance: twenty times rarer
//! than the relations of its kind that were asked for.

use super::dimensions::{Dimensions, turns};
use crate::intended::Kept;
use crate::vocabulary::RelationKind;
use kutzbach_closure::{Geometry, Part};
use kutzbach_math::space::{Vector, cross, dot, length, subtract};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use std::collections::BTreeMap;
use std::f64::consts::PI;

/// A relation holds within the digits where it is off by no more than so many times the root of the sum of squares of what each
/// number's uncertainty does to it: half a unit in the last place of each is 1/√3 of that in the mean.
const WITHIN: f64 = 2.0;

/// Relations asked for that would hold by chance are fewer than this for each kind.
const BY_CHANCE: f64 = 0.05;

/// Angles that are drawn: multiples of π over this.
const PARTS_OF_PI: usize = 12;

/// On links of more axes than this relations are not asked for.
const MOST_ENDS: usize = 16;

/// Levers by which numbers may do more to a relation than their uncertainties say.
const REACH: f64 = 30.0;

/// Difference quotients are taken over this (rad, part lengths).
const QUOTIENT: f64 = 1e-5;

/// One side of a joint: what is fixed in its link.
#[derive(Clone, Copy, Debug, PartialEq)]
struct End {
    joint: usize,
    side: usize,
    has_place: bool,
    has_direction: bool,
}

/// Two of one link.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Pair {
    ends: [End; 2],
    /// Whether their directions count as parallel.
    parallel: bool,
}

/// What is zero.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Relation {
    /// Directions are parallel.
    Parallel(Pair),
    /// Directions make an angle (rad).
    Angle(Pair, f64),
    /// Lines coincide, a point lies on a line, or points coincide.
    Coincide(Pair),
    /// Lines meet that are not parallel.
    Meet(Pair),
    /// Two angles are alike, or supplementary.
    AnglesAlike([Pair; 2], bool),
    /// Two distances are alike.
    DistancesAlike([Pair; 2]),
    /// The common normals of a hinge with a neighbour on each side meet.
    NormalsMeet([Pair; 2]),
}

/// The relations taken, and what evaluates them.
#[derive(Clone, Debug, Default)]
pub(super) struct Relations {
    all: Vec<Relation>,
}

impl End {
    fn place(&self, geometry: &Geometry<f64>) -> Vector<f64> {
        geometry.sides[self.joint][self.side].translation
    }

    /// A unit vector in the link.
    fn direction(&self, geometry: &Geometry<f64>) -> Vector<f64> {
        let displacement = &geometry.displacements[self.joint];
        let axis = match (displacement.kind(), self.side) {
            (JointKind::Universal, 1) => displacement.second_axis(),
            _ => displacement.axis(),
        };
        geometry.sides[self.joint][self.side].rotate(axis)
    }
}

impl Pair {
    fn has_directions(&self) -> bool {
        self.ends.iter().all(|end| end.has_direction)
    }

    fn has_places(&self) -> bool {
        self.ends.iter().all(|end| end.has_place)
    }

    fn directions(&self, geometry: &Geometry<f64>) -> [Vector<f64>; 2] {
        self.ends.each_ref().map(|end| end.direction(geometry))
    }

    /// From the place of the first to that of the second.
    fn between(&self, geometry: &Geometry<f64>) -> Vector<f64> {
        let [p, q] = self.ends.each_ref().map(|end| end.place(geometry));
        subtract(&q, &p)
    }

    /// From 0 to π.
    fn angle(&self, geometry: &Geometry<f64>) -> f64 {
        let [a, b] = self.directions(geometry);
        length(&cross(&a, &b)).atan2(dot(&a, &b))
    }

    /// What is zero where lines that count as parallel coincide, a point lies on a line, or points coincide.
    fn apart(&self, geometry: &Geometry<f64>) -> Vector<f64> {
        let between = self.between(geometry);
        let line = self.ends.iter().find(|end| end.has_direction);
        match line {
            Some(line) => cross(&between, &line.direction(geometry)),
            None => between,
        }
    }

    /// Signed distance of lines that are not parallel.
    fn offset(&self, geometry: &Geometry<f64>) -> f64 {
        let [a, b] = self.directions(geometry);
        let normal = cross(&a, &b);
        dot(&self.between(geometry), &normal) / length(&normal)
    }

    fn distance(&self, geometry: &Geometry<f64>) -> f64 {
        match self.has_directions() && !self.parallel {
            true => self.offset(geometry).abs(),
            false => length(&self.apart(geometry)),
        }
    }

    /// Where the common normal meets the first axis, from the place of its joint; axes are not parallel.
    fn foot(&self, geometry: &Geometry<f64>) -> f64 {
        let [a, b] = self.directions(geometry);
        let between = self.between(geometry);
        let cosine = dot(&a, &b);
        (dot(&between, &a) - cosine * dot(&between, &b)) / (1.0 - cosine * cosine)
    }
}

impl Relation {
    fn pairs(&self) -> Vec<&Pair> {
        match self {
            Self::Parallel(pair)
            | Self::Angle(pair, _)
            | Self::Coincide(pair)
            | Self::Meet(pair) => {
                vec![pair]
            }
            Self::AnglesAlike(pairs, _)
            | Self::DistancesAlike(pairs)
            | Self::NormalsMeet(pairs) => pairs.iter().collect(),
        }
    }

    fn concerns(&self, joint: usize) -> bool {
        let pairs = self.pairs();
        let mut ends = pairs.iter().flat_map(|pair| &pair.ends);
        ends.any(|end| end.joint == joint)
    }

    /// What has to be zero (rad, lengths of the part).
    fn rows(&self, geometry: &Geometry<f64>, size: f64) -> Vec<f64> {
        match self {
            Self::Parallel(pair) => {
                let [a, b] = pair.directions(geometry);
                cross(&a, &b).to_vec()
            }
            Self::Angle(pair, angle) => vec![pair.angle(geometry) - angle],
            Self::Coincide(pair) => pair.apart(geometry).map(|x| x / size).to_vec(),
            Self::Meet(pair) => vec![pair.offset(geometry) / size],
            Self::AnglesAlike([one, other], supplementary) => {
                let [one, other] = [one, other].map(|pair| pair.angle(geometry));
                vec![match supplementary {
                    true => one + other - PI,
                    false => one - other,
                }]
            }
            Self::DistancesAlike([one, other]) => {
                vec![(one.distance(geometry) - other.distance(geometry)) / size]
            }
            Self::NormalsMeet([one, other]) => {
                vec![(one.foot(geometry) - other.foot(geometry)) / size]
            }
        }
    }
}

impl Relations {
    /// The relations in words.
    pub fn kept(&self) -> Vec<Kept> {
        let each = self.all.iter().map(|relation| {
            let (kind, angle) = match relation {
                Relation::Parallel(_) => (RelationKind::Parallel, None),
                Relation::Angle(_, angle) => (RelationKind::Angle, Some(*angle)),
                Relation::Coincide(_) => (RelationKind::Coincide, None),
                Relation::Meet(_) => (RelationKind::Meet, None),
                Relation::AnglesAlike(..) => (RelationKind::EqualAngles, None),
                Relation::DistancesAlike(_) => (RelationKind::EqualDistances, None),
                Relation::NormalsMeet(_) => (RelationKind::NormalsMeet, None),
            };
            let pairs = relation.pairs();
            let ends = pairs.iter().flat_map(|pair| &pair.ends);
            Kept {
                kind,
                joints: ends.map(|end| end.joint).collect(),
                angle,
            }
        });
        each.collect()
    }

    /// Those that a part's numbers nearly satisfy; `size` is the part's length (m).
    pub fn of(
        mechanism: &Mechanism,
        part: &Part,
        dimensions: &Dimensions<'_>,
        geometry: &Geometry<f64>,
        size: f64,
    ) -> Self {
        let found = Finder {
            dimensions,
            geometry,
            size,
        };
        let mut pairs = pairs(mechanism, part);
        let mut all = Vec::new();
        for pair in &mut pairs {
            let relation = Relation::Parallel(*pair);
            if pair.has_directions() && found.rarely_holds(&relation, 1, 1.0) {
                pair.parallel = true;
                all.push(relation);
            }
        }
        for pair in &pairs {
            all.extend(found.at_a_drawn_angle(pair));
            all.extend(found.touching(pair));
        }
        let apart: Vec<Pair> = pairs
            .iter()
            .filter(|pair| !all.iter().any(|known| places_it(known, pair)))
            .copied()
            .collect();
        all.extend(found.angles_alike(&pairs, &all));
        all.extend(found.distances_alike(&apart));
        all.extend(found.normals_that_meet(mechanism, &pairs));
        Self { all }
    }

    #[cfg(test)]
    pub fn parallel_pairs(&self) -> usize {
        let parallel = |relation: &&Relation| matches!(relation, Relation::Parallel(_));
        self.all.iter().filter(parallel).count()
    }

    pub fn is_empty(&self) -> bool {
        self.all.is_empty()
    }

    /// What has to be zero (rad, lengths of the part).
    pub fn rows(&self, geometry: &Geometry<f64>, size: f64) -> Vec<f64> {
        let rows = self
            .all
            .iter()
            .map(|relation| relation.rows(geometry, size));
        rows.flatten().collect()
    }

    /// The rows that a joint's numbers change: (place among all, value).
    pub fn rows_of(&self, joint: usize, geometry: &Geometry<f64>, size: f64) -> Vec<(usize, f64)> {
        let mut rows = Vec::new();
        let mut next = 0;
        for relation in &self.all {
            let count = match relation {
                Relation::Parallel(_) | Relation::Coincide(_) => 3,
                _ => 1,
            };
            if relation.concerns(joint) {
                let values = relation.rows(geometry, size);
                rows.extend(values.into_iter().enumerate().map(|(i, x)| (next + i, x)));
            }
            next += count;
        }
        rows
    }
}

/// Whether a relation says where the two of a pair are.
fn places_it(relation: &Relation, pair: &Pair) -> bool {
    matches!(relation, Relation::Coincide(known) | Relation::Meet(known) if known == pair)
}

/// What relations are asked of.
struct Finder<'a> {
    dimensions: &'a Dimensions<'a>,
    geometry: &'a Geometry<f64>,
    size: f64,
}

impl Finder<'_> {
    /// Whether a relation holds within the digits though, of `asked` like it whose values reach over `range`, few would by chance.
    fn rarely_holds(&self, relation: &Relation, asked: usize, range: f64) -> bool {
        let off = norm(&relation.rows(self.geometry, self.size));
        // What is far from it is not asked how far the digits go.
        if off > WITHIN * self.dimensions.noise(self.size) * relation.pairs().len() as f64 * REACH {
            return false;
        }
        let open = WITHIN * self.left_open(relation);
        open > 0.0 && off <= open && asked as f64 * open <= BY_CHANCE * range
    }

    /// Root of the sum of squares of what each number's uncertainty does to a relation.
    fn left_open(&self, relation: &Relation) -> f64 {
        let here = relation.rows(self.geometry, self.size);
        let mut geometry = self.geometry.clone();
        let mut squares = 0.0;
        for dimension in &self.dimensions.all {
            if !relation.concerns(dimension.joint) {
                continue;
            }
            let joint = dimension.joint;
            let mut numbers = self.dimensions.numbers(joint, &[]);
            let step = match turns(dimension.place) {
                true => QUOTIENT,
                false => QUOTIENT * self.size,
            };
            numbers.0[dimension.place] += step;
            self.dimensions.set(&mut geometry, joint, &numbers, []);
            let there = relation.rows(&geometry, self.size);
            let moved = here.iter().zip(&there).map(|(a, b)| (b - a).powi(2));
            squares += moved.sum::<f64>() * (dimension.unit / step).powi(2);
            geometry.displacements[joint] = self.geometry.displacements[joint].clone();
            geometry.sides[joint] = self.geometry.sides[joint].clone();
        }
        squares.sqrt()
    }

    fn at_a_drawn_angle(&self, pair: &Pair) -> Option<Relation> {
        if !pair.has_directions() || pair.parallel {
            return None;
        }
        let part = PI / PARTS_OF_PI as f64;
        let drawn = (pair.angle(self.geometry) / part).round();
        let relation = Relation::Angle(*pair, drawn * part);
        let between = (1.0..PARTS_OF_PI as f64).contains(&drawn);
        (between && self.rarely_holds(&relation, 1, part)).then_some(relation)
    }

    fn touching(&self, pair: &Pair) -> Option<Relation> {
        if !pair.has_places() {
            return None;
        }
        let relation = match pair.has_directions() && !pair.parallel {
            true => Relation::Meet(*pair),
            false => Relation::Coincide(*pair),
        };
        self.rarely_holds(&relation, 1, 1.0).then_some(relation)
    }

    /// Angles that are neither zero nor at a drawn angle, alike up to sign.
    fn angles_alike(&self, pairs: &[Pair], known: &[Relation]) -> Vec<Relation> {
        let drawn = |pair: &Pair| {
            let mut known = known.iter();
            known.any(|relation| matches!(relation, Relation::Angle(other, _) if other == pair))
        };
        let open: Vec<&Pair> = pairs
            .iter()
            .filter(|pair| pair.has_directions() && !pair.parallel && !drawn(pair))
            .collect();
        let acute = |pair: &Pair| {
            let angle = pair.angle(self.geometry);
            angle.min(PI - angle)
        };
        alike(&open, acute)
            .into_iter()
            .map(|[one, other]| {
                let angles = [one, other].map(|pair| pair.angle(self.geometry));
                let [one_obtuse, other_obtuse] = angles.map(|angle| angle > PI / 2.0);
                Relation::AnglesAlike([one, other], one_obtuse != other_obtuse)
            })
            .filter(|relation| self.rarely_holds(relation, open.len(), PI / 2.0))
            .collect()
    }

    fn distances_alike(&self, pairs: &[Pair]) -> Vec<Relation> {
        let open: Vec<&Pair> = pairs.iter().filter(|pair| pair.has_places()).collect();
        alike(&open, |pair| pair.distance(self.geometry))
            .into_iter()
            .map(Relation::DistancesAlike)
            .filter(|relation| self.rarely_holds(relation, open.len(), 1.0))
            .collect()
    }

    /// Of hinges between two links with two axes each.
    fn normals_that_meet(&self, mechanism: &Mechanism, pairs: &[Pair]) -> Vec<Relation> {
        let mut of_end: BTreeMap<(usize, usize), Vec<Pair>> = BTreeMap::new();
        for pair in pairs
            .iter()
            .filter(|pair| pair.has_directions() && !pair.parallel)
        {
            let [one, other] = pair.ends;
            for ends in [[one, other], [other, one]] {
                let pair = Pair { ends, ..*pair };
                of_end
                    .entry((ends[0].joint, ends[0].side))
                    .or_default()
                    .push(pair);
            }
        }
        let only = |joint: usize, side: usize| match of_end.get(&(joint, side)).map(Vec::as_slice) {
            Some([pair]) if pair.has_places() => Some(*pair),
            _ => None,
        };
        (0..mechanism.joints().len())
            .filter(|&joint| mechanism.joints()[joint].kind == JointKind::Revolute)
            .filter_map(|joint| Some(Relation::NormalsMeet([only(joint, 0)?, only(joint, 1)?])))
            .filter(|relation| self.rarely_holds(relation, 1, 1.0))
            .collect()
    }
}

/// Each pair with that whose value is next above its own.
fn alike(pairs: &[&Pair], value: impl Fn(&Pair) -> f64) -> Vec<[Pair; 2]> {
    let mut sorted: Vec<(f64, Pair)> = pairs.iter().map(|pair| (value(pair), **pair)).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    sorted.windows(2).map(|two| [two[0].1, two[1].1]).collect()
}

/// All pairs of axes and points of one link, of the joints of a part.
fn pairs(mechanism: &Mechanism, part: &Part) -> Vec<Pair> {
    let mut ends: BTreeMap<usize, Vec<End>> = BTreeMap::new();
    for &joint in &part.joints {
        let like = &mechanism.joints()[joint];
        let [has_place, has_direction] = match like.kind {
            JointKind::Revolute
            | JointKind::Cylindrical
            | JointKind::Screw
            | JointKind::Universal => [true, true],
            JointKind::Prismatic => [false, true],
            JointKind::Spherical => [true, false],
            _ => continue,
        };
        for (side, end) in [&like.predecessor, &like.successor].into_iter().enumerate() {
            ends.entry(end.link.0).or_default().push(End {
                joint,
                side,
                has_place,
                has_direction,
            });
        }
    }
    let mut pairs = Vec::new();
    for ends in ends.values().filter(|ends| ends.len() <= MOST_ENDS) {
        for (i, one) in ends.iter().enumerate() {
            let with = ends[i + 1..].iter().map(|other| Pair {
                ends: [*one, *other],
                parallel: false,
            });
            pairs.extend(with.filter(|pair| pair.has_places() || pair.has_directions()));
        }
    }
    pairs
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}
