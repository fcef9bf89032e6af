//! Motions: a rotation and then a translation.

use crate::boundary::{Boundary, Face};
use crate::decide::{Answer, Certainty, Decider};
use crate::entity::{Direction, Entity, Line, Plane, Point, Segment, Vector};
use crate::error::GeometryError;
use crate::scalar::Scalar;
use crate::triple::{cross, dot, length, minus, negated, plus, quotient, square};

/// A rotation about the origin and then a translation: what moves a body as it is. Reflections and changes of size are refused.
#[derive(Clone, Debug)]
pub struct Transformation<S> {
    rows: [[S; 3]; 3],
    translation: [S; 3],
    certainty: Certainty,
}

fn unit_rows<S: Scalar>() -> [[S; 3]; 3] {
    [0, 1, 2].map(|row| [0, 1, 2].map(|column| S::whole(i32::from(row == column))))
}

fn column<S: Scalar>(rows: &[[S; 3]; 3], number: usize) -> [S; 3] {
    [0, 1, 2].map(|row: usize| rows[row][number].clone())
}

impl<S: Scalar> Transformation<S> {
    /// What leaves everything where it is.
    #[must_use]
    pub fn identity() -> Self {
        Self::translation(&Vector([0, 0, 0].map(S::whole)))
    }

    /// A translation.
    #[must_use]
    pub fn translation(by: &Vector<S>) -> Self {
        Self {
            rows: unit_rows(),
            translation: by.0.clone(),
            certainty: Certainty::Proven,
        }
    }

    /// The rotation of a matrix, given by its rows, and then a translation.
    ///
    /// # Errors
    /// Where the rows are certainly not of length 1 and perpendicular to each other, and where they are a reflection.
    pub fn new(rows: [[S; 3]; 3], translation: Vector<S>) -> Result<Self, GeometryError> {
        let mut decider = Decider::default();
        let needed = "a rotation: rows of length 1, perpendicular to each other, right-handed";
        for (i, row) in rows.iter().enumerate() {
            for (j, other) in rows.iter().enumerate().skip(i) {
                let product = dot(row, other).minus(&S::whole(i32::from(i == j)));
                if !decider.is_zero(&product) {
                    return Err(GeometryError::Degenerate {
                        needed,
                        found: "other rows: give roots as roots, or numbers with their uncertainty",
                    });
                }
            }
        }
        let [x, y, z] = &rows;
        if !decider.counts(Answer::positive(dot(&cross(x, y), z).sign())) {
            return Err(GeometryError::Degenerate {
                needed,
                found: "a reflection: reverse one row",
            });
        }
        Ok(Self {
            rows,
            translation: translation.0,
            certainty: decider.certainty(),
        })
    }

    /// The rotation about an axis by an angle that is given by its cosine and sine; seen against the direction of the axis it
    /// is counterclockwise.
    ///
    /// # Errors
    /// Where the squares of both certainly do not add up to 1, and beyond the range of numbers.
    pub fn about(axis: &Line<S>, cosine: &S, sine: &S) -> Result<Self, GeometryError> {
        let mut decider = Decider::default();
        let excess = cosine.squared().plus(&sine.squared()).minus(&S::whole(1));
        if !decider.is_zero(&excess) {
            return Err(GeometryError::Degenerate {
                needed: "a cosine and a sine of one angle",
                found: "numbers of which the squares do not add up to 1",
            });
        }
        let along = axis.direction().components();
        let rest = quotient(&S::whole(1).minus(cosine), &square(along))?;
        let [x, y, z] = {
            let scale = quotient(sine, &length(along)?)?;
            [0, 1, 2].map(|i: usize| along[i].times(&scale))
        };
        let zero = S::whole(0);
        // What turns a vector into its product with the axis, times the sine.
        let across = [
            [zero.clone(), z.negated(), y.clone()],
            [z, zero.clone(), x.negated()],
            [y.negated(), x, zero.clone()],
        ];
        let mut rows = across;
        for (i, row) in rows.iter_mut().enumerate() {
            for (j, entry) in row.iter_mut().enumerate() {
                *entry = entry.plus(&along[i].times(&along[j]).times(&rest));
                if i == j {
                    *entry = entry.plus(cosine);
                }
            }
        }
        let mut found = Self {
            rows,
            translation: [zero.clone(), zero.clone(), zero],
            certainty: decider.certainty(),
        };
        let base = &axis.point().0;
        found.translation = minus(base, &found.turned(base));
        Ok(found)
    }

    /// How certain it is that it is a rotation: of measured numbers it never is.
    #[must_use]
    pub fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// The rows of the rotation.
    #[must_use]
    pub fn rows(&self) -> &[[S; 3]; 3] {
        &self.rows
    }

    /// Where the origin is moved to.
    #[must_use]
    pub fn shift(&self) -> Vector<S> {
        Vector(self.translation.clone())
    }

    /// First this one, then another.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        let columns = [0, 1, 2].map(|i| column(&self.rows, i));
        let row = |i: usize| [0, 1, 2].map(|j: usize| dot(&next.rows[i], &columns[j]));
        Self {
            rows: [row(0), row(1), row(2)],
            translation: next.moved(&self.translation),
            certainty: self.certainty.max(next.certainty),
        }
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        let mut back = Self {
            rows: [0, 1, 2].map(|i| column(&self.rows, i)),
            translation: [0, 0, 0].map(S::whole),
            certainty: self.certainty,
        };
        back.translation = negated(&back.turned(&self.translation));
        back
    }

    fn turned(&self, v: &[S; 3]) -> [S; 3] {
        [0, 1, 2].map(|i: usize| dot(&self.rows[i], v))
    }

    fn moved(&self, point: &[S; 3]) -> [S; 3] {
        plus(&self.turned(point), &self.translation)
    }

    /// A point elsewhere.
    #[must_use]
    pub fn point(&self, point: &Point<S>) -> Point<S> {
        Point(self.moved(&point.0))
    }

    /// A vector turned; it has no place.
    #[must_use]
    pub fn vector(&self, vector: &Vector<S>) -> Vector<S> {
        Vector(self.turned(&vector.0))
    }

    /// A direction turned.
    ///
    /// # Errors
    /// Where digits no longer tell it from zero; this and the following functions have no other error, and exact numbers
    /// within their range have none.
    pub fn direction(&self, direction: &Direction<S>) -> Result<Direction<S>, GeometryError> {
        Direction::new(self.turned(direction.components()))
    }

    /// A line elsewhere.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn line(&self, line: &Line<S>) -> Result<Line<S>, GeometryError> {
        let direction = self.direction(line.direction())?;
        Ok(Line::new(self.point(line.point()), direction))
    }

    /// A plane elsewhere.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn plane(&self, plane: &Plane<S>) -> Result<Plane<S>, GeometryError> {
        let normal = self.direction(plane.normal())?;
        Ok(Plane::new(self.point(plane.point()), normal))
    }

    /// A segment elsewhere.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn segment(&self, segment: &Segment<S>) -> Result<Segment<S>, GeometryError> {
        Segment::new(self.point(segment.from()), self.point(segment.to()))
    }

    /// A face elsewhere.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn face(&self, face: &Face<S>) -> Result<Face<S>, GeometryError> {
        let plane = self.plane(face.plane())?;
        Ok(face.moved(plane, |point| self.point(point)))
    }

    /// A boundary elsewhere: all its numbers stay.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn boundary(&self, boundary: &Boundary<S>) -> Result<Boundary<S>, GeometryError> {
        boundary.moved(|face| self.face(face), |point| self.point(point))
    }

    /// Any entity elsewhere.
    ///
    /// # Errors
    /// As of [`Transformation::direction`].
    pub fn entity(&self, entity: &Entity<S>) -> Result<Entity<S>, GeometryError> {
        Ok(match entity {
            Entity::Vector(x) => self.vector(x).into(),
            Entity::Direction(x) => self.direction(x)?.into(),
            Entity::Point(x) => self.point(x).into(),
            Entity::Line(x) => self.line(x)?.into(),
            Entity::Plane(x) => self.plane(x)?.into(),
            Entity::Segment(x) => self.segment(x)?.into(),
            Entity::Face(x) => self.face(x)?.into(),
            Entity::Boundary(x) => self.boundary(x)?.into(),
            Entity::Circle(x) => x.in_plane(self.plane(x.plane())?).into(),
            Entity::Cylinder(x) => x.about(self.line(x.axis())?).into(),
            Entity::Cone(x) => x.about(self.line(x.axis())?).into(),
            Entity::Sphere(x) => x.about(self.point(x.centre())).into(),
        })
    }
}
