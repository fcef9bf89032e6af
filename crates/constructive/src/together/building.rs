//! How the equations of a core are made: one constraint pinned to the axes, elements placed by others, and what is left as equations.

use super::search::Start;
use super::unknown_values::Values;
use crate::construction::{Motion, Shape, drawn_side};
use crate::relation::Relation;
use crate::sketch::{Constraint, Element, Sketch};
use kutzbach_algebra::{FieldElement, FieldPolynomial, NumberField};
use kutzbach_math::number::Number;
use std::collections::HashMap;

/// Where an element is, as polynomials in the unknowns.
#[derive(Clone, Debug)]
pub(super) enum Place {
    Point([FieldPolynomial; 2]),
    /// Direction of length one, and how far the line lies to the left of the origin along its normal.
    Line([FieldPolynomial; 2], FieldPolynomial),
}

pub(super) const NOT_ALGEBRAIC: &str =
    "a value is no algebraic number, or one of too high a degree";

/// The origin, and the first axis or a point on it.
pub(super) const fn on_the_axes(line: bool) -> [Shape; 2] {
    let other = match line {
        false => Shape::Point([1.0, 0.0]),
        true => Shape::Line {
            direction: [1.0, 0.0],
            offset: 0.0,
        },
    };
    [Shape::Point([0.0, 0.0]), other]
}

/// How far apart points are drawn at most; one where they tell nothing.
fn size(sketch: &Sketch, core: &[usize]) -> f64 {
    let points = core.iter().filter_map(|&e| match sketch.elements()[e] {
        Element::Point(p) => Some(p),
        Element::Line { .. } => None,
    });
    let mut least = [f64::INFINITY; 2];
    let mut most = [f64::NEG_INFINITY; 2];
    for p in points {
        for k in 0..2 {
            least[k] = least[k].min(p[k]);
            most[k] = most[k].max(p[k]);
        }
    }
    let size = (most[0] - least[0]).max(most[1] - least[1]);
    if size > 0.0 { size } else { 1.0 }
}

/// Equations under way: elements are placed one after another, by constraints where these leave few unknowns.
pub(super) struct Building<'a> {
    pub(super) sketch: &'a Sketch,
    core: &'a [usize],
    /// Constraints among elements of the core, and whether they hold by how these are placed.
    constraints: Vec<(usize, bool)>,
    /// Relations among elements of the core, and the same.
    pub(super) relations: Vec<(&'a Relation, bool)>,
    pub(super) values: Values,
    by_ends: HashMap<[usize; 2], usize>,
    /// Triangles of three points of a rigid body, and whether the third turns left from the first to the second.
    triangles: Vec<([usize; 3], f64)>,
    pub(super) field: NumberField,
    pub(super) places: HashMap<usize, Place>,
    pub(super) equations: Vec<FieldPolynomial>,
    /// By unknown: where it is drawn.
    pub(super) starts: Vec<Start>,
    /// From the drawing to the axes.
    frame: Option<Motion>,
    /// How large the drawing is.
    pub(super) size: f64,
}

impl<'a> Building<'a> {
    pub(super) fn new(sketch: &'a Sketch, core: &'a [usize]) -> Result<Self, &'static str> {
        let inside = |ends: &[usize]| ends.iter().all(|e| core.contains(e));
        let constraints = sketch.constraints().iter().enumerate();
        let constraints: Vec<(usize, bool)> = constraints
            .filter(|(_, c)| inside(&c.ends))
            .map(|(i, _)| (i, false))
            .collect();
        let relations = sketch.relations().iter();
        let relations: Vec<&Relation> = relations.filter(|r| inside(&r.elements())).collect();
        let added = relations.iter().filter_map(|r| match r {
            Relation::Measured { plus, .. } => Some(plus.clone()),
            _ => None,
        });
        let numbers: Vec<Number> = constraints
            .iter()
            .map(|&(i, _)| sketch.constraints()[i].value.clone())
            .chain(added)
            .collect();
        let triangles = sketch.rigid_triangles().into_iter();
        let triangles = triangles
            .filter(|(three, places)| inside(three) && !places.iter().any(Element::is_line))
            .map(|(three, places)| {
                let [a, b, c] = places.map(|e| Shape::drawn(&e));
                (three, drawn_side([&a, &b], &c))
            });
        let mut building = Self {
            values: Values::default(),
            relations: relations.into_iter().map(|r| (r, false)).collect(),
            triangles: triangles.collect(),
            field: NumberField::of(&numbers).ok_or(NOT_ALGEBRAIC)?,
            by_ends: sketch.by_ends(),
            places: HashMap::new(),
            equations: Vec::new(),
            starts: Vec::new(),
            frame: None,
            size: size(sketch, core),
            sketch,
            core,
            constraints,
        };
        building.measure_values();
        Ok(building)
    }

    /// The points of the core, ascending.
    pub(super) fn points(&self) -> impl Iterator<Item = usize> {
        let all = self.core.iter().copied();
        all.filter(|&e| !self.is_line(e))
    }

    /// Points of the core that are tied to a line, and how far they lie to its left.
    pub(super) fn tied_points(&self, line: usize) -> Vec<(usize, Number)> {
        let tied = self.constraints.iter().filter_map(|&(i, _)| {
            let Constraint { ends, value } = &self.sketch.constraints()[i];
            let point = match *ends {
                [u, v] if v == line => u,
                [u, v] if u == line => v,
                _ => return None,
            };
            (!self.is_line(point)).then(|| (point, value.clone()))
        });
        tied.collect()
    }

    /// A new unknown.
    pub(super) fn fresh(&mut self, start: Start) -> FieldPolynomial {
        self.starts.push(start);
        FieldPolynomial::unknown(self.starts.len() - 1)
    }

    /// A new unknown that is a length, drawn like this.
    pub(super) fn fresh_length(&mut self, drawn: f64) -> FieldPolynomial {
        self.fresh(Start::At(drawn, self.size))
    }

    /// Where an element is drawn, on the axes.
    pub(super) fn drawn(&self, element: usize) -> Shape {
        let drawn = Shape::drawn(&self.sketch.elements()[element]);
        self.frame.map_or(drawn, |frame| frame.of(&drawn))
    }

    /// Elements are drawn as these two are put on the axes.
    pub(super) fn pinned(&mut self, elements: [usize; 2], to: [Shape; 2]) {
        let [a, b] = elements.map(|e| Shape::drawn(&self.sketch.elements()[e]));
        self.frame = Motion::onto([&a, &b], [&to[0], &to[1]]);
    }

    fn read(&mut self, number: &Number) -> Result<FieldElement, &'static str> {
        self.field.read(number).ok_or(NOT_ALGEBRAIC)
    }

    pub(super) fn constant(&mut self, number: &Number) -> Result<FieldPolynomial, &'static str> {
        Ok(FieldPolynomial::constant(self.read(number)?))
    }

    pub(super) fn is_line(&self, element: usize) -> bool {
        self.sketch.elements()[element].is_line()
    }

    fn value(&self, u: usize, v: usize) -> Option<&Number> {
        let index = self.by_ends.get(&[u, v])?;
        Some(&self.sketch.constraints()[*index].value)
    }

    pub(super) fn satisfied(&mut self, u: usize, v: usize) {
        if let Some(&index) = self.by_ends.get(&[u, v]) {
            for (constraint, done) in &mut self.constraints {
                *done |= *constraint == index;
            }
        }
    }

    /// Puts a point at the origin, and what is tied to it on the first axis, or parallel to that: two points of a rational distance if
    /// there are such, of a rigid body before others.
    ///
    /// Where there are mirror images their axis is the first axis instead.
    pub(super) fn pin(&mut self) -> Result<(), &'static str> {
        if self.pin_mirror()? {
            return Ok(());
        }
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
        let ends = best.map(|index| self.sketch.constraints()[index].ends);
        let held = ends.filter(|ends| !ends.iter().all(|&e| self.is_line(e)));
        if held.is_none() && self.pin_by_value()? {
            return Ok(());
        }
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
        self.pinned([point, other], on_the_axes(self.is_line(other)));
        self.places.insert(point, Place::Point([zero(), zero()]));
        self.places.insert(other, other_place);
        self.satisfied(u, v);
        Ok(())
    }

    /// Places whatever others that are placed say something of, so that fewer unknowns are left.
    pub(super) fn place_by_others(&mut self) -> Result<(), &'static str> {
        loop {
            self.place_by_bodies()?;
            if !(self.place_by_relation() || self.place_by_direction()? || self.place_beside()?) {
                return Ok(());
            }
        }
    }

    /// A constraint between a placed and an open element for which this holds, and its value as seen from the placed one.
    fn next_tied(&self, suits: impl Fn(&Place, usize) -> bool) -> Option<(usize, usize, Number)> {
        self.constraints.iter().find_map(|&(i, _)| {
            let constraint = &self.sketch.constraints()[i];
            let [u, v] = constraint.ends;
            let (from, to, turned) = match [u, v].map(|e| self.places.contains_key(&e)) {
                [true, false] => (u, v, false),
                [false, true] => (v, u, true),
                _ => return None,
            };
            let angle = self.is_line(u) && self.is_line(v);
            let value = match angle && turned {
                true => -&constraint.value,
                false => constraint.value.clone(),
            };
            suits(self.places.get(&from)?, to).then_some((from, to, value))
        })
    }

    /// Places a line by its angle with one that is placed: how far it lies to the left is left open.
    fn place_by_direction(&mut self) -> Result<bool, &'static str> {
        let is_line = |e: usize| self.sketch.elements()[e].is_line();
        let line = |place: &Place, e: usize| matches!(place, Place::Line(..)) && is_line(e);
        let Some((from, to, value)) = self.next_tied(line) else {
            return Ok(false);
        };
        let (cos, sin) = value.cos_sin();
        let (cos, sin) = (self.read(&cos)?, self.read(&sin)?);
        let Some(Place::Line([c, s], _)) = self.places.get(&from) else {
            return Ok(false);
        };
        let by = |a: &FieldPolynomial, x: &FieldElement| a.scaled(x, &self.field);
        let direction = [
            by(c, &cos).minus(&by(s, &sin)),
            by(s, &cos).plus(&by(c, &sin)),
        ];
        let offset = self.fresh_length(self.drawn(to).offset());
        self.places.insert(to, Place::Line(direction, offset));
        self.satisfied(from, to);
        Ok(true)
    }

    /// Places a point that lies at a distance from a line of known direction: how far along is left open.
    fn place_beside(&mut self) -> Result<bool, &'static str> {
        let is_line = |e: usize| self.sketch.elements()[e].is_line();
        let known = |place: &Place, e: usize| match place {
            Place::Line(direction, _) => {
                !is_line(e) && direction.iter().all(FieldPolynomial::is_constant)
            }
            Place::Point(_) => false,
        };
        let Some((from, to, value)) = self.next_tied(known) else {
            return Ok(false);
        };
        let by = self.constant(&value)?;
        let Some(Place::Line([c, s], offset)) = self.places.get(&from).cloned() else {
            return Ok(false);
        };
        let along = match (self.drawn(to), self.drawn(from)) {
            (Shape::Point([x, y]), Shape::Line { direction, .. }) => {
                x * direction[0] + y * direction[1]
            }
            _ => 0.0,
        };
        let along = self.fresh_length(along);
        let left = offset.plus(&by);
        let times = |a: &FieldPolynomial, b: &FieldPolynomial| a.times(b, &self.field);
        let point = [
            times(&c, &along).minus(&times(&s, &left)),
            times(&s, &along).plus(&times(&c, &left)),
        ];
        self.places.insert(to, Place::Point(point));
        self.satisfied(from, to);
        Ok(true)
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
    pub(super) fn place_anywhere(&mut self, element: usize) {
        let place = match self.drawn(element) {
            Shape::Point(p) => Place::Point(p.map(|x| self.fresh_length(x))),
            Shape::Line { direction, offset } => {
                let first = direction.map(|x| self.fresh(Start::At(x, 1.0)));
                let offset = self.fresh_length(offset);
                let square = self.dot(&first, &first);
                let one = FieldPolynomial::constant(FieldElement::integer(1));
                self.equations.push(square.minus(&one));
                Place::Line(first, offset)
            }
        };
        self.places.insert(element, place);
    }

    pub(super) fn dot(
        &self,
        a: &[FieldPolynomial; 2],
        b: &[FieldPolynomial; 2],
    ) -> FieldPolynomial {
        a[0].times(&b[0], &self.field)
            .plus(&a[1].times(&b[1], &self.field))
    }

    /// What the constraints ask for beyond how the elements were placed.
    pub(super) fn equate(&mut self) -> Result<(), &'static str> {
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
