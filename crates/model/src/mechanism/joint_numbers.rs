//! The numbers of a joint's geometry, one by one, and a mechanism with some of them changed.

use super::joint::Joint;
use super::model::Mechanism;
use kutzbach_math::number::{Number, Quantity};

impl Joint {
    /// How many numbers [`Joint::numbers`] lists.
    pub const NUMBERS: usize = 20;

    /// Position and roll, pitch, yaw of the predecessor's frame, then of the successor's (m, rad), `axis`, `axis2`, lead (m per
    /// turn), distance (m); `None` for what the joint does not have or its kind does not use.
    #[must_use]
    pub fn numbers(&self) -> [Option<&Number>; Self::NUMBERS] {
        let mut all = [None; Self::NUMBERS];
        let frames = [&self.predecessor.frame, &self.successor.frame];
        for (side, frame) in frames.into_iter().enumerate() {
            for i in 0..3 {
                all[6 * side + i] = Some(&frame.position[i]);
                all[6 * side + 3 + i] = Some(&frame.roll_pitch_yaw[i]);
            }
        }
        for i in 0..3 {
            all[12 + i] = self.kind.uses_axis().then_some(&self.axis.0[i]);
            all[15 + i] = self.kind.uses_second_axis().then_some(&self.axis2.0[i]);
        }
        all[18] = self.lead.as_ref();
        all[19] = self.distance.as_ref();
        all
    }

    /// Which kind of number stands at a place of [`Joint::numbers`]: a length (0), an angle (1), or a component of a direction (2).
    pub(super) fn kind_of_number(place: usize) -> usize {
        match place {
            3..6 | 9..12 => 1,
            12..18 => 2,
            _ => 0,
        }
    }

    /// The same kinds by what a literal measures.
    pub(super) fn kind_of_quantity(quantity: Quantity) -> usize {
        match quantity {
            Quantity::Length => 0,
            Quantity::Angle => 1,
            Quantity::Direction => 2,
        }
    }

    pub(super) fn number_mut(&mut self, index: usize) -> Option<&mut Number> {
        let side = |index: usize| (index % 6 / 3, index % 3);
        match index {
            0..12 => {
                let frame = match index < 6 {
                    true => &mut self.predecessor.frame,
                    false => &mut self.successor.frame,
                };
                let (kind, i) = side(index);
                Some(match kind {
                    0 => &mut frame.position[i],
                    _ => &mut frame.roll_pitch_yaw[i],
                })
            }
            12..15 => Some(&mut self.axis.0[index - 12]),
            15..18 => Some(&mut self.axis2.0[index - 15]),
            18 => self.lead.as_mut(),
            19 => self.distance.as_mut(),
            _ => None,
        }
    }
}

impl Mechanism {
    /// The mechanism with other numbers in its joints: (joint, place in [`Joint::numbers`], value). What digits state is read anew
    /// where some come, go or change. Places that a joint does not have are passed over.
    #[must_use]
    pub fn with_joint_numbers(
        mut self,
        changes: impl IntoIterator<Item = (usize, usize, Number)>,
    ) -> Self {
        let mut digits_change = false;
        for (joint, place, value) in changes {
            let number = self.joints.get_mut(joint).and_then(|j| j.number_mut(place));
            if let Some(number) = number {
                digits_change |= !has_same_digits(number, &value);
                *number = value;
            }
        }
        match digits_change {
            true => self.read_digits(),
            // What is written as it was says the same of the others, and computed numbers have no digits to say anything.
            false => self,
        }
    }
}

/// Whether two numbers have no digits, or the same: of their own, and not of literals that they were worked out from, which are not compared.
fn has_same_digits(one: &Number, other: &Number) -> bool {
    let is_own = one.inputs().is_empty() && other.inputs().is_empty();
    let is_literal = one.literal_text().is_some();
    // Equal texts may have been read as different numbers.
    let is_read_alike = one.stated() == other.stated() && one.value() == other.value();
    is_own && one.literal_text() == other.literal_text() && (!is_literal || is_read_alike)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{JointBuilder, JointKind, MechanismBuilder};
    use super::*;

    #[test]
    fn every_number_of_a_joint_is_read_and_changed_at_its_place() {
        let mut builder = MechanismBuilder::new("m");
        builder
            .link("a")
            .link("b")
            .joint(JointBuilder::tree("j", JointKind::Screw, "a", "b").lead(Number::integer(7)));
        let mechanism = builder.build().unwrap();
        let places: Vec<usize> = (0..Joint::NUMBERS)
            .filter(|&place| mechanism.joints()[0].numbers()[place].is_some())
            .collect();
        let changes = places
            .iter()
            .map(|&place| (0, place, Number::integer(100 + place as i64)));
        let changed = mechanism.with_joint_numbers(changes);
        for (place, number) in changed.joints()[0].numbers().into_iter().enumerate() {
            let expected = places
                .contains(&place)
                .then(|| Number::integer(100 + place as i64));
            assert_eq!(number, expected.as_ref(), "{place}");
        }
        // Two frames, an axis and a lead.
        assert_eq!(places.len(), 16);
    }

    #[test]
    fn digits_are_read_anew_where_numbers_with_digits_come_or_go() {
        let mut builder = MechanismBuilder::new("m");
        builder.link("a").link("b");
        let kind = JointKind::Revolute;
        builder.joint(JointBuilder::tree("j", kind, "a", "b"));
        builder.joint(JointBuilder::closing("k", kind, "a", "b"));
        let mechanism = builder.build().unwrap();
        let decimals = |mechanism: &Mechanism| mechanism.precision().decimals;
        assert_eq!(decimals(&mechanism), None);
        let third = || Number::ratio(1, 3).unwrap();
        let stated = mechanism.with_joint_numbers([(0, 0, Number::decimal("0.1234").unwrap())]);
        assert_eq!(decimals(&stated), Some(4));
        let beside = stated.with_joint_numbers([(0, 1, third())]);
        assert_eq!(decimals(&beside), Some(4));
        let again = beside.with_joint_numbers([(0, 0, Number::decimal("0.1234").unwrap())]);
        assert_eq!(decimals(&again), Some(4), "written as it was");
        let longer = again.with_joint_numbers([(0, 0, Number::decimal("0.12345").unwrap())]);
        assert_eq!(decimals(&longer), Some(5));
        let read = Number::decimal("0.12345").unwrap().read_as(&third());
        let exact = longer.clone().with_joint_numbers([(0, 0, read)]);
        assert_eq!(decimals(&exact), None, "of the same text");
        assert_eq!(
            decimals(&longer.with_joint_numbers([(0, 0, third())])),
            None
        );
    }
}
