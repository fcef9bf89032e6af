//! Monomials under numbers: every monomial of a computation is stored once and named by its number from then on.
//!
//! The hash of a monomial is a fixed linear form of its exponents, so the hash of a product is the sum of the hashes
//! (Monagan and Pearce 2015; also in the F4 of Berthomieu, Eder and Safey El Din 2021). The weights come from a fixed
//! generator: numbers, and with them everything computed from them, are the same in every run.

use super::budget::Stop;

/// Bits that tell without looking at the exponents that one monomial does not divide another.
pub(super) fn divisibility_mask(exponents: &[u16]) -> u64 {
    // Some bits for each variable, saying "at least 1, 2, ..."; with more than 64 variables they share bits.
    let each = (64 / exponents.len().max(1)).clamp(1, 8);
    let mut mask = 0;
    for (variable, &exponent) in exponents.iter().enumerate() {
        let levels = usize::from(exponent).min(each);
        mask |= ((1 << levels) - 1) << (variable * each % 64);
    }
    mask
}

pub(super) fn divides(a: &[u16], b: &[u16]) -> bool {
    a.iter().zip(b).all(|(a, b)| a <= b)
}

pub(super) fn degree(exponents: &[u16]) -> u32 {
    exponents.iter().map(|&e| u32::from(e)).sum()
}

/// `b / a`, where `a` divides `b`.
pub(super) fn quotient(b: &[u16], a: &[u16]) -> Vec<u16> {
    b.iter().zip(a).map(|(b, a)| b - a).collect()
}

/// All monomials met so far.
#[derive(Debug)]
pub(super) struct Monomials {
    variables: usize,
    weights: Vec<u64>,
    exponents: Vec<u16>,
    hashes: Vec<u64>,
    /// Open addressing.
    slots: Vec<Slot>,
}

/// A place for a monomial. The part of its hash beside the number spares a look at what is stored far away.
#[derive(Clone, Copy, Debug, Default)]
struct Slot {
    /// 0 is empty, otherwise a number plus one.
    number: u32,
    tag: u32,
}

impl Slot {
    fn of(number: u32, hash: u64) -> Self {
        Self {
            number: number + 1,
            tag: tag(hash),
        }
    }
}

/// Other bits of a hash than those that say where the search begins.
fn tag(hash: u64) -> u32 {
    (hash >> 32) as u32
}

const FIRST_SLOTS: usize = 1 << 8;

impl Monomials {
    pub(super) fn new(variables: usize) -> Self {
        // SplitMix64 (Steele, Lea and Flood 2014).
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let weights = (0..variables)
            .map(|_| {
                state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
                let mut z = state;
                z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
                z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
                (z ^ (z >> 31)) | 1
            })
            .collect();
        Self {
            variables,
            weights,
            exponents: Vec::new(),
            hashes: Vec::new(),
            slots: vec![Slot::default(); FIRST_SLOTS],
        }
    }

    /// Number of variables.
    pub(super) fn variables(&self) -> usize {
        self.variables
    }

    /// Number of monomials.
    pub(super) fn len(&self) -> usize {
        self.hashes.len()
    }

    /// Forgets all monomials, keeps the memory.
    pub(super) fn clear(&mut self) {
        self.exponents.clear();
        self.hashes.clear();
        self.slots.clear();
        self.slots.resize(FIRST_SLOTS, Slot::default());
    }

    pub(super) fn exponents(&self, number: u32) -> &[u16] {
        let start = number as usize * self.variables;
        &self.exponents[start..start + self.variables]
    }

    pub(super) fn hash(&self, number: u32) -> u64 {
        self.hashes[number as usize]
    }

    pub(super) fn hash_of(&self, exponents: &[u16]) -> u64 {
        exponents
            .iter()
            .zip(&self.weights)
            .fold(0_u64, |sum, (&e, &w)| {
                sum.wrapping_add(w.wrapping_mul(u64::from(e)))
            })
    }

    /// The number of a monomial.
    pub(super) fn number(&mut self, exponents: &[u16]) -> Result<u32, Stop> {
        let hash = self.hash_of(exponents);
        self.find_or_insert(
            hash,
            |stored| stored == exponents,
            |all| {
                all.extend_from_slice(exponents);
                Ok(())
            },
        )
    }

    /// The number of the product of two monomials, given with their hashes.
    pub(super) fn number_of_product(
        &mut self,
        (a, hash_a): (&[u16], u64),
        (b, hash_b): (&[u16], u64),
    ) -> Result<u32, Stop> {
        self.find_or_insert(
            hash_a.wrapping_add(hash_b),
            |stored| is_product(stored, a, b),
            |all| {
                for (&a, &b) in a.iter().zip(b) {
                    all.push(a.checked_add(b).ok_or(Stop::Memory)?);
                }
                Ok(())
            },
        )
    }

    fn find_or_insert(
        &mut self,
        hash: u64,
        same: impl Fn(&[u16]) -> bool,
        append: impl FnOnce(&mut Vec<u16>) -> Result<(), Stop>,
    ) -> Result<u32, Stop> {
        let last = self.slots.len() - 1;
        let mut slot = spread(hash) & last;
        loop {
            let Slot { number, tag: own } = self.slots[slot];
            if number == 0 {
                break;
            }
            if own == tag(hash) && same(self.exponents(number - 1)) {
                return Ok(number - 1);
            }
            slot = (slot + 1) & last;
        }
        let number = u32::try_from(self.len()).map_err(|_| Stop::Memory)?;
        if number == u32::MAX {
            return Err(Stop::Memory);
        }
        append(&mut self.exponents)?;
        self.hashes.push(hash);
        self.slots[slot] = Slot::of(number, hash);
        if 2 * self.len() > self.slots.len() {
            self.grow();
        }
        Ok(number)
    }

    fn grow(&mut self) {
        let size = 4 * self.slots.len();
        self.slots.clear();
        self.slots.resize(size, Slot::default());
        for (number, &hash) in self.hashes.iter().enumerate() {
            let mut slot = spread(hash) & (size - 1);
            while self.slots[slot].number != 0 {
                slot = (slot + 1) & (size - 1);
            }
            self.slots[slot] = Slot::of(number as u32, hash);
        }
    }
}

/// Whether a monomial is the product of two others. Without an early end, so that several exponents are compared at once.
fn is_product(stored: &[u16], a: &[u16], b: &[u16]) -> bool {
    let count = stored.len().min(a.len()).min(b.len());
    let (stored, a, b) = (&stored[..count], &a[..count], &b[..count]);
    let mut differing = 0;
    for place in 0..count {
        let product = u32::from(a[place]) + u32::from(b[place]);
        differing |= u32::from(stored[place]) ^ product;
    }
    differing == 0
}

/// The upper bits of a sum of odd weights are better mixed than the lower ones.
fn spread(hash: u64) -> usize {
    (hash ^ (hash >> 32)) as usize
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn products_are_found_under_the_number_of_the_monomial() {
        let mut monomials = Monomials::new(3);
        let mut numbers = Vec::new();
        for i in 0..1000_u16 {
            numbers.push(monomials.number(&[i % 10, i / 10 % 10, i / 100]).unwrap());
        }
        assert_eq!(monomials.len(), 1000);
        for i in 0..1000_u16 {
            let (a, b) = ([i % 10, 0, i / 100], [0, i / 10 % 10, 0]);
            let hashes = (monomials.hash_of(&a), monomials.hash_of(&b));
            let product = monomials.number_of_product((&a, hashes.0), (&b, hashes.1));
            assert_eq!(product, Ok(numbers[usize::from(i)]));
        }
        assert_eq!(monomials.len(), 1000);
        let large = [u16::MAX, 0, 0];
        let hash = monomials.hash_of(&large);
        assert_eq!(
            monomials.number_of_product((&large, hash), (&large, hash)),
            Err(Stop::Memory)
        );
    }

    #[test]
    fn the_mask_never_rejects_a_divisor() {
        for variables in [2_u16, 7, 16, 20, 70] {
            for seed in 0..50 {
                let small: Vec<u16> = (0..variables).map(|i| (seed + i) % 9).collect();
                let large: Vec<u16> = small.iter().map(|e| e + 3).collect();
                assert_eq!(divisibility_mask(&small) & !divisibility_mask(&large), 0);
                assert!(divides(&small, &large) && !divides(&large, &small));
            }
        }
    }
}
