//! The pose of a motion that needs the most play.

use super::directions::Constrained;
use super::minimax::{Minimax, minimax};
use super::{Deviation, NoPlay};
use crate::curve::{Curve, CurvePose};
use faer::Mat;
use kutzbach_closure::{Geometry, JointState, Part, WalkedCycle, linearised};
use nalgebra::{DMatrix, DVector};

/// Singular values of the meant mechanism's equations below this share of the largest are zero: it is known to about 1e-11.
const ZERO: f64 = 1e-8;

/// More equations that repeat others are not treated.
const MOST_REDUNDANT: usize = 60;

/// Steps of golden section: the place of the maximum to a hundredth of the distance of two poses.
const REFINED: usize = 10;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Two mechanisms with the same links and joints, one of which closes along a motion.
pub(super) struct Search<'a> {
    pub given: Geometry<f64>,
    pub meant: Geometry<f64>,
    pub parts: &'a [Part],
    pub arm: f64,
}

/// What one pose needs.
#[derive(Clone, Debug)]
pub(super) struct AtPose {
    /// The driven variable.
    pub value: f64,
    pub play: f64,
    pub at_least: f64,
    pub joints: Vec<Deviation>,
    /// The rank of every part.
    ranks: Vec<usize>,
}

/// What a motion needs.
pub(super) struct Found {
    pub worst: AtPose,
    pub along: Vec<(f64, f64)>,
    pub left_out: usize,
}

impl Search<'_> {
    /// Looks at equidistant poses of a curve, and closer around the worst.
    pub(super) fn along(&self, curve: &mut Curve, poses: usize) -> Result<Found, NoPlay> {
        let (first, last) = curve.arclengths();
        let step = (last - first) / poses as f64;
        let mut seen = Vec::with_capacity(poses + 1);
        for index in 0..=poses {
            let arclength = first + step * index as f64;
            if let Some(here) = self.at(curve, arclength)? {
                seen.push((arclength, here));
            }
        }
        // Ranks are lower at singular poses only.
        let parts = self.parts.len();
        let ranks: Vec<usize> = (0..parts)
            .map(|part| seen.iter().map(|(_, here)| here.ranks[part]).max())
            .map(Option::unwrap_or_default)
            .collect();
        let all = seen.len();
        seen.retain(|(_, here)| here.ranks == ranks);
        let left_out = all - seen.len();
        let along = seen
            .iter()
            .map(|(_, here)| (here.value, here.play))
            .collect();
        let (at, worst) = seen
            .into_iter()
            .max_by(|a, b| a.1.play.total_cmp(&b.1.play))
            .ok_or(NoPlay::NoClearPose)?;
        let worst = self.refined(curve, at, worst, step)?;
        Ok(Found {
            worst,
            along,
            left_out,
        })
    }

    /// Golden section between the neighbours of the worst pose.
    fn refined(
        &self,
        curve: &mut Curve,
        at: f64,
        mut worst: AtPose,
        step: f64,
    ) -> Result<AtPose, NoPlay> {
        let ranks = worst.ranks.clone();
        let (mut low, mut high) = (at - step, at + step);
        let mut ask = |arclength: f64, worst: &mut AtPose| -> Result<f64, NoPlay> {
            let here = self
                .at(curve, arclength)?
                .filter(|here| here.ranks == ranks);
            let play = here.as_ref().map_or(0.0, |here| here.play);
            if let Some(here) = here.filter(|here| here.play > worst.play) {
                *worst = here;
            }
            Ok(play)
        };
        for _ in 0..REFINED {
            let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if ask(a, &mut worst)? > ask(b, &mut worst)? {
                high = b;
            } else {
                low = a;
            }
        }
        Ok(worst)
    }

    fn at(&self, curve: &mut Curve, arclength: f64) -> Result<Option<AtPose>, NoPlay> {
        let Some(CurvePose { pose, .. }) = curve.pose_at_arclength(arclength) else {
            return Ok(None);
        };
        let value = pose.values[curve.driven_unknown()];
        let states = curve.states(&pose);
        let mut here = AtPose {
            value,
            play: 0.0,
            at_least: 0.0,
            joints: Vec::new(),
            ranks: Vec::with_capacity(self.parts.len()),
        };
        for part in self.parts {
            let Some((rank, found)) = self.of_part(part, &states)? else {
                return Ok(None);
            };
            here.ranks.push(rank);
            if let Some((minimax, deviations)) = found {
                here.play = here.play.max(minimax.most);
                here.at_least = here.at_least.max(minimax.at_least);
                here.joints.extend(deviations);
            }
        }
        here.joints.sort_by_key(|deviation| deviation.joint);
        Ok(Some(here))
    }

    /// The rank of a part's equations, and its least deviations where some of its equations repeat others; `None` where numbers
    /// overflow.
    #[allow(clippy::type_complexity)]
    fn of_part(
        &self,
        part: &Part,
        states: &[JointState<f64>],
    ) -> Result<Option<(usize, Option<(Minimax, Vec<Deviation>)>)>, NoPlay> {
        if part.cycles.is_empty() {
            return Ok(Some((0, None)));
        }
        let Ok(here) = linearised(&self.meant, states, part) else {
            return Ok(None);
        };
        let (rows, columns) = (here.matrix.rows(), here.matrix.columns());
        let mut dense = Mat::<f64>::zeros(rows, columns);
        for (row, column, entry) in here.matrix.triplets() {
            dense[(row, column)] += entry;
        }
        let Ok(svd) = dense.svd() else {
            return Ok(None);
        };
        let (u, s) = (svd.U(), svd.S().column_vector());
        let largest = if s.nrows() > 0 { s[0] } else { 0.0 };
        let rank = (0..s.nrows()).filter(|&i| s[i] > ZERO * largest).count();
        let redundant = rows - rank;
        if redundant == 0 {
            return Ok(Some((rank, None)));
        }
        if redundant > MOST_REDUNDANT {
            return Err(NoPlay::TooLarge(MOST_REDUNDANT));
        }
        let left = DMatrix::from_fn(redundant, rows, |i, row| u[(row, rank + i)]);
        let misfit = &left * self.open(part, &here.walks, states, rows);
        let blocks = self.blocks(part, &here.walks, states, &left);
        let matrices: Vec<DMatrix<f64>> = blocks.iter().map(|block| block.matrix.clone()).collect();
        let found = minimax(&matrices, &-misfit).ok_or(NoPlay::Unmendable)?;
        let deviations = blocks
            .iter()
            .zip(&found.vectors)
            .map(|(block, u)| block.deviation(u))
            .collect();
        Ok(Some((rank, Some((found, deviations)))))
    }

    /// How far the loops of the given dimensions stay open where the meant ones close, in the rows of the latter. Couplings hold.
    fn open(
        &self,
        part: &Part,
        walks: &[WalkedCycle<f64>],
        states: &[JointState<f64>],
        rows: usize,
    ) -> DVector<f64> {
        let mut adopted = states.to_vec();
        for &joint in &part.joints {
            adopted[joint] = self.given.displacements[joint]
                .adopt(&self.meant.displacements[joint], &states[joint]);
        }
        let mut open = DVector::zeros(rows);
        for (index, (cycle, walk)) in part.cycles.iter().zip(walks).enumerate() {
            let given = WalkedCycle::walk(&self.given, &adopted, cycle);
            let measured = WalkedCycle {
                closure: given.closure,
                ..walk.clone()
            };
            for (row, value) in measured.residual().into_iter().enumerate() {
                open[6 * index + row] = value;
            }
        }
        open
    }

    /// What each joint's deviations do to the equations that joints cannot mend.
    fn blocks(
        &self,
        part: &Part,
        walks: &[WalkedCycle<f64>],
        states: &[JointState<f64>],
        left: &DMatrix<f64>,
    ) -> Vec<Block> {
        let mut blocks = Vec::with_capacity(part.joints.len());
        for &joint in &part.joints {
            let displacement = &self.meant.displacements[joint];
            let constrained = Constrained::of(displacement, &states[joint], self.arm);
            let mut matrix = DMatrix::zeros(left.nrows(), constrained.screws.len());
            for (index, walk) in walks.iter().enumerate() {
                for passed in walk.joints.iter().filter(|passed| passed.joint == joint) {
                    for (column, deviating) in constrained.screws.iter().enumerate() {
                        let rows = walk.column(passed, &deviating.screw(&passed.frame));
                        for i in 0..left.nrows() {
                            let sum = (0..6).map(|row| left[(i, 6 * index + row)] * rows[row]);
                            matrix[(i, column)] += sum.sum::<f64>();
                        }
                    }
                }
            }
            blocks.push(Block {
                joint,
                constrained,
                matrix,
            });
        }
        blocks
    }
}

/// A joint's deviations and what they do.
struct Block {
    joint: usize,
    constrained: Constrained,
    matrix: DMatrix<f64>,
}

impl Block {
    fn deviation(&self, u: &DVector<f64>) -> Deviation {
        let sum = |of: fn(&super::directions::Deviating) -> [f64; 3]| {
            let mut total = [0.0; 3];
            for (deviating, u) in self.constrained.screws.iter().zip(u.iter()) {
                total
                    .iter_mut()
                    .zip(of(deviating))
                    .for_each(|(total, x)| *total += u * x);
            }
            total.iter().map(|x| x * x).sum::<f64>().sqrt()
        };
        Deviation {
            joint: self.joint,
            shift: sum(|d| d.shift),
            tilt: sum(|d| d.tilt),
        }
    }
}
