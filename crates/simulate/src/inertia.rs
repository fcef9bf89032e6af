//! Mass properties of links and of intermediate bodies.

use super::convert::frame;
use super::options::Note;
use super::solids::solid;
use kutzbach_closure::{Geometry, Rigid};
use kutzbach_model::mechanism::{Inertial, Link, Mechanism};
use nalgebra::{Matrix3, Vector3};
use rapier3d_f64::prelude::{MassProperties, Matrix, Vector};

/// Density of links whose mass no one states (kg/m³): water's. A kinematic drive does not feel it.
const DENSITY: f64 = 1000.0;

/// Radius of the rods that stand for a link without shapes, in characteristic lengths. Thick enough that the moment of
/// inertia about a rod's own axis, (r/l)² times 6 of the one across it, is no smaller than a hundredth of it for rods as
/// long as the characteristic length; the solver's convergence suffers from larger ratios.
const ROD_RADIUS: f64 = 0.04;

/// Radius of the ball in the middle of the rods, in characteristic lengths; makes a body of links with one joint.
const BALL_RADIUS: f64 = 0.08;

/// Mass and moments of an intermediate body in those of the lighter of the two links that it connects.
///
/// As an inertia that is not in the file it should be small; but impulses reach a heavy link through a light body only by
/// many small corrections. Measured on a universal joint between the ground and a brick pushed off its centre (four and
/// sixteen substeps of 1/4 ms, impulses; how much of the push still moves it across its locked axis): ratio 1/1000: 0.3 and
/// 0.08; 1/20: 0.2 and 0.04; 1/5: 0.04 and 2e-5; 1/2: 2e-3 and 2e-6. Held by reduced coordinates the ratio does not matter
/// unless a loop closes through the body; three UPU legs want a tenth or more.
pub(super) const INTERMEDIATE_RATIO: f64 = 0.2;

/// Mass, centre of mass in the link frame, and moments of inertia about it along the link's axes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Mass {
    /// kg.
    pub mass: f64,
    /// m.
    pub centre: [f64; 3],
    /// kg m².
    pub inertia: Matrix3<f64>,
}

impl Mass {
    /// For the engine, whose bodies have their origin in the centre of mass here.
    pub fn properties(&self) -> MassProperties {
        let i = &self.inertia;
        let column = |j: usize| Vector::new(i[(0, j)], i[(1, j)], i[(2, j)]);
        MassProperties::with_inertia_matrix(
            Vector::ZERO,
            self.mass,
            Matrix::from_cols(column(0), column(1), column(2)),
        )
    }

    pub(super) fn least_moment(&self) -> f64 {
        self.inertia.symmetric_eigenvalues().min()
    }

    /// Positive and finite, its square root and inverse too; moments positive definite.
    fn usable(&self) -> bool {
        let in_range = |x: f64| x > 1e-100 && x < 1e100;
        in_range(self.mass)
            && self.centre.iter().all(|x| x.abs() < 1e100)
            && self.inertia.iter().all(|x| x.abs() < 1e100)
            && in_range(self.least_moment())
            && self.least_moment() > 1e-12 * self.inertia.symmetric_eigenvalues().max()
    }

    fn of_properties(properties: &MassProperties) -> Self {
        let matrix = properties.reconstruct_inertia_matrix();
        let columns = [matrix.x_axis, matrix.y_axis, matrix.z_axis];
        let c = properties.local_com;
        Self {
            mass: properties.mass(),
            centre: [c.x, c.y, c.z],
            inertia: Matrix3::from_fn(|i, j| columns[j][i]),
        }
    }
}

/// The mass properties of every link but the ground, whose own do not matter: stated, of shapes, or of rods between joints.
pub(super) fn of_links(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    length: f64,
    notes: &mut Vec<Note>,
) -> Vec<Option<Mass>> {
    let points = joint_points(mechanism, geometry);
    let links = mechanism.links().iter().zip(&points).enumerate();
    links
        .map(|(index, (link, points))| {
            (index != mechanism.ground().0).then(|| of_link(link, points, length, notes))
        })
        .collect()
}

/// Where the joints of every link are, in its frame (m).
fn joint_points(mechanism: &Mechanism, geometry: &Geometry<f64>) -> Vec<Vec<[f64; 3]>> {
    let mut points = vec![Vec::new(); mechanism.links().len()];
    for (joint, sides) in mechanism.joints().iter().zip(&geometry.sides) {
        points[joint.predecessor.link.0].push(sides[0].translation);
        points[joint.successor.link.0].push(sides[1].translation);
    }
    points
}

/// Radius of gyration of links that are all alike, in characteristic lengths: that of a ball or a bar of about this size.
const ALIKE_RADIUS: f64 = 0.3;

/// One kilogram in the middle of every link's joints, with the same moment about every axis.
pub(super) fn alike(
    mechanism: &Mechanism,
    geometry: &Geometry<f64>,
    length: f64,
) -> Vec<Option<Mass>> {
    let radius = ALIKE_RADIUS * length;
    joint_points(mechanism, geometry)
        .iter()
        .enumerate()
        .map(|(link, points)| {
            (link != mechanism.ground().0).then(|| Mass {
                mass: 1.0,
                centre: middle(points).into(),
                inertia: Matrix3::identity() * (radius * radius),
            })
        })
        .collect()
}

/// The centroid of points; the origin where there are none.
fn middle(points: &[[f64; 3]]) -> Vector3<f64> {
    let sum: Vector3<f64> = points.iter().map(|p| Vector3::from(*p)).sum();
    sum / points.len().max(1) as f64
}

fn of_link(link: &Link, points: &[[f64; 3]], length: f64, notes: &mut Vec<Note>) -> Mass {
    let mut note = |text: &str| {
        notes.push(Note {
            about: link.name.clone(),
            text: text.to_owned(),
        });
    };
    if let Some(inertial) = &link.inertial {
        let stated = stated(inertial);
        if stated.usable() {
            return stated;
        }
        note(
            "the stated mass or inertia is not positive, or not one to compute with; it is derived instead",
        );
    }
    for (shapes, what) in [(&link.collisions, "collision"), (&link.visuals, "visual")] {
        if let Some(mass) = of_shapes(shapes) {
            note(&format!(
                "mass and inertia derived from its {what} shapes at {DENSITY} kg/m³"
            ));
            return mass;
        }
    }
    note(&format!(
        "mass and inertia derived from rods between its joints at {DENSITY} kg/m³"
    ));
    of_rods(points, length)
}

fn stated(inertial: &Inertial) -> Mass {
    let placed = frame(&inertial.origin);
    let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5].map(|i| inertial.inertia[i].value());
    let turn = Matrix3::from_fn(|i, j| placed.rotation[i][j]);
    let along = Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz);
    Mass {
        mass: inertial.mass.value(),
        centre: placed.translation,
        inertia: turn * along * turn.transpose(),
    }
}

fn of_shapes(shapes: &[kutzbach_model::mechanism::Shape]) -> Option<Mass> {
    let mut total: Option<MassProperties> = None;
    for shape in shapes {
        let Some((placed, solid)) = solid(shape, 1.0) else {
            continue;
        };
        let part = solid.mass_properties(DENSITY).transform_by(&placed);
        total = Some(match total {
            Some(sum) => sum + part,
            None => part,
        });
    }
    let mass = Mass::of_properties(&total?);
    mass.usable().then_some(mass)
}

/// A ball in the centroid of the joints and a round rod from there to every joint.
fn of_rods(points: &[[f64; 3]], length: f64) -> Mass {
    let middle = middle(points);
    let points: Vec<Vector3<f64>> = points.iter().map(|p| Vector3::from(*p)).collect();
    let ball_radius = BALL_RADIUS * length;
    let rod_radius = ROD_RADIUS * length;
    let ball = DENSITY * 4.0 / 3.0 * std::f64::consts::PI * ball_radius.powi(3);
    // (mass, its centre, moments about that centre)
    let mut parts = vec![(
        ball,
        middle,
        Matrix3::identity() * (0.4 * ball * ball_radius * ball_radius),
    )];
    for point in &points {
        let span = point - middle;
        let long = span.norm();
        if long > 1e-9 * length {
            let mass = DENSITY * std::f64::consts::PI * rod_radius * rod_radius * long;
            let axis = span / long;
            let own = 0.5 * mass * rod_radius * rod_radius;
            let across = 0.5 * own + mass * long * long / 12.0;
            let onto = axis * axis.transpose();
            let inertia = onto * own + (Matrix3::identity() - onto) * across;
            parts.push((mass, middle + span * 0.5, inertia));
        }
    }
    let mass: f64 = parts.iter().map(|part| part.0).sum();
    let centre = parts
        .iter()
        .map(|part| part.1 * part.0)
        .sum::<Vector3<f64>>()
        / mass;
    let inertia = parts
        .iter()
        .map(|(mass, at, inertia)| {
            let arm = at - centre;
            inertia + (Matrix3::identity() * arm.dot(&arm) - arm * arm.transpose()) * *mass
        })
        .sum();
    Mass {
        mass,
        centre: centre.into(),
        inertia,
    }
}

/// An intermediate body between two links, of which one may be the ground; equal moments about all axes, so that its spin
/// stirs nothing.
pub(super) fn intermediate(neighbours: [Option<&Mass>; 2], rod: f64) -> Mass {
    let of = |value: fn(&Mass) -> f64| {
        let least = neighbours
            .iter()
            .flatten()
            .map(|mass| value(mass))
            .fold(f64::INFINITY, f64::min);
        INTERMEDIATE_RATIO * if least.is_finite() { least } else { 1.0 }
    };
    let mass = of(|m| m.mass);
    let moment = of(Mass::least_moment).max(mass * rod * rod / 12.0);
    Mass {
        mass,
        centre: [0.0; 3],
        inertia: Matrix3::identity() * moment,
    }
}

/// `link_from_body`: the body's origin is the centre of mass, its axes are the link's.
pub(super) fn offset(mass: Option<&Mass>) -> Rigid<f64> {
    Rigid::translation(mass.map_or([0.0; 3], |m| m.centre))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rod_between_two_joints_is_a_rod() {
        // Two joints 2 m apart, far in units of the characteristic length: ball and radius hardly count.
        let mass = of_rods(&[[0.0, 0.0, 1.0], [2.0, 0.0, 1.0]], 1e-3);
        assert!((mass.centre[0] - 1.0).abs() < 1e-12 && (mass.centre[2] - 1.0).abs() < 1e-12);
        let wanted = mass.mass * 4.0 / 12.0;
        assert!((mass.inertia[(1, 1)] / wanted - 1.0).abs() < 1e-3);
        assert!((mass.inertia[(2, 2)] / wanted - 1.0).abs() < 1e-3);
        assert!(mass.usable());
    }

    #[test]
    fn links_with_one_joint_or_none_have_a_body_too() {
        for points in [&[][..], &[[1.0, 2.0, 3.0]], &[[1.0, 2.0, 3.0]; 4]] {
            let mass = of_rods(points, 1.0);
            assert!(mass.usable(), "{points:?}");
        }
    }

    #[test]
    fn masses_that_cannot_be_computed_with_are_not_used() {
        let round = |mass: f64, moment: f64| Mass {
            mass,
            centre: [0.0; 3],
            inertia: Matrix3::identity() * moment,
        };
        assert!(round(1.0, 0.1).usable());
        for (mass, moment) in [
            (0.0, 1.0),
            (1.0, 0.0),
            (f64::NAN, 1.0),
            (1.0, f64::INFINITY),
            (1.0, -1.0),
        ] {
            assert!(!round(mass, moment).usable(), "{mass} {moment}");
        }
    }

    #[test]
    fn an_intermediate_body_is_lighter_than_both_links() {
        let heavy = of_rods(&[[0.0; 3], [1.0, 0.0, 0.0]], 1.0);
        let light = of_rods(&[[0.0; 3]], 0.5);
        let small = intermediate([Some(&heavy), Some(&light)], 0.0);
        assert!(small.mass < light.mass && small.least_moment() < light.least_moment());
        assert!(intermediate([None, None], 0.0).usable());
        assert!(intermediate([Some(&heavy), None], 2.0).usable());
    }
}
