//! The sentences of the answers.

use super::counting::Counted;
use crate::PartRank;
use kutzbach_closure::{Part, Rigid};
use kutzbach_math::group::{DisplacementSubgroup, GroupError, Pose, Subalgebra, SubgroupKind};
use kutzbach_model::mechanism::Mechanism;
use nalgebra::{Matrix3, Vector3};
use std::collections::BTreeMap;

/// More names than this are not listed.
const MOST_NAMES: usize = 12;

/// More steps than this are not told in one sentence.
const MOST_STEPS: usize = 3;

/// How the numbers are read, as the beginning of a sentence.
pub fn reading(rank: &PartRank) -> &'static str {
    if rank.is_taken_literally() {
        "taking the numbers literally, "
    } else if rank.open_by_digits() > 0.0 {
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
pub fn counted(mechanism: &Mechanism, part: &Part, counted: &Counted) -> String {
    let coupled = coupled(part);
    let (left, is) = match counted.equations {
        1 => ("equation".to_owned(), "is"),
        many => (format!("{many} equations"), "are"),
    };
    if counted.by_cycles_alone {
        return format!(
            "of the displacements around the loops, those of each lie in a subgroup; the {left} that this leaves for loops whose \
             subgroups are the smallest {is} independent{coupled}"
        );
    }
    let steps = steps(mechanism, counted);
    let bounded =
        "subgroups bound what every two links do to each other, until none makes another smaller";
    let found = match &steps[..] {
        [] => bounded.to_owned(),
        few if few.len() <= MOST_STEPS => few.join("; "),
        [first, ..] => format!("{bounded}, as in: {first}"),
    };
    format!("{found}; the {left} that the loops still ask for {is} independent{coupled}")
}

/// What bounds between all links leave to single joints and between chains, one line each.
pub fn steps(mechanism: &Mechanism, counted: &Counted) -> Vec<String> {
    let chords = counted.chords.iter().map(|chord| {
        let [first, second] = chord.chains.each_ref().map(|(joints, group)| {
            let chain = list(mechanism, joints);
            format!("chain {chain} generates {}", named_algebra(group))
        });
        format!(
            "{first}, {second}; they meet in {}",
            named_algebra(&chord.common)
        )
    });
    let parallelograms = counted.parallelograms.iter().map(|joints| {
        format!(
            "the loop {} is a parallelogram, whose coupler is translated along a circle",
            list(mechanism, joints)
        )
    });
    let held = counted.held.iter();
    let held = held.map(|joint| format!("{} stands still", list(mechanism, &[*joint])));
    let confined = counted.confined.iter().map(|(joint, group)| {
        let joint = list(mechanism, &[*joint]);
        format!("{joint} stays in {}", named_algebra(group))
    });
    chords
        .chain(parallelograms)
        .chain(held)
        .chain(confined)
        .collect()
}

/// How the couplings of a part are named beside its equations.
fn coupled(part: &Part) -> String {
    match part.couplings.len() {
        0 => String::new(),
        1 => " together with that of the coupling".to_owned(),
        n => format!(" together with those of the {n} couplings"),
    }
}

/// Groups and rank that contradict each other. Both are computed from the same screws; they can differ only where a margin deceives.
pub fn contradiction(found: usize, freedom: usize) -> String {
    format!(
        "the subgroups leave {found} freedoms where the rank at the pose leaves {freedom}: the numbers do not tell which"
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
    let coupled = coupled(part);
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

/// Nothing decided.
pub fn unexplained() -> String {
    "neither the subgroups of the loops nor what they leave between every two links explain the rank"
        .to_owned()
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
