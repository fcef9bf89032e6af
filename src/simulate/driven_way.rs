//! Which way a drive goes along a branch.

use crate::closure::JointState;
use crate::mechanism::{FreedomPart, Mechanism};
use crate::mobility::{Analysis, Branch};

/// A way along a branch that one driven freedom determines.
#[derive(Clone, Debug)]
pub(super) struct DrivenWay {
    /// The pose it starts from: not singular.
    pub start: Vec<JointState<f64>>,
    /// (joint, freedom) that is driven.
    pub driven: (usize, usize),
    /// Freedoms that are held: with the driven one, the branch's inputs.
    pub held: Vec<(usize, usize)>,
    /// Value of the driven freedom at the start (rad, m).
    pub from: f64,
    /// And at the end.
    pub to: f64,
    /// Why it goes no farther.
    pub ends: String,
    /// Instantaneous freedom of the parts with loops along the branch.
    pub loop_freedom: usize,
}

impl DrivenWay {
    /// Share of the way gone.
    pub fn progress(&self, states: &[JointState<f64>]) -> f64 {
        let (joint, freedom) = self.driven;
        let value = states[joint].values.get(freedom).copied().unwrap_or(0.0);
        (value - self.from) / (self.to - self.from)
    }
}

/// A way along a branch.
pub(super) fn way_along(
    mechanism: &Mechanism,
    length: f64,
    analysis: &Analysis,
    branch: &Branch,
) -> Result<DrivenWay, String> {
    let pose = branch.poses.first().ok_or("no pose of it is at hand")?;
    let offsets = mechanism.variable_offsets();
    let mut rows: Vec<((usize, usize), Vec<f64>)> = Vec::new();
    for (index, joint) in mechanism.joints().iter().enumerate() {
        for (freedom, part) in joint.kind.freedoms().iter().enumerate() {
            let unit = if *part == FreedomPart::Translation { 1.0/length } else { 1.0 };
            rows.push(((index, freedom), pose.tangents.iter().map(|t| t[offsets[index] + freedom] * unit).collect()));
        }
    }
    let mut inputs = Vec::new();
    for _ in 0..branch.dimension {
        let (best, size) = rows.iter().enumerate().map(|(i, (_, r))| (i, r.iter().map(|x| x * x).sum::<f64>())).fold((0, 0.0), |m, x| if x.1 > m.1 * 1.0001 { x } else { m });
        if size < 1e-12 { break; }
        inputs.push(rows[best].0);
        let pivot: Vec<f64> = rows[best].1.iter().map(|x| x / size.sqrt()).collect();
        for (_, row) in &mut rows {
            let along: f64 = row.iter().zip(&pivot).map(|(a, b)| a * b).sum();
            row.iter_mut().zip(&pivot).for_each(|(x, p)| *x -= along * p);
        }
    }
    let (&driven, held) = inputs.split_first().ok_or("nothing can be driven")?;
    let from = pose.states[driven.0].values[driven.1];
    let free: usize = analysis.structure.free_joints.iter().map(|&j| mechanism.joints()[j].freedom()).sum::<usize>() + 6 * analysis.structure.loose_pieces;
    Ok(DrivenWay {
        start: pose.states.clone(),
        driven,
        held: held.to_vec(),
        from,
        to: from + 0.5 * if mechanism.joints()[driven.0].kind.freedoms()[driven.1] == FreedomPart::Translation { length } else { 1.0 },
        ends: String::new(),
        loop_freedom: branch.instantaneous.unwrap_or(branch.dimension) - free,
    })
}
