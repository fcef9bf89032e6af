//! Numbers as text that reads back as an equal number.

use super::tree::{Operation, Tree};
use super::{Angle, Direction, Exact, Float, Form, Number, Surd, decimal};
use dashu_base::Sign;
use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;

/// How tightly a text binds; an operand that binds less than its place needs is put in parentheses.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Binding {
    /// Sums and anything with a leading sign.
    Sum,
    Product,
    Power,
    Atom,
}

/// What is still to be written, last first.
enum Piece<'a> {
    Text(&'static str),
    Exponent(i32),
    Number(&'a Number, Binding),
}

impl Number {
    /// The text to write in a file: a literal as it was read, otherwise `${...}` with every name substituted. Reading it
    /// gives an equal number. A double made exact is written as a fraction, since a decimal would state a precision.
    #[must_use]
    pub fn source(&self) -> String {
        match &self.0.literal {
            Some(literal) => literal.text.to_string(),
            None => format!("${{{}}}", self.expression_text()),
        }
    }

    /// The exact value as a plain decimal of at most so many places, where it has one (`0.2` for 1/5).
    #[must_use]
    pub fn decimal_text(&self, places: u32) -> Option<String> {
        let value = self.rational()?;
        // A fraction in lowest terms ends after as many places as its denominator has factors of 2 or of 5.
        let (places, scaled) = (0..=places).find_map(|places| {
            let scaled = value * RBig::from(IBig::from(10).pow(places as usize));
            scaled.is_int().then_some((places as usize, scaled))
        })?;
        let sign = if scaled < RBig::ZERO { "-" } else { "" };
        let digits = scaled.numerator().to_string();
        let digits = format!("{:0>1$}", digits.trim_start_matches('-'), places + 1);
        let (whole, decimals) = digits.split_at(digits.len() - places);
        let point = if places > 0 { "." } else { "" };
        Some(format!("{sign}{whole}{point}{decimals}"))
    }

    /// For messages: the beginning of the text, and the value where the text does not say it.
    pub(super) fn shown(&self) -> String {
        let text = match &self.0.literal {
            Some(literal) => literal.text.to_string(),
            None => self.expression_text(),
        };
        let value = self.value();
        if self.rational().is_some_and(RBig::is_int) {
            decimal::excerpt(&text)
        } else {
            format!("{} (about {value})", decimal::excerpt(&text))
        }
    }

    /// Without recursion over the operands, which may be ten thousand levels deep.
    fn expression_text(&self) -> String {
        let mut text = String::new();
        let mut pieces = vec![Piece::Number(self, Binding::Sum)];
        while let Some(piece) = pieces.pop() {
            match piece {
                Piece::Text(fixed) => text.push_str(fixed),
                Piece::Exponent(n) => text.push_str(&format!("**{n}")),
                Piece::Number(number, needed) => {
                    write_number(number, needed, &mut text, &mut pieces)
                }
            }
        }
        text
    }
}

fn write_number<'a>(
    number: &'a Number,
    needed: Binding,
    text: &mut String,
    pieces: &mut Vec<Piece<'a>>,
) {
    let tree = match &number.0.form {
        Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => tree,
        Form::Exact(exact) => {
            let (leaf, binding) = match exact {
                Exact::Rational(x) => rational_text(x),
                Exact::Surd(x) => surd_text(x),
                Exact::Angle(x) => angle_text(x),
                Exact::Algebraic(_) => return,
            };
            push_leaf(&leaf, binding, needed, text);
            return;
        }
    };
    if let Operation::Stored(x) = &tree.operation {
        let (leaf, binding) = stored_text(x);
        push_leaf(&leaf, binding, needed, text);
        return;
    }
    if let Operation::Parameter(_) = &tree.operation {
        // A file knows the value only.
        push_all(pieces, &tree.operands, needed);
        return;
    }
    if binding(tree) < needed {
        text.push('(');
        pieces.push(Piece::Text(")"));
    }
    // `pieces` is a stack: what is written first is pushed last.
    let operands = &tree.operands;
    match (&tree.operation, operands.as_slice()) {
        (Operation::Add, [a, b]) => {
            match (b.tree().map(|t| &t.operation), b.tree()) {
                (Some(Operation::Negate), Some(negated)) => {
                    push_all(pieces, &negated.operands, Binding::Product);
                    pieces.push(Piece::Text(" - "));
                }
                _ => {
                    pieces.push(Piece::Number(b, Binding::Product));
                    pieces.push(Piece::Text(" + "));
                }
            }
            pieces.push(Piece::Number(a, Binding::Sum));
        }
        (Operation::Multiply | Operation::Divide, [a, b]) => {
            pieces.push(Piece::Number(b, Binding::Power));
            pieces.push(Piece::Text(if tree.operation == Operation::Divide {
                "/"
            } else {
                "*"
            }));
            pieces.push(Piece::Number(a, Binding::Product));
        }
        (Operation::Negate, _) => {
            push_all(pieces, operands, Binding::Product);
            pieces.push(Piece::Text("-"));
        }
        (Operation::Power(n), _) => {
            pieces.push(Piece::Exponent(*n));
            push_all(pieces, operands, Binding::Atom);
        }
        (operation, _) => {
            pieces.push(Piece::Text(")"));
            for (index, operand) in operands.iter().enumerate().rev() {
                pieces.push(Piece::Number(operand, Binding::Sum));
                if index > 0 {
                    pieces.push(Piece::Text(", "));
                }
            }
            pieces.push(Piece::Text(function_name(operation)));
        }
    }
}

fn push_all<'a>(pieces: &mut Vec<Piece<'a>>, operands: &'a [Number], needed: Binding) {
    pieces.extend(operands.iter().map(|x| Piece::Number(x, needed)));
}

fn push_leaf(leaf: &str, binding: Binding, needed: Binding, text: &mut String) {
    if binding < needed {
        text.push('(');
        text.push_str(leaf);
        text.push(')');
    } else {
        text.push_str(leaf);
    }
}

fn binding(tree: &Tree) -> Binding {
    match tree.operation {
        Operation::Add | Operation::Negate => Binding::Sum,
        Operation::Multiply | Operation::Divide => Binding::Product,
        Operation::Power(_) => Binding::Power,
        _ => Binding::Atom,
    }
}

fn function_name(operation: &Operation) -> &'static str {
    match operation {
        Operation::Sqrt => "sqrt(",
        Operation::Cos => "cos(",
        Operation::Sin => "sin(",
        Operation::Tan => "tan(",
        Operation::Asin => "asin(",
        Operation::Acos => "acos(",
        Operation::Atan => "atan(",
        Operation::Atan2 => "atan2(",
        _ => "(",
    }
}

fn rational_text(x: &RBig) -> (String, Binding) {
    let binding = if x.sign() == Sign::Negative && !x.is_zero() {
        Binding::Sum
    } else if x.is_int() {
        Binding::Atom
    } else {
        Binding::Product
    };
    let text = if x.is_int() {
        x.numerator().to_string()
    } else {
        format!("{}/{}", x.numerator(), x.denominator())
    };
    (text, binding)
}

/// Joins `coefficient*unit` by signs; a unit of "1" is the coefficient alone.
fn sum_text<'a>(terms: impl Iterator<Item = (&'a RBig, String)>) -> (String, Binding) {
    let mut text = String::new();
    let mut binding = Binding::Product;
    for (coefficient, unit) in terms {
        let negative = coefficient.sign() == Sign::Negative;
        if negative || !text.is_empty() {
            binding = Binding::Sum;
        }
        text.push_str(match (text.is_empty(), negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => " - ",
            (false, false) => " + ",
        });
        let size = if negative {
            -coefficient.clone()
        } else {
            coefficient.clone()
        };
        if unit == "1" {
            text.push_str(&rational_text(&size).0);
        } else if size.is_one() {
            text.push_str(&unit);
        } else {
            text.push_str(&format!("{}*{unit}", rational_text(&size).0));
        }
    }
    (text, binding)
}

fn surd_text(x: &Surd) -> (String, Binding) {
    sum_text(x.terms().map(|(d, c)| {
        let unit = if d.is_one() {
            "1".to_owned()
        } else {
            format!("sqrt({d})")
        };
        (c, unit)
    }))
}

fn angle_text(x: &Angle) -> (String, Binding) {
    let pi = (!x.pi_multiple().is_zero()).then(|| (x.pi_multiple(), "pi".to_owned()));
    let parts = x.parts().map(|(direction, q)| (q, direction.text()));
    sum_text(pi.into_iter().chain(parts))
}

impl Direction {
    /// The inverse circular function of the simpler coordinate.
    fn text(&self) -> String {
        let is_simple = |x: &Number| matches!(x.exact(), Some(Exact::Rational(_)));
        if is_simple(self.cos()) {
            format!("acos({})", self.cos().expression_text())
        } else if is_simple(self.sin()) {
            format!("asin({})", self.sin().expression_text())
        } else {
            match self.sin().checked_div(self.cos()) {
                Ok(tangent) if tangent.tree().is_none() => {
                    format!("atan({})", tangent.expression_text())
                }
                _ => format!(
                    "atan2({}, {})",
                    self.sin().expression_text(),
                    self.cos().expression_text()
                ),
            }
        }
    }
}

/// A stored float as an exact fraction.
fn stored_text(x: &Float) -> (String, Binding) {
    let significand = x.repr().significand().clone();
    let exponent = x.repr().exponent();
    let power = UBig::ONE << exponent.unsigned_abs().min(1 << 20);
    rational_text(&if exponent >= 0 {
        RBig::from(significand * IBig::from(power))
    } else {
        RBig::from_parts(significand, power)
    })
}
