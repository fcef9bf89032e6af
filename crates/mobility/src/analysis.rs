//! Top-level analysis of a mechanism at one pose.

use super::advice::{Advice, advice_for_part};
use super::alike::treat_alike;
use super::branch::Branch;
use super::chart::moving_far;
use super::claim::Claim;
use super::coupling_locks::LockingCoupling;
use super::cycles::{CycleFacts, cycle_facts};
use super::depth::Depth;
use super::engines::ask_all;
use super::exact::{ExactAllowance, ExactBudget, Whole, solved};
use super::exact_constraint::{ChangeSets, NoChangeSet, change_sets};
use super::generic::{GenericCount, generic_count};
use super::judge::PartFinding;
use super::kutzbach::kutzbach_count;
use super::meant::{Meant, completed};
use super::more_digits::MoreDigits;
use super::pose_rank::{PartRank, Pose, Trial, rank_part_with};
use super::question::{Means, Question};
use super::redundancy::SelfStresses;
use super::redundant_directions::{JointDirections, redundant_directions};
use super::roles::{JointRole, Seen, roles_seen_closer};
use super::superfluous::{Superfluous, contradicting, superfluous};
use super::verdict::{Mobility, judge, not_asked, unassembled};
use super::vocabulary::PoseKind;
use super::vocabulary::Verdict;
use super::whole_branches::whole_branches;
use kutzbach_closure::Structure;
use kutzbach_closure::{
    Arithmetic, Assembly, AssemblyOptions, Geometry, JointState, Part, assemble_with,
    spanning_poses,
};
use kutzbach_math::matrix::MatrixError;
use kutzbach_model::mechanism::{Configuration, Mechanism, Precision};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use thiserror::Error;

/// What to analyse.
#[derive(Clone, Debug, Default)]
pub struct AnalysisOptions {
    /// The configuration to start from; the home pose if `None`.
    pub configuration: Option<String>,
    /// How much work exact algebra may do.
    pub exact: ExactBudget,
    /// How much is to be found out.
    pub depth: Depth,
    /// The gap up to which a loop counts as closed (m; angles count by the length of the loop); what the file's digits say if
    /// `None`. Ranks are then only as certain as such a pose.
    pub closure_tolerance: Option<f64>,
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

/// The analysis of a mechanism at a pose. What its [`Depth`] leaves out is empty or `None`, as said field by field.
#[derive(Clone, Debug)]
pub struct Analysis {
    /// Topology.
    pub structure: Structure,
    /// Kutzbach's count.
    pub kutzbach: i64,
    /// The count at random geometry; `None` unless [`Depth::Everything`] is asked for.
    pub generic: Option<GenericCount>,
    /// How the mechanism closes.
    pub assembly: Assembly,
    /// The mechanism in double precision where it was analysed, before assembly: the one meant, if there is one ([`Analysis::of`]). Clones
    /// share it.
    pub geometry: Arc<Geometry<f64>>,
    /// The rank of every part, in the order of [`Structure::parts`]; empty if it does not assemble.
    pub parts: Vec<PartRank>,
    /// The instantaneous freedom; `None` if the mechanism does not assemble: an open pose is never ranked.
    pub home: Option<HomeFreedom>,
    /// Roles of all joints, by joint index; nothing known of any unless [`Depth::Everything`] is asked for.
    pub roles: Vec<JointRole>,
    /// Indeterminate reaction directions of all joints, by joint index; `None` where the rank is open.
    pub redundant_wrenches: Vec<Option<usize>>,
    /// Facts of the cycles shown; none unless [`Depth::Everything`] is asked for.
    pub cycles: Vec<CycleFacts>,
    /// Repair advice, best first; none unless [`Depth::Everything`] is asked for.
    pub advice: Vec<Advice>,
    /// Couplings and links that can be left out, each by itself, of parts in a regular pose; none unless [`Depth::Everything`] is asked
    /// for.
    pub superfluous: Vec<Superfluous>,
    /// Couplings that agree with the loops at the pose and not beyond, with the finite freedom of their part without them, by part; as far
    /// as subgroups prove it, and none unless [`Depth::Everything`] is asked for.
    pub contradicting: BTreeMap<usize, Vec<LockingCoupling>>,
    /// Sets of joints to relax after which no constraint is redundant and the finite mobility is what it was: an entry for each
    /// part with redundant constraints, of which one set each is to be taken; or why there are none.
    pub change_sets: Result<Vec<ChangeSets>, NoChangeSet>,
    /// Where redundant constraints act, by joint index; empty for joints without any, and unless [`Depth::Everything`] is
    /// asked for.
    pub directions: Vec<JointDirections>,
    /// What the engines found of every part, in the order of [`Structure::parts`]; none at [`Depth::Rank`].
    pub findings: Vec<PartFinding>,
    /// The branches through the pose; `None` while not decided, where there are too many to list, or below
    /// [`Depth::Motions`].
    pub branches: Option<Vec<Branch>>,
    /// The verdict.
    pub mobility: Mobility,
    /// The mechanism that rounded numbers mean, where everything here is said of it instead of the file's own numbers.
    pub meant: Option<Box<Meant>>,
    /// The mechanism nearest to rounded numbers that closes along a motion, where the verdict hangs on how they were rounded and one
    /// was found: within their digits or not.
    pub nearest: Option<Box<Meant>>,
}

/// Analyses a mechanism: counts, assembles, ranks, names what is locked and redundant.
///
/// # Errors
/// [`AnalysisError`]; see there.
pub fn analyse(
    mechanism: &Mechanism,
    options: &AnalysisOptions,
) -> Result<Analysis, AnalysisError> {
    let stated = analyse_as_stated(mechanism, options)?;
    let analysis = completed(mechanism, options, stated)?;
    let undecided = analysis.mobility.verdict == Verdict::Undecided && analysis.assembly.closed;
    let Some(tolerance) = options.closure_tolerance.filter(|_| undecided) else {
        return Ok(analysis);
    };
    // What stays open at the pose drowns what happens near it. Loops that count as closed within a gap have dimensions that are known
    // to within that gap: read like this, the file may say what was meant.
    let coarse = mechanism.clone().with_precision(tolerance);
    let options = AnalysisOptions {
        closure_tolerance: None,
        ..options.clone()
    };
    let mut meant = completed(&coarse, &options, analyse_as_stated(&coarse, &options)?)?;
    if let Some(nominal) = &mut meant.mobility.nominal {
        nominal.known_to = Some(tolerance);
    }
    Ok(match meant.mobility.finite() {
        Some(_) => meant,
        None => analysis,
    })
}

/// [`analyse`] without a look at what rounded numbers may have been meant to be.
pub(super) fn analyse_as_stated(
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
        .flat_map(|c| c.held())
        .map(|joint| joint.0)
        .filter(|&joint| mechanism.joints()[joint].freedom() > 0)
        .collect();
    let structure = Structure::new(mechanism);
    let everything = options.depth == Depth::Everything;
    let generic = everything
        .then(|| generic_count(mechanism, &structure))
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
    let ranked = |assembly: Assembly, structure: Structure| -> Result<Analysis, AnalysisError> {
        let drawn = Arc::clone(&geometry);
        let mut analysis = Analysis::unranked(mechanism, structure, generic, assembly, drawn);
        if analysis.assembly.closed {
            let mut allowance = allowance.borrow_mut();
            analysis.rank(mechanism, configuration, &geometry, options, &mut allowance)?;
        }
        Ok(analysis)
    };
    let analysis = ranked(assembled(&structure.parts, false)?, structure)?;
    let elsewhere = allowance.borrow().elsewhere;
    if !elsewhere {
        return Ok(analysis);
    }
    // What closes within rounding only closes nowhere, or at another pose.
    let structure = analysis.structure;
    ranked(assembled(&structure.parts, true)?, structure)
}

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
    let whole = Some((options, allowance));
    ask_all(&question, &mut Means { more, whole })
}

/// How far the values of a configuration may be from those meant (rad, m), by joint index: half a unit of its finest decimal, if
/// its literals have more decimals than somebody would choose.
fn rounded(configuration: &Configuration) -> BTreeMap<usize, f64> {
    let decimals = |values: &[kutzbach_math::number::Number]| {
        values
            .iter()
            .filter_map(|value| value.stated().map(|stated| stated.decimals))
            .max()
    };
    let finest = configuration
        .positions
        .iter()
        .filter_map(|(_, values)| decimals(values))
        .max()
        .filter(|finest| *finest > Precision::EXACT_DECIMALS);
    let Some(finest) = finest else {
        return BTreeMap::new();
    };
    configuration
        .positions
        .iter()
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
    /// Before anything is known of the pose.
    fn unranked(
        mechanism: &Mechanism,
        structure: Structure,
        generic: Option<GenericCount>,
        assembly: Assembly,
        geometry: Arc<Geometry<f64>>,
    ) -> Self {
        let joints = mechanism.joints().len();
        Self {
            mobility: unassembled(&assembly),
            structure,
            kutzbach: kutzbach_count(mechanism),
            generic,
            assembly,
            geometry,
            parts: Vec::new(),
            home: None,
            roles: vec![JointRole::default(); joints],
            redundant_wrenches: vec![None; joints],
            cycles: Vec::new(),
            advice: Vec::new(),
            superfluous: Vec::new(),
            contradicting: BTreeMap::new(),
            change_sets: Err(NoChangeSet::Undecided),
            directions: vec![JointDirections::default(); joints],
            findings: Vec::new(),
            branches: None,
            meant: None,
            nearest: None,
        }
    }

    /// What every engine claims, with the index of the part: part by part, in the order asked.
    pub fn claims(&self) -> impl Iterator<Item = (usize, &Claim)> {
        let parts = self.findings.iter().enumerate();
        parts.flat_map(|(index, found)| found.claims().iter().map(move |claim| (index, claim)))
    }

    /// The mechanism that everything here is said of: the one meant, or the one given.
    #[must_use]
    pub fn of<'a>(&'a self, given: &'a Mechanism) -> &'a Mechanism {
        self.meant.as_ref().map_or(given, |meant| &meant.mechanism)
    }

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

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use kutzbach_closure::samples::{
        CRANK_ROCKER, Written, add_ring, four_bar, general_four, planar,
    };
    use kutzbach_math::number::Number;
    use kutzbach_model::mechanism::{Frame, JointBuilder, JointKind, MechanismBuilder};

    #[test]
    fn configurations_are_looked_up_by_name() {
        let options = AnalysisOptions {
            configuration: Some("open".to_owned()),
            ..AnalysisOptions::default()
        };
        let error = analyse(&four_bar(), &options).unwrap_err();
        assert!(error.to_string().contains("`open`") && error.to_string().contains("none"));
    }

    #[test]
    fn held_joints_keep_their_value_and_their_freedom() {
        let mut builder = MechanismBuilder::new("held");
        builder.link("ground");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        let value = Number::from_f64(0.5).unwrap();
        builder.configuration("turned", vec![("r_a".to_owned(), vec![value])]);
        let mechanism = builder.build().unwrap();
        let options = AnalysisOptions {
            configuration: Some("turned".to_owned()),
            ..AnalysisOptions::default()
        };
        let analysis = analyse(&mechanism, &options).unwrap();
        assert_eq!(analysis.assembly.states[0].values, [0.5]);
        // The pose is one where the crank has this value; that it is held there is no constraint.
        assert_eq!(analysis.home.unwrap().instantaneous, Some(1));
        assert_eq!(analysis.roles[0].locked, Some(false));
    }

    #[test]
    fn every_depth_says_what_the_deeper_ones_say() {
        for mechanism in [four_bar(), general_four()] {
            let at = |depth| {
                let options = AnalysisOptions {
                    depth,
                    ..AnalysisOptions::default()
                };
                analyse(&mechanism, &options).unwrap()
            };
            let [rank, verdict, motions, everything] = [
                Depth::Rank,
                Depth::Verdict,
                Depth::Motions,
                Depth::Everything,
            ]
            .map(at);
            for analysis in [&rank, &verdict, &motions] {
                assert_eq!(analysis.home, everything.home);
                assert_eq!(analysis.kutzbach, everything.kutzbach);
                assert!(analysis.generic.is_none() && analysis.advice.is_empty());
            }
            assert_eq!(rank.mobility.finite(), None);
            assert_eq!(
                rank.mobility.bounds.1,
                everything.home.as_ref().unwrap().instantaneous
            );
            for analysis in [&verdict, &motions] {
                let (one, other) = (&analysis.mobility, &everything.mobility);
                assert_eq!(one.finite(), other.finite());
                assert_eq!(
                    (one.pose, one.kind, one.class),
                    (other.pose, other.kind, other.class)
                );
            }
            assert!(verdict.branches.is_none());
            let shapes = |analysis: &Analysis| {
                let branches = analysis.branches.as_ref().unwrap();
                branches
                    .iter()
                    .map(|b| (b.dimension, b.roles.clone()))
                    .collect::<Vec<_>>()
            };
            assert_eq!(shapes(&motions), shapes(&everything));
        }
    }

    #[test]
    fn two_points_that_coincide_have_no_distance() {
        let mut builder = MechanismBuilder::new("rod");
        builder.link("ground").link("arm");
        builder.joint(JointBuilder::tree(
            "pin",
            JointKind::Revolute,
            "ground",
            "arm",
        ));
        builder.joint(JointBuilder::closing(
            "rod",
            JointKind::Distance,
            "ground",
            "arm",
        ));
        let error = analyse(&builder.build().unwrap(), &AnalysisOptions::default()).unwrap_err();
        assert!(matches!(error, AnalysisError::NoDistance { joint } if joint == "rod"));
    }

    #[test]
    fn freedoms_add_up_over_the_parts() {
        let mut builder = MechanismBuilder::new("sum");
        builder.link("ground").link("arm").link("stone");
        add_ring(
            &mut builder,
            "r",
            "ground",
            &planar(&CRANK_ROCKER),
            [0.0; 3],
            Written::Exactly,
        );
        builder.joint(
            JointBuilder::tree("arm_joint", JointKind::Universal, "r1", "arm").axis2(
                kutzbach_model::mechanism::Direction([
                    Number::zero(),
                    Number::one(),
                    Number::zero(),
                ]),
            ),
        );
        builder.floating("drop", "ground", "stone", Frame::identity());
        let analysis = analyse(&builder.build().unwrap(), &AnalysisOptions::default()).unwrap();
        let home = analysis.home.unwrap();
        assert_eq!(home.instantaneous, Some(1 + 2 + 6));
        assert_eq!(home.candidates, (9, 9));
        assert_eq!(home.redundant, Some(9 - analysis.kutzbach));
        assert_eq!(
            analysis
                .redundant_wrenches
                .iter()
                .filter(|w| **w == Some(0))
                .count(),
            1
        );
    }

    #[test]
    fn a_mechanism_of_one_link_stands() {
        let block = MechanismBuilder::new("block")
            .link("ground")
            .clone()
            .build()
            .unwrap();
        let analysis = analyse(&block, &AnalysisOptions::default()).unwrap();
        assert!(analysis.assembly.closed);
        assert_eq!(analysis.home.unwrap().instantaneous, Some(0));
    }

    #[test]
    fn the_order_of_the_file_changes_no_result() {
        let plain = analyse(&general_four(), &AnalysisOptions::default()).unwrap();
        assert_eq!(plain.generic.unwrap().mobility, 0);
        let rings = |first: &str, second: &str| {
            let mut builder = MechanismBuilder::new("two");
            builder.link("ground");
            for name in [first, second] {
                let gap = if name == "p" {
                    [0.5, -0.25, 0.0]
                } else {
                    [0.0; 3]
                };
                add_ring(
                    &mut builder,
                    name,
                    "ground",
                    &planar(&CRANK_ROCKER),
                    gap,
                    Written::Exactly,
                );
            }
            let mechanism = builder.build().unwrap();
            let analysis = analyse(&mechanism, &AnalysisOptions::default()).unwrap();
            let advice: Vec<String> = analysis
                .advice
                .iter()
                .map(|a| {
                    format!(
                        "{} {} {}",
                        mechanism.joints()[a.joint].name,
                        a.to,
                        a.redundant_after
                    )
                })
                .collect();
            (analysis.home, advice, analysis.assembly.residual.to_bits())
        };
        assert_eq!(rings("p", "q"), rings("q", "p"));
    }

    #[test]
    fn many_loops_are_each_looked_at_once() {
        // Each has to be assembled. Work that grew with the square of their number would take minutes.
        let mut builder = MechanismBuilder::new("many");
        builder.link("ground");
        for i in 0..2000 {
            let name = format!("ring_{i}_");
            let gap = [0.25, 0.125, 0.0];
            add_ring(
                &mut builder,
                &name,
                "ground",
                &planar(&CRANK_ROCKER),
                gap,
                Written::Exactly,
            );
        }
        let mechanism = builder.build().unwrap();
        let geometry = Geometry::new(&mechanism, None, &Arithmetic::double());
        let parts = Structure::new(&mechanism).parts;
        let assembly =
            kutzbach_closure::assemble(&mechanism, &geometry, &parts, &BTreeSet::new()).unwrap();
        assert!(assembly.closed);
        assert_eq!(parts.len(), 2000);
        assert_eq!(JointKind::Revolute.freedom() * 8000, mechanism.freedom());
    }
}
