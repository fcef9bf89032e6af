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
//!
//! Relations of more elements are rows besides, two each or one, and unknown values are columns; then the rank alone counts. Middles and mirror
//! images are in their places where that can be had one after the other, so that what follows from them is seen to follow. As always
//! a count is one of general values: what holds by special lengths only, or by a theorem of incidences, it does not see.

use crate::pebbles::{Circuit, PebbleGame, Standing};
use crate::relation::Relation;
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
    /// `None` where a construction shows that nothing is too much or left.
    game: Option<PebbleGame>,
    /// What the game does not see: circuits and freedoms.
    by_rank: Option<(Vec<Circuit>, usize)>,
    /// Whether there are relations, of which the game knows nothing.
    relations: bool,
}

impl Counted {
    /// Counts.
    #[must_use]
    pub fn of(sketch: &Sketch) -> Self {
        Self::by(sketch, Some(PebbleGame::play(sketch.graph())))
    }

    /// Counts what reduces to one cluster: of m elements every part then has 2m − 3 constraints at most, the whole as many, and only directions
    /// are left to be counted.
    #[must_use]
    pub fn of_constructed(sketch: &Sketch) -> Self {
        Self::by(sketch, None)
    }

    fn by(sketch: &Sketch, game: Option<PebbleGame>) -> Self {
        let lines = sketch.elements().iter().filter(|e| e.is_line()).count();
        let relations = !sketch.relations().is_empty();
        let by_rank = (lines > 2 || relations).then(|| ranked(sketch)).flatten();
        // Where both refuse the same constraints, the game names the smallest rigid parts.
        let refused = |circuits: &[Circuit]| circuits.iter().map(|c| c.edge).collect::<Vec<_>>();
        let by_rank = by_rank
            .filter(|found| relations || refused(&found.circuits) != refused(of_game(&game)));
        let by_rank = by_rank.map(|found| {
            let unknowns = 2 * sketch.elements().len() + sketch.unknown_values();
            let freedoms = (unknowns - 3).saturating_sub(found.rank);
            (found.circuits, freedoms)
        });
        Self {
            game,
            by_rank,
            relations,
        }
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
        let of_game = || self.game.as_ref().map_or(0, PebbleGame::freedoms);
        self.by_rank.as_ref().map_or_else(of_game, |r| r.1)
    }

    /// Whether it was counted: not where relations are too many for it.
    #[must_use]
    pub const fn is_known(&self) -> bool {
        !self.relations || self.by_rank.is_some()
    }

    /// Every constraint that those before it imply, with the elements of those that do. An edge beyond the constraints is a relation; these
    /// come after the angles and before all others.
    #[must_use]
    pub fn circuits(&self) -> &[Circuit] {
        match &self.by_rank {
            Some((circuits, _)) => circuits,
            None => of_game(&self.game),
        }
    }

    /// The largest parts that are rigid in themselves; none where directions decide, since the game does not know then.
    #[must_use]
    pub fn rigid_parts(&self) -> Vec<Vec<usize>> {
        match self.by_rank {
            Some(_) => Vec::new(),
            None => self
                .game
                .as_ref()
                .map_or_else(Vec::new, PebbleGame::rigid_parts),
        }
    }
}

fn of_game(game: &Option<PebbleGame>) -> &[Circuit] {
    game.as_ref().map_or(&[], PebbleGame::circuits)
}

/// A row, by column.
type Row = BTreeMap<usize, u64>;

/// The rank, and the constraints that those before them imply.
struct Ranked {
    circuits: Vec<Circuit>,
    rank: usize,
}

/// Counts by the rank; `None` where that takes too long.
fn ranked(sketch: &Sketch) -> Option<Ranked> {
    let places = places(sketch);
    let constraints = sketch.constraints();
    let beyond = sketch.relations().iter().enumerate();
    let beyond = beyond.flat_map(|(i, relation)| {
        let rows = related(relation, &places);
        rows.into_iter()
            .map(move |row| (constraints.len() + i, row))
    });
    let rows = constraints.iter().enumerate();
    let rows = rows.map(|(edge, c)| (edge, gradient(c.ends, &places)));
    // What relations imply of lengths is wanted, and what directions imply of relations.
    let first = |(edge, _): &(usize, Row)| {
        if sketch.relations().is_empty() {
            return false;
        }
        let [u, v] = constraints[*edge].ends;
        places[u].line && places[v].line
    };
    let (first, rows): (Vec<_>, Vec<_>) = rows.partition(first);
    let private = private(sketch);
    let mut left = MOST_PRODUCTS;
    // By first column: the row, and which constraints it is a sum of.
    let mut pivots: BTreeMap<usize, (Row, Row)> = BTreeMap::new();
    let mut circuits: Vec<Circuit> = Vec::new();
    let mut rank = 0;
    for (edge, mut row) in first.into_iter().chain(beyond).chain(rows) {
        if private.get(edge) == Some(&true) {
            rank += 1;
            continue;
        }
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
                let tied = |e: usize| match e.checked_sub(constraints.len()) {
                    None => constraints[e].ends.to_vec(),
                    Some(relation) => sketch.relations()[relation].elements(),
                };
                // The second equation of a relation may hold by its first: it takes part all the same.
                let others = from.keys().copied().chain([edge]);
                let mut vertices: BTreeSet<usize> = others.flat_map(tied).collect();
                match circuits.last_mut().filter(|c| c.edge == edge) {
                    Some(circuit) => {
                        vertices.extend(&circuit.vertices);
                        circuit.vertices = vertices.into_iter().collect();
                    }
                    None => {
                        let vertices = vertices.into_iter().collect();
                        circuits.push(Circuit { edge, vertices });
                    }
                }
            }
            Some((&column, &value)) => {
                rank += 1;
                let inverse = power(value, PRIME - 2);
                for entry in row.values_mut().chain(from.values_mut()) {
                    *entry = times(*entry, inverse);
                }
                pivots.insert(column, (row, from));
            }
        }
    }
    Some(Ranked { circuits, rank })
}

/// Constraints of elements that have two at most, of which one says where a line is that the other turns: independent, whatever the others are.
/// Taken off one after the other.
fn private(sketch: &Sketch) -> Vec<bool> {
    let is_line = |e: usize| sketch.elements()[e].is_line();
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); sketch.elements().len()];
    for (i, constraint) in sketch.constraints().iter().enumerate() {
        constraint.ends.iter().for_each(|&e| at[e].push(i));
    }
    let mut kept = vec![false; at.len()];
    for e in sketch.relations().iter().flat_map(Relation::elements) {
        kept[e] = true;
    }
    let mut private = vec![false; sketch.constraints().len()];
    let mut waiting: Vec<usize> = (0..at.len()).collect();
    while let Some(e) = waiting.pop() {
        let own = at[e].iter().copied().filter(|&i| !private[i]);
        let own: Vec<usize> = own.collect();
        let angle = |i: &&usize| sketch.constraints()[**i].ends.iter().all(|&e| is_line(e));
        if kept[e] || own.is_empty() || own.len() > 2 || own.iter().filter(angle).count() > 1 {
            continue;
        }
        kept[e] = true;
        for i in own {
            private[i] = true;
            let others = sketch.constraints()[i].ends;
            waiting.extend(others.into_iter().filter(|&o| o != e));
        }
    }
    private
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

/// A place: x and y of a point; cosine and sine of a line's normal, and its distance from the origin.
#[derive(Clone, Copy)]
struct Place {
    line: bool,
    at: [u64; 3],
}

/// Random places; middles and mirror images where they belong, as far as these follow one after the other.
fn places(sketch: &Sketch) -> Vec<Place> {
    let mut random = Random::new(1);
    let mut any = || random.bits() % PRIME;
    let place = |element: &Element| match element {
        Element::Point(_) => Place {
            line: false,
            at: [any(), any(), 0],
        },
        Element::Line { .. } => {
            // The circle by its rational parameter; −1 is no square modulo this prime, so that 1 + t² is not zero.
            let t = any();
            let square = times(t, t);
            let inverse = power(plus(1, square), PRIME - 2);
            Place {
                line: true,
                at: [
                    times(minus(1, square), inverse),
                    times(plus(t, t), inverse),
                    any(),
                ],
            }
        }
    };
    let mut places: Vec<Place> = sketch.elements().iter().map(place).collect();
    if sketch.relations().is_empty() {
        return places;
    }
    turn_by_quarters(sketch, &mut places);
    let mut used = vec![false; places.len()];
    for relation in sketch.relations() {
        let (open, found) = match *relation {
            Relation::Middle { point, of: [a, b] } => {
                let (p, q, m) = (places[a].at, places[b].at, places[point].at);
                match [point, b, a].into_iter().find(|&e| !used[e]) {
                    Some(e) if e == point => {
                        let half = power(2, PRIME - 2);
                        (e, [0, 1].map(|k| times(half, plus(p[k], q[k]))))
                    }
                    Some(e) => {
                        let other = if e == a { q } else { p };
                        (e, [0, 1].map(|k| minus(plus(m[k], m[k]), other[k])))
                    }
                    None => continue,
                }
            }
            Relation::Mirrored {
                pair: [a, b],
                axis,
                against,
            } => {
                let Some(e) = [b, a].into_iter().find(|&e| !used[e]) else {
                    continue;
                };
                let other = places[if e == a { b } else { a }];
                let found = mirrored(other, places[axis].at, against);
                places[e].at[2] = found[2];
                (e, [found[0], found[1]])
            }
            Relation::Measured { .. } => continue,
        };
        places[open].at[..2].copy_from_slice(&found);
        relation.elements().iter().for_each(|&e| used[e] = true);
    }
    places
}

/// Puts lines across or along others where angles of quarter turns ask for it: mirror images in two such lines belong together.
fn turn_by_quarters(sketch: &Sketch, places: &mut [Place]) {
    let quarters = sketch.constraints().iter().filter_map(|c| {
        let [u, v] = c.ends;
        if !(places[u].line && places[v].line) {
            return None;
        }
        let (cos, sin) = c.value.cos_sin();
        let signs = [cos.signum(), sin.signum()];
        signs.contains(&0).then_some((u, v, signs))
    });
    let quarters: Vec<(usize, usize, [i8; 2])> = quarters.collect();
    let mut turned = vec![false; places.len()];
    for start in 0..places.len() {
        let mut open = vec![start];
        while let Some(at) = open.pop() {
            turned[at] = true;
            for &(u, v, [cos, sin]) in &quarters {
                let (next, sin) = match at {
                    e if e == u => (v, sin),
                    e if e == v => (u, -sin),
                    _ => continue,
                };
                if turned[next] {
                    continue;
                }
                let [x, y, _] = places[at].at;
                let by = |sign: i8, value: u64| match sign {
                    0 => 0,
                    1 => value,
                    _ => minus(0, value),
                };
                let to = [minus(by(cos, x), by(sin, y)), plus(by(sin, x), by(cos, y))];
                places[next].at[..2].copy_from_slice(&to);
                open.push(next);
            }
        }
    }
}

/// A mirror image, as [`crate::relation`] has it.
fn mirrored(place: Place, [nx, ny, h]: [u64; 3], against: bool) -> [u64; 3] {
    let [x, y, own] = place.at;
    let along = plus(times(nx, x), times(ny, y));
    let reflected = |by: u64| [minus(x, times(by, nx)), minus(y, times(by, ny))];
    if !place.line {
        let far = minus(along, h);
        let [x, y] = reflected(plus(far, far));
        return [x, y, 0];
    }
    let [x, y] = reflected(plus(along, along));
    let both = times(h, along);
    let image = [x, y, minus(own, plus(both, both))];
    match against {
        true => image,
        false => image.map(|v| minus(0, v)),
    }
}

/// How the equations of a relation change with the unknowns, each a row; unknown values come after the elements.
fn related(relation: &Relation, places: &[Place]) -> Vec<Row> {
    let two = |x: u64| plus(x, x);
    let row = |entries: &[(usize, u64)]| {
        let mut row = Row::new();
        for &(column, value) in entries {
            let entry = row.entry(column).or_insert(0);
            *entry = plus(*entry, value);
        }
        row.retain(|_, value| *value != 0);
        row
    };
    match relation {
        Relation::Middle { point, of: [a, b] } => [0, 1]
            .map(|k| {
                row(&[
                    (2 * point + k, 2),
                    (2 * a + k, minus(0, 1)),
                    (2 * b + k, minus(0, 1)),
                ])
            })
            .to_vec(),
        &Relation::Mirrored {
            pair: [a, b],
            axis,
            against,
        } => {
            let ([p, q], [nx, ny, h]) = ([places[a], places[b]], places[axis].at);
            let dot = |n: [u64; 2], v: [u64; 2]| plus(times(n[0], v[0]), times(n[1], v[1]));
            let (n, t) = ([nx, ny], [minus(0, ny), nx]);
            let [u, v] = [p, q].map(|place| [place.at[0], place.at[1]]);
            if !p.line {
                // n·(p + q) = 2h and t·(q − p) = 0; turning the line changes n by t and t by −n.
                let sum = [0, 1].map(|k| plus(u[k], v[k]));
                let off = [0, 1].map(|k| minus(v[k], u[k]));
                let middle = [
                    (2 * a, n[0]),
                    (2 * a + 1, n[1]),
                    (2 * b, n[0]),
                    (2 * b + 1, n[1]),
                    (2 * axis, dot(t, sum)),
                    (2 * axis + 1, minus(0, 2)),
                ];
                let across = [
                    (2 * b, t[0]),
                    (2 * b + 1, t[1]),
                    (2 * a, minus(0, t[0])),
                    (2 * a + 1, minus(0, t[1])),
                    (2 * axis, minus(0, dot(n, off))),
                ];
                return vec![row(&middle), row(&across)];
            }
            // Angles add up to twice that of the axis; the second offset is ±(h₁ − 2h n₁·n).
            let sign = |x: u64| if against { x } else { minus(0, x) };
            let turned = [minus(0, u[1]), u[0]];
            let by_own = two(times(h, dot(turned, n)));
            let by_axis = two(times(h, dot(u, t)));
            let angles = [(2 * a, 1), (2 * b, 1), (2 * axis, minus(0, 2))];
            let offsets = [
                (2 * b + 1, 1),
                (2 * a + 1, minus(0, sign(1))),
                (2 * axis + 1, sign(two(dot(u, n)))),
                (2 * a, sign(by_own)),
                (2 * axis, sign(by_axis)),
            ];
            vec![row(&angles), row(&offsets)]
        }
        Relation::Measured { ends, terms, .. } => {
            let mut own = gradient(*ends, places);
            let value = |v: usize| 2 * places.len() + v;
            // Of two points it is the square of a sum, at some place of the unknown values.
            let slope = match ends.iter().any(|&e| places[e].line) {
                true => 1,
                false => terms.iter().fold(1, |sum, &(v, _)| plus(sum, v as u64 + 2)),
            };
            for &(v, less) in terms {
                let entry = own.entry(value(v)).or_insert(0);
                *entry = plus(*entry, if less { slope } else { minus(0, slope) });
            }
            own.retain(|_, entry| *entry != 0);
            vec![own]
        }
    }
}

/// How a constraint changes with the unknowns: x and y of a point; angle and distance from the origin of a line.
fn gradient(ends: [usize; 2], places: &[Place]) -> Row {
    let [u, v] = ends;
    let row = |entries: [(usize, u64); 4]| entries.into_iter().filter(|(_, x)| *x != 0).collect();
    let of = |e: usize| (places[e].line, [places[e].at[0], places[e].at[1]]);
    match (of(u), of(v)) {
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
        assert_eq!(
            counted.game.as_ref().unwrap().freedoms(),
            0,
            "the game sees nothing"
        );
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
            assert_eq!(
                ranked(&sketch).unwrap().circuits.len(),
                refused,
                "{pairs:?}"
            );
            differ += usize::from(refused != PebbleGame::play(sketch.graph()).circuits().len());
        }
        assert!(differ > 10, "{differ}");
    }
}
