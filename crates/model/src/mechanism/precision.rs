//! How far the numbers of one independent sub-mechanism may be from the numbers meant.

use super::joint::Joint;
use super::number_style::{EXACT_DECIMALS, Group, Literals, Written};
use super::other_unit::OtherUnit;
use kutzbach_math::number::{Input, Number};
use std::collections::BTreeSet;

/// How precisely a file states the geometry of one independent sub-mechanism.
///
/// A rounded number differs from the number meant by up to half a unit of its last place. Writers round in two manners,
/// to a fixed number of decimals or to a fixed number of significant digits, and both strip trailing zeros; and they write lengths,
/// angles and directions each with digits of their own. With `D` the most decimals and `S` the most significant digits found in
/// one of these kinds, a literal `x` with `d` decimals is uncertain by
///
/// ```text
/// u(x) = ½ min(10⁻ᵈ, max(10⁻ᴰ, 10⁻ˢ 10ᵉ)),   10ᵉ⁻¹ ≤ |x| < 10ᵉ
/// ```
///
/// which is right for both manners: the first term wherever no zeros were stripped, the second where they were. Where the literals
/// tell which manner it was, the other is left out; and where most literals are shorter than chance makes them beside a few long
/// ones, they were printed by another hand, and are uncertain by `½ 10⁻ᵈ`. Zeros do not count
/// for `D`: `0.000000` stands beside whole numbers as `0` does. Expressions are exact. Numbers of a kind that all have at most
/// [`Precision::EXACT_DECIMALS`] decimals are those that a designer
/// chose, not rounded ones, and are taken as exact too. Where all directions and angles are, decimals of lengths count in the decade
/// of the longest one, if that is below 1 m: `0.125` says of metres what `1.25` says of decimetres. Literals that were read as constants
/// ([`Recognised`](super::Recognised)) are exact; those that were read as shorter decimals state what these state. Where every
/// literal ends in zeros, at least three more than it needs, in twelve digits or more, these are padding and state nothing. Printed
/// doubles state 17 significant digits, however many are printed. Literals that are single-precision numbers, however they are
/// printed, are uncertain by what single precision is. Lengths that are all multiples of a small part of an inch, and angles that are of a
/// degree, were rounded there: each is uncertain by half that part.
///
/// Numbers that a reader worked out from literals ([`Number::derived_from`]) count by these, and are as uncertain as they make them:
/// `Σ |∂number/∂x| u(x)`. Where all of these are exact, they count by their own texts, which have the rounding of doubles.
#[derive(Clone, Copy, Debug, Default)]
pub struct Precision {
    /// Most decimals of any literal in the geometry but zeros, for which 0 counts; `None` where there is no literal.
    pub decimals: Option<i32>,
    /// Most significant digits of any literal in the geometry.
    pub significant: u32,
    /// Lengths, angles, components of directions.
    groups: [Group; 3],
    /// What is said to be known of every literal, whatever its digits say (m, rad).
    by_hand: Option<f64>,
    /// Whether numbers that were worked out count by their own texts, since the literals behind them are all exact.
    by_own_text: bool,
}

/// By what is stated, and not by how it was read: numbers that were worked out from exact ones count as if they had been written so.
impl PartialEq for Precision {
    fn eq(&self, other: &Self) -> bool {
        let stated = |own: &Self| (own.decimals, own.significant, own.groups, own.by_hand);
        stated(self) == stated(other)
    }
}

impl Precision {
    /// Zeros at the end of every literal are padding if they are so many: of few literals, too many for chance.
    const PADDING: u32 = 3;

    /// Fewer significant digits than this are what people round to, zeros included.
    const LONG: u32 = 12;

    /// Literals it takes for that.
    const PADDED_LITERALS: usize = 4;

    /// Up to this many decimals in all numbers of a kind, literals are exact.
    pub const EXACT_DECIMALS: i32 = EXACT_DECIMALS;

    /// Whether every number of the geometry is exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        match self.by_hand {
            Some(uncertainty) => uncertainty == 0.0 || self.decimals.is_none(),
            None => self.groups.iter().all(Group::is_exact),
        }
    }

    /// Whether exact numbers of this many decimals or more may nevertheless be rounded ones: in every kind that has so many, no more are
    /// shorter than zeros at the end make by chance. `0.01` among tenths was typed.
    #[must_use]
    pub fn may_be_rounded_to(&self, decimals: i32) -> bool {
        let long = |group: &&Group| group.decimals.is_some_and(|most| most >= decimals);
        let mut long = self.groups.iter().filter(long).peekable();
        long.peek().is_some() && long.all(Group::may_be_rounded)
    }

    /// Whether the digits of all numbers that are not exact are those of doubles that some program printed. They say how the program computes, not how
    /// well it knows its numbers.
    #[must_use]
    pub fn is_of_doubles(&self) -> bool {
        let mut rounded = self.groups.iter().filter(|group| !group.is_exact());
        let doubles = rounded.clone().next().is_some() && rounded.all(Group::is_of_doubles);
        doubles && self.by_hand.is_none()
    }

    /// Whether every kind of numbers that is not exact has all the digits of a double.
    #[must_use]
    pub fn is_in_full(&self) -> bool {
        let mut rounded = self.groups.iter().filter(|group| !group.is_exact());
        rounded.clone().next().is_some() && rounded.all(Group::is_in_full)
    }

    /// The uncertainty of every literal that was stated by hand instead of by digits (m, rad).
    #[must_use]
    pub fn by_hand(&self) -> Option<f64> {
        self.by_hand
    }

    /// The precision with every literal known to within this (m, rad), whatever its digits say; 0 means exact. What is no
    /// finite size is ignored.
    #[must_use]
    pub fn known_to(self, uncertainty: f64) -> Self {
        let by_hand = (uncertainty >= 0.0 && uncertainty.is_finite()).then_some(uncertainty);
        Self { by_hand, ..self }
    }

    /// How far a number of this sub-mechanism, at a place of [`Joint::numbers`](super::Joint::numbers), may be from the number
    /// meant (m, rad); zero for exact ones. A number that was [worked out](Number::derived_from) from literals may be off by what all of
    /// these may be off by, to first order.
    #[must_use]
    pub fn uncertainty(&self, place: usize, number: &Number) -> f64 {
        let inputs = number.inputs();
        if inputs.is_empty() || self.by_own_text && self.by_hand.is_none() {
            return self.of_literal(Joint::kind_of_number(place), number);
        }
        let share = |input: &Input| {
            let kind = Joint::kind_of_quantity(input.quantity);
            input.slope * self.of_literal(kind, &input.literal)
        };
        inputs.iter().map(share).sum()
    }

    fn of_literal(&self, kind: usize, number: &Number) -> f64 {
        match self.by_hand {
            _ if number.stated().is_none() || self.decimals.is_none() => 0.0,
            Some(uncertainty) => uncertainty,
            None => self.groups[kind].uncertainty(number),
        }
    }

    /// The literal that makes the numbers rounded: of those with most decimals the first; `None` where the numbers are exact by
    /// their digits.
    #[must_use]
    pub fn rounded_by(&self) -> Option<LiteralPlace> {
        let rounded = self.groups.iter().filter(|group| !group.is_exact());
        // Of equal ones the first.
        let finest = rounded.reduce(|one, other| match other.designed > one.designed {
            true => other,
            false => one,
        });
        finest?.finest
    }

    /// How the lengths, the angles and the components of directions are written; `None` for a kind without literals.
    #[must_use]
    pub fn written(&self) -> [Option<Written>; 3] {
        self.groups.map(|group| group.written())
    }

    /// The precision of some numbers that one file states of one sub-mechanism: of those in its tree, and of those in joints that close
    /// a loop, which differ where two hands wrote them.
    pub(super) fn of<'a>(
        tree: impl IntoIterator<Item = (LiteralPlace, &'a Number)>,
        closing: impl IntoIterator<Item = (LiteralPlace, &'a Number)>,
    ) -> [Self; 2] {
        let sides = [tree.into_iter().collect(), closing.into_iter().collect()];
        let read = Self::of_sides(&sides, false);
        let numbers = || sides.iter().flatten();
        let derived = numbers().any(|(_, number)| !number.inputs().is_empty());
        match derived && read.iter().all(Self::is_exact) {
            // What is computed from exact numbers has the rounding of its own text.
            true => Self::of_sides(&sides, true),
            false => read,
        }
    }

    fn of_sides(sides: &[Vec<(LiteralPlace, &Number)>; 2], by_own_text: bool) -> [Self; 2] {
        let mut known = BTreeSet::new();
        let [tree, closing] = sides
            .each_ref()
            .map(|side| sorted_by_kind(side, by_own_text, &mut known));
        let all = [0, 1, 2].map(|kind: usize| tree[kind].and(&closing[kind]));
        let padded = Self::is_padded(&all);
        let whole = Self {
            by_own_text,
            ..Self::of_kinds(&all, padded)
        };
        let mut sides = [whole; 2];
        for kind in 0..3 {
            let [of_tree, of_closing] = [&tree[kind], &closing[kind]];
            let groups = [of_tree.group(padded), of_closing.group(padded)];
            if of_closing.by_another_hand_than(&groups[1], &groups[0])
                || of_tree.by_another_hand_than(&groups[0], &groups[1])
            {
                for (side, group) in sides.iter_mut().zip(groups) {
                    side.groups[kind] = group;
                }
            }
        }
        sides
    }

    /// Whether zeros at the end of all literals say nothing.
    fn is_padded(literals: &[Literals<'_>; 3]) -> bool {
        let digits = literals.iter().map(Literals::significant);
        let (significant, bare) = digits.fold((0, 0), |a, b| (a.0.max(b.0), a.1.max(b.1)));
        significant >= Self::LONG.max(bare + Self::PADDING)
            && literals.iter().map(Literals::pointed).sum::<usize>() >= Self::PADDED_LITERALS
    }

    /// The precision of literals that one hand wrote.
    fn of_kinds(literals: &[Literals<'_>; 3], padded: bool) -> Self {
        let [lengths, angles, directions] = literals;
        let (mut angles, mut directions) = (angles.group(padded), directions.group(padded));
        angles.choose_single_digits();
        directions.choose_single_digits();
        let mut lengths = lengths.group(padded);
        // Whoever chose directions chose lengths to the millimetre. Beside rounded directions these are rounded as well, but where
        // their zeros are those of the unit, and none of them was rounded to.
        if angles.is_exact() && directions.is_exact() || lengths.is_of_a_small_unit() {
            lengths.count_from_first_digit();
        } else {
            let finer = match angles.significant > directions.significant {
                true => &angles,
                false => &directions,
            };
            lengths.count_all_digits_beside(finer);
        }
        let groups = [lengths, angles, directions];
        Self {
            decimals: groups.iter().map(|group| group.decimals).max().flatten(),
            significant: groups
                .iter()
                .map(|group| group.significant)
                .max()
                .unwrap_or(0),
            groups,
            by_hand: None,
            by_own_text: false,
        }
    }

    /// What holds of two sub-mechanisms together: exact if both are, and the digits of the longer literals.
    pub(super) fn with(self, other: &Self) -> Self {
        Self {
            decimals: self.decimals.max(other.decimals),
            significant: self.significant.max(other.significant),
            groups: [0, 1, 2].map(|kind| self.groups[kind].with(&other.groups[kind])),
            by_hand: self.by_hand,
            by_own_text: self.by_own_text && other.by_own_text,
        }
    }
}

/// Lengths, angles and components of directions. Of numbers that were worked out, either their own texts count, or the literals behind
/// them, those that are not `known` already: many numbers come from one literal, and those of joints that close loops from those of the
/// tree.
fn sorted_by_kind<'a>(
    numbers: &[(LiteralPlace, &'a Number)],
    by_own_text: bool,
    known: &mut BTreeSet<(usize, Option<&'a str>)>,
) -> [Literals<'a>; 3] {
    let units = [Some(OtherUnit::Inch), Some(OtherUnit::Degree), None];
    let mut literals = units.map(Literals::of);
    for &(place, number) in numbers {
        let inputs = number.inputs();
        if inputs.is_empty() || by_own_text {
            let kind = Joint::kind_of_number(place.in_joint());
            known.insert((kind, number.literal_text()));
            literals[kind].read(place, number);
            continue;
        }
        for input in inputs {
            let kind = Joint::kind_of_quantity(input.quantity);
            if known.insert((kind, input.literal.literal_text())) {
                literals[kind].read(place, &input.literal);
            }
        }
    }
    literals
}

/// Where a literal of the geometry stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LiteralPlace {
    /// In a joint: its index, and the place in [`Joint::numbers`] of the literal, or of a number that was worked out from it.
    Joint(usize, usize),
    /// In the frame in which a link is placed without a joint: the link's index, and the place as in a joint's first frame.
    Link(usize, usize),
}

impl LiteralPlace {
    /// The place in a joint's numbers, or that of the same kind.
    fn in_joint(self) -> usize {
        let (Self::Joint(_, place) | Self::Link(_, place)) = self;
        place
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
