//! Couplings of two joints as one that follows the other, for formats that know no more.

use kutzbach_math::number::Number;
use kutzbach_model::mechanism::{CouplingTerm, JointId};
use std::collections::BTreeMap;

/// Who follows whom: no joint follows two others or, by way of others, itself.
#[derive(Clone, Debug, Default)]
pub(super) struct Followers(BTreeMap<JointId, JointId>);

/// `follower = multiplier · leader + offset`.
#[derive(Clone, Debug)]
pub(super) struct Follower {
    pub(super) follower: JointId,
    pub(super) leader: JointId,
    pub(super) multiplier: Number,
    pub(super) offset: Number,
}

impl Followers {
    /// A coupling of two joints as one of them following the other: the first one the second or, where that cannot be, the second one
    /// the first. `None` where neither can be, there are not two, or one has a power.
    pub(super) fn take(&mut self, terms: &[CouplingTerm], offset: &Number) -> Option<Follower> {
        let [first, second] = terms else {
            return None;
        };
        if terms.iter().any(|term| !term.higher.is_empty()) {
            return None;
        }
        let one = self.follow([first, second], offset);
        one.or_else(|| self.follow([second, first], offset))
    }

    fn follow(
        &mut self,
        [follower, leader]: [&CouplingTerm; 2],
        offset: &Number,
    ) -> Option<Follower> {
        if self.0.contains_key(&follower.joint) {
            return None;
        }
        let mut at = Some(leader.joint);
        while let Some(joint) = at {
            if joint == follower.joint {
                return None;
            }
            at = self.0.get(&joint).copied();
        }
        let multiplier = (-&leader.factor).checked_div(&follower.factor).ok()?;
        let offset = offset.checked_div(&follower.factor).ok()?;
        self.0.insert(follower.joint, leader.joint);
        Some(Follower {
            follower: follower.joint,
            leader: leader.joint,
            multiplier,
            offset,
        })
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn terms(of: &[(usize, i64)]) -> Vec<CouplingTerm> {
        let term = |(joint, factor): &(usize, i64)| {
            CouplingTerm::linear(JointId(*joint), Number::integer(*factor))
        };
        of.iter().map(term).collect()
    }

    #[test]
    fn a_joint_that_follows_already_leads() {
        let mut followers = Followers::default();
        let six = Number::integer(6);
        let first = followers.take(&terms(&[(0, 1), (1, -2)]), &six).unwrap();
        assert_eq!((first.follower, first.leader), (JointId(0), JointId(1)));
        assert_eq!(first.multiplier.value(), 2.0);
        assert_eq!(first.offset.value(), 6.0);
        // 0 follows 1, so that 2 follows 0: q0 + 3 q2 = 6.
        let second = followers.take(&terms(&[(0, 1), (2, 3)]), &six).unwrap();
        assert_eq!((second.follower, second.leader), (JointId(2), JointId(0)));
        assert!((second.multiplier.value() + 1.0 / 3.0).abs() < 1e-15);
        assert_eq!(second.offset.value(), 2.0);
        // 1 leads both: if it followed 2, it would follow itself, and 2 follows already.
        assert!(followers.take(&terms(&[(1, 1), (2, 1)]), &six).is_none());
        assert!(followers.take(&terms(&[(3, 1)]), &six).is_none());
    }
}
