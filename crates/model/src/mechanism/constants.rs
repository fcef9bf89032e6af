//! Constants that a file writes as decimals: `1.5707963267948966` is π/2, `6.123e-17` is 0.
//!
//! # What is read as what
//! A file cannot write π, and programs that write files turn right angles and zeros into doubles. A literal of the geometry is
//! read as a constant where it equals one within its own precision, and is so precise that equality by chance is implausible:
//!
//! | of | is read as |
//! |---|---|
//! | a roll, pitch or yaw | a multiple of π/4, of π/12, of π/360 |
//! | an axis | the root of a fraction p/q, q ≤ 12, if all components are and their squares add up to 1 |
//! | anything | 0 beside numbers of ordinary size; a short decimal, of which it has the rounding of doubles (`0.30000000000000004`) |
//!
//! # How precise
//! A number known to within ±t lies by chance within t of some candidate with probability 2t/s, if candidates are s apart;
//! at most [`CHANCE`] is allowed. That asks for 4 decimals of a multiple of π/4 (`1.5708`), for 5 of one of π/12, for 6 of
//! one of π/360, and for 6 of a root. And what is taken for a constant by chance, once in some thousand numbers, is moved by
//! no more than its digits leave open.
//!
//! `t` is half a unit of the last digit. A literal of at least [`DIGITS_OF_DOUBLES`] digits that holds no more than a double
//! was printed by a program, and its last digits are what the program's arithmetic left: products of a few frames are off by
//! some tens of units of roundoff, of numbers of the size of the whole ([`COMPUTED`]; `2.8421709e-14` for 0 and
//! `0.32599840000000002` have been met). A text of fewer than [`DIGITS_OF_CHOICE`] digits may be chosen, such as `1e-14`; what
//! vanishes beside the numbers around it by [`VANISHING`] is still no measure, such as `3e-31`.

use super::frame::{Direction, Frame};
use super::link::Placement;
use super::model::Mechanism;
use super::precision_by_block::Precisions;
use super::residues::residues;
use kutzbach_math::number::Number;
use std::f64::consts::PI;

/// Probability that is allowed of taking a number for a constant by chance.
const CHANCE: f64 = 2e-4;

/// A unit of so many places further on is the first that is no more than [`CHANCE`] of a unit, twice: 10⁻⁴ ≤ ½ [`CHANCE`].
const PLACES_OF_CHANCE: i32 = 4;

/// The fewest decimals that tell a multiple of π/4 from chance: 10⁻⁴ ≤ [`CHANCE`] π/4.
const OF_ANGLES: i32 = 4;

/// What is printed with so many significant digits comes from a program.
const DIGITS_OF_DOUBLES: u32 = 15;

/// Nobody chooses a measure of the size of rounding with so many significant digits.
const DIGITS_OF_CHOICE: u32 = 4;

/// What a program's arithmetic leaves, relative to the size of the numbers: 512 units of roundoff.
const COMPUTED: f64 = 1.0 / (1u64 << 44) as f64;

/// What vanishes beside other numbers: 8 units of roundoff.
const VANISHING: f64 = 1.0 / (1u64 << 50) as f64;

/// What doubles of a few operations are off by, relative to themselves: 32 units of roundoff.
const ROUNDINGS: f64 = 1.0 / (1u64 << 48) as f64;

/// Lengths count as no longer than this (m) where others are held against them: far off the origin, a metre is still meant.
const LONGEST: f64 = 1e3;

/// The largest denominator under a root.
const LARGEST_DENOMINATOR: i64 = 12;

/// Fractions p/q between 0 and 1 with q ≤ 12: so many candidates for a component.
const FRACTIONS: f64 = 47.0;

/// The literals that were read as constants.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Recognised {
    /// How many.
    pub count: usize,
    /// Texts and what they are read as, such as `("1.5707963267948966", "π/2")`: the first of each reading, in file order.
    pub examples: Vec<(String, String)>,
    /// Literals that were read as 0 because they are what rounding left of one, in the order of joints.
    pub residues: Vec<Residue>,
}

/// What rounding left of a zero.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Residue {
    /// The literal.
    pub text: String,
    /// Joint index.
    pub joint: usize,
    /// Place in [`Joint::numbers`](super::Joint::numbers).
    pub place: usize,
}

/// Whether a literal can be the output of a program that prints doubles: it has their digits, and no more than they hold.
/// (Programs print up to 55 digits of a double, but not those of the number behind it.)
pub(super) fn is_printed_double(number: &Number) -> bool {
    let long = number
        .written()
        .is_some_and(|written| written.significant >= DIGITS_OF_DOUBLES);
    long && has_no_more_than_a_double(number)
}

/// Whether the nearest double has the same digits as the literal, as far as those go.
pub(super) fn has_no_more_than_a_double(number: &Number) -> bool {
    let Some(written) = number.written() else {
        return false;
    };
    // 17 digits tell doubles apart.
    written.significant <= 17
        || Number::from_f64(number.value())
            .is_some_and(|double| distance(number, &double) <= half_unit(written.decimals))
}

/// Whether a literal has decimals enough for an angle, which asks for the fewest, or digits enough to come from a program: what is read as
/// anything else has more. Residues are below a tenth of a millimetre, and have more decimals, too.
fn may_be_constant(number: &Number) -> bool {
    let written = number.written();
    written.is_some_and(|own| own.decimals >= OF_ANGLES || own.significant >= DIGITS_OF_DOUBLES)
}

/// Half a unit of the last digit.
pub(super) fn half_unit(decimals: i32) -> f64 {
    0.5 * 10f64.powi(-decimals)
}

/// |a − b|, however much cancels.
pub(super) fn distance(a: &Number, b: &Number) -> f64 {
    (a - b).value().abs()
}

/// How far a literal may be from the number meant, if that is a constant.
struct Reach<'a> {
    number: &'a Number,
    value: f64,
    /// What counts as zero.
    vanishing: f64,
    /// What rounding leaves of a zero.
    noise: f64,
    /// Half a unit of the last digit, or what rounding leaves.
    tolerance: f64,
    /// Decimals of the text.
    decimals: i32,
    computed: bool,
}

impl<'a> Reach<'a> {
    /// `None` for what is not a literal. `size` is that of the numbers around it.
    fn of(number: &'a Number, size: f64) -> Option<Self> {
        let written = number.written()?;
        number.stated()?;
        let value = number.value();
        let computed = is_printed_double(number);
        let noise = size * COMPUTED;
        let chosen = written.significant < DIGITS_OF_CHOICE;
        let vanishing = if chosen { size * VANISHING } else { noise };
        let half = half_unit(written.decimals);
        let tolerance = if computed { half.max(noise) } else { half };
        (value != 0.0).then_some(Self {
            number,
            value,
            vanishing,
            noise,
            tolerance,
            decimals: written.decimals,
            computed,
        })
    }

    /// Whether a hit within the tolerance says something of candidates this far apart.
    fn tells(tolerance: f64, apart: f64) -> bool {
        2.0 * tolerance <= CHANCE * apart
    }

    /// Whether doubles rule out that the number is within `reach` of what is `near` up to some roundings: exact arithmetic has to
    /// be asked only where they do not.
    fn misses(&self, near: f64, reach: f64) -> bool {
        (self.value.abs() - near.abs()).abs() > reach + ROUNDINGS * self.value.abs()
    }

    fn is_zero(&self) -> bool {
        // A number of few decimals was chosen, whatever is beside it; one of more digits than a double has is not a double's
        // rounding.
        self.value.abs() <= self.vanishing
            && self.decimals >= DIGITS_OF_DOUBLES as i32
            && has_no_more_than_a_double(self.number)
    }

    /// The shortest decimal from which rounding may have made the number.
    fn decimal(&self) -> Option<Number> {
        if !self.computed {
            return None;
        }
        // Number and candidate differ by a multiple of the number's last place, or not at all: candidates with nearly as many decimals
        // are too near each other for any such difference to tell.
        let most = self.decimals.saturating_sub(PLACES_OF_CHANCE);
        let places = 0..most.saturating_add(1).min(DIGITS_OF_DOUBLES as i32);
        places.into_iter().find_map(|places| {
            let scale = 10f64.powi(places);
            let near = self.noise.min(0.5 * CHANCE / scale);
            if self.misses((self.value * scale).round() / scale, near) {
                return None;
            }
            let decimal = Number::decimal(&format!("{:.*}", places as usize, self.value)).ok()?;
            let off = distance(self.number, &decimal);
            let hit = off <= self.noise && Self::tells(off, 10f64.powi(-places));
            (hit && !decimal.is_zero()).then_some(decimal)
        })
    }

    /// The fraction of π.
    fn angle(&self) -> Option<Number> {
        [4i64, 12, 360].into_iter().find_map(|parts| {
            let apart = PI / parts as f64;
            let count = (self.value / apart).round();
            if count == 0.0
                || count.abs() > 1e6
                || !Self::tells(self.tolerance, apart)
                || self.misses(count * apart, self.tolerance)
            {
                return None;
            }
            let angle = &Number::pi() * &Number::ratio(count as i64, parts)?;
            (distance(self.number, &angle) <= self.tolerance).then_some(angle)
        })
    }

    /// The component of a unit vector as the root of a fraction.
    fn root(&self) -> Option<Number> {
        if !Self::tells(self.tolerance, 1.0 / FRACTIONS) {
            return None;
        }
        (1..=LARGEST_DENOMINATOR).find_map(|q| {
            let p = (self.value * self.value * q as f64).round();
            let outside = p < 1.0 || p > q as f64;
            if outside || self.misses((p / q as f64).sqrt(), self.tolerance) {
                return None;
            }
            let root = Number::ratio(p as i64, q)?.sqrt().ok()?;
            let root = if self.value < 0.0 { -&root } else { root };
            (distance(self.number, &root) <= self.tolerance).then_some(root)
        })
    }
}

impl Recognised {
    fn read(&mut self, number: &mut Number, constant: Option<Number>) {
        let Some(constant) = constant.filter(|constant| *constant != *number) else {
            return;
        };
        self.count += 1;
        let reading = words(&constant);
        if !self.examples.iter().any(|(_, known)| *known == reading) {
            self.examples.push((
                number.literal_text().unwrap_or_default().to_owned(),
                reading,
            ));
        }
        *number = number.read_as(&constant);
    }

    fn lengths(&mut self, vector: &mut [Number; 3], size: f64) {
        for number in vector {
            let constant = Reach::of(number, size).and_then(|reach| plain(&reach));
            self.read(number, constant);
        }
    }

    fn frame(&mut self, frame: &mut Frame, size: f64) {
        self.lengths(&mut frame.position, size);
        for angle in &mut frame.roll_pitch_yaw {
            let constant = Reach::of(angle, 1.0).and_then(|reach| match reach.is_zero() {
                true => Some(Number::zero()),
                false => reach.angle().or_else(|| reach.decimal()),
            });
            self.read(angle, constant);
        }
    }

    fn axis(&mut self, axis: &mut Direction) {
        let size = axis
            .0
            .iter()
            .fold(0.0f64, |size, x| size.max(x.value().abs()));
        if let Some(roots) = roots(&axis.0, size) {
            for (number, root) in axis.0.iter_mut().zip(roots) {
                self.read(number, root);
            }
            return;
        }
        self.lengths(&mut axis.0, size);
    }
}

/// What a number of any kind can be.
fn plain(reach: &Reach) -> Option<Number> {
    match reach.is_zero() {
        true => Some(Number::zero()),
        false => reach.decimal(),
    }
}

/// The components of a unit vector as roots of fractions, those that are literals and not such roots already; `None` where
/// some component is no such root, or their squares do not add up to 1.
fn roots(components: &[Number; 3], size: f64) -> Option<[Option<Number>; 3]> {
    let mut found = [None, None, None];
    for (number, found) in components.iter().zip(&mut found) {
        let reach = match number.is_zero() {
            true => continue,
            false => Reach::of(number, size),
        };
        if reach.as_ref().is_some_and(Reach::is_zero) {
            *found = Some(Number::zero());
            continue;
        }
        // What is too short to be taken for a root may be its own: `0.5`.
        *found = reach.and_then(|reach| reach.root());
    }
    if found.iter().flatten().all(|root| root.rational().is_some()) {
        return None;
    }
    let roots = components.iter().zip(&found);
    let sum = roots.fold(Number::zero(), |sum, (number, found)| {
        let root = found.as_ref().unwrap_or(number);
        &sum + &(root * root)
    });
    let unit = sum == Number::one();
    unit.then_some(found)
}

/// `π/2`, `-3π/4`, `√3/2`, `0`.
fn words(constant: &Number) -> String {
    let ratio = Number::pi();
    if let Ok(multiple) = constant.checked_div(&ratio)
        && let Some(multiple) = multiple.rational().filter(|x| !x.is_zero())
    {
        let text = multiple.to_string();
        let (count, parts) = match text.split_once('/') {
            Some((count, parts)) => (count.to_owned(), format!("/{parts}")),
            None => (text, String::new()),
        };
        let count = match count.as_str() {
            "1" => "",
            "-1" => "-",
            count => count,
        };
        return format!("{count}π{parts}");
    }
    if constant.rational().is_some() {
        return decimal_text(constant);
    }
    let squared = constant * constant;
    let Some(square) = squared.rational() else {
        return constant.source();
    };
    let (p, q) = (
        square.numerator().to_string(),
        square.denominator().to_string(),
    );
    let sign = if constant.value() < 0.0 { "-" } else { "" };
    match q.as_str() {
        "4" => format!("{sign}√{p}/2"),
        "9" => format!("{sign}√{p}/3"),
        _ => format!("{sign}√({p}/{q})"),
    }
}

/// A decimal as it is written, another fraction as one.
fn decimal_text(number: &Number) -> String {
    match number.literal_text() {
        Some(text) => text.to_owned(),
        None => number.source().trim_matches(['$', '{', '}']).to_owned(),
    }
}

impl Mechanism {
    /// The mechanism with the literals of its geometry read as the constants that they are within their own precision: see
    /// [the module's rules](Recognised). Their texts stay for writing back. Reading a file does this.
    #[must_use]
    pub fn with_constants(self) -> Self {
        self.with_constants_known_to(None)
    }

    /// The same of numbers that are known to so much (m, rad), where somebody says so: what exceeds it is no residue of a zero.
    #[must_use]
    pub fn with_constants_known_to(mut self, precision: Option<f64>) -> Self {
        let mut found = Recognised::default();
        if !self.literals().any(may_be_constant) {
            self.recognised = found;
            return self;
        }
        let sizes = Sizes::of(&self);
        for link in &mut self.links {
            if let Placement::Floating { origin, .. } = &mut link.placement {
                found.frame(origin, sizes.whole);
            }
        }
        for (index, joint) in self.joints.iter_mut().enumerate() {
            let size = sizes.around(&self.precisions, index);
            found.frame(&mut joint.predecessor.frame, size);
            found.frame(&mut joint.successor.frame, size);
        }
        for joint in &mut self.joints {
            found.axis(&mut joint.axis);
            found.axis(&mut joint.axis2);
        }
        found.residues = self.read_residues(precision.unwrap_or(f64::INFINITY));
        let is_changed = found.count > 0 || !found.residues.is_empty();
        self.recognised = found;
        match is_changed {
            true => self.read_digits(),
            // The digits of the same numbers say the same.
            false => self,
        }
    }

    /// All numbers of the geometry.
    fn literals(&self) -> impl Iterator<Item = &Number> {
        let placed = self.links.iter().filter_map(|link| match &link.placement {
            Placement::Floating { origin, .. } => Some(origin),
            _ => None,
        });
        let sides = self.joints.iter();
        let sides = sides.flat_map(|joint| [&joint.predecessor.frame, &joint.successor.frame]);
        let frames = placed.chain(sides);
        let of_frames = frames.flat_map(|frame| frame.position.iter().chain(&frame.roll_pitch_yaw));
        let others = self.joints.iter().flat_map(|joint| {
            let axes = joint.axis.0.iter().chain(&joint.axis2.0);
            axes.chain(&joint.lead).chain(&joint.distance)
        });
        of_frames.chain(others)
    }

    /// Reads as 0 what rounding left of zeros, by independent sub-mechanism.
    fn read_residues(&mut self, precision: f64) -> Vec<Residue> {
        let mut blocks: Vec<Vec<usize>> = Vec::new();
        for joint in 0..self.joints.len() {
            if let Some(block) = self.precisions.block(joint) {
                if blocks.len() <= block {
                    blocks.resize(block + 1, Vec::new());
                }
                blocks[block].push(joint);
            }
        }
        let found = blocks.iter().flat_map(|joints| residues(self, joints));
        let mut found: Vec<(usize, usize)> = found.collect();
        found.sort_unstable();
        let mut read = Vec::with_capacity(found.len());
        for (joint, place) in found {
            let number = self.joints[joint].number_mut(place);
            if let Some(number) = number.filter(|number| number.value().abs() <= precision) {
                let text = number.literal_text().unwrap_or_default().to_owned();
                *number = number.read_as(&Number::zero());
                read.push(Residue { text, joint, place });
            }
        }
        read
    }

    /// The mechanism with every literal of its geometry known to within `uncertainty` (m, rad), whatever its digits say.
    #[must_use]
    pub fn with_precision(mut self, uncertainty: f64) -> Self {
        self.precisions = self.precisions.known_to(uncertainty);
        self
    }

    /// The literals that were read as constants.
    #[must_use]
    pub fn recognised(&self) -> &Recognised {
        &self.recognised
    }
}

/// How large the coordinates are that others are held against (m).
struct Sizes {
    /// Of all frames.
    whole: f64,
    /// Of the joint frames of every independent sub-mechanism.
    blocks: Vec<f64>,
}

impl Sizes {
    fn of(mechanism: &Mechanism) -> Self {
        let farthest = |frame: &Frame| {
            let coordinates = frame.position.iter().map(|x| x.value().abs());
            coordinates.fold(0.0, f64::max).min(LONGEST)
        };
        let mut sizes = Self {
            whole: 0.0,
            blocks: Vec::new(),
        };
        for link in &mechanism.links {
            if let Placement::Floating { origin, .. } = &link.placement {
                sizes.whole = sizes.whole.max(farthest(origin));
            }
        }
        for (index, joint) in mechanism.joints.iter().enumerate() {
            let size = farthest(&joint.predecessor.frame).max(farthest(&joint.successor.frame));
            sizes.whole = sizes.whole.max(size);
            if let Some(block) = mechanism.precisions.block(index) {
                if sizes.blocks.len() <= block {
                    sizes.blocks.resize(block + 1, 0.0);
                }
                sizes.blocks[block] = sizes.blocks[block].max(size);
            }
        }
        sizes
    }

    /// Of the numbers around those of a joint: its sub-mechanism's, or all where it is in no loop.
    fn around(&self, precisions: &Precisions, joint: usize) -> f64 {
        let block = precisions.block(joint);
        block.map_or(self.whole, |block| self.blocks[block])
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::super::{JointBuilder, JointKind, MechanismBuilder};
    use super::*;

    /// What a literal is read as at a place of a joint, among lengths of a metre.
    fn read(place: impl Fn(Number, &mut JointBuilder), text: &str) -> (Number, Recognised) {
        let mut joint = JointBuilder::tree("j", JointKind::Revolute, "a", "b").axis(Direction([
            Number::zero(),
            Number::zero(),
            Number::one(),
        ]));
        place(Number::decimal(text).unwrap(), &mut joint);
        let mut builder = MechanismBuilder::new("m");
        builder.link("a").link("b").joint(joint);
        builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
        let mechanism = builder.build().unwrap().with_constants();
        let frame = &mechanism.joints()[0].predecessor.frame;
        let found = if frame.position[0].literal_text() == Some(text) {
            frame.position[0].clone()
        } else {
            frame.roll_pitch_yaw[0].clone()
        };
        assert_eq!(found.source(), text, "written back as it was");
        (found, mechanism.recognised().clone())
    }

    fn as_length(text: &str) -> (Number, Recognised) {
        read(
            |x, joint| {
                *joint = joint
                    .clone()
                    .origin(Frame::at([x, Number::one(), Number::zero()]));
            },
            text,
        )
    }

    fn as_angle(text: &str) -> (Number, Recognised) {
        read(
            |x, joint| {
                *joint = joint.clone().origin(Frame {
                    position: [Number::zero(), Number::one(), Number::zero()],
                    roll_pitch_yaw: [x, Number::zero(), Number::zero()],
                });
            },
            text,
        )
    }

    #[test]
    fn angles_are_fractions_of_pi_within_their_digits() {
        for (text, reading) in [
            ("1.5707963267948966", "π/2"),
            ("1.570796326794896558", "π/2"),
            ("-1.570796326794896336", "-π/2"),
            ("1.5707963", "π/2"),
            ("1.5708", "π/2"),
            ("0.7853981633974483", "π/4"),
            ("-3.14159265358979", "-π"),
            ("2.0943951", "2π/3"),
            ("-2.35619", "-3π/4"),
            ("0.017453292519943295", "π/180"),
            ("4.71238898038469", "3π/2"),
            ("6.123e-17", "0"),
            ("3e-31", "0"),
            ("-1.2246467991473532e-16", "0"),
            ("2.8421709430404007435e-14", "0"),
            ("0.29999999999999999", "0.3"),
        ] {
            let (number, found) = as_angle(text);
            assert_eq!(found.count, 1, "{text}");
            assert_eq!(found.examples, [(text.to_owned(), reading.to_owned())]);
            assert_eq!(number.stated().is_some(), reading == "0.3");
            assert!((number.value() - text.parse::<f64>().unwrap()).abs() < 1e-4);
        }
    }

    #[test]
    fn other_angles_stay_as_they_are() {
        for text in [
            // Not equal within their digits.
            "1.5707",
            "1.57079",
            "1.5707963367948966",
            "1.57079632679490",
            "1.570796326805",
            // Too few digits to tell.
            "1.571",
            "0.52",
            "1.57",
            "0.7854e-1",
            "0.2618",
            // Chosen.
            "1e-13",
            "0.25",
            "1e-14",
        ] {
            if text == "1.57079632679490" {
                // This one is: its last digits are 490 for 48966.
                assert_eq!(as_angle(text).1.count, 1);
                continue;
            }
            let (number, found) = as_angle(text);
            assert_eq!(found, Recognised::default(), "{text}");
            assert!(number.stated().is_some());
        }
    }

    #[test]
    fn lengths_are_zero_or_short_decimals_but_no_fractions_of_pi() {
        for (text, reading) in [
            ("0.30000000000000004", "0.3"),
            ("-0.013999999999999887534", "-0.014"),
            ("0.32599840000000002149", "0.3259984"),
            ("-2.7755575615628913511e-17", "0"),
            ("5e-17", "0"),
        ] {
            let (number, found) = as_length(text);
            assert_eq!(found.examples, [(text.to_owned(), reading.to_owned())]);
            assert_eq!(number, Number::decimal(reading).unwrap());
        }
        for text in [
            // More digits than a double has were meant.
            "0.300000000000000000000000000001",
            "1.5707963267948966",
            "0.056000005",
            "0.10706579297345659996",
            "1e-12",
            "0.7071067811865476",
            "0.300000000001",
            "0.30000000001234567",
        ] {
            assert_eq!(as_length(text).1.count, 0, "{text}");
        }
    }

    #[test]
    fn small_lengths_among_small_lengths_are_meant() {
        let mut builder = MechanismBuilder::new("molecule");
        let at = [
            Number::decimal("1.5e-16").unwrap(),
            Number::decimal("3e-16").unwrap(),
            Number::zero(),
        ];
        builder.link("a").link("b");
        builder.joint(JointBuilder::tree("j", JointKind::Fixed, "a", "b").origin(Frame::at(at)));
        let mechanism = builder.build().unwrap().with_constants();
        assert_eq!(mechanism.recognised().count, 0);
    }

    fn axis_of(texts: [&str; 3]) -> Mechanism {
        let axis = Direction(texts.map(|text| Number::decimal(text).unwrap()));
        let mut builder = MechanismBuilder::new("axis");
        builder.link("a").link("b");
        builder.joint(JointBuilder::tree("j", JointKind::Revolute, "a", "b").axis(axis));
        builder.joint(JointBuilder::closing("k", JointKind::Fixed, "a", "b"));
        builder.build().unwrap().with_constants()
    }

    #[test]
    fn unit_axes_are_roots_whose_squares_add_up() {
        for (texts, count, readings) in [
            (
                ["0.70710678118654757", "0", "-0.70710678118654746"],
                2,
                vec!["√(1/2)", "-√(1/2)"],
            ),
            (["0.866025", "0.5", "6e-17"], 2, vec!["√3/2", "0"]),
            (
                [
                    "0.57735026918962584",
                    "0.57735026918962573",
                    "0.57735026918962573",
                ],
                3,
                vec!["√(1/3)"],
            ),
            (["1.2246467991473532e-16", "0", "-1"], 1, vec!["0"]),
            (["0.99999999999999989", "0", "0"], 1, vec!["1"]),
        ] {
            let mechanism = axis_of(texts);
            let found = mechanism.recognised();
            assert_eq!(found.count, count, "{texts:?}");
            let words: Vec<&str> = found
                .examples
                .iter()
                .map(|(_, words)| words.as_str())
                .collect();
            assert_eq!(words, readings, "{texts:?}");
        }
        for texts in [
            ["0.7071", "0", "0.7071"],
            ["0.866025", "0.6", "0"],
            ["0.866027", "0.5", "0"],
            ["0.70710678", "0.70710678", "0.1"],
            ["0.6", "0.8", "0"],
        ] {
            assert_eq!(axis_of(texts).recognised().count, 0, "{texts:?}");
        }
    }

    #[test]
    fn constants_state_no_precision() {
        let mechanism = axis_of(["0.70710678118654757", "0", "-0.70710678118654746"]);
        assert!(mechanism.precision().is_exact());
        assert_eq!(mechanism.precision().decimals, Some(0));
        let x = &mechanism.joints()[0].axis.0[0];
        assert_eq!(mechanism.precision().uncertainty(12, x), 0.0);
    }

    #[test]
    fn what_is_rounded_to_a_short_decimal_states_what_that_states() {
        let mechanism = axis_of(["0.86602000000000006", "0.5", "0"]);
        assert_eq!(mechanism.precision().decimals, Some(5));
        assert!(!mechanism.precision().is_of_doubles());
        let mechanism = axis_of(["0.86602123456789012", "0.51234567890123456", "0"]);
        assert!(mechanism.precision().is_of_doubles());
        let by_hand = mechanism.with_precision(1e-6);
        let x = &by_hand.joints()[0].axis.0[0];
        assert_eq!(by_hand.precision().uncertainty(12, x), 1e-6);
        assert!(!by_hand.precision().is_of_doubles() && !by_hand.precision().is_exact());
        assert!(by_hand.with_precision(0.0).precision().is_exact());
    }
}
