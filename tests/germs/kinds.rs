//! Germs with known branches, by kind.

use super::polynomial::Polynomial;
use kutzbach::mobility::SingularKind;
use kutzbach::number::Number;

/// Polynomials whose common zeros near the origin are known.
pub struct Germ {
    pub kind: &'static str,
    pub polynomials: Vec<Polynomial>,
    /// Dimensions of the real branches, in descending order.
    pub branches: Vec<usize>,
    /// How they meet, where that is stated.
    pub meeting: Option<SingularKind>,
}

/// Draws whole numbers.
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ 0x6765_726d)
    }

    /// One of `0 … below − 1` (Steele, Lea and Flood 2014).
    pub fn below(&mut self, below: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) % below
    }

    /// A whole number of `low … high`.
    fn between(&mut self, low: i64, high: i64) -> i64 {
        low + self.below((high - low + 1) as u64) as i64
    }
}

fn integer(n: i64) -> Number {
    Number::integer(n)
}

fn power_of_ten(exponent: u32) -> Number {
    integer(10).power(-(exponent as i32)).unwrap()
}

/// Lines a x + b y = 0 of different slopes.
fn lines(draw: &mut Draw, count: usize) -> Vec<Polynomial> {
    const SLOPES: [[i64; 2]; 8] = [
        [1, 0],
        [0, 1],
        [1, 1],
        [1, -1],
        [1, 2],
        [2, -1],
        [1, 3],
        [3, 1],
    ];
    let first = draw.below(8) as usize;
    (0..count)
        .map(|i| Polynomial::linear(&SLOPES[(first + 3 * i) % 8]))
        .collect()
}

fn product(factors: Vec<Polynomial>) -> Polynomial {
    let mut factors = factors.into_iter();
    let first = factors.next().unwrap();
    factors.fold(first, |product, factor| product * factor)
}

/// `y^q − c x^p`.
fn binomial(p: usize, q: usize, c: i64) -> Polynomial {
    Polynomial::of(2, &[(&[0, q], Number::one()), (&[p, 0], integer(-c))])
}

/// What is known of curves: so many branches, how they meet.
fn curve(
    kind: &'static str,
    polynomial: Polynomial,
    branches: usize,
    meeting: Option<SingularKind>,
) -> Germ {
    Germ {
        kind,
        polynomials: vec![polynomial],
        branches: vec![1; branches],
        meeting,
    }
}

/// The kinds of germs, each with one that a seed draws.
pub const KINDS: [fn(&mut Draw) -> Germ; 16] = [
    |draw| {
        let count = 2 + draw.below(3) as usize;
        let meeting = Some(SingularKind::Bifurcation);
        curve("lines", product(lines(draw, count)), count, meeting)
    },
    |draw| {
        let lines = lines(draw, 2);
        let doubled = lines[0].power(2) * lines[1].clone();
        curve(
            "double line and line",
            doubled,
            2,
            Some(SingularKind::Bifurcation),
        )
    },
    |draw| {
        // t ↦ (t^q, t^p): a cusp where both powers of the tangent's direction are even.
        let [p, q] = [[3, 2], [5, 2], [4, 3], [5, 3], [7, 2]][draw.below(5) as usize];
        let meeting = (q % 2 == 0).then_some(SingularKind::Cusp);
        let c = draw.between(1, 3);
        curve("cusp", binomial(p, q, c), 1, meeting)
    },
    |draw| {
        let [a, b] = [[1, 2], [1, -1], [2, -3], [1, 3]][draw.below(4) as usize];
        let order = 2 + draw.below(2) as usize;
        let parabola = |c: i64| binomial(order, 1, c);
        let touching = parabola(a) * parabola(b);
        curve("tacnode", touching, 2, Some(SingularKind::Tangential))
    },
    |draw| {
        let [p, q] = [[2, 2], [4, 2], [4, 4], [6, 2]][draw.below(4) as usize];
        let definite = binomial(p, q, -draw.between(1, 3));
        curve("isolated point", definite, 0, Some(SingularKind::Shaky))
    },
    |draw| {
        // (y − x²)² + x⁶: what the lowest terms leave open is isolated by later ones.
        let six = Polynomial::of(2, &[(&[6, 0], integer(draw.between(1, 3)))]);
        let hidden = binomial(2, 1, 1).power(2) + six;
        curve(
            "isolated on a parabola",
            hidden,
            0,
            Some(SingularKind::Shaky),
        )
    },
    |draw| {
        let gap = power_of_ten(1 + draw.below(9) as u32);
        let loops = Polynomial::of(
            2,
            &[
                (&[0, 2], Number::one()),
                (&[3, 0], integer(-1)),
                (&[2, 0], -gap),
            ],
        );
        curve(
            "node with a small loop",
            loops,
            2,
            Some(SingularKind::Bifurcation),
        )
    },
    |draw| {
        let gap = power_of_ten(1 + draw.below(9) as u32);
        let beside = Polynomial::of(
            2,
            &[
                (&[0, 2], Number::one()),
                (&[3, 0], integer(-1)),
                (&[2, 0], gap),
            ],
        );
        curve("point beside a curve", beside, 0, Some(SingularKind::Shaky))
    },
    |draw| {
        let narrow = power_of_ten(1 + draw.below(9) as u32);
        let other = Polynomial::of(2, &[(&[0, 1], Number::one()), (&[1, 0], narrow)]);
        let pair = Polynomial::linear(&[0, 1]) * other;
        curve(
            "lines at a small angle",
            pair,
            2,
            Some(SingularKind::Bifurcation),
        )
    },
    |draw| {
        let crossed = binomial(3, 2, draw.between(1, 2)) * Polynomial::linear(&[1, 0]);
        curve("cusp and line", crossed, 2, Some(SingularKind::Bifurcation))
    },
    |draw| {
        let [a, b, c] = [[1, 1, -1], [1, 2, -1], [2, 1, -3]][draw.below(3) as usize];
        let squares = [[2, 0, 0], [0, 2, 0], [0, 0, 2]];
        let cone: Vec<(&[usize], Number)> = squares
            .iter()
            .zip([a, b, c])
            .map(|(e, c)| (&e[..], integer(c)))
            .collect();
        Germ {
            kind: "cone",
            polynomials: vec![Polynomial::of(3, &cone)],
            branches: vec![2],
            meeting: None,
        }
    },
    |draw| {
        let planes = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]];
        let count = 2 + draw.below(2) as usize;
        let planes: Vec<Polynomial> = planes[..count]
            .iter()
            .map(|p| Polynomial::linear(p))
            .collect();
        Germ {
            kind: "planes",
            polynomials: vec![product(planes)],
            branches: vec![2; count],
            meeting: Some(SingularKind::Bifurcation),
        }
    },
    |draw| {
        let narrow = power_of_ten(1 + draw.below(9) as u32);
        let [one, other] = [
            Polynomial::linear(&[1, 0, 0]),
            Polynomial::linear(&[0, 1, 1]),
        ];
        Germ {
            kind: "planes at a small angle",
            polynomials: vec![one.clone() * (one + other.scaled(&narrow))],
            branches: vec![2, 2],
            meeting: Some(SingularKind::Bifurcation),
        }
    },
    |draw| {
        // A definite form but for one small share of the wrong sign.
        let small = power_of_ten(1 + draw.below(9) as u32);
        Germ {
            kind: "narrow cone",
            polynomials: vec![Polynomial::of(
                3,
                &[
                    (&[2, 0, 0], Number::one()),
                    (&[0, 2, 0], integer(draw.between(1, 3))),
                    (&[0, 0, 2], -small),
                ],
            )],
            branches: vec![2],
            meeting: None,
        }
    },
    |_| Germ {
        kind: "plane and line",
        polynomials: vec![
            Polynomial::linear(&[1, 0, 0]) * Polynomial::linear(&[0, 0, 1]),
            Polynomial::linear(&[0, 1, 0]) * Polynomial::linear(&[0, 0, 1]),
        ],
        branches: vec![2, 1],
        meeting: Some(SingularKind::Kinematotropic),
    },
    |draw| Germ {
        kind: "touching bowls",
        polynomials: vec![Polynomial::of(
            3,
            &[
                (&[0, 0, 2], Number::one()),
                (&[4, 0, 0], integer(-draw.between(1, 2))),
                (&[0, 4, 0], integer(-1)),
            ],
        )],
        branches: vec![2],
        meeting: None,
    },
];

/// The germ in other coordinates, with other coefficients: variables exchanged or mixed by whole numbers, all equations times a whole
/// number, a decimal or π.
pub fn disguised(germ: Germ, draw: &mut Draw) -> Germ {
    let variables = germ.polynomials[0].variables;
    let mut rows: Vec<Vec<i64>> = (0..variables)
        .map(|i| (0..variables).map(|j| i64::from(i == j)).collect())
        .collect();
    let (a, b) = (
        draw.below(variables as u64) as usize,
        draw.below(2) as usize,
    );
    rows.swap(a, (a + b) % variables);
    if draw.below(3) == 0 {
        // A shear keeps whole numbers whole, both ways.
        let last = rows[variables - 1].clone();
        let by = draw.between(-1, 1);
        rows[0]
            .iter_mut()
            .zip(&last)
            .for_each(|(x, y)| *x += by * y);
    }
    let inner: Vec<Polynomial> = rows.iter().map(|row| Polynomial::linear(row)).collect();
    let factor = match draw.below(4) {
        0 => Number::decimal("0.25").unwrap(),
        1 => Number::pi(),
        2 => integer(draw.between(1, 3)),
        _ => Number::one(),
    };
    Germ {
        polynomials: germ
            .polynomials
            .iter()
            .map(|p| p.at(&inner).scaled(&factor))
            .collect(),
        ..germ
    }
}
