//! Arithmetic of three components.

use crate::decide::Answer;
use crate::error::GeometryError;
use crate::scalar::Scalar;

pub(crate) fn minus<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    [a[0].minus(&b[0]), a[1].minus(&b[1]), a[2].minus(&b[2])]
}

pub(crate) fn plus<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    [a[0].plus(&b[0]), a[1].plus(&b[1]), a[2].plus(&b[2])]
}

pub(crate) fn scaled<S: Scalar>(a: &[S; 3], factor: &S) -> [S; 3] {
    [a[0].times(factor), a[1].times(factor), a[2].times(factor)]
}

pub(crate) fn negated<S: Scalar>(a: &[S; 3]) -> [S; 3] {
    [a[0].negated(), a[1].negated(), a[2].negated()]
}

pub(crate) fn dot<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> S {
    let first = a[0].times(&b[0]);
    let second = a[1].times(&b[1]);
    first.plus(&second).plus(&a[2].times(&b[2]))
}

pub(crate) fn cross<S: Scalar>(a: &[S; 3], b: &[S; 3]) -> [S; 3] {
    let part = |i: usize, j: usize| a[i].times(&b[j]).minus(&a[j].times(&b[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}

/// The square of the length, never below zero.
pub(crate) fn square<S: Scalar>(a: &[S; 3]) -> S {
    let first = a[0].squared().plus(&a[1].squared());
    first.plus(&a[2].squared())
}

/// The quotient of numbers of which the divisor was found to differ from zero.
pub(crate) fn quotient<S: Scalar>(a: &S, b: &S) -> Result<S, GeometryError> {
    a.over(b).ok_or(GeometryError::OutOfRange {
        needed: "a divisor that differs from zero",
    })
}

/// The root of a number that is no square of an imaginary one.
pub(crate) fn root<S: Scalar>(a: &S) -> Result<S, GeometryError> {
    a.root().ok_or(GeometryError::OutOfRange {
        needed: "a number that is not negative under a root",
    })
}

/// The length.
pub(crate) fn length<S: Scalar>(a: &[S; 3]) -> Result<S, GeometryError> {
    root(&square(a))
}

/// `point + direction · a / b`.
pub(crate) fn along<S: Scalar>(
    point: &[S; 3],
    direction: &[S; 3],
    a: &S,
    b: &S,
) -> Result<[S; 3], GeometryError> {
    Ok(plus(point, &scaled(direction, &quotient(a, b)?)))
}

/// The component along which a vector that is not zero is seen best: of those that certainly are not zero the greatest.
pub(crate) fn pivot<S: Scalar>(v: &[S; 3]) -> usize {
    let mut best = 0;
    let mut size = -1.0;
    for (axis, x) in v.iter().enumerate() {
        let own = x.double().abs();
        if Answer::zero(x.sign()).is_no() && own > size {
            best = axis;
            size = own;
        }
    }
    best
}
