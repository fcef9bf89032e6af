//! Components of the published systems: how many pieces the solution set of each has, their dimensions and real points.
//!
//! The systems and the published facts are those of Ruiz (1994), chapters 3 to 7, with the errata that came out since; the
//! linkages after those are classical.

use kutzbach::algebra::{
    Budget, Component, Decomposition, FinitePoints, Hints, Irreducible, MonomialOrder, Polynomial,
    Rational, RealPoints, RealSolution, components, groebner_basis,
};
use serde_json::Value;

struct System {
    variables: Vec<String>,
    equations: Vec<Polynomial>,
}

impl System {
    fn new(variables: &[&str], equations: &[&str]) -> Self {
        let variables: Vec<String> = variables.iter().map(|&v| v.to_owned()).collect();
        Self {
            equations: equations.iter().map(|e| parse(e, &variables)).collect(),
            variables,
        }
    }

    fn published(name: &str) -> Self {
        let text = include_str!("thesis/systems.json");
        let all: Vec<Value> = serde_json::from_str(text).unwrap();
        let found = all.iter().find(|s| s["name"] == name);
        let system = found.unwrap_or_else(|| panic!("no system {name}"));
        let strings = |key: &str| -> Vec<&str> {
            let values = system[key].as_array().unwrap();
            values.iter().map(|v| v.as_str().unwrap()).collect()
        };
        Self::new(&strings("variables"), &strings("polynomials"))
    }

    /// `c..` and `s..` with the same rest are cosine and sine.
    fn hints(&self) -> Hints {
        let place = |name: String| self.variables.iter().position(|v| *v == name);
        let angles = self.variables.iter().enumerate().filter_map(|(c, name)| {
            let rest = name.strip_prefix('c')?;
            Some((c, place(format!("s{rest}"))?))
        });
        Hints {
            angles: angles.collect(),
            ..Hints::default()
        }
    }

    fn decompose(&self) -> Decomposition {
        let budget = Budget::unlimited();
        components(
            &self.equations,
            self.variables.len(),
            &self.hints(),
            &budget,
        )
        .unwrap()
    }

    fn names(&self, indices: &[usize]) -> Vec<&str> {
        indices
            .iter()
            .map(|&i| self.variables[i].as_str())
            .collect()
    }
}

/// Sums of products of integers, fractions and variables with exponents; no parentheses.
fn parse(text: &str, names: &[String]) -> Polynomial {
    let n = names.len();
    let number = |text: &str| -> Rational { text.parse().unwrap() };
    let factor = |text: &str| {
        let (base, exponent) = text.split_once('^').unwrap_or((text, "1"));
        let value = match names.iter().position(|name| name == base) {
            Some(index) => Polynomial::variable(index, n),
            None => Polynomial::constant(number(base), n),
        };
        value.power(exponent.parse().unwrap())
    };
    let spaced = text.replace(' ', "").replace('-', "+-");
    let terms = spaced.split('+').filter(|term| !term.is_empty());
    terms.fold(Polynomial::zero(n), |sum, term| {
        let (sign, body) = term.strip_prefix('-').map_or((1, term), |body| (-1, body));
        let product = body
            .split('*')
            .fold(Polynomial::integer(sign, n), |p, text| &p * &factor(text));
        &sum + &product
    })
}

/// Decomposes and checks what must hold for every decomposition that ended: pieces are proven irreducible, all equations
/// hold on each, and none is contained in another of the same dimension.
fn checked(name: &str, system: &System) -> Vec<Component> {
    let found = system.decompose();
    assert!(found.complete, "{name}: {:?}", found.why);
    let n = system.variables.len();
    for (i, piece) in found.pieces.iter().enumerate() {
        assert_eq!(piece.irreducible, Irreducible::Yes, "{name}");
        assert_eq!(piece.free.len(), piece.dimension, "{name}");
        let basis = groebner_basis(
            &piece.equations,
            n,
            &MonomialOrder::Degrevlex,
            &Budget::unlimited(),
        )
        .unwrap();
        assert_eq!(
            basis.polynomials(),
            piece.equations,
            "{name}: a reduced basis"
        );
        assert_eq!(basis.dimension(), Some(piece.dimension), "{name}");
        assert_eq!(basis.degree(), piece.degree, "{name}");
        for equation in &system.equations {
            assert!(basis.contains(equation), "{name}");
        }
        for other in &found.pieces[i + 1..] {
            assert_ne!(piece.equations, other.equations, "{name}");
        }
    }
    found.pieces
}

/// Name, dimension of every piece, number of pieces, and the degree of each.
const PUBLISHED: &[(&str, usize, &[usize])] = &[
    ("Ex1/DPH nc 1 line (3.9)", 2, &[2, 2]),
    ("Ex1/DPH nc 2 lines (3.11)", 1, &[1, 1]),
    ("Ex1/DPH nc +P1onP3 (3.12)", 0, &[1, 1]),
    ("Ex1/DPH canonical (4.12)", 1, &[1]),
    ("Ex2 non-canonical (4.13)", 2, &[2, 2, 2, 2]),
    ("Ex2 canonical (4.16)", 2, &[2]),
    ("BC nc brute", 0, &[1, 1, 1, 1]),
    ("T&T nc C1-C5-C6", 2, &[2, 2, 2, 2]),
    ("T&T[C3//x] nc brute", 2, &[2, 2, 2, 2]),
    ("T&T[C3//x] can brute", 2, &[2]),
    ("T&T[C3//z] nc brute", 2, &[2, 2]),
    ("T&T[C3//z] can brute", 2, &[2]),
    ("CT can brute (5.7)", 3, &[1, 1, 1, 1, 1, 1, 1, 1]),
    ("CT II full graph (branch of T5.4)", 3, &[1, 1]),
    ("Oldham (7.5)", 1, &[2]),
    ("Oldham var1 (7.6)", 1, &[2]),
    ("Oldham var2 (7.7)", 2, &[2]),
    ("Oldham var3 (7.8)", 1, &[1, 1]),
    ("4R thesis 'Bennett' (7.11)", 1, &[2, 2]),
    ("4R structure (7.12)", 0, &[1, 1]),
    ("4R coaxial link (7.13)", 1, &[2]),
];

#[test]
fn published_systems_have_the_published_numbers_of_components() {
    for &(name, dimension, degrees) in PUBLISHED {
        let pieces = checked(name, &System::published(name));
        let found: Vec<usize> = pieces.iter().map(|p| p.degree.unwrap()).collect();
        assert_eq!(found, degrees, "{name}");
        assert!(pieces.iter().all(|p| p.dimension == dimension), "{name}");
        for piece in pieces {
            let real = match dimension {
                0 => RealPoints::Finite(1),
                _ => RealPoints::FullDimension,
            };
            assert_eq!(piece.real, real, "{name}");
        }
    }
}

#[test]
fn contradictions_have_no_components() {
    for name in [
        "Ex1/DPH nc +P2onP4 (3.13)",
        "Oldham L12 wrong",
        "5R generic (no mobility)",
    ] {
        assert!(checked(name, &System::published(name)).is_empty());
    }
}

/// The Cartesian table moves along z4, y7 and z7 in each of its eight assembly modes; the Oldham coupling turns.
#[test]
fn free_variables_are_the_published_ones() {
    for (name, free) in [
        ("Ex1/DPH nc 2 lines (3.11)", &["Tx"][..]),
        ("Ex1/DPH canonical (4.12)", &["x2"]),
        ("CT can brute (5.7)", &["z4", "y7", "z7"]),
        ("Oldham var2 (7.7)", &["x4", "c4"]),
    ] {
        let system = System::published(name);
        for piece in checked(name, &system) {
            assert_eq!(system.names(&piece.free), free, "{name}");
        }
    }
}

/// Linkages and their modes.
///
/// - Bennett: one irreducible curve of degree 4, whichever way its lengths and twists are proportioned;
/// - planar parallelogram: it opens as a parallelogram, a conic, or crosses over into an antiparallelogram, a curve of
///   degree 4;
/// - planar rhombus: the antiparallelogram falls apart into the two modes in which two links lie on one another;
/// - spherical 4R with no special lengths: one curve of degree 8;
/// - Goldberg 5R: one curve; Bricard's threefold and trihedral linkages: one curve each over the rationals.
#[test]
fn linkages_have_their_modes() {
    for (name, degrees) in [
        ("Bennett genuine 4:3", &[4][..]),
        ("Bennett equal-length beta=pi-alpha", &[4]),
        ("4R planar parallelogram 4:3", &[2, 4]),
        ("4R planar rhombus", &[2, 2, 2]),
        ("4R spherical 2:1 rational", &[8]),
        ("5R Goldberg", &[6]),
        ("6R Bricard threefold (a=1)", &[8]),
        ("6R Bricard trihedral (1,4,2,4,6,3)", &[24]),
    ] {
        let pieces = checked(name, &System::published(name));
        let mut found: Vec<usize> = pieces.iter().map(|p| p.degree.unwrap()).collect();
        found.sort_unstable();
        assert_eq!(found, degrees, "{name}");
        for piece in pieces {
            assert_eq!(piece.dimension, 1, "{name}");
            assert_eq!(piece.real, RealPoints::FullDimension, "{name}");
        }
    }
}

/// Four bars of lengths 1, 1, 1 and l along a plane: c1 + c2 + c3 = l, s1 + s2 + s3 = 0.
fn four_bar(length: i64) -> System {
    System::new(
        &["c1", "s1", "c2", "s2", "c3", "s3"],
        &[
            &format!("c1 + c2 + c3 - {length}"),
            "s1 + s2 + s3",
            "c1^2 + s1^2 - 1",
            "c2^2 + s2^2 - 1",
            "c3^2 + s3^2 - 1",
        ],
    )
}

/// The same complex curve in kind, but: it moves; it is stretched out and has one real point; it cannot be assembled. The
/// complex dimension alone would call all three mobile.
#[test]
fn complex_dimension_is_not_real_dimension() {
    for (length, real) in [
        (2, RealPoints::FullDimension),
        (3, RealPoints::Some),
        (4, RealPoints::None),
    ] {
        let pieces = checked("four bars", &four_bar(length));
        assert_eq!(pieces.len(), 1);
        assert_eq!((pieces[0].dimension, pieces[0].degree), (1, Some(6)));
        assert_eq!(pieces[0].real, real, "length {length}");
    }
}

/// A point belongs to the pieces all of whose equations it satisfies: the folded pose of the rhombus to all three modes.
#[test]
fn poses_are_found_on_their_modes() {
    let name = "4R planar rhombus";
    let system = System::published(name);
    let pieces = checked(name, &system);
    let modes = |cosines: [i64; 4]| {
        let mut point = Vec::new();
        for c in cosines {
            point.push(Rational::from_integer(0.into()));
            point.push(Rational::from_integer(c.into()));
        }
        let on = |p: &Polynomial| p.value_at(&point) == Rational::from_integer(0.into());
        pieces.iter().filter(|p| p.contains_point(&on)).count()
    };
    // All links along one line: the modes meet there in pairs.
    assert_eq!(modes([-1, 1, -1, 1]), 2);
    assert_eq!(modes([1, -1, 1, -1]), 2);
    assert_eq!(modes([-1, -1, -1, -1]), 2);
    assert_eq!(modes([1, 1, 1, 1]), 0);
}

/// Twelve complex solutions, all conjugate, none real.
#[test]
fn six_revolutes_in_general_position() {
    let system = System::published("6R generic (16 solutions expected)");
    let budget = Budget::unlimited();
    let n = system.variables.len();
    let order = MonomialOrder::Degrevlex;
    let basis = groebner_basis(&system.equations, n, &order, &budget).unwrap();
    let points = FinitePoints::new(&basis, &budget).unwrap().unwrap();
    assert_eq!((points.multiplicity(), points.count()), (12, 12));
    assert_eq!(points.representation().factors.len(), 1);
    assert_eq!(points.real_count(&budget), Ok(0));
    let form = points.trace_form(&budget).unwrap();
    assert_eq!((form.rank, form.signature), (12, 0));
}

/// Katsura's system of 32 points, 16 of them real, counted in two ways; the residuals of the solutions as far as doubles go.
#[test]
fn katsura_5() {
    let names: Vec<String> = (0..=5).map(|i| format!("u{i}")).collect();
    let u = |i: i64| (i.abs() <= 5).then(|| Polynomial::variable(i.unsigned_abs() as usize, 6));
    let mut equations: Vec<Polynomial> = (0..5)
        .map(|m| {
            let products = (-5..=5).filter_map(|l| Some(&u(l)? * &u(m - l)?));
            let sum = products.fold(Polynomial::zero(6), |sum, p| &sum + &p);
            &sum - &u(m).unwrap()
        })
        .collect();
    let total = (-5..=5)
        .filter_map(u)
        .fold(Polynomial::zero(6), |s, p| &s + &p);
    equations.push(&total - &Polynomial::one(6));
    let budget = Budget::unlimited();
    let basis = groebner_basis(&equations, 6, &MonomialOrder::Degrevlex, &budget).unwrap();
    let points = FinitePoints::new(&basis, &budget).unwrap().unwrap();
    assert_eq!((points.count(), points.real_count(&budget)), (32, Ok(16)));
    let form = points.trace_form(&budget).unwrap();
    assert_eq!((form.rank, form.signature), (32, 16));
    let solutions = points.real_solutions(60, &budget).unwrap();
    assert_eq!(solutions.iter().filter(|s| s.is_exact()).count(), 2);
    let value = |p: &Polynomial, at: &[f64]| -> f64 {
        let term = |(exponents, c): (&[u32], &Rational)| {
            let c: f64 = c.to_integer().to_string().parse().unwrap();
            let powers = exponents.iter().zip(at).map(|(&e, x)| x.powi(e as i32));
            c * powers.product::<f64>()
        };
        p.terms().map(term).sum()
    };
    for solution in solutions.iter().map(RealSolution::values) {
        for equation in &equations {
            assert!(value(equation, &solution).abs() < 1e-14, "{names:?}");
        }
    }
}
