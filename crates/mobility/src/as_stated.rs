//! The analysis of the numbers as a file states them: counting, assembly, ranks, the verdict, and what follows from them.

use super::advice::advice_for_part;
use super::alike::treat_alike;
use super::analysis::{Analysis, HomeFreedom};
use super::chart::moving_far;
use super::cycles::cycle_facts;
use super::depth::Depth;
use super::engines::ask_all;
use super::exact::{ExactAllowance, Whole, solved};
use super::exact_constraint::{ChangeSets, NoChangeSet, change_sets};
use super::generic::generic_count;
use super::judge::PartFinding;
use super::more_digits::MoreDigits;
use super::options::{AnalysisError, AnalysisOptions};
use super::pose_rank::{PartRank, Pose, Trial, rank_part_with};
use super::question::{Again, Means, OfWhole, Question};
use super::redundancy::SelfStresses;
use super::redundant_directions::redundant_directions;
use super::roles::{Seen, roles_seen_closer};
use super::superfluous::{contradicting, superfluous};
use super::verdict::{judge, not_asked};
use super::vocabulary::PoseKind;
use super::whole_branches::whole_branches;
use kutzbach_closure::{
    Arithmetic, Assembly, AssemblyOptions, Geometry, JointState, Part, Structure, assemble_with,
    spanning_poses,
};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::{Configuration, Mechanism, Precision};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// [`analyse`](crate::analyse) without a look at what rounded numbers may have been meant to be.
pub(super) fn analyse_as_stated(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
) -> Result<Analysis, AnalysisError> {
    analyse_as_stated_within(mechanism, &Arc::new(Structure::new(mechanism)), options)
}

/// [`analyse_as_stated`] of a mechanism whose structure is known.
pub(super) fn analyse_as_stated_within(
    mechanism: &Mechanism,
    structure: &Arc<Structure>,
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
        .flat_map(|c| c.held())
        .map(|joint| joint.0)
        .filter(|&joint| mechanism.joints()[joint].freedom() > 0)
        .collect();
    let everything = options.depth == Depth::Everything;
    let generic = everything
        .then(|| generic_count(mechanism, structure))
        .transpose()?;
    let geometry = Arc::new(Geometry::new(
        mechanism,
        configuration,
        &Arithmetic::double(),
    ));
    if let Some(joint) = geometry.degenerate_distance() {
        return Err(AnalysisError::NoDistance {
            joint: mechanism.joints()[joint].name.clone(),
        });
    }
    let allowance = RefCell::new(ExactAllowance::new(options.exact));
    let whole = Whole {
        mechanism,
        configuration,
        geometry: &geometry,
    };
    let assembled = |parts: &[Part], solve_first: bool| {
        let asked = AssemblyOptions {
            held: held.clone(),
            rounded: configuration.map(rounded).unwrap_or_default(),
            tolerance: options.closure_tolerance,
            solve_first,
        };
        assemble_with(mechanism, &geometry, parts, &asked, &|part, states| {
            solved(whole, part, states, &mut allowance.borrow_mut())
        })
    };
    let ranked = |assembly: Assembly| -> Result<Analysis, AnalysisError> {
        let (structure, drawn) = (Arc::clone(structure), Arc::clone(&geometry));
        let mut analysis = Analysis::unranked(mechanism, structure, generic, assembly, drawn);
        if analysis.assembly.closed {
            let mut allowance = allowance.borrow_mut();
            analysis.rank(mechanism, configuration, &geometry, options, &mut allowance)?;
        }
        Ok(analysis)
    };
    let analysis = ranked(assembled(&structure.parts, false)?)?;
    let elsewhere = allowance.borrow().elsewhere;
    if !elsewhere {
        return Ok(analysis);
    }
    // What closes within rounding only closes nowhere, or at another pose.
    ranked(assembled(&structure.parts, true)?)
}

/// How an engine asks all engines again.
static AGAIN: Again = Again {
    mechanism: analyse_as_stated,
    part: ask_all,
};

/// What the engines find of one part.
pub(super) fn finding_of(
    pose: &Pose<'_>,
    more: &mut MoreDigits,
    structure: &Structure,
    asked: (&Part, &PartRank),
    options: &AnalysisOptions,
    allowance: &mut ExactAllowance,
) -> Result<PartFinding, AnalysisError> {
    let question = Question::new(pose, structure, asked, options.depth);
    let whole = Some(OfWhole {
        options,
        allowance,
        again: &AGAIN,
    });
    ask_all(&question, &mut Means { more, whole })
}

/// How far the values that a configuration holds may be from those meant (rad, m), by joint index: half a unit of its finest decimal, if
/// its literals have more decimals than somebody would choose.
fn rounded(configuration: &Configuration) -> BTreeMap<usize, f64> {
    let decimals = |values: &[kutzbach_math::number::Number]| {
        values
            .iter()
            .filter_map(|value| value.stated().map(|stated| stated.decimals))
            .max()
    };
    let held = || {
        let positions = configuration.positions.iter();
        positions.filter(move |(joint, _)| !configuration.free.contains(joint))
    };
    let finest = held()
        .filter_map(|(_, values)| decimals(values))
        .max()
        .filter(|finest| *finest > Precision::EXACT_DECIMALS);
    let Some(finest) = finest else {
        return BTreeMap::new();
    };
    held()
        .filter(|(_, values)| decimals(values).is_some())
        .map(|(joint, _)| (joint.0, 0.5 * 10f64.powi(-finest.min(300))))
        .collect()
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
        configuration: Option<&Configuration>,
        geometry: &Geometry<f64>,
        options: &AnalysisOptions,
        allowance: &mut ExactAllowance,
    ) -> Result<(), AnalysisError> {
        let known = std::mem::take(&mut self.assembly.jacobians);
        let states = &self.assembly.states;
        let pose = Pose {
            mechanism,
            configuration,
            held: &self.assembly.held,
            geometry,
            states,
            as_drawn: self.assembly.steps == 0 && options.closure_tolerance.is_none(),
            trial: Trial::default(),
        };
        let mut more = MoreDigits::new();
        let mut parts = Vec::with_capacity(self.structure.parts.len());
        for (part, known) in self.structure.parts.iter().zip(known) {
            parts.push(rank_part_with(&pose, &mut more, part, known)?);
        }
        treat_alike(mechanism, &self.structure.parts, &mut parts)?;
        let home = self.home_freedom(mechanism, &parts);
        if options.depth == Depth::Rank {
            // Numbers with too few digits may hold fast what is meant to move.
            let as_meant = !parts.iter().any(|part| part.is_taken_literally());
            self.mobility = not_asked(as_meant.then_some(home.candidates.1));
        } else {
            for (part, rank) in self.structure.parts.iter().zip(&parts) {
                let asked = (part, rank);
                let structure = &self.structure;
                let found = finding_of(&pose, &mut more, structure, asked, options, allowance)?;
                self.findings.push(found);
            }
            self.mobility = judge(mechanism, &self.structure, &self.findings);
        }
        if options.depth >= Depth::Motions {
            self.branches = whole_branches(
                mechanism,
                geometry,
                &self.structure,
                states,
                self.kutzbach,
                &self.findings,
            );
        }
        if options.depth == Depth::Everything {
            let mut seen = Vec::with_capacity(parts.len());
            for ((part, rank), found) in self.structure.parts.iter().zip(&parts).zip(&self.findings)
            {
                let regular = found.pose() == Some(PoseKind::Regular);
                let moving = if regular {
                    moving_far(&pose, &mut more, part, rank)?
                } else {
                    None
                };
                seen.push(match moving {
                    Some(moving) => Seen::Moving(moving),
                    None if found.open().is_some() => Seen::Open,
                    None => Seen::Here,
                });
            }
            self.details(mechanism, geometry, &parts, &home, &seen)?;
        }
        self.home = Some(home);
        self.parts = parts;
        Ok(())
    }

    /// What moves and what is redundant at the pose, joint by joint and cycle by cycle, and what to do about it.
    fn details(
        &mut self,
        mechanism: &Mechanism,
        geometry: &Geometry<f64>,
        parts: &[PartRank],
        home: &HomeFreedom,
        seen: &[Seen],
    ) -> Result<(), MatrixError> {
        let states = &self.assembly.states;
        // What is tried part by part is tried on these and undone again, since copies for every part would add up.
        let mut trial = geometry.clone();
        let mut trial_states = states.clone();
        for &joint in &self.structure.free_joints {
            self.roles[joint].locked = (mechanism.joints()[joint].freedom() > 0).then_some(false);
            self.redundant_wrenches[joint] = Some(0);
        }
        let all = self.structure.parts.iter().zip(parts).zip(seen);
        for (index, ((part, rank), seen)) in all.enumerate() {
            for (joint, role) in part.joints.iter().zip(roles_seen_closer(
                mechanism,
                geometry,
                &mut trial_states,
                part,
                rank,
                seen,
            )?) {
                // At a regular pose every branch of the whole has the part's only one.
                if matches!(seen, Seen::Moving(_)) {
                    for branch in self.branches.iter_mut().flatten() {
                        branch.roles[*joint] = role.clone();
                    }
                }
                self.roles[*joint] = role;
            }
            let finding = &self.findings[index];
            let finite = finding.upper();
            if finding.lower() == finite && rank.instantaneous > Some(finite) {
                let parts = (part, rank);
                let structure = &self.structure;
                let found = contradicting(mechanism, geometry, states, structure, parts, finite)?;
                if !found.is_empty() {
                    self.contradicting.insert(index, found);
                }
            }
            let Some(stresses) = SelfStresses::new(part, rank)? else {
                continue;
            };
            for &joint in &part.joints {
                self.redundant_wrenches[joint] = Some(stresses.indeterminate_wrenches(rank, joint));
            }
            for (joint, found) in redundant_directions(
                self.in_order(part)
                    .into_iter()
                    .map(|joint| (joint, &trial.displacements[joint])),
                rank,
                &stresses,
            ) {
                self.directions[joint] = found;
            }
            if let Some(redundant) = home.redundant.filter(|r| *r > 0) {
                if self.findings[index].pose() == Some(PoseKind::Regular) {
                    let spare = superfluous(mechanism, part, rank, &stresses);
                    self.superfluous.extend(spare);
                }
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
        self.change_sets =
            self.sets_of_changes(mechanism, &mut trial, &mut trial_states, parts, home)?;
        let graph = &self.structure.graph;
        self.advice
            .sort_by_key(|a| (a.redundant_after, graph.edge_rank(a.joint), a.to));
        let (poses, _) = spanning_poses(mechanism, geometry, states);
        for cycle in &self.structure.cycles {
            self.cycles
                .push(cycle_facts(mechanism, geometry, states, &poses, cycle)?);
        }
        Ok(())
    }

    /// The joints of a part in an order that is not the file's.
    fn in_order(&self, part: &Part) -> Vec<usize> {
        let mut joints = part.joints.clone();
        joints.sort_by_key(|&joint| self.structure.graph.edge_rank(joint));
        joints
    }

    /// Sets of changes that leave no redundant constraint, part by part.
    fn sets_of_changes(
        &self,
        mechanism: &Mechanism,
        geometry: &mut Geometry<f64>,
        states: &mut [JointState<f64>],
        parts: &[PartRank],
        home: &HomeFreedom,
    ) -> Result<Result<Vec<ChangeSets>, NoChangeSet>, MatrixError> {
        match (home.redundant, self.mobility.finite(), home.instantaneous) {
            (Some(redundant), _, _) if redundant <= 0 => {
                return Ok(Err(NoChangeSet::NothingRedundant));
            }
            (Some(_), Some(finite), Some(here)) if finite == here => {}
            (Some(_), Some(_), Some(_)) => return Ok(Err(NoChangeSet::Singular)),
            _ => return Ok(Err(NoChangeSet::Undecided)),
        }
        let mut all = Vec::new();
        for (part, rank) in self.structure.parts.iter().zip(parts) {
            let joints = self.in_order(part);
            match change_sets(mechanism, geometry, states, (part, rank), &joints)? {
                Ok(sets) => all.push(sets),
                Err(NoChangeSet::NothingRedundant) => {}
                Err(why) => return Ok(Err(why)),
            }
        }
        Ok(Ok(all))
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
