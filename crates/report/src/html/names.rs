//! From names in a report to the indices that the page's elements carry.

use crate::Report;
use crate::text::{Subject, visible};
use kutzbach_model::mechanism::Mechanism;
use std::collections::BTreeMap;

/// Indices by name. Cycles are in the order of the report.
#[derive(Debug)]
pub(super) struct Names {
    links: BTreeMap<String, usize>,
    joints: BTreeMap<String, usize>,
    cycles: BTreeMap<String, usize>,
}

impl Names {
    pub fn new(mechanism: &Mechanism, report: &Report) -> Self {
        fn numbered<'a>(names: impl Iterator<Item = &'a str>) -> BTreeMap<String, usize> {
            names.enumerate().map(|(i, n)| (n.to_owned(), i)).collect()
        }
        Self {
            links: numbered(mechanism.links().iter().map(|l| l.name.as_str())),
            joints: numbered(mechanism.joints().iter().map(|j| j.name.as_str())),
            cycles: numbered(report.cycles.iter().map(|c| c.name.as_str())),
        }
    }

    /// No name of anything, for pages without a picture of the mechanism.
    pub fn none() -> Self {
        Self {
            links: BTreeMap::new(),
            joints: BTreeMap::new(),
            cycles: BTreeMap::new(),
        }
    }

    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.get(name).copied()
    }

    /// `data-joint="3"` and the like; `None` for a name that is not there.
    pub fn attribute(&self, subject: &Subject) -> Option<String> {
        let (word, index) = match subject {
            Subject::Link(name) => ("link", self.links.get(name)),
            Subject::Joint(name) => ("joint", self.joints.get(name)),
            // A gap is told of by the joint that closes the loop.
            Subject::Cycle(name) => match self.cycles.get(name) {
                Some(index) => ("cycle", Some(index)),
                None => ("joint", self.joints.get(name)),
            },
        };
        index.map(|index| format!("data-{word}=\"{index}\""))
    }
}

/// A name as the page shows it.
pub(super) fn shown(name: &str) -> String {
    visible(name).into_owned()
}
