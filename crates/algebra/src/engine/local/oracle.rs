//! Two hundred germs as another program computes them.

use super::*;
use crate::components::{Hints, components};
use crate::engine::testing::parse;

/// Equations, and what is known of the origin.
struct Known {
    text: &'static str,
    equations: Vec<Polynomial>,
    dimension: usize,
    multiplicity: usize,
    /// Dimensions of the minimal primes through it, falling.
    primes: Vec<usize>,
}

fn known() -> Vec<Known> {
    let lines = include_str!("germs.txt").lines();
    let germ = |line: &'static str| {
        let [text, dimension, multiplicity, primes] =
            line.split('|').map(str::trim).collect::<Vec<_>>()[..]
        else {
            panic!("{line}");
        };
        Known {
            text,
            equations: text.split(',').map(parse).collect(),
            dimension: dimension.parse().unwrap(),
            multiplicity: multiplicity.parse().unwrap(),
            primes: primes.split(' ').map(|d| d.parse().unwrap()).collect(),
        }
    };
    lines
        .filter(|line| !line.starts_with('#'))
        .map(germ)
        .collect()
}

fn origin() -> [Rational; 3] {
    [0; 3].map(|_| Rational::zero())
}

#[test]
fn dimension_and_multiplicity_are_those_of_singular() {
    let all = known();
    assert_eq!(all.len(), 200);
    for germ in all {
        let ring = local_dimension(&germ.equations, &origin(), &Budget::unlimited());
        let ring = ring.unwrap().unwrap();
        let found = (ring.dimension, ring.multiplicity);
        assert_eq!(
            found,
            (germ.dimension, Some(germ.multiplicity)),
            "{}",
            germ.text
        );
    }
}

#[test]
fn minimal_primes_are_those_of_singular() {
    let mut open = 0;
    for germ in known() {
        let budget = Budget::new(super::super::Limits {
            work: Some(20_000_000),
            ..super::super::Limits::default()
        });
        let found = components(&germ.equations, 3, &Hints::default(), &budget).unwrap();
        if !found.complete {
            open += 1;
            continue;
        }
        let here = |p: &Polynomial| p.value_at(&origin()).is_zero();
        let through = found.pieces.iter().filter(|c| c.contains_point(&here));
        let mut dimensions: Vec<usize> = through.map(|c| c.dimension).collect();
        dimensions.sort_unstable_by(|a, b| b.cmp(a));
        assert_eq!(dimensions, germ.primes, "{}", germ.text);
    }
    println!("{open} open");
    assert!(open <= 10, "{open}");
}
