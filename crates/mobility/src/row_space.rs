//! A space spanned by rows that come one after the other, and go again.

/// An orthonormal basis of the rows added so far.
#[derive(Clone, Debug)]
pub(super) struct RowSpace {
    basis: Vec<Vec<f64>>,
    /// What is left of a row must be longer than this for the row to be independent.
    threshold: f64,
}

impl RowSpace {
    pub fn new(threshold: f64) -> Self {
        Self {
            basis: Vec::new(),
            threshold,
        }
    }

    pub fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// Adds a row; whether it was independent of those before.
    pub fn add(&mut self, row: &[f64]) -> bool {
        let mut rest = row.to_vec();
        let mut length = norm(&rest);
        // Twice is enough (Kahan, Parlett), and once where little is taken away.
        for _ in 0..2 {
            for known in &self.basis {
                let along: f64 = rest.iter().zip(known).map(|(x, y)| x * y).sum();
                for (x, y) in rest.iter_mut().zip(known) {
                    *x -= along * y;
                }
            }
            let before = std::mem::replace(&mut length, norm(&rest));
            if length > 0.5 * before {
                break;
            }
        }
        if !(length > self.threshold) {
            return false;
        }
        self.basis.push(rest.iter().map(|x| x / length).collect());
        true
    }

    /// Adds rows if all of them are independent together; otherwise none.
    pub fn add_all(&mut self, rows: &[Vec<f64>]) -> bool {
        let before = self.dimension();
        let independent = rows.iter().all(|row| self.add(row));
        if !independent {
            self.cut(before);
        }
        independent
    }

    /// Takes the last rows away until so many dimensions are left.
    pub fn cut(&mut self, dimension: usize) {
        self.basis.truncate(dimension);
    }
}

fn norm(row: &[f64]) -> f64 {
    row.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_added_whole_or_not_at_all() {
        let mut space = RowSpace::new(1e-9);
        assert!(space.add_all(&[vec![1.0, 0.0, 0.0], vec![1.0, 1.0, 0.0]]));
        assert!(!space.add_all(&[vec![0.0, 0.0, 2.0], vec![5.0, 1.0, 1.0]]));
        assert_eq!(space.dimension(), 2);
        assert!(!space.add(&[3.0, -4.0, 1e-10]));
        space.cut(1);
        assert!(space.add(&[0.0, 1.0, 0.0]));
    }
}
