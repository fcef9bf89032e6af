//! Linear independence over the field of two elements, for sparse and for dense vectors.
//!
//! A cycle is a vector with a one for each of its edges; the sum of two cycles is their symmetric difference. Rows are kept
//! as they come out of the elimination, each with a leading column of its own, and are not reduced any further: the cycles
//! of chains and lattices then stay short, which keeps the work near-linear. Rows that fill up are stored as bits.

/// A growing set of independent vectors over GF(2).
#[derive(Debug)]
pub(super) struct Eliminator {
    /// The row whose largest column is the index.
    rows: Vec<Option<Row>>,
    rank: usize,
    work: BitTree,
}

#[derive(Debug)]
enum Row {
    Sparse(Vec<u32>),
    /// Words of 64 columns, without trailing zero words.
    Dense(Vec<u64>),
}

impl Eliminator {
    /// For vectors with this many columns.
    pub(super) fn new(columns: usize) -> Self {
        Self {
            rows: (0..columns).map(|_| None).collect(),
            rank: 0,
            work: BitTree::new(columns),
        }
    }

    pub(super) fn rank(&self) -> usize {
        self.rank
    }

    /// Adds the vector with ones at `columns` (a column given twice cancels). Returns whether it was independent of those
    /// before; if not, nothing changes.
    pub(super) fn insert(&mut self, columns: impl IntoIterator<Item = u32>) -> bool {
        for column in columns {
            self.work.toggle(column as usize);
        }
        while let Some(leading) = self.work.max() {
            match &self.rows[leading] {
                Some(Row::Sparse(row)) => {
                    for &column in row {
                        self.work.toggle(column as usize);
                    }
                }
                Some(Row::Dense(words)) => self.work.toggle_words(words),
                None => {
                    self.rows[leading] = Some(self.take_row());
                    self.rank += 1;
                    return true;
                }
            }
        }
        false
    }

    fn take_row(&mut self) -> Row {
        let columns = self.work.drain();
        // Bits take less room than indices from one column in 32 on.
        if columns.len() * 32 < self.rows.len() {
            return Row::Sparse(columns);
        }
        let highest = columns.first().map_or(0, |&c| c as usize);
        let mut words = vec![0; highest / 64 + 1];
        for column in columns {
            words[column as usize / 64] |= 1 << (column % 64);
        }
        Row::Dense(words)
    }

    /// A basis of the vectors that have an even number of ones in common with every vector inserted: one for each column
    /// that leads no row, as ascending lists of columns.
    ///
    /// # Complexity
    /// One pass over the stored rows for each 64 vectors.
    pub(super) fn annihilators(&self) -> Vec<Vec<u32>> {
        let free: Vec<usize> = (0..self.rows.len())
            .filter(|&column| self.rows[column].is_none())
            .collect();
        let mut result = Vec::with_capacity(free.len());
        for group in free.chunks(64) {
            let mut value = vec![0_u64; self.rows.len()];
            for (bit, &column) in group.iter().enumerate() {
                value[column] = 1 << bit;
            }
            // The leading column is the largest of its row, so ascending order meets only values already known.
            for (leading, row) in self.rows.iter().enumerate() {
                let Some(row) = row else { continue };
                let sum = row.columns().fold(0, |sum, column| sum ^ value[column]);
                value[leading] = sum;
            }
            for bit in 0..group.len() {
                let ones = (0_u32..).zip(&value);
                result.push(
                    ones.filter(|(_, word)| *word >> bit & 1 == 1)
                        .map(|(column, _)| column)
                        .collect(),
                );
            }
        }
        result
    }
}

impl Row {
    fn columns(&self) -> Box<dyn Iterator<Item = usize> + '_> {
        match self {
            Self::Sparse(columns) => Box::new(columns.iter().map(|&c| c as usize)),
            Self::Dense(words) => Box::new(words.iter().enumerate().flat_map(|(index, &word)| {
                (0..64)
                    .filter(move |bit| word >> bit & 1 == 1)
                    .map(move |bit| index * 64 + bit)
            })),
        }
    }
}

/// A bit set that knows its largest member: every level holds one bit for each word of the level below.
#[derive(Debug)]
struct BitTree {
    levels: Vec<Vec<u64>>,
}

impl BitTree {
    fn new(bits: usize) -> Self {
        let mut levels = vec![vec![0; bits.div_ceil(64).max(1)]];
        while let Some(words) = levels.last().map(Vec::len).filter(|&words| words > 1) {
            levels.push(vec![0; words.div_ceil(64)]);
        }
        Self { levels }
    }

    fn toggle(&mut self, bit: usize) {
        self.toggle_mask(bit / 64, 1 << (bit % 64));
    }

    fn toggle_words(&mut self, words: &[u64]) {
        for (index, &mask) in words.iter().enumerate() {
            if mask != 0 {
                self.toggle_mask(index, mask);
            }
        }
    }

    fn toggle_mask(&mut self, mut index: usize, mut mask: u64) {
        for level in &mut self.levels {
            let before = level[index];
            level[index] ^= mask;
            if (before == 0) == (level[index] == 0) {
                return;
            }
            mask = 1 << (index % 64);
            index /= 64;
        }
    }

    fn max(&self) -> Option<usize> {
        let mut index = 0;
        for level in self.levels.iter().rev() {
            let bit = level[index].checked_ilog2()?;
            index = index * 64 + bit as usize;
        }
        Some(index)
    }

    /// Empties the set and returns its members, largest first.
    fn drain(&mut self) -> Vec<u32> {
        let mut members = Vec::new();
        while let Some(largest) = self.max() {
            self.toggle(largest);
            members.push(u32::try_from(largest).unwrap_or(u32::MAX));
        }
        members
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn small_system() {
        let mut rows = Eliminator::new(4);
        assert!(rows.insert([0, 1]));
        assert!(rows.insert([1, 2]));
        assert!(!rows.insert([0, 2]));
        assert!(!rows.insert([3, 3]));
        assert_eq!(rows.rank(), 2);
        assert_eq!(rows.annihilators(), [vec![0, 1, 2], vec![3]]);
    }

    proptest! {
        /// Rank against dense elimination on 128-bit words; annihilators against their definition.
        #[test]
        fn agrees_with_dense_elimination(
            columns in 1_u32..120,
            vectors in prop::collection::vec(prop::collection::vec(0_u32..120, 0..12), 0..60),
        ) {
            let vectors: Vec<Vec<u32>> = vectors
                .into_iter()
                .map(|v| v.into_iter().map(|c| c % columns).collect())
                .collect();
            let mut sparse = Eliminator::new(columns as usize);
            let mut dense: Vec<u128> = Vec::new();
            for vector in &vectors {
                let mut bits = vector.iter().fold(0_u128, |bits, c| bits ^ (1 << c));
                for row in &dense {
                    bits = bits.min(bits ^ row);
                }
                prop_assert_eq!(sparse.insert(vector.iter().copied()), bits != 0);
                if bits != 0 {
                    dense.push(bits);
                }
            }
            prop_assert_eq!(sparse.rank(), dense.len());
            let annihilators = sparse.annihilators();
            prop_assert_eq!(annihilators.len() + sparse.rank(), columns as usize);
            let mut independent = Eliminator::new(columns as usize);
            for annihilator in annihilators {
                for vector in &vectors {
                    let common = vector.iter().filter(|c| annihilator.contains(c)).count();
                    prop_assert_eq!(common % 2, 0);
                }
                prop_assert!(independent.insert(annihilator));
            }
        }
    }
}
