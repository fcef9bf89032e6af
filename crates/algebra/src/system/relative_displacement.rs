//! How one link is displaced relative to another since the drawn pose, and the linear conditions that it meets.
//!
//! Along a path of joints the displacement of the last link, seen from the first and written in the world's coordinates
//! with the first link where it is drawn, is a rotation R and a translation t whose entries are polynomials in the joints'
//! variables: x ↦ R x + t, the identity at the drawn pose. A subgroup of displacements of known geometry is described by
//! conditions that are linear in these entries (R n = n; w·t = 0; R c + t = c). They are also linear in the geometry, so
//! that n, w and c need not be guessed: with the entries reduced modulo an ideal, the conditions are linear equations for
//! n, w or c over the field of the mechanism's numbers. All of it is exact.

use super::PolynomialSystem;
use super::element::{Element, Exponents, trim};
use super::field::{Field, Relation};
use super::fraction::{Fraction, from_rational, to_rational};
use super::poly::Poly;
use super::space::{
    Matrix, Polynomials, Vector, apply, cross, dot, identity, pose, subtract, transpose,
};
use super::walks::{MAX_PRODUCTS, Walker};
use crate::{Polynomial, Rational, Stop};
use kutzbach_model::mechanism::{JointId, JointKind};
use num_traits::Zero;
use std::collections::BTreeMap;

/// Largest degree of the field that the unknown geometry is looked for in.
const MAX_DEGREE: usize = 24;

/// Why there is no displacement to look at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unavailable {
    /// The drawn pose is no exact solution.
    Home,
    /// A joint of the path has no displacement of its own: a screw on a common line, a joint that is written as a
    /// condition.
    Joint,
    /// Its polynomials are too long, or its numbers of too high a degree.
    TooLarge,
}

/// What is left of a polynomial modulo one ideal or several: one polynomial for each.
pub(crate) type Reduce<'a> = dyn Fn(&Polynomial) -> Result<Vec<Polynomial>, Stop> + 'a;

/// Three components in the field of the mechanism's numbers.
#[derive(Clone, Debug)]
pub(crate) struct ExactVector(Vector<Element>);

/// A displacement along a path of joints.
pub(crate) struct RelativeDisplacement<'a> {
    field: &'a Field,
    /// Where the generators begin among the system's variables, and which these are.
    first_generator: usize,
    generators: &'a [usize],
    /// R − 1.
    turning: Matrix<Poly>,
    translation: Vector<Poly>,
    /// The place of every variable of the system in the ring of the ideal, where it has one.
    places: Vec<Option<usize>>,
    ring: usize,
    /// A basis of the field of all numbers that matter, over the rationals.
    numbers: Vec<Element>,
}

impl PolynomialSystem {
    /// The displacement of the last link of a path relative to its first one, for reduction in the ring of some of the
    /// system's variables.
    pub(crate) fn relative_displacement(
        &self,
        path: &[(JointId, bool)],
        ring: &[usize],
    ) -> Result<RelativeDisplacement<'_>, Unavailable> {
        let construction = &self.construction;
        let field = &construction.field;
        let drawn = construction.drawn.as_ref().ok_or(Unavailable::Home)?;
        if construction.point.is_none() || field.has_parameters() {
            return Err(Unavailable::Home);
        }
        if path.iter().any(|(joint, _)| !self.is_explicit(*joint)) {
            return Err(Unavailable::Joint);
        }
        let [Some((first, _)), Some((_, last))] = [path.first(), path.last()].map(|step| {
            let (joint, forward) = step?;
            let [a, b] = construction.ends[joint.0];
            Some(if *forward { (a, b) } else { (b, a) })
        }) else {
            return Err(Unavailable::Joint);
        };
        let walker = Walker {
            field,
            models: &construction.models,
            displacements: &construction.displacements,
            unoriented: false,
            most_products: MAX_PRODUCTS,
        };
        let along = walker
            .walk(path.iter().map(|(joint, forward)| (joint.0, *forward)))
            .map_err(|_| Unavailable::TooLarge)?;
        let scalars = Polynomials(field);
        // With the first link where it is drawn, and counted from where the last one is drawn.
        let displaced = pose(&scalars, &drawn[first])
            .then(&scalars, &along)
            .then(&scalars, &pose(&scalars, &drawn[last].inverse(field)));
        let unit: Matrix<Poly> = identity(&scalars);
        let turning = [0, 1, 2].map(|i| subtract(&scalars, &displaced.rotation[i], &unit[i]));
        let mut places = vec![None; self.variables.len()];
        for (place, &variable) in ring.iter().enumerate() {
            places[variable] = Some(place);
        }
        let mut displacement = RelativeDisplacement {
            field,
            first_generator: self.variables.len() - construction.generators.len(),
            generators: &construction.generators,
            turning,
            translation: displaced.translation,
            places,
            ring: ring.len(),
            numbers: Vec::new(),
        };
        displacement.numbers = displacement.number_basis().ok_or(Unavailable::TooLarge)?;
        Ok(displacement)
    }

    /// Whether a joint's displacement is written in its variables.
    pub(crate) fn is_explicit(&self, joint: JointId) -> bool {
        let construction = &self.construction;
        let Some(displacement) = construction.displacements.get(joint.0) else {
            return false;
        };
        let is_fixed = construction.models[joint.0].kind == JointKind::Fixed;
        construction.linear[joint.0].is_none() && (!displacement.factors.is_empty() || is_fixed)
    }

    /// The direction of a joint's one axis at the drawn pose, in the world; `None` where it has none or two.
    pub(crate) fn axis_at_home(&self, joint: JointId) -> Option<ExactVector> {
        let construction = &self.construction;
        let model = &construction.models[joint.0];
        let (axis, None) = (model.axis.as_ref()?, &model.axis2) else {
            return None;
        };
        let [predecessor, _] = construction.ends[joint.0];
        let field = &construction.field;
        let frame = construction.drawn.as_ref()?[predecessor].then(field, &model.sides[0]);
        let direction = apply(field, &frame.rotation, &axis.direction);
        Some(ExactVector(direction))
    }

    /// Whether two directions are parallel, exactly.
    pub(crate) fn are_parallel(&self, a: &ExactVector, b: &ExactVector) -> bool {
        cross(&self.construction.field, &a.0, &b.0)
            .iter()
            .all(Element::is_zero)
    }
}

/// One linear condition Σⱼ aⱼ xⱼ + b = 0 on an unknown vector x.
struct Condition {
    coefficients: Vector<Poly>,
    constant: Poly,
}

/// Vectors that satisfy linear conditions.
struct Solutions {
    /// One of them; zero where the conditions have no constant part, `None` where they contradict one another.
    particular: Option<Vector<Element>>,
    /// A basis of the solutions without the constant part.
    null: Vec<Vector<Element>>,
}

impl RelativeDisplacement<'_> {
    /// A basis of the directions n with R n = n.
    pub(crate) fn fixed_directions(&self, reduce: &Reduce<'_>) -> Result<Vec<ExactVector>, Stop> {
        let conditions: Vec<Condition> = self
            .turning
            .iter()
            .cloned()
            .map(Condition::without_constant)
            .collect();
        Ok(self
            .solve(&conditions, reduce)?
            .null
            .into_iter()
            .map(ExactVector)
            .collect())
    }

    /// A basis of the directions w with w·t = 0.
    pub(crate) fn directions_across(&self, reduce: &Reduce<'_>) -> Result<Vec<ExactVector>, Stop> {
        let condition = Condition::without_constant(self.translation.clone());
        Ok(self
            .solve(&[condition], reduce)?
            .null
            .into_iter()
            .map(ExactVector)
            .collect())
    }

    /// A point c that the displacements leave where it is: R c + t = c.
    pub(crate) fn fixed_point(&self, reduce: &Reduce<'_>) -> Result<Option<ExactVector>, Stop> {
        let conditions = [0, 1, 2].map(|i| Condition {
            coefficients: self.turning[i].clone(),
            constant: self.translation[i].clone(),
        });
        Ok(self.solve(&conditions, reduce)?.particular.map(ExactVector))
    }

    /// A point c that the displacements move along a direction only: R c + t − c is a multiple of it.
    pub(crate) fn point_of_axis(
        &self,
        direction: &ExactVector,
        reduce: &Reduce<'_>,
    ) -> Result<Option<ExactVector>, Stop> {
        let ring = Polynomials(self.field);
        let columns = transpose(&self.turning);
        let conditions = [0, 1, 2].map(|i| {
            let unit = [0, 1, 2].map(|j| Element::integer(i64::from(i == j)));
            let across = cross(self.field, &unit, &direction.0).map(Poly::constant);
            Condition {
                coefficients: [0, 1, 2].map(|j| dot(&ring, &across, &columns[j])),
                constant: dot(&ring, &across, &self.translation),
            }
        });
        Ok(self.solve(&conditions, reduce)?.particular.map(ExactVector))
    }

    /// Whether the translation has no part along a direction.
    pub(crate) fn is_across(
        &self,
        direction: &ExactVector,
        reduce: &Reduce<'_>,
    ) -> Result<bool, Stop> {
        let ring = Polynomials(self.field);
        let part = dot(
            &ring,
            &direction.0.clone().map(Poly::constant),
            &self.translation,
        );
        for polynomial in self.split(&part).into_values() {
            if reduce(&polynomial)?.iter().any(|rest| !rest.is_zero()) {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// The vector product.
    pub(crate) fn across_both(&self, a: &ExactVector, b: &ExactVector) -> ExactVector {
        ExactVector(cross(self.field, &a.0, &b.0))
    }

    /// Components in double precision.
    pub(crate) fn approximate(&self, vector: &ExactVector) -> [f64; 3] {
        [0, 1, 2].map(|i| self.field.approximate(&vector.0[i]))
    }

    /// A basis, over the rationals, of the field of all numbers in the displacement and in the ring: products of powers
    /// of generators. `None` where there are too many.
    fn number_basis(&self) -> Option<Vec<Element>> {
        let count = self.field.generators().len();
        let mut needed = vec![false; count];
        for (place, &generator) in self.generators.iter().enumerate() {
            needed[generator] = self.places[self.first_generator + place].is_some();
        }
        let entries = self.turning.iter().flatten().chain(&self.translation);
        for (_, element) in entries.flat_map(Poly::terms) {
            for (index, flag) in needed.iter_mut().enumerate() {
                *flag |= element.mentions(index);
            }
        }
        for index in (0..count).rev().collect::<Vec<_>>() {
            if let (true, Relation::Power { tail, .. }) =
                (needed[index], &self.field.generators()[index].relation)
            {
                for (other, flag) in needed.iter_mut().enumerate().take(index) {
                    *flag |= tail.mentions(other);
                }
            }
        }
        let mut basis: Vec<Exponents> = vec![Vec::new()];
        for index in (0..count).filter(|&index| needed[index]) {
            let Relation::Power { degree, .. } = &self.field.generators()[index].relation else {
                return None;
            };
            if basis.len() * usize::from(*degree) > MAX_DEGREE {
                return None;
            }
            let before = std::mem::take(&mut basis);
            for power in 0..*degree {
                for exponents in &before {
                    let mut more = exponents.clone();
                    more.resize(index + 1, 0);
                    more[index] = power;
                    trim(&mut more);
                    basis.push(more);
                }
            }
        }
        let monomial = |exponents| Element(BTreeMap::from([(exponents, Fraction::ONE)]));
        Some(basis.into_iter().map(monomial).collect())
    }

    /// A polynomial as one in the ring, for every monomial in what the ring does not hold. Those monomials are independent
    /// over the ring, so that the whole lies in an ideal of the ring where all parts do.
    fn split(&self, poly: &Poly) -> BTreeMap<Outside, Polynomial> {
        let mut parts: BTreeMap<Outside, Vec<(Vec<u32>, Rational)>> = BTreeMap::new();
        let unplaced = self.places.len();
        for (unknowns, element) in poly.terms() {
            for (numbers, coefficient) in &element.0 {
                let mut key = Vec::new();
                let mut exponents = vec![0; self.ring];
                let mut factor = |variable: Option<usize>, name: usize, power: u16| match variable
                    .and_then(|variable| self.places[variable])
                {
                    Some(place) => exponents[place] += u32::from(power),
                    None => key.push((name, power)),
                };
                for (variable, &power) in unknowns.iter().enumerate().filter(|(_, p)| **p > 0) {
                    factor(Some(variable), variable, power);
                }
                for (generator, &power) in numbers.iter().enumerate().filter(|(_, p)| **p > 0) {
                    let place = self.generators.iter().position(|g| *g == generator);
                    factor(
                        place.map(|place| self.first_generator + place),
                        unplaced + generator,
                        power,
                    );
                }
                parts
                    .entry(key)
                    .or_default()
                    .push((exponents, to_rational(coefficient)));
            }
        }
        parts
            .into_iter()
            .map(|(key, terms)| (key, Polynomial::from_terms(terms, self.ring)))
            .collect()
    }

    /// What a column of the linear equations holds: for every condition, ideal and monomial a rational.
    fn column(&self, polys: &[Poly], reduce: &Reduce<'_>) -> Result<Column, Stop> {
        let mut column = Column::new();
        for (condition, poly) in polys.iter().enumerate() {
            for (key, polynomial) in self.split(poly) {
                for (ideal, rest) in reduce(&polynomial)?.iter().enumerate() {
                    for (exponents, coefficient) in rest.terms() {
                        let row = (condition, ideal, key.clone(), exponents.to_vec());
                        column.insert(row, coefficient.clone());
                    }
                }
            }
        }
        Ok(column)
    }

    /// Solves linear conditions that are to hold modulo the ideals. An unknown of the field is as many rational unknowns as
    /// the field has degree.
    fn solve(&self, conditions: &[Condition], reduce: &Reduce<'_>) -> Result<Solutions, Stop> {
        let degree = self.numbers.len();
        let mut columns = Vec::with_capacity(3 * degree + 1);
        for component in 0..3 {
            for number in &self.numbers {
                let polys: Vec<Poly> = conditions
                    .iter()
                    .map(|condition| condition.coefficients[component].scaled(number, self.field))
                    .collect();
                columns.push(self.column(&polys, reduce)?);
            }
        }
        let constants: Vec<Poly> = conditions
            .iter()
            .map(|condition| condition.constant.clone())
            .collect();
        columns.push(self.column(&constants, reduce)?);
        let relations = relations(columns);
        let vector = |x: &[Rational]| -> Vector<Element> {
            [0, 1, 2].map(|component| {
                let parts = x[component * degree..].iter().zip(&self.numbers);
                parts.fold(Element::zero(), |sum, (factor, number)| {
                    sum.plus(&number.scaled(&from_rational(factor)))
                })
            })
        };
        // The last unknown stands for the constant part: with it the solution is affine, and only one relation has it.
        let mut solutions = Solutions {
            particular: None,
            null: Vec::new(),
        };
        for relation in &relations {
            let last = &relation[3 * degree];
            let found = vector(relation);
            if !last.is_zero() {
                solutions.particular = Some(found);
            } else if independent(self.field, &solutions.null, &found) {
                solutions.null.push(found);
            }
        }
        Ok(solutions)
    }
}

impl Condition {
    fn without_constant(coefficients: Vector<Poly>) -> Self {
        Self {
            coefficients,
            constant: Poly::default(),
        }
    }
}

/// A monomial in what a ring does not hold: variables and generators with their powers.
type Outside = Vec<(usize, u16)>;

/// Entries of a column by row: condition, ideal, monomial outside the ring, monomial of the ring.
type Column = BTreeMap<(usize, usize, Outside, Vec<u32>), Rational>;

/// A basis of the linear relations between some columns. The last column has a part in the last relation at most, and
/// there with the factor one.
fn relations(columns: Vec<Column>) -> Vec<Vec<Rational>> {
    let count = columns.len();
    let one = Rational::from_integer(1.into());
    // Columns that are independent so far, each with its combination of the given ones.
    let mut pivots: Vec<(Column, Vec<Rational>)> = Vec::new();
    let mut found = Vec::new();
    for (index, mut column) in columns.into_iter().enumerate() {
        let mut combination = vec![Rational::zero(); count];
        combination[index] = one.clone();
        for (pivot, of) in &pivots {
            let Some((row, lead)) = pivot.first_key_value() else {
                continue;
            };
            let Some(entry) = column.get(row) else {
                continue;
            };
            let factor = entry / lead;
            for (row, value) in pivot {
                let entry = column.entry(row.clone()).or_insert_with(Rational::zero);
                *entry -= &factor * value;
                if entry.is_zero() {
                    column.remove(row);
                }
            }
            for (x, y) in combination.iter_mut().zip(of) {
                *x -= &factor * y;
            }
        }
        if column.is_empty() {
            found.push(combination);
        } else {
            pivots.push((column, combination));
        }
    }
    found
}

/// Whether a vector is independent, over the field, of up to two that are.
fn independent(field: &Field, known: &[Vector<Element>], vector: &Vector<Element>) -> bool {
    let is_nonzero = |v: &Vector<Element>| v.iter().any(|x| !x.is_zero());
    match known {
        [] => is_nonzero(vector),
        [a] => is_nonzero(&cross(field, a, vector)),
        [a, b] => !dot(field, &cross(field, a, b), vector).is_zero(),
        _ => false,
    }
}
