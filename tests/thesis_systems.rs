//! The polynomial systems of O. Ruiz, "Spatial Reasoning for Computer Aided Design, Manufacturing and Process Planning"
//! (University of Illinois, 1994), and some linkages of the literature, against bases computed by an independent system.
//!
//! `thesis/systems.json` holds for every system its variables in lexicographic order (first largest), its polynomials, its
//! dimension (-1: contradictory), the sizes of its bases and, where one is known, its lexicographic basis.

use kutzbach::algebra::{Budget, GroebnerBasis, Limits, MonomialOrder, Polynomial, groebner_basis};
use polycore::{Order, Ring};
use serde_json::Value;
use std::collections::BTreeSet;

/// Seconds for one basis. A lexicographic basis computed directly would need minutes for the loops of five and six joints;
/// computed from degrevlex, none needs more than a second in a release build.
const SECONDS: f64 = 120.0;

struct System {
    name: String,
    variables: Vec<String>,
    polynomials: Vec<Polynomial>,
    data: Value,
}

fn strings(value: &Value) -> Vec<String> {
    let items = value.as_array().unwrap().iter();
    items.map(|s| s.as_str().unwrap().to_owned()).collect()
}

fn parse(texts: &[String], variables: &[String]) -> Vec<Polynomial> {
    let ring = Ring::new(variables.to_vec(), Order::Lex);
    let parsed = texts.iter().map(|text| ring.parse(text).unwrap());
    parsed
        .map(|p| {
            let terms = p.terms.iter();
            let terms = terms.map(|(m, c)| (m.exps().to_vec(), c.clone())).collect();
            Polynomial::from_terms(terms, variables.len())
        })
        .collect()
}

fn systems() -> Vec<System> {
    let data: Value = serde_json::from_str(include_str!("thesis/systems.json")).unwrap();
    let all = data.as_array().unwrap().iter();
    all.map(|data| {
        let variables = strings(&data["variables"]);
        System {
            name: data["name"].as_str().unwrap().to_owned(),
            polynomials: parse(&strings(&data["polynomials"]), &variables),
            variables,
            data: data.clone(),
        }
    })
    .collect()
}

impl System {
    fn basis(&self, order: &MonomialOrder) -> GroebnerBasis {
        let budget = Budget::new(Limits::seconds(SECONDS));
        groebner_basis(&self.polynomials, self.variables.len(), order, &budget)
            .unwrap_or_else(|stop| panic!("{} in {order:?}: {stop}", self.name))
    }

    fn dimension(&self) -> Option<usize> {
        usize::try_from(self.data["dimension"].as_i64().unwrap()).ok()
    }

    fn size(&self, key: &str) -> Option<usize> {
        self.data[key].as_u64().map(|size| size as usize)
    }

    fn check(&self, basis: &GroebnerBasis) {
        let name = &self.name;
        assert_eq!(basis.dimension(), self.dimension(), "{name}");
        assert_eq!(
            basis.is_inconsistent(),
            self.dimension().is_none(),
            "{name}"
        );
        let certificate = basis.certificate();
        assert!(certificate.primes >= 2 && certificate.fresh_prime.is_some());
        for polynomial in &self.polynomials {
            assert!(basis.contains(polynomial), "{name}");
        }
        for set in basis.independent_sets(10) {
            assert_eq!(Some(set.len()), self.dimension(), "{name}");
        }
    }
}

#[test]
fn all_systems_are_there() {
    assert_eq!(systems().len(), 50);
}

#[test]
fn lexicographic_bases_are_the_known_ones() {
    let mut compared = 0;
    for system in systems() {
        let basis = system.basis(&MonomialOrder::Lexicographic);
        system.check(&basis);
        if let Some(size) = system.size("lex_size") {
            assert_eq!(basis.polynomials().len(), size, "{}", system.name);
        }
        if system.data["lex_basis"].is_array() {
            let known = parse(&strings(&system.data["lex_basis"]), &system.variables);
            let texts = |polynomials: &[Polynomial]| -> BTreeSet<String> {
                let primitive = polynomials.iter().map(Polynomial::primitive);
                primitive.map(|p| p.text(&system.variables)).collect()
            };
            assert_eq!(texts(basis.polynomials()), texts(&known), "{}", system.name);
            compared += 1;
        }
    }
    assert_eq!(compared, 47);
}

#[test]
fn solutions_of_the_loop_of_six_joints() {
    let system = systems()
        .into_iter()
        .find(|s| s.name.starts_with("6R generic"))
        .unwrap();
    let basis = system.basis(&MonomialOrder::Degrevlex);
    assert_eq!(basis.degree(), Some(12));
    let budget = Budget::new(Limits::seconds(SECONDS));
    let locked = basis.univariate_in(0, &budget).unwrap().unwrap();
    assert_eq!(locked.degree(), 12);
    assert!(basis.contains(&locked));
}

#[test]
fn the_genuine_bennett_linkage_is_proven() {
    let system = systems()
        .into_iter()
        .find(|s| s.name.starts_with("Bennett genuine"))
        .unwrap();
    let mut basis = system.basis(&MonomialOrder::Degrevlex);
    let budget = Budget::new(Limits::seconds(SECONDS));
    assert_eq!(basis.prove(&system.polynomials, &budget), Ok(true));
    assert!(basis.certificate().proven);
    assert_eq!(basis.dimension(), Some(1));
    assert_eq!(basis.degree(), Some(4));
    assert_eq!(basis.prove(&system.polynomials[..8], &budget), Ok(false));
}

/// Too long for every commit.
mod corpus {
    use super::*;

    #[test]
    #[ignore = "too long for every commit: run by `cargo corpus`, in CI"]
    fn dimensions_and_sizes_in_degrevlex() {
        for system in systems() {
            let basis = system.basis(&MonomialOrder::Degrevlex);
            system.check(&basis);
            let size = system.size("degrevlex_size").unwrap();
            assert_eq!(basis.polynomials().len(), size, "{}", system.name);
        }
    }
}
