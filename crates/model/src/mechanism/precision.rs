//! How far a file's numbers may be from the numbers meant: judged for every independent sub-mechanism by itself.

use super::constants::{has_no_more_than_a_double, is_printed_double};
use super::link::Placement;
use super::model::Mechanism;
use crate::graph::{Block, ConstraintGraph};
use kutzbach_math::number::{Number, Stated};

/// How precisely a file states the geometry of one independent sub-mechanism.
///
/// A rounded number differs from the number meant by up to half a unit of its last place. Writers round in two manners,
/// to a fixed number of decimals or to a fixed number of significant digits, and both strip trailing zeros. With `D` the
/// most decimals and `S` the most significant digits found in the geometry, a literal `x` with `d` decimals is uncertain by
///
/// ```text
/// u(x) = ½ min(10⁻ᵈ, max(10⁻ᴰ, 10⁻ˢ 10ᵉ)),   10ᵉ⁻¹ ≤ |x| < 10ᵉ
/// ```
///
/// which is right for both manners: the first term wherever no zeros were stripped, the second where they were. Zeros do not count
/// for `D`: `0.000000` stands beside whole numbers as `0` does. Expressions are exact. Numbers that all have at most [`Precision::EXACT_DECIMALS`] decimals are those that a designer
/// chose, not rounded ones, and are taken as exact too. Decimals of lengths count in the decade of the longest one, if that
/// is below 1 m: `0.125` says of metres what `1.25` says of decimetres. Literals that were read as constants
/// ([`Recognised`](super::Recognised)) are exact; those that were read as shorter decimals state what these state. Where every
/// literal ends in zeros, at least three more than it needs, in twelve digits or more, these are padding and state nothing. Printed
/// doubles state 17 significant digits, however many are printed.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Precision {
    /// Most decimals of any literal in the geometry but zeros, for which 0 counts; `None` where there is no literal.
    pub decimals: Option<i32>,
    /// Most significant digits of any literal in the geometry.
    pub significant: u32,
    /// Most decimals of any literal, those of lengths counted in the decade of the longest one.
    designed: i32,
    /// Whether all literals are padded with zeros that say nothing.
    padded: bool,
    /// Whether the longest literals are printed doubles.
    doubles: bool,
    /// What is said to be known of every literal, whatever its digits say (m, rad).
    by_hand: Option<f64>,
    /// Where the literal is that `designed` comes from.
    finest: Option<LiteralPlace>,
}

impl Precision {
    /// Zeros at the end of every literal of a file are padding if they are so many: of few literals, too many for chance.
    const PADDING: u32 = 3;

    /// Fewer significant digits than this are what people round to, zeros included.
    const LONG: u32 = 12;

    /// Literals it takes for that.
    const PADDED_LITERALS: usize = 4;

    /// Up to this many decimals in the whole file, literals are exact.
    pub const EXACT_DECIMALS: i32 = 2;

    /// Whether every number of the geometry is exact.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        match self.by_hand {
            Some(uncertainty) => uncertainty == 0.0 || self.decimals.is_none(),
            None => self.designed <= Self::EXACT_DECIMALS,
        }
    }

    /// Whether the file's digits are those of doubles that some program printed. They say how the program computes, not how
    /// well it knows its numbers.
    #[must_use]
    pub fn is_of_doubles(&self) -> bool {
        self.doubles && self.by_hand.is_none()
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

    /// How far a number of this file may be from the number meant; zero for exact ones.
    #[must_use]
    pub fn uncertainty(&self, number: &Number) -> f64 {
        let (Some(stated), Some(most), false) = (number.stated(), self.decimals, self.is_exact())
        else {
            return 0.0;
        };
        if let Some(uncertainty) = self.by_hand {
            return uncertainty;
        }
        let stated = if self.padded {
            bare(number, stated)
        } else {
            stated
        };
        let stated = if self.doubles {
            of_a_double(stated)
        } else {
            stated
        };
        // With s digits of which the last is worth 10⁻ᵈ, the first is worth 10ˢ⁻ᵈ⁻¹: so e = s − d, without a logarithm.
        let written = i64::from(stated.significant);
        let by_digits = if written > 0 {
            power_of_ten(written - i64::from(stated.decimals) - i64::from(self.significant))
        } else {
            0.0
        };
        let by_decimals = power_of_ten(-i64::from(most));
        0.5 * power_of_ten(-i64::from(stated.decimals)).min(by_decimals.max(by_digits))
    }

    /// The literal that makes the numbers rounded: of those with most decimals the first; `None` where the numbers are exact by
    /// their digits.
    #[must_use]
    pub fn rounded_by(&self) -> Option<LiteralPlace> {
        let rounded = self.designed > Self::EXACT_DECIMALS;
        self.finest.filter(|_| rounded)
    }

    /// The precision of some numbers that one file states of one sub-mechanism.
    fn of<'a>(numbers: impl IntoIterator<Item = (LiteralPlace, &'a Number)>) -> Self {
        let (mut lengths, mut directions) = (Digits::default(), Digits::default());
        for (place, number) in numbers {
            match place.turns() {
                true => directions.read(place, number),
                false => lengths.read(place, number),
            }
        }
        let significant = lengths.significant.max(directions.significant);
        let bare = lengths.bare.1.max(directions.bare.1);
        let padded = significant >= Self::LONG.max(bare + Self::PADDING)
            && lengths.count + directions.count >= Self::PADDED_LITERALS;
        if padded {
            for digits in [&mut lengths, &mut directions] {
                (digits.decimals, digits.significant) = digits.bare;
            }
        }
        let decade = lengths.places.map_or(0, |places| places.min(0));
        let doubles =
            (lengths.printed || directions.printed) && !lengths.longer && !directions.longer;
        let significant = lengths.significant.max(directions.significant);
        let of_lengths = lengths
            .decimals
            .map_or(0, |decimals| decimals.saturating_add(decade));
        let of_directions = directions.decimals.unwrap_or(0);
        Self {
            decimals: lengths.decimals.max(directions.decimals),
            significant: match doubles {
                true => significant.min(OF_A_DOUBLE),
                false => significant,
            },
            designed: of_lengths.max(of_directions),
            padded,
            doubles,
            by_hand: None,
            finest: match of_lengths >= of_directions {
                true => lengths.finest,
                false => directions.finest,
            },
        }
    }

    /// What holds of two sub-mechanisms together: exact if both are, and the digits of the longer literals.
    fn with(self, other: &Self) -> Self {
        let finer = match other.designed > self.designed {
            true => other,
            false => &self,
        };
        Self {
            decimals: self.decimals.max(other.decimals),
            significant: self.significant.max(other.significant),
            designed: finer.designed,
            padded: self.padded && other.padded,
            doubles: self.doubles || other.doubles,
            by_hand: self.by_hand,
            finest: finer.finest,
        }
    }
}

/// Where a literal of the geometry stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LiteralPlace {
    /// In a joint: its index, and the place in [`Joint::numbers`].
    Joint(usize, usize),
    /// In the frame in which a link is placed without a joint: the link's index, and the place as in a joint's first frame.
    Link(usize, usize),
}

impl LiteralPlace {
    /// Whether an angle or a component of a direction stands there, and no length.
    #[must_use]
    pub fn turns(self) -> bool {
        let (Self::Joint(_, place) | Self::Link(_, place)) = self;
        (3..6).contains(&place) || (9..18).contains(&place)
    }
}

/// The precisions of a mechanism's independent sub-mechanisms: the biconnected blocks of its constraint graph.
///
/// A sub-mechanism's numbers are read from the literals that bear on its own loops: those of its joints, and the places of its links
/// where no joint places them. What lies in no loop, such as the frame of a camera that is fixed to a link, bears on nothing.
#[derive(Clone, Debug, PartialEq, Default)]
pub(super) struct Precisions {
    blocks: Vec<Precision>,
    /// Index in `blocks` of every joint's; `None` for joints in no loop.
    of_joint: Vec<Option<usize>>,
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
                .for_each(|&joint| of_joint[joint] = Some(index));
        }
        let blocks: Vec<Precision> = loops
            .iter()
            .map(|block| Precision::of(bearing(mechanism, block)))
            .collect();
        let mut all = blocks.iter();
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
        for precision in all.into_iter().chain(&mut self.blocks) {
            *precision = precision.known_to(uncertainty);
        }
        self
    }

    pub(super) fn together(&self) -> &Precision {
        &self.together
    }

    pub(super) fn of_joint(&self, joint: usize) -> &Precision {
        let block = self.of_joint.get(joint).copied().flatten();
        block.map_or(&self.exact, |block| &self.blocks[block])
    }

    /// Index of the independent sub-mechanism that a joint belongs to; `None` for joints in no loop.
    pub(super) fn block(&self, joint: usize) -> Option<usize> {
        self.of_joint.get(joint).copied().flatten()
    }
}

/// The literals that bear on a block's loops, in file order.
fn bearing<'a>(
    mechanism: &'a Mechanism,
    block: &Block,
) -> impl Iterator<Item = (LiteralPlace, &'a Number)> {
    let mut joints = block.edges.clone();
    joints.sort_unstable();
    let mut links = block.nodes.clone();
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

/// Significant digits that tell doubles apart.
const OF_A_DOUBLE: u32 = 17;

/// The digits found in a kind of numbers.
#[derive(Default)]
struct Digits {
    /// Most decimals of any literal.
    decimals: Option<i32>,
    /// Where the first of those is that have so many.
    finest: Option<LiteralPlace>,
    /// Most significant digits of any literal.
    significant: u32,
    /// Both without zeros at the end.
    bare: (Option<i32>, u32),
    /// Literals that have a decimal point and are not zero.
    count: usize,
    /// Whether some literal that states its precision is a printed double.
    printed: bool,
    /// Whether some literal has more digits than a double holds.
    longer: bool,
    /// Power of ten of the first digit of the largest literal: 0 for `1.25`, −1 for `0.125`.
    places: Option<i32>,
}

impl Digits {
    fn read(&mut self, place: LiteralPlace, number: &Number) {
        let Some(stated) = number.stated() else {
            return;
        };
        // However a zero is written, it says nothing of how other numbers were rounded.
        let decimals = match stated.significant {
            0 => stated.decimals.min(0),
            _ => stated.decimals,
        };
        if self.decimals.is_none_or(|most| decimals > most) {
            (self.decimals, self.finest) = (Some(decimals), Some(place));
        }
        self.significant = self.significant.max(stated.significant);
        let bare = bare(number, stated);
        self.bare.0 = self.bare.0.max(Some(bare.decimals));
        self.bare.1 = self.bare.1.max(bare.significant);
        let pointed = number.literal_text().is_some_and(|text| text.contains('.'));
        self.count += usize::from(pointed && stated.significant > 0);
        // What was read as a shorter decimal has the digits of that.
        if number.written() == Some(stated) {
            self.longer |= !has_no_more_than_a_double(number);
            self.printed |= is_printed_double(number);
        }
        if stated.significant > 0 {
            let written = i64::from(stated.significant) - i64::from(stated.decimals) - 1;
            let place = written.clamp(i64::from(i32::MIN), i64::from(i32::MAX)) as i32;
            self.places = self.places.max(Some(place));
        }
    }
}

/// The digits of a literal without the zeros at the end of its decimals.
fn bare(number: &Number, stated: Stated) -> Stated {
    // What was read as a shorter decimal has no such zeros.
    let text = number
        .literal_text()
        .filter(|_| number.written() == Some(stated));
    let mantissa = text.and_then(|text| text.split(['e', 'E']).next());
    let Some((_, fraction)) = mantissa.and_then(|mantissa| mantissa.split_once('.')) else {
        return stated;
    };
    let zeros = fraction.len() - fraction.trim_end_matches('0').len();
    let zeros = u32::try_from(zeros).unwrap_or(0);
    Stated {
        decimals: stated.decimals.saturating_sub_unsigned(zeros),
        significant: stated.significant.saturating_sub(zeros),
    }
}

/// What a double states of the digits that are printed of it.
fn of_a_double(stated: Stated) -> Stated {
    let beyond = stated.significant.saturating_sub(OF_A_DOUBLE);
    Stated {
        decimals: stated.decimals.saturating_sub_unsigned(beyond),
        significant: stated.significant - beyond,
    }
}

/// Zero and infinity where the power is out of range.
fn power_of_ten(exponent: i64) -> f64 {
    const BEYOND: i64 = 400;
    10f64.powi(exponent.clamp(-BEYOND, BEYOND) as i32)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::Direction;
    use super::super::{Frame, JointBuilder, JointId, JointKind, MechanismBuilder};
    use super::*;
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
        assert_eq!(of("mount").uncertainty(&number("0.123456789")), 0.0);
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
        let found = precision.uncertainty(&number(text));
        assert!(
            (found - expected).abs() <= 1e-12 * expected,
            "{text}: {found:e} instead of {expected:e}"
        );
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
                assert_eq!(precision.uncertainty(&number(text)), 0.0);
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
        assert_eq!(rounded.uncertainty(&expression("sqrt(3)/2")), 0.0);
        assert_eq!(rounded.uncertainty(&expression("0.866025")), 0.0);
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
        assert_eq!(precision.uncertainty(&number(&long)), 0.0);
        assert!(precision.uncertainty(&number("1e99")) < 1.0);
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
                let allowed = precision.uncertainty(&written);
                prop_assert!(
                    error <= allowed * (1.0 + 1e-6) + 1e-12,
                    "{} as {}: off by {:e}, allowed {:e}", value, text, error, allowed
                );
            }
        }
    }
}
