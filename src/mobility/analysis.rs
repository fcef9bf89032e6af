//! Everything the first engines say about a mechanism at one pose.

use super::advice::{Advice, advice_for_part};
use super::cycles::{CycleFacts, cycle_facts};
use super::generic::{GenericCount, generic_count};
use super::kutzbach::kutzbach_count;
use super::more_digits::MoreDigits;
use super::pose_rank::{PartRank, Pose, rank_part_with};
use super::redundancy::SelfStresses;
use super::roles::{JointRole, roles_of_part};
use super::structure::Structure;
use super::verdict::{Mobility, judge};
use crate::closure::{Arithmetic, Assembly, Geometry, assemble, spanning_poses};
use crate::matrix::MatrixError;
use crate::mechanism::Mechanism;
use std::collections::BTreeSet;
use thiserror::Error;

/// What to analyse.
#[derive(Clone, Debug, Default)]
pub struct AnalysisOptions {
    /// The configuration to start from; the home pose if `None`.
    pub configuration: Option<String>,
}

/// Why an analysis could not be made. That a mechanism does not assemble or stays undecided is a result, not an error.
#[derive(Clone, Debug, Error)]
pub enum AnalysisError {
    /// The configuration asked for does not exist.
    #[error("there is no configuration named `{name}`; the file has {known}")]
    UnknownConfiguration {
        /// The name asked for.
        name: String,
        /// The names there are, for people.
        known: String,
    },
    /// A distance joint whose two points coincide where its distance is to be read off.
    #[error(
        "joint `{joint}`: its two points coincide at home, and no <distance> is stated; two coinciding points are a `spherical` joint"
    )]
    NoDistance {
        /// The joint's name.
        joint: String,
    },
    /// Numbers out of range.
    #[error("the geometry leaves the range of floating-point numbers: {0}")]
    OutOfRange(#[from] MatrixError),
}

/// The instantaneous picture of the whole mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct HomeFreedom {
    /// Dimension of the kernel of the closure equations; `None` where some part is undecided.
    pub instantaneous: Option<usize>,
    /// Smallest and largest value that remain possible.
    pub candidates: (usize, usize),
    /// The value for the numbers taken literally, where some part's differs.
    pub as_written: Option<usize>,
    /// Dependent constraint equations: instantaneous − Kutzbach.
    pub redundant: Option<i64>,
}

/// The analysis of a mechanism at a pose.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Topology.
    pub structure: Structure,
    /// Kutzbach's count.
    pub kutzbach: i64,
    /// The count at random geometry.
    pub generic: GenericCount,
    /// How the mechanism closes.
    pub assembly: Assembly,
    /// The rank of every part, in the order of [`Structure::parts`]; empty if it does not assemble.
    pub parts: Vec<PartRank>,
    /// The instantaneous freedom; `None` if the mechanism does not assemble: an open pose is never ranked.
    pub home: Option<HomeFreedom>,
    /// Roles of all joints, by joint index.
    pub roles: Vec<JointRole>,
    /// Indeterminate reaction directions of all joints, by joint index; `None` where the rank is open.
    pub redundant_wrenches: Vec<Option<usize>>,
    /// Facts of the cycles shown.
    pub cycles: Vec<CycleFacts>,
    /// Repair advice, best first.
    pub advice: Vec<Advice>,
    /// The verdict.
    pub mobility: Mobility,
}

/// Analyses a mechanism: counts, assembles, ranks, names what is locked and redundant.
///
/// # Errors
/// [`AnalysisError`]; see there.
pub fn analyse(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
) -> Result<Analysis, AnalysisError> {
    let configuration = match &options.configuration {
        None => None,
        Some(name) => Some(mechanism.configuration(name).ok_or_else(|| {
            AnalysisError::UnknownConfiguration {
                name: name.clone(),
                known: known_configurations(mechanism),
            }
        })?),
    };
    let held: BTreeSet<usize> = configuration
        .iter()
        .flat_map(|c| c.positions.iter().map(|(joint, _)| joint.0))
        .collect();
    let structure = Structure::new(mechanism);
    let kutzbach = kutzbach_count(mechanism);
    let generic = generic_count(mechanism, &structure)?;
    let geometry = Geometry::new(mechanism, configuration, &Arithmetic::double());
    if let Some(joint) = geometry.degenerate_distance() {
        return Err(AnalysisError::NoDistance {
            joint: mechanism.joints()[joint].name.clone(),
        });
    }
    let assembly = assemble(mechanism, &geometry, &structure.parts, &held)?;
    let mut analysis = Analysis {
        mobility: judge(mechanism, &structure, &assembly, &[]),
        structure,
        kutzbach,
        generic,
        assembly,
        parts: Vec::new(),
        home: None,
        roles: vec![JointRole::default(); mechanism.joints().len()],
        redundant_wrenches: vec![None; mechanism.joints().len()],
        cycles: Vec::new(),
        advice: Vec::new(),
    };
    if analysis.assembly.closed {
        analysis.rank(mechanism, configuration, &held, &geometry)?;
    }
    Ok(analysis)
}

fn known_configurations(mechanism: &Mechanism) -> String {
    let names: Vec<String> = mechanism
        .configurations()
        .iter()
        .map(|c| format!("`{}`", c.name))
        .collect();
    if names.is_empty() {
        "none".to_owned()
    } else {
        names.join(", ")
    }
}

impl Analysis {
    /// The part of the analysis that needs a closed pose.
    fn rank(
        &mut self,
        mechanism: &Mechanism,
        configuration: Option<&crate::mechanism::Configuration>,
        held: &BTreeSet<usize>,
        geometry: &Geometry<f64>,
    ) -> Result<(), MatrixError> {
        let states = &self.assembly.states;
        let pose = Pose {
            mechanism,
            configuration,
            held,
            geometry,
            states,
            as_drawn: self.assembly.steps == 0,
        };
        let mut more = MoreDigits::new();
        let mut parts = Vec::with_capacity(self.structure.parts.len());
        for part in &self.structure.parts {
            parts.push(rank_part_with(&pose, &mut more, part)?);
        }
        // What is tried part by part is tried on these and undone again, since copies for every part would add up.
        let mut trial = geometry.clone();
        let mut trial_states = states.clone();
        let home = self.home_freedom(mechanism, &parts);
        for &joint in &self.structure.free_joints {
            self.roles[joint].locked = (mechanism.joints()[joint].freedom() > 0).then_some(false);
            self.redundant_wrenches[joint] = Some(0);
        }
        for (part, rank) in self.structure.parts.iter().zip(&parts) {
            for (joint, role) in part.joints.iter().zip(roles_of_part(
                mechanism,
                geometry,
                &mut trial_states,
                part,
                rank,
            )?) {
                self.roles[*joint] = role;
            }
            let Some(stresses) = SelfStresses::new(part, rank)? else {
                continue;
            };
            for &joint in &part.joints {
                self.redundant_wrenches[joint] = Some(stresses.indeterminate_wrenches(rank, joint));
            }
            if let Some(redundant) = home.redundant.filter(|r| *r > 0) {
                self.advice.extend(advice_for_part(
                    mechanism,
                    &mut trial,
                    &mut trial_states,
                    part,
                    rank,
                    &stresses,
                    redundant,
                )?);
            }
        }
        let graph = &self.structure.graph;
        self.advice
            .sort_by_key(|a| (a.redundant_after, graph.edge_rank(a.joint), a.to));
        let (poses, _) = spanning_poses(mechanism, geometry, states);
        for cycle in &self.structure.cycles {
            self.cycles
                .push(cycle_facts(mechanism, geometry, states, &poses, cycle)?);
        }
        self.mobility = judge(mechanism, &self.structure, &self.assembly, &parts);
        self.home = Some(home);
        self.parts = parts;
        Ok(())
    }

    fn home_freedom(&self, mechanism: &Mechanism, parts: &[PartRank]) -> HomeFreedom {
        let free: usize = self
            .structure
            .free_joints
            .iter()
            .map(|&joint| mechanism.joints()[joint].freedom())
            .sum();
        let base = free + 6 * self.structure.loose_pieces;
        let sum = |value: &dyn Fn(&PartRank) -> Option<usize>| -> Option<usize> {
            parts
                .iter()
                .map(value)
                .sum::<Option<usize>>()
                .map(|total| total + base)
        };
        let instantaneous = sum(&|part| part.instantaneous);
        let as_written =
            sum(&|part| part.as_written).filter(|literal| Some(*literal) != instantaneous);
        HomeFreedom {
            instantaneous,
            candidates: (
                base + parts.iter().map(|p| p.candidates.0).sum::<usize>(),
                base + parts.iter().map(|p| p.candidates.1).sum::<usize>(),
            ),
            as_written,
            redundant: instantaneous.map(|i| i as i64 - self.kutzbach),
        }
    }
}
