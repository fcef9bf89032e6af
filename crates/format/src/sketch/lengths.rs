//! Lengths that are equal: distances of two points and radii of circles.
//!
//! Where one of them has a value all have it, and each is a constraint of its own. Where none has, it is an unknown value that relations share.

use super::super::element::Element;
use super::super::error::{Fault, Outcome};
use super::Parts;
use kutzbach_constructive::named::Radius;
use kutzbach_constructive::relation::Relation;
use kutzbach_math::number::Number;
use std::collections::HashMap;

/// What has a length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum Long {
    /// From one point to another, the lesser index first.
    Segment([usize; 2]),
    /// The radius of a circle.
    Circle(usize),
}

impl Long {
    pub(super) fn segment(ends: [usize; 2]) -> Self {
        let [u, v] = ends;
        Self::Segment([u.min(v), u.max(v)])
    }
}

/// Lengths, and which are equal.
#[derive(Default)]
pub(super) struct Lengths<'a> {
    index: HashMap<Long, usize>,
    all: Vec<(Long, Element<'a>)>,
    /// A length equal to it that was named before; its own index where there is none.
    same_as: Vec<usize>,
    /// By length that is its own: the value.
    value: Vec<Option<Number>>,
    /// By length that is its own: which unknown value it is.
    unknown: Vec<Option<usize>>,
    pairs: Vec<([usize; 2], Element<'a>)>,
    unknowns: usize,
}

impl<'a> Lengths<'a> {
    pub(super) fn of(&mut self, long: Long, at: Element<'a>) -> usize {
        *self.index.entry(long).or_insert_with(|| {
            self.all.push((long, at));
            self.same_as.push(self.same_as.len());
            self.value.push(None);
            self.unknown.push(None);
            self.same_as.len() - 1
        })
    }

    /// States a value; whether there was none.
    pub(super) fn state(&mut self, length: usize, value: Number) -> bool {
        let first = self.value[length].is_none();
        self.value[length] = Some(value);
        first
    }

    pub(super) fn equate(&mut self, pair: [usize; 2], at: Element<'a>) {
        self.pairs.push((pair, at));
    }

    /// The length that stands for all that are equal to it.
    fn own(&self, mut length: usize) -> usize {
        while self.same_as[length] != length {
            length = self.same_as[length];
        }
        length
    }

    /// How large a circle is.
    pub(super) fn radius(&self, circle: usize) -> Radius {
        let own = self.index.get(&Long::Circle(circle)).map(|&i| self.own(i));
        let own = own.unwrap_or_default();
        match (self.value.get(own), self.unknown.get(own)) {
            (Some(Some(value)), _) => Radius::Known(value.clone()),
            (_, Some(Some(unknown))) => Radius::Unknown(*unknown),
            _ => Radius::Unknown(0),
        }
    }

    /// How many unknown values there are.
    pub(super) const fn unknown(&self) -> usize {
        self.unknowns
    }

    /// Makes one of two lengths.
    fn join(&mut self, pair: [usize; 2], at: Element<'a>) -> Outcome<()> {
        let [one, other] = pair.map(|l| self.own(l));
        if one == other {
            return Err(at.fault("that these are equal follows from what was said before"));
        }
        let message = match (&self.value[one], &self.value[other]) {
            (Some(a), Some(b)) if a == b => {
                Some("these have equal values already, said one by one")
            }
            (Some(_), Some(_)) => Some("these have different values"),
            _ => None,
        };
        if let Some(message) = message {
            return Err(at.fault(message));
        }
        let [first, second] = [one.min(other), one.max(other)];
        let value = self.value[second].take();
        self.value[first] = self.value[first].take().or(value);
        self.same_as[second] = first;
        Ok(())
    }
}

impl Parts<'_> {
    /// Gives equal lengths their value, or an unknown one.
    pub(super) fn share_lengths(&mut self) -> Vec<Fault> {
        for constraint in &self.constraints {
            let segment = Long::segment(constraint.ends);
            if let Some(&length) = self.lengths.index.get(&segment) {
                self.lengths.state(length, constraint.value.clone());
            }
        }
        let stated: Vec<bool> = self.lengths.value.iter().map(Option::is_some).collect();
        let pairs = std::mem::take(&mut self.lengths.pairs);
        let joined = pairs.into_iter();
        let faults = joined.filter_map(|(pair, at)| self.lengths.join(pair, at).err());
        let faults: Vec<Fault> = faults.collect();
        for (length, stated) in stated.into_iter().enumerate() {
            let own = self.lengths.own(length);
            let (long, at) = self.lengths.all[length];
            match (self.lengths.value[own].clone(), long) {
                (Some(value), Long::Segment(ends)) if !stated => self.push(at, ends, value),
                (Some(_), _) => {}
                (None, _) => {
                    let next = self.lengths.unknowns;
                    let value = *self.lengths.unknown[own].get_or_insert(next);
                    self.lengths.unknowns = next.max(value + 1);
                    if let Long::Segment(ends) = long {
                        self.relations.push(Relation::Measured {
                            ends,
                            terms: vec![(value, false)],
                            plus: Number::zero(),
                        });
                    }
                }
            }
        }
        faults
    }
}
