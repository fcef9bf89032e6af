//! What is over-constrained, what is left free: the pebble game, and where lines are many, the rank of the equations besides.
//!
//! # Why
//! Directions are counted too: n lines hold n − 1 independent angles, whether these are stated or held by bodies that share lines, and a ring of
//! angles says once too often how its lines are turned. The (2,3) count does not see it. What it says of points alone, and of two
//! lines, is right; for more the rule is that of Jackson and Owen (2016): m constraints are independent only if for every partition of them
//! m ≤ Σ (2 pᵢ + lᵢ − 2) + l − 1, for pᵢ points and lᵢ lines in part i, l lines in all.
//!
//! # How
//! The generic rank of the equations' Jacobian, which that rule gives, is the rank at a random place, calculated modulo the prime
//! 2⁶¹ − 1, row after row: a row that those before it combine to is a constraint too many, and those that do so are its circuit. At a random
//! place a polynomial of degree d that is not zero is zero with probability d/p at most (Schwartz 1980): below 10⁻¹³ for a thousand
//! constraints.

use crate::pebbles::{Circuit, PebbleGame, Standing};
use crate::samples::Random;
use crate::sketch::{Element, Sketch};
use std::collections::{BTreeMap, BTreeSet};

/// 2⁶¹ − 1, a prime.
const PRIME: u64 = (1 << 61) - 1;

/// Products that an elimination may take; a sketch that would take more is counted by the game alone.
const MOST_PRODUCTS: u64 = 50_000_000;

/// The count of a sketch.
#[derive(Clone, Debug)]
pub struct Counted {
    game: PebbleGame,
    /// What the game does not see: circuits and freedoms.
    by_rank: Option<(Vec<Circuit>, usize)>,
}

impl Counted {
    /// Counts.
    #[must_use]
    pub fn of(sketch: &Sketch) -> Self {
        let game = PebbleGame::play(sketch.graph());
        let lines = sketch.elements().iter().filter(|e| e.is_line()).count();
        let by_rank = (lines > 2).then(|| circuits(sketch)).flatten();
        // Where both refuse the same constraints, the game names the smallest rigid parts.
        let refused = |circuits: &[Circuit]| circuits.iter().map(|c| c.edge).collect::<Vec<_>>();
        let by_rank = by_rank.filter(|circuits| refused(circuits) != refused(game.circuits()));
        let by_rank = by_rank.map(|circuits| {
            let rank = sketch.constraints().len() - circuits.len();
            let freedoms = (2 * sketch.elements().len() - 3).saturating_sub(rank);
            (circuits, freedoms)
        });
        Self { game, by_rank }
    }

    /// Over-, under- or well-constrained.
    #[must_use]
    pub fn standing(&self) -> Standing {
        match (self.circuits().is_empty(), self.freedoms()) {
            (false, _) => Standing::Over,
            (true, 0) => Standing::Well,
            (true, _) => Standing::Under,
        }
    }

    /// The freedoms left beside the three of the whole in the plane.
    #[must_use]
    pub fn freedoms(&self) -> usize {
        self.by_rank.as_ref().map_or(self.game.freedoms(), |r| r.1)
    }

    /// Every constraint that those before it imply, with the elements of those that do.
    #[must_use]
    pub fn circuits(&self) -> &[Circuit] {
        match &self.by_rank {
            Some((circuits, _)) => circuits,
            None => self.game.circuits(),
        }
    }

    /// The largest parts that are rigid in themselves; none where directions decide, since the game does not know then.
    #[must_use]
    pub fn rigid_parts(&self) -> Vec<Vec<usize>> {
        match self.by_rank {
            Some(_) => Vec::new(),
            None => self.game.rigid_parts(),
        }
    }
}

/// A row, by column.
type Row = BTreeMap<usize, u64>;

/// The constraints that those before them imply; `None` where that takes too long.
fn circuits(sketch: &Sketch) -> Option<Vec<Circuit>> {
    let places = places(sketch);
    let mut left = MOST_PRODUCTS;
    // By first column: the row, and which constraints it is a sum of.
    let mut pivots: BTreeMap<usize, (Row, Row)> = BTreeMap::new();
    let mut circuits = Vec::new();
    for (edge, constraint) in sketch.constraints().iter().enumerate() {
        let mut row = gradient(constraint.ends, &places);
        let mut from = Row::from([(edge, 1)]);
        while let Some((&column, &value)) = row.first_key_value() {
            let Some((pivot, parts)) = pivots.get(&column) else {
                break;
            };
            // The pivot's first entry is 1.
            left = left.checked_sub((pivot.len() + parts.len()) as u64)?;
            subtract(&mut row, value, pivot);
            subtract(&mut from, value, parts);
        }
        match row.first_key_value() {
            None => {
                let ends = from.keys().flat_map(|&e| sketch.constraints()[e].ends);
                let vertices: BTreeSet<usize> = ends.collect();
                let vertices = vertices.into_iter().collect();
                circuits.push(Circuit { edge, vertices });
            }
            Some((&column, &value)) => {
                let inverse = power(value, PRIME - 2);
                for entry in row.values_mut().chain(from.values_mut()) {
                    *entry = times(*entry, inverse);
                }
                pivots.insert(column, (row, from));
            }
        }
    }
    Some(circuits)
}

/// `row − factor · other`, without zeros.
fn subtract(row: &mut Row, factor: u64, other: &Row) {
    for (&column, &value) in other {
        let entry = row.entry(column).or_insert(0);
        *entry = minus(*entry, times(factor, value));
        if *entry == 0 {
            row.remove(&column);
        }
    }
}

/// A random place: x and y of a point; cosine and sine of a line's normal, to which it has some distance from the origin.
fn places(sketch: &Sketch) -> Vec<(bool, [u64; 2])> {
    let mut random = Random::new(1);
    let mut any = || random.bits() % PRIME;
    let place = |element: &Element| match element {
        Element::Point(_) => (false, [any(), any()]),
        Element::Line { .. } => {
            // The circle by its rational parameter; −1 is no square modulo this prime, so that 1 + t² is not zero.
            let t = any();
            let square = times(t, t);
            let inverse = power(plus(1, square), PRIME - 2);
            (
                true,
                [times(minus(1, square), inverse), times(plus(t, t), inverse)],
            )
        }
    };
    sketch.elements().iter().map(place).collect()
}

/// How a constraint changes with the unknowns: x and y of a point; angle and distance from the origin of a line.
fn gradient(ends: [usize; 2], places: &[(bool, [u64; 2])]) -> Row {
    let [u, v] = ends;
    let row = |entries: [(usize, u64); 4]| entries.into_iter().filter(|(_, x)| *x != 0).collect();
    match (places[u], places[v]) {
        ((true, _), (true, _)) => row([(2 * u, 1), (2 * v, minus(0, 1)), (0, 0), (1, 0)]),
        ((false, p), (false, q)) => {
            let [x, y] = [0, 1].map(|i| minus(p[i], q[i]));
            row([
                (2 * u, x),
                (2 * u + 1, y),
                (2 * v, minus(0, x)),
                (2 * v + 1, minus(0, y)),
            ])
        }
        ((false, p), (true, n)) => row(beside([u, v], p, n)),
        ((true, n), (false, p)) => row(beside([v, u], p, n)),
    }
}

/// The distance of a point from a line.
fn beside([point, line]: [usize; 2], p: [u64; 2], n: [u64; 2]) -> [(usize, u64); 4] {
    let turned = minus(times(n[0], p[1]), times(n[1], p[0]));
    let own = [(2 * point, n[0]), (2 * point + 1, n[1])];
    [
        own[0],
        own[1],
        (2 * line, turned),
        (2 * line + 1, minus(0, 1)),
    ]
}

fn plus(a: u64, b: u64) -> u64 {
    (a + b) % PRIME
}

fn minus(a: u64, b: u64) -> u64 {
    plus(a, PRIME - b)
}

fn times(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b) % u128::from(PRIME);
    // A remainder by a number of 61 bits.
    product as u64
}

fn power(base: u64, mut exponent: u64) -> u64 {
    let (mut result, mut square) = (1, base);
    while exponent > 0 {
        if exponent % 2 == 1 {
            result = times(result, square);
        }
        square = times(square, square);
        exponent /= 2;
    }
    result
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::sketch::Constraint;
    use kutzbach_math::number::Number;

    /// Points first, then lines; the game does not look at values.
    fn sketch(points: usize, lines: usize, edges: &[[usize; 2]]) -> Sketch {
        let point = |i: usize| Element::Point([i as f64, (i * i) as f64]);
        let line = |i: usize| Element::Line {
            through: [0.0, i as f64],
            direction: [1.0, i as f64],
        };
        let elements = (0..points).map(point).chain((0..lines).map(line)).collect();
        let constraint = |&ends: &[usize; 2]| Constraint {
            ends,
            value: Number::one(),
        };
        Sketch::new(elements, edges.iter().map(constraint).collect()).unwrap()
    }

    /// The rule of Jackson and Owen, over all sets of constraints and all their partitions.
    fn independent(points: usize, edges: &[[usize; 2]]) -> bool {
        let of = |set: u32| {
            let own = (0..edges.len()).filter(move |e| set >> e & 1 == 1);
            let vertices: BTreeSet<usize> = own.flat_map(|e| edges[e]).collect();
            let p = vertices.iter().filter(|v| **v < points).count() as i64;
            (p, vertices.len() as i64 - p)
        };
        // The least of Σ (2p + l − 2) over partitions, by the part that has the set's first constraint.
        let all = 1_usize << edges.len();
        let mut least = vec![0_i64; all];
        for set in 1..all as u32 {
            let first = set & set.wrapping_neg();
            let rest = set ^ first;
            let mut best = i64::MAX;
            let mut part = rest;
            loop {
                let (p, l) = of(part | first);
                best = best.min(2 * p + l - 2 + least[(rest ^ part) as usize]);
                if part == 0 {
                    break;
                }
                part = (part - 1) & rest;
            }
            least[set as usize] = best;
            let (_, l) = of(set);
            if i64::from(set.count_ones()) > best + l - 1 {
                return false;
            }
        }
        true
    }

    #[test]
    fn angles_are_counted_as_directions_are() {
        // Three lines and three angles: one says nothing, and where they are is left open.
        let ring = Counted::of(&sketch(0, 3, &[[0, 1], [1, 2], [0, 2]]));
        assert_eq!((ring.standing(), ring.freedoms()), (Standing::Over, 1));
        assert_eq!(ring.circuits()[0].edge, 2);
        let forest = Counted::of(&sketch(0, 3, &[[0, 1], [1, 2]]));
        assert_eq!((forest.standing(), forest.freedoms()), (Standing::Under, 1));
    }

    #[test]
    fn a_ring_of_bodies_that_share_lines_turns_once_only() {
        // Three bodies, each two lines and two points on both; they share the lines 6, 7 and 8 in a ring, and no angle is stated.
        let body =
            |a: usize, b: usize, [l, m]: [usize; 2]| [[a, b], [a, l], [a, m], [b, l], [b, m]];
        let edges: Vec<[usize; 2]> =
            [body(0, 1, [6, 7]), body(2, 3, [7, 8]), body(4, 5, [8, 6])].concat();
        let counted = Counted::of(&sketch(6, 3, &edges));
        assert_eq!(counted.game.freedoms(), 0, "the game sees nothing");
        assert_eq!(
            (counted.standing(), counted.freedoms()),
            (Standing::Over, 1)
        );
        assert_eq!(counted.circuits()[0].vertices, (0..9).collect::<Vec<_>>());
    }

    #[test]
    fn the_rank_is_what_the_rule_over_all_partitions_says() {
        let mut random = Random::new(11);
        let mut differ = 0;
        for _ in 0..150 {
            let (points, lines) = (1 + random.below(3), 3 + random.below(2));
            let pairs = (0..points + lines).flat_map(|v| (0..v).map(move |u| [u, v]));
            let mut pairs: Vec<[usize; 2]> = pairs.collect();
            random.shuffle(&mut pairs);
            pairs.truncate(9);
            let sketch = sketch(points, lines, &pairs);
            let mut kept: Vec<[usize; 2]> = Vec::new();
            let mut refused = 0;
            for pair in &pairs {
                kept.push(*pair);
                if !independent(points, &kept) {
                    kept.pop();
                    refused += 1;
                }
            }
            assert_eq!(circuits(&sketch).unwrap().len(), refused, "{pairs:?}");
            differ += usize::from(refused != PebbleGame::play(sketch.graph()).circuits().len());
        }
        assert!(differ > 10, "{differ}");
    }
}
