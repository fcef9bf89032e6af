//! What a joint asks of the poses of its two links, without variables of its own (Ruiz 1994, chapter 3): points on points,
//! on lines, in planes; directions along directions.
//!
//! A line on a line asks for parallel directions there, whichever way they point (2 equations); a hinge, a sleeve or a
//! plane of a mechanism knows its two sides, so that by default the directions have to be equal (3 equations, of degree one
//! in either pose). The unoriented form serves to compare with the published tables.

use super::element::Element;
use super::field::Field;
use super::model::{Axis, JointModel};
use super::poly::Poly;
use super::space::{
    Matrix, Polynomials, Pose, Vector, apply, dot, matrix, multiply, subtract, vector,
};
use kutzbach_model::mechanism::JointKind;

/// Collects the equations of one joint between two link poses.
pub(super) struct Implicit<'a> {
    pub(super) field: &'a Field,
    pub(super) model: &'a JointModel,
    pub(super) predecessor: &'a Pose<Poly>,
    pub(super) successor: &'a Pose<Poly>,
    pub(super) unoriented: bool,
}

impl JointModel {
    /// Whether what the joint asks for multiplies the poses of its two links: a direction of one by something of the other.
    pub(super) fn multiplies_poses(&self, unoriented: bool) -> bool {
        match self.kind {
            JointKind::Fixed | JointKind::Spherical | JointKind::Translational => false,
            JointKind::Revolute => unoriented,
            _ => true,
        }
    }
}

impl Implicit<'_> {
    fn ring(&self) -> Polynomials<'_> {
        Polynomials(self.field)
    }

    /// A direction of the predecessor's joint frame.
    fn first(&self, v: &Vector<Element>) -> Vector<Poly> {
        let v = self.model.in_predecessor(self.field, v);
        apply(
            &self.ring(),
            &self.predecessor.rotation,
            &vector(&self.ring(), &v),
        )
    }

    /// A direction of the successor's joint frame.
    fn second(&self, v: &Vector<Element>) -> Vector<Poly> {
        let v = self.model.in_successor(self.field, v);
        apply(
            &self.ring(),
            &self.successor.rotation,
            &vector(&self.ring(), &v),
        )
    }

    /// The origins of the two joint frames.
    fn points(&self) -> [Vector<Poly>; 2] {
        let ring = self.ring();
        [
            self.predecessor
                .image(&ring, &vector(&ring, &self.model.sides[0].translation)),
            self.successor
                .image(&ring, &vector(&ring, &self.model.sides[1].translation)),
        ]
    }

    /// From the predecessor's point to the successor's.
    fn between(&self) -> Vector<Poly> {
        let [first, second] = self.points();
        subtract(&self.ring(), &second, &first)
    }

    fn equal_rotations(&self) -> Vec<Poly> {
        let ring = self.ring();
        let parallel: Matrix<Poly> = matrix(&ring, &self.model.parallel(self.field));
        let turned = multiply(&ring, &self.predecessor.rotation, &parallel);
        let rows = turned.iter().zip(&self.successor.rotation);
        rows.flat_map(|(a, b)| subtract(&ring, a, b)).collect()
    }

    /// The axis in both links.
    fn equal_directions(&self, axis: &Axis) -> Vec<Poly> {
        if self.unoriented {
            return self.across(axis, &self.second(&axis.direction));
        }
        let (a, b) = (self.first(&axis.direction), self.second(&axis.direction));
        subtract(&self.ring(), &a, &b).into()
    }

    /// A vector has no part across an axis of the predecessor.
    fn across(&self, axis: &Axis, v: &Vector<Poly>) -> Vec<Poly> {
        axis.across
            .iter()
            .map(|e| self.product(&self.first(&e.direction), v))
            .collect()
    }

    fn product(&self, a: &Vector<Poly>, b: &Vector<Poly>) -> Poly {
        dot(&self.ring(), a, b)
    }

    /// The component of the way between the points along a direction of the predecessor; its own point gives a constant.
    fn way_along_first(&self, direction: &Vector<Element>) -> Poly {
        let ring = self.ring();
        let [_, second] = self.points();
        let off = subtract(&ring, &second, &self.predecessor.translation);
        let own = dot(
            self.field,
            &self.model.sides[0].translation,
            &self.model.in_predecessor(self.field, direction),
        );
        self.product(&self.first(direction), &off)
            .minus(&Poly::constant(own))
    }

    /// The component of the way between the points along a direction of the successor.
    fn way_along_second(&self, direction: &Vector<Element>) -> Poly {
        let ring = self.ring();
        let [first, _] = self.points();
        let off = subtract(&ring, &self.successor.translation, &first);
        let own = dot(
            self.field,
            &self.model.sides[1].translation,
            &self.model.in_successor(self.field, direction),
        );
        self.product(&self.second(direction), &off)
            .plus(&Poly::constant(own))
    }

    fn on_line(&self, axis: &Axis) -> Vec<Poly> {
        axis.across
            .iter()
            .map(|e| self.way_along_first(&e.direction))
            .collect()
    }

    /// The equations. Screws are relaxed: a screw asks for what a sleeve asks for, one in a plane for parallel axes.
    pub(super) fn equations(&self) -> Vec<Poly> {
        let model = self.model;
        let mut all = Vec::new();
        match (model.kind, &model.axis, &model.axis2) {
            (JointKind::Fixed, ..) => {
                all.extend(self.equal_rotations());
                all.extend(self.between());
            }
            (JointKind::Revolute, Some(a), _) => {
                all.extend(self.equal_directions(a));
                all.extend(self.between());
            }
            (JointKind::Prismatic, Some(a), _) => {
                all.extend(self.equal_rotations());
                all.extend(self.on_line(a));
            }
            (JointKind::Screw | JointKind::Cylindrical, Some(a), _) => {
                all.extend(self.equal_directions(a));
                all.extend(self.on_line(a));
            }
            (JointKind::Universal, Some(a), Some(b)) => {
                all.extend(self.between());
                if model.skew.is_none() {
                    // Parallel axes make one hinge of the two.
                    all.extend(self.equal_directions(a));
                    return all;
                }
                let angle = dot(self.field, &a.direction, &b.direction);
                let (a, b) = (self.first(&a.direction), self.second(&b.direction));
                all.push(self.product(&a, &b).minus(&Poly::constant(angle)));
            }
            (JointKind::PlanarTranslation, Some(a), _) => {
                all.extend(self.equal_rotations());
                all.push(self.way_along_first(&a.direction));
            }
            (JointKind::Planar, Some(a), _) => {
                all.extend(self.equal_directions(a));
                all.push(self.way_along_first(&a.direction));
            }
            (JointKind::Spherical, ..) => all.extend(self.between()),
            (JointKind::Translational, ..) => all.extend(self.equal_rotations()),
            (JointKind::TranslatingScrew | JointKind::Schoenflies, Some(a), _) => {
                all.extend(self.equal_directions(a));
            }
            (JointKind::PointOnLine, _, Some(b)) => {
                all.extend(b.across.iter().map(|e| self.way_along_second(&e.direction)));
            }
            (JointKind::LineOnPlane, Some(a), Some(b)) => {
                let (line, normal) = (self.first(&a.direction), self.second(&b.direction));
                all.push(self.product(&line, &normal));
                all.push(self.way_along_second(&b.direction));
            }
            (JointKind::PointOnPlane, _, Some(b)) => all.push(self.way_along_second(&b.direction)),
            (JointKind::Distance, ..) => {
                let way = self.between();
                let square = model.distance_square.clone().unwrap_or_default();
                all.push(self.product(&way, &way).minus(&Poly::constant(square)));
            }
            _ => {}
        }
        all
    }
}
