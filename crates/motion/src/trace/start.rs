//! What the analysis knows about the pose a part starts from.

use super::{CLOSED, KERNEL_UNKNOWNS, Stage, Tracer};
use crate::system::{Evaluation, LoopSystem, SystemPose};
use kutzbach_closure::JointState;
use kutzbach_mobility::{PoseKind, SingularKind};
use nalgebra::DMatrix;

impl Tracer<'_> {
    /// The states from which a part is followed, and whether they are those of the pose analysed.
    pub(super) fn start(&self, stage: &Stage) -> (Vec<JointState<f64>>, bool) {
        let home = self.analysis.assembly.states.clone();
        let Some(index) = stage.index else {
            return (home, true);
        };
        let finding = &self.analysis.findings[index];
        let regular = finding.pose() == Some(PoseKind::Regular)
            || finding.kind() == Some(SingularKind::PermanentlyShaky)
                && finding.branches().is_some_and(|b| b.len() == 1);
        match self.branch.poses.first() {
            Some(pose) if !regular => {
                let mut states = home;
                for &joint in &stage.part.joints {
                    states[joint] = pose.states[joint].clone();
                }
                (states, false)
            }
            _ => (home, true),
        }
    }

    /// By how many the instantaneous freedom of a part exceeds its dimension all along the branch.
    pub(super) fn excess(&self, stage: &Stage) -> usize {
        let Some(index) = stage.index else { return 0 };
        let finding = &self.analysis.findings[index];
        let first = stage.part.joints.first().copied();
        let own = self.branch.poses.first().zip(first).and_then(|(pose, j)| {
            finding.branches().into_iter().flatten().find(|b| {
                b.poses
                    .first()
                    .and_then(|p| p.states.first())
                    .is_some_and(|s| s.values == pose.states[j].values)
                    && b.dimension == stage.dimension
            })
        });
        own.and_then(|b| b.poses.first())
            .and_then(|p| p.instantaneous)
            .map_or(0, |i| i.saturating_sub(stage.dimension))
    }

    /// A basis of the tangents of the branch at the start of a part, in the metric.
    pub(super) fn tangents(
        &self,
        stage: &Stage,
        system: &LoopSystem,
        pose: &SystemPose,
    ) -> Vec<Vec<f64>> {
        let n = system.unknowns();
        if self.excess(stage) == 0 && n <= KERNEL_UNKNOWNS {
            let mut evaluation = Evaluation::default();
            system.evaluate(pose, &mut evaluation);
            let mut rows = vec![0.0; system.equations() * n];
            system.fill_dense(&evaluation, &mut rows);
            let size = n.max(system.equations());
            let matrix = DMatrix::from_row_slice(system.equations(), n, &rows).resize(size, n, 0.0);
            if let Some(v) = matrix.clone().svd(false, true).v_t {
                let values = matrix.singular_values();
                let mut order: Vec<usize> = (0..n).collect();
                order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
                return order[..stage.dimension.min(n)]
                    .iter()
                    .map(|&i| v.row(i).iter().copied().collect())
                    .collect();
            }
        }
        let offsets = self.mechanism.variable_offsets();
        let Some(pose) = self.branch.poses.first() else {
            return Vec::new();
        };
        pose.tangents
            .iter()
            .map(|tangent| {
                system
                    .variables()
                    .iter()
                    .zip(system.weights())
                    .map(|((joint, freedom), w)| tangent[offsets[*joint] + freedom] * w)
                    .collect::<Vec<f64>>()
            })
            .filter(|t| t.iter().any(|x| *x != 0.0))
            .collect()
    }

    /// Largest closure that counts as closed in a part.
    pub(super) fn allowed(&self, stage: &Stage) -> f64 {
        let stated = stage
            .index
            .and_then(|i| self.analysis.parts.get(i))
            .map_or(0.0, |p| p.open_by_digits());
        CLOSED.max(4.0 * stated)
    }
}
