//! Numbering of the monomials of bounded degree, with their multiplication table.

use std::sync::Arc;

use super::GroupError;

/// Largest number of entries a multiplication table may have (4 bytes each).
///
/// 2²⁶ entries are 256 MiB: beyond that a product would take seconds and a higher order is the wrong tool.
const LARGEST_TABLE: usize = 1 << 26;

/// All monomials y^α in `variables` variables with |α| ≤ `degree`, numbered from 0.
///
/// Order: by total degree, and within a degree by exponents in descending lexicographic order, so in two
/// variables 1, y₀, y₁, y₀², y₀y₁, y₁², … Number 0 is always the constant, number 1 + i the variable y_i.
///
/// Size: C(m+K, K) monomials; the table of products has C(2m+K, K) entries (m variables, degree K).
#[derive(Debug, PartialEq, Eq)]
pub struct Monomials {
    variables: usize,
    degree: usize,
    exponents: Vec<u8>,
    degree_start: Vec<usize>,
    product_start: Vec<usize>,
    products: Vec<u32>,
}

impl Monomials {
    /// Numbers the monomials and tabulates their products.
    ///
    /// # Errors
    /// [`GroupError::SeriesTooLarge`] where the table would exceed 2²⁶ entries or the degree 255.
    pub fn new(variables: usize, degree: usize) -> Result<Arc<Self>, GroupError> {
        let too_large = GroupError::SeriesTooLarge { variables, degree };
        if degree > 255 || binomial(2 * variables + degree, degree) > LARGEST_TABLE as u128 {
            return Err(too_large);
        }
        let mut exponents = Vec::new();
        let mut degree_start = vec![0];
        let mut count = 0;
        let mut current = vec![0_u8; variables];
        for d in 0..=degree {
            count += push_degree(&mut exponents, &mut current, 0, d);
            degree_start.push(count);
        }
        let mut monomials = Self {
            variables,
            degree,
            exponents,
            degree_start,
            product_start: vec![0],
            products: Vec::new(),
        };
        let counts = Counts::new(variables, degree);
        let mut sum = vec![0_u8; variables];
        for a in 0..count {
            let partners = monomials.count_up_to(degree - monomials.degree_of(a));
            for b in 0..partners {
                for (i, s) in sum.iter_mut().enumerate() {
                    *s = monomials.exponents(a)[i] + monomials.exponents(b)[i];
                }
                let index = monomials.rank(&sum, &counts);
                monomials.products.push(index as u32);
            }
            monomials.product_start.push(monomials.products.len());
        }
        Ok(Arc::new(monomials))
    }

    /// Number of variables m.
    pub fn variables(&self) -> usize {
        self.variables
    }

    /// Truncation degree K.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Number of monomials, C(m+K, K).
    pub fn count(&self) -> usize {
        self.count_up_to(self.degree)
    }

    /// Number of monomials of degree at most `degree` (which is capped at K).
    pub fn count_up_to(&self, degree: usize) -> usize {
        self.degree_start[degree.min(self.degree) + 1]
    }

    /// Index range of the monomials of exactly this degree; empty above K.
    pub fn of_degree(&self, degree: usize) -> std::ops::Range<usize> {
        if degree > self.degree {
            return self.count()..self.count();
        }
        self.degree_start[degree]..self.degree_start[degree + 1]
    }

    /// Exponents α of monomial `index`, one per variable. Panics if `index` ≥ [`Monomials::count`].
    pub fn exponents(&self, index: usize) -> &[u8] {
        &self.exponents[index * self.variables..(index + 1) * self.variables]
    }

    /// Total degree |α| of monomial `index`.
    pub fn degree_of(&self, index: usize) -> usize {
        // Degrees are few: the search is over K + 2 boundaries.
        self.degree_start.partition_point(|start| *start <= index) - 1
    }

    /// Index of the monomial with these exponents; `None` if their number is not m or their sum exceeds K.
    pub fn index_of(&self, exponents: &[u8]) -> Option<usize> {
        let total: usize = exponents.iter().map(|e| usize::from(*e)).sum();
        if exponents.len() != self.variables || total > self.degree {
            return None;
        }
        Some(self.rank(exponents, &Counts::new(self.variables, self.degree)))
    }

    /// Indices of the products of monomial `a` with the monomials 0, 1, 2, … as long as the degree of the
    /// product stays within K.
    pub(super) fn products_with(&self, a: usize) -> &[u32] {
        &self.products[self.product_start[a]..self.product_start[a + 1]]
    }

    fn rank(&self, exponents: &[u8], counts: &Counts) -> usize {
        let mut rest: usize = exponents.iter().map(|e| usize::from(*e)).sum();
        let mut index = self.degree_start[rest];
        for (i, &e) in exponents.iter().enumerate() {
            // Those with a larger exponent here, and the same before, come first.
            let e = usize::from(e);
            let after = self.variables - i - 1;
            for larger in e + 1..=rest {
                index += counts.exact(after, rest - larger);
            }
            rest -= e;
        }
        index
    }
}

/// Appends the monomials of degree `rest` in the variables from `position` on; returns how many.
fn push_degree(out: &mut Vec<u8>, current: &mut [u8], position: usize, rest: usize) -> usize {
    if position + 1 >= current.len() {
        if current.is_empty() {
            return usize::from(rest == 0);
        }
        current[position] = rest as u8;
        out.extend_from_slice(current);
        return 1;
    }
    let mut count = 0;
    for e in (0..=rest).rev() {
        current[position] = e as u8;
        count += push_degree(out, current, position + 1, rest - e);
    }
    count
}

/// How many monomials of an exact degree there are in a number of variables.
struct Counts {
    columns: usize,
    table: Vec<usize>,
}

impl Counts {
    fn new(variables: usize, degree: usize) -> Self {
        let columns = degree + 1;
        let mut table = vec![0; (variables + 1) * columns];
        table[0] = 1;
        for m in 1..=variables {
            let mut sum = 0;
            for d in 0..columns {
                sum += table[(m - 1) * columns + d];
                table[m * columns + d] = sum;
            }
        }
        Self { columns, table }
    }

    fn exact(&self, variables: usize, degree: usize) -> usize {
        self.table[variables * self.columns + degree]
    }
}

/// C(n, k), saturating: enough to compare with a size limit.
fn binomial(n: usize, k: usize) -> u128 {
    let k = k.min(n - k);
    let mut value: u128 = 1;
    for i in 0..k {
        match value.checked_mul((n - i) as u128) {
            Some(product) => value = product / (i as u128 + 1),
            None => return u128::MAX,
        }
    }
    value
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn order_is_by_degree_then_lexicographic() {
        let m = Monomials::new(2, 3).unwrap();
        let all: Vec<_> = (0..m.count()).map(|i| m.exponents(i).to_vec()).collect();
        let expected: Vec<Vec<u8>> = [
            [0, 0],
            [1, 0],
            [0, 1],
            [2, 0],
            [1, 1],
            [0, 2],
            [3, 0],
            [2, 1],
            [1, 2],
            [0, 3],
        ]
        .iter()
        .map(|e| e.to_vec())
        .collect();
        assert_eq!(all, expected);
    }

    #[test]
    fn numbering_round_trips_and_products_add_exponents() {
        for (variables, degree) in [(0, 3), (1, 8), (2, 6), (3, 5), (6, 4)] {
            let m = Monomials::new(variables, degree).unwrap();
            assert_eq!(
                m.count() as u128,
                binomial(variables + degree, degree),
                "{variables} variables, degree {degree}"
            );
            let mut entries = 0;
            for a in 0..m.count() {
                assert_eq!(m.index_of(m.exponents(a)), Some(a));
                let total: usize = m.exponents(a).iter().map(|e| usize::from(*e)).sum();
                assert_eq!(m.degree_of(a), total);
                assert!(m.of_degree(total).contains(&a));
                for (b, &c) in m.products_with(a).iter().enumerate() {
                    entries += 1;
                    for i in 0..variables {
                        assert_eq!(
                            m.exponents(c as usize)[i],
                            m.exponents(a)[i] + m.exponents(b)[i]
                        );
                    }
                }
            }
            assert_eq!(entries, binomial(2 * variables + degree, degree));
        }
    }

    #[test]
    fn indices_outside_the_truncation_are_refused() {
        let m = Monomials::new(2, 3).unwrap();
        assert_eq!(m.index_of(&[2, 2]), None);
        assert_eq!(m.index_of(&[1]), None);
        assert!(Monomials::new(40, 12).is_err());
        assert!(Monomials::new(1, 300).is_err());
    }
}
