//! Pieces of advice that say the same of several joints, told once on a first screen.

use super::words::mirrored_runs;
use crate::schema::Advice;

/// Joints, or runs of them, that a line names.
const NAMED: usize = 4;

/// The same change of several joints, any one of which will do.
#[derive(Debug)]
pub(super) struct Alternatives<'a> {
    /// The piece of advice about the first of them.
    pub first: &'a Advice,
    /// All of them, by name.
    joints: Vec<String>,
}

impl<'a> Alternatives<'a> {
    /// All pieces of advice, each change once, in the order of first mention.
    pub fn of(advice: &'a [Advice]) -> Vec<Self> {
        let mut all: Vec<Self> = Vec::new();
        for piece in advice {
            let same = |other: &&mut Self| {
                change(other.first) == change(piece)
                    && other.first.redundant_before == piece.redundant_before
                    && other.first.redundant_after == piece.redundant_after
            };
            match all.iter_mut().find(same) {
                Some(known) => known.joints.push(piece.joint.clone()),
                None => all.push(Self {
                    first: piece,
                    joints: vec![piece.joint.clone()],
                }),
            }
        }
        all
    }

    /// So many pieces of advice are told by this.
    pub fn pieces(&self) -> usize {
        self.joints.len()
    }

    /// `J1 … J6 (any one of these 6): R → S, make it a ball joint; …`.
    pub fn text(&self) -> String {
        match self.joints.len() {
            1 => self.first.text.clone(),
            many => format!(
                "{} (any one of these {many}): {}",
                mirrored_runs(&self.joints, NAMED),
                change(self.first)
            ),
        }
    }
}

/// What a piece of advice says of its joint.
fn change(advice: &Advice) -> &str {
    advice
        .text
        .strip_prefix(advice.joint.as_str())
        .and_then(|rest| rest.strip_prefix(": "))
        .unwrap_or(&advice.text)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(joint: &str, change: &str, redundant_after: i64) -> Advice {
        Advice {
            text: format!("{joint}: {change}"),
            joint: joint.to_owned(),
            from: "R".to_owned(),
            to: "S".to_owned(),
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
                "a1 … a3 (any one of these 3): R → S, make it a ball joint",
                "b: R → C",
                "c: R → S, make it a ball joint"
            ]
        );
        assert_eq!(
            all.iter().map(Alternatives::pieces).sum::<usize>(),
            advice.len()
        );
    }
}
