//! Expressions kept as they are: a node, its operands, and what is known of its size.

use super::{Exact, Float, Form, Inner, Number};
use std::sync::Arc;

/// What a node does with its operands.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Operation {
    Add,
    Multiply,
    Divide,
    Negate,
    Sqrt,
    Power(i32),
    Cos,
    Sin,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    /// A named value, kept by its name where formulas are wanted; its operand is the value.
    Parameter(Arc<str>),
    /// A value known to [`STORED_BITS`] only: what remains of an expression that grew beyond [`MAX_NODES`].
    Stored(Float),
}

/// Largest expression that is kept, counted as a tree.
pub(super) const MAX_NODES: u32 = 10_000;
/// Significant bits kept of an expression that grew beyond [`MAX_NODES`].
pub(super) const STORED_BITS: usize = 4_096;
/// Largest denominator of a fraction of pi whose cosine counts as algebraic (it always is; its degree grows).
const MAX_ALGEBRAIC_PI: u32 = 1_000;

/// An expression that has no shorter normal form: an operation on numbers.
#[derive(Clone, Debug)]
pub struct Tree {
    pub(super) operation: Operation,
    pub(super) operands: Vec<Number>,
    nodes: u32,
    algebraic: bool,
    open: bool,
}

impl Tree {
    pub(super) fn new(operation: Operation, operands: Vec<Number>) -> Self {
        let nodes = operands
            .iter()
            .fold(1u32, |sum, x| sum.saturating_add(x.nodes()));
        let algebraic = match operation {
            Operation::Add
            | Operation::Multiply
            | Operation::Divide
            | Operation::Negate
            | Operation::Sqrt
            | Operation::Power(_) => operands.iter().all(Number::is_algebraic),
            Operation::Cos | Operation::Sin | Operation::Tan => {
                operands.iter().all(|x| match x.exact() {
                    Some(Exact::Angle(angle)) => {
                        angle.parts().len() == 0
                            && *angle.pi_multiple().denominator() <= MAX_ALGEBRAIC_PI.into()
                    }
                    _ => false,
                })
            }
            _ => false,
        };
        let open =
            matches!(operation, Operation::Parameter(_)) || operands.iter().any(Number::is_open);
        Self {
            operation,
            operands,
            nodes,
            algebraic,
            open,
        }
    }

    /// What is left of an expression that grew too large: open as it was.
    pub(super) fn stored(operation: Operation, open: bool) -> Self {
        Self {
            open,
            ..Self::new(operation, Vec::new())
        }
    }

    /// Whether a parameter occurs.
    pub(super) fn is_open(&self) -> bool {
        self.open
    }

    /// Number of operations and leaves, shared ones counted as often as they occur.
    #[must_use]
    pub fn nodes(&self) -> u32 {
        self.nodes
    }

    /// Whether only rationals, square roots and circular functions of fractions of pi occur.
    #[must_use]
    pub fn is_algebraic(&self) -> bool {
        self.algebraic
    }
}

/// Takes an expression apart without recursion: a sum of ten thousand terms is ten thousand levels deep.
impl Drop for Inner {
    fn drop(&mut self) {
        let mut left = self.take_operands();
        while let Some(Number(inner)) = left.pop() {
            if let Some(mut inner) = Arc::into_inner(inner) {
                left.append(&mut inner.take_operands());
            }
        }
    }
}

impl Inner {
    fn take_operands(&mut self) -> Vec<Number> {
        match &mut self.form {
            Form::Exact(Exact::Algebraic(tree)) | Form::Symbolic(tree) => {
                std::mem::take(&mut tree.operands)
            }
            Form::Exact(_) => Vec::new(),
        }
    }
}
