//! Which vectors of whole numbers are combinations of others.

use kutzbach_math::matrix::Field61;
use std::collections::BTreeMap;

/// Vectors in echelon form, over a prime field: what is independent there is independent over the rationals, and the
/// other way round unless the prime divides a minor.
#[derive(Clone, Debug, Default)]
pub(super) struct Elimination {
    /// By the first entry of each, which is one.
    rows: BTreeMap<usize, BTreeMap<usize, Field61>>,
}

impl Elimination {
    /// Adds a vector by its entries; `false` where it is a combination of those before.
    pub(super) fn add(&mut self, entries: &[(usize, i64)]) -> bool {
        let mut rest: BTreeMap<usize, Field61> = BTreeMap::new();
        for &(column, value) in entries {
            add(&mut rest, column, Field61::new(value.into()));
        }
        while let Some((&column, &value)) = rest.first_key_value() {
            let Some(row) = self.rows.get(&column) else {
                let scale = Field61::ONE / value;
                let scaled = rest.iter().map(|(c, v)| (*c, *v * scale)).collect();
                self.rows.insert(column, scaled);
                return true;
            };
            for (&c, &v) in row {
                add(&mut rest, c, -(value * v));
            }
        }
        false
    }

    /// How many independent vectors were added.
    #[cfg(test)]
    pub(super) fn rank(&self) -> usize {
        self.rows.len()
    }
}

fn add(vector: &mut BTreeMap<usize, Field61>, column: usize, value: Field61) {
    let sum = vector.get(&column).copied().unwrap_or(Field61::ZERO) + value;
    if sum == Field61::ZERO {
        vector.remove(&column);
    } else {
        vector.insert(column, sum);
    }
}
