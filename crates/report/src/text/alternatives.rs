//! Pieces of advice that say the same of several joints, told once on a first screen.

use super::words::mirrored_runs;
use crate::schema::Advice;
use kutzbach_model::mechanism::JointKind;

/// Joints, or runs of them, that a line names.
const NAMED: usize = 4;

/// The same change of several joints, any one of which will do.
#[derive(Debug)]
pub(super) struct Alternatives<'a> {
    /// The piece of advice about the first of them.
    pub first: &'a Advice,
    /// All of them, by name.
    joints: Vec<String>,
    /// The classes that each of them may become.
    to: Vec<&'a str>,
}

impl<'a> Alternatives<'a> {
    /// All pieces of advice: joints that may all become the same and then do the same share a line, and so do the kinds that
    /// the same joints may become.
    pub fn of(advice: &'a [Advice]) -> Vec<Self> {
        let mut changes: Vec<Self> = Vec::new();
        for piece in advice {
            let same = |other: &&mut Self| {
                let first = other.first;
                first.redundant_before == piece.redundant_before
                    && (&first.from, &first.to, first.redundant_after)
                        == (&piece.from, &piece.to, piece.redundant_after)
            };
            match changes.iter_mut().find(same) {
                Some(known) => known.joints.push(piece.joint.clone()),
                None => changes.push(Self {
                    first: piece,
                    joints: vec![piece.joint.clone()],
                    to: vec![piece.to.as_str()],
                }),
            }
        }
        let mut all: Vec<Self> = Vec::new();
        for change in changes {
            let same = |other: &&mut Self| {
                other.joints == change.joints
                    && other.first.from == change.first.from
                    && other.first.redundant_after == change.first.redundant_after
            };
            match all.iter_mut().find(same) {
                Some(known) => known.to.extend(change.to),
                None => all.push(change),
            }
        }
        all
    }

    /// So many pieces of advice are told by this.
    pub fn pieces(&self) -> usize {
        self.joints.len() * self.to.len()
    }

    /// Whether the joints are to be removed.
    pub fn removes(&self) -> bool {
        self.to == ["none"]
    }

    /// `any one of J1 … J6: revolute → universal`.
    pub fn text(&self) -> String {
        let joints = mirrored_runs(&self.joints, NAMED);
        let of = match self.joints.len() {
            1 => "",
            2 => "one of ",
            _ => "any one of ",
        };
        if self.removes() {
            let what = match self.first.from.as_str() {
                what @ ("link" | "coupling") if of.is_empty() => format!("the {what} "),
                what @ ("link" | "coupling") => format!("the {what}s "),
                _ => String::new(),
            };
            return format!("remove {of}{what}{joints}");
        }
        let to: Vec<&str> = self.to.iter().map(|class| word(class)).collect();
        format!(
            "{of}{joints}: {} → {}",
            word(&self.first.from),
            to.join(" or ")
        )
    }
}

/// The word of a kind of joint by its letter.
fn word(class: &str) -> &str {
    let kinds = JointKind::ALL.iter();
    let mut known = kinds.filter(|kind| kind.class() == class);
    known.next().map_or(class, |kind| kind.word())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(joint: &str, change: &str, redundant_after: i64) -> Advice {
        Advice {
            text: format!("{joint}: {change}"),
            joint: joint.to_owned(),
            from: "R".to_owned(),
            to: if change.contains('S') { "S" } else { "C" }.to_owned(),
            redundant_before: 9,
            redundant_after,
        }
    }

    #[test]
    fn the_same_change_of_several_joints_is_told_once() {
        let ball = "R → S, make it a ball joint";
        let advice = [
            piece("a1", ball, 7),
            piece("a2", ball, 7),
            piece("b", "R → C", 8),
            piece("a3", ball, 7),
            piece("c", ball, 8),
        ];
        let all = Alternatives::of(&advice);
        let texts: Vec<String> = all.iter().map(Alternatives::text).collect();
        assert_eq!(
            texts,
            [
                "any one of a1 … a3: revolute → spherical",
                "b: revolute → cylindrical",
                "c: revolute → spherical"
            ]
        );
        assert_eq!(
            all.iter().map(Alternatives::pieces).sum::<usize>(),
            advice.len()
        );
    }
}
