//! Branches through singular poses, found by brute force: thousands of random starts, and nothing else.
//!
//! The analysis expands the closure equations at a singular pose, reduces them to a few polynomials and finds the real zeros
//! of those. Here the same question is put without any expansion: on a small sphere around the pose, in the space of all joint
//! values, points are sought that close all loops, from random directions of the kernel by damped Gauss–Newton steps.
//!
//! Branches of dimension 1 meet the sphere in isolated points, one for every way out of the pose (half-branch); branches of
//! higher dimension in a continuum, which many starts fill with many different points; an isolated pose in none. Radii half
//! as large must give the same.

use crate::support;

use kutzbach::closure::{Arithmetic, Geometry, JointState, Part, jacobian};
use kutzbach::families::{flat_change_point, flattening_parallelogram, negative_power_of_ten};
use kutzbach::matrix::{SplitMix64, null_basis};
use kutzbach::mechanism::{JointKind, Mechanism};
use kutzbach::mobility::{Analysis, PoseKind};
use kutzbach::number::Number;
use nalgebra::{DMatrix, DVector};
use support::{analysis, assert_none, at_least, in_parallel, own_mechanisms, zoo};

/// Radii of the spheres, in radians and part lengths.
///
/// Not smaller: Watt's linkage in a slot leaves its line with the fifth power of the way, which at 0.03 is hardly more than
/// an iteration may leave over.
const RADII: [f64; 2] = [0.12, 0.06];

/// Largest residual (rad, loop lengths) of a point that closes all loops. Where the equations vanish twice, at permanently
/// shaky branches, steps become short before it is rounding.
const CLOSED: f64 = 1e-11;

/// Points of the sphere closer than this, in radii, are one.
const APART: f64 = 1e-3;

/// A point of a continuum has more other points than `FEW` within `NEAR` radii; two cusps or two branches that touch have
/// fewer.
const NEAR: f64 = 0.3;
const FEW: usize = 4;

const SEED: u64 = 7;

/// Joints whose values are coordinates: turning and sliding one after the other, whatever the path.
fn has_coordinates(kind: JointKind) -> bool {
    matches!(
        kind,
        JointKind::Revolute
            | JointKind::Prismatic
            | JointKind::Screw
            | JointKind::Cylindrical
            | JointKind::Universal
            | JointKind::Fixed
    )
}

/// The closure equations of a mechanism of one part.
struct Equations<'a> {
    mechanism: &'a Mechanism,
    geometry: Geometry<f64>,
    part: &'a Part,
    /// Radians or metres per unit of each unknown.
    units: Vec<f64>,
}

impl Equations<'_> {
    fn states(&self, point: &DVector<f64>) -> Vec<JointState<f64>> {
        let mut states = self.geometry.states.clone();
        let mut column = 0;
        for &joint in &self.part.joints {
            let displacement = &self.geometry.displacements[joint];
            let values: Vec<f64> = (column..column + displacement.freedom())
                .map(|c| point[c] * self.units[c])
                .collect();
            displacement.advance(&mut states[joint], &values);
            column += values.len();
        }
        states
    }

    /// Residual and derivative.
    fn at(&self, point: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let here = jacobian(
            self.mechanism,
            &self.geometry,
            &self.states(point),
            self.part,
        )
        .unwrap();
        let mut matrix = DMatrix::zeros(here.matrix.rows(), here.matrix.columns());
        for (row, column, value) in here.matrix.triplets() {
            matrix[(row, column)] = value * self.units[column] / here.unit(self.mechanism, column);
        }
        (DVector::from_vec(here.residual), matrix)
    }

    /// A point of the sphere that closes all loops, near the one given.
    fn on_sphere(&self, start: &DVector<f64>, radius: f64) -> Option<DVector<f64>> {
        let mut point = start.clone();
        for _ in 0..60 {
            let (residual, matrix) = self.at(&point);
            let away = (point.norm_squared() - radius * radius) / (2.0 * radius);
            let size = residual.amax().max(away.abs());
            if size < 1e-13 {
                return Some(point);
            }
            let normal = &point / radius;
            let damping = (0.1 * size * size).max(1e-13);
            let mut square = matrix.tr_mul(&matrix) + &normal * normal.transpose();
            (0..square.nrows()).for_each(|i| square[(i, i)] += damping);
            let right = matrix.tr_mul(&residual) + &normal * away;
            point -= square.cholesky()?.solve(&right);
            if !(point.norm() < 3.0 * radius) {
                return None;
            }
        }
        let (residual, _) = self.at(&point);
        (residual.amax() < CLOSED && (point.norm() - radius).abs() < 1e-9).then_some(point)
    }
}

/// What the sphere shows.
#[derive(Debug, PartialEq)]
struct Seen {
    isolated: usize,
    continuum: bool,
}

fn look(equations: &Equations<'_>, kernel: &DMatrix<f64>, radius: f64) -> (Seen, usize) {
    let mut random = SplitMix64::new(SEED);
    let starts = match kernel.ncols() {
        1 => 20,
        2 => 200,
        _ => 800,
    };
    let mut points: Vec<DVector<f64>> = Vec::new();
    for _ in 0..starts {
        let direction = DVector::from_fn(kernel.ncols(), |_, _| {
            // A sum of uniform numbers: about the same density in all directions.
            (0..6).map(|_| random.symmetric()).sum::<f64>()
        });
        let start = kernel * direction.normalize() * radius;
        let Some(point) = equations.on_sphere(&start, radius) else {
            continue;
        };
        if points
            .iter()
            .all(|other| (other - &point).norm() > APART * radius)
        {
            points.push(point);
        }
    }
    // A point of a continuum has many neighbours.
    let neighbours = |point: &DVector<f64>| {
        let near = points
            .iter()
            .filter(|p| (*p - point).norm() < NEAR * radius);
        near.count() - 1
    };
    let isolated = points.iter().filter(|p| neighbours(p) <= FEW).count();
    let seen = Seen {
        isolated,
        continuum: isolated < points.len(),
    };
    (seen, starts)
}

/// What the report says of the same.
fn told(analysis: &Analysis) -> Option<Seen> {
    let branches = analysis.branches.as_ref()?;
    Some(Seen {
        isolated: branches.iter().filter_map(|b| b.half_branches).sum(),
        continuum: branches.iter().any(|b| b.dimension > 1),
    })
}

/// Singular poses of one small part whose joint values are coordinates.
fn is_small(mechanism: &Mechanism, analysis: &Analysis) -> bool {
    let ([_], [rank]) = (&analysis.structure.parts[..], &analysis.parts[..]) else {
        return false;
    };
    let most = match rank.instantaneous {
        Some(1 | 2) => 12,
        Some(3) => 8,
        _ => 0,
    };
    analysis.mobility.pose != Some(PoseKind::Regular)
        && analysis.structure.free_joints.is_empty()
        && analysis.assembly.steps == 0
        && mechanism.joints().iter().all(|j| has_coordinates(j.kind))
        && rank.unknowns() <= most
}

/// What was looked at, and what is wrong about it.
struct Looked {
    starts: usize,
    told: Option<Seen>,
    wrong: Vec<String>,
}

fn compare(name: &str, mechanism: &Mechanism) -> Option<Looked> {
    if mechanism.freedom() > 12 {
        return None;
    }
    let analysis = analysis(mechanism);
    if !is_small(mechanism, &analysis) {
        return None;
    }
    let (part, rank) = (&analysis.structure.parts[0], &analysis.parts[0]);
    let kernel = null_basis(&rank.matrix, &rank.settled().unwrap()).unwrap();
    let unit = |c: usize| rank.jacobian.unit(mechanism, c) / rank.column_scales[c];
    let equations = Equations {
        mechanism,
        geometry: Geometry::new(mechanism, None, &Arithmetic::double()),
        part,
        units: (0..rank.unknowns()).map(unit).collect(),
    };
    let told = told(&analysis);
    let (mut wrong, mut all) = (Vec::new(), 0);
    for radius in RADII {
        let (seen, starts) = look(&equations, &kernel.to_matrix(), radius);
        all += starts;
        if Some(&seen) != told.as_ref() {
            wrong.push(format!(
                "{name}: told {told:?}, at radius {radius} there is {seen:?}"
            ));
        }
    }
    Some(Looked {
        starts: all,
        told,
        wrong,
    })
}

fn looked_at(mechanisms: &[(String, Mechanism)]) -> Vec<Looked> {
    let found = in_parallel(mechanisms, |(name, mechanism)| compare(name, mechanism));
    found.into_iter().flatten().collect()
}

/// The limits of the continuous families, and flat four-bars that are close to other flat four-bars.
#[test]
fn branches_of_flat_four_bars_are_those_of_a_blind_search() {
    let offsets = [1, 3, 6, 14].map(negative_power_of_ten);
    let mut all = vec![flattening_parallelogram(&Number::zero())];
    all.extend(offsets.iter().map(flat_change_point));
    let named: Vec<(String, Mechanism)> = all
        .into_iter()
        .map(|mechanism| mechanism.unwrap())
        .map(|mechanism| (mechanism.name().to_owned(), mechanism))
        .collect();
    let looked = looked_at(&named);
    assert_eq!(looked.len(), named.len());
    for found in looked {
        assert_none(&found.wrong);
        assert_eq!(found.told.unwrap().isolated, 4);
    }
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn branches_of_small_singular_poses_are_those_of_a_blind_search() {
        let all = support::sample(zoo().into_iter().chain(own_mechanisms()), 3);
        let looked = looked_at(&all);
        let wrong: Vec<String> = looked.iter().flat_map(|l| l.wrong.clone()).collect();
        assert_none(&wrong);
        // All sorts are among them.
        let count = |isolated: usize, continuum: bool| {
            let like = Some(Seen {
                isolated,
                continuum,
            });
            looked.iter().filter(|l| l.told == like).count()
        };
        let [alone, one, two, mixed] =
            [(0, false), (2, false), (4, false), (2, true)].map(|(i, c)| count(i, c));
        assert!(
            alone >= at_least(12)
                && one >= at_least(7)
                && two >= at_least(17)
                && mixed >= at_least(3),
            "{alone} isolated, {one} with one branch, {two} with two, {mixed} with branches of other dimensions"
        );
        assert!(looked.iter().map(|l| l.starts).sum::<usize>() > at_least(10_000));
    }
}
