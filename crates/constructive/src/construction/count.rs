//! A number of solutions, as a product.

use super::classes::{Choices, Class};
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
    /// Whether these are known to be infinitely many: nothing follows from that step that might be impossible.
    pub infinite: bool,
    /// The least and the most there can be where circles touch or nearly do, which leaves none, one or two places; `None` where
    /// none do, or beyond 2¹²⁸.
    pub between: Option<[u128; 2]>,
}

impl Count {
    pub(super) fn of(classes: &[Class]) -> Self {
        let possible = |class: &Class| class.infinite || !class.ways.is_empty();
        let mut count = Self {
            twos: 0,
            factors: Vec::new(),
            complete: true,
            degenerate: false,
            infinite: classes.iter().any(|c| c.infinite) && classes.iter().all(possible),
            between: between(classes),
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

    /// The number, if it is below 2¹²⁸; circles that touch or nearly do are counted as touching.
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

/// The least and the most that steps leave that touch or nearly do; `None` where there are none.
fn between(classes: &[Class]) -> Option<[u128; 2]> {
    let ways = || classes.iter().flat_map(|class| &class.ways);
    if ways().all(|way| way.nearly == 0) {
        return None;
    }
    classes
        .iter()
        .try_fold([1_u128; 2], |[least, most], class| {
            let sure = class.ways.iter().filter(|way| way.nearly == 0).count();
            let places = |way: &Choices| 1_u128.checked_shl(way.nearly);
            let all = class
                .ways
                .iter()
                .try_fold(0_u128, |sum, way| sum.checked_add(places(way)?))?;
            Some([least.checked_mul(sure as u128)?, most.checked_mul(all)?])
        })
}

impl fmt::Display for Count {
    /// `12`, `2^9998`, `at least 2^40 * 3`, `from 2 to 4`, `infinitely many`, `infinitely many or none`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.value(), self.infinite, self.degenerate) {
            (Some(0), true, _) => return f.write_str("infinitely many"),
            (Some(0), false, true) => return f.write_str("infinitely many or none"),
            _ => {}
        }
        if !self.complete {
            f.write_str("at least ")?;
        }
        match (self.between, self.value()) {
            (Some([least, _]), _) if !self.complete => write!(f, "{least}")?,
            (Some([least, most]), _) => write!(f, "from {least} to {most}")?,
            (None, Some(value)) if value < 1 << 20 => write!(f, "{value}")?,
            _ => {
                write!(f, "2^{}", self.twos)?;
                self.factors.iter().try_for_each(|x| write!(f, " * {x}"))?;
            }
        }
        match self.infinite {
            true => f.write_str(", and infinitely many besides"),
            false => Ok(()),
        }
    }
}
