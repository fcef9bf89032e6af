//! A number of solutions, as a product.

use super::classes::Class;
use std::fmt;

/// How many solutions there are: a power of two times some more factors.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Count {
    /// The exponent of two.
    pub twos: usize,
    /// The other factors, of classes of steps that hang together; a zero among them makes all zero.
    pub factors: Vec<usize>,
    /// Whether all choices were tried: otherwise there are at least so many.
    pub complete: bool,
    /// Whether some choices come to a step that nothing fixes: these are infinitely many solutions or none, and not counted.
    pub degenerate: bool,
}

impl Count {
    pub(super) fn of(classes: &[Class]) -> Self {
        let mut count = Self {
            twos: 0,
            factors: Vec::new(),
            complete: true,
            degenerate: false,
        };
        for class in classes {
            count.complete &= class.complete;
            count.degenerate |= class.degenerate;
            match class.ways.len() {
                1 => {}
                0 => count.factors.push(0),
                some => {
                    let twos = some.trailing_zeros() as usize;
                    count.twos += twos;
                    count.factors.extend(Some(some >> twos).filter(|&f| f > 1));
                }
            }
        }
        count
    }

    /// The number, if it is below 2¹²⁸.
    #[must_use]
    pub fn value(&self) -> Option<u128> {
        if self.factors.contains(&0) {
            return Some(0);
        }
        let odd = self
            .factors
            .iter()
            .try_fold(1_u128, |product, &f| product.checked_mul(f as u128))?;
        let twos = u32::try_from(self.twos).ok()?;
        odd.checked_mul(1_u128.checked_shl(twos)?)
    }
}

impl fmt::Display for Count {
    /// `12`, `2^9998`, `at least 2^40 * 3`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.complete {
            f.write_str("at least ")?;
        }
        match self.value() {
            Some(value) if value < 1 << 20 => write!(f, "{value}"),
            _ => {
                write!(f, "2^{}", self.twos)?;
                self.factors.iter().try_for_each(|x| write!(f, " * {x}"))
            }
        }
    }
}
