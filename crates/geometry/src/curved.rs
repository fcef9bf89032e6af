//! Circles, cylinders, cones and spheres. One that exists is valid.

use crate::decide::Sign;
use crate::entity::{Direction, Line, Plane, Point};
use crate::error::GeometryError;
use crate::scalar::Scalar;

/// A circle without what is inside of it.
#[derive(Clone, Debug)]
pub struct Circle<S> {
    plane: Plane<S>,
    radius: S,
}

/// A cylinder of circles without limits along its axis, without what is inside of it.
#[derive(Clone, Debug)]
pub struct Cylinder<S> {
    axis: Line<S>,
    radius: S,
}

/// One half of a cone of circles without a limit, from its apex along its axis, without what is inside of it.
#[derive(Clone, Debug)]
pub struct Cone<S> {
    axis: Line<S>,
    tangent: S,
}

/// A sphere without what is inside of it.
#[derive(Clone, Debug)]
pub struct Sphere<S> {
    centre: Point<S>,
    radius: S,
}

/// A number that is certainly above zero.
fn above_zero<S: Scalar>(number: S, needed: &'static str) -> Result<S, GeometryError> {
    let found = match number.sign() {
        Sign::Positive => return Ok(number),
        Sign::Zero => "0",
        Sign::Negative => "one below 0",
        Sign::WithinDigits => "one that may be 0 or less within its digits",
        Sign::Indistinguishable => "one that no digits tell from 0",
    };
    Err(GeometryError::Degenerate { needed, found })
}

impl<S: Scalar> Circle<S> {
    /// The circle about a centre across a normal.
    ///
    /// # Errors
    /// Where the radius is not certainly above zero.
    pub fn new(centre: Point<S>, normal: Direction<S>, radius: S) -> Result<Self, GeometryError> {
        Ok(Self {
            plane: Plane::new(centre, normal),
            radius: above_zero(radius, "a radius above 0 for a circle")?,
        })
    }

    /// Its plane, made from its centre.
    #[must_use]
    pub fn plane(&self) -> &Plane<S> {
        &self.plane
    }

    /// Its centre.
    #[must_use]
    pub fn centre(&self) -> &Point<S> {
        self.plane.point()
    }

    /// The line through its centre across its plane.
    #[must_use]
    pub fn axis(&self) -> Line<S> {
        Line::new(self.centre().clone(), self.plane.normal().clone())
    }

    /// Its radius.
    #[must_use]
    pub fn radius(&self) -> &S {
        &self.radius
    }

    /// The same circle in another place.
    pub(crate) fn in_plane(&self, plane: Plane<S>) -> Self {
        Self {
            plane,
            radius: self.radius.clone(),
        }
    }
}

impl<S: Scalar> Cylinder<S> {
    /// The cylinder about an axis.
    ///
    /// # Errors
    /// Where the radius is not certainly above zero.
    pub fn new(axis: Line<S>, radius: S) -> Result<Self, GeometryError> {
        Ok(Self {
            axis,
            radius: above_zero(radius, "a radius above 0 for a cylinder")?,
        })
    }

    /// Its axis.
    #[must_use]
    pub fn axis(&self) -> &Line<S> {
        &self.axis
    }

    /// Its radius.
    #[must_use]
    pub fn radius(&self) -> &S {
        &self.radius
    }

    /// The same cylinder in another place.
    pub(crate) fn about(&self, axis: Line<S>) -> Self {
        Self {
            axis,
            radius: self.radius.clone(),
        }
    }
}

impl<S: Scalar> Cone<S> {
    /// The cone that opens from an apex along a direction, by the tangent of the angle between its axis and its side: its
    /// radius at distance 1 from the apex.
    ///
    /// # Errors
    /// Where the tangent is not certainly above zero.
    pub fn new(apex: Point<S>, along: Direction<S>, tangent: S) -> Result<Self, GeometryError> {
        Ok(Self {
            axis: Line::new(apex, along),
            tangent: above_zero(tangent, "a tangent above 0 for the half angle of a cone")?,
        })
    }

    /// Its apex.
    #[must_use]
    pub fn apex(&self) -> &Point<S> {
        self.axis.point()
    }

    /// Its axis, made from its apex, in the sense in which it opens.
    #[must_use]
    pub fn axis(&self) -> &Line<S> {
        &self.axis
    }

    /// The tangent of the angle between its axis and its side.
    #[must_use]
    pub fn tangent(&self) -> &S {
        &self.tangent
    }

    /// The same cone in another place.
    pub(crate) fn about(&self, axis: Line<S>) -> Self {
        Self {
            axis,
            tangent: self.tangent.clone(),
        }
    }
}

impl<S: Scalar> Sphere<S> {
    /// The sphere about a centre.
    ///
    /// # Errors
    /// Where the radius is not certainly above zero.
    pub fn new(centre: Point<S>, radius: S) -> Result<Self, GeometryError> {
        Ok(Self {
            centre,
            radius: above_zero(radius, "a radius above 0 for a sphere")?,
        })
    }

    /// Its centre.
    #[must_use]
    pub fn centre(&self) -> &Point<S> {
        &self.centre
    }

    /// Its radius.
    #[must_use]
    pub fn radius(&self) -> &S {
        &self.radius
    }

    /// The same sphere in another place.
    pub(crate) fn about(&self, centre: Point<S>) -> Self {
        Self {
            centre,
            radius: self.radius.clone(),
        }
    }
}
