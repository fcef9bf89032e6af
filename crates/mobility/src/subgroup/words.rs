//! The sentences of the answers.

use super::chain::{self, Piece};
use super::counting::Counted;
use super::one_loop::Proof;
use crate::PartRank;
use kutzbach_closure::{Part, Rigid};
use kutzbach_math::group::{DisplacementSubgroup, GroupError, Pose, Subalgebra, SubgroupKind};
use kutzbach_model::mechanism::Mechanism;
use nalgebra::{Matrix3, Vector3};
use std::collections::{BTreeMap, BTreeSet};

/// More names than this are not listed.
const MOST_NAMES: usize = 12;

/// More reductions than this are not told in one sentence.
const MOST_STEPS: usize = 3;

/// How the numbers are read, as the beginning of a sentence.
pub fn reading(rank: &PartRank) -> &'static str {
    if rank.taken_literally {
        "taking the numbers literally, "
    } else if rank.stated > 0.0 {
        "within the stated precision, "
    } else {
        ""
    }
}

/// A part whose equations are all independent.
pub fn independent(part: &Part, equations: usize, reading: &str) -> String {
    match (part.cycles.len(), part.couplings.len()) {
        (0, 1) => format!("{reading}its only equation, that of a coupling, is independent"),
        (0, _) => format!("{reading}the {equations} coupling equations are independent"),
        (1, 0) => format!(
            "{reading}the displacements of the loop lie in no smaller group than that of all, and its six equations are \
             independent"
        ),
        (_, 0) => format!(
            "{reading}the displacements of each loop lie in no smaller group than that of all, and the {equations} \
             equations are independent"
        ),
        _ => format!(
            "{reading}the displacements of each loop lie in no smaller group than that of all, and the {equations} \
             equations, those of the couplings among them, are independent"
        ),
    }
}

/// A part whose freedom follows from bounds between all its links.
pub fn counted(mechanism: &Mechanism, counted: &Counted) -> String {
    let independent = equations(counted.equations);
    let independent = independent.trim_end_matches(" are").trim_end_matches(" is");
    if counted.by_cycles_alone {
        return format!(
            "of the displacements around the loops, those of each lie in a subgroup; the {independent} that this leaves, for loops \
             whose subgroups are the smallest, are independent"
        );
    }
    let mut clauses = Vec::new();
    if !counted.held.is_empty() {
        clauses.push(format!(
            "leave {} no motion",
            list(mechanism, &counted.held)
        ));
    }
    if !counted.confined.is_empty() {
        let joints: Vec<usize> = counted.confined.iter().map(|(joint, _)| *joint).collect();
        let less = list(mechanism, &joints);
        clauses.push(format!("leave {less} a smaller group than the joint has"));
    }
    let effect = match clauses.is_empty() {
        true => String::new(),
        false => format!("they {}; ", clauses.join(" and ")),
    };
    format!(
        "subgroups bound what every two links do to each other, until no bound makes another smaller: {effect}the {independent} \
         that the loops still ask for are independent"
    )
}

/// What bounds between all links leave to single joints, one line each.
pub fn confined(mechanism: &Mechanism, counted: &Counted) -> Vec<String> {
    let held = counted.held.iter();
    let held = held.map(|joint| format!("{} stands still", list(mechanism, &[*joint])));
    let confined = counted.confined.iter().map(|(joint, group)| {
        format!(
            "{} stays in {}",
            list(mechanism, &[*joint]),
            named_algebra(group)
        )
    });
    held.chain(confined).collect()
}

/// Groups and rank that contradict each other. Both are computed from the same screws; they can differ only where a margin deceives.
pub fn contradiction(found: usize, freedom: usize) -> String {
    format!(
        "the subgroups leave {found} freedoms where the rank at the pose leaves {freedom}: the numbers do not tell which"
    )
}

/// A part whose couplings ask for something else than its loops, which subgroups explain.
pub fn coupled(of_loops: &str, couplings: usize) -> String {
    let these = match couplings {
        1 => "its coupling is one more".to_owned(),
        n => format!("its {n} couplings are as many more"),
    };
    format!(
        "without couplings: {of_loops}; {these} on the manifold of these motions, independent of one another"
    )
}

/// A part whose rank is explained by the spaces of its cycles. `frame` places the frame of the first algebra in the world.
pub fn loop_spaces(
    mechanism: &Mechanism,
    part: &Part,
    algebras: &[Subalgebra],
    frame: Option<&Rigid<f64>>,
    reading: &str,
) -> String {
    let sum: usize = algebras.iter().map(Subalgebra::dimension).sum();
    let coupled = match part.couplings.len() {
        0 => String::new(),
        1 => " together with that of the coupling".to_owned(),
        n => format!(" together with those of the {n} couplings"),
    };
    if let ([cycle], [algebra]) = (&part.cycles[..], algebras) {
        let joints: Vec<usize> = cycle.iter().map(|(joint, _)| *joint).collect();
        let group = match (frame, algebra.subgroup().ok().flatten()) {
            (Some(frame), Some(group)) => named(&group.conjugated_by(&pose(frame))),
            (None, Some(group)) => kind(group.kind()).to_owned(),
            (_, None) => dimension(algebra),
        };
        return format!(
            "{reading}every displacement of the loop {} lies in {group}; its {} independent{coupled}",
            list(mechanism, &joints),
            equations(sum)
        );
    }
    let mut kinds: BTreeMap<(usize, &str), usize> = BTreeMap::new();
    for algebra in algebras {
        let word = algebra
            .subgroup()
            .ok()
            .flatten()
            .map_or("a subgroup", |group| kind(group.kind()));
        *kinds.entry((algebra.dimension(), word)).or_default() += 1;
    }
    let loops: Vec<String> = kinds
        .iter()
        .map(|((_, word), count)| match count {
            1 => format!("those of 1 loop lie in {word}"),
            _ => format!("those of {count} loops each lie in {word}"),
        })
        .collect();
    format!(
        "{reading}of the displacements around the loops, {}; the {} that this leaves are independent{coupled}",
        loops.join(", "),
        equations(sum)
            .trim_end_matches(" are")
            .trim_end_matches(" is")
    )
}

/// Why a loop's configurations are a manifold.
pub fn proof(mechanism: &Mechanism, pieces: &[&Piece], proof: &Proof) -> String {
    let all = chain::joints(pieces.iter().copied());
    match proof {
        Proof::Whole(group) => format!(
            "the loop {} sweeps {}; its {} independent",
            list(mechanism, &all),
            named_algebra(group),
            equations(group.dimension())
        ),
        Proof::Split(arcs, common) => {
            let [first, second] = arcs.each_ref().map(|arc| {
                format!(
                    "chain {} generates {}",
                    chain_of(mechanism, arc.pieces.iter().map(|&i| pieces[i])),
                    named_algebra(&arc.group)
                )
            });
            format!("{first}, {second}; they meet in {}", named_algebra(common))
        }
        Proof::Held { arcs, .. } => {
            let loose: Vec<String> = arcs
                .iter()
                .filter(|arc| {
                    chain::freedom(arc.pieces.iter().map(|&i| pieces[i])) > arc.group.dimension()
                })
                .map(|arc| {
                    format!(
                        "chain {} generates {}",
                        chain_of(mechanism, arc.pieces.iter().map(|&i| pieces[i])),
                        named_algebra(&arc.group)
                    )
                })
                .collect();
            let all = list(mechanism, &all);
            if loose.is_empty() {
                format!("no velocity closes the loop {all}, so it stands still")
            } else {
                format!(
                    "in the loop {all}, {}; beyond that no velocity closes the loop, so only what moves within these chains \
                     moves",
                    loose.join(", ")
                )
            }
        }
    }
}

/// A chain that constrains nothing.
pub fn free_chain(mechanism: &Mechanism, pieces: &[Piece]) -> String {
    format!(
        "chain {} allows every displacement of its ends, so it constrains nothing",
        list(mechanism, &chain::joints(pieces))
    )
}

/// What the reductions left, explained by its loop spaces.
pub fn remainder(mechanism: &Mechanism, joints: &[usize], rank: usize) -> String {
    format!(
        "in the network that is left, of {}, the {} that the subgroups of its loops leave are independent",
        list(mechanism, joints),
        equations(rank)
            .trim_end_matches(" are")
            .trim_end_matches(" is")
    )
}

/// The reductions in one sentence.
pub fn summary(steps: &[String]) -> String {
    match steps {
        [] => "the joints close no loop".to_owned(),
        steps if steps.len() <= MOST_STEPS => steps.join("; then "),
        [.., last] => format!(
            "subgroups explain the loops one after the other, in {} steps, the last of which is: {last}",
            steps.len()
        ),
    }
}

/// Nothing decided.
pub fn stuck(chains: usize, steps: usize) -> String {
    match steps {
        0 => {
            "neither the subgroups of the loops nor those of two chains of a loop explain the rank"
                .to_owned()
        }
        _ => format!(
            "subgroups explain a part of the mechanism only: {chains} chains are left whose loops they do not explain"
        ),
    }
}

/// Nothing decided because of the numbers.
pub fn failure(error: &GroupError) -> String {
    format!("subgroups could not be looked for: {error}")
}

fn named_algebra(algebra: &Subalgebra) -> String {
    algebra
        .subgroup()
        .ok()
        .flatten()
        .map_or_else(|| dimension(algebra), |group| named(&group))
}

/// Letter and geometry.
fn named(group: &DisplacementSubgroup) -> String {
    format!("{} ({group})", group.short_name())
}

fn dimension(algebra: &Subalgebra) -> String {
    format!("a subgroup of dimension {}", algebra.dimension())
}

/// A class without its geometry.
fn kind(kind: SubgroupKind) -> &'static str {
    match kind {
        SubgroupKind::Identity => "E (no motion)",
        SubgroupKind::Rotation => "R (rotation about an axis)",
        SubgroupKind::Translation => "T (translation along a direction)",
        SubgroupKind::Helical => "H (screw motion)",
        SubgroupKind::Cylindrical => "C (rotation about and translation along an axis)",
        SubgroupKind::PlanarTranslation => "T2 (translation in a plane)",
        SubgroupKind::Spherical => "S (rotation about a point)",
        SubgroupKind::Planar => "G (planar motion)",
        SubgroupKind::SpatialTranslation => "T3 (translation in every direction)",
        SubgroupKind::TranslatingScrew => "Y (translation in a plane with screw motion across)",
        SubgroupKind::Schoenflies => {
            "X (translation in every direction and rotation about one direction)"
        }
        SubgroupKind::General => "D (unrestricted motion)",
    }
}

fn equations(count: usize) -> String {
    match count {
        1 => "1 equation is".to_owned(),
        n => format!("{n} equations are"),
    }
}

/// The joints of a chain, each once; where a chain holds a part of a joint, that part.
fn chain_of<'a>(mechanism: &Mechanism, pieces: impl Iterator<Item = &'a Piece> + Clone) -> String {
    let mut names: Vec<String> = Vec::new();
    for piece in pieces.clone() {
        match piece {
            Piece::Factor {
                joint,
                first,
                twists,
                ..
            } => {
                let all = &mechanism.joints()[*joint];
                let held: usize = pieces
                    .clone()
                    .filter(|other| other.joints() == [*joint])
                    .map(Piece::freedom)
                    .sum();
                let name = match all.kind.freedoms().get(*first) {
                    _ if held >= all.freedom() => all.name.clone(),
                    Some(part) if twists.len() > 1 => format!("{}.{}", all.name, part.suffix()),
                    _ => all.freedom_name(*first),
                };
                names.push(name);
            }
            Piece::Replaced(loop_) => {
                names.extend(names_of(mechanism, &loop_.joints));
            }
        }
    }
    let mut seen = BTreeSet::new();
    names.retain(|name| seen.insert(name.clone()));
    quoted(&names)
}

fn list(mechanism: &Mechanism, joints: &[usize]) -> String {
    quoted(&names_of(mechanism, joints))
}

/// The names of the joints that have a freedom; of all where none has.
fn names_of(mechanism: &Mechanism, joints: &[usize]) -> Vec<String> {
    let all = || joints.iter().map(|&joint| &mechanism.joints()[joint]);
    let rigid = all().all(|joint| joint.freedom() == 0);
    all()
        .filter(|joint| rigid || joint.freedom() > 0)
        .map(|joint| joint.name.clone())
        .collect()
}

fn quoted(names: &[String]) -> String {
    let shown = names.iter().take(MOST_NAMES);
    let shown: Vec<String> = shown.map(|name| format!("`{name}`")).collect();
    let shown = shown.join(" ");
    match names.len().saturating_sub(MOST_NAMES) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

fn pose(frame: &Rigid<f64>) -> Pose {
    let r = &frame.rotation;
    Pose::new(
        Matrix3::from_fn(|i, j| r[i][j]),
        Vector3::from(frame.translation),
    )
}
