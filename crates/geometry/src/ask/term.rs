//! What a question is made of.

use kutzbach_math::number::Number;
use std::ops::Range;

/// A term, and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Term {
    pub(super) what: What,
    pub(super) span: Range<usize>,
}

/// What a term is.
#[derive(Clone, Debug)]
pub(super) enum What {
    /// The name of an entity or a number.
    Name(String),
    /// A free name, by its number in the question.
    Free(usize),
    /// A number.
    Number(Number),
    /// A list.
    List(Vec<Term>),
    /// A function of terms.
    Call(String, Vec<Term>),
}

/// How two numbers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Comparison {
    Equal,
    Different,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// What has to hold.
#[derive(Clone, Debug)]
pub(super) enum Goal {
    /// A logical function holds, or anything else has a value.
    Holds(Term),
    /// Two terms compare so.
    Compare(Term, Comparison, Term),
    /// The goals have no answer.
    Not(Vec<Goal>),
}

/// Goals that hold together.
#[derive(Clone, Debug)]
pub(super) struct Query {
    pub(super) goals: Vec<Goal>,
    /// The free names, without question marks, in the order in which they come.
    pub(super) free: Vec<String>,
}

/// A line of a script.
#[derive(Clone, Debug)]
pub(super) enum Statement {
    Ask(Query),
    Define(String, Range<usize>, Term),
    Delete(String, Range<usize>, bool),
    Rename(String, Range<usize>, String),
    List,
}

impl Term {
    /// Adds the free names in it.
    pub(super) fn free_names(&self, found: &mut Vec<usize>) {
        let mut open = vec![self];
        while let Some(term) = open.pop() {
            match &term.what {
                What::Free(number) if !found.contains(number) => found.push(*number),
                What::List(terms) | What::Call(_, terms) => open.extend(terms),
                What::Free(_) | What::Name(_) | What::Number(_) => {}
            }
        }
    }
}

impl Goal {
    /// The free names in it, ascending by their numbers.
    pub(super) fn free_names(&self) -> Vec<usize> {
        let mut found = Vec::new();
        let mut open = vec![self];
        while let Some(goal) = open.pop() {
            match goal {
                Self::Holds(term) => term.free_names(&mut found),
                Self::Compare(first, _, second) => {
                    first.free_names(&mut found);
                    second.free_names(&mut found);
                }
                Self::Not(goals) => open.extend(goals),
            }
        }
        found.sort_unstable();
        found
    }
}
