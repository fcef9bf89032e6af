//! Which polynomials are linear combinations of others.

use super::Poly;
use kutzbach_algebra::NumberField;

/// Polynomials in echelon form: every one has a term that no other has.
#[derive(Debug, Default)]
pub(super) struct Independent {
    rows: Vec<(Vec<u8>, Poly)>,
}

impl Independent {
    /// Adds a polynomial; `false` where it is a combination of those before, zero included.
    pub(super) fn add(&mut self, polynomial: &Poly, field: &NumberField) -> bool {
        let mut rest = polynomial.clone();
        for (lead, row) in &self.rows {
            let factor = rest
                .terms()
                .find(|(e, _)| *e == lead.as_slice())
                .map(|(_, c)| c.clone());
            if let Some(factor) = factor {
                rest = rest.minus(&row.scaled(&factor, field));
            }
        }
        // The largest term, so that a constant comes last.
        let lead = rest
            .terms()
            .max_by_key(|(e, _)| *e)
            .map(|(e, c)| (e.to_vec(), c.clone()));
        let Some((lead, coefficient)) = lead else {
            return false;
        };
        let Some(inverse) = field.inverse(&coefficient) else {
            return false;
        };
        self.rows.push((lead, rest.scaled(&inverse, field)));
        true
    }

    /// Whether a combination of the polynomials is a constant that is not zero.
    pub(super) fn holds_a_constant(&self) -> bool {
        self.rows.iter().any(|(_, row)| row.is_constant())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kutzbach_algebra::FieldElement;

    #[test]
    fn combinations_are_told_from_news() {
        let field = NumberField::default();
        let (x, y) = (Poly::unknown(0), Poly::unknown(1));
        let one = Poly::constant(FieldElement::integer(1));
        let mut all = Independent::default();
        assert!(all.add(&x.plus(&y), &field));
        assert!(all.add(&x.minus(&y), &field));
        assert!(!all.add(&y, &field));
        assert!(!all.add(&Poly::default(), &field));
        assert!(!all.holds_a_constant());
        assert!(all.add(&y.plus(&one), &field));
        assert!(all.holds_a_constant());
    }
}
