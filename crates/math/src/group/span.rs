//! A joint's or a chain's instantaneous motion in words a report can use.

use super::GroupError;
use super::class::DisplacementSubgroup;
use super::classify::classify;
use super::decomposition::Margin;
use super::gauge::Gauge;
use super::subalgebra::Subalgebra;
use super::system::ScrewSystem;
use super::twist::Twist;

/// What a set of twists can do together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpanDescription {
    /// Dimension of the span: instantaneous freedom.
    pub freedom: usize,
    /// Dimension of the rotational part: how many independent angular velocities occur.
    pub rotations: usize,
    /// Dimension of the pure translations in the span; `freedom` = `rotations` + `translations`.
    pub translations: usize,
    /// The subgroup whose algebra the span is; `None` where it is not closed under the bracket, as for a
    /// universal joint.
    pub subgroup: Option<DisplacementSubgroup>,
    /// The smallest subgroup that contains all the motion, at this pose and after any finite displacement
    /// by these twists; equal to `subgroup` where there is one. `None` only where the margin is too small
    /// to tell.
    pub enclosing: Option<DisplacementSubgroup>,
    /// Worst margin of all decisions.
    pub margin: Margin,
}

/// Describes the span of some world twists, such as the relative motion left between two links.
///
/// # Errors
/// [`GroupError::NotFinite`], [`GroupError::NoConvergence`].
///
/// # Example
/// ```
/// # use kutzbach_math as kutzbach;
/// use kutzbach::group::{Gauge, Twist, describe_span};
/// use nalgebra::Vector3;
///
/// let gauge = Gauge::new(Vector3::zeros(), 1.0, 1e-9)?;
/// let hooke = [Vector3::x(), Vector3::y()].map(|u| Twist::revolute(u, Vector3::zeros()));
/// let motion = describe_span(&hooke, &gauge)?;
/// assert_eq!((motion.freedom, motion.rotations), (2, 2));
/// assert!(motion.subgroup.is_none());
/// let enclosing = motion.enclosing.map(|g| g.to_string());
/// assert_eq!(enclosing.as_deref(), Some("rotation about the point (0, 0, 0)"));
/// # Ok::<(), kutzbach::group::GroupError>(())
/// ```
pub fn describe_span(twists: &[Twist], gauge: &Gauge) -> Result<SpanDescription, GroupError> {
    let system = ScrewSystem::span(twists, gauge)?;
    let found = classify(&system)?;
    let (enclosing, margin) = match found.subgroup {
        Some(subgroup) => (Some(subgroup), found.margin),
        None => {
            let closed = classify(Subalgebra::generated_by_system(&system)?.system())?;
            (closed.subgroup, found.margin.and(closed.margin))
        }
    };
    Ok(SpanDescription {
        freedom: system.dimension(),
        rotations: found.rotations,
        translations: found.translations,
        subgroup: found.subgroup,
        enclosing,
        margin,
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn a_planar_chain_is_described_with_its_group() {
        let gauge = Gauge::new(Vector3::zeros(), 1.0, 1e-9).unwrap();
        let pin = |x: f64| Twist::revolute(Vector3::z(), Vector3::new(x, 0.0, 0.0));
        let two = describe_span(&[pin(0.0), pin(1.0)], &gauge).unwrap();
        assert_eq!((two.freedom, two.rotations, two.translations), (2, 1, 1));
        assert_eq!(two.subgroup, None);
        assert_eq!(two.enclosing.unwrap().short_name(), "G");
        let apart = Twist::revolute(Vector3::z(), Vector3::new(0.0, 1.0, 0.0));
        let three = describe_span(&[pin(0.0), pin(1.0), apart], &gauge).unwrap();
        assert_eq!(three.subgroup, three.enclosing);
        let words = three.subgroup.unwrap().to_string();
        assert_eq!(words, "planar motion normal to (0, 0, 1)");
        assert!(three.margin.is_clear());
    }
}
