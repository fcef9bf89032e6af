//! Vectors, rotations and poses over whatever can be added and multiplied: field elements, polynomials, doubles.

use super::element::Element;
use super::field::Field;
use super::poly::Poly;

/// A commutative ring that holds the elements of a field.
pub(super) trait Scalars {
    type Value: Clone;
    fn constant(&self, value: &Element) -> Self::Value;
    fn plus(&self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    fn minus(&self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    fn times(&self, a: &Self::Value, b: &Self::Value) -> Self::Value;
    /// The unit quaternion of a rotation, real part first and not negative, where it can be told.
    fn quaternion(&self, rotation: &Matrix<Self::Value>) -> Option<[Self::Value; 4]>;

    fn integer(&self, value: i64) -> Self::Value {
        self.constant(&Element::integer(value))
    }
}

/// Three components.
pub(super) type Vector<V> = [V; 3];
/// Rows.
pub(super) type Matrix<V> = [[V; 3]; 3];

/// `p_a = rotation p_b + translation`.
#[derive(Clone, Debug)]
pub(super) struct Pose<V> {
    pub(super) rotation: Matrix<V>,
    pub(super) translation: Vector<V>,
}

pub(super) fn dot<S: Scalars>(s: &S, a: &Vector<S::Value>, b: &Vector<S::Value>) -> S::Value {
    let sum = s.plus(&s.times(&a[0], &b[0]), &s.times(&a[1], &b[1]));
    s.plus(&sum, &s.times(&a[2], &b[2]))
}

pub(super) fn cross<S: Scalars>(
    s: &S,
    a: &Vector<S::Value>,
    b: &Vector<S::Value>,
) -> Vector<S::Value> {
    let part = |i: usize, j: usize| s.minus(&s.times(&a[i], &b[j]), &s.times(&a[j], &b[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}

pub(super) fn add<S: Scalars>(
    s: &S,
    a: &Vector<S::Value>,
    b: &Vector<S::Value>,
) -> Vector<S::Value> {
    [0, 1, 2].map(|i| s.plus(&a[i], &b[i]))
}

pub(super) fn subtract<S: Scalars>(
    s: &S,
    a: &Vector<S::Value>,
    b: &Vector<S::Value>,
) -> Vector<S::Value> {
    [0, 1, 2].map(|i| s.minus(&a[i], &b[i]))
}

pub(super) fn scale<S: Scalars>(s: &S, a: &Vector<S::Value>, f: &S::Value) -> Vector<S::Value> {
    [0, 1, 2].map(|i| s.times(&a[i], f))
}

pub(super) fn negate<S: Scalars>(s: &S, a: &Vector<S::Value>) -> Vector<S::Value> {
    let zero = s.integer(0);
    [0, 1, 2].map(|i| s.minus(&zero, &a[i]))
}

pub(super) fn apply<S: Scalars>(
    s: &S,
    m: &Matrix<S::Value>,
    v: &Vector<S::Value>,
) -> Vector<S::Value> {
    [0, 1, 2].map(|i| dot(s, &m[i], v))
}

pub(super) fn transpose<V: Clone>(m: &Matrix<V>) -> Matrix<V> {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[j][i].clone()))
}

pub(super) fn multiply<S: Scalars>(
    s: &S,
    a: &Matrix<S::Value>,
    b: &Matrix<S::Value>,
) -> Matrix<S::Value> {
    let columns = transpose(b);
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(s, &a[i], &columns[j])))
}

pub(super) fn identity<S: Scalars>(s: &S) -> Matrix<S::Value> {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| s.integer(i64::from(i == j))))
}

/// Constants in another ring.
pub(super) fn vector<S: Scalars>(s: &S, v: &Vector<Element>) -> Vector<S::Value> {
    [0, 1, 2].map(|i| s.constant(&v[i]))
}

/// Constants in another ring.
pub(super) fn matrix<S: Scalars>(s: &S, m: &Matrix<Element>) -> Matrix<S::Value> {
    [0, 1, 2].map(|i| vector(s, &m[i]))
}

impl<V: Clone> Pose<V> {
    pub(super) fn identity<S: Scalars<Value = V>>(s: &S) -> Self {
        Self {
            rotation: identity(s),
            translation: [0, 1, 2].map(|_| s.integer(0)),
        }
    }

    pub(super) fn then<S: Scalars<Value = V>>(&self, s: &S, next: &Self) -> Self {
        Self {
            rotation: multiply(s, &self.rotation, &next.rotation),
            translation: self.image(s, &next.translation),
        }
    }

    pub(super) fn image<S: Scalars<Value = V>>(&self, s: &S, p: &Vector<V>) -> Vector<V> {
        add(s, &apply(s, &self.rotation, p), &self.translation)
    }

    pub(super) fn inverse<S: Scalars<Value = V>>(&self, s: &S) -> Self {
        let rotation = transpose(&self.rotation);
        let translation = negate(s, &apply(s, &rotation, &self.translation));
        Self {
            rotation,
            translation,
        }
    }
}

/// A constant pose in another ring.
pub(super) fn pose<S: Scalars>(s: &S, p: &Pose<Element>) -> Pose<S::Value> {
    Pose {
        rotation: matrix(s, &p.rotation),
        translation: vector(s, &p.translation),
    }
}

/// The rotation about an axis by Rodrigues' formula, with the sine divided by the axis' length: c I + s [a] +
/// (1 − c)/|a|² a aᵀ. No length of an axis is needed, only its square.
pub(super) fn rotation<S: Scalars>(
    s: &S,
    axis: &Vector<Element>,
    inverse_square: &Element,
    cosine: &S::Value,
    sine: &S::Value,
    field: &Field,
) -> Matrix<S::Value> {
    let versine = s.minus(&s.integer(1), cosine);
    let mut result: Matrix<S::Value> = [0, 1, 2].map(|i| {
        [0, 1, 2].map(|j| {
            let square = field.multiply(&field.multiply(&axis[i], &axis[j]), inverse_square);
            let entry = s.times(&s.constant(&square), &versine);
            if i == j {
                s.plus(&entry, cosine)
            } else {
                entry
            }
        })
    });
    for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let part = s.times(&s.constant(&axis[k]), sine);
        result[i][j] = s.minus(&result[i][j], &part);
        result[j][i] = s.plus(&result[j][i], &part);
    }
    result
}

/// The rotation of a unit quaternion, real part first.
pub(super) fn rotation_of_quaternion<S: Scalars>(s: &S, q: &[S::Value; 4]) -> Matrix<S::Value> {
    let two = s.integer(2);
    let product = |i: usize, j: usize| s.times(&two, &s.times(&q[i], &q[j]));
    let one = s.integer(1);
    let diagonal = |i: usize, j: usize| s.minus(&s.minus(&one, &product(i, i)), &product(j, j));
    [
        [
            diagonal(2, 3),
            s.minus(&product(1, 2), &product(0, 3)),
            s.plus(&product(1, 3), &product(0, 2)),
        ],
        [
            s.plus(&product(1, 2), &product(0, 3)),
            diagonal(1, 3),
            s.minus(&product(2, 3), &product(0, 1)),
        ],
        [
            s.minus(&product(1, 3), &product(0, 2)),
            s.plus(&product(2, 3), &product(0, 1)),
            diagonal(1, 2),
        ],
    ]
}

impl Scalars for Field {
    type Value = Element;
    fn constant(&self, value: &Element) -> Element {
        value.clone()
    }
    fn plus(&self, a: &Element, b: &Element) -> Element {
        a.plus(b)
    }
    fn minus(&self, a: &Element, b: &Element) -> Element {
        a.minus(b)
    }
    fn times(&self, a: &Element, b: &Element) -> Element {
        self.multiply(a, b)
    }
    /// Of the identity only: a ball's quaternion counts from where the file draws it.
    fn quaternion(&self, rotation: &Matrix<Element>) -> Option<[Element; 4]> {
        let is_identity = rotation
            .iter()
            .flatten()
            .zip(identity(self).iter().flatten())
            .all(|(a, b)| a == b);
        is_identity.then(|| [1, 0, 0, 0].map(Element::integer))
    }
}

/// Polynomials over a field.
pub(super) struct Polynomials<'a>(pub(super) &'a Field);

impl Scalars for Polynomials<'_> {
    type Value = Poly;
    fn constant(&self, value: &Element) -> Poly {
        Poly::constant(value.clone())
    }
    fn plus(&self, a: &Poly, b: &Poly) -> Poly {
        a.plus(b)
    }
    fn minus(&self, a: &Poly, b: &Poly) -> Poly {
        a.minus(b)
    }
    fn times(&self, a: &Poly, b: &Poly) -> Poly {
        a.times(b, self.0)
    }
    fn quaternion(&self, _: &Matrix<Poly>) -> Option<[Poly; 4]> {
        None
    }
}

/// Doubles.
pub(super) struct Doubles<'a>(pub(super) &'a Field);

impl Scalars for Doubles<'_> {
    type Value = f64;
    fn constant(&self, value: &Element) -> f64 {
        self.0.approximate(value)
    }
    fn plus(&self, a: &f64, b: &f64) -> f64 {
        a + b
    }
    fn minus(&self, a: &f64, b: &f64) -> f64 {
        a - b
    }
    fn times(&self, a: &f64, b: &f64) -> f64 {
        a * b
    }
    fn quaternion(&self, r: &Matrix<f64>) -> Option<[f64; 4]> {
        // The largest component first, so that nothing small is divided by.
        let trace = r[0][0] + r[1][1] + r[2][2];
        let mut squares = [trace; 4];
        for i in 0..3 {
            squares[i + 1] = 2.0 * r[i][i] - trace;
        }
        let mut largest = 0;
        for i in 1..4 {
            if squares[i] > squares[largest] {
                largest = i;
            }
        }
        let mut q = [0.0; 4];
        q[largest] = (1.0 + squares[largest]).max(0.0).sqrt() / 2.0;
        let quarter = 0.25 / q[largest];
        let antisymmetric = |i: usize| r[(i + 2) % 3][(i + 1) % 3] - r[(i + 1) % 3][(i + 2) % 3];
        if largest == 0 {
            for i in 0..3 {
                q[i + 1] = antisymmetric(i) * quarter;
            }
        } else {
            let i = largest - 1;
            q[0] = antisymmetric(i) * quarter;
            for j in (0..3).filter(|&j| j != i) {
                q[j + 1] = (r[i][j] + r[j][i]) * quarter;
            }
        }
        if q[0] < 0.0 {
            q = q.map(|x| -x);
        }
        Some(q)
    }
}
