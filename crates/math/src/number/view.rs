//! A number taken apart: what it is made of, for those who compute with it in another way.

use super::tree::Operation;
use super::{Angle, Exact, Form, Number, Surd};
use dashu_ratio::RBig;

/// The outermost operation of a number, with its operands.
#[derive(Clone, Copy, Debug)]
pub enum View<'a> {
    /// A fraction.
    Rational(&'a RBig),
    /// A sum of rational multiples of square roots.
    Surd(&'a Surd),
    /// A combination of pi and inverse circular functions: transcendental, though its cosine and sine need not be.
    Angle(&'a Angle),
    /// A sum.
    Sum(&'a Number, &'a Number),
    /// A product.
    Product(&'a Number, &'a Number),
    /// Dividend and divisor.
    Quotient(&'a Number, &'a Number),
    /// What is subtracted from zero.
    Negative(&'a Number),
    /// What the square root is taken of.
    Root(&'a Number),
    /// Base and whole exponent.
    Power(&'a Number, i32),
    /// The angle (rad) whose cosine it is.
    Cosine(&'a Number),
    /// The angle (rad) whose sine it is.
    Sine(&'a Number),
    /// The angle (rad) whose tangent it is.
    Tangent(&'a Number),
    /// A name and the value it has in the file.
    Parameter(&'a str, &'a Number),
    /// An inverse circular function of something that is not algebraic, or a value of which only digits are left.
    Other,
}

impl Number {
    /// The outermost operation.
    pub fn view(&self) -> View<'_> {
        let tree = match &self.0.form {
            Form::Exact(Exact::Rational(x)) => return View::Rational(x),
            Form::Exact(Exact::Surd(x)) => return View::Surd(x),
            Form::Exact(Exact::Angle(x)) => return View::Angle(x),
            Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => tree,
        };
        match (&tree.operation, tree.operands.as_slice()) {
            (Operation::Add, [a, b]) => View::Sum(a, b),
            (Operation::Multiply, [a, b]) => View::Product(a, b),
            (Operation::Divide, [a, b]) => View::Quotient(a, b),
            (Operation::Negate, [a]) => View::Negative(a),
            (Operation::Sqrt, [a]) => View::Root(a),
            (Operation::Power(n), [a]) => View::Power(a, *n),
            (Operation::Cos, [a]) => View::Cosine(a),
            (Operation::Sin, [a]) => View::Sine(a),
            (Operation::Tan, [a]) => View::Tangent(a),
            (Operation::Parameter(name), [a]) => View::Parameter(name, a),
            _ => View::Other,
        }
    }

    /// Number of operations and leaves, shared ones counted as often as they occur; 1 for a normal form.
    pub fn size(&self) -> u32 {
        self.nodes()
    }

    /// A fraction.
    pub fn of_fraction(x: RBig) -> Self {
        Self::from_rational(x)
    }
}
