//! The equations that an incidence tree leaves, exact.
//!
//! Along the tree every body is placed by its parent, with two unknowns and one relation for an edge of weight 1, with four and
//! one for an edge of weight 3 (`turn.rs`). What is left are the *closures*: points that the tree does not bring
//! together, and distances that no body of the tree keeps. Squared distances are not multiplied out but found by walking
//! up the tree, since turns keep lengths; so every equation is at most linear in every turn, and with half angles at most
//! quadratic in every one of them.
//!
//! Equations that are linear combinations of earlier ones are left out, exactly: in a planar mechanism three of six vanish.
//!
//! Source: Sitharam, Peters, Zhou (2010), section 4.1, part 2; the metric of triangles and the walk are ours.

mod closures;
mod export;
mod independent;
mod local;
mod turn;

pub use export::Exported;
pub use kutzbach_algebra::FieldPolynomial as Poly;
pub use turn::Unknowns;

use crate::collection::{Collection, with_triangles};
use crate::placed::Placed;
use crate::tree::{IncidenceTree, optimal_incidence_tree};
use closures::closures;
use independent::Independent;
use kutzbach_algebra::NumberField;
use kutzbach_math::number::Number;
use local::{Constant, Local, Vector};
use std::collections::BTreeMap;
use thiserror::Error;
use turn::Turn;

/// What a closure asks for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Asks {
    /// A coordinate (0 to 2) of a point is the same in two bodies of the tree.
    Point {
        /// The point.
        point: usize,
        /// The coordinate, in the basis of the bodies' nearest common body.
        coordinate: usize,
        /// The two bodies.
        between: [usize; 2],
        /// Another point that both bodies have, equally far from this one in both, and that is asked for before: then
        /// one of the three coordinates follows.
        beside: Option<usize>,
    },
    /// The distance of two points.
    Distance {
        /// The points.
        points: [usize; 2],
    },
}

/// A closure equation `polynomial = 0`.
#[derive(Clone, Debug)]
pub struct Closure {
    /// Its left side.
    pub polynomial: Poly,
    /// What it asks for.
    pub asks: Asks,
}

impl Closure {
    /// Whether it is one of squared lengths, not of lengths.
    #[must_use]
    pub const fn is_square(&self) -> bool {
        matches!(self.asks, Asks::Distance { .. })
    }
}

/// The system of an incidence tree.
#[derive(Clone, Debug)]
pub struct ReducedSystem {
    /// The bodies given, and the triangles that they imply.
    pub collection: Collection,
    /// The tree over them.
    pub tree: IncidenceTree,
    /// The unknowns of every edge of the tree, in its order.
    pub unknowns: Vec<Unknowns>,
    /// The closures, linearly independent.
    pub closures: Vec<Closure>,
    /// Closures that say nothing new.
    pub dependent: Vec<Asks>,
    /// A closure that cannot be met whatever the unknowns.
    pub impossible: Option<Asks>,
    /// The field of the coefficients.
    pub field: NumberField,
    /// The share of the largest coefficient of its kind, lengths or squares of lengths, to which every coefficient is known.
    pub share: f64,
    locals: Vec<Local>,
    turns: Vec<Turn>,
}

/// Why there is no such system.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NotReduced {
    /// A number of the geometry is not known to be algebraic.
    #[error("a coordinate is not algebraic, or of too high a degree")]
    NotAlgebraic,
    /// Bodies that no shared point joins would have to be placed by six unknowns.
    #[error("some bodies share no point with the others: the tree weighs {weight}")]
    Apart {
        /// Weight of the tree.
        weight: usize,
    },
    /// There is no tree.
    #[error("the bodies have no incidence tree")]
    NoTree,
}

impl ReducedSystem {
    /// The system of the best tree over the bodies and the triangles that they imply. Bodies of more than three shared
    /// points are always in the tree, since distances alone would not tell them from their mirror images.
    ///
    /// # Errors
    /// [`NotReduced`].
    pub fn new(placed: &Placed) -> Result<Self, NotReduced> {
        Self::within(placed, 0.0)
    }

    /// The same where lengths and angles are known up to a share of the bodies' size, and coefficients to [`Self::share`]: constants that are no
    /// larger do not contradict.
    ///
    /// # Errors
    /// [`NotReduced`].
    pub fn within(placed: &Placed, share: f64) -> Result<Self, NotReduced> {
        let collection = with_triangles(&placed.collection);
        let given = placed.bodies.len();
        let needed: Vec<usize> = (0..given)
            .filter(|&b| collection.bodies()[b].points.len() > 3)
            .collect();
        let spread =
            |body: usize| body < given || !is_flat(placed, &collection.bodies()[body].points);
        let tree =
            optimal_incidence_tree(&collection, &needed, spread).ok_or(NotReduced::NoTree)?;
        Self::along(placed, collection, tree, share)
    }

    /// The system of a given tree over the bodies given and implied triangles after them.
    ///
    /// # Errors
    /// [`NotReduced`].
    pub fn along(
        placed: &Placed,
        collection: Collection,
        tree: IncidenceTree,
        share: f64,
    ) -> Result<Self, NotReduced> {
        if tree.edges.iter().any(|e| e.shared.is_empty()) {
            return Err(NotReduced::Apart {
                weight: tree.weight,
            });
        }
        let mut field = field_of(placed).ok_or(NotReduced::NotAlgebraic)?;
        let locals =
            locals(placed, &collection, &tree, &mut field).ok_or(NotReduced::NotAlgebraic)?;
        for square in &placed.bar_squares {
            field.read(square).ok_or(NotReduced::NotAlgebraic)?;
        }
        let mut turns = Vec::new();
        let mut first = 0;
        for edge in &tree.edges {
            let [child, parent] = [edge.child, edge.parent].map(|b| &locals[b]);
            let turn = Turn::new(&edge.shared, child, parent, first, &field)
                .ok_or(NotReduced::NotAlgebraic)?;
            first += turn.unknowns.count();
            turns.push(turn);
        }
        let mut system = Self {
            unknowns: turns.iter().map(|t| t.unknowns.clone()).collect(),
            collection,
            tree,
            closures: Vec::new(),
            dependent: Vec::new(),
            impossible: None,
            field,
            share,
            locals,
            turns,
        };
        if share > 0.0 {
            system.share *= system.lever(placed);
        }
        let all = closures(&system, placed).ok_or(NotReduced::NotAlgebraic)?;
        let sizes = all.iter().map(|c| (c.is_square(), system.size(c)));
        let largest = |square: bool| {
            let of_kind = sizes.clone().filter(|(own, _)| *own == square);
            of_kind.fold(0.0, |m: f64, (_, size)| m.max(size))
        };
        let known_to = [false, true].map(|square| system.share * largest(square));
        let mut independent = Independent::default();
        for closure in all {
            if closure.polynomial.is_constant() && !closure.polynomial.is_zero() {
                if share > 0.0
                    && system.size(&closure) <= known_to[usize::from(closure.is_square())]
                {
                    system.dependent.push(closure.asks);
                } else {
                    system.impossible = Some(closure.asks);
                }
            } else if independent.add(&closure.polynomial, &system.field) {
                system.closures.push(closure);
            } else {
                system.dependent.push(closure.asks);
            }
        }
        if share == 0.0 && system.impossible.is_none() && independent.holds_a_constant() {
            system.impossible = system.closures.last().map(|c| c.asks.clone());
        }
        Ok(system)
    }

    /// How much larger the share of a coefficient may be than that of a length: points close together place others far away.
    fn lever(&self, placed: &Placed) -> f64 {
        let of_turns = self.tree.edges.iter().zip(&self.turns).map(|(edge, turn)| {
            let bodies = [edge.child, edge.parent].map(|b| &self.locals[b]);
            turn.lever(bodies, &self.field)
        });
        let implied = self
            .tree
            .cover
            .iter()
            .filter(|&&b| b >= placed.bodies.len());
        let of_triangles = implied.map(|&b| self.locals[b].lever(&self.field));
        of_turns.chain(of_triangles).fold(1.0, f64::max)
    }

    /// The largest coefficient of a closure, in doubles.
    fn size(&self, closure: &Closure) -> f64 {
        let terms = closure.polynomial.terms();
        terms.fold(0.0, |m: f64, (_, c)| {
            m.max(self.field.number(c).value().abs())
        })
    }

    /// Freedoms along the tree: the number of independent unknowns.
    #[must_use]
    pub fn freedom(&self) -> usize {
        self.unknowns.iter().map(Unknowns::freedom).sum()
    }

    /// Number of unknowns, each turn with its relation.
    #[must_use]
    pub fn unknown_count(&self) -> usize {
        self.unknowns.iter().map(Unknowns::count).sum()
    }

    /// The edge by which a body hangs on its parent.
    fn edge_of(&self, body: usize) -> Option<usize> {
        self.tree.edges.iter().position(|e| e.child == body)
    }

    /// The bodies from one up to the root.
    fn way_up(&self, body: usize) -> Vec<usize> {
        let mut way = vec![body];
        let mut at = body;
        while let Some(edge) = self.edge_of(at) {
            at = self.tree.edges[edge].parent;
            way.push(at);
        }
        way
    }

    /// A point of a body in the frame of one of its ancestors.
    fn expressed(&self, point: usize, holder: usize, ancestor: usize) -> Option<Vector> {
        let mut at = local::constant(self.locals[holder].points.get(&point)?);
        let mut body = holder;
        while body != ancestor {
            let edge = self.edge_of(body)?;
            at = self.turns[edge].placed(&at, &self.field);
            body = self.tree.edges[edge].parent;
        }
        Some(at)
    }

    /// The squared distance of a point of a body from a fixed place of an ancestor: turns keep lengths, so that only the
    /// products along the way are polynomials.
    fn square_from(
        &self,
        from: &Constant,
        point: usize,
        holder: usize,
        ancestor: usize,
    ) -> Option<Poly> {
        let field = &self.field;
        let body = &self.locals[ancestor];
        if holder == ancestor {
            let way = local::minus(body.points.get(&point)?, from);
            return Some(Poly::constant(body.dot(&way, &way, field)));
        }
        let way = self.way_up(holder);
        let child = *way.get(way.iter().position(|&b| b == ancestor)?.checked_sub(1)?)?;
        let turn = &self.turns[self.edge_of(child)?];
        // P = a' + R (p − a): |P − z|² = |a' − z|² + |p − a|² + 2 (a' − z)·R (p − a).
        let out = local::minus(&turn.pivot[1], from);
        let inner = self.square_from(&turn.pivot[0], point, holder, child)?;
        let seen = self.expressed(point, holder, child)?;
        let arm = local::difference(&seen, &local::constant(&turn.pivot[0]));
        let product = body.dot_with(&out, &turn.turned(&arm, field), field);
        let two = kutzbach_algebra::FieldElement::integer(2);
        let own = Poly::constant(body.dot(&out, &out, field));
        Some(own.plus(&inner).plus(&product.scaled(&two, field)))
    }

    /// The coordinates of all points of the tree's bodies in the root's frame (m), at given values of the unknowns.
    #[must_use]
    pub fn points_at(&self, values: &[f64]) -> Vec<Option<[f64; 3]>> {
        let root = &self.locals[self.tree.root];
        let lengths = [0, 1, 2].map(|i| self.field.number(&root.metric[i]).value().sqrt());
        (0..self.collection.points().len())
            .map(|point| {
                let holder = *self
                    .tree
                    .cover
                    .iter()
                    .filter(|&&b| self.locals[b].points.contains_key(&point))
                    .min_by_key(|&&b| self.way_up(b).len())?;
                let vector = self.expressed(point, holder, self.tree.root)?;
                Some([0, 1, 2].map(|i| lengths[i] * self.value(&vector[i], values)))
            })
            .collect()
    }

    /// The value of a polynomial, in doubles.
    #[must_use]
    pub fn value(&self, polynomial: &Poly, values: &[f64]) -> f64 {
        let term = |(exponents, c): (&[u8], &kutzbach_algebra::FieldElement)| {
            let c = self.field.number(c).value();
            exponents
                .iter()
                .zip(values)
                .fold(c, |t, (&e, v)| t * v.powi(i32::from(e)))
        };
        polynomial.terms().map(term).sum()
    }
}

/// Whether the corners of a triangle are on one line: of its sides a, b, c then 4 a²b² = (a² + b² − c²)². Nothing can be placed about it.
fn is_flat(placed: &Placed, points: &[usize]) -> bool {
    let &[p, q, r] = points else {
        return false;
    };
    let sides = [[p, q], [p, r], [q, r]].map(|[p, q]| placed.distance_square(p, q));
    let [Some(a), Some(b), Some(c)] = sides else {
        return false;
    };
    let product = &(&a + &b) - &c;
    (&(&Number::integer(4) * &(&a * &b)) - &(&product * &product)).is_zero()
}

/// The field of all coordinates and lengths.
fn field_of(placed: &Placed) -> Option<NumberField> {
    let mut numbers: Vec<Number> = placed.bar_squares.clone();
    for body in &placed.bodies {
        numbers.extend(body.points.iter().flat_map(|(_, at)| at.iter().cloned()));
    }
    NumberField::of(&numbers)
}

/// Every body of the tree in coordinates of its own, no points of others; a triangle that turns about one point in a basis of unit vectors.
fn locals(
    placed: &Placed,
    collection: &Collection,
    tree: &IncidenceTree,
    field: &mut NumberField,
) -> Option<Vec<Local>> {
    let mut locals = Vec::new();
    for (index, body) in collection.bodies().iter().enumerate() {
        if !tree.cover.contains(&index) {
            locals.push(Local::given(BTreeMap::new()));
            continue;
        }
        if let Some(given) = placed.bodies.get(index) {
            let mut points = BTreeMap::new();
            for (point, at) in &given.points {
                let mut read = [0, 1, 2].map(|_| kutzbach_algebra::FieldElement::default());
                for (entry, number) in read.iter_mut().zip(at) {
                    *entry = field.read(number)?;
                }
                points.insert(*point, read);
            }
            locals.push(Local::given(points));
            continue;
        }
        let &[a, b, c] = body.points.as_slice() else {
            return None;
        };
        let mut sides = Vec::new();
        for (p, q) in [(a, b), (a, c), (b, c)] {
            sides.push(field.read(&placed.distance_square(p, q)?)?);
        }
        let mut triangle = Local::triangle([a, b, c], [&sides[0], &sides[1], &sides[2]], field)?;
        let ball = |e: &&crate::tree::TreeEdge| {
            e.shared.len() == 1 && (e.child == index || e.parent == index)
        };
        if tree.edges.iter().any(|e| ball(&e)) {
            let mut lengths = Vec::new();
            for square in &triangle.metric {
                let root = field.number(square).sqrt().ok()?;
                lengths.push(field.read(&root)?);
            }
            for at in triangle.points.values_mut() {
                for (entry, length) in at.iter_mut().zip(&lengths) {
                    *entry = field.times(entry, length);
                }
            }
            triangle.metric = [1, 1, 1].map(kutzbach_algebra::FieldElement::integer);
        }
        locals.push(triangle);
    }
    Some(locals)
}

impl ReducedSystem {
    /// The share of the way from one point to another along the coordinate that a closure is about, in the frame in which
    /// the closure is written, at given values of the unknowns; 0 where it cannot be said.
    pub(crate) fn share_along(
        &self,
        closure: usize,
        point: usize,
        beside: usize,
        values: &[f64],
    ) -> f64 {
        let Asks::Point {
            coordinate,
            between: [a, b],
            ..
        } = &self.closures[closure].asks
        else {
            return 0.0;
        };
        let above = self.way_up(*b);
        let Some(common) = self
            .way_up(*a)
            .into_iter()
            .find(|body| above.contains(body))
        else {
            return 0.0;
        };
        let at = |p| self.expressed(p, *a, common);
        let (Some(p), Some(q)) = (at(point), at(beside)) else {
            return 0.0;
        };
        let metric = [0, 1, 2].map(|i| self.field.number(&self.locals[common].metric[i]).value());
        let way = [0, 1, 2].map(|i| self.value(&p[i].minus(&q[i]), values) * metric[i].sqrt());
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        (way[*coordinate] / length).abs()
    }
}
