//! Systems of polynomials as other programs read them.

use crate::Polynomial;
use std::fmt::Write;

/// A program that reads systems of polynomial equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// A program for Singular: a ring, an ideal `I`, its standard basis, dimension and multiplicity. Comments say what each unknown is.
    Singular,
    /// A file for msolve. It knows no comments: unknowns are those of [`Singular`](Self::Singular), in the same order.
    Msolve,
}

/// The equations `polynomial = 0` for a program. Unknowns are called `x1`, `x2`, …, since names of joints are no names there; `meanings`
/// says what they are, in order. Coefficients are whole numbers.
#[must_use]
pub fn written_for(reader: Reader, meanings: &[String], polynomials: &[Polynomial]) -> String {
    let names: Vec<String> = (1..=meanings.len()).map(|k| format!("x{k}")).collect();
    let whole = polynomials.iter().map(Polynomial::primitive);
    let listed: Vec<String> = whole.map(|p| plain(&p, &names)).collect();
    let (variables, equations) = (names.join(","), listed.join(",\n"));
    match reader {
        Reader::Msolve => format!("{variables}\n0\n{equations}\n"),
        Reader::Singular => {
            let mut text = String::new();
            for (name, meaning) in names.iter().zip(meanings) {
                // Names may hold anything; a comment ends with its line.
                let meaning: String = meaning
                    .chars()
                    .map(|c| if c.is_control() { '?' } else { c })
                    .collect();
                let _ = writeln!(text, "// {name}: {meaning}");
            }
            let _ = writeln!(
                text,
                "ring r = 0,({variables}),dp;\nideal I =\n{equations};\nideal G = std(I);\ndim(G);\nmult(G);"
            );
            text
        }
    }
}

/// A polynomial in the syntax that computer algebra systems share: `3*x1^2*x2-5`.
fn plain(polynomial: &Polynomial, names: &[String]) -> String {
    let mut text = String::new();
    for (exponents, coefficient) in polynomial.terms() {
        let mut factors = Vec::new();
        for (name, &e) in names.iter().zip(exponents) {
            match e {
                0 => {}
                1 => factors.push(name.clone()),
                _ => factors.push(format!("{name}^{e}")),
            }
        }
        let term = match (coefficient.to_string().as_str(), factors.is_empty()) {
            (number, true) => number.to_owned(),
            ("1", false) => factors.join("*"),
            ("-1", false) => format!("-{}", factors.join("*")),
            (number, false) => format!("{number}*{}", factors.join("*")),
        };
        if !text.is_empty() && !term.starts_with('-') {
            text.push('+');
        }
        text.push_str(&term);
    }
    if text.is_empty() {
        text.push('0');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rational;

    #[test]
    fn what_other_programs_read() {
        let half = |n: i64| Rational::new(n.into(), 2.into());
        let terms = vec![
            (vec![2, 0], half(3)),
            (vec![0, 1], half(-1)),
            (vec![0, 0], half(5)),
        ];
        let polynomial = Polynomial::from_terms(terms, 2);
        let meanings = ["turn\nof a".to_owned(), "slide".to_owned()];
        assert_eq!(
            written_for(Reader::Msolve, &meanings, std::slice::from_ref(&polynomial)),
            "x1,x2\n0\n3*x1^2-x2+5\n"
        );
        let text = written_for(Reader::Singular, &meanings, &[polynomial]);
        assert!(text.starts_with(
            "// x1: turn?of a\n// x2: slide\nring r = 0,(x1,x2),dp;\nideal I =\n3*x1^2-x2+5;\n"
        ));
    }
}
