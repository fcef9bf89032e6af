//! From signs of numbers to answers, and how certain a choice is.

use crate::scalar::Scalar;
use std::cmp::Ordering;

/// What is known of the sign of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Below zero, proven.
    Negative,
    /// Zero, proven.
    Zero,
    /// Above zero, proven.
    Positive,
    /// Zero is among the values that the digits allow, and not the only one.
    WithinDigits,
    /// An exact expression that no digits tell from zero, and for which no bound is known below which it has to be zero.
    Indistinguishable,
}

/// The answer to a logical query.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It holds, for all values within the digits.
    Yes,
    /// It does not hold, for no values within the digits.
    No,
    /// It holds for some values within the digits, and may fail for others.
    WithinDigits,
    /// Exact numbers that agree in every digit looked at, without a proof that they are equal.
    Indistinguishable,
}

impl Answer {
    /// Whether a number of this sign is zero.
    #[must_use]
    pub const fn zero(sign: Sign) -> Self {
        match sign {
            Sign::Zero => Self::Yes,
            Sign::Negative | Sign::Positive => Self::No,
            Sign::WithinDigits => Self::WithinDigits,
            Sign::Indistinguishable => Self::Indistinguishable,
        }
    }

    /// Whether a number of this sign is zero or above.
    #[must_use]
    pub const fn not_negative(sign: Sign) -> Self {
        match sign {
            Sign::Zero | Sign::Positive => Self::Yes,
            Sign::Negative => Self::No,
            Sign::WithinDigits => Self::WithinDigits,
            Sign::Indistinguishable => Self::Indistinguishable,
        }
    }

    /// Whether a number of this sign is above zero.
    #[must_use]
    pub const fn positive(sign: Sign) -> Self {
        match sign {
            Sign::Positive => Self::Yes,
            Sign::Zero | Sign::Negative => Self::No,
            Sign::WithinDigits => Self::WithinDigits,
            Sign::Indistinguishable => Self::Indistinguishable,
        }
    }

    /// Whether both hold: a *no* decides; of two doubts the one about digits is told.
    #[must_use]
    pub const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::No, _) | (_, Self::No) => Self::No,
            (Self::WithinDigits, _) | (_, Self::WithinDigits) => Self::WithinDigits,
            (Self::Indistinguishable, _) | (_, Self::Indistinguishable) => Self::Indistinguishable,
            (Self::Yes, Self::Yes) => Self::Yes,
        }
    }

    /// Whether one of the two holds: a *yes* decides.
    #[must_use]
    pub const fn or(self, other: Self) -> Self {
        match (self, other) {
            (Self::Yes, _) | (_, Self::Yes) => Self::Yes,
            (Self::WithinDigits, _) | (_, Self::WithinDigits) => Self::WithinDigits,
            (Self::Indistinguishable, _) | (_, Self::Indistinguishable) => Self::Indistinguishable,
            (Self::No, Self::No) => Self::No,
        }
    }

    /// Whether it is certainly so.
    #[must_use]
    pub const fn is_yes(self) -> bool {
        matches!(self, Self::Yes)
    }

    /// Whether it is certainly not so.
    #[must_use]
    pub const fn is_no(self) -> bool {
        matches!(self, Self::No)
    }
}

/// Whether a vector is zero.
pub(crate) fn zero_vector<S: Scalar>(v: &[S; 3]) -> Answer {
    v.iter()
        .map(|x| Answer::zero(x.sign()))
        .fold(Answer::Yes, Answer::and)
}

/// How certain the choice of a case is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Certainty {
    /// The case is proven.
    #[default]
    Proven,
    /// Something exact counted as zero that is not proven to be.
    Indistinguishable,
    /// Something counted as zero that is zero for some values within the digits only.
    WithinDigits,
}

impl Certainty {
    /// The answer of a case that was chosen with this certainty: a doubt about the case is one about the answer.
    #[must_use]
    pub const fn answer(self, holds: bool) -> Answer {
        match (self, holds) {
            (Self::Proven, true) => Answer::Yes,
            (Self::Proven, false) => Answer::No,
            (Self::Indistinguishable, _) => Answer::Indistinguishable,
            (Self::WithinDigits, _) => Answer::WithinDigits,
        }
    }
}

/// A result, and how certain the case is that it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome<T> {
    /// What was constructed: where `certainty` is not [`Certainty::Proven`], for the case that what is not told from zero
    /// is zero.
    pub value: T,
    /// How certain that case is.
    pub certainty: Certainty,
}

/// Chooses cases and remembers the weakest ground that a choice had.
#[derive(Debug, Default)]
pub(crate) struct Decider {
    certainty: Certainty,
}

impl Decider {
    /// Takes over the ground of a choice that was made elsewhere.
    pub(crate) fn weaken(&mut self, to: Certainty) {
        self.certainty = self.certainty.max(to);
    }

    /// The value of an outcome, whose certainty is taken over.
    pub(crate) fn take<T>(&mut self, outcome: Outcome<T>) -> T {
        self.weaken(outcome.certainty);
        outcome.value
    }

    /// Whether an answer counts as yes: what is in doubt does.
    pub(crate) fn counts(&mut self, answer: Answer) -> bool {
        match answer {
            Answer::No => return false,
            Answer::Yes => {}
            Answer::WithinDigits => self.weaken(Certainty::WithinDigits),
            Answer::Indistinguishable => self.weaken(Certainty::Indistinguishable),
        }
        true
    }

    /// The weakest ground so far.
    pub(crate) fn certainty(&self) -> Certainty {
        self.certainty
    }

    /// The number beside zero.
    pub(crate) fn order<S: Scalar>(&mut self, x: &S) -> Ordering {
        match x.sign() {
            Sign::Negative => Ordering::Less,
            Sign::Positive => Ordering::Greater,
            Sign::Zero => Ordering::Equal,
            Sign::WithinDigits => {
                self.weaken(Certainty::WithinDigits);
                Ordering::Equal
            }
            Sign::Indistinguishable => {
                self.weaken(Certainty::Indistinguishable);
                Ordering::Equal
            }
        }
    }

    /// Whether the number counts as zero.
    pub(crate) fn is_zero<S: Scalar>(&mut self, x: &S) -> bool {
        self.order(x) == Ordering::Equal
    }

    /// Whether the vector counts as zero: one component that is certainly not zero is enough for a proof that it is not.
    pub(crate) fn vanishes<S: Scalar>(&mut self, v: &[S; 3]) -> bool {
        self.counts(zero_vector(v))
    }

    /// The result with the certainty of all choices so far.
    pub(crate) fn outcome<T>(self, value: T) -> Outcome<T> {
        Outcome {
            value,
            certainty: self.certainty,
        }
    }
}
