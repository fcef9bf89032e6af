//! An answer read in the names of its source, and what can be asserted of it.

use kutzbach::algebra::{
    Budget, ExactAnswer, ExactOptions, Formulation, Limits, MonomialOrder, Polynomial,
    SystemOptions, eliminate, exact_answer, groebner_basis,
};
use kutzbach::format::{Reading, read_file};
use num_traits::ToPrimitive;
use polycore::{Order, Ring};
use serde_json::Value;
use std::path::Path;

/// Generous: a slow machine must not fail a test of mathematics.
pub fn budget() -> Budget {
    Budget::new(Limits::seconds(300.0))
}

fn read(file: &str, settings: &[(&str, &str)]) -> Reading {
    let settings: Vec<(String, String)> = settings
        .iter()
        .map(|(name, value)| ((*name).to_owned(), (*value).to_owned()))
        .collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    read_file(&path, &settings).unwrap()
}

pub fn answer_with(file: &str, settings: &[(&str, &str)], formulation: Formulation) -> ExactAnswer {
    let options = ExactOptions {
        system: SystemOptions {
            formulation,
            unoriented: formulation == Formulation::Positional,
            ..SystemOptions::default()
        },
        ..ExactOptions::default()
    };
    let mechanism = read(file, settings).mechanism;
    let answer = exact_answer(&mechanism, &options, &budget()).unwrap();
    assert_eq!(answer.stopped, None, "{file}");
    answer
}

pub fn canonical(file: &str) -> ExactAnswer {
    answer_with(file, &[], Formulation::Canonical)
}

pub fn positional(file: &str) -> ExactAnswer {
    answer_with(file, &[], Formulation::Positional)
}

/// Dimension and number of pieces, all of which must be proven irreducible.
pub fn shape(answer: &ExactAnswer) -> (Option<usize>, usize) {
    assert!(answer.decomposed);
    (answer.dimension.unwrap(), answer.pieces.len())
}

/// An answer whose unknowns have the names of the source.
pub struct Row {
    pub answer: ExactAnswer,
    /// The name here, with a minus sign where the source counts the other way, of a name of the source.
    renamed: fn(&str) -> String,
}

impl Row {
    pub fn new(answer: ExactAnswer, renamed: fn(&str) -> String) -> Self {
        Self { answer, renamed }
    }

    /// A variable of the source among those here: its index, and whether it has the other sign.
    fn variable(&self, name: &str) -> (usize, bool) {
        let text = (self.renamed)(name);
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.as_str()),
        };
        let found = self.answer.system.names().iter().position(|n| n == text);
        (found.unwrap_or_else(|| panic!("{name}: {text}")), negative)
    }

    /// A polynomial in the variables of the source.
    fn polynomial(&self, text: &str, variables: &[String]) -> Polynomial {
        let ring = Ring::new(variables.to_vec(), Order::Lex);
        let parsed = ring.parse(text).unwrap();
        let terms = parsed.terms.iter();
        let terms = terms.map(|(m, c)| (m.exps().to_vec(), c.clone())).collect();
        let replacements: Vec<Polynomial> = variables
            .iter()
            .map(|name| {
                let (index, negative) = self.variable(name);
                let variable = Polynomial::variable(index, self.answer.system.variables.len());
                if negative { -&variable } else { variable }
            })
            .collect();
        Polynomial::from_terms(terms, variables.len()).substitute(&replacements)
    }

    /// Equations that follow from those of the mechanism: their normal form is zero.
    pub fn follows(&self, relations: &[&str]) {
        let basis = self.answer.basis.as_ref().unwrap();
        for text in relations {
            let mut names: Vec<String> = text
                .split(|c: char| !c.is_alphanumeric() && c != '_')
                .filter(|word| word.starts_with(char::is_alphabetic))
                .map(str::to_owned)
                .collect();
            names.sort();
            names.dedup();
            assert!(basis.contains(&self.polynomial(text, &names)), "{text}");
        }
    }

    /// Variables that can be given any values together, as many as the dimension: no equation in them alone follows.
    pub fn free(&self, names: &[&str]) {
        let kept: Vec<usize> = names.iter().map(|name| self.variable(name).0).collect();
        assert_eq!(self.answer.dimension, Some(Some(kept.len())), "{names:?}");
        let basis = self.answer.basis.as_ref().unwrap();
        let others: Vec<usize> = (0..basis.variables())
            .filter(|v| !kept.contains(v))
            .collect();
        let left = eliminate(basis.polynomials(), basis.variables(), &others, &budget()).unwrap();
        assert!(left.iter().all(Polynomial::is_zero), "{names:?}: {left:?}");
    }

    /// Exactly these variables are fixed, at these values.
    pub fn fixed(&self, expected: &[(&str, &[f64])]) {
        let mut expected: Vec<(usize, Vec<f64>)> = expected
            .iter()
            .map(|(name, values)| {
                let (index, negative) = self.variable(name);
                let sign = if negative { -1.0 } else { 1.0 };
                let mut values: Vec<f64> = values.iter().map(|x| sign * x).collect();
                values.sort_by(f64::total_cmp);
                (index, values)
            })
            .collect();
        expected.sort_by_key(|(index, _)| *index);
        let found: Vec<(usize, Vec<f64>)> = self
            .answer
            .fixed
            .iter()
            .map(|f| {
                // Every root of the polynomial is real and one of these.
                if let Some(polynomial) = &f.polynomial {
                    assert_eq!(polynomial.degree() as usize, f.values.len());
                }
                let middle = f.values.iter().map(|v| v.middle().to_f64().unwrap());
                // Enclosed to 64 bits; nothing here has a finer denominator than 5.
                (
                    f.variable,
                    middle.map(|x| (x * 5.0).round() / 5.0).collect(),
                )
            })
            .collect();
        assert_eq!(found, expected);
    }

    /// The equations of the mechanism and those of a system of the source generate one ideal.
    pub fn is(&self, name: &str) {
        let data: Value = serde_json::from_str(include_str!("systems.json")).unwrap();
        let mut systems = data.as_array().unwrap().iter();
        let data = systems.find(|s| s["name"] == name).unwrap();
        let strings = |value: &Value| -> Vec<String> {
            let items = value.as_array().unwrap().iter();
            items.map(|s| s.as_str().unwrap().to_owned()).collect()
        };
        let variables = strings(&data["variables"]);
        let known = &data[if data["lex_basis"].is_array() {
            "lex_basis"
        } else {
            "polynomials"
        }];
        let known: Vec<Polynomial> = strings(known)
            .iter()
            .map(|text| self.polynomial(text, &variables))
            .collect();
        let basis = self.answer.basis.as_ref().unwrap();
        for polynomial in &known {
            assert!(basis.contains(polynomial), "{name}: {polynomial:?}");
        }
        let order = MonomialOrder::Degrevlex;
        let known = groebner_basis(&known, basis.variables(), &order, &budget()).unwrap();
        for equation in self.answer.system.polynomials() {
            assert!(known.contains(&equation), "{name}: {equation:?}");
        }
    }
}

/// Entries of one body's matrix: `x23`, `Ty`.
pub fn of_the_plug(name: &str) -> String {
    format!("{name}(plug)")
}

pub fn of_the_block(name: &str) -> String {
    format!("{name}(block)")
}

/// Entries of the bodies' matrices: `D3_24` is in row 2, column 4 of body 3.
pub fn of_bodies(name: &str) -> String {
    let [_, body, _, row, column] = *name.as_bytes() else {
        panic!("{name}");
    };
    let body = char::from(body);
    match column {
        b'4' => format!("T{}(B{body})", ["x", "y", "z"][usize::from(row - b'1')]),
        _ => format!("x{}{}(B{body})", char::from(row), char::from(column)),
    }
}

/// `x3`, `s3`, `c3`: way, sine and cosine of a sleeve whose name ends in its number.
pub fn of_sleeves(letter: &str, name: &str) -> String {
    let (kind, number) = name.split_at(1);
    match kind {
        "x" => format!("{letter}{number}.trans"),
        "s" => format!("sin({letter}{number}.rot)"),
        _ => format!("cos({letter}{number}.rot)"),
    }
}

/// The same where the joint has a single freedom.
pub fn of_simple_joints(name: &str) -> String {
    let (kind, number) = name.split_at(1);
    match kind {
        "x" => format!("R{number}"),
        "s" => format!("sin(R{number})"),
        _ => format!("cos(R{number})"),
    }
}
