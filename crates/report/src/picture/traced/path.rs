//! The path of a point that is fixed to a link.

use super::plane::Plane;
use super::{around, landmarks};
use crate::picture::plot::{Axis, Plot, Scale, Series};
use crate::text::words::figure;
use crate::traced::LinkPoint;
use kutzbach_motion::Motion;

impl LinkPoint {
    /// Its path drawn with equal scales (mm): in the plane that it lies in, or seen along the normal of the plane that is
    /// nearest to it. The line is closed where the samples go once around a closed motion.
    #[must_use]
    pub fn plot(&self, motion: &Motion) -> Plot {
        let path = self.path(motion);
        let plane = Plane::of(&path);
        let flat = |point: &[f64; 3]| {
            let [x, y] = plane.project(point);
            (1e3 * x, 1e3 * y)
        };
        let mut line: Vec<(f64, f64)> = path.iter().map(flat).collect();
        if goes_around(motion) {
            // Both ends are one pose; its rounding is not drawn.
            if let (Some(first), Some(last)) = (line.first().copied(), line.last_mut()) {
                *last = first;
            }
        }
        let [across, up] = &plane.names;
        let axis = |name: &str, values: Vec<f64>| {
            Axis::new(format!("{name} (mm)"), Scale::Linear, around(&values))
        };
        let title = match plane.off {
            None => format!("Path of {}", self.name),
            Some(off) => format!(
                "Path of {}, projected on its best plane (up to {} mm off it)",
                self.name,
                figure(1e3 * off)
            ),
        };
        let mut plot = Plot::new(
            title,
            axis(across, line.iter().map(|at| at.0).collect()),
            axis(up, line.iter().map(|at| at.1).collect()),
        );
        plot.size = [640.0, 520.0];
        plot.series.push(Series::line(&self.name, "mm", 0, line));
        let place = |pose: &super::Pose| self.place(&pose.links).map(|at| flat(&at));
        plot.series.extend(landmarks(motion, &place));
        plot.with_equal_scales()
    }
}

/// Whether the first and the last sample are one pose of a closed motion.
fn goes_around(motion: &Motion) -> bool {
    let (Some(length), Some(first), Some(last)) =
        (motion.closed, motion.samples.first(), motion.samples.last())
    else {
        return false;
    };
    ((last.arclength - first.arclength).abs() - length).abs() <= 1e-9 * length
}
