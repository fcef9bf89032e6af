//! Groebner bases: the usual test systems cyclic-6 and katsura-7, and loops from `tests/thesis/systems.json`.
//!
//! ```text
//! cargo bench -p kutzbach-benches --bench algebra
//! ```

#![allow(clippy::unwrap_used)]

use divan::{Bencher, black_box};
use kutzbach::algebra::{Budget, MonomialOrder, Polynomial, groebner_basis};
use polycore::{Order, Ring};
use serde_json::Value;

fn main() {
    divan::main();
}

/// Equations and the number of their variables.
type System = (Vec<Polynomial>, usize);

/// Cyclic roots of order n (Björck and Fröberg 1991): the elementary sums of neighbours.
fn cyclic(n: usize) -> System {
    let x = |i: usize| Polynomial::variable(i % n, n);
    let product = |start: usize, length: usize| {
        (start..start + length).fold(Polynomial::one(n), |product, i| &product * &x(i))
    };
    let sums = (1..n).map(|length| {
        (0..n).fold(Polynomial::zero(n), |sum, start| {
            &sum + &product(start, length)
        })
    });
    let mut equations: Vec<Polynomial> = sums.collect();
    equations.push(&product(0, n) - &Polynomial::one(n));
    (equations, n)
}

/// Katsura's magnets (Katsura 1990): n + 1 unknowns u_0 ... u_n, symmetric about 0.
fn katsura(n: i64) -> System {
    let variables = n as usize + 1;
    let u = |i: i64| match i.unsigned_abs() as usize {
        i if i < variables => Polynomial::variable(i, variables),
        _ => Polynomial::zero(variables),
    };
    let total = |term: &dyn Fn(i64) -> Polynomial| {
        (-n..=n).fold(Polynomial::zero(variables), |sum, l| &sum + &term(l))
    };
    let mut equations: Vec<Polynomial> = (0..n)
        .map(|m| &total(&|l| &u(l) * &u(m - l)) - &u(m))
        .collect();
    equations.push(&total(&u) - &Polynomial::one(variables));
    (equations, variables)
}

/// The system of this name.
fn linkage(name: &str) -> System {
    let data: Value = serde_json::from_str(include_str!("../tests/thesis/systems.json")).unwrap();
    let found = data.as_array().unwrap().iter().find(|s| s["name"] == name);
    let system = found.unwrap();
    let strings = |value: &Value| -> Vec<String> {
        let items = value.as_array().unwrap().iter();
        items.map(|s| s.as_str().unwrap().to_owned()).collect()
    };
    let names = strings(&system["variables"]);
    let variables = names.len();
    let ring = Ring::new(names, Order::GRevLex);
    let polynomial = |text: &String| {
        let parsed = ring.parse(text).unwrap();
        let terms = parsed.terms.iter();
        let terms = terms.map(|(m, c)| (m.exps().to_vec(), c.clone())).collect();
        Polynomial::from_terms(terms, variables)
    };
    let texts = strings(&system["polynomials"]);
    (texts.iter().map(polynomial).collect(), variables)
}

fn run(bencher: Bencher, (equations, variables): System, order: &MonomialOrder) {
    bencher.bench_local(|| {
        let budget = Budget::unlimited();
        groebner_basis(black_box(&equations), variables, order, &budget).unwrap()
    });
}

#[divan::bench(sample_count = 20)]
fn cyclic_6(bencher: Bencher) {
    run(bencher, cyclic(6), &MonomialOrder::Degrevlex);
}

#[divan::bench(sample_count = 10)]
fn katsura_7(bencher: Bencher) {
    run(bencher, katsura(7), &MonomialOrder::Degrevlex);
}

#[divan::bench(args = [
    "Bennett genuine 4:3",
    "5R Goldberg",
    "6R Bricard threefold (a=1)",
    "6R generic (16 solutions expected)",
    "CT can brute (5.7)",
], sample_count = 20)]
fn degrevlex(bencher: Bencher, name: &str) {
    run(bencher, linkage(name), &MonomialOrder::Degrevlex);
}

#[divan::bench(args = [
    "Bennett genuine 4:3",
    "6R Bricard threefold (a=1)",
    "CT can brute (5.7)",
], sample_count = 20)]
fn lexicographic(bencher: Bencher, name: &str) {
    run(bencher, linkage(name), &MonomialOrder::Lexicographic);
}
