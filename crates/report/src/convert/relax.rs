//! A mechanism without redundant constraints that moves as the one it was made from.
//!
//! Programs that simulate want independent equations. The report knows sets of joints that, given other kinds, leave no constraint
//! redundant and the mobility what it was. Those of closing joints alone come first: they change equations only, not the tree. Next comes
//! what planar loops need: every hinge that closes one as a ball in a slot along its axis. Whatever is taken has been analysed anew.

use crate::{ChangeSets, JointReplacement, Options, Report, ReportError, report};
use kutzbach_format::Reading;
use kutzbach_model::mechanism::{Direction, JointId, JointKind, Mechanism};

/// What came of relaxing a mechanism.
#[derive(Clone, Debug)]
pub struct Relaxed {
    /// The mechanism, with other joints where a set was found.
    pub mechanism: Mechanism,
    /// What was changed, or why nothing was, in sentences.
    pub notes: Vec<String>,
    /// Whether no constraint is redundant now.
    pub independent: bool,
}

/// Relaxes a mechanism.
///
/// # Errors
/// As [`report`].
pub fn relaxed(reading: &Reading, file: &str) -> Result<Relaxed, ReportError> {
    let before = report(reading, file, &Options::default())?;
    let as_it_was = |note: &str, independent: bool| {
        Ok(Relaxed {
            mechanism: reading.mechanism.clone(),
            notes: vec![note.to_owned()],
            independent,
        })
    };
    if before.home.redundant == Some(0) {
        return as_it_was("no constraint is redundant: nothing is relaxed", true);
    }
    if before.mobility.finite.is_none() || before.home.redundant.is_none() {
        let note = "the mobility or its redundant constraints are not decided: nothing is relaxed";
        return as_it_was(note, false);
    }
    let mechanism = &reading.mechanism;
    let sets = before.change_sets.as_ref();
    let of_closures = sets.and_then(|sets| first_sets(mechanism, sets, true));
    let of_any = sets.and_then(|sets| first_sets(mechanism, sets, false));
    let found = [of_closures, slots(mechanism), of_any];
    for changes in found.into_iter().flatten() {
        if let Some(relaxed) = attempt(reading, file, &before, &changes)? {
            return Ok(relaxed);
        }
    }
    let obstacle = sets.and_then(|sets| sets.obstacle.clone());
    let why = obstacle.unwrap_or_else(|| "no set of changes was found".to_owned());
    as_it_was(&format!("{why}: nothing is relaxed"), false)
}

/// A joint and what it becomes.
struct Change {
    joint: JointId,
    to: JointKind,
    axis: Option<Direction>,
    axis2: Option<Direction>,
}

/// The first set of every part, of closing joints alone if so wanted; `None` where a part has none.
fn first_sets(mechanism: &Mechanism, sets: &ChangeSets, closing: bool) -> Option<Vec<Change>> {
    if sets.parts.is_empty() {
        return None;
    }
    let mut all = Vec::new();
    for part in &sets.parts {
        let mut found = part.sets.iter().filter_map(|set| {
            let changes = set.iter().map(|one| change(mechanism, one));
            let changes: Option<Vec<Change>> = changes.collect();
            changes.filter(|changes| {
                let closes = |change: &Change| mechanism.joint(change.joint).closes_loop;
                !closing || changes.iter().all(closes)
            })
        });
        all.extend(found.next()?);
    }
    Some(all)
}

fn change(mechanism: &Mechanism, told: &JointReplacement) -> Option<Change> {
    let direction = |components: Option<[f64; 3]>| match components {
        Some(components) => Direction::of(components).map(Some),
        None => Some(None),
    };
    Some(Change {
        joint: mechanism.joint_named(&told.joint)?,
        to: JointKind::from_word(&told.to)?,
        axis: direction(told.axis)?,
        axis2: direction(told.axis2)?,
    })
}

/// Every hinge that closes a loop and no coupling speaks of, as a ball in a slot along its axis; `None` where there is none.
fn slots(mechanism: &Mechanism) -> Option<Vec<Change>> {
    let coupled = |id: JointId| {
        let couplings = mechanism.couplings().iter();
        couplings
            .flat_map(|coupling| &coupling.terms)
            .any(|term| term.joint == id)
    };
    let joints = mechanism.joints().iter().enumerate();
    let changes: Vec<Change> = joints
        .filter(|(index, joint)| {
            joint.closes_loop && joint.kind == JointKind::Revolute && !coupled(JointId(*index))
        })
        .map(|(index, joint)| Change {
            joint: JointId(index),
            to: JointKind::PointOnLine,
            axis: None,
            // The axis of a hinge is the same direction in both of its frames.
            axis2: Some(joint.axis.clone()),
        })
        .collect();
    (!changes.is_empty()).then_some(changes)
}

/// The mechanism with changes, if it moves as before and nothing is redundant.
fn attempt(
    reading: &Reading,
    file: &str,
    before: &Report,
    changes: &[Change],
) -> Result<Option<Relaxed>, ReportError> {
    let mut mechanism = reading.mechanism.clone();
    let mut notes = Vec::new();
    for change in changes {
        let joint = mechanism.joint(change.joint);
        let part = match joint.closes_loop {
            true => "closing joint",
            false => "joint",
        };
        notes.push(format!(
            "{part} `{}` was {}, is {}",
            joint.name, joint.kind, change.to
        ));
        let (axis, axis2) = (change.axis.clone(), change.axis2.clone());
        mechanism = mechanism.with_joint_kind(change.joint, change.to, axis, axis2);
    }
    let changed = Reading {
        mechanism: mechanism.clone(),
        ..reading.clone()
    };
    let after = report(&changed, file, &Options::default())?;
    let same = after.mobility.finite == before.mobility.finite;
    let independent = after.home.redundant == Some(0);
    Ok((same && independent).then_some(Relaxed {
        mechanism,
        notes,
        independent,
    }))
}
