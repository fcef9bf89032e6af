//! Closed forms: loops of hinges with parallel axes, or with axes through one point.
//!
//! # What is used, and why it is true
//! Such a loop is a polygon in the plane, or on the sphere, that may turn as a whole about none of its links: n hinges, n links of
//! constant length, whose directions close.
//!
//! 1. In the plane the closure is Σ lᵢ e^(iφᵢ) = 0 with the directions φᵢ of the links. Its derivative is onto unless all links (of
//!    length not zero) are parallel, so that elsewhere the solutions are a manifold of n − 2 dimensions, of which one turns the whole:
//!    *n − 3*, Grübler's count. On the sphere the closure is a product of rotations about the axes, whose derivative is onto
//!    unless the axes lie in one plane: n − 3 again.
//! 2. Let all links of a planar loop lie in one line, with signs εᵢ along it. To first order Σ εᵢ lᵢ φᵢ = 0, and to second order the form
//!    q = Σ εᵢ lᵢ φᵢ² is left over, of signature (f, b) where f links lie one way and b the other. Turning the whole, φ = (1, …, 1),
//!    is null in q, and the first equation says that φ is orthogonal to it; on what is orthogonal modulo what is null the signature is (f − 1,
//!    b − 1), and q is not degenerate there. So near the pose the solutions are those of a quadratic form of full rank in n − 2
//!    variables (Morse's lemma): of dimension *n − 3*, or a single point where the form is definite, which it is where *one link
//!    lies against all others* (Kapovich and Millson 1995, *J. Differential Geometry* 42, for polygons in general).
//!
//! # What the answer satisfies
//! Positions are compared in lengths of the loop. They are known to the accuracy of the part's rank and to what its digits leave open, by
//! which a loop is called stretched out only in exact numbers, and folded open only by a distance a thousand times as large. What lies
//! between is left to others, and so are axes that are parallel, or concurrent, within the digits only, and numbers so long that they
//! may hold a tilt which doubles do not show: this engine gives bounds, and decides nothing alone.
//!
//! Cost: a look at the axes, which were placed when the rank was decided.

use super::claim::{Bounds, Claim};
use super::pose_rank::{PartRank, Pose, TALL, height_at, is_computed};
use super::vocabulary::{EngineName, Scope};
use kutzbach_closure::{Part, entry_accuracy};
use kutzbach_model::mechanism::{JointKind, Mechanism};
use nalgebra::{Matrix3, Vector3};

/// What is computed from the screws of a loop may be off by so many times their accuracy: each passes up to a few dozen
/// roundings of its own size.
const ROUNDING: f64 = 30.0;

/// What exceeds its uncertainty by this factor is not zero.
const CLEAR: f64 = 1e3;

/// A loop of hinges, its axes in order.
struct Hinges {
    directions: Vec<Vector3<f64>>,
    /// In lengths of the loop, from its centre.
    points: Vec<Vector3<f64>>,
    /// Relative accuracy of these.
    accuracy: f64,
    /// The same of what is so at every pose: of the relations between the axes of a link, which are as uncertain as rounding makes them,
    /// however well the pose is known.
    rounding: f64,
    /// What the digits leave open besides.
    stated: f64,
}

/// The mobility of a part that is one loop of hinges with parallel or concurrent axes, where its shape tells.
pub(super) fn closed_form(pose: &Pose<'_>, part: &Part, rank: &PartRank) -> Option<Claim> {
    let hinges = Hinges::of(pose.mechanism, part, rank)?;
    // Long numbers, and those computed from decimals, may hold a tilt that doubles take for rounding.
    if height_at(pose, part) > TALL || is_computed(pose.mechanism, part) {
        return None;
    }
    let links = hinges.directions.len();
    let (freedom, text) = hinges.planar().or_else(|| hinges.spherical())?;
    let text = format!("{links} hinges {text}");
    let finite = Bounds::exactly(freedom);
    Some(Claim::of(
        EngineName::ClosedForm,
        Scope::RealNeighbourhood,
        finite,
        text,
    ))
}

impl Hinges {
    fn of(mechanism: &Mechanism, part: &Part, rank: &PartRank) -> Option<Self> {
        let [walk] = &rank.jacobian.walks[..] else {
            return None;
        };
        let own = |joint: usize| part.joints.contains(&joint);
        let hinge = |joint: usize| mechanism.joints()[joint].kind == JointKind::Revolute;
        let moving = walk
            .joints
            .iter()
            .filter(|j| own(j.joint) && !j.screws.is_empty());
        let hinges = moving.clone().all(|j| hinge(j.joint));
        if !part.couplings.is_empty() || !hinges || !(walk.length > 0.0) {
            return None;
        }
        let centre = Vector3::from(walk.centre);
        let screws: Vec<_> = moving.flat_map(|j| &j.screws).collect();
        let directions = screws.iter().map(|s| Vector3::from(s.angular)).collect();
        let points = screws
            .iter()
            .map(|s| (Vector3::from(s.point) - centre) / walk.length)
            .collect();
        let found = Self {
            directions,
            points,
            accuracy: ROUNDING * rank.accuracy,
            rounding: ROUNDING * entry_accuracy(&rank.jacobian).1,
            stated: rank.open_by_digits(),
        };
        (screws.len() >= 3).then_some(found)
    }

    /// Whether something computed from the axes is zero but for rounding.
    fn vanishes(&self, size: f64) -> bool {
        size <= self.accuracy
    }

    /// Whether something that no pose changes is zero but for rounding.
    fn vanishes_everywhere(&self, size: f64) -> bool {
        size <= self.rounding
    }

    /// Whether it is not zero, whatever the digits leave open.
    fn is_clear(&self, size: f64) -> bool {
        size > CLEAR * (self.accuracy + self.stated)
    }

    fn planar(&self) -> Option<(usize, String)> {
        let axis = self.directions[0];
        let parallel = |other: &Vector3<f64>| self.vanishes_everywhere(axis.cross(other).norm());
        if !self.directions.iter().all(parallel) {
            return None;
        }
        let across = |point: &Vector3<f64>| point - axis * axis.dot(point);
        let places: Vec<Vector3<f64>> = self.points.iter().map(across).collect();
        let count = places.len();
        let links: Vec<Vector3<f64>> = (0..count)
            .map(|i| places[(i + 1) % count] - places[i])
            .collect();
        let longest = links
            .iter()
            .max_by(|one, other| one.norm().total_cmp(&other.norm()))?
            .normalize();
        let open = links
            .iter()
            .map(|link| longest.cross(link).norm())
            .fold(0.0, f64::max);
        if self.is_clear(open) {
            let text = "with parallel axes, not all in one plane: Grübler's count";
            return Some((count - 3, text.to_owned()));
        }
        // What is stretched out within the digits may be bent.
        let exact = self.stated <= self.accuracy && self.vanishes(open);
        if !exact || !links.iter().all(|link| self.is_clear(link.norm())) {
            return None;
        }
        let forward = links.iter().filter(|link| link.dot(&longest) > 0.0).count();
        let against = count - forward;
        let text = format!(
            "with parallel axes in one plane, {forward} links one way and {against} the other: {}",
            if forward == 1 || against == 1 {
                "one is as long as all others together"
            } else {
                "they fold in more ways than one"
            }
        );
        let isolated = forward == 1 || against == 1;
        Some((if isolated { 0 } else { count - 3 }, text))
    }

    /// How far the axes reach out of the plane of the two that differ most from parallel, one of them the first; `None` where all are.
    fn least_volume(&self) -> Option<f64> {
        let first = self.directions[0];
        let normals = self.directions.iter().map(|other| first.cross(other));
        let normal = normals.max_by(|one, other| one.norm().total_cmp(&other.norm()))?;
        let normal = self.is_clear(normal.norm()).then(|| normal.normalize())?;
        let out = self.directions.iter().map(|other| normal.dot(other).abs());
        Some(out.fold(0.0, f64::max))
    }

    fn spherical(&self) -> Option<(usize, String)> {
        // The point nearest to all axes: Σ (1 − ddᵀ) (x − p) = 0.
        let mut normal = Matrix3::zeros();
        let mut right = Vector3::zeros();
        for (direction, point) in self.directions.iter().zip(&self.points) {
            let across = Matrix3::identity() - direction * direction.transpose();
            normal += across;
            right += across * point;
        }
        let centre = normal.cholesky()?.solve(&right);
        let far = self
            .directions
            .iter()
            .zip(&self.points)
            .map(|(direction, point)| direction.cross(&(point - centre)).norm())
            .fold(0.0, f64::max);
        let least = self.least_volume()?;
        let text = "with axes through one point, not all in one plane: the count on the sphere";
        let known = self.vanishes_everywhere(far) && self.is_clear(least);
        known.then(|| (self.directions.len() - 3, text.to_owned()))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::part_samples::{Posed, bennett, five_bar};
    use kutzbach_closure::samples::{
        Place, Written, flat_parallelogram, four_bar, general_four, planar, ring,
    };

    fn claimed(mechanism: Mechanism) -> Option<usize> {
        let posed = Posed::new(mechanism);
        let claim = closed_form(&posed.pose(), posed.part(), &posed.rank());
        claim.map(|claim| claim.finite.sole().unwrap())
    }

    fn polygon(points: &[[f64; 2]]) -> Option<usize> {
        claimed(ring(&planar(points), [0.0; 3], Written::Exactly))
    }

    #[test]
    fn open_polygons_have_as_many_freedoms_as_gruebler_counts() {
        assert_eq!(claimed(four_bar()), Some(1));
        assert_eq!(claimed(five_bar()), Some(2));
        assert_eq!(polygon(&[[0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]), Some(0));
        // Two hinges about one axis: a link that turns by itself.
        assert_eq!(
            polygon(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.5, 1.0]]),
            Some(1)
        );
    }

    #[test]
    fn stretched_polygons_move_unless_one_link_is_as_long_as_all_others() {
        assert_eq!(claimed(flat_parallelogram()), Some(1));
        assert_eq!(polygon(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]), Some(0));
        assert_eq!(
            polygon(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [4.0, 0.0]]),
            Some(0)
        );
        // Five links, two of them one way.
        let five = [[0.0, 0.0], [3.0, 0.0], [2.0, 0.0], [5.0, 0.0], [1.0, 0.0]];
        assert_eq!(polygon(&five), Some(2));
        // A point twice in a line: the form is degenerate.
        assert_eq!(
            polygon(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [3.0, 0.0]]),
            None
        );
    }

    #[test]
    fn loops_about_a_point_move_like_those_in_a_plane() {
        let about = |directions: &[[f64; 3]]| {
            let kind = JointKind::Revolute;
            let places: Vec<Place> = directions.iter().map(|d| (kind, [0.0; 3], *d)).collect();
            claimed(ring(&places, [0.0; 3], Written::Exactly))
        };
        let x = [1.0, 0.0, 0.0];
        let (y, z) = ([0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
        assert_eq!(about(&[x, y, z, [1.0, 1.0, 1.0]]), Some(1));
        assert_eq!(about(&[x, y, z]), Some(0));
        // All axes in one plane: not told.
        assert_eq!(about(&[x, y, [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]]), None);
        // Two pairs of hinges about one axis each: two links that turn by themselves.
        assert_eq!(about(&[[0.0, 1.0, 1.0], [0.0, 1.0, 1.0], x, x]), None);
    }

    #[test]
    fn other_loops_are_left_to_others() {
        assert_eq!(claimed(general_four()), None);
        assert_eq!(claimed(bennett(Written::Exactly)), None);
        // Stretched within the digits only.
        let line = [[0.0, 0.0], [0.333, 0.0], [1.0, 0.0]];
        let rounded = ring(&planar(&line), [0.0; 3], Written::Decimals(3));
        assert_eq!(claimed(rounded), None);
    }
}
