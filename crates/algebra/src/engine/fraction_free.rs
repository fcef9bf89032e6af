//! Elimination in rows of fractions without fractions: whole numbers, with one denominator for a whole row.
//!
//! A fraction is reduced after every product, which is most of the time of schoolbook elimination. Here a row is multiplied by what
//! the leading number of a pivot lacks, and nothing is reduced but at the end, and whenever the common factor has become twice
//! as long. Small numbers are computed in 128 bits, checked; a row that overflows is done again with numbers of any length.

use super::budget::{Budget, Stop};
use crate::polynomial::Rational;
use groebner::SparseRow;
use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};
use polycore::lehmer::{fraction, gcd};

/// Fractions times their common denominator, without a common factor: a multiple of what was given.
pub(super) struct Primitive {
    /// Where all of them fit.
    small: Option<Vec<i128>>,
    big: Vec<BigInt>,
}

impl Primitive {
    pub(super) fn of(values: &[Rational]) -> Self {
        let (mut big, _) = over_common_denominator(values);
        let common = big.iter().fold(BigInt::zero(), |common, value| {
            common_factor(&common, value)
        });
        if !common.is_zero() && !common.is_one() {
            for value in &mut big {
                *value /= &common;
            }
        }
        let small = big.iter().map(<i128 as Whole>::of).collect();
        Self { small, big }
    }
}

/// The numerators over the least common denominator, and that.
fn over_common_denominator(values: &[Rational]) -> (Vec<BigInt>, BigInt) {
    let mut common = BigInt::one();
    for value in values {
        let denominator = value.denom();
        if !denominator.is_one() && !(&common % denominator).is_zero() {
            let shared = common_factor(&common, denominator);
            common = common / shared * denominator;
        }
    }
    let whole = |value: &Rational| {
        if value.denom() == &common {
            value.numer().clone()
        } else {
            &common / value.denom() * value.numer()
        }
    };
    (values.iter().map(whole).collect(), common)
}

fn common_factor(a: &BigInt, b: &BigInt) -> BigInt {
    BigInt::from(gcd(a.magnitude(), b.magnitude()))
}

/// What a column of a row is reduced by.
pub(super) struct Pivot<'a> {
    /// The leading column first.
    pub(super) columns: &'a [u32],
    pub(super) values: &'a Primitive,
}

/// A row, and its multiples of rows that are subtracted from it.
pub(super) struct Reduction<'a, P> {
    /// The pivot of a column, where there is one: with no columns before it.
    pub(super) pivot: P,
    pub(super) width: usize,
    /// Whether the rest is divided by its leading number.
    pub(super) monic: bool,
    pub(super) budget: &'a Budget,
}

impl<'a, P: Fn(usize) -> Option<Pivot<'a>>> Reduction<'_, P> {
    /// What remains of a row.
    pub(super) fn of(&self, row: &SparseRow<Rational>) -> Result<SparseRow<Rational>, Stop> {
        let (numerators, denominator) = over_common_denominator(&row.coefficients);
        match self.within::<i128>(&row.columns, &numerators, &denominator)? {
            Some(rest) => Ok(rest),
            // Numbers of any length do not overflow.
            None => self
                .within::<BigInt>(&row.columns, &numerators, &denominator)?
                .ok_or(Stop::Coefficients),
        }
    }

    /// The same in numbers of one kind; `None` where they are too short.
    fn within<W: Whole>(
        &self,
        columns: &[u32],
        numerators: &[BigInt],
        denominator: &BigInt,
    ) -> Result<Option<SparseRow<Rational>>, Stop> {
        let Some(mut row) = Row::<W>::of(columns, numerators, denominator, self.width) else {
            return Ok(None);
        };
        let first = columns
            .first()
            .map_or(self.width, |&column| column as usize);
        let mut kept = Vec::new();
        for column in first..self.width {
            if row.bring_up_to_date(column).is_none() {
                return Ok(None);
            }
            if row.cells[column].is_zero() {
                continue;
            }
            let Some(pivot) = (self.pivot)(column) else {
                kept.push(column);
                continue;
            };
            // The work of a product grows with the digits of the number.
            let digits = row.cells[column].words();
            self.budget.spend(pivot.columns.len() as u64 * digits)?;
            if row.subtract(column, &pivot).is_none() {
                return Ok(None);
            }
        }
        Ok(row.rest(&kept, self.monic))
    }
}

/// A denominator of more than so many words is looked at for a common factor with the numerators.
const LONG: u64 = 4;

/// A row of fractions with one denominator.
struct Row<W> {
    cells: Vec<W>,
    /// Up to which factor each cell has been multiplied.
    at: Vec<u32>,
    /// Products of the factors from the first on, the empty one included.
    factors: Vec<W>,
    denominator: W,
    /// Words of the denominator up to which no common factor is looked for.
    long: u64,
}

impl<W: Whole> Row<W> {
    fn of(
        columns: &[u32],
        numerators: &[BigInt],
        denominator: &BigInt,
        width: usize,
    ) -> Option<Self> {
        let mut cells = vec![W::zero(); width];
        for (&column, value) in columns.iter().zip(numerators) {
            cells[column as usize] = W::of(value)?;
        }
        Some(Self {
            cells,
            at: vec![0; width],
            factors: vec![W::one()],
            denominator: W::of(denominator)?,
            long: LONG,
        })
    }

    /// Multiplies a cell by the factors that it has not seen.
    fn bring_up_to_date(&mut self, column: usize) -> Option<()> {
        let (seen, last) = (self.at[column] as usize, self.factors.len() - 1);
        if seen < last && !self.cells[column].is_zero() {
            let missing = self.factors[last].over(&self.factors[seen]);
            self.cells[column] = self.cells[column].times(&missing)?;
        }
        self.at[column] = last as u32;
        Some(())
    }

    /// Subtracts the multiple of a pivot that leaves nothing in its leading column.
    fn subtract(&mut self, column: usize, pivot: &Pivot<'_>) -> Option<()> {
        let values = W::values(pivot.values)?;
        let value = std::mem::replace(&mut self.cells[column], W::zero());
        let common = value.common_factor(values.first()?);
        let (times, factor) = (value.over(&common), values[0].over(&common));
        if factor != W::one() {
            self.denominator = self.denominator.times(&factor)?;
            let product = self.factors[self.factors.len() - 1].times(&factor)?;
            self.factors.push(product);
        }
        for (&at, value) in pivot.columns.iter().zip(values).skip(1) {
            let at = at as usize;
            self.bring_up_to_date(at)?;
            let cell = std::mem::replace(&mut self.cells[at], W::zero());
            self.cells[at] = cell.less(&times, value)?;
        }
        if self.denominator.words() > self.long {
            self.shorten()?;
        }
        Some(())
    }

    /// Divides numerators and denominator by what they have in common.
    fn shorten(&mut self) -> Option<()> {
        let mut common = self.denominator.clone();
        for column in 0..self.cells.len() {
            self.bring_up_to_date(column)?;
            if !self.cells[column].is_zero() && common != W::one() {
                common = common.common_factor(&self.cells[column]);
            }
        }
        if common != W::one() {
            for cell in self.cells.iter_mut().filter(|cell| !cell.is_zero()) {
                *cell = cell.over(&common);
            }
            self.denominator = self.denominator.over(&common);
        }
        self.factors.truncate(1);
        self.at.fill(0);
        self.long = (2 * self.denominator.words()).max(LONG);
        Some(())
    }

    fn rest(mut self, kept: &[usize], monic: bool) -> Option<SparseRow<Rational>> {
        for &column in kept {
            self.bring_up_to_date(column)?;
        }
        let denominator = match kept.first() {
            Some(&first) if monic => self.cells[first].clone(),
            _ => self.denominator,
        };
        let fraction = |&column: &usize| self.cells[column].fraction(&denominator);
        Some(SparseRow {
            columns: kept.iter().map(|&column| column as u32).collect(),
            coefficients: kept.iter().map(fraction).collect(),
        })
    }
}

/// Whole numbers that may be too short for a result, which is `None` then.
trait Whole: Clone + PartialEq + One + Zero {
    fn of(value: &BigInt) -> Option<Self>;
    fn values(primitive: &Primitive) -> Option<&[Self]>;
    /// In words of 64 bits, one at least.
    fn words(&self) -> u64;
    fn common_factor(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Option<Self>;
    /// Without remainder.
    fn over(&self, divisor: &Self) -> Self;
    /// This less a product.
    fn less(self, factor: &Self, other: &Self) -> Option<Self>;
    fn fraction(&self, denominator: &Self) -> Rational;
}

impl Whole for i128 {
    fn of(value: &BigInt) -> Option<Self> {
        // The least number has no absolute value.
        Self::try_from(value).ok().filter(|&v| v != Self::MIN)
    }

    fn values(primitive: &Primitive) -> Option<&[Self]> {
        primitive.small.as_deref()
    }

    fn words(&self) -> u64 {
        1 + u64::from(self.unsigned_abs() >> 64 != 0)
    }

    fn common_factor(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.unsigned_abs(), other.unsigned_abs());
        while b != 0 {
            (a, b) = match (u64::try_from(a), u64::try_from(b)) {
                (Ok(a), Ok(b)) => (u128::from(b), u128::from(a % b)),
                _ => (b, a % b),
            };
        }
        // Both were absolute values.
        Self::try_from(a).unwrap_or(Self::MAX)
    }

    fn times(&self, other: &Self) -> Option<Self> {
        self.checked_mul(*other).filter(|&v| v != Self::MIN)
    }

    fn over(&self, divisor: &Self) -> Self {
        self / divisor
    }

    fn less(self, factor: &Self, other: &Self) -> Option<Self> {
        self.checked_sub(factor.checked_mul(*other)?)
            .filter(|&v| v != Self::MIN)
    }

    fn fraction(&self, denominator: &Self) -> Rational {
        let common = self.common_factor(denominator) * denominator.signum();
        Rational::new_raw((self / common).into(), (denominator / common).into())
    }
}

impl Whole for BigInt {
    fn of(value: &BigInt) -> Option<Self> {
        Some(value.clone())
    }

    fn values(primitive: &Primitive) -> Option<&[Self]> {
        Some(&primitive.big)
    }

    fn words(&self) -> u64 {
        self.bits() / 64 + 1
    }

    fn common_factor(&self, other: &Self) -> Self {
        common_factor(self, other)
    }

    fn times(&self, other: &Self) -> Option<Self> {
        Some(self * other)
    }

    fn over(&self, divisor: &Self) -> Self {
        self / divisor
    }

    fn less(self, factor: &Self, other: &Self) -> Option<Self> {
        Some(self - factor * other)
    }

    fn fraction(&self, denominator: &Self) -> Rational {
        let signed = if denominator.is_negative() {
            -self
        } else {
            self.clone()
        };
        fraction(signed, denominator.magnitude())
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const WIDTH: usize = 8;

    /// Rows of an upper triangle with ones on its diagonal, in some columns.
    fn pivots(entries: &[Vec<Rational>]) -> Vec<Option<SparseRow<Rational>>> {
        let row = |(first, values): (usize, &Vec<Rational>)| {
            let tail = values.iter().zip(first + 1..WIDTH);
            let (columns, coefficients) = std::iter::once((first as u32, Rational::one()))
                .chain(tail.map(|(value, column)| (column as u32, value.clone())))
                .filter(|(_, value)| !value.is_zero())
                .unzip();
            SparseRow {
                columns,
                coefficients,
            }
        };
        // Every third column has none.
        (0..)
            .zip(entries)
            .map(|entry| (entry.0 % 3 != 1).then(|| row(entry)))
            .collect()
    }

    /// By fractions, term by term.
    fn schoolbook(values: &[Rational], pivots: &[Option<SparseRow<Rational>>]) -> Vec<Rational> {
        let mut cells = values.to_vec();
        for column in 0..WIDTH {
            let Some(pivot) = &pivots[column] else {
                continue;
            };
            let times = cells[column].clone();
            for (&at, value) in pivot.columns.iter().zip(&pivot.coefficients) {
                cells[at as usize] = &cells[at as usize] - &times * value;
            }
        }
        cells
    }

    fn reduced(
        values: &[Rational],
        pivots: &[Option<SparseRow<Rational>>],
        monic: bool,
    ) -> Vec<Rational> {
        let primitive: Vec<_> = pivots
            .iter()
            .map(|pivot| pivot.as_ref().map(|p| Primitive::of(&p.coefficients)))
            .collect();
        let row = SparseRow {
            columns: (0..WIDTH as u32).collect(),
            coefficients: values.to_vec(),
        };
        let pivot = |column: usize| {
            let columns = &*pivots[column].as_ref()?.columns;
            let values = primitive[column].as_ref()?;
            Some(Pivot { columns, values })
        };
        let budget = Budget::unlimited();
        let rest = Reduction {
            pivot,
            width: WIDTH,
            monic,
            budget: &budget,
        }
        .of(&row)
        .unwrap();
        let mut cells = vec![Rational::zero(); WIDTH];
        for (&column, value) in rest.columns.iter().zip(rest.coefficients) {
            assert!(!value.is_zero() && value.denom().is_positive());
            cells[column as usize] = value;
        }
        cells
    }

    fn fraction(numerator: i128, denominator: i128) -> Rational {
        Rational::new(numerator.into(), denominator.into())
    }

    /// Short ones, some zeros, and ones that no product of which fits 128 bits.
    fn number() -> impl Strategy<Value = Rational> {
        prop_oneof![
            Just(Rational::zero()),
            (-9_i128..10, 1_i128..7).prop_map(|(n, d)| fraction(n, d)),
            (any::<i128>(), 1_i128..i128::MAX).prop_map(|(n, d)| fraction(n / 2, d)),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn the_rest_is_that_of_fractions(
            values in prop::collection::vec(number(), WIDTH),
            entries in prop::collection::vec(prop::collection::vec(number(), WIDTH), WIDTH),
        ) {
            let pivots = pivots(&entries);
            let expected = schoolbook(&values, &pivots);
            prop_assert_eq!(&reduced(&values, &pivots, false), &expected);
            let lead = expected.iter().find(|value| !value.is_zero());
            if let Some(lead) = lead {
                let monic: Vec<_> = expected.iter().map(|value| value / lead).collect();
                prop_assert_eq!(reduced(&values, &pivots, true), monic);
            }
        }
    }

    #[test]
    fn a_long_denominator_is_shortened() {
        // Powers of two that cancel: each step doubles the row and the denominator alike.
        let half = fraction(1, 1 << 100);
        let entries = vec![vec![half; WIDTH]; WIDTH];
        let values = vec![fraction(1, (1 << 100) + 1); WIDTH];
        let pivots = pivots(&entries);
        assert_eq!(
            reduced(&values, &pivots, false),
            schoolbook(&values, &pivots)
        );
    }
}
