//! A basis of cycles whose equations are few.

use super::bodies::Between;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Networks of more members keep the cycles they have: sets of members are bits of a number.
pub const MOST_MEMBERS: usize = 64;

/// The cycles that the trees of fewest members from every body close (Horton 1987), each once. They hold a basis of fewest members; which
/// of them asks for the fewest equations, greed finds, since independent sets of cycles are a matroid.
pub fn candidates(between: &[Between], bodies: usize) -> Vec<Vec<usize>> {
    let mut at: Vec<Vec<usize>> = vec![Vec::new(); bodies];
    for (number, member) in between.iter().enumerate() {
        for end in member.ends {
            at[end].push(number);
        }
    }
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for root in 0..bodies {
        let (way, in_tree) = ways_from(root, between, &at);
        for (number, member) in between.iter().enumerate() {
            if in_tree.contains(&number) {
                continue;
            }
            let [Some(one), Some(two)] = member.ends.map(|end| way.get(&end)) else {
                continue;
            };
            let common = one.iter().zip(two).take_while(|(a, b)| a == b).count();
            let mut cycle: Vec<usize> = one[common..].iter().rev().copied().collect();
            cycle.extend(&two[common..]);
            cycle.push(number);
            from_the_first(&mut cycle);
            if seen.insert(bits(&cycle)) {
                found.push(cycle);
            }
        }
    }
    found
}

/// Begins a cycle with its first member, towards the smaller of the two next to it, so that it is told in one way.
fn from_the_first(cycle: &mut [usize]) {
    let first = (0..cycle.len()).min_by_key(|place| cycle[*place]);
    cycle.rotate_left(first.unwrap_or(0));
    if cycle.len() > 2 && cycle[cycle.len() - 1] < cycle[1] {
        cycle[1..].reverse();
    }
}

/// The members on the way from a body to each other, and all of them.
fn ways_from(
    root: usize,
    between: &[Between],
    at: &[Vec<usize>],
) -> (BTreeMap<usize, Vec<usize>>, BTreeSet<usize>) {
    let mut way = BTreeMap::from([(root, Vec::new())]);
    let mut in_tree = BTreeSet::new();
    let mut queue = VecDeque::from([root]);
    while let Some(body) = queue.pop_front() {
        for &number in &at[body] {
            let [a, b] = between[number].ends;
            let next = if a == body { b } else { a };
            if way.contains_key(&next) {
                continue;
            }
            let mut longer = way[&body].clone();
            longer.push(number);
            way.insert(next, longer);
            in_tree.insert(number);
            queue.push_back(next);
        }
    }
    (way, in_tree)
}

/// Of some cycles in order, those independent of the ones before, at most `wanted`.
pub fn independent(cycles: Vec<Vec<usize>>, wanted: usize) -> Vec<Vec<usize>> {
    let mut reduced: Vec<u64> = Vec::new();
    let mut basis = Vec::new();
    for cycle in cycles {
        if basis.len() == wanted {
            break;
        }
        // Whichever is smaller has lost the leading bit that both had.
        let rest = reduced
            .iter()
            .fold(bits(&cycle), |rest, row| rest.min(rest ^ row));
        if rest != 0 {
            reduced.push(rest);
            reduced.sort_unstable_by(|a, b| b.cmp(a));
            basis.push(cycle);
        }
    }
    basis
}

/// The number of independent cycles.
pub fn rank(between: &[Between], bodies: usize) -> usize {
    let mut of: Vec<usize> = (0..bodies).collect();
    let mut cycles = 0;
    for member in between {
        let [a, b] = member.ends.map(|end| root(&mut of, end));
        if a == b {
            cycles += 1;
        } else {
            of[a] = b;
        }
    }
    cycles
}

/// The representative of a body's set, with the way to it shortened.
pub fn root(of: &mut [usize], mut body: usize) -> usize {
    while of[body] != body {
        of[body] = of[of[body]];
        body = of[body];
    }
    body
}

fn bits(cycle: &[usize]) -> u64 {
    cycle.iter().fold(0, |bits, member| bits | 1 << member)
}
