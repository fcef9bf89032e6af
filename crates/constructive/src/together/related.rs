//! Relations of more than two elements in the equations of a core.

use super::building::{Building, Place, on_the_axes};
use crate::construction::{Construction, Shape};
use crate::relation::Relation;
use kutzbach_algebra::{FieldElement, FieldPolynomial};

/// Polynomials of degree zero.
fn integer(value: i64) -> FieldPolynomial {
    FieldPolynomial::constant(FieldElement::integer(value))
}

/// A direction turned to the left.
fn left([c, s]: &[FieldPolynomial; 2]) -> [FieldPolynomial; 2] {
    [FieldPolynomial::default().minus(s), c.clone()]
}

fn twice(a: &FieldPolynomial) -> FieldPolynomial {
    a.plus(a)
}

impl Building<'_> {
    /// Puts the first axis that something is mirrored in on the first axis of coordinates, and a point across from the origin: mirror images then are
    /// linear.
    pub(super) fn pin_mirror(&mut self) -> Result<bool, &'static str> {
        let axis = self.relations.iter().find_map(|(r, _)| match r {
            Relation::Mirrored { axis, .. } => Some(*axis),
            _ => None,
        });
        let Some(axis) = axis else { return Ok(false) };
        let tied = self.tied_points(axis);
        let mirrored = self.relations.iter().find_map(|(r, _)| match r {
            Relation::Mirrored { pair, axis: a, .. } if *a == axis && !self.is_line(pair[0]) => {
                Some(pair[0])
            }
            _ => None,
        });
        let any = self.points().next();
        let (point, height) = match (tied.into_iter().next(), mirrored.or(any)) {
            (Some((point, value)), _) => (point, self.constant(&value)?),
            (None, Some(point)) => {
                let drawn = [point, axis].map(|e| self.drawn(e));
                let height = Construction::value_between(&drawn[0], &drawn[1]);
                (point, self.fresh_length(height))
            }
            (None, None) => return Err("only angles hold its elements"),
        };
        let drawn = [point, axis].map(|e| self.drawn(e));
        let height_drawn = Construction::value_between(&drawn[0], &drawn[1]);
        let [_, on_axis] = on_the_axes(true);
        self.pinned([axis, point], [on_axis, Shape::Point([0.0, height_drawn])]);
        self.satisfied(point, axis);
        let line = Place::Line([integer(1), integer(0)], integer(0));
        self.places.insert(axis, line);
        self.places
            .insert(point, Place::Point([integer(0), height]));
        Ok(true)
    }

    /// Puts two elements on the axes whose distance is an unknown value.
    pub(super) fn pin_by_value(&mut self) -> Result<bool, &'static str> {
        let measured = self
            .relations
            .iter()
            .position(|(relation, _)| match relation {
                // A sum may come out below zero.
                Relation::Measured { ends, terms, plus } => {
                    ends.iter().any(|&e| self.is_line(e))
                        || (terms.iter().all(|t| !t.1) && plus.signum() >= 0)
                }
                _ => false,
            });
        let Some(index) = measured else {
            return Ok(false);
        };
        let Relation::Measured { ends, terms, plus } = self.relations[index].0 else {
            return Ok(false);
        };
        let (sum, squared) = self.sum(terms, plus)?;
        let zero = || integer(0);
        let (point, other, place) = match ends.map(|e| self.is_line(e)) {
            [false, false] if squared => {
                // The distance itself is an unknown besides, one of two signs: its square is known to be no more.
                return Ok(false);
            }
            [false, false] => (ends[0], ends[1], Place::Point([sum, zero()])),
            [line, _] => {
                let [point, other] = if line { [ends[1], ends[0]] } else { *ends };
                let place = Place::Line([integer(1), zero()], zero().minus(&sum));
                (point, other, place)
            }
        };
        self.pinned([point, other], on_the_axes(self.is_line(other)));
        self.places.insert(point, Place::Point([zero(), zero()]));
        self.places.insert(other, place);
        self.relations[index].1 = true;
        Ok(true)
    }

    /// Places one element that a relation places by others, as long as that is linear.
    pub(super) fn place_by_relation(&mut self) -> bool {
        let found = self
            .relations
            .iter()
            .enumerate()
            .find_map(|(i, (r, done))| {
                let (element, place) = (!done).then(|| self.by_relation(r)).flatten()?;
                Some((i, element, place))
            });
        let Some((i, element, place)) = found else {
            return false;
        };
        self.places.insert(element, place);
        self.relations[i].1 = true;
        true
    }

    fn by_relation(&self, relation: &Relation) -> Option<(usize, Place)> {
        let open = |all: &[usize]| {
            let mut open = all.iter().filter(|e| !self.places.contains_key(e));
            let first = open.next()?;
            open.next().is_none().then_some(*first)
        };
        match *relation {
            Relation::Middle { point, of: [a, b] } => {
                let element = open(&[point, a, b])?;
                let at = |e: usize| match self.places.get(&e) {
                    Some(Place::Point(p)) => Some(p),
                    _ => None,
                };
                let place = if element == point {
                    let (p, q) = (at(a)?, at(b)?);
                    let half = self.field.inverse(&FieldElement::integer(2))?;
                    [0, 1].map(|k| p[k].plus(&q[k]).scaled(&half, &self.field))
                } else {
                    let (m, q) = (at(point)?, at(if element == a { b } else { a })?);
                    [0, 1].map(|k| twice(&m[k]).minus(&q[k]))
                };
                Some((element, Place::Point(place)))
            }
            Relation::Mirrored {
                pair: [a, b],
                axis,
                against,
            } => {
                let element = open(&[a, b, axis]).filter(|e| *e != axis)?;
                let Some(Place::Line(direction, offset)) = self.places.get(&axis) else {
                    return None;
                };
                let other = self.places.get(&if element == a { b } else { a })?;
                let known = direction.iter().all(FieldPolynomial::is_constant);
                known.then(|| (element, self.image(other, (direction, offset), against)))
            }
            Relation::Measured { .. } => None,
        }
    }

    /// The mirror image, as [`crate::relation`] has it.
    fn image(
        &self,
        other: &Place,
        (direction, offset): (&[FieldPolynomial; 2], &FieldPolynomial),
        against: bool,
    ) -> Place {
        let times = |a: &FieldPolynomial, b: &FieldPolynomial| a.times(b, &self.field);
        let reflected = |v: &[FieldPolynomial; 2]| {
            let along = twice(&self.dot(direction, v));
            [0, 1].map(|k| times(&along, &direction[k]).minus(&v[k]))
        };
        match other {
            Place::Point(p) => {
                let (image, normal) = (reflected(p), left(direction));
                let far = twice(offset);
                Place::Point([0, 1].map(|k| image[k].plus(&times(&far, &normal[k]))))
            }
            Place::Line(own, at) => {
                let along = self.dot(direction, own);
                let image = reflected(own);
                let moved = at.minus(&times(&twice(offset), &along));
                let zero = FieldPolynomial::default();
                match against {
                    true => Place::Line(image.map(|x| zero.minus(&x)), moved),
                    false => Place::Line(image, zero.minus(&moved)),
                }
            }
        }
    }

    /// What relations ask for beyond how elements were placed.
    pub(super) fn relate(&mut self) -> Result<(), &'static str> {
        const UNPLACED: &str = "a relation of an element that has no place";
        for (relation, done) in self.relations.clone() {
            if done {
                continue;
            }
            let places = relation.elements().into_iter();
            let places: Vec<Place> = places
                .map(|e| self.places.get(&e).cloned())
                .collect::<Option<_>>()
                .ok_or(UNPLACED)?;
            match (relation, &places[..]) {
                (Relation::Middle { .. }, [Place::Point(m), Place::Point(p), Place::Point(q)]) => {
                    let off = [0, 1].map(|k| twice(&m[k]).minus(&p[k]).minus(&q[k]));
                    self.equations.extend(off);
                }
                (
                    Relation::Mirrored { .. },
                    [
                        Place::Point(p),
                        Place::Point(q),
                        Place::Line(direction, offset),
                    ],
                ) => {
                    let sum = [0, 1].map(|k| p[k].plus(&q[k]));
                    let off = [0, 1].map(|k| q[k].minus(&p[k]));
                    let middle = self.dot(&left(direction), &sum).minus(&twice(offset));
                    let along = self.dot(direction, &off);
                    self.equations.extend([middle, along]);
                }
                (
                    Relation::Mirrored { against, .. },
                    [
                        one @ Place::Line(..),
                        Place::Line(found, at),
                        Place::Line(direction, offset),
                    ],
                ) => {
                    let Place::Line(image, moved) = self.image(one, (direction, offset), *against)
                    else {
                        return Err(UNPLACED);
                    };
                    let off = [0, 1].map(|k| found[k].minus(&image[k]));
                    self.equations.extend(off);
                    self.equations.push(at.minus(&moved));
                }
                (Relation::Measured { terms, plus, .. }, [one, other]) => {
                    let (sum, squared) = self.sum(terms, plus)?;
                    let equation = match (one, other) {
                        (Place::Point(p), Place::Point(q)) => {
                            let off = [0, 1].map(|k| q[k].minus(&p[k]));
                            let square = match squared {
                                true => sum,
                                false => sum.times(&sum, &self.field),
                            };
                            self.dot(&off, &off).minus(&square)
                        }
                        (Place::Point(p), Place::Line(direction, offset))
                        | (Place::Line(direction, offset), Place::Point(p)) => {
                            let far = self.dot(&left(direction), p).minus(offset);
                            far.minus(&sum)
                        }
                        _ => return Err(UNPLACED),
                    };
                    self.equations.push(equation);
                }
                _ => return Err(UNPLACED),
            }
        }
        Ok(())
    }
}
