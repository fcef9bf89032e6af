//! The equations of a core, with one constraint pinned to the axes.

use crate::construction::{Shape, drawn_side};
use crate::sketch::{Element, Sketch};
use kutzbach_algebra::{FieldElement, FieldPolynomial, NumberField, OverRationals};
use kutzbach_math::number::Number;
use std::collections::HashMap;

/// Where an element is, as polynomials in the unknowns.
#[derive(Clone, Debug)]
enum Place {
    Point([FieldPolynomial; 2]),
    /// Direction of length one, and how far the line lies to the left of the origin along its normal.
    Line([FieldPolynomial; 2], FieldPolynomial),
}

/// Equations that place all elements of a core.
pub(super) struct System {
    field: NumberField,
    /// By element of the core.
    places: Vec<Place>,
    equations: Vec<FieldPolynomial>,
    unknowns: usize,
}

const NOT_ALGEBRAIC: &str = "a value is no algebraic number, or one of too high a degree";

impl System {
    /// The equations.
    ///
    /// # Errors
    /// Where a value is no algebraic number, or only angles hold the elements.
    pub(super) fn of(sketch: &Sketch, core: &[usize]) -> Result<Self, &'static str> {
        let mut building = Building::new(sketch, core)?;
        building.pin()?;
        for element in core {
            building.place_by_bodies()?;
            if !building.places.contains_key(element) {
                building.place_anywhere(*element);
            }
        }
        building.equate()?;
        let place = |e: &usize| building.places.get(e).cloned();
        Ok(Self {
            places: core
                .iter()
                .map(place)
                .collect::<Option<_>>()
                .ok_or(NOT_ALGEBRAIC)?,
            field: building.field,
            equations: building.equations,
            unknowns: building.unknowns,
        })
    }

    /// Unknowns, equations, and the highest degree of these.
    pub(super) fn size(&self) -> [usize; 3] {
        let degrees = self.equations.iter().map(FieldPolynomial::degree);
        [
            self.unknowns,
            self.equations.len(),
            degrees.max().unwrap_or(0),
        ]
    }

    pub(super) fn over_rationals(&self) -> OverRationals {
        OverRationals::new(&self.equations, self.unknowns, &self.field)
    }

    /// Where the elements are for these values of the unknowns.
    pub(super) fn shapes_at(&self, unknowns: &[f64]) -> Vec<Shape> {
        let value = |polynomial: &FieldPolynomial| -> f64 {
            let term = |(exponents, coefficient): (&[u8], &FieldElement)| {
                let powers = exponents.iter().zip(unknowns);
                let power: f64 = powers.map(|(&e, x)| x.powi(i32::from(e))).product();
                power * self.field.number(coefficient).value()
            };
            // Added to zero, so that none is −0.
            polynomial.terms().map(term).fold(0.0, |sum, x| sum + x)
        };
        let shape = |place: &Place| match place {
            Place::Point(p) => Shape::Point([value(&p[0]), value(&p[1])]),
            Place::Line(direction, offset) => Shape::Line {
                direction: [value(&direction[0]), value(&direction[1])],
                offset: value(offset),
            },
        };
        self.places.iter().map(shape).collect()
    }
}

/// Rigid triangles with a line among elements of a core, and on which side the third element is.
pub(super) fn sided_triangles(sketch: &Sketch, core: &[usize]) -> Vec<([usize; 3], f64)> {
    let triangles = sketch.rigid_triangles().into_iter();
    triangles
        .filter(|(three, _)| three.iter().all(|e| core.contains(e)))
        .filter(|(_, places)| places.iter().any(Element::is_line))
        .map(|(three, places)| {
            let [a, b, c] = places.map(|e| Shape::drawn(&e));
            (three, drawn_side([&a, &b], &c))
        })
        .collect()
}

struct Building<'a> {
    sketch: &'a Sketch,
    /// Constraints among elements of the core, and whether they hold by how these are placed.
    constraints: Vec<(usize, bool)>,
    by_ends: HashMap<[usize; 2], usize>,
    /// Triangles of three points of a rigid body, and whether the third turns left from the first to the second.
    triangles: Vec<([usize; 3], f64)>,
    field: NumberField,
    places: HashMap<usize, Place>,
    equations: Vec<FieldPolynomial>,
    unknowns: usize,
}

impl<'a> Building<'a> {
    fn new(sketch: &'a Sketch, core: &[usize]) -> Result<Self, &'static str> {
        let inside = |ends: &[usize]| ends.iter().all(|e| core.contains(e));
        let constraints = sketch.constraints().iter().enumerate();
        let constraints: Vec<(usize, bool)> = constraints
            .filter(|(_, c)| inside(&c.ends))
            .map(|(i, _)| (i, false))
            .collect();
        let numbers: Vec<Number> = constraints
            .iter()
            .map(|&(i, _)| sketch.constraints()[i].value.clone())
            .collect();
        let triangles = sketch.rigid_triangles().into_iter();
        let triangles = triangles
            .filter(|(three, places)| inside(three) && !places.iter().any(Element::is_line))
            .map(|(three, places)| {
                let [a, b, c] = places.map(|e| Shape::drawn(&e));
                (three, drawn_side([&a, &b], &c))
            });
        Ok(Self {
            triangles: triangles.collect(),
            field: NumberField::of(&numbers).ok_or(NOT_ALGEBRAIC)?,
            by_ends: sketch.by_ends(),
            places: HashMap::new(),
            equations: Vec::new(),
            unknowns: 0,
            sketch,
            constraints,
        })
    }

    fn read(&mut self, number: &Number) -> Result<FieldElement, &'static str> {
        self.field.read(number).ok_or(NOT_ALGEBRAIC)
    }

    fn constant(&mut self, number: &Number) -> Result<FieldPolynomial, &'static str> {
        Ok(FieldPolynomial::constant(self.read(number)?))
    }

    fn is_line(&self, element: usize) -> bool {
        self.sketch.elements()[element].is_line()
    }

    fn value(&self, u: usize, v: usize) -> Option<&Number> {
        let index = self.by_ends.get(&[u, v])?;
        Some(&self.sketch.constraints()[*index].value)
    }

    fn satisfied(&mut self, u: usize, v: usize) {
        if let Some(&index) = self.by_ends.get(&[u, v]) {
            for (constraint, done) in &mut self.constraints {
                *done |= *constraint == index;
            }
        }
    }

    /// Puts a point at the origin, and what is tied to it on the first axis, or parallel to that: two points of a rational distance if
    /// there are such, of a rigid body before others.
    fn pin(&mut self) -> Result<(), &'static str> {
        let rank = |&&(index, _): &&(usize, bool)| {
            let constraint = &self.sketch.constraints()[index];
            let lines = constraint.ends.iter().filter(|&&e| self.is_line(e)).count();
            let in_body =
                |(three, _): &([usize; 3], f64)| constraint.ends.iter().all(|e| three.contains(e));
            (
                lines,
                constraint.value.rational().is_none(),
                !self.triangles.iter().any(in_body),
            )
        };
        let best = self.constraints.iter().min_by_key(rank).map(|&(i, _)| i);
        let index = best.ok_or("nothing holds its elements")?;
        let [u, v] = self.sketch.constraints()[index].ends;
        let value = self.sketch.constraints()[index].value.clone();
        let zero = || FieldPolynomial::constant(FieldElement::integer(0));
        let one = || FieldPolynomial::constant(FieldElement::integer(1));
        let (point, other) = match (self.is_line(u), self.is_line(v)) {
            (true, true) => return Err("only angles hold its elements"),
            (true, false) => (v, u),
            (false, _) => (u, v),
        };
        let other_place = match self.is_line(other) {
            false => Place::Point([self.constant(&value)?, zero()]),
            true => Place::Line([one(), zero()], self.constant(&-&value)?),
        };
        self.places.insert(point, Place::Point([zero(), zero()]));
        self.places.insert(other, other_place);
        self.satisfied(u, v);
        Ok(())
    }

    /// Places points of rigid bodies by two others that are placed: linear, and on the side drawn.
    fn place_by_bodies(&mut self) -> Result<(), &'static str> {
        loop {
            let ready = self.triangles.iter().find_map(|&(three, side)| {
                let mut open = three.iter().filter(|e| !self.places.contains_key(e));
                let (new, none) = (*open.next()?, open.next());
                let [a, b] = match three {
                    [x, y, z] if z == new => [x, y],
                    [x, y, z] if y == new => [z, x],
                    [_, y, z] => [y, z],
                };
                none.is_none().then_some(([a, b, new], side))
            });
            let Some(([a, b, new], side)) = ready else {
                return Ok(());
            };
            let place = self.third_of_body([a, b, new], side)?;
            self.places.insert(new, place);
            self.satisfied(a, new);
            self.satisfied(b, new);
        }
    }

    fn third_of_body(&mut self, [a, b, new]: [usize; 3], side: f64) -> Result<Place, &'static str> {
        const UNTIED: &str = "a rigid body lacks a distance";
        let square = |n: &Number| n * n;
        let [ab, an, bn] =
            [(a, b), (a, new), (b, new)].map(|(u, v)| self.value(u, v).map(square).ok_or(UNTIED));
        let (ab, an, bn) = (ab?, an?, bn?);
        // Along a → b by the share u of it, and to the left by the share w.
        let twice = &ab + &ab;
        let along = &(&ab + &an) - &bn;
        let four = Number::integer(4);
        let heron = &(&four * &(&ab * &an)) - &(&along * &along);
        let area = match heron.signum() {
            1 => heron.sqrt().map_err(|_| NOT_ALGEBRAIC)?,
            _ => Number::zero(),
        };
        let u = along.checked_div(&twice).map_err(|_| UNTIED)?;
        let w = area.checked_div(&twice).map_err(|_| UNTIED)?;
        let w = if side < 0.0 { -&w } else { w };
        let (u, w) = (self.read(&u)?, self.read(&w)?);
        let (Some(Place::Point(p)), Some(Place::Point(q))) =
            (self.places.get(&a), self.places.get(&b))
        else {
            return Err(UNTIED);
        };
        let [dx, dy] = [0, 1].map(|k| q[k].minus(&p[k]));
        let field = &self.field;
        let x = p[0]
            .plus(&dx.scaled(&u, field))
            .minus(&dy.scaled(&w, field));
        let y = p[1].plus(&dy.scaled(&u, field)).plus(&dx.scaled(&w, field));
        Ok(Place::Point([x, y]))
    }

    /// Gives an element unknowns of its own.
    fn place_anywhere(&mut self, element: usize) {
        let mut fresh = || {
            self.unknowns += 1;
            FieldPolynomial::unknown(self.unknowns - 1)
        };
        let first = [fresh(), fresh()];
        let place = match self.sketch.elements()[element].is_line() {
            false => Place::Point(first),
            true => {
                let offset = fresh();
                let square = self.dot(&first, &first);
                let one = FieldPolynomial::constant(FieldElement::integer(1));
                self.equations.push(square.minus(&one));
                Place::Line(first, offset)
            }
        };
        self.places.insert(element, place);
    }

    fn dot(&self, a: &[FieldPolynomial; 2], b: &[FieldPolynomial; 2]) -> FieldPolynomial {
        a[0].times(&b[0], &self.field)
            .plus(&a[1].times(&b[1], &self.field))
    }

    /// What the constraints ask for beyond how the elements were placed.
    fn equate(&mut self) -> Result<(), &'static str> {
        for (index, done) in self.constraints.clone() {
            if done {
                continue;
            }
            let constraint = &self.sketch.constraints()[index];
            let value = constraint.value.clone();
            let [Some(one), Some(other)] = constraint.ends.map(|e| self.places.get(&e).cloned())
            else {
                return Err(NOT_ALGEBRAIC);
            };
            match (one, other) {
                (Place::Point(p), Place::Point(q)) => {
                    let off = [0, 1].map(|k| q[k].minus(&p[k]));
                    let square = self.constant(&(&value * &value))?;
                    self.equations.push(self.dot(&off, &off).minus(&square));
                }
                (Place::Point(p), Place::Line([c, s], offset))
                | (Place::Line([c, s], offset), Place::Point(p)) => {
                    let zero = FieldPolynomial::default();
                    let normal = [zero.minus(&s), c];
                    let asked = self.constant(&value)?;
                    let left = self.dot(&normal, &p).minus(&offset);
                    self.equations.push(left.minus(&asked));
                }
                (Place::Line(a, _), Place::Line([c, s], _)) => {
                    let (cos, sin) = value.cos_sin();
                    let (cos, sin) = (self.constant(&cos)?, self.constant(&sin)?);
                    let zero = FieldPolynomial::default();
                    let across = [zero.minus(&a[1]), a[0].clone()];
                    let direction = [c, s];
                    self.equations.push(self.dot(&a, &direction).minus(&cos));
                    self.equations
                        .push(self.dot(&across, &direction).minus(&sin));
                }
            }
        }
        Ok(())
    }
}
