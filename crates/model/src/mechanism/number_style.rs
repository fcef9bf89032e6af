//! How a program, or a person, wrote the numbers of one kind in one independent sub-mechanism, and how far each of them may
//! therefore be from the number meant.
//!
//! Lengths, angles and components of directions are printed by different lines of a program, with digits of their own; each kind
//! is a group. In a group, with `d` decimals and `s` significant digits of a literal `x`, `10ᵉ⁻¹ ≤ |x| < 10ᵉ`, `D` the most decimals
//! and `S` the most significant digits of any:
//!
//! | style | known by | `u(x)` |
//! |---|---|---|
//! | chosen | no literal has more than [`EXACT_DECIMALS`] decimals (lengths beside chosen directions, or in a [small unit](Group::is_of_a_small_unit): in the decade of the longest, if below 1 m) | 0 |
//! | fixed decimals | literals fall short of `D` by fewer zeros than of `S` | `½ 10⁻ᴰ` |
//! | significant digits | of `S` by fewer than of `D`, and `S ≥ 3` | `½ 10ᵉ⁻ˢ` |
//! | either | neither is a thousand times likelier | the larger |
//! | single precision | every literal is the print of a single-precision number, which is no chance | `2⁻²⁴ (|x| + max |x|)` |
//! | another unit | every literal is a multiple of `10⁻ᵏ` degrees or inches, k > [`EXACT_DECIMALS`], which is no chance ([`OtherUnit`]) | `½ (10⁻ᵏ unit + 10⁻ᵈ)` |
//!
//! and, but for another unit, never more than `½ 10⁻ᵈ`. A zero at the end that a program leaves out is there by chance, once in ten numbers. So the style of
//! which the literals fall short by fewer zeros in all is the likelier one, ten times for every zero. Where most literals are shorter
//! than chance explains ([`Group::lost`]), beside a few long ones, two hands printed them, and the shorter ones are as uncertain as
//! their own digits say: `½ 10⁻ᵈ`. The numbers of loops that close are often written later, by another program than the tree's: where those
//! of one side have fewer digits than chance leaves of the other side's ([`Literals::by_another_hand_than`]), each side is a group. A few short ones among many long ones, such as 1.15625, are numbers that somebody chose and the
//! program had exactly. Numbers of up to [`NATURAL`] significant digits are such in whatever company, and count for none of this.

use super::constants::{has_no_more_than_a_double, is_printed_double};
use super::other_unit::{OtherUnit, Printed};
use super::precision::LiteralPlace;
use kutzbach_math::number::{Number, Stated};

/// Up to so many decimals in a whole group, literals are exact.
pub(super) const EXACT_DECIMALS: i32 = 2;

/// Numbers of up to so many significant digits may be somebody's choice among numbers that a program computed.
const NATURAL: u32 = 4;

/// The fewest significant digits that people make a program print.
const FEWEST_SIGNIFICANT: u32 = 3;

/// Of so many decimals are no lengths, angles or directions that somebody chose among others that a program computed.
const NOBODYS_DECIMALS: i32 = 4;

/// So improbable has it to be that one hand printed what counts as printed by two.
const BY_CHANCE: f64 = 1e-4;

/// One style has to be likelier than the other by so many powers of ten to be the only one.
const LIKELIER: i64 = 3;

/// So improbable are zeros at the end that are not believed to have been left out.
const IMPROBABLE: f64 = 1e-3;

/// Short numbers are somebody's choice, as they mostly are, where so few of them are as long as that by chance.
const UNLIKELY: f64 = 0.05;

/// Significant digits that tell doubles apart.
const OF_A_DOUBLE: u32 = 17;

/// Of so many significant digits a program printed all that it had.
const IN_FULL: u32 = 15;

/// Significant digits below which literals near enough to a single-precision number are no evidence.
const EVIDENT: u32 = 8;

/// Probability that is allowed of taking decimals for single-precision numbers by chance.
const CHANCE: f64 = 1e-4;

/// Single-precision numbers end in so many zero bits by chance once in 256 times.
const SHORT_FRACTION: u32 = 8;

/// Half a unit of the last place of a single-precision number, relative to the number, at most.
const HALF_SINGLE: f64 = 1.0 / (1u64 << 24) as f64;

/// What a group states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Group {
    /// Most decimals of any literal but zeros, for which 0 counts; `None` where there is no literal.
    pub decimals: Option<i32>,
    /// Most significant digits.
    pub significant: u32,
    /// Most decimals, counted in the decade of the longest literal where that is [asked for](Self::count_from_first_digit).
    pub designed: i32,
    /// Power of ten of the first digit of the largest literal: −1 for `0.125`.
    decade: i32,
    /// Where the first literal is that has so many.
    pub finest: Option<LiteralPlace>,
    /// Whether all literals are padded with zeros that say nothing.
    padded: bool,
    /// Whether the longest literals are printed doubles.
    pub doubles: bool,
    style: Style,
    /// So many zeros at the end may a shorter literal have lost.
    lost: i32,
    /// Half or more of the literals that nobody chose have the digits of a double, or more.
    mostly_full: bool,
    /// Whether so few literals are shorter than the longest that all may be rounded to its decimals.
    alike: bool,
    /// Whether so few literals are shorter, in decimals and in digits, that one program printed them all to either.
    equally_long: bool,
}

/// How the numbers of one kind were written, as far as their digits tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Written {
    /// In few digits, which are exact.
    Chosen,
    /// Rounded to so many decimals.
    Decimals(i32),
    /// Rounded to so many significant digits.
    Significant(u32),
    /// Rounded, to so many decimals or significant digits at most; the literals do not tell which.
    Either(i32, u32),
    /// All digits of single precision.
    SinglePrecision,
    /// All digits of doubles.
    DoublePrecision,
    /// Rounded to so many decimals of a unit, and converted.
    Converted(OtherUnit, i32),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Style {
    Decimals,
    Significant,
    Either,
    /// With the largest size of any.
    Single(f64),
    /// To so many decimals of another unit.
    Converted(OtherUnit, i32),
}

impl Default for Group {
    fn default() -> Self {
        Self {
            decimals: None,
            significant: 0,
            designed: 0,
            decade: 0,
            finest: None,
            padded: false,
            doubles: false,
            style: Style::Either,
            lost: i32::MAX,
            mostly_full: true,
            alike: true,
            equally_long: false,
        }
    }
}

impl Group {
    /// Whether all numbers of the group are exact.
    pub fn is_exact(&self) -> bool {
        self.designed <= EXACT_DECIMALS
    }

    /// Whether its digits are those of printed doubles, and not mostly shorter ones of another hand.
    pub fn is_of_doubles(&self) -> bool {
        self.doubles && self.lost == i32::MAX
    }

    /// Whether it has all the digits of doubles, and not mostly shorter ones of another hand.
    pub fn is_in_full(&self) -> bool {
        let converted = matches!(self.style, Style::Converted(..));
        self.significant >= OF_A_DOUBLE && self.mostly_full && !converted
    }

    /// Whether literals that count as exact may all be rounded to the decimals of the longest: no more of them are shorter than zeros
    /// at the end make by chance.
    pub fn may_be_rounded(&self) -> bool {
        self.alike
    }

    /// How its numbers are written; `None` where there are none.
    pub fn written(&self) -> Option<Written> {
        let decimals = self.decimals?;
        Some(match self.style {
            _ if self.is_exact() => Written::Chosen,
            Style::Single(_) => Written::SinglePrecision,
            Style::Converted(unit, decimals) => Written::Converted(unit, decimals),
            _ if self.doubles || self.significant >= OF_A_DOUBLE => Written::DoublePrecision,
            Style::Decimals => Written::Decimals(decimals),
            Style::Significant => Written::Significant(self.significant),
            Style::Either => Written::Either(decimals, self.significant),
        })
    }

    /// Counts decimals from the first digit of the largest literal, if that is below 1: `0.125` says of metres what `1.25` says
    /// of decimetres.
    pub fn count_from_first_digit(&mut self) {
        self.designed = self.designed.saturating_add(self.decade.min(0));
    }

    /// Counts decimals from the first digit of the largest literal, if they all have as many digits, four or more, as rounded numbers of
    /// `another` kind, but for zeros at the end that are there by chance: `102.5` and `45.73` beside the angle `0.3142`.
    pub fn count_all_digits_beside(&mut self, another: &Self) {
        let alike = !another.is_exact() && self.significant == another.significant;
        if alike && self.significant >= NATURAL && self.equally_long {
            self.designed = self.designed.saturating_add(self.decade.max(0));
        }
    }

    /// Counts numbers of one digit each as chosen: no program rounds so coarsely.
    pub fn choose_single_digits(&mut self) {
        if self.significant <= 1 {
            self.designed = 0;
        }
    }

    /// Whether the zeros before the first digits are those of a unit, such as millimetres in metres: lengths of less than 10⁻⁴ m, and
    /// of less than a centimetre stated to two digits, or all to one digit. No program rounds so coarsely.
    pub fn is_of_a_small_unit(&self) -> bool {
        let decade = self.decade.min(0);
        let digits = self.designed.saturating_add(decade).saturating_add(1);
        self.decade < -4 || self.decade < -2 && digits <= 2 || self.significant <= 1
    }

    /// How far a number of the group may be from the number meant; zero for exact ones.
    pub fn uncertainty(&self, number: &Number) -> f64 {
        let (Some(stated), Some(most), false) = (number.stated(), self.decimals, self.is_exact())
        else {
            return 0.0;
        };
        let stated = self.stated(number, stated);
        let own = power_of_ten(-i64::from(stated.decimals));
        if let Style::Single(size) = self.style {
            // A coordinate that was computed in single precision has the rounding of the terms of its sum, and its own.
            let own = if stated.significant < EVIDENT {
                0.0
            } else {
                0.5 * own
            };
            return own.max(HALF_SINGLE * (number.value().abs() + size));
        }
        // With s digits of which the last is worth 10⁻ᵈ, the first is worth 10ˢ⁻ᵈ⁻¹: so e = s − d, without a logarithm.
        let written = i64::from(stated.significant);
        let by_digits = match written > 0 {
            true => {
                power_of_ten(written - i64::from(stated.decimals) - i64::from(self.significant))
            }
            false => 0.0,
        };
        let by_decimals = power_of_ten(-i64::from(most));
        if let Style::Converted(unit, decimals) = self.style {
            return 0.5 * (unit.step(decimals) + own.min(by_decimals));
        }
        let with_lost = match self.style {
            _ if written == 0 => by_decimals,
            Style::Decimals => by_decimals,
            Style::Significant => by_digits,
            Style::Either | Style::Single(_) | Style::Converted(..) => by_decimals.max(by_digits),
        };
        // A designer's number among computed ones: short, or of no more decimals than chosen numbers have.
        let bare = bare(number, stated);
        let natural = bare.significant <= NATURAL || bare.decimals <= EXACT_DECIMALS;
        let lost = self.style.short_by(stated, most, self.significant);
        let by_other_hand = written > 0 && !natural && lost > i64::from(self.lost);
        0.5 * match by_other_hand {
            true => own,
            false => own.min(with_lost),
        }
    }

    /// The digits of a literal that count.
    fn stated(&self, number: &Number, stated: Stated) -> Stated {
        let stated = match self.padded {
            true => bare(number, stated),
            false => stated,
        };
        match self.doubles {
            true => of_a_double(stated),
            false => stated,
        }
    }

    /// Of two groups what the finer one is, with the most digits of both.
    pub fn with(&self, other: &Self) -> Self {
        let finer = match other.designed > self.designed {
            true => other,
            false => self,
        };
        Self {
            decimals: self.decimals.max(other.decimals),
            significant: self.significant.max(other.significant),
            doubles: self.doubles || other.doubles,
            ..*finer
        }
    }
}

impl Style {
    /// How many zeros at its end a literal has left out if all were printed in this style.
    fn short_by(self, stated: Stated, decimals: i32, significant: u32) -> i64 {
        let of_decimals = i64::from(decimals) - i64::from(stated.decimals);
        let of_digits = i64::from(significant) - i64::from(stated.significant);
        match self {
            Self::Decimals => of_decimals,
            Self::Significant => of_digits,
            Self::Either | Self::Single(_) | Self::Converted(..) => of_decimals.min(of_digits),
        }
    }
}

/// The literals of a group, in the order of the file.
#[derive(Default)]
pub(super) struct Literals<'a> {
    all: Vec<(LiteralPlace, &'a Number, Stated)>,
    /// In which other unit numbers of this kind may have been rounded.
    unit: Option<OtherUnit>,
}

impl<'a> Literals<'a> {
    /// None yet, of a kind that may have been rounded in another unit.
    pub fn of(unit: Option<OtherUnit>) -> Self {
        Self {
            all: Vec::new(),
            unit,
        }
    }

    pub fn read(&mut self, place: LiteralPlace, number: &'a Number) {
        if let Some(stated) = number.stated() {
            self.all.push((place, number, stated));
        }
    }

    /// These and others together.
    pub fn and(&self, others: &Self) -> Self {
        Self {
            all: self.all.iter().chain(&others.all).copied().collect(),
            unit: self.unit,
        }
    }

    /// Whether another program, or hand, than that of some finer ones printed these, which are the group `own`: of these, those that
    /// have more digits or decimals than somebody's choice would all have lost the zeros of the finer ones by chance, and their own zeros
    /// they have lost by chance only.
    pub fn by_another_hand_than(&self, own: &Group, finer: &Group) -> bool {
        let (Some(most), Some(of_finer)) = (own.decimals, finer.decimals) else {
            return false;
        };
        let zeros = i64::from(of_finer) - i64::from(most);
        let fewer_digits = finer.significant > own.significant;
        let computed = self.all.iter().filter(|(_, number, stated)| {
            let bare = bare(number, *stated);
            let fine = bare.decimals >= NOBODYS_DECIMALS && bare.significant >= FEWEST_SIGNIFICANT;
            fine || bare.significant > NATURAL
        });
        let chance = || power_of_ten(-zeros.max(0)).powf(computed.count() as f64);
        let chosen = own.is_exact() || own.is_of_a_small_unit() || most <= EXACT_DECIMALS;
        let rounded = !chosen && !finer.is_exact();
        rounded && own.alike && zeros > 0 && fewer_digits && chance() <= BY_CHANCE
    }

    /// Those that are not zero and have a decimal point.
    pub fn pointed(&self) -> usize {
        let pointed = |number: &Number| number.literal_text().is_some_and(|t| t.contains('.'));
        let counts =
            |(_, number, stated): &&(_, &Number, Stated)| stated.significant > 0 && pointed(number);
        self.all.iter().filter(counts).count()
    }

    /// Most significant digits: as written, and without zeros at the end.
    pub fn significant(&self) -> (u32, u32) {
        self.all
            .iter()
            .fold((0, 0), |(most, most_bare), (_, number, stated)| {
                let bare = bare(number, *stated).significant;
                (most.max(stated.significant), most_bare.max(bare))
            })
    }

    /// What they state, if their zeros at the end are `padded`.
    pub fn group(&self, padded: bool) -> Group {
        let mut group = Group {
            padded,
            ..Group::default()
        };
        if self.all.is_empty() {
            return Group::default();
        }
        let single = self.single();
        let converted = self.unit.filter(|_| single.is_none());
        let converted = converted.and_then(|unit| Some((unit, self.rounded_in(unit)?)));
        let longer = self
            .taken_as_written()
            .any(|n| !has_no_more_than_a_double(n));
        group.doubles = single.is_none()
            && converted.is_none()
            && !longer
            && self.taken_as_written().any(is_printed_double);
        let mut first_digit: Option<i64> = None;
        for (place, number, stated) in &self.all {
            let stated = group.stated(number, *stated);
            // However a zero is written, it says nothing of how other numbers were rounded.
            let decimals = match stated.significant {
                0 => stated.decimals.min(0),
                _ => stated.decimals,
            };
            if group.decimals.is_none_or(|most| decimals > most) {
                (group.decimals, group.finest) = (Some(decimals), Some(*place));
            }
            group.significant = group.significant.max(stated.significant);
            if stated.significant > 0 {
                let place = i64::from(stated.significant) - i64::from(stated.decimals) - 1;
                first_digit = first_digit.max(Some(place));
            }
        }
        let decade = first_digit
            .unwrap_or(0)
            .clamp(i64::from(i32::MIN), i64::from(i32::MAX));
        group.decade = i32::try_from(decade).unwrap_or(0);
        group.designed = group.decimals.unwrap_or(0);
        group.style = match (single, converted) {
            (Some(size), _) => Style::Single(size),
            (None, Some((unit, decimals))) => Style::Converted(unit, decimals),
            (None, None) => self.style(&group),
        };
        let computed: Vec<Stated> = self.computed(&group).collect();
        let in_full = computed.iter().filter(|s| s.significant >= IN_FULL).count();
        // A program prints one double in a hundred shorter: where more are short, two hands printed them, or somebody chose some. What most
        // numbers are says which hand's the kind is; of equally many, the finer one's, whose digits bound what the others may have lost.
        group.mostly_full = 2 * in_full >= computed.len();
        group.lost = Self::lost(&group, &computed);
        (group.alike, group.equally_long) = self.are_alike(&group);
        group
    }

    /// Those whose digits are those of their text.
    fn taken_as_written(&self) -> impl Iterator<Item = &'a Number> {
        let plain = self
            .all
            .iter()
            .filter(|(_, n, stated)| n.written() == Some(*stated));
        plain.map(|(_, number, _)| *number)
    }

    /// To how many decimals of another unit they were rounded, if these are more than somebody chooses.
    fn rounded_in(&self, unit: OtherUnit) -> Option<i32> {
        let printed = self.all.iter().map(|(_, number, stated)| {
            let stated = of_a_double(*stated);
            (number.value(), power_of_ten(-i64::from(stated.decimals)))
        });
        let printed: Vec<Printed> = printed.collect();
        let decimals = unit.rounded_to(&printed, BY_CHANCE);
        decimals.filter(|decimals| *decimals > EXACT_DECIMALS)
    }

    /// The digits of those that are neither zero nor somebody's choice.
    fn computed(&self, group: &Group) -> impl Iterator<Item = Stated> {
        self.all.iter().filter_map(|(_, number, stated)| {
            let stated = group.stated(number, *stated);
            (bare(number, stated).significant > NATURAL).then_some(stated)
        })
    }

    fn style(&self, group: &Group) -> Style {
        let most = group.decimals.unwrap_or(0);
        let short_by = |style: Style| {
            let short = self.computed(group);
            short
                .map(|s| style.short_by(s, most, group.significant))
                .fold(0, i64::saturating_add)
        };
        let (decimals, significant) = (short_by(Style::Decimals), short_by(Style::Significant));
        if group.significant < FEWEST_SIGNIFICANT
            || significant.saturating_sub(decimals) >= LIKELIER
        {
            Style::Decimals
        } else if decimals.saturating_sub(significant) >= LIKELIER {
            Style::Significant
        } else {
            Style::Either
        }
    }

    /// How many zeros at the end shorter literals may have lost: for each number of zeros, so many literals as lack them have to be
    /// there by chance, if one in ten lacks one, one in a hundred two.
    fn lost(group: &Group, computed: &[Stated]) -> i32 {
        if group.doubles && group.mostly_full {
            // Of a program that prints doubles as short as it can, a short one is what it is.
            return i32::MAX;
        }
        let most = group.decimals.unwrap_or(0);
        let short: Vec<i64> = computed
            .iter()
            .map(|s| group.style.short_by(*s, most, group.significant))
            .collect();
        let plausible = |zeros: i32| {
            let lacking = short.iter().filter(|s| **s >= i64::from(zeros)).count();
            let expected = computed.len() as f64 * power_of_ten(-i64::from(zeros));
            lacking == 0 || at_least(lacking, expected) >= IMPROBABLE
        };
        let by_others = |zeros: &i32| {
            let shorter = short.iter().filter(|s| **s >= i64::from(*zeros)).count();
            2 * shorter > short.len() && !plausible(*zeros)
        };
        (1..=30).find(by_others).map_or(i32::MAX, |zeros| zeros - 1)
    }

    /// Whether literals shorter than the longest are as few as chance makes them, once in ten: in decimals, and in decimals and digits.
    fn are_alike(&self, group: &Group) -> (bool, bool) {
        let most = group.decimals.unwrap_or(0);
        let written = self
            .all
            .iter()
            .map(|(_, n, stated)| group.stated(n, *stated));
        let (mut count, mut shorter, mut in_both) = (0, 0, 0);
        for stated in written.filter(|stated| stated.significant > 0) {
            let short = |style: Style| style.short_by(stated, most, group.significant) > 0;
            count += 1;
            shorter += usize::from(short(Style::Decimals));
            in_both += usize::from(short(Style::Either));
        }
        let by_chance =
            |shorter| shorter == 0 || at_least(shorter, 0.1 * f64::from(count)) >= UNLIKELY;
        (by_chance(shorter), by_chance(in_both))
    }

    /// The largest size of any literal, if they are single-precision numbers as they are printed.
    ///
    /// A literal whose last digit is worth `w`, among single-precision numbers that lie `s > w` apart, is near enough to one of
    /// them by chance in `w` of `s` cases.
    fn single(&self) -> Option<f64> {
        let (mut by_chance, mut size) = (1.0, 0.0f64);
        for (_, number, stated) in &self.all {
            let value = number.value();
            let stated = of_a_double(*stated);
            if value == 0.0 || stated.significant < EVIDENT {
                size = size.max(value.abs());
                continue;
            }
            // What was read as a constant of doubles is none of these.
            if number.written() != number.stated() || !is_print_of_single(number) {
                return None;
            }
            size = size.max(value.abs());
            let short = bare(number, stated).significant < EVIDENT;
            // Short binary fractions, such as 63/512, are numbers of any precision.
            if short || (value as f32).to_bits().trailing_zeros() >= SHORT_FRACTION {
                continue;
            }
            let last = power_of_ten(-i64::from(stated.decimals));
            let apart = 2.0 * HALF_SINGLE * power_of_two_below(value.abs());
            by_chance *= (last / apart).min(1.0);
        }
        (by_chance <= CHANCE).then_some(size)
    }
}

/// Whether a literal of eight digits or more is the print of a single-precision number.
pub(super) fn is_print_of_single(number: &Number) -> bool {
    let Some(stated) = number.written().map(of_a_double) else {
        return false;
    };
    let (value, last) = (number.value(), power_of_ten(-i64::from(stated.decimals)));
    let single = value as f32;
    let off = (value - f64::from(single)).abs();
    stated.significant >= EVIDENT && single.is_normal() && off <= 0.5001 * last
}

/// The largest power of two that is not above a positive number.
fn power_of_two_below(x: f64) -> f64 {
    let mut power = 2f64.powi(x.log2().floor().clamp(-1000.0, 1000.0) as i32);
    if power > x {
        power *= 0.5;
    }
    power
}

/// The probability of at least so many of rare independent events, of which so many are expected (Poisson).
fn at_least(count: usize, expected: f64) -> f64 {
    let (mut term, mut fewer) = ((-expected).exp(), 0.0);
    for i in 0..count {
        fewer += term;
        term *= expected / (i + 1) as f64;
    }
    // Where the sum of the fewer loses all digits, the first term of the others is enough.
    (1.0 - fewer).max(term)
}

/// The digits of a literal without the zeros at the end of its decimals.
fn bare(number: &Number, stated: Stated) -> Stated {
    // What was read as a shorter decimal has no such zeros.
    let text = number
        .literal_text()
        .filter(|_| number.written() == Some(stated));
    // Every number of every variant of a sweep comes by here.
    let mantissa = text.and_then(|text| {
        let exponent = text.bytes().position(|byte| matches!(byte, b'e' | b'E'));
        text.get(..exponent.unwrap_or(text.len()))
    });
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
pub(super) fn power_of_ten(exponent: i64) -> f64 {
    const BEYOND: i64 = 400;
    10f64.powi(exponent.clamp(-BEYOND, BEYOND) as i32)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// How far each of some literals of one kind may be from the number meant.
    fn uncertainties(texts: &[&str]) -> Vec<f64> {
        let numbers: Vec<Number> = texts.iter().map(|t| Number::decimal(t).unwrap()).collect();
        let mut literals = Literals::default();
        for (joint, number) in numbers.iter().enumerate() {
            literals.read(LiteralPlace::Joint(joint, 0), number);
        }
        let group = literals.group(false);
        numbers
            .iter()
            .map(|number| group.uncertainty(number))
            .collect()
    }

    #[track_caller]
    fn assert_uncertainties(texts: &[&str], expected: &[f64]) {
        let found = uncertainties(texts);
        let off = found
            .iter()
            .zip(expected)
            .any(|(f, e)| (f - e).abs() > 1e-3 * e);
        assert!(
            !off && found.len() == expected.len(),
            "{texts:?}: {found:?}"
        );
    }

    #[test]
    fn decimals_and_significant_digits_are_told_apart() {
        // `%.6f`: 123.456789 has nine digits, 0.012346 five. A whole number is known as well.
        let fixed = ["123.456789", "0.012346", "4", "57.120034"];
        assert_uncertainties(&fixed, &[0.5e-6; 4]);
        // `%.6g`.
        let general = ["123.457", "0.0123457", "4.01235", "57.1200"];
        assert_uncertainties(&general, &[0.5e-3, 0.5e-7, 0.5e-5, 0.5e-4]);
        // One digit of a small number is no style: whole numbers are not known to half of themselves.
        assert_uncertainties(&["0.001", "4", "2"], &[0.5e-3; 3]);
    }

    #[test]
    fn zeros_are_lost_by_chance_only() {
        // Written to six decimals and as short as possible.
        let lost = [
            "0.433013", "-0.25", "0.18301", "0.612372", "0.5", "0.776457",
        ];
        assert_uncertainties(&lost, &[0.5e-6; 6]);
        // Many of six decimals beside one in full, which makes them no finer.
        let mixed = [
            "0.8660254037844386",
            "0.433013",
            "-0.183013",
            "0.612372",
            "0.776457",
            "0.25",
        ];
        let [full, six] = [0.5e-16, 0.5e-6];
        assert_uncertainties(&mixed, &[full, six, six, six, six, full]);
        // One that somebody chose among those that a program computed from it.
        let chosen = ["1.15625", "0.433012702", "-0.183012702", "0.612372436"];
        assert_uncertainties(&chosen, &[0.5e-8, 0.5e-9, 0.5e-9, 0.5e-9]);
    }

    #[test]
    fn single_precision_is_known_by_its_numbers() {
        let half = 1.0 / f64::from(1 << 24);
        // Printed as doubles, and to nine digits.
        let singles = [0.1f32, 0.433_012_7, -1.7, 0.710_3, 0.003_217_3];
        for print in [
            |x: f32| f64::from(x).to_string(),
            |x: f32| format!("{x:.8e}"),
        ] {
            let texts: Vec<String> = singles.iter().map(|x| print(*x)).collect();
            let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
            let expected: Vec<f64> = singles
                .iter()
                .map(|x| half * (f64::from(x.abs()) + f64::from(1.7f32)))
                .collect();
            assert_uncertainties(&texts, &expected);
        }
        // Whole numbers and binary fractions are numbers of any precision.
        let plain = ["1.000000000", "2.000000000", "0.123046875", "-3.000000000"];
        assert!(uncertainties(&plain).iter().all(|u| *u < 1e-8));
        // Nine digits of other numbers are what they are.
        let doubles = ["0.433012702", "-1.70000001", "0.00321234567"];
        assert!(uncertainties(&doubles).iter().all(|u| *u < 1e-8));
    }

    #[test]
    fn rare_events() {
        assert!((at_least(1, 0.01) - 0.00995).abs() < 1e-5);
        assert!(at_least(10, 0.3) < 1e-11 && at_least(10, 0.3) > 0.0);
        assert_eq!(at_least(0, 3.0), 1.0);
    }
}
