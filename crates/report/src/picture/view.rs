//! From which side to look at a mechanism.
//!
//! # What is wanted
//! A stranger should see what it is. A planar mechanism is a drawing in its plane: it is looked at nearly along the
//! plane's normal, tilted by so much that pins have depth. A spatial one is looked at from the side where its joints
//! spread most, from above, with the world's z axis upward.
//!
//! # How
//! Whether all axes of rotation are parallel, or all joints lie in a plane, is read from sums over joints. For a spatial
//! mechanism the eye is tried at some hundred places of the upper half of a sphere. The area that the joints cover from
//! there is √(tᵀ adj(C) t) for the direction t and the covariance C of the joints' places; multiplied with how well pairs
//! of joints stay apart and with a slight preference for the usual view (from the front, a little from the right and from
//! above), it has one greatest value also where the mechanism is symmetric. So neither the order of joints nor the
//! unit of length decides anything.

use super::vector::{Vector, cross, difference, dot, is_finite, norm, sum, times, unit};
use kutzbach_closure::{JointDisplacement, Rigid};
use kutzbach_model::mechanism::JointKind;
use kutzbach_scene::{Drawing, Part};

/// Where the eye is, and which way is up: unit vectors in the world frame, at right angles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From the mechanism towards the eye.
    pub toward: Vector,
    /// Upward on the page.
    pub up: Vector,
}

/// The usual view: the x axis to the right and somewhat towards the eye, y away from it, z up.
const USUAL: Vector = [0.52, -0.72, 0.46];
/// Tilt of the eye against the normal of a planar mechanism (rad), to the side and up or down.
const TILT: [f64; 2] = [0.16, 0.40];
/// Where axes are not along the normal there is more to be seen from the side.
const TILT_ACROSS: [f64; 2] = [0.35, 0.62];
/// Rotation axes whose directions scatter by less than this are parallel. Files with few digits have axes a
/// thousandth off.
const PARALLEL: f64 = 3e-3;
/// Joints are in a plane where they leave it by less than this part of their spread.
const FLAT: f64 = 0.02;
/// Parallel axes make a planar drawing as long as the parts do not lie farther apart along the axes than this part of
/// their spread across.
const DEEP: f64 = 0.45;
/// Pairs of joints are compared up to this many joints.
const PAIRED_JOINTS: usize = 400;

impl View {
    /// The view of a mechanism: `drawing` and `displacements` are its shapes and what its joints allow, `links` a
    /// pose (`world_from_link`), usually home. Poses that are not finite are left out; without any joint, the usual view.
    #[must_use]
    pub fn of(
        drawing: &Drawing,
        displacements: &[JointDisplacement<f64>],
        links: &[Rigid<f64>],
    ) -> Self {
        let mut points = Vec::new();
        let mut axes = Vec::new();
        let mut spatial = false;
        let mut seen: Vec<Option<Vector>> = vec![None; displacements.len()];
        for shape in &drawing.shapes {
            let (Some(link), Part::Joint(joint)) = (links.get(shape.link), shape.part) else {
                continue;
            };
            let Some(displacement) = displacements.get(joint) else {
                continue;
            };
            let point = link.apply(&shape.pose.translation);
            // The two sides of a joint may be far from each other, as the balls of a rod.
            let first = match &mut seen[joint] {
                Some(at) if norm(difference(point, *at)) > 1e-6 * drawing.extent => {
                    points.push(point);
                    continue;
                }
                Some(_) => continue,
                unseen => unseen,
            };
            *first = Some(point);
            points.push(point);
            match displacement.kind() {
                JointKind::Fixed
                | JointKind::Prismatic
                | JointKind::PlanarTranslation
                | JointKind::Translational => {}
                // The symbol's z axis is the axis of rotation, or the normal of its plane.
                JointKind::Revolute
                | JointKind::Screw
                | JointKind::Cylindrical
                | JointKind::Planar
                | JointKind::TranslatingScrew
                | JointKind::Schoenflies => {
                    axes.push(link.rotate(&shape.pose.rotate(&[0.0, 0.0, 1.0])));
                }
                _ => spatial = true,
            }
        }
        if spatial {
            axes.clear();
        }
        Self::through(&points, &axes)
    }

    /// The view of joints at given places (any unit of length). `axes`: directions of all rotations where each joint has at
    /// most one, otherwise nothing.
    #[must_use]
    pub fn through(points: &[Vector], axes: &[Vector]) -> Self {
        let points: Vec<Vector> = points.iter().copied().filter(|p| is_finite(*p)).collect();
        let axes: Vec<Vector> = axes.iter().filter_map(|axis| unit(*axis)).collect();
        let cloud = Cloud::new(&points);
        let parallel = common_direction(&axes);
        if let Some(normal) = parallel {
            let along = cloud.spread_along(normal);
            if along <= DEEP * cloud.spread || cloud.spread == 0.0 {
                return tilted(normal, TILT);
            }
        }
        if let Some(normal) = cloud.normal() {
            return tilted(normal, TILT_ACROSS);
        }
        from_above(&cloud)
    }

    /// The direction to the right on the page: `up × toward`.
    #[must_use]
    pub fn right(&self) -> Vector {
        cross(self.up, self.toward)
    }

    /// Right, up and depth towards the eye of a point, seen from infinitely far.
    #[must_use]
    pub fn project(&self, point: Vector) -> Vector {
        [
            dot(self.right(), point),
            dot(self.up, point),
            dot(self.toward, point),
        ]
    }

    /// Looking from `toward` with `up` made to be at right angles to it.
    fn looking(toward: Vector, up: Vector) -> Self {
        let toward = unit(toward).unwrap_or([0.0, 0.0, 1.0]);
        let level = difference(up, times(toward, dot(toward, up)));
        let up = unit(level).unwrap_or_else(|| kutzbach_closure::across(&toward).0);
        Self { toward, up }
    }
}

/// The direction that all unit vectors have up to sign, with the sign that suits the eye; `None` where they differ or
/// there is none.
fn common_direction(axes: &[Vector]) -> Option<Vector> {
    // One of them serves as reference for the signs; each as well as the other, since all are parallel if any answer
    // is given.
    let first = *axes.first()?;
    let total = axes.iter().fold([0.0; 3], |total, axis| {
        let sign = if dot(first, *axis) < 0.0 { -1.0 } else { 1.0 };
        sum(total, times(*axis, sign))
    });
    let mean = unit(total)?;
    let off = |axis: &Vector| norm(cross(mean, *axis)) > PARALLEL;
    (!axes.iter().any(off)).then(|| facing(mean))
}

/// The normal with the sign that points to the eye: up where it is steep, otherwise to the usual side.
pub(super) fn facing(normal: Vector) -> Vector {
    let side = if normal[2].abs() > 0.5 {
        normal[2]
    } else {
        dot(normal, [0.35, -0.9, 0.2])
    };
    if side < 0.0 {
        times(normal, -1.0)
    } else {
        normal
    }
}

/// Nearly along a normal: from the right and, where the plane stands upright, from above; where it lies, from the front.
fn tilted(normal: Vector, [aside, ahead]: [f64; 2]) -> View {
    let lies = normal[2].abs() > 0.8;
    let reference = if lies {
        [0.0, 1.0, 0.0]
    } else {
        [0.0, 0.0, 1.0]
    };
    let flat = View::looking(normal, reference);
    let ahead = if lies { -ahead } else { 0.6 * ahead };
    let toward = sum(
        normal,
        sum(
            times(flat.right(), aside.tan()),
            times(flat.up, ahead.tan()),
        ),
    );
    View::looking(toward, reference)
}

/// How points are spread.
struct Cloud<'a> {
    points: &'a [Vector],
    /// Of the unit-free coordinates, about the centroid: Σ (p − c)(p − c)ᵀ / n.
    covariance: [Vector; 3],
    /// Root mean square distance from the centroid, in the unit of the coordinates.
    spread: f64,
}

impl<'a> Cloud<'a> {
    fn new(points: &'a [Vector]) -> Self {
        let mut cloud = Self {
            points,
            covariance: [[0.0; 3]; 3],
            spread: 0.0,
        };
        if points.is_empty() {
            return cloud;
        }
        let share = 1.0 / points.len() as f64;
        let centre = points
            .iter()
            .fold([0.0; 3], |total, p| sum(total, times(*p, share)));
        let reach = points
            .iter()
            .map(|p| norm(difference(*p, centre)))
            .fold(0.0, f64::max);
        // Rounding of coordinates is no spread.
        if !(reach > 1e-12 * norm(centre) && reach.is_finite()) {
            return cloud;
        }
        let mut sum_of_squares = 0.0;
        for point in points {
            let d = times(difference(*point, centre), 1.0 / reach);
            sum_of_squares += share * dot(d, d);
            for i in 0..3 {
                for j in 0..3 {
                    cloud.covariance[i][j] += share * d[i] * d[j];
                }
            }
        }
        // In units of the spread itself.
        for entry in cloud.covariance.iter_mut().flatten() {
            *entry /= sum_of_squares;
        }
        cloud.spread = sum_of_squares.sqrt() * reach;
        cloud
    }

    /// Root mean square distance from the centroid along a direction.
    fn spread_along(&self, direction: Vector) -> f64 {
        let c = self.covariance.map(|row| dot(row, direction));
        dot(direction, c).max(0.0).sqrt() * self.spread
    }

    /// The adjugate of the covariance: what is left of it across a direction t is tᵀ adj(C) t.
    fn adjugate(&self) -> [Vector; 3] {
        let [a, b, c] = self.covariance;
        [cross(b, c), cross(c, a), cross(a, b)]
    }

    /// The normal of the plane that all points lie in; `None` where there is none, or more than one.
    fn normal(&self) -> Option<Vector> {
        if self.spread == 0.0 {
            return None;
        }
        // For points in a plane with normal n the adjugate is λ₂λ₃ n nᵀ: any of its columns that has a length is n.
        let adjugate = self.adjugate();
        let trace = adjugate[0][0] + adjugate[1][1] + adjugate[2][2];
        // Points on a line: λ₂λ₃ vanishes too.
        if !(trace > FLAT * FLAT) {
            return None;
        }
        let longest = [0, 1, 2]
            .into_iter()
            .reduce(|best, i| {
                // Room for rounding, so that equals are decided by their index.
                let more = adjugate[i][i] > adjugate[best][best] * (1.0 + 1e-9);
                if more { i } else { best }
            })
            .unwrap_or(0);
        let normal = unit(adjugate[longest])?;
        (self.spread_along(normal) <= FLAT * self.spread).then(|| facing(normal))
    }

    /// The share of pairs of points that are seen apart, from 0 to 1.
    fn apart(&self, toward: Vector) -> f64 {
        if self.spread == 0.0 || self.points.len() > PAIRED_JOINTS {
            return 1.0;
        }
        let (mut pairs, mut apart) = (0.0, 0.0);
        for (index, a) in self.points.iter().enumerate() {
            for b in &self.points[..index] {
                let d = times(difference(*a, *b), 1.0 / self.spread);
                let length = norm(d);
                // Points that are one from everywhere say nothing.
                if length > 0.02 {
                    pairs += 1.0;
                    apart += (norm(cross(toward, d)) / 0.25).min(1.0);
                }
            }
        }
        if pairs > 0.0 { apart / pairs } else { 1.0 }
    }
}

/// The best of many places of the eye on the upper half of a sphere.
fn from_above(cloud: &Cloud<'_>) -> View {
    /// Heights of the eye above the horizon (rad).
    const HEIGHTS: [f64; 4] = [0.36, 0.47, 0.58, 0.70];
    const AROUND: u32 = 36;
    let usual = unit(USUAL).unwrap_or(USUAL);
    let up = [0.0, 0.0, 1.0];
    if cloud.spread == 0.0 {
        return View::looking(usual, up);
    }
    let adjugate = cloud.adjugate();
    let mut best = (f64::NEG_INFINITY, usual);
    for height in HEIGHTS {
        for step in 0..AROUND {
            let turn = std::f64::consts::TAU * f64::from(step) / f64::from(AROUND);
            let (sine, cosine) = turn.sin_cos();
            let toward = [height.cos() * cosine, height.cos() * sine, height.sin()];
            let area = dot(toward, adjugate.map(|row| dot(row, toward)))
                .max(0.0)
                .sqrt();
            let apart = cloud.apart(toward);
            let liking = 0.5 + 0.5 * dot(toward, usual);
            // Points on a line cover no area from anywhere.
            let value = (area + 0.02).sqrt() * apart * liking;
            // Equal up to rounding is equal.
            if value > best.0 * (1.0 + 1e-9) || best.0 < 0.0 {
                best = (value, toward);
            }
        }
    }
    View::looking(best.1, up)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn close(a: View, b: View) -> bool {
        norm(difference(a.toward, b.toward)) < 1e-6 && norm(difference(a.up, b.up)) < 1e-6
    }

    fn is_frame(view: View) -> bool {
        (norm(view.toward) - 1.0).abs() < 1e-12
            && (norm(view.up) - 1.0).abs() < 1e-12
            && dot(view.toward, view.up).abs() < 1e-12
    }

    #[test]
    fn a_planar_mechanism_is_seen_along_its_normal() {
        let corners = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [4.0, 5.0, 0.0],
            [0.0, 2.0, 0.0],
        ];
        let lying = View::through(&corners, &[[0.0, 0.0, 1.0]; 4]);
        assert!(is_frame(lying) && lying.toward[2] > 0.85 && lying.toward[2] < 0.999);
        // x to the right, y upward, seen from the front.
        assert!(lying.right()[0] > 0.9 && lying.up[1] > 0.7 && lying.toward[1] < 0.0);
        // Axes written the other way round are the same axes.
        let turned = View::through(&corners, &[[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]]);
        assert!(close(lying, turned));
        // Upright in the x-z plane: z upward.
        let upright = corners.map(|[x, y, _]| [x, 0.0, y]);
        let view = View::through(&upright, &[[0.0, 1.0, 0.0]; 4]);
        assert!(view.toward[1] < -0.85 && view.up[2] > 0.9 && view.right()[0] > 0.9);
    }

    #[test]
    fn degenerate_places_have_a_view() {
        for points in [
            vec![],
            vec![[1.0, 2.0, 3.0]],
            vec![[1e9, 0.0, 0.0]; 5],
            vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]],
            vec![[f64::NAN, 0.0, 0.0], [0.0; 3]],
        ] {
            assert!(is_frame(View::through(&points, &[])), "{points:?}");
        }
        // A row of joints is seen from its side.
        let row = View::through(&[[0.0; 3], [1.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[]);
        assert!(row.toward[0].abs() < 0.7);
    }

    #[test]
    fn a_tower_with_parallel_axes_is_seen_from_its_side() {
        let points: Vec<Vector> = (0..8)
            .map(|i| {
                [
                    f64::from(i % 2),
                    f64::from(i / 2 % 2),
                    3.0 * f64::from(i / 4),
                ]
            })
            .collect();
        let view = View::through(&points, &[[0.0, 0.0, 1.0]; 8]);
        assert!(view.up[2] > 0.5, "{view:?}");
    }

    fn cloud() -> impl Strategy<Value = Vec<Vector>> {
        prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 3..12)
    }

    proptest! {
        #[test]
        fn neither_order_nor_unit_counts(
            points in cloud(), unit in 1e-6..1e6f64, shift in prop::array::uniform3(-5.0..5.0f64), turn in 1usize..8
        ) {
            let view = View::through(&points, &[]);
            prop_assert!(is_frame(view));
            prop_assert!(view.up[2] >= 0.0);
            let mut other: Vec<Vector> = points.iter().map(|p| times(sum(*p, shift), unit)).collect();
            let by = turn % other.len();
            other.rotate_left(by);
            other.reverse();
            prop_assert!(close(view, View::through(&other, &[])));
        }

        #[test]
        fn symmetric_mechanisms_have_one_best_view(turn in 0usize..6) {
            let mut feet: Vec<Vector> = (0..6)
                .map(|i| {
                    let (s, c) = (std::f64::consts::FRAC_PI_3 * f64::from(i)).sin_cos();
                    [c, s, f64::from(i % 2)]
                })
                .collect();
            let view = View::through(&feet, &[]);
            feet.rotate_left(turn);
            feet.swap(0, 3);
            prop_assert!(close(view, View::through(&feet, &[])));
        }
    }
}
