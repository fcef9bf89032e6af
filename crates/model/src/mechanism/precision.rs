//! How far a file's numbers may be from the numbers meant: judged for every independent sub-mechanism by itself.

use super::joint::Joint;
use super::link::Placement;
use super::model::Mechanism;
use super::number_style::{EXACT_DECIMALS, Group, Literals, OF_A_DOUBLE, Written};
use crate::graph::{Block, ConstraintGraph};
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
/// printed, are uncertain by what single precision is.
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
        let doubles = rounded.clone().next().is_some() && rounded.all(|group| group.doubles);
        doubles && self.by_hand.is_none()
    }

    /// Whether every kind of numbers that is not exact has all the digits of a double.
    #[must_use]
    pub fn is_in_full(&self) -> bool {
        let mut rounded = self.groups.iter().filter(|group| !group.is_exact());
        rounded.clone().next().is_some() && rounded.all(|group| group.significant >= OF_A_DOUBLE)
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
    fn of<'a>(
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
    fn with(self, other: &Self) -> Self {
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
    let mut literals = [(); 3].map(|()| Literals::default());
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

/// The precisions of a mechanism's independent sub-mechanisms: the biconnected blocks of its constraint graph.
///
/// A sub-mechanism's numbers are read from the literals that bear on its own loops: those of its joints, and the places of its links
/// where no joint places them. What lies in no loop, such as the frame of a camera that is fixed to a link, bears on nothing.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Precisions {
    /// Of the joints of each block's tree, and of those that close its loops.
    blocks: Vec<[Precision; 2]>,
    /// Index in `blocks` of every joint's, and which of the two; `None` for joints in no loop.
    of_joint: Vec<Option<(usize, usize)>>,
    together: Precision,
    /// That of what bears on nothing.
    exact: Precision,
}

impl Precisions {
    /// Those of a mechanism, of which everything else is known. Cost: near-linear.
    pub(super) fn of(mechanism: &Mechanism) -> Self {
        let loops: Vec<Block> = ConstraintGraph::of(mechanism)
            .blocks()
            .into_iter()
            .filter(|block| !block.bridge)
            .collect();
        let mut of_joint = vec![None; mechanism.joints.len()];
        for (index, block) in loops.iter().enumerate() {
            block
                .edges
                .iter()
                .for_each(|&joint| of_joint[joint] = Some((index, side_of(mechanism, joint))));
        }
        let blocks: Vec<[Precision; 2]> = loops
            .iter()
            .map(|block| {
                let [tree, closing] = [0, 1].map(|side| bearing(mechanism, block, side));
                Precision::of(tree, closing)
            })
            .collect();
        let mut all = blocks.iter().flatten();
        let first = all.next().copied().unwrap_or_default();
        Self {
            together: all.fold(first, Precision::with),
            blocks,
            of_joint,
            exact: Precision::default(),
        }
    }

    /// Those with every literal known to within this (m, rad).
    pub(super) fn known_to(mut self, uncertainty: f64) -> Self {
        let all = [&mut self.together, &mut self.exact];
        for precision in all.into_iter().chain(self.blocks.iter_mut().flatten()) {
            *precision = precision.known_to(uncertainty);
        }
        self
    }

    pub(super) fn together(&self) -> &Precision {
        &self.together
    }

    pub(super) fn of_joint(&self, joint: usize) -> &Precision {
        let of = self.of_joint.get(joint).copied().flatten();
        of.map_or(&self.exact, |(block, side)| &self.blocks[block][side])
    }

    /// Index of the independent sub-mechanism that a joint belongs to; `None` for joints in no loop.
    pub(super) fn block(&self, joint: usize) -> Option<usize> {
        let of = self.of_joint.get(joint).copied().flatten();
        of.map(|(block, _)| block)
    }
}

/// 0 for a joint of the tree, 1 for one that closes a loop.
fn side_of(mechanism: &Mechanism, joint: usize) -> usize {
    usize::from(mechanism.joints[joint].closes_loop)
}

/// The literals that bear on a block's loops, in file order: those of its tree (0), or of the joints that close loops (1).
fn bearing<'a>(
    mechanism: &'a Mechanism,
    block: &Block,
    side: usize,
) -> impl Iterator<Item = (LiteralPlace, &'a Number)> {
    let mut joints = block.edges.clone();
    joints.retain(|&joint| side_of(mechanism, joint) == side);
    joints.sort_unstable();
    let mut links = match side {
        0 => block.nodes.clone(),
        _ => Vec::new(),
    };
    links.sort_unstable();
    let placed = links.into_iter().flat_map(|link| {
        let frame = match &mechanism.links[link].placement {
            Placement::Floating { origin, .. } => Some(origin),
            _ => None,
        };
        let numbers = frame
            .into_iter()
            .flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw));
        numbers
            .enumerate()
            .map(move |(place, number)| (LiteralPlace::Link(link, place), number))
    });
    let joints = joints.into_iter().flat_map(|joint| {
        let numbers = mechanism.joints[joint].numbers().into_iter().enumerate();
        numbers
            .filter_map(move |(place, number)| Some((LiteralPlace::Joint(joint, place), number?)))
    });
    placed.chain(joints)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::Direction;
    use super::super::{Frame, JointBuilder, JointId, JointKind, MechanismBuilder};
    use super::*;
    use kutzbach_math::number::{Inputs, Quantity};
    use proptest::prelude::*;

    fn number(text: &str) -> Number {
        Number::decimal(text).unwrap()
    }

    /// The precision of a loop whose geometry holds these numbers.
    fn of(texts: &[&str]) -> Precision {
        *loop_of("", texts).build().unwrap().precision()
    }

    /// A loop of fixed joints, `name`d and counted from `0`, whose geometry holds these numbers.
    fn loop_of(name: &str, texts: &[&str]) -> MechanismBuilder {
        let mut builder = MechanismBuilder::new("numbers");
        builder.link("0");
        add_loop(&mut builder, name, texts);
        builder
    }

    fn add_loop(builder: &mut MechanismBuilder, name: &str, texts: &[&str]) {
        let link = |index: usize| match index {
            0 => "0".to_owned(),
            _ => format!("{name}{index}"),
        };
        for (index, text) in texts.iter().enumerate() {
            let (parent, child) = (link(index), link(index + 1));
            builder.link(&child);
            let frame = Frame::at([number(text), Number::zero(), Number::zero()]);
            let joint = format!("{name}j{index}");
            builder
                .joint(JointBuilder::tree(&joint, JointKind::Fixed, &parent, &child).origin(frame));
        }
        if !texts.is_empty() {
            let (last, closing) = (link(texts.len()), format!("{name}closing"));
            builder.joint(JointBuilder::closing(
                &closing,
                JointKind::Fixed,
                "0",
                &last,
            ));
        }
    }

    #[test]
    fn what_is_in_no_loop_states_nothing() {
        let mut builder = loop_of("a", &["0.25", "3"]);
        add_loop(&mut builder, "b", &["0.866025", "1"]);
        for (at, joint) in [("0", "mount"), ("a1", "bracket")] {
            let frame = Frame::at_point([0.123456789, 0.0, 1000.5]).unwrap();
            let camera = format!("{joint}_camera");
            builder.link(&camera);
            builder.joint(JointBuilder::tree(joint, JointKind::Fixed, at, &camera).origin(frame));
        }
        let mechanism = builder.build().unwrap();
        let of = |name: &str| *mechanism.precision_of(mechanism.joint_named(name).unwrap());
        assert_eq!(of("aj0"), super::tests::of(&["0.25", "3"]));
        assert!(of("aj0").is_exact() && of("mount").is_exact() && of("bracket").is_exact());
        assert_eq!(of("mount").uncertainty(0, &number("0.123456789")), 0.0);
        assert_eq!(of("bj1").decimals, Some(6));
        assert_uncertainty(&of("bj1"), "0.5", 0.5e-6);
        // Together they are what the less exact one is, and it is told by which number.
        let together = mechanism.precision();
        assert!(!together.is_exact());
        let rounded_by = mechanism.joint_named("bj0").unwrap().0;
        assert_eq!(
            together.rounded_by(),
            Some(LiteralPlace::Joint(rounded_by, 0))
        );
        assert_eq!(of("aj0").rounded_by(), None);
        let by_hand = mechanism.with_precision(1e-3);
        assert!(!by_hand.precision_of(JointId(0)).is_exact());
        let mount = by_hand.joint_named("mount").unwrap();
        assert!(by_hand.precision_of(mount).is_exact());
    }

    #[track_caller]
    fn assert_uncertainty(precision: &Precision, text: &str, expected: f64) {
        let found = precision.uncertainty(0, &number(text));
        assert!(
            (found - expected).abs() <= 1e-12 * expected,
            "{text}: {found:e} instead of {expected:e}"
        );
    }

    /// A number that changes by `slope` times what an angle changes by.
    fn worked_out(value: Number, angle: &str, slope: f64) -> Number {
        let mut inputs = Inputs::default();
        inputs.add(Quantity::Angle, &number(angle), slope);
        value.derived_from(inputs)
    }

    #[test]
    fn what_is_worked_out_is_as_uncertain_as_the_literals_behind_it() {
        let of = |numbers: &[Number]| {
            let placed = numbers.iter().map(|n| (LiteralPlace::Joint(0, 0), n));
            let [precision, _] = Precision::of(placed, []);
            precision
        };
        let quarter = || Number::from_f64(0.25).unwrap();
        let rounded = [
            worked_out(quarter(), "0.433013", 2.0),
            worked_out(quarter(), "0.776457", 1.0),
        ];
        let precision = of(&rounded);
        assert!(!precision.is_exact());
        assert_eq!(precision.decimals, Some(6));
        let off = |precision: &Precision| rounded.each_ref().map(|n| precision.uncertainty(0, n));
        let [two, one] = off(&precision);
        assert!((two - 1e-6).abs() < 1e-15 && (one - 0.5e-6).abs() < 1e-15);
        assert_eq!(off(&precision.known_to(1e-3)), [2e-3, 1e-3]);
        assert_eq!(off(&precision.known_to(0.0)), [0.0; 2]);
        // What was chosen leaves an exact number exact, and a computed one the rounding of its text.
        let exact = worked_out(quarter(), "0.3", 2.0);
        assert!(of(std::slice::from_ref(&exact)).is_exact());
        let computed = worked_out(number("0.295520206661340"), "0.3", 1.0);
        let precision = of(std::slice::from_ref(&computed));
        let own = of(&[number("0.295520206661340")]);
        assert!(!precision.is_exact() && precision == own);
        let left = precision.uncertainty(0, &computed);
        assert!(left > 0.0 && left < 1e-14, "{left:e}");
    }

    #[test]
    fn beside_rounded_directions_lengths_in_a_small_unit_are_chosen() {
        let direction = (0..)
            .find(|place| Joint::kind_of_number(*place) == 2)
            .unwrap();
        let beside = |lengths: &[&str]| {
            let lengths: Vec<Number> = lengths.iter().map(|text| number(text)).collect();
            let third = number("0.333333333333");
            let all = lengths
                .iter()
                .map(|length| (LiteralPlace::Joint(0, 0), length));
            let all = all.chain([(LiteralPlace::Joint(0, direction), &third)]);
            let [precision, _] = Precision::of(all, []);
            lengths
                .iter()
                .map(|length| precision.uncertainty(0, length))
                .fold(0.0, f64::max)
        };
        assert_eq!(beside(&["0.002", "0.003", "0.001"]), 0.0);
        assert_eq!(beside(&["0.00002", "0.000035"]), 0.0);
        assert_eq!(beside(&["0.0012", "0.0007"]), 0.0);
        assert_eq!(beside(&["0.0123", "0.0007"]), 0.5e-4);
        assert_eq!(beside(&["0.025", "0.013", "0.01"]), 0.5e-3);
    }

    /// How far the lengths of a tree, and of the joints that close its loops, may be off; a coarse direction stands beside them.
    fn two_sides(tree: &[&str], closing: &[&str]) -> [Vec<f64>; 2] {
        let direction = (0..)
            .find(|place| Joint::kind_of_number(*place) == 2)
            .unwrap();
        let sides = [tree, closing].map(|texts| texts.iter().map(|t| number(t)).collect());
        let placed = |side: &'static str| move |n| (LiteralPlace::Joint(side.len(), 0), n);
        let [tree, closing]: &[Vec<Number>; 2] = &sides;
        let third = number("0.3333");
        let axis = [(LiteralPlace::Joint(0, direction), &third)];
        let of_tree = tree.iter().map(placed("tree")).chain(axis);
        let found = Precision::of(of_tree, closing.iter().map(placed("closing")));
        [0, 1].map(|side| {
            let all = sides[side].iter();
            all.map(|n| found[side].uncertainty(0, n)).collect()
        })
    }

    #[test]
    fn loops_of_another_program_have_digits_of_their_own() {
        let six = ["0.659148", "-1.641397", "1.860928", "-0.049371", "-0.40791"];
        let four = ["-0.0394", "2.4030", "-0.6885", "-1.649"];
        assert_eq!(two_sides(&six, &four), [vec![0.5e-6; 5], vec![0.5e-4; 4]]);
        // The other way round as well; and numbers that somebody chose are no rounded ones.
        assert_eq!(two_sides(&four, &six), [vec![0.5e-4; 4], vec![0.5e-6; 5]]);
        let [_, chosen] = two_sides(&six, &["0.125", "0.25", "0.375", "2"]);
        assert_eq!(chosen, [0.5e-6; 4]);
        let [whole, _] = two_sides(&["0.000002", "0.000001"], &["0.0000012566370614359172953"]);
        assert!(whole.iter().all(|u| *u < 1e-20));
        let doubles = [
            "0.6591480000000017",
            "-1.6413970000000123",
            "1.860928317762219",
        ];
        let [full, fine] = two_sides(&doubles, &["0.659148", "-1.641397", "0.3059"]);
        assert!(full.iter().all(|u| *u < 1e-15));
        assert_eq!(fine, [0.5e-6; 3]);
    }

    #[test]
    fn an_axis_of_single_digits_was_typed() {
        let direction = (0..)
            .find(|place| Joint::kind_of_number(*place) == 2)
            .unwrap();
        let axis = |texts: [&str; 3]| {
            let numbers = texts.map(number);
            let placed = numbers
                .iter()
                .map(|n| (LiteralPlace::Joint(0, direction), n));
            let [precision, _] = Precision::of(placed, []);
            precision.uncertainty(direction, &numbers[1])
        };
        assert_eq!(axis(["1", "0.001", "0"]), 0.0);
        assert_eq!(axis(["0.707", "0.707", "0"]), 0.5e-3);
    }

    #[test]
    fn lengths_of_four_digits_beside_rounded_directions_are_rounded() {
        let printed = [
            "-45.73", "79.99", "102.5", "-17.34", "72.82", "105", "-8.94",
        ];
        let [off, _] = two_sides(&printed, &[]);
        for (found, expected) in off.iter().zip([5e-3, 5e-3, 0.05, 5e-3, 5e-3, 0.05, 5e-3]) {
            assert!((found - expected).abs() <= 1e-9, "{off:?}");
        }
        let [chosen, _] = two_sides(&["45", "80.5", "12.25", "7", "30", "105"], &[]);
        assert_eq!(chosen, [0.0; 6]);
    }

    #[test]
    fn a_longer_number_among_short_ones_was_typed() {
        let rounded = of(&["0.35", "0.71", "0.4", "1.27", "0.28", "0.93"]);
        assert!(
            rounded.is_exact() && rounded.may_be_rounded_to(2) && !rounded.may_be_rounded_to(3)
        );
        assert!(of(&["0.10", "0.20", "0.30", "0.01", "0.50", "0.60"]).may_be_rounded_to(2));
        let typed = of(&["0.1", "0.2", "0.3", "0.01", "0.5", "0.6"]);
        assert!(typed.is_exact() && !typed.may_be_rounded_to(2));
    }

    #[test]
    fn fixed_decimals_with_stripped_zeros() {
        // Written with four decimals: 0.5 stands for 0.5000. Five significant digits from 12.3457 do not bind.
        let precision = of(&["0.8660", "12.3457", "0.5", "0"]);
        assert_eq!(precision.decimals, Some(4));
        assert_eq!(precision.significant, 6);
        for text in ["0.866", "12.3457", "0.5", "0", "0.0000", "-0.25"] {
            assert_uncertainty(&precision, text, 0.5e-4);
        }
    }

    #[test]
    fn significant_digits_with_stripped_zeros() {
        // Six significant digits: 123.457, 0.0123457, and 8 for 8.00000.
        let precision = of(&["123.457", "0.0123457", "8"]);
        assert_eq!((precision.decimals, precision.significant), (Some(7), 6));
        assert_uncertainty(&precision, "123.457", 0.5e-3);
        assert_uncertainty(&precision, "0.0123457", 0.5e-7);
        assert_uncertainty(&precision, "8", 0.5e-5);
        assert_uncertainty(&precision, "-25.5", 0.5e-4);
        // 2000.00, of which nothing but the 2 is left.
        assert_uncertainty(&precision, "2000", 0.5e-2);
        assert_uncertainty(&precision, "2e3", 0.5e-2);
        // A zero has no digits: the finest decimal place of the file.
        assert_uncertainty(&precision, "0", 0.5e-7);
    }

    #[test]
    fn zeros_state_no_decimals_of_other_numbers() {
        for texts in [
            &["1", "2", "0.000000"][..],
            &["0.25", "0.000000000000000"],
            &["0.000"],
        ] {
            let precision = of(texts);
            assert!(precision.is_exact(), "{texts:?}");
            assert_uncertainty(&precision, texts[0], 0.0);
        }
        let rounded = of(&["0.866", "1", "0.000000"]);
        assert_eq!((rounded.decimals, rounded.significant), (Some(3), 3));
        assert_uncertainty(&rounded, "0", 0.5e-3);
        assert_uncertainty(&rounded, "0.000000", 0.5e-6);
        // By hand, zeros are as uncertain as anything.
        assert!(!of(&["0.000"]).known_to(1e-3).is_exact());
    }

    #[test]
    fn more_than_17_digits_of_a_double_state_nothing() {
        let double = "2.121320343559642385145025400561280548572540283203125";
        assert_uncertainty(&of(&[double, "3"]), double, 0.5e-16);
        assert_uncertainty(&of(&["2.12132034355964238515", "3"]), "3", 0.5e-16);
        // √(9/2) in as many digits is no double.
        let longer = "2.121320343559642573202533086314547117854507813065422";
        assert_uncertainty(&of(&[longer, double]), longer, 0.5e-51);
    }

    #[test]
    fn powers_of_ten_belong_to_the_decade_they_begin() {
        let precision = of(&["1.23456", "0.000123456"]);
        assert_eq!((precision.decimals, precision.significant), (Some(9), 6));
        for exponent in -4..8 {
            let expected = 0.5 * 10f64.powi((exponent - 5).max(-9));
            assert_uncertainty(&precision, &format!("1e{exponent}"), expected);
            assert_uncertainty(&precision, &format!("9e{exponent}"), expected);
        }
    }

    #[test]
    fn a_number_is_no_more_certain_than_its_own_digits_where_none_were_stripped() {
        let precision = of(&["1.234567890123456", "100.5"]);
        assert_uncertainty(&precision, "1.234567890123456", 0.5e-15);
        assert_uncertainty(&precision, "100.5", 0.5e-13);
    }

    #[test]
    fn chosen_numbers_are_exact() {
        for texts in [
            &["0.25", "3", "-17.5", "1e3"][..],
            &["0"][..],
            &["300"][..],
            &["0.25", "0.125"][..],
            &["0.00425", "0.00125"][..],
            &[][..],
        ] {
            let precision = of(texts);
            assert!(precision.is_exact(), "{texts:?}");
            for text in texts {
                assert_eq!(precision.uncertainty(0, &number(text)), 0.0);
            }
        }
        // One number of three decimals, and none of them is chosen.
        let precision = of(&["0.25", "1.125"]);
        assert!(!precision.is_exact());
        assert_uncertainty(&precision, "0.25", 0.5e-3);
    }

    #[test]
    fn zeros_at_the_end_of_every_literal_are_padding() {
        let precision = of(&[
            "0.112527000000",
            "0.025656900000",
            "1.000000000000",
            "0.000000000000",
            "-0.013100000000",
        ]);
        assert_eq!((precision.decimals, precision.significant), (Some(7), 6));
        assert_uncertainty(&precision, "0.112527000000", 0.5e-6);
        assert_uncertainty(&precision, "0.025656900000", 0.5e-7);
        assert_uncertainty(&precision, "0.000000000000", 0.5e-7);
        // One literal that has digits there, and they are stated.
        let precision = of(&[
            "0.112527000000",
            "0.025656900001",
            "1.000000000000",
            "-0.013100000000",
        ]);
        assert_uncertainty(&precision, "0.112527000000", 0.5e-12);
        // A single one may end so by choice.
        assert!(!of(&["0.500000000000"]).is_exact());
        assert!(!of(&["0.500000", "0.250000", "1.000000", "-0.750000"]).is_exact());
        assert!(
            of(&[
                "0.500000000000",
                "0.250000000000",
                "1.000000000000",
                "-0.750000000000"
            ])
            .is_exact()
        );
    }

    #[test]
    fn expressions_are_exact() {
        let expression = |text: &str| Number::expression(text, &mut |_| Ok(None)).unwrap();
        let mut builder = MechanismBuilder::new("exact");
        builder.link("a").link("b");
        builder.joint(
            JointBuilder::tree("j", JointKind::Screw, "a", "b")
                .origin(Frame::at([
                    expression("sqrt(3)/2"),
                    expression("0.123456789"),
                    Number::from_f64(0.1).unwrap(),
                ]))
                .lead(expression("1/3")),
        );
        builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
        let precision = *builder.build().unwrap().precision();
        assert_eq!(precision, Precision::default());
        assert!(precision.is_exact());
        // Beside rounded numbers they stay exact.
        let rounded = of(&["0.866025"]);
        assert_eq!(rounded.uncertainty(0, &expression("sqrt(3)/2")), 0.0);
        assert_eq!(rounded.uncertainty(0, &expression("0.866025")), 0.0);
    }

    #[test]
    fn every_number_of_the_geometry_is_read() {
        let frame = |position: &str, angle: &str| Frame {
            position: [Number::zero(), Number::zero(), number(position)],
            roll_pitch_yaw: [Number::zero(), number(angle), Number::zero()],
        };
        let along = |text: &str| Direction([Number::one(), number(text), Number::zero()]);
        let hinge = || JointBuilder::tree("j", JointKind::Universal, "a", "b");
        let screw = JointBuilder::tree("j", JointKind::Screw, "a", "b");
        let rod = JointBuilder::tree("j", JointKind::Distance, "a", "b");
        for joint in [
            hinge().origin(frame("0.125", "0")),
            hinge().origin(frame("0", "0.125")),
            hinge().successor_origin(frame("0.125", "0")),
            hinge().axis(along("0.125")),
            hinge().axis2(along("0.125")),
            screw.lead(number("0.125")),
            rod.distance(number("0.125")),
        ] {
            let mut builder = MechanismBuilder::new("one");
            builder.link("a").link("b");
            builder.joint(joint);
            builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
            let precision = *builder.build().unwrap().precision();
            assert_eq!((precision.decimals, precision.significant), (Some(3), 3));
        }
        let mut builder = MechanismBuilder::new("floating");
        builder.link("a").link("b");
        builder.floating("f", "a", "b", frame("0.125", "0"));
        for joint in ["j", "k"] {
            builder.joint(JointBuilder::closing(joint, JointKind::Spherical, "a", "b"));
        }
        assert_eq!(builder.build().unwrap().precision().decimals, Some(3));
    }

    #[test]
    fn endless_digits_and_exponents_stay_in_range() {
        let long = format!("0.{}", "3".repeat(5000));
        let precision = of(&[&long, "1e-900"]);
        assert_eq!(precision.uncertainty(0, &number(&long)), 0.0);
        assert!(precision.uncertainty(0, &number("1e99")) < 1.0);
    }

    proptest! {
        /// A value written to a fixed number of decimals, or to a fixed number of significant digits, zeros stripped or
        /// not, is never further from the value meant than the file's precision says.
        #[test]
        fn the_value_meant_is_within_the_uncertainty(
            // Three digits at least: an integer is written out, whatever its digits are worth.
            values in prop::collection::vec(-999.0f64..999.0, 1..12),
            digits in 3usize..9,
            significant: bool,
            stripped: bool,
        ) {
            let write = |value: f64| {
                let decimals = if significant {
                    // `{:e}` knows the decade of the rounded value.
                    let scientific = format!("{value:.*e}", digits - 1);
                    let exponent: i32 = scientific.split('e').nth(1).unwrap().parse().unwrap();
                    usize::try_from(digits as i32 - 1 - exponent).unwrap_or(0)
                } else {
                    digits
                };
                let text = format!("{value:.decimals$}");
                if stripped && text.contains('.') {
                    text.trim_end_matches('0').trim_end_matches('.').to_owned()
                } else {
                    text
                }
            };
            let texts: Vec<String> = values.iter().map(|v| write(*v)).collect();
            let precision = of(&texts.iter().map(String::as_str).collect::<Vec<_>>());
            prop_assume!(!precision.is_exact());
            for (value, text) in values.iter().zip(&texts) {
                let written = number(text);
                let error = (written.value() - value).abs();
                let allowed = precision.uncertainty(0, &written);
                prop_assert!(
                    error <= allowed * (1.0 + 1e-6) + 1e-12,
                    "{} as {}: off by {:e}, allowed {:e}", value, text, error, allowed
                );
            }
        }
    }
}
