//! Subgroups in words, for reports.

use std::fmt;

use nalgebra::Vector3;

use super::axis::Axis;
use super::class::DisplacementSubgroup;

/// In words for engineers, such as `planar motion normal to (0, 0, 1)`. Six significant digits.
impl fmt::Display for DisplacementSubgroup {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Identity => write!(f, "no motion"),
            Self::Rotation { axis } => write!(f, "rotation about {}", line(axis)),
            Self::Translation { direction } => {
                write!(f, "translation along {}", coordinates(direction))
            }
            Self::Helical { axis, pitch } => write!(
                f,
                "screw motion with pitch {} m/rad about {}",
                figure(*pitch),
                line(axis)
            ),
            Self::Cylindrical { axis } => {
                write!(f, "rotation about and translation along {}", line(axis))
            }
            Self::PlanarTranslation { normal } => {
                write!(
                    f,
                    "translation in the plane normal to {}",
                    coordinates(normal)
                )
            }
            Self::Spherical { centre } => {
                write!(f, "rotation about the point {}", coordinates(centre))
            }
            Self::Planar { normal } => write!(f, "planar motion normal to {}", coordinates(normal)),
            Self::SpatialTranslation => write!(f, "translation in every direction"),
            Self::TranslatingScrew { direction, pitch } => write!(
                f,
                "translation in the plane normal to {} with screw motion of pitch {} m/rad along it",
                coordinates(direction),
                figure(*pitch)
            ),
            Self::Schoenflies { direction } => write!(
                f,
                "translation in every direction and rotation about {}",
                coordinates(direction)
            ),
            Self::General => write!(f, "unrestricted motion"),
        }
    }
}

fn line(axis: &Axis) -> String {
    let (direction, point) = (coordinates(&axis.direction), coordinates(&axis.point));
    format!("the axis along {direction} through {point}")
}

/// A vector to six significant digits of its largest component.
pub fn coordinates(v: &Vector3<f64>) -> String {
    let digits = decimals(v.amax());
    let [x, y, z] = [v.x, v.y, v.z].map(|x| rounded(x, digits));
    format!("({x}, {y}, {z})")
}

fn figure(x: f64) -> String {
    rounded(x, decimals(x.abs()))
}

/// Decimals that show six significant digits of a number of this size.
fn decimals(size: f64) -> usize {
    if size > 0.0 && size.is_finite() {
        // Clamped to what f64 can hold anyway.
        (5 - size.log10().floor() as i32).clamp(0, 300) as usize
    } else {
        0
    }
}

fn rounded(x: f64, digits: usize) -> String {
    let text = format!("{x:.digits$}");
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { "0" } else { text }.to_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::group::herve_tables::one_of_each;

    #[test]
    fn words_for_engineers() {
        let words: Vec<_> = one_of_each().iter().map(|g| g.to_string()).collect();
        assert_eq!(words[0], "no motion");
        assert_eq!(
            words[1],
            "rotation about the axis along (0, 0, 1) through (1, 2, 0)"
        );
        assert_eq!(words[7], "planar motion normal to (0, 0, 1)");
        assert_eq!(
            words[9],
            "translation in the plane normal to (0, 0, 1) with screw motion of pitch 0.5 m/rad along it"
        );
        let centre = Vector3::new(1.0 / 3.0, -1e-17, 1200.5);
        let sphere = DisplacementSubgroup::Spherical { centre };
        assert_eq!(
            sphere.to_string(),
            "rotation about the point (0.33, 0, 1200.5)"
        );
    }

    #[test]
    fn numbers_keep_six_significant_digits() {
        assert_eq!(figure(0.0), "0");
        assert_eq!(figure(1.0 / 3.0), "0.333333");
        assert_eq!(figure(-1.0e-7 / 3.0), "-0.0000000333333");
        assert_eq!(figure(1234567.0), "1234567");
        assert_eq!(figure(f64::NAN), "NaN");
    }
}
