//! In which order to eliminate columns, and which rows must be merged for it.
//!
//! Orthogonal elimination of a column couples every row that contains it, so all row blocks that
//! contain the column become one dense *front*, and what is left of the front is a new block over
//! the columns not yet eliminated. The plan depends on the pattern only: one plan serves every
//! precision and every prime.
//!
//! Cost is governed by how many columns a front has. The order is chosen greedily by that number,
//! the *minimum degree* rule on the column graph (two columns are neighbours when a block contains
//! both), with the bound on the degree of Amestoy, Davis and Duff 1996 §3 that needs no union to be
//! formed, on row blocks instead of a symmetric matrix as in COLAMD (Davis, Gilbert, Larimore and
//! Ng 2004 §3). Columns that occur in the same blocks are one unit throughout.
//!
//! Near-linear time where fronts stay small (chains, trees, rings); a k × k lattice gives a largest
//! front of order k columns. Ties fall to the lowest column, so the plan is deterministic.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// One dense step of an elimination.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// Columns that occur in no row outside this front: they leave here.
    pub pivots: Vec<usize>,
    /// The other columns of the front, which a later front takes on.
    pub border: Vec<usize>,
    /// Row blocks of the matrix merged here.
    pub blocks: Vec<usize>,
    /// Earlier fronts whose leftover rows are merged here; each front has at most one successor.
    pub children: Vec<usize>,
}

/// The whole elimination: each column that occurs in a row is a pivot of exactly one front.
#[derive(Clone, Debug, PartialEq)]
pub struct EliminationPlan {
    /// Fronts in an order in which children come first.
    pub fronts: Vec<Front>,
    /// Columns that occur in no block.
    pub empty_columns: Vec<usize>,
}

/// Plans the elimination of a matrix whose block `b` contains the columns `blocks[b]`
/// (each list without repetitions, all below `columns`).
#[must_use]
pub fn plan(columns: usize, blocks: &[Vec<usize>]) -> EliminationPlan {
    let mut blocks_of_column: Vec<Vec<usize>> = vec![Vec::new(); columns];
    for (block, members) in blocks.iter().enumerate() {
        for &column in members {
            blocks_of_column[column].push(block);
        }
    }
    let empty_columns = (0..columns)
        .filter(|&column| blocks_of_column[column].is_empty())
        .collect();
    let (units, elements_of_unit) = group_alike(&blocks_of_column);
    let fronts = QuotientGraph::new(units, elements_of_unit, blocks.len()).eliminate();
    EliminationPlan {
        fronts,
        empty_columns,
    }
}

/// Columns with the same list of blocks become one unit; returns members and blocks of each unit,
/// ordered by their first column.
fn group_alike(blocks_of_column: &[Vec<usize>]) -> (Vec<Vec<usize>>, Vec<Vec<usize>>) {
    let mut order: Vec<usize> = (0..blocks_of_column.len())
        .filter(|&column| !blocks_of_column[column].is_empty())
        .collect();
    order.sort_by(|&a, &b| (&blocks_of_column[a], a).cmp(&(&blocks_of_column[b], b)));
    let mut units: Vec<Vec<usize>> = order
        .chunk_by(|&a, &b| blocks_of_column[a] == blocks_of_column[b])
        .map(<[usize]>::to_vec)
        .collect();
    units.sort_by_key(|unit| unit[0]);
    let elements = units
        .iter()
        .map(|unit| blocks_of_column[unit[0]].clone())
        .collect();
    (units, elements)
}

/// Bipartite graph of column units and elements (row blocks, then leftovers of fronts).
struct QuotientGraph {
    /// Columns of each unit.
    units: Vec<Vec<usize>>,
    /// Live elements that contain the unit.
    elements_of_unit: Vec<Vec<usize>>,
    /// Units of each element. An element dies when a unit of it is eliminated, so all units of a
    /// live element are live.
    units_of_element: Vec<Vec<usize>>,
    /// Number of columns in each element.
    weight_of_element: Vec<usize>,
    /// Elements below this number are row blocks; element `block_count + f` is left by front `f`.
    block_count: usize,
    eliminated: Vec<bool>,
}

impl QuotientGraph {
    fn new(units: Vec<Vec<usize>>, elements_of_unit: Vec<Vec<usize>>, block_count: usize) -> Self {
        let mut units_of_element = vec![Vec::new(); block_count];
        let mut weight_of_element = vec![0; block_count];
        for (unit, elements) in elements_of_unit.iter().enumerate() {
            for &element in elements {
                units_of_element[element].push(unit);
                weight_of_element[element] += units[unit].len();
            }
        }
        Self {
            eliminated: vec![false; units.len()],
            units,
            elements_of_unit,
            units_of_element,
            weight_of_element,
            block_count,
        }
    }

    fn eliminate(mut self) -> Vec<Front> {
        let mut degree: Vec<usize> = self
            .elements_of_unit
            .iter()
            .map(|elements| elements.iter().map(|&e| self.weight_of_element[e]).sum())
            .collect();
        let mut queue: BinaryHeap<Reverse<(usize, usize)>> = degree
            .iter()
            .enumerate()
            .map(|(unit, &degree)| Reverse((degree, unit)))
            .collect();
        let mut fronts = Vec::new();
        // Stamps instead of sets: a unit or element belongs to the current round if its stamp is
        // the number of the round.
        let mut seen_unit = vec![usize::MAX; self.units.len()];
        let mut seen_element = vec![usize::MAX; self.units_of_element.len()];
        let mut outside = vec![0usize; self.units_of_element.len()];
        while let Some(Reverse((key, unit))) = queue.pop() {
            if self.eliminated[unit] || key != degree[unit] {
                continue;
            }
            let round = fronts.len();
            let (front, border_units) = self.merge(unit, round, &mut seen_unit, &mut seen_element);
            let border_weight = front.border.len();
            fronts.push(front);
            let element = self.block_count + round;
            self.units_of_element.push(border_units.clone());
            self.weight_of_element.push(border_weight);
            seen_element.push(usize::MAX);
            outside.push(0);
            // outside[e] becomes the number of columns of e beyond the border.
            for &neighbour in &border_units {
                let weight = self.units[neighbour].len();
                for &e in &self.elements_of_unit[neighbour] {
                    if seen_element[e] != round {
                        seen_element[e] = round;
                        outside[e] = self.weight_of_element[e];
                    }
                    outside[e] -= weight;
                }
            }
            for &neighbour in &border_units {
                let beyond: usize = self.elements_of_unit[neighbour]
                    .iter()
                    .map(|&e| outside[e])
                    .sum();
                self.elements_of_unit[neighbour].push(element);
                degree[neighbour] = border_weight + beyond;
                queue.push(Reverse((degree[neighbour], neighbour)));
            }
        }
        fronts
    }

    /// Merges all elements that contain `unit`; every unit that then occurs nowhere else leaves
    /// with it. Returns the front and the units of its border.
    fn merge(
        &mut self,
        unit: usize,
        round: usize,
        seen_unit: &mut [usize],
        seen_element: &mut [usize],
    ) -> (Front, Vec<usize>) {
        let merged = std::mem::take(&mut self.elements_of_unit[unit]);
        let mut members = Vec::new();
        let (mut blocks, mut children) = (Vec::new(), Vec::new());
        for &element in &merged {
            seen_element[element] = round;
            match element.checked_sub(self.block_count) {
                Some(front) => children.push(front),
                None => blocks.push(element),
            }
            for member in std::mem::take(&mut self.units_of_element[element]) {
                if seen_unit[member] != round {
                    seen_unit[member] = round;
                    members.push(member);
                }
            }
        }
        members.sort_unstable();
        let (mut pivots, mut border, mut border_units) = (Vec::new(), Vec::new(), Vec::new());
        for member in members {
            self.elements_of_unit[member].retain(|&e| seen_element[e] != round);
            if self.elements_of_unit[member].is_empty() {
                self.eliminated[member] = true;
                pivots.extend_from_slice(&self.units[member]);
            } else {
                border.extend_from_slice(&self.units[member]);
                border_units.push(member);
            }
        }
        let front = Front {
            pivots,
            border,
            blocks,
            children,
        };
        (front, border_units)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every promise of [`EliminationPlan`], checked from the definition.
    fn check(columns: usize, blocks: &[Vec<usize>]) -> EliminationPlan {
        let plan = plan(columns, blocks);
        let mut front_of_column = vec![usize::MAX; columns];
        let mut used_blocks = vec![0; blocks.len()];
        let mut used_fronts = vec![0; plan.fronts.len()];
        for (index, front) in plan.fronts.iter().enumerate() {
            assert!(!front.pivots.is_empty());
            for &column in &front.pivots {
                assert_eq!(front_of_column[column], usize::MAX, "pivot twice");
                front_of_column[column] = index;
            }
            let mut expected: Vec<usize> = Vec::new();
            for &block in &front.blocks {
                used_blocks[block] += 1;
                expected.extend(&blocks[block]);
            }
            for &child in &front.children {
                assert!(child < index);
                used_fronts[child] += 1;
                expected.extend(&plan.fronts[child].border);
            }
            expected.sort_unstable();
            expected.dedup();
            let mut found = [&front.pivots[..], &front.border[..]].concat();
            found.sort_unstable();
            assert_eq!(found, expected, "columns of front {index}");
        }
        for &column in &plan.empty_columns {
            assert_eq!(front_of_column[column], usize::MAX);
            front_of_column[column] = 0;
        }
        assert!(front_of_column.iter().all(|&front| front != usize::MAX));
        for (block, members) in blocks.iter().enumerate() {
            assert_eq!(used_blocks[block], usize::from(!members.is_empty()));
        }
        for (front, used) in used_fronts.iter().enumerate() {
            assert_eq!(*used, usize::from(!plan.fronts[front].border.is_empty()));
        }
        for (index, front) in plan.fronts.iter().enumerate() {
            for &column in &front.border {
                assert!(front_of_column[column] > index, "border leaves later");
            }
        }
        plan
    }

    #[test]
    fn degenerate_patterns() {
        assert!(check(0, &[]).fronts.is_empty());
        assert_eq!(check(3, &[]).empty_columns, [0, 1, 2]);
        assert_eq!(check(3, &[vec![], vec![1], vec![]]).empty_columns, [0, 2]);
        assert_eq!(check(4, &[vec![0, 1, 2, 3]]).fronts.len(), 1);
    }

    #[test]
    fn a_chain_keeps_its_fronts_small() {
        // block i: |own, own, shared with i+1|, as the loops of a scissor lift
        let blocks: Vec<Vec<usize>> = (0..500)
            .map(|i| {
                let mut block = vec![3 * i, 3 * i + 1, 3 * i + 2];
                if i > 0 {
                    block.push(3 * i - 1);
                }
                block
            })
            .collect();
        let plan = check(1500, &blocks);
        let widest = plan.fronts.iter().map(|f| f.pivots.len() + f.border.len());
        assert!(widest.max().is_some_and(|width| width <= 5));
    }

    #[test]
    fn a_lattice_has_fronts_of_its_own_width() {
        let side = 30;
        let plan = check(2 * side * (side - 1), &lattice(side));
        let widest = plan.fronts.iter().map(|f| f.pivots.len() + f.border.len());
        let widest = widest.max().unwrap_or(0);
        assert!(widest <= 4 * side, "widest front {widest}");
    }

    /// Squares of a lattice of `side` × `side` nodes; each contains its four edges.
    fn lattice(side: usize) -> Vec<Vec<usize>> {
        let across = |row: usize, column: usize| row * (side - 1) + column;
        let down = |row: usize, column: usize| side * (side - 1) + row * side + column;
        let mut blocks = Vec::new();
        for row in 0..side - 1 {
            for column in 0..side - 1 {
                blocks.push(vec![
                    across(row, column),
                    across(row + 1, column),
                    down(row, column),
                    down(row, column + 1),
                ]);
            }
        }
        blocks
    }
}
