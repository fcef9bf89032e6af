//! Fills the analysis fields of a [`Report`] that holds counts only.

use super::change_sets::{change_sets, directions};
use super::motions::motion_row;
use super::natural::natural_order;
use super::schema::{
    Advice, AsWritten, Assembly, Block, Branch, Certificate, Change, Cycle, Gap, GenericCount,
    Home, Idle, JointRow, Mobility, Motion, Nominal, Relation, Report, Tree, TreeLink, Warning,
    WarningKind,
};
use super::text::words::counted;
use kutzbach_closure::{owners, with_owners};
use kutzbach_math::matrix::Method;
use kutzbach_mobility::{
    Analysis, IdleLink, JointRole, LockingCoupling, PartFinding, PartRank, Spare,
    freedom_locked_by_couplings, locking_couplings,
};
use kutzbach_model::mechanism::{Joint, JointKind, Mechanism};
use std::collections::BTreeSet;

/// The end of the warning of pieces that nothing holds; what they count for stands in [`Report::freedoms`] too.
const LOOSE: &str = "of the links are connected to the ground by no joint at all; each such piece counts with six freedoms";

/// What follows the name of a block in the warning that it would move without its couplings.
const LOCKED_TOGETHER: &str =
    ": its couplings and its loops lock it together; by the loops alone it would have";

/// Fills in everything that the analysis decided. Linear in the size of both.
pub(super) fn lay_over(report: &mut Report, mechanism: &Mechanism, analysis: &Analysis) {
    report.generic = analysis.generic.map(|generic| GenericCount {
        mobility: usize::try_from(generic.mobility).unwrap_or(0),
        redundant: generic.redundant,
    });
    report.assembly = super::assembly::assembly(mechanism, &analysis.assembly);
    report.assembly.dimensions_changed = analysis.meant.is_some();
    fill_home(&mut report.home, analysis);
    report.mobility = verdict(mechanism, analysis);
    report.freedoms = super::inputs::freedoms(mechanism, analysis);
    report.joints = joint_rows(mechanism, analysis);
    report.branches = branch_rows(mechanism, analysis);
    report.motions = motion_rows(mechanism, analysis);
    report.cycles = cycle_rows(mechanism, analysis);
    report.tree = Some(tree(analysis));
    report.advice = analysis
        .advice
        .iter()
        .map(|a| advice(mechanism, a))
        .chain(removals(mechanism, analysis))
        .collect();
    report.advice.sort_by_key(|a| a.redundant_after);
    report.change_sets = change_sets(mechanism, analysis);
    if !analysis.structure.cycles_are_fundamental {
        let text = "the fundamental cycles of the spanning tree are too long to list; the cycles shown are a shortest basis";
        report
            .warnings
            .push(Warning::new(WarningKind::Cycles, text));
    }
    let literal: Vec<usize> = (0..analysis.parts.len())
        .filter(|&index| analysis.parts[index].is_taken_literally())
        .collect();
    if !literal.is_empty() {
        let text = "the numbers are stated so coarsely, for a mechanism of this size, that rounding would leave the rank \
                    open; they were taken literally";
        let text = &format!("{text}{}", known_better(mechanism, &report.assembly));
        // Of all blocks or of the only one: then the whole mechanism is meant.
        let text = if literal.len() == analysis.parts.len() {
            text.to_owned()
        } else {
            let owners = owners(&analysis.structure.part_names, &literal);
            format!("{owners}: {text}")
        };
        let warning = Warning::new(WarningKind::TakenLiterally, text);
        report.warnings.push(warning);
    }
    locked_by_couplings(report, mechanism, analysis);
    if analysis.structure.loose_pieces > 0 {
        let text = format!("{} {LOOSE}", analysis.structure.loose_pieces);
        report
            .warnings
            .push(Warning::new(WarningKind::LooseLinks, text));
    }
}

/// What to say of numbers that are better known than the coarsest of them looks: half a unit of the finest decimal, as most are, or
/// what the gaps of the loops leave possible.
fn known_better(mechanism: &Mechanism, assembly: &Assembly) -> String {
    let precision = mechanism.precision();
    let (Some(decimals), None) = (precision.decimals, precision.by_hand()) else {
        return String::new();
    };
    let left = |gap: &Gap| gap.left_position.max(gap.left_angle);
    let open = assembly.gaps.iter().map(left).fold(0.0, f64::max);
    let gap = match open > 0.0 {
        true => -(open / 5.0).log10().ceil() as i32,
        false => i32::MAX,
    };
    let place = gap.min(decimals + 1);
    match (place <= decimals, place >= 1) {
        (false, true) => format!(
            " (`--precision 5e-{place}` says that all are known to half a unit of the finest decimal)"
        ),
        (true, true) => format!(
            " (`--precision 5e-{place}` says that all are known to so much (m, rad), which the gaps need)"
        ),
        _ => String::new(),
    }
}

/// Names the blocks that would move without their couplings.
fn locked_by_couplings(report: &mut Report, mechanism: &Mechanism, analysis: &Analysis) {
    let structure = &analysis.structure;
    for (index, (part, rank)) in structure.parts.iter().zip(&analysis.parts).enumerate() {
        let Some(freedom) = freedom_locked_by_couplings(part, rank) else {
            continue;
        };
        let text = format!(
            "{}{LOCKED_TOGETHER} {} at this pose{}",
            owners(&structure.part_names, &[index]),
            counted(freedom, "instantaneous freedom"),
            culprits(mechanism, &locking_couplings(part, rank)),
        );
        let warning = Warning::new(WarningKind::LockedTogether, text);
        report.warnings.push(warning);
    }
    for (part, couplings) in &analysis.contradicting {
        let text = format!(
            "{}: a coupling agrees with its loops at this pose only{}",
            owners(&structure.part_names, &[*part]),
            culprits(mechanism, couplings),
        );
        let warning = Warning::new(WarningKind::LockedTogether, text);
        report.warnings.push(warning);
    }
}

/// Couplings that are named as what locks a block.
const CULPRITS: usize = 4;

/// Which couplings lock a block: those with which the others agree once their sign is turned over, else those that free it by
/// themselves where these are few.
fn culprits(mechanism: &Mechanism, found: &[LockingCoupling]) -> String {
    let wrong: Vec<&LockingCoupling> = found.iter().filter(|one| one.other_sign).collect();
    let (told, how) = match wrong.is_empty() {
        true => (found.iter().collect(), "without"),
        false => (wrong, "with the other sign of"),
    };
    let freedom = told.iter().map(|one| one.freedom).max().unwrap_or(0);
    if told.is_empty() || told.len() > CULPRITS {
        return String::new();
    }
    let names: Vec<String> = told
        .iter()
        .map(|one| format!("`{}`", mechanism.couplings()[one.coupling].name))
        .collect();
    format!("; {how} {} it has {freedom}", names.join(", or of "))
}

fn fill_home(home: &mut Home, analysis: &Analysis) {
    let Some(found) = &analysis.home else { return };
    let parts = &analysis.parts;
    home.pose = analysis.mobility.pose;
    home.kind = analysis.mobility.kind;
    home.instantaneous = found.instantaneous;
    home.candidates = [found.candidates.0, found.candidates.1];
    home.as_written = found.as_written;
    home.redundant = found.redundant;
    home.rank = found
        .instantaneous
        .map(|freedom| home.unknowns.saturating_sub(freedom));
    // The weakest part speaks for the whole.
    let weakest = parts
        .iter()
        .enumerate()
        .filter(|(_, part)| part.unknowns() > 0 && part.equations() > 0)
        .min_by(|a, b| margin(a.1).total_cmp(&margin(b.1)));
    let labels = &analysis.structure.part_names;
    if let Some((index, part)) = weakest {
        home.weakest = labels.get(index).filter(|_| parts.len() > 1).cloned();
        let decision = &part.decision;
        home.gap = decision.gap.is_finite().then_some(decision.gap);
        home.kept = Some(decision.kept);
        home.dropped = Some(decision.dropped);
        home.tolerance = Some(decision.tolerance);
        home.accuracy = Some(decision.accuracy);
        home.method = match decision.method {
            Method::Svd => "singular values",
            Method::Jacobi => "singular values by Jacobi rotations",
            Method::SparseQr => "sparse QR with estimated singular values",
        }
        .to_owned();
        home.bits = parts.iter().map(|part| part.bits).max();
    }
    let notes: Vec<(usize, String)> = parts
        .iter()
        .enumerate()
        .filter_map(|(index, part)| Some((index, part.note.as_ref()?.to_string())))
        .collect();
    let notes = notes.iter().map(|(index, note)| (*index, &**note));
    let notes = with_owners(labels, notes);
    home.note = (!notes.is_empty()).then(|| notes.join("; "));
    home.blocks = blocks(analysis);
}

fn blocks(analysis: &Analysis) -> Vec<Block> {
    let structure = &analysis.structure;
    let all = structure.parts.iter().zip(&structure.part_names);
    all.zip(&analysis.parts)
        .enumerate()
        .map(|(index, ((part, label), rank))| {
            let found = analysis.findings.get(index);
            let decided =
                |found: &&PartFinding| found.open().is_none() && found.lower() == found.upper();
            Block {
                name: part.joints.first().map_or_else(String::new, |joint| {
                    structure.graph.edge_name(*joint).to_owned()
                }),
                label: label.clone(),
                joints: part.joints.len(),
                unknowns: rank.unknowns(),
                rank: rank.instantaneous.map(|freedom| rank.unknowns() - freedom),
                instantaneous: rank.instantaneous,
                finite: found.filter(decided).map(PartFinding::upper),
                pose: found.and_then(PartFinding::pose),
                kind: found.and_then(PartFinding::kind),
                class: found.filter(|f| f.upper() > 0).and_then(PartFinding::class),
            }
        })
        .collect()
}

/// How far the decision of a part is from being another: the smaller of its clearances from the tolerance on both sides.
pub(super) fn margin(part: &PartRank) -> f64 {
    let decision = &part.decision;
    let above = if decision.kept > 0.0 {
        decision.kept / decision.tolerance
    } else {
        f64::INFINITY
    };
    let below = if decision.dropped > 0.0 {
        decision.tolerance / decision.dropped
    } else {
        f64::INFINITY
    };
    above.min(below)
}

/// A changed number by its joint and its place in the file.
fn change_of(mechanism: &Mechanism, change: &kutzbach_mobility::Change) -> Change {
    let place = change.place;
    let number = match place {
        0..12 => {
            let side = ["origin", "successor"][place / 6];
            let kind = ["xyz", "rpy"][place % 6 / 3];
            format!("{side} {kind}[{}]", place % 3)
        }
        12..15 => format!("axis[{}]", place - 12),
        15..18 => format!("axis2[{}]", place - 15),
        18 => "lead".to_owned(),
        _ => "distance".to_owned(),
    };
    Change {
        joint: mechanism.joints()[change.joint].name.clone(),
        number,
        from: change.from,
        to: change.to,
    }
}

fn verdict(mechanism: &Mechanism, analysis: &Analysis) -> Mobility {
    let found = &analysis.mobility;
    Mobility {
        verdict: found.verdict,
        finite: found.finite(),
        bounds: [found.bounds.0, found.bounds.1],
        complex_dimension: found.complex_dimension,
        class: found.class,
        certificate: Some(Certificate {
            level: found.level,
            text: found.certificate.clone(),
        }),
        nominal: found.nominal.as_ref().map(|nominal| Nominal {
            finite: nominal.finite,
            tolerance: nominal.tolerance,
            distance: nominal.distance,
            known_to: nominal.known_to,
            within_digits: nominal.within_digits,
            noise: nominal.noise,
            changes: nominal
                .changes
                .iter()
                .map(|change| change_of(mechanism, change))
                .collect(),
            relations: nominal
                .kept
                .iter()
                .map(|kept| Relation {
                    kind: kept.kind,
                    joints: kept
                        .joints
                        .iter()
                        .map(|&joint| mechanism.joints()[joint].name.clone())
                        .collect(),
                    degrees: kept.angle.map(|angle| angle.to_degrees().round()),
                })
                .collect(),
        }),
        as_written: found.as_written.map(|written| AsWritten {
            verdict: written.verdict,
            finite: written.finite,
        }),
        why: found.why.clone(),
    }
}

/// Whether a joint rests on every branch; at the pose itself where there is none, or none is known.
pub(super) fn joint_role(analysis: &Analysis, joint: usize) -> JointRole {
    let Some(branches) = analysis.branches.as_ref().filter(|b| !b.is_empty()) else {
        return analysis.roles[joint].clone();
    };
    let roles: Vec<&JointRole> = branches
        .iter()
        .filter_map(|branch| branch.roles.get(joint))
        .collect();
    let locked = if roles.iter().any(|role| role.locked == Some(false)) {
        Some(false)
    } else if roles.iter().all(|role| role.locked == Some(true)) {
        Some(true)
    } else {
        None
    };
    let Some((first, others)) = roles.split_first() else {
        return analysis.roles[joint].clone();
    };
    JointRole {
        locked,
        locked_parts: first
            .locked_parts
            .iter()
            .filter(|part| others.iter().all(|role| role.locked_parts.contains(part)))
            .cloned()
            .collect(),
    }
}

fn branch_rows(mechanism: &Mechanism, analysis: &Analysis) -> Option<Vec<Branch>> {
    let link = |index: usize| mechanism.links()[index].name.clone();
    let branches = analysis.branches.as_ref()?;
    let rows = branches.iter().map(|branch| {
        let mut locked: Vec<String> = mechanism
            .joints()
            .iter()
            .zip(&branch.roles)
            .flat_map(|(joint, role)| {
                if role.locked == Some(true) {
                    vec![joint.name.clone()]
                } else {
                    role.locked_parts.clone()
                }
            })
            .collect();
        locked.sort_by(|a, b| natural_order(a, b));
        let idle_rows = |found: &[IdleLink]| {
            let mut idle: Vec<Idle> = found
                .iter()
                .map(|idle| Idle {
                    links: [idle.link]
                        .iter()
                        .chain(&idle.with)
                        .map(|&l| link(l))
                        .collect(),
                    freedom: idle.freedom,
                    rod: idle.rod,
                })
                .collect();
            idle.sort_by(|a, b| natural_order(&a.links[0], &b.links[0]));
            idle
        };
        Branch {
            name: branch.name.clone(),
            dimension: branch.dimension,
            instantaneous: branch.instantaneous,
            redundant: branch.redundant,
            half_branches: branch.half_branches,
            locked,
            idle: idle_rows(&branch.idle),
            nearly_idle: idle_rows(&branch.nearly_idle),
        }
    });
    Some(rows.collect())
}

fn motion_rows(mechanism: &Mechanism, analysis: &Analysis) -> Vec<Motion> {
    let mut rows: Vec<Motion> = analysis
        .branches
        .iter()
        .flatten()
        .flat_map(|branch| branch.motions.iter().map(move |motion| (branch, motion)))
        .map(|(branch, motion)| motion_row(mechanism, &branch.name, motion))
        .collect();
    rows.sort_by(|a, b| {
        a.branch
            .len()
            .cmp(&b.branch.len())
            .then_with(|| a.branch.cmp(&b.branch))
            .then_with(|| natural_order(&a.link, &b.link))
    });
    rows
}

fn joint_rows(mechanism: &Mechanism, analysis: &Analysis) -> Vec<JointRow> {
    let mut block_of = vec![None; mechanism.joints().len()];
    for (index, part) in analysis.structure.parts.iter().enumerate() {
        for &joint in &part.joints {
            block_of[joint] = Some(index);
        }
    }
    let mut rows: Vec<JointRow> = mechanism
        .joints()
        .iter()
        .enumerate()
        .map(|(index, joint)| (joint, joint_role(analysis, index)))
        .zip(&analysis.redundant_wrenches)
        .enumerate()
        .map(|(index, ((joint, role), wrenches))| JointRow {
            name: joint.name.clone(),
            class: joint.kind.class().to_owned(),
            kind: joint.kind.word().to_owned(),
            links: [&joint.predecessor, &joint.successor]
                .map(|side| mechanism.link(side.link).name.clone()),
            freedom: joint.freedom(),
            locked: role.locked,
            locked_parts: role.locked_parts,
            redundant_wrenches: *wrenches,
            redundant_directions: directions(analysis, index),
            closes_loop: joint.closes_loop,
            block: block_of[index].map(|part| analysis.structure.part_names[part].clone()),
            ranges: Vec::new(),
        })
        .collect();
    rows.sort_by(|a, b| natural_order(&a.name, &b.name));
    rows
}

fn cycle_rows(mechanism: &Mechanism, analysis: &Analysis) -> Vec<Cycle> {
    let name = |joint: usize| mechanism.joints()[joint].name.clone();
    if analysis.cycles.is_empty() {
        // Not assembled: the cycles are there, but nothing can be said of their motions.
        return analysis
            .structure
            .cycles
            .iter()
            .enumerate()
            .map(|(index, cycle)| Cycle {
                name: format!("C{}", index + 1),
                joints: cycle.edges.iter().map(|(edge, _)| name(*edge)).collect(),
                space: None,
                space_text: String::new(),
                dimension: None,
                rank: None,
                redundant: None,
                mobility: None,
                locks: Vec::new(),
            })
            .collect();
    }
    analysis
        .cycles
        .iter()
        .enumerate()
        .map(|(index, facts)| Cycle {
            name: format!("C{}", index + 1),
            joints: facts.joints.iter().map(|(joint, _)| name(*joint)).collect(),
            space: facts
                .space
                .as_ref()
                .map(|space| space.short_name().to_owned()),
            space_text: facts
                .space
                .as_ref()
                .map(ToString::to_string)
                .unwrap_or_default(),
            dimension: facts.space_dimension,
            rank: facts.rank,
            redundant: facts.redundant.and_then(|r| i64::try_from(r).ok()),
            mobility: facts.mobility,
            locks: facts.locks.clone(),
        })
        .collect()
}

fn tree(analysis: &Analysis) -> Tree {
    let graph = &analysis.structure.graph;
    let tree = &analysis.structure.tree;
    let root = tree
        .roots()
        .first()
        .copied()
        .unwrap_or_else(|| graph.ground());
    let links = tree
        .order()
        .iter()
        .filter_map(|&node| {
            let up = tree.parent(node)?;
            Some(TreeLink {
                link: graph.node_name(node).to_owned(),
                parent: graph.node_name(up.node).to_owned(),
                joint: graph.edge_name(up.edge).to_owned(),
                depth: tree.depth(node),
            })
        })
        .collect();
    Tree {
        root: graph.node_name(root).to_owned(),
        depth: tree.height(),
        links,
    }
}

fn advice(mechanism: &Mechanism, advice: &kutzbach_mobility::Advice) -> Advice {
    let joint = &mechanism.joints()[advice.joint];
    let gained = advice.redundant_before - advice.redundant_after;
    let how = match (joint.kind, advice.to) {
        (JointKind::Revolute, JointKind::Cylindrical) => "let it slide along its axis".to_owned(),
        (
            JointKind::Prismatic | JointKind::PlanarTranslation,
            JointKind::Cylindrical | JointKind::Planar,
        ) => "let it turn about its axis".to_owned(),
        (JointKind::Revolute, JointKind::Universal) => match advice.second_axis {
            Some([x, y, z]) => format!(
                "let it tilt about ({}, {}, {}) of its own frame",
                round(x),
                round(y),
                round(z)
            ),
            None => "let it tilt about a second axis".to_owned(),
        },
        (_, JointKind::Spherical) => "make it a ball joint".to_owned(),
        (_, JointKind::Translational) => "let it translate in every direction".to_owned(),
        (_, JointKind::Schoenflies) => "let it move along its axis too".to_owned(),
        (JointKind::Screw, _) => "let it turn and slide independently".to_owned(),
        (_, to) => format!("make it {to}"),
    };
    let (from, to) = (joint.kind.class(), advice.to.class());
    let removed = if gained == 1 {
        "1 redundant constraint".to_owned()
    } else {
        format!("{gained} redundant constraints")
    };
    Advice {
        text: format!(
            "{}: {from} → {to}, {how}; removes {removed} and adds no degree of freedom at this pose",
            joint.name
        ),
        joint: joint.name.clone(),
        from: from.to_owned(),
        to: to.to_owned(),
        redundant_before: advice.redundant_before,
        redundant_after: advice.redundant_after,
    }
}

/// Joints all of whose constraints are redundant: without them everything moves as before. A coupling would go with its joint.
fn removals(mechanism: &Mechanism, analysis: &Analysis) -> Vec<Advice> {
    let Some(redundant) = analysis.home.as_ref().and_then(|home| home.redundant) else {
        return Vec::new();
    };
    let couplings = mechanism.couplings().iter();
    let coupled: BTreeSet<usize> = couplings
        .flat_map(|coupling| coupling.terms.iter().map(|term| term.joint.0))
        .collect();
    let joints = mechanism.joints().iter().enumerate();
    let removal = |(index, joint): (usize, &Joint)| {
        let constraints = 6_usize.checked_sub(joint.freedom()).filter(|n| *n > 0)?;
        let all = analysis.redundant_wrenches[index] == Some(constraints);
        (all && !coupled.contains(&index)).then(|| Advice {
            text: format!(
                "{}: remove it; all of its {constraints} constraints are redundant at this pose",
                joint.name
            ),
            joint: joint.name.clone(),
            from: joint.kind.class().to_owned(),
            to: "none".to_owned(),
            redundant_before: redundant,
            redundant_after: redundant - constraints as i64,
        })
    };
    let mut all: Vec<Advice> = joints.filter_map(removal).collect();
    all.extend(analysis.superfluous.iter().map(|spare| {
        let (name, from) = match spare.what {
            Spare::Coupling(index) => (&mechanism.couplings()[index].name, "coupling"),
            Spare::Link(index) => (&mechanism.links()[index].name, "link"),
        };
        Advice {
            text: format!("{name}: remove this {from}; what it asks for the rest asks for too"),
            joint: name.clone(),
            from: from.to_owned(),
            to: "none".to_owned(),
            redundant_before: redundant,
            redundant_after: redundant - spare.redundant as i64,
        }
    }));
    all.sort_by(|a, b| natural_order(&a.joint, &b.joint));
    all
}

/// Four decimals, without a sign on zero.
fn round(x: f64) -> f64 {
    (x * 1e4).round() / 1e4 + 0.0
}
